//! `londra landmarks`.

use super::args::{Landmarks as Args, Lids};
use super::motion::Director;
use super::rigs::Rigs;
use super::{Failure, output, picture, subject};
use crate::frame::Frame;
use crate::measure::{Eyepoint, Landmark, Sight, bone_landmarks, skin_landmarks};
use crate::render::Camera;
use crate::rig::bone::Bones;
use crate::rig::whiskers::Whisker;
use serde_json::{Value, json};

/// Prints every landmark: its place, and in a view its pixel and whether it is seen.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let rigs = Rigs::open()?;
    let breed = subject::breed(&rigs, &args.subject.breed, &args.subject.changes)?;
    let mut pipeline = subject::pipeline(&rigs, &args.detail)?;
    let rig = pipeline.rig().clone();
    let director = Director::new(&args.motion, Lids::default())?;
    director.tell_overruled();
    pipeline.set_pose(director.pose(&rigs, &breed));
    if args.motion.is_asked_for() {
        // As a picture of it has.
        pipeline.set_layers(pipeline.layers().with_open_mouth()).map_err(Failure::work)?;
    }
    pipeline.update(&breed);
    let (places, frame) = (pipeline.places(), pipeline.frame());
    if args.whiskers {
        return whiskers(frame.whiskers, args.report.json);
    }
    let bones = Bones::embedded().map_err(Failure::work)?;
    let mut landmarks = skin_landmarks(&rig, &breed.values, &frame);
    landmarks.extend(bone_landmarks(&rig, &bones, &breed.values, &places));
    let seen: Vec<Option<Seen>> = match args.view {
        Some(view) => {
            let camera = picture::camera(&frame, view, args.pitch, args.lens.unwrap_or_default(), args.size);
            let look = Look::new(&frame, camera, args.size);
            landmarks.iter().map(|l| Some(look.at(l))).collect()
        }
        None => vec![None; landmarks.len()],
    };
    let rows = landmarks.iter().zip(&seen);
    if args.report.json {
        return output::json(&rows.map(|(landmark, seen)| as_json(landmark, seen.as_ref())).collect());
    }
    output::result(&rows.map(|(landmark, seen)| line(landmark, seen.as_ref())).collect::<Vec<_>>().join("\n"))
}

/// Prints every whisker: group, row and place in it from 1, side, place of the follicle, direction, length.
fn whiskers(whiskers: &[Whisker], json: bool) -> Result<(), Failure> {
    let side = |w: &Whisker| if w.is_left { "L" } else { "R" };
    if json {
        let row = |w: &Whisker| {
            json!({
                "group": w.group.name(), "row": w.row, "place": w.place, "side": side(w),
                "position_mm": w.position.to_array().map(|metres| rounded(metres * 1000.0, 1e4)),
                "direction": w.direction.to_array().map(|part| rounded(part, 1e6)),
                "length_mm": rounded(w.length * 1000.0, 1e2),
            })
        };
        return output::json(&whiskers.iter().map(row).collect());
    }
    let row = |w: &Whisker| {
        let [x, y, z] = w.position.to_array().map(|metres| rounded(metres * 1000.0, 1e2));
        let [u, v, n] = w.direction.to_array().map(|part| rounded(part, 1e3));
        let length = rounded(w.length * 1000.0, 1e1);
        let name = format!("{:12} {}.{}  {}", w.group.name(), w.row, w.place, side(w));
        format!("{name}  {x:8.2} {y:8.2} {z:8.2} mm  towards {u:6.3} {v:6.3} {n:6.3}  {length:5.1} mm long")
    };
    output::result(&whiskers.iter().map(row).collect::<Vec<_>>().join("\n"))
}

/// Where a landmark is in the picture.
#[derive(Clone, Debug)]
struct Seen {
    /// From the top left corner of the picture, rightwards and downwards, pixels; may lie outside it.
    pixel: [f32; 2],
    visible: bool,
}

/// A head before a camera.
struct Look {
    sight: Sight,
    eye: Eyepoint,
    camera: Camera,
    size: [u32; 2],
}

impl Look {
    fn new(frame: &Frame<'_>, camera: Camera, size: [u32; 2]) -> Self {
        let (eye, is_point) = camera.eye_in_head();
        let eye = if is_point > 0.0 { Eyepoint::At(eye) } else { Eyepoint::Towards(eye) };
        Self { sight: Sight::new(frame), eye, camera, size }
    }

    fn at(&self, landmark: &Landmark) -> Seen {
        let [width, height] = self.size;
        let pixel = self.camera.pixel(landmark.position, self.size).to_array();
        let is_inside = (0.0..width as f32).contains(&pixel[0]) && (0.0..height as f32).contains(&pixel[1]);
        Seen { pixel, visible: is_inside && self.sight.is_open(landmark.position, self.eye) }
    }
}

fn as_json(landmark: &Landmark, seen: Option<&Seen>) -> Value {
    let mut object = json!({
        "id": landmark.id, "name": landmark.name, "side": landmark.side.letter().to_string(), "layer": landmark.layer,
        "position_mm": landmark.position.to_array().map(|metres| rounded(metres * 1000.0, 1e4)),
    });
    if let Some(seen) = seen {
        object["pixel"] = json!(seen.pixel.map(|pixel| rounded(pixel, 1e2)));
        object["visible"] = json!(seen.visible);
    }
    object
}

fn line(landmark: &Landmark, seen: Option<&Seen>) -> String {
    let [x, y, z] = landmark.position.to_array().map(|metres| rounded(metres * 1000.0, 1e2));
    let Landmark { id, name, side, layer, .. } = landmark;
    let place = format!("{id}  {}  {layer}  {x:8.2} {y:8.2} {z:8.2} mm", side.letter());
    match seen {
        Some(Seen { pixel: [x, y], visible }) => {
            let is_seen = if *visible { "visible" } else { "hidden " };
            format!("{place}  {x:7.1} {y:7.1} px  {is_seen}  {name}")
        }
        None => format!("{place}  {name}"),
    }
}

/// Without the digits that only rounding has made, and without the sign of a zero.
fn rounded(value: f32, per_unit: f64) -> f64 {
    (f64::from(value) * per_unit).round() / per_unit + 0.0
}
