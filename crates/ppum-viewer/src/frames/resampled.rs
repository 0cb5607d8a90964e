//! Resampling in a view.

use std::sync::Arc;
use std::time::Instant;

use ppum::progress::Watcher;
use ppum_render::picture::{ColoredRaster, Style};
use ppum_render::range::RangeChoice;
use ppum_render::raster::Raster;
use ppum_render::resample::norms::{DifferenceNorms, difference};
use ppum_render::resample::{GridSamples, representation_bytes};
use ppum_render::view::View;
use ppum_scene::compare::{Compare, ResampledImage, signed};
use ppum_scene::values::{PixelValues, RasterValues};

use super::paint::ColoredImage;
use super::subject::{FrameSubject, SubjectView};
use super::{FaultOrigin, ImageFailure};
use crate::memo::Memo;
use crate::same_arc::SameArc;

/// The resampled image in a view, beside the direct one.
#[derive(Debug)]
pub struct ResampledView {
    /// The way of resampling.
    pub compare: Compare,
    /// The resampled image, in the colours of the direct one.
    pub picture: Arc<ColoredImage>,
    /// The difference, resampled − direct: blue, white, red.
    pub difference: Arc<ColoredImage>,
    /// The errors over the pixels of the view.
    pub norms: DifferenceNorms,
    /// Memory of the samples.
    pub bytes: u64,
    /// Memory of what the field is evaluated from.
    pub direct_bytes: u64,
    /// The time of sampling and drawing \[s\].
    pub seconds: [f64; 2],
}

/// Resamples, and keeps what the last comparison was made of.
#[derive(Default)]
pub(super) struct Resampler {
    pub(super) samples: Memo<(FrameSubject, u32), SamplesInTime>,
    found: Memo<(SameArc<PixelValues>, Compare), ResampledFrame>,
}

type SamplesInTime = (Arc<GridSamples>, f64);

/// The values, their difference from the direct ones, and the seconds that they took.
type ResampledFrame = (Arc<ResampledImage>, Arc<ColoredImage>, f64);

impl Resampler {
    /// Resamples in one way.
    pub(super) fn compare(
        &mut self,
        compare: Compare,
        target: &SubjectView,
        (drawn, picture, style): (&Arc<PixelValues>, &Arc<ColoredImage>, &Style),
        watcher: &dyn Watcher,
    ) -> Result<Arc<ResampledView>, ImageFailure> {
        let (samples, sampling) = self.sample(compare, &target.subject, watcher)?;
        let found = || find(compare, &samples, drawn);
        let (resampled, apart, drawing) = self.found.get_or((drawn.into(), compare), found)?;
        let painted = in_colors_of(picture, style, &resampled.raster, &drawn.view)?;
        Ok(Arc::new(ResampledView {
            compare,
            picture: Arc::new(painted),
            difference: apart,
            norms: resampled.norms,
            bytes: resampled.bytes,
            direct_bytes: representation_bytes(target.subject.field.field()),
            seconds: [sampling, drawing],
        }))
    }

    /// Samples over the whole body, which serve any view and method.
    fn sample(
        &mut self,
        compare: Compare,
        subject: &FrameSubject,
        watcher: &dyn Watcher,
    ) -> Result<SamplesInTime, ImageFailure> {
        let Some(quantity) = subject.shown.quantity() else { return Err(refused(OF_CELLS)) };
        if subject.factor.is_some() {
            return Err(refused(DEFORMED));
        }
        if subject.left.is_some() {
            return Err(refused(MINUS));
        }
        let field = subject.field.field();
        self.samples.get_or((subject.clone(), compare.grid), || {
            let start = Instant::now();
            let grid = compare.grid_over(field).map_err(ImageFailure::at(FaultOrigin::Compare))?;
            let samples = grid
                .sample(field, quantity, watcher)
                .map_err(ImageFailure::at(FaultOrigin::Compare))?;
            Ok((Arc::new(samples), start.elapsed().as_secs_f64()))
        })
    }
}

const OF_CELLS: &str = "values of cells are not resampled; choose a quantity to compare";
const DEFORMED: &str = "the deformed plate is not resampled; compare without the deformation";
const MINUS: &str = "the difference of two views is not resampled; compare each of them";

fn refused(message: &str) -> ImageFailure {
    ImageFailure::new(FaultOrigin::Compare, message)
}

fn find(
    compare: Compare,
    samples: &GridSamples,
    drawn: &PixelValues,
) -> Result<ResampledFrame, ImageFailure> {
    let (start, view) = (Instant::now(), &drawn.view);
    let narrow;
    let direct = match &drawn.values {
        RasterValues::Double(raster) => raster,
        RasterValues::Single(raster) => {
            let wide = raster.values.iter().map(|&value| f64::from(value)).collect();
            narrow = Raster::new(raster.size, wide);
            &narrow
        }
    };
    let resampled = ResampledImage::on_grid(samples, compare.method, view, direct);
    let seconds = start.elapsed().as_secs_f64();
    let apart = signed(&difference(direct, &resampled.raster), view);
    let apart = apart.map_err(ImageFailure::at(FaultOrigin::Compare))?;
    Ok((Arc::new(resampled), Arc::new(ColoredImage::new(apart)), seconds))
}

/// Values in the colours of an image.
fn in_colors_of(
    picture: &ColoredRaster,
    style: &Style,
    raster: &Raster,
    view: &View,
) -> Result<ColoredImage, ImageFailure> {
    let norm = &picture.normalization;
    let fixed = Style { range: RangeChoice::Fixed(norm.min(), norm.max()), ..style.clone() };
    let painted = ColoredRaster::bare(raster, view, &fixed).map(ColoredImage::new);
    painted.map_err(ImageFailure::at(FaultOrigin::Compare))
}
