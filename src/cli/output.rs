//! Where words and bytes go: results to stdout or a file, messages to stderr. A closed pipe is never a panic.

use super::Failure;
use crate::app::disk::write_atomic;
use serde_json::Value;
use std::io::{self, IsTerminal, Write};
use std::path::Path;

/// Writes a message for a person to stderr.
pub(super) fn message(text: &str) {
    // If nobody can hear us there is nobody to tell.
    let _ = writeln!(io::stderr(), "{text}");
}

/// Writes a result and a line end to stdout.
pub(super) fn result(text: &str) -> Result<(), Failure> {
    to_stdout(format!("{text}\n").as_bytes())
}

/// Writes a result as JSON and a line end to stdout.
pub(super) fn json(value: &Value) -> Result<(), Failure> {
    result(&value.to_string())
}

/// Refuses targets that cannot work before any work is done: `-` with `--json`, and bytes into a terminal.
pub(super) fn check_target(target: &Path, json: bool) -> Result<(), Failure> {
    if !is_stdout(target) {
        return Ok(());
    }
    if json {
        return Err(Failure::Use("-o - and --json both want stdout: take one of them".into()));
    }
    if io::stdout().is_terminal() {
        return Err(Failure::Use("-o - would fill the terminal with bytes: send it to a file or a program".into()));
    }
    Ok(())
}

/// Writes a file, or to stdout where the target is `-`.
pub(super) fn bytes(target: &Path, bytes: &[u8]) -> Result<(), Failure> {
    if is_stdout(target) {
        return to_stdout(bytes);
    }
    Ok(write_atomic(target, bytes)?)
}

/// Writes a file, or to stdout where the target is `-`, and tells what was written: as JSON or as a message.
pub(super) fn file(target: &Path, bytes: &[u8], json_wanted: bool, facts: Value) -> Result<(), Failure> {
    if is_stdout(target) {
        return to_stdout(bytes);
    }
    write_atomic(target, bytes)?;
    if json_wanted {
        return json(&facts);
    }
    message(&format!("wrote {}", target.display()));
    Ok(())
}

/// Whether the target is `-`.
pub(super) fn is_stdout(target: &Path) -> bool {
    target.as_os_str() == "-"
}

fn to_stdout(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    out.write_all(bytes).and_then(|()| out.flush()).map_err(|error| match error.kind() {
        io::ErrorKind::BrokenPipe => Failure::BrokenPipe,
        _ => Failure::work(format!("stdout cannot be written: {error}")),
    })
}
