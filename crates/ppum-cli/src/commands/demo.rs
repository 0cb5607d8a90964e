//! `ppum demo`: a guided tour, made of the program's own commands.

use std::ffi::OsString;
use std::io::{ErrorKind, Write as _};
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail, ensure};

use crate::output::StandardStream;
use crate::target;

/// Solve the centre crack and draw it
///
/// Runs the commands it prints: they can be repeated and changed one by one.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct DemoArgs {
    /// Folder for the problem file, the dataset and the images; made if there is none
    #[arg(short, long, value_name = "DIR", default_value = "out")]
    output: PathBuf,
}

const EXAMPLES: &str = "\
Examples:
  ppum demo
  ppum demo -o tour";

/// The problem: one text for the demonstration and the examples.
const PROBLEM: &str = include_str!("../../../../examples/centre-crack.toml");

/// The commands that are run; `@` stands for the folder.
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

/// Runs a command line, given word by word.
pub(crate) type Run<'a> = &'a dyn Fn(Vec<OsString>, &mut StandardStream) -> anyhow::Result<()>;

impl DemoArgs {
    /// Does the work; `run` runs a command line.
    pub(crate) fn run(&self, out: &mut StandardStream, run: Run<'_>) -> anyhow::Result<()> {
        let problem = self.output.join("centre-crack.toml");
        self.check(&problem)?;
        target::save(&problem, |out| out.write_all(PROBLEM.as_bytes()))?;
        writeln!(out, "wrote {}", problem.display())?;
        for line in TOUR {
            writeln!(out, "\n$ {}", self.shown(line))?;
            out.flush()?;
            run(self.words(line), out)?;
        }
        writeln!(out, "\nOpen the images in {}. Then try:", self.output.display())?;
        NEXT.iter().try_for_each(|line| writeln!(out, "  {}", self.shown(line)))?;
        Ok(())
    }

    /// Makes the folder; refuses before any work what could not be written, and a problem that is
    /// the user's.
    fn check(&self, problem: &Path) -> anyhow::Result<()> {
        check_file(problem, PROBLEM)?;
        target::make_folder(&self.output)?;
        let words = TOUR.iter().flat_map(|line| line.split(' '));
        for name in words.filter_map(|word| word.strip_prefix("@/")?.strip_suffix(".png")) {
            let picture = self.output.join(format!("{name}.png"));
            target::check(&picture, target::FileKind::Picture, [problem])?;
        }
        Ok(())
    }

    /// A command line, word by word.
    fn words(&self, line: &str) -> Vec<OsString> {
        let word = |word: &str| match word.strip_prefix("@/") {
            Some(name) => self.output.join(name).into_os_string(),
            None => word.into(),
        };
        ["ppum"].into_iter().chain(line.split(' ')).map(word).collect()
    }

    /// A command line as one would type it, with the program as this one was called.
    fn shown(&self, line: &str) -> String {
        let program = std::env::args_os().find(is_program).unwrap_or_else(|| "ppum".into());
        let quoted = |word: &OsString| {
            let text = word.to_string_lossy();
            if text.contains(' ') { format!("'{text}'") } else { text.into_owned() }
        };
        let words = self.words(line);
        [&program].into_iter().chain(&words[1..]).map(quoted).collect::<Vec<_>>().join(" ")
    }
}

/// True of the name that this program was called by: not of an interpreter that runs it.
fn is_program(word: &OsString) -> bool {
    Path::new(word).file_stem().is_some_and(|name| name == "ppum")
}

/// Refuses a file that is not the demonstration's own.
fn check_file(path: &Path, text: &str) -> anyhow::Result<()> {
    let own = "give another folder with -o, or remove it";
    match ppum_file::text(path, text.len() as u64) {
        Ok(found) => ensure!(found == text, "{}: was edited; {own}", path.display()),
        Err(e) if matches!(e.kind(), ErrorKind::NotFound | ErrorKind::NotADirectory) => {}
        Err(e) if matches!(e.kind(), ErrorKind::FileTooLarge | ErrorKind::InvalidData) => {
            bail!("{}: is another file; {own}", path.display())
        }
        Err(e) => return Err(e).with_context(|| format!("cannot read {}", path.display())),
    }
    Ok(())
}
