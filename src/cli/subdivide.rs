//! `londra subdivide`.

use super::args::Subdivide;
use super::control::{self, Control, Faces};
use super::{Failure, mesh_picture, output};
use crate::io::{Format, Soup};
use crate::subdiv::{
    DualError, Evaluator, Normals, Plan, PlanError, PlanOptions, Positions, Scheme, ThreeConnected, creases_by_angle,
    flat_faces,
};
use glam::Vec3;
use serde_json::{Map, Value, json};
use std::collections::BTreeMap;
use std::path::Path;
use std::time::Instant;

/// Refines a mesh and writes it, or prints what it would be like.
pub(super) fn run(args: &Subdivide) -> Result<(), Failure> {
    let format = match &args.output {
        Some(target) => {
            output::check_target(target, args.json)?;
            Some(Written::by_name(target)?)
        }
        None => None,
    };
    check_words(args)?;
    let mut control = Control::open(&args.input, args.scheme)?;
    mark(args, &mut control);

    let start = Instant::now();
    let plan = build(args, &control).map_err(|error| control.failure(&args.input, error))?;
    let build_ns = nanoseconds(start);
    let mut evaluator = Evaluator::new(&plan);
    let start = Instant::now();
    let surface = evaluator.evaluate(&plan, &control.positions);
    let evaluate_ns = nanoseconds(start);

    let result = match args.dual {
        Some(rim) => {
            let dual = ThreeConnected::of(&plan, rim).map_err(|error| not_dual(&args.input, &error))?;
            Refined::of_dual(&dual, surface.positions, surface.normals)
        }
        None => Refined::of_plan(&plan, surface.positions, surface.normals),
    };
    let mut facts = facts(args, &plan, &result);
    facts.insert("build_ns".into(), json!(build_ns));
    facts.insert("evaluate_ns".into(), json!(evaluate_ns));
    match (&args.output, format) {
        (Some(target), Some(format)) => write(args, target, format, &result, facts),
        _ => output::json(&Value::Object(facts)),
    }
}

/// Words that make no sense together, whatever the mesh.
fn check_words(args: &Subdivide) -> Result<(), Failure> {
    let scheme = args.scheme;
    let wrong = |error: &dyn std::fmt::Display| Err(Failure::Use(error.to_string()));
    if args.freeze_flatter_than.is_some() && scheme != Scheme::Sqrt3 {
        return wrong(&PlanError::NoFrozenFaces { scheme });
    }
    if args.adaptive.is_some() && scheme != Scheme::Sqrt3 {
        return wrong(&PlanError::NotAdaptive { scheme });
    }
    if args.crease_angle.is_some() && !scheme.has_creases() {
        return wrong(&PlanError::NoCreases { scheme });
    }
    if args.limit && !scheme.has_limits() && !scheme.is_interpolating() {
        return wrong(&PlanError::NoLimits { scheme });
    }
    if args.dual.is_some() && !matches!(scheme, Scheme::Sqrt3 | Scheme::Sqrt3Interpolating) {
        return wrong(&DualError::Scheme { scheme });
    }
    if args.dual.is_some() && args.level == 0 {
        return wrong(&DualError::NoStep);
    }
    Ok(())
}

/// Tags that come from the shape: sharp edges and faces to leave alone.
fn mark(args: &Subdivide, control: &mut Control) {
    if let Some(bound) = args.crease_angle {
        let found = creases_by_angle(&control.polygons(), &control.positions, bound);
        control.tags.creases.extend(found);
    }
    if let (Some(bound), Faces::Triangles(mesh)) = (args.freeze_flatter_than, &control.faces) {
        control.tags.frozen = flat_faces(mesh, &control.positions, bound);
    }
}

fn build(args: &Subdivide, control: &Control) -> Result<Plan, PlanError> {
    let scheme = args.scheme;
    let normals = if !args.normals {
        Normals::None
    } else if args.limit && scheme.has_limits() && args.adaptive.is_none() {
        Normals::Limit
    } else {
        Normals::Faces
    };
    let options = PlanOptions {
        loop_weights: args.loop_weights,
        boundary: args.boundary,
        creasing: args.creasing,
        positions: if args.limit { Positions::Limit } else { Positions::Level },
        normals,
        ..PlanOptions::new(scheme, args.level)
    };
    match (&control.faces, args.adaptive) {
        (Faces::Triangles(mesh), Some(bound)) => {
            Plan::build_adaptive(mesh, &control.tags, &options, &control.positions, &|face| face.bend() > bound)
        }
        _ => control.plan(&options),
    }
}

fn not_dual(path: &Path, error: &DualError) -> Failure {
    Failure::work(format!("{}: {error}", control::name_of(path)))
}

/// How it is written.
#[derive(Clone, Copy)]
enum Written {
    Mesh(Format),
    Picture,
}

impl Written {
    /// What the name of a target asks for: OBJ on stdout.
    fn by_name(target: &Path) -> Result<Written, Failure> {
        if output::is_stdout(target) {
            return Ok(Written::Mesh(Format::Obj));
        }
        let extension = target.extension().and_then(|e| e.to_str()).unwrap_or_default();
        if extension.eq_ignore_ascii_case("png") {
            return Ok(Written::Picture);
        }
        let format = Format::from_extension(extension).filter(|format| format.is_written());
        format.map(Written::Mesh).ok_or_else(|| {
            let target = target.display();
            Failure::Use(format!("{target}: say by the name what to write: .obj, .ply, .glb, or .png for a picture"))
        })
    }
}

/// What is written: a level, or its dual.
pub(super) struct Refined {
    pub positions: Vec<Vec3>,
    /// As many, or none.
    pub normals: Vec<Vec3>,
    pub face_sizes: Vec<u32>,
    pub corners: Vec<u32>,
    /// Length of each boundary.
    boundaries: Vec<usize>,
    on_boundary: Vec<u32>,
}

impl Refined {
    fn of_plan(plan: &Plan, positions: &[Vec3], normals: &[Vec3]) -> Refined {
        let (face_sizes, corners) = plan.faces();
        Refined {
            positions: positions.to_vec(),
            normals: normals.to_vec(),
            face_sizes,
            corners: corners.to_vec(),
            boundaries: plan.boundary_loops().iter().map(Vec::len).collect(),
            on_boundary: plan.boundary_loops().concat(),
        }
    }

    fn of_dual(dual: &ThreeConnected, positions: &[Vec3], normals: &[Vec3]) -> Refined {
        let mesh = &dual.mesh;
        let loops = mesh.boundary_loops();
        let normals = if normals.is_empty() { Vec::new() } else { dual.values::<f32, Vec3>(normals) };
        Refined {
            positions: dual.values::<f32, Vec3>(positions),
            normals: normals.into_iter().map(|n| n.try_normalize().unwrap_or(Vec3::Y)).collect(),
            face_sizes: mesh.faces().map(|face| mesh.corners(face).len() as u32).collect(),
            corners: mesh.faces().flat_map(|face| mesh.corners(face)).copied().collect(),
            boundaries: loops.iter().map(Vec::len).collect(),
            on_boundary: loops.iter().flatten().map(|v| v.0).collect(),
        }
    }

    fn n_edges(&self) -> usize {
        (self.corners.len() + self.on_boundary.len()) / 2
    }

    fn euler_characteristic(&self) -> i64 {
        self.positions.len() as i64 - self.n_edges() as i64 + self.face_sizes.len() as i64
    }

    /// How many vertices have how many edges.
    fn valences(&self) -> BTreeMap<u32, usize> {
        let mut valence = vec![0_u32; self.positions.len()];
        self.corners.iter().chain(&self.on_boundary).for_each(|&v| valence[v as usize] += 1);
        let mut histogram = BTreeMap::new();
        valence.into_iter().for_each(|n| *histogram.entry(n).or_insert(0) += 1);
        histogram
    }

    /// The corners of each face.
    pub fn faces(&self) -> impl Iterator<Item = &[u32]> {
        let mut rest = &self.corners[..];
        self.face_sizes.iter().map(move |&size| {
            let (face, after) = rest.split_at(size as usize);
            rest = after;
            face
        })
    }

    fn soup(&self) -> Soup {
        Soup {
            positions: doubles(&self.positions),
            face_sizes: self.face_sizes.clone(),
            corners: self.corners.clone(),
            ..Soup::default()
        }
    }
}

fn doubles(values: &[Vec3]) -> Vec<[f64; 3]> {
    values.iter().map(|v| v.to_array().map(f64::from)).collect()
}

fn facts(args: &Subdivide, plan: &Plan, result: &Refined) -> Map<String, Value> {
    // Between the levels of an adaptive plan stand no meshes.
    let levels = if args.adaptive.is_some() { vec![0] } else { (0..plan.levels()).collect() };
    let level = |level: u32, n_vertices, n_faces| json!({ "level": level, "vertices": n_vertices, "faces": n_faces });
    let mut levels: Vec<Value> =
        levels.into_iter().map(|l| level(l, plan.n_vertices_at(l), plan.n_faces_at(l))).collect();
    levels.push(level(plan.levels(), plan.n_vertices(), plan.n_faces()));
    let normals = match plan.options().normals {
        Normals::None => "none",
        Normals::Faces => "faces",
        Normals::Limit => "limit",
    };
    let is_limit = args.limit || args.adaptive.is_some();
    let valences: Map<String, Value> =
        result.valences().into_iter().map(|(n, count)| (n.to_string(), json!(count))).collect();
    let facts = json!({
        "input": args.input.display().to_string(), "scheme": args.scheme.name(), "level": args.level,
        "positions": if is_limit { "limit" } else { "level" }, "normals": normals, "dual": args.dual.is_some(),
        "levels": levels, "vertices": result.positions.len(), "edges": result.n_edges(),
        "faces": result.face_sizes.len(), "boundary_loops": result.boundaries.len(),
        "boundary_lengths": result.boundaries, "euler_characteristic": result.euler_characteristic(),
        "valence_histogram": valences, "frozen_faces": plan.n_frozen_faces(), "plan_bytes": plan.n_table_bytes(),
        "index_bytes": plan.n_index_bytes(), "ring_bytes": plan.n_ring_bytes(),
    });
    match facts {
        Value::Object(facts) => facts,
        _ => Map::new(),
    }
}

fn write(
    args: &Subdivide,
    target: &Path,
    format: Written,
    result: &Refined,
    mut facts: Map<String, Value>,
) -> Result<(), Failure> {
    let normals = (!result.normals.is_empty()).then(|| doubles(&result.normals));
    let bytes = match format {
        Written::Mesh(format) => crate::io::write(&result.soup(), normals.as_deref(), format).map_err(Failure::work)?,
        Written::Picture => mesh_picture::draw(result)?.to_png().map_err(Failure::work)?,
    };
    facts.insert("output".into(), json!(target.display().to_string()));
    facts.insert("bytes".into(), json!(bytes.len()));
    output::file(target, &bytes, args.json, Value::Object(facts))
}

fn nanoseconds(start: Instant) -> u64 {
    u64::try_from(start.elapsed().as_nanos()).unwrap_or(u64::MAX)
}
