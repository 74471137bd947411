//! The text of the shaders: embedded in the program, replaced from disk while somebody works on them.

use thiserror::Error;
use wgpu::naga;

/// One file of `shaders/`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ShaderFile {
    /// The block that all the others read.
    Globals,
    /// Light and film, which all lit surfaces share.
    Light,
    /// Hair as it is today and the light it sends back, which strands and streaked skin share.
    Hair,
    /// The head's surfaces.
    Mesh,
    /// Lines over the head.
    Wire,
    /// What stands behind the head.
    Background,
    /// Depth seen from the key light.
    Shadow,
    /// A plan evaluated on the card.
    Subdivide,
    /// Hair.
    Strand,
}

/// A shader that does not compile, with the place to look at.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{file}:{line}:{column}: {message}")]
pub struct ShaderError {
    /// File name without folder.
    pub file: &'static str,
    /// From 1; 1 when the driver names no place.
    pub line: u32,
    /// From 1; 1 when the driver names no place.
    pub column: u32,
    /// What is wrong, on one line.
    pub message: String,
}

impl ShaderFile {
    /// Every file.
    pub const ALL: [Self; 9] = [
        Self::Globals,
        Self::Light,
        Self::Hair,
        Self::Mesh,
        Self::Wire,
        Self::Background,
        Self::Shadow,
        Self::Subdivide,
        Self::Strand,
    ];

    /// File name inside `shaders/`.
    pub fn file_name(self) -> &'static str {
        match self {
            Self::Globals => "globals.wgsl",
            Self::Light => "light.wgsl",
            Self::Hair => "hair.wgsl",
            Self::Mesh => "mesh.wgsl",
            Self::Wire => "wire.wgsl",
            Self::Background => "background.wgsl",
            Self::Shadow => "shadow.wgsl",
            Self::Subdivide => "subdivide.wgsl",
            Self::Strand => "strand.wgsl",
        }
    }

    /// Whether the block of globals belongs to it: to all that draw.
    pub fn reads_globals(self) -> bool {
        !matches!(self, Self::Globals | Self::Subdivide)
    }

    /// Whether light and film belong to it.
    fn reads_light(self) -> bool {
        self.reads_hair() || self == Self::Hair
    }

    /// Whether hair belongs to it.
    fn reads_hair(self) -> bool {
        matches!(self, Self::Mesh | Self::Strand)
    }
}

/// The text of every shader.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShaderSources {
    texts: [String; ShaderFile::ALL.len()],
}

impl Default for ShaderSources {
    /// Those built into the program.
    fn default() -> Self {
        let texts = [
            include_str!("../../shaders/globals.wgsl"),
            include_str!("../../shaders/light.wgsl"),
            include_str!("../../shaders/hair.wgsl"),
            include_str!("../../shaders/mesh.wgsl"),
            include_str!("../../shaders/wire.wgsl"),
            include_str!("../../shaders/background.wgsl"),
            include_str!("../../shaders/shadow.wgsl"),
            include_str!("../../shaders/subdivide.wgsl"),
            include_str!("../../shaders/strand.wgsl"),
        ];
        Self { texts: texts.map(str::to_owned) }
    }
}

impl ShaderSources {
    /// The text of one file.
    pub fn text(&self, file: ShaderFile) -> &str {
        &self.texts[file as usize]
    }

    /// Takes another text for one file.
    pub fn replace(&mut self, file: ShaderFile, text: String) {
        self.texts[file as usize] = text;
    }

    /// A file as it is compiled: what it shares with others comes behind it, so that its own lines keep their numbers.
    fn composed(&self, file: ShaderFile) -> String {
        let hair = file.reads_hair().then_some(ShaderFile::Hair);
        let light = file.reads_light().then_some(ShaderFile::Light);
        let globals = file.reads_globals().then_some(ShaderFile::Globals);
        let files = [Some(file), hair, light, globals].into_iter().flatten();
        files.map(|f| self.text(f)).collect::<Vec<_>>().join("\n")
    }

    /// Parses and validates one file without a device.
    pub fn check(&self, file: ShaderFile) -> Result<(), ShaderError> {
        if file.reads_globals() {
            self.check(ShaderFile::Globals)?;
        }
        if file.reads_light() {
            self.check(ShaderFile::Light)?;
        }
        if file.reads_hair() {
            self.check(ShaderFile::Hair)?;
        }
        let source = &self.composed(file);
        // Something left open at the end is noticed in what comes behind it, which is right.
        let n_lines = self.text(file).lines().count().max(1) as u32;
        let error = |place: Option<naga::SourceLocation>, message: String| ShaderError {
            file: file.file_name(),
            line: place.map_or(1, |p| p.line_number.min(n_lines)),
            column: place.map_or(1, |p| p.line_position),
            message: message.replace('\n', " "),
        };
        let module =
            naga::front::wgsl::parse_str(source).map_err(|e| error(e.location(source), e.message().to_owned()))?;
        let (flags, capabilities) = (naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty());
        naga::valid::Validator::new(flags, capabilities)
            .validate(&module)
            .map_err(|e| error(e.location(source), root_cause(e.as_inner())))?;
        Ok(())
    }

    /// Checks one file and hands it to the driver.
    pub(super) fn compile(&self, device: &wgpu::Device, file: ShaderFile) -> Result<wgpu::ShaderModule, ShaderError> {
        self.check(file)?;
        Ok(device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(file.file_name()),
            source: wgpu::ShaderSource::Wgsl(self.composed(file).into()),
        }))
    }
}

/// The outermost message with the innermost, which names the thing that is wrong.
fn root_cause(error: &dyn std::error::Error) -> String {
    let mut last = error;
    while let Some(inner) = last.source() {
        last = inner;
    }
    let (outer, inner) = (error.to_string(), last.to_string());
    if outer == inner { outer } else { format!("{outer}: {inner}") }
}

/// Runs `build` and turns what the driver holds against it into an error of `file`.
pub(super) fn build_checked<T>(
    device: &wgpu::Device,
    file: ShaderFile,
    build: impl FnOnce() -> T,
) -> Result<T, ShaderError> {
    let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
    let built = build();
    match pollster::block_on(scope.pop()) {
        None => Ok(built),
        Some(e) => {
            Err(ShaderError { file: file.file_name(), line: 1, column: 1, message: e.to_string().replace('\n', " ") })
        }
    }
}
