//! What the head promises: baked as committed, symmetric, a function of its measures, valid between all breeds, sliders
//! that do what they say, true sizes.
//!
//! Lengths are metres scaled to a skull of 200 mm where "mm at 200" stands. Large sweeps take a fixed sample;
//! `LONDRA_SWEEP=all` takes all. `--nocapture` prints what was measured.
#![cfg(feature = "head")]

#[path = "support/geometry.rs"]
mod geometry;
#[path = "support/known_breeds.rs"]
mod known_breeds;
#[path = "support/settings.rs"]
mod settings;

use geometry::{Shape, hit, outside};
use glam::{DVec3, Vec3};
use known_breeds::{is_class, live_ratio, reference};
use londra::anatomy::{Breed, Reference, Region, Status};
use londra::frame::skin_tags;
use londra::measure::MAY_FOLD;
use londra::rig::deform::ROUNDS;
use londra::rig::{Deformed, Eye, HalfMesh};
use londra::subdiv::{Evaluator, Plan, PlanOptions, Scheme};
use settings::{KNOWN_BREEDS, SPANNING, Setting, World, sweeps_all};
use std::collections::{BTreeMap, BTreeSet};

fn plan(world: &World, level: u32) -> Plan {
    let options = PlanOptions::new(Scheme::Sqrt3, level);
    Plan::build_with(world.rig.mesh(), &skin_tags(&world.rig), &options).unwrap_or_else(|e| panic!("{e}"))
}

fn deform(world: &World, values: &[f32], rounds: usize) -> Deformed {
    let mut out = Deformed::default();
    world.rig.deform(values, rounds, &mut out);
    out
}

fn bits(control: &[Vec3]) -> Vec<[u32; 3]> {
    control.iter().map(|p| p.to_array().map(f32::to_bits)).collect()
}

/// Millimetres at a skull of 200 mm, of one metre of this setting.
fn at_200(world: &World, values: &[f32]) -> f64 {
    200.0 / f64::from(world.skull_length(values))
}

/// A vertex of the whole control mesh by name; a prime marks the right side.
fn name(half: &HalfMesh, vertex: usize) -> String {
    match half.tags.get(vertex) {
        Some(tag) => tag.clone(),
        None => {
            let left = half.mirror().iter().position(|&m| m as usize == vertex);
            format!("{}'", left.map_or("?", |v| &half.tags[v]))
        }
    }
}

/// A vertex of the level-1 skin by name: of the control mesh, or by the control face in whose middle it stands.
fn name_at_1(world: &World, vertex: u32) -> String {
    let (half, mesh) = (world.rig.half(), world.rig.mesh());
    match (vertex as usize).checked_sub(mesh.n_vertices()) {
        None => name(half, vertex as usize),
        Some(face) => {
            let corners: Vec<String> =
                mesh.indices()[3 * face..3 * face + 3].iter().map(|&v| name(half, v as usize)).collect();
            format!("({})", corners.join(" "))
        }
    }
}

// ---- bake and topology ----

#[test]
fn baked_assets_are_stale() {
    for baked in londra::author::bake::all().unwrap_or_else(|e| panic!("{e}")) {
        let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(baked.path);
        let committed = std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
        let line = baked.text.lines().zip(committed.lines()).position(|(a, b)| a != b);
        let at = line.map_or("its end".to_owned(), |l| format!("line {}", l + 1));
        assert!(committed == baked.text, "{} differs from what is baked, from {at}: run `londra bake`", baked.path);
    }
}

#[test]
fn control_mesh_is_no_disk_with_one_neck() {
    let world = World::embedded();
    let mesh = world.rig.mesh();
    mesh.validate().unwrap_or_else(|e| panic!("{e}"));
    let loops: Vec<usize> = mesh.boundary_loops().iter().map(Vec::len).collect();
    assert_eq!(loops, [28], "one boundary, at the neck");
    assert_eq!(mesh.euler_characteristic(), 1, "a disk");
    assert!(mesh.n_vertices() <= 1200, "{} control vertices", mesh.n_vertices());
    assert_eq!(plan(&world, 4).boundary_loops().len(), 1);
}

#[test]
fn valences_are_irregular_where_nothing_asks_for_it() {
    let world = World::embedded();
    let (mesh, half) = (world.rig.mesh(), world.rig.half());
    let inner: Vec<_> = mesh.vertices().filter(|&v| !mesh.is_boundary_vertex(v)).collect();
    let regular = inner.iter().filter(|&&v| mesh.valence(v) == 6).count();
    let share = regular as f64 / inner.len() as f64;
    println!("{} inner vertices, {:.1} % of valence 6", inner.len(), 100.0 * share);
    assert!(share >= 0.84, "{share}");
    let mut low = BTreeSet::new();
    let mut high = BTreeSet::new();
    for &v in inner.iter().filter(|v| v.index() < half.n_half()) {
        match mesh.valence(v) {
            0..=4 => low.insert(half.tags[v.index()].as_str()),
            9.. => high.insert(half.tags[v.index()].as_str()),
            _ => false,
        };
    }
    // Ends of grids in the median plane, and in the closed mouth.
    let may_be_low =
        ["l.3.11", "l.3.14", "l.8.14", "ml.3.2", "ml.3.3", "ml.4.3", "mu.3.2", "mu.3.3", "mu.4.3", "s.0.9"];
    assert!(low.iter().all(|t| may_be_low.contains(t)), "valence 4 or less at {low:?}");
    assert!(inner.iter().all(|&v| mesh.valence(v) >= 4), "valence below 4");
    // Poles, the corner of the mouth, and where nose pad, philtrum and lips meet.
    let may_be_high = ["ep", "n.9", "np", "s.3.9", "s.10.9"];
    assert!(high.iter().all(|t| may_be_high.contains(t)), "valence 9 or more at {high:?}");
}

/// Vertices of the half without six neighbours (at the neck: four), by region: how many of each valence.
#[test]
fn there_are_more_extraordinary_vertices_than_told() {
    let world = World::embedded();
    let (mesh, half) = (world.rig.mesh(), world.rig.half());
    let mut by_region: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for v in mesh.vertices().take(half.n_half()) {
        let regular = if mesh.is_boundary_vertex(v) { 4 } else { 6 };
        let valence = mesh.ring(v).count();
        if valence != regular {
            let entry = format!("{} ({valence})", half.tags[v.index()]);
            by_region.entry(half.regions[v.index()].name()).or_default().push(entry);
        }
    }
    for (region, list) in &by_region {
        println!("{region}: {}", list.join(", "));
    }
    let n = |region: &str| by_region.get(region).map_or(0, Vec::len);
    // What bends most when a dog moves or a measure does: the corner of the mouth is one vertex, the leather has none but
    // its tip and its base.
    let total: usize = by_region.values().map(Vec::len).sum();
    println!("{} control vertices, {total} extraordinary in the half", mesh.n_vertices());
    assert!(mesh.n_vertices() <= 1200);
    assert!(total <= EXTRAORDINARY, "{total} extraordinary vertices in the half");
    assert!(
        n("upper_lip") + n("lower_lip") <= 12 && n("neck_front") + n("neck_side") + n("nape") <= 10,
        "{by_region:?}"
    );
}

const EXTRAORDINARY: usize = 76;

#[test]
fn a_named_loop_is_open_or_jumps() {
    let world = World::embedded();
    let (mesh, half) = (world.rig.mesh(), world.rig.half());
    let joined = |a: u16, b: u16| mesh.ring(londra::mesh::VertexId(a.into())).any(|v| v.0 == u32::from(b));
    let ends = |l: &[u16]| [l[0], l[l.len() - 1]];
    let mut half_open = Vec::new();
    for (name, l) in &half.loops {
        assert_eq!(l.iter().collect::<BTreeSet<_>>().len(), l.len(), "{name} visits a vertex twice");
        for pair in l.windows(2) {
            assert!(
                joined(pair[0], pair[1]),
                "{name}: {} and {}",
                half.tags[pair[0] as usize],
                half.tags[pair[1] as usize]
            );
        }
        let [first, last] = ends(l);
        let closed = l.len() > 2 && joined(last, first);
        let closed_by_mirror = half.midline[first as usize] && half.midline[last as usize];
        if !closed && !closed_by_mirror {
            half_open.push(name.as_str());
        }
    }
    // The lips close together: both run from the median plane to the corner of the mouth.
    assert_eq!(half_open, ["lower_lip", "upper_lip"]);
    let [upper, lower] = ["upper_lip", "lower_lip"].map(|n| ends(&half.loops[n]));
    assert_eq!(upper[1], lower[1], "the lips end in one corner");
    assert!(half.midline[upper[0] as usize] && half.midline[lower[0] as usize]);
    let wanted = [
        "ear_base",
        "lid_fold",
        "lid_inner",
        "lid_outer",
        "lower_lip",
        "neck",
        "nose_outline",
        "nostril",
        "orbit",
        "upper_lip",
    ];
    for name in wanted {
        assert!(half.loops.contains_key(name), "no loop {name}");
    }
}

#[test]
fn a_landmark_has_no_name_or_another_ones_place() {
    let world = World::embedded();
    let half = world.rig.half();
    let unique = |what: &str, all: Vec<String>| {
        let n = all.len();
        assert!(all.iter().all(|t| !t.is_empty()), "an empty {what}");
        assert_eq!(all.into_iter().collect::<BTreeSet<_>>().len(), n, "a {what} twice");
    };
    unique("landmark id", half.landmarks.iter().map(|l| l.0.clone()).collect());
    unique("landmark name", half.landmarks.iter().map(|l| l.1.clone()).collect());
    unique("landmark vertex", half.landmarks.iter().map(|l| l.2.to_string()).collect());
    unique("vertex name", half.tags.clone());
    let missing: Vec<_> = Region::ALL.into_iter().filter(|r| !half.regions.contains(r)).map(Region::name).collect();
    assert!(missing.is_empty(), "regions without a vertex: {missing:?}");
}

// ---- symmetry ----

#[test]
fn left_and_right_differ() {
    let world = World::embedded();
    let half = world.rig.half();
    let mirror = half.mirror();
    let fine = plan(&world, 3);
    let mut evaluator = Evaluator::new(&fine);
    let mut settings: Vec<Setting> = (0..4).map(|seed| world.mixed(seed, 0.15)).collect();
    settings.extend(world.breeds.iter().map(|b| Setting { name: b.id.clone(), values: b.values.clone() }));
    for setting in settings {
        let head = deform(&world, &setting.values, ROUNDS);
        for (v, &m) in mirror.iter().enumerate() {
            let (p, q) = (head.control[v], head.control[m as usize]);
            if half.midline[v] {
                assert_eq!(p.x, 0.0, "{} on the midline: {}", half.tags[v], setting.name);
            }
            let image = [-q.x, q.y, q.z].map(f32::to_bits);
            // The image of zero is minus zero.
            let same = p.x == -q.x && [p.y, p.z].map(f32::to_bits) == image[1..];
            assert!(same, "{}: {p} and {q}: {}", half.tags[v], setting.name);
        }
        let [left, right] = head.eyes;
        assert_eq!(left.centre * Vec3::new(-1.0, 1.0, 1.0), right.centre);
        let refined = evaluator.evaluate(&fine, &head.control).positions;
        let worst = worst_asymmetry(refined);
        assert!(worst <= 1e-6, "refined vertices {worst:.1e} of the size off their image: {}", setting.name);
    }
}

/// Largest distance of a vertex's mirror image from the nearest vertex, as a part of the size; infinite beyond 1e-5.
fn worst_asymmetry(positions: &[Vec3]) -> f64 {
    let size = positions.iter().map(|p| p.length()).fold(0.0, f32::max);
    let window = 1e-5 * size;
    let mut by_z: Vec<Vec3> = positions.to_vec();
    by_z.sort_by(|a, b| a.z.total_cmp(&b.z));
    let distance = |p: &Vec3| {
        let image = Vec3::new(-p.x, p.y, p.z);
        let from = by_z.partition_point(|q| q.z < p.z - window);
        let near = by_z[from..].iter().take_while(|q| q.z <= p.z + window).map(|q| q.distance(image));
        let nearest = near.fold(f32::INFINITY, f32::min);
        if nearest <= window { f64::from(nearest / size) } else { f64::INFINITY }
    };
    positions.iter().map(distance).fold(0.0, f64::max)
}

// ---- a function of its measures ----

struct Gap {
    rms: f64,
    worst: f64,
    vertex: usize,
}

/// Live head against the method run to convergence, mm at 200.
fn gap(world: &World, values: &[f32], live: &mut Deformed, converged: &mut Deformed) -> Gap {
    world.rig.deform(values, ROUNDS, live);
    world.rig.deform(values, 60, converged);
    let scale = at_200(world, values);
    let apart: Vec<f64> =
        live.control.iter().zip(&converged.control).map(|(a, b)| scale * a.as_dvec3().distance(b.as_dvec3())).collect();
    let rms = (apart.iter().map(|d| d * d).sum::<f64>() / apart.len() as f64).sqrt();
    let (vertex, worst) = apart.into_iter().enumerate().fold((0, 0.0), |w, d| if d.1 > w.1 { d } else { w });
    Gap { rms, worst, vertex }
}

/// What holds today, with a little reserve, mm at 200.
struct Bound {
    /// Root of the mean square over all vertices of all settings.
    together: f64,
    /// The same over the vertices of one setting.
    each: f64,
    /// So many settings in a thousand may lie beyond `each`.
    exceptions: usize,
}

/// Compares all settings, states the worst, and names those beyond the bound. The promise is half a millimetre rms for
/// each. Few random settings miss it: there single vertices start deep below a ridge of the surface and creep along it
/// for longer than the live rounds last.
fn assert_converged(world: &World, what: &str, bound: Bound, settings: impl Iterator<Item = Setting>) {
    let (mut live, mut converged) = (Deformed::default(), Deformed::default());
    let mut all: Vec<(Gap, String)> =
        settings.map(|s| (gap(world, &s.values, &mut live, &mut converged), s.name)).collect();
    all.sort_by(|a, b| b.0.rms.total_cmp(&a.0.rms));
    let half = world.rig.half();
    let line = |(gap, setting): &(Gap, String)| {
        format!("rms {:.3} mm, worst {:.2} mm at {}: {setting}", gap.rms, gap.worst, name(half, gap.vertex))
    };
    let median = all[all.len() / 2].0.rms;
    println!("{what}: {} settings, median rms {median:.3} mm; {}", all.len(), line(&all[0]));
    if let Some(worst) = all.iter().max_by(|a, b| a.0.worst.total_cmp(&b.0.worst)) {
        println!("{what}: worst vertex: {}", line(worst));
    }
    let pooled = (all.iter().map(|(gap, _)| gap.rms * gap.rms).sum::<f64>() / all.len() as f64).sqrt();
    println!("{what}: over all settings rms {pooled:.3} mm");
    let failed: Vec<String> = all.iter().take_while(|(gap, _)| gap.rms > bound.each).map(line).collect();
    println!("{what}: {} beyond {} mm rms", failed.len(), bound.each);
    assert!(pooled <= bound.together, "{what}: rms {pooled:.4} mm over all settings");
    assert!(
        failed.len() * 1000 <= bound.exceptions * all.len(),
        "{what}: {} of {} settings:\n{}",
        failed.len(),
        all.len(),
        failed.join("\n")
    );
}

fn seeds(first: u64, sample: u64, all: u64) -> impl Iterator<Item = u64> {
    first..first + if sweeps_all() { all } else { sample }
}

#[test]
fn a_breed_is_not_what_authoring_gives() {
    let world = World::embedded();
    let own = world.breeds.iter().map(|b| Setting { name: b.id.clone(), values: b.values.clone() });
    assert_converged(&world, "breeds", Bound { together: 0.002, each: 0.007, exceptions: 0 }, own);
}

#[test]
fn a_head_near_the_breeds_is_not_what_authoring_gives() {
    let world = World::embedded();
    let bound = Bound { together: 0.002, each: 0.01, exceptions: 0 };
    assert_converged(&world, "jitter 0.05", bound, seeds(0, 100, 2000).map(|s| world.mixed(s, 0.05)));
}

#[test]
fn a_random_head_is_not_what_authoring_gives() {
    let world = World::embedded();
    let bound = Bound { together: 0.05, each: 0.5, exceptions: 3 };
    assert_converged(&world, "jitter 0.15", bound, seeds(10_000, 200, 5000).map(|s| world.mixed(s, 0.15)));
}

/// What adding up one displacement for each slider would give instead: the reason why the fit itself runs live. Should
/// this ever come near the fitted heads, the fit could go.
#[test]
fn a_sum_of_sliders_would_do_as_well() {
    let world = World::embedded();
    let defaults = Breed::defaults(&world.table).values;
    let base = deform(&world, &defaults, ROUNDS);
    for breed in ["pug", "bulldog", "borzoi"] {
        let values = &world.breed(breed).values;
        let mut sum: Vec<DVec3> = base.control.iter().map(|p| p.as_dvec3()).collect();
        for row in 0..values.len() {
            let mut one = defaults.clone();
            one[row] = values[row];
            let moved = deform(&world, &one, ROUNDS);
            for (s, (m, b)) in sum.iter_mut().zip(moved.control.iter().zip(&base.control)) {
                *s += m.as_dvec3() - b.as_dvec3();
            }
        }
        let fitted = deform(&world, values, ROUNDS);
        let squares = sum.iter().zip(&fitted.control).map(|(s, f)| s.distance_squared(f.as_dvec3()));
        let rms = at_200(&world, values) * (squares.sum::<f64>() / sum.len() as f64).sqrt();
        println!("{breed}: a sum of sliders misses it by {rms:.1} mm rms");
        assert!(rms > 5.0, "{breed}: a sum of sliders misses it by {rms:.2} mm rms only");
    }
}

#[test]
fn a_wild_head_is_not_what_authoring_gives() {
    let world = World::embedded();
    let bound = Bound { together: 0.1, each: 0.5, exceptions: 8 };
    assert_converged(&world, "jitter 0.3", bound, seeds(20_000, 60, 2000).map(|s| world.mixed(s, 0.3)));
}

#[test]
fn a_slider_at_its_end_is_not_what_authoring_gives() {
    let world = World::embedded();
    let some =
        if sweeps_all() { world.breeds.iter().collect() } else { vec![world.breed("labrador"), world.breed("pug")] };
    // Two are known: the pug without flews, and with the shortest cranium.
    let bound = Bound { together: 0.06, each: 0.1, exceptions: 8 };
    assert_converged(&world, "ends", bound, some.into_iter().flat_map(|b| world.extremes(b)));
}

#[test]
fn the_way_to_a_setting_shows_in_the_head() {
    let world = World::embedded();
    let (from, to) = (world.breed("chihuahua"), world.breed("borzoi"));
    let rows: Vec<usize> = (0..world.table.specs.len()).collect();
    let mut ends = Vec::new();
    for backwards in [false, true] {
        let mut breed = from.clone();
        let mut buffers = Deformed::default();
        let order: Vec<usize> = if backwards { rows.iter().rev().copied().collect() } else { rows.clone() };
        for row in order {
            breed.set_value(&world.table, row, to.values[row]);
            world.rig.deform(&breed.values, ROUNDS, &mut buffers);
        }
        ends.push((bits(&buffers.control), buffers.eyes));
    }
    let fresh = deform(&world, &to.values, ROUNDS);
    assert!(ends[0] == ends[1], "two orders of the same slider moves end in other bits");
    assert!(ends[0] == (bits(&fresh.control), fresh.eyes), "used buffers give other bits than fresh ones");
    let mut twice = fresh.clone();
    world.rig.deform(&to.values, ROUNDS, &mut twice);
    assert!(bits(&twice.control) == bits(&fresh.control), "the same buffers a second time give other bits");
}

// ---- between all breeds ----

/// How far the ball stands out of the lids anywhere outside their outer margin, as a part of its radius (0: nowhere).
fn ball_through_lids(world: &World, eye: &Eye, skin: &[Vec3], indices: &[u32]) -> f64 {
    let centre = eye.centre.as_dvec3();
    let r = f64::from(eye.radius);
    let [a, b, g] = eye.axes.map(Vec3::as_dvec3);
    let margin: Vec<[f64; 2]> = world.rig.half().loops["lid_outer"]
        .iter()
        .map(|&v| skin[v as usize].as_dvec3() - centre)
        .map(|p| [p.dot(a) / r, p.dot(b) / r])
        .collect();
    let near: Vec<[DVec3; 3]> =
        indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]].map(|v| skin[v as usize].as_dvec3())).collect();
    let mut worst = 0.0_f64;
    for polar in (12..62).step_by(4) {
        let (sin, cos) = f64::from(polar).to_radians().sin_cos();
        for turn in 0..18 {
            let (s, c) = f64::from(turn * 20).to_radians().sin_cos();
            let (x, y) = (sin * c, sin * s);
            if outside(&margin, [x, y]) > 0.02 {
                let out = (a * x + b * y + g * cos) * r;
                let skin_at = near.iter().filter_map(|&t| hit(centre, out, t)).fold(0.0, f64::max);
                worst = worst.max(1.0 - skin_at);
            }
        }
    }
    worst
}

/// Distance of the lids' outer margin from the ball's centre, lowest and highest, as parts of the radius.
fn margin_reach(world: &World, eye: &Eye, skin: &[Vec3]) -> (f32, f32) {
    let margin = world.rig.half().loops["lid_outer"].iter();
    let reach = margin.map(|&v| skin[v as usize].distance(eye.centre) / eye.radius);
    reach.fold((f32::INFINITY, 0.0), |(lo, hi), r| (lo.min(r), hi.max(r)))
}

/// Edges that may fold flat: the corner of the closed mouth, the lining's end, and leather.
fn may_fold(name: &str) -> bool {
    let has = |start: &str| name.split([' ', '-', '(', ')']).any(|v| v.starts_with(start));
    MAY_FOLD.into_iter().any(has)
}

#[derive(Default)]
struct Faults(Vec<String>);

impl Faults {
    fn check(&mut self, holds: bool, what: impl FnOnce() -> String) {
        if !holds {
            self.0.push(what());
        }
    }
}

struct Checker<'a> {
    world: &'a World,
    skin: Plan,
    lids: Plan,
    evaluators: [Evaluator; 2],
    neck: Vec<Vec<u32>>,
}

impl<'a> Checker<'a> {
    fn new(world: &'a World) -> Self {
        let (skin, lids) = (plan(world, 1), plan(world, 2));
        let neck = world.rig.mesh().boundary_loops();
        Self {
            evaluators: [Evaluator::new(&skin), Evaluator::new(&lids)],
            neck: neck.iter().map(|l| l.iter().map(|v| v.0).collect()).collect(),
            world,
            skin,
            lids,
        }
    }

    fn check(&mut self, setting: &Setting, faults: &mut Faults) {
        let world = self.world;
        let head = deform(world, &setting.values, ROUNDS);
        let scale = at_200(world, &setting.values);
        let who = &setting.name;
        faults.check(head.control.iter().all(|p| p.is_finite()), || format!("{who}: a position is not finite"));
        let control = Shape { positions: &head.control, indices: world.rig.mesh().indices() };
        let (face, area) = control
            .areas()
            .map(|a| a * scale * scale)
            .enumerate()
            .fold((0, f64::INFINITY), |m, a| if a.1 < m.1 { a } else { m });
        let corner = |k: usize| name(world.rig.half(), world.rig.mesh().indices()[3 * face + k] as usize);
        faults.check(area > 0.4, || format!("{who}: {area:.4} mm² at {} {} {}", corner(0), corner(1), corner(2)));
        let litres = control.volume(&self.neck) * scale.powi(3) * 1e-6;
        faults.check(litres > 0.8, || format!("{who}: volume {litres:.2} l"));

        let refined = self.evaluators[0].evaluate(&self.skin, &head.control);
        let skin = Shape { positions: refined.positions, indices: refined.indices };
        let folds: Vec<String> = skin
            .folds()
            .into_iter()
            .filter(|f| f.1 > 170.0)
            .map(|([a, b], angle)| format!("{}-{} {angle:.0}°", name_at_1(world, a), name_at_1(world, b)))
            .filter(|f| !may_fold(f))
            .collect();
        faults.check(folds.is_empty(), || format!("{who}: folded: {}", folds.join(", ")));
        let (hidden, crossings): (Vec<_>, Vec<_>) =
            skin.crossings().into_iter().partition(|pair| pair.iter().any(|&f| self.is_hidden(f)));
        let ears = crossings.iter().filter(|pair| pair.iter().all(|&f| self.is_ear(f))).count();
        faults.check(crossings.len() - ears <= MOST_CROSSINGS && ears <= MOST_IN_EARS, || {
            format!("{who}: {} pairs of triangles cross in sight: {}", crossings.len(), self.where_crossed(&crossings))
        });
        faults.check(hidden.len() <= MOST_HIDDEN, || {
            format!("{who}: {} pairs cross in mouth and nostrils: {}", hidden.len(), self.where_crossed(&hidden))
        });

        let fine = self.evaluators[1].evaluate(&self.lids, &head.control);
        let through = ball_through_lids(world, &head.eyes[0], fine.positions, fine.indices);
        faults.check(through < 0.005, || format!("{who}: the eyeball stands {through:.2} radii out of its lids"));
        let (low, high) = margin_reach(world, &head.eyes[0], fine.positions);
        faults.check(low > 1.04 && high < 1.26, || format!("{who}: lid margin at {low:.2} to {high:.2} radii"));
        println!(
            "{who}: smallest area {area:.3} mm², volume {litres:.2} l, {} folds, {} crossings ({}), {} hidden, ball {through:.3}, lids {low:.3} to {high:.3}",
            folds.len(),
            crossings.len(),
            self.where_crossed(&crossings),
            hidden.len()
        );
    }

    /// Whether a face lies in the closed mouth, between the lips or in a nostril, where surfaces touch.
    fn is_hidden(&self, face: usize) -> bool {
        let regions = self.world.rig.half().whole_regions();
        let parent = 3 * self.skin.face_parent()[face] as usize;
        let corners = &self.world.rig.mesh().indices()[parent..parent + 3];
        let inside = [Region::Mouth, Region::UpperLip, Region::LowerLip, Region::Nostril];
        corners.iter().any(|&v| inside.contains(&regions[v as usize]))
    }

    fn is_ear(&self, face: usize) -> bool {
        let regions = self.world.rig.half().whole_regions();
        let first = self.world.rig.mesh().indices()[3 * self.skin.face_parent()[face] as usize];
        matches!(regions[first as usize], Region::EarOuter | Region::EarInner | Region::EarEdge)
    }

    /// How many pairs cross between which regions, most first.
    fn where_crossed(&self, pairs: &[[usize; 2]]) -> String {
        let regions = self.world.rig.half().whole_regions();
        let control = self.world.rig.mesh().indices();
        let region = |face: usize| regions[control[3 * self.skin.face_parent()[face] as usize] as usize].name();
        let mut count: BTreeMap<[&str; 2], usize> = BTreeMap::new();
        for &[f, g] in pairs {
            let (a, b) = (region(f), region(g));
            *count.entry([a.min(b), a.max(b)]).or_default() += 1;
        }
        let mut count: Vec<_> = count.into_iter().collect();
        count.sort_by_key(|c| std::cmp::Reverse(c.1));
        let words: Vec<String> = count.iter().take(5).map(|([a, b], n)| format!("{n} {a}/{b}")).collect();
        words.join(", ")
    }
}

/// Pairs of crossing triangles, of 5562 at level 1, that a head may have in sight. Most heads have none.
const MOST_CROSSINGS: usize = 22;
/// Leather that lies folded on itself at its root crosses itself there.
const MOST_IN_EARS: usize = 32;
/// And where lips, lining or nostrils lie on each other.
const MOST_HIDDEN: usize = 40;

#[test]
fn a_breed_is_no_valid_head() {
    let world = World::embedded();
    let (mut checker, mut faults) = (Checker::new(&world), Faults::default());
    for breed in &world.breeds {
        let setting = Setting { name: breed.id.clone(), values: breed.values.clone() };
        let mut found = Faults::default();
        checker.check(&setting, &mut found);
        match KNOWN_BREEDS.contains(&breed.id.as_str()) {
            true => faults
                .check(!found.0.is_empty(), || format!("{}: no fault any more, take it off KNOWN_BREEDS", breed.id)),
            false => faults.0.append(&mut found.0),
        }
    }
    assert!(faults.0.is_empty(), "{}", faults.0.join("\n"));
}

/// Blends of the sample that are known to be faulty, as they are: the hollow between bridge, stop and eye where one breed
/// is narrow, and the temple before a low ear. The large sweep meets more of both kinds.
const KNOWN_BLENDS: &[[&str; 2]] = &[
    ["german_shepherd", "bulldog"],
    ["german_shepherd", "dachshund"],
    ["borzoi", "beagle"],
    ["chihuahua", "beagle"],
    ["chihuahua", "borzoi"],
    ["dachshund", "borzoi"],
    ["pug", "borzoi"],
];

/// Blends in a hundred that the large sweep may find faulty.
const MOST_FAULTY: usize = 8;

#[test]
fn a_blend_of_two_breeds_is_no_valid_head() {
    let world = World::embedded();
    let (mut checker, mut faults) = (Checker::new(&world), Faults::default());
    let (mut heads, mut faulty) = (0, 0);
    for [a, b] in world.pairs() {
        // The first breeds come at three weights, the sample of the others in the middle.
        let spans = [a, b].iter().all(|x| SPANNING.contains(&x.id.as_str()));
        let weights: &[f32] = if spans || sweeps_all() { &[0.25, 0.5, 0.75] } else { &[0.5] };
        for &weight in weights {
            let values = Breed::blend(&world.table, &[(a, 1.0 - weight), (b, weight)]).values;
            let name = format!("{} + {} {weight}", a.id, b.id);
            let mut found = Faults::default();
            checker.check(&Setting { name, values }, &mut found);
            heads += 1;
            faulty += usize::from(!found.0.is_empty());
            match KNOWN_BLENDS.contains(&[a.id.as_str(), b.id.as_str()]) {
                // A fault may stand at one of the weights only.
                true if !spans => faults.check(!found.0.is_empty(), || {
                    format!("{} + {}: no fault any more, take it off KNOWN_BLENDS", a.id, b.id)
                }),
                true => {}
                // The large sweep counts what it finds beyond the breeds that span the others.
                false if sweeps_all() && !spans => {}
                false => faults.0.append(&mut found.0),
            }
        }
    }
    println!("{faulty} of {heads} blends are faulty");
    let most = if sweeps_all() { heads * MOST_FAULTY / 100 } else { 2 };
    faults.check(faulty <= most, || format!("{faulty} of {heads} blends are faulty, {most} were known"));
    assert!(faults.0.is_empty(), "{} faults:\n{}", faults.0.len(), faults.0.join("\n"));
}

// ---- sliders ----

/// The level-3 skin, asked for distances. Control vertices keep their numbers on every level.
struct Skin<'a> {
    world: &'a World,
    at: &'a [Vec3],
    head: &'a Deformed,
}

impl Skin<'_> {
    fn tag(&self, tag: &str) -> Vec3 {
        let v = self.world.rig.half().tags.iter().position(|t| t == tag);
        self.at[v.unwrap_or_else(|| panic!("no vertex {tag}"))]
    }

    fn apart(&self, a: &str, b: &str) -> f32 {
        self.tag(a).distance(self.tag(b))
    }

    /// Twice the largest x of the vertices whose name begins so.
    fn width(&self, starts: &[&str]) -> f32 {
        let tags = self.world.rig.half().tags.iter().enumerate();
        let these = tags.filter(|(_, t)| starts.iter().any(|s| t.starts_with(s)));
        2.0 * these.map(|(v, _)| self.at[v].x).fold(0.0, f32::max)
    }

    fn middle(&self, tags: impl Iterator<Item = String>) -> Vec3 {
        let all: Vec<Vec3> = tags.map(|t| self.tag(&t)).collect();
        all.iter().sum::<Vec3>() / all.len() as f32
    }

    fn loop_width(&self, name: &str) -> f32 {
        2.0 * self.world.rig.half().loops[name].iter().map(|&v| self.at[v as usize].x).fold(0.0, f32::max)
    }

    /// Along the middles of the ear's rings, from the base to the tip.
    fn ear_length(&self) -> f32 {
        let base = &self.world.rig.half().loops["ear_base"];
        let mut path = vec![base.iter().map(|&v| self.at[v as usize]).sum::<Vec3>() / base.len() as f32];
        path.extend((0..8).map(|r| self.middle((0..12).map(|k| format!("a{r}.{k}")))));
        path.push(self.middle((0..8).map(|k| format!("a8.{k}"))));
        path.windows(2).map(|w| w[0].distance(w[1])).sum()
    }

    /// The sharpest angle of the dorsal profile about the stop, on the side of the air.
    fn stop_angle(&self) -> f32 {
        let direction = |d: Vec3| d.y.atan2(d.z);
        let at = |i: usize| self.tag(&format!("s.{i}.0"));
        let angle = |i: usize| direction(at(i + 2) - at(i)) - direction(at(i - 2) - at(i));
        (5..=10).map(angle).fold(f32::INFINITY, |a, b| a.min(b.rem_euclid(std::f32::consts::TAU)))
    }
}

type Measure = fn(&Skin) -> f32;

/// Sliders whose own quantity can be measured on the skin.
const MEASURED: &[(&str, Measure)] = &[
    ("cranial_length_mm", |s| s.apart("s.8.0", "s.16.0")),
    ("cranial_width_mm", |s| s.width(&["s.12.", "s.13."])),
    ("temporalis_mm", |s| s.width(&["s.12.3", "s.12.4", "s.13."])),
    ("cranial_height_mm", |s| s.tag("s.13.0").y),
    ("zygomatic_width_mm", |s| s.width(&["s.10.", "s.11.", "s.12.", "s.13.", "s.14.", "l.11.", "l.12.", "l.13."])),
    ("facial_length_mm", |s| s.apart("s.8.0", "s.3.9")),
    ("stop_angle_deg", |s| s.stop_angle()),
    ("muzzle_width_root_mm", |s| s.width(&["s.6.", "s.7."])),
    ("muzzle_width_tip_mm", |s| s.width(&["s.3.", "s.4."])),
    ("muzzle_depth_root_mm", |s| s.tag("s.6.0").y - s.tag("s.8.9").y),
    ("muzzle_depth_tip_mm", |s| s.tag("s.2.0").y - s.tag("s.4.9").y),
    ("nose_width_mm", |s| s.loop_width("nose_outline")),
    ("nose_height_mm", |s| s.apart("s.0.0", "s.0.9")),
    ("nose_projection_mm", |s| s.tag("nm.0").z - s.tag("s.3.9").z),
    ("flews_mm", |s| s.tag("s.6.0").y - s.tag("s.6.9").y),
    ("jaw_depth_mm", |s| s.tag("s.6.9").y - s.tag("l.7.14").y),
    ("overjet_mm", |s| s.tag("s.3.9").z - s.tag("l.3.11").z),
    ("eye_spacing_mm", |s| s.tag("er.0").x + s.tag("er.6").x),
    ("eyeball_diameter_mm", |s| s.apart("er.0", "er.6")),
    ("lid_opening", |s| s.apart("er.3", "er.9")),
    ("lid_width", |s| s.apart("er.0", "er.6")),
    ("ear_length_mm", |s| s.ear_length()),
    ("ear_width_mm", |s| s.apart("a4.0", "a4.6")),
    ("ear_base_mm", |s| s.apart("s.13.2", "s.16.5")),
    ("ear_set_back_mm", |s| -s.middle((0..12).map(|k| format!("a0.{k}"))).z),
    ("neck_width_mm", |s| s.loop_width("neck")),
    ("neck_depth_mm", |s| s.apart("s.19.0", "l.19.14")),
];

/// Metres or radians by which a measure may fall where something else covers it (0.05 mm, 0.003 degrees).
const FLAT: f32 = 5e-5;
/// Faults that are known, as they are (breed, slider, metres or radians): so far these fall where the vertex that is widest
/// slides back from the widest place, and where the bridge of a short face stands as high as its forehead begins.
const KNOWN_FALLS: &[(&str, &str, f32)] = &[
    ("bulldog", "muzzle_width_root_mm", 3.5e-4),
    ("german_shepherd", "neck_depth_mm", 2.5e-4),
    ("pug", "stop_angle_deg", 0.04),
    ("pug", "muzzle_width_root_mm", 7e-4),
    ("borzoi", "stop_angle_deg", 9e-3),
    ("borzoi", "zygomatic_width_mm", 2.5e-4),
];

#[test]
fn a_measure_does_not_grow_with_its_slider() {
    const STEPS: usize = 16;
    let world = World::embedded();
    let fine = plan(&world, 3);
    let mut evaluator = Evaluator::new(&fine);
    let mut faults = Faults::default();
    let mut head = Deformed::default();
    let some: Vec<&Breed> = if sweeps_all() {
        world.breeds.iter().collect()
    } else {
        ["labrador", "pug", "borzoi"].map(|id| world.breed(id)).into()
    };
    for breed in some {
        for &(id, measure) in MEASURED {
            let row = world.row(id);
            let spec = &world.table.specs[row];
            let known = KNOWN_FALLS.iter().find(|k| (k.0, k.1) == (breed.id.as_str(), id));
            let flat = known.map_or(FLAT, |k| k.2);
            let mut last: Option<(f64, f32)> = None;
            let (mut first, mut falls) = (0.0, Vec::new());
            for step in 0..=STEPS {
                let value = spec.min + (spec.max - spec.min) * step as f64 / STEPS as f64;
                let mut values = breed.values.clone();
                values[row] = spec.to_si(value);
                world.rig.deform(&values, ROUNDS, &mut head);
                let at = evaluator.evaluate(&fine, &head.control).positions;
                let measured = measure(&Skin { world: &world, at, head: &head });
                match last {
                    None => first = measured,
                    Some((before, was)) if measured < was - flat => {
                        falls.push(format!("{before:.2}→{value:.2}: {was:.5}→{measured:.5}"));
                    }
                    Some(_) => {}
                }
                last = Some((value, measured));
            }
            let end = last.map_or(0.0, |l| l.1);
            faults.check(falls.is_empty(), || format!("{} {id}: {}", breed.id, falls.join(", ")));
            println!("{} {id}: {first:.5} to {end:.5}", breed.id);
            faults.check(end > first, || {
                format!("{} {id}: {first:.5} at the low end, {end:.5} at the high end", breed.id)
            });
        }
    }
    assert!(faults.0.is_empty(), "{} faults:\n{}", faults.0.len(), faults.0.join("\n"));
}

/// A thousandth of a slider's range moves no control vertex farther, mm at 200: skin, and the ears' leather, which slides
/// where the head below it turns away.
const LONGEST_STEP: f64 = 1.5;
/// Faults that are known, as they are: where a head is hardly a dog's any more, a ray finds another side of the surface,
/// and one vertex jumps (breed, slider, mm at 200). The large sweep meets them.
const KNOWN_JUMPS: &[(&str, &str, f64)] = &[
    ("chihuahua", "cranial_height_mm", 5.5),
    ("chihuahua", "mouth_corner_mm", 4.5),
    // Where a short face begins and a narrow eye ends, a vertex of the hollow before the eye leaps over its edge.
    ("pekingese", "facial_length_mm", 7.7),
    ("pekingese", "eye_depth_mm", 7.5),
    ("pekingese", "eye_spacing_mm", 1.7),
    ("borzoi", "eye_spacing_mm", 2.4),
    ("dachshund", "stop_angle_deg", 2.2),
    ("dachshund", "eye_height_mm", 2.1),
    ("dachshund", "cranial_length_mm", 1.6),
    ("archetype_dolicho", "muzzle_width_root_mm", 1.7),
    ("beagle", "muzzle_depth_root_mm", 1.8),
    ("pug", "muzzle_width_tip_mm", 2.2),
    ("dachshund", "muzzle_depth_tip_mm", 1.9),
    // No jump: the tip of the leather slides as fast as that over the edge of the head.
    ("bulldog", "ear_sweep_deg", 2.2),
];

#[test]
fn a_small_step_of_a_slider_makes_a_jump() {
    let world = World::embedded();
    let (mut before, mut after) = (Deformed::default(), Deformed::default());
    let mut all = Vec::new();
    let places: &[f32] = if sweeps_all() { &[0.1, 0.3, 0.5, 0.7, 0.9] } else { &[0.3, 0.7] };
    for breed in &world.breeds {
        for (row, spec) in world.table.specs.iter().enumerate() {
            let own = (breed.values[row] - spec.min_si()) / (spec.max_si() - spec.min_si());
            // Every breed at its own values; elsewhere on a slider the breeds that span the others.
            let elsewhere = if sweeps_all() || SPANNING.contains(&breed.id.as_str()) { places } else { &[] };
            for place in elsewhere.iter().copied().chain([own.clamp(0.0005, 0.9995)]) {
                let mut values = breed.values.clone();
                let set =
                    |values: &mut Vec<f32>, t: f32| values[row] = spec.min_si() + (spec.max_si() - spec.min_si()) * t;
                set(&mut values, place - 0.0005);
                world.rig.deform(&values, ROUNDS, &mut before);
                set(&mut values, place + 0.0005);
                world.rig.deform(&values, ROUNDS, &mut after);
                let scale = at_200(&world, &values);
                let moved = before.control.iter().zip(&after.control).map(|(a, b)| scale * f64::from(a.distance(*b)));
                let (v, d) = moved.enumerate().fold((0, 0.0), |w, m| if m.1 > w.1 { m } else { w });
                let known = KNOWN_JUMPS.iter().find(|k| (k.0, k.1) == (breed.id.as_str(), spec.id.as_str()));
                all.push((
                    d,
                    known.map_or(LONGEST_STEP, |k| k.2),
                    format!(
                        "{d:.3} mm at {}: {} {} at {place:.3} of its range",
                        name(world.rig.half(), v),
                        breed.id,
                        spec.id
                    ),
                ));
            }
        }
    }
    all.sort_by(|a, b| b.0.total_cmp(&a.0));
    println!("{} steps, median {:.3} mm, worst {}", all.len(), all[all.len() / 2].0, all[0].2);
    let jumps: Vec<&str> = all.iter().filter(|a| a.0 > a.1).map(|a| a.2.as_str()).collect();
    assert!(jumps.is_empty(), "{} of {} steps:\n{}", jumps.len(), all.len(), jumps.join("\n"));
}

// ---- true sizes ----

#[test]
fn a_breed_has_not_its_true_size() {
    let world = World::embedded();
    let fine = plan(&world, 3);
    let mut evaluator = Evaluator::new(&fine);
    let mut faults = Faults::default();
    for breed in world.breeds.iter().filter(|b| !is_class(b)) {
        let id = &breed.id;
        let [length, width, mass] = ["skull_length", "zygomatic_width", "body_mass"].map(|q| reference(breed, q));
        let value = |id: &str| 1e3 * breed.values[world.row(id)];
        let head = deform(&world, &breed.values, ROUNDS);
        let at = evaluator.evaluate(&fine, &head.control).positions;
        let skin = Skin { world: &world, at, head: &head };
        // Computed from the rig's measures on bone.
        let skull = 1e3 * world.skull_length(&breed.values);
        faults.check((skull / length - 1.0).abs() < 0.03, || format!("{id}: skull {skull:.0} mm, estimated {length}"));
        let zygomatic = value("zygomatic_width_mm");
        faults
            .check((zygomatic / width - 1.0).abs() < 0.03, || format!("{id}: {zygomatic} mm wide, estimated {width}"));
        // Measured on the skin: lip and skin in front, skin and muscle behind and beside the bone.
        let on_skin = 1e3 * skin.apart("s.3.9", "s.16.0");
        faults.check((1.02..1.28).contains(&(on_skin / skull)), || {
            format!("{id}: {on_skin:.0} mm on skin, {skull:.0} on bone")
        });
        let across = 1e3 * skin.width(&["s.10.", "s.11.", "s.12.", "s.13.", "s.14."]);
        faults.check((1.08..1.24).contains(&(across / width)), || {
            format!("{id}: {across:.0} mm wide on skin, {width} on bone")
        });
        // Eyeball, computed: D = 20.5 (M / 15)^0.09 mm, 17 to 24.
        let globe = (20.5 * (mass / 15.0).powf(0.09)).clamp(17.0, 24.0);
        let drawn = 2e3 * skin.head.eyes[0].radius;
        faults.check((drawn / globe - 1.0).abs() < 0.01, || {
            format!("{id}: eyeball {drawn:.1} mm, by the law {globe:.1}")
        });
        println!(
            "{id}: skull {skull:.0} (estimated {length}), on skin {on_skin:.0}; width {zygomatic:.0} (estimated {width}), on skin {across:.0}; eyeball {drawn:.1} (law {globe:.1})"
        );
    }
    // A skull that somebody has measured is no mean of the breed, but it bounds the estimate.
    for breed in &world.breeds {
        let is_bound = |r: &&Reference| r.quantity.id == "skull_length" && r.status == Status::Measured;
        for bound in breed.references.iter().filter(is_bound) {
            let skull = 1e3 * world.skull_length(&breed.values);
            faults.check(skull < 1.02 * bound.value as f32, || format!("{}: skull {skull:.0} mm, {bound:?}", breed.id));
        }
    }
    assert!(faults.0.is_empty(), "{}", faults.0.join("\n"));
}

/// Live ratios that are not met, and by how much: the Pekingese's facial length stands at the end of its range, and a
/// shorter muzzle folds the pug's stop.
const KNOWN_RATIOS: &[(&str, f32)] = &[("pekingese", 0.16), ("pug", 0.17)];

#[test]
fn a_breed_has_not_its_indices() {
    let world = World::embedded();
    let mut faults = Faults::default();
    for breed in world.breeds.iter().filter(|b| !is_class(b)) {
        let value = |id: &str| breed.values[world.row(id)];
        // On bone, as the file has them.
        let index = 100.0 * value("zygomatic_width_mm") / world.skull_length(&breed.values);
        let known = reference(breed, "skull_index");
        faults.check((index - known).abs() <= 3.0, || format!("{}: index {index:.1}, {known}", breed.id));
        // The live ratio by its curve: not the bone's own.
        let ratio = live_ratio(value("facial_length_mm") / value("cranial_length_mm"));
        let known = reference(breed, "craniofacial_ratio");
        let allowed = KNOWN_RATIOS.iter().find(|k| k.0 == breed.id).map_or(0.03, |k| k.1);
        faults.check((ratio - known).abs() <= allowed, || format!("{}: ratio {ratio:.3}, {known}", breed.id));
    }
    for breed in world.breeds.iter().filter(|b| is_class(b)) {
        let value = |id: &str| breed.values[world.row(id)];
        let width = value("zygomatic_width_mm");
        let found = [
            100.0 * width / world.skull_length(&breed.values),
            100.0 * value("cranial_width_mm") / value("cranial_length_mm"),
            100.0 * width / value("facial_length_mm"),
        ];
        for (name, found) in ["skull_index", "cranial_index", "facial_index"].into_iter().zip(found) {
            let class = reference(breed, name);
            let id = &breed.id;
            faults.check((found / class - 1.0).abs() <= 0.05, || format!("{id}: {name} {found:.1}, {class}"));
        }
    }
    assert!(faults.0.is_empty(), "{}", faults.0.join("\n"));
}
