//! Skin over bone: where the fitted skin comes nearer to skull or mandible than the thinnest tissue, the bone carries it.
//!
//! Navarro Newball, Wyvill and McCane 2008 ask for an implicit model of the skull for this: inside, outside and distance
//! are one sum of simple bodies, for any head.

use crate::rig::bone::{BoneField, BoneMesh, targets};
use crate::rig::handles::{Handles, NONE};
use crate::rig::implicit::{Implicit, Layer};
use crate::rig::lanes::{F8, P8};
use crate::rig::proportions::{Measures, Proportions};
use glam::Vec3;

/// Skin over bone at least, millimetres of the canonical head, on the upper head. The leanest places, bridge and arch,
/// have 3 to 5; what subdivision takes away between two vertices is made up for by the rest.
const UPPER: f32 = 3.0;
/// The same on the lower jaw.
const LOWER: f32 = 3.5;
/// At the folds of the lids, which have little over the rim of the orbit.
const MARGIN: f32 = 0.5;
/// Behind the ears, where rows are far apart and the nuchal crest is sharp.
const NAPE: f32 = 5.0;
/// Below them, where the crest ends.
const MASTOID: f32 = 6.0;
/// How far a vertex goes at once, canonical millimetres.
const FARTHEST: f32 = 6.0;
/// How often a vertex is asked and moved.
const STEPS: usize = 3;

/// Which vertices bone carries.
#[derive(Clone, Debug)]
pub(super) struct TissuePlan {
    carried: Vec<Carried>,
}

/// A vertex over bone.
#[derive(Clone, Copy, Debug)]
struct Carried {
    vertex: u16,
    /// How far from bone it stays, canonical millimetres.
    least: f32,
    /// On which surface it lies.
    layer: Layer,
}

/// Skull and mandible of the head at hand, and which vertices are still asked for.
#[derive(Clone, Debug, Default)]
pub(super) struct Fields {
    bones: [BoneField; 2],
    open: Vec<u16>,
}

impl TissuePlan {
    /// The grids of the skin. Nose, lid margins, lips and leather have no bone below them, or their own place.
    pub(super) fn new(handles: &Handles) -> Self {
        let over = |vertex: u16, least: f32, layer: Layer| Carried { vertex, least, layer };
        let upper =
            (1..20).flat_map(|i| (0..10).map(move |j| (i, j))).filter(|&(i, j)| j < 9 || !(3..=10).contains(&i));
        // Nor the temple, where muscle lies over the bone and the ear's base is near.
        let upper = upper.filter(|&(i, j)| !((12..=13).contains(&i) && (1..=6).contains(&j)));
        let upper = upper.map(|(i, j)| {
            let least = match (i, j) {
                (16, 5..=7) => MASTOID,
                (15..=17, _) => NAPE,
                _ => UPPER,
            };
            over(handles.s[i][j], least, if i > 10 { Layer::Whole } else { Layer::Upper })
        });
        let lower = (3..20)
            .flat_map(|i| (10..15).map(move |j| (i, j)))
            // Beside the lip's margin the lower lip would come through the upper.
            .filter(|&(i, j)| i > 3 && (j > 10 || i > 5))
            .map(|(i, j)| over(handles.l[i][j], LOWER, if i > 10 { Layer::Whole } else { Layer::Lower }));
        let lids = handles.of.into_iter().map(|v| over(v, MARGIN, Layer::Whole));
        // The ear's base is one loop that its leather grows from; pushed here and there it would cross itself.
        let carried = upper.chain(lower).chain(lids);
        Self { carried: carried.filter(|c| c.vertex != NONE && !handles.ear_base.contains(&c.vertex)).collect() }
    }

    /// Moves what lies too near along the skin's own normal, which keeps the order of the vertices where the bone's
    /// gradient would turn into a cavity; `at` is the half mesh in the proportions' frame.
    pub(super) fn carry(
        &self,
        measures: &Measures,
        shape: &Proportions,
        surface: &Implicit,
        fields: &mut Fields,
        at: &mut [Vec3],
    ) {
        let landmarks = targets(measures, shape);
        let unit = shape.canonical_mm();
        for (field, bone) in fields.bones.iter_mut().zip([BoneMesh::Skull, BoneMesh::Mandible]) {
            field.place(bone, &landmarks, unit);
        }
        let Fields { bones, open } = fields;
        open.clear();
        open.extend(0..self.carried.len() as u16);
        for _ in 0..STEPS {
            // What has not moved would be told the same again.
            let n_open = open.len();
            for from in (0..n_open).step_by(8) {
                let eight: [u16; 8] = std::array::from_fn(|k| open[(from + k).min(n_open - 1)]);
                let n = (n_open - from).min(8);
                let mut moved = [false; 8];
                for bone in bones.iter() {
                    let points = eight.map(|c| shape.metres(at[usize::from(self.carried[usize::from(c)].vertex)]));
                    let lanes = |axis: usize| F8(std::array::from_fn(|k| points[k][axis]));
                    let near = bone.distance8(P8 { x: lanes(0), y: lanes(1), z: lanes(2) });
                    for k in 0..n {
                        let carried = self.carried[usize::from(eight[k])];
                        let least = carried.least * unit;
                        if near.0[k] < least {
                            let v = usize::from(carried.vertex);
                            let (d, g) = bone.sample(points[k], 0.2 * unit);
                            let normal = surface.sample(at[v], carried.layer).1.normalize_or_zero();
                            let slope = g.normalize_or_zero().dot(shape.direction(normal)).max(0.5);
                            at[v] += normal * (((least - d).max(0.0) / slope).min(FARTHEST * unit) / shape.scale);
                            moved[k] = true;
                        }
                    }
                }
                for k in 0..n {
                    if moved[k] {
                        open.push(eight[k]);
                    }
                }
            }
            open.drain(..n_open);
        }
    }
}
