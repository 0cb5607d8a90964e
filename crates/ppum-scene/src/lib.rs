//! Images of a dataset: their content, as data, and their drawing; files for other programs, and
//! reports.
//!
//! Requests of people are plain data that can be compared, kept and written: a
//! [`Request`](request::Request). With a field it makes a [`subject`], of which an
//! image comes about in four stages, each of which is a value of its own, so that a program can
//! keep what has not changed: the [`values`] of the [`body`] in a view;
//! their [colours](image::coloring); the [`layers`] over them; and their
//! [composition](image::compose). The program, its window, pages and Python draw by this crate
//! alone, so all draw the same.

#[cfg(feature = "problem")]
pub mod export;
pub mod image;
pub mod report;
pub mod request;

pub use image::{
    animation, body, camera, coloring, compare, compose, deformed, difference, engine, error,
    layers, material, mirror_lines, notice, panels, quantity, subject, values,
};
#[cfg(feature = "problem")]
pub use report::{facts, plots};
pub use report::{location, owner, probe, profile, range, table};
#[cfg(feature = "clap")]
pub use request::{arguments, help};
pub use request::{
    backend, colors, command, list, magnification, mirror, overlays, page_style, region, scene,
};

#[cfg(test)]
ppum_testkit::errors_cross_threads!(error::ImageError);
