//! `londra list`.

use super::args::{List, Listed};
use super::rigs::Rigs;
use super::{Failure, output};
use crate::anatomy::{Breed, ParamSpec};
use crate::measure::SkullClass;
use serde_json::{Value, json};

/// Prints names for people, or everything as JSON.
pub(super) fn run(args: &List) -> Result<(), Failure> {
    let rigs = Rigs::open()?;
    match args.what {
        Listed::Breeds => {
            let breeds = rigs.ids().iter().map(|id| rigs.breed(id)).collect::<Result<Vec<_>, _>>()?;
            if args.report.json {
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
        Listed::Parameters => {
            let specs = &rigs.table.specs;
            if args.report.json {
                return output::json(&specs.iter().map(as_json).collect());
            }
            let width = specs.iter().map(|s| s.id.len()).max().unwrap_or(0);
            let lines = specs.iter().map(|s| {
                let range = format!("{} to {}", s.min, s.max);
                format!("{:width$}  {:>12}  default {:>6}  {}: {}", s.id, range, s.default, s.group, s.label)
            });
            output::result(&lines.collect::<Vec<_>>().join("\n"))
        }
    }
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
