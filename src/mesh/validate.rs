//! Every invariant of a directed-edge mesh, in one function.

use super::dedge::{DedgeMesh, NONE};
use super::ids::{DedgeId, FaceId, VertexId};

/// An invariant that does not hold, with the first place where it fails.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum InvariantError {
    /// There are three origins and three twins for each face, and at least one face.
    #[error("{origins} origins and {twins} twins are not three each for one face or more")]
    Lengths {
        /// Entries in the array of origins.
        origins: usize,
        /// Entries in the array of twins.
        twins: usize,
    },
    /// Every origin is a vertex.
    #[error("directed edge {dedge} starts at {vertex}, which does not exist")]
    OriginOutOfRange {
        /// The directed edge.
        dedge: DedgeId,
        /// What it names.
        vertex: VertexId,
    },
    /// The corners of a face are three different vertices.
    #[error("face {face} has a vertex twice")]
    DegenerateFace {
        /// The face.
        face: FaceId,
    },
    /// Every twin is a directed edge.
    #[error("the twin {twin} of directed edge {dedge} does not exist")]
    TwinOutOfRange {
        /// The directed edge.
        dedge: DedgeId,
        /// What it names.
        twin: DedgeId,
    },
    /// The twin of the twin is the directed edge itself, and is another one.
    #[error("directed edge {dedge} has the twin {twin}, which has another twin or is the same")]
    TwinNotMutual {
        /// The directed edge.
        dedge: DedgeId,
        /// Its twin.
        twin: DedgeId,
    },
    /// Twins join the same two vertices in opposite directions.
    #[error("directed edge {dedge} and its twin {twin} do not join the same vertices in opposite directions")]
    TwinEnds {
        /// The directed edge.
        dedge: DedgeId,
        /// Its twin.
        twin: DedgeId,
    },
    /// Every outgoing directed edge exists.
    #[error("the outgoing directed edge {dedge} of {vertex} does not exist")]
    OutgoingOutOfRange {
        /// The vertex.
        vertex: VertexId,
        /// What it names.
        dedge: DedgeId,
    },
    /// The outgoing directed edge of a vertex starts there.
    #[error("the outgoing directed edge {dedge} of {vertex} starts elsewhere")]
    OutgoingElsewhere {
        /// The vertex.
        vertex: VertexId,
        /// Its outgoing directed edge.
        dedge: DedgeId,
    },
    /// The outgoing directed edge of a boundary vertex is the one without a twin.
    #[error("{vertex} lies on the boundary at {boundary}, but its outgoing directed edge is another")]
    OutgoingNotBoundary {
        /// The vertex.
        vertex: VertexId,
        /// The directed edge without a twin that starts there.
        boundary: DedgeId,
    },
    /// One walk around a vertex meets every triangle there.
    #[error("a walk around {vertex} meets {walked} of its {faces} triangles")]
    BrokenRing {
        /// The vertex.
        vertex: VertexId,
        /// Triangles met.
        walked: usize,
        /// Triangles there.
        faces: usize,
    },
    /// Two directed edges without a twin do not lie back to back.
    #[error("directed edges {dedge} and {other} are each other's missing twin")]
    Unjoined {
        /// The one with the lower origin.
        dedge: DedgeId,
        /// The other.
        other: DedgeId,
    },
}

pub(super) fn validate(mesh: &DedgeMesh) -> Result<(), InvariantError> {
    check_faces(mesh)?;
    check_twins(mesh)?;
    check_outgoing(mesh)?;
    check_rings(mesh)?;
    check_boundary(mesh)
}

fn check_faces(mesh: &DedgeMesh) -> Result<(), InvariantError> {
    let (origins, twins) = (mesh.origin.len(), mesh.twin.len());
    if origins == 0 || !origins.is_multiple_of(3) || twins != origins {
        return Err(InvariantError::Lengths { origins, twins });
    }
    for dedge in mesh.dedges() {
        let vertex = mesh.origin(dedge);
        if vertex.index() >= mesh.n_vertices() {
            return Err(InvariantError::OriginOutOfRange { dedge, vertex });
        }
        if vertex == mesh.target(dedge) {
            return Err(InvariantError::DegenerateFace { face: dedge.face() });
        }
    }
    Ok(())
}

fn check_twins(mesh: &DedgeMesh) -> Result<(), InvariantError> {
    for dedge in mesh.dedges() {
        let Some(twin) = mesh.twin(dedge) else { continue };
        if twin.index() >= mesh.n_dedges() {
            return Err(InvariantError::TwinOutOfRange { dedge, twin });
        }
        if twin == dedge || mesh.twin(twin) != Some(dedge) {
            return Err(InvariantError::TwinNotMutual { dedge, twin });
        }
        if mesh.origin(dedge) != mesh.target(twin) || mesh.origin(twin) != mesh.target(dedge) {
            return Err(InvariantError::TwinEnds { dedge, twin });
        }
    }
    Ok(())
}

fn check_outgoing(mesh: &DedgeMesh) -> Result<(), InvariantError> {
    for vertex in mesh.vertices() {
        let dedge = mesh.outgoing(vertex);
        if dedge.index() >= mesh.n_dedges() {
            return Err(InvariantError::OutgoingOutOfRange { vertex, dedge });
        }
        if mesh.origin(dedge) != vertex {
            return Err(InvariantError::OutgoingElsewhere { vertex, dedge });
        }
    }
    Ok(())
}

fn check_rings(mesh: &DedgeMesh) -> Result<(), InvariantError> {
    let mut faces = vec![0_usize; mesh.n_vertices()];
    for &v in &mesh.origin {
        faces[v as usize] += 1;
    }
    for dedge in mesh.dedges().filter(|&d| mesh.is_boundary_dedge(d)) {
        let vertex = mesh.origin(dedge);
        if !mesh.is_boundary_vertex(vertex) {
            return Err(InvariantError::OutgoingNotBoundary { vertex, boundary: dedge });
        }
    }
    for vertex in mesh.vertices() {
        let faces = faces[vertex.index()];
        // Twins are mutual by now, so the step from one outgoing directed edge to the next is a permutation with
        // its boundary ends cut, and the walk ends.
        let walked = mesh.outgoing_dedges(vertex).count();
        if walked != faces {
            return Err(InvariantError::BrokenRing { vertex, walked, faces });
        }
    }
    Ok(())
}

fn check_boundary(mesh: &DedgeMesh) -> Result<(), InvariantError> {
    for dedge in mesh.dedges().filter(|d| mesh.twin[d.index()] == NONE) {
        let other = mesh.outgoing(mesh.target(dedge));
        if mesh.target(other) == mesh.origin(dedge) && mesh.is_boundary_dedge(other) {
            let (dedge, other) = if mesh.origin(dedge) < mesh.origin(other) { (dedge, other) } else { (other, dedge) };
            return Err(InvariantError::Unjoined { dedge, other });
        }
    }
    Ok(())
}
