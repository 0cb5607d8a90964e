//! `ppum completions`: what shells need to complete commands and options.

use std::io::Write;

use clap::Command;
use clap_complete::{Shell, generate};

/// Print completions for a shell
///
/// The examples have the files in which shells look for them.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct CompletionsArgs {
    /// Shell
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

const EXAMPLES: &str = "\
Examples:
  ppum completions bash > ~/.local/share/bash-completion/completions/ppum
  ppum completions zsh > ~/.zfunc/_ppum
  ppum completions fish > ~/.config/fish/completions/ppum.fish";

impl CompletionsArgs {
    /// Does the work; `program` is the command line as a whole.
    pub(crate) fn run(&self, out: &mut dyn Write, mut program: Command) -> anyhow::Result<()> {
        let mut script = Vec::new();
        generate(self.shell, &mut program, "ppum", &mut script);
        out.write_all(&script)?;
        Ok(())
    }
}
