//! The picture inside the window: drawn when something in it has changed, and never twice.

use crate::frame::{Frame, Revisions};
use crate::render::{Aside, Drawing, Gpu, Painter, Quality, ShaderError, ShaderSources, Targets};

/// Painter, targets, and the texture under which egui knows the picture.
pub(super) struct Scene {
    painter: Painter,
    targets: Targets,
    texture: egui::TextureId,
    drawn: Option<(Drawing, Revisions)>,
}

impl Scene {
    pub(super) fn new(
        gpu: &Gpu,
        renderer: &mut egui_wgpu::Renderer,
        sources: &ShaderSources,
    ) -> Result<Self, ShaderError> {
        let quality = if gpu.is_software() { Quality::Draft } else { Quality::Full };
        let painter = Painter::new(&gpu.device, &gpu.queue, sources, quality)?;
        let targets = Targets::new(&gpu.device, [16, 16]);
        let smooth = wgpu::FilterMode::Linear;
        let texture = renderer.register_native_texture(&gpu.device, &targets.colour_view, smooth);
        Ok(Self { painter, targets, texture, drawn: None })
    }

    pub(super) fn texture(&self) -> egui::TextureId {
        self.texture
    }

    /// Takes other shaders; on an error the picture goes on with the old ones.
    pub(super) fn reload(&mut self, gpu: &Gpu, sources: &ShaderSources) -> Result<(), ShaderError> {
        self.painter.reload(&gpu.device, &gpu.queue, sources)?;
        self.drawn = None;
        Ok(())
    }

    /// Forgets the head: frames come from another pipeline now.
    pub(super) fn forget(&mut self) {
        self.painter.forget();
        self.drawn = None;
    }

    /// Records the picture, if it is another than the last one. `size`: pixels.
    pub(super) fn draw(
        &mut self,
        gpu: &Gpu,
        renderer: &mut egui_wgpu::Renderer,
        encoder: &mut wgpu::CommandEncoder,
        frame: &Frame<'_>,
        drawing: &Drawing,
        size: [u32; 2],
    ) {
        if self.targets.size != size {
            self.targets = Targets::new(&gpu.device, size);
            let (view, smooth) = (&self.targets.colour_view, wgpu::FilterMode::Linear);
            renderer.update_egui_texture_from_wgpu_texture(&gpu.device, view, smooth, self.texture);
            self.drawn = None;
        }
        let now = (*drawing, frame.revisions);
        if self.drawn != Some(now) {
            self.painter.draw(&gpu.device, &gpu.queue, encoder, &self.targets, frame, drawing);
            self.drawn = Some(now);
        }
    }

    /// Records a picture of another head into other targets; to be submitted before this one is drawn again.
    pub(super) fn draw_aside(
        &mut self,
        gpu: &Gpu,
        aside: &mut Aside,
        encoder: &mut wgpu::CommandEncoder,
        targets: &Targets,
        frame: &Frame<'_>,
        drawing: &Drawing,
    ) {
        self.painter.draw_aside(aside, &gpu.device, &gpu.queue, encoder, targets, frame, drawing);
    }
}
