//! What the skin's regions are made of: materials of faces, colours and surface qualities of control vertices. Both go
//! through the same stencils as the positions, so that borders between regions are soft.

use super::parts::{Material, MaterialRange, PartTopology};
use crate::anatomy::{Look, Region};
use crate::mesh::VertexId;
use crate::rig::Rig;
use crate::subdiv::{Plan, Tags};
use glam::{Vec3, vec3};

/// The lining of the lids, linear.
const CONJUNCTIVA: Vec3 = vec3(0.34, 0.055, 0.05);

/// Material of a control face by the regions of its corners.
fn material(regions: [Region; 3]) -> Material {
    use Region::{Lid, Mouth, Nose, Nostril};
    if regions.contains(&Mouth) {
        Material::Mouth
    } else if regions.iter().all(|r| matches!(r, Nose | Nostril)) {
        Material::Nose
    } else if regions.iter().all(|r| matches!(r, Lid)) {
        Material::Lip
    } else {
        Material::Coat
    }
}

/// What is sharp of the skin: every plan of it is built with these.
pub fn tags(rig: &Rig) -> Tags {
    let creases = rig.creases().map(|(a, b, sharpness)| (VertexId(a), VertexId(b), sharpness)).collect();
    Tags { creases, ..Tags::default() }
}

/// The skin's faces sorted by material.
pub(super) fn topology(rig: &Rig, plan: &Plan) -> PartTopology {
    let (indices, ranges) = by_material(rig, plan.indices(), plan.face_parent());
    PartTopology { name: "skin", n_vertices: plan.n_vertices(), indices, ranges }
}

/// Faces sorted by the material of their control faces; inside a material in the given order.
pub(super) fn by_material(rig: &Rig, faces: &[u32], face_parent: &[u32]) -> (Vec<u32>, Vec<MaterialRange>) {
    let regions = rig.half().whole_regions();
    let control = rig.mesh().indices();
    let of_face: Vec<Material> = control
        .chunks_exact(3)
        .map(|f| material([regions[f[0] as usize], regions[f[1] as usize], regions[f[2] as usize]]))
        .collect();
    let mut indices = Vec::with_capacity(faces.len());
    let mut ranges = Vec::new();
    for wanted in [Material::Coat, Material::Nose, Material::Lip, Material::Mouth] {
        let start = indices.len() as u32;
        for (face, &parent) in faces.chunks_exact(3).zip(face_parent) {
            if of_face[parent as usize] == wanted {
                indices.extend_from_slice(face);
            }
        }
        let count = indices.len() as u32 - start;
        if count > 0 {
            ranges.push(MaterialRange { material: wanted, start, count });
        }
    }
    (indices, ranges)
}

/// Colour of a region's leather, linear, and how much of it shows, 0 to 1.
fn leather(look: &Look, region: Region) -> (Vec3, f32) {
    match region {
        Region::Nose => (look.nose, 1.0),
        Region::Nostril => (look.nose * 0.35, 1.0),
        Region::Lid => (look.lips * 0.7, 1.0),
        // The margin itself is bare and dark; hair comes close to it.
        Region::UpperLip | Region::LowerLip => (look.lips, 0.72),
        Region::Mouth => (look.mouth, 1.0),
        _ => (Vec3::ZERO, 0.0),
    }
}

/// Fur, gloss, occlusion of a region.
fn surface(look: &Look, region: Region) -> Vec3 {
    let (fur, gloss, occlusion) = match region {
        Region::Nose => (0.0, 1.0, 0.0),
        Region::Nostril => (0.0, 0.6, 1.0),
        Region::Lid => (0.0, 0.7, 0.35),
        Region::UpperLip | Region::LowerLip => (0.25, 0.45, 0.25),
        Region::Mouth => (0.0, 0.9, 0.75),
        Region::EarInner => (0.35, 0.05, 0.30),
        Region::Orbit => (0.75, 0.0, 0.12),
        _ => (1.0, 0.0, 0.0),
    };
    vec3(fur * look.fur, gloss, occlusion)
}

/// Leather and surface qualities of the control vertices (one each). `leathers`: the colour times how much of it shows;
/// `bare`: x how much that is, 0 to 1. `haw`: how much the lower lid's lining is seen, 0 to 1.
pub(super) fn paint(
    rig: &Rig,
    look: &Look,
    haw: f32,
    leathers: &mut [Vec3],
    bare: &mut [Vec3],
    qualities: &mut [Vec3],
) {
    let regions = rig.half().whole_regions();
    for (v, &region) in regions.iter().enumerate() {
        let (colour, part) = leather(look, region);
        (leathers[v], bare[v]) = (colour * part, Vec3::splat(part));
        qualities[v] = surface(look, region);
    }
    // A hanging lid shows what lies on the ball's side of its margin.
    for v in rig.lower_conjunctiva() {
        leathers[v] = leathers[v].lerp(CONJUNCTIVA, haw);
        qualities[v] = qualities[v].lerp(vec3(0.0, 1.0, 0.1), haw);
    }
    // The lining's outermost row is the lip's inner side.
    for (v, pigment) in rig.inner_lip() {
        leathers[v] = look.mouth.lerp(look.lips, pigment);
    }
}

/// Puts leather on the coat's colours (one for each vertex of the refined skin); `leathers` and `bare` as [`paint`] made
/// them, refined.
pub(super) fn put_leather_on(coat: &mut [Vec3], leathers: &[Vec3], bare: &[Vec3]) {
    for ((colour, leather), bare) in coat.iter_mut().zip(leathers).zip(bare) {
        *colour = leathered(*colour, *leather, *bare);
    }
}

/// A coat's colour with leather on it, as much as shows.
pub(super) fn leathered(coat: Vec3, leather: Vec3, bare: Vec3) -> Vec3 {
    coat * (1.0 - bare.x.clamp(0.0, 1.0)) + leather
}
