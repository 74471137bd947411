// The head's surfaces under a portrait studio: key, fill and rim light, a sky; haired skin, wet leather, eyes.
//
// Everything is reckoned in the head's frame, where noise stays in place whatever the camera does.

@group(1) @binding(0) var shadow_map: texture_depth_2d;
@group(1) @binding(1) var shadow_sampler: sampler_comparison;
@group(1) @binding(2) var noise_block: texture_3d<f32>;
@group(1) @binding(3) var noise_sampler: sampler;

// What the run is made of. One pipeline for each, since software drivers walk through every branch they are given.
override kind: u32 = 0u;
// Leave out what costs most.
override draft: bool = false;
// Blend with what lies behind, by the skin's opacity; edges, where one looks along it, hide more.
override seen_through: bool = false;
const COAT: u32 = 0u;
const NOSE: u32 = 1u;
const LIP: u32 = 2u;
const MOUTH: u32 = 3u;
const EYE: u32 = 4u;
const CAP: u32 = 5u;
const BONE: u32 = 6u;
// And all else that is smooth and moist.
const TOOTH: u32 = 7u;

struct Vertex {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) flow: vec3<f32>,
    @location(3) colour: vec3<f32>,
    @location(4) surface: vec3<f32>,
}

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) flow: vec3<f32>,
    @location(3) colour: vec3<f32>,
    @location(4) surface: vec3<f32>,
}

@vertex
fn vertex(in: Vertex) -> Varying {
    let clip = globals.clip_from_head * vec4<f32>(in.position, 1.0);
    return Varying(clip, in.position, in.normal, in.flow, in.colour, in.surface);
}

// One point to be shaded, in the head's frame.
struct Point {
    position: vec3<f32>,
    normal: vec3<f32>,
    // Towards the camera.
    view: vec3<f32>,
    // Of the key light that arrives, 0 to 1.
    lit: f32,
    // Of the sky that is seen, 0 to 1.
    open: f32,
}

// ---- light -----------------------------------------------------------------------------------------------------

// How much of the key light reaches a place: ten comparisons on a spiral, each over four texels.
fn shadow(position: vec3<f32>, normal: vec3<f32>) -> f32 {
    let size = globals.measures.x;
    let slope = 1.0 - max(dot(normal, globals.key.xyz), 0.0);
    let place = globals.shadow_from_head * vec4<f32>(position + normal * size * (0.002 + 0.006 * slope), 1.0);
    // Under hair, too, where the strands have soft shadows.
    if draft || (kind == COAT && globals.coat.x >= 1.0) {
        return textureSampleCompareLevel(shadow_map, shadow_sampler, place.xy, place.z - 0.0025);
    }
    var sum = 0.0;
    for (var i = 0; i < 10; i++) {
        let radius = sqrt((f32(i) + 0.5) / 10.0) * 0.010;
        let angle = f32(i) * 2.39996323;
        let at = place.xy + radius * vec2<f32>(cos(angle), sin(angle));
        sum += textureSampleCompareLevel(shadow_map, shadow_sampler, at, place.z - 0.0025);
    }
    return sum / 10.0;
}

// What a mirror would show: the sky, a soft box for the key light, a narrow one for the rim.
fn studio(direction: vec3<f32>, blur: f32) -> vec3<f32> {
    let key = smoothstep(0.90 - blur, 0.985, dot(direction, globals.key.xyz));
    let fill = smoothstep(0.80 - blur, 0.99, dot(direction, globals.fill.xyz));
    let rim = smoothstep(0.90 - blur, 0.99, dot(direction, globals.rim.xyz));
    return sky(direction) + KEY * key * 1.6 + FILL * fill * 1.2 + RIM * rim * 0.6;
}

fn diffuse(p: Point, wrap: f32) -> vec3<f32> {
    let key = KEY * wrapped(p.normal, globals.key.xyz, wrap) * p.lit;
    let fill = FILL * wrapped(p.normal, globals.fill.xyz, 0.5) * p.open;
    let rim = RIM * wrapped(p.normal, globals.rim.xyz, 0.1) * 0.35 * p.open;
    return key + fill + rim + sky(p.normal) * p.open;
}

fn fresnel(cosine: f32) -> f32 {
    return 0.04 + 0.96 * pow(1.0 - clamp(cosine, 0.0, 1.0), 5.0);
}

// The lobe of Trowbridge and Reitz (1975) with the visibility term of Kelemen and Szirmay-Kalos (2001).
fn lobe(p: Point, light: vec3<f32>, roughness: f32) -> f32 {
    let half_way = unit(p.view + light, p.normal);
    let n_h = max(dot(p.normal, half_way), 0.0);
    let l_h = max(dot(light, half_way), 0.05);
    let a = roughness * roughness;
    let d = n_h * n_h * (a * a - 1.0) + 1.0;
    return max(dot(p.normal, light), 0.0) * a * a / (12.566 * d * d * l_h * l_h) * fresnel(l_h);
}

// ---- noise -----------------------------------------------------------------------------------------------------

// White noise smeared along the hair, minus its mean; about -1 to 1, four independent channels. `width` is that of a
// streak in metres. Line integral convolution after Cabral and Leedom (1993), along the tangent.
fn streaks(position: vec3<f32>, along: vec3<f32>, width: f32) -> vec4<f32> {
    if draft || globals.coat.x >= 1.0 {
        return vec4<f32>(0.0);
    }
    let scale = SKEW * (1.0 / (width * 64.0));
    var sum = vec4<f32>(0.0);
    for (var i = 0; i < 7; i++) {
        let s = (f32(i) - 3.0) * 1.45 * width;
        sum += textureSampleLevel(noise_block, noise_sampler, scale * (position + along * s), 0.0);
    }
    return (sum / 7.0 - 0.5) * 7.6;
}

// Smooth noise of blobs `width` metres across, about -1 to 1; none where strands have their own.
fn blobs(position: vec3<f32>, width: f32) -> vec4<f32> {
    if globals.coat.x >= 1.0 {
        return vec4<f32>(0.0);
    }
    let coarse = textureSampleLevel(noise_block, noise_sampler, SKEW * position / (width * 64.0), 0.0);
    let fine = textureSampleLevel(noise_block, noise_sampler, position.zxy * 2.1 / (width * 64.0), 0.0);
    return (coarse + 0.5 * fine - 0.75) * 2.6;
}

fn scrambled(cell: vec3<i32>) -> vec3<f32> {
    var h = bitcast<vec3<u32>>(cell) * vec3<u32>(1664525u, 22695477u, 1103515245u) + vec3<u32>(1013904223u);
    h.x += h.y * h.z;
    h.y += h.z * h.x;
    h.z += h.x * h.y;
    h ^= h >> vec3<u32>(16u);
    h.x += h.y * h.z;
    h.y += h.z * h.x;
    h.z += h.x * h.y;
    return vec3<f32>(h & vec3<u32>(0xffffu)) / 65535.0;
}

// Cobbles after Worley (1996): xyz points from the nearest centre outwards, w is the height, 1 on a cobble and 0 in
// the furrow between two.
fn cobbles(position: vec3<f32>) -> vec4<f32> {
    let base = floor(position);
    var first = 9.0;
    var second = 9.0;
    var outward = vec3<f32>(0.0);
    for (var i = 0; i < 27; i++) {
        let cell = base + vec3<f32>(f32(i % 3), f32((i / 3) % 3), f32(i / 9)) - 1.0;
        let offset = position - (cell + 0.15 + 0.7 * scrambled(vec3<i32>(cell)));
        let d = dot(offset, offset);
        if d < first {
            second = first;
            first = d;
            outward = offset;
        } else if d < second {
            second = d;
        }
    }
    return vec4<f32>(outward, smoothstep(0.0, 0.35, sqrt(second) - sqrt(first)));
}

// ---- surfaces --------------------------------------------------------------------------------------------------

fn coat(at: Point, colour: vec3<f32>, flow: vec3<f32>, fur: f32) -> vec3<f32> {
    var p = at;
    let size = globals.measures.x;
    let smooth_normal = p.normal;
    var along = flow - p.normal * dot(flow, p.normal);
    along = unit(along, unit(cross(p.normal, vec3<f32>(1.0, 0.0, 0.0)), vec3<f32>(0.0, 0.0, 1.0)));

    // Between strands one sees down to where it is dark; they are streak enough.
    let cover = globals.coat.x * fur;
    // Two widths of streaks; the finer one fades where a pixel spans more than it.
    let pixel = max(length(dpdx(p.position)), length(dpdy(p.position)));
    let fine_width = 0.0013 * size;
    let lock_width = 0.0042 * size;
    let clump = blobs(p.position, 0.012 * size);
    let lean = unit(along + cross(p.normal, along) * clump.x * 0.35, along);
    let fine = streaks(p.position, lean, fine_width) * (1.0 - smoothstep(0.6, 1.8, pixel / fine_width)) * (fur - cover);
    let locks = streaks(p.position, lean, lock_width) * (1.0 - smoothstep(0.6, 1.8, pixel / lock_width)) * (fur - cover);
    let mottle = blobs(p.position, 0.035 * size).y * fur;

    let sideways = cross(p.normal, lean);
    p.normal = unit(p.normal + sideways * (fine.y * 0.26 + locks.y * 0.22) + lean * (locks.z * 0.10), p.normal);
    let shade = fine.x * 0.18 + locks.x * 0.15 + mottle * 0.08;
    let albedo = colour * exp(shade) * (1.0 - 0.38 * cover);

    let facing = clamp(dot(smooth_normal, p.view), 0.0, 1.0);
    var light = albedo * diffuse(p, mix(0.2, 0.45, fur));

    // Two highlights along the hair, after Kajiya and Kay (1989) and the shifts of Scheuermann (2004).
    let half_way = unit(p.view + globals.key.xyz, p.normal);
    let first = unit(lean + smooth_normal * (0.10 + 0.05 * fine.w), lean);
    let second = unit(lean + smooth_normal * (-0.18 + 0.10 * fine.z), lean);
    let sin_first = sqrt(max(1.0 - pow(dot(first, half_way), 2.0), 0.0));
    let sin_second = sqrt(max(1.0 - pow(dot(second, half_way), 2.0), 0.0));
    let reached = p.lit * clamp(dot(smooth_normal, globals.key.xyz) * 1.5 + 0.1, 0.0, 1.0);
    let gleam = vec3<f32>(0.016) * pow(sin_first, 40.0) + (albedo * 0.20 + 0.006) * pow(sin_second, 12.0);
    light += KEY * gleam * reached * fur;

    // Tips that stand off the outline catch what comes from behind and above.
    let edge = pow(1.0 - facing, 3.0);
    let behind = RIM * max(dot(smooth_normal, globals.rim.xyz) * 0.6 + 0.4, 0.0);
    let tips = mix(albedo, vec3<f32>(1.0), 0.12) * (1.0 + 0.35 * fine.x);
    light += tips * (behind * 0.55 + sky(smooth_normal) * 0.5 + KEY * 0.12 * p.lit) * edge * (fur - cover) * p.open;
    return light;
}

// The film of moisture on bare margins, over what is below it.
fn moisture(p: Point, gloss: f32) -> vec3<f32> {
    let mirror = reflect(-p.view, p.normal);
    let film = KEY * p.lit * (lobe(p, globals.key.xyz, 0.5) * 1.5 + lobe(p, globals.key.xyz, 0.3));
    return (film + studio(mirror, 0.5) * fresnel(dot(p.view, p.normal)) * 0.6) * gloss * p.open;
}

// Moist bare skin. `grain`: cobbles a head's size; `roughness` of the film on it.
fn leather(at: Point, colour: vec3<f32>, gloss: f32, grain: f32, relief: f32, roughness: f32) -> vec3<f32> {
    var p = at;
    let smooth_normal = p.normal;
    let pixel = max(length(dpdx(p.position)), length(dpdy(p.position))) * grain / globals.measures.x;
    let seen = 1.0 - smoothstep(0.25, 0.8, pixel);
    let cobble = cobbles(p.position * grain / globals.measures.x);
    let outward = cobble.xyz - p.normal * dot(cobble.xyz, p.normal);
    p.normal = unit(p.normal + outward * relief * seen, p.normal);
    let furrow = mix(1.0, 0.55 + 0.45 * cobble.w, seen * min(relief, 1.0));
    let albedo = colour * furrow;
    var light = albedo * diffuse(p, 0.25);
    let wet = gloss * p.open;
    let broad = lobe(p, globals.key.xyz, 0.55) * 2.0;
    let sharp = lobe(p, globals.key.xyz, roughness);
    light += KEY * p.lit * wet * furrow * (broad + sharp);
    light += RIM * wet * (lobe(p, globals.rim.xyz, 0.35) + 0.5 * lobe(p, globals.rim.xyz, 0.6));
    light += FILL * wet * lobe(p, globals.fill.xyz, 0.4);
    let mirror = reflect(-p.view, unit(mix(p.normal, smooth_normal, 0.4), p.normal));
    light += studio(mirror, 0.5) * wet * furrow * fresnel(dot(p.view, p.normal)) * 0.7;
    return light;
}

fn eye(p: Point, colour: vec3<f32>) -> vec3<f32> {
    // The upper lid and its lashes keep the sky off the upper part of the ball.
    let under_lid = 1.0 - 0.55 * smoothstep(0.05, 0.75, dot(p.normal, globals.up.xyz));
    let soft = Point(p.position, p.normal, p.view, mix(0.35, 1.0, p.lit), p.open);
    var light = colour * diffuse(soft, 0.4) * under_lid;
    // Light that enters the cornea on one side glows in the iris on the other.
    let across = max(dot(p.normal, unit(p.view * 0.6 - globals.key.xyz, p.view)), 0.0);
    light += colour * KEY * 0.35 * across * across * p.lit;
    let mirror = reflect(-p.view, p.normal);
    let cosine = dot(p.view, p.normal);
    // The window that eyes mirror stands nearer to the camera than the key light, or the lid would cover it.
    let lamp = unit(globals.key.xyz + p.view * 0.75, p.view);
    let window = smoothstep(0.952, 0.968, dot(mirror, lamp));
    let second = smoothstep(0.86, 0.93, dot(mirror, globals.fill.xyz));
    light += KEY * window * 0.95 + FILL * second * 0.22;
    light += sky(mirror) * fresnel(cosine) * 1.1 * under_lid * p.open;
    return light;
}

@fragment
fn fragment(in: Varying, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    var view = globals.eye.xyz;
    if globals.eye.w > 0.5 {
        view = unit(globals.eye.xyz - in.position, vec3<f32>(0.0, 0.0, 1.0));
    }
    var normal = unit(in.normal, view);
    if !front {
        normal = -normal;
    }
    let open = 1.0 - clamp(in.surface.z, 0.0, 1.0) * 0.9;
    let point = Point(in.position, normal, view, shadow(in.position, normal), open);
    let colour = max(in.colour, vec3<f32>(0.0));
    let fur = clamp(in.surface.x, 0.0, 1.0);
    let gloss = clamp(in.surface.y, 0.0, 1.0);

    var light: vec3<f32>;
    switch kind {
        case NOSE: {
            light = leather(point, colour, max(gloss, 0.6), 310.0, 0.65, 0.24);
        }
        case LIP: {
            light = leather(point, colour, max(gloss, 0.35), 420.0, 0.35, 0.38);
        }
        case MOUTH: {
            light = leather(point, colour, max(gloss, 0.7), 180.0, 0.2, 0.22);
        }
        case EYE: {
            light = eye(point, colour);
        }
        case CAP: {
            light = colour * diffuse(point, 0.3);
        }
        case BONE, TOOTH: {
            light = colour * diffuse(point, 0.2) + moisture(point, gloss);
        }
        default: {
            light = coat(point, colour, in.flow, fur);
            // Bare or moist margins shade off into the coat.
            light += moisture(point, gloss * (1.0 - fur));
        }
    }
    var opacity = 1.0;
    if seen_through {
        let grazing = 1.0 - clamp(dot(normal, view), 0.0, 1.0);
        opacity = mix(globals.measures.w, 1.0, 0.85 * grazing * grazing * grazing);
    }
    return vec4<f32>(encoded(film(light)) * opacity, opacity);
}
