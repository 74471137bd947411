//! The tongue as a chain of joints: each of its sections turns a little against the one behind it, and what comes out of
//! the mouth grows longer and thinner: a tongue keeps its volume (Kier and Smith 1985), of which a part follows from behind.

use super::tongue::{self, AROUND, SECTIONS};
use super::{MouthOfHead, off_bone};
use crate::math::ops;
use crate::motion::{Channel, Pose};
use crate::rig::Rigid;
use glam::{Mat3, Vec3, vec3};

/// Where the free part begins, as a part of the length, and from where on it is free.
const FREE: [f32; 2] = [0.25, 0.45];
/// Over how much of its way the part that leaves the mouth bends, millimetres before and behind the incisors.
const BEND: [f32; 2] = [4.0, 30.0];
/// The same of the nose's tip where it bends up, before the upper lip.
const UP: [f32; 2] = [-8.0, 12.0];
/// Part of the length from which the tip curls.
const CURLS: f32 = 0.62;
/// How much wider a wide tongue is.
const WIDER: f32 = 0.40;
/// From where on and where at last it is as wide as outside, as parts of its way to the teeth.
const WIDENS: [f32; 2] = [0.7, 1.25];
/// Between tongue and skull, and mandible, which it grows out of: canonical millimetres.
const COVER: [f32; 2] = [1.0, 0.3];

/// Moves the tongue's control positions; `mouth`: at rest, `jaw`: the mandible against the skull, `unit`: metres of a millimetre of the head with a skull of 200
/// mm, `front`: how far in front its skin reaches, metres; `out`: as long as `mouth.tongue`.
pub fn bend_tongue(mouth: &MouthOfHead, pose: &Pose, jaw: &Rigid, (unit, front): (f32, f32), out: &mut Vec<Vec3>) {
    out.clear();
    out.extend_from_slice(&mouth.tongue);
    let [far, lift, curl, side, wide] =
        [Channel::TongueOut, Channel::TongueLift, Channel::TongueCurl, Channel::TongueSide, Channel::TongueWide]
            .map(|c| pose.median(c));
    if [far, lift, curl, side, wide].iter().all(|v| *v == 0.0) {
        return;
    }
    let gape = pose.median(Channel::JawGape);
    let rest = &mouth.tongue;
    let middle = |i: usize| 0.5 * (rest[i * AROUND] + rest[i * AROUND + AROUND - 1]).with_x(0.0);
    let smooth = ops::smoothstep;
    let steps: [Vec3; SECTIONS] = std::array::from_fn(|i| if i == 0 { Vec3::ZERO } else { middle(i) - middle(i - 1) });
    let length: f32 = steps.iter().map(|d| d.length()).sum::<f32>().max(1e-5);
    let mut along = [0.0; SECTIONS];
    for i in 1..SECTIONS {
        along[i] = along[i - 1] + steps[i].length() / length;
    }
    let free = |s: f32| smooth(FREE[0], FREE[1], s);
    let freely: f32 = (1..SECTIONS).map(|i| steps[i].length() * free(along[i])).sum::<f32>().max(1e-5);
    let stretch = |s: f32| (1.0 + far * unit / freely * free(s)).max(0.3);
    // Where the incisors are on the way, which is as long as the tongue at rest.
    let [from, to] = [length - BEND[0] * unit, length + BEND[1] * unit];
    // Up it goes before the upper lip, down over the lower one.
    let lips = length + (front - jaw.point(middle(SECTIONS - 1)).z).max(0.0);
    let [from, to] = if lift > 0.0 { UP.map(|mm| lips + mm * unit) } else { [from, to] };
    // What goes up before the nose is upright in the skull's frame, or it would lean into it.
    let steepest = 90.0 + gape + 180.0 * (1.0 - smooth(0.0, 45.0, lift));
    let is_out = smooth(0.0, 12.0, far);
    let half_width = |i: usize| mouth.sections[i].iter().map(|&v| rest[v as usize].x).fold(0.0, f32::max).max(1e-5);
    let [incisors, canines] = mouth.onto;
    let moves = is_out.max(smooth(0.0, 4.0, -far));
    // The width that teeth leave where so much of the way is gone.
    let passage = |f: f32| {
        let k = (1..SECTIONS - 1).find(|&i| f < along[i]).unwrap_or(SECTIONS - 1);
        let t = ((f - along[k - 1]) / (along[k] - along[k - 1]).max(1e-6)).clamp(0.0, 1.0);
        let between = |of: &[f32; SECTIONS]| of[k - 1] + t * (of[k] - of[k - 1]);
        between(&mouth.passage.inside) * (1.0 - is_out) + between(&mouth.passage.out) * is_out
    };
    let (mut at, mut way) = (middle(0), 0.0);
    // The same as if nothing bent it.
    let mut straight = at;
    for i in 0..SECTIONS {
        let s = along[i];
        let thick = stretch(s);
        let turn = |s: f32, way: f32| {
            // Teeth and palate hold what is still inside.
            let outside = smooth(from, to, way);
            let inside = curl.clamp(0.0, gape) * (1.0 - is_out) * smooth(CURLS, 1.0, s);
            let up = (lift * outside + curl * is_out * smooth(CURLS, 1.0, s) * outside + inside).min(steepest);
            Mat3::from_rotation_y((side * outside).to_radians()) * Mat3::from_rotation_x(-up.to_radians())
        };
        let step = steps[i] * thick;
        at += turn(s, way + 0.5 * step.length()) * step;
        straight += step;
        way += step.length();
        let turn = turn(s, way);
        // It is as wide as teeth let it, and its tip a spatula, however long it is drawn.
        let widens = is_out * smooth(WIDENS[0], WIDENS[1], way / length);
        let flat = 1.0 + WIDER * wide * widens;
        let end = ((s - 0.8) / 0.21).max(0.0);
        let spatula = ops::powf((1.0 - end * end).max(0.05), 0.35);
        let wider = 1.0 + (mouth.passage.outside * spatula / half_width(i) - 1.0).max(0.0) * widens;
        let (x, y) = (wider * flat * ops::powf(thick, -0.15), ops::powf(thick, -0.12) / ops::sqrt(flat));
        // Between the teeth it is as narrow as they are.
        let held = x.min(passage(way / length) / half_width(i));
        let x = held + (x - held) * smooth(1.0, 1.15, way / length);
        // It lies on the front teeth where it passes them.
        let under = rest[i * AROUND + AROUND - 1].y - middle(i).y;
        let bottom = straight.y + under * y;
        let lies = ((incisors - bottom).max(0.0) * is_out).max((canines - bottom).max(0.0) * moves)
            * tongue::rises(way / length);
        let lifted = at + vec3(0.0, lies, 0.0);
        let place = |p: Vec3| {
            let d = p - middle(i);
            lifted + turn * vec3(d.x * x, d.y * y, d.z)
        };
        for &v in &mouth.sections[i] {
            out[v as usize] = place(rest[v as usize]);
        }
    }
    let [skull, mandible] = &mouth.bones;
    for p in out.iter_mut() {
        let above = off_bone(jaw.point(*p), skull, COVER[0], mouth.unit);
        *p = off_bone(jaw.back(above), mandible, COVER[1], mouth.unit);
    }
}
