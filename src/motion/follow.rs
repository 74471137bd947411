//! What hangs follows late, and downwards: the leather of the ears and the flews lag behind the head as damped springs, and
//! hang where gravity draws them.

use super::{Channel, Pose, Spring};
use crate::anatomy::ParamTable;
use crate::math::ops;

/// How a head is built, as far as what hangs on it is concerned.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Build {
    /// -1 where the ears stand, 1 where they hang.
    pub ear_hang: f32,
    /// 0 for stiff ears, 1 for long leather that swings.
    pub ear_slack: f32,
    /// 0 for tight lips, 1 for long flews.
    pub flew_slack: f32,
}

impl Default for Build {
    fn default() -> Self {
        Self { ear_hang: 1.0, ear_slack: 0.7, flew_slack: 0.3 }
    }
}

impl Build {
    /// That of a breed; `values`: SI, one for each row of the table. A measure that the table lacks counts as 0.
    pub fn of(table: &ParamTable, values: &[f32]) -> Self {
        let value = |id: &str| table.index_of(id).and_then(|row| values.get(row)).copied().unwrap_or(0.0);
        // The tip looks up by the angle at which the leather leaves the skull, less that of its fold.
        let ear_hang = -ops::sin(value("ear_lift_deg") - value("ear_fold_deg"));
        let length = value("ear_length_mm") / value("cranial_length_mm").max(0.01);
        Self {
            ear_hang,
            ear_slack: (0.5 + 0.5 * ear_hang) * (0.4 + 0.6 * length).min(1.0),
            // 20 mm of flews swing as far as flews do.
            flew_slack: (0.1 + value("flews_mm") / 0.02).clamp(0.0, 1.0),
        }
    }
}

/// How often a second an ear would swing, stiff and slack, and how much it is damped: leather lags by 80 to 150 ms
/// (constructed), cartilage by a fifth of that.
const EAR_HZ: [f32; 2] = [7.0, 2.2];
const EAR_DAMPING: [f32; 2] = [0.4, 0.6];
/// The same for flews, tight and long.
const FLEW_HZ: [f32; 2] = [8.0, 3.0];
const FLEW_DAMPING: f32 = 0.45;
/// How far a flew swings for a degree that the head is ahead of it, millimetres.
const FLEW_MM_PER_DEG: f32 = 0.5;
/// How much of a nod or a tilt gravity takes back from the slackest part that hangs.
const GRAVITY: f32 = 0.7;
/// No part swings further, degrees and millimetres.
const MOST_DEG: f32 = 35.0;
const MOST_MM: f32 = 10.0;

/// The springs, and up to which step they have been taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Follow {
    build: Build,
    /// The next step; 0 before the first, at which everything is where it is led.
    step: u64,
    /// Backwards and outwards, left and right.
    ears: [[Spring; 2]; 2],
    flew: Spring,
    /// What the springs follow, at the last step.
    led: Led,
}

/// Where the base of what hangs is, in the direction in which its channel counts.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
struct Led {
    ears: [[f32; 2]; 2],
    flew: f32,
    /// The part of it that a plumb line would not follow.
    off_plumb: [[f32; 2]; 2],
    flew_off_plumb: f32,
}

impl Follow {
    /// At rest at time 0.
    pub fn new(build: Build) -> Self {
        Self { build, step: 0, ears: Default::default(), flew: Spring::default(), led: Led::default() }
    }

    /// How it is built, to be changed while it goes on.
    pub fn build_mut(&mut self) -> &mut Build {
        &mut self.build
    }

    /// Takes a step of [`STEP_SECS`](super::STEP_SECS), with the pose at its time.
    pub fn take(&mut self, pose: &Pose) {
        let Build { ear_hang, ear_slack, flew_slack } = self.build;
        let mix = |[stiff, slack]: [f32; 2], part: f32| stiff + (slack - stiff) * part.clamp(0.0, 1.0);
        self.led = led(pose, ear_hang);
        let rest = |led: f32, off_plumb: f32, slack: f32| led - GRAVITY * slack.clamp(0.0, 1.0) * off_plumb;
        let led = self.led.ears.into_iter().flatten().zip(self.led.off_plumb.into_iter().flatten());
        let springs = self.ears.iter_mut().flatten().zip(led.map(|(led, off)| rest(led, off, ear_slack)));
        let flew = rest(self.led.flew, self.led.flew_off_plumb, flew_slack);
        if self.step == 0 {
            springs.for_each(|(spring, to)| *spring = Spring { at: to, speed: 0.0 });
            self.flew = Spring { at: flew, speed: 0.0 };
        } else {
            let (hz, damping) = (mix(EAR_HZ, ear_slack), mix(EAR_DAMPING, ear_slack));
            springs.for_each(|(spring, to)| spring.step(to, hz, damping));
            self.flew.step(flew, mix(FLEW_HZ, flew_slack), FLEW_DAMPING);
        }
        self.step += 1;
    }

    /// The step that is taken next, from 0 on.
    pub fn next_step(&self) -> u64 {
        self.step
    }

    /// Adds to a pose by how much what hangs lags.
    pub fn apply(&self, pose: &mut Pose) {
        let part = 0.15 + 0.85 * self.build.ear_slack.clamp(0.0, 1.0);
        for (way, channel) in [Channel::EarBend, Channel::EarSway].into_iter().enumerate() {
            for side in 0..2 {
                let lag = self.ears[way][side].at - self.led.ears[way][side];
                pose.channel_mut(channel)[side] += (part * lag).clamp(-MOST_DEG, MOST_DEG);
            }
        }
        let lag = FLEW_MM_PER_DEG * self.build.flew_slack.clamp(0.0, 1.0) * (self.flew.at - self.led.flew);
        for flew in pose.channel_mut(Channel::FlewSway) {
            *flew += lag.clamp(-MOST_MM, MOST_MM);
        }
    }
}

/// A head that nods up carries hanging tips forward and standing ones back; one that tilts to its left carries hanging tips
/// to its right. What turns about the vertical carries both alike.
fn led(pose: &Pose, hang: f32) -> Led {
    let [turn, nod, tilt, forward] =
        [Channel::HeadTurn, Channel::HeadNod, Channel::HeadTilt, Channel::HeadForward].map(|c| pose.median(c));
    let [back, out] = [Channel::EarBack, Channel::EarOut].map(|c| pose.channel(c));
    // To the dog's left, degrees; a turn swings tips less than a tilt, being nearer to its axis.
    let aside = 0.4 * turn - hang * tilt;
    // A millimetre forward counts as much as half a degree.
    let bend = |side: usize| 0.5 * back[side] - hang * nod - 0.5 * forward;
    let sway = |side: usize, sign: f32| 0.5 * out[side] + sign * aside;
    // What stands does not hang down wherever the head goes: cartilage holds it.
    let hang = hang.max(0.0);
    Led {
        ears: [[bend(0), bend(1)], [sway(0, 1.0), sway(1, -1.0)]],
        flew: turn - 0.5 * tilt,
        off_plumb: [[-hang * nod; 2], [-hang * tilt, hang * tilt]],
        flew_off_plumb: -0.5 * tilt,
    }
}
