//! The eyeball: a globe with a cornea that bulges out of it.

use crate::math::ops;
use glam::Vec3;

/// An eyeball's place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Eye {
    /// Centre, metres.
    pub centre: Vec3,
    /// Radius, metres.
    pub radius: f32,
    /// Unit axes: to the dog's left (in the eye's own frame), up, and the direction of gaze.
    pub axes: [Vec3; 3],
}

/// Width of the cornea as a part of the globe's diameter, and its least and most, metres: 13 to 17 mm.
const CORNEA: [f32; 3] = [0.83, 0.013, 0.017];
/// Height of the cornea as a part of its width.
const LOWER: f32 = 0.97;
/// How far the cornea's apex stands out of the globe, as a part of its radius: its own radius is then nine tenths of the globe's.
const BULGE: f32 = 0.065;

impl Eye {
    /// Angles of the limbus off the axis of gaze, radians: to the sides and upwards.
    pub fn limbus(&self) -> [f32; 2] {
        let diameter = (2.0 * self.radius).max(1e-6);
        let width = (CORNEA[0] * diameter).clamp(CORNEA[1], CORNEA[2]).min(0.86 * diameter);
        [width, LOWER * width].map(|chord| ops::asin(chord / diameter))
    }

    /// Of the limbus where it is turned from the side upwards; `sin`: of that turn.
    pub fn limbus_at([side, up]: [f32; 2], sin: f32) -> f32 {
        side + (up - side) * sin * sin
    }

    /// Distance of the surface from the centre as a part of the radius, and its slope over the angle; `t`: the angle off
    /// the axis as a part of the limbus', `limbus`: that angle. The edge between cornea and globe has the mean of both.
    pub fn profile(t: f32, limbus: f32) -> [f32; 2] {
        if t > 1.0 {
            return [1.0, 0.0];
        }
        let edge = if t == 1.0 { 0.5 } else { 1.0 };
        [1.0 + BULGE * (1.0 - t * t), -2.0 * BULGE * t / limbus * edge]
    }

    /// Distance of the surface from the centre in a unit direction, metres.
    pub fn reach(&self, direction: Vec3) -> f32 {
        let [a, b, g] = self.axes.map(|axis| axis.dot(direction));
        let away = ops::sqrt(a * a + b * b);
        let limbus = Self::limbus_at(self.limbus(), if away > 0.0 { b / away } else { 0.0 });
        self.radius * Self::profile(ops::atan2(away, g) / limbus, limbus)[0]
    }

    /// The mirror image: the eye of the other side.
    #[must_use]
    pub fn mirrored(&self) -> Eye {
        let flip = |v: Vec3| Vec3::new(-v.x, v.y, v.z);
        let [a, b, g] = self.axes;
        Eye { centre: flip(self.centre), radius: self.radius, axes: [-flip(a), flip(b), flip(g)] }
    }
}
