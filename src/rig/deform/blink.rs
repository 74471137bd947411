//! Lids that close: margins and fold turn about an axis across the orbit through the middle of the ball, so that they
//! slide over it.
//!
//! The upper lid goes most of the way (in dogs as in man the levator opens and closes the eye; the lower lid follows).
//! Shut lids are found once for a head. Between open and shut the upper margin keeps its arch and drops, so the slit
//! closes from its corners: if all of it went as great a part of its way, it would be a straight line halfway, which
//! reads as anger.

use super::DeformPlan;
use crate::math::ops;
use crate::rig::eye::Eye;
use crate::rig::handles::Handles;
use glam::Vec3;

/// The part of the slit that the upper lid closes.
const UPPER: f32 = 0.78;
/// How much of its margin's turn the fold of a lid makes: the skin over the ball lies on three rows, not two.
const FOLLOWS: f32 = 0.6;
/// The least part of the way from a shut margin to the orbit's loop at which the fold lies, where it was open so far, and
/// the angle from which on that loop is no farther, radians.
const EVEN: f32 = 0.4;
const FAR: f32 = 1.9;
/// The turn between two rows beyond which the fold lies higher, radians, and how much higher for each, parts of the ball's
/// radius.
const WIDE: f32 = 1.0;
const STRETCHED: f32 = 0.5;
/// By how much the margins' smooth curves pass each other, radians of the ball: 0.1 mm.
const OVERLAP: f32 = 0.01;
/// Between the inner margins, radians.
const SPLIT: f32 = 0.03;
/// Above the ball at least, parts of its radius: inner margin, outer margin, fold. Between two rows the skin runs nearer to
/// the ball than they do, over the third of a turn that a large eye asks for by a fifth of the radius.
const ABOVE: [f32; 3] = [0.02, 0.16, 0.4];
/// What a lid rises above a cornea that turns under it, for what the ball is higher there than when it looked ahead: what
/// lies between two vertices of the lid would touch it.
const OVER_CORNEA: f32 = 0.25;
/// How far a control vertex of a margin goes beyond the line where they meet, radians.
const FARTHEST: f32 = 0.1;
/// How far the upper lid and the lower one turn for a turn of the gaze up or down, and for a raised lid, radians.
const UPPER_FOLLOWS: f32 = 0.55;
const LOWER_FOLLOWS: f32 = 0.12;
const RAISED: f32 = 0.3;
/// The fold's part of it.
const FOLD_FOLLOWS: f32 = 0.5;
/// How much of the slit the upper lid closes at most as it follows the gaze down.
const MOST_DOWN: f32 = 0.7;
/// How much sooner than in the middle of the slit the lids meet towards its corners, where their way is shorter: at 1 the
/// margin starts to drop as it is. More than 1, as the line in which the lids meet is hollow and the arch would sink into it.
const ARCHED: f32 = 2.2;
/// The middle is behind as its corners are ahead, so that half closed is half of what is seen of the ball.
const MIDDLE: f32 = 0.75;
/// How much sooner on the lateral side: the arch is highest a little towards the nose.
const LATERAL: f32 = 0.4;
/// How much sooner than the upper lid the lower one is where it goes.
const LOWER_LEADS: f32 = 1.7;
/// Rounds in which the margins find each other.
const ROUNDS: usize = 6;

/// The left orbit's axis and what lies around it.
struct Hinge<'a> {
    eye: &'a Eye,
    /// Along the slit, upwards, and out of it; unit.
    axes: [Vec3; 3],
}

/// A place by its turn about the hinge.
#[derive(Clone, Copy)]
struct Turned {
    /// Along the hinge and away from it, metres.
    along: f32,
    away: f32,
    /// Above the middle of the slit, radians.
    angle: f32,
}

impl Hinge<'_> {
    fn turned(&self, p: Vec3) -> Turned {
        let [x, y, z] = self.axes.map(|axis| axis.dot(p - self.eye.centre));
        Turned { along: x, away: ops::hypot(y, z), angle: ops::atan2(y, z) }
    }

    fn place(&self, t: Turned) -> Vec3 {
        let [a, b, g] = self.axes;
        self.eye.centre + a * t.along + (b * ops::sin(t.angle) + g * ops::cos(t.angle)) * t.away
    }

    /// Not nearer to the ball than `rest` was to the ball `ahead`, or than `above` asks for.
    fn off(&self, p: Vec3, ahead: &Eye, rest: Vec3, above: f32) -> Vec3 {
        let from = rest - ahead.centre;
        let was = from.length() - ahead.reach(from.normalize_or(self.axes[2]));
        let out = (p - self.eye.centre).normalize_or(self.axes[2]);
        let (now, before) = (self.eye.reach(out), ahead.reach(out));
        let least = now + was.min(above * self.eye.radius) + OVER_CORNEA * (now - before).max(0.0);
        self.eye.centre + out * (p - self.eye.centre).length().max(least)
    }

    /// Turned to an angle, and then not nearer to the ball than this.
    fn slid(&self, p: Vec3, angle: f32, above: f32) -> Vec3 {
        let p = self.place(Turned { angle, ..self.turned(p) });
        let from = p - self.eye.centre;
        let out = from.normalize_or(self.axes[2]);
        let least = self.eye.reach(out) + above * self.eye.radius;
        self.eye.centre + out * from.length().max(least)
    }
}

/// What the lids of an eye do.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Lids {
    /// 0 is open as at rest, 1 shut.
    pub closed: f32,
    /// How far the upper lid is raised beyond its rest, 0 to 1.
    pub raised: f32,
    /// How far the eye looks up, radians: the upper lid follows the pupil, the lower one a little.
    pub lift: f32,
}

/// Puts the left lids where they are; `eye`: with its gaze; `axes`: unit, those of the orbit in the head's frame; `rest`:
/// the half's control positions with open lids around the eye at rest (`ahead`), metres; `at`: scratch of the same length,
/// of which the lids' vertices ([`vertices`]) are the result.
pub fn place(
    plan: &DeformPlan,
    (eye, ahead): (&Eye, &Eye),
    axes: [Vec3; 3],
    lids: Lids,
    rest: &[Vec3],
    at: &mut Vec<Vec3>,
) {
    let hinge = Hinge { eye, axes };
    let h = plan.handles();
    at.clear();
    at.extend_from_slice(rest);
    if lids.closed > 0.0 {
        shut(plan, &hinge, rest, at);
    }
    let ways: [f32; 6] = std::array::from_fn(|k| {
        let [open, shut] = [rest, &**at].map(|at| hinge.turned(at[usize::from(h.er[k])]).angle);
        (open - shut).abs().max(1e-3)
    });
    let longest = ways[1..].iter().copied().fold(0.0, f32::max);
    let closing = |k: usize| {
        let column = k.min(12 - k);
        let sooner =
            MIDDLE * ops::powf(longest / ways[column], ARCHED) * (1.0 + LATERAL * (column as f32 - 3.0).max(0.0));
        let sooner = if k < 6 { sooner } else { sooner * LOWER_LEADS };
        1.0 - ops::powf(1.0 - lids.closed.clamp(0.0, 1.0), sooner)
    };
    for k in (1..12).filter(|k| k % 6 != 0) {
        let is_upper = k < 6;
        let closed = closing(k);
        // The middle of a lid goes farthest; what looks down does not shut the eye.
        let middle = ops::sin(core::f32::consts::PI * (k % 6) as f32 / 6.0);
        let [own, other] = [h.er[k], h.er[12 - k]].map(|v| hinge.turned(rest[usize::from(v)]).angle);
        let follows =
            if is_upper { UPPER_FOLLOWS * lids.lift + RAISED * lids.raised } else { LOWER_FOLLOWS * lids.lift };
        let least = -MOST_DOWN * (own - other).abs();
        let turn = middle * if is_upper { follows.max(least) } else { follows };
        for (row, part, above) in [(&h.of, FOLD_FOLLOWS, ABOVE[2]), (&h.er, 1.0, ABOVE[1]), (&h.ei, 1.0, ABOVE[0])] {
            let v = usize::from(row[k]);
            let (mut open, shut) = (hinge.turned(rest[v]), hinge.turned(at[v]));
            open.angle += turn * part;
            let mix = |a: f32, b: f32| a + (b - a) * closed;
            let p = hinge.place(Turned {
                along: mix(open.along, shut.along),
                away: mix(open.away, shut.away),
                angle: mix(open.angle, shut.angle),
            });
            // The cornea goes with the gaze, and lifts the lids: as far off it as they were, or as they need be.
            at[v] =
                if lids.closed == 0.0 && eye == ahead && turn == 0.0 { p } else { hinge.off(p, ahead, rest[v], above) };
        }
    }
}

/// The half's vertices that move.
pub fn vertices(handles: &Handles) -> impl Iterator<Item = usize> + '_ {
    let rows = [&handles.of, &handles.er, &handles.ei];
    // The corners stay.
    rows.into_iter().flat_map(|row| (0..12).filter(|k| k % 6 != 0).map(|k| usize::from(row[k])))
}

fn shut(plan: &DeformPlan, hinge: &Hinge, rest: &[Vec3], at: &mut [Vec3]) {
    let (h, rings, limit) = (plan.handles(), plan.rings(), plan.limit());
    let angle = |p: Vec3| hinge.turned(p).angle;
    // Of upper and lower margin, where they meet.
    let mut meeting: [[f32; 2]; 6] = std::array::from_fn(|k| {
        let [upper, lower] = [k, (12 - k) % 12].map(|k| angle(rest[usize::from(h.er[k])]));
        [upper + (lower - upper) * UPPER; 2]
    });
    for round in 0..=ROUNDS {
        for (k, m) in meeting.iter().enumerate().skip(1) {
            let line = 0.5 * (m[0] + m[1]);
            for (side, k_of) in [k, 12 - k].into_iter().enumerate() {
                let [of, er, ei] = [h.of[k_of], h.er[k_of], h.ei[k_of]].map(usize::from);
                let up = if side == 0 { 1.0 } else { -1.0 };
                let turn = m[side] - angle(rest[er]);
                at[er] = hinge.slid(rest[er], m[side], ABOVE[1]);
                at[ei] = hinge.slid(rest[ei], line + 0.5 * up * SPLIT, ABOVE[0]);
                // Where the skin beyond the fold would be stretched thin over the ball, the fold follows less.
                let (open, orbit) = (angle(rest[of]), angle(rest[usize::from(h.orbit[k_of])]).clamp(-FAR, FAR));
                let even = m[side] + EVEN * (orbit - m[side]);
                let follows = up * (up * (open + FOLLOWS * turn)).max((up * even).min(up * open));
                let spans = [up * (follows - m[side]), up * (orbit - follows)];
                let wide = spans.map(|span| (span - WIDE).max(0.0));
                at[of] = hinge.slid(rest[of], follows, ABOVE[2] + STRETCHED * (wide[0] + wide[1]));
            }
        }
        if round == ROUNDS {
            break;
        }
        for (k, m) in meeting.iter_mut().enumerate().skip(1) {
            let [upper, lower] = [k, 12 - k].map(|k| angle(limit.of(rings, usize::from(h.er[k]), at)));
            let apart = upper - lower + OVERLAP;
            // A smooth curve stays behind its control vertices.
            let beyond = 0.5 * (m[1] - m[0]);
            let step = (0.5 * apart).clamp(-0.05, (FARTHEST - beyond).max(-0.05));
            m[0] -= step;
            m[1] += step;
        }
    }
}
