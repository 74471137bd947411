//! Lips that part with the teeth together, cheeks that are puffed out, flews that swing after the head.

use super::zones::{Neighbours, fade, smoothstep};
use crate::motion::{Channel, Pose};
use crate::rig::handles::{Handles, NONE};
use glam::{Vec3, vec3};

/// How far from the margin a lip follows it, head units of the base head.
const REACH: f32 = 2.4;
/// Way of the lower lip for that of the upper one: it is held by the chin.
const LOWER: f32 = 0.3;
/// How far a cheek is puffed out around the muzzle's side.
const PUFF: f32 = 5.0;
/// How much of the margin's way the skin beside it makes at least: as far as a lip is thick, both are one.
const BESIDE: f32 = 0.75;
/// How much a lip that parts turns outwards for its way up or down.
const CURL: f32 = 0.35;

/// Weights of the left half's vertices: vertex of the whole mesh, weight.
#[derive(Clone, Debug)]
pub(super) struct Lips {
    upper: Vec<(u32, f32)>,
    lower: Vec<(u32, f32)>,
    flew: Vec<(u32, f32)>,
    cheek: Vec<(u32, f32)>,
}

impl Lips {
    pub(super) fn new(h: &Handles, neighbours: &Neighbours, base: &[Vec3]) -> Self {
        let rows = |skin: [u16; 20], lining: &[[u16; 4]; 11], own: &dyn Fn(usize, usize) -> Vec<u16>| {
            let from: Vec<(u32, f32)> = (3..10).map(|i| (u32::from(skin[i]), 0.0)).collect();
            let ways = neighbours.ways(base, &from, REACH);
            let of = |v: u16| ways.get(usize::from(v)).copied().unwrap_or(f32::INFINITY);
            let mut out = Vec::new();
            for (i, lining) in lining.iter().enumerate().skip(3) {
                // It tapers to the corner of the mouth.
                let taper = smoothstep(10.5, 7.0, i as f32);
                let mut add = |v: u16, weight: f32| {
                    let w = weight * taper;
                    if v != NONE && w > 0.0 && !out.iter().any(|(o, _)| *o == u32::from(v)) {
                        out.push((u32::from(v), w));
                    }
                };
                for j in 5..15 {
                    let least = if j == 8 { BESIDE } else { 0.0 };
                    own(i, j).into_iter().for_each(|v| add(v, fade(of(v), REACH).max(least)));
                }
                // The lining goes with the margin, so that it never hangs below it.
                add(lining[1], 1.0);
                add(lining[2], 0.9);
            }
            out
        };
        let column = |j: usize, rows: &dyn Fn(usize, usize) -> u16| std::array::from_fn(|i| rows(i, j));
        let s = |i: usize, j: usize| h.s[i].get(j).copied().unwrap_or(NONE);
        let l = |i: usize, j: usize| h.l[i].get(j).copied().filter(|_| i < 10 || j > 9).unwrap_or(NONE);
        let upper = rows(column(9, &s), &h.mu, &|i, j| vec![s(i, j)]);
        let lower = rows(column(9, &l), &h.ml, &|i, j| if j >= 9 { vec![l(i, j)] } else { vec![] });
        let flew = upper.iter().map(|&(v, w)| (v, w * smoothstep(0.0, 1.0, base[v as usize].x))).collect();
        let middle = [(u32::from(h.s[7][7]), 0.0), (u32::from(h.s[8][7]), 0.0)];
        let ways = neighbours.ways(base, &middle, PUFF);
        let haired = h.s.iter().flatten().copied().filter(|&v| v != NONE);
        let mut cheek: Vec<(u32, f32)> = haired
            .map(|v| (u32::from(v), fade(ways[usize::from(v)], PUFF) * smoothstep(0.0, 1.5, base[usize::from(v)].x)))
            .filter(|(_, w)| *w > 0.0)
            .collect();
        cheek.sort_unstable_by_key(|(v, _)| *v);
        cheek.dedup_by_key(|(v, _)| *v);
        Self { upper, lower, flew, cheek }
    }

    /// `mirror`: of each vertex; `normals`: outwards, of the head at rest; `unit`: metres of a millimetre.
    pub(super) fn part(&self, pose: &Pose, unit: f32, mirror: &[u32], normals: &[Vec3], at: &mut [Vec3]) {
        let mut push = |weights: &[(u32, f32)], channel: Channel, way: &dyn Fn(usize) -> Vec3, turns: bool| {
            let sides = pose.channel(channel);
            for (side, amount) in sides.into_iter().enumerate().filter(|(_, amount)| *amount != 0.0) {
                for &(v, w) in weights {
                    let own = v as usize;
                    let image = mirror[own] as usize;
                    let d = way(own) * (w * amount * unit);
                    // In the median plane both sides share a vertex, half each.
                    let d = if image == own { d.with_x(0.0) * 0.5 } else { d };
                    if side == 0 {
                        at[own] += d;
                    } else {
                        at[image] += if turns { vec3(-d.x, d.y, d.z) } else { d };
                    }
                }
            }
        };
        // The upper lip has nothing in front of it but the nose.
        push(&self.upper, Channel::LipsPart, &|v| vec3(CURL * normals[v].x, 1.0, 0.0), true);
        push(&self.lower, Channel::LipsPart, &|v| vec3(CURL * normals[v].x, -1.0, CURL * normals[v].z) * LOWER, true);
        push(&self.cheek, Channel::CheekPuff, &|v| normals[v], true);
        push(&self.flew, Channel::FlewSway, &|_| Vec3::X, false);
    }
}
