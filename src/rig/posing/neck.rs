//! The head on its neck: a turn about the joint behind the occiput, of which the neck makes a part.

use super::rigid::Rigid;
use super::zones::Neighbours;
use crate::motion::{Channel, Pose};
use crate::rig::handles::{Handles, NONE};
use glam::{EulerRot, Mat3, Vec3, vec3};

/// How much of the head's turn the cut end of the neck makes: it lies in the middle of the vertebrae that share it.
pub(super) const END: f32 = 0.45;
/// How much of the head's way forward or back a part of the neck makes that turns with nothing.
const GLIDES: f32 = 0.75;
const ROUNDS: usize = 60;
/// How far the head goes down, degrees, and what of that is lost for a degree of gape, of turn and of tilt: then the lower jaw
/// comes to the throat earlier.
const DOWN: f32 = 70.0;
const LOST: [(Channel, f32); 3] = [(Channel::JawGape, 0.6), (Channel::HeadTurn, 0.45), (Channel::HeadTilt, 0.5)];

/// Weight of the head's turn for each vertex of the whole mesh.
pub(super) fn weights(h: &Handles, images: &[u32], neighbours: &Neighbours, n: usize) -> Vec<f32> {
    let mut held: Vec<Option<f32>> = vec![Some(1.0); n];
    for i in 17..20 {
        for v in h.s[i].into_iter().chain(h.l[i]).filter(|&v| v != NONE) {
            let weight = (i == 19).then_some(END);
            held[usize::from(v)] = weight;
            held[images[usize::from(v)] as usize] = weight;
        }
    }
    neighbours.passage(&held, ROUNDS)
}

/// The least nod of a pose, degrees, negative: as far down as the lower jaw is off the throat.
pub(super) fn lowest(pose: &Pose) -> f32 {
    let lost: f32 = LOST.iter().map(|&(c, part)| part * pose.median(c).abs()).sum();
    -(DOWN - lost).max(0.0)
}

/// The head's place; `pivot`: the joint, metres; `part`: of the turn.
pub(super) fn turned(pivot: Vec3, unit: f32, pose: &Pose, part: f32) -> Rigid {
    let of = |c: Channel| pose.median(c) * part;
    let [turn, nod, tilt] = [Channel::HeadTurn, Channel::HeadNod, Channel::HeadTilt].map(|c| of(c).to_radians());
    // The whole neck stretches and draws in: its end goes most of the way along.
    let forward = pose.median(Channel::HeadForward) * (GLIDES + (1.0 - GLIDES) * part);
    if turn == 0.0 && nod == 0.0 && tilt == 0.0 && forward == 0.0 {
        return Rigid::default();
    }
    // The nose is at +z: up is a negative turn about x, the crown to the left a negative one about z.
    let turn = Mat3::from_euler(EulerRot::YXZ, turn, -nod, -tilt);
    Rigid::about(pivot, turn, vec3(0.0, 0.0, forward * unit))
}
