//! Textures of exported heads: that they show what the vertices show, tear nowhere, and are the same everywhere.
#![cfg(feature = "head")]

#[path = "support/settings.rs"]
mod settings;

use glam::{Vec2, Vec3, Vec4, vec2};
use gltf::json::texture::{MagFilter, MinFilter};
use londra::anatomy::{Breed, colour};
use londra::export::{GlbError, GlbOptions, TextureError, Textures, to_glb};
use londra::frame::{Eyeball, Frame, Material, Part, Pipeline, Uv};
use settings::World;

const LEVEL: u32 = 3;
const SIZE: u32 = 512;

fn pipeline(world: &World) -> Pipeline {
    let mut pipeline = world.pipeline(LEVEL, 0);
    pipeline.set_uv(true).unwrap();
    pipeline
}

fn wearing(world: &World, breed: &str, coat: &str) -> Breed {
    let mut dog = world.breed(breed).clone();
    dog.wear(coat).unwrap();
    dog
}

fn baked(pipeline: &mut Pipeline, breed: &Breed, size: u32, threads: usize) -> Textures {
    pipeline.update(breed);
    Textures::bake(&pipeline.frame(), &pipeline.canvas().unwrap(), size, threads).unwrap()
}

fn exported(world: &World, frame: &Frame<'_>, breed: &Breed, textures: Textures) -> Vec<u8> {
    let options = GlbOptions { textures: Some(textures), ..GlbOptions::default() };
    to_glb(frame, &world.table, breed, &options).unwrap()
}

/// Three bytes a texel.
struct Picture {
    size: usize,
    rgb: Vec<u8>,
}

impl Picture {
    fn read(png: &[u8]) -> Self {
        let mut reader = png::Decoder::new(std::io::Cursor::new(png)).read_info().unwrap();
        let mut rgb = vec![0; reader.output_buffer_size().unwrap()];
        let info = reader.next_frame(&mut rgb).unwrap();
        assert_eq!(
            (info.width, info.color_type, info.bit_depth),
            (info.height, png::ColorType::Rgb, png::BitDepth::Eight)
        );
        Self { size: info.width as usize, rgb }
    }

    fn texel(&self, x: f32, y: f32) -> Vec3 {
        let [x, y] = [x, y].map(|c| c.clamp(0.0, (self.size - 1) as f32) as usize);
        let at = 3 * (y * self.size + x);
        Vec3::from([0, 1, 2].map(|k| f32::from(self.rgb[at + k])))
    }

    /// Between the texels' middles, as clients read: 0 to 255.
    fn at(&self, place: Vec2) -> Vec3 {
        let p = place * self.size as f32 - 0.5;
        let (low, f) = (p.floor(), p - p.floor());
        let row = |dy: f32| self.texel(low.x, low.y + dy).lerp(self.texel(low.x + 1.0, low.y + dy), f.x);
        row(0.0).lerp(row(1.0), f.y)
    }
}

fn skin<'a>(frame: &'a Frame<'_>) -> (&'a Part<'a>, &'a Uv) {
    let part = frame.parts.iter().find(|p| p.topology.name == "skin").unwrap();
    (part, part.uv.unwrap())
}

fn srgb(linear: Vec3) -> Vec3 {
    Vec3::from(colour::to_srgb8(linear).map(f32::from))
}

/// The material of each vertex to draw; of a border, one of them.
fn materials(uv: &Uv) -> Vec<Material> {
    let mut out = vec![Material::Cap; uv.vertices.len()];
    for range in &uv.ranges {
        let (start, end) = (range.start as usize, (range.start + range.count) as usize);
        uv.indices[start..end].iter().for_each(|&v| out[v as usize] = range.material);
    }
    out
}

/// The mean, and what so many parts of a hundred stay below.
fn spread(mut values: Vec<f32>, percent: usize) -> (f32, f32) {
    values.sort_by(f32::total_cmp);
    (values.iter().sum::<f32>() / values.len() as f32, values[values.len() * percent / 100])
}

#[test]
fn a_texture_shows_other_colours_than_the_vertices() {
    let world = World::embedded();
    let mut pipeline = pipeline(&world);
    let dogs =
        [wearing(&world, "great_dane", "harlequin"), world.breed("pug").clone(), world.breed("labrador").clone()];
    for dog in &dogs {
        let textures = baked(&mut pipeline, dog, SIZE, 2);
        let picture = Picture::read(&textures.skin_colour);
        assert_eq!(picture.size, SIZE as usize);
        let frame = pipeline.frame();
        let (part, uv) = skin(&frame);
        let (mut of_coat, mut of_other_side, mut of_lining, mut darker) = (Vec::new(), Vec::new(), Vec::new(), 0.0);
        for ((&place, &[a, b]), material) in uv.coordinates.iter().zip(&uv.vertices).zip(materials(uv)) {
            if a != b {
                continue;
            }
            let wanted = srgb(part.colours[a as usize]);
            let difference = |place: Vec2| (wanted - picture.at(place)).abs().max_element();
            match material {
                Material::Coat => {
                    of_coat.push(difference(place));
                    of_other_side.push(difference(vec2(1.0 - place.x, place.y)));
                    darker += (wanted - picture.at(place)).element_sum() / 3.0;
                }
                Material::Mouth => of_lining.push(difference(place)),
                _ => (),
            }
        }
        darker /= of_coat.len() as f32;
        assert!(darker.abs() < 1.5, "{}: {darker} darker", dog.id);
        // Streaks lighten and darken a coat, leather has none.
        let ((coat, most), (other_side, _), lining) =
            (spread(of_coat, 95), spread(of_other_side, 95), spread(of_lining, 95));
        assert!(coat < 14.0 && most < 36.0, "{}: the coat differs by {coat}, {most}", dog.id);
        assert!(lining.0 < 2.0 && lining.1 < 5.0, "{}: the lining differs by {lining:?}", dog.id);
        if dog.id == "great_dane" {
            assert!(other_side > 2.0 * coat, "sides are mistaken: {other_side} on the other, {coat} on this");
        }
    }
}

#[test]
fn a_seam_is_seen() {
    let world = World::embedded();
    let mut pipeline = pipeline(&world);
    let dogs = [
        wearing(&world, "great_dane", "harlequin"),
        world.breed("german_shepherd").clone(),
        world.breed("dalmatian").clone(),
    ];
    for dog in &dogs {
        let textures = baked(&mut pipeline, dog, SIZE, 2);
        let [colours, normals] = [&textures.skin_colour, &textures.skin_normal].map(|png| Picture::read(png));
        let frame = pipeline.frame();
        let (part, uv) = skin(&frame);
        let mut sides = std::collections::BTreeMap::<u32, Vec<usize>>::new();
        for (drawn, &[a, b]) in uv.vertices.iter().enumerate() {
            if a == b {
                sides.entry(a).or_default().push(drawn);
            }
        }
        let tangents = tangents(&world, &frame, dog, &textures);
        let world_normal = |drawn: usize| {
            let own = normals.at(uv.coordinates[drawn]) / 127.5 - 1.0;
            let (normal, tangent) = (part.normals[uv.vertices[drawn][0] as usize], tangents[drawn]);
            let along = tangent.truncate();
            (along * own.x + normal.cross(along) * tangent.w * own.y + normal * own.z).normalize()
        };
        let (mut of_colour, mut of_normal, mut beside) = (Vec::new(), Vec::new(), Vec::new());
        for sides in sides.values().filter(|sides| sides.len() > 1) {
            let [p, q] = [sides[0], sides[1]].map(|v| uv.coordinates[v]);
            of_colour.push((colours.at(p) - colours.at(q)).abs().max_element());
            beside.push((colours.at(p) - colours.at(p + vec2(2.0, 0.0) / SIZE as f32)).abs().max_element());
            of_normal.push(world_normal(sides[0]).dot(world_normal(sides[1])).clamp(-1.0, 1.0).acos().to_degrees());
        }
        assert!(of_colour.len() > 300, "{} vertices on seams", of_colour.len());
        let ((colour, most), (beside, _), normal) = (spread(of_colour, 95), spread(beside, 95), spread(of_normal, 95));
        assert!(colour < 4.0 && most < 18.0, "{}: colours differ by {colour}, {most}", dog.id);
        assert!(colour < 0.5 * beside, "{}: {colour} across a seam, {beside} two texels farther", dog.id);
        assert!(normal.0 < 4.0 && normal.1 < 16.0, "{}: normals differ by {normal:?} degrees", dog.id);
    }
}

/// The tangents of the skin's vertices to draw, read back from a file.
fn tangents(world: &World, frame: &Frame<'_>, dog: &Breed, textures: &Textures) -> Vec<Vec4> {
    let glb = exported(world, frame, dog, textures.clone());
    let (document, buffers, _) = gltf::import_slice(&glb).unwrap();
    let (_, uv) = skin(frame);
    let mut out = vec![Vec4::ZERO; uv.vertices.len()];
    let mesh = document.meshes().find(|m| m.name() == Some("skin")).unwrap();
    for (primitive, range) in mesh.primitives().zip(&uv.ranges) {
        let reader = primitive.reader(|buffer| buffers.get(buffer.index()).map(|data| &data.0[..]));
        let found: Vec<[f32; 4]> = reader.read_tangents().unwrap().collect();
        let indices = reader.read_indices().unwrap().into_u32();
        let source = &uv.indices[range.start as usize..(range.start + range.count) as usize];
        for (compact, &drawn) in indices.zip(source) {
            out[drawn as usize] = found[compact as usize].into();
        }
    }
    out
}

#[test]
fn a_tangent_lies_askew_or_its_bitangent_points_down_in_the_picture() {
    let world = World::embedded();
    let mut pipeline = pipeline(&world);
    let dog = world.breed("pug");
    let textures = baked(&mut pipeline, dog, 256, 1);
    let frame = pipeline.frame();
    let tangents = tangents(&world, &frame, dog, &textures);
    let (part, uv) = skin(&frame);
    let mut wrong = 0;
    let triangles = uv.indices.as_chunks::<3>().0;
    for triangle in triangles {
        let at = triangle.map(|v| {
            let [a, b] = uv.vertices[v as usize];
            (part.positions[a as usize] + part.positions[b as usize]) * 0.5
        });
        let [p, q, r] = triangle.map(|v| uv.coordinates[v as usize]);
        let (e, f) = (q - p, r - p);
        // How the place moves for a step to the right and one up in the picture.
        let right = ((at[1] - at[0]) * f.y - (at[2] - at[0]) * e.y) / e.perp_dot(f);
        let up = ((at[1] - at[0]) * f.x - (at[2] - at[0]) * e.x) / e.perp_dot(f);
        for &v in triangle {
            let tangent = tangents[v as usize];
            let [a, b] = uv.vertices[v as usize];
            let normal = (part.normals[a as usize] + part.normals[b as usize]).normalize();
            assert!((tangent.truncate().length() - 1.0).abs() < 1e-4 && tangent.w.abs() == 1.0, "{tangent}");
            let bitangent = normal.cross(tangent.truncate()) * tangent.w;
            wrong += usize::from(tangent.truncate().dot(right) <= 0.0 || bitangent.dot(up) <= 0.0);
        }
    }
    assert!(wrong * 200 < 3 * triangles.len(), "{wrong} corners of {} triangles", triangles.len());
}

#[test]
fn what_has_a_texture_has_colours_too_or_wants_an_extension() {
    let world = World::embedded();
    let mut pipeline = pipeline(&world);
    let dog = world.breed("pug");
    let textures = baked(&mut pipeline, dog, 256, 1);
    let frame = pipeline.frame();
    let glb = exported(&world, &frame, dog, textures);
    let (document, _, images) = gltf::import_slice(&glb).unwrap();
    assert_eq!(document.extensions_required().count(), 0);
    let sides: Vec<(u32, u32)> = images.iter().map(|image| (image.width, image.height)).collect();
    assert_eq!(sides, [(256, 256), (256, 256), (128, 128)]);
    for primitive in document.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>()) {
        let material = primitive.material();
        let name = material.name().unwrap();
        let base = material.pbr_metallic_roughness().base_color_texture();
        let (coloured, tangent) = (primitive.get(&gltf::Semantic::Colors(0)), primitive.get(&gltf::Semantic::Tangents));
        assert!(base.is_some() != coloured.is_some(), "{name}: vertex colours multiply the texture's");
        assert_eq!(material.normal_texture().is_some(), tangent.is_some(), "{name}");
        assert_eq!(
            base.is_some(),
            ["coat", "nose", "lip", "mouth", "sclera", "iris", "pupil"].contains(&name),
            "{name}"
        );
        if let Some(base) = base {
            let sampler = base.texture().sampler();
            assert_eq!(sampler.mag_filter(), Some(MagFilter::Linear));
            assert_eq!(sampler.min_filter(), Some(MinFilter::LinearMipmapLinear));
            assert_eq!(base.tex_coord(), 0);
            assert!(primitive.get(&gltf::Semantic::TexCoords(0)).is_some(), "{name}");
        }
    }
    // And without textures nothing of them.
    let plain = to_glb(&frame, &world.table, dog, &GlbOptions::default()).unwrap();
    let (document, _, images) = gltf::import_slice(&plain).unwrap();
    assert!(images.is_empty() && document.textures().count() == 0 && document.samplers().count() == 0);
}

#[test]
fn the_bytes_depend_on_the_threads() {
    let world = World::embedded();
    let mut pipeline = pipeline(&world);
    let dog = world.breed("beagle");
    let [one, again, eight] = [1, 1, 8].map(|threads| baked(&mut pipeline, dog, 256, threads));
    assert!(one == again, "the same head twice has other bytes");
    assert!(one == eight, "eight threads give other bytes than one");
}

#[test]
fn a_size_or_a_frame_without_a_texture_gives_one() {
    let world = World::embedded();
    let mut pipeline = pipeline(&world);
    let dog = world.breed("beagle");
    let textures = baked(&mut pipeline, dog, 256, 1);
    for size in [0, 1, 128, 300, 1000, 8192] {
        let error = Textures::bake(&pipeline.frame(), &pipeline.canvas().unwrap(), size, 1).unwrap_err();
        assert!(matches!(error, TextureError::Size(s) if s == size), "{error}");
        assert!(error.to_string().contains("a power of two from 256 to 4096"), "{error}");
    }
    let mut bare = world.pipeline(2, 0);
    assert!(bare.canvas().is_none());
    bare.update(dog);
    let canvas = bare.canvas().unwrap();
    let error = Textures::bake(&bare.frame(), &canvas, 256, 1).unwrap_err();
    assert!(matches!(error, TextureError::NoLayout), "{error}");
    let error = Textures::bake(&pipeline.frame(), &canvas, 256, 1).unwrap_err();
    assert!(matches!(error, TextureError::Canvas { .. }), "{error}");
    bare.set_uv(true).unwrap();
    bare.update(dog);
    let options = GlbOptions { textures: Some(textures), ..GlbOptions::default() };
    let error = to_glb(&bare.frame(), &world.table, dog, &options).unwrap_err();
    assert!(matches!(error, GlbError::Textures { .. }), "{error}");
}

#[test]
fn an_eye_has_no_pupil_iris_ring_or_white() {
    let world = World::embedded();
    let mut pipeline = pipeline(&world);
    let mut dog = world.breed("labrador").clone();
    dog.look.iris = Vec3::new(0.3, 0.2, 0.05);
    let textures = baked(&mut pipeline, &dog, 1024, 1);
    let picture = Picture::read(textures.eye_colour.as_ref().unwrap());
    let frame = pipeline.frame();
    let eye = &frame.eyes[0];
    // The mean over a circle around the axis, at a part of the way to the limbus; lids darken above and below.
    let ring = |wanted: f32| {
        let on_ring = (0..picture.size * picture.size).filter_map(|i| {
            let (x, y) = ((i % picture.size) as f32 + 0.5, (i / picture.size) as f32 + 0.5);
            let (direction, angle) = eye.on_texture(vec2(x, y) / picture.size as f32);
            let is_aside = direction.x.abs() > direction.y.abs();
            ((angle - wanted).abs() < 0.02 && is_aside).then(|| picture.texel(x, y))
        });
        let (sum, n) = on_ring.fold((Vec3::ZERO, 0), |(sum, n), c| (sum + c, n + 1));
        sum / n as f32
    };
    let [pupil, iris, limbus] = [0.5 * Eyeball::PUPIL, 0.68, 0.97].map(ring);
    assert!(pupil.max_element() < 14.0, "pupil {pupil}");
    assert!(iris.x > iris.y && iris.y > 1.2 * iris.z, "iris {iris}");
    assert!(limbus.element_sum() < 0.75 * iris.element_sum(), "rim {limbus}, iris {iris}");
    assert!(ring(1.9).min_element() > 60.0, "white {}", ring(1.9));
}
