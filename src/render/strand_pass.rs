//! Hair, one ribbon each, grown on the graphics card from the vertex buffers that are drawn.
//!
//! Lifetimes: [`StrandPass`] once per device; roots once per topology and number of strands, colours once per look. A frame
//! whose shape alone has changed uploads nothing, nor does another condition of the coat.

use super::head_buffers::{HeadBuffers, buffer};
use super::mesh_pass::{MeshPass, Quality};
use super::shader_source::{ShaderError, ShaderFile, ShaderSources, build_checked};
use super::targets::{COLOUR, depth, samples};
use crate::coat::{self, Coat};
use crate::frame::Revisions;

/// Points of a strand.
fn n_points(quality: Quality) -> u16 {
    match quality {
        Quality::Full => 6,
        Quality::Draft => 4,
    }
}

/// Strands drawn by one instance, so that instances are not too small for the card; `strand.wgsl` knows it too.
const BATCH: u16 = 128;
/// Buffers that the vertex stage reads.
const N_STORAGE: u32 = 7;
/// Width of a hair where [`MEDIUM`] of them stand on a head of [`SIZE`]; fewer are wider.
const WIDTH: f32 = 0.000_34;
const MEDIUM: f32 = 90_000.0;
const SIZE: f32 = 0.30;

/// Pipeline, and the hair of the last head.
#[derive(Debug)]
pub(super) struct StrandPass {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    ribbons: wgpu::Buffer,
    n_indices: u32,
    loaded: Option<Loaded>,
    n_bytes: u64,
}

#[derive(Debug)]
struct Loaded {
    revisions: Revisions,
    n_roots: usize,
    colours: wgpu::Buffer,
    bindings: wgpu::BindGroup,
    n_drawn: u32,
}

/// Width of a strand on a head that is `size` metres large, metres.
pub(super) fn width(size: f32, n_strands: u32) -> f32 {
    WIDTH * (MEDIUM / n_strands.max(1) as f32).sqrt().clamp(0.5, 1.8) * (size / SIZE).clamp(0.4, 1.5)
}

/// How much of the skin so many strands cover, 0 to 1.
pub(super) fn cover(n_strands: u32) -> f32 {
    (n_strands as f32 / (0.8 * MEDIUM)).sqrt().min(1.0)
}

impl StrandPass {
    /// None on a device whose vertex stage cannot read buffers.
    pub(super) fn new_if_able(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        sources: &ShaderSources,
        globals: &wgpu::BindGroupLayout,
        quality: Quality,
    ) -> Result<Option<Self>, ShaderError> {
        // Checked in any case, so that a mistake is told wherever it is made.
        sources.check(ShaderFile::Strand)?;
        if device.limits().max_storage_buffers_per_shader_stage < N_STORAGE {
            return Ok(None);
        }
        let layout = bindings_layout(device);
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("strand"),
            bind_group_layouts: &[Some(globals), Some(&layout)],
            immediate_size: 0,
        });
        let module = sources.compile(device, ShaderFile::Strand)?;
        let pipeline = build_checked(device, ShaderFile::Strand, || {
            pipeline(device, &module, &pipeline_layout, n_points(quality))
        })?;
        let indices = ribbon_indices(n_points(quality));
        let ribbons = buffer(device, "ribbons", indices.len() * size_of::<u16>(), wgpu::BufferUsages::INDEX);
        queue.write_buffer(&ribbons, 0, bytemuck::cast_slice(&indices));
        Ok(Some(Self { pipeline, layout, ribbons, n_indices: indices.len() as u32, loaded: None, n_bytes: 0 }))
    }

    /// Bytes uploaded for hair so far.
    pub(super) fn n_bytes(&self) -> u64 {
        self.n_bytes
    }

    /// Forgets the hair of an earlier head.
    pub(super) fn forget(&mut self) {
        self.loaded = None;
    }

    /// Brings the hair of a frame to the card, as far as it is not there. At most `n_strands` are drawn, and more of them
    /// along the outline.
    #[expect(clippy::too_many_arguments, reason = "what a frame lends out and where it goes")]
    pub(super) fn load(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        coat: &Coat<'_>,
        revisions: Revisions,
        n_strands: u32,
        head: &HeadBuffers,
        mesh: &MeshPass,
    ) {
        let n_drawn = coat::n_rooted(n_strands as usize).min(coat.roots.len()) as u32;
        let fits = |l: &Loaded| l.n_roots == coat.roots.len() && l.revisions.topology == revisions.topology;
        let old = self.loaded.take().filter(fits);
        let is_painted = old.as_ref().is_some_and(|l| l.revisions.look == revisions.look);
        let mut loaded = match old {
            Some(loaded) => loaded,
            None => self.root(device, queue, coat, revisions, head, mesh),
        };
        if !is_painted {
            self.write(queue, &loaded.colours, bytemuck::cast_slice(coat.colours));
        }
        (loaded.revisions, loaded.n_drawn) = (revisions, n_drawn);
        self.loaded = Some(loaded);
    }

    /// Buffers for the hair of a topology, of which the roots are written.
    fn root(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        coat: &Coat<'_>,
        revisions: Revisions,
        head: &HeadBuffers,
        mesh: &MeshPass,
    ) -> Loaded {
        let storage = |label, n_bytes| buffer(device, label, n_bytes, wgpu::BufferUsages::STORAGE);
        let roots = storage("roots", size_of_val(coat.roots));
        self.write(queue, &roots, bytemuck::cast_slice(coat.roots));
        let colours = storage("hair colours", size_of_val(coat.colours));
        let buffers = [&roots, &head.indices, &head.positions, &head.normals, &head.flow, &head.grooms, &colours];
        let resources = buffers.map(|b| b.as_entire_binding()).into_iter().chain(mesh.resources());
        let entries: Vec<_> =
            (0..).zip(resources).map(|(binding, resource)| wgpu::BindGroupEntry { binding, resource }).collect();
        let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("strand"),
            layout: &self.layout,
            entries: &entries,
        });
        Loaded { revisions, n_roots: coat.roots.len(), colours, bindings, n_drawn: 0 }
    }

    fn write(&mut self, queue: &wgpu::Queue, to: &wgpu::Buffer, bytes: &[u8]) {
        queue.write_buffer(to, 0, bytes);
        self.n_bytes += bytes.len() as u64;
    }

    /// Draws the loaded hair; the globals are bound as group 0.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some(loaded) = &self.loaded else { return };
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(1, &loaded.bindings, &[]);
        pass.set_index_buffer(self.ribbons.slice(..), wgpu::IndexFormat::Uint16);
        pass.draw_indexed(0..self.n_indices, 0, 0..loaded.n_drawn.div_ceil(u32::from(BATCH)));
    }
}

/// Two triangles between each two points of each strand of a batch; a point has two corners, left and right.
fn ribbon_indices(n_points: u16) -> Vec<u16> {
    let segments = (0..BATCH).flat_map(|strand| (0..n_points - 1).map(move |point| (strand * n_points + point) * 2));
    segments.flat_map(|i| [i, i + 1, i + 2, i + 2, i + 1, i + 3]).collect()
}

fn bindings_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let from_buffer = |ty| wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None };
    let storage = from_buffer(wgpu::BufferBindingType::Storage { read_only: true });
    let mut types = vec![storage; N_STORAGE as usize];
    types.extend(MeshPass::RESOURCE_TYPES);
    let entries: Vec<_> = (0..)
        .zip(types)
        .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::VERTEX,
            ty,
            count: None,
        })
        .collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("strand"), entries: &entries })
}

fn pipeline(
    device: &wgpu::Device,
    module: &wgpu::ShaderModule,
    layout: &wgpu::PipelineLayout,
    n_points: u16,
) -> wgpu::RenderPipeline {
    let constants = [("points", f64::from(n_points))];
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("strand"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() },
            buffers: &[],
        },
        primitive: Default::default(),
        depth_stencil: depth(true, wgpu::CompareFunction::Less),
        multisample: samples(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("fragment"),
            compilation_options: Default::default(),
            targets: &[Some(COLOUR.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
