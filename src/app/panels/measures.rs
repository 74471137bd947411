//! What a vet would measure on the head that is shown: number, place among the breeds, and what it is held against.

use crate::anatomy::Reference;
use crate::app::state::EditorState;
use crate::measure::{Deviation, Measurement, SkullClass, Tissue};
use egui::RichText;

/// The class, the cephalic index as a handle, and every measurement.
pub fn ui(state: &mut EditorState, ui: &mut egui::Ui) {
    if state.measure() {
        ui.ctx().request_repaint();
    }
    ui.add_space(4.0);
    class(state, ui);
    ui.separator();
    egui::ScrollArea::both().auto_shrink(false).show(ui, |ui| {
        // A column that wraps in one picture and not in the next would never come to rest.
        ui.style_mut().wrap_mode = Some(egui::TextWrapMode::Extend);
        for (tissue, heading) in [(Tissue::Bone, "On bone"), (Tissue::Skin, "On skin")] {
            ui.strong(heading);
            egui::Grid::new(heading).num_columns(4).striped(true).show(ui, |ui| {
                for (k, m) in state.measures.found().iter().enumerate().filter(|(_, m)| m.tissue == tissue) {
                    row(state, ui, k, m);
                }
            });
            ui.add_space(8.0);
        }
    });
}

/// The class of the skull, and the index that it goes by.
fn class(state: &mut EditorState, ui: &mut egui::Ui) {
    let (known, all) = (state.measures.n_surveyed(), state.breeds.len());
    let among = if known < all { format!("{known} of {all} breeds so far") } else { format!("{all} breeds") };
    let Some((index, [min, max])) = state.skull_index() else { return };
    ui.horizontal(|ui| {
        let label = ui.label("Cephalic index");
        let mut value = index;
        let number = egui::DragValue::new(&mut value).range(min..=max).speed(0.2).fixed_decimals(1);
        let number = ui.add(number.update_while_editing(false).clamp_existing_to_range(false)).labelled_by(label.id);
        let number = number.on_hover_text("Drag: the zygomatic width changes so that this is the index");
        if number.changed() && value != index {
            if number.dragged() || ui.input(|i| i.pointer.any_down()) {
                state.begin_gesture();
            }
            state.set_skull_index(value);
        }
        ui.strong(SkullClass::of(index).name());
    });
    ui.weak(format!(
        "p: percentile among {among}. At the right what the breed is held against (m measured, c computed, e estimated), and \
         how far off this head is."
    ));
}

fn row(state: &EditorState, ui: &mut egui::Ui, k: usize, m: &Measurement) {
    ui.label(m.label).on_hover_text(m.definition);
    let unit = m.dimension.unit();
    let gap = if unit.is_empty() { "" } else { " " };
    let number = format!("{:.*}{gap}{unit}", m.dimension.decimals(), m.value);
    ui.monospace(number).on_hover_text(m.definition);
    let rank = state.measures.percentile(k).map_or(String::new(), |p| format!("p{p:.0}"));
    ui.label(RichText::new(rank).monospace().weak());
    match state.breed().reference(m.id) {
        Some(first) => {
            let (letter, off) = (&first.status.name()[..1], Deviation::of(m, first));
            let text = format!("{:.*} {letter} {off}", m.dimension.decimals(), first.value);
            ui.label(RichText::new(text).monospace().weak()).on_hover_ui(|ui| {
                for known in state.breed().references.iter().filter(|r| r.quantity.id == m.id) {
                    ui.label(told(m, known));
                }
            });
        }
        None => drop(ui.label("")),
    }
    ui.end_row();
}

/// One reference in full.
fn told(m: &Measurement, reference: &Reference) -> String {
    let Reference { quantity, value, status, source } = reference;
    let gap = if quantity.unit.is_empty() { "" } else { " " };
    format!("{value}{gap}{}, {status}: {source}. Here {}", quantity.unit, Deviation::of(m, reference))
}
