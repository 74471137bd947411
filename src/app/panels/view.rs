//! How the head is shown, and the line of numbers below it.

use crate::app::state::{EditorState, MOST_LEVEL};
use crate::coat;
use crate::render::{Lens, Preset, Shading, View};

/// Shading, level, named views, lens.
pub fn ui(state: &mut EditorState, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        let kinds = [
            (Shading::Shaded, "Shaded", "Surfaces"),
            (Shading::Wireframe, "Wireframe", "Every edge (W)"),
            (Shading::Control, "Control mesh", "The coarse mesh that is refined (G)"),
        ];
        for (kind, label, help) in kinds {
            if ui.selectable_label(state.shading == kind, label).on_hover_text(help).clicked() {
                state.shading = kind;
            }
        }
        ui.separator();
        let label = ui.label("Level");
        let mut level = state.level();
        ui.spacing_mut().slider_width = 60.0;
        let slider = egui::Slider::new(&mut level, 0..=MOST_LEVEL);
        if ui.add(slider).labelled_by(label.id).on_hover_text("Steps of refinement (+ and −)").changed() {
            state.set_level(level);
        }
        ui.separator();
        for view in View::NAMED {
            if ui.button(view.name()).clicked() {
                state.look_from(view);
            }
        }
        if ui.button("fit").on_hover_text("F").clicked() {
            state.wants_fit = true;
        }
        let mut parallel = state.camera.lens == Lens::Orthographic;
        if ui.checkbox(&mut parallel, "parallel").on_hover_text("Without perspective").changed() {
            state.camera.lens = if parallel { Lens::Orthographic } else { Lens::default() };
        }
        let card = ui.checkbox(&mut state.on_card, "GPU");
        card.on_hover_text("Refine on the graphics card what is drawn; numbers and files stay the processor's");
        ui.separator();
        let layers = &mut state.layers;
        let label = ui.label("Skin layer");
        let slider = egui::Slider::new(&mut layers.skin, 0.0..=1.0).fixed_decimals(2);
        ui.add(slider).labelled_by(label.id).on_hover_text("How much of the skin is seen; 0 hides it");
        ui.checkbox(&mut layers.eyes, "eyes").on_hover_text("Eyeballs, third eyelids, tears");
        ui.checkbox(&mut layers.whiskers, "whiskers").on_hover_text("Whiskers");
        ui.checkbox(&mut layers.bone, "bone").on_hover_text("Skull and mandible");
        ui.checkbox(&mut layers.teeth, "teeth").on_hover_text("Crowns of the teeth");
        ui.checkbox(&mut layers.mouth, "mouth").on_hover_text("Gums, palate, floor of the mouth");
        ui.checkbox(&mut layers.tongue, "tongue").on_hover_text("Tongue");
        ui.separator();
        preset(state, ui);
        hair(state, ui);
        ui.separator();
        let taken = ui.selectable_label(state.measures.is_open, "Measurements");
        if taken.on_hover_text("What a vet would measure on this head (M)").clicked() {
            state.measures.is_open = !state.measures.is_open;
        }
        let shown = ui.selectable_label(state.motion.is_open, "Motion");
        if shown.on_hover_text("Units, expressions and clips (U)").clicked() {
            state.toggle_motion();
        }
        if ui.selectable_label(state.shows_keys, "?").on_hover_text("Keys").clicked() {
            state.shows_keys = !state.shows_keys;
        }
    });
}

/// In which light, and as what.
fn preset(state: &mut EditorState, ui: &mut egui::Ui) {
    let label = ui.label("Preset");
    let mut chosen = state.preset();
    let choice = egui::ComboBox::from_id_salt("preset").selected_text(chosen.name()).width(80.0).show_ui(ui, |ui| {
        for preset in Preset::ALL {
            ui.selectable_value(&mut chosen, preset, preset.name()).on_hover_text(preset.about());
        }
    });
    choice.response.labelled_by(label.id).on_hover_text("Light, ground and what the head is made of");
    if chosen != state.preset() {
        state.set_preset(chosen);
    }
}

/// How many strands of hair.
fn hair(state: &mut EditorState, ui: &mut egui::Ui) {
    let label = ui.label("Hair");
    let name = coat::LEVELS.iter().find(|(_, n)| *n == state.n_strands as usize).map_or("other", |(name, _)| *name);
    let choice = egui::ComboBox::from_id_salt("hair").selected_text(name).width(60.0).show_ui(ui, |ui| {
        for (name, n) in coat::LEVELS {
            ui.selectable_value(&mut state.n_strands, n as u32, name);
        }
    });
    choice.response.labelled_by(label.id).on_hover_text("Strands of hair on the head");
}

/// Triangles and times at the right, the last message at the left.
pub fn status(state: &EditorState, ui: &mut egui::Ui) {
    ui.horizontal(|ui| {
        let times = state.timing;
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            let numbers = format!(
                "{} triangles   head {:.1} ms   CPU {:.1} ms   total {:.1} ms",
                grouped(state.n_triangles),
                times.head_ms,
                times.cpu_ms,
                times.total_ms
            );
            ui.monospace(numbers);
            ui.with_layout(egui::Layout::left_to_right(egui::Align::Center), |ui| {
                let Some(message) = &state.message else { return };
                let error = ui.visuals().error_fg_color;
                let text = egui::RichText::new(&message.text);
                let text = if message.is_error { text.color(error) } else { text };
                ui.add(egui::Label::new(text).truncate()).on_hover_text(&message.text);
            });
        });
    });
}

/// Digits in groups of three.
fn grouped(n: usize) -> String {
    let digits = n.to_string();
    let mut out = String::new();
    for (i, digit) in digits.chars().enumerate() {
        if i > 0 && (digits.len() - i).is_multiple_of(3) {
            out.push('\u{2009}');
        }
        out.push(digit);
    }
    out
}

#[cfg(test)]
mod tests {
    #[test]
    fn digits_stand_in_groups_of_three() {
        let plain = |n| super::grouped(n).replace('\u{2009}', " ");
        assert_eq!([plain(7), plain(1234), plain(123456)], ["7", "1 234", "123 456"]);
    }
}
