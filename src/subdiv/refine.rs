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
//! A trisecting step needs faces with at most one side on a boundary. A keeping step makes such faces of any.

use crate::mesh::{DedgeId, DedgeMesh, FaceId, VertexId};

use super::scheme::BoundaryStep;

const NONE: u32 = u32::MAX;

/// What a vertex of the child comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VertexParent {
    /// The vertex of the same number.
    Vertex(VertexId),
    /// The middle of a face.
    Face(FaceId),
    /// A third of the way along a boundary directed edge, from its origin.
    FirstThird(DedgeId),
    /// Two thirds of the way along a boundary directed edge.
    SecondThird(DedgeId),
}

/// A mesh one step finer.
#[derive(Clone, Debug)]
pub struct Refined {
    /// Its connectivity. Face `e` is the child of directed edge `e` of the parent, hence of the parent's face `e / 3`.
    pub mesh: DedgeMesh,
    /// One for each vertex: first the old vertices in their order, then the new ones in the order of their faces.
    pub parents: Vec<VertexParent>,
}

/// Refines the connectivity by one √3 step, in linear time.
///
/// The caller sees to the size (three times the faces must fit 32 bits) and to the alternation of steps: a trisecting
/// one is taken only after a keeping one, so that no face has two sides on a boundary.
pub fn refine(mesh: &DedgeMesh, step: BoundaryStep) -> Refined {
    Step::new(mesh, step).run()
}

/// The numbers of new vertices, and which faces are fanned.
struct Step<'a> {
    mesh: &'a DedgeMesh,
    /// The first (or only) new vertex of each face.
    new_vertex: Vec<u32>,
    /// The boundary directed edge of each fanned face, [`NONE`] for the others. Empty in a keeping step.
    fanned: Vec<u32>,
    parents: Vec<VertexParent>,
}

impl<'a> Step<'a> {
    fn new(mesh: &'a DedgeMesh, step: BoundaryStep) -> Self {
        let fanned = match step {
            BoundaryStep::Keep => Vec::new(),
            BoundaryStep::Trisect => boundary_sides(mesh),
        };
        let mut parents: Vec<_> = mesh.vertices().map(VertexParent::Vertex).collect();
        parents.reserve(mesh.n_faces() + fanned.iter().filter(|&&d| d != NONE).count());
        let mut new_vertex = Vec::with_capacity(mesh.n_faces());
        for face in mesh.faces() {
            new_vertex.push(parents.len() as u32);
            match fanned.get(face.index()) {
                Some(&dedge) if dedge != NONE => {
                    let dedge = DedgeId(dedge);
                    parents.extend([VertexParent::FirstThird(dedge), VertexParent::SecondThird(dedge)]);
                }
                _ => parents.push(VertexParent::Face(face)),
            }
        }
        Step { mesh, new_vertex, fanned, parents }
    }

    fn run(self) -> Refined {
        let n_dedges = self.mesh.n_dedges();
        let mut origin = Vec::with_capacity(3 * n_dedges);
        let mut twin = Vec::with_capacity(3 * n_dedges);
        for dedge in self.mesh.dedges() {
            let (corners, twins) = match (self.mesh.twin(dedge), self.fan(dedge)) {
                (Some(other), _) => self.flipped(dedge, other),
                (None, None) => self.kept(dedge),
                (None, Some(_)) => self.middle(dedge),
            };
            origin.extend(corners);
            twin.extend(twins);
        }
        let outgoing = self.parents.iter().map(|&parent| self.outgoing(parent)).collect();
        Refined { mesh: DedgeMesh { origin, twin, outgoing }, parents: self.parents }
    }

    /// The boundary side of the directed edge's face, if that is fanned.
    #[inline]
    fn fan(&self, dedge: DedgeId) -> Option<DedgeId> {
        let side = *self.fanned.get(dedge.face().index())?;
        (side != NONE).then_some(DedgeId(side))
    }

    /// X: the new vertex on the left of an inner directed edge.
    #[inline]
    fn left(&self, dedge: DedgeId) -> u32 {
        let first = self.new_vertex[dedge.face().index()];
        match self.fan(dedge) {
            Some(boundary) if dedge == boundary.next() => first + 1,
            _ => first,
        }
    }

    /// Child (a, Y, X) of an inner directed edge, and the twins of its sides.
    #[inline]
    fn flipped(&self, dedge: DedgeId, other: DedgeId) -> ([u32; 3], [u32; 3]) {
        let a = self.mesh.origin(dedge).0;
        let corners = [a, self.left(other), self.left(dedge)];

        // a-Y lies in the face on the right.
        let below = match self.fan(other) {
            None => child_side(other.next(), 2),
            Some(boundary) if other == boundary.next() => child_side(boundary, 1),
            Some(_) => NONE,
        };
        // X-a lies in the face on the left.
        let above = match self.fan(dedge) {
            None => self.around_origin(dedge),
            Some(boundary) if dedge == boundary.prev() => child_side(boundary, 2),
            Some(_) => NONE,
        };
        (corners, [below, child_side(other, 1), above])
    }

    /// Child (a, b, X) of a boundary directed edge in a keeping step.
    fn kept(&self, dedge: DedgeId) -> ([u32; 3], [u32; 3]) {
        let corners = [self.mesh.origin(dedge).0, self.mesh.target(dedge).0, self.left(dedge)];
        (corners, [NONE, child_side(dedge.next(), 2), self.around_origin(dedge)])
    }

    /// Child (p, q, c) of a boundary directed edge in a trisecting step.
    fn middle(&self, dedge: DedgeId) -> ([u32; 3], [u32; 3]) {
        let p = self.new_vertex[dedge.face().index()];
        let corners = [p, p + 1, self.mesh.origin(dedge.prev()).0];
        // The other two sides are inner ones, see the top of the file.
        let right = self.mesh.twin(dedge.next()).map_or(NONE, |other| child_side(other, 0));
        (corners, [NONE, right, child_side(dedge.prev(), 2)])
    }

    /// In a face with a vertex in its middle: the twin of side 2 (X-a) of the child of a directed edge from a.
    #[inline]
    fn around_origin(&self, dedge: DedgeId) -> u32 {
        match self.mesh.twin(dedge.prev()) {
            Some(other) => child_side(other, 0),
            None => child_side(dedge.prev(), 1),
        }
    }

    fn outgoing(&self, parent: VertexParent) -> u32 {
        match parent {
            VertexParent::Vertex(vertex) => {
                let dedge = self.mesh.outgoing(vertex);
                match self.fan(dedge) {
                    // The first third of the boundary edge belongs to the child across the side before it.
                    Some(boundary) if dedge == boundary => {
                        self.mesh.twin(dedge.prev()).map_or(NONE, |other| child_side(other, 0))
                    }
                    _ => child_side(dedge, 0),
                }
            }
            VertexParent::Face(face) => child_side(face.dedge(0), 2),
            VertexParent::FirstThird(dedge) => child_side(dedge, 0),
            VertexParent::SecondThird(dedge) => child_side(dedge.next(), 2),
        }
    }
}

/// Side `side` of the child of a directed edge.
#[inline(always)]
fn child_side(dedge: DedgeId, side: u32) -> u32 {
    3 * dedge.0 + side
}

/// The boundary side of each face, [`NONE`] for inner faces.
fn boundary_sides(mesh: &DedgeMesh) -> Vec<u32> {
    let mut sides = vec![NONE; mesh.n_faces()];
    for dedge in mesh.dedges().filter(|&d| mesh.is_boundary_dedge(d)) {
        debug_assert_eq!(sides[dedge.face().index()], NONE, "a keeping step comes first");
        sides[dedge.face().index()] = dedge.0;
    }
    sides
}
