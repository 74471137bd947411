//! Plans applied in double precision: the tables in order, then the limit.
#![allow(dead_code)] // Each test file uses its part.

use glam::{DVec3, Vec3};
use londra::subdiv::{DoublePlan, LimitTable};

/// Positions of the last level.
pub fn positions(plan: &DoublePlan, control: &[DVec3]) -> Vec<DVec3> {
    let mut points = control.to_vec();
    for table in &plan.tables {
        let mut finer = vec![DVec3::ZERO; table.n_rows()];
        table.apply(&points, &mut finer);
        points = finer;
    }
    points
}

/// Limit positions and unit normals (zero where there is none) of a level from its positions.
pub fn limits(table: &LimitTable<f64>, points: &[DVec3]) -> (Vec<DVec3>, Vec<DVec3>) {
    let all = tangents(table, points);
    all.iter().map(|[p, t1, t2]| (*p, t1.cross(*t2).normalize_or_zero())).unzip()
}

/// Limit position and the two tangents of each vertex.
pub fn tangents(table: &LimitTable<f64>, points: &[DVec3]) -> Vec<[DVec3; 3]> {
    let row = |row: usize| {
        let (sources, weights) = table.row(row);
        let mut sums = [DVec3::ZERO; 3];
        for (&source, weights) in sources.iter().zip(weights) {
            (0..3).for_each(|k| sums[k] += points[source as usize] * weights[k]);
        }
        sums
    };
    (0..table.n_rows()).map(row).collect()
}

pub fn single(points: &[DVec3]) -> Vec<Vec3> {
    points.iter().map(|p| p.as_vec3()).collect()
}

pub fn double(points: &[Vec3]) -> Vec<DVec3> {
    points.iter().map(|p| p.as_dvec3()).collect()
}

pub fn bounds(points: &[DVec3]) -> (DVec3, DVec3) {
    points.iter().fold((points[0], points[0]), |(low, high), &p| (low.min(p), high.max(p)))
}

/// The longest side of the box around them.
pub fn size(points: &[DVec3]) -> f64 {
    let (low, high) = bounds(points);
    (high - low).max_element()
}
