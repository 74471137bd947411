//! A contact sheet: one row a head with its name, one column a view; or several heads beside each other.
//!
//! Call [`Sheet::measure`] for every head, then [`Sheet::add_row`] for every head, then [`Sheet::finish`]. The first
//! round finds the scale that all cells share, so that a Chihuahua is small beside a borzoi.

use super::camera::{Camera, Lens, View};
use super::ground_pass::Background;
use super::offscreen::{DrawError, Offscreen};
use super::painter::{Drawing, Shading};
use super::picture::Picture;
use super::preset::Preset;
use super::samples::Samples;
use super::text;
use crate::frame::Frame;

/// Part of a cell left free around the head.
const MARGIN: f32 = 0.06;
const INK: [u8; 3] = [0x22, 0x22, 0x22];
const PAPER: [u8; 3] = [0xe9, 0xe7, 0xe2];

/// A sheet being composed.
#[derive(Clone, Debug)]
pub struct Sheet {
    views: Vec<View>,
    cell: [u32; 2],
    fit: bool,
    lens: Lens,
    pitch: Option<f32>,
    /// Behind the heads that are added from now on.
    pub background: Background,
    /// Of the skin, 0 to 1: 1 unless it is set.
    pub skin_opacity: f32,
    /// Surfaces, or lines over them: surfaces unless it is set.
    pub shading: Shading,
    /// Strands of hair on a head at most: none unless it is set.
    pub n_strands: u32,
    /// In which light, and as what: in the studio unless it is set.
    pub preset: Preset,
    /// Of each pixel: sixteen unless they are set.
    pub samples: Samples,
    /// Heads beside each other, at least 1: 1 unless it is set.
    pub heads_across: u32,
    distance: f32,
    rows: Vec<(String, Vec<Picture>)>,
}

impl Sheet {
    /// `cell`: width and height of one picture, pixels, each at least 1. `fit`: every head fills its cell instead of
    /// sharing one scale. `pitch`: radians, in place of that of the views.
    pub fn new(
        views: Vec<View>,
        cell: [u32; 2],
        fit: bool,
        lens: Lens,
        pitch: Option<f32>,
        background: Background,
    ) -> Self {
        Self {
            views,
            cell,
            fit,
            lens,
            pitch,
            background,
            skin_opacity: 1.0,
            shading: Shading::Shaded,
            n_strands: 0,
            preset: Preset::default(),
            samples: Samples::default(),
            heads_across: 1,
            distance: 0.0,
            rows: Vec::new(),
        }
    }

    /// The largest cell with which a sheet of so many rows and columns stays within `size` (width, height, pixels).
    pub fn cell_within(size: [u32; 2], n_rows: usize, n_columns: usize) -> [u32; 2] {
        let (rows, columns) = (n_rows.max(1) as u32, n_columns.max(1) as u32);
        let height = size[1].saturating_sub(heading(size[0] / columns)) / rows;
        let cell_height = (height as f32 / (1.0 + CAPTION)) as u32;
        [(size[0] / columns).max(1), cell_height.max(1)]
    }

    fn fitted(&self, view: View, frame: &Frame<'_>) -> Camera {
        let mut camera = Camera::at(view, self.pitch, self.lens);
        camera.fit(frame.outline().iter(), self.cell[0] as f32 / self.cell[1] as f32, MARGIN);
        camera
    }

    /// Lets a head take part in the shared scale.
    pub fn measure(&mut self, frame: &Frame<'_>) {
        let needed = self.views.iter().map(|&v| self.fitted(v, frame).distance);
        self.distance = needed.fold(self.distance, f32::max);
    }

    /// Draws one head in every view.
    pub fn add_row(&mut self, offscreen: &mut Offscreen, frame: &Frame<'_>, name: &str) -> Result<(), DrawError> {
        let mut cells = Vec::with_capacity(self.views.len());
        for &view in &self.views {
            let mut camera = self.fitted(view, frame);
            if !self.fit {
                camera.distance = camera.distance.max(self.distance);
            }
            let Self { background, skin_opacity, shading, n_strands, preset, samples, .. } = *self;
            let drawing =
                Drawing { background, skin_opacity, shading, n_strands, preset, samples, ..Drawing::new(camera) };
            cells.push(offscreen.draw(frame, &drawing, self.cell)?);
        }
        self.rows.push((name.to_owned(), cells));
        Ok(())
    }

    /// The sheet: names of the views above, each row with its name below.
    pub fn finish(self) -> Picture {
        let [cell_width, cell_height] = self.cell;
        let heading = heading(cell_width);
        let caption = ((cell_height as f32 * CAPTION) as u32).max(1);
        let row = cell_height + caption;
        let [r, g, b] = PAPER;
        let alpha = if self.background == Background::None { 0 } else { 255 };
        let (across, block) = (self.heads_across.max(1), cell_width * self.views.len() as u32);
        let n_rows = (self.rows.len() as u32).div_ceil(across);
        let mut sheet = Picture::filled(block * across, heading + row * n_rows, [r, g, b, alpha]);
        let views = (0..across).flat_map(|_| &self.views);
        for (column, view) in (0u32..).zip(views) {
            let size = heading as f32 * 0.7;
            let name = view.name();
            let x = (column * cell_width) as f32 + (cell_width as f32 - text::width(&name, size)) * 0.5;
            text::draw(&mut sheet, &name, x, heading as f32 * 0.12, size, INK);
        }
        for (index, (name, cells)) in (0u32..).zip(&self.rows) {
            let (left, top) = (index % across * block, heading + index / across * row);
            for (column, cell) in (0u32..).zip(cells) {
                sheet.paste(cell, left + column * cell_width, top);
            }
            let size = caption as f32 * 0.8;
            text::draw(&mut sheet, name, left as f32 + size * 0.4, (top + cell_height) as f32 + size * 0.1, size, INK);
        }
        sheet
    }
}

/// Height of a row's name, as a part of a cell's height.
const CAPTION: f32 = 0.11;

/// Height of the line with the views' names, pixels.
fn heading(cell_width: u32) -> u32 {
    (cell_width / 11).max(1)
}
