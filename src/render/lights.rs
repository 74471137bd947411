//! Lamps and sky of each way of showing a head.

use super::sky::Sky;
use glam::Vec3;

/// A lamp far away: degrees around the vertical from the camera and above the horizontal; its light, linear.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lamp {
    pub(super) azimuth: f32,
    pub(super) elevation: f32,
    pub(super) light: Vec3,
}

/// What lights a head. Lamps turn with the camera, so that every view is lit from its upper left; heights stay.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lights {
    /// The one that throws shadows.
    pub(super) key: Lamp,
    /// Opposite to it, without shadows.
    pub(super) fill: Lamp,
    /// From behind.
    pub(super) rim: Lamp,
    pub(super) sky: Sky,
    /// What the film makes of all of it.
    pub(super) exposure: f32,
    /// How dark the head's shadow on the ground is, 0 to 1.
    pub(super) contact: f32,
}

const fn lamp(azimuth: f32, elevation: f32, light: [f32; 3]) -> Lamp {
    Lamp { azimuth, elevation, light: Vec3::from_array(light) }
}

const fn sky(zenith: [f32; 3], horizon: [f32; 3], ground: [f32; 3]) -> Sky {
    Sky { zenith: Vec3::from_array(zenith), horizon: Vec3::from_array(horizon), ground: Vec3::from_array(ground) }
}

impl Lights {
    pub(super) const STUDIO: Self = Self {
        key: lamp(-38.0, 42.0, [2.62, 2.48, 2.26]),
        fill: lamp(48.0, 8.0, [0.27, 0.34, 0.44]),
        rim: lamp(152.0, 38.0, [1.75, 1.80, 1.95]),
        sky: sky([0.46, 0.51, 0.60], [0.27, 0.29, 0.31], [0.16, 0.135, 0.11]),
        exposure: 1.0,
        contact: 0.55,
    };

    pub(super) const DAYLIGHT: Self = Self {
        key: lamp(-52.0, 50.0, [3.10, 2.80, 2.25]),
        fill: lamp(60.0, 20.0, [0.08, 0.11, 0.16]),
        rim: lamp(160.0, 30.0, [0.55, 0.62, 0.75]),
        sky: sky([0.34, 0.54, 0.92], [0.62, 0.68, 0.74], [0.26, 0.25, 0.17]),
        exposure: 0.95,
        contact: 0.5,
    };

    pub(super) const CLAY: Self = Self {
        key: lamp(-48.0, 46.0, [2.30, 2.22, 2.10]),
        fill: lamp(52.0, 6.0, [0.16, 0.19, 0.24]),
        rim: lamp(150.0, 34.0, [1.0, 1.05, 1.15]),
        sky: sky([0.42, 0.44, 0.48], [0.26, 0.26, 0.27], [0.14, 0.13, 0.12]),
        exposure: 1.0,
        contact: 0.55,
    };

    /// No shadow may pass for an edge: all comes from all sides, and a little from the camera.
    pub(super) const PLATE: Self = Self {
        key: lamp(0.0, 12.0, [0.28, 0.28, 0.28]),
        fill: lamp(0.0, 0.0, [0.14, 0.14, 0.14]),
        rim: lamp(180.0, 60.0, [0.0, 0.0, 0.0]),
        sky: sky([1.30, 1.30, 1.30], [1.22, 1.22, 1.22], [1.06, 1.06, 1.06]),
        exposure: 1.0,
        contact: 0.0,
    };
}
