//! The window and its loop: events in, one picture a change out.

use super::dialog::Purpose;
use super::files;
use super::host::{Host, HostError};
use super::state::EditorState;
use crate::coat::Condition;
use std::collections::BTreeSet;
use std::path::PathBuf;
use std::time::{Duration, Instant};
use thiserror::Error;
use winit::application::ApplicationHandler;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop, EventLoopProxy};
use winit::window::WindowId;

/// Editors write a file in several steps: it is read this long after the last one.
const SETTLE: Duration = Duration::from_millis(80);

/// Why there is no window.
#[derive(Debug, Error)]
pub enum AppError {
    /// No window system answers.
    #[error(
        "no display to open a window on ({0}); start Londra in a desktop session, or use the commands render, sheet, \
         export, hash, list and check, which need none"
    )]
    NoDisplay(String),
    /// No graphics device can draw to the window.
    #[error("{0}; the commands export, hash, list and check work without one")]
    NoAdapter(crate::render::GpuError),
    /// A file to begin with is wrong.
    #[error("{0}")]
    File(String),
    /// Anything else, which was not foreseen.
    #[error("the window cannot be opened: {0}")]
    Other(String),
}

impl AppError {
    /// Whether the machine lacks a display or an adapter, rather than something being wrong.
    pub fn is_missing_device(&self) -> bool {
        matches!(self, Self::NoDisplay(_) | Self::NoAdapter(_))
    }
}

/// What the window begins with.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Launch {
    /// A breed's file to open, or a breed's name; the first of the list if there is none.
    pub breed: Option<String>,
    /// A folder like `rigs/` that overrides the program's own and is watched.
    pub rigs: Option<PathBuf>,
    /// A folder like `shaders/` that overrides the program's own and is watched.
    pub shaders: Option<PathBuf>,
    /// Of subdivision; what suits the driver if nobody says.
    pub level: Option<u32>,
    /// Strands of hair; as many as suit the driver if nobody says.
    pub n_strands: Option<u32>,
    /// What the coat is like today.
    pub condition: Condition,
}

impl Launch {
    /// With the folder that `LONDRA_RIGS` names, or else those that a developer has in the working folder.
    pub fn here() -> Self {
        let with = |folder: &str, file: &str| {
            let folder = PathBuf::from(folder);
            folder.join(file).is_file().then_some(folder)
        };
        let named = std::env::var_os("LONDRA_RIGS").filter(|f| !f.is_empty()).map(PathBuf::from);
        let rigs = named.or_else(|| with("rigs", "anatomy.ron"));
        Self { rigs, shaders: with("shaders", "mesh.wgsl"), ..Self::default() }
    }
}

/// Opens the window and returns when it is closed.
///
/// # Errors
/// No display, no adapter, or a file to begin with that is wrong.
pub fn run(launch: Launch) -> Result<(), AppError> {
    let state = begin(&launch)?;
    let event_loop = EventLoop::<Wake>::with_user_event().build().map_err(|e| AppError::NoDisplay(reason(&e)))?;
    let display = Box::new(event_loop.owned_display_handle());
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_with_display_handle_from_env(display));
    let mut app = App {
        launch,
        instance,
        proxy: event_loop.create_proxy(),
        beginning: Some(state),
        host: None,
        failure: None,
        changed: BTreeSet::new(),
        read_at: None,
        repaint_at: None,
    };
    event_loop.run_app(&mut app).map_err(|e| AppError::Other(e.to_string()))?;
    app.failure.map_or(Ok(()), Err)
}

/// What the window system says, without the place in its source that stands before it.
fn reason(error: &winit::error::EventLoopError) -> String {
    let text = error.to_string();
    let after_place = text.split_once(".rs:").and_then(|(_, rest)| rest.split_once(": ")).map(|(_, words)| words);
    after_place.unwrap_or(&text).trim_end_matches('.').to_owned()
}

/// The state before the window is there, so that a wrong file is told on the command line.
pub(super) fn begin(launch: &Launch) -> Result<EditorState, AppError> {
    let (table, breeds) = files::read_rigs(launch.rigs.as_deref()).map_err(AppError::File)?;
    let document = files::first_document(&table, &breeds, launch.breed.as_deref()).map_err(AppError::File)?;
    let mut state = EditorState::new(table, breeds, document);
    state.condition = launch.condition;
    Ok(state)
}

/// What other threads wake the window with.
#[derive(Debug)]
pub(super) enum Wake {
    /// A file on disk was written.
    Changed(PathBuf),
    /// A file dialog was answered.
    Chosen(Purpose, Option<PathBuf>),
}

struct App {
    launch: Launch,
    instance: wgpu::Instance,
    proxy: EventLoopProxy<Wake>,
    beginning: Option<EditorState>,
    host: Option<Host>,
    failure: Option<AppError>,
    changed: BTreeSet<PathBuf>,
    read_at: Option<Instant>,
    repaint_at: Option<Instant>,
}

impl ApplicationHandler<Wake> for App {
    fn resumed(&mut self, event_loop: &ActiveEventLoop) {
        let Some(state) = self.beginning.take() else { return };
        match Host::new(event_loop, &self.instance, &self.proxy, &self.launch, state) {
            Ok(host) => self.host = Some(host),
            Err(error) => {
                self.failure = Some(match error {
                    HostError::Gpu(e) => AppError::NoAdapter(e),
                    HostError::Window(e) => AppError::NoDisplay(e),
                    HostError::Other(e) => AppError::Other(e),
                });
                event_loop.exit();
            }
        }
    }

    fn window_event(&mut self, event_loop: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(host) = &mut self.host else { return };
        host.on_event(&event);
        if event == WindowEvent::RedrawRequested {
            let after = host.redraw();
            self.repaint_at = after.repaint_in.and_then(|delay| Instant::now().checked_add(delay));
            if after.quit {
                event_loop.exit();
            }
        }
    }

    fn user_event(&mut self, _: &ActiveEventLoop, wake: Wake) {
        match wake {
            Wake::Changed(path) => {
                self.changed.insert(path);
                self.read_at = Some(Instant::now() + SETTLE);
            }
            Wake::Chosen(purpose, path) => {
                if let Some(host) = &mut self.host {
                    host.was_chosen(purpose, path);
                }
            }
        }
    }

    fn about_to_wait(&mut self, event_loop: &ActiveEventLoop) {
        let Some(host) = &mut self.host else { return };
        let now = Instant::now();
        if self.read_at.is_some_and(|at| at <= now) {
            self.read_at = None;
            host.reload(std::mem::take(&mut self.changed));
        }
        if self.repaint_at.is_some_and(|at| at <= now) {
            self.repaint_at = None;
            host.request_redraw();
        }
        let next = [self.read_at, self.repaint_at].into_iter().flatten().min();
        event_loop.set_control_flow(next.map_or(ControlFlow::Wait, ControlFlow::WaitUntil));
    }
}
