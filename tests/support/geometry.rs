//! Measures of triangle meshes: volume, folds, triangles that cross. In double precision, from the definition.

use glam::{DVec3, Vec3};
use std::collections::BTreeMap;

/// A mesh whose numbers are asked for.
pub struct Shape<'a> {
    /// Corners.
    pub positions: &'a [Vec3],
    /// Three for each triangle.
    pub indices: &'a [u32],
}

impl Shape<'_> {
    fn triangle(&self, face: usize) -> [DVec3; 3] {
        [0, 1, 2].map(|k| self.positions[self.indices[3 * face + k] as usize].as_dvec3())
    }

    fn n_faces(&self) -> usize {
        self.indices.len() / 3
    }

    /// Area of each triangle.
    pub fn areas(&self) -> impl Iterator<Item = f64> + '_ {
        (0..self.n_faces()).map(|f| {
            let [a, b, c] = self.triangle(f);
            0.5 * (b - a).cross(c - a).length()
        })
    }

    /// Volume under the mesh once each boundary (vertices in the direction of its directed edges) is closed by a fan.
    pub fn volume(&self, boundaries: &[Vec<u32>]) -> f64 {
        let at = |v: u32| self.positions[v as usize].as_dvec3();
        let under = |a: DVec3, b: DVec3, c: DVec3| a.dot(b.cross(c)) / 6.0;
        let skin: f64 = (0..self.n_faces()).map(|f| self.triangle(f)).map(|[a, b, c]| under(a, b, c)).sum();
        let lids = boundaries.iter().map(|l| {
            let middle = l.iter().map(|&v| at(v)).sum::<DVec3>() / l.len() as f64;
            (0..l.len()).map(|i| under(middle, at(l[(i + 1) % l.len()]), at(l[i]))).sum::<f64>()
        });
        skin + lids.sum::<f64>()
    }

    /// Edges (lower vertex first) with the angle between the normals of their two triangles, degrees; 180 is folded flat.
    pub fn folds(&self) -> Vec<([u32; 2], f64)> {
        let mut sides: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
        for (face, t) in self.indices.chunks_exact(3).enumerate() {
            for k in 0..3 {
                let (a, b) = (t[k], t[(k + 1) % 3]);
                sides.entry([a.min(b), a.max(b)]).or_default().push(face);
            }
        }
        let normal = |face: usize| {
            let [a, b, c] = self.triangle(face);
            (b - a).cross(c - a).normalize_or_zero()
        };
        let both = sides.into_iter().filter(|(_, faces)| faces.len() == 2);
        both.map(|(edge, f)| (edge, normal(f[0]).dot(normal(f[1])).clamp(-1.0, 1.0).acos().to_degrees())).collect()
    }

    /// Pairs of triangles that cross each other and share no vertex.
    pub fn crossings(&self) -> Vec<[usize; 2]> {
        let boxes: Vec<(DVec3, DVec3)> =
            (0..self.n_faces()).map(|f| self.triangle(f)).map(|[a, b, c]| (a.min(b).min(c), a.max(b).max(c))).collect();
        let mut order: Vec<usize> = (0..self.n_faces()).collect();
        order.sort_by(|&a, &b| boxes[a].0.z.total_cmp(&boxes[b].0.z));
        let mut found = Vec::new();
        for (i, &f) in order.iter().enumerate() {
            let (low, high) = boxes[f];
            for &g in order[i + 1..].iter().take_while(|&&g| boxes[g].0.z <= high.z) {
                let apart = boxes[g].0.cmpgt(high).any() || low.cmpgt(boxes[g].1).any();
                if !apart && !self.share_a_vertex(f, g) && cross(self.triangle(f), self.triangle(g)) {
                    found.push([f.min(g), f.max(g)]);
                }
            }
        }
        found
    }

    fn share_a_vertex(&self, f: usize, g: usize) -> bool {
        let (f, g) = (&self.indices[3 * f..3 * f + 3], &self.indices[3 * g..3 * g + 3]);
        f.iter().any(|v| g.contains(v))
    }
}

/// Whether a side of one triangle goes through the other.
fn cross(a: [DVec3; 3], b: [DVec3; 3]) -> bool {
    let pierces = |s: [DVec3; 3], t: [DVec3; 3]| {
        (0..3).any(|k| {
            let along = s[(k + 1) % 3] - s[k];
            hit(s[k], along, t).is_some_and(|reach| (0.0..=1.0).contains(&reach))
        })
    };
    pierces(a, b) || pierces(b, a)
}

/// How many times `direction` from `origin` to the triangle (Möller and Trumbore 1997), if the line meets it.
pub fn hit(origin: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (e, f) = (b - a, c - a);
    let p = direction.cross(f);
    let volume = e.dot(p);
    if volume == 0.0 {
        return None;
    }
    let from = origin - a;
    let u = from.dot(p) / volume;
    let q = from.cross(e);
    let v = direction.dot(q) / volume;
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| f.dot(q) / volume)
}

/// Distance of a point outside a polygon of the plane; 0 inside.
pub fn outside(polygon: &[[f64; 2]], [x, y]: [f64; 2]) -> f64 {
    let mut inside = false;
    let mut nearest = f64::INFINITY;
    for (i, &[ax, ay]) in polygon.iter().enumerate() {
        let [bx, by] = polygon[(i + 1) % polygon.len()];
        if (ay > y) != (by > y) && x < ax + (bx - ax) * (y - ay) / (by - ay) {
            inside = !inside;
        }
        let (dx, dy) = (bx - ax, by - ay);
        let t = (((x - ax) * dx + (y - ay) * dy) / (dx * dx + dy * dy).max(1e-30)).clamp(0.0, 1.0);
        nearest = nearest.min((x - ax - t * dx).hypot(y - ay - t * dy));
    }
    if inside { 0.0 } else { nearest }
}
