//! What the head in the window does: units, expressions, a clip, life of its own, and the time they have come to. Without a
//! window, so that a test can drive it.

use crate::anatomy::{Breed, ParamTable};
use crate::motion::{
    Act, Activation, Build, Channel, Clip, Cue, Group, Library, Life, Mixed, MotionError, Overruled, Pose, Stimulus,
    Temper,
};

/// The motion of one head.
pub struct Motion {
    /// Every table.
    pub library: Library,
    act: Act,
    /// The panel is shown.
    pub is_open: bool,
    /// Sliders move one side alone.
    pub one_sided: bool,
    /// Time passes.
    pub is_playing: bool,
    /// What is over starts anew.
    pub loops: bool,
    /// Times as fast as a clock, 0.05 to 4.
    pub speed: f64,
    /// Eyes and head follow the pointer.
    pub follows_pointer: bool,
    /// What is noticed now.
    pub stimulus: Stimulus,
    /// Seconds since the motion began.
    time: f64,
    /// The clip that plays.
    clip: Option<usize>,
    /// Expressions come and go as their recipes have it; else they stand still where they show themselves best.
    takes_course: bool,
    /// The unit that is shown alone, and the units and expressions before.
    before_solo: Option<(usize, Activation, Vec<Mixed>)>,
    /// What the text field has, and what is wrong with it.
    pub typed: String,
    /// The field has the keyboard.
    pub is_typing: bool,
    /// What is wrong with what was typed.
    pub mistake: Option<String>,
    overruled: Vec<Overruled>,
    /// Units as the last pose has them, life apart.
    shown: Activation,
}

/// What somebody has asked of the motion: what undo brings back.
#[derive(Clone, Debug, PartialEq)]
pub struct Asked {
    units: Activation,
    direct: Pose,
    expressions: Vec<Mixed>,
    clip: Option<usize>,
    takes_course: bool,
    is_alive: bool,
    follows_pointer: bool,
    heat: f32,
    /// Seconds since the motion began.
    pub(super) time: f64,
}

/// A frame of the timeline's steps, seconds.
const FRAME_SECS: f64 = 1.0 / 30.0;
/// The longest time between two pictures that a clip makes up for: where a processor draws, a picture may take so long.
const LONGEST_SECS: f64 = 0.3;
/// The seed of life in a window.
const SEED: u64 = 1;

impl Motion {
    /// A head at rest.
    ///
    /// # Errors
    /// Never: a test reads every table.
    pub fn new() -> Result<Self, MotionError> {
        Ok(Self {
            library: Library::embedded()?,
            act: Act::new(Build::default()),
            is_open: false,
            one_sided: false,
            is_playing: false,
            loops: true,
            speed: 1.0,
            follows_pointer: false,
            stimulus: Stimulus::default(),
            time: 0.0,
            clip: None,
            takes_course: false,
            before_solo: None,
            typed: String::new(),
            is_typing: false,
            mistake: None,
            overruled: Vec::new(),
            shown: Activation::default(),
        })
    }

    /// What is asked for, unit by unit.
    pub fn units(&self) -> &Activation {
        &self.act.units
    }

    /// Asks for a unit, left and right.
    pub fn set_unit(&mut self, unit: usize, sides: [f32; 2]) {
        *self.act.units.get_mut(unit) = sides;
        self.before_solo = None;
        self.write_notation();
    }

    /// What is asked for now.
    pub fn asked(&self) -> Asked {
        Asked {
            units: self.act.units,
            direct: self.act.direct,
            expressions: self.act.expressions.clone(),
            clip: self.clip,
            takes_course: self.takes_course,
            is_alive: self.is_alive(),
            follows_pointer: self.follows_pointer,
            heat: self.stimulus.heat,
            time: self.time,
        }
    }

    /// Asks for what was asked for before. What plays goes on playing.
    pub fn restore(&mut self, asked: &Asked) {
        let goes_on = self.is_playing && (self.clip, self.takes_course) == (asked.clip, asked.takes_course);
        let (time, was_playing) = (if goes_on { self.time } else { asked.time }, self.is_playing);
        (self.act.units, self.act.direct) = (asked.units, asked.direct);
        self.act.expressions.clone_from(&asked.expressions);
        if self.clip != asked.clip {
            self.set_clip(asked.clip);
        }
        self.takes_course = asked.takes_course;
        if self.is_alive() != asked.is_alive {
            self.set_alive(asked.is_alive);
        }
        self.follows_pointer = asked.follows_pointer;
        self.stimulus.heat = asked.heat;
        self.time = time;
        self.is_playing = was_playing && (self.clip.is_some() || self.takes_course || asked.is_alive);
        self.before_solo = None;
        self.write_notation();
    }

    /// What is added to the pupils' width, millimetres.
    pub fn pupils(&self) -> f32 {
        self.act.direct.median(Channel::Pupil)
    }

    /// Makes pupils wider or narrower.
    pub fn set_pupils(&mut self, millimetres: f32) {
        *self.act.direct.channel_mut(Channel::Pupil) = [millimetres; 2];
    }

    /// How much the eyes turn towards each other, degrees each.
    pub fn vergence(&self) -> f32 {
        self.act.direct.channel(Channel::GazeTurn)[1]
    }

    /// Turns the eyes towards each other.
    pub fn set_vergence(&mut self, degrees: f32) {
        *self.act.direct.channel_mut(Channel::GazeTurn) = [-degrees, degrees];
    }

    /// Shows a unit alone at 1; once more brings back what was there before.
    pub fn solo(&mut self, unit: usize) {
        match self.before_solo.take() {
            Some((shown, units, expressions)) if shown == unit => {
                (self.act.units, self.act.expressions) = (units, expressions);
            }
            earlier => {
                let now = (self.act.units, std::mem::take(&mut self.act.expressions));
                let (units, expressions) = earlier.map_or(now, |(_, units, expressions)| (units, expressions));
                self.act.units = Activation::default();
                *self.act.units.get_mut(unit) = [1.0; 2];
                self.before_solo = Some((unit, units, expressions));
            }
        }
        self.write_notation();
    }

    /// Everything at rest, and no time.
    pub fn reset(&mut self) {
        (self.act.units, self.act.direct) = Default::default();
        self.act.expressions.clear();
        self.before_solo = None;
        self.takes_course = false;
        self.set_clip(None);
        self.set_alive(false);
        (self.is_playing, self.follows_pointer, self.stimulus) = (false, false, Stimulus::default());
        self.write_notation();
    }

    /// Takes what was typed; a mistake leaves everything as it is.
    pub fn read_notation(&mut self) {
        match self.library.units.parse_notation(&self.typed) {
            Ok(units) => {
                (self.act.units, self.before_solo, self.mistake) = (units, None, None);
            }
            Err(error) => self.mistake = Some(error.to_string()),
        }
    }

    fn write_notation(&mut self) {
        self.typed = self.library.units.notation(&self.act.units);
        self.mistake = None;
    }

    /// How much of an expression is mixed in, 0 to 1.
    pub fn weight(&self, expression: usize) -> f32 {
        let mixed = self.act.expressions.iter().find(|mixed| mixed.expression == expression);
        mixed.map_or(0.0, |mixed| mixed.weight)
    }

    /// Mixes in an expression; 0 takes it out.
    pub fn set_weight(&mut self, expression: usize, weight: f32) {
        self.before_solo = None;
        self.act.expressions.retain(|mixed| mixed.expression != expression);
        if weight > 0.0 {
            let start = self.takes_course.then_some(0.0);
            self.act.expressions.push(Mixed { expression, weight: weight.min(1.0), start });
        }
        // The order in which they were touched is none of the sum's business.
        self.act.expressions.sort_by_key(|mixed| mixed.expression);
    }

    /// Shows an expression alone, from its start where it takes its course, or nothing where it is shown alone already.
    pub fn show_expression(&mut self, expression: usize) {
        let is_alone = self.act.expressions.len() == 1 && self.weight(expression) == 1.0;
        self.act.expressions.clear();
        self.set_weight(expression, if is_alone { 0.0 } else { 1.0 });
        if self.takes_course && !is_alone {
            self.begin();
        }
    }

    /// Whether expressions come and go as their recipes have it.
    pub fn takes_course(&self) -> bool {
        self.takes_course
    }

    /// Lets expressions take their course, from its start, or stand still where they show themselves best.
    pub fn set_course(&mut self, takes_course: bool) {
        self.takes_course = takes_course;
        self.act.expressions.iter_mut().for_each(|mixed| mixed.start = takes_course.then_some(0.0));
        if takes_course {
            self.begin();
        }
    }

    /// Time passes or stands still. Where nothing but expressions is there that could go on, they do.
    pub fn play_or_pause(&mut self) {
        if !self.is_playing && self.clip.is_none() && !self.is_alive() && !self.act.expressions.is_empty() {
            if !self.takes_course {
                return self.set_course(true);
            }
            if self.length().is_some_and(|length| self.time >= length) {
                return self.begin();
            }
        }
        self.is_playing = !self.is_playing;
    }

    /// From the start.
    fn begin(&mut self) {
        (self.time, self.is_playing) = (0.0, true);
        self.act.restart();
    }

    /// The clip that plays.
    pub fn clip(&self) -> Option<usize> {
        self.clip
    }

    /// Plays another clip from its start, or none.
    pub fn set_clip(&mut self, clip: Option<usize>) {
        self.clip = clip;
        self.act.player = Default::default();
        if let Some(clip) = clip {
            let mut cue = Cue::new(&self.library, clip, 0.0, 0.0);
            cue.end = f64::INFINITY;
            self.act.player.layer(cue);
            self.is_playing = true;
        }
        self.time = 0.0;
        self.act.restart();
    }

    /// Whether the head blinks, breathes and looks about by itself.
    pub fn is_alive(&self) -> bool {
        self.act.life.is_some()
    }

    /// Lets it live, or not.
    pub fn set_alive(&mut self, alive: bool) {
        self.act.life = alive.then(|| Life::new(SEED, Temper::default()));
        self.is_playing |= alive;
        self.act.restart();
    }

    /// Seconds from the start, and, where a clip plays or expressions take their course, how long the longest of them takes.
    pub fn timeline(&self) -> (f64, Option<f64>) {
        match (self.length(), self.endless()) {
            (None, _) => (self.time, None),
            (length, Some(clip)) => (clip.local_time(self.time), length),
            (Some(length), None) => (self.time.min(length), Some(length)),
        }
    }

    fn length(&self) -> Option<f64> {
        let clip = self.clip.and_then(|clip| self.library.clips.get(clip)).map(|clip| clip.seconds);
        let courses = self.act.expressions.iter().filter(|mixed| mixed.start.is_some());
        let courses = courses.filter_map(|mixed| self.library.expressions.get(mixed.expression)).map(|e| e.seconds());
        clip.into_iter().chain(courses).reduce(f64::max).filter(|&length| length > 0.0)
    }

    /// A clip that repeats by itself, with nothing beside it that ends.
    fn endless(&self) -> Option<&Clip> {
        let is_alone = self.act.expressions.iter().all(|mixed| mixed.start.is_none());
        self.clip.and_then(|clip| self.library.clips.get(clip)).filter(|clip| clip.repeats && is_alone)
    }

    /// Goes to a time.
    pub fn scrub(&mut self, time: f64) {
        self.is_playing = false;
        self.time = time.max(0.0);
    }

    /// Goes by so many frames.
    pub fn step(&mut self, frames: i32) {
        let (time, length) = self.timeline();
        self.scrub((time + f64::from(frames) * FRAME_SECS).clamp(0.0, length.unwrap_or(f64::MAX)));
    }

    /// Time passes, seconds of a clock; a window that stood still does not make up for more than `LONGEST_SECS`.
    pub fn pass(&mut self, seconds: f64) {
        if !self.is_playing {
            return;
        }
        self.time += seconds.clamp(0.0, LONGEST_SECS) * self.speed;
        let Some(length) = self.length().filter(|_| self.endless().is_none()) else { return };
        if self.time > length {
            match self.loops {
                true => self.time = self.time.rem_euclid(length),
                false => (self.time, self.is_playing) = (length, self.is_alive()),
            }
        }
    }

    /// The pose of this moment.
    pub fn pose(&mut self, table: &ParamTable, breed: &Breed) -> Pose {
        self.act.build = Build::of(table, &breed.values);
        self.overruled.clear();
        if self.is_open {
            let asked = self.act.asked(&self.library, self.time);
            self.shown = self.library.units.resolve(&asked.units, |_| ());
        }
        let (stimulus, overruled) = (self.stimulus, &mut self.overruled);
        self.act.pose(&self.library, self.time, |_| stimulus, |told| overruled.push(told))
    }

    /// Units as the last pose has them while the panel is open: with expressions and clips, after the rules.
    pub fn shown(&self) -> &Activation {
        &self.shown
    }

    /// How many units of a group the last pose has.
    pub fn n_shown(&self, group: Group) -> usize {
        let units = self.library.units.units.iter().enumerate();
        units.filter(|(number, unit)| unit.group == group && self.shown.most(*number) > 0.005).count()
    }

    /// What did not come as it was asked for in the last pose.
    pub fn overruled(&self) -> &[Overruled] {
        &self.overruled
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn motion() -> Motion {
        Motion::new().unwrap()
    }

    #[test]
    fn solo_does_not_bring_back_what_was_there() {
        let mut motion = motion();
        motion.set_unit(3, [0.5, 0.2]);
        motion.set_weight(4, 0.5);
        let before = *motion.units();
        motion.solo(1);
        assert_eq!((motion.units().get(1), motion.units().get(3)), ([1.0; 2], [0.0; 2]));
        motion.solo(2);
        assert_eq!((motion.units().get(1), motion.units().get(2)), ([0.0; 2], [1.0; 2]));
        assert_eq!(motion.weight(4), 0.0, "alone is without expressions");
        motion.solo(2);
        assert_eq!((*motion.units(), motion.weight(4)), (before, 0.5));
    }

    #[test]
    fn a_mistake_in_the_notation_moves_the_head_or_is_not_told() {
        let mut motion = motion();
        motion.typed = "101+12B".into();
        motion.read_notation();
        assert!(motion.mistake.is_none() && !motion.units().is_rest());
        let before = *motion.units();
        motion.typed = "101+".into();
        motion.read_notation();
        assert!(motion.mistake.is_some());
        assert_eq!(*motion.units(), before);
        motion.set_unit(0, [0.0; 2]);
        assert_eq!((motion.typed.as_str(), &motion.mistake), ("12B", &None));
    }

    #[test]
    fn an_expression_stands_still_though_time_passes() {
        let mut motion = motion();
        let number = |motion: &Motion, id: &str| motion.library.expressions.iter().position(|e| e.id == id).unwrap();
        let [anger, fear] = ["anger", "fear"].map(|id| number(&motion, id));
        let (table, still) = (ParamTable::embedded().unwrap(), motion.library.expressions[anger].still_s);
        let breed = Breed::defaults(&table);
        motion.show_expression(anger);
        assert_eq!((motion.timeline().1, motion.is_playing), (None, false), "it stands still until somebody plays it");
        let best = motion.pose(&table, &breed);
        motion.play_or_pause();
        let seconds = motion.library.expressions[anger].seconds();
        assert_eq!((motion.timeline(), motion.is_playing, motion.takes_course()), ((0.0, Some(seconds)), true, true));
        assert!(motion.pose(&table, &breed).is_rest(), "it begins at rest");
        motion.pass(0.2);
        let coming = motion.pose(&table, &breed);
        assert!(!coming.is_rest() && coming != best);
        motion.scrub(still);
        let there = motion.act.asked(&motion.library, motion.time);
        assert_eq!(there.units, motion.library.expressions[anger].still());
        // Mixed by weight, with the longer of both as its length.
        motion.set_weight(fear, 0.5);
        let length = [anger, fear].map(|e| motion.library.expressions[e].seconds()).into_iter().fold(0.0, f64::max);
        assert_eq!(motion.timeline().1, Some(length));
        // To its end and round again, or to its end and no further.
        motion.play_or_pause();
        (0..400).for_each(|_| motion.pass(0.05));
        assert!(motion.is_playing && motion.timeline().0 <= length);
        motion.loops = false;
        (0..400).for_each(|_| motion.pass(0.05));
        assert_eq!((motion.timeline().0, motion.is_playing), (length, false));
        assert_eq!(motion.act.asked(&motion.library, motion.time).units, Activation::default(), "over");
        motion.play_or_pause();
        assert_eq!((motion.timeline().0, motion.is_playing), (0.0, true), "from its start");
        // A clip that repeats goes on beside it, and without it has no end.
        let pant = motion.library.clips.iter().position(|c| c.id == "pant").unwrap();
        motion.set_clip(Some(pant));
        assert_eq!(motion.timeline().1, Some(length));
        motion.set_course(false);
        assert_eq!(motion.timeline().1, Some(motion.library.clips[pant].seconds));
    }

    #[test]
    fn time_runs_beyond_a_clip_or_stands_still_while_it_plays() {
        let mut motion = motion();
        let yawn = motion.library.clips.iter().position(|c| c.id == "yawn").unwrap();
        motion.set_clip(Some(yawn));
        (0..100).for_each(|_| motion.pass(0.05));
        let (time, length) = motion.timeline();
        assert!(motion.is_playing && (5.0 - 3.2 - time).abs() < 1e-6 && length == Some(3.2), "{time}");
        motion.loops = false;
        (0..100).for_each(|_| motion.pass(0.05));
        assert_eq!((motion.timeline().0, motion.is_playing), (3.2, false));
        motion.step(-1);
        assert!((motion.timeline().0 - 3.2 + FRAME_SECS).abs() < 1e-9);
        motion.reset();
        assert!(motion.timeline().1.is_none());
        let table = ParamTable::embedded().unwrap();
        assert!(motion.pose(&table, &Breed::defaults(&table)).is_rest());
    }
}
