//! Whiskers on the refined skin: where each stands in numbers, and thin tapering tubes to be seen.

use super::parts::{Material, MaterialRange, PartTopology};
use super::values::Values;
use crate::math::ops;
use crate::rig::whiskers::{Follicle, Whisker, follicles};
use crate::rig::{ControlError, Rig};
use crate::subdiv::{Plan, evaluate_once};
use glam::{Vec3, vec3};

/// Sections of a tube from the root on, and corners of one; the tip is one vertex more.
const SECTIONS: usize = 5;
const CORNERS: usize = 3;
const VERTICES: usize = SECTIONS * CORNERS + 1;
/// Radius at the root, metres on a cranium of 106 mm.
const RADIUS: f32 = 0.000_16;
/// How far a tube goes into the skin, as a part of its length.
const SUNK: f32 = 0.02;

/// A follicle on a face of the refined skin.
#[derive(Clone, Copy, Debug)]
struct Anchor {
    corners: [u32; 3],
    weights: Vec3,
}

/// What belongs to one level, and what is drawn.
pub(super) struct WhiskerParts {
    follicles: Vec<Follicle>,
    /// Left, then right.
    anchors: Vec<Anchor>,
    /// The left ones, then their mirror images.
    pub(super) whiskers: Vec<Whisker>,
    pub(super) values: Values,
}

impl WhiskerParts {
    /// Finds the follicles on the skin of a level.
    pub(super) fn new(rig: &Rig, plan: &Plan) -> Result<Self, ControlError> {
        let half = rig.half();
        let follicles = follicles(half)?;
        let base: Vec<Vec3> = half.base.iter().map(|&p| Vec3::from(p)).collect();
        let mut control = vec![Vec3::ZERO; rig.mesh().n_vertices()];
        half.unfold(&base, &mut control);
        let (skin, _) = evaluate_once(plan, &control);
        let left: Vec<Anchor> = follicles.iter().map(|f| anchor(rig, plan, &skin, &control, f)).collect();
        // The right ones stand on the mirror images of the left ones' vertices, which the base head has.
        let image = |v: u32| {
            let p = skin[v as usize];
            let far = |w: &usize| skin[*w].distance_squared(vec3(-p.x, p.y, p.z));
            (0..skin.len()).min_by(|a, b| far(a).total_cmp(&far(b))).map_or(v, |w| w as u32)
        };
        let right = left.iter().map(|&Anchor { corners: [a, b, c], weights }| Anchor {
            corners: [a, c, b].map(image),
            weights: vec3(weights.x, weights.z, weights.y),
        });
        let anchors = left.iter().copied().chain(right).collect();
        let values = Values::new(topology(2 * follicles.len()));
        Ok(Self { follicles, anchors, whiskers: Vec::new(), values })
    }

    /// `skin`: the refined one; `scale`: metres of a head unit, 0.01 on a cranium of 106 mm; `alike`: whether both sides are
    /// mirror images.
    pub(super) fn shape(&mut self, skin: &Values, scale: f32, alike: bool) {
        let Self { follicles, anchors, whiskers, values } = self;
        let n = follicles.len();
        let flip = |v: Vec3| vec3(-v.x, v.y, v.z);
        // Right ones are grown as left ones on the mirror image of the right side.
        let seen = |v: Vec3, is_left: bool| if is_left { v } else { flip(v) };
        let of_skin = |values: &[Vec3], k: usize| {
            let a = &anchors[k];
            let [p, q, r] = a.corners.map(|v| values[v as usize]);
            seen(p * a.weights.x + q * a.weights.y + r * a.weights.z, k < n)
        };
        whiskers.clear();
        for k in 0..if alike { n } else { 2 * n } {
            let (f, is_left) = (&follicles[k % n], k < n);
            let [p, q, r] = anchors[k].corners.map(|v| skin.positions[v as usize]);
            let face = seen((q - p).cross(r - p).normalize_or_zero(), is_left);
            let normal = (of_skin(&skin.normals, k) + face).normalize_or(Vec3::Y);
            let along = back(of_skin(&skin.flow, k), normal);
            let across = normal.cross(along);
            let leaning = (normal * f.lean.x + along * f.lean.y + across * f.lean.z).normalize_or(normal);
            // Where the skin bends sharply, the face may look another way than the skin around it.
            let direction = (leaning + face * (0.35 - leaning.dot(face)).max(0.0)).normalize_or(face);
            let position = of_skin(&skin.positions, k);
            let Follicle { group, row, place, .. } = *f;
            let length = 0.001 * f.length * scale / 0.01;
            let whisker = Whisker { group, row, place, is_left: true, position, direction, length };
            whiskers.push(whisker);
            let own = k * VERTICES..(k + 1) * VERTICES;
            let along = back(of_skin(&skin.flow, k), direction);
            let (positions, normals) = (&mut values.positions[own.clone()], &mut values.normals[own]);
            tube(&whisker, along, RADIUS * scale / 0.01, positions, normals);
        }
        if alike {
            whiskers.extend_from_within(..);
            for values in [&mut values.positions, &mut values.normals] {
                values.copy_within(..n * VERTICES, n * VERTICES);
            }
        }
        for whisker in &mut whiskers[n..] {
            whisker.is_left = false;
            whisker.position = flip(whisker.position);
            whisker.direction = flip(whisker.direction);
        }
        for values in [&mut values.positions, &mut values.normals] {
            values[n * VERTICES..].iter_mut().for_each(|v| *v = flip(*v));
        }
    }

    /// Dark, with something of the coat in it that they stand in; `coat`: its colour at each vertex of the refined skin.
    pub(super) fn paint(&mut self, coat: &[Vec3]) {
        let around = |a: &Anchor| a.corners.iter().map(|&v| coat[v as usize]).sum::<Vec3>() / 3.0;
        let mean = self.anchors.iter().map(around).sum::<Vec3>() / self.anchors.len().max(1) as f32;
        self.values.colours.fill(mean * 0.16 + Vec3::splat(0.008));
        self.values.surface.fill(vec3(0.0, 0.3, 0.0));
    }
}

/// The hair's direction in the skin's plane, unit; backwards where no hair lies.
fn back(flow: Vec3, normal: Vec3) -> Vec3 {
    let flat = |v: Vec3| v - normal * v.dot(normal);
    let along = flat(flow);
    if along.length_squared() > 1e-4 { along.normalize() } else { flat(Vec3::NEG_Z).normalize_or(Vec3::NEG_Y) }
}

/// The nearest place of the refined base head to a follicle on its control face, among the faces around that one.
fn anchor(rig: &Rig, plan: &Plan, skin: &[Vec3], control: &[Vec3], follicle: &Follicle) -> Anchor {
    let faces = rig.mesh().indices().as_chunks::<3>().0;
    let own = faces[follicle.face as usize];
    let [a, b, c] = own.map(|v| control[v as usize]);
    let [u, v, w] = follicle.weights;
    let wanted = a * u + b * v + c * w;
    let mut best = (f32::INFINITY, Anchor { corners: own, weights: Vec3::from(follicle.weights) });
    for (corners, &parent) in plan.indices().as_chunks::<3>().0.iter().zip(plan.face_parent()) {
        if !faces[parent as usize].iter().any(|v| own.contains(v)) {
            continue;
        }
        let triangle = corners.map(|v| skin[v as usize]);
        let weights = nearest(triangle, wanted);
        let [p, q, r] = triangle;
        let distance = (p * weights.x + q * weights.y + r * weights.z).distance_squared(wanted);
        if distance < best.0 {
            best = (distance, Anchor { corners: *corners, weights });
        }
    }
    best.1
}

/// Barycentric weights of the point of a triangle that is nearest to another.
fn nearest([a, b, c]: [Vec3; 3], p: Vec3) -> Vec3 {
    let normal = (b - a).cross(c - a);
    let area = normal.length_squared();
    let part = |q: Vec3, r: Vec3| (q - p).cross(r - p).dot(normal) / area.max(1e-20);
    let inside = vec3(part(b, c), part(c, a), part(a, b));
    if inside.min_element() >= 0.0 {
        return inside;
    }
    // On an edge.
    let edge = |p0: Vec3, p1: Vec3| {
        let t = ((p - p0).dot(p1 - p0) / p0.distance_squared(p1).max(1e-20)).clamp(0.0, 1.0);
        (t, p.distance_squared(p0.lerp(p1, t)))
    };
    let [(s, ab), (t, bc), (u, ca)] = [edge(a, b), edge(b, c), edge(c, a)];
    if ab <= bc && ab <= ca {
        vec3(1.0 - s, s, 0.0)
    } else if bc <= ca {
        vec3(0.0, 1.0 - t, t)
    } else {
        vec3(u, 0.0, 1.0 - u)
    }
}

fn topology(n: usize) -> PartTopology {
    let mut indices = Vec::new();
    for k in 0..n {
        let mirrored = k >= n / 2;
        let mut add = |[a, b, c]: [usize; 3]| {
            let turned = if mirrored { [a, c, b] } else { [a, b, c] };
            indices.extend(turned.map(|v| (k * VERTICES + v) as u32));
        };
        let at = |s: usize, c: usize| s * CORNERS + c % CORNERS;
        add([at(0, 2), at(0, 1), at(0, 0)]);
        for c in 0..CORNERS {
            for s in 0..SECTIONS - 1 {
                add([at(s, c), at(s, c + 1), at(s + 1, c + 1)]);
                add([at(s, c), at(s + 1, c + 1), at(s + 1, c)]);
            }
            add([at(SECTIONS - 1, c), at(SECTIONS - 1, c + 1), VERTICES - 1]);
        }
    }
    let ranges = vec![MaterialRange { material: Material::Whisker, start: 0, count: indices.len() as u32 }];
    PartTopology { name: "whiskers", n_vertices: n * VERTICES, indices, ranges }
}

/// A tube that bends along the hair and droops a little.
fn tube(whisker: &Whisker, along: Vec3, radius: f32, positions: &mut [Vec3], normals: &mut [Vec3]) {
    let Whisker { position, direction, length, .. } = *whisker;
    let bend = along * 0.16 - Vec3::Y * 0.10;
    let at = |s: f32| position + (direction * s + bend * (s * s)) * length;
    let side = direction.cross(along).normalize_or(Vec3::X);
    for s in 0..SECTIONS {
        let t = s as f32 / SECTIONS as f32;
        let heading = (direction + bend * (2.0 * t)).normalize_or(direction);
        let across = (side - heading * side.dot(heading)).normalize_or(side);
        let third = heading.cross(across);
        for c in 0..CORNERS {
            let turn = core::f32::consts::TAU * c as f32 / CORNERS as f32;
            let out = across * ops::cos(turn) + third * ops::sin(turn);
            positions[s * CORNERS + c] = at(if s == 0 { -SUNK } else { t }) + out * (radius * (1.0 - t));
            normals[s * CORNERS + c] = out;
        }
    }
    positions[VERTICES - 1] = at(1.0);
    normals[VERTICES - 1] = (direction + bend * 2.0).normalize_or(direction);
}
