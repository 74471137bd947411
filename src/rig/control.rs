//! The control mesh of the head: `assets/head.ron` as a type.
//!
//! Stored is one half (x ≥ 0) with names, regions, loops, landmarks and the base shape; the whole mesh is that half, in
//! its order, followed by the mirror images of its vertices off the median plane.

use super::mirror;
use crate::anatomy::Region;
use crate::mesh::{DedgeMesh, MeshError};
use glam::Vec3;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// A vertex, and the vertices and weights that give its limit position; each with whether its mirror image is meant.
pub type LimitRow = (u16, Vec<(u16, bool, f32)>);

/// Half of the head, as baked.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct HalfMesh {
    /// Format version, 1.
    pub version: u32,
    /// Name of each vertex, in order of creation.
    pub tags: Vec<String>,
    /// Whether each vertex lies in the median plane.
    pub midline: Vec<bool>,
    /// Region of each vertex.
    pub regions: Vec<Region>,
    /// Triangles, counter-clockwise seen from outside.
    pub faces: Vec<[u16; 3]>,
    /// Named loops as vertex numbers.
    pub loops: BTreeMap<String, Vec<u16>>,
    /// Landmark id, name, vertex.
    pub landmarks: Vec<(String, String, u16)>,
    /// Sharp edges, each by its two vertices and how many double steps of √3 it stays sharp.
    pub creases: Vec<(u16, u16, f32)>,
    /// Limit positions that sharp edges decide.
    pub limits: Vec<LimitRow>,
    /// Control positions of the base head, in its proportions' frame and head units.
    pub base: Vec<[f32; 3]>,
}

/// Why a control mesh cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ControlError {
    /// The file is not RON of the right form.
    #[error("a baked asset:{0}")]
    Syntax(#[from] ron::error::SpannedError),
    /// Lists of unequal length, or a number out of range.
    #[error("assets/head.ron: `{0}` does not fit the {1} vertices of the half mesh")]
    Length(&'static str, usize),
    /// A vertex that the shape needs is not there.
    #[error("assets/head.ron: the shape needs a vertex `{0}`")]
    Missing(String),
    /// The charts of the skin do not fit the mesh.
    #[error("assets/head_uv.ron: `{0}` of a chart do not fit assets/head.ron: run `londra bake`")]
    Uv(&'static str),
    /// The mirrored mesh is no manifold.
    #[error("a baked asset: {0}")]
    Mesh(#[from] MeshError),
}

impl HalfMesh {
    /// Reads the text of `assets/head.ron`.
    ///
    /// # Errors
    /// Syntax with line and column, or the list that does not fit.
    pub fn parse(text: &str) -> Result<Self, ControlError> {
        let half: Self = ron::from_str(text)?;
        half.check()?;
        Ok(half)
    }

    fn check(&self) -> Result<(), ControlError> {
        let n = self.tags.len();
        let fits = [
            ("midline", self.midline.len() == n),
            ("regions", self.regions.len() == n),
            ("base", self.base.len() == n),
            ("faces", self.faces.iter().flatten().all(|&v| (v as usize) < n)),
            ("loops", self.loops.values().flatten().all(|&v| (v as usize) < n)),
            ("creases", self.creases.iter().all(|c| (c.0.max(c.1) as usize) < n)),
            ("limits", self.limits.iter().all(|(v, row)| (*v as usize) < n && row.iter().all(|s| (s.0 as usize) < n))),
            ("landmarks", self.landmarks.iter().all(|l| (l.2 as usize) < n)),
        ];
        match fits.iter().find(|f| !f.1) {
            Some((name, _)) => Err(ControlError::Length(name, n)),
            None => Ok(()),
        }
    }

    /// Number of vertices of the half.
    pub fn n_half(&self) -> usize {
        self.tags.len()
    }

    /// For each half vertex, its number on the other side in the whole mesh; itself on the midline.
    pub fn mirror(&self) -> Vec<u32> {
        mirror::images(&self.midline)
    }

    /// Triangles of the whole mesh: the half's, then their mirror images.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        mirror::triangles(&self.midline, &self.faces)
    }

    /// Sharp edges of the whole mesh: vertices and sharpness, each edge once.
    pub fn whole_creases(&self) -> impl Iterator<Item = (u32, u32, f32)> + '_ {
        let mirror = self.mirror();
        self.creases.iter().flat_map(move |&(a, b, sharpness)| {
            let image = (mirror[a as usize], mirror[b as usize]);
            let own = (u32::from(a), u32::from(b));
            // An edge in the median plane is its own image.
            let both = [Some(own), Some(image).filter(|&image| image != own)];
            both.into_iter().flatten().map(move |(a, b)| (a, b, sharpness))
        })
    }

    /// The whole mesh's connectivity.
    ///
    /// # Errors
    /// If it is not an oriented manifold.
    pub fn mesh(&self) -> Result<DedgeMesh, MeshError> {
        DedgeMesh::from_triangles(mirror::n_whole(&self.midline), &self.triangles())
    }

    /// Region of each vertex of the whole mesh.
    pub fn whole_regions(&self) -> Vec<Region> {
        let off = self.midline.iter().zip(&self.regions).filter(|(mid, _)| !**mid).map(|(_, r)| *r);
        self.regions.iter().copied().chain(off).collect()
    }

    /// Writes the whole mesh's values from the half's; `whole` has the length of the whole mesh.
    pub fn unfold(&self, half: &[Vec3], whole: &mut [Vec3]) {
        let n = self.n_half();
        whole[..n].copy_from_slice(half);
        let off = half.iter().zip(&self.midline).filter(|(_, mid)| !**mid);
        for (to, (p, _)) in whole[n..].iter_mut().zip(off) {
            *to = Vec3::new(-p.x, p.y, p.z);
        }
    }
}

/// Neighbours of each half vertex; across the median plane by mirror image.
#[derive(Clone, Debug)]
pub struct HalfRings {
    offsets: Vec<u32>,
    neighbours: Vec<u16>,
    across: Vec<bool>,
}

impl HalfRings {
    /// Collects neighbours in ascending order of number, own side first.
    pub fn new(half: &HalfMesh) -> Self {
        let mut rings: Vec<std::collections::BTreeSet<(bool, u16)>> = vec![Default::default(); half.n_half()];
        for f in &half.faces {
            for k in 0..3 {
                let (a, b, c) = (f[k] as usize, f[(k + 1) % 3], f[(k + 2) % 3]);
                for v in [b, c] {
                    rings[a].insert((false, v));
                    if half.midline[a] && !half.midline[v as usize] {
                        rings[a].insert((true, v));
                    }
                }
            }
        }
        let mut out = Self { offsets: vec![0], neighbours: Vec::new(), across: Vec::new() };
        for ring in rings {
            for (across, v) in ring {
                out.neighbours.push(v);
                out.across.push(across);
            }
            out.offsets.push(out.neighbours.len() as u32);
        }
        out
    }

    /// Neighbours of `v` and whether each stands on the other side.
    pub fn of(&self, v: usize) -> impl Iterator<Item = (usize, bool)> + '_ {
        let range = self.offsets[v] as usize..self.offsets[v + 1] as usize;
        self.neighbours[range.clone()].iter().zip(&self.across[range]).map(|(&n, &a)| (n as usize, a))
    }

    /// Number of neighbours of `v`, both sides.
    pub fn valence(&self, v: usize) -> usize {
        (self.offsets[v + 1] - self.offsets[v]) as usize
    }

    /// Mean of the neighbours' values.
    #[inline]
    pub fn mean(&self, v: usize, values: &[Vec3]) -> Vec3 {
        let mut sum = Vec3::ZERO;
        for (n, across) in self.of(v) {
            let p = values[n];
            sum += if across { Vec3::new(-p.x, p.y, p.z) } else { p };
        }
        sum / self.valence(v) as f32
    }
}
