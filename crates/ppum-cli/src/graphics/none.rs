//! A program that was built without graphics devices: the CPU draws.

use ppum::progress::Watcher;
use ppum_render::samples::Samples;
use ppum_scene::drawing::{DrawingInput, Drawn};
use ppum_scene::engine::{CardError, Device, Method};

use super::Adapter;

/// The answer of `ppum info --gpu`.
pub(crate) const MISSING: &str = "\
no graphics adapter: this program was built without graphics cards; build it with
`cargo install --locked --path crates/ppum-cli --features window` (or `--features gpu`, without the window).
Images are drawn on the CPU instead, the same to rounding.";

/// The reason why no device draws.
const REASON: &str =
    "no graphics adapter: this program was built without graphics cards (`--features gpu`)";

pub(crate) fn draw(
    _: DrawingInput<'_>,
    _: Samples,
    _: Device,
    _: Method,
    _: &dyn Watcher,
) -> Result<Drawn, CardError> {
    Err(CardError { message: format!("{REASON}; `--backend cpu` needs none"), is_normal: true })
}

pub(crate) fn adapters() -> Vec<Adapter> {
    Vec::new()
}
