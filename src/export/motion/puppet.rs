//! The control mesh and the tongue of one head in any pose, and where its joints are then.

use super::bend::Bend;
use super::joints::{EARS, EYES, HEAD, JAW, N_JOINTS, NECK, TONGUE, between};
use super::rigid_fit::rigid_fit;
use super::weights::{Dense, of_control, of_tongue};
use crate::motion::Pose;
use crate::rig::mouth::{Mouth, MouthOfHead, bend_tongue};
use crate::rig::{Deformed, EAR_RINGS, Eye, Rig, Rigid, deform};
use glam::{Mat3, Vec3};
use std::sync::Arc;

/// Rings of an ear that each of its joints goes with.
const RINGS: [std::ops::RangeInclusive<usize>; 3] = [1..=2, 3..=5, 6..=EAR_RINGS];
/// How near to a joint of the tongue what it goes with lies, parts of the tongue's length.
const NEAR: f32 = 0.1;

/// A head's control mesh, its tongue, and the joints.
pub(super) struct Puppet {
    rig: Arc<Rig>,
    values: Vec<f32>,
    head: Deformed,
    mouth: MouthOfHead,
    /// Metres of a millimetre of the head with a skull of 200 mm, and how far in front its skin reaches.
    size: (f32, f32),
    /// Control positions of skin and tongue at rest, one after the other, and their weights.
    rest: Vec<Vec3>,
    weights: Vec<Dense>,
    eyes: [Eye; 2],
    joints: [Vec3; N_JOINTS],
    /// Skin vertices of each ear's joints, and the tongue's.
    ears: [[Vec<usize>; 3]; 2],
    tongue: [Vec<usize>; 4],
    /// Of the last pose, as `rest`.
    posed: Vec<Vec3>,
    bent: Vec<Vec3>,
}

/// Where the tongue's joints stand, parts of its length.
pub(super) const ON_TONGUE: [f32; 4] = [0.15, 0.45, 0.7, 0.92];

impl Puppet {
    pub fn new(rig: Arc<Rig>, values: &[f32]) -> Self {
        let mut head = Deformed::default();
        rig.deform(values, deform::ROUNDS, &mut head);
        let of_head = rig.of_head(values, &mut head);
        let (size, hinge, pivot) = ((of_head.unit, of_head.front), of_head.hinge, of_head.pivot);
        let mut mouth = MouthOfHead::default();
        Mouth::default().shape(&rig.measures(values), &rig.proportions(values), &mut mouth);

        let handles = rig.plan().handles();
        let ears: [[Vec<usize>; 3]; 2] = [0, 1].map(|side| {
            RINGS.map(|rings| {
                let of_ring = |k: usize| if k < EAR_RINGS { handles.a[k].to_vec() } else { handles.ear_end.to_vec() };
                let left = rings.flat_map(of_ring).map(usize::from);
                left.map(|v| if side == 0 { v } else { rig.image(v) }).collect()
            })
        });
        let along = along(&mouth.tongue);
        let tongue =
            ON_TONGUE.map(|at| (0..along.len()).filter(|&v| (along[v] - at).abs() < NEAR).collect::<Vec<usize>>());
        let mean = |from: &[Vec3], of: &[usize]| of.iter().map(|&v| from[v]).sum::<Vec3>() / of.len().max(1) as f32;
        let mut joints = [Vec3::ZERO; N_JOINTS];
        (joints[NECK], joints[HEAD], joints[JAW]) = (pivot, pivot, hinge);
        for side in 0..2 {
            joints[EYES[side]] = head.eyes[side].centre;
        }
        for (&joint, vertices) in EARS.iter().flatten().zip(ears.iter().flatten()) {
            joints[joint] = mean(&head.control, vertices);
        }
        for (&joint, vertices) in TONGUE.iter().zip(&tongue) {
            joints[joint] = mean(&mouth.tongue, vertices).with_x(0.0);
        }
        let mut weights = of_control(&rig);
        weights.extend(along.iter().map(|&at| of_tongue(between(at, &ON_TONGUE))));
        let rest = [&head.control[..], &mouth.tongue].concat();
        let (eyes, posed) = (head.eyes, rest.clone());
        let values = values.to_vec();
        Self { rig, values, head, mouth, size, rest, weights, eyes, joints, ears, tongue, posed, bent: Vec::new() }
    }

    pub fn rig(&self) -> &Rig {
        &self.rig
    }

    /// Where the joints are at rest.
    pub fn joints(&self) -> &[Vec3; N_JOINTS] {
        &self.joints
    }

    /// Length of the tongue from its root, as ends along z.
    pub fn tongue_ends(&self) -> [f32; 2] {
        ends(&self.mouth.tongue)
    }

    /// Takes a pose and tells where the joints are in it.
    pub fn take(&mut self, pose: &Pose) -> Bend {
        let Self { rig, values, head, posed, bent, rest, .. } = self;
        rig.pose(values, pose, head);
        let places = head.places;
        bend_tongue(&self.mouth, &rig.posing().possible(pose), &places.jaw, self.size, bent);
        let n = head.control.len();
        posed[..n].copy_from_slice(&head.control);
        for (to, &p) in posed[n..].iter_mut().zip(bent.iter()) {
            *to = places.mandible.point(p);
        }
        let neck = rig.posing().neck_end(rig.of_head(values, head), pose);
        let mut all = [places.head; N_JOINTS];
        (all[NECK], all[JAW]) = (neck, places.mandible);
        for side in 0..2 {
            let (was, is) = (&self.eyes[side], &head.eyes[side]);
            let turn = Mat3::from_cols_array_2d(&is.axes.map(Vec3::into))
                * Mat3::from_cols_array_2d(&was.axes.map(Vec3::into)).transpose();
            all[EYES[side]] = Rigid { turn, shift: is.centre - turn * was.centre };
        }
        let fit =
            |vertices: &[usize], first: usize| rigid_fit(vertices.iter().map(|&v| (rest[first + v], posed[first + v])));
        for (&joint, vertices) in EARS.iter().flatten().zip(self.ears.iter().flatten()) {
            all[joint] = fit(vertices, 0);
        }
        for (&joint, vertices) in TONGUE.iter().zip(&self.tongue) {
            all[joint] = fit(vertices, n);
        }
        Bend(all)
    }

    /// What the joints leave over of the last pose: for each point, how far it must go at rest to come to lie right.
    pub fn missing(&self, bend: &Bend) -> Vec<Vec3> {
        let points = self.rest.iter().zip(&self.posed).zip(&self.weights);
        points.map(|((&rest, &posed), weights)| bend.back(weights).transform_point3(posed) - rest).collect()
    }
}

/// How far each point lies along the tongue, 0 to 1: at rest its sections stand upright.
fn along(tongue: &[Vec3]) -> Vec<f32> {
    let [back, front] = ends(tongue);
    tongue.iter().map(|p| ((p.z - back) / (front - back).max(1e-6)).clamp(0.0, 1.0)).collect()
}

fn ends(tongue: &[Vec3]) -> [f32; 2] {
    tongue.iter().fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], p| [low.min(p.z), high.max(p.z)])
}
