//! From `--unit`, `--facs`, `--expression`, `--clip`, `--life` and `--time` to what a head does.

use super::args::{Lids, Motion};
use super::rigs::Rigs;
use super::{Failure, output, values};
use crate::anatomy::{Breed, nearest};
use crate::motion::{Act, Build, Channel, Cue, Library, Life, Mixed, Overruled, Pose, Side, Stimulus, Temper};

/// What the words ask for, for heads of any build.
pub(super) struct Director {
    pub library: Library,
    act: Act,
    time: Option<f64>,
    lids: [f32; 2],
}

impl Director {
    /// Reads the words; `lids`: how far the lids are closed besides.
    pub fn new(words: &Motion, lids: Lids) -> Result<Self, Failure> {
        let library = Library::embedded().map_err(Failure::work)?;
        let mut act = Act::new(Build::default());
        if let Some(text) = &words.facs {
            act.units = library
                .units
                .parse_notation(text)
                .map_err(|error| Failure::Use(format!("--facs {text}: {error}; 'londra list units' names them all")))?;
        }
        for setting in &words.units {
            let found = library.units.find(&setting.id);
            let (unit, side) =
                found.map_err(|error| Failure::Use(format!("{error}; 'londra list units' names them all")))?;
            act.units.set(unit, side, setting.value as f32);
        }
        for (unit, spec) in library.units.units.iter().enumerate().filter(|(_, spec)| spec.drives.is_empty()) {
            if act.units.most(unit) > 0.0 {
                let (id, name, clip) = (&spec.id, &spec.name, &spec.clip);
                return Err(Failure::Use(format!("{id} ({name}) takes its time: play the clip with --clip {clip}")));
            }
        }
        for mixture in &words.expressions {
            let names = library.expressions.iter().map(|e| e.id.as_str());
            let expression = numbered("expression", &mixture.name, names)?;
            act.expressions.push(Mixed { expression, weight: mixture.weight, start: words.time.map(|_| 0.0) });
        }
        for name in &words.clips {
            let clip = numbered("clip", name, library.clips.iter().map(|c| c.id.as_str()))?;
            let mut cue = Cue::new(&library, clip, 0.0, 0.0);
            // A clip that is over stays as it ended.
            cue.end = f64::INFINITY;
            act.player.layer(cue);
        }
        act.life = words.life.map(|seed| Life::new(seed, Temper::default()));
        Ok(Self { library, act, time: words.time, lids: lids.0 })
    }

    /// Expressions take their course from 0 on instead of standing still.
    pub fn let_time_pass(&mut self) {
        for mixed in &mut self.act.expressions {
            mixed.start = Some(0.0);
        }
    }

    /// How long the longest clip or expression takes, seconds; none where nothing takes time.
    pub fn seconds(&self) -> Option<f64> {
        let clips = self.act.player.cues().iter().map(|cue| self.library.clips[cue.clip].seconds);
        let expressions = self.act.expressions.iter().map(|m| self.library.expressions[m.expression].seconds());
        clips.chain(expressions).reduce(f64::max).filter(|&seconds| seconds > 0.0)
    }

    /// The pose that was asked for.
    pub fn pose(&self, rigs: &Rigs, breed: &Breed) -> Pose {
        self.film(rigs, breed).at(self.time.unwrap_or(0.0))
    }

    /// Says on stderr which units do not come as they were asked for, and why.
    pub fn tell_overruled(&self) {
        let asked = self.act.asked(&self.library, self.time.unwrap_or(0.0));
        self.library.units.resolve(&asked.units, |told| {
            if told.to < told.from {
                output::message(&format!("londra: {}", self.in_words(&told)));
            }
        });
    }

    /// A head that goes through it all.
    pub fn film(&self, rigs: &Rigs, breed: &Breed) -> Film<'_> {
        let mut act = self.act.clone();
        act.build = Build::of(&rigs.table, &breed.values);
        Film { director: self, act }
    }

    fn in_words(&self, told: &Overruled) -> String {
        let units = &self.library.units;
        let name = |unit: usize| units.units[unit].label.as_str();
        let side = match told.side {
            Side::Both => "",
            Side::Left => " on the left",
            Side::Right => " on the right",
        };
        let (unit, by, why) = (name(told.unit), name(told.by), &units.rules[told.rule].why);
        let rounded = |value: f32| (value * 100.0).round() / 100.0;
        format!("{unit}{side} goes from {} to {} because of {by}: {why}", rounded(told.from), rounded(told.to))
    }
}

/// A head over time.
pub(super) struct Film<'a> {
    director: &'a Director,
    act: Act,
}

impl Film<'_> {
    /// The pose at a time, in seconds.
    pub fn at(&mut self, time: f64) -> Pose {
        let library = &self.director.library;
        let mut pose = self.act.pose(library, time, |_| Stimulus::default(), |_| ());
        for (now, closed) in pose.channel_mut(Channel::LidClosed).iter_mut().zip(self.director.lids) {
            *now = now.max(closed);
        }
        pose
    }
}

fn numbered<'a>(what: &str, word: &str, names: impl Iterator<Item = &'a str> + Clone) -> Result<usize, Failure> {
    names.clone().position(|name| name == word).ok_or_else(|| {
        let near = values::did_you_mean(&nearest(word, names.map(|name| (name, name))));
        Failure::Use(format!("unknown {what} '{word}'{near}; 'londra list {what}s' names them all"))
    })
}
