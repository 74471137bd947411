//! Hair by region: what a region has from the numbers of the whole head, and what a breed may tell of it alone.
//!
//! What follows from the whole head is code and no file: lengths are parts of each other with ends that they do not pass,
//! and a blend asks for them anew at each step of its slider.

use super::Hair;
use super::Region;

/// Hair of one region, everything resolved. Lengths in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tuft {
    /// Metres, 0 to 0.25; 0 where no hair grows.
    pub length: f32,
    /// How far it stands off the skin there for the same lift: a factor about 1.
    pub stand: f32,
    /// As in [`Hair`], each 0 to 1.
    pub curl: f32,
    /// As in [`Hair`].
    pub clump: f32,
    /// As in [`Hair`].
    pub lift: f32,
    /// As in [`Hair`].
    pub wire: f32,
    /// As in [`Hair`].
    pub gloss: f32,
    /// As in [`Hair`].
    pub density: f32,
    /// As in [`Hair`].
    pub undercoat: f32,
    /// What is added to the unit direction in which hair grows: away from the median plane, upwards, towards the nose.
    pub comb: [f32; 3],
}

/// One number that a file may tell of a region.
pub(super) struct RegionField {
    /// Its name there; one in `_mm` is a length.
    pub name: &'static str,
    /// The least and the most allowed, in the file's unit.
    pub range: [f64; 2],
    pub of: fn(&mut Tuft) -> &mut f32,
}

impl RegionField {
    /// What the file's unit is in the number's own.
    pub fn unit(&self) -> f64 {
        if self.name.ends_with("_mm") { 0.001 } else { 1.0 }
    }

    pub fn min_si(&self) -> f32 {
        (self.range[0] * self.unit()) as f32
    }

    pub fn max_si(&self) -> f32 {
        (self.range[1] * self.unit()) as f32
    }
}

const fn part(name: &'static str, of: fn(&mut Tuft) -> &mut f32) -> RegionField {
    RegionField { name, range: [0.0, 1.0], of }
}

const fn combed(name: &'static str, of: fn(&mut Tuft) -> &mut f32) -> RegionField {
    RegionField { name, range: [-3.0, 3.0], of }
}

/// Every number, in the order in which they are written.
pub(super) const FIELDS: [RegionField; 11] = [
    RegionField { name: "length_mm", range: [0.0, 200.0], of: |t| &mut t.length },
    part("curl", |t| &mut t.curl),
    part("clump", |t| &mut t.clump),
    part("lift", |t| &mut t.lift),
    part("wire", |t| &mut t.wire),
    part("gloss", |t| &mut t.gloss),
    part("density", |t| &mut t.density),
    part("undercoat", |t| &mut t.undercoat),
    combed("out", |t| &mut t.comb[0]),
    combed("up", |t| &mut t.comb[1]),
    combed("forward", |t| &mut t.comb[2]),
];

/// Their names.
pub(super) const NAMES: [&str; FIELDS.len()] = {
    let mut names = [""; FIELDS.len()];
    let mut i = 0;
    while i < FIELDS.len() {
        names[i] = FIELDS[i].name;
        i += 1;
    }
    names
};

/// What a breed tells of one region's hair. Lengths in metres; each number in the range of its field.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RegionHair {
    told: [Option<f32>; FIELDS.len()],
}

impl RegionHair {
    /// Takes what is told of each field.
    pub(super) fn from_fields(of: impl FnMut(&RegionField) -> Option<f32>) -> Self {
        Self { told: FIELDS.each_ref().map(of) }
    }

    /// Whether nothing is told.
    pub fn is_empty(&self) -> bool {
        self.told.iter().all(Option::is_none)
    }

    pub(super) fn tells(&self, field: &RegionField) -> bool {
        self.fields().any(|(known, _)| known.name == field.name)
    }

    /// What is told, with its field.
    pub(super) fn fields(&self) -> impl Iterator<Item = (&'static RegionField, f32)> {
        FIELDS.iter().zip(self.told).filter_map(|(field, value)| Some((field, value?)))
    }

    pub(super) fn put_on(&self, tuft: &mut Tuft) {
        for (field, value) in self.fields() {
            *(field.of)(tuft) = value;
        }
    }
}

impl Region {
    /// Whether no hair grows there: leather, and what is moist.
    pub fn is_bare(self) -> bool {
        matches!(self, Self::Nose | Self::Nostril | Self::Lid | Self::Mouth)
    }
}

/// A region's hair as the numbers of the whole head make it.
pub(super) fn of_head(hair: &Hair, region: Region) -> Tuft {
    let (length, stand) = growth(hair, region);
    let Hair { curl, clump, lift, wire, gloss, density, undercoat, .. } = *hair;
    // Faces and ears have less of it than the neck.
    let undercoat = undercoat * woolly(region);
    Tuft { length, stand, curl, clump, lift, wire, gloss, density, undercoat, comb: comb(hair, region) }
}

/// The longest hair around the eyes, metres: beyond it no dog would see.
const AROUND_EYES: f32 = 0.007;
/// The longest hair between the eyes, metres, where it lies backwards.
const BEFORE_EYES: f32 = 0.022;

/// Length in metres of a region's hair, and how far it stands off the skin, as a factor.
fn growth(hair: &Hair, region: Region) -> (f32, f32) {
    use Region::*;
    let Hair { muzzle, head, topknot, neck, ear, fringe, beard, brow, .. } = *hair;
    let mean = |a: f32, b: f32| 0.5 * (a + b);
    match region {
        Nose | Nostril | Lid | Mouth => (0.0, 0.0),
        UpperLip | LowerLip => ((0.9 * muzzle).min(0.006), 0.7),
        Bridge => (muzzle, 0.7),
        MuzzleSide => (mean(muzzle, beard), 0.8),
        WhiskerPad => (muzzle + 0.3 * (beard - muzzle), 0.8),
        Chin | LowerJaw => (beard, 0.9),
        Stop | Blaze => (mean(muzzle, head).min(BEFORE_EYES), 0.8),
        Brow => (brow, 1.1),
        Orbit => ((0.25 * head).clamp(head.min(0.0025), AROUND_EYES), 0.7),
        Forehead => (mean(head, topknot), 0.9),
        Crown => (topknot, 1.0),
        Temple => (head, 1.0),
        Cheek => (1.15 * head, 1.0),
        EarOuter => (ear, 0.8),
        EarInner => ((0.5 * ear).min(0.008), 0.7),
        EarEdge => (mean(ear, fringe), 0.7),
        Throat => (mean(head, neck), 1.0),
        Nape => (0.8 * neck, 1.0),
        NeckSide => (neck, 1.1),
        NeckFront => (1.1 * neck, 1.1),
    }
}

/// How much of the undercoat a region has.
fn woolly(region: Region) -> f32 {
    use Region::*;
    match region {
        Nose | Nostril | Lid | Mouth | UpperLip | LowerLip | Bridge | WhiskerPad | Orbit => 0.0,
        MuzzleSide | Chin | Stop | Blaze | Brow | EarInner | EarEdge => 0.3,
        LowerJaw | Forehead | EarOuter => 0.5,
        Crown | Temple => 0.7,
        Cheek | Throat | Nape | NeckSide | NeckFront => 1.0,
    }
}

/// What is added to the unit direction of hair: away from the median plane, upwards, towards the nose. Long hair parts in
/// the middle and falls; beards and brows hang forward.
fn comb(hair: &Hair, region: Region) -> [f32; 3] {
    use Region::*;
    // How far hair of this length is from lying where it grows.
    let long = |length: f32, from: f32, to: f32| ((length - from) / (to - from)).clamp(0.0, 1.0);
    let beard = long(hair.beard, 0.010, 0.040);
    let brow = long(hair.brow, 0.012, 0.030);
    let parted = long(hair.topknot, 0.040, 0.090);
    let bridge = long(hair.muzzle, 0.012, 0.040);
    let by = |comb: [f32; 3], part: f32| comb.map(|x| x * part);
    match region {
        Bridge | Stop => by([1.2, -0.6, 0.3], bridge),
        MuzzleSide | WhiskerPad => [0.10 + 0.3 * beard, -0.10 - 1.2 * beard, 0.9 * beard],
        Chin | LowerJaw => by([0.0, -0.9, 0.9], beard),
        Brow => by([0.5, 0.2, 1.9], brow),
        Forehead | Blaze | Crown => by([1.3, -0.3, 0.2], parted),
        Cheek => [0.15, -0.45, 0.0],
        Temple => [0.15, -0.35, 0.0],
        Throat | NeckFront | NeckSide => [0.0, -0.30, 0.0],
        _ => [0.0; 3],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_region_that_is_told_something_is_another_elsewhere_too_or_not_there() {
        let mut hair = Hair::default();
        let curl = FIELDS.iter().position(|f| f.name == "curl").unwrap();
        let mut told = RegionHair::default();
        told.told[curl] = Some(0.8);
        hair.regions.insert(Region::Crown, told);
        for region in Region::ALL {
            let expected = if region == Region::Crown { 0.8 } else { 0.0 };
            assert_eq!(hair.at(region).curl, expected, "{region:?}");
            assert_eq!(hair.at(region).length == 0.0, region.is_bare(), "{region:?}");
        }
    }
}
