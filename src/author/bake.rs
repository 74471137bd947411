//! Baked assets: what is made of the patch file and the table, bit for bit the same each time.

use super::{atlas, base, bone, limits, patch};
use crate::anatomy::library::LibraryError;
use crate::anatomy::{Breed, LoadErrors, ParamTable};
use crate::rig::bone::{BoneHalf, BoneMesh};
use crate::rig::{ControlError, HalfMesh, HalfUv, Handles, Measures, Proportions, RigError, columns};
use crate::subdiv::PlanError;

/// The patch file that is part of the program.
pub const PATCH: &str = include_str!("../../assets/head.patch.ron");

/// One baked file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Baked {
    /// Path relative to the repository's root.
    pub path: &'static str,
    /// Its whole text.
    pub text: String,
}

/// Why nothing was baked.
#[derive(Debug, thiserror::Error)]
pub enum BakeError {
    /// The patch file is not RON of the right form.
    #[error("assets/head.patch.ron:{0}")]
    Syntax(#[from] ron::error::SpannedError),
    /// The patch file makes no mesh.
    #[error("assets/head.patch.ron: {0}")]
    Patch(#[from] patch::PatchError),
    /// The table does not load.
    #[error(transparent)]
    Table(#[from] LoadErrors),
    /// The mesh does not fit the shape.
    #[error(transparent)]
    Control(#[from] ControlError),
    /// The table lacks a measure.
    #[error(transparent)]
    Rig(#[from] RigError),
    /// A breed does not load.
    #[error(transparent)]
    Breed(#[from] LibraryError),
    /// The skin cannot be measured.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The charts find no place together.
    #[error("the charts of assets/head.patch.ron cannot be packed: lower the density of one")]
    Packing,
}

/// Makes `assets/head.ron` from a patch file and a table.
///
/// # Errors
/// [`BakeError`] says which of the two is wrong and where.
pub fn head(patch_text: &str, table: &ParamTable) -> Result<HalfMesh, BakeError> {
    let file: patch::PatchFile = ron::from_str(patch_text)?;
    let mut half = patch::build(&file)?;
    let handles = Handles::new(&half)?;
    let defaults = Breed::defaults(table);
    let measures = Measures::from_values(&defaults.values, &columns(table)?);
    half.limits = limits::rows(&half)?;
    half.base = base::fit(&half, &handles, &Proportions::new(&measures));
    Ok(half)
}

/// Makes `assets/head_uv.ron` from a patch file, its baked mesh and a table.
///
/// # Errors
/// [`BakeError`] says which of them is wrong and where.
pub fn uv(patch_text: &str, half: &HalfMesh, table: &ParamTable) -> Result<HalfUv, BakeError> {
    let file: patch::PatchFile = ron::from_str(patch_text)?;
    atlas::lay_out(&file.charts, half, table)
}

/// Makes every baked asset from what is part of the program.
///
/// # Errors
/// See [`head`].
pub fn all() -> Result<Vec<Baked>, BakeError> {
    let half = head(PATCH, &ParamTable::embedded()?)?;
    let uv = uv(PATCH, &half, &ParamTable::embedded()?)?;
    Ok(vec![
        Baked { path: "assets/head.ron", text: text(&half) },
        Baked { path: "assets/head_uv.ron", text: uv_text(&uv) },
        Baked { path: "assets/skull.ron", text: bone_text(&bone::half(BoneMesh::Skull)) },
        Baked { path: "assets/mandible.ron", text: bone_text(&bone::half(BoneMesh::Mandible)) },
    ])
}

/// Appends a named list, so many rows to a line.
fn list(out: &mut String, name: &str, rows: Vec<String>, per_line: usize) {
    use std::fmt::Write as _;
    let _ = writeln!(out, "    {name}: [");
    for line in rows.chunks(per_line) {
        let _ = writeln!(out, "        {},", line.join(", "));
    }
    let _ = writeln!(out, "    ],");
}

/// A bone as RON.
fn bone_text(half: &BoneHalf) -> String {
    let mut out = String::from(
        "// Baked by `londra bake` from src/rig/bone/field.rs. Edit that, not this.\n(\n    version: 1,\n",
    );
    let mut list = |name, rows, per_line| list(&mut out, name, rows, per_line);
    list("midline", half.midline.iter().map(bool::to_string).collect(), 20);
    list("faces", half.faces.iter().map(|[a, b, c]| format!("({a}, {b}, {c})")).collect(), 8);
    list("base", half.base.iter().map(|[x, y, z]| format!("({x:?}, {y:?}, {z:?})")).collect(), 6);
    list("landmarks", half.landmarks.iter().map(|(id, v)| format!("({id:?}, {v})")).collect(), 8);
    out.push_str(")\n");
    out
}

/// The charts as RON.
fn uv_text(uv: &HalfUv) -> String {
    use std::fmt::Write as _;
    let mut out = String::from(
        "// Baked by `londra bake` from assets/head.patch.ron, rigs/anatomy.ron and rigs/breeds. Edit those, not this.\n(\n    version: 1,\n    charts: [\n",
    );
    for chart in &uv.charts {
        let _ = writeln!(out, "    (\n    name: {:?},", chart.name);
        list(&mut out, "faces", chart.faces.iter().map(u16::to_string).collect(), 24);
        list(&mut out, "vertices", chart.vertices.iter().map(u16::to_string).collect(), 24);
        list(&mut out, "uvs", chart.uvs.iter().map(|[u, v]| format!("({u:?}, {v:?})")).collect(), 6);
        let _ = writeln!(out, "    ),");
    }
    out.push_str("    ],\n)\n");
    out
}

/// The half mesh as RON, a line for each vertex and triangle, so that a change reads well as a difference.
fn text(half: &HalfMesh) -> String {
    use std::fmt::Write as _;
    let mut out = String::from(
        "// Baked by `londra bake` from assets/head.patch.ron and rigs/anatomy.ron. Edit those, not this.\n(\n    version: 1,\n",
    );
    let mut list = |name, rows, per_line| list(&mut out, name, rows, per_line);
    let numbers = |v: &[u16]| v.iter().map(u16::to_string).collect::<Vec<_>>().join(", ");
    list("tags", half.tags.iter().map(|t| format!("{t:?}")).collect(), 12);
    list("midline", half.midline.iter().map(bool::to_string).collect(), 20);
    list("regions", half.regions.iter().map(|r| r.name().to_owned()).collect(), 10);
    list("faces", half.faces.iter().map(|f| format!("({})", numbers(f))).collect(), 8);
    list("base", half.base.iter().map(|[x, y, z]| format!("({x:?}, {y:?}, {z:?})")).collect(), 4);
    list("creases", half.creases.iter().map(|(a, b, s)| format!("({a}, {b}, {s:?})")).collect(), 8);
    let sources = |row: &[(u16, bool, f32)]| row.iter().map(|s| format!("{s:?}")).collect::<Vec<_>>().join(", ");
    list("limits", half.limits.iter().map(|(v, row)| format!("({v}, [{}])", sources(row))).collect(), 1);
    list("landmarks", half.landmarks.iter().map(|(id, name, v)| format!("({id:?}, {name:?}, {v})")).collect(), 1);
    let _ = writeln!(out, "    loops: {{");
    for (name, l) in &half.loops {
        let _ = writeln!(out, "        {name:?}: [{}],", numbers(l));
    }
    out.push_str("    },\n)\n");
    out
}
