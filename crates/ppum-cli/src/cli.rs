//! The command line as a whole.

use std::ffi::OsString;

use clap::error::{ContextKind, ContextValue, ErrorKind};
use clap::{Arg, CommandFactory as _, FromArgMatches as _, Parser, Subcommand};
use ppum_scene::help::own_option;

use crate::commands::{
    check, compare, completions, demo, export, formula, import, info, init, man, plot, probe,
    render, sample, sif, solve, view, weight,
};
use crate::output::StandardStream;

/// Solves two-dimensional fracture problems with the particle-partition of unity method and draws
/// the result exactly at every pixel.
#[derive(Debug, Parser)]
#[command(name = "ppum", version, after_help = EXAMPLES, max_term_width = 100)]
pub(crate) struct Cli {
    #[command(subcommand)]
    pub(crate) command: Command,
}

const EXAMPLES: &str = "\
Examples:
  ppum demo                                  solve a cracked plate and draw it
  ppum init plate.toml                       a problem file with comments, to be edited
  ppum import part.dxf                       a problem file of a drawing or a mesh
  ppum solve plate.toml                      solve a problem; writes plate.h5
  ppum sif plate.h5                          stress intensity factors of all tips
  ppum weight plate.toml -o weights.h5       weight functions: K of any load by an integral
  ppum probe plate.h5 --at 0.25,-0.1         values at a point
  ppum sample plate.h5 --crack 0 -o crack.csv    numbers for plots, here along a crack
  ppum render plate.h5 -o plate.png --figure
  ppum plot plate.h5 --crack 0 -o opening.svg
  ppum export plate.h5 -o plate.html         a page to explore in a browser
  ppum export plate.h5 -o plate.vtu          a mesh for ParaView and other programs
  ppum formula 'sqrt(r)*sin(theta/2)'        what a formula means, and its derivatives

`ppum COMMAND --help` tells more, with examples.";

#[derive(Debug, Subcommand)]
pub(crate) enum Command {
    Demo(demo::DemoArgs),
    Init(init::InitArgs),
    Import(import::ImportArgs),
    Solve(solve::SolveArgs),
    Info(info::InfoArgs),
    Check(check::CheckArgs),
    Sif(sif::SifArgs),
    Weight(weight::WeightArgs),
    Probe(probe::ProbeArgs),
    Sample(sample::SampleArgs),
    Render(Box<render::RenderArgs>),
    Compare(compare::CompareArgs),
    Plot(plot::PlotArgs),
    Export(export::ExportArgs),
    View(view::ViewArgs),
    Formula(formula::FormulaArgs),
    Completions(completions::CompletionsArgs),
    Man(man::ManArgs),
}

impl Cli {
    /// Understands a command line.
    pub(crate) fn understood(
        words: impl IntoIterator<Item = OsString>,
    ) -> Result<Self, clap::Error> {
        let words: Vec<_> = words.into_iter().collect();
        let matches = Self::whole()
            .try_get_matches_from(&words)
            .map_err(|error| Self::named_as_here(error, &words))?;
        Self::from_arg_matches(&matches).map_err(|error| error.format(&mut Self::whole()))
    }

    /// Names the option of a command that another program calls otherwise.
    fn named_as_here(error: clap::Error, words: &[OsString]) -> clap::Error {
        let Some(ContextValue::String(given)) = error.get(ContextKind::InvalidArg) else {
            return error;
        };
        let mut program = Self::whole();
        let command = words.get(1).and_then(|word| program.find_subcommand_mut(word));
        let option = own_option(given.trim_start_matches('-')).map(|name| name.replace('_', "-"));
        let (Some(command), Some(option)) = (command, option) else { return error };
        let is_there = command.get_arguments().any(|arg| arg.get_long() == Some(&*option));
        if error.kind() != ErrorKind::UnknownArgument || !is_there {
            return error;
        }
        let message = format!("unexpected argument '{given}'; the option is called `--{option}`");
        command
            .clone()
            .bin_name(format!("ppum {}", command.get_name()))
            .error(error.kind(), message)
    }

    /// The commands, whose options all take negative numbers: what is wrong with one its
    /// option says.
    pub(crate) fn whole() -> clap::Command {
        let with_numbers = |arg: Arg| {
            let is_option = !arg.is_positional() && arg.get_action().takes_values();
            if is_option { arg.allow_negative_numbers(true) } else { arg }
        };
        Self::command().mut_subcommands(|command| command.mut_args(with_numbers))
    }
}

impl Command {
    /// Does the work; results are written to `out`.
    pub(crate) fn run(&self, out: &mut StandardStream) -> anyhow::Result<()> {
        let line = |words: Vec<OsString>, out: &mut StandardStream| {
            Cli::understood(words)?.command.run(out)
        };
        match self {
            Self::Demo(args) => args.run(out, &line),
            Self::Init(args) => args.run(out),
            Self::Import(args) => args.run(out),
            Self::Solve(args) => args.run(out),
            Self::Info(args) => args.run(out),
            Self::Check(args) => args.run(out),
            Self::Sif(args) => args.run(out),
            Self::Weight(args) => args.run(out),
            Self::Probe(args) => args.run(out),
            Self::Sample(args) => args.run(out),
            Self::Render(args) => args.run(out),
            Self::Compare(args) => args.run(out),
            Self::Plot(args) => args.run(out),
            Self::Export(args) => args.run(out),
            Self::View(args) => args.run(out),
            Self::Formula(args) => args.run(out),
            Self::Completions(args) => args.run(out, Cli::whole()),
            Self::Man(args) => args.run(out, Cli::whole()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Clap's own checks of names, conflicts and defaults.
    #[test]
    fn the_command_line_is_consistent() {
        Cli::whole().debug_assert();
    }

    #[test]
    fn options_of_other_programs_are_answered_by_ours() {
        for (words, option) in [
            ("render a.h5 -o a.png --cmap magma", "--colormap"),
            ("render a.h5 -o a.png --contour=5", "--isolines"),
            ("render a.h5 -o a.png --vmin 0", "--range"),
            ("solve a.toml --jobs 2", "--threads"),
            ("plot a.h5 --crack 0 -o a.svg --field uy", "--quantity"),
        ] {
            let words = ["ppum"].into_iter().chain(words.split(' ')).map(OsString::from);
            let message = Cli::understood(words).map(|_| ()).unwrap_err().to_string();
            assert!(message.contains(&format!("the option is called `{option}`")), "{message}");
            assert!(message.contains("Usage: ppum "), "{message}");
        }
        // a command that has no such option
        let words = ["ppum", "info", "a.h5", "--cmap", "magma"].map(OsString::from);
        let message = Cli::understood(words).map(|_| ()).unwrap_err().to_string();
        assert!(!message.contains("colormap"), "{message}");
    }

    #[test]
    fn every_command_has_examples() {
        for command in Cli::command().get_subcommands() {
            let text = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            let example = format!("ppum {}", command.get_name());
            assert!(text.starts_with("Examples:") && text.contains(&example), "{example}: {text}");
        }
    }
}
