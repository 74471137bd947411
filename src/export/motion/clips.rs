//! Animations: a reel of each unit, expressions and clips, sampled and then reduced to the keys that they need.

use super::joints::{N_JOINTS, PARENTS};
use super::keys::{reduced, slerp};
use super::mix::Mix;
use super::puppet::Puppet;
use super::targets::Target;
use super::{Selection, alone, asked, names};
use crate::motion::{Drive, Library, Moment, Pose, Side, Sides, Unit};
use glam::{Quat, Vec3};

/// Samples of a second.
pub const FRAMES_PER_SECOND: u32 = 30;
/// How long a unit takes to come, and to go, in its reel.
const REEL: f64 = 1.0;
/// How far what a key is left out of may go wrong: parts of a turn's quaternion, metres, weights.
const LEAST: [f32; 3] = [2e-4, 2e-5, 2e-3];

/// An animation; every time is in seconds, from 0 on, rising.
#[derive(Clone, Debug, PartialEq)]
pub struct Clip {
    /// Its name in the file.
    pub name: String,
    /// Whether it goes on from its beginning where it ends.
    pub repeats: bool,
    /// Joints that move.
    pub rotations: Vec<JointTrack<Quat>>,
    /// Joints that shift.
    pub translations: Vec<JointTrack<Vec3>>,
    /// Times and, for each, a weight for each target; empty where none moves.
    pub weights: (Vec<f32>, Vec<f32>),
}

/// What a joint does, in the joint that it hangs on.
#[derive(Clone, Debug, PartialEq)]
pub struct JointTrack<T> {
    /// Its number.
    pub joint: usize,
    /// Times of the keys.
    pub times: Vec<f32>,
    /// One for each.
    pub values: Vec<T>,
}

/// What is asked for at a moment.
struct Sample {
    time: f32,
    pose: Pose,
    asked: Moment,
}

/// Reels of the units that are selected, expressions, clips; without those in which nothing moves.
pub(super) fn bake(
    puppet: &mut Puppet,
    library: &Library,
    selection: &Selection,
    targets: &[Target],
    mix: &Mix,
) -> Vec<Clip> {
    let mut record = |name: String, repeats: bool, samples: Vec<Sample>| {
        record(puppet, library, targets, mix, &samples).map(|clip| Clip { name, repeats, ..clip })
    };
    let at = |moment: &Moment, time: f64| Sample {
        time: time as f32,
        pose: library.pose(moment, time, |_| ()),
        asked: Moment { units: library.units.resolve(&moment.units, |_| ()), direct: moment.direct },
    };
    let mut out = Vec::new();
    for (unit, side) in selection.units.iter().flat_map(|&(unit, side)| reels(&library.units.units[unit], unit, side)) {
        let rise = |time: f64| (1.0 - (time / REEL - 1.0).abs()) as f32;
        let samples = times(2.0 * REEL).into_iter().map(|time| {
            let asked = asked(unit, side, rise(time));
            Sample { time: time as f32, pose: alone(library, &asked), asked: asked.into() }
        });
        let name = names::with_side(names::of_unit(&library.units.units[unit]), side);
        out.extend(record(name, false, samples.collect()));
    }
    for expression in selection.expressions.iter().map(|&k| &library.expressions[k]) {
        let samples = times(expression.seconds()).into_iter().map(|t| at(&expression.moment(t), t));
        out.extend(record(expression.id.clone(), false, samples.collect()));
    }
    for clip in selection.clips.iter().map(|&k| &library.clips[k]) {
        let samples = times(clip.seconds).into_iter().map(|t| at(&clip.at(t), t));
        out.extend(record(clip.id.clone(), clip.repeats, samples.collect()));
    }
    out
}

/// A reel for both sides at once, unless they pull one thing two ways.
fn reels(unit: &Unit, number: usize, side: Side) -> Vec<(usize, Side)> {
    let opposes = |drive: &Drive| drive.target.is_median() && drive.target.is_lateral();
    match (unit.sides, side) {
        (Sides::Each, Side::Both) if unit.drives.iter().any(opposes) => {
            vec![(number, Side::Left), (number, Side::Right)]
        }
        _ => vec![(number, side)],
    }
}

/// From 0 to the end, both among them.
fn times(seconds: f64) -> Vec<f64> {
    let rate = f64::from(FRAMES_PER_SECOND);
    let mut out: Vec<f64> = (0..).map(|k| f64::from(k) / rate).take_while(|t| *t < seconds - 1e-6).collect();
    out.push(seconds);
    out
}

/// Nothing where nothing moves.
fn record(puppet: &mut Puppet, library: &Library, targets: &[Target], mix: &Mix, samples: &[Sample]) -> Option<Clip> {
    let rest = *puppet.joints();
    let n = samples.len();
    let mut turns: Vec<Vec<Quat>> = vec![Vec::new(); N_JOINTS];
    let mut shifts: Vec<Vec<Vec3>> = vec![Vec::new(); N_JOINTS];
    let mut weights: Vec<f32> = Vec::with_capacity(n * targets.len());
    for sample in samples {
        let bend = puppet.take(&sample.pose);
        for joint in 0..N_JOINTS {
            let (turn, shift) = bend.local(joint, &rest);
            // Of the two quaternions of a turn the one that is nearer to the last.
            let before = turns[joint].last().copied().unwrap_or(Quat::IDENTITY);
            turns[joint].push(if before.dot(turn) < 0.0 { -turn } else { turn });
            shifts[joint].push(shift);
        }
        weights.extend(mix.weights(library, targets, &puppet.missing(&bend), &sample.pose, &sample.asked));
    }
    let times: Vec<f32> = samples.iter().map(|s| s.time).collect();
    let part = |a: usize, b: usize, k: usize| (times[k] - times[a]) / (times[b] - times[a]);
    let at = |kept: &[usize]| kept.iter().map(|&k| times[k]).collect::<Vec<f32>>();
    let [of_turn, of_shift, of_weight] = LEAST;

    let mut clip = Clip {
        name: String::new(),
        repeats: false,
        rotations: Vec::new(),
        translations: Vec::new(),
        weights: Default::default(),
    };
    for joint in 0..N_JOINTS {
        let turns = &turns[joint];
        if turns.iter().any(|q| q.xyz().length() > of_turn) {
            let apart = |q: Quat, r: Quat| (q - r).length() < of_turn;
            let kept = reduced(n, |a, b, k| apart(slerp(turns[a], turns[b], part(a, b, k)), turns[k]));
            let values = kept.iter().map(|&k| turns[k]).collect();
            clip.rotations.push(JointTrack { joint, times: at(&kept), values });
        }
        let shifts = &shifts[joint];
        let own = rest[joint] - PARENTS[joint].map_or(Vec3::ZERO, |parent| rest[parent]);
        if shifts.iter().any(|s| s.distance(own) > of_shift) {
            let kept = reduced(n, |a, b, k| shifts[a].lerp(shifts[b], part(a, b, k)).distance(shifts[k]) < of_shift);
            let values = kept.iter().map(|&k| shifts[k]).collect();
            clip.translations.push(JointTrack { joint, times: at(&kept), values });
        }
    }
    if weights.iter().any(|w| *w > 0.0) {
        let row = |k: usize| &weights[k * targets.len()..(k + 1) * targets.len()];
        let kept = reduced(n, |a, b, k| {
            let part = part(a, b, k);
            let rows = row(a).iter().zip(row(b)).zip(row(k));
            rows.into_iter().all(|((a, b), k)| (a + (b - a) * part - k).abs() < of_weight)
        });
        clip.weights = (at(&kept), kept.iter().flat_map(|&k| row(k)).copied().collect());
    }
    let moves = !clip.rotations.is_empty() || !clip.translations.is_empty() || !clip.weights.0.is_empty();
    moves.then_some(clip)
}
