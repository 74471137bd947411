//! The three-connected dual of a √3 level.
//!
//! Guillot and Gourret 2006, "√3 subdivision and 3 connected meshes with creases, boundaries and holes", section 3: keep
//! only the vertices that the last step has made, and make one face for each vertex that is removed, of all new vertices
//! that it was joined to. A new vertex of √3 has six neighbours, old and new in turn, so three are left.
//!
//! Creases need nothing more. After a step that keeps them, the dual's edge runs across the crease, from the middle of the
//! triangle on one side to that on the other; after a step that cuts them, their points are new and their edges stay.
//!
//! At a boundary the paper closes the mesh with a temporary vertex, and does not say what is left of it. After a step that
//! cuts the boundary nothing is missing: the polygon of a removed boundary vertex closes from its one new neighbour along
//! the boundary to the other, and boundary vertices have three neighbours too. After a step that keeps the boundary there
//! is no new vertex on it: see [`Rim`].

use crate::mesh::{DedgeMesh, MeshError, PolygonMesh, VertexId};

use super::plan::Plan;
use super::scheme::Scheme;
use super::stencil::{Blend, StencilTable, Weight};

/// Why there is no dual.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum DualError {
    /// Only a step of √3 joins each new vertex to three old and three new ones.
    #[error(
        "{} has no three-connected dual: its new vertices are not joined in threes; use sqrt3 or sqrt3-interpolating",
        scheme.name()
    )]
    Scheme {
        /// The scheme of the plan.
        scheme: Scheme,
    },
    /// Level 0 has no last step.
    #[error("level 0 has no vertices born in a last step; ask for one level or more")]
    NoStep,
    /// Frozen faces have no new vertices to join.
    #[error("{n_frozen} faces are frozen: nothing was born in them to make a dual of")]
    Frozen {
        /// How many there are.
        n_frozen: usize,
    },
    /// What is left is no surface: nothing at all of a single triangle, for one.
    #[error("the dual is no surface: {0}")]
    NoSurface(#[from] MeshError),
}

/// What to do along boundaries that the last step has kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Rim {
    /// Only born vertices. The polygon of a removed boundary vertex closes straight from its last new neighbour to its first,
    /// and is left out where it has fewer than three. The dual ends up to a triangle short of the boundary; inner vertices
    /// have three neighbours, those on its boundary two to four.
    #[default]
    Born,
    /// One more vertex in the middle of each boundary edge: what the paper's temporary vertex amounts to. The dual reaches
    /// the boundary, has one face for each removed vertex and three neighbours everywhere.
    Middles,
}

/// A mesh of polygons, three to a vertex, and how its vertices come from those of a plan's last level.
#[derive(Clone, Debug, PartialEq)]
pub struct ThreeConnected {
    /// The connectivity. Faces stand in the order of [`removed`](Self::removed).
    pub mesh: PolygonMesh,
    /// For each vertex of the dual that of the last level, ascending. Middles of boundary edges, if asked for, come behind
    /// and have none.
    pub born: Vec<u32>,
    /// For each face of the dual the vertex of the last level that it replaces, ascending.
    pub removed: Vec<u32>,
    /// The two ends of each boundary edge that has a vertex in its middle.
    pub middles: Vec<[u32; 2]>,
    n_sources: usize,
}

impl ThreeConnected {
    /// The dual of a plan's last level, in time linear in it.
    ///
    /// A removed vertex with fewer than three new neighbours has no face: one of valence 2 inside the surface, or a corner of
    /// a boundary with a single triangle. A born vertex without a face is left out.
    ///
    /// # Errors
    /// Another scheme than √3, no step, frozen faces, or nothing left.
    pub fn of(plan: &Plan, rim: Rim) -> Result<ThreeConnected, DualError> {
        let scheme = plan.scheme();
        if !matches!(scheme, Scheme::Sqrt3 | Scheme::Sqrt3Interpolating) {
            return Err(DualError::Scheme { scheme });
        }
        let Some(before) = plan.levels().checked_sub(1) else { return Err(DualError::NoStep) };
        if plan.n_frozen_faces() > 0 {
            return Err(DualError::Frozen { n_frozen: plan.n_frozen_faces() });
        }
        let mesh = DedgeMesh::from_triangles(plan.n_vertices(), plan.indices().as_chunks().0)?;
        let n_old = plan.n_vertices_at(before) as u32;

        let mut middles: Vec<[u32; 2]> = Vec::new();
        // For each old vertex the middle of the boundary edge that leaves it.
        let mut leaving = vec![u32::MAX; n_old as usize];
        if rim == Rim::Middles {
            for vertex in (0..n_old).map(VertexId).filter(|&v| mesh.is_boundary_vertex(v)) {
                let onward = mesh.target(mesh.outgoing(vertex));
                if onward.0 < n_old {
                    leaving[vertex.index()] = (mesh.n_vertices() + middles.len()) as u32;
                    middles.push([vertex.0, onward.0]);
                }
            }
        }

        let (mut sizes, mut corners, mut removed) = (Vec::new(), Vec::new(), Vec::new());
        let mut polygon: Vec<u32> = Vec::new();
        for vertex in (0..n_old).map(VertexId) {
            polygon.clear();
            polygon.extend(Some(leaving[vertex.index()]).filter(|&middle| middle != u32::MAX));
            let mut last = VertexId(u32::MAX);
            for neighbour in mesh.ring(vertex) {
                polygon.extend(Some(neighbour.0).filter(|&n| n >= n_old));
                last = neighbour;
            }
            if mesh.is_boundary_vertex(vertex) && last.0 < n_old {
                polygon.extend(Some(leaving[last.index()]).filter(|&middle| middle != u32::MAX));
            }
            if polygon.len() >= 3 {
                sizes.push(polygon.len() as u32);
                corners.extend_from_slice(&polygon);
                removed.push(vertex.0);
            }
        }

        // Numbers without gaps, in the same order.
        let n_all = mesh.n_vertices() + middles.len();
        let mut number = vec![u32::MAX; n_all];
        corners.iter().for_each(|&v| number[v as usize] = 0);
        let mut born = Vec::new();
        let mut kept_middles = Vec::new();
        for v in (0..n_all).filter(|&v| number[v] == 0).collect::<Vec<_>>() {
            number[v] = (born.len() + kept_middles.len()) as u32;
            if v < mesh.n_vertices() {
                born.push(v as u32);
            } else {
                kept_middles.push(middles[v - mesh.n_vertices()]);
            }
        }
        corners.iter_mut().for_each(|v| *v = number[*v as usize]);
        let n_sources = mesh.n_vertices();
        let mesh = PolygonMesh::from_faces(born.len() + kept_middles.len(), &sizes, &corners)?;
        Ok(ThreeConnected { mesh, born, removed, middles: kept_middles, n_sources })
    }

    /// Positions, or any other values, of the dual's vertices: those of the last level's vertices that it keeps, then the
    /// middles.
    ///
    /// # Panics
    /// Where `level` has another length than the plan's last level has vertices.
    pub fn values<W: Weight, P: Blend<W>>(&self, level: &[P]) -> Vec<P> {
        assert_eq!(level.len(), self.n_sources, "one value for each vertex of the last level");
        let kept = self.born.iter().map(|&v| level[v as usize]);
        let half = W::from_f64(0.5);
        let middle = |&[a, b]: &[u32; 2]| level[a as usize].scaled(half).plus(level[b as usize].scaled(half));
        kept.chain(self.middles.iter().map(middle)).collect()
    }

    /// The same as a table over the vertices of the last level, for what goes through tables.
    pub fn table(&self) -> StencilTable {
        let n_rows = self.mesh.n_vertices();
        let mut builder = StencilTable::builder(self.n_sources, n_rows, n_rows + self.middles.len());
        for &vertex in &self.born {
            builder.entry(vertex, 1.0);
            builder.end_row();
        }
        for ends in &self.middles {
            ends.iter().for_each(|&end| builder.entry(end, 0.5));
            builder.end_row();
        }
        builder.finish()
    }
}
