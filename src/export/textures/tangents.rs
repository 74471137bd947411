//! Tangents at the vertices of a layout: those of Mikkelsen 2008, "Simulation of wrinkled surfaces revisited", which glTF
//! asks for and clients compute for themselves where they are not given.

use crate::frame::{Part, Uv};
use crate::math::ops;
use bevy_mikktspace::{Geometry, Ops, TangentSpace};
use glam::{Vec3, Vec4};

/// Tangents of the part's vertices to draw, one each: unit, and in w the sign of the bitangent, normal × tangent · w, which
/// points upwards in the picture.
pub(super) fn tangents(part: &Part<'_>, uv: &Uv) -> Vec<Vec4> {
    let mut layout = Layout { part, uv, tangents: vec![Vec4::new(1.0, 0.0, 0.0, 1.0); uv.vertices.len()] };
    let done = bevy_mikktspace::generate_tangents::<_, Portable>(&mut layout);
    debug_assert!(done.is_ok(), "there is nothing that could fail");
    layout.tangents
}

struct Layout<'a> {
    part: &'a Part<'a>,
    uv: &'a Uv,
    tangents: Vec<Vec4>,
}

impl Layout<'_> {
    fn vertex(&self, face: usize, corner: usize) -> usize {
        self.uv.indices[3 * face + corner] as usize
    }
}

/// The same bits everywhere.
struct Portable;

impl Ops for Portable {
    fn sqrt(x: f32) -> f32 {
        ops::sqrt(x)
    }

    fn acos(x: f32) -> f32 {
        ops::acos(f64::from(x)) as f32
    }
}

impl Geometry<Portable> for Layout<'_> {
    fn num_faces(&self) -> usize {
        self.uv.indices.len() / 3
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        middle(self.part.positions, self.uv.vertices[self.vertex(face, corner)]).to_array()
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        middle(self.part.normals, self.uv.vertices[self.vertex(face, corner)]).normalize_or(Vec3::Y).to_array()
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        self.uv.coordinates[self.vertex(face, corner)].to_array()
    }

    fn set_tangent(&mut self, found: Option<TangentSpace>, face: usize, corner: usize) {
        let Some(found) = found else { return };
        let [x, y, z, w] = found.tangent_encoded();
        // Texture coordinates run downwards, bitangents upwards.
        let tangent = Vec3::new(x, y, z).normalize_or(Vec3::X);
        let vertex = self.vertex(face, corner);
        self.tangents[vertex] = tangent.extend(-w);
    }
}

/// The value of a vertex to draw from those of the two vertices that it lies in the middle of.
pub(super) fn middle(values: &[Vec3], [a, b]: [u32; 2]) -> Vec3 {
    (values[a as usize] + values[b as usize]) * 0.5
}
