//! A mesh from a field of signed distances: one vertex for each sheet in a cell of a grid, one
//! quadrangle for each edge of the grid that it cuts (Gibson 1998, "Constrained elastic surface nets";
//! Nielson 2004, "Dual marching cubes", for the sheets), then relaxed along
//! the surface until the triangles are even.
//!
//! One half is made (x ≥ 0): the median plane runs through the middle of a layer of cells, whose vertices lie in it.

use crate::rig::bone::{BoneField, BoneHalf, Landmark};
use glam::{Vec3, vec3};
use std::collections::BTreeMap;

/// Rounds of relaxation, and of it without projection at the start.
const ROUNDS: usize = 12;

/// The half mesh of a field within `low` to `high`, cells of `size`, with the landmarks that are vertices of it.
pub(super) fn half(field: &BoneField, low: Vec3, high: Vec3, size: f32, landmarks: &[&Landmark]) -> BoneHalf {
    let n = ((high - low) / size).ceil();
    let (nx, ny, nz) = (((high.x / size).ceil() as usize) + 1, n.y as usize, n.z as usize);
    let corner =
        |i: usize, j: usize, k: usize| vec3((i as f32 - 0.5) * size, low.y + j as f32 * size, low.z + k as f32 * size);
    let at = |i: usize, j: usize, k: usize| (i * (ny + 1) + j) * (nz + 1) + k;
    let mut values = vec![0.0_f32; (nx + 1) * (ny + 1) * (nz + 1)];
    for i in 0..=nx {
        for j in 0..=ny {
            for k in 0..=nz {
                values[at(i, j, k)] = field.distance(corner(i, j, k));
            }
        }
    }

    // For each sheet of the surface in a cell one vertex, in the middle of where the sheet cuts the cell's edges.
    let mut vertex_of: BTreeMap<(usize, usize, usize, usize), u32> = BTreeMap::new();
    let mut positions: Vec<Vec3> = Vec::new();
    for i in 0..nx {
        for j in 0..ny {
            for k in 0..nz {
                let values: [f32; 8] = std::array::from_fn(|c| values[at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2))]);
                if values.iter().all(|v| *v < 0.0) || values.iter().all(|v| *v >= 0.0) {
                    continue;
                }
                let point = |c: usize| corner(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
                let sheets = sheets(&values);
                for sheet in 0..12 {
                    let cut: Vec<usize> = (0..12).filter(|&e| sheets[e] == Some(sheet)).collect();
                    if cut.is_empty() {
                        continue;
                    }
                    let crossing = |&e: &usize| {
                        let (a, b) = ends(e);
                        point(a).lerp(point(b), values[a] / (values[a] - values[b]))
                    };
                    let mut p = cut.iter().map(crossing).sum::<Vec3>() / cut.len() as f32;
                    if i == 0 {
                        p.x = 0.0;
                    }
                    cut.iter().for_each(|&e| {
                        vertex_of.insert((i, j, k, e), positions.len() as u32);
                    });
                    positions.push(p);
                }
            }
        }
    }
    let mut quads: Vec<[u32; 4]> = Vec::new();
    for i in 1..nx {
        for j in 1..ny {
            for k in 1..nz {
                let here = values[at(i, j, k)] < 0.0;
                for axis in 0..3 {
                    let step = |along: usize, by: usize| {
                        [usize::from(along == 0) * by, usize::from(along == 1) * by, usize::from(along == 2) * by]
                    };
                    let next = step(axis, 1);
                    if here == (values[at(i + next[0], j + next[1], k + next[2])] < 0.0) {
                        continue;
                    }
                    // The four cells around the edge, which is another one of each.
                    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                    let around = [(1, 1), (0, 1), (0, 0), (1, 0)].map(|(a, b)| {
                        let (back, corner) = ([step(u, a), step(v, b)], (a << u) | (b << v));
                        let cell = [0, 1, 2].map(|x| [i, j, k][x] - back[0][x] - back[1][x]);
                        vertex_of[&(cell[0], cell[1], cell[2], edge(axis, corner))]
                    });
                    let [a, b, c, d] = around;
                    quads.push(if here { [a, b, c, d] } else { [a, d, c, b] });
                }
            }
        }
    }
    relax(field, &quads, &mut positions, size);
    let landmarks = snap(&mut positions, landmarks, size);
    BoneHalf {
        version: 1,
        midline: positions.iter().map(|p| p.x == 0.0).collect(),
        faces: quads.iter().flat_map(|&quad| cut(&positions, quad)).map(|f| f.map(|v| v as u16)).collect(),
        base: positions.iter().map(|p| p.to_array().map(|x| (x * 1e3).round() / 1e3)).collect(),
        landmarks,
    }
}

/// The edge of a cell along an axis from a corner; corners are numbered by bits of x, y, z.
fn edge(axis: usize, corner: usize) -> usize {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    4 * axis + (corner >> u & 1) + 2 * (corner >> v & 1)
}

/// The two corners of an edge.
fn ends(edge: usize) -> (usize, usize) {
    let axis = edge / 4;
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let from = ((edge & 1) << u) | ((edge >> 1 & 1) << v);
    (from, from | 1 << axis)
}

/// Which edges of a cell one sheet of the surface cuts, by the least of them. Across a face on which inside corners stand
/// diagonally, they are taken for separate: the cell on the other side sees the same.
fn sheets(values: &[f32; 8]) -> [Option<usize>; 12] {
    let inside = |c: usize| values[c] < 0.0;
    let mut sheet: [Option<usize>; 12] = std::array::from_fn(|e| {
        let (a, b) = ends(e);
        (inside(a) != inside(b)).then_some(e)
    });
    let mut join = |a: usize, b: usize| {
        if let (Some(x), Some(y)) = (sheet[a], sheet[b]) {
            let (low, high) = (x.min(y), x.max(y));
            sheet.iter_mut().filter(|s| **s == Some(high)).for_each(|s| *s = Some(low));
        }
    };
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for side in [0, 1 << axis] {
            let corners = [0, 1 << u, 1 << u | 1 << v, 1 << v].map(|c| c | side);
            let edges = [edge(u, corners[0]), edge(v, corners[1]), edge(u, corners[3]), edge(v, corners[0])];
            let cut: Vec<usize> = (0..4).filter(|&k| inside(corners[k]) != inside(corners[(k + 1) % 4])).collect();
            if let [a, b] = cut[..] {
                join(edges[a], edges[b]);
            }
            if cut.len() == 4 {
                (0..4).filter(|&k| inside(corners[k])).for_each(|k| join(edges[(k + 3) % 4], edges[k]));
            }
        }
    }
    sheet
}

/// Each vertex to the middle of its neighbours, then back onto the surface.
fn relax(field: &BoneField, quads: &[[u32; 4]], positions: &mut [Vec3], size: f32) {
    for _ in 0..ROUNDS {
        let mut sums = vec![(Vec3::ZERO, 0.0_f32); positions.len()];
        let mut add = |v: u32, p: Vec3| {
            sums[v as usize].0 += p;
            sums[v as usize].1 += 1.0;
        };
        for quad in quads {
            for k in 0..4 {
                let (a, b) = (quad[k], quad[(k + 1) % 4]);
                let (p, q) = (positions[a as usize], positions[b as usize]);
                add(a, q);
                add(b, p);
                // The mirror image of what lies across the median plane.
                if p.x == 0.0 && q.x > 0.0 {
                    add(a, q * vec3(-1.0, 1.0, 1.0));
                }
                if q.x == 0.0 && p.x > 0.0 {
                    add(b, p * vec3(-1.0, 1.0, 1.0));
                }
            }
        }
        for (p, (sum, n)) in positions.iter_mut().zip(sums) {
            let middle = p.x == 0.0;
            *p = field.project(p.lerp(sum / n, 0.5), 0.4 * size, 2);
            p.x = if middle { 0.0 } else { p.x.max(0.1 * size) };
        }
    }
}

/// The nearest vertex of each landmark becomes it, and takes its neighbours some of the way.
fn snap(positions: &mut [Vec3], landmarks: &[&Landmark], size: f32) -> Vec<(String, u16)> {
    let mut found = Vec::new();
    for landmark in landmarks {
        let at = landmark.canonical;
        let near = |v: &usize| {
            let p = positions[*v];
            let fits = (at.x == 0.0) == (p.x == 0.0) && !found.iter().any(|(_, u)| usize::from(*u) == *v);
            if fits { p.distance_squared(at) } else { f32::INFINITY }
        };
        let nearest = (0..positions.len()).min_by(|a, b| near(a).total_cmp(&near(b))).unwrap_or(0);
        let by = at - positions[nearest];
        for (v, p) in positions.iter_mut().enumerate() {
            let reach = (1.0 - p.distance(at - by) / (4.0 * size)).clamp(0.0, 1.0);
            let middle = p.x == 0.0;
            if v != nearest && !found.iter().any(|(_, u)| usize::from(*u) == v) {
                *p += by * (reach * reach * (3.0 - 2.0 * reach));
            }
            if middle {
                p.x = 0.0;
            }
        }
        positions[nearest] = at;
        found.push((landmark.id.to_owned(), nearest as u16));
    }
    found
}

/// Two triangles, along the shorter diagonal.
fn cut(positions: &[Vec3], [a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    let length = |a: u32, b: u32| positions[a as usize].distance_squared(positions[b as usize]);
    if length(a, c) <= length(b, d) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] }
}
