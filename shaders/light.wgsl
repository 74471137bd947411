// The light and the film it falls on: what every lit surface shares, put behind its shader.

// What surfaces are made of, instead of what they are: as in src/render/preset.rs.
const CLAY: f32 = 1.0;
const INK: f32 = 2.0;
const CLAY_COLOUR: vec3<f32> = vec3<f32>(0.46, 0.41, 0.36);

fn is_made_of(stuff: f32) -> bool {
    return abs(globals.coat.y - stuff) < 0.5;
}

// A rotation without symmetry, so that the noise's lattice lies along no axis of the head.
const SKEW: mat3x3<f32> = mat3x3<f32>(
    vec3<f32>(0.7268, 0.4423, -0.5254),
    vec3<f32>(-0.1612, 0.8522, 0.4977),
    vec3<f32>(0.6678, -0.2795, 0.6899),
);

fn unit(v: vec3<f32>, instead: vec3<f32>) -> vec3<f32> {
    let l = dot(v, v);
    if l < 1e-12 {
        return instead;
    }
    return v * inverseSqrt(l);
}

// What of the sky is seen in a direction.
fn sky(direction: vec3<f32>) -> vec3<f32> {
    let height = dot(direction, globals.up.xyz);
    let end = select(globals.ground.rgb, globals.zenith.rgb, height > 0.0);
    return mix(globals.horizon.rgb, end, smoothstep(0.05, 0.85, abs(height)));
}

// What a matt surface sends back of the sky.
fn gathered(normal: vec3<f32>) -> vec3<f32> {
    let c = dot(normal, globals.up.xyz);
    let light = globals.gathered[0].rgb + globals.gathered[1].rgb * c + globals.gathered[2].rgb * (1.5 * c * c - 0.5);
    return max(light, vec3<f32>(0.0));
}

// Lambert's cosine, let past the terminator by `wrap`, with its energy kept.
fn wrapped(normal: vec3<f32>, light: vec3<f32>, wrap: f32) -> f32 {
    return max(dot(normal, light) + wrap, 0.0) / ((1.0 + wrap) * (1.0 + wrap));
}

// Light that comes through from behind `depth` metres of flesh: red gets farthest.
fn transmitted(depth: f32) -> vec3<f32> {
    return exp(-max(depth, 0.0) * vec3<f32>(260.0, 850.0, 1150.0));
}

// A shoulder that starts late and never clips; below it a lift of what is nearly black, in which dark coats keep their form. Colours are bent by their brightest
// channel in part, so that pale coats keep their hue.
fn film(light: vec3<f32>) -> vec3<f32> {
    let seen = max(light, vec3<f32>(0.0)) * (0.62 * globals.coat.z);
    let brightest = max(seen.r, max(seen.g, seen.b));
    let x = seen * (1.0 + 0.45 * exp(-brightest / 0.06));
    let each = x * (1.0 + x * 0.09) / (1.0 + x * 0.78);
    let peak = max(max(x.r, x.g), max(x.b, 1e-5));
    let bent = peak * (1.0 + peak * 0.09) / (1.0 + peak * 0.78);
    return clamp(mix(each, x * bent / peak, 0.5), vec3<f32>(0.0), vec3<f32>(1.0));
}

fn encoded(linear: vec3<f32>) -> vec3<f32> {
    let low = linear * 12.92;
    let high = 1.055 * pow(max(linear, vec3<f32>(1e-5)), vec3<f32>(1.0 / 2.4)) - 0.055;
    return select(high, low, linear <= vec3<f32>(0.0031308));
}
