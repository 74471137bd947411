//! Random meshes and tags: from a shape of the cabinet by splitting faces, turning edges and taking faces away, each with
//! a seed that its name tells.
#![allow(dead_code)] // Each test file uses its part.

use std::collections::BTreeSet;

use glam::DVec3;
use londra::math::rng::Rng;
use londra::mesh::shapes::{Shape, cabinet, grid, icosahedron, octahedron, pillow, tetrahedron, torus, tube};
use londra::mesh::{DedgeMesh, FaceId, PolygonMesh, VertexId};
use londra::subdiv::{INFINITE_SHARPNESS, Tags};

#[derive(Clone, Debug)]
pub struct Sample {
    pub name: String,
    pub positions: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
}

impl Sample {
    pub fn of(shape: &Shape) -> Sample {
        let positions = shape.positions.iter().map(|p| p.as_dvec3()).collect();
        Sample { name: shape.name.clone(), positions, triangles: shape.triangles.clone() }
    }

    pub fn mesh(&self) -> DedgeMesh {
        let mesh = DedgeMesh::from_triangles(self.positions.len(), &self.triangles);
        mesh.unwrap_or_else(|e| panic!("{}: {e}", self.name))
    }

    fn is_sound(&self) -> bool {
        DedgeMesh::from_triangles(self.positions.len(), &self.triangles).is_ok()
    }

    /// Positions moved at random, so that no symmetry hides a wrong weight.
    pub fn jittered(mut self, rng: &mut Rng) -> Sample {
        for p in &mut self.positions {
            *p += DVec3::from_array([0; 3].map(|_| 0.3 * rng.unit_f64() - 0.15));
        }
        self
    }

    /// A face becomes three around a new vertex.
    fn split_face(&mut self, face: usize) {
        let [a, b, c] = self.triangles[face];
        let middle = [a, b, c].map(|v| self.positions[v as usize]).iter().sum::<DVec3>() / 3.0;
        let new = self.positions.len() as u32;
        self.positions.push(middle);
        self.triangles[face] = [a, b, new];
        self.triangles.extend([[b, c, new], [c, a, new]]);
    }

    /// An edge becomes the other diagonal of its two faces, where a mesh comes of it.
    fn flip_edge(&mut self, face: usize, side: usize) {
        let before = self.triangles.clone();
        let [a, b, c] = [0, 1, 2].map(|k| self.triangles[face][(side + k) % 3]);
        let across = self.triangles.iter().position(|t| (0..3).any(|k| (t[k], t[(k + 1) % 3]) == (b, a)));
        let Some(across) = across else { return };
        let d = self.triangles[across].into_iter().find(|v| *v != a && *v != b).expect("a third corner");
        if self.triangles.iter().any(|t| t.contains(&c) && t.contains(&d)) {
            return;
        }
        self.triangles[face] = [c, a, d];
        self.triangles[across] = [d, b, c];
        if !self.is_sound() {
            self.triangles = before;
        }
    }

    /// A face goes, where a mesh without loose vertices is left.
    fn remove_face(&mut self, face: usize) {
        let removed = self.triangles.remove(face);
        if self.triangles.is_empty() || !self.is_sound() {
            self.triangles.insert(face, removed);
        }
    }

    fn stir(mut self, rng: &mut Rng, steps: usize) -> Sample {
        for _ in 0..steps {
            let face = rng.below(self.triangles.len());
            if rng.below(3) == 0 { self.split_face(face) } else { self.flip_edge(face, rng.below(3)) }
        }
        self
    }
}

/// A mesh without boundary.
pub fn closed(seed: u64) -> Sample {
    let mut rng = Rng::new(seed);
    let bases = [tetrahedron(), octahedron(), icosahedron(), torus(5, 4)];
    let base = Sample::of(&bases[rng.below(bases.len())]);
    let steps = 4 + rng.below(30);
    Sample { name: format!("closed mesh {seed} of {}", base.name), ..base.stir(&mut rng, steps).jittered(&mut rng) }
}

/// A mesh with boundary, and often with holes.
pub fn open(seed: u64) -> Sample {
    let mut rng = Rng::new(seed);
    let bases = [icosahedron(), torus(5, 4), grid(4, 3), tube(5, 3)];
    let base = Sample::of(&bases[rng.below(bases.len())]);
    let steps = 4 + rng.below(30);
    let mut sample = base.clone().stir(&mut rng, steps);
    sample.remove_face(0);
    for _ in 0..rng.below(8) {
        sample.remove_face(rng.below(sample.triangles.len()));
    }
    Sample { name: format!("open mesh {seed} of {}", base.name), ..sample.jittered(&mut rng) }
}

/// The cabinet (without the pillow, whose children have two edges between the same two vertices) and random meshes.
pub fn all(n: u64) -> Vec<Sample> {
    let shapes = cabinet();
    let jittered = shapes.iter().filter(|s| **s != pillow()).enumerate();
    let mut samples: Vec<_> = jittered.map(|(i, s)| Sample::of(s).jittered(&mut Rng::new(i as u64))).collect();
    samples.extend((0..n).flat_map(|seed| [closed(seed), open(seed)]));
    samples
}

/// The same with some of the edges taken away: polygons of three to many corners.
pub fn polygons(seed: u64) -> (String, PolygonMesh, Vec<DVec3>) {
    let sample = if seed.is_multiple_of(2) { closed(seed) } else { open(seed) };
    let mut rng = Rng::new(seed ^ 0x9e37);
    let mut faces: Vec<Vec<u32>> = sample.triangles.iter().map(|t| t.to_vec()).collect();
    let build = |faces: &[Vec<u32>]| {
        let sizes: Vec<u32> = faces.iter().map(|f| f.len() as u32).collect();
        let mesh = PolygonMesh::from_faces(sample.positions.len(), &sizes, &faces.concat()).ok()?;
        // Two faces around a vertex are a seam, not a surface: no scheme has a rule for one.
        mesh.vertices().all(|v| mesh.is_boundary_vertex(v) || mesh.valence(v) > 2).then_some(mesh)
    };
    for _ in 0..faces.len() {
        let first = rng.below(faces.len());
        let (a, b) = (faces[first][0], faces[first][1]);
        let across = faces.iter().position(|f| (0..f.len()).any(|k| (f[k], f[(k + 1) % f.len()]) == (b, a)));
        let Some(second) = across.filter(|&second| second != first) else { continue };
        let mut joined = faces.clone();
        let start = joined[second].iter().position(|&v| v == a).expect("shared");
        joined[second].rotate_left(start);
        // a … b on the other side, then what this side has after b.
        let mut outline = joined[second].clone();
        outline.extend(&faces[first][2..]);
        joined[first] = outline;
        joined.remove(second);
        if joined.len() > 1 && build(&joined).is_some() {
            faces = joined;
        }
    }
    let mesh = build(&faces).unwrap_or_else(|| panic!("{}", sample.name));
    (format!("polygons of {}", sample.name), mesh, sample.positions)
}

/// Creases and corners, sharp for ever and not.
pub fn creases(mesh: &DedgeMesh, seed: u64) -> Tags {
    let mut rng = Rng::new(seed);
    let sharpnesses = [INFINITE_SHARPNESS, INFINITE_SHARPNESS, 0.3, 1.0, 1.5, 2.75];
    let mut tags = Tags::default();
    for _ in 0..1 + rng.below(mesh.n_faces() / 2 + 1) {
        let dedge = mesh.dedges().nth(rng.below(mesh.n_dedges())).expect("below their number");
        tags.creases.push((mesh.origin(dedge), mesh.target(dedge), sharpnesses[rng.below(sharpnesses.len())]));
    }
    for _ in 0..rng.below(3) {
        let vertex = VertexId(rng.below(mesh.n_vertices()) as u32);
        tags.corners.push((vertex, sharpnesses[rng.below(sharpnesses.len())]));
    }
    tags
}

/// Some faces, at random, but not all.
pub fn some_faces(mesh: &DedgeMesh, seed: u64) -> Vec<FaceId> {
    let mut rng = Rng::new(seed);
    let n = rng.below(mesh.n_faces().div_ceil(2));
    let faces: BTreeSet<u32> = (0..n).map(|_| rng.below(mesh.n_faces()) as u32).collect();
    faces.into_iter().map(FaceId).collect()
}
