//! Bone and teeth as drawable parts.

use super::parts::{Material, MaterialRange, PartTopology};
use super::values::Values;
use crate::mesh::DedgeMesh;
use crate::rig::bone::{Bones, BonesOfHead, teeth};
use crate::rig::{ControlError, Measures, Places, Proportions};
use crate::subdiv::{Evaluator, Plan, PlanError, Scheme};
use glam::Vec3;

use super::PipelineError;

/// Steps of the interpolating butterfly scheme on bone: its landmarks are vertices of the control mesh, and stay.
const STEPS: u32 = 1;

/// Bones, their plans, and what they draw.
pub(super) struct Skeleton {
    bones: Bones,
    of_head: BonesOfHead,
    evaluator: Evaluator,
    /// Skull, mandible, upper and lower teeth.
    parts: [(Plan, Values); 4],
    /// Positions and normals of each at rest.
    rest: [[Vec<Vec3>; 2]; 4],
}

impl Skeleton {
    pub(super) fn new() -> Result<Self, PipelineError> {
        let bones = Bones::embedded()?;
        let teeth = |upper: bool| -> Result<Plan, PipelineError> {
            let indices = Bones::tooth_indices(upper);
            let n = 2 * teeth::TOOTH_VERTICES * if upper { teeth::UPPER.len() } else { teeth::LOWER.len() };
            let mesh = DedgeMesh::from_triangles(n, indices.as_chunks::<3>().0).map_err(ControlError::Mesh)?;
            Ok(Plan::build(&mesh, Scheme::Loop, 0)?)
        };
        let bone = |mesh: &DedgeMesh| -> Result<Plan, PlanError> { Plan::build(mesh, Scheme::Butterfly, STEPS) };
        let (skull, mandible) = (bone(bones.skull.mesh())?, bone(bones.mandible.mesh())?);
        let (upper, lower) = (teeth(true)?, teeth(false)?);
        let part = |plan: Plan, name: &'static str, material: Material, colour: Vec3, gloss: f32| {
            let indices = plan.indices().to_vec();
            let ranges = vec![MaterialRange { material, start: 0, count: indices.len() as u32 }];
            let mut values = Values::new(PartTopology { name, n_vertices: plan.n_vertices(), indices, ranges });
            values.colours.fill(colour);
            values.surface.fill(Vec3::new(0.0, gloss, 0.0));
            (plan, values)
        };
        let ivory = Vec3::new(0.70, 0.60, 0.43);
        let enamel = Vec3::new(0.82, 0.73, 0.55);
        Ok(Self {
            bones,
            of_head: BonesOfHead::default(),
            evaluator: Evaluator::new(&skull),
            rest: Default::default(),
            parts: [
                part(skull, "skull", Material::Bone, ivory, 0.15),
                part(mandible, "mandible", Material::Bone, ivory, 0.15),
                part(upper, "teeth_upper", Material::Tooth, enamel, 0.7),
                part(lower, "teeth_lower", Material::Tooth, enamel, 0.7),
            ],
        })
    }

    /// `head`: measures and proportions, where they changed.
    pub(super) fn shape(&mut self, head: Option<(&Measures, &Proportions)>, places: &Places) {
        if let Some((measures, proportions)) = head {
            self.bones.shape(measures, proportions, &mut self.of_head);
            let BonesOfHead { skull, mandible, upper_teeth, lower_teeth, .. } = &self.of_head;
            let controls = [skull, mandible, upper_teeth, lower_teeth];
            for (((plan, _), rest), control) in self.parts.iter().zip(&mut self.rest).zip(controls) {
                let [positions, normals] = rest;
                positions.resize(plan.n_vertices(), Vec3::ZERO);
                normals.resize(plan.n_vertices(), Vec3::ZERO);
                self.evaluator.evaluate_into(plan, control, positions, normals);
            }
        }
        let Places { head, mandible, .. } = places;
        for (((_, values), [positions, normals]), place) in
            self.parts.iter_mut().zip(&self.rest).zip([head, mandible, head, mandible])
        {
            values.positions.copy_from_slice(positions);
            values.normals.copy_from_slice(normals);
            place.carry(&mut values.positions, &mut values.normals);
        }
    }

    pub(super) fn parts(&self, bone: bool, teeth: bool) -> impl Iterator<Item = &Values> {
        let shown = [bone, bone, teeth, teeth];
        self.parts.iter().zip(shown).filter(|(_, shown)| *shown).map(|((_, values), _)| values)
    }
}
