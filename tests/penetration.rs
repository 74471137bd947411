//! Nothing goes through anything else as a head moves: skin and bone, lids and eyeball, tongue and bone, tongue and teeth,
//! lips and teeth, ears and head, over units alone and in pairs, expressions and clips.
//!
//! A depth is what a pose adds to the head at rest, in millimetres of a head with a skull of 200 mm.
//! `cargo test --test penetration -- --nocapture` prints the worst cases; `LONDRA_SWEEP=all` takes every pair on every breed.
#![cfg(feature = "head")]

#[path = "support/settings.rs"]
mod settings;
#[path = "support/solid.rs"]
mod solid;

use glam::Vec3;
use londra::anatomy::{Breed, Region};
use londra::frame::{Frame, Layers, Pipeline};
use londra::motion::{Activation, Group, Library, Pose, Sides};
use londra::rig::bone::teeth::{self, TOOTH_VERTICES};
use londra::rig::bone::{BoneField, BoneMesh, Bones, targets};
use londra::rig::implicit::{Implicit, Layer};
use londra::rig::{Deformed, Eye, Places, Proportions, Rig, deform};
use settings::sweeps_all;
use solid::Solid;
use std::collections::BTreeMap;
use std::sync::Arc;

const BREEDS: [&str; 8] =
    ["german_shepherd", "labrador", "pug", "borzoi", "bulldog", "beagle", "chihuahua", "saint_bernard"];
/// Breeds whose pairs of units are in the sample.
const PAIRED: usize = 1;
/// Every so many pairs is in the sample.
const EVERY: usize = 7;
const LEVEL: u32 = 2;

/// Pairs that are in the sample of every breed: what once went wrong.
const ALWAYS: [&str; 1] = ["AU12+AU27"];

/// What may touch what.
const CHECKS: [&str; 7] = [
    "skin in skull",
    "skin in mandible",
    "lids in eyeball",
    "tongue in bone",
    "tongue in teeth",
    "lips in teeth",
    "ears in head",
];
/// How deep any of it goes at most, millimetres.
const BOUND: f32 = 0.5;

/// A head, and what is measured on it at rest.
struct Subject {
    id: &'static str,
    breed: Breed,
    bones: [BoneField; 2],
    shape: Proportions,
    surface: Implicit,
    /// Metres of a millimetre of the 200 mm head.
    unit: f32,
    /// By check and vertex of its part: signed distance at rest, metres.
    rest: Vec<Vec<f32>>,
}

struct World {
    rig: Arc<Rig>,
    breeds: Vec<Breed>,
    library: Library,
    pipeline: Pipeline,
    /// Vertices of the refined skin: haired skin, lips, ears.
    haired: Vec<usize>,
    lips: Vec<usize>,
    ears: Vec<usize>,
    /// What does not run behind the eyeball, where the skin is sewn up out of sight.
    lids: Vec<usize>,
    teeth: [Vec<u32>; 2],
}

fn part<'a>(frame: &'a Frame<'a>, name: &str) -> &'a [Vec3] {
    frame.parts.iter().find(|p| p.topology.name == name).map_or(&[], |p| p.positions)
}

impl World {
    fn new() -> Self {
        let settings::World { rig, breeds, .. } = settings::World::embedded();
        let mut pipeline = Pipeline::new(rig.clone(), LEVEL).expect("a level");
        pipeline.set_layers(Layers::parse("skin,eyes,teeth,tongue,bone").expect("layers")).expect("parts");
        // Regions of refined vertices: of the control face that each lies on.
        let regions = rig.half().whole_regions();
        let control = rig.mesh().indices().as_chunks::<3>().0;
        let plan = pipeline.skin_plan().clone();
        let mut of: Vec<Option<[Region; 3]>> = vec![None; plan.n_vertices()];
        for (face, &parent) in plan.indices().as_chunks::<3>().0.iter().zip(plan.face_parent()) {
            let own = control[parent as usize].map(|v| regions[v as usize]);
            face.iter().for_each(|&v| of[v as usize] = Some(own));
        }
        let all = |want: &dyn Fn(Region) -> bool| -> Vec<usize> {
            (0..of.len()).filter(|&v| of[v].is_some_and(|r| r.iter().all(|&r| want(r)))).collect()
        };
        // Leather off its base, which is part of the head.
        let h = rig.plan().handles();
        let base: Vec<u32> =
            h.a[..2].iter().flatten().flat_map(|&v| [u32::from(v), rig.image(usize::from(v)) as u32]).collect();
        let pole = [u32::from(h.ep), rig.image(usize::from(h.ep)) as u32];
        let mut away = vec![[true; 2]; plan.n_vertices()];
        for (face, &parent) in plan.indices().as_chunks::<3>().0.iter().zip(plan.face_parent()) {
            let own = &control[parent as usize];
            for &v in face {
                away[v as usize][0] &= !own.iter().any(|v| base.contains(v));
                away[v as usize][1] &= !own.iter().any(|v| pole.contains(v));
            }
        }
        let is_ear = |r| matches!(r, Region::EarInner | Region::EarOuter | Region::EarEdge);
        let is_lip = |r| matches!(r, Region::UpperLip | Region::LowerLip | Region::WhiskerPad | Region::Chin);
        let is_inside = |r| matches!(r, Region::Mouth | Region::Nostril | Region::Lid);
        Self {
            haired: all(&|r| !is_ear(r) && !is_inside(r)),
            lips: all(&is_lip),
            ears: all(&is_ear).into_iter().filter(|&v| away[v][0]).collect(),
            lids: (0..away.len()).filter(|&v| away[v][1]).collect(),
            teeth: [true, false].map(Bones::tooth_indices),
            library: Library::embedded().expect("the tables"),
            rig,
            breeds,
            pipeline,
        }
    }

    fn subject(&mut self, id: &'static str) -> Subject {
        let breed = self.breeds.iter().find(|b| b.id == id).cloned().expect(id);
        let (measures, shape) = (self.rig.measures(&breed.values), self.rig.proportions(&breed.values));
        let t = targets(&measures, &shape);
        let bones = [BoneMesh::Skull, BoneMesh::Mandible].map(|bone| BoneField::new(bone, &t, teeth::unit(&t)));
        let mut head = Deformed::default();
        self.rig.deform(&breed.values, deform::ROUNDS, &mut head);
        let unit = self.rig.of_head(&breed.values, &mut head).unit;
        let surface = Implicit::new(&shape);
        let mut subject = Subject { id, breed, bones, shape, surface, unit, rest: Vec::new() };
        subject.rest = self.distances(&subject, &Pose::default());
        subject
    }

    /// Signed distances, negative inside, of every vertex of the checks in their order.
    fn distances(&mut self, s: &Subject, pose: &Pose) -> Vec<Vec<f32>> {
        let mut head = Deformed::default();
        self.rig.deform(&s.breed.values, deform::ROUNDS, &mut head);
        self.rig.pose(&s.breed.values, pose, &mut head);
        let Places { head: skull, mandible, .. } = head.places;
        self.pipeline.set_pose(*pose);
        let frame = self.pipeline.update(&s.breed);
        let skin = part(&frame, "skin");
        let tongue = part(&frame, "tongue");
        let places = [skull, mandible];
        let to_bone = |k: usize, p: Vec3| s.bones[k].distance(places[k].back(p));
        let eyes: Vec<Eye> = frame.eyes.iter().map(|e| e.eye).collect();
        let lids = self.lids.iter().map(|&v| skin[v]).map(|p| {
            let off = |e: &Eye| {
                let d = p - e.centre;
                let far = d.length();
                if far > 1.5 * e.radius { f32::INFINITY } else { far - e.reach(d / far.max(1e-9)) }
            };
            eyes.iter().map(off).fold(f32::INFINITY, f32::min)
        });
        let crowns = ["teeth_upper", "teeth_lower"].map(|name| part(&frame, name));
        let in_teeth = |p: Vec3| -> f32 {
            let mut deepest = 0.0f32;
            for (at, indices) in crowns.iter().zip(&self.teeth) {
                for (k, tooth) in at.chunks(TOOTH_VERTICES).enumerate() {
                    let low = tooth.iter().fold(Vec3::INFINITY, |a, &q| a.min(q));
                    let high = tooth.iter().fold(Vec3::NEG_INFINITY, |a, &q| a.max(q));
                    if p.cmpge(low).all() && p.cmple(high).all() {
                        let per = indices.len() / (at.len() / TOOTH_VERTICES);
                        let body = Solid { at, indices: &indices[k * per..(k + 1) * per] };
                        deepest = deepest.max(body.depth(&[p]));
                    }
                }
            }
            -deepest
        };
        let to_head = |p: Vec3| s.surface.distance(s.shape.proportional(skull.back(p)), Layer::Whole) * s.shape.scale;
        vec![
            self.haired.iter().map(|&v| to_bone(0, skin[v])).collect(),
            self.haired.iter().map(|&v| to_bone(1, skin[v])).collect(),
            lids.collect(),
            tongue.iter().map(|&p| to_bone(0, p).min(to_bone(1, p))).collect(),
            tongue.iter().map(|&p| in_teeth(p)).collect(),
            self.lips.iter().map(|&v| in_teeth(skin[v])).collect(),
            self.ears.iter().map(|&v| to_head(skin[v])).collect(),
        ]
    }
}

/// Every pose of the sample by name.
fn poses(library: &Library, with_pairs: bool) -> Vec<(String, Pose)> {
    let units = &library.units.units;
    let mut out = Vec::new();
    let moving: Vec<usize> = (0..units.len()).filter(|&u| units[u].group != Group::Gross).collect();
    let put = |a: &mut Activation, u: usize, value: f32| {
        // A tongue goes to one side.
        *a.get_mut(u) =
            if units[u].group == Group::Tongue && units[u].sides == Sides::Each { [value, 0.0] } else { [value; 2] };
    };
    for &u in &moving {
        for value in [0.5, 1.0] {
            let mut a = Activation::default();
            put(&mut a, u, value);
            out.push((format!("{}={value}", units[u].id), library.pose_of(&a)));
        }
        if units[u].sides == Sides::Each {
            let mut a = Activation::default();
            *a.get_mut(u) = [1.0, 0.0];
            out.push((format!("{}L", units[u].id), library.pose_of(&a)));
        }
    }
    for e in &library.expressions {
        out.push((format!("expression {}", e.id), library.pose_of(&e.still())));
    }
    for clip in &library.clips {
        for k in 0..6 {
            let time = clip.seconds * f64::from(k) / 6.0;
            out.push((format!("clip {} at {time:.2}", clip.id), library.pose(&clip.at(time), time, |_| ())));
        }
    }
    let mut n = 0;
    for (i, &u) in moving.iter().enumerate() {
        for &w in &moving[i + 1..] {
            n += 1;
            let name = format!("{}+{}", units[u].id, units[w].id);
            if sweeps_all() || with_pairs && n % EVERY == 0 || ALWAYS.contains(&name.as_str()) {
                let mut a = Activation::default();
                put(&mut a, u, 1.0);
                put(&mut a, w, 1.0);
                out.push((name, library.pose_of(&a)));
            }
        }
    }
    out
}

#[test]
fn something_goes_through_something_else_as_the_head_moves() {
    let mut world = World::new();
    // The worst of each check and breed.
    let mut worst: BTreeMap<(usize, &str), (f32, String)> = BTreeMap::new();
    let mut n = 0;
    for (k, id) in BREEDS.into_iter().enumerate() {
        let subject = world.subject(id);
        for (name, pose) in poses(&world.library, k < PAIRED) {
            n += 1;
            let now = world.distances(&subject, &pose);
            for (check, (now, rest)) in now.iter().zip(&subject.rest).enumerate() {
                let added = |(now, rest): (&f32, &f32)| rest.min(0.0) - now;
                let deepest = now.iter().zip(rest).map(added).fold(0.0, f32::max) / subject.unit;
                let entry = worst.entry((check, subject.id)).or_default();
                if deepest > entry.0 {
                    *entry = (deepest, name.clone());
                }
            }
        }
    }
    println!("{n} poses; worst added depth, mm on a head with a skull of 200 mm");
    let mut too_deep = Vec::new();
    for ((check, id), (depth, pose)) in &worst {
        let what = CHECKS[*check];
        let line = format!("{what:18} {id:16} {depth:6.2} {pose}");
        println!("{line}");
        if *depth > BOUND {
            too_deep.push(line);
        }
    }
    assert!(too_deep.is_empty(), "{} deeper than allowed:\n{}", too_deep.len(), too_deep.join("\n"));
}
