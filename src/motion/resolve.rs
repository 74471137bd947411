//! What of the units that are asked for can be at once: the rules, one after another, in the order of their file.

use super::{Activation, Rule, RuleKind, Side, UnitTable};

/// The second of two exclusive units may come up to this part of the first before the first gives way.
const CLEAR: f32 = 0.75;

/// A unit that a rule has changed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Overruled {
    /// Its number.
    pub unit: usize,
    /// On which side.
    pub side: Side,
    /// What was asked for, or what earlier rules left of it; of both sides the larger.
    pub from: f32,
    /// What became of it: less, or more where another unit brings it along.
    pub to: f32,
    /// The unit on whose account.
    pub by: usize,
    /// The number of the rule in its table.
    pub rule: usize,
}

impl UnitTable {
    /// What can be at once of what is asked for; every change is told to `tell`. Values are brought into 0 to 1 first.
    /// Allocates nothing. What comes out stays as it is when it is resolved once more.
    pub fn resolve(&self, asked: &Activation, mut tell: impl FnMut(Overruled)) -> Activation {
        let mut ruling = Ruling { out: asked.clamped(), side: Side::Both, rule: 0, tell: &mut tell };
        for (number, rule) in self.rules.iter().enumerate() {
            ruling.rule = number;
            let sides: &[Side] = if rule.is_by_side { &[Side::Left, Side::Right] } else { &[Side::Both] };
            for &side in sides {
                ruling.side = side;
                ruling.apply(rule);
            }
        }
        ruling.out
    }
}

/// One rule on one side, or on the head as a whole.
struct Ruling<'a> {
    out: Activation,
    side: Side,
    rule: usize,
    tell: &'a mut dyn FnMut(Overruled),
}

impl Ruling<'_> {
    fn apply(&mut self, rule: &Rule) {
        match &rule.kind {
            RuleKind::LargerWins(units) => {
                let size = |(unit, size): (usize, f32)| size * self.value(unit);
                let mut winner = units[0];
                for &unit in &units[1..] {
                    if size(unit) > size(winner) {
                        winner = unit;
                    }
                }
                for &(unit, _) in units.iter().filter(|(unit, _)| *unit != winner.0) {
                    self.change(unit, 0.0, winner.0);
                }
            }
            &RuleKind::Supersedes(larger, lesser) => {
                if self.value(larger) >= self.value(lesser) {
                    self.change(lesser, 0.0, larger);
                }
            }
            RuleKind::Excludes(units) => self.exclude(units),
            &RuleKind::Opposes(a, b) => {
                let sum = self.value(a) + self.value(b);
                // A sum that has been brought to 1 may be off by a rounding.
                if sum > 1.0 + 4.0 * f32::EPSILON {
                    let (a_left, b_left) = (self.value(a) / sum, self.value(b) / sum);
                    self.change(a, a_left, b);
                    self.change(b, b_left, a);
                }
            }
            &RuleKind::Implies(from, what, times) => {
                self.change(what, self.value(what).max((times * self.value(from)).min(1.0)), from);
            }
        }
    }

    fn exclude(&mut self, units: &[usize]) {
        let (mut first, mut second) = (units[0], None);
        for &unit in &units[1..] {
            if self.value(unit) > self.value(first) {
                second = Some(first);
                first = unit;
            } else if second.is_none_or(|s| self.value(unit) > self.value(s)) {
                second = Some(unit);
            }
        }
        let Some(second) = second.filter(|&s| self.value(s) > 0.0) else { return };
        let lead = (self.value(first) - self.value(second)) / (1.0 - CLEAR);
        self.change(first, self.value(first).min(lead), second);
        for &unit in units.iter().filter(|&&unit| unit != first) {
            self.change(unit, 0.0, first);
        }
    }

    /// Of a unit on the side in question; of both, the larger.
    fn value(&self, unit: usize) -> f32 {
        let [left, right] = self.out.get(unit);
        match self.side {
            Side::Both => left.max(right),
            Side::Left => left,
            Side::Right => right,
        }
    }

    fn change(&mut self, unit: usize, to: f32, by: usize) {
        let from = self.value(unit);
        if to == from {
            return;
        }
        let [left, right] = self.out.get(unit);
        *self.out.get_mut(unit) = match self.side {
            // Both sides go down by the same part of theirs, or up to at least so much.
            Side::Both if to < from => [left * (to / from), right * (to / from)],
            Side::Both => [left.max(to), right.max(to)],
            side => side.put([left, right], to),
        };
        (self.tell)(Overruled { unit, side: self.side, from, to, by, rule: self.rule });
    }
}
