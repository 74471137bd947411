//! Polygon file format (.ply): vertices and polygons, as text or binary in either byte order.
//!
//! After Greg Turk's "The PLY Polygon File Format" of 1994. Of a file the element `vertex` with x, y, z and the
//! element `face` with `vertex_indices` or `vertex_index` become the mesh; other properties and elements are passed
//! over. Triangle strips (`tristrips`) are not read.

use super::soup::fits_f32;
use super::{Place, Soup, WriteError, bytes_at, check};

/// What is wrong in a file, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{place}: {what}")]
pub struct PlyError {
    /// The line of the header or of a text, the byte of a binary file.
    pub place: Place,
    /// What is wrong there.
    pub what: PlyFault,
}

/// What can be wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlyFault {
    /// Another start than a PLY file has.
    #[error("not a PLY file: it does not begin with a line \"ply\"")]
    NotPly,
    /// A line of the header that is not understood.
    #[error("\"{text}\" is not understood in a header: {why}")]
    Header {
        /// The line, or its start.
        text: String,
        /// What is wrong with it.
        why: &'static str,
    },
    /// A header without its last line.
    #[error("the header has no end: the line \"end_header\" is missing")]
    EndlessHeader,
    /// No format line.
    #[error("the header names no format")]
    NoFormat,
    /// An element that is needed does not have what is needed.
    #[error("element {element} needs {property}")]
    Missing {
        /// `vertex` or `face`.
        element: &'static str,
        /// What is needed.
        property: &'static str,
    },
    /// Triangle strips.
    #[error("triangle strips are not read: write the file with the element face")]
    Strips,
    /// The file ends too early.
    #[error("the file ends in {element} {index} of {count}: it is cut off")]
    CutOff {
        /// The element.
        element: String,
        /// Which of them, from 0.
        index: u64,
        /// How many the header promises.
        count: u64,
    },
    /// Something else where a number belongs, or another number than may stand there.
    #[error("\"{text}\" is not {expected}")]
    NotANumber {
        /// What stands there.
        text: String,
        /// What belongs there.
        expected: &'static str,
    },
    /// A face with fewer than three corners.
    #[error("a face needs three corners or more; this one has {found}")]
    TooFewCorners {
        /// How many there are.
        found: u64,
    },
    /// A face of a vertex that the header does not promise.
    #[error("vertex {vertex} does not exist: there are {count}, counted from 0")]
    OutOfRange {
        /// The vertex.
        vertex: u64,
        /// How many there are.
        count: u64,
    },
    /// More vertices than 32 bits count.
    #[error("more than {} vertices", u32::MAX)]
    TooMany,
}

/// Reads a file. Its vertices stay as they are, used or not.
///
/// # Errors
/// The first thing that is wrong.
pub fn read(bytes: &[u8]) -> Result<Soup, PlyError> {
    let (elements, mut source) = header(bytes)?;
    let count_of = |name| elements.iter().find(|e| e.name == name).map_or(0, |e| e.count);
    let n_vertices = count_of("vertex");
    if n_vertices > u64::from(u32::MAX) || count_of("face") > u64::from(u32::MAX) {
        return Err(PlyError { place: Place::Line(1), what: PlyFault::TooMany });
    }
    let roles = |element: &Element| element.roles().map_err(|what| PlyError { place: Place::Line(element.line), what });
    let roles: Vec<Vec<Role>> = elements.iter().map(roles).collect::<Result<_, _>>()?;
    let mut soup = Soup::default();
    for (element, roles) in elements.iter().zip(&roles) {
        // An element without properties takes no room, so its count says nothing about the length of the file.
        let n_rows = if element.properties.is_empty() { 0 } else { element.count };
        for row in 0..n_rows {
            let mut reader = Row { source: &mut source, element, row, n_vertices };
            let mut position = [0.0; 3];
            for (property, role) in element.properties.iter().zip(roles) {
                match *role {
                    Role::Coordinate(axis) => position[axis] = reader.coordinate(property.kind)?,
                    Role::Corners(count) => reader.face(count, property.kind, &mut soup)?,
                    Role::Nothing => reader.pass(property)?,
                }
            }
            if element.name == "vertex" {
                soup.positions.push(position);
            }
        }
    }
    Ok(soup)
}

/// Writes a binary little-endian file: positions and normals as 32-bit floats, and the faces that are not holes.
/// `normals`, where given, has one unit vector for each position. Texture coordinates and tags are not written.
///
/// # Errors
/// A mesh that is inconsistent, or normals of another number than positions.
pub fn write(soup: &Soup, normals: Option<&[[f64; 3]]>) -> Result<Vec<u8>, WriteError> {
    check(soup, normals)?;
    let n_faces = soup.solid_faces().count();
    // Many readers know one-byte counts alone.
    let wide = soup.face_sizes.iter().any(|&size| size > u32::from(u8::MAX));
    let count = if wide { "uint" } else { "uchar" };
    let normal = if normals.is_some() { "property float nx\nproperty float ny\nproperty float nz\n" } else { "" };
    let header = format!(
        "ply\nformat binary_little_endian 1.0\ncomment Londra {version}\n\
         element vertex {n_vertices}\nproperty float x\nproperty float y\nproperty float z\n{normal}\
         element face {n_faces}\nproperty list {count} int vertex_indices\nend_header\n",
        version = env!("CARGO_PKG_VERSION"),
        n_vertices = soup.positions.len(),
    );
    let mut out = header.into_bytes();
    let mut vector = |v: &[f64; 3]| out.extend(v.iter().flat_map(|&x| (x as f32).to_le_bytes()));
    for (i, position) in soup.positions.iter().enumerate() {
        vector(position);
        if let Some(normals) = normals {
            vector(&normals[i]);
        }
    }
    for face in soup.solid_faces() {
        match wide {
            true => out.extend((face.len() as u32).to_le_bytes()),
            false => out.push(face.len() as u8),
        }
        out.extend(face.iter().flat_map(|vertex| vertex.to_le_bytes()));
    }
    Ok(out)
}

/// A type of number. Every one fits a 64-bit float.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    F32,
    F64,
}

impl Kind {
    fn from_name(name: &str) -> Option<Self> {
        Some(match name {
            "char" | "int8" => Self::I8,
            "uchar" | "uint8" => Self::U8,
            "short" | "int16" => Self::I16,
            "ushort" | "uint16" => Self::U16,
            "int" | "int32" => Self::I32,
            "uint" | "uint32" => Self::U32,
            "float" | "float32" => Self::F32,
            "double" | "float64" => Self::F64,
            _ => return None,
        })
    }
}

struct Property {
    name: String,
    kind: Kind,
    /// Of a list, the type of its count.
    list: Option<Kind>,
}

struct Element {
    name: String,
    count: u64,
    properties: Vec<Property>,
    /// Where in the header it begins.
    line: usize,
}

/// What a property is for us.
#[derive(Clone, Copy)]
enum Role {
    Nothing,
    /// 0 to 2.
    Coordinate(usize),
    /// With the type of its count.
    Corners(Kind),
}

impl Element {
    /// One for each property, each role once.
    fn roles(&self) -> Result<Vec<Role>, PlyFault> {
        let mut roles = vec![Role::Nothing; self.properties.len()];
        let find = |name: &str| self.properties.iter().position(|p| p.name == name);
        match &*self.name {
            "vertex" => {
                for (axis, name) in ["x", "y", "z"].into_iter().enumerate() {
                    let property = find(name).filter(|&i| self.properties[i].list.is_none());
                    let missing = PlyFault::Missing { element: "vertex", property: "the numbers x, y and z" };
                    roles[property.ok_or(missing)?] = Role::Coordinate(axis);
                }
            }
            "face" => {
                let property = find("vertex_indices").or_else(|| find("vertex_index"));
                let list = property.and_then(|i| Some((i, self.properties[i].list?)));
                let missing =
                    PlyFault::Missing { element: "face", property: "the list vertex_indices or vertex_index" };
                let (i, count) = list.ok_or(missing)?;
                roles[i] = Role::Corners(count);
            }
            "tristrips" => return Err(PlyFault::Strips),
            _ => {}
        }
        Ok(roles)
    }
}

/// The elements that the header names, and what follows it.
fn header(bytes: &[u8]) -> Result<(Vec<Element>, Source<'_>), PlyError> {
    let mut elements: Vec<Element> = Vec::new();
    let mut format = None;
    let mut at = 0;
    let mut line = 0;
    loop {
        line += 1;
        let error = |what| PlyError { place: Place::Line(line), what };
        let rest = bytes.get(at..).unwrap_or_default();
        let end = rest
            .iter()
            .position(|&byte| byte == b'\n')
            .ok_or_else(|| error(if line == 1 { PlyFault::NotPly } else { PlyFault::EndlessHeader }))?;
        at += end + 1;
        let text = rest[..end].trim_ascii_end();
        if line == 1 {
            if text != b"ply" {
                return Err(error(PlyFault::NotPly));
            }
            continue;
        }
        let unclear = |why| {
            let text = String::from_utf8_lossy(&text[..text.len().min(80)]).into_owned();
            error(PlyFault::Header { text, why })
        };
        let mut words = text.split(u8::is_ascii_whitespace).filter(|word| !word.is_empty());
        let words = [(); 5].map(|()| words.next().map_or("", |word| str::from_utf8(word).unwrap_or("?")));
        match words {
            ["comment" | "obj_info" | "", ..] => {}
            ["format", name, ..] => {
                let is_known = ["ascii", "binary_little_endian", "binary_big_endian"].contains(&name);
                format = Some(name).filter(|_| is_known);
                format.ok_or_else(|| unclear("the formats are ascii, binary_little_endian and binary_big_endian"))?;
            }
            ["element", name, count, ..] => {
                let count = count.parse().map_err(|_| unclear("an element needs a name and a count"))?;
                // Only where it matters: a header of very many elements is not searched for each of them.
                if matches!(name, "vertex" | "face") && elements.iter().any(|e| e.name == name) {
                    return Err(unclear("there is another element of this name"));
                }
                elements.push(Element { name: name.to_owned(), count, properties: Vec::new(), line });
            }
            ["property", "list", count, kind, name] if !name.is_empty() => {
                let element = elements.last_mut().ok_or_else(|| unclear("a property belongs to an element"))?;
                let kinds = (Kind::from_name(count), Kind::from_name(kind));
                let (Some(count), Some(kind)) = kinds else { return Err(unclear("the type is unknown")) };
                element.properties.push(Property { name: name.to_owned(), kind, list: Some(count) });
            }
            ["property", kind, name, ..] if !name.is_empty() => {
                let element = elements.last_mut().ok_or_else(|| unclear("a property belongs to an element"))?;
                let kind = Kind::from_name(kind).ok_or_else(|| unclear("the type is unknown"))?;
                element.properties.push(Property { name: name.to_owned(), kind, list: None });
            }
            ["end_header", ..] => {
                let source = match format.ok_or_else(|| error(PlyFault::NoFormat))? {
                    "ascii" => Source::Text { rest: &bytes[at..], line: line + 1 },
                    name => Source::Binary { bytes, at, big: name == "binary_big_endian" },
                };
                return Ok((elements, source));
            }
            _ => return Err(unclear("the lines of a header are format, comment, element and property")),
        }
    }
}

/// Where numbers come from.
enum Source<'a> {
    /// Words, whatever the lines: `line` is that of the word before `rest`.
    Text { rest: &'a [u8], line: usize },
    /// The whole file, and where we are in it.
    Binary { bytes: &'a [u8], at: usize, big: bool },
}

impl Source<'_> {
    fn place(&self) -> Place {
        match *self {
            Self::Text { line, .. } => Place::Line(line),
            Self::Binary { at, .. } => Place::Byte(at),
        }
    }

    /// The next number. A word of a text that is declared as a 32-bit float is read as one, so that text and binary
    /// files of the same mesh are equal. None at the end of the file; Err where a word is no number of its type.
    fn number(&mut self, kind: Kind) -> Option<Result<f64, String>> {
        match self {
            Self::Text { rest, line } => {
                let start = rest.iter().position(|byte| !byte.is_ascii_whitespace())?;
                *line += rest[..start].iter().filter(|&&byte| byte == b'\n').count();
                let word = &rest[start..];
                let end = word.iter().position(u8::is_ascii_whitespace).unwrap_or(word.len());
                *rest = &word[end..];
                let word = &word[..end];
                let text = || String::from_utf8_lossy(&word[..end.min(40)]).into_owned();
                Some(str::from_utf8(word).ok().and_then(|word| parsed(word, kind)).ok_or_else(text))
            }
            Self::Binary { bytes, at, big } => {
                let (number, size) = decoded(bytes, *at, kind, *big)?;
                *at += size;
                Some(Ok(number))
            }
        }
    }
}

fn parsed(word: &str, kind: Kind) -> Option<f64> {
    let word = word.strip_prefix('+').unwrap_or(word);
    match kind {
        Kind::F32 => word.parse::<f32>().ok().map(f64::from),
        Kind::F64 => word.parse().ok(),
        Kind::I8 => word.parse::<i8>().ok().map(f64::from),
        Kind::U8 => word.parse::<u8>().ok().map(f64::from),
        Kind::I16 => word.parse::<i16>().ok().map(f64::from),
        Kind::U16 => word.parse::<u16>().ok().map(f64::from),
        Kind::I32 => word.parse::<i32>().ok().map(f64::from),
        Kind::U32 => word.parse::<u32>().ok().map(f64::from),
    }
}

/// The number at a byte, and its size.
fn decoded(bytes: &[u8], at: usize, kind: Kind, big: bool) -> Option<(f64, usize)> {
    macro_rules! number {
        ($type:ty) => {{
            let bytes = bytes_at(bytes, at)?;
            let number = if big { <$type>::from_be_bytes(bytes) } else { <$type>::from_le_bytes(bytes) };
            (f64::from(number), size_of::<$type>())
        }};
    }
    Some(match kind {
        Kind::I8 => number!(i8),
        Kind::U8 => number!(u8),
        Kind::I16 => number!(i16),
        Kind::U16 => number!(u16),
        Kind::I32 => number!(i32),
        Kind::U32 => number!(u32),
        Kind::F32 => number!(f32),
        Kind::F64 => number!(f64),
    })
}

/// One row of an element.
struct Row<'r, 'a> {
    source: &'r mut Source<'a>,
    element: &'r Element,
    /// From 0.
    row: u64,
    /// As the header promises.
    n_vertices: u64,
}

impl Row<'_, '_> {
    fn number(&mut self, kind: Kind, expected: &'static str) -> Result<f64, PlyError> {
        let number = self.source.number(kind);
        let number = number.ok_or_else(|| {
            let (element, index, count) = (self.element.name.clone(), self.row, self.element.count);
            self.error(PlyFault::CutOff { element, index, count })
        })?;
        number.map_err(|text| self.error(PlyFault::NotANumber { text, expected }))
    }

    fn coordinate(&mut self, kind: Kind) -> Result<f64, PlyError> {
        let expected = "a coordinate, finite in 32 bits";
        let x = self.number(kind, expected)?;
        if fits_f32(x) { Ok(x) } else { Err(self.error(PlyFault::NotANumber { text: x.to_string(), expected })) }
    }

    /// A number of things, or of one of them.
    fn whole(&mut self, kind: Kind) -> Result<u64, PlyError> {
        let expected = "a whole number from 0 up";
        let x = self.number(kind, expected)?;
        let whole = x as u64;
        if whole as f64 == x {
            Ok(whole)
        } else {
            Err(self.error(PlyFault::NotANumber { text: x.to_string(), expected }))
        }
    }

    fn face(&mut self, count: Kind, kind: Kind, soup: &mut Soup) -> Result<(), PlyError> {
        let found = self.whole(count)?;
        if found < 3 {
            return Err(self.error(PlyFault::TooFewCorners { found }));
        }
        let size = u32::try_from(found).map_err(|_| self.error(PlyFault::TooMany))?;
        for _ in 0..size {
            let (vertex, count) = (self.whole(kind)?, self.n_vertices);
            if vertex >= count {
                return Err(self.error(PlyFault::OutOfRange { vertex, count }));
            }
            soup.corners.push(vertex as u32);
        }
        soup.face_sizes.push(size);
        Ok(())
    }

    fn pass(&mut self, property: &Property) -> Result<(), PlyError> {
        let n = property.list.map_or(Ok(1), |count| self.whole(count))?;
        for _ in 0..n {
            self.number(property.kind, "a number of the type that the header names")?;
        }
        Ok(())
    }

    fn error(&self, what: PlyFault) -> PlyError {
        PlyError { place: self.source.place(), what }
    }
}
