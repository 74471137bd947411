//! Which joints each vertex goes with, and how much.

use super::joints::{EARS, EYES, HEAD, JAW, N_JOINTS, NECK, TONGUE, between};
use super::puppet::{ON_TONGUE, Puppet};
use super::{n_drawn, part};
use crate::frame::{Frame, Part};
use crate::rig::{EAR_RINGS, Rig};
use crate::subdiv::{Evaluator, Plan};
use glam::{Vec3, vec3};

/// A weight for each joint; their sum is 1.
pub(super) type Dense = [f32; N_JOINTS];

/// At most four joints of a vertex; the weights are parts of 65535, which is their sum.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Influences {
    /// Numbers of the joints; 0 where there is none.
    pub joints: [u8; 4],
    /// Their weights, falling.
    pub weights: [u16; 4],
}

/// Where an ear's joints stand among its rings; before the first what goes with the head.
const ON_EAR: [f32; 4] = [-1.0, 1.5, 4.0, 7.0];

/// Parts of a vertex: x the head's, of what the neck leaves, y the jaw's of that; left ear; right ear.
type Parts = [Vec3; 3];

/// Weights of all that is drawn.
pub(super) struct Weighing {
    /// Of each vertex of the refined skin, and of each whisker.
    skin: Vec<Dense>,
    whiskers: Vec<Dense>,
    tongue: [f32; 2],
}

impl Weighing {
    /// `rest`: the frame at rest.
    pub fn new(puppet: &Puppet, rest: &Frame<'_>) -> Self {
        let skin = rest.plan.map(|plan| refined(puppet.rig(), plan)).unwrap_or_default();
        let of_skin = part(rest, "skin").map(|skin| skin.positions).unwrap_or_default();
        let root = |p: Vec3| {
            let near = of_skin.iter().enumerate().fold((f32::INFINITY, 0), |(d, best), (v, q)| {
                let distance = p.distance_squared(*q);
                if distance < d { (distance, v) } else { (d, best) }
            });
            skin.get(near.1).copied().unwrap_or(rigid(HEAD))
        };
        let whiskers = rest.whiskers.iter().map(|whisker| root(whisker.position)).collect();
        Self { skin, whiskers, tongue: puppet.tongue_ends() }
    }

    /// One for each vertex to draw.
    pub fn of_part(&self, part: &Part<'_>) -> Vec<Influences> {
        let of = |v: u32| -> Dense {
            let v = v as usize;
            match part.topology.name {
                "skin" => self.skin[v],
                "neck_cap" => rigid(NECK),
                "eye_L" => rigid(EYES[0]),
                "eye_R" => rigid(EYES[1]),
                "mandible" | "teeth_lower" | "gums_lower" => rigid(JAW),
                "tongue" => {
                    let [back, front] = self.tongue;
                    let at = (part.positions[v].z - back) / (front - back).max(1e-6);
                    of_tongue(between(at, &ON_TONGUE))
                }
                // They stand one after the other, with as many vertices each.
                "whiskers" => self.whiskers[v * self.whiskers.len() / part.topology.n_vertices],
                _ => rigid(HEAD),
            }
        };
        let pair = |v: usize| part.uv.map_or([v as u32; 2], |uv| uv.vertices[v]);
        (0..n_drawn(part))
            .map(|v| {
                let [a, b] = pair(v).map(of);
                Influences::new(&std::array::from_fn(|j| 0.5 * (a[j] + b[j])))
            })
            .collect()
    }
}

impl Influences {
    /// The four heaviest, rounded so that their sum is exact.
    fn new(dense: &Dense) -> Self {
        let mut order: [usize; N_JOINTS] = std::array::from_fn(|j| j);
        order.sort_by(|&a, &b| dense[b].total_cmp(&dense[a]));
        let sum: f32 = order[..4].iter().map(|&j| dense[j]).sum();
        let exact: [f32; 4] = std::array::from_fn(|k| dense[order[k]] / sum * 65535.0);
        let mut weights = exact.map(|w| (w + 0.5) as u16);
        let given: i64 = weights[1..].iter().map(|&w| i64::from(w)).sum();
        weights[0] = (65535 - given) as u16;
        let joints = std::array::from_fn(|k| if weights[k] > 0 { order[k] as u8 } else { 0 });
        Self { joints, weights }
    }

    /// A weight for each joint.
    pub(super) fn dense(&self) -> Dense {
        let mut out = [0.0; N_JOINTS];
        for (&joint, &weight) in self.joints.iter().zip(&self.weights) {
            out[usize::from(joint)] += f32::from(weight) / 65535.0;
        }
        out
    }
}

fn rigid(joint: usize) -> Dense {
    std::array::from_fn(|j| if j == joint { 1.0 } else { 0.0 })
}

/// Between two joints of the tongue; its root grows out of the floor of the mouth, which is the jaw's.
pub(super) fn of_tongue((a, b, part): (usize, usize, f32)) -> Dense {
    let mut out = [0.0; N_JOINTS];
    out[TONGUE[a]] += 1.0 - part;
    out[TONGUE[b]] += part;
    out
}

/// Of each vertex of the control mesh.
pub(super) fn of_control(rig: &Rig) -> Vec<Dense> {
    let [a, b, c] = parts(rig);
    (0..a.len()).map(|v| dense([a[v], b[v], c[v]])).collect()
}

/// Through the same stencils as positions.
fn refined(rig: &Rig, plan: &Plan) -> Vec<Dense> {
    let mut evaluator = Evaluator::new(plan);
    let [a, b, c] = parts(rig).map(|control| {
        let mut out = vec![Vec3::ZERO; plan.n_vertices()];
        evaluator.evaluate_attribute(plan, &control, &mut out);
        out
    });
    (0..a.len()).map(|v| dense([a[v], b[v], c[v]])).collect()
}

fn parts(rig: &Rig) -> [Vec<Vec3>; 3] {
    let (jaw, neck) = (rig.posing().jaw_weights(), rig.posing().neck_weights());
    let end = rig.posing().neck_end_weight();
    let first = jaw.iter().zip(neck).map(|(&jaw, &neck)| vec3((neck - end) / (1.0 - end), jaw, 0.0)).collect();
    let mut ears = [vec![Vec3::ZERO; jaw.len()], vec![Vec3::ZERO; jaw.len()]];
    let handles = rig.plan().handles();
    for ring in 0..=EAR_RINGS {
        let vertices = if ring < EAR_RINGS { &handles.a[ring][..] } else { &handles.ear_end[..] };
        let (a, b, part) = between(ring as f32, &ON_EAR);
        let mut weights = [0.0; 4];
        weights[a] += 1.0 - part;
        weights[b] += part;
        let weights = vec3(weights[1], weights[2], weights[3]);
        for v in vertices.iter().map(|&v| usize::from(v)) {
            ears[0][v] = weights;
            ears[1][rig.image(v)] = weights;
        }
    }
    let [left, right] = ears;
    [first, left, right]
}

fn dense([first, left, right]: Parts) -> Dense {
    let one = |w: f32| w.clamp(0.0, 1.0);
    let (head, jaw) = (one(first.x), one(first.y));
    let mut out = [0.0; N_JOINTS];
    let mut rest = head;
    for (side, parts) in [left, right].into_iter().enumerate() {
        for (&joint, part) in EARS[side].iter().zip(parts.to_array()) {
            out[joint] = head * one(part);
            rest -= out[joint];
        }
    }
    rest = rest.max(0.0);
    (out[NECK], out[HEAD], out[JAW]) = (1.0 - head, rest * (1.0 - jaw), rest * jaw);
    out
}

#[cfg(test)]
mod tests {
    use super::{Influences, N_JOINTS};

    #[test]
    fn rounded_weights_do_not_sum_to_one() {
        let mut dense = [0.0; N_JOINTS];
        (dense[2], dense[5], dense[7], dense[9], dense[11]) = (0.3333, 0.3333, 0.3333, 0.00009, 0.00001);
        let influences = Influences::new(&dense);
        assert_eq!(influences.weights.iter().map(|&w| u32::from(w)).sum::<u32>(), 65535);
        let mut one = [0.0; N_JOINTS];
        one[3] = 1.0;
        assert_eq!(Influences::new(&one), Influences { joints: [3, 0, 0, 0], weights: [65535, 0, 0, 0] });
    }
}
