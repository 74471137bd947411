//! Which schemes there are, and what a step of each does to the counts.

/// A subdivision scheme. The set is closed: it is matched exhaustively, and each scheme has its file of masks.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Scheme {
    /// √3 subdivision, Kobbelt 2000: three triangles for one.
    #[default]
    Sqrt3,
}

/// What a step of √3 does at the boundary. It alternates over the whole plan, from level 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BoundaryStep {
    /// Steps 0, 2, 4…: boundary edges and vertices stay as they are.
    Keep,
    /// Steps 1, 3, 5…: each boundary edge becomes three.
    Trisect,
}

impl BoundaryStep {
    /// The kind of step that leads from `level` to `level + 1`.
    pub fn from_level(level: u32) -> BoundaryStep {
        if level.is_multiple_of(2) { BoundaryStep::Keep } else { BoundaryStep::Trisect }
    }
}

impl Scheme {
    /// How many faces one face becomes in one step, on the boundary too.
    pub fn faces_per_face(self) -> u64 {
        match self {
            Scheme::Sqrt3 => 3,
        }
    }

    /// The name used in fingerprints and files; it never changes.
    pub fn name(self) -> &'static str {
        match self {
            Scheme::Sqrt3 => "sqrt3",
        }
    }
}
