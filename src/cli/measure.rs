//! `londra measure`.

use super::args::Measure;
use super::rigs::Rigs;
use super::{Failure, output, subject};
use crate::anatomy::{Breed, Reference};
use crate::measure::{Calliper, Deviation, Dimension, Measurement, SkullClass, percentile, value};
use crate::rig::Rig;
use serde_json::{Value, json};
use std::sync::Arc;

/// Prints every measurement of a head, each beside what the breed's file holds it against.
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
                let known = references(&breed, m);
                json!({
                    "id": m.id, "label": m.label, "definition": m.definition, "on": m.tissue.name(),
                    "unit": m.dimension.unit(), "value": rounded(m.value), "percentile": rank(k).map(|p| f64::from(p.round())),
                    "status": "measured on the model", "references": known.map(|r| as_json(r, Some(m))).collect::<Vec<_>>(),
                })
            })
            .collect();
        return output::json(&json!({
            "breed": breed.id, "label": breed.label, "class": class.name(), "among": breeds.len(), "measurements": list,
            "references": others(&breed, &found).map(|r| as_json(r, None)).collect::<Vec<_>>(),
        }));
    }
    let width = found.iter().map(|m| m.label.chars().count()).max().unwrap_or(0);
    let mut lines = vec![format!("{}: {}; percentiles among {} breeds", breed.label, class.name(), breeds.len())];
    for (k, m) in found.iter().enumerate() {
        let number = number(m.dimension, m.value);
        let rank = rank(k).map_or(String::new(), |p| format!("p{p:.0}"));
        lines.push(format!("{:width$}  {number:>12}  {rank:>4}  {}: {}", m.label, m.tissue.name(), m.definition));
        for r in references(&breed, m) {
            let (number, off) = (self::number(m.dimension, r.value as f32), Deviation::of(m, r));
            lines.push(format!(
                "{:>width$}  {number:>12}  {:>4}  off by {off}; {}: {}",
                "reference", "", r.status, r.source
            ));
        }
    }
    for r in others(&breed, &found) {
        let name = r.quantity.id.replace('_', " ");
        lines.push(format!("Reference for {name}: {} {}, {}: {}", r.value, r.quantity.unit, r.status, r.source));
    }
    output::result(&lines.join("\n"))
}

/// What a measurement is held against, in the order of the breed's file.
fn references<'a>(breed: &'a Breed, m: &Measurement) -> impl Iterator<Item = &'a Reference> + use<'a> {
    let id = m.id;
    breed.references.iter().filter(move |r| r.quantity.id == id)
}

/// What is known of the dog and cannot be measured on its head.
fn others<'a>(breed: &'a Breed, found: &[Measurement]) -> impl Iterator<Item = &'a Reference> {
    breed.references.iter().filter(|r| found.iter().all(|m| m.id != r.quantity.id))
}

/// A reference as JSON, with what the measurement differs from it by.
pub(super) fn as_json(reference: &Reference, measured: Option<&Measurement>) -> Value {
    let Reference { quantity, value, status, source } = reference;
    let mut json = json!({
        "measure": quantity.id, "unit": quantity.unit, "value": value, "status": status.name(), "source": source,
    });
    if let Some(off) = measured.map(|m| Deviation::of(m, reference)) {
        json["deviation"] = rounded(off.difference).into();
        json["deviation_percent"] = off.percent.map(rounded).into();
    }
    json
}

fn number(dimension: Dimension, value: f32) -> String {
    format!("{value:.*} {:3}", dimension.decimals(), dimension.unit())
}

fn rounded(value: f32) -> f64 {
    (f64::from(value) * 1000.0).round() / 1000.0
}
