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

/// Compute pipelines for stencils and for normals.
#[derive(Debug)]
pub struct SubdividePass {
    stencils: wgpu::ComputePipeline,
    normals: wgpu::ComputePipeline,
    layout: wgpu::BindGroupLayout,
}

/// A plan's tables on the card, and the levels between.
#[derive(Debug)]
pub struct PlanBuffers {
    control: wgpu::Buffer,
    n_control: usize,
    steps: Vec<Dispatch>,
    normals: Option<Dispatch>,
}

#[derive(Debug)]
struct Dispatch {
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
        let pipeline = |entry_point| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(entry_point),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: Default::default(),
                cache: None,
            })
        };
        let (stencils, normals) =
            build_checked(device, ShaderFile::Subdivide, || (pipeline("stencils"), pipeline("normals")))?;
        Ok(Self { stencils, normals, layout })
    }

    /// The same, or nothing on a device without compute shaders.
    pub(super) fn new_if_able(device: &wgpu::Device, sources: &ShaderSources) -> Result<Option<Self>, ShaderError> {
        let limits = device.limits();
        let able = limits.max_compute_workgroup_size_x >= WORKGROUP && limits.max_storage_buffers_per_shader_stage >= 5;
        able.then(|| Self::new(device, sources)).transpose()
    }

    /// Whether a plan can be evaluated here: positions of the last level, normals from faces or none, at least one step,
    /// and tables that fit the device.
    pub fn takes(device: &wgpu::Device, plan: &Plan) -> bool {
        let limits = device.limits();
        let largest =
            plan.tables().iter().map(|t| 4 * t.n_entries() as u64).chain([12 * plan.n_vertices() as u64]).max();
        let ring_bytes = plan.n_ring_bytes() as u64;
        limits.max_compute_workgroup_size_x >= WORKGROUP
            && limits.max_storage_buffers_per_shader_stage >= 5
            && largest.unwrap_or(0).max(ring_bytes) <= limits.max_storage_buffer_binding_size
            && plan.options().positions == Positions::Level
            && plan.options().normals != Normals::Limit
            && !plan.tables().is_empty()
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
        let control = buffer(device, "control", 12 * plan.n_control(), storage);
        let mut coarse = control.clone();
        let mut steps = Vec::new();
        for (i, table) in plan.tables().iter().enumerate() {
            let is_last = i + 1 == plan.tables().len();
            let fine = if is_last { positions.clone() } else { buffer(device, "level", 12 * table.n_rows(), storage) };
            let table = Table { rows: table.row_starts(), sources: table.sources(), weights: table.weights() };
            steps.push(self.dispatch(device, queue, table, &coarse, &fine));
            coarse = fine;
        }
        let normals = plan.outlines().map(|(rows, sources)| {
            let table = Table { rows, sources, weights: &[0.0] };
            self.dispatch(device, queue, table, positions, normals)
        });
        PlanBuffers { control, n_control: plan.n_control(), steps, normals }
    }

    fn dispatch(
        &self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
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
        Dispatch { bindings, workgroups: (x, y) }
    }

    /// Records the evaluation of the control positions that were [written](PlanBuffers::write_control) last.
    pub fn record(&self, encoder: &mut wgpu::CommandEncoder, plan: &PlanBuffers) {
        let mut pass = encoder
            .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("subdivide"), timestamp_writes: None });
        pass.set_pipeline(&self.stencils);
        for step in &plan.steps {
            step.run(&mut pass);
        }
        if let Some(normals) = &plan.normals {
            pass.set_pipeline(&self.normals);
            normals.run(&mut pass);
        }
    }
}

impl Dispatch {
    fn run(&self, pass: &mut wgpu::ComputePass<'_>) {
        pass.set_bind_group(0, &self.bindings, &[]);
        pass.dispatch_workgroups(self.workgroups.0, self.workgroups.1, 1);
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
