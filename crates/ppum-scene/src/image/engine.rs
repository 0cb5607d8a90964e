//! Computation of the values of an image by the processor, in either precision, or by a graphics
//! card.
//!
//! Whatever computes them gives a raster; ranges, colours, overlays and figures are made of it by
//! the same code. Graphics cards are behind a function, so that programs without them need
//! no drivers.

use std::sync::{Mutex, PoisonError};

use ppum::field::Field;
use ppum::progress::{Watcher, unwatched};
use ppum::quantity::{Quantity, Source};
use ppum_figure::canvas::Canvas;
use ppum_figure::form::PageFormat;
use ppum_render::RasterError;
use ppum_render::raster::{Raster, RasterValue};
use ppum_render::samples::{Samples, means};
use ppum_render::scatter::render;

use super::error::{CardError, ImageError, ImageErrorKind};
use super::notice::Notice;
use super::values::{DrawingInput, PROCESSOR, PixelValues, RasterValues, single_precision_warning};
use crate::request::backend::{Backend, Precision};

/// Draws the means of so many samples a pixel on a device that a backend may take.
pub type DrawOnCard =
    fn(DrawingInput<'_>, Samples, Backend, &dyn Watcher) -> Result<PixelValues, CardError>;

/// The card of a program that was built without.
fn no_card(
    _: DrawingInput<'_>,
    _: Samples,
    _: Backend,
    _: &dyn Watcher,
) -> Result<PixelValues, CardError> {
    let reason = "no graphics adapter: this program was built without graphics cards; leave the backend out, or use `--backend cpu`";
    Err(CardError { message: reason.to_owned(), is_normal: true })
}

impl Backend {
    /// True for graphics devices alone.
    fn is_device(self) -> bool {
        matches!(self, Self::Gpu | Self::Splat)
    }

    /// True for what no graphics device draws, and by `auto` for what it does not draw well.
    #[must_use]
    pub fn needs_processor(self, field: &Field<'_>, quantity: &Quantity) -> bool {
        quantity.source() == Source::Exact
            || field.step.partition.mesh().is_some()
            || self == Self::Auto && single_precision_warning(field.step).is_some()
    }
}

/// Computes values as they are asked for, and collects what is to be said of the image.
pub struct Engine<'a> {
    backend: Backend,
    precision: Option<Precision>,
    card: DrawOnCard,
    /// Hears of the progress, and may stop it.
    pub watcher: &'a dyn Watcher,
    notices: Mutex<Vec<Notice>>,
}

impl Default for Engine<'_> {
    fn default() -> Self {
        Self::processor(unwatched())
    }
}

impl<'a> Engine<'a> {
    /// An engine of a backend, which draws by `card` if that is given.
    ///
    /// # Errors
    /// Double precision on a device.
    pub fn new(
        backend: Backend,
        precision: Option<Precision>,
        card: Option<DrawOnCard>,
        watcher: &'a dyn Watcher,
    ) -> Result<Self, ImageError> {
        if backend.is_device() && precision == Some(Precision::F64) {
            return Err(ImageErrorKind::Double.into());
        }
        let (card, notices) = (card.unwrap_or(no_card), Mutex::default());
        Ok(Self { backend, precision, card, watcher, notices })
    }

    /// The processor in double precision.
    #[must_use]
    pub fn processor(watcher: &'a dyn Watcher) -> Self {
        let notices = Mutex::default();
        Self { backend: Backend::Cpu, precision: None, card: no_card, watcher, notices }
    }

    /// Draws the means of so many samples a pixel; falls back to the processor where that
    /// is allowed.
    ///
    /// # Errors
    /// A quantity that the field does not have; a device that fails; a watcher that stops it.
    pub fn draw(&self, job: DrawingInput<'_>, samples: Samples) -> Result<PixelValues, ImageError> {
        let drawn = self.drawn(job, samples)?;
        if let (RasterValues::Single(_), Some(text)) =
            (&drawn.values, single_precision_warning(job.field.step))
        {
            self.tell(Notice::SinglePrecision(text));
        }
        Ok(drawn)
    }

    fn drawn(&self, job: DrawingInput<'_>, samples: Samples) -> Result<PixelValues, ImageError> {
        let on_card = || (self.card)(job, samples, self.backend, self.watcher);
        let is_mesh = job.field.step.partition.mesh().is_some();
        match self.backend {
            backend if backend.is_device() && !is_mesh => return Ok(on_card()?),
            Backend::Gpu | Backend::Splat => self.tell(Notice::Mesh),
            Backend::Auto if !self.needs_processor(job) => match on_card() {
                Ok(values) => return Ok(values),
                Err(error) if error.is_normal => {}
                Err(error) => self.tell(Notice::NoCard(error.message)),
            },
            Backend::Auto | Backend::Cpu => {}
        }
        Ok(self.on_processor(job, samples)?)
    }

    /// True for what no graphics device can do, or not well.
    fn needs_processor(&self, job: DrawingInput<'_>) -> bool {
        // who asks for single precision has it
        let backend = if self.precision.is_none() { Backend::Auto } else { Backend::Gpu };
        self.precision == Some(Precision::F64) || backend.needs_processor(job.field, job.quantity)
    }

    fn on_processor(
        &self,
        job: DrawingInput<'_>,
        samples: Samples,
    ) -> Result<PixelValues, RasterError> {
        match self.precision {
            Some(Precision::F32) => computed::<f32>(job, samples, "cpu f32", self.watcher),
            _ => computed::<f64>(job, samples, PROCESSOR, self.watcher),
        }
    }

    /// Refuses to draw the deformed body, which only the processor can, in double precision, by
    /// anything else.
    ///
    /// # Errors
    /// A device, or single precision.
    pub fn check_deformed(&self) -> Result<(), ImageError> {
        if self.backend.is_device() || self.precision == Some(Precision::F32) {
            return Err(ImageErrorKind::DeformedOnDevice.into());
        }
        Ok(())
    }

    /// Adds something that is to be said of the images, once for all of them.
    pub fn tell(&self, notice: Notice) {
        let mut notices = self.notices.lock().unwrap_or_else(PoisonError::into_inner);
        if !notices.contains(&notice) {
            notices.push(notice);
        }
    }

    /// Tells that something has no value at some pixels of the body, of so many.
    pub fn tell_undefined(&self, name: &str, counts: [usize; 2], is_of_cells: bool) {
        match counts {
            [_, 0] => self.tell(Notice::OffPlate),
            [0, _] => {}
            _ => self.tell(Notice::Undefined { name: name.to_owned(), counts, is_of_cells }),
        }
    }

    /// Tells of characters of a page that the font of figures lacks, in a file of some form.
    pub fn tell_glyphs(&self, page: &Canvas, form: PageFormat) {
        Notice::of_glyphs(page, form).into_iter().for_each(|notice| self.tell(notice));
    }

    /// All that is to be said of the images that were drawn, in the order in which it came up.
    pub fn into_notices(self) -> Vec<Notice> {
        self.notices.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

fn computed<T: RasterValue>(
    job: DrawingInput<'_>,
    samples: Samples,
    by: &str,
    watcher: &dyn Watcher,
) -> Result<PixelValues, RasterError>
where
    RasterValues: From<Raster<T>>,
{
    let DrawingInput { field, view, quantity } = job;
    if samples != Samples::CENTER {
        return Ok(PixelValues::averaged(
            means::<T>(field, view, quantity, samples, watcher)?,
            job,
            by,
        ));
    }
    Ok(PixelValues::new(render::<T>(field, view, quantity, watcher)?, field, view, by))
}
