//! What every format is read into and written from.

use std::collections::{BTreeMap, BTreeSet, HashMap};

/// A mesh as a file has it: positions, polygons, tags; nothing proven about it yet.
///
/// Units and axes are those of the file. A reader's result is consistent ([`Soup::validate`]); whether it is a surface
/// is for the connectivity to say.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Soup {
    /// In the order of the file, after welding where the format has no identity of its own. Readers take only what a
    /// finite 32-bit float can hold.
    pub positions: Vec<[f64; 3]>,
    /// Corners of each face, 3 or more.
    pub face_sizes: Vec<u32>,
    /// Vertex numbers from 0, face after face, counter-clockwise from outside; as many as the face sizes' sum.
    pub corners: Vec<u32>,
    /// Texture coordinates (`vt` of OBJ); empty where the file has none.
    pub uvs: Vec<[f64; 2]>,
    /// As `corners`, into `uvs`; empty where any corner has none.
    pub uv_corners: Vec<u32>,
    /// An edge by its two vertices, and its sharpness, above 0; [`f32::INFINITY`] for 10 or more. Each edge once.
    pub creases: Vec<(u32, u32, f32)>,
    /// Sharp vertices ("corners" of a subdivision surface), and their sharpness, likewise.
    pub point_creases: Vec<(u32, f32)>,
    /// Faces that are tagged as not there: they shape the surface and are not drawn. Ascending.
    pub holes: Vec<u32>,
}

/// What makes a soup inconsistent.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SoupError {
    /// A face that is none.
    #[error("face {face} has {size} corners; 3 are the least")]
    FaceSize {
        /// The face, from 0.
        face: usize,
        /// Its corners.
        size: u32,
    },
    /// `face_sizes` and `corners`, or `corners` and `uv_corners`, do not fit together.
    #[error("the faces have {expected} corners, and there are {found} {what}")]
    CornerCount {
        /// The sum of the sizes.
        expected: usize,
        /// How many there are.
        found: usize,
        /// `corners` or `uv_corners`.
        what: &'static str,
    },
    /// A number that names nothing.
    #[error("{what} {index} does not exist: there are {count}, counted from 0")]
    OutOfRange {
        /// Which kind of number.
        what: &'static str,
        /// The number.
        index: u32,
        /// How many there are.
        count: usize,
    },
    /// A position that no finite 32-bit float holds.
    #[error("vertex {vertex} is at {position:?}, which is not finite in 32 bits")]
    NotFinite {
        /// The vertex, from 0.
        vertex: usize,
        /// Where it is.
        position: [f64; 3],
    },
}

impl Soup {
    /// A soup of triangles without tags.
    pub fn from_triangles(positions: Vec<[f64; 3]>, triangles: &[[u32; 3]]) -> Self {
        Self {
            positions,
            face_sizes: vec![3; triangles.len()],
            corners: triangles.as_flattened().to_vec(),
            ..Self::default()
        }
    }

    /// The vertex numbers of each face.
    ///
    /// # Panics
    /// Where `corners` has fewer than the sizes' sum; [`Soup::validate`] tells.
    pub fn faces(&self) -> impl Iterator<Item = &[u32]> {
        let mut rest = &self.corners[..];
        self.face_sizes.iter().map(move |&size| {
            let (face, after) = rest.split_at(size as usize);
            rest = after;
            face
        })
    }

    /// Whether every face has three corners.
    pub fn is_triangles(&self) -> bool {
        self.face_sizes.iter().all(|&size| size == 3)
    }

    /// The faces, holes included, each cut into a fan from its first corner: right for convex ones.
    ///
    /// # Panics
    /// As [`Soup::faces`].
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let n = self.corners.len().saturating_sub(2 * self.face_sizes.len());
        let mut triangles = Vec::with_capacity(n);
        triangles.extend(self.faces().flat_map(fan));
        triangles
    }

    /// Without the vertices that no face uses, and without their tags. The order stays.
    ///
    /// # Panics
    /// Where a corner or a tag names no vertex; [`Soup::validate`] tells.
    #[must_use]
    pub fn without_unused(mut self) -> Self {
        let mut used = vec![false; self.positions.len()];
        for &vertex in &self.corners {
            used[vertex as usize] = true;
        }
        self.creases.retain(|&(a, b, _)| used[a as usize] && used[b as usize]);
        self.point_creases.retain(|&(vertex, _)| used[vertex as usize]);
        let mut n = 0;
        let number = |&used: &bool| {
            n += u32::from(used);
            // Of an unused vertex the number is never looked at.
            n.saturating_sub(1)
        };
        let renumbered: Vec<u32> = used.iter().map(number).collect();
        self.renumber(&renumbered);
        let mut used = used.iter();
        self.positions.retain(|_| used.next() == Some(&true));
        self
    }

    /// Makes one vertex of all that have the same position, bit for bit, where -0 is 0. The first of each stays.
    ///
    /// Corners that meet their neighbour on the way go, and so do faces that keep fewer than three and edges that
    /// keep no length: a sliver whose corners are the same point is no face. Of two tags that come to lie on one edge
    /// or vertex, the later holds.
    ///
    /// # Panics
    /// As [`Soup::without_unused`].
    pub fn weld(&mut self) {
        let mut numbers: HashMap<[u64; 3], u32> = HashMap::with_capacity(self.positions.len() / 4);
        let mut renumbered = Vec::with_capacity(self.positions.len());
        let mut kept = 0;
        for i in 0..self.positions.len() {
            let position = self.positions[i];
            // Adding 0 turns -0 into 0 and leaves every other number alone.
            let key = position.map(|x| (x + 0.0).to_bits());
            let number = *numbers.entry(key).or_insert(kept as u32);
            if number == kept as u32 {
                self.positions[kept] = position;
                kept += 1;
            }
            renumbered.push(number);
        }
        self.positions.truncate(kept);
        self.renumber(&renumbered);
        self.drop_collapsed();
        self.creases.retain(|(a, b, _)| a != b);
        self.settle_tags();
    }

    /// Appends another soup, whose vertices and faces get the numbers after these. Texture coordinates of the corners
    /// are kept where both have them.
    ///
    /// # Errors
    /// None, where the two together have more vertices, faces or texture coordinates than 32 bits count; this one is
    /// left as it was.
    #[must_use]
    pub fn append(&mut self, other: &Self) -> Option<()> {
        let count = |mine: usize, more: usize| u32::try_from(mine.checked_add(more)?).ok().map(|_| mine as u32);
        let vertex = count(self.positions.len(), other.positions.len())?;
        let face = count(self.face_sizes.len(), other.face_sizes.len())?;
        let uv = count(self.uvs.len(), other.uvs.len())?;
        if self.uv_corners.len() == self.corners.len() && other.uv_corners.len() == other.corners.len() {
            self.uv_corners.extend(other.uv_corners.iter().map(|i| i + uv));
        } else {
            self.uv_corners.clear();
        }
        self.uvs.extend(&other.uvs);
        self.positions.extend(&other.positions);
        self.face_sizes.extend(&other.face_sizes);
        self.corners.extend(other.corners.iter().map(|i| i + vertex));
        self.creases.extend(other.creases.iter().map(|&(a, b, sharpness)| (a + vertex, b + vertex, sharpness)));
        self.point_creases.extend(other.point_creases.iter().map(|&(i, sharpness)| (i + vertex, sharpness)));
        self.holes.extend(other.holes.iter().map(|i| i + face));
        Some(())
    }

    /// Whether sizes, numbers and positions fit together. It does not ask whether the faces are a surface.
    ///
    /// # Errors
    /// The first that does not fit.
    pub fn validate(&self) -> Result<(), SoupError> {
        if let Some(face) = self.face_sizes.iter().position(|&size| size < 3) {
            return Err(SoupError::FaceSize { face, size: self.face_sizes[face] });
        }
        let expected = self.face_sizes.iter().map(|&size| size as usize).sum();
        let uv_corners = if self.uv_corners.is_empty() { expected } else { self.uv_corners.len() };
        for (what, found) in [("corners", self.corners.len()), ("uv_corners", uv_corners)] {
            if found != expected {
                return Err(SoupError::CornerCount { expected, found, what });
            }
        }
        let n = self.positions.len();
        in_range("vertex", &self.corners, n)?;
        in_range("uv", &self.uv_corners, self.uvs.len())?;
        in_range("hole", &self.holes, self.face_sizes.len())?;
        for &(a, b, _) in &self.creases {
            in_range("vertex of a crease", &[a, b], n)?;
        }
        for &(vertex, _) in &self.point_creases {
            in_range("sharp vertex", &[vertex], n)?;
        }
        match self.positions.iter().position(|p| !p.iter().all(|&x| fits_f32(x))) {
            Some(vertex) => Err(SoupError::NotFinite { vertex, position: self.positions[vertex] }),
            None => Ok(()),
        }
    }

    /// The faces that are not tagged as holes.
    pub(super) fn solid_faces(&self) -> impl Iterator<Item = &[u32]> {
        let holes: BTreeSet<u32> = self.holes.iter().copied().collect();
        self.faces().enumerate().filter(move |(i, _)| !holes.contains(&(*i as u32))).map(|(_, face)| face)
    }

    /// Each edge and each vertex has one tag, the last that names it, at the place of the first; sharpness 0 is no tag.
    pub(super) fn settle_tags(&mut self) {
        let mut edges: BTreeMap<_, f32> = self.creases.iter().map(|&(a, b, s)| (edge(a, b), s)).collect();
        self.creases.retain_mut(|(a, b, sharpness)| {
            edges.remove(&edge(*a, *b)).inspect(|last| *sharpness = *last).is_some_and(|s| s > 0.0)
        });
        let mut vertices: BTreeMap<u32, f32> = self.point_creases.iter().copied().collect();
        self.point_creases.retain_mut(|(vertex, sharpness)| {
            vertices.remove(vertex).inspect(|last| *sharpness = *last).is_some_and(|s| s > 0.0)
        });
    }

    /// `numbers` has the new number of each vertex.
    fn renumber(&mut self, numbers: &[u32]) {
        let new = |vertex: &mut u32| *vertex = numbers[*vertex as usize];
        self.corners.iter_mut().for_each(new);
        self.creases.iter_mut().for_each(|(a, b, _)| {
            new(a);
            new(b);
        });
        self.point_creases.iter_mut().for_each(|(vertex, _)| new(vertex));
    }

    /// Drops corners that are the same vertex as the next around their face, and faces that keep fewer than three.
    fn drop_collapsed(&mut self) {
        let corners = std::mem::take(&mut self.corners);
        let uv_corners = std::mem::take(&mut self.uv_corners);
        let sizes = std::mem::take(&mut self.face_sizes);
        let holes: BTreeSet<u32> = self.holes.drain(..).collect();
        let mut start = 0;
        for (face, size) in sizes.into_iter().enumerate() {
            let end = start + size as usize;
            let kept_before = self.corners.len();
            for i in start..end {
                let next = if i + 1 == end { start } else { i + 1 };
                if corners[i] != corners[next] {
                    self.corners.push(corners[i]);
                    self.uv_corners.extend(uv_corners.get(i));
                }
            }
            start = end;
            let kept = self.corners.len() - kept_before;
            if kept < 3 {
                self.corners.truncate(kept_before);
                self.uv_corners.truncate(kept_before);
                continue;
            }
            if holes.contains(&(face as u32)) {
                self.holes.push(self.face_sizes.len() as u32);
            }
            self.face_sizes.push(kept as u32);
        }
    }
}

/// An edge whichever way it is named.
pub(super) fn edge(a: u32, b: u32) -> (u32, u32) {
    (a.min(b), a.max(b))
}

/// A face as triangles around its first corner.
pub(super) fn fan(face: &[u32]) -> impl Iterator<Item = [u32; 3]> {
    face.get(1..).unwrap_or_default().windows(2).map(|pair| [face[0], pair[0], pair[1]])
}

/// Whether a number is finite and stays so in 32 bits, in which the engine and most formats hold it.
pub(super) fn fits_f32(x: f64) -> bool {
    (x as f32).is_finite()
}

fn in_range(what: &'static str, indices: &[u32], count: usize) -> Result<(), SoupError> {
    match indices.iter().find(|&&index| index as usize >= count) {
        Some(&index) => Err(SoupError::OutOfRange { what, index, count }),
        None => Ok(()),
    }
}
