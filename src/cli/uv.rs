//! `londra uv`: the layout of the skin's texture as a picture, to paint over.

use super::args::UvLayout;
use super::rigs::Rigs;
use super::{Failure, output};
use crate::render::Picture;
use crate::rig::{HEAD_UV, HalfUv, Rig};
use glam::Vec2;
use serde_json::json;

/// Fill of each chart in the order of the file, again from the first after the last.
const FILLS: [[u8; 3]; 6] =
    [[238, 224, 205], [222, 190, 190], [196, 210, 226], [214, 160, 160], [200, 220, 196], [214, 200, 226]];
const LINE: [u8; 3] = [60, 50, 45];

/// Draws every triangle of the control mesh where it lies in the texture.
pub(super) fn run(args: &UvLayout) -> Result<(), Failure> {
    output::check_target(&args.target.output, args.target.report.json)?;
    let rigs = Rigs::open()?;
    let rig = Rig::embedded(&rigs.table).map_err(Failure::work)?;
    let half = rig.half();
    let uv = HalfUv::parse(HEAD_UV, half).map_err(Failure::work)?;
    let (values, corners) = uv.corners(half);
    // Twice as large, then halved: lines without steps.
    let mut picture = Picture::filled(2 * args.size, 2 * args.size, [255; 4]);
    let scale = 2.0 * args.size as f32;
    let triangle = |f: usize| [0, 1, 2].map(|k| values[corners[3 * f + k] as usize] * scale);
    for (k, chart) in uv.charts.iter().enumerate() {
        for &f in &chart.faces {
            for f in [f as usize, f as usize + half.faces.len()] {
                fill(&mut picture, triangle(f), FILLS[k % FILLS.len()]);
            }
        }
    }
    for f in 0..corners.len() / 3 {
        let [a, b, c] = triangle(f);
        [(a, b), (b, c), (c, a)].into_iter().for_each(|(a, b)| line(&mut picture, a, b));
    }
    let bytes = picture.reduced(2).to_png().map_err(Failure::work)?;
    let facts = json!({
        "output": args.target.output.display().to_string(), "size": args.size, "charts": 2 * uv.charts.len() - 1,
    });
    output::file(&args.target.output, &bytes, args.target.report.json, facts)
}

fn put(picture: &mut Picture, x: usize, y: usize, [r, g, b]: [u8; 3]) {
    let width = picture.width as usize;
    if x < width && y < picture.height as usize {
        let at = 4 * (y * width + x);
        picture.rgba[at..at + 4].copy_from_slice(&[r, g, b, 255]);
    }
}

fn fill(picture: &mut Picture, [a, b, c]: [Vec2; 3], colour: [u8; 3]) {
    let (low, high) = (a.min(b).min(c), a.max(b).max(c));
    let turn = (b - a).perp_dot(c - a).signum();
    for y in low.y as usize..=high.y as usize {
        for x in low.x as usize..=high.x as usize {
            let p = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
            if [(a, b), (b, c), (c, a)].iter().all(|&(a, b)| turn * (b - a).perp_dot(p - a) >= 0.0) {
                put(picture, x, y, colour);
            }
        }
    }
}

fn line(picture: &mut Picture, a: Vec2, b: Vec2) {
    let n = (b - a).abs().max_element().ceil().max(1.0);
    for i in 0..=n as u32 {
        let p = a + (b - a) * (i as f32 / n);
        put(picture, p.x as usize, p.y as usize, LINE);
    }
}
