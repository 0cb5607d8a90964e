//! The part of the plane that is drawn.

use anyhow::{Context as _, ensure};
use ppum::crack::tips;
use ppum::field::Field;
use ppum::vec2::{Rect, Vec2};
use ppum_render::view::View;

use crate::arguments::{corners, point, positive};
use crate::number::count;

/// The window: one way of giving it, or none for the whole domain.
#[derive(Debug, clap::Args)]
pub(super) struct Window {
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

/// The room there is.
pub(super) struct Frame {
    pub(super) pixels: [u32; 2],
    /// A picture of the whole domain takes no more pixels than that has.
    pub(super) may_shrink: bool,
}

const DEFAULT_ZOOM: f64 = 10.0;

impl Window {
    pub(super) fn view(&self, field: &Field<'_>, frame: Frame) -> anyhow::Result<View> {
        let Frame { pixels, may_shrink } = frame;
        if let Some(Rect { min, max }) = self.view {
            return Ok(View::window(min.x, min.y, max.x, max.y, pixels)?);
        }
        if let (Some(center), Some(width)) = (self.center, self.width) {
            return Ok(View::new(center, width, pixels)?);
        }
        if let Some(tip) = self.tip {
            let whole = View::fit(field.domain.bounds, pixels)?;
            let width = whole.width / self.zoom.unwrap_or(DEFAULT_ZOOM);
            return Ok(View::new(tip_position(field, tip)?, width, pixels)?);
        }
        let whole = if may_shrink { View::hug } else { View::fit };
        Ok(whole(field.domain.bounds, pixels)?)
    }
}

fn tip_position(field: &Field<'_>, number: usize) -> anyhow::Result<Vec2> {
    let cracks = &field.step.cracks;
    let n_tips = tips(cracks).count();
    ensure!(n_tips > 0, "--tip {number}: the dataset has no crack tips");
    let tip = tips(cracks).nth(number).with_context(|| {
        format!("--tip {number}: the dataset has {}, numbered from 0", count(n_tips, "tip", "tips"))
    })?;
    Ok(cracks[tip.crack as usize].end_point(tip.end))
}
