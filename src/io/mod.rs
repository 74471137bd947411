//! Mesh file formats, from and to bytes. Nothing here touches the file system.
//!
//! Every reader gives a [`Soup`]; no bytes make one panic or take more memory than a small multiple of their length.
//! Read: OBJ with subdivision tags, 3DS, STL, PLY, and glTF. Written: OBJ, PLY and binary glTF. glTF needs the cargo
//! feature `formats`.

#[cfg(feature = "formats")]
pub mod gltf;
pub mod obj;
pub mod ply;
mod soup;
pub mod stl;
pub mod three_ds;

use std::fmt;

pub use soup::{Soup, SoupError};

/// The formats there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// 3D Studio, for DOS.
    ThreeDs,
    /// Stereolithography, as text or binary.
    Stl,
    /// Polygon file format, as text or binary.
    Ply,
    /// glTF 2.0 as text.
    Gltf,
    /// glTF 2.0 as one binary file.
    Glb,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 6] = [Self::Obj, Self::ThreeDs, Self::Stl, Self::Ply, Self::Gltf, Self::Glb];

    /// What a file name ends in, in small letters and without a dot.
    pub fn extension(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::ThreeDs => "3ds",
            Self::Stl => "stl",
            Self::Ply => "ply",
            Self::Gltf => "gltf",
            Self::Glb => "glb",
        }
    }

    /// Whether [`write()`] knows it.
    pub fn is_written(self) -> bool {
        matches!(self, Self::Obj | Self::Ply | Self::Glb)
    }

    /// From what a file name ends in, without the dot, in any case.
    pub fn from_extension(extension: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|format| format.extension().eq_ignore_ascii_case(extension))
    }

    /// From how a file begins. OBJ has no mark of its own, so what is not recognised may still be OBJ.
    pub fn from_magic(bytes: &[u8]) -> Option<Self> {
        let text = bytes.trim_ascii_start();
        if bytes.starts_with(b"glTF") {
            Some(Self::Glb)
        } else if bytes.starts_with(b"ply\n") || bytes.starts_with(b"ply\r") {
            Some(Self::Ply)
        } else if stl::is_stl(bytes) {
            Some(Self::Stl)
        } else if three_ds::is_three_ds(bytes) {
            Some(Self::ThreeDs)
        } else if text.starts_with(b"{") {
            Some(Self::Gltf)
        } else {
            None
        }
    }
}

/// As a file name ends in it, in capitals.
impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Obj => "OBJ",
            Self::ThreeDs => "3DS",
            Self::Stl => "STL",
            Self::Ply => "PLY",
            Self::Gltf => "glTF",
            Self::Glb => "GLB",
        })
    }
}

/// Where in a file something is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Place {
    /// In text: the line, from 1.
    Line(usize),
    /// In binary data: the byte, from 0.
    Byte(usize),
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Line(line) => write!(f, "line {line}"),
            Self::Byte(byte) => write!(f, "byte {byte}"),
        }
    }
}

/// Why a file cannot be read.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ReadError {
    /// Of an OBJ file.
    #[error("OBJ, {0}")]
    Obj(#[from] obj::ObjError),
    /// Of a 3DS file.
    #[error("3DS, {0}")]
    ThreeDs(#[from] three_ds::ThreeDsError),
    /// Of an STL file.
    #[error("STL, {0}")]
    Stl(#[from] stl::StlError),
    /// Of a PLY file.
    #[error("PLY, {0}")]
    Ply(#[from] ply::PlyError),
    /// Of a glTF file.
    #[cfg(feature = "formats")]
    #[error("glTF, {0}")]
    Gltf(#[from] gltf::GltfError),
    /// This build was made without the format.
    #[error("this build cannot read {format}: build with the cargo feature `formats`")]
    LeftOut {
        /// The format.
        format: Format,
    },
}

/// Why a mesh cannot be written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WriteError {
    /// The mesh is inconsistent.
    #[error(transparent)]
    Soup(#[from] SoupError),
    /// Normals of another number than vertices.
    #[error("{normals} normals for {vertices} vertices: give one for each or none")]
    Normals {
        /// How many normals there are.
        normals: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// glTF holds no empty mesh.
    #[error("there is no face to write, and {format} holds no empty mesh")]
    Empty {
        /// The format.
        format: Format,
    },
    /// More than a file of the format can count.
    #[error("{bytes} bytes are more than the {} that a {format} file can have", u32::MAX)]
    TooLarge {
        /// The format.
        format: Format,
        /// Size of the file.
        bytes: usize,
    },
    /// The format is only read.
    #[error("{format} is only read: write obj, ply or glb")]
    ReadOnly {
        /// The format.
        format: Format,
    },
    /// This build was made without the format.
    #[error("this build cannot write {format}: build with the cargo feature `formats`")]
    LeftOut {
        /// The format.
        format: Format,
    },
}

/// Reads a file of a known format.
///
/// # Errors
/// What is wrong first, and where. A file without faces is no error here.
pub fn read(bytes: &[u8], format: Format) -> Result<Soup, ReadError> {
    Ok(match format {
        Format::Obj => obj::read(bytes)?,
        Format::ThreeDs => three_ds::read(bytes)?,
        Format::Stl => stl::read(bytes)?,
        Format::Ply => ply::read(bytes)?,
        #[cfg(feature = "formats")]
        Format::Gltf | Format::Glb => gltf::read(bytes)?,
        #[cfg(not(feature = "formats"))]
        Format::Gltf | Format::Glb => return Err(ReadError::LeftOut { format }),
    })
}

/// Writes a mesh. `normals`, where given, has one unit vector for each position.
///
/// Only OBJ keeps polygons with holes and tags as they are; the others leave the faces out that are tagged as holes.
///
/// # Errors
/// A mesh that is inconsistent or too large; a format that is only read.
pub fn write(soup: &Soup, normals: Option<&[[f64; 3]]>, format: Format) -> Result<Vec<u8>, WriteError> {
    match format {
        Format::Obj => obj::write(soup, normals).map(String::into_bytes),
        Format::Ply => ply::write(soup, normals),
        #[cfg(feature = "formats")]
        Format::Glb => gltf::write(soup, normals),
        #[cfg(not(feature = "formats"))]
        Format::Glb => Err(WriteError::LeftOut { format }),
        Format::ThreeDs | Format::Stl | Format::Gltf => Err(WriteError::ReadOnly { format }),
    }
}

/// What every writer asks first.
fn check(soup: &Soup, normals: Option<&[[f64; 3]]>) -> Result<(), WriteError> {
    soup.validate()?;
    let vertices = soup.positions.len();
    match normals {
        Some(normals) if normals.len() != vertices => Err(WriteError::Normals { normals: normals.len(), vertices }),
        _ => Ok(()),
    }
}

/// `N` bytes from `at` on, where there are as many.
fn bytes_at<const N: usize>(bytes: &[u8], at: usize) -> Option<[u8; N]> {
    bytes.get(at..)?.first_chunk().copied()
}
