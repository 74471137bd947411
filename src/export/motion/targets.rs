//! Morph targets: which there are, and what each does to every vertex.

use super::bend::Bend;
use super::{MovingPart, Selection, asked, n_drawn, names};
use crate::export::geometry::{unit, value};
use crate::frame::{Frame, Part};
use crate::motion::{Activation, Channel, Drive, Library, Side, Sides, Target as Driven};
use glam::{Affine3A, Vec3};
use std::sync::Arc;

/// What moves by less stays where it is, metres; and normals, parts of their length.
const LEAST: [f32; 2] = [1e-5, 4e-3];

/// Units whose whole shape is there for clients without joints.
const WITHOUT_JOINTS: [&str; 2] = ["AU26", "AU27"];

/// What of a unit a target has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// All of it: no joint moves.
    Shape,
    /// What the joints leave over of it.
    Corrective,
    /// All of it, with the joints at rest.
    WithoutJoints,
}

/// A target.
#[derive(Clone, Debug, PartialEq)]
pub struct Target {
    /// Its name in the file.
    pub name: String,
    /// Number of the unit in its table.
    pub unit: usize,
    /// On which side.
    pub side: Side,
    /// What of the unit it has.
    pub kind: Kind,
    /// For each part of the frame the vertices to draw that move, ascending.
    pub moved: Arc<Vec<Vec<Moved>>>,
}

/// What becomes of a vertex at weight 1, before joints move it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Moved {
    /// Vertex to draw of the part.
    pub vertex: u32,
    /// Added to its position, metres.
    pub position: Vec3,
    /// Added to its normal.
    pub normal: Vec3,
}

/// A part's values at its vertices to draw.
pub(super) struct Drawn {
    positions: Vec<Vec3>,
    normals: Vec<Vec3>,
}

impl Drawn {
    pub fn new(part: &Part<'_>) -> Self {
        let all = |values: &[Vec3]| (0..n_drawn(part)).map(|v| value(part, values, v)).collect::<Vec<Vec3>>();
        let normals = all(part.normals).into_iter().map(unit).collect();
        Self { positions: all(part.positions), normals }
    }
}

/// The targets of the units that are selected, in the order of their table; nothing moves yet.
pub(super) fn wanted(library: &Library, selection: &Selection) -> Vec<Target> {
    let mut out = Vec::new();
    for &(number, side) in &selection.units {
        let unit = &library.units.units[number];
        let kinds: &[Kind] = match unit.drives.iter().any(turns_joints) {
            false => &[Kind::Shape],
            true if WITHOUT_JOINTS.contains(&unit.id.as_str()) => &[Kind::WithoutJoints, Kind::Corrective],
            true => &[Kind::Corrective],
        };
        let sides: &[Side] = match (unit.sides, side) {
            (Sides::Each, Side::Both) => &[Side::Left, Side::Right],
            _ => &[side],
        };
        for &kind in kinds {
            out.extend(sides.iter().map(|&side| {
                let name = names::of_target(unit, kind, side);
                Target { name, unit: number, side, kind, moved: Arc::default() }
            }));
        }
    }
    out
}

/// Whether a joint of the file takes part in what a unit drives.
fn turns_joints(drive: &Drive) -> bool {
    let Driven::Channel(channel) = drive.target else { return false };
    match channel {
        Channel::Pupil
        | Channel::LidClosed
        | Channel::LidRaised
        | Channel::LipsPart
        | Channel::CheekPuff
        | Channel::Bite
        | Channel::FlewSway => false,
        Channel::HeadTurn
        | Channel::HeadNod
        | Channel::HeadTilt
        | Channel::HeadForward
        | Channel::JawGape
        | Channel::JawProtrusion
        | Channel::JawSlide
        | Channel::GazeTurn
        | Channel::GazeLift
        | Channel::TongueOut
        | Channel::TongueLift
        | Channel::TongueCurl
        | Channel::TongueSide
        | Channel::TongueWide
        | Channel::EarForward
        | Channel::EarLift
        | Channel::EarIn
        | Channel::EarTurn
        | Channel::EarBack
        | Channel::EarOut
        | Channel::EarBend
        | Channel::EarSway => true,
    }
}

impl Target {
    /// Its unit alone, at 1.
    pub(super) fn asked(&self) -> Activation {
        asked(self.unit, self.side, 1.0)
    }

    /// Whether another target's unit drives the same.
    pub(super) fn is_posed_like(&self, other: &Self, library: &Library) -> bool {
        let [a, b] = [self.unit, other.unit].map(|unit| &library.units.units[unit]);
        self.side == other.side && a.sides == b.sides && a.drives == b.drives
    }

    /// What moves: `frame`: the head in the unit's pose, `rest`: at rest, `bend`: the joints in the pose.
    pub(super) fn measure(
        &self,
        frame: &Frame<'_>,
        rest: &[Drawn],
        parts: &[MovingPart],
        bend: &Bend,
    ) -> Vec<Vec<Moved>> {
        let of_part = |((part, rest), moving): ((&Part<'_>, &Drawn), &MovingPart)| {
            let now = Drawn::new(part);
            // Neighbours mostly have the same weights.
            let mut last = None;
            let mut back = |v: usize| match self.kind {
                Kind::Shape | Kind::WithoutJoints => Affine3A::IDENTITY,
                Kind::Corrective => {
                    let influences = moving.influences[v];
                    match last {
                        Some((of, back)) if of == influences => back,
                        _ => last.insert((influences, bend.back(&influences.dense()))).1,
                    }
                }
            };
            let mut moved = Vec::new();
            for v in 0..now.positions.len() {
                let back = back(v);
                let position = back.transform_point3(now.positions[v]) - rest.positions[v];
                let normal = back.transform_vector3(now.normals[v]).normalize_or_zero() - rest.normals[v];
                if position.length() > LEAST[0] || normal.length() > LEAST[1] {
                    moved.push(Moved { vertex: v as u32, position, normal });
                }
            }
            moved
        };
        frame.parts.iter().zip(rest).zip(parts).map(of_part).collect()
    }

    /// How strongly an activation asks for it.
    pub(super) fn strength(&self, activation: &Activation) -> f32 {
        let [left, right] = activation.get(self.unit);
        match self.side {
            Side::Both => left.max(right),
            Side::Left => left,
            Side::Right => right,
        }
    }
}
