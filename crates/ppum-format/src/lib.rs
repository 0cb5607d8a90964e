//! [`Dataset`] ↔ HDF5, as `FORMAT.md` describes it.
//!
//! [`write()`] and [`read`] work on files, [`to_bytes`] and [`from_bytes`] in memory (also where
//! there is no file system), [`Arrays`] makes a dataset of arrays by the names of the format, or a
//! file of another one.
//! [`Series`] reads one step of a file at a time, [`SeriesWriter`] appends one. Between a dataset
//! and HDF5 stands the content: a sorted map from the names of arrays and attributes to their
//! values. Names and shapes meet the data model in `schema`, which describes each object once: how
//! it is written and read, and its place in errors. HDF5 is known to `hdf5` alone, and the checksum
//! is taken over the content, so it does not depend on how HDF5 lays out its bytes.
//!
//! Files are not trusted: whatever their bytes are, reading ends in a checked [`Dataset`] or in a
//! [`ReadError`] that names the object at fault, and what is allocated is bounded by the file's
//! size.
//!
//! ```
//! use ppum::prelude::*;
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let domain = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
//! let partition = Cover::uniform(domain, 1)?.partition(1.3, WeightFunction::Linear)?;
//! let mut potential = FieldData::new("potential", &["u"]);
//! (0..partition.len()).for_each(|_| potential.push_patch(&[(0, 2)]));
//! let step = Step::new(partition).with_function("one", FunctionKind::One).with_field(potential);
//! let dataset = Dataset::new(domain, Equation::poisson(1.0)).with_step(step);
//!
//! let bytes = ppum_format::to_bytes(&dataset)?;
//! assert_eq!(ppum_format::from_bytes(bytes.clone())?, dataset);
//!
//! let half = bytes[..bytes.len() / 2].to_vec();
//! let error = ppum_format::from_bytes(half).unwrap_err();
//! assert!(matches!(error, ppum_format::ReadError::Hdf5 { .. }));
//!
//! # let folder = tempfile::tempdir()?;
//! # let path = folder.path().join("series.h5");
//! let mut writer = ppum_format::SeriesWriter::begin(&path, &dataset)?;
//! writer.append(&dataset.steps[0])?;
//! let series = ppum_format::Series::open(&path)?;
//! assert_eq!((series.len(), series.dataset(1)?), (2, dataset));
//! # Ok(())
//! # }
//! ```
//!
//! [`Dataset`]: ppum::dataset::Dataset

mod append;
mod arrays;
mod bytes;
mod checksum;
mod content;
mod decode;
mod encode;
mod error;
#[cfg(test)]
#[path = "../tests/fixture/everything.rs"]
mod everything;
mod file;
#[cfg(test)]
#[path = "../tests/damage/forge.rs"]
#[allow(dead_code, reason = "made for the tests of files")]
mod forge;
mod hdf5;
mod limits;
mod lookup3;
mod member;
mod place;
mod reader;
mod schema;
mod scopes;
mod series;
mod stored;
mod writer;

pub use append::SeriesWriter;
pub use arrays::Arrays;
pub use bytes::{check, diagnose_bytes, from_bytes, to_bytes};
pub use content::ArrayValues;
pub use error::{ReadError, WriteError};
pub use file::{diagnose, read, write};
pub use limits::{FORMAT_VERSION, MAX_LENGTH, MAX_SERIES_LENGTH};
pub use series::Series;
