//! The window: a head, its measures as sliders, its files.
//!
//! [`EditorState`] knows what is edited and needs no window; `panels` shows it, `input` turns mouse and keys into
//! changes of it, `turn` makes one picture, `run` owns the window, the device and the file system.

mod camera_control;
mod chance;
mod dialog;
pub mod disk;
pub mod files;
mod history;
mod host;
pub mod input;
mod measure;
mod measures;
pub mod motion;
pub mod panels;
mod run;
mod scene;
mod state;
mod thumbnails;
mod turn;
mod watch;

pub use chance::Chance;
pub use measure::{Measured, measure};
pub use measures::Measures;
pub use run::{AppError, Launch, run};
pub use state::{Blend, Command, Document, EditorState, Override, Timing};
pub use thumbnails::Pictures;
