//! `ppum gallery`: the figures of the 2011 paper, made of the program's own commands.

mod figures;

use std::io::Write as _;
use std::path::PathBuf;

use anyhow::ensure;

use super::tour::{Run, Tour};
use crate::output::Output;
use figures::{ALL, Figure};

/// Redo the figures of Üffinger, Schweitzer, Sadlo and Ertl 2011
///
/// Runs the commands it prints, on problem files that it writes: they can be repeated and changed one by one.
/// docs/gallery.md shows the figures with what the paper says of them.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Folder for problem files, datasets and pictures; made if there is none
    #[arg(short, long, value_name = "DIR", default_value = "gallery")]
    output: PathBuf,
    /// One figure alone, by its number in the paper; may be given more than once
    #[arg(long, value_name = "N")]
    figure: Vec<u32>,
}

const EXAMPLES: &str = "\
Examples:
  ppum gallery
  ppum gallery -o paper --figure 2 --figure 5";

impl Args {
    /// Does the work; `run` runs a command line, given word by word.
    pub(crate) fn run(&self, out: &mut Output, run: Run<'_>) -> anyhow::Result<()> {
        let figures = self.figures()?;
        let tours: Vec<Tour<'_>> = figures.iter().map(|figure| self.tour(figure)).collect();
        tours.iter().try_for_each(Tour::check)?;
        for (number, (figure, tour)) in figures.iter().zip(&tours).enumerate() {
            let Figure { number: name, title, .. } = figure;
            writeln!(out, "\n[{} of {}] Figure {name}: {title}", number + 1, figures.len())?;
            tour.write_files(out)?;
            tour.run(out, run)?;
        }
        writeln!(out, "\nThe pictures are in {}.", self.output.display())?;
        Ok(())
    }

    fn tour<'a>(&'a self, figure: &'a Figure) -> Tour<'a> {
        Tour { folder: &self.output, files: figure.files, lines: figure.lines.into() }
    }

    fn figures(&self) -> anyhow::Result<Vec<&'static Figure>> {
        let known = ALL.iter().map(|figure| figure.number.to_string()).collect::<Vec<_>>();
        for wanted in &self.figure {
            ensure!(
                ALL.iter().any(|figure| figure.number == *wanted),
                "--figure {wanted}: there are the figures {}",
                known.join(", ")
            );
        }
        let is_wanted =
            |figure: &&Figure| self.figure.is_empty() || self.figure.contains(&figure.number);
        Ok(ALL.iter().filter(is_wanted).collect())
    }
}
