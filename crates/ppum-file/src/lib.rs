//! The one place where files are read and written.
//!
//! [`read()`] and [`text`] take whole files, within a limit that the caller states, and refuse what
//! has no end. [`replace`] writes files completely or not at all; [`check`] says beforehand whether
//! it could. [`RangedFile`] reads parts of a file, and [`AppendFile`] is one that is appended to
//! while others read it. A program that is told to end calls [`abandon`].
//!
//! Errors are [`std::io::Error`]s, those of the system and own ones; their texts are reasons that
//! stand behind `cannot read FILE: ` or `cannot write FILE: `.
//!
//! ```
//! # fn main() -> std::io::Result<()> {
//! # let folder = tempfile::tempdir()?;
//! let path = folder.path().join("numbers.csv");
//! ppum_file::replace(&path, |out| writeln!(out, "1,2"))?;
//! assert_eq!(ppum_file::text(&path, 1 << 20)?, "1,2\n");
//! let error = ppum_file::read(&path, 2).unwrap_err();
//! assert_eq!(error.to_string(), "it has more than 2 bytes, the most that are read");
//! # Ok(())
//! # }
//! ```

mod append_file;
mod lock;
mod part;
mod ranged;
mod read;
mod same;
mod write;

pub use append_file::AppendFile;
pub use part::{WriteLock, abandon};
pub use ranged::RangedFile;
pub use read::{open, read, text, text_within, within};
pub use same::is_same;
pub use write::{check, replace};
