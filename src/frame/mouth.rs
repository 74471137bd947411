//! Gums, palate and tongue as drawable parts.

use super::PipelineError;
use super::parts::{Material, MaterialRange, PartTopology};
use super::values::Values;
use crate::anatomy::Look;
use crate::motion::Pose;
use crate::rig::mouth::{Mouth, MouthOfHead, Tissue, bend_tongue};
use crate::rig::{Measures, Places, Proportions};
use crate::subdiv::{Evaluator, Plan, Scheme};
use glam::{Vec3, vec3};

/// Steps of Loop's scheme.
const STEPS: u32 = 1;

/// Bodies of the mouth, their plans, and what they draw.
pub(super) struct MouthParts {
    mouth: Mouth,
    of_head: MouthOfHead,
    evaluator: Evaluator,
    /// Control positions of the bent tongue.
    bent: Vec<Vec3>,
    /// Upper gums, lower gums, tongue.
    parts: [(Plan, Values); 3],
}

impl MouthParts {
    pub(super) fn new() -> Result<Self, PipelineError> {
        let mouth = Mouth::default();
        let part = |mesh: &_, name: &'static str, material: Material| -> Result<(Plan, Values), PipelineError> {
            let plan = Plan::build(mesh, Scheme::Loop, STEPS)?;
            let indices = plan.indices().to_vec();
            let ranges = vec![MaterialRange { material, start: 0, count: indices.len() as u32 }];
            let values = Values::new(PartTopology { name, n_vertices: plan.n_vertices(), indices, ranges });
            Ok((plan, values))
        };
        let [upper, lower, tongue] = mouth.meshes()?;
        let parts = [
            part(&upper, "gums_upper", Material::Gum)?,
            part(&lower, "gums_lower", Material::Gum)?,
            part(&tongue, "tongue", Material::Tongue)?,
        ];
        Ok(Self {
            evaluator: Evaluator::new(&parts[0].0),
            mouth,
            of_head: MouthOfHead::default(),
            bent: Vec::new(),
            parts,
        })
    }

    /// `head`: measures and proportions, where they changed; `size`: metres of a millimetre of the head with a skull of 200
    /// mm, and how far in front its skin reaches.
    pub(super) fn shape(
        &mut self,
        head: Option<(&Measures, &Proportions)>,
        pose: &Pose,
        places: &Places,
        size: (f32, f32),
    ) {
        if let Some((measures, proportions)) = head {
            self.mouth.shape(measures, proportions, &mut self.of_head);
        }
        bend_tongue(&self.of_head, pose, &places.jaw, size, &mut self.bent);
        let MouthOfHead { upper, lower, .. } = &self.of_head;
        let bodies = [(upper, &places.head), (lower, &places.mandible), (&self.bent, &places.mandible)];
        for ((plan, values), (control, place)) in self.parts.iter_mut().zip(bodies) {
            self.evaluator.evaluate_into(plan, control, &mut values.positions, &mut values.normals);
            place.carry(&mut values.positions, &mut values.normals);
        }
    }

    pub(super) fn paint(&mut self, look: &Look) {
        let bodies = [&self.mouth.upper, &self.mouth.lower, &self.mouth.tongue];
        for ((plan, values), body) in self.parts.iter_mut().zip(bodies) {
            let tissue = body.tissue();
            let colours: Vec<Vec3> = tissue.iter().map(|&tissue| colour(look, tissue)).collect();
            let surface: Vec<Vec3> = tissue.iter().map(|&tissue| vec3(0.0, gloss(tissue), 0.1)).collect();
            self.evaluator.evaluate_attribute(plan, &colours, &mut values.colours);
            self.evaluator.evaluate_attribute(plan, &surface, &mut values.surface);
        }
    }

    pub(super) fn parts(&self, mouth: bool, tongue: bool) -> impl Iterator<Item = &Values> {
        let shown = [mouth, mouth, tongue];
        self.parts.iter().zip(shown).filter(|(_, shown)| *shown).map(|((_, values), _)| values)
    }
}

/// Shades of the mouth's lining, linear: where that is dark, all of it is.
fn colour(look: &Look, tissue: Tissue) -> Vec3 {
    look.mouth
        * match tissue {
            Tissue::Gum => vec3(1.15, 1.05, 1.05),
            Tissue::Palate => vec3(1.30, 1.45, 1.40),
            Tissue::Floor => vec3(1.0, 0.85, 0.85),
            Tissue::Tongue => vec3(1.45, 1.10, 1.15),
            Tissue::TongueUnder => vec3(1.35, 0.85, 0.95),
        }
}

fn gloss(tissue: Tissue) -> f32 {
    if tissue == Tissue::Tongue { 0.35 } else { 0.6 }
}
