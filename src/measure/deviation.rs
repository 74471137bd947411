//! How far a measurement is from what it is held against.

use super::{Dimension, Measurement};
use crate::anatomy::Reference;
use std::fmt;

/// A measurement less its reference. Prints as people compare such numbers: lengths in hundredths of the reference, indices,
/// angles and quotients in their own unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// In the unit of both.
    pub difference: f32,
    /// In hundredths of the reference; nothing for a reference of 0.
    pub percent: Option<f32>,
    dimension: Dimension,
}

impl Deviation {
    /// Of a measurement from a reference for the same quantity.
    pub fn of(measurement: &Measurement, reference: &Reference) -> Deviation {
        let known = reference.value as f32;
        let difference = measurement.value - known;
        let percent = (known != 0.0).then(|| 100.0 * difference / known);
        Deviation { difference, percent, dimension: measurement.dimension }
    }
}

impl fmt::Display for Deviation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.dimension, self.percent) {
            (Dimension::Millimetre, Some(percent)) => write!(f, "{percent:+.1} %"),
            (dimension, _) => {
                let (decimals, unit) = (dimension.decimals(), dimension.unit());
                write!(f, "{:+.decimals$}{}{unit}", self.difference, if unit.is_empty() { "" } else { " " })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::{Quantity, Status};
    use crate::measure::Tissue;

    #[test]
    fn a_deviation_is_told_in_another_unit_than_people_compare_in() {
        let told = |id: &'static str, dimension, value, known| {
            let measurement = Measurement { id, label: "", definition: "", tissue: Tissue::Bone, dimension, value };
            let quantity = Quantity::from_id(id).unwrap();
            let reference = Reference { quantity, value: known, status: Status::Estimated, source: "s".into() };
            Deviation::of(&measurement, &reference).to_string()
        };
        assert_eq!(told("skull_length", Dimension::Millimetre, 198.0, 200.0), "-1.0 %");
        assert_eq!(told("skull_index", Dimension::Percent, 54.3, 54.0), "+0.3");
        assert_eq!(told("craniofacial_ratio", Dimension::Ratio, 0.5, 0.0), "+0.50");
        assert_eq!(told("orbital_angle", Dimension::Degree, 50.0, 52.0), "-2.0 deg");
    }
}
