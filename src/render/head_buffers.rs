//! The head on the graphics card: once per topology; values follow the frame's revisions.

use crate::coat::Groom;
use crate::frame::{Frame, Material, Part, Revisions};
use glam::Vec3;

/// A run of indices with one material, over all parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Run {
    pub(super) material: Material,
    pub(super) start: u32,
    pub(super) count: u32,
}

/// Seven vertex buffers in the order of the frame's parts, and one index buffer that counts through all of them.
#[derive(Debug)]
pub(super) struct HeadBuffers {
    pub(super) positions: wgpu::Buffer,
    pub(super) normals: wgpu::Buffer,
    pub(super) flow: wgpu::Buffer,
    pub(super) colours: wgpu::Buffer,
    pub(super) surface: wgpu::Buffer,
    pub(super) rest: wgpu::Buffer,
    /// One [`Groom`] each; of parts that bear no hair nothing but zeros.
    pub(super) grooms: wgpu::Buffer,
    pub(super) indices: wgpu::Buffer,
    pub(super) runs: Vec<Run>,
    /// Of the last frame; none before the first.
    revisions: Option<Revisions>,
    topology: u64,
    skin: SkinBy,
}

/// Where the first part's positions and normals come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SkinBy {
    /// The frame has them.
    Upload,
    /// The graphics card works them out from the control positions.
    Card,
}

impl HeadBuffers {
    /// Room for one frame's topology. Values come with the first update.
    pub(super) fn new(device: &wgpu::Device, frame: &Frame<'_>) -> Self {
        let n_vertices: usize = frame.parts.iter().map(|p| p.topology.n_vertices).sum();
        let n_bytes = n_vertices * size_of::<Vec3>();
        // Storage: the card works skin out into them, and grows hair from them.
        let storage = wgpu::BufferUsages::STORAGE;
        let values = |label| buffer(device, label, n_bytes, wgpu::BufferUsages::VERTEX | storage);
        let n_indices: usize = frame.parts.iter().map(|p| p.topology.indices.len()).sum();
        Self {
            positions: values("positions"),
            normals: values("normals"),
            flow: values("flow"),
            colours: values("colours"),
            surface: values("surface"),
            rest: values("rest"),
            grooms: buffer(device, "grooms", n_vertices * size_of::<Groom>(), wgpu::BufferUsages::VERTEX | storage),
            indices: buffer(device, "indices", n_indices * size_of::<u32>(), wgpu::BufferUsages::INDEX | storage),
            runs: Vec::new(),
            revisions: None,
            topology: frame.revisions.topology,
            skin: SkinBy::Upload,
        }
    }

    /// Whether the frame has the topology that these buffers were made for.
    pub(super) fn fits(&self, frame: &Frame<'_>) -> bool {
        self.topology == frame.revisions.topology
    }

    /// Uploads what has changed in a frame that fits, apart from what the card works out; tells whether that is out of date.
    pub(super) fn update(&mut self, queue: &wgpu::Queue, frame: &Frame<'_>, skin: SkinBy) -> bool {
        let (old, new) = (self.revisions, frame.revisions);
        if old.is_none() {
            let (indices, runs) = joined_indices(frame);
            queue.write_buffer(&self.indices, 0, bytemuck::cast_slice(&indices));
            self.runs = runs;
            write_parts(queue, &self.rest, frame, 0, |p| p.rest);
        }
        let shape_changed = old.is_none_or(|old| old.shape != new.shape) || self.skin != skin;
        if shape_changed {
            let n_computed = usize::from(skin == SkinBy::Card);
            write_parts(queue, &self.positions, frame, n_computed, |p| p.positions);
            write_parts(queue, &self.normals, frame, n_computed, |p| p.normals);
            write_parts(queue, &self.flow, frame, 0, |p| p.flow);
        }
        if old.is_none_or(|old| old.look != new.look) {
            write_parts(queue, &self.colours, frame, 0, |p| p.colours);
            write_parts(queue, &self.surface, frame, 0, |p| p.surface);
            if let Some(coat) = frame.coat {
                queue.write_buffer(&self.grooms, 0, bytemuck::cast_slice(coat.grooms));
            }
        }
        self.revisions = Some(new);
        self.skin = skin;
        shape_changed
    }
}

/// A buffer that can be written; never of size zero, which drivers refuse.
pub(super) fn buffer(device: &wgpu::Device, label: &str, bytes: usize, usage: wgpu::BufferUsages) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: bytes.max(16) as u64,
        usage: usage | wgpu::BufferUsages::COPY_DST,
        mapped_at_creation: false,
    })
}

/// Writes one kind of value of all parts but the first `n_skipped`.
fn write_parts<'a>(
    queue: &wgpu::Queue,
    buffer: &wgpu::Buffer,
    frame: &Frame<'a>,
    n_skipped: usize,
    values: impl Fn(&Part<'a>) -> &'a [Vec3],
) {
    let mut offset = 0;
    for (i, part) in frame.parts.iter().enumerate() {
        let bytes: &[u8] = bytemuck::cast_slice(values(part));
        if i >= n_skipped {
            queue.write_buffer(buffer, offset, bytes);
        }
        offset += bytes.len() as u64;
    }
}

/// Indices of all parts, each shifted by the vertices before it (a base vertex is not to be had on every GL), and
/// their runs in the same order.
fn joined_indices(frame: &Frame<'_>) -> (Vec<u32>, Vec<Run>) {
    let mut indices = Vec::new();
    let mut runs = Vec::new();
    let mut first_vertex = 0;
    for part in &frame.parts {
        let first_index = indices.len() as u32;
        indices.extend(part.topology.indices.iter().map(|i| i + first_vertex));
        for range in &part.topology.ranges {
            runs.push(Run { material: range.material, start: first_index + range.start, count: range.count });
        }
        first_vertex += part.topology.n_vertices as u32;
    }
    (indices, runs)
}
