//! Pages as files.

use std::io::Write as _;
use std::path::Path;

use anyhow::Context as _;
use ppum_figure::canvas::Canvas;
use ppum_figure::form::PageFormat;
use ppum_render::png::TextChunk;
use ppum_scene::notice::Notice;

use crate::output::{StandardStream, tell};
use crate::standard::is_standard;
use crate::target;

/// Writes a page to a file or to standard output, and tells `told` of it, which begins with
/// `wrote PATH: `.
pub(crate) fn save(
    path: &Path,
    page: &Canvas,
    dpi: Option<f64>,
    texts: &[TextChunk],
    told: &str,
    out: &mut StandardStream,
) -> anyhow::Result<()> {
    put(path, page, dpi, texts, out)?;
    if is_standard(path) {
        tell(&format!("wrote standard output: {told}"));
    } else {
        writeln!(out, "wrote {}: {told}", path.display())?;
    }
    Ok(())
}

/// Writes a page to a file or to standard output, and tells nothing but what its letters lack.
pub(crate) fn put(
    path: &Path,
    page: &Canvas,
    dpi: Option<f64>,
    texts: &[TextChunk],
    out: &mut StandardStream,
) -> anyhow::Result<()> {
    let form = PageFormat::of(path);
    warn(Notice::of_glyphs(page, form));
    if is_standard(path) {
        return Ok(out.exact().write_all(&bytes(form, page, dpi, texts)?)?);
    }
    write(path, page, dpi, texts)
}

/// Writes a page to a file and tells nothing.
pub(crate) fn write(
    path: &Path,
    page: &Canvas,
    dpi: Option<f64>,
    texts: &[TextChunk],
) -> anyhow::Result<()> {
    let bytes = bytes(PageFormat::of(path), page, dpi, texts)?;
    target::save(path, |out| out.write_all(&bytes))
}

fn bytes(
    form: PageFormat,
    page: &Canvas,
    dpi: Option<f64>,
    texts: &[TextChunk],
) -> anyhow::Result<Vec<u8>> {
    form.bytes(page, dpi, texts).context("cannot encode the picture")
}

/// Tells what is to be known of an image.
pub(crate) fn warn(notices: impl IntoIterator<Item = Notice>) {
    notices.into_iter().for_each(|notice| tell(&notice.line()));
}
