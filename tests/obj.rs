//! OBJ files: every way to write a face or a tag, and every way to write one wrongly.

use londra::io::Soup;
use londra::io::obj::{ObjError, ObjFault, read, write};
use londra::math::rng::Rng;
use londra::mesh::shapes::cabinet;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";

fn triangles(faces: &str) -> Result<Vec<[u32; 3]>, ObjError> {
    read(format!("{SQUARE}{faces}").as_bytes()).map(|soup| soup.triangles())
}

#[test]
fn a_form_of_corner_is_misread() {
    for face in [
        "f 1 2 3",
        "f 1/1 2/1 3/1",
        "f 1//1 2//1 3//1",
        "f 1/1/1 2/1/1 3/1/1",
        "f -4 -3 -2",
        "f -4//-1 -3//1 -2/-1/1",
        "  f\t1  2 3 ",
        "f 1 2 3\r",
        "f 1 2 3 # and a comment",
        "f 1 \\\n2 \\\r\n3",
        "f 1 2 \\\n3",
        "f 1 2 3\\",
    ] {
        assert_eq!(triangles(face), Ok(vec![[0, 1, 2]]), "{face:?}");
    }
}

#[test]
fn a_polygon_is_cut_in_the_file_or_not_into_a_fan_after() {
    let soup = read(format!("{SQUARE}f 1 2 3 4\nf 4 3 2").as_bytes()).expect("two faces");
    assert_eq!((&soup.face_sizes[..], &soup.corners[..]), (&[4, 3][..], &[0, 1, 2, 3, 3, 2, 1][..]));
    assert_eq!(soup.faces().collect::<Vec<_>>(), [&[0, 1, 2, 3][..], &[3, 2, 1]]);
    assert!(!soup.is_triangles());
    assert_eq!(soup.triangles(), [[0, 1, 2], [0, 2, 3], [3, 2, 1]]);
    assert_eq!(triangles("f 2/1 3/1 4/1 1/1"), Ok(vec![[1, 2, 3], [1, 3, 0]]));
}

#[test]
fn texture_coordinates_are_lost_or_kept_where_a_corner_has_none() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nvt 0.5\nvt 0.25 0.75 0\nf 1/1 2/2 3/-1\n";
    let soup = read(text.as_bytes()).expect("a triangle");
    assert_eq!((soup.uvs, soup.uv_corners), (vec![[0.5, 0.0], [0.25, 0.75]], vec![0, 1, 1]));
    let soup = read(format!("{text}f 1/1 2 3").as_bytes()).expect("two triangles");
    assert_eq!((soup.uvs.len(), soup.uv_corners.len()), (2, 0));
}

#[test]
fn a_statement_without_geometry_is_an_error() {
    let text = "\u{feff}# d\u{e9}j\u{e0} vu\nmtllib x.mtl\no head\ng a b\ns off\nusemtl fur\nl 1 2\nvp 1\n\n";
    assert_eq!(read(text.as_bytes()).map(|soup| soup.face_sizes.len()), Ok(0));
    assert_eq!(read(b"# \xff\xfe not UTF-8\nv 1 2 3 # \xe9\n").map(|m| m.positions), Ok(vec![[1.0, 2.0, 3.0]]));
    assert_eq!(read(b"v 1 2 3 0.5\nv 1 2 3 0.1 0.2 0.3").map(|m| m.positions.len()), Ok(2));
    assert_eq!(read(b"").map(|m| m.positions.len()), Ok(0));
}

#[test]
fn a_wrong_line_is_accepted_or_blamed_elsewhere() {
    let corner = |text: &str| ObjFault::NotACorner { text: text.into() };
    let number = |text: &str| ObjFault::NotANumber { text: text.into() };
    let range = |kind, index, count| ObjFault::OutOfRange { kind, index, count };
    let cases = [
        ("v 1 2", ObjFault::TooFewCoordinates { found: 2 }),
        ("v", ObjFault::TooFewCoordinates { found: 0 }),
        ("v 1 two 3", number("two")),
        ("v 1 nan 3", number("nan")),
        ("v 1 2 inf", number("inf")),
        ("v 1 2 1e60", number("1e60")),
        ("vt", ObjFault::NoTextureCoordinate),
        ("vt 0 x", number("x")),
        ("f", ObjFault::TooFewCorners { found: 0 }),
        ("f 1", ObjFault::TooFewCorners { found: 1 }),
        ("f 1 2", ObjFault::TooFewCorners { found: 2 }),
        ("f 1 2 0", corner("0")),
        ("f 1 2 3.5", corner("3.5")),
        ("f 1 2 x", corner("x")),
        ("f 1 2 3/", corner("3/")),
        ("f 1 2 3//", corner("3//")),
        ("f 1 2 3/1/", corner("3/1/")),
        ("f 1 2 3/1/1/1", corner("3/1/1/1")),
        ("f 1 2 /1", corner("/1")),
        ("f 1 2 3/0", corner("3/0")),
        ("f 1 2 99999999999999999999", corner("99999999999999999999")),
        ("f 1 2 5", range("v", 5, 4)),
        ("f 1 2 -5", range("v", -5, 4)),
        ("f 1 2 3/2", range("vt", 2, 1)),
        ("f 1 2 3//-2", range("vn", -2, 1)),
    ];
    for (line, what) in cases {
        let error = triangles(&format!("\n{line}\nf 1 2 3"));
        assert_eq!(error, Err(ObjError { line: 8, what }), "{line:?}");
    }
    let error = triangles("f 1 2 \\\n 3 \\\n 9").expect_err("vertex 9");
    assert_eq!(error.to_string(), "line 7: v 9 does not exist: there are 4 so far");
}

/// A square and a pentagon that share the edge from vertex 1 to vertex 2.
const HOUSE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 3 0.5 0\nv 2 1 0\nf 1 2 3 4\nf -6 -3 -2 -1 -5\n";

fn tagged(tags: &str) -> Result<Soup, ObjError> {
    read(format!("{HOUSE}{tags}").as_bytes())
}

#[test]
fn a_tag_that_opensubdiv_reads_is_read_otherwise() {
    const FOREVER: f32 = f32::INFINITY;
    let creases = |tags| tagged(tags).map(|soup| soup.creases);
    assert_eq!(creases("t crease 2/1/0 2 1 2.5"), Ok(vec![(2, 1, 2.5)]));
    assert_eq!(creases("t  crease  2/1/0  1 2  10.0 \r"), Ok(vec![(1, 2, FOREVER)]));
    assert_eq!(creases("t crease 4/1/0 1 2 2 3 3"), Ok(vec![(1, 2, 3.0), (2, 3, 3.0)]));
    assert_eq!(creases("t crease 4/2/0 1 2 2 3 3 4"), Ok(vec![(1, 2, 3.0), (2, 3, 4.0)]));
    assert_eq!(creases("t crease 4/4/0 1 2 2 3 3 0 4 0"), Ok(vec![(1, 2, 3.0), (2, 3, 4.0)]));
    assert_eq!(creases("t crease 2/1/1 1 2 9.999 name"), Ok(vec![(1, 2, 9.999)]));
    // The last tag holds, whichever way the edge is named; a smooth edge has no tag.
    assert_eq!(creases("t crease 2/1/0 1 2 1\nt crease 2/1/0 2 1 inf"), Ok(vec![(1, 2, FOREVER)]));
    assert_eq!(creases("t crease 2/1/0 1 2 1\nt crease 2/1/0 2 1 -1"), Ok(vec![]));

    let corners = |tags| tagged(tags).map(|soup| soup.point_creases);
    assert_eq!(corners("t corner 1/1/0 3 0.5"), Ok(vec![(3, 0.5)]));
    assert_eq!(corners("t corner 2/1/0 3 0 11"), Ok(vec![(3, FOREVER), (0, FOREVER)]));
    assert_eq!(corners("t corner 2/2/0 3 0 1 2"), Ok(vec![(3, 1.0), (0, 2.0)]));
    assert_eq!(tagged("t hole 2/0/0 1 0\nt hole 1/0/0 1").map(|soup| soup.holes), Ok(vec![0, 1]));

    let early = read(format!("t hole 1/0/0 0\nt crease 2/1/0 0 1 1\n{HOUSE}").as_bytes()).expect("tags first");
    assert_eq!((early.holes, early.creases), (vec![0], vec![(0, 1, 1.0)]));
    let others = "t interpolateboundary 1/0/0 2\nt creasemethod 0/0/1 chaikin\nt\nt what ever";
    assert_eq!(tagged(others), tagged(""));
}

#[test]
fn a_wrong_tag_is_accepted_or_blamed_elsewhere() {
    let values = |tag, expected, found| ObjFault::TagValues { tag, expected, found };
    let range = |kind, index, count| ObjFault::TagOutOfRange { kind, index, count };
    let cases = [
        ("t crease 2/1/0 1 2", values("crease", 3, 2)),
        ("t crease 2/1/0 1 2 3 4", values("crease", 3, 4)),
        ("t crease 18446744073709551615/2/0 1 2 3", values("crease", usize::MAX, 3)),
        ("t crease 2/1/0 1 x 3", ObjFault::NotANumber { text: "x".into() }),
        ("t corner 1/1/0 1 nan", ObjFault::NotANumber { text: "nan".into() }),
        ("t crease 2/1/0 0 2 1", ObjFault::NotAnEdge { a: 0, b: 2 }),
        ("t crease 2/1/0 0 0 1", ObjFault::NotAnEdge { a: 0, b: 0 }),
        ("t crease 2/1/0 0 7 1", range("vertex", 7, 7)),
        ("t corner 1/1/0 -1 1", range("vertex", -1, 7)),
        ("t hole 1/0/0 2", range("face", 2, 2)),
    ];
    for (line, what) in cases {
        assert_eq!(tagged(&format!("\n{line}\n#")), Err(ObjError { line: 11, what }), "{line:?}");
    }
    for (line, message) in [
        ("t crease", "line 10: a crease needs the numbers of its values"),
        ("t hole 1/0", "line 10: a hole needs the numbers of its values"),
        ("t crease 3/1/0 0 1 2 1", "line 10: a crease cannot have 3 whole numbers and 1 sharpnesses"),
        ("t crease 2/0/0 0 1", "line 10: a crease cannot have 2 whole numbers and 0 sharpnesses"),
        ("t corner 3/2/0 0 1 2 1 1", "line 10: a corner cannot have 3 whole numbers and 2 sharpnesses"),
    ] {
        let error = tagged(line).expect_err(line).to_string();
        assert!(error.starts_with(message), "{error}");
    }
}

#[test]
fn writing_and_reading_changes_a_mesh() {
    let uvs = "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\nf 1/3 3/2 4/1\n";
    let tags = "t crease 4/2/0 0 1 1 2 0.3 10\nt corner 1/1/0 3 2.25\nt hole 1/0/0 1";
    let soups = [tagged(tags), read(format!("{SQUARE}{uvs}").as_bytes())].map(|soup| soup.expect("written above"));
    let shapes = cabinet().into_iter().map(|shape| {
        let positions = shape.positions.iter().map(|p| p.as_dvec3().to_array()).collect();
        Soup::from_triangles(positions, &shape.triangles)
    });
    for soup in soups.into_iter().chain(shapes) {
        for normals in [None, Some(&soup.positions[..])] {
            let text = write(&soup, normals).expect("a consistent soup");
            let back = read(text.as_bytes()).expect("what was written");
            assert_eq!(in_32_bits(&back), in_32_bits(&soup), "{text}");
        }
    }
}

/// The soup as the engine sees it.
fn in_32_bits(soup: &Soup) -> Soup {
    let positions = soup.positions.iter().map(|p| p.map(|x| f64::from(x as f32))).collect();
    Soup { positions, ..soup.clone() }
}

#[test]
fn a_float_loses_bits_on_the_way() {
    let mut rng = Rng::new(3);
    let random = std::iter::repeat_with(|| f32::from_bits(rng.next_u32())).filter(|x| x.is_finite()).take(30_000);
    let floats: Vec<f32> =
        [0.0, -0.0, f32::MIN_POSITIVE, f32::MAX, f32::MIN, f32::from_bits(1)].into_iter().chain(random).collect();
    let positions: Vec<[f64; 3]> = floats.as_chunks().0.iter().map(|p: &[f32; 3]| p.map(f64::from)).collect();
    let text = write(&Soup { positions: positions.clone(), ..Soup::default() }, None).expect("vertices alone");
    let back = read(text.as_bytes()).expect("what was written").positions;
    let bits = |v: &[[f64; 3]]| v.as_flattened().iter().map(|&x| (x as f32).to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(&back), bits(&positions));
    let longest = text.split_ascii_whitespace().map(str::len).max();
    assert_eq!(longest, Some("-0.0000123456789".len()), "nine digits are enough for 32 bits");
}

#[test]
fn an_inconsistent_mesh_is_written() {
    let triangle = read(format!("{SQUARE}f 1 2 3").as_bytes()).expect("a triangle");
    let soups = [
        Soup { face_sizes: vec![2], corners: vec![0, 1], ..triangle.clone() },
        Soup { face_sizes: vec![4], ..triangle.clone() },
        Soup { corners: vec![0, 1, 4], ..triangle.clone() },
        Soup { uv_corners: vec![0, 0], ..triangle.clone() },
        Soup { uv_corners: vec![0, 0, 1], ..triangle.clone() },
        Soup { holes: vec![1], ..triangle.clone() },
        Soup { creases: vec![(0, 4, 1.0)], ..triangle.clone() },
        Soup { point_creases: vec![(4, 1.0)], ..triangle.clone() },
        Soup { positions: vec![[1e60, 0.0, 0.0]; 4], ..triangle.clone() },
    ];
    for soup in soups {
        assert!(write(&soup, None).is_err(), "{soup:?}");
    }
    assert!(write(&triangle, Some(&[[0.0; 3]; 3])).is_err(), "three normals for four vertices");
}

#[test]
fn garbage_makes_the_reader_panic() {
    let mut rng = Rng::new(11);
    let alphabet = b"vf vtn/-#\\\n\r0129.e \xff";
    for _ in 0..20_000 {
        let bytes: Vec<u8> = (0..rng.below(40)).map(|_| alphabet[rng.below(alphabet.len())]).collect();
        let _ = read(&bytes);
    }
}
