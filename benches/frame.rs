//! A frame of the head at level 4 on one core, beside a plain copy of what it writes.
//!
//! What counts is the ratio to the copy within one run; milliseconds belong to one machine and day. The goal is 4 ms from
//! changed values to filled buffers.

use std::hint::black_box;
use std::sync::Arc;
use std::time::{Duration, Instant};

use criterion::{Criterion, criterion_group, criterion_main};
use glam::Vec3;
use londra::anatomy::{Breed, ParamTable, library};
use londra::frame::{Frame, Pipeline};
use londra::motion::{Activation, Library};
use londra::rig::{Deformed, Rig, deform::ROUNDS};
use londra::subdiv::Evaluator;

const LEVEL: u32 = 4;

/// What changes with the values: positions, normals, flow of all parts.
fn copy(frame: &Frame, out: &mut [Vec3]) {
    let mut rest = out;
    for part in &frame.parts {
        for values in [part.positions, part.normals, part.flow] {
            let (to, after) = rest.split_at_mut(values.len());
            to.copy_from_slice(values);
            rest = after;
        }
    }
}

/// Shortest time of one call, of 301: what else the machine does can only add to it.
fn shortest(mut call: impl FnMut()) -> Duration {
    let time = |_| {
        let start = Instant::now();
        call();
        start.elapsed()
    };
    (0..301).map(time).min().unwrap_or_default()
}

fn benches(c: &mut Criterion) {
    let table = Arc::new(ParamTable::embedded().expect("the embedded table is tested"));
    let rig = Arc::new(Rig::embedded(&table).expect("the embedded rig is tested"));
    let breed = |id: &str| library::breed(&table, id).expect("an embedded breed");
    let two: [Breed; 2] = [breed("labrador"), breed("pug")];
    let same_look = Breed { look: two[0].look.clone(), ..two[1].clone() };
    let mut pipeline = Pipeline::new(rig.clone(), LEVEL).expect("a level that is allowed");
    let plan = pipeline.skin_plan().clone();
    let mut evaluator = Evaluator::new(&plan);
    let mut deformed = Deformed::default();
    let mut attribute = vec![Vec3::ZERO; plan.n_vertices()];

    let frame = pipeline.update(&two[0]);
    let mut copied = vec![Vec3::ZERO; frame.parts.iter().map(|p| 3 * p.topology.n_vertices).sum()];
    eprintln!("level {LEVEL}: {} skin vertices, {} triangles in all", plan.n_vertices(), frame.n_triangles());

    let mut turn = 0;
    let mut values = || {
        turn += 1;
        [&two[0], &same_look][turn % 2]
    };
    let mut group = c.benchmark_group("frame");
    group.bench_function("deform", |b| b.iter(|| rig.deform(&values().values, ROUNDS, black_box(&mut deformed))));
    group.bench_function("evaluate_positions_and_normals", |b| {
        b.iter(|| {
            black_box(evaluator.evaluate(&plan, black_box(&deformed.control)));
        })
    });
    group.bench_function("evaluate_one_attribute", |b| {
        b.iter(|| evaluator.evaluate_attribute(&plan, black_box(&deformed.control), black_box(&mut attribute)))
    });
    group.bench_function("update_with_other_values", |b| {
        b.iter(|| {
            black_box(pipeline.update(values()));
        })
    });
    group.bench_function("update_with_other_values_and_look", |b| {
        let mut turn = 0;
        b.iter(|| {
            turn += 1;
            black_box(pipeline.update(&two[turn % 2]));
        })
    });
    group.bench_function("copy_of_the_output", |b| b.iter(|| copy(&pipeline.frame(), black_box(&mut copied))));
    group.finish();

    let whole = shortest(|| {
        black_box(pipeline.update(values()));
    });
    let shape = shortest(|| rig.deform(&values().values, ROUNDS, black_box(&mut deformed)));
    let refining = shortest(|| {
        black_box(evaluator.evaluate(&plan, black_box(&deformed.control)));
    });
    let copying = shortest(|| copy(&pipeline.frame(), black_box(&mut copied)));
    posing(&rig, &two[0], &mut deformed, whole.saturating_sub(shape));
    eprintln!(
        "frame at level {LEVEL}: {:.2} ms, of it deform {:.2}, positions and normals {:.2}; {:.1} times a copy of its output ({:.2} ms)",
        1e3 * whole.as_secs_f64(),
        1e3 * shape.as_secs_f64(),
        1e3 * refining.as_secs_f64(),
        whole.as_secs_f64() / copying.as_secs_f64(),
        1e3 * copying.as_secs_f64()
    );
}

/// What a pose costs beside a copy of the control mesh, and beside the rest of a frame whose values stay.
fn posing(rig: &Rig, breed: &Breed, head: &mut Deformed, rest: Duration) {
    let library = Library::embedded().expect("the embedded tables are tested");
    rig.deform(&breed.values, ROUNDS, head);
    let mut copied = head.control.clone();
    let copying = shortest(|| black_box(&mut copied).copy_from_slice(black_box(&head.control)));
    for what in ["AU12", "AU101+AU145", "EAD103", "AU27", "AU12+AU109_110+AU27+AU143+EAD103+AU101+AD19+AD51"] {
        let mut asked = Activation::default();
        for word in what.split('+') {
            let (unit, side) = library.units.find(word).expect("a unit");
            asked.set(unit, side, 1.0);
        }
        let own = shortest(|| rig.pose(&breed.values, &library.pose_of(black_box(&asked)), head));
        eprintln!(
            "pose {what}: {:.0} us, {:.0} times a copy of the control mesh ({:.2} us), {:.1} % of the rest of a frame",
            1e6 * own.as_secs_f64(),
            own.as_secs_f64() / copying.as_secs_f64(),
            1e6 * copying.as_secs_f64(),
            100.0 * own.as_secs_f64() / rest.as_secs_f64()
        );
    }
}

criterion_group!(frame, benches);
criterion_main!(frame);
