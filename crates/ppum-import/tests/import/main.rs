//! Drawings as their readers meet them.
#![allow(clippy::unwrap_used, reason = "a test may fail anywhere")]

mod hostile;
mod parts;
mod rules;
mod trips;
