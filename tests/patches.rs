//! Triangles whose corners agree share their rows: the same surface as step by step, whatever lies around them.

use glam::{DVec3, Vec3};
use londra::math::rng::Rng;
use londra::mesh::shapes::{grid, grid_with_hole, icosahedron, pole, tetrahedron, torus};
use londra::mesh::{DedgeMesh, VertexId};
use londra::subdiv::{
    BoundaryRule, Creasing, DoublePlan, Evaluator, INFINITE_SHARPNESS, LoopWeights, Normals, Plan, PlanFileError,
    PlanOptions, Positions, Scheme, Tags, levels_of,
};

struct Given {
    name: String,
    mesh: DedgeMesh,
    control: Vec<Vec3>,
    tags: Tags,
    options: PlanOptions,
}

/// A shape refined, so that it has many triangles of few kinds, with every vertex moved.
fn subject(shape: &londra::mesh::shapes::Shape, steps: u32) -> (DedgeMesh, Vec<Vec3>) {
    let mesh = shape.mesh().expect("in the cabinet");
    let options = PlanOptions { normals: Normals::None, ..PlanOptions::new(Scheme::Loop, steps) };
    let fine = levels_of(&mesh, &Tags::default(), &options).expect("small").pop().expect("the last level");
    let plan = Plan::build_with(&mesh, &Tags::default(), &options).expect("small");
    let mut rng = Rng::new(7);
    let positions = Evaluator::new(&plan).evaluate(&plan, &shape.positions).positions.to_vec();
    let moved = positions.into_iter().map(|p| p + Vec3::from_array([0; 3].map(|_| rng.between(-0.05, 0.05))));
    (fine, moved.collect())
}

/// A crease of each sharpness across some triangles, with a dart at either end, and corners.
fn creases(mesh: &DedgeMesh) -> Tags {
    let mut tags = Tags::default();
    for (start, sharpness) in [(3, INFINITE_SHARPNESS), (40, 1.5), (77, 2.25)] {
        let mut dedge = londra::mesh::FaceId(start % mesh.n_faces() as u32).dedge(0);
        for _ in 0..3 {
            tags.creases.push((mesh.origin(dedge), mesh.target(dedge), sharpness));
            // Straight on, where there is a way.
            let Some(onward) = mesh.twin(dedge.next()).and_then(|d| mesh.twin(d.next())) else { break };
            dedge = onward.next();
        }
    }
    tags.corners = vec![(VertexId(5), INFINITE_SHARPNESS), (VertexId(11), 1.5)];
    tags
}

fn given() -> Vec<Given> {
    let mut given = Vec::new();
    let shapes = [
        ("icosahedron", icosahedron(), 2),
        ("tetrahedron", tetrahedron(), 3),
        ("pole of seven", pole(7), 3),
        ("torus", torus(12, 8), 0),
        ("grid", grid(16, 16), 0),
        ("grid with a hole", grid_with_hole(), 2),
    ];
    for (name, shape, steps) in shapes {
        let (mesh, control) = subject(&shape, steps);
        for tags in [Tags::default(), creases(&mesh)] {
            for (creasing, boundary, loop_weights) in [
                (Creasing::Uniform, BoundaryRule::EdgeOnly, LoopWeights::Loop),
                (Creasing::Chaikin, BoundaryRule::EdgeAndCorner, LoopWeights::Warren),
            ] {
                for (levels, positions, normals) in [
                    (3, Positions::Limit, Normals::Limit),
                    (3, Positions::Level, Normals::Faces),
                    (4, Positions::Level, Normals::None),
                    (3, Positions::Level, Normals::Limit),
                    (4, Positions::Limit, Normals::None),
                ] {
                    let scheme = Scheme::Loop;
                    let options = PlanOptions { scheme, levels, loop_weights, boundary, creasing, positions, normals };
                    let name = format!("{name}, {} tags, {options:?}", tags.creases.len());
                    let (mesh, control, tags) = (mesh.clone(), control.clone(), tags.clone());
                    given.push(Given { name, mesh, control, tags, options });
                }
            }
        }
    }
    given
}

/// Positions and normals in double precision, table by table.
fn expected(given: &Given, plan: &Plan) -> (Vec<DVec3>, Vec<DVec3>) {
    let double = DoublePlan::build_with(&given.mesh, &given.tags, &given.options).expect("small");
    let mut values: Vec<DVec3> = given.control.iter().map(|p| p.as_dvec3()).collect();
    for table in &double.tables {
        let mut finer = vec![DVec3::ZERO; table.n_rows()];
        table.apply(&values, &mut finer);
        values = finer;
    }
    let limit = double.limit.expect("Loop has limits");
    let rows = |k: usize| -> Vec<DVec3> {
        let row = |v: usize| {
            let (sources, weights) = limit.row(v);
            sources.iter().zip(weights).map(|(&s, w)| values[s as usize] * w[k]).sum()
        };
        (0..values.len()).map(row).collect()
    };
    let normals = match given.options.normals {
        Normals::None => Vec::new(),
        Normals::Limit => rows(1).into_iter().zip(rows(2)).map(|(a, b)| a.cross(b).normalize()).collect(),
        Normals::Faces => {
            let mut sums = vec![DVec3::ZERO; values.len()];
            for face in plan.indices().as_chunks::<3>().0 {
                let [a, b, c] = face.map(|v| values[v as usize]);
                face.iter().for_each(|&v| sums[v as usize] += (b - a).cross(c - a));
            }
            sums.into_iter().map(DVec3::normalize).collect()
        }
    };
    let positions = if given.options.positions == Positions::Limit { rows(0) } else { values };
    (positions, normals)
}

fn farthest(found: &[Vec3], expected: &[DVec3]) -> f64 {
    assert_eq!(found.len(), expected.len());
    found.iter().zip(expected).map(|(f, e)| (f.as_dvec3() - *e).length()).fold(0.0, f64::max)
}

#[test]
fn a_shared_row_leads_elsewhere() {
    let mut n_shared = 0;
    for given in given() {
        let plan = Plan::build_with(&given.mesh, &given.tags, &given.options).expect("small");
        n_shared += usize::from(plan.n_patch_bytes() > 0);
        let (positions, normals) = expected(&given, &plan);
        let mut evaluator = Evaluator::new(&plan);
        let surface = evaluator.evaluate(&plan, &given.control);
        let (moved, turned) = (farthest(surface.positions, &positions), farthest(surface.normals, &normals));
        let size = given.control.iter().map(|p| p.abs().max_element()).fold(1.0, f32::max);
        assert!(moved < 2e-6 * f64::from(size), "{}: positions by {moved:e}", given.name);
        // Short tangents lose digits.
        assert!(turned < 5e-4, "{}: normals by {turned:e}", given.name);
    }
    assert!(n_shared > 60, "only {n_shared} of the plans share rows");
}

#[test]
fn a_shared_row_depends_on_threads_or_on_the_disk() {
    for given in given().into_iter().step_by(3) {
        let plan = Plan::build_with(&given.mesh, &given.tags, &given.options).expect("small");
        let mut evaluator = Evaluator::new(&plan);
        let alone = evaluator.evaluate(&plan, &given.control);
        let (positions, normals) = (alone.positions.to_vec(), alone.normals.to_vec());
        let loaded = Plan::from_bytes(&plan.to_bytes(), Some(plan.fingerprint())).expect("as saved");
        assert_eq!(loaded, plan, "{}", given.name);
        for threads in [2, 3, 8] {
            evaluator.set_threads(threads);
            let together = evaluator.evaluate(&loaded, &given.control);
            assert!(
                together.positions == positions && together.normals == normals,
                "{}, {threads} threads",
                given.name
            );
        }
        // Attributes go the same way as positions.
        if plan.n_patch_bytes() > 0 {
            let mut carried = vec![Vec3::ZERO; plan.n_vertices()];
            evaluator.evaluate_attribute(&plan, &given.control, &mut carried);
            assert!(carried == positions, "{}", given.name);
        }
    }
}

/// Every byte of the part with the patches, one after another, made another one, with a checksum that fits.
#[test]
fn a_damaged_patch_is_taken_for_one() {
    let (mesh, control) = subject(&icosahedron(), 1);
    let options = PlanOptions { normals: Normals::Limit, ..PlanOptions::new(Scheme::Loop, 3) };
    let plan = Plan::build_with(&mesh, &Tags::default(), &options).expect("small");
    assert!(plan.n_patch_bytes() > 0);
    let bytes = plan.to_bytes();
    let first = bytes.len() - plan.n_patch_bytes();
    let mut n_refused = 0;
    for place in (first..bytes.len()).step_by(61) {
        let mut damaged = bytes.clone();
        damaged[place] ^= 0x41;
        let sum = twox_hash::XxHash3_64::oneshot(&damaged[40..]);
        damaged[32..40].copy_from_slice(&sum.to_le_bytes());
        match Plan::from_bytes(&damaged, None) {
            // Another weight, or another vertex that exists: a plan, if not a good one.
            Ok(plan) => assert_eq!(Evaluator::new(&plan).evaluate(&plan, &control).positions.len(), plan.n_vertices()),
            Err(PlanFileError::Inconsistent { .. }) => n_refused += 1,
            Err(other) => panic!("{other}"),
        }
    }
    assert!(n_refused > 100, "{n_refused}");
}

#[test]
fn shared_rows_save_nothing() {
    let (mesh, _) = subject(&icosahedron(), 3);
    let options = PlanOptions { normals: Normals::Limit, ..PlanOptions::new(Scheme::Loop, 4) };
    let plan = Plan::build_with(&mesh, &Tags::default(), &options).expect("small");
    let (shared, tables) = (plan.n_patch_bytes(), plan.n_table_bytes());
    println!("rows by patch: {shared} bytes; by step: {tables} bytes");
    assert!(0 < shared && 4 * shared < tables, "{shared} {tables}");
}
