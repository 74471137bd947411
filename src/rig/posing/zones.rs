//! Weights on the control mesh that no measure changes: how far along the skin a vertex lies from others, and smooth
//! passages between vertices that are held.

pub(super) use crate::math::ops::smoothstep;
use crate::mesh::{DedgeMesh, VertexId};
use glam::Vec3;
use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Neighbours of each vertex, ascending.
pub(super) struct Neighbours {
    offsets: Vec<u32>,
    list: Vec<u32>,
}

impl Neighbours {
    pub(super) fn new(mesh: &DedgeMesh) -> Self {
        let (mut offsets, mut list) = (vec![0], Vec::new());
        let mut pairs: Vec<(u32, u32)> = mesh
            .indices()
            .as_chunks::<3>()
            .0
            .iter()
            .flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a), (b, a), (c, b), (a, c)])
            .collect();
        pairs.sort_unstable();
        pairs.dedup();
        let mut pairs = pairs.into_iter().peekable();
        for v in 0..mesh.n_vertices() as u32 {
            while let Some((_, to)) = pairs.next_if(|(from, _)| *from == v) {
                list.push(to);
            }
            offsets.push(list.len() as u32);
        }
        Self { offsets, list }
    }

    pub(super) fn of(&self, VertexId(v): VertexId) -> &[u32] {
        &self.list[self.offsets[v as usize] as usize..self.offsets[v as usize + 1] as usize]
    }

    /// Shortest ways along edges from the nearest of `from` (vertex, length of the way to it) to every vertex no farther
    /// than `reach`; others are infinitely far (Dijkstra 1959).
    pub(super) fn ways(&self, at: &[Vec3], from: &[(u32, f32)], reach: f32) -> Vec<f32> {
        let mut far = vec![f32::INFINITY; at.len()];
        // Lengths are not negative, so that their bits are in their order.
        let mut next: BinaryHeap<Reverse<(u32, u32)>> = BinaryHeap::new();
        for &(v, d) in from {
            if d < far[v as usize] {
                far[v as usize] = d;
                next.push(Reverse((d.to_bits(), v)));
            }
        }
        while let Some(Reverse((bits, v))) = next.pop() {
            let d = f32::from_bits(bits);
            if d > far[v as usize] {
                continue;
            }
            for &n in self.of(VertexId(v)) {
                let way = d + at[v as usize].distance(at[n as usize]);
                if way < far[n as usize] && way <= reach {
                    far[n as usize] = way;
                    next.push(Reverse((way.to_bits(), n)));
                }
            }
        }
        far
    }

    /// A weight for each vertex: what is held stays, the rest is the mean of its neighbours, nearly (Jacobi's iteration).
    pub(super) fn passage(&self, held: &[Option<f32>], rounds: usize) -> Vec<f32> {
        let mut at: Vec<f32> = held.iter().map(|h| h.unwrap_or(0.5)).collect();
        for _ in 0..rounds {
            let before = at.clone();
            for (v, h) in held.iter().enumerate() {
                if h.is_none() {
                    let ring = self.of(VertexId(v as u32));
                    at[v] = ring.iter().map(|&n| before[n as usize]).sum::<f32>() / ring.len() as f32;
                }
            }
        }
        at
    }
}

/// 1 at the middle, 0 from `reach` on, level at both.
pub(super) fn fade(distance: f32, reach: f32) -> f32 {
    let t = 1.0 - (distance / reach.max(1e-6)).min(1.0) * (distance / reach.max(1e-6)).min(1.0);
    t * t
}
