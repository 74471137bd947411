//! Ears that move: the base glides over the temple, and the leather turns with it ring by ring, two joints to an ear.
//!
//! A pricked ear goes as a whole. Of one that hangs the part up to its fold goes, and the leather behind the fold hangs on,
//! from wherever its fold is now; both lie on the head where they would go through it.

use super::zones::{Neighbours, fade, smoothstep};
use crate::motion::{Channel, Pose};
use crate::rig::Proportions;
use crate::rig::handles::{EAR_RINGS, Handles};
use crate::rig::implicit::{Implicit, Layer};
use glam::{Mat3, Vec3, vec3};

/// How far the skin around the base goes along, head units of the base head.
const REACH: f32 = 2.6;
/// Part of the base's glide that the hole in the skin makes, and the first ring of leather.
const GLIDE: [f32; 2] = [0.7, 1.0];
/// Part of the turns that each ring from the base makes.
const RAMP: [f32; EAR_RINGS + 1] = [0.2, 0.55, 0.85, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0];
/// Part of the turns of an ear that hangs, and of its leather behind the fold.
const HANGING: [f32; 2] = [0.4, 0.35];
/// How much narrower leather is that lies back: its edges close over the opening (Bremhorst et al. 2019 on the flattener).
const NARROWED: f32 = 0.45;
/// How far the edges come forwards for what they come together.
const CURLED: f32 = 0.6;
/// Between leather and head at least where the leather came nearer, head units.
const CLEAR: f32 = 0.06;

const CHANNELS: [Channel; 8] = [
    Channel::EarForward,
    Channel::EarLift,
    Channel::EarIn,
    Channel::EarTurn,
    Channel::EarBack,
    Channel::EarOut,
    Channel::EarBend,
    Channel::EarSway,
];

/// The left ear's vertices of the whole mesh.
#[derive(Clone, Debug)]
pub(super) struct Ears {
    rings: Vec<Vec<u32>>,
    hole: [u16; 12],
    /// Skin around the base, with how far it goes along.
    around: Vec<(u32, f32)>,
}

/// A left ear at rest.
struct Rest<'a> {
    at: &'a [Vec3],
    middles: [Vec3; EAR_RINGS + 1],
    base: Vec3,
    /// Along the ear at its base.
    up: Vec3,
    /// Across its leather where that is broadest, and out of its opening.
    across: Vec3,
    opening: Vec3,
    /// How much it hangs, 0 to 1, and the ring of its fold.
    hangs: f32,
    fold: usize,
}

impl Ears {
    pub(super) fn new(h: &Handles, neighbours: &Neighbours, base: &[Vec3]) -> Self {
        let mut rings: Vec<Vec<u32>> = h.a.iter().map(|ring| ring.iter().map(|&v| u32::from(v)).collect()).collect();
        rings.push(h.ear_end.iter().map(|&v| u32::from(v)).collect());
        let from: Vec<(u32, f32)> = h.ear_base.iter().map(|&v| (u32::from(v), 0.0)).collect();
        let ways = neighbours.ways(base, &from, REACH);
        let leather: Vec<u32> = rings.concat();
        let around = (0..base.len() as u32)
            .filter(|v| ways[*v as usize] < REACH && !leather.contains(v) && base[*v as usize].x > 0.0)
            .map(|v| (v, GLIDE[0] * fade(ways[v as usize], REACH)))
            .collect();
        Self { rings, hole: h.ear_base, around }
    }

    fn rest<'a>(&self, at: &'a [Vec3]) -> Rest<'a> {
        let middle = |ring: &Vec<u32>| ring.iter().map(|&v| at[v as usize]).sum::<Vec3>() / ring.len() as f32;
        let middles: [Vec3; EAR_RINGS + 1] = std::array::from_fn(|k| middle(&self.rings[k]));
        let base = self.hole.iter().map(|&v| at[usize::from(v)]).sum::<Vec3>() / 12.0;
        let length: f32 = middles.windows(2).map(|m| m[0].distance(m[1])).sum::<f32>().max(1e-4);
        let hangs = smoothstep(0.0, 0.55, (base.y - middles[EAR_RINGS].y) / length);
        let fold = (1..=EAR_RINGS).max_by(|&a, &b| middles[a].y.total_cmp(&middles[b].y)).unwrap_or(1);
        let up = (middles[2] - base).normalize_or(Vec3::Y);
        let edges = self.rings.iter().zip(&middles).flat_map(|(ring, m)| ring.iter().map(|&v| at[v as usize] - *m));
        let edge = edges.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared())).unwrap_or(Vec3::X);
        let across = edge.normalize_or(Vec3::X);
        let opening = across.cross(up).normalize_or_zero();
        let opening = if opening.z < 0.0 { -opening } else { opening };
        Rest { at, middles, base, up, across, opening, hangs, fold }
    }

    /// Moves both ears. `rest`: control positions at rest, of which the left half counts; `surface`: the head without its
    /// ears; `mirror`: of each vertex.
    pub(super) fn turn(
        &self,
        pose: &Pose,
        unit: f32,
        rest: &[Vec3],
        head @ (shape, _): (&Proportions, &Implicit),
        mirror: &[u32],
        at: &mut [Vec3],
    ) {
        let of_side = |side: usize| CHANNELS.map(|c| pose.channel(c)[side]);
        let sides = [of_side(0), of_side(1)];
        if sides.iter().flatten().all(|v| *v == 0.0) {
            return;
        }
        let ear = self.rest(rest);
        for (side, values) in sides.into_iter().enumerate().filter(|(_, values)| values.iter().any(|v| *v != 0.0)) {
            let [forward, lift, inwards, ..] = values;
            let glide = vec3(-inwards, lift, forward) * unit;
            let mut put = |v: u32, d: Vec3| {
                if side == 0 {
                    at[v as usize] += d;
                } else {
                    at[mirror[v as usize] as usize] += vec3(-d.x, d.y, d.z);
                }
            };
            self.around.iter().for_each(|&(v, w)| put(v, glide * w));
            let turned = |k: usize| turns(&ear, &values, k);
            let mut middle = ear.base + glide * GLIDE[1] + turned(0) * (ear.middles[0] - ear.base);
            for (k, ring) in self.rings.iter().enumerate() {
                let turn = turned(k);
                if k > 0 {
                    // Half of the way with the turn of the ring before.
                    let way = ear.middles[k] - ear.middles[k - 1];
                    middle += 0.5 * (turned(k - 1) * way + turn * way);
                }
                let closed = closing(&ear, &values, k, ring);
                let place = |v: u32, middle: Vec3| middle + turn * closed(ear.at[v as usize] - ear.middles[k]);
                // Two at a time; of an odd ring the last is asked twice.
                let pairs = ring.chunks(2).map(|pair| [pair[0], pair[pair.len() - 1]]);
                let off = |(deep, outwards): (f32, Vec3)| shape.direction(outwards) * (deep * shape.scale);
                if k >= 2 {
                    let all = pairs.clone().flat_map(|two| lacks(head, &ear, two, two.map(|v| place(v, middle))));
                    middle += off(all.fold((0.0, Vec3::ZERO), |most, own| if own.0 > most.0 { own } else { most }));
                }
                for (two, own) in pairs.zip(ring.chunks(2)) {
                    let places = two.map(|v| place(v, middle));
                    let deep = if k >= 1 { lacks(head, &ear, two, places) } else { Default::default() };
                    for ((&v, p), deep) in own.iter().zip(places).zip(deep) {
                        put(v, p + off(deep) - ear.at[v as usize]);
                    }
                }
            }
        }
    }
}

/// How a ring of the left ear turns.
fn turns(ear: &Rest<'_>, &[.., turn, back, out, bend, sway]: &[f32; 8], ring: usize) -> Mat3 {
    let hang = |t: f32, most: f32| 1.0 + ear.hangs * (most - 1.0) * t;
    let behind = smoothstep(ear.fold as f32, ear.fold as f32 + 2.0, ring as f32);
    let part = RAMP[ring] * hang(1.0, HANGING[0]) * hang(behind, HANGING[1]);
    let second = smoothstep(2.5, 5.5, ring as f32);
    let of = |angle: f32| (angle * part).to_radians();
    // What hangs may still swing.
    let [bend, sway] = [bend, sway].map(|a| (a * second).to_radians());
    Mat3::from_rotation_z(-of(out) - sway)
        * Mat3::from_rotation_x(-of(back) - bend)
        * Mat3::from_axis_angle(ear.up, of(turn))
}

/// How a ring of leather narrows as the ear lies back: a map of offsets from the ring's middle.
fn closing(ear: &Rest<'_>, &[.., back, _, _, _]: &[f32; 8], k: usize, ring: &[u32]) -> impl Fn(Vec3) -> Vec3 {
    let narrower = NARROWED * smoothstep(15.0, 95.0, back) * (1.0 - ear.hangs) * smoothstep(0.5, 3.0, k as f32);
    let [across, opening] = [ear.across, ear.opening];
    let offsets = ring.iter().map(|&v| (ear.at[v as usize] - ear.middles[k]).dot(across).abs());
    let width = offsets.fold(1e-6, f32::max);
    move |offset: Vec3| {
        let u = offset.dot(across) / width;
        offset - across * (narrower * u * width) + opening * (CURLED * narrower * width * (u * u - 0.4))
    }
}

/// By how much two vertices that lie at `places` are deeper in the head than at rest, in its proportions, and outwards.
fn lacks(
    (shape, surface): (&Proportions, &Implicit),
    ear: &Rest<'_>,
    vertices: [u32; 2],
    places: [Vec3; 2],
) -> [(f32, Vec3); 2] {
    let [a, b] = places.map(|p| shape.proportional(p));
    let samples = surface.sample2(a, b, Layer::Whole);
    std::array::from_fn(|k| {
        let (d, outwards) = samples[k];
        if d >= CLEAR {
            return (0.0, Vec3::ZERO);
        }
        let rest = surface.distance(shape.proportional(ear.at[vertices[k] as usize]), Layer::Whole);
        ((rest.min(CLEAR) - d).max(0.0), outwards.normalize_or_zero())
    })
}
