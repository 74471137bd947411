//! What a breed's hair is like: how long where, and how it stands.

use super::Region;
use super::region_hair::{self, RegionHair, Tuft};
use std::collections::BTreeMap;

/// Hair of a head. Lengths in metres, 0 to 0.2; everything else is a number from 0 to 1.
#[derive(Clone, Debug, PartialEq)]
pub struct Hair {
    /// On the muzzle.
    pub muzzle: f32,
    /// On cheeks, temples and forehead.
    pub head: f32,
    /// On the crown.
    pub topknot: f32,
    /// On the neck: the ruff.
    pub neck: f32,
    /// On the outer face of the ears.
    pub ear: f32,
    /// Along the margin of the ears: feathers.
    pub fringe: f32,
    /// On chin, lower jaw and the sides of the muzzle.
    pub beard: f32,
    /// On the brows.
    pub brow: f32,
    /// 0 straight, 1 in ringlets.
    pub curl: f32,
    /// 0 each hair for itself, 1 in locks.
    pub clump: f32,
    /// 0 lies close, 1 stands off the skin.
    pub lift: f32,
    /// 0 soft and drooping, 1 stiff and unruly as wire.
    pub wire: f32,
    /// 0 dull, 1 silky.
    pub gloss: f32,
    /// 0 bare, 1 as dense as hair is drawn.
    pub density: f32,
    /// How much of the coat is a dense, short and pale second layer below the rest: 0 none, 1 as in sledge dogs.
    pub undercoat: f32,
    /// Where hair is another than all this makes it.
    pub regions: BTreeMap<Region, RegionHair>,
}

/// The longest hair that a file may ask for, metres.
const LONGEST: f32 = 0.2;

/// What a number is when a file does not give it.
pub(super) enum Otherwise {
    /// This.
    Value(f32),
    /// A part of another number.
    Part(f32, fn(&Hair) -> f32),
}

/// One number of a file's `hair: (…)`.
pub(super) struct HairField {
    /// Its name there; one in `_mm` is a length.
    pub name: &'static str,
    pub get: fn(&Hair) -> f32,
    pub of: fn(&mut Hair) -> &mut f32,
    pub otherwise: Otherwise,
}

impl HairField {
    /// What the file's unit is in the number's own.
    pub fn unit(&self) -> f64 {
        if self.is_length() { 0.001 } else { 1.0 }
    }

    /// The largest value allowed, in the file's unit.
    pub fn max(&self) -> f64 {
        if self.is_length() { 200.0 } else { 1.0 }
    }

    fn is_length(&self) -> bool {
        self.name.ends_with("_mm")
    }
}

macro_rules! field {
    ($name:literal, $field:ident, $otherwise:expr) => {
        HairField { name: $name, get: |h| h.$field, of: |h| &mut h.$field, otherwise: $otherwise }
    };
}

/// Every number, in the order in which they are written; one that others are parts of stands before them.
pub(super) const FIELDS: [HairField; 15] = [
    field!("muzzle_mm", muzzle, Otherwise::Value(0.004)),
    field!("head_mm", head, Otherwise::Value(0.008)),
    field!("topknot_mm", topknot, Otherwise::Part(1.0, |h| h.head)),
    field!("neck_mm", neck, Otherwise::Value(0.018)),
    field!("ear_mm", ear, Otherwise::Value(0.006)),
    field!("fringe_mm", fringe, Otherwise::Part(1.0, |h| h.ear)),
    field!("beard_mm", beard, Otherwise::Part(1.0, |h| h.muzzle)),
    field!("brow_mm", brow, Otherwise::Part(0.75, |h| h.head)),
    field!("curl", curl, Otherwise::Value(0.0)),
    field!("clump", clump, Otherwise::Value(0.3)),
    field!("lift", lift, Otherwise::Value(0.3)),
    field!("wire", wire, Otherwise::Value(0.2)),
    field!("gloss", gloss, Otherwise::Value(0.4)),
    field!("density", density, Otherwise::Value(1.0)),
    field!("undercoat", undercoat, Otherwise::Value(0.0)),
];

/// The field of a file's `hair: (…)` that tells of single regions.
pub(super) const REGIONS: &str = "regions";

/// The names of a file's fields, in the order in which they are written.
pub(super) const NAMES: [&str; FIELDS.len() + 1] = {
    let mut names = [REGIONS; FIELDS.len() + 1];
    let mut i = 0;
    while i < FIELDS.len() {
        names[i] = FIELDS[i].name;
        i += 1;
    }
    names
};

impl Default for Hair {
    /// A short coat.
    fn default() -> Self {
        Self::from_given(|_| None)
    }
}

impl Hair {
    /// Takes what is given, by the place in [`FIELDS`]; the rest follows from it.
    pub(super) fn from_given(given: impl Fn(usize) -> Option<f32>) -> Self {
        let mut hair = Self {
            muzzle: 0.0,
            head: 0.0,
            topknot: 0.0,
            neck: 0.0,
            ear: 0.0,
            fringe: 0.0,
            beard: 0.0,
            brow: 0.0,
            curl: 0.0,
            clump: 0.0,
            lift: 0.0,
            wire: 0.0,
            gloss: 0.0,
            density: 0.0,
            undercoat: 0.0,
            regions: BTreeMap::new(),
        };
        for (i, field) in FIELDS.iter().enumerate() {
            *(field.of)(&mut hair) = given(i).unwrap_or_else(|| match &field.otherwise {
                Otherwise::Value(value) => *value,
                Otherwise::Part(part, of) => part * of(&hair),
            });
        }
        hair
    }

    /// Hair of one region: what the region is told to be, else what the rest of the head makes it.
    pub fn at(&self, region: Region) -> Tuft {
        let mut tuft = region_hair::of_head(self, region);
        if let Some(own) = self.regions.get(&region) {
            own.put_on(&mut tuft);
        }
        tuft
    }

    /// The longest hair anywhere, metres.
    pub fn longest(&self) -> f32 {
        Region::ALL.iter().map(|&region| self.at(region).length).fold(0.0, f32::max)
    }

    /// The weighted mean of every number, and in a region of which one of them tells something the mean of what they are
    /// there. Weights sum to 1.
    pub(super) fn blend<'a>(hairs: impl Iterator<Item = (&'a Hair, f64)> + Clone) -> Self {
        let mean = |of: &dyn Fn(&Hair) -> f32| {
            hairs.clone().fold(0.0, |sum, (hair, weight)| sum + f64::from(of(hair)) * weight) as f32
        };
        let mut blend = Self::from_given(|i| {
            let field = &FIELDS[i];
            let most = if field.is_length() { LONGEST } else { 1.0 };
            Some(mean(&|hair| (field.get)(hair)).clamp(0.0, most))
        });
        for region in Region::ALL {
            let told = RegionHair::from_fields(|field| {
                let is_told = |(hair, _): (&Hair, f64)| hair.regions.get(&region).is_some_and(|own| own.tells(field));
                let value = || mean(&|hair: &Hair| *(field.of)(&mut hair.at(region)));
                hairs.clone().any(is_told).then(value).map(|v| v.clamp(field.min_si(), field.max_si()))
            });
            if !told.is_empty() {
                blend.regions.insert(region, told);
            }
        }
        blend
    }
}
