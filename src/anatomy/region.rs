//! Named areas of the head's skin, for colours and for the fields that move it.

/// An area of the skin. Areas overlap softly: a vertex has a weight in each.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Region {
    /// The hairless nose pad (planum nasale).
    Nose,
    /// Rim and inside of the nostrils.
    Nostril,
    /// Upper lip, with the flews.
    UpperLip,
    /// Lower lip.
    LowerLip,
    /// Lining of the mouth.
    Mouth,
    /// Bridge of the nose, from the nose pad to the stop.
    Bridge,
    /// Side of the muzzle.
    MuzzleSide,
    /// Where the whiskers stand, beside and below the nose.
    WhiskerPad,
    /// Chin.
    Chin,
    /// Lower jaw behind the chin.
    LowerJaw,
    /// The step between muzzle and forehead.
    Stop,
    /// Brow ridges above the eyes.
    Brow,
    /// Around the eye, outside the lids.
    Orbit,
    /// Eyelids.
    Lid,
    /// Forehead.
    Forehead,
    /// The stripe of a blaze, from the forehead down the middle of the muzzle.
    Blaze,
    /// Top of the skull behind the forehead.
    Crown,
    /// Side of the skull over the temporal muscle.
    Temple,
    /// Cheek over the masseter and the zygomatic arch.
    Cheek,
    /// Outer (haired) face of the ear.
    EarOuter,
    /// Inner face of the ear.
    EarInner,
    /// Margin of the ear.
    EarEdge,
    /// Throat.
    Throat,
    /// Back of the neck.
    Nape,
    /// Side of the neck.
    NeckSide,
    /// Front of the neck below the throat.
    NeckFront,
}

impl Region {
    /// Number of regions.
    pub const COUNT: usize = Self::ALL.len();

    /// Every region, in the order of the enum: `ALL[r as usize] == r`.
    pub const ALL: [Self; 26] = [
        Self::Nose,
        Self::Nostril,
        Self::UpperLip,
        Self::LowerLip,
        Self::Mouth,
        Self::Bridge,
        Self::MuzzleSide,
        Self::WhiskerPad,
        Self::Chin,
        Self::LowerJaw,
        Self::Stop,
        Self::Brow,
        Self::Orbit,
        Self::Lid,
        Self::Forehead,
        Self::Blaze,
        Self::Crown,
        Self::Temple,
        Self::Cheek,
        Self::EarOuter,
        Self::EarInner,
        Self::EarEdge,
        Self::Throat,
        Self::Nape,
        Self::NeckSide,
        Self::NeckFront,
    ];

    /// The name used in files.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Nose => "nose",
            Self::Nostril => "nostril",
            Self::UpperLip => "upper_lip",
            Self::LowerLip => "lower_lip",
            Self::Mouth => "mouth",
            Self::Bridge => "bridge",
            Self::MuzzleSide => "muzzle_side",
            Self::WhiskerPad => "whisker_pad",
            Self::Chin => "chin",
            Self::LowerJaw => "lower_jaw",
            Self::Stop => "stop",
            Self::Brow => "brow",
            Self::Orbit => "orbit",
            Self::Lid => "lid",
            Self::Forehead => "forehead",
            Self::Blaze => "blaze",
            Self::Crown => "crown",
            Self::Temple => "temple",
            Self::Cheek => "cheek",
            Self::EarOuter => "ear_outer",
            Self::EarInner => "ear_inner",
            Self::EarEdge => "ear_edge",
            Self::Throat => "throat",
            Self::Nape => "nape",
            Self::NeckSide => "neck_side",
            Self::NeckFront => "neck_front",
        }
    }

    /// The region of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|r| r.name() == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_is_in_the_order_of_the_enum_and_names_are_unique() {
        for (i, region) in Region::ALL.into_iter().enumerate() {
            assert_eq!(region as usize, i);
            assert_eq!(Region::from_name(region.name()), Some(region));
        }
        assert_eq!(Region::from_name("tail"), None);
    }
}
