//! Folds of loose skin at rest: of forehead and brow, over the nose, of the cheek.
//!
//! A fold is a rounded ridge beside a narrow valley; it stands on the skin and never sinks into it, since it is skin that
//! is more than the head needs. Where folds run is a field of the base head, so that they stay where they are on the skin
//! of every breed: around the eyes, so that both sides meet in a frown above the stop; across the bridge and down before
//! the eyes; from below the eye down to the throat. How high and how far apart they are is measured on the breed.
//! The field is drawn by eye.

use super::Measures;
use crate::anatomy::Region;
use crate::math::{noise, ops};
use glam::{Vec3, vec3};

/// The left eye, from which the folds of the brow run outwards, head units; and how much a way in each direction counts.
const EYE: Vec3 = vec3(3.1, -0.4, -0.5);
const WAY: Vec3 = vec3(0.9, 1.0, 0.85);
/// How far folds swing about their line, head units, and the height they keep where they are lowest.
const SWING: f32 = 0.3;
const LOWEST: f32 = 0.2;
/// How much farther apart folds of the cheek are than those of the brow.
const CHEEK: f32 = 1.7;
/// Half the width of the roll over the nose, head units.
const ROLL: f32 = 3.0;

/// How high the folds of a head are at most, metres, and how far apart on the base head, head units.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Heights {
    /// Of forehead and brow.
    pub brow: f32,
    /// Of the roll over the nose.
    pub nose: f32,
    /// Of cheek and throat.
    pub cheek: f32,
    /// From one ridge of the brow to the next.
    pub apart: f32,
}

impl Heights {
    /// Of a head's measures; `scale`: its head unit, metres.
    pub fn of(m: &Measures, scale: f32) -> Self {
        Self { brow: m.brow_folds, nose: m.nose_folds, cheek: m.cheek_folds, apart: (m.fold_spacing / scale).max(0.1) }
    }

    /// Whether there is any fold.
    pub fn is_any(&self) -> bool {
        self.brow > 0.0 || self.nose > 0.0 || self.cheek > 0.0
    }
}

/// How loose the skin of a region is, 0 to 1.
pub fn looseness(region: Region) -> f32 {
    use Region::{Chin, EarEdge, EarInner, EarOuter, Lid, LowerLip, Mouth, Nose, Nostril, Orbit, UpperLip, WhiskerPad};
    match region {
        Nose | Nostril | UpperLip | LowerLip | Mouth | Lid | EarOuter | EarInner | EarEdge | Chin => 0.0,
        Orbit => 0.45,
        WhiskerPad => 0.3,
        _ => 1.0,
    }
}

/// Where a place lies across a field of folds, head units, and how much of them it has, 0 to about 1.
#[derive(Clone, Copy, Debug, Default)]
struct Across {
    at: f32,
    part: f32,
}

/// What a place of the base head has to do with folds.
#[derive(Clone, Copy, Debug, Default)]
pub struct Site {
    brow: Across,
    cheek: Across,
    /// The part of the height of the roll over the nose.
    nose: f32,
}

impl Site {
    /// `place`: on the base head, head units; `loose`: how loose the skin is there, 0 to 1.
    pub fn new(place: Vec3, loose: f32) -> Self {
        let loose = smooth(0.25, 0.75, loose);
        if loose <= 0.0 {
            return Self::default();
        }
        // Both sides alike, and round where they meet.
        let p = place.with_x(ops::sqrt(place.x * place.x + 0.04));
        let swing = noise::smooth(p / 2.4, 11) * SWING + noise::smooth(p / 1.1, 12) * (0.27 * SWING);
        let lows = noise::smooth(p / 3.0, 13);
        let patchy = |low: f32| (1.0 + 0.9 * low).clamp(LOWEST, 1.3);
        let side = smooth(1.8, 3.2, p.x).max(smooth(-6.2, -7.2, p.y));
        // One roll over the bridge, down before the eye towards the corner of the mouth.
        let down = (-1.0 - p.y).max(0.0);
        let middle = 2.5 - 0.55 * down - 0.25 * p.x + swing.z / 3.0;
        let t = (p.z - middle) / ROLL;
        let roll = (1.0 - t * t).max(0.0);
        Self {
            brow: {
                let d = ((p - EYE) * WAY).length();
                let above = smooth(-0.7, 0.4, p.y + 0.45 * (p.x - 3.3).max(0.0) - 0.15 * p.z.max(0.0));
                let behind_bridge = smooth(1.6, 0.6, p.z);
                let reach = smooth(1.0, 1.7, d) * smooth(6.5, 4.2, d) * smooth(5.2, 4.3, p.x);
                Across { at: d + swing.x, part: loose * above * behind_bridge * reach * patchy(lows.x) }
            },
            cheek: {
                let v = p.z + 0.45 * p.y + 1.8 * swing.y;
                let under = smooth(-1.2, -3.4, p.y);
                let along = smooth(1.0, -1.0, v) * smooth(-13.0, -9.0, v);
                Across { at: v, part: loose * side * under * along * patchy(1.2 * lows.y) }
            },
            nose: loose * smooth(5.0, 2.2, down) * roll * smooth(0.0, 0.2, roll),
        }
    }

    /// How far the skin stands out, metres.
    pub fn height(&self, h: &Heights) -> f32 {
        let of = |across: Across, high: f32, profile: fn(f32) -> f32, apart: f32| {
            if across.part <= 0.0 || high <= 0.0 { 0.0 } else { across.part * high * profile(across.at / apart) }
        };
        let brow = of(self.brow, h.brow, rolled, h.apart);
        let cheek = of(self.cheek, h.cheek, hanging, CHEEK * h.apart);
        brow.max(cheek).max(self.nose * h.nose)
    }

    /// How deep in a valley of the brow or the cheek the place lies, 0 to about 1, where folds are so far `apart`.
    pub fn valley(&self, apart: f32) -> f32 {
        let brow = self.brow.part * (1.0 - rolled(self.brow.at / apart));
        let cheek = self.cheek.part * (1.0 - hanging(self.cheek.at / (CHEEK * apart)));
        brow.max(cheek)
    }
}

/// Rounded ridges one unit apart, narrow valleys between: 0 to 1.
fn rolled(at: f32) -> f32 {
    const ROUND: f32 = 0.03;
    let (sin, _) = ops::sin_cos(core::f32::consts::PI * at);
    let least = ops::sqrt(ROUND);
    (ops::sqrt(sin * sin + ROUND) - least) / (ops::sqrt(1.0 + ROUND) - least)
}

/// Softer ones.
fn hanging(at: f32) -> f32 {
    let (sin, _) = ops::sin_cos(core::f32::consts::PI * at);
    0.4 * rolled(at) + 0.6 * sin * sin
}

/// 0 at `from`, 1 at `to`, smooth between.
fn smooth(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HIGH: Heights = Heights { brow: 0.005, nose: 0.006, cheek: 0.004, apart: 1.2 };

    #[test]
    fn a_fold_sinks_into_the_head_or_stands_higher_than_it_is_measured() {
        let mut highest = 0.0_f32;
        for i in 0..60_000 {
            let (x, y, z) =
                ((i % 40) as f32 * 0.3 - 6.0, (i / 40 % 40) as f32 * 0.3 - 8.0, (i / 1600) as f32 * 0.5 - 10.0);
            let height = Site::new(vec3(x, y, z), 1.0).height(&HIGH);
            assert!((0.0..=1.3 * 0.006).contains(&height), "{x} {y} {z}: {height}");
            highest = highest.max(height);
        }
        assert!(highest > 0.0055, "{highest}");
    }

    #[test]
    fn folds_of_one_side_are_none_of_the_other() {
        for i in 0..400 {
            let p = vec3(0.012 * i as f32, 1.0 - 0.01 * i as f32, 2.0 - 0.02 * i as f32);
            let [left, right] = [p, p.with_x(-p.x)].map(|p| Site::new(p, 1.0).height(&HIGH));
            assert_eq!(left.to_bits(), right.to_bits(), "{p}");
        }
    }

    #[test]
    fn tight_skin_has_folds() {
        for i in 0..400 {
            let p = vec3(0.01 * i as f32, 1.0, -0.01 * i as f32);
            assert_eq!(Site::new(p, 0.2).height(&HIGH), 0.0);
        }
    }
}
