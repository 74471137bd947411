//! New, open, save, export; undo and redo; what is broken on disk.

use crate::app::state::{Command, EditorState};
use std::path::PathBuf;

/// Two rows of buttons and the path, and messages that must not be missed.
pub fn ui(state: &mut EditorState, ui: &mut egui::Ui) {
    ui.horizontal(|ui| {
        let buttons = [
            ("New", "Begin a head of which nothing is set (Ctrl+N)", Command::New),
            ("Open…", "Open a breed file (Ctrl+O); a file dropped on the window opens too", Command::Open),
            ("Save", "Save as a breed file (Ctrl+S)", Command::Save),
            ("Export glTF…", "Write the head as .glb (Ctrl+E)", Command::Export),
            ("Screenshot", "Write the picture as .png (F12)", Command::Screenshot),
        ];
        for (label, help, command) in buttons {
            if ui.button(label).on_hover_text(help).clicked() {
                state.commands.push_back(command);
            }
        }
    });
    ui.horizontal(|ui| {
        if ui.add_enabled(state.can_undo(), egui::Button::new("Undo")).on_hover_text("Ctrl+Z").clicked() {
            state.undo();
        }
        if ui.add_enabled(state.can_redo(), egui::Button::new("Redo")).on_hover_text("Ctrl+Shift+Z").clicked() {
            state.redo();
        }
        let label = ui.label("File");
        let field = egui::TextEdit::singleline(&mut state.typed_path).hint_text("path/of/my_dog.ron");
        let path = ui.add(field.desired_width(f32::INFINITY)).labelled_by(label.id);
        let path = path.on_hover_text("Enter opens the file if it is there, and saves to it if not");
        if path.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter)) && !state.typed_path.trim().is_empty() {
            let path = PathBuf::from(state.typed_path.trim());
            let is_glb = path.extension().is_some_and(|e| e == "glb");
            state.commands.push_back(match (is_glb, path.exists()) {
                (true, _) => Command::ExportPath(path),
                (false, true) => Command::OpenPath(path),
                (false, false) => Command::SavePath(path),
            });
        }
    });
    for problem in state.problems.values() {
        ui.colored_label(ui.visuals().error_fg_color, problem);
    }
}
