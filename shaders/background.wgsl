// What stands behind the head: two colours from the upper edge to the lower.

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
