//! The forms of files that pages are written in, by the name's end.

use std::io;
use std::path::Path;

use ppum_render::png::{self, TextChunk};

use crate::canvas::Canvas;

/// The file format of a page.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PageFormat {
    /// Pixels.
    Png,
    /// Vectors, for the web and for drawing programs.
    Svg,
    /// Vectors, for papers.
    Pdf,
}

/// Pixels per inch of screens, as the style of figures has it.
const SCREEN: f64 = 96.0;

impl PageFormat {
    /// The form that a name ends in; PNG if it ends in nothing known.
    #[must_use]
    pub fn of(path: &Path) -> Self {
        let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
        match extension.as_ref().and_then(|extension| extension.to_str()) {
            Some("svg") => Self::Svg,
            Some("pdf") => Self::Pdf,
            _ => Self::Png,
        }
    }

    /// The file's bytes; `dpi` is its number of pixels per inch if that is known.
    ///
    /// # Errors
    /// An image that is too large to be encoded.
    pub fn bytes(
        self,
        page: &Canvas,
        dpi: Option<f64>,
        texts: &[TextChunk],
    ) -> io::Result<Vec<u8>> {
        let known = dpi.unwrap_or(SCREEN);
        Ok(match self {
            Self::Png => png::encode_at(&page.image(), dpi, texts).map_err(io::Error::other)?,
            Self::Svg => page.svg(known, texts).into_bytes(),
            Self::Pdf => page.pdf(known, texts),
        })
    }
}
