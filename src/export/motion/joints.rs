//! Which joints there are.
//!
//! Neck and head turn about the same joint behind the occiput: the neck's cut end makes a part of the head's turn.

/// Number of joints.
pub const N_JOINTS: usize = 15;

pub(super) const NECK: usize = 0;
pub(super) const HEAD: usize = 1;
pub(super) const JAW: usize = 2;
/// Left and right.
pub(super) const EYES: [usize; 2] = [3, 4];
/// Left and right, each from its base.
pub(super) const EARS: [[usize; 3]; 2] = [[5, 6, 7], [8, 9, 10]];
/// From the root.
pub(super) const TONGUE: [usize; 4] = [11, 12, 13, 14];

/// Their names in a file.
pub const JOINT_NAMES: [&str; N_JOINTS] = [
    "neck",
    "head",
    "jaw",
    "eye_L",
    "eye_R",
    "ear_base_L",
    "ear_middle_L",
    "ear_tip_L",
    "ear_base_R",
    "ear_middle_R",
    "ear_tip_R",
    "tongue_1",
    "tongue_2",
    "tongue_3",
    "tongue_4",
];

/// The joint that each hangs on; it stands before it.
pub(super) const PARENTS: [Option<usize>; N_JOINTS] = [
    None,
    Some(NECK),
    Some(HEAD),
    Some(HEAD),
    Some(HEAD),
    Some(HEAD),
    Some(5),
    Some(6),
    Some(HEAD),
    Some(8),
    Some(9),
    Some(JAW),
    Some(11),
    Some(12),
    Some(13),
];

/// How a thing between joints goes with them: `at` along a chain whose joints stand at `centres` (rising), the two nearest
/// ones and how much of the second.
pub(super) fn between(at: f32, centres: &[f32]) -> (usize, usize, f32) {
    let last = centres.len() - 1;
    let next = centres.partition_point(|&c| c <= at);
    if next == 0 || next > last {
        let end = next.min(last);
        return (end, end, 0.0);
    }
    let (low, high) = (centres[next - 1], centres[next]);
    (next - 1, next, (at - low) / (high - low))
}
