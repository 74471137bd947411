//! Connectivity of triangle meshes as directed edges; no positions inside.
