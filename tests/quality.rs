//! What every head promises whose measures are a breed's, a blend's, a random dog's, or at an end of a range: triangles
//! that are none of them degenerate, thin, folded or through each other, eyes behind their lids, lips and lids that meet.
//!
//! What is known to be wrong stands in `tests/faults`, by setting and place; anything else fails. `LONDRA_SWEEP=all` takes
//! all settings in place of a sample, and counts settings by fault. `UPDATE_FAULTS=1` writes the files of what is run anew,
//! `--nocapture` prints what was found.
#![cfg(feature = "head")]

#[path = "support/crossings.rs"]
mod crossings;
#[path = "support/faults.rs"]
mod faults;
#[allow(dead_code, reason = "of the support, only volume and rays are asked for")]
#[path = "support/geometry.rs"]
mod geometry;
#[path = "support/settings.rs"]
mod settings;

use faults::{Faults, Known};
use geometry::{Shape, hit};
use glam::{DVec3, Vec3};
use londra::anatomy::{Breed, Locks, Region, Space};
use londra::frame::skin_tags;
use londra::math::rng::Rng;
use londra::measure::MAY_FOLD;
use londra::mesh::{DedgeMesh, shapes};
use londra::motion::{Channel, Pose};
use londra::rig::deform::{ROUNDS, orbit_axes};
use londra::rig::{Deformed, Eye};
use londra::subdiv::{Evaluator, Plan, PlanOptions, Scheme};
use settings::{SPANNING, Setting, World, sweeps_all};
use std::collections::BTreeMap;

/// Smallest angle of a triangle at level 3, degrees.
const LEAST_ANGLE: f64 = 5.0;
/// Regions in which triangles may be thinner: what lies out of sight, and the leather of the ears, whose rim is as thin as
/// an ear's and as long.
const MAY_BE_THIN: &[Region] = &[Region::Mouth, Region::Nostril, Region::EarOuter, Region::EarInner, Region::EarEdge];
/// Least area of a control triangle, and of one at level 3, square millimetres at a skull of 200 mm.
const LEAST_AREA: [f64; 2] = [0.4, 0.001];
/// Sharpest fold, degrees.
const FOLDED: f64 = 170.0;

/// The skin at one level, with what never changes.
struct Level {
    plan: Plan,
    evaluator: Evaluator,
    /// The two faces of each edge that belongs to a left face.
    edges: Vec<[u32; 2]>,
    /// Region of each face.
    regions: Vec<Region>,
    /// Whether a face may be folded flat.
    may_fold: Vec<bool>,
}

impl Level {
    fn new(world: &World, level: u32) -> Self {
        let (mesh, half) = (world.rig.mesh(), world.rig.half());
        let options = PlanOptions::new(Scheme::Sqrt3, level);
        let plan = Plan::build_with(mesh, &skin_tags(&world.rig), &options).unwrap_or_else(|e| panic!("{e}"));
        let faces = plan.indices().as_chunks::<3>().0;
        let fine = DedgeMesh::from_triangles(plan.n_vertices(), faces).unwrap_or_else(|e| panic!("{e}"));
        let whole = half.whole_regions();
        let parents = plan.face_parent();
        let corners = |face: u32| &mesh.indices()[3 * face as usize..3 * face as usize + 3];
        let n_left = half.faces.len() as u32;
        let edges = fine.dedges().filter_map(|d| {
            let [f, g] = [fine.face(d).0, fine.face(fine.twin(d)?).0];
            (f < g && (parents[f as usize] < n_left || parents[g as usize] < n_left)).then_some([f, g])
        });
        let edges = edges.collect();
        let named: Vec<bool> = half.tags.iter().map(|t| MAY_FOLD.iter().any(|name| t.starts_with(name))).collect();
        let images = half.mirror();
        let mut free = vec![false; mesh.n_vertices()];
        for (v, _) in named.iter().enumerate().filter(|(_, is)| **is) {
            free[v] = true;
            free[images[v] as usize] = true;
        }
        Self {
            evaluator: Evaluator::new(&plan),
            edges,
            regions: parents.iter().map(|&p| whole[corners(p)[0] as usize]).collect(),
            may_fold: parents.iter().map(|&p| corners(p).iter().any(|&v| free[v as usize])).collect(),
            plan,
        }
    }

    /// Whether a face lies on the left side.
    fn is_left(&self, world: &World, face: usize) -> bool {
        (self.plan.face_parent()[face] as usize) < world.rig.half().faces.len()
    }

    fn between(&self, f: usize, g: usize) -> String {
        let [a, b] = [f, g].map(|f| self.regions[f].name());
        if a == b { a.to_owned() } else { format!("{}/{}", a.min(b), a.max(b)) }
    }
}

/// Everything that is asked of one head.
struct Checker<'a> {
    world: &'a World,
    /// Levels 0, 2 and 3.
    levels: [Level; 3],
    neck: Vec<Vec<u32>>,
    head: Deformed,
    found: BTreeMap<String, Faults>,
    /// Smallest angle found in each region, and in which setting.
    thinnest: BTreeMap<Region, (f64, String)>,
    /// How far the lower lip's margin reaches above the upper's, least and most, mm at 200, and in which settings.
    overlap: [(f64, String); 2],
}

fn normal([a, b, c]: [DVec3; 3]) -> DVec3 {
    (b - a).cross(c - a).normalize_or_zero()
}

/// The smallest angle of a triangle, degrees.
fn smallest_angle(t: [DVec3; 3]) -> f64 {
    let twice_area = (t[1] - t[0]).cross(t[2] - t[0]).length();
    let at = |k: usize| twice_area.atan2((t[(k + 1) % 3] - t[k]).dot(t[(k + 2) % 3] - t[k]));
    at(0).min(at(1)).min(at(2)).to_degrees()
}

fn triangles(positions: &[Vec3], indices: &[u32]) -> Vec<[DVec3; 3]> {
    indices.as_chunks::<3>().0.iter().map(|t| t.map(|v| positions[v as usize].as_dvec3())).collect()
}

impl<'a> Checker<'a> {
    fn new(world: &'a World) -> Self {
        let neck = world.rig.mesh().boundary_loops();
        Self {
            levels: [0, 2, 3].map(|level| Level::new(world, level)),
            neck: neck.iter().map(|l| l.iter().map(|v| v.0).collect()).collect(),
            head: Deformed::default(),
            found: BTreeMap::new(),
            thinnest: BTreeMap::new(),
            overlap: [(f64::INFINITY, String::new()), (f64::NEG_INFINITY, String::new())],
            world,
        }
    }

    fn check(&mut self, setting: &Setting) {
        let world = self.world;
        world.rig.deform(&setting.values, ROUNDS, &mut self.head);
        let scale = 200.0 / f64::from(world.skull_length(&setting.values));
        let mut faults = Faults::new();
        let mut add = |what: String| *faults.entry(what).or_default() += 1;
        if !self.head.control.iter().all(|p| p.is_finite()) {
            add("not finite".to_owned());
        }
        for (level, least) in [(0, LEAST_AREA[0]), (2, LEAST_AREA[1])] {
            let name = [0, 2, 3][level];
            let Level { plan, evaluator, edges, regions, may_fold, .. } = &mut self.levels[level];
            let skin = evaluator.evaluate(plan, &self.head.control);
            let all = triangles(skin.positions, skin.indices);
            let normals: Vec<DVec3> = all.iter().map(|&t| normal(t)).collect();
            for (f, &t) in
                all.iter().enumerate().filter(|(f, _)| plan.face_parent()[*f] < world.rig.half().faces.len() as u32)
            {
                let area = 0.5 * (t[1] - t[0]).cross(t[2] - t[0]).length() * scale * scale;
                if area < least {
                    add(format!("degenerate at {name} {}", regions[f].name()));
                }
                if level == 2 {
                    let angle = smallest_angle(t);
                    let worst = self.thinnest.entry(regions[f]).or_insert((f64::INFINITY, String::new()));
                    if angle < worst.0 {
                        *worst = (angle, setting.name.clone());
                    }
                    if angle < LEAST_ANGLE && !MAY_BE_THIN.contains(&regions[f]) {
                        add(format!("thin {}", regions[f].name()));
                    }
                }
            }
            for &[f, g] in edges.iter() {
                let [f, g] = [f as usize, g as usize];
                if normals[f].dot(normals[g]) < FOLDED.to_radians().cos() && !may_fold[f] && !may_fold[g] {
                    add(format!("fold at {name} {}", regions[f].name()));
                }
            }
        }
        let control = Shape { positions: &self.head.control, indices: world.rig.mesh().indices() };
        if control.volume(&self.neck) * scale.powi(3) * 1e-6 < 0.8 {
            add("volume".to_owned());
        }
        let middle = &mut self.levels[1];
        let skin = middle.evaluator.evaluate(&middle.plan, &self.head.control);
        let (positions, indices) = (skin.positions.to_vec(), skin.indices.to_vec());
        let middle = &self.levels[1];
        // Of a symmetric head, what crosses on the left or the median plane.
        for [f, g] in crossings::crossings(&positions, &indices, |f| middle.is_left(world, f)) {
            add(format!("crossing {}", middle.between(f, g)));
        }
        let all = triangles(&positions, &indices);
        let (seen, overlap) = self.lips(&positions, &all, scale);
        seen.into_iter().for_each(|k| add(format!("mouth seen behind s.{k}.9")));
        for (k, overlap) in overlap.into_iter().enumerate() {
            let worst = &mut self.overlap[k];
            if (k == 0 && overlap < worst.0) || (k == 1 && overlap > worst.0) {
                *worst = (overlap, setting.name.clone());
            }
        }

        world.rig.pose(&setting.values, &Pose::default().with(Channel::LidClosed, 1.0), &mut self.head);
        let shape = world.rig.proportions(&setting.values);
        let axes = orbit_axes(&shape).map(|axis| shape.direction(axis).as_dvec3());
        let middle = &mut self.levels[1];
        let skin = middle.evaluator.evaluate(&middle.plan, &self.head.control);
        let near = triangles(skin.positions, skin.indices);
        let bare = ball_seen(&self.head.eyes[0], axes, &near);
        (0..bare).for_each(|_| add("eyeball seen through shut lids".to_owned()));
        println!("{}: {}", setting.name, faults.iter().map(|(w, n)| format!("{w} {n}")).collect::<Vec<_>>().join(", "));
        self.found.insert(setting.name.clone(), faults);
    }

    /// On how many of the sight lines that come straight at the line of the lips the mouth's lining is seen, and how far
    /// the lower lip's margin reaches above the upper's, least and most, mm at 200.
    fn lips(&self, positions: &[Vec3], all: &[[DVec3; 3]], scale: f64) -> (Vec<usize>, [f64; 2]) {
        let handles = self.world.rig.plan().handles();
        let mm = 1.0 / scale;
        let at = |v: u16| positions[usize::from(v)].as_dvec3();
        let upper: Vec<DVec3> = (3..=10).map(|i| at(handles.s[i][9])).collect();
        let lower: Vec<DVec3> = (3..10).map(|i| at(handles.l[i][9])).collect();
        let rises = lower.iter().zip(&upper).map(|(l, u)| (l.y - u.y) * scale);
        let overlap = rises.fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], r| [lo.min(r), hi.max(r)]);
        let back = upper[7].z - 10.0 * mm;
        let front: Vec<usize> = (0..all.len())
            .filter(|&f| all[f].iter().any(|p| p.z > back && p.x > -2.0 * mm))
            .filter(|&f| all[f].iter().any(|p| p.y < upper[0].y.max(upper[7].y) + 12.0 * mm))
            .collect();
        let mut seen = Vec::new();
        for k in 0..7 {
            for part in 0..3 {
                let t = f64::from(part) / 3.0;
                let margin = upper[k].lerp(upper[k + 1], t);
                let along = upper[k + 1] - upper[k];
                let out = DVec3::new(-along.z, 0.0, along.x).normalize_or(DVec3::Z);
                let out = if k == 0 && part == 0 { DVec3::Z } else { out };
                for step in 0..14 {
                    let from = margin - DVec3::Y * (f64::from(step) * 0.5 - 1.0) * mm + out * 60.0 * mm;
                    let first = front
                        .iter()
                        .filter_map(|&f| hit(from, -out, all[f]).filter(|d| *d > 0.0).map(|d| (d, f)))
                        .fold((f64::INFINITY, None), |best, (d, f)| if d < best.0 { (d, Some(f)) } else { best });
                    if first.1.is_some_and(|f| self.levels[1].regions[f] == Region::Mouth) {
                        seen.push(3 + k);
                    }
                }
            }
        }
        (seen, overlap)
    }
}

/// In how many directions out of the eye's middle the ball lies bare; `axes`: the orbit's.
fn ball_seen(eye: &Eye, [a, b, g]: [DVec3; 3], skin: &[[DVec3; 3]]) -> usize {
    let (centre, r) = (eye.centre.as_dvec3(), f64::from(eye.radius));
    let near: Vec<[DVec3; 3]> =
        skin.iter().copied().filter(|t| t.iter().any(|p| (*p - centre).dot(g) > 0.4 * p.distance(centre))).collect();
    let mut bare = 0;
    for across in -12..=12 {
        for up in -14..=14 {
            let (x, y) = (f64::from(across) * 0.07, f64::from(up) * 0.06);
            if x * x + y * y > 0.6 || y.abs() > 0.6 {
                continue;
            }
            let out = a * x + b * y + g * (1.0 - x * x - y * y).max(0.0).sqrt();
            let skin_at = near.iter().filter_map(|&t| hit(centre, out, t)).fold(0.0, f64::max);
            bare += usize::from(skin_at < f64::from(eye.reach(out.as_vec3())) - 0.002 * r);
        }
    }
    bare
}

fn sweep(name: &str, world: &World, settings: impl IntoIterator<Item = Setting>) {
    let start = std::time::Instant::now();
    let mut checker = Checker::new(world);
    settings.into_iter().for_each(|s| checker.check(&s));
    println!("{name}: {} heads in {:.1} s", checker.found.len(), start.elapsed().as_secs_f64());
    for (region, (angle, setting)) in &checker.thinnest {
        println!("  smallest angle of {}: {angle:.1}°, {setting}", region.name());
    }
    let [least, most] = &checker.overlap;
    println!("  lips overlap by {:.1} mm ({}) to {:.1} mm ({})", least.0, least.1, most.0, most.1);
    if !sweeps_all() {
        return Known::of(name).check(checker.found);
    }
    let mut settings = Faults::new();
    for what in checker.found.values().flat_map(Faults::keys) {
        *settings.entry(what.clone()).or_default() += 1;
    }
    let n = checker.found.len();
    let faulty = checker.found.values().filter(|f| !f.is_empty()).count();
    println!("{name}: {faulty} of {n} settings have a fault");
    Known::of(&format!("{name}_all")).check([(format!("{n} settings"), settings)].into());
}

#[test]
fn a_breed_has_a_fault_that_nobody_knows() {
    let world = World::embedded();
    let own = world.breeds.iter().map(|b| Setting { name: b.id.clone(), values: b.values.clone() });
    sweep("breeds", &world, own);
}

#[test]
fn a_blend_has_a_fault_that_nobody_knows() {
    let world = World::embedded();
    let spans = |b: &Breed| SPANNING.contains(&b.id.as_str());
    let blends = world.pairs().into_iter().flat_map(|[a, b]| {
        let weights: &[f32] = if sweeps_all() || spans(a) && spans(b) { &[0.25, 0.5, 0.75] } else { &[0.5] };
        weights.iter().map(move |&weight| (a, b, weight))
    });
    let blends = blends.map(|(a, b, weight)| Setting {
        name: format!("{} + {} {weight}", a.id, b.id),
        values: Breed::blend(&world.table, &[(a, 1.0 - weight), (b, weight)]).values,
    });
    sweep("blends", &world, blends);
}

fn space(world: &World) -> Space {
    Space::new(&world.table, &world.breeds).unwrap_or_else(|e| panic!("{e}"))
}

#[test]
fn a_random_dog_has_a_fault_that_nobody_knows() {
    let world = World::embedded();
    let space = space(&world);
    let (base, locks) = (Breed::defaults(&world.table), Locks::none(&world.table));
    let dog = |seed: u64| Setting {
        name: format!("seed {seed}"),
        values: space.random(&world.table, &[], &base, &locks, &mut Rng::new(seed)).values,
    };
    sweep("random", &world, (0..if sweeps_all() { 1000 } else { 20 }).map(dog));
}

#[test]
fn a_measure_at_its_end_has_a_fault_that_nobody_knows() {
    let world = World::embedded();
    let mixed = Breed { id: "mixed".to_owned(), ..space(&world).mean(&world.table) };
    let mut some = vec![&mixed];
    if sweeps_all() {
        some.extend(world.spanning());
    }
    sweep("ends", &world, some.into_iter().flat_map(|b| world.extremes(b)));
}

#[test]
fn a_lid_closes_on_one_side_alone_or_opens_on_the_way() {
    let world = World::embedded();
    let handles = world.rig.plan().handles();
    let images = world.rig.half().mirror();
    let bits = |at: &[Vec3]| at.iter().map(|p| p.to_array().map(f32::to_bits)).collect::<Vec<_>>();
    let n = world.rig.half().n_half();
    for breed in &world.breeds {
        let mut head = Deformed::default();
        world.rig.deform(&breed.values, ROUNDS, &mut head);
        let rest = head.control.clone();
        let mut pose = |left: f32, right: f32| {
            world.rig.pose(&breed.values, &Pose::default().with_sides(Channel::LidClosed, [left, right]), &mut head);
            head.control.clone()
        };
        assert_eq!(bits(&pose(0.0, 0.0)), bits(&rest), "{}: open lids move", breed.id);
        let both = pose(0.7, 0.7);
        for (v, &image) in images.iter().enumerate() {
            let (p, q) = (both[v], both[image as usize]);
            // Skin that is kept off bone goes what all around it lacks, summed in another order on the other side.
            assert!(p.distance(q * Vec3::new(-1.0, 1.0, 1.0)) < 1e-7, "{}: {p} and {q}", breed.id);
        }
        let [left, right] = [pose(0.7, 0.0), pose(0.0, 0.7)];
        assert_eq!(bits(&left[..n]), bits(&both[..n]), "{}: the left lids ask for the right ones", breed.id);
        assert_eq!(bits(&right[n..]), bits(&both[n..]), "{}: the right lids ask for the left ones", breed.id);
        assert_eq!(bits(&left[n..]), bits(&rest[n..]), "{}: the right lids go with the left ones", breed.id);
        assert_eq!(bits(&right[..n]), bits(&rest[..n]), "{}: the left lids go with the right ones", breed.id);
        let mut slit = |closed: f32| {
            let at = pose(closed, closed);
            at[usize::from(handles.er[3])].distance(at[usize::from(handles.er[9])])
        };
        let slits: Vec<f32> = (0..=8).map(|step| slit(step as f32 / 8.0)).collect();
        assert!(slits[..8].is_sorted_by(|a, b| a > b), "{}: {slits:?}", breed.id);
    }
}

#[test]
fn a_crossing_is_missed_or_invented() {
    // Two triangles through each other, apart, with a corner in common, and with a side in common.
    let at = |points: &[[f32; 3]]| points.iter().map(|&p| Vec3::from(p)).collect::<Vec<_>>();
    let base = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
    let through = at(&[base[0], base[1], base[2], [1.0, 1.0, -1.0], [1.0, 1.0, 1.0], [9.0, 9.0, 1.0]]);
    assert_eq!(crossings::crossings(&through, &[0, 1, 2, 3, 4, 5], |_| true), [[0, 1]]);
    let above = at(&[base[0], base[1], base[2], [1.0, 1.0, 0.5], [1.0, 1.0, 1.0], [9.0, 9.0, 1.0]]);
    assert!(crossings::crossings(&above, &[0, 1, 2, 3, 4, 5], |_| true).is_empty());
    let corner = at(&[base[0], base[1], base[2], [2.0, 1.0, -1.0], [1.0, 2.0, 1.0], [-3.0, -1.0, 1.0]]);
    assert_eq!(crossings::crossings(&corner, &[0, 1, 2, 0, 3, 4], |_| true), [[0, 1]]);
    assert!(crossings::crossings(&corner, &[0, 1, 2, 0, 4, 5], |_| true).is_empty());
    for shape in shapes::cabinet() {
        let indices: Vec<u32> = shape.triangles.iter().flatten().copied().collect();
        let found = crossings::crossings(&shape.positions, &indices, |_| true);
        assert!(found.is_empty(), "{}: {found:?}", shape.name);
    }
}
