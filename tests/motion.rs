//! What the head does: tables, rules, notation, expressions, clips, life. No mesh is needed for any of it.
#![cfg(feature = "head")]

use londra::math::fnv::Fnv64;
use londra::math::rng::Rng;
use londra::motion::*;
use std::fmt::Write as _;

fn library() -> Library {
    Library::embedded().expect("tables that can be read")
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
    let library = library();
    let Library { units, .. } = &library;
    for (number, unit) in units.units.iter().enumerate() {
        let mut activation = Activation::default();
        *activation.get_mut(number) = [1.0; 2];
        let pose = library.pose_of(&activation);
        assert_eq!(pose.is_rest(), unit.group == Group::Gross, "{}", unit.id);
        assert_eq!(unit.group == Group::Gross, !unit.clip.is_empty(), "{}", unit.id);
        // Nobody can overlook what a rig does without.
        assert!(!unit.criterion.is_empty() && !unit.source.is_empty(), "{}", unit.id);
    }
}

#[test]
fn a_unit_alone_leaves_the_limits() {
    let library = library();
    let Library { units, limits, .. } = &library;
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
    let library = library();
    let Library { muscles, units, .. } = &library;
    for (number, _) in units.units.iter().enumerate().filter(|(_, u)| u.sides == Sides::Each) {
        let mut left = Activation::default();
        left.set(number, Side::Left, 1.0);
        let mut right = Activation::default();
        right.set(number, Side::Right, 1.0);
        let (left, right) = (library.pose_of(&left), library.pose_of(&right));
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
    let units = &library().units;
    for unit in units.units.iter().filter(|u| u.group != Group::Gross) {
        assert!(!unit.landmarks.is_empty() || !unit.gaps.is_empty() || unit.opening_deg.is_some(), "{}", unit.id);
        for motion in &unit.landmarks {
            assert!(motion.0.len() == 3 && motion.0.starts_with('K'), "{}: {}", unit.id, motion.0);
        }
    }
}

#[test]
fn the_corner_of_the_mouth_goes_up_more_than_back() {
    let units = &library().units;
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
    let library = library();
    let Library { units, .. } = &library;
    let (out, told) = resolved(units, &[("AU27", 0.5), ("AU26", 1.0)]);
    assert_eq!(value(units, &out, "AU26"), [0.0; 2], "57 degrees by half are more than 20");
    assert_eq!(value(units, &out, "AU25"), [1.0; 2], "an open jaw parts the lips");
    assert_eq!(told.len(), 2);
    assert_eq!(units.units[told[0].unit].id, "AU26");
    assert_eq!(units.units[told[0].by].id, "AU27");
    assert_eq!(told[0].from, 1.0);
    let (out, _) = resolved(units, &[("AU27", 0.3), ("AU26", 1.0)]);
    assert_eq!(library.pose_of(&out).median(Channel::JawGape), 20.0);

    let (out, _) = resolved(units, &[("AU109+110", 0.6), ("AU110R", 0.9), ("AU110L", 0.6)]);
    assert_eq!(value(units, &out, "AU110"), [0.0, 0.9]);
    let (out, _) = resolved(units, &[("AU12", 0.9), ("AU118", 0.6)]);
    assert!((value(units, &out, "AU12")[0] - 0.6).abs() < 1e-6 && (value(units, &out, "AU118")[0] - 0.4).abs() < 1e-6);
    let (out, _) = resolved(units, &[("EAD101L", 1.0), ("EAD103", 0.6)]);
    assert_eq!(value(units, &out, "EAD101"), [1.0, 0.0]);
    assert_eq!(value(units, &out, "EAD103"), [0.0, 0.6], "each ear for itself");
    let (out, told) = resolved(units, &[("AD40", 0.4), ("AD126", 1.0)]);
    assert_eq!(value(units, &out, "AD40"), [0.0; 2]);
    assert!(told.iter().any(|o| units.rules[o.rule].why.contains("pant and sniff")));
    let (out, _) = resolved(units, &[("AU143", 0.4), ("AU145", 1.0)]);
    assert_eq!(library.pose_of(&out).channel(Channel::LidClosed), [1.0; 2]);
}

#[test]
fn resolving_twice_changes_something_or_leaves_the_range() {
    let units = &library().units;
    let mut rng = Rng::new(23);
    for _ in 0..2000 {
        let asked = random(units, &mut rng);
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
    let library = library();
    let Library { muscles, units, limits, .. } = &library;
    let mut rng = Rng::new(5);
    const STEP: f32 = 1e-3;
    for _ in 0..300 {
        let (from, to) = (random(units, &mut rng), random(units, &mut rng));
        let mut before: Option<Pose> = None;
        for i in 0..=1000 {
            let mut asked = Activation::default();
            asked.add(&from, 1.0 - i as f32 * STEP);
            asked.add(&to, i as f32 * STEP);
            let pose = library.pose_of(&asked);
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
    let library = library();
    let Library { units, limits, .. } = &library;
    for wrong in [f32::NAN, f32::INFINITY, -f32::INFINITY, 7.0, -3.0] {
        let mut activation = Activation::default();
        (0..units.units.len()).for_each(|unit| *activation.get_mut(unit) = [wrong; 2]);
        let pose = library.pose(&activation.into(), wrong.into(), |_| ());
        for &channel in Channel::ALL {
            let (least, most) = limits.of(channel).range;
            assert!(pose.channel(channel).iter().all(|v| (least..=most).contains(v)), "{wrong} {}", channel.id());
        }
    }
}

#[test]
fn notation_means_something_else_when_it_is_read_back() {
    let units = &library().units;
    let read = |text: &str| units.parse_notation(text).unwrap_or_else(|e| panic!("{text}: {e}"));
    let expect = with(units, &[("AU101", 1.0), ("AU12", 0.4), ("EAD103", 1.0)]);
    assert_eq!(read("101+12B+EAD103"), expect);
    assert_eq!(read(" au101 + 12 b+ead103 "), expect);
    assert_eq!(units.notation(&expect), "101+12B+EAD103");
    assert_eq!(read("109+110C+126"), with(units, &[("AU109_110", 0.6), ("AD126", 1.0)]));
    assert_eq!(read("AU109+110RB"), with(units, &[("AU109_110R", 0.4)]));
    assert_eq!(read("101LB+101R"), with(units, &[("AU101L", 0.4), ("AU101R", 1.0)]));
    assert_eq!(read("101BL"), read("101LB"));
    assert_eq!(read("110E"), with(units, &[("AU110", 1.0)]));
    assert_eq!(read("  "), Activation::default());
    let mut rng = Rng::new(1);
    for _ in 0..500 {
        let mut activation = random(units, &mut rng);
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
    let units = &library().units;
    let told = |text: &str| units.parse_notation(text).expect_err(text).to_string();
    assert_eq!(told("101+112"), "character 5: there is no unit '112' (did you mean AU110 or AU12 or AU116?)");
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
    let units = &library().units;
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
    let muscles = library().muscles;
    let told = |from: &str, to: &str| {
        let text = UNITS.replacen(from, to, 1);
        assert_ne!(text, UNITS, "{from}");
        UnitTable::parse("u.ron", &text, &muscles).expect_err(to).to_string()
    };
    assert_eq!(told("\"laom\"", "\"laon\""), "u.ron: AU101: 'laon' is neither a channel nor a muscle");
    assert_eq!(told("id: \"AU145\"", "id: \"AU143\""), "u.ron: AU143: is there twice");
    assert!(
        told("(\"AU27\", 57)", "(\"AU28\", 57)")
            .starts_with("u.ron: AU28: is no unit (did you mean AU25 or AU26 or AU27?)")
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
    let units = &library().units;
    let mut n = 0;
    for line in text.lines().skip(1) {
        let code = line.split(',').next().unwrap_or_default();
        assert!(units.units.iter().any(|u| u.label == code), "{code}");
        n += 1;
    }
    assert_eq!(n, units.units.len());
}

#[test]
fn a_published_expression_differs_from_its_recipe() {
    let Ok(folder) = std::env::var("LONDRA_REFERENCE") else { return };
    let text = std::fs::read_to_string(format!("{folder}/anatomy/expressions.csv")).expect("the published recipes");
    let library = library();
    let mut found = 0;
    for line in text.lines().skip(1).filter(|line| !line.starts_with("neutral")) {
        let cells: Vec<&str> = line.split(',').collect();
        let expression = library.expressions.iter().find(|e| e.label == cells[0]).unwrap_or_else(|| panic!("{line}"));
        let unit = units_number(&library, cells[1]);
        let part = expression.parts.iter().find(|p| p.unit == unit).unwrap_or_else(|| panic!("{line}"));
        let number = |i: usize| cells[i].parse::<f64>().expect("a number");
        assert_eq!(part.intensity, number(2) as f32, "{line}");
        assert_eq!([part.onset_s, part.hold_s, part.offset_s], [number(3), number(4), number(5)], "{line}");
        found += 1;
    }
    assert!(found > 80);
}

fn units_number(library: &Library, word: &str) -> usize {
    library.units.find(word).expect(word).0
}

/// The biggest step of any channel, as a part of its range, and of any muscle, over the seconds of a motion.
fn biggest_step(library: &Library, seconds: f64, pose_at: impl Fn(f64) -> Pose) -> (f32, f64, String) {
    const STEP: f64 = 1.0 / 240.0;
    let mut worst = (0.0, 0.0, String::new());
    let mut before = pose_at(0.0);
    for i in 1..=(seconds / STEP).ceil() as u32 {
        let time = f64::from(i) * STEP;
        let now = pose_at(time);
        for &channel in Channel::ALL {
            let (least, most) = library.limits.of(channel).range;
            for (a, b) in before.channel(channel).into_iter().zip(now.channel(channel)) {
                let step = (a - b).abs() / (most - least);
                if step > worst.0 {
                    worst = (step, time, channel.id().to_owned());
                }
            }
        }
        before = now;
    }
    worst
}

#[test]
fn an_expression_jumps_or_raises_the_corner_of_the_mouth_or_is_nothing() {
    let library = library();
    let units = &library.units.units;
    let mean = |unit: usize, axis: Axis| {
        let of = units[unit].landmarks.iter().find(|m| m.0 == "K10" && m.1 == axis);
        of.map_or(0.0, |m| 0.5 * (m.2 + m.3))
    };
    for expression in &library.expressions {
        assert_eq!(library.pose_of(&expression.still()).is_rest(), expression.id == "neutral", "{}", expression.id);
        assert!(expression.at(-0.1).is_rest() && expression.at(expression.seconds() + 0.1).is_rest());
        let step =
            biggest_step(&library, expression.seconds() + 0.5, |t| library.pose(&expression.at(t).into(), t, |_| ()));
        // The fastest jaws and lids go through their range in a twentieth of a second.
        assert!(step.0 < 0.17, "{}: {step:?}", expression.id);
        for i in 0..=(60.0 * expression.seconds()) as u32 {
            let resolved = library.units.resolve(&expression.at(f64::from(i) / 60.0), |_| ());
            let sum = |axis| (0..units.len()).map(|u| resolved.most(u) * mean(u, axis)).sum::<f32>();
            let (up, back) = (sum(Axis::Y), -sum(Axis::Z));
            // A dog draws the corner back; raised it would be a human smile. Half as far up as back is 27 degrees, above
            // which a viewer reads the line of the lips as turned upwards.
            assert!(up <= 0.5 * back.max(0.0) + 0.1, "{} at frame {i}: {up} up, {back} back", expression.id);
        }
    }
}

#[test]
fn a_yawn_opens_too_little_or_closes_slower_than_it_opens() {
    let library = library();
    for (seconds, at) in [
        (library.expression("yawning").expect("a yawn").seconds(), 0),
        (library.clip("yawn").expect("a yawn").seconds, 1),
    ] {
        let gape = |i: u32| {
            let time = f64::from(i) / 100.0;
            let moment = match at {
                0 => library.expression("yawning").expect("a yawn").at(time).into(),
                _ => library.clip("yawn").expect("a yawn").at(time),
            };
            library.pose(&moment, time, |_| ()).median(Channel::JawGape)
        };
        let gapes: Vec<f32> = (0..=(100.0 * seconds) as u32).map(gape).collect();
        let most = gapes.iter().copied().fold(0.0, f32::max);
        assert!((50.0..=58.0).contains(&most), "{most}");
        assert!((2.2..=4.0).contains(&seconds), "{seconds}");
        let open = gapes.iter().position(|&g| g > 0.9 * most).expect("it opens");
        let shut = gapes.len() - gapes.iter().rposition(|&g| g > 0.9 * most).expect("it closes");
        let first = gapes.iter().position(|&g| g > 2.0).expect("it opens");
        let last = gapes.len() - gapes.iter().rposition(|&g| g > 2.0).expect("it closes");
        assert!(shut - last < open - first, "opens in {}, closes in {} hundredths", open - first, shut - last);
    }
}

#[test]
fn a_clip_jumps_where_it_starts_anew_or_does_not_come_to_rest() {
    let library = library();
    for clip in &library.clips {
        let pose_at = |t: f64| library.pose(&clip.at(t), t, |_| ());
        let step = biggest_step(&library, 2.0 * clip.seconds, pose_at);
        assert!(step.0 < 0.17, "{}: {step:?}", clip.id);
        assert!(!pose_at(0.5 * clip.seconds).is_rest() || !pose_at(0.3 * clip.seconds).is_rest(), "{}", clip.id);
        if clip.repeats {
            for layer in &clip.layers {
                for track in &layer.tracks {
                    assert_eq!(track.at(0.0), track.at(clip.seconds), "{}: {:?}", clip.id, track.of);
                }
            }
        } else {
            assert!(pose_at(0.0).is_rest() && pose_at(clip.seconds).is_rest(), "{}", clip.id);
        }
    }
}

#[test]
fn behaviour_names_a_clip_that_is_not_there_or_a_file_has_another_name() {
    let library = library();
    for unit in library.units.units.iter().filter(|u| !u.clip.is_empty()) {
        assert!(library.clip(&unit.clip).is_some(), "{}: {}", unit.id, unit.clip);
    }
    let ids = library.clips.iter().map(|c| &c.id).chain(library.expressions.iter().map(|e| &e.id));
    for ((file, _), id) in CLIPS.iter().chain(&EXPRESSIONS).zip(ids) {
        assert!(file.ends_with(&format!("/{id}.ron")), "{file}: {id}");
    }
    let folder = |name: &str| std::fs::read_dir(format!("rigs/{name}")).expect("a folder").count();
    assert_eq!((folder("clips"), folder("expressions")), (CLIPS.len(), EXPRESSIONS.len()), "a file is not embedded");
}

#[test]
fn a_wrong_clip_or_expression_is_read_or_its_row_is_not_named() {
    let Library { muscles, units, .. } = library();
    let clip = |tracks: &str| {
        let text =
            format!("(version: 1, id: \"c\", label: \"C\", seconds: 2, layers: [(tracks: [{tracks}])], source: \"\")");
        Clip::parse("c.ron", &text, &units, &muscles).expect_err(tracks).to_string()
    };
    assert!(clip("(of: \"AU28\", keys: [(0, 0)])").starts_with("c.ron: AU28: is no unit (did you mean"));
    assert!(clip("(of: \"AU26\", side: Left, keys: [(0, 0)])").contains("one side alone"));
    assert!(clip("(of: \"AU26\", keys: [])").contains("no keys"));
    assert!(clip("(of: \"AU26\", keys: [(1, 0), (1, 1)])").contains("rising times from 0 to 2"));
    assert!(clip("(of: \"AU26\", keys: [(0, 0), (3, 1)])").contains("rising times from 0 to 2"));
    assert!(clip("(of: \"AU26\", keys: [(0, 2)])").contains("allowed 0 to 1"));
    assert!(clip("(of: \"jaw_gape_deg\", keys: [(0, inf)])").contains("is inf at 0"));
    assert!(clip("(of: \"AU26\")").starts_with("c.ron:1:"));
    let expression = |rest: &str| {
        let text =
            format!("(version: 1, id: \"e\", label: \"E\", still_s: 0, units: [(unit: {rest}, evidence: \"\")])");
        Expression::parse("e.ron", &text, &units).expect_err(rest).to_string()
    };
    assert!(expression("\"AU12\", intensity: 2, onset_s: 1, hold_s: 1, offset_s: 1").contains("allowed 0 to 1"));
    assert!(expression("\"AU12\", intensity: 1, onset_s: -1, hold_s: 1, offset_s: 1").contains("onset_s is -1"));
    assert!(expression("\"AU12\", intensity: 1, onset_s: 1, hold_s: 1, offset_s: 1, every_s: 2").contains("takes 3"));
    assert!(expression("\"AD19\", side: Left, intensity: 1, onset_s: 1, hold_s: 1, offset_s: 1").contains("side"));
}

fn act(library: &Library) -> Act {
    let mut act = Act::new(Build { ear_hang: 1.0, ear_slack: 1.0, flew_slack: 0.8 });
    let number = |id: &str| library.clips.iter().position(|c| c.id == id).expect("a clip");
    act.player.play(library, number("idle"), 0.0, 0.2);
    act.player.play(library, number("pant"), 1.0, 0.5);
    act.player.layer(Cue::new(library, number("head_shake"), 1.7, 0.1));
    act.life = Some(Life::new(7, Temper::default()));
    act.expressions.push(Mixed { expression: 3, weight: 0.6, start: Some(0.4) });
    act
}

fn stimulus(time: f64) -> Stimulus {
    let target = [if time < 1.5 { 40.0 } else { -35.0 }, 10.0];
    Stimulus { target: Some(target), sound: (time > 2.0).then_some(100.0), heat: 0.3 }
}

#[test]
fn another_frame_rate_gives_other_bits_at_the_same_time() {
    let library = library();
    let poses = |rate: f64| {
        let mut act = act(&library);
        let mut kept = Vec::new();
        for i in 0..=(4.0 * rate) as u32 {
            let pose = act.pose(&library, f64::from(i) / rate, stimulus, |_| ());
            if i % (rate / 4.0) as u32 == 0 {
                kept.push(pose);
            }
        }
        kept
    };
    let slow = poses(4.0);
    assert_eq!(slow.len(), 17);
    for rate in [24.0, 60.0, 144.0] {
        assert_eq!(poses(rate), slow, "{rate}");
    }
    // Time may run back, or begin in the middle.
    let mut act = act(&library);
    for i in [16, 3, 9, 0, 15] {
        assert_eq!(act.pose(&library, f64::from(i) / 4.0, stimulus, |_| ()), slow[i as usize], "{i}");
    }
}

#[test]
fn another_seed_gives_the_same_life_or_the_same_seed_another() {
    let library = library();
    let poses = |seed: u64| {
        let life = Life::new(seed, Temper::default());
        (0..600).map(|i| library.pose(&life.at(&library, f64::from(i) / 10.0), 0.0, |_| ())).collect::<Vec<_>>()
    };
    assert_eq!(poses(1), poses(1));
    let same = poses(1).iter().zip(&poses(2)).filter(|(a, b)| a == b).count();
    assert!(same < 10, "{same} of 600 alike");
}

#[test]
fn a_dog_blinks_or_looks_about_more_or_less_often_than_published() {
    let library = library();
    let blink = units_number(&library, "AU145");
    for seed in 0..5 {
        let life = Life::new(seed, Temper::default());
        let (mut blinks, mut was_shut) = (0, false);
        for i in 0..60 * 10 * 60 {
            let shut = life.at(&library, f64::from(i) / 60.0).units.most(blink) > 0.5;
            blinks += u32::from(shut && !was_shut);
            was_shut = shut;
        }
        let per_minute = f64::from(blinks) / 10.0;
        assert!((8.0..=15.0).contains(&per_minute), "{per_minute}");
    }
}

#[test]
fn eyes_and_head_do_not_reach_what_is_looked_at() {
    let library = library();
    let mut life = Life::new(1, Temper { looks_per_s: 0.01, ..Temper::default() });
    let at = |life: &mut Life, time: f64, target: [f32; 2]| {
        life.advance(time, |_| Stimulus { target: Some(target), ..Stimulus::default() });
        life.at(&library, time).direct
    };
    let pose = at(&mut life, 0.1, [50.0, 0.0]);
    assert!(pose.channel(Channel::GazeTurn)[0] > 15.0, "the eyes go first");
    assert!(pose.median(Channel::HeadTurn) < 25.0);
    let pose = at(&mut life, 2.5, [50.0, 0.0]);
    let sum = pose.median(Channel::HeadTurn) + pose.channel(Channel::GazeTurn)[0];
    assert!((sum - 50.0).abs() < 8.0, "{sum}");
    assert!(pose.median(Channel::HeadTurn) > 30.0, "beyond 15 degrees the head helps");
    let pose = at(&mut life, 5.0, [8.0, 0.0]);
    assert!(pose.channel(Channel::GazeTurn)[0].abs() < 25.0);
}

#[test]
fn an_ear_turns_away_from_a_sound() {
    let library = library();
    let ears = |from: f32| {
        let mut life = Life::new(1, Temper { flicks_per_min: 0.01, ..Temper::default() });
        life.advance(0.5, |_| Stimulus { sound: Some(from), ..Stimulus::default() });
        life.at(&library, 0.5).direct.channel(Channel::EarTurn)
    };
    let [left, right] = ears(90.0);
    assert!(left > 40.0 && right < 0.0, "{left} {right}");
    let [left, right] = ears(-90.0);
    assert!(right > 40.0 && left < 0.0, "{left} {right}");
    let [left, right] = ears(180.0);
    assert!(left > 60.0 && right > 60.0, "{left} {right}");
    let mut life = Life::new(1, Temper::default());
    life.advance(30.0, |_| Stimulus { sound: Some(90.0), ..Stimulus::default() });
    assert!(life.at(&library, 30.0).direct.channel(Channel::EarTurn)[0] < 2.0, "a sound that goes on becomes boring");
}

#[test]
fn what_hangs_does_not_lag_or_never_comes_to_rest() {
    let library = library();
    let mut act = Act::new(Build { ear_hang: 1.0, ear_slack: 1.0, flew_slack: 1.0 });
    let shake = library.clips.iter().position(|c| c.id == "head_shake").expect("a clip");
    act.player.layer(Cue::new(&library, shake, 0.0, 0.0));
    let mut most = [0.0_f32; 2];
    for i in 0..160 {
        let pose = act.pose(&library, f64::from(i) / 100.0, |_| Stimulus::default(), |_| ());
        for (most, channel) in most.iter_mut().zip([Channel::EarSway, Channel::FlewSway]) {
            *most = most.max(pose.channel(channel)[0].abs());
        }
    }
    assert!(most[0] > 12.0 && most[1] > 3.0, "{most:?}");
    let pose = act.pose(&library, 4.0, |_| Stimulus::default(), |_| ());
    assert!(pose.channel(Channel::EarSway)[0].abs() < 0.05 && pose.channel(Channel::FlewSway)[0].abs() < 0.05);
}

#[test]
fn going_over_from_clip_to_clip_jumps() {
    let library = library();
    let number = |id: &str| library.clips.iter().position(|c| c.id == id).expect("a clip");
    let mut act = Act::new(Build::default());
    act.player.play(&library, number("idle"), 0.0, 0.3);
    act.player.play(&library, number("pant"), 2.0, 0.6);
    act.player.play(&library, number("sniff"), 2.4, 0.6);
    act.player.play(&library, number("bark"), 4.0, 0.4);
    act.player.stop(6.0, 0.4);
    let step = biggest_step(&library, 7.0, |t| library.pose(&act.asked(&library, t), t, |_| ()));
    assert!(step.0 < 0.17, "{step:?}");
    assert!(library.pose(&act.asked(&library, 6.5), 6.5, |_| ()).is_rest());
    act.player.forget_before(6.5);
    assert!(act.player.cues().is_empty());
}

#[test]
fn hanging_ears_stick_to_a_head_that_looks_down_or_standing_ones_fall() {
    let library = library();
    let bend = |ear_hang: f32, ear_slack: f32, word: &str| {
        let mut act = Act::new(Build { ear_hang, ear_slack, flew_slack: 0.0 });
        act.units = with(&library.units, &[(word, 0.7)]);
        let pose = act.pose(&library, 0.0, |_| Stimulus::default(), |_| ());
        (pose.channel(Channel::EarBend)[0], pose.channel(Channel::EarSway))
    };
    // What hangs swings forward where what stands bends back.
    assert!(bend(1.0, 1.0, "AD54").0 > 15.0, "forward, as the head looks down");
    assert!(bend(1.0, 1.0, "AD53").0 < -15.0, "back, as it looks up");
    assert!(bend(-1.0, 0.0, "AD54").0.abs() < 0.1);
    let (_, [left, right]) = bend(1.0, 1.0, "AD55");
    assert!(left < -8.0 && right > 8.0, "the crown goes to the left shoulder: both tips hang to the left of the head");
}

fn hash(library: &Library, pose: &Pose) -> u64 {
    let mut hash = Fnv64::new();
    let channels = Channel::ALL.iter().flat_map(|&channel| pose.channel(channel));
    let muscles = (0..library.muscles.muscles.len()).flat_map(|muscle| pose.muscle(muscle));
    channels.chain(muscles).for_each(|value| hash.u32(value.to_bits()));
    hash.finish()
}

/// A line for each expression and clip at three times, and for life at three times under two seeds.
fn hashes(library: &Library) -> String {
    let mut out = String::from("# kind id seconds hash; written by UPDATE_HASHES=1 cargo test --test motion\n");
    let mut add = |kind: &str, id: &str, time: f64, act: &mut Act| {
        let pose = act.pose(library, time, stimulus, |_| ());
        let _ = writeln!(out, "{kind} {id} {time:.3} {:016x}", hash(library, &pose));
    };
    for (expression, spec) in library.expressions.iter().enumerate() {
        let mut act = Act::new(Build::default());
        act.expressions.push(Mixed { expression, weight: 1.0, start: Some(0.0) });
        for time in [0.5 * spec.still_s, spec.still_s, 0.9 * spec.seconds()] {
            add("expression", &spec.id, time, &mut act);
        }
    }
    for (clip, spec) in library.clips.iter().enumerate() {
        let mut act = Act::new(Build::default());
        act.player.layer(Cue::new(library, clip, 0.0, 0.1));
        for part in [0.3, 0.5, 0.8] {
            add("clip", &spec.id, part * spec.seconds, &mut act);
        }
    }
    for seed in [1, 2] {
        let mut act = Act::new(Build::default());
        act.life = Some(Life::new(seed, Temper::default()));
        for time in [1.0, 3.3, 7.7] {
            add("life", &seed.to_string(), time, &mut act);
        }
    }
    out
}

#[test]
fn a_pose_has_other_bits_than_the_committed_ones() {
    let made = hashes(&library());
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/pose_hashes.txt");
    if std::env::var_os("UPDATE_HASHES").is_some() {
        std::fs::write(file, &made).expect("a file that can be written");
        return;
    }
    let committed = std::fs::read_to_string(file).unwrap_or_default().replace("\r\n", "\n");
    let differing: Vec<&str> = made.lines().filter(|line| !committed.lines().any(|c| c == *line)).collect();
    assert!(
        differing.is_empty() && made == committed,
        "differs from tests/pose_hashes.txt:\n{}\nIf that is meant, run UPDATE_HASHES=1 cargo test --test motion and say why in CHANGELOG.md.",
        differing.join("\n")
    );
}

/// Not a test of speed: it prints what a pose costs, beside copying the numbers that it is made of.
#[test]
#[ignore = "prints a measurement"]
fn cost_of_a_pose() {
    let library = library();
    let mut act = act(&library);
    act.life = Some(Life::new(1, Temper::default()));
    let mut best = [f64::INFINITY; 3];
    for _ in 0..20 {
        act.restart();
        let start = std::time::Instant::now();
        for frame in 0..60 {
            std::hint::black_box(act.pose(&library, f64::from(frame) / 60.0, stimulus, |_| ()));
        }
        best[0] = best[0].min(start.elapsed().as_secs_f64() / 60.0);
        let moment = act.asked(&library, 2.0);
        let start = std::time::Instant::now();
        for _ in 0..1000 {
            std::hint::black_box(library.pose(std::hint::black_box(&moment), 2.0, |_| ()));
        }
        best[1] = best[1].min(start.elapsed().as_secs_f64() / 1000.0);
        let positions = vec![glam::Vec3::ONE; 4000];
        let mut copy = positions.clone();
        let start = std::time::Instant::now();
        for _ in 0..1000 {
            copy.copy_from_slice(std::hint::black_box(&positions));
            std::hint::black_box(&mut copy);
        }
        best[2] = best[2].min(start.elapsed().as_secs_f64() / 1000.0);
    }
    let [frame, pose, copy] = best.map(|seconds| seconds * 1e6);
    println!("a frame at 60 Hz with its steps {frame:.1} us, one pose {pose:.2} us, copying 4000 points {copy:.2} us");
}
