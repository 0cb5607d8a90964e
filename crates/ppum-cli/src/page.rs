//! Pages as files: PNG, SVG or PDF, by the name's end.

use std::io::Write as _;
use std::path::Path;

use anyhow::Context as _;
use ppum::printable::printable;
use ppum_figure::canvas::Canvas;
use ppum_render::png::{self, Text};

use crate::output::{Output, tell};
use crate::standard::is_standard;
use crate::target;

/// The form of a picture's file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Form {
    Png,
    Svg,
    Pdf,
}

impl Form {
    /// The form that a name ends in; PNG for standard output.
    pub(crate) fn of(path: &Path) -> Self {
        let ends_in =
            |wanted: &str| path.extension().is_some_and(|e| e.eq_ignore_ascii_case(wanted));
        match () {
            () if ends_in("svg") => Self::Svg,
            () if ends_in("pdf") => Self::Pdf,
            () => Self::Png,
        }
    }

    /// The file's bytes; `dpi` is its number of pixels per inch if that was given.
    fn bytes(self, page: &Canvas, dpi: Option<f64>, texts: &[Text]) -> anyhow::Result<Vec<u8>> {
        // that of screens, as the design of figures has it
        let known = dpi.unwrap_or(96.0);
        Ok(match self {
            Self::Png => {
                png::encode_at(&page.image(), dpi, texts).context("cannot encode the picture")?
            }
            Self::Svg => page.svg(known, texts).into_bytes(),
            Self::Pdf => page.pdf(known, texts),
        })
    }
}

/// Writes a page to a file or to standard output, and tells `told` of it, which begins with `wrote PATH: `.
pub(crate) fn save(
    path: &Path,
    page: &Canvas,
    dpi: Option<f64>,
    texts: &[Text],
    told: &str,
    out: &mut Output,
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
    texts: &[Text],
    out: &mut Output,
) -> anyhow::Result<()> {
    let form = Form::of(path);
    warn_of_missing(page, form);
    if is_standard(path) {
        return Ok(out.exact().write_all(&form.bytes(page, dpi, texts)?)?);
    }
    write(path, page, dpi, texts)
}

/// Writes a page to a file and tells nothing.
pub(crate) fn write(
    path: &Path,
    page: &Canvas,
    dpi: Option<f64>,
    texts: &[Text],
) -> anyhow::Result<()> {
    let bytes = Form::of(path).bytes(page, dpi, texts)?;
    target::save(path, |out| out.write_all(&bytes))
}

/// Tells which characters the font of figures lacks.
pub(crate) fn warn_of_missing(page: &Canvas, form: Form) {
    let missing: Vec<String> = page.missing().iter().map(|c| format!("`{c}`")).collect();
    if missing.is_empty() {
        return;
    }
    let shown = match form {
        Form::Svg => "programs with other fonts show them",
        Form::Png | Form::Pdf => "boxes stand for them",
    };
    let list = missing.join(", ");
    tell(&format!("warning: the font of figures lacks {}; {shown}", printable(&list)));
}
