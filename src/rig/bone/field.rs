//! The bone as signed distances: cheap to ask for inside, outside and how far, for any head.
//!
//! Bodies hang on the landmarks, so that the field of a breed is that of its own skull. Navarro Newball, Wyvill and McCane
//! 2008 ask for such a model to keep skin outside bone.

use super::landmarks::{BoneMesh, Targets};
use crate::rig::lanes::{F8, P8};
use crate::rig::primitives::{Cone, Ellipsoid, smax, smin};
use glam::{Vec3, vec3};

/// Something that is added or taken away, and over what distance it is blended in.
#[derive(Clone, Debug)]
struct Body {
    shape: Shape,
    blend: f32,
    adds: bool,
    bound: Bound,
}

/// What a body is never nearer than: `slope` times the distance from `centre`, less `reach`.
#[derive(Clone, Copy, Debug)]
struct Bound {
    centre: Vec3,
    slope: f32,
    reach: f32,
}

impl Bound {
    /// Of a shape of which nothing is known.
    const NONE: Self = Self { centre: Vec3::ZERO, slope: 0.0, reach: f32::INFINITY };
    /// Rounding moves a distance of this head by far less, canonical millimetres.
    const ROUNDING: f32 = 0.05;

    fn new(shape: &Shape) -> Self {
        let (centre, slope, reach) = match shape {
            Shape::Ellipsoid(body) => body.bound(),
            // What is squeezed is farther in its own space.
            Shape::Cone(body, flat) if *flat <= 1.0 => {
                let (centre, reach) = body.bound();
                (centre * vec3(*flat, 1.0, 1.0), 1.0, reach)
            }
            _ => return Self::NONE,
        };
        Self { centre, slope, reach: reach + Self::ROUNDING }
    }
}

/// A ball about eight points.
struct Block {
    middle: Vec3,
    radius: f32,
}

impl Block {
    #[inline(always)]
    fn new(p: &P8) -> Self {
        let [x, y, z] = [p.x.range(), p.y.range(), p.z.range()];
        let (low, high) = (vec3(x.0, y.0, z.0), vec3(x.1, y.1, z.1));
        Self { middle: 0.5 * (low + high), radius: 0.5 * (high - low).length() }
    }

    /// No point is nearer to the body; a distance as its shape counts it.
    #[inline(always)]
    fn nearest(&self, body: &Body) -> f32 {
        let Bound { centre, slope, reach } = body.bound;
        slope * (self.middle.distance(centre) - self.radius) - reach
    }
}

#[derive(Clone, Debug)]
enum Shape {
    Ellipsoid(Ellipsoid),
    /// The second is how much wider it is to the sides than it is high.
    Cone(Cone, f32),
    /// A tube of elliptic sections along the face: half width, bottom and top at each of its stations, and how much
    /// narrower it is above.
    Face([Station; STATIONS]),
    /// What lies above a plane.
    Above(Vec3, f32),
}

/// What is nearer than this is asked for, canonical millimetres.
const NEAR: f32 = 2.0;
/// Where the nearest body is farther by so much, blends have no part in what is near, canonical millimetres.
const BLENDED: f32 = 28.0;

/// Stations of the face.
const STATIONS: usize = 7;

#[derive(Clone, Copy, Debug)]
struct Station {
    z: f32,
    bottom: f32,
    top: f32,
    half_width: f32,
    half_width_top: f32,
}

/// One bone of one head. Inside it reckons in canonical millimetres of that head, whatever unit its landmarks have.
#[derive(Clone, Debug)]
pub struct BoneField {
    bodies: Vec<Body>,
    unit: f32,
}

impl Default for BoneField {
    fn default() -> Self {
        Self { bodies: Vec::new(), unit: 1.0 }
    }
}

impl Shape {
    #[inline(always)]
    fn eval(&self, p: P8) -> F8 {
        match self {
            Shape::Ellipsoid(body) => body.eval(p),
            Shape::Cone(body, flat) => body.eval(P8 { x: p.x * (1.0 / flat), ..p }),
            Shape::Face(stations) => face(stations, p),
            Shape::Above(normal, height) => p.dot(*normal) - *height,
        }
    }
}

#[inline(always)]
fn face(stations: &[Station; STATIONS], p: P8) -> F8 {
    F8(std::array::from_fn(|i| {
        let (x, y, z) = (p.x.0[i], p.y.0[i], p.z.0[i]);
        let last = stations.len() - 2;
        let k = stations[1..].iter().position(|s| z <= s.z).unwrap_or(last).min(last);
        let (a, b) = (stations[k], stations[k + 1]);
        let t = ((z - a.z) / (b.z - a.z)).clamp(0.0, 1.0);
        let mix = |a: f32, b: f32| a + t * (b - a);
        let (bottom, top) = (mix(a.bottom, b.bottom), mix(a.top, b.top));
        let (wide, narrow) = (mix(a.half_width, b.half_width), mix(a.half_width_top, b.half_width_top));
        let (middle, half) = (0.5 * (bottom + top), 0.5 * (top - bottom));
        let v = ((y - bottom) / (top - bottom)).clamp(0.0, 1.0);
        let width = wide + v * (narrow - wide);
        let round = 0.45 * narrow.min(half);
        let q = vec3(x - (width - round), (y - middle).abs() - (half - round), {
            let (z0, z1) = (stations[0].z, stations[last + 1].z);
            (z - 0.5 * (z0 + z1)).abs() - (0.5 * (z1 - z0) - round)
        });
        q.max(Vec3::ZERO).length() + q.max_element().min(0.0) - round
    }))
}

impl BoneField {
    /// The field of a bone with these landmarks; `unit` is a canonical millimetre of that head, in the landmarks' unit.
    pub fn new(bone: BoneMesh, t: &Targets<Vec3>, unit: f32) -> BoneField {
        let mut field = Self::default();
        field.place(bone, t, unit);
        field
    }

    /// Makes it the field of another head, in the memory that it has.
    pub fn place(&mut self, bone: BoneMesh, t: &Targets<Vec3>, unit: f32) {
        self.unit = unit;
        self.bodies.clear();
        let t = t.map(|p| p * (1.0 / unit));
        match bone {
            BoneMesh::Skull => skull(&t, &mut self.bodies),
            BoneMesh::Mandible => mandible(&t, &mut self.bodies),
        }
    }

    /// Signed distance at eight points: negative inside.
    pub fn distance8(&self, p: P8) -> F8 {
        distance8(self, p, 1e3)
    }

    /// The same for less work: where it is less than 2 canonical mm within a thousandth of one, elsewhere something between
    /// these and the distance.
    pub fn near8(&self, p: P8) -> F8 {
        distance8(self, p, NEAR + BLENDED)
    }

    #[inline(always)]
    fn eval(&self, p: P8, far: f32) -> F8 {
        let s = 1.0 / self.unit;
        let p = P8 { x: p.x.abs() * s, y: p.y * s, z: p.z * s };
        let block = Block::new(&p);
        let mut d = F8::splat(far);
        // No lane of it is larger, nor any less than the least.
        let (mut least, mut most) = (far, far);
        for body in &self.bodies {
            // Farther than the blend reaches, a body changes no bit: what it would add is zero.
            let nearest = block.nearest(body);
            if nearest > if body.adds { most + body.blend } else { body.blend - least } {
                continue;
            }
            let other = body.shape.eval(p);
            d = if body.adds { smin(d, other, body.blend) } else { smax(d, -other, body.blend) };
            (least, most) = d.range();
        }
        d * self.unit
    }

    /// Signed distance at one point.
    pub fn distance(&self, p: Vec3) -> f32 {
        self.distance8(P8 { x: F8::splat(p.x), y: F8::splat(p.y), z: F8::splat(p.z) }).0[0]
    }

    /// Signed distance and its gradient, by central differences over `h`.
    pub fn sample(&self, p: Vec3, h: f32) -> (f32, Vec3) {
        let off = |k: usize, axis: usize| match k {
            _ if k / 2 == axis && k < 6 => {
                if k.is_multiple_of(2) {
                    h
                } else {
                    -h
                }
            }
            _ => 0.0,
        };
        let lane = |axis: usize| F8(std::array::from_fn(|k| p[axis] + off(k, axis)));
        let d = self.distance8(P8 { x: lane(0), y: lane(1), z: lane(2) }).0;
        (d[6], vec3(d[0] - d[1], d[2] - d[3], d[4] - d[5]) / (2.0 * h))
    }

    /// The point moved onto the surface, by a few Newton steps of at most `cap`.
    pub fn project(&self, mut p: Vec3, cap: f32, steps: usize) -> Vec3 {
        for _ in 0..steps {
            let (d, g) = self.sample(p, 0.02 * cap);
            p -= (g * (d / g.length_squared().max(0.05))).clamp_length_max(cap);
        }
        p
    }
}

/// Collects bodies; lengths in canonical millimetres of the head at hand.
struct Bodies<'a>(&'a mut Vec<Body>);

impl Bodies<'_> {
    fn push(&mut self, shape: Shape, blend: f32, adds: bool) {
        let bound = Bound::new(&shape);
        self.0.push(Body { shape, blend, adds, bound });
    }
    fn ball(&mut self, centre: Vec3, radii: Vec3, blend: f32, adds: bool) {
        self.push(Shape::Ellipsoid(Ellipsoid::new(centre, radii)), blend, adds);
    }
    fn bar(&mut self, points: &[(Vec3, f32)], blend: f32) {
        for pair in points.windows(2) {
            let cone = Cone::new(pair[0].0, pair[1].0, pair[0].1, pair[1].1);
            self.push(Shape::Cone(cone, 1.0), blend, true);
        }
    }
    /// A bar that is flat to the sides: `flat` times as wide as high.
    fn plate(&mut self, points: &[(Vec3, f32)], flat: f32, blend: f32) {
        let squeeze = vec3(1.0 / flat, 1.0, 1.0);
        for pair in points.windows(2) {
            let cone = Cone::new(pair[0].0 * squeeze, pair[1].0 * squeeze, pair[0].1, pair[1].1);
            self.push(Shape::Cone(cone, flat), blend, true);
        }
    }
}

fn skull(t: &Targets<Vec3>, bodies: &mut Vec<Body>) {
    let mm = vec3;
    let mut b = Bodies(bodies);
    let on_midline = |y: f32, z: f32| vec3(0.0, y, z);

    // Braincase, frontal bones, base.
    let top = t.vertex.y - 1.5;
    let (bottom, back) = (t.synsphenion.y + 1.0, t.opisthion.z + 2.0);
    let (middle_z, depth) = (t.euryon.z - 1.0, t.euryon.z - 1.0 - back);
    b.ball(
        on_midline(0.5 * (top + bottom), middle_z),
        vec3(t.euryon.x, 0.5 * (top - bottom), depth.max(20.0)),
        1.0,
        true,
    );
    b.ball(
        on_midline(0.5 * (t.bregma.y + t.synsphenion.y) + 3.0, t.bregma.z),
        vec3(0.78 * t.euryon.x, 0.42 * (t.bregma.y - t.synsphenion.y), 27.0),
        12.0,
        true,
    );
    let brow = t.glabella.y - 0.5;
    b.ball(on_midline(brow - 14.5, t.frontostenion.z + 5.0), vec3(t.frontostenion.x * 1.05, 14.0, 30.0), 16.0, true);
    b.ball(t.glabella + mm(9.0, -11.0, 2.0), mm(12.0, 11.0, 15.0), 12.0, true);
    b.bar(
        &[
            (on_midline(t.basion.y + 8.0, t.basion.z + 6.0), 8.0),
            (t.synsphenion + mm(0.0, 6.5, 0.0), 6.5),
            (t.staphylion + mm(0.0, 9.0, -6.0), 6.0),
        ],
        8.0,
    );
    b.bar(&[(t.akrokranion + mm(0.0, -6.0, 9.0), 9.0), (t.opisthion + mm(0.0, 6.0, 7.0), 7.5)], 10.0);
    // Zygomatic processes of the frontals.
    b.bar(&[(t.glabella + mm(12.0, -8.0, 0.0), 6.5), (t.ectorbitale + mm(-3.0, -1.0, 0.0), 2.8)], 10.0);
    // Temporal lines, sagittal and nuchal crest.
    b.bar(
        &[
            (t.ectorbitale + mm(-3.0, 0.0, -1.0), 2.6),
            (t.bregma - mm(-4.0, 4.0, -14.0), 2.4),
            (t.vertex - mm(0.0, 5.2, 0.0), 2.6),
        ],
        9.0,
    );
    b.bar(
        &[
            (t.bregma - mm(0.0, 5.5, 0.0), 2.0),
            (t.vertex - mm(0.0, 5.0, 0.0), 2.6),
            (t.akrokranion + mm(0.0, -1.5, 5.0), 3.6),
        ],
        9.0,
    );
    b.bar(
        &[
            (t.akrokranion + mm(0.0, -1.0, 4.0), 3.6),
            (0.5 * (t.akrokranion + t.asterion) + mm(1.0, 5.0, 3.0), 3.4),
            (t.asterion + mm(-3.2, 0.0, 2.0), 3.6),
        ],
        9.0,
    );
    b.bar(&[(t.asterion + mm(-3.5, 0.0, 2.0), 4.0), (t.meatus + mm(-5.0, 7.0, -5.0), 6.5)], 10.0);
    // Face: a tube from behind the orbits to the incisors.
    let station = |z: f32, bottom: f32, top: f32, half_width: f32, half_width_top: f32| Station {
        z,
        bottom,
        top,
        half_width,
        half_width_top,
    };
    let front = t.prosthion.z;
    let nasal = |from: Vec3, to: Vec3, z: f32| from.y + (to.y - from.y) * ((z - from.z) / (to.z - from.z));
    b.push(
        Shape::Face([
            station(t.staphylion.z - 2.0, t.staphylion.y - 1.0, t.nasion.y + 1.0, 14.0, 13.0),
            station(t.upper_last.z, t.upper_last.y, t.nasion.y - 1.5, t.upper_last.x, 13.0),
            station(t.maxilla.z, t.maxilla.y, nasal(t.nasion, t.rhinion, t.maxilla.z), t.maxilla.x + 2.0, 11.5),
            station(
                0.5 * (t.maxilla.z + t.canine.z),
                0.5 * (t.maxilla.y + t.canine.y),
                nasal(t.nasion, t.rhinion, 0.5 * (t.maxilla.z + t.canine.z)),
                0.45 * (t.maxilla.x + t.canine.x) + 1.5,
                9.0,
            ),
            station(
                t.canine.z,
                t.canine.y,
                nasal(t.nasion, t.rhinion, t.canine.z).max(t.nasoincisive.y),
                t.canine.x + 1.8,
                9.5,
            ),
            station(t.incisor.z, t.incisor.y, t.nasoincisive.y, t.incisor.x + 3.0, t.nasoincisive.x),
            station(front + 1.5, t.prosthion.y, t.nasoincisive.y - 5.0, t.incisor.x * 0.8, t.incisor.x * 0.6),
        ]),
        12.0,
        true,
    );
    // The nose slopes back from the incisors to the nasals' end.
    let slope = vec3(0.0, t.prosthion.z - t.rhinion.z, t.rhinion.y - t.prosthion.y - 4.0).normalize();
    b.push(Shape::Above(-slope, -slope.dot(t.rhinion)), 3.0, false);
    // Arches.
    b.bar(&[(t.meatus + mm(-7.0, 10.0, 9.0), 8.5), (t.condyle + mm(3.0, 11.5, -4.0), 5.5)], 12.0);
    let zygion = t.zygion + mm(-3.0, 0.0, 0.0);
    b.plate(
        &[
            (t.condyle + mm(1.0, 11.0, -4.0), 5.6),
            (zygion + mm(-2.2, 0.0, -5.0), 5.2),
            (zygion, 5.4),
            (zygion.lerp(t.frontal_process, 0.55) + mm(2.6, -3.5, 0.0), 6.4),
            (t.frontal_process.lerp(t.orbit_rim, 0.5) + mm(0.5, -6.5, 0.0), 7.4),
            (t.orbit_rim + mm(-3.0, -6.5, 1.0), 8.2),
            (t.arch_root + mm(-7.0, 5.0, 0.0), 9.0),
        ],
        0.56,
        6.0,
    );
    b.bar(&[(t.frontal_process + mm(-0.5, -7.0, 0.0), 4.2), (t.frontal_process + mm(-0.5, -2.0, 0.0), 2.8)], 7.0);
    // Rim of the orbit in front.
    b.bar(
        &[
            (t.orbit_rim + mm(-3.0, -4.0, 1.0), 5.0),
            (t.orbit_rim.lerp(t.entorbitale, 0.55) + mm(-1.5, -2.5, 3.0), 5.5),
            (t.entorbitale + mm(-7.5, 0.5, -1.0), 6.0),
            (t.entorbitale.lerp(t.glabella + mm(16.0, -5.0, 0.0), 0.55) + mm(-3.0, 0.0, 0.0), 6.0),
            (t.glabella + mm(13.0, -8.0, 1.0), 6.5),
        ],
        12.0,
    );
    // Base: bullae, condyles of the occiput, paracondylar and retroarticular processes, pterygoids.
    b.ball(t.bulla + mm(0.0, 11.0, 1.0), mm(9.5, 11.0, 12.0), 6.0, true);
    b.bar(&[(t.occipital_condyle + mm(-3.0, -2.0, 7.0), 6.5), (t.occipital_condyle + mm(1.5, -1.0, 6.5), 6.5)], 5.0);
    b.bar(&[(t.paracondylar + mm(-4.0, 20.0, 4.0), 8.0), (t.paracondylar + mm(0.0, 2.8, 0.8), 3.0)], 8.0);
    b.bar(&[(t.retroarticular + mm(3.0, 12.0, 0.0), 6.0), (t.retroarticular + mm(0.5, 3.2, 0.5), 3.4)], 6.0);
    b.bar(&[(t.staphylion + mm(10.0, 5.0, -3.0), 4.0), (t.synsphenion + mm(9.0, 4.0, 12.0), 3.4)], 7.0);
    // Taken away: orbit, nasal opening, foramen magnum, meatus, the hollow of the palate.
    let orbit = t.ectorbitale.lerp(t.orbit_rim, 0.5).lerp(t.entorbitale, 0.33);
    b.ball(orbit + mm(8.0, 0.5, -1.0), mm(15.0, 15.5, 19.0), 5.0, false);
    // The fossa of the lacrimal sac, under the medial canthus.
    b.ball(t.entorbitale + mm(6.5, 2.5, 5.5), mm(7.0, 7.0, 7.0), 3.0, false);
    b.ball(vec3(0.0, t.nasoincisive.y - 2.0, t.rhinion.z + 8.0), vec3(0.74 * t.nasoincisive.x, 7.0, 21.0), 3.0, false);
    b.ball(0.5 * (t.opisthion + t.basion) - mm(0.0, 0.0, 6.0), mm(8.5, 7.6, 15.0), 3.0, false);
    b.ball(t.meatus + mm(3.0, 0.0, 0.0), mm(8.0, 3.8, 3.8), 2.0, false);
    b.ball(
        0.5 * (t.staphylion + t.prosthion) - mm(0.0, 6.0, 2.0),
        vec3(0.66 * t.canine.x, 8.5, 0.46 * (t.prosthion.z - t.staphylion.z)),
        3.0,
        false,
    );
}

fn mandible(t: &Targets<Vec3>, bodies: &mut Vec<Body>) {
    let mm = vec3;
    let mut b = Bodies(bodies);
    // The rim that holds the teeth: no wider than their necks, so that a gum stands upright on it.
    let upper = [
        (t.infradentale + mm(3.4, -4.5, -4.4), 3.4),
        (t.lower_canine + mm(-4.8, -4.8, -1.0), 3.3),
        (t.lower_canine.lerp(t.lower_carnassial, 0.4) + mm(-5.4, -4.2, 0.0), 2.9),
        (t.lower_carnassial + mm(-5.2, -4.5, 0.0), 3.5),
        (t.lower_last + mm(-3.4, -5.0, 0.0), 4.0),
    ];
    let lower = [
        (t.gnathion + mm(3.5, 5.0, -1.0), 4.6),
        (t.symphysis + mm(6.5, 5.0, 2.0), 4.6),
        (t.body + mm(-0.6, 4.4, 0.0), 4.4),
        (t.body.lerp(t.gonion, 0.5) + mm(0.0, 5.0, 0.0), 4.6),
        (t.gonion + mm(-0.5, 6.0, 7.0), 4.0),
    ];
    b.bar(&upper, 4.0);
    b.bar(&lower, 4.0);
    b.bar(
        &[
            (t.infradentale + mm(0.0, -4.5, -4.5), 4.5),
            (t.gnathion + mm(0.0, 5.0, -3.0), 5.0),
            (t.symphysis + mm(0.0, 5.5, 4.0), 5.5),
        ],
        6.0,
    );
    // What lies between the two rims.
    let middle: [(Vec3, f32); 5] = std::array::from_fn(|i| (0.5 * (upper[i].0 + lower[i].0), 3.8));
    b.bar(&middle, 6.0);
    // Ramus: a plate up to the coronoid process, hollow outside; condyle; angular process.
    let root = t.lower_last.lerp(t.body.lerp(t.gonion, 0.5), 0.5);
    b.plate(
        &[
            (root + mm(1.0, 0.0, -4.0), 8.0),
            (t.masseteric + mm(-4.5, 2.0, 3.0), 11.0),
            (t.coronion + mm(0.0, -10.0, -1.0), 7.5),
            (t.coronion + mm(-0.3, -4.0, -1.5), 4.2),
        ],
        0.36,
        6.0,
    );
    b.plate(&[(t.masseteric + mm(-4.5, -3.0, 0.0), 9.5), (t.condyle + mm(-1.0, -5.0, 3.0), 6.5)], 0.38, 6.0);
    b.plate(&[(t.masseteric + mm(-4.0, -9.0, -2.0), 8.5), (t.gonion + mm(-0.5, 6.0, 7.0), 5.5)], 0.42, 6.0);
    b.bar(&[(t.condyle + mm(-7.5, 0.0, 0.0), 3.8), (t.condyle + mm(6.5, 0.0, 0.0), 4.2)], 6.0);
    b.bar(&[(t.condyle + mm(-1.0, -3.0, 1.0), 3.6), (t.masseteric + mm(-3.0, -4.0, -6.0), 4.5)], 7.0);
    b.bar(&[(t.gonion + mm(-0.5, 6.0, 7.0), 4.2), (t.gonion + mm(0.0, 2.0, 2.2), 2.8)], 3.0);
}

/// The field, compiled for the widest vectors that the machine has; the operations and their order are the same.
#[multiversion::multiversion(targets("x86_64+avx2", "x86_64+avx"))]
fn distance8(field: &BoneField, p: P8, far: f32) -> F8 {
    field.eval(p, far)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::rng::Rng;

    #[test]
    fn a_body_that_is_passed_over_would_have_changed_a_bit() {
        let mut rng = Rng::new(7);
        for bone in [BoneMesh::Skull, BoneMesh::Mandible] {
            let field = BoneField::new(bone, &Targets::CANONICAL, 1.0);
            let mut all = field.clone();
            all.bodies.iter_mut().for_each(|body| body.bound = Bound::NONE);
            for spread in [0.2, 5.0, 60.0] {
                for _ in 0..4000 {
                    let middle = [-60.0, -80.0, -90.0].map(|low: f32| rng.between(low, 110.0));
                    let mut lane = |axis: usize| F8([0; 8].map(|_| middle[axis] + rng.between(-spread, spread)));
                    let p = P8 { x: lane(0), y: lane(1), z: lane(2) };
                    let [ours, asked] = [&field, &all].map(|f| f.distance8(p).0);
                    assert_eq!(ours.map(f32::to_bits), asked.map(f32::to_bits), "{bone:?} at {p:?}");
                    for (near, d) in field.near8(p).0.into_iter().zip(asked) {
                        let holds = (d.min(NEAR) - 1e-3..=d + 1e-3).contains(&near);
                        assert!(holds, "{bone:?}: {near} for {d} at {p:?}");
                    }
                }
            }
        }
    }
}
