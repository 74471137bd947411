//! Why a command did not do what it was asked, and the exit code that says so.

use crate::anatomy::LoadErrors;
use crate::anatomy::library::LibraryError;
use crate::app::disk::FileError;

/// The end of a command that did not succeed.
#[derive(Debug)]
pub enum Failure {
    /// The words make no sense together: exit code 2.
    Use(String),
    /// They do, but it did not work: exit code 1.
    Work(String),
    /// The machine has no display or no graphics adapter: exit code 3.
    NoDevice(String),
    /// Everything has been said: exit code 1.
    Said,
    /// Whoever read our output has gone: exit code 0, in silence.
    BrokenPipe,
}

impl Failure {
    /// What the process answers.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::BrokenPipe => 0,
            Self::Work(_) | Self::Said => 1,
            Self::Use(_) => 2,
            Self::NoDevice(_) => 3,
        }
    }

    /// What is still to be said on stderr; may have several lines.
    pub fn message(&self) -> Option<String> {
        match self {
            Self::Use(text) => Some(format!("londra: {text}\nTry 'londra --help'.")),
            // Places in files stand at the start of a line, where editors look for them.
            Self::Work(text) => Some(text.clone()),
            Self::NoDevice(text) => Some(format!("londra: {text}")),
            Self::Said | Self::BrokenPipe => None,
        }
    }

    /// A failure that is nobody's mistake in the words.
    pub fn work(error: impl std::fmt::Display) -> Self {
        Self::Work(format!("londra: {error}"))
    }
}

impl From<LoadErrors> for Failure {
    fn from(errors: LoadErrors) -> Self {
        Self::Work(errors.to_string())
    }
}

impl From<LibraryError> for Failure {
    fn from(error: LibraryError) -> Self {
        match error {
            LibraryError::Unknown { .. } => Self::Use(format!("{error}; 'londra list breeds' names them all")),
            LibraryError::Load(errors) => errors.into(),
        }
    }
}

impl From<FileError> for Failure {
    fn from(error: FileError) -> Self {
        Self::work(error)
    }
}
