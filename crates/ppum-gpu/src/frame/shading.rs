//! The 1D transfer function on the card: the colours of a map and where values lie among them.

use ppum_render::colormap::Colormap;
use ppum_render::image::Rgba;
use ppum_render::scale::{Normalization, Scale};
use ppum_render::shades::PALETTE;

use super::view_data::ViewRecord;

/// Colours of the range; below, above and undefined follow.
pub(crate) const PALETTE_TEXELS: u32 = PALETTE as u32;

/// Kinds of scale in the shader; 0 is linear.
pub(crate) const LOG: u32 = 1;
pub(crate) const SYMLOG: u32 = 2;

/// A transfer function: how values become colours, the range known.
#[derive(Clone, Debug)]
pub struct TransferFunction {
    /// Position of a value among the colours.
    pub normalization: Normalization,
    /// The colours, those below and above the range included.
    pub colormap: Colormap,
    /// The colour of pixels without a value.
    pub undefined: Rgba,
}

impl TransferFunction {
    /// The palette's texels.
    pub(crate) fn texels(&self) -> Vec<u8> {
        let Colormap { below, above, .. } = &self.colormap;
        let special = [*below, *above, self.undefined];
        self.colormap.palette(PALETTE).into_iter().chain(special).flatten().collect()
    }

    /// Writes down where values lie.
    pub(crate) fn note(&self, record: &mut ViewRecord) {
        let norm = &self.normalization;
        record.scale = match norm.scale() {
            Scale::Linear => 0,
            Scale::Log => LOG,
            Scale::SymLog => SYMLOG,
        };
        record.range_min = norm.min() as f32;
        record.range_max = norm.max() as f32;
        record.threshold = norm.threshold() as f32;
        record.scale_start = norm.start() as f32;
        record.per_span = norm.per_span() as f32;
    }
}
