//! Subdivides a mesh: `cargo run --no-default-features --example subdivide -- [IN.obj] [LEVELS]`, OBJ to stdout.
//! Without a file it takes an icosahedron.

use std::error::Error;
use std::io::Write;

use londra::io::obj;
use londra::mesh::DedgeMesh;
use londra::mesh::shapes::icosahedron;
use londra::subdiv::{Evaluator, Plan, Scheme};

fn main() -> Result<(), Box<dyn Error>> {
    let mut arguments = std::env::args().skip(1);
    let (positions, triangles) = match arguments.next() {
        Some(path) => {
            let mesh = obj::read(&std::fs::read(&path)?)?;
            (mesh.positions, mesh.triangles)
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
    let text = obj::write(surface.positions, Some(surface.normals), surface.indices.as_chunks().0);
    std::io::stdout().lock().write_all(text.as_bytes())?;
    Ok(())
}
