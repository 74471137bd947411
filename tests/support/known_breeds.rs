//! How what a breed is held against is compared with its file. The references themselves stand in `rigs/breeds`.
#![allow(dead_code)] // not every test file reads all of it

use londra::anatomy::Breed;

/// The number that a breed is held against.
pub fn reference(breed: &Breed, quantity: &str) -> f32 {
    let found = breed.reference(quantity);
    found.unwrap_or_else(|| panic!("{}: no reference for {quantity}", breed.id)).value as f32
}

/// Averages of a class rather than a breed: indices alone are known.
pub fn is_class(breed: &Breed) -> bool {
    breed.id.starts_with("archetype_")
}

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
