//! `londra list`.

use super::args::{List, Listed};
use super::rigs::Rigs;
use super::{Failure, output};
use crate::anatomy::{Breed, ParamSpec};
use crate::measure::SkullClass;
use crate::motion::{Clip, Expression, Library, Moved, Part, Sides, Unit};
use serde_json::{Value, json};

/// Prints names for people, or everything as JSON.
pub(super) fn run(args: &List) -> Result<(), Failure> {
    let json = args.report.json;
    match args.what {
        Listed::Breeds => breeds(json),
        Listed::Parameters => parameters(json),
        Listed::Units => units(json),
        Listed::Expressions => expressions(json),
        Listed::Clips => clips(json),
    }
}

fn breeds(json: bool) -> Result<(), Failure> {
    let rigs = Rigs::open()?;
    let breeds = rigs.ids().iter().map(|id| rigs.breed(id)).collect::<Result<Vec<_>, _>>()?;
    if json {
        return output::json(&breeds.iter().map(breed_as_json).collect());
    }
    let width = breeds.iter().map(|b| b.id.chars().count()).max().unwrap_or(0);
    let lines = breeds.iter().map(|b| {
        let coats: Vec<&str> = b.varieties.iter().map(|v| v.name.as_str()).collect();
        let coats = if coats.is_empty() { String::new() } else { format!(" ({})", coats.join(", ")) };
        format!("{:width$}  {}{coats}", b.id, b.label)
    });
    output::result(&lines.collect::<Vec<_>>().join("\n"))
}

fn parameters(json: bool) -> Result<(), Failure> {
    let rigs = Rigs::open()?;
    let specs = &rigs.table.specs;
    if json {
        return output::json(&specs.iter().map(as_json).collect());
    }
    let width = specs.iter().map(|s| s.id.len()).max().unwrap_or(0);
    let lines = specs.iter().map(|s| {
        let range = format!("{} to {}", s.min, s.max);
        format!("{:width$}  {:>12}  default {:>6}  {}: {}", s.id, range, s.default, s.group, s.label)
    });
    output::result(&lines.collect::<Vec<_>>().join("\n"))
}

fn units(json: bool) -> Result<(), Failure> {
    let library = Library::embedded().map_err(Failure::work)?;
    let units = &library.units.units;
    if json {
        return output::json(
            &units.iter().enumerate().map(|(number, unit)| unit_as_json(&library, number, unit)).collect(),
        );
    }
    let lines = units.iter().map(|unit| {
        let sides = if unit.sides == Sides::Each { "L R" } else { "   " };
        let instead = if unit.clip.is_empty() { String::new() } else { format!(" (the clip {})", unit.clip) };
        format!("{:9}  {:10}  {sides}  {}{instead}", unit.id, unit.group.label(), unit.name)
    });
    output::result(&lines.collect::<Vec<_>>().join("\n"))
}

fn expressions(json: bool) -> Result<(), Failure> {
    let library = Library::embedded().map_err(Failure::work)?;
    let still = |e: &Expression| library.units.notation(&library.units.resolve(&e.still(), |_| ()));
    if json {
        let as_json = |e: &Expression| {
            let part = |p: &Part| {
                json!({
                    "unit": library.units.units[p.unit].id, "side": p.side.suffix(), "intensity": p.intensity,
                    "start_s": p.start_s, "onset_s": p.onset_s, "hold_s": p.hold_s, "offset_s": p.offset_s,
                    "every_s": p.every_s, "until_s": p.until_s, "note": p.note, "evidence": p.evidence,
                })
            };
            json!({
                "id": e.id, "label": e.label, "seconds": e.seconds(), "still_s": e.still_s, "still": still(e),
                "units": e.parts.iter().map(part).collect::<Vec<_>>(),
            })
        };
        return output::json(&library.expressions.iter().map(as_json).collect());
    }
    let line = |e: &Expression| format!("{:21}  {:5.2} s  {}: {}", e.id, e.seconds(), e.label, still(e));
    output::result(&library.expressions.iter().map(line).collect::<Vec<_>>().join("\n"))
}

fn clips(json: bool) -> Result<(), Failure> {
    let library = Library::embedded().map_err(Failure::work)?;
    if json {
        let as_json = |c: &Clip| {
            let moved = |m: Moved| match m {
                Moved::Unit(unit) => library.units.units[unit].id.as_str(),
                Moved::Target(target) => target.id(&library.muscles),
            };
            let tracks = c.layers.iter().flat_map(|layer| &layer.tracks);
            json!({
                "id": c.id, "label": c.label, "seconds": c.seconds, "repeats": c.repeats, "source": c.source,
                "moves": tracks.map(|t| format!("{}{}", moved(t.of), t.side.suffix())).collect::<Vec<_>>(),
            })
        };
        return output::json(&library.clips.iter().map(as_json).collect());
    }
    let line = |c: &Clip| {
        let repeats = if c.repeats { ", again and again" } else { "" };
        format!("{:11}  {:5.2} s  {}{repeats}", c.id, c.seconds, c.label)
    };
    output::result(&library.clips.iter().map(line).collect::<Vec<_>>().join("\n"))
}

fn unit_as_json(library: &Library, number: usize, unit: &Unit) -> Value {
    let drives = unit.drives.iter().map(|d| json!({ "id": d.target.id(&library.muscles), "value": d.value }));
    let landmarks = unit.landmarks.iter().map(|m| json!({ "id": m.0, "axis": m.1, "least_mm": m.2, "most_mm": m.3 }));
    let gaps = unit.gaps.iter().map(|g| json!({ "between": [g.0, g.1], "least_mm": g.2, "most_mm": g.3 }));
    let rules = library.units.rules.iter().filter(|rule| rule.units().contains(&number)).map(|rule| {
        let others = rule.units().into_iter().map(|unit| library.units.units[unit].id.as_str());
        json!({ "units": others.collect::<Vec<_>>(), "why": rule.why, "source": rule.source })
    });
    json!({
        "id": unit.id, "label": unit.label, "name": unit.name, "group": unit.group, "sides": unit.sides,
        "drives": drives.collect::<Vec<_>>(), "hz": unit.cycle.as_ref().map(|c| c.hz),
        "clip": Some(&unit.clip).filter(|clip| !clip.is_empty()), "landmarks": landmarks.collect::<Vec<_>>(),
        "gaps": gaps.collect::<Vec<_>>(),
        "opening": unit.opening_deg.map(|(least, most)| json!({ "least_deg": least, "most_deg": most })), "criterion": unit.criterion, "rules": rules.collect::<Vec<_>>(),
        "lacks": unit.lacks, "source": unit.source, "status": unit.status,
    })
}

/// Nothing here is measured on a head: that would take a second for all; `londra measure` does it for one.
fn breed_as_json(breed: &Breed) -> Value {
    let index = breed.reference("skull_index").map(|r| SkullClass::of(r.value as f32).name());
    let references: Vec<Value> = breed.references.iter().map(|r| super::measure::as_json(r, None)).collect();
    let coats: Vec<&str> = breed.varieties.iter().map(|v| v.name.as_str()).collect();
    json!({
        "id": breed.id, "label": breed.label, "fci_group": breed.fci_group, "reference_class": index,
        "references": references, "coats": coats,
    })
}

fn as_json(spec: &ParamSpec) -> Value {
    let follows = spec.follows.as_ref().map(|f| json!({ "id": f.id, "exponent": f.exponent }));
    json!({
        "id": spec.id, "label": spec.label, "group": spec.group, "unit": spec.unit.name(), "min": spec.min,
        "max": spec.max, "default": spec.default, "follows": follows, "moves": spec.moves, "help": spec.help,
        "source": spec.source, "synonyms": spec.synonyms,
    })
}
