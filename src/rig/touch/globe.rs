//! Points that stay off an eyeball, wherever it looks: lid margins and third eyelids as the cornea turns under them.

use crate::rig::Eye;
use glam::Vec3;

/// A surface that slopes as the cornea does, which falls off by at most a seventh of its distance from the centre in a radian,
/// is nearer than it is along the ray from the centre by no more than this.
const SLOPE: f32 = 1.012;

/// Moves points that are nearer than `least` metres to the eyeball's surface, or inside, straight away from its centre until
/// they are not. Others keep their bits. Returns how much the farthest was moved, metres.
pub fn keep_off_eye(eye: &Eye, least: f32, points: &mut [Vec3]) -> f32 {
    let mut farthest = 0.0_f32;
    for p in points {
        let from = *p - eye.centre;
        let distance = from.length();
        // In the very centre any way is as good.
        let direction = if distance > 0.0 { from / distance } else { eye.axes[2] };
        let wanted = eye.reach(direction) + least * SLOPE;
        if distance < wanted {
            *p = eye.centre + direction * wanted;
            farthest = farthest.max(wanted - distance);
        }
    }
    farthest
}
