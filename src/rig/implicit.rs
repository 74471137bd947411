//! The implicit head: some twenty smoothly blended primitives placed by the head's proportions. It is the scaffold on
//! which the control mesh is laid, not the surface that is seen.
//!
//! Lengths in head units (see [`Proportions`]); frame: origin at the skin of the nasion, x left, y up, z forward. The
//! model is symmetric by construction, since it sees `|x|`. Parts of the muzzle live in the *muzzle frame*, the head's
//! frame turned about the x axis by the facial tilt.

use super::lanes::{F8, P8};
use super::primitives::{Cone, Ellipsoid, TaperedBox, smax, smin};
use super::proportions::Proportions;
use crate::math::ops;
use glam::{Vec3, vec3};

/// Which part of the head a vertex lies on. With one common surface the lips would always weld together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Layer {
    /// Everything.
    Whole,
    /// Without the lower jaw.
    Upper,
    /// Without muzzle, whisker pads, flews and nose.
    Lower,
}

/// The primitives of one head.
#[derive(Clone, Debug)]
pub struct Implicit {
    skull: [(Ellipsoid, f32); 4],
    furrow: (Cone, f32),
    brow: (Cone, f32),
    zygoma: [Cone; 2],
    masseter: Ellipsoid,
    jaw_angle: Ellipsoid,
    tilt: (f32, f32),
    muzzle: TaperedBox,
    whisker_pad: Ellipsoid,
    flew: Cone,
    roll: [Cone; 2],
    jaw: TaperedBox,
    chin: (Ellipsoid, f32),
    nose: Ellipsoid,
    tear: Ellipsoid,
    neck: Cone,
    neck_x: f32,
    throat: Cone,
    lids: (Vec3, f32),
}

impl Implicit {
    /// Places the primitives.
    pub fn new(s: &Proportions) -> Self {
        let (cl, ch, cw, zw) = (s.cran_len, s.cran_h, s.cran_w / 2.0, s.zyg_w / 2.0);
        let (w0, w1) = (s.muz_w0 / 2.0, s.muz_w1 / 2.0);
        let (length, lip0, lip1) = (s.muz_len, s.lip0(), s.lip1());
        let (bridge0, bridge1) = (s.bridge0(), s.bridge1());
        let jz = length + s.jaw_len;
        let (eye, fl, lt, dome) = (s.eye(), s.flew, s.lip_t, s.dome);
        let (neck_a, neck_dir) = s.neck_axis();
        let neck_x = s.neck_w / s.neck_d;
        let pad = 0.35 + 0.65 * s.slim();
        let full = (length / 8.0).min(1.0) * (length / 8.0).min(1.0);
        let high = (bridge0 + 1.2).clamp(0.0, 1.8);
        let roll = {
            // Without a roll the ropes are so thin that they touch nothing: the slider starts without a jump.
            let inset = 1.3 * (1.0 - s.wrinkle) * (1.0 - s.wrinkle);
            let at = [
                vec3(0.0, bridge0 + 0.25, 0.32 * length),
                vec3(0.50 * w0, bridge0 - 0.15, 0.30 * length),
                vec3(w0, bridge0 - 1.9, 0.20 * length),
            ];
            let r = [0.57, 0.57, 0.40].map(|r| r - inset);
            [Cone::new(at[0], at[1], r[0], r[1]), Cone::new(at[1], at[2], r[1], r[2])]
        };
        Self {
            skull: [
                (
                    Ellipsoid::new(
                        vec3(0.0, ch - 4.6 - 0.2 * dome, -0.52 * cl),
                        vec3(0.97 * cw, 4.6 + 0.4 * dome, 0.50 * cl),
                    ),
                    1.0,
                ),
                (
                    {
                        let (height, depth) = s.forehead();
                        Ellipsoid::new(vec3(0.0, height - depth.x, -0.26 * cl), vec3(0.80 * cw, depth.x, depth.y))
                    },
                    2.0,
                ),
                (
                    Ellipsoid::new(
                        vec3(0.0, ch - 3.4 + 0.5 * s.occiput, -0.86 * cl),
                        vec3(1.5, 1.5, 0.13 * cl + 0.7 * s.occiput),
                    ),
                    2.5,
                ),
                (
                    Ellipsoid::new(
                        vec3(0.5 * eye.x, eye.y + 0.35 + 0.5 * dome, eye.z - 1.6),
                        vec3(1.9, 1.15 + 0.35 * s.stop, 2.4),
                    ),
                    1.6,
                ),
            ],
            furrow: (
                // It ends over the stop, clear of a bridge that stands high.
                Cone::new(
                    vec3(0.0, 1.0 + 0.8 * high, 0.6 - 0.5 * high),
                    vec3(0.0, ch + 0.4, -0.4 * cl),
                    0.35 + 0.3 * s.furrow,
                    0.2,
                ),
                1.2 * s.furrow.max(0.0) + 0.05,
            ),
            brow: (
                Cone::new(
                    vec3(0.8 * eye.x, eye.y + 1.45, eye.z + 0.05),
                    vec3(1.26 * eye.x, eye.y + 1.05, eye.z - 1.0),
                    0.45 + 0.25 * s.brow,
                    0.50 + 0.25 * s.brow,
                ),
                1.8,
            ),
            zygoma: {
                let a = vec3(0.98 * eye.x, s.zyg_y + 0.35, eye.z + 0.2);
                let b = vec3(zw - 2.0, s.zyg_y + 0.2, -0.36 * cl);
                let c = vec3(zw - 2.8, s.zyg_y + 0.9, -0.62 * cl);
                [Cone::new(a, b, 1.35, 1.8), Cone::new(b, c, 1.8, 1.8)]
            },
            masseter: Ellipsoid::turned(
                vec3(zw - 2.75, s.zyg_y - 2.3, -0.38 * cl),
                vec3(2.2 + 0.5 * s.cheek, 3.0 + 0.3 * s.cheek, 3.4),
                15.0,
            ),
            jaw_angle: Ellipsoid::turned(
                vec3(0.44 * zw, lip0 - 0.3 * s.jaw_d, -0.34 * cl),
                vec3(0.34 * zw, 1.7, 3.2),
                18.0,
            ),
            tilt: (ops::cos(s.muz_tilt), ops::sin(s.muz_tilt)),
            muzzle: TaperedBox {
                z: (-3.0, length - 0.55),
                half_width: (1.18 * w0, w1),
                top: (bridge0 + 0.45, bridge1),
                bottom: (lip0 - 0.2, lip1),
                arch: s.roman,
                top_width: s.bridge_w,
                // A short muzzle ends beside the eyes: its sides stay flat.
                sides: (0.16 * full, 0.08 * full),
                rounding: 0.62,
            },
            whisker_pad: Ellipsoid::new(
                vec3(0.52 * w1, lip1 + 1.75 * pad - 0.2 * fl, length - 2.2 * pad),
                vec3(0.58 * w1 * lt + 0.15 * pad, 2.0 * pad, 2.2 * pad),
            ),
            flew: Cone::new(
                vec3(0.62 * w1, lip1 + 1.05 - 0.75 * fl, length - 2.0),
                vec3(0.90 * w0, lip0 + 1.2 - 0.70 * fl, 1.2),
                0.95 * lt,
                0.72 * lt,
            ),
            roll,
            jaw: TaperedBox {
                z: (-0.40 * cl, jz - 0.2),
                half_width: (w0 * s.jaw_w + 0.35, 0.70 * w1 * s.jaw_w),
                top: (lip0 + 1.0, lip1 + 0.9),
                bottom: (lip0 - s.jaw_d, lip1 - 0.72 * s.jaw_d),
                arch: 0.0,
                top_width: 1.0,
                sides: (0.0, 0.0),
                rounding: 0.70,
            },
            chin: (
                Ellipsoid::new(
                    vec3(0.0, lip1 - 0.30 * s.jaw_d, jz - 1.1),
                    vec3(0.62 * w1 * s.jaw_w, 0.55 * s.jaw_d, 1.2 + 0.2 * s.chin),
                ),
                0.12 * s.chin,
            ),
            nose: Ellipsoid::new(s.nose_centre(), vec3(0.48 * s.nose_w, 0.48 * s.nose_h, 1.0)),
            tear: Ellipsoid::new(vec3(0.6 * eye.x, eye.y - 0.55, eye.z + 2.45), vec3(0.3, 0.3, 0.6)),
            neck: {
                let squeeze = vec3(1.0 / neck_x, 1.0, 1.0);
                Cone::new(neck_a * squeeze, (neck_a + neck_dir * 16.0) * squeeze, 0.47 * s.neck_d, 0.56 * s.neck_d)
            },
            neck_x,
            throat: Cone::new(
                s.head_from_muzzle(vec3(0.0, lip0 + 0.4 - 0.1 * s.jaw_d, 0.0)),
                neck_a + neck_dir * 8.0 - vec3(0.0, 1.5 + s.throat, 0.0),
                2.1,
                3.6,
            ),
            lids: (eye, 1.10 * s.eye_r),
        }
    }

    /// Signed distance (approximate) at eight points: negative inside.
    #[inline(always)]
    fn field(&self, p: P8, layer: Layer) -> F8 {
        let p = P8 { x: p.x.abs(), ..p };
        let mut d = self.skull[0].0.eval(p);
        for (e, k) in &self.skull[1..] {
            d = smin(d, e.eval(p), *k);
        }
        d = smax(d, -self.furrow.0.eval(p), self.furrow.1);
        d = smin(d, self.brow.0.eval(p), self.brow.1);
        d = smin(d, smin(self.zygoma[0].eval(p), self.zygoma[1].eval(p), 1.0), 3.0);
        d = smin(d, self.masseter.eval(p), 3.0);
        d = smin(d, self.jaw_angle.eval(p), 3.2);
        let m = p.rotate_x(self.tilt.0, self.tilt.1);
        if layer != Layer::Lower {
            d = smin(d, self.muzzle.eval(m), 2.4);
            d = smin(d, self.whisker_pad.eval(m), 1.4);
            d = smin(d, self.flew.eval(m), 1.6);
            d = smin(d, smin(self.roll[0].eval(m), self.roll[1].eval(m), 0.6), 1.0);
        }
        if layer != Layer::Upper {
            d = smin(d, self.jaw.eval(m), 2.0);
            d = smin(d, self.chin.0.eval(m) - self.chin.1, 0.9);
        }
        if layer != Layer::Lower {
            d = smin(d, self.nose.eval(m), 0.8);
        }
        d = smax(d, -self.tear.eval(p), 1.4);
        let n = P8 { x: p.x * (1.0 / self.neck_x), ..p };
        d = smin(d, self.neck.eval(n) * self.neck_x.min(1.0), 3.0);
        d = smin(d, self.throat.eval(p), 3.0);
        let lids = p.minus(self.lids.0).length_squared().sqrt() - self.lids.1;
        smin(d, lids, 0.9)
    }

    /// Distance and gradient at two points, from four evaluations about each (tetrahedral differences).
    pub fn sample2(&self, a: Vec3, b: Vec3, layer: Layer) -> [(f32, Vec3); 2] {
        const H: f32 = 0.02;
        const K: [Vec3; 4] =
            [Vec3::new(1.0, -1.0, -1.0), Vec3::new(-1.0, -1.0, 1.0), Vec3::new(-1.0, 1.0, -1.0), Vec3::ONE];
        let at = |k: usize| if k < 4 { a + K[k] * H } else { b + K[k - 4] * H };
        let p = P8 {
            x: F8(std::array::from_fn(|k| at(k).x)),
            y: F8(std::array::from_fn(|k| at(k).y)),
            z: F8(std::array::from_fn(|k| at(k).z)),
        };
        let f = field(self, p, layer).0;
        std::array::from_fn(|i| {
            let f = &f[4 * i..4 * i + 4];
            let g = K[0] * f[0] + K[1] * f[1] + K[2] * f[2] + K[3] * f[3];
            ((f[0] + f[1] + f[2] + f[3]) * 0.25, g * (0.25 / H))
        })
    }

    /// Distance and gradient at one point.
    pub fn sample(&self, p: Vec3, layer: Layer) -> (f32, Vec3) {
        self.sample2(p, p, layer)[0]
    }

    /// Distance at one point.
    pub fn distance(&self, p: Vec3, layer: Layer) -> f32 {
        self.sample(p, layer).0
    }

    /// One Newton step towards the surface, at most `cap` long.
    #[inline]
    pub fn step(p: Vec3, (f, g): (f32, Vec3), cap: f32) -> Vec3 {
        let move_by = g * (f / g.length_squared().max(1e-4));
        let length = move_by.length();
        p - if length > cap { move_by * (cap / length) } else { move_by }
    }

    /// Newton projection of one point.
    pub fn project(&self, mut p: Vec3, layer: Layer, steps: usize) -> Vec3 {
        for _ in 0..steps {
            p = Self::step(p, self.sample(p, layer), 0.8);
        }
        p
    }

    /// First exit of the surface from `a` towards `b`, and beyond: marches, then bisects. `a` should lie inside.
    pub fn exit(&self, a: Vec3, b: Vec3, layer: Layer, reach: f32) -> Vec3 {
        const STEPS: usize = 60;
        let at = |t: f32| a + (b - a) * t;
        let mut inside = 0.0;
        for n in 1..=STEPS {
            let t = reach * n as f32 / STEPS as f32;
            if self.distance(at(t), layer) > 0.0 {
                let (mut lo, mut hi) = (inside, t);
                for _ in 0..18 {
                    let mid = 0.5 * (lo + hi);
                    if self.distance(at(mid), layer) > 0.0 { hi = mid } else { lo = mid }
                }
                return at(0.5 * (lo + hi));
            }
            inside = t;
        }
        at(1.0)
    }
}

/// The field, compiled for the widest vectors that the machine has; the operations and their order are the same.
#[multiversion::multiversion(targets("x86_64+avx2", "x86_64+avx"))]
fn field(head: &Implicit, p: P8, layer: Layer) -> F8 {
    head.field(p, layer)
}
