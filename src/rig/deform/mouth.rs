//! The lining of the closed mouth: the upper pocket always above and outside the lower one.

use super::Pins;
use glam::vec3;

pub(super) fn place(pins: &mut Pins) {
    let s = pins.shape;
    let h = pins.handles;
    let at = |pins: &Pins, v: u16| s.muzzle_from_head(pins.at[v as usize]);
    let k = (s.muz_w1 / 5.6).min(1.0);
    for i in 3..10 {
        let (u, l) = (at(pins, h.s[i][9]), at(pins, h.l[i][9]));
        // In front the lining turns back at once: the chin may stand far behind the lips.
        let turn = [1.0, 0.9, 0.6, 0.3, 0.0, 0.0, 0.0][i - 3];
        let back = |p: f32| -0.4 * turn * p * (0.5 + 0.5 * k);
        let row = [
            (h.mu[i][1], vec3(u.x + 0.45 * (l.x - u.x), u.y.max(l.y) + 0.40 * k, u.z.min(l.z) + back(0.4))),
            (h.mu[i][2], vec3(0.8 * l.x, l.y.max(u.y) + 0.42 * k, l.z.min(u.z) + back(1.5))),
            (h.mu[i][3], vec3(0.0, l.y.max(u.y) + 0.75 * k, l.z.min(u.z) + back(2.5))),
            (h.ml[i][1], vec3((0.86 * l.x - 0.05).max(0.0), l.y - 0.14 * k, l.z + back(0.6))),
            (h.ml[i][2], vec3(0.66 * l.x, l.y - 0.45 * k, l.z + back(1.7))),
            (h.ml[i][3], vec3(0.0, l.y - 0.62 * k, l.z + back(2.6))),
        ];
        for (v, p) in row {
            pins.set(v, s.head_from_muzzle(if i == 3 { vec3(0.0, p.y, p.z) } else { p }));
        }
    }
    let c = at(pins, h.s[10][9]);
    for (p, (x, dy)) in [(0.86, 0.16), (0.6, 0.36), (0.0, 0.50)].into_iter().enumerate() {
        let z = c.z - 0.25 * p as f32;
        pins.set(h.mu[10][p + 1], s.head_from_muzzle(vec3(c.x * x, c.y + dy * k, z)));
        pins.set(h.ml[10][p + 1], s.head_from_muzzle(vec3(c.x * x, c.y - dy * k, z)));
    }
}
