//! Eyes, head and ears turn to what goes on: a target that is looked at, a sound. Fixed steps with explicit state.

use super::{Channel, Moment, Pose, STEP_SECS, UnitTable};
use crate::math::ops;

/// What a dog notices at a moment.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Stimulus {
    /// Where it looks, from straight ahead of the body: degrees to the dog's left, and up.
    pub target: Option<[f32; 2]>,
    /// Where a sound comes from: degrees to the dog's left, 180 from behind.
    pub sound: Option<f32>,
    /// How hot it is, 0 to 1.
    pub heat: f32,
}

/// Beyond this the head helps the eyes, degrees (constructed).
const EYES_ALONE: f32 = 15.0;
/// How fast eyes and head get there: time constants, seconds. A saccade takes 50 to 100 ms.
const EYE_SECS: f64 = 0.03;
const HEAD_SECS: f64 = 0.22;
/// Ears turn within 100 ms, and lose interest in a sound that goes on, or is over, within seconds.
const EAR_SECS: f64 = 0.06;
const BORED_SECS: f64 = 2.5;
/// How much wider pupils get at something interesting, millimetres, and how fast (constructed: they take some tenths of a second).
const WIDENED: f32 = 1.5;
const PUPIL_SECS: f64 = 0.25;
/// How far the head goes by itself, degrees left or right, down, and up.
const HEAD_RANGE: [[f32; 2]; 2] = [[-70.0, 70.0], [-45.0, 45.0]];
const EYE_RANGE: [[f32; 2]; 2] = [[-25.0, 25.0], [-22.0, 18.0]];

/// Where eyes, head and ears are, and up to which step.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Attention {
    head: [f32; 2],
    eyes: [f32; 2],
    /// How far each ear's opening is turned outwards, degrees.
    ears: [f32; 2],
    /// How much both ears go forward, 0 to 1.
    forward: f32,
    /// How interesting the sound still is, 0 to 1, and where it came from when it began.
    interest: f32,
    heard: Option<f32>,
    heat: f32,
    /// How much wider the pupils are, millimetres.
    pupils: f32,
}

impl Attention {
    /// One step of [`STEP_SECS`].
    pub fn take(&mut self, stimulus: &Stimulus) {
        let target = stimulus.target.unwrap_or([0.0; 2]);
        for axis in 0..2 {
            let finite = if target[axis].is_finite() { target[axis] } else { 0.0 };
            let [least, most] = HEAD_RANGE[axis];
            // The head stops where the eyes reach the target by themselves.
            let beyond = finite - self.head[axis];
            let wanted = finite - beyond.clamp(-EYES_ALONE, EYES_ALONE);
            let wanted = if stimulus.target.is_some() { wanted.clamp(least, most) } else { 0.0 };
            approach(&mut self.head[axis], wanted, HEAD_SECS);
            let [least, most] = EYE_RANGE[axis];
            let wanted = if stimulus.target.is_some() { finite - self.head[axis] } else { 0.0 };
            approach(&mut self.eyes[axis], wanted.clamp(least, most), EYE_SECS);
        }
        self.listen(stimulus.sound.filter(|s| s.is_finite()));
        approach(&mut self.heat, stimulus.heat.clamp(0.0, 1.0), 1.0);
        approach(&mut self.pupils, WIDENED * self.interest, PUPIL_SECS);
    }

    fn listen(&mut self, sound: Option<f32>) {
        if let Some(from) = sound
            && self.heard.is_none_or(|before| (before - from).abs() > 20.0)
        {
            self.interest = 1.0;
            self.heard = Some(from);
        }
        approach(&mut self.interest, 0.0, BORED_SECS);
        if sound.is_none() && self.interest < 0.05 {
            self.heard = None;
        }
        // From -180 to 180, as seen from where the head looks.
        let from = self.heard.map(|from| {
            let turn = (from - self.head[0]) / 360.0;
            360.0 * (turn - (turn + 0.5).floor())
        });
        for (side, sign) in [(0, 1.0), (1, -1.0)] {
            // The opening looks a little outwards at rest; behind, both ears turn as far as they can.
            let wanted = from.map_or(0.0, |from| match from.abs() > 150.0 {
                true => 110.0,
                false => (sign * from - 20.0).clamp(-10.0, 110.0),
            });
            approach(&mut self.ears[side], self.interest * wanted, EAR_SECS);
        }
        let ahead = from.map_or(0.0, |from| 1.0 - (from.abs() / 60.0).min(1.0));
        approach(&mut self.forward, self.interest * ahead, EAR_SECS);
    }

    /// How hot the dog is, 0 to 1.
    pub(super) fn heat(&self) -> f32 {
        self.heat
    }

    /// Adds what eyes, head and ears do.
    pub(super) fn apply(&self, units: &UnitTable, moment: &mut Moment) {
        let direct: &mut Pose = &mut moment.direct;
        let mut add = |channel: Channel, values: [f32; 2]| {
            for (now, value) in direct.channel_mut(channel).iter_mut().zip(values) {
                *now += value;
            }
        };
        add(Channel::HeadTurn, [self.head[0]; 2]);
        add(Channel::HeadNod, [self.head[1]; 2]);
        add(Channel::GazeTurn, [self.eyes[0]; 2]);
        add(Channel::GazeLift, [self.eyes[1]; 2]);
        add(Channel::EarTurn, self.ears);
        add(Channel::Pupil, [self.pupils; 2]);
        if let Some(unit) = units.index_of("EAD101") {
            for now in moment.units.get_mut(unit) {
                *now = now.max(0.8 * self.forward);
            }
        }
    }
}

/// An exponential approach by one step.
fn approach(value: &mut f32, to: f32, seconds: f64) {
    *value += (1.0 - ops::exp(-STEP_SECS / seconds)) as f32 * (to - *value);
}
