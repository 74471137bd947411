// What every shader reads, put behind each of the others: one block for a picture. See src/render/globals.rs.

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
    // The head's size (m), a pixel at the target (m), a texel of the shadow map (part of its side), the
    // skin's opacity.
    measures: vec4<f32>,
    // Width and height in pixels, and one over each.
    viewport: vec4<f32>,
    // How much of the haired skin is covered by strands, 0 to 1.
    coat: vec4<f32>,
}
@group(0) @binding(0) var<uniform> globals: Globals;
