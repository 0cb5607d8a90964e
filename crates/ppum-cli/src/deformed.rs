//! Options that draw the deformed plate.

use anyhow::ensure;
use ppum::field::Field;
use ppum::text::trimmed;
use ppum::vec2::Rect;
use ppum_render::deform::{AutomaticFactor, Deformation, DeformedPoints, DeformedView};
use ppum_scene::deformed::{self, Factor, words};
use ppum_scene::drawing::{Drawn, Seen, Shown};

use crate::backend::Engine;
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
        match self.of(&|visit| visit(field))? {
            None => Ok(Seen::Plate(window.seen(field, frame)?)),
            Some(deforming) => points(&deforming.view(field, window, frame)?, engine),
        }
    }

    /// The factor, and the plane that pictures of all plates show that `each` calls its argument with, if they are
    /// asked for.
    pub(crate) fn of(&self, each: &Each<'_>) -> anyhow::Result<Option<Deforming>> {
        let Some(factor) = self.factor else { return Ok(None) };
        let factor = number(factor, each)?;
        let mut all: Option<Rect> = None;
        each(&mut |field| {
            let bounds = deformed::bounds(field, factor, self.outline)?;
            all = Some(all.map_or(bounds, |all| all.union(&bounds)));
            Ok(())
        })?;
        Ok(all.map(|bounds| Deforming { factor, bounds }))
    }
}

/// Calls what it is given with one field after the other.
pub(crate) type Each<'a> =
    dyn Fn(&mut dyn FnMut(&Field<'_>) -> anyhow::Result<()>) -> anyhow::Result<()> + 'a;

/// The number of a factor, which for `auto` follows from the displacements of all plates.
fn number(factor: Factor, each: &Each<'_>) -> anyhow::Result<f64> {
    if let Factor::Given(factor) = factor {
        return Ok(factor);
    }
    let mut found = AutomaticFactor::default();
    each(&mut |field| Ok(found.add(field, &field.domain.bounds)?))?;
    Ok(found.factor())
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
    Ok(engine.on_processor(|| deformed::draw(points, shown, &Bar::new()))??)
}
