//! Muscles as a drawable part: all straps of fibres in one mesh.

use super::PipelineError;
use super::parts::{Material, MaterialRange, PartTopology};
use super::values::Values;
use crate::mesh::DedgeMesh;
use crate::motion::Pose;
use crate::rig::posing::{Fibres, STRAP_VERTICES};
use crate::rig::{ControlError, Deformed, Rig};
use crate::subdiv::{Evaluator, Plan, Scheme};
use glam::{Vec3, vec3};

/// Flesh between its lines, and the tendon at both ends, linear.
const FLESH: [Vec3; 2] = [vec3(0.36, 0.035, 0.03), vec3(0.20, 0.016, 0.016)];
const TENDON: Vec3 = vec3(0.62, 0.52, 0.44);

/// The straps and what they draw.
pub(super) struct MuscleParts {
    plan: Plan,
    evaluator: Evaluator,
    control: Vec<Vec3>,
    pub(super) values: Values,
}

impl MuscleParts {
    pub(super) fn new(rig: &Rig) -> Result<Self, PipelineError> {
        let fibres = rig.posing().fibres();
        let indices = fibres.indices();
        let n = fibres.n_straps() * STRAP_VERTICES;
        let mesh = DedgeMesh::from_triangles(n, indices.as_chunks::<3>().0).map_err(ControlError::Mesh)?;
        let plan = Plan::build(&mesh, Scheme::Loop, 0)?;
        let ranges = vec![MaterialRange { material: Material::Muscle, start: 0, count: indices.len() as u32 }];
        let mut values = Values::new(PartTopology { name: "muscles", n_vertices: n, indices, ranges });
        for (v, colour) in values.colours.iter_mut().enumerate() {
            let (along, lighter) = Fibres::along(v % STRAP_VERTICES);
            // Tendon over the last eighth.
            let end = (along.min(1.0 - along) / 0.125).min(1.0);
            *colour = TENDON.lerp(FLESH[usize::from(!lighter)], end);
        }
        values.surface.fill(vec3(0.0, 0.55, 0.0));
        Ok(Self { evaluator: Evaluator::new(&plan), plan, control: Vec::new(), values })
    }

    pub(super) fn shape(&mut self, rig: &Rig, breed: &[f32], pose: &Pose, head: &mut Deformed) {
        rig.straps(breed, pose, head, &mut self.control);
        let Values { positions, normals, .. } = &mut self.values;
        self.evaluator.evaluate_into(&self.plan, &self.control, positions, normals);
    }
}
