//! Direction in which hair lies: from the nose towards the neck, along the rings; on ears from base to tip; on lids
//! outwards. A difference of two control positions for each vertex, so it follows every breed.

use super::handles::{EAR_RINGS, Handles, NONE};

/// For each half vertex, the vertices from which and to which hair points; equal where there is none.
pub(super) fn pairs(h: &Handles, n: usize) -> Vec<(u16, u16)> {
    let mut out: Vec<(u16, u16)> = (0..n as u16).map(|v| (v, v)).collect();
    let at = |row: &[u16], j: usize| row.get(j).copied().unwrap_or(NONE);
    let mut strand = |before: u16, v: u16, after: u16| {
        if v != NONE {
            let ok = |u: u16| if u == NONE { v } else { u };
            out[v as usize] = (ok(before), ok(after));
        }
    };
    for i in 1..20 {
        for j in 0..10 {
            let (before, after) = (at(&h.s[i - 1], j), if i < 19 { at(&h.s[i + 1], j) } else { NONE });
            strand(before, at(&h.s[i], j), after);
        }
    }
    for i in 3..20 {
        for j in 10..15 {
            let (before, after) = (if i > 3 { h.l[i - 1][j] } else { NONE }, if i < 19 { h.l[i + 1][j] } else { NONE });
            strand(before, h.l[i][j], after);
        }
    }
    // Over the chin's front hair runs down and back.
    for j in 10..14 {
        strand(h.l[3][j - 1], h.l[3][j], h.l[3][j + 1]);
    }
    for k in 0..12 {
        strand(h.er[k], h.of[k], h.orbit[k]);
        for r in 0..EAR_RINGS {
            let before = if r == 0 { h.ear_base[k] } else { h.a[r - 1][k] };
            let after = if r + 1 < EAR_RINGS { h.a[r + 1][k] } else { NONE };
            strand(before, h.a[r][k], after);
        }
    }
    for (k, v) in h.ear_end.into_iter().enumerate() {
        strand(h.a[EAR_RINGS - 1][k * 12 / 8], v, NONE);
    }
    out
}
