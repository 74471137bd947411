// Hair as ribbons that face the camera, grown in the vertex stage out of the skin that is drawn.
//
// A strand is bound to a triangle; place, direction and length come from the values of its corners, so hair follows every
// head without an upload; its colour is its own. Its tip fades by covering fewer samples of a pixel, which needs no order.
// What varies from hair to hair comes from its seed, what varies from lock to lock from noise in the base head's frame.

struct Root {
    triangle: u32,
    second: f32,
    third: f32,
    seed: u32,
    // On the base head, head units: what is bound to it stays where it is whatever the shape does.
    x: f32,
    y: f32,
    z: f32,
    // The root towards which its lock runs together.
    leader: u32,
}

// As src/coat/groom.rs has it.
struct Groom {
    growth: vec4<f32>,
    // And density.
    comb: vec4<f32>,
    nature: vec4<f32>,
    // Grey, and where hair lies on the base head.
    age: vec4<f32>,
}

@group(1) @binding(0) var<storage, read> roots: array<Root>;
@group(1) @binding(1) var<storage, read> indices: array<u32>;
// Three numbers a vertex each.
@group(1) @binding(2) var<storage, read> positions: array<f32>;
@group(1) @binding(3) var<storage, read> normals: array<f32>;
@group(1) @binding(4) var<storage, read> flow: array<f32>;
@group(1) @binding(5) var<storage, read> grooms: array<Groom>;
// Three numbers a strand.
@group(1) @binding(6) var<storage, read> colours: array<f32>;
@group(1) @binding(7) var shadow_map: texture_depth_2d;
@group(1) @binding(8) var shadow_sampler: sampler_comparison;
@group(1) @binding(9) var noise_block: texture_3d<f32>;
@group(1) @binding(10) var noise_sampler: sampler;
@group(1) @binding(11) var rim_map: texture_depth_2d;

// As in strand_pass.rs.
override points: u32 = 6u;
const BATCH: u32 = 128u;

// Metres of a head unit on the default head.
const HEAD_UNIT: f32 = 0.01;
// As in src/coat/roots.rs: how many times as dense few strands stand along the outline, and from how many on they are as
// dense all over.
const OUTLINE: f32 = 3.0;
const OUTLINE_UP_TO: f32 = 90000.0;
// From so many strands on short ones stand all over.
const BRISTLES: f32 = 9000.0;
// The farthest that a tip goes to its lock, as a part of its length.
const GATHERED: f32 = 0.45;

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
    curl: f32,
    wire: f32,
    // Where its curls begin, and its own wiggle, radians.
    phase: vec2<f32>,
    // How far its tip goes to the lock's, metres.
    gather: vec3<f32>,
}

fn mixed(a: vec3<f32>, b: vec3<f32>, c: vec3<f32>, root: Root) -> vec3<f32> {
    return a * (1.0 - root.second - root.third) + b * root.second + c * root.third;
}

fn mixed4(a: vec4<f32>, b: vec4<f32>, c: vec4<f32>, root: Root) -> vec4<f32> {
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

// The skin below a root, metres.
fn skin_at(root: Root) -> vec3<f32> {
    let a = indices[root.triangle * 3u] * 3u;
    let b = indices[root.triangle * 3u + 1u] * 3u;
    let c = indices[root.triangle * 3u + 2u] * 3u;
    let first = vec3<f32>(positions[a], positions[a + 1u], positions[a + 2u]);
    let second = vec3<f32>(positions[b], positions[b + 1u], positions[b + 2u]);
    let third = vec3<f32>(positions[c], positions[c + 1u], positions[c + 2u]);
    return first * (1.0 - root.second - root.third) + second * root.second + third * root.third;
}

// A point of a strand, `t` from 0 at the root to 1 at the tip.
fn point(s: Strand, t: f32) -> vec3<f32> {
    // A strand bends until it hangs: the sooner, the longer, softer and wetter it is. On top of the head it lies, but
    // for what is long enough to hang over the side.
    let lies = 1.0 - clamp(s.length / (0.25 * globals.measures.x), 0.0, 0.9);
    let down = s.normal * (max(dot(globals.up.xyz, s.normal), 0.0) * lies) - globals.up.xyz;
    let limp = 20.0 * s.length * (1.0 - 0.75 * s.wire) * (1.0 - 0.6 * clamp(s.lift, 0.0, 1.0)) * (1.0 + 1.5 * globals.hair.w);
    let curving = limp * length(down) + 1e-4;
    let bending = min(t, 1.0 / curving);
    let fallen = 0.5 * curving * bending * bending;
    var off = s.along * (0.95 * (bending - fallen)) + unit(down, vec3<f32>(0.0)) * (0.95 * (fallen + t - bending));
    off += s.normal * (s.lift * (t - 0.45 * t * t));
    off += s.across * (sin(t * 7.0 + s.phase.y) - sin(s.phase.y)) * 0.07 * s.wire;
    off *= s.length;
    // Rings whose width grows with the hair's length.
    let turns = clamp(s.length / 0.020, 0.4, 1.3);
    let turn = s.phase.x + turns * t * 6.2831853;
    let ring = s.curl * min(0.0055, 0.3 * s.length) * smoothstep(0.003, 0.014, s.length);
    off += (s.across * (cos(turn) - cos(s.phase.x)) + s.normal * (sin(turn) - sin(s.phase.x))) * ring;
    off += s.gather * (t * sqrt(t));
    // What hangs lies on the head, which bends away from under it.
    let height = dot(off, s.normal);
    let aside = off - s.normal * height;
    let bend = 0.16 * globals.measures.x;
    let least = min(0.15 * s.length, 0.006) * t - min(dot(aside, aside) / (2.0 * bend), 0.7 * s.length * t);
    off += s.normal * max(least - height, 0.0);
    return s.root + off;
}

// How long a strand may be that starts at `skin` and goes on in a direction, so that it ends before
// what an eye looks through.
fn clear_of_eyes(skin: vec3<f32>, heading: vec3<f32>, length_wanted: f32) -> f32 {
    var allowed = length_wanted;
    for (var e = 0u; e < 2u; e++) {
        let radius = globals.eyes[e].centre.w;
        let to = globals.eyes[e].centre.xyz + globals.eyes[e].axes[2].xyz * (1.6 * radius) - skin;
        let distance = length(to);
        let toward = dot(heading, to) / max(distance, 1e-6);
        let misses = distance * sine(toward);
        let hits = smoothstep(0.0, 0.2, toward) * (1.0 - smoothstep(1.5 * radius, 2.2 * radius, misses));
        let room = max(distance - 1.6 * radius, 0.0012);
        allowed = mix(allowed, min(allowed, room), hits);
    }
    return allowed;
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

// How much of the rim light reaches a strand, and what of it comes through the skin below: see `glow` of mesh.wgsl.
struct Behind {
    lit: f32,
    through: vec3<f32>,
}

fn from_behind(place: vec3<f32>, normal: vec3<f32>) -> Behind {
    let in_map = globals.rim_from_head * vec4<f32>(place, 1.0);
    let texel = vec2<i32>(in_map.xy * vec2<f32>(textureDimensions(rim_map)));
    let nearest = textureLoad(rim_map, texel, 0);
    let depth = in_map.z - nearest;
    // A map in which nothing is tells nothing.
    let flesh = transmitted(depth * 1.02 * globals.measures.x) * select(0.0, 1.0, nearest < 1.0);
    let through = flesh * smoothstep(-0.05, 0.6, -dot(normal, globals.rim.xyz));
    return Behind(1.0 - smoothstep(0.002, 0.007, depth), globals.rim_light.rgb * through);
}

// Nothing: all corners of such a strand fall together.
fn nothing() -> Varying {
    return Varying(vec4<f32>(0.0, 0.0, 2.0, 1.0), vec3<f32>(0.0), 0.0, 0u);
}

@vertex
fn vertex(@builtin(vertex_index) index: u32, @builtin(instance_index) batch: u32) -> Varying {
    let number = batch * BATCH + index / (2u * points);
    let n_strands = globals.age.w;
    if f32(number) >= n_strands * OUTLINE || number >= arrayLength(&roots) {
        return nothing();
    }
    let root = roots[number];
    let a = indices[root.triangle * 3u];
    let b = indices[root.triangle * 3u + 1u];
    let c = indices[root.triangle * 3u + 2u];
    var s: Strand;
    s.normal = unit(mixed(
        vec3<f32>(normals[a * 3u], normals[a * 3u + 1u], normals[a * 3u + 2u]),
        vec3<f32>(normals[b * 3u], normals[b * 3u + 1u], normals[b * 3u + 2u]),
        vec3<f32>(normals[c * 3u], normals[c * 3u + 1u], normals[c * 3u + 2u]),
        root,
    ), vec3<f32>(0.0, 1.0, 0.0));
    let skin = skin_at(root);
    var view = globals.eye.xyz;
    if globals.eye.w > 0.5 {
        view = unit(globals.eye.xyz - skin, vec3<f32>(0.0, 0.0, 1.0));
    }
    let facing = dot(s.normal, view);
    // Few strands stand closer where they are seen against what lies behind; one that is about to go shrinks first.
    let outline = clamp(OUTLINE_UP_TO / n_strands, 1.0, OUTLINE);
    let wanted = n_strands * mix(outline, 1.0, smoothstep(0.10, 0.55, abs(facing)));
    if f32(number) >= wanted {
        return nothing();
    }
    let random = bytes(root.seed);
    let other = bytes(root.seed * 747796405u + 2891336453u);
    let more = bytes(root.seed * 277803737u + 1013904223u);
    let growth = mixed4(grooms[a].growth, grooms[b].growth, grooms[c].growth, root);
    let comb = mixed4(grooms[a].comb, grooms[b].comb, grooms[c].comb, root);
    let nature = mixed4(grooms[a].nature, grooms[b].nature, grooms[c].nature, root);
    let grey = mixed4(grooms[a].age, grooms[b].age, grooms[c].age, root).x;
    let n = today(growth, comb, nature, grey);
    if other.x > n.density {
        return nothing();
    }
    // Single short hairs on skin that shows would be bristles: where there are few, only long ones stand inside.
    let long = smoothstep(0.008, 0.025, n.length);
    let inside = mix(clamp(n_strands / BRISTLES, 0.0, 1.0), 1.0, max(long, 1.0 - smoothstep(0.25, 0.6, abs(facing))));
    // One that is about to go shrinks first.
    let kept = clamp((wanted * inside - f32(number)) / (0.1 * n_strands), 0.0, 1.0);
    if kept <= 0.0 {
        return nothing();
    }
    let is_under = more.x < 0.5 * n.undercoat;
    s.length = n.length * mix(0.55, 1.25, random.x) * mix(1.0, 0.5, f32(is_under)) * kept;
    // The head itself hides short hair on its far side.
    if s.length < SHORTEST || facing < select(-0.25, -0.80, s.length > 0.012) {
        return nothing();
    }
    var lies = unit(mixed(
        vec3<f32>(flow[a * 3u], flow[a * 3u + 1u], flow[a * 3u + 2u]),
        vec3<f32>(flow[b * 3u], flow[b * 3u + 1u], flow[b * 3u + 2u]),
        vec3<f32>(flow[c * 3u], flow[c * 3u + 1u], flow[c * 3u + 2u]),
        root,
    ), vec3<f32>(0.0, 0.0, -1.0));
    lies += comb.xyz;
    var base = vec3<f32>(colours[number * 3u], colours[number * 3u + 1u], colours[number * 3u + 2u]);

    // Locks of half a centimetre on the default head, waves of three, mottles between. In locks hairs have the habits of
    // the one that leads.
    let leader = roots[root.leader];
    let own_place = vec3<f32>(root.x, root.y, root.z) * HEAD_UNIT;
    let led_place = vec3<f32>(leader.x, leader.y, leader.z) * HEAD_UNIT;
    let held = select(clamp(n.clump * mix(1.3, 0.5, more.y), 0.0, 1.0), 0.0, is_under);
    let lock = noise(mix(own_place, led_place, held), 0.005);
    let wave = noise(own_place, 0.030);
    let mottle = noise(own_place + 0.37, 0.014);
    let signed = random * 2.0 - 1.0;
    s.wire = n.wire;
    s.curl = select(n.curl, max(n.curl, 0.45), is_under);
    let loose = 1.0 - 0.7 * globals.hair.w;
    let flat_flow = unit(lies - s.normal * dot(lies, s.normal), unit(cross(s.normal, vec3<f32>(1.0, 0.0, 0.0)), vec3<f32>(0.0, 0.0, 1.0)));
    let swing = (0.18 + 0.36 * n.clump) * lock.x + (0.16 + 0.25 * n.wire) * loose * (1.0 - 0.6 * n.curl) * signed.y + 0.25 * wave.x;
    s.along = unit(flat_flow + cross(s.normal, flat_flow) * swing, flat_flow);
    s.across = cross(s.normal, s.along);
    let hangs = min(20.0 * s.length * (1.0 - 0.75 * n.wire), 1.0);
    s.length = clear_of_eyes(skin, unit(s.along - globals.up.xyz * (0.7 * hangs), s.along), s.length);
    s.lift = n.lift + 0.16 * lock.y * loose + (0.10 + 0.20 * n.wire) * loose * signed.z + select(0.0, 0.15, is_under);
    // Short hair in a hollow would not come out of the skin.
    s.lift = max(s.lift, 0.06) + 0.40 * (1.0 - smoothstep(0.0015, 0.0065, s.length)) * loose;
    // Ringlets turn together.
    let together = max(held, smoothstep(0.3, 0.8, n.curl) * (1.0 - f32(is_under)));
    let curl_phase = mix(mottle.z * 5.0, noise(led_place + 0.71, 0.006).x * 7.0, together);
    s.phase = vec2<f32>(curl_phase + mix(0.5, 0.2, together) * signed.w, random.w * 6.2831853);
    s.root = skin - s.normal * min(0.0003, 0.06 * s.length);
    let to_leader = skin_at(leader) - skin;
    let way = to_leader - s.normal * dot(to_leader, s.normal);
    s.gather = way * min(0.85 * held, GATHERED * s.length / max(length(way), 1e-5));

    let corner = index % (2u * points);
    let t = f32(corner >> 1u) / f32(points - 1u);
    let here = point(s, t);
    let heading = unit(point(s, t + 0.04) - point(s, t - 0.04), s.along);

    // Colour.
    base = select(base, woolly(base), is_under);
    base = select(base, mix(base, GREY, 0.9), other.z < n.grey);
    base = select(base, mix(base * 1.30, vec3<f32>(0.55), 0.025), other.y < 0.05);
    var albedo = dyed(base, (1.0 + 0.16 * signed.w + 0.14 * lock.w) * exp(0.24 * mottle.x), t, n);
    let reach = skin + s.normal * (0.004 * globals.measures.x + 0.5 * s.length * s.lift);
    let lit = shadow(reach, other);
    let behind = from_behind(reach, s.normal);
    // Strands and locks that lie lower than those beside them.
    var deep = clamp(0.45 - 0.85 * lock.y - 0.30 * signed.z, 0.0, 1.0) * clamp(s.length / 0.008, 0.35, 1.0);
    deep = select(deep, min(deep + 0.25, 1.0), is_under);
    if is_made_of(CLAY) {
        albedo = CLAY_COLOUR;
    }
    let gloss = select(n.gloss, 0.0, is_under);
    // A ring's near side is turned to the light, its far side away.
    let turn = s.phase.x + clamp(s.length / 0.020, 0.4, 1.3) * t * 6.2831853;
    let ringed = s.normal + (s.across * cos(turn) + s.normal * sin(turn)) * (0.55 * s.curl * s.curl);
    var light = lit_hair(unit(ringed, s.normal), albedo, heading, view, t, deep, n.hidden, gloss, lit, behind.lit, behind.through, random.zw);
    if is_made_of(INK) {
        light = vec3<f32>(0.0);
    }

    // A ribbon across the line of sight, at least a pixel wide and then the more transparent.
    let half_size = globals.viewport.xy * 0.5;
    let clip = globals.clip_from_head * vec4<f32>(here, 1.0);
    let ahead = globals.clip_from_head * vec4<f32>(here + heading * 0.001, 1.0);
    let on_screen = (ahead.xy / ahead.w - clip.xy / clip.w) * half_size;
    let direction = on_screen / max(length(on_screen), 1e-6);
    // Few long hairs are locks.
    let lock_width = mix(1.0, sqrt(clamp(25000.0 / n_strands, 1.0, 5.0)), long);
    let width = globals.age.z * lock_width * select(1.0, 1.4, is_under);
    let pixels = width * (1.0 - 0.6 * t * t) / globals.measures.y;
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
