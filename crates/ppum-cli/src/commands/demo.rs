//! `ppum demo`: a guided tour, made of the program's own commands.

use std::ffi::OsString;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Context as _;
use clap::Parser as _;

use crate::cli::Cli;

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
const PROBLEM: &str = include_str!("../../../../examples/centre-crack.toml");
const NAME: &str = "centre-crack";

/// The commands that are run. `@` stands for the folder.
const TOUR: [&str; 5] = [
    "solve @/centre-crack.toml",
    "render @/centre-crack.h5 -o @/von-mises.png --figure",
    "render @/centre-crack.h5 -o @/displacement.png -q magnitude --colormap magma --figure",
    "render @/centre-crack.h5 -o @/tip.png --tip 1 --zoom 1000 --scale log --figure",
    "render @/centre-crack.h5 -o @/patches.png --tip 1 --zoom 4 --overlay cracks,patches --figure",
];

/// Commands to go on with.
const NEXT: [&str; 5] = [
    "info @/centre-crack.h5",
    "sif @/centre-crack.h5",
    "probe @/centre-crack.h5 --at 0,0",
    "render @/centre-crack.h5 -o @/deep.png --tip 1 --zoom 1e12 --scale log --figure",
    "render --help",
];

impl Args {
    pub(crate) fn run(&self, out: &mut dyn Write) -> anyhow::Result<()> {
        self.write_problem()?;
        writeln!(out, "wrote {}", self.path(&format!("{NAME}.toml")).display())?;
        for line in TOUR {
            writeln!(out, "\n$ {}", self.shown(line))?;
            out.flush()?;
            Cli::try_parse_from(self.words(line))?.command.run(out)?;
        }
        writeln!(out, "\nOpen the pictures in {}. Then try:", self.output.display())?;
        for line in NEXT {
            writeln!(out, "  {}", self.shown(line))?;
        }
        Ok(())
    }

    fn path(&self, name: &str) -> PathBuf {
        self.output.join(name)
    }

    fn write_problem(&self) -> anyhow::Result<()> {
        let context = |path: &Path| format!("cannot write {}", path.display());
        fs::create_dir_all(&self.output).with_context(|| context(&self.output))?;
        let path = self.path(&format!("{NAME}.toml"));
        fs::write(&path, PROBLEM).with_context(|| context(&path))
    }

    /// The command line, word by word.
    fn words(&self, line: &str) -> Vec<OsString> {
        let word = |word: &str| match word.strip_prefix("@/") {
            Some(name) => self.path(name).into_os_string(),
            None => word.into(),
        };
        ["ppum"].into_iter().chain(line.split(' ')).map(word).collect()
    }

    /// The command line as one would type it, with the program as this one was called.
    fn shown(&self, line: &str) -> String {
        let program = std::env::args_os().next().unwrap_or_else(|| "ppum".into());
        let quoted = |word: &OsString| {
            let text = word.to_string_lossy();
            if text.contains(' ') { format!("'{text}'") } else { text.into_owned() }
        };
        let words = self.words(line);
        [&program].into_iter().chain(&words[1..]).map(quoted).collect::<Vec<_>>().join(" ")
    }
}
