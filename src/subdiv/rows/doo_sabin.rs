//! Rows of Doo-Sabin.

use crate::mesh::PolygonMesh;

use crate::subdiv::doo_sabin as masks;
use crate::subdiv::stencil::{StencilTable, Weight};

/// One row for each vertex of the child: for each corner of each face of the parent.
pub(in crate::subdiv) fn table<W: Weight>(mesh: &PolygonMesh) -> StencilTable<W> {
    let n_rows = mesh.n_dedges();
    let mut builder = StencilTable::builder(mesh.n_vertices(), n_rows, 4 * n_rows);
    let mut weights: Vec<f64> = Vec::new();
    for face in mesh.faces() {
        let corners = mesh.corners(face);
        if weights.len() != corners.len() {
            weights = (0..corners.len()).map(|k| masks::corner(corners.len(), k)).collect();
        }
        for first in 0..corners.len() {
            for (&corner, &weight) in corners[first..].iter().chain(&corners[..first]).zip(&weights) {
                builder.entry(corner, weight);
            }
            builder.end_row();
        }
    }
    builder.finish()
}
