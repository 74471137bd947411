//! The two pigments of hair as breeders speak of them, and what is painted with them.
//!
//! Eumelanin is black; the genes B and D make it brown, blue or both, and nose, lids and lips share it. Phaeomelanin is
//! red; how much of it there is runs from cream to mahogany. White is hair without either. The colours themselves are
//! estimates.

use super::colour;
use glam::Vec3;

/// What a dog's eumelanin looks like.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Eumelanin {
    /// Neither brown nor dilute.
    #[default]
    Black,
    /// Brown, liver, chocolate: b/b.
    Brown,
    /// Dilute black: d/d.
    Blue,
    /// Dilute brown, isabella: b/b d/d.
    Lilac,
}

/// The colours that eumelanin gives, sRGB.
struct Shades {
    hair: [u8; 3],
    nose: [u8; 3],
    lips: [u8; 3],
    iris: [u8; 3],
}

impl Eumelanin {
    /// Every form.
    pub const ALL: [Self; 4] = [Self::Black, Self::Brown, Self::Blue, Self::Lilac];

    /// The word used in files.
    pub fn name(self) -> &'static str {
        match self {
            Self::Black => "Black",
            Self::Brown => "Brown",
            Self::Blue => "Blue",
            Self::Lilac => "Lilac",
        }
    }

    /// The form of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|e| e.name() == name)
    }

    fn shades(self) -> Shades {
        let (hair, nose, lips, iris) = match self {
            Self::Black => ([0x1c, 0x18, 0x17], [0x24, 0x1f, 0x1e], [0x2a, 0x22, 0x21], [0x3f, 0x24, 0x12]),
            Self::Brown => ([0x47, 0x28, 0x19], [0x54, 0x36, 0x28], [0x60, 0x3e, 0x30], [0x85, 0x56, 0x26]),
            Self::Blue => ([0x53, 0x57, 0x5e], [0x3f, 0x40, 0x45], [0x48, 0x47, 0x4c], [0x6e, 0x60, 0x48]),
            Self::Lilac => ([0x8c, 0x7f, 0x76], [0x62, 0x50, 0x4b], [0x6b, 0x57, 0x53], [0xa0, 0x8a, 0x5a]),
        };
        Shades { hair, nose, lips, iris }
    }

    /// The leather of the nose, linear.
    pub fn nose(self) -> Vec3 {
        colour::from_srgb8(self.shades().nose)
    }

    /// The bare margins of lips and lids, linear.
    pub fn lips(self) -> Vec3 {
        colour::from_srgb8(self.shades().lips)
    }

    /// The iris, linear.
    pub fn iris(self) -> Vec3 {
        colour::from_srgb8(self.shades().iris)
    }
}

/// What a dog paints with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pigments {
    /// The dark one.
    pub eumelanin: Eumelanin,
    /// How intense the red one is: 0 cream, 0.5 fawn, 1 mahogany.
    pub phaeomelanin: f32,
}

impl Default for Pigments {
    fn default() -> Self {
        Self { eumelanin: Eumelanin::Black, phaeomelanin: 0.5 }
    }
}

/// What is put on hair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Paint {
    /// A colour, linear, each channel 0 to 1.
    Colour(Vec3),
    /// The dog's dark pigment.
    Eumelanin,
    /// The dog's red pigment, at its own intensity or at another, 0 to 1.
    Phaeomelanin(Option<f32>),
    /// No pigment.
    White,
}

/// Phaeomelanin at even steps of intensity, sRGB.
const REDS: [[u8; 3]; 5] =
    [[0xf0, 0xe3, 0xcb], [0xda, 0xbd, 0x90], [0xb5, 0x8c, 0x5e], [0x89, 0x57, 0x33], [0x59, 0x2c, 0x1c]];

/// Hair without pigment, sRGB: a little yellow, as white dogs are.
const WHITE: [u8; 3] = [0xf2, 0xee, 0xe6];

impl Pigments {
    /// The colour of a paint, linear.
    pub fn colour(&self, paint: Paint) -> Vec3 {
        match paint {
            Paint::Colour(colour) => colour,
            Paint::Eumelanin => colour::from_srgb8(self.eumelanin.shades().hair),
            Paint::Phaeomelanin(intensity) => red(intensity.unwrap_or(self.phaeomelanin)),
            Paint::White => colour::from_srgb8(WHITE),
        }
    }
}

fn red(intensity: f32) -> Vec3 {
    let place = intensity.clamp(0.0, 1.0) * (REDS.len() - 1) as f32;
    let step = (place as usize).min(REDS.len() - 2);
    let [pale, deep] = [REDS[step], REDS[step + 1]].map(colour::from_srgb8);
    pale.lerp(deep, place - step as f32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_phaeomelanin_is_never_paler() {
        let shades: Vec<Vec3> = (0..=20).map(|i| red(i as f32 / 20.0)).collect();
        assert!(shades.windows(2).all(|w| w[1].cmplt(w[0]).all()), "{shades:?}");
    }
}
