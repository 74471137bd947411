//! What hair is like at every control vertex, by its region.

use super::borders;
use crate::anatomy::{Hair, Region, Tuft};
use crate::mesh::VertexId;
use crate::rig::Rig;
use glam::{Vec3, vec3};

/// Rounds of averaging with the neighbours, so that a short place goes over into a long one softly.
const ROUNDS: usize = 2;
/// Hair beside what is bare, as a part of what it would be.
const BESIDE_BARE: f32 = 0.8;
/// Hair on the rim of the nose pad and on the fold of the lids, as a part of the muzzle's, and at most, metres.
const BORDER: (f32, f32) = (0.4, 0.002);

/// Hair at a vertex of the skin, as the shaders read it: sixteen numbers.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Groom {
    /// Metres; 0 where no hair grows.
    pub length: f32,
    /// How far hair stands off the skin: about 0 lies close, 1 stands.
    pub lift: f32,
    /// How deep the place is hidden, 0 to 1.
    pub hidden: f32,
    /// 0 dull, 1 silky.
    pub gloss: f32,
    /// What is to be added to the unit direction in which hair grows, head's frame.
    pub comb: Vec3,
    /// Part of the strands that grow.
    pub density: f32,
    /// 0 straight, 1 in ringlets.
    pub curl: f32,
    /// 0 each hair for itself, 1 in locks.
    pub clump: f32,
    /// 0 soft, 1 stiff as wire.
    pub wire: f32,
    /// Part of the strands that are undercoat.
    pub undercoat: f32,
    /// How early hair turns grey there, 0 to 1.
    pub grey: f32,
    /// Where hair lies on the base head; about unit length, zero where there is none.
    pub rest_flow: Vec3,
}

/// The numbers of [`Groom`] that go through the tables of the skin, three at a time.
pub const N_CHANNELS: usize = 5;

impl Groom {
    /// From what [`groom()`] has made, refined, and where hair lies on the base head.
    pub fn of_channels([growth, comb, nature, body, age]: [Vec3; N_CHANNELS], rest_flow: Vec3) -> Self {
        Self {
            length: growth.x,
            lift: growth.y,
            hidden: growth.z,
            gloss: body.x,
            comb,
            density: body.y,
            curl: nature.x,
            clump: nature.y,
            wire: nature.z,
            undercoat: body.z,
            grey: age.x,
            rest_flow,
        }
    }
}

/// How early a region's hair turns grey, 0 to 1: from the chin backwards and around the eyes.
fn grey(region: Region) -> f32 {
    use Region::*;
    match region {
        Chin | UpperLip | LowerLip => 1.0,
        WhiskerPad | LowerJaw => 0.9,
        MuzzleSide => 0.75,
        Bridge | Orbit | Brow => 0.6,
        Stop | Blaze | Cheek => 0.3,
        Forehead | Temple | Throat | EarEdge => 0.18,
        Crown | EarOuter | EarInner | Nape | NeckSide | NeckFront => 0.08,
        Nose | Nostril | Lid | Mouth => 0.0,
    }
}

/// Grooms a breed: `channels` get the numbers of [`Groom::of_channels`] for every control vertex of the whole mesh. Bare
/// regions have length 0, but for their rims. `occlusion`: how deep each control vertex is hidden, 0 to 1.
pub fn groom(rig: &Rig, hair: &Hair, occlusion: impl Fn(usize) -> f32, channels: &mut [Vec<Vec3>; N_CHANNELS]) {
    let tufts = Region::ALL.map(|region| hair.at(region));
    let regions = rig.half().whole_regions();
    let n_half = rig.half().n_half();
    let borders = borders(rig, &regions);
    let border = (BORDER.0 * hair.muzzle).min(BORDER.1);
    let [growths, combs, natures, bodies, ages] = channels;
    for values in [&mut *growths, &mut *combs, &mut *natures, &mut *bodies, &mut *ages] {
        values.resize(regions.len(), Vec3::ZERO);
    }
    for (v, &region) in regions.iter().enumerate() {
        let Tuft { length, stand, curl, clump, lift, wire, gloss, density, undercoat, comb } = tufts[region as usize];
        let beside_bare = rig.mesh().ring(VertexId(v as u32)).any(|u| regions[u.0 as usize].is_bare());
        let shorter = if beside_bare { BESIDE_BARE } else { 1.0 };
        let (length, stand) = if borders[v] { (border, 0.7) } else { (length * shorter, stand) };
        growths[v] = vec3(length, (0.14 + 0.70 * lift) * stand, occlusion(v));
        let side = match v {
            v if v >= n_half => -1.0,
            v if rig.half().midline[v] => 0.0,
            _ => 1.0,
        };
        combs[v] = Vec3::from(comb) * vec3(side, 1.0, 1.0);
        natures[v] = vec3(curl, clump, wire);
        bodies[v] = vec3(gloss, density, undercoat);
        ages[v] = vec3(grey(region), 0.0, 0.0);
    }
    for _ in 0..ROUNDS {
        let before = growths.clone();
        for (v, &region) in regions.iter().enumerate() {
            let keeps_its_own =
                matches!(region, Region::Orbit | Region::UpperLip | Region::LowerLip | Region::EarInner);
            if keeps_its_own || region.is_bare() {
                continue;
            }
            let (mut sum, mut n) = (before[v].x * 2.0, 2.0);
            for u in rig.mesh().ring(VertexId(v as u32)).filter(|u| !regions[u.0 as usize].is_bare()) {
                sum += before[u.0 as usize].x;
                n += 1.0;
            }
            growths[v].x = sum / n;
        }
    }
}
