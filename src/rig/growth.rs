//! Age and sex: from a grown dog's measures to those of the same dog as a puppy, or as a bitch or a dog.
//!
//! Growth is allometric: each measure goes with a power of age, so that a face grows faster than its braincase. Exponents
//! against each other are those of German shepherds between two ages, in which the face grew by 1.37 where the cranium grew
//! by 1.17 in length and by 1.03 in width (Onar 1999); the eyeball's is 0.165 (Agnew and others 2007). How fast the face
//! itself grows is estimated. A dog of 52 weeks is grown.

use super::proportions::Measures;
use crate::math::ops;

/// Weeks after which nothing grows.
const GROWN: f32 = 52.0;
/// Of the face; ln 1.17 / ln 1.37 and ln 1.03 / ln 1.37 of it are the cranium's length and width.
const FACE: f32 = 0.35;
const CRANIUM: f32 = 0.499 * FACE;
const WIDTH: f32 = 0.094 * FACE;
const EYEBALL: f32 = 0.165;
/// Crests, muscles and loose skin come last.
const RELIEF: f32 = 0.8;
/// How much rounder a newborn forehead is.
const DOME: f32 = 0.9;

/// How much longer a dog's head is than that of the mean of both sexes; a bitch's is as much shorter.
const LONGER: f32 = 0.02;
/// The same for muscles and crests.
const STRONGER: f32 = 0.08;

/// The measures at the age and of the sex that they name. Grown and of no sex they are unchanged to the bit.
pub(super) fn grown(adult: &Measures) -> Measures {
    let mut m = *adult;
    if m.age < GROWN {
        age(&mut m);
    }
    if m.sex != 0.0 {
        sex(&mut m);
    }
    m
}

/// How much of a puppy's coat a dog has at an age in weeks, 0 to 1: all of it up to eight weeks, none from ten months on, when
/// it has been shed. Estimated.
pub(super) fn youth(age: f32) -> f32 {
    ((43.0 - age) / (43.0 - 8.0)).clamp(0.0, 1.0)
}

fn age(m: &mut Measures) {
    let part = (m.age / GROWN).max(0.02);
    let by = |exponent: f32| ops::powf(part, exponent);
    let (face, cranium, width, relief) = (by(FACE), by(CRANIUM), by(WIDTH), by(RELIEF));
    m.cranial_length *= cranium;
    m.cranial_width *= width;
    m.cranial_height *= by(0.5 * (CRANIUM + WIDTH));
    m.forehead_dome += DOME * (1.0 - cranium);
    for crest in
        [&mut m.occiput, &mut m.furrow, &mut m.temporalis, &mut m.masseter, &mut m.brow, &mut m.dewlap, &mut m.haw]
    {
        *crest *= relief;
    }
    m.facial_length *= face;
    let between = by(0.5 * (FACE + CRANIUM));
    for length in of_face(m) {
        *length *= between;
    }
    for length in of_cranium(m) {
        *length *= cranium;
    }
    m.eyeball_diameter *= by(EYEBALL);
}

fn sex(m: &mut Measures) {
    let male = m.sex.clamp(-1.0, 1.0);
    let (longer, stronger) = (1.0 + LONGER * male, 1.0 + STRONGER * male);
    for muscle in [&mut m.occiput, &mut m.temporalis, &mut m.masseter, &mut m.brow, &mut m.dewlap] {
        *muscle *= stronger;
    }
    // All lengths but the eyeball, which does not depend on sex (Chiwitt and others 2017).
    for length in of_face(m) {
        *length *= longer;
    }
    for length in of_cranium(m) {
        *length *= longer;
    }
    for length in [&mut m.cranial_length, &mut m.cranial_width, &mut m.cranial_height, &mut m.facial_length] {
        *length *= longer;
    }
    // A dog's neck is stronger still.
    m.neck_width *= longer;
    m.neck_depth *= longer;
}

/// Lengths that grow with the face, and half as much with the cranium: muzzle, nose, lips, ears' leather, neck.
fn of_face(m: &mut Measures) -> [&mut f32; 18] {
    [
        &mut m.muzzle_width_root,
        &mut m.muzzle_width_tip,
        &mut m.muzzle_depth_root,
        &mut m.muzzle_depth_tip,
        &mut m.nose_width,
        &mut m.nose_height,
        &mut m.nose_projection,
        &mut m.nose_lift,
        &mut m.nasal_arch,
        &mut m.flews,
        &mut m.overjet,
        &mut m.jaw_depth,
        &mut m.chin,
        &mut m.mouth_corner,
        &mut m.ear_length,
        &mut m.ear_width,
        &mut m.neck_width,
        &mut m.neck_depth,
    ]
}

/// Lengths that grow with the cranium.
fn of_cranium(m: &mut Measures) -> [&mut f32; 10] {
    [
        &mut m.zygomatic_width,
        &mut m.zygomatic_drop,
        &mut m.eye_spacing,
        &mut m.eye_height,
        &mut m.eye_depth,
        &mut m.ear_base,
        &mut m.ear_set_height,
        &mut m.ear_set_back,
        &mut m.ear_set_width,
        &mut m.ear_thickness,
    ]
}
