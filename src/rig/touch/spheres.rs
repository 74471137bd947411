//! A body as a bounded number of spheres that cover its surface and hardly stick out of it.
//!
//! At every vertex stands the largest ball inside the body that touches it there and holds no other vertex: its centre lies
//! on the medial axis (the fixed point of the shrinking ball of Ma, Bae and Choi 2012, "3D medial axis point approximation
//! using nearest neighbors and the normal field"; over a few hundred vertices all are asked at once). Of these balls the
//! one that covers most of what is still bare is taken, until nothing is (the greedy cover of Chvátal 1979).

use crate::math::frames::mirrored;
use glam::Vec3;

/// A ball. Metres, head's frame.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sphere {
    /// Its middle.
    pub centre: Vec3,
    /// Its radius.
    pub radius: f32,
}

impl Sphere {
    /// How far a point lies outside; negative inside.
    pub fn distance(&self, p: Vec3) -> f32 {
        self.centre.distance(p) - self.radius
    }

    /// The mirror image in the median plane.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        Self { centre: mirrored(self.centre), ..*self }
    }
}

/// How close a cover has to be. Lengths in the unit of the body.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// By how much a sphere is larger than the ball inside the body.
    pub grow: f32,
    /// How far outside all spheres a vertex may lie, and a ball outside the body: a sphere sticks out by both at most.
    pub miss: f32,
    /// How many spheres there may be on one side of the median plane, those across it counted in. Where more would be
    /// needed they grow further.
    pub most: usize,
}

/// By what spheres grow further where a cover has too many of them, and how often.
const WIDER: f32 = 1.3;
const TIMES: usize = 12;

/// A closed or open body: vertices, and triangles counter-clockwise seen from outside.
#[derive(Clone, Copy, Debug)]
pub struct Body<'a> {
    /// Positions.
    pub at: &'a [Vec3],
    /// Three for each triangle, each below the number of positions.
    pub indices: &'a [u32],
}

/// Refined vertices of the median plane lie off it by less than this, metres.
const MEDIAN: f32 = 1e-6;

/// Spheres that cover the vertices that are `wanted`, added to `out`. Of a `symmetric` body the left half is covered and
/// mirrored. Returns the fit that was kept to, which is the one asked for unless that took too many spheres.
pub fn cover(body: Body, fit: Fit, symmetric: bool, wanted: impl Fn(Vec3) -> bool, out: &mut Vec<Sphere>) -> Fit {
    let is_left = |p: Vec3| !symmetric || p.x > -MEDIAN;
    let wanted: Vec<usize> = (0..body.at.len()).filter(|&v| is_left(body.at[v]) && wanted(body.at[v])).collect();
    let normals = normals(body);
    let faces = Faces::new(body);
    let balls: Vec<Sphere> =
        wanted.iter().map(|&v| within(&faces, body.at[v], ball(body.at, v, normals[v]), fit.miss)).collect();
    let targets: Vec<Vec3> = wanted.iter().map(|&v| body.at[v]).collect();
    let mut fit = fit;
    let mut chosen = Vec::new();
    for _ in 0..TIMES {
        if greedy(&balls, &targets, fit, symmetric, &mut chosen) {
            break;
        }
        fit.grow *= WIDER;
    }
    // In the order of the vertices, whatever order the cover was found in.
    chosen.sort_unstable();
    for &k in &chosen {
        let sphere = Sphere { radius: balls[k].radius + fit.grow, ..balls[k] };
        out.push(sphere);
        if symmetric && sphere.centre.x != 0.0 {
            out.push(sphere.mirrored());
        }
    }
    fit
}

/// Unit normals of the vertices, area-weighted; zero where there is no triangle.
fn normals(body: Body) -> Vec<Vec3> {
    let mut sums = vec![Vec3::ZERO; body.at.len()];
    for &[a, b, c] in body.indices.as_chunks::<3>().0 {
        let [p, q, r] = [a, b, c].map(|v| body.at[v as usize]);
        let area = (q - p).cross(r - p);
        [a, b, c].into_iter().for_each(|v| sums[v as usize] += area);
    }
    // A body of metres has areas that are too small for the threshold of zero.
    sums.iter().map(|n| (*n / n.abs().max_element().max(f32::MIN_POSITIVE)).normalize_or_zero()).collect()
}

/// The largest ball inside that touches vertex `v` and holds no other. The ball through `p` and `q` whose middle lies behind
/// `p` along its normal has the radius |p - q|² / 2 n·(p - q).
fn ball(at: &[Vec3], v: usize, normal: Vec3) -> Sphere {
    let p = at[v];
    let mut radius = f32::INFINITY;
    for &q in at {
        let (off, behind) = (p.distance_squared(q), normal.dot(p - q));
        if behind > 0.0 && off < 2.0 * radius * behind {
            radius = off / (2.0 * behind);
        }
    }
    // A lone vertex or one without a normal is covered by what it grows by.
    let radius = if radius.is_finite() { radius } else { 0.0 };
    Sphere { centre: p - normal * radius, radius }
}

/// How often a ball is made smaller at most, and by what.
const SHRINKS: usize = 16;
const SMALLER: f32 = 0.75;

/// The ball that touches the surface at `p`, so small that it pokes through triangles by no more than `poke`: between
/// vertices that stand far apart it could come out of the body.
fn within(faces: &Faces, p: Vec3, ball: Sphere, poke: f32) -> Sphere {
    let mut ball = ball;
    for _ in 0..SHRINKS {
        if ball.radius - faces.nearest(ball) <= poke {
            break;
        }
        ball = Sphere { centre: p.lerp(ball.centre, SMALLER), radius: SMALLER * ball.radius };
    }
    ball
}

/// Triangles in the order of their first corners' z.
struct Faces {
    corners: Vec<[Vec3; 3]>,
    longest: f32,
}

impl Faces {
    fn new(body: Body) -> Self {
        let faces = body.indices.as_chunks::<3>().0.iter();
        let mut corners: Vec<[Vec3; 3]> = faces.map(|face| face.map(|v| body.at[v as usize])).collect();
        corners.sort_by(|f, g| f[0].z.total_cmp(&g[0].z));
        let longest = corners.iter().map(|[a, b, c]| a.distance(*b).max(a.distance(*c))).fold(0.0, f32::max);
        Self { corners, longest }
    }

    /// How far the nearest triangle is from a ball's middle; no more than the radius.
    fn nearest(&self, ball: Sphere) -> f32 {
        let mut near = ball.radius;
        let reach = ball.radius + self.longest;
        let first = self.corners.partition_point(|[a, ..]| a.z < ball.centre.z - reach);
        for &[a, b, c] in self.corners[first..].iter().take_while(|[a, ..]| a.z <= ball.centre.z + reach) {
            let corner = a - ball.centre;
            // Most are too far whatever their shape.
            if corner.length_squared() < (near + self.longest) * (near + self.longest) {
                near = near.min(from_origin([corner, b - ball.centre, c - ball.centre]));
            }
        }
        near
    }
}

/// Distance of a triangle from the origin, by the regions of its corners and sides (Ericson 2004, "Real-time collision
/// detection", 5.1.5).
fn from_origin([a, b, c]: [Vec3; 3]) -> f32 {
    let to_side = |p: Vec3, q: Vec3| {
        let along = q - p;
        let t = (-p.dot(along) / along.length_squared().max(f32::MIN_POSITIVE)).clamp(0.0, 1.0);
        (p + along * t).length()
    };
    let normal = (b - a).cross(c - a);
    let size = normal.length();
    let over = [(a, b), (b, c), (c, a)].iter().all(|&(p, q)| p.cross(q).dot(normal) >= 0.0);
    if over && size > 0.0 { a.dot(normal).abs() / size } else { to_side(a, b).min(to_side(b, c)).min(to_side(c, a)) }
}

/// Chooses balls that cover all targets (one ball for each target, with its own among them); whether they are few enough.
fn greedy(balls: &[Sphere], targets: &[Vec3], fit: Fit, symmetric: bool, chosen: &mut Vec<usize>) -> bool {
    chosen.clear();
    let words = targets.len().div_ceil(64);
    let mut covers = vec![0_u64; words * balls.len()];
    for (k, ball) in balls.iter().enumerate() {
        let reach = ball.radius + fit.grow + fit.miss;
        for (t, &p) in targets.iter().enumerate() {
            // The mirror image covers too.
            let image = symmetric && mirrored(ball.centre).distance_squared(p) <= reach * reach;
            if image || ball.centre.distance_squared(p) <= reach * reach {
                covers[k * words + t / 64] |= 1 << (t % 64);
            }
        }
    }
    let mut bare = vec![u64::MAX; words];
    if let (Some(last), over @ 1..) = (bare.last_mut(), targets.len() % 64) {
        *last = (1 << over) - 1;
    }
    while bare.iter().any(|&word| word != 0) {
        if chosen.len() == fit.most {
            return false;
        }
        let gain = |k: &usize| -> u32 {
            covers[k * words..][..words].iter().zip(&bare).map(|(c, b)| (c & b).count_ones()).sum()
        };
        // Of equals the first.
        let Some(best) = (0..balls.len()).rev().max_by_key(gain) else { return true };
        chosen.push(best);
        bare.iter_mut().zip(&covers[best * words..]).for_each(|(b, c)| *b &= !c);
    }
    true
}

/// Most spheres on one side of a polyline.
const MOST_ON_SIDE: f32 = 32.0;

/// Places along the polyline through `points` at which spheres of that radius cover it: both ends of each side, and between
/// them so many that none are more than a diameter apart, up to a bound. Calls `add` with the number of a side, the part of
/// the way along it, and the place.
pub fn chain(points: &[Vec3], radius: f32, mut add: impl FnMut(usize, f32, Vec3)) {
    for (side, ends) in points.windows(2).enumerate() {
        let n = (ends[0].distance(ends[1]) / (2.0 * radius)).ceil().clamp(1.0, MOST_ON_SIDE) as usize;
        for i in 0..n {
            let t = i as f32 / n as f32;
            add(side, t, ends[0].lerp(ends[1], t));
        }
    }
    if let (Some(&last), Some(side)) = (points.last(), points.len().checked_sub(2)) {
        add(side, 1.0, last);
    }
}
