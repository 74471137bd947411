//! Every measure as a slider with its number, by group.

use crate::anatomy::ParamSpec;
use crate::app::state::EditorState;
use egui::{Color32, RichText, Stroke};

/// Search field, filter, and the sliders of what was found.
pub fn ui(state: &mut EditorState, ui: &mut egui::Ui) {
    ui.horizontal(|ui| {
        let label = ui.label("Search");
        let field = egui::TextEdit::singleline(&mut state.search).hint_text("muzzle, ear, snout…").desired_width(130.0);
        ui.add(field).labelled_by(label.id);
        if !state.search.is_empty() && ui.small_button("×").on_hover_text("Clear the search").clicked() {
            state.search.clear();
        }
        ui.checkbox(&mut state.only_changed, "changed");
        let any = !state.document().overrides.is_empty();
        if ui.add_enabled(any, egui::Button::new("Reset all")).clicked() {
            state.reset_all();
        }
    });
    let found = state.found();
    if found.is_empty() {
        ui.weak(if state.only_changed { "No measure has been changed." } else { "No measure is called that." });
    }
    let is_narrowed = !state.search.is_empty() || state.only_changed;
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        // What a row needs must not widen the panel.
        ui.set_max_width(ui.available_width());
        for (group, rows) in groups(state, &found) {
            let header = egui::CollapsingHeader::new(RichText::new(&group).strong()).default_open(true);
            let header = header.open(is_narrowed.then_some(true));
            header.show(ui, |ui| {
                for index in rows {
                    row_in_sight(state, ui, index);
                }
            });
        }
        ui.add_space(8.0);
    });
}

/// Rows under their headings, headings in the order of the table.
fn groups(state: &EditorState, found: &[usize]) -> Vec<(String, Vec<usize>)> {
    let mut groups: Vec<(String, Vec<usize>)> = Vec::new();
    for &index in found {
        let group = &state.table.specs[index].group;
        match groups.iter_mut().find(|(name, _)| name == group) {
            Some((_, rows)) => rows.push(index),
            None => groups.push((group.clone(), vec![index])),
        }
    }
    groups
}

/// So far beyond the edge rows are still there, for the Tab key to reach, points.
const BEYOND_SIGHT: f32 = 100.0;
/// For a number of three decimals and its unit, and for the reset arrow, points. A row that is wider pushes the panel wider in
/// every picture.
const NUMBER_WIDTH: f32 = 92.0;
const RESET_WIDTH: f32 = 22.0;

/// A row, or the room that it took last time while it is scrolled out of sight: most of sixty rows are.
fn row_in_sight(state: &mut EditorState, ui: &mut egui::Ui, index: usize) {
    let id = ui.scope_id().with(&state.table.specs[index].id);
    let top = ui.cursor().min;
    let known: Option<f32> = ui.data(|d| d.get_temp(id));
    if let Some(height) = known {
        let sight = ui.clip_rect().y_range().expand(BEYOND_SIGHT);
        if top.y > sight.max || top.y + height < sight.min {
            ui.advance_cursor_after_rect(egui::Rect::from_min_size(top, egui::vec2(1.0, height)));
            return;
        }
    }
    let shown = ui.push_id(id, |ui| row(state, ui, index));
    ui.data_mut(|d| d.insert_temp(id, shown.response.rect.height()));
}

/// Label above; slider, number and reset below.
fn row(state: &mut EditorState, ui: &mut egui::Ui, index: usize) {
    let table = state.table.clone();
    let spec = &table.specs[index];
    let is_set = state.breed().set[index];
    let is_changed = state.is_overridden(index);
    let label = ui.horizontal(|ui| {
        let mut text = RichText::new(&spec.label);
        if is_changed {
            text = text.strong();
        } else if !is_set {
            text = text.weak();
        }
        let label = ui.label(text).on_hover_ui(|ui| explain(ui, spec));
        link(state, ui, index);
        label
    });
    let label = label.inner;

    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = 4.0;
        let mut value = spec.from_si(state.breed().values[index]);
        let before = value;
        ui.spacing_mut().slider_width = (ui.available_width() - NUMBER_WIDTH - RESET_WIDTH - 24.0).max(60.0);
        // Only a hand may round a value to the slider's step.
        let slider = egui::Slider::new(&mut value, spec.min..=spec.max).show_value(false).step_by(step(spec));
        let slider = ui.add(slider.clamping(egui::SliderClamping::Edits)).labelled_by(label.id);
        marks(ui, &slider, spec, spec.from_si(state.unchanged().values[index]));
        let number = egui::DragValue::new(&mut value).range(spec.min..=spec.max).suffix(spec.unit.suffix());
        let number = number
            .speed((spec.max - spec.min) / 400.0)
            .max_decimals(3)
            .update_while_editing(false)
            .clamp_existing_to_range(false);
        let number = ui.add_sized([NUMBER_WIDTH, ui.spacing().interact_size.y], number).labelled_by(label.id);

        let doubly = ui.input(|i| i.pointer.button_double_clicked(egui::PointerButton::Primary));
        if (slider.contains_pointer() || label.contains_pointer()) && doubly {
            state.reset(index);
        } else if (slider.changed() || number.changed()) && value != before {
            if slider.dragged() || number.dragged() || ui.input(|i| i.pointer.any_down()) {
                state.begin_gesture();
            }
            state.set_value(index, spec.to_si(value));
        }
        slider.context_menu(|ui| menu(state, ui, index));
        if is_changed {
            let reset = egui::Button::new("↺").small().min_size(egui::vec2(RESET_WIDTH, 0.0));
            let name = format!("Reset {}", spec.label);
            let reset = ui.add(reset).on_hover_text(&name);
            reset.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
            if reset.clicked() {
                state.reset(index);
            }
        }
    });
}

/// Whether the measure follows another one, and from which, with the way to the other state; at the right of the label.
fn link(state: &mut EditorState, ui: &mut egui::Ui, index: usize) {
    let table = state.table.clone();
    let spec = &table.specs[index];
    let is_set = state.breed().set[index];
    let small = |text: &str| RichText::new(text).small().italics().weak();
    let Some(leader) = spec.follows.as_ref().and_then(|f| table.get(&f.id)) else {
        if !is_set {
            ui.label(small("default"));
        }
        return;
    };
    let of = leader.label.to_lowercase();
    ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
        // Out of the scroll bar's way.
        ui.add_space(RESET_WIDTH);
        let (word, help) = match is_set {
            true => {
                let mut linked = state.breed().clone();
                linked.unset(&table, index);
                let [now, then] = [state.breed(), &linked].map(|b| spec.from_si(b.values[index]));
                let suffix = spec.unit.suffix();
                ("link", format!("Let it follow {of}: {now:.1}{suffix} becomes {then:.1}{suffix}"))
            }
            false => ("unlink", format!("Set it as it stands, so that it does not follow {of} any more")),
        };
        let name = format!("{}{} {}", word[..1].to_uppercase(), &word[1..], spec.label);
        let button = ui.add(egui::Button::new(RichText::new(word).small()).small().frame(false)).on_hover_text(help);
        button.widget_info(|| egui::WidgetInfo::labeled(egui::Role::Button, true, &name));
        if button.clicked() && is_set {
            state.let_follow(index);
        } else if button.clicked() {
            state.unlink(index);
        }
        if !is_set {
            ui.add(egui::Label::new(small(&format!("follows {of}"))).truncate());
        }
    });
}

fn menu(state: &mut EditorState, ui: &mut egui::Ui, index: usize) {
    if ui.button("Reset to the breed").clicked() {
        state.reset(index);
        ui.close();
    }
    if ui.button("Set to the default").clicked() {
        let default = state.table.specs[index].default_si();
        state.set_value(index, default);
        ui.close();
    }
    let can_follow = state.table.specs[index].follows.is_some();
    if state.breed().set[index] && ui.button(if can_follow { "Let it follow" } else { "Unset it" }).clicked() {
        state.let_follow(index);
        ui.close();
    }
}

fn explain(ui: &mut egui::Ui, spec: &ParamSpec) {
    ui.set_max_width(340.0);
    ui.strong(&spec.label);
    ui.label(&spec.help);
    if !spec.moves.is_empty() {
        ui.label(format!("Moves: {}", spec.moves));
    }
    let suffix = spec.unit.suffix();
    ui.weak(format!("{}: {} to {}{suffix}, default {}{suffix}", spec.id, spec.min, spec.max, spec.default));
    if !spec.source.is_empty() {
        ui.weak(format!("Source: {}", spec.source));
    }
}

/// The step of a slider: about a thousandth of the range, as a round number.
fn step(spec: &ParamSpec) -> f64 {
    let exponent = ((spec.max - spec.min) / 1000.0).log10().round();
    10f64.powi(exponent as i32)
}

/// A tick at the default, a dot at the breed's own value.
fn marks(ui: &egui::Ui, slider: &egui::Response, spec: &ParamSpec, own: f64) {
    let rect = slider.rect;
    let inset = rect.height() / 2.5;
    let at = |value: f64| {
        let part = ((value - spec.min) / (spec.max - spec.min)).clamp(0.0, 1.0) as f32;
        egui::lerp(rect.left() + inset..=rect.right() - inset, part)
    };
    let colour: Color32 = ui.visuals().weak_text_color();
    let x = at(spec.default);
    let bottom = rect.bottom();
    ui.painter().line_segment([egui::pos2(x, bottom - 4.0), egui::pos2(x, bottom)], Stroke::new(1.0, colour));
    ui.painter().circle_filled(egui::pos2(at(own), rect.top() + 2.0), 1.5, colour);
}
