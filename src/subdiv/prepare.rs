//! From a control mesh with tags to level 0: holes cut out, frozen faces moved behind the others, sharpness on edges.

use crate::mesh::{DedgeId, DedgeMesh, FaceId, PolygonMesh, VertexId};

use super::corners::PolygonLevel;
use super::level::{Level, Sharpness};
use super::scheme::{BoundaryRule, PlanOptions};
use super::steps::Last;
use super::tags::{INFINITE_SHARPNESS, TagError, Tags};

/// Level 0.
pub(super) struct Prepared {
    pub(super) level: Last,
    /// For each vertex the control vertex; none where they are the same.
    pub(super) vertices: Option<Vec<u32>>,
    /// For each face the control face.
    pub(super) faces: Vec<u32>,
    pub(super) n_control: usize,
}

pub(super) fn triangles(control: &DedgeMesh, tags: &Tags, options: &PlanOptions) -> Result<Prepared, TagError> {
    let n_faces = control.n_faces();
    let frozen = marked(&tags.frozen, n_faces)?;
    let holes = marked(&tags.holes, n_faces)?;
    let edges = EdgeTags::check(tags, control.n_vertices(), |a, b| {
        control.outgoing_dedges(a).any(|d| control.target(d) == b)
            || control.outgoing_dedges(b).any(|d| control.target(d) == a)
    })?;
    let kept = |frozen_ones: bool| {
        let (frozen, holes) = (&frozen, &holes);
        (0..n_faces as u32).filter(move |&f| !holes[f as usize] && frozen[f as usize] == frozen_ones)
    };
    let faces: Vec<u32> = kept(false).chain(kept(true)).collect();
    let n_active = kept(false).count() as u32;
    let (mesh, vertices) = if faces.iter().enumerate().all(|(i, &f)| i as u32 == f) && faces.len() == n_faces {
        (control.clone(), None)
    } else {
        let sides = faces.iter().flat_map(|&f| [0, 1, 2].map(|k| FaceId(f).dedge(k)));
        let is_there = |d: DedgeId| !holes[d.face().index()];
        let fans = |v: VertexId| {
            fans(&control.outgoing_dedges(v).collect::<Vec<_>>(), control.is_boundary_vertex(v), is_there)
        };
        let (corners, vertices) = renumber(control.n_vertices(), control.n_dedges(), sides, fans);
        let mesh = DedgeMesh::from_triangles(vertices.len(), corners.as_chunks().0).map_err(TagError::Holes)?;
        (mesh, Some(vertices))
    };
    let mut fixed = Vec::new();
    if (n_active as usize) < mesh.n_faces() {
        fixed = vec![false; mesh.n_vertices()];
        mesh.origin[3 * n_active as usize..].iter().for_each(|&v| fixed[v as usize] = true);
    }
    let single = (0..mesh.n_vertices() as u32).map(VertexId).filter(|&v| {
        options.boundary == BoundaryRule::EdgeAndCorner
            && mesh.is_boundary_vertex(v)
            && mesh.outgoing_dedges(v).count() == 1
    });
    let sharpness = edges.place(
        mesh.n_vertices(),
        &mesh.twin,
        vertices.as_deref(),
        single,
        |v| mesh.outgoing_dedges(v).collect(),
        |d| mesh.target(d),
    );
    let level = Last::Triangles(Level { mesh, sharpness, n_active, fixed });
    Ok(Prepared { level, vertices, faces, n_control: control.n_vertices() })
}

pub(super) fn polygons(control: &PolygonMesh, tags: &Tags, options: &PlanOptions) -> Result<Prepared, TagError> {
    let holes = marked(&tags.holes, control.n_faces())?;
    let edges = EdgeTags::check(tags, control.n_vertices(), |a, b| {
        control.outgoing_dedges(a).any(|d| control.target(d) == b)
            || control.outgoing_dedges(b).any(|d| control.target(d) == a)
    })?;
    let faces: Vec<u32> = (0..control.n_faces() as u32).filter(|&f| !holes[f as usize]).collect();
    let (mesh, vertices) = if tags.holes.is_empty() {
        (control.clone(), None)
    } else {
        let sizes: Vec<u32> = faces.iter().map(|&f| control.corners(FaceId(f)).len() as u32).collect();
        let sides = faces.iter().flat_map(|&f| control.sides(FaceId(f)));
        let is_there = |d: DedgeId| !holes[control.face(d).index()];
        let fans = |v: VertexId| {
            fans(&control.outgoing_dedges(v).collect::<Vec<_>>(), control.is_boundary_vertex(v), is_there)
        };
        let (corners, vertices) = renumber(control.n_vertices(), control.n_dedges(), sides, fans);
        (PolygonMesh::from_faces(vertices.len(), &sizes, &corners).map_err(TagError::Holes)?, Some(vertices))
    };
    let single = (0..mesh.n_vertices() as u32).map(VertexId).filter(|&v| {
        options.boundary == BoundaryRule::EdgeAndCorner
            && mesh.is_boundary_vertex(v)
            && mesh.outgoing_dedges(v).count() == 1
    });
    let sharpness = edges.place(
        mesh.n_vertices(),
        &mesh.twin,
        vertices.as_deref(),
        single,
        |v| mesh.outgoing_dedges(v).collect(),
        |d| mesh.target(d),
    );
    let level = Last::Polygons(PolygonLevel { mesh, sharpness });
    Ok(Prepared { level, vertices, faces, n_control: control.n_vertices() })
}

fn marked(faces: &[FaceId], n_faces: usize) -> Result<Vec<bool>, TagError> {
    let mut marked = vec![false; n_faces];
    for &face in faces {
        *marked.get_mut(face.index()).ok_or(TagError::NoSuchFace { face, n_faces })? = true;
    }
    Ok(marked)
}

/// The fans of faces that are left around a vertex, each as its outgoing directed edges counter-clockwise. `around` are all
/// that start there.
fn fans(around: &[DedgeId], is_boundary: bool, is_there: impl Fn(DedgeId) -> bool) -> Vec<Vec<DedgeId>> {
    let mut fans: Vec<Vec<DedgeId>> = around.chunk_by(|&a, &b| is_there(a) == is_there(b)).map(<[_]>::to_vec).collect();
    // Inside the surface the last one goes on in the first.
    if !is_boundary && fans.len() > 1 && is_there(around[0]) && is_there(around[around.len() - 1]) {
        let first = std::mem::take(&mut fans[0]);
        fans.last_mut().into_iter().for_each(|last| last.extend(&first));
    }
    fans.retain(|fan| fan.first().is_some_and(|&d| is_there(d)));
    fans
}

/// The corners of the faces that are left, by new vertex numbers, and for each new vertex its control vertex, ascending.
/// Where holes leave several fans around a vertex, touching in nothing else, each gets a vertex of its own.
fn renumber(
    n_vertices: usize,
    n_dedges: usize,
    sides: impl Iterator<Item = DedgeId>,
    fans: impl Fn(VertexId) -> Vec<Vec<DedgeId>>,
) -> (Vec<u32>, Vec<u32>) {
    let mut vertices = Vec::new();
    let mut number = vec![0_u32; n_dedges];
    for vertex in 0..n_vertices as u32 {
        for fan in fans(VertexId(vertex)) {
            fan.iter().for_each(|side| number[side.index()] = vertices.len() as u32);
            vertices.push(vertex);
        }
    }
    (sides.map(|side| number[side.index()]).collect(), vertices)
}

/// Tags of edges and vertices that are known to fit the control mesh.
struct EdgeTags<'a>(&'a Tags);

impl<'a> EdgeTags<'a> {
    fn check(
        tags: &'a Tags,
        n_vertices: usize,
        are_joined: impl Fn(VertexId, VertexId) -> bool,
    ) -> Result<EdgeTags<'a>, TagError> {
        let known = |vertex: VertexId| {
            if vertex.index() < n_vertices { Ok(()) } else { Err(TagError::NoSuchVertex { vertex, n_vertices }) }
        };
        let sharpnesses = tags.creases.iter().map(|crease| crease.2).chain(tags.corners.iter().map(|corner| corner.1));
        if let Some(sharpness) = sharpnesses.into_iter().find(|s| s.is_nan() || *s < 0.0) {
            return Err(TagError::Sharpness { sharpness });
        }
        for &(from, to, _) in &tags.creases {
            known(from)?;
            known(to)?;
            if !are_joined(from, to) {
                return Err(TagError::NoSuchEdge { from, to });
            }
        }
        tags.corners.iter().try_for_each(|&(vertex, _)| known(vertex))?;
        Ok(EdgeTags(tags))
    }

    /// The sharpness of edges and vertices of level 0. What a hole has taken away is passed over.
    fn place(
        &self,
        n_vertices: usize,
        twin: &[u32],
        vertices: Option<&[u32]>,
        single: impl Iterator<Item = VertexId>,
        outgoing: impl Fn(VertexId) -> Vec<DedgeId>,
        target: impl Fn(DedgeId) -> VertexId,
    ) -> Sharpness {
        let mut sharpness = Sharpness::default();
        // A control vertex may have become several, or none.
        let numbers = |control: VertexId| match vertices {
            None => control.0..control.0 + 1,
            Some(vertices) => {
                let end = |bound: u32| vertices.partition_point(|&v| v < bound) as u32;
                end(control.0)..end(control.0 + 1)
            }
        };
        let value = |s: f32| if s >= INFINITE_SHARPNESS { f32::INFINITY } else { s };
        if !self.0.creases.is_empty() {
            sharpness.dedges = vec![0.0; twin.len()];
            for &(a, b, s) in &self.0.creases {
                for (from, to) in [(a, b), (b, a)] {
                    let sides = numbers(from).flat_map(|v| outgoing(VertexId(v)));
                    for side in sides.filter(|&d| numbers(to).contains(&target(d).0)) {
                        sharpness.dedges[side.index()] = value(s);
                    }
                }
            }
        }
        let single: Vec<VertexId> = single.collect();
        if !self.0.corners.is_empty() || !single.is_empty() {
            sharpness.vertices = vec![0.0; n_vertices];
            for &(vertex, s) in &self.0.corners {
                numbers(vertex).for_each(|v| sharpness.vertices[v as usize] = value(s));
            }
            single.into_iter().for_each(|v| sharpness.vertices[v.index()] = f32::INFINITY);
        }
        sharpness
    }
}
