//! One picture of the window, up to where the driver takes over: panels, head, uploads, recorded passes.
//!
//! The window runs it, and so does the measurement of it, so that what is measured is what runs.

use super::panels;
use super::run::Launch;
use super::scene::Scene;
use super::state::EditorState;
use super::thumbnails::Thumbnails;
use crate::frame::{Frame, Pipeline, PipelineError};
use crate::render::{Drawing, Gpu, Samples, ShaderError, ShaderSources, Shading};
use crate::rig::{Rig, RigError};
use std::sync::Arc;
use std::time::Instant;
use thiserror::Error;

/// Why there is nothing to show.
#[derive(Debug, Error)]
pub(super) enum TurnError {
    /// A shader.
    #[error(transparent)]
    Shader(#[from] ShaderError),
    /// The head, under this table.
    #[error(transparent)]
    Rig(#[from] RigError),
    /// The head, at this level.
    #[error(transparent)]
    Pipeline(#[from] PipelineError),
}

/// Strands of hair on a window's head at first, where a graphics card draws it and where a processor does.
const HAIR: u32 = 90_000;
const HAIR_BY_SOFTWARE: u32 = 1000;
/// How finely a head is made at first where a processor draws.
const LEVEL_BY_SOFTWARE: u32 = 2;

/// What a window shows and what draws it; as long as the device.
pub(super) struct Turn {
    pub(super) gpu: Gpu,
    pub(super) context: egui::Context,
    pub(super) state: EditorState,
    pub(super) pipeline: Pipeline,
    pub(super) scene: Scene,
    renderer: egui_wgpu::Renderer,
    /// Once the panel that has them is shown.
    thumbnails: Option<Thumbnails>,
    /// Of the picture, pixels.
    pub(super) picture_size: [u32; 2],
    /// The revision of the head's shape that was drawn last.
    shape: u64,
}

/// Everything of one picture that the driver is still to do.
pub(super) struct Recorded {
    encoder: wgpu::CommandEncoder,
    buffers: Vec<wgpu::CommandBuffer>,
    jobs: Vec<egui::ClippedPrimitive>,
    screen: egui_wgpu::ScreenDescriptor,
    free: Vec<egui::TextureId>,
    /// The head, where it has moved: from values to vertices, milliseconds.
    pub(super) head_ms: Option<f32>,
    /// Something is left for a turn in which nothing else goes on.
    pub(super) is_unfinished: bool,
}

impl Turn {
    /// `format`: of what the panels are painted on; level and hair are those of the launch, or what suits the driver.
    pub(super) fn new(
        gpu: Gpu,
        format: wgpu::TextureFormat,
        sources: &ShaderSources,
        mut state: EditorState,
        launch: &Launch,
    ) -> Result<Self, TurnError> {
        let (level, n_strands) =
            if gpu.is_software() { (LEVEL_BY_SOFTWARE, HAIR_BY_SOFTWARE) } else { (state.level(), HAIR) };
        state.set_level(launch.level.unwrap_or(level));
        state.n_strands = launch.n_strands.unwrap_or(n_strands);
        let context = egui::Context::default();
        panels::set_fonts(&context);
        let mut renderer = egui_wgpu::Renderer::new(&gpu.device, format, egui_wgpu::RendererOptions::default());
        let scene = Scene::new(&gpu, &mut renderer, sources)?;
        let rig = Arc::new(Rig::embedded(&state.table)?);
        let pipeline = Pipeline::new(rig, state.level())?;
        Ok(Self { gpu, context, state, pipeline, scene, renderer, thumbnails: None, picture_size: [16, 16], shape: 0 })
    }

    /// The panels change the state.
    pub(super) fn panels(&mut self, input: egui::RawInput) -> egui::FullOutput {
        let mut area = egui::Rect::ZERO;
        let (state, texture) = (&mut self.state, self.scene.texture());
        let output = self.context.run_ui(input, |ui| area = panels::show(state, ui, Some(texture)));
        let largest = self.gpu.device.limits().max_texture_dimension_2d as f32;
        let pixels = |points: f32| (points * output.pixels_per_point).round().clamp(1.0, largest) as u32;
        self.picture_size = [area.width(), area.height()].map(pixels);
        output
    }

    /// The head follows the state, goes to the graphics card, and everything is recorded. `size`: of the window, pixels.
    pub(super) fn record(&mut self, output: &mut egui::FullOutput, size: [u32; 2]) -> Recorded {
        let is_unfinished = self.draw_thumbnail();
        let (device, queue) = (&self.gpu.device, &self.gpu.queue);
        let scale = output.pixels_per_point;
        let start = Instant::now();
        if let Err(e) = self.pipeline.set_level(self.state.level()) {
            self.state.complain(e.to_string());
        }
        if let Err(e) = self.pipeline.set_layers(self.state.layers) {
            self.state.complain(e.to_string());
        }
        self.pipeline.set_hair(self.state.n_strands as usize);
        self.pipeline.set_pose(self.state.pose());
        let frame = self.pipeline.update(self.state.breed());
        // Turning the camera leaves the head as it is: the last time that it moved is what is worth knowing.
        let has_moved = frame.revisions.shape != self.shape;
        self.shape = frame.revisions.shape;
        let head_ms = has_moved.then(|| milliseconds(start));
        follow(&mut self.state, &frame, self.picture_size);

        let mut encoder = device.create_command_encoder(&Default::default());
        // A processor that draws keeps up with the hand, and with time, at half the size; the full picture follows.
        let is_moving = self.state.motion.is_playing || self.context.input(|i| i.pointer.any_down());
        let is_rough = self.gpu.is_software() && is_moving;
        let picture = self.picture_size.map(|s| if is_rough { s.div_ceil(2) } else { s });
        let drawing = drawing(&self.state, scale);
        self.scene.draw(&self.gpu, &mut self.renderer, &mut encoder, &frame, &drawing, picture);

        let jobs = self.context.tessellate(std::mem::take(&mut output.shapes), scale);
        for (id, deltas) in output.textures_delta.set.drain() {
            deltas.iter().for_each(|delta| self.renderer.update_texture(device, queue, id, delta));
        }
        let screen = egui_wgpu::ScreenDescriptor { size_in_pixels: size, pixels_per_point: scale };
        let buffers = self.renderer.update_buffers(device, queue, &mut encoder, &jobs, &screen);
        let free = output.textures_delta.free.drain().collect();
        Recorded { encoder, buffers, jobs, screen, free, head_ms, is_unfinished }
    }

    /// Draws one small picture for the panel of motion while nothing else goes on. Returns whether there are more.
    fn draw_thumbnail(&mut self) -> bool {
        let motion = &self.state.motion;
        let is_busy = motion.is_playing || self.context.input(|i| i.pointer.any_down());
        if !motion.is_open || is_busy {
            return false;
        }
        let rig = self.pipeline.rig();
        let thumbnails = match self.thumbnails.take().filter(|t| t.is_of(rig)) {
            Some(thumbnails) => Ok(thumbnails),
            None => Thumbnails::new(&self.gpu, &mut self.renderer, rig.clone(), motion.library.expressions.len()),
        };
        match thumbnails {
            Ok(mut thumbnails) => {
                let breed = self.state.breed();
                let has_more = thumbnails.step(&self.gpu, &mut self.scene, breed, &motion.library);
                let is_new = self.state.pictures != Some(thumbnails.pictures());
                self.state.pictures = Some(thumbnails.pictures());
                self.thumbnails = Some(thumbnails);
                has_more || is_new
            }
            Err(e) => {
                self.state.complain(e.to_string());
                false
            }
        }
    }

    /// Paints the panels over everything and hands it to the driver; without a target the uploads only.
    pub(super) fn submit(&mut self, recorded: Recorded, target: Option<&wgpu::TextureView>) {
        let Recorded { mut encoder, mut buffers, jobs, screen, free, .. } = recorded;
        if let Some(view) = target {
            let attachment = wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            };
            let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("panels"),
                color_attachments: &[Some(attachment)],
                ..Default::default()
            });
            self.renderer.render(&mut pass.forget_lifetime(), &jobs, &screen);
        }
        buffers.push(encoder.finish());
        self.gpu.queue.submit(buffers);
        free.iter().for_each(|id| self.renderer.free_texture(id));
    }
}

fn follow(state: &mut EditorState, frame: &Frame<'_>, [width, height]: [u32; 2]) {
    if state.wants_fit {
        state.fit_camera(frame.outline().iter(), width as f32 / height as f32);
    }
    state.n_triangles = frame.n_triangles();
}

pub(super) fn drawing(state: &EditorState, pixels_per_point: f32) -> Drawing {
    Drawing {
        camera: state.camera,
        shading: state.shading,
        preset: state.preset(),
        background: state.background,
        light_turn: state.light_turn,
        on_card: state.on_card,
        skin_opacity: state.layers.skin,
        // Hair would hide the lines.
        n_strands: if state.shading == Shading::Shaded && state.preset().has_hair() { state.n_strands } else { 0 },
        condition: state.condition,
        samples: Samples::FEWEST,
        pixels_per_point,
    }
}

pub(super) fn milliseconds(since: Instant) -> f32 {
    since.elapsed().as_secs_f32() * 1000.0
}
