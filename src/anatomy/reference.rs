//! What a breed is held against: numbers from outside the program, each with how it came about and where it is from.

use std::fmt;

/// Something about a dog's head that a reference can be given for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quantity {
    /// Short name: that of `londra measure` where the program measures it.
    pub id: &'static str,
    /// Behind a number; empty for a pure one.
    pub unit: &'static str,
    /// No dog or wolf is below; in the unit.
    pub min: f64,
    /// Nor above.
    pub max: f64,
}

const fn quantity(id: &'static str, unit: &'static str, min: f64, max: f64) -> Quantity {
    Quantity { id, unit, min, max }
}

/// Every quantity: what the calliper measures, in its order, and the mass, which no head tells.
///
/// The ranges are wide: they are there to find a slip of the pen or of the unit, not to judge a source.
pub const QUANTITIES: &[Quantity] = &[
    quantity("skull_length", "mm", 40.0, 400.0),
    quantity("facial_length", "mm", 5.0, 250.0),
    quantity("cranial_length", "mm", 30.0, 250.0),
    quantity("zygomatic_width", "mm", 20.0, 250.0),
    quantity("cranial_width", "mm", 20.0, 150.0),
    quantity("cranial_height", "mm", 20.0, 150.0),
    quantity("mandible_length", "mm", 20.0, 350.0),
    quantity("condylobasal_length", "mm", 40.0, 400.0),
    quantity("palatal_length", "mm", 10.0, 250.0),
    quantity("palatal_width", "mm", 10.0, 200.0),
    quantity("skull_index", "", 25.0, 130.0),
    quantity("cranial_index", "", 25.0, 130.0),
    quantity("facial_index", "", 40.0, 600.0),
    quantity("s_index", "", 0.05, 2.5),
    quantity("lw_index", "", 0.7, 4.0),
    quantity("orbital_angle", "deg", 20.0, 80.0),
    quantity("craniofacial_ratio", "", 0.0, 1.6),
    quantity("muzzle_length", "mm", 1.0, 250.0),
    quantity("live_cranial_length", "mm", 30.0, 300.0),
    quantity("head_length", "mm", 40.0, 500.0),
    quantity("head_width", "mm", 30.0, 300.0),
    quantity("medial_canthi", "mm", 5.0, 120.0),
    quantity("lateral_canthi", "mm", 15.0, 200.0),
    quantity("fissure_length", "mm", 5.0, 70.0),
    quantity("globe_diameter", "mm", 8.0, 40.0),
    quantity("overjet", "mm", -40.0, 30.0),
    quantity("body_mass", "kg", 0.5, 130.0),
];

impl Quantity {
    /// The quantity of that id.
    pub fn from_id(id: &str) -> Option<&'static Quantity> {
        QUANTITIES.iter().find(|quantity| quantity.id == id)
    }
}

/// How a reference came about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
    /// On specimens or on live dogs.
    Measured,
    /// From other numbers, by a rule that the source states.
    Computed,
    /// From breed standards, class averages, or by eye.
    Estimated,
}

impl Status {
    /// All, the firmest first.
    pub const ALL: [Status; 3] = [Status::Measured, Status::Computed, Status::Estimated];

    /// The word in files.
    pub fn name(self) -> &'static str {
        match self {
            Status::Measured => "measured",
            Status::Computed => "computed",
            Status::Estimated => "estimated",
        }
    }

    /// The status with that word.
    pub fn from_name(name: &str) -> Option<Status> {
        Status::ALL.into_iter().find(|status| status.name() == name)
    }
}

impl fmt::Display for Status {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// One number from outside the program.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// Of what.
    pub quantity: &'static Quantity,
    /// In the unit of the quantity.
    pub value: f64,
    /// How it came about.
    pub status: Status,
    /// Who measured what, by which rule, or how it was guessed.
    pub source: String,
}
