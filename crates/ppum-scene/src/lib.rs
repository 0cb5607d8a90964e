//! Images of a dataset: their content, as data, and their drawing.
//!
//! An image comes about in four steps, each of which is a value of its own, so that a program can
//! keep what has not changed: the [view](body::BodyView) of the body; the values
//! ([`PixelValues`](drawing::PixelValues)) of the [quantity](drawing::DisplayedQuantity) that is
//! shown; their colours, a range ([`range::value_span`]) and a style
//! ([`ColorOptions`](colors::ColorOptions)); the [`Layers`](layers::Layers) of its
//! [`Overlays`](overlays::Overlays). The users' choices are plain data that can be compared, kept
//! and written. The program's commands and its window draw by this crate alone, so both draw the
//! same.

#[cfg(feature = "clap")]
pub mod arguments;
pub mod body;
pub mod camera;
pub mod colors;
pub mod command;
pub mod compare;
pub mod deformed;
pub mod difference;
pub mod drawing;
pub mod engine;
#[cfg(feature = "problem")]
pub mod export;
#[cfg(feature = "problem")]
pub mod facts;
#[cfg(feature = "clap")]
pub mod help;
pub mod image_job;
pub mod layers;
pub mod location;
pub mod material;
pub mod mirror;
pub mod moving;
pub mod notice;
pub mod overlays;
pub mod owner;
pub mod page_style;
pub mod panels;
pub mod paper;
pub mod place;
#[cfg(feature = "problem")]
pub mod plots;
pub mod probe;
pub mod profile;
pub mod range;
pub mod request;
pub mod scene;
pub mod shared;
pub mod shot;
mod stations;
pub mod table;
mod whole;
mod written;

#[cfg(test)]
ppum_testkit::errors_cross_threads!(layers::LayersError);
