//! Similarity of triangles: subdivide one of a kind, map the rest.
//!
//! Szinek 2003, "Optimized Subdivision Surface Displaying" (master thesis, Comenius University Bratislava), chapter 4:
//! measures of how alike two triangles are (section 4.3.2), classes of strictly similar triangles (4.6) and patches (4.7),
//! affine maps from a representative to the others (4.7.1), and the phase that runs in real time (4.7.2).
//!
//! It holds for a shape that does not change: a class is one of positions. What holds for any shape is [`shared`]: the
//! schemes are linear, so triangles whose surroundings have the same *topology* share one set of stencil rows.

pub mod classes;
pub mod maps;
pub mod measures;
pub mod patches;
pub mod report;
pub mod shared;

use super::plan::PlanError;
use super::scheme::Scheme;

/// Why triangles cannot be compared.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SimilarityError {
    /// Only where the children of a triangle lie within it can they be mapped with it.
    #[error("{} cannot be mapped triangle by triangle; use loop or butterfly, which cut a triangle in four", scheme.name())]
    Scheme {
        /// The scheme asked for.
        scheme: Scheme,
    },
    /// One position is needed for each vertex.
    #[error("{given} positions for {expected} vertices")]
    Positions {
        /// Vertices of the mesh.
        expected: usize,
        /// Positions given.
        given: usize,
    },
    /// Weights of the measures must be 0 or more and have the sum 1 (thesis, below formula 4.12).
    #[error("weights of measures are 0 or more and have the sum 1; these are {weights:?}")]
    Weights {
        /// k1, k2, k3, k4, k6.
        weights: [f64; 5],
    },
    /// There is no plan.
    #[error(transparent)]
    Plan(#[from] PlanError),
}
