//! The head on the graphics card: once per topology; values follow the frame's revisions.

use crate::frame::{Frame, Material, Revisions};
use glam::Vec3;

/// A run of indices with one material, over all parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Run {
    pub(super) material: Material,
    pub(super) start: u32,
    pub(super) count: u32,
}

/// Five vertex buffers in the order of the frame's parts, and one index buffer that counts through all of them.
#[derive(Debug)]
pub(super) struct HeadBuffers {
    pub(super) positions: wgpu::Buffer,
    pub(super) normals: wgpu::Buffer,
    pub(super) flow: wgpu::Buffer,
    pub(super) colours: wgpu::Buffer,
    pub(super) surface: wgpu::Buffer,
    pub(super) indices: wgpu::Buffer,
    pub(super) runs: Vec<Run>,
    revisions: Revisions,
}

impl HeadBuffers {
    /// Room for one frame's topology, values included.
    pub(super) fn new(device: &wgpu::Device, queue: &wgpu::Queue, frame: &Frame<'_>) -> Self {
        let n_vertices: usize = frame.parts.iter().map(|p| p.topology.n_vertices).sum();
        let values = |label| buffer(device, label, n_vertices * size_of::<Vec3>(), wgpu::BufferUsages::VERTEX);
        let (indices, runs) = joined_indices(frame);
        let index_buffer = buffer(device, "indices", indices.len() * size_of::<u32>(), wgpu::BufferUsages::INDEX);
        queue.write_buffer(&index_buffer, 0, bytemuck::cast_slice(&indices));
        let buffers = Self {
            positions: values("positions"),
            normals: values("normals"),
            flow: values("flow"),
            colours: values("colours"),
            surface: values("surface"),
            indices: index_buffer,
            runs,
            revisions: frame.revisions,
        };
        buffers.write_shape(queue, frame);
        buffers.write_look(queue, frame);
        buffers
    }

    /// Whether the frame has the topology that these buffers were made for.
    pub(super) fn fits(&self, frame: &Frame<'_>) -> bool {
        self.revisions.topology == frame.revisions.topology
    }

    /// Uploads what has changed in a frame that fits.
    pub(super) fn update(&mut self, queue: &wgpu::Queue, frame: &Frame<'_>) {
        let (old, new) = (self.revisions, frame.revisions);
        if old.shape != new.shape {
            self.write_shape(queue, frame);
        }
        if old.look != new.look {
            self.write_look(queue, frame);
        }
        self.revisions = new;
    }

    fn write_shape(&self, queue: &wgpu::Queue, frame: &Frame<'_>) {
        write_parts(queue, &self.positions, frame.parts.iter().map(|p| p.positions));
        write_parts(queue, &self.normals, frame.parts.iter().map(|p| p.normals));
        write_parts(queue, &self.flow, frame.parts.iter().map(|p| p.flow));
    }

    fn write_look(&self, queue: &wgpu::Queue, frame: &Frame<'_>) {
        write_parts(queue, &self.colours, frame.parts.iter().map(|p| p.colours));
        write_parts(queue, &self.surface, frame.parts.iter().map(|p| p.surface));
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

fn write_parts<'a>(queue: &wgpu::Queue, buffer: &wgpu::Buffer, parts: impl Iterator<Item = &'a [Vec3]>) {
    let mut offset = 0;
    for values in parts {
        let bytes: &[u8] = bytemuck::cast_slice(values);
        queue.write_buffer(buffer, offset, bytes);
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
