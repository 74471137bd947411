//! Reading and writing files with errors that say what to do; a file is written whole or not at all.

use std::fs::{self, Metadata};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// The largest text that is read as a breed or a table; a real one has some kilobytes.
const MAX_TEXT_BYTES: u64 = 4 << 20;

/// The largest mesh file that is read. Every format counts in 32 bits.
const MAX_MESH_BYTES: u64 = u32::MAX as u64;

/// Why a file was not read or written.
#[derive(Debug, thiserror::Error)]
pub enum FileError {
    /// Nothing is there.
    #[error("{}: no such file", path.display())]
    Missing {
        /// The path asked for.
        path: PathBuf,
    },
    /// A folder is no file.
    #[error("{}: is a folder", path.display())]
    IsFolder {
        /// The path asked for.
        path: PathBuf,
    },
    /// Far too large for what it should be.
    #[error("{}: has {bytes} bytes, {what} has at most {most}", path.display())]
    TooLarge {
        /// The path asked for.
        path: PathBuf,
        /// Its size.
        bytes: u64,
        /// What it should be.
        what: &'static str,
        /// The most that such a file has.
        most: u64,
    },
    /// Not a text.
    #[error("{}: is not UTF-8 text (byte {at})", path.display())]
    NotText {
        /// The path asked for.
        path: PathBuf,
        /// The first byte that is no text.
        at: usize,
    },
    /// The folder to write into does not exist.
    #[error("{}: cannot be written, the folder {} does not exist", path.display(), folder.display())]
    NoFolder {
        /// The path asked for.
        path: PathBuf,
        /// The folder in it.
        folder: PathBuf,
    },
    /// The file is there and marked as not to be written.
    #[error("{}: is read-only and was left as it is", path.display())]
    ReadOnly {
        /// The path asked for.
        path: PathBuf,
    },
    /// The folder is marked as not to be written.
    #[error("{}: cannot be written, the folder {} is read-only", path.display(), folder.display())]
    ReadOnlyFolder {
        /// The path asked for.
        path: PathBuf,
        /// The folder in it.
        folder: PathBuf,
    },
    /// Reading failed otherwise.
    #[error("{}: cannot be read: {source}", path.display())]
    Read {
        /// The path asked for.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// Writing failed otherwise; what was there before is still there.
    #[error("{}: cannot be written: {source}", path.display())]
    Write {
        /// The path asked for.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
}

/// The whole text of a file of at most 4 MiB.
pub fn read_text(path: &Path) -> Result<String, FileError> {
    let bytes = read_at_most(path, MAX_TEXT_BYTES, "a file of breeds or measures")?;
    String::from_utf8(bytes).map_err(|e| FileError::NotText { path: path.to_owned(), at: e.utf8_error().valid_up_to() })
}

/// All bytes of a mesh file of at most 4 GiB.
pub fn read_mesh_bytes(path: &Path) -> Result<Vec<u8>, FileError> {
    read_at_most(path, MAX_MESH_BYTES, "a mesh file")
}

fn read_at_most(path: &Path, most: u64, what: &'static str) -> Result<Vec<u8>, FileError> {
    let path_buf = || path.to_owned();
    let failed = |source: io::Error| match source.kind() {
        io::ErrorKind::NotFound => FileError::Missing { path: path_buf() },
        _ => FileError::Read { path: path_buf(), source },
    };
    let metadata = fs::metadata(path).map_err(failed)?;
    if metadata.is_dir() {
        return Err(FileError::IsFolder { path: path_buf() });
    }
    // A pipe has no length beforehand, so the limit is also put on what is read.
    let mut bytes = Vec::new();
    let file = fs::File::open(path).map_err(failed)?;
    if metadata.len() > most {
        return Err(FileError::TooLarge { path: path_buf(), bytes: metadata.len(), what, most });
    }
    io::Read::read_to_end(&mut io::Read::take(file, most + 1), &mut bytes).map_err(failed)?;
    if bytes.len() as u64 > most {
        return Err(FileError::TooLarge { path: path_buf(), bytes: bytes.len() as u64, what, most });
    }
    Ok(bytes)
}

/// Writes a file whole or not at all: into a temporary file beside the target, which then takes its name.
///
/// An existing file keeps its permissions; a link keeps pointing where it does; a device or pipe is written to directly.
pub fn write_atomic(path: &Path, bytes: &[u8]) -> Result<(), FileError> {
    let failed = |source: io::Error| FileError::Write { path: path.to_owned(), source };
    let existing = fs::metadata(path).ok();
    if let Some(metadata) = &existing {
        if metadata.is_dir() {
            return Err(FileError::IsFolder { path: path.to_owned() });
        }
        if !metadata.is_file() {
            return fs::OpenOptions::new().write(true).open(path).and_then(|mut f| f.write_all(bytes)).map_err(failed);
        }
        if metadata.permissions().readonly() {
            return Err(FileError::ReadOnly { path: path.to_owned() });
        }
    }
    let target = if existing.is_some() { fs::canonicalize(path).map_err(failed)? } else { path.to_owned() };
    let folder = match target.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder.to_owned(),
        _ => PathBuf::from("."),
    };
    check_folder(path, &folder)?;

    let mut builder = tempfile::Builder::new();
    builder.prefix(".londra-").suffix(".part");
    allow_what_the_target_allows(&mut builder, existing.as_ref());
    let mut file = builder.tempfile_in(&folder).map_err(failed)?;
    file.write_all(bytes).and_then(|()| file.as_file().sync_all()).map_err(failed)?;
    // On an error the temporary file is removed when it goes out of scope.
    file.persist(&target).map_err(|e| failed(e.error))?;
    Ok(())
}

fn check_folder(path: &Path, folder: &Path) -> Result<(), FileError> {
    let (path, folder) = (path.to_owned(), folder.to_owned());
    match fs::metadata(&folder) {
        Ok(metadata) if metadata.is_dir() => {
            if is_locked(&metadata) {
                Err(FileError::ReadOnlyFolder { path, folder })
            } else {
                Ok(())
            }
        }
        _ => Err(FileError::NoFolder { path, folder }),
    }
}

/// A folder that nobody may write into. The superuser could, but was not meant to.
#[cfg(unix)]
fn is_locked(metadata: &Metadata) -> bool {
    std::os::unix::fs::PermissionsExt::mode(&metadata.permissions()) & 0o222 == 0
}

/// The read-only mark of a folder means something else on other systems.
#[cfg(not(unix))]
fn is_locked(_: &Metadata) -> bool {
    false
}

/// Temporary files are private by default; this one becomes an ordinary file.
#[cfg(unix)]
fn allow_what_the_target_allows(builder: &mut tempfile::Builder<'_, '_>, existing: Option<&Metadata>) {
    use std::os::unix::fs::PermissionsExt;
    let mode = existing.map_or(0o666, |m| m.permissions().mode() & 0o777);
    builder.permissions(fs::Permissions::from_mode(mode));
}

#[cfg(not(unix))]
fn allow_what_the_target_allows(_: &mut tempfile::Builder<'_, '_>, _: Option<&Metadata>) {}

#[cfg(test)]
mod tests {
    use super::*;

    fn names_in(folder: &Path) -> Vec<String> {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_new_file_appears_and_an_old_one_is_replaced_with_nothing_left_behind() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.bin");
        write_atomic(&path, b"first").unwrap();
        write_atomic(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(names_in(folder.path()), ["a.bin"]);
    }

    #[test]
    fn what_cannot_be_written_is_left_as_it_was() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.bin");
        write_atomic(&path, b"first").unwrap();
        let mut permissions = fs::metadata(&path).unwrap().permissions();
        permissions.set_readonly(true);
        fs::set_permissions(&path, permissions).unwrap();
        assert!(matches!(write_atomic(&path, b"second"), Err(FileError::ReadOnly { .. })));
        assert_eq!(fs::read(&path).unwrap(), b"first");
        assert!(matches!(write_atomic(folder.path(), b"x"), Err(FileError::IsFolder { .. })));
        let missing = folder.path().join("no").join("a.bin");
        assert!(matches!(write_atomic(&missing, b"x"), Err(FileError::NoFolder { .. })));
        let below_a_file = path.join("b.bin");
        assert!(matches!(write_atomic(&below_a_file, b"x"), Err(FileError::NoFolder { .. })));
        assert_eq!(names_in(folder.path()), ["a.bin"]);
    }

    #[cfg(unix)]
    #[test]
    fn links_permissions_devices_and_locked_folders_are_respected() {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = tempfile::tempdir().unwrap();
        let (path, link) = (folder.path().join("a.bin"), folder.path().join("link"));
        write_atomic(&path, b"first").unwrap();
        assert_ne!(fs::metadata(&path).unwrap().permissions().mode() & 0o044, 0, "others may read a new file");
        fs::set_permissions(&path, fs::Permissions::from_mode(0o640)).unwrap();
        symlink("a.bin", &link).unwrap();
        write_atomic(&link, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
        assert_eq!(fs::metadata(&path).unwrap().permissions().mode() & 0o777, 0o640);
        write_atomic(Path::new("/dev/null"), b"x").unwrap();
        assert!(!fs::metadata("/dev/null").unwrap().is_file());

        fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o555)).unwrap();
        let locked = write_atomic(&folder.path().join("new"), b"x");
        fs::set_permissions(folder.path(), fs::Permissions::from_mode(0o755)).unwrap();
        assert!(matches!(locked, Err(FileError::ReadOnlyFolder { .. })));
    }

    #[test]
    fn reading_says_what_is_wrong() {
        let folder = tempfile::tempdir().unwrap();
        assert!(matches!(read_text(&folder.path().join("no.ron")), Err(FileError::Missing { .. })));
        assert!(matches!(read_text(folder.path()), Err(FileError::IsFolder { .. })));
        let path = folder.path().join("a.ron");
        fs::write(&path, b"ab\xff").unwrap();
        assert!(matches!(read_text(&path), Err(FileError::NotText { at: 2, .. })));
        fs::write(&path, vec![b' '; MAX_TEXT_BYTES as usize + 1]).unwrap();
        assert!(matches!(read_text(&path), Err(FileError::TooLarge { .. })));
    }
}
