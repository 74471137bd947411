//! The table and the breeds that are part of the program.

use super::{Breed, LoadErrors, ParamTable, load_breed, nearest};

/// Text of `rigs/anatomy.ron`.
pub const ANATOMY: &str = include_str!("../../rigs/anatomy.ron");

/// Text of each file in `rigs/breeds/`, by id, sorted by id.
pub const BREEDS: &[(&str, &str)] = &[
    ("beagle", include_str!("../../rigs/breeds/beagle.ron")),
    ("borzoi", include_str!("../../rigs/breeds/borzoi.ron")),
    ("bulldog", include_str!("../../rigs/breeds/bulldog.ron")),
    ("chihuahua", include_str!("../../rigs/breeds/chihuahua.ron")),
    ("dachshund", include_str!("../../rigs/breeds/dachshund.ron")),
    ("german_shepherd", include_str!("../../rigs/breeds/german_shepherd.ron")),
    ("labrador", include_str!("../../rigs/breeds/labrador.ron")),
    ("pug", include_str!("../../rigs/breeds/pug.ron")),
];

/// Why a breed of the program could not be had.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LibraryError {
    /// No breed has that id.
    #[error("unknown breed {id}{}", if nearest.is_empty() { String::new() } else { format!(" (did you mean {}?)", nearest.join(" or ")) })]
    Unknown {
        /// What was asked for.
        id: String,
        /// Ids with similar names.
        nearest: Vec<String>,
    },
    /// The embedded file is wrong, which a test excludes.
    #[error(transparent)]
    Load(#[from] LoadErrors),
}

/// The ids of all breeds, sorted.
pub fn ids() -> impl Iterator<Item = &'static str> {
    BREEDS.iter().map(|(id, _)| *id)
}

/// The breed of that id.
///
/// # Errors
/// No such breed, with the nearest names.
pub fn breed(table: &ParamTable, id: &str) -> Result<Breed, LibraryError> {
    match BREEDS.iter().find(|(known, _)| *known == id) {
        Some((id, text)) => Ok(load_breed(table, &format!("rigs/breeds/{id}.ron"), text)?),
        None => {
            let near = nearest(id, ids().map(|known| (known, known)));
            Err(LibraryError::Unknown { id: id.to_owned(), nearest: near.into_iter().map(str::to_owned).collect() })
        }
    }
}
