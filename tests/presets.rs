//! Each way of showing a head gives the picture that it promises, on the software Vulkan driver.
#![cfg(feature = "graphics")]

#[path = "support/pictures.rs"]
mod pictures;
#[path = "support/stand_in.rs"]
mod stand_in;

use londra::anatomy::Breed;
use londra::frame::Layers;
use londra::render::{
    Background, Camera, DrawError, Drawing, Dress, Gpu, Lens, Offscreen, Picture, Preset, Samples, Sheet, View,
};
use pictures::{Heads, offscreen};

const SIDE: u32 = 120;

/// As the command line draws it: with the preset's own ground, layers and hair.
fn drawn(
    heads: &mut Heads,
    offscreen: &mut Offscreen,
    breed: &Breed,
    preset: Preset,
    change: impl Fn(&mut Drawing),
) -> Picture {
    let layers = preset.layers();
    heads.pipeline.set_layers(layers).unwrap();
    let n_strands = if preset.has_hair() { 4000 } else { 0 };
    heads.pipeline.set_hair(n_strands as usize);
    let frame = heads.pipeline.update(breed);
    let mut camera = Camera::at(View::Portrait, None, Lens::default());
    camera.fit(frame.parts.iter().flat_map(|p| p.positions), 1.0, 0.1);
    let mut drawing = Drawing {
        preset,
        background: preset.background(),
        skin_opacity: layers.skin,
        n_strands,
        ..Drawing::new(camera)
    };
    change(&mut drawing);
    offscreen.draw(&frame, &drawing, [SIDE; 2]).unwrap()
}

fn pixels(picture: &Picture) -> impl Iterator<Item = [u8; 4]> + '_ {
    picture.rgba.as_chunks::<4>().0.iter().copied()
}

/// The part of the pixels for which it holds.
fn part(picture: &Picture, holds: impl Fn([u8; 4]) -> bool) -> f64 {
    pixels(picture).filter(|&p| holds(p)).count() as f64 / pixels(picture).count() as f64
}

/// Mean of red, green and blue, 0 to 255, over the pixels of the head.
fn brightness(picture: &Picture) -> f64 {
    let of_head: Vec<f64> = pixels(picture)
        .filter(|p| p[3] == 255)
        .map(|p| p[..3].iter().map(|&c| f64::from(c)).sum::<f64>() / 3.0)
        .collect();
    of_head.iter().sum::<f64>() / of_head.len() as f64
}

fn nothing(drawing: &mut Drawing) {
    drawing.background = Background::None;
}

#[test]
fn a_silhouette_has_more_than_two_colours() {
    let (mut heads, mut offscreen) = (Heads::new(2), offscreen());
    let breed = heads.breed("borzoi");
    let picture = drawn(&mut heads, &mut offscreen, &breed, Preset::Silhouette, |_| ());
    assert!(pixels(&picture).all(|[r, g, b, a]| r == g && g == b && a == 255), "a colour");
    let (black, white) = (part(&picture, |p| p[0] == 0), part(&picture, |p| p[0] == 255));
    assert!(black > 0.2 && white > 0.2, "{black} black, {white} white");
    assert!(black + white > 0.95, "{} are neither: more than the soft edge", 1.0 - black - white);
}

#[test]
fn a_silhouette_is_not_where_the_head_is() {
    let (mut heads, mut offscreen) = (Heads::new(2), offscreen());
    let breed = heads.breed("pug");
    let ink = drawn(&mut heads, &mut offscreen, &breed, Preset::Silhouette, nothing);
    let clay = drawn(&mut heads, &mut offscreen, &breed, Preset::Clay, nothing);
    assert!(pixels(&ink).zip(pixels(&clay)).all(|(a, b)| a[3] == b[3]), "the outlines differ");
}

#[test]
fn a_head_before_nothing_stands_before_something() {
    let (mut heads, mut offscreen) = (Heads::new(2), offscreen());
    let breed = heads.breed("beagle");
    for preset in Preset::ALL {
        let picture = drawn(&mut heads, &mut offscreen, &breed, preset, nothing);
        let corner = pixels(&picture).next().unwrap();
        assert_eq!(corner, [0; 4], "{}", preset.name());
        assert!(part(&picture, |p| p[3] > 200) > 0.1, "{}: no head", preset.name());
    }
}

#[test]
fn a_plain_ground_has_two_colours_and_a_graded_one_has_one() {
    let (mut heads, mut offscreen) = (Heads::new(2), offscreen());
    let breed = heads.breed("beagle");
    let edge = |picture: &Picture| {
        let at = |x: u32, y: u32| picture.rgba[4 * (y * SIDE + x) as usize..][..4].to_vec();
        [at(0, 0), at(SIDE - 1, 0), at(0, SIDE - 1), at(SIDE - 1, SIDE - 1)]
    };
    for preset in Preset::ALL {
        let [a, b, c, d] = edge(&drawn(&mut heads, &mut offscreen, &breed, preset, |d| d.background = preset.plain()));
        // Below, the head's soft shadow on the ground just reaches the corners.
        let near = |other: &[u8]| a.iter().zip(other).all(|(a, o)| a.abs_diff(*o) <= 8);
        assert!(near(&b) && near(&c) && near(&d), "{}: {a:?} {b:?} {c:?} {d:?}", preset.name());
        let [a, b, c, d] =
            edge(&drawn(&mut heads, &mut offscreen, &breed, preset, |d| d.background = preset.gradient()));
        assert!(a[0] != c[0] && a[0].abs_diff(b[0]) <= 1 && c[0].abs_diff(d[0]) <= 8, "{}", preset.name());
    }
}

#[test]
fn clay_shows_the_colours_of_the_coat() {
    let (mut heads, mut offscreen) = (Heads::new(2), offscreen());
    let breed = heads.breed("beagle");
    let mut dyed = breed.clone();
    dyed.look.pattern = londra::anatomy::Pattern::plain(glam::Vec3::new(0.0, 0.6, 0.1));
    dyed.look.iris = glam::Vec3::X;
    dyed.look.nose = glam::Vec3::ONE;
    let before = drawn(&mut heads, &mut offscreen, &breed, Preset::Clay, |_| ());
    assert!(before == drawn(&mut heads, &mut offscreen, &dyed, Preset::Clay, |_| ()));
    assert!(before != drawn(&mut heads, &mut offscreen, &breed, Preset::Studio, |_| ()));
}

#[test]
fn clay_on_a_sheet_has_whiskers() {
    let (mut heads, mut offscreen) = (Heads::new(2), offscreen());
    let breed = heads.breed("beagle");
    let mut sheet_of = |whiskers: bool, dress: Dress| {
        heads.pipeline.set_layers(Layers { whiskers, ..Layers::default() }).unwrap();
        let views = vec![View::Portrait];
        let mut sheet = Sheet::new(views, [SIDE; 2], true, Lens::default(), None, Background::default());
        sheet.dresses = vec![dress];
        sheet.add_row(&mut offscreen, &heads.pipeline.update(&breed), "beagle").unwrap();
        sheet.finish()
    };
    assert!(sheet_of(true, Dress::Clay) == sheet_of(false, Dress::Clay));
    assert!(sheet_of(true, Dress::Skin) != sheet_of(false, Dress::Skin));
}

#[test]
fn a_plate_is_lit_from_one_side() {
    let (mut heads, mut offscreen) = (Heads::new(2), offscreen());
    let breed = heads.breed("labrador");
    // From the front, where both halves are alike.
    let mut uneven = |preset: Preset| {
        let front = |d: &mut Drawing| {
            nothing(d);
            (d.camera.azimuth, d.camera.elevation, d.camera.target.x) = (0.0, 0.0, 0.0);
        };
        let picture = drawn(&mut heads, &mut offscreen, &breed, preset, front);
        let value = |x: u32, y: u32| f64::from(picture.rgba[4 * (y * SIDE + x) as usize + 1]);
        let rows = (0..SIDE).flat_map(|y| (0..SIDE / 2).map(move |x| (x, y)));
        let differences: Vec<f64> =
            rows.map(|(x, y)| value(x, y) - value(SIDE - 1 - x, y)).filter(|d| *d != 0.0).collect();
        (differences.iter().sum::<f64>() / differences.len() as f64).abs()
    };
    let (plate, studio) = (uneven(Preset::Plate), uneven(Preset::Studio));
    assert!(plate < 3.0 && studio > 2.0 * plate, "plate {plate}, studio {studio}");
}

#[test]
fn bone_cannot_be_seen_through_the_skin() {
    let (mut heads, mut offscreen) = (Heads::new(2), offscreen());
    let breed = heads.breed("newfoundland");
    let bone = brightness(&drawn(&mut heads, &mut offscreen, &breed, Preset::XRay, nothing));
    let coat = brightness(&drawn(&mut heads, &mut offscreen, &breed, Preset::Studio, nothing));
    assert!(bone > coat + 20.0, "{bone} with bone, {coat} without");
}

#[test]
fn pale_coats_are_washed_out_or_dark_ones_drown() {
    let (mut heads, mut offscreen) = (Heads::new(2), offscreen());
    for preset in [Preset::Studio, Preset::Daylight, Preset::Plate] {
        let pale = heads.breed("samoyed");
        let picture = drawn(&mut heads, &mut offscreen, &pale, preset, nothing);
        let burnt = part(&picture, |p| p[3] == 255 && p[..3].iter().all(|&c| c >= 253));
        assert!(burnt < 0.01, "{}: {burnt} of the samoyed are white", preset.name());
        let dark = heads.breed("newfoundland");
        let picture = drawn(&mut heads, &mut offscreen, &dark, preset, nothing);
        let drowned = part(&picture, |p| p[3] == 255 && p[..3].iter().all(|&c| c <= 6));
        assert!(drowned < 0.05, "{}: {drowned} of the newfoundland are black", preset.name());
    }
}

#[test]
fn more_samples_make_a_rougher_edge() {
    let (mut heads, mut offscreen) = (Heads::new(2), offscreen());
    let breed = heads.breed("borzoi");
    let mut greys = Samples::ALL.map(|samples| {
        let picture = drawn(&mut heads, &mut offscreen, &breed, Preset::Silhouette, |d| d.samples = samples);
        let mut seen = [false; 256];
        pixels(&picture).for_each(|p| seen[usize::from(p[0])] = true);
        seen.iter().filter(|s| **s).count()
    });
    let counted = greys;
    greys.sort_unstable();
    assert!(greys == counted && counted[0] <= 8 && counted[3] > 2 * counted[0], "{counted:?} shades");
}

#[test]
fn too_many_samples_for_the_device_are_drawn_as_fewer() {
    let mut offscreen = offscreen();
    let most = offscreen.gpu().device.limits().max_texture_dimension_2d;
    let head = stand_in::StandIn::new(0.07, glam::Vec3::ONE);
    let camera = Camera::at(View::Front, None, Lens::default());
    let drawing = Drawing { samples: "64".parse().unwrap(), ..Drawing::new(camera) };
    let error = offscreen.draw(&head.frame(), &drawing, [most / 2, 8]).unwrap_err();
    assert!(matches!(error, DrawError::Samples { samples: 64, .. }), "{error}");
}

#[test]
fn a_preset_comes_out_otherwise_in_a_second_run() {
    let (mut heads, mut offscreen) = (Heads::new(2), offscreen());
    let breed = heads.breed("pug");
    let first = Preset::ALL.map(|preset| drawn(&mut heads, &mut offscreen, &breed, preset, |_| ()));
    drop(offscreen);
    let (mut heads, mut offscreen) = (Heads::new(2), Offscreen::new(Gpu::open_software().unwrap()).unwrap());
    for (preset, first) in Preset::ALL.into_iter().zip(first) {
        let again = drawn(&mut heads, &mut offscreen, &breed, preset, |_| ());
        assert!(first == again, "{}", preset.name());
    }
}

#[test]
fn a_camera_that_comes_close_loses_what_it_looks_at() {
    let mut camera = Camera::at(View::Portrait, None, Lens::default());
    camera.fit([glam::Vec3::ZERO, glam::Vec3::new(0.1, 0.1, 0.2)].iter(), 1.0, 0.1);
    let point = glam::Vec3::new(0.03, 0.03, 0.1);
    for lens in [Lens::default(), Lens::Orthographic] {
        let mut near = Camera { lens, ..camera };
        near.look_at(point);
        near.zoom(8.0);
        let place = near.clip_from_head(1.0, 0.3).project_point3(point);
        assert!(place.truncate().length() < 1e-4 && (0.0..1.0).contains(&place.z), "{lens:?}: {place}");
        let aside = near.clip_from_head(1.0, 0.3).project_point3(point + glam::Vec3::Y * 0.002).truncate().length();
        let mut far = near;
        far.zoom(0.5);
        let before = far.clip_from_head(1.0, 0.3).project_point3(point + glam::Vec3::Y * 0.002).truncate().length();
        assert!((aside / before - 2.0).abs() < 0.02, "{lens:?}: {aside} after {before}");
    }
}
