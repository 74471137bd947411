//! Lips off the teeth.

use super::{ENOUGH, Resolution, way_through};
use crate::rig::touch::motion::Moved;
use crate::rig::touch::parts::{Part, Spheres};
use crate::rig::touch::push::Demand;
use crate::rig::touch::swept::{Group, Stray, Swept, Touching};
use glam::Vec3;

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
