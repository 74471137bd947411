//! What random dogs and puppies promise: they differ as the breeds do, keep what is locked, stay in range, are heads, and
//! are the same for the same seed.
#![cfg(feature = "head")]

#[allow(dead_code, reason = "of the support, only folds are asked for")]
#[path = "support/geometry.rs"]
mod geometry;
#[path = "support/settings.rs"]
mod settings;

use geometry::Shape;
use londra::anatomy::{Breed, INHERITED_WHOLE, Locks, Space, SpaceError, Unit, cross, load_breed, save_breed};
use londra::frame::skin_tags;
use londra::math::rng::Rng;
use londra::measure::{Folds, MAY_FOLD};
use londra::rig::Deformed;
use londra::rig::deform::ROUNDS;
use londra::subdiv::{Plan, PlanOptions, Scheme, evaluate_once};
use settings::{KNOWN_BREEDS, World};

fn space(world: &World) -> Space {
    Space::new(&world.table, &world.breeds).unwrap_or_else(|e| panic!("{e}"))
}

fn random(world: &World, space: &Space, base: &Breed, locks: &Locks, seed: u64) -> Breed {
    space.random(&world.table, &world.breeds, base, locks, &mut Rng::new(seed))
}

fn free(world: &World, space: &Space, seed: u64) -> Breed {
    random(world, space, &Breed::defaults(&world.table), &Locks::none(&world.table), seed)
}

fn locks(world: &World, words: &[&str]) -> Locks {
    let mut locks = Locks::none(&world.table);
    words.iter().for_each(|word| locks.lock(&world.table, word).unwrap_or_else(|e| panic!("{e}")));
    locks
}

fn puppy(world: &World, sire: &str, dam: &str, seed: u64) -> Breed {
    let [sire, dam] = [sire, dam].map(|id| world.breed(id));
    cross(&world.table, sire, dam, &mut Rng::new(seed)).unwrap_or_else(|e| panic!("{e}"))
}

/// In range, every value set, and the same after the way through a file.
fn assert_is_a_breed(world: &World, dog: &Breed) {
    for (value, spec) in dog.values.iter().zip(&world.table.specs) {
        assert!((spec.min_si()..=spec.max_si()).contains(value), "{} is {value}", spec.id);
    }
    assert!(dog.set.iter().all(|&set| set));
    let text = save_breed(&world.table, dog);
    let again = load_breed(&world.table, "dog.ron", &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
    assert_eq!((&again.values, &again.look), (&dog.values, &dog.look));
}

// ---- random dogs ----

#[test]
fn a_seed_gives_two_dogs_or_two_seeds_give_one() {
    let world = World::embedded();
    let space = space(&world);
    let text = |seed| save_breed(&world.table, &free(&world, &space, seed));
    assert_eq!(text(5), text(5));
    assert_ne!(text(5), text(6));
}

#[test]
fn a_random_dog_is_no_breed_file() {
    let world = World::embedded();
    let space = space(&world);
    for seed in 0..50 {
        let dog = free(&world, &space, seed);
        assert_is_a_breed(&world, &dog);
        assert!(world.breeds.iter().any(|b| b.look.hair == dog.look.hair), "the hair of no breed");
    }
}

/// Of coordinates over their deviations. The tolerance is for the sample, some 6 %, and for what is cut off at the most
/// extreme breed and at the ends of ranges: there is no dewlap and no fold below zero, where most breeds are.
#[test]
fn random_dogs_vary_otherwise_than_the_breeds() {
    let world = World::embedded();
    let space = space(&world);
    const N: usize = 2000;
    let dogs: Vec<Vec<f64>> = (0..N as u64).map(|seed| space.point(&free(&world, &space, seed).values)).collect();
    let rows: Vec<usize> = (0..world.table.specs.len()).filter(|&r| space.covariance(r, r) > 1e-12).collect();
    let mean = |r: usize| dogs.iter().map(|d| d[r]).sum::<f64>() / N as f64;
    let means: Vec<f64> = (0..world.table.specs.len()).map(mean).collect();
    let middle = space.point(&space.mean(&world.table).values);
    let (mut squares, mut wrong, mut worst_mean) = (0.0, 0.0, (0.0, ""));
    for &r in &rows {
        let deviation = space.covariance(r, r).sqrt();
        let off = (means[r] - middle[r]).abs() / deviation;
        worst_mean = if off > worst_mean.0 { (off, world.table.specs[r].id.as_str()) } else { worst_mean };
        for &s in &rows {
            let unit = deviation * space.covariance(s, s).sqrt();
            let expected = space.covariance(r, s) / unit;
            let found = dogs.iter().map(|d| (d[r] - means[r]) * (d[s] - means[s])).sum::<f64>() / (N - 1) as f64 / unit;
            squares += expected * expected;
            wrong += (found - expected) * (found - expected);
        }
    }
    let part = (wrong / squares).sqrt();
    println!("covariance off by {part:.3} of its norm, means by up to {worst_mean:?} deviations");
    assert!(part < 0.25, "the covariance of {N} random dogs is off by {part:.3} of its norm");
    assert!(worst_mean.0 < 0.4, "a mean is off by {worst_mean:?} deviations");
}

#[test]
fn the_covariance_is_not_that_of_the_breeds() {
    let world = World::embedded();
    let space = space(&world);
    let points: Vec<Vec<f64>> = world.breeds.iter().map(|b| space.point(&b.values)).collect();
    let n = points.len() as f64;
    for r in 0..world.table.specs.len() {
        for s in 0..r {
            let [a, b] = [r, s].map(|k| points.iter().map(|p| p[k]).sum::<f64>() / n);
            let expected = points.iter().map(|p| (p[r] - a) * (p[s] - b)).sum::<f64>() / (n - 1.0);
            assert!((space.covariance(r, s) - expected).abs() < 1e-9);
        }
    }
}

#[test]
fn size_is_not_apart_from_shape() {
    let world = World::embedded();
    let space = space(&world);
    let small = world.breed("beagle");
    let mut large = small.clone();
    for (value, spec) in large.values.iter_mut().zip(&world.table.specs) {
        *value *= if spec.unit == Unit::Millimetre { 1.25 } else { 1.0 };
    }
    let moved = space.point(&small.values).into_iter().zip(space.point(&large.values));
    let moved: Vec<&str> =
        moved.zip(&world.table.specs).filter(|((a, b), _)| (a - b).abs() > 1e-5).map(|(_, s)| s.id.as_str()).collect();
    assert_eq!(moved, ["cranial_length_mm"]);
}

#[test]
fn a_lock_does_not_hold() {
    let world = World::embedded();
    let space = space(&world);
    let base = world.breed("bulldog");
    for words in [&["facial_length_mm"][..], &["Ears", "coat"], &["lips-and-jaw", "eyes"], &["skull", "face", "nose"]] {
        let locks = locks(&world, words);
        let locked: Vec<usize> = locks.rows().collect();
        assert!(!locked.is_empty());
        let dogs: Vec<Breed> = (0..20).map(|seed| random(&world, &space, base, &locks, seed)).collect();
        for dog in &dogs {
            assert_is_a_breed(&world, dog);
            assert!(locked.iter().all(|&r| dog.values[r].to_bits() == base.values[r].to_bits()), "{words:?}");
            assert!(!words.contains(&"coat") || dog.look == base.look);
        }
        let free = (0..world.table.specs.len()).filter(|r| !locked.contains(r));
        let moves = free.filter(|&r| dogs.iter().any(|d| d.values[r] != dogs[0].values[r])).count();
        assert!(moves + locked.len() + 4 >= world.table.specs.len(), "{words:?}: only {moves} measures vary");
    }
}

/// Breeds with short faces have steep stops: so must random dogs whose short face is locked.
#[test]
fn what_is_locked_does_not_draw_the_rest_along() {
    let world = World::embedded();
    let space = space(&world);
    let (face, stop) = (world.row("facial_length_mm"), world.row("stop_angle_deg"));
    let locks = locks(&world, &["cranial_length_mm", "facial_length_mm"]);
    let stop_of = |id: &str| {
        let base = world.breed(id);
        let dogs = (0..200).map(|seed| random(&world, &space, base, &locks, seed));
        dogs.inspect(|dog| assert_eq!(dog.values[face], base.values[face])).map(|d| d.values[stop]).sum::<f32>() / 200.0
    };
    let (pug, borzoi) = (stop_of("pug").to_degrees(), stop_of("borzoi").to_degrees());
    println!("mean stop with a pug's face {pug:.0}°, with a borzoi's {borzoi:.0}°");
    assert!(pug + 20.0 < borzoi, "{pug} {borzoi}");
}

#[test]
fn a_word_that_names_nothing_is_locked() {
    let world = World::embedded();
    let mut locks = Locks::none(&world.table);
    let message = |word: &str, locks: &mut Locks| locks.lock(&world.table, word).unwrap_err().to_string();
    assert!(message("eers", &mut locks).contains("did you mean Ears"));
    assert!(message("stop_angle_dg", &mut locks).contains("did you mean stop_angle_deg"));
    assert!(message("", &mut locks).contains("Lips and jaw"));
    assert!(locks.is_empty());
}

#[test]
fn a_space_of_one_breed_is_made() {
    let world = World::embedded();
    assert_eq!(Space::new(&world.table, &world.breeds[..1]).unwrap_err(), SpaceError::TooFew(1));
}

// ---- puppies ----

#[test]
fn a_puppy_is_no_breed_file_or_changes_with_the_run() {
    let world = World::embedded();
    for seed in 0..20 {
        let dog = puppy(&world, "pug", "borzoi", seed);
        assert_is_a_breed(&world, &dog);
        assert_eq!(dog, puppy(&world, "pug", "borzoi", seed));
        assert_ne!(dog, puppy(&world, "pug", "borzoi", seed + 100));
    }
}

/// Noise ends at three quarters of half the difference, so a quarter of it beyond the middle's three.
#[test]
fn a_puppy_lies_far_from_its_parents() {
    let world = World::embedded();
    let space = space(&world);
    let (mut inside, mut all) = (0, 0);
    for (sire, dam) in [("pug", "borzoi"), ("chihuahua", "bulldog"), ("beagle", "german_shepherd")] {
        let [a, b] = [sire, dam].map(|id| space.point(&world.breed(id).values));
        for seed in 0..50 {
            let point = space.point(&puppy(&world, sire, dam, seed).values);
            for (row, spec) in world.table.specs.iter().enumerate() {
                let (low, high) = (a[row].min(b[row]), a[row].max(b[row]));
                // Half a digit of the file, on the smallest size.
                let digit = if spec.unit == Unit::Ratio { 6e-4 } else { 3e-3 };
                let more = 0.25 * (high - low) + digit;
                assert!((low - more..=high + more).contains(&point[row]), "{sire} x {dam} {seed}: {}", spec.id);
                inside += usize::from((low - digit..=high + digit).contains(&point[row]));
                all += 1;
            }
        }
    }
    let part = inside as f64 / all as f64;
    println!("{:.1} % between the parents", 100.0 * part);
    assert!(part > 0.93, "{part}");
}

#[test]
fn what_is_inherited_whole_comes_in_pieces() {
    let world = World::embedded();
    let rows = INHERITED_WHOLE.map(|id| world.row(id));
    let carriage = |dog: &Breed| rows.map(|r| dog.values[r].to_bits());
    let (sire, dam) = (world.breed("german_shepherd"), world.breed("beagle"));
    let mut found = [[0; 2]; 3];
    for seed in 0..40 {
        let dog = puppy(&world, &sire.id, &dam.id, seed);
        let of = |is: [bool; 2]| is.iter().position(|&is| is).unwrap_or_else(|| panic!("seed {seed}: of neither"));
        found[0][of([sire, dam].map(|p| carriage(p) == carriage(&dog)))] += 1;
        found[1][of([sire, dam].map(|p| (&p.look.pattern, p.look.nose) == (&dog.look.pattern, dog.look.nose)))] += 1;
        found[2][of([sire, dam].map(|p| p.look.iris == dog.look.iris))] += 1;
    }
    assert!(found.as_flattened().iter().all(|&n| n >= 8), "one parent gives nearly all: {found:?}");
}

#[test]
fn puppies_of_one_breed_are_of_another() {
    let world = World::embedded();
    for breed in &world.breeds {
        let dog = cross(&world.table, breed, breed, &mut Rng::new(3)).unwrap();
        for ((a, b), spec) in dog.values.iter().zip(&breed.values).zip(&world.table.specs) {
            let (a, b) = (spec.from_si(*a), spec.from_si(*b));
            assert!((a - b).abs() < 0.0051, "{}: {} {a} {b}", breed.id, spec.id);
        }
        assert_eq!(dog.look, breed.look);
    }
}

// ---- heads ----

/// Folds as another function counts them, all of them by name.
fn folds_by_name(world: &World, plan: &Plan, dog: &Breed) -> usize {
    let (half, mesh) = (world.rig.half(), world.rig.mesh());
    let mirror = half.mirror();
    let is_free = |v: u32| {
        let left = if (v as usize) < half.n_half() { v as usize } else { mirror.iter().position(|&m| m == v).unwrap() };
        MAY_FOLD.iter().any(|name| half.tags[left].starts_with(name))
    };
    // A vertex of the control mesh, or the corners of one of its faces, in whose middle it stands.
    let may_fold = |v: u32| match (v as usize).checked_sub(mesh.n_vertices()) {
        None => is_free(v),
        Some(face) => mesh.indices()[3 * face..3 * face + 3].iter().any(|&v| is_free(v)),
    };
    let mut head = Deformed::default();
    world.rig.deform(&dog.values, ROUNDS, &mut head);
    let (positions, _) = evaluate_once(plan, &head.control);
    let skin = Shape { positions: &positions, indices: plan.indices() };
    skin.folds().iter().filter(|([a, b], angle)| *angle > 170.0 && !may_fold(*a) && !may_fold(*b)).count()
}

#[test]
fn folds_are_overlooked_or_found_in_a_breed() {
    let world = World::embedded();
    let space = space(&world);
    let options = PlanOptions::new(Scheme::Sqrt3, 1);
    let plan = Plan::build_with(world.rig.mesh(), &skin_tags(&world.rig), &options).unwrap_or_else(|e| panic!("{e}"));
    let mut folds = Folds::new(world.rig.clone()).unwrap_or_else(|e| panic!("{e}"));
    for seed in 0..40 {
        let dog = free(&world, &space, seed);
        assert_eq!(folds.count(&dog.values), folds_by_name(&world, &plan, &dog), "seed {seed}");
    }
    for breed in world.breeds.iter().filter(|b| !KNOWN_BREEDS.contains(&b.id.as_str())) {
        assert_eq!(folds.count(&breed.values), 0, "{}", breed.id);
    }
}

/// Far from all breeds the skin may fold; who draws dogs draws such a one again.
#[test]
fn most_random_dogs_or_some_puppies_are_no_heads() {
    let world = World::embedded();
    let space = space(&world);
    let mut folds = Folds::new(world.rig.clone()).unwrap_or_else(|e| panic!("{e}"));
    let folded = (0..100).filter(|&seed| folds.count(&free(&world, &space, seed).values) > 0).count();
    println!("{folded} of 100 random dogs fold somewhere");
    assert!(folded <= 30, "{folded} of 100 random dogs fold");
    let pairs = [("pug", "borzoi"), ("bulldog", "dachshund"), ("chihuahua", "german_shepherd"), ("bulldog", "borzoi")];
    let folded: Vec<String> = pairs
        .iter()
        .flat_map(|pair| (0..10).map(move |seed| (pair, seed)))
        .filter(|((sire, dam), seed)| folds.count(&puppy(&world, sire, dam, *seed).values) > 0)
        .map(|((sire, dam), seed)| format!("{sire} x {dam} {seed}"))
        .collect();
    assert!(folded.len() <= 3, "{folded:?}");
}
