//! Which weights of the targets come nearest to a pose whose joints are placed.
//!
//! A clip may drive a muscle past its units, of two units that share a muscle the stronger one counts, and what joints leave
//! over grows faster than their turn: so weights are not just read off the units. They are the least squares solution between
//! 0 and 1 that stays near to the units' own strengths, one weight after the other (coordinate descent).

use super::targets::{Kind, Target};
use crate::motion::{Library, Moment, Pose};
use glam::Vec3;

/// How much an own strength counts against what is seen, as a part of the target's own size.
const LOYALTY: f64 = 0.01;
const ROUNDS: usize = 60;
/// What is less is nothing.
const LEAST: f32 = 2e-3;

/// The targets as the puppet has them.
pub(super) struct Mix {
    /// For each target the points of the puppet that it moves, and where to.
    shapes: Vec<Vec<(u32, Vec3)>>,
    /// Of each pair, the sum of the products.
    products: Vec<Vec<f64>>,
}

impl Mix {
    /// `shapes`: for each target, where it moves each point of the puppet.
    pub fn new(targets: &[Target], shapes: &[Vec<Vec3>]) -> Self {
        let dot = |a: &[Vec3], b: &[Vec3]| a.iter().zip(b).map(|(a, b)| f64::from(a.dot(*b))).sum::<f64>();
        let is_used = |k: usize| targets[k].kind != Kind::WithoutJoints;
        let product = |a: usize, b: usize| if is_used(a) && is_used(b) { dot(&shapes[a], &shapes[b]) } else { 0.0 };
        let all = 0..targets.len();
        let products = all.clone().map(|a| all.clone().map(|b| product(a, b)).collect()).collect();
        let moved = |shape: &Vec<Vec3>| {
            let all = shape.iter().enumerate().filter(|(_, d)| **d != Vec3::ZERO);
            all.map(|(v, &d)| (v as u32, d)).collect()
        };
        Self { shapes: shapes.iter().map(moved).collect(), products }
    }

    /// A weight for each target. `missing`: what the joints leave over of the pose, `asked`: its units, resolved, and
    /// what it moves beside them.
    pub fn weights(
        &self,
        library: &Library,
        targets: &[Target],
        missing: &[Vec3],
        pose: &Pose,
        asked: &Moment,
    ) -> Vec<f32> {
        let own: Vec<f64> = targets.iter().map(|t| f64::from(t.strength(library, asked))).collect();
        let may: Vec<usize> = (0..targets.len())
            .filter(|&k| self.products[k][k] > 0.0)
            .filter(|&k| own[k] > 0.0 || targets[k].takes_part(library, pose))
            .collect();
        let wanted: Vec<f64> = self
            .shapes
            .iter()
            .map(|shape| shape.iter().map(|&(v, d)| f64::from(d.dot(missing[v as usize]))).sum())
            .collect();
        let mut weights = vec![0.0; targets.len()];
        may.iter().for_each(|&k| weights[k] = own[k]);
        // What moves nothing of the puppet, as pupils, is as strong as it is asked for.
        let is_unseen = |k: &usize| targets[*k].kind == Kind::Shape && self.shapes[*k].is_empty();
        (0..targets.len()).filter(is_unseen).for_each(|k| weights[k] = own[k]);
        for _ in 0..ROUNDS {
            for &k in &may {
                let size = self.products[k][k];
                let others: f64 = may.iter().filter(|&&o| o != k).map(|&o| self.products[k][o] * weights[o]).sum();
                let best = (wanted[k] - others + LOYALTY * size * own[k]) / (size * (1.0 + LOYALTY));
                weights[k] = best.clamp(0.0, 1.0);
            }
        }
        weights.into_iter().map(|w| w as f32).map(|w| if w < LEAST { 0.0 } else { w }).collect()
    }
}
