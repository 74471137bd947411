//! Stereolithography: triangles without shared vertices, as text or binary.
//!
//! After 3D Systems' "StereoLithography Interface Specification" of 1988. Normals, colours and names are passed over.
//! Vertices are welded where their bits are equal, over all solids of a file, since solids are often patches of one
//! surface; a facet whose corners are not three points is dropped.
//!
//! A binary file should not begin with "solid", and many do. So a file whose length fits its own count of facets is
//! binary whatever it begins with, and so is one with a zero byte near its start.

use super::soup::fits_f32;
use super::{Place, Soup, bytes_at};

const HEADER: usize = 84;
const FACET: usize = 50;
/// How far a text is looked through for what no text has.
const PROBE: usize = 512;

/// What is wrong in a file, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{place}: {what}")]
pub struct StlError {
    /// The line of a text, the byte of a binary file.
    pub place: Place,
    /// What is wrong there.
    pub what: StlFault,
}

/// What can be wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum StlFault {
    /// A binary file ends before its last facet, or in its header.
    #[error("{facets} facets need {needed} bytes, and the file has {found}: it is cut off or not STL")]
    CutOff {
        /// As the file says.
        facets: u32,
        /// Header and facets.
        needed: u64,
        /// Length of the file.
        found: usize,
    },
    /// A text that ends before `endsolid`.
    #[error("the file ends inside a solid, without \"endsolid\": it is cut off")]
    NoEnd,
    /// A line that may not stand here.
    #[error("\"{text}\" stands where \"{expected}\" belongs")]
    Unexpected {
        /// First word of the line.
        text: String,
        /// What belongs there.
        expected: &'static str,
    },
    /// A vertex without three finite numbers.
    #[error("a vertex needs three finite numbers")]
    NotAVertex,
    /// More vertices than 32 bits count.
    #[error("more than {} vertices before welding", u32::MAX)]
    TooMany,
}

/// Whether a file looks like STL, as text or binary.
pub(super) fn is_stl(bytes: &[u8]) -> bool {
    fits_its_count(bytes) || is_text(bytes)
}

/// Reads a file and welds its vertices.
///
/// # Errors
/// The first thing that is wrong.
pub fn read(bytes: &[u8]) -> Result<Soup, StlError> {
    let positions = if !fits_its_count(bytes) && is_text(bytes) { read_text(bytes)? } else { read_binary(bytes)? };
    let n = u32::try_from(positions.len()).map_err(|_| StlError { place: Place::Byte(0), what: StlFault::TooMany })?;
    let mut soup =
        Soup { positions, face_sizes: vec![3; n as usize / 3], corners: (0..n).collect(), ..Soup::default() };
    soup.weld();
    // Nothing is left of what only dropped facets used.
    Ok(soup.without_unused())
}

fn n_facets(bytes: &[u8]) -> Option<u32> {
    bytes_at(bytes, HEADER - 4).map(u32::from_le_bytes)
}

fn n_bytes(n_facets: u32) -> u64 {
    HEADER as u64 + FACET as u64 * u64::from(n_facets)
}

fn fits_its_count(bytes: &[u8]) -> bool {
    n_facets(bytes).is_some_and(|n| n_bytes(n) == bytes.len() as u64)
}

fn is_text(bytes: &[u8]) -> bool {
    let start = bytes.trim_ascii_start();
    let is_solid = start.first_chunk().is_some_and(|word: &[u8; 5]| word.eq_ignore_ascii_case(b"solid"));
    is_solid && !start[..start.len().min(PROBE)].contains(&0)
}

/// Three positions for each facet. What follows the last facet is passed over.
fn read_binary(bytes: &[u8]) -> Result<Vec<[f64; 3]>, StlError> {
    let facets = n_facets(bytes).unwrap_or(0);
    let body = bytes.get(HEADER..).unwrap_or_default().as_chunks::<FACET>().0;
    let Some(body) = body.get(..facets as usize).filter(|_| bytes.len() >= HEADER) else {
        let what = StlFault::CutOff { facets, needed: n_bytes(facets), found: bytes.len() };
        return Err(StlError { place: Place::Byte(bytes.len()), what });
    };
    let mut positions = Vec::with_capacity(3 * body.len());
    for (i, facet) in body.iter().enumerate() {
        // The normal's 12 bytes come first, the attribute's 2 last.
        for (k, vertex) in facet[12..48].as_chunks::<12>().0.iter().enumerate() {
            let words = vertex.as_chunks::<4>().0;
            let position = [words[0], words[1], words[2]].map(|word| f64::from(f32::from_le_bytes(word)));
            if !position.iter().all(|&x| fits_f32(x)) {
                let place = Place::Byte(HEADER + FACET * i + 12 + 12 * k);
                return Err(StlError { place, what: StlFault::NotAVertex });
            }
            positions.push(position);
        }
    }
    Ok(positions)
}

/// The lines of a facet, from the one that begins it on.
const GRAMMAR: [&str; 7] = ["facet", "outer", "vertex", "vertex", "vertex", "endloop", "endfacet"];

/// Three positions for each facet.
fn read_text(bytes: &[u8]) -> Result<Vec<[f64; 3]>, StlError> {
    let mut positions = Vec::new();
    let mut in_solid = false;
    let mut step = 0;
    let mut line = 0;
    for text in bytes.split(|&byte| byte == b'\n') {
        line += 1;
        let wrong = |what| StlError { place: Place::Line(line), what };
        let mut words = text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let Some(word) = words.next() else { continue };
        let expected = if in_solid { GRAMMAR[step] } else { "solid" };
        if in_solid && step == 0 && word.eq_ignore_ascii_case(b"endsolid") {
            in_solid = false;
            continue;
        }
        if !word.eq_ignore_ascii_case(expected.as_bytes()) {
            let text = String::from_utf8_lossy(&word[..word.len().min(40)]).into_owned();
            return Err(wrong(StlFault::Unexpected { text, expected }));
        }
        if !in_solid {
            in_solid = true;
            continue;
        }
        if expected == "vertex" {
            positions.push(vertex(words).ok_or_else(|| wrong(StlFault::NotAVertex))?);
        }
        step = (step + 1) % GRAMMAR.len();
    }
    if in_solid {
        return Err(StlError { place: Place::Line(line), what: StlFault::NoEnd });
    }
    Ok(positions)
}

/// Numbers are read as 32-bit floats, so that a text and a binary file of the same mesh are equal.
fn vertex<'a>(mut words: impl Iterator<Item = &'a [u8]>) -> Option<[f64; 3]> {
    let mut number = || {
        let number: f32 = str::from_utf8(words.next()?).ok()?.parse().ok()?;
        number.is_finite().then_some(f64::from(number))
    };
    Some([number()?, number()?, number()?])
}
