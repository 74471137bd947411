//! New, open, save, export; undo and redo; what is broken on disk.

use crate::app::state::{Command, EditorState};
use std::path::PathBuf;

/// Buttons, a path that does without dialogs, and messages that must not be missed.
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
    path_row(state, ui);
    ui.horizontal(|ui| {
        if ui.add_enabled(state.can_undo(), egui::Button::new("Undo")).on_hover_text("Ctrl+Z").clicked() {
            state.undo();
        }
        if ui.add_enabled(state.can_redo(), egui::Button::new("Redo")).on_hover_text("Ctrl+Shift+Z").clicked() {
            state.redo();
        }
    });
    for problem in state.problems.values() {
        ui.colored_label(ui.visuals().error_fg_color, problem);
    }
}

/// A path that is typed, and what can be done with it: a way that needs no dialog of the desktop.
fn path_row(state: &mut EditorState, ui: &mut egui::Ui) {
    ui.horizontal(|ui| {
        let label = ui.label("File");
        let buttons = [
            ("Open", "Open the file of this path"),
            ("Save", "Save as a breed file under this path; one that is there is replaced"),
            ("Export", "Write the head as .glb under this path; one that is there is replaced"),
        ];
        let gap = ui.spacing().item_spacing.x;
        let width_of = |text: &str| {
            let font = egui::TextStyle::Button.resolve(ui.style());
            let text = ui.painter().layout_no_wrap(text.to_owned(), font, egui::Color32::WHITE);
            text.size().x + 2.0 * ui.spacing().button_padding.x + gap
        };
        let reserved: f32 = buttons.iter().map(|(text, _)| width_of(text)).sum();
        let field = egui::TextEdit::singleline(&mut state.typed_path).hint_text("path/of/my_dog.ron");
        let field = ui.add(field.desired_width((ui.available_width() - reserved).max(60.0))).labelled_by(label.id);
        let field = field.on_hover_text("Enter opens the file if it is there, and saves or exports to it if not");
        let path = PathBuf::from(state.typed_path.trim());
        let is_named = !path.as_os_str().is_empty();
        if is_named && field.lost_focus() && ui.input(|i| i.key_pressed(egui::Key::Enter)) {
            let is_glb = path.extension().is_some_and(|e| e == "glb");
            state.commands.push_back(match (is_glb, path.exists()) {
                (true, _) => Command::ExportPath(path.clone()),
                (false, true) => Command::OpenPath(path.clone()),
                (false, false) => Command::SavePath(path.clone()),
            });
        }
        for ((text, help), command) in
            buttons.into_iter().zip([Command::OpenPath, Command::SavePath, Command::ExportPath])
        {
            let button = ui.add_enabled(is_named, egui::Button::new(text)).on_hover_text(help);
            let name = format!("{text} this path");
            button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, is_named, &name));
            if button.clicked() {
                state.commands.push_back(command(path.clone()));
            }
        }
    });
}
