//! Subdivides a mesh: `cargo run --no-default-features --example subdivide -- [IN.obj] [LEVELS]`, OBJ to stdout.
//! Without a file it takes an icosahedron.

use std::error::Error;
use std::io::Write;

use glam::{DVec3, Vec3};
use londra::io::{Soup, obj};
use londra::mesh::DedgeMesh;
use londra::mesh::shapes::icosahedron;
use londra::subdiv::{Evaluator, Plan, Scheme};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (positions, triangles) = match arguments.next() {
        Some(path) => {
            let soup = obj::read(&std::fs::read(&path)?)?;
            let positions = soup.positions.iter().map(|&p| DVec3::from(p).as_vec3()).collect();
            (positions, soup.triangles())
        }
        None => {
            let shape = icosahedron();
            (shape.positions, shape.triangles)
        }
    };
    let levels = arguments.next().map_or(Ok(3), |text| text.parse())?;

    // Once: connectivity, and from it the plan.
    let control = DedgeMesh::from_triangles(positions.len(), &triangles)?;
    let plan = Plan::build(&control, Scheme::Sqrt3, levels)?;
    let mut evaluator = Evaluator::new(&plan);

    // Every frame: positions in, positions and normals out.
    let surface = evaluator.evaluate(&plan, &positions);

    eprintln!("{} vertices, {} faces", plan.n_vertices(), plan.n_faces());
    let doubles = |vectors: &[Vec3]| vectors.iter().map(|v| v.as_dvec3().to_array()).collect::<Vec<_>>();
    let soup = Soup::from_triangles(doubles(surface.positions), surface.indices.as_chunks().0);
    let text = obj::write(&soup, Some(&doubles(surface.normals)))?;
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(())
}
