//! The `ppum` program: arguments and messages, nothing else.
//!
//! Results go to standard output, everything else to standard error. The exit status is 0 only when
//! the work was done.

mod arguments;
mod backend;
mod cli;
mod commands;
mod dataset;
mod drivers;
mod families;
mod given;
mod number;
mod progress;
mod replacements;
mod sides;
mod standard;
mod threads;
mod tips;
mod undefined;
mod warnings;

use std::io::{self, Write as _};
use std::process::ExitCode;

use clap::Parser as _;

fn main() -> ExitCode {
    let mut out = io::stdout().lock();
    let done = cli::Cli::parse().command.run(&mut out).and_then(|()| Ok(out.flush()?));
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            report(&error);
            ExitCode::FAILURE
        }
    }
}

/// Says what went wrong, each line marked. A reader that closed the pipe has seen what it wanted and
/// is told nothing; if standard error is closed as well nobody can be told.
fn report(error: &anyhow::Error) {
    let is_closed = |io: &io::Error| matches!(io.kind(), io::ErrorKind::BrokenPipe);
    if error.chain().filter_map(|cause| cause.downcast_ref()).any(is_closed) {
        return;
    }
    for line in message(error).lines() {
        let _ = writeln!(io::stderr(), "error: {line}");
    }
}

/// The error and its causes, those left out that the text before already tells.
fn message(error: &anyhow::Error) -> String {
    error
        .chain()
        .map(ToString::to_string)
        .reduce(|told, cause| if told.contains(&cause) { told } else { format!("{told}: {cause}") })
        .unwrap_or_default()
}
