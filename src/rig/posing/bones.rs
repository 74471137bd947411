//! Skin off bone: what a pose brings nearer to skull or mandible than the thinnest tissue is pushed out again, and its
//! neighbours go along.
//!
//! What is seen is not the control mesh but its limit, which sags over a ridge of bone. So the limit is asked, at vertices
//! and at the middles of faces, and control vertices are moved by what it lacks. A place that was found so far from bone
//! that it cannot have come near since is not asked again: of a head at rest that is known before any pose.

use super::rigid::Rigid;
use super::zones::Neighbours;
use crate::anatomy::Region;
use crate::mesh::VertexId;
use crate::rig::bone::{BoneField, BoneMesh, Targets, teeth};
use crate::rig::lanes::{F8, P8};
use glam::Vec3;

/// Tissue over bone, canonical millimetres: what has less at rest keeps that.
const TISSUE: f32 = 1.6;
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
/// What rounding makes of a distance, metres.
const ROUNDING: f32 = 1e-6;
/// Part of a control vertex in its limit; its ring has the rest (√3, valence 6).
const OWN: f32 = 0.5;

/// Which places of the mesh are asked.
#[derive(Clone, Debug)]
pub(super) struct OffBone {
    /// Corners of a face; a vertex three times. Neighbours in space follow each other, so that eight in turn are near.
    places: Vec<[u32; 3]>,
    /// The places at each vertex: where they begin in the list, and the list.
    at_vertex: (Vec<u32>, Vec<u32>),
    /// By vertex: whether it may be pushed.
    free: Vec<bool>,
}

/// What of it depends on a head.
#[derive(Clone, Debug, Default)]
pub(super) struct BonesOf {
    bones: [BoneField; 2],
    /// A canonical millimetre, metres.
    unit: f32,
    /// By place: where it is at rest, and which way its skin looks there.
    middles: Vec<Vec3>,
    outwards: Vec<Vec3>,
    /// By bone and place: how far it stays from bone, metres.
    least: [Vec<f32>; 2],
    /// By bone and place: how far it may go from there unasked, metres.
    leeway: [Vec<f32>; 2],
}

/// Buffers of a pose.
#[derive(Clone, Debug, Default)]
pub(super) struct Pushes {
    /// By vertex and by place: where it is on the posed head.
    limit: Vec<Vec3>,
    middles: Vec<Vec3>,
    /// By place: where it was when its distance was taken, as the bone at rest sees it, and how far it may go from there
    /// unasked.
    asked: Vec<(Vec3, f32)>,
    /// Places to be asked.
    open: Vec<u32>,
    is_open: Vec<bool>,
    /// By vertex: pushes weighed by their lengths, and the sum of these; what the vertex goes.
    push: Vec<(Vec3, f32)>,
    spread: Vec<Vec3>,
    /// Vertices that are pushed, and whether one is.
    pushed: Vec<u32>,
    is_pushed: Vec<bool>,
}

fn limit(neighbours: &Neighbours, at: &[Vec3], v: usize) -> Vec3 {
    let ring = neighbours.of(VertexId(v as u32));
    at[v] * OWN + ring.iter().map(|&n| at[n as usize]).sum::<Vec3>() * ((1.0 - OWN) / ring.len() as f32)
}

fn middle(limits: &[Vec3], corners: [u32; 3]) -> Vec3 {
    corners.map(|v| limits[v as usize]).into_iter().sum::<Vec3>() / 3.0
}

/// Whether a point is farther than it may be from where it was.
fn has_left((from, leeway): (Vec3, f32), to: Vec3) -> bool {
    // What lacked something has no leeway at all.
    let far = leeway.max(0.0) + ROUNDING;
    from.distance_squared(to) > far * far
}

/// Adds a vertex to those that are pushed.
fn touch(v: u32, pushed: &mut Vec<u32>, is_pushed: &mut [bool]) {
    if !std::mem::replace(&mut is_pushed[v as usize], true) {
        pushed.push(v);
    }
}

impl OffBone {
    /// Skin with hair and lips, but for leather, lining and `lids`, which have their own place; `held`: vertices that stay;
    /// `base`: any head.
    pub(super) fn new(
        faces: &[[u32; 3]],
        regions: &[Region],
        base: &[Vec3],
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
        let free: Vec<bool> = (0..over.len()).map(|v| over[v] && !held(v)).collect();
        let vertices = (0..over.len() as u32).map(|v| [v; 3]);
        let mut places: Vec<[u32; 3]> = vertices
            .chain(faces.iter().copied())
            .filter(|p| p.iter().all(|&v| over[v as usize]) && p.iter().any(|&v| free[v as usize]))
            .collect();
        let low = base.iter().fold(Vec3::MAX, |low, p| low.min(*p)).with_x(0.0);
        let size = base.iter().fold(Vec3::MIN, |high, p| high.max(*p)) - low;
        // Both sides are one to the field.
        let along = |p: Vec3| along_curve((p.with_x(p.x.abs()) - low) / size);
        places.sort_by_cached_key(|&corners| (along(middle(base, corners)), corners));
        let mut offsets = vec![0; over.len() + 1];
        let corners = |p: [u32; 3]| p.into_iter().take(if p[0] == p[1] { 1 } else { 3 });
        places.iter().copied().flat_map(corners).for_each(|v| offsets[v as usize + 1] += 1);
        (0..over.len()).for_each(|v| offsets[v + 1] += offsets[v]);
        let mut list = vec![0; offsets[over.len()] as usize];
        let mut next = offsets.clone();
        for (p, &place) in places.iter().enumerate() {
            for v in corners(place) {
                list[next[v as usize] as usize] = p as u32;
                next[v as usize] += 1;
            }
        }
        Self { places, at_vertex: (offsets, list), free }
    }

    /// The places at a vertex, ascending.
    fn places_at(&self, v: usize) -> &[u32] {
        let (offsets, list) = &self.at_vertex;
        &list[offsets[v] as usize..offsets[v + 1] as usize]
    }

    /// `rest`: control positions.
    pub(super) fn of_head(&self, neighbours: &Neighbours, rest: &[Vec3], bone: &Targets<Vec3>, out: &mut BonesOf) {
        out.unit = teeth::unit(bone);
        for (field, which) in out.bones.iter_mut().zip([BoneMesh::Skull, BoneMesh::Mandible]) {
            field.place(which, bone, out.unit);
        }
        let limits: Vec<Vec3> = (0..rest.len()).map(|v| limit(neighbours, rest, v)).collect();
        out.middles.clear();
        out.middles.extend(self.places.iter().map(|&corners| middle(&limits, corners)));
        out.outwards.clear();
        out.outwards.extend(self.places.iter().map(|corners| {
            let all = corners.map(|v| self.outwards(&limits, v as usize));
            all.into_iter().sum::<Vec3>().normalize_or_zero()
        }));
        let BonesOf { bones, unit, middles, least, leeway, .. } = out;
        for ((field, least), leeway) in bones.iter().zip(least).zip(leeway) {
            least.clear();
            leeway.clear();
            for eight in middles.chunks(8) {
                for d in distances(field, |k| eight[k.min(eight.len() - 1)]).into_iter().take(eight.len()) {
                    let own = d.min(TISSUE * *unit);
                    least.push(own);
                    leeway.push((d - own) / STEEPEST);
                }
            }
        }
    }

    /// Pushes skin out; `places`: of skull and mandible, from the head at rest.
    pub(super) fn keep_off(
        &self,
        neighbours: &Neighbours,
        of: &BonesOf,
        places: [&Rigid; 2],
        buffers: &mut Pushes,
        at: &mut [Vec3],
    ) {
        buffers.prepare(at.len(), self.places.len());
        buffers.limit.extend((0..at.len()).map(|v| limit(neighbours, at, v)));
        buffers.middles.extend(self.places.iter().map(|&corners| middle(&buffers.limit, corners)));
        for (k, place) in places.into_iter().enumerate() {
            buffers.asked.clear();
            buffers.asked.extend(of.middles.iter().copied().zip(of.leeway[k].iter().copied()));
            buffers.open.clear();
            for (p, (&asked, &middle)) in buffers.asked.iter().zip(&buffers.middles).enumerate() {
                buffers.is_open[p] = has_left(asked, place.back(middle));
                if buffers.is_open[p] {
                    buffers.open.push(p as u32);
                }
            }
            for _ in 0..ROUNDS {
                if !self.ask((&of.bones[k], of.unit), (&of.least[k], &of.outwards), place, buffers) {
                    break;
                }
                self.spread(neighbours, buffers);
                self.push(neighbours, place, buffers, at);
            }
        }
    }

    /// Asks the places that are open and notes what each lacks, with its direction; whether any lacks something.
    fn ask(
        &self,
        (field, unit): (&BoneField, f32),
        (least, outwards): (&[f32], &[Vec3]),
        place: &Rigid,
        buffers: &mut Pushes,
    ) -> bool {
        let Pushes { middles, asked, open, is_open, push, pushed, is_pushed, .. } = buffers;
        for eight in open.chunks(8) {
            let points: [Vec3; 8] =
                std::array::from_fn(|k| place.back(middles[eight[k.min(eight.len() - 1)] as usize]));
            for ((&p, point), d) in eight.iter().zip(points).zip(distances(field, |k| points[k])) {
                let lacks = least[p as usize] - d;
                asked[p as usize] = (point, -lacks / STEEPEST);
                is_open[p as usize] = false;
                if lacks <= 0.0 {
                    continue;
                }
                let corners = self.places[p as usize];
                let (_, g) = field.sample(point, 0.1 * unit);
                // Bone is inside, as it was at rest: skin that a pose crumples no longer says where that is.
                let (own, out) = (g.normalize_or_zero(), outwards[p as usize]);
                let to = (own + out * (TURNS - own.dot(out)).max(0.0)).normalize_or_zero();
                let way = (to * (lacks / g.length().max(0.45))).clamp_length_max(FARTHEST * unit);
                let length = way.length();
                for v in corners {
                    touch(v, pushed, is_pushed);
                    let (sum, weight) = &mut push[v as usize];
                    *sum += way * length;
                    *weight += length;
                }
            }
        }
        open.clear();
        !pushed.is_empty()
    }

    /// Normal of the limit at a vertex, as long as the faces around it are large.
    fn outwards(&self, limits: &[Vec3], v: usize) -> Vec3 {
        let area = |&p: &u32| {
            let [a, b, c] = self.places[p as usize].map(|v| limits[v as usize]);
            (b - a).cross(c - a)
        };
        self.places_at(v).iter().map(area).sum()
    }

    /// Makes of pushes what each vertex goes: they are weighed by their lengths, so that what lacks most counts most and
    /// nothing jumps, and neighbours go along.
    fn spread(&self, neighbours: &Neighbours, Pushes { push, spread, pushed, is_pushed, .. }: &mut Pushes) {
        for &v in pushed.iter() {
            let (sum, weight) = std::mem::take(&mut push[v as usize]);
            spread[v as usize] = if weight > 0.0 { sum / weight } else { Vec3::ZERO };
        }
        for _ in 0..RINGS {
            for k in 0..pushed.len() {
                neighbours.of(VertexId(pushed[k])).iter().for_each(|&r| touch(r, pushed, is_pushed));
            }
            for &v in pushed.iter() {
                let to = &mut push[v as usize].0;
                *to = spread[v as usize];
                if !self.free[v as usize] {
                    continue;
                }
                let (mut sum, mut lengths) = (Vec3::ZERO, 0.0);
                for &r in neighbours.of(VertexId(v)) {
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
            pushed.iter().for_each(|&v| spread[v as usize] = std::mem::take(&mut push[v as usize].0));
        }
    }

    /// Moves vertices and opens the places that may have come too near by it.
    fn push(&self, neighbours: &Neighbours, place: &Rigid, buffers: &mut Pushes, at: &mut [Vec3]) {
        let Pushes { limit: limits, middles, asked, open, is_open, spread, pushed, is_pushed, .. } = buffers;
        for &v in pushed.iter() {
            let way = std::mem::take(&mut spread[v as usize]);
            if self.free[v as usize] {
                at[v as usize] += place.direction(way);
            }
        }
        // Limits of the next ring move as well.
        for k in 0..pushed.len() {
            neighbours.of(VertexId(pushed[k])).iter().for_each(|&r| touch(r, pushed, is_pushed));
        }
        pushed.iter().for_each(|&v| limits[v as usize] = limit(neighbours, at, v as usize));
        for v in pushed.drain(..) {
            is_pushed[v as usize] = false;
            for &p in self.places_at(v as usize) {
                middles[p as usize] = middle(limits, self.places[p as usize]);
                if has_left(asked[p as usize], place.back(middles[p as usize])) && !is_open[p as usize] {
                    is_open[p as usize] = true;
                    open.push(p);
                }
            }
        }
        open.sort_unstable();
    }
}

impl Pushes {
    fn prepare(&mut self, vertices: usize, places: usize) {
        self.limit.clear();
        self.middles.clear();
        // Each may be open at some time, and each vertex be pushed: nothing grows in a later frame.
        self.open.clear();
        self.open.reserve(places);
        self.pushed.reserve(vertices);
        self.is_open.resize(places, false);
        self.push.resize(vertices, (Vec3::ZERO, 0.0));
        self.spread.resize(vertices, Vec3::ZERO);
        self.is_pushed.resize(vertices, false);
    }
}

/// Where a point of the unit cube lies along Morton's curve (1966), of 32 steps to each side.
fn along_curve(p: Vec3) -> u32 {
    let step = |t: f32| (t.clamp(0.0, 0.999) * 32.0) as u32;
    let apart = |n: u32| (0..5).map(|bit| (n >> bit & 1) << (3 * bit)).sum::<u32>();
    apart(step(p.x)) | apart(step(p.y)) << 1 | apart(step(p.z)) << 2
}

/// Distances from bone, as far as they are near; see [`BoneField::near8`].
fn distances(field: &BoneField, at: impl Fn(usize) -> Vec3) -> [f32; 8] {
    let points: [Vec3; 8] = std::array::from_fn(at);
    let lane = |axis: usize| F8(points.map(|p| p[axis]));
    field.near8(P8 { x: lane(0), y: lane(1), z: lane(2) }).0
}
