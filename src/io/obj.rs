//! Wavefront OBJ: the geometry of it, read from bytes and written to text.
//!
//! After the "Object Files (.obj)" appendix of the Wavefront Advanced Visualizer manual. Of a file only `v` and `f`
//! become part of the mesh; `vt` and `vn` are counted, so that faces which name them can be checked. Groups,
//! materials, lines and free-form elements are passed over. Polygons are cut into fans from their first corner, which
//! is right for convex ones. Names and comments may be in any encoding.

use std::fmt::Write as _;

use glam::Vec3;

/// A triangle mesh with a position for each vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ObjMesh {
    /// In the order of the file, whether a face uses them or not.
    pub positions: Vec<Vec3>,
    /// Vertex numbers from 0, in the order of the file and, within a polygon, around its first corner.
    pub triangles: Vec<[u32; 3]>,
}

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
    /// More vertices than 32 bits count.
    #[error("more than {} vertices", u32::MAX)]
    TooManyVertices,
}

/// Reads a file. A file without faces is no error here; the connectivity decides what it needs.
///
/// # Errors
/// The first line that is wrong.
pub fn read(bytes: &[u8]) -> Result<ObjMesh, ObjError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    let text = String::from_utf8_lossy(bytes);
    let mut reader = Reader::default();
    let mut continued = String::new();
    let mut first_line = 1;
    for (i, line) in text.split('\n').enumerate() {
        let line = line.strip_suffix('\r').unwrap_or(line);
        if continued.is_empty() {
            first_line = i + 1;
        }
        if let Some(start) = line.strip_suffix('\\') {
            continued.push_str(start);
            continued.push(' ');
            continue;
        }
        continued.push_str(line);
        reader.statement(&continued).map_err(|what| ObjError { line: first_line, what })?;
        continued.clear();
    }
    reader.statement(&continued).map_err(|what| ObjError { line: first_line, what })?;
    Ok(reader.mesh)
}

/// Writes a mesh. `normals`, where given, has one for each position; `triangles` name positions from 0.
/// Numbers are the shortest that read back to the same bits.
///
/// # Panics
/// Where `normals` has another length than `positions`.
pub fn write(positions: &[Vec3], normals: Option<&[Vec3]>, triangles: &[[u32; 3]]) -> String {
    let mut text = String::with_capacity(40 * positions.len() + 24 * triangles.len());
    // Writing to a string does not fail.
    for p in positions {
        let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
    }
    if let Some(normals) = normals {
        assert_eq!(normals.len(), positions.len(), "one normal for each position");
        for n in normals {
            let _ = writeln!(text, "vn {} {} {}", n.x, n.y, n.z);
        }
    }
    for triangle in triangles {
        let [a, b, c] = triangle.map(|v| u64::from(v) + 1);
        let _ = match normals {
            Some(_) => writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}"),
            None => writeln!(text, "f {a} {b} {c}"),
        };
    }
    text
}

#[derive(Default)]
struct Reader {
    mesh: ObjMesh,
    n_texture: usize,
    n_normal: usize,
}

impl Reader {
    fn statement(&mut self, line: &str) -> Result<(), ObjFault> {
        let line = line.split('#').next().unwrap_or_default();
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => self.vertex(words),
            Some("vt") => {
                self.n_texture += 1;
                Ok(())
            }
            Some("vn") => {
                self.n_normal += 1;
                Ok(())
            }
            Some("f") => self.face(words),
            _ => Ok(()),
        }
    }

    /// x, y, z; what may follow (a weight, a colour) is not read.
    fn vertex<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), ObjFault> {
        let mut coordinates = [0.0_f32; 3];
        let mut found = 0;
        for (coordinate, word) in coordinates.iter_mut().zip(words) {
            let number: Option<f32> = word.parse().ok().filter(|x: &f32| x.is_finite());
            *coordinate = number.ok_or_else(|| ObjFault::NotANumber { text: word.to_owned() })?;
            found += 1;
        }
        if found < 3 {
            return Err(ObjFault::TooFewCoordinates { found });
        }
        if self.mesh.positions.len() >= u32::MAX as usize {
            return Err(ObjFault::TooManyVertices);
        }
        self.mesh.positions.push(coordinates.into());
        Ok(())
    }

    fn face<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), ObjFault> {
        let mut corners = Vec::new();
        for word in words {
            corners.push(self.corner(word)?);
        }
        let [first, rest @ ..] = &corners[..] else { return Err(ObjFault::TooFewCorners { found: 0 }) };
        if rest.len() < 2 {
            return Err(ObjFault::TooFewCorners { found: corners.len() });
        }
        self.mesh.triangles.extend(rest.windows(2).map(|pair| [*first, pair[0], pair[1]]));
        Ok(())
    }

    fn corner(&self, word: &str) -> Result<u32, ObjFault> {
        let not_a_corner = || ObjFault::NotACorner { text: word.to_owned() };
        let mut parts = word.split('/');
        let vertex = parts.next().unwrap_or_default();
        let vertex = resolve("v", vertex, self.mesh.positions.len()).ok_or_else(not_a_corner)??;
        let (texture, normal) = (parts.next(), parts.next());
        if parts.next().is_some() || normal == Some("") || (texture == Some("") && normal.is_none()) {
            return Err(not_a_corner());
        }
        if let Some(texture) = texture.filter(|t| !t.is_empty()) {
            resolve("vt", texture, self.n_texture).ok_or_else(not_a_corner)??;
        }
        if let Some(normal) = normal {
            resolve("vn", normal, self.n_normal).ok_or_else(not_a_corner)??;
        }
        Ok(vertex)
    }
}

/// From a number as written (1 is the first, -1 the latest) to one from 0. None where it is no whole number or zero.
fn resolve(kind: &'static str, text: &str, count: usize) -> Option<Result<u32, ObjFault>> {
    let index: i64 = text.parse().ok().filter(|&i| i != 0)?;
    let from_zero = if index > 0 { index - 1 } else { count as i64 + index };
    let in_range = (0..count as i64).contains(&from_zero);
    Some(if in_range { Ok(from_zero as u32) } else { Err(ObjFault::OutOfRange { kind, index, count }) })
}
