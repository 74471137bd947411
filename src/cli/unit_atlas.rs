//! `londra atlas --units`: what every DogFACS unit does, at 0, half and 1, from the front and at three quarters.

use super::args::Atlas;
use super::atlas::{Focus, focused, slug};
use super::rigs::Rigs;
use super::{Failure, output, picture, values};
use crate::anatomy::{Breed, nearest};
use crate::frame::Pipeline;
use crate::measure::{Landmark, Side as LandmarkSide, skin_landmarks};
use crate::motion::{Activation, Group, Library, Pose, Side, Unit};
use crate::render::{Background, Camera, Drawing, Lens, Offscreen, PAPER, Section, Strip, View, arrow, atlas};
use crate::rig::Rig;
use glam::Vec3;
use serde_json::json;
use std::sync::Arc;

/// Steps of refinement.
const LEVEL: u32 = 3;
const CELL: [u32; 2] = [240, 240];
const MARGIN: f32 = 0.05;
const STRENGTHS: [f32; 3] = [0.0, 0.5, 1.0];
/// An arrow shorter than this, in parts of the picture's width, is drawn longer, up to so many times.
const READABLE: f32 = 0.1;
const MOST_TIMES: f32 = 4.0;
const ARROW: [u8; 3] = [0xc8, 0x1e, 0x1e];

/// Draws a file for each unit into a folder.
pub(super) fn run(args: &Atlas) -> Result<(), Failure> {
    let folder = &args.target.output;
    if output::is_stdout(folder) {
        return Err(Failure::Use("--units writes several files: name a folder, not -".into()));
    }
    let rigs = Rigs::open()?;
    let library = Library::embedded().map_err(Failure::work)?;
    let groups = groups(&args.group)?;
    let breed = rigs.breed(&args.breed)?;
    let rig = Arc::new(Rig::embedded(&rigs.table).map_err(Failure::work)?);
    let mut pipeline = Pipeline::new(rig.clone(), LEVEL).map_err(Failure::work)?;
    pipeline.set_layers(pipeline.layers().with_open_mouth()).map_err(Failure::work)?;
    pipeline.set_hair(args.fur.hair.unwrap_or(0) as usize);
    let drawing = Drawing {
        background: Background::Plain(PAPER),
        n_strands: args.fur.hair.unwrap_or(0),
        condition: args.fur.condition(),
        ..Drawing::new(Camera::at(View::Front, None, Lens::default()))
    };
    let size = args.size.unwrap_or(CELL);
    let mut studio = Studio { rig, breed, pipeline, offscreen: picture::offscreen()?, drawing, size };
    std::fs::create_dir_all(folder).map_err(|error| Failure::work(format!("{}: {error}", folder.display())))?;
    let mut files = Vec::new();
    let shown =
        library.units.units.iter().enumerate().filter(|(_, u)| !u.drives.is_empty() && groups.contains(&u.group));
    for (number, unit) in shown {
        let path = folder.join(format!("{}.png", unit.id));
        let page = studio.page(&library, number, unit)?;
        output::bytes(&path, &page.to_png().map_err(Failure::work)?)?;
        files.push(json!({ "unit": unit.id, "output": path.display().to_string() }));
    }
    if args.target.report.json {
        return output::json(&json!({ "breed": studio.breed.id, "level": LEVEL, "files": files }));
    }
    output::message(&format!("wrote {} pictures into {}", files.len(), folder.display()));
    Ok(())
}

/// All groups, or those that were asked for.
fn groups(wanted: &[String]) -> Result<Vec<Group>, Failure> {
    if wanted.is_empty() {
        return Ok(Group::ALL.to_vec());
    }
    let known = Group::ALL.map(|group| (slug(group.label()), group));
    let find = |word: &String| {
        let found = known.iter().find(|(name, _)| *name == slug(word)).map(|(_, group)| *group);
        found.ok_or_else(|| {
            let names = known.iter().map(|(name, _)| name.as_str());
            let near = values::did_you_mean(&nearest(word, names.clone().map(|name| (name, name))));
            let all = names.collect::<Vec<_>>().join(", ");
            Failure::Use(format!("unknown group '{word}'{near}; there are {all}"))
        })
    };
    wanted.iter().map(find).collect()
}

/// What pictures are made with.
struct Studio {
    rig: Arc<Rig>,
    breed: Breed,
    pipeline: Pipeline,
    offscreen: Offscreen,
    drawing: Drawing,
    size: [u32; 2],
}

impl Studio {
    fn page(&mut self, library: &Library, number: usize, unit: &Unit) -> Result<crate::render::Picture, Failure> {
        let poses = STRENGTHS.map(|strength| {
            let mut asked = Activation::default();
            asked.set(number, Side::Both, strength);
            library.pose_of(&asked)
        });
        let focus = match unit.group {
            Group::UpperFace | Group::LowerFace | Group::Tongue => Focus::Face,
            Group::Eyes => Focus::Eyes,
            Group::Ears | Group::Head | Group::Gross => Focus::Head,
        };
        let mut points = Vec::new();
        let mut landmarks = Vec::new();
        for pose in poses {
            self.pipeline.set_pose(pose);
            let frame = self.pipeline.update(&self.breed);
            points.extend(focused(focus, &frame));
            landmarks.push(skin_landmarks(&self.rig, &self.breed.values, &frame));
        }
        let mut strips = Vec::new();
        for view in [View::Front, View::ThreeQuarter] {
            let mut camera = Camera::at(view, None, Lens::default());
            camera.fit(points.iter(), self.size[0] as f32 / self.size[1] as f32, MARGIN);
            strips.push(self.strip(view, camera, unit, &poses, &landmarks)?);
        }
        let heading = format!("{} {}: {}", unit.label, unit.name, self.breed.label);
        Ok(atlas(&[Section { heading, strips }], 1))
    }

    fn strip(
        &mut self,
        view: View,
        camera: Camera,
        unit: &Unit,
        poses: &[Pose; 3],
        landmarks: &[Vec<Landmark>],
    ) -> Result<Strip, Failure> {
        let moved = |of: usize| moved(unit, &landmarks[0], &landmarks[of]);
        let pixel = |place: Vec3| camera.pixel(place, self.size);
        let longest = moved(2).iter().map(|(a, b)| pixel(*a).distance(pixel(*b))).fold(0.0, f32::max);
        let times = (READABLE * self.size[0] as f32 / longest.max(1e-3)).clamp(1.0, MOST_TIMES).round();
        let mut cells = Vec::new();
        for (of, pose) in poses.iter().enumerate() {
            self.pipeline.set_pose(*pose);
            let frame = self.pipeline.update(&self.breed);
            let drawing = Drawing { camera, ..self.drawing };
            let mut picture = self.offscreen.draw(&frame, &drawing, self.size).map_err(Failure::work)?;
            for (from, to) in moved(of) {
                let (from, to) = (camera.pixel(from, self.size), camera.pixel(to, self.size));
                if from.distance(to) > 0.3 {
                    arrow(&mut picture, from, from + times * (to - from), self.size[0] as f32 / 160.0, ARROW);
                }
            }
            cells.push((picture, format!("{}", STRENGTHS[of])));
        }
        let lengthened =
            if times > 1.0 && longest > 0.3 { format!(", arrows {times} times as long") } else { String::new() };
        Ok(Strip { title: format!("{}{lengthened}", view.name()), cells })
    }
}

/// Where the landmarks of a unit are at rest, and where they have gone.
fn moved(unit: &Unit, rest: &[Landmark], now: &[Landmark]) -> Vec<(Vec3, Vec3)> {
    let mut ids: Vec<&str> = unit.landmarks.iter().map(|motion| motion.0.as_str()).collect();
    ids.extend(unit.gaps.iter().flat_map(|gap| [gap.0.as_str(), gap.1.as_str()]));
    ids.sort_unstable();
    ids.dedup();
    let place = |all: &[Landmark], id: &str, side: LandmarkSide| {
        all.iter().find(|l| l.id == id && l.side == side).map(|l| l.position)
    };
    let sides = [LandmarkSide::Left, LandmarkSide::Right, LandmarkSide::Median];
    let pairs = ids.iter().flat_map(|id| sides.iter().map(move |side| (*id, *side)));
    pairs.filter_map(|(id, side)| Some((place(rest, id, side)?, place(now, id, side)?))).collect()
}
