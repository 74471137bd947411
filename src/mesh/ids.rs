//! Numbers that cannot be mistaken for each other.

macro_rules! id {
    ($(#[$doc:meta])* $name:ident, $letter:literal) => {
        $(#[$doc])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(transparent)]
        pub struct $name(pub u32);

        impl $name {
            /// The number as an index into an array with one entry for each.
            #[inline(always)]
            pub fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl std::fmt::Display for $name {
            fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                write!(f, concat!($letter, "{}"), self.0)
            }
        }
    };
}

id!(
    /// A vertex, from 0 to the number of vertices. Printed as `v7`.
    VertexId,
    "v"
);
id!(
    /// A triangle, from 0 to the number of faces. Printed as `f7`.
    FaceId,
    "f"
);
id!(
    /// A directed edge, one side of one triangle: `3f + k` is side `k` of face `f`. Printed as `d7`.
    DedgeId,
    "d"
);

impl DedgeId {
    /// The triangle that this is a side of.
    #[inline(always)]
    pub fn face(self) -> FaceId {
        FaceId(self.0 / 3)
    }

    /// The side after this one, counter-clockwise in the same triangle.
    #[inline(always)]
    pub fn next(self) -> Self {
        Self(if self.0 % 3 == 2 { self.0 - 2 } else { self.0 + 1 })
    }

    /// The side before this one in the same triangle.
    #[inline(always)]
    pub fn prev(self) -> Self {
        Self(if self.0.is_multiple_of(3) { self.0 + 2 } else { self.0 - 1 })
    }
}

impl FaceId {
    /// Side `side` (0, 1 or 2) of this triangle.
    #[inline(always)]
    pub fn dedge(self, side: u32) -> DedgeId {
        debug_assert!(side < 3);
        DedgeId(3 * self.0 + side)
    }
}
