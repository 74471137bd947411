//! The head's surfaces, one draw for each run of a material.

use super::head_buffers::HeadBuffers;
use super::shader_source::{ShaderError, ShaderFile, ShaderSources, build_checked};
use super::targets::{COLOUR, depth, samples};
use super::{noise, shadow_pass::ShadowPass};
use crate::coat::Groom;
use crate::frame::Material;
use std::sync::OnceLock;

/// Ways of shading, one pipeline each: the numbers of `mesh.wgsl`.
const KINDS: [u32; 9] = [0, 1, 2, 3, 4, 5, 6, 7, 8];
/// Those of them that skin is shaded in.
const SKIN_KINDS: [u32; 5] = [0, 1, 2, 3, 5];

/// How much work a pixel is worth.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Quality {
    /// Everything.
    #[default]
    Full,
    /// Haired skin shaded at its vertices, hard shadows: for a window drawn by a software driver.
    Draft,
}

/// The way of shading of a material, of [`KINDS`].
fn kind(material: Material) -> u32 {
    match material {
        Material::Coat => 0,
        Material::Nose => 1,
        Material::Lip => 2,
        Material::Mouth => 3,
        Material::Sclera | Material::Iris | Material::Pupil => 4,
        Material::Cap => 5,
        Material::Bone
        | Material::Tooth
        | Material::Gum
        | Material::ThirdEyelid
        | Material::Whisker
        | Material::Muscle => 6,
        Material::Tongue => 7,
        Material::Tears => 8,
    }
}

/// Whether it is seen through where the skin is.
pub(super) fn is_skin(material: Material) -> bool {
    use Material::{Cap, Coat, Lip, Mouth, Nose};
    matches!(material, Coat | Nose | Lip | Mouth | Cap)
}

/// A pipeline for each way of shading, those of the skin seen through too, and bindings that do not change with the head.
#[derive(Debug)]
pub(super) struct MeshPass {
    solid: [wgpu::RenderPipeline; KINDS.len()],
    /// In the order of [`SKIN_KINDS`]; made when first asked for, from what the others have proved right.
    clear: OnceLock<[wgpu::RenderPipeline; SKIN_KINDS.len()]>,
    module: wgpu::ShaderModule,
    pipeline_layout: wgpu::PipelineLayout,
    quality: Quality,
    pub(super) layout: wgpu::BindGroupLayout,
    pub(super) bindings: wgpu::BindGroup,
    shared: Shared,
}

/// Shadow maps and noise, with their samplers.
#[derive(Debug)]
struct Shared {
    shadow: wgpu::TextureView,
    rim: wgpu::TextureView,
    comparison: wgpu::Sampler,
    noise: wgpu::TextureView,
    repeating: wgpu::Sampler,
}

impl MeshPass {
    /// Types of [`MeshPass::resources`].
    pub(super) const RESOURCE_TYPES: [wgpu::BindingType; 5] = {
        const fn texture(
            sample_type: wgpu::TextureSampleType,
            view_dimension: wgpu::TextureViewDimension,
        ) -> wgpu::BindingType {
            wgpu::BindingType::Texture { sample_type, view_dimension, multisampled: false }
        }
        [
            texture(wgpu::TextureSampleType::Depth, wgpu::TextureViewDimension::D2),
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Comparison),
            texture(wgpu::TextureSampleType::Float { filterable: true }, wgpu::TextureViewDimension::D3),
            wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
            texture(wgpu::TextureSampleType::Depth, wgpu::TextureViewDimension::D2),
        ]
    };

    /// The key light's shadow map, its sampler, noise, its sampler, the rim light's shadow map: for who lights something else alike.
    pub(super) fn resources(&self) -> [wgpu::BindingResource<'_>; 5] {
        self.shared.resources()
    }

    pub(super) fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        sources: &ShaderSources,
        globals: &wgpu::BindGroupLayout,
        shadow: &ShadowPass,
        quality: Quality,
    ) -> Result<Self, ShaderError> {
        let own = bindings_layout(device);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("mesh"),
            bind_group_layouts: &[Some(globals), Some(&own)],
            immediate_size: 0,
        });
        let module = sources.compile(device, ShaderFile::Mesh)?;
        let solid = build_checked(device, ShaderFile::Mesh, || {
            KINDS.map(|kind| pipeline(device, &module, &layout, kind, quality, false))
        })?;
        let shared = Shared::new(device, queue, shadow);
        let bindings = bindings(device, &own, &shared);
        Ok(Self {
            solid,
            clear: OnceLock::new(),
            module,
            pipeline_layout: layout,
            quality,
            layout: own,
            bindings,
            shared,
        })
    }

    fn clear(&self, device: &wgpu::Device) -> &[wgpu::RenderPipeline; SKIN_KINDS.len()] {
        let make = |kind| pipeline(device, &self.module, &self.pipeline_layout, kind, self.quality, true);
        self.clear.get_or_init(|| SKIN_KINDS.map(make))
    }

    /// Draws every run; the globals are bound as group 0. Skin that is seen through comes last.
    pub(super) fn draw(
        &self,
        device: &wgpu::Device,
        pass: &mut wgpu::RenderPass<'_>,
        head: &HeadBuffers,
        clear_skin: bool,
    ) {
        pass.set_bind_group(1, &self.bindings, &[]);
        let values =
            [&head.positions, &head.normals, &head.flow, &head.colours, &head.surface, &head.rest, &head.grooms];
        for (slot, buffer) in (0..).zip(values) {
            pass.set_vertex_buffer(slot, buffer.slice(..));
        }
        pass.set_index_buffer(head.indices.slice(..), wgpu::IndexFormat::Uint32);
        for clear in [false, true] {
            for run in head.runs.iter().filter(|run| (clear_skin && is_skin(run.material)) == clear) {
                let kind = kind(run.material);
                let pipeline = match SKIN_KINDS.iter().position(|&k| k == kind).filter(|_| clear) {
                    Some(at) => &self.clear(device)[at],
                    None => &self.solid[kind as usize],
                };
                pass.set_pipeline(pipeline);
                pass.draw_indexed(run.start..run.start + run.count, 0, 0..1);
            }
        }
    }
}

fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layout: &wgpu::PipelineLayout,
    kind: u32,
    quality: Quality,
    clear: bool,
) -> wgpu::RenderPipeline {
    let draft = f64::from(u8::from(quality == Quality::Draft));
    let seen_through = f64::from(u8::from(clear));
    let constants = [("kind", f64::from(kind)), ("draft", draft), ("seen_through", seen_through)];
    let attributes: [[wgpu::VertexAttribute; 1]; 6] = [
        wgpu::vertex_attr_array![0 => Float32x3],
        wgpu::vertex_attr_array![1 => Float32x3],
        wgpu::vertex_attr_array![2 => Float32x3],
        wgpu::vertex_attr_array![3 => Float32x3],
        wgpu::vertex_attr_array![4 => Float32x3],
        wgpu::vertex_attr_array![5 => Float32x3],
    ];
    let of_groom = wgpu::vertex_attr_array![6 => Float32x4, 7 => Float32x4, 8 => Float32x4, 9 => Float32x4];
    let layout_of = |array_stride, attributes| {
        Some(wgpu::VertexBufferLayout { array_stride, step_mode: wgpu::VertexStepMode::Vertex, attributes })
    };
    let mut buffers: Vec<_> = attributes.iter().map(|attributes| layout_of(12, attributes)).collect();
    buffers.push(layout_of(size_of::<Groom>() as u64, &of_groom));
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("mesh"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
            buffers: &buffers,
        },
        // Both sides: one looks into nostrils and into an open mouth. Of what is seen through, the near side.
        primitive: wgpu::PrimitiveState { cull_mode: clear.then_some(wgpu::Face::Back), ..Default::default() },
        depth_stencil: depth(!clear, wgpu::CompareFunction::Less),
        multisample: samples(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("fragment"),
            compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
            targets: &[Some(wgpu::ColorTargetState {
                blend: clear.then_some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                ..COLOUR.into()
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}

fn bindings_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let entries: Vec<_> = (0..)
        .zip(MeshPass::RESOURCE_TYPES)
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty,
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("mesh"), entries: &entries })
}

fn bindings(device: &wgpu::Device, layout: &wgpu::BindGroupLayout, shared: &Shared) -> wgpu::BindGroup {
    let entries: Vec<_> =
        (0..).zip(shared.resources()).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor { label: Some("mesh"), layout, entries: &entries })
}

impl Shared {
    fn new(device: &wgpu::Device, queue: &wgpu::Queue, shadow: &ShadowPass) -> Self {
        let comparison = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("shadow"),
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            compare: Some(wgpu::CompareFunction::LessEqual),
            ..Default::default()
        });
        let repeating = device.create_sampler(&wgpu::SamplerDescriptor {
            label: Some("noise"),
            address_mode_u: wgpu::AddressMode::Repeat,
            address_mode_v: wgpu::AddressMode::Repeat,
            address_mode_w: wgpu::AddressMode::Repeat,
            mag_filter: wgpu::FilterMode::Linear,
            min_filter: wgpu::FilterMode::Linear,
            ..Default::default()
        });
        let [key, rim] = shadow.maps.clone();
        Self { shadow: key, rim, comparison, noise: noise::texture(device, queue), repeating }
    }

    fn resources(&self) -> [wgpu::BindingResource<'_>; 5] {
        [
            wgpu::BindingResource::TextureView(&self.shadow),
            wgpu::BindingResource::Sampler(&self.comparison),
            wgpu::BindingResource::TextureView(&self.noise),
            wgpu::BindingResource::Sampler(&self.repeating),
            wgpu::BindingResource::TextureView(&self.rim),
        ]
    }
}
