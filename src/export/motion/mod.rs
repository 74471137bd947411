//! A head that moves elsewhere: joints with skin weights, morph targets for units, and animations.
//!
//! Joints carry what turns; a target carries a unit's shape, or what its joints leave over of it. Everything is measured on
//! the posed head itself, so that a file at a unit's 1 is that head.

mod bend;
mod clips;
mod joints;
mod keys;
mod mix;
mod names;
mod puppet;
mod rigid_fit;
mod selection;
mod targets;
mod weights;
mod write;

pub use clips::{Clip, FRAMES_PER_SECOND, JointTrack};
pub use joints::{JOINT_NAMES, N_JOINTS};
pub use selection::{Selection, SelectionError};
pub use targets::{Kind, Moved, Source, Target};
pub use weights::Influences;
pub(super) use write::Mover;

use crate::anatomy::Breed;
use crate::frame::{Frame, Part, Pipeline};
use crate::motion::{Activation, Library, Pose};
use glam::Vec3;
use mix::Mix;
use puppet::Puppet;
use targets::Drawn;
use weights::Weighing;

/// What a file needs for a head to move.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Motion {
    /// Where each of [`JOINT_NAMES`] is at rest, metres; none turns anything there.
    pub joints: Vec<Vec3>,
    /// The parts of the frame, in its order.
    pub parts: Vec<MovingPart>,
    /// Targets, the same for every part.
    pub targets: Vec<Target>,
    /// Reels of units, then expressions, then clips.
    pub clips: Vec<Clip>,
}

/// How one part hangs on the joints.
#[derive(Clone, Debug, PartialEq)]
pub struct MovingPart {
    /// Its name in the frame.
    pub name: &'static str,
    /// One for each vertex to draw.
    pub influences: Vec<Influences>,
}

impl Motion {
    /// Poses the head of `breed` in every unit that is selected, and plays every clip. `pipeline` has the level and the layers
    /// of the frame that is written, and shows the breed at rest afterwards.
    pub fn bake(pipeline: &mut Pipeline, breed: &Breed, library: &Library, selection: &Selection) -> Self {
        let mut puppet = Puppet::new(pipeline.rig().clone(), &breed.values);
        pipeline.set_pose(Pose::default());
        let rest = pipeline.update(breed);
        let weighing = Weighing::new(&puppet, &rest);
        let parts: Vec<MovingPart> = rest
            .parts
            .iter()
            .map(|part| MovingPart { name: part.topology.name, influences: weighing.of_part(part) })
            .collect();
        let at_rest: Vec<Drawn> = rest.parts.iter().map(Drawn::new).collect();

        let mut targets: Vec<Target> = Vec::new();
        // What each target does to the puppet, of which clips are made up.
        let mut shapes: Vec<Vec<Vec3>> = Vec::new();
        for wanted in targets::wanted(library, selection) {
            let alike = targets.iter().position(|t| wanted.is_like(t, library));
            let (moved, shape) = match alike {
                Some(k) => (targets[k].moved.clone(), shapes[k].clone()),
                None => {
                    let pose = wanted.pose(library);
                    pipeline.set_pose(pose);
                    let frame = pipeline.update(breed);
                    let bend = puppet.take(&pose);
                    (wanted.measure(&frame, &at_rest, &parts, &bend).into(), puppet.missing(&bend))
                }
            };
            if moved.iter().any(|part| !part.is_empty()) {
                targets.push(Target { moved, ..wanted });
                shapes.push(shape);
            }
        }
        pipeline.set_pose(Pose::default());
        pipeline.update(breed);

        let mix = Mix::new(&targets, &shapes);
        let clips = clips::bake(&mut puppet, library, selection, &targets, &mix);
        Self { joints: puppet.joints().to_vec(), parts, targets, clips }
    }
}

/// A unit at a strength, on the sides asked for.
fn asked(unit: usize, side: crate::motion::Side, strength: f32) -> Activation {
    let mut activation = Activation::default();
    activation.set(unit, side, strength);
    activation
}

/// What a unit drives, without those that come along with it.
fn alone(library: &Library, asked: &Activation) -> Pose {
    library.limits.clamped(&library.units.drive(asked))
}

/// Vertices to draw of a part: more than it has where a texture's layout has seams.
fn n_drawn(part: &Part<'_>) -> usize {
    part.uv.map_or(part.topology.n_vertices, |uv| uv.vertices.len())
}

/// The part of that name.
fn part<'a, 'b>(frame: &'b Frame<'a>, name: &str) -> Option<&'b Part<'a>> {
    frame.parts.iter().find(|part| part.topology.name == name)
}
