// What stands behind the head: two colours from the upper edge to the lower.

struct Globals {
    clip_from_head: mat4x4<f32>,
    // Texture coordinates and depth in the key light's map.
    shadow_from_head: mat4x4<f32>,
    // The eye point and 1, or the direction towards a parallel camera and 0.
    eye: vec4<f32>,
    // Unit directions towards the lights, and upwards in the world; all in the head's frame.
    key: vec4<f32>,
    fill: vec4<f32>,
    rim: vec4<f32>,
    up: vec4<f32>,
    // sRGB.
    background_top: vec4<f32>,
    background_bottom: vec4<f32>,
    // The head's size (m), a pixel at the target (m), a texel of the shadow map (part of its side), unused.
    measures: vec4<f32>,
    // Width and height in pixels, and one over each.
    viewport: vec4<f32>,
}
@group(0) @binding(0) var<uniform> globals: Globals;

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) height: f32,
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    // One triangle that covers the picture.
    let corner = vec2<f32>(f32(index & 1u) * 4.0 - 1.0, f32(index >> 1u) * 4.0 - 1.0);
    return Varying(vec4<f32>(corner, 1.0, 1.0), corner.y * 0.5 + 0.5);
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    let colour = mix(globals.background_bottom, globals.background_top, smoothstep(0.0, 1.0, in.height));
    // Less than one step of a byte, in a fixed pattern, so that a slow gradient shows no bands.
    let cell = vec2<u32>(in.clip.xy) % vec2<u32>(4u);
    let order = f32((cell.x * 7u + cell.y * 11u + (cell.x ^ cell.y) * 5u) % 16u) / 16.0 - 0.5;
    return vec4<f32>(colour.rgb + colour.a * order / 255.0, colour.a);
}
