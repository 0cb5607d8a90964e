//! Direct drawing beside what resampling gives: its images, its errors, and the memory and time
//! of each.

use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum_render::RasterError;
use ppum_render::picture::{ColoredRaster, Style};
use ppum_render::range::{ColorRange, RangeChoice, RangeError};
use ppum_render::raster::Raster;
use ppum_render::resample::need::{ConvergenceObstacle, GridNeed};
use ppum_render::resample::norms::{DifferenceNorms, norms};
use ppum_render::resample::{GridError, GridSamples, Interpolation, SampleGrid, cells};
use ppum_render::scale::Scale;
use ppum_render::view::View;
use serde::{Deserialize, Serialize};

use crate::request::written;

/// A way of resampling, over the whole body.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(default)]
pub struct Compare {
    /// How values between the points are found.
    #[serde(with = "written")]
    pub method: Interpolation,
    /// Columns of points, and rows of them.
    pub grid: u32,
}

impl Compare {
    /// Fewest and most columns of the window's grids.
    pub const GRIDS: [u32; 2] = [16, 4096];

    /// The grid over a field's domain.
    ///
    /// # Errors
    /// As [`SampleGrid::new`].
    pub fn grid_over(&self, field: &Field<'_>) -> Result<SampleGrid, GridError> {
        SampleGrid::over_domain(field, [self.grid; 2])
    }
}

impl Default for Compare {
    fn default() -> Self {
        Self { method: Interpolation::Bilinear, grid: 64 }
    }
}

/// An image that was interpolated from few values.
#[derive(Clone, Debug)]
pub struct ResampledImage {
    /// `None` for the cells of the cover.
    pub interpolation: Option<Interpolation>,
    /// Points of the grid, if there is one.
    pub grid: Option<[u32; 2]>,
    /// Memory of the values that it was made of.
    pub bytes: u64,
    /// The values at the pixels.
    pub raster: Raster,
    /// How far they are from the field.
    pub norms: DifferenceNorms,
}

impl ResampledImage {
    /// Interpolates samples at the pixels where the direct image has its values.
    #[must_use]
    pub fn on_grid(
        samples: &GridSamples,
        interpolation: Interpolation,
        view: &View,
        direct: &Raster,
    ) -> Self {
        let raster = samples.raster(interpolation, view);
        let (grid, norms) = (samples.grid, norms(direct, &raster));
        let (interpolation, size) = (Some(interpolation), Some(grid.size));
        Self { interpolation, grid: size, bytes: grid.bytes(), norms, raster }
    }

    /// Gives each cell of the cover one value.
    ///
    /// # Errors
    /// As for [`cells`].
    pub fn on_cells(
        field: &Field<'_>,
        quantity: &Quantity,
        view: &View,
        direct: &Raster,
        watcher: &dyn Watcher,
    ) -> Result<Self, RasterError> {
        let raster = cells(field, view, quantity, watcher)?;
        let (bytes, norms) = (8 * field.step.partition.len() as u64, norms(direct, &raster));
        Ok(Self { interpolation: None, grid: None, bytes, norms, raster })
    }
}

/// The words for the grid that an error needs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeededGrid {
    /// `measured`, `extrapolated` or `none`.
    pub kind: &'static str,
    /// Its columns and rows; whole numbers, but of extrapolated ones larger than any grid.
    pub size: Option<[f64; 2]>,
    /// `singular`, `jump` or `stalled`, where there is none.
    pub reason: Option<&'static str>,
}

impl NeededGrid {
    /// The words for what was found.
    #[must_use]
    pub fn new(needed: GridNeed) -> Self {
        let never = |reason| ("none", None, Some(reason));
        let (kind, size, reason) = match needed {
            GridNeed::Grid(size) => ("measured", Some(size.map(f64::from)), None),
            GridNeed::Extrapolated(size) => ("extrapolated", Some(size.map(f64::round)), None),
            GridNeed::Never(ConvergenceObstacle::Singular) => never("singular"),
            GridNeed::Never(ConvergenceObstacle::Jump) => never("jump"),
            GridNeed::Never(ConvergenceObstacle::Stalled) => never("stalled"),
        };
        Self { kind, size, reason }
    }
}

/// The image of a difference, with a range of both signs also where all differences have one: no
/// difference is white.
///
/// # Errors
/// As [`ColoredRaster::spanning`].
pub fn signed(apart: &Raster, view: &View) -> Result<ColoredRaster, RangeError> {
    let style = Style { scale: Scale::Linear, ..difference_style() };
    let found = RangeChoice::Auto.span(style.scale, true, apart, None);
    let size = found.max.max(-found.min);
    let span = ColorRange { min: -size, max: size, ..found };
    ColoredRaster::spanning(apart, view, &style, span)
}

/// Blue, white, red.
fn difference_style() -> Style {
    Style::named("coolwarm").expect("coolwarm is built in")
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::Vec2;

    #[test]
    fn no_difference_is_in_the_middle_of_the_colours() {
        let view = View::new(Vec2::ZERO, 1.0, [20, 10]).unwrap();
        for (from, step) in [(-5.0, 0.01), (3.0, 0.1), (-1.0, 0.03), (0.0, 0.0), (2.0, 0.0)] {
            let apart = Raster::from_fn(view.pixels, |i, j| from + step * f64::from(i * 10 + j));
            let norm = signed(&apart, &view).unwrap().normalization;
            assert!(norm.min() == -norm.max() && norm.max() > 0.0, "{from} {step}: {norm:?}");
        }
    }

    #[test]
    fn a_comparison_is_written_as_it_is_read() {
        let compare = Compare { method: Interpolation::Bicubic, grid: 512 };
        let text = serde_json::to_string(&compare).unwrap();
        assert_eq!(text, r#"{"method":"bicubic","grid":512}"#);
        assert_eq!(serde_json::from_str::<Compare>(&text).unwrap(), compare);
    }
}
