// Hair as ribbons that face the camera, grown in the vertex stage out of the skin that is drawn.
//
// A strand is bound to a triangle; place, direction and length come from the values of its corners, so hair follows every
// head without an upload; its colour is its own. Its tip fades by covering fewer samples of a pixel, which needs no order.
// What varies from hair to hair comes from its seed, what varies from lock to lock from noise in the base head's frame.

struct Style {
    // Of the breed: curl, clump, lift, wire.
    nature: vec4<f32>,
    // Gloss; part of the strands that grow; width of a hair (m); number of strands.
    measures: vec4<f32>,
}

struct Root {
    triangle: u32,
    second: f32,
    third: f32,
    seed: u32,
    // On the base head, head units: what is bound to it stays where it is whatever the shape does.
    x: f32,
    y: f32,
    z: f32,
}

@group(1) @binding(0) var<uniform> style: Style;
@group(1) @binding(1) var<storage, read> roots: array<Root>;
@group(1) @binding(2) var<storage, read> indices: array<u32>;
// Three numbers a vertex each.
@group(1) @binding(3) var<storage, read> positions: array<f32>;
@group(1) @binding(4) var<storage, read> normals: array<f32>;
@group(1) @binding(5) var<storage, read> flow: array<f32>;
// Three numbers a strand.
@group(1) @binding(6) var<storage, read> colours: array<f32>;
// Length (m), standing off, hidden.
@group(1) @binding(7) var<storage, read> growth: array<f32>;
@group(1) @binding(8) var<storage, read> comb: array<f32>;
@group(1) @binding(9) var shadow_map: texture_depth_2d;
@group(1) @binding(10) var shadow_sampler: sampler_comparison;
@group(1) @binding(11) var noise_block: texture_3d<f32>;
@group(1) @binding(12) var noise_sampler: sampler;
@group(1) @binding(13) var rim_map: texture_depth_2d;

// As in strand_pass.rs.
const POINTS: u32 = 6u;
const BATCH: u32 = 128u;

// Metres of a head unit on the default head.
const HEAD_UNIT: f32 = 0.01;
// Hair shorter than this is none, metres.
const SHORTEST: f32 = 0.0004;

struct Varying {
    @builtin(position) clip: vec4<f32>,
    @location(0) colour: vec3<f32>,
    @location(1) alpha: f32,
    @location(2) @interpolate(flat) seed: u32,
}

// A strand's own frame and habits.
struct Strand {
    root: vec3<f32>,
    normal: vec3<f32>,
    along: vec3<f32>,
    across: vec3<f32>,
    length: f32,
    lift: f32,
    // Where its curls begin, and its own wiggle, radians.
    phase: vec2<f32>,
}

fn mixed(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, root: Root) -> vec3<f32> {
    return a * (1.0 - root.second - root.third) + b * root.second + c * root.third;
}

// Smooth noise of four independent channels, about -1 to 1; `width` of a blob in metres.
fn noise(position: vec3<f32>, width: f32) -> vec4<f32> {
    let place = SKEW * position / (width * 64.0);
    return (textureSampleLevel(noise_block, noise_sampler, place, 0.0) - 0.5) * 2.6;
}

// Four numbers from 0 to 1.
fn bytes(seed: u32) -> vec4<f32> {
    return vec4<f32>((vec4<u32>(seed) >> vec4<u32>(0u, 8u, 16u, 24u)) & vec4<u32>(255u)) / 255.0;
}

// A point of a strand, `t` from 0 at the root to 1 at the tip.
fn point(s: Strand, t: f32) -> vec3<f32> {
    let wire = style.nature.w;
    var off = s.along * (0.95 * t) + s.normal * (s.lift * (t - 0.45 * t * t));
    off += s.across * (sin(t * 7.0 + s.phase.y) - sin(s.phase.y)) * 0.07 * wire;
    off *= s.length;
    off -= globals.up.xyz * (6.0 * (1.0 - 0.7 * wire) * s.length * s.length * t * t);
    // Rings whose width grows with the hair's length.
    let turns = clamp(s.length / 0.018, 0.4, 1.6);
    let turn = s.phase.x + turns * t * 6.2831853;
    let ring = style.nature.x * min(0.0055, 0.3 * s.length);
    off += (s.across * (cos(turn) - cos(s.phase.x)) + s.normal * (sin(turn) - sin(s.phase.x))) * ring;
    // What hangs lies on the head, which bends away from under it.
    let height = dot(off, s.normal);
    let aside = off - s.normal * height;
    let bend = 0.16 * globals.measures.x;
    let least = min(0.15 * s.length, 0.006) * t - min(dot(aside, aside) / (2.0 * bend), 0.7 * s.length * t);
    off += s.normal * max(least - height, 0.0);
    return s.root + off;
}

// How much of the key light reaches a strand: two comparisons, somewhere else for each hair.
fn shadow(position: vec3<f32>, random: vec4<f32>) -> f32 {
    let place = globals.shadow_from_head * vec4<f32>(position, 1.0);
    let angle = random.x * 6.2831853;
    let spread = vec2<f32>(cos(angle), sin(angle)) * 0.010 * sqrt(random.y);
    let depth = place.z - 0.003;
    let one = textureSampleCompareLevel(shadow_map, shadow_sampler, place.xy + spread, depth);
    return 0.5 * (one + textureSampleCompareLevel(shadow_map, shadow_sampler, place.xy - spread, depth));
}

fn sine(cosine: f32) -> f32 {
    return sqrt(max(1.0 - cosine * cosine, 0.0));
}

// How much of the rim light reaches a strand, and what of it comes through the skin below: see `glow` of mesh.wgsl.
struct Behind {
    lit: f32,
    through: vec3<f32>,
}

fn from_behind(place: vec3<f32>, normal: vec3<f32>) -> Behind {
    let in_map = globals.rim_from_head * vec4<f32>(place, 1.0);
    let texel = vec2<i32>(in_map.xy * vec2<f32>(textureDimensions(rim_map)));
    let depth = in_map.z - textureLoad(rim_map, texel, 0);
    let through = transmitted(depth * 1.02 * globals.measures.x) * smoothstep(-0.05, 0.6, -dot(normal, globals.rim.xyz));
    return Behind(1.0 - smoothstep(0.002, 0.007, depth), globals.rim_light.rgb * through);
}

// Light that leaves a hair towards the camera. `heading`: along the hair; `t`: from root to tip; `deep`: how low it lies
// among its neighbours, 0 to 1; `lit`: of the key light.
fn lit_hair(
    s: Strand,
    albedo: vec3<f32>,
    heading: vec3<f32>,
    view: vec3<f32>,
    t: f32,
    deep: f32,
    hidden: f32,
    lit: f32,
    behind: Behind,
    random: vec4<f32>,
) -> vec3<f32> {
    let n = unit(s.normal + heading * 0.15, s.normal);
    let key = globals.key.xyz;
    // What lies over a point of the hair, as a part of the coat, takes light away: the more the flatter the light comes in.
    let covered = (1.0 - t) * (0.30 + 0.70 * deep);
    let open = (1.0 - 0.9 * hidden) * mix(1.08, 0.42, covered);
    let reached_key = lit * exp(-0.42 * covered / max(dot(s.normal, key), 0.22)) * 1.12;
    let fibre = mix(0.85, 1.2, sine(dot(heading, key)));
    var light = globals.key_light.rgb * wrapped(n, key, 0.40) * fibre * reached_key;
    light += globals.fill_light.rgb * wrapped(n, globals.fill.xyz, 0.5) * open;
    light += globals.rim_light.rgb * wrapped(n, globals.rim.xyz, 0.1) * 0.45 * open * behind.lit;
    light += gathered(n) * open;
    light += behind.through * 0.45;
    light *= albedo;

    // Two highlights along the hair, after Kajiya and Kay (1989) and the shifts of Scheuermann (2004): one of the light
    // itself, one coloured by the hair.
    let gloss = 0.25 + 1.3 * style.measures.x;
    let half_way = unit(view + key, n);
    let first = sine(dot(unit(heading + s.normal * (0.08 + 0.10 * random.z), heading), half_way));
    let second = sine(dot(unit(heading - s.normal * (0.14 + 0.10 * random.w), heading), half_way));
    let brightness = dot(albedo, vec3<f32>(0.3, 0.6, 0.1));
    let pale = mix(0.5, 1.0, smoothstep(0.01, 0.25, brightness));
    let gleam = vec3<f32>(0.035 * pale) * pow(first, 40.0) + (albedo * 0.20 + 0.006 * pale) * pow(second, 9.0);
    let reached = reached_key * clamp(dot(s.normal, key) * 1.5 + 0.2, 0.0, 1.0) * mix(0.3, 1.0, t) * (1.0 - 0.6 * deep);
    light += globals.key_light.rgb * gleam * gloss * reached;
    let behind_half = unit(view + globals.rim.xyz, n);
    let rim_gleam = pow(sine(dot(heading, behind_half)), 24.0) * clamp(dot(s.normal, globals.rim.xyz) + 0.2, 0.0, 1.0);
    light += globals.rim_light.rgb * (0.010 * pale) * rim_gleam * gloss * behind.lit * (1.0 - hidden) * t;

    // Tips before the light shine through.
    let edge = pow(1.0 - clamp(dot(s.normal, view), 0.0, 1.0), 3.0);
    let from_rim = globals.rim_light.rgb * max(dot(s.normal, globals.rim.xyz) * 0.6 + 0.4, 0.0) * mix(0.25, 1.0, behind.lit);
    light += mix(albedo, vec3<f32>(1.0), 0.08) * (from_rim * 0.5 + globals.key_light.rgb * 0.08 * lit) * edge * t * (1.0 - hidden);
    return light;
}

// Nothing: all corners of such a strand fall together.
fn nothing() -> Varying {
    return Varying(vec4<f32>(0.0, 0.0, 2.0, 1.0), vec3<f32>(0.0), 0.0, 0u);
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) batch: u32) -> Varying {
    let number = batch * BATCH + index / (2u * POINTS);
    if number >= u32(style.measures.w) {
        return nothing();
    }
    let root = roots[number];
    let random = bytes(root.seed);
    let other = bytes(root.seed * 747796405u + 2891336453u);
    if other.x > style.measures.y {
        return nothing();
    }
    let a = indices[root.triangle * 3u] * 3u;
    let b = indices[root.triangle * 3u + 1u] * 3u;
    let c = indices[root.triangle * 3u + 2u] * 3u;
    let grown = mixed(
        vec3<f32>(growth[a], growth[a + 1u], growth[a + 2u]),
        vec3<f32>(growth[b], growth[b + 1u], growth[b + 2u]),
        vec3<f32>(growth[c], growth[c + 1u], growth[c + 2u]),
        root,
    );
    var s: Strand;
    s.length = grown.x * mix(0.55, 1.25, random.x);
    s.normal = unit(mixed(
        vec3<f32>(normals[a], normals[a + 1u], normals[a + 2u]),
        vec3<f32>(normals[b], normals[b + 1u], normals[b + 2u]),
        vec3<f32>(normals[c], normals[c + 1u], normals[c + 2u]),
        root,
    ), vec3<f32>(0.0, 1.0, 0.0));
    let skin = mixed(
        vec3<f32>(positions[a], positions[a + 1u], positions[a + 2u]),
        vec3<f32>(positions[b], positions[b + 1u], positions[b + 2u]),
        vec3<f32>(positions[c], positions[c + 1u], positions[c + 2u]),
        root,
    );
    var view = globals.eye.xyz;
    if globals.eye.w > 0.5 {
        view = unit(globals.eye.xyz - skin, vec3<f32>(0.0, 0.0, 1.0));
    }
    // The head itself hides short hair on its far side.
    let facing = dot(s.normal, view);
    if s.length < SHORTEST || facing < select(-0.25, -0.80, s.length > 0.012) {
        return nothing();
    }
    var lies = unit(mixed(
        vec3<f32>(flow[a], flow[a + 1u], flow[a + 2u]),
        vec3<f32>(flow[b], flow[b + 1u], flow[b + 2u]),
        vec3<f32>(flow[c], flow[c + 1u], flow[c + 2u]),
        root,
    ), vec3<f32>(0.0, 0.0, -1.0));
    lies += mixed(
        vec3<f32>(comb[a], comb[a + 1u], comb[a + 2u]),
        vec3<f32>(comb[b], comb[b + 1u], comb[b + 2u]),
        vec3<f32>(comb[c], comb[c + 1u], comb[c + 2u]),
        root,
    );
    let base = vec3<f32>(colours[number * 3u], colours[number * 3u + 1u], colours[number * 3u + 2u]);

    // Locks of half a centimetre on the default head, waves of three, mottles between.
    let place = vec3<f32>(root.x, root.y, root.z) * HEAD_UNIT;
    let lock = noise(place, 0.005);
    let wave = noise(place, 0.030);
    let mottle = noise(place + 0.37, 0.014);
    let signed = random * 2.0 - 1.0;
    let clump = 0.6 + 1.2 * style.nature.y;
    let wire = style.nature.w;
    let flat_flow = unit(lies - s.normal * dot(lies, s.normal), unit(cross(s.normal, vec3<f32>(1.0, 0.0, 0.0)), vec3<f32>(0.0, 0.0, 1.0)));
    let swing = 0.30 * clump * lock.x + (0.16 + 0.25 * wire) * signed.y + 0.25 * wave.x;
    s.along = unit(flat_flow + cross(s.normal, flat_flow) * swing, flat_flow);
    s.across = cross(s.normal, s.along);
    s.lift = (0.14 + 0.70 * style.nature.z) * grown.y + 0.16 * lock.y + (0.10 + 0.20 * wire) * signed.z;
    // Short hair in a hollow would not come out of the skin.
    s.lift = max(s.lift, 0.06) + 0.40 * (1.0 - smoothstep(0.0015, 0.0065, s.length));
    s.phase = vec2<f32>(mottle.z * 5.0 + 0.5 * signed.w, random.w * 6.2831853);
    s.root = skin - s.normal * min(0.0003, 0.06 * s.length);

    let corner = index % (2u * POINTS);
    let t = f32(corner >> 1u) / f32(POINTS - 1u);
    let here = point(s, t);
    let heading = unit(point(s, t + 0.04) - point(s, t - 0.04), s.along);

    // Colour.
    var albedo = base * (1.0 + 0.16 * signed.w + 0.14 * lock.w) * exp(0.24 * mottle.x);
    albedo = select(albedo, mix(albedo * 1.30, vec3<f32>(0.55), 0.025), other.y < 0.05);
    // Short hair is too thin a coat to be dark at its roots.
    albedo *= mix(mix(0.85, 0.62, smoothstep(0.002, 0.015, s.length)), 1.18, t);
    let reach = skin + s.normal * (0.004 * globals.measures.x + 0.5 * s.length * s.lift);
    let lit = shadow(reach, other);
    let behind = from_behind(reach, s.normal);
    // Strands and locks that lie lower than those beside them.
    let deep = clamp(0.45 - 0.85 * lock.y - 0.30 * signed.z, 0.0, 1.0) * clamp(s.length / 0.008, 0.35, 1.0);
    if is_made_of(CLAY) {
        albedo = CLAY_COLOUR;
    }
    var light = lit_hair(s, min(albedo, vec3<f32>(0.95)), heading, view, t, deep, clamp(grown.z, 0.0, 1.0), lit, behind, random);
    if is_made_of(INK) {
        light = vec3<f32>(0.0);
    }

    // A ribbon across the line of sight, at least a pixel wide and then the more transparent.
    let half_size = globals.viewport.xy * 0.5;
    let clip = globals.clip_from_head * vec4<f32>(here, 1.0);
    let ahead = globals.clip_from_head * vec4<f32>(here + heading * 0.001, 1.0);
    let on_screen = (ahead.xy / ahead.w - clip.xy / clip.w) * half_size;
    let direction = on_screen / max(length(on_screen), 1e-6);
    let pixels = style.measures.z * (1.0 - 0.6 * t * t) / globals.measures.y;
    let drawn = max(pixels, 1.0);
    let side = f32(corner & 1u) - 0.5;
    let offset = vec2<f32>(-direction.y, direction.x) * (side * drawn) / half_size * clip.w;
    let alpha = (1.0 - 0.65 * smoothstep(0.5, 1.0, t)) * pixels / drawn;
    return Varying(vec4<f32>(clip.xy + offset, clip.zw), encoded(film(light)), alpha, root.seed);
}

struct Fragment {
    @location(0) colour: vec4<f32>,
    @builtin(sample_mask) samples: u32,
}

// Opacity as a number of covered samples, others for other hairs: Enderton, Sintorn, Shirley and Luebke 2010, "Stochastic
// transparency". By the hair's seed and not by the pixel, so that nothing flickers when the camera moves.
@fragment
fn fragment(in: Varying) -> Fragment {
    let chance = f32((in.seed >> 9u) & 1023u) / 1024.0;
    let n = u32(clamp(in.alpha, 0.0, 1.0) * 4.0 + chance);
    let run = (1u << min(n, 4u)) - 1u;
    let turn = in.seed & 3u;
    return Fragment(vec4<f32>(in.colour, 1.0), ((run << turn) | (run >> (4u - turn))) & 15u);
}
