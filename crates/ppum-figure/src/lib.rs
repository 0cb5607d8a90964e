//! Figures: everything that is drawn on and around an image of a field.
//!
//! [`ppum_render`] evaluates a field and gives its values colours. Here the image gets its
//! cracks, rims and cells ([`overlay`]), axes, a colour bar and a title
//! ([`figure()`](figure::figure)), or several images stand on one page
//! ([`panels`](figure::panels)). All of it is first put on a [`Canvas`](canvas::Canvas), which is
//! then drawn as pixels or written as SVG or PDF.

pub mod canvas;
pub mod figure;
pub mod form;
pub mod levels;
pub mod overlay;
pub mod plot;
pub mod text;
pub mod ticks;

#[cfg(test)]
ppum_testkit::errors_cross_threads!(figure::FigureError);
