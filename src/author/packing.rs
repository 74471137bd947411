//! Charts into the unit square: a joined one at the line u = 0.5, the others beside it, all in the right half.
//!
//! On a grid of cells, so that any outline fits into any bay: from large to small each chart takes the first free place
//! in a fixed order of turns and rows; the scale is the largest at which all find one.

use crate::math::ops;
use std::cmp::Reverse;

/// Cells along the height; the width has half as many.
const CELLS: usize = 512;
/// Cells kept free around a chart: between two charts lie two, which are four texels of a texture of 1024.
const GUTTER: usize = 1;
/// Turns that are tried.
const TURNS: usize = 16;

/// A chart laid flat.
pub(super) struct Island {
    /// Corners, counter-clockwise.
    pub(super) faces: Vec<[usize; 3]>,
    /// Places; one scale for all islands.
    pub(super) at: Vec<[f64; 2]>,
    /// Whether it joins its mirror image at x = 0.
    pub(super) is_joined: bool,
}

/// A chart on the grid: which cells it touches, with its gutter.
struct Mask {
    width: usize,
    height: usize,
    cells: Vec<(usize, usize)>,
}

/// Places of all islands: u from 0.5 to 1, v from 0 at the top; none where there is no scale at all.
pub(super) fn pack(islands: &[Island]) -> Option<Vec<Vec<[f64; 2]>>> {
    let size = islands.iter().flat_map(|i| &i.at).flatten().fold(0.0, |most: f64, x| most.max(x.abs()));
    // From where the largest alone is too large, by one part in a hundred.
    let mut scale = CELLS as f64 / size;
    for _ in 0..500 {
        if let Some(placed) = at_scale(islands, scale) {
            return Some(placed);
        }
        scale *= 0.99;
    }
    None
}

fn at_scale(islands: &[Island], scale: f64) -> Option<Vec<Vec<[f64; 2]>>> {
    let mut taken = vec![false; CELLS * CELLS / 2];
    let mut order: Vec<usize> = (0..islands.len()).collect();
    order.sort_by_key(|&k| (Reverse(islands[k].is_joined), Reverse((area(&islands[k]) * 1e6) as u64), k));
    let mut out = vec![Vec::new(); islands.len()];
    for k in order {
        out[k] = place(&islands[k], scale, &mut taken)?;
    }
    Some(out)
}

fn area(island: &Island) -> f64 {
    let at = |v: usize| island.at[v];
    let twice = |f: &[usize; 3]| {
        let [p, q, r] = f.map(at);
        (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1])
    };
    island.faces.iter().map(twice).sum::<f64>() / 2.0
}

/// The first free place, marked as taken.
fn place(island: &Island, scale: f64, taken: &mut [bool]) -> Option<Vec<[f64; 2]>> {
    let turns = if island.is_joined { 1 } else { TURNS };
    for turn in 0..turns {
        let angle = core::f64::consts::TAU * turn as f64 / turns as f64;
        let (sin, cos) = (ops::sin(angle), ops::cos(angle));
        // In cells, v downwards.
        let mut at: Vec<[f64; 2]> =
            island.at.iter().map(|p| [scale * (cos * p[0] - sin * p[1]), -scale * (sin * p[0] + cos * p[1])]).collect();
        let least = |x: usize| at.iter().fold(f64::INFINITY, |m, p| m.min(p[x]));
        let corner = [if island.is_joined { 0.0 } else { least(0) }, least(1)];
        at.iter_mut().for_each(|p| (0..2).for_each(|x| p[x] -= corner[x]));
        let mask = mask(island, &at);
        let (wide, high) = (CELLS / 2, CELLS);
        if mask.width > wide || mask.height > high {
            continue;
        }
        let columns = if island.is_joined { 0..1 } else { 0..wide - mask.width + 1 };
        for row in 0..=high - mask.height {
            for column in columns.clone() {
                if mask.cells.iter().any(|&(x, y)| taken[(row + y) * wide + column + x]) {
                    continue;
                }
                mask.cells.iter().for_each(|&(x, y)| taken[(row + y) * wide + column + x] = true);
                // The mask begins a gutter before the chart, but for the side where it joins its image.
                let left = if island.is_joined { 0 } else { GUTTER };
                let to = |p: &[f64; 2]| {
                    let (x, y) = (p[0] + (column + left) as f64, p[1] + (row + GUTTER) as f64);
                    [0.5 + x / CELLS as f64, y / CELLS as f64]
                };
                return Some(at.iter().map(to).collect());
            }
        }
    }
    None
}

/// The cells of an island whose corner lies at the origin.
fn mask(island: &Island, at: &[[f64; 2]]) -> Mask {
    let most = |x: usize| at.iter().fold(0.0, |m: f64, p| m.max(p[x]));
    let left = if island.is_joined { 0 } else { GUTTER };
    let (width, height) = (most(0) as usize + 1 + left + GUTTER, most(1) as usize + 1 + 2 * GUTTER);
    let mut filled = vec![false; width * height];
    for f in &island.faces {
        let [p, q, r] = f.map(|v| at[v]);
        let range = |x: usize| (p[x].min(q[x]).min(r[x]) as usize, p[x].max(q[x]).max(r[x]) as usize);
        let ((x0, x1), (y0, y1)) = (range(0), range(1));
        for y in y0..=y1 {
            for x in x0..=x1 {
                if touches([p, q, r], x as f64, y as f64) {
                    filled[(y + GUTTER) * width + x + left] = true;
                }
            }
        }
    }
    let mut cells = Vec::new();
    for y in 0..height {
        for x in 0..width {
            let (x0, x1) = (x.saturating_sub(GUTTER), (x + GUTTER).min(width - 1));
            let (y0, y1) = (y.saturating_sub(GUTTER), (y + GUTTER).min(height - 1));
            if (y0..=y1).any(|y| (x0..=x1).any(|x| filled[y * width + x])) {
                cells.push((x, y));
            }
        }
    }
    Mask { width, height, cells }
}

/// Whether a triangle (counter-clockwise as seen, v downwards) touches the cell whose corner is given: no side has it
/// wholly outside.
fn touches([p, q, r]: [[f64; 2]; 3], x: f64, y: f64) -> bool {
    let turn = (q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]);
    [(p, q), (q, r), (r, p)].iter().all(|(a, b)| {
        let (dx, dy) = ((b[0] - a[0]) * turn.signum(), (b[1] - a[1]) * turn.signum());
        let inside = |x: f64, y: f64| dx * (y - a[1]) - dy * (x - a[0]) >= 0.0;
        inside(x, y) || inside(x + 1.0, y) || inside(x, y + 1.0) || inside(x + 1.0, y + 1.0)
    })
}
