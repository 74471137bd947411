//! What the window's own work takes, measured without a window: a slider is dragged, every picture is another head.

use super::run::{AppError, Launch, begin};
use super::turn::{Turn, TurnError, milliseconds};
use crate::render::{Gpu, ShaderSources};
use std::time::Instant;

/// Pictures before those that count: fonts, pipelines and buffers are made in the first ones.
const WARM_UP: usize = 10;
/// What the slider drags through its range.
const MEASURE: &str = "facial_length_mm";
/// Pictures from one end of the range to the other.
const WAY: usize = 40;

/// Medians over the pictures, milliseconds.
#[derive(Clone, Debug, PartialEq)]
pub struct Measured {
    /// Who draws.
    pub adapter: String,
    /// Refinement.
    pub level: u32,
    /// Drawn in each picture.
    pub n_triangles: usize,
    /// Input and panels.
    pub panels_ms: f32,
    /// From values to vertices.
    pub head_ms: f32,
    /// Uploads, passes, tessellated panels.
    pub record_ms: f32,
    /// The three together: the program's own work.
    pub own_ms: f32,
    /// The same, of the slowest picture in twenty.
    pub own_slow_ms: f32,
    /// Handing it over: the library checks and translates for the driver. What the driver does then is not counted.
    pub submit_ms: f32,
    /// Of the picture, pixels.
    pub picture: [u32; 2],
    /// Of hair.
    pub n_strands: u32,
    /// The driver's own work on a picture and the panels, waited for.
    pub draw_ms: f32,
    /// The same while something is dragged, when a driver on a processor is given fewer pixels.
    pub drag_ms: f32,
    /// What the panel of measurements adds to a picture while it is open: one head measured.
    pub measure_ms: f32,
}

/// Runs so many pictures of the window, each of another head, and waits for the driver after each; then half as
/// many while the pointer is held down. `window`: width and height in points, of one pixel each.
///
/// # Errors
/// No adapter, or a file to begin with that is wrong.
pub fn measure(launch: &Launch, n_frames: usize, window: [u32; 2]) -> Result<Measured, AppError> {
    let state = begin(launch)?;
    let gpu = Gpu::open().map_err(AppError::NoAdapter)?;
    let adapter = gpu.name();
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let [width, height] = window;
    let target = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("window"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    });
    let view = target.create_view(&Default::default());
    let mut turn = Turn::new(gpu, format, &ShaderSources::default(), state, launch)
        .map_err(|e: TurnError| AppError::Other(e.to_string()))?;
    let row = turn.state.table.index_of(MEASURE);

    let mut times: [Vec<f32>; 6] = Default::default();
    let mut drag_ms = Vec::new();
    for n in 0..WARM_UP + n_frames + n_frames.div_ceil(2) {
        let is_dragged = n >= WARM_UP + n_frames;
        let start = Instant::now();
        if let Some(row) = row {
            let spec = &turn.state.table.specs[row];
            let (min, max) = (spec.min_si(), spec.max_si());
            let part = ((n % (2 * WAY)) as f32 / WAY as f32 - 1.0).abs();
            turn.state.begin_gesture();
            turn.state.set_value(row, min + (max - min) * part);
        }
        let mut output = turn.panels(input(n, is_dragged, window));
        let panels_ms = milliseconds(start);
        let mut recorded = turn.record(&mut output, window);
        let own_ms = milliseconds(start);
        let head_ms = recorded.head_ms.take().unwrap_or_default();
        let submit = Instant::now();
        turn.submit(recorded, Some(&view));
        let submit_ms = milliseconds(submit);
        // The driver is to be done before the next picture: what it does on this processor would be counted with it.
        let draw = Instant::now();
        turn.gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| AppError::Other(e.to_string()))?;
        let draw_ms = milliseconds(draw);
        if is_dragged {
            drag_ms.push(draw_ms);
        } else if n >= WARM_UP {
            let all = [panels_ms, head_ms, own_ms - panels_ms - head_ms, own_ms, submit_ms, draw_ms];
            times.iter_mut().zip(all).for_each(|(list, ms)| list.push(ms));
        }
    }
    let mut measure_ms = Vec::new();
    for n in 0..WARM_UP + n_frames {
        if let Some(row) = row {
            turn.state.set_value(row, turn.state.table.specs[row].min_si() + 1e-4 * (n + 1) as f32);
        }
        let start = Instant::now();
        turn.state.measure();
        measure_ms.push(milliseconds(start));
    }
    measure_ms.drain(..WARM_UP);
    measure_ms.sort_by(f32::total_cmp);
    drag_ms.sort_by(f32::total_cmp);
    times.iter_mut().for_each(|list| list.sort_by(f32::total_cmp));
    let at = |list: &[f32], part: f32| {
        let last = list.len().saturating_sub(1);
        list.get((last as f32 * part).round() as usize).copied().unwrap_or_default()
    };
    let [panels_ms, head_ms, record_ms, own_ms, submit_ms, draw_ms] = [0, 1, 2, 3, 4, 5].map(|k| at(&times[k], 0.5));
    Ok(Measured {
        adapter,
        level: turn.state.level(),
        n_triangles: turn.state.n_triangles,
        panels_ms,
        head_ms,
        record_ms,
        own_ms,
        own_slow_ms: at(&times[3], 0.95),
        submit_ms,
        picture: turn.picture_size,
        n_strands: turn.state.n_strands,
        draw_ms,
        drag_ms: at(&drag_ms, 0.5),
        measure_ms: at(&measure_ms, 0.5),
    })
}

/// A pointer over the panel at the left, or one that drags in the picture.
fn input(n: usize, is_dragged: bool, [width, height]: [u32; 2]) -> egui::RawInput {
    let size = egui::vec2(width as f32, height as f32);
    let at = if is_dragged { size * 0.7 } else { egui::vec2(40.0, 0.5 * size.y) };
    let pos = at.to_pos2() + egui::vec2((n % 20) as f32, 0.0);
    let button = egui::PointerButton::Primary;
    let press = egui::Event::PointerButton { pos, button, pressed: true, modifiers: Default::default() };
    egui::RawInput {
        screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, size)),
        time: Some(n as f64 / 60.0),
        focused: true,
        events: std::iter::once(egui::Event::PointerMoved(pos)).chain(is_dragged.then_some(press)).collect(),
        ..Default::default()
    }
}
