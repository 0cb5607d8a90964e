//! What resampling gives in a view.

use std::sync::Arc;
use std::time::Instant;

use ppum::progress::Watcher;
use ppum_render::picture::{Picture, Style};
use ppum_render::range::Range;
use ppum_render::raster::Raster;
use ppum_render::resample::norms::{Norms, difference};
use ppum_render::resample::{Samples, representation_bytes};
use ppum_render::view::View;
use ppum_scene::compare::{Compare, Resampled, signed};
use ppum_scene::drawing::{Drawn, RasterValues};

use super::memo::{Memo, Same};
use super::paint::Painted;
use super::subject::{FrameSubject, SubjectView};
use super::{Failure, Fault};

/// What resampling gives in a view, beside the direct picture.
#[derive(Debug)]
pub struct Other {
    /// The way of resampling.
    pub compare: Compare,
    /// What was resampled, in the colours of the direct picture.
    pub picture: Arc<Painted>,
    /// The difference, resampled − direct: blue, white, red.
    pub difference: Arc<Painted>,
    /// The errors over the pixels of the view.
    pub norms: Norms,
    /// Memory of the samples.
    pub bytes: u64,
    /// Memory of what the field is evaluated from.
    pub direct_bytes: u64,
    /// What sampling and drawing took \[s\].
    pub seconds: [f64; 2],
}

/// Resamples, and keeps what the last comparison was made of.
#[derive(Default)]
pub(super) struct Resampling {
    pub(super) samples: Memo<(FrameSubject, u32), Sampled>,
    found: Memo<(Same<Drawn>, Compare), ResampledFrame>,
    pub(super) others: Memo<(Same<Painted>, Compare), Arc<Other>>,
}

type Sampled = (Arc<Samples>, f64);

/// The values, their difference from the direct ones, and the seconds that they took.
type ResampledFrame = (Arc<Resampled>, Arc<Painted>, f64);

impl Resampling {
    /// What one way of resampling gives.
    pub(super) fn compare(
        &mut self,
        compare: Compare,
        target: &SubjectView,
        (drawn, picture, style): (&Arc<Drawn>, &Arc<Painted>, &Style),
        watcher: &dyn Watcher,
    ) -> Result<Arc<Other>, Failure> {
        let key = (Same::of(picture), compare);
        if let Some(known) = self.others.get(&key) {
            return Ok(known);
        }
        let (samples, sampling) = self.sample(compare, &target.subject, watcher)?;
        let found = || find(compare, &samples, drawn);
        let (resampled, apart, drawing) = self.found.get_or((Same::of(drawn), compare), found)?;
        let painted = in_colors_of(picture, style, &resampled.raster, &drawn.view)?;
        let other = Arc::new(Other {
            compare,
            picture: Arc::new(painted),
            difference: apart,
            norms: resampled.norms,
            bytes: resampled.bytes,
            direct_bytes: representation_bytes(target.subject.field.0.field()),
            seconds: [sampling, drawing],
        });
        self.others.set(key, Arc::clone(&other));
        Ok(other)
    }

    /// Samples over the whole plate, which serve any view and method.
    fn sample(
        &mut self,
        compare: Compare,
        subject: &FrameSubject,
        watcher: &dyn Watcher,
    ) -> Result<Sampled, Failure> {
        let Some(quantity) = subject.shown.0.quantity() else { return Err(refused(OF_CELLS)) };
        if subject.factor.is_some() {
            return Err(refused(DEFORMED));
        }
        if subject.minus.is_some() {
            return Err(refused(MINUS));
        }
        let field = subject.field.0.field();
        self.samples.get_or((subject.clone(), compare.grid), || {
            let start = Instant::now();
            let grid = compare.grid_over(field).map_err(Failure::at(Fault::Compare))?;
            let samples =
                grid.sample(field, quantity, watcher).map_err(Failure::at(Fault::Compare))?;
            Ok((Arc::new(samples), start.elapsed().as_secs_f64()))
        })
    }
}

const OF_CELLS: &str = "values of cells are not resampled; choose a quantity to compare";
const DEFORMED: &str = "the deformed plate is not resampled; compare without the deformation";
const MINUS: &str = "the difference of two views is not resampled; compare each of them";

fn refused(message: &str) -> Failure {
    Failure::new(Fault::Compare, message)
}

fn find(compare: Compare, samples: &Samples, drawn: &Drawn) -> Result<ResampledFrame, Failure> {
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
    let resampled = Resampled::on_grid(samples, compare.method, view, direct);
    let seconds = start.elapsed().as_secs_f64();
    let apart = signed(&difference(direct, &resampled.raster), view);
    let apart = apart.map_err(Failure::at(Fault::Compare))?;
    Ok((Arc::new(resampled), Arc::new(Painted::new(apart)), seconds))
}

/// Values in the colours of a picture.
fn in_colors_of(
    picture: &Picture,
    style: &Style,
    raster: &Raster,
    view: &View,
) -> Result<Painted, Failure> {
    let norm = &picture.normalization;
    let fixed = Style { range: Range::Fixed(norm.min(), norm.max()), ..style.clone() };
    let painted = Picture::bare(raster, view, &fixed).map(Painted::new);
    painted.map_err(Failure::at(Fault::Compare))
}
