//! What each material looks like elsewhere.
//!
//! Metallic-roughness carries the look alone; sheen, clearcoat and refraction refine it where a client knows them and are
//! never required. Base colours are white: the colour is in the vertices or in a texture.

use crate::frame::Material;
use gltf_json as json;
use serde_json::{Map, Value, json};

/// The name in the file.
pub(super) const fn name(material: Material) -> &'static str {
    match material {
        Material::Coat => "coat",
        Material::Nose => "nose",
        Material::Lip => "lip",
        Material::Mouth => "mouth",
        Material::Sclera => "sclera",
        Material::Iris => "iris",
        Material::Pupil => "pupil",
        Material::Cap => "neck_cap",
        Material::Bone => "bone",
        Material::Tooth => "tooth",
        Material::Gum => "gum",
        Material::Tongue => "tongue",
        Material::ThirdEyelid => "third_eyelid",
        Material::Tears => "tears",
        Material::Whisker => "whisker",
        Material::Muscle => "muscle",
    }
}

/// The textures of a material.
#[derive(Clone, Copy)]
pub(super) struct Maps {
    /// Base colours.
    pub colour: json::Index<json::Texture>,
    /// Normals.
    pub normal: Option<json::Index<json::Texture>>,
}

/// The material of a head with that much fur (0 bare to 1 haired), and the extensions it uses.
pub(super) fn material(material: Material, fur: f32, maps: Option<&Maps>) -> json::Material {
    let roughness = match material {
        Material::Coat | Material::Cap => 0.95,
        Material::Lip | Material::Bone | Material::Tongue | Material::Whisker => 0.5,
        Material::Nose | Material::Mouth | Material::Muscle => 0.4,
        Material::Gum => 0.35,
        Material::Tooth | Material::ThirdEyelid => 0.25,
        Material::Sclera | Material::Iris | Material::Pupil | Material::Tears => 0.1,
    };
    json::Material {
        name: Some(name(material).to_owned()),
        pbr_metallic_roughness: json::material::PbrMetallicRoughness {
            metallic_factor: json::material::StrengthFactor(0.0),
            roughness_factor: json::material::StrengthFactor(roughness),
            base_color_texture: maps.map(|maps| json::texture::Info {
                index: maps.colour,
                tex_coord: 0,
                extensions: None,
                extras: None,
            }),
            ..Default::default()
        },
        normal_texture: maps.and_then(|maps| maps.normal).map(|index| json::material::NormalTexture {
            index,
            scale: 1.0,
            tex_coord: 0,
            extensions: None,
            extras: None,
        }),
        extensions: extensions(material, fur).map(|others| json::extensions::material::Material { others }),
        ..Default::default()
    }
}

/// Extensions by name, sorted.
fn extensions(material: Material, fur: f32) -> Option<Map<String, Value>> {
    let entries = match material {
        Material::Coat => {
            let sheen = f64::from((fur.clamp(0.0, 1.0) * 12.0).round()) / 100.0;
            let (color, roughness) = ("sheenColorFactor", "sheenRoughnessFactor");
            vec![("KHR_materials_sheen", json!({ color: [sheen, sheen, sheen], roughness: 0.6 }))]
        }
        Material::Nose => vec![("KHR_materials_clearcoat", clearcoat(0.5, 0.25))],
        // 1.376: refractive index of the cornea (Gullstrand 1909), as glTF viewers use it for eyes; tears have that of water
        // but for the third digit.
        Material::Sclera | Material::Iris | Material::Pupil | Material::Tears => {
            vec![("KHR_materials_clearcoat", clearcoat(1.0, 0.02)), ("KHR_materials_ior", json!({ "ior": 1.376 }))]
        }
        Material::Gum | Material::Tongue | Material::ThirdEyelid => {
            vec![("KHR_materials_clearcoat", clearcoat(0.5, 0.2))]
        }
        Material::Lip | Material::Mouth | Material::Cap | Material::Bone | Material::Tooth | Material::Whisker | Material::Muscle => {
            return None;
        }
    };
    Some(entries.into_iter().map(|(name, value)| (name.to_owned(), value)).collect())
}

fn clearcoat(amount: f64, roughness: f64) -> Value {
    json!({ "clearcoatFactor": amount, "clearcoatRoughnessFactor": roughness })
}
