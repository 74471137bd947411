//! How strongly each unit is asked for, left and right.

use super::UnitTable;

/// On which side of the head.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, serde::Serialize, serde::Deserialize)]
pub enum Side {
    /// On both.
    #[default]
    Both,
    /// The dog's left.
    Left,
    /// The dog's right.
    Right,
}

impl Side {
    /// What stands behind an id: nothing, `L` or `R`.
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::Both => "",
            Self::Left => "L",
            Self::Right => "R",
        }
    }

    /// A pair, left and right, with another value on this side.
    pub const fn put(self, [left, right]: [f32; 2], value: f32) -> [f32; 2] {
        match self {
            Self::Both => [value; 2],
            Self::Left => [value, right],
            Self::Right => [left, value],
        }
    }
}

/// A value 0 to 1 for each unit and side, by the number of the unit in its table; nothing by default.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Activation([[f32; 2]; UnitTable::MOST]);

impl Default for Activation {
    fn default() -> Self {
        Self([[0.0; 2]; UnitTable::MOST])
    }
}

impl Activation {
    /// Left and right of a unit.
    pub fn get(&self, unit: usize) -> [f32; 2] {
        self.0[unit]
    }

    /// The larger of both sides of a unit.
    pub fn most(&self, unit: usize) -> f32 {
        let [left, right] = self.0[unit];
        left.max(right)
    }

    /// Left and right of a unit, to be written.
    pub fn get_mut(&mut self, unit: usize) -> &mut [f32; 2] {
        &mut self.0[unit]
    }

    /// Another value of a unit on one side or both.
    pub fn set(&mut self, unit: usize, side: Side, value: f32) {
        self.0[unit] = side.put(self.0[unit], value);
    }

    /// Adds another one, each value times `weight`.
    pub fn add(&mut self, other: &Self, weight: f32) {
        for (mine, theirs) in self.0.iter_mut().flatten().zip(other.0.iter().flatten()) {
            *mine += weight * theirs;
        }
    }

    /// Every value brought into 0 to 1; what is no number is 0.
    #[must_use]
    pub fn clamped(mut self) -> Self {
        for value in self.0.iter_mut().flatten() {
            *value = if value.is_nan() { 0.0 } else { value.clamp(0.0, 1.0) };
        }
        self
    }

    /// Whether nothing is asked for.
    pub fn is_rest(&self) -> bool {
        *self == Self::default()
    }
}
