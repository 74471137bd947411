//! What the window owns: the surface, the device, the head, and the state it shows.

use super::run::{Launch, Wake};
use super::scene::Scene;
use super::state::{Command, Document, EditorState, Timing};
use super::watch::Watch;
use super::{files, panels};
use crate::anatomy::save_breed;
use crate::export::{self, GlbOptions};
use crate::frame::Pipeline;
use crate::render::{Drawing, Gpu, GpuError, Offscreen, ShaderFile, ShaderSources};
use crate::rig::Rig;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoopProxy};
use winit::window::Window;

/// Why the window cannot be had.
pub(super) enum HostError {
    /// No device.
    Gpu(GpuError),
    /// The window system refuses.
    Window(String),
    /// Not foreseen.
    Other(String),
}

/// What is to be done after a picture.
pub(super) struct After {
    /// The window is to be closed.
    pub(super) quit: bool,
    /// The next picture is wanted after this time at the latest.
    pub(super) repaint_in: Option<Duration>,
}

pub(super) struct Host {
    window: Arc<Window>,
    surface: wgpu::Surface<'static>,
    config: wgpu::SurfaceConfiguration,
    gpu: Gpu,
    egui: egui_winit::State,
    renderer: egui_wgpu::Renderer,
    scene: Scene,
    sources: ShaderSources,
    pipeline: Pipeline,
    state: EditorState,
    watch: Watch,
    launch: Launch,
    title: String,
    /// Of the picture, pixels.
    picture_size: [u32; 2],
    /// The revision of the head's shape that was drawn last.
    shape: u64,
}

impl Host {
    pub(super) fn new(
        event_loop: &ActiveEventLoop,
        instance: &wgpu::Instance,
        proxy: &EventLoopProxy<Wake>,
        launch: &Launch,
        mut state: EditorState,
    ) -> Result<Self, HostError> {
        let attributes = Window::default_attributes()
            .with_title(state.title())
            .with_inner_size(winit::dpi::LogicalSize::new(1280.0, 800.0));
        let window = event_loop.create_window(attributes).map_err(|e| HostError::Window(e.to_string()))?;
        let window = Arc::new(window);
        // Without any driver there is not even a surface to look for an adapter with.
        let surface = instance
            .create_surface(window.clone())
            .map_err(|e| HostError::Gpu(GpuError::NoAdapter { detail: e.to_string(), hint: String::new() }))?;
        let gpu = Gpu::open_for(instance, &surface).map_err(HostError::Gpu)?;

        let size = window.inner_size();
        let format = egui_wgpu::preferred_framebuffer_format(&surface.get_capabilities(&gpu.adapter).formats)
            .map_err(|e| HostError::Other(e.to_string()))?;
        let config = surface
            .get_default_config(&gpu.adapter, size.width.max(1), size.height.max(1))
            .ok_or_else(|| HostError::Other("the adapter cannot draw to this window".into()))?;
        let config = wgpu::SurfaceConfiguration { format, present_mode: wgpu::PresentMode::AutoVsync, ..config };
        surface.configure(&gpu.device, &config);

        let context = egui::Context::default();
        panels::set_fonts(&context);
        let largest = gpu.device.limits().max_texture_dimension_2d as usize;
        let scale = Some(window.scale_factor() as f32);
        let viewport = egui::ViewportId::ROOT;
        let egui = egui_winit::State::new(context, viewport, &window, scale, window.theme(), Some(largest));
        let mut renderer = egui_wgpu::Renderer::new(&gpu.device, format, egui_wgpu::RendererOptions::default());

        let (sources, problems) = shaders_on_disk(launch.shaders.as_deref());
        state.problems.extend(problems);
        let other = |e: &dyn std::fmt::Display| HostError::Other(e.to_string());
        let scene = Scene::new(&gpu, &mut renderer, &sources).map_err(|e| other(&e))?;
        let rig = Arc::new(Rig::embedded(&state.table).map_err(|e| other(&e))?);
        let pipeline = Pipeline::new(rig, state.level()).map_err(|e| other(&e))?;

        let proxy = proxy.clone();
        // A loop that has ended takes no more news, which is as well.
        let mut watch = Watch::new(move |path| drop(proxy.send_event(Wake::Changed(path))));
        if let Some(rigs) = &launch.rigs {
            watch.add(rigs);
            watch.add(&rigs.join("breeds"));
        }
        if let Some(shaders) = &launch.shaders {
            watch.add(shaders);
        }
        let mut host = Self {
            window,
            surface,
            config,
            gpu,
            egui,
            renderer,
            scene,
            sources,
            pipeline,
            state,
            watch,
            launch: launch.clone(),
            title: String::new(),
            picture_size: [16, 16],
            shape: 0,
        };
        host.watch_document();
        host.state.say(format!("Drawn by {}. Press ? for the keys.", host.gpu.name()));
        host.request_redraw();
        Ok(host)
    }

    pub(super) fn request_redraw(&self) {
        self.window.request_redraw();
    }

    pub(super) fn on_event(&mut self, event: &WindowEvent) {
        if self.egui.on_window_event(&self.window, event).repaint && *event != WindowEvent::RedrawRequested {
            self.request_redraw();
        }
        match event {
            WindowEvent::Resized(size) => {
                [self.config.width, self.config.height] = [size.width.max(1), size.height.max(1)];
                self.surface.configure(&self.gpu.device, &self.config);
                self.request_redraw();
            }
            WindowEvent::CloseRequested => {
                self.state.request_quit();
                self.request_redraw();
            }
            WindowEvent::DroppedFile(path) => {
                self.state.commands.push_back(Command::OpenPath(path.clone()));
                self.request_redraw();
            }
            _ => {}
        }
    }

    /// One turn: the panels change the state, the head follows, and both are drawn.
    pub(super) fn redraw(&mut self) -> After {
        let start = Instant::now();
        let input = self.egui.take_egui_input(&self.window);
        let context = self.egui.egui_ctx().clone();
        let mut area = egui::Rect::ZERO;
        let (state, texture) = (&mut self.state, self.scene.texture());
        let mut output = context.run_ui(input, |ui| area = panels::show(state, ui, Some(texture)));
        self.egui.handle_platform_output(&self.window, output.platform_output);
        let scale = output.pixels_per_point;
        let largest = self.gpu.device.limits().max_texture_dimension_2d as f32;
        self.picture_size = [area.width(), area.height()].map(|s| (s * scale).round().clamp(1.0, largest) as u32);
        let (quit, did_something) = self.obey();

        let head_start = Instant::now();
        if let Err(e) = self.pipeline.set_level(self.state.level()) {
            self.state.complain(e.to_string());
        }
        let frame = self.pipeline.update(self.state.breed());
        // Turning the camera leaves the head as it is: the last time that it moved is what is worth knowing.
        let has_moved = frame.revisions.shape != self.shape;
        self.shape = frame.revisions.shape;
        let head_ms = if has_moved { milliseconds(head_start) } else { self.state.timing.head_ms };
        let [width, height] = self.picture_size;
        let points = frame.parts.iter().flat_map(|p| p.positions);
        self.state.fit_camera(points, width as f32 / height as f32);
        self.state.n_triangles = frame.n_triangles();
        let drawing = drawing(&self.state, scale);
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        // A processor that draws keeps up with the hand at half the size; the full picture follows.
        let is_rough = self.gpu.is_software() && context.input(|i| i.pointer.any_down());
        let size = self.picture_size.map(|s| if is_rough { s.div_ceil(2) } else { s });
        self.scene.draw(&self.gpu, &mut self.renderer, &mut encoder, &frame, &drawing, size);

        let jobs = context.tessellate(std::mem::take(&mut output.shapes), scale);
        let was_shown = self.present(encoder, &jobs, &mut output.textures_delta, scale, start, head_ms);
        let title = self.state.title();
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
        let delay = output.viewport_output.get(&egui::ViewportId::ROOT).map(|v| v.repaint_delay);
        if did_something || !was_shown || delay == Some(Duration::ZERO) {
            self.request_redraw();
        }
        After { quit, repaint_in: delay.filter(|d| *d < Duration::from_secs(3600) && !d.is_zero()) }
    }

    /// Paints the panels over everything and shows it. False when the surface was not to be had this time.
    fn present(
        &mut self,
        mut encoder: wgpu::CommandEncoder,
        jobs: &[egui::ClippedPrimitive],
        textures: &mut egui::TexturesDelta,
        scale: f32,
        start: Instant,
        head_ms: f32,
    ) -> bool {
        let (device, queue) = (&self.gpu.device, &self.gpu.queue);
        for (id, deltas) in textures.set.drain() {
            deltas.iter().for_each(|delta| self.renderer.update_texture(device, queue, id, delta));
        }
        let screen = egui_wgpu::ScreenDescriptor {
            size_in_pixels: [self.config.width, self.config.height],
            pixels_per_point: scale,
        };
        let mut buffers = self.renderer.update_buffers(device, queue, &mut encoder, jobs, &screen);
        let cpu_ms = milliseconds(start);
        use wgpu::CurrentSurfaceTexture::{Suboptimal, Success};
        let surface = match self.surface.get_current_texture() {
            Success(texture) | Suboptimal(texture) => Some(texture),
            _ => {
                self.surface.configure(device, &self.config);
                None
            }
        };
        if let Some(surface) = &surface {
            let view = surface.texture.create_view(&Default::default());
            let attachment = wgpu::RenderPassColorAttachment {
                view: &view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            };
            let pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("panels"),
                color_attachments: &[Some(attachment)],
                ..Default::default()
            });
            self.renderer.render(&mut pass.forget_lifetime(), jobs, &screen);
        }
        buffers.push(encoder.finish());
        queue.submit(buffers);
        let was_shown = surface.is_some();
        if let Some(surface) = surface {
            self.window.pre_present_notify();
            queue.present(surface);
        }
        textures.free.drain().for_each(|id| self.renderer.free_texture(&id));
        self.state.timing = Timing { head_ms, cpu_ms, total_ms: milliseconds(start) };
        was_shown
    }

    /// Does what the state asked for. Returns whether to quit, and whether anything was done.
    fn obey(&mut self) -> (bool, bool) {
        let mut did_something = false;
        while let Some(command) = self.state.commands.pop_front() {
            did_something = true;
            let done = match command {
                Command::Quit => return (true, true),
                Command::New => {
                    self.state.begin_new();
                    Ok(())
                }
                Command::Open => match breed_dialog(&self.state).pick_file() {
                    Some(path) => self.open(path),
                    None => Err(no_choice("opened")),
                },
                Command::OpenPath(path) => self.open(path),
                Command::Save => match self.state.document().path.clone() {
                    Some(path) => self.save(path),
                    None => self.save_as(),
                },
                Command::SaveAs => self.save_as(),
                Command::SavePath(path) => self.save(path),
                Command::Export => match export_dialog(&self.state).save_file() {
                    Some(path) => self.export(&path),
                    None => Err(no_choice("exported")),
                },
                Command::ExportPath(path) => self.export(&path),
                Command::Screenshot => self.screenshot(),
            };
            if let Err(text) = done {
                self.state.complain(text);
            }
        }
        (false, did_something)
    }

    fn open(&mut self, path: PathBuf) -> Result<(), String> {
        let breed = files::read_breed(&self.state.table, &path)?;
        self.state.say(format!("Opened {}", path.display()));
        self.state.open(Document::of(breed, Some(path)));
        self.watch_document();
        Ok(())
    }

    fn save_as(&mut self) -> Result<(), String> {
        match breed_dialog(&self.state).save_file() {
            Some(path) => self.save(path),
            None => Err(no_choice("saved")),
        }
    }

    fn save(&mut self, path: PathBuf) -> Result<(), String> {
        let path = if path.extension().is_none() { path.with_extension("ron") } else { path };
        files::write(&path, save_breed(&self.state.table, self.state.breed()).as_bytes())?;
        self.state.say(format!("Saved {}", path.display()));
        self.state.was_saved(path);
        self.watch_document();
        Ok(())
    }

    fn export(&mut self, path: &Path) -> Result<(), String> {
        let path = path.with_extension("glb");
        let breed = self.state.breed().clone();
        let frame = self.pipeline.update(&breed);
        let bytes = export::to_glb(&frame, &self.state.table, &breed, &GlbOptions::default());
        let bytes = bytes.map_err(|e| e.to_string())?;
        files::write(&path, &bytes)?;
        self.state.say(format!("Exported {}", path.display()));
        Ok(())
    }

    /// The picture as it is seen, in full quality.
    fn screenshot(&mut self) -> Result<(), String> {
        let mut offscreen = Offscreen::with_shaders(self.gpu.clone(), &self.sources).map_err(|e| e.to_string())?;
        let breed = self.state.breed().clone();
        let frame = self.pipeline.update(&breed);
        let picture = offscreen.draw(&frame, &drawing(&self.state, 1.0), self.picture_size);
        let png = picture.map_err(|e| e.to_string())?.to_png().map_err(|e| e.to_string())?;
        let beside = self.state.document().path.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
        let path = files::free_path(beside, &breed.id, "png");
        files::write(&path, &png)?;
        self.state.say(format!("Wrote {}", path.display()));
        Ok(())
    }

    fn watch_document(&mut self) {
        if let Some(folder) = self.state.document().path.as_deref().and_then(Path::parent) {
            self.watch.add(folder);
        }
    }

    /// Reads files again that were written on disk. One that is broken is told of, and what was there stays.
    pub(super) fn reload(&mut self, changed: BTreeSet<PathBuf>) {
        for path in changed {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let ending = path.extension().unwrap_or_default().to_string_lossy().into_owned();
            let outcome = match ending.as_str() {
                "wgsl" => self.reload_shader(&path, &name),
                "ron" if name == "anatomy.ron" => self.reload_table(),
                "ron" => self.reload_breed(&path),
                _ => continue,
            };
            match outcome {
                // A broken file may have been put right again.
                Ok(false) if self.state.problems.remove(&name).is_none() => continue,
                Ok(_) => {
                    self.state.problems.remove(&name);
                    self.state.say(format!("Read {name} again"));
                }
                Err(text) => drop(self.state.problems.insert(name, text)),
            }
            self.request_redraw();
        }
    }

    fn reload_shader(&mut self, path: &Path, name: &str) -> Result<bool, String> {
        let Some(file) = ShaderFile::ALL.into_iter().find(|f| f.file_name() == name) else { return Ok(false) };
        let mut sources = self.sources.clone();
        sources.replace(file, files::read_text(path)?);
        if sources == self.sources {
            return Ok(false);
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        self.scene.reload(&self.gpu, &sources).map_err(|e| format!("{}/{e}", folder.display()))?;
        self.sources = sources;
        Ok(true)
    }

    fn reload_breed(&mut self, path: &Path) -> Result<bool, String> {
        let is_same = |a: &Path, b: &Path| a.canonicalize().ok() == b.canonicalize().ok();
        let opened = self.state.document().path.clone().filter(|p| is_same(p, path));
        let is_listed = self
            .launch
            .rigs
            .as_ref()
            .is_some_and(|r| path.parent().is_some_and(|folder| is_same(folder, &r.join("breeds"))));
        if opened.is_none() && !is_listed {
            return Ok(false);
        }
        let breed = files::read_breed(&self.state.table, path)?;
        let path = opened.unwrap_or_else(|| path.to_owned());
        Ok(self.state.breed_reloaded(breed, &path))
    }

    fn reload_table(&mut self) -> Result<bool, String> {
        let (table, breeds) = files::read_rigs(self.launch.rigs.as_deref())?;
        if *table == *self.state.table {
            return Ok(false);
        }
        let rig = Arc::new(Rig::embedded(&table).map_err(|e| format!("anatomy.ron: {e}"))?);
        let pipeline = Pipeline::new(rig, self.state.level()).map_err(|e| e.to_string())?;
        let document = files::under_new_table(&table, &breeds, &self.state)?;
        self.pipeline = pipeline;
        self.scene.forget();
        self.state.table_reloaded(table, breeds, document);
        Ok(true)
    }
}

fn milliseconds(since: Instant) -> f32 {
    since.elapsed().as_secs_f32() * 1000.0
}

fn drawing(state: &EditorState, pixels_per_point: f32) -> Drawing {
    Drawing {
        camera: state.camera,
        shading: state.shading,
        background: state.background,
        light_turn: state.light_turn,
        pixels_per_point,
    }
}

/// The program's shaders, overridden by the files of a folder; broken ones are left out and told of.
fn shaders_on_disk(folder: Option<&Path>) -> (ShaderSources, Vec<(String, String)>) {
    let mut sources = ShaderSources::default();
    let mut problems = Vec::new();
    for file in ShaderFile::ALL {
        let Some(path) = folder.map(|f| f.join(file.file_name())).filter(|p| p.exists()) else { continue };
        let mut tried = sources.clone();
        let read = files::read_text(&path).and_then(|text| {
            tried.replace(file, text);
            tried.check(file).map_err(|e| format!("{}: {e}", path.display()))
        });
        match read {
            Ok(()) => sources = tried,
            Err(text) => problems.push((file.file_name().to_owned(), text)),
        }
    }
    (sources, problems)
}

fn breed_dialog(state: &EditorState) -> rfd::FileDialog {
    let name = format!("{}.ron", state.breed().id);
    rfd::FileDialog::new().add_filter("Breed", &["ron"]).set_file_name(name)
}

fn export_dialog(state: &EditorState) -> rfd::FileDialog {
    let name = format!("{}.glb", state.breed().id);
    rfd::FileDialog::new().add_filter("glTF", &["glb"]).set_file_name(name)
}

fn no_choice(what: &str) -> String {
    format!("Nothing was {what}: no file was chosen. A path can also be typed into the field File.")
}
