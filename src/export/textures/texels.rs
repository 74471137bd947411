//! Which triangle of a layout each texel shows.

use glam::Vec2;

/// How far beyond the edge of a layout a texel still shows what lies there, texels: a client that reads between texels at a
/// seam finds on both sides what it would find without one.
const REACH: f32 = 1.5;

/// No triangle.
const NONE: u32 = u32::MAX;

/// The triangle of each texel of a square.
pub(super) struct Texels {
    size: usize,
    owners: Vec<u32>,
}

/// What a texel's middle shows.
pub(super) struct Texel {
    pub triangle: usize,
    /// Of the triangle's corners, for the place in it that is nearest: they sum to 1 and none is negative.
    pub weights: [f32; 3],
    /// From that place to the texel's middle; zero inside.
    pub beyond: Vec2,
}

impl Texels {
    /// `triangles`: texture coordinates of the corners; they do not overlap. `size`: texels of a side.
    pub fn new(triangles: &[[Vec2; 3]], size: u32) -> Self {
        let n = size as usize;
        let mut owners = vec![NONE; n * n];
        let mut distances = vec![REACH * REACH; n * n];
        for (t, corners) in (0..).zip(triangles) {
            let corners = corners.map(|p| p * size as f32);
            let low = corners[0].min(corners[1]).min(corners[2]) - REACH;
            let high = corners[0].max(corners[1]).max(corners[2]) + REACH;
            let range = |low: f32, high: f32| (low.max(0.0) as usize)..(high.max(0.0).ceil() as usize).min(n);
            for y in range(low.y, high.y) {
                for x in range(low.x, high.x) {
                    let (_, beyond) = nearest(corners, middle(x, y));
                    let (distance, at) = (beyond.length_squared(), y * n + x);
                    // Of equally near ones the first.
                    if distance < distances[at] {
                        (distances[at], owners[at]) = (distance, t);
                    }
                }
            }
        }
        Self { size: n, owners }
    }

    /// What a texel shows of the triangles that this was made for.
    pub fn at(&self, triangles: &[[Vec2; 3]], x: usize, y: usize) -> Option<Texel> {
        let owner = self.owners[y * self.size + x];
        let corners = triangles.get(owner as usize)?.map(|p| p * self.size as f32);
        let (weights, beyond) = nearest(corners, middle(x, y));
        Some(Texel { triangle: owner as usize, weights, beyond: beyond / self.size as f32 })
    }

    /// Whether a texel shows something, one for each, row by row.
    pub fn covered(&self) -> Vec<bool> {
        self.owners.iter().map(|&owner| owner != NONE).collect()
    }
}

fn middle(x: usize, y: usize) -> Vec2 {
    Vec2::new(x as f32 + 0.5, y as f32 + 0.5)
}

/// The nearest place of a triangle as weights of its corners, and the way from it to `p`.
fn nearest([a, b, c]: [Vec2; 3], p: Vec2) -> ([f32; 3], Vec2) {
    let area = (b - a).perp_dot(c - a);
    if area != 0.0 {
        let weights = [(c - b).perp_dot(p - b), (a - c).perp_dot(p - c), (b - a).perp_dot(p - a)].map(|w| w / area);
        if weights.iter().all(|&w| w >= 0.0) {
            return (weights, Vec2::ZERO);
        }
    }
    let along = |from: Vec2, to: Vec2| {
        let edge = to - from;
        let t = ((p - from).dot(edge) / edge.length_squared().max(1e-12)).clamp(0.0, 1.0);
        (t, p - (from + edge * t))
    };
    let [(s, ab), (t, bc), (u, ca)] = [along(a, b), along(b, c), along(c, a)];
    let [of_ab, of_bc, of_ca] = [ab, bc, ca].map(Vec2::length_squared);
    if of_ab <= of_bc && of_ab <= of_ca {
        ([1.0 - s, s, 0.0], ab)
    } else if of_bc <= of_ca {
        ([0.0, 1.0 - t, t], bc)
    } else {
        ([u, 0.0, 1.0 - u], ca)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::vec2;

    #[test]
    fn a_texel_shows_another_place_than_its_own() {
        let triangles =
            [[vec2(0.1, 0.1), vec2(0.9, 0.2), vec2(0.3, 0.8)], [vec2(0.9, 0.2), vec2(0.9, 0.9), vec2(0.3, 0.8)]];
        let size = 32;
        let texels = Texels::new(&triangles, size);
        let mut inside = 0;
        for (x, y) in (0..32).flat_map(|y| (0..32).map(move |x| (x, y))) {
            let Some(texel) = texels.at(&triangles, x, y) else { continue };
            let [a, b, c] = triangles[texel.triangle];
            let place = a * texel.weights[0] + b * texel.weights[1] + c * texel.weights[2] + texel.beyond;
            assert!(place.distance(middle(x, y) / 32.0) < 1e-5, "{x} {y}: {place}");
            assert!(texel.weights.iter().all(|w| (0.0..=1.0).contains(w)));
            assert!(texel.beyond.length() * 32.0 < REACH);
            inside += usize::from(texel.beyond == Vec2::ZERO);
        }
        let area: f32 = triangles.iter().map(|[a, b, c]| (*b - *a).perp_dot(*c - *a).abs() * 0.5).sum();
        assert!((inside as f32 / 1024.0 - area).abs() < 0.03, "{inside} texels for {area}");
        assert_eq!(
            texels.covered().iter().filter(|c| **c).count(),
            (0..1024).filter(|i| texels.at(&triangles, i % 32, i / 32).is_some()).count()
        );
    }
}
