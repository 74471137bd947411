//! A triangle of the layout as a map from the texture to the skin, and normals as a normal map holds them.

use glam::{Mat3, Vec2, Vec3, Vec4};

/// How places on a triangle follow those in the texture: change for a step of one whole texture to the right, and downwards.
#[derive(Clone, Copy)]
pub(super) struct Steps {
    pub right: Vec3,
    pub down: Vec3,
}

impl Steps {
    /// `values` at the corners that have the coordinates `uv`; zero where the triangle has no area in the texture.
    pub fn new(uv: [Vec2; 3], values: [Vec3; 3]) -> Self {
        let [e, f] = [uv[1] - uv[0], uv[2] - uv[0]];
        let [p, q] = [values[1] - values[0], values[2] - values[0]];
        let area = e.perp_dot(f);
        if area == 0.0 {
            return Self { right: Vec3::ZERO, down: Vec3::ZERO };
        }
        Self { right: (p * f.y - q * e.y) / area, down: (q * e.x - p * f.x) / area }
    }

    /// The change for a step in the texture.
    pub fn times(self, step: Vec2) -> Vec3 {
        self.right * step.x + self.down * step.y
    }

    /// The gradient along the skin, whose places follow these steps, of a height that changes by so much for a step to the
    /// right and for one downwards; after Mikkelsen 2010, "Bump mapping unparametrized surfaces on the GPU".
    pub fn gradient(self, normal: Vec3, right: f32, down: f32) -> Vec3 {
        let across = self.down.cross(normal);
        let along = normal.cross(self.right);
        let area = self.right.dot(across);
        if area.abs() < 1e-20 { Vec3::ZERO } else { (across * right + along * down) / area }
    }
}

/// A normal as three bytes: its parts along tangent, bitangent and normal of the smooth skin. A client reckons it back from
/// the same three.
pub(super) fn in_tangent_space(bumped: Vec3, normal: Vec3, tangent: Vec4) -> [u8; 3] {
    let along = tangent.truncate();
    let frame = Mat3::from_cols(along, normal.cross(along) * tangent.w, normal);
    let own = if frame.determinant().abs() > 1e-3 { frame.inverse() * bumped } else { Vec3::Z };
    // What leans away from the skin would be black for most clients.
    let own = own.with_z(own.z.max(0.1)).normalize_or(Vec3::Z);
    own.to_array().map(|c| ((c * 0.5 + 0.5).clamp(0.0, 1.0) * 255.0 + 0.5) as u8)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{vec2, vec3};

    #[test]
    fn steps_do_not_lead_to_the_corners_or_up_the_slope() {
        let uv = [vec2(0.1, 0.2), vec2(0.6, 0.3), vec2(0.2, 0.9)];
        let at = [vec3(0.0, 0.0, 1.0), vec3(1.0, 0.2, 1.0), vec3(0.1, 2.0, 1.0)];
        let steps = Steps::new(uv, at);
        (0..3).for_each(|k| assert!((at[0] + steps.times(uv[k] - uv[0])).distance(at[k]) < 1e-5));
        // A height that grows by 3 a metre towards x.
        let slope = steps.gradient(Vec3::Z, 3.0 * steps.right.x, 3.0 * steps.down.x);
        assert!(slope.distance(vec3(3.0, 0.0, 0.0)) < 1e-4, "{slope}");
        assert_eq!(in_tangent_space(Vec3::Z, Vec3::Z, vec3(1.0, 0.0, 0.0).extend(1.0)), [128, 128, 255]);
    }
}
