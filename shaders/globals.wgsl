// What every shader reads, put behind each of the others: one block for a picture. See src/render/globals.rs.

// An eyeball behind its lids.
struct Eyeball {
    // In the head's frame (m), and its radius, 0 where there is no such eye.
    centre: vec4<f32>,
    // Sideways, up, the gaze; and the angle of the limbus off the gaze, to the side and upwards.
    axes: array<vec4<f32>, 3>,
    // Linear; and how much wider the pupil is than at rest, as a part of the iris' width.
    iris: vec4<f32>,
    // Two points of the opening each: directions from the centre, (x, y) / (1 + z).
    lids: array<vec4<f32>, 6>,
}

struct Globals {
    clip_from_head: mat4x4<f32>,
    // Texture coordinates and depth in the key light's map.
    shadow_from_head: mat4x4<f32>,
    // The same of the rim light.
    rim_from_head: mat4x4<f32>,
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
    // How much of the haired skin is covered by strands, 0 to 1; what surfaces are made of; exposure; how dark the head's
    // shadow on the ground is.
    coat: vec4<f32>,
    // The coat's condition: times its length, part of its hairs that are there, how much it is clipped, how wet it is.
    hair: vec4<f32>,
    // How grey it is, how much a puppy's; width of a strand (m), number of strands.
    age: vec4<f32>,
    // Light of the lamps, linear.
    key_light: vec4<f32>,
    fill_light: vec4<f32>,
    rim_light: vec4<f32>,
    // The sky's light, and how much of it a matt surface sends back: see src/render/sky.rs.
    zenith: vec4<f32>,
    horizon: vec4<f32>,
    ground: vec4<f32>,
    gathered: array<vec4<f32>, 3>,
    // The point of the ground below the head, head's frame (m), and how far the shadow reaches from it.
    floor: vec4<f32>,
    head_from_clip: mat4x4<f32>,
    eyes: array<Eyeball, 2>,
}
@group(0) @binding(0) var<uniform> globals: Globals;
