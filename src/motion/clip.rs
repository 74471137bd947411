//! Clips: keys of units, channels and muscles over time, in layers. `rigs/clips/*.ron` as a type.

use super::ease::Ease;
use super::{Group, Moment, MotionError, MuscleTable, Side, Sides, Target, UnitTable, unit};
use serde::Deserialize;

/// A motion with a length.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// Name in files and on the command line.
    pub id: String,
    /// Its name in panels.
    pub label: String,
    /// Its length.
    pub seconds: f64,
    /// Whether it starts anew where it ends; else it stays at its end.
    pub repeats: bool,
    /// Laid over each other in this order.
    pub layers: Vec<Layer>,
    /// Where it is known from.
    pub source: String,
}

/// How a layer goes together with what is below it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default, Deserialize)]
pub enum Blend {
    /// The larger value shows.
    #[default]
    Max,
    /// Its values are added.
    Add,
    /// Its values take the place of the others.
    Replace,
}

/// Tracks that are blended alike.
#[derive(Clone, Debug, PartialEq)]
pub struct Layer {
    /// How they go together with what is below.
    pub blend: Blend,
    /// Units that come to rest under this layer, its own tracks excepted.
    pub mask: Vec<usize>,
    /// What moves.
    pub tracks: Vec<Track>,
}

/// What a track moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moved {
    /// A unit, by its number.
    Unit(usize),
    /// A channel in its unit, or a muscle.
    Target(Target),
}

/// One value over time.
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// What moves.
    pub of: Moved,
    /// On which side.
    pub side: Side,
    /// How it goes from key to key.
    pub ease: Ease,
    /// Seconds, rising, and values; at least one.
    pub keys: Vec<(f64, f32)>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    version: u32,
    id: String,
    label: String,
    seconds: f64,
    #[serde(default)]
    repeats: bool,
    layers: Vec<LayerRow>,
    source: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct LayerRow {
    #[serde(default)]
    blend: Blend,
    #[serde(default)]
    mask: Vec<Group>,
    tracks: Vec<TrackRow>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TrackRow {
    of: String,
    #[serde(default)]
    side: Side,
    #[serde(default)]
    ease: Ease,
    keys: Vec<(f64, f32)>,
}

/// The longest clip, seconds.
const MOST_SECONDS: f64 = 3600.0;

impl Clip {
    /// Reads the text of a file of `rigs/clips`; `file`: its name, for messages.
    ///
    /// # Errors
    /// Syntax with line and column; a name that nothing has, a side of what has but one, keys out of order or range.
    pub fn parse(file: &str, text: &str, units: &UnitTable, muscles: &MuscleTable) -> Result<Self, MotionError> {
        let read: File = ron::from_str(text).map_err(|e| MotionError::syntax(file, e))?;
        MotionError::check_version(file, read.version)?;
        if !(read.seconds > 0.0 && read.seconds <= MOST_SECONDS) {
            let problem = format!("seconds is {}, allowed above 0 to {MOST_SECONDS}", read.seconds);
            return Err(MotionError::row(file, &read.id, problem));
        }
        let layers = read.layers.into_iter().map(|layer| {
            let tracks = layer.tracks.into_iter().map(|row| row.read(file, read.seconds, units, muscles));
            let tracks: Vec<Track> = tracks.collect::<Result<_, MotionError>>()?;
            let is_masked = |number: &usize| {
                let has_track = tracks.iter().any(|track| track.of == Moved::Unit(*number));
                layer.mask.contains(&units.units[*number].group) && !has_track
            };
            let mask = (0..units.units.len()).filter(is_masked).collect();
            Ok(Layer { blend: layer.blend, mask, tracks })
        });
        let layers = layers.collect::<Result<_, MotionError>>()?;
        let File { id, label, seconds, repeats, source, .. } = read;
        Ok(Self { id, label, seconds, repeats, layers, source })
    }

    /// Its own time, 0 to its length, so many seconds after its start.
    pub fn local_time(&self, since: f64) -> f64 {
        if self.repeats { since.rem_euclid(self.seconds) } else { since.clamp(0.0, self.seconds) }
    }

    /// Lays it over what is there, so many seconds after its start, with a weight of 0 to 1. Allocates nothing.
    pub fn apply(&self, since: f64, weight: f32, moment: &mut Moment) {
        let time = self.local_time(since);
        for layer in &self.layers {
            for &unit in &layer.mask {
                *moment.units.get_mut(unit) = moment.units.get(unit).map(|v| v * (1.0 - weight));
            }
            for track in &layer.tracks {
                let value = track.at(time);
                let below = match track.of {
                    Moved::Unit(unit) => moment.units.get_mut(unit),
                    Moved::Target(target) => target.of(&mut moment.direct),
                };
                let of_side = match track.side {
                    Side::Both => &mut below[..],
                    Side::Left => &mut below[..1],
                    Side::Right => &mut below[1..],
                };
                for below in of_side {
                    *below = match layer.blend {
                        Blend::Max => below.max(weight * value),
                        Blend::Add => *below + weight * value,
                        Blend::Replace => *below + weight * (value - *below),
                    };
                }
            }
        }
    }

    /// What it moves, on nothing else.
    pub fn at(&self, since: f64) -> Moment {
        let mut moment = Moment::default();
        self.apply(since, 1.0, &mut moment);
        moment
    }
}

impl Track {
    /// Its value, seconds after the start of the clip.
    pub fn at(&self, time: f64) -> f32 {
        let next = self.keys.partition_point(|&(at, _)| at <= time);
        let Some(&(from, before)) = next.checked_sub(1).and_then(|last| self.keys.get(last)) else {
            return self.keys.first().map_or(0.0, |&(_, value)| value);
        };
        let Some(&(to, after)) = self.keys.get(next) else { return before };
        before + (after - before) * self.ease.at(((time - from) / (to - from)) as f32)
    }
}

impl TrackRow {
    fn read(self, file: &str, seconds: f64, units: &UnitTable, muscles: &MuscleTable) -> Result<Track, MotionError> {
        let wrong = |problem: String| MotionError::row(file, &self.of, problem);
        let (of, has_sides, range) = match Target::named(&self.of, muscles) {
            Some(target) => (Moved::Target(target), !target.is_median(), f32::NEG_INFINITY..=f32::INFINITY),
            None => {
                let number = unit::number(file, &self.of, &units.units)?;
                (Moved::Unit(number), units.units[number].sides == Sides::Each, 0.0..=1.0)
            }
        };
        if self.side != Side::Both && !has_sides {
            return Err(wrong("is not there for one side alone: leave out side".into()));
        }
        if self.keys.is_empty() {
            return Err(wrong("has no keys".into()));
        }
        let rises = self.keys.windows(2).all(|pair| pair[0].0 < pair[1].0);
        if !rises || self.keys.iter().any(|(at, _)| !(0.0..=seconds).contains(at)) {
            return Err(wrong(format!("needs keys at rising times from 0 to {seconds}")));
        }
        if let Some((at, value)) = self.keys.iter().find(|(_, value)| !value.is_finite() || !range.contains(value)) {
            return Err(wrong(format!("is {value} at {at}, a unit is allowed 0 to 1")));
        }
        Ok(Track { of, side: self.side, ease: self.ease, keys: self.keys })
    }
}
