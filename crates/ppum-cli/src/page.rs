//! Pages as files: PNG, SVG or PDF by their names.

use std::path::Path;

use anyhow::Context as _;
use ppum_figure::canvas::Canvas;
use ppum_render::png::{self, Text};

use crate::output::Output;
use crate::standard::is_standard;
use crate::target;

/// Pixels per inch of vector files.
pub(crate) const DPI: f64 = 96.0;

/// The bytes of a page as a file of this name; PNG where the name says nothing else.
pub(crate) fn bytes(page: &Canvas, path: &Path, texts: &[Text]) -> anyhow::Result<Vec<u8>> {
    let has = |wanted: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(wanted));
    if has("svg") {
        return Ok(page.svg(DPI, texts).into_bytes());
    }
    if has("pdf") {
        return Ok(page.pdf(DPI, texts));
    }
    png::encode(&page.image(), texts).context("cannot encode the picture")
}

/// Writes a page to a file or standard output.
pub(crate) fn save(
    page: &Canvas,
    path: &Path,
    texts: &[Text],
    out: &mut Output,
) -> anyhow::Result<()> {
    let bytes = bytes(page, path, texts)?;
    if is_standard(path) {
        out.exact().write_all(&bytes)?;
        return Ok(());
    }
    target::save(path, |file| file.write_all(&bytes))
}
