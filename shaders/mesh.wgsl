// The head's surfaces under key, fill and rim light and a sky: haired skin, wet leather, eyes, bone.
//
// Everything is reckoned in the head's frame, where noise stays in place whatever the camera does.

@group(1) @binding(0) var shadow_map: texture_depth_2d;
@group(1) @binding(1) var shadow_sampler: sampler_comparison;
@group(1) @binding(2) var noise_block: texture_3d<f32>;
@group(1) @binding(3) var noise_sampler: sampler;
@group(1) @binding(4) var rim_map: texture_depth_2d;

// What the run is made of. One pipeline for each, since software drivers walk through every branch they are given.
override kind: u32 = 0u;
// For drivers on a processor: haired skin is shaded at its vertices, which stand about as close as pixels, and lights have
// hard shadows.
override draft: bool = false;
// Blend with what lies behind, by the skin's opacity; edges, where one looks along it, hide more.
override seen_through: bool = false;
const COAT: u32 = 0u;
const NOSE: u32 = 1u;
const LIP: u32 = 2u;
const MOUTH: u32 = 3u;
const EYE: u32 = 4u;
const CAP: u32 = 5u;
// Bone, teeth, gums, third eyelids, whiskers.
const SMOOTH: u32 = 6u;
const TONGUE: u32 = 7u;
const TEARS: u32 = 8u;

struct Vertex {
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) flow: vec3<f32>,
    @location(3) colour: vec3<f32>,
    @location(4) surface: vec3<f32>,
    // Where the point lies on the base head: what is bound to it moves with the skin.
    @location(5) rest: vec3<f32>,
    // As src/coat/groom.rs has it: length, lift, hidden, gloss; comb and density; curl, clump, wire, undercoat; grey, and
    // where hair lies on the base head.
    @location(6) growth: vec4<f32>,
    @location(7) comb: vec4<f32>,
    @location(8) nature: vec4<f32>,
    @location(9) age: vec4<f32>,
}

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) position: vec3<f32>,
    @location(1) normal: vec3<f32>,
    @location(2) flow: vec3<f32>,
    @location(3) colour: vec3<f32>,
    @location(4) surface: vec3<f32>,
    @location(5) rest: vec3<f32>,
    @location(6) growth: vec4<f32>,
    @location(7) comb: vec4<f32>,
    @location(8) nature: vec4<f32>,
    @location(9) age: vec4<f32>,
    // Of haired skin in a draft: light that leaves it, as it falls on the film.
    @location(10) shaded: vec3<f32>,
}

@vertex
fn vertex(in: Vertex) -> Varying {
    let clip = globals.clip_from_head * vec4<f32>(in.position, 1.0);
    let p = in.position;
    var out =
        Varying(clip, p, in.normal, in.flow, in.colour, in.surface, in.rest, in.growth, in.comb, in.nature, in.age, vec3<f32>(0.0));
    if draft && kind == COAT {
        // A vertex stands for what lies between it and its neighbours.
        out.shaded = encoded(film(haired(point(out, true), out, VERTEX_SPACING)));
    }
    return out;
}

// Between vertices of a head that is refined four times, metres of the base head.
const VERTEX_SPACING: f32 = 0.0006;

// Where a surface is seen.
fn point(in: Varying, front: bool) -> Point {
    var view = globals.eye.xyz;
    if globals.eye.w > 0.5 {
        view = unit(globals.eye.xyz - in.position, vec3<f32>(0.0, 0.0, 1.0));
    }
    var normal = unit(in.normal, view);
    if !front {
        normal = -normal;
    }
    let open = 1.0 - clamp(in.surface.z, 0.0, 1.0) * 0.9;
    return Point(in.position, normal, view, shadow(in.position, normal), rim_shadow(in.position, normal), open);
}

// Haired skin, with what is bare or moist of it. `pixel`: metres of the base head that one value stands for.
fn haired(at: Point, in: Varying, pixel: f32) -> vec3<f32> {
    let colour = max(in.colour, vec3<f32>(0.0));
    let fur = clamp(in.surface.x, 0.0, 1.0);
    let gloss = clamp(in.surface.y, 0.0, 1.0);
    var light = coat(at, colour, in, fur, pixel);
    if is_made_of(CLAY) {
        return CLAY_COLOUR * diffuse(at, 0.15);
    }
    if is_made_of(INK) {
        return vec3<f32>(0.0);
    }
    if draft {
        return light;
    }
    // Bare or moist margins shade off into the coat.
    light += moisture(at, gloss * (1.0 - fur));
    // Hair keeps most of it to itself.
    return light + glow(at, colour) * (1.0 - 0.7 * fur);
}

// One point to be shaded, in the head's frame.
struct Point {
    position: vec3<f32>,
    normal: vec3<f32>,
    // Towards the camera.
    view: vec3<f32>,
    // Of the key light that arrives, 0 to 1, and of the rim light.
    lit: f32,
    rim: f32,
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

// How much of the rim light reaches a place.
fn rim_shadow(position: vec3<f32>, normal: vec3<f32>) -> f32 {
    // Its map is empty in a draft.
    if draft {
        return 1.0;
    }
    let slope = 1.0 - max(dot(normal, globals.rim.xyz), 0.0);
    let out = position + normal * globals.measures.x * (0.003 + 0.006 * slope);
    let place = globals.rim_from_head * vec4<f32>(out, 1.0);
    return textureSampleCompareLevel(rim_map, shadow_sampler, place.xy, place.z - 0.003);
}

// Light that shines through thin flesh from behind: through as much of it as lies between the lamp's map and the place
// (Dachsbacher and Stamminger 2003, "Translucent shadow maps").
fn glow(p: Point, colour: vec3<f32>) -> vec3<f32> {
    let depth = 1.02 * globals.measures.x;
    let by_key = globals.shadow_from_head * vec4<f32>(p.position, 1.0);
    let by_rim = globals.rim_from_head * vec4<f32>(p.position, 1.0);
    let key_texel = vec2<i32>(by_key.xy * vec2<f32>(textureDimensions(shadow_map)));
    let rim_texel = vec2<i32>(by_rim.xy * vec2<f32>(textureDimensions(rim_map)));
    let through_key = transmitted((by_key.z - textureLoad(shadow_map, key_texel, 0)) * depth + 0.0006);
    let rim_depth = textureLoad(rim_map, rim_texel, 0);
    // A map in which nothing is, as in a draft, tells nothing.
    let through_rim = transmitted((by_rim.z - rim_depth) * depth + 0.0006) * select(0.0, 1.0, rim_depth < 1.0);
    let key = globals.key_light.rgb * through_key * smoothstep(-0.05, 0.6, -dot(p.normal, globals.key.xyz));
    let rim = globals.rim_light.rgb * through_rim * smoothstep(-0.05, 0.6, -dot(p.normal, globals.rim.xyz));
    return (key + rim) * sqrt(colour) * 0.6;
}

// What a mirror would show: the sky, a soft box for the key light, a narrow one for the rim.
fn studio(direction: vec3<f32>, blur: f32) -> vec3<f32> {
    let key = smoothstep(0.90 - blur, 0.985, dot(direction, globals.key.xyz));
    let fill = smoothstep(0.80 - blur, 0.99, dot(direction, globals.fill.xyz));
    let rim = smoothstep(0.90 - blur, 0.99, dot(direction, globals.rim.xyz));
    return sky(direction) + globals.key_light.rgb * key * 1.6 + globals.fill_light.rgb * fill * 1.2 + globals.rim_light.rgb * rim * 0.6;
}

fn diffuse(p: Point, wrap: f32) -> vec3<f32> {
    let key = globals.key_light.rgb * wrapped(p.normal, globals.key.xyz, wrap) * p.lit;
    let fill = globals.fill_light.rgb * wrapped(p.normal, globals.fill.xyz, 0.5) * p.open;
    let rim = globals.rim_light.rgb * wrapped(p.normal, globals.rim.xyz, 0.1) * 0.45 * p.open * p.rim;
    return key + fill + rim + gathered(p.normal) * p.open;
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
// Curls bend the streaks into rings. `part`: of it that is wanted.
fn streaks(position: vec3<f32>, along: vec3<f32>, width: f32, curl: f32, part: f32) -> vec4<f32> {
    if part <= 0.0 {
        return vec4<f32>(0.0);
    }
    let scale = SKEW * (1.0 / (width * 64.0));
    let straight = 1.0 - 0.8 * curl;
    let aside = unit(cross(along, position), vec3<f32>(1.0, 0.0, 0.0));
    var sum = vec4<f32>(0.0);
    // A draft has the middle ones.
    for (var i = select(0, 2, draft); i < select(7, 5, draft); i++) {
        let s = (f32(i) - 3.0) * 1.45 * width;
        let turn = f32(i) * 0.9;
        let ring = (aside * sin(turn) + along * cos(turn)) * (curl * 3.0 * width);
        sum += textureSampleLevel(noise_block, noise_sampler, scale * (position + along * (s * straight) + ring), 0.0);
    }
    return (sum / select(7.0, 3.0, draft) - 0.5) * (select(7.6, 5.0, draft) * part);
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

// Haired skin without strands, or between them: streaks along the hair that are lit as strands are.
fn coat(at: Point, colour: vec3<f32>, in: Varying, fur: f32, pixel: f32) -> vec3<f32> {
    var p = at;
    let n = today(in.growth, in.comb, in.nature, in.age.x);
    let smooth_normal = p.normal;
    let lies = unit(in.flow, vec3<f32>(0.0)) + in.comb.xyz;
    var along = lies - p.normal * dot(lies, p.normal);
    along = unit(along, unit(cross(p.normal, vec3<f32>(1.0, 0.0, 0.0)), vec3<f32>(0.0, 0.0, 1.0)));
    // The same on the base head, where noise stays in its place whatever the shape does.
    let rest_along = unit(unit(in.age.yzw, vec3<f32>(0.0)) + in.comb.xyz, vec3<f32>(0.0, 0.0, 1.0));

    // Between strands one sees down to where it is dark; they are streak enough.
    let cover = globals.coat.x;
    let streaky = 1.0 - cover;
    // Two widths of streaks, wider in long hair; each fades where a pixel spans more than it.
    let long = smoothstep(0.003, 0.030, n.length);
    let fine_width = mix(0.00030, 0.00045, long);
    let lock_width = mix(0.0009, 0.0018, long);
    let clump = blobs(in.rest, 0.0036);
    let lean = unit(along + cross(p.normal, along) * clump.x * 0.35, along);
    let rest_lean = unit(rest_along + clump.xyz * (0.20 + 0.3 * n.wire), rest_along);
    var fine = vec4<f32>(0.0);
    // Vertices stand wider than these.
    if !draft {
        fine = streaks(in.rest, rest_lean, fine_width, n.curl, streaky * (1.0 - smoothstep(0.6, 1.8, pixel / fine_width)));
    }
    let locks = streaks(in.rest, rest_lean, lock_width, n.curl, streaky * (1.0 - smoothstep(0.6, 1.8, pixel / lock_width)));
    let mottle = blobs(in.rest, 0.0105).y;

    let sideways = cross(p.normal, lean);
    let bumps = mix(0.6, 1.3, long);
    p.normal = unit(p.normal + (sideways * (fine.y * 0.20 + locks.y * 0.22) + lean * (locks.z * 0.10)) * bumps, p.normal);
    // What is seen is the upper part of hairs, and between strands the lower one of others.
    let seen = mix(0.60, 0.94, long) + 0.20 * fine.x + 0.14 * locks.x;
    // Few strands hide nothing of the light.
    let dark = cover * cover;
    let t = clamp(mix(seen, mix(0.38, 0.20, long), dark), 0.0, 1.0);
    let deep = clamp(mix(mix(0.42, 0.25, long) - 0.35 * locks.y, 0.65, dark), 0.0, 1.0) * clamp(n.length / 0.008, 0.35, 1.0);
    var base = mix(colour, woolly(colour), n.undercoat * mix(0.15, 0.7, cover));
    base = mix(base, GREY, n.grey * clamp(0.9 + fine.z, 0.0, 1.0));
    let shade = exp(fine.w * 0.16 + locks.x * 0.12 + mottle * 0.10);
    let albedo = dyed(base, shade, t, n);
    let heading = unit(lean + smooth_normal * (0.25 * n.lift + 0.15 * fine.z), lean);
    let random = vec2<f32>(0.5) + fine.zw * 0.4;
    let hidden = 1.0 - p.open;
    let light = lit_hair(p.normal, albedo, heading, p.view, t, deep, hidden, n.gloss, p.lit, p.rim, vec3<f32>(0.0), random);
    return mix(colour * diffuse(p, 0.2), light, fur);
}

// The normal over a height given by its slope along the base head's axes, after Mikkelsen 2010, "Bump mapping unparametrized
// surfaces on the GPU": what is bound to the base head is carried to where the skin has gone.
fn bumped(p: Point, rest: vec3<f32>, slope: vec3<f32>) -> vec3<f32> {
    let right = dpdx(p.position);
    let down = dpdy(p.position);
    let across = cross(down, p.normal);
    let along = cross(p.normal, right);
    let area = dot(right, across);
    if abs(area) < 1e-20 {
        return p.normal;
    }
    let gradient = (dot(slope, dpdx(rest)) * across + dot(slope, dpdy(rest)) * along) / area;
    return unit(p.normal - gradient, p.normal);
}

// The film of moisture over what lies below it: a broad lobe of the skin and a sharp one of the water on it.
fn moisture(p: Point, gloss: f32) -> vec3<f32> {
    let mirror = reflect(-p.view, p.normal);
    let key = globals.key_light.rgb * p.lit;
    let film = key * (lobe(p, globals.key.xyz, 0.5) * 1.5 + lobe(p, globals.key.xyz, 0.22) * gloss);
    let rim = globals.rim_light.rgb * p.rim * lobe(p, globals.rim.xyz, 0.35) * 0.6;
    return (film + rim + studio(mirror, 0.5) * fresnel(dot(p.view, p.normal)) * 0.6) * gloss * p.open;
}

// Moist bare skin. `rest`: in cells; `relief`: of a cobble; `roughness`: of the film on it.
fn leather(at: Point, colour: vec3<f32>, gloss: f32, rest: vec3<f32>, relief: f32, roughness: f32) -> vec3<f32> {
    var p = at;
    let smooth_normal = p.normal;
    let cell = max(length(dpdx(rest)), length(dpdy(rest)));
    let seen = 1.0 - smoothstep(0.25, 0.9, cell);
    let cobble = cobbles(rest);
    // A dome on each cell, in metres of the base head where the cells are its unit.
    let metre = max(length(dpdx(p.position)), length(dpdy(p.position))) / max(cell, 1e-6);
    p.normal = bumped(p, rest, -cobble.xyz * (relief * seen * metre));
    let furrow = mix(1.0, 0.45 + 0.55 * cobble.w, seen * min(relief, 1.0));
    var light = colour * furrow * diffuse(p, 0.25);
    let wet = gloss * p.open;
    let broad = lobe(p, globals.key.xyz, 0.55) * 2.0;
    let sharp = lobe(p, globals.key.xyz, roughness);
    light += globals.key_light.rgb * p.lit * wet * furrow * (broad + sharp);
    light += globals.rim_light.rgb * p.rim * wet * (lobe(p, globals.rim.xyz, 0.35) + 0.5 * lobe(p, globals.rim.xyz, 0.6));
    light += globals.fill_light.rgb * wet * lobe(p, globals.fill.xyz, 0.4);
    let mirror = reflect(-p.view, unit(mix(p.normal, smooth_normal, 0.4), p.normal));
    light += studio(mirror, 0.5) * wet * furrow * fresnel(dot(p.view, p.normal)) * 0.7;
    return light;
}

// ---- eyes ------------------------------------------------------------------------------------------------------

// Four channels of smooth noise, 0 to 1, about one blob a unit.
fn grain(place: vec3<f32>) -> vec4<f32> {
    return textureSampleLevel(noise_block, noise_sampler, place / 64.0, 0.0);
}

// From the nearest point of the lids' opening to a place in its plane.
fn from_lids(e: u32, place: vec2<f32>) -> vec2<f32> {
    var nearest = vec2<f32>(9.0);
    var start = globals.eyes[e].lids[5].zw;
    for (var i = 0u; i < 12u; i++) {
        let pair = globals.eyes[e].lids[i / 2u];
        let end = select(pair.zw, pair.xy, i % 2u == 0u);
        let edge = end - start;
        let along = clamp(dot(place - start, edge) / max(dot(edge, edge), 1e-9), 0.0, 1.0);
        let offset = place - start - edge * along;
        if dot(offset, offset) < dot(nearest, nearest) {
            nearest = offset;
        }
        start = end;
    }
    return nearest;
}

// The iris at a place of its disk, `r` from the middle (0) to the rim (1): fibres from the collarette outwards and inwards,
// and the dark ring at the rim.
fn iris_colour(colour: vec3<f32>, place: vec2<f32>, r: f32) -> vec3<f32> {
    let turn = place / max(length(place), 1e-4);
    let wander = grain(vec3<f32>(turn * 4.0 + 7.0, r * 2.5)).x - 0.5;
    let bent = turn + vec2<f32>(-turn.y, turn.x) * wander * 0.09;
    let coarse = grain(vec3<f32>(bent * 15.0 + 20.0, r * 2.2));
    let fine = grain(vec3<f32>(bent * 36.0 + 31.0, r * 3.5));
    let collarette = PUPIL + 0.27 * (1.0 - PUPIL) + 0.10 * (grain(vec3<f32>(turn * 6.0, 3.0)).y - 0.5);
    let outer = smoothstep(collarette - 0.04, collarette + 0.03, r);
    let fibres = (coarse.x - 0.5) * 1.1 + (fine.x - 0.5) * 0.8;
    // Hollows between the fibres, where one sees down to the dark layer behind.
    let hollow = smoothstep(0.56, 0.75, coarse.z) * outer * (1.0 - smoothstep(0.75, 0.92, r));
    let ridge = exp(-pow((r - collarette) / 0.035, 2.0));
    // What is left of the sphincter: paler, and redder.
    var shade = mix(vec3<f32>(0.62, 0.54, 0.50), vec3<f32>(1.0), outer);
    shade *= 1.0 + fibres * mix(0.55, 1.0, outer) + 0.40 * ridge - 0.45 * hollow;
    shade *= 1.0 - 0.10 * smoothstep(0.35, 0.65, grain(vec3<f32>(turn * 2.0, r * 14.0)).w);
    shade *= mix(1.0, 0.16, smoothstep(0.76, 1.0, r));
    return colour * max(shade, vec3<f32>(0.05));
}

// Width of the pupil at rest as a part of the iris'.
const PUPIL: f32 = 0.37;
// Refraction of air to the fluid behind the cornea.
const FLUID: f32 = 0.749;

// The cornea's mirror: the soft box that lights the head, a weak image of the fill light, and what there is of the sky.
fn eye_mirror(p: Point, shade: f32) -> vec3<f32> {
    let mirror = reflect(-p.view, p.normal);
    // The box that eyes mirror stands nearer to the camera than the key light, or the lid would cover it.
    let lamp = unit(globals.key.xyz + p.view * 0.75, p.view);
    let right = unit(cross(globals.up.xyz, lamp), p.view);
    let up = cross(lamp, right);
    let across = vec2<f32>(dot(mirror, right), dot(mirror, up));
    let corner = abs(across) - vec2<f32>(0.10, 0.15);
    let outside = length(max(corner, vec2<f32>(0.0))) + min(max(corner.x, corner.y), 0.0) - 0.08;
    let box = smoothstep(0.035, -0.03, outside) * step(0.0, dot(mirror, lamp)) * (0.85 + 0.6 * across.y);
    let second = smoothstep(0.955, 1.0, dot(mirror, unit(globals.fill.xyz - globals.up.xyz * 0.25, p.view)));
    let lamp_light = globals.key_light.rgb * box + globals.fill_light.rgb * second * 0.22;
    let bare = 0.025 + 0.975 * pow(1.0 - clamp(dot(p.view, p.normal), 0.0, 1.0), 5.0);
    return lamp_light + sky(mirror) * (bare + 0.035) * shade;
}

// An eyeball: sclera, and behind the cornea the iris where refraction shows it.
fn eye(at: Point, colour: vec3<f32>) -> vec3<f32> {
    var p = at;
    let to_left = p.position - globals.eyes[0].centre.xyz;
    let to_right = p.position - globals.eyes[1].centre.xyz;
    let e = select(0u, 1u, dot(to_right, to_right) < dot(to_left, to_left));
    let radius = globals.eyes[e].centre.w;
    // Light that has passed the lashes' shadow is soft.
    p.lit = mix(0.3, 1.0, p.lit);
    if radius <= 0.0 {
        return colour * diffuse(p, 0.4) + eye_mirror(p, 1.0);
    }
    let own = transpose(mat3x3<f32>(globals.eyes[e].axes[0].xyz, globals.eyes[e].axes[1].xyz, globals.eyes[e].axes[2].xyz));
    let place = own * (p.position - globals.eyes[e].centre.xyz) / radius;
    let direction = unit(place, vec3<f32>(0.0, 0.0, 1.0));
    let view = own * p.view;
    let key = own * globals.key.xyz;

    // Darkness beside the lids, more below the upper one and its lashes.
    let flat_place = direction.xy / (1.0 + max(direction.z, -0.5));
    let away = from_lids(e, flat_place);
    let scale = 2000.0 * radius / (1.0 + dot(flat_place, flat_place));
    let millimetres = length(away) * scale;
    let upper = smoothstep(-0.3, 0.6, -away.y / max(length(away), 1e-5));
    var shade = (1.0 - 0.70 * exp(-millimetres / 0.55)) * (1.0 - 0.62 * upper * exp(-millimetres / 2.2));
    p.open *= shade;
    p.lit *= 1.0 - 0.75 * upper * exp(-millimetres / 1.1);

    let sin_up = direction.y * direction.y / max(dot(direction.xy, direction.xy), 1e-6);
    let limbus = mix(globals.eyes[e].axes[0].w, globals.eyes[e].axes[1].w, sin_up);
    let angle = acos(clamp(direction.z, -1.0, 1.0)) / limbus;

    // White, brown with pigment towards the cornea and reddened by vessels towards the corners.
    let vessels = grain(vec3<f32>(direction.xy * vec2<f32>(14.0, 60.0), direction.z * 9.0));
    let white = mix(vec3<f32>(0.13, 0.080, 0.062), vec3<f32>(0.62, 0.55, 0.50), smoothstep(1.0, 1.40, angle));
    let red = smoothstep(0.58, 0.72, vessels.x) * smoothstep(1.15, 1.6, angle);
    var light = white * mix(vec3<f32>(1.0), vec3<f32>(0.95, 0.55, 0.48), red) * diffuse(p, 0.4);

    let through = 1.0 - smoothstep(0.93, 1.05, angle);
    if through > 0.0 {
        let normal = own * p.normal;
        // What is seen of the iris lies where the refracted line of sight meets its plane.
        let inward = refract(-view, normal, FLUID);
        let depth = cos(limbus) + 0.05;
        let hit = place.xy + inward.xy * max((depth - place.z) / min(inward.z, -0.2), 0.0);
        let r = length(hit) / (sin(limbus) * 0.97);
        // Where the tissue that is seen there lies at rest: a wide pupil presses the iris together, a narrow one draws it out.
        let pupil = PUPIL + globals.eyes[e].iris.w;
        let outside = PUPIL + (r - pupil) * (1.0 - PUPIL) / (1.0 - pupil);
        let rim = min(select(r * PUPIL / pupil, outside, r > pupil), 1.0);
        // Light is bent towards the axis; what the cornea gathers falls on the side away from the lamp.
        let entering = clamp(key.z * 0.75 + 0.25, 0.0, 1.0) * p.lit;
        let away_from_lamp = dot(hit, -key.xy) / max(length(hit) * length(key.xy), 1e-4);
        let caustic = pow(max(away_from_lamp, 0.0), 2.0) * smoothstep(PUPIL * 0.9, 0.75, rim) * (1.0 - smoothstep(0.88, 1.0, rim));
        var inside = globals.key_light.rgb * entering * (0.34 + 1.25 * caustic);
        inside += globals.fill_light.rgb * 0.5 * p.open + gathered(p.normal) * p.open * 0.8;
        let pixel = max(length(dpdx(hit)), length(dpdy(hit)));
        let border = max(0.035, pixel);
        let open_pupil = 1.0 - smoothstep(pupil - border, pupil + border, r);
        let tissue = iris_colour(globals.eyes[e].iris.rgb, hit, rim);
        let seen = mix(tissue, vec3<f32>(0.0022, 0.0018, 0.0016), open_pupil) * inside;
        light = mix(light, seen, through);
    }
    return light + eye_mirror(p, shade) * mix(0.35, 1.0, smoothstep(0.0, 0.5, millimetres));
}

// The tongue: flesh that lets light in, with papillae of half a millimetre.
fn tongue(at: Point, colour: vec3<f32>, gloss: f32) -> vec3<f32> {
    var p = at;
    let pixel = max(length(dpdx(p.position)), length(dpdy(p.position))) * 2000.0;
    let seen = 1.0 - smoothstep(0.3, 0.9, pixel);
    let papilla = cobbles(p.position * 2000.0);
    let outward = papilla.xyz - p.normal * dot(papilla.xyz, p.normal);
    p.normal = unit(p.normal + outward * (0.5 * seen), p.normal);
    let flesh = colour * mix(1.0, 0.75 + 0.35 * papilla.w, seen);
    let soft = flesh * (diffuse(p, 0.45) + vec3<f32>(0.25, 0.05, 0.04) * globals.key_light.rgb * 0.3 * p.lit);
    return soft + moisture(p, max(gloss, 0.55));
}

// The line of tears: a thin bright rim wherever some part of its round surface mirrors the lamp.
fn tears(p: Point, colour: vec3<f32>) -> vec3<f32> {
    let half_way = unit(p.view + globals.key.xyz, p.normal);
    let e = select(0u, 1u, p.position.x < 0.0);
    let sideways = globals.eyes[e].axes[0].xyz;
    let along = unit(sideways - p.normal * dot(sideways, p.normal), p.normal);
    let across = 1.0 - pow(dot(along, half_way), 2.0);
    let glint = pow(max(across, 0.0), 60.0) * (0.3 + 0.7 * p.lit);
    return colour * diffuse(p, 0.3) * 0.7 + moisture(p, 1.0) + globals.key_light.rgb * glint * 0.55;
}

@fragment
fn fragment(in: Varying, @builtin(front_facing) front: bool) -> @location(0) vec4<f32> {
    if draft && kind == COAT && !seen_through {
        return vec4<f32>(in.shaded, 1.0);
    }
    let point = point(in, front);
    let colour = max(in.colour, vec3<f32>(0.0));
    let gloss = clamp(in.surface.y, 0.0, 1.0);

    var light: vec3<f32>;
    switch kind {
        case NOSE: {
            light = leather(point, colour, max(gloss, 0.6), in.rest * 900.0, 0.62, 0.24);
        }
        case LIP: {
            light = leather(point, colour, max(gloss, 0.35), in.rest * 1800.0, 0.25, 0.34);
        }
        case MOUTH: {
            light = leather(point, colour, max(gloss, 0.7), in.rest * 600.0, 0.15, 0.22);
        }
        case EYE: {
            light = eye(point, colour);
        }
        case CAP: {
            // The end of a neck is haired, that of a plain mesh is not.
            let hairy = haired(point, in, max(length(dpdx(in.rest)), length(dpdy(in.rest))));
            light = mix(colour * diffuse(point, 0.3), hairy, clamp(in.surface.x, 0.0, 1.0));
        }
        case SMOOTH: {
            light = colour * diffuse(point, 0.2) + moisture(point, gloss);
        }
        case TONGUE: {
            light = tongue(point, colour, gloss);
        }
        case TEARS: {
            light = tears(point, colour);
        }
        default: {
            light = haired(point, in, max(length(dpdx(in.rest)), length(dpdy(in.rest))));
        }
    }
    if is_made_of(CLAY) {
        light = CLAY_COLOUR * diffuse(point, 0.15);
    }
    if is_made_of(INK) {
        light = vec3<f32>(0.0);
    }
    var opacity = 1.0;
    if seen_through {
        let grazing = 1.0 - clamp(dot(point.normal, point.view), 0.0, 1.0);
        opacity = mix(globals.measures.w, 1.0, 0.85 * grazing * grazing * grazing);
    }
    return vec4<f32>(encoded(film(light)) * opacity, opacity);
}
