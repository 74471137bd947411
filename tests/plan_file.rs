//! A plan on disk: what comes back is what was saved, and nothing else is taken for it.

use londra::math::rng::Rng;
use londra::mesh::PolygonMesh;
use londra::mesh::shapes::{cabinet, grid_with_hole, icosahedron};
use londra::mesh::{FaceId, VertexId};
use londra::subdiv::{Normals, Plan, PlanFileError, PlanOptions, Positions, Scheme, Tags, evaluate_once};

fn plans() -> Vec<Plan> {
    let mut plans = Vec::new();
    for shape in cabinet() {
        let mesh = shape.mesh().expect("in the cabinet");
        for scheme in Scheme::ALL {
            let options = PlanOptions::new(scheme, 2);
            plans.push(Plan::build_with(&mesh, &Tags::default(), &options).expect("small"));
            if scheme.has_limits() {
                let options = PlanOptions { positions: Positions::Limit, normals: Normals::Limit, ..options };
                plans.push(Plan::build_with(&mesh, &Tags::default(), &options).expect("small"));
            }
        }
    }
    let shape = grid_with_hole();
    let mesh = shape.mesh().expect("a grid");
    let tags = Tags {
        creases: vec![(VertexId(14), VertexId(15), 2.5)],
        corners: vec![(VertexId(0), 10.0)],
        holes: vec![FaceId(44)],
        frozen: vec![FaceId(0)],
    };
    plans.push(Plan::build_with(&mesh, &tags, &PlanOptions::new(Scheme::Sqrt3, 3)).expect("small"));
    let bend = |c: &londra::subdiv::Candidate| c.bend() > 0.05;
    let adaptive =
        Plan::build_adaptive(&mesh, &Tags::default(), &PlanOptions::new(Scheme::Sqrt3, 4), &shape.positions, &bend);
    plans.push(adaptive.expect("small"));
    plans
}

#[test]
fn a_plan_comes_back_otherwise() {
    for plan in plans() {
        let bytes = plan.to_bytes();
        assert_eq!(Plan::from_bytes(&bytes, Some(plan.fingerprint())).as_ref(), Ok(&plan));
        // Wherever the bytes lie in memory.
        let mut shifted = vec![0_u8];
        shifted.extend(&bytes);
        assert_eq!(Plan::from_bytes(&shifted[1..], None).as_ref(), Ok(&plan));
    }
}

#[test]
fn a_fingerprint_needs_the_plan() {
    let mesh = icosahedron().mesh().expect("closed");
    let polygons = PolygonMesh::from(&mesh);
    for scheme in Scheme::ALL {
        let options = PlanOptions::new(scheme, 1);
        let plan = Plan::build_with(&mesh, &Tags::default(), &options).expect("small");
        assert_eq!(plan.fingerprint(), Plan::fingerprint_of(&mesh, &Tags::default(), &options));
        if !scheme.is_triangular() {
            assert_eq!(plan.fingerprint(), Plan::fingerprint_of_polygons(&polygons, &Tags::default(), &options));
        }
    }
}

#[test]
fn the_plan_of_other_inputs_is_taken() {
    let mesh = icosahedron().mesh().expect("closed");
    let base = PlanOptions::new(Scheme::Sqrt3, 2);
    let bytes = Plan::build_with(&mesh, &Tags::default(), &base).expect("small").to_bytes();
    let sharp = Tags { corners: vec![(VertexId(3), 1.0)], ..Tags::default() };
    let others = [
        Plan::fingerprint_of(&mesh, &Tags::default(), &PlanOptions { levels: 3, ..base }),
        Plan::fingerprint_of(&mesh, &Tags::default(), &PlanOptions { scheme: Scheme::Loop, ..base }),
        Plan::fingerprint_of(&mesh, &Tags::default(), &PlanOptions { normals: Normals::None, ..base }),
        Plan::fingerprint_of(&mesh, &sharp, &base),
        Plan::fingerprint_of(&grid_with_hole().mesh().expect("a grid"), &Tags::default(), &base),
    ];
    for expected in others {
        let found = Plan::fingerprint_of(&mesh, &Tags::default(), &base);
        assert_eq!(Plan::from_bytes(&bytes, Some(expected)), Err(PlanFileError::OtherInputs { found, expected }));
    }
}

#[test]
fn damage_is_not_found() {
    let mesh = grid_with_hole().mesh().expect("a grid");
    let plan = Plan::build(&mesh, Scheme::Sqrt3, 1).expect("small");
    let bytes = plan.to_bytes();
    for end in 0..bytes.len() {
        assert!(Plan::from_bytes(&bytes[..end], None).is_err(), "cut at {end}");
    }
    let mut rng = Rng::new(3);
    for _ in 0..2000 {
        let mut damaged = bytes.clone();
        let at = (rng.between(0.0, 1.0) * bytes.len() as f32) as usize % bytes.len();
        damaged[at] ^= 1 << ((rng.between(0.0, 8.0) as u32) % 8);
        // The four bytes behind the version mean nothing, and neither does the fingerprint where none is expected.
        if !(12..24).contains(&at) {
            assert!(Plan::from_bytes(&damaged, None).is_err(), "byte {at}");
        }
    }
    let mut longer = bytes.clone();
    longer.push(0);
    let expected = bytes.len() as u64 - 40;
    assert_eq!(Plan::from_bytes(&longer, None), Err(PlanFileError::Length { found: expected + 1, expected }));
    let mut newer = bytes.clone();
    newer[8] = 99;
    assert_eq!(Plan::from_bytes(&newer, None), Err(PlanFileError::Version { found: 99 }));
    assert_eq!(Plan::from_bytes(b"solid nothing", None), Err(PlanFileError::NotAPlan));
}

/// Whatever the numbers say, with a checksum that fits them: an error, or a plan that evaluates within its bounds.
#[test]
fn numbers_out_of_range_are_read_out_of_place() {
    let shape = grid_with_hole();
    let mesh = shape.mesh().expect("a grid");
    let options =
        PlanOptions { positions: Positions::Limit, normals: Normals::Limit, ..PlanOptions::new(Scheme::Loop, 1) };
    for plan in [
        Plan::build(&mesh, Scheme::Sqrt3, 1).expect("small"),
        Plan::build_with(&mesh, &Tags::default(), &options).expect("small"),
    ] {
        let bytes = plan.to_bytes();
        let mut rng = Rng::new(11);
        for _ in 0..3000 {
            let mut altered = bytes.clone();
            let at = 40
                + 4 * ((rng.between(0.0, 1.0) * ((bytes.len() - 40) / 4) as f32) as usize % ((bytes.len() - 40) / 4));
            let value = [0_u32, 1, 7, 1000, u32::MAX, 1 << 31][(rng.between(0.0, 6.0) as usize) % 6];
            altered[at..at + 4].copy_from_slice(&value.to_le_bytes());
            let checksum = twox_hash::XxHash3_64::oneshot(&altered[40..]);
            altered[32..40].copy_from_slice(&checksum.to_le_bytes());
            if let Ok(plan) = Plan::from_bytes(&altered, None) {
                let control = vec![shape.positions[0]; plan.n_control()];
                let (positions, _) = evaluate_once(&plan, &control);
                assert_eq!(positions.len(), plan.n_vertices());
            }
        }
    }
}
