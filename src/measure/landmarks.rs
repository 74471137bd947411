//! Named points of a made head, in its frame.

use crate::frame::Frame;
use crate::rig::bone::{BoneMesh, Bones, BonesOfHead, LANDMARKS};
use crate::rig::mouth::TONGUE_TIP;
use crate::rig::{Deformed, Eye, Place, Places, Rig, deform};
use glam::Vec3;

/// On which side of the head a landmark lies. Left is the dog's.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Side {
    /// The dog's left, +X.
    Left,
    /// The dog's right.
    Right,
    /// In the median plane.
    Median,
}

impl Side {
    /// `L`, `R` or `M`, as in the canonical list.
    pub const fn letter(self) -> char {
        match self {
            Self::Left => 'L',
            Self::Right => 'R',
            Self::Median => 'M',
        }
    }
}

/// A named point of one head.
#[derive(Clone, Debug, PartialEq)]
pub struct Landmark {
    /// Id of the canonical list: K and two digits on the skin, S on bone. The left and the right one share it.
    pub id: String,
    /// What it is, in words.
    pub name: String,
    /// Where it lies to the median plane.
    pub side: Side,
    /// What it is a point of: `skin`, eyeballs included, or `bone`.
    pub layer: &'static str,
    /// Metres, in the head's frame.
    pub position: Vec3,
}

/// The landmarks of the bone by id, the left one before the right: vertices of skull and mandible, and constructed points
/// such as the condyle's centre. `values`: SI, one for each row of the rig's table; `places`: where skull and mandible are
/// ([`crate::frame::Pipeline::places`], or the default at rest).
pub fn bone_landmarks(rig: &Rig, bones: &Bones, values: &[f32], places: &Places) -> Vec<Landmark> {
    let mut of_head = BonesOfHead::default();
    bones.shape(&rig.measures(values), &rig.proportions(values), &mut of_head);
    let mut all = Vec::new();
    // Those of the list that are only there to place teeth have another letter.
    for landmark in LANDMARKS.iter().filter(|l| l.id.starts_with('S')) {
        let Some(position) = bones.landmark(landmark.id, &of_head) else { continue };
        // What is no vertex belongs to the skull: the condyle's centre is that of its joint.
        let place = if landmark.on == Some(BoneMesh::Mandible) { &places.mandible } else { &places.head };
        let mut add = |side: Side, position: Vec3| {
            let position = place.point(position);
            let (id, name) = (landmark.id.to_owned(), landmark.name.to_owned());
            all.push(Landmark { id, name, side, layer: "bone", position });
        };
        if landmark.canonical.x == 0.0 {
            add(Side::Median, position);
        } else {
            add(Side::Left, position);
            add(Side::Right, position * Vec3::new(-1.0, 1.0, 1.0));
        }
    }
    all
}

/// The landmarks of the skin and the eyeballs by id, the left one before the right. `values` (SI, one per row of the
/// rig's table) are those that the frame was made from.
///
/// A landmark of the skin is a vertex of the frame's skin, whatever its level; at level 0 the middle of a face is that of
/// its corners.
pub fn skin_landmarks(rig: &Rig, values: &[f32], frame: &Frame<'_>) -> Vec<Landmark> {
    let mut all = Vec::new();
    let mut add = |id: &str, name: &str, side: Side, position: Vec3| {
        all.push(Landmark { id: id.to_owned(), name: name.to_owned(), side, layer: "skin", position });
    };
    let part = |name: &str| frame.parts.iter().find(|p| p.topology.name == name).map_or(&[][..], |p| p.positions);
    let skin = part("skin");
    for landmark in rig.half().skin_landmarks() {
        let first = if landmark.right.is_some() { Side::Left } else { Side::Median };
        let places = [(first, Some(landmark.place)), (Side::Right, landmark.right)];
        for (side, place) in places {
            if let Some(position) = place.and_then(|place| at(rig, skin, place)) {
                add(&landmark.id, &landmark.name, side, position);
            }
        }
    }
    if let Some(&tip) = part("tongue").get(TONGUE_TIP) {
        add("K52", "tongue tip", Side::Median, tip);
    }
    let mut head = Deformed::default();
    // Where the eyes are not shown they are where they are at rest.
    let eyes = match frame.eyes {
        [left, right] => [left.eye, right.eye],
        _ => {
            rig.deform(values, deform::ROUNDS, &mut head);
            head.eyes
        }
    };
    let eyes = eyes.iter().zip([(Side::Left, "eye_L"), (Side::Right, "eye_R")]);
    for (eye, (side, name)) in eyes {
        add("K33", "globe centre", side, eye.centre);
        add("K34", "corneal apex", side, apex(eye, part(name)));
    }
    // Stable: the left one stays before the right.
    all.sort_by(|a, b| a.id.cmp(&b.id));
    all
}

/// A vertex of the refined skin. Control vertices come first, then the middles of control faces.
fn at(rig: &Rig, skin: &[Vec3], place: Place) -> Option<Vec3> {
    let n_control = rig.mesh().n_vertices();
    match place {
        Place::Vertex(v) => skin.get(v as usize).copied(),
        Place::Face(f) if skin.len() > n_control => skin.get(n_control + f as usize).copied(),
        Place::Face(f) => {
            let corners = rig.mesh().indices().chunks_exact(3).nth(f as usize)?;
            let sum = corners.iter().try_fold(Vec3::ZERO, |sum, &v| Some(sum + *skin.get(v as usize)?))?;
            Some(sum / 3.0)
        }
    }
}

/// The vertex of an eyeball that lies farthest along its gaze.
fn apex(eye: &Eye, ball: &[Vec3]) -> Vec3 {
    let along = |p: &&Vec3| (**p - eye.centre).dot(eye.axes[2]);
    ball.iter().max_by(|a, b| along(a).total_cmp(&along(b))).copied().unwrap_or(eye.centre)
}
