//! Colours as people write them (sRGB, `#rrggbb`) and as light adds them (linear).
//!
//! The curve is that of IEC 61966-2-1.

use crate::math::ops;
use glam::Vec3;

/// Reads `#rrggbb` as linear red, green, blue, each 0 to 1. `None` when the text has another form.
pub fn from_hex(text: &str) -> Option<Vec3> {
    let digits = text.strip_prefix('#')?;
    if digits.len() != 6 || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return None;
    }
    let byte = |i: usize| u8::from_str_radix(&digits[i..i + 2], 16).ok();
    Some(from_srgb8([byte(0)?, byte(2)?, byte(4)?]))
}

/// The `#rrggbb` nearest to a linear colour.
pub fn to_hex(linear: Vec3) -> String {
    let [r, g, b] = to_srgb8(linear);
    format!("#{r:02x}{g:02x}{b:02x}")
}

/// Linear value of three sRGB bytes.
pub fn from_srgb8(bytes: [u8; 3]) -> Vec3 {
    let channel = |b: u8| {
        let s = f64::from(b) / 255.0;
        let linear = if s <= 0.04045 { s / 12.92 } else { ops::powf((s + 0.055) / 1.055, 2.4) };
        linear as f32
    };
    Vec3::new(channel(bytes[0]), channel(bytes[1]), channel(bytes[2]))
}

/// The sRGB bytes nearest to a linear colour; what lies outside 0 to 1 is cut off.
pub fn to_srgb8(linear: Vec3) -> [u8; 3] {
    linear.to_array().map(|channel| {
        let c = f64::from(channel).clamp(0.0, 1.0);
        let s = if c <= 0.003_130_8 { c * 12.92 } else { 1.055 * ops::powf(c, 1.0 / 2.4) - 0.055 };
        (s * 255.0 + 0.5) as u8
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_survives_the_way_there_and_back() {
        for b in 0..=255 {
            assert_eq!(to_srgb8(from_srgb8([b; 3])), [b; 3]);
        }
        assert_eq!(from_hex("#ffffff"), Some(Vec3::ONE));
        assert_eq!(to_hex(from_hex("#d9b27C").unwrap()), "#d9b27c");
    }

    #[test]
    fn other_forms_are_refused() {
        for text in ["", "#", "fff", "#fff", "#ffffff0", "ffffff", "#gg0000", "#+10000", "#ääb"] {
            assert_eq!(from_hex(text), None, "{text}");
        }
    }
}
