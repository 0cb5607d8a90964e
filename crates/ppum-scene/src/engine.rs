//! Computation of the values of an image by the processor, in either precision, or by a graphics
//! card.
//!
//! Whatever computes them gives a raster; ranges, colours, overlays and figures are made of it by
//! the same code. Graphics cards are behind a function, so that programs without them need
//! no drivers.

use std::fmt;
use std::str::FromStr;
use std::sync::{Mutex, PoisonError};

use ppum::field::Field;
use ppum::progress::{Watcher, unwatched};
use ppum::quantity::{Quantity, Source};
use ppum_render::RasterError;
use ppum_render::raster::{Raster, RasterValue};
use ppum_render::samples::{Samples, means};
use ppum_render::scatter::render;
use serde::{Deserialize, Serialize};

use crate::drawing::{
    DrawingInput, PROCESSOR, PixelValues, RasterValues, single_precision_warning,
};
use crate::notice::Notice;

/// The backend that computes the values.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
pub enum Backend {
    /// A graphics card if there is one and it can, else the CPU
    #[default]
    Auto,
    /// This machine's processor
    Cpu,
    /// Any graphics device, a software one too: one pass that gathers
    Gpu,
    /// Splatting in the three passes of Üffinger et al. 2011, to compare
    Splat,
}

impl Backend {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Auto, Self::Cpu, Self::Gpu, Self::Splat];

    /// True for what no graphics device draws, and by `auto` for what it does not draw well.
    #[must_use]
    pub fn needs_processor(self, field: &Field<'_>, quantity: &Quantity) -> bool {
        quantity.source() == Source::Exact
            || field.step.partition.mesh().is_some()
            || self == Self::Auto && single_precision_warning(field.step).is_some()
    }
}

impl fmt::Display for Backend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Auto => "auto",
            Self::Cpu => "cpu",
            Self::Gpu => "gpu",
            Self::Splat => "splat",
        })
    }
}

impl FromStr for Backend {
    type Err = &'static str;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let known = Self::ALL.into_iter().find(|backend| backend.to_string() == text);
        known.ok_or("write auto, cpu, gpu or splat")
    }
}

/// The precision of the computation.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[serde(rename_all = "lowercase")]
#[expect(missing_docs, reason = "the names say all, and clap would show more")]
pub enum Precision {
    F64,
    F32,
}

/// The devices that may draw.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Device {
    /// Graphics cards alone.
    Hardware,
    /// Those that compute in software too.
    Any,
}

/// The way a device draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DeviceMethod {
    /// One pass that gathers.
    Gather,
    /// Three passes that splat.
    Splat,
}

/// A device that fails.
#[derive(Debug, thiserror::Error)]
#[error("{message}")]
pub struct CardError {
    /// The reason.
    pub message: String,
    /// True if there is no device, as is normal, or if the processor will say the same.
    pub is_normal: bool,
}

/// Draws the means of so many samples a pixel on a device.
pub type DrawOnCard = fn(
    DrawingInput<'_>,
    Samples,
    Device,
    DeviceMethod,
    &dyn Watcher,
) -> Result<PixelValues, CardError>;

/// The card of a program that was built without.
fn no_card(
    _: DrawingInput<'_>,
    _: Samples,
    _: Device,
    _: DeviceMethod,
    _: &dyn Watcher,
) -> Result<PixelValues, CardError> {
    let reason = "no graphics adapter: this program was built without graphics cards; leave the backend out, or use `--backend cpu`";
    Err(CardError { message: reason.to_owned(), is_normal: true })
}

/// The reason why there are no values.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EngineError {
    /// Double precision on a device.
    #[error(
        "graphics devices compute in single precision; use backend cpu, or leave precision out"
    )]
    Double,
    /// The deformed body on a device, or in single precision.
    #[error(
        "the deformed plate is drawn by the processor, in double precision; leave backend and precision out"
    )]
    Deformed,
    /// The device.
    #[error(transparent)]
    Card(#[from] CardError),
    /// The quantity, or a watcher that stopped it.
    #[error(transparent)]
    Render(#[from] RasterError),
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
    ) -> Result<Self, EngineError> {
        let is_device = matches!(backend, Backend::Gpu | Backend::Splat);
        if is_device && precision == Some(Precision::F64) {
            return Err(EngineError::Double);
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
    pub fn draw(
        &self,
        job: DrawingInput<'_>,
        samples: Samples,
    ) -> Result<PixelValues, EngineError> {
        let drawn = self.drawn(job, samples)?;
        if let (RasterValues::Single(_), Some(text)) =
            (&drawn.values, single_precision_warning(job.field.step))
        {
            self.tell(Notice::SinglePrecision(text));
        }
        Ok(drawn)
    }

    fn drawn(&self, job: DrawingInput<'_>, samples: Samples) -> Result<PixelValues, EngineError> {
        let on = |device, method| (self.card)(job, samples, device, method, self.watcher);
        let is_mesh = job.field.step.partition.mesh().is_some();
        match self.backend {
            Backend::Gpu | Backend::Splat if is_mesh => {
                self.tell(Notice::Mesh);
                Ok(self.on_processor(job, samples)?)
            }
            Backend::Cpu => Ok(self.on_processor(job, samples)?),
            Backend::Gpu => Ok(on(Device::Any, DeviceMethod::Gather)?),
            Backend::Splat => Ok(on(Device::Any, DeviceMethod::Splat)?),
            Backend::Auto if self.needs_processor(job) => Ok(self.on_processor(job, samples)?),
            Backend::Auto => on(Device::Hardware, DeviceMethod::Gather).or_else(|error| {
                if !error.is_normal {
                    self.tell(Notice::NoCard(error.message));
                }
                Ok(self.on_processor(job, samples)?)
            }),
        }
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
    pub fn check_deformed(&self) -> Result<(), EngineError> {
        let is_device = matches!(self.backend, Backend::Gpu | Backend::Splat);
        let is_single = self.precision == Some(Precision::F32);
        if is_device || is_single { Err(EngineError::Deformed) } else { Ok(()) }
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
