//! The naive judge: Loop in six linear steps as in the lecture notes "Implementing subdivision for Project 3", in double
//! precision, from triangle lists alone. It shares no line with the engine that it judges.
//!
//! The notes treat closed meshes. At a boundary the rules are the usual ones: middles of edges, and [1 6 1]/8.

#[path = "support/random.rs"]
mod random;
#[path = "support/tables.rs"]
mod tables;
#[path = "support/walk.rs"]
mod walk;

use glam::DVec3;
use londra::mesh::PolygonMesh;
use londra::subdiv::{DoublePlan, Plan, PlanOptions, Scheme, Tags, evaluate_once};
use random::Sample;

type Triangles = Vec<[usize; 3]>;

/// Step 1: how many triangles there are at each vertex.
fn degrees(n_vertices: usize, triangles: &Triangles) -> Vec<usize> {
    let mut degrees = vec![0; n_vertices];
    triangles.iter().flatten().for_each(|&v| degrees[v] += 1);
    degrees
}

/// Step 2: which.
fn incident_triangles(degrees: &[usize], triangles: &Triangles) -> Vec<Vec<usize>> {
    let mut incident: Vec<Vec<usize>> = degrees.iter().map(|&n| Vec::with_capacity(n)).collect();
    for (t, corners) in triangles.iter().enumerate() {
        corners.iter().for_each(|&v| incident[v].push(t));
    }
    incident
}

/// Step 3: the triangle across the side opposite to each corner, found in the shorter of two lists.
fn adjacency(incident: &[Vec<usize>], triangles: &Triangles) -> Vec<[Option<usize>; 3]> {
    let across = |t: usize, i: usize| {
        let (a, b) = (triangles[t][(i + 1) % 3], triangles[t][(i + 2) % 3]);
        let (few, other) = if incident[a].len() < incident[b].len() { (a, b) } else { (b, a) };
        incident[few].iter().copied().find(|&j| j != t && triangles[j].contains(&other))
    };
    (0..triangles.len()).map(|t| [0, 1, 2].map(|i| across(t, i))).collect()
}

/// Step 4: the number of the edge opposite to each corner, and how many edges there are.
fn edge_labels(adjacency: &[[Option<usize>; 3]], triangles: &Triangles) -> (Vec<[usize; 3]>, usize) {
    const UNLABELLED: usize = usize::MAX;
    let (mut labels, mut n) = (vec![[UNLABELLED; 3]; triangles.len()], 0);
    for t in 0..triangles.len() {
        for i in 0..3 {
            if labels[t][i] == UNLABELLED {
                labels[t][i] = n;
                if let Some(j) = adjacency[t][i] {
                    let (a, b) = (triangles[t][(i + 1) % 3], triangles[t][(i + 2) % 3]);
                    let k = (0..3).find(|&k| triangles[j][k] != a && triangles[j][k] != b).expect("a third corner");
                    labels[j][k] = n;
                }
                n += 1;
            }
        }
    }
    (labels, n)
}

/// Step 5: the triangles of the output. Vertex `e` + number of vertices lies on edge `e`.
fn triangle_table(n_vertices: usize, labels: &[[usize; 3]], triangles: &Triangles) -> Triangles {
    let mut finer = Vec::with_capacity(4 * triangles.len());
    for (corners, labels) in triangles.iter().zip(labels) {
        let [a, b, c] = *corners;
        let [bc, ca, ab] = labels.map(|label| n_vertices + label);
        finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [bc, ca, ab]]);
    }
    finer
}

/// Step 6: where the old vertices and those on edges come to lie.
fn positions(
    old: &[DVec3],
    triangles: &Triangles,
    incident: &[Vec<usize>],
    adjacency: &[[Option<usize>; 3]],
    labels: &[[usize; 3]],
    n_edges: usize,
) -> Vec<DVec3> {
    let mut finer = Vec::with_capacity(old.len() + n_edges);
    for (v, &p) in old.iter().enumerate() {
        let mut neighbours = DVec3::ZERO;
        let mut along = DVec3::ZERO;
        let mut is_boundary = false;
        for &t in &incident[v] {
            let i = triangles[t].iter().position(|&corner| corner == v).expect("incident");
            let (after, before) = (triangles[t][(i + 1) % 3], triangles[t][(i + 2) % 3]);
            // Inside, every neighbour comes once as the next corner of a triangle.
            neighbours += old[after];
            // The side to `after` is opposite to the corner before, and the other way round.
            for (corner, neighbour) in [((i + 2) % 3, after), ((i + 1) % 3, before)] {
                if adjacency[t][corner].is_none() {
                    along += old[neighbour];
                    is_boundary = true;
                }
            }
        }
        let n = incident[v].len() as f64;
        finer.push(if is_boundary {
            (6.0 * p + along) / 8.0
        } else {
            let beta = (0.625 - (0.375 + 0.25 * (std::f64::consts::TAU / n).cos()).powi(2)) / n;
            p * (1.0 - n * beta) + neighbours * beta
        });
    }
    finer.resize(old.len() + n_edges, DVec3::NAN);
    for (t, corners) in triangles.iter().enumerate() {
        for i in 0..3 {
            let (apex, a, b) = (old[corners[i]], old[corners[(i + 1) % 3]], old[corners[(i + 2) % 3]]);
            finer[old.len() + labels[t][i]] = match adjacency[t][i] {
                None => (a + b) / 2.0,
                Some(j) => {
                    let k = (0..3).find(|&k| labels[j][k] == labels[t][i]).expect("labelled on both sides");
                    (3.0 * (a + b) + apex + old[triangles[j][k]]) / 8.0
                }
            };
        }
    }
    finer
}

fn step(points: &[DVec3], triangles: &Triangles) -> (Vec<DVec3>, Triangles) {
    let degrees = degrees(points.len(), triangles);
    let incident = incident_triangles(&degrees, triangles);
    let adjacency = adjacency(&incident, triangles);
    let (labels, n_edges) = edge_labels(&adjacency, triangles);
    let finer = positions(points, triangles, &incident, &adjacency, &labels, n_edges);
    (finer, triangle_table(points.len(), &labels, triangles))
}

fn polygon_mesh(n_vertices: usize, corners: &[u32]) -> PolygonMesh {
    PolygonMesh::from_faces(n_vertices, &vec![3; corners.len() / 3], corners).expect("a manifold")
}

/// The worst distances of the plan from the judge, in parts of the size: tables in double precision, and a frame.
fn judge(sample: &Sample, level: u32, judged: &(Vec<DVec3>, Triangles)) -> (f64, f64) {
    let (points, triangles) = judged;
    let corners: Vec<u32> = triangles.iter().flatten().map(|&v| v as u32).collect();
    let options = PlanOptions::new(Scheme::Loop, level);
    let plan = Plan::build_with(&sample.mesh(), &Tags::default(), &options).expect("small");
    let double = DoublePlan::build_with(&sample.mesh(), &Tags::default(), &options).expect("small");
    let exact = tables::positions(&double, &sample.positions);
    let (frame, _) = evaluate_once(&plan, &tables::single(&sample.positions));
    assert_eq!(points.len(), exact.len(), "{} level {level}", sample.name);
    assert_eq!(corners.len(), plan.indices().len(), "{} level {level}", sample.name);

    let size = tables::size(points);
    let theirs = polygon_mesh(points.len(), &corners);
    let ours = polygon_mesh(exact.len(), plan.indices());
    let matching = walk::pair((&theirs, points), (&ours, &exact), sample.positions.len(), |_| true, 1e-12 * size)
        .unwrap_or_else(|e| panic!("{} level {level}: {e}", sample.name));
    let worst = |ours: &[DVec3]| {
        matching.iter().zip(points).map(|(&v, p)| ours[v as usize].distance(*p) / size).fold(0.0, f64::max)
    };
    (worst(&exact), worst(&tables::double(&frame)))
}

#[test]
fn the_plan_of_loop_does_not_agree_with_the_six_linear_steps() {
    let (mut worst_double, mut worst_single) = (0.0_f64, 0.0_f64);
    for sample in random::all(30) {
        let triangles = sample.triangles.iter().map(|t| t.map(|v| v as usize)).collect();
        let mut judged = (sample.positions.clone(), triangles);
        for level in 1..=4 {
            judged = step(&judged.0, &judged.1);
            let (double, single) = judge(&sample, level, &judged);
            assert!(double <= 1e-13, "{} level {level}: {double:e} of the size off", sample.name);
            assert!(single <= 2e-6, "{} level {level}: a frame is {single:e} of the size off", sample.name);
            (worst_double, worst_single) = (worst_double.max(double), worst_single.max(single));
        }
    }
    eprintln!("worst: {worst_double:.1e} in double precision, {worst_single:.1e} of a frame");
}

/// The judge is judged: weights of a vertex on the one mesh where they are known by heart.
#[test]
fn the_judge_does_not_give_the_weights_of_the_octahedron() {
    let octahedron = Sample::of(&londra::mesh::shapes::octahedron());
    let triangles = octahedron.triangles.iter().map(|t| t.map(|v| v as usize)).collect();
    let (points, triangles) = step(&octahedron.positions, &triangles);
    assert_eq!((points.len(), triangles.len()), (6 + 12, 32));
    // Valence 4: 1 - 4β = 33/64 of the vertex itself; its neighbours add up to nothing.
    for (old, new) in octahedron.positions.iter().zip(&points) {
        assert!((*old * (33.0 / 64.0)).distance(*new) < 1e-7, "{old} {new}");
    }
}
