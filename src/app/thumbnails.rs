//! Small pictures of the dog that is shown in every expression, for the buttons of the panel.
//!
//! Each is drawn in a turn in which nothing else goes on, by the window's own painter and from a coarse head of its own: no
//! drag and no clip waits for them. Until those of another dog are there, the ones before stay. They live as long as the
//! rig.

use super::scene::Scene;
use crate::anatomy::Breed;
use crate::frame::{Layers, Pipeline, PipelineError};
use crate::motion::{Library, Pose};
use crate::render::{Aside, Camera, Drawing, Gpu, Lens, Targets, View};
use crate::rig::Rig;
use std::sync::Arc;

/// Of a picture, pixels.
const SIDE: u32 = 144;
/// Pictures side by side in the texture that has them all.
const COLUMNS: u32 = 5;
/// How finely the head is made.
const LEVEL: u32 = 2;
/// The neck may leave the picture, the face fills it.
const NEARER: f32 = 1.15;

/// Where a panel finds the pictures.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pictures {
    texture: egui::TextureId,
    /// How many there are, from the first expression on.
    n: usize,
    n_rows: u32,
}

impl Pictures {
    /// The texture and the part of it that shows an expression; none before it is drawn first.
    pub fn of(&self, expression: usize) -> Option<(egui::TextureId, egui::Rect)> {
        let [x, y] = cell(expression).map(|at| at as f32);
        let [width, height] = [COLUMNS, self.n_rows].map(|n| n as f32);
        // Half a pixel inside, or the neighbour would show.
        let inset = 0.5 / SIDE as f32;
        let at = |x: f32, y: f32| egui::pos2(x / width, y / height);
        let part = egui::Rect::from_min_max(at(x + inset, y + inset), at(x + 1.0 - inset, y + 1.0 - inset));
        (expression < self.n).then_some((self.texture, part))
    }
}

/// Column and row.
fn cell(expression: usize) -> [u32; 2] {
    [expression as u32 % COLUMNS, expression as u32 / COLUMNS]
}

pub(super) struct Thumbnails {
    pipeline: Pipeline,
    aside: Aside,
    targets: Targets,
    all: wgpu::Texture,
    pictures: Pictures,
    /// Whose pictures these are to be, and how many of them are drawn.
    breed: Option<Breed>,
    n_drawn: usize,
    /// Of the head at rest, and what it looks at there: the middle of the head, which it goes with.
    camera: Camera,
}

impl Thumbnails {
    pub(super) fn new(
        gpu: &Gpu,
        renderer: &mut egui_wgpu::Renderer,
        rig: Arc<Rig>,
        n: usize,
    ) -> Result<Self, PipelineError> {
        let mut pipeline = Pipeline::new(rig, LEVEL)?;
        pipeline.set_layers(Layers::default().with_open_mouth())?;
        let n_rows = (n as u32).div_ceil(COLUMNS);
        let targets = Targets::new(&gpu.device, [SIDE; 2]);
        let all = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("thumbnails"),
            size: wgpu::Extent3d { width: COLUMNS * SIDE, height: n_rows * SIDE, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: targets.colour.format(),
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let view = all.create_view(&Default::default());
        let texture = renderer.register_native_texture(&gpu.device, &view, wgpu::FilterMode::Linear);
        let pictures = Pictures { texture, n: 0, n_rows };
        let camera = Camera::at(View::Portrait, None, Lens::default());
        Ok(Self { pipeline, aside: Aside::default(), targets, all, pictures, breed: None, n_drawn: 0, camera })
    }

    /// Whether they are of heads of this rig.
    pub(super) fn is_of(&self, rig: &Arc<Rig>) -> bool {
        Arc::ptr_eq(self.pipeline.rig(), rig)
    }

    pub(super) fn pictures(&self) -> Pictures {
        self.pictures
    }

    /// Draws the next picture of a dog, and hands it to the driver. Returns whether there are more to draw.
    pub(super) fn step(&mut self, gpu: &Gpu, scene: &mut Scene, breed: &Breed, library: &Library) -> bool {
        let is_known = |known: &Breed| known.values == breed.values && known.look == breed.look;
        if !self.breed.as_ref().is_some_and(is_known) {
            self.breed = Some(breed.clone());
            self.n_drawn = 0;
            self.pipeline.set_pose(Pose::default());
            let frame = self.pipeline.update(breed);
            self.camera = Camera::at(View::Portrait, None, Lens::default());
            self.camera.fit(frame.outline().iter(), 1.0, 0.0);
            self.camera.zoom(NEARER);
        }
        let Some(expression) = library.expressions.get(self.n_drawn) else { return false };
        self.pipeline.set_pose(library.pose(&expression.moment(expression.still_s), 0.0, |_| ()));
        self.pipeline.update(breed);
        let (place, frame) = (self.pipeline.places().head, self.pipeline.frame());
        let to_head = self.camera.world_from_head().transpose();
        let target = self.camera.world_from_head() * place.point(to_head * self.camera.target);
        let camera = Camera { target, ..self.camera };
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        scene.draw_aside(gpu, &mut self.aside, &mut encoder, &self.targets, &frame, &Drawing::new(camera));
        let [x, y] = cell(self.n_drawn).map(|at| at * SIDE);
        let to = wgpu::TexelCopyTextureInfo { origin: wgpu::Origin3d { x, y, z: 0 }, ..self.all.as_image_copy() };
        let size = wgpu::Extent3d { width: SIDE, height: SIDE, depth_or_array_layers: 1 };
        encoder.copy_texture_to_texture(self.targets.colour.as_image_copy(), to, size);
        gpu.queue.submit([encoder.finish()]);
        self.n_drawn += 1;
        self.pictures.n = self.pictures.n.max(self.n_drawn);
        self.n_drawn < library.expressions.len()
    }
}
