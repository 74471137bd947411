//! Londra's one program: the command line, which opens the window when asked for nothing else.

use std::process::ExitCode;

fn main() -> ExitCode {
    londra::cli::main()
}
