//! A breed's file as it is written, version by version.
//!
//! [`BreedFile`] is the newest form. A file of an older version is read in its own form and turned into the newest one by a
//! function of its own; [`read`] is the place where versions part. What could not be read has been reported and is filled
//! with a stand-in, so that the rest is still compared with the table: such a file never becomes a breed.

use super::locate::{Item, Node, Place};
use super::read::{Fields, Problems};
use super::{Look, ProblemKind, Status, Variety, coat_file as coat, colour};
use glam::Vec3;

/// The newest version that is read, and the one that is written.
pub(super) const NEWEST: u32 = 2;

/// What stands in a file, not yet compared with a table.
pub(super) struct BreedFile {
    pub label: String,
    pub fci_group: Option<u8>,
    /// In the order of the file.
    pub references: Vec<ReferenceFile>,
    /// In the order of the file.
    pub anatomy: Vec<Measure>,
    pub look: Look,
    pub varieties: Vec<Variety>,
}

/// One of `references`.
pub(super) struct ReferenceFile {
    pub measure: String,
    pub measure_at: Place,
    /// NaN if it has been reported.
    pub value: f64,
    pub value_at: Place,
    pub status: Status,
    pub source: String,
}

/// `"id": value`.
pub(super) struct Measure {
    pub id: String,
    pub id_at: Place,
    /// In the unit that the id tells; NaN if it has been reported.
    pub value: f64,
    pub value_at: Place,
}

/// The fields of a file, in the order in which they are written.
const FIELDS: [&str; 8] = ["version", "label", "fci_group", "references", "anatomy", "coat", "coats", "wears"];
/// Those of version 1, in which a breed had one coat, painted by region.
const FIELDS_1: [&str; 6] = ["version", "label", "fci_group", "references", "anatomy", "coat"];

/// Reads a file of any known version. `None` when it is none, which has been reported.
pub(super) fn read(root: &Node, problems: &mut Problems) -> Option<BreedFile> {
    let is_old = matches!(&root.item, Item::Record(_, entries) if entries.iter().any(|e| {
        e.key.item == Item::Text("version".into()) && e.value.item == Item::Number(1.0)
    }));
    let fields = problems.fields(root, "", "Breed", if is_old { &FIELDS_1 } else { &FIELDS })?;
    let version = problems.version(&fields, NEWEST)?;
    Some(read_breed(&fields, version, problems))
}

fn read_breed(fields: &Fields<'_>, version: u32, problems: &mut Problems) -> BreedFile {
    let label = fields.require("label", problems).and_then(|n| problems.full_text(n, "label"));
    let anatomy = fields.require("anatomy", problems).map(|n| read_measures(n, problems));
    let (look, varieties) = coat::read(fields, version, problems);
    let fci_group = fields.get("fci_group").and_then(|n| problems.whole_number_in(n, "fci_group", 1, 10));
    let references = fields.get("references").map_or(Vec::new(), |node| {
        let nodes = problems.list(node, "references").iter().enumerate();
        nodes.filter_map(|(i, n)| read_reference(n, &format!("references[{i}]"), problems)).collect()
    });
    BreedFile {
        label: label.unwrap_or_default(),
        fci_group,
        references,
        anatomy: anatomy.unwrap_or_default(),
        look,
        varieties,
    }
}

/// `None` when something is missing or of the wrong type, which has been reported.
fn read_reference(node: &Node, path: &str, problems: &mut Problems) -> Option<ReferenceFile> {
    let fields = problems.fields(node, path, "Reference", &["measure", "value", "status", "source"])?;
    let measure_node = fields.require("measure", problems);
    let measure = measure_node.and_then(|n| problems.text(n, &fields.path_of("measure")));
    let value_node = fields.require("value", problems);
    let value = value_node.and_then(|n| problems.number(n, &fields.path_of("value")));
    let status = fields.require("status", problems).and_then(|n| read_status(n, &fields.path_of("status"), problems));
    let source = fields.require("source", problems).and_then(|n| problems.full_text(n, &fields.path_of("source")));
    Some(ReferenceFile {
        measure: measure?,
        measure_at: measure_node?.place,
        value: value.unwrap_or(f64::NAN),
        value_at: value_node?.place,
        status: status?,
        source: source?,
    })
}

/// A bare word, as RON writes variants.
fn read_status(node: &Node, field: &str, problems: &mut Problems) -> Option<Status> {
    let status = match &node.item {
        Item::Word(word) => Status::from_name(word),
        _ => None,
    };
    if status.is_none() {
        let found = match &node.item {
            Item::Word(word) => word.clone(),
            other => other.form().to_owned(),
        };
        problems.push(node.place, ProblemKind::UnknownStatus { field: field.to_owned(), found });
    }
    status
}

fn read_measures(node: &Node, problems: &mut Problems) -> Vec<Measure> {
    let mut measures = Vec::new();
    for (id, id_at, value) in problems.map(node, "anatomy") {
        let number = problems.number(value, id).unwrap_or(f64::NAN);
        measures.push(Measure { id: id.to_owned(), id_at, value: number, value_at: value.place });
    }
    measures
}

/// `"#rrggbb"` in sRGB, or `(red, green, blue)` in linear light, as a blend of two coats needs.
pub(super) fn read_colour(node: &Node, field: &str, problems: &mut Problems) -> Option<Vec3> {
    let field = field.to_owned();
    match &node.item {
        Item::Text(text) => {
            let found = colour::from_hex(text);
            if found.is_none() {
                problems.push(node.place, ProblemKind::BadColour { field, found: format!("{text:?}") });
            }
            found
        }
        Item::Tuple(None, channels) if channels.len() == 3 => {
            let mut channel = |i: usize| problems.number_in(&channels[i], &field, 0.0, 1.0);
            let (r, g, b) = (channel(0), channel(1), channel(2));
            Some(Vec3::new(r? as f32, g? as f32, b? as f32))
        }
        other => {
            problems.push(node.place, ProblemKind::BadColour { field, found: other.form().to_owned() });
            None
        }
    }
}
