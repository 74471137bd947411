//! `londra turntable`: a head that turns once round, as numbered pictures.

use super::args::Turntable;
use super::motion::Director;
use super::picture::{MARGIN, drawing, offscreen, prepared};
use super::rigs::Rigs;
use super::{Failure, output, subject};
use crate::render::Camera;
use serde_json::json;
use std::f32::consts::TAU;
use std::path::PathBuf;

/// Where the frames go: a path with the place of the frame's number.
#[derive(Clone, Debug)]
pub(super) struct Pattern {
    before: String,
    digits: usize,
    after: String,
}

impl Pattern {
    /// From a path with one `%d`, or `%04d` for numbers of at least four digits.
    pub(super) fn parse(text: &str) -> Result<Self, String> {
        let wrong = || {
            format!(
                "{text} has no place, or several, for the frame's number: write one %d or %04d, as in turn_%04d.png"
            )
        };
        let (before, rest) = text.split_once('%').ok_or_else(wrong)?;
        let (width, after) = rest.split_once('d').ok_or_else(wrong)?;
        if !width.bytes().all(|b| b.is_ascii_digit()) || width.len() > 2 || after.contains('%') {
            return Err(wrong());
        }
        let digits = if width.is_empty() { 1 } else { width.parse().map_err(|_| wrong())? };
        Ok(Self { before: before.to_owned(), digits, after: after.to_owned() })
    }

    /// The name of a frame's file.
    pub(super) fn path(&self, frame: u32) -> PathBuf {
        let Self { before, digits, after } = self;
        PathBuf::from(format!("{before}{frame:0digits$}{after}"))
    }
}

/// Draws every frame; the camera goes round the standing head, and the light with it, so that the head turns under it.
pub(super) fn run(args: &Turntable) -> Result<(), Failure> {
    let rigs = Rigs::open()?;
    let breed = subject::breed(&rigs, &args.subject.breed, &args.subject.changes)?;
    let mut pipeline = subject::pipeline(&rigs, &args.detail)?;
    prepared(&mut pipeline, &args.scene, &args.motion)?;
    let director = Director::new(&args.motion, args.scene.lids_closed)?;
    director.tell_overruled();
    pipeline.set_pose(director.pose(&rigs, &breed));
    let mut offscreen = offscreen()?;
    let frame = pipeline.update(&breed);
    let [width, height] = args.size;
    let mut camera = Camera::at(args.view, args.scene.pitch, args.scene.lens);
    camera.fit_round(frame.outline().iter(), width as f32 / height as f32, MARGIN);
    let start = camera.azimuth;
    for k in 0..args.frames {
        camera.azimuth = start + TAU * k as f32 / args.frames as f32;
        let picture = offscreen.draw(&frame, &drawing(&args.scene, camera), args.size).map_err(Failure::work)?;
        output::bytes(&args.output.path(k), &picture.to_png().map_err(Failure::work)?)?;
    }
    let (first, last) = (args.output.path(0), args.output.path(args.frames - 1));
    if args.report.json {
        return output::json(&json!({
            "first": first.display().to_string(), "last": last.display().to_string(), "frames": args.frames,
            "width": width, "height": height, "breed": breed.id, "label": breed.label, "level": args.detail.level,
        }));
    }
    output::message(&format!("wrote {} to {}", first.display(), last.display()));
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frames_have_other_names_than_those_asked_for() {
        let name = |text: &str, frame| Pattern::parse(text).unwrap().path(frame).display().to_string();
        assert_eq!(name("a/turn_%04d.png", 7), "a/turn_0007.png");
        assert_eq!(name("%d.png", 12), "12.png");
        for wrong in ["turn.png", "%x.png", "%04d_%d.png", "%-3d.png", "%1234d.png", "%"] {
            assert!(Pattern::parse(wrong).is_err(), "{wrong}");
        }
    }
}
