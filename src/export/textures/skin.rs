//! Colours and normals of the skin: the coat with its markings, streaked along the hair, and cobbled leather.

use super::cobbles::cobble;
use super::relief::{Steps, in_tangent_space};
use super::streaks::{blobs, rank, seen, streaks};
use super::tangents::middle;
use super::texels::{Texel, Texels};
use super::{filled, gutter};
use crate::anatomy::colour::to_srgb8;
use crate::frame::{Canvas, Material, Part, Uv};
use crate::math::ops;
use glam::{Vec2, Vec3, Vec4};

/// Widths of single streaks, of locks and of mottles, as parts of the head's size, and the least ones of the first two, texels.
const FINE: (f32, f32) = (0.0013, 1.5);
const LOCK: (f32, f32) = (0.0042, 4.0);
const MOTTLE: f32 = 0.035;
/// How long a streak is, as a part of the hair.
const STREAK: f32 = 0.8;
/// How much streaks, locks and mottles lighten and darken, as exponents.
const SHADE: [f32; 3] = [0.24, 0.18, 0.10];
/// How much of a stroke's colour is its own where hairs differ: it stands for many, each of which is one or the other.
const OWN: f32 = 0.6;
/// How much streaks and locks turn the normal sideways, and locks along the hair.
const TURN: [f32; 3] = [0.26, 0.20, 0.08];
/// The least width of a cobble, texels.
const COBBLE: f32 = 2.5;

/// Hair at each vertex of the skin.
pub(super) struct Hair {
    /// Its length, metres.
    pub lengths: Vec<f32>,
    /// Where it lies, head's frame, as it is combed; of no certain length.
    pub directions: Vec<Vec3>,
    /// How curly it is all over, 0 to 1.
    pub curl: f32,
}

/// A texel's place in the coat.
struct Fur {
    /// A factor for the colour.
    shade: f32,
    normal: Vec3,
    /// By what the stroke there differs from those beside it, 0 to 1, and how much of it is seen.
    own: f32,
    seen: f32,
}

/// What the skin is painted from.
pub(super) struct Painter<'a> {
    part: &'a Part<'a>,
    uv: &'a Uv,
    hair: Hair,
    canvas: &'a Canvas<'a>,
    tangents: &'a [Vec4],
    size: u32,
    /// Texture coordinates and material of each triangle.
    triangles: Vec<[Vec2; 3]>,
    materials: Vec<Material>,
    /// The head's size, metres.
    head: f32,
    /// A texel on haired skin and on the nose, metres.
    texel: f32,
    nose_texel: f32,
}

impl<'a> Painter<'a> {
    /// `tangents`: one for each vertex to draw.
    pub fn new(
        part: &'a Part<'a>,
        uv: &'a Uv,
        hair: Hair,
        canvas: &'a Canvas<'a>,
        tangents: &'a [Vec4],
        size: u32,
    ) -> Self {
        let triangles = uv.indices.as_chunks::<3>().0;
        let materials: Vec<Material> =
            uv.ranges.iter().flat_map(|r| std::iter::repeat_n(r.material, r.count as usize / 3)).collect();
        let (low, high) =
            part.positions.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(l, h), &p| (l.min(p), h.max(p)));
        let mut painter = Self {
            triangles: triangles.iter().map(|t| t.map(|v| uv.coordinates[v as usize])).collect(),
            materials,
            head: (high - low).length(),
            texel: 0.0,
            nose_texel: 0.0,
            part,
            uv,
            hair,
            canvas,
            tangents,
            size,
        };
        painter.texel = painter.mean_texel(Material::Coat);
        painter.nose_texel = painter.mean_texel(Material::Nose);
        painter
    }

    /// The pictures of base colours and of normals.
    pub fn paint(&self, threads: usize) -> [Vec<[u8; 3]>; 2] {
        let texels = Texels::new(&self.triangles, self.size);
        let both = filled(self.size, threads, |x, y| {
            texels.at(&self.triangles, x, y).map_or([[0; 3]; 2], |texel| self.painted(&texel))
        });
        let covered = texels.covered();
        [0, 1].map(|k| {
            let mut picture: Vec<[u8; 3]> = both.iter().map(|pair| pair[k]).collect();
            gutter::fill(&mut picture, &covered, self.size as usize);
            picture
        })
    }

    /// Colour and normal of a texel.
    fn painted(&self, texel: &Texel) -> [[u8; 3]; 2] {
        let corners = self.corners(texel.triangle);
        let vertices = corners.map(|v| self.uv.vertices[v]);
        let mixed = |values: &[Vec3]| {
            let [a, b, c] = vertices.map(|pair| middle(values, pair));
            a * texel.weights[0] + b * texel.weights[1] + c * texel.weights[2]
        };
        let steps = self.steps(texel.triangle, self.part.positions);
        let normal = mixed(self.part.normals).normalize_or(Vec3::Y);
        let tangent = self.tangent(corners, texel.weights);
        let place = mixed(self.part.positions) + steps.times(texel.beyond);

        let halves = std::array::from_fn::<_, 6, _>(|i| (vertices[i / 2][i % 2] as usize, 0.5 * texel.weights[i / 2]));
        let here = self.texel_of(texel.triangle);
        let (colour, bumped) = match self.materials[texel.triangle] {
            Material::Nose => {
                let rest = self.steps(texel.triangle, self.part.rest);
                let at = mixed(self.part.rest) + rest.times(texel.beyond);
                let wanted = (1.0 / 900.0_f32).max(COBBLE * self.nose_texel).min(1.0 / 300.0);
                let (furrow, bumped) = self.leather(at, normal, steps, rest, here, wanted);
                (self.canvas.colour(&halves) * furrow, bumped)
            }
            Material::Coat => {
                let along = mixed(&self.hair.directions);
                let length = halves.iter().fold(0.0, |sum, &(v, weight)| sum + self.hair.lengths[v] * weight);
                let fur = mixed(self.part.surface).x.clamp(0.0, 1.0);
                let Fur { shade, normal, own, seen } = self.fur(place, normal, along, length, fur, here);
                let mean = self.canvas.colour(&halves);
                let colour = if seen > 0.0 { mean.lerp(self.canvas.stroke(&halves, own), seen) } else { mean };
                (colour * shade, normal)
            }
            _ => (self.canvas.colour(&halves), normal),
        };
        [to_srgb8(colour), in_tangent_space(bumped, normal, tangent)]
    }

    fn fur(&self, place: Vec3, normal: Vec3, lies: Vec3, length: f32, fur: f32, texel: f32) -> Fur {
        let flat = |v: Vec3| v - normal * v.dot(normal);
        let along = flat(lies).normalize_or(normal.cross(Vec3::X).normalize_or(Vec3::Z));
        let [fine_width, lock_width] = [FINE, LOCK].map(|(part, texels)| (part * self.head).max(texels * self.texel));
        // Locks do not lie quite alike; curls far from it.
        let swing = blobs(place, (3.0 * lock_width).min(0.012 * self.head), 11).x * (0.35 + 0.5 * self.hair.curl);
        let lean = (along + normal.cross(along) * swing).normalize_or(along);
        let visible = seen(texel, fine_width);
        let stroke = streaks(place, lean, fine_width, STREAK * length, 12);
        let fine = stroke * visible;
        let locks = streaks(place, lean, lock_width, STREAK * length, 13) * seen(texel, lock_width);
        let mottle = blobs(place, MOTTLE * self.head, 14).y;
        let shade = (fine.x * SHADE[0] + locks.x * SHADE[1] + mottle * SHADE[2]) * fur;
        let turned = normal.cross(lean) * (fine.y * TURN[0] + locks.y * TURN[1]) + lean * (locks.z * TURN[2]);
        Fur {
            shade: ops::exp(shade),
            normal: (normal + turned * fur).normalize_or(normal),
            own: rank(stroke.z),
            seen: OWN * visible * fur,
        }
    }

    /// A factor for the colour of the nose, and its normal. `rest`: the place on the base head, to which `to_rest` leads; `cell`: a cobble's width, metres.
    fn leather(&self, rest: Vec3, normal: Vec3, steps: Steps, to_rest: Steps, texel: f32, cell: f32) -> (f32, Vec3) {
        const RELIEF: f32 = 0.62;
        let (outward, height) = cobble(rest / cell);
        let seen = seen(texel, cell);
        // A dome on each cobble.
        let slope = outward * (-RELIEF * seen);
        let gradient = steps.gradient(normal, slope.dot(to_rest.right), slope.dot(to_rest.down));
        let furrow = 1.0 + (0.45 + 0.55 * height - 1.0) * seen * RELIEF;
        (furrow, (normal - gradient).normalize_or(normal))
    }

    fn corners(&self, triangle: usize) -> [usize; 3] {
        [0, 1, 2].map(|k| self.uv.indices[3 * triangle + k] as usize)
    }

    fn steps(&self, triangle: usize, values: &[Vec3]) -> Steps {
        let at = self.corners(triangle).map(|v| middle(values, self.uv.vertices[v]));
        Steps::new(self.triangles[triangle], at)
    }

    fn tangent(&self, corners: [usize; 3], weights: [f32; 3]) -> Vec4 {
        let [a, b, c] = corners.map(|v| self.tangents[v]);
        let along = (a * weights[0] + b * weights[1] + c * weights[2]).truncate().normalize_or(a.truncate());
        along.extend(a.w)
    }

    /// The area of a triangle on the skin, square metres, and in the texture.
    fn areas(&self, triangle: usize) -> [f32; 2] {
        let [p, q, r] = self.corners(triangle).map(|v| middle(self.part.positions, self.uv.vertices[v]));
        let [a, b, c] = self.triangles[triangle];
        [0.5 * (q - p).cross(r - p).length(), 0.5 * (b - a).perp_dot(c - a).abs()]
    }

    /// The side of a texel on a triangle, metres.
    fn texel_of(&self, triangle: usize) -> f32 {
        let [skin, texture] = self.areas(triangle);
        ops::sqrt(skin / texture.max(1e-12)) / self.size as f32
    }

    /// The same on all triangles of a material.
    fn mean_texel(&self, material: Material) -> f32 {
        let of_material = (0..self.triangles.len()).filter(|&t| self.materials[t] == material);
        let [skin, texture] = of_material
            .map(|t| self.areas(t))
            .fold([0.0_f64; 2], |sum, areas| [sum[0] + f64::from(areas[0]), sum[1] + f64::from(areas[1])]);
        ops::sqrt((skin / texture.max(1e-12)) as f32) / self.size as f32
    }
}
