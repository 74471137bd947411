//! What stands behind the head: a plain or graded ground, or nothing.

use super::shader_source::{ShaderError, ShaderFile, ShaderSources, build_checked};
use super::targets::{COLOUR, depth, samples};
use glam::Vec4;

/// Behind the head. Colours are sRGB bytes as written in files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Background {
    /// Transparent.
    None,
    /// One colour.
    Plain([u8; 3]),
    /// From one colour at the upper edge to another at the lower.
    Graded([u8; 3], [u8; 3]),
}

impl Default for Background {
    /// A quiet warm grey, a little lighter above: dark and pale coats both stand out from it.
    fn default() -> Self {
        Self::Graded([0x8f, 0x8e, 0x8b], [0x6d, 0x6c, 0x6a])
    }
}

impl Background {
    /// Top and bottom, sRGB from 0 to 1, with alpha.
    pub(super) fn edges(self) -> [Vec4; 2] {
        let colour = |[r, g, b]: [u8; 3]| Vec4::new(f32::from(r), f32::from(g), f32::from(b), 255.0) / 255.0;
        match self {
            Self::None => [Vec4::ZERO; 2],
            Self::Plain(c) => [colour(c); 2],
            Self::Graded(top, bottom) => [colour(top), colour(bottom)],
        }
    }
}

/// Cells of the picture a side; `background.wgsl` knows it too.
const CELLS: u32 = 64;

/// A grid over the whole picture, since the head's shadow on the ground is worked out at its corners.
#[derive(Debug)]
pub(super) struct GroundPass {
    pipeline: wgpu::RenderPipeline,
}

impl GroundPass {
    pub(super) fn new(
        device: &wgpu::Device,
        sources: &ShaderSources,
        globals: &wgpu::BindGroupLayout,
        lit: &wgpu::BindGroupLayout,
    ) -> Result<Self, ShaderError> {
        let module = sources.compile(device, ShaderFile::Background)?;
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("ground"),
            bind_group_layouts: &[Some(globals), Some(lit)],
            immediate_size: 0,
        });
        let pipeline = build_checked(device, ShaderFile::Background, || {
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("ground"),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("vertex"),
                    compilation_options: Default::default(),
                    buffers: &[],
                },
                primitive: Default::default(),
                depth_stencil: depth(false, wgpu::CompareFunction::Always),
                multisample: samples(),
                fragment: Some(wgpu::FragmentState {
                    module: &module,
                    entry_point: Some("fragment"),
                    compilation_options: Default::default(),
                    targets: &[Some(COLOUR.into())],
                }),
                multiview_mask: None,
                cache: None,
            })
        })?;
        Ok(Self { pipeline })
    }

    /// Draws over everything; the globals are bound as group 0. `lit`: shadow maps and noise.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>, lit: &wgpu::BindGroup) {
        pass.set_bind_group(1, lit, &[]);
        pass.set_pipeline(&self.pipeline);
        pass.draw(0..6 * CELLS * CELLS, 0..1);
    }
}
