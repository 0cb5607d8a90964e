//! Datasets to which steps are appended.

use std::io;
use std::path::{Path, PathBuf};

use ppum::dataset::{Dataset, Step};
use ppum_file::AppendFile;

use crate::bytes::{appended, begun};
use crate::error::WriteError;
use crate::hdf5::AppendState;
use crate::limits::MAX_SERIES_LENGTH;
use crate::series::{Series, numbered};

/// A file that steps are appended to, each at the cost of one step, whatever is there already.
///
/// The file is complete at any moment, also if the program is killed, the power fails or the disk
/// is full: it holds the steps that were appended before. Whether a run was interrupted or not, the
/// bytes in the end are the same. As long as this lives no other run writes the file; reading it,
/// by [`Series`] or any other program, works all the time.
#[derive(Debug)]
pub struct SeriesWriter {
    path: PathBuf,
    file: AppendFile,
    state: AppendState,
    head: Dataset,
    len: usize,
}

impl SeriesWriter {
    /// Begins a file with all steps of a dataset, in place of what is there, as
    /// [`write`](crate::write()) does.
    ///
    /// # Errors
    ///
    /// As [`write`](crate::write()), and [`WriteError::Io`] if another run is writing the file.
    pub fn begin(path: &Path, dataset: &Dataset) -> Result<Self, WriteError> {
        dataset.check()?;
        let bytes = begun(dataset)?;
        let state = AppendState::read(&bytes.as_slice()).expect("this program made it");
        let file: io::Result<_> = AppendFile::begin(path, |out| out.write_all(&bytes));
        let file = file.map_err(|error| failed(path, error))?;
        let mut head = dataset.clone();
        let steps = std::mem::take(&mut head.steps);
        let mut writer = Self { path: path.to_owned(), file, state, head, len: 1 };
        steps.iter().skip(1).try_for_each(|step| writer.append(step))?;
        Ok(writer)
    }

    /// Opens a file that was begun before, to append to it.
    ///
    /// # Errors
    ///
    /// [`WriteError::Io`]: there is none, or another run is writing it; [`WriteError::Unreadable`]:
    /// it cannot be read; [`WriteError::NoSeries`]: it was written as a whole, or another program
    /// has rewritten it.
    pub fn resume(path: &Path) -> Result<Self, WriteError> {
        let file = AppendFile::open(path).map_err(|error| failed(path, error))?;
        let series = Series::open(path).map_err(|error| WriteError::Unreadable {
            path: path.to_owned(),
            source: Box::new(error),
        })?;
        let no_series = |reason| WriteError::NoSeries { path: path.to_owned(), reason };
        if !series.can_grow() {
            return Err(no_series("it has one checksum over all of it"));
        }
        let state = AppendState::read(file.file()).ok_or_else(|| no_series(REWRITTEN))?;
        let (head, len) = (series.head().clone(), series.len());
        Ok(Self { path: path.to_owned(), file, state, head, len })
    }

    /// The number of steps in the file.
    #[expect(clippy::len_without_is_empty, reason = "it never is")]
    #[must_use]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Appends a step, and sees it to the disk.
    ///
    /// # Errors
    ///
    /// [`WriteError`], and then the file holds the steps that it held before.
    pub fn append(&mut self, step: &Step) -> Result<(), WriteError> {
        self.check(step)?;
        let (addition, state) = appended(&self.state, self.len, step)?;
        let length = addition.end + addition.bytes.len() as u64;
        if length > MAX_SERIES_LENGTH {
            return Err(WriteError::TooLong { length, most: MAX_SERIES_LENGTH });
        }
        let written = self.file.append(addition.end, &addition.bytes);
        let written = written.and_then(|()| self.file.publish(0, &addition.start));
        written.map_err(|error| failed(&self.path, error))?;
        (self.state, self.len) = (state, self.len + 1);
        Ok(())
    }

    fn check(&self, step: &Step) -> Result<(), WriteError> {
        let mut dataset = self.head.clone();
        dataset.steps.push(step.clone());
        Ok(dataset.check().map_err(|error| numbered(error, self.len))?)
    }
}

const REWRITTEN: &str = "another program has rewritten it";

fn failed(path: &Path, source: io::Error) -> WriteError {
    WriteError::Io { path: path.to_owned(), source }
}
