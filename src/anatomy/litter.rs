//! Puppies: what a dog inherits from two others. All of them are grown, as every dog here is.
//!
//! Two modes, by measure:
//! - **Polygenic**, every measure but those below: midway between the parents plus the noise of segregation, in the
//!   coordinates of [`super::Space`], in which size and shape are apart. The noise's standard deviation is a quarter of
//!   the parents' difference, so that it spreads over half of it and the parents stand two deviations from the middle; it
//!   ends at three. Half of its variance is shared by a group of the table: a puppy takes after one parent in its
//!   face and after the other in its ears, rather than in every measure anew.
//! - **Whole**, from one parent or the other: how the ears are carried ([`INHERITED_WHOLE`]), for half of a fold is no
//!   ear of either; the coat with the pigment of nose, lips and mouth; the iris.

use super::space::{Chart, SIZE};
use super::{Breed, ParamTable, SpaceError};
use crate::math::ops;
use crate::math::rng::Rng;

/// The measures of the ears' carriage, which come from one parent together.
pub const INHERITED_WHOLE: [&str; 8] = [
    "ear_lift_deg",
    "ear_back_deg",
    "ear_turn_deg",
    "ear_fold_deg",
    "ear_fold_height",
    "ear_fold_softness",
    "ear_sweep_deg",
    "ear_cup",
];

/// One puppy of two dogs: every value set and in its range. The same parents and the same stream give the same puppy.
///
/// # Errors
/// A table without a size.
pub fn cross(table: &ParamTable, sire: &Breed, dam: &Breed, rng: &mut Rng) -> Result<Breed, SpaceError> {
    let chart = Chart::new(table).ok_or(SpaceError::NoSize(SIZE))?;
    let [a, b] = [sire, dam].map(|parent| chart.point(&parent.values));
    let mut groups: Vec<(&str, f64)> = Vec::new();
    let mut point = Vec::new();
    for (row, spec) in table.specs.iter().enumerate() {
        let shared = match groups.iter().find(|(group, _)| *group == spec.group) {
            Some((_, shared)) => *shared,
            None => {
                groups.push((&spec.group, rng.normal()));
                groups[groups.len() - 1].1
            }
        };
        let noise = ((shared + rng.normal()) * ops::sqrt(0.5)).clamp(-3.0, 3.0);
        point.push((a[row] + b[row]) * 0.5 + (a[row] - b[row]) * 0.25 * noise);
    }
    let mut puppy = Breed::defaults(table);
    chart.values(table, &point, &mut puppy.values);
    puppy.set.fill(true);

    let mut one_of = || if rng.below(2) == 0 { sire } else { dam };
    let carrier = one_of();
    for row in INHERITED_WHOLE.iter().filter_map(|id| table.index_of(id)) {
        puppy.values[row] = carrier.values[row];
    }
    puppy.look = one_of().look.clone();
    puppy.look.iris = one_of().look.iris;
    Ok(puppy)
}
