//! Third eyelids and lines of tears as drawable parts.

use super::parts::{Material, MaterialRange, PartTopology};
use super::values::Values;
use super::PipelineError;
use crate::anatomy::Look;
use crate::rig::eyelids::{self, third_eyelid_meshes, tear_line_meshes};
use crate::rig::{ControlError, Eye, Proportions, Rig};
use crate::subdiv::{Evaluator, Plan, Scheme};
use glam::{Vec3, vec3};

/// Steps of Loop's scheme.
const STEPS: u32 = 1;

/// Their plans and what they draw.
pub(super) struct EyelidParts {
    evaluator: Evaluator,
    /// The lower lid's inner margin from the lateral corner to the medial one: vertices of the skin at every level.
    margin: [usize; 7],
    left: Vec<Vec3>,
    right: Vec<Vec3>,
    /// Left and right third eyelid, left and right line of tears.
    parts: [(Plan, Values); 4],
}

impl EyelidParts {
    pub(super) fn new(rig: &Rig) -> Result<Self, PipelineError> {
        let part = |mesh: &_, name: &'static str, material: Material| -> Result<(Plan, Values), PipelineError> {
            let plan = Plan::build(mesh, Scheme::Loop, STEPS)?;
            let indices = plan.indices().to_vec();
            let ranges = vec![MaterialRange { material, start: 0, count: indices.len() as u32 }];
            let values = Values::new(PartTopology { name, n_vertices: plan.n_vertices(), indices, ranges });
            Ok((plan, values))
        };
        let [third_l, third_r] = third_eyelid_meshes().map_err(ControlError::Mesh)?;
        let [tears_l, tears_r] = tear_line_meshes().map_err(ControlError::Mesh)?;
        let parts = [
            part(&third_l, "third_eyelid_L", Material::ThirdEyelid)?,
            part(&third_r, "third_eyelid_R", Material::ThirdEyelid)?,
            part(&tears_l, "tears_L", Material::Tears)?,
            part(&tears_r, "tears_R", Material::Tears)?,
        ];
        let inner = rig.plan().handles().ei;
        let margin = std::array::from_fn(|k| usize::from(inner[(6 + k) % 12]));
        let evaluator = Evaluator::new(&parts[0].0);
        Ok(Self { evaluator, margin, left: Vec::new(), right: Vec::new(), parts })
    }

    /// `eye`: the left one; `skin`: positions of the refined skin.
    pub(super) fn shape(&mut self, proportions: &Proportions, eye: &Eye, skin: &[Vec3]) {
        let Self { evaluator, margin, left, right, parts } = self;
        let (third, tears) = parts.split_at_mut(2);
        eyelids::third_eyelid(proportions, eye, left);
        both(evaluator, left, right, third);
        eyelids::tear_line(eye, &margin.map(|v| skin[v]), left);
        both(evaluator, left, right, tears);
    }

    pub(super) fn paint(&mut self, look: &Look) {
        // Pink below, dark at the free edge where the lids are dark: the membrane shares their pigment.
        let membrane = (look.mouth * vec3(0.9, 0.8, 0.8)).lerp(look.lips, 0.45);
        let wet = look.lips.lerp(look.mouth, 0.35) * 0.8;
        for ((_, values), (colour, gloss)) in
            self.parts.iter_mut().zip([(membrane, 0.8), (membrane, 0.8), (wet, 1.0), (wet, 1.0)])
        {
            values.colours.fill(colour);
            values.surface.fill(vec3(0.0, gloss, 0.2));
        }
    }

    pub(super) fn parts(&self) -> impl Iterator<Item = &Values> {
        self.parts.iter().map(|(_, values)| values)
    }
}

fn both(evaluator: &mut Evaluator, left: &[Vec3], right: &mut Vec<Vec3>, parts: &mut [(Plan, Values)]) {
    eyelids::mirrored(left, right);
    for ((plan, values), control) in parts.iter_mut().zip([left, right]) {
        evaluator.evaluate_into(plan, control, &mut values.positions, &mut values.normals);
    }
}
