// What strands and streaked skin share, put behind both: hair as it is today and the light it sends back. So a head has the same colour and brightness however many strands there are.

// To which hair is clipped, metres: as CLIPPED of src/coat/condition.rs.
const CLIPPED: f32 = 0.004;

// Hair of a place, its condition included. Of the head; see src/coat/groom.rs.
struct Nature {
    // Metres.
    length: f32,
    lift: f32,
    curl: f32,
    clump: f32,
    wire: f32,
    gloss: f32,
    // Part of the strands that grow, and of those the part that is undercoat.
    density: f32,
    undercoat: f32,
    // How deep the place is hidden, and part of the hairs that are white; 0 to 1.
    hidden: f32,
    grey: f32,
}

// The four groups of numbers of a groom, the fourth as its first number alone.
fn today(growth: vec4<f32>, comb: vec4<f32>, nature: vec4<f32>, grey: f32) -> Nature {
    let wet = globals.hair.w;
    let puppy = globals.age.y;
    var n: Nature;
    let grown = growth.x * globals.hair.x;
    let young = mix(grown, min(grown, 0.005 + 0.2 * grown), puppy);
    n.length = mix(young, min(young, CLIPPED), globals.hair.z);
    n.lift = (growth.y + 0.12 * puppy) * (1.0 - 0.75 * wet);
    n.curl = min(nature.x + 0.25 * puppy, 1.0) * (1.0 - 0.5 * wet);
    n.clump = mix(nature.y * (1.0 - 0.5 * puppy), 1.0, wet);
    n.wire = nature.z * (1.0 - 0.8 * puppy) * (1.0 - 0.8 * wet);
    n.gloss = mix(growth.w * (1.0 - 0.6 * puppy), 1.2, wet);
    n.density = comb.w * globals.hair.y;
    n.undercoat = max(nature.w, 0.5 * puppy) * (1.0 - 0.8 * wet);
    n.hidden = clamp(growth.z, 0.0, 1.0);
    n.grey = clamp(grey * globals.age.x * 1.1, 0.0, 0.97);
    return n;
}

fn sine(cosine: f32) -> f32 {
    return sqrt(max(1.0 - cosine * cosine, 0.0));
}

// Colour of a hair from root (`t` 0) to tip. `shade`: what varies from hair to hair and place to place.
fn dyed(base: vec3<f32>, shade: f32, t: f32, n: Nature) -> vec3<f32> {
    // Short hair is too thin a coat to be dark at its roots.
    let albedo = base * shade * mix(mix(0.85, 0.62, smoothstep(0.002, 0.015, n.length)), 1.18, t);
    // Water fills what scatters light between hairs.
    let soaked = albedo * mix(vec3<f32>(0.40), vec3<f32>(0.62), albedo);
    return min(mix(albedo, soaked, globals.hair.w), vec3<f32>(0.95));
}

// The colour of undercoat below hair of a colour: paler and duller.
fn woolly(base: vec3<f32>) -> vec3<f32> {
    let brightness = dot(base, vec3<f32>(0.3, 0.6, 0.1));
    return mix(base, vec3<f32>(1.0, 0.97, 0.92) * (brightness * 1.05 + 0.015), 0.4);
}

// White without its pigment, linear.
const GREY: vec3<f32> = vec3<f32>(0.66, 0.64, 0.60);

// Light that leaves a hair towards the camera. `skin`: the normal below it; `heading`: along the hair; `t`: from root to
// tip; `deep`: how low it lies among its neighbours, 0 to 1; `lit` and `rim`: of the key light and the rim light; `through`:
// light that comes through the skin.
fn lit_hair(
    skin: vec3<f32>,
    albedo: vec3<f32>,
    heading: vec3<f32>,
    view: vec3<f32>,
    t: f32,
    deep: f32,
    hidden: f32,
    gloss: f32,
    lit: f32,
    rim: f32,
    through: vec3<f32>,
    random: vec2<f32>,
) -> vec3<f32> {
    let n = unit(skin + heading * 0.15, skin);
    let key = globals.key.xyz;
    // What lies over a point of the hair, as a part of the coat, takes light away: the more the flatter the light comes in.
    let covered = (1.0 - t) * (0.30 + 0.70 * deep);
    let open = (1.0 - 0.9 * hidden) * mix(1.08, 0.42, covered);
    let reached_key = lit * exp(-0.42 * covered / max(dot(skin, key), 0.22)) * 1.12;
    let fibre = mix(0.85, 1.2, sine(dot(heading, key)));
    var light = globals.key_light.rgb * wrapped(n, key, 0.40) * fibre * reached_key;
    light += globals.fill_light.rgb * wrapped(n, globals.fill.xyz, 0.5) * open;
    light += globals.rim_light.rgb * wrapped(n, globals.rim.xyz, 0.1) * 0.45 * open * rim;
    light += gathered(n) * open;
    light += through * 0.45;
    light *= albedo;

    // Two highlights along the hair, after Kajiya and Kay (1989) and the shifts of Scheuermann (2004): one of the light
    // itself, one coloured by the hair.
    let shine = 0.25 + 1.3 * gloss;
    let half_way = unit(view + key, n);
    let first = sine(dot(unit(heading + skin * (0.08 + 0.10 * random.x), heading), half_way));
    let second = sine(dot(unit(heading - skin * (0.14 + 0.10 * random.y), heading), half_way));
    let brightness = dot(albedo, vec3<f32>(0.3, 0.6, 0.1));
    let pale = mix(0.5, 1.0, smoothstep(0.01, 0.25, brightness));
    let gleam = vec3<f32>(0.035 * pale) * pow(first, 40.0) + (albedo * 0.20 + 0.006 * pale) * pow(second, 9.0);
    let reached = reached_key * clamp(dot(skin, key) * 1.5 + 0.2, 0.0, 1.0) * mix(0.3, 1.0, t) * (1.0 - 0.6 * deep);
    light += globals.key_light.rgb * gleam * shine * reached;
    let behind_half = unit(view + globals.rim.xyz, n);
    let rim_gleam = pow(sine(dot(heading, behind_half)), 24.0) * clamp(dot(skin, globals.rim.xyz) + 0.2, 0.0, 1.0);
    light += globals.rim_light.rgb * (0.010 * pale) * rim_gleam * shine * rim * (1.0 - hidden) * t;

    // Tips before the light shine through.
    let edge = pow(1.0 - clamp(dot(skin, view), 0.0, 1.0), 3.0);
    let from_rim = globals.rim_light.rgb * max(dot(skin, globals.rim.xyz) * 0.6 + 0.4, 0.0) * mix(0.25, 1.0, rim);
    light += mix(albedo, vec3<f32>(1.0), 0.08) * (from_rim * 0.5 + globals.key_light.rgb * 0.08 * lit) * edge * t * (1.0 - hidden);
    return light;
}
