//! What the head does: expressions, a timeline of clips, notation, and a mixer of DogFACS units by group.

use crate::app::motion::Motion;
use crate::app::state::EditorState;
use crate::motion::{Group, Sides};
use egui::RichText;

/// The whole panel.
pub fn ui(state: &mut EditorState, ui: &mut egui::Ui) {
    ui.add_space(4.0);
    ui.spacing_mut().slider_width = 80.0;
    let motion = &mut state.motion;
    ui.horizontal_wrapped(|ui| {
        if ui.button("Reset motion").on_hover_text("Every unit, expression and clip to rest").clicked() {
            motion.reset();
        }
        let mut alive = motion.is_alive();
        let hint = "Blinks, breath, small looks and flicks of the ears";
        if ui.checkbox(&mut alive, "alive").on_hover_text(hint).changed() {
            motion.set_alive(alive);
        }
        let follows = ui.checkbox(&mut motion.follows_pointer, "follows the pointer");
        if follows.on_hover_text("Eyes first, then the head, to where the pointer is over the picture").changed() {
            motion.set_alive(motion.is_alive() || motion.follows_pointer);
        }
        let label = ui.label("Heat");
        let heat = part(&mut motion.stimulus.heat);
        if ui.add(heat).labelled_by(label.id).on_hover_text("A hot dog pants").changed() && !motion.is_alive() {
            motion.set_alive(true);
        }
    });
    notation(motion, ui);
    ui.separator();
    timeline(motion, ui);
    ui.separator();
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        egui::CollapsingHeader::new("Expressions").default_open(true).show(ui, |ui| expressions(motion, ui));
        ui.horizontal(|ui| {
            ui.checkbox(&mut motion.one_sided, "one-sided")
                .on_hover_text("A slider for each side, where a unit has two");
            ui.weak("A click on a name shows the unit alone");
        });
        for group in Group::ALL.into_iter().filter(|group| *group != Group::Gross) {
            let header = egui::CollapsingHeader::new(group.label()).id_salt(("units", group)).default_open(true);
            header.show(ui, |ui| units(motion, group, ui));
        }
        overruled(motion, ui);
    });
}

/// A slider from 0 to 1.
fn part(value: &mut f32) -> egui::Slider<'_> {
    egui::Slider::new(value, 0.0..=1.0).custom_formatter(two_decimals)
}

/// For show alone: a slider that is told to have two decimals would round the value itself.
fn two_decimals(value: f64, _: std::ops::RangeInclusive<usize>) -> String {
    format!("{value:.2}")
}

/// The units as researchers write them.
fn notation(motion: &mut Motion, ui: &mut egui::Ui) {
    ui.horizontal(|ui| {
        let label = ui.label("FACS");
        let hint = "Codes joined by +, as 101+12B+EAD103L; A to E are 0.2 to 1";
        let field = egui::TextEdit::singleline(&mut motion.typed).desired_width(f32::INFINITY);
        if ui.add(field).labelled_by(label.id).on_hover_text(hint).changed() {
            motion.read_notation();
        }
    });
    if let Some(mistake) = &motion.mistake {
        ui.colored_label(ui.visuals().error_fg_color, mistake);
    }
}

/// Which clip, and where in it.
fn timeline(motion: &mut Motion, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        let label = ui.label("Clip");
        let now = motion.clip();
        let name = now.and_then(|clip| motion.library.clips.get(clip)).map_or("none", |clip| clip.label.as_str());
        let mut choice = None;
        let list = egui::ComboBox::from_id_salt("clip").selected_text(name).height(420.0).show_ui(ui, |ui| {
            if ui.selectable_label(now.is_none(), "none").clicked() {
                choice = Some(None);
            }
            for (number, clip) in motion.library.clips.iter().enumerate() {
                if ui.selectable_label(now == Some(number), &clip.label).on_hover_text(&clip.source).clicked() {
                    choice = Some(Some(number));
                }
            }
        });
        list.response.labelled_by(label.id);
        if let Some(clip) = choice {
            motion.set_clip(clip);
        }
        if ui.button(if motion.is_playing { "Pause" } else { "Play" }).on_hover_text("Space").clicked() {
            motion.is_playing = !motion.is_playing;
        }
        for (name, frames, hint) in [("◀", -1, "A frame back (,)"), ("▶", 1, "A frame on (.)")] {
            if ui.button(name).on_hover_text(hint).clicked() {
                motion.step(frames);
            }
        }
        ui.checkbox(&mut motion.loops, "loop").on_hover_text("A clip that is over starts anew");
        let label = ui.label("Speed");
        let speed = egui::DragValue::new(&mut motion.speed).range(0.05..=4.0).speed(0.01).suffix(" ×");
        ui.add(speed).labelled_by(label.id);
    });
    if let (mut time, Some(length)) = motion.timeline() {
        ui.horizontal(|ui| {
            let label = ui.label("Time");
            ui.spacing_mut().slider_width = (ui.available_width() - 90.0).max(60.0);
            let slider = egui::Slider::new(&mut time, 0.0..=length).custom_formatter(two_decimals).suffix(" s");
            if ui.add(slider).labelled_by(label.id).changed() {
                motion.scrub(time);
            }
        });
    }
}

/// A button and a weight for each expression.
fn expressions(motion: &mut Motion, ui: &mut egui::Ui) {
    egui::Grid::new("expressions").num_columns(4).show(ui, |ui| {
        for number in 0..motion.library.expressions.len() {
            let (label, id) = {
                let expression = &motion.library.expressions[number];
                (expression.label.clone(), expression.id.replace('_', " "))
            };
            let mut weight = motion.weight(number);
            let button = ui.selectable_label(weight > 0.0, id).on_hover_text(&label);
            let slider = part(&mut weight).show_value(false);
            if ui.add(slider).labelled_by(button.id).changed() {
                motion.set_weight(number, weight);
            }
            if button.clicked() {
                motion.show_expression(number);
            }
            if number % 2 == 1 {
                ui.end_row();
            }
        }
    });
}

/// The sliders of a group.
fn units(motion: &mut Motion, group: Group, ui: &mut egui::Ui) {
    egui::Grid::new(("mixer", group)).num_columns(3).show(ui, |ui| {
        for number in 0..motion.library.units.units.len() {
            let unit = &motion.library.units.units[number];
            if unit.group != group {
                continue;
            }
            let is_split = motion.one_sided && unit.sides == Sides::Each;
            let (name, hint) = (format!("{} {}", unit.label, unit.name), told(motion, number));
            let now = motion.units().get(number);
            let text = RichText::new(&name);
            let text = if now == [0.0; 2] { text } else { text.strong() };
            let label = ui.add(egui::Label::new(text).sense(egui::Sense::click())).on_hover_text(hint);
            if label.clicked() {
                motion.solo(number);
            }
            let mut values = now;
            let slider = |ui: &mut egui::Ui, value: &mut f32| ui.add(part(value)).labelled_by(label.id).changed();
            let changed = if is_split {
                ui.horizontal(|ui| slider(ui, &mut values[0]) | slider(ui, &mut values[1])).inner
            } else {
                let mut value = now[0].max(now[1]);
                let changed = slider(ui, &mut value);
                values = [value; 2];
                changed
            };
            if changed {
                motion.set_unit(number, values);
            }
            ui.end_row();
        }
    });
}

/// What a unit is, for who wants to know.
fn told(motion: &Motion, number: usize) -> String {
    let unit = &motion.library.units.units[number];
    let drives =
        unit.drives.iter().map(|drive| format!("{} {}", drive.target.id(&motion.library.muscles), drive.value));
    let mut text = format!("{}\nMoves {}\n{}", unit.criterion, drives.collect::<Vec<_>>().join(", "), unit.source);
    if !unit.lacks.is_empty() {
        text.push_str(&format!("\nNot done: {}", unit.lacks));
    }
    text
}

/// What did not come as it was asked for, and why.
fn overruled(motion: &Motion, ui: &mut egui::Ui) {
    if motion.overruled().is_empty() {
        return;
    }
    ui.separator();
    ui.strong("Overruled");
    let units = &motion.library.units;
    for told in motion.overruled() {
        let (unit, by) = (&units.units[told.unit].label, &units.units[told.by].label);
        let (side, rule) = (told.side.suffix(), &units.rules[told.rule]);
        ui.label(format!("{unit}{side} {:.2} to {:.2} by {by}: {}", told.from, told.to, rule.why));
    }
}
