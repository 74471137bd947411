//! [`Breed`] to text.

use super::file::NEWEST;
use super::{Breed, Hair, ParamTable, Reference, Region, RegionHair, Variety, coat_file, colour, hair, param};
use glam::Vec3;
use std::fmt::Write;

/// Writes a breed as a file: what it is held against, the values that are set, in the order of
/// the table, and the look.
///
/// [`super::load_breed`] turns the text into the same breed again, to the bit; only the id is the file's name and not in it.
/// A dog that wears none of its breed's coats is written with that coat alone.
pub fn save_breed(table: &ParamTable, breed: &Breed) -> String {
    let mut out = String::new();
    // Writing into a String cannot fail.
    let _ = write_breed(&mut out, table, breed);
    out
}

fn write_breed(out: &mut String, table: &ParamTable, breed: &Breed) -> std::fmt::Result {
    writeln!(out, "Breed(\n    version: {NEWEST},\n    label: {},", quoted(&breed.label))?;
    if let Some(group) = breed.fci_group {
        writeln!(out, "    fci_group: {group},")?;
    }
    if !breed.references.is_empty() {
        writeln!(out, "    references: [")?;
        for Reference { quantity, value, status, source } in &breed.references {
            let (measure, source) = (quoted(quantity.id), quoted(source));
            writeln!(out, "        (measure: {measure}, value: {value:?}, status: {status}, source: {source}),")?;
        }
        writeln!(out, "    ],")?;
    }
    writeln!(out, "    anatomy: {{")?;
    for (i, spec) in table.specs.iter().enumerate().filter(|(i, _)| breed.set[*i]) {
        writeln!(out, "        \"{}\": {:?},", spec.id, spec.from_si(breed.values[i]))?;
    }
    writeln!(out, "    }},")?;
    if let Some(worn) = breed.worn() {
        writeln!(out, "    coats: {{")?;
        let first = &breed.varieties[0];
        for (i, Variety { name, look }) in breed.varieties.iter().enumerate() {
            writeln!(out, "        {}: (", quoted(name))?;
            coat_file::write(out, "            ", look, (i > 0).then_some(&first.look))?;
            writeln!(out, "        ),")?;
        }
        writeln!(out, "    }},")?;
        if breed.look != first.look {
            writeln!(out, "    wears: {},", quoted(worn))?;
        }
    } else {
        writeln!(out, "    coat: (")?;
        coat_file::write(out, "        ", &breed.look, None)?;
        writeln!(out, "    ),")?;
    }
    writeln!(out, ")")
}

pub(super) fn hair_text(hair: &Hair) -> String {
    let mut out: Vec<String> = hair::FIELDS.iter().map(|f| number_text(f.name, (f.get)(hair), f.unit())).collect();
    if !hair.regions.is_empty() {
        let of_region = |(region, told): (&Region, &RegionHair)| {
            let numbers: Vec<String> = told.fields().map(|(f, value)| number_text(f.name, value, f.unit())).collect();
            format!("\"{}\": ({})", region.name(), numbers.join(", "))
        };
        let regions: Vec<String> = hair.regions.iter().map(of_region).collect();
        out.push(format!("{}: {{{}}}", hair::REGIONS, regions.join(", ")));
    }
    out.join(", ")
}

/// `name: value`, the shortest that is read as the same bits; `unit`: of the file, in the value's own.
fn number_text(name: &str, value: f32, unit: f64) -> String {
    let is_same = |c: f64| ((c * unit) as f32).to_bits() == value.to_bits();
    format!("{name}: {:?}", param::shortest(f64::from(value) / unit, is_same))
}

pub(super) fn colour_text(linear: Vec3) -> String {
    let hex = colour::to_hex(linear);
    if colour::from_hex(&hex) == Some(linear) {
        return format!("\"{hex}\"");
    }
    let [r, g, b] = linear.to_array().map(number);
    format!("({r}, {g}, {b})")
}

pub(super) fn number(value: f32) -> String {
    let short = param::shortest(f64::from(value), |c| (c as f32).to_bits() == value.to_bits());
    format!("{short:?}")
}

fn quoted(text: &str) -> String {
    let mut out = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => out.push_str(&format!("\\u{{{:x}}}", u32::from(c))),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}
