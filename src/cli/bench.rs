//! `londra bench`.

use super::args::Bench;
use super::control::{self, Control};
use super::rigs::Rigs;
use super::{Failure, output};
use crate::anatomy::Breed;
use crate::math::rng::Rng;
use crate::rig::{Deformed, Rig, deform};
use crate::subdiv::{Evaluator, Normals, Plan, PlanOptions, Positions};
use glam::Vec3;
use serde_json::json;
use std::hint::black_box;
use std::path::Path;
use std::time::{Duration, Instant};

/// Control arrays that take turns, so that no frame finds its own input again.
const N_POSES: usize = 8;
/// How far a control vertex moves from pose to pose, in parts of the size.
const MOVE: f32 = 0.01;
/// Time to spend on a median, and the fewest samples it is taken from.
const SPEND: Duration = Duration::from_millis(600);
const FEWEST: usize = 11;
/// What is shorter is timed several times in a row.
const LEAST: Duration = Duration::from_micros(20);

/// Times frames of a plan with changing control positions, and a plain copy of what they deliver.
pub(super) fn run(args: &Bench) -> Result<(), Failure> {
    let built_in = Path::new("the head's control mesh");
    let (name, control) = match &args.mesh {
        Some(path) => (path.as_path(), Control::open(path, args.scheme)?),
        None => (built_in, head(args)?),
    };
    let options = PlanOptions {
        positions: if args.limit { Positions::Limit } else { Positions::Level },
        normals: match (args.limit, args.normals) {
            (true, _) => Normals::Limit,
            (false, true) => Normals::Faces,
            (false, false) => Normals::None,
        },
        ..PlanOptions::new(args.scheme, args.level)
    };
    let (plan, plan_build_ns) = build(&control, &options).map_err(|error| control.failure(name, error))?;

    let poses = poses(&control.positions);
    let mut evaluator = Evaluator::new(&plan);
    evaluator.set_threads(args.threads as usize);
    let mut positions = vec![Vec3::ZERO; plan.n_vertices()];
    let mut normals = vec![Vec3::ZERO; if options.normals == Normals::None { 0 } else { plan.n_vertices() }];
    let mut turn = (0..poses.len()).cycle();
    let median_ns = median_ns(|| {
        let pose = &poses[turn.next().unwrap_or(0)];
        evaluator.evaluate_into(&plan, pose, &mut positions, &mut normals);
        black_box((&mut positions, &mut normals));
    });
    let (mut to_positions, mut to_normals) = (positions.clone(), normals.clone());
    let copy_ns = self::median_ns(|| {
        to_positions.copy_from_slice(black_box(&positions));
        to_normals.copy_from_slice(black_box(&normals));
        black_box((&mut to_positions, &mut to_normals));
    });

    let n_vertices = plan.n_vertices();
    let ns_per_vertex = median_ns / n_vertices.max(1) as f64;
    let x_copy = median_ns / copy_ns.max(f64::MIN_POSITIVE);
    if args.json {
        return output::json(&json!({
            "mesh": control::name_of(name), "scheme": args.scheme.name(), "level": args.level,
            "threads": evaluator.threads(), "limit": args.limit, "normals": args.limit || args.normals,
            "control_vertices": plan.n_control(), "out_vertices": n_vertices, "out_faces": plan.n_faces(),
            "median_ns": median_ns, "ns_per_vertex": ns_per_vertex, "copy_ns": copy_ns, "x_copy": x_copy,
            "plan_build_ns": plan_build_ns, "plan_bytes": plan.n_table_bytes(), "index_bytes": plan.n_index_bytes(),
            "ring_bytes": plan.n_ring_bytes(), "patch_bytes": plan.n_patch_bytes(),
        }));
    }
    let delivered = match (args.limit, args.normals) {
        (true, _) => "limit positions and limit normals",
        (false, true) => "positions and normals from faces",
        (false, false) => "positions",
    };
    let rows = [
        ("mesh", control::name_of(name)),
        ("plan", format!("{} level {}, {delivered}", args.scheme.name(), args.level)),
        ("threads", evaluator.threads().to_string()),
        ("vertices", format!("{} from {}", n_vertices, plan.n_control())),
        ("frame", format!("{:.1} us median, {ns_per_vertex:.2} ns a vertex", median_ns / 1e3)),
        ("copy", format!("{:.1} us; a frame is {x_copy:.2} copies", copy_ns / 1e3)),
        ("build", format!("{:.2} ms", plan_build_ns / 1e6)),
        (
            "bytes",
            format!(
                "{} tables, {} rows by patch, {} indices, {} rings",
                plan.n_table_bytes(),
                plan.n_patch_bytes(),
                plan.n_index_bytes(),
                plan.n_ring_bytes()
            ),
        ),
    ];
    output::result(&rows.map(|(name, value)| format!("{name:<9} {value}")).join("\n"))
}

/// The default head's control mesh.
fn head(args: &Bench) -> Result<Control, Failure> {
    let rigs = Rigs::open()?;
    let rig = Rig::embedded(&rigs.table).map_err(Failure::work)?;
    let mut deformed = Deformed::default();
    rig.deform(&Breed::defaults(&rigs.table).values, deform::ROUNDS, &mut deformed);
    Ok(Control::of_triangles(rig.mesh(), deformed.control, args.scheme))
}

/// A plan, and the median time of building it.
fn build(control: &Control, options: &PlanOptions) -> Result<(Plan, f64), crate::subdiv::PlanError> {
    let plan = control.plan(options)?;
    let mut times = Vec::new();
    let start = Instant::now();
    while times.len() < 5 && (times.is_empty() || start.elapsed() < SPEND) {
        let begin = Instant::now();
        black_box(control.plan(options)?);
        times.push(begin.elapsed().as_nanos() as f64);
    }
    Ok((plan, median(&mut times)))
}

/// Control positions that differ from each other everywhere.
fn poses(rest: &[Vec3]) -> Vec<Vec<Vec3>> {
    let (low, high) = rest.iter().fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(lo, hi), &p| (lo.min(p), hi.max(p)));
    let reach = (high - low).length() * MOVE;
    let reach = if reach.is_finite() { reach } else { 0.0 };
    let mut rng = Rng::new(1);
    let mut near = |p: &Vec3| *p + Vec3::from_array([(); 3].map(|()| rng.between(-reach, reach)));
    (0..N_POSES).map(|_| rest.iter().map(&mut near).collect()).collect()
}

/// The median time of some work, nanoseconds.
fn median_ns(mut work: impl FnMut()) -> f64 {
    // The first calls find cold caches and pages that nobody has touched.
    work();
    work();
    let begin = Instant::now();
    work();
    let once = begin.elapsed().max(Duration::from_nanos(20));
    let in_a_row = LEAST.as_nanos().div_ceil(once.as_nanos()).max(1) as u32;
    let mut times = Vec::new();
    let start = Instant::now();
    while times.len() < FEWEST || start.elapsed() < SPEND {
        let begin = Instant::now();
        (0..in_a_row).for_each(|_| work());
        times.push(begin.elapsed().as_nanos() as f64 / f64::from(in_a_row));
    }
    median(&mut times)
}

fn median(times: &mut [f64]) -> f64 {
    times.sort_by(f64::total_cmp);
    times.get(times.len() / 2).copied().unwrap_or(0.0)
}
