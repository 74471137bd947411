//! The curve on which the teeth of a jaw stand, from the middle of its front to behind the last tooth and on to the end of
//! the palate, as ribs: each from outside the teeth to the median plane.

use crate::math::ops;
use crate::rig::bone::Targets;
use crate::rig::bone::teeth::{self, SUNK, Seat};
use glam::{Vec3, vec3};

/// Ribs in front of the canine, between it and the last tooth, and behind.
pub(super) const PARTS: [usize; 3] = [9, 41, 8];
/// Number of ribs.
pub(super) const RIBS: usize = PARTS[0] + PARTS[1] + PARTS[2] + 1;

/// How far bone goes outwards, canonical millimetres: beyond the landmarks of the upper jaw, beyond the necks of the lower
/// teeth.
const BONE: [f32; 2] = [1.9, 1.0];

/// One place of the arch. Lengths in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rib {
    /// Middle of the teeth's necks, left half.
    pub neck: Vec3,
    /// Where the rib ends in the median plane, at the height of the necks.
    pub middle: Vec3,
    /// Unit, horizontal, away from the tongue.
    pub outwards: Vec3,
    /// From the necks' middle to the outer and the inner side of the teeth.
    pub half: f32,
    /// From the necks' middle to the outer side of the bone.
    pub bone: f32,
    /// From the necks to the gum's margin, towards the teeth's tips.
    pub margin: f32,
}

impl Rib {
    /// From the necks' middle to the gum's margins.
    pub(super) fn edge(&self, unit: f32) -> f32 {
        self.half + 0.7 * unit
    }
}

/// One jaw's arch.
#[derive(Clone, Debug)]
pub struct Arch {
    /// From the middle of the front backwards.
    pub ribs: Vec<Rib>,
    /// -1 above, where teeth grow down, 1 below.
    pub up: f32,
}

impl Arch {
    /// The arch of a head with these landmarks (metres, head's frame).
    pub fn new(t: &Targets<Vec3>, upper: bool) -> Arch {
        let unit = teeth::unit(t);
        let seats = teeth::seats(t, upper);
        let up = if upper { -1.0 } else { 1.0 };
        // A place for each tooth: where, half width, bone, margin.
        let mut places: Vec<(Vec3, [f32; 3])> = Vec::with_capacity(seats.len() + 2);
        for seat in &seats {
            // Where bone is higher the gum goes over it (`gums`).
            let margin = (0.5 * seat.size.z).clamp((SUNK - 1.0) * unit, (SUNK - 0.2) * unit);
            let half = 0.5 * seat.size.y;
            let bone = if upper { seat.inset + BONE[0] * unit } else { half + BONE[1] * unit };
            places.push((seat.root, [half, bone, margin]));
        }
        let (first, last) = (places[0], places[places.len() - 1]);
        let front = vec3(0.0, first.0.y, first.0.z + 0.3 * (first.0.z - places[1].0.z).max(0.0));
        places.insert(0, (front, first.1));
        // Behind the last tooth the gum ends; the palate and the floor go on to the end of the hard palate.
        let end = vec3(0.8 * last.0.x, last.0.y, t.staphylion.z.min(last.0.z - 8.0 * unit));
        let thin = [0.5 * last.1[0], 0.5 * last.1[0] + 2.0 * unit, (SUNK + 0.6) * unit];
        places.push((end, thin));
        let mut ribs = sampled(&places, &[0, 4, seats.len(), seats.len() + 1]);
        smooth(&mut ribs);
        let n = ribs.len();
        for k in 0..n {
            let tangent = ribs[(k + 1).min(n - 1)].neck - ribs[k.saturating_sub(1)].neck;
            let out = vec3(-tangent.z, 0.0, tangent.x).normalize_or(Vec3::X);
            ribs[k].outwards = if k == 0 { Vec3::Z } else { out };
        }
        for _ in 0..2 {
            let before: Vec<Vec3> = ribs.iter().map(|r| r.outwards).collect();
            for k in 1..n - 1 {
                ribs[k].outwards = (before[k - 1] + 2.0 * before[k] + before[k + 1]).normalize_or(before[k]);
            }
        }
        hold(&mut ribs, &seats);
        middles(&mut ribs);
        Arch { ribs, up }
    }

    /// Where a rib's gum begins towards the tongue, at the height of the necks.
    pub(super) fn inner(&self, rib: &Rib, unit: f32) -> Vec3 {
        let way = rib.middle - rib.neck;
        rib.neck + way.normalize_or(-rib.outwards) * rib.edge(unit).min(0.55 * way.length())
    }

    /// Height of the bone's rim at a distance along the head, straight between ribs and level beyond them.
    pub fn rim(&self, z: f32, unit: f32) -> f32 {
        let n = self.ribs.len();
        let k = self.ribs.iter().position(|r| r.neck.z <= z).unwrap_or(n);
        let y = match k {
            0 => self.ribs[0].neck.y,
            _ if k == n => self.ribs[n - 1].neck.y,
            _ => {
                let (a, b) = (self.ribs[k - 1].neck, self.ribs[k].neck);
                a.y + (b.y - a.y) * ((a.z - z) / (a.z - b.z).max(1e-6)).clamp(0.0, 1.0)
            }
        };
        y + self.up * SUNK * unit
    }
}

/// Ribs at even distances between the places that begin and end the parts.
fn sampled(places: &[(Vec3, [f32; 3])], ends: &[usize; 4]) -> Vec<Rib> {
    let mut ribs = Vec::with_capacity(RIBS);
    for (part, &n) in PARTS.iter().enumerate() {
        let own = &places[ends[part]..=ends[part + 1]];
        let lengths: Vec<f32> = own.windows(2).map(|w| w[0].0.distance(w[1].0)).collect();
        let total: f32 = lengths.iter().sum();
        let last = usize::from(part + 1 == PARTS.len());
        for i in 0..n + last {
            let mut left = total * i as f32 / n as f32;
            let mut k = 0;
            while k + 1 < lengths.len() && left > lengths[k] {
                left -= lengths[k];
                k += 1;
            }
            let t = (left / lengths[k].max(1e-9)).clamp(0.0, 1.0);
            let mix = |c: usize| own[k].1[c] + t * (own[k + 1].1[c] - own[k].1[c]);
            let neck = own[k].0.lerp(own[k + 1].0, t);
            ribs.push(Rib { neck, half: mix(0), bone: mix(1), margin: mix(2), ..Rib::default() });
        }
    }
    ribs
}

/// Rounds the corners of the polygon through the teeth; the first rib stays in the median plane.
fn smooth(ribs: &mut [Rib]) {
    for _ in 0..2 {
        let before = ribs.to_vec();
        for k in 1..ribs.len() - 1 {
            let (a, b, c) = (before[k - 1], before[k], before[k + 1]);
            let mean = |x: f32, y: f32, z: f32| 0.25 * (x + 2.0 * y + z);
            ribs[k].neck = 0.25 * (a.neck + 2.0 * b.neck + c.neck);
            ribs[k].half = mean(a.half, b.half, c.half).max(b.half);
            ribs[k].bone = mean(a.bone, b.bone, c.bone);
            ribs[k].margin = mean(a.margin, b.margin, c.margin);
        }
    }
}

/// Widens ribs to hold the teeth beside them: crowns that are turned are wider across the arch.
fn hold(ribs: &mut [Rib], seats: &[Seat]) {
    let wanted: Vec<f32> = ribs
        .iter()
        .map(|rib| {
            let extent = |seat: &Seat| {
                let [along, across, _] = seat.axes;
                let reach = |way: Vec3| {
                    let (u, v) = (0.5 * seat.size.x * along.dot(way), 0.5 * seat.size.y * across.dot(way));
                    ops::sqrt(u * u + v * v)
                };
                let off = seat.root - rib.neck;
                let beside = off.dot(vec3(rib.outwards.z, 0.0, -rib.outwards.x)).abs();
                let extent = off.dot(rib.outwards).abs() + reach(rib.outwards);
                // A tooth a little farther along counts too, since ribs stand apart.
                let along = reach(vec3(rib.outwards.z, 0.0, -rib.outwards.x));
                let own = off.dot(rib.outwards).abs() < reach(rib.outwards);
                if own && beside < 1.15 * along { extent } else { 0.0 }
            };
            seats.iter().map(extent).fold(rib.half, f32::max)
        })
        .collect();
    for (k, rib) in ribs.iter_mut().enumerate() {
        let (before, after) = (wanted[k.saturating_sub(1)], wanted[(k + 1).min(wanted.len() - 1)]);
        rib.half = wanted[k].max(0.25 * (before + 2.0 * wanted[k] + after));
    }
}

/// Where ribs meet the median plane: behind the incisors they lean back, from the canine on they bow forwards a little.
fn middles(ribs: &mut [Rib]) {
    let n = ribs.len();
    let (front, back) = (ribs[0].neck.z, ribs[n - 1].neck.z);
    let canine = ribs[PARTS[0]].neck.z;
    let first = front - 0.45 * (front - canine).max(0.05 * (front - back));
    // Even steps from there: a fan that never crosses itself.
    let mut z = first;
    for (k, rib) in ribs.iter_mut().enumerate() {
        let bow = 0.03 * (front - back) * (1.0 - k as f32 / (n - 1) as f32);
        let wanted = if k <= PARTS[0] {
            let t = k as f32 / PARTS[0] as f32;
            first + t * (canine + bow - first).min(-0.02 * (front - back))
        } else {
            rib.neck.z + bow
        };
        z = if k == 0 { first } else { wanted.min(z - 0.002 * (front - back)) };
        rib.middle = vec3(0.0, rib.neck.y, z);
    }
}
