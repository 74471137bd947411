//! Drives the panels without a window, and looks at the head that comes of it.
//!
//! `cargo test --features ui-tests --test ui`.

use egui::accesskit::Role;
use egui_kittest::{Harness, kittest::Queryable as _};
use londra::anatomy::{Breed, ParamTable};
use londra::app::{Document, EditorState, files, panels};
use londra::frame::{Pipeline, StageHashes};
use londra::rig::Rig;
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
