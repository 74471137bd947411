//! From where a head is looked at: named views, lenses, and the fit of a head into a picture.
//!
//! Two spaces: the *head* is the frame of all positions; the *world* is the head carried at a pitch, nose down for
//! positive angles, about the x axis. Cameras stand in the world; azimuth 0 looks at the face from +Z, +90 degrees at
//! the dog's left side from +X; elevation is positive from above.

use crate::math::ops;
use glam::{Mat3, Mat4, Vec2, Vec3};
use std::f32::consts::{FRAC_PI_2, PI};
use std::str::FromStr;
use thiserror::Error;

/// How far dogs carry the nose below the horizontal when they stand at ease, radians.
const CARRIED_PITCH: f32 = 20.0 * PI / 180.0;

/// A direction to look from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// The face, from +Z.
    Front,
    /// The dog's left side.
    Side,
    /// Halfway between: azimuth 45, elevation 12 degrees.
    ThreeQuarter,
    /// From above, the nose towards the lower edge.
    Top,
    /// Azimuth 28, elevation 10 degrees: where a head reads best.
    Portrait,
    /// Any other direction, radians.
    Angles {
        /// Around the vertical, towards the dog's left.
        azimuth: f32,
        /// Above the horizontal.
        elevation: f32,
    },
}

/// A word that names no view.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "`{0}` is no view; say front, side, three-quarter, top, portrait, or AZIMUTH,ELEVATION in degrees such as 30,10"
)]
pub struct ViewError(String);

impl View {
    /// The named views, in the order of the help text.
    pub const NAMED: [Self; 5] = [Self::Front, Self::Side, Self::ThreeQuarter, Self::Top, Self::Portrait];

    /// The name it is asked for by; angles in degrees where it has none.
    pub fn name(self) -> String {
        match self {
            Self::Front => "front".into(),
            Self::Side => "side".into(),
            Self::ThreeQuarter => "three-quarter".into(),
            Self::Top => "top".into(),
            Self::Portrait => "portrait".into(),
            Self::Angles { azimuth, elevation } => {
                format!("{},{}", azimuth.to_degrees().round(), elevation.to_degrees().round())
            }
        }
    }

    /// Azimuth and elevation, radians.
    pub fn angles(self) -> (f32, f32) {
        let degrees = |a: f32, e: f32| (a.to_radians(), e.to_radians());
        match self {
            Self::Front => (0.0, 0.0),
            Self::Side => (FRAC_PI_2, 0.0),
            Self::ThreeQuarter => degrees(45.0, 12.0),
            Self::Top => (0.0, FRAC_PI_2),
            Self::Portrait => degrees(28.0, 10.0),
            Self::Angles { azimuth, elevation } => (azimuth, elevation),
        }
    }

    /// How far the nose is carried below the horizontal in this view, radians, unless a person says otherwise.
    pub fn pitch(self) -> f32 {
        match self {
            Self::Front | Self::Portrait | Self::ThreeQuarter => CARRIED_PITCH,
            Self::Side | Self::Top | Self::Angles { .. } => 0.0,
        }
    }
}

impl FromStr for View {
    type Err = ViewError;

    fn from_str(text: &str) -> Result<Self, ViewError> {
        if let Some(view) = Self::NAMED.into_iter().find(|v| v.name() == text) {
            return Ok(view);
        }
        let wrong = || ViewError(text.to_owned());
        let (azimuth, elevation) = text.split_once(',').ok_or_else(wrong)?;
        let number = |s: &str| s.trim().parse::<f32>().ok().filter(|v| v.is_finite()).ok_or_else(wrong);
        let (azimuth, elevation) = (number(azimuth)?, number(elevation)?);
        if !(-90.0..=90.0).contains(&elevation) || !(-360.0..=360.0).contains(&azimuth) {
            return Err(wrong());
        }
        Ok(Self::Angles { azimuth: azimuth.to_radians(), elevation: elevation.to_radians() })
    }
}

/// The projection.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Lens {
    /// Focal length on a 36 mm by 24 mm sensor, millimetres; its 24 mm span the height of the picture.
    Millimetres(f32),
    /// Parallel projection, drawn as large as the default lens draws what stands at the target.
    Orthographic,
}

impl Default for Lens {
    fn default() -> Self {
        Self::Millimetres(85.0)
    }
}

/// A word that names no lens.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("`{0}` is no lens; say a focal length from 10 to 1000 in millimetres, or ortho")]
pub struct LensError(String);

impl FromStr for Lens {
    type Err = LensError;

    fn from_str(text: &str) -> Result<Self, LensError> {
        if text == "ortho" {
            return Ok(Self::Orthographic);
        }
        let focal = text.trim_end_matches("mm").parse::<f32>().ok().filter(|v| (10.0..=1000.0).contains(v));
        focal.map(Self::Millimetres).ok_or_else(|| LensError(text.to_owned()))
    }
}

impl Lens {
    /// Tangent of half the vertical angle of view; for a parallel projection that of the lens it imitates.
    fn half_height(self) -> f32 {
        let focal = match self {
            Self::Millimetres(focal) => focal,
            Self::Orthographic => 85.0,
        };
        12.0 / focal
    }
}

/// A camera in the world, and how the head is carried in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Around the vertical, radians.
    pub azimuth: f32,
    /// Above the horizontal, radians, within a quarter turn.
    pub elevation: f32,
    /// How far the nose points below the horizontal, radians.
    pub pitch: f32,
    /// The point in the middle of the picture, metres, world.
    pub target: Vec3,
    /// From the target, metres.
    pub distance: f32,
    /// The projection.
    pub lens: Lens,
}

impl Camera {
    /// A camera at a view, not yet placed: see [`Camera::fit`].
    pub fn at(view: View, pitch: Option<f32>, lens: Lens) -> Self {
        let (azimuth, elevation) = view.angles();
        let pitch = pitch.unwrap_or_else(|| view.pitch());
        Self { azimuth, elevation, pitch, target: Vec3::ZERO, distance: 1.0, lens }
    }

    /// Right, up and backward (towards the camera), unit, world.
    pub fn axes_in_world(&self) -> [Vec3; 3] {
        let (sa, ca) = ops::sin_cos(self.azimuth);
        let (se, ce) = ops::sin_cos(self.elevation);
        let right = Vec3::new(ca, 0.0, -sa);
        let back = Vec3::new(sa * ce, se, ca * ce);
        [right, back.cross(right), back]
    }

    /// Carries directions and points of the head into the world.
    pub fn world_from_head(&self) -> Mat3 {
        let (s, c) = ops::sin_cos(self.pitch);
        Mat3::from_cols(Vec3::X, Vec3::new(0.0, c, s), Vec3::new(0.0, -s, c))
    }

    /// Moves target and distance so that every point (metres, head) is in a picture of this aspect (width over
    /// height), in its middle, with `margin` (a part of the picture, 0 to 0.9) left free around it. No points: no move.
    pub fn fit<'a>(&mut self, points: impl Iterator<Item = &'a Vec3> + Clone, aspect: f32, margin: f32) {
        let [right, up, back] = self.axes_in_world();
        let view_from_head = Mat3::from_cols(right, up, back).transpose() * self.world_from_head();
        let seen = points.map(move |&p| view_from_head * p);
        let (low, high) = seen.clone().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)));
        if !(low.is_finite() && high.is_finite()) {
            return;
        }
        let tangent = self.lens.half_height() * (1.0 - margin);
        let tangents = Vec2::new(tangent * aspect, tangent);
        let mut middle = (low + high) * 0.5;
        let mut distance = 0.0;
        // Perspective widens what is near, so that the middle of the extents is not the middle of the picture.
        for _ in 0..3 {
            distance = seen.clone().map(|p| self.needed_distance(p - middle, tangents)).fold(1e-3, f32::max);
            if self.lens == Lens::Orthographic {
                break;
            }
            let project = |p: Vec3| (p - middle).truncate() / (distance - (p.z - middle.z)).max(1e-4);
            let (lo, hi) = seen
                .clone()
                .map(project)
                .fold((Vec2::INFINITY, Vec2::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)));
            middle += ((lo + hi) * 0.5 * distance).extend(0.0);
        }
        self.target = Mat3::from_cols(right, up, back) * middle;
        self.distance = distance;
    }

    /// As [`fit`](Self::fit), for a camera that goes round the vertical through the middle of the points: where they are all in
    /// the picture from everywhere.
    pub fn fit_round<'a>(&mut self, points: impl Iterator<Item = &'a Vec3> + Clone, aspect: f32, margin: f32) {
        const DIRECTIONS: usize = 48;
        let carried = self.world_from_head();
        let stood = points.map(move |&p| carried * p);
        let (low, high) = stood.clone().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(l, h), p| (l.min(p), h.max(p)));
        if !(low.is_finite() && high.is_finite()) {
            return;
        }
        self.target = (low + high) * 0.5;
        let tangent = self.lens.half_height() * (1.0 - margin);
        let tangents = Vec2::new(tangent * aspect, tangent);
        let round = (0..DIRECTIONS).map(|k| {
            let turned = Self { azimuth: std::f32::consts::TAU * k as f32 / DIRECTIONS as f32, ..*self };
            let [right, up, back] = turned.axes_in_world();
            let seen = Mat3::from_cols(right, up, back).transpose();
            stood.clone().map(|p| self.needed_distance(seen * (p - self.target), tangents)).fold(1e-3, f32::max)
        });
        self.distance = round.fold(1e-3, f32::max);
    }

    /// Where a point (metres, head) comes to lie in a picture of that size: pixels from its top left corner, rightwards and
    /// downwards; may lie outside.
    pub fn pixel(&self, point: Vec3, [width, height]: [u32; 2]) -> Vec2 {
        let size = Vec2::new(width as f32, height as f32);
        // The planes of the nearest and farthest do not move a pixel.
        let clip = self.clip_from_head(size.x / size.y, 1.0).project_point3(point);
        Vec2::new((clip.x + 1.0) * 0.5, (1.0 - clip.y) * 0.5) * size
    }

    /// Puts a point (metres, head) into the middle of the picture; the camera keeps its direction and distance.
    pub fn look_at(&mut self, point: Vec3) {
        self.target = self.world_from_head() * point;
    }

    /// Draws everything so many times larger: a longer lens, which leaves the perspective as it is.
    pub fn zoom(&mut self, times: f32) {
        match &mut self.lens {
            Lens::Millimetres(focal) => *focal *= times,
            Lens::Orthographic => self.distance /= times,
        }
    }

    /// The distance from which a point, relative to the target in view axes, is just inside the tangents.
    fn needed_distance(&self, p: Vec3, tangents: Vec2) -> f32 {
        let across = (p.x.abs() / tangents.x).max(p.y.abs() / tangents.y);
        match self.lens {
            Lens::Millimetres(_) => p.z + across,
            Lens::Orthographic => across,
        }
    }

    /// Eye point (metres, head) and 1 for a perspective; direction towards the camera and 0 for a parallel projection.
    pub fn eye_in_head(&self) -> (Vec3, f32) {
        let head_from_world = self.world_from_head().transpose();
        let [_, _, back] = self.axes_in_world();
        match self.lens {
            Lens::Millimetres(_) => (head_from_world * (self.target + back * self.distance), 1.0),
            Lens::Orthographic => (head_from_world * back, 0.0),
        }
    }

    /// Clip space of wgpu (y up, depth 0 to 1) from the head. `radius`: of a sphere around the target that holds all
    /// that is drawn, metres.
    pub fn clip_from_head(&self, aspect: f32, radius: f32) -> Mat4 {
        let [right, up, back] = self.axes_in_world();
        let view_from_world = Mat4::from_mat3(Mat3::from_cols(right, up, back).transpose())
            * Mat4::from_translation(-(self.target + back * self.distance));
        let far = self.distance + radius;
        let near = (self.distance - radius).max(far * 1e-3);
        let half = self.lens.half_height();
        let clip_from_view = match self.lens {
            Lens::Millimetres(_) => {
                glam::camera::rh::proj::directx::perspective(2.0 * ops::atan2(half, 1.0), aspect, near, far)
            }
            Lens::Orthographic => {
                let (h, w) = (half * self.distance, half * self.distance * aspect);
                glam::camera::rh::proj::directx::orthographic(-w, w, -h, h, self.distance - radius, far)
            }
        };
        clip_from_view * view_from_world * Mat4::from_mat3(self.world_from_head())
    }

    /// Metres at the target that one picture height spans.
    pub fn height_at_target(&self) -> f32 {
        2.0 * self.lens.half_height() * self.distance
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn side_view_shows_the_nose_on_the_left_of_the_picture() {
        let camera = Camera::at(View::Side, None, Lens::default());
        let [right, up, back] = camera.axes_in_world();
        assert!((back - Vec3::X).length() < 1e-6);
        assert!(right.dot(Vec3::Z) < -0.999);
        assert!((up - Vec3::Y).length() < 1e-6);
    }

    #[test]
    fn positive_pitch_lowers_the_nose() {
        let camera = Camera::at(View::Front, None, Lens::default());
        assert!((camera.world_from_head() * Vec3::Z).y < -0.3);
    }

    #[test]
    fn fitted_points_are_inside_the_picture_and_touch_it() {
        let points: Vec<Vec3> =
            (0..50).map(|i| Vec3::new((i % 7) as f32, (i % 5) as f32, (i % 11) as f32) * 0.02).collect();
        for lens in [Lens::default(), Lens::Millimetres(28.0), Lens::Orthographic] {
            for view in View::NAMED {
                let mut camera = Camera::at(view, None, lens);
                camera.fit(points.iter(), 1.5, 0.1);
                let clip = camera.clip_from_head(1.5, 1.0);
                let most =
                    points.iter().map(|&p| clip.project_point3(p).truncate().abs().max_element()).fold(0.0, f32::max);
                assert!((0.85..0.93).contains(&most), "{view:?} {lens:?}: {most}");
            }
        }
    }

    #[test]
    fn a_camera_that_goes_round_loses_a_point_or_stands_too_far() {
        let points = [Vec3::new(0.1, 0.0, 0.0), Vec3::new(0.0, 0.2, 0.3), Vec3::new(-0.1, -0.1, -0.05)];
        for lens in [Lens::default(), Lens::Orthographic] {
            let mut camera = Camera::at(View::Portrait, None, lens);
            camera.fit_round(points.iter(), 1.0, 0.1);
            let mut most = 0.0_f32;
            for degrees in 0..360 {
                camera.azimuth = (degrees as f32).to_radians();
                let clip = camera.clip_from_head(1.0, 1.0);
                let outermost = points.iter().map(|&p| clip.project_point3(p).truncate().abs().max_element());
                most = outermost.fold(most, f32::max);
            }
            assert!((0.85..0.93).contains(&most), "{lens:?}: {most}");
        }
    }

    #[test]
    fn views_and_lenses_read_what_they_write() {
        for view in View::NAMED {
            assert_eq!(view.name().parse::<View>().unwrap(), view);
        }
        assert!("30,10".parse::<View>().is_ok());
        assert!("30".parse::<View>().is_err());
        assert!("0,95".parse::<View>().is_err());
        assert!("nan,0".parse::<View>().is_err());
        assert_eq!("85".parse::<Lens>().unwrap(), Lens::Millimetres(85.0));
        assert!("0".parse::<Lens>().is_err());
    }
}
