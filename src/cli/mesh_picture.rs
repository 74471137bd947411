//! A picture of any mesh: flat faces and their edges, from a fixed three-quarter view.

use super::subdivide::Refined;
use super::{Failure, picture};
use crate::frame::{Frame, Material, MaterialRange, Part, PartTopology, Revisions};
use crate::render::{Background, Camera, Drawing, Lens, Picture, Shading, View};
use glam::{Vec3, vec3};
use std::sync::Arc;

/// Width and height, pixels.
const SIZE: [u32; 2] = [360, 360];
/// Part of the picture left free around the mesh.
const MARGIN: f32 = 0.06;
/// Degrees around the vertical and above the horizontal.
const FROM: [f32; 2] = [32.0, 24.0];
/// Half the size that the mesh is given, metres: the lights are made for heads.
const RADIUS: f32 = 0.1;
/// Linear.
const COLOUR: Vec3 = vec3(0.42, 0.50, 0.56);

/// Draws a mesh.
pub(super) fn draw(mesh: &Refined) -> Result<Picture, Failure> {
    let mut offscreen = picture::offscreen()?;
    let fitted = fitted(&mesh.positions);
    // Each face has its own vertices, so that it has its own normal.
    let (mut positions, mut normals, mut indices, mut edges) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
    for face in mesh.faces() {
        let first = positions.len() as u32;
        let at = |i: usize| fitted[face[i] as usize];
        let area: Vec3 = (2..face.len()).map(|i| (at(i - 1) - at(0)).cross(at(i) - at(0))).sum();
        positions.extend((0..face.len()).map(at));
        normals.extend((0..face.len()).map(|_| area.normalize_or_zero()));
        indices.extend((2..face.len() as u32).flat_map(|i| [first, first + i - 1, first + i]));
        edges.extend((0..face.len()).flat_map(|i| [face[i], face[(i + 1) % face.len()], face[i]]));
    }
    let n_vertices = positions.len();
    let ranges = vec![MaterialRange { material: Material::Cap, start: 0, count: indices.len() as u32 }];
    let topology = Arc::new(PartTopology { name: "mesh", n_vertices, indices, ranges });
    let (colours, nothing) = (vec![COLOUR; n_vertices], vec![Vec3::ZERO; n_vertices]);
    let part = Part {
        topology: &topology,
        positions: &positions,
        normals: &normals,
        colours: &colours,
        surface: &nothing,
        flow: &nothing,
        rest: &nothing,
        uv: None,
    };
    let revisions = Revisions::default();
    let frame = Frame {
        parts: vec![part],
        control: &fitted,
        control_indices: &edges,
        plan: None,
        is_planned: false,
        whiskers: &[],
        eyes: &[],
        coat: None,
        revisions,
    };
    let [azimuth, elevation] = FROM.map(f32::to_radians);
    let mut camera = Camera::at(View::Angles { azimuth, elevation }, Some(0.0), Lens::default());
    camera.fit(positions.iter(), SIZE[0] as f32 / SIZE[1] as f32, MARGIN);
    let drawing =
        Drawing { shading: Shading::Outlined, background: Background::Plain([255; 3]), ..Drawing::new(camera) };
    offscreen.draw(&frame, &drawing, SIZE).map_err(Failure::work)
}

/// In a sphere of [`RADIUS`] around the origin.
fn fitted(positions: &[Vec3]) -> Vec<Vec3> {
    let bounds = positions.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), &p| (lo.min(p), hi.max(p)));
    // In double precision, in which no size of single precision overflows.
    let (low, high) = (bounds.0.as_dvec3(), bounds.1.as_dvec3());
    let (middle, radius) = ((low + high) * 0.5, (high - low).length() * 0.5);
    let scale = if radius > 0.0 && radius.is_finite() { f64::from(RADIUS) / radius } else { 1.0 };
    positions.iter().map(|p| ((p.as_dvec3() - middle) * scale).as_vec3()).collect()
}
