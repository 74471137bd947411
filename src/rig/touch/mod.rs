//! What may touch in a moving mouth and what is done about it: Tabulated Sphere Subsets (Navarro Newball, Wyvill and McCane
//! 2009, "Object interaction using Tabulated Spheres Subsets").
//!
//! Once for each head: parts become spheres (`spheres`, `parts`), the space of allowed motion (`motion`) is swept, and the
//! pairs that can ever touch are kept, cell by cell of that space (`table`). Each frame: only those are tested, and what
//! they find is resolved (`resolve`). Skin and points near an eye or a bone need no spheres: those have their own surfaces
//! (`globe`, `bone`).

mod bone;
mod globe;
pub mod motion;
pub mod parts;
mod push;
pub mod resolve;
pub mod spheres;
mod swept;
pub mod table;

pub use bone::{keep_off_mandible, keep_off_skull};
pub use globe::keep_off_eye;
pub use motion::{Follow, Joints, Moved, Params, Swing, Travel};
pub use parts::{Head, LipRows, LipVertex, Lips, Part, Span, Spheres};
pub use resolve::{Resolution, TongueShift, free_jaw, free_lips, free_tongue, least_gape};
pub use spheres::{Body, Fit, Sphere};
pub use swept::{Group, Stray, Swept, Touching};
pub use table::{Contact, Pair, Pairing, Table};
