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
    contest([&mut frame])[0]
}

/// Seconds of a frame of each: the median over [turns](turns).
fn contest<const N: usize>(frames: [&mut dyn FnMut(usize); N]) -> [f64; N] {
    let turns = turns(frames);
    std::array::from_fn(|k| median_of(turns.iter().map(|turn| turn[k])))
}

fn median_of(values: impl Iterator<Item = f64>) -> f64 {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}

/// Seconds of a frame of each, turn by turn, so that a machine that has other things to do slows all of them alike: of each
/// turn the median frame.
fn turns<const N: usize>(mut frames: [&mut dyn FnMut(usize); N]) -> Vec<[f64; N]> {
    const FRAMES: usize = 7;
    let (start, mut turns) = (Instant::now(), Vec::new());
    while turns.len() < 7 || start.elapsed() < Duration::from_millis(500) * N as u32 {
        let mut turn = [0.0; N];
        for (frame, median) in frames.iter_mut().zip(&mut turn) {
            // The caches of the one before are not those of this one.
            frame(0);
            let mut times = [0.0; FRAMES];
            for (i, time) in times.iter_mut().enumerate() {
                let begin = Instant::now();
                frame(i + 1);
                *time = begin.elapsed().as_secs_f64();
            }
            times.sort_by(f64::total_cmp);
            *median = times[FRAMES / 2];
        }
        turns.push(turn);
    }
    turns
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

/// Work that needs no memory, for some tenths of a millisecond.
fn compute() -> f64 {
    let mut x = black_box([1.0_f64, 1.1, 1.2, 1.3, 1.4, 1.5, 1.6, 1.7]);
    for _ in 0..black_box(200_000) {
        x.iter_mut().for_each(|x| *x = *x * 0.999_999 + 1e-6);
    }
    x.iter().sum()
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
    let lists = || (vec![Vec3::ZERO; n], vec![Vec3::ZERO; n_normals]);
    let [mut one, mut two] = [1, 2].map(|threads| {
        let mut evaluator = Evaluator::new(&plan);
        evaluator.set_threads(threads);
        (evaluator, lists())
    });
    let frame = |(evaluator, (positions, normals)): &mut (Evaluator, (Vec<Vec3>, Vec<Vec3>)), i: usize| {
        evaluator.evaluate_into(&plan, &poses[i % 4], black_box(positions), black_box(normals));
    };
    let mut plain = Plain::new(&plan);
    let (from, mut to) = (lists(), lists());
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    let turns = turns([
        &mut |i| frame(&mut one, i),
        &mut |i| frame(&mut two, i),
        // What two threads are worth at this moment: twice the work, by both.
        &mut |_| {
            black_box(compute());
        },
        &mut |_| {
            pool.in_place_scope(|scope| {
                scope.spawn(|_| {
                    black_box(compute());
                });
                black_box(compute());
            });
        },
        &mut |i| {
            plain.frame(&poses[i % 4]);
            black_box(&mut plain);
        },
        &mut |_| {
            to.0.copy_from_slice(black_box(&from.0));
            to.1.copy_from_slice(black_box(&from.1));
            black_box(&mut to);
        },
    ]);
    let [ours, plain, copy] = [0, 4, 5].map(|k| median_of(turns.iter().map(|turn| turn[k])));
    // Of turns only in which the machine had two cores to give.
    let gains = turns.iter().map(|turn| (turn[0] / turn[1], 2.0 * turn[2] / turn[3])).filter(|(_, best)| *best > 1.8);
    let gains: Vec<(f64, f64)> = gains.collect();
    let [by_two, best] = [gains.iter().map(|g| g.0).collect(), gains.iter().map(|g| g.1).collect()]
        .map(|gains: Vec<f64>| median_of(gains.into_iter()));
    let share = format!("{}/{}", gains.len(), turns.len());
    let mut batch = String::from("|");
    if n < 500_000 {
        let many: Vec<Vec3> = (0..HEADS).flat_map(|head| poses[head % 4].clone()).collect();
        let big = || (vec![Vec3::ZERO; HEADS * n], vec![Vec3::ZERO; HEADS * n_normals]);
        let ((mut all, mut all_normals), (mut each, mut each_normals)) = (big(), big());
        let (mut first, mut second) = (Evaluator::new(&plan), Evaluator::new(&plan));
        let [together, one_by_one] =
            contest([&mut |_| first.evaluate_batch(&plan, &many, &mut all, &mut all_normals), &mut |_| {
                for head in 0..HEADS {
                    let normals = &mut each_normals[head * n_normals..(head + 1) * n_normals];
                    second.evaluate_into(&plan, &poses[head % 4], &mut each[head * n..(head + 1) * n], normals);
                }
            }]);
        batch = format!("{:.2} | {:.2}", plain * HEADS as f64 / together, one_by_one / together);
    }
    let saved = plan.to_bytes();
    // The same lists, in memory that is as fresh.
    let [load, copy_of_plan] = contest([
        &mut |_| {
            black_box(Plan::from_bytes(black_box(&saved), None).expect("as saved"));
        },
        &mut |_| {
            black_box(black_box(&plan).clone());
        },
    ]);
    // Tables or rows by patch are read, positions and normals written.
    let tables =
        if plan.n_patch_bytes() > 0 { plan.n_patch_bytes() } else { plan.n_table_bytes() + plan.n_ring_bytes() };
    println!(
        "| {name} | {n} | {:.1} | {:.2} | {:.2} | {:.1} | {:.2} | {:.2} | {share} | {batch} | {:.1} | {:.1} | {} | {} |",
        ours * 1e6,
        ours * 1e9 / n as f64,
        plain / ours,
        ours / copy,
        by_two,
        best,
        build * 1e3,
        load / copy_of_plan,
        tables / 1000,
        12 * (n + n_normals) / 1000,
    );
}

fn main() {
    let args: Vec<String> = std::env::args().skip(1).filter(|arg| !arg.starts_with("--")).collect();
    let (mesh, control) = args.iter().find(|arg| *arg != "grow").map_or_else(ball, |path| read(path));
    println!("{} control vertices, {} triangles", mesh.n_vertices(), mesh.n_faces());
    println!(
        "| plan | vertices | us | ns a vertex | plain / ours | ours / copy | two threads | at best | in turns | plain / batch | one by one / batch \
         | build ms | load / clone | kB read | kB written |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
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
