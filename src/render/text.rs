//! Words in a picture.

use super::picture::Picture;
use ab_glyph::{Font, FontRef, Glyph, PxScale, ScaleFont};
use std::sync::LazyLock;

static FONT: LazyLock<FontRef<'static>> =
    LazyLock::new(|| FontRef::try_from_slice(epaint_default_fonts::UBUNTU_LIGHT).expect("the embedded font is a font"));

/// Glyphs of one line, the baseline at y = 0, the pen starting at x = 0; and the pen's end.
fn laid_out(text: &str, height: f32) -> (Vec<Glyph>, f32) {
    let font = FONT.as_scaled(PxScale::from(height));
    let mut pen = 0.0;
    let mut last = None;
    let mut glyphs = Vec::new();
    for character in text.chars() {
        let id = font.glyph_id(character);
        pen += last.map_or(0.0, |l| font.kern(l, id));
        glyphs.push(id.with_scale_and_position(height, ab_glyph::point(pen, 0.0)));
        pen += font.h_advance(id);
        last = Some(id);
    }
    (glyphs, pen)
}

/// How wide a line of this height comes out, pixels.
pub(super) fn width(text: &str, height: f32) -> f32 {
    laid_out(text, height).1
}

/// Writes one line of text with its upper left corner at (x, y) pixels, `height` from ascender to descender. What
/// falls outside is cut. `colour` is sRGB.
pub(super) fn draw(picture: &mut Picture, text: &str, x: f32, y: f32, height: f32, colour: [u8; 3]) {
    let baseline = y + FONT.as_scaled(PxScale::from(height)).ascent();
    for glyph in laid_out(text, height).0 {
        let Some(outline) = FONT.outline_glyph(glyph) else { continue };
        let bounds = outline.px_bounds();
        let (left, top) = ((bounds.min.x + x).round() as i64, (bounds.min.y + baseline).round() as i64);
        outline.draw(|column, row, coverage| {
            let (px, py) = (left + i64::from(column), top + i64::from(row));
            if (0..i64::from(picture.width)).contains(&px) && (0..i64::from(picture.height)).contains(&py) {
                let at = (py as usize * picture.width as usize + px as usize) * 4;
                blend(&mut picture.rgba[at..at + 4], colour, coverage.clamp(0.0, 1.0));
            }
        });
    }
}

/// Lays a colour over a pixel.
pub(super) fn blend(pixel: &mut [u8], colour: [u8; 3], coverage: f32) {
    let below = f32::from(pixel[3]) / 255.0 * (1.0 - coverage);
    let alpha = coverage + below;
    if alpha <= 0.0 {
        return;
    }
    for (channel, ink) in pixel.iter_mut().zip(colour) {
        *channel = ((f32::from(ink) * coverage + f32::from(*channel) * below) / alpha).round() as u8;
    }
    pixel[3] = (alpha * 255.0).round() as u8;
}
