//! The head: control mesh, landmarks, and the function from measures to control positions.
//!
//! Definition and state are apart: a [`Rig`] is loaded once and shared, what changes with a breed is in [`Deformed`].

mod control;
pub mod deform;
pub mod handles;
pub mod implicit;
mod lanes;
mod proportions;

pub use control::{ControlError, HalfMesh, HalfRings};
pub use handles::Handles;
pub use proportions::{EarProportions, Measures, Proportions};

use crate::anatomy::{Breed, ParamTable};
use crate::mesh::DedgeMesh;
use deform::{DeformPlan, Scratch};
use glam::Vec3;

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
}

/// One head's control positions; buffers are made once and written again for every breed.
#[derive(Clone, Debug, Default)]
pub struct Deformed {
    half: Vec<Vec3>,
    scratch: Scratch,
    /// Control positions of the whole mesh, metres, head's frame.
    pub control: Vec<Vec3>,
    /// The left eye and the right.
    pub eyes: [Eye; 2],
}

/// An eyeball's place.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Eye {
    /// Centre, metres.
    pub centre: Vec3,
    /// Radius, metres.
    pub radius: f32,
    /// Unit axes: to the dog's left (in the eye's own frame), up, and the direction of gaze.
    pub axes: [Vec3; 3],
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
        let plan = DeformPlan::new(&half, handles, &Proportions::new(&defaults));
        Ok(Self { half, mesh, columns, plan })
    }

    /// Connectivity of the whole control mesh.
    pub fn mesh(&self) -> &DedgeMesh {
        &self.mesh
    }

    /// Names, regions, loops and landmarks of the half.
    pub fn half(&self) -> &HalfMesh {
        &self.half
    }

    /// The constant part of the deformation.
    pub fn plan(&self) -> &DeformPlan {
        &self.plan
    }

    /// A head's proportions from a breed's values (SI, one per row of the table the rig was made for).
    pub fn proportions(&self, values: &[f32]) -> Proportions {
        Proportions::new(&Measures::from_values(values, &self.columns))
    }

    /// Control positions and eyes of one head; `rounds` of the fit are [`deform::ROUNDS`] everywhere but in the test that
    /// measures how little more of them would change.
    pub fn deform(&self, values: &[f32], rounds: usize, out: &mut Deformed) {
        let shape = self.proportions(values);
        out.half.resize(self.half.n_half(), Vec3::ZERO);
        out.control.resize(self.mesh.n_vertices(), Vec3::ZERO);
        self.plan.run(&shape, rounds, &mut out.scratch, &mut out.half);
        for p in &mut out.half {
            *p = shape.metres(*p);
        }
        self.half.unfold(&out.half, &mut out.control);
        let axes = deform::eye_axes(&shape).map(|a| shape.direction(a));
        let left = Eye { centre: shape.metres(shape.eye()), radius: shape.eye_r * shape.scale, axes };
        let flip = |v: Vec3| Vec3::new(-v.x, v.y, v.z);
        let right =
            Eye { centre: flip(left.centre), radius: left.radius, axes: [-flip(axes[0]), flip(axes[1]), flip(axes[2])] };
        out.eyes = [left, right];
    }
}
