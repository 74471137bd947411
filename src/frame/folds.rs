//! Folds of loose skin on the refined skin: what stands out of it at rest.

use super::values::Values;
use crate::rig::Rig;
use crate::rig::folds::{Heights, Site, looseness};
use crate::subdiv::{Plan, evaluate_once};
use glam::Vec3;

/// The folds of one head on one level's skin.
#[derive(Clone, Debug, Default)]
pub(super) struct Folds {
    /// Of each vertex; none until a head has folds.
    sites: Vec<Site>,
    /// How far each vertex stands out, metres; none where there are no folds.
    heights: Vec<f32>,
    /// Whether the normal of each vertex is another.
    is_near: Vec<bool>,
}

impl Folds {
    /// Finds how far the skin stands out; `rest`: its places on the base head, metres there; `shown`: whether the level is
    /// fine enough.
    pub(super) fn shape(&mut self, rig: &Rig, plan: &Plan, rest: &[Vec3], values: &[f32], shown: bool) {
        self.heights.clear();
        let heights = Heights::of(&rig.measures(values), rig.proportions(values).scale);
        if !(shown && heights.is_any()) {
            return;
        }
        if self.sites.is_empty() {
            let loose: Vec<Vec3> = rig.half().whole_regions().into_iter().map(|r| Vec3::splat(looseness(r))).collect();
            let (loose, _) = evaluate_once(plan, &loose);
            self.sites = rest.iter().zip(loose).map(|(&p, loose)| Site::new(p * 100.0, loose.x)).collect();
        }
        self.heights.extend(self.sites.iter().map(|site| site.height(&heights)));
        self.is_near.clear();
        self.is_near.resize(rest.len(), false);
        for t in plan.indices().as_chunks::<3>().0 {
            if t.iter().any(|&v| self.heights[v as usize] > 0.0) {
                t.iter().for_each(|&v| self.is_near[v as usize] = true);
            }
        }
    }

    /// Whether the head has any.
    pub(super) fn is_there(&self) -> bool {
        !self.heights.is_empty()
    }

    /// Puts them on the skin, in whatever pose it is.
    pub(super) fn raise(&self, indices: &[u32], skin: &mut Values) {
        if !self.is_there() {
            return;
        }
        for ((p, n), height) in skin.positions.iter_mut().zip(&skin.normals).zip(&self.heights) {
            *p += *n * *height;
        }
        // Area-weighted, in the order of the faces: the same sum whatever the number of threads.
        for (n, _) in skin.normals.iter_mut().zip(&self.is_near).filter(|(_, near)| **near) {
            *n = Vec3::ZERO;
        }
        for t in indices.as_chunks::<3>().0 {
            if t.iter().any(|&v| self.is_near[v as usize]) {
                let [a, b, c] = t.map(|v| skin.positions[v as usize]);
                let area = (b - a).cross(c - a);
                for &v in t.iter().filter(|&&v| self.is_near[v as usize]) {
                    skin.normals[v as usize] += area;
                }
            }
        }
        for (n, _) in skin.normals.iter_mut().zip(&self.is_near).filter(|(_, near)| **near) {
            *n = n.normalize_or(Vec3::Y);
        }
    }
}
