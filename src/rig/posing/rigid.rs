//! A turn and a shift.

use glam::{Mat3, Vec3};

/// Takes a point `p` to `turn * p + shift`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rigid {
    /// A rotation.
    pub turn: Mat3,
    /// Metres.
    pub shift: Vec3,
}

impl Default for Rigid {
    fn default() -> Self {
        Self { turn: Mat3::IDENTITY, shift: Vec3::ZERO }
    }
}

impl Rigid {
    /// A turn about a point, then a shift.
    pub fn about(pivot: Vec3, turn: Mat3, shift: Vec3) -> Self {
        Self { turn, shift: pivot + shift - turn * pivot }
    }

    /// Where a point goes.
    pub fn point(&self, p: Vec3) -> Vec3 {
        self.turn * p + self.shift
    }

    /// Where a direction goes.
    pub fn direction(&self, d: Vec3) -> Vec3 {
        self.turn * d
    }

    /// First the other, then this.
    #[must_use]
    pub fn after(&self, first: &Rigid) -> Rigid {
        Rigid { turn: self.turn * first.turn, shift: self.turn * first.shift + self.shift }
    }

    /// Where a point came from.
    pub fn back(&self, p: Vec3) -> Vec3 {
        self.turn.transpose() * (p - self.shift)
    }

    /// Whether nothing moves.
    pub fn is_rest(&self) -> bool {
        *self == Self::default()
    }

    /// Moves positions and normals, unless nothing moves: then they keep their bits.
    pub fn carry(&self, positions: &mut [Vec3], normals: &mut [Vec3]) {
        if !self.is_rest() {
            positions.iter_mut().for_each(|p| *p = self.point(*p));
            normals.iter_mut().for_each(|n| *n = self.direction(*n));
        }
    }
}
