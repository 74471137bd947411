//! Stations of the two midlines and a few guides at the sides, found on the surface from outside.

use super::{Pins, Ray, orbit_axes, sin_cos};
use crate::rig::implicit::Layer;
use glam::{Vec3, vec3};

/// Parts of the way from the nose pad's upper edge to the nasion, rings 1 to 8.
const MUZZLE: [f32; 8] = [0.12, 0.235, 0.355, 0.48, 0.61, 0.735, 0.85, 0.965];
/// Parts of the cranial length behind the nasion, rings 9 to 16.
const CRANIUM: [f32; 8] = [0.07, 0.168, 0.27, 0.375, 0.49, 0.62, 0.76, 0.90];
/// Head units along the neck's axis where it ends, ring 19.
const NECK: f32 = 7.8;
/// For the neck's columns 0 to 8: how much they start from the height of the crest instead of the rear of the ear's base,
/// and how much from neither.
const COLUMN: [[f32; 2]; 9] =
    [[1.0, 0.0], [0.75, 0.0], [0.35, 0.0], [0.1, 0.0], [0.0, 0.0], [0.0, 0.35], [0.0, 0.75], [0.0, 1.0], [0.0, 1.0]];
/// Degrees below forward of the chin's fan.
const CHIN_FAN: [f32; 4] = [14.0, 36.0, 56.0, 74.0];

pub(super) fn place(pins: &mut Pins) {
    dorsal(pins);
    ventral(pins);
    sides(pins);
}

fn dorsal(pins: &mut Pins) {
    let mut rays = pins.rays();
    let s = pins.shape;
    let h = pins.handles;
    let edge = s.muzzle_from_head(pins.at[h.s[0][0] as usize]).z;
    for (k, f) in MUZZLE.into_iter().enumerate() {
        let z = edge * (1.0 - f);
        let from = s.head_from_muzzle(vec3(0.0, s.bridge0() + 3.5, z));
        let down = s.head_from_muzzle(Vec3::NEG_Y);
        rays.push(Ray::new(h.s[1 + k][0], from, down, Layer::Upper));
    }
    for (k, f) in CRANIUM.into_iter().enumerate() {
        let from = vec3(0.0, s.cran_h + 2.5 + s.dome.max(0.0), -f * s.cran_len);
        rays.push(Ray::new(h.s[9 + k][0], from, Vec3::NEG_Y, Layer::Whole));
    }
    // Philtrum: from the nose pad down to the lip.
    let (top, lip) = (pins.at[h.s[0][9] as usize], pins.at[h.s[3][9] as usize]);
    for i in 1..3 {
        let t = i as f32 / 3.0;
        let p = top + (lip - top) * t;
        let forward = s.head_from_muzzle(Vec3::Z);
        rays.push(Ray::new(h.s[i][9], p + forward * 2.0, -forward, Layer::Upper));
    }
    let (start, dir) = s.neck_axis();
    let up = vec3(0.0, -dir.z, dir.y);
    pins.trace(&mut rays);
    let crest = (pins.at[h.s[16][0] as usize] - start).dot(dir);
    for (i, part) in [(17, 0.62), (18, 0.82), (19, 1.0)] {
        let c = start + dir * (crest + (NECK - crest) * part);
        rays.push(Ray::new(h.s[i][0], c + up * s.neck_d, -up, Layer::Whole));
    }
    pins.keep(rays);
}

fn ventral(pins: &mut Pins) {
    let mut rays = pins.rays();
    let s = pins.shape;
    let h = pins.handles;
    let jz = s.jaw_z();
    let root = vec3(0.0, s.lip1() - 0.18 * s.jaw_d, jz - 1.75);
    for (k, degrees) in CHIN_FAN.into_iter().enumerate() {
        let (sin, cos) = sin_cos(degrees.to_radians());
        let out = vec3(0.0, -sin, cos);
        let (from, out) = (s.head_from_muzzle(root + out * 5.0), s.head_from_muzzle(out));
        rays.push(Ray::new(h.l[3][10 + k], from, -out, Layer::Lower));
    }
    let back = (jz - 4.95).min(0.6);
    let up = s.head_from_muzzle(Vec3::Y);
    for i in 3..11 {
        let t = (i - 3) as f32 / 7.0;
        let z = jz - 1.75 + (back - (jz - 1.75)) * t;
        let from = s.head_from_muzzle(vec3(0.0, s.lip0() - 1.5 * s.jaw_d - 4.0, z));
        rays.push(Ray::new(h.l[i][14], from, up, Layer::Lower));
    }
    pins.trace(&mut rays);
    // From the jaw's root to the end of the neck, at even steps, across the throat.
    let (start, dir) = s.neck_axis();
    let below = vec3(0.0, dir.z, -dir.y);
    let from = pins.at[h.l[10][14] as usize];
    let end = start + dir * NECK + below * (0.5 * s.neck_d);
    rays.push(Ray::new(h.l[19][14], start + dir * NECK + below * s.neck_d, -below, Layer::Whole));
    for i in 11..19 {
        let t = (i - 10) as f32 / 9.0;
        let p = from + (end - from) * t;
        let out = (Vec3::NEG_Y * (1.0 - t) + below * t).normalize_or_zero();
        rays.push(Ray::new(h.l[i][14], p + out * 6.0, -out, Layer::Whole));
    }
    pins.keep(rays);
}

/// Guides: they shape the start of the fit and are free afterwards.
fn sides(pins: &mut Pins) {
    let mut rays = pins.rays();
    let s = pins.shape;
    let h = pins.handles;
    let cl = s.cran_len;
    let from_side = |rays: &mut Vec<Ray>, v: u16, y: f32, z: f32, layer: Layer| {
        let p = s.head_from_muzzle(vec3(16.0, y, z));
        rays.push(Ray::guide(v, p, Vec3::NEG_X, layer));
    };
    let edge = s.muzzle_from_head(pins.at[h.s[0][0] as usize]).z;
    for (i, f) in [(2, 0.24), (4, 0.42), (6, 0.66)] {
        let z = edge * (1.0 - f);
        let t = f * 0.9;
        let mid = 0.5 * (s.bridge1() + s.lip1()) * (1.0 - t) + 0.5 * (s.bridge0() + s.lip0()) * t;
        from_side(&mut rays, h.s[i][6], mid, z, Layer::Upper);
        // And over the edge between bridge and side.
        let edge_at = s.head_from_muzzle(vec3(7.0, mid + 7.5, z + 0.3));
        let inwards = s.head_from_muzzle(vec3(-0.68, -0.73, 0.0));
        rays.push(Ray::guide(h.s[i][3], edge_at, inwards, Layer::Upper));
    }
    for (v, y, z) in [
        (h.s[11][6], s.zyg_y + 0.2, -0.20 * cl),
        (h.s[12][6], s.zyg_y, -0.33 * cl),
        (h.s[13][6], s.zyg_y, -0.46 * cl),
        (h.s[12][8], s.zyg_y - 2.2, -0.30 * cl),
        (h.s[14][8], s.zyg_y - 2.0, -0.55 * cl),
        (h.s[12][3], 0.3 * s.cran_h, -0.35 * cl),
    ] {
        let p = vec3(16.0, y, z);
        rays.push(Ray::guide(v, p, Vec3::NEG_X, Layer::Whole));
    }
    // The hollow between muzzle and cheek, where the surface turns twice, and the throat's sides.
    let hollow = s.head_from_muzzle(vec3(16.0, 0.45 * s.bridge0() + 0.55 * s.lip0(), 0.16 * edge));
    rays.push(Ray::guide(h.s[7][5], hollow, Vec3::NEG_X, Layer::Upper));
    pins.trace(&mut rays);
    eye_hollow(pins, &mut rays);
    for i in [12, 14, 16] {
        let below = pins.at[h.l[i][14] as usize];
        let from = below + vec3(9.0, -4.0, 0.0);
        rays.push(Ray::guide(h.l[i][12], from, vec3(-0.78, 0.62, 0.0), Layer::Whole));
    }
    for i in [8, 10] {
        let z = s.muzzle_from_head(pins.at[h.l[i][14] as usize]).z + 0.6;
        from_side(&mut rays, h.l[i][11], s.lip0() - 0.6 * s.jaw_d, z, Layer::Lower);
    }
    // Round the neck: its end is cut flat, the ring before it only guided.
    let (start, dir) = s.neck_axis();
    let along = |v: u16| (pins.at[v as usize] - start).dot(dir);
    let base = h.ear_base.iter().map(|&v| along(v)).fold(f32::NEG_INFINITY, f32::max);
    let nape = along(h.s[16][0]);
    let up = vec3(0.0, -dir.z, dir.y);
    for j in 1..14 {
        let (sin, cos) = sin_cos(core::f32::consts::PI * j as f32 / 14.0);
        let out = up * cos + Vec3::X * sin;
        let reach = s.neck_d.max(s.neck_w);
        let v = if j < 10 { h.s[19][j] } else { h.l[19][j] };
        rays.push(Ray::new(v, start + dir * NECK + out * reach, -out, Layer::Whole));
        // Between the ear's base, or the crest, and the end; below the ear behind the jaw.
        let [crest, side] = COLUMN.get(j).copied().unwrap_or([0.0, 1.0]);
        let behind = base + (nape - base) * crest;
        let between = |part: f32, below: f32| {
            let d = behind + (NECK - behind) * part;
            start + dir * (d + (below - d) * side) + out * reach
        };
        if j < 9 {
            rays.push(Ray::new(h.s[17][j], between(0.32, 3.6 + 0.2 * (1.0 - cos)), -out, Layer::Whole));
        }
        if j % 3 == 2 {
            let v = if j < 10 { h.s[18][j] } else { h.l[18][j] };
            rays.push(Ray::guide(v, between(0.66, 5.6), -out, Layer::Whole));
        }
    }
    pins.keep(rays);
}

/// The hollow between bridge, stop and eye, where the nearest point of the surface jumps from one side to the other: steps
/// from the bridge towards the muzzle's edge before the eye, seen from before and above, where no part of it hides another,
/// and the orbit's loop between those and the lids. The parts of the way are those at which the skin of all breeds, and of
/// blends of them, bends least.
fn eye_hollow(pins: &mut Pins, rays: &mut Vec<Ray>) {
    let s = pins.shape;
    let h = pins.handles;
    let at = |v: u16| pins.at[v as usize];
    let (ridge, nasion) = (at(h.s[7][0]), at(h.s[8][0]));
    let edge = at(h.of[0]).lerp(at(h.s[6][3]), 0.73);
    let across = |t: f32| ridge.lerp(edge, t);
    for (j, t) in [(1, 0.27), (2, 0.6), (3, 0.815), (4, 0.975)] {
        let p = across(t);
        let out = vec3(0.15 * p.x, 0.75, 0.55).normalize_or_zero();
        rays.push(Ray::new(h.s[7][j], p + out * 2.5, -out, Layer::Upper));
    }
    let [_, _, gaze] = orbit_axes(s);
    let around = |k: usize| {
        let fold = at(h.of[k]);
        let out = (fold - s.eye()).reject_from(gaze).normalize_or_zero();
        fold + out * (0.35 * s.eye_r).min(0.42 * fold.x)
    };
    let brow = around(2).lerp(nasion, 0.57);
    let medial = at(h.of[1]).lerp(across(0.6).lerp(brow, 0.62), 0.76);
    let corner = around(0).lerp(across(0.815), 0.38);
    let below = around(11).lerp(at(h.s[7][5]), 0.35);
    for (v, p) in [
        (h.orbit[11], below),
        (h.orbit[0], corner),
        (h.orbit[1], medial),
        (h.orbit[2], brow),
        (h.s[8][1], nasion.lerp(brow, 0.5)),
    ] {
        let on_skin = pins.surface.project(p, Layer::Upper, 4);
        pins.set(v, on_skin);
    }
    pins.trace(rays);
}
