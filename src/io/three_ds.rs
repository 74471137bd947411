//! 3D Studio's binary format (.3ds): the triangle meshes of it.
//!
//! After Jeff Lewis' "The Unofficial 3DStudio 3DS File Format" 1.0 and Jim Pitts' "3D Studio File Format" 0.9. A file
//! is a tree of chunks: two bytes of identifier, four of length (with these six), then data and chunks. We follow
//! main, editor, object, triangle mesh to the lists of vertices and faces; lights, cameras, materials, key frames and
//! what else there is are passed over. Vertices are in world coordinates, Z up; a mesh's own axes change nothing.
//!
//! Counts have 16 bits: an object has at most 65,535 vertices and as many faces, and a larger model is many objects.
//! Where faces differ in texture coordinates the format repeats vertices, so the vertices of an object are welded where
//! their bits are equal; those of two objects are not.

use super::soup::fits_f32;
use super::{Soup, bytes_at};

const MAIN: u16 = 0x4d4d;
const EDITOR: u16 = 0x3d3d;
const OBJECT: u16 = 0x4000;
const TRIANGLE_MESH: u16 = 0x4100;
const VERTICES: u16 = 0x4110;
const FACES: u16 = 0x4120;
/// Bytes of a chunk before its data.
const HEADER: usize = 6;

/// A mesh of a file and its name.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Object {
    /// As the file has it; what is not UTF-8 is replaced.
    pub name: String,
    /// Triangles, welded.
    pub soup: Soup,
}

/// What is wrong in a file, and where.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("byte {byte}{}: {what}", .object.as_ref().map(|name| format!(", object \"{name}\"")).unwrap_or_default())]
pub struct ThreeDsError {
    /// From 0; of a chunk its first.
    pub byte: usize,
    /// The object, where it is in one.
    pub object: Option<String>,
    /// What is wrong there.
    pub what: ThreeDsFault,
}

/// What can be wrong.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ThreeDsFault {
    /// Another start than a 3DS file has.
    #[error("not a 3DS file: it does not begin with the chunk 4D4D")]
    NotThreeDs,
    /// A chunk longer than what it stands in, or shorter than its own header.
    #[error("a chunk says that it has {length} bytes, and {room} are left: the file is cut off or damaged")]
    ChunkLength {
        /// As the chunk says.
        length: u32,
        /// What is left of the chunk around it, or of the file.
        room: usize,
    },
    /// Fewer bytes than the start of a chunk, or a list longer than its chunk.
    #[error("{needed} bytes belong here, and {room} are left: the file is cut off or damaged")]
    CutOff {
        /// How many are needed.
        needed: usize,
        /// How many there are.
        room: usize,
    },
    /// A name without its end.
    #[error("the object's name has no end")]
    EndlessName,
    /// A position that is no number.
    #[error("vertex {vertex} is not finite")]
    NotFinite {
        /// The vertex, from 0.
        vertex: usize,
    },
    /// A face of a vertex that the object does not have.
    #[error("face {face} names vertex {vertex}, and the object has {count}, counted from 0")]
    OutOfRange {
        /// The face, from 0.
        face: usize,
        /// The vertex.
        vertex: u16,
        /// How many there are.
        count: usize,
    },
    /// More vertices than 32 bits count.
    #[error("all objects together have more vertices than 32 bits count")]
    TooMany,
}

/// Whether a file looks like 3DS.
pub(super) fn is_three_ds(bytes: &[u8]) -> bool {
    Chunks::new(bytes).next().is_some_and(|chunk| chunk.is_ok_and(|chunk| chunk.id == MAIN))
}

/// Reads a file as one mesh: its objects one after another, each welded in itself.
///
/// # Errors
/// The first thing that is wrong.
pub fn read(bytes: &[u8]) -> Result<Soup, ThreeDsError> {
    let mut soup = Soup::default();
    for Object { name, soup: object } in objects(bytes)? {
        let too_many = || ThreeDsError { byte: bytes.len(), object: Some(name), what: ThreeDsFault::TooMany };
        soup.append(&object).ok_or_else(too_many)?;
    }
    Ok(soup)
}

/// Reads the objects of a file that are triangle meshes, in the order of the file.
///
/// # Errors
/// The first thing that is wrong.
pub fn objects(bytes: &[u8]) -> Result<Vec<Object>, ThreeDsError> {
    let main = Chunks::new(bytes).next().transpose()?.filter(|chunk| chunk.id == MAIN);
    let main = main.ok_or(ThreeDsError { byte: 0, object: None, what: ThreeDsFault::NotThreeDs })?;
    let mut objects = Vec::new();
    for editor in main.children(0) {
        let editor = editor?;
        if editor.id != EDITOR {
            continue;
        }
        for chunk in editor.children(0) {
            let chunk = chunk?;
            if chunk.id == OBJECT {
                objects.extend(object(chunk)?);
            }
        }
    }
    Ok(objects)
}

/// None for a light or a camera.
fn object(chunk: Chunk<'_>) -> Result<Option<Object>, ThreeDsError> {
    let end = chunk.data.iter().position(|&byte| byte == 0);
    let end = end.ok_or_else(|| chunk.error(ThreeDsFault::EndlessName))?;
    let name = String::from_utf8_lossy(&chunk.data[..end]).into_owned();
    let mut soup = Soup::default();
    let in_object = |error| ThreeDsError { object: Some(name.clone()), ..error };
    let mut is_mesh = false;
    for child in chunk.children(end + 1) {
        let child = child.map_err(in_object)?;
        if child.id == TRIANGLE_MESH {
            is_mesh = true;
            triangle_mesh(&child, &mut soup).map_err(in_object)?;
        }
    }
    soup.weld();
    Ok(is_mesh.then_some(Object { name, soup }))
}

fn triangle_mesh(chunk: &Chunk<'_>, soup: &mut Soup) -> Result<(), ThreeDsError> {
    let mut faces = None;
    for child in chunk.children(0) {
        let child = child?;
        match child.id {
            VERTICES => soup.positions = vertices(&child)?,
            FACES => faces = Some(child),
            _ => {}
        }
    }
    // Faces may stand before their vertices.
    let Some(chunk) = faces else { return Ok(()) };
    let count = soup.positions.len();
    soup.corners.clear();
    for (face, words) in chunk.list::<8>()?.iter().enumerate() {
        // Three vertices, then flags for the visibility of edges.
        for word in &words.as_chunks().0[..3] {
            let vertex = u16::from_le_bytes(*word);
            if usize::from(vertex) >= count {
                return Err(chunk.error(ThreeDsFault::OutOfRange { face, vertex, count }));
            }
            soup.corners.push(u32::from(vertex));
        }
    }
    soup.face_sizes = vec![3; soup.corners.len() / 3];
    Ok(())
}

fn vertices(chunk: &Chunk<'_>) -> Result<Vec<[f64; 3]>, ThreeDsError> {
    let list = chunk.list::<12>()?;
    let mut positions = Vec::with_capacity(list.len());
    for (vertex, bytes) in list.iter().enumerate() {
        let words = bytes.as_chunks().0;
        let position = [words[0], words[1], words[2]].map(|word| f64::from(f32::from_le_bytes(word)));
        if !position.iter().all(|&x| fits_f32(x)) {
            return Err(chunk.error(ThreeDsFault::NotFinite { vertex }));
        }
        positions.push(position);
    }
    Ok(positions)
}

/// A chunk without its header.
#[derive(Clone, Copy)]
struct Chunk<'a> {
    id: u16,
    /// Its first byte in the file.
    start: usize,
    data: &'a [u8],
}

impl<'a> Chunk<'a> {
    /// The chunks in it, after `skipped` bytes of its own data.
    fn children(&self, skipped: usize) -> Chunks<'a> {
        Chunks { at: self.start + HEADER + skipped, rest: self.data.get(skipped..).unwrap_or_default() }
    }

    /// A 16-bit count and as many items of `N` bytes.
    fn list<const N: usize>(&self) -> Result<&'a [[u8; N]], ThreeDsError> {
        let count = bytes_at(self.data, 0).map_or(0, u16::from_le_bytes);
        let needed = 2 + N * usize::from(count);
        match self.data.get(2..needed) {
            Some(list) => Ok(list.as_chunks().0),
            None => Err(self.error(ThreeDsFault::CutOff { needed, room: self.data.len() })),
        }
    }

    fn error(&self, what: ThreeDsFault) -> ThreeDsError {
        ThreeDsError { byte: self.start, object: None, what }
    }
}

/// The chunks that stand one after another in a range of the file. After an error there is none.
struct Chunks<'a> {
    /// First byte of `rest` in the file.
    at: usize,
    rest: &'a [u8],
}

impl<'a> Chunks<'a> {
    fn new(bytes: &'a [u8]) -> Self {
        Self { at: 0, rest: bytes }
    }
}

impl<'a> Iterator for Chunks<'a> {
    type Item = Result<Chunk<'a>, ThreeDsError>;

    fn next(&mut self) -> Option<Self::Item> {
        let bytes = std::mem::take(&mut self.rest);
        if bytes.is_empty() {
            return None;
        }
        let start = self.at;
        let error = |what| Some(Err(ThreeDsError { byte: start, object: None, what }));
        let room = bytes.len();
        let (Some(id), Some(length)) = (bytes_at(bytes, 0), bytes_at(bytes, 2)) else {
            return error(ThreeDsFault::CutOff { needed: HEADER, room });
        };
        let (id, length) = (u16::from_le_bytes(id), u32::from_le_bytes(length));
        let end = usize::try_from(length).unwrap_or(usize::MAX);
        let Some(data) = bytes.get(HEADER..end) else {
            return error(ThreeDsFault::ChunkLength { length, room });
        };
        self.rest = &bytes[end..];
        self.at += end;
        Some(Ok(Chunk { id, start, data }))
    }
}
