//! Wavefront OBJ: the geometry of it and the tags of subdivision surfaces, read from bytes and written to text.
//!
//! After the "Object Files (.obj)" appendix of the Wavefront Advanced Visualizer manual. Of a file `v`, `vt` and `f`
//! become part of the mesh; `vn` is counted, so that faces which name normals can be checked. Groups, materials, lines
//! and free-form elements are passed over. Names and comments may be in any encoding.
//!
//! Tags are those of the shapes in OpenSubdiv's regression suite (`regression/common/shape_utils.cpp`, `parseTag`, and
//! `far_utils.h`, `assignComponentTags`): `t NAME INTS/FLOATS/STRINGS` and as many values. All their numbers count from
//! 0, a tag may stand before what it names, a negative sharpness is 0, and the last tag of an edge or vertex holds.
//! `crease` has two whole numbers for each edge and either one sharpness for all or one for each edge; `corner` has
//! vertices and one sharpness for all or for each; `hole` has faces. Where a crease has as many sharpnesses as whole
//! numbers, OpenSubdiv takes every second, and so do we. Other tags (`interpolateboundary`, `creasemethod` and so on)
//! choose rules for a whole surface and are passed over.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::{self, Write as _};
use std::str::FromStr;

use super::soup::{edge, fits_f32};
use super::{Soup, WriteError, check};

/// A sharpness that means: for ever.
const INFINITE_SHARPNESS: f32 = 10.0;

/// What is wrong in a file, and in which line, counted from 1.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}: {what}")]
pub struct ObjError {
    /// The line, from 1; of a continued line the first.
    pub line: usize,
    /// What is wrong there.
    pub what: ObjFault,
}

/// What can be wrong with a line.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ObjFault {
    /// A vertex with fewer than three numbers.
    #[error("a vertex needs x, y and z; this one has {found} numbers")]
    TooFewCoordinates {
        /// How many there are.
        found: usize,
    },
    /// A texture coordinate without a number.
    #[error("a texture coordinate needs u, and v where there are two; this one has no number")]
    NoTextureCoordinate,
    /// Something else where a number belongs, or a number that no finite 32-bit float can hold.
    #[error("\"{text}\" is not a finite number")]
    NotANumber {
        /// What stands there.
        text: String,
    },
    /// A face with fewer than three corners.
    #[error("a face needs three corners or more; this one has {found}")]
    TooFewCorners {
        /// How many there are.
        found: usize,
    },
    /// A corner that is none of `v`, `v/vt`, `v//vn`, `v/vt/vn`.
    #[error("\"{text}\" is not a corner; write v, v/vt, v//vn or v/vt/vn with whole numbers, from 1 or from -1 down")]
    NotACorner {
        /// What stands there.
        text: String,
    },
    /// A corner that names something the lines above do not have.
    #[error("{kind} {index} does not exist: there are {count} so far")]
    OutOfRange {
        /// `v`, `vt` or `vn`.
        kind: &'static str,
        /// As written.
        index: i64,
        /// How many there are up to this line.
        count: usize,
    },
    /// A tag without the three counts.
    #[error("a {tag} needs the numbers of its values, as in \"t {tag} {example}\"")]
    NoTagCounts {
        /// The tag.
        tag: &'static str,
        /// How it could look.
        example: &'static str,
    },
    /// Counts that do not fit the tag.
    #[error("a {tag} cannot have {ints} whole numbers and {floats} sharpnesses; write it as in \"t {tag} {example}\"")]
    TagCounts {
        /// The tag.
        tag: &'static str,
        /// As the counts say.
        ints: usize,
        /// As the counts say.
        floats: usize,
        /// How it could look.
        example: &'static str,
    },
    /// More or fewer values than the counts say.
    #[error("the counts of this {tag} ask for {expected} values, and {found} follow")]
    TagValues {
        /// The tag.
        tag: &'static str,
        /// The sum of its counts.
        expected: usize,
        /// How many there are.
        found: usize,
    },
    /// A tag that names a vertex or face the file does not have.
    #[error("{kind} {index} of this tag does not exist: the file has {count}, counted from 0")]
    TagOutOfRange {
        /// `vertex` or `face`.
        kind: &'static str,
        /// As written.
        index: i64,
        /// How many the whole file has.
        count: usize,
    },
    /// A crease where no face has a side.
    #[error("no face has a side from vertex {a} to vertex {b}, counted from 0, so it cannot be a crease")]
    NotAnEdge {
        /// As written.
        a: u32,
        /// As written.
        b: u32,
    },
    /// More vertices, texture coordinates or faces than 32 bits count.
    #[error("more than {} {kind}", u32::MAX)]
    TooMany {
        /// Of which kind.
        kind: &'static str,
    },
}

/// Reads a file. A file without faces is no error here; the connectivity decides what it needs.
///
/// Vertices are those of the file, used or not, and none is welded.
///
/// # Errors
/// The first line that is wrong; a tag that names what the file does not have comes after all others.
pub fn read(bytes: &[u8]) -> Result<Soup, ObjError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = String::from_utf8_lossy(bytes);
    let mut reader = Reader::default();
    let mut continued = String::new();
    for (i, line) in text.split('\n').enumerate() {
        let line = line.strip_suffix('\r').unwrap_or(line);
        if continued.is_empty() {
            reader.line = i + 1;
        }
        if let Some(start) = line.strip_suffix('\\') {
            continued.push_str(start);
            continued.push(' ');
            continue;
        }
        let done = if continued.is_empty() {
            reader.statement(line)
        } else {
            continued.push_str(line);
            reader.statement(&std::mem::take(&mut continued))
        };
        done.map_err(|what| ObjError { line: reader.line, what })?;
    }
    reader.statement(&continued).map_err(|what| ObjError { line: reader.line, what })?;
    reader.finish()
}

/// Writes a mesh with its polygons, texture coordinates and tags. `normals`, where given, has one for each position.
///
/// Positions, texture coordinates and normals have nine significant digits: read back and rounded to 32 bits, they are
/// the same 32-bit floats.
///
/// # Errors
/// A mesh that is inconsistent, or normals of another number than positions.
pub fn write(soup: &Soup, normals: Option<&[[f64; 3]]>) -> Result<String, WriteError> {
    check(soup, normals)?;
    let mut text = String::with_capacity(32 * soup.positions.len() + 8 * soup.corners.len());
    // Writing to a string does not fail, here and below.
    for [x, y, z] in &soup.positions {
        let _ = writeln!(text, "v {} {} {}", Nine(*x), Nine(*y), Nine(*z));
    }
    for [u, v] in &soup.uvs {
        let _ = writeln!(text, "vt {} {}", Nine(*u), Nine(*v));
    }
    for [x, y, z] in normals.unwrap_or_default() {
        let _ = writeln!(text, "vn {} {} {}", Nine(*x), Nine(*y), Nine(*z));
    }
    let mut uv_corners = soup.uv_corners.iter();
    for face in soup.faces() {
        text.push('f');
        for &vertex in face {
            let v = u64::from(vertex) + 1;
            let vt = uv_corners.next().map(|&uv| u64::from(uv) + 1);
            let _ = match (vt, normals) {
                (None, None) => write!(text, " {v}"),
                (Some(vt), None) => write!(text, " {v}/{vt}"),
                (None, Some(_)) => write!(text, " {v}//{v}"),
                (Some(vt), Some(_)) => write!(text, " {v}/{vt}/{v}"),
            };
        }
        text.push('\n');
    }
    for &(a, b, sharpness) in &soup.creases {
        let _ = writeln!(text, "t crease 2/1/0 {a} {b} {}", sharpness.min(INFINITE_SHARPNESS));
    }
    for &(vertex, sharpness) in &soup.point_creases {
        let _ = writeln!(text, "t corner 1/1/0 {vertex} {}", sharpness.min(INFINITE_SHARPNESS));
    }
    for face in &soup.holes {
        let _ = writeln!(text, "t hole 1/0/0 {face}");
    }
    Ok(text)
}

/// A number in nine significant digits, without the zeros at their end.
struct Nine(f64);

impl fmt::Display for Nine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Nine digits that are read as a 64-bit float are also the shortest that give this float.
        let rounded: f64 = format!("{:.8e}", self.0).parse().map_err(|_| fmt::Error)?;
        match rounded.abs() {
            0.0 | 1e-5..1e9 => write!(f, "{rounded}"),
            _ => write!(f, "{rounded:e}"),
        }
    }
}

#[derive(Default)]
struct Reader {
    soup: Soup,
    n_normals: usize,
    some_corner_has_no_uv: bool,
    /// Where we are, from 1.
    line: usize,
    /// Tags may stand before what they name: they wait here, with their lines.
    creases: Vec<(usize, [i64; 2], f32)>,
    point_creases: Vec<(usize, i64, f32)>,
    holes: Vec<(usize, i64)>,
}

impl Reader {
    fn statement(&mut self, line: &str) -> Result<(), ObjFault> {
        let line = line.split('#').next().unwrap_or_default();
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => self.vertex(words),
            Some("vt") => self.texture_coordinate(words),
            Some("vn") => {
                self.n_normals += 1;
                Ok(())
            }
            Some("f") => self.face(words),
            Some("t") => self.tag(words),
            _ => Ok(()),
        }
    }

    /// x, y, z; what may follow (a weight, a colour) is not read.
    fn vertex<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), ObjFault> {
        let (position, found) = numbers(words)?;
        if found < 3 {
            return Err(ObjFault::TooFewCoordinates { found });
        }
        room(&self.soup.positions, "vertices")?;
        self.soup.positions.push(position);
        Ok(())
    }

    /// u, v; a file of one-dimensional textures has no v.
    fn texture_coordinate<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), ObjFault> {
        let (uv, found) = numbers(words)?;
        if found == 0 {
            return Err(ObjFault::NoTextureCoordinate);
        }
        room(&self.soup.uvs, "texture coordinates")?;
        self.soup.uvs.push(uv);
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), ObjFault> {
        let start = self.soup.corners.len();
        for word in words {
            let (vertex, uv) = self.corner(word)?;
            self.soup.corners.push(vertex);
            match uv {
                Some(uv) => self.soup.uv_corners.push(uv),
                None => self.some_corner_has_no_uv = true,
            }
        }
        let found = self.soup.corners.len() - start;
        if found < 3 {
            return Err(ObjFault::TooFewCorners { found });
        }
        room(&self.soup.face_sizes, "faces")?;
        self.soup.face_sizes.push(u32::try_from(found).map_err(|_| ObjFault::TooMany { kind: "corners of a face" })?);
        Ok(())
    }

    /// The vertex of a corner, and its texture coordinate if it has one.
    fn corner(&self, word: &str) -> Result<(u32, Option<u32>), ObjFault> {
        let not_a_corner = || ObjFault::NotACorner { text: word.to_owned() };
        let mut parts = word.split('/');
        let vertex = parts.next().unwrap_or_default();
        let vertex = resolve("v", vertex, self.soup.positions.len()).ok_or_else(not_a_corner)??;
        let (texture, normal) = (parts.next(), parts.next());
        if parts.next().is_some() || normal == Some("") || (texture == Some("") && normal.is_none()) {
            return Err(not_a_corner());
        }
        let texture = match texture.filter(|t| !t.is_empty()) {
            Some(texture) => Some(resolve("vt", texture, self.soup.uvs.len()).ok_or_else(not_a_corner)??),
            None => None,
        };
        if let Some(normal) = normal {
            resolve("vn", normal, self.n_normals).ok_or_else(not_a_corner)??;
        }
        Ok((vertex, texture))
    }

    fn tag<'a>(&mut self, mut words: impl Iterator<Item = &'a str>) -> Result<(), ObjFault> {
        let (tag, example) = match words.next() {
            Some("crease") => ("crease", "2/1/0 VERTEX VERTEX SHARPNESS"),
            Some("corner") => ("corner", "1/1/0 VERTEX SHARPNESS"),
            Some("hole") => ("hole", "1/0/0 FACE"),
            _ => return Ok(()),
        };
        let counts = words.next().and_then(tag_counts).ok_or(ObjFault::NoTagCounts { tag, example })?;
        let words: Vec<&str> = words.collect();
        let expected = counts.iter().fold(0_usize, |sum, &n| sum.saturating_add(n));
        if words.len() != expected {
            return Err(ObjFault::TagValues { tag, expected, found: words.len() });
        }
        let [n_ints, n_floats, _] = counts;
        let (ints, floats) = words.split_at(n_ints);
        let ints: Vec<i64> = ints.iter().map(|word| parsed(word)).collect::<Result<_, _>>()?;
        let floats: Vec<f32> = floats[..n_floats].iter().map(|word| sharpness(word)).collect::<Result<_, _>>()?;
        let line = self.line;
        match (tag, floats.len()) {
            ("hole", _) => self.holes.extend(ints.iter().map(|&face| (line, face))),
            ("corner", n) if n == 1 || n == n_ints => {
                let floats = floats.iter().cycle();
                self.point_creases.extend(ints.iter().zip(floats).map(|(&vertex, &s)| (line, vertex, s)));
            }
            ("crease", n) if n_ints.is_multiple_of(2) && (n == 1 || n == n_ints / 2 || n == n_ints) => {
                let step = if n == n_ints { 2 } else { 1 };
                let floats = floats.iter().step_by(step).cycle();
                self.creases.extend(ints.as_chunks().0.iter().zip(floats).map(|(&edge, &s)| (line, edge, s)));
            }
            (_, floats) => return Err(ObjFault::TagCounts { tag, ints: n_ints, floats, example }),
        }
        Ok(())
    }

    /// Checks the tags against the whole file and adds them to it.
    fn finish(mut self) -> Result<Soup, ObjError> {
        if self.some_corner_has_no_uv {
            self.soup.uv_corners = Vec::new();
        }
        let (n_vertices, n_faces) = (self.soup.positions.len(), self.soup.face_sizes.len());
        let in_range = |kind, line, index: i64, count: usize| match u32::try_from(index) {
            Ok(i) if (i as usize) < count => Ok(i),
            _ => Err(ObjError { line, what: ObjFault::TagOutOfRange { kind, index, count } }),
        };
        for &(line, [a, b], sharpness) in &self.creases {
            let edge = (in_range("vertex", line, a, n_vertices)?, in_range("vertex", line, b, n_vertices)?);
            self.soup.creases.push((edge.0, edge.1, sharpness));
        }
        for &(line, vertex, sharpness) in &self.point_creases {
            self.soup.point_creases.push((in_range("vertex", line, vertex, n_vertices)?, sharpness));
        }
        let mut holes = BTreeSet::new();
        for &(line, face) in &self.holes {
            holes.insert(in_range("face", line, face, n_faces)?);
        }
        self.soup.holes = holes.into_iter().collect();
        if let Some((line, a, b)) = self.crease_without_edge() {
            return Err(ObjError { line, what: ObjFault::NotAnEdge { a, b } });
        }
        self.soup.settle_tags();
        Ok(self.soup)
    }

    /// The first crease that lies on no side of a face.
    fn crease_without_edge(&self) -> Option<(usize, u32, u32)> {
        if self.creases.is_empty() {
            return None;
        }
        let mut found: BTreeMap<_, bool> = self.soup.creases.iter().map(|&(a, b, _)| (edge(a, b), false)).collect();
        for face in self.soup.faces() {
            let next = face.iter().cycle().skip(1);
            for (&a, &b) in face.iter().zip(next) {
                if let Some(found) = found.get_mut(&edge(a, b)) {
                    *found = true;
                }
            }
        }
        let mut lines = self.soup.creases.iter().zip(&self.creases);
        lines.find_map(|(&(a, b, _), &(line, ..))| (!found[&edge(a, b)]).then_some((line, a, b)))
    }
}

/// Up to `N` finite numbers, 0 where there are fewer, and how many there are.
fn numbers<'a, const N: usize>(words: impl Iterator<Item = &'a str>) -> Result<([f64; N], usize), ObjFault> {
    let mut numbers = [0.0; N];
    let mut found = 0;
    for (number, word) in numbers.iter_mut().zip(words) {
        *number = parsed(word).ok().filter(|&x| fits_f32(x)).ok_or_else(|| not_a_number(word))?;
        found += 1;
    }
    Ok((numbers, found))
}

fn parsed<T: FromStr>(word: &str) -> Result<T, ObjFault> {
    word.parse().map_err(|_| not_a_number(word))
}

fn not_a_number(word: &str) -> ObjFault {
    ObjFault::NotANumber { text: word.to_owned() }
}

/// 0 or more; "inf" is a sharpness.
fn sharpness(word: &str) -> Result<f32, ObjFault> {
    let sharpness: f32 = parsed(word)?;
    match sharpness {
        s if s.is_nan() => Err(not_a_number(word)),
        s if s >= INFINITE_SHARPNESS => Ok(f32::INFINITY),
        s => Ok(s.max(0.0)),
    }
}

/// `INTS/FLOATS/STRINGS`.
fn tag_counts(word: &str) -> Option<[usize; 3]> {
    let mut parts = word.split('/').map(|part| part.parse().ok());
    let counts = [parts.next()??, parts.next()??, parts.next()??];
    parts.next().is_none().then_some(counts)
}

/// An error where one more would not be counted by 32 bits.
fn room<T>(items: &[T], kind: &'static str) -> Result<(), ObjFault> {
    if items.len() < u32::MAX as usize { Ok(()) } else { Err(ObjFault::TooMany { kind }) }
}

/// From a number as written (1 is the first, -1 the latest) to one from 0. None where it is no whole number or zero.
fn resolve(kind: &'static str, text: &str, count: usize) -> Option<Result<u32, ObjFault>> {
    let index: i64 = text.parse().ok().filter(|&i| i != 0)?;
    let from_zero = if index > 0 { index - 1 } else { count as i64 + index };
    let in_range = (0..count as i64).contains(&from_zero);
    Some(if in_range { Ok(from_zero as u32) } else { Err(ObjFault::OutOfRange { kind, index, count }) })
}
