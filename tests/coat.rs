//! Hair: where it grows, that it is the same everywhere, what it costs, and that it is seen.
#![cfg(feature = "head")]

#[cfg(feature = "graphics")]
#[path = "support/pictures.rs"]
mod pictures;
#[path = "support/settings.rs"]
mod settings;

use glam::Vec3;
use londra::anatomy::{Breed, Hair, Region, load_breed, save_breed};
use londra::coat::{MAX_STRANDS, N_LEADERS, Root, n_rooted};
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
        hash.u32(root.leader);
    }
    line("every", "roots", hash);
    for id in ["labrador", "australian_shepherd", "dalmatian", "greyhound", "miniature_schnauzer", "yorkshire_terrier"]
    {
        let frame = pipeline.update(world.breed(id));
        let coat = frame.coat.unwrap();
        for (stage, values) in [("colours", frame.parts[0].colours), ("hair", coat.colours)] {
            let mut hash = Fnv64::new();
            values.iter().flat_map(|v| v.to_array()).for_each(|x| hash.f32(x));
            line(id, stage, hash);
        }
        let mut hash = Fnv64::new();
        bytemuck::cast_slice(coat.grooms).iter().for_each(|x| hash.f32(*x));
        line(id, "groom", hash);
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
    assert_eq!(all.len(), n_rooted(N));
    let mut few = world.pipeline(LEVEL, N / 10);
    assert!(all[..n_rooted(N / 10)] == roots(&mut few, &lab)[..]);
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
        assert_eq!(coat.grooms.len(), frame.parts[0].positions.len());
        for groom in coat.grooms {
            let numbers: &[f32] = bytemuck::cast_slice(std::slice::from_ref(groom));
            assert!(numbers.iter().all(|x| x.is_finite()), "{}: {groom:?}", head.id);
            assert!((0.0..0.25).contains(&groom.length) && groom.comb.abs().max_element() < 4.0, "{}", head.id);
            for part in [groom.curl, groom.clump, groom.wire, groom.gloss, groom.density, groom.undercoat, groom.grey] {
                assert!((-0.2..1.2).contains(&part), "{}: {groom:?}", head.id);
            }
        }
        let (triangles, _) = frame.parts[0].topology.indices.as_chunks::<3>();
        // Hair comes up to the rim of the leather, which the triangles inside have no part in.
        let rim = 0.002_001;
        let (mut bare, mut longest) = (0, 0.0_f32);
        for (triangle, _) in triangles.iter().zip(materials(&frame)).filter(|(_, m)| *m == Material::Nose) {
            let lengths = triangle.map(|v| coat.grooms[v as usize].length);
            bare += usize::from(lengths == [0.0; 3]);
            longest = lengths.into_iter().fold(longest, f32::max);
        }
        assert!(bare > 0 && longest <= rim, "{}: {longest} m on the nose", head.id);
    }
}

#[test]
fn a_lock_has_no_leader_or_one_that_is_far_or_on_the_other_side() {
    let world = World::embedded();
    let mut pipeline = world.pipeline(LEVEL, N);
    let frame = pipeline.update(&world.breeds[0]);
    let roots = frame.coat.unwrap().roots;
    let (mut led, mut farthest) = (0, 0.0_f32);
    for (i, root) in roots.iter().enumerate() {
        let leader = root.leader as usize;
        assert!(leader == i || leader < N_LEADERS, "{i}: {root:?}");
        led += usize::from(leader != i);
        farthest = farthest.max(Vec3::from(root.place).distance(Vec3::from(roots[leader].place)));
    }
    assert!(farthest <= 1.0, "{farthest} cm");
    // Many more than do not are in a lock.
    assert!(led * 10 > (roots.len() - N_LEADERS) * 9, "{led} of {}", roots.len());
}

#[test]
fn fewer_strands_have_more_roots_than_more_strands() {
    let mut last = 0;
    for n in [0, 1, 2_000, 10_000, 29_999, 30_000, 30_001, 89_999, 90_000, 250_000] {
        let rooted = n_rooted(n);
        assert!(rooted >= n.max(last) && rooted <= 3 * n, "{n}: {rooted}");
        last = rooted;
    }
}

#[test]
fn what_a_file_tells_of_a_region_is_lost_or_goes_elsewhere_or_is_not_mixed() {
    let world = World::embedded();
    let told = "regions: {\"crown\": (curl: 0.75, length_mm: 31), \"ear_outer\": (out: -1.5, density: 0.5)}";
    let text = save_breed(&world.table, world.breed("pug"));
    let with = |told: &str| text.replacen("undercoat: 0.0)", &format!("undercoat: 0.0, {told})"), 1);
    let load = |text: &str| load_breed(&world.table, "pug.ron", text);
    let pug = load(&with(told)).unwrap();
    let (hair, plain) = (&pug.look.hair, world.breed("pug").look.hair.clone());
    assert_eq!((hair.at(Region::Crown).curl, hair.at(Region::Crown).length), (0.75, 0.031));
    assert_eq!((hair.at(Region::EarOuter).comb[0], hair.at(Region::EarOuter).density), (-1.5, 0.5));
    for region in Region::ALL.into_iter().filter(|r| ![Region::Crown, Region::EarOuter].contains(r)) {
        assert_eq!(hair.at(region), plain.at(region), "{region:?}");
    }
    let again = load(&save_breed(&world.table, &pug)).unwrap();
    assert_eq!(again.look.hair, *hair);

    // A part of the way it is as much of the difference, there and nowhere else.
    let afghan = world.breed("afghan_hound");
    let blend = Breed::blend(&world.table, &[(&pug, 0.25), (afghan, 0.75)]).look.hair;
    let mean = |of: fn(&Hair) -> f32| 0.25 * of(hair) + 0.75 * of(&afghan.look.hair);
    for of in [
        |h: &Hair| h.at(Region::Crown).curl,
        |h: &Hair| h.at(Region::Crown).length,
        |h: &Hair| h.at(Region::Cheek).curl,
    ] {
        assert!((of(&blend) - mean(of)).abs() < 1e-6, "{} is not {}", of(&blend), mean(of));
    }
    assert!(blend.regions.keys().eq(hair.regions.keys()));

    for (told, complaint) in [
        ("regions: {\"crown\": (curl: 1.5)}", "hair.regions[\"crown\"].curl is 1.5, allowed 0 to 1"),
        ("regions: {\"crown\": (out: -4)}", "out is -4, allowed -3 to 3"),
        ("regions: {\"crwn\": (curl: 1)}", "unknown region crwn (did you mean crown?)"),
        ("regions: {\"nose\": (curl: 1)}", "no hair grows on nose"),
        ("regions: {\"crown\": (crl: 1)}", "crl (did you mean curl?)"),
        ("regions: {\"crown\": (curl: 0), \"crown\": (curl: 1)}", "given twice"),
        ("regions: []", "hair.regions must be a map"),
    ] {
        let error = load(&with(told)).unwrap_err().to_string();
        assert!(error.contains(complaint), "{told}: {error}");
    }
}

#[test]
fn a_grown_dog_has_a_puppys_coat_or_the_other_way_round() {
    let world = World::embedded();
    let mut pipeline = world.pipeline(LEVEL, 1);
    let age = world.table.index_of("age_weeks").unwrap();
    let mut dog = world.breed("beagle").clone();
    let mut youth = |weeks: f32| {
        dog.set_value(&world.table, age, weeks);
        pipeline.update(&dog).coat.unwrap().youth
    };
    assert_eq!([4.0, 8.0, 52.0].map(&mut youth), [1.0, 1.0, 0.0]);
    assert!(youth(16.0) > youth(26.0) && youth(26.0) > 0.0);
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
    use londra::coat::Condition;
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

    /// Mean colour, 0 to 255 in sRGB, of the pixels that a head without hair fills.
    fn mean_colour(picture: &Picture, bare: &Picture) -> Vec3 {
        let both = picture.rgba.chunks_exact(4).zip(bare.rgba.chunks_exact(4));
        let inside = both.filter(|(p, b)| b[3] == 255 && p[3] == 255).map(|(p, _)| p);
        let colour = |p: &[u8]| Vec3::new(f32::from(p[0]), f32::from(p[1]), f32::from(p[2]));
        let (sum, n) = inside.fold((Vec3::ZERO, 0), |(sum, n), p| (sum + colour(p), n + 1));
        sum / n as f32
    }

    /// Strands from none to many, as a person may ask for them.
    const STRANDS: [u32; 8] = [0, 2_000, 5_000, 10_000, 20_000, 40_000, 90_000, 250_000];
    /// How far the mean colour may be from that of 90 000 strands, and from that of the number before, of 255.
    const FROM_MEDIUM: f32 = 6.0;
    const FROM_LAST: f32 = 4.5;

    #[test]
    fn a_head_with_more_strands_is_brighter_or_darker() {
        let world = World::embedded();
        let mut pipeline = world.pipeline(LEVEL, 250_000);
        let mut offscreen = offscreen();
        let mut worst = Vec::new();
        for id in ["labrador", "newfoundland", "samoyed", "german_shepherd", "yorkshire_terrier", "poodle"] {
            let frame = pipeline.update(world.breed(id));
            let pictures = STRANDS.map(|n| picture(&mut offscreen, &frame, n));
            let colours = pictures.each_ref().map(|p| mean_colour(p, &pictures[0]));
            let medium = colours[6];
            println!("{id}: {}", colours.map(|c| format!("{:.1} {:.1} {:.1}", c.x, c.y, c.z)).join(" | "));
            for (k, colour) in colours.into_iter().enumerate() {
                let off = (colour - medium).abs().max_element();
                let step = (colour - colours[k.saturating_sub(1)]).abs().max_element();
                if off > FROM_MEDIUM || step > FROM_LAST {
                    worst.push(format!("{id}, {} strands: {off:.1} from medium, {step:.1} from the last", STRANDS[k]));
                }
            }
        }
        assert!(worst.is_empty(), "{worst:#?}");
    }

    #[test]
    fn hair_crosses_an_eye() {
        let world = World::embedded();
        let mut pipeline = world.pipeline(LEVEL, 60_000);
        let mut offscreen = offscreen();
        for id in ["yorkshire_terrier", "shih_tzu", "miniature_schnauzer", "irish_wolfhound", "bedlington", "pekingese"]
        {
            let frame = pipeline.update(world.breed(id));
            let eye = frame.eyes[0].eye;
            let from = View::Angles { azimuth: 0.4, elevation: 0.1 };
            let mut camera = Camera::at(from, Some(0.0), Lens::default());
            camera.fit(frame.outline().iter(), 1.0, 0.08);
            camera.look_at(eye.centre + eye.axes[2] * eye.radius);
            camera.zoom(30.0);
            let [bare, haired] = [0, 60_000].map(|n_strands| {
                let drawing = Drawing { n_strands, ..Drawing::new(camera) };
                offscreen.draw(&frame, &drawing, [SIDE, SIDE]).unwrap()
            });
            let pixels = bare.rgba.chunks_exact(4).zip(haired.rgba.chunks_exact(4));
            let crossed = pixels.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 24)).count();
            let most = (SIDE * SIDE) as usize / 25;
            assert!(crossed <= most, "{id}: {crossed} pixels of the eye, at most {most}");
        }
    }

    #[test]
    fn a_condition_of_the_coat_uploads_something_or_is_not_seen() {
        let world = World::embedded();
        let mut offscreen = offscreen();
        let mut pipeline = world.pipeline(LEVEL, 6_000);
        let frame = pipeline.update(world.breed("golden_retriever"));
        let mut camera = Camera::at(View::Portrait, None, Lens::default());
        camera.fit(frame.outline().iter(), 1.0, 0.08);
        let background = Background::None;
        let mut draw = |n_strands, condition| {
            let drawing = Drawing { n_strands, condition, background, ..Drawing::new(camera) };
            let before = offscreen.hair_bytes();
            let picture = offscreen.draw(&frame, &drawing, [SIDE, SIDE]).unwrap();
            (picture, offscreen.hair_bytes() - before)
        };
        let covered = |p: &Picture| p.rgba.chunks_exact(4).map(|p| u32::from(p[3])).sum::<u32>();
        let brightness =
            |p: &Picture| p.rgba.chunks_exact(4).map(|p| u32::from(p[1])).sum::<u32>() as f32 / covered(p) as f32;
        let usual = Condition::default();
        let (dry, _) = draw(6_000, usual);
        let changes = Condition::FIELDS.map(|field| {
            let mut condition = usual;
            let value = (field.of)(&mut condition);
            *value = if *value == 0.0 { 1.0 } else { 0.3 };
            let (picture, n_bytes) = draw(6_000, condition);
            assert_eq!(n_bytes, 0, "{}", field.name);
            assert!(picture != dry, "{} changes nothing", field.name);
            picture
        });
        let [shorter, _, clipped, wet, grey] = &changes;
        assert!(covered(shorter) < covered(&dry) && covered(clipped) < covered(&dry));
        assert!(brightness(wet) < 0.85 * brightness(&dry), "{} and {}", brightness(wet), brightness(&dry));
        assert!(brightness(grey) > 1.02 * brightness(&dry), "{} and {}", brightness(grey), brightness(&dry));
        // Without strands, too.
        let wet = Condition { wet: 1.0, ..usual };
        assert!(brightness(&draw(0, wet).0) < 0.85 * brightness(&draw(0, usual).0));
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
