//! A program that was built without graphics devices: the CPU draws.

use ppum_scene::engine::DrawOnCard;

use super::Adapter;

/// None: the engine says why.
pub(crate) const DRAW: Option<DrawOnCard> = None;

/// The answer of `ppum info --gpu`.
pub(crate) const MISSING: &str = "\
no graphics adapter: this program was built without graphics cards; build it with
`cargo install --locked --path crates/ppum-cli --features window` (or `--features gpu`, without the window).
Images are drawn on the CPU instead, the same to rounding.";

pub(crate) fn adapters() -> Vec<Adapter> {
    Vec::new()
}
