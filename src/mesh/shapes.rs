//! The cabinet: small named shapes with positions, for tests, benches and first steps.
//!
//! Each has a reason to be there: valence 2 to many, boundaries, holes, handles, several components.
//! All are counter-clockwise seen from outside, or from +Z where they are flat.

use glam::Vec3;

use crate::math::ops;
use crate::mesh::{DedgeMesh, MeshError};

/// A named triangle list with one position for each vertex.
#[derive(Clone, Debug, PartialEq)]
pub struct Shape {
    /// What it is, unique in the cabinet.
    pub name: String,
    /// One for each vertex.
    pub positions: Vec<Vec3>,
    /// Three vertex numbers each.
    pub triangles: Vec<[u32; 3]>,
}

impl Shape {
    fn new(name: impl Into<String>, positions: Vec<Vec3>, triangles: Vec<[u32; 3]>) -> Shape {
        Shape { name: name.into(), positions, triangles }
    }

    /// The connectivity.
    ///
    /// # Errors
    /// None for the shapes of this module; fields changed by hand may give any [`MeshError`].
    pub fn mesh(&self) -> Result<DedgeMesh, MeshError> {
        DedgeMesh::from_triangles(self.positions.len(), &self.triangles)
    }
}

/// Every shape of this module, for tests that walk them all.
pub fn cabinet() -> Vec<Shape> {
    let mut shapes = vec![
        tetrahedron(),
        octahedron(),
        icosahedron(),
        pillow(),
        triangle(),
        grid(4, 3),
        grid_with_hole(),
        torus(6, 5),
        tube(7, 2),
        two_components(),
    ];
    shapes.extend([3, 4, 5, 7, 12, 60].map(pole));
    shapes.extend([1, 2, 3, 6, 9].map(fan));
    shapes.extend([3, 4, 5, 6, 9].map(disk));
    shapes
}

/// Four vertices of valence 3.
pub fn tetrahedron() -> Shape {
    let positions = [[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]].map(from_ints).to_vec();
    Shape::new("tetrahedron", positions, vec![[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]])
}

/// Six vertices of valence 4.
pub fn octahedron() -> Shape {
    Shape { name: "octahedron".into(), ..pole(4) }
}

/// Twelve vertices of valence 5, at distance 1 from the origin.
pub fn icosahedron() -> Shape {
    // Two poles and two staggered rings of five at latitudes ± atan(1/2).
    let (height, radius) = (1.0 / ops::sqrt(5.0_f32), 2.0 / ops::sqrt(5.0_f32));
    let mut positions = vec![Vec3::Y];
    for (y, shift) in [(height, 0.0), (-height, 0.5)] {
        positions.extend((0..5).map(|i| on_circle(i as f32 + shift, 5.0, radius).with_y(y)));
    }
    positions.push(Vec3::NEG_Y);
    let mut triangles = Vec::new();
    for i in 0..5 {
        let (upper, upper_next) = (1 + i, 1 + (i + 1) % 5);
        let (lower, lower_next) = (6 + i, 6 + (i + 1) % 5);
        triangles.extend([[0, upper_next, upper], [upper, upper_next, lower]]);
        triangles.extend([[upper_next, lower_next, lower], [lower, lower_next, 11]]);
    }
    Shape::new("icosahedron", positions, triangles)
}

/// Two triangles back to back: closed, and every vertex has valence 2.
pub fn pillow() -> Shape {
    Shape::new("pillow", vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2], [0, 2, 1]])
}

/// One triangle: every edge a boundary.
pub fn triangle() -> Shape {
    Shape::new("triangle", vec![Vec3::ZERO, Vec3::X, Vec3::Y], vec![[0, 1, 2]])
}

/// A bipyramid: two poles of valence `n` (at least 3) and an equator of valence 4.
pub fn pole(n: u32) -> Shape {
    let n = n.max(3);
    let mut positions = vec![Vec3::Y, Vec3::NEG_Y];
    positions.extend((0..n).map(|i| on_circle(i as f32, n as f32, 1.0)));
    let mut triangles = Vec::new();
    for i in 0..n {
        let (a, b) = (2 + i, 2 + (i + 1) % n);
        triangles.extend([[0, b, a], [1, a, b]]);
    }
    Shape::new(format!("pole({n})"), positions, triangles)
}

/// `n` triangles (at least 1) around a vertex on the boundary.
pub fn fan(n: u32) -> Shape {
    let n = n.max(1);
    let mut positions = vec![Vec3::ZERO];
    positions.extend((0..=n).map(|i| upright(on_circle(i as f32, 2.0 * n as f32, 1.0))));
    let triangles = (0..n).map(|i| [0, 1 + i, 2 + i]).collect();
    Shape::new(format!("fan({n})"), positions, triangles)
}

/// `n` triangles (at least 3) around a vertex inside, with a rim of `n` boundary vertices.
pub fn disk(n: u32) -> Shape {
    let n = n.max(3);
    let mut positions = vec![Vec3::new(0.0, 0.0, 0.4)];
    positions.extend((0..n).map(|i| upright(on_circle(i as f32, n as f32, 1.0))));
    let triangles = (0..n).map(|i| [0, 1 + i, 1 + (i + 1) % n]).collect();
    Shape::new(format!("disk({n})"), positions, triangles)
}

/// `columns` × `rows` unit squares (at least 1 each), two triangles each, gently bent.
pub fn grid(columns: u32, rows: u32) -> Shape {
    let (columns, rows) = (columns.max(1), rows.max(1));
    let mut positions = Vec::new();
    for y in 0..=rows {
        for x in 0..=columns {
            positions.push(Vec3::new(x as f32, y as f32, 0.1 * (x * x) as f32 - 0.2 * y as f32));
        }
    }
    let triangles = squares(columns, rows).collect();
    Shape::new(format!("grid({columns},{rows})"), positions, triangles)
}

/// A grid of 5 × 5 squares without the one in the middle: two boundaries.
pub fn grid_with_hole() -> Shape {
    let Shape { positions, triangles, .. } = grid(5, 5);
    let middle = 2 * (2 * 5 + 2);
    let triangles =
        triangles.into_iter().enumerate().filter(|(f, _)| !(middle..middle + 2).contains(f)).map(|(_, t)| t).collect();
    Shape::new("grid_with_hole", positions, triangles)
}

/// A torus of `major` × `minor` vertices (at least 3 each), all of valence 6; radii 2 and 1.
pub fn torus(major: u32, minor: u32) -> Shape {
    let (major, minor) = (major.max(3), minor.max(3));
    let mut positions = Vec::new();
    for i in 0..minor {
        let (sine, cosine) = ops::sin_cos(std::f32::consts::TAU * i as f32 / minor as f32);
        positions.extend((0..major).map(|j| upright(on_circle(j as f32, major as f32, 2.0 + cosine)).with_z(sine)));
    }
    let triangles = wrapped_squares(major, minor, minor).collect();
    Shape::new(format!("torus({major},{minor})"), positions, triangles)
}

/// A tube with `around` vertices (at least 3) on each of `along` + 1 rings (`along` at least 1): two boundaries.
pub fn tube(around: u32, along: u32) -> Shape {
    let (around, along) = (around.max(3), along.max(1));
    let mut positions = Vec::new();
    for i in 0..=along {
        let z = i as f32;
        positions.extend((0..around).map(|j| upright(on_circle(j as f32, around as f32, 1.0)).with_z(z)));
    }
    let triangles = wrapped_squares(around, along, along + 1).collect();
    Shape::new(format!("tube({around},{along})"), positions, triangles)
}

/// A tetrahedron and, apart from it, a disk.
pub fn two_components() -> Shape {
    let (mut shape, other) = (tetrahedron(), disk(5));
    let first = shape.positions.len() as u32;
    shape.positions.extend(other.positions.into_iter().map(|p| p + Vec3::new(5.0, 0.0, 0.0)));
    shape.triangles.extend(other.triangles.into_iter().map(|t| t.map(|v| v + first)));
    Shape { name: "two_components".into(), ..shape }
}

/// Two triangles for each square of a grid with `columns + 1` vertices a row, counter-clockwise from +Z.
fn squares(columns: u32, rows: u32) -> impl Iterator<Item = [u32; 3]> {
    (0..rows).flat_map(move |y| {
        (0..columns).flat_map(move |x| {
            let v = y * (columns + 1) + x;
            [[v, v + 1, v + columns + 2], [v, v + columns + 2, v + columns + 1]]
        })
    })
}

/// Two triangles for each square of a grid that closes around, with `around` vertices a row; a row after the last of
/// `n_rows` is the first.
fn wrapped_squares(around: u32, along: u32, n_rows: u32) -> impl Iterator<Item = [u32; 3]> {
    (0..along).flat_map(move |i| {
        (0..around).flat_map(move |j| {
            let (here, onward) = (i * around, (i + 1) % n_rows * around);
            let j_next = (j + 1) % around;
            let (a, b, c, d) = (here + j, here + j_next, onward + j_next, onward + j);
            [[a, b, c], [a, c, d]]
        })
    })
}

/// Point `i` of `n` on a circle in the plane of X and Z, clockwise seen from +Y.
fn on_circle(i: f32, n: f32, radius: f32) -> Vec3 {
    let (sine, cosine) = ops::sin_cos(std::f32::consts::TAU * i / n);
    Vec3::new(radius * cosine, 0.0, radius * sine)
}

/// From the plane of X and Z into that of X and Y, counter-clockwise seen from +Z.
fn upright(p: Vec3) -> Vec3 {
    Vec3::new(p.x, p.z, p.y)
}

fn from_ints(p: [i32; 3]) -> Vec3 {
    Vec3::new(p[0] as f32, p[1] as f32, p[2] as f32)
}
