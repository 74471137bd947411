//! `londra measure`.

use super::args::Measure;
use super::rigs::Rigs;
use super::{Failure, output, subject};
use crate::measure::{Calliper, Dimension, Measurement, SkullClass, Tissue, percentile, value};
use crate::rig::Rig;
use serde_json::json;
use std::sync::Arc;

/// Prints every measurement of a head.
pub(super) fn run(args: &Measure) -> Result<(), Failure> {
    let rigs = Rigs::open()?;
    let breed = subject::breed(&rigs, &args.subject.breed, &args.subject.changes)?;
    let rig = Arc::new(Rig::embedded(&rigs.table).map_err(Failure::work)?);
    let mut calliper = Calliper::new(rig).map_err(Failure::work)?;
    let found = calliper.measure(&breed.values);
    let breeds = rigs.ids().iter().map(|id| rigs.breed(id)).collect::<Result<Vec<_>, _>>()?;
    let survey = calliper.survey(&breeds);
    let rank = |k: usize| percentile(found[k].value, survey.iter().map(|list| list[k].value));
    let class = SkullClass::of(value(&found, "skull_index"));
    if args.report.json {
        let list: Vec<_> = found
            .iter()
            .enumerate()
            .map(|(k, m)| {
                json!({
                    "id": m.id, "label": m.label, "definition": m.definition, "on": tissue(m.tissue),
                    "unit": m.dimension.unit(), "value": rounded(m), "percentile": rank(k).map(|p| f64::from(p.round())),
                    "status": "measured on the model",
                })
            })
            .collect();
        return output::json(&json!({
            "breed": breed.id, "label": breed.label, "class": class.name(), "among": breeds.len(), "measurements": list,
        }));
    }
    let width = found.iter().map(|m| m.label.chars().count()).max().unwrap_or(0);
    let mut lines = vec![format!("{}: {}; percentiles among {} breeds", breed.label, class.name(), breeds.len())];
    for (k, m) in found.iter().enumerate() {
        let number = format!("{} {:3}", decimal(m), m.dimension.unit());
        let rank = rank(k).map_or(String::new(), |p| format!("p{p:.0}"));
        lines.push(format!("{:width$}  {number:>12}  {rank:>4}  {}: {}", m.label, tissue(m.tissue), m.definition));
    }
    output::result(&lines.join("\n"))
}

fn tissue(tissue: Tissue) -> &'static str {
    match tissue {
        Tissue::Bone => "bone",
        Tissue::Skin => "skin",
    }
}

fn decimal(m: &Measurement) -> String {
    if m.dimension == Dimension::Ratio { format!("{:.2}", m.value) } else { format!("{:.1}", m.value) }
}

fn rounded(m: &Measurement) -> f64 {
    (f64::from(m.value) * 1000.0).round() / 1000.0
}
