//! Strictly similar patches (thesis, section 4.7 and figure 4.3).
//!
//! Patches of triangles, one strictly similar to the other triangle by triangle in an order in which each shares an edge
//! with one before, and with equal angles between the planes of neighbours. The thesis asks for the largest and gives no
//! way to find them (that is as hard as the largest common part of two graphs); here they grow greedily from pairs of
//! similar triangles, the largest of some tries is taken, and then every other place where it fits.
//!
//! (The thesis asks for triangles i and i + 1 to share an edge, a strip; here each shares one with *some* triangle before
//! it, which is all that is used: points along shared edges are computed once.)

use super::classes::{Classes, Criteria, Match, Shapes};
use crate::mesh::{DedgeId, FaceId};

/// Partners that are tried for a triangle to grow a patch from.
const MAX_PARTNERS: usize = 12;

/// Patches of one class: all similar.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PatchClass {
    /// Each patch as its triangles, equally many, with how each lies on that at the same place in the first patch.
    pub patches: Vec<Vec<(FaceId, Match)>>,
}

impl PatchClass {
    /// Number of triangles of each patch.
    pub fn size(&self) -> usize {
        self.patches[0].len()
    }
}

/// A patch elsewhere: each triangle with how it lies on that at the same place in the first one.
type Patch = Vec<(FaceId, Match)>;

/// Two similar patches, and how the first was reached.
struct Pair {
    tree: Vec<Reached>,
    first: Patch,
    second: Patch,
}

/// Where a triangle of a patch was reached from: the place of the triangle before it, and the side that was crossed.
#[derive(Clone, Copy)]
struct Reached {
    from: usize,
    side: u32,
}

/// Partitions a mesh into classes of strictly similar patches: each triangle is in exactly one patch. A triangle without a
/// partner is a patch, and a class, of its own.
pub fn patches(shapes: &Shapes<'_>, classes: &Classes, criteria: &Criteria) -> Vec<PatchClass> {
    let mut members: Vec<Vec<FaceId>> = vec![Vec::new(); classes.len()];
    for face in shapes.mesh().faces() {
        members[classes.class[face.index()] as usize].push(face);
    }
    let mut grower = Grower {
        shapes,
        criteria,
        taken: vec![false; shapes.mesh().n_faces()],
        mine: vec![0; shapes.mesh().n_faces()],
        mark: 0,
    };
    let mut found = Vec::new();
    for seed in shapes.mesh().faces() {
        if grower.taken[seed.index()] {
            continue;
        }
        let group = &mut members[classes.class[seed.index()] as usize];
        group.retain(|f| !grower.taken[f.index()]);
        let others: Vec<FaceId> = group.iter().copied().filter(|&f| f != seed).collect();
        let stride = others.len().div_ceil(MAX_PARTNERS).max(1);
        let mut best: Option<Pair> = None;
        for &other in others.iter().rev().step_by(stride) {
            for by in Match::all(criteria.mirrored) {
                if let Some(pair) = grower.grow(seed, other, by)
                    && best.as_ref().is_none_or(|best| pair.first.len() > best.first.len())
                {
                    best = Some(pair);
                }
            }
        }
        let Some(Pair { tree, first, second }) = best else {
            grower.taken[seed.index()] = true;
            found.push(PatchClass { patches: vec![vec![(seed, Match::default())]] });
            continue;
        };
        let mut patches = vec![first, second];
        patches.iter().flatten().for_each(|(f, _)| grower.taken[f.index()] = true);
        for other in others {
            let fitted = Match::all(criteria.mirrored).find_map(|by| grower.fit(&patches[0], &tree, other, by));
            if let Some(patch) = fitted {
                patch.iter().for_each(|(f, _)| grower.taken[f.index()] = true);
                patches.push(patch);
            }
        }
        found.push(PatchClass { patches });
    }
    found
}

struct Grower<'a> {
    shapes: &'a Shapes<'a>,
    criteria: &'a Criteria,
    taken: Vec<bool>,
    /// Triangles of the patches in the making carry the mark of the try.
    mine: Vec<u32>,
    mark: u32,
}

impl Grower<'_> {
    fn is_free(&self, face: FaceId) -> bool {
        !self.taken[face.index()] && self.mine[face.index()] != self.mark
    }

    /// The triangle across side `side` of one, and across the same side of one that lies on it, with how these two lie.
    fn across(&self, face: FaceId, side: u32, (other, by): (FaceId, Match)) -> Option<(FaceId, (FaceId, Match))> {
        let mesh = self.shapes.mesh();
        let dedge = face.dedge(side);
        let there = other.dedge(by.corner(side as usize + usize::from(by.mirrored)) as u32);
        let (twin, twin_there) = (mesh.twin(dedge)?, mesh.twin(there)?);
        if !self.shapes.folds_agree(self.criteria, dedge, there) {
            return None;
        }
        let number = |d: DedgeId| (d.0 % 3) as u8;
        let (here, beside) = (number(twin), number(twin_there));
        // The twin starts where the side ends; mirrored, its match starts where the side begins.
        let turn = if by.mirrored { (beside + here + 1) % 3 } else { (beside + 3 - here) % 3 };
        Some((twin.face(), (twin_there.face(), Match { turn, mirrored: by.mirrored })))
    }

    /// Two patches as large as they get, from two triangles.
    fn grow(&mut self, seed: FaceId, other: FaceId, by: Match) -> Option<Pair> {
        if !self.shapes.are_strictly_similar(seed, other, by, self.criteria) {
            return None;
        }
        self.mark += 1;
        let mut tree = vec![Reached { from: 0, side: 0 }];
        let (mut first, mut second) = (vec![(seed, Match::default())], vec![(other, by)]);
        [seed, other].into_iter().for_each(|f| self.mine[f.index()] = self.mark);
        let mut from = 0;
        while from < tree.len() {
            for side in 0..3 {
                let Some((next, (next_other, next_by))) = self.across(first[from].0, side, second[from]) else {
                    continue;
                };
                if next == next_other
                    || !self.is_free(next)
                    || !self.is_free(next_other)
                    || !self.shapes.are_strictly_similar(next, next_other, next_by, self.criteria)
                {
                    continue;
                }
                [next, next_other].into_iter().for_each(|f| self.mine[f.index()] = self.mark);
                tree.push(Reached { from, side });
                first.push((next, Match::default()));
                second.push((next_other, next_by));
            }
            from += 1;
        }
        Some(Pair { tree, first, second })
    }

    /// The same patch elsewhere, if it fits there.
    fn fit(&mut self, patch: &[(FaceId, Match)], tree: &[Reached], other: FaceId, by: Match) -> Option<Patch> {
        self.mark += 1;
        if !self.is_free(other) || !self.shapes.are_strictly_similar(patch[0].0, other, by, self.criteria) {
            return None;
        }
        let mut fitted = vec![(other, by)];
        self.mine[other.index()] = self.mark;
        for (place, reached) in tree.iter().enumerate().skip(1) {
            let (next, there) = self.across(patch[reached.from].0, reached.side, fitted[reached.from])?;
            let fits = next == patch[place].0
                && self.is_free(there.0)
                && self.shapes.are_strictly_similar(next, there.0, there.1, self.criteria);
            if !fits {
                return None;
            }
            self.mine[there.0.index()] = self.mark;
            fitted.push(there);
        }
        Some(fitted)
    }
}
