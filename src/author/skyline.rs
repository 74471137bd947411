//! A symmetric positive definite system with few entries off its diagonal: Cholesky's factors inside the envelope, with
//! the vertices in the order of reverse Cuthill and McKee 1969.

use crate::math::ops;
use std::collections::BTreeSet;

/// The system, and after [`Skyline::factor`] its factor. Each vertex has `width` unknowns, numbered together.
pub(super) struct Skyline {
    width: usize,
    /// Row of each vertex.
    rank: Vec<usize>,
    /// First column stored in each row, and where the row begins; a row ends with its diagonal.
    first: Vec<usize>,
    start: Vec<usize>,
    entries: Vec<f64>,
}

impl Skyline {
    /// Room for entries between any two corners of a face.
    pub(super) fn new(n: usize, faces: &[[usize; 3]], width: usize) -> Skyline {
        let mut near = vec![BTreeSet::new(); n];
        for f in faces {
            for (a, b) in [(f[0], f[1]), (f[1], f[2]), (f[2], f[0])] {
                near[a].insert(b);
                near[b].insert(a);
            }
        }
        let rank = order(&near);
        let mut first: Vec<usize> = (0..n * width).map(|row| row / width * width).collect();
        for (v, around) in near.iter().enumerate() {
            let least = around.iter().map(|&w| rank[w]).min().unwrap_or(rank[v]).min(rank[v]);
            (0..width).for_each(|x| first[rank[v] * width + x] = least * width);
        }
        let mut start = vec![0];
        for (row, &f) in first.iter().enumerate() {
            start.push(start[row] + row + 1 - f);
        }
        let entries = vec![0.0; start[n * width]];
        Skyline { width, rank, first, start, entries }
    }

    fn row(&self, unknown: usize) -> usize {
        self.rank[unknown / self.width] * self.width + unknown % self.width
    }

    /// Back to zero.
    pub(super) fn clear(&mut self) {
        self.entries.fill(0.0);
    }

    /// Adds to an entry. Those above the diagonal are ignored, their mirror images are what is kept.
    pub(super) fn add(&mut self, i: usize, j: usize, value: f64) {
        let (i, j) = (self.row(i), self.row(j));
        if j <= i {
            let at = self.start[i] + j - self.first[i];
            self.entries[at] += value;
        }
    }

    /// Makes an unknown zero: nothing else may depend on it, since it adds nothing.
    pub(super) fn pin_at_zero(&mut self, unknown: usize) {
        let row = self.row(unknown);
        let range = self.start[row]..self.start[row + 1];
        self.entries[range].fill(0.0);
        for below in row + 1..self.first.len() {
            if self.first[below] <= row {
                let at = self.start[below] + row - self.first[below];
                self.entries[at] = 0.0;
            }
        }
        let diagonal = self.start[row + 1] - 1;
        self.entries[diagonal] = 1.0;
    }

    /// Puts the factor in the place of the matrix.
    pub(super) fn factor(&mut self) {
        for i in 0..self.first.len() {
            let (fi, si) = (self.first[i], self.start[i]);
            let (above, row) = self.entries.split_at_mut(si);
            for j in fi..i {
                let (fj, sj) = (self.first[j], self.start[j]);
                let from = fi.max(fj);
                let other = &above[sj + from - fj..sj + j - fj];
                let sum: f64 = row[from - fi..j - fi].iter().zip(other).map(|(a, b)| a * b).sum();
                row[j - fi] = (row[j - fi] - sum) / above[sj + j - fj];
            }
            let squares: f64 = row[..i - fi].iter().map(|a| a * a).sum();
            row[i - fi] = ops::sqrt(row[i - fi] - squares);
        }
    }

    /// Solves for one right side after [`Skyline::factor`].
    pub(super) fn substitute(&self, right: &mut [f64]) {
        let n = self.first.len();
        let mut x = vec![0.0; n];
        (0..n).for_each(|unknown| x[self.row(unknown)] = right[unknown]);
        for i in 0..n {
            let (f, s) = (self.first[i], self.start[i]);
            let sum: f64 = (f..i).map(|k| self.entries[s + k - f] * x[k]).sum();
            x[i] = (x[i] - sum) / self.entries[s + i - f];
        }
        for i in (0..n).rev() {
            let (f, s) = (self.first[i], self.start[i]);
            x[i] /= self.entries[s + i - f];
            for k in f..i {
                x[k] -= self.entries[s + k - f] * x[i];
            }
        }
        (0..n).for_each(|unknown| right[unknown] = x[self.row(unknown)]);
    }

    /// Factors and solves.
    pub(super) fn solve(&mut self, right: &mut [f64]) {
        self.factor();
        self.substitute(right);
    }
}

/// Breadth first from a vertex far out, fewest neighbours first, then reversed.
fn order(near: &[BTreeSet<usize>]) -> Vec<usize> {
    let walk = |from: usize, seen: &mut Vec<bool>| {
        let mut list = vec![from];
        seen[from] = true;
        let mut i = 0;
        while i < list.len() {
            let mut new: Vec<usize> = near[list[i]].iter().copied().filter(|&w| !seen[w]).collect();
            new.sort_by_key(|&w| (near[w].len(), w));
            new.iter().for_each(|&w| seen[w] = true);
            list.extend(new);
            i += 1;
        }
        list
    };
    let mut seen = vec![false; near.len()];
    let mut all = Vec::new();
    for v in 0..near.len() {
        if !seen[v] {
            // The last of a walk is far out.
            let far = walk(v, &mut seen.clone()).last().copied().unwrap_or(v);
            all.extend(walk(far, &mut seen));
        }
    }
    let mut rank = vec![0; near.len()];
    all.iter().rev().enumerate().for_each(|(i, &v)| rank[v] = i);
    rank
}
