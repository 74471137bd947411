// A plan on the graphics card: one row of a stencil table, one normal or one limit for each invocation. The sums are those
// of `src/subdiv/kernels.rs` and `normals.rs`, in table order; a card may fuse or reorder within them.

struct Step {
    // Rows of this step, and how many invocations wide the dispatch is.
    n_rows: u32,
    width: u32,
}

@group(0) @binding(0) var<uniform> step: Step;
// For each row its first entry and its first weight; one row more at the end.
@group(0) @binding(1) var<storage, read> rows: array<vec2<u32>>;
@group(0) @binding(2) var<storage, read> sources: array<u32>;
@group(0) @binding(3) var<storage, read> weights: array<f32>;
// Three floats each.
@group(0) @binding(4) var<storage, read> coarse: array<f32>;
@group(0) @binding(5) var<storage, read_write> fine: array<f32>;

fn value(i: u32) -> vec3<f32> {
    return vec3<f32>(coarse[3u * i], coarse[3u * i + 1u], coarse[3u * i + 2u]);
}

fn put(i: u32, v: vec3<f32>) {
    fine[3u * i] = v.x;
    fine[3u * i + 1u] = v.y;
    fine[3u * i + 2u] = v.z;
}

// Scaled first: the square of a small area is no number here.
fn put_unit(i: u32, sum: vec3<f32>) {
    let largest = max(abs(sum.x), max(abs(sum.y), abs(sum.z)));
    if largest > 0.0 {
        put(i, normalize(sum / largest));
    } else {
        put(i, vec3<f32>(0.0, 1.0, 0.0));
    }
}

@compute @workgroup_size(64)
fn stencils(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = id.x + id.y * step.width;
    if row >= step.n_rows {
        return;
    }
    let first = rows[row].x;
    let n = rows[row + 1u].x - first;
    let first_weight = rows[row].y;
    var sum = value(sources[first]) * weights[first_weight];
    for (var i = 1u; i < n; i++) {
        sum += value(sources[first + i]) * weights[first_weight + i];
    }
    put(row, sum);
}

// Twice the vector area of the outline of the faces around a vertex, two sides at a time, made a unit vector.
@compute @workgroup_size(64)
fn normals(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = id.x + id.y * step.width;
    if row >= step.n_rows {
        return;
    }
    let first = rows[row].x;
    let n = rows[row + 1u].x - first;
    let corner = value(sources[first]);
    var sum = vec3<f32>(0.0);
    var i = 1u;
    while i + 2u < n {
        let a = value(sources[first + i]);
        let b = value(sources[first + i + 1u]);
        let c = value(sources[first + i + 2u]);
        sum += cross(b - corner, c - a);
        i += 2u;
    }
    if i + 1u < n {
        sum += cross(value(sources[first + i]) - corner, value(sources[first + i + 1u]) - corner);
    }
    put_unit(row, sum);
}

// Limits have three weights for each source: of the position and of two tangents.
fn total(row: u32, k: u32) -> vec3<f32> {
    let first = rows[row].x;
    let n = rows[row + 1u].x - first;
    let first_weight = rows[row].y;
    var sum = vec3<f32>(0.0);
    for (var i = 0u; i < n; i++) {
        sum += value(sources[first + i]) * weights[3u * (first_weight + i) + k];
    }
    return sum;
}

@compute @workgroup_size(64)
fn limit_positions(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = id.x + id.y * step.width;
    if row < step.n_rows {
        put(row, total(row, 0u));
    }
}

@compute @workgroup_size(64)
fn limit_normals(@builtin(global_invocation_id) id: vec3<u32>) {
    let row = id.x + id.y * step.width;
    if row < step.n_rows {
        put_unit(row, cross(total(row, 1u), total(row, 2u)));
    }
}
