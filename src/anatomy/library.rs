//! The table and the breeds that are part of the program.

use super::{Breed, LoadErrors, ParamTable, load_breed, nearest};

/// Text of `rigs/anatomy.ron`.
pub const ANATOMY: &str = include_str!("../../rigs/anatomy.ron");

/// Text of each file in `rigs/breeds/`, by id, sorted by id.
pub const BREEDS: &[(&str, &str)] = &[
    ("afghan_hound", include_str!("../../rigs/breeds/afghan_hound.ron")),
    ("akita", include_str!("../../rigs/breeds/akita.ron")),
    ("archetype_brachy", include_str!("../../rigs/breeds/archetype_brachy.ron")),
    ("archetype_dolicho", include_str!("../../rigs/breeds/archetype_dolicho.ron")),
    ("archetype_meso", include_str!("../../rigs/breeds/archetype_meso.ron")),
    ("australian_shepherd", include_str!("../../rigs/breeds/australian_shepherd.ron")),
    ("basenji", include_str!("../../rigs/breeds/basenji.ron")),
    ("basset", include_str!("../../rigs/breeds/basset.ron")),
    ("beagle", include_str!("../../rigs/breeds/beagle.ron")),
    ("bedlington", include_str!("../../rigs/breeds/bedlington.ron")),
    ("bernese", include_str!("../../rigs/breeds/bernese.ron")),
    ("bloodhound", include_str!("../../rigs/breeds/bloodhound.ron")),
    ("border_collie", include_str!("../../rigs/breeds/border_collie.ron")),
    ("borzoi", include_str!("../../rigs/breeds/borzoi.ron")),
    ("boston_terrier", include_str!("../../rigs/breeds/boston_terrier.ron")),
    ("boxer", include_str!("../../rigs/breeds/boxer.ron")),
    ("bull_terrier", include_str!("../../rigs/breeds/bull_terrier.ron")),
    ("bulldog", include_str!("../../rigs/breeds/bulldog.ron")),
    ("cavalier", include_str!("../../rigs/breeds/cavalier.ron")),
    ("chihuahua", include_str!("../../rigs/breeds/chihuahua.ron")),
    ("chow_chow", include_str!("../../rigs/breeds/chow_chow.ron")),
    ("corgi", include_str!("../../rigs/breeds/corgi.ron")),
    ("dachshund", include_str!("../../rigs/breeds/dachshund.ron")),
    ("dalmatian", include_str!("../../rigs/breeds/dalmatian.ron")),
    ("dobermann", include_str!("../../rigs/breeds/dobermann.ron")),
    ("english_cocker", include_str!("../../rigs/breeds/english_cocker.ron")),
    ("english_toy_terrier", include_str!("../../rigs/breeds/english_toy_terrier.ron")),
    ("french_bulldog", include_str!("../../rigs/breeds/french_bulldog.ron")),
    ("german_shepherd", include_str!("../../rigs/breeds/german_shepherd.ron")),
    ("golden_retriever", include_str!("../../rigs/breeds/golden_retriever.ron")),
    ("great_dane", include_str!("../../rigs/breeds/great_dane.ron")),
    ("greyhound", include_str!("../../rigs/breeds/greyhound.ron")),
    ("irish_setter", include_str!("../../rigs/breeds/irish_setter.ron")),
    ("irish_wolfhound", include_str!("../../rigs/breeds/irish_wolfhound.ron")),
    ("jack_russell", include_str!("../../rigs/breeds/jack_russell.ron")),
    ("labrador", include_str!("../../rigs/breeds/labrador.ron")),
    ("miniature_schnauzer", include_str!("../../rigs/breeds/miniature_schnauzer.ron")),
    ("mixed", include_str!("../../rigs/breeds/mixed.ron")),
    ("newfoundland", include_str!("../../rigs/breeds/newfoundland.ron")),
    ("papillon", include_str!("../../rigs/breeds/papillon.ron")),
    ("pekingese", include_str!("../../rigs/breeds/pekingese.ron")),
    ("pomeranian", include_str!("../../rigs/breeds/pomeranian.ron")),
    ("poodle", include_str!("../../rigs/breeds/poodle.ron")),
    ("pug", include_str!("../../rigs/breeds/pug.ron")),
    ("rottweiler", include_str!("../../rigs/breeds/rottweiler.ron")),
    ("rough_collie", include_str!("../../rigs/breeds/rough_collie.ron")),
    ("saint_bernard", include_str!("../../rigs/breeds/saint_bernard.ron")),
    ("samoyed", include_str!("../../rigs/breeds/samoyed.ron")),
    ("shar_pei", include_str!("../../rigs/breeds/shar_pei.ron")),
    ("shiba", include_str!("../../rigs/breeds/shiba.ron")),
    ("shih_tzu", include_str!("../../rigs/breeds/shih_tzu.ron")),
    ("siberian_husky", include_str!("../../rigs/breeds/siberian_husky.ron")),
    ("staffordshire", include_str!("../../rigs/breeds/staffordshire.ron")),
    ("weimaraner", include_str!("../../rigs/breeds/weimaraner.ron")),
    ("whippet", include_str!("../../rigs/breeds/whippet.ron")),
    ("wolf", include_str!("../../rigs/breeds/wolf.ron")),
    ("yorkshire_terrier", include_str!("../../rigs/breeds/yorkshire_terrier.ron")),
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
