//! Every shader parses and validates, the shared block included; no device is needed.
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
fn the_globals_are_declared_twice() {
    let sources = ShaderSources::default();
    for file in ShaderFile::ALL {
        let n = sources.text(file).matches("struct Globals").count();
        assert_eq!(n, usize::from(file == ShaderFile::Globals), "{}", file.file_name());
    }
}

#[test]
fn a_mistake_in_the_globals_is_looked_for_in_another_file() {
    let mut sources = ShaderSources::default();
    let text = sources.text(ShaderFile::Globals).replace("rim: vec4<f32>", "rim: vec9<f32>");
    let line = text.lines().position(|l| l.contains("vec9")).unwrap() as u32 + 1;
    sources.replace(ShaderFile::Globals, text);
    for file in ShaderFile::ALL.into_iter().filter(|file| file.reads_globals()) {
        let error = sources.check(file).unwrap_err();
        assert_eq!((error.file, error.line), ("globals.wgsl", line), "{error}");
    }
    sources.check(ShaderFile::Subdivide).unwrap_or_else(|e| panic!("shaders/{e}"));
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

    let text = "fn f() -> f32 {\n    return 1.0;\n";
    sources.replace(ShaderFile::Wire, text.into());
    let error = sources.check(ShaderFile::Wire).unwrap_err();
    assert_eq!((error.line, error.file), (2, "wire.wgsl"), "{error}");
}
