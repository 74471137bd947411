//! Skin off bone: what a pose brings nearer to skull or mandible than the thinnest tissue is pushed out again, and its
//! neighbours go along.
//!
//! What is seen is not the control mesh but its limit, which sags over a ridge of bone. So the limit is asked, at vertices
//! and at the middles of faces, and control vertices are moved by what it lacks. Most of a head is farther from bone than a
//! pose moves it, which is known without asking.

use super::rigid::Rigid;
use super::zones::Neighbours;
use crate::anatomy::Region;
use crate::mesh::VertexId;
use crate::rig::bone::{BoneField, BoneMesh, Targets, teeth};
use crate::rig::lanes::{F8, P8};
use glam::Vec3;

/// Tissue over bone, canonical millimetres: what has less at rest keeps that.
const TISSUE: f32 = 1.5;
/// A field tells at most so much less for each metre that a point goes: bodies that are squeezed are farther in theirs.
const STEEPEST: f32 = 2.0;
/// What a push goes outwards for its way, at least.
const TURNS: f32 = 0.8;
/// Rounds of asking and pushing.
const ROUNDS: usize = 6;
/// Farthest push of a round, canonical millimetres.
const FARTHEST: f32 = 8.0;
/// What of a push the neighbours make, and how many rings of them.
const ALONG: f32 = 0.6;
const RINGS: usize = 2;
/// Part of a control vertex in its limit; its ring has the rest (√3, valence 6).
const OWN: f32 = 0.5;

/// Which places of the mesh are asked.
#[derive(Clone, Debug)]
pub(super) struct OffBone {
    /// Corners of a face; a vertex three times.
    places: Vec<[u32; 3]>,
    /// By vertex: whether it may be pushed.
    free: Vec<bool>,
}

/// What of it depends on a head.
#[derive(Clone, Debug, Default)]
pub(super) struct BonesOf {
    bones: [BoneField; 2],
    /// A canonical millimetre, metres.
    unit: f32,
    /// By bone and place: how far it stays from bone, metres.
    least: [Vec<f32>; 2],
    /// By bone and vertex: how far it may go unasked, metres.
    leeway: [Vec<f32>; 2],
}

/// Buffers of a pose.
#[derive(Clone, Debug, Default)]
pub(super) struct Pushes {
    limit: Vec<Vec3>,
    /// Outwards, by vertex, as long as the faces around it are large.
    normals: Vec<Vec3>,
    /// By vertex: pushes weighed by their lengths, and the sum of these.
    push: Vec<(Vec3, f32)>,
    spread: Vec<Vec3>,
    asked: Vec<bool>,
    open: Vec<u32>,
}

fn limit(neighbours: &Neighbours, at: &[Vec3], v: usize) -> Vec3 {
    let ring = neighbours.of(VertexId(v as u32));
    at[v] * OWN + ring.iter().map(|&n| at[n as usize]).sum::<Vec3>() * ((1.0 - OWN) / ring.len() as f32)
}

impl OffBone {
    /// Skin with hair and lips, but for leather, lining and `lids`, which have their own place; `held`: vertices that stay.
    pub(super) fn new(
        faces: &[[u32; 3]],
        regions: &[Region],
        lids: impl Fn(usize) -> bool,
        held: impl Fn(usize) -> bool,
    ) -> Self {
        let is_over = |r: Region| {
            !matches!(
                r,
                Region::EarInner | Region::EarOuter | Region::EarEdge | Region::Mouth | Region::Nostril | Region::Lid
            )
        };
        let over: Vec<bool> = regions.iter().enumerate().map(|(v, &r)| is_over(r) && !lids(v)).collect();
        let vertices = (0..over.len() as u32).filter(|&v| over[v as usize]).map(|v| [v; 3]);
        let faces = faces.iter().copied().filter(|f| f.iter().all(|&v| over[v as usize]));
        let places = vertices.chain(faces).collect();
        let free = (0..over.len()).map(|v| over[v] && !held(v)).collect();
        Self { places, free }
    }

    /// `rest`: control positions.
    pub(super) fn of_head(&self, neighbours: &Neighbours, rest: &[Vec3], bone: &Targets<Vec3>, out: &mut BonesOf) {
        out.unit = teeth::unit(bone);
        for (field, which) in out.bones.iter_mut().zip([BoneMesh::Skull, BoneMesh::Mandible]) {
            field.place(which, bone, out.unit);
        }
        let limits: Vec<Vec3> = (0..rest.len()).map(|v| limit(neighbours, rest, v)).collect();
        let BonesOf { bones, unit, least, leeway } = out;
        for ((field, least), leeway) in bones.iter().zip(least).zip(leeway) {
            least.clear();
            leeway.clear();
            leeway.resize(rest.len(), f32::INFINITY);
            for eight in self.places.chunks(8) {
                let d = distances(field, |k| self.at(&limits, eight[k.min(eight.len() - 1)]));
                for (corners, d) in eight.iter().zip(d) {
                    let own = d.min(TISSUE * *unit);
                    least.push(own);
                    for &v in corners {
                        let leeway = &mut leeway[v as usize];
                        *leeway = leeway.min((d - own) / STEEPEST);
                    }
                }
            }
        }
    }

    fn at(&self, limits: &[Vec3], corners: [u32; 3]) -> Vec3 {
        corners.map(|v| limits[v as usize]).into_iter().sum::<Vec3>() / 3.0
    }

    /// Pushes skin out; `places`: of skull and mandible, from the head at `rest`.
    pub(super) fn keep_off(
        &self,
        neighbours: &Neighbours,
        of: &BonesOf,
        (places, rest): ([&Rigid; 2], &[Vec3]),
        buffers: &mut Pushes,
        at: &mut [Vec3],
    ) {
        for (k, place) in places.into_iter().enumerate() {
            self.keep_off_one(
                neighbours,
                (&of.bones[k], of.unit),
                (&of.least[k], &of.leeway[k]),
                (place, rest),
                buffers,
                at,
            );
        }
    }

    fn keep_off_one(
        &self,
        neighbours: &Neighbours,
        (field, unit): (&BoneField, f32),
        (least, leeway): (&[f32], &[f32]),
        (place, rest): (&Rigid, &[Vec3]),
        Pushes { limit: limits, normals, push, spread, asked, open }: &mut Pushes,
        at: &mut [Vec3],
    ) {
        let n = at.len();
        asked.clear();
        asked.resize(n, false);
        let mut is_any = false;
        for (v, asked) in asked.iter_mut().enumerate().filter(|(v, _)| self.free[*v]) {
            let moved = place.back(at[v]).distance_squared(rest[v]);
            *asked = moved > leeway[v] * leeway[v] + 1e-12;
            is_any |= *asked;
        }
        if !is_any {
            return;
        }
        limits.resize(n, Vec3::ZERO);
        for _ in 0..ROUNDS {
            open.clear();
            open.extend(
                (0..self.places.len() as u32).filter(|&p| self.places[p as usize].iter().any(|&v| asked[v as usize])),
            );
            for &p in open.iter() {
                for v in self.places[p as usize] {
                    limits[v as usize] = place.back(limit(neighbours, at, v as usize));
                }
            }
            normals.clear();
            normals.resize(n, Vec3::ZERO);
            for &p in open.iter() {
                let corners = self.places[p as usize];
                let [a, b, c] = corners.map(|v| limits[v as usize]);
                let area = (b - a).cross(c - a);
                corners.iter().for_each(|&v| normals[v as usize] += area);
            }
            push.clear();
            push.resize(n, (Vec3::ZERO, 0.0));
            let mut is_any = false;
            for eight in open.chunks(8) {
                let here = |k: usize| self.at(limits, self.places[eight[k.min(eight.len() - 1)] as usize]);
                let d = distances(field, here);
                for (k, &p) in eight.iter().enumerate() {
                    let lacks = least[p as usize] - d[k];
                    if lacks > 0.0 {
                        is_any = true;
                        let (_, g) = field.sample(here(k), 0.1 * unit);
                        let out = self.places[p as usize]
                            .map(|v| normals[v as usize])
                            .into_iter()
                            .sum::<Vec3>()
                            .normalize_or_zero();
                        let own = g.normalize_or_zero();
                        // Bone is inside.
                        let to = (own + out * (TURNS - own.dot(out)).max(0.0)).normalize_or_zero();
                        let way = (to * (lacks / g.length().max(0.45))).clamp_length_max(FARTHEST * unit);
                        let length = way.length();
                        for v in self.places[p as usize] {
                            let (sum, weight) = &mut push[v as usize];
                            *sum += way * length;
                            *weight += length;
                        }
                    }
                }
            }
            if !is_any {
                return;
            }
            // Weighed by their lengths: what lacks most counts most, and nothing jumps.
            spread.clear();
            spread.extend(push.iter().map(|&(sum, weight)| if weight > 0.0 { sum / weight } else { Vec3::ZERO }));
            for _ in 0..RINGS {
                for (v, (to, weight)) in push.iter_mut().enumerate() {
                    (*to, *weight) = (spread[v], 0.0);
                    if !self.free[v] {
                        continue;
                    }
                    let (mut sum, mut lengths) = (Vec3::ZERO, 0.0);
                    for &r in neighbours.of(VertexId(v as u32)) {
                        let way = spread[r as usize];
                        let length = way.length();
                        sum += way * length;
                        lengths += length;
                    }
                    if lengths > 0.0 {
                        let way = sum / lengths * ALONG;
                        let length = way.length();
                        if length > 0.0 {
                            let more = length - to.dot(way) / length;
                            *to += way * (more.max(0.0) / length);
                        }
                    }
                }
                spread.iter_mut().zip(push.iter()).for_each(|(to, (from, _))| *to = *from);
            }
            for v in (0..n).filter(|&v| self.free[v] && spread[v] != Vec3::ZERO) {
                at[v] += place.direction(spread[v]);
                asked[v] = true;
            }
        }
    }
}

fn distances(field: &BoneField, at: impl Fn(usize) -> Vec3) -> [f32; 8] {
    let points: [Vec3; 8] = std::array::from_fn(at);
    let lane = |axis: usize| F8(points.map(|p| p[axis]));
    field.distance8(P8 { x: lane(0), y: lane(1), z: lane(2) }).0
}
