//! The table: for each cell of the space of motion, the pairs of spheres that can touch while the motion stays in it.
//!
//! The space is halved again and again. In each box every sphere is where the box's middle puts it, give or take the travel
//! that the box allows it at most, so that no pair is missed between two samples; pairs that are farther apart than that go
//! no further. What is left in a box that is one cell is the cell's list.
//!
//! Lips and tongue are moved by more than the parameters. How far they may have strayed from where those put them is a
//! further axis of a table, of a few levels: what strays little has short lists.

use super::motion::{AXES, Params, Swing, Travel};
use super::parts::{Part, Spheres};
use crate::math::ops;
use glam::Vec3;
use std::ops::Range;

/// Two parts that may not go through each other.
pub type Pairing = [Part; 2];

/// Numbers of two spheres, of the first part of a pairing and of the second.
pub type Pair = [u16; 2];

/// Two spheres that overlap.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Contact {
    /// Which.
    pub pair: Pair,
    /// How deep they are in each other, metres, above zero.
    pub depth: f32,
    /// Unit, from the first one's centre to the second's: the way that frees the second.
    pub direction: Vec3,
}

/// Whether two spheres overlap.
#[inline(always)]
fn contact(spheres: &Spheres, centres: &[Vec3], [a, b]: Pair) -> Option<Contact> {
    let (i, j) = (usize::from(a), usize::from(b));
    let between = centres[j] - centres[i];
    let reach = spheres.at_rest[i].radius + spheres.at_rest[j].radius;
    let off = between.length_squared();
    if off >= reach * reach {
        return None;
    }
    let distance = ops::sqrt(off);
    // Of one centre any way out is as short.
    let direction = if distance > 0.0 { between / distance } else { Vec3::Y };
    Some(Contact { pair: [a, b], depth: reach - distance, direction })
}

/// Tests every pair of the pairings, in their order, and appends the contacts: what a table saves, and what it is held
/// against. `centres`: as many as spheres.
pub fn test_all(spheres: &Spheres, pairings: &[Pairing], centres: &[Vec3], out: &mut Vec<Contact>) {
    for pair in all_pairs(spheres, pairings) {
        out.extend(contact(spheres, centres, pair));
    }
}

/// Every pair of the pairings.
pub fn all_pairs(spheres: &Spheres, pairings: &[Pairing]) -> impl Iterator<Item = Pair> {
    pairings.iter().flat_map(|&[first, second]| {
        let second = spheres.of(second);
        spheres.of(first).flat_map(move |a| second.clone().map(move |b| [a as u16, b as u16]))
    })
}

/// The lists of pairs over a space of motion cut into cells.
#[derive(Clone, Debug)]
pub struct Table {
    ends: [Params; 2],
    cells: [usize; AXES],
    /// How far soft parts may have strayed at each level, metres, ascending.
    levels: Vec<f32>,
    /// Where the list of each level's cells starts in `pairs`, and where the last one ends. The last axis runs fastest.
    starts: Vec<u32>,
    pairs: Vec<Pair>,
    /// Spheres that are in any list, ascending.
    kept: Vec<u16>,
}

/// Centres and radii are rounded, and so are sums of them: by far less than this, metres.
const ROUNDING: f32 = 1e-6;

/// The build's state: what every box needs, and the lists of the cells done so far.
struct Sweep<'a> {
    spheres: &'a Spheres,
    table: &'a Table,
    /// Of each sphere: whether it may stray, and its radius with what it strays.
    soft: Vec<bool>,
    reach: Vec<f32>,
    /// Of each sphere: the number of the last box that asked for it, where it is in the middle of that, and how far it travels.
    asked: Vec<u32>,
    n_boxes: u32,
    centres: Vec<Vec3>,
    travel: Vec<Travel>,
    lists: Vec<Vec<Pair>>,
}

impl Table {
    /// Sweeps the space between two ends, cut into so many cells on each axis (at least one), for these pairings; `levels`:
    /// how far soft parts may stray, metres, ascending.
    pub fn new(
        spheres: &Spheres,
        pairings: &[Pairing],
        ends: [Params; 2],
        cells: [usize; AXES],
        levels: Vec<f32>,
    ) -> Self {
        let mut table = Table {
            ends,
            cells: cells.map(|n| n.max(1)),
            levels,
            starts: vec![0],
            pairs: Vec::new(),
            kept: Vec::new(),
        };
        let pairs: Vec<Pair> = all_pairs(spheres, pairings).collect();
        for list in table.sweep(spheres, &pairs) {
            table.pairs.extend_from_slice(&list);
            table.starts.push(table.pairs.len() as u32);
        }
        table.kept = table.pairs.iter().flatten().copied().collect();
        table.kept.sort_unstable();
        table.kept.dedup();
        table
    }

    /// The lists of each level's cells.
    fn sweep(&self, spheres: &Spheres, pairs: &[Pair]) -> Vec<Vec<Pair>> {
        let n = spheres.at_rest.len();
        let n_cells: usize = self.cells.iter().product();
        let mut sweep = Sweep {
            spheres,
            table: self,
            soft: (0..n).map(|k| spheres.part(k).is_soft()).collect(),
            reach: vec![0.0; n],
            asked: vec![0; n],
            n_boxes: 0,
            centres: vec![Vec3::ZERO; n],
            travel: vec![Travel::default(); n],
            lists: vec![Vec::new(); n_cells * self.levels.len()],
        };
        let Some((&most, lower)) = self.levels.split_last() else { return sweep.lists };
        sweep.set_stray(most);
        let first = n_cells * lower.len();
        sweep.halve(pairs, self.cells.map(|n| 0..n), first);
        // What strays less touches no more.
        for (level, &stray) in lower.iter().enumerate() {
            sweep.set_stray(stray);
            for cell in 0..n_cells {
                let all = std::mem::take(&mut sweep.lists[first + cell]);
                sweep.lists[level * n_cells + cell] = sweep.touching(&all, &self.cell_at(cell));
                sweep.lists[first + cell] = all;
            }
        }
        sweep.lists
    }

    /// Where a cell lies, each axis a range of one.
    fn cell_at(&self, mut cell: usize) -> [Range<usize>; AXES] {
        let mut at = [const { 0..0 }; AXES];
        for axis in (0..AXES).rev() {
            let k = cell % self.cells[axis];
            at[axis] = k..k + 1;
            cell /= self.cells[axis];
        }
        at
    }

    /// Number of the list for these parameters (of those beyond an end, for the nearest) and for soft parts that stray no
    /// farther than so many metres; none where that is farther than any level.
    pub fn cell(&self, params: Params, stray: f32) -> Option<usize> {
        let [least, most] = &self.ends;
        let level = self.levels.iter().position(|&level| stray <= level)?;
        Some((0..AXES).fold(level, |cell, axis| {
            let n = self.cells[axis];
            let width = most.0[axis] - least.0[axis];
            let part = if width > 0.0 { (params.0[axis] - least.0[axis]) / width } else { 0.0 };
            // What is no number becomes the first cell.
            cell * n + ((part * n as f32) as usize).min(n - 1)
        }))
    }

    /// The pairs of a list.
    pub fn list(&self, cell: usize) -> &[Pair] {
        &self.pairs[self.starts[cell] as usize..self.starts[cell + 1] as usize]
    }

    /// Number of lists: cells at each level.
    pub fn n_cells(&self) -> usize {
        self.starts.len() - 1
    }

    /// The spheres of any list, ascending: the others never need to be moved.
    pub fn kept(&self) -> &[u16] {
        &self.kept
    }

    /// Those of them in a range of numbers.
    pub fn kept_in(&self, range: Range<usize>) -> &[u16] {
        let [start, end] = [range.start, range.end].map(|n| self.kept.partition_point(|&k| usize::from(k) < n));
        &self.kept[start..end]
    }

    /// Bytes of the lists.
    pub fn n_bytes(&self) -> usize {
        size_of_val(&self.pairs[..]) + size_of_val(&self.starts[..])
    }

    /// Most pairs of a list.
    pub fn longest(&self) -> usize {
        (0..self.n_cells()).map(|cell| self.list(cell).len()).max().unwrap_or(0)
    }

    /// Tests the pairs of a list and appends the contacts in the order of [`test_all`]. `centres`: as many as spheres, of
    /// which those that are kept are read.
    pub fn query(&self, spheres: &Spheres, cell: usize, centres: &[Vec3], out: &mut Vec<Contact>) {
        for &pair in self.list(cell) {
            out.extend(contact(spheres, centres, pair));
        }
    }

    /// Middle and half widths of a box of cells. A little wider than the box: parameters on a border are rounded to one side.
    fn bounds(&self, cells: &[Range<usize>; AXES]) -> [Params; 2] {
        let [least, most] = &self.ends;
        let along = |axis: usize, cell: usize| {
            let t = cell as f32 / self.cells[axis] as f32;
            least.0[axis] + t * (most.0[axis] - least.0[axis])
        };
        let end = |axis: usize| (along(axis, cells[axis].start), along(axis, cells[axis].end));
        let middle = Params(std::array::from_fn(|axis| 0.5 * (end(axis).0 + end(axis).1)));
        let half = Params(std::array::from_fn(|axis| 0.5 * (end(axis).1 - end(axis).0) * 1.0001 + 1e-6));
        [middle, half]
    }
}

impl Sweep<'_> {
    fn set_stray(&mut self, stray: f32) {
        for ((reach, sphere), soft) in self.reach.iter_mut().zip(&self.spheres.at_rest).zip(&self.soft) {
            *reach = sphere.radius + if *soft { stray } else { 0.0 };
        }
    }

    /// Keeps of the pairs those that can touch in a box, and goes on with its halves, or stores them where it is one cell;
    /// `first`: the number of the first cell's list.
    fn halve(&mut self, pairs: &[Pair], cells: [Range<usize>; AXES], first: usize) {
        let left = self.touching(pairs, &cells);
        // The axis with the most cells left, of equals the first.
        let widest = (0..AXES).rev().max_by_key(|&axis| cells[axis].len()).unwrap_or(0);
        let Range { start, end } = cells[widest];
        if end - start == 1 {
            let cell = (0..AXES).fold(0, |cell, axis| cell * self.table.cells[axis] + cells[axis].start);
            self.lists[first + cell] = left;
            return;
        }
        if left.is_empty() {
            return;
        }
        let middle = start + (end - start) / 2;
        for half in [start..middle, middle..end] {
            let mut cells = cells.clone();
            cells[widest] = half;
            self.halve(&left, cells, first);
        }
    }

    fn touching(&mut self, pairs: &[Pair], cells: &[Range<usize>; AXES]) -> Vec<Pair> {
        let [middle, half] = self.table.bounds(cells);
        let moved = self.spheres.joints().at(middle);
        self.n_boxes += 1;
        for &k in pairs.iter().flatten() {
            let k = usize::from(k);
            if self.asked[k] != self.n_boxes {
                let (centre, follow) = (self.spheres.at_rest[k].centre, self.spheres.follow[k]);
                self.asked[k] = self.n_boxes;
                self.centres[k] = moved.carry(follow, centre);
                self.travel[k] = self.spheres.joints().travel(follow, centre, &moved, &half);
            }
        }
        let swing = Swing::new(&middle, &half);
        let near = |&&[a, b]: &&Pair| {
            let (a, b) = (usize::from(a), usize::from(b));
            let travel = self.travel[a].apart(&self.travel[b], &swing);
            let reach = self.reach[a] + self.reach[b] + travel + ROUNDING;
            self.centres[a].distance_squared(self.centres[b]) <= reach * reach
        };
        pairs.iter().filter(near).copied().collect()
    }
}
