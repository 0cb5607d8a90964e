//! The text of a problem file: its keys, its values with their places, files that it names.

pub(crate) mod csv;
mod diagnostics;
mod document;
mod key;
mod key_kinds;
pub mod keys;
pub(crate) mod points;
pub(crate) mod table_file;

pub(crate) use diagnostics::DiagnosticList;
pub use document::MAX_LENGTH;
pub(crate) use document::{DocumentValue, FileSource, FromValue, ProblemDocument, Section, all};
pub(crate) use key::{Key, KeyError, no_such};
pub use table_file::read_table;
