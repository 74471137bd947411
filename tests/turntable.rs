//! A head that turns does not flicker: what is drawn of a place of its skin changes as slowly as light and hair on it do.
#![cfg(feature = "graphics")]

#[path = "support/pictures.rs"]
mod pictures;

use glam::{Vec2, Vec3};
use londra::frame::Frame;
use londra::render::{Background, Camera, Drawing, Lens, Picture, View};
use pictures::{Heads, offscreen};

const SIDE: u32 = 128;
const FRAMES: usize = 5;
const STEP: f32 = 1.0 / 180.0 * std::f32::consts::PI;

/// How much places may jump and jump back in the mean, levels of luminance, and which part of them by more than eight.
const MEAN: f32 = 1.3;
const OF_EIGHT: f32 = 0.02;
/// The same by more than sixteen: the white of the eye between dark lids is less than a pixel wide here.
const OF_SIXTEEN: f32 = 0.003;

/// Luminance between pixels' middles, 0 to 255.
fn luminance(picture: &Picture, place: Vec2) -> f32 {
    let p = place - 0.5;
    let (low, f) = (p.floor(), p - p.floor());
    let at = |dx: f32, dy: f32| {
        let [x, y] = [low.x + dx, low.y + dy].map(|c| c.clamp(0.0, (SIDE - 1) as f32) as usize);
        let [r, g, b, _] = picture.rgba.as_chunks::<4>().0[y * SIDE as usize + x].map(f32::from);
        0.2126 * r + 0.7152 * g + 0.0722 * b
    };
    let row = |dy: f32| at(0.0, dy) * (1.0 - f.x) + at(1.0, dy) * f.x;
    row(0.0) * (1.0 - f.y) + row(1.0) * f.y
}

/// Whether everything near a place is the head.
fn is_inside(picture: &Picture, place: Vec2) -> bool {
    let near = |d: i32, c: f32| (c as i32 + d).clamp(0, SIDE as i32 - 1) as u32;
    let around = (-2..=2).flat_map(|dy| (-2..=2).map(move |dx| (dx, dy)));
    let mut around = around.map(|(dx, dy)| near(dy, place.y) * SIDE + near(dx, place.x));
    around.all(|i| picture.rgba[4 * i as usize + 3] == 255)
}

fn camera(frame: &Frame<'_>, k: usize) -> Camera {
    let mut camera = Camera::at(View::Portrait, None, Lens::default());
    camera.fit_round(frame.outline().iter(), 1.0, 0.05);
    camera.azimuth += k as f32 * STEP;
    camera
}

/// Places of the skin that face the camera in every frame and that nothing hides.
fn seen(frame: &Frame<'_>) -> Vec<(Vec3, Vec<Vec2>)> {
    let skin = &frame.parts[0];
    let cameras: Vec<Camera> = (0..FRAMES).map(|k| camera(frame, k)).collect();
    let mut out = Vec::new();
    for (&p, n) in skin.positions.iter().zip(skin.normals).step_by(3) {
        let faces = |c: &Camera| n.dot((c.eye_in_head().0 - p).normalize()) > 0.45;
        if !cameras.iter().all(faces) {
            continue;
        }
        let to_pixels = |c: &Camera| {
            let clip = c.clip_from_head(1.0, 0.6).project_point3(p);
            Vec2::new(0.5 + 0.5 * clip.x, 0.5 - 0.5 * clip.y) * SIDE as f32
        };
        out.push((p, cameras.iter().map(to_pixels).collect::<Vec<_>>()));
    }
    // Of what falls on one pixel the nearest, and nothing that lies far behind its neighbours.
    let eye = cameras[FRAMES / 2].eye_in_head().0;
    let cells = SIDE as usize / 4;
    let mut nearest = vec![f32::INFINITY; cells * cells];
    let cell = |at: &Vec<Vec2>| {
        let [x, y] = (at[FRAMES / 2] / 4.0).to_array().map(|c| c.clamp(0.0, (cells - 1) as f32) as usize);
        y * cells + x
    };
    for (p, at) in &out {
        let to = &mut nearest[cell(at)];
        *to = to.min(p.distance(eye));
    }
    out.retain(|(p, at)| p.distance(eye) < nearest[cell(at)] + 0.012);
    out
}

/// How strongly places of a turning head jump and jump back within three frames, ascending, in levels of luminance. Every
/// second frame has `n_strands[1]`.
fn jumps(heads: &mut Heads, breed: &str, n_strands: [u32; 2]) -> Vec<f32> {
    let mut offscreen = offscreen();
    let dog = heads.breed(breed);
    heads.pipeline.set_hair(n_strands[0] as usize);
    let frame = heads.pipeline.update(&dog);
    let pictures: Vec<Picture> = (0..FRAMES)
        .map(|k| {
            let drawing = Drawing {
                n_strands: n_strands[k % 2],
                background: Background::None,
                ..Drawing::new(camera(&frame, k))
            };
            offscreen.draw(&frame, &drawing, [SIDE; 2]).unwrap()
        })
        .collect();
    let mut places = seen(&frame);
    // At the outline one would see the ground come and go.
    places.retain(|(_, at)| pictures.iter().zip(at).all(|(picture, &p)| is_inside(picture, p)));
    assert!(places.len() > 1000, "{breed}: {} places", places.len());
    let mut jumps = Vec::new();
    for (_, at) in &places {
        let l: Vec<f32> = pictures.iter().zip(at).map(|(picture, &p)| luminance(picture, p)).collect();
        for w in l.windows(3) {
            let (up, down) = (w[1] - w[0], w[2] - w[1]);
            jumps.push(if up * down < 0.0 { up.abs().min(down.abs()) } else { 0.0 });
        }
    }
    jumps.sort_by(f32::total_cmp);
    jumps
}

fn mean(jumps: &[f32]) -> f32 {
    jumps.iter().sum::<f32>() / jumps.len() as f32
}

/// The part that is larger.
fn above(jumps: &[f32], least: f32) -> f32 {
    jumps.iter().filter(|&&j| j > least).count() as f32 / jumps.len() as f32
}

#[test]
fn a_turning_head_flickers() {
    let mut heads = Heads::new(3);
    for breed in ["labrador", "german_shepherd", "poodle"] {
        // Streaks of the surface, and strands.
        for n_strands in [0, 10_000, 90_000] {
            let jumps = jumps(&mut heads, breed, [n_strands; 2]);
            let (mean, of_eight, of_sixteen) = (mean(&jumps), above(&jumps, 8.0), above(&jumps, 16.0));
            let what = format!("{breed}, {n_strands} strands: {mean}, {of_eight} by 8, {of_sixteen} by 16");
            assert!(mean < MEAN && of_eight < OF_EIGHT && of_sixteen < OF_SIXTEEN, "{what}");
        }
    }
}

#[test]
fn hair_that_comes_and_goes_is_not_seen_as_flicker() {
    let jumps = jumps(&mut Heads::new(3), "german_shepherd", [90_000, 30_000]);
    assert!(mean(&jumps) > MEAN && above(&jumps, 8.0) > OF_EIGHT, "{}, {} by 8", mean(&jumps), above(&jumps, 8.0));
}

#[test]
fn the_ground_of_a_turning_head_steps_or_changes() {
    let mut heads = Heads::new(2);
    let mut offscreen = offscreen();
    let dog = heads.breed("pug");
    let frame = heads.pipeline.update(&dog);
    let [first, last] = [0, 180].map(|k| {
        let drawing = Drawing::new(camera(&frame, k));
        offscreen.draw(&frame, &drawing, [SIDE; 2]).unwrap()
    });
    let edge = |picture: &Picture| -> Vec<[u8; 4]> {
        (0..SIDE as usize / 2).map(|y| picture.rgba.as_chunks::<4>().0[y * SIDE as usize]).collect()
    };
    let (first, last) = (edge(&first), edge(&last));
    assert_eq!(first, last);
    let steps = first.windows(2).map(|w| (0..3).map(|k| w[0][k].abs_diff(w[1][k])).max().unwrap());
    assert!(steps.max() == Some(1), "a band of more than one level");
}
