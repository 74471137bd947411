//! Arrows in a picture.

use super::picture::Picture;
use super::text::blend;
use glam::Vec2;

/// Draws an arrow between two places (pixels, rightwards and downwards from the top left corner), `width` pixels wide.
/// What falls outside is cut; what is no number is not drawn. `colour` is sRGB.
pub fn arrow(picture: &mut Picture, from: Vec2, to: Vec2, width: f32, colour: [u8; 3]) {
    if !(from.is_finite() && to.is_finite()) {
        return;
    }
    let along = (to - from).normalize_or_zero();
    // The head opens by half a right angle and is no longer than the arrow.
    let barb = (4.0 * width).min(from.distance(to)) * std::f32::consts::FRAC_1_SQRT_2;
    let barbs =
        [along + along.perp(), along - along.perp()].map(|way| to - barb * way * std::f32::consts::FRAC_1_SQRT_2);
    let strokes = [(from, to), (to, barbs[0]), (to, barbs[1])];
    let (low, high) = strokes.iter().fold((from, from), |(l, h), (a, b)| (l.min(*a).min(*b), h.max(*a).max(*b)));
    let clamped = |v: f32, most: u32| v.clamp(0.0, most as f32) as u32;
    let [x0, x1] = [low.x - width - 1.0, high.x + width + 2.0].map(|x| clamped(x, picture.width));
    let [y0, y1] = [low.y - width - 1.0, high.y + width + 2.0].map(|y| clamped(y, picture.height));
    for y in y0..y1 {
        for x in x0..x1 {
            let here = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            let distance = strokes.iter().map(|(a, b)| distance(here, *a, *b)).fold(f32::INFINITY, f32::min);
            let coverage = (0.5 * width + 0.5 - distance).clamp(0.0, 1.0);
            if coverage > 0.0 {
                let at = (y as usize * picture.width as usize + x as usize) * 4;
                blend(&mut picture.rgba[at..at + 4], colour, coverage);
            }
        }
    }
}

/// From a point to a stretch between two others.
fn distance(point: Vec2, a: Vec2, b: Vec2) -> f32 {
    let along = b - a;
    let part = if along.length_squared() > 0.0 { (point - a).dot(along) / along.length_squared() } else { 0.0 };
    point.distance(a + along * part.clamp(0.0, 1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arrow_misses_its_ends_or_leaves_the_picture() {
        let mut picture = Picture::filled(20, 20, [255; 4]);
        arrow(&mut picture, Vec2::new(2.5, 10.5), Vec2::new(15.5, 10.5), 1.0, [0; 3]);
        let ink = |x: usize, y: usize| picture.rgba[(y * 20 + x) * 4] < 40;
        assert!(ink(3, 10) && ink(14, 10) && !ink(18, 10) && !ink(8, 13));
        for to in [Vec2::new(-500.0, 900.0), Vec2::new(f32::NAN, 0.0), Vec2::new(5.0, 5.0)] {
            arrow(&mut picture, Vec2::new(5.0, 5.0), to, 2.0, [0; 3]);
        }
    }
}
