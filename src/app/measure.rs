//! What the window's own work takes, measured without a window: a slider is dragged, every picture is another head.

use super::run::{AppError, Launch, begin};
use super::turn::{Turn, TurnError, milliseconds};
use crate::render::{Gpu, ShaderSources};
use std::time::Instant;

/// The window, points; one pixel each.
const SIZE: [u32; 2] = [1280, 800];
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
    /// What the panel of measurements adds to a picture while it is open: one head measured.
    pub measure_ms: f32,
}

/// Runs so many pictures of the window at level 4, each of another head, and waits for the driver after each.
///
/// # Errors
/// No adapter, or a file to begin with that is wrong.
pub fn measure(launch: &Launch, n_frames: usize) -> Result<Measured, AppError> {
    let state = begin(launch)?;
    let gpu = Gpu::open().map_err(AppError::NoAdapter)?;
    let adapter = gpu.name();
    let format = wgpu::TextureFormat::Rgba8Unorm;
    let [width, height] = SIZE;
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
    let mut turn = Turn::new(gpu, format, &ShaderSources::default(), state)
        .map_err(|e: TurnError| AppError::Other(e.to_string()))?;
    let row = turn.state.table.index_of(MEASURE);

    let mut times: [Vec<f32>; 5] = Default::default();
    for n in 0..WARM_UP + n_frames {
        let start = Instant::now();
        if let Some(row) = row {
            let spec = &turn.state.table.specs[row];
            let (min, max) = (spec.min_si(), spec.max_si());
            let part = ((n % (2 * WAY)) as f32 / WAY as f32 - 1.0).abs();
            turn.state.begin_gesture();
            turn.state.set_value(row, min + (max - min) * part);
        }
        let mut output = turn.panels(input(n));
        let panels_ms = milliseconds(start);
        let mut recorded = turn.record(&mut output, SIZE);
        let own_ms = milliseconds(start);
        let head_ms = recorded.head_ms.take().unwrap_or_default();
        let submit = Instant::now();
        turn.submit(recorded, Some(&view));
        let submit_ms = milliseconds(submit);
        // The driver is to be done before the next picture: what it does on this processor would be counted with it.
        turn.gpu.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| AppError::Other(e.to_string()))?;
        if n >= WARM_UP {
            let all = [panels_ms, head_ms, own_ms - panels_ms - head_ms, own_ms, submit_ms];
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
    times.iter_mut().for_each(|list| list.sort_by(f32::total_cmp));
    let at = |list: &[f32], part: f32| {
        let last = list.len().saturating_sub(1);
        list.get((last as f32 * part).round() as usize).copied().unwrap_or_default()
    };
    let [panels_ms, head_ms, record_ms, own_ms, submit_ms] = [0, 1, 2, 3, 4].map(|k| at(&times[k], 0.5));
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
        measure_ms: at(&measure_ms, 0.5),
    })
}

/// A pointer that drags something in the panel at the left.
fn input(n: usize) -> egui::RawInput {
    let size = egui::vec2(SIZE[0] as f32, SIZE[1] as f32);
    egui::RawInput {
        screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, size)),
        time: Some(n as f64 / 60.0),
        focused: true,
        events: vec![egui::Event::PointerMoved(egui::pos2(40.0 + (n % 200) as f32, 400.0))],
        ..Default::default()
    }
}
