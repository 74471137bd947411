//! `londra render` and `londra sheet`.

use super::args::{Motion, Render, Scene, Sheet as SheetArgs, Wires};
use super::motion::Director;
use super::rigs::Rigs;
use super::{Failure, film, output, subject};
use crate::anatomy::Breed;
use crate::frame::{Frame, Layers, Pipeline};
use crate::measure::{Landmark, Side, skin_landmarks};
use crate::motion::Pose;
use crate::render::{Background, Camera, Drawing, Dress, Gpu, Lens, Offscreen, Picture, Shading, Sheet, View};
use glam::Vec3;
use serde_json::json;

/// The side of a cell when nobody says how large the sheet shall be, pixels.
const CELL: u32 = 320;
/// Strands of hair of one head, and of each on a sheet, when nobody says how many.
const HAIR: u32 = 90_000;
const SHEET_HAIR: u32 = 10_000;
/// Part of the picture left free around a head.
pub(super) const MARGIN: f32 = 0.08;

/// Draws one head.
pub(super) fn render(args: &Render) -> Result<(), Failure> {
    if film::is_asked_for(args) {
        return film::run(args);
    }
    output::check_target(&args.target.output, args.target.report.json)?;
    let rigs = Rigs::open()?;
    let breed = subject::breed(&rigs, &args.subject.breed, &args.subject.changes)?;
    let director = Director::new(&args.motion, args.scene.lids_closed)?;
    let mut pipeline = subject::pipeline(&rigs, &args.detail)?;
    prepared(&mut pipeline, &args.scene, &args.motion)?;
    director.tell_overruled();
    pipeline.set_pose(director.pose(&rigs, &breed));
    let mut offscreen = offscreen()?;
    let rig = pipeline.rig().clone();
    let frame = pipeline.update(&breed);

    let mut camera = camera(&frame, args.view, args.scene.pitch, args.scene.lens, args.size);
    if let Some(id) = &args.at {
        camera.look_at(landmark(&skin_landmarks(&rig, &breed.values, &frame), id)?);
    }
    camera.zoom(args.zoom);
    let picture = offscreen.draw(&frame, &drawing(&args.scene, camera), args.size).map_err(Failure::work)?;
    let facts = json!({
        "output": args.target.output.display().to_string(), "width": picture.width, "height": picture.height,
        "breed": breed.id, "label": breed.label, "level": args.detail.level, "triangles": frame.n_triangles(),
        "strands": frame.coat.map_or(0, |_| hair(&args.scene, HAIR)),
    });
    write(args.target.output.as_path(), args.target.report.json, &picture, facts)
}

/// Gives the frames of one head what the scene shows of it.
pub(super) fn prepared(pipeline: &mut Pipeline, scene: &Scene, motion: &Motion) -> Result<(), Failure> {
    pipeline.set_layers(layers(scene, motion)).map_err(Failure::work)?;
    pipeline.set_hair(hair(scene, HAIR) as usize);
    Ok(())
}

/// How one head is drawn in the scene.
pub(super) fn drawing(scene: &Scene, camera: Camera) -> Drawing {
    Drawing {
        background: background(scene),
        preset: scene.preset,
        samples: scene.samples.unwrap_or_default(),
        skin_opacity: layers(scene, &Motion::default()).skin,
        shading: shading(scene),
        n_strands: hair(scene, HAIR),
        condition: scene.fur.condition(),
        ..Drawing::new(camera)
    }
}

/// The camera of a picture of one head, which it fills but for a margin.
pub(super) fn camera(
    frame: &Frame<'_>,
    view: View,
    pitch: Option<f32>,
    lens: Lens,
    [width, height]: [u32; 2],
) -> Camera {
    let mut camera = Camera::at(view, pitch, lens);
    camera.fit(frame.outline().iter(), width as f32 / height as f32, MARGIN);
    camera
}

/// Draws many heads in many views.
pub(super) fn sheet(args: &SheetArgs) -> Result<(), Failure> {
    output::check_target(&args.target.output, args.target.report.json)?;
    let rigs = Rigs::open()?;
    let breeds: Vec<Breed> =
        words(args, &rigs).iter().map(|word| subject::breed(&rigs, word, &args.changes)).collect::<Result<_, _>>()?;
    let mut pipeline = subject::pipeline(&rigs, &args.detail)?;
    let presets = if args.presets.is_empty() { vec![args.scene.preset] } else { args.presets.clone() };
    let director = Director::new(&args.motion, args.scene.lids_closed)?;
    director.tell_overruled();
    let poses: Vec<Pose> = breeds.iter().map(|breed| director.pose(&rigs, breed)).collect();
    let mut offscreen = offscreen()?;

    let cell = match args.size {
        Some(size) => {
            let across = args.columns as usize;
            let columns = args.views.len() * args.dress.len().max(1) * across;
            Sheet::cell_within(size, (breeds.len() * presets.len()).div_ceil(across), columns)
        }
        None => [CELL, CELL],
    };
    let Scene { pitch, lens, .. } = args.scene;
    let mut sheet = Sheet::new(args.views.clone(), cell, args.fit, lens, pitch, background(&args.scene));
    sheet.samples = args.scene.samples.unwrap_or_default();
    sheet.shading = shading(&args.scene);
    sheet.heads_across = args.columns;
    sheet.dresses.clone_from(&args.dress);
    // Room is left for hair where some is drawn.
    let wears_coat = args.dress.is_empty() || args.dress.contains(&Dress::Coat);
    let strands = |scene: &Scene| if wears_coat { hair(scene, SHEET_HAIR) } else { 0 };
    let most = presets.iter().map(|&preset| strands(&Scene { preset, ..args.scene })).max();
    pipeline.set_hair(most.unwrap_or(0) as usize);
    for (breed, pose) in breeds.iter().zip(&poses) {
        pipeline.set_pose(*pose);
        sheet.measure(&pipeline.update(breed));
    }
    for preset in presets {
        let scene = Scene { preset, ..args.scene };
        let layers = layers(&scene, &args.motion);
        pipeline.set_layers(layers).map_err(Failure::work)?;
        let n_strands = strands(&scene);
        pipeline.set_hair(n_strands as usize);
        (sheet.preset, sheet.background) = (preset, background(&scene));
        (sheet.skin_opacity, sheet.n_strands) = (layers.skin, n_strands);
        sheet.condition = scene.fur.condition();
        for (breed, pose) in breeds.iter().zip(&poses) {
            pipeline.set_pose(*pose);
            let name = match args.presets.is_empty() {
                true => breed.label.clone(),
                false => format!("{}, {}", breed.label, preset.name()),
            };
            sheet.add_row(&mut offscreen, &pipeline.update(breed), &name).map_err(Failure::work)?;
        }
    }
    let mut picture = sheet.finish();
    if let Some(size) = args.size {
        picture = on_paper(&picture, size);
    }
    let facts = json!({
        "output": args.target.output.display().to_string(), "width": picture.width, "height": picture.height,
        "breeds": breeds.iter().map(|b| b.id.as_str()).collect::<Vec<_>>(),
        "views": args.views.iter().map(|v| v.name()).collect::<Vec<_>>(), "level": args.detail.level,
    });
    write(args.target.output.as_path(), args.target.report.json, &picture, facts)
}

/// The breeds asked for: `--breed` stands for itself, beside `--breeds` unless that is `all`.
fn words(args: &SheetArgs, rigs: &Rigs) -> Vec<String> {
    let mut words = Vec::new();
    for word in &args.breeds {
        if word != "all" {
            words.push(word.clone());
        } else if args.breed.is_empty() {
            words.extend(rigs.ids());
        }
    }
    words.extend(args.breed.iter().cloned());
    words
}

/// The sheet in the middle of a picture of exactly the size asked for, on its own paper.
fn on_paper(sheet: &Picture, [width, height]: [u32; 2]) -> Picture {
    let paper = sheet.rgba.first_chunk::<4>().copied().unwrap_or([255; 4]);
    let mut picture = Picture::filled(width, height, paper);
    picture.paste(sheet, width.saturating_sub(sheet.width) / 2, height.saturating_sub(sheet.height) / 2);
    picture
}

fn background(scene: &Scene) -> Background {
    scene.background.map_or_else(|| scene.preset.background(), |ground| ground.of(scene.preset))
}

/// Those that were asked for, or those of the preset; a mouth that may open has something in it.
fn layers(scene: &Scene, motion: &Motion) -> Layers {
    let usual = scene.preset.layers();
    let usual = if motion.is_asked_for() { usual.with_open_mouth() } else { usual };
    scene.layers.unwrap_or(usual)
}

/// The place of a landmark by its id, with L or R behind it where a side is meant; else of two the left one.
fn landmark(all: &[Landmark], word: &str) -> Result<Vec3, Failure> {
    let side = match word.chars().last() {
        Some('R') => Side::Right,
        _ => Side::Left,
    };
    let id = word.trim_end_matches(['L', 'R']);
    let found = all.iter().find(|l| l.id == id && [side, Side::Median].contains(&l.side));
    found.map(|l| l.position).ok_or_else(|| {
        Failure::Use(format!(
            "there is no landmark '{word}' on the skin; 'londra landmarks' names them, such as K29 or K29R"
        ))
    })
}

/// How many strands of hair a picture of one head has.
pub(super) fn hair_of(scene: &Scene) -> u32 {
    hair(scene, HAIR)
}

/// How many strands are drawn: those asked for, or so many where no lines lie over the surfaces and the preset has hair.
fn hair(scene: &Scene, otherwise: u32) -> u32 {
    scene.fur.hair.unwrap_or(if scene.wireframe.is_some() || !scene.preset.has_hair() { 0 } else { otherwise })
}

fn shading(scene: &Scene) -> Shading {
    match scene.wireframe {
        None => Shading::Shaded,
        Some(Wires::Control) => Shading::Control,
        Some(Wires::Refined) => Shading::Wireframe,
    }
}

pub(super) fn offscreen() -> Result<Offscreen, Failure> {
    let gpu = Gpu::open().map_err(|error| {
        Failure::NoDevice(format!(
            "{error}; the commands export, hash, list and check work without one, and subdivide for everything but pictures"
        ))
    })?;
    Offscreen::new(gpu).map_err(Failure::work)
}

fn write(output: &std::path::Path, json: bool, picture: &Picture, facts: serde_json::Value) -> Result<(), Failure> {
    output::file(output, &picture.to_png().map_err(Failure::work)?, json, facts)
}
