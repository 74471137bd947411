//! The motion that a mouth is allowed as a space of five parameters, how a point follows them, and how far it can come
//! while they stay in a box.
//!
//! The jaw turns about the axis through both condyles, which is the x axis of the head's frame, and shifts. The tongue goes
//! with the jaw; it slides out, and its free part bends up about a pivot. A point follows each of these by a weight, 0 to 1:
//! bone and teeth wholly or not at all, lips and tongue by parts.

use crate::math::ops;
use crate::motion::{Channel, JointLimits, Pose};
use glam::{Vec3, vec3};

/// Number of parameters.
pub const AXES: usize = 5;

/// Where in the space of motion a head is, in the order of [`Params::CHANNELS`]: gape (radians), protrusion and slide of the
/// jaw (metres), tongue out (metres) and lift (radians). At rest all are zero.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Params(pub [f32; AXES]);

impl Params {
    /// The channels of a pose that the parameters come from.
    pub const CHANNELS: [Channel; AXES] =
        [Channel::JawGape, Channel::JawProtrusion, Channel::JawSlide, Channel::TongueOut, Channel::TongueLift];

    /// Of a pose; `unit`: a canonical millimetre of the head, metres. What is no number is at rest.
    pub fn of(pose: &Pose, unit: f32) -> Self {
        Self(std::array::from_fn(|axis| {
            let value = pose.median(Self::CHANNELS[axis]) * scale(axis, unit);
            if value.is_finite() { value } else { 0.0 }
        }))
    }

    /// Least and most of each by these limits, likewise.
    pub fn limits(limits: &JointLimits, unit: f32) -> [Params; 2] {
        let end = |axis: usize, most: bool| {
            let (least, greatest) = limits.of(Self::CHANNELS[axis]).range;
            scale(axis, unit) * if most { greatest } else { least }
        };
        [false, true].map(|most| Self(std::array::from_fn(|axis| end(axis, most))))
    }

    /// Each taken between two ends.
    #[must_use]
    pub fn clamped(&self, [least, most]: &[Params; 2]) -> Self {
        Self(std::array::from_fn(|axis| self.0[axis].max(least.0[axis]).min(most.0[axis])))
    }

    /// With another gape, radians.
    #[must_use]
    pub fn with_gape(mut self, gape: f32) -> Self {
        self.0[0] = gape;
        self
    }
}

/// From the unit of a channel's id to radians or metres.
fn scale(axis: usize, unit: f32) -> f32 {
    if matches!(axis, 0 | 4) { core::f32::consts::PI / 180.0 } else { unit }
}

/// How much of each motion a point takes part in, 0 to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Follow {
    /// Of the jaw's turn and shift.
    pub jaw: f32,
    /// Of the tongue's way out.
    pub out: f32,
    /// Of the tongue's lift.
    pub lift: f32,
}

impl Follow {
    /// What is rigid with the skull.
    pub const SKULL: Follow = Follow { jaw: 0.0, out: 0.0, lift: 0.0 };
    /// What is rigid with the mandible.
    pub const MANDIBLE: Follow = Follow { jaw: 1.0, out: 0.0, lift: 0.0 };
}

/// The joints of one head. Metres, head's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Joints {
    /// A point of the axis through both condyles.
    pub hinge: Vec3,
    /// Where the tongue's free part begins, at rest.
    pub pivot: Vec3,
}

/// The joints at one moment, ready to carry points.
#[derive(Clone, Copy, Debug)]
pub struct Moved {
    joints: Joints,
    params: Params,
    /// Sine and cosine of the gape, which most points follow wholly.
    turn: (f32, f32),
}

/// Turned about x, so that what is in front goes down for a positive angle.
fn turned(p: Vec3, (sin, cos): (f32, f32)) -> Vec3 {
    vec3(p.x, p.y * cos - p.z * sin, p.y * sin + p.z * cos)
}

impl Joints {
    /// The joints moved by these parameters.
    pub fn at(&self, params: Params) -> Moved {
        Moved { joints: *self, params, turn: ops::sin_cos(params.0[0]) }
    }

    /// What bounds how far a point that lies at `p` at rest comes from where it is at `middle`, while no parameter is farther
    /// from the middle's than `half`.
    pub fn travel(&self, follow: Follow, p: Vec3, middle: &Moved, half: &Params) -> Travel {
        let (mut own, mut at) = (0.0, p);
        if follow.out != 0.0 || follow.lift != 0.0 {
            // The way out is carried on by a turn, which is rigid; an arc is longer than its chord.
            let arm = arm(middle.out(follow, p) - self.pivot);
            own = follow.out * half.0[3] + arm * follow.lift * half.0[4];
            at = middle.in_mandible(follow, p);
        }
        Travel { own, arm: arm(at - self.hinge), jaw: follow.jaw }
    }
}

/// How far a point can travel in a box of parameters.
#[derive(Clone, Copy, Debug, Default)]
pub struct Travel {
    /// In the mandible's frame.
    own: f32,
    /// From the hinge.
    arm: f32,
    /// How much of the jaw's motion it takes part in.
    jaw: f32,
}

impl Travel {
    /// How much the distance of two points changes at most from what it is in the middle of the box.
    ///
    /// With p and q from the hinge, R a turn and s the shift, the distance is |R(a g) p + a s - R(b g) q - b s|, which is
    /// |R((a - b) g) p - q + (a - b) R(-b g) s|: what both take part in does not count, and either arm will do.
    pub fn apart(&self, other: &Travel, swing: &Swing) -> f32 {
        let turn = (self.arm.min(other.arm) + swing.most) * swing.gape;
        self.own + other.own + (self.jaw - other.jaw).abs() * (turn + swing.shift)
    }
}

/// What the jaw does in a box of parameters.
#[derive(Clone, Copy, Debug)]
pub struct Swing {
    /// How far it turns from the middle.
    gape: f32,
    /// How far it shifts from the middle.
    shift: f32,
    /// How far it is shifted at most.
    most: f32,
}

impl Swing {
    /// Of the box with that middle and those half widths.
    pub fn new(middle: &Params, half: &Params) -> Self {
        let shift = ops::hypot(half.0[1], half.0[2]);
        Self { gape: half.0[0], shift, most: ops::hypot(middle.0[1], middle.0[2]) + shift }
    }
}

/// Distance from an axis along x.
fn arm(p: Vec3) -> f32 {
    ops::sqrt(p.y * p.y + p.z * p.z)
}

impl Moved {
    /// The parameters.
    pub fn params(&self) -> Params {
        self.params
    }

    /// Sine and cosine of what follows the gape so far.
    fn turn(&self, follow: Follow) -> (f32, f32) {
        if follow.jaw == 1.0 { self.turn } else { ops::sin_cos(follow.jaw * self.params.0[0]) }
    }

    fn shift(&self) -> Vec3 {
        vec3(self.params.0[2], 0.0, self.params.0[1])
    }

    /// After the tongue's way out.
    fn out(&self, follow: Follow, p: Vec3) -> Vec3 {
        p + Vec3::Z * (follow.out * self.params.0[3])
    }

    /// A point of the tongue in the frame of the mandible at rest.
    fn in_mandible(&self, follow: Follow, p: Vec3) -> Vec3 {
        let p = self.out(follow, p);
        if follow.lift == 0.0 {
            return p;
        }
        let pivot = self.joints.pivot;
        pivot + turned(p - pivot, ops::sin_cos(-follow.lift * self.params.0[4]))
    }

    /// Where a point is that lies at `p` at rest.
    pub fn carry(&self, follow: Follow, p: Vec3) -> Vec3 {
        let p = if follow.out != 0.0 || follow.lift != 0.0 { self.in_mandible(follow, p) } else { p };
        if follow.jaw == 0.0 {
            return p;
        }
        let hinge = self.joints.hinge;
        hinge + turned(p - hinge, self.turn(follow)) + self.shift() * follow.jaw
    }

    /// Where a point that moves with the mandible lies at rest.
    pub fn back(&self, p: Vec3) -> Vec3 {
        let (hinge, (sin, cos)) = (self.joints.hinge, self.turn);
        hinge + turned(p - self.shift() - hinge, (-sin, cos))
    }

    /// A direction at rest of what follows the jaw by parts, as it is now.
    pub fn turn_with(&self, follow: Follow, d: Vec3) -> Vec3 {
        turned(d, self.turn(follow))
    }

    /// How fast a point of the mandible moves as the gape grows, metres a radian.
    pub fn opening(&self, p: Vec3) -> Vec3 {
        let arm = p - self.shift() - self.joints.hinge;
        vec3(0.0, -arm.z, arm.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::Rng;

    fn joints() -> Joints {
        Joints { hinge: vec3(0.0, 0.001, -0.002), pivot: vec3(0.0, -0.01, 0.07) }
    }

    #[test]
    fn a_jaw_opens_upwards() {
        let open = joints().at(Params([0.5, 0.0, 0.0, 0.0, 0.0]));
        let chin = open.carry(Follow::MANDIBLE, vec3(0.0, -0.02, 0.13));
        assert!(chin.y < -0.07 && chin.z < 0.12, "{chin}");
        assert_eq!(open.carry(Follow::SKULL, Vec3::ONE), Vec3::ONE);
        let tip = joints().at(Params([0.0, 0.0, 0.0, 0.0, 0.5]));
        assert!(tip.carry(Follow { lift: 1.0, ..Follow::MANDIBLE }, vec3(0.0, -0.01, 0.12)).y > 0.0);
    }

    #[test]
    fn a_point_does_not_come_back() {
        let mut rng = Rng::new(3);
        for _ in 0..1000 {
            let moved = joints().at(Params([rng.between(0.0, 1.1), 0.002, rng.between(-0.003, 0.003), 0.0, 0.0]));
            let p = Vec3::from([0; 3].map(|_| rng.between(-0.1, 0.1)));
            assert!(moved.back(moved.carry(Follow::MANDIBLE, p)).distance(p) < 1e-7);
            let h = 1e-3;
            let after = joints().at(moved.params().with_gape(moved.params().0[0] + h));
            let way = (after.carry(Follow::MANDIBLE, p) - moved.carry(Follow::MANDIBLE, p)) / h;
            assert!(way.distance(moved.opening(moved.carry(Follow::MANDIBLE, p))) < 3e-4, "{way}");
        }
    }

    /// Near boxes' corners, where the most is reached.
    #[test]
    fn two_points_come_nearer_than_their_bound() {
        let (mut rng, mut closest) = (Rng::new(5), 0.0_f32);
        for _ in 0..40_000 {
            let weight = |rng: &mut Rng| [0.0, 1.0, rng.unit_f32()][rng.below(3)];
            let point = |rng: &mut Rng| {
                let follow = Follow { jaw: weight(rng), out: weight(rng), lift: weight(rng) };
                (follow, Vec3::from([0; 3].map(|_| rng.between(-0.12, 0.15))))
            };
            let (a, b) = (point(&mut rng), point(&mut rng));
            let size = rng.unit_f32();
            let half = Params([0.6, 0.002, 0.003, 0.04, 1.0].map(|most| most * size * rng.unit_f32()));
            let middle = Params([0.6, 0.002, -0.003, 0.04, 0.2].map(|v| v * rng.unit_f32()));
            let at = Params(std::array::from_fn(|k| {
                middle.0[k] + half.0[k] * [-1.0, 1.0, rng.between(-1.0, 1.0)][rng.below(3)]
            }));
            let joints = joints();
            let (from, to) = (joints.at(middle), joints.at(at));
            let [of_a, of_b] = [a, b].map(|(follow, p)| joints.travel(follow, p, &from, &half));
            let bound = of_a.apart(&of_b, &Swing::new(&middle, &half));
            let apart = |moved: &Moved| moved.carry(a.0, a.1).distance(moved.carry(b.0, b.1));
            let change = (apart(&from) - apart(&to)).abs();
            assert!(change <= bound + 1e-6, "{change} over {bound}: {a:?} {b:?}");
            if bound > 1e-3 {
                closest = closest.max(change / bound);
            }
        }
        assert!(closest > 0.9, "a bound of which no more than {closest} is used");
    }
}
