//! What stands around the picture: one `ui` function a panel.

pub mod anatomy;
pub mod breed;
mod coat;
pub mod files;
mod keys;
pub mod measures;
pub mod motion;
pub mod view;

use super::input;
use super::state::{Command, EditorState};
use std::sync::Arc;

/// Takes the fonts that the program carries: one for reading, one for numbers and signs.
pub fn set_fonts(ctx: &egui::Context) {
    let mut fonts = egui::FontDefinitions::empty();
    let carried = [("text", epaint_default_fonts::UBUNTU_LIGHT), ("numbers", epaint_default_fonts::HACK_REGULAR)];
    for (name, data) in carried {
        fonts.font_data.insert(name.to_owned(), Arc::new(egui::FontData::from_static(data)));
    }
    let names = |order: [&str; 2]| order.map(str::to_owned).to_vec();
    fonts.families.insert(egui::FontFamily::Proportional, names(["text", "numbers"]));
    fonts.families.insert(egui::FontFamily::Monospace, names(["numbers", "text"]));
    ctx.set_fonts(fonts);
}

/// The whole window. `picture`: the texture of the head, drawn after this returns. Returns the rectangle it fills,
/// in points.
pub fn show(state: &mut EditorState, ui: &mut egui::Ui, picture: Option<egui::TextureId>) -> egui::Rect {
    input::keys(state, ui.ctx());
    egui::Panel::bottom("status").show(ui, |ui| view::status(state, ui));
    egui::Panel::left("measures").default_size(372.0).size_range(300.0..=620.0).show(ui, |ui| {
        ui.add_space(4.0);
        files::ui(state, ui);
        ui.separator();
        breed::ui(state, ui);
        coat::ui(state, ui);
        ui.separator();
        anatomy::ui(state, ui);
    });
    egui::Panel::top("view").show(ui, |ui| view::ui(state, ui));
    if state.measures.is_open {
        let panel = egui::Panel::right("taken").default_size(400.0).size_range(260.0..=620.0);
        panel.show(ui, |ui| measures::ui(state, ui));
    }
    if state.motion.is_open {
        let panel = egui::Panel::right("motion").default_size(430.0).size_range(300.0..=680.0);
        panel.show(ui, |ui| motion::ui(state, ui));
    }
    let is_down = ui.input(|i| i.pointer.any_down());
    let is_held = is_down || state.motion.is_typing;
    state.note_motion(is_held);
    if state.motion.is_playing {
        state.pass(f64::from(ui.input(|i| i.stable_dt)));
        ui.ctx().request_repaint();
    }
    let central = egui::CentralPanel::no_frame().show(ui, |ui| {
        let area = ui.available_size().max(egui::vec2(1.0, 1.0));
        let (rect, response) = ui.allocate_exact_size(area, egui::Sense::click_and_drag());
        if let Some(texture) = picture {
            let whole = egui::Rect::from_min_max(egui::pos2(0.0, 0.0), egui::pos2(1.0, 1.0));
            ui.painter().image(texture, rect, whole, egui::Color32::WHITE);
        }
        if response.clicked() || response.drag_started() {
            // A click beside a text field ends the typing, so that keys steer the camera again.
            ui.memory_mut(|m| m.stop_text_input());
        }
        input::pointer(state, ui, &response);
        rect
    });
    keys::ui(state, ui.ctx());
    quit_question(state, ui.ctx());
    drop_hint(ui.ctx());
    if !is_held {
        state.end_gesture();
    }
    central.inner
}

/// Asks before changes are lost.
fn quit_question(state: &mut EditorState, ctx: &egui::Context) {
    if !state.asks_to_quit {
        return;
    }
    let asked = egui::Modal::new(egui::Id::unique("quit")).show(ctx, |ui| {
        ui.heading("Unsaved changes");
        ui.label(format!("{} has changes that are in no file.", state.breed().label));
        ui.add_space(8.0);
        ui.horizontal(|ui| {
            if ui.button("Save and leave").clicked() {
                state.asks_to_quit = false;
                state.commands.push_back(Command::SaveAndQuit);
            }
            if ui.button("Leave without saving").clicked() {
                state.asks_to_quit = false;
                state.commands.push_back(Command::Quit);
            }
            if ui.button("Stay").clicked() {
                state.asks_to_quit = false;
            }
        });
    });
    // Escape, or a click beside the question.
    if asked.should_close() {
        state.asks_to_quit = false;
    }
}

/// While a file is held over the window: what letting go would do.
fn drop_hint(ctx: &egui::Context) {
    if ctx.input(|i| i.raw.hovered_files.is_empty()) {
        return;
    }
    egui::Modal::new(egui::Id::unique("drop")).show(ctx, |ui| ui.heading("Let go to open the breed file"));
}
