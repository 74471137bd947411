//! Mesh file formats, from and to bytes.
