//! The topology of one step of Loop and of the butterfly: a triangle into four, by arithmetic alone.
//!
//! ```text
//!            c                   children of face f, whose sides are 0 = a-b, 1 = b-c, 2 = c-a:
//!           / \
//!          /   \                 4f     = (a, m0, m2)
//!        m2-----m1               4f + 1 = (b, m1, m0)
//!        / \   / \               4f + 2 = (c, m2, m1)
//!       /   \ /   \              4f + 3 = (m0, m1, m2)
//!      a-----m0----b
//! ```
//!
//! Side `k` of a face is side 0 of its child `k` and side 2 of its child `k + 1`; side 1 of child `k` faces side `k - 1`
//! of the child in the middle.

use crate::mesh::{DedgeId, DedgeMesh};

use super::level::{Level, Sharpness};
use super::refined::{Refined, VertexParent};
use super::rule::{Surroundings, less_one};
use super::scheme::Creasing;

const NONE: u32 = u32::MAX;

/// Refines the connectivity by one step, in linear time. The caller sees to the size.
pub(super) fn refine(mesh: &DedgeMesh) -> Refined {
    let n_vertices = mesh.n_vertices() as u32;
    let mut parents: Vec<_> = mesh.vertices().map(VertexParent::Vertex).collect();
    parents.reserve(mesh.n_dedges() / 2 + 1);
    // The middle of each edge, numbered by the first side that has it.
    let mut middle = vec![0_u32; mesh.n_dedges()];
    let mut n = n_vertices;
    for (dedge, &twin) in mesh.twin.iter().enumerate() {
        // NONE is larger than any side, so a boundary edge is its own first.
        if twin > dedge as u32 {
            middle[dedge] = n;
            n += 1;
            parents.push(VertexParent::Edge(DedgeId(dedge as u32)));
        } else {
            middle[dedge] = middle[twin as usize];
        }
    }
    let mut origin = Vec::with_capacity(12 * mesh.n_faces());
    let mut twin = Vec::with_capacity(12 * mesh.n_faces());
    for face in mesh.faces() {
        let f = face.index();
        let (corners, m) = (&mesh.origin[3 * f..3 * f + 3], &middle[3 * f..3 * f + 3]);
        origin.extend([corners[0], m[0], m[2], corners[1], m[1], m[0], corners[2], m[2], m[1], m[0], m[1], m[2]]);
        let across = [0, 1, 2].map(|side| mesh.twin[3 * f + side]);
        let inner = 12 * f as u32;
        for k in 0..3_u32 {
            let before = (k + 2) % 3;
            twin.extend([second_half(across[k as usize]), inner + 9 + before, first_half(across[before as usize])]);
        }
        twin.extend([1, 2, 0].map(|k| inner + 3 * k + 1));
    }
    let outgoing = parents
        .iter()
        .map(|&parent| match parent {
            VertexParent::Vertex(vertex) => first_half(mesh.outgoing[vertex.index()]),
            VertexParent::Edge(dedge) => second_half(dedge.0),
            _ => unreachable!("a quarter has its corners on vertices and edges"),
        })
        .collect();
    let child = Refined { mesh: DedgeMesh { origin, twin, outgoing }, parents };
    child.debug_assert_sound();
    child
}

/// From the origin of a side to its middle, in the child; none for none.
#[inline(always)]
fn first_half(dedge: u32) -> u32 {
    if dedge == NONE { NONE } else { 12 * (dedge / 3) + 3 * (dedge % 3) }
}

/// From the middle of a side to its end, in the child; none for none.
#[inline(always)]
fn second_half(dedge: u32) -> u32 {
    if dedge == NONE { NONE } else { 12 * (dedge / 3) + 3 * ((dedge % 3 + 1) % 3) + 2 }
}

/// What is left of the sharpness after a step.
pub(super) fn child_sharpness(level: &Level, child: &Refined, creasing: Creasing) -> Sharpness {
    let old = &level.sharpness;
    if old.is_empty() {
        return Sharpness::default();
    }
    let mut dedges = vec![0.0; child.mesh.n_dedges()];
    let mut around = Surroundings::default();
    for dedge in level.mesh.dedges().filter(|&d| old.dedge(d) > 0.0) {
        let vertex = level.mesh.origin(dedge);
        level.surroundings(vertex, &mut around);
        let place = level.mesh.ring(vertex).position(|v| v == level.mesh.target(dedge));
        let left = place.map_or(0.0, |edge| around.child(edge, creasing));
        let half = first_half(dedge.0) as usize;
        dedges[half] = left;
        let twin = child.mesh.twin[half];
        if twin != NONE {
            dedges[twin as usize] = left;
        }
    }
    Sharpness { dedges, vertices: old.vertices.iter().map(|&s| less_one(s)).collect() }
}
