//! Which part of the plane is drawn.

use anyhow::ensure;
use ppum::field::Field;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_render::view::View;

use crate::arguments::{corners, point, positive};
use crate::tips;

/// The window: one way of giving it, or none for the whole domain.
#[derive(Debug, clap::Args)]
pub(crate) struct WindowArgs {
    /// Window by two opposite corners
    #[arg(long, value_name = "X0,Y0,X1,Y1", allow_hyphen_values = true, value_parser = corners)]
    #[arg(conflicts_with_all = ["center", "tip"])]
    view: Option<Rect>,
    /// Window by its centre, with --width
    #[arg(long, value_name = "X,Y", allow_hyphen_values = true, value_parser = point)]
    #[arg(requires = "width", conflicts_with = "tip")]
    center: Option<Vec2>,
    /// Width of the window around --center
    #[arg(long, value_name = "W", requires = "center", value_parser = positive)]
    width: Option<f64>,
    /// Window around a crack tip, numbered from 0 as in `ppum sif`
    #[arg(long, value_name = "K")]
    tip: Option<usize>,
    /// How much larger than in a picture of the whole domain things are around --tip [default: 10]
    #[arg(long, value_name = "Z", requires = "tip", value_parser = positive)]
    zoom: Option<f64>,
}

/// The pixels of an image, and the margin around the domain.
#[derive(Clone, Copy, Debug)]
pub(crate) struct ImageExtent {
    pub(crate) pixels: [u32; 2],
    /// A picture of the whole domain takes no more pixels than that has.
    pub(crate) may_shrink: bool,
    /// Room around the domain in a picture of all of it, in parts of its larger side.
    pub(crate) margin: f64,
}

const DEFAULT_ZOOM: f64 = 10.0;

impl WindowArgs {
    /// True if one is asked for.
    pub(crate) fn is_given(&self) -> bool {
        self.view.is_some() || self.center.is_some() || self.tip.is_some()
    }

    /// Width over height of what is to be seen; none if it is whatever the picture has room for.
    pub(crate) fn aspect(&self, field: &Field<'_>) -> Option<f64> {
        if self.center.is_some() || self.tip.is_some() {
            return None;
        }
        let size = self.view.unwrap_or(field.domain.bounds).size();
        Some(size.x / size.y)
    }

    /// The view; of the whole picture that of a box.
    pub(crate) fn over(
        &self,
        whole: Rect,
        field: &Field<'_>,
        frame: ImageExtent,
    ) -> anyhow::Result<View> {
        let ImageExtent { pixels, may_shrink, margin } = frame;
        if let Some(Rect { min, max }) = self.view {
            return Ok(View::window(min.x, min.y, max.x, max.y, pixels)?);
        }
        if let (Some(center), Some(width)) = (self.center, self.width) {
            return Ok(View::new(center, width, pixels)?);
        }
        if let Some(tip) = self.tip(field)? {
            let fit = View::fit(field.domain.bounds, pixels)?;
            let width = fit.width / self.zoom.unwrap_or(DEFAULT_ZOOM);
            return Ok(View::new(tip, width, pixels)?);
        }
        let fit = if may_shrink { View::hug } else { View::fit };
        let Rect { min, max } = whole;
        let room = margin * (max.x - min.x).max(max.y - min.y);
        let room = vec2(room, room);
        Ok(fit(Rect::new(min - room, max + room), pixels)?)
    }

    /// The place of the tip that is asked for.
    pub(crate) fn tip(&self, field: &Field<'_>) -> anyhow::Result<Option<Vec2>> {
        let position = |number| {
            let tip = tips::numbered(field, number)?;
            Ok(field.step.cracks[tip.crack as usize].end_point(tip.end))
        };
        self.tip.map(position).transpose()
    }

    /// The view, which must show some of the domain.
    pub(crate) fn seen(&self, field: &Field<'_>, frame: ImageExtent) -> anyhow::Result<View> {
        let view = self.over(field.domain.bounds, field, frame)?;
        ensure!(
            view.rect().overlaps(&field.domain.bounds),
            "the view shows nothing of the domain; `ppum info` says where that is"
        );
        Ok(view)
    }
}
