//! The engine beside what else one could do, in one run: a plain loop over the same rows, level by level, and a copy of what
//! is delivered. What counts are the ratios; milliseconds belong to one machine and day.
//!
//! `cargo bench --no-default-features --bench subdivide -- [MESH.obj] [grow]`. The mesh is a ball of 812 vertices unless one
//! is named; `grow` adds ever larger outputs.

use std::hint::black_box;
use std::time::{Duration, Instant};

use glam::Vec3;
use londra::mesh::DedgeMesh;
use londra::mesh::shapes::icosahedron;
use londra::subdiv::{Evaluator, Normals, Plan, PlanOptions, Positions, Scheme, StencilTable, Tags, evaluate_once};

/// Heads of a batch.
const HEADS: usize = 16;

/// A ball of √3 triangles, a little uneven.
fn ball() -> (DedgeMesh, Vec<Vec3>) {
    let shape = icosahedron();
    let coarse = shape.mesh().expect("an icosahedron is a manifold");
    let plan = Plan::build(&coarse, Scheme::Sqrt3, 4).expect("small");
    let (positions, _) = evaluate_once(&plan, &shape.positions);
    let positions: Vec<_> = positions.iter().map(|p| *p * (1.0 + 0.1 * p.x * p.y)).collect();
    let triangles = plan.indices().as_chunks::<3>().0;
    (DedgeMesh::from_triangles(positions.len(), triangles).expect("refined from a manifold"), positions)
}

fn read(path: &str) -> (DedgeMesh, Vec<Vec3>) {
    let bytes = std::fs::read(path).unwrap_or_else(|error| panic!("{path}: {error}"));
    let soup = londra::io::obj::read(&bytes).unwrap_or_else(|error| panic!("{path}: {error}"));
    let positions = soup.positions.iter().map(|p| Vec3::new(p[0] as f32, p[1] as f32, p[2] as f32)).collect();
    let mesh = DedgeMesh::from_triangles(soup.positions.len(), &soup.triangles());
    (mesh.unwrap_or_else(|error| panic!("{path}: {error}")), positions)
}

/// Median seconds of a frame, over half a second of them.
fn median(mut frame: impl FnMut(usize)) -> f64 {
    (0..3).for_each(&mut frame);
    let (start, mut times) = (Instant::now(), Vec::new());
    while times.len() < 11 || start.elapsed() < Duration::from_millis(500) {
        let begin = Instant::now();
        frame(times.len());
        times.push(begin.elapsed().as_secs_f64());
    }
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

/// The rows of a table, each with its own weights, as one would write them down first.
struct Rows {
    starts: Vec<u32>,
    sources: Vec<u32>,
    weights: Vec<f32>,
}

impl Rows {
    fn of(table: &StencilTable) -> Rows {
        let mut rows = Rows { starts: vec![0], sources: Vec::new(), weights: Vec::new() };
        for row in 0..table.n_rows() {
            let (sources, weights) = table.row(row);
            rows.sources.extend(sources);
            rows.weights.extend(weights);
            rows.starts.push(rows.sources.len() as u32);
        }
        rows
    }

    fn apply(&self, from: &[[f32; 4]], to: &mut [[f32; 4]]) {
        for (out, ends) in to.iter_mut().zip(self.starts.windows(2)) {
            let row = ends[0] as usize..ends[1] as usize;
            let mut sum = [0.0_f32; 4];
            for (&source, &weight) in self.sources[row.clone()].iter().zip(&self.weights[row]) {
                let value = from[source as usize];
                (0..4).for_each(|k| sum[k] += value[k] * weight);
            }
            *out = sum;
        }
    }
}

/// The plain way: one sparse pass for each level, then the normals of faces added up at their corners.
struct Plain {
    rows: Vec<Rows>,
    levels: Vec<Vec<[f32; 4]>>,
    triangles: Vec<[u32; 3]>,
    normals: Vec<[f32; 4]>,
}

impl Plain {
    fn new(plan: &Plan) -> Plain {
        let n_sources = plan.tables().iter().map(StencilTable::n_sources);
        let level = |n: usize| vec![[0.0; 4]; n];
        Plain {
            rows: plan.tables().iter().map(Rows::of).collect(),
            levels: n_sources.chain([plan.n_vertices()]).map(level).collect(),
            triangles: plan.indices().as_chunks::<3>().0.to_vec(),
            normals: level(if plan.options().normals == Normals::None { 0 } else { plan.n_vertices() }),
        }
    }

    fn frame(&mut self, control: &[Vec3]) {
        for (to, from) in self.levels[0].iter_mut().zip(control) {
            *to = [from.x, from.y, from.z, 0.0];
        }
        for (i, rows) in self.rows.iter().enumerate() {
            let (before, after) = self.levels.split_at_mut(i + 1);
            rows.apply(&before[i], &mut after[0]);
        }
        if self.normals.is_empty() {
            return;
        }
        let positions = &self.levels[self.rows.len()];
        let place = |v: u32| Vec3::from_slice(&positions[v as usize]);
        self.normals.fill([0.0; 4]);
        for triangle in &self.triangles {
            let [a, b, c] = triangle.map(place);
            let normal = (b - a).cross(c - a);
            for &v in triangle {
                let sum = &mut self.normals[v as usize];
                (sum[0], sum[1], sum[2]) = (sum[0] + normal.x, sum[1] + normal.y, sum[2] + normal.z);
            }
        }
        for sum in &mut self.normals {
            let unit = Vec3::from_slice(sum).normalize_or_zero();
            *sum = [unit.x, unit.y, unit.z, 0.0];
        }
    }
}

/// How much faster two threads do what needs no memory.
fn two_threads_at_best() -> f64 {
    fn work() -> f64 {
        let mut x = black_box([1.0_f64, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7]);
        for _ in 0..black_box(1_000_000) {
            x.iter_mut().for_each(|x| *x = *x * 0.999_999 + 1e-6);
        }
        x.iter().sum()
    }
    let alone = median(|_| {
        black_box(work());
    });
    let both = median(|_| {
        std::thread::scope(|scope| {
            let other = scope.spawn(|| black_box(work()));
            black_box(work());
            black_box(other.join().expect("it only adds"));
        })
    });
    2.0 * alone / both
}

fn case(name: &str, mesh: &DedgeMesh, control: &[Vec3], options: &PlanOptions) {
    let build = median(|_| {
        black_box(Plan::build_with(mesh, &Tags::default(), options).expect("within bounds"));
    });
    let plan = Plan::build_with(mesh, &Tags::default(), options).expect("within bounds");
    let poses: Vec<Vec<Vec3>> =
        (0..4).map(|k| control.iter().map(|&p| p * (1.0 + 0.01 * k as f32)).collect()).collect();
    let n = plan.n_vertices();
    let n_normals = if options.normals == Normals::None { 0 } else { n };
    let (mut positions, mut normals) = (vec![Vec3::ZERO; n], vec![Vec3::ZERO; n_normals]);
    let mut evaluator = Evaluator::new(&plan);
    let mut times = [1, 2].map(|threads| {
        evaluator.set_threads(threads);
        median(|i| evaluator.evaluate_into(&plan, &poses[i % 4], black_box(&mut positions), black_box(&mut normals)))
    });
    let mut plain = Plain::new(&plan);
    let plain_time = median(|i| {
        plain.frame(&poses[i % 4]);
        black_box(&mut plain);
    });
    let (mut to_positions, mut to_normals) = (positions.clone(), normals.clone());
    let copy = median(|_| {
        to_positions.copy_from_slice(black_box(&positions));
        to_normals.copy_from_slice(black_box(&normals));
        black_box((&mut to_positions, &mut to_normals));
    });
    times[0] = times[0].max(f64::MIN_POSITIVE);
    let mut batch = String::from("|");
    if n < 500_000 {
        evaluator.set_threads(1);
        let many: Vec<Vec3> = (0..HEADS).flat_map(|head| poses[head % 4].clone()).collect();
        let (mut positions, mut normals) = (vec![Vec3::ZERO; HEADS * n], vec![Vec3::ZERO; HEADS * n_normals]);
        let together = median(|_| evaluator.evaluate_batch(&plan, &many, &mut positions, &mut normals)) / HEADS as f64;
        let one_by_one = median(|_| {
            for head in 0..HEADS {
                let normals = &mut normals[head * n_normals..(head + 1) * n_normals];
                evaluator.evaluate_into(&plan, &poses[head % 4], &mut positions[head * n..(head + 1) * n], normals);
            }
        }) / HEADS as f64;
        batch = format!("{:.2} | {:.2}", plain_time / together, one_by_one / together);
    }
    // Tables and rows by patch are read, positions and normals written.
    let tables =
        if plan.n_patch_bytes() > 0 { plan.n_patch_bytes() } else { plan.n_table_bytes() + plan.n_ring_bytes() };
    println!(
        "| {name} | {n} | {:.1} | {:.2} | {:.2} | {:.1} | {:.2} | {batch} | {:.1} | {} | {} |",
        times[0] * 1e6,
        times[0] * 1e9 / n as f64,
        plain_time / times[0],
        times[0] / copy,
        times[0] / times[1],
        build * 1e3,
        tables / 1000,
        12 * (n + n_normals) / 1000,
    );
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with("--")).collect();
    let (mesh, control) = args.iter().find(|arg| *arg != "grow").map_or_else(ball, |path| read(path));
    println!("{} control vertices, {} triangles", mesh.n_vertices(), mesh.n_faces());
    println!("two threads at best: {:.2}", two_threads_at_best());
    println!(
        "| plan | vertices | us | ns a vertex | plain / ours | ours / copy | two threads | plain / batch | one by one / batch \
         | build ms | kB read | kB written |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|");
    let with =
        |scheme, levels, positions, normals| PlanOptions { positions, normals, ..PlanOptions::new(scheme, levels) };
    use {Normals as N, Positions as P};
    for (name, options) in [
        ("Loop 2, positions", with(Scheme::Loop, 2, P::Level, N::None)),
        ("Loop 3, positions", with(Scheme::Loop, 3, P::Level, N::None)),
        ("Loop 3, limit positions and normals", with(Scheme::Loop, 3, P::Limit, N::Limit)),
        ("Loop 3, positions and normals of faces", with(Scheme::Loop, 3, P::Level, N::Faces)),
        ("Loop 4, positions", with(Scheme::Loop, 4, P::Level, N::None)),
        ("Loop 4, limit positions and normals", with(Scheme::Loop, 4, P::Limit, N::Limit)),
        ("√3 4, positions", with(Scheme::Sqrt3, 4, P::Level, N::None)),
        ("√3 4, positions and normals of faces", with(Scheme::Sqrt3, 4, P::Level, N::Faces)),
        ("√3 4, positions and limit normals", with(Scheme::Sqrt3, 4, P::Level, N::Limit)),
    ] {
        case(name, &mesh, &control, &options);
    }
    if args.iter().any(|arg| arg == "grow") {
        for (scheme, levels) in [(Scheme::Loop, 2..=6_u32), (Scheme::Sqrt3, 2..=8)] {
            for level in levels {
                case(
                    &format!("{} {level}, positions", scheme.name()),
                    &mesh,
                    &control,
                    &with(scheme, level, P::Level, N::None),
                );
            }
        }
    }
}
