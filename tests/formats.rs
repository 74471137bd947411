//! Mesh files: hand-made bytes of every format, two ways to write the same mesh, and bytes that are broken.
#![allow(unsafe_code)] // An allocator that counts is one of the few things that cannot be written without.

use std::alloc::{GlobalAlloc, Layout, System};
use std::cell::Cell;

use londra::io::obj::{self, ObjFault};
use londra::io::ply::{self, PlyFault};
use londra::io::stl::{self, StlFault};
use londra::io::three_ds::{self, ThreeDsFault};
use londra::io::{Format, Place, Soup, WriteError, read, write};
use londra::math::rng::Rng;

thread_local! {
    static HELD: Cell<usize> = const { Cell::new(0) };
    static PEAK: Cell<usize> = const { Cell::new(0) };
}

struct Counting;

fn count(more: usize, less: usize) {
    HELD.set((HELD.get() + more).saturating_sub(less));
    PEAK.set(PEAK.get().max(HELD.get()));
}

// SAFETY: every call is passed on to the system's allocator unchanged; the counts are plain thread-local numbers.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size(), 0);
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }
    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        count(0, layout.size());
        // SAFETY: the caller keeps the contract of `dealloc`.
        unsafe { System.dealloc(pointer, layout) }
    }
    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // Old and new may exist at once.
        count(size, 0);
        count(0, layout.size());
        // SAFETY: the caller keeps the contract of `realloc`.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static COUNTING: Counting = Counting;

/// Most bytes that were held at once during the work, beyond those before it.
fn peak(work: impl FnOnce()) -> usize {
    let before = HELD.get();
    PEAK.set(before);
    work();
    PEAK.get() - before
}

/// Corners of the unit cube: bit 0 is x, bit 1 y, bit 2 z.
fn cube_corner(i: usize) -> [f32; 3] {
    [i & 1, i >> 1 & 1, i >> 2 & 1].map(|bit| bit as f32)
}

/// Quads, counter-clockwise from outside.
const QUADS: [[u32; 4]; 6] = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];

fn cube_triangles() -> Vec<[u32; 3]> {
    QUADS.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect()
}

fn cube_positions() -> Vec<[f64; 3]> {
    (0..8).map(|i| cube_corner(i).map(f64::from)).collect()
}

fn cube() -> Soup {
    Soup::from_triangles(cube_positions(), &cube_triangles())
}

fn quads() -> Soup {
    let corners = QUADS.as_flattened().to_vec();
    Soup { positions: cube_positions(), face_sizes: vec![4; 6], corners, ..Soup::default() }
}

/// The positions of each face's corners: equal for two soups that differ in the numbers of their vertices alone.
fn shape(soup: &Soup) -> Vec<Vec<[f64; 3]>> {
    soup.faces().map(|face| face.iter().map(|&v| soup.positions[v as usize]).collect()).collect()
}

/// Directed sides of faces without a side the other way: none in a closed surface that is welded.
fn open_sides(soup: &Soup) -> usize {
    let mut sides = std::collections::BTreeSet::new();
    for face in soup.faces() {
        sides.extend(face.iter().zip(face.iter().cycle().skip(1)));
    }
    sides.iter().filter(|&&(a, b)| !sides.contains(&(b, a))).count()
}

// ---- 3DS -----------------------------------------------------------------------------------------------------------

fn chunk(id: u16, parts: &[&[u8]]) -> Vec<u8> {
    let data = parts.concat();
    [&id.to_le_bytes()[..], &(6 + data.len() as u32).to_le_bytes(), &data].concat()
}

fn three_ds_object(name: &str, positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Vec<u8> {
    let mut vertices = (positions.len() as u16).to_le_bytes().to_vec();
    vertices.extend(positions.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
    let mut faces = (triangles.len() as u16).to_le_bytes().to_vec();
    for triangle in triangles {
        faces.extend(triangle.iter().flat_map(|&v| (v as u16).to_le_bytes()));
        faces.extend([7, 0]);
    }
    // Smoothing groups stand inside the face list, the mesh's own axes after it.
    let smoothing = chunk(0x4150, &[&vec![1; 4 * triangles.len()]]);
    let mesh = [chunk(0x4110, &[&vertices]), chunk(0x4120, &[&faces, &smoothing]), chunk(0x4160, &[&[0; 48]])];
    chunk(0x4000, &[name.as_bytes(), b"\0", &chunk(0x4100, &[&mesh.concat()])])
}

fn three_ds_file(objects: &[Vec<u8>]) -> Vec<u8> {
    let version = chunk(0x0002, &[&3_u32.to_le_bytes()]);
    let material = chunk(0xafff, &[&chunk(0xa000, &[b"GREY\0"])]);
    let editor = chunk(0x3d3d, &[&chunk(0x3d3e, &[&3_u32.to_le_bytes()]), &material, &objects.concat()]);
    chunk(0x4d4d, &[&version, &editor, &chunk(0xb000, &[&[0; 9]])])
}

/// A cube as 3D Studio has it: each corner once for each of two or more sides, a 26th for good measure, 12 faces.
fn cube_of_26() -> Vec<u8> {
    let mut positions: Vec<[f32; 3]> = QUADS.as_flattened().iter().map(|&v| cube_corner(v as usize)).collect();
    let triangles: Vec<[u32; 3]> =
        (0..6).flat_map(|q| [[4 * q, 4 * q + 1, 4 * q + 2], [4 * q, 4 * q + 2, 4 * q + 3]]).collect();
    positions.extend([cube_corner(0), [-0.0, 0.0, -0.0]]);
    assert_eq!((positions.len(), triangles.len()), (26, 12));
    three_ds_object("Box01", &positions, &triangles)
}

#[test]
fn the_cube_of_3d_studio_keeps_its_seams() {
    let soup = three_ds::read(&three_ds_file(&[cube_of_26()])).expect("a cube");
    assert_eq!((soup.positions.len(), soup.face_sizes.len(), open_sides(&soup)), (8, 12, 0));
    assert_eq!(shape(&soup), shape(&cube()));
    assert_eq!(soup.validate(), Ok(()));
}

#[test]
fn two_objects_are_welded_to_each_other_or_lose_their_names() {
    // A light has an object's chunk and no mesh.
    let light = chunk(0x4000, &[b"Omni01\0", &chunk(0x4600, &[&[0; 12]])]);
    let tip = [[1.0, 1.0, 1.0], [2.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    let file = three_ds_file(&[cube_of_26(), light, three_ds_object("Tip\u{e9}", &tip, &[[0, 1, 2]])]);
    let objects = three_ds::objects(&file).expect("two meshes");
    assert_eq!(objects.iter().map(|o| &*o.name).collect::<Vec<_>>(), ["Box01", "Tip\u{e9}"]);
    let soup = three_ds::read(&file).expect("two meshes");
    assert_eq!((soup.positions.len(), soup.face_sizes.len()), (11, 13));
    assert_eq!(soup.corners[36..], [8, 9, 10]);
}

#[test]
fn a_broken_3ds_is_blamed_elsewhere() {
    let whole = three_ds_file(&[three_ds_object("one", &[[0.0; 3]; 3], &[[0, 1, 3]])]);
    let error = three_ds::read(&whole).expect_err("vertex 3 of 3");
    assert_eq!(error.what, ThreeDsFault::OutOfRange { face: 0, vertex: 3, count: 3 });
    assert_eq!(error.object.as_deref(), Some("one"));
    assert_eq!(whole[error.byte..error.byte + 2], 0x4120_u16.to_le_bytes());
    assert!(error.to_string().contains("object \"one\": face 0 names vertex 3"), "{error}");
    let error = three_ds::read(b"PK\x03\x04 a zip").expect_err("another format");
    assert!(matches!(error.what, ThreeDsFault::NotThreeDs | ThreeDsFault::ChunkLength { .. }), "{error}");
    let nan = three_ds_file(&[three_ds_object("nan", &[[0.0, f32::NAN, 0.0]], &[])]);
    assert_eq!(three_ds::read(&nan).map_err(|e| e.what), Err(ThreeDsFault::NotFinite { vertex: 0 }));
}

// ---- STL -----------------------------------------------------------------------------------------------------------

fn binary_stl(header: &[u8], facets: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut out = header.to_vec();
    out.resize(80, b' ');
    out.extend((facets.len() as u32).to_le_bytes());
    for facet in facets {
        out.extend([0; 12]);
        out.extend(facet.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        out.extend([0xff, 0x7f]);
    }
    out
}

fn text_stl(facets: &[[[f32; 3]; 3]]) -> String {
    let mut text = "solid a cube, facet by facet\r\n".to_owned();
    for facet in facets {
        text += "  facet normal 0 0 0\n    OUTER LOOP\n";
        facet.iter().for_each(|[x, y, z]| text += &format!("\tvertex {x:e} {y} {z}\n"));
        text += "    endloop\n  endfacet\n";
    }
    text + "endsolid a cube, facet by facet"
}

/// A cube of awkward numbers, and a facet of two points.
fn facets() -> Vec<[[f32; 3]; 3]> {
    let place = |v: u32| cube_corner(v as usize).map(|x| x * 0.1 - 1.0 / 3.0);
    let mut facets: Vec<_> = cube_triangles().into_iter().map(|triangle| triangle.map(place)).collect();
    facets.insert(3, [place(0), place(7), place(0)]);
    facets
}

#[test]
fn text_and_binary_stl_differ() {
    let binary = stl::read(&binary_stl(b"made by hand", &facets())).expect("binary");
    let text = stl::read(text_stl(&facets()).as_bytes()).expect("text");
    assert_eq!(binary, text);
    assert_eq!((binary.positions.len(), binary.face_sizes.len(), open_sides(&binary)), (8, 12, 0));
}

#[test]
fn a_binary_stl_that_begins_with_solid_is_taken_for_text() {
    let expected = stl::read(&binary_stl(b"", &facets()));
    let bytes = binary_stl(b"solid made by a program that has not read the page", &facets());
    assert_eq!(stl::read(&bytes), expected);
    assert_eq!(Format::from_magic(&bytes), Some(Format::Stl));
    // Cut off it is binary still, as its zeros tell.
    let error = stl::read(&bytes[..bytes.len() - 1]).expect_err("cut off");
    assert!(matches!(error.what, StlFault::CutOff { facets: 13, needed: 734, found: 733 }), "{error}");
    // What a program appends after the facets changes nothing.
    assert_eq!(stl::read(&[&binary_stl(b"", &facets())[..], b"tail"].concat()), expected);
}

#[test]
fn two_solids_of_a_text_are_not_one_surface() {
    let facets = facets();
    let (first, second) = facets.split_at(5);
    let soup = stl::read(format!("{}\n{}\n", text_stl(first), text_stl(second)).as_bytes()).expect("two patches");
    assert_eq!((soup.positions.len(), open_sides(&soup)), (8, 0));
}

#[test]
fn a_broken_stl_is_blamed_elsewhere() {
    let text = text_stl(&facets());
    let error = |text: &str| stl::read(text.as_bytes()).expect_err("broken");
    let unexpected = |text: &str, expected| StlFault::Unexpected { text: text.into(), expected };
    let cases = [
        (text.replacen("endloop", "vertex", 1), 7, unexpected("vertex", "endloop")),
        (text.replacen("facet normal", "facets normal", 1), 2, unexpected("facets", "facet")),
        (text.replacen("vertex", "vertex x", 1), 4, StlFault::NotAVertex),
        (text.replacen("vertex", "vertex 1e60", 1), 4, StlFault::NotAVertex),
        (format!("{text}\nsolid"), text.lines().count() + 1, StlFault::NoEnd),
        (format!("{text}\nfacet"), text.lines().count() + 1, unexpected("facet", "solid")),
    ];
    for (text, line, what) in cases {
        let error = error(&text);
        assert_eq!((error.place, error.what), (Place::Line(line), what));
    }
    let mut nan = facets();
    nan[1][2][0] = f32::INFINITY;
    let error = stl::read(&binary_stl(b"", &nan)).expect_err("infinite");
    assert_eq!((error.place, error.what), (Place::Byte(84 + 50 + 12 + 24), StlFault::NotAVertex));
}

// ---- PLY -----------------------------------------------------------------------------------------------------------

const PLY_HEADER: &str = "comment colours and a flag are passed over\r\nobj_info by hand\n\
    element vertex 8\nproperty uchar red\nproperty float32 x\nproperty double y\nproperty float z\n\
    element edge 2\nproperty list ushort short ends\nproperty int8 flag\n\
    element nothing 4000000000\n\
    element face 7\nproperty list uchar float weights\nproperty list uchar uint vertex_indices\n";

/// The cube's quads and a triangle, in any encoding.
fn ply_file(format: &str) -> Vec<u8> {
    let mut out = format!("ply\nformat {format} 1.0\n{PLY_HEADER}end_header\n").into_bytes();
    macro_rules! push {
        ($number:expr) => {{
            let number = $number;
            match format {
                "ascii" => out.extend(format!("{number} ").bytes()),
                "binary_big_endian" => out.extend(number.to_be_bytes()),
                _ => out.extend(number.to_le_bytes()),
            }
        }};
    }
    for i in 0..8 {
        let [x, y, z] = cube_corner(i);
        push!(200_u8);
        push!(x * 0.1);
        push!(f64::from(y) * 0.1);
        push!(z * -0.1);
    }
    for i in 0..2_i8 {
        push!(2_u16);
        push!(-1_i16);
        push!(300_i16);
        push!(-i);
    }
    for face in QUADS.iter().map(|quad| &quad[..]).chain([&[0, 3, 6][..]]) {
        push!(1_u8);
        push!(0.5_f32);
        push!(face.len() as u8);
        face.iter().for_each(|&v| push!(v));
    }
    out
}

#[test]
fn the_encodings_of_ply_differ() {
    let soup = ply::read(&ply_file("ascii")).expect("text");
    assert_eq!(soup.face_sizes, [4, 4, 4, 4, 4, 4, 3]);
    assert_eq!(soup.corners[..24], *QUADS.as_flattened());
    assert_eq!(soup.positions[7], [f64::from(0.1_f32), 0.1, f64::from(-0.1_f32)]);
    for format in ["binary_little_endian", "binary_big_endian"] {
        assert_eq!(ply::read(&ply_file(format)), Ok(soup.clone()), "{format}");
    }
}

#[test]
fn an_indices_property_of_the_other_name_is_not_found() {
    let file = |name: &str| String::from_utf8(ply_file("ascii")).map(|text| text.replace("vertex_indices", name));
    let soup = ply::read(&ply_file("ascii"));
    assert_eq!(ply::read(file("vertex_index").expect("text").as_bytes()), soup);
    let error = ply::read(file("indices").expect("text").as_bytes()).expect_err("no indices");
    assert_eq!(error.place, Place::Line(14));
    assert!(matches!(error.what, PlyFault::Missing { element: "face", .. }), "{error}");
    assert_eq!(ply::read(file("vertex_index").expect("text").replace('\n', "\r\n").as_bytes()), soup, "lines of DOS");
}

#[test]
fn a_broken_ply_is_blamed_elsewhere() {
    let header = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n\
                  element face 1\nproperty list uchar int vertex_index\nend_header\n";
    let body = "0 0 0\n1 0 0\n0 1 0\n";
    let range = PlyFault::OutOfRange { vertex: 3, count: 3 };
    let number = |text: &str, expected| PlyFault::NotANumber { text: text.into(), expected };
    let cases = [
        (format!("{header}{body}3 0 1 3"), 13, range),
        (format!("{header}{body}2 0 1"), 13, PlyFault::TooFewCorners { found: 2 }),
        (format!("{header}{body}3 0 1 -1"), 13, number("-1", "a whole number from 0 up")),
        (format!("{header}0 0 0\n1 nan 0"), 11, number("NaN", "a coordinate, finite in 32 bits")),
        (format!("{header}0 0 0\n1 two 0"), 11, number("two", "a coordinate, finite in 32 bits")),
        (format!("{header}{body}3 0 1"), 13, PlyFault::CutOff { element: "face".into(), index: 0, count: 1 }),
        (header.replace("face 1", "tristrips 1"), 7, PlyFault::Strips),
        (header.replace("format ascii 1.0\n", ""), 8, PlyFault::NoFormat),
        (header.replace("end_header\n", ""), 9, PlyFault::EndlessHeader),
        ("PLY\n".into(), 1, PlyFault::NotPly),
    ];
    for (text, line, what) in cases {
        let error = ply::read(text.as_bytes()).expect_err(&text);
        assert_eq!((error.place, error.what), (Place::Line(line), what), "{text}");
    }
    for (from, to) in
        [("ascii", "morse"), ("uchar", "byte"), ("element vertex", "elements vertex"), ("face 1", "face x")]
    {
        let error = ply::read(header.replacen(from, to, 1).as_bytes()).expect_err(to);
        assert!(matches!(error.what, PlyFault::Header { .. }), "{error}");
    }
    let binary = ply_file("binary_little_endian");
    let error = ply::read(&binary[..binary.len() - 1]).expect_err("cut off");
    assert_eq!(error.what, PlyFault::CutOff { element: "face".into(), index: 6, count: 7 });
    assert_eq!(error.place, Place::Byte(binary.len() - 4));
}

#[test]
fn a_written_ply_is_read_otherwise_or_draws_its_holes() {
    let mut soup = quads();
    soup.positions.iter_mut().flatten().for_each(|x| *x = f64::from(*x as f32 * 0.1));
    for normals in [None, Some(&soup.positions[..])] {
        let bytes = ply::write(&soup, normals).expect("consistent");
        assert_eq!(ply::read(&bytes), Ok(soup.clone()));
    }
    let holed = Soup { holes: vec![0, 5], ..soup.clone() };
    let back = ply::read(&ply::write(&holed, None).expect("consistent")).expect("written above");
    assert_eq!((back.face_sizes.len(), &back.corners[..]), (4, &soup.corners[4..20]));
    // A face of more corners than one byte counts.
    let n = 300_u32;
    let disk = (0..n).map(|i| [f64::from(i), f64::from(i * i), 0.0]).collect();
    let disk = Soup { positions: disk, face_sizes: vec![n], corners: (0..n).collect(), ..Soup::default() };
    assert_eq!(ply::read(&ply::write(&disk, None).expect("consistent")), Ok(disk));
}

// ---- welding and the rest of a soup --------------------------------------------------------------------------------

#[test]
fn welding_loses_tags_or_keeps_faces_without_area() {
    let mut soup = Soup {
        positions: vec![
            [9.0; 3],
            [0.0; 3],
            [1.0, 0.0, 0.0],
            [1.0, 1.0, 0.0],
            [-0.0; 3],
            [1.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
        ],
        face_sizes: vec![4, 3, 3],
        corners: vec![1, 2, 3, 4, 1, 5, 2, 4, 3, 6],
        uvs: vec![[0.0; 2]; 10],
        uv_corners: (0..10).collect(),
        creases: vec![(1, 2, 1.0), (2, 5, 3.0), (5, 4, 2.0)],
        point_creases: vec![(0, 1.0), (4, 2.0), (1, 3.0)],
        holes: vec![1, 2],
    };
    soup.weld();
    assert_eq!(soup.positions, [[9.0; 3], [0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]]);
    // The quad lost the corner that fell on its neighbour, and the second face is gone.
    assert_eq!((&soup.face_sizes[..], &soup.corners[..]), (&[3, 3][..], &[1, 2, 3, 1, 3, 4][..]));
    assert_eq!(soup.uv_corners, [0, 1, 2, 7, 8, 9]);
    assert_eq!(soup.holes, [1]);
    assert_eq!(soup.creases, [(1, 2, 2.0)]);
    assert_eq!(soup.point_creases, [(0, 1.0), (1, 3.0)]);
    assert_eq!(soup.validate(), Ok(()));
    let used = soup.without_unused();
    assert_eq!((used.positions.len(), &used.corners[..]), (4, &[0, 1, 2, 0, 2, 3][..]));
    assert_eq!((&used.creases[..], &used.point_creases[..]), (&[(0, 1, 2.0)][..], &[(0, 3.0)][..]));
}

#[test]
fn appending_forgets_to_renumber() {
    let tags = "t crease 2/1/0 0 1 1\nt corner 1/1/0 2 2\nt hole 1/0/0 0\n";
    let triangle = obj::read(format!("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n{tags}").as_bytes());
    let triangle = triangle.expect("a triangle");
    let mut two = triangle.clone();
    two.append(&triangle).expect("small");
    assert_eq!(two.validate(), Ok(()));
    assert_eq!((two.corners[3..].to_vec(), two.uv_corners[3..].to_vec()), (vec![3, 4, 5], vec![1, 1, 1]));
    assert_eq!((two.creases[1], two.point_creases[1], two.holes[1]), ((3, 4, 1.0), (5, 2.0), 1));
    two.append(&cube()).expect("small");
    assert!(two.uv_corners.is_empty(), "the cube has none");
    assert_eq!(two.validate(), Ok(()));
}

#[test]
fn a_format_is_mistaken_for_another() {
    for format in Format::ALL {
        assert_eq!(Format::from_extension(format.extension()), Some(format));
        assert_eq!(Format::from_extension(&format.extension().to_uppercase()), Some(format));
        let result = write(&cube(), None, format);
        match format.is_written() {
            true => assert!(!matches!(result, Err(WriteError::ReadOnly { .. })), "{format}"),
            false => assert_eq!(result, Err(WriteError::ReadOnly { format })),
        }
    }
    assert_eq!(Format::from_extension("fbx"), None);
    for (format, bytes) in samples() {
        // OBJ has no mark.
        let expected = Some(format).filter(|&format| format != Format::Obj);
        assert_eq!(Format::from_magic(&bytes), expected, "{format}");
    }
    for bytes in [&b""[..], b"MM", b"# a comment", b"plywood", b"solidify"] {
        let is_text_stl = bytes.starts_with(b"solid");
        assert_eq!(Format::from_magic(bytes), is_text_stl.then_some(Format::Stl));
    }
    let error = read(b"f 1 2 3", Format::Obj).expect_err("no vertices");
    assert_eq!(error.to_string(), "OBJ, line 1: v 1 does not exist: there are 0 so far");
}

// ---- bytes that are broken -----------------------------------------------------------------------------------------

/// A file of each kind that there is.
fn samples() -> Vec<(Format, Vec<u8>)> {
    let obj = b"# all there is\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0 1 1 1\nv 0 0 1e-3\nvt 0 0\nvt 1 0.5\nvn 0 0 1\n\
        f 1/1/1 2/2/1 3/1/1 4/2/1\nf 1//1 -1//-1 2//1\nf 4 \\\n 5 1\n\
        t crease 4/2/0 0 1 3 0 2.5 10\nt corner 2/1/0 0 4 3\nt hole 1/0/0 2\nt creasemethod 0/0/1 chaikin\n";
    #[allow(unused_mut)]
    let mut samples = vec![
        (Format::Obj, obj.to_vec()),
        (Format::ThreeDs, three_ds_file(&[cube_of_26(), three_ds_object("b", &[[0.5; 3]; 3], &[[0, 1, 2]])])),
        (Format::Stl, binary_stl(b"solid", &facets()[..4])),
        (Format::Stl, text_stl(&facets()[..4]).into_bytes()),
        (Format::Ply, ply_file("ascii")),
        (Format::Ply, ply_file("binary_little_endian")),
        (Format::Ply, ply_file("binary_big_endian")),
        (Format::Ply, ply::write(&quads(), Some(&cube_positions())).expect("consistent")),
    ];
    #[cfg(feature = "formats")]
    samples.extend(with_gltf::samples());
    samples
}

/// Reads what may be broken: it must not panic, and what it takes must be a small multiple of what it is given.
fn survives(bytes: &[u8], format: Format) {
    let taken = peak(|| {
        if let Ok(soup) = read(bytes, format) {
            assert_eq!(soup.validate(), Ok(()), "{format}");
        }
    });
    // The rest is for messages and for hash tables of a few entries.
    assert!(taken <= 48 * bytes.len() + 4096, "{format}: {taken} bytes for {}", bytes.len());
}

#[test]
fn a_whole_sample_is_not_read() {
    for (format, bytes) in samples() {
        survives(&bytes, format);
        let soup = read(&bytes, format).unwrap_or_else(|error| panic!("{error}"));
        assert!(!soup.positions.is_empty() && !soup.face_sizes.is_empty(), "{format}");
    }
}

#[test]
fn a_file_that_is_cut_off_makes_a_reader_panic_or_take_much() {
    for (format, bytes) in samples() {
        for end in 0..bytes.len() {
            survives(&bytes[..end], format);
        }
    }
}

#[test]
fn a_file_that_is_damaged_makes_a_reader_panic_or_take_much() {
    let mut rng = Rng::new(20_261);
    let samples = samples();
    for case in 0..20_000 {
        let (format, bytes) = &samples[case % samples.len()];
        let mut bytes = bytes.clone();
        for _ in 0..=rng.below(6) {
            let at = rng.below(bytes.len());
            match rng.below(5) {
                0 => bytes[at] ^= 1 << rng.below(8),
                1 => bytes[at] = [0, 0xff, 0x7f, 0x80, b' ', b'\n', b'-', b'9'][rng.below(8)],
                // A whole number of 32 bits, which a count may be.
                2 => bytes[at..].iter_mut().take(4).for_each(|byte| *byte = 0xff),
                3 => {
                    bytes.remove(at);
                }
                _ => bytes.insert(at, b"0123456789 -.e/\n"[rng.below(16)]),
            }
        }
        survives(&bytes, *format);
    }
}

#[test]
fn a_count_is_believed() {
    let ply = |elements: &str| format!("ply\nformat binary_little_endian 1.0\n{elements}end_header\n").into_bytes();
    let xyz = "property float x\nproperty float y\nproperty float z\n";
    let huge = [
        (Format::Ply, ply("element nothing 4000000000\n")),
        (Format::Ply, ply(&format!("element vertex 4294967295\n{xyz}"))),
        (Format::Ply, ply(&format!("element vertex 18446744073709551615\n{xyz}"))),
        (Format::Ply, [&ply("element face 1\nproperty list uint int vertex_index\n")[..], &[0xff; 4]].concat()),
        (Format::Stl, [&[0; 80][..], &[0xff; 4]].concat()),
        (Format::ThreeDs, three_ds_file(&[chunk(0x4000, &[b"a\0", &chunk(0x4100, &[&chunk(0x4110, &[&[0xff; 2]])])])])),
        (Format::Obj, b"t crease 4000000000/4000000000/0 1 2 3".to_vec()),
    ];
    for (format, bytes) in huge {
        survives(&bytes, format);
    }
    assert!(matches!(read(&[0; 84], Format::Stl), Ok(soup) if soup.positions.is_empty()));
    assert!(matches!(obj::read(b"t crease 9/9/0 1").map_err(|e| e.what), Err(ObjFault::TagValues { .. })));
}

#[test]
fn many_small_things_take_much() {
    let n = 20_000;
    let object = chunk(0x4000, &[b"\0", &chunk(0x4100, &[])]);
    let files = [
        (Format::Obj, b"v 0 0 0\nf 1 1 1".repeat(n)),
        (Format::Obj, [&b"v 0 0 0\nv 0 0 0\nf 1 2 2\n"[..], &b"t crease 2/1/0 0 1 1\n".repeat(n)].concat()),
        (Format::Obj, [&b"t hole "[..], &b"1 ".repeat(n)].concat()),
        (Format::Obj, b"\xff".repeat(n)),
        (Format::ThreeDs, three_ds_file(&vec![object; n])),
        (Format::Ply, format!("ply\nformat ascii 1.0\n{}end_header\n", "element a 0\n".repeat(n)).into_bytes()),
        (Format::Gltf, format!(r#"{{"asset":{{"version":"2.0"}},"nodes":[{}{{}}]}}"#, "{},".repeat(n)).into_bytes()),
        (Format::Gltf, "[".repeat(n).into_bytes()),
        (
            Format::Gltf,
            format!(
                r#"{{"asset":{{"version":"2.0"}},"scenes":[{{"nodes":[0]}}],"nodes":[{{"children":[{}1]}},{{}}]}}"#,
                "1,".repeat(n)
            )
            .into_bytes(),
        ),
    ];
    for (format, bytes) in files {
        let taken = peak(|| drop(read(&bytes, format)));
        // The worst are nodes of glTF, which say nothing in three bytes.
        assert!(taken <= 96 * bytes.len(), "{format}: {taken} bytes for {}", bytes.len());
    }
}

#[cfg(not(feature = "formats"))]
#[test]
fn a_build_without_gltf_does_not_say_so() {
    assert_eq!(read(b"{}", Format::Gltf), Err(londra::io::ReadError::LeftOut { format: Format::Gltf }));
    assert_eq!(write(&cube(), None, Format::Glb), Err(WriteError::LeftOut { format: Format::Glb }));
}

// ---- glTF ----------------------------------------------------------------------------------------------------------

#[cfg(feature = "formats")]
mod with_gltf {
    use super::*;
    use londra::io::gltf::{GltfFault, read, write};
    use serde_json::{Value, json};

    const U8: u32 = 5121;
    const U16: u32 = 5123;
    const U32: u32 = 5125;
    const F32: u32 = 5126;

    fn uri(bytes: &[u8]) -> String {
        use base64::Engine as _;
        let text = base64::engine::general_purpose::STANDARD.encode(bytes);
        format!("data:application/octet-stream;base64,{text}")
    }

    /// A square in the plane z = 0, its corners in the order of a strip, and a lone vertex that nothing uses.
    const SQUARE: [[f32; 3]; 5] = [[0.0; 3], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 1.0, 0.0], [9.0; 3]];
    const TRIANGLES: [u16; 6] = [0, 1, 2, 1, 3, 2];

    fn square_bytes() -> Vec<u8> {
        let mut bytes: Vec<u8> = SQUARE.as_flattened().iter().flat_map(|x| x.to_le_bytes()).collect();
        bytes.extend(TRIANGLES.iter().flat_map(|i| i.to_le_bytes()));
        bytes
    }

    /// The square as triangles; `change` may spoil it.
    fn square(change: impl FnOnce(&mut Value)) -> Vec<u8> {
        let mut document = json!({
            "asset": { "version": "2.0", "extras": { "nested": [1, { "deep": null }] } },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [{ "mesh": 0, "name": "square" }],
            "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "material": 7 }] }],
            "materials": [{ "alphaMode": "unheard of" }],
            "accessors": [
                { "bufferView": 0, "componentType": F32, "count": 5, "type": "VEC3" },
                { "bufferView": 1, "componentType": U16, "count": 6, "type": "SCALAR" },
            ],
            "bufferViews": [
                { "buffer": 0, "byteLength": 60 },
                { "buffer": 0, "byteOffset": 60, "byteLength": 12 },
            ],
            "buffers": [{ "byteLength": 72, "uri": uri(&square_bytes()) }],
        });
        change(&mut document);
        document.to_string().into_bytes()
    }

    fn glb(mut text: Vec<u8>, binary: &[u8]) -> Vec<u8> {
        text.resize(text.len().next_multiple_of(4), b' ');
        let chunk = |kind: &[u8], data: &[u8]| [&(data.len() as u32).to_le_bytes()[..], kind, data].concat();
        let chunks = [chunk(b"JSON", &text), chunk(b"BIN\0", binary)].concat();
        [&b"glTF\x02\0\0\0"[..], &(12 + chunks.len() as u32).to_le_bytes(), &chunks].concat()
    }

    fn square_glb() -> Vec<u8> {
        let without_uri = |document: &mut Value| document["buffers"] = json!([{ "byteLength": 72 }]);
        glb(square(without_uri), &square_bytes())
    }

    pub(super) fn samples() -> Vec<(Format, Vec<u8>)> {
        let written = write(&quads(), Some(&cube_positions())).expect("consistent");
        let placed = square(|d| {
            d["nodes"] = json!([{ "children": [1, 2] }, { "mesh": 0, "scale": [1, 2, -3] },
                { "mesh": 0, "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1] }]);
        });
        vec![(Format::Gltf, placed), (Format::Glb, square_glb()), (Format::Glb, written)]
    }

    fn corners(soup: &Soup) -> Vec<[[f64; 3]; 3]> {
        soup.triangles().iter().map(|t| t.map(|v| soup.positions[v as usize])).collect()
    }

    #[test]
    fn json_and_binary_gltf_differ_or_keep_what_nothing_uses() {
        let soup = read(&square(|_| ())).expect("a square");
        assert_eq!((soup.positions.len(), soup.triangles()), (4, vec![[0, 1, 2], [1, 3, 2]]));
        assert_eq!(soup.positions[3], [2.0, 1.0, 0.0]);
        assert_eq!(read(&square_glb()), Ok(soup.clone()));
        // Without scenes, and in the first where none is named.
        let no_scene = |d: &mut Value| ["scene", "scenes", "nodes"].into_iter().for_each(|key| d[key] = Value::Null);
        assert_eq!(
            read(&square(|d| no_scene(d))).map_err(|e| e.to_string()).err().map(|e| e.contains("null")),
            Some(true)
        );
        let no_scene = |d: &mut Value| {
            let object = d.as_object_mut().expect("an object");
            ["scene", "scenes", "nodes"].into_iter().for_each(|key| drop(object.remove(key)));
        };
        assert_eq!(read(&square(no_scene)), Ok(soup.clone()));
        let first = |d: &mut Value| drop(d.as_object_mut().expect("an object").remove("scene"));
        assert_eq!(read(&square(first)), Ok(soup));
    }

    #[test]
    fn strips_fans_and_plain_triangles_differ() {
        let plain = read(&square(|_| ())).expect("a square");
        let with = |mode: u32, indices: &[u8]| {
            read(&square(|d| {
                d["meshes"][0]["primitives"][0]["mode"] = json!(mode);
                d["accessors"][1] =
                    json!({ "bufferView": 1, "componentType": U8, "count": indices.len(), "type": "SCALAR" });
                let bytes = [&square_bytes()[..60], indices, &[0; 12]].concat();
                d["buffers"][0]["uri"] = json!(uri(&bytes));
            }))
        };
        assert_eq!(with(4, &[0, 1, 2, 1, 3, 2]), Ok(plain.clone()));
        assert_eq!(with(5, &[0, 1, 2, 3]), Ok(plain.clone()));
        let fan = with(6, &[1, 3, 2, 0]).expect("a fan");
        assert_eq!(fan.triangles(), [[3, 2, 1], [2, 0, 1]], "as the specification turns it");
        for mode in [0, 1, 2, 3] {
            assert_eq!(with(mode, &[0, 1, 2, 3]).map(|soup| soup.face_sizes.len()), Ok(0), "points and lines");
        }
        // Without indices the vertices stand in order.
        let bare = read(&square(|d| {
            let primitive = json!({ "attributes": { "POSITION": 0 }, "mode": 5 });
            d["meshes"][0]["primitives"][0] = primitive;
            d["accessors"][0]["count"] = json!(4);
        }));
        assert_eq!(bare, Ok(plain));
    }

    #[test]
    fn a_node_places_its_mesh_elsewhere() {
        let place = |nodes: Value| {
            let soup = read(&square(|d| d["nodes"] = nodes)).expect("a placed square");
            corners(&soup)[0].map(|p| p.map(|x| (x * 1e6).round() / 1e6))
        };
        let half = 0.5_f64.sqrt();
        // A quarter turn about Z after doubling, then a shift.
        let child = json!({ "mesh": 0, "rotation": [0, 0, half, half], "scale": [2, 2, 2], "translation": [1, 0, 0] });
        let expected = [[1.0, 0.0, 0.0], [1.0, 4.0, 0.0], [-1.0, 0.0, 0.0]];
        assert_eq!(place(json!([child])), expected);
        let shifted = expected.map(|[x, y, z]| [x, y, z - 3.0]);
        assert_eq!(place(json!([{ "children": [1], "translation": [0, 0, -3] }, child])), shifted);
        let matrix = json!({ "mesh": 0, "matrix": [0, 2, 0, 0, -2, 0, 0, 0, 0, 0, 2, 0, 1, 0, 0, 1] });
        assert_eq!(place(json!([matrix])), expected);
        // A mirror turns the corners round, so that the outside stays outside.
        let mirrored = place(json!([{ "mesh": 0, "scale": [-1, 1, 1] }]));
        assert_eq!(mirrored, [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [-2.0, 0.0, 0.0]].map(|p| p.map(|x: f64| x + 0.0)));
        let two = square(|d| {
            d["scenes"][0]["nodes"] = json!([0, 1]);
            d["nodes"] = json!([{ "mesh": 0 }, { "mesh": 0, "translation": [2, 0, 0] }]);
        });
        let two = read(&two).expect("two squares");
        assert_eq!((two.positions.len(), two.face_sizes.len()), (8, 4), "copies are not welded to each other");
        let skinned = square(|d| d["nodes"][0] = json!({ "mesh": 0, "skin": 0, "translation": [2, 0, 0] }));
        assert_eq!(read(&skinned), read(&square(|_| ())));
    }

    #[test]
    fn quantised_positions_are_misread() {
        let bytes = |numbers: &[u8]| [numbers, &square_bytes()[60..]].concat();
        let with = |component: u32, normalized: bool, stride: usize, numbers: &[u8]| {
            let soup = read(&square(|d| {
                d["extensionsRequired"] = json!(["KHR_mesh_quantization", "KHR_materials_unlit"]);
                d["accessors"][0]["componentType"] = json!(component);
                d["accessors"][0]["normalized"] = json!(normalized);
                d["accessors"][0]["count"] = json!(4);
                d["bufferViews"][0] = json!({ "buffer": 0, "byteLength": numbers.len(), "byteStride": stride });
                d["bufferViews"][1]["byteOffset"] = json!(numbers.len());
                d["buffers"][0] = json!({ "byteLength": numbers.len() + 12, "uri": uri(&bytes(numbers)) });
            }));
            soup.expect("a square of integers").positions
        };
        let i8s: [i8; 16] = [0, 0, 0, 9, 127, 0, 0, 9, 0, -128, 0, 9, 127, -128, 0, 9];
        let i8s = i8s.map(|x| x as u8);
        assert_eq!(with(5120, true, 4, &i8s)[3], [1.0, -1.0, 0.0]);
        assert_eq!(with(5120, false, 4, &i8s)[3], [127.0, -128.0, 0.0]);
        assert_eq!(with(U8, true, 4, &[0, 0, 0, 9, 255, 0, 0, 9, 0, 51, 0, 9, 255, 51, 0, 9])[3], [1.0, 0.2, 0.0]);
        let u16s: Vec<u8> =
            [0, 0, 0, 65535, 0, 0, 0, 13107, 0, 1, 2, 3].iter().flat_map(|x: &u16| x.to_le_bytes()).collect();
        assert_eq!(with(U16, true, 6, &u16s)[2], [0.0, 0.2, 0.0]);
        let i16s: Vec<u8> =
            [0, 0, 0, -32768, 0, 0, 0, 32767, 0, 1, 2, 3].iter().flat_map(|x: &i16| x.to_le_bytes()).collect();
        assert_eq!(with(5122, true, 6, &i16s)[1], [-1.0, 0.0, 0.0]);
        assert_eq!(with(5122, false, 6, &i16s)[2], [0.0, 32767.0, 0.0]);
    }

    #[test]
    fn a_broken_gltf_is_blamed_elsewhere() {
        type Change = fn(&mut Value);
        let range = |what, index, count| GltfFault::OutOfRange { what, index, count };
        let cases: [(Change, &str, GltfFault); 20] = [
            (|d| d["scene"] = json!(1), "scene", range("scene", 1, 1)),
            (|d| d["scenes"][0]["nodes"] = json!([4]), "scenes", range("node", 4, 1)),
            (|d| d["nodes"][0]["mesh"] = json!(1), "nodes[0]", range("mesh", 1, 1)),
            (|d| d["nodes"][0]["children"] = json!([0]), "nodes[0]", GltfFault::ReachedTwice),
            (
                |d| d["nodes"][0]["scale"] = json!([1, 1e39, 1]),
                "meshes[0].primitives[0]",
                GltfFault::NotFinite { vertex: 2 },
            ),
            (
                |d| d["meshes"][0]["primitives"][0]["indices"] = json!(9),
                "meshes[0].primitives[0]",
                range("accessor", 9, 2),
            ),
            (|d| d["accessors"][0]["count"] = json!(3), "meshes[0].primitives[0]", range("vertex", 3, 3)),
            (
                |d| d["accessors"][1]["count"] = json!(5),
                "meshes[0].primitives[0]",
                GltfFault::NotTriples { corners: 5 },
            ),
            (
                |d| d["accessors"][1]["componentType"] = json!(F32),
                "accessors[1]",
                GltfFault::Type { found: "SCALAR of 5126".into(), expected: "indices: SCALAR of unsigned integers" },
            ),
            (
                |d| d["accessors"][0]["componentType"] = json!(U32),
                "accessors[0]",
                GltfFault::Type { found: "VEC3 of 5125".into(), expected: "positions: VEC3 of floats or quantised" },
            ),
            (|d| d["accessors"][0]["sparse"] = json!({}), "accessors[0]", GltfFault::Sparse),
            (|d| d["accessors"][0]["bufferView"] = Value::Null, "accessors[0]", GltfFault::Sparse),
            (|d| d["accessors"][0]["count"] = json!(6), "accessors[0]", GltfFault::CutOff { needed: 72, room: 60 }),
            (
                |d| d["accessors"][0]["count"] = json!(u64::MAX),
                "accessors[0]",
                GltfFault::CutOff { needed: u64::MAX, room: 60 },
            ),
            (
                |d| d["bufferViews"][0]["byteStride"] = json!(0),
                "accessors[0]",
                GltfFault::Type {
                    found: "a stride of 0 bytes".into(),
                    expected: "positions: VEC3 of floats or quantised",
                },
            ),
            (
                |d| d["bufferViews"][1]["byteOffset"] = json!(61),
                "bufferViews[1]",
                GltfFault::CutOff { needed: 12, room: 11 },
            ),
            (|d| d["bufferViews"][0]["buffer"] = json!(1), "bufferViews[0]", range("buffer", 1, 1)),
            (
                |d| d["buffers"][0]["uri"] = json!("square.bin"),
                "buffers[0]",
                GltfFault::External { uri: "square.bin".into() },
            ),
            (|d| d["buffers"][0]["uri"] = json!("data:;base64,A"), "buffers[0]", GltfFault::NotBase64),
            (|d| d["buffers"][0] = json!({ "byteLength": 1 }), "buffers[0]", GltfFault::NoData),
        ];
        for (change, place, what) in cases {
            let error = read(&square(change)).expect_err(place);
            assert_eq!((&*error.place, &error.what), (place, &what));
        }
        let error = |change: Change| read(&square(change)).expect_err("broken").to_string();
        let draco = error(|d| d["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]));
        assert!(draco.contains("needs the extension KHR_draco_mesh_compression"), "{draco}");
        assert!(error(|d| d["asset"]["version"] = json!("1.0")).contains("glTF 1.0 is not read"));
        assert!(error(|d| d["accessors"][0]["count"] = json!(-1)).contains("line 1 column"));
        assert!(error(|d| d["buffers"][0]["uri"] = json!("a.bin")).contains("save as .glb"));

        let mut bytes = square_glb();
        bytes[4] = 1;
        assert_eq!(read(&bytes).map_err(|e| e.what), Err(GltfFault::Version { found: "1".into() }));
        bytes[4] = 2;
        bytes.pop();
        let error = read(&bytes).expect_err("cut off");
        assert!(matches!(error.what, GltfFault::CutOff { .. }) && error.place == "byte 0", "{error}");
    }

    #[test]
    fn many_copies_take_more_than_the_file_could_hold() {
        // Each copy has six corners, and the file has far fewer bytes than corners.
        let bytes = square(|d| {
            let n = 1_000_000;
            d["accessors"][1]["count"] = json!(600);
            d["accessors"][1]["componentType"] = json!(U8);
            d["bufferViews"][1] = json!({ "buffer": 0, "byteLength": 600 });
            d["buffers"][0]["uri"] = json!(uri(&[0; 600]));
            d["scenes"][0]["nodes"] = json!((0..n / 60).collect::<Vec<_>>());
            d["nodes"] = json!(vec![json!({ "mesh": 0 }); n / 60]);
        });
        let error = read(&bytes).expect_err("ten million corners");
        assert_eq!(error.what, GltfFault::TooLarge { limit: 1 << 22 });
    }

    #[test]
    fn a_written_glb_is_not_gltf() {
        let normals: Vec<[f64; 3]> =
            cube_positions().iter().map(|p| p.map(|x| (x - 0.5) * 2.0 / 3.0_f64.sqrt())).collect();
        let bytes = write(&quads(), Some(&normals)).expect("consistent");
        assert_eq!(read(&bytes), Ok(cube()));

        let (document, buffers, _) = ::gltf::import_slice(&bytes).expect("the crate's validation passes");
        let mesh = document.default_scene().and_then(|s| s.nodes().next()).and_then(|n| n.mesh()).expect("one mesh");
        let primitive = mesh.primitives().next().expect("one primitive");
        let bounds = primitive.bounding_box();
        assert_eq!((bounds.min, bounds.max), ([0.0; 3], [1.0; 3]));
        let reader = primitive.reader(|buffer| Some(&buffers[buffer.index()]));
        let indices: Vec<u32> = reader.read_indices().expect("indices").into_u32().collect();
        assert_eq!(indices, *cube_triangles().as_flattened());
        let positions: Vec<[f32; 3]> = reader.read_positions().expect("positions").collect();
        assert_eq!(positions, (0..8).map(cube_corner).collect::<Vec<_>>());
        let read_normals: Vec<[f32; 3]> = reader.read_normals().expect("normals").collect();
        assert_eq!(read_normals, normals.iter().map(|n| n.map(|x| x as f32)).collect::<Vec<_>>());

        let bare = write(&Soup { holes: vec![0, 1, 2, 3, 4], ..quads() }, None).expect("one side");
        let (document, ..) = ::gltf::import_slice(&bare).expect("the crate's validation passes");
        assert_eq!(document.accessors().map(|a| a.count()).collect::<Vec<_>>(), [8, 6]);
        let empty = Soup { holes: (0..6).collect(), ..quads() };
        assert_eq!(write(&empty, None), Err(WriteError::Empty { format: Format::Glb }));
    }
}
