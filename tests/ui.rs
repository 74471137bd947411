//! Drives the panels without a window, and looks at the head that comes of it.
//!
//! `cargo test --features ui-tests --test ui`.

use egui::accesskit::Role;
use egui_kittest::{Harness, kittest::Queryable as _};
use londra::anatomy::{Breed, ParamTable};
use londra::app::{Command, Document, EditorState, files, panels};
use londra::coat::Condition;
use londra::frame::{Layers, Pipeline, StageHashes};
use londra::measure::Calliper;
use londra::rig::Rig;
use std::path::PathBuf;
use std::sync::Arc;

fn state() -> EditorState {
    let (table, breeds) = files::read_rigs(None).unwrap();
    let document = files::first_document(&table, &breeds, Some("labrador")).unwrap();
    let mut state = EditorState::new(table, breeds, document);
    state.set_level(1);
    state
}

fn harness() -> Harness<'static, EditorState> {
    let mut has_fonts = false;
    let mut harness = Harness::builder().with_size([1100.0, 2600.0]).build_ui_state(
        move |ui, state: &mut EditorState| {
            if !std::mem::replace(&mut has_fonts, true) {
                panels::set_fonts(ui.ctx());
            }
            panels::show(state, ui, None);
        },
        state(),
    );
    harness.run();
    harness
}

/// The hashes of the head that the state shows.
fn hashes(state: &EditorState) -> StageHashes {
    let rig = Arc::new(Rig::embedded(&state.table).unwrap());
    let mut pipeline = Pipeline::new(rig, state.level()).unwrap();
    pipeline.update(state.breed());
    pipeline.hashes()
}

/// A measure's label on the screen, its row, and a value that is not the present one.
fn measure(state: &EditorState, id: &str) -> (String, usize, f64) {
    let index = state.table.index_of(id).unwrap();
    let spec = &state.table.specs[index];
    let now = spec.from_si(state.breed().values[index]);
    let other = if now > (spec.min + spec.max) / 2.0 { spec.min } else { spec.max };
    (spec.label.clone(), index, other)
}

#[test]
fn a_slider_moves_the_head_and_undo_redo_and_reset_bring_it_back() {
    let mut harness = harness();
    let before = hashes(harness.state());
    let (label, index, other) = measure(harness.state(), "cranial_length_mm");
    harness.get_by_role_and_label(Role::Slider, &label).set_value_accesskit(other);
    harness.run();
    assert!(harness.state().is_overridden(index));
    let moved = hashes(harness.state());
    assert_ne!(moved.control, before.control);
    assert_eq!(moved.indices, before.indices, "a slider never touches the topology");

    harness.get_by_label("Undo").click();
    harness.run();
    assert_eq!(hashes(harness.state()), before);
    harness.get_by_label("Redo").click();
    harness.run();
    assert_eq!(hashes(harness.state()), moved);
    harness.get_by_label(&format!("Reset {label}")).click();
    harness.run();
    assert!(!harness.state().is_overridden(index));
    assert_eq!(hashes(harness.state()), before);
}

#[test]
fn looking_at_the_panels_changes_nothing() {
    let mut harness = harness();
    let before = state();
    for _ in 0..4 {
        harness.step();
    }
    assert_eq!(harness.state().breed(), before.breed());
    assert!(!harness.state().can_undo() && !harness.state().document().is_changed());
}

#[test]
fn a_number_can_be_typed_and_is_kept_within_its_range() {
    let mut harness = harness();
    let (label, index, _) = measure(harness.state(), "cranial_length_mm");
    let max = harness.state().table.specs[index].max_si();
    harness.get_by_role_and_label(Role::SpinButton, &label).click();
    harness.run();
    harness.event(egui::Event::Text("99999".into()));
    harness.run();
    harness.key_press(egui::Key::Enter);
    harness.run();
    assert_eq!(harness.state().breed().values[index], max);
}

#[test]
fn the_search_field_narrows_the_sliders() {
    let mut harness = harness();
    let (cranial, ..) = measure(harness.state(), "cranial_length_mm");
    let (facial, ..) = measure(harness.state(), "facial_length_mm");
    let field = harness.get_by_role_and_label(Role::TextInput, "Search");
    field.focus();
    harness.run();
    harness.get_by_role_and_label(Role::TextInput, "Search").type_text("facial length");
    harness.run();
    assert_eq!(harness.state().search, "facial length");
    assert!(harness.query_by_role_and_label(Role::Slider, &facial).is_some());
    assert!(harness.query_by_role_and_label(Role::Slider, &cranial).is_none());
}

#[test]
fn the_level_refines_the_head() {
    let mut harness = harness();
    let coarse = hashes(harness.state());
    harness.get_by_role_and_label(Role::Slider, "Level").set_value_accesskit(2.0);
    harness.run();
    assert_eq!(harness.state().level(), 2);
    let fine = hashes(harness.state());
    assert_eq!(fine.control, coarse.control);
    assert_ne!(fine.indices, coarse.indices);
    harness.key_press(egui::Key::Minus);
    harness.run();
    assert_eq!(harness.state().level(), 1);
}

#[test]
fn keys_reach_the_camera_only_while_nothing_is_typed() {
    let mut harness = harness();
    let before = harness.state().camera;
    harness.key_press(egui::Key::Num3);
    harness.run();
    assert_ne!(harness.state().camera, before);
    let side = harness.state().camera;
    harness.get_by_role_and_label(Role::TextInput, "Search").focus();
    harness.run();
    harness.key_press(egui::Key::Num1);
    harness.run();
    assert_eq!(harness.state().camera, side);
}

#[test]
fn every_measure_has_a_slider_and_a_number() {
    let mut harness = harness();
    for spec in &ParamTable::embedded().unwrap().specs {
        // The search brings what is scrolled out of sight to the top.
        harness.state_mut().search.clone_from(&spec.id);
        harness.run();
        assert!(harness.query_by_role_and_label(Role::Slider, &spec.label).is_some(), "{}", spec.id);
        assert!(harness.query_by_role_and_label(Role::SpinButton, &spec.label).is_some(), "{}", spec.id);
    }
}

#[test]
fn a_mix_of_two_breeds_is_half_way_between() {
    let mut harness = harness();
    let state = harness.state_mut();
    let pug = state.breeds.iter().position(|b| b.id == "pug").unwrap();
    state.set_partner(Some(pug));
    harness.run();
    let state = harness.state();
    let index = state.table.index_of("facial_length_mm").unwrap();
    let ends = [&state.breeds[pug], &state.document().base].map(|b: &Breed| b.values[index]);
    assert!((state.breed().values[index] - (ends[0] + ends[1]) / 2.0).abs() < 1e-6);
    harness.get_by_role_and_label(Role::Slider, "How much").set_value_accesskit(100.0);
    harness.run();
    let state = harness.state();
    assert_eq!(state.breed().values, state.breeds[pug].values);
}

#[test]
fn a_coat_of_the_list_is_not_worn_saved_or_undone() {
    let mut harness = harness();
    let first = harness.state().breed().clone();
    let list = harness.get_by_role_and_label(Role::ComboBox, "Coat");
    assert_eq!(list.value().as_deref(), Some("yellow"));
    harness.state_mut().set_coat("chocolate");
    harness.run();
    assert_eq!(harness.state().breed().worn(), Some("chocolate"));
    assert_eq!(harness.get_by_role_and_label(Role::ComboBox, "Coat").value().as_deref(), Some("chocolate"));
    assert!(harness.state().document().is_changed());
    assert_eq!(harness.state().breed().values, first.values);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    harness.run();
    assert_eq!(*harness.state().breed(), first);
}

#[test]
fn choosing_a_breed_can_be_undone() {
    let mut harness = harness();
    let first = harness.state().breed().clone();
    let other: Document = Document::of(harness.state().breeds[0].clone(), None);
    harness.state_mut().choose(0);
    harness.run();
    assert_eq!(harness.state().breed().id, other.base.id);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    harness.run();
    assert_eq!(*harness.state().breed(), first);
}

#[test]
fn a_random_dog_is_shown_keeps_what_is_ticked_and_can_be_undone() {
    let mut harness = harness();
    let first = harness.state().breed().clone();
    harness.state_mut().chance.seed = 5;
    harness.state_mut().chance.kept.insert("Ears".into());
    harness.get_by_label("Random dog").click();
    harness.run();
    let state = harness.state();
    let row = |id: &str| state.table.index_of(id).unwrap();
    let (ear, face) = (row("ear_length_mm"), row("facial_length_mm"));
    assert_eq!((state.chance.seed, state.breed().label.as_str()), (6, "Random 5-1"));
    assert_eq!(state.breed().values[ear], first.values[ear]);
    assert_ne!(state.breed().values[face], first.values[face]);
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Z);
    harness.run();
    assert_eq!(*harness.state().breed(), first);
}

/// Changes a measure and presses Ctrl+Q.
fn asked_to_leave() -> Harness<'static, EditorState> {
    let mut harness = harness();
    let (label, _, other) = measure(harness.state(), "cranial_length_mm");
    harness.get_by_role_and_label(Role::Slider, &label).set_value_accesskit(other);
    harness.run();
    harness.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Q);
    harness.run();
    assert!(harness.state().asks_to_quit && harness.state().commands.is_empty());
    harness
}

#[test]
fn leaving_with_changes_asks_and_staying_keeps_them() {
    type Answer = fn(&Harness<'static, EditorState>);
    let answers: [Answer; 2] = [|h| h.get_by_label("Stay").click(), |h| h.key_press(egui::Key::Escape)];
    for stay in answers {
        let mut harness = asked_to_leave();
        let breed = harness.state().breed().clone();
        stay(&harness);
        harness.run();
        let state = harness.state();
        assert!(!state.asks_to_quit && state.commands.is_empty() && state.document().is_changed());
        assert_eq!(*state.breed(), breed);
    }
    for (answer, command) in [("Leave without saving", Command::Quit), ("Save and leave", Command::SaveAndQuit)] {
        let mut harness = asked_to_leave();
        harness.get_by_label(answer).click();
        harness.run();
        assert_eq!(harness.state().commands, [command]);
        assert!(!harness.state().asks_to_quit);
    }
    let mut unchanged = harness();
    unchanged.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::Q);
    unchanged.run();
    assert_eq!(unchanged.state().commands, [Command::Quit]);
}

#[test]
fn a_typed_path_can_be_opened_saved_to_and_exported_to() {
    let folder = tempfile::tempdir().unwrap();
    let there = folder.path().join("there.ron");
    std::fs::write(&there, "").unwrap();
    type Make = fn(PathBuf) -> Command;
    let buttons: [(&str, Make); 3] = [
        ("Open this path", Command::OpenPath),
        ("Save this path", Command::SavePath),
        ("Export this path", Command::ExportPath),
    ];
    for (button, command) in buttons {
        let mut harness = harness();
        harness.get_by_label(button).click();
        harness.run();
        assert!(harness.state().commands.is_empty(), "{button} without a path");
        // A file that is there is what Enter alone would open, never replace.
        harness.state_mut().typed_path = format!(" {} ", there.display());
        harness.run();
        harness.get_by_label(button).click();
        harness.run();
        assert_eq!(harness.state().commands, [command(there.clone())]);
    }
    for (name, command) in
        [("there.ron", Command::OpenPath as Make), ("new.ron", Command::SavePath), ("a.glb", Command::ExportPath)]
    {
        let mut harness = harness();
        let path = folder.path().join(name);
        harness.get_by_role_and_label(Role::TextInput, "File").focus();
        harness.run();
        harness.get_by_role_and_label(Role::TextInput, "File").type_text(&path.display().to_string());
        harness.run();
        harness.key_press(egui::Key::Enter);
        harness.run();
        assert_eq!(harness.state().commands, [command(path)]);
    }
}

#[test]
fn a_file_held_over_the_window_is_told_what_letting_go_does() {
    let mut harness = harness();
    let hint = "Let go to open the breed file";
    assert!(harness.query_by_label(hint).is_none());
    harness.input_mut().hovered_files.push(egui::HoveredFile::default());
    // It is measured in one picture and shown in the next.
    harness.step();
    harness.step();
    assert!(harness.query_by_label(hint).is_some());
}

#[test]
fn rows_out_of_sight_keep_their_room() {
    let mut has_fonts = false;
    let mut harness = Harness::builder().with_size([1100.0, 500.0]).build_ui_state(
        move |ui, state: &mut EditorState| {
            if !std::mem::replace(&mut has_fonts, true) {
                panels::set_fonts(ui.ctx());
            }
            panels::show(state, ui, None);
        },
        state(),
    );
    harness.run();
    let specs = harness.state().table.specs.clone();
    let (first, last) = (&specs[0].label, &specs[specs.len() - 1].label);
    let is_there = |h: &Harness<'_, EditorState>, label: &str| h.query_by_role_and_label(Role::Slider, label).is_some();
    assert!(is_there(&harness, first) && !is_there(&harness, last));
    for _ in 0..60 {
        harness.event(egui::Event::PointerMoved(egui::pos2(150.0, 400.0)));
        harness.event(egui::Event::MouseWheel {
            unit: egui::MouseWheelUnit::Point,
            delta: egui::vec2(0.0, -200.0),
            phase: egui::TouchPhase::Move,
            modifiers: egui::Modifiers::NONE,
            source: egui::MouseWheelSource::Wheel,
        });
        harness.step();
    }
    harness.run();
    assert!(!is_there(&harness, first) && is_there(&harness, last));
}

#[test]
fn a_layer_has_no_switch() {
    let mut harness = harness();
    assert_eq!(harness.state().layers, Layers::default());
    harness.get_by_role_and_label(Role::Slider, "Skin layer").set_value_accesskit(0.25);
    for layer in ["eyes", "whiskers", "bone", "teeth", "mouth", "tongue"] {
        harness.get_by_role_and_label(Role::CheckBox, layer).click();
    }
    harness.run();
    assert_eq!(
        harness.state().layers,
        Layers { skin: 0.25, bone: true, teeth: true, mouth: true, tongue: true, ..Layers::NONE }
    );
}

// ---- measurements ----

/// Opens the panel, and lets so many pictures pass that every breed is known.
fn measured() -> Harness<'static, EditorState> {
    let mut harness = harness();
    assert!(harness.state().measures.found().is_empty(), "a closed panel measures");
    harness.get_by_label("Measurements").click();
    for _ in 0..harness.state().breeds.len() + 4 {
        harness.step();
    }
    harness.run();
    harness
}

#[test]
fn the_measurements_are_not_those_of_the_head_that_is_shown() {
    let mut harness = measured();
    let is_true = |state: &EditorState| {
        let rig = Arc::new(Rig::embedded(&state.table).unwrap());
        let found = Calliper::new(rig).unwrap().measure(&state.breed().values);
        assert_eq!(state.measures.found(), found);
        found
    };
    let before = is_true(harness.state());
    let state = harness.state();
    assert_eq!(state.measures.n_surveyed(), state.breeds.len());
    let at = before.iter().position(|m| m.id == "skull_length").unwrap();
    let rank = state.measures.percentile(at).unwrap();
    assert!((50.0..90.0).contains(&rank), "a Labrador's skull is longer than most: {rank}");
    assert!(harness.query_by_label("mesaticephalic").is_some());

    let (label, _, other) = measure(harness.state(), "facial_length_mm");
    harness.get_by_role_and_label(Role::Slider, &label).set_value_accesskit(other);
    harness.run();
    assert_ne!(is_true(harness.state())[at].value, before[at].value);
    assert_ne!(harness.state().measures.percentile(at), Some(rank));
}

#[test]
fn the_cephalic_index_is_no_handle() {
    let mut harness = measured();
    let before = harness.state().breed().clone();
    let width = harness.state().table.index_of("zygomatic_width_mm").unwrap();
    let index = |h: &Harness<'_, EditorState>| h.state().skull_index().unwrap().0;
    for wanted in [60.0, 48.0] {
        harness.get_by_role_and_label(Role::SpinButton, "Cephalic index").set_value_accesskit(wanted);
        harness.run();
        assert!((f64::from(index(&harness)) - wanted).abs() < 0.05, "{} is not {wanted}", index(&harness));
    }
    let combo = |h: &Harness<'_, EditorState>| h.get_by_role_and_label(Role::ComboBox, "Breed").rect().width();
    let wide = combo(&harness);
    harness.run_steps(5);
    assert_eq!(combo(&harness), wide, "a width of many digits pushes the panel wider");
    harness.get_by_role_and_label(Role::SpinButton, "Cephalic index").set_value_accesskit(900.0);
    harness.run();
    let state = harness.state();
    assert_eq!(state.breed().values[width], state.table.specs[width].max_si(), "stops at the end of the range");
    let others = |b: &Breed| b.values.iter().enumerate().filter(|(i, _)| *i != width).map(|v| *v.1).collect::<Vec<_>>();
    assert_eq!(others(state.breed()), others(&before), "only the width has changed");
    for _ in 0..3 {
        harness.get_by_label("Undo").click();
        harness.run();
    }
    assert_eq!(*harness.state().breed(), before);
}

// ---- values that follow ----

#[test]
fn a_measure_that_follows_cannot_be_unlinked_or_linked_again() {
    let mut harness = harness();
    let (label, width, _) = measure(harness.state(), "cranial_width_mm");
    let (leader, length, _) = measure(harness.state(), "cranial_length_mm");
    let value = |h: &Harness<'_, EditorState>| h.state().breed().values[width];
    let drag = |h: &mut Harness<'_, EditorState>, to: f64| {
        h.get_by_role_and_label(Role::Slider, &leader).set_value_accesskit(to);
        h.run();
    };
    let follows = format!("follows {}", leader.to_lowercase());
    let is_told = |h: &Harness<'_, EditorState>| h.query_all_by_label(&follows).count();
    let others = is_told(&harness);
    assert!(harness.state().breed().set[width]);
    harness.get_by_label(&format!("Link {label}")).click();
    harness.run();
    assert!(!harness.state().breed().set[width] && is_told(&harness) == others + 1);
    let before = value(&harness);
    drag(&mut harness, 130.0);
    let wide = value(&harness);
    assert!(wide > before, "a longer cranium is wider");

    harness.get_by_label(&format!("Unlink {label}")).click();
    harness.run();
    assert!(harness.state().breed().set[width] && is_told(&harness) == others);
    assert_eq!(value(&harness), wide, "stays as it stood");
    drag(&mut harness, 90.0);
    assert_eq!(value(&harness), wide);
    assert!(harness.state().is_overridden(length));
}

// ---- the coat today ----

#[test]
fn a_slider_of_the_coat_changes_the_breed_or_nothing() {
    let mut harness = harness();
    let before = harness.state().breed().clone();
    harness.get_by_label("Coat today").click();
    harness.run();
    for (k, field) in Condition::FIELDS.into_iter().enumerate() {
        harness.get_by_role_and_label(Role::Slider, field.label).set_value_accesskit(0.25 + 0.1 * k as f64);
        harness.run();
        let mut condition = harness.state().condition;
        assert!((*(field.of)(&mut condition) - 0.25 - 0.1 * k as f32).abs() < 0.01, "{}", field.label);
    }
    assert_eq!(*harness.state().breed(), before);
    assert!(!harness.state().can_undo());
    harness.get_by_label("As the breed is").click();
    harness.run();
    assert_eq!(harness.state().condition, Condition::default());
}

/// The hashes of the head as it is posed.
fn posed(state: &mut EditorState) -> StageHashes {
    let rig = Arc::new(Rig::embedded(&state.table).unwrap());
    let mut pipeline = Pipeline::new(rig, state.level()).unwrap();
    pipeline.set_pose(state.pose());
    pipeline.update(state.breed());
    pipeline.hashes()
}

#[test]
fn the_mixer_moves_nothing_or_cannot_be_undone() {
    let mut harness = harness();
    let rest = posed(harness.state_mut());
    harness.get_by_label("Motion").click();
    harness.run();
    harness.get_by_role_and_label(Role::Slider, "AU27 Mouth stretch").set_value_accesskit(0.6);
    harness.run();
    let open = posed(harness.state_mut());
    assert_ne!(open.positions, rest.positions);
    assert_eq!(harness.state().motion.typed, "27C");
    harness.get_by_role_and_label(Role::Slider, "AU26 Jaw drop").set_value_accesskit(0.5);
    harness.run();
    posed(harness.state_mut());
    harness.run();
    assert!(harness.query_by_label_contains("AU26 0.50 to 0.00 by AU27").is_some(), "what is overruled is shown");
    harness.get_by_role_and_label(Role::Label, "AU101 Inner brow raiser").click();
    harness.run();
    assert_eq!(harness.state().motion.typed, "101", "a click on the name shows the unit alone");
    harness.get_by_label("Reset motion").click();
    harness.run();
    assert_eq!(posed(harness.state_mut()), rest);
}

/// One history: the dog and what it does, in the order in which they were touched.
#[test]
fn measures_and_motion_are_not_one_history() {
    let mut harness = harness();
    harness.get_by_label("Motion").click();
    harness.run();
    let motion = |harness: &Harness<'static, EditorState>| harness.state().motion.asked();
    let rest = motion(&harness);
    assert!(!harness.state().can_undo(), "opening a panel is no step");
    let (label, index, other) = measure(harness.state(), "facial_length_mm");

    harness.get_by_role_and_label(Role::Slider, "AU27 Mouth stretch").set_value_accesskit(0.6);
    harness.run();
    let open = motion(&harness);
    harness.get_by_role_and_label(Role::Slider, &label).set_value_accesskit(other);
    harness.run();
    harness.get_by_role_and_label(Role::Button, "fear").click();
    harness.run();
    let afraid = motion(&harness);
    harness.get_by_role_and_label(Role::Slider, "Pupils").set_value_accesskit(3.0);
    harness.run();
    let yawn = harness.state().motion.library.clips.iter().position(|c| c.id == "yawn").unwrap();
    harness.state_mut().motion.set_clip(Some(yawn));
    (0..5).for_each(|_| harness.step());
    harness.get_by_label("Pause").click();
    harness.run_steps(2);
    harness.run();
    let stopped = motion(&harness);
    assert!(harness.state().motion.timeline().0 > 0.0);
    harness.state_mut().motion.scrub(0.01);
    harness.run();

    let undo = |harness: &mut Harness<'static, EditorState>| {
        harness.get_by_label("Undo").click();
        harness.run();
    };
    undo(&mut harness);
    assert_eq!(motion(&harness), stopped, "back to where it was stopped");
    undo(&mut harness);
    assert_eq!((harness.state().motion.clip(), harness.state().motion.pupils()), (None, 3.0));
    undo(&mut harness);
    assert_eq!(motion(&harness), afraid);
    undo(&mut harness);
    assert_eq!(motion(&harness), open);
    assert!(harness.state().is_overridden(index), "the measure was set before the expression");
    undo(&mut harness);
    assert_eq!(motion(&harness), open);
    assert!(!harness.state().is_overridden(index));
    undo(&mut harness);
    assert_eq!(motion(&harness), rest);
    assert!(!harness.state().can_undo(), "time that passes is no step");
    for _ in 0..3 {
        harness.get_by_label("Redo").click();
        harness.run();
    }
    assert_eq!(motion(&harness), afraid);
    assert!(harness.state().is_overridden(index));
}

/// A hand that drags a unit, or types a word, makes one step.
#[test]
fn a_drag_of_a_unit_is_many_steps() {
    let mut state = state();
    let brow = state.motion.library.units.index_of("AU101").unwrap();
    for step in 1..=10 {
        state.motion.set_unit(brow, [step as f32 / 10.0; 2]);
        state.note_motion(true);
    }
    state.end_gesture();
    state.undo();
    assert!(state.motion.units().is_rest() && !state.can_undo());
    state.redo();
    assert_eq!(state.motion.units().get(brow), [1.0; 2]);
    assert_eq!(state.motion.typed, "101", "the field says what is asked for");
}

#[test]
fn typed_notation_moves_nothing_or_its_mistake_is_not_shown() {
    let mut harness = harness();
    harness.get_by_label("Motion").click();
    harness.run();
    harness.get_by_role_and_label(Role::TextInput, "FACS").focus();
    harness.run();
    harness.get_by_role_and_label(Role::TextInput, "FACS").type_text("101+EAD103LB");
    harness.run();
    let units = &harness.state().motion.library.units;
    let (brow, ear) = (units.index_of("AU101").unwrap(), units.index_of("EAD103").unwrap());
    let asked = harness.state().motion.units();
    assert_eq!((asked.get(brow), asked.get(ear)), ([1.0; 2], [0.4, 0.0]));
    harness.get_by_role_and_label(Role::TextInput, "FACS").type_text("+");
    harness.run();
    assert!(harness.query_by_label_contains("a code such as 101").is_some());
}

#[test]
fn a_clip_does_not_play_stop_or_step() {
    let mut harness = harness();
    harness.get_by_label("Motion").click();
    harness.run();
    let yawn = harness.state().motion.library.clips.iter().position(|c| c.id == "yawn").unwrap();
    harness.state_mut().motion.set_clip(Some(yawn));
    // A playing clip wants picture after picture: it never comes to rest by itself.
    (0..30).for_each(|_| harness.step());
    let (time, _) = harness.state().motion.timeline();
    assert!(time > 0.1, "{time}");
    harness.get_by_label("Pause").click();
    harness.run_steps(2);
    harness.run();
    let stopped = harness.state().motion.timeline().0;
    harness.run();
    assert_eq!(harness.state().motion.timeline().0, stopped);
    harness.key_press(egui::Key::Period);
    harness.run();
    assert!(harness.state().motion.timeline().0 > stopped);
}

#[test]
fn an_expression_does_not_take_its_course_by_key() {
    let mut harness = harness();
    harness.get_by_label("Motion").click();
    harness.run();
    let anger = harness.state().motion.library.expressions.iter().position(|e| e.id == "anger").unwrap();
    harness.state_mut().motion.show_expression(anger);
    harness.run();
    assert_eq!(harness.state().motion.timeline().1, None);
    harness.key_press(egui::Key::Space);
    (0..10).for_each(|_| harness.step());
    let (time, length) = harness.state().motion.timeline();
    assert!(time > 0.05 && length == Some(harness.state().motion.library.expressions[anger].seconds()), "{time}");
    harness.key_press(egui::Key::T);
    harness.run_steps(2);
    assert!(!harness.state().motion.takes_course());
    assert_eq!(harness.state().motion.timeline().1, None);
}
