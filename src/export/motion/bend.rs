//! Where all joints are in a pose, and what that alone does to what hangs on them (linear blend skinning, as clients do it).

use super::joints::{N_JOINTS, PARENTS};
use super::weights::Dense;
use crate::rig::Rigid;
use glam::{Affine3A, Mat3, Quat, Vec3};

/// Of each joint, from the head at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Bend(pub [Rigid; N_JOINTS]);

/// A blend whose volume is less than this part of what it was cannot be taken back.
const THINNEST: f32 = 0.02;

impl Bend {
    /// The mean of the joints' turns and shifts.
    pub fn blend(&self, weights: &Dense) -> Affine3A {
        let mut turn = Mat3::ZERO;
        let mut shift = Vec3::ZERO;
        for (rigid, &weight) in self.0.iter().zip(weights).filter(|(_, w)| **w != 0.0) {
            turn += rigid.turn * weight;
            shift += rigid.shift * weight;
        }
        Affine3A::from_mat3_translation(turn, shift)
    }

    /// What takes a place back that these weights have blended; where they cannot be, the heaviest joint alone.
    pub fn back(&self, weights: &Dense) -> Affine3A {
        let blend = self.blend(weights);
        if blend.matrix3.determinant() > THINNEST {
            return blend.inverse();
        }
        let heaviest = (0..N_JOINTS).fold(0, |a, b| if weights[b] > weights[a] { b } else { a });
        let Rigid { turn, shift } = self.0[heaviest];
        Affine3A::from_mat3_translation(turn, shift).inverse()
    }

    /// A joint's turn and place in the one it hangs on; `rest`: where all joints are at rest.
    pub fn local(&self, joint: usize, rest: &[Vec3; N_JOINTS]) -> (Quat, Vec3) {
        let own = &self.0[joint];
        let at = own.point(rest[joint]);
        let Some(parent) = PARENTS[joint] else { return (unit(own.turn), at) };
        let parent_place = &self.0[parent];
        let back = parent_place.turn.transpose();
        (unit(back * own.turn), back * (at - parent_place.point(rest[parent])))
    }
}

fn unit(turn: Mat3) -> Quat {
    Quat::from_mat3(&turn).normalize()
}
