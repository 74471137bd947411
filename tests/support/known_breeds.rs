//! What the breeds are held against: sizes and indices from outside the program, each with its standing.
//!
//! Estimates: skull length 200 (M/30)^0.30 (52.4/CI)^0.62 mm for a mass M in kg and a cephalic index CI that was placed
//! between the class averages 39, 52 and 81 (uncertain by 5); zygomatic width is their product. Measured are single skulls.
#![allow(dead_code)] // not every test file reads all of it

use Standing::{Computed, Estimated, Measured};

/// How a number came about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Standing {
    /// On a specimen or on live dogs.
    Measured,
    /// From a measured number by a stated rule.
    Computed,
    /// From breed standards, class averages and laws of size.
    Estimated,
}

/// A number and its standing.
pub type Known = (f32, Standing);

/// One breed.
pub struct Reference {
    /// Of the breed.
    pub id: &'static str,
    /// FCI group; 0 where there is none.
    pub group: u8,
    /// Skull length, mm.
    pub skull: Known,
    /// Zygomatic width, mm.
    pub width: Known,
    /// Cephalic index, 100 width / length, on bone.
    pub index: Known,
    /// Craniofacial ratio of live dogs: muzzle over cranium, the stop between them, a tape over the vault.
    pub ratio: Known,
    /// Typical mass, kg.
    pub mass: f32,
}

const fn row(
    id: &'static str,
    group: u8,
    skull: Known,
    width: Known,
    index: Known,
    ratio: Known,
    mass: f32,
) -> Reference {
    Reference { id, group, skull, width, index, ratio, mass }
}

/// An estimate.
const fn est(value: f32) -> Known {
    (value, Estimated)
}

/// Every breed but the archetypes, sorted by id.
#[rustfmt::skip]
pub const REFERENCES: &[Reference] = &[
    row("afghan_hound", 10, est(214.0), est(92.0), est(43.0), est(0.85), 25.0),
    row("akita", 5, est(200.0), est(120.0), est(60.0), est(0.58), 40.0),
    row("australian_shepherd", 1, est(184.0), est(99.0), est(54.0), est(0.6), 24.0),
    row("basenji", 5, est(143.0), est(76.0), est(53.0), est(0.6), 10.0),
    row("basset", 6, est(205.0), est(98.0), est(48.0), est(0.72), 27.0),
    row("beagle", 6, est(144.0), est(79.0), est(55.0), est(0.62), 11.0),
    row("bedlington", 3, est(142.0), est(65.0), est(46.0), est(0.76), 9.0),
    row("bernese", 2, est(211.0), est(121.0), est(57.0), est(0.57), 43.0),
    row("bloodhound", 6, est(243.0), est(114.0), est(47.0), est(0.74), 46.0),
    row("border_collie", 1, est(172.0), est(90.0), est(52.0), est(0.63), 18.0),
    row("borzoi", 10, est(254.0), est(102.0), est(40.0), est(0.92), 38.0),
    row("boston_terrier", 9, est(104.0), est(87.0), est(84.0), est(0.17), 9.0),
    row("boxer", 2, est(164.0), est(118.0), est(72.0), est(0.36), 30.0),
    row("bull_terrier", 3, est(202.0), est(101.0), est(50.0), est(0.8), 28.0),
    row("bulldog", 2, est(131.0), est(122.0), est(93.0), est(0.2), 24.0),
    row("cavalier", 9, est(102.0), est(76.0), est(74.0), est(0.38), 6.5),
    row("chihuahua", 9, est(79.0), est(54.0), est(68.0), est(0.42), 2.3),
    row("chow_chow", 5, est(168.0), est(111.0), est(66.0), est(0.48), 27.0),
    row("corgi", 1, est(142.0), est(80.0), est(56.0), est(0.58), 11.0),
    row("dachshund", 4, est(151.0), est(70.0), est(46.0), est(0.75), 9.0),
    row("dalmatian", 6, est(197.0), est(100.0), est(51.0), est(0.64), 27.0),
    row("dobermann", 2, est(239.0), est(105.0), est(44.0), est(0.75), 38.0),
    row("english_cocker", 8, est(154.0), est(83.0), est(54.0), est(0.6), 13.5),
    row("english_toy_terrier", 3, est(108.0), est(52.0), est(48.0), est(0.7), 3.3),
    row("french_bulldog", 9, est(107.0), est(99.0), est(92.0), est(0.18), 12.0),
    row("german_shepherd", 1, est(212.0), est(106.0), est(50.0), est(0.68), 33.0),
    row("golden_retriever", 8, est(196.0), est(108.0), est(55.0), est(0.6), 31.0),
    row("great_dane", 2, est(270.0), est(124.0), est(46.0), est(0.7), 62.0),
    row("greyhound", 10, (210.0, Computed), (103.0, Measured), est(47.0), est(0.8), 30.0),
    row("irish_setter", 7, est(212.0), est(100.0), est(47.0), est(0.72), 29.0),
    row("irish_wolfhound", 10, est(268.0), est(121.0), est(45.0), est(0.76), 58.0),
    row("jack_russell", 3, est(118.0), est(66.0), est(56.0), est(0.58), 6.0),
    row("labrador", 8, est(198.0), est(107.0), est(54.0), est(0.62), 31.0),
    row("miniature_schnauzer", 2, est(130.0), est(70.0), est(54.0), est(0.62), 7.5),
    row("mixed", 0, est(178.0), est(94.3), est(53.0), est(0.63), 20.5),
    row("newfoundland", 2, est(229.0), est(135.0), est(59.0), est(0.54), 60.0),
    row("papillon", 9, est(97.0), est(58.0), est(60.0), est(0.5), 3.5),
    row("pekingese", 9, est(76.0), est(76.0), est(100.0), est(0.05), 4.5),
    row("pomeranian", 5, est(82.0), est(52.0), est(64.0), est(0.44), 2.3),
    row("poodle", 9, est(200.0), est(94.0), est(47.0), est(0.72), 24.0),
    row("pug", 9, est(93.0), est(88.0), est(95.0), est(0.08), 8.0),
    row("rottweiler", 2, est(210.0), est(130.0), est(62.0), est(0.54), 50.0),
    row("rough_collie", 1, est(214.0), est(94.0), est(44.0), est(0.8), 26.0),
    row("saint_bernard", 2, est(237.0), est(147.0), est(62.0), est(0.5), 75.0),
    row("samoyed", 5, est(178.0), est(101.0), est(57.0), est(0.56), 24.0),
    row("shar_pei", 2, est(162.0), est(107.0), est(66.0), est(0.5), 24.0),
    row("shiba", 5, est(133.0), est(77.0), est(58.0), est(0.55), 9.5),
    row("shih_tzu", 9, est(93.0), est(77.0), est(82.0), est(0.2), 6.0),
    row("siberian_husky", 5, est(179.0), est(97.0), est(54.0), est(0.6), 22.0),
    row("staffordshire", 3, est(138.0), est(94.0), est(68.0), (0.5, Measured), 15.0),
    row("weimaraner", 7, est(216.0), est(106.0), est(49.0), est(0.68), 34.0),
    row("whippet", 10, est(168.0), est(81.0), est(48.0), est(0.74), 14.0),
    row("wolf", 0, (265.0, Computed), (142.5, Measured), (53.8, Computed), est(0.85), 40.0),
    row("yorkshire_terrier", 3, est(90.0), est(54.0), est(60.0), est(0.5), 2.8),
];

/// Skull lengths that somebody has measured, mm, single specimens: they bound the estimates, breed means they are not.
pub const MEASURED_SKULLS: &[(&str, f32)] = &[
    ("bulldog", 170.0),
    ("chihuahua", 125.0),
    ("german_shepherd", 249.0),
    ("great_dane", 267.0),
    ("pekingese", 117.0),
];

/// Skull, cranial and facial index of the classes: recalled, so indices alone are compared, within 5 %.
pub const CLASSES: &[(&str, [f32; 3])] = &[
    ("archetype_brachy", [81.0, 57.0, 215.0]),
    ("archetype_dolicho", [39.0, 48.0, 81.0]),
    ("archetype_meso", [52.0, 56.0, 111.0]),
];

/// Live craniofacial ratio and facial over cranial length on bone, one beside the other: ours, a curve through the class
/// averages and the first breeds. The live ratio takes a tape over the vault and a stop on the skin, so the two are not
/// one number; a breed's file is compared by going back along this curve.
pub const LIVE_AND_BONE: &[(f32, f32)] = &[
    (0.0, 0.29),
    (0.08, 0.315),
    (0.2, 0.335),
    (0.36, 0.47),
    (0.42, 0.57),
    (0.5, 0.68),
    (0.56, 0.77),
    (0.62, 0.865),
    (0.68, 0.944),
    (0.75, 1.05),
    (0.8, 1.09),
    (0.85, 1.125),
    (0.92, 1.165),
    (1.0, 1.21),
];

/// The live craniofacial ratio that goes with facial over cranial length on bone.
pub fn live_ratio(bone: f32) -> f32 {
    let at = LIVE_AND_BONE.partition_point(|p| p.1 < bone).clamp(1, LIVE_AND_BONE.len() - 1);
    let [(live0, bone0), (live1, bone1)] = [LIVE_AND_BONE[at - 1], LIVE_AND_BONE[at]];
    live0 + (live1 - live0) * (bone - bone0) / (bone1 - bone0)
}
