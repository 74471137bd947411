//! DogFACS units on real heads: each moves the landmarks that its row names, in that direction and by that much for the
//! head's size, on every breed, and a unit of one side leaves the other where it is.
//!
//! `cargo test --test units -- --nocapture` prints where each landmark goes.

#![cfg(feature = "head")]

use glam::Vec3;
use londra::anatomy::{Breed, ParamTable, library};
use londra::frame::{Layers, Pipeline};
use londra::measure::{Side as Where, skin_landmarks};
use londra::motion::{Activation, Axis, Channel, Group, Library, Pose, Sides};
use londra::rig::{Deformed, Rig, deform};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Of every ear type and length of face.
const BREEDS: [&str; 9] =
    ["german_shepherd", "labrador", "pug", "borzoi", "bulldog", "beagle", "chihuahua", "saint_bernard", "bull_terrier"];
/// Beyond the row's bounds, millimetres on the 200 mm head and a part of the larger bound: heads differ in more than size.
const SLACK: (f32, f32) = (0.6, 0.30);

struct World {
    table: ParamTable,
    library: Library,
    pipeline: Pipeline,
}

type Points = BTreeMap<(String, Where), Vec3>;

impl World {
    fn new() -> Self {
        let table = ParamTable::embedded().expect("the table is there");
        let rig = Arc::new(Rig::embedded(&table).expect("the rig is there"));
        let library = Library::embedded().expect("the tables are there");
        let mut pipeline = Pipeline::new(rig, 1).expect("level 1");
        pipeline.set_layers(Layers::parse("skin,eyes,tongue").expect("layers")).expect("they are there");
        Self { table, library, pipeline }
    }

    fn points(&mut self, breed: &Breed, asked: &Activation) -> Points {
        let pose = self.library.pose_of(asked);
        self.posed(breed, pose)
    }

    fn posed(&mut self, breed: &Breed, pose: Pose) -> Points {
        self.pipeline.set_pose(pose);
        let rig = self.pipeline.rig().clone();
        let frame = self.pipeline.update(breed);
        skin_landmarks(&rig, &breed.values, &frame).into_iter().map(|l| ((l.id, l.side), l.position)).collect()
    }

    /// How far the left ear's opening is turned outwards about the ear's length, degrees: the ring where its two margins are
    /// farthest from the base without lying behind a fold.
    fn opening(&mut self, breed: &Breed, asked: &Activation) -> f32 {
        const RING: usize = 2;
        let rig = self.pipeline.rig().clone();
        let h = rig.plan().handles();
        let mut look = |pose: Pose| {
            self.pipeline.set_pose(pose);
            let frame = self.pipeline.update(breed);
            let middle = |ring: &[u16]| ring.iter().map(|&v| frame.control[usize::from(v)]).sum::<Vec3>() / 12.0;
            let across = frame.control[usize::from(h.a[RING][0])] - frame.control[usize::from(h.a[RING][6])];
            (middle(&h.a[RING]) - middle(&h.ear_base), across)
        };
        let (along, was) = look(Pose::default());
        let (_, now) = look(self.library.pose_of(asked));
        let along = along.normalize_or(Vec3::Y);
        let [was, now] = [was, now].map(|v| v.reject_from(along).normalize_or_zero());
        along.dot(was.cross(now)).atan2(was.dot(now)).to_degrees()
    }

    /// Metres of a millimetre of the 200 mm head.
    fn unit(&self, breed: &Breed) -> f32 {
        let rig = self.pipeline.rig();
        let mut head = Deformed::default();
        rig.deform(&breed.values, deform::ROUNDS, &mut head);
        rig.of_head(&breed.values, &mut head).unit
    }
}

fn along(axis: Axis, d: Vec3) -> f32 {
    match axis {
        Axis::X => d.x,
        Axis::Y => d.y,
        Axis::Z => d.z,
    }
}

#[test]
fn a_unit_moves_its_landmarks_another_way_than_its_row_says() {
    let mut world = World::new();
    let units = world.library.units.units.clone();
    let mut wrong = Vec::new();
    let mut widest = 0.0f32;
    for id in BREEDS {
        let breed = library::breed(&world.table, id).expect(id);
        let unit_m = world.unit(&breed);
        let rest = world.points(&breed, &Activation::default());
        for (number, unit) in units.iter().enumerate() {
            let mut asked = Activation::default();
            // A tongue goes to one side only.
            *asked.get_mut(number) = if unit.group == Group::Tongue { [1.0, 0.0] } else { [1.0; 2] };
            let posed = world.points(&breed, &asked);
            let mm = |key: &(String, Where)| (posed[key] - rest[key]) / unit_m;
            let bounds = |least: f32, most: f32| {
                let slack = SLACK.0 + SLACK.1 * least.abs().max(most.abs());
                least - slack..=most + slack
            };
            for motion in &unit.landmarks {
                let keys = [Where::Left, Where::Median].map(|side| (motion.0.clone(), side));
                let key = keys.into_iter().find(|k| rest.contains_key(k)).unwrap_or_else(|| panic!("{}", motion.0));
                let value = along(motion.1, mm(&key));
                let line = format!(
                    "{id:16} {:9} {} {:?} {value:7.1} of {} to {}",
                    unit.id, motion.0, motion.1, motion.2, motion.3
                );
                println!("{line}");
                if !bounds(motion.2, motion.3).contains(&value) {
                    wrong.push(line);
                }
            }
            if let Some((least, most)) = unit.opening_deg {
                let value = world.opening(&breed, &asked);
                widest = widest.max(value);
                let line = format!("{id:16} {:9} the ear's opening {value:7.1} of {least} to {most} degrees", unit.id);
                println!("{line}");
                if !(least..=most).contains(&value) {
                    wrong.push(line);
                }
            }
            for gap in &unit.gaps {
                let key = |id: &String| {
                    [Where::Median, Where::Left]
                        .map(|s| (id.clone(), s))
                        .into_iter()
                        .find(|k| rest.contains_key(k))
                        .expect("there")
                };
                let (a, b) = (key(&gap.0), key(&gap.1));
                let value = (posed[&a].distance(posed[&b]) - rest[&a].distance(rest[&b])) / unit_m;
                let line =
                    format!("{id:16} {:9} {} to {} {value:7.1} of {} to {}", unit.id, gap.0, gap.1, gap.2, gap.3);
                println!("{line}");
                if !bounds(gap.2, gap.3).contains(&value) {
                    wrong.push(line);
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{} wrong:\n{}", wrong.len(), wrong.join("\n"));
    assert!(widest > 70.0, "no ear's opening turns farther than {widest} degrees");
}

#[test]
fn a_unit_of_one_side_moves_the_other() {
    let mut world = World::new();
    let units = world.library.units.units.clone();
    let breed = library::breed(&world.table, "german_shepherd").expect("it is there");
    let rest = world.points(&breed, &Activation::default());
    for (number, unit) in units.iter().enumerate().filter(|(_, u)| u.sides == Sides::Each && u.group != Group::Tongue) {
        let mut asked = Activation::default();
        *asked.get_mut(number) = [1.0, 0.0];
        let posed = world.points(&breed, &asked);
        let (mut left, mut right) = (0.0f32, 0.0f32);
        for (key, p) in &posed {
            let moved = p.distance(rest[key]) * 1000.0;
            match key.1 {
                Where::Left => left = left.max(moved),
                Where::Right => right = right.max(moved),
                Where::Median => {}
            }
        }
        println!("{:9} left {left:5.1} mm, right {right:5.1} mm", unit.id);
        assert!(left > 0.5, "{} moves nothing", unit.id);
        assert!(right < 0.25 * left, "{}: left {left} mm, right {right} mm", unit.id);
    }
}

#[test]
fn both_sides_together_are_no_mirror_image() {
    let mut world = World::new();
    let units = world.library.units.units.clone();
    let breed = library::breed(&world.table, "beagle").expect("it is there");
    for (number, unit) in units.iter().enumerate().filter(|(_, u)| u.sides != Sides::Median && u.id != "AD37") {
        let mut asked = Activation::default();
        *asked.get_mut(number) = [1.0; 2];
        let posed = world.points(&breed, &asked);
        for ((id, side), p) in posed.iter().filter(|((_, side), _)| *side == Where::Left) {
            let _ = side;
            let image = posed[&(id.clone(), Where::Right)];
            let off = Vec3::new(-image.x, image.y, image.z).distance(*p);
            assert!(off < 2e-6, "{}: {id} is off by {off} m", unit.id);
        }
    }
}

/// Height of the upper lid's margin over the line between its corners, as a part of that line: in its middle and, the mean
/// of both, towards its corners.
fn upper_lid(world: &mut World, breed: &Breed, closed: f32) -> [f32; 2] {
    let mut pose = Pose::default();
    *pose.channel_mut(Channel::LidClosed) = [closed; 2];
    world.pipeline.set_pose(pose);
    let rig = world.pipeline.rig().clone();
    let margin = rig.plan().handles().er;
    let frame = world.pipeline.update(breed);
    let at = |k: usize| frame.control[usize::from(margin[k])];
    let (medial, lateral) = (at(0), at(6));
    let line = lateral - medial;
    // Upwards, across the line: that of the rims' middle at any closing is nearly the orbit's own.
    let up = Vec3::Y.reject_from(line).normalize_or(Vec3::Y);
    let above = |k: usize| up.dot(at(k) - medial) / line.length();
    [above(3), 0.5 * (above(1) + above(5))]
}

/// How far a lid is closed, and how much of the arch of an open eye it has at least: nearly all until it is half closed, and
/// no straight line before it nearly meets the other.
const KEPT: [(f32, f32); 6] = [(0.2, 0.9), (0.3, 0.85), (0.4, 0.75), (0.5, 0.6), (0.6, 0.4), (0.7, 0.1)];

#[test]
fn a_lid_that_is_half_closed_cuts_straight_across_the_eye() {
    let mut world = World::new();
    for id in BREEDS {
        let breed = library::breed(&world.table, id).expect(id);
        let [middle, aside] = upper_lid(&mut world, &breed, 0.0);
        let open = middle - aside;
        for (closed, least) in KEPT {
            let [middle, aside] = upper_lid(&mut world, &breed, closed);
            let kept = (middle - aside) / open;
            println!("{id:16} closed {closed}: {kept:.2} of its arch");
            assert!(kept > least, "{id}: closed {closed}, {kept:.2} of the arch of an open eye");
        }
    }
}

/// How much lower over the margin of a raised upper lip the skin beside it lies than at rest, at most, millimetres on the
/// 200 mm head.
const CURTAIN: f32 = 4.5;

#[test]
fn skin_hangs_before_the_teeth_that_a_raised_lip_bares() {
    let mut world = World::new();
    let snarl = world.library.units.find("AU109_110").expect("it is there").0;
    let mut asked = Activation::default();
    *asked.get_mut(snarl) = [1.0; 2];
    for id in BREEDS {
        let breed = library::breed(&world.table, id).expect(id);
        let unit_m = world.unit(&breed);
        let rig = world.pipeline.rig().clone();
        let rows = rig.plan().handles().s;
        let mut beside = |pose: Pose| {
            world.pipeline.set_pose(pose);
            let frame = world.pipeline.update(&breed);
            [4, 5, 6].map(|i| frame.control[usize::from(rows[i][8])].y - frame.control[usize::from(rows[i][9])].y)
        };
        let rest = beside(Pose::default());
        let raised = beside(world.library.pose_of(&asked));
        for (rest, raised) in rest.into_iter().zip(raised) {
            let lower = (rest - raised) / unit_m;
            println!("{id:16} {lower:.1} mm lower over the margin");
            assert!(lower < CURTAIN, "{id}: {lower:.1} mm");
        }
    }
}

/// Up for back at most, and what a lip that is raised beside it brings along, millimetres on the 200 mm head: the zygomaticus
/// of a dog runs back to the ear and no cheek lifts its corner, as it does in man.
const UP: (f32, f32) = (0.5, 1.0);

#[test]
fn a_dog_smiles_as_people_do() {
    let mut world = World::new();
    let head = [Channel::HeadTurn, Channel::HeadNod, Channel::HeadTilt, Channel::HeadForward];
    for id in BREEDS {
        let breed = library::breed(&world.table, id).expect(id);
        let unit_m = world.unit(&breed);
        let rest = world.points(&breed, &Activation::default());
        let expressions = world.library.expressions.clone();
        for expression in &expressions {
            let mut pose = world.library.pose_of(&expression.still());
            // The head's own motion is none of the mouth's.
            head.into_iter().for_each(|c| *pose.channel_mut(c) = [0.0; 2]);
            let posed = world.posed(&breed, pose);
            for side in [Where::Left, Where::Right] {
                let key = ("K10".to_owned(), side);
                let d = (posed[&key] - rest[&key]) / unit_m;
                let most = UP.0 * (-d.z).max(0.0) + UP.1;
                assert!(d.y <= most, "{id} {}: up {:.1}, back {:.1}", expression.id, d.y, -d.z);
            }
        }
    }
}
