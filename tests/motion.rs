//! What the head does: tables, rules, notation, expressions, clips, life. No mesh is needed for any of it.

use londra::math::rng::Rng;
use londra::motion::*;

fn tables() -> (MuscleTable, UnitTable, JointLimits) {
    let muscles = MuscleTable::embedded().expect("muscles");
    let units = UnitTable::parse("rigs/units.ron", UNITS, &muscles).expect("units");
    (muscles, units, JointLimits::embedded().expect("limits"))
}

fn with(units: &UnitTable, wanted: &[(&str, f32)]) -> Activation {
    let mut activation = Activation::default();
    for &(word, value) in wanted {
        let (unit, side) = units.find(word).expect("a unit");
        activation.set(unit, side, value);
    }
    activation
}

fn resolved(units: &UnitTable, wanted: &[(&str, f32)]) -> (Activation, Vec<Overruled>) {
    let mut told = Vec::new();
    let out = units.resolve(&with(units, wanted), |o| told.push(o));
    (out, told)
}

fn value(units: &UnitTable, activation: &Activation, id: &str) -> [f32; 2] {
    activation.get(units.index_of(id).expect("a unit"))
}

fn random(units: &UnitTable, rng: &mut Rng) -> Activation {
    let mut activation = Activation::default();
    for (number, unit) in units.units.iter().enumerate() {
        // Many at rest, some at the ends, the rest between.
        let mut one = || (rng.between(-1.0, 1.5)).clamp(0.0, 1.0);
        let left = one();
        let right = if unit.sides == Sides::Each { one() } else { left };
        *activation.get_mut(number) = [left, right];
    }
    activation
}

#[test]
fn a_unit_moves_nothing() {
    let (_, units, limits) = tables();
    for (number, unit) in units.units.iter().enumerate() {
        let mut activation = Activation::default();
        *activation.get_mut(number) = [1.0; 2];
        let pose = units.pose(&activation, &limits);
        assert_eq!(pose.is_rest(), unit.group == Group::Gross, "{}", unit.id);
        assert_eq!(unit.group == Group::Gross, !unit.clip.is_empty(), "{}", unit.id);
        // Nobody can overlook what a rig does without.
        assert!(!unit.criterion.is_empty() && !unit.source.is_empty(), "{}", unit.id);
    }
}

#[test]
fn a_unit_alone_leaves_the_limits() {
    let (_, units, limits) = tables();
    for unit in &units.units {
        for drive in &unit.drives {
            let (least, most) = match drive.target {
                Target::Channel(channel) => limits.of(channel).range,
                Target::Muscle(_) => (0.0, 1.0),
            };
            assert!((least..=most).contains(&drive.value), "{}: {} outside {least} to {most}", unit.id, drive.value);
        }
    }
}

#[test]
fn one_side_of_a_unit_moves_the_other() {
    let (muscles, units, limits) = tables();
    for (number, _) in units.units.iter().enumerate().filter(|(_, u)| u.sides == Sides::Each) {
        let mut left = Activation::default();
        left.set(number, Side::Left, 1.0);
        let mut right = Activation::default();
        right.set(number, Side::Right, 1.0);
        let (left, right) = (units.pose(&left, &limits), units.pose(&right, &limits));
        for muscle in 0..muscles.muscles.len() {
            assert_eq!(left.muscle(muscle)[1], 0.0);
            assert_eq!(left.muscle(muscle)[0], right.muscle(muscle)[1]);
        }
        for &channel in Channel::ALL {
            let ([l, r], [other_l, other_r]) = (left.channel(channel), right.channel(channel));
            let sign = if channel.is_lateral() { -1.0 } else { 1.0 };
            assert_eq!([l, r], [sign * other_r, sign * other_l], "{}", channel.id());
            assert!(channel.is_median() || r == 0.0, "{}", channel.id());
        }
    }
}

#[test]
fn landmark_motions_are_missing_or_name_no_landmark() {
    let (_, units, _) = tables();
    for unit in units.units.iter().filter(|u| u.group != Group::Gross && u.id != "EAD104") {
        assert!(!unit.landmarks.is_empty() || !unit.gaps.is_empty(), "{}", unit.id);
        for motion in &unit.landmarks {
            assert!(motion.0.len() == 3 && motion.0.starts_with('K'), "{}: {}", unit.id, motion.0);
        }
    }
}

#[test]
fn the_corner_of_the_mouth_goes_up_more_than_back() {
    let (_, units, _) = tables();
    let corner = |id: &str, axis: Axis| {
        let unit = &units.units[units.index_of(id).expect("a unit")];
        let motion = unit.landmarks.iter().find(|m| m.0 == "K10" && m.1 == axis).expect("the corner's motion");
        (motion.2, motion.3)
    };
    // A dog draws the corner back; a human smile would lift it. At most half as far up as back.
    assert!(corner("AU12", Axis::Y).1 <= 0.5 * -corner("AU12", Axis::Z).0);
}

#[test]
fn what_is_ruled_out_stays_or_nobody_is_told() {
    let (_, units, limits) = tables();
    let (out, told) = resolved(&units, &[("AU27", 0.5), ("AU26", 1.0)]);
    assert_eq!(value(&units, &out, "AU26"), [0.0; 2], "57 degrees by half are more than 20");
    assert_eq!(value(&units, &out, "AU25"), [1.0; 2], "an open jaw parts the lips");
    assert_eq!(told.len(), 2);
    assert_eq!(units.units[told[0].unit].id, "AU26");
    assert_eq!(units.units[told[0].by].id, "AU27");
    assert_eq!(told[0].from, 1.0);
    let (out, _) = resolved(&units, &[("AU27", 0.3), ("AU26", 1.0)]);
    assert_eq!(units.pose(&out, &limits).median(Channel::JawGape), 20.0);

    let (out, _) = resolved(&units, &[("AU109+110", 0.6), ("AU110R", 0.9), ("AU110L", 0.6)]);
    assert_eq!(value(&units, &out, "AU110"), [0.0, 0.9]);
    let (out, _) = resolved(&units, &[("AU12", 0.9), ("AU118", 0.6)]);
    assert!(
        (value(&units, &out, "AU12")[0] - 0.6).abs() < 1e-6 && (value(&units, &out, "AU118")[0] - 0.4).abs() < 1e-6
    );
    let (out, _) = resolved(&units, &[("EAD101L", 1.0), ("EAD103", 0.6)]);
    assert_eq!(value(&units, &out, "EAD101"), [1.0, 0.0]);
    assert_eq!(value(&units, &out, "EAD103"), [0.0, 0.6], "each ear for itself");
    let (out, told) = resolved(&units, &[("AD40", 0.4), ("AD126", 1.0)]);
    assert_eq!(value(&units, &out, "AD40"), [0.0; 2]);
    assert!(told.iter().any(|o| units.rules[o.rule].why.contains("pant and sniff")));
    let (out, _) = resolved(&units, &[("AU143", 0.4), ("AU145", 1.0)]);
    assert_eq!(units.pose(&out, &limits).channel(Channel::LidClosed), [1.0; 2]);
}

#[test]
fn resolving_twice_changes_something_or_leaves_the_range() {
    let (_, units, _) = tables();
    let mut rng = Rng::new(23);
    for _ in 0..2000 {
        let asked = random(&units, &mut rng);
        let once = units.resolve(&asked, |_| ());
        let twice = units.resolve(&once, |_| ());
        for (number, unit) in units.units.iter().enumerate() {
            let (a, b) = (once.get(number), twice.get(number));
            assert!(
                a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-6 && (0.0..=1.0).contains(a)),
                "{} {a:?} {b:?}",
                unit.id
            );
            assert!(unit.sides == Sides::Each || unit.sides == Sides::Together || a[0] == a[1], "{}", unit.id);
        }
    }
}

#[test]
fn a_small_change_of_what_is_asked_makes_the_pose_jump() {
    let (muscles, units, limits) = tables();
    let mut rng = Rng::new(5);
    const STEP: f32 = 1e-3;
    for _ in 0..300 {
        let (from, to) = (random(&units, &mut rng), random(&units, &mut rng));
        let mut before: Option<Pose> = None;
        for i in 0..=1000 {
            let mut asked = Activation::default();
            asked.add(&from, 1.0 - i as f32 * STEP);
            asked.add(&to, i as f32 * STEP);
            let pose = units.pose(&units.resolve(&asked, |_| ()), &limits);
            if let Some(before) = before {
                for &channel in Channel::ALL {
                    let (least, most) = limits.of(channel).range;
                    // A lead of a quarter changes a value four times as fast as it is asked; tongues have three ways.
                    let bound = 40.0 * STEP * (most - least);
                    for (a, b) in before.channel(channel).into_iter().zip(pose.channel(channel)) {
                        assert!((a - b).abs() < bound, "{}: {a} to {b}", channel.id());
                    }
                }
                for muscle in 0..muscles.muscles.len() {
                    let (a, b) = (before.muscle(muscle)[0], pose.muscle(muscle)[0]);
                    assert!((a - b).abs() < 40.0 * STEP, "{}: {a} to {b}", muscles.muscles[muscle].id);
                }
            }
            before = Some(pose);
        }
    }
}

#[test]
fn what_is_no_number_reaches_the_pose() {
    let (_, units, limits) = tables();
    for wrong in [f32::NAN, f32::INFINITY, -f32::INFINITY, 7.0, -3.0] {
        let mut activation = Activation::default();
        (0..units.units.len()).for_each(|unit| *activation.get_mut(unit) = [wrong; 2]);
        let out = units.resolve(&activation, |_| ());
        let pose = units.pose_at(&out, wrong.into(), &limits);
        for &channel in Channel::ALL {
            let (least, most) = limits.of(channel).range;
            assert!(pose.channel(channel).iter().all(|v| (least..=most).contains(v)), "{wrong} {}", channel.id());
        }
    }
}

#[test]
fn notation_means_something_else_when_it_is_read_back() {
    let (_, units, _) = tables();
    let read = |text: &str| units.parse_notation(text).unwrap_or_else(|e| panic!("{text}: {e}"));
    let expect = with(&units, &[("AU101", 1.0), ("AU12", 0.4), ("EAD103", 1.0)]);
    assert_eq!(read("101+12B+EAD103"), expect);
    assert_eq!(read(" au101 + 12 b+ead103 "), expect);
    assert_eq!(units.notation(&expect), "101+12B+EAD103");
    assert_eq!(read("109+110C+126"), with(&units, &[("AU109_110", 0.6), ("AD126", 1.0)]));
    assert_eq!(read("AU109+110RB"), with(&units, &[("AU109_110R", 0.4)]));
    assert_eq!(read("101LB+101R"), with(&units, &[("AU101L", 0.4), ("AU101R", 1.0)]));
    assert_eq!(read("101BL"), read("101LB"));
    assert_eq!(read("110E"), with(&units, &[("AU110", 1.0)]));
    assert_eq!(read("  "), Activation::default());
    let mut rng = Rng::new(1);
    for _ in 0..500 {
        let mut activation = random(&units, &mut rng);
        for unit in 0..units.units.len() {
            for value in activation.get_mut(unit) {
                *value = (*value * 5.0).round() / 5.0;
            }
        }
        let text = units.notation(&activation);
        assert_eq!(read(&text), activation, "{text}");
        assert_eq!(units.notation(&read(&text)), text);
    }
}

#[test]
fn wrong_notation_is_read_or_its_mistake_is_not_told() {
    let (_, units, _) = tables();
    let told = |text: &str| units.parse_notation(text).expect_err(text).to_string();
    assert_eq!(told("101+112"), "character 5: there is no unit '112'; did you mean AU110 or AU12 or AU116?");
    assert_eq!(told("101++12"), "character 5: a code such as 101, 12B or EAD103L is missing");
    assert_eq!(told("101+"), "character 5: a code such as 101, 12B or EAD103L is missing");
    assert_eq!(told("12+109"), "character 4: 109 is not there alone: 109+110 is one unit");
    assert_eq!(told("12F"), "character 1: 'F' is neither a side (L or R) nor an intensity (A to E)");
    assert_eq!(told("12BB"), "character 1: 'BB' is neither a side (L or R) nor an intensity (A to E)");
    assert_eq!(told("101 + 26L"), "character 7: AU26 is not there for one side alone: write AU26");
    assert_eq!(told("101L+101"), "character 6: AU101 is there twice");
    assert!(told("103").contains("EAD103"));
    for text in ["+", "é", "AU", "1e9", "109+110+109", "L", "_", "٣"] {
        told(text);
    }
}

#[test]
fn a_word_names_another_unit() {
    let (_, units, _) = tables();
    let id = |word: &str| units.find(word).map(|(unit, side)| (units.units[unit].id.as_str(), side));
    assert_eq!(id("AU101"), Ok(("AU101", Side::Both)));
    assert_eq!(id("ead103l"), Ok(("EAD103", Side::Left)));
    assert_eq!(id("AU109+110R"), Ok(("AU109_110", Side::Right)));
    assert_eq!(id("AU26L"), Err(UnitError::OneSided { id: "AU26".into() }));
    assert!(matches!(id("AU102"), Err(UnitError::Unknown { near, .. }) if near.contains(&"AU101".to_owned())));
    assert!(id("").is_err() && id("L").is_err() && id("ß").is_err());
}

#[test]
fn a_wrong_table_is_read_or_its_row_is_not_named() {
    let (muscles, _, _) = tables();
    let told = |from: &str, to: &str| {
        let text = UNITS.replacen(from, to, 1);
        assert_ne!(text, UNITS, "{from}");
        UnitTable::parse("u.ron", &text, &muscles).expect_err(to).to_string()
    };
    assert_eq!(told("\"laom\"", "\"laon\""), "u.ron: AU101: 'laon' is neither a channel nor a muscle");
    assert_eq!(told("id: \"AU145\"", "id: \"AU143\""), "u.ron: AU143: is there twice");
    assert!(
        told("(\"AU27\", 57)", "(\"AU28\", 57)")
            .starts_with("u.ron: AU28: is no unit; did you mean AU25 or AU26 or AU27")
    );
    assert!(told("version: 1", "version: 2").contains("this program reads 1"));
    assert!(told("hz: 5.5", "hz: 5500").contains("allowed 0.1 to 20"));
    assert!(told("clip: \"bark\",", "").contains("drives nothing"));
    assert!(told("units: [", "units: ").starts_with("u.ron:"));
}

/// The published table, where it is at hand.
#[test]
fn a_published_code_is_missing() {
    let Ok(folder) = std::env::var("LONDRA_REFERENCE") else { return };
    let text = std::fs::read_to_string(format!("{folder}/anatomy/dogfacs.csv")).expect("the table of codes");
    let (_, units, _) = tables();
    let mut n = 0;
    for line in text.lines().skip(1) {
        let code = line.split(',').next().unwrap_or_default();
        assert!(units.units.iter().any(|u| u.label == code), "{code}");
        n += 1;
    }
    assert_eq!(n, units.units.len());
}
