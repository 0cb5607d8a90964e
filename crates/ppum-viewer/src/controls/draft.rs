//! What is written and not yet understood.

use ppum_scene::overlays::Levels;

/// Levels while they are written.
#[derive(Clone, Debug, Default)]
pub struct LevelsDraft {
    pub(crate) text: String,
    pub(crate) base: Option<Levels>,
    pub(crate) mistake: Option<String>,
}
