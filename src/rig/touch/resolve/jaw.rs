//! How far a jaw shuts.

use super::ENOUGH;
use crate::rig::touch::motion::Params;
use crate::rig::touch::parts::Part;
use crate::rig::touch::swept::{Group, Stray, Swept, Touching};

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

/// The gape nearest to the one asked for, and never smaller, at which no lower tooth or bone is deeper in what is above it
/// than the dog was bred; and how deep any is then left in what opening does not part it from, metres, beyond that.
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
