//! What the head does: expressions, a timeline of clips, notation, and a mixer of DogFACS units by group.

use crate::app::Pictures;
use crate::app::motion::Motion;
use crate::app::state::EditorState;
use crate::motion::{Channel, Group, Overruled, Sides};
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
    overruled(motion, ui);
    ui.separator();
    egui::ScrollArea::vertical().auto_shrink(false).show(ui, |ui| {
        egui::CollapsingHeader::new("Expressions").default_open(true).show(ui, |ui| {
            expressions(motion, state.pictures.as_ref(), ui);
        });
        ui.horizontal(|ui| {
            ui.checkbox(&mut motion.one_sided, "one-sided")
                .on_hover_text("A slider for each side, where a unit has two");
            ui.weak("A click on a name shows it alone; blue: what is shown");
        });
        for group in Group::ALL.into_iter().filter(|group| *group != Group::Gross) {
            let n = motion.n_shown(group);
            let title = if n > 0 { format!("{} ({n})", group.label()) } else { group.label().to_owned() };
            let header = egui::CollapsingHeader::new(title).id_salt(("units", group)).default_open(true);
            header.show(ui, |ui| units(motion, group, ui));
        }
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

fn one_decimal(value: f64, _: std::ops::RangeInclusive<usize>) -> String {
    format!("{value:.1}")
}

/// The units as researchers write them.
fn notation(motion: &mut Motion, ui: &mut egui::Ui) {
    ui.horizontal(|ui| {
        let label = ui.label("FACS");
        let hint = "Codes joined by +, as 101+12B+EAD103L; A to E are 0.2 to 1";
        let field = egui::TextEdit::singleline(&mut motion.typed).desired_width(f32::INFINITY);
        let field = ui.add(field).labelled_by(label.id).on_hover_text(hint);
        motion.is_typing = field.has_focus();
        if field.changed() {
            motion.read_notation();
        }
    });
    if let Some(mistake) = &motion.mistake {
        ui.colored_label(ui.visuals().error_fg_color, mistake);
    }
}

/// Which clip, whether expressions take their course, and where in it.
fn timeline(motion: &mut Motion, ui: &mut egui::Ui) {
    ui.horizontal_wrapped(|ui| {
        let label = ui.label("Clip");
        let now = motion.clip();
        let name = now.and_then(|clip| motion.library.clips.get(clip)).map_or("none", |clip| clip.label.as_str());
        let mut choice = None;
        let list = egui::ComboBox::from_id_salt("clip").selected_text(name).height(520.0).show_ui(ui, |ui| {
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
            motion.play_or_pause();
        }
        for (name, frames, hint) in [("◀", -1, "A frame back (,)"), ("▶", 1, "A frame on (.)")] {
            if ui.button(name).on_hover_text(hint).clicked() {
                motion.step(frames);
            }
        }
        ui.checkbox(&mut motion.loops, "loop").on_hover_text("What is over starts anew");
        let label = ui.label("Speed");
        let speed = egui::DragValue::new(&mut motion.speed).range(0.05..=4.0).speed(0.01).suffix(" ×");
        ui.add(speed).labelled_by(label.id);
        let mut course = motion.takes_course();
        let hint =
            "Expressions come, stay and go as their recipes have it (T); else they stand still where they show best";
        if ui.checkbox(&mut course, "expressions in time").on_hover_text(hint).changed() {
            motion.set_course(course);
        }
    });
    let (mut time, length) = motion.timeline();
    if let Some(length) = length {
        ui.horizontal(|ui| {
            let label = ui.label("Time");
            ui.spacing_mut().slider_width = (ui.available_width() - 90.0).max(60.0);
            let slider = egui::Slider::new(&mut time, 0.0..=length).custom_formatter(two_decimals).suffix(" s");
            if ui.add(slider).labelled_by(label.id).changed() {
                motion.scrub(time);
            }
        });
    } else if motion.is_playing {
        ui.weak(format!("{time:.2} s"));
    }
}

/// The least side of an expression's picture, and the space between two of them, points.
const PICTURE: f32 = 72.0;
const GAP: f32 = 6.0;
/// Room for the number beside a slider, points, and the part of a row that a unit's name has.
const NUMBER: f32 = 56.0;
/// What a row leaves free: one that is as wide as the panel would widen it, again and again.
const SLACK: f32 = 12.0;
const NAME: f32 = 0.5;
/// Size of a caption, points.
const CAPTION: f32 = 11.0;

/// A picture, which is a button, and a weight for each expression.
fn expressions(motion: &mut Motion, pictures: Option<&Pictures>, ui: &mut egui::Ui) {
    let room = ui.available_width() - SLACK + GAP;
    let n_columns = (room / (PICTURE + GAP)).floor().max(1.0);
    let side = room / n_columns - GAP;
    let n_columns = n_columns as usize;
    egui::Grid::new("expressions").num_columns(n_columns).spacing([GAP, 8.0]).show(ui, |ui| {
        for number in 0..motion.library.expressions.len() {
            ui.vertical(|ui| expression(motion, number, pictures, side, ui));
            if (number + 1) % n_columns == 0 {
                ui.end_row();
            }
        }
    });
}

/// `side`: of its picture, points.
fn expression(motion: &mut Motion, number: usize, pictures: Option<&Pictures>, side: f32, ui: &mut egui::Ui) {
    ui.set_width(side);
    ui.spacing_mut().item_spacing.y = 2.0;
    let expression = &motion.library.expressions[number];
    let (label, name) = (expression.label.clone(), expression.id.replace('_', " "));
    let mut weight = motion.weight(number);
    let (rect, button) = ui.allocate_exact_size(egui::Vec2::splat(side), egui::Sense::click());
    button.widget_info(|| egui::WidgetInfo::selected(egui::Role::Button, true, weight > 0.0, &name));
    let visuals = ui.style().interact_selectable(&button, weight > 0.0);
    ui.painter().rect_filled(rect, 3.0, visuals.weak_bg_fill);
    if let Some((texture, part)) = pictures.and_then(|pictures| pictures.of(number)) {
        ui.painter().image(texture, rect.shrink(2.0), part, egui::Color32::WHITE);
    }
    let edge = match (weight > 0.0, button.hovered()) {
        (true, _) => egui::Stroke::new(2.0, ui.visuals().selection.bg_fill),
        (false, true) => ui.visuals().widgets.hovered.bg_stroke,
        (false, false) => egui::Stroke::NONE,
    };
    ui.painter().rect_stroke(rect, 3.0, edge, egui::StrokeKind::Inside);
    ui.spacing_mut().slider_width = side;
    let slider = part(&mut weight).show_value(false);
    if ui.add(slider).labelled_by(button.id).on_hover_text(format!("{weight:.2} of {label}")).changed() {
        motion.set_weight(number, weight);
    }
    let text = RichText::new(&name).size(CAPTION);
    let text = if weight > 0.0 { text.strong() } else { text };
    ui.add(egui::Label::new(text).wrap().selectable(false));
    if button.on_hover_text(label).clicked() {
        motion.show_expression(number);
    }
}

/// The sliders of a group.
fn units(motion: &mut Motion, group: Group, ui: &mut egui::Ui) {
    let room = ui.available_width() - SLACK - 2.0 * ui.spacing().item_spacing.x;
    let name_width = NAME * room;
    let slider_width = (room - name_width - NUMBER).max(60.0);
    egui::Grid::new(("mixer", group)).num_columns(2).show(ui, |ui| {
        for number in 0..motion.library.units.units.len() {
            let unit = &motion.library.units.units[number];
            if unit.group != group {
                continue;
            }
            let now = motion.units().get(number);
            let is_split = unit.sides == Sides::Each && (motion.one_sided || now[0] != now[1]);
            let (name, hint) = (format!("{} {}", unit.label, unit.name), told(motion, number));
            let text = RichText::new(&name);
            let text = if now == [0.0; 2] { text } else { text.strong() };
            let label = egui::Label::new(text).sense(egui::Sense::click()).wrap();
            let label = ui.vertical(|ui| {
                ui.set_width(name_width);
                // On a line with the slider's rail.
                ui.add_space(2.0);
                ui.add(label).on_hover_cursor(egui::CursorIcon::PointingHand).on_hover_text(hint)
            });
            let label = label.inner;
            if label.clicked() {
                motion.solo(number);
            }
            let mut values = now;
            let shown = motion.shown().get(number);
            let slider = |ui: &mut egui::Ui, value: &mut f32, shown: f32| {
                let slider = ui.add(part(value)).labelled_by(label.id);
                mark(ui, &slider, *value, shown);
                slider.changed()
            };
            let changed = if is_split {
                ui.spacing_mut().slider_width = 0.5 * (slider_width - NUMBER - ui.spacing().item_spacing.x * 2.0);
                let sides =
                    |ui: &mut egui::Ui| slider(ui, &mut values[0], shown[0]) | slider(ui, &mut values[1], shown[1]);
                ui.horizontal(sides).inner
            } else {
                ui.spacing_mut().slider_width = slider_width;
                let mut value = now[0].max(now[1]);
                let changed = slider(ui, &mut value, shown[0].max(shown[1]));
                values = [value; 2];
                changed
            };
            if changed {
                motion.set_unit(number, values);
            }
            ui.end_row();
        }
        if group == Group::Eyes {
            ui.spacing_mut().slider_width = slider_width;
            beside(motion, ui);
        }
    });
}

/// A mark on a slider where the head shows another value than it was moved to: an expression, a clip or a rule makes it.
fn mark(ui: &egui::Ui, slider: &egui::Response, asked: f32, shown: f32) {
    if (asked - shown).abs() < 0.005 {
        return;
    }
    // As egui lays a rail: the handle's radius inside the slider's own width.
    let inset = slider.rect.height() / 2.5;
    let rail = slider.rect.left() + inset..=slider.rect.left() + ui.spacing().slider_width - inset;
    let x = egui::lerp(rail, shown.clamp(0.0, 1.0));
    let stroke = egui::Stroke::new(3.0, ui.visuals().hyperlink_color);
    ui.painter().vline(x, slider.rect.shrink(3.0).y_range(), stroke);
}

/// What of the eyes has no code.
fn beside(motion: &mut Motion, ui: &mut egui::Ui) {
    let limits = &motion.library.limits;
    let (narrowest, widest) = limits.of(Channel::Pupil).range;
    let label = ui.label("Pupils").on_hover_text("Wider in the dark and in arousal, narrower in light");
    let mut width = motion.pupils();
    let slider = egui::Slider::new(&mut width, narrowest..=widest).custom_formatter(one_decimal).suffix(" mm");
    if ui.add(slider).labelled_by(label.id).changed() {
        motion.set_pupils(width);
    }
    ui.end_row();
    let label = ui.label("Vergence").on_hover_text("How far each eye turns to something near, before the nose");
    let mut turn = motion.vergence();
    let slider = egui::Slider::new(&mut turn, 0.0..=MOST_VERGENCE).custom_formatter(one_decimal).suffix("°");
    if ui.add(slider).labelled_by(label.id).changed() {
        motion.set_vergence(turn);
    }
    ui.end_row();
}

/// Of each eye, degrees: on a toy a hand's breadth before the nose.
const MOST_VERGENCE: f32 = 20.0;

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

/// How many lines of it are shown at once.
const MOST_OVERRULED: usize = 4;

/// What did not come as it was asked for, and why.
fn overruled(motion: &Motion, ui: &mut egui::Ui) {
    // At the foot of the panel, where it is seen whatever is being moved. It is there even when it is empty: one that came and
    // went would give the sliders after it other ids, and a hand that drags one would lose it.
    let units = &motion.library.units;
    let line = |told: &Overruled| {
        let (unit, by) = (&units.units[told.unit].label, &units.units[told.by].label);
        let (side, rule) = (told.side.suffix(), &units.rules[told.rule]);
        format!("{unit}{side} {:.2} to {:.2} by {by}: {}", told.from, told.to, rule.why)
    };
    let (first, others) = motion.overruled().split_at(motion.overruled().len().min(MOST_OVERRULED));
    let n_lines = 1 + first.len() + usize::from(!others.is_empty());
    let height = ui.text_style_height(&egui::TextStyle::Body) + ui.spacing().item_spacing.y;
    egui::Panel::bottom("overruled").exact_size(n_lines as f32 * height + 8.0).show(ui, |ui| {
        match first.is_empty() {
            true => ui.weak("Nothing is overruled"),
            false => ui.strong("Overruled"),
        };
        for told in first {
            ui.add(egui::Label::new(line(told)).truncate());
        }
        if !others.is_empty() {
            let all: Vec<String> = others.iter().map(line).collect();
            ui.weak(format!("and {} more", others.len())).on_hover_text(all.join("\n"));
        }
    });
}
