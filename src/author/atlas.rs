//! The layout of the skin's texture: charts from the patch file, laid flat for the mean of all breeds, packed.
//!
//! A chart is laid out for the mean of the squared lengths of its edges over all breeds, each in its own head units: no
//! one breed's shape decides, and none has to look like the mean.

use super::bake::BakeError;
use super::limits;
use super::packing::{self, Island};
use super::patch::{self, ChartPatch};
use super::unwrap::{self, Piece};
use crate::anatomy::{ParamTable, library};
use crate::rig::{Chart, Deformed, HalfMesh, HalfUv, Rig, deform};
use crate::subdiv::{Evaluator, Normals, Plan, PlanOptions, Positions, Scheme};
use std::collections::BTreeSet;

/// Coordinates are multiples of its inverse.
const GRID: f64 = (1u32 << 20) as f64;

/// Lays the charts of a half out in the unit square.
pub(super) fn lay_out(charts: &[ChartPatch], half: &HalfMesh, table: &ParamTable) -> Result<HalfUv, BakeError> {
    let sides = mean_sides(half, table)?;
    let of_face = charts_of_faces(charts, half)?;
    let mut islands = Vec::new();
    let mut out = Vec::new();
    for (k, chart) in charts.iter().enumerate() {
        let faces: Vec<u16> = (0..half.faces.len() as u16).filter(|&f| of_face[f as usize] == k).collect();
        let used: BTreeSet<u16> = faces.iter().flat_map(|&f| half.faces[f as usize]).collect();
        let vertices: Vec<u16> = used.into_iter().collect();
        let number = |v: u16| vertices.partition_point(|&w| w < v);
        let joined = patch::vertices(half, &chart.join)?;
        let piece = Piece {
            faces: faces.iter().map(|&f| half.faces[f as usize].map(number)).collect(),
            sides: faces.iter().map(|&f| sides[f as usize]).collect(),
            on_axis: vertices.iter().map(|v| joined.contains(v)).collect(),
            air: Vec::new(),
        };
        let mut at = unwrap::flatten(&piece);
        at.iter_mut().flatten().for_each(|x| *x *= chart.density);
        islands.push(Island { faces: piece.faces, at, is_joined: !joined.is_empty() });
        out.push(Chart { name: chart.name.clone(), faces, vertices, uvs: Vec::new() });
    }
    let placed = packing::pack(&islands).ok_or(BakeError::Packing)?;
    for (chart, places) in out.iter_mut().zip(placed) {
        let round = |x: f64| ((x * GRID).round() / GRID) as f32;
        chart.uvs = places.iter().map(|&[u, v]| [round(u), round(v)]).collect();
    }
    Ok(HalfUv { version: 1, charts: out })
}

/// For each face its chart: the last that has all its corners.
fn charts_of_faces(charts: &[ChartPatch], half: &HalfMesh) -> Result<Vec<usize>, BakeError> {
    let mut of_face = vec![0; half.faces.len()];
    for (k, chart) in charts.iter().enumerate().filter(|(_, chart)| !chart.vertices.is_empty()) {
        let own = patch::vertices(half, &chart.vertices)?;
        for (to, face) in of_face.iter_mut().zip(&half.faces) {
            if face.iter().all(|v| own.contains(v)) {
                *to = k;
            }
        }
    }
    Ok(of_face)
}

/// Squared lengths of the sides of each face of the half on the limit surface, the mean of all breeds in head units.
fn mean_sides(half: &HalfMesh, table: &ParamTable) -> Result<Vec<[f64; 3]>, BakeError> {
    let rig = Rig::new(half.clone(), table)?;
    let options =
        PlanOptions { positions: Positions::Limit, normals: Normals::None, ..PlanOptions::new(Scheme::Sqrt3, 0) };
    let plan = Plan::build_with(rig.mesh(), &limits::tags(half), &options)?;
    let mut evaluator = Evaluator::new(&plan);
    let mut deformed = Deformed::default();
    let mut sums = vec![[0.0; 3]; half.faces.len()];
    for id in library::ids() {
        let breed = library::breed(table, id)?;
        rig.deform(&breed.values, deform::ROUNDS, &mut deformed);
        let scale = f64::from(rig.proportions(&breed.values).scale);
        let surface = evaluator.evaluate(&plan, &deformed.control);
        for (sum, face) in sums.iter_mut().zip(&half.faces) {
            let corners = face.map(|v| surface.positions[v as usize].as_dvec3() / scale);
            for (k, sum) in sum.iter_mut().enumerate() {
                *sum += corners[k].distance_squared(corners[(k + 1) % 3]);
            }
        }
    }
    let n = library::BREEDS.len() as f64;
    sums.iter_mut().flatten().for_each(|sum| *sum /= n);
    Ok(sums)
}
