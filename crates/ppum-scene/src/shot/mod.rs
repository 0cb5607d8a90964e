//! A picture of a request from a view: its values, their colours, what lies over them, its page.

mod drawn;
mod error;
mod input;
mod pages;
mod source;

pub use drawn::{Shot, tell_legend};
pub use error::ShotError;
pub use input::{Evaluate, Input};
pub use pages::{page, page_seen, reshaped, shot, view_in};
pub use source::{Asked, FieldSource, of_step, title};
