//! The `ppum` program: arguments and messages, nothing else.
//!
//! [`run`] is the whole of it but for graphics cards and the window, which the program hands over
//! as [`Graphics`] if it was built with them. The Python package runs it
//! without, as its command `ppum`.
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
pub mod graphics;
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

use std::ffi::OsString;
use std::io::{self, Write as _};

use commands::export::mesh::ToleranceMissed;
use graphics::Graphics;
use output::{StandardStream, show, tell};

/// Runs the program with its arguments, of which the first is its name, and gives its exit status:
/// 0, 1 if the work failed, 2 if the arguments make no sense, 3 if a mesh does not keep its
/// tolerance. A signal ends the process.
pub fn run(arguments: impl IntoIterator<Item = OsString>, graphics: Graphics) -> u8 {
    signals::watch();
    memory::keep_freed();
    graphics::have(graphics);
    match cli::Cli::understood(arguments) {
        Ok(cli) => done(&cli.command),
        Err(message) => {
            show(&message);
            if message.use_stderr() { 2 } else { 0 }
        }
    }
}

fn done(command: &cli::Command) -> u8 {
    let mut out = StandardStream::stdout();
    let work = || {
        threads::check()?;
        command.run(&mut out)?;
        Ok(out.flush()?)
    };
    match panics::guarded(work) {
        Ok(()) => 0,
        Err(error) if error.is::<ToleranceMissed>() => 3,
        Err(error) => {
            report(&error);
            1
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
