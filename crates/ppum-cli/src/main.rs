//! The `ppum` program: arguments and messages, nothing else.
//!
//! Results go to standard output, everything else to standard error. The exit status is 0 only when
//! the work was done; 3 if a mesh was written that does not keep its tolerance.
// what is shown goes through `output`, which escapes it
#![warn(clippy::print_stdout, clippy::print_stderr)]

mod cli;
mod commands;
mod dataset;
mod families;
mod formula_text;
mod graphics;
mod labels;
mod memory;
mod number;
mod output;
mod page;
mod panics;
mod profile;
mod progress;
mod remedy;
mod replacements;
mod signals;
mod standard;
mod subject;
mod target;
#[cfg(test)]
mod tests;
mod threads;
mod tips;
mod warnings;

use std::io::{self, Write as _};
use std::process::ExitCode;

use commands::export::mesh::ToleranceMissed;
use output::{StandardStream, show, tell};

/// A window is open for days, and gives memory back.
#[cfg(feature = "window")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> ExitCode {
    signals::watch();
    memory::keep_freed();
    match cli::Cli::understood(std::env::args_os()) {
        Ok(cli) => run(&cli.command),
        Err(message) => {
            show(&message);
            ExitCode::from(if message.use_stderr() { 2 } else { 0 })
        }
    }
}

fn run(command: &cli::Command) -> ExitCode {
    let mut out = StandardStream::stdout();
    let work = || {
        threads::check()?;
        command.run(&mut out)?;
        Ok(out.flush()?)
    };
    match panics::guarded(work) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) if error.is::<ToleranceMissed>() => ExitCode::from(3),
        Err(error) => {
            report(&error);
            ExitCode::FAILURE
        }
    }
}

/// Says what went wrong, each line marked. A reader that closed the pipe has seen what it wanted
/// and is told nothing; if standard error is closed as well nobody can be told.
fn report(error: &anyhow::Error) {
    let is_closed = |io: &io::Error| matches!(io.kind(), io::ErrorKind::BrokenPipe);
    if error.chain().filter_map(|cause| cause.downcast_ref()).any(is_closed) {
        return;
    }
    for line in message(error).lines() {
        tell(&format!("error: {line}"));
    }
}

/// The error and its causes, those left out that the text before already tells.
fn message(error: &anyhow::Error) -> String {
    error
        .chain()
        .map(remedy::error_text)
        .reduce(|told, cause| if told.contains(&cause) { told } else { format!("{told}: {cause}") })
        .unwrap_or_default()
}
