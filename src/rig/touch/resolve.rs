//! What is done about contacts: lips go outwards, off the teeth; the tongue is lifted, lowered or made narrow between them;
//! the jaw closes no farther than teeth let it.
//!
//! Only what is deeper than at rest counts: a dog at rest is as it was bred, and a pose at rest changes no bit.

use super::motion::{Follow, Moved, Params};
use super::parts::{Part, Spheres};
use super::push::{Demand, Push};
use super::swept::{Group, Stray, Swept, Touching};
use super::table::Contact;
use crate::math::ops;
use glam::{Vec3, vec3};

/// What is left in contact deeper than this counts as touching, not as going through: canonical millimetres.
const ENOUGH: f32 = 0.02;

/// Buffers of a resolution: made once, written again.
#[derive(Clone, Debug, Default)]
pub struct Resolution {
    push: Push,
    x: Vec<f32>,
}

/// Rounds of finding contacts and pushing: a push out of one sphere may lead into the next.
const LIP_ROUNDS: usize = 5;

/// Moves the lips' vertices of a posed skin (`skin`: every vertex that [`Spheres::lip`] names; a control mesh or a refined
/// one) outwards, by the least that frees them from the teeth. Returns how deep they are left in them, metres, beyond what
/// they are at rest. `moved` within the limits; `stray`: how far the lips may be from where the jaw alone puts them, the push
/// not counted.
pub fn free_lips(
    swept: &Swept,
    moved: &Moved,
    stray: f32,
    skin: &mut [Vec3],
    touching: &mut Touching,
    resolution: &mut Resolution,
) -> f32 {
    let spheres = &swept.spheres;
    let enough = ENOUGH * spheres.unit;
    let Resolution { push, x } = resolution;
    x.clear();
    x.resize(spheres.lip().len(), 0.0);
    let first = spheres.of(Part::UpperLip).start;
    let (mut pushed, mut round) = (0.0_f32, 0);
    loop {
        // What was pushed strays farther.
        let stray = Stray { lips: stray + pushed, tongue: 0.0 };
        swept.place_hard(Group::Lips, moved, stray, &mut touching.centres);
        spheres.place_lips(skin, &mut touching.centres);
        touching.contacts.clear();
        swept.find(Group::Lips, moved.params(), stray, &touching.centres, &mut touching.contacts);
        push.clear();
        let mut deepest = 0.0_f32;
        for contact in &touching.contacts {
            let beyond = swept.beyond(contact);
            if beyond <= enough {
                continue;
            }
            deepest = deepest.max(beyond);
            let [tooth, lip] = contact.pair.map(usize::from);
            let span = spheres.spans()[lip - first];
            let [a, b] = span.ends.map(usize::from);
            let way = |k: usize| way_out(spheres, moved, k);
            let out = way(a).lerp(way(b), span.t).normalize_or(Vec3::Z);
            let off = touching.centres[lip] - touching.centres[tooth];
            let reach = spheres.at_rest[tooth].radius + spheres.at_rest[lip].radius - swept.bred(contact.pair);
            push.add(Demand::of_two((a, 1.0 - span.t), (b, span.t), way_through(off, out, reach)));
        }
        if push.is_empty() || round == LIP_ROUNDS {
            return deepest;
        }
        push.solve(x);
        let mut farthest = 0.0_f32;
        for (k, by) in x.iter().enumerate().filter(|(_, by)| **by != 0.0) {
            skin[spheres.lip()[k].vertex as usize] += way_out(spheres, moved, k) * *by;
            farthest = farthest.max(by.abs());
        }
        pushed += farthest;
        round += 1;
    }
}

/// Out of the mouth at a lip's vertex, as it is turned now.
fn way_out(spheres: &Spheres, moved: &Moved, lip_vertex: usize) -> Vec3 {
    let lip = &spheres.lip()[lip_vertex];
    moved.turn_with(lip.follow, lip.outwards)
}

/// How far a point goes along a unit way until it is out of a ball of that radius about the origin.
fn way_through(from: Vec3, way: Vec3, radius: f32) -> f32 {
    let (along, off) = (from.dot(way), from.length_squared());
    ops::sqrt((along * along - off + radius * radius).max(0.0)) - along
}

/// Knots along the tongue from its root to its tip.
pub const KNOTS: usize = 17;

/// How a tongue is moved to be free of teeth: straight between knots. Metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TongueShift {
    /// What each side gives way towards the middle where the tongue is widest; less nearer to the middle.
    pub narrow: [f32; KNOTS],
    /// Up in the mandible's frame; down where negative.
    pub lift: [f32; KNOTS],
}

impl TongueShift {
    /// Where a point of the posed tongue goes; `along`: [`Spheres::along_tongue`] of it at rest, `half_width`:
    /// [`Spheres::tongue_half_width`] there.
    pub fn apply(&self, p: Vec3, along: f32, half_width: f32, moved: &Moved) -> Vec3 {
        let ([i, j], t) = knots(along);
        let mix = |list: &[f32; KNOTS]| list[i] + t * (list[j] - list[i]);
        // Never past the middle.
        let part = (mix(&self.narrow) / half_width.max(1e-6)).clamp(0.0, 0.9);
        let middle = moved.params().0[2];
        let p = vec3(middle + (p.x - middle) * (1.0 - part), p.y, p.z);
        p + moved.turn_with(Follow::MANDIBLE, Vec3::Y) * mix(&self.lift)
    }

    /// Whether it moves nothing.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }
}

/// The knots on both sides of a place along the tongue, and the part of the way between them.
fn knots(along: f32) -> ([usize; 2], f32) {
    let at = along.clamp(0.0, 1.0) * (KNOTS - 1) as f32;
    let k = (at as usize).min(KNOTS - 2);
    ([k, k + 1], at - k as f32)
}

/// Rounds of finding contacts of the tongue and pushing.
const TONGUE_ROUNDS: usize = 4;
/// How often what one place of the tongue does is shared with its neighbours.
const SMOOTH: usize = 2;

/// By how much the tongue gives way to be free of the teeth, and how deep it is left in them, metres, beyond what it is at
/// rest. In `touching` the tongue's centres are where it is; they are moved along. `moved` within the limits; `stray`: how
/// far they may be from where the parameters alone put them.
pub fn free_tongue(
    swept: &Swept,
    moved: &Moved,
    stray: f32,
    touching: &mut Touching,
    resolution: &mut Resolution,
) -> (TongueShift, f32) {
    let spheres = &swept.spheres;
    let enough = ENOUGH * spheres.unit;
    let Resolution { push, x } = resolution;
    x.clear();
    x.resize(2 * KNOTS, 0.0);
    let up = moved.turn_with(Follow::MANDIBLE, Vec3::Y);
    let mut total = TongueShift::default();
    let (mut pushed, mut round) = (0.0_f32, 0);
    loop {
        let stray = Stray { lips: 0.0, tongue: stray + pushed };
        touching.contacts.clear();
        for group in [Group::TongueAbove, Group::TongueBelow] {
            swept.place_hard(group, moved, stray, &mut touching.centres);
            swept.find(group, moved.params(), stray, &touching.centres, &mut touching.contacts);
        }
        push.clear();
        let mut deepest = 0.0_f32;
        for contact in &touching.contacts {
            let beyond = swept.beyond(contact);
            if beyond > enough {
                deepest = deepest.max(beyond);
                push.add(demand_of_tongue(swept, moved, &touching.centres, contact, up, beyond));
            }
        }
        if push.is_empty() || round == TONGUE_ROUNDS {
            return (total, deepest);
        }
        push.solve(x);
        let mut shift = TongueShift::default();
        for k in 0..KNOTS {
            (shift.narrow[k], shift.lift[k]) = (x[k].max(0.0), x[KNOTS + k]);
        }
        even(&mut shift);
        for k in spheres.of(Part::Tongue) {
            let at_rest = spheres.at_rest[k].centre;
            let (along, half) = (spheres.along_tongue(at_rest), spheres.tongue_half_width(at_rest));
            let now = shift.apply(touching.centres[k], along, half, moved);
            pushed = pushed.max(now.distance(touching.centres[k]) * (round + 1) as f32);
            touching.centres[k] = now;
        }
        for k in 0..KNOTS {
            total.narrow[k] += shift.narrow[k];
            total.lift[k] += shift.lift[k];
        }
        round += 1;
    }
}

/// What a contact asks of the tongue. To the sides it gives way by getting narrow, where its surface, not its middle, counts;
/// up and down as a whole.
fn demand_of_tongue(
    swept: &Swept,
    moved: &Moved,
    centres: &[Vec3],
    contact: &Contact,
    up: Vec3,
    beyond: f32,
) -> Demand {
    let spheres = &swept.spheres;
    let k = usize::from(contact.pair[1]);
    let at_rest = &spheres.at_rest[k];
    let ([i, j], t) = knots(spheres.along_tongue(at_rest.centre));
    let off = centres[k].x - moved.params().0[2];
    let half = spheres.tongue_half_width(at_rest.centre).max(1e-6);
    let sideways = contact.direction.x;
    // A tooth that stands between the tongue's middle and the sphere cannot be passed by getting narrow.
    let narrows = if sideways * off < 0.0 { sideways.abs() * (off.abs() / half).min(1.0) } else { 0.0 };
    let lifts = contact.direction.dot(up);
    let terms = [(i, narrows * (1.0 - t)), (j, narrows * t), (KNOTS + i, lifts * (1.0 - t)), (KNOTS + j, lifts * t)];
    Demand { terms: terms.map(|(k, a)| (k as u16, a)), least: beyond }
}

/// Neighbours go along, so that the tongue stays even; nothing gives way by less.
fn even(shift: &mut TongueShift) {
    for list in [&mut shift.narrow, &mut shift.lift] {
        for _ in 0..SMOOTH {
            let before = *list;
            for k in 0..KNOTS {
                let (a, b, c) = (before[k.saturating_sub(1)], before[k], before[(k + 1).min(KNOTS - 1)]);
                let mean = 0.25 * (a + 2.0 * b + c);
                // Away from rest, on the side on which it is.
                list[k] = if b > 0.0 || b == 0.0 && mean > 0.0 { mean.max(b) } else { mean.min(b) };
            }
        }
    }
}

/// Steps of closing.
const JAW_STEPS: usize = 10;
/// Farthest that the teeth hold a jaw open beyond what is asked for, radians.
const HELD_OPEN: f32 = 0.35;

/// The gape nearest to the one asked for, and never smaller, at which no tooth is deeper than at rest in another one or in
/// bone; and how deep they are then left in each other, metres, beyond that. Where opening would not part them, as where the
/// jaw slides a canine into its neighbour, the gape stays.
pub fn least_gape(swept: &Swept, params: Params, touching: &mut Touching) -> (f32, f32) {
    let asked = params.0[0];
    let enough = ENOUGH * swept.spheres.unit;
    let mut gape = asked;
    let mut step = 0;
    loop {
        let moved = swept.spheres.joints().at(swept.clamped(params.with_gape(gape)));
        swept.place(Group::Hard, &moved, Stray::default(), &mut touching.centres);
        touching.contacts.clear();
        swept.find(Group::Hard, moved.params(), Stray::default(), &touching.centres, &mut touching.contacts);
        let (mut deepest, mut wider) = (0.0_f32, 0.0_f32);
        for contact in &touching.contacts {
            let beyond = swept.beyond(contact);
            let [upper, lower] = swept.parts(contact);
            if beyond <= enough || upper == Part::Eyes {
                continue;
            }
            deepest = deepest.max(beyond);
            // In every pairing the second part goes with the mandible.
            debug_assert!(matches!(lower, Part::LowerTeeth | Part::Mandible));
            let lower = touching.centres[usize::from(contact.pair[1])];
            let rate = moved.opening(lower).dot(contact.direction);
            // Not slower than a tenth of the way round: what opening hardly parts, it does not part.
            if rate > 0.1 * lower.distance(swept.spheres.joints().hinge) {
                wider = wider.max(beyond / rate);
            }
        }
        if wider == 0.0 || step == JAW_STEPS {
            return (gape, deepest);
        }
        gape = (gape + wider).min(asked + HELD_OPEN);
        step += 1;
    }
}
