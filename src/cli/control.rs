//! From a mesh file to what a plan is built from: connectivity, rest positions, tags.

use super::Failure;
use crate::app::disk;
use crate::io::{Format, Soup};
use crate::mesh::{DedgeMesh, FaceId, MeshError, PolygonMesh, VertexId};
use crate::subdiv::{Plan, PlanError, PlanOptions, Scheme, TagError, Tags};
use glam::Vec3;
use std::io::Read;
use std::path::Path;

/// A control mesh of the kind that a scheme refines.
pub(super) enum Faces {
    /// For triangle schemes.
    Triangles(DedgeMesh),
    /// For the others.
    Polygons(PolygonMesh),
}

/// A control mesh with everything that a plan and its first frame need.
pub(super) struct Control {
    pub faces: Faces,
    /// One for each vertex.
    pub positions: Vec<Vec3>,
    pub tags: Tags,
    numbers: Numbers,
}

/// For each vertex and face of a control mesh the one of the file that it comes from.
struct Numbers {
    vertices: Vec<u32>,
    faces: Vec<u32>,
}

/// Reads a mesh, from stdin where the path is `-`: by the extension, or by how the file begins.
pub(super) fn read(path: &Path) -> Result<Soup, Failure> {
    let is_stdin = path.as_os_str() == "-";
    let bytes = if is_stdin {
        let mut bytes = Vec::new();
        let read = std::io::stdin().lock().read_to_end(&mut bytes);
        read.map_err(|error| Failure::work(format!("stdin cannot be read: {error}")))?;
        bytes
    } else {
        disk::read_mesh_bytes(path)?
    };
    let by_name = path.extension().and_then(|e| e.to_str()).and_then(Format::from_extension).filter(|_| !is_stdin);
    let format = by_name.or_else(|| Format::from_magic(&bytes)).unwrap_or(Format::Obj);
    crate::io::read(&bytes, format).map_err(|error| Failure::work(format!("{}: {error}", name_of(path))))
}

/// How messages call an input.
pub(super) fn name_of(path: &Path) -> String {
    if path.as_os_str() == "-" { "stdin".into() } else { path.display().to_string() }
}

impl Control {
    /// The mesh of a file for a scheme: vertices that no face uses are left out, and for triangle schemes polygons are cut
    /// into fans, all of whose triangles are holes where the polygon is one.
    pub fn of(soup: &Soup, scheme: Scheme) -> Result<Control, MeshError> {
        let mut number = vec![u32::MAX; soup.positions.len()];
        soup.corners.iter().for_each(|&v| number[v as usize] = 0);
        let mut vertices = Vec::new();
        for (v, number) in (0..).zip(&mut number).filter(|(_, number)| **number == 0) {
            *number = vertices.len() as u32;
            vertices.push(v);
        }
        let corners: Vec<u32> = soup.corners.iter().map(|&v| number[v as usize]).collect();
        let positions: Vec<Vec3> =
            vertices.iter().map(|&v: &u32| Vec3::from_array(soup.positions[v as usize].map(|x| x as f32))).collect();

        let n_vertices = vertices.len();
        let n_faces = soup.face_sizes.len() as u32;
        let is_triangular = scheme.is_triangular();
        let faces = if is_triangular {
            (0..n_faces).zip(&soup.face_sizes).flat_map(|(f, &size)| (2..size).map(move |_| f)).collect()
        } else {
            (0..n_faces).collect()
        };
        let numbers = Numbers { vertices, faces };
        let built = if is_triangular {
            let whole = Soup { corners, face_sizes: soup.face_sizes.clone(), ..Soup::default() };
            DedgeMesh::from_triangles(n_vertices, &whole.triangles()).map(Faces::Triangles)
        } else {
            PolygonMesh::from_faces(n_vertices, &soup.face_sizes, &corners).map(Faces::Polygons)
        };
        let built = built.map_err(|error| numbers.of_mesh(error))?;

        let mut is_hole = vec![false; n_faces as usize];
        soup.holes.iter().for_each(|&f| is_hole[f as usize] = true);
        let holes = (0..).zip(&numbers.faces).filter(|(_, f)| is_hole[**f as usize]).map(|(face, _)| FaceId(face));
        let is_used = |v: u32| number[v as usize] != u32::MAX;
        let vertex = |v: u32| VertexId(number[v as usize]);
        let tags = Tags {
            creases: soup
                .creases
                .iter()
                .filter(|(a, b, _)| is_used(*a) && is_used(*b))
                .map(|&(a, b, sharpness)| (vertex(a), vertex(b), sharpness))
                .collect(),
            corners: soup
                .point_creases
                .iter()
                .filter(|(v, _)| is_used(*v))
                .map(|&(v, sharpness)| (vertex(v), sharpness))
                .collect(),
            holes: holes.collect(),
            frozen: Vec::new(),
        };
        Ok(Control { faces: built, positions, tags, numbers })
    }

    /// A mesh that is no file's.
    pub fn of_triangles(mesh: &DedgeMesh, positions: Vec<Vec3>, scheme: Scheme) -> Control {
        let numbers = Numbers { vertices: Vec::new(), faces: Vec::new() };
        let faces = if scheme.is_triangular() {
            Faces::Triangles(mesh.clone())
        } else {
            Faces::Polygons(PolygonMesh::from(mesh))
        };
        Control { faces, positions, tags: Tags::default(), numbers }
    }

    /// Reads and builds in one, with errors that name the file.
    pub fn open(path: &Path, scheme: Scheme) -> Result<Control, Failure> {
        let soup = read(path)?;
        Control::of(&soup, scheme).map_err(|error| {
            Failure::work(format!("{}: {error} (numbers count from 0 in the order of the file)", name_of(path)))
        })
    }

    /// The mesh as polygons.
    pub fn polygons(&self) -> PolygonMesh {
        match &self.faces {
            Faces::Triangles(mesh) => PolygonMesh::from(mesh),
            Faces::Polygons(mesh) => mesh.clone(),
        }
    }

    /// A plan for it.
    pub fn plan(&self, options: &PlanOptions) -> Result<Plan, PlanError> {
        match &self.faces {
            Faces::Triangles(mesh) => Plan::build_with(mesh, &self.tags, options),
            Faces::Polygons(mesh) => Plan::build_polygons(mesh, &self.tags, options),
        }
    }

    /// Why there is no plan: wrong use where the words alone say so, a failure where the mesh has a part in it.
    pub fn failure(&self, path: &Path, error: PlanError) -> Failure {
        match error {
            PlanError::NoLimits { .. } | PlanError::NotAdaptive { .. } | PlanError::NoFrozenFaces { .. } => {
                Failure::Use(error.to_string())
            }
            PlanError::Tags(error) => {
                let error = self.numbers.of_tags(error);
                Failure::work(format!("{}: {error} (numbers count from 0 in the order of the file)", name_of(path)))
            }
            _ => Failure::work(format!("{}: {error}", name_of(path))),
        }
    }
}

impl Numbers {
    fn vertex(&self, vertex: VertexId) -> VertexId {
        self.vertices.get(vertex.index()).map_or(vertex, |&v| VertexId(v))
    }

    fn face(&self, face: FaceId) -> FaceId {
        self.faces.get(face.index()).map_or(face, |&f| FaceId(f))
    }

    /// The same with the numbers of the file.
    fn of_mesh(&self, error: MeshError) -> MeshError {
        match error {
            MeshError::DegenerateTriangle { face, vertex } => {
                MeshError::DegenerateTriangle { face: self.face(face), vertex: self.vertex(vertex) }
            }
            MeshError::DuplicateDedge { first, second, from, to } => MeshError::DuplicateDedge {
                first: self.face(first),
                second: self.face(second),
                from: self.vertex(from),
                to: self.vertex(to),
            },
            MeshError::NonManifoldVertex { vertex, reached, faces } => {
                MeshError::NonManifoldVertex { vertex: self.vertex(vertex), reached, faces }
            }
            MeshError::IsolatedVertex { vertex } => MeshError::IsolatedVertex { vertex: self.vertex(vertex) },
            MeshError::TooFewCorners { face, found } => MeshError::TooFewCorners { face: self.face(face), found },
            // Of a reader's faces every corner exists and every size fits.
            error => error,
        }
    }

    /// The same with the numbers of the file.
    fn of_tags(&self, error: TagError) -> TagError {
        match error {
            TagError::NoSuchEdge { from, to } => TagError::NoSuchEdge { from: self.vertex(from), to: self.vertex(to) },
            TagError::Holes(error) => TagError::Holes(error),
            error => error,
        }
    }
}
