//! How a dog's coat looks.

use super::{Hair, Region, colour};
use glam::Vec3;

/// A patch of another colour over one or more regions.
#[derive(Clone, Debug, PartialEq)]
pub struct Mark {
    /// Where it lies.
    pub regions: Vec<Region>,
    /// Linear red, green, blue, each 0 to 1.
    pub colour: Vec3,
    /// 0 leaves what is below, 1 covers it.
    pub amount: f32,
}

/// Colours of a head, linear, each channel 0 to 1; and its hair.
#[derive(Clone, Debug, PartialEq)]
pub struct Look {
    /// Colour of the coat where no mark is.
    pub base: Vec3,
    /// Painted over the base in this order.
    pub marks: Vec<Mark>,
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

impl Default for Look {
    /// A yellow dog with a dark nose.
    fn default() -> Self {
        let srgb = colour::from_srgb8;
        Self {
            base: srgb([0xd9, 0xb2, 0x7c]),
            marks: Vec::new(),
            nose: srgb([0x2a, 0x24, 0x22]),
            lips: srgb([0x2b, 0x23, 0x22]),
            mouth: srgb([0xb5, 0x6a, 0x66]),
            iris: srgb([0x5a, 0x3a, 0x1a]),
            fur: 1.0,
            hair: Hair::default(),
        }
    }
}

impl Look {
    /// Colour of a region's coat: the base, then each mark that names the region, in order.
    pub fn colour(&self, region: Region) -> Vec3 {
        let marks = self.marks.iter().filter(|m| m.regions.contains(&region));
        marks.fold(self.base, |below, mark| below * (1.0 - mark.amount) + mark.colour * mark.amount)
    }

    /// The colours of all regions, in the order of [`Region::ALL`].
    pub fn colours(&self) -> [Vec3; Region::COUNT] {
        Region::ALL.map(|region| self.colour(region))
    }

    /// Mixes looks: each region's colour, and every other colour, is the weighted mean. Weights sum to 1.
    ///
    /// The result has one covering mark for each colour that differs from the mixed base, so that its colours are exactly
    /// the means and a file can hold it.
    pub(super) fn blend(looks: &[(&Look, f64)]) -> Look {
        let mean = |of: &dyn Fn(&Look) -> Vec3| {
            let sum = looks.iter().fold(glam::DVec3::ZERO, |sum, (look, w)| sum + of(look).as_dvec3() * *w);
            sum.as_vec3().clamp(Vec3::ZERO, Vec3::ONE)
        };
        let base = mean(&|l| l.base);
        let mut marks: Vec<Mark> = Vec::new();
        for region in Region::ALL {
            let colour = mean(&|l| l.colour(region));
            if colour == base {
                continue;
            }
            match marks.iter_mut().find(|m| m.colour == colour) {
                Some(mark) => mark.regions.push(region),
                None => marks.push(Mark { regions: vec![region], colour, amount: 1.0 }),
            }
        }
        let fur = looks.iter().fold(0.0, |sum, (look, w)| sum + f64::from(look.fur) * w) as f32;
        Look {
            base,
            marks,
            nose: mean(&|l| l.nose),
            lips: mean(&|l| l.lips),
            mouth: mean(&|l| l.mouth),
            iris: mean(&|l| l.iris),
            fur: fur.clamp(0.0, 1.0),
            hair: Hair::blend(looks.iter().map(|(look, w)| (&look.hair, *w))),
        }
    }
}
