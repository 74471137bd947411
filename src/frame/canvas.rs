//! A skin's colours between its vertices, for who paints it finer than it is refined.

use super::skin::leathered;
use crate::anatomy::Look;
use crate::coat::{Chart, Colours, Fibre};
use crate::rig::Rig;
use crate::subdiv::{Plan, evaluate_once};
use glam::Vec3;

/// The colours of a look on a skin, ready to be asked for at any place. At a vertex they are those of the skin's part.
#[derive(Debug)]
pub struct Canvas<'a> {
    /// Every coat with its share.
    coats: Vec<(f32, Colours<'a>)>,
    /// At each vertex the colour of leather times how much of it shows.
    leathers: Vec<Vec3>,
    /// x: how much that is, 0 to 1.
    bare: Vec<Vec3>,
}

impl<'a> Canvas<'a> {
    /// `leathers` and `bare`: of the control vertices.
    pub(super) fn new(
        rig: &Rig,
        plan: &Plan,
        chart: &'a Chart,
        look: &'a Look,
        [leathers, bare]: [&[Vec3]; 2],
    ) -> Self {
        let coats = look.shares().map(|(share, pattern)| (share, Colours::new(pattern, rig, plan, chart))).collect();
        let [leathers, bare] = [leathers, bare].map(|control| evaluate_once(plan, control).0);
        Self { coats, leathers, bare }
    }

    /// Number of the skin's vertices.
    pub fn n_vertices(&self) -> usize {
        self.leathers.len()
    }

    /// Linear colour at a place given by vertices of the skin (below [`n_vertices`](Self::n_vertices)) and their weights, which
    /// sum to 1.
    pub fn colour(&self, place: &[(usize, f32)]) -> Vec3 {
        self.of(place, Fibre::Skin)
    }

    /// The same of one stroke of hair there: what of each hair is its own follows from `own`, 0 to 1, whose values are equally
    /// frequent.
    pub fn stroke(&self, place: &[(usize, f32)], own: f32) -> Vec3 {
        self.of(place, Fibre::Stroke(own))
    }

    fn of(&self, place: &[(usize, f32)], fibre: Fibre) -> Vec3 {
        let coat = self.coats.iter().fold(Vec3::ZERO, |sum, (share, coat)| sum + coat.between(place, fibre) * *share);
        let mixed = |values: &[Vec3]| place.iter().fold(Vec3::ZERO, |sum, &(v, weight)| sum + values[v] * weight);
        leathered(coat, mixed(&self.leathers), mixed(&self.bare))
    }
}
