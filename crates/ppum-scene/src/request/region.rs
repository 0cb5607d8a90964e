//! The part of the plane that an image shows.

use ppum::crack::{TipId, tips};
use ppum::field::Field;
use ppum::text::trimmed;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_render::view::{View, ViewError};
use serde::{Deserialize, Serialize};

#[cfg(feature = "clap")]
use crate::request::arguments::positive;

/// A place of the plane: a box, a point with a width, or a tip; the whole domain if nothing
/// is given.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::Args))]
#[serde(default, deny_unknown_fields)]
pub struct ViewRegion {
    /// View by two opposite corners
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "X0,Y0,X1,Y1", value_parser = window, allow_hyphen_values = true),
        arg(conflicts_with_all = ["center", "tip"])
    )]
    pub view: Option<[f64; 4]>,
    /// Centre of the view
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "X,Y", value_parser = center, allow_hyphen_values = true),
        arg(requires = "width", conflicts_with = "tip")
    )]
    pub center: Option<[f64; 2]>,
    /// Width of the view, of which --center is the middle
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "W", requires = "center", value_parser = positive)
    )]
    pub width: Option<f64>,
    /// Centre the view at a crack tip, numbered from 0
    #[cfg_attr(feature = "clap", arg(long, value_name = "K"))]
    pub tip: Option<usize>,
    /// Magnification at --tip, relative to an image of the whole domain [default: 10]
    #[cfg_attr(
        feature = "clap",
        arg(long, value_name = "Z", requires = "tip", value_parser = positive)
    )]
    pub zoom: Option<f64>,
}

#[cfg(feature = "clap")]
fn window(text: &str) -> Result<[f64; 4], String> {
    crate::request::arguments::ends(text).map(|[a, b]| [a.x, a.y, b.x, b.y])
}

#[cfg(feature = "clap")]
fn center(text: &str) -> Result<[f64; 2], String> {
    crate::request::arguments::point(text).map(Into::into)
}

/// The pixels of an image, and the margin around the domain.
#[derive(Clone, Copy, Debug)]
pub struct ImageExtent {
    /// Columns and rows.
    pub pixels: [u32; 2],
    /// True if an image of the whole domain takes no more pixels than that has.
    pub may_shrink: bool,
    /// Room around the domain in an image of all of it, in parts of its larger side.
    pub margin: f64,
}

/// A place that there is not.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PlaceError {
    /// A tip of a number that no tip has.
    #[error("there is no tip {number}: {}", numbered(*count))]
    Tip {
        /// The number.
        number: usize,
        /// The number of tips.
        count: usize,
    },
    /// A view beside the domain.
    #[error("the view shows nothing of the domain")]
    Outside,
    /// A view beside the deformed body.
    #[error(
        "the view shows nothing of the deformed plate, which lies between ({}, {}) and ({}, {})",
        trimmed(.0.min.x), trimmed(.0.min.y), trimmed(.0.max.x), trimmed(.0.max.y)
    )]
    OutsideDeformed(Rect),
    /// The view.
    #[error(transparent)]
    View(#[from] ViewError),
}

fn numbered(count: usize) -> String {
    match count {
        0 => "the dataset has no crack tips".to_owned(),
        1 => "the dataset has 1 tip, numbered from 0".to_owned(),
        count => format!("the dataset has {count} tips, numbered from 0"),
    }
}

/// The tip of a number.
///
/// # Errors
/// A number that no tip has.
pub fn numbered_tip(field: &Field<'_>, number: usize) -> Result<TipId, PlaceError> {
    let mut all = tips(&field.step.cracks);
    all.nth(number)
        .ok_or_else(|| PlaceError::Tip { number, count: tips(&field.step.cracks).count() })
}

/// How much is enlarged around a tip if nothing is said.
const DEFAULT_ZOOM: f64 = 10.0;

impl ViewRegion {
    /// The part of the plane that a view shows.
    #[must_use]
    pub fn of(view: &View) -> Self {
        Self { center: Some(view.center.into()), width: Some(view.width), ..Self::default() }
    }

    /// True if one is asked for.
    #[must_use]
    pub fn is_given(&self) -> bool {
        self.view.is_some() || self.center.is_some() || self.tip.is_some()
    }

    fn window(&self) -> Option<Rect> {
        let [a, b] = self.view.map(|[x0, y0, x1, y1]| [vec2(x0, y0), vec2(x1, y1)])?;
        Some(Rect::new(a.min(b), a.max(b)))
    }

    /// Width over height of what is to be seen, of the whole image those of a box; none if it is
    /// whatever the image has room for.
    #[must_use]
    pub fn aspect(&self, whole: Rect) -> Option<f64> {
        if self.center.is_some() || self.tip.is_some() {
            return None;
        }
        let size = self.window().unwrap_or(whole).size();
        Some(size.x / size.y)
    }

    /// The view; of the whole image that of a box.
    ///
    /// # Errors
    /// A tip that there is not; a view without pixels, or too small.
    pub fn over(
        &self,
        whole: Rect,
        field: &Field<'_>,
        extent: ImageExtent,
    ) -> Result<View, PlaceError> {
        let ImageExtent { pixels, may_shrink, margin } = extent;
        if let Some(Rect { min, max }) = self.window() {
            return Ok(View::window(min.x, min.y, max.x, max.y, pixels)?);
        }
        if let (Some(center), Some(width)) = (self.center, self.width) {
            return Ok(View::new(center.into(), width, pixels)?);
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

    /// The point of the tip that is asked for.
    ///
    /// # Errors
    /// A tip that there is not.
    pub fn tip(&self, field: &Field<'_>) -> Result<Option<Vec2>, PlaceError> {
        let position = |number| {
            let tip = numbered_tip(field, number)?;
            Ok(field.step.cracks[tip.crack as usize].end_point(tip.end))
        };
        self.tip.map(position).transpose()
    }

    /// The view, which must show some of a box, that of the domain or of its whole.
    ///
    /// # Errors
    /// As [`Self::over`]; a view beside the box.
    pub fn seen(
        &self,
        whole: Rect,
        field: &Field<'_>,
        extent: ImageExtent,
    ) -> Result<View, PlaceError> {
        let view = self.over(whole, field, extent)?;
        view.rect().overlaps(&whole).then_some(view).ok_or(PlaceError::Outside)
    }
}
