//! Depth of the head seen from the key light and from the rim light.

use super::head_buffers::HeadBuffers;
use super::mesh_pass::{Quality, is_skin};
use super::shader_source::{ShaderError, ShaderFile, ShaderSources, build_checked};
use super::targets::DEPTH;

/// Side of the key light's map and of the rim light's, texels.
pub(super) const TEXELS: [u32; 2] = [1536, 768];

/// The maps and the pipelines that fill them: the key light's, then the rim light's.
#[derive(Debug)]
pub(super) struct ShadowPass {
    pipelines: [wgpu::RenderPipeline; 2],
    /// To be sampled with comparison, or read.
    pub(super) maps: [wgpu::TextureView; 2],
}

impl ShadowPass {
    pub(super) fn new(
        device: &wgpu::Device,
        sources: &ShaderSources,
        globals: &wgpu::BindGroupLayout,
    ) -> Result<Self, ShaderError> {
        let module = sources.compile(device, ShaderFile::Shadow)?;
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shadow"),
            bind_group_layouts: &[Some(globals)],
            immediate_size: 0,
        });
        let pipelines = build_checked(device, ShaderFile::Shadow, || {
            [false, true].map(|of_rim| pipeline(device, &module, &layout, of_rim))
        })?;
        Ok(Self { pipelines, maps: TEXELS.map(|side| map(device, side)) })
    }

    /// Fills the maps; in a draft the rim light's has nothing in it.
    pub(super) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        globals: &wgpu::BindGroup,
        head: &HeadBuffers,
        clear_skin: bool,
        quality: Quality,
    ) {
        let is_filled = [true, quality == Quality::Full];
        for ((map, pipeline), is_filled) in self.maps.iter().zip(&self.pipelines).zip(is_filled) {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("shadow"),
                depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                    view: map,
                    depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
                    stencil_ops: None,
                }),
                ..Default::default()
            });
            if !is_filled {
                continue;
            }
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, globals, &[]);
            pass.set_vertex_buffer(0, head.positions.slice(..));
            pass.set_index_buffer(head.indices.slice(..), wgpu::IndexFormat::Uint32);
            // What is seen through throws no shadow.
            for run in head.runs.iter().filter(|run| !(clear_skin && is_skin(run.material))) {
                pass.draw_indexed(run.start..run.start + run.count, 0, 0..1);
            }
        }
    }
}

fn map(device: &wgpu::Device, side: u32) -> wgpu::TextureView {
    let texture = device.create_texture(&wgpu::TextureDescriptor {
        label: Some("shadow"),
        size: wgpu::Extent3d { width: side, height: side, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: DEPTH,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
        view_formats: &[],
    });
    texture.create_view(&Default::default())
}

fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layout: &wgpu::PipelineLayout,
    of_rim: bool,
) -> wgpu::RenderPipeline {
    let constants = [("of_rim", f64::from(u8::from(of_rim)))];
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("shadow"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 12,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x3],
            })],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: DEPTH,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: Default::default(),
            // A slope as steep as the filter's radius must not shade itself.
            bias: wgpu::DepthBiasState { constant: 0, slope_scale: 2.5, clamp: 0.0 },
        }),
        multisample: Default::default(),
        fragment: None,
        multiview_mask: None,
        cache: None,
    })
}
