//! `londra similarity`.

use super::args::Similarity;
use super::control::{self, Control, Faces};
use super::{Failure, output};
use crate::mesh::{DedgeMesh, shapes};
use crate::subdiv::Scheme;
use crate::subdiv::similarity::SimilarityError;
use crate::subdiv::similarity::classes::Criteria;
use crate::subdiv::similarity::report::{Report, ReportOptions, ReportRow, report};
use glam::Vec3;
use serde_json::{Value, json};
use std::path::Path;
use std::time::Instant;

/// Prints what similarity of triangles is worth on a mesh.
pub(super) fn run(args: &Similarity) -> Result<(), Failure> {
    let (mesh, positions, usual) = mesh(&args.mesh)?;
    let levels = args.level.unwrap_or(usual);
    let criteria =
        Criteria { epsilon: args.epsilon, folds: args.folds, mirrored: !args.no_mirrored, ..Criteria::default() };
    let options = ReportOptions { scheme: args.scheme, levels, criteria, ..ReportOptions::default() };
    let start = Instant::now();
    let clock = || start.elapsed().as_secs_f64();
    let found = report(&mesh, &positions, &options, &clock).map_err(|error| failure(&args.mesh, &error))?;
    let name = control::name_of(&args.mesh);
    if args.json {
        return output::json(&as_json(&name, args, levels, &found));
    }
    output::result(&table(&name, args.scheme, levels, &found))
}

/// The mesh that is asked for, and to which level the thesis goes with it: a name, or else a file.
fn mesh(word: &Path) -> Result<(DedgeMesh, Vec<Vec3>, u32), Failure> {
    let named = match word.to_str() {
        Some("icosahedron") => Some((shapes::icosahedron(), 5)),
        Some("torus") => Some((shapes::torus(16, 8), 2)),
        _ => None,
    };
    if let Some((shape, levels)) = named {
        let mesh = shape.mesh().map_err(Failure::work)?;
        return Ok((mesh, shape.positions, levels));
    }
    let Control { faces, positions, .. } = Control::open(word, Scheme::Loop)?;
    match faces {
        Faces::Triangles(mesh) => Ok((mesh, positions, 2)),
        Faces::Polygons(_) => Err(Failure::work(format!("{}: has no triangles", control::name_of(word)))),
    }
}

fn failure(mesh: &Path, error: &SimilarityError) -> Failure {
    match error {
        SimilarityError::Scheme { .. } => Failure::Use(error.to_string()),
        _ => Failure::work(format!("{}: {error}", control::name_of(mesh))),
    }
}

fn as_json(name: &str, args: &Similarity, levels: u32, found: &Report) -> Value {
    let rows = |rows: &[ReportRow]| rows.iter().map(row).collect::<Vec<_>>();
    let shared = &found.shared;
    json!({
        "mesh": name, "scheme": args.scheme.name(), "level": levels, "epsilon": args.epsilon, "folds": args.folds,
        "mirrored": !args.no_mirrored, "steps": rows(&found.steps), "whole": rows(&found.whole),
        "shared_rows": {
            "triangles": shared.n_triangles, "classes": shared.n_classes, "surroundings": shared.n_surroundings,
            "vertices": shared.n_vertices, "class_rows": shared.n_class_rows, "plan_bytes": shared.plan_bytes,
            "composed_bytes": shared.composed_bytes, "shared_bytes": shared.shared_bytes,
            "target_bytes": shared.target_bytes,
        },
    })
}

fn row(row: &ReportRow) -> Value {
    json!({
        "from": row.from, "to": row.to, "triangles": row.n_triangles, "vertices": row.n_vertices,
        "classes": row.n_classes, "patch_classes": row.n_patch_classes, "patches": row.n_patches,
        "largest_patch": row.largest_patch, "points": row.n_points, "largest_error": row.largest_error,
        "prepare_ns": (row.preparing_secs * 1e9).round(), "similar_ns": (row.similar_secs * 1e9).round(),
        "classical_ns": (row.classical_secs * 1e9).round(), "plan_ns": (row.plan_secs * 1e9).round(),
    })
}

fn table(name: &str, scheme: Scheme, levels: u32, found: &Report) -> String {
    let mut lines = vec![
        format!("{name}, {} to level {levels}; times in microseconds", scheme.name()),
        format!(
            "{:<10}{:>10}{:>9}{:>9}{:>9}{:>9}{:>11}{:>11}{:>11}{:>11}{:>10}",
            "levels",
            "triangles",
            "classes",
            "patches",
            "largest",
            "points",
            "preparing",
            "similar",
            "classical",
            "plan",
            "error"
        ),
    ];
    for row in found.steps.iter().chain(&found.whole) {
        let micros = |seconds: f64| format!("{:.1}", seconds * 1e6);
        lines.push(format!(
            "{:<10}{:>10}{:>9}{:>9}{:>9}{:>9}{:>11}{:>11}{:>11}{:>11}{:>10.1e}",
            format!("{} to {}", row.from, row.to),
            row.n_triangles,
            row.n_classes,
            row.n_patch_classes,
            row.largest_patch,
            row.n_points,
            micros(row.preparing_secs),
            micros(row.similar_secs),
            micros(row.classical_secs),
            micros(row.plan_secs),
            row.largest_error
        ));
    }
    let shared = &found.shared;
    lines.push(format!(
        "rows shared by topology: {} classes among {} triangles; {} bytes of tables by step, {} composed, {} composed and shared",
        shared.n_classes, shared.n_triangles, shared.plan_bytes, shared.composed_bytes, shared.shared_bytes
    ));
    lines.join("\n")
}
