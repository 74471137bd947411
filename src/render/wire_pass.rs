//! Lines of constant width over the head: every edge of the refined skin, or of the control mesh.
//!
//! An edge is an instanced quad. Its two ends are read from a texture of positions by number, because vertex stages
//! without storage buffers (GL) can read textures too. Edges are uploaded per topology, positions per shape, and both
//! only while lines are shown.

use super::head_buffers::buffer;
use super::shader_source::{ShaderError, ShaderFile, ShaderSources, build_checked};
use super::targets::{COLOUR, depth, samples};
use crate::frame::{Frame, Revisions};
use glam::{Vec3, Vec4};

/// Positions a row of the texture; `wire.wgsl` knows it too.
const ROW: u32 = 1024;

/// Which lines.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Lines {
    /// Edges of every drawn part.
    Refined,
    /// Edges of the control mesh.
    Control,
    /// The same edges, in the style of refined ones.
    Outlines,
}

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct Style {
    /// sRGB and alpha.
    colour: Vec4,
    /// Width in pixels; shift towards the camera as a part of the head's size.
    measures: Vec4,
}

/// Pipeline, and the lines that were shown last.
#[derive(Debug)]
pub(super) struct WirePass {
    pipeline: wgpu::RenderPipeline,
    layout: wgpu::BindGroupLayout,
    style: wgpu::Buffer,
    loaded: Option<Loaded>,
}

#[derive(Debug)]
struct Loaded {
    lines: Lines,
    revisions: Revisions,
    n_edges: u32,
    n_positions: usize,
    edges: wgpu::Buffer,
    positions: wgpu::Texture,
    bindings: wgpu::BindGroup,
}

impl WirePass {
    pub(super) fn new(
        device: &wgpu::Device,
        sources: &ShaderSources,
        globals: &wgpu::BindGroupLayout,
    ) -> Result<Self, ShaderError> {
        let layout = bindings_layout(device);
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("wire"),
            bind_group_layouts: &[Some(globals), Some(&layout)],
            immediate_size: 0,
        });
        let module = sources.compile(device, ShaderFile::Wire)?;
        let pipeline = build_checked(device, ShaderFile::Wire, || pipeline(device, &module, &pipeline_layout))?;
        let style = buffer(device, "wire style", size_of::<Style>(), wgpu::BufferUsages::UNIFORM);
        Ok(Self { pipeline, layout, style, loaded: None })
    }

    /// Brings the lines of this frame to the card, if they are not there.
    pub(super) fn load(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        frame: &Frame<'_>,
        lines: Lines,
        pixels_per_point: f32,
    ) {
        let style = match lines {
            Lines::Refined | Lines::Outlines => {
                Style { colour: Vec4::new(0.05, 0.06, 0.08, 0.55), measures: Vec4::new(1.0, 0.002, 0.0, 0.0) }
            }
            Lines::Control => {
                Style { colour: Vec4::new(0.98, 0.62, 0.18, 0.95), measures: Vec4::new(1.5, 0.03, 0.0, 0.0) }
            }
        };
        let measures = style.measures * Vec4::new(pixels_per_point, 1.0, 1.0, 1.0);
        queue.write_buffer(&self.style, 0, bytemuck::bytes_of(&Style { measures, ..style }));
        let same_edges = |l: &Loaded| l.lines == lines && l.revisions.topology == frame.revisions.topology;
        match &mut self.loaded {
            Some(loaded) if same_edges(loaded) => {
                if loaded.revisions.shape != frame.revisions.shape {
                    write_positions(queue, &loaded.positions, loaded.n_positions, frame, lines);
                    loaded.revisions = frame.revisions;
                }
            }
            other => *other = Some(Loaded::new(device, queue, &self.layout, &self.style, frame, lines)),
        }
    }

    /// Forgets lines of an earlier frame.
    pub(super) fn forget(&mut self) {
        self.loaded = None;
    }

    /// Draws the loaded lines; the globals are bound as group 0.
    pub(super) fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        let Some(loaded) = &self.loaded else { return };
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(1, &loaded.bindings, &[]);
        pass.set_vertex_buffer(0, loaded.edges.slice(..));
        pass.draw(0..4, 0..loaded.n_edges);
    }
}

impl Loaded {
    fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        layout: &wgpu::BindGroupLayout,
        style: &wgpu::Buffer,
        frame: &Frame<'_>,
        lines: Lines,
    ) -> Self {
        let (edges, n_positions) = match lines {
            Lines::Control | Lines::Outlines => {
                (unique_edges(frame.control_indices.iter().copied()), frame.control.len())
            }
            Lines::Refined => refined_edges(frame),
        };
        let edge_buffer = buffer(device, "edges", edges.len() * 8, wgpu::BufferUsages::VERTEX);
        queue.write_buffer(&edge_buffer, 0, bytemuck::cast_slice(&edges));
        let positions = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("line ends"),
            size: wgpu::Extent3d {
                width: ROW,
                height: (n_positions as u32).div_ceil(ROW).max(1),
                depth_or_array_layers: 1,
            },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Rgba32Float,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        write_positions(queue, &positions, n_positions, frame, lines);
        let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("wire"),
            layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: style.as_entire_binding() },
                wgpu::BindGroupEntry {
                    binding: 1,
                    resource: wgpu::BindingResource::TextureView(&positions.create_view(&Default::default())),
                },
            ],
        });
        let n_edges = edges.len() as u32;
        Self { lines, revisions: frame.revisions, n_edges, n_positions, edges: edge_buffer, positions, bindings }
    }
}

/// Each undirected edge once, in ascending order; what has no length is no edge.
fn unique_edges(indices: impl Iterator<Item = u32> + Clone) -> Vec<[u32; 2]> {
    let corners: Vec<u32> = indices.collect();
    let mut edges: Vec<[u32; 2]> = corners
        .chunks_exact(3)
        .flat_map(|t| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]])
        .filter(|[a, b]| a != b)
        .map(|[a, b]| [a.min(b), a.max(b)])
        .collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Edges over all parts, and how many vertices they have.
fn refined_edges(frame: &Frame<'_>) -> (Vec<[u32; 2]>, usize) {
    let mut edges = Vec::new();
    let mut first = 0;
    for part in &frame.parts {
        let shifted = part.topology.indices.iter().map(|i| i + first as u32);
        edges.extend(unique_edges(shifted));
        first += part.topology.n_vertices;
    }
    (edges, first)
}

fn write_positions(queue: &wgpu::Queue, to: &wgpu::Texture, n_positions: usize, frame: &Frame<'_>, lines: Lines) {
    let rows = to.height() as usize;
    let mut texels: Vec<Vec4> = Vec::with_capacity(rows * ROW as usize);
    let point = |p: &Vec3| p.extend(1.0);
    match lines {
        Lines::Control | Lines::Outlines => texels.extend(frame.control.iter().map(point)),
        Lines::Refined => texels.extend(frame.parts.iter().flat_map(|p| p.positions).map(point)),
    }
    debug_assert_eq!(texels.len(), n_positions);
    texels.resize(rows * ROW as usize, Vec4::ZERO);
    queue.write_texture(
        to.as_image_copy(),
        bytemuck::cast_slice(&texels),
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(ROW * 16), rows_per_image: None },
        to.size(),
    );
}

fn bindings_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    let entry = |binding, visibility, ty| wgpu::BindGroupLayoutEntry { binding, visibility, ty, count: None };
    let style = wgpu::BindingType::Buffer {
        ty: wgpu::BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: None,
    };
    let positions = wgpu::BindingType::Texture {
        sample_type: wgpu::TextureSampleType::Float { filterable: false },
        view_dimension: wgpu::TextureViewDimension::D2,
        multisampled: false,
    };
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("wire"),
        entries: &[
            entry(0, wgpu::ShaderStages::VERTEX_FRAGMENT, style),
            entry(1, wgpu::ShaderStages::VERTEX, positions),
        ],
    })
}

fn pipeline(device: &wgpu::Device, module: &wgpu::ShaderModule, layout: &wgpu::PipelineLayout) -> wgpu::RenderPipeline {
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("wire"),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex"),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 8,
                step_mode: wgpu::VertexStepMode::Instance,
                attributes: &wgpu::vertex_attr_array![0 => Uint32x2],
            })],
        },
        primitive: wgpu::PrimitiveState { topology: wgpu::PrimitiveTopology::TriangleStrip, ..Default::default() },
        depth_stencil: depth(false, wgpu::CompareFunction::LessEqual),
        multisample: samples(),
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some("fragment"),
            compilation_options: Default::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format: COLOUR,
                blend: Some(wgpu::BlendState::PREMULTIPLIED_ALPHA_BLENDING),
                write_mask: wgpu::ColorWrites::ALL,
            })],
        }),
        multiview_mask: None,
        cache: None,
    })
}

#[cfg(test)]
mod tests {
    #[test]
    fn an_edge_between_two_faces_is_drawn_once() {
        let edges = super::unique_edges([0, 1, 2, 2, 1, 3].into_iter());
        assert_eq!(edges, [[0, 1], [0, 2], [1, 2], [1, 3], [2, 3]]);
        assert_eq!(super::unique_edges([3, 1, 1].into_iter()), [[1, 3]], "an edge alone");
    }
}
