//! The command line: words in, one of the other modules called, an exit code out.
//!
//! Results go to stdout, messages to stderr. Exit codes: 0 done, 1 failed, 2 wrong use, 3 no display or graphics adapter.

mod args;
mod atlas;
mod bake;
mod bench;
mod breed;
mod check;
mod control;
mod export;
mod failure;
mod film;
mod hash;
mod landmarks;
mod list;
mod measure;
mod mesh_picture;
mod motion;
mod output;
mod passes;
mod picture;
mod rigs;
mod similarity;
mod subdivide;
mod subject;
mod turntable;
mod unit_atlas;
mod uv;
mod values;
mod view;

pub use failure::Failure;

use args::{Cli, Command};
use clap::Parser;
use std::process::ExitCode;

/// Reads the arguments of the process, does what they say, and tells how it went.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            // Help and version go to stdout and are no failure; a closed pipe there is nobody's mistake.
            let _ = error.print();
            return ExitCode::from(if error.use_stderr() { 2 } else { 0 });
        }
    };
    match run(cli) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            if let Some(message) = failure.message() {
                output::message(&message);
            }
            ExitCode::from(failure.exit_code())
        }
    }
}

fn run(cli: Cli) -> Result<(), Failure> {
    match cli.command.unwrap_or(Command::View(args::View::default())) {
        Command::View(args) => view::run(&args),
        Command::Render(args) => picture::render(&args),
        Command::Sheet(args) => picture::sheet(&args),
        Command::Turntable(args) => turntable::run(&args),
        Command::Atlas(args) => atlas::run(&args),
        Command::Breed(args) => breed::run(&args),
        Command::Export(args) => export::run(&args),
        Command::Hash(args) => hash::run(&args),
        Command::Measure(args) => measure::run(&args),
        Command::Landmarks(args) => landmarks::run(&args),
        Command::List(args) => list::run(&args),
        Command::Check(args) => check::run(&args),
        Command::Uv(args) => uv::run(&args),
        Command::Bake(args) => bake::run(&args),
        Command::Subdivide(args) => subdivide::run(&args),
        Command::Bench(args) if args.passes => passes::run(&args),
        Command::Bench(args) => bench::run(&args),
        Command::Similarity(args) => similarity::run(&args),
    }
}
