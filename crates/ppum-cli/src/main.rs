//! The `ppum` program: arguments and messages, nothing else.
//!
//! Results go to standard output, everything else to standard error. The exit status is 0 only when
//! the work was done.
// what is shown goes through `output`, which escapes it
#![warn(clippy::print_stdout, clippy::print_stderr)]

mod arguments;
mod backend;
mod cli;
mod commands;
mod dataset;
mod deformed;
mod families;
mod given;
mod graphics;
mod look;
mod memory;
mod number;
mod output;
mod overlays;
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
mod threads;
mod tips;
mod warnings;
mod window;

use std::io::{self, Write as _};
use std::process::ExitCode;

use output::{Output, show, tell};

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
    let mut out = Output::stdout();
    let work = || {
        threads::check()?;
        command.run(&mut out)?;
        Ok(out.flush()?)
    };
    match panics::guarded(work) {
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
        tell(&format!("error: {line}"));
    }
}

/// The error and its causes, those left out that the text before already tells.
fn message(error: &anyhow::Error) -> String {
    error
        .chain()
        .map(remedy::told)
        .reduce(|told, cause| if told.contains(&cause) { told } else { format!("{told}: {cause}") })
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use ppum_testkit::rooms::{Floors, check, check_page};

    const FLOORS: Floors<'_> = &[
        &[
            ("arguments", &[]),
            ("memory", &[]),
            ("number", &[]),
            ("output", &[]),
            ("panics", &[]),
            ("progress", &[]),
            ("remedy", &[]),
            ("signals", &[]),
            ("standard", &[]),
            ("threads", &[]),
        ],
        &[
            ("families", &["number"]),
            ("given", &["standard"]),
            ("look", &["arguments"]),
            ("target", &["standard"]),
            ("tips", &["number"]),
            ("warnings", &["output"]),
        ],
        &[
            ("dataset", &["given", "standard"]),
            ("graphics", &[]),
            ("overlays", &["arguments"]),
            ("page", &["output", "standard", "target"]),
            ("profile", &["arguments", "output", "progress", "target", "tips"]),
            ("window", &["arguments", "tips"]),
            ("replacements", &["arguments", "given"]),
        ],
        &[
            ("backend", &["graphics", "progress", "threads"]),
            ("deformed", &["window"]),
            ("subject", &["given", "replacements", "standard", "dataset"]),
        ],
        &[(
            "commands",
            &[
                "arguments",
                "backend",
                "dataset",
                "deformed",
                "families",
                "given",
                "graphics",
                "look",
                "memory",
                "number",
                "output",
                "overlays",
                "page",
                "profile",
                "progress",
                "replacements",
                "standard",
                "subject",
                "target",
                "threads",
                "tips",
                "warnings",
                "window",
            ],
        )],
        &[("cli", &["commands", "output"])],
    ];

    #[test]
    fn arrows_lead_down() {
        let sources = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
        check(&sources, FLOORS);
        check_page(&sources, env!("CARGO_PKG_NAME"), FLOORS);
    }
}
