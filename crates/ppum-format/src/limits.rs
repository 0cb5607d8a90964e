//! The version of the format, and the most that is read.

/// Version of the format as (major, minor). A reader takes every minor version of its own major
/// version; what it does not know is optional.
pub const FORMAT_VERSION: (u32, u32) = (1, 9);

/// Most values that the tables of a file may have together. In memory a value of a table takes 16
/// numbers more, those of its spline, so a small file could ask for more than there is.
pub(crate) const MAX_TABLE_VALUES: usize = 1 << 20;

/// Longest file that is read as a whole, in bytes: some times that of a million patches of order 8.
pub const MAX_LENGTH: u64 = 4 << 30;

/// Longest file whose steps are read one by one, in bytes: a thousand of a gigabyte.
pub const MAX_SERIES_LENGTH: u64 = 1 << 40;
