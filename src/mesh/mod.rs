//! Connectivity of triangle meshes as directed edges; no positions inside.
//!
//! A triangle's three sides are its directed edges: side `k` of face `f` has the number `3f + k`, so that face, next
//! and previous are arithmetic. Stored are only the origin and the twin of each directed edge, and one outgoing
//! directed edge for each vertex. [`DedgeMesh`] can be had only from checked input, and then never changes.

mod build;
mod dedge;
mod ids;
mod polygons;
mod ring;
pub mod shapes;
mod validate;

pub use build::MeshError;
pub use dedge::DedgeMesh;
pub use ids::{DedgeId, FaceId, VertexId};
pub use polygons::PolygonMesh;
pub use ring::{OutgoingDedges, Ring};
pub use validate::InvariantError;
