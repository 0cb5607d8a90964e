//! Text that is written and not yet understood.

use ppum_scene::overlays::IsolineLevels;

/// Levels while they are written.
#[derive(Clone, Debug, Default)]
pub struct LevelsDraft {
    pub(crate) text: String,
    pub(crate) base: Option<IsolineLevels>,
    pub(crate) mistake: Option<String>,
}
