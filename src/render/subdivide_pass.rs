//! The plan evaluated on the graphics card, into the vertex buffers that are drawn. Control positions are the only upload of
//! a frame. The processor's evaluation stays the truth: it is what is hashed and exported.
//!
//! Lifetimes: [`SubdividePass`] once per device; [`PlanBuffers`] once per plan.

use glam::Vec3;

use super::head_buffers::buffer;
use super::shader_source::{ShaderError, ShaderFile, ShaderSources, build_checked};
use crate::subdiv::{Normals, Plan, Positions};

/// Invocations of one workgroup, as in `subdivide.wgsl`.
const WORKGROUP: u32 = 64;
/// Workgroups of a dispatch in one direction; every device allows more.
const MOST_WORKGROUPS: u32 = 32_768;

/// What an invocation computes from its row: an entry point of the shader each.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Kernel {
    /// A value from a row of a stencil table.
    Stencils,
    /// A normal from the outline of the faces around a vertex.
    Normals,
    /// A limit position from a row with three weights a source, of which it takes the first.
    LimitPositions,
    /// A limit normal, from the other two.
    LimitNormals,
}

impl Kernel {
    const ALL: [Kernel; 4] = [Kernel::Stencils, Kernel::Normals, Kernel::LimitPositions, Kernel::LimitNormals];

    fn entry_point(self) -> &'static str {
        match self {
            Kernel::Stencils => "stencils",
            Kernel::Normals => "normals",
            Kernel::LimitPositions => "limit_positions",
            Kernel::LimitNormals => "limit_normals",
        }
    }
}

/// Compute pipelines, one for each kernel.
#[derive(Debug)]
pub struct SubdividePass {
    pipelines: [wgpu::ComputePipeline; 4],
    layout: wgpu::BindGroupLayout,
}

/// A plan's tables on the card, and the levels between.
#[derive(Debug)]
pub struct PlanBuffers {
    control: wgpu::Buffer,
    n_control: usize,
    /// In this order.
    dispatches: Vec<Dispatch>,
}

#[derive(Debug)]
struct Dispatch {
    kernel: Kernel,
    bindings: wgpu::BindGroup,
    workgroups: (u32, u32),
}

/// Rows, sources and weights of a dispatch.
struct Table<'a> {
    rows: Vec<[u32; 2]>,
    sources: &'a [u32],
    weights: &'a [f32],
}

impl SubdividePass {
    /// Compiles the shader.
    ///
    /// # Errors
    /// What the shader or the driver has against it.
    pub fn new(device: &wgpu::Device, sources: &ShaderSources) -> Result<Self, ShaderError> {
        let storage = |read_only| wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only },
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let uniform = wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Uniform,
            has_dynamic_offset: false,
            min_binding_size: None,
        };
        let types = [uniform, storage(true), storage(true), storage(true), storage(true), storage(false)];
        let entries: Vec<_> = (0..)
            .zip(types)
            .map(|(binding, ty)| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty,
                count: None,
            })
            .collect();
        let layout = device
            .create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some("subdivide"), entries: &entries });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("subdivide"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = sources.compile(device, ShaderFile::Subdivide)?;
        let pipeline = |kernel: Kernel| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(kernel.entry_point()),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some(kernel.entry_point()),
                compilation_options: Default::default(),
                cache: None,
            })
        };
        let pipelines = build_checked(device, ShaderFile::Subdivide, || Kernel::ALL.map(pipeline))?;
        Ok(Self { pipelines, layout })
    }

    /// The same, or nothing on a device without compute shaders.
    pub(super) fn new_if_able(device: &wgpu::Device, sources: &ShaderSources) -> Result<Option<Self>, ShaderError> {
        let limits = device.limits();
        let able = limits.max_compute_workgroup_size_x >= WORKGROUP && limits.max_storage_buffers_per_shader_stage >= 5;
        able.then(|| Self::new(device, sources)).transpose()
    }

    /// Whether a plan can be evaluated here: whether its tables fit the device.
    pub fn takes(device: &wgpu::Device, plan: &Plan) -> bool {
        let limits = device.limits();
        let limit_entries = plan.limit().map_or(0, |table| table.sources().len().max(3 * table.weights().len()));
        let largest = plan
            .tables()
            .iter()
            .map(|t| t.n_entries().max(2 * t.n_rows() + 2))
            .chain([limit_entries, 3 * plan.n_vertices(), plan.n_ring_bytes() / 4])
            .max();
        limits.max_compute_workgroup_size_x >= WORKGROUP
            && limits.max_storage_buffers_per_shader_stage >= 5
            && 4 * largest.unwrap_or(0) as u64 <= limits.max_storage_buffer_binding_size
    }

    /// Uploads a plan that it [`takes`](Self::takes). `positions` and `normals` are storage buffers with room for the
    /// plan's last level, three floats a vertex; normals are left alone where the plan has none.
    pub fn load(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        plan: &Plan,
        positions: &wgpu::Buffer,
        normals: &wgpu::Buffer,
    ) -> PlanBuffers {
        let storage = wgpu::BufferUsages::STORAGE;
        let level = |n: usize| buffer(device, "level", 12 * n, storage);
        let control = buffer(device, "control", 12 * plan.n_control(), storage);
        let mut dispatches = Vec::new();
        let mut add = |kernel, table: Table<'_>, from: &wgpu::Buffer, to: &wgpu::Buffer| {
            dispatches.push(self.dispatch(device, queue, kernel, table, from, to));
        };
        // The last level lies between where it is pushed to its limit.
        let pushed = plan.limit().filter(|_| plan.options().positions == Positions::Limit);
        let last = if pushed.is_some() { level(plan.n_vertices()) } else { positions.clone() };
        let mut coarse = control.clone();
        for (i, table) in plan.tables().iter().enumerate() {
            let fine = if i + 1 == plan.tables().len() { last.clone() } else { level(table.n_rows()) };
            let table = Table { rows: table.row_starts(), sources: table.sources(), weights: table.weights() };
            add(Kernel::Stencils, table, &coarse, &fine);
            coarse = fine;
        }
        if plan.tables().is_empty() {
            let same: Vec<u32> = (0..plan.n_control() as u32).collect();
            let rows = (0..=plan.n_control() as u32).map(|row| [row, 0]).collect();
            add(Kernel::Stencils, Table { rows, sources: &same, weights: &[1.0] }, &control, &last);
        }
        let limit = plan.limit().map(|table| (table.row_starts(), table.sources(), table.weights().as_flattened()));
        if let (Some((rows, sources, weights)), Some(_)) = (limit.clone(), pushed) {
            add(Kernel::LimitPositions, Table { rows, sources, weights }, &last, positions);
        }
        match (plan.options().normals, limit, plan.outlines()) {
            (Normals::Limit, Some((rows, sources, weights)), _) => {
                add(Kernel::LimitNormals, Table { rows, sources, weights }, &last, normals);
            }
            (Normals::Faces, _, Some((rows, sources))) => {
                add(Kernel::Normals, Table { rows, sources, weights: &[0.0] }, positions, normals);
            }
            _ => {}
        }
        PlanBuffers { control, n_control: plan.n_control(), dispatches }
    }

    fn dispatch(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        kernel: Kernel,
        table: Table<'_>,
        coarse: &wgpu::Buffer,
        fine: &wgpu::Buffer,
    ) -> Dispatch {
        let upload = |label, bytes: &[u8], usage| {
            let buffer = buffer(device, label, bytes.len(), usage);
            queue.write_buffer(&buffer, 0, bytes);
            buffer
        };
        let n_rows = table.rows.len() as u32 - 1;
        let groups = n_rows.div_ceil(WORKGROUP);
        let (x, y) = (groups.min(MOST_WORKGROUPS), groups.div_ceil(MOST_WORKGROUPS));
        let storage = wgpu::BufferUsages::STORAGE;
        let step = upload("step", bytemuck::cast_slice(&[n_rows, x * WORKGROUP, 0, 0]), wgpu::BufferUsages::UNIFORM);
        let rows = upload("rows", bytemuck::cast_slice(&table.rows), storage);
        let sources = upload("sources", bytemuck::cast_slice(table.sources), storage);
        let weights = upload("weights", bytemuck::cast_slice(table.weights), storage);
        let entries: Vec<_> = (0..)
            .zip([&step, &rows, &sources, &weights, coarse, fine])
            .map(|(binding, buffer)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("subdivide"),
            layout: &self.layout,
            entries: &entries,
        });
        Dispatch { kernel, bindings, workgroups: (x, y) }
    }

    /// Records the evaluation of the control positions that were [written](PlanBuffers::write_control) last.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, plan: &PlanBuffers) {
        let mut pass = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("subdivide"), timestamp_writes: None });
        for dispatch in &plan.dispatches {
            pass.set_pipeline(&self.pipelines[dispatch.kernel as usize]);
            pass.set_bind_group(0, &dispatch.bindings, &[]);
            pass.dispatch_workgroups(dispatch.workgroups.0, dispatch.workgroups.1, 1);
        }
    }
}

impl PlanBuffers {
    /// Uploads control positions, one for each control vertex: all that a frame needs.
    ///
    /// # Panics
    /// Where their number is another.
    pub fn write_control(&self, queue: &wgpu::Queue, control: &[Vec3]) {
        assert_eq!(control.len(), self.n_control, "one position for each control vertex");
        queue.write_buffer(&self.control, 0, bytemuck::cast_slice(control));
    }
}
