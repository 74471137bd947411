//! Mesh file formats, from and to bytes. Nothing here touches the file system.

pub mod obj;
