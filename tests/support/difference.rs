//! How different two pictures look.

use londra::render::Picture;

/// Differences of colour in units of CIELAB (ΔE 1976), after a blur that stands for an eye at some distance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Difference {
    /// Over all pixels.
    pub mean: f64,
    /// All but the worst hundredth of the pixels lie below.
    pub percentile_99: f64,
}

/// Compares two pictures of the same size. What is transparent shows white.
pub fn difference(a: &Picture, b: &Picture) -> Difference {
    assert_eq!((a.width, a.height), (b.width, b.height), "pictures of different sizes cannot be compared");
    let (lab_a, lab_b) = (blurred(&lab(a), a.width as usize), blurred(&lab(b), b.width as usize));
    let mut deltas: Vec<f64> = lab_a.iter().zip(&lab_b).map(|(p, q)| distance(p, q)).collect();
    let mean = deltas.iter().sum::<f64>() / deltas.len() as f64;
    deltas.sort_by(f64::total_cmp);
    Difference { mean, percentile_99: deltas[(deltas.len() - 1) * 99 / 100] }
}

fn distance(p: &[f64; 3], q: &[f64; 3]) -> f64 {
    p.iter().zip(q).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt()
}

/// CIELAB under D65, from sRGB.
fn lab(picture: &Picture) -> Vec<[f64; 3]> {
    picture.rgba.chunks_exact(4).map(pixel_lab).collect()
}

fn pixel_lab(pixel: &[u8]) -> [f64; 3] {
    let alpha = f64::from(pixel[3]) / 255.0;
    let linear = |byte: u8| {
        let s = f64::from(byte) / 255.0;
        let l = if s <= 0.04045 { s / 12.92 } else { ((s + 0.055) / 1.055).powf(2.4) };
        l * alpha + 1.0 - alpha
    };
    let [r, g, b] = [linear(pixel[0]), linear(pixel[1]), linear(pixel[2])];
    let x = (0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.9505;
    let y = 0.2126 * r + 0.7152 * g + 0.0722 * b;
    let z = (0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.089;
    let f = |t: f64| if t > 0.008856 { t.cbrt() } else { 7.787 * t + 16.0 / 116.0 };
    [116.0 * f(y) - 16.0, 500.0 * (f(x) - f(y)), 200.0 * (f(y) - f(z))]
}

/// The mean over three by three pixels; edges repeat.
fn blurred(pixels: &[[f64; 3]], width: usize) -> Vec<[f64; 3]> {
    let height = pixels.len() / width;
    let at = |x: isize, y: isize| {
        let x = x.clamp(0, width as isize - 1) as usize;
        let y = y.clamp(0, height as isize - 1) as usize;
        pixels[y * width + x]
    };
    let around = |index: usize| {
        let (x, y) = ((index % width) as isize, (index / width) as isize);
        let mut sum = [0.0; 3];
        for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
            sum.iter_mut().zip(at(x + dx, y + dy)).for_each(|(s, v)| *s += v / 9.0);
        }
        sum
    };
    (0..pixels.len()).map(around).collect()
}
