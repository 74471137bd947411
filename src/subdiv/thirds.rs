//! The topology of one √3 step: from a mesh to its child, by arithmetic alone.
//!
//! Kobbelt 2000 inserts a vertex in each face, splits the face in three and flips the old edges. Done in one go, the
//! child of a directed edge `e` from `a` to `b` is one triangle, and it has the number `e`:
//!
//! ```text
//!              b                 X(e): the new vertex on the left of e,
//!            / | \               Y = X(twin e): the one on its right.
//!           /  |  \
//!        X ----|---- Y           child e      = (a, Y, X)
//!           \  e  /              child twin e = (b, X, Y)
//!            \ | /
//!              a                 so X-Y is the flipped edge, and side 1 of both.
//! ```
//!
//! On the boundary there is no Y. A keeping step leaves `(a, b, X)`. A trisecting step puts `p` and `q` on `a`-`b`
//! instead of one vertex into the face, and fans the face `(a, b, c)` from `c`; the sides `b`-`c` and `c`-`a` flip as
//! above, with `q` and `p` in the place of X, and the child of the boundary itself is the triangle in the middle:
//!
//! ```text
//!              c
//!            // \\               child of a-b = (p, q, c)
//!           / |  | \             X(b-c) = q
//!          / /    \ \            X(c-a) = p
//!        a---p----q---b
//! ```
//!
//! Navarro Newball, Wyvill and McCane 2008 count elements (formulas 7 to 9) to give directed edges their numbers
//! before a flip without searching; that each directed edge has exactly one child triangle, wherever it lies, carries
//! this to its end: twins and outgoing directed edges of the child follow from those of the parent.
//!
//! Creases and the rims of frozen regions are boundaries with a surface on both sides: the same triangles, once on each
//! side, and twins across. Frozen faces are copied behind the others, and their edges are never cut.
//!
//! A trisecting step needs faces with at most one side to cut. A keeping step makes such faces of any.

use crate::mesh::{DedgeId, DedgeMesh};

use super::level::{Level, Sharpness};
use super::refined::{Refined, VertexParent};
use super::rule::{Surroundings, less_one};
use super::scheme::{BoundaryStep, Creasing};

const NONE: u32 = u32::MAX;

/// Refines the connectivity by one √3 step, in linear time.
///
/// The caller sees to the size (three times the faces must fit 32 bits) and to the alternation of steps: a trisecting
/// one is taken only after a keeping one, so that no face has two sides to cut.
pub(super) fn refine(level: &Level, step: BoundaryStep) -> Refined {
    let child = Step::new(level, step).run();
    child.debug_assert_sound();
    child
}

/// The numbers of new vertices, and which faces are fanned.
struct Step<'a> {
    level: &'a Level,
    mesh: &'a DedgeMesh,
    /// The first (or only) new vertex of each face: in a fanned face that at the first third of its side to cut.
    new_vertex: Vec<u32>,
    /// The side to cut of each fanned face, [`NONE`] for the others. Empty in a keeping step.
    fanned: Vec<u32>,
    parents: Vec<VertexParent>,
}

impl<'a> Step<'a> {
    fn new(level: &'a Level, step: BoundaryStep) -> Self {
        let mesh = &level.mesh;
        let fanned = match step {
            BoundaryStep::Keep => Vec::new(),
            BoundaryStep::Trisect => sides_to_cut(level),
        };
        let mut parents: Vec<_> = mesh.vertices().map(VertexParent::Vertex).collect();
        parents.reserve(level.n_active as usize + fanned.iter().filter(|&&d| d != NONE).count());
        let mut new_vertex: Vec<u32> = Vec::with_capacity(level.n_active as usize);
        for face in mesh.faces().take(level.n_active as usize) {
            let next = parents.len() as u32;
            match fanned.get(face.index()) {
                Some(&dedge) if dedge != NONE => {
                    let dedge = DedgeId(dedge);
                    match mesh.twin(dedge).filter(|twin| *twin < dedge) {
                        // The points of a crease came with the face on its other side, the other way round.
                        Some(twin) => new_vertex.push(new_vertex[twin.face().index()] + 1),
                        None => {
                            new_vertex.push(next);
                            parents.extend([VertexParent::FirstThird(dedge), VertexParent::SecondThird(dedge)]);
                        }
                    }
                }
                _ => {
                    new_vertex.push(next);
                    parents.push(VertexParent::Face(face));
                }
            }
        }
        Step { level, mesh, new_vertex, fanned, parents }
    }

    fn run(self) -> Refined {
        let n_active = 3 * self.level.n_active;
        let n_frozen = self.mesh.n_dedges() - n_active as usize;
        let mut origin = Vec::with_capacity(3 * n_active as usize + n_frozen);
        let mut twin = Vec::with_capacity(3 * n_active as usize + n_frozen);
        for dedge in (0..n_active).map(DedgeId) {
            let (corners, twins) = if !self.level.is_open(dedge) {
                self.flipped(dedge)
            } else if self.fan(dedge) == Some(dedge) {
                self.middle(dedge)
            } else {
                self.kept(dedge)
            };
            origin.extend(corners);
            twin.extend(twins);
        }
        for dedge in (n_active..self.mesh.n_dedges() as u32).map(DedgeId) {
            origin.push(self.mesh.origin(dedge).0);
            twin.push(self.mesh.twin(dedge).map_or(NONE, |other| self.kept_side(other)));
        }
        let outgoing = self.parents.iter().map(|&parent| self.outgoing(parent)).collect();
        Refined { mesh: DedgeMesh { origin, twin, outgoing }, parents: self.parents }
    }

    /// The side to cut of the directed edge's face, if that is fanned.
    #[inline]
    fn fan(&self, dedge: DedgeId) -> Option<DedgeId> {
        let side = *self.fanned.get(dedge.face().index())?;
        (side != NONE).then_some(DedgeId(side))
    }

    /// The new vertices at the first and the second third of a side that is cut.
    #[inline]
    fn thirds(&self, side: DedgeId) -> (u32, u32) {
        let first = self.new_vertex[side.face().index()];
        let is_older = self.mesh.twin(side).is_some_and(|twin| twin < side);
        (first, if is_older { first - 1 } else { first + 1 })
    }

    /// X: the new vertex on the left of a directed edge that is not cut.
    #[inline]
    fn left(&self, dedge: DedgeId) -> u32 {
        match self.fan(dedge) {
            Some(side) if dedge == side.next() => self.thirds(side).1,
            _ => self.new_vertex[dedge.face().index()],
        }
    }

    /// Child (a, Y, X) of a directed edge that is turned, and the twins of its sides.
    #[inline]
    fn flipped(&self, dedge: DedgeId) -> ([u32; 3], [u32; 3]) {
        let other = DedgeId(self.mesh.twin[dedge.index()]);
        let a = self.mesh.origin(dedge).0;
        let corners = [a, self.left(other), self.left(dedge)];

        // a-Y lies in the face on the right.
        let below = match self.fan(other) {
            None => child_side(other.next(), 2),
            Some(side) if other == side.next() => child_side(side, 1),
            // It is the first third of the side: across lies what follows that side's twin.
            Some(side) => self.mesh.twin(side).map_or(NONE, |across| child_side(across.next(), 2)),
        };
        // X-a lies in the face on the left.
        let above = match self.fan(dedge) {
            None => self.around_origin(dedge),
            Some(side) if dedge == side.prev() => child_side(side, 2),
            // It is the last third of the side, whose twin starts here.
            Some(side) => self.mesh.twin(side).map_or(NONE, |across| self.around_origin(across)),
        };
        (corners, [below, child_side(other, 1), above])
    }

    /// Child (a, b, X) of a directed edge that stays as it is.
    fn kept(&self, dedge: DedgeId) -> ([u32; 3], [u32; 3]) {
        let corners = [self.mesh.origin(dedge).0, self.mesh.target(dedge).0, self.left(dedge)];
        let across = self.mesh.twin(dedge).map_or(NONE, |other| self.kept_side(other));
        (corners, [across, child_side(dedge.next(), 2), self.around_origin(dedge)])
    }

    /// Where a directed edge that stays as it is lies in the child.
    fn kept_side(&self, dedge: DedgeId) -> u32 {
        let n_active = 3 * self.level.n_active;
        // A frozen face is three directed edges behind all children.
        if dedge.0 >= n_active { dedge.0 - n_active + 3 * n_active } else { child_side(dedge, 0) }
    }

    /// Child (p, q, c) of a directed edge that is cut.
    fn middle(&self, dedge: DedgeId) -> ([u32; 3], [u32; 3]) {
        let (p, q) = self.thirds(dedge);
        let corners = [p, q, self.mesh.origin(dedge.prev()).0];
        let across = self.mesh.twin(dedge).map_or(NONE, |other| child_side(other, 0));
        // The other two sides are turned, see the top of the file.
        let right = self.mesh.twin(dedge.next()).map_or(NONE, |other| child_side(other, 0));
        (corners, [across, right, child_side(dedge.prev(), 2)])
    }

    /// In a face with a vertex in its middle: the twin of side 2 (X-a) of the child of a directed edge from a.
    /// In a fanned one, for the side to cut: the twin of the first third of it.
    #[inline]
    fn around_origin(&self, dedge: DedgeId) -> u32 {
        match self.mesh.twin(dedge.prev()) {
            Some(other) if !self.level.is_open(dedge.prev()) => child_side(other, 0),
            _ => child_side(dedge.prev(), 1),
        }
    }

    fn outgoing(&self, parent: VertexParent) -> u32 {
        match parent {
            VertexParent::Vertex(vertex) => {
                let dedge = self.mesh.outgoing(vertex);
                if self.level.is_frozen_dedge(dedge) {
                    return self.kept_side(dedge);
                }
                match self.fan(dedge) {
                    // The first third of a side that is cut belongs to the child across the side before it.
                    Some(side) if dedge == side => self.around_origin(dedge),
                    _ => child_side(dedge, 0),
                }
            }
            VertexParent::Face(face) => child_side(face.dedge(0), 2),
            VertexParent::FirstThird(dedge) => child_side(dedge, 0),
            VertexParent::SecondThird(dedge) => child_side(dedge.next(), 2),
            VertexParent::Edge(_) => unreachable!("√3 puts no vertex into the middle of an edge"),
        }
    }
}

/// Side `side` of the child of a directed edge.
#[inline(always)]
fn child_side(dedge: DedgeId, side: u32) -> u32 {
    3 * dedge.0 + side
}

/// The side to cut of each face that is refined, [`NONE`] where there is none.
fn sides_to_cut(level: &Level) -> Vec<u32> {
    let mut sides = vec![NONE; level.n_active as usize];
    for dedge in (0..3 * level.n_active).map(DedgeId).filter(|&d| level.is_divisible(d)) {
        debug_assert_eq!(sides[dedge.face().index()], NONE, "a keeping step comes first");
        sides[dedge.face().index()] = dedge.0;
    }
    sides
}

/// What is left of the sharpness after a step: nothing happens to it in a keeping step, it falls in a trisecting one,
/// where the curves are cut.
pub(super) fn child_sharpness(level: &Level, child: &Refined, step: BoundaryStep, creasing: Creasing) -> Sharpness {
    let old = &level.sharpness;
    if old.is_empty() {
        return Sharpness::default();
    }
    let mut dedges = vec![0.0; child.mesh.n_dedges()];
    let mut around = Surroundings::default();
    let mut set = |dedge: u32, value: f32| {
        dedges[dedge as usize] = value;
        let twin = child.mesh.twin[dedge as usize];
        if twin != NONE {
            dedges[twin as usize] = value;
        }
    };
    for dedge in (0..3 * level.n_active).map(DedgeId).filter(|&d| old.dedge(d) > 0.0) {
        let sharpness = old.dedge(dedge);
        if step == BoundaryStep::Keep || !level.is_divisible(dedge) {
            set(child_side(dedge, 0), sharpness);
            continue;
        }
        // The last third; the first one is the last of the twin.
        let vertex = level.mesh.target(dedge);
        level.surroundings(vertex, &mut around);
        let place = level.mesh.ring(vertex).position(|v| v == level.mesh.origin(dedge));
        set(child_side(dedge.next(), 2), place.map_or(0.0, |edge| around.child(edge, creasing)));
        set(child_side(dedge, 0), less_one(sharpness));
    }
    let fall = |&s: &f32| if step == BoundaryStep::Keep { s } else { less_one(s) };
    Sharpness { dedges, vertices: old.vertices.iter().map(fall).collect() }
}
