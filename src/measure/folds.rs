//! Whether a head is one: no edge of the skin at level 1 folds beyond 170 degrees where none may.

use crate::anatomy::Breed;
use crate::frame::skin_tags;
use crate::mesh::{DedgeMesh, MeshError};
use crate::rig::{Deformed, Rig, deform};
use crate::subdiv::{Evaluator, Plan, PlanError, PlanOptions, Scheme};
use glam::Vec3;
use std::sync::Arc;

/// Starts of the names of control vertices about which the skin may fold flat: the lining of the mouth, the leather of
/// the ear, the corner of the closed mouth.
pub const MAY_FOLD: [&str; 12] =
    ["mu.", "ml.", "a0.", "a1.", "a2.", "a3.", "a4.", "a5.", "a6.", "a7.", "a8.", "s.10.9"];

/// Cosine of 170 degrees between the normals of an edge's two faces.
const FOLDED: f32 = -0.984_807_7;

/// Finds folds; made once, asked for any number of heads.
pub struct Folds {
    rig: Arc<Rig>,
    plan: Plan,
    evaluator: Evaluator,
    head: Deformed,
    /// The two faces of every edge that may not fold.
    edges: Vec<[u32; 2]>,
}

/// Why folds cannot be looked for.
#[derive(Debug, thiserror::Error)]
pub enum FoldsError {
    /// The skin has no plan.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The refined skin is no manifold.
    #[error(transparent)]
    Mesh(#[from] MeshError),
}

impl Folds {
    /// Prepares the skin of a rig.
    ///
    /// # Errors
    /// A control mesh that cannot be refined, which a test excludes.
    pub fn new(rig: Arc<Rig>) -> Result<Self, FoldsError> {
        let plan = Plan::build_with(rig.mesh(), &skin_tags(&rig), &PlanOptions::new(Scheme::Sqrt3, 1))?;
        let triangles: Vec<[u32; 3]> = plan.indices().chunks_exact(3).map(|t| [t[0], t[1], t[2]]).collect();
        let mesh = DedgeMesh::from_triangles(plan.n_vertices(), &triangles)?;
        let free = free_vertices(&rig, plan.n_vertices());
        let edges = mesh.dedges().filter_map(|dedge| {
            let twin = mesh.twin(dedge)?;
            let is_free = [mesh.origin(dedge), mesh.target(dedge)].iter().any(|v| free[v.index()]);
            (dedge < twin && !is_free).then(|| [mesh.face(dedge).0, mesh.face(twin).0])
        });
        let edges = edges.collect();
        Ok(Self { evaluator: Evaluator::new(&plan), head: Deformed::default(), edges, plan, rig })
    }

    /// Number of edges that are folded and may not be, in the head of these values (SI, one per row of the rig's table).
    pub fn count(&mut self, values: &[f32]) -> usize {
        self.rig.deform(values, deform::ROUNDS, &mut self.head);
        let skin = self.evaluator.evaluate(&self.plan, &self.head.control);
        let normal = |face: u32| {
            let [a, b, c] = [0, 1, 2].map(|k| skin.positions[skin.indices[3 * face as usize + k] as usize]);
            (b - a).cross(c - a).normalize_or_zero()
        };
        let normals: Vec<Vec3> = (0..skin.indices.len() as u32 / 3).map(normal).collect();
        self.edges.iter().filter(|[f, g]| normals[*f as usize].dot(normals[*g as usize]) < FOLDED).count()
    }

    /// The first of at most `most` dogs (at least one is drawn) whose skin does not fold, else the last; and whether it is
    /// without folds.
    ///
    /// # Errors
    /// The first error of `draw`.
    pub fn unfolded<E>(&mut self, most: u32, mut draw: impl FnMut() -> Result<Breed, E>) -> Result<(Breed, bool), E> {
        for _ in 1..most {
            let dog = draw()?;
            if self.count(&dog.values) == 0 {
                return Ok((dog, true));
            }
        }
        let last = draw()?;
        let is_unfolded = self.count(&last.values) == 0;
        Ok((last, is_unfolded))
    }
}

/// Which vertices of level 1 may stand in a fold: control vertices, and the middles of control faces, which follow them.
fn free_vertices(rig: &Rig, n_vertices: usize) -> Vec<bool> {
    let (half, mesh) = (rig.half(), rig.mesh());
    let named: Vec<bool> = half.tags.iter().map(|tag| MAY_FOLD.iter().any(|name| tag.starts_with(name))).collect();
    let mut free = named.clone();
    free.extend(half.midline.iter().zip(&named).filter(|(middle, _)| !**middle).map(|(_, free)| *free));
    let faces = mesh.indices().chunks_exact(3).map(|t| t.iter().any(|&v| free[v as usize]));
    let faces: Vec<bool> = faces.collect();
    free.extend(faces);
    free.resize(n_vertices, false);
    free
}
