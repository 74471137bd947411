//! Clips over time: which is playing since when, and how one goes over into the next.

use super::{Clip, Ease, Library, Moment};

/// A clip that plays.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cue {
    /// Its number in the library.
    pub clip: usize,
    /// When it starts, seconds.
    pub start: f64,
    /// When it is gone; infinite while nobody knows.
    pub end: f64,
    /// How long it takes to come in.
    pub fade_in: f64,
    /// How long it takes to go before its end.
    pub fade_out: f64,
    /// How many times as fast as it was made.
    pub speed: f64,
    /// How strong it gets, 0 to 1.
    pub weight: f32,
}

impl Cue {
    /// A clip from a time on, at its own speed, fading in so many seconds; for good if it repeats, else as long as it takes.
    pub fn new(library: &Library, clip: usize, start: f64, fade: f64) -> Self {
        let length =
            library.clips.get(clip).map_or(0.0, |clip| if clip.repeats { f64::INFINITY } else { clip.seconds });
        Self { clip, start, end: start + length, fade_in: fade, fade_out: 0.0, speed: 1.0, weight: 1.0 }
    }

    /// Its weight at a time: nothing before its start and after its end.
    pub fn weight_at(&self, time: f64) -> f32 {
        if time < self.start || time >= self.end {
            return 0.0;
        }
        let part = |of: f64, whole: f64| if of < whole { Ease::Smooth.at((of / whole) as f32) } else { 1.0 };
        self.weight * part(time - self.start, self.fade_in) * part(self.end - time, self.fade_out)
    }
}

/// The clips that play; those that were begun later lie over the others. Its state changes by its methods alone: what it
/// gives for a time does not depend on the times it was asked for before.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Player {
    cues: Vec<Cue>,
}

impl Player {
    /// Goes over to a clip from `time` on, within `fade` seconds; what plays now goes.
    pub fn play(&mut self, library: &Library, clip: usize, time: f64, fade: f64) {
        self.stop(time, fade);
        self.cues.push(Cue::new(library, clip, time, fade));
    }

    /// Lets a clip play over the others.
    pub fn layer(&mut self, cue: Cue) {
        self.cues.push(cue);
    }

    /// Lets everything go from `time` on, within `fade` seconds.
    pub fn stop(&mut self, time: f64, fade: f64) {
        self.cues.retain(|cue| cue.start <= time);
        for cue in self.cues.iter_mut().filter(|cue| cue.end > time + fade) {
            (cue.end, cue.fade_out) = (time + fade, fade);
        }
    }

    /// Forgets clips that ended before a time.
    pub fn forget_before(&mut self, time: f64) {
        self.cues.retain(|cue| cue.end > time);
    }

    /// What is playing, or will.
    pub fn cues(&self) -> &[Cue] {
        &self.cues
    }

    /// Lays what plays at a time over what is there. Allocates nothing.
    pub fn apply(&self, library: &Library, time: f64, moment: &mut Moment) {
        for cue in &self.cues {
            let weight = cue.weight_at(time);
            if let Some(clip) = library.clips.get(cue.clip).filter(|_| weight > 0.0) {
                Clip::apply(clip, (time - cue.start) * cue.speed, weight, moment);
            }
        }
    }
}
