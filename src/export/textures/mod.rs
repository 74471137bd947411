//! A head's colours and fine relief as pictures, laid over its texture coordinates: for clients that know nothing of hair.
//!
//! The skin has one picture of base colours and one of normals in tangent space, the eyeballs share one of base colours.
//! Every texel is a function of its own place, so that rows can be painted side by side.

mod cobbles;
mod eye;
mod gutter;
mod relief;
mod skin;
mod streaks;
mod tangents;
mod texels;

use crate::frame::{Canvas, Frame, Part};
use glam::Vec4;

/// Sides that a texture may have, texels; powers of two.
pub const TEXTURE_SIZES: [u32; 2] = [256, 4096];

/// The pictures of one head, as PNG.
#[derive(Clone, Debug, PartialEq)]
pub struct Textures {
    /// Base colours of the skin, sRGB.
    pub skin_colour: Vec<u8>,
    /// Normals of the skin in tangent space, +Y up.
    pub skin_normal: Vec<u8>,
    /// Base colours of an eyeball, sRGB, half as wide and high; none where the frame has no eyes.
    pub eye_colour: Option<Vec<u8>>,
    /// For each vertex to draw of the skin its unit tangent, and in w the side on which the bitangent lies.
    pub(super) tangents: Vec<Vec4>,
}

/// Why a head has no textures.
#[derive(Debug, thiserror::Error)]
pub enum TextureError {
    /// Not a power of two, or out of range.
    #[error("a texture of {0} texels cannot be made: take a power of two from {least} to {most}", least = TEXTURE_SIZES[0], most = TEXTURE_SIZES[1])]
    Size(u32),
    /// The frame has no skin, or one without texture coordinates.
    #[error("the frame has no skin with texture coordinates: show the skin, and ask the pipeline for them")]
    NoLayout,
    /// Colours of another skin.
    #[error("the colours are those of a skin of {found} vertices, the frame's has {expected}")]
    Canvas {
        /// Vertices that the colours are of.
        found: usize,
        /// Vertices of the frame's skin.
        expected: usize,
    },
    /// The pixels could not be written.
    #[error("a texture could not be written: {0}")]
    Png(#[from] png::EncodingError),
}

impl Textures {
    /// Paints the textures of a frame, `size` texels wide and high. `canvas`: the colours of its skin; the bytes do not depend on
    /// `threads`.
    ///
    /// # Errors
    /// A size that is none of those; a frame without a skin that has texture coordinates; colours of another skin.
    pub fn bake(frame: &Frame<'_>, canvas: &Canvas<'_>, size: u32, threads: usize) -> Result<Self, TextureError> {
        let [least, most] = TEXTURE_SIZES;
        if !size.is_power_of_two() || !(least..=most).contains(&size) {
            return Err(TextureError::Size(size));
        }
        let skin = frame.parts.iter().find(|part| part.topology.name == "skin").ok_or(TextureError::NoLayout)?;
        let (uv, coat) = (skin.uv.ok_or(TextureError::NoLayout)?, frame.coat.ok_or(TextureError::NoLayout)?);
        if canvas.n_vertices() != skin.positions.len() {
            return Err(TextureError::Canvas { found: canvas.n_vertices(), expected: skin.positions.len() });
        }
        let tangents = tangents::tangents(skin, uv);
        let hair = skin::Hair {
            lengths: coat.grooms.iter().map(|groom| groom.length).collect(),
            directions: skin
                .flow
                .iter()
                .zip(coat.grooms)
                .map(|(flow, groom)| flow.normalize_or_zero() + groom.comb)
                .collect(),
            curl: coat.hair.curl,
        };
        let painter = skin::Painter::new(skin, uv, hair, canvas, &tangents, size);
        let [colours, normals] = painter.paint(threads);
        let eye = frame.eyes.first().map(|eyeball| encoded(&eye::paint(eyeball, size / 2, threads), size / 2));
        Ok(Self {
            skin_colour: encoded(&colours, size)?,
            skin_normal: encoded(&normals, size)?,
            eye_colour: eye.transpose()?,
            tangents,
        })
    }

    /// The tangents of a part, where it has some.
    pub(super) fn tangents_of(&self, part: &Part<'_>) -> Option<&[Vec4]> {
        (part.topology.name == "skin").then_some(&self.tangents)
    }
}

/// `of(x, y)` for every texel of a square, row by row from the top; each thread has a part of the rows.
fn filled<T: Copy + Default + Send>(size: u32, threads: usize, of: impl Fn(usize, usize) -> T + Sync) -> Vec<T> {
    let size = size as usize;
    let mut out = vec![T::default(); size * size];
    let rows = size.div_ceil(threads.max(1));
    let of = &of;
    std::thread::scope(|scope| {
        for (k, part) in out.chunks_mut(rows * size).enumerate() {
            scope.spawn(move || {
                part.iter_mut().enumerate().for_each(|(i, to)| *to = of(i % size, k * rows + i / size));
            });
        }
    });
    out
}

/// A PNG file of a square of red, green and blue.
fn encoded(texels: &[[u8; 3]], size: u32) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, size, size);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(texels.as_flattened())?;
    writer.finish()?;
    Ok(bytes)
}

/// 0 at `from`, 1 at `to` and beyond, smooth between; `to` may be the lower one.
fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
