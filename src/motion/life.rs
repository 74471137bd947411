//! Life without keys: blinks, breath, small looks and flicks of the ears, drawn by a seed; attention to what goes on, and
//! panting with heat.
//!
//! What chance draws is a function of seed and time alone: time is cut into slots of one event each, and a slot's event is
//! drawn from the slot's number. What follows something is taken in fixed steps.

use super::ease::envelope;
use super::{Activation, Attention, Channel, Ease, Library, Moment, STEP_SECS, Stimulus, steps_until};
use crate::math::ops;
use crate::math::rng::Rng;
use std::f32::consts::TAU;

/// How lively a dog is. The defaults are rates of a calm dog that is awake.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Temper {
    /// 3 to 15 a minute (popular range; 8 to 14 in a neutral face).
    pub blinks_per_min: f64,
    /// 15 to 30 a minute (general knowledge).
    pub breaths_per_min: f64,
    /// 1 to 2 a second awake (general knowledge).
    pub looks_per_s: f64,
    /// An ear turns every 2 to 6 s (general knowledge).
    pub flicks_per_min: f64,
}

impl Default for Temper {
    fn default() -> Self {
        Self { blinks_per_min: 11.0, breaths_per_min: 20.0, looks_per_s: 1.2, flicks_per_min: 15.0 }
    }
}

/// A dog that lives on its own: definition and state.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Life {
    /// What chance begins with.
    pub seed: u64,
    /// How lively it is.
    pub temper: Temper,
    attention: Attention,
    /// The next step of attention.
    step: u64,
}

/// What is drawn, so that two things never draw the same.
#[derive(Clone, Copy)]
enum Purpose {
    Blink = 1,
    Look = 2,
    Flick = 3,
}

impl Life {
    /// A dog at rest at time 0.
    pub fn new(seed: u64, temper: Temper) -> Self {
        Self { seed, temper, attention: Attention::default(), step: 0 }
    }

    /// Takes every step of attention up to a time, in seconds; `stimulus_at` tells what is noticed at the time of a step.
    pub fn advance(&mut self, time: f64, mut stimulus_at: impl FnMut(f64) -> Stimulus) {
        while self.step <= steps_until(time) {
            self.attention.take(&stimulus_at(self.step as f64 * STEP_SECS));
            self.step += 1;
        }
    }

    /// What it does at a time, in seconds, on its own and in answer to what it was told last. Allocates nothing.
    pub fn at(&self, library: &Library, time: f64) -> Moment {
        let mut moment = Moment::default();
        let heat = self.attention.heat();
        self.blink(library, time, &mut moment.units);
        self.flick(library, time, &mut moment.units);
        self.look(time, &mut moment);
        self.breathe(library, time, 1.0 - heat, &mut moment);
        for (id, part) in [("AD126", 1.0), ("AU25", 1.0), ("AU12", 0.4), ("AD19", 0.6)] {
            raise(library, &mut moment.units, id, [part * heat; 2]);
        }
        self.attention.apply(&library.units, &mut moment);
        moment
    }

    /// Chance for the slot of a purpose.
    fn chance(&self, purpose: Purpose, slot: i64) -> Rng {
        let mut rng =
            Rng::new(self.seed ^ (slot as u64).wrapping_mul(0x9e6c_63d0_876a_9a35) ^ ((purpose as u64) << 56));
        // Neighbouring seeds are mixed before anything is drawn.
        Rng::new(rng.next_u64())
    }

    fn blink(&self, library: &Library, time: f64, units: &mut Activation) {
        for (slot, start, seconds) in slots(time, 60.0 / self.temper.blinks_per_min) {
            let mut chance = self.chance(Purpose::Blink, slot);
            let at = start + chance.unit_f64() * (seconds - 0.4).max(0.0);
            // Close in 80 to 120 ms, open in 120 to 200; one in six stays half open, one in six is doubled.
            let (close, open) = (f64::from(chance.between(0.08, 0.12)), f64::from(chance.between(0.12, 0.2)));
            let depth = if chance.unit_f32() < 1.0 / 6.0 { 0.55 } else { 1.0 };
            let mut value = envelope(time - at, close, 0.02, open);
            if chance.unit_f32() < 1.0 / 6.0 {
                value = value.max(envelope(time - at - 0.45, close, 0.02, open));
            }
            raise(library, units, "AU145", [depth * value; 2]);
        }
    }

    fn flick(&self, library: &Library, time: f64, units: &mut Activation) {
        for (slot, start, seconds) in slots(time, 60.0 / self.temper.flicks_per_min) {
            let mut chance = self.chance(Purpose::Flick, slot);
            let at = start + chance.unit_f64() * 0.5 * seconds;
            let size = chance.between(0.1, 0.3);
            let hold = f64::from(chance.between(0.2, 1.2));
            let value = size * envelope(time - at, 0.12, hold, 0.4);
            let is_left = chance.unit_f32() < 0.5;
            raise(library, units, "EAD104", if is_left { [value, 0.0] } else { [0.0, value] });
        }
    }

    /// The eyes rest at one place after another, and jump from each to the next.
    fn look(&self, time: f64, moment: &mut Moment) {
        let seconds = 1.0 / self.temper.looks_per_s.clamp(0.01, 100.0);
        let slot = (time / seconds).floor();
        let place = |slot: i64| {
            let mut chance = self.chance(Purpose::Look, slot);
            // Small where something is looked at, or a dog would look past it.
            [2.5 * chance.normal() as f32, 1.2 * chance.normal() as f32]
        };
        let (from, to) = (place(slot as i64 - 1), place(slot as i64));
        // A saccade takes 50 to 100 ms.
        let part = Ease::Smooth.at(((time - slot * seconds) / 0.07).clamp(0.0, 1.0) as f32);
        for (axis, channel) in [Channel::GazeTurn, Channel::GazeLift].into_iter().enumerate() {
            let value = from[axis] + (to[axis] - from[axis]) * part;
            for now in moment.direct.channel_mut(channel) {
                *now += value;
            }
        }
    }

    /// The nostrils widen a little when breath is drawn, and the head rises by a hair.
    fn breathe(&self, library: &Library, time: f64, through_the_nose: f32, moment: &mut Moment) {
        let turn = time * self.temper.breaths_per_min / 60.0;
        let drawn = 0.5 - 0.5 * ops::cos(TAU * (turn - turn.floor()) as f32);
        if let Some(muscle) = library.muscles.index_of("dilator_naris") {
            for now in moment.direct.muscle_mut(muscle) {
                *now += 0.2 * through_the_nose * drawn;
            }
        }
        moment.direct.channel_mut(Channel::HeadNod)[0] += 0.5 * drawn;
    }
}

/// The slots whose events may show at a time: number, start and length, in seconds.
fn slots(time: f64, seconds: f64) -> [(i64, f64, f64); 2] {
    let seconds = seconds.clamp(0.5, 1e6);
    let now = (time / seconds).floor();
    [now - 1.0, now].map(|slot| (slot as i64, slot * seconds, seconds))
}

/// Raises a unit to at least these values.
fn raise(library: &Library, units: &mut Activation, id: &str, values: [f32; 2]) {
    if let Some(unit) = library.units.index_of(id) {
        for (now, value) in units.get_mut(unit).iter_mut().zip(values) {
            *now = now.max(value);
        }
    }
}
