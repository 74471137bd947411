//! OBJ files: every way to write a face, and every way to write one wrongly.

use glam::Vec3;
use londra::io::obj::{ObjError, ObjFault, read, write};
use londra::math::rng::Rng;
use londra::mesh::shapes::cabinet;

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvn 0 0 1\n";

fn triangles(faces: &str) -> Result<Vec<[u32; 3]>, ObjError> {
    read(format!("{SQUARE}{faces}").as_bytes()).map(|mesh| mesh.triangles)
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
fn a_polygon_is_not_cut_into_a_fan() {
    assert_eq!(triangles("f 1 2 3 4"), Ok(vec![[0, 1, 2], [0, 2, 3]]));
    assert_eq!(triangles("f 2/1 3/1 4/1 1/1"), Ok(vec![[1, 2, 3], [1, 3, 0]]));
}

#[test]
fn a_statement_without_geometry_is_an_error() {
    let text = "\u{feff}# d\u{e9}j\u{e0} vu\nmtllib x.mtl\no head\ng a b\ns off\nusemtl fur\nl 1 2\nvp 1\n\n";
    assert_eq!(read(text.as_bytes()).map(|m| m.triangles.len()), Ok(0));
    assert_eq!(
        read(b"# \xff\xfe not UTF-8\nv 1 2 3 # \xe9\n").map(|m| m.positions),
        Ok(vec![Vec3::new(1.0, 2.0, 3.0)])
    );
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

#[test]
fn writing_and_reading_changes_a_mesh() {
    for shape in cabinet() {
        for normals in [None, Some(&shape.positions[..])] {
            let text = write(&shape.positions, normals, &shape.triangles);
            let back = read(text.as_bytes()).unwrap_or_else(|e| panic!("{}: {e}", shape.name));
            assert_eq!((back.positions, back.triangles), (shape.positions.clone(), shape.triangles.clone()));
        }
    }
}

#[test]
fn a_float_loses_bits_on_the_way() {
    let mut rng = Rng::new(3);
    let floats: Vec<f32> =
        std::iter::repeat_with(|| f32::from_bits(rng.next_u32())).filter(|x| x.is_finite()).take(3000).collect();
    let positions: Vec<Vec3> = floats.as_chunks::<3>().0.iter().map(|&p| p.into()).collect();
    let back = read(write(&positions, None, &[]).as_bytes()).expect("what was written").positions;
    let bits = |v: &[Vec3]| v.iter().flat_map(|p| p.to_array().map(f32::to_bits)).collect::<Vec<_>>();
    assert_eq!(bits(&back), bits(&positions));
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
