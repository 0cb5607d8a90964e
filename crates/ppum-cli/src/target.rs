//! Files that commands write: what is refused before any work is done.

use std::io::{self, Write};
use std::path::Path;

use anyhow::{Context as _, bail, ensure};

use crate::standard::{self, is_standard};

/// The content of a file.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum FileKind {
    Dataset,
    Problem,
    Picture,
    /// An animation.
    Animation,
    Table,
    /// A page, a mesh or lines.
    Export,
}

/// A format of files, by the extension of their names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum FileFormat {
    Hdf5,
    Toml,
    Png,
    Svg,
    Pdf,
    Gif,
    Apng,
    Csv,
    Npy,
    Html,
    Vtu,
    VtkHdf,
    /// A list of meshes.
    Pvd,
    /// Lines and points.
    Vtp,
}

/// Extensions with the formats that they stand for, and what files of these hold.
const FORMATS: [(&str, FileFormat, FileKind); 16] = [
    ("h5", FileFormat::Hdf5, FileKind::Dataset),
    ("hdf5", FileFormat::Hdf5, FileKind::Dataset),
    ("toml", FileFormat::Toml, FileKind::Problem),
    ("png", FileFormat::Png, FileKind::Picture),
    ("svg", FileFormat::Svg, FileKind::Picture),
    ("pdf", FileFormat::Pdf, FileKind::Picture),
    ("gif", FileFormat::Gif, FileKind::Animation),
    ("apng", FileFormat::Apng, FileKind::Animation),
    ("html", FileFormat::Html, FileKind::Export),
    ("htm", FileFormat::Html, FileKind::Export),
    ("vtu", FileFormat::Vtu, FileKind::Export),
    ("vtkhdf", FileFormat::VtkHdf, FileKind::Export),
    ("pvd", FileFormat::Pvd, FileKind::Export),
    ("vtp", FileFormat::Vtp, FileKind::Export),
    ("csv", FileFormat::Csv, FileKind::Table),
    ("npy", FileFormat::Npy, FileKind::Table),
];

impl FileFormat {
    /// The format that a name ends in; none if it ends in nothing known.
    pub(crate) fn of(path: &Path) -> Option<Self> {
        let end = path.extension()?;
        let mut formats = FORMATS.iter();
        formats.find(|(known, ..)| end.eq_ignore_ascii_case(known)).map(|(_, format, _)| *format)
    }
}

impl FileKind {
    /// Its name in messages.
    fn words(self) -> &'static str {
        match self {
            Self::Dataset => "datasets are HDF5 files",
            Self::Problem => "problem files are TOML files",
            Self::Picture => "pictures are PNG, SVG or PDF files",
            Self::Animation => "moving pictures are GIF or APNG files",
            Self::Export => {
                "pages are HTML files, meshes VTU, VTKHDF or PVD files, lines VTP files"
            }
            Self::Table => "tables are CSV or NPY files",
        }
    }

    /// Refuses a name that says that something else is in the file.
    fn check_name(self, path: &Path) -> anyhow::Result<()> {
        let own = || FORMATS.iter().filter(|(.., kind)| *kind == self);
        let format = FileFormat::of(path);
        let known: Vec<_> = own().map(|(extension, ..)| format!(".{extension}")).collect();
        ensure!(
            own().any(|(_, own, _)| Some(*own) == format),
            "{}: {}; end the name in {}",
            path.display(),
            self.words(),
            known.join(" or ")
        );
        Ok(())
    }

    /// Refuses to write what is no text to a terminal.
    fn check_output(self) -> anyhow::Result<()> {
        match self {
            Self::Dataset => standard::check_output("a dataset"),
            Self::Picture | Self::Animation => standard::check_output("a picture"),
            Self::Export => standard::check_output("a page"),
            Self::Table | Self::Problem => Ok(()),
        }
    }
}

/// Refuses now what could not be written after minutes of work, and what would be lost: `inputs`
/// are the files that the command reads.
pub(crate) fn check<'i>(
    path: &Path,
    kind: FileKind,
    inputs: impl IntoIterator<Item = &'i Path>,
) -> anyhow::Result<()> {
    if is_standard(path) {
        return kind.check_output();
    }
    ensure!(!path.is_dir(), "{}: is a folder; give a file with -o", path.display());
    if let Some(input) = inputs.into_iter().find(|i| !is_standard(i) && ppum_file::is_same(path, i))
    {
        bail!(
            "{}: would replace {}, which is read; give another file with -o",
            path.display(),
            input.display()
        );
    }
    kind.check_name(path)?;
    ppum_file::check(path).with_context(|| cannot_write(path))
}

/// Refuses to replace a file that users may have edited.
pub(crate) fn check_new(path: &Path) -> anyhow::Result<()> {
    match ppum_file::open(path, u64::MAX) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(()),
        _ => bail!(
            "{}: is there already; give another file, or --force to replace it",
            path.display()
        ),
    }
}

/// Writes a file, completely or not at all.
pub(crate) fn save(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> anyhow::Result<()> {
    ppum_file::replace(path, write).with_context(|| cannot_write(path))
}

/// Writes a file piece by piece, completely or not at all; what is written may fail for reasons of
/// its own.
pub(crate) fn stream(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> anyhow::Result<()>,
) -> anyhow::Result<()> {
    ppum_file::replace(path, write).map_err(|error| {
        let is_io = error.chain().any(<dyn std::error::Error>::is::<io::Error>);
        if is_io { error.context(cannot_write(path)) } else { error }
    })
}

/// Makes a folder and those above, where there are none.
pub(crate) fn make_folder(path: &Path) -> anyhow::Result<()> {
    std::fs::create_dir_all(path).with_context(|| cannot_write(path))
}

fn cannot_write(path: &Path) -> String {
    format!("cannot write {}", path.display())
}
