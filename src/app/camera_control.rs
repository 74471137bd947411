//! Orbit, pan and zoom: hand movements in pixels to camera movements.

use crate::math::ops;
use crate::render::Camera;
use std::f32::consts::{FRAC_PI_2, TAU};

/// Radians a pixel.
const TURN: f32 = 0.0075;

/// Turns about the target.
pub(super) fn orbit(camera: &mut Camera, right: f32, down: f32) {
    camera.azimuth = (camera.azimuth - right * TURN) % TAU;
    camera.elevation = (camera.elevation + down * TURN).clamp(-FRAC_PI_2, FRAC_PI_2);
}

/// Moves the target so that it stays under the pointer. `height`: of the picture, pixels.
pub(super) fn pan(camera: &mut Camera, right: f32, down: f32, height: f32) {
    let metres = camera.height_at_target() / height.max(1.0);
    let [x, y, _] = camera.axes_in_world();
    camera.target += (y * down - x * right) * metres;
}

/// Goes nearer for positive steps, and keeps what is at (x, y) from the middle of the picture, in pixels to the right
/// and down, where it is.
pub(super) fn zoom(camera: &mut Camera, steps: f32, x: f32, y: f32, height: f32) {
    let before = camera.height_at_target();
    camera.distance = (camera.distance * ops::exp(-steps * 0.12)).clamp(0.02, 20.0);
    let gained = (before - camera.height_at_target()) / height.max(1.0);
    let [right, up, _] = camera.axes_in_world();
    camera.target += (right * x - up * y) * gained;
}

/// Where a dog looks that looks at a place of the picture, (x, y) heights of it to the right of the middle and down: degrees
/// to its left and up from straight ahead. The place is half way between the target and the camera.
pub(super) fn looked_at(camera: &Camera, x: f32, y: f32) -> [f32; 2] {
    let [right, up, back] = camera.axes_in_world();
    let way = 0.5 * camera.distance * back + (right * x - up * y) * camera.height_at_target();
    let way = camera.world_from_head().transpose() * way;
    [ops::atan2(way.x, way.z), ops::atan2(way.y, ops::hypot(way.x, way.z))].map(f32::to_degrees)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::{Lens, View};

    #[test]
    fn zooming_keeps_the_point_under_the_pointer() {
        let mut camera = Camera::at(View::Portrait, None, Lens::default());
        let [right, up, _] = camera.axes_in_world();
        let point = camera.target + (right * 100.0 - up * 60.0) * camera.height_at_target() / 500.0;
        zoom(&mut camera, 3.0, 100.0, 60.0, 500.0);
        let now = camera.target + (right * 100.0 - up * 60.0) * camera.height_at_target() / 500.0;
        assert!((point - now).length() < 1e-5);
    }

    #[test]
    fn a_dog_looks_away_from_the_pointer() {
        let mut camera = Camera::at(View::Side, Some(0.0), Lens::default());
        let [turn, lift] = looked_at(&camera, 0.0, 0.0);
        assert!((turn - 90.0).abs() < 1e-3 && lift.abs() < 1e-3, "from its left: {turn} {lift}");
        camera.azimuth = 0.0;
        let [turn, lift] = looked_at(&camera, 0.3, -0.3);
        assert!(turn > 5.0 && lift > 5.0, "to the right of the picture, which is its left, and up: {turn} {lift}");
    }

    #[test]
    fn the_elevation_stops_at_the_poles() {
        let mut camera = Camera::at(View::Front, None, Lens::default());
        orbit(&mut camera, 0.0, 1e4);
        assert_eq!(camera.elevation, FRAC_PI_2);
    }
}
