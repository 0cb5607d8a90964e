//! `ppum view`: the window.

use std::path::PathBuf;

use crate::output::Output;

/// Explore a dataset in a window, exactly, down to the tip
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct Args {
    /// Dataset
    #[arg(value_name = "FILE.h5")]
    file: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  ppum view plate.h5";

impl Args {
    /// Opens the window, and ends when it is closed.
    #[cfg(feature = "window")]
    pub(crate) fn run(&self, _: &mut Output) -> anyhow::Result<()> {
        use std::sync::Arc;

        use ppum_viewer::window::{Start, run};

        let open = |path: &PathBuf| {
            anyhow::Ok((Some(path.clone()), Arc::new(crate::dataset::open(path)?)))
        };
        let datasets = self.file.iter().map(open).collect::<anyhow::Result<_>>()?;
        Ok(run(Start { datasets, ..Start::default() })?)
    }

    /// Says how to get the window.
    #[cfg(not(feature = "window"))]
    pub(crate) fn run(&self, _: &mut Output) -> anyhow::Result<()> {
        anyhow::bail!(
            "this program was built without the window; build it with \
             `cargo install --locked --path crates/ppum-cli --features window`"
        )
    }
}
