//! `ppum init`: a problem file to begin with.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use ppum_problem::TEMPLATE;

use crate::output::StandardStream;
use crate::standard::is_standard;
use crate::target;

/// Write a problem file with comments, to be edited
///
/// The file is a plate with a slanted crack, which `ppum solve` solves as it is. Comments show the
/// other tables: holes, contact, supports, growth.
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct InitArgs {
    /// Problem file to write, - for standard output
    #[arg(value_name = "FILE.toml", default_value = "problem.toml")]
    output: PathBuf,
    /// Replace an existing problem file
    #[arg(long)]
    force: bool,
}

const EXAMPLES: &str = "\
Examples:
  ppum init
  ppum init plate.toml
  ppum init - | ppum solve - -o plate.h5";

impl InitArgs {
    pub(crate) fn run(&self, out: &mut StandardStream) -> anyhow::Result<()> {
        let Self { output, force } = self;
        target::check(output, target::FileKind::Problem, [])?;
        if is_standard(output) {
            return Ok(out.exact().write_all(TEMPLATE.as_bytes())?);
        }
        if !force {
            target::check_new(output)?;
        }
        let text = TEMPLATE.replace("FILE.", &format!("{}.", name(output)));
        target::save(output, |file| file.write_all(text.as_bytes()))?;
        writeln!(out, "wrote {0}; edit it, then: ppum solve {0}", output.display())?;
        Ok(())
    }
}

/// Returns the path without its extension, in which nothing ends a comment.
fn name(path: &Path) -> String {
    let name = path.with_extension("").to_string_lossy().into_owned();
    if name.chars().any(char::is_control) { "FILE".into() } else { name }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_problem::Problem;

    /// Without comment signs every line but those of prose is valid, too.
    #[test]
    fn the_file_and_what_its_comments_offer_are_problems() {
        let problem = Problem::parse(TEMPLATE, "init.toml", Path::new("")).expect("a problem");
        assert_eq!((problem.cracks().len(), problem.boundary.len()), (1, 2));
        let offered: String = TEMPLATE
            .lines()
            .skip_while(|line| line.starts_with('#'))
            .map(|line| line.strip_prefix("# ").unwrap_or(line).to_owned() + "\n")
            .collect();
        let problem = Problem::parse(&offered, "init.toml", Path::new("")).expect("a problem");
        assert!(problem.growth.is_some() && problem.domain().holes.len() == 1);
    }

    #[test]
    fn names_with_control_characters_do_not_end_comments() {
        assert_eq!(name(Path::new("a/plate.toml")), "a/plate");
        assert_eq!(name(Path::new("a\nyoung = 3.toml")), "FILE");
    }
}
