//! Hair: where it grows, that it is the same everywhere, what it costs, and that it is seen.
#![cfg(feature = "head")]

#[cfg(feature = "graphics")]
#[path = "support/pictures.rs"]
mod pictures;
#[path = "support/settings.rs"]
mod settings;

use londra::anatomy::{Breed, Hair, Region, load_breed, save_breed};
use londra::coat::{MAX_STRANDS, Root};
use londra::frame::{Frame, Material, Pipeline};
use londra::math::fnv::Fnv64;
use settings::World;

/// Where the hair of [`stages_of_hair`] was seen last; `UPDATE_HASHES=1` rewrites it.
const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/coat_hashes.txt");
const LEVEL: u32 = 2;
const N: usize = 20_000;

fn roots(pipeline: &mut Pipeline, breed: &Breed) -> Vec<Root> {
    pipeline.update(breed).coat.unwrap().roots.to_vec()
}

fn stages_of_hair(world: &World) -> String {
    let mut out = String::from("# breed stage hash; written by UPDATE_HASHES=1 cargo test --test coat\n");
    let mut pipeline = world.pipeline(LEVEL, N);
    let mut line = |breed: &str, stage: &str, hash: Fnv64| {
        out.push_str(&format!("{breed} {stage} {:016x}\n", hash.finish()));
    };
    let mut hash = Fnv64::new();
    for root in roots(&mut pipeline, &world.breeds[0]) {
        hash.u32(root.triangle);
        root.weights.into_iter().for_each(|w| hash.f32(w));
        hash.u32(root.seed);
    }
    line("every", "roots", hash);
    for id in ["labrador", "australian_shepherd", "dalmatian", "greyhound", "miniature_schnauzer", "yorkshire_terrier"]
    {
        let frame = pipeline.update(world.breed(id));
        let coat = frame.coat.unwrap();
        let of_look = [("growth", coat.growth), ("comb", coat.comb), ("colours", frame.parts[0].colours)];
        for (stage, values) in of_look.into_iter().chain([("hair", coat.colours)]) {
            let mut hash = Fnv64::new();
            values.iter().flat_map(|v| v.to_array()).for_each(|x| hash.f32(x));
            line(id, stage, hash);
        }
    }
    out
}

#[test]
fn hair_has_other_bits_than_the_committed_ones() {
    let world = World::embedded();
    let made = stages_of_hair(&world);
    assert!(made == stages_of_hair(&world), "the same hair twice has other bits");
    if std::env::var_os("UPDATE_HASHES").is_some() {
        std::fs::write(FILE, made).unwrap();
        return;
    }
    let committed = std::fs::read_to_string(FILE).unwrap_or_default();
    let other: Vec<&str> = made.lines().filter(|line| !committed.contains(line)).collect();
    assert!(other.is_empty(), "{other:#?}; UPDATE_HASHES=1 rewrites {FILE}");
}

#[test]
fn fewer_strands_are_not_the_first_ones_or_leave_a_region_bare() {
    let world = World::embedded();
    let lab = world.breed("labrador").clone();
    let all = roots(&mut world.pipeline(LEVEL, N), &lab);
    assert_eq!(all.len(), N);
    let mut few = world.pipeline(LEVEL, N / 10);
    assert!(all[..N / 10] == roots(&mut few, &lab)[..]);
    let regions = world.rig.half().whole_regions();
    let control = world.rig.mesh().indices();
    let mut seen = [false; Region::COUNT];
    let parents = parents(&few);
    let frame = few.frame();
    for root in frame.coat.unwrap().roots {
        let parent = parents[root.triangle as usize] as usize;
        (0..3).for_each(|k| seen[regions[control[3 * parent + k] as usize] as usize] = true);
    }
    let bare: Vec<_> =
        Region::ALL.into_iter().filter(|r| !seen[*r as usize] && regions.contains(r) && !is_bare(*r)).collect();
    assert!(bare.is_empty(), "{bare:?}");
    few.set_hair(usize::MAX);
    assert_eq!(roots(&mut few, &lab).len(), MAX_STRANDS);
    few.set_hair(0);
    assert!(roots(&mut few, &lab).is_empty());
}

fn is_bare(region: Region) -> bool {
    matches!(region, Region::Nose | Region::Nostril | Region::Lid | Region::Mouth)
}

/// The control face of each triangle of the skin, as it is drawn: its faces are those of the plan, sorted by material.
fn parents(pipeline: &Pipeline) -> Vec<u32> {
    let plan = pipeline.skin_plan();
    let (faces, _) = plan.indices().as_chunks::<3>();
    let of_face: std::collections::BTreeMap<[u32; 3], u32> =
        faces.iter().copied().zip(plan.face_parent().iter().copied()).collect();
    let frame = pipeline.frame();
    let (drawn, _) = frame.parts[0].topology.indices.as_chunks::<3>();
    drawn.iter().map(|f| of_face[f]).collect()
}

fn materials(frame: &Frame<'_>) -> Vec<Material> {
    let ranges = &frame.parts[0].topology.ranges;
    ranges.iter().flat_map(|r| std::iter::repeat_n(r.material, r.count as usize / 3)).collect()
}

#[test]
fn a_hair_grows_on_leather_or_leaves_its_triangle() {
    let world = World::embedded();
    let mut pipeline = world.pipeline(LEVEL, N);
    let frame = pipeline.update(&world.breeds[0]);
    let materials = materials(&frame);
    let coat = frame.coat.unwrap();
    for root in coat.roots {
        assert_eq!(materials[root.triangle as usize], Material::Coat);
        let [second, third] = root.weights;
        assert!(second >= 0.0 && third >= 0.0 && second + third <= 1.0 + 1e-6, "{root:?}");
    }
}

#[test]
fn hair_of_a_breed_or_a_blend_is_no_length_or_stands_on_leather() {
    let world = World::embedded();
    let mut pipeline = world.pipeline(LEVEL, 1);
    let mut heads = world.breeds.clone();
    let pairs = [("pug", "afghan_hound"), ("poodle", "borzoi"), ("shih_tzu", "dobermann")];
    heads.extend(pairs.map(|(a, b)| Breed::blend(&world.table, &[(world.breed(a), 0.4), (world.breed(b), 0.6)])));
    for head in &heads {
        let frame = pipeline.update(head);
        let coat = frame.coat.unwrap();
        assert_eq!((coat.growth.len(), coat.comb.len()), (frame.parts[0].positions.len(), coat.growth.len()));
        for (growth, comb) in coat.growth.iter().zip(coat.comb) {
            assert!(growth.is_finite() && comb.is_finite() && (0.0..0.25).contains(&growth.x), "{}", head.id);
        }
        let (triangles, _) = frame.parts[0].topology.indices.as_chunks::<3>();
        // Hair comes up to the rim of the leather, which the triangles inside have no part in.
        let rim = 0.002_001;
        let (mut bare, mut longest) = (0, 0.0_f32);
        for (triangle, _) in triangles.iter().zip(materials(&frame)).filter(|(_, m)| *m == Material::Nose) {
            let lengths = triangle.map(|v| coat.growth[v as usize].x);
            bare += usize::from(lengths == [0.0; 3]);
            longest = lengths.into_iter().fold(longest, f32::max);
        }
        assert!(bare > 0 && longest <= rim, "{}: {longest} m on the nose", head.id);
    }
}

#[test]
fn hair_is_lost_on_the_way_through_a_file_or_a_blend() {
    let world = World::embedded();
    let (pug, afghan) = (world.breed("pug").clone(), world.breed("afghan_hound").clone());
    for head in [&pug, &afghan] {
        let again = load_breed(&world.table, &format!("{}.ron", head.id), &save_breed(&world.table, head)).unwrap();
        assert_eq!(again.look.hair, head.look.hair);
    }
    let blend = Breed::blend(&world.table, &[(&pug, 0.25), (&afghan, 0.75)]).look.hair;
    let mean = |of: fn(&Hair) -> f32| 0.25 * of(&pug.look.hair) + 0.75 * of(&afghan.look.hair);
    for of in [|h: &Hair| h.topknot, |h: &Hair| h.fringe, |h: &Hair| h.gloss] {
        assert!((of(&blend) - mean(of)).abs() < 1e-6);
    }
    let text = save_breed(&world.table, &pug);
    for (from, to, complaint) in [
        ("muzzle_mm: 3.0", "muzzle_mm: 201.0", "hair.muzzle_mm is 201, allowed 0 to 200"),
        ("curl: 0.0", "curl: -1", "hair.curl is -1, allowed 0 to 1"),
        ("gloss:", "glos:", "hair.glos (did you mean gloss?)"),
    ] {
        assert!(text.contains(from), "{text}");
        let error = load_breed(&world.table, "pug.ron", &text.replace(from, to)).unwrap_err().to_string();
        assert!(error.contains(complaint), "{error}");
    }
}

#[cfg(feature = "graphics")]
mod drawn {
    use super::*;
    use crate::pictures::offscreen;
    use londra::render::{Background, Camera, Drawing, Lens, Offscreen, Picture, View};

    const SIDE: u32 = 120;

    fn picture(offscreen: &mut Offscreen, frame: &Frame<'_>, n_strands: u32) -> Picture {
        let mut camera = Camera::at(View::Portrait, None, Lens::default());
        camera.fit(frame.outline().iter(), 1.0, 0.08);
        let drawing = Drawing { n_strands, background: Background::None, ..Drawing::new(camera) };
        offscreen.draw(frame, &drawing, [SIDE, SIDE]).unwrap()
    }

    /// Pixels that are covered in part.
    fn broken(picture: &Picture) -> usize {
        picture.rgba.chunks_exact(4).filter(|p| (8..248).contains(&p[3])).count()
    }

    #[test]
    fn hair_is_not_seen_at_the_outline() {
        let world = World::embedded();
        let mut pipeline = world.pipeline(LEVEL, 10_000);
        let mut offscreen = offscreen();
        let frame = pipeline.update(world.breed("samoyed"));
        let [bare, haired] = [0, 10_000].map(|n| picture(&mut offscreen, &frame, n));
        assert!(bare != haired);
        assert!(broken(&haired) as f32 > 1.5 * broken(&bare) as f32, "{} and {}", broken(&haired), broken(&bare));
        assert!(picture(&mut offscreen, &frame, 10_000) == haired, "the same hair gave other bytes");
    }

    #[test]
    fn a_frame_of_another_shape_uploads_more_for_more_strands() {
        let world = World::embedded();
        let mut offscreen = offscreen();
        let uploads = [1_000, 8_000].map(|n| {
            let mut pipeline = world.pipeline(LEVEL, n);
            offscreen.forget();
            let mut lab = world.breed("labrador").clone();
            picture(&mut offscreen, &pipeline.update(&lab), n as u32);
            let before = offscreen.hair_bytes();
            let longer = lab.values[0] * 1.1;
            lab.set_value(&world.table, 0, longer);
            picture(&mut offscreen, &pipeline.update(&lab), n as u32);
            offscreen.hair_bytes() - before
        });
        assert_eq!(uploads[0], uploads[1]);
        assert!(uploads[0] < 100, "{uploads:?} bytes");
    }
}
