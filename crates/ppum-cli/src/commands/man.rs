//! `ppum man`: manual pages.

use std::io::Write;
use std::path::PathBuf;

use clap::CommandFactory as _;
use clap_mangen::Man;

use crate::cli::Cli;
use crate::target;

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
        target::make_folder(folder)?;
        for page in pages() {
            target::save(&folder.join(page.get_filename()), |out| page.render(out))?;
        }
        writeln!(out, "wrote the manual pages to {}", folder.display())?;
        Ok(())
    }
}

/// The pages of the program and of all its commands.
fn pages() -> Vec<Man> {
    let mut program = Cli::command().disable_help_subcommand(true);
    program.build();
    let commands: Vec<_> = program.get_subcommands().cloned().collect();
    [program].into_iter().chain(commands).map(Man::new).collect()
}
