//! The mandible: it turns about both condyles and glides a little, and takes the skin of the lower jaw along.
//!
//! Between what goes with the mandible and what stays with the skull a vertex makes a part of the turn about the same
//! hinge, so that it runs on an arc and the cheek neither sinks in nor tears. The corner of the mouth is drawn back towards
//! the hinge besides, or a wide mouth would be closed by a sheet from lip to lip.

use super::rigid::Rigid;
use super::zones::{Neighbours, fade, smoothstep};
use crate::math::ops;
use crate::motion::{Channel, Pose};
use crate::rig::handles::{Handles, NONE};
use glam::{Mat3, Vec3, vec3};

/// Where the corner of the mouth goes, as a part of the mandible's turn: nearer to the upper lip, which is longer there.
const CORNER: f32 = 0.22;
const ROUNDS: usize = 400;
/// How far the corner of the mouth is drawn back in a mouth that opens at a right angle, as a part of its way from the hinge:
/// its fold is taut between the jaws.
const DRAWN: f32 = 0.4;
/// How far from the corner skin follows it, head units of the base head. Flews hang farther below it, and beside the mandible.
const REACH: f32 = 3.5;

/// Weight of the mandible's turn for each vertex of the whole mesh; `images`: of the half's vertices.
pub(super) fn weights(h: &Handles, images: &[u32], regions: &Neighbours, n: usize) -> Vec<f32> {
    let mut held: Vec<Option<f32>> = vec![Some(0.0); n];
    let mut set = |v: u16, weight: Option<f32>| {
        if v != NONE {
            held[usize::from(v)] = weight;
            held[images[usize::from(v)] as usize] = weight;
        }
    };
    // Free: cheek below the arch, throat, lips near their corner.
    for i in 8..17 {
        for j in 6..10 {
            if i > 10 || j >= 8 {
                set(h.s[i][j], None);
            }
        }
    }
    for i in 3..19 {
        // From ring 10 on column 9 is the cheek's.
        for j in if i < 10 { 9 } else { 10 }..15 {
            let on_bone = i < 9 || (i < 12 && j > 11) || (i < 11 && j == 11);
            // Below the hinge skin would go back into the throat, which is full.
            let weight = if i > 17 { Some(0.0) } else { on_bone.then_some(1.0) };
            set(h.l[i][j], weight);
        }
    }
    for i in 3..11 {
        for p in 1..4 {
            // The lining goes with the lip that it lines.
            set(h.ml[i][p], if i < 9 { Some(1.0) } else { None });
            if i >= 9 {
                set(h.mu[i][p], None);
            }
        }
    }
    set(h.s[10][9], Some(CORNER));
    regions.passage(&held, ROUNDS)
}

/// How far each vertex of the whole mesh is drawn back as the jaw opens, as a part of what the corners of the mouth are;
/// `base`: the base head.
pub(super) fn drawn(h: &Handles, images: &[u32], regions: &Neighbours, base: &[Vec3]) -> Vec<f32> {
    let corner = h.s[10][9];
    let both = [u32::from(corner), images[usize::from(corner)]];
    let ways = regions.ways(base, &both.map(|v| (v, 0.0)), REACH);
    let mut drawn: Vec<f32> = ways.into_iter().map(|way| fade(way, REACH)).collect();
    // The lining goes with the lip that it lines.
    for i in 3..11 {
        for (margin, lining) in [(h.s[i][9], h.mu[i]), (if i < 10 { h.l[i][9] } else { corner }, h.ml[i])] {
            for v in lining.into_iter().filter(|&v| v != NONE && margin != NONE) {
                for v in [usize::from(v), images[usize::from(v)] as usize] {
                    drawn[v] = drawn[usize::from(margin)];
                }
            }
        }
    }
    drawn
}

/// How far a tongue that is out keeps the jaw open, degrees.
const BY_TONGUE: f32 = 9.0;
/// The least gape that the pose's tongue asks for, degrees: it goes out between the teeth.
pub(super) fn opened(pose: &Pose) -> f32 {
    BY_TONGUE * smoothstep(0.0, 12.0, pose.median(Channel::TongueOut))
}

/// The mandible in the head's frame; `hinge`: the middle of both condyles, `unit`: metres of a millimetre of the head with a
/// skull of 200 mm.
pub(super) fn mandible(hinge: Vec3, unit: f32, pose: &Pose) -> Rigid {
    turned(hinge, unit, pose, 1.0)
}

/// The same with a part of its turn and of its glide.
pub(super) fn turned(hinge: Vec3, unit: f32, pose: &Pose, part: f32) -> Rigid {
    let [gape, forward, aside] =
        [Channel::JawGape, Channel::JawProtrusion, Channel::JawSlide].map(|c| pose.median(c) * part);
    if gape == 0.0 && forward == 0.0 && aside == 0.0 {
        return Rigid::default();
    }
    Rigid::about(hinge, Mat3::from_rotation_x(gape.to_radians()), vec3(aside, 0.0, forward) * unit)
}

/// Way back of the corner of the mouth, metres; `far`: its distance from the hinge.
pub(super) fn back(far: f32, pose: &Pose) -> f32 {
    let gape = pose.median(Channel::JawGape).to_radians();
    DRAWN * far * (1.0 - ops::cos(gape))
}
