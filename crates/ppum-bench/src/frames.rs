//! Frames of a field by all that draws them, and what they take.

use std::hint::black_box;
use std::time::Instant;

use cpu_time::ProcessTime;
use ppum::field::Field;
use ppum::progress::unwatched;
use ppum::quantity::Quantity;
use ppum::vec2::vec2;
use ppum_gpu::Method;
use ppum_render::picture::{ColoredRaster, Style};
use ppum_render::range::RangeChoice;
use ppum_render::raster::{Raster, RasterValue};
use ppum_render::scatter::render;
use ppum_render::view::View;
use serde::Serialize;

use crate::cards::{BenchDevice, CardPrograms};

/// The device that draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum DrawingDevice {
    Splat,
    Gather,
    CpuF64,
    CpuF32,
}

pub(crate) const WAYS: [DrawingDevice; 4] =
    [DrawingDevice::Splat, DrawingDevice::Gather, DrawingDevice::CpuF64, DrawingDevice::CpuF32];

/// Most patches that are splatted: the paper's.
const MOST_SPLATTED: usize = 16384;

impl DrawingDevice {
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Splat => "splat",
            Self::Gather => "gather",
            Self::CpuF64 => "cpu f64",
            Self::CpuF32 => "cpu f32",
        }
    }

    pub(crate) fn is_on_cpu(self) -> bool {
        matches!(self, Self::CpuF64 | Self::CpuF32)
    }

    /// The way of a device.
    fn method(self) -> Option<Method> {
        match self {
            Self::Splat => Some(Method::Splat),
            Self::Gather => Some(Method::Gather),
            Self::CpuF64 | Self::CpuF32 => None,
        }
    }
}

/// Colours of von Mises' stress; that far from the crack is of size one, and grows with the root of
/// the zoom towards a tip.
pub(crate) fn style(zoom: f64) -> Style {
    Style { range: RangeChoice::Fixed(0.0, 4.0 * zoom.sqrt()), ..Style::default() }
}

/// A view except for a part of a cell, another one each time: offsets by the golden ratio and its
/// like are commensurate with no cells.
pub(crate) fn moved(View { center, width, pixels }: View, frame: u32) -> anyhow::Result<View> {
    let part = |ratio: f64| 0.003 * width * ((f64::from(frame) * ratio).fract() - 0.5);
    let by = vec2(part(0.618_033_988_75), part(0.754_877_666_25));
    Ok(View::new(center + by, 0.9973 * width, pixels)?)
}

/// A quantity of a field with all that draws it.
pub(crate) struct QuantityRenderer<'d> {
    pub(crate) field: &'d Field<'d>,
    pub(crate) quantity: Quantity,
    style: Style,
    card: Option<CardPrograms<'d>>,
}

impl<'d> QuantityRenderer<'d> {
    /// On the devices too if they are given, and there by splatting if it may and patches are not
    /// too many.
    pub(crate) fn new(
        field: &'d Field<'d>,
        (quantity, style): (Quantity, Style),
        cards: Option<&mut BenchDevice>,
        may_splat: bool,
    ) -> anyhow::Result<Self> {
        let may_splat = may_splat && field.step.partition.len() <= MOST_SPLATTED;
        let on_card = |cards| CardPrograms::new(cards, field, (&quantity, &style), may_splat);
        let card = cards.map(on_card).transpose()?;
        Ok(Self { field, quantity, style, card })
    }

    /// Draws and colours; false if this way is not gone.
    pub(crate) fn draw(
        &mut self,
        way: DrawingDevice,
        view: &View,
        cards: Option<&mut BenchDevice>,
    ) -> anyhow::Result<bool> {
        match way {
            DrawingDevice::CpuF64 => self.on_cpu::<f64>(view)?,
            DrawingDevice::CpuF32 => self.on_cpu::<f32>(view)?,
            _ => {
                let all = way.method().zip(self.card.as_mut()).zip(cards);
                let Some(((method, card), cards)) = all else { return Ok(false) };
                return card.draw(cards, method, view);
            }
        }
        Ok(true)
    }

    fn on_cpu<T: RasterValue>(&self, view: &View) -> anyhow::Result<()> {
        let raster = render::<T>(self.field, view, &self.quantity, unwatched())?;
        self.color(&raster, view)
    }

    /// The colours alone.
    pub(crate) fn color<T: RasterValue>(
        &self,
        raster: &Raster<T>,
        view: &View,
    ) -> anyhow::Result<()> {
        black_box(ColoredRaster::bare(raster, view, &self.style)?);
        Ok(())
    }

    /// The values, if this way is gone.
    pub(crate) fn values(
        &self,
        way: DrawingDevice,
        view: &View,
        cards: Option<&mut BenchDevice>,
    ) -> anyhow::Result<Option<Vec<f64>>> {
        let wide = |values: Vec<f32>| values.into_iter().map(f64::from).collect();
        let (field, quantity) = (self.field, &self.quantity);
        Ok(match way {
            DrawingDevice::CpuF64 => {
                Some(render::<f64>(field, view, quantity, unwatched())?.values)
            }
            DrawingDevice::CpuF32 => {
                Some(wide(render::<f32>(field, view, quantity, unwatched())?.values))
            }
            _ => {
                let all = way.method().zip(self.card.as_ref()).zip(cards);
                let Some(((method, card), cards)) = all else { return Ok(None) };
                card.values(cards, method, (view, quantity))?.map(|raster| wide(raster.values))
            }
        })
    }
}

/// Seconds of some frames: time that passes, and of processors.
#[derive(Debug, Default)]
pub(crate) struct Times(Vec<[f64; 2]>);

/// Milliseconds a frame.
#[derive(Clone, Copy, Debug, Serialize)]
pub(crate) struct FrameTimes {
    pub(crate) median: f64,
    pub(crate) least: f64,
}

impl Times {
    /// Does work, and notes what it takes if it `counts` and was done.
    pub(crate) fn take(
        &mut self,
        counts: bool,
        work: impl FnOnce() -> anyhow::Result<bool>,
    ) -> anyhow::Result<()> {
        let (wall, core) = (Instant::now(), ProcessTime::now());
        if work()? && counts {
            self.0.push([wall.elapsed(), core.elapsed()].map(|time| time.as_secs_f64()));
        }
        Ok(())
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    pub(crate) fn wall(&self) -> FrameTimes {
        self.summary(0)
    }

    /// Sums over all threads.
    pub(crate) fn core(&self) -> FrameTimes {
        self.summary(1)
    }

    fn summary(&self, which: usize) -> FrameTimes {
        let mut ms: Vec<_> = self.0.iter().map(|pair| 1e3 * pair[which]).collect();
        ms.sort_by(f64::total_cmp);
        let (lower, upper) = (ms[(ms.len() - 1) / 2], ms[ms.len() / 2]);
        FrameTimes { median: 0.5 * (lower + upper), least: ms[0] }
    }
}
