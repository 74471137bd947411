//! Limit positions and normals: against the next level, against deep levels, and where they end.

#[path = "support/random.rs"]
mod random;
#[path = "support/tables.rs"]
mod tables;

use glam::DVec3;
use londra::math::rng::Rng;
use londra::mesh::shapes::{disk, fan, pole};
use londra::mesh::{DedgeMesh, VertexId};
use londra::subdiv::{
    BoundaryRule, BoundaryStep, DoublePlan, INFINITE_SHARPNESS, LimitTable, LoopWeights, PlanOptions, Scheme, Tags,
    levels_of,
};
use random::Sample;

/// The schemes with limits, as options of level 0.
fn schemes() -> Vec<PlanOptions> {
    let plain = |scheme| PlanOptions::new(scheme, 0);
    vec![
        plain(Scheme::Sqrt3),
        plain(Scheme::Loop),
        PlanOptions { loop_weights: LoopWeights::Warren, ..plain(Scheme::Loop) },
        PlanOptions { boundary: BoundaryRule::EdgeAndCorner, ..plain(Scheme::Sqrt3) },
        PlanOptions { boundary: BoundaryRule::EdgeAndCorner, ..plain(Scheme::Loop) },
    ]
}

/// Positions of a level, its limits and its unit normals.
struct At {
    positions: Vec<DVec3>,
    limits: Vec<DVec3>,
    normals: Vec<DVec3>,
    table: LimitTable<f64>,
}

impl At {
    /// Whether a vertex lies on a curve: its first tangent is the difference of two neighbours.
    fn is_on_curve(&self, vertex: usize) -> bool {
        self.table.row(vertex).1.iter().filter(|w| w[1] != 0.0).count() == 2
    }
}

fn at(mesh: &DedgeMesh, control: &[DVec3], tags: &Tags, options: &PlanOptions, levels: u32) -> At {
    let options = PlanOptions { levels, ..*options };
    let plan = DoublePlan::build_with(mesh, tags, &options).expect("small");
    let positions = tables::positions(&plan, control);
    let table = plan.limit.expect("it has limits");
    let (limits, normals) = tables::limits(&table, &positions);
    At { positions, limits, normals, table }
}

/// Creases and corners that are sharp for ever.
fn sharp(mesh: &DedgeMesh, seed: u64) -> Tags {
    let mut tags = random::creases(mesh, seed);
    tags.creases.iter_mut().for_each(|crease| crease.2 = INFINITE_SHARPNESS);
    tags.corners.iter_mut().for_each(|corner| corner.1 = INFINITE_SHARPNESS);
    tags
}

/// The rule of each control vertex: number of sharp edges, or many for a corner.
fn sharp_edges(mesh: &DedgeMesh, tags: &Tags, options: &PlanOptions) -> Vec<usize> {
    let is_sharp = |a: VertexId, b: VertexId| {
        tags.creases.iter().any(|&(c, d, _)| (a, b) == (c, d) || (a, b) == (d, c))
            || mesh.outgoing_dedges(a).any(|d| mesh.target(d) == b && mesh.is_boundary_dedge(d))
            || mesh.outgoing_dedges(b).any(|d| mesh.target(d) == a && mesh.is_boundary_dedge(d))
    };
    let of = |v: VertexId| {
        let is_corner = tags.corners.iter().any(|corner| corner.0 == v)
            || (options.boundary == BoundaryRule::EdgeAndCorner
                && mesh.is_boundary_vertex(v)
                && mesh.faces_around(v).count() == 1);
        if is_corner { 9 } else { mesh.ring(v).filter(|&w| is_sharp(v, w)).count() }
    };
    mesh.vertices().map(of).collect()
}

/// Darts apart, which are taken as smooth and go elsewhere, and what has one as a neighbour on its curve; and normals of
/// corners, which have none in general, and of creases, which have one on each side (see below).
#[test]
fn a_limit_differs_from_that_of_the_next_level() {
    let mut compared = 0;
    for (k, sample) in random::all(16).iter().enumerate() {
        let mesh = sample.mesh();
        let size = tables::size(&sample.positions);
        for tags in [Tags::default(), sharp(&mesh, k as u64), random::creases(&mesh, k as u64)] {
            let fades = tags.creases.iter().any(|crease| crease.2 < INFINITE_SHARPNESS)
                || tags.corners.iter().any(|corner| corner.1 < INFINITE_SHARPNESS);
            for options in schemes() {
                let rules = sharp_edges(&mesh, &tags, &options);
                let meshes = levels_of(&mesh, &tags, &PlanOptions { levels: 4, ..options }).expect("small");
                let mut before: Option<At> = None;
                for level in 0..=4 {
                    let here = at(&mesh, &sample.positions, &tags, &options, level);
                    if let Some(before) = before {
                        for v in 0..before.limits.len() {
                            let rule = rules.get(v).copied();
                            // Of what fades only the surroundings have their limit already.
                            if fades && rule != Some(0) {
                                continue;
                            }
                            let is_dart = |v: usize| rules.get(v) == Some(&1);
                            let mut ring = meshes[level as usize - 1].ring(VertexId(v as u32));
                            if is_dart(v) || (options.scheme == Scheme::Sqrt3 && ring.any(|w| is_dart(w.index()))) {
                                continue;
                            }
                            let what = || format!("{} {:?} {options:?} level {level} vertex {v}", sample.name, tags);
                            let off = before.limits[v].distance(here.limits[v]);
                            assert!(off <= 1e-12 * size, "{}: {off:e}", what());
                            compared += 1;
                            let is_crease = before.is_on_curve(v)
                                && !meshes[level as usize - 1].is_boundary_vertex(VertexId(v as u32));
                            let has_normal =
                                rule.is_none_or(|n| n <= 2) || mesh.faces_around(VertexId(v as u32)).count() == 1;
                            if has_normal && !is_crease && before.normals[v] != DVec3::ZERO {
                                let off = before.normals[v].distance(here.normals[v]);
                                assert!(off <= 1e-9, "{}: normal {off:e}", what());
                            }
                        }
                    }
                    before = Some(here);
                }
            }
        }
    }
    eprintln!("{compared} limits compared");
}

/// How fast the vertex itself nears its limit in one step, the ring being level with it.
fn rate(options: &PlanOptions, n: usize) -> f64 {
    match options.scheme {
        Scheme::Loop => 0.625 - londra::subdiv::loop_scheme::alpha(n, options.loop_weights),
        _ => 2.0 / 3.0 - londra::subdiv::sqrt3::alpha(n),
    }
}

fn jittered(shape: &londra::mesh::shapes::Shape, seed: u64) -> Sample {
    Sample::of(shape).jittered(&mut Rng::new(seed))
}

fn depth(options: &PlanOptions) -> u32 {
    if options.scheme == Scheme::Loop { 4 } else { 6 }
}

/// The area-weighted normal of the faces around a vertex, or of some of them.
fn face_normal(mesh: &DedgeMesh, points: &[DVec3], faces: impl Iterator<Item = londra::mesh::FaceId>) -> DVec3 {
    let normal = |face| {
        let [a, b, c] = mesh.corners(face).map(|v| points[v.index()]);
        (b - a).cross(c - a)
    };
    faces.map(normal).sum::<DVec3>().normalize()
}

/// Around one vertex the way to the limit is known in full: the ring's mean and the vertex span a space of two
/// dimensions, in which a step has the eigenvalues 1 and [`rate`].
#[test]
fn deep_subdivision_does_not_come_to_the_limit_position() {
    for options in schemes() {
        for n in 3..=12 {
            let sample = jittered(&pole(n), u64::from(n));
            let (mesh, tags) = (sample.mesh(), Tags::default());
            let control = at(&mesh, &sample.positions, &tags, &options, 0);
            for level in 1..=depth(&options) {
                let deep = at(&mesh, &sample.positions, &tags, &options, level);
                let rate = rate(&options, n as usize).powi(level as i32);
                let expected = control.limits[0] + (control.positions[0] - control.limits[0]) * rate;
                let off = deep.positions[0].distance(expected);
                assert!(off < 1e-13, "{options:?} valence {n} level {level}: {off:e}");
            }
        }
        // The curve of a boundary: eigenvalues 1 and 1/4 in a step of Loop, 1/9 in two of √3, of which the first keeps.
        for k in 2..=8 {
            let sample = jittered(&fan(k), u64::from(k));
            let (mesh, tags) = (sample.mesh(), Tags::default());
            let control = at(&mesh, &sample.positions, &tags, &options, 0);
            for level in 1..=depth(&options) {
                let deep = at(&mesh, &sample.positions, &tags, &options, level);
                let rate = if options.scheme == Scheme::Loop {
                    0.25_f64.powi(level as i32)
                } else {
                    9.0_f64.powi(-(level as i32 / 2))
                };
                let expected = control.limits[0] + (control.positions[0] - control.limits[0]) * rate;
                let off = deep.positions[0].distance(expected);
                assert!(off < 1e-13, "{options:?} boundary of {k} triangles, level {level}: {off:e}");
            }
        }
    }
}

#[test]
fn a_limit_normal_is_not_that_of_deep_faces() {
    // Single faces lie flat: the rule of corners says nothing new.
    for options in schemes().into_iter().filter(|options| options.boundary == BoundaryRule::EdgeOnly) {
        let shapes = (3..=12).flat_map(|n| [pole(n), disk(n)]).chain((1..=8).map(fan));
        for shape in shapes {
            let sample = jittered(&shape, 77);
            let (mesh, tags) = (sample.mesh(), Tags::default());
            let normal = at(&mesh, &sample.positions, &tags, &options, 0).normals[0];
            let angle = |level: u32| {
                let options = PlanOptions { levels: level, ..options };
                let deep = at(&mesh, &sample.positions, &tags, &options, level);
                let finest = levels_of(&mesh, &tags, &options).expect("small").pop().expect("level 0 at least");
                face_normal(&finest, &deep.positions, finest.faces_around(VertexId(0))).angle_between(normal)
            };
            let (first, last) = (angle(2), angle(depth(&options)));
            assert!(last < 0.02 && last <= first, "{options:?} {}: {first} at level 2, {last} deep", sample.name);
        }
    }
}

/// A crease through the middle of a disk, with `k` triangles on one side of it and `n - k` on the other.
fn creased_disk(n: u32, k: u32) -> (Sample, Tags) {
    let sample = jittered(&disk(n), u64::from(100 * n + k));
    let spoke = |i: u32| (VertexId(0), VertexId(1 + i), INFINITE_SHARPNESS);
    (sample, Tags { creases: vec![spoke(0), spoke(k)], ..Tags::default() })
}

/// Both normals of a vertex on a crease, from the masks and the ring alone: that of the side which the table takes, and
/// that of the other; each with the sides' directed edges.
fn side_normals(
    mesh: &DedgeMesh,
    here: &At,
    options: &PlanOptions,
    level: u32,
    vertex: VertexId,
) -> [(DVec3, Vec<usize>); 2] {
    let (sources, weights) = here.table.row(vertex.index());
    let along = |weight: f64| weights.iter().position(|w| w[1] == weight).map(|i| sources[i]).expect("on a curve");
    let ring: Vec<u32> = mesh.ring(vertex).map(|v| v.0).collect();
    let ends = [along(1.0), along(-1.0)].map(|end| ring.iter().position(|&v| v == end).expect("a neighbour"));
    [ends, [ends[1], ends[0]]].map(|[from, to]| {
        let k = (to + ring.len() - from) % ring.len();
        let mask = match options.scheme {
            Scheme::Loop => londra::subdiv::loop_scheme::across(k),
            _ => londra::subdiv::sqrt3::across(k, BoundaryStep::from_level(level)),
        };
        let side: Vec<usize> = (0..=k).map(|i| (from + i) % ring.len()).collect();
        let point = |i: usize| here.positions[ring[i] as usize];
        let across: DVec3 = side.iter().zip(&mask[1..]).map(|(&i, &w)| point(i) * w).sum();
        let normal = (point(from) - point(to)).cross(across + here.positions[vertex.index()] * mask[0]);
        (normal.normalize(), side[..k].to_vec())
    })
}

#[test]
fn a_side_of_a_crease_has_another_normal_at_the_next_level_or_deep_down() {
    for options in schemes().into_iter().filter(|options| options.boundary == BoundaryRule::EdgeOnly) {
        for n in [3, 4, 5, 6, 7, 8, 10, 12] {
            for k in 1..n {
                let (sample, tags) = creased_disk(n, k);
                let mesh = sample.mesh();
                let options = PlanOptions { levels: depth(&options), ..options };
                let meshes = levels_of(&mesh, &tags, &options).expect("small");
                let control = at(&mesh, &sample.positions, &tags, &options, 0);
                let sides = side_normals(&mesh, &control, &options, 0, VertexId(0));
                let name = format!("{options:?} crease between {k} and {} triangles", n - k);
                assert!(sides[0].0.distance(control.normals[0]) < 1e-12, "{name}: the table takes another side");
                for level in 1..=options.levels {
                    let finer = &meshes[level as usize];
                    let here = at(&mesh, &sample.positions, &tags, &options, level);
                    let mut found = side_normals(finer, &here, &options, level, VertexId(0));
                    assert!(found[0].0.distance(here.normals[0]) < 1e-12, "{name} level {level}");
                    if found[0].0.distance(sides[0].0) > found[0].0.distance(sides[1].0) {
                        found.reverse();
                    }
                    for (found, side) in found.iter().zip(&sides) {
                        let off = found.0.distance(side.0);
                        assert!(off < 1e-10, "{name} level {level}: {off:e}");
                        if level == options.levels {
                            let around: Vec<_> = finer.faces_around(VertexId(0)).collect();
                            let faces = found.1.iter().map(|&i| around[i]);
                            let angle = face_normal(finer, &here.positions, faces).angle_between(side.0);
                            assert!(angle < 0.3, "{name}: {angle} deep down");
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn a_corner_does_not_stay_or_has_another_limit() {
    for options in schemes() {
        for n in 3..=8 {
            let sample = jittered(&disk(n), u64::from(n));
            let mesh = sample.mesh();
            let spokes = (0..3).map(|i| (VertexId(0), VertexId(1 + i), INFINITE_SHARPNESS)).collect();
            let tagged = Tags { corners: vec![(VertexId(0), INFINITE_SHARPNESS)], ..Tags::default() };
            for tags in [tagged, Tags { creases: spokes, ..Tags::default() }] {
                for level in 0..=4 {
                    let here = at(&mesh, &sample.positions, &tags, &options, level);
                    assert_eq!(here.positions[0], sample.positions[0], "{options:?} {n} level {level}");
                    assert_eq!(here.limits[0], sample.positions[0], "{options:?} {n} level {level}");
                }
            }
        }
    }
}

#[test]
fn the_limit_of_a_flat_mesh_is_not_flat() {
    let (x, y) = (DVec3::new(0.6, 0.8, 0.1).normalize(), DVec3::new(-0.8, 0.59, 0.3));
    let up = x.cross(y).normalize();
    for (k, shape) in (3..=12).map(disk).chain((1..=8).map(fan)).chain([londra::mesh::shapes::grid(4, 3)]).enumerate() {
        let mut sample = Sample::of(&shape);
        let mut rng = Rng::new(k as u64);
        for p in &mut sample.positions {
            *p += DVec3::new(rng.unit_f64(), rng.unit_f64(), 0.0) * 0.1;
            *p = x * p.x + y * p.y + up * 7.0;
        }
        let mesh = sample.mesh();
        for tags in [Tags::default(), sharp(&mesh, k as u64)] {
            for options in schemes() {
                for level in 0..=3 {
                    let here = at(&mesh, &sample.positions, &tags, &options, level);
                    for (v, (p, n)) in here.limits.iter().zip(&here.normals).enumerate() {
                        let height = p.dot(up) - 7.0;
                        assert!(
                            height.abs() < 1e-13,
                            "{} {options:?} level {level} vertex {v}: {height:e}",
                            sample.name
                        );
                        // Two sharp edges in one line have no plane between them.
                        let off = if *n == DVec3::ZERO { 0.0 } else { n.cross(up).length() };
                        assert!(off < 1e-10, "{} {options:?} level {level} vertex {v}: {n}", sample.name);
                    }
                }
            }
        }
    }
}
