//! Masks: the weights of a rule over a neighbourhood. A mask knows no mesh.

/// A vertex from itself and all its neighbours alike.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RingMask {
    /// Weight of the vertex itself.
    pub centre: f64,
    /// Weight of each neighbour.
    pub neighbour: f64,
}

/// A point of a curve from three successive points of the coarser curve. The weights add up to one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveMask {
    /// Weight of the point before, against the direction of the curve.
    pub before: f64,
    /// Weight of the middle one.
    pub centre: f64,
    /// Weight of the point after.
    pub after: f64,
}

impl CurveMask {
    /// The mask for the curve run through the other way.
    pub const fn reversed(self) -> CurveMask {
        CurveMask { before: self.after, centre: self.centre, after: self.before }
    }
}
