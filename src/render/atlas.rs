//! An atlas: strips of small pictures with a title above and a caption below each, in columns, under headings.

use super::picture::Picture;
use super::text;

const INK: [u8; 3] = [0x22, 0x22, 0x22];
/// What the strips lie on, sRGB: pictures before it have no frame.
pub const PAPER: [u8; 3] = [0xe9, 0xe7, 0xe2];
/// Heights of lines, pixels: they stay readable however small the pictures are.
const HEADING: u32 = 26;
const TITLE: u32 = 17;
const CAPTION: u32 = 15;
/// Around each strip, and between its pictures, pixels.
const GAP: u32 = 6;
const INNER_GAP: u32 = 2;

/// A few pictures that belong together.
#[derive(Clone, Debug)]
pub struct Strip {
    /// Above them.
    pub title: String,
    /// From the left, each with what stands below it. All have one size.
    pub cells: Vec<(Picture, String)>,
}

/// Strips under a heading.
#[derive(Clone, Debug)]
pub struct Section {
    /// Above them.
    pub heading: String,
    /// Row by row.
    pub strips: Vec<Strip>,
}

/// Puts sections under each other, `columns` strips beside each other. Strips have as many pictures as the first, of its size.
pub fn atlas(sections: &[Section], columns: u32) -> Picture {
    let columns = columns.max(1);
    let first = sections.iter().flat_map(|s| &s.strips).find(|s| !s.cells.is_empty());
    let [width, height] = first.map_or([1, 1], |s| [s.cells[0].0.width, s.cells[0].0.height]);
    let n_cells = first.map_or(1, |s| s.cells.len() as u32);
    let (across, down) = (n_cells * (width + INNER_GAP) + 2 * GAP, TITLE + height + CAPTION + GAP);
    let rows = |section: &Section| (section.strips.len() as u32).div_ceil(columns);
    let total: u32 = sections.iter().map(|s| HEADING + rows(s) * down).sum();
    let mut page = Picture::filled(columns * across, total.max(1), [PAPER[0], PAPER[1], PAPER[2], 255]);
    let mut top = 0;
    for section in sections {
        let size = HEADING as f32 * 0.75;
        text::draw(&mut page, &section.heading, GAP as f32, top as f32 + HEADING as f32 * 0.15, size, INK);
        top += HEADING;
        for (index, strip) in (0u32..).zip(&section.strips) {
            let (x, y) = ((index % columns) * across + GAP, top + (index / columns) * down);
            text::draw(&mut page, &strip.title, x as f32, y as f32, TITLE as f32 * 0.9, INK);
            for (column, (picture, caption)) in (0u32..).zip(&strip.cells) {
                let left = x + column * (width + INNER_GAP);
                page.paste(picture, left, y + TITLE);
                let size = CAPTION as f32 * 0.85;
                let middle = left as f32 + (width as f32 - text::width(caption, size)) * 0.5;
                text::draw(&mut page, caption, middle, (y + TITLE + height) as f32, size, INK);
            }
        }
        top += rows(section) * down;
    }
    page
}
