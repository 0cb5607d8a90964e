//! Options that draw the deformed plate.

use std::str::FromStr;

use anyhow::ensure;
use ppum::field::Field;
use ppum::text::trimmed;
use ppum::vec2::{Rect, Vec2};
use ppum_render::deform::{Deformation, DeformedPoints, DeformedView, automatic_factor};
use ppum_render::raster::Raster;

use crate::backend::Engine;
use crate::drawing::{Drawn, PROCESSOR, Seen, Shown};
use crate::progress::Bar;
use crate::window::{Frame, Window};

/// How the plate is deformed.
#[derive(Debug, clap::Args)]
pub(crate) struct Deformed {
    /// Draw the plate with so many times its displacement; `auto` shows the largest as some 5 % of the
    /// plate
    #[arg(long = "deformed", value_name = "FACTOR|auto", allow_hyphen_values = true)]
    factor: Option<Factor>,
    /// Draw the border of the undeformed plate too, dashed
    #[arg(long, requires = "factor")]
    pub(crate) outline: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Factor {
    Auto,
    Given(f64),
}

impl FromStr for Factor {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        match text.trim() {
            "auto" => Ok(Self::Auto),
            number => match number.parse() {
                Ok(factor) if f64::is_finite(factor) => Ok(Self::Given(factor)),
                _ => Err("write a finite number, or auto"),
            },
        }
    }
}

impl Deformed {
    /// True if the deformed plate is asked for.
    pub(crate) fn is_given(&self) -> bool {
        self.factor.is_some()
    }

    /// What is seen of the plate, undeformed unless the other is asked for.
    pub(crate) fn seen<'f>(
        &self,
        field: &'f Field<'f>,
        window: &Window,
        frame: Frame,
        engine: &Engine,
    ) -> anyhow::Result<Seen<'f>> {
        match self.of(&[field])? {
            None => Ok(Seen::Plate(window.seen(field, frame)?)),
            Some(deforming) => points(&deforming.view(field, window, frame)?, engine),
        }
    }

    /// The factor, and the plane that pictures of all of these plates show, if they are asked for.
    pub(crate) fn of(&self, fields: &[&Field<'_>]) -> anyhow::Result<Option<Deforming>> {
        let (Some(factor), Some(first)) = (self.factor, fields.first()) else { return Ok(None) };
        let factor = match factor {
            Factor::Given(factor) => factor,
            Factor::Auto => automatic_factor(fields, &first.domain.bounds)?,
        };
        let bounds = |field: &&Field<'_>| self.bounds(&Deformation::new(field, factor)?, field);
        let bounds = fields.iter().map(bounds).collect::<anyhow::Result<Vec<_>>>()?;
        let bounds = bounds.into_iter().reduce(|a, b| a.union(&b));
        Ok(bounds.map(|bounds| Deforming { factor, bounds }))
    }

    /// A box around the deformed plate, and around the undeformed one if its border is drawn.
    fn bounds(&self, deformation: &Deformation<'_>, field: &Field<'_>) -> anyhow::Result<Rect> {
        let whole = field.domain.bounds;
        let view = ppum_render::view::View::fit(whole, [256, 256])?;
        let outline = deformation.seen(&view).outline();
        let place = |offset: &Vec2| view.center + *offset;
        let all = outline.iter().flatten().map(place).map(|p| Rect::new(p, p));
        let moved = all.reduce(|a, b| a.union(&b)).unwrap_or(whole);
        let shown = if self.outline { moved.union(&whole) } else { moved };
        let room = shown.size() * ROOM;
        Ok(Rect::new(shown.min - room, shown.max + room))
    }
}

/// How plates are deformed, one or those of a series.
pub(crate) struct Deforming {
    factor: f64,
    /// What of the plane is seen without a window.
    bounds: Rect,
}

impl Deforming {
    /// The factor as it is told: `deformed ×100`.
    pub(crate) fn words(&self) -> String {
        words(self.factor)
    }

    /// The view of a deformed plate. Windows are places of the deformed plane; that around a tip follows it.
    pub(crate) fn view<'f>(
        &self,
        field: &'f Field<'f>,
        window: &Window,
        frame: Frame,
    ) -> anyhow::Result<DeformedView<'f>> {
        let deformation = Deformation::new(field, self.factor)?;
        let bounds = self.bounds;
        let view = window.over(bounds, field, frame)?;
        if let Some(tip) = window.tip(field)? {
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

/// Room around the plate, in parts of its size: the outline is known to a tenth of a pixel of a small picture.
const ROOM: f64 = 0.01;

/// The factor as it is told: `deformed ×100`.
pub(crate) fn words(factor: f64) -> String {
    format!("deformed ×{}", trimmed(factor))
}

/// The points of the deformed plate that are seen.
pub(crate) fn points<'f>(view: &DeformedView<'f>, engine: &Engine) -> anyhow::Result<Seen<'f>> {
    Ok(Seen::Moved(engine.on_processor(|| view.points(&Bar::new()))??))
}

/// The values of a picture of the deformed plate.
pub(crate) fn draw(
    points: &DeformedPoints<'_>,
    shown: &Shown,
    engine: &Engine,
) -> anyhow::Result<Drawn> {
    let raster = engine.on_processor(|| match shown {
        Shown::Quantity(quantity) => points.raster(quantity, &Bar::new()),
        Shown::Cells(_, values) => Ok(points.cells(values)),
    })??;
    let without = undefined(points, &raster.values);
    let overlap = (0..).zip(&raster.overlap).filter(|(_, is)| **is).map(|(pixel, _)| pixel);
    let (view, overlap, by) = (points.view.view, overlap.collect(), PROCESSOR.into());
    let values = raster.values.into();
    Ok(Drawn { view, values, by, without, overlap, opacity: None })
}

/// The pixels of the plate without a value.
fn undefined(points: &DeformedPoints<'_>, values: &Raster) -> Vec<u32> {
    let [columns, rows] = values.size;
    let all = (0..rows).flat_map(|j| (0..columns).map(move |i| (i, j)));
    let without = all.filter(|&(i, j)| values.value(i, j).is_nan() && !points.at(i, j).is_empty());
    without.map(|(i, j)| j * columns + i).collect()
}
