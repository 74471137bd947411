//! Triangles of one mesh that go through each other, found with a tree of boxes and decided exactly.
//!
//! Two triangles cross where a side of one goes through the other: its ends lie on different sides of the plane, and the
//! line through them passes the three corners in one sense (Möller and Trumbore's volumes, by Shewchuk's 1997 predicates,
//! so that no rounding decides). Of two that share a corner only the sides opposite to it are asked; two that share a side
//! cross only where the skin is folded flat, which is another question.

use glam::Vec3;
use robust::{Coord3D, orient3d};
use rstar::{AABB, RTree, RTreeObject};

struct Boxed {
    face: u32,
    corners: AABB<[f32; 3]>,
}

impl RTreeObject for Boxed {
    type Envelope = AABB<[f32; 3]>;
    fn envelope(&self) -> Self::Envelope {
        self.corners
    }
}

type Triangle = [u32; 3];

/// Pairs of triangles of which one at least is `asked` for; each pair once.
pub fn crossings(positions: &[Vec3], indices: &[u32], asked: impl Fn(usize) -> bool) -> Vec<[usize; 2]> {
    let faces = indices.as_chunks::<3>().0;
    let boxed = |f: usize| {
        let [a, b, c] = faces[f].map(|v| positions[v as usize]);
        let (low, high) = (a.min(b).min(c), a.max(b).max(c));
        Boxed { face: f as u32, corners: AABB::from_corners(low.to_array(), high.to_array()) }
    };
    let tree = RTree::bulk_load((0..faces.len()).map(boxed).collect());
    let mut found = Vec::new();
    for f in (0..faces.len()).filter(|&f| asked(f)) {
        for near in tree.locate_in_envelope_intersecting(boxed(f).corners) {
            let g = near.face as usize;
            if (g > f || !asked(g)) && g != f && cross(positions, faces[f], faces[g]) {
                found.push([f, g]);
            }
        }
    }
    found.sort_unstable();
    found
}

fn cross(at: &[Vec3], f: Triangle, g: Triangle) -> bool {
    let shared: Vec<u32> = f.into_iter().filter(|v| g.contains(v)).collect();
    let opposite = |t: Triangle, v: u32| {
        let k = t.iter().position(|&c| c == v).unwrap_or(0);
        [t[(k + 1) % 3], t[(k + 2) % 3]]
    };
    let sides = |t: Triangle| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    match shared[..] {
        [] => sides(f).into_iter().any(|s| pierces(at, s, g)) || sides(g).into_iter().any(|s| pierces(at, s, f)),
        [v] => pierces(at, opposite(f, v), g) || pierces(at, opposite(g, v), f),
        _ => false,
    }
}

/// Whether a side goes through a triangle, its edges included.
fn pierces(at: &[Vec3], [p, q]: [u32; 2], [a, b, c]: Triangle) -> bool {
    let volume = |corners: [u32; 4]| {
        let [a, b, c, d] = corners.map(|v| {
            let p = at[v as usize].as_dvec3();
            Coord3D { x: p.x, y: p.y, z: p.z }
        });
        orient3d(a, b, c, d)
    };
    let (over, under) = (volume([a, b, c, p]), volume([a, b, c, q]));
    if over * under >= 0.0 {
        return false;
    }
    let round = [volume([p, q, a, b]), volume([p, q, b, c]), volume([p, q, c, a])];
    round.iter().all(|&v| v >= 0.0) || round.iter().all(|&v| v <= 0.0)
}
