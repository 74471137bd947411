//! Every shader parses, validates, and declares the shared block alike; no device is needed.
#![cfg(feature = "graphics")]

use londra::render::{ShaderFile, ShaderSources};

#[test]
fn every_shader_is_valid() {
    let sources = ShaderSources::default();
    for file in ShaderFile::ALL {
        sources.check(file).unwrap_or_else(|e| panic!("shaders/{e}"));
    }
}

#[test]
fn no_file_in_the_folder_is_left_out() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders");
    let mut on_disk: Vec<String> = std::fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".wgsl"))
        .collect();
    on_disk.sort();
    let mut known = ShaderFile::ALL.map(|f| f.file_name().to_owned());
    known.sort();
    assert_eq!(on_disk, known);
}

#[test]
fn every_shader_declares_the_same_globals() {
    let sources = ShaderSources::default();
    let block = |file: ShaderFile| {
        let text = sources.text(file);
        let start = text.find("struct Globals").expect("each shader declares Globals");
        let end = start + text[start..].find("var<uniform> globals").expect("and binds it");
        text[start..end].to_owned()
    };
    for file in ShaderFile::ALL {
        assert_eq!(block(file), block(ShaderFile::Mesh), "{}", file.file_name());
    }
}

#[test]
fn a_broken_shader_is_reported_with_its_place() {
    let mut sources = ShaderSources::default();
    let text = sources.text(ShaderFile::Wire).to_owned();
    sources.replace(ShaderFile::Wire, format!("\n\n{text}\nfn broken( {{"));
    let error = sources.check(ShaderFile::Wire).unwrap_err();
    assert_eq!(error.file, "wire.wgsl");
    assert_eq!(error.line as usize, text.lines().count() + 4);
    assert!(error.column > 1);

    sources.replace(ShaderFile::Wire, "fn f() -> f32 {\n    let a: f32 = 1u;\n    return a;\n}\n".into());
    let error = sources.check(ShaderFile::Wire).unwrap_err();
    assert_eq!((error.line, error.file), (2, "wire.wgsl"), "{error}");
}
