//! Graphics devices, all that the program knows of them; without the feature `gpu` there are none.

mod adapter;
#[cfg(feature = "gpu")]
mod devices;
#[cfg(not(feature = "gpu"))]
mod none;

pub(crate) use adapter::Adapter;
#[cfg(feature = "gpu")]
pub(crate) use devices::{DRAW, MISSING, adapters};
#[cfg(not(feature = "gpu"))]
pub(crate) use none::{DRAW, MISSING, adapters};
