//! What is edited and how it is shown; without a window, so that a test can drive it.

use super::chance::Chance;
use super::history::History;
use super::measures::Measures;
use super::motion::{Asked, Motion};
use super::thumbnails::Pictures;
use crate::anatomy::{Breed, ParamTable};
use crate::coat::Condition;
use crate::frame::Layers;
use crate::motion::Pose;
use crate::render::{Background, Camera, Lens, Preset, Shading, View};
use glam::Vec3;
use std::collections::{BTreeMap, VecDeque};
use std::path::PathBuf;
use std::sync::Arc;

/// The finest level that the window offers.
pub const MOST_LEVEL: u32 = 5;

/// Another breed mixed in.
#[derive(Clone, Debug, PartialEq)]
pub struct Blend {
    /// Whom.
    pub partner: Breed,
    /// How much of it, 0 to 1.
    pub weight: f32,
}

/// What a person has done to one measure.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Override {
    /// Set it, SI.
    Value(f32),
    /// Let it follow, though the breed sets it.
    Follow,
}

/// What is edited: a breed, another mixed in, and changed measures on top. The head is a function of it.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// As it stands in the list or a file.
    pub base: Breed,
    /// Where it was opened from or saved to.
    pub path: Option<PathBuf>,
    /// The breed mixed in.
    pub blend: Option<Blend>,
    /// Which of the base's coats it wears, where it is another than the base does.
    pub coat: Option<String>,
    /// By row of the table.
    pub overrides: BTreeMap<usize, Override>,
    /// The name it is saved under, where it is another than the base's.
    pub label: Option<String>,
}

impl Document {
    /// A breed as it is.
    pub fn of(base: Breed, path: Option<PathBuf>) -> Self {
        Self { base, path, blend: None, coat: None, overrides: BTreeMap::new(), label: None }
    }

    /// The breed before measures were changed by hand.
    pub fn blended(&self, table: &ParamTable) -> Breed {
        let mut base = self.base.clone();
        if let Some(coat) = &self.coat {
            // A reloaded file may not have it any more: then the dog wears the first again.
            let _ = base.wear(coat);
        }
        match &self.blend {
            Some(Blend { partner, weight }) => Breed::blend(table, &[(&base, 1.0 - weight), (partner, *weight)]),
            None => base,
        }
    }

    /// The breed that is shown and saved.
    pub fn breed(&self, table: &ParamTable) -> Breed {
        let mut breed = self.blended(table);
        for (&index, change) in &self.overrides {
            match *change {
                Override::Value(si) => breed.set_value(table, index, si),
                Override::Follow => breed.unset(table, index),
            }
        }
        if let Some(label) = &self.label {
            breed.label.clone_from(label);
        }
        breed
    }

    /// Whether it differs from what the list or the file has.
    pub fn is_changed(&self) -> bool {
        !self.overrides.is_empty()
            || self.label.is_some()
            || self.coat.is_some()
            || self.blend.as_ref().is_some_and(|b| b.weight > 0.0)
    }
}

/// What undo goes back by: the dog and what it was asked to do.
#[derive(Clone, Debug, PartialEq)]
struct Step {
    document: Document,
    asked: Asked,
}

/// What the state cannot do by itself: it needs files, a device, or a dialog.
#[derive(Clone, Debug, PartialEq)]
pub enum Command {
    /// Begin a head of which nothing is set.
    New,
    /// Ask for a file and open it.
    Open,
    /// Open this file.
    OpenPath(PathBuf),
    /// Save under the known path, or ask for one.
    Save,
    /// Ask for a path and save.
    SaveAs,
    /// Save under this path.
    SavePath(PathBuf),
    /// Write a glTF file; ask for a path.
    Export,
    /// Write a glTF file there.
    ExportPath(PathBuf),
    /// Write the picture beside the breed or in the working folder.
    Screenshot,
    /// Save, and close the window if that went well.
    SaveAndQuit,
    /// Close the window; unsaved changes were given up.
    Quit,
}

/// Times of the last picture, milliseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Timing {
    /// The head: from values to vertices.
    pub head_ms: f32,
    /// The program's own work, the head included.
    pub cpu_ms: f32,
    /// From the start of the work to the picture's hand-over, the driver included.
    pub total_ms: f32,
}

/// One line for the person.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Message {
    /// What happened.
    pub text: String,
    /// Whether it went wrong.
    pub is_error: bool,
}

/// Everything the window shows.
pub struct EditorState {
    /// The one table of measures.
    pub table: Arc<ParamTable>,
    /// The list.
    pub breeds: Vec<Breed>,
    present: Step,
    history: History<Step>,
    shown: Breed,
    unchanged: Breed,
    level: u32,
    /// Surfaces, lines, or the control mesh.
    pub shading: Shading,
    /// Which layers are shown, and how much of the skin.
    pub layers: Layers,
    /// Strands of hair on the head.
    pub n_strands: u32,
    /// What the coat is like today.
    pub condition: Condition,
    /// From where.
    pub camera: Camera,
    /// The camera is to be fitted to the head before the next picture.
    pub wants_fit: bool,
    /// Of the lights around the vertical, radians.
    pub light_turn: f32,
    /// Whether the graphics card evaluates the skin that is drawn. The processor does in any case: it is what is exported.
    pub on_card: bool,
    /// In which light, and as what.
    preset: Preset,
    /// Behind the head.
    pub background: Background,
    /// What the next random dog depends on.
    pub chance: Chance,
    /// What a vet would measure on the head that is shown.
    pub measures: Measures,
    /// What the head does.
    pub motion: Motion,
    /// This dog's expressions, once there are pictures of them.
    pub pictures: Option<Pictures>,
    /// What is looked for among the measures.
    pub search: String,
    /// Show only measures that were changed.
    pub only_changed: bool,
    /// The list of keys is shown.
    pub shows_keys: bool,
    /// The question whether to give up changes is shown.
    pub asks_to_quit: bool,
    /// The path typed into the panel.
    pub typed_path: String,
    /// The last thing that happened.
    pub message: Option<Message>,
    /// Files that are broken on disk, by name, with what is wrong; they go when the file is right again.
    pub problems: BTreeMap<String, String>,
    /// To be done by the window, in order.
    pub commands: VecDeque<Command>,
    /// Of the last picture.
    pub timing: Timing,
    /// Of the last picture.
    pub n_triangles: usize,
}

impl EditorState {
    /// Starts with the document. `breeds`: the list, in the order shown.
    pub fn new(table: Arc<ParamTable>, breeds: Vec<Breed>, document: Document) -> Self {
        let (shown, unchanged) = (document.breed(&table), document.blended(&table));
        let typed_path = typed(&document);
        let motion = Motion::new().expect("the program's own tables, which a test reads");
        Self {
            table,
            breeds,
            present: Step { document, asked: motion.asked() },
            history: History::default(),
            shown,
            unchanged,
            level: 4,
            shading: Shading::Shaded,
            layers: Layers::default(),
            n_strands: 0,
            condition: Condition::default(),
            camera: Camera::at(View::Portrait, None, Lens::default()),
            wants_fit: true,
            light_turn: 0.0,
            on_card: false,
            preset: Preset::default(),
            background: Preset::default().background(),
            chance: Chance::default(),
            measures: Measures::default(),
            motion,
            pictures: None,
            search: String::new(),
            only_changed: false,
            shows_keys: false,
            asks_to_quit: false,
            typed_path,
            message: None,
            problems: BTreeMap::new(),
            commands: VecDeque::new(),
            timing: Timing::default(),
            n_triangles: 0,
        }
    }

    /// What is edited.
    pub fn document(&self) -> &Document {
        &self.present.document
    }

    /// The breed that is shown.
    pub fn breed(&self) -> &Breed {
        &self.shown
    }

    /// The breed without the measures changed by hand: what a reset goes back to.
    pub fn unchanged(&self) -> &Breed {
        &self.unchanged
    }

    /// Refinement.
    pub fn level(&self) -> u32 {
        self.level
    }

    /// Takes a level; one beyond the ends becomes the end.
    pub fn set_level(&mut self, level: u32) {
        self.level = level.min(MOST_LEVEL);
    }

    /// The window's title, with a mark for unsaved changes.
    pub fn title(&self) -> String {
        let mark = if self.present.document.is_changed() { "• " } else { "" };
        format!("{mark}{} — Londra", self.shown.label)
    }

    // ---- changes, each one step to undo ----

    fn change(&mut self, change: impl FnOnce(&mut Document)) {
        let mut next = self.present.document.clone();
        change(&mut next);
        if next != self.present.document {
            self.history.before_change(&self.present);
            self.present.document = next;
            self.resolve();
        }
    }

    fn resolve(&mut self) {
        self.unchanged = self.present.document.blended(&self.table);
        self.shown = self.present.document.breed(&self.table);
    }

    /// Sets a measure (row, SI).
    pub fn set_value(&mut self, index: usize, si: f32) {
        self.change(|d| {
            d.overrides.insert(index, Override::Value(si));
        });
    }

    /// Lets a measure follow others, or go back to its default.
    pub fn let_follow(&mut self, index: usize) {
        let follows_anyway = !self.unchanged.set[index];
        self.change(|d| {
            if follows_anyway {
                d.overrides.remove(&index);
            } else {
                d.overrides.insert(index, Override::Follow);
            }
        });
    }

    /// Sets a measure that follows another one to the value that it has: from now on it stays.
    pub fn unlink(&mut self, index: usize) {
        if let Some(&si) = self.shown.values.get(index) {
            self.set_value(index, si);
        }
    }

    /// Takes back what was done to a measure.
    pub fn reset(&mut self, index: usize) {
        self.change(|d| {
            d.overrides.remove(&index);
        });
    }

    /// Takes back what was done to all measures.
    pub fn reset_all(&mut self) {
        self.change(|d| d.overrides.clear());
    }

    /// Whether a measure was changed by hand.
    pub fn is_overridden(&self, index: usize) -> bool {
        self.present.document.overrides.contains_key(&index)
    }

    /// Shows a breed of the list, as it is.
    pub fn choose(&mut self, index: usize) {
        let Some(breed) = self.breeds.get(index).cloned() else { return };
        self.open(Document::of(breed, None));
    }

    /// Begins a head of which nothing is set.
    pub fn begin_new(&mut self) {
        self.open(Document::of(Breed::defaults(&self.table), None));
    }

    /// Takes another document; the old one can be had back by undo, which is said when it has unsaved changes.
    pub fn open(&mut self, document: Document) {
        if let Some(way_back) = self.way_back() {
            self.say(format!("{}: {way_back}", document.base.label));
        }
        self.take(document);
    }

    /// Takes what was read from a file, and says so.
    pub fn was_read(&mut self, breed: Breed, path: PathBuf) {
        let way_back = self.way_back().map(|way| format!("; {way}")).unwrap_or_default();
        self.say(format!("Opened {}{way_back}", path.display()));
        self.take(Document::of(breed, Some(path)));
    }

    /// Where unsaved changes will be when another document takes the place of this one.
    fn way_back(&self) -> Option<String> {
        let is_changed = self.present.document.is_changed();
        is_changed.then(|| format!("undo (Ctrl+Z) brings back {} with its unsaved changes", self.shown.label))
    }

    fn take(&mut self, document: Document) {
        self.typed_path = typed(&document);
        self.change(|d| *d = document);
    }

    /// Mixes in a breed of the list, at the present weight; `None` takes it out.
    pub fn set_partner(&mut self, index: Option<usize>) {
        let partner = index.and_then(|i| self.breeds.get(i)).cloned();
        self.change(|d| {
            let weight = d.blend.as_ref().map_or(0.5, |b| b.weight);
            d.blend = partner.map(|partner| Blend { partner, weight });
        });
    }

    /// Sets how much is mixed in, 0 to 1.
    pub fn set_weight(&mut self, weight: f32) {
        self.change(|d| {
            if let Some(blend) = &mut d.blend {
                blend.weight = weight.clamp(0.0, 1.0);
            }
        });
    }

    /// Puts on one of the breed's coats.
    pub fn set_coat(&mut self, coat: &str) {
        self.change(|d| d.coat = (d.base.worn() != Some(coat)).then(|| coat.to_owned()));
    }

    /// Gives it another name.
    pub fn set_label(&mut self, label: &str) {
        self.change(|d| d.label = (label != d.base.label).then(|| label.to_owned()));
    }

    /// What follows is one step, until [`EditorState::end_gesture`].
    pub fn begin_gesture(&mut self) {
        self.history.begin_gesture(&self.present);
    }

    /// Ends what [`EditorState::begin_gesture`] began, if anything.
    pub fn end_gesture(&mut self) {
        self.history.end_gesture(&self.present);
    }

    /// Goes one step back.
    pub fn undo(&mut self) {
        if self.history.undo(&mut self.present) {
            self.went_through_history();
        }
    }

    /// Goes one step forward again.
    pub fn redo(&mut self) {
        if self.history.redo(&mut self.present) {
            self.went_through_history();
        }
    }

    fn went_through_history(&mut self) {
        self.typed_path = typed(&self.present.document);
        self.resolve();
        self.motion.restore(&self.present.asked);
    }

    /// Makes a step of what was asked of the motion since the last time; `is_held`: while a hand is still at it, all is one.
    pub fn note_motion(&mut self, is_held: bool) {
        let now = self.motion.asked();
        if now != self.present.asked {
            if is_held {
                self.history.begin_gesture(&self.present);
            }
            self.history.before_change(&self.present);
            self.present.asked = now;
        }
    }

    /// Time passes, which nobody has asked for and no step brings back; seconds.
    pub fn pass(&mut self, seconds: f64) {
        self.motion.pass(seconds);
        self.present.asked.time = self.motion.asked().time;
    }

    /// Whether there is a step back.
    pub fn can_undo(&self) -> bool {
        self.history.can_undo()
    }

    /// Whether there is a step forward.
    pub fn can_redo(&self) -> bool {
        self.history.can_redo()
    }

    // ---- news from outside ----

    /// What is shown has been written to a file: from now on that is the base.
    pub fn was_saved(&mut self, path: PathBuf) {
        let mut saved = self.shown.clone();
        if let Some(stem) = path.file_stem() {
            saved.id = stem.to_string_lossy().into_owned();
        }
        self.take(Document::of(saved, Some(path)));
    }

    /// A breed has changed on disk: it takes the place of the one with its id, in the list and, as the base, in what
    /// is edited. Measures changed by hand stay on top. Returns whether anything is different now.
    pub fn breed_reloaded(&mut self, breed: Breed, path: &std::path::Path) -> bool {
        let before = (self.breeds.clone(), self.present.document.clone());
        if let Some(known) = self.breeds.iter_mut().find(|b| b.id == breed.id) {
            *known = breed.clone();
            self.measures.forget_breeds();
        }
        let is_open = match &self.present.document.path {
            Some(open) => open == path,
            None => self.present.document.base.id == breed.id,
        };
        if let Some(blend) = self.present.document.blend.as_mut().filter(|b| b.partner.id == breed.id) {
            blend.partner = breed.clone();
        }
        if is_open {
            self.present.document.base = breed;
        }
        self.resolve();
        before != (self.breeds.clone(), self.present.document.clone())
    }

    /// The table has changed on disk: breeds loaded with it take the place of the old ones.
    pub fn table_reloaded(&mut self, table: Arc<ParamTable>, breeds: Vec<Breed>, document: Document) {
        self.table = table;
        self.breeds = breeds;
        self.chance.forget_table();
        self.measures.forget_table();
        // Steps of the old table count other rows.
        self.history = History::default();
        self.present.document = document;
        self.resolve();
    }

    /// Tells the person.
    pub fn say(&mut self, text: impl Into<String>) {
        self.message = Some(Message { text: text.into(), is_error: false });
    }

    /// Tells the person that something went wrong.
    pub fn complain(&mut self, text: impl Into<String>) {
        self.message = Some(Message { text: text.into(), is_error: true });
    }

    /// Leaves, or asks first when there are unsaved changes.
    pub fn request_quit(&mut self) {
        if self.present.document.is_changed() {
            self.asks_to_quit = true;
        } else {
            self.commands.push_back(Command::Quit);
        }
    }

    // ---- what is seen ----

    /// Rows of the table that the search field and the filter let through.
    pub fn found(&self) -> Vec<usize> {
        let words: Vec<String> = self.search.split_whitespace().map(str::to_lowercase).collect();
        let is_found = |index: &usize| {
            let spec = &self.table.specs[*index];
            let mut names = vec![&spec.id, &spec.label, &spec.group];
            names.extend(&spec.synonyms);
            let names: Vec<String> = names.into_iter().map(|n| n.to_lowercase()).collect();
            words.iter().all(|w| names.iter().any(|n| n.contains(w)))
        };
        let is_shown = |index: &usize| !self.only_changed || self.is_overridden(*index);
        (0..self.table.specs.len()).filter(is_shown).filter(is_found).collect()
    }

    /// Looks from a named view, the head carried as it is there, and fits.
    pub fn look_from(&mut self, view: View) {
        self.camera = Camera { target: self.camera.target, ..Camera::at(view, None, self.camera.lens) };
        self.wants_fit = true;
    }

    /// In which light the head is shown, and as what.
    pub fn preset(&self) -> Preset {
        self.preset
    }

    /// Takes a preset with its ground, and its layers where they differ from those of the one before.
    pub fn set_preset(&mut self, preset: Preset) {
        if preset.layers() != self.preset.layers() {
            self.layers = preset.layers();
        }
        self.preset = preset;
        self.background = preset.background();
    }

    /// Shows or hides what the head does; a mouth that may open has something in it.
    pub fn toggle_motion(&mut self) {
        self.motion.is_open = !self.motion.is_open;
        self.layers = self.layers.with_open_mouth();
        // The panel takes a part of the picture: all of the head is to be seen in the rest.
        self.wants_fit = true;
    }

    /// What the head does at this moment.
    pub fn pose(&mut self) -> Pose {
        self.motion.pose(&self.table, &self.shown)
    }

    /// Puts the camera where it was at the start.
    pub fn reset_camera(&mut self) {
        self.camera = Camera::at(View::Portrait, None, Lens::default());
        self.light_turn = 0.0;
        self.wants_fit = true;
    }

    /// Fits the camera to a head if that was asked for. `aspect`: width over height of the picture.
    pub fn fit_camera<'a>(&mut self, points: impl Iterator<Item = &'a Vec3> + Clone, aspect: f32) {
        if std::mem::take(&mut self.wants_fit) {
            self.camera.fit(points, aspect, 0.1);
        }
    }
}

fn typed(document: &Document) -> String {
    document.path.as_ref().map(|p| p.display().to_string()).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::anatomy::library;

    fn state() -> EditorState {
        let table = Arc::new(ParamTable::embedded().unwrap());
        let breeds: Vec<Breed> = library::ids().map(|id| library::breed(&table, id).unwrap()).collect();
        let first = Document::of(breeds[0].clone(), None);
        EditorState::new(table, breeds, first)
    }

    #[test]
    fn a_slider_changes_the_breed_and_undo_brings_it_back_in_bits() {
        let mut state = state();
        let before = state.breed().clone();
        let spec = &state.table.specs[0];
        let (min, max) = (spec.min_si(), spec.max_si());
        state.begin_gesture();
        for step in 0..10 {
            state.set_value(0, min + (max - min) * step as f32 / 10.0);
        }
        state.end_gesture();
        assert_ne!(state.breed().values[0], before.values[0]);
        assert!(state.document().is_changed());
        assert!(state.title().starts_with('•'));
        state.undo();
        assert_eq!(*state.breed(), before);
        assert!(!state.can_undo());
        state.redo();
        assert!(state.is_overridden(0));
        state.reset(0);
        assert_eq!(*state.breed(), before);
    }

    #[test]
    fn changed_measures_stay_while_the_blend_goes_on() {
        let mut state = state();
        state.set_partner(Some(1));
        let value = state.table.specs[2].min_si();
        state.set_value(2, value);
        for weight in [0.0, 0.3, 1.0] {
            state.set_weight(weight);
            assert_eq!(state.breed().values[2], value);
        }
        state.reset_all();
        let partner = &state.document().blend.as_ref().unwrap().partner;
        assert_eq!(state.breed().values, partner.values, "at weight 1 the head is the partner");
    }

    #[test]
    fn search_finds_labels_ids_and_synonyms() {
        let mut state = state();
        let n_all = state.found().len();
        assert_eq!(n_all, state.table.specs.len());
        let spec = state.table.specs.iter().position(|s| !s.synonyms.is_empty()).unwrap();
        state.search = state.table.specs[spec].synonyms[0].to_uppercase();
        assert!(state.found().contains(&spec));
        assert!(state.found().len() < n_all);
        state.search = "no such measure".into();
        assert!(state.found().is_empty());
        state.search.clear();
        state.only_changed = true;
        assert!(state.found().is_empty());
        state.set_value(3, state.table.specs[3].min_si());
        assert_eq!(state.found(), [3]);
    }

    #[test]
    fn quitting_asks_only_when_something_would_be_lost() {
        let mut state = state();
        state.request_quit();
        assert_eq!(state.commands.pop_front(), Some(Command::Quit));
        state.set_value(0, state.table.specs[0].max_si());
        state.request_quit();
        assert!(state.asks_to_quit && state.commands.is_empty());
    }

    #[test]
    fn unsaved_changes_give_way_to_another_head_only_with_a_word_of_how_to_get_them_back() {
        let mut state = state();
        let (one, other) = (state.breeds[1].clone(), PathBuf::from("other.ron"));
        state.was_read(one.clone(), other.clone());
        assert_eq!(state.message.as_ref().unwrap().text, "Opened other.ron");

        state.set_value(0, state.table.specs[0].max_si());
        let changed = state.breed().clone();
        state.was_read(one, other);
        assert!(state.message.as_ref().unwrap().text.contains(&format!("Ctrl+Z) brings back {}", changed.label)));
        state.undo();
        assert_eq!(*state.breed(), changed);

        state.message = None;
        state.choose(2);
        assert!(state.message.as_ref().unwrap().text.contains("Ctrl+Z"));
        state.message = None;
        state.choose(3);
        assert_eq!(state.message, None, "nothing is lost");
    }

    #[test]
    fn saving_makes_the_shown_breed_the_base() {
        let mut state = state();
        state.set_value(0, state.table.specs[0].max_si());
        let shown = state.breed().clone();
        state.was_saved(PathBuf::from("my dog.ron"));
        assert!(!state.document().is_changed());
        assert_eq!(state.breed().values, shown.values);
        assert_eq!(state.breed().id, "my dog");
    }
}
