//! Bone under the skin: skull, mandible and teeth, carried by the landmarks that the measures place.
//!
//! The control meshes are baked from the field of the canonical skull (`author::bone`). A head's bone is that skull under
//! the map that takes the canonical landmarks to the head's own.

pub mod field;
mod half;
pub mod landmarks;
pub mod teeth;
mod warp;

pub use field::BoneField;
pub use half::BoneHalf;
pub use landmarks::{BoneMesh, LANDMARKS, Landmark, Targets, targets};

use super::proportions::Proportions;
use super::{ControlError, Measures};
use crate::mesh::DedgeMesh;
use glam::Vec3;
use warp::Warp;

/// The skull as baked.
pub const SKULL: &str = include_str!("../../../assets/skull.ron");
/// The mandible as baked.
pub const MANDIBLE: &str = include_str!("../../../assets/mandible.ron");

/// One bone, immutable.
#[derive(Clone, Debug)]
pub struct Bone {
    half: BoneHalf,
    mesh: DedgeMesh,
    warp: Warp,
}

impl Bone {
    fn new(text: &str) -> Result<Bone, ControlError> {
        let half: BoneHalf = ron::from_str(text)?;
        let mesh = half.mesh().map_err(ControlError::Mesh)?;
        let warp = Warp::new(half.base.iter().map(|&p| Vec3::from(p)));
        Ok(Bone { half, mesh, warp })
    }

    /// Connectivity of the whole mesh.
    pub fn mesh(&self) -> &DedgeMesh {
        &self.mesh
    }

    /// The left half, with the landmarks that are vertices.
    pub fn half(&self) -> &BoneHalf {
        &self.half
    }
}

/// Skull, mandible and teeth, immutable: one per program.
#[derive(Clone, Debug)]
pub struct Bones {
    /// Cranium and upper jaw.
    pub skull: Bone,
    /// Lower jaw.
    pub mandible: Bone,
}

/// One head's bones; buffers are made once and written again for every breed. Metres, head's frame.
#[derive(Clone, Debug, Default)]
pub struct BonesOfHead {
    half: Vec<Vec3>,
    /// Where the landmarks were meant to be, none before the first head.
    pub targets: Option<Targets<Vec3>>,
    /// Control positions of the skull.
    pub skull: Vec<Vec3>,
    /// Control positions of the mandible.
    pub mandible: Vec<Vec3>,
    /// Crowns of the upper teeth: [`teeth::TOOTH_VERTICES`] for each of twenty.
    pub upper_teeth: Vec<Vec3>,
    /// Crowns of the lower teeth, twenty-two.
    pub lower_teeth: Vec<Vec3>,
}

impl Bones {
    /// The bones that are part of the program.
    ///
    /// # Errors
    /// Where a baked asset is not one.
    pub fn embedded() -> Result<Bones, ControlError> {
        Ok(Bones { skull: Bone::new(SKULL)?, mandible: Bone::new(MANDIBLE)? })
    }

    /// The bones of one head.
    pub fn shape(&self, measures: &Measures, proportions: &Proportions, out: &mut BonesOfHead) {
        let targets = targets(measures, proportions);
        let list = targets.list();
        let BonesOfHead { half, targets: meant, skull, mandible, upper_teeth, lower_teeth } = out;
        *meant = Some(targets);
        for (bone, whole) in [(&self.skull, skull), (&self.mandible, mandible)] {
            bone.warp.apply(&list, half);
            for (p, &middle) in half.iter_mut().zip(&bone.half.midline) {
                if middle {
                    p.x = 0.0;
                }
            }
            bone.half.unfold(half, whole);
        }
        teeth::place(&targets, true, upper_teeth);
        teeth::place(&targets, false, lower_teeth);
    }

    /// The left landmark, or that in the median plane, on a head's bone: a vertex of the mesh where it is one, which the
    /// interpolating refinement keeps; where it is none, the constructed point.
    pub fn landmark(&self, id: &str, head: &BonesOfHead) -> Option<Vec3> {
        let on = |bone: &Bone, positions: &[Vec3]| {
            let (_, vertex) = bone.half.landmarks.iter().find(|(known, _)| known == id)?;
            positions.get(usize::from(*vertex)).copied()
        };
        let constructed = || {
            let k = LANDMARKS.iter().position(|l| l.id == id)?;
            Some(head.targets.as_ref()?.list()[k])
        };
        on(&self.skull, &head.skull).or_else(|| on(&self.mandible, &head.mandible)).or_else(constructed)
    }

    /// Every left or median landmark of a head by id, metres, without its bones: where [`Bones::landmark`] finds it on them,
    /// to the bit, in a hundredth of the time.
    pub fn landmarks_alone(&self, measures: &Measures, proportions: &Proportions) -> Vec<(&'static str, Vec3)> {
        let targets = targets(measures, proportions);
        let list = targets.list();
        let on = |bone: &Bone, id: &str| {
            let (_, vertex) = bone.half.landmarks.iter().find(|(known, _)| known == id)?;
            let vertex = usize::from(*vertex);
            let p = bone.warp.at(vertex, &list)?;
            Some(if bone.half.midline.get(vertex) == Some(&true) { p.with_x(0.0) } else { p })
        };
        let place = |k: usize, id| on(&self.skull, id).or_else(|| on(&self.mandible, id)).unwrap_or(list[k]);
        LANDMARKS.iter().enumerate().map(|(k, l)| (l.id, place(k, l.id))).collect()
    }

    /// Indices of a jaw's teeth, three for each triangle.
    pub fn tooth_indices(upper: bool) -> Vec<u32> {
        let n = if upper { teeth::UPPER.len() } else { teeth::LOWER.len() };
        let mut indices = Vec::new();
        for i in 0..2 * n {
            teeth::indices((i * teeth::TOOTH_VERTICES) as u32, (i >= n) != upper, &mut indices);
        }
        indices
    }
}
