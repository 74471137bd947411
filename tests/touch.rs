//! What may touch in a mouth: spheres that cover, tables that miss nothing, and teeth, tongue, lips, eyes and bone that stay
//! out of each other.
//!
//! Millimetres are those of a head with a skull of 200 mm. `--nocapture` prints the tables of worst cases. Large sweeps take
//! a fixed sample; `LONDRA_SWEEP=all` takes all breeds.
#![cfg(feature = "head")]

#[path = "support/mouths.rs"]
mod mouths;
#[path = "support/settings.rs"]
mod settings;
#[path = "support/solid.rs"]
mod solid;

use glam::{Vec3, vec3};
use londra::anatomy::Breed;
use londra::math::rng::Rng;
use londra::motion::{Channel, Pose};
use londra::rig::Eye;
use londra::rig::bone::teeth::{LOWER, TOOTH_VERTICES, UPPER};
use londra::rig::bone::{BoneField, BoneMesh, Bones};
use londra::rig::touch::{
    Contact, Follow, Group, Moved, Params, Part, Resolution, Sphere, Stray, Swept, Touching, free_jaw, free_lips,
    free_tongue, keep_off_eye, keep_off_mandible, keep_off_skull,
};
use mouths::{Maker, Shape};
use settings::{World, sweeps_all};
use solid::Solid;

/// The heads of the program, and what makes their mouths.
struct Mouths {
    world: World,
    maker: Maker,
}

impl Mouths {
    fn new() -> Self {
        let world = World::embedded();
        let maker = Maker::new(&world.table, &world.rig);
        Self { world, maker }
    }

    /// The breeds that span the others, or all.
    fn breeds(&self) -> Vec<Breed> {
        let all = self.world.breeds.iter();
        if sweeps_all() { all.cloned().collect() } else { self.world.spanning().cloned().collect() }
    }

    /// Dogs at random.
    fn random(&self, n: u64) -> Vec<Breed> {
        let dog = |seed| {
            let setting = self.world.mixed(seed, 0.1);
            Breed { id: setting.name, values: setting.values, ..self.world.breeds[0].clone() }
        };
        (0..n).map(dog).collect()
    }
}

/// Somewhere within the limits, often at an end or at rest.
fn anywhere(swept: &Swept, rng: &mut Rng, maker: &Maker) -> Params {
    let [least, most] = Params::limits(&maker.limits, swept.spheres.unit);
    Params(std::array::from_fn(|axis| {
        let (a, b) = (least.0[axis], most.0[axis]);
        [0.0, a, b, rng.between(a, b), rng.between(a, b), rng.between(a, b)][rng.below(6)]
    }))
}

fn degrees(gape: f32) -> Params {
    Params::default().with_gape(gape.to_radians())
}

/// Contacts at these parameters, by the tables.
fn contacts<'a>(swept: &Swept, params: Params, touching: &'a mut Touching) -> &'a [Contact] {
    let moved = swept.spheres.joints().at(params);
    for group in Group::ALL {
        swept.place(group, &moved, Stray::default(), &mut touching.centres);
    }
    swept.query(params, Stray::default(), touching);
    &touching.contacts
}

/// How deep parts are in each other, canonical millimetres.
fn deepest(swept: &Swept, contacts: &[Contact], parts: [Part; 2]) -> f32 {
    let of = contacts.iter().filter(|c| swept.parts(c) == parts);
    of.map(|c| c.depth / swept.spheres.unit).fold(0.0, f32::max)
}

#[test]
fn a_vertex_is_bare_or_a_sphere_sticks_out() {
    let mut mouths = Mouths::new();
    println!("spheres of each part, how far outside them a vertex lies (mm), how far one sticks out (mm)");
    for breed in mouths.breeds().iter().chain(&mouths.random(4)) {
        let shape = mouths.maker.shape(breed);
        let swept = mouths.maker.swept(&shape);
        let spheres = &swept.spheres;
        let unit = spheres.unit;
        let lips = |rows: &[Vec<u32>; 2]| rows.iter().flatten().map(|&v| shape.skin[v as usize]).collect::<Vec<Vec3>>();
        let rows = &mouths.maker.rows;
        let globe: Vec<Vec3> = shape.eyes.iter().flat_map(surface).collect();
        let bones = &mouths.maker.bones;
        let upper_jaw: Vec<Vec3> = {
            let targets = shape.bones.targets.expect("bones were made");
            let back = targets.upper_last.z - 6.0 * unit;
            let below = targets.upper_last.y.min(targets.prosthion.y);
            shape.bones.skull.iter().copied().filter(|p| p.z > back && p.y < below + 9.0 * unit).collect()
        };
        let mut line = format!("{:18}", breed.id);
        for (k, part) in Part::ALL.into_iter().enumerate() {
            let own = &spheres.at_rest[spheres.of(part)];
            let vertices: Vec<Vec3> = match part {
                Part::UpperTeeth => shape.bones.upper_teeth.clone(),
                Part::LowerTeeth => shape.bones.lower_teeth.clone(),
                Part::UpperJaw => upper_jaw.clone(),
                Part::Mandible => shape.bones.mandible.clone(),
                Part::Eyes => globe.clone(),
                Part::UpperLip => lips(&rows.upper),
                Part::LowerLip => lips(&rows.lower),
                Part::Tongue => shape.tongue.clone(),
            };
            let off = |p: &Vec3| own.iter().map(|s| s.distance(*p)).fold(f32::INFINITY, f32::min);
            let bare = vertices.iter().map(off).fold(0.0, f32::max) / unit;
            let indices = match part {
                Part::UpperTeeth | Part::LowerTeeth => Bones::tooth_indices(part == Part::UpperTeeth),
                Part::UpperJaw => bones.skull.mesh().indices().to_vec(),
                Part::Mandible => bones.mandible.mesh().indices().to_vec(),
                Part::Tongue => mouths.maker.tongue_indices.clone(),
                _ => Vec::new(),
            };
            let at = if part == Part::UpperJaw { &shape.bones.skull } else { &vertices };
            let body = Solid { at, indices: &indices };
            let out = |s: &Sphere| match part {
                Part::UpperLip | Part::LowerLip => s.radius,
                // Along every ray, the nearer of both eyes.
                Part::Eyes => shape.eyes.iter().map(|eye| out_of_eye(eye, s)).fold(f32::INFINITY, f32::min),
                // Of the tooth that it is nearest to in the middle: teeth stand in each other's way.
                Part::UpperTeeth | Part::LowerTeeth => out_of_a_tooth(at, &indices, s),
                _ => s.radius - body.distance(s.centre),
            };
            // What is symmetric need be asked of one side only.
            let out = own.iter().filter(|s| s.centre.x >= 0.0).map(out).fold(f32::MIN, f32::max) / unit;
            line += &format!("  {:3} {bare:4.2} {out:4.2}", own.len());
            assert!(bare <= 0.5, "{}: a vertex of {part:?} lies {bare} mm outside all spheres", breed.id);
            let (grow, miss) = spheres.fits[k];
            let most = if part == Part::Eyes { 0.5 } else { (grow + miss) / unit + 0.01 };
            assert!(out <= most, "{}: a sphere of {part:?} sticks out by {out} mm", breed.id);
            let n = if matches!(part, Part::UpperTeeth | Part::LowerTeeth) { 20 } else { 2 };
            assert!(own.len() <= n * part.fit().most.min(500), "{}: {} spheres of {part:?}", breed.id, own.len());
        }
        println!("{line}");
    }
}

/// Places all over an eyeball.
fn surface(eye: &Eye) -> Vec<Vec3> {
    const N: usize = 2000;
    let place = |k: usize| {
        let (y, turn) = (1.0 - (2 * k + 1) as f32 / N as f32, 2.399_963 * k as f32);
        let r = (1.0 - y * y).sqrt();
        let direction = vec3(r * turn.cos(), y, r * turn.sin());
        eye.centre + direction * eye.reach(direction)
    };
    (0..N).map(place).collect()
}

/// How far a sphere sticks out of the tooth that it sticks out of least.
fn out_of_a_tooth(at: &[Vec3], indices: &[u32], sphere: &Sphere) -> f32 {
    let n = at.len() / TOOTH_VERTICES;
    let out = indices.chunks(indices.len() / n).filter_map(|own| {
        let tooth = Solid { at, indices: own };
        // Its base is open: what lies below it lies in the bone.
        let near = own.iter().any(|&v| sphere.distance(at[v as usize]) <= 0.0);
        near.then(|| sphere.radius - tooth.distance(sphere.centre))
    });
    out.fold(f32::INFINITY, f32::min).min(sphere.radius)
}

/// How far a sphere sticks out of an eyeball.
fn out_of_eye(eye: &Eye, sphere: &Sphere) -> f32 {
    let places = surface(&Eye { centre: Vec3::ZERO, ..*eye });
    let out = places.iter().map(|p| {
        let direction = p.normalize();
        let from = eye.centre - sphere.centre;
        // Along the ray from the eye's centre, to where it leaves the sphere.
        let b = from.dot(direction);
        let inside = b * b - from.length_squared() + sphere.radius * sphere.radius;
        inside.max(0.0).sqrt() - b - p.length()
    });
    out.fold(f32::MIN, f32::max)
}

/// Over random parameters, and lips and tongues that stray up to and beyond what the tables know: the same contacts, in the
/// same order, to the bit.
#[test]
fn a_table_misses_a_contact_or_finds_one_that_is_none() {
    let mut mouths = Mouths::new();
    let mut rng = Rng::new(17);
    let (mut n_found, mut n_pairs) = (0, [0_usize; 2]);
    for breed in mouths.breeds().iter().chain(&mouths.random(6)) {
        let shape = mouths.maker.shape(breed);
        let swept = mouths.maker.swept(&shape);
        let spheres = &swept.spheres;
        let mut all = swept.buffers();
        let mut touching = swept.buffers();
        for _ in 0..60 {
            let params = anywhere(&swept, &mut rng, &mouths.maker);
            let moved = spheres.joints().at(params);
            spheres.place(&moved, &mut all.centres);
            // Which way soft parts stray.
            let strays = [0.0, 0.0, 0.5, 3.0, 9.0, 20.0][rng.below(6)] * spheres.unit;
            for part in [Part::UpperLip, Part::LowerLip, Part::Tongue] {
                for k in spheres.of(part) {
                    let way = Vec3::from([0; 3].map(|_| rng.between(-1.0, 1.0))).normalize_or_zero();
                    all.centres[k] += way * strays * rng.unit_f32();
                }
            }
            let by = |part| spheres.stray(part, &moved, &all.centres);
            let stray = Stray { lips: by(Part::UpperLip).max(by(Part::LowerLip)), tongue: by(Part::Tongue) };
            for group in Group::ALL {
                let expected = {
                    all.contacts.clear();
                    londra::rig::touch::table::test_all(spheres, group.pairings(), &all.centres, &mut all.contacts);
                    bits(&all.contacts)
                };
                swept.place_hard(group, &moved, stray, &mut touching.centres);
                for part in [Part::UpperLip, Part::LowerLip, Part::Tongue] {
                    for k in spheres.of(part) {
                        touching.centres[k] = all.centres[k];
                    }
                }
                touching.contacts.clear();
                swept.find(group, params, stray, &touching.centres, &mut touching.contacts);
                assert_eq!(bits(&touching.contacts), expected, "{}: {group:?} at {params:?}", breed.id);
                n_found += expected.len();
            }
        }
        for (group, table) in Group::ALL.iter().zip(&swept.tables) {
            n_pairs[0] += table.list(table.cell(Params::default(), 0.0).expect("a level")).len();
            n_pairs[1] += londra::rig::touch::table::all_pairs(spheres, group.pairings()).count();
        }
    }
    println!("{n_found} contacts found; pairs at rest: {} of {}", n_pairs[0], n_pairs[1]);
    assert!(n_found > 10_000, "hardly anything touched: {n_found}");
    assert!(n_pairs[0] * 20 < n_pairs[1], "the tables spare less than nineteen of twenty pairs");
}

fn bits(contacts: &[Contact]) -> Vec<([u16; 2], [u32; 4])> {
    let bits = |c: &Contact| {
        let [x, y, z] = c.direction.to_array();
        (c.pair, [c.depth, x, y, z].map(f32::to_bits))
    };
    contacts.iter().map(bits).collect()
}

#[test]
fn threads_change_a_bit() {
    let mut mouths = Mouths::new();
    let pug = mouths.world.breed("pug").clone();
    let shape = mouths.maker.shape(&pug);
    let maker = &mouths.maker;
    let ask = || {
        let swept = maker.swept(&shape);
        let mut touching = swept.buffers();
        let at = |k: u32| bits(contacts(&swept, degrees(k as f32), &mut touching));
        (0..20).map(at).collect::<Vec<_>>()
    };
    let alone = ask();
    std::thread::scope(|scope| {
        let others: Vec<_> = (0..4).map(|_| scope.spawn(ask)).collect();
        for other in others {
            assert_eq!(other.join().expect("no panic"), alone);
        }
    });
}

#[test]
fn a_pose_out_of_range_panics_or_is_no_place_of_the_table() {
    let mut mouths = Mouths::new();
    let dog = mouths.world.breed("labrador").clone();
    let shape = mouths.maker.shape(&dog);
    let swept = mouths.maker.swept(&shape);
    let mut touching = swept.buffers();
    for value in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY, 1e9, -1e9] {
        let pose = Pose::default().with(Channel::JawGape, value).with(Channel::TongueOut, value);
        let params = Params::of(&pose, swept.spheres.unit);
        assert!(params.0.iter().all(|p| p.is_finite()));
        let found = contacts(&swept, swept.clamped(params), &mut touching);
        assert!(found.iter().all(|c| c.depth.is_finite() && c.direction.is_finite()));
        swept.query(Params([value; 5]), Stray { lips: value, tongue: value }, &mut touching);
    }
    assert_eq!(Params::of(&Pose::default(), swept.spheres.unit), Params::default());
}

/// How deep crowns are in each other, of vertices in bodies, canonical millimetres, and which two. `lower`: as they are now.
fn crowns_in_each_other(shape: &Shape, lower: &[Vec3], unit: f32) -> (f32, String) {
    let teeth = |upper: bool, at: &[Vec3]| {
        let indices = Bones::tooth_indices(upper);
        let n = at.len() / TOOTH_VERTICES;
        let tooth = |(k, own): (usize, &[u32])| {
            let first = k * TOOTH_VERTICES;
            let indices: Vec<u32> = own.iter().map(|v| v - first as u32).collect();
            (at[first..first + TOOTH_VERTICES].to_vec(), indices)
        };
        indices.chunks(indices.len() / n).enumerate().map(tooth).collect::<Vec<_>>()
    };
    let (above, below) = (teeth(true, &shape.bones.upper_teeth), teeth(false, lower));
    let mut deepest = (0.0_f32, "");
    let mut other = "";
    for (i, (up, up_indices)) in above.iter().enumerate() {
        for (j, (low, low_indices)) in below.iter().enumerate() {
            let a = Solid { at: up, indices: up_indices };
            let b = Solid { at: low, indices: low_indices };
            let depth = a.depth(low).max(b.depth(up)) / unit;
            if depth > deepest.0 {
                deepest = (depth, UPPER[i % UPPER.len()].name);
                other = LOWER[j % LOWER.len()].name;
            }
        }
    }
    (deepest.0, format!("{} {other}", deepest.1))
}

/// How much deeper vertices may be in crowns on the way than at rest, canonical millimetres: crowns that overlap at rest shear
/// past each other as the jaw opens, and are a little deeper before they part. Spheres that pass beside each other are up to a
/// millimetre deeper than the crowns that they stand for, so that only vertices decide.
const SHEAR: f32 = 0.35;

#[test]
fn teeth_go_deeper_into_each_other_as_the_jaw_opens() {
    const HARD: [[Part; 2]; 3] =
        [[Part::UpperTeeth, Part::LowerTeeth], [Part::UpperTeeth, Part::Mandible], [Part::UpperJaw, Part::LowerTeeth]];
    let (mut mouths, mut bad) = (Mouths::new(), Vec::new());
    println!(
        "mm by spheres, at rest and on the way: tooth in tooth, upper tooth in mandible, lower tooth in upper jaw;"
    );
    println!("vertices in crowns, at rest and on the way; degrees at which the last is free; the deepest two at rest");
    for breed in mouths.breeds().iter().chain(&mouths.random(4)) {
        let shape = mouths.maker.shape(breed);
        let swept = mouths.maker.swept(&shape);
        let unit = swept.spheres.unit;
        let mut touching = swept.buffers();
        let at = |gape: f32, touching: &mut Touching| {
            let found = contacts(&swept, degrees(gape), touching);
            HARD.map(|parts| deepest(&swept, found, parts))
        };
        let rest = at(0.0, &mut touching);
        let (mut way, mut free) = ([0.0_f32; 3], 0.0);
        for step in 1..=650 {
            let gape = 0.1 * step as f32;
            let now = at(gape, &mut touching);
            way = std::array::from_fn(|k| way[k].max(now[k]));
            if now != [0.0; 3] {
                free = gape;
            }
            let beyond = touching.contacts.iter().filter(|c| HARD.contains(&swept.parts(c))).map(|c| swept.beyond(c));
            assert!(beyond.fold(0.0, f32::max) <= 0.01 * unit, "{}: not as bred at {gape} degrees", breed.id);
        }
        let (exact, which) = crowns_in_each_other(&shape, &shape.bones.lower_teeth, unit);
        let opened = [0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 5.0].map(|gape| {
            let moved = swept.spheres.joints().at(degrees(gape));
            let lower: Vec<Vec3> = shape.bones.lower_teeth.iter().map(|&p| moved.carry(Follow::MANDIBLE, p)).collect();
            crowns_in_each_other(&shape, &lower, unit).0
        });
        let opened = opened.into_iter().fold(0.0, f32::max);
        let [a, b, c] = rest;
        let [d, e, f] = way;
        println!(
            "{:18} {a:4.2} {b:4.2} {c:4.2}  {d:4.2} {e:4.2} {f:4.2}  {exact:4.2} {opened:4.2}  {free:3.1}  {which}",
            breed.id
        );
        if opened > exact + SHEAR {
            bad.push(format!("{}: crowns {opened} mm on the way, {exact} at rest", breed.id));
        }
    }
    assert!(bad.is_empty(), "{bad:#?}");
}

/// Breeds whose arch is too narrow for the tongue, and how deep it lies in a tooth, millimetres.
const IN_THE_WAY: &[(&str, f32)] = &[("archetype_dolicho", 0.5), ("borzoi", 0.7)];

#[test]
fn the_tongue_at_rest_lies_in_a_tooth() {
    let (mut mouths, mut bad) = (Mouths::new(), Vec::new());
    println!("mm at rest: tongue in upper, in lower teeth by spheres; vertices of one in the other");
    for breed in mouths.breeds().iter().chain(&mouths.random(4)) {
        let shape = mouths.maker.shape(breed);
        let swept = mouths.maker.swept(&shape);
        let unit = swept.spheres.unit;
        let mut touching = swept.buffers();
        let found = contacts(&swept, Params::default(), &mut touching);
        let [above, below] =
            [Part::UpperTeeth, Part::LowerTeeth].map(|teeth| deepest(&swept, found, [teeth, Part::Tongue]));
        let tongue = Solid { at: &shape.tongue, indices: &mouths.maker.tongue_indices };
        let mut exact = 0.0_f32;
        for (upper, teeth) in [(true, &shape.bones.upper_teeth), (false, &shape.bones.lower_teeth)] {
            exact = exact.max(tongue.depth(teeth));
            let indices = Bones::tooth_indices(upper);
            exact = exact.max(Solid { at: teeth, indices: &indices }.depth(&shape.tongue));
        }
        println!("{:18} {above:5.2} {below:5.2}  {:5.2}", breed.id, exact / unit);
        let known = IN_THE_WAY.iter().find(|k| k.0 == breed.id).map_or(0.1, |k| k.1);
        if exact / unit > known {
            bad.push(format!("{}: tongue and teeth are {} mm in each other", breed.id, exact / unit));
        }
    }
    assert!(bad.is_empty(), "{bad:#?}");
}

#[test]
fn teeth_go_through_each_other_where_the_jaw_shuts() {
    let mut mouths = Mouths::new();
    let mut rng = Rng::new(23);
    println!(
        "beyond what is bred, mm, before and after; most that teeth hold the jaw open, degrees; share of the slide left"
    );
    for breed in mouths.breeds().iter().chain(&mouths.random(4)) {
        let shape = mouths.maker.shape(breed);
        let swept = mouths.maker.swept(&shape);
        let unit = swept.spheres.unit;
        let mut touching = swept.buffers();
        let [least, most] = Params::limits(&mouths.maker.limits, unit);
        let (mut before, mut after, mut held, mut share, mut n) = (0.0_f32, 0.0_f32, 0.0_f32, 0.0, 0.0_f32);
        for k in 0..40 {
            let mut params = degrees([0.0, 0.0, 1.0, 4.0, 12.0][k % 5]);
            // Straight, then aside.
            assert_eq!(free_jaw(&swept, params, &mut touching), params, "{}: a jaw is not let shut", breed.id);
            for axis in [1, 2] {
                params.0[axis] = rng.between(least.0[axis], most.0[axis]);
            }
            before = before.max(beyond(&swept, params, &mut touching) / unit);
            let to = free_jaw(&swept, params, &mut touching);
            assert!(to.0[0] >= params.0[0], "{}: {to:?} of {params:?}", breed.id);
            after = after.max(beyond(&swept, to, &mut touching) / unit);
            held = held.max(to.0[0] - params.0[0]);
            (share, n) = (share + to.0[2] / params.0[2], n + 1.0);
            // Never for nothing: a little nearer to shut something is deeper.
            if to.0[0] > params.0[0] + 0.004 {
                let nearer = beyond(&swept, to.with_gape(to.0[0] - 0.004), &mut touching);
                assert!(nearer > 0.0, "{}: held open to {to:?} for nothing", breed.id);
            }
        }
        println!("{:18} {before:5.2} {after:5.2}  {:5.2}  {:4.2}", breed.id, held.to_degrees(), share / n);
        assert!(after <= 0.25, "{}: {after} mm", breed.id);
    }
}

/// The deepest of teeth and jaws in each other beyond what is bred, metres.
fn beyond(swept: &Swept, params: Params, touching: &mut Touching) -> f32 {
    let found = contacts(swept, swept.clamped(params), touching);
    let hard = |c: &&Contact| Group::Hard.pairings()[..3].contains(&swept.parts(c));
    found.iter().filter(hard).map(|c| swept.beyond(c)).fold(0.0, f32::max)
}

/// A skin whose lips follow the jaw and are pressed inwards here and there.
fn pressed(maker: &Maker, shape: &Shape, moved: &Moved, by: impl Fn(usize) -> Vec3) -> Vec<Vec3> {
    let mut skin = shape.skin.clone();
    for row in maker.rows.upper.iter().chain(&maker.rows.lower) {
        for (k, &v) in row.iter().enumerate() {
            let follow = Follow { jaw: maker.weights[v as usize], ..Follow::SKULL };
            skin[v as usize] = moved.carry(follow, shape.skin[v as usize] + by(k));
        }
    }
    skin
}

#[test]
fn lips_are_left_in_the_teeth() {
    let mut mouths = Mouths::new();
    let mut rng = Rng::new(29);
    println!("mm: lips in teeth where they are pressed inwards, the most that is left, the farthest push");
    for breed in mouths.breeds().iter().chain(&mouths.random(4)) {
        let shape = mouths.maker.shape(breed);
        let swept = mouths.maker.swept(&shape);
        let unit = swept.spheres.unit;
        let (mut touching, mut resolution) = (swept.buffers(), Resolution::default());
        // At rest no bit changes.
        let rest = swept.spheres.joints().at(Params::default());
        let mut skin = shape.skin.clone();
        free_lips(&swept, &rest, 0.0, &mut skin, &mut touching, &mut resolution);
        assert_eq!(skin, shape.skin, "{}: lips at rest are moved", breed.id);
        let (mut before, mut left, mut farthest) = (0.0_f32, 0.0_f32, 0.0_f32);
        for gape in [0.0, 2.0, 8.0, 20.0, 57.0] {
            let moved = swept.spheres.joints().at(degrees(gape));
            for _ in 0..4 {
                // A finger here and there.
                let press: Vec<f32> = (0..15).map(|_| rng.between(0.0, 4.0) * unit).collect();
                let inwards = |k: usize| {
                    let side = (k as f32 - 7.0) / 7.0;
                    vec3(-side, 0.0, -(1.0 - side * side).max(0.0).sqrt()) * press[k]
                };
                let mut skin = pressed(&mouths.maker, &shape, &moved, inwards);
                let was = skin.clone();
                let stray = 5.0 * unit;
                swept.place_hard(Group::Lips, &moved, Stray { lips: stray, tongue: 0.0 }, &mut touching.centres);
                swept.spheres.place_lips(&skin, &mut touching.centres);
                touching.contacts.clear();
                let stray_of = Stray { lips: stray, tongue: 0.0 };
                swept.find(Group::Lips, moved.params(), stray_of, &touching.centres, &mut touching.contacts);
                before = touching.contacts.iter().map(|c| swept.beyond(c) / unit).fold(before, f32::max);
                let deep = free_lips(&swept, &moved, stray, &mut skin, &mut touching, &mut resolution);
                left = left.max(deep / unit);
                let far = skin.iter().zip(&was).map(|(a, b)| a.distance(*b) / unit).fold(0.0, f32::max);
                farthest = farthest.max(far);
            }
        }
        println!("{:18} {before:5.2} {left:5.2} {farthest:5.2}", breed.id);
        assert!(left <= 0.3, "{}: lips are left {left} mm in teeth", breed.id);
    }
}

#[test]
fn a_tongue_is_left_in_the_teeth() {
    let mut mouths = Mouths::new();
    println!(
        "mm: tongue in teeth as the parameters put it; the most that is left, and where it hangs out 60; narrowing, lift"
    );
    for breed in mouths.breeds().iter().chain(&mouths.random(4)) {
        let shape = mouths.maker.shape(breed);
        let swept = mouths.maker.swept(&shape);
        let unit = swept.spheres.unit;
        let (mut touching, mut resolution) = (swept.buffers(), Resolution::default());
        let rest = swept.spheres.joints().at(Params::default());
        let (shift, _) = free_tongue(&swept, &rest, 0.0, &mut touching, &mut resolution);
        assert!(shift.is_none(), "{}: the tongue at rest is moved", breed.id);
        let (mut before, mut narrow, mut lift) = (0.0_f32, 0.0_f32, 0.0_f32);
        let (mut left, mut far) = (0.0_f32, 0.0_f32);
        for gape in [0.0, 4.0, 14.0, 30.0, 57.0] {
            for (out, up) in [(0.0, 0.0), (10.0, 10.0), (20.0, 0.0), (40.0, 10.0), (60.0, -20.0), (0.0, 30.0)] {
                // A tongue needs a gap to pass through.
                if gape < 14.0 && (out > 0.0 || up > 0.0) {
                    continue;
                }
                let pose = Pose::default()
                    .with(Channel::JawGape, gape)
                    .with(Channel::TongueOut, out)
                    .with(Channel::TongueLift, up);
                let moved = swept.spheres.joints().at(swept.clamped(Params::of(&pose, unit)));
                touching.contacts.clear();
                for group in [Group::TongueAbove, Group::TongueBelow] {
                    swept.place(group, &moved, Stray::default(), &mut touching.centres);
                    let params = moved.params();
                    swept.find(group, params, Stray::default(), &touching.centres, &mut touching.contacts);
                }
                before = touching.contacts.iter().map(|c| swept.beyond(c) / unit).fold(before, f32::max);
                let (shift, deep) = free_tongue(&swept, &moved, 0.0, &mut touching, &mut resolution);
                let worst = if up < 0.0 { &mut far } else { &mut left };
                *worst = worst.max(deep / unit);
                narrow = shift.narrow.iter().fold(narrow, |m, v| m.max(v / unit));
                lift = shift.lift.iter().fold(lift, |m, v| m.max(v.abs() / unit));
            }
        }
        println!("{:18} {before:5.2} {left:5.2} {far:5.2} {narrow:5.2} {lift:5.2}", breed.id);
        assert!(left <= 0.5, "{}: the tongue is left {left} mm in teeth", breed.id);
    }
}

#[test]
fn a_point_is_left_in_an_eye() {
    let mut mouths = Mouths::new();
    let mut rng = Rng::new(31);
    for breed in mouths.breeds() {
        let eye = mouths.maker.shape(&breed).eyes[0];
        for _ in 0..20 {
            // A gaze: turned about up, then about the side.
            let (turn, lift) = (rng.between(-0.6, 0.6), rng.between(-0.45, 0.35));
            let [a, b, g] = eye.axes;
            let g = g * turn.cos() * lift.cos() + a * turn.sin() + b * turn.cos() * lift.sin();
            let a = (a - g * a.dot(g)).normalize();
            let eye = Eye { axes: [a, g.cross(a), g], ..eye };
            let places = surface(&eye);
            let least = rng.between(0.0, 0.1) * eye.radius;
            let mut points: Vec<Vec3> = (0..60)
                .map(|_| eye.centre + Vec3::from([0; 3].map(|_| rng.between(-1.3, 1.3))) * eye.radius)
                .chain([eye.centre])
                .collect();
            let before = points.clone();
            keep_off_eye(&eye, least, &mut points);
            for (p, was) in points.iter().zip(&before) {
                let direction = (*p - eye.centre).normalize();
                assert!(p.distance(eye.centre) >= eye.reach(direction) + least - 1e-7, "{}", breed.id);
                let near = places.iter().map(|s| s.distance(*p)).fold(f32::INFINITY, f32::min);
                assert!(near >= 0.999 * least - 1e-6, "{}: {near} m from the eye, {least} asked for", breed.id);
                let reach = eye.reach((*was - eye.centre).normalize_or(eye.axes[2]));
                if was.distance(eye.centre) > reach + 1.02 * least + 1e-6 {
                    assert_eq!(p, was, "{}: a point off the eye is moved", breed.id);
                }
            }
        }
    }
}

#[test]
fn a_point_is_left_in_bone() {
    let mut mouths = Mouths::new();
    let mut rng = Rng::new(37);
    println!("mm: how deep points are within 1 mm of bone, and how deep they are left there");
    for breed in mouths.breeds() {
        let shape = mouths.maker.shape(&breed);
        let swept = mouths.maker.swept(&shape);
        let unit = swept.spheres.unit;
        let targets = shape.bones.targets.expect("bones were made");
        let [skull, mandible] = [BoneMesh::Skull, BoneMesh::Mandible].map(|b| BoneField::new(b, &targets, unit));
        let least = 1.0 * unit;
        let (mut deepest, mut left) = (0.0_f32, 0.0_f32);
        for gape in [0.0_f32, 20.0, 57.0] {
            let moved = swept.spheres.joints().at(Params([gape.to_radians(), 0.001, 0.002, 0.0, 0.0]));
            // Places near the surface of either bone, as skin is.
            let mut near = |vertices: &[Vec3], carry: &dyn Fn(Vec3) -> Vec3| -> Vec<Vec3> {
                let place = |p: &Vec3| carry(*p + Vec3::from([0; 3].map(|_| rng.between(-2.5, 2.5))) * unit);
                vertices.iter().step_by(3).map(place).collect()
            };
            let mut of_mandible = near(&shape.bones.mandible, &|p| moved.carry(Follow::MANDIBLE, p));
            let before = of_mandible.clone();
            deepest = deepest.max(keep_off_mandible(&mandible, &moved, least, unit, &mut of_mandible) / unit);
            for (p, was) in of_mandible.iter().zip(&before) {
                left = left.max((least - mandible.distance(moved.back(*p))) / unit);
                if mandible.distance(moved.back(*was)) > least {
                    assert_eq!(p, was, "{}: a point off the mandible is moved", breed.id);
                }
            }
            let mut of_skull = near(&shape.bones.skull, &|p| p);
            deepest = deepest.max(keep_off_skull(&skull, least, unit, &mut of_skull) / unit);
            left = of_skull.iter().fold(left, |left, p| left.max((least - skull.distance(*p)) / unit));
        }
        println!("{:18} {deepest:5.2} {left:5.2}", breed.id);
        assert!(left <= 1.5, "{}: a point is left {} mm in bone", breed.id, left - 1.0);
    }
}
