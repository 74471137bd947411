//! What is done about contacts: lips go outwards, off the teeth; the tongue is lifted, lowered or made narrow between them;
//! the jaw closes no farther than teeth let it.
//!
//! Only what is deeper than as the dog was bred counts, at rest and while its jaw opens straight: a pose at rest changes no
//! bit, and teeth that shear past each other do not keep a mouth open.

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
const TONGUE_ROUNDS: usize = 8;
/// Most that it gives way in a round, canonical millimetres.
const TONGUE_STEP: f32 = 1.5;
/// What lies nearer to the tongue's middle, as a part of its half width, gives way by no narrowing.
const NARROWS: f32 = 0.3;
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
                push.add(demand_of_tongue(swept, moved, &touching.centres, contact, up));
            }
        }
        if push.is_empty() || round == TONGUE_ROUNDS {
            return (total, deepest);
        }
        push.solve(x);
        let mut shift = TongueShift::default();
        // Demands that contradict each other ask for ever more.
        let most = TONGUE_STEP * spheres.unit;
        for k in 0..KNOTS {
            shift.narrow[k] = x[k].clamp(0.0, most);
            shift.lift[k] = x[KNOTS + k].clamp(-most, most);
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

/// What a contact asks of the tongue: to get narrow, or to go over a lower tooth or under an upper one, whichever is less.
fn demand_of_tongue(swept: &Swept, moved: &Moved, centres: &[Vec3], contact: &Contact, up: Vec3) -> Demand {
    let spheres = &swept.spheres;
    let [tooth, own] = contact.pair.map(usize::from);
    let at_rest = &spheres.at_rest[own];
    let ([i, j], t) = knots(spheres.along_tongue(at_rest.centre));
    let off = centres[own] - centres[tooth];
    let reach = spheres.at_rest[tooth].radius + at_rest.radius - swept.bred(contact.pair);
    let past = if swept.parts(contact)[0] == Part::UpperTeeth { -up } else { up };
    let past_by = way_through(off, past, reach);
    // A tooth that stands between the tongue's middle and the sphere cannot be left by getting narrow.
    let aside = centres[own].x - moved.params().0[2];
    let part = aside.abs() / spheres.tongue_half_width(at_rest.centre).max(1e-6);
    let narrow_by = way_through(off, Vec3::X * -aside.signum(), reach) / part.max(1e-6);
    let inwards = part > NARROWS && off.x * aside < 0.0;
    let (first, factor, least) =
        if inwards && narrow_by < past_by { (0, 1.0, narrow_by) } else { (KNOTS, past.dot(up), past_by) };
    Demand::of_two((first + i, factor * (1.0 - t)), (first + j, factor * t), least)
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

/// Steps of opening until nothing is left that opening parts, and of coming back as near as may be.
const OPENING: usize = 12;
const CLOSING: usize = 8;
/// Farthest that the teeth hold a jaw open beyond what is asked for, radians.
const HELD_OPEN: f32 = 0.35;
/// What opening parts slower than this part of the way round the hinge, it does not part: walls of canines.
const STEEP: f32 = 0.3;

/// What keeps a jaw from shutting so far: by how much it has to open at least, radians; and how deep any tooth is in another
/// or in bone, metres, beyond what is bred.
fn closed(swept: &Swept, params: Params, touching: &mut Touching) -> (f32, f32) {
    let moved = swept.spheres.joints().at(swept.clamped(params));
    swept.place(Group::Hard, &moved, Stray::default(), &mut touching.centres);
    touching.contacts.clear();
    swept.find(Group::Hard, moved.params(), Stray::default(), &touching.centres, &mut touching.contacts);
    let (mut wider, mut deepest) = (0.0_f32, 0.0_f32);
    for contact in &touching.contacts {
        let beyond = swept.beyond(contact);
        if beyond <= ENOUGH * swept.spheres.unit || swept.parts(contact)[0] == Part::Eyes {
            continue;
        }
        deepest = deepest.max(beyond);
        // In these pairings the second part goes with the mandible.
        let lower = touching.centres[usize::from(contact.pair[1])];
        let arm = lower.distance(swept.spheres.joints().hinge);
        let rate = moved.opening(lower).dot(contact.direction);
        if rate > STEEP * arm {
            wider = wider.max(beyond / arm.max(1e-6));
        }
    }
    (wider, deepest)
}

/// The gape nearest to the one asked for, and never smaller, at which no lower tooth or bone rests deeper than at rest on
/// what is above it; and how deep any is then left in what opening does not part it from, metres, beyond rest.
pub fn least_gape(swept: &Swept, params: Params, touching: &mut Touching) -> (f32, f32) {
    let asked = params.0[0];
    let (mut held, mut free) = (asked, asked);
    for _ in 0..OPENING {
        let (wider, deepest) = closed(swept, params.with_gape(free), touching);
        if wider == 0.0 {
            if free == asked {
                return (asked, deepest);
            }
            break;
        }
        held = free;
        // Never a step that could pass over what it parts.
        free = (free + wider).min(asked + HELD_OPEN);
    }
    for _ in 0..CLOSING {
        let middle = 0.5 * (held + free);
        if closed(swept, params.with_gape(middle), touching).0 == 0.0 {
            free = middle;
        } else {
            held = middle;
        }
    }
    (free, closed(swept, params.with_gape(free), touching).1)
}

/// Steps of bringing a jaw back to the middle.
const BACK: usize = 6;
/// How deep walls of teeth may be left in each other beyond what is bred, canonical millimetres.
const WALLS: f32 = 0.2;

/// The parameters with the jaw where teeth let it be: no nearer to shut, and where walls of canines meet no farther from the
/// middle than they allow. At rest and on the straight way to it nothing changes.
pub fn free_jaw(swept: &Swept, params: Params, touching: &mut Touching) -> Params {
    let aside = |part: f32| {
        let mut to = params;
        (to.0[1], to.0[2]) = (params.0[1] * part, params.0[2] * part);
        to
    };
    let (mut free, mut blocked, mut part) = (0.0, 1.0, 1.0);
    for _ in 0..BACK {
        let to = aside(part);
        let (gape, deepest) = least_gape(swept, to, touching);
        if deepest > WALLS * swept.spheres.unit {
            blocked = part;
        } else if part == 1.0 {
            return to.with_gape(gape);
        } else {
            free = part;
        }
        part = 0.5 * (free + blocked);
    }
    let to = aside(free);
    let (gape, _) = least_gape(swept, to, touching);
    to.with_gape(gape)
}
