//! `ppum view`: the window.

use std::io::Write as _;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, ensure};
use ppum_scene::backend::Backend;

use crate::graphics::{self, Window, WindowRequest};
use crate::memory;
use crate::output::StandardStream;
use crate::standard::is_standard;
use crate::target::{self, FileFormat, FileKind};

/// Explore datasets in a window, exactly, down to the tip
#[derive(Debug, clap::Args)]
#[command(after_help = EXAMPLES)]
pub(crate) struct ViewArgs {
    /// Datasets, problem files or a session: one, or two side by side [default: what was open the
    /// last time]
    #[arg(value_name = "FILE", num_args = 0..=2)]
    files: Vec<PathBuf>,
    /// Session to begin with, as the window saves it
    #[arg(long, value_name = "FILE.ppum-session", conflicts_with = "files")]
    session: Option<PathBuf>,
    /// Device that computes the values
    #[arg(long, value_enum, default_value = "auto")]
    backend: Backend,
    /// Width and height of the window in points [default: those of the last time]
    #[arg(long, value_name = "WxH", value_parser = size)]
    size: Option<[u32; 2]>,
    /// Draw the window into an image once it is complete, and end; no display is needed
    #[arg(long, value_name = "OUT.png")]
    screenshot: Option<PathBuf>,
}

const EXAMPLES: &str = "\
Examples:
  ppum view                                  what was open the last time
  ppum view plate.h5
  ppum view coarse.h5 fine.h5                two side by side
  ppum view plate.toml                       a problem, to be changed and solved
  ppum view --session tip.ppum-session --size 1600x900 --screenshot tip.png";

/// Points of a window on each side.
const SIZES: std::ops::RangeInclusive<u32> = 200..=16_384;

fn size(text: &str) -> Result<[u32; 2], String> {
    let size = text.split_once('x').and_then(|(w, h)| Some([w.parse().ok()?, h.parse().ok()?]));
    let size = size.filter(|size: &[u32; 2]| size.iter().all(|n| SIZES.contains(n)));
    size.ok_or_else(|| {
        let (least, most) = (SIZES.start(), SIZES.end());
        format!("a size is WIDTHxHEIGHT, two whole numbers from {least} to {most}, like 1280x800")
    })
}

impl ViewArgs {
    /// Opens the window, and ends when it is closed, or says how to get the window.
    pub(crate) fn run(&self, out: &mut StandardStream) -> anyhow::Result<()> {
        let window = graphics::graphics().window.context(
            "this program was built without the window; build it with \
             `cargo install --locked --path crates/ppum-cli --features window`",
        )?;
        match &self.screenshot {
            None => (window.open)(self.request()?),
            Some(target) => self.draw(window, out, target),
        }
    }

    /// Files that are not there are told before a window opens.
    fn request(&self) -> anyhow::Result<WindowRequest> {
        let files: Vec<PathBuf> = self.session.iter().chain(&self.files).cloned().collect();
        for file in &files {
            std::fs::metadata(file).with_context(|| format!("cannot read {}", file.display()))?;
        }
        let (size, backend) = (self.size, self.backend);
        Ok(WindowRequest { files, size, backend, free_memory: memory::free })
    }

    fn draw(&self, window: Window, out: &mut StandardStream, target: &Path) -> anyhow::Result<()> {
        let inputs = self.session.iter().chain(&self.files).map(PathBuf::as_path);
        ensure!(
            FileFormat::of(target) == Some(FileFormat::Png) || is_standard(target),
            "--screenshot {}: the picture of a window is a PNG file; end the name in .png",
            target.display()
        );
        target::check(target, FileKind::Picture, inputs)?;
        let image = (window.screenshot)(self.request()?)?;
        let png = ppum_render::png::encode(&image, &[])?;
        if is_standard(target) {
            return Ok(out.exact().write_all(&png)?);
        }
        target::save(target, |file| file.write_all(&png))?;
        writeln!(out, "wrote {}", target.display())?;
        Ok(())
    }
}
