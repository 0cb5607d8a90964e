//! An image of a request from a view: its values, their colours, its overlays, its page.

mod drawn;
mod error;
mod input;
mod pages;
mod source;

pub use drawn::{RenderedImage, tell_legend};
pub use error::ImageError;
pub use input::{Evaluate, ImageInput};
pub use pages::{page, page_seen, reshaped, shot, view_in};
pub use source::{FieldSource, QuantityRequest, of_step, title};
