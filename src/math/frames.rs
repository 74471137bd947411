//! The one frame of the head: control positions, refined surfaces, poses at rest and the .glb all live in it.
//!
//! Right-handed, in metres. The origin is midway between the two mandibular condyles, where the jaw hinges;
//! at rest the hard palate is parallel to +Z. Left and right are the dog's.
//!
//! ```text
//!        seen from the dog's left (+X looks at you)          seen from the front (+Z looks at you)
//!
//!          +Y up                                                        +Y up
//!           |     ___                                             /\_____|_____/\
//!        /\_|____/stop\______                                    |  o    |    o  |
//!       |   |         ‾‾‾‾‾‾‾‾ nose                               \      |      /
//!       |   o-----------------|----> +Z forward             right  \     o-----/----> +X  left
//!        \   condyle   _______/                                     \___nose__/
//!         \___________/ chin
//! ```
//!
//! It is also the frame of glTF, so that export converts nothing. Triangles are counter-clockwise seen from outside.

use glam::Vec3;

/// Towards the dog's left.
pub const LEFT: Vec3 = Vec3::X;
/// Towards the crown, at rest.
pub const UP: Vec3 = Vec3::Y;
/// Out of the nose, parallel to the hard palate at rest.
pub const FORWARD: Vec3 = Vec3::Z;

/// The point on the other side of the median plane.
pub fn mirrored(point_in_head: Vec3) -> Vec3 {
    Vec3::new(-point_in_head.x, point_in_head.y, point_in_head.z)
}

#[cfg(test)]
mod tests {
    use super::{FORWARD, LEFT, UP};

    #[test]
    fn frame_is_left_handed() {
        assert_eq!(LEFT.cross(UP), FORWARD);
    }
}
