//! The bits of the engine: every scheme, with creases, frozen faces and limits, whatever the number of threads, against
//! hashes that are committed.
//!
//! `UPDATE_HASHES=1 cargo test --test engine_hash` writes them anew; say in CHANGELOG.md why they moved.

use std::fmt::Write as _;
use std::path::PathBuf;

use glam::Vec3;
use londra::math::fnv::Fnv64;
use londra::math::rng::Rng;
use londra::mesh::shapes::{Shape, grid_with_hole, icosahedron};
use londra::mesh::{FaceId, PolygonMesh, VertexId};
use londra::subdiv::{
    Creasing, Evaluator, INFINITE_SHARPNESS, LoopWeights, Normals, Plan, PlanOptions, Positions, Scheme, Tags,
};

const THREADS: [usize; 4] = [1, 2, 3, 8];

fn file() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/engine_hashes.txt")
}

struct Subject {
    name: String,
    plan: Plan,
    control: Vec<Vec3>,
}

/// Deep enough for several chunks of work.
fn depth(scheme: Scheme) -> u32 {
    match scheme {
        Scheme::Sqrt3 | Scheme::Sqrt3Interpolating => 6,
        _ => 5,
    }
}

fn jittered(shape: &Shape) -> Vec<Vec3> {
    let mut rng = Rng::new(41);
    shape.positions.iter().map(|&p| p + Vec3::from_array([0; 3].map(|_| rng.between(-0.2, 0.2)))).collect()
}

fn creases(shape: &Shape) -> Tags {
    let [a, b, c] = shape.triangles[0].map(VertexId);
    let far = shape.triangles[shape.triangles.len() - 1].map(VertexId);
    Tags {
        creases: vec![(a, b, INFINITE_SHARPNESS), (b, c, 1.5), (far[0], far[1], 2.25)],
        corners: vec![(far[2], INFINITE_SHARPNESS)],
        ..Tags::default()
    }
}

fn subjects() -> Vec<Subject> {
    let mut subjects = Vec::new();
    for shape in [icosahedron(), grid_with_hole()] {
        let mesh = shape.mesh().expect("in the cabinet");
        let mut add = |what: &str, tags: Tags, options: PlanOptions| {
            let plan = Plan::build_with(&mesh, &tags, &options).unwrap_or_else(|e| panic!("{what}: {e}"));
            let name = format!("{} {}{what}", shape.name, options.scheme.name());
            subjects.push(Subject { name, plan, control: jittered(&shape) });
        };
        for scheme in Scheme::ALL {
            let options = PlanOptions::new(scheme, depth(scheme));
            add("", Tags::default(), options);
            if scheme.has_creases() {
                add("+creases", creases(&shape), options);
                add("+creases+chaikin", creases(&shape), PlanOptions { creasing: Creasing::Chaikin, ..options });
            }
            if scheme.has_limits() {
                let limit = PlanOptions { positions: Positions::Limit, normals: Normals::Limit, ..options };
                add("+limit", Tags::default(), limit);
                add("+limit-normals", Tags::default(), PlanOptions { positions: Positions::Level, ..limit });
                add("+limit-positions", Tags::default(), PlanOptions { normals: Normals::Faces, ..limit });
                add("+creases+limit", creases(&shape), limit);
            }
            if scheme == Scheme::Sqrt3 {
                let frozen = Tags { frozen: vec![FaceId(1), FaceId(2)], holes: vec![FaceId(16)], ..Tags::default() };
                add("+frozen+hole", frozen, options);
            }
            if scheme == Scheme::Loop {
                add("+warren", Tags::default(), PlanOptions { loop_weights: LoopWeights::Warren, ..options });
            }
        }
    }
    // A cube of quadrilaterals without its lid.
    let corners = [0, 3, 2, 1, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7];
    let box_mesh = PolygonMesh::from_faces(8, &[4; 5], &corners).expect("a manifold");
    let control: Vec<Vec3> = (0..8)
        .map(|v| Vec3::new(((v + 1) / 2 % 2) as f32, (v / 2 % 2) as f32 + 0.1 * v as f32, (v / 4) as f32))
        .collect();
    for scheme in [Scheme::CatmullClark, Scheme::DooSabin] {
        let options = PlanOptions::new(scheme, 6);
        let plan = Plan::build_polygons(&box_mesh, &Tags::default(), &options).expect("small");
        subjects.push(Subject { name: format!("box {}", scheme.name()), plan, control: control.clone() });
    }
    subjects
}

/// Faces, positions and normals, in that order: with other faces the rest differs too.
fn hashes(subject: &Subject, evaluator: &mut Evaluator) -> [(&'static str, u64); 3] {
    let surface = evaluator.evaluate(&subject.plan, &subject.control);
    let of_points = |points: &[Vec3]| {
        let mut hash = Fnv64::new();
        points.iter().for_each(|p| p.to_array().into_iter().for_each(|x| hash.f32(x)));
        hash.finish()
    };
    let mut faces = Fnv64::new();
    surface.indices.iter().for_each(|&v| faces.u32(v));
    [("faces", faces.finish()), ("positions", of_points(surface.positions)), ("normals", of_points(surface.normals))]
}

#[test]
fn a_surface_has_other_bits_than_the_committed_ones() {
    let mut made = String::from("# surface part hash; written by UPDATE_HASHES=1 cargo test --test engine_hash\n");
    for subject in subjects() {
        for (part, hash) in hashes(&subject, &mut Evaluator::new(&subject.plan)) {
            let _ = writeln!(made, "{} {part} {hash:016x}", subject.name);
        }
    }
    if std::env::var_os("UPDATE_HASHES").is_some() {
        std::fs::write(file(), &made).unwrap_or_else(|e| panic!("{}: {e}", file().display()));
        return;
    }
    let committed = std::fs::read_to_string(file()).unwrap_or_default().replace("\r\n", "\n");
    let differing: Vec<&str> = made.lines().filter(|line| !committed.lines().any(|c| c == *line)).collect();
    assert!(
        differing.is_empty(),
        "{} hashes differ from tests/engine_hashes.txt:\n{}\n\
         If that is meant, run UPDATE_HASHES=1 cargo test --test engine_hash and say why in CHANGELOG.md.",
        differing.len(),
        differing.join("\n")
    );
    assert_eq!(made, committed, "tests/engine_hashes.txt has lines that no surface makes");
}

#[test]
fn bits_of_a_scheme_depend_on_the_number_of_threads() {
    let mut evaluator: Option<Evaluator> = None;
    for subject in subjects() {
        assert!(subject.plan.n_vertices() > 4096, "{}: too small for several threads to have work", subject.name);
        let expected = hashes(&subject, &mut Evaluator::new(&subject.plan));
        // One evaluator for all: it must not matter either what it did before.
        let evaluator = evaluator.get_or_insert_with(|| Evaluator::new(&subject.plan));
        for threads in THREADS {
            evaluator.set_threads(threads);
            assert_eq!(hashes(&subject, evaluator), expected, "{} with {threads} threads", subject.name);
        }
    }
}
