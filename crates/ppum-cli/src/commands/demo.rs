//! `ppum demo`: a guided tour, made of the program's own commands.

use std::io::Write as _;
use std::path::PathBuf;

use super::tour::{Run, Tour};
use crate::output::Output;

/// Solve the centre crack and draw it
///
/// Runs the commands it prints: they can be repeated and changed one by one.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Folder for the problem file, the dataset and the pictures; made if there is none
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    output: PathBuf,
}

const EXAMPLES: &str = "\
Examples:
  ppum demo
  ppum demo -o tour";

/// The problem: one text for the demonstration and the examples.
const FILES: [(&str, &str); 1] =
    [("centre-crack.toml", include_str!("../../../../examples/centre-crack.toml"))];

/// The commands that are run.
const TOUR: [&str; 5] = [
    "solve @/centre-crack.toml",
    "render @/centre-crack.h5 -o @/von-mises.png --figure",
    "render @/centre-crack.h5 -o @/displacement.png -q magnitude --colormap magma --figure",
    "render @/centre-crack.h5 -o @/tip.png --tip 1 --zoom 1000 --scale log --figure",
    "render @/centre-crack.h5 -o @/patches.png --tip 1 --zoom 4 --overlay cells,cracks --figure",
];

/// Commands to go on with.
const NEXT: [&str; 7] = [
    "info @/centre-crack.h5",
    "sif @/centre-crack.h5",
    "probe @/centre-crack.h5 --at 0,0",
    "plot @/centre-crack.h5 --crack 0 -o @/opening.svg",
    "render @/centre-crack.h5 -o @/deformed.png --deformed auto --figure",
    "render @/centre-crack.h5 -o @/deep.png --tip 1 --zoom 1e12 --scale log --figure",
    "render --help",
];

impl Args {
    /// Does the work; `run` runs a command line, given word by word.
    pub(crate) fn run(&self, out: &mut Output, run: Run<'_>) -> anyhow::Result<()> {
        let tour = Tour { folder: &self.output, files: &FILES, lines: TOUR.into() };
        tour.check()?;
        tour.write_files(out)?;
        tour.run(out, run)?;
        writeln!(out, "\nOpen the pictures in {}. Then try:", self.output.display())?;
        for line in NEXT {
            writeln!(out, "  {}", tour.shown(line))?;
        }
        Ok(())
    }
}
