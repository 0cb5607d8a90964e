//! Drawing of the whole of a body that is [mirrored](crate::mirror): values, their extrema and
//! isolines, made of those of the body and of its images.

mod drawn;
mod extrema;
mod isolines;
mod zero_line;

pub(crate) use drawn::{draw, reflected};
pub(crate) use extrema::extrema;
pub(crate) use isolines::{between_ends, isolines};
