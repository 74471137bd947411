//! The files in `rigs/`: each loads, is embedded, stays in range and survives saving; broken files are refused with a place.
#![cfg(feature = "head")]

use londra::anatomy::{
    Breed, LoadErrors, ParamTable, ProblemKind, QUANTITIES, Quantity, Region, Status, cross, library, load_breed,
    save_breed,
};
use londra::math::rng::Rng;
use londra::measure::Calliper;
use londra::rig::Rig;
use std::path::{Path, PathBuf};
use std::sync::Arc;

fn table() -> ParamTable {
    ParamTable::embedded().unwrap_or_else(|e| panic!("{e}"))
}

fn rigs() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("rigs")
}

/// A small table of its own, so that these tests say the same whatever the real one holds.
fn small_table() -> ParamTable {
    ParamTable::parse("small.ron", SMALL).unwrap_or_else(|e| panic!("{e}"))
}

const SMALL: &str = r#"Anatomy(version: 1, parameters: [
    (id: "ear_mm", label: "Ear", group: "Ears", unit: "mm", range: (10, 400), default: 100, moves: "m", help: "h", source: "s",
     follows: (id: "width_mm", exponent: 0.5)),
    (id: "skull_mm", label: "Skull", group: "Skull", unit: "mm", range: (50, 200), default: 100, moves: "m", help: "h",
     source: "s", synonyms: ["size"]),
    (id: "width_mm", label: "Width", group: "Skull", unit: "mm", range: (50, 150), default: 80, moves: "m", help: "h",
     source: "s", follows: Some((id: "skull_mm", exponent: 1))),
    (id: "stop_deg", label: "Stop", group: "Skull", unit: "deg", range: (-10, 90), default: 30, moves: "m", help: "h", source: "s"),
    (id: "fold", label: "Fold", group: "Ears", unit: "ratio", range: (0, 1), default: 0.5, moves: "m", help: "h", source: "s"),
])"#;

const COAT: &str = r##"coat: (base: "#808080", nose: "#202020", lips: "#202020", mouth: "#804040", iris: "#402010")"##;

fn file(anatomy: &str) -> String {
    format!("Breed(version: 1, label: \"Test\", anatomy: {{{anatomy}}}, {COAT})")
}

fn breed(anatomy: &str) -> Breed {
    load_breed(&small_table(), "folder/test.ron", &file(anatomy)).unwrap_or_else(|e| panic!("{e}"))
}

fn refused(text: &str) -> LoadErrors {
    load_breed(&small_table(), "bad.ron", text).expect_err(text)
}

fn assert_same_bits(a: &Breed, b: &Breed) {
    assert_eq!(a, b);
    let bits = |b: &Breed| b.values.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(a), bits(b));
}

// ---- the shipped files ----

#[test]
fn every_breed_on_disk_is_embedded_and_sorted_and_nothing_else_is() {
    let mut on_disk: Vec<String> = std::fs::read_dir(rigs().join("breeds"))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|e| e == "ron"))
        .map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned())
        .collect();
    on_disk.sort();
    assert_eq!(on_disk, library::ids().collect::<Vec<_>>());
    for (id, text) in library::BREEDS {
        let path = rigs().join("breeds").join(format!("{id}.ron"));
        assert_eq!(&std::fs::read_to_string(path).unwrap(), text, "{id}");
    }
}

#[test]
fn every_shipped_breed_loads_stays_in_range_and_survives_saving() {
    let table = table();
    for id in library::ids() {
        let breed = library::breed(&table, id).unwrap_or_else(|e| panic!("{e}"));
        assert_eq!(breed.id, id);
        assert_eq!(breed.values.len(), table.specs.len());
        for (value, spec) in breed.values.iter().zip(&table.specs) {
            assert!((spec.min_si()..=spec.max_si()).contains(value), "{id}: {} is {value}", spec.id);
        }
        let text = save_breed(&table, &breed);
        let again = load_breed(&table, &format!("{id}.ron"), &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
        assert_same_bits(&breed, &again);
        assert_eq!(save_breed(&table, &again), text);
    }
}

#[test]
fn shipped_breeds_differ_in_label_and_in_shape() {
    let table = table();
    let breeds: Vec<Breed> = library::ids().map(|id| library::breed(&table, id).unwrap()).collect();
    for (i, a) in breeds.iter().enumerate() {
        for b in &breeds[..i] {
            assert_ne!(a.label, b.label);
            assert_ne!(a.values, b.values, "{} {}", a.id, b.id);
        }
    }
}

#[test]
fn a_name_that_is_not_a_breed_is_answered_with_the_nearest() {
    let error = library::breed(&table(), "labradro").unwrap_err();
    assert_eq!(error.to_string(), "unknown breed labradro (did you mean labrador?)");
}

// ---- reading ----

#[test]
fn values_are_si_and_the_id_is_the_stem() {
    let breed = breed(r#""skull_mm": 120, "stop_deg": 90.0, "fold": 0.25"#);
    assert_eq!(breed.id, "test");
    let expected = [0.1 * 1.2_f32.sqrt(), 0.12, 0.096, std::f32::consts::FRAC_PI_2, 0.25];
    assert!(breed.values.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-7), "{:?}", breed.values);
    assert_eq!(breed.set, [false, true, false, true, true]);
}

#[test]
fn all_mistakes_of_meaning_are_reported_each_at_its_place() {
    let text = r##"Breed(
    version: 1,
    label: "",
    lable: "x",
    anatomy: {
        "skul_mm": 100,
        "skull_mm": 410,
        "stop_deg": "steep",
        "fold": NaN,
        "width_mm": 80,
        "width_mm": 90,
        7: 8,
    },
    coat: (base: "grey", nose: "#202020", lips: 5, mouth: (0.1, 0.2, 3), iris: "#402010", fur: 2,
        marks: [(regions: ["ear_outter"], colour: "#ffffff", amount: -1)],
    ),
)"##;
    let expected = [
        "bad.ron:3:12: label must not be empty",
        "bad.ron:4:5: unknown field lable (did you mean label?); allowed are version, label, fci_group, references, anatomy, coat",
        "bad.ron:6:9: unknown parameter skul_mm (did you mean skull_mm?)",
        "bad.ron:7:21: skull_mm is 410, allowed 50 to 200",
        "bad.ron:8:21: stop_deg must be a number, found a text",
        "bad.ron:9:17: fold must be a finite number",
        "bad.ron:11:9: width_mm is given twice, first in line 10",
        "bad.ron:12:9: each key of anatomy must be a text, found a number",
        "bad.ron:14:18: coat.base must be a colour, \"#rrggbb\" or (red, green, blue) in linear light from 0 to 1, found \"grey\"",
        "bad.ron:14:49: coat.lips must be a colour, \"#rrggbb\" or (red, green, blue) in linear light from 0 to 1, found a number",
        "bad.ron:14:70: coat.mouth is 3, allowed 0 to 1",
        "bad.ron:14:96: coat.fur is 2, allowed 0 to 1",
        "bad.ron:15:28: unknown region ear_outter (did you mean ear_outer?)",
        "bad.ron:15:70: coat.marks[0].amount is -1, allowed 0 to 1",
    ];
    assert_eq!(refused(text).to_string().lines().collect::<Vec<_>>(), expected);
}

#[test]
fn mistakes_against_the_table_are_found_together() {
    let text = file(r#""skul_mm": 1, "size": 2, "ear_mm": 401, "fold": -0.1"#)
        .replace("coat: (", "coat: (marks: [(regions: [\"nosee\", \"tail\"], colour: \"#000000\", amount: 1)], ");
    let errors = refused(&text);
    let kinds: Vec<String> = errors.problems.iter().map(|p| p.kind.to_string()).collect();
    assert_eq!(
        kinds,
        [
            "unknown parameter skul_mm (did you mean skull_mm?)",
            "unknown parameter size (did you mean skull_mm?)",
            "ear_mm is 401, allowed 10 to 400",
            "fold is -0.1, allowed 0 to 1",
            "unknown region nosee (did you mean nose?)",
            "unknown region tail",
        ]
    );
}

#[test]
fn only_the_first_syntax_error_is_reported() {
    let errors = refused("Breed(\n  version: 1,\n  label \"x\",\n  anatomy {}\n)");
    assert_eq!(errors.problems.len(), 1);
    assert!(matches!(errors.problems[0].kind, ProblemKind::Syntax(_)));
    assert_eq!(errors.problems[0].place.line, 3);
}

#[test]
fn missing_fields_versions_and_foreign_files_are_refused() {
    let missing = refused("Breed(version: 1)").to_string();
    assert_eq!(missing.lines().count(), 3, "{missing}");
    assert!(missing.contains("bad.ron:1:1: label is missing"), "{missing}");
    for (version, printed) in [("0", "0"), ("3", "3"), ("1.5", "1.5"), ("-1", "-1")] {
        let text = file("").replace("version: 1", &format!("version: {version}"));
        let message = format!("bad.ron:1:16: version is {printed}, this program reads whole numbers from 1 to 2");
        assert_eq!(refused(&text).to_string(), message);
    }
    assert!(refused("Anatomy(version: 1, parameters: [])").to_string().contains("expected Breed(…), found Anatomy(…)"));
    assert!(refused("[1, 2]").to_string().contains("the file must be a record"));
    assert!(refused("").to_string().starts_with("bad.ron:1:1: syntax error"));
    for value in ["inf", "-inf", "NaN", "1e999"] {
        assert!(refused(&file(&format!("\"fold\": {value}"))).to_string().contains("fold must be a finite number"));
    }
}

#[test]
fn no_cut_or_garbled_file_loads_or_panics() {
    let table = table();
    let (_, whole) = library::BREEDS[0];
    for (end, _) in whole.char_indices().filter(|(end, _)| whole[*end..].trim() != "") {
        assert!(load_breed(&table, "cut.ron", &whole[..end]).is_err(), "{}", &whole[..end]);
    }
    let pieces = [
        "(", ")", "[", "]", "{", "}", ":", ",", "\"", "#", "'", "\\", "/*", "//", "-", "e", "1e9", "NaN", "é", "\u{0}",
        "r#", "b\"", "Some(",
    ];
    let mut state = 7_u32;
    let mut next = |n: usize| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 8) as usize % n
    };
    for _ in 0..3000 {
        let mut text: Vec<char> = whole.chars().collect();
        for _ in 0..=next(3) {
            let at = next(text.len());
            let end = (at + next(4)).min(text.len());
            text.splice(at..end, pieces[next(pieces.len())].chars());
        }
        let text: String = text.into_iter().collect();
        match load_breed(&table, "garbled.ron", &text) {
            Err(errors) => {
                assert!(!errors.problems.is_empty());
                let lines = text.lines().count() as u32 + 1;
                assert!(
                    errors.problems.iter().all(|p| (1..=lines).contains(&p.place.line) && p.place.column >= 1),
                    "{errors}\n{text}"
                );
            }
            // Some garbling is harmless: a digit more, a comment. What loads must be in range and survive saving.
            Ok(breed) => {
                for (value, spec) in breed.values.iter().zip(&table.specs) {
                    assert!((spec.min_si()..=spec.max_si()).contains(value));
                }
                let again = load_breed(&table, "garbled.ron", &save_breed(&table, &breed))
                    .unwrap_or_else(|e| panic!("{e}\n{text}"));
                assert_same_bits(&breed, &again);
            }
        }
    }
}

// ---- following, setting, blending ----

#[test]
fn what_is_not_set_follows_in_chains_and_stays_in_range() {
    let table = small_table();
    let mut breed = Breed::defaults(&table);
    assert_eq!(breed.values, table.specs.iter().map(|s| s.default_si()).collect::<Vec<_>>());
    let (ear, skull, width) = (0, 1, 2);
    breed.set_value(&table, skull, 0.2);
    assert_eq!(breed.values[width], 0.15, "cut off at the end of the range");
    assert!((breed.values[ear] - 0.1 * (0.15_f32 / 0.08).sqrt()).abs() < 1e-6, "follows what the width became");
    breed.set_value(&table, width, 0.08);
    assert_eq!(breed.values[ear], 0.1);
    breed.set_value(&table, ear, 0.3);
    breed.set_value(&table, skull, 0.05);
    assert_eq!((breed.values[ear], breed.values[width]), (0.3, 0.08), "what is set does not move by itself");
    breed.unset(&table, width);
    breed.unset(&table, ear);
    breed.unset(&table, skull);
    assert_same_bits(&breed, &Breed::defaults(&table));
}

#[test]
fn setting_cuts_off_and_ignores_what_is_no_number_or_no_row() {
    let table = small_table();
    let mut breed = Breed::defaults(&table);
    breed.set_value(&table, 3, 100.0);
    assert_eq!(breed.values[3], table.specs[3].max_si());
    let before = breed.clone();
    breed.set_value(&table, 3, f32::NAN);
    breed.set_value(&table, 3, f32::INFINITY);
    breed.set_value(&table, 99, 1.0);
    breed.unset(&table, 99);
    assert_same_bits(&breed, &before);
}

#[test]
fn two_ways_to_the_same_values_give_the_same_bits() {
    let table = small_table();
    let (mut a, mut b) = (Breed::defaults(&table), Breed::defaults(&table));
    a.set_value(&table, 1, 0.13);
    a.set_value(&table, 4, 0.7);
    for si in [0.05, 0.2, 0.0777] {
        b.set_value(&table, 1, si);
    }
    b.set_value(&table, 4, 0.1);
    b.set_value(&table, 4, 0.7);
    b.set_value(&table, 1, 0.13);
    assert_same_bits(&a, &b);
}

#[test]
fn a_blend_mixes_values_and_is_itself_at_its_ends() {
    let table = small_table();
    let a = breed(r#""skull_mm": 100, "stop_deg": 0"#);
    let b = breed(r#""skull_mm": 200, "width_mm": 100, "fold": 1"#);
    assert_same_bits(&Breed::blend(&table, &[(&a, 1.0), (&b, 0.0)]), &a);
    assert_same_bits(&Breed::blend(&table, &[(&a, -1.0), (&b, 0.3)]), &b);
    assert_same_bits(&Breed::blend(&table, &[(&a, 0.2), (&a, 0.9)]), &a);
    assert_same_bits(&Breed::blend(&table, &[]), &Breed::defaults(&table));
    assert_same_bits(&Breed::blend(&table, &[(&a, f32::NAN)]), &Breed::defaults(&table));
    let half = Breed::blend(&table, &[(&a, 3.0), (&b, 1.0)]);
    for (i, &value) in half.values.iter().enumerate() {
        assert!((value - (0.75 * a.values[i] + 0.25 * b.values[i])).abs() < 1e-6, "{}", table.specs[i].id);
    }
    assert_eq!(half.id, "test+test");
}

#[test]
fn a_blend_survives_saving_to_the_bit_with_its_colours() {
    let table = table();
    let breeds: Vec<Breed> = library::ids().map(|id| library::breed(&table, id).unwrap()).collect();
    for (i, a) in breeds.iter().enumerate() {
        for b in &breeds[..i] {
            for weight in [0.01, 0.3, 0.5, 0.77] {
                let blend = Breed::blend(&table, &[(a, 1.0 - weight), (b, weight)]);
                let mean = a.look.base_colour() * (1.0 - weight) + b.look.base_colour() * weight;
                assert!(blend.look.base_colour().abs_diff_eq(mean, 1e-6), "{}", blend.id);
                let text = save_breed(&table, &blend);
                let name = format!("{}.ron", blend.id);
                let again = load_breed(&table, &name, &text).unwrap_or_else(|e| panic!("{e}\n{text}"));
                assert_same_bits(&blend, &again);
            }
        }
    }
}

#[test]
fn labels_with_quotes_and_odd_characters_survive_saving() {
    let table = small_table();
    let mut breed = Breed::defaults(&table);
    breed.id = "odd".into();
    breed.label = "\"Ö\\\n\u{7}\u{0}🐶 {} r#\"".into();
    let again = load_breed(&table, "odd.ron", &save_breed(&table, &breed)).unwrap_or_else(|e| panic!("{e}"));
    assert_same_bits(&breed, &again);
}

// ---- the table ----

fn table_refused(change: impl Fn(&str) -> String) -> String {
    ParamTable::parse("table.ron", &change(SMALL)).expect_err("a broken table").to_string()
}

#[test]
fn the_embedded_table_has_no_row_without_words() {
    for spec in &table().specs {
        assert!(spec.help.ends_with('.'), "the help of {} is a sentence", spec.id);
        assert_eq!(spec.from_si(spec.default_si()), spec.default, "{}", spec.id);
    }
}

#[test]
fn broken_tables_are_refused_with_the_reason() {
    let cases: [(&str, &str, &str); 11] = [
        ("default: 0.5", "default: 1.5", "parameters[4].default is 1.5, allowed 0 to 1"),
        ("range: (0, 1)", "range: (1, 0)", "the range of fold is (1, 0): the first number must be the lower one"),
        ("range: (0, 1)", "range: 3", "the range of fold must be a tuple (lowest, highest), found a number"),
        (
            "\"fold\"",
            "\"ear_mm\"",
            "ear_mm must be lower-case letters, digits and _, and end in none of _mm, _deg, _weeks and _kg for the unit ratio",
        ),
        ("\"stop_deg\"", "\"stop\"", "stop must be lower-case letters, digits and _, and end in _deg for the unit deg"),
        (
            "\"fold\"",
            "\"Fold it\"",
            "Fold it must be lower-case letters, digits and _, and end in none of _mm, _deg, _weeks and _kg for the unit ratio",
        ),
        (
            "unit: \"deg\"",
            "unit: \"rad\"",
            "parameters[3].unit must be \"mm\", \"deg\", \"weeks\", \"kg\" or \"ratio\", found a text",
        ),
        (
            "id: \"width_mm\", exponent",
            "id: \"widht_mm\", exponent",
            "unknown parameter widht_mm (did you mean width_mm?)",
        ),
        (
            "id: \"width_mm\", exponent",
            "id: \"stop_deg\", exponent",
            "ear_mm follows stop_deg, whose range begins at -10: only parameters above 0 can be followed",
        ),
        ("id: \"skull_mm\", exponent", "id: \"ear_mm\", exponent", "ear_mm, width_mm follow each other in a circle"),
        (
            "synonyms:",
            "synonym:",
            "unknown field parameters[1].synonym (did you mean synonyms?); allowed are id, label, group, unit, range, default, moves, help, source, synonyms, follows",
        ),
    ];
    for (from, to, message) in cases {
        let text = table_refused(|table| table.replacen(from, to, 1));
        let kinds: Vec<&str> = text.lines().map(|l| l.splitn(4, ':').last().unwrap().trim()).collect();
        assert_eq!(kinds, [message]);
    }
    let twice = table_refused(|t| t.replace("\"stop_deg\"", "\"fold\"").replace("\"deg\"", "\"ratio\""));
    assert_eq!(twice.lines().count(), 1, "{twice}");
    assert!(twice.contains("fold is given twice, first in line"), "{twice}");
}

#[test]
fn parameters_are_found_by_slips_labels_and_synonyms() {
    let table = small_table();
    assert_eq!(table.nearest("skull"), ["skull_mm"]);
    assert_eq!(table.nearest("SIZE"), ["skull_mm"]);
    assert_eq!(table.nearest("stop_dge"), ["stop_deg"]);
    assert!(table.nearest("tail_length_mm").is_empty());
    assert_eq!(table.index_of("fold"), Some(4));
    assert_eq!(table.index_of("Fold"), None);
}

// ---- references ----

#[test]
fn a_reference_loses_its_status_or_source_on_the_way_through_a_file() {
    let text = file("").replace(
        "anatomy:",
        r#"fci_group: 9, references: [(measure: "skull_index", value: 54, status: measured, source: "a \"b\""),
        (measure: "body_mass", value: 2.3, status: estimated, source: "typical")], anatomy:"#,
    );
    let table = small_table();
    let breed = load_breed(&table, "test.ron", &text).unwrap_or_else(|e| panic!("{e}"));
    assert_eq!(breed.fci_group, Some(9));
    let found: Vec<_> = breed
        .references
        .iter()
        .map(|r| (r.quantity.id, r.quantity.unit, r.value, r.status, r.source.as_str()))
        .collect();
    let expected = [
        ("skull_index", "", 54.0, Status::Measured, "a \"b\""),
        ("body_mass", "kg", 2.3, Status::Estimated, "typical"),
    ];
    assert_eq!(found, expected);
    let again = load_breed(&table, "test.ron", &save_breed(&table, &breed)).unwrap_or_else(|e| panic!("{e}"));
    assert_same_bits(&breed, &again);
}

#[test]
fn a_mistake_in_a_reference_is_not_told_at_its_place() {
    let text = format!(
        r#"Breed(version: 1, label: "Test", anatomy: {{}}, {COAT}, fci_group: 10.5,
    references: [
        (measure: "skull_lenght", value: 54, status: measured, source: "s"),
        (measure: "skull_index", value: 540, status: measured, source: "s"),
        (measure: "skull_index", value: 54, status: guessed, source: "s"),
        (measure: "skull_index", value: 54, status: "measured", source: "s"),
        (measure: "skull_index", value: inf, status: measured, source: " "),
        (measure: "skull_index", value: 54, status: measured, source: "s"),
        (measure: "skull_index", value: 55, status: measured, source: "s"),
        (measure: "skull_index", valeu: 55, status: measured, source: "s"),
    ])"#
    );
    let found = refused(&text).to_string();
    let found: Vec<&str> = found.lines().map(|l| l.split("; allowed are skull_length").next().unwrap()).collect();
    let expected = [
        "bad.ron:1:152: fci_group is 10.5, allowed 1 to 10",
        "bad.ron:3:19: unknown measure skull_lenght (did you mean skull_length?)",
        "bad.ron:4:41: skull_index is 540, allowed 25 to 130",
        "bad.ron:5:53: references[2].status must be measured, computed or estimated, without quotes, found guessed",
        "bad.ron:6:53: references[3].status must be measured, computed or estimated, without quotes, found a text",
        "bad.ron:7:41: references[4].value must be a finite number",
        "bad.ron:7:72: references[4].source must not be empty",
        "bad.ron:9:19: skull_index of this source is given twice, first in line 8",
        "bad.ron:10:9: references[7].value is missing",
        "bad.ron:10:34: unknown field references[7].valeu (did you mean value?); allowed are measure, value, status, source",
    ];
    assert_eq!(found, expected);
    let whole = file("").replace("anatomy:", "fci_group: 2.5, references: 3, anatomy:");
    let found = refused(&whole).to_string();
    assert!(found.contains("fci_group must be a whole number, found a number"), "{found}");
    assert!(found.contains("references must be a list [ … ], found a number"), "{found}");
}

#[test]
fn a_blend_is_held_against_the_references_of_one_parent() {
    let table = table();
    let [pug, wolf] = ["pug", "wolf"].map(|id| library::breed(&table, id).unwrap_or_else(|e| panic!("{e}")));
    assert!(!pug.references.is_empty() && pug.fci_group == Some(9));
    assert!(pug.references.iter().all(|r| !r.source.is_empty()));
    let blend = Breed::blend(&table, &[(&pug, 0.5), (&wolf, 0.5)]);
    assert!(blend.references.is_empty() && blend.fci_group.is_none());
    let puppy = cross(&table, &pug, &wolf, &mut Rng::new(1)).unwrap_or_else(|e| panic!("{e}"));
    assert!(puppy.references.is_empty() && puppy.fci_group.is_none());
    let alone = Breed::blend(&table, &[(&pug, 1.0), (&wolf, 0.0)]);
    assert_eq!(alone.references, pug.references);
}

#[test]
fn a_quantity_of_the_calliper_can_have_no_reference() {
    let table = table();
    let rig = Arc::new(Rig::embedded(&table).unwrap_or_else(|e| panic!("{e}")));
    let mut calliper = Calliper::new(rig).unwrap_or_else(|e| panic!("{e}"));
    let pug = library::breed(&table, "pug").unwrap_or_else(|e| panic!("{e}"));
    let found = calliper.measure(&pug.values);
    let told: Vec<(&str, &str)> = found.iter().map(|m| (m.id, m.dimension.unit())).collect();
    let known: Vec<(&str, &str)> = QUANTITIES.iter().map(|q| (q.id, q.unit)).collect();
    assert_eq!(known, [told, vec![("body_mass", "kg")]].concat());
    for m in &found {
        let range = Quantity::from_id(m.id).map(|q| q.min..=q.max);
        assert!(range.is_some_and(|range| range.contains(&f64::from(m.value))), "{} is {}", m.id, m.value);
    }
}
