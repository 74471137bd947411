//! Depth of the head seen from the key light.

use super::head_buffers::HeadBuffers;
use super::mesh_pass::is_skin;
use super::shader_source::{ShaderError, ShaderFile, ShaderSources, build_checked};
use super::targets::DEPTH;

/// Side of the map, texels.
pub(super) const TEXELS: u32 = 1536;

/// The map and the pipeline that fills it.
#[derive(Debug)]
pub(super) struct ShadowPass {
    pipeline: wgpu::RenderPipeline,
    /// To be sampled with comparison.
    pub(super) map: wgpu::TextureView,
}

impl ShadowPass {
    pub(super) fn new(
        device: &wgpu::Device,
        sources: &ShaderSources,
        globals: &wgpu::BindGroupLayout,
    ) -> Result<Self, ShaderError> {
        let map = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("shadow"),
            size: wgpu::Extent3d { width: TEXELS, height: TEXELS, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: DEPTH,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::TEXTURE_BINDING,
            view_formats: &[],
        });
        let module = sources.compile(device, ShaderFile::Shadow)?;
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shadow"),
            bind_group_layouts: &[Some(globals)],
            immediate_size: 0,
        });
        let pipeline = build_checked(device, ShaderFile::Shadow, || {
            device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some("shadow"),
                layout: Some(&layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some("vertex"),
                    compilation_options: Default::default(),
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
        })?;
        Ok(Self { pipeline, map: map.create_view(&Default::default()) })
    }

    /// Fills the map.
    pub(super) fn draw(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        globals: &wgpu::BindGroup,
        head: &HeadBuffers,
        clear_skin: bool,
    ) {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("shadow"),
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &self.map,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, globals, &[]);
        pass.set_vertex_buffer(0, head.positions.slice(..));
        pass.set_index_buffer(head.indices.slice(..), wgpu::IndexFormat::Uint32);
        // What is seen through throws no shadow.
        for run in head.runs.iter().filter(|run| !(clear_skin && is_skin(run.material))) {
            pass.draw_indexed(run.start..run.start + run.count, 0, 0..1);
        }
    }
}
