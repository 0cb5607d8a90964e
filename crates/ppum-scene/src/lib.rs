//! What a picture of a dataset shows, as data, and what is drawn of it.
//!
//! A picture comes about in four steps, each of which is a value of its own, so that a program can
//! keep what has not changed: the [view](body::BodyView) of the body; the values
//! [`Drawn`](drawing::Drawn) of what is [`Shown`](drawing::Shown); their colours, a range
//! ([`range::value_span`]) and a style ([`Colors`](colors::Colors)); the
//! [`Layers`](layers::Layers) of its [`Overlays`](overlays::Overlays). What people choose is plain
//! data that can be compared, kept and written. The program's commands and its window draw by this
//! crate alone, so both draw the same.

#[cfg(feature = "clap")]
pub mod arguments;
pub mod body;
pub mod colors;
pub mod command;
pub mod compare;
pub mod deformed;
pub mod drawing;
pub mod engine;
#[cfg(feature = "problem")]
pub mod export;
#[cfg(feature = "problem")]
pub mod facts;
#[cfg(feature = "clap")]
pub mod help;
pub mod layers;
pub mod look;
pub mod material;
pub mod minus;
pub mod mirror;
pub mod moving;
pub mod notice;
pub mod overlays;
pub mod owner;
pub mod panels;
pub mod paper;
pub mod place;
pub mod placing;
#[cfg(feature = "problem")]
pub mod plots;
pub mod probe;
pub mod profile;
pub mod range;
pub mod request;
pub mod scene;
pub mod shared;
pub mod shot;
pub mod spot;
mod stations;
pub mod still;
pub mod table;
mod whole;
mod written;

#[cfg(test)]
ppum_testkit::errors_cross_threads!(layers::LayersError);
