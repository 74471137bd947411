//! Which rule a vertex follows, by the sharp edges that meet in it: the same for all schemes.
//!
//! Hoppe, DeRose, Duchamp, Halstead, Jin, McDonald, Schweitzer and Stuetzle 1994 (the four rules); DeRose, Kass and
//! Truong 1998, section 4 and appendix B (sharpness that falls, and the blend in the step where a rule changes). That
//! OpenSubdiv computes the same is proven in `tests/oracle.rs`.

use super::scheme::Creasing;
use super::tags::INFINITE_SHARPNESS;

/// The rule by number of sharp edges: none, one, two, more.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Inside the surface.
    Smooth,
    /// Where a crease ends inside the surface; the masks are those of a smooth vertex.
    Dart,
    /// On a crease or a boundary.
    Crease,
    /// Where creases meet, or where a tag says so: it stays.
    Corner,
}

impl Rule {
    /// The rule of a vertex in which `n_sharp` sharp or boundary edges meet.
    pub fn of(n_sharp: usize, vertex_is_sharp: bool) -> Rule {
        match n_sharp {
            _ if vertex_is_sharp => Rule::Corner,
            0 => Rule::Smooth,
            1 => Rule::Dart,
            2 => Rule::Crease,
            _ => Rule::Corner,
        }
    }

    /// Whether the smooth masks are used.
    pub fn is_smooth(self) -> bool {
        matches!(self, Rule::Smooth | Rule::Dart)
    }
}

/// How sharp the surroundings of a vertex are: one number for each edge in ring order, and its own.
#[derive(Clone, Debug, Default)]
pub(super) struct Surroundings {
    /// Sharpness of each edge at the vertex, in ring order. Boundaries have infinity.
    pub(super) edges: Vec<f32>,
    /// The same in the next step. Shorter-lived than `edges`: filled by [`Surroundings::fall`].
    next: Vec<f32>,
    /// Its own.
    pub(super) vertex: f32,
    next_vertex: f32,
}

/// The rules of a vertex in this step and the next, and how much of the first still counts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Rules {
    pub(super) now: Rule,
    pub(super) next: Rule,
    /// Weight of `now`: 1 where both are the same.
    pub(super) weight_now: f64,
}

impl Surroundings {
    pub(super) fn clear(&mut self) {
        self.edges.clear();
        self.vertex = 0.0;
    }

    /// Works out what is left of each sharpness after this step.
    pub(super) fn fall(&mut self, creasing: Creasing) {
        self.next.clear();
        for edge in 0..self.edges.len() {
            self.next.push(self.child(edge, creasing));
        }
        self.next_vertex = less_one(self.vertex);
    }

    /// What the half of edge `edge` at this vertex has left after the step.
    pub(super) fn child(&self, edge: usize, creasing: Creasing) -> f32 {
        let sharpness = self.edges[edge];
        if creasing == Creasing::Uniform || !is_semi_sharp(sharpness) {
            return less_one(sharpness);
        }
        let (mut sum, mut count) = (0.0, 0.0);
        for (_, &other) in self.edges.iter().enumerate().filter(|&(i, &s)| i != edge && is_semi_sharp(s)) {
            sum += other;
            count += 1.0;
        }
        if count == 0.0 { less_one(sharpness) } else { (0.75 * sharpness + 0.25 * (sum / count) - 1.0).max(0.0) }
    }

    /// The rules, after [`fall`](Self::fall).
    pub(super) fn rules(&self) -> Rules {
        let now = Rule::of(self.edges.iter().filter(|&&s| s > 0.0).count(), self.vertex > 0.0);
        let next = Rule::of(self.next.iter().filter(|&&s| s > 0.0).count(), self.next_vertex > 0.0);
        if now == next {
            return Rules { now, next, weight_now: 1.0 };
        }
        // The rule changes with the sharpnesses that end in this step; their mean says how much of it is left.
        let (mut sum, mut count) = (0.0, 0.0);
        let pairs = self.edges.iter().zip(&self.next).map(|(&a, &b)| (a, b));
        for (now, _) in pairs.chain([(self.vertex, self.next_vertex)]).filter(|&(now, next)| now > 0.0 && next <= 0.0) {
            sum += f64::from(now);
            count += 1.0;
        }
        Rules { now, next, weight_now: if count > 0.0 { (sum / count).min(1.0) } else { 0.0 } }
    }

    /// Whether edge `edge` is still sharp in the next step.
    pub(super) fn stays_sharp(&self, edge: usize) -> bool {
        self.next[edge] > 0.0
    }
}

pub(super) fn is_semi_sharp(sharpness: f32) -> bool {
    sharpness > 0.0 && sharpness < INFINITE_SHARPNESS
}

pub(super) fn less_one(sharpness: f32) -> f32 {
    if sharpness >= INFINITE_SHARPNESS { sharpness } else { (sharpness - 1.0).max(0.0) }
}
