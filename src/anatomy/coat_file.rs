//! The coats of a breed's file.
//!
//! Version 1 had one coat, whose `marks` were colours over regions: they become [`MarkingKind::Patch`] layers.

use super::file::read_colour;
use super::locate::{Item, Node, Place};
use super::read::{Fields, Problems};
use super::{
    Eumelanin, Hair, Look, Marking, MarkingKind, Paint, Pattern, Pigments, ProblemKind, Region, RegionHair, Variety,
    hair, look, nearest, region_hair,
};
use std::collections::BTreeMap;

/// Fields of a coat, in the order in which they are written.
const FIELDS: [&str; 11] =
    ["eumelanin", "phaeomelanin", "base", "markings", "mixed", "nose", "lips", "mouth", "iris", "fur", "hair"];
const FIELDS_1: [&str; 8] = ["base", "marks", "nose", "lips", "mouth", "iris", "fur", "hair"];

/// What a breed wears and what it comes in: `coat: (…)`, or `coats: {"name": (…), …}` with `wears`.
pub(super) fn read(fields: &Fields<'_>, version: u32, problems: &mut Problems) -> (Look, Vec<Variety>) {
    let (one, many) = (fields.get("coat"), fields.get("coats").filter(|_| version > 1));
    let missing = |problems: &mut Problems, found| problems.push(fields.place(), ProblemKind::CoatOrCoats { found });
    let nodes = match (one, many) {
        (Some(node), None) => {
            if let Some(wears) = fields.get("wears") {
                missing_wears(wears, problems);
            }
            return (read_look(node, "coat", version, None, problems), Vec::new());
        }
        (None, Some(node)) => problems.map(node, "coats"),
        (None, None) if version == 1 => {
            fields.require("coat", problems);
            return Default::default();
        }
        (None, None) => {
            missing(problems, "found neither");
            return Default::default();
        }
        (Some(_), Some(_)) => {
            missing(problems, "found both");
            return Default::default();
        }
    };
    let mut varieties: Vec<Variety> = Vec::new();
    for (name, at, node) in nodes {
        if name.trim().is_empty() {
            problems.push(at, ProblemKind::Empty { field: "a name in coats".into() });
        }
        let first = varieties.first().map(|v| &v.look);
        let look = read_look(node, &format!("coats[{name:?}]"), version, first, problems);
        varieties.push(Variety { name: name.to_owned(), look });
    }
    let Some(first) = varieties.first() else {
        missing(problems, "found none");
        return Default::default();
    };
    let mut worn = first.look.clone();
    if let Some(node) = fields.get("wears")
        && let Some(name) = problems.text(node, "wears")
    {
        match varieties.iter().find(|v| v.name == name) {
            Some(variety) => worn = variety.look.clone(),
            None => {
                let coats: Vec<String> = varieties.iter().map(|v| v.name.clone()).collect();
                let near = near(&name, coats.iter().map(String::as_str));
                problems.push(node.place, ProblemKind::UnknownVariety { name, nearest: near, coats });
            }
        }
    }
    (worn, varieties)
}

fn missing_wears(node: &Node, problems: &mut Problems) {
    let name = problems.text(node, "wears").unwrap_or_default();
    problems.push(node.place, ProblemKind::UnknownVariety { name, nearest: Vec::new(), coats: Vec::new() });
}

fn near<'a>(word: &str, known: impl Iterator<Item = &'a str>) -> Vec<String> {
    nearest(word, known.map(|k| (k, k))).into_iter().map(str::to_owned).collect()
}

/// A coat; what it does not tell of mouth, fur and hair is that of the `first` coat.
fn read_look(node: &Node, path: &str, version: u32, first: Option<&Look>, problems: &mut Problems) -> Look {
    let allowed: &[&str] = if version == 1 { &FIELDS_1 } else { &FIELDS };
    let Some(fields) = problems.fields(node, path, "Coat", allowed) else { return Look::default() };
    let pattern = read_pattern(&fields, version, problems);
    let mut look = Look::of(pattern);
    if let Some(first) = first {
        (look.mouth, look.fur, look.hair) = (first.mouth, first.fur, first.hair.clone());
    }
    for (key, colour) in
        [("nose", &mut look.nose), ("lips", &mut look.lips), ("mouth", &mut look.mouth), ("iris", &mut look.iris)]
    {
        if let Some(read) = fields.get(key).and_then(|n| read_colour(n, &fields.path_of(key), problems)) {
            *colour = read;
        }
    }
    if let Some(fur) = fields.get("fur").and_then(|n| problems.number_in(n, &fields.path_of("fur"), 0.0, 1.0)) {
        look.fur = fur as f32;
    }
    if let Some(hair) = fields.get("hair").and_then(|n| read_hair(n, &fields.path_of("hair"), problems)) {
        look.hair = hair;
    }
    if let Some(node) = fields.get("mixed").filter(|_| version > 1) {
        look.mixed = read_mixed(node, &fields.path_of("mixed"), version, problems);
    }
    look
}

fn read_pattern(fields: &Fields<'_>, version: u32, problems: &mut Problems) -> Pattern {
    let mut pigments = Pigments::default();
    if let Some(eumelanin) =
        fields.get("eumelanin").and_then(|n| read_eumelanin(n, &fields.path_of("eumelanin"), problems))
    {
        pigments.eumelanin = eumelanin;
    }
    let key = "phaeomelanin";
    if let Some(intensity) = fields.get(key).and_then(|n| problems.number_in(n, &fields.path_of(key), 0.0, 1.0)) {
        pigments.phaeomelanin = intensity as f32;
    }
    let base = fields.require("base", problems).and_then(|n| {
        let path = fields.path_of("base");
        if version == 1 { read_colour(n, &path, problems).map(Paint::Colour) } else { read_paint(n, &path, problems) }
    });
    let key = if version == 1 { "marks" } else { "markings" };
    let markings = fields.get(key).map_or(Vec::new(), |node| {
        let path = fields.path_of(key);
        let nodes = problems.list(node, &path).iter().enumerate();
        let one = |(i, n): (usize, &Node)| {
            let path = format!("{path}[{i}]");
            if version == 1 { read_mark(n, &path, problems) } else { read_marking(n, &path, problems) }
        };
        nodes.filter_map(one).collect()
    });
    Pattern { pigments, base: base.unwrap_or(Paint::White), markings }
}

fn read_mixed(node: &Node, path: &str, version: u32, problems: &mut Problems) -> Vec<(f32, Pattern)> {
    let allowed = ["share", "eumelanin", "phaeomelanin", "base", "markings"];
    let mut mixed = Vec::new();
    for (i, n) in problems.list(node, path).iter().enumerate() {
        let Some(fields) = problems.fields(n, &format!("{path}[{i}]"), "Mixed", &allowed) else { continue };
        let share = fields.require("share", problems);
        let share = share.and_then(|n| problems.number_in(n, &fields.path_of("share"), 0.0, 1.0));
        let pattern = read_pattern(&fields, version, problems);
        mixed.extend(share.filter(|share| *share > 0.0).map(|share| (share as f32, pattern)));
    }
    let sum: f64 = mixed.iter().map(|(share, _)| f64::from(*share)).sum();
    if sum >= 1.0 {
        problems.push(node.place, ProblemKind::Shares { field: path.to_owned(), sum });
    }
    mixed
}

fn read_hair(node: &Node, path: &str, problems: &mut Problems) -> Option<Hair> {
    let fields = problems.fields(node, path, "Hair", &hair::NAMES)?;
    let given: Vec<Option<f32>> = hair::FIELDS
        .iter()
        .map(|field| {
            let path = fields.path_of(field.name);
            let value = problems.number_in(fields.get(field.name)?, &path, 0.0, field.max())?;
            Some((value * field.unit()) as f32)
        })
        .collect();
    let mut hair = Hair::from_given(|i| given[i]);
    if let Some(node) = fields.get(hair::REGIONS) {
        hair.regions = read_region_hairs(node, &fields.path_of(hair::REGIONS), problems);
    }
    Some(hair)
}

/// `{"region": (curl: 0.8, …), …}`.
fn read_region_hairs(node: &Node, path: &str, problems: &mut Problems) -> BTreeMap<Region, RegionHair> {
    let mut hairs = BTreeMap::new();
    for (name, at, node) in problems.map(node, path) {
        let Some(region) = region(name, at, problems) else { continue };
        if region.is_bare() {
            problems.push(at, ProblemKind::BareRegion { field: path.to_owned(), name: name.to_owned() });
            continue;
        }
        let path = format!("{path}[{name:?}]");
        let Some(fields) = problems.fields(node, &path, "RegionHair", &region_hair::NAMES) else { continue };
        let told = RegionHair::from_fields(|field| {
            let [min, max] = field.range;
            let value = problems.number_in(fields.get(field.name)?, &fields.path_of(field.name), min, max)?;
            Some((value * field.unit()) as f32)
        });
        if !told.is_empty() {
            hairs.insert(region, told);
        }
    }
    hairs
}

/// A region by its name; one that is unknown is told of.
fn region(name: &str, at: Place, problems: &mut Problems) -> Option<Region> {
    let region = Region::from_name(name);
    if region.is_none() {
        let nearest = near(name, Region::ALL.iter().map(|r| r.name()));
        problems.push(at, ProblemKind::UnknownRegion { name: name.to_owned(), nearest });
    }
    region
}

/// `Kind(colour: …, amount: …, …)`.
fn read_marking(node: &Node, path: &str, problems: &mut Problems) -> Option<Marking> {
    let name = match &node.item {
        Item::Record(Some(name), _) => name,
        Item::Tuple(Some(name), items) if items.is_empty() => name,
        _ => {
            problems.wrong_type(node, path, "a marking, Kind(colour: …, …)");
            return None;
        }
    };
    let Some(kind) = MarkingKind::from_name(name) else {
        let allowed: Vec<&'static str> = MarkingKind::ALL.iter().map(|k| k.name()).collect();
        let nearest = near(name, allowed.iter().copied());
        let (field, name) = (path.to_owned(), name.clone());
        problems.push(node.place, ProblemKind::UnknownMarking { field, name, nearest, allowed });
        return None;
    };
    let mut allowed = vec!["colour", "amount"];
    allowed.extend(kind.fields().iter().map(|f| f.name));
    if kind == MarkingKind::Patch {
        allowed.push("regions");
    }
    let fields = problems.fields(node, path, kind.name(), &allowed)?;
    let paint = fields.require("colour", problems).and_then(|n| read_paint(n, &fields.path_of("colour"), problems));
    let mut marking = Marking::new(kind, paint.unwrap_or(Paint::White));
    if let Some(amount) = fields.get("amount") {
        marking.amount = problems.number_in(amount, &fields.path_of("amount"), 0.0, 1.0).unwrap_or_default() as f32;
    }
    for (value, field) in marking.values.iter_mut().zip(kind.fields()) {
        let Some(node) = fields.get(field.name) else { continue };
        let (min, max) = (f64::from(field.min), f64::from(field.max));
        if let Some(read) = problems.number_in(node, &fields.path_of(field.name), min, max) {
            *value = read as f32;
        }
    }
    if kind == MarkingKind::Patch {
        marking.regions = read_regions(&fields, problems);
    }
    Some(marking)
}

/// A mark of version 1.
fn read_mark(node: &Node, path: &str, problems: &mut Problems) -> Option<Marking> {
    let fields = problems.fields(node, path, "Mark", &["regions", "colour", "amount"])?;
    let regions = read_regions(&fields, problems);
    let colour = fields.require("colour", problems).and_then(|n| read_colour(n, &fields.path_of("colour"), problems));
    let amount = fields.require("amount", problems);
    let amount = amount.and_then(|n| problems.number_in(n, &fields.path_of("amount"), 0.0, 1.0));
    Some(Marking::patch(regions, colour.unwrap_or_default(), amount.unwrap_or_default() as f32))
}

fn read_regions(fields: &Fields<'_>, problems: &mut Problems) -> Vec<Region> {
    let Some(node) = fields.require("regions", problems) else { return Vec::new() };
    let path = fields.path_of("regions");
    let mut regions = Vec::new();
    for node in problems.list(node, &path) {
        let Some(name) = problems.text(node, &path) else { continue };
        regions.extend(region(&name, node.place, problems));
    }
    regions
}

fn read_eumelanin(node: &Node, field: &str, problems: &mut Problems) -> Option<Eumelanin> {
    let found = match &node.item {
        Item::Word(word) => word.clone(),
        other => other.form().to_owned(),
    };
    let eumelanin = Eumelanin::from_name(&found).filter(|_| matches!(node.item, Item::Word(_)));
    if eumelanin.is_none() {
        let allowed = Eumelanin::ALL.map(Eumelanin::name).to_vec();
        let near = near(&found, allowed.iter().copied());
        problems.push(node.place, ProblemKind::UnknownWord { field: field.to_owned(), found, nearest: near, allowed });
    }
    eumelanin
}

/// A pigment by its name, or a colour.
fn read_paint(node: &Node, field: &str, problems: &mut Problems) -> Option<Paint> {
    let bad = |problems: &mut Problems, found: String| {
        problems.push(node.place, ProblemKind::BadPaint { field: field.to_owned(), found });
        None
    };
    match &node.item {
        Item::Word(word) => match word.as_str() {
            "Eumelanin" => Some(Paint::Eumelanin),
            "Phaeomelanin" => Some(Paint::Phaeomelanin(None)),
            "White" => Some(Paint::White),
            _ => bad(problems, word.clone()),
        },
        Item::Tuple(Some(name), items) if name == "Phaeomelanin" && items.len() == 1 => {
            let intensity = problems.number_in(&items[0], field, 0.0, 1.0)?;
            Some(Paint::Phaeomelanin(Some(intensity as f32)))
        }
        Item::Text(_) | Item::Tuple(None, _) => read_colour(node, field, problems).map(Paint::Colour),
        other => bad(problems, other.form().to_owned()),
    }
}

/// The lines of a coat, without the brackets around them. What follows from its pigments, or from the `first` coat, is
/// left out.
pub(super) fn write(out: &mut String, indent: &str, coat: &Look, first: Option<&Look>) -> std::fmt::Result {
    use super::save::{colour_text, hair_text, number};
    use std::fmt::Write;
    write_pattern(out, indent, &coat.pattern)?;
    if !coat.mixed.is_empty() {
        writeln!(out, "{indent}mixed: [")?;
        for (share, pattern) in &coat.mixed {
            writeln!(out, "{indent}    (\n{indent}        share: {},", number(*share))?;
            write_pattern(out, &format!("{indent}        "), pattern)?;
            writeln!(out, "{indent}    ),")?;
        }
        writeln!(out, "{indent}],")?;
    }
    let eumelanin = coat.pattern.pigments.eumelanin;
    let mouth = first.map_or(look::pink(), |f| f.mouth);
    let followed = [
        ("nose", coat.nose, eumelanin.nose()),
        ("lips", coat.lips, eumelanin.lips()),
        ("mouth", coat.mouth, mouth),
        ("iris", coat.iris, eumelanin.iris()),
    ];
    for (name, colour, _) in followed.into_iter().filter(|(_, colour, otherwise)| colour != otherwise) {
        writeln!(out, "{indent}{name}: {},", colour_text(colour))?;
    }
    if first.is_none_or(|f| f.fur != coat.fur) {
        writeln!(out, "{indent}fur: {},", number(coat.fur))?;
    }
    if first.is_none_or(|f| f.hair != coat.hair) {
        writeln!(out, "{indent}hair: ({}),", hair_text(&coat.hair))?;
    }
    Ok(())
}

fn write_pattern(out: &mut String, indent: &str, pattern: &Pattern) -> std::fmt::Result {
    use super::save::number;
    use std::fmt::Write;
    let Pigments { eumelanin, phaeomelanin } = pattern.pigments;
    writeln!(out, "{indent}eumelanin: {},", eumelanin.name())?;
    writeln!(out, "{indent}phaeomelanin: {},", number(phaeomelanin))?;
    writeln!(out, "{indent}base: {},", paint_text(pattern.base))?;
    if pattern.markings.is_empty() {
        return Ok(());
    }
    writeln!(out, "{indent}markings: [")?;
    for Marking { kind, paint, amount, values, regions } in &pattern.markings {
        write!(out, "{indent}    {}(colour: {}", kind.name(), paint_text(*paint))?;
        if *kind == MarkingKind::Patch {
            let regions: Vec<String> = regions.iter().map(|r| format!("\"{}\"", r.name())).collect();
            write!(out, ", regions: [{}]", regions.join(", "))?;
        }
        for (field, value) in kind.fields().iter().zip(values) {
            write!(out, ", {}: {}", field.name, number(*value))?;
        }
        writeln!(out, ", amount: {}),", number(*amount))?;
    }
    writeln!(out, "{indent}],")
}

fn paint_text(paint: Paint) -> String {
    use super::save::{colour_text, number};
    match paint {
        Paint::Colour(colour) => colour_text(colour),
        Paint::Eumelanin => "Eumelanin".into(),
        Paint::Phaeomelanin(None) => "Phaeomelanin".into(),
        Paint::Phaeomelanin(Some(intensity)) => format!("Phaeomelanin({})", number(intensity)),
        Paint::White => "White".into(),
    }
}
