//! `ppum view`: the window.

use std::path::PathBuf;

use ppum_scene::backend::Backend;

use crate::output::StandardStream;

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
    /// Opens the window, and ends when it is closed.
    #[cfg(feature = "window")]
    pub(crate) fn run(&self, out: &mut StandardStream) -> anyhow::Result<()> {
        match &self.screenshot {
            None => Ok(ppum_viewer::window::run(self.start()?)?),
            Some(target) => self.draw(out, target),
        }
    }

    /// Files that are not there are told before a window opens.
    #[cfg(feature = "window")]
    fn start(&self) -> anyhow::Result<ppum_viewer::window::WindowStart> {
        use anyhow::Context as _;

        let files: Vec<PathBuf> = self.session.iter().chain(&self.files).cloned().collect();
        for file in &files {
            std::fs::metadata(file).with_context(|| format!("cannot read {}", file.display()))?;
        }
        Ok(ppum_viewer::window::WindowStart {
            files,
            size: self.size.map(|size| size.map(|n| n as f32)),
            backend: self.backend,
            folder: ppum_viewer::files::window_state::folder(),
            memory: Some(crate::memory::free),
            ..Default::default()
        })
    }

    #[cfg(feature = "window")]
    fn draw(&self, out: &mut StandardStream, target: &std::path::Path) -> anyhow::Result<()> {
        use std::io::Write as _;

        let inputs = self.session.iter().chain(&self.files).map(PathBuf::as_path);
        let is_png = crate::target::FileFormat::of(target) == Some(crate::target::FileFormat::Png);
        anyhow::ensure!(
            is_png || crate::standard::is_standard(target),
            "--screenshot {}: the picture of a window is a PNG file; end the name in .png",
            target.display()
        );
        crate::target::check(target, crate::target::FileKind::Picture, inputs)?;
        let start = self.start()?;
        let image = ppum_viewer::offscreen::screenshot(start)?;
        let png = ppum_render::png::encode(&image, &[])?;
        if crate::standard::is_standard(target) {
            return Ok(out.exact().write_all(&png)?);
        }
        crate::target::save(target, |file| file.write_all(&png))?;
        writeln!(out, "wrote {}", target.display())?;
        Ok(())
    }

    /// Says how to get the window.
    #[cfg(not(feature = "window"))]
    pub(crate) fn run(&self, _: &mut StandardStream) -> anyhow::Result<()> {
        let Self { files: _, session: _, backend: _, size: _, screenshot: _ } = self;
        anyhow::bail!(
            "this program was built without the window; build it with \
             `cargo install --locked --path crates/ppum-cli --features window`"
        )
    }
}
