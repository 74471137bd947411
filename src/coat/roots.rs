//! Hair roots on the refined skin, bound to triangles, so that they follow every breed and expression.
//!
//! A root's triangle is found by a number that walks through the triangles' shares by the golden ratio: any first part of
//! such a walk is spread evenly (Weyl 1916), so that fewer hairs are simply the first ones.

use super::borders;
use crate::anatomy::Region;
use crate::math::ops;
use crate::math::rng::Rng;
use crate::rig::Rig;
use crate::subdiv::{Plan, evaluate_once};
use glam::Vec3;

/// The largest number of roots that is made.
pub const MAX_STRANDS: usize = 500_000;

/// The fractional part of the golden ratio.
const GOLDEN: f64 = 0.618_033_988_749_894_9;

/// Where every walk begins. Another number gives other hairs, not better ones.
const SEED: u64 = 0x4841_4952;

/// Density on the rim of the nose pad and on the fold of the lids.
const BORDER: f32 = 2.0;

/// Below this density at a corner a triangle bears no hair: margins of lips, lids and nose stay bare.
const LEAST: f32 = 0.12;

/// One hair's place.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct Root {
    /// Which triangle of the skin, in the order in which it is drawn.
    pub triangle: u32,
    /// Weights of the second and the third corner; with that of the first they sum to one and none is negative.
    pub weights: [f32; 2],
    /// What makes this hair differ from its neighbours.
    pub seed: u32,
    /// Where it stands on the base head, head units: what the noise of locks is bound to.
    pub place: [f32; 3],
    /// The root, among the first [`N_LEADERS`], towards which its lock runs together; itself where none is near.
    pub leader: u32,
}

/// Roots that locks form around: about one in half a centimetre.
pub const N_LEADERS: usize = 4000;
/// The farthest that a hair goes to its lock, head units.
const LOCK_REACH: f32 = 1.0;
/// The least cosine between the normals of a hair and its leader: the two faces of an ear make no lock.
const LOCK_TURN: f32 = 0.2;

/// How many roots are made for so many strands: of few, more stand ready for the outline of the picture, where hair shows
/// most.
pub const fn n_rooted(n_strands: usize) -> usize {
    let most = if n_strands < OUTLINE_UP_TO { OUTLINE * n_strands } else { n_strands };
    if most < OUTLINE_UP_TO || most == n_strands { most } else { OUTLINE_UP_TO }
}

/// How many times as dense strands stand along the outline where there are few, and the number from which on they are
/// as dense all over.
const OUTLINE: usize = 3;
const OUTLINE_UP_TO: usize = 90_000;

impl Root {
    /// The value at the root from those at the corners of its triangle.
    pub fn mixed(&self, [a, b, c]: [Vec3; 3]) -> Vec3 {
        let [second, third] = self.weights;
        a * (1.0 - second - third) + b * second + c * third
    }
}

/// How densely a region is haired, relative to the cheek. Short hair needs more of it to cover.
fn density(region: Region) -> f32 {
    use Region::*;
    match region {
        Nose | Nostril | Lid | Mouth => 0.0,
        EarInner => 0.5,
        WhiskerPad | UpperLip | LowerLip => 3.0,
        Bridge | MuzzleSide | Stop | Blaze | Orbit => 2.2,
        Chin | LowerJaw | Brow => 2.0,
        Forehead | Crown | Temple | Cheek => 1.2,
        EarOuter | EarEdge => 1.1,
        Throat => 0.9,
        Nape | NeckSide | NeckFront => 0.7,
    }
}

/// The first `n` roots (at most [`MAX_STRANDS`]) on the skin of a plan. `triangles`: three vertices each, as they are drawn;
/// `is_haired`: one for each triangle. Fewer, or none, where no triangle bears hair.
///
/// Shares are by the area of the base head, so that they depend on the topology alone.
pub fn roots(rig: &Rig, plan: &Plan, triangles: &[[u32; 3]], is_haired: &[bool], n: usize) -> Vec<Root> {
    let (skin, _) = evaluate_once(plan, &rig.base());
    let regions = rig.half().whole_regions();
    // Up to the rim of what is bare, whose own triangles have another material.
    let borders = borders(rig, &regions);
    let of_vertex = regions.iter().zip(borders).map(|(&r, border)| if border { BORDER } else { density(r) });
    let control: Vec<Vec3> = of_vertex.map(|d| Vec3::new(d, 0.0, 0.0)).collect();
    let (densities, _) = evaluate_once(plan, &control);

    let mut ends = Vec::with_capacity(triangles.len());
    let mut total = 0.0_f64;
    for (corners, &haired) in triangles.iter().zip(is_haired) {
        let [a, b, c] = corners.map(|v| skin[v as usize]);
        let [d, e, f] = corners.map(|v| densities[v as usize].x);
        if haired && d.min(e).min(f) >= LEAST {
            let area = (b - a).cross(c - a).length() * 0.5;
            total += f64::from(area) * f64::from(d + e + f) / 3.0;
        }
        ends.push(total);
    }
    if !(total.is_finite() && total > 0.0) {
        return Vec::new();
    }
    let mut rng = Rng::new(SEED);
    let mut walk = rng.unit_f64();
    let make = |_| {
        walk = (walk + GOLDEN).fract();
        let wanted = walk * total;
        let triangle = ends.partition_point(|&end| end <= wanted).min(ends.len() - 1) as u32;
        // Evenly over the triangle: Osada, Funkhouser, Chazelle and Dobkin 2002, "Shape distributions", equation 1.
        let (s, t) = (ops::sqrt(rng.unit_f32()), rng.unit_f32());
        let (weights, seed) = ([s * (1.0 - t), s * t], rng.next_u32());
        let mut root = Root { triangle, weights, seed, place: [0.0; 3], leader: 0 };
        root.place = root.mixed(triangles[triangle as usize].map(|v| skin[v as usize])).to_array();
        root
    };
    let mut roots: Vec<Root> = (0..n.min(MAX_STRANDS)).map(make).collect();
    let normal = |root: &Root| {
        let [a, b, c] = triangles[root.triangle as usize].map(|v| skin[v as usize]);
        (b - a).cross(c - a).normalize_or_zero()
    };
    let normals: Vec<Vec3> = roots.iter().map(normal).collect();
    let leaders = Leaders::new(&roots[..roots.len().min(N_LEADERS)], &normals);
    for (i, (root, normal)) in roots.iter_mut().zip(&normals).enumerate() {
        root.leader = if i < N_LEADERS { i as u32 } else { leaders.nearest(root, *normal).unwrap_or(i as u32) };
    }
    roots
}

/// Leaders by cell of a box around them, so that the nearest is found among few.
struct Leaders {
    low: Vec3,
    n_cells: [usize; 3],
    /// Where the leaders of each cell begin in `sorted`; one more than there are cells.
    starts: Vec<u32>,
    sorted: Vec<(u32, Vec3, Vec3)>,
}

impl Leaders {
    fn new(roots: &[Root], normals: &[Vec3]) -> Self {
        let places = || roots.iter().map(|r| Vec3::from(r.place));
        let (low, high) = places().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), p| (lo.min(p), hi.max(p)));
        let n_cells = (high - low).to_array().map(|side| (side.max(0.0) / LOCK_REACH) as usize + 1);
        let mut leaders =
            Self { low, n_cells, starts: vec![0; n_cells.iter().product::<usize>() + 1], sorted: Vec::new() };
        let mut of_cell: Vec<(usize, u32)> =
            (0u32..).zip(places()).map(|(i, p)| (leaders.number(leaders.cell(p)), i)).collect();
        of_cell.sort_unstable();
        for (cell, i) in of_cell {
            leaders.starts[cell + 1] += 1;
            leaders.sorted.push((i, Vec3::from(roots[i as usize].place), normals[i as usize]));
        }
        for cell in 1..leaders.starts.len() {
            leaders.starts[cell] += leaders.starts[cell - 1];
        }
        leaders
    }

    fn cell(&self, place: Vec3) -> [usize; 3] {
        let cell = ((place - self.low) / LOCK_REACH).to_array();
        std::array::from_fn(|k| (cell[k].max(0.0) as usize).min(self.n_cells[k] - 1))
    }

    fn number(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.n_cells[1] + y) * self.n_cells[0] + x
    }

    /// The nearest leader on the same side of the skin.
    fn nearest(&self, root: &Root, normal: Vec3) -> Option<u32> {
        let place = Vec3::from(root.place);
        let around = |k: usize, at: usize| at.saturating_sub(1)..=(at + 1).min(self.n_cells[k] - 1);
        let [x, y, z] = self.cell(place);
        let mut best = (LOCK_REACH * LOCK_REACH, None);
        for (z, y) in around(2, z).flat_map(|z| around(1, y).map(move |y| (z, y))) {
            let row = around(0, x);
            let (first, last) = (self.number([*row.start(), y, z]), self.number([*row.end(), y, z]));
            for (i, at, n) in &self.sorted[self.starts[first] as usize..self.starts[last + 1] as usize] {
                let distance = at.distance_squared(place);
                if distance < best.0 && n.dot(normal) > LOCK_TURN {
                    best = (distance, Some(*i));
                }
            }
        }
        best.1
    }
}
