// Lines of constant width: each edge is a quad that faces the camera, softened over one pixel at its sides.

struct Style {
    // sRGB and alpha.
    colour: vec4<f32>,
    // Width in pixels; shift towards the camera as a part of the head's size.
    measures: vec4<f32>,
}
@group(1) @binding(0) var<uniform> style: Style;
@group(1) @binding(1) var positions: texture_2d<f32>;

const ROW: u32 = 1024u;

struct Varying {
    @builtin(position) clip: vec4<f32>,
    // Pixels from the middle of the line.
    @location(0) across: f32,
}

fn clip_of(vertex: u32) -> vec4<f32> {
    let place = vec2<i32>(vec2<u32>(vertex % ROW, vertex / ROW));
    let position = textureLoad(positions, place, 0).xyz;
    var towards = globals.eye.xyz;
    if globals.eye.w > 0.5 {
        towards = normalize(globals.eye.xyz - position);
    }
    let nearer = position + towards * style.measures.y * globals.measures.x;
    // The place on the screen stays that of the vertex; only the depth is that of the shifted point.
    let clip = globals.clip_from_head * vec4<f32>(position, 1.0);
    let shifted = globals.clip_from_head * vec4<f32>(nearer, 1.0);
    return vec4<f32>(clip.xy, max(shifted.z / max(shifted.w, 1e-6), 0.0) * clip.w, clip.w);
}

@vertex
fn vertex(@builtin(vertex_index) corner: u32, @location(0) edge: vec2<u32>) -> Varying {
    let a = clip_of(edge.x);
    let b = clip_of(edge.y);
    let half_size = globals.viewport.xy * 0.5;
    let along = (b.xy / b.w - a.xy / a.w) * half_size;
    let direction = along / max(length(along), 1e-6);
    let sideways = vec2<f32>(-direction.y, direction.x);
    let reach = style.measures.x * 0.5 + 1.0;
    let side = f32(corner & 1u) * 2.0 - 1.0;
    var end = a;
    if corner >= 2u {
        end = b;
    }
    let offset = sideways * side * reach / half_size * end.w;
    return Varying(vec4<f32>(end.xy + offset, end.z, end.w), side * reach);
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    let coverage = clamp(style.measures.x * 0.5 + 0.5 - abs(in.across), 0.0, 1.0);
    let alpha = style.colour.a * coverage * min(style.measures.x, 1.0);
    return vec4<f32>(style.colour.rgb * alpha, alpha);
}
