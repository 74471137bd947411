//! One row of the table of measures.

/// The unit of a measure in files, sliders and on the command line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Ids end in `_mm`; metres inside.
    Millimetre,
    /// Ids end in `_deg`; radians inside.
    Degree,
    /// Ids end in `_weeks`; weeks inside.
    Week,
    /// Ids end in `_kg`; kilograms inside.
    Kilogram,
    /// A pure number; ids end in none of these.
    Ratio,
}

impl Unit {
    /// Name in `rigs/anatomy.ron`: `mm`, `deg`, `weeks`, `kg` or `ratio`.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Millimetre => "mm",
            Self::Degree => "deg",
            Self::Week => "weeks",
            Self::Kilogram => "kg",
            Self::Ratio => "ratio",
        }
    }

    /// All units.
    pub const ALL: [Unit; 5] = [Self::Millimetre, Self::Degree, Self::Week, Self::Kilogram, Self::Ratio];

    /// What stands behind a number on the screen: ` mm`, `°`, ` weeks`, ` kg` or nothing.
    pub const fn suffix(self) -> &'static str {
        match self {
            Self::Millimetre => " mm",
            Self::Degree => "°",
            Self::Week => " weeks",
            Self::Kilogram => " kg",
            Self::Ratio => "",
        }
    }

    /// The unit that an id's ending tells.
    pub fn of_id(id: &str) -> Self {
        match id.rsplit_once('_') {
            Some((_, "mm")) => Self::Millimetre,
            Some((_, "deg")) => Self::Degree,
            Some((_, "weeks")) => Self::Week,
            Some((_, "kg")) => Self::Kilogram,
            _ => Self::Ratio,
        }
    }

    /// File units to metres, radians, weeks, kilograms or a pure number.
    pub fn to_si(self, value: f64) -> f32 {
        let si = match self {
            Self::Millimetre => value / 1000.0,
            Self::Degree => value.to_radians(),
            Self::Week | Self::Kilogram | Self::Ratio => value,
        };
        si as f32
    }

    /// The number with the fewest digits, in file units, that [`Unit::to_si`] turns into exactly `si`.
    ///
    /// This is what files are written with and what sliders show. A value that is not finite comes back as it is.
    pub fn from_si(self, si: f32) -> f64 {
        let wide = f64::from(si);
        let value = match self {
            Self::Millimetre => wide * 1000.0,
            Self::Degree => wide.to_degrees(),
            Self::Week | Self::Kilogram | Self::Ratio => wide,
        };
        shortest(value, |candidate| self.to_si(candidate).to_bits() == si.to_bits())
    }
}

/// The number with the fewest digits near `value` that is still `good`; `value` itself if none is.
pub(super) fn shortest(value: f64, good: impl Fn(f64) -> bool) -> f64 {
    let candidates = (0..17).filter_map(|digits| format!("{value:.digits$e}").parse().ok());
    candidates.into_iter().find(|&c| good(c)).unwrap_or(value)
}

/// How a value that nobody has set moves with another one.
///
/// value = default · (other / other's default)^exponent, cut off at the ends of the range.
#[derive(Clone, Debug, PartialEq)]
pub struct Follow {
    /// The id of the one that is followed.
    pub id: String,
    /// 1 keeps the proportion; 0.3 is a weak pull, as an eyeball's size follows the skull's.
    pub exponent: f64,
}

/// A measure of the head: what it is called, how far it goes, what it moves.
#[derive(Clone, Debug, PartialEq)]
pub struct ParamSpec {
    /// Key in files and of `--set`, unique; lower-case letters, digits and `_`; ends in the unit.
    pub id: String,
    /// Name on the screen.
    pub label: String,
    /// Heading it stands under.
    pub group: String,
    /// Unit of `min`, `max`, `default` and of files.
    pub unit: Unit,
    /// Lowest value, in file units.
    pub min: f64,
    /// Highest value, in file units.
    pub max: f64,
    /// Value of a head of which nothing is known, in file units, within the range.
    pub default: f64,
    /// What of the head moves with it, in words.
    pub moves: String,
    /// How it is measured, in words.
    pub help: String,
    /// Where range and default come from.
    pub source: String,
    /// Other words under which people look for it.
    pub synonyms: Vec<String>,
    /// What it follows as long as nobody has set it.
    pub follows: Option<Follow>,
}

impl ParamSpec {
    /// File units to SI; see [`Unit::to_si`].
    pub fn to_si(&self, value: f64) -> f32 {
        self.unit.to_si(value)
    }

    /// SI to file units; see [`Unit::from_si`].
    pub fn from_si(&self, si: f32) -> f64 {
        self.unit.from_si(si)
    }

    /// Lowest value, SI.
    pub fn min_si(&self) -> f32 {
        self.to_si(self.min)
    }

    /// Highest value, SI.
    pub fn max_si(&self) -> f32 {
        self.to_si(self.max)
    }

    /// Default value, SI.
    pub fn default_si(&self) -> f32 {
        self.to_si(self.default)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn si_bits_survive_the_way_to_the_file_and_back() {
        let mut bits = 0x1234_5678_u32;
        for unit in [Unit::Millimetre, Unit::Degree, Unit::Ratio] {
            for _ in 0..2000 {
                bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
                let si = (bits >> 8) as f32 / (1 << 24) as f32 * 0.7 - 0.2;
                let text = format!("{:?}", unit.from_si(si));
                assert_eq!(unit.to_si(text.parse().unwrap()).to_bits(), si.to_bits());
            }
        }
    }

    #[test]
    fn what_a_person_has_written_is_what_is_written_back() {
        for value in [106.0, 92.5, 0.1, 150.0, 33.333, -12.0, 0.0, 45.0] {
            for unit in [Unit::Millimetre, Unit::Degree, Unit::Ratio] {
                assert_eq!(unit.from_si(unit.to_si(value)), value);
            }
        }
    }

    #[test]
    fn an_id_tells_its_unit() {
        assert_eq!(Unit::of_id("muzzle_length_mm"), Unit::Millimetre);
        assert_eq!(Unit::of_id("stop_angle_deg"), Unit::Degree);
        assert_eq!(Unit::of_id("ear_fold"), Unit::Ratio);
        assert_eq!(Unit::of_id("mm"), Unit::Ratio);
    }
}
