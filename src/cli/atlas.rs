//! `londra atlas`: what every measure does, at the low end, the middle and the high end of its range.

use super::args::{Atlas, Fur};
use super::rigs::Rigs;
use super::{Failure, output, picture, unit_atlas, values};
use crate::anatomy::{Breed, ParamSpec, ParamTable};
use crate::frame::{Frame, Pipeline};
use crate::render::{Background, Camera, Drawing, Lens, Offscreen, PAPER, Picture, Section, Strip, View, atlas};
use crate::rig::Rig;
use glam::Vec3;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// Steps of refinement.
const LEVEL: u32 = 3;
/// Part of a picture left free around what it shows.
const MARGIN: f32 = 0.04;

/// Width and height of a picture when nobody says how large, pixels.
const CELL: [u32; 2] = [68, 68];

/// What of a head a picture is filled with.
#[derive(Clone, Copy)]
pub(super) enum Focus {
    /// All of it, whatever the measure makes of it.
    Head,
    /// What lies before the eyes.
    Face,
    /// Eyes and what is between them.
    Eyes,
    /// The end of the muzzle, the chin included.
    Muzzle,
    /// The nose.
    Nose,
    /// The dog's left ear, where it is set, and the back of the head.
    Ear,
}

/// Draws each measure on one breed, three heads a measure.
pub(super) fn run(args: &Atlas) -> Result<(), Failure> {
    if args.units {
        return unit_atlas::run(args);
    }
    output::check_target(&args.target.output, args.target.report.json)?;
    if args.split && output::is_stdout(&args.target.output) {
        return Err(Failure::Use("--split writes several files: name one that ends in .png, not -".into()));
    }
    let rigs = Rigs::open()?;
    let groups = groups(&rigs.table, &args.group)?;
    let breed = rigs.breed(&args.breed)?;
    let rig = Arc::new(Rig::embedded(&rigs.table).map_err(Failure::work)?);
    let mut pipeline = Pipeline::new(rig, LEVEL).map_err(Failure::work)?;
    pipeline.set_hair(args.fur.hair.unwrap_or(0) as usize);
    let mut studio = Studio {
        pipeline,
        fur: args.fur,
        offscreen: picture::offscreen()?,
        size: args.size.unwrap_or(CELL),
        view: args.view,
    };
    let (mut sections, mut changes) = (Vec::new(), Vec::new());
    for group in &groups {
        let mut strips = Vec::new();
        for (row, spec) in rigs.table.specs.iter().enumerate().filter(|(_, spec)| spec.group == *group) {
            let (strip, view) = studio.strip(&rigs.table, &breed, row)?;
            let change = difference(&strip.cells[0].0, &strip.cells[2].0);
            changes.push(json!({ "id": spec.id, "view": view.name(), "change": (change * 100.0).round() / 100.0 }));
            strips.push(strip);
        }
        sections.push(Section { heading: format!("{group}: {}", breed.label), strips });
    }
    let pages: Vec<(PathBuf, Picture)> = if args.split {
        let of_group = |(group, section): (&String, Section)| {
            (beside(&args.target.output, group), atlas(&[section], args.columns))
        };
        groups.iter().zip(sections).map(of_group).collect()
    } else {
        vec![(args.target.output.clone(), atlas(&sections, args.columns))]
    };
    write(&pages, &breed, changes, args.target.report.json)
}

fn write(pages: &[(PathBuf, Picture)], breed: &Breed, changes: Vec<Value>, json: bool) -> Result<(), Failure> {
    let told = |(path, page): &(PathBuf, Picture)| json!({ "output": path.display().to_string(), "width": page.width, "height": page.height });
    let files: Vec<Value> = pages.iter().map(told).collect();
    for (path, page) in pages {
        output::bytes(path, &page.to_png().map_err(Failure::work)?)?;
        if !json && !output::is_stdout(path) {
            output::message(&format!("wrote {}", path.display()));
        }
    }
    if json {
        output::json(&json!({ "breed": breed.id, "level": LEVEL, "files": files, "parameters": changes }))?;
    }
    Ok(())
}

/// The groups of the table in its order, or those that were asked for, whatever their case.
fn groups(table: &ParamTable, wanted: &[String]) -> Result<Vec<String>, Failure> {
    let mut groups: Vec<String> = table.specs.iter().map(|spec| spec.group.clone()).collect();
    groups.dedup();
    if let Some(word) = wanted.iter().find(|word| groups.iter().all(|group| slug(group) != slug(word))) {
        let known: Vec<String> = groups.iter().map(|group| slug(group)).collect();
        let near = crate::anatomy::nearest(word, known.iter().map(|g| (g.as_str(), g.as_str())));
        let near = values::did_you_mean(&near);
        return Err(Failure::Use(format!("unknown group '{word}'{near}; there are {}", known.join(", "))));
    }
    groups.retain(|group| wanted.is_empty() || wanted.iter().any(|word| slug(group) == slug(word)));
    Ok(groups)
}

/// `Lips and jaw` as `lips-and-jaw`.
pub(super) fn slug(group: &str) -> String {
    group.to_lowercase().replace([' ', '_'], "-")
}

/// `atlas.png` and `Ears` as `atlas_ears.png`.
fn beside(path: &Path, group: &str) -> PathBuf {
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!("{stem}_{}.png", slug(group)))
}

/// From where a measure is seen best, and how near.
fn aspect(spec: &ParamSpec) -> (View, Focus) {
    use Focus::{Ear, Eyes, Face, Head, Muzzle, Nose};
    use View::{Front, Portrait, Side};
    let from = |azimuth: f32, elevation: f32| View::Angles {
        azimuth: azimuth.to_radians(),
        elevation: elevation.to_radians(),
    };
    match (spec.group.as_str(), spec.id.as_str()) {
        (_, "occiput_mm") => (Side, Ear),
        (_, "cranial_width_mm" | "zygomatic_width_mm" | "temporalis_mm" | "masseter_mm") => (Front, Head),
        (_, "muzzle_width_root_mm" | "muzzle_width_tip_mm" | "neck_width_mm") => (Front, Head),
        (_, "furrow_mm") => (from(0.0, 50.0), Eyes),
        (_, "zygomatic_drop_mm") => (Portrait, Head),
        (_, "brow_mm" | "eye_depth_mm") => (Portrait, Eyes),
        (_, "bridge_width" | "lip_thickness") => (Front, Face),
        (_, "nose_roll") => (Portrait, Face),
        (_, "nasal_arch_mm") => (Side, Face),
        (_, "jaw_width") => (from(0.0, -40.0), Face),
        (_, "chin_mm") => (Side, Muzzle),
        (_, "dewlap_mm") => (Side, Head),
        (_, "nose_projection_mm" | "nose_lift_mm") => (Side, Nose),
        (_, "ear_length_mm" | "ear_set_back_mm") => (Side, Head),
        (_, "ear_width_mm" | "ear_back_deg" | "ear_tip" | "ear_widest" | "ear_base_mm") => (Side, Ear),
        (_, "ear_turn_deg" | "ear_fold_softness" | "ear_thickness_mm") => (from(0.0, 10.0), Ear),
        (_, "ear_set_width_mm" | "ear_set_height_mm" | "ear_lift_deg") => (Front, Head),
        ("Nose", _) => (Front, Nose),
        ("Eyes", _) => (Front, Eyes),
        ("Lips and jaw", _) => (Side, Face),
        ("Ears", _) => (Portrait, Head),
        _ => (Side, Head),
    }
}

/// What pictures are made with.
struct Studio {
    pipeline: Pipeline,
    fur: Fur,
    offscreen: Offscreen,
    size: [u32; 2],
    /// For all, instead of the one that shows a measure best.
    view: Option<View>,
}

impl Studio {
    /// One measure at both ends and in the middle of its range, under one camera.
    fn strip(&mut self, table: &ParamTable, breed: &Breed, row: usize) -> Result<(Strip, View), Failure> {
        let spec = &table.specs[row];
        let heads = [spec.min, (spec.min + spec.max) / 2.0, spec.max].map(|value| {
            let mut head = breed.clone();
            head.set_value(table, row, spec.to_si(value));
            (head, format!("{}{}", (value * 1e3).round() / 1e3, spec.unit.suffix()))
        });
        let (view, focus) = match self.view {
            Some(view) => (view, Focus::Head),
            None => aspect(spec),
        };
        // What is looked at closely moves in the picture; a whole head must not be cut off.
        let framed = if matches!(focus, Focus::Head) { &heads[..] } else { &heads[1..2] };
        let mut points = Vec::new();
        for (head, _) in framed {
            points.extend(focused(focus, &self.pipeline.update(head)));
        }
        let mut camera = Camera::at(view, None, Lens::default());
        camera.fit(points.iter(), self.size[0] as f32 / self.size[1] as f32, MARGIN);
        let drawing = Drawing {
            background: Background::Plain(PAPER),
            n_strands: self.fur.hair.unwrap_or(0),
            condition: self.fur.condition(),
            ..Drawing::new(camera)
        };
        let mut cells = Vec::new();
        for (head, caption) in heads {
            let frame = self.pipeline.update(&head);
            let picture = self.offscreen.draw(&frame, &drawing, self.size).map_err(Failure::work)?;
            cells.push((picture, caption));
        }
        Ok((Strip { title: spec.id.clone(), cells }, view))
    }
}

/// The points of a head that a picture is filled with, metres. All of them where the eyes are missing.
pub(super) fn focused(focus: Focus, frame: &Frame<'_>) -> Vec<Vec3> {
    let all = frame.parts.iter().flat_map(|part| part.positions.iter().copied());
    let middle = |name: &str| {
        let eye = frame.parts.iter().find(|part| part.topology.name == name && !part.positions.is_empty())?;
        Some(eye.positions.iter().sum::<Vec3>() / eye.positions.len() as f32)
    };
    let Some((left, right)) = middle("eye_L").zip(middle("eye_R")) else { return all.collect() };
    let (eyes, apart) = ((left + right) * 0.5, left.distance(right));
    let tip = all.clone().max_by(|a, b| a.z.total_cmp(&b.z)).unwrap_or(eyes);
    let is_in = |p: &Vec3| match focus {
        Focus::Head => true,
        Focus::Face => p.z > eyes.z - 0.2 * apart && p.distance(eyes) < 2.6 * apart,
        Focus::Eyes => p.distance(eyes) < 0.95 * apart,
        Focus::Muzzle => p.distance(tip) < apart,
        Focus::Ear => p.z < eyes.z - 0.3 * apart && p.x > -0.1 * apart && (p.y - eyes.y).abs() < 1.3 * apart,
        Focus::Nose => p.distance(tip) < 0.6 * apart,
    };
    all.filter(is_in).collect()
}

/// Root mean square over the colours of two pictures of one size, in steps of 255.
fn difference(a: &Picture, b: &Picture) -> f64 {
    let squares = a.rgba.iter().zip(&b.rgba).map(|(a, b)| f64::from(i32::from(*a) - i32::from(*b)).powi(2));
    (squares.sum::<f64>() / a.rgba.len().max(1) as f64).sqrt()
}
