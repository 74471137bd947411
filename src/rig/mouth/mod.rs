//! The inside of the mouth: gums, palate and floor on the arches of the teeth, and the tongue between them.
//!
//! Three closed bodies, each one half and its mirror image. They hang on the landmarks of the bone and on the seats of the
//! teeth, so that they follow every measure; what is upper goes with the skull, what is lower and the tongue with the
//! mandible.

mod arch;
mod bend;
mod gums;
mod tongue;

pub use arch::Arch;
pub use bend::bend_tongue;
use gums::Wall;
pub use gums::{N_RUGAE, Tissue};
pub use tongue::TONGUE_TIP;

use super::bone::{BoneField, BoneMesh, Targets, targets, teeth};
use super::implicit::{Implicit, Layer};
use super::proportions::{Measures, Proportions};
use super::{ControlError, mirror};
use crate::mesh::{DedgeMesh, MeshError};
use glam::Vec3;

/// Half of a closed body: what of it no measure changes.
#[derive(Clone, Debug)]
pub struct HalfBody {
    /// Whether each vertex lies in the median plane.
    pub midline: Vec<bool>,
    /// Triangles, counter-clockwise seen from outside.
    faces: Vec<[u16; 3]>,
    /// What each vertex is made of.
    tissue: Vec<Tissue>,
}

impl HalfBody {
    /// Connectivity of the whole body: the half, then its mirror image.
    ///
    /// # Errors
    /// Where it is not an oriented manifold.
    pub fn mesh(&self) -> Result<DedgeMesh, MeshError> {
        DedgeMesh::from_triangles(mirror::n_whole(&self.midline), &mirror::triangles(&self.midline, &self.faces))
    }

    /// What each vertex of the whole body is made of.
    pub fn tissue(&self) -> Vec<Tissue> {
        let off = self.tissue.iter().zip(&self.midline).filter(|(_, middle)| !**middle);
        self.tissue.iter().chain(off.map(|(tissue, _)| tissue)).copied().collect()
    }

    /// Two triangles for a cell whose corners are counter-clockwise from outside. Of the two diagonals the one that leaves
    /// no triangle in the median plane where a body begins.
    fn cell(&mut self, [a, b, c, d]: [usize; 4]) {
        self.faces.extend([[a, b, d], [b, c, d]].map(|f| f.map(|v| v as u16)));
    }
}

/// Newton steps that keep a point under the skin.
const STEPS: usize = 3;
/// How far over the incisors a tongue passes them, millimetres of the head with a skull of 200 mm.
const OVER: f32 = 1.5;

/// The bodies of the mouth, immutable: one per program.
#[derive(Clone, Debug)]
pub struct Mouth {
    /// Upper gums and palate.
    pub upper: HalfBody,
    /// Lower gums and the floor of the mouth.
    pub lower: HalfBody,
    /// Tongue.
    pub tongue: HalfBody,
}

/// One head's mouth; buffers are made once and written again for every breed. Control positions of whole bodies, metres,
/// head's frame.
#[derive(Clone, Debug, Default)]
pub struct MouthOfHead {
    half: Vec<Vec3>,
    teeth: [Vec<Vec3>; 2],
    /// Upper gums and palate.
    pub upper: Vec<Vec3>,
    /// Lower gums and the floor of the mouth.
    pub lower: Vec<Vec3>,
    /// Tongue.
    pub tongue: Vec<Vec3>,
    /// Vertices of the tongue by its sections from the root to the tip.
    sections: Vec<Vec<u16>>,
    passage: tongue::Passage,
    /// Skull and mandible.
    bones: [BoneField; 2],
    /// A canonical millimetre, metres.
    unit: f32,
    /// Heights at which the tongue passes the lower incisors, and the lower canines.
    onto: [f32; 2],
}

impl Default for Mouth {
    fn default() -> Self {
        let lower = gums::body();
        let mut upper = lower.clone();
        upper.faces.iter_mut().for_each(|f| f.swap(1, 2));
        for tissue in upper.tissue.iter_mut().filter(|t| **t == Tissue::Floor) {
            *tissue = Tissue::Palate;
        }
        Self { upper, lower, tongue: tongue::body() }
    }
}

impl Mouth {
    /// Connectivity of the three bodies, in the order of the fields.
    ///
    /// # Errors
    /// Where one is not an oriented manifold.
    pub fn meshes(&self) -> Result<[DedgeMesh; 3], ControlError> {
        let mesh = |body: &HalfBody| body.mesh().map_err(ControlError::Mesh);
        Ok([mesh(&self.upper)?, mesh(&self.lower)?, mesh(&self.tongue)?])
    }

    /// The mouth of one head.
    pub fn shape(&self, measures: &Measures, proportions: &Proportions, out: &mut MouthOfHead) {
        let targets: Targets<Vec3> = targets(measures, proportions);
        let unit = teeth::unit(&targets);
        let skin = Implicit::new(proportions);
        let arches = [Arch::new(&targets, true), Arch::new(&targets, false)];
        let MouthOfHead { half, teeth, upper, lower, tongue, sections, passage, bones: fields, unit: own, onto } = out;
        *own = unit;
        for (field, bone) in fields.iter_mut().zip([BoneMesh::Skull, BoneMesh::Mandible]) {
            field.place(bone, &targets, unit);
        }
        if sections.is_empty() {
            *sections = tongue::sections(&self.tongue);
        }
        // The lower lip is thin, and bone under it is seen to lie under the whole head only: its gum may stand out a little
        // of the lower head, or it would lie in the bone, but for its outer wall.
        let whole_head = (Layer::Whole, gums::LEAST_TISSUE);
        let bodies =
            [(&self.upper, upper, whole_head), (&self.lower, lower, (Layer::Lower, -3.0 * gums::LEAST_TISSUE))];
        for ((arch, field), (body, whole, (layer, least))) in arches.iter().zip(&*fields).zip(bodies) {
            let keep = |p: Vec3, layer, least| under_skin(p, proportions, (&skin, layer), least);
            let under = |p: Vec3, wall: Wall| {
                let least = if wall == Wall::Outer { 2.0 * gums::LEAST_TISSUE } else { least };
                keep(keep(p, Layer::Whole, gums::LEAST_TISSUE), layer, least)
            };
            let inside = |p: Vec3| skin.distance(proportions.proportional(p), layer) < 0.0;
            gums::place(arch, unit, field, under, inside, half);
            body.unfold(half, whole);
        }
        let [above, below] = teeth;
        teeth::place(&targets, true, above);
        teeth::place(&targets, false, below);
        let incisor = below.iter().take(teeth::TOOTH_VERTICES);
        let highest = incisor.fold(Vec3::NEG_INFINITY, |a, &p| a.max(p)).y;
        *onto = [highest + OVER * unit, tongue::over_canines(below, unit)];
        let leaves = onto[0].max(onto[1]);
        *passage = tongue::place(&targets, &arches, [above, below], fields, leaves, half);
        self.tongue.unfold(half, tongue);
    }
}

impl HalfBody {
    fn unfold(&self, half: &mut [Vec3], whole: &mut Vec<Vec3>) {
        for (p, _) in half.iter_mut().zip(&self.midline).filter(|(_, middle)| **middle) {
            p.x = 0.0;
        }
        mirror::unfold(&self.midline, half, whole);
    }
}

/// The point, or where it comes to lie when bone is nearer than `cover` canonical millimetres.
fn off_bone(mut p: Vec3, bone: &BoneField, cover: f32, unit: f32) -> Vec3 {
    for _ in 0..2 {
        let (d, g) = bone.sample(p, 0.1 * unit);
        let over = cover * unit - d;
        if over <= 0.0 {
            break;
        }
        p += (g * (over / g.length_squared().max(0.2))).clamp_length_max(3.0 * unit);
    }
    p
}

/// The point, or where it comes to lie when that skin is nearer than `least` head units.
fn under_skin(p: Vec3, s: &Proportions, (skin, layer): (&Implicit, Layer), least: f32) -> Vec3 {
    let mut q = s.proportional(p);
    let mut moved = false;
    for _ in 0..STEPS {
        let (d, g) = skin.sample(q, layer);
        let over = d + least;
        if over <= 0.0 {
            break;
        }
        q -= g * (over / g.length_squared().max(0.1)).min(0.6);
        moved = true;
    }
    if moved { s.metres(q) } else { p }
}
