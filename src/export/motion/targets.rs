//! Morph targets: which there are, and what each does to every vertex.

use super::bend::Bend;
use super::{MovingPart, Selection, alone, asked, n_drawn, names};
use crate::export::geometry::{unit, value};
use crate::frame::{Frame, Part};
use crate::motion::{Channel, Drive, Library, Moment, Moved as InClip, Pose, Side, Sides, Target as Driven};
use glam::{Affine3A, Vec3};
use std::sync::Arc;

/// What moves by less stays where it is, metres; and normals, parts of their length.
const LEAST: [f32; 2] = [1e-5, 4e-3];

/// Units whose whole shape is there for clients without joints.
const WITHOUT_JOINTS: [&str; 2] = ["AU26", "AU27"];

/// Whose shape a target is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// A unit's, by its number in the table.
    Unit(usize),
    /// That of a channel or muscle which a clip moves and no unit does, at its most.
    Driven(Driven),
}

/// What of its source a target has.
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
    /// Whose shape it is.
    pub source: Source,
    /// On which side.
    pub side: Side,
    /// What of it the target has.
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

/// The targets of the units that are selected or that expressions and clips move, in the order of their table, and of what
/// clips move beside units; nothing moves yet.
pub(super) fn wanted(library: &Library, selection: &Selection) -> Vec<Target> {
    let is_selected = |number: usize| selection.units.iter().any(|(selected, _)| *selected == number);
    let mut out = Vec::new();
    for (number, side) in selection.moving_units(library) {
        let unit = &library.units.units[number];
        let kinds: &[Kind] = match unit.drives.iter().any(|drive| turns_joints(drive.target)) {
            false => &[Kind::Shape],
            true if is_selected(number) && WITHOUT_JOINTS.contains(&unit.id.as_str()) => {
                &[Kind::WithoutJoints, Kind::Corrective]
            }
            true => &[Kind::Corrective],
        };
        let sides: &[Side] = match (unit.sides, side) {
            (Sides::Each, Side::Both) => &[Side::Left, Side::Right],
            _ => &[side],
        };
        for &kind in kinds {
            out.extend(sides.iter().map(|&side| {
                let name = names::of_target(unit, kind, side);
                Target { name, source: Source::Unit(number), side, kind, moved: Arc::default() }
            }));
        }
    }
    let tracks = selection.clips.iter().flat_map(|&k| &library.clips[k].layers).flat_map(|layer| &layer.tracks);
    let of_clips = tracks.filter_map(|track| if let InClip::Target(target) = track.of { Some(target) } else { None });
    let beside = selection.expressions.iter().flat_map(|&k| &library.expressions[k].beside);
    let mut driven: Vec<Driven> = Vec::new();
    for target in beside.map(|beside| Driven::Channel(beside.channel)).chain(of_clips) {
        let is_known = |drive: &Drive| drive.target == target;
        let has_unit = library.units.units.iter().any(|unit| unit.drives.iter().any(is_known));
        if !has_unit && !turns_joints(target) && !driven.contains(&target) {
            driven.push(target);
        }
    }
    for target in driven {
        let id = match target {
            Driven::Channel(channel) => channel.id().to_owned(),
            Driven::Muscle(muscle) => library.muscles.muscles[muscle].id.clone(),
        };
        let sides: &[Side] = if target.is_median() { &[Side::Both] } else { &[Side::Left, Side::Right] };
        out.extend(sides.iter().map(|&side| {
            let name = names::with_side(id.clone(), side);
            Target { name, source: Source::Driven(target), side, kind: Kind::Shape, moved: Arc::default() }
        }));
    }
    out
}

/// The value of a channel or muscle at its most.
fn most(library: &Library, target: Driven) -> f32 {
    match target {
        Driven::Channel(channel) => library.limits.of(channel).range.1,
        Driven::Muscle(_) => 1.0,
    }
}

/// Whether a joint of the file takes part in what a unit drives.
fn turns_joints(target: Driven) -> bool {
    let Driven::Channel(channel) = target else { return false };
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
    /// Its source alone, at 1.
    pub(super) fn pose(&self, library: &Library) -> Pose {
        match self.source {
            Source::Unit(unit) => alone(library, &asked(unit, self.side, 1.0)),
            Source::Driven(target) => {
                let mut pose = Pose::default();
                let values = target.of(&mut pose);
                *values = self.side.put(*values, most(library, target));
                pose
            }
        }
    }

    /// Whether another target is of the same kind and its unit drives the same.
    pub(super) fn is_like(&self, other: &Self, library: &Library) -> bool {
        let (Source::Unit(a), Source::Unit(b)) = (self.source, other.source) else { return false };
        let [a, b] = [a, b].map(|unit| &library.units.units[unit]);
        self.side == other.side && self.kind == other.kind && a.sides == b.sides && a.drives == b.drives
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

    /// How strongly it is asked for, 0 to 1.
    pub(super) fn strength(&self, library: &Library, asked: &Moment) -> f32 {
        let mut direct = asked.direct;
        let ([left, right], most) = match self.source {
            Source::Unit(unit) => (asked.units.get(unit), 1.0),
            Source::Driven(target) => (*target.of(&mut direct), most(library, target)),
        };
        let value = match self.side {
            Side::Both => left.max(right),
            Side::Left => left,
            Side::Right => right,
        };
        (value / most).clamp(0.0, 1.0)
    }

    /// Whether a pose does something of what it is made of.
    pub(super) fn takes_part(&self, library: &Library, pose: &Pose) -> bool {
        let mut pose = *pose;
        let mut goes = |target: Driven, value: f32| {
            let [left, right] = *target.of(&mut pose);
            let values = match self.side {
                _ if target.is_median() => [left; 2],
                Side::Both => [left, right],
                Side::Left => [left; 2],
                Side::Right => [right; 2],
            };
            let is_mirrored = self.side == Side::Right && target.is_lateral();
            let value = if is_mirrored { -value } else { value };
            values.iter().any(|v| v * value > 0.0)
        };
        match self.source {
            Source::Unit(unit) => library.units.units[unit].drives.iter().any(|d| goes(d.target, d.value)),
            Source::Driven(target) => goes(target, 1.0),
        }
    }
}
