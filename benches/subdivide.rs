//! Building and evaluating a √3 plan, beside a plain copy of the same output.
//!
//! What counts is the ratio `evaluate / copy` within one run; milliseconds belong to one machine and day.
//! The mesh is closed, with 812 control vertices and 1620 control faces: a level 4 of 65,612 vertices and 131,220
//! faces, about that of a head.

use std::hint::black_box;

use criterion::{Criterion, criterion_group, criterion_main};
use glam::Vec3;
use londra::mesh::DedgeMesh;
use londra::mesh::shapes::icosahedron;
use londra::subdiv::{Evaluator, Plan, Scheme, evaluate_once};

const LEVELS: u32 = 4;

/// A ball of √3 triangles, a little uneven.
fn control() -> (DedgeMesh, Vec<Vec3>) {
    let shape = icosahedron();
    let coarse = shape.mesh().expect("an icosahedron is a manifold");
    let plan = Plan::build(&coarse, Scheme::Sqrt3, 4).expect("small");
    let (positions, _) = evaluate_once(&plan, &shape.positions);
    let positions: Vec<_> = positions.iter().map(|p| *p * (1.0 + 0.1 * p.x * p.y)).collect();
    let triangles = plan.indices().as_chunks::<3>().0;
    (DedgeMesh::from_triangles(positions.len(), triangles).expect("refined from a manifold"), positions)
}

fn benches(c: &mut Criterion) {
    let (mesh, control) = control();
    let triangles: Vec<[u32; 3]> = mesh.indices().as_chunks::<3>().0.to_vec();
    let plan = Plan::build(&mesh, Scheme::Sqrt3, LEVELS).expect("small");
    eprintln!("level {LEVELS}: {} vertices, {} faces", plan.n_vertices(), plan.n_faces());

    let mut group = c.benchmark_group("subdivide");
    group.bench_function("dedge_from_control_triangles", |b| {
        b.iter(|| DedgeMesh::from_triangles(mesh.n_vertices(), black_box(&triangles)))
    });
    group.bench_function("dedge_from_level_4_triangles", |b| {
        let triangles = plan.indices().as_chunks::<3>().0;
        b.iter(|| DedgeMesh::from_triangles(plan.n_vertices(), black_box(triangles)))
    });
    group.bench_function("plan_build", |b| b.iter(|| Plan::build(black_box(&mesh), Scheme::Sqrt3, LEVELS)));

    let mut evaluator = Evaluator::new(&plan);
    for threads in [1, 2] {
        evaluator.set_threads(threads);
        group.bench_function(format!("evaluate_positions_and_normals_{threads}_threads"), |b| {
            b.iter(|| {
                black_box(evaluator.evaluate(&plan, black_box(&control)));
            })
        });
    }
    evaluator.set_threads(1);
    let mut positions = vec![Vec3::ZERO; plan.n_vertices()];
    group.bench_function("evaluate_positions_only", |b| {
        b.iter(|| evaluator.evaluate_attribute(&plan, black_box(&control), black_box(&mut positions)))
    });

    let surface = evaluator.evaluate(&plan, &control);
    let mut normals = vec![Vec3::ZERO; plan.n_vertices()];
    group.bench_function("copy_positions_and_normals", |b| {
        b.iter(|| {
            black_box(&mut positions).copy_from_slice(black_box(surface.positions));
            black_box(&mut normals).copy_from_slice(black_box(surface.normals));
        })
    });
    group.finish();
}

criterion_group!(subdivide, benches);
criterion_main!(subdivide);
