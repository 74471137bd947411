//! What the coat is like today, as sliders.

use crate::app::state::EditorState;
use crate::coat::Condition;
use egui::RichText;

/// Length, density, clipped, wet, grey. They are of no file and no step to undo: the breed stays as it is.
pub fn ui(state: &mut EditorState, ui: &mut egui::Ui) {
    let header = egui::CollapsingHeader::new(RichText::new("Coat today").strong()).id_salt("coat today");
    header.show(ui, |ui| {
        egui::Grid::new("condition").num_columns(2).show(ui, |ui| {
            for field in Condition::FIELDS {
                let label = ui.label(field.label).on_hover_text(field.tells);
                ui.spacing_mut().slider_width = (ui.available_width() - 70.0).max(40.0);
                let slider = egui::Slider::new((field.of)(&mut state.condition), 0.0..=field.max).fixed_decimals(2);
                ui.add(slider).labelled_by(label.id).on_hover_text(field.tells);
                ui.end_row();
            }
        });
        let is_usual = state.condition == Condition::default();
        if ui.add_enabled(!is_usual, egui::Button::new("As the breed is")).clicked() {
            state.condition = Condition::default();
        }
    });
}
