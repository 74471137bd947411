//! Length and direction of hair at every control vertex, by its region.

use super::{borders, is_bare};
use crate::anatomy::{Hair, Region};
use crate::mesh::VertexId;
use crate::rig::Rig;
use glam::{Vec3, vec3};

/// Rounds of averaging with the neighbours, so that a short place goes over into a long one softly.
const ROUNDS: usize = 2;
/// Hair beside what is bare, as a part of what it would be.
const BESIDE_BARE: f32 = 0.8;
/// Hair on the rim of the nose pad and on the fold of the lids, as a part of the muzzle's, and at most, metres.
const BORDER: (f32, f32) = (0.4, 0.002);
/// The longest hair around the eyes, metres: beyond it no dog would see.
const AROUND_EYES: f32 = 0.007;

/// The longest hair between the eyes, metres, where it lies backwards.
const BEFORE_EYES: f32 = 0.022;

/// Length in metres of a region's hair, and how far it stands off the skin, as a factor.
fn growth(hair: &Hair, region: Region) -> (f32, f32) {
    use Region::*;
    let Hair { muzzle, head, topknot, neck, ear, fringe, beard, brow, .. } = *hair;
    let mean = |a: f32, b: f32| 0.5 * (a + b);
    match region {
        Nose | Nostril | Lid | Mouth => (0.0, 0.0),
        UpperLip | LowerLip => ((0.9 * muzzle).min(0.006), 0.7),
        Bridge => (muzzle, 0.7),
        MuzzleSide => (mean(muzzle, beard), 0.8),
        WhiskerPad => (muzzle + 0.3 * (beard - muzzle), 0.8),
        Chin | LowerJaw => (beard, 0.9),
        Stop | Blaze => (mean(muzzle, head).min(BEFORE_EYES), 0.8),
        Brow => (brow, 1.1),
        Orbit => ((0.25 * head).clamp(head.min(0.0025), AROUND_EYES), 0.7),
        Forehead => (mean(head, topknot), 0.9),
        Crown => (topknot, 1.0),
        Temple => (head, 1.0),
        Cheek => (1.15 * head, 1.0),
        EarOuter => (ear, 0.8),
        EarInner => ((0.5 * ear).min(0.008), 0.7),
        EarEdge => (mean(ear, fringe), 0.7),
        Throat => (mean(head, neck), 1.0),
        Nape => (0.8 * neck, 1.0),
        NeckSide => (neck, 1.1),
        NeckFront => (1.1 * neck, 1.1),
    }
}

/// What is added to the unit direction of hair, +x away from the median plane. Long hair parts in the middle and falls;
/// beards and brows hang forward.
fn comb(hair: &Hair, region: Region) -> Vec3 {
    use Region::*;
    // How far hair of this length is from lying where it grows.
    let long = |length: f32, from: f32, to: f32| ((length - from) / (to - from)).clamp(0.0, 1.0);
    let beard = long(hair.beard, 0.010, 0.040);
    let brow = long(hair.brow, 0.012, 0.030);
    let parted = long(hair.topknot, 0.040, 0.090);
    let bridge = long(hair.muzzle, 0.012, 0.040);
    match region {
        Bridge | Stop => vec3(1.2, -0.6, 0.3) * bridge,
        MuzzleSide | WhiskerPad => vec3(0.10, -0.10, 0.0) + vec3(0.3, -1.2, 0.9) * beard,
        Chin | LowerJaw => vec3(0.0, -0.9, 0.9) * beard,
        Brow => vec3(0.5, 0.2, 1.9) * brow,
        Forehead | Blaze | Crown => vec3(1.3, -0.3, 0.2) * parted,
        Cheek => vec3(0.15, -0.45, 0.0),
        Temple => vec3(0.15, -0.35, 0.0),
        Throat | NeckFront | NeckSide => vec3(0.0, -0.30, 0.0),
        _ => Vec3::ZERO,
    }
}

/// Grooms a breed: for every control vertex of the whole mesh (`growths` and `combs`: one each) what
/// [`Coat`](super::Coat) has for the vertices of the refined skin. Bare regions have length 0, but for their rims. `occlusion`: how deep each
/// control vertex is hidden, 0 to 1.
pub fn groom(rig: &Rig, hair: &Hair, occlusion: impl Fn(usize) -> f32, growths: &mut [Vec3], combs: &mut [Vec3]) {
    let regions = rig.half().whole_regions();
    let n_half = rig.half().n_half();
    let borders = borders(rig, &regions);
    let border = (BORDER.0 * hair.muzzle).min(BORDER.1);
    let is_bare = |v: usize| is_bare(regions[v]);
    for (v, &region) in regions.iter().enumerate() {
        let (length, stand) = growth(hair, region);
        let beside_bare = rig.mesh().ring(VertexId(v as u32)).any(|u| is_bare(u.0 as usize));
        let shorter = if beside_bare { BESIDE_BARE } else { 1.0 };
        let (length, stand) = if borders[v] { (border, 0.7) } else { (length * shorter, stand) };
        growths[v] = vec3(length, stand, occlusion(v));
        let side = match v {
            v if v >= n_half => -1.0,
            v if rig.half().midline[v] => 0.0,
            _ => 1.0,
        };
        combs[v] = comb(hair, region) * vec3(side, 1.0, 1.0);
    }
    for _ in 0..ROUNDS {
        let before = growths.to_vec();
        for (v, &region) in regions.iter().enumerate() {
            let keeps_its_own =
                matches!(region, Region::Orbit | Region::UpperLip | Region::LowerLip | Region::EarInner);
            if keeps_its_own || is_bare(v) {
                continue;
            }
            let (mut sum, mut n) = (before[v].x * 2.0, 2.0);
            for u in rig.mesh().ring(VertexId(v as u32)).filter(|u| !is_bare(u.0 as usize)) {
                sum += before[u.0 as usize].x;
                n += 1.0;
            }
            growths[v].x = sum / n;
        }
    }
}
