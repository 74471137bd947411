//! Age, sex and body mass: what they do to measures that are taken on the head.
#![cfg(feature = "head")]

#[path = "support/settings.rs"]
mod settings;

use londra::measure::{Calliper, Folds, Measurement, value};
use settings::World;

struct Vet {
    world: World,
    calliper: Calliper,
}

impl Vet {
    fn new() -> Self {
        let world = World::embedded();
        let calliper = Calliper::new(world.rig.clone()).unwrap_or_else(|e| panic!("{e}"));
        Self { world, calliper }
    }

    fn measure(&mut self, breed: &str, set: &[(&str, f32)]) -> Vec<Measurement> {
        let mut values = self.world.breed(breed).values.clone();
        for (id, value) in set {
            values[self.world.row(id)] = *value;
        }
        self.calliper.measure(&values)
    }
}

/// The face of a shepherd grows by 1.37 where its cranium grows by 1.17 in length and by 1.03 in width (Onar 1999).
#[test]
fn a_face_does_not_grow_faster_than_its_cranium() {
    let mut vet = Vet::new();
    for breed in ["german_shepherd", "labrador", "pug", "borzoi", "chihuahua"] {
        let grown = vet.measure(breed, &[]);
        let mut last: Option<Vec<Measurement>> = None;
        for weeks in [4.0, 8.0, 16.0, 30.0, 51.0, 52.0] {
            let puppy = vet.measure(breed, &[("age_weeks", weeks)]);
            let part = |id: &str| value(&puppy, id) / value(&grown, id);
            let face = part("facial_length");
            for (id, grows) in [("cranial_length", 1.17_f32), ("cranial_width", 1.03)] {
                let expected = face.powf(grows.ln() / 1.37_f32.ln());
                let found = part(id);
                assert!((found / expected - 1.0).abs() < 0.02, "{breed} at {weeks}: {id} {found}, not {expected}");
            }
            if let Some(last) = last {
                for id in ["skull_length", "facial_length", "zygomatic_width"] {
                    assert!(value(&puppy, id) > value(&last, id), "{breed} at {weeks}: {id}");
                }
            }
            last = Some(puppy);
        }
    }
}

#[test]
fn a_grown_dog_is_not_the_breed() {
    let world = World::embedded();
    let columns = ["age_weeks", "sex"].map(|id| world.row(id));
    for breed in &world.breeds {
        assert_eq!(columns.map(|row| breed.values[row]), [52.0, 0.0], "{}", breed.id);
        let measures = world.rig.measures(&breed.values);
        assert_eq!(measures.facial_length, breed.values[world.row("facial_length_mm")], "{}", breed.id);
        assert_eq!(measures.masseter, breed.values[world.row("masseter_mm")], "{}", breed.id);
    }
}

#[test]
fn a_dog_is_no_larger_than_a_bitch() {
    let mut vet = Vet::new();
    for breed in ["german_shepherd", "labrador", "pug"] {
        let [bitch, dog] = [-1.0, 1.0].map(|sex| vet.measure(breed, &[("sex", sex)]));
        for id in ["skull_length", "zygomatic_width"] {
            let ratio = value(&dog, id) / value(&bitch, id);
            assert!((1.03..1.06).contains(&ratio), "{breed}: {id} {ratio}");
        }
    }
}

/// 20.5 (mass / 15 kg)^0.09 mm, cut at 17 and 24.
#[test]
fn an_eyeball_does_not_follow_body_mass() {
    let world = World::embedded();
    let (mass, eye) = (world.row("body_mass_kg"), world.row("eyeball_diameter_mm"));
    let mut following = 0;
    for breed in world.breeds.iter().filter(|b| b.set[mass] && !b.set[eye]) {
        let law = (20.5 * (breed.values[mass] / 15.0).powf(0.09)).clamp(17.0, 24.0);
        let found = 1000.0 * breed.values[eye];
        assert!((found - law).abs() < 0.35, "{}: {found} mm, the law says {law}", breed.id);
        following += 1;
    }
    assert!(following > 50, "{following}");
}

#[test]
fn a_puppy_is_no_head() {
    let world = World::embedded();
    let mut folds = Folds::new(world.rig.clone()).unwrap_or_else(|e| panic!("{e}"));
    let age = world.row("age_weeks");
    let mut folded = Vec::new();
    for breed in &world.breeds {
        for weeks in [6.0, 12.0, 26.0] {
            let mut values = breed.values.clone();
            values[age] = weeks;
            if folds.count(&values) > 0 {
                folded.push(format!("{} at {weeks}", breed.id));
            }
        }
    }
    println!("{} of {} puppies fold somewhere: {folded:?}", folded.len(), 3 * world.breeds.len());
    assert!(folded.len() * 100 <= 25 * 3 * world.breeds.len(), "{folded:?}");
}
