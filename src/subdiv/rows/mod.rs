//! From topology and masks to stencil rows: for each vertex of a child, which vertices of its parent with which weights.
//! One file for each scheme; the masks themselves stand beside, in files that know no mesh.

pub(super) mod butterfly;
pub(super) mod catmull_clark;
pub(super) mod doo_sabin;
pub(super) mod loop_scheme;
pub(super) mod sqrt3;
pub(super) mod sqrt3_interpolating;
