//! Bodies of triangles asked from the definition: inside or not, and how far from the surface.

use glam::Vec3;

/// A triangle mesh, counter-clockwise seen from outside; small holes count as closed.
pub struct Solid<'a> {
    /// Positions.
    pub at: &'a [Vec3],
    /// Three for each triangle.
    pub indices: &'a [u32],
}

impl Solid<'_> {
    fn triangles(&self) -> impl Iterator<Item = [Vec3; 3]> + '_ {
        self.indices.chunks_exact(3).map(|t| [0, 1, 2].map(|k| self.at[t[k] as usize]))
    }

    /// How far a point is from the nearest triangle.
    pub fn distance(&self, p: Vec3) -> f32 {
        self.triangles().map(|t| to_triangle(p, t)).fold(f32::INFINITY, f32::min)
    }

    /// Whether the surface goes round a point (the generalised winding number of Jacobson, Kavan and Sorkine-Hornung 2013;
    /// the solid angles after van Oosterom and Strackee 1983).
    pub fn holds(&self, p: Vec3) -> bool {
        let angle = |[a, b, c]: [Vec3; 3]| {
            let [a, b, c] = [a, b, c].map(|v| (v - p).as_dvec3());
            let [x, y, z] = [a, b, c].map(|v| v.length());
            let below = x * y * z + a.dot(b) * z + b.dot(c) * x + c.dot(a) * y;
            2.0 * a.dot(b.cross(c)).atan2(below)
        };
        self.triangles().map(angle).sum::<f64>() > std::f64::consts::TAU
    }

    /// How deep the deepest of some points lies inside; 0 where none does.
    pub fn depth(&self, points: &[Vec3]) -> f32 {
        let (low, high) = self.at.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(l, h), &p| (l.min(p), h.max(p)));
        let near = points.iter().filter(|p| p.cmpge(low).all() && p.cmple(high).all() && self.holds(**p));
        near.map(|&p| self.distance(p)).fold(0.0, f32::max)
    }
}

/// Distance from a triangle, by the regions of its corners and sides (Ericson 2004, "Real-time collision detection", 5.1.5).
fn to_triangle(p: Vec3, [a, b, c]: [Vec3; 3]) -> f32 {
    let on_side = |a: Vec3, b: Vec3| {
        let t = ((p - a).dot(b - a) / (b - a).length_squared().max(1e-30)).clamp(0.0, 1.0);
        p.distance(a.lerp(b, t))
    };
    let sides = on_side(a, b).min(on_side(b, c)).min(on_side(c, a));
    let normal = (b - a).cross(c - a);
    let inside = [(a, b), (b, c), (c, a)].iter().all(|&(u, v)| (v - u).cross(p - u).dot(normal) >= 0.0);
    let size = normal.length();
    if inside && size > 0.0 { sides.min((p - a).dot(normal).abs() / size) } else { sides }
}
