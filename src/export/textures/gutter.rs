//! What lies between the islands of a layout: the colours of the nearest, softer the farther away, so that no smaller copy of
//! the picture draws anything foreign into an island.
//!
//! Means of two by two, again and again, and back (Gortler, Grzeszczuk, Szeliski and Cohen 1996, "The lumigraph", section
//! 3.4, without their partial weights).

/// Fills the texels that are not covered; both slices have `size` · `size` elements, `size` a power of two.
pub(super) fn fill(texels: &mut [[u8; 3]], covered: &[bool], size: usize) {
    if size < 2 {
        return;
    }
    let half = size / 2;
    let block = |x: usize, y: usize| [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| (2 * y + j) * size + 2 * x + i);
    let mut means = vec![[0; 3]; half * half];
    let mut known = vec![false; half * half];
    for (x, y) in (0..half).flat_map(|y| (0..half).map(move |x| (x, y))) {
        let inside = block(x, y).into_iter().filter(|&i| covered[i]);
        let (mut sum, mut n) = ([0_u32; 3], 0);
        for i in inside {
            (0..3).for_each(|k| sum[k] += u32::from(texels[i][k]));
            n += 1;
        }
        if n > 0 {
            means[y * half + x] = sum.map(|s| ((s + n / 2) / n) as u8);
            known[y * half + x] = true;
        }
    }
    fill(&mut means, &known, half);
    for (x, y) in (0..half).flat_map(|y| (0..half).map(move |x| (x, y))) {
        for i in block(x, y).into_iter().filter(|&i| !covered[i]) {
            texels[i] = means[y * half + x];
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_gutter_has_a_colour_that_its_island_has_not() {
        let size = 16;
        let covered: Vec<bool> = (0..256).map(|i| i % 16 < 5 && i / 16 < 6).collect();
        let mut texels: Vec<[u8; 3]> = covered.iter().map(|&c| if c { [200, 10, 30] } else { [0; 3] }).collect();
        fill(&mut texels, &covered, size);
        assert!(texels.iter().all(|t| *t == [200, 10, 30]));
        let mut none = vec![[7; 3]; 256];
        fill(&mut none, &[false; 256], size);
        assert!(none.iter().all(|t| *t == [0; 3]));
    }
}
