//! A contact sheet: one row a head with its name, one column a view, or a view of each dress; or several heads beside each
//! other.
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
use crate::coat::Condition;
use crate::frame::{Frame, Material};

/// Part of a cell left free around the head.
const MARGIN: f32 = 0.06;
const INK: [u8; 3] = [0x22, 0x22, 0x22];
const PAPER: [u8; 3] = [0xe9, 0xe7, 0xe2];

/// What a head of a sheet wears.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dress {
    /// Nothing: one matt clay.
    Clay,
    /// Its colours, without hair.
    Skin,
    /// Its coat.
    Coat,
}

impl Dress {
    /// Every dress, in the order of the help text.
    pub const ALL: [Self; 3] = [Self::Clay, Self::Skin, Self::Coat];

    /// The name it is asked for by.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Clay => "clay",
            Self::Skin => "skin",
            Self::Coat => "coat",
        }
    }

    fn put_on(self, drawing: Drawing) -> Drawing {
        match self {
            Self::Clay => Drawing { preset: Preset::Clay, n_strands: 0, ..drawing },
            Self::Skin => Drawing { n_strands: 0, ..drawing },
            Self::Coat => drawing,
        }
    }
}

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
    /// What coats are like today: dry unless it is set.
    pub condition: Condition,
    /// In which light, and as what: in the studio unless it is set.
    pub preset: Preset,
    /// Of each pixel: sixteen unless they are set.
    pub samples: Samples,
    /// What each view is drawn in, one after another: the drawing as it is, without a word above it, if there are none.
    pub dresses: Vec<Dress>,
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
            condition: Condition::default(),
            preset: Preset::default(),
            samples: Samples::default(),
            dresses: Vec::new(),
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
        let mut cells = Vec::with_capacity(self.n_columns());
        for &view in &self.views {
            let mut camera = self.fitted(view, frame);
            if !self.fit {
                camera.distance = camera.distance.max(self.distance);
            }
            let Self { background, skin_opacity, shading, n_strands, condition, preset, samples, .. } = *self;
            let drawing = Drawing {
                background,
                skin_opacity,
                shading,
                n_strands,
                condition,
                preset,
                samples,
                ..Drawing::new(camera)
            };
            if self.dresses.is_empty() {
                cells.push(offscreen.draw(frame, &drawing, self.cell)?);
            }
            for &dress in &self.dresses {
                let drawing = dress.put_on(drawing);
                cells.push(match dress {
                    Dress::Clay => without_whiskers(offscreen, frame, &drawing, self.cell)?,
                    Dress::Skin | Dress::Coat => offscreen.draw(frame, &drawing, self.cell)?,
                });
            }
        }
        self.rows.push((name.to_owned(), cells));
        Ok(())
    }

    /// Pictures of one head.
    fn n_columns(&self) -> usize {
        self.views.len() * self.dresses.len().max(1)
    }

    /// What stands above the pictures of one head: the view's name where there are several or no dresses, and the dress's.
    fn headings(&self) -> Vec<String> {
        let names = self.views.iter().map(|view| view.name());
        if self.dresses.is_empty() {
            return names.collect();
        }
        let one = self.views.len() == 1;
        let dressed = |view: String| {
            self.dresses.iter().map(move |dress| match dress.name() {
                dress if one => dress.to_owned(),
                dress => format!("{view}, {dress}"),
            })
        };
        names.flat_map(dressed).collect()
    }

    /// The sheet: names of the views above, each row with its name below.
    pub fn finish(self) -> Picture {
        let [cell_width, cell_height] = self.cell;
        let heading = heading(cell_width);
        let caption = ((cell_height as f32 * CAPTION) as u32).max(1);
        let row = cell_height + caption;
        let [r, g, b] = PAPER;
        let alpha = if self.background == Background::None { 0 } else { 255 };
        let (across, block) = (self.heads_across.max(1), cell_width * self.n_columns() as u32);
        let n_rows = (self.rows.len() as u32).div_ceil(across);
        let mut sheet = Picture::filled(block * across, heading + row * n_rows, [r, g, b, alpha]);
        let headings = self.headings();
        for (column, name) in (0u32..).zip((0..across).flat_map(|_| &headings)) {
            let size = narrowed(name, heading as f32 * 0.7, cell_width);
            let x = (column * cell_width) as f32 + (cell_width as f32 - text::width(name, size)) * 0.5;
            text::draw(&mut sheet, name, x, heading as f32 * 0.12, size, INK);
        }
        for (index, (name, cells)) in (0u32..).zip(&self.rows) {
            let (left, top) = (index % across * block, heading + index / across * row);
            for (column, cell) in (0u32..).zip(cells) {
                sheet.paste(cell, left + column * cell_width, top);
            }
            let size = narrowed(name, caption as f32 * 0.8, block);
            text::draw(&mut sheet, name, left as f32 + size * 0.4, (top + cell_height) as f32 + size * 0.1, size, INK);
        }
        sheet
    }
}

/// As clay is shown everywhere. The head is another one to the painter, before and behind.
fn without_whiskers(
    offscreen: &mut Offscreen,
    frame: &Frame<'_>,
    drawing: &Drawing,
    size: [u32; 2],
) -> Result<Picture, DrawError> {
    let mut bare = frame.clone();
    bare.parts.retain(|part| part.topology.ranges.iter().any(|range| range.material != Material::Whisker));
    offscreen.forget();
    let picture = offscreen.draw(&bare, drawing, size);
    offscreen.forget();
    picture
}

/// The largest size up to `size` at which a word stays within `width` pixels, with a little room beside it.
fn narrowed(word: &str, size: f32, width: u32) -> f32 {
    let wide = text::width(word, size) + size * 0.8;
    size * (width as f32 / wide.max(1.0)).min(1.0)
}

/// Height of a row's name, as a part of a cell's height.
const CAPTION: f32 = 0.11;

/// Height of the line with the views' names, pixels.
fn heading(cell_width: u32) -> u32 {
    (cell_width / 11).max(1)
}
