//! An eyeball's colours: pupil, iris with its fibres and the dark ring at its rim, the white; and the lids' shadow on them.

use super::{filled, smoothstep};
use crate::anatomy::colour::to_srgb8;
use crate::frame::Eyeball;
use crate::math::{noise, ops};
use glam::{Vec2, Vec3, vec2, vec3};

/// Samples of a texel's side.
const SAMPLES: usize = 2;
/// How much brighter an iris is for the light that the cornea gathers on it.
const GATHERED: f32 = 1.3;

/// The picture, for both eyes alike: their irises are the same, and the shadow is the mean of this eye's and its mirror image.
pub(super) fn paint(eyeball: &Eyeball, size: u32, threads: usize) -> Vec<[u8; 3]> {
    filled(size, threads, |x, y| {
        let mut sum = Vec3::ZERO;
        for (i, j) in (0..SAMPLES).flat_map(|j| (0..SAMPLES).map(move |i| (i, j))) {
            let offset = vec2(i as f32 + 0.5, j as f32 + 0.5) / SAMPLES as f32;
            sum += colour(eyeball, (vec2(x as f32, y as f32) + offset) / size as f32);
        }
        to_srgb8(sum / (SAMPLES * SAMPLES) as f32)
    })
}

fn colour(eyeball: &Eyeball, place: Vec2) -> Vec3 {
    let (direction, angle) = eyeball.on_texture(place);
    let vessels = grain(vec3(direction.x * 14.0, direction.y * 60.0, direction.z * 9.0)).x;
    let red = smoothstep(0.58, 0.72, vessels) * smoothstep(1.15, 1.6, angle);
    // None where no eye is so wide open.
    let red = red * smoothstep(2.2, 1.9, angle);
    let white = vec3(0.13, 0.080, 0.062).lerp(vec3(0.52, 0.44, 0.39), smoothstep(1.0, 1.75, angle));
    let white = white * Vec3::ONE.lerp(vec3(0.95, 0.55, 0.48), red);
    // The circle in which the iris lies, its rim at 1.
    let disk = direction.truncate().normalize_or_zero() * angle.min(1.0);
    let pupil = smoothstep(Eyeball::PUPIL + 0.03, Eyeball::PUPIL - 0.03, angle);
    let inside = iris(eyeball.iris, disk, angle.min(1.0)).lerp(vec3(0.0022, 0.0018, 0.0016), pupil);
    let through = smoothstep(1.05, 0.93, angle);
    let mirrored = vec3(-direction.x, direction.y, direction.z);
    let shadow = 0.5 * (shadow(eyeball, direction) + shadow(eyeball, mirrored));
    white.lerp(inside, through) * shadow
}

/// The iris at a place of its disk, `r` from the middle: fibres from the collarette outwards and inwards, hollows between them,
/// and the dark ring at the rim.
fn iris(colour: Vec3, place: Vec2, r: f32) -> Vec3 {
    let turn = place / place.length().max(1e-4);
    let wander = grain((turn * 4.0 + 7.0).extend(r * 2.5)).x - 0.5;
    let bent = turn + turn.perp() * wander * 0.09;
    let coarse = grain((bent * 15.0 + 20.0).extend(r * 2.2));
    let fine = grain((bent * 36.0 + 31.0).extend(r * 3.5));
    let middle = grain((turn * 6.0).extend(3.0)).y - 0.5;
    let collarette = Eyeball::PUPIL + 0.27 * (1.0 - Eyeball::PUPIL) + 0.10 * middle;
    let outer = smoothstep(collarette - 0.04, collarette + 0.03, r);
    let fibres = (coarse.x - 0.5) * 1.1 + (fine.x - 0.5) * 0.8;
    let hollow = smoothstep(0.56, 0.75, coarse.z) * outer * smoothstep(0.92, 0.75, r);
    let off_ridge = (r - collarette) / 0.035;
    let ridge = ops::exp(-off_ridge * off_ridge);
    let mut shade = vec3(0.62, 0.54, 0.50).lerp(Vec3::ONE, outer);
    shade *= 1.0 + fibres * (0.55 + 0.45 * outer) + 0.40 * ridge - 0.45 * hollow;
    shade *= 1.0 - 0.84 * smoothstep(0.76, 1.0, r);
    (colour * shade.max(Vec3::splat(0.05)) * GATHERED).min(Vec3::ONE)
}

/// What the lids and the lashes of the upper one leave of the light, in a direction of the eye's own axes.
fn shadow(eyeball: &Eyeball, direction: Vec3) -> f32 {
    let place = direction.truncate() / (1.0 + direction.z.max(-0.5));
    let away = from_lids(&eyeball.lids, place);
    let millimetres = away.length() * 2000.0 * eyeball.eye.radius / (1.0 + place.length_squared());
    let upper = smoothstep(-0.3, 0.6, -away.y / away.length().max(1e-5));
    (1.0 - 0.70 * ops::exp(-millimetres / 0.55)) * (1.0 - 0.62 * upper * ops::exp(-millimetres / 2.2))
}

/// From the nearest point of the opening to a place in its plane.
fn from_lids(lids: &[Vec2; 12], place: Vec2) -> Vec2 {
    let mut nearest = Vec2::splat(9.0);
    for (i, &end) in lids.iter().enumerate() {
        let start = lids[(i + 11) % 12];
        let edge = end - start;
        let along = ((place - start).dot(edge) / edge.length_squared().max(1e-9)).clamp(0.0, 1.0);
        let offset = place - start - edge * along;
        if offset.length_squared() < nearest.length_squared() {
            nearest = offset;
        }
    }
    nearest
}

/// Three channels of smooth noise, 0 to 1, about one blob a unit.
fn grain(place: Vec3) -> Vec3 {
    noise::smooth(place, 21) * 0.5 + 0.5
}
