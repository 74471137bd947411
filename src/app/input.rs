//! Mouse and keys to changes of the state.

use super::camera_control;
use super::state::{Command, EditorState};
use crate::render::{Shading, View};
use egui::{Key, KeyboardShortcut, Modifiers, PointerButton};

/// The keys, for the help and for the README.
pub const KEYS: &[(&str, &str)] = &[
    ("left drag", "turn"),
    ("middle drag, Shift + drag", "move"),
    ("wheel", "nearer, farther"),
    ("F", "fit the head into the picture"),
    ("R, Home", "camera as at the start"),
    ("1, 3, 7", "front, side, top; with Ctrl from the other side"),
    ("2, 4", "portrait, three-quarter"),
    ("L + drag, [ and ]", "turn the lights"),
    ("W", "wireframe"),
    ("G", "control mesh"),
    ("M", "measurements of the head"),
    ("U", "what the head does: units, expressions, clips"),
    ("Space", "play, pause"),
    ("T", "expressions in time, or standing still"),
    (", and .", "one frame back, one on"),
    ("+, −", "finer, coarser"),
    ("Ctrl+Z", "undo"),
    ("Ctrl+Shift+Z, Ctrl+Y", "redo"),
    ("Ctrl+N, Ctrl+O, Ctrl+S", "new, open, save"),
    ("Ctrl+Shift+S", "save under another name"),
    ("Ctrl+E", "export as glTF"),
    ("F12", "screenshot"),
    ("Ctrl+Q", "leave"),
    ("?", "this list"),
];

/// What the pointer does over the picture.
pub fn pointer(state: &mut EditorState, ui: &egui::Ui, picture: &egui::Response) {
    let (shift, lights) = ui.input(|i| (i.modifiers.shift, i.key_down(Key::L)));
    let moved = picture.drag_delta();
    let height = picture.rect.height();
    if picture.dragged_by(PointerButton::Middle) || (picture.dragged_by(PointerButton::Primary) && shift) {
        camera_control::pan(&mut state.camera, moved.x, moved.y, height);
    } else if picture.dragged_by(PointerButton::Primary) && lights {
        state.light_turn += moved.x * 0.01;
    } else if picture.dragged_by(PointerButton::Primary) {
        camera_control::orbit(&mut state.camera, moved.x, moved.y);
    }
    if state.motion.follows_pointer {
        let from_middle = picture.hover_pos().map(|at| (at - picture.rect.center()) / height.max(1.0));
        state.motion.stimulus.target = from_middle.map(|v| camera_control::looked_at(&state.camera, v.x, v.y));
    }
    if let Some(at) = picture.hover_pos() {
        let (wheel, pinch) = ui.input(|i| (i.smooth_scroll_delta().y, i.zoom_delta()));
        let from_middle = at - picture.rect.center();
        let steps = wheel / 40.0 + (pinch.ln() * 5.0).clamp(-5.0, 5.0);
        if steps != 0.0 {
            camera_control::zoom(&mut state.camera, steps, from_middle.x, from_middle.y, height);
        }
    }
}

/// What the keys do, unless a text is being typed.
pub fn keys(state: &mut EditorState, ctx: &egui::Context) {
    file_keys(state, ctx);
    if ctx.egui_wants_keyboard_input() {
        return;
    }
    let pressed = |key| ctx.input(|i| i.key_pressed(key) && !i.modifiers.command);
    let turned = |key| ctx.input(|i| i.key_pressed(key) && i.modifiers.command);
    let views = [
        (Key::Num1, View::Front),
        (Key::Num2, View::Portrait),
        (Key::Num3, View::Side),
        (Key::Num4, View::ThreeQuarter),
        (Key::Num7, View::Top),
    ];
    for (key, view) in views {
        if pressed(key) {
            state.look_from(view);
        } else if turned(key) {
            state.look_from(opposite(view));
        }
    }
    if pressed(Key::F) {
        state.wants_fit = true;
    }
    if pressed(Key::R) || pressed(Key::Home) {
        state.reset_camera();
    }
    if pressed(Key::W) {
        toggle(&mut state.shading, Shading::Wireframe);
    }
    if pressed(Key::G) {
        toggle(&mut state.shading, Shading::Control);
    }
    if pressed(Key::M) {
        state.measures.is_open = !state.measures.is_open;
    }
    if pressed(Key::U) {
        state.toggle_motion();
    }
    if pressed(Key::Space) {
        state.motion.play_or_pause();
    }
    if pressed(Key::T) {
        state.motion.set_course(!state.motion.takes_course());
    }
    if pressed(Key::Comma) {
        state.motion.step(-1);
    }
    if pressed(Key::Period) {
        state.motion.step(1);
    }
    if pressed(Key::Plus) || pressed(Key::Equals) {
        state.set_level(state.level() + 1);
    }
    if pressed(Key::Minus) {
        state.set_level(state.level().saturating_sub(1));
    }
    if pressed(Key::OpenBracket) {
        state.light_turn -= 0.2;
    }
    if pressed(Key::CloseBracket) {
        state.light_turn += 0.2;
    }
    if pressed(Key::Questionmark) || ctx.input(|i| i.key_pressed(Key::Slash) && i.modifiers.shift) {
        state.shows_keys = !state.shows_keys;
    }
    if pressed(Key::Escape) {
        state.shows_keys = false;
    }
}

/// Keys that work while a text is being typed, too.
fn file_keys(state: &mut EditorState, ctx: &egui::Context) {
    let both = Modifiers::COMMAND | Modifiers::SHIFT;
    // The longer chord first, or the shorter one would take it.
    let taken = |modifiers, key| ctx.input_mut(|i| i.consume_shortcut(&KeyboardShortcut::new(modifiers, key)));
    if taken(both, Key::S) {
        state.commands.push_back(Command::SaveAs);
    }
    if taken(Modifiers::COMMAND, Key::S) {
        state.commands.push_back(Command::Save);
    }
    if taken(Modifiers::COMMAND, Key::N) {
        state.commands.push_back(Command::New);
    }
    if taken(Modifiers::COMMAND, Key::O) {
        state.commands.push_back(Command::Open);
    }
    if taken(Modifiers::COMMAND, Key::E) {
        state.commands.push_back(Command::Export);
    }
    if taken(Modifiers::COMMAND, Key::Q) {
        state.request_quit();
    }
    if taken(Modifiers::NONE, Key::F12) {
        state.commands.push_back(Command::Screenshot);
    }
    if ctx.egui_wants_keyboard_input() {
        return;
    }
    if taken(both, Key::Z) || taken(Modifiers::COMMAND, Key::Y) {
        state.redo();
    }
    if taken(Modifiers::COMMAND, Key::Z) {
        state.undo();
    }
}

fn opposite(view: View) -> View {
    let (azimuth, elevation) = view.angles();
    match view {
        View::Top => View::Angles { azimuth, elevation: -elevation },
        _ => View::Angles { azimuth: azimuth + std::f32::consts::PI, elevation },
    }
}

fn toggle(shading: &mut Shading, to: Shading) {
    *shading = if *shading == to { Shading::Shaded } else { to };
}
