//! Where vertices on sharp edges go in the limit, asked of the engine that refines the head. The rig knows the smooth
//! rule by itself and the others by these rows: it stays below the engine, and there is one truth about creases.

use super::bake::BakeError;
use crate::mesh::VertexId;
use crate::rig::{ControlError, HalfMesh, LimitRow};
use crate::subdiv::{DoublePlan, INFINITE_SHARPNESS, PlanOptions, Scheme, Tags};
use std::collections::BTreeMap;

/// What is sharp of the whole mesh.
pub(super) fn tags(half: &HalfMesh) -> Tags {
    let creases = half.whole_creases().map(|(a, b, sharpness)| (VertexId(a), VertexId(b), sharpness)).collect();
    Tags { creases, ..Tags::default() }
}

/// The limit of each vertex of the half that lies on a sharp edge. Where an edge ends it runs into the smooth skin, and
/// the smooth rule is near enough.
pub(super) fn rows(half: &HalfMesh) -> Result<Vec<LimitRow>, BakeError> {
    let tags = tags(half);
    // Two steps use up one of sharpness; then what is not sharp for ever is smooth, and the masks of the limit are exact.
    let ending = tags.creases.iter().map(|crease| crease.2).filter(|&s| s < INFINITE_SHARPNESS).fold(0.0, f32::max);
    let options = PlanOptions::new(Scheme::Sqrt3, 2 * ending.ceil() as u32);
    let rows = whole_rows(half, &tags, &options)?;
    let n = half.n_half();
    let mut own: Vec<(u16, bool)> = (0..n as u16).map(|v| (v, false)).collect();
    own.extend((0..n as u16).filter(|&v| !half.midline[v as usize]).map(|v| (v, true)));
    let n_sharp = |v: usize| tags.creases.iter().filter(|c| c.0.index() == v || c.1.index() == v).count();
    let row = |v: usize| {
        let source = |(&s, &weight): (&u32, &f64)| (own[s as usize].0, own[s as usize].1, weight as f32);
        (v as u16, rows[v].iter().filter(|s| *s.1 != 0.0).map(source).collect())
    };
    Ok((0..n).filter(|&v| n_sharp(v) > 1).map(row).collect())
}

/// Limits of the half's vertices as weights of control vertices of the whole mesh.
fn whole_rows(half: &HalfMesh, tags: &Tags, options: &PlanOptions) -> Result<Vec<BTreeMap<u32, f64>>, BakeError> {
    let mesh = half.mesh().map_err(ControlError::Mesh)?;
    let plan = DoublePlan::build_with(&mesh, tags, options)?;
    let mut tables = plan.tables.iter();
    let first = tables.next().cloned();
    let steps = first.map(|first| tables.fold(first, |coarser, table| table.compose(&coarser)));
    let limit = plan.limit.as_ref();
    let expand = |v: usize| {
        let mut out = BTreeMap::new();
        // The scheme has limits: a level without is one that nothing was asked of.
        for (&source, weights) in limit.map(|l| l.row(v)).into_iter().flat_map(|(s, w)| s.iter().zip(w)) {
            match &steps {
                Some(steps) => {
                    let (sources, inner) = steps.row(source as usize);
                    for (&s, &w) in sources.iter().zip(inner) {
                        *out.entry(s).or_insert(0.0) += weights[0] * w;
                    }
                }
                None => *out.entry(source).or_insert(0.0) += weights[0],
            }
        }
        out
    };
    Ok((0..half.n_half()).map(expand).collect())
}
