//! A head of a few ellipsoids with all five attributes, for tests of drawing that need no dog.

use glam::Vec3;
use londra::frame::{Frame, Material, MaterialRange, Part, PartTopology, Revisions};
use std::sync::Arc;

/// One part with the values it owns.
struct OwnedPart {
    topology: Arc<PartTopology>,
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
    colours: Vec<Vec3>,
    surface: Vec<Vec3>,
    flow: Vec<Vec3>,
}

/// The stand-in; lends frames.
pub struct StandIn {
    parts: Vec<OwnedPart>,
    control: Vec<Vec3>,
    control_indices: Vec<u32>,
    /// To be counted up by whoever changes the values.
    pub revisions: Revisions,
}

/// Distance to the surface of the stand-in, roughly: smooth union of ellipsoids.
fn implicit(p: Vec3, muzzle: f32) -> f32 {
    let ellipsoid = |centre: Vec3, radii: Vec3| {
        let q = (p - centre) / radii;
        (q.length() - 1.0) * radii.min_element()
    };
    let smooth_min = |a: f32, b: f32, k: f32| {
        let h = (0.5 + 0.5 * (b - a) / k).clamp(0.0, 1.0);
        b + (a - b) * h - k * h * (1.0 - h)
    };
    let skull = ellipsoid(Vec3::new(0.0, 0.035, 0.02), Vec3::new(0.062, 0.06, 0.075));
    let snout = ellipsoid(Vec3::new(0.0, 0.005, 0.07 + muzzle * 0.3), Vec3::new(0.032, 0.030, muzzle * 0.7));
    let neck = ellipsoid(Vec3::new(0.0, -0.03, -0.05), Vec3::new(0.055, 0.07, 0.06));
    smooth_min(smooth_min(skull, snout, 0.035), neck, 0.04)
}

/// A grid sphere: positions on the unit sphere and counter-clockwise triangles.
fn sphere(rows: u32, columns: u32) -> (Vec<Vec3>, Vec<u32>) {
    let mut points = Vec::new();
    let mut triangles = Vec::new();
    for row in 0..=rows {
        let polar = std::f32::consts::PI * row as f32 / rows as f32;
        for column in 0..columns {
            let around = std::f32::consts::TAU * column as f32 / columns as f32;
            // The pole is on +Z, where the nose is.
            points.push(Vec3::new(polar.sin() * around.cos(), polar.sin() * around.sin(), polar.cos()));
        }
    }
    for row in 0..rows {
        for column in 0..columns {
            let id = |r: u32, c: u32| r * columns + c % columns;
            let [a, b, c, d] = [id(row, column), id(row + 1, column), id(row + 1, column + 1), id(row, column + 1)];
            if row != 0 {
                triangles.extend([a, b, d]);
            }
            if row != rows - 1 {
                triangles.extend([b, c, d]);
            }
        }
    }
    (points, triangles)
}

impl StandIn {
    /// `muzzle`: length in metres, 0.03 to 0.12. `coat`: linear colour.
    pub fn new(muzzle: f32, coat: Vec3) -> Self {
        let parts = vec![skin(muzzle, coat), eye("eye_L", 1.0), eye("eye_R", -1.0)];
        let (coarse, control_indices) = sphere(14, 16);
        let control = coarse.into_iter().map(|d| on_surface(d, muzzle)).collect();
        Self { parts, control, control_indices, revisions: Revisions { topology: 1, shape: 1, look: 1 } }
    }

    /// Everything, borrowed.
    pub fn frame(&self) -> Frame<'_> {
        let parts = self.parts.iter().map(|p| Part {
            topology: &p.topology,
            positions: &p.positions,
            normals: &p.normals,
            colours: &p.colours,
            surface: &p.surface,
            flow: &p.flow,
            rest: &p.positions,
            uv: None,
        });
        Frame {
            parts: parts.collect(),
            control: &self.control,
            control_indices: &self.control_indices,
            plan: None,
            is_planned: false,
            whiskers: &[],
            eyes: &[],
            coat: None,
            revisions: self.revisions,
        }
    }
}

fn on_surface(direction: Vec3, muzzle: f32) -> Vec3 {
    let centre = Vec3::new(0.0, 0.015, 0.02);
    let (mut inside, mut outside) = (0.0, 0.4);
    for _ in 0..24 {
        let middle = (inside + outside) * 0.5;
        if implicit(centre + direction * middle, muzzle) < 0.0 { inside = middle } else { outside = middle }
    }
    centre + direction * inside
}

fn skin(muzzle: f32, coat: Vec3) -> OwnedPart {
    let (sphere_points, mut triangles) = sphere(140, 160);
    // More rows towards the nose.
    let mut positions: Vec<Vec3> = sphere_points.iter().map(|&d| on_surface(d, muzzle)).collect();
    let n_head = positions.len() as u32;
    for side in [1.0f32, -1.0] {
        let first = positions.len() as u32;
        let (points, ear) = sphere(40, 40);
        positions.extend(points.iter().map(|p| {
            let bent = Vec3::new(p.x * 0.010 + p.y * p.y * 0.006, p.y * 0.045, p.z * 0.030);
            Vec3::new(side * (0.067 + bent.x), 0.035 + bent.y, 0.005 + bent.z)
        }));
        for t in ear.chunks_exact(3) {
            let [a, b, c] = [t[0] + first, t[1] + first, t[2] + first];
            triangles.extend(if side > 0.0 { [a, b, c] } else { [a, c, b] });
        }
    }
    let mut normals = vec![Vec3::ZERO; positions.len()];
    for t in triangles.chunks_exact(3) {
        let [a, b, c] = [t[0], t[1], t[2]].map(|i| positions[i as usize]);
        let n = (b - a).cross(c - a);
        t.iter().for_each(|&i| normals[i as usize] += n);
    }
    normals.iter_mut().for_each(|n| *n = n.normalize_or(Vec3::Z));
    let tip = 0.07 + muzzle;
    let nose_amount = |p: Vec3| {
        let d = (p - Vec3::new(0.0, 0.014, tip)).length();
        ((0.022 - d) / 0.004).clamp(0.0, 1.0)
    };
    let bare = |p: Vec3| nose_amount(p);
    let colours = (0u32..)
        .zip(&positions)
        .map(|(i, &p)| {
            let pale = ((p.z - 0.10) / 0.05).clamp(0.0, 1.0) * 0.5;
            let ear = if i >= n_head { 0.6 } else { 1.0 };
            (coat * ear).lerp(Vec3::splat(0.75), pale * 0.6).lerp(Vec3::new(0.012, 0.011, 0.011), bare(p))
        })
        .collect();
    let surface =
        positions.iter().map(|&p| Vec3::new(1.0 - bare(p), bare(p), (-(p.y + 0.02) * 8.0).clamp(0.0, 0.4))).collect();
    let flow = (0u32..)
        .zip(&positions)
        .map(|(i, p)| if i >= n_head { -Vec3::Y } else { Vec3::new(p.x * 4.0, -0.25, -1.0) })
        .collect();
    let is_nose = |t: &[u32]| t.iter().all(|&i| i < n_head && nose_amount(positions[i as usize]) > 0.5);
    let (nose, hair): (Vec<&[u32]>, Vec<&[u32]>) = triangles.chunks_exact(3).partition(|t| is_nose(t));
    let (hair, nose) = (hair.concat(), nose.concat());
    let ranges = vec![
        MaterialRange { material: Material::Coat, start: 0, count: hair.len() as u32 },
        MaterialRange { material: Material::Nose, start: hair.len() as u32, count: nose.len() as u32 },
    ];
    let topology =
        Arc::new(PartTopology { name: "skin", n_vertices: positions.len(), indices: [hair, nose].concat(), ranges });
    OwnedPart { topology, positions, normals, colours, surface, flow }
}

fn eye(name: &'static str, side: f32) -> OwnedPart {
    let (points, indices) = sphere(32, 40);
    let centre = Vec3::new(side * 0.031, 0.047, 0.079);
    let axis = Vec3::new(side * 0.35, 0.05, 1.0).normalize_or(Vec3::Z);
    let right = Vec3::Y.cross(axis).normalize_or(Vec3::X);
    let up = axis.cross(right);
    let normals: Vec<Vec3> = points.iter().map(|p| right * p.x + up * p.y + axis * p.z).collect();
    let colours = points
        .iter()
        .map(|p| match p.z {
            z if z > 0.93 => Vec3::splat(0.004),
            z if z > 0.70 => Vec3::new(0.12, 0.05, 0.015),
            _ => Vec3::new(0.5, 0.42, 0.38),
        })
        .collect();
    let n_vertices = points.len();
    let ranges = vec![MaterialRange { material: Material::Sclera, start: 0, count: indices.len() as u32 }];
    OwnedPart {
        topology: Arc::new(PartTopology { name, n_vertices, indices, ranges }),
        positions: normals.iter().map(|n| centre + *n * 0.0115).collect(),
        normals,
        colours,
        surface: vec![Vec3::new(0.0, 1.0, 0.0); n_vertices],
        flow: vec![Vec3::ZERO; n_vertices],
    }
}
