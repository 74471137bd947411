//! Ways of showing a head: which lights, what they fall on, before what.

use super::ground_pass::Background;
use super::lights::Lights;
use crate::frame::Layers;
use std::str::FromStr;
use thiserror::Error;

/// A way of showing a head.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Preset {
    /// A portrait studio: key, fill and rim light, a soft sky.
    #[default]
    Studio,
    /// The sun and a blue sky.
    Daylight,
    /// The head as one matt clay without hair: shape alone.
    Clay,
    /// Flat, even light before plain paper: what is measured on a picture.
    Plate,
    /// Bone and teeth through the skin.
    XRay,
    /// Black on white without hair: outlines to compare.
    Silhouette,
}

/// A word that names no preset.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("`{0}` is no preset; there are {names}", names = Preset::ALL.map(Preset::name).join(", "))]
pub struct PresetError(String);

/// What surfaces are made of, instead of what they are: the numbers of `light.wgsl`.
#[repr(u8)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stuff {
    /// What they are.
    Own,
    /// One matt colour.
    Clay,
    /// Ink, which no light changes.
    Ink,
}

impl Preset {
    /// Every preset, in the order of the help text.
    pub const ALL: [Self; 6] = [Self::Studio, Self::Daylight, Self::Clay, Self::Plate, Self::XRay, Self::Silhouette];

    /// The name it is asked for by.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Studio => "studio",
            Self::Daylight => "daylight",
            Self::Clay => "clay",
            Self::Plate => "plate",
            Self::XRay => "x-ray",
            Self::Silhouette => "silhouette",
        }
    }

    /// What it shows, for people.
    pub const fn about(self) -> &'static str {
        match self {
            Self::Studio => "Key, fill and rim light of a portrait studio",
            Self::Daylight => "Sun and sky",
            Self::Clay => "One matt colour without hair",
            Self::Plate => "Flat, even light before plain paper, for measuring",
            Self::XRay => "Bone and teeth through the skin",
            Self::Silhouette => "Black on white, for outlines",
        }
    }

    /// One colour behind the head, sRGB.
    pub const fn plain(self) -> Background {
        Background::Plain(match self {
            Self::Studio => [0x7e, 0x7d, 0x7a],
            Self::Daylight => [0xa9, 0xb6, 0xc0],
            Self::Clay => [0x8c, 0x8c, 0x8e],
            Self::Plate => [0xe4, 0xe4, 0xe2],
            Self::XRay => [0x16, 0x19, 0x1e],
            Self::Silhouette => [0xff; 3],
        })
    }

    /// Two colours behind the head, from the upper edge to the lower, sRGB.
    pub fn gradient(self) -> Background {
        let (top, bottom) = match self {
            Self::Studio => return Background::default(),
            Self::Daylight => ([0x9d, 0xb4, 0xc8], [0xb9, 0xb6, 0xa6]),
            Self::Clay => ([0x9c, 0x9c, 0x9e], [0x76, 0x76, 0x78]),
            Self::Plate => ([0xee, 0xee, 0xec], [0xd6, 0xd6, 0xd4]),
            Self::XRay => ([0x20, 0x25, 0x2c], [0x0d, 0x0f, 0x12]),
            Self::Silhouette => ([0xff; 3], [0xd8; 3]),
        };
        Background::Graded(top, bottom)
    }

    /// What stands behind the head unless a person says otherwise.
    pub fn background(self) -> Background {
        match self {
            Self::Studio | Self::Daylight | Self::Clay | Self::XRay => self.gradient(),
            Self::Plate | Self::Silhouette => self.plain(),
        }
    }

    /// The layers that are shown unless a person says otherwise.
    pub fn layers(self) -> Layers {
        match self {
            Self::XRay => Layers { skin: 0.25, eyes: true, bone: true, teeth: true, ..Layers::NONE },
            Self::Clay | Self::Silhouette => Layers { whiskers: false, ..Layers::default() },
            Self::Studio | Self::Daylight | Self::Plate => Layers::default(),
        }
    }

    /// Whether hair is drawn unless a person says otherwise.
    pub const fn has_hair(self) -> bool {
        !matches!(self, Self::Clay | Self::Silhouette)
    }

    /// Whether the head throws a shadow on a ground below it.
    pub(super) const fn has_ground(self) -> bool {
        matches!(self, Self::Studio | Self::Daylight | Self::Clay)
    }

    pub(super) const fn stuff(self) -> Stuff {
        match self {
            Self::Clay => Stuff::Clay,
            Self::Silhouette => Stuff::Ink,
            Self::Studio | Self::Daylight | Self::Plate | Self::XRay => Stuff::Own,
        }
    }

    pub(super) const fn lights(self) -> &'static Lights {
        match self {
            Self::Studio | Self::XRay | Self::Silhouette => &Lights::STUDIO,
            Self::Daylight => &Lights::DAYLIGHT,
            Self::Clay => &Lights::CLAY,
            Self::Plate => &Lights::PLATE,
        }
    }
}

impl FromStr for Preset {
    type Err = PresetError;

    fn from_str(text: &str) -> Result<Self, PresetError> {
        Self::ALL.into_iter().find(|preset| preset.name() == text).ok_or_else(|| PresetError(text.to_owned()))
    }
}

#[cfg(test)]
mod tests {
    use super::Preset;

    #[test]
    fn a_preset_does_not_read_what_it_writes() {
        for preset in Preset::ALL {
            assert_eq!(preset.name().parse(), Ok(preset));
        }
        let error = "sepia".parse::<Preset>().unwrap_err().to_string();
        assert!(Preset::ALL.iter().all(|preset| error.contains(preset.name())), "{error}");
    }
}
