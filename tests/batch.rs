//! Many heads with one plan: each to the bits that it has alone.

use glam::Vec3;
use londra::math::rng::Rng;
use londra::mesh::shapes::{cabinet, grid_with_hole};
use londra::mesh::{FaceId, VertexId};
use londra::subdiv::{Evaluator, Normals, Plan, PlanOptions, Positions, Scheme, Tags};

fn bits(values: &[Vec3]) -> Vec<[u32; 3]> {
    values.iter().map(|v| v.to_array().map(f32::to_bits)).collect()
}

fn check(plan: &Plan, rest: &[Vec3], n_heads: usize, threads: usize, what: &str) {
    let mut rng = Rng::new(5);
    let heads: Vec<Vec<Vec3>> = (0..n_heads)
        .map(|_| rest.iter().map(|&p| p + Vec3::from_array([0; 3].map(|_| rng.between(-0.3, 0.3)))).collect())
        .collect();
    let n = plan.n_vertices();
    let n_normals = if plan.options().normals == Normals::None { 0 } else { n };
    let (mut positions, mut normals) = (vec![Vec3::NAN; n_heads * n], vec![Vec3::NAN; n_heads * n_normals]);
    let mut evaluator = Evaluator::new(plan);
    evaluator.set_threads(threads);
    evaluator.evaluate_batch(plan, &heads.concat(), &mut positions, &mut normals);
    for (i, head) in heads.iter().enumerate() {
        let surface = evaluator.evaluate(plan, head);
        let what = format!("{what}, head {i} of {n_heads}, {threads} threads");
        assert!(bits(surface.positions) == bits(&positions[i * n..(i + 1) * n]), "{what}: positions");
        assert!(bits(surface.normals) == bits(&normals[i * n_normals..(i + 1) * n_normals]), "{what}: normals");
    }
}

#[test]
fn a_head_of_a_batch_differs_from_one_alone() {
    for shape in cabinet() {
        let mesh = shape.mesh().expect("in the cabinet");
        for scheme in Scheme::ALL {
            for normals in [Normals::Faces, Normals::None] {
                let options = PlanOptions { normals, ..PlanOptions::new(scheme, 2) };
                let plan = Plan::build_with(&mesh, &Tags::default(), &options).expect("small");
                check(&plan, &shape.positions, 11, 1, &format!("{} {scheme:?}", shape.name));
            }
        }
    }
}

#[test]
fn a_batch_depends_on_its_size_its_threads_or_its_tags() {
    let shape = grid_with_hole();
    let mesh = shape.mesh().expect("a grid");
    let tags = Tags {
        creases: vec![(VertexId(14), VertexId(15), 1.5), (VertexId(15), VertexId(16), 10.0)],
        frozen: vec![FaceId(0)],
        ..Tags::default()
    };
    for n_heads in [0, 1, 7, 8, 9, 24] {
        for threads in [1, 2, 3] {
            for levels in [0, 1, 4] {
                let plan = Plan::build_with(&mesh, &tags, &PlanOptions::new(Scheme::Sqrt3, levels)).expect("small");
                check(&plan, &shape.positions, n_heads, threads, "tagged");
            }
            let limit = PlanOptions {
                positions: Positions::Limit,
                normals: Normals::Limit,
                ..PlanOptions::new(Scheme::Loop, 2)
            };
            let plan = Plan::build_with(&mesh, &Tags::default(), &limit).expect("small");
            check(&plan, &shape.positions, n_heads, threads, "limit");
        }
    }
}

/// Faces without area, in one head of eight only.
#[test]
fn a_degenerate_head_spoils_its_neighbours() {
    let shape = grid_with_hole();
    let plan = Plan::build(&shape.mesh().expect("a grid"), Scheme::Sqrt3, 2).expect("small");
    let mut heads: Vec<Vec<Vec3>> =
        (0..8).map(|k| shape.positions.iter().map(|p| *p * (k + 1) as f32).collect()).collect();
    heads[3].iter_mut().for_each(|p| *p = Vec3::ONE);
    heads[5].iter_mut().for_each(|p| *p *= 1e-25);
    let n = plan.n_vertices();
    let (mut positions, mut normals) = (vec![Vec3::NAN; 8 * n], vec![Vec3::NAN; 8 * n]);
    let mut evaluator = Evaluator::new(&plan);
    evaluator.evaluate_batch(&plan, &heads.concat(), &mut positions, &mut normals);
    for (i, head) in heads.iter().enumerate() {
        assert!(bits(evaluator.evaluate(&plan, head).normals) == bits(&normals[i * n..(i + 1) * n]), "head {i}");
    }
    assert!(normals.iter().all(|n| (n.length() - 1.0).abs() < 1e-5));
}
