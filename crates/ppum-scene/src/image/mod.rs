//! Images: from a request and a field to pixels and pages.

pub mod animation;
pub mod body;
pub(crate) mod boundary;
pub mod camera;
pub mod coloring;
pub mod compare;
pub mod compose;
pub mod deformed;
pub mod difference;
pub mod engine;
pub mod error;
pub mod layers;
pub mod material;
pub mod mirror_lines;
pub mod notice;
pub mod panels;
pub mod quantity;
pub mod subject;
pub mod values;
pub(crate) mod whole;
