//! What a head does: units, expressions, clips and life together, and what hangs on it following late.

use super::{
    Activation, Build, Follow, Library, Life, Moment, Overruled, Player, Pose, STEP_SECS, Stimulus, steps_until,
};

/// An expression in a mixture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mixed {
    /// Its number in the library.
    pub expression: usize,
    /// How much of it, 0 to 1.
    pub weight: f32,
    /// When it starts, seconds; without, it stands still where it shows itself best.
    pub start: Option<f64>,
}

/// Everything at once: what is asked for, and the state of what takes steps.
#[derive(Clone, Debug, PartialEq)]
pub struct Act {
    /// Units that somebody asks for.
    pub units: Activation,
    /// Channels that somebody moves beside them.
    pub direct: Pose,
    /// Expressions, which are added to them.
    pub expressions: Vec<Mixed>,
    /// Clips, which are laid over both.
    pub player: Player,
    /// Life as it was at time 0, if it goes on by itself.
    pub life: Option<Life>,
    /// How the head is built.
    pub build: Build,
    /// Life and springs at the last step.
    lives: Option<Life>,
    follow: Follow,
}

impl Act {
    /// Nothing is done yet.
    pub fn new(build: Build) -> Self {
        Self {
            units: Activation::default(),
            direct: Pose::default(),
            expressions: Vec::new(),
            player: Player::default(),
            life: None,
            build,
            lives: None,
            follow: Follow::new(build),
        }
    }

    /// What is asked for at a time, in seconds, life excepted.
    pub fn asked(&self, library: &Library, time: f64) -> Moment {
        let mut moment = Moment { units: self.units, direct: self.direct };
        for mixed in &self.expressions {
            if let Some(expression) = library.expressions.get(mixed.expression) {
                let since = mixed.start.map_or(expression.still_s, |start| time - start);
                moment.add(&expression.moment(since), mixed.weight);
            }
        }
        self.player.apply(library, time, &mut moment);
        moment
    }

    /// The pose at a time, in seconds. Steps are taken up to it, from 0 on where time has run back; `stimulus_at` tells what
    /// is noticed at the time of a step, `tell` hears what is overruled. Equal arguments give the same bits whatever was
    /// asked for before; allocates nothing.
    pub fn pose(
        &mut self,
        library: &Library,
        time: f64,
        mut stimulus_at: impl FnMut(f64) -> Stimulus,
        tell: impl FnMut(Overruled),
    ) -> Pose {
        if self.follow.next_step() > steps_until(time) + 1 {
            self.restart();
        }
        if self.follow.next_step() == 0 {
            self.lives = self.life;
        }
        *self.follow.build_mut() = self.build;
        while self.follow.next_step() <= steps_until(time) {
            let at = self.follow.next_step() as f64 * STEP_SECS;
            if let Some(life) = &mut self.lives {
                life.advance(at, &mut stimulus_at);
            }
            let pose = library.pose(&self.moment(library, at), at, |_| ());
            self.follow.take(&pose);
        }
        let mut pose = library.pose(&self.moment(library, time), time, tell);
        self.follow.apply(&mut pose);
        library.limits.clamped(&pose)
    }

    /// Forgets life and springs: the next pose takes every step anew.
    pub fn restart(&mut self) {
        self.follow = Follow::new(self.build);
    }

    fn moment(&self, library: &Library, time: f64) -> Moment {
        let mut moment = self.asked(library, time);
        if let Some(life) = &self.lives {
            // What somebody asks for closes an eye as well as life does, but never twice.
            let alive = life.at(library, time);
            for unit in 0..library.units.units.len() {
                let value = alive.units.get(unit);
                for (now, value) in moment.units.get_mut(unit).iter_mut().zip(value) {
                    *now = now.max(value);
                }
            }
            moment.direct.add(&alive.direct, 1.0);
        }
        moment
    }
}
