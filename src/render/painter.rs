//! All passes of a picture, and the head they draw: once per device.

use super::camera::Camera;
use super::globals::{Extent, Globals};
use super::ground_pass::{Background, GroundPass};
use super::head_buffers::{HeadBuffers, SkinBy, buffer};
use super::mesh_pass::{MeshPass, Quality};
use super::preset::Preset;
use super::samples::Samples;
use super::shader_source::{ShaderError, ShaderSources};
use super::shadow_pass::{self, ShadowPass};
use super::strand_pass::StrandPass;
use super::subdivide_pass::{PlanBuffers, SubdividePass};
use super::targets::Targets;
use super::wire_pass::{Lines, WirePass};
use crate::coat::Condition;
use crate::frame::Frame;
use glam::Vec3;

/// How much longer than its place says a single hair may be.
const LONGEST: f32 = 1.25;

/// What is shown of a head.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// Surfaces only.
    #[default]
    Shaded,
    /// Surfaces, and every edge of the refined mesh.
    Wireframe,
    /// Surfaces, and every edge of the control mesh.
    Control,
    /// The same in thin lines that lie close: for a mesh that is its own control mesh. A polygon's edges can be given there
    /// as triangles with a corner twice.
    Outlined,
}

/// How one picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Drawing {
    /// From where.
    pub camera: Camera,
    /// What of the head.
    pub shading: Shading,
    /// In which light, and as what.
    pub preset: Preset,
    /// In front of what.
    pub background: Background,
    /// The lights turned about the vertical, radians; 0 leaves the key light at the upper left of the picture.
    pub light_turn: f32,
    /// Whether the graphics card evaluates the skin, if it can. The picture differs by rounding at most.
    pub on_card: bool,
    /// Of the skin, 0 to 1, if it is among the frame's parts.
    pub skin_opacity: f32,
    /// How many strands of hair at most, of those that the frame has; none where the skin is seen through.
    pub n_strands: u32,
    /// What the coat is like today.
    pub condition: Condition,
    /// Of each pixel, where the picture is drawn [offscreen](super::Offscreen); a window takes the fewest.
    pub samples: Samples,
    /// Pixels per unit of line width: 1, or the window's scale factor.
    pub pixels_per_point: f32,
}

impl Drawing {
    /// A shaded head in the studio, before its ground.
    pub fn new(camera: Camera) -> Self {
        Self {
            camera,
            shading: Shading::Shaded,
            preset: Preset::default(),
            background: Background::default(),
            light_turn: 0.0,
            on_card: false,
            skin_opacity: 1.0,
            n_strands: 0,
            condition: Condition::default(),
            samples: Samples::default(),
            pixels_per_point: 1.0,
        }
    }
}

/// What of a picture is drawn, in the order in which it is: each with all before it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Stage {
    /// Nothing but uploads, and a picture that is cleared.
    Cleared,
    /// The maps of the lights' shadows.
    Shadows,
    /// What stands behind the head.
    Ground,
    /// Strands of hair.
    Strands,
    /// Surfaces, and lines over them: the whole picture.
    Surfaces,
}

impl Stage {
    /// Every stage in its order.
    pub const ALL: [Self; 5] = [Self::Cleared, Self::Shadows, Self::Ground, Self::Strands, Self::Surfaces];

    /// What it adds to the one before.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Cleared => "upload and clear",
            Self::Shadows => "shadow maps",
            Self::Ground => "ground",
            Self::Strands => "strands",
            Self::Surfaces => "surfaces",
        }
    }
}

/// Pipelines once per device and shader text; the head's buffers once per topology.
#[derive(Debug)]
pub struct Painter {
    passes: Passes,
    globals_layout: wgpu::BindGroupLayout,
    globals: wgpu::Buffer,
    globals_bindings: wgpu::BindGroup,
    quality: Quality,
    head: Option<HeadBuffers>,
    /// None on a device without compute shaders.
    subdivide: Option<SubdividePass>,
    /// The skin's plan on the card, for the head at hand.
    plan: Option<PlanBuffers>,
}

/// The buffers of a head that is drawn beside a painter's own, which stays as it is.
#[derive(Debug, Default)]
pub struct Aside {
    head: Option<HeadBuffers>,
}

#[derive(Debug)]
struct Passes {
    ground: GroundPass,
    shadow: ShadowPass,
    mesh: MeshPass,
    wire: WirePass,
    /// None on a device that cannot draw hair.
    strand: Option<StrandPass>,
}

impl Passes {
    fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        sources: &ShaderSources,
        globals: &wgpu::BindGroupLayout,
        quality: Quality,
    ) -> Result<Self, ShaderError> {
        let shadow = ShadowPass::new(device, sources, globals)?;
        let mesh = MeshPass::new(device, queue, sources, globals, &shadow, quality)?;
        Ok(Self {
            ground: GroundPass::new(device, sources, globals, &mesh.layout)?,
            mesh,
            wire: WirePass::new(device, sources, globals)?,
            strand: StrandPass::new_if_able(device, queue, sources, globals, quality)?,
            shadow,
        })
    }
}

impl Painter {
    /// Compiles the shaders.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        sources: &ShaderSources,
        quality: Quality,
    ) -> Result<Self, ShaderError> {
        let globals_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("globals"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let globals = buffer(device, "globals", size_of::<Globals>(), wgpu::BufferUsages::UNIFORM);
        let globals_bindings = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("globals"),
            layout: &globals_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: globals.as_entire_binding() }],
        });
        let passes = Passes::new(device, queue, sources, &globals_layout, quality)?;
        let subdivide = SubdividePass::new_if_able(device, sources)?;
        Ok(Self { passes, globals_layout, globals, globals_bindings, quality, head: None, subdivide, plan: None })
    }

    /// Takes other shader texts. On an error everything stays as it was.
    pub fn reload(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        sources: &ShaderSources,
    ) -> Result<(), ShaderError> {
        let passes = Passes::new(device, queue, sources, &self.globals_layout, self.quality)?;
        self.subdivide = SubdividePass::new_if_able(device, sources)?;
        self.passes = passes;
        self.plan = None;
        Ok(())
    }

    /// Forgets the head: to be called when frames come from another pipeline, whose revisions count anew.
    pub fn forget(&mut self) {
        self.head = None;
        self.plan = None;
        self.passes.wire.forget();
        if let Some(strand) = &mut self.passes.strand {
            strand.forget();
        }
    }

    /// Bytes uploaded for hair so far.
    pub fn hair_bytes(&self) -> u64 {
        self.passes.strand.as_ref().map_or(0, StrandPass::n_bytes)
    }

    /// Uploads what changed since the last frame, and records one picture of it.
    pub fn draw(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        frame: &Frame<'_>,
        drawing: &Drawing,
    ) {
        self.draw_until(Stage::Surfaces, device, queue, encoder, targets, frame, drawing);
    }

    /// The same for another head than the painter's own, without lines, without hair, and without the card's help. What this
    /// records has to be submitted before anything else is drawn.
    #[expect(clippy::too_many_arguments, reason = "those of a whole picture, and whose")]
    pub fn draw_aside(
        &mut self,
        aside: &mut Aside,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        frame: &Frame<'_>,
        drawing: &Drawing,
    ) {
        let plain = Drawing { shading: Shading::Shaded, n_strands: 0, on_card: false, ..*drawing };
        let plan = self.plan.take();
        std::mem::swap(&mut self.head, &mut aside.head);
        self.draw(device, queue, encoder, targets, frame, &plain);
        std::mem::swap(&mut self.head, &mut aside.head);
        self.plan = plan;
    }

    /// The same, up to a stage of the picture: for who measures what each costs.
    #[expect(clippy::too_many_arguments, reason = "those of a whole picture, and how far")]
    pub fn draw_until(
        &mut self,
        until: Stage,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        frame: &Frame<'_>,
        drawing: &Drawing,
    ) {
        let plan = frame.plan.filter(|plan| frame.is_planned && drawing.on_card && SubdividePass::takes(device, plan));
        let pass = self.subdivide.as_ref().zip(plan);
        if !self.head.as_ref().is_some_and(|head| head.fits(frame)) {
            self.plan = None;
        }
        let head = match &mut self.head {
            Some(head) if head.fits(frame) => head,
            other => other.insert(HeadBuffers::new(device, frame)),
        };
        let changed = head.update(queue, frame, if pass.is_some() { SkinBy::Card } else { SkinBy::Upload });
        if let (Some((pass, plan)), true) = (pass, changed) {
            let positions = (&head.positions, &head.normals);
            let buffers = self.plan.get_or_insert_with(|| pass.load(device, queue, plan, positions.0, positions.1));
            buffers.write_control(queue, frame.control);
            pass.record(encoder, buffers);
        }
        let lines = match drawing.shading {
            Shading::Shaded => None,
            Shading::Wireframe => Some(Lines::Refined),
            Shading::Control => Some(Lines::Control),
            Shading::Outlined => Some(Lines::Outlines),
        };
        if let Some(lines) = lines {
            self.passes.wire.load(device, queue, frame, lines, drawing.pixels_per_point);
        }
        let mut extent = Extent::of_box(frame.bounds());
        extent.below = below(frame, &drawing.camera, extent.centre);
        let edges = drawing.background.edges();
        let clear_skin = drawing.skin_opacity < 1.0;
        let coat = frame.coat.filter(|c| drawing.n_strands.min(c.roots.len() as u32) > 0 && !clear_skin);
        let hair = self.passes.strand.as_mut().zip(coat).map(|(pass, coat)| {
            pass.load(device, queue, &coat, frame.revisions, drawing.n_strands, head, &self.passes.mesh);
            extent.margin = LONGEST * coat.hair.longest() * drawing.condition.length;
            &*pass
        });
        let mut globals = Globals::new(
            &drawing.camera,
            extent,
            targets.size,
            drawing.light_turn,
            shadow_pass::TEXELS[0],
            edges,
            drawing.skin_opacity,
            drawing.preset,
        );
        globals.set_eyes(frame.eyes);
        let youth = frame.coat.map_or(0.0, |coat| coat.youth);
        let n_strands = if hair.is_some() { drawing.n_strands } else { 0 };
        globals.set_hair(&drawing.condition, youth, 2.0 * extent.radius, n_strands);
        queue.write_buffer(&self.globals, 0, bytemuck::bytes_of(&globals));

        if until >= Stage::Shadows {
            self.passes.shadow.draw(encoder, &self.globals_bindings, head, clear_skin, self.quality);
        }
        let mut pass = targets.begin(encoder);
        pass.set_bind_group(0, &self.globals_bindings, &[]);
        if until >= Stage::Ground {
            self.passes.ground.draw(&mut pass, &self.passes.mesh.bindings);
        }
        // Hair first: what it hides of the skin, which is dearer, is not shaded.
        if let Some(hair) = hair.filter(|_| until >= Stage::Strands) {
            hair.draw(&mut pass);
        }
        if until < Stage::Surfaces {
            return;
        }
        self.passes.mesh.draw(device, &mut pass, head, clear_skin);
        if lines.is_some() {
            self.passes.wire.draw(&mut pass);
        }
    }
}

/// How far the lowest point of a head, as it is carried, lies below another one, metres.
fn below(frame: &Frame<'_>, camera: &Camera, centre: Vec3) -> f32 {
    let up = camera.world_from_head().transpose() * Vec3::Y;
    let points = frame.body().flat_map(|part| part.positions);
    points.map(|&p| up.dot(centre - p)).fold(0.0, f32::max)
}
