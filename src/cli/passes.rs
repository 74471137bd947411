//! `londra bench --passes`: what each pass of a picture costs.
//!
//! A picture is drawn up to each of its stages in turn and waited for; a stage costs what it adds to the one before. Stamps
//! that the device writes between two draws would tell less: drivers that work tile by tile, those on a processor among
//! them, take all draws of a pass together.

use super::args::Bench;
use super::rigs::Rigs;
use super::{Failure, output, picture};
use crate::coat;
use crate::frame::Pipeline;
use crate::render::{Drawing, Gpu, Lens, Offscreen, Quality, Samples, Stage, View};
use crate::rig::Rig;
use serde_json::json;
use std::sync::Arc;
use std::time::Instant;

/// Rounds of which the median is taken.
const ROUNDS: usize = 7;

/// Times every stage for every level of hair and prints a table.
pub(super) fn run(args: &Bench) -> Result<(), Failure> {
    let rigs = Rigs::open()?;
    let breed = rigs.breed(&args.breed)?;
    let gpu = Gpu::open().map_err(|e| Failure::NoDevice(e.to_string()))?;
    let (adapter, quality) = (gpu.name(), if args.draft { Quality::Draft } else { Quality::Full });
    let most = gpu.device.limits().max_texture_dimension_2d;
    if args.size.into_iter().any(|side| side > most) {
        return Err(Failure::Use(format!("each side of the picture must be at most {most} pixels here")));
    }
    let mut offscreen = Offscreen::with_quality(gpu, quality).map_err(Failure::work)?;
    let rig = Arc::new(Rig::embedded(&rigs.table).map_err(Failure::work)?);
    let mut pipeline = Pipeline::new(rig, args.level.min(crate::frame::MAX_LEVEL)).map_err(Failure::work)?;
    let mut rows = Vec::new();
    let mut n_triangles = 0;
    for (name, n_strands) in coat::LEVELS {
        pipeline.set_hair(n_strands);
        offscreen.forget();
        let frame = pipeline.update(&breed);
        n_triangles = frame.n_triangles();
        let camera = picture::camera(&frame, View::Portrait, None, Lens::default(), args.size);
        let drawing = Drawing { n_strands: n_strands as u32, samples: Samples::FEWEST, ..Drawing::new(camera) };
        let mut times: [Vec<f64>; Stage::ALL.len()] = Default::default();
        // The first round uploads and compiles.
        for round in 0..=ROUNDS {
            for (stage, list) in Stage::ALL.into_iter().zip(&mut times) {
                let begin = Instant::now();
                offscreen.run(stage, &frame, &drawing, args.size).map_err(Failure::work)?;
                let ms = begin.elapsed().as_secs_f64() * 1e3;
                if round > 0 {
                    list.push(ms);
                }
            }
        }
        let up_to = times.map(|mut list| {
            list.sort_by(f64::total_cmp);
            list[list.len() / 2]
        });
        let own: Vec<f64> =
            (0..up_to.len()).map(|k| (up_to[k] - if k > 0 { up_to[k - 1] } else { 0.0 }).max(0.0)).collect();
        rows.push((name, own, up_to[up_to.len() - 1]));
    }
    let [width, height] = args.size;
    if args.json {
        let rows: Vec<_> = rows
            .iter()
            .map(|(name, own, all)| {
                let stages: serde_json::Map<String, serde_json::Value> =
                    Stage::ALL.iter().zip(own).map(|(stage, ms)| (stage.name().to_owned(), json!(ms))).collect();
                json!({ "hair": name, "ms": stages, "picture_ms": all })
            })
            .collect();
        return output::json(&json!({
            "adapter": adapter, "width": width, "height": height, "triangles": n_triangles, "level": args.level,
            "draft": args.draft, "levels": rows,
        }));
    }
    let mut text = format!("{adapter}, {width} x {height} pixels, level {}, {n_triangles} triangles\n", args.level);
    text += "milliseconds, medians; each stage by what it adds\n";
    text += &format!("{:<8}", "hair");
    Stage::ALL.iter().for_each(|stage| text += &format!("{:>18}", stage.name()));
    text += &format!("{:>18}", "picture");
    for (name, own, all) in rows {
        text += &format!("\n{name:<8}");
        own.iter().chain([&all]).for_each(|ms| text += &format!("{ms:>18.1}"));
    }
    output::result(&text)
}
