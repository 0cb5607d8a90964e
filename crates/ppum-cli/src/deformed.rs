//! Options that draw the deformed plate, and where it is seen.

use anyhow::ensure;
use ppum::text::trimmed;
use ppum::vec2::Rect;
use ppum_render::deform::{Deformation, DeformedView};
use ppum_scene::deformed::Factor;
use ppum_scene::drawing::BodyView;
use ppum_scene::engine::Engine;
use ppum_scene::moving::FrameView;
use ppum_scene::request::Request;
use ppum_scene::shot::FieldSource;

use crate::window::{ImageExtent, WindowArgs};

/// How the plate is deformed.
#[derive(Debug, clap::Args)]
pub(crate) struct Deformed {
    /// Draw the plate with so many times its displacement; `auto` shows the largest as some 5 % of
    /// the plate
    #[arg(long = "deformed", value_name = "FACTOR|auto", allow_hyphen_values = true)]
    pub(crate) factor: Option<Factor>,
    /// Draw the border of the undeformed plate too, dashed
    #[arg(long, requires = "factor")]
    pub(crate) outline: bool,
}

/// Where plates are seen, one or those of a series.
pub(crate) struct Placing<'a> {
    pub(crate) window: &'a WindowArgs,
    pub(crate) frame: ImageExtent,
    /// The factor of deformed plates, and what of the plane is seen of them without a window.
    pub(crate) deformed: Option<(f64, Rect)>,
}

impl FrameView<anyhow::Error> for Placing<'_> {
    fn seen<'f>(
        &self,
        source: FieldSource<'f>,
        _: &Request,
        engine: &Engine<'_>,
    ) -> anyhow::Result<BodyView<'f>> {
        let Some((factor, bounds)) = self.deformed else {
            return Ok(BodyView::Plate(self.window.seen(source.field, self.frame)?));
        };
        engine.check_deformed()?;
        let view = self.moved(source, factor, bounds)?;
        Ok(BodyView::Moved(view.points(engine.watcher)?))
    }
}

impl Placing<'_> {
    /// The view of a deformed plate. Windows are places of the deformed plane; that around a tip
    /// follows it.
    fn moved<'f>(
        &self,
        FieldSource { field, .. }: FieldSource<'f>,
        factor: f64,
        bounds: Rect,
    ) -> anyhow::Result<DeformedView<'f>> {
        let deformation = Deformation::new(field, factor)?;
        let view = self.window.over(bounds, field, self.frame)?;
        if let Some(tip) = self.window.tip(field)? {
            return Ok(deformation.around(tip, view.width, view.pixels)?);
        }
        ensure!(
            view.rect().overlaps(&bounds),
            "the view shows nothing of the deformed plate, which lies between ({}, {}) and ({}, {})",
            trimmed(bounds.min.x),
            trimmed(bounds.min.y),
            trimmed(bounds.max.x),
            trimmed(bounds.max.y)
        );
        Ok(deformation.seen(&view))
    }
}
