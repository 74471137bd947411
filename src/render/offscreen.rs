//! Pictures in memory, without a window.

use super::gpu::Gpu;
use super::mesh_pass::Quality;
use super::painter::{Drawing, Painter, Stage};
use super::picture::Picture;
use super::samples::Samples;
use super::shader_source::{ShaderError, ShaderSources};
use super::targets::{COLOUR, Targets};
use crate::frame::Frame;
use thiserror::Error;

/// Why a picture was not drawn.
#[derive(Clone, Debug, Error)]
pub enum DrawError {
    /// Wider or higher than the device can draw, or empty.
    #[error("a picture of {width} by {height} pixels cannot be drawn here: each side must be 1 to {most}")]
    Size {
        /// Asked for.
        width: u32,
        /// Asked for.
        height: u32,
        /// The longest side this device can draw.
        most: u32,
    },
    /// More samples than the device can draw of so large a picture.
    #[error(
        "{samples} samples a pixel need {width} by {height} pixels, and each side must be at most {most} here: ask for \
         fewer samples or a smaller picture"
    )]
    Samples {
        /// Asked for.
        samples: u32,
        /// Of what would be drawn.
        width: u32,
        /// Of what would be drawn.
        height: u32,
        /// The longest side this device can draw.
        most: u32,
    },
    /// The pixels did not come back.
    #[error("the graphics device gave no pixels: {0}")]
    ReadBack(String),
}

/// A painter with a device of its own; targets are kept while pictures have one size.
#[derive(Debug)]
pub struct Offscreen {
    gpu: Gpu,
    painter: Painter,
    targets: Option<Targets>,
}

impl Offscreen {
    /// Compiles the built-in shaders on the device.
    pub fn new(gpu: Gpu) -> Result<Self, ShaderError> {
        Self::with_shaders(gpu, &ShaderSources::default())
    }

    /// Compiles other shaders on the device.
    pub fn with_shaders(gpu: Gpu, sources: &ShaderSources) -> Result<Self, ShaderError> {
        let painter = Painter::new(&gpu.device, &gpu.queue, sources, Quality::Full)?;
        Ok(Self { gpu, painter, targets: None })
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.gpu
    }

    /// Forgets the last head: see [`Painter::forget`].
    pub fn forget(&mut self) {
        self.painter.forget();
    }

    /// Bytes uploaded for hair so far.
    pub fn hair_bytes(&self) -> u64 {
        self.painter.hair_bytes()
    }

    /// Compiles the built-in shaders on the device, at another quality than the best.
    pub fn with_quality(gpu: Gpu, quality: Quality) -> Result<Self, ShaderError> {
        let painter = Painter::new(&gpu.device, &gpu.queue, &ShaderSources::default(), quality)?;
        Ok(Self { gpu, painter, targets: None })
    }

    /// Draws a picture up to a stage, as a window draws it, and waits until it is done: for who measures what that takes.
    /// `size`: pixels, each at least 1 and at most the device's limit.
    pub fn run(&mut self, until: Stage, frame: &Frame<'_>, drawing: &Drawing, size: [u32; 2]) -> Result<(), DrawError> {
        let Gpu { device, queue, .. } = &self.gpu;
        let targets = match &mut self.targets {
            Some(targets) if targets.size == size => targets,
            other => other.insert(Targets::new(device, size)),
        };
        let mut encoder = device.create_command_encoder(&Default::default());
        self.painter.draw_until(until, device, queue, &mut encoder, targets, frame, drawing);
        queue.submit([encoder.finish()]);
        device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| DrawError::ReadBack(e.to_string()))?;
        Ok(())
    }

    /// Draws one frame of a head. `size`: width and height, pixels.
    ///
    /// Where the device cannot draw so many samples as a picture has unless somebody asks for others, it has fewer.
    pub fn draw(&mut self, frame: &Frame<'_>, drawing: &Drawing, size: [u32; 2]) -> Result<Picture, DrawError> {
        let most = self.gpu.device.limits().max_texture_dimension_2d;
        let [width, height] = size;
        if width.min(height) == 0 || width.max(height) > most {
            return Err(DrawError::Size { width, height, most });
        }
        let mut side = drawing.samples.side();
        if width.max(height).saturating_mul(side) > most {
            if drawing.samples != Samples::default() {
                let (width, height) = (width.saturating_mul(side), height.saturating_mul(side));
                return Err(DrawError::Samples { samples: drawing.samples.count(), width, height, most });
            }
            side = Samples::FEWEST.side();
        }
        let drawing = Drawing { pixels_per_point: drawing.pixels_per_point * side as f32, ..*drawing };
        let large = self.draw_once(frame, &drawing, [width * side, height * side])?;
        Ok(if side > 1 { large.reduced(side) } else { large })
    }

    fn draw_once(&mut self, frame: &Frame<'_>, drawing: &Drawing, size: [u32; 2]) -> Result<Picture, DrawError> {
        let Gpu { device, queue, .. } = &self.gpu;
        let targets = match &mut self.targets {
            Some(targets) if targets.size == size => targets,
            other => other.insert(Targets::new(device, size)),
        };
        let mut encoder = device.create_command_encoder(&Default::default());
        self.painter.draw(device, queue, &mut encoder, targets, frame, drawing);
        read_back(device, queue, encoder, targets)
    }
}

/// Submits the commands, waits, and copies the finished picture into memory.
fn read_back(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    mut encoder: wgpu::CommandEncoder,
    targets: &Targets,
) -> Result<Picture, DrawError> {
    debug_assert_eq!(targets.colour.format(), COLOUR);
    let [width, height] = targets.size;
    let row = width as usize * 4;
    let padded = (width * 4).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read back"),
        size: u64::from(padded) * u64::from(height),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(padded), rows_per_image: None };
    encoder.copy_texture_to_buffer(
        targets.colour.as_image_copy(),
        wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
        targets.colour.size(),
    );
    queue.submit([encoder.finish()]);
    let failed = |e: &dyn std::fmt::Display| DrawError::ReadBack(e.to_string());
    let (sender, receiver) = std::sync::mpsc::channel();
    buffer.map_async(wgpu::MapMode::Read, .., move |result| {
        // The receiver is gone only after an error that was reported already.
        let _ = sender.send(result);
    });
    device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| failed(&e))?;
    receiver.recv().map_err(|e| failed(&e))?.map_err(|e| failed(&e))?;
    let bytes = buffer.get_mapped_range(..).map_err(|e| failed(&e))?;
    let mut rgba = Vec::with_capacity(row * height as usize);
    for padded_row in bytes.chunks(padded as usize) {
        rgba.extend_from_slice(&padded_row[..row]);
    }
    rgba.chunks_exact_mut(4).for_each(unpremultiply);
    Ok(Picture { width, height, rgba })
}

fn unpremultiply(pixel: &mut [u8]) {
    let alpha = u32::from(pixel[3]);
    if alpha != 0 && alpha != 255 {
        for channel in &mut pixel[..3] {
            *channel = ((u32::from(*channel) * 255 + alpha / 2) / alpha).min(255) as u8;
        }
    }
}
