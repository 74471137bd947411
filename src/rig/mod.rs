//! The head: control mesh, landmarks, and the function from measures to control positions.
//!
//! Definition and state are apart: a [`Rig`] is loaded once and shared, what changes with a breed is in [`Deformed`].

pub mod bone;
mod control;
pub mod deform;
mod eye;
pub mod eyelids;
mod flow;
pub mod folds;
mod growth;
pub mod handles;
pub mod implicit;
mod landmarks;
mod lanes;
mod mirror;
pub mod mouth;
pub mod posing;
mod primitives;
mod proportions;
pub mod touch;
mod uv;
pub mod whiskers;

pub use control::{ControlError, HalfMesh, HalfRings, LimitRow};
pub use eye::Eye;
pub use handles::{EAR_RINGS, Handles};
pub use landmarks::{Place, SkinLandmark};
pub use posing::{Places, PosePlan, Rigid};
pub use proportions::{EarProportions, Measures, Proportions};
pub use uv::{Chart, HEAD_UV, HalfUv};

use crate::anatomy::{Breed, ParamTable};
use crate::mesh::DedgeMesh;
use crate::motion::{MotionError, Pose};
use deform::{DeformPlan, Scratch};
use glam::Vec3;
use std::sync::Arc;

/// The head's control mesh as baked.
pub const HEAD: &str = include_str!("../../assets/head.ron");

/// Why a rig cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum RigError {
    /// The control mesh is wrong.
    #[error(transparent)]
    Control(#[from] ControlError),
    /// The table has no row for a measure that the shape needs.
    #[error("rigs/anatomy.ron has no measure `{0}`, which the head's shape needs")]
    MissingMeasure(&'static str),
    /// A table of motion is wrong.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// A muscle hangs on a landmark that the head does not have.
    #[error("rigs/muscles.ron: `{0}` is no landmark of skin or bone; 'londra landmarks' names them all")]
    MissingLandmark(String),
}

/// Column in a breed's values of each of [`Measures::IDS`].
///
/// # Errors
/// The first measure that the table lacks.
pub fn columns(table: &ParamTable) -> Result<Vec<usize>, RigError> {
    Measures::IDS.iter().map(|id| table.index_of(id).ok_or(RigError::MissingMeasure(id))).collect()
}

/// The head, immutable: one per program.
#[derive(Clone, Debug)]
pub struct Rig {
    half: HalfMesh,
    mesh: DedgeMesh,
    columns: Vec<usize>,
    plan: DeformPlan,
    flow: Vec<(u32, u32)>,
    /// Number of each half vertex on the other side.
    images: Vec<u32>,
    posing: Arc<PosePlan>,
}

/// One head's control positions; buffers are made once and written again for every breed.
#[derive(Clone, Debug, Default)]
pub struct Deformed {
    half: Vec<Vec3>,
    posed: posing::Buffers,
    /// What poses need of this head; none until one is asked for.
    of_head: Option<posing::OfHead>,
    /// Buffers of the last one.
    spare: Option<posing::OfHead>,
    /// The left eye at rest.
    ahead: Eye,
    scratch: Scratch,
    /// Control positions of the whole mesh, metres, head's frame.
    pub control: Vec<Vec3>,
    /// The left eye and the right.
    pub eyes: [Eye; 2],
    /// Where skull and mandible are.
    pub places: Places,
}

impl Deformed {
    /// Where the limit of each vertex of the half was meant to lie, in the proportions' frame and head units.
    pub fn aims(&self) -> &[Vec3] {
        self.scratch.aims()
    }
}

impl Rig {
    /// The rig that is part of the program.
    ///
    /// # Errors
    /// See [`Rig::new`].
    pub fn embedded(table: &ParamTable) -> Result<Self, RigError> {
        Self::new(HalfMesh::parse(HEAD)?, table)
    }

    /// Prepares a control mesh for a table.
    ///
    /// # Errors
    /// The mesh is no manifold or lacks a vertex, or the table lacks a measure.
    pub fn new(half: HalfMesh, table: &ParamTable) -> Result<Self, RigError> {
        let handles = Handles::new(&half)?;
        let mesh = half.mesh().map_err(ControlError::Mesh)?;
        let columns = columns(table)?;
        let defaults = Measures::from_values(&Breed::defaults(table).values, &columns);
        let flow = Self::whole_flow(&half, &handles);
        let plan = DeformPlan::new(&half, handles, &Proportions::new(&defaults));
        let images = half.mirror();
        let posing = Arc::new(PosePlan::new(&half, &mesh, &plan, &images)?);
        Ok(Self { half, mesh, columns, plan, flow, images, posing })
    }

    fn whole_flow(half: &HalfMesh, handles: &Handles) -> Vec<(u32, u32)> {
        let pairs = flow::pairs(handles, half.n_half());
        let mirror = half.mirror();
        let left = pairs.iter().map(|&(a, b)| (u32::from(a), u32::from(b)));
        let right = pairs.iter().zip(&half.midline).filter(|(_, mid)| !**mid);
        left.chain(right.map(|(&(a, b), _)| (mirror[a as usize], mirror[b as usize]))).collect()
    }

    /// Unit direction in which hair lies at every control vertex (`out`: one each), zero where there is none.
    pub fn flow(&self, control: &[Vec3], out: &mut [Vec3]) {
        for (to, &(a, b)) in out.iter_mut().zip(&self.flow) {
            *to = (control[b as usize] - control[a as usize]).normalize_or_zero();
        }
    }

    /// Vertices of the whole mesh on the lips' inner sides and how much of the lips' pigment each has, 0 to 1.
    pub fn inner_lip(&self) -> impl Iterator<Item = (usize, f32)> + '_ {
        let mirror = self.half.mirror();
        let h = self.plan.handles();
        let inner = (3..11).flat_map(move |i| [(h.mu[i][1], 0.95), (h.ml[i][1], 0.95), (h.mu[i][2], 0.3)]);
        inner.flat_map(move |(v, pigment)| [(v as usize, pigment), (mirror[v as usize] as usize, pigment)])
    }

    /// Vertices of the whole mesh on the inner side of the lower lids, between their corners.
    pub fn lower_conjunctiva(&self) -> impl Iterator<Item = usize> + '_ {
        let inner = self.plan.handles().ei[7..].iter().map(|&v| usize::from(v));
        inner.flat_map(|v| [v, self.image(v)])
    }

    /// Sharp edges of the whole mesh: vertices and sharpness, each edge once.
    pub fn creases(&self) -> impl Iterator<Item = (u32, u32, f32)> + '_ {
        self.half.whole_creases()
    }

    /// Connectivity of the whole control mesh.
    pub fn mesh(&self) -> &DedgeMesh {
        &self.mesh
    }

    /// Names, regions, loops and landmarks of the half.
    pub fn half(&self) -> &HalfMesh {
        &self.half
    }

    /// Control positions of the base head, in its proportions' frame and head units, which are centimetres on the cranium
    /// that they are relative to.
    pub fn base(&self) -> Vec<Vec3> {
        let half: Vec<Vec3> = self.half.base.iter().map(|&p| Vec3::from(p)).collect();
        let mut whole = vec![Vec3::ZERO; self.mesh.n_vertices()];
        self.half.unfold(&half, &mut whole);
        whole
    }

    /// The vertex of the whole mesh that is the mirror image of one of the half.
    pub fn image(&self, v: usize) -> usize {
        self.images[v] as usize
    }

    /// The constant part of the deformation.
    pub fn plan(&self) -> &DeformPlan {
        &self.plan
    }

    /// A breed's values (SI, one per row of the table the rig was made for) by name, at its age and of its sex.
    pub fn measures(&self, values: &[f32]) -> Measures {
        growth::grown(&Measures::from_values(values, &self.columns))
    }

    /// How much of a puppy's coat a breed has at its age, 0 to 1.
    pub fn youth(&self, values: &[f32]) -> f32 {
        growth::youth(Measures::from_values(values, &self.columns).age)
    }

    /// How much a breed shows of the lower lids' lining, 0 to 1: all of it where they hang by 2.5 mm.
    pub fn seen_conjunctiva(&self, values: &[f32]) -> f32 {
        (self.measures(values).haw / 0.0025).clamp(0.0, 1.0)
    }

    /// A head's proportions from a breed's values (SI, one per row of the table the rig was made for).
    pub fn proportions(&self, values: &[f32]) -> Proportions {
        Proportions::new(&self.measures(values))
    }

    /// Control positions and eyes of one head; `rounds` of the fit are [`deform::ROUNDS`] everywhere but in the test that
    /// measures how little more of them would change.
    pub fn deform(&self, values: &[f32], rounds: usize, out: &mut Deformed) {
        let measures = self.measures(values);
        let shape = Proportions::new(&measures);
        out.half.resize(self.half.n_half(), Vec3::ZERO);
        out.control.resize(self.mesh.n_vertices(), Vec3::ZERO);
        self.plan.run(&measures, &shape, rounds, &mut out.scratch, &mut out.half);
        for p in &mut out.half {
            *p = shape.metres(*p);
        }
        self.half.unfold(&out.half, &mut out.control);
        let axes = deform::eye_axes(&shape).map(|a| shape.direction(a));
        let left = Eye { centre: shape.metres(shape.eye()), radius: shape.eye_r * shape.scale, axes };
        out.ahead = left;
        out.eyes = [left, left.mirrored()];
        out.places = Places::default();
        if let Some(of_head) = out.of_head.take() {
            out.spare = Some(of_head);
        }
    }

    /// Moves the control positions of a head that [`Rig::deform`] made from these values into a pose; at rest they are those
    /// of `deform`, bit for bit. It starts from the head at rest, whatever pose it was in.
    pub fn pose(&self, values: &[f32], pose: &Pose, out: &mut Deformed) {
        self.half.unfold(&out.half, &mut out.control);
        out.eyes = [out.ahead, out.ahead.mirrored()];
        out.places = Places::default();
        if pose.is_rest() {
            return;
        }
        self.of_head(values, out);
        let Deformed { half, posed, of_head, control, eyes, places, ahead, .. } = out;
        let Some(head) = of_head else { return };
        (*eyes, *places) = self.posing.apply(&self.plan, head, (half, ahead), pose, posed, control);
    }

    /// What poses and muscles need of a head that [`Rig::deform`] made from these values; made when it is first asked for.
    pub fn of_head<'a>(&self, values: &[f32], out: &'a mut Deformed) -> &'a posing::OfHead {
        let Deformed { half, of_head, spare, .. } = out;
        of_head.get_or_insert_with(|| {
            let mut made = spare.take().unwrap_or_default();
            let measures = self.measures(values);
            let shape = Proportions::new(&measures);
            self.posing.measure((&self.mesh, &self.half), &measures, &shape, half, &mut made);
            made
        })
    }

    /// How much a pose presses the skin together at each control vertex (`out`: one each): into wrinkles across the nose,
    /// of the brow and of the cheek, each 0 to 1. Gives whether it does so anywhere. The head is one that [`Rig::pose`]
    /// made from these values.
    pub fn pressed(&self, values: &[f32], pose: &Pose, head: &mut Deformed, out: &mut [Vec3]) -> bool {
        if pose.is_rest() {
            return false;
        }
        self.posing.pressed(self.of_head(values, head), pose, out)
    }

    /// Positions of the muscles' straps ([`posing::Fibres`]) of a head that [`Rig::pose`] made from these values and this
    /// pose, metres.
    pub fn straps(&self, values: &[f32], pose: &Pose, head: &mut Deformed, out: &mut Vec<Vec3>) {
        self.of_head(values, head);
        if let Some(of_head) = &head.of_head {
            self.posing.straps(&self.half, of_head, pose, (&head.control, &head.places), out);
        }
    }

    /// How poses move the mesh.
    pub fn posing(&self) -> &PosePlan {
        &self.posing
    }
}
