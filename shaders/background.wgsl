// What stands behind the head: two colours from the upper edge to the lower, and the head's shadow on the ground below it.

@group(1) @binding(0) var shadow_map: texture_depth_2d;
@group(1) @binding(1) var shadow_sampler: sampler_comparison;

// Cells of the picture a side, over which the shadow is smooth: as in src/render/ground_pass.rs.
const CELLS: u32 = 64u;

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) height: f32,
    @location(1) dark: f32,
}

// Of the ground's light that the head takes away, 0 to 1; soft, and none far from the head, so that no horizon is seen.
fn contact(place: vec2<f32>) -> f32 {
    let near = globals.head_from_clip * vec4<f32>(place, 0.0, 1.0);
    let far = globals.head_from_clip * vec4<f32>(place, 1.0, 1.0);
    let start = near.xyz / near.w;
    let ray = far.xyz / far.w - start;
    let up = globals.up.xyz;
    let fall = dot(ray, up);
    if fall > -1e-6 {
        return 0.0;
    }
    let at = start + ray * (dot(globals.floor.xyz - start, up) / fall);
    let away = length(at - globals.floor.xyz) / globals.floor.w;
    if away > 1.0 {
        return 0.0;
    }
    // The lamp's shadow, wider than on the head itself; what lies outside its map is lit.
    let place_in_map = globals.shadow_from_head * vec4<f32>(at, 1.0);
    var dark = 0.0;
    for (var i = 0; i < 40; i++) {
        let radius = sqrt((f32(i) + 0.5) / 40.0) * (0.03 + 0.06 * away);
        let angle = f32(i) * 2.39996323;
        let tap = place_in_map.xy + radius * vec2<f32>(cos(angle), sin(angle));
        let inside = all(tap > vec2<f32>(0.0)) && all(tap < vec2<f32>(1.0));
        let seen = textureSampleCompareLevel(shadow_map, shadow_sampler, tap, min(place_in_map.z, 0.999));
        dark += select(0.0, 1.0 - seen, inside);
    }
    // And the sky that the head covers where it is near.
    let below = exp(-12.0 * away * away);
    let fade = 1.0 - smoothstep(0.15, 1.0, away);
    return clamp(dark / 40.0 * 0.55 + below * 0.55, 0.0, 1.0) * fade;
}

@vertex
fn vertex(@builtin(vertex_index) index: u32) -> Varying {
    let cell = index / 6u;
    let corner = vec2<u32>(vec2(cell % CELLS, cell / CELLS)) + (vec2<u32>(0x1au, 0x34u) >> vec2<u32>(index % 6u)) % vec2<u32>(2u);
    let place = vec2<f32>(corner) * (2.0 / f32(CELLS)) - 1.0;
    var dark = 0.0;
    if globals.coat.w > 0.0 {
        dark = globals.coat.w * contact(place);
    }
    return Varying(vec4<f32>(place, 1.0, 1.0), place.y * 0.5 + 0.5, dark);
}

@fragment
fn fragment(in: Varying) -> @location(0) vec4<f32> {
    var colour = mix(globals.background_bottom, globals.background_top, smoothstep(0.0, 1.0, in.height));
    colour = vec4<f32>(colour.rgb * (1.0 - in.dark), colour.a);
    // Less than one step of a byte, in a fixed pattern, so that a slow gradient shows no bands.
    let cell = vec2<u32>(in.clip.xy) % vec2<u32>(4u);
    let order = f32((cell.x * 7u + cell.y * 11u + (cell.x ^ cell.y) * 5u) % 16u) / 16.0 - 0.5;
    return vec4<f32>(colour.rgb + colour.a * order / 255.0, colour.a);
}
