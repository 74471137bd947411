//! What every shader reads: one uniform block for a picture.

use super::camera::Camera;
use super::lights::{Lamp, Lights};
use super::preset::Preset;
use super::strand_pass;
use crate::coat::Condition;
use crate::frame::Eyeball;
use crate::math::ops;
use glam::{Mat4, Vec3, Vec4};

/// The block `Globals` of every file of `shaders/`, member by member.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
pub(super) struct Globals {
    clip_from_head: Mat4,
    shadow_from_head: Mat4,
    rim_from_head: Mat4,
    eye: Vec4,
    key: Vec4,
    fill: Vec4,
    rim: Vec4,
    up: Vec4,
    background_top: Vec4,
    background_bottom: Vec4,
    measures: Vec4,
    viewport: Vec4,
    /// How much of the haired skin is covered by strands, 0 to 1; which [`Stuff`](super::preset::Stuff) surfaces are of; exposure; how
    /// dark the head's shadow on the ground is.
    pub(super) coat: Vec4,
    /// The coat's condition: times its length, part of its hairs that are there, how much it is clipped, how wet it is.
    pub(super) hair: Vec4,
    /// How grey it is, how much a puppy's; width of a strand in metres, number of strands.
    pub(super) age: Vec4,
    key_light: Vec4,
    fill_light: Vec4,
    rim_light: Vec4,
    zenith: Vec4,
    horizon: Vec4,
    ground: Vec4,
    gathered: [Vec4; 3],
    floor: Vec4,
    head_from_clip: Mat4,
    /// The left one and the right.
    eyes: [EyeBlock; 2],
}

/// The struct `Eyeball` of `globals.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, bytemuck::Pod, bytemuck::Zeroable)]
struct EyeBlock {
    /// Metres, head's frame; and the radius, 0 where there is no such eye.
    centre: Vec4,
    /// Unit; and the limbus' angle to the side, to above, and nothing.
    axes: [Vec4; 3],
    /// Linear; and how much wider the pupil is than at rest, as a part of the iris' width.
    iris: Vec4,
    /// Two points of the opening between the lids each, in the plane of [`Eyeball::lids`].
    lids: [Vec4; 6],
}

impl EyeBlock {
    fn of(eyeball: &Eyeball) -> Self {
        let Eyeball { eye, iris, widened, lids } = eyeball;
        let [side, up] = eye.limbus();
        let [a, b, g] = eye.axes;
        Self {
            centre: eye.centre.extend(eye.radius),
            axes: [a.extend(side), b.extend(up), g.extend(0.0)],
            iris: iris.extend(*widened),
            lids: std::array::from_fn(|i| {
                let (one, other) = (lids[2 * i], lids[2 * i + 1]);
                Vec4::new(one.x, one.y, other.x, other.y)
            }),
        }
    }
}

/// The sphere around all that is drawn, in the head's frame.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Extent {
    pub centre: Vec3,
    pub radius: f32,
    /// How far hair may reach out of it, metres.
    pub margin: f32,
    /// How far the lowest point lies below its centre as the head is carried, metres.
    pub below: f32,
}

impl Extent {
    /// Around the box between two corners; an empty box gives a small sphere at the origin.
    pub(super) fn of_box((low, high): (Vec3, Vec3)) -> Self {
        if !(low.is_finite() && high.is_finite()) {
            return Self { centre: Vec3::ZERO, radius: 0.1, margin: 0.0, below: 0.1 };
        }
        let radius = ((high - low).length() * 0.5).max(1e-3);
        Self { centre: (low + high) * 0.5, radius, margin: 0.0, below: radius }
    }
}

impl Globals {
    /// Without eyes and hair. `size`: of the picture in pixels; `light_turn`: of the studio around the vertical, radians; `shadow_texels`:
    /// side of the shadow map; `background`: top and bottom as they stand in the file, sRGB; `skin_opacity`: 0 to 1.
    #[expect(clippy::too_many_arguments, reason = "one block holds all that a picture depends on")]
    pub(super) fn new(
        camera: &Camera,
        extent: Extent,
        size: [u32; 2],
        light_turn: f32,
        shadow_texels: u32,
        background: [Vec4; 2],
        skin_opacity: f32,
        preset: Preset,
    ) -> Self {
        let Lights { key: key_lamp, fill, rim, sky, exposure, contact } = preset.lights();
        let [width, height] = size.map(|s| s.max(1) as f32);
        let head_from_world = camera.world_from_head().transpose();
        let towards = |lamp: &Lamp| {
            let azimuth = camera.azimuth + light_turn + lamp.azimuth.to_radians();
            let elevation = lamp.elevation.to_radians();
            let (height, level) = ops::sin_cos(elevation);
            let (across, forward) = ops::sin_cos(azimuth);
            let direction = Vec3::new(across * level, height, forward * level);
            (head_from_world * direction).extend(0.0)
        };
        let [key, behind] = [key_lamp, rim].map(towards);
        let up = head_from_world * Vec3::Y;
        let clip_from_head = camera.clip_from_head(width / height, reach(camera, extent));
        let (eye, perspective) = camera.eye_in_head();
        let pixel = camera.height_at_target() / height;
        Self {
            clip_from_head,
            shadow_from_head: shadow_from_head(key.truncate(), extent),
            rim_from_head: shadow_from_head(behind.truncate(), extent),
            eye: eye.extend(perspective),
            key,
            fill: towards(fill),
            rim: behind,
            up: up.extend(0.0),
            background_top: background[0],
            background_bottom: background[1],
            measures: Vec4::new(2.0 * extent.radius, pixel, 1.0 / shadow_texels as f32, skin_opacity),
            viewport: Vec4::new(width, height, 1.0 / width, 1.0 / height),
            coat: Vec4::new(
                0.0,
                f32::from(preset.stuff() as u8),
                *exposure,
                if preset.has_ground() { *contact } else { 0.0 },
            ),
            hair: Vec4::new(1.0, 1.0, 0.0, 0.0),
            age: Vec4::ZERO,
            key_light: key_lamp.light.extend(0.0),
            fill_light: fill.light.extend(0.0),
            rim_light: rim.light.extend(0.0),
            zenith: sky.zenith.extend(0.0),
            horizon: sky.horizon.extend(0.0),
            ground: sky.ground.extend(0.0),
            gathered: sky.gathered().map(|light| light.extend(0.0)),
            floor: (extent.centre - up * extent.below).extend(1.6 * extent.radius),
            head_from_clip: clip_from_head.inverse(),
            eyes: Default::default(),
        }
    }

    /// Takes the hair of a head that is `size` metres large: its condition, how much it is a puppy's, and the number of strands.
    pub(super) fn set_hair(&mut self, condition: &Condition, youth: f32, size: f32, n_strands: u32) {
        let Condition { length, density, clipped, wet, grey } = *condition;
        self.hair = Vec4::new(length, density, clipped, wet);
        self.age = Vec4::new(grey, youth, strand_pass::width(size, n_strands), n_strands as f32);
        self.coat.x = strand_pass::cover(n_strands);
    }

    /// Takes what is to be known of the eyes: the left one and the right.
    pub(super) fn set_eyes(&mut self, eyes: &[Eyeball]) {
        for (block, eyeball) in self.eyes.iter_mut().zip(eyes) {
            *block = EyeBlock::of(eyeball);
        }
    }
}

/// Of a sphere around the camera's target that holds all that is drawn, metres.
fn reach(camera: &Camera, extent: Extent) -> f32 {
    extent.radius + extent.margin + (camera.world_from_head() * extent.centre - camera.target).length()
}

/// Texture coordinates and depth in the key light's map: a parallel projection around the extent.
fn shadow_from_head(key: Vec3, extent: Extent) -> Mat4 {
    let side = key.cross(Vec3::Z).try_normalize().unwrap_or(Vec3::X);
    let radius = extent.radius * 1.02;
    let view = glam::camera::rh::view::look_at_mat4(extent.centre + key * 2.0 * radius, extent.centre, side);
    let clip = glam::camera::rh::proj::directx::orthographic(-radius, radius, -radius, radius, radius, 3.0 * radius);
    let texture_from_clip =
        Mat4::from_translation(Vec3::new(0.5, 0.5, 0.0)) * Mat4::from_scale(Vec3::new(0.5, -0.5, 1.0));
    texture_from_clip * clip * view
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::render::camera::{Lens, View};

    #[test]
    fn the_shadow_map_holds_the_whole_sphere() {
        let extent = Extent { centre: Vec3::new(0.01, 0.02, 0.05), radius: 0.2, margin: 0.0, below: 0.2 };
        let key = Vec3::new(-0.5, 0.6, 0.6).normalize_or_zero();
        let shadow = shadow_from_head(key, extent);
        for direction in [Vec3::X, -Vec3::X, Vec3::Y, -Vec3::Y, Vec3::Z, -Vec3::Z, key, -key] {
            let p = shadow.project_point3(extent.centre + direction * extent.radius);
            assert!(p.cmpge(Vec3::ZERO).all() && p.cmple(Vec3::ONE).all(), "{direction} falls on {p}");
        }
        let near = shadow.project_point3(extent.centre + key * extent.radius);
        assert!(near.z < 0.1, "what is near the lamp is near in the map");
    }

    #[test]
    fn the_key_light_stands_at_the_upper_left_of_every_picture() {
        for view in View::NAMED {
            let mut camera = Camera::at(view, None, Lens::default());
            camera.elevation = camera.elevation.min(0.5);
            let extent = Extent { centre: Vec3::ZERO, radius: 0.1, margin: 0.0, below: 0.1 };
            let globals = Globals::new(&camera, extent, [64, 64], 0.0, 1024, [Vec4::ONE; 2], 1.0, Preset::Studio);
            let key = camera.world_from_head() * globals.key.truncate();
            let [right, up, _] = camera.axes_in_world();
            assert!(key.dot(right) < -0.2 && key.dot(up) > 0.1, "{view:?}");
        }
    }
}
