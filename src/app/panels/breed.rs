//! Which breed in which coat, and which other is mixed in.

use crate::app::state::{Document, EditorState};

/// The list, the name, and the blend.
pub fn ui(state: &mut EditorState, ui: &mut egui::Ui) {
    egui::Grid::new("breed").num_columns(2).show(ui, |ui| {
        let label = ui.label("Breed");
        let chosen = state.document().base.label.clone();
        let mut choice = None;
        let list = egui::ComboBox::from_id_salt("breed").width(ui.available_width()).selected_text(chosen);
        let list = list.height(420.0).show_ui(ui, |ui| {
            for (index, breed) in state.breeds.iter().enumerate() {
                if ui.selectable_label(breed.id == state.document().base.id, &breed.label).clicked() {
                    choice = Some(index);
                }
            }
        });
        list.response.labelled_by(label.id);
        if let Some(index) = choice {
            state.choose(index);
        }
        ui.end_row();

        if !state.document().base.varieties.is_empty() {
            let label = ui.label("Coat");
            coat(state, ui, label.id);
            ui.end_row();
        }

        let label = ui.label("Name");
        let mut name = state.breed().label.clone();
        let field = egui::TextEdit::singleline(&mut name).desired_width(f32::INFINITY);
        if ui.add(field).labelled_by(label.id).changed() {
            state.set_label(&name);
        }
        ui.end_row();

        let label = ui.label("Mixed with");
        partner(state, ui, label.id);
        ui.end_row();

        if let Some(blend) = state.document().blend.as_ref() {
            let label = ui.label("How much");
            let mut percent = blend.weight * 100.0;
            ui.spacing_mut().slider_width = ui.available_width() - 60.0;
            let slider = egui::Slider::new(&mut percent, 0.0..=100.0).suffix(" %").max_decimals(0);
            let slider = ui.add(slider).labelled_by(label.id);
            if slider.changed() {
                if ui.input(|i| i.pointer.any_down()) {
                    state.begin_gesture();
                }
                state.set_weight(percent / 100.0);
            }
            ui.end_row();
        }
    });
    chance(state, ui);
}

/// Random dogs: the button, the seed, what is kept of the dog that is shown.
fn chance(state: &mut EditorState, ui: &mut egui::Ui) {
    ui.horizontal(|ui| {
        let button = ui.button("Random dog").on_hover_text("A dog that differs from the others as breeds do");
        let label = ui.label("Seed");
        ui.add(egui::DragValue::new(&mut state.chance.seed)).labelled_by(label.id);
        if button.clicked() {
            state.random_dog();
        }
    });
    let kept = state.chance.kept.len();
    let title = if kept == 0 { "Keep nothing of this dog".to_owned() } else { format!("Keep {kept} of this dog") };
    egui::CollapsingHeader::new(title).id_salt("kept").show(ui, |ui| {
        ui.horizontal_wrapped(|ui| {
            let mut words: Vec<String> = state.table.specs.iter().map(|s| s.group.clone()).collect();
            words.dedup();
            words.push("coat".into());
            for word in words {
                let mut keeps = state.chance.kept.contains(&word);
                if ui.checkbox(&mut keeps, format!("keep {}", word.to_lowercase())).changed() {
                    if keeps {
                        state.chance.kept.insert(word);
                    } else {
                        state.chance.kept.remove(&word);
                    }
                }
            }
        });
    });
}

/// The coats that the breed comes in.
fn coat(state: &mut EditorState, ui: &mut egui::Ui, label: egui::Id) {
    let Document { base, coat, .. } = state.document();
    let worn = coat.as_deref().or(base.worn()).unwrap_or_default().to_owned();
    let mut choice = None;
    let list = egui::ComboBox::from_id_salt("coat").width(ui.available_width()).selected_text(worn.as_str());
    let list = list.show_ui(ui, |ui| {
        for variety in &base.varieties {
            if ui.selectable_label(variety.name == worn, &variety.name).clicked() {
                choice = Some(variety.name.clone());
            }
        }
    });
    list.response.labelled_by(label);
    if let Some(coat) = choice {
        state.set_coat(&coat);
    }
}

fn partner(state: &mut EditorState, ui: &mut egui::Ui, label: egui::Id) {
    let now = state.document().blend.as_ref().map(|b| (b.partner.id.clone(), b.partner.label.clone()));
    let text = now.as_ref().map_or("nobody", |(_, label)| label).to_owned();
    let mut choice = None;
    let list = egui::ComboBox::from_id_salt("partner").width(ui.available_width()).selected_text(text);
    let list = list.height(420.0).show_ui(ui, |ui| {
        if ui.selectable_label(now.is_none(), "nobody").clicked() {
            choice = Some(None);
        }
        for (index, breed) in state.breeds.iter().enumerate() {
            let is_now = now.as_ref().is_some_and(|(id, _)| *id == breed.id);
            if ui.selectable_label(is_now, &breed.label).clicked() {
                choice = Some(Some(index));
            }
        }
    });
    list.response.labelled_by(label);
    if let Some(partner) = choice {
        state.set_partner(partner);
    }
}
