//! Whether anything of a head lies between an eye and a point of it.

use crate::frame::Frame;
use glam::{DVec3, Vec3};

/// Everything of a head that hides what is behind it.
#[derive(Clone, Debug)]
pub struct Sight {
    triangles: Vec<[DVec3; 3]>,
    /// How far from a point the way to the eye begins, metres: the faces around the point are not in its way.
    bias: f64,
}

/// Where it is looked from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Eyepoint {
    /// A point, metres, in the head's frame.
    At(Vec3),
    /// So far away that only the direction towards it counts.
    Towards(Vec3),
}

impl Sight {
    /// Of all parts of a frame but the whiskers.
    pub fn new(frame: &Frame<'_>) -> Self {
        let mut triangles = Vec::with_capacity(frame.n_triangles());
        for part in frame.body() {
            let corner = |v: u32| part.positions[v as usize].as_dvec3();
            triangles.extend(part.topology.indices.chunks_exact(3).map(|t| [corner(t[0]), corner(t[1]), corner(t[2])]));
        }
        let (low, high) = frame.bounds();
        Self { triangles, bias: f64::from(low.distance(high)) * 1e-3 }
    }

    /// Whether nothing lies between the point (metres, head's frame) and the eye. A point on the skin is hidden by the
    /// head itself when it lies on the far side.
    pub fn is_open(&self, point: Vec3, eye: Eyepoint) -> bool {
        let point = point.as_dvec3();
        let way = match eye {
            Eyepoint::At(eye) => eye.as_dvec3() - point,
            Eyepoint::Towards(direction) => direction.as_dvec3(),
        };
        let direction = way.normalize_or_zero();
        let end = if matches!(eye, Eyepoint::At(_)) { way.length() } else { f64::INFINITY };
        let hits = self.triangles.iter().filter_map(|t| hit(point, direction, t));
        !hits.into_iter().any(|distance| distance > self.bias && distance < end)
    }
}

/// The distance at which a ray meets a triangle from either side (Möller and Trumbore 1997, "Fast, minimum storage
/// ray-triangle intersection").
fn hit(origin: DVec3, direction: DVec3, [a, b, c]: &[DVec3; 3]) -> Option<f64> {
    let (ab, ac) = (*b - *a, *c - *a);
    let across = direction.cross(ac);
    let det = ab.dot(across);
    let from = origin - *a;
    let u = from.dot(across) / det;
    let around = from.cross(ab);
    let v = direction.dot(around) / det;
    // Parallel rays have no finite u and v and fail these.
    let inside = u >= 0.0 && v >= 0.0 && u + v <= 1.0;
    inside.then(|| ac.dot(around) / det)
}
