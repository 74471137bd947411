//! The lining of the closed mouth: the upper pocket always above and outside the lower one.

use super::Pins;
use super::lips::outwards;
use glam::{Vec3, vec3};

/// Last step of the upper lip's edge before the corner beside which its lining has its full height, head units.
const STEP: f32 = 0.9;

pub(super) fn place(pins: &mut Pins) {
    let s = pins.shape;
    let h = pins.handles;
    let at = |pins: &Pins, v: u16| s.muzzle_from_head(pins.at[v as usize]);
    let k = (s.muz_w1 / 5.6).min(1.0);
    let edge: [Vec3; 8] = std::array::from_fn(|i| at(pins, h.s[3 + i][9]));
    for i in 3..10 {
        let (u, l) = (edge[i - 3], at(pins, h.l[i][9]));
        // In front the lining turns back at once: the chin may stand far behind the lips.
        let turn = [1.0, 0.9, 0.6, 0.3, 0.0, 0.0, 0.0][i - 3];
        let back = |p: f32| -0.4 * turn * p * (0.5 + 0.5 * k);
        let top = u.y.max(l.y);
        let row = [
            (h.mu[i][1], u.lerp(l, 0.3).with_y(top + 0.40 * k)),
            (h.mu[i][2], vec3(0.8 * l.x, top + 0.42 * k, l.z.min(u.z) + back(1.5))),
            (h.mu[i][3], vec3(0.0, top + 0.75 * k, l.z.min(u.z) + back(2.5))),
            (h.ml[i][1], l + (Vec3::Y * 0.08 - outwards(&edge, i - 3) * 0.35) * k),
            (h.ml[i][2], vec3(0.66 * l.x, l.y - 0.45 * k, l.z + back(1.7))),
            (h.ml[i][3], vec3(0.0, l.y - 0.62 * k, l.z + back(2.6))),
        ];
        for (v, p) in row {
            let p = p.with_x(p.x.max(0.0));
            pins.set(v, s.head_from_muzzle(if i == 3 { vec3(0.0, p.y, p.z) } else { p }));
        }
    }
    // Behind the corner: the upper lining rises beside the lip's inner side, the lower one turns inwards below it.
    // The sharp edge turns round before its control vertex.
    let c = edge[7].lerp(edge[6], 0.55);
    let k = k.min(edge[7].distance(edge[6]) / STEP);
    let rows = [(0.035, 0.92, 0.16, -0.10), (0.3 * c.x, 0.65, 0.4 * c.x, -0.36), (c.x, 0.60, c.x, -0.50)];
    for (p, (upper, rise, lower, fall)) in rows.into_iter().enumerate() {
        let z = Vec3::Z * (-0.25 * p as f32);
        let inside =
            |by: f32| if p == 0 { c - outwards(&edge, 7) * (by * k) } else { c.with_x((c.x - by).max(0.0)) + z };
        pins.set(h.mu[10][p + 1], s.head_from_muzzle(inside(upper) + Vec3::Y * (rise * k)));
        pins.set(h.ml[10][p + 1], s.head_from_muzzle(inside(lower) + Vec3::Y * (fall * k)));
    }
}
