//! Third eyelids and lines of tears as drawable parts.

use super::PipelineError;
use super::parts::{Material, MaterialRange, PartTopology};
use super::values::Values;
use crate::anatomy::Look;
use crate::mesh::DedgeMesh;
use crate::rig::eyelids::{self, tear_line_mesh, third_eyelid_mesh};
use crate::rig::{ControlError, Eye, Proportions, Rig, Rigid};
use crate::subdiv::{Evaluator, Plan, Scheme};
use glam::{Vec3, vec3};

/// Steps of Loop's scheme.
const STEPS: u32 = 1;

/// One of the left eye, and its mirror image.
struct Pair {
    plan: Plan,
    sides: [Values; 2],
}

/// Their plans and what they draw.
pub(super) struct EyelidParts {
    evaluator: Evaluator,
    /// The lower lids' inner margins from the lateral corner to the medial one, left and right: vertices of the skin at
    /// every level.
    margins: [[usize; 7]; 2],
    control: Vec<Vec3>,
    third: Pair,
    tears: Pair,
}

impl EyelidParts {
    pub(super) fn new(rig: &Rig) -> Result<Self, PipelineError> {
        let third = third_eyelid_mesh().map_err(ControlError::Mesh)?;
        let tears = tear_line_mesh().map_err(ControlError::Mesh)?;
        let third = Pair::new(&third, ["third_eyelid_L", "third_eyelid_R"], Material::ThirdEyelid)?;
        let tears = Pair::new(&tears, ["tears_L", "tears_R"], Material::Tears)?;
        let inner = rig.plan().handles().ei;
        let margin: [usize; 7] = std::array::from_fn(|k| usize::from(inner[(6 + k) % 12]));
        let mirror = rig.half().mirror();
        let margins = [margin, margin.map(|v| mirror[v] as usize)];
        Ok(Self { evaluator: Evaluator::new(&third.plan), margins, control: Vec::new(), third, tears })
    }

    /// `eyes`: left and right, where they are; `closed`: how far the lids are shut, 0 to 1, left and right; `skin`: positions of the refined skin; `head`: where the skull is; `alike`:
    /// whether both sides are mirror images.
    pub(super) fn shape(
        &mut self,
        proportions: &Proportions,
        (eyes, closed): (&[Eye; 2], [f32; 2]),
        skin: &[Vec3],
        head: &Rigid,
        alike: bool,
    ) {
        let Self { evaluator, margins, control, third, tears } = self;
        let in_head = |eye: &Eye| {
            if head.is_rest() {
                return *eye;
            }
            let back = head.turn.transpose();
            Eye { centre: head.back(eye.centre), axes: eye.axes.map(|a| back * a), ..*eye }
        };
        let flip = |p: Vec3| vec3(-p.x, p.y, p.z);
        let margin = |side: usize| {
            margins[side].map(|v| {
                let p = if head.is_rest() { skin[v] } else { head.back(skin[v]) };
                if side == 0 { p } else { flip(p) }
            })
        };
        // Both are made as left ones; the right one first, so that the left one is there when it is done.
        let sides: &[usize] = if alike { &[0] } else { &[1, 0] };
        for &side in sides {
            let eye = if side == 0 { in_head(&eyes[0]) } else { in_head(&eyes[1]).mirrored() };
            eyelids::third_eyelid(proportions, &eye, closed[side], control);
            third.left(evaluator, control);
            eyelids::tear_line(&eye, &margin(side), control);
            tears.left(evaluator, control);
            if side == 1 || alike {
                third.mirror();
                tears.mirror();
            }
        }
        for values in third.sides.iter_mut().chain(&mut tears.sides) {
            head.carry(&mut values.positions, &mut values.normals);
        }
    }

    pub(super) fn paint(&mut self, look: &Look) {
        // The membrane shares the lids' pigment: pink where they are pale.
        let membrane = (look.mouth * 0.8).lerp(look.lips, 0.68);
        let wet = look.lips.lerp(look.mouth, 0.35) * 0.8;
        for (pair, colour, gloss) in [(&mut self.third, membrane, 0.8), (&mut self.tears, wet, 1.0)] {
            for values in &mut pair.sides {
                values.colours.fill(colour);
                values.surface.fill(vec3(0.0, gloss, 0.2));
            }
        }
    }

    pub(super) fn parts(&self) -> impl Iterator<Item = &Values> {
        self.third.sides.iter().chain(&self.tears.sides)
    }
}

impl Pair {
    fn new(left: &DedgeMesh, names: [&'static str; 2], material: Material) -> Result<Self, PipelineError> {
        let plan = Plan::build(left, Scheme::Loop, STEPS)?;
        let mut mirrored = plan.indices().to_vec();
        mirrored.as_chunks_mut::<3>().0.iter_mut().for_each(|t| t.swap(1, 2));
        let values = |name: &'static str, indices: Vec<u32>| {
            let ranges = vec![MaterialRange { material, start: 0, count: indices.len() as u32 }];
            Values::new(PartTopology { name, n_vertices: plan.n_vertices(), indices, ranges })
        };
        let sides = [values(names[0], plan.indices().to_vec()), values(names[1], mirrored)];
        Ok(Self { plan, sides })
    }

    fn left(&mut self, evaluator: &mut Evaluator, control: &[Vec3]) {
        let left = &mut self.sides[0];
        evaluator.evaluate_into(&self.plan, control, &mut left.positions, &mut left.normals);
    }

    /// Makes the right one the mirror image of the left.
    fn mirror(&mut self) {
        let [left, right] = &mut self.sides;
        for (from, to) in [(&left.positions, &mut right.positions), (&left.normals, &mut right.normals)] {
            from.iter().zip(to).for_each(|(l, r)| *r = vec3(-l.x, l.y, l.z));
        }
    }
}
