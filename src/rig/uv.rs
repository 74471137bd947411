//! Texture coordinates of the skin: `assets/head_uv.ron` as a type.
//!
//! The half's charts lie in the right half of the square, u from 0.5 on; the other side is their mirror image about
//! u = 0.5. Where a chart joins its image, along the dorsal midline, u is 0.5 and both sides have one value; elsewhere
//! on the midline each side has its own, and a seam runs there. Origin: top left, v downwards, as glTF has it.

use super::control::{ControlError, HalfMesh};
use glam::Vec2;
use serde::{Deserialize, Serialize};

/// The head's texture coordinates as baked.
pub const HEAD_UV: &str = include_str!("../../assets/head_uv.ron");

/// The charts of one half.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HalfUv {
    /// Format version, 1.
    pub version: u32,
    /// In the order of the patch file. Every face of the half belongs to one.
    pub charts: Vec<Chart>,
}

/// One connected piece of the layout.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Chart {
    /// As the patch file calls it.
    pub name: String,
    /// Faces of the half.
    pub faces: Vec<u16>,
    /// Their vertices, ascending.
    pub vertices: Vec<u16>,
    /// Where each lies, 0 to 1: multiples of 2⁻²⁰, so that their mirror images are exact.
    pub uvs: Vec<[f32; 2]>,
}

impl HalfUv {
    /// Reads the text of `assets/head_uv.ron` for its mesh.
    ///
    /// # Errors
    /// Syntax with line and column, or the list that does not fit.
    pub fn parse(text: &str, half: &HalfMesh) -> Result<Self, ControlError> {
        let uv: Self = ron::from_str(text)?;
        uv.check(half)?;
        Ok(uv)
    }

    fn check(&self, half: &HalfMesh) -> Result<(), ControlError> {
        let mut seen = vec![0; half.faces.len()];
        for chart in &self.charts {
            for &f in &chart.faces {
                let face = half.faces.get(f as usize).ok_or(ControlError::Uv("faces"))?;
                seen[f as usize] += 1;
                if face.iter().any(|v| chart.vertices.binary_search(v).is_err()) {
                    return Err(ControlError::Uv("vertices"));
                }
            }
            let fits = chart.vertices.iter().all(|&v| (v as usize) < half.n_half())
                && chart.vertices.len() == chart.uvs.len()
                && chart.uvs.iter().flatten().all(|x| (0.0..=1.0).contains(x));
            if !fits {
                return Err(ControlError::Uv("uvs"));
            }
        }
        if seen.iter().any(|&n| n != 1) {
            return Err(ControlError::Uv("faces"));
        }
        Ok(())
    }

    /// Values and, for each corner of the whole mesh in the order of [`HalfMesh::triangles`], the number of its value.
    pub fn corners(&self, half: &HalfMesh) -> (Vec<Vec2>, Vec<u32>) {
        let n = half.faces.len();
        let (mut values, mut corners) = (Vec::new(), vec![0; 6 * n]);
        for chart in &self.charts {
            let first = values.len() as u32;
            values.extend(chart.uvs.iter().map(|&uv| Vec2::from(uv)));
            let images: Vec<u32> = chart
                .vertices
                .iter()
                .zip(&chart.uvs)
                .zip(first..)
                .map(|((&v, &[x, y]), own)| {
                    if half.midline[v as usize] && x == 0.5 {
                        return own;
                    }
                    values.push(Vec2::new(1.0 - x, y));
                    values.len() as u32 - 1
                })
                .collect();
            for &f in &chart.faces {
                let at = half.faces[f as usize].map(|v| chart.vertices.partition_point(|&w| w < v));
                for (k, at) in at.into_iter().enumerate() {
                    corners[3 * f as usize + k] = first + at as u32;
                    // The image has its second and third corner exchanged.
                    corners[3 * (n + f as usize) + (3 - k) % 3] = images[at];
                }
            }
        }
        (values, corners)
    }
}
