//! Points that stay out of bone, the mandible's wherever the jaw is: its field is asked where they would be with the jaw at
//! rest.

use super::motion::{Follow, Moved};
use crate::rig::bone::BoneField;
use crate::rig::lanes::{F8, P8};
use glam::Vec3;

/// Newton steps, and how far one goes at most, canonical millimetres.
const STEPS: usize = 16;
const CAP: f32 = 3.0;

/// Moves points that are nearer than `least` metres to the skull's bone, or inside, out of it by the nearest way. Others keep
/// their bits. `unit`: a canonical millimetre of the head, metres. Returns how deep the deepest was, metres.
pub fn keep_off_skull(skull: &BoneField, least: f32, unit: f32, points: &mut [Vec3]) -> f32 {
    keep_off(skull, least, unit, points, |p| p, |d| d)
}

/// The same of a mandible that the jaw has moved; `mandible`: its field at rest.
pub fn keep_off_mandible(mandible: &BoneField, moved: &Moved, least: f32, unit: f32, points: &mut [Vec3]) -> f32 {
    keep_off(mandible, least, unit, points, |p| moved.back(p), |d| moved.turn_with(Follow::MANDIBLE, d))
}

fn keep_off(
    field: &BoneField,
    least: f32,
    unit: f32,
    points: &mut [Vec3],
    at_rest: impl Fn(Vec3) -> Vec3,
    as_it_is: impl Fn(Vec3) -> Vec3,
) -> f32 {
    let mut deepest = 0.0_f32;
    for eight in points.chunks_mut(8) {
        // Most are clear: eight are asked at once.
        let place: [Vec3; 8] = std::array::from_fn(|k| at_rest(eight[k.min(eight.len() - 1)]));
        let lane = |axis: usize| F8(place.map(|p| p[axis]));
        let distances = field.distance8(P8 { x: lane(0), y: lane(1), z: lane(2) }).0;
        for (k, p) in eight.iter_mut().enumerate() {
            if distances[k] < least {
                deepest = deepest.max(least - distances[k]);
                *p += as_it_is(way_out(field, least, unit, place[k]));
            }
        }
    }
    deepest
}

/// From a point to where the bone is so far away.
fn way_out(field: &BoneField, least: f32, unit: f32, from: Vec3) -> Vec3 {
    let mut p = from;
    for _ in 0..STEPS {
        let (d, g) = field.sample(p, 0.1 * unit);
        let over = least - d;
        if over <= 0.0 {
            break;
        }
        // Where bodies meet the field is flat, and a whole step would go too far.
        p += (g * (over / g.length_squared().max(0.2))).clamp_length_max(CAP * unit);
    }
    p - from
}
