//! Colours of the coat: that they are the same everywhere, stay on the skin, differ between breeds, and survive files.
#![cfg(feature = "head")]

#[path = "support/settings.rs"]
mod settings;

use glam::Vec3;
use londra::anatomy::{
    Breed, Eumelanin, Look, Marking, MarkingKind, Paint, Pattern, Pigments, Region, load_breed, save_breed,
};
use londra::coat::{Chart, Colouring, n_rooted};
use londra::frame::Pipeline;
use settings::World;

const LEVEL: u32 = 2;
const N: usize = 6_000;

fn hair_colours(pipeline: &mut Pipeline, breed: &Breed) -> Vec<Vec3> {
    pipeline.update(breed).coat.unwrap().colours.to_vec()
}

fn bits(colours: &[Vec3]) -> Vec<[u32; 3]> {
    colours.iter().map(|c| c.to_array().map(f32::to_bits)).collect()
}

/// A coat with every kind of marking on it.
fn every_marking() -> Pattern {
    let pigments = Pigments { eumelanin: Eumelanin::Blue, phaeomelanin: 0.3 };
    let paints = [Paint::White, Paint::Eumelanin, Paint::Phaeomelanin(None), Paint::Phaeomelanin(Some(0.77))];
    let markings = MarkingKind::ALL.iter().enumerate().map(|(i, &kind)| Marking {
        regions: if kind == MarkingKind::Patch { vec![Region::Cheek, Region::EarInner] } else { Vec::new() },
        ..Marking::new(kind, paints[i % 4]).by(0.6)
    });
    Pattern { pigments, base: Paint::Colour(Vec3::new(0.4, 0.3, 0.2)), markings: markings.collect() }
}

#[test]
fn colours_of_a_coat_depend_on_the_threads() {
    let world = World::embedded();
    let mut breed = world.breed("australian_shepherd").clone();
    breed.look.pattern.markings.extend(every_marking().markings);
    let [one, eight] = [1, 8].map(|threads| {
        let mut pipeline = world.pipeline(LEVEL, N);
        pipeline.set_threads(threads);
        let frame = pipeline.update(&breed);
        (bits(frame.parts[0].colours), bits(frame.coat.unwrap().colours))
    });
    assert!(one == eight);
}

#[test]
fn colours_of_fewer_strands_are_not_the_first_of_more() {
    let world = World::embedded();
    for id in ["greyhound", "english_cocker"] {
        let [few, many] = [N / 4, N].map(|n| hair_colours(&mut world.pipeline(LEVEL, n), world.breed(id)));
        assert_eq!((few.len(), many.len()), (n_rooted(N / 4), n_rooted(N)));
        assert_eq!(bits(&few), bits(&many[..few.len()]), "{id}");
    }
}

#[test]
fn a_marking_slides_over_the_skin_when_a_measure_moves() {
    let world = World::embedded();
    let mut pipeline = world.pipeline(LEVEL, N);
    let mut dog = world.breed("border_collie").clone();
    let before = hair_colours(&mut pipeline, &dog);
    for (id, factor) in [("facial_length_mm", 0.6), ("cranial_length_mm", 1.1), ("ear_length_mm", 1.2)] {
        let row = world.row(id);
        dog.set_value(&world.table, row, dog.values[row] * factor);
    }
    let frame = pipeline.update(&dog);
    let revisions = frame.revisions;
    assert_eq!(bits(frame.coat.unwrap().colours), bits(&before));
    // Nor is it painted again.
    assert_eq!(revisions.look, 1);
}

#[test]
fn two_breeds_wear_the_same_coat() {
    let world = World::embedded();
    let mut pipeline = world.pipeline(LEVEL, 1_000);
    let coats: Vec<_> = world.breeds.iter().map(|b| bits(&hair_colours(&mut pipeline, b))).collect();
    for (i, a) in coats.iter().enumerate() {
        for (j, b) in coats[..i].iter().enumerate() {
            assert!(a != b, "{} and {}", world.breeds[i].id, world.breeds[j].id);
        }
    }
}

#[test]
fn two_coats_of_a_breed_are_alike() {
    let world = World::embedded();
    let mut pipeline = world.pipeline(LEVEL, 1_000);
    for breed in &world.breeds {
        let mut seen = Vec::new();
        for variety in &breed.varieties {
            let mut dog = breed.clone();
            dog.wear(&variety.name).unwrap();
            assert_eq!(dog.worn(), Some(variety.name.as_str()), "{}", breed.id);
            let colours = bits(&hair_colours(&mut pipeline, &dog));
            assert!(!seen.contains(&colours), "{}: {}", breed.id, variety.name);
            seen.push(colours);
        }
        assert_ne!(breed.varieties.len(), 1, "{}: one coat needs no name", breed.id);
        if let Some(first) = breed.varieties.first() {
            assert_eq!(breed.look, first.look, "{}", breed.id);
        }
    }
}

#[test]
fn a_kind_of_marking_is_not_seen_or_no_colour() {
    let world = World::embedded();
    let chart = Chart::new(&world.rig, world.pipeline(LEVEL, 0).skin_plan());
    for &kind in MarkingKind::ALL {
        let pattern = Pattern { markings: vec![Marking::new(kind, Paint::White)], ..Pattern::plain(Vec3::ZERO) };
        let colouring = Colouring::new(&pattern);
        let (mut covered, mut n) = (0.0, 0);
        for v in 0..chart.len() {
            let site = chart.vertex(v);
            let patch = f32::from(u8::from(v % 10 == 0));
            let colour = colouring.at(&site, |_| patch);
            assert!(colour.is_finite() && (0.0..=1.0).contains(&colour.x), "{}: {colour}", kind.name());
            covered += colour.y;
            n += 1;
        }
        let part = covered / n as f32;
        assert!((0.0002..0.98).contains(&part), "{} covers {part} of the skin", kind.name());
    }
}

#[test]
fn a_mask_is_not_before_the_eyes_or_a_saddle_on_the_face() {
    let world = World::embedded();
    let chart = Chart::new(&world.rig, world.pipeline(LEVEL, 0).skin_plan());
    let cover = |marking: Marking, wanted: Vec3| {
        let pattern = Pattern { markings: vec![marking], ..Pattern::plain(Vec3::ZERO) };
        let at = |v: &usize| chart.vertex(*v).place.distance_squared(wanted);
        let nearest = (0..chart.len()).min_by(|a, b| at(a).total_cmp(&at(b))).unwrap();
        Colouring::new(&pattern).at(&chart.vertex(nearest), |_| 0.0).x
    };
    let [bridge, crown, nape, cheek] =
        [[0.0, -1.1, 5.0], [0.0, 3.0, -7.0], [0.0, -2.0, -15.0], [5.5, -4.0, -5.0]].map(Vec3::from);
    let white = Paint::Colour(Vec3::ONE);
    for (kind, covered, free) in [
        (MarkingKind::Mask, bridge, crown),
        (MarkingKind::Saddle, nape, bridge),
        (MarkingKind::Blaze, bridge, cheek),
        (MarkingKind::Cap, crown, cheek),
        (MarkingKind::Urajiro, cheek, crown),
        (MarkingKind::Collar, nape, bridge),
    ] {
        let marking = Marking::new(kind, white).with("extent", 0.6);
        let [covered, free] = [covered, free].map(|place| cover(marking.clone(), place));
        assert!(covered > 0.9 && free < 0.1, "{}: {covered} and {free}", kind.name());
    }
}

#[test]
fn a_marking_is_torn_along_the_median_plane() {
    let world = World::embedded();
    let chart = Chart::new(&world.rig, world.pipeline(LEVEL, 0).skin_plan());
    let middle: Vec<usize> = (0..chart.len()).filter(|&v| chart.vertex(v).place.x.abs() < 1e-4).collect();
    assert!(middle.len() > 50, "{} vertices on the median plane", middle.len());
    for &kind in MarkingKind::ALL {
        let pattern = Pattern { markings: vec![Marking::new(kind, Paint::White)], ..Pattern::plain(Vec3::ZERO) };
        let colouring = Colouring::new(&pattern);
        for &v in &middle {
            let beside = |x: f32| {
                let mut site = chart.vertex(v);
                site.place.x = x;
                colouring.at(&site, |_| 0.0).x
            };
            let torn = (beside(1e-4) - beside(-1e-4)).abs();
            assert!(torn < 0.01, "{} at {}: {torn}", kind.name(), chart.vertex(v).place);
        }
    }
}

#[test]
fn a_coat_is_another_after_a_file() {
    let world = World::embedded();
    let mut dog = world.breed("samoyed").clone();
    dog.look = Look::of(every_marking());
    let again = load_breed(&world.table, "samoyed.ron", &save_breed(&world.table, &dog)).unwrap();
    assert_eq!(again, dog);
    let mut chocolate = world.breed("labrador").clone();
    chocolate.wear("chocolate").unwrap();
    let text = save_breed(&world.table, &chocolate);
    assert!(text.contains("wears: \"chocolate\""), "{text}");
    assert_eq!(load_breed(&world.table, "labrador.ron", &text).unwrap(), chocolate);
}

#[test]
fn marks_of_the_first_version_are_not_read_as_patches() {
    let world = World::embedded();
    let text = "Breed(version: 1, label: \"old\", anatomy: {}, coat: (base: \"#804020\", nose: \"#202020\", lips: \"#202020\", \
                mouth: \"#b06a68\", iris: \"#402010\", marks: [(regions: [\"cheek\"], colour: \"#ffffff\", amount: 0.5)]))";
    let dog = load_breed(&world.table, "old.ron", text).unwrap();
    assert_eq!(dog.look.pattern.markings, [Marking::patch(vec![Region::Cheek], Vec3::ONE, 0.5)]);
    let error = load_breed(&world.table, "old.ron", &text.replace("marks:", "markings:")).unwrap_err();
    assert!(error.to_string().contains("unknown field coat.markings"), "{error}");
}

#[test]
fn a_blend_is_not_the_mean_of_its_coats() {
    let world = World::embedded();
    let mut pipeline = world.pipeline(LEVEL, N);
    let (pug, collie) = (world.breed("pug"), world.breed("border_collie"));
    let [of_pug, of_collie] = [pug, collie].map(|b| hair_colours(&mut pipeline, b));
    let blend = Breed::blend(&world.table, &[(pug, 0.3), (collie, 0.7)]);
    let made = hair_colours(&mut pipeline, &blend);
    for ((made, a), b) in made.iter().zip(&of_pug).zip(&of_collie) {
        assert!(made.abs_diff_eq(*a * 0.3 + *b * 0.7, 1e-5), "{made} of {a} and {b}");
    }
    let again = load_breed(&world.table, "mix.ron", &save_breed(&world.table, &blend)).unwrap();
    assert_eq!(again.look, blend.look);
    // A mixture of mixtures has each coat once.
    let deeper = Breed::blend(&world.table, &[(&blend, 0.5), (pug, 0.5)]);
    assert_eq!(deeper.look.mixed.len(), 1);
}

#[test]
fn leather_does_not_follow_the_pigment() {
    let world = World::embedded();
    let mut lab = world.breed("labrador").clone();
    assert_eq!(lab.look.nose, Eumelanin::Black.nose());
    lab.wear("chocolate").unwrap();
    assert_eq!((lab.look.nose, lab.look.lips), (Eumelanin::Brown.nose(), Eumelanin::Brown.lips()));
}

#[test]
fn a_mistake_in_a_coat_is_told_without_its_place_or_cure() {
    let world = World::embedded();
    let coats = |body: &str| format!("Breed(version: 2, label: \"x\", anatomy: {{}},\n{body}\n)");
    for (body, complaint) in [
        (
            "coat: (base: White, markings: [Msk(colour: White)])",
            "2:32: coat.markings[0]: unknown marking Msk (did you mean Mask?)",
        ),
        ("coat: (base: White, markings: [Mask(extent: 0.5)])", "2:32: coat.markings[0].colour is missing"),
        (
            "coat: (base: White, markings: [Mask(colour: White, extend: 1)])",
            "unknown field coat.markings[0].extend (did you mean extent?)",
        ),
        (
            "coat: (base: White, markings: [Mask(colour: White, extent: 2)])",
            "2:60: coat.markings[0].extent is 2, allowed 0 to 1",
        ),
        ("coat: (base: White, markings: [Blaze(colour: Withe)])", "2:46: coat.markings[0].colour must be a colour"),
        ("coat: (base: White, markings: [5])", "2:32: coat.markings[0] must be a marking"),
        (
            "coat: (base: White, markings: [Patch(colour: White, regions: [\"chek\"])])",
            "unknown region chek (did you mean cheek?)",
        ),
        ("coat: (base: White, markings: [Mask(colour: White, regions: [])])", "unknown field coat.markings[0].regions"),
        ("coat: (base: Phaeomelanin(1.5))", "coat.base is 1.5, allowed 0 to 1"),
        (
            "coat: (base: White, eumelanin: Blck)",
            "coat.eumelanin must be one of Black, Brown, Blue, Lilac, without quotes, found Blck (did you mean Black?)",
        ),
        (
            "coat: (base: White, mixed: [(share: 0.6, base: White), (share: 0.4, base: Eumelanin)])",
            "coat.mixed: the shares sum to 1",
        ),
        ("coat: (markings: [])", "2:7: coat.base is missing"),
        ("coat: (base: White), coats: {}", "found both"),
        ("coats: {}", "found none"),
        ("", "found neither"),
        ("coats: {\"a\": (base: White)}, wears: \"b\"", "wears is \"b\", which is none of coats: a"),
        ("coats: {\"a\": (base: White), \"b\": (base: Whit)}", "coats[\"b\"].base must be a colour"),
    ] {
        let error = load_breed(&world.table, "x.ron", &coats(body)).unwrap_err().to_string();
        assert!(error.contains(complaint), "{body}\n{error}\n{complaint}");
    }
    let mut lab = world.breed("labrador").clone();
    let error = lab.wear("choclate").unwrap_err().to_string();
    assert_eq!(
        error,
        "labrador has no coat 'choclate' (did you mean chocolate?); it comes in yellow, black, chocolate"
    );
}
