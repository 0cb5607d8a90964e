//! `ppum man`: manual pages.

use std::fs;
use std::io::Write;
use std::path::PathBuf;

use anyhow::Context as _;
use clap::CommandFactory as _;
use clap_mangen::{Man, generate_to};

use crate::cli::Cli;

/// Print the manual page, or write the pages of all commands
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Folder for the pages of all commands, made if there is none
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  ppum man | man -l -
  ppum man -o ~/.local/share/man/man1";

impl Args {
    pub(crate) fn run(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        let Some(folder) = &self.output else {
            let mut page = Vec::new();
            Man::new(Cli::command()).render(&mut page)?;
            out.write_all(&page)?;
            return Ok(());
        };
        let context = || format!("cannot write {}", folder.display());
        fs::create_dir_all(folder).with_context(context)?;
        generate_to(Cli::command(), folder).with_context(context)?;
        writeln!(out, "wrote the manual pages to {}", folder.display())?;
        Ok(())
    }
}
