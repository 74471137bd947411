//! Reference cases: one JSON file each, gzipped where it is large. `tests/oracle/README.md` says what is in them.

use std::fs;
use std::io::Read;
use std::path::{Path, PathBuf};

use glam::DVec3;
use londra::mesh::{DedgeMesh, PolygonMesh, VertexId};
use londra::subdiv::Tags;
use serde_json::Value;

pub struct Case {
    pub name: String,
    pub value: Value,
}

/// All cases of one folder, in the order of their names. An absent folder has none.
pub fn paths(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut paths: Vec<_> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    paths.sort();
    paths
}

impl Case {
    pub fn load(path: &Path) -> Case {
        let bytes = fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        let text = if path.extension().is_some_and(|e| e == "gz") {
            let mut text = Vec::new();
            flate2::read::GzDecoder::new(&bytes[..]).read_to_end(&mut text).expect("gzip");
            text
        } else {
            bytes
        };
        let value: Value = serde_json::from_slice(&text).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        Case { name: value["name"].as_str().expect("a name").to_owned(), value }
    }

    pub fn level(&self) -> u32 {
        count(&self.value["level"]) as u32
    }

    pub fn option(&self, key: &str) -> &str {
        self.value["options"][key].as_str().unwrap_or("")
    }

    pub fn control(&self) -> Vec<DVec3> {
        points(&self.value["input"]["vertices"])
    }

    pub fn control_mesh(&self) -> PolygonMesh {
        polygons(self.control().len(), &self.value["input"]["faces"])
    }

    pub fn control_triangles(&self) -> DedgeMesh {
        let faces = list(&self.value["input"]["faces"]);
        let triangles: Vec<[u32; 3]> = faces.iter().map(|f| [0, 1, 2].map(|i| count(&f[i]) as u32)).collect();
        DedgeMesh::from_triangles(self.control().len(), &triangles).expect("a manifold")
    }

    pub fn tags(&self) -> Tags {
        let input = &self.value["input"];
        let vertex = |v: &Value| VertexId(count(v) as u32);
        let sharpness = |s: &Value| s.as_f64().expect("a sharpness") as f32;
        Tags {
            creases: list(&input["creases"]).iter().map(|c| (vertex(&c[0]), vertex(&c[1]), sharpness(&c[2]))).collect(),
            corners: list(&input["corners"]).iter().map(|c| (vertex(&c[0]), sharpness(&c[1]))).collect(),
            ..Tags::default()
        }
    }

    /// Vertices of the output that follow published rules; none where all do.
    pub fn rule_checked(&self) -> Option<Vec<usize>> {
        self.value.get("rule_checked").map(|all| list(all).iter().map(count).collect())
    }
}

pub fn polygons(n_vertices: usize, faces: &Value) -> PolygonMesh {
    let faces = list(faces);
    let sizes: Vec<u32> = faces.iter().map(|f| list(f).len() as u32).collect();
    let corners: Vec<u32> = faces.iter().flat_map(|f| list(f).iter().map(|v| count(v) as u32)).collect();
    PolygonMesh::from_faces(n_vertices, &sizes, &corners).expect("a manifold")
}

pub fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

pub fn count(value: &Value) -> usize {
    value.as_u64().expect("a count") as usize
}

pub fn points(value: &Value) -> Vec<DVec3> {
    let number = |p: &Value, i: usize| p[i].as_f64().expect("a coordinate");
    list(value).iter().map(|p| DVec3::new(number(p, 0), number(p, 1), number(p, 2))).collect()
}
