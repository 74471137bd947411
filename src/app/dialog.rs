//! File dialogs of the desktop, on a thread of their own: the window goes on drawing while one is open, and where a
//! desktop never answers nothing but the dialog is lost.

use super::run::Wake;
use rfd::AsyncFileDialog;
use winit::event_loop::EventLoopProxy;
use winit::window::Window;

/// What the chosen file is for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// Open it.
    Open,
    /// Save to it.
    Save,
    /// Save to it, and close the window if that went well.
    SaveAndQuit,
    /// Write a glTF file to it.
    Export,
}

impl Purpose {
    /// What to say when no file was chosen, be it that the person went back or that the desktop has no dialogs.
    pub(super) fn without_choice(self) -> String {
        let what = match self {
            Self::Open => "opened",
            Self::Save | Self::SaveAndQuit => "saved",
            Self::Export => "exported",
        };
        format!("Nothing was {what}: no file was chosen. A path can also be typed into the field File.")
    }
}

/// Asks for a file and returns at once; the answer comes as [`Wake::Chosen`]. `id`: of the breed, for a name to begin with.
///
/// # Errors
/// A sentence for the person, if the system gives no thread.
pub(super) fn ask(purpose: Purpose, id: &str, window: &Window, proxy: EventLoopProxy<Wake>) -> Result<(), String> {
    // A dialog is made on the thread of the window, as macOS demands; only the waiting is done elsewhere.
    let (name, ending) = if purpose == Purpose::Export { ("glTF", "glb") } else { ("Breed", "ron") };
    let dialog = AsyncFileDialog::new().set_parent(window).add_filter(name, &[ending]);
    let answer = move |chosen: Option<rfd::FileHandle>| {
        let path = chosen.map(|file| file.path().to_owned());
        // A window that has been closed meanwhile wants no answer.
        drop(proxy.send_event(Wake::Chosen(purpose, path)));
    };
    let thread = std::thread::Builder::new().name("file dialog".to_owned());
    let started = if purpose == Purpose::Open {
        let choice = dialog.pick_file();
        thread.spawn(move || answer(pollster::block_on(choice)))
    } else {
        let choice = dialog.set_file_name(format!("{id}.{ending}")).save_file();
        thread.spawn(move || answer(pollster::block_on(choice)))
    };
    started.map(drop).map_err(|e| format!("No file can be asked for ({e}). A path can be typed into the field File."))
}
