//! The colours of the last look's coats on the skin and the hair of one level. A coat that the next look has too is not
//! asked again: while two breeds are mixed more or less, only their shares change.

use crate::anatomy::{Look, Pattern};
use crate::coat::{Chart, Colours, Root};
use crate::rig::Rig;
use crate::subdiv::Plan;
use glam::Vec3;

/// Made with the first look of a level; forgotten with the level and the roots.
#[derive(Debug, Default)]
pub(super) struct Dyes {
    chart: Option<Chart>,
    dyes: Vec<Dye>,
}

#[derive(Debug)]
struct Dye {
    pattern: Pattern,
    /// One for each vertex.
    skin: Vec<Vec3>,
    /// One for each root.
    hair: Vec<Vec3>,
}

impl Dyes {
    /// Another level.
    pub(super) fn forget(&mut self) {
        *self = Self::default();
    }

    /// The chart of the plan's skin.
    pub(super) fn chart(&mut self, rig: &Rig, plan: &Plan) -> &Chart {
        self.chart.get_or_insert_with(|| Chart::new(rig, plan))
    }

    /// Other roots on the same skin.
    pub(super) fn forget_hair(&mut self) {
        self.dyes.clear();
    }

    /// The chart of the level, once something has been painted.
    pub(super) fn known_chart(&self) -> Option<&Chart> {
        self.chart.as_ref()
    }

    /// Linear colours of a look on every vertex of the plan's skin and every root; `triangles` are those of the roots.
    #[expect(clippy::too_many_arguments, reason = "what is painted and where it goes")]
    pub(super) fn paint(
        &mut self,
        rig: &Rig,
        plan: &Plan,
        look: &Look,
        (roots, triangles): (&[Root], &[[u32; 3]]),
        threads: usize,
        skin: &mut Vec<Vec3>,
        hair: &mut Vec<Vec3>,
    ) {
        let chart = self.chart.get_or_insert_with(|| Chart::new(rig, plan));
        self.dyes.retain(|dye| look.shares().any(|(_, pattern)| *pattern == dye.pattern));
        for values in [&mut *skin, &mut *hair] {
            values.clear();
        }
        skin.resize(plan.n_vertices(), Vec3::ZERO);
        hair.resize(roots.len(), Vec3::ZERO);
        for (share, pattern) in look.shares() {
            let known = self.dyes.iter().position(|dye| dye.pattern == *pattern);
            let at = known.unwrap_or_else(|| {
                let colours = Colours::new(pattern, rig, plan, chart);
                let (skin, hair) = (colours.of_skin(threads), colours.of_hair(roots, triangles, threads));
                self.dyes.push(Dye { pattern: pattern.clone(), skin, hair });
                self.dyes.len() - 1
            });
            let dye = &self.dyes[at];
            for (out, from) in [(&mut *skin, &dye.skin), (&mut *hair, &dye.hair)] {
                out.iter_mut().zip(from).for_each(|(to, colour)| *to += *colour * share);
            }
        }
    }
}
