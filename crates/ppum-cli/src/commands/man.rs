//! `ppum man`: manual pages.

use std::io::Write;
use std::path::PathBuf;

use clap::Command;
use clap_mangen::Man;

use crate::target;

/// Print the manual page, or write the pages of all commands
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct ManArgs {
    /// Folder for the pages of all commands, made if there is none
    #[arg(short, long, value_name = "DIR")]
    output: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  ppum man | man -l -
  ppum man -o ~/.local/share/man/man1";

impl ManArgs {
    /// Does the work; `program` is the command line as a whole.
    pub(crate) fn run(&self, out: &mut dyn Write, program: Command) -> anyhow::Result<()> {
        let Some(folder) = &self.output else {
            let mut page = Vec::new();
            Man::new(program).render(&mut page)?;
            out.write_all(&page)?;
            return Ok(());
        };
        target::make_folder(folder)?;
        for page in pages(program) {
            target::save(&folder.join(page.get_filename()), |out| page.render(out))?;
        }
        writeln!(out, "wrote the manual pages to {}", folder.display())?;
        Ok(())
    }
}

/// The pages of the program and of all its commands.
fn pages(program: Command) -> Vec<Man> {
    let mut program = program.disable_help_subcommand(true);
    program.build();
    let commands: Vec<_> = program.get_subcommands().cloned().collect();
    [program].into_iter().chain(commands).map(Man::new).collect()
}
