//! Two results of the same subdivision, paired through their faces.
#![allow(dead_code)] // Each test file uses its part.

use glam::DVec3;
use londra::mesh::{DedgeId, PolygonMesh, VertexId};

/// Points by one coordinate, to find near ones.
pub struct ByX<'a> {
    points: &'a [DVec3],
    order: Vec<u32>,
}

impl<'a> ByX<'a> {
    pub fn new(points: &'a [DVec3]) -> Self {
        let mut order: Vec<u32> = (0..points.len() as u32).collect();
        order.sort_by(|&a, &b| points[a as usize].x.total_cmp(&points[b as usize].x));
        ByX { points, order }
    }

    /// All within a distance, nearest first.
    pub fn near(&self, p: DVec3, distance: f64) -> Vec<u32> {
        let from = self.order.partition_point(|&v| self.points[v as usize].x < p.x - distance);
        let span = self.order[from..].iter().take_while(|&&v| self.points[v as usize].x <= p.x + distance);
        let away = |v: u32| self.points[v as usize].distance(p);
        let mut near: Vec<u32> = span.copied().filter(|&v| away(v) <= distance).collect();
        near.sort_by(|&a, &b| away(a).total_cmp(&away(b)));
        near
    }
}

const NONE: u32 = u32::MAX;

/// For each vertex of theirs ours, found by walking both meshes side by side from a face that lies in the same place, and
/// so for each component. All faces are compared on the way, and no vertex is used twice.
///
/// Faces whose corners are all checked come first as a start. Where there are none, so few are the faces, a control vertex
/// on the boundary is one: both have kept the numbers of those, and it has but one first side.
pub fn pair(
    (mesh, theirs): (&PolygonMesh, &[DVec3]),
    (our_mesh, ours): (&PolygonMesh, &[DVec3]),
    n_control: usize,
    is_checked: impl Fn(usize) -> bool,
    distance: f64,
) -> Result<Vec<u32>, String> {
    let by_x = ByX::new(ours);
    let near = |v: VertexId| by_x.near(theirs[v.index()], distance);
    // The same side in the same place: origin, target and what comes before.
    let same = |side: DedgeId| -> Option<DedgeId> {
        let before = near(mesh.origin(mesh.prev(side)));
        let (origins, targets) = (near(mesh.origin(side)), near(mesh.target(side)));
        let mut sides = origins.iter().flat_map(|&v| our_mesh.outgoing_dedges(VertexId(v)));
        sides
            .find(|&d| targets.contains(&our_mesh.target(d).0) && before.contains(&our_mesh.origin(our_mesh.prev(d)).0))
    };
    let mut walk = Walk {
        mesh,
        our_mesh,
        vertices: vec![NONE; mesh.n_vertices()],
        used: vec![false; our_mesh.n_vertices()],
        sides: vec![NONE; mesh.n_dedges()],
    };
    for round in 0..2 {
        for face in mesh.faces() {
            let corners = mesh.corners(face);
            let mut start = mesh.sides(face).next().expect("three");
            if walk.sides[start.index()] != NONE || (round == 0 && !corners.iter().all(|&v| is_checked(v as usize))) {
                continue;
            }
            let mut here = same(start);
            if here.is_none() && round == 1 {
                let control = |v: &&u32| (**v as usize) < n_control && mesh.is_boundary_vertex(VertexId(**v));
                let Some(&vertex) = corners.iter().find(control) else { continue };
                start = mesh.outgoing(VertexId(vertex));
                here = Some(our_mesh.outgoing(VertexId(vertex)));
            }
            let Some(here) = here else {
                let at: Vec<_> = corners.iter().map(|&v| theirs[v as usize]).collect();
                return Err(format!("their face {face} at {at:?} is none of ours"));
            };
            walk.from(start, here)?;
        }
    }
    match walk.vertices.iter().position(|&v| v == NONE) {
        Some(v) => Err(format!("no face around their vertex {v} is ours")),
        None => Ok(walk.vertices),
    }
}

struct Walk<'a> {
    mesh: &'a PolygonMesh,
    our_mesh: &'a PolygonMesh,
    vertices: Vec<u32>,
    used: Vec<bool>,
    sides: Vec<u32>,
}

impl Walk<'_> {
    fn from(&mut self, theirs: DedgeId, ours: DedgeId) -> Result<(), String> {
        let mut open = vec![(theirs, ours)];
        while let Some((mut theirs, mut ours)) = open.pop() {
            if self.sides[theirs.index()] != NONE {
                if self.sides[theirs.index()] != ours.0 {
                    return Err(format!("faces differ at their side {theirs}"));
                }
                continue;
            }
            let n = self.mesh.corners(self.mesh.face(theirs)).len();
            let found = self.our_mesh.corners(self.our_mesh.face(ours)).len();
            if n != found {
                return Err(format!("a face of {n} corners at their side {theirs} has {found} of ours"));
            }
            for _ in 0..n {
                self.sides[theirs.index()] = ours.0;
                self.join(self.mesh.origin(theirs), self.our_mesh.origin(ours))?;
                match (self.mesh.twin(theirs), self.our_mesh.twin(ours)) {
                    (Some(a), Some(b)) => open.push((a, b)),
                    (None, None) => {}
                    _ => return Err(format!("a boundary differs at their side {theirs}")),
                }
                (theirs, ours) = (self.mesh.next(theirs), self.our_mesh.next(ours));
            }
        }
        Ok(())
    }

    fn join(&mut self, theirs: VertexId, ours: VertexId) -> Result<(), String> {
        let known = &mut self.vertices[theirs.index()];
        if *known == NONE {
            *known = ours.0;
            if std::mem::replace(&mut self.used[ours.index()], true) {
                return Err(format!("our vertex {ours} is met twice"));
            }
        }
        if *known == ours.0 { Ok(()) } else { Err(format!("their vertex {theirs} is two of ours")) }
    }
}
