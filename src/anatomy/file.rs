//! A breed's file as it is written, version by version.
//!
//! [`BreedFile`] is the newest form. A file of an older version is read in its own form and turned into the newest one by a
//! function of its own; [`read`] is the place where versions part. What could not be read has been reported and is filled
//! with a stand-in, so that the rest is still compared with the table: such a file never becomes a breed.

use super::locate::{Item, Node, Place};
use super::read::{Fields, Problems};
use super::{Hair, ProblemKind, Status, colour, hair};
use glam::Vec3;

/// The newest version that is read, and the one that is written.
pub(super) const NEWEST: u32 = 1;

/// What stands in a file, not yet compared with a table.
pub(super) struct BreedFile {
    pub label: String,
    pub fci_group: Option<u8>,
    /// In the order of the file.
    pub references: Vec<ReferenceFile>,
    /// In the order of the file.
    pub anatomy: Vec<Measure>,
    pub coat: CoatFile,
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

/// `coat: (…)`; colours are linear already.
#[derive(Default)]
pub(super) struct CoatFile {
    pub base: Vec3,
    pub marks: Vec<MarkFile>,
    pub nose: Vec3,
    pub lips: Vec3,
    pub mouth: Vec3,
    pub iris: Vec3,
    pub fur: f32,
    pub hair: Hair,
}

/// One of `marks`.
pub(super) struct MarkFile {
    pub regions: Vec<(String, Place)>,
    pub colour: Vec3,
    pub amount: f32,
}

/// The fields of a file, in the order in which they are written.
const FIELDS: [&str; 6] = ["version", "label", "fci_group", "references", "anatomy", "coat"];

/// Reads a file of any known version. `None` when it is none, which has been reported.
pub(super) fn read(root: &Node, problems: &mut Problems) -> Option<BreedFile> {
    let fields = problems.fields(root, "", "Breed", &FIELDS)?;
    // A second version makes this a `match` whose older arms end in a step to the newer form.
    problems.version(&fields, NEWEST)?;
    Some(read_version_1(&fields, problems))
}

fn read_version_1(fields: &Fields<'_>, problems: &mut Problems) -> BreedFile {
    let label = fields.require("label", problems).and_then(|n| problems.full_text(n, "label"));
    let anatomy = fields.require("anatomy", problems).map(|n| read_measures(n, problems));
    let coat = fields.require("coat", problems).and_then(|n| read_coat(n, problems));
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
        coat: coat.unwrap_or_default(),
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

fn read_coat(node: &Node, problems: &mut Problems) -> Option<CoatFile> {
    let allowed = ["base", "marks", "nose", "lips", "mouth", "iris", "fur", "hair"];
    let fields = problems.fields(node, "coat", "Coat", &allowed)?;
    let mut colour = |key: &str| {
        let node = fields.require(key, problems);
        node.and_then(|n| read_colour(n, &fields.path_of(key), problems)).unwrap_or_default()
    };
    let (base, nose, lips) = (colour("base"), colour("nose"), colour("lips"));
    let (mouth, iris) = (colour("mouth"), colour("iris"));
    let fur = fields.get("fur").map_or(Some(1.0), |n| problems.number_in(n, "coat.fur", 0.0, 1.0));
    let marks = fields.get("marks").map_or(Vec::new(), |node| {
        let nodes = problems.list(node, "coat.marks").iter().enumerate();
        nodes.filter_map(|(i, n)| read_mark(n, &format!("coat.marks[{i}]"), problems)).collect()
    });
    let hair = fields.get("hair").map_or(Some(Hair::default()), |n| read_hair(n, problems)).unwrap_or_default();
    Some(CoatFile { base, marks, nose, lips, mouth, iris, fur: fur.unwrap_or_default() as f32, hair })
}

fn read_hair(node: &Node, problems: &mut Problems) -> Option<Hair> {
    let fields = problems.fields(node, "coat.hair", "Hair", &hair::NAMES)?;
    let given: Vec<Option<f32>> = hair::FIELDS
        .iter()
        .map(|field| {
            let path = fields.path_of(field.name);
            let value = problems.number_in(fields.get(field.name)?, &path, 0.0, field.max())?;
            Some((value * field.unit()) as f32)
        })
        .collect();
    Some(Hair::from_given(|i| given[i]))
}

fn read_mark(node: &Node, path: &str, problems: &mut Problems) -> Option<MarkFile> {
    let fields = problems.fields(node, path, "Mark", &["regions", "colour", "amount"])?;
    let regions = fields.require("regions", problems).map(|n| {
        let path = fields.path_of("regions");
        let names = problems.list(n, &path).iter();
        names.filter_map(|name| Some((problems.text(name, &path)?, name.place))).collect()
    });
    let colour = fields.require("colour", problems).and_then(|n| read_colour(n, &fields.path_of("colour"), problems));
    let amount = fields.require("amount", problems);
    let amount = amount.and_then(|n| problems.number_in(n, &fields.path_of("amount"), 0.0, 1.0));
    Some(MarkFile {
        regions: regions.unwrap_or_default(),
        colour: colour.unwrap_or_default(),
        amount: amount.unwrap_or_default() as f32,
    })
}

/// `"#rrggbb"` in sRGB, or `(red, green, blue)` in linear light, as a blend of two coats needs.
fn read_colour(node: &Node, field: &str, problems: &mut Problems) -> Option<Vec3> {
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
