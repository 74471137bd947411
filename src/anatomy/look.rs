//! How a dog's coat looks.

use super::{Hair, Marking, Paint, Pigments, colour};
use glam::Vec3;

/// The colours of a coat: what it is painted with, and layers of markings.
#[derive(Clone, Debug, PartialEq)]
pub struct Pattern {
    /// The dog's pigments.
    pub pigments: Pigments,
    /// The coat where no marking is.
    pub base: Paint,
    /// Painted over the base in this order.
    pub markings: Vec<Marking>,
}

/// The largest share that leaves something.
const MOST_SHARE: f32 = 1.0 - f32::EPSILON / 2.0;

impl Pattern {
    /// One colour, linear, all over.
    pub fn plain(colour: Vec3) -> Self {
        Self { pigments: Pigments::default(), base: Paint::Colour(colour), markings: Vec::new() }
    }

    /// The colour where no marking is, linear.
    pub fn base_colour(&self) -> Vec3 {
        self.pigments.colour(self.base)
    }
}

/// Colours of a head, linear, each channel 0 to 1; and its hair.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// The colours of the coat.
    pub pattern: Pattern,
    /// Other coats mixed in, each with its share: the colour of a place is the mean. Shares are above 0 and their sum is
    /// below 1; the rest is that of `pattern`.
    pub mixed: Vec<(f32, Pattern)>,
    /// Nose pad.
    pub nose: Vec3,
    /// Bare margins of the lips and lids.
    pub lips: Vec3,
    /// Lining of the mouth.
    pub mouth: Vec3,
    /// Iris.
    pub iris: Vec3,
    /// How haired the coat looks: 0 bare, 1 haired.
    pub fur: f32,
    /// How long it is, and how it stands.
    pub hair: Hair,
}

/// A look under the name by which breeders know it.
#[derive(Clone, Debug, PartialEq)]
pub struct Variety {
    /// Its name.
    pub name: String,
    /// What it is.
    pub look: Look,
}

/// The lining of the mouth where a file does not tell.
pub(super) fn pink() -> Vec3 {
    colour::from_srgb8([0xb0, 0x6a, 0x68])
}

impl Default for Look {
    /// A yellow dog with a dark nose.
    fn default() -> Self {
        Self::of(Pattern::plain(colour::from_srgb8([0xd9, 0xb2, 0x7c])))
    }
}

impl Look {
    /// A short coat with what goes with its pigments.
    pub fn of(pattern: Pattern) -> Self {
        let eumelanin = pattern.pigments.eumelanin;
        let (nose, lips, iris) = (eumelanin.nose(), eumelanin.lips(), eumelanin.iris());
        Self { pattern, mixed: Vec::new(), nose, lips, mouth: pink(), iris, fur: 1.0, hair: Hair::default() }
    }

    /// Every coat of which the colour of a place is the mean, with its share; shares sum to 1.
    pub fn shares(&self) -> impl Iterator<Item = (f32, &Pattern)> {
        let rest = 1.0 - self.mixed.iter().map(|(share, _)| share).sum::<f32>();
        std::iter::once((rest, &self.pattern)).chain(self.mixed.iter().map(|(share, pattern)| (*share, pattern)))
    }

    /// The colour where no marking is, linear.
    pub fn base_colour(&self) -> Vec3 {
        self.shares().fold(Vec3::ZERO, |sum, (share, pattern)| sum + pattern.base_colour() * share)
    }

    /// Mixes looks: the colour of each place, and every other number, is the weighted mean. Weights sum to 1.
    ///
    /// The coats of the result are those of the looks, each with its share, like ones once; so a file can hold it, and
    /// mixing mixtures makes nothing deeper.
    pub(super) fn blend(looks: &[(&Look, f64)]) -> Look {
        let mut coats: Vec<(f64, &Pattern)> = Vec::new();
        for (look, weight) in looks {
            for (share, pattern) in look.shares() {
                let share = f64::from(share) * weight;
                match coats.iter_mut().find(|(_, known)| *known == pattern) {
                    Some(known) => known.0 += share,
                    None => coats.push((share, pattern)),
                }
            }
        }
        let (pattern, rest) = match coats.split_first() {
            Some(((_, first), rest)) => ((*first).clone(), rest),
            None => (Look::default().pattern, &[] as &[(f64, &Pattern)]),
        };
        // A share that rounds to nothing is nothing.
        let mixed = rest.iter().map(|(share, pattern)| ((*share as f32).min(MOST_SHARE), (*pattern).clone()));
        let mixed = mixed.filter(|(share, _)| *share > 0.0).collect();
        let mean = |of: &dyn Fn(&Look) -> Vec3| {
            let sum = looks.iter().fold(glam::DVec3::ZERO, |sum, (look, w)| sum + of(look).as_dvec3() * *w);
            sum.as_vec3().clamp(Vec3::ZERO, Vec3::ONE)
        };
        let fur = looks.iter().fold(0.0, |sum, (look, w)| sum + f64::from(look.fur) * w) as f32;
        Look {
            pattern,
            mixed,
            nose: mean(&|l| l.nose),
            lips: mean(&|l| l.lips),
            mouth: mean(&|l| l.mouth),
            iris: mean(&|l| l.iris),
            fur: fur.clamp(0.0, 1.0),
            hair: Hair::blend(looks.iter().map(|(look, w)| (&look.hair, *w))),
        }
    }
}
