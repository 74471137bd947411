//! From an indexed triangle list to directed edges, in linear time and without a hash table.
//!
//! Directed edges are bucketed by their origin. At a vertex the directed edges that leave it are known then, and
//! those that arrive are the predecessors, within the same triangles, of those that leave: one pass over the bucket
//! notes by target who leaves, a second looks up who arrives.

use super::dedge::{DedgeMesh, NONE};
use super::ids::{DedgeId, FaceId, VertexId};

/// Why a triangle list is not an oriented two-manifold. Each names the first offending element.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// There is nothing to build from.
    #[error("the mesh has no triangles; give at least one")]
    NoFaces,
    /// Numbers are 32 bits wide, and one value means "none".
    #[error(
        "the mesh has {n_vertices} vertices and {n_faces} triangles; at most {} and {} fit",
        MAX_VERTICES,
        MAX_FACES
    )]
    TooMany {
        /// Vertices asked for.
        n_vertices: usize,
        /// Triangles asked for.
        n_faces: usize,
    },
    /// A corner names a vertex that does not exist.
    #[error("triangle {face} names vertex {index}, but there are only {n_vertices} vertices, numbered from 0")]
    IndexOutOfRange {
        /// The triangle.
        face: FaceId,
        /// What it names.
        index: u32,
        /// How many there are.
        n_vertices: usize,
    },
    /// A face has a vertex twice.
    #[error("face {face} uses vertex {vertex} more than once; remove the face or merge its neighbours")]
    DegenerateTriangle {
        /// The triangle.
        face: FaceId,
        /// The repeated vertex.
        vertex: VertexId,
    },
    /// A polygon has fewer corners than a triangle.
    #[error("face {face} has {found} corners; a face needs three or more")]
    TooFewCorners {
        /// The face.
        face: FaceId,
        /// How many it has.
        found: usize,
    },
    /// The sizes of the polygons do not add up to the corners.
    #[error("the sizes of the faces add up to {named} corners, but {given} are given")]
    CornerCount {
        /// The sum of the sizes.
        named: u64,
        /// The length of the list.
        given: usize,
    },
    /// Two triangles run along the same edge in the same direction.
    #[error(
        "triangles {first} and {second} both run from vertex {from} to {to}: one of them faces the other way, \
         or three triangles share that edge, or a triangle is there twice"
    )]
    DuplicateDedge {
        /// The triangle with the lower number.
        first: FaceId,
        /// The other one.
        second: FaceId,
        /// Where the directed edge starts.
        from: VertexId,
        /// Where it ends.
        to: VertexId,
    },
    /// Two fans of triangles touch in one vertex only (a bow tie).
    #[error("at vertex {vertex} only {reached} of {faces} triangles hang together; split the vertex in two")]
    NonManifoldVertex {
        /// The vertex.
        vertex: VertexId,
        /// Triangles in the fan of the first one.
        reached: usize,
        /// All triangles at the vertex.
        faces: usize,
    },
    /// No triangle uses the vertex.
    #[error("no triangle uses vertex {vertex}; remove it or connect it")]
    IsolatedVertex {
        /// The vertex.
        vertex: VertexId,
    },
}

/// Most triangles that a mesh can have: three directed edges each, and one number means "none".
const MAX_FACES: usize = (u32::MAX / 3) as usize - 1;
/// Most vertices that a mesh can have.
const MAX_VERTICES: usize = u32::MAX as usize - 1;

impl DedgeMesh {
    /// Builds the connectivity of `n_vertices` vertices and a list of triangles, each three vertex numbers from 0,
    /// counter-clockwise seen from outside. Takes time and memory linear in both.
    ///
    /// # Errors
    /// What keeps the list from being an oriented two-manifold: see [`MeshError`].
    pub fn from_triangles(n_vertices: usize, triangles: &[[u32; 3]]) -> Result<DedgeMesh, MeshError> {
        check_counts(n_vertices, triangles.len(), 3 * triangles.len())?;
        check_triangles(n_vertices, triangles)?;

        let origin = triangles.as_flattened().to_vec();
        let buckets = Buckets::by_origin(n_vertices, &origin);
        buckets.check_no_isolated()?;
        let twin =
            find_twins(&origin, &buckets, |d| DedgeId(d).next().0, |d| DedgeId(d).prev().0, |d| DedgeId(d).face())?;
        let outgoing = outgoing_of(&twin, &buckets);
        let mesh = DedgeMesh { origin, twin, outgoing };
        for vertex in mesh.vertices() {
            let faces = buckets.at(vertex.index()).len();
            let reached = mesh.outgoing_dedges(vertex).count();
            if reached != faces {
                return Err(MeshError::NonManifoldVertex { vertex, reached, faces });
            }
        }
        Ok(mesh)
    }
}

/// Whether so many vertices, faces and corners can be numbered.
pub(super) fn check_counts(n_vertices: usize, n_faces: usize, n_corners: usize) -> Result<(), MeshError> {
    if n_faces == 0 {
        return Err(MeshError::NoFaces);
    }
    if n_vertices > MAX_VERTICES || n_corners > 3 * MAX_FACES {
        return Err(MeshError::TooMany { n_vertices, n_faces });
    }
    Ok(())
}

/// For each vertex a directed edge that starts there, on the boundary the one without a twin.
pub(super) fn outgoing_of(twin: &[u32], buckets: &Buckets) -> Vec<u32> {
    (0..buckets.offsets.len() - 1)
        .map(|v| {
            let bucket = buckets.at(v);
            bucket.iter().copied().find(|&d| twin[d as usize] == NONE).unwrap_or(bucket[0])
        })
        .collect()
}

fn check_triangles(n_vertices: usize, triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    for (f, &[a, b, c]) in triangles.iter().enumerate() {
        let face = FaceId(f as u32);
        if let Some(index) = [a, b, c].into_iter().find(|&v| v as usize >= n_vertices) {
            return Err(MeshError::IndexOutOfRange { face, index, n_vertices });
        }
        if a == b || c == a {
            return Err(MeshError::DegenerateTriangle { face, vertex: VertexId(a) });
        }
        if b == c {
            return Err(MeshError::DegenerateTriangle { face, vertex: VertexId(b) });
        }
    }
    Ok(())
}

/// Directed edges sorted by the vertex they start at, ascending within a vertex: a counting sort.
pub(super) struct Buckets {
    offsets: Vec<u32>,
    dedges: Vec<u32>,
}

impl Buckets {
    pub(super) fn by_origin(n_vertices: usize, origins: &[u32]) -> Buckets {
        let mut offsets = vec![0_u32; n_vertices + 1];
        for &v in origins {
            offsets[v as usize + 1] += 1;
        }
        for v in 0..n_vertices {
            offsets[v + 1] += offsets[v];
        }
        let mut cursor = offsets.clone();
        let mut dedges = vec![0_u32; origins.len()];
        for (d, &v) in origins.iter().enumerate() {
            dedges[cursor[v as usize] as usize] = d as u32;
            cursor[v as usize] += 1;
        }
        Buckets { offsets, dedges }
    }

    pub(super) fn check_no_isolated(&self) -> Result<(), MeshError> {
        match self.offsets.windows(2).position(|ends| ends[0] == ends[1]) {
            Some(vertex) => Err(MeshError::IsolatedVertex { vertex: VertexId(vertex as u32) }),
            None => Ok(()),
        }
    }

    pub(super) fn at(&self, vertex: usize) -> &[u32] {
        &self.dedges[self.offsets[vertex] as usize..self.offsets[vertex + 1] as usize]
    }
}

/// The twin of each directed edge, [`NONE`] on the boundary. `next`, `prev` and `face` are those of the faces at hand.
pub(super) fn find_twins(
    origin: &[u32],
    buckets: &Buckets,
    next: impl Fn(u32) -> u32,
    prev: impl Fn(u32) -> u32,
    face: impl Fn(u32) -> FaceId,
) -> Result<Vec<u32>, MeshError> {
    let n_vertices = buckets.offsets.len() - 1;
    let mut twin = vec![NONE; origin.len()];
    // For the vertex at hand: the directed edge that leaves it towards each target. Emptied after each vertex.
    let mut leaving = vec![NONE; n_vertices];
    for vertex in 0..n_vertices {
        for &dedge in buckets.at(vertex) {
            let target = origin[next(dedge) as usize];
            let first = std::mem::replace(&mut leaving[target as usize], dedge);
            if first != NONE {
                return Err(MeshError::DuplicateDedge {
                    first: face(first),
                    second: face(dedge),
                    from: VertexId(vertex as u32),
                    to: VertexId(target),
                });
            }
        }
        for &dedge in buckets.at(vertex) {
            let arriving = prev(dedge) as usize;
            twin[arriving] = leaving[origin[arriving] as usize];
        }
        for &dedge in buckets.at(vertex) {
            leaving[origin[next(dedge) as usize] as usize] = NONE;
        }
    }
    Ok(twin)
}
