//! What a dog does at this moment, apart from who it is.

/// The state of one head; the default is at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Pose {
    /// How far the lids of the left eye and of the right are closed: 0 as wide open as the measures say, 1 shut. Taken
    /// into this range.
    pub lids_closed: [f32; 2],
}
