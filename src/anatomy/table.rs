//! The table of measures: reading, checking, looking up, following.

use super::locate::{self, Node, Place};
use super::read::Problems;
use super::{Follow, LoadErrors, ParamSpec, ProblemKind, Unit, nearest};
use crate::math::ops;

/// Every measure of the head, in the order in which they are shown. Immutable once loaded; share it by `Arc`.
#[derive(Clone, Debug, PartialEq)]
pub struct ParamTable {
    /// One row each; a breed's values stand in the same order. Checked when loaded: do not edit afterwards.
    pub specs: Vec<ParamSpec>,
    /// Rows so ordered that each comes after the one it follows, with that one's row.
    order: Vec<(usize, Option<usize>)>,
}

/// The newest version of `rigs/anatomy.ron` that is understood.
const NEWEST: u32 = 1;

impl ParamTable {
    /// The table that is part of the program.
    ///
    /// # Errors
    /// When the embedded text is wrong, which a test excludes.
    pub fn embedded() -> Result<Self, LoadErrors> {
        Self::parse("rigs/anatomy.ron", super::library::ANATOMY)
    }

    /// Reads a table; `name` is for messages only.
    ///
    /// # Errors
    /// The first syntax error, or every mistake of meaning with its place.
    pub fn parse(name: &str, text: &str) -> Result<Self, LoadErrors> {
        let root = locate::parse(name, text)?;
        let mut problems = Problems::default();
        let rows = read_rows(&root, &mut problems);
        let table = if problems.any() { None } else { check(rows, &mut problems) };
        problems.finish(name, table)
    }

    /// The row of an id.
    pub fn index_of(&self, id: &str) -> Option<usize> {
        self.specs.iter().position(|s| s.id == id)
    }

    /// The spec of an id.
    pub fn get(&self, id: &str) -> Option<&ParamSpec> {
        self.specs.iter().find(|s| s.id == id)
    }

    /// Up to three ids that somebody may have meant, judged by ids, labels and synonyms.
    pub fn nearest(&self, query: &str) -> Vec<&str> {
        let spellings = self.specs.iter().flat_map(|s| {
            let bare = s.id.trim_end_matches("_mm").trim_end_matches("_deg");
            let own = [s.id.as_str(), bare, s.label.as_str()].into_iter();
            own.chain(s.synonyms.iter().map(String::as_str)).map(|spelling| (s.id.as_str(), spelling))
        });
        nearest(query, spellings)
    }

    /// Gives every value that is not set the value it follows to. Both slices have one element per row; values are SI.
    pub(super) fn resolve(&self, values: &mut [f32], set: &[bool]) {
        for &(index, _) in &self.order {
            if !set[index] {
                values[index] = self.followed(index, values);
            }
        }
    }

    /// The value, SI, that row `index` has by following, given the values of the rows before it in the order.
    pub(super) fn followed(&self, index: usize, values: &[f32]) -> f32 {
        let spec = &self.specs[index];
        let target = self.order.iter().find(|(i, _)| *i == index).and_then(|(_, target)| *target);
        let (Some(target), Some(follow)) = (target, &spec.follows) else { return spec.default_si() };
        let ratio = f64::from(values[target]) / f64::from(self.specs[target].default_si());
        let value = f64::from(spec.default_si()) * ops::powf(ratio, follow.exponent);
        (value as f32).clamp(spec.min_si(), spec.max_si())
    }

    /// Rows in following order, each after the one it follows.
    pub(super) fn order(&self) -> impl Iterator<Item = usize> {
        self.order.iter().map(|(index, _)| *index)
    }
}

/// A row and the places that later checks point at.
struct Row {
    spec: ParamSpec,
    id_at: Place,
    follows_at: Place,
}

fn read_rows(root: &Node, problems: &mut Problems) -> Vec<Row> {
    let Some(fields) = problems.fields(root, "", "Anatomy", &["version", "parameters"]) else { return Vec::new() };
    if problems.version(&fields, NEWEST).is_none() {
        return Vec::new();
    }
    let Some(list) = fields.require("parameters", problems) else { return Vec::new() };
    let nodes = problems.list(list, "parameters");
    if nodes.is_empty() && !problems.any() {
        problems.push(list.place, ProblemKind::Empty { field: "parameters".into() });
    }
    let rows = nodes.iter().enumerate().map(|(i, node)| read_row(node, &format!("parameters[{i}]"), problems));
    rows.collect::<Vec<_>>().into_iter().flatten().collect()
}

fn read_row(node: &Node, path: &str, problems: &mut Problems) -> Option<Row> {
    let allowed =
        ["id", "label", "group", "unit", "range", "default", "moves", "help", "source", "synonyms", "follows"];
    let fields = problems.fields(node, path, "Parameter", &allowed)?;
    let text = |key: &str, problems: &mut Problems| {
        let node = fields.require(key, problems)?;
        problems.full_text(node, &fields.path_of(key))
    };
    let id = text("id", problems);
    let label = text("label", problems);
    let group = text("group", problems);
    let moves = text("moves", problems);
    let help = text("help", problems);
    let source = text("source", problems);
    let id_at = fields.get("id").map_or(node.place, |n| n.place);
    let unit = fields.require("unit", problems).and_then(|n| read_unit(n, &fields.path_of("unit"), problems));
    let range = fields.require("range", problems).and_then(|n| read_range(n, id.as_deref().unwrap_or(path), problems));
    let default = fields.require("default", problems);
    let default = default.and_then(|n| {
        let (min, max) = range.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
        problems.number_in(n, &fields.path_of("default"), min, max)
    });
    let synonyms = fields.get("synonyms").map_or(Vec::new(), |n| {
        let path = fields.path_of("synonyms");
        problems.list(n, &path).iter().filter_map(|word| problems.full_text(word, &path)).collect()
    });
    let follows_at = fields.get("follows").map_or(node.place, |n| n.place);
    let follows = fields.get("follows").map(|n| read_follow(n, &fields.path_of("follows"), problems));
    if let (Some(id), Some(unit)) = (&id, unit) {
        check_id(id, unit, id_at, problems);
    }
    let (min, max) = range?;
    let spec = ParamSpec {
        id: id?,
        label: label?,
        group: group?,
        unit: unit?,
        min,
        max,
        default: default?,
        moves: moves?,
        help: help?,
        source: source?,
        synonyms,
        follows: match follows {
            Some(follow) => Some(follow?),
            None => None,
        },
    };
    Some(Row { spec, id_at, follows_at })
}

fn read_unit(node: &Node, field: &str, problems: &mut Problems) -> Option<Unit> {
    let name = problems.text(node, field)?;
    let unit = Unit::ALL.into_iter().find(|u| u.name() == name);
    if unit.is_none() {
        problems.wrong_type(node, field, "\"mm\", \"deg\", \"weeks\", \"kg\" or \"ratio\"");
    }
    unit
}

fn read_range(node: &Node, id: &str, problems: &mut Problems) -> Option<(f64, f64)> {
    let locate::Item::Tuple(None, ends) = &node.item else {
        problems.wrong_type(node, &format!("the range of {id}"), "a tuple (lowest, highest)");
        return None;
    };
    let [min, max] = &ends[..] else {
        problems.wrong_type(node, &format!("the range of {id}"), "a tuple of two numbers");
        return None;
    };
    let (min, max) = (problems.number(min, "range")?, problems.number(max, "range")?);
    if min >= max {
        problems.push(node.place, ProblemKind::BadRange { id: id.to_owned(), min, max });
        return None;
    }
    Some((min, max))
}

fn read_follow(node: &Node, path: &str, problems: &mut Problems) -> Option<Follow> {
    let fields = problems.fields(node, path, "Follow", &["id", "exponent"])?;
    let id = fields.require("id", problems).and_then(|n| problems.full_text(n, &fields.path_of("id")));
    // Beyond these a follower would run from one end of its range to the other within a few percent.
    let exponent = fields.require("exponent", problems);
    let exponent = exponent.and_then(|n| problems.number_in(n, &fields.path_of("exponent"), -10.0, 10.0));
    Some(Follow { id: id?, exponent: exponent? })
}

fn check_id(id: &str, unit: Unit, place: Place, problems: &mut Problems) {
    let plain = id.starts_with(|c: char| c.is_ascii_lowercase())
        && id.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    if !plain || Unit::of_id(id) != unit {
        let suffix = match unit {
            Unit::Millimetre => "_mm",
            Unit::Degree => "_deg",
            Unit::Week => "_weeks",
            Unit::Kilogram => "_kg",
            Unit::Ratio => "none of _mm, _deg, _weeks and _kg",
        };
        problems.push(place, ProblemKind::BadId { id: id.to_owned(), suffix, unit: unit.name() });
    }
}

/// What only the whole table shows: unique ids, targets that exist, no circles.
fn check(rows: Vec<Row>, problems: &mut Problems) -> Option<ParamTable> {
    let mut targets = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        if let Some(first) = rows[..i].iter().find(|r| r.spec.id == row.spec.id) {
            let kind = ProblemKind::Duplicate { field: row.spec.id.clone(), first_line: first.id_at.line };
            problems.push(row.id_at, kind);
        }
        targets.push(row.spec.follows.as_ref().and_then(|f| check_target(&rows, row, f, problems)));
    }
    if problems.any() {
        return None;
    }
    let order = following_order(&rows, &targets, problems)?;
    Some(ParamTable { specs: rows.into_iter().map(|r| r.spec).collect(), order })
}

fn check_target(rows: &[Row], row: &Row, follow: &Follow, problems: &mut Problems) -> Option<usize> {
    let Some(target) = rows.iter().position(|r| r.spec.id == follow.id) else {
        let ids = rows.iter().map(|r| (r.spec.id.as_str(), r.spec.id.as_str()));
        let near = nearest(&follow.id, ids).into_iter().map(str::to_owned).collect();
        problems.push(row.follows_at, ProblemKind::UnknownParameter { id: follow.id.clone(), nearest: near });
        return None;
    };
    let min = rows[target].spec.min;
    if min <= 0.0 {
        let (id, target) = (row.spec.id.clone(), follow.id.clone());
        problems.push(row.follows_at, ProblemKind::UnfollowableTarget { id, target, min });
    }
    Some(target)
}

/// Rows by how many links they are away from a row that follows nobody.
fn following_order(
    rows: &[Row],
    targets: &[Option<usize>],
    problems: &mut Problems,
) -> Option<Vec<(usize, Option<usize>)>> {
    let mut depths = Vec::with_capacity(rows.len());
    for start in 0..rows.len() {
        let mut chain = vec![start];
        while let Some(next) = targets[chain[chain.len() - 1]] {
            if next == start {
                // Each circle is reported once, at its first member in the table.
                if chain.iter().all(|&i| i >= start) {
                    let ids = chain.iter().map(|&i| rows[i].spec.id.clone()).collect();
                    problems.push(rows[start].follows_at, ProblemKind::Cycle { ids });
                }
                break;
            }
            if chain.contains(&next) {
                break;
            }
            chain.push(next);
        }
        depths.push(chain.len());
    }
    if problems.any() {
        return None;
    }
    let mut order: Vec<(usize, Option<usize>)> = targets.iter().copied().enumerate().collect();
    order.sort_by_key(|&(i, _)| (depths[i], i));
    Some(order)
}
