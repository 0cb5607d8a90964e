//! Drawings and meshes, from which problems are imported.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use ppum_import::{DrawingFormat, ImportOptions};
use ppum_problem::{MAX_LENGTH, Problem};

use crate::solving::preview::Preview;

/// Ends of the names of drawings and meshes that bodies are read from.
pub const DRAWINGS: &[&str] = &["dxf", "svg", "msh", "geo"];

/// Longest drawing, in bytes.
const LONGEST: u64 = 1 << 28;

/// A drawing or mesh as it was read.
#[derive(Clone, Debug)]
pub struct DrawingSource {
    /// The file.
    pub path: PathBuf,
    /// The names of its layers, groups or labels.
    pub layers: Vec<String>,
    bytes: Vec<u8>,
    format: DrawingFormat,
}

/// The problem of a drawing.
#[derive(Clone, Debug)]
pub struct ImportedProblem {
    /// The text of the problem file, as `ppum import` writes it.
    pub text: String,
    /// The body.
    pub preview: Option<Preview>,
    /// The notes on curves that were not read or were changed, with their places in the file.
    pub notices: Vec<String>,
}

impl DrawingSource {
    /// Reads a file.
    ///
    /// # Errors
    /// A file that cannot be read, or has no curves.
    pub fn read(path: &Path) -> Result<Self, String> {
        let format = DrawingFormat::of_extension(&name(path.extension()));
        let bytes = ppum_file::read(path, LONGEST).map_err(|error| error.to_string())?;
        let layers = format.clone().and_then(|format| ppum_import::layers(&bytes, format));
        let (format, layers) = (text_of(format)?, text_of(layers)?);
        Ok(Self { path: path.to_owned(), layers, bytes, format })
    }

    /// Makes a problem of the drawing.
    ///
    /// # Errors
    /// Curves that are no outline with holes and cracks in it; a text that is too long.
    pub fn import(&self, options: &ImportOptions) -> Result<ImportedProblem, String> {
        let body = text_of(ppum_import::read(&self.bytes, self.format, options))?;
        let text = body.problem_file(&name(self.path.file_stem()), &name(self.path.file_name()));
        if text.len() as u64 > MAX_LENGTH {
            return Err("its problem would be too long; give a larger tolerance".into());
        }
        let preview = Problem::body_of(&text, Path::new(""));
        let preview = preview.map(|text| Preview::of_body(&text.body));
        Ok(ImportedProblem { text, preview, notices: body.notices })
    }
}

fn name(part: Option<&OsStr>) -> String {
    part.unwrap_or_default().to_string_lossy().into_owned()
}

fn text_of<T>(result: Result<T, ppum_import::ImportError>) -> Result<T, String> {
    result.map_err(|error| error.to_string())
}
