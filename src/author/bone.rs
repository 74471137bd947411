//! The control meshes of the bones, from the field of the canonical skull.

use super::nets;
use crate::rig::bone::{BoneField, BoneHalf, BoneMesh, LANDMARKS, Landmark, Targets};
use glam::vec3;

/// Length of a cell, millimetres: fine enough for the zygomatic arch.
const CELL: f32 = 3.0;
/// The half mesh of a bone.
pub fn half(bone: BoneMesh) -> BoneHalf {
    let field = BoneField::new(bone, &Targets::CANONICAL, 1.0);
    let landmarks: Vec<&Landmark> = LANDMARKS.iter().filter(|l| l.on == Some(bone)).collect();
    nets::half(&field, vec3(0.0, -45.0, -70.0), vec3(60.0, 75.0, 150.0), CELL, &landmarks)
}
