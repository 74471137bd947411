//! What the window owns: the surface, the device, the head, and the state it shows.

use super::dialog::{self, Purpose};
use super::files;
use super::run::{Launch, Wake};
use super::state::{Command, EditorState, Timing};
use super::turn::{Recorded, Turn, drawing, milliseconds};
use super::watch::{self, Watch};
use crate::anatomy::save_breed;
use crate::export::{self, GlbOptions};
use crate::frame::Pipeline;
use crate::render::{Gpu, GpuError, Offscreen, ShaderFile, ShaderSources};
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
    egui: egui_winit::State,
    turn: Turn,
    sources: ShaderSources,
    watch: Watch,
    launch: Launch,
    title: String,
    proxy: EventLoopProxy<Wake>,
    /// A file dialog is open.
    is_asking: bool,
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

        let (sources, problems) = shaders_on_disk(launch.shaders.as_deref());
        state.problems.extend(problems);
        state.say(format!("Drawn by {}. Press ? for the keys.", gpu.name()));
        let largest = gpu.device.limits().max_texture_dimension_2d as usize;
        let turn = Turn::new(gpu, format, &sources, state, launch).map_err(|e| HostError::Other(e.to_string()))?;
        let scale = Some(window.scale_factor() as f32);
        let (context, viewport) = (turn.context.clone(), egui::ViewportId::ROOT);
        let egui = egui_winit::State::new(context, viewport, &window, scale, window.theme(), Some(largest));

        let (proxy, news) = (proxy.clone(), proxy.clone());
        // A loop that has ended takes no more news, which is as well.
        let mut watch = Watch::new(move |path| drop(news.send_event(Wake::Changed(path))));
        if let Some(rigs) = &launch.rigs {
            watch.add(rigs);
            watch.add(&rigs.join("breeds"));
        }
        if let Some(shaders) = &launch.shaders {
            watch.add(shaders);
        }
        let (launch, title, is_asking) = (launch.clone(), String::new(), false);
        let mut host = Self { window, surface, config, egui, turn, sources, watch, launch, title, proxy, is_asking };
        host.watch_document();
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
                self.surface.configure(&self.turn.gpu.device, &self.config);
                self.request_redraw();
            }
            WindowEvent::CloseRequested => {
                self.turn.state.request_quit();
                self.request_redraw();
            }
            WindowEvent::DroppedFile(path) => {
                self.turn.state.commands.push_back(Command::OpenPath(path.clone()));
                self.request_redraw();
            }
            _ => {}
        }
    }

    /// One turn: the panels change the state, the head follows, and both are drawn.
    pub(super) fn redraw(&mut self) -> After {
        let panels_start = Instant::now();
        let input = self.egui.take_egui_input(&self.window);
        let mut output = self.turn.panels(input);
        self.egui.handle_platform_output(&self.window, std::mem::take(&mut output.platform_output));
        let panels_ms = milliseconds(panels_start);
        let (quit, did_something) = self.obey();

        let start = Instant::now();
        let recorded = self.turn.record(&mut output, [self.config.width, self.config.height]);
        let cpu_ms = panels_ms + milliseconds(start);
        let head_ms = recorded.head_ms.unwrap_or(self.turn.state.timing.head_ms);
        let is_unfinished = recorded.is_unfinished;
        let was_shown = self.present(recorded);
        self.turn.state.timing = Timing { head_ms, cpu_ms, total_ms: panels_ms + milliseconds(start) };

        let title = self.turn.state.title();
        if title != self.title {
            self.window.set_title(&title);
            self.title = title;
        }
        let delay = output.viewport_output.get(&egui::ViewportId::ROOT).map(|v| v.repaint_delay);
        if did_something || is_unfinished || !was_shown || delay == Some(Duration::ZERO) {
            self.request_redraw();
        }
        After { quit, repaint_in: delay.filter(|d| *d < Duration::from_secs(3600) && !d.is_zero()) }
    }

    /// Hands everything to the driver and shows it. False when the surface was not to be had this time.
    fn present(&mut self, recorded: Recorded) -> bool {
        use wgpu::CurrentSurfaceTexture::{Suboptimal, Success};
        let surface = match self.surface.get_current_texture() {
            Success(texture) | Suboptimal(texture) => Some(texture),
            _ => {
                self.surface.configure(&self.turn.gpu.device, &self.config);
                None
            }
        };
        let view = surface.as_ref().map(|s| s.texture.create_view(&Default::default()));
        self.turn.submit(recorded, view.as_ref());
        let Some(surface) = surface else { return false };
        self.window.pre_present_notify();
        self.turn.gpu.queue.present(surface);
        true
    }

    /// Does what the state asked for. Returns whether to quit, and whether anything was done.
    fn obey(&mut self) -> (bool, bool) {
        let mut did_something = false;
        while let Some(command) = self.turn.state.commands.pop_front() {
            did_something = true;
            let done = match command {
                Command::Quit => return (true, true),
                Command::New => {
                    self.turn.state.begin_new();
                    Ok(())
                }
                Command::Open => self.ask(Purpose::Open),
                Command::OpenPath(path) => self.open(path),
                Command::Save => match self.turn.state.document().path.clone() {
                    Some(path) => self.save(path),
                    None => self.ask(Purpose::Save),
                },
                Command::SaveAs => self.ask(Purpose::Save),
                Command::SaveAndQuit => match self.turn.state.document().path.clone() {
                    Some(path) => match self.save(path) {
                        Ok(()) => return (true, true),
                        Err(text) => Err(text),
                    },
                    None => self.ask(Purpose::SaveAndQuit),
                },
                Command::SavePath(path) => self.save(path),
                Command::Export => self.ask(Purpose::Export),
                Command::ExportPath(path) => self.export(&path),
                Command::Screenshot => self.screenshot(),
            };
            if let Err(text) = done {
                self.turn.state.complain(text);
            }
        }
        (false, did_something)
    }

    fn open(&mut self, path: PathBuf) -> Result<(), String> {
        let breed = files::read_breed(&self.turn.state.table, &path)?;
        self.turn.state.was_read(breed, path);
        self.watch_document();
        Ok(())
    }

    /// Opens a dialog, one at a time; [`Host::was_chosen`] takes the answer.
    fn ask(&mut self, purpose: Purpose) -> Result<(), String> {
        if self.is_asking {
            let text = "A file is already being asked for in another window. A path can be typed into the field File.";
            return Err(text.into());
        }
        dialog::ask(purpose, &self.turn.state.breed().id, &self.window, self.proxy.clone())?;
        self.is_asking = true;
        Ok(())
    }

    /// The answer of a dialog; `None` if no file was chosen.
    pub(super) fn was_chosen(&mut self, purpose: Purpose, path: Option<PathBuf>) {
        self.is_asking = false;
        self.request_redraw();
        let Some(path) = path else { return self.turn.state.complain(purpose.without_choice()) };
        let commands = &mut self.turn.state.commands;
        match purpose {
            Purpose::Open => commands.push_back(Command::OpenPath(path)),
            Purpose::Save => commands.push_back(Command::SavePath(path)),
            Purpose::Export => commands.push_back(Command::ExportPath(path)),
            Purpose::SaveAndQuit => match self.save(path) {
                Ok(()) => self.turn.state.commands.push_back(Command::Quit),
                Err(text) => self.turn.state.complain(text),
            },
        }
    }

    fn save(&mut self, path: PathBuf) -> Result<(), String> {
        let is_no_breed = path.extension().is_none_or(|e| e == "glb");
        let path = if is_no_breed { path.with_extension("ron") } else { path };
        files::write(&path, save_breed(&self.turn.state.table, self.turn.state.breed()).as_bytes())?;
        self.turn.state.say(format!("Saved {}", files::in_full(&path).display()));
        self.turn.state.was_saved(path);
        self.watch_document();
        Ok(())
    }

    fn export(&mut self, path: &Path) -> Result<(), String> {
        let path = path.with_extension("glb");
        let breed = self.turn.state.breed().clone();
        self.turn.pipeline.set_uv(true).map_err(|e| e.to_string())?;
        let frame = self.turn.pipeline.update(&breed);
        let bytes = export::to_glb(&frame, &self.turn.state.table, &breed, &GlbOptions::default());
        // A window's own pictures need none.
        self.turn.pipeline.set_uv(false).map_err(|e| e.to_string())?;
        let bytes = bytes.map_err(|e| e.to_string())?;
        files::write(&path, &bytes)?;
        self.turn.state.say(format!("Exported {}", files::in_full(&path).display()));
        Ok(())
    }

    /// The picture as it is seen, in full quality.
    fn screenshot(&mut self) -> Result<(), String> {
        let mut offscreen = Offscreen::with_shaders(self.turn.gpu.clone(), &self.sources).map_err(|e| e.to_string())?;
        let breed = self.turn.state.breed().clone();
        let frame = self.turn.pipeline.update(&breed);
        let picture = offscreen.draw(&frame, &drawing(&self.turn.state, 1.0), self.turn.picture_size);
        let png = picture.map_err(|e| e.to_string())?.to_png().map_err(|e| e.to_string())?;
        let beside = self.turn.state.document().path.as_deref().and_then(Path::parent).unwrap_or(Path::new(""));
        let path = files::free_path(beside, &breed.id, "png");
        files::write(&path, &png)?;
        self.turn.state.say(format!("Wrote {}", files::in_full(&path).display()));
        Ok(())
    }

    fn watch_document(&mut self) {
        if let Some(folder) = self.turn.state.document().path.as_deref().and_then(Path::parent) {
            self.watch.add(folder);
        }
    }

    /// Reads files again that were written on disk. One that is broken is told of, and what was there stays.
    pub(super) fn reload(&mut self, mut changed: BTreeSet<PathBuf>) {
        watch::retry_table(&mut changed, &self.turn.state.problems, self.launch.rigs.as_deref());
        for path in changed {
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            let ending = path.extension().unwrap_or_default().to_string_lossy().into_owned();
            let outcome = match ending.as_str() {
                "wgsl" => self.reload_shader(&path, &name),
                "ron" if name == watch::TABLE => self.reload_table(),
                "ron" => self.reload_breed(&path),
                _ => continue,
            };
            match outcome {
                // A broken file may have been put right again.
                Ok(false) if self.turn.state.problems.remove(&name).is_none() => continue,
                Ok(_) => {
                    self.turn.state.problems.remove(&name);
                    self.turn.state.say(format!("Read {name} again"));
                }
                Err(text) => drop(self.turn.state.problems.insert(name, text)),
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
        self.turn.scene.reload(&self.turn.gpu, &sources).map_err(|e| format!("{}/{e}", folder.display()))?;
        self.sources = sources;
        Ok(true)
    }

    fn reload_breed(&mut self, path: &Path) -> Result<bool, String> {
        let is_same = |a: &Path, b: &Path| a.canonicalize().ok() == b.canonicalize().ok();
        let opened = self.turn.state.document().path.clone().filter(|p| is_same(p, path));
        let is_listed = self
            .launch
            .rigs
            .as_ref()
            .is_some_and(|r| path.parent().is_some_and(|folder| is_same(folder, &r.join("breeds"))));
        if opened.is_none() && !is_listed {
            return Ok(false);
        }
        let breed = files::read_breed(&self.turn.state.table, path)?;
        let path = opened.unwrap_or_else(|| path.to_owned());
        Ok(self.turn.state.breed_reloaded(breed, &path))
    }

    fn reload_table(&mut self) -> Result<bool, String> {
        let (table, breeds) = files::read_rigs(self.launch.rigs.as_deref())?;
        if *table == *self.turn.state.table {
            return Ok(false);
        }
        let rig = Arc::new(Rig::embedded(&table).map_err(|e| format!("anatomy.ron: {e}"))?);
        let pipeline = Pipeline::new(rig, self.turn.state.level()).map_err(|e| e.to_string())?;
        let document = files::under_new_table(&table, &breeds, &self.turn.state)?;
        self.turn.pipeline = pipeline;
        self.turn.scene.forget();
        self.turn.state.table_reloaded(table, breeds, document);
        Ok(true)
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
