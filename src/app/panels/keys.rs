//! The list of keys.

use crate::app::input::KEYS;
use crate::app::state::EditorState;

pub(super) fn ui(state: &mut EditorState, ctx: &egui::Context) {
    let mut open = state.shows_keys;
    let window = egui::Window::new("Keys").open(&mut open).anchor(egui::Align2::CENTER_CENTER, egui::Vec2::ZERO);
    window.collapsible(false).resizable(false).show(ctx, |ui| {
        egui::Grid::new("keys").num_columns(2).spacing([24.0, 4.0]).show(ui, |ui| {
            for (key, what) in KEYS {
                ui.strong(*key);
                ui.label(*what);
                ui.end_row();
            }
        });
    });
    state.shows_keys = open;
}
