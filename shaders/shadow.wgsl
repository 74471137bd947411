// Depth of the head seen from the key light, or from the rim light.

override of_rim: bool = false;

@vertex
fn vertex(@location(0) position: vec3<f32>) -> @builtin(position) vec4<f32> {
    var place: vec4<f32>;
    if of_rim {
        place = globals.rim_from_head * vec4<f32>(position, 1.0);
    } else {
        place = globals.shadow_from_head * vec4<f32>(position, 1.0);
    }
    return vec4<f32>(place.x * 2.0 - 1.0, 1.0 - place.y * 2.0, place.z, 1.0);
}
