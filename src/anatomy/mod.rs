//! Measures of a dog's head, breeds as values of them, and their files. Knows no mesh.
//!
//! - [`ParamTable`] is the one table of measures (`rigs/anatomy.ron`): it feeds files, sliders, the command line and the
//!   manual. A measure is named by an id that ends in its unit; inside, every value is in metres, radians or a pure number.
//! - [`Breed`] has a value for each row of the table and a [`Look`]; [`Breed::blend`] mixes breeds by mixing values.
//! - [`load_breed`] and [`save_breed`] turn text into a breed and back, exactly. No function here touches the file system.
//! - [`Space`] knows how breeds differ and draws random dogs; [`cross`] has puppies of two; [`Locks`] say what is kept.
//! - [`Reference`] is what a breed is held against: a number from outside the program, with its standing and source.
//! - [`library`] holds the table and the breeds that are part of the program.

mod breed;
mod coat_file;
pub mod colour;
mod file;
mod genes;
mod hair;
pub mod library;
mod litter;
mod load;
mod locate;
mod locks;
mod look;
mod marking;
mod nearest;
mod param;
mod pigment;
mod problem;
mod read;
mod reference;
mod region;
mod region_hair;
mod save;
mod space;
mod table;

pub use breed::{Breed, UnknownCoat};
pub use genes::random_pattern;
pub use hair::Hair;
pub use litter::{INHERITED_WHOLE, cross};
pub use load::load_breed;
pub use locate::Place;
pub use locks::{Locks, UnknownLock};
pub use look::{Look, Pattern, Variety};
pub use marking::{MOST_FIELDS, Marking, MarkingField, MarkingKind};
pub use nearest::nearest;
pub use param::{Follow, ParamSpec, Unit};
pub use pigment::{Eumelanin, Paint, Pigments};
pub use problem::{LoadErrors, Problem, ProblemKind};
pub use reference::{QUANTITIES, Quantity, Reference, Status};
pub use region::Region;
pub use region_hair::{RegionHair, Tuft};
pub use save::save_breed;
pub use space::{Space, SpaceError};
pub use table::ParamTable;
