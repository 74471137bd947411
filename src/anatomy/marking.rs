//! The kinds of markings and their numbers: one table for files, saving and the manual.
//!
//! Where on the head each kind lies is told by `coat::markings`. Millimetres are those of the table's default head; on
//! another a marking is as large in proportion.

use super::{Paint, Region};
use glam::Vec3;

/// The most numbers that a kind has.
pub const MOST_FIELDS: usize = 6;

/// A number of a marking.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MarkingField {
    /// Its name in files; one in `_mm` is a length.
    pub name: &'static str,
    /// The least allowed.
    pub min: f32,
    /// The most allowed.
    pub max: f32,
    /// What it is where a file does not give it.
    pub default: f32,
    /// What it does, for the manual.
    pub tells: &'static str,
}

macro_rules! kinds {
    ($($kind:ident: $tells:literal, [$(($name:literal, $min:literal, $max:literal, $default:literal, $field_tells:literal)),* $(,)?];)*) => {
        /// What a marking is; its name in files is the same.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
        pub enum MarkingKind {
            $(#[doc = $tells] $kind,)*
        }

        impl MarkingKind {
            /// Every kind, in the order of the manual.
            pub const ALL: &'static [Self] = &[$(Self::$kind,)*];

            /// The name used in files.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$kind => stringify!($kind),)* }
            }

            /// What it looks like, for the manual.
            pub const fn tells(self) -> &'static str {
                match self { $(Self::$kind => $tells,)* }
            }

            /// Its numbers, at most [`MOST_FIELDS`], in the order in which they are written.
            pub const fn fields(self) -> &'static [MarkingField] {
                match self {
                    $(Self::$kind => const {
                        &[$(MarkingField { name: $name, min: $min, max: $max, default: $default, tells: $field_tells },)*]
                    },)*
                }
            }
        }
    };
}

kinds! {
    Mask: "Muzzle and face from the nose backwards, with the lids: a dark mask.", [
        ("extent", 0.0, 1.0, 0.6, "how far back: 0.6 reaches the stop, 0.75 takes in the eyes"),
        ("eyes", 0.0, 1.0, 0.4, "how far around the eyes"),
        ("bridge", 0.0, 1.0, 1.0, "whether the top of the muzzle has it too"),
        ("soft_mm", 0.5, 60.0, 8.0, "width of the border"),
    ];
    Muzzle: "The muzzle with lips and chin: a white snout, or a paler one.", [
        ("extent", 0.0, 1.0, 0.4, "how far back: 0.6 reaches the corner of the mouth"),
        ("bridge", 0.0, 1.0, 0.8, "whether the top of the muzzle has it too"),
        ("soft_mm", 0.5, 60.0, 4.0, "width of the border"),
    ];
    Blaze: "A stripe from the nose over the forehead.", [
        ("width_mm", 0.0, 80.0, 14.0, "on the forehead"),
        ("top", 0.0, 1.0, 0.7, "where it ends: 0 at the stop, 0.5 on the crown, 1 at the occiput"),
        ("muzzle", 0.0, 1.0, 0.5, "how far it widens over the muzzle"),
        ("soft_mm", 0.5, 60.0, 3.0, "width of the border"),
    ];
    Cap: "Crown, forehead and temples down to a line above the eyes.", [
        ("extent", 0.0, 1.0, 0.5, "how far down: 0.5 ends above the eyes, 0.8 takes them in"),
        ("peak", 0.0, 1.0, 0.0, "how far it runs down the middle, to a bar on the bridge"),
        ("soft_mm", 0.5, 60.0, 6.0, "width of the border"),
    ];
    Sable: "Hair with dark tips on crown, nape and rims of the ears, fading downwards.", [
        ("extent", 0.0, 1.0, 0.5, "how far down"),
        ("soft_mm", 0.5, 60.0, 40.0, "over how much it fades"),
    ];
    Saddle: "The top of the neck: a saddle or cape.", [
        ("extent", 0.0, 1.0, 0.5, "how far down the sides; 1 is all around"),
        ("forward", 0.0, 1.0, 0.2, "how far onto the back of the skull"),
        ("soft_mm", 0.5, 60.0, 10.0, "width of the border"),
    ];
    Collar: "A ring around the neck, from the cut edge forwards.", [
        ("width_mm", 0.0, 120.0, 35.0, "how far forward"),
        ("soft_mm", 0.5, 60.0, 8.0, "width of the border"),
    ];
    Throat: "Throat and front of the neck, with the underside of the jaw.", [
        ("extent", 0.0, 1.0, 0.5, "how far up the sides"),
        ("soft_mm", 0.5, 60.0, 8.0, "width of the border"),
    ];
    TanPoints: "Dots over the eyes, sides of the muzzle, cheeks, throat and insides of the ears.", [
        ("brows", 0.0, 1.0, 0.5, "size of the dots"),
        ("muzzle", 0.0, 1.0, 0.6, "how far up the sides of the muzzle"),
        ("cheeks", 0.0, 1.0, 0.5, "size of the spot on the cheek, joined to the muzzle where it is large"),
        ("throat", 0.0, 1.0, 0.4, "how much of the throat"),
        ("ears", 0.0, 1.0, 0.5, "how much of the ears' insides"),
        ("soft_mm", 0.5, 60.0, 3.0, "width of the border"),
    ];
    BrowDots: "A dot over each eye.", [
        ("size_mm", 0.0, 60.0, 14.0, "across"),
        ("soft_mm", 0.5, 60.0, 4.0, "width of the border"),
    ];
    Urajiro: "The pale underside: sides of the muzzle, cheeks, jaw and throat.", [
        ("extent", 0.0, 1.0, 0.5, "how far up: 0.5 half up the muzzle, 0.9 to the eyes"),
        ("soft_mm", 0.5, 60.0, 12.0, "width of the border"),
    ];
    TearLine: "A line from the inner corner of the eye down the muzzle.", [
        ("length_mm", 0.0, 60.0, 22.0, "how far down"),
        ("width_mm", 0.0, 30.0, 5.0, "across"),
        ("soft_mm", 0.5, 60.0, 4.0, "width of the border"),
    ];
    EyeRings: "Rings around the eyes: spectacles.", [
        ("width_mm", 0.0, 40.0, 6.0, "from the lids outwards"),
        ("soft_mm", 0.5, 60.0, 4.0, "width of the border"),
    ];
    EyePatch: "A patch around an eye.", [
        ("size_mm", 0.0, 160.0, 50.0, "across"),
        ("left", 0.0, 1.0, 1.0, "how much of it the left side has"),
        ("right", 0.0, 1.0, 1.0, "how much of it the right side has"),
        ("soft_mm", 0.5, 60.0, 3.0, "width of the border"),
    ];
    Ears: "The ears.", [
        ("from", 0.0, 1.0, 0.0, "where it begins: 0 at the base, 0.9 has the tips only"),
        ("outside", 0.0, 1.0, 1.0, "how much on the outer face"),
        ("inside", 0.0, 1.0, 0.6, "how much on the inner face"),
        ("soft_mm", 0.5, 60.0, 8.0, "width of the border"),
    ];
    EarRims: "The margins of the ears.", [
        ("width", 0.0, 1.0, 0.35, "part of the ear's width"),
        ("soft_mm", 0.5, 60.0, 5.0, "width of the border"),
    ];
    Thumb: "A mark in the middle of the forehead.", [
        ("size_mm", 0.0, 80.0, 18.0, "along the head; a third narrower across"),
        ("height", 0.0, 1.0, 0.4, "where: 0 at the stop, 1 at the occiput"),
        ("soft_mm", 0.5, 60.0, 4.0, "width of the border"),
    ];
    Wrinkles: "Shadows in the folds of brow and cheek, wherever skin can fold.", [
        ("spacing_mm", 3.0, 40.0, 11.0, "from fold to fold of the brow, at a default head's size"),
        ("soft_mm", 0.5, 60.0, 3.0, "width of the border"),
    ];
    Piebald: "White that leaves a patch on each side, from the eye to the ear.", [
        ("extent", 0.0, 1.0, 0.5, "0 leaves the head, 0.5 a patch that meets over a blaze, 1 nothing"),
        ("left", 0.0, 1.0, 1.0, "size of the left patch"),
        ("right", 0.0, 1.0, 1.0, "size of the right patch"),
        ("ears", 0.0, 1.0, 1.0, "how much of the colour the ears keep"),
        ("ragged", 0.0, 1.0, 0.3, "how irregular it is"),
        ("seed", 0.0, 9999.0, 1.0, "another number is another dog"),
    ];
    Patches: "Irregular patches.", [
        ("size_mm", 4.0, 200.0, 60.0, "across"),
        ("cover", 0.0, 1.0, 0.3, "part of the head that is covered"),
        ("torn", 0.0, 1.0, 0.3, "how ragged the border is"),
        ("seed", 0.0, 9999.0, 1.0, "another number is another dog"),
        ("soft_mm", 0.5, 60.0, 2.0, "width of the border"),
    ];
    Spots: "Round spots.", [
        ("size_mm", 1.0, 60.0, 12.0, "across"),
        ("density", 0.0, 1.0, 0.6, "how close together"),
        ("seed", 0.0, 9999.0, 1.0, "another number is another dog"),
        ("soft_mm", 0.5, 8.0, 1.5, "width of the border"),
    ];
    Ticking: "Flecks the size of a lentil.", [
        ("size_mm", 1.0, 60.0, 3.5, "across"),
        ("density", 0.0, 1.0, 0.5, "how close together"),
        ("seed", 0.0, 9999.0, 1.0, "another number is another dog"),
        ("soft_mm", 0.5, 8.0, 1.0, "width of the border"),
    ];
    Brindle: "Stripes across the hair.", [
        ("spacing_mm", 3.0, 60.0, 6.5, "from stripe to stripe"),
        ("width", 0.0, 1.0, 0.5, "part of that which a stripe has"),
        ("breaks", 0.0, 1.0, 0.6, "how often stripes are interrupted"),
        ("seed", 0.0, 9999.0, 1.0, "another number is another dog"),
        ("soft_mm", 0.5, 60.0, 5.0, "width of the border"),
    ];
    Merle: "Torn patches of full colour with half-tones, over a coat that is paler.", [
        ("size_mm", 4.0, 200.0, 30.0, "across"),
        ("cover", 0.0, 1.0, 0.4, "part of the head that keeps its full colour"),
        ("torn", 0.0, 1.0, 0.7, "how ragged the border is"),
        ("seed", 0.0, 9999.0, 1.0, "another number is another dog"),
    ];
    Roan: "Single hairs of another colour.", [
        ("density", 0.0, 1.0, 0.5, "part of the hairs"),
        ("patchy", 0.0, 1.0, 0.3, "how unevenly they stand"),
        ("seed", 0.0, 9999.0, 1.0, "another number is another dog"),
    ];
    Grizzle: "Banded hairs, each a little more or less of another colour: pepper and salt, agouti.", [
        ("density", 0.0, 1.0, 0.5, "how much on the mean"),
        ("spread", 0.0, 1.0, 0.8, "how much hairs differ"),
        ("seed", 0.0, 9999.0, 1.0, "another number is another dog"),
    ];
    Patch: "Named regions of the skin, such as \"ear_inner\".", [
        ("soft_mm", 0.5, 60.0, 8.0, "how far hairs of both sides mix"),
    ];
}

impl MarkingKind {
    /// The kind of that name.
    pub fn from_name(name: &str) -> Option<Self> {
        Self::ALL.iter().copied().find(|k| k.name() == name)
    }
}

/// One layer of a coat.
#[derive(Clone, Debug, PartialEq)]
pub struct Marking {
    /// What it is.
    pub kind: MarkingKind,
    /// What it is painted with.
    pub paint: Paint,
    /// 0 leaves what is below, 1 covers it.
    pub amount: f32,
    /// The numbers of its kind, in the order of [`MarkingKind::fields`], each in its range; the rest 0.
    pub values: [f32; MOST_FIELDS],
    /// Where a [`MarkingKind::Patch`] lies; empty in other kinds.
    pub regions: Vec<Region>,
}

impl Marking {
    /// A marking with the default numbers of its kind that covers what is below.
    pub fn new(kind: MarkingKind, paint: Paint) -> Self {
        let mut values = [0.0; MOST_FIELDS];
        for (value, field) in values.iter_mut().zip(kind.fields()) {
            *value = field.default;
        }
        Self { kind, paint, amount: 1.0, values, regions: Vec::new() }
    }

    /// The same with another number; a name that the kind does not have changes nothing.
    pub fn with(mut self, field: &str, value: f32) -> Self {
        for (to, known) in self.values.iter_mut().zip(self.kind.fields()).filter(|(_, known)| known.name == field) {
            *to = value.clamp(known.min, known.max);
        }
        self
    }

    /// The same, covering in part only.
    pub fn by(self, amount: f32) -> Self {
        Self { amount, ..self }
    }

    /// A colour (linear) over regions.
    pub fn patch(regions: Vec<Region>, colour: Vec3, amount: f32) -> Self {
        Self { regions, amount, ..Self::new(MarkingKind::Patch, Paint::Colour(colour)) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_of_markings_are_named_once_and_lie_in_their_ranges() {
        for kind in MarkingKind::ALL {
            let fields = kind.fields();
            assert!(fields.len() <= MOST_FIELDS, "{}", kind.name());
            for (i, field) in fields.iter().enumerate() {
                assert!(field.min < field.max && (field.min..=field.max).contains(&field.default), "{}", field.name);
                assert!(fields[..i].iter().all(|f| f.name != field.name), "{}", field.name);
            }
            assert_eq!(MarkingKind::from_name(kind.name()), Some(*kind));
        }
    }
}
