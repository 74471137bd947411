//! The tongue off the teeth.

use super::{ENOUGH, Resolution, way_through};
use crate::rig::touch::motion::{Follow, Moved};
use crate::rig::touch::parts::Part;
use crate::rig::touch::push::Demand;
use crate::rig::touch::swept::{Group, Stray, Swept, Touching};
use crate::rig::touch::table::Contact;
use glam::{Vec3, vec3};

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
    /// Where a point of the posed tongue goes; of it at rest, `along` is
    /// [`along_tongue`](crate::rig::touch::Spheres::along_tongue) and `half_width`
    /// [`tongue_half_width`](crate::rig::touch::Spheres::tongue_half_width).
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
