//! Datasets whose steps are read one at a time.

use std::path::Path;

use ppum::check::CheckError;
use ppum::dataset::{BoxPartition, Dataset, Step};
use ppum_file::RangedFile;

use crate::bytes::{from_file, invalid, newer};
use crate::content::step_path;
use crate::error::ReadError;
use crate::hdf5::{Outline, Ranges};
use crate::limits::{MAX_LENGTH, MAX_SERIES_LENGTH};
use crate::schema::RESULTS;
use crate::{checksum, decode};

/// A dataset whose steps are read when they are asked for, each at the cost of one step.
///
/// While it is open another program may append steps to the file, or replace it: it sees the steps
/// that were there when it was opened. A file with one checksum over all of it, as those of one
/// step have and those of versions before 1.4, is read and checked as a whole when it is opened.
#[derive(Debug)]
pub struct Series {
    head: Dataset,
    minor: u32,
    steps: StepStore,
}

#[derive(Debug)]
enum StepStore {
    /// All of them are in memory.
    Read(Vec<Step>),
    Stored(RangedFile, Outline),
}

/// Attempts to read what another program may be changing: it changes it once in a step,
/// within microseconds.
const ATTEMPTS: u32 = 5;

impl Series {
    /// Opens a regular file of at most [`MAX_SERIES_LENGTH`] bytes.
    ///
    /// # Errors
    ///
    /// [`ReadError`]: whatever is wrong outside of the steps, or with their numbers; of a file with
    /// one checksum over all of it whatever [`read`](crate::read()) refuses.
    pub fn open(path: &Path) -> Result<Self, ReadError> {
        let io = |error| ReadError::io(path, error);
        let file = RangedFile::open(path, MAX_SERIES_LENGTH).map_err(io)?;
        let outline = || Outline::read(&file, file.length(MAX_SERIES_LENGTH).map_err(io)?);
        let mut read = outline();
        for _ in 1..ATTEMPTS {
            match read {
                Err(ReadError::Hdf5 { .. }) => read = outline(),
                _ => break,
            }
        }
        let outline = read?;
        let minor = decode::check_version(&outline.content)?;
        if checksum::is_whole(&outline.content) {
            return from_file(&file, file.length(MAX_LENGTH).map_err(io)?).map(Self::of);
        }
        let head = head(&outline).map_err(|error| newer(error, minor))?;
        Ok(Self { head, minor, steps: StepStore::Stored(file, outline) })
    }

    /// A dataset that is in memory.
    #[must_use]
    pub fn of(mut dataset: Dataset) -> Self {
        let steps = std::mem::take(&mut dataset.steps);
        Self { head: dataset, minor: 0, steps: StepStore::Read(steps) }
    }

    /// Returns the data that all steps have in common: a dataset without steps.
    #[must_use]
    pub fn head(&self) -> &Dataset {
        &self.head
    }

    /// True if steps are read when they are asked for, and can be appended to the file: it has no
    /// checksum over all of it.
    #[must_use]
    pub fn can_grow(&self) -> bool {
        matches!(self.steps, StepStore::Stored(..))
    }

    /// The number of steps, at least one.
    #[expect(clippy::len_without_is_empty, reason = "it never is")]
    #[must_use]
    pub fn len(&self) -> usize {
        match &self.steps {
            StepStore::Read(steps) => steps.len(),
            StepStore::Stored(_, outline) => outline.steps().len(),
        }
    }

    /// The dataset with one of its steps alone.
    ///
    /// # Errors
    ///
    /// [`ReadError`]: there is no such step, or it is not what it should be. The dataset returned
    /// has passed [`Dataset::check`].
    pub fn dataset(&self, number: usize) -> Result<Dataset, ReadError> {
        match &self.steps {
            StepStore::Read(steps) => {
                let mut dataset = self.head.clone();
                dataset.steps.push(get(steps, number)?.clone());
                Ok(dataset)
            }
            StepStore::Stored(file, outline) => self.explained(self.stored(file, outline, number)),
        }
    }

    /// The cracks of a step and what its solver tells of it: load, stress intensity factors,
    /// history and warnings. It has no patches, functions and fields, and so its checksum is not
    /// looked at.
    ///
    /// # Errors
    ///
    /// [`ReadError`]: there is no such step, or these parts of it are not what they should be.
    pub fn results(&self, number: usize) -> Result<Step, ReadError> {
        match &self.steps {
            StepStore::Read(steps) => get(steps, number).cloned(),
            StepStore::Stored(file, outline) => {
                self.explained(self.stored_results(file, outline, number))
            }
        }
    }

    /// As [`at`](Self::at), but of a dataset that is in memory all steps are there, and no step is
    /// read if there is none of this number.
    ///
    /// # Errors
    ///
    /// As [`dataset`](Self::dataset).
    pub fn into_dataset(self, number: usize) -> Result<Dataset, ReadError> {
        match &self.steps {
            StepStore::Stored(..) if number < self.len() => self.at(number),
            _ => self.filled(|series, _| series.empty(0)),
        }
    }

    /// The dataset with as many steps as there are, of which this one alone is read, at its number.
    /// The others are empty, without patches, and their loads are those of the first step, or of
    /// the last one.
    ///
    /// # Errors
    ///
    /// As [`dataset`](Self::dataset).
    pub fn at(&self, number: usize) -> Result<Dataset, ReadError> {
        let [first, last] = [0, self.len() - 1].map(|end| self.empty(end));
        let ([first, last], mut dataset) = ([first?, last?], self.dataset(number)?);
        let step = dataset.steps.remove(0);
        dataset.steps = vec![first; self.len()];
        dataset.steps[self.len() - 1] = last;
        dataset.steps[number] = step;
        Ok(dataset)
    }

    /// The dataset with what [`results`](Self::results) gives of each step; of one that is in
    /// memory with all of them.
    ///
    /// # Errors
    ///
    /// As [`results`](Self::results).
    pub fn into_results(self) -> Result<Dataset, ReadError> {
        self.filled(Self::results)
    }

    /// The dataset with these steps, or with those that are in memory.
    fn filled(
        mut self,
        step: impl Fn(&Self, usize) -> Result<Step, ReadError>,
    ) -> Result<Dataset, ReadError> {
        let steps = match &mut self.steps {
            StepStore::Read(steps) => std::mem::take(steps),
            StepStore::Stored(..) => {
                (0..self.len()).map(|k| step(&self, k)).collect::<Result<_, _>>()?
            }
        };
        let mut dataset = self.head;
        dataset.steps = steps;
        Ok(dataset)
    }

    /// A step with its load alone.
    fn empty(&self, number: usize) -> Result<Step, ReadError> {
        let (file, outline) = match &self.steps {
            StepStore::Stored(file, outline) => (file, outline),
            StepStore::Read(steps) => {
                let mut step = Step::new(BoxPartition::EMPTY);
                step.load = get(steps, number)?.load;
                return Ok(step);
            }
        };
        let path = path(number, self.len())?;
        let read = outline.step(file, &path, Some(&[]));
        self.explained(read.and_then(|content| decode::part_of_step(&content, &path, &[])))
    }

    /// The dataset with a step that is read now. The step's checksum is compared while it is made.
    fn stored(
        &self,
        file: &dyn Ranges,
        outline: &Outline,
        number: usize,
    ) -> Result<Dataset, ReadError> {
        let path = path(number, self.len())?;
        let content = outline.step(file, &path, None)?;
        let dataset = || {
            let mut dataset = self.head.clone();
            dataset.steps.push(decode::one_step(&content, &path, &self.head.tables)?);
            dataset.check().map_err(|error| invalid(numbered(error, number), &content))?;
            Ok(dataset)
        };
        let (verified, dataset) = rayon::join(|| checksum::verify_step(&content, &path), dataset);
        verified?;
        dataset
    }

    fn stored_results(
        &self,
        file: &dyn Ranges,
        outline: &Outline,
        number: usize,
    ) -> Result<Step, ReadError> {
        let path = path(number, self.len())?;
        let content = outline.step(file, &path, Some(RESULTS))?;
        let step = decode::part_of_step(&content, &path, RESULTS)?;
        step.check_results().map_err(|mut error| {
            error.place = format!("steps[{number}].{}", error.place);
            invalid(error, &content)
        })?;
        Ok(step)
    }

    fn explained<T>(&self, read: Result<T, ReadError>) -> Result<T, ReadError> {
        read.map_err(|error| newer(error, self.minor))
    }
}

/// The dataset without steps, and that their numbers are without gaps.
fn head(outline: &Outline) -> Result<Dataset, ReadError> {
    checksum::verify_rest(&outline.content)?;
    let head = decode::head(&outline.content)?;
    let count = outline.steps().len();
    if count == 0 {
        // it says that there is none
        head.check().map_err(|error| invalid(error, &outline.content))?;
    }
    for number in 0..count {
        let path = step_path(number);
        if !outline.has_step(&path) {
            return Err(decode::missing(&path, count));
        }
    }
    Ok(head)
}

fn get(steps: &[Step], number: usize) -> Result<&Step, ReadError> {
    path(number, steps.len())?;
    Ok(&steps[number])
}

/// The path of a step, if it is one of so many.
fn path(number: usize, count: usize) -> Result<String, ReadError> {
    let path = step_path(number);
    if number < count {
        return Ok(path);
    }
    Err(ReadError::object(&path, format!("there are {count} steps, the last is {}", count - 1)))
}

/// An error in the only step at hand, with the number that it has in the file.
pub(crate) fn numbered(mut error: CheckError, number: usize) -> CheckError {
    if let Some(rest) = error.place.strip_prefix("steps[0]") {
        error.place = format!("steps[{number}]{rest}");
    }
    error
}
