//! All that draws a field, frame by frame in turns, and what frames take.

use ppum_render::raster::Raster;
use ppum_render::view::View;
use rayon::ThreadPool;
use serde::Serialize;

use super::agreement::Agreement;
use crate::cards::BenchDevice;
use crate::frames::{DrawingDevice, FrameTimes, QuantityRenderer, Times, WAYS};

/// The frames of a scene by one way.
#[derive(Debug, Serialize)]
pub(super) struct FrameTiming {
    pub(super) method: &'static str,
    /// On one thread, of what the CPU draws.
    pub(super) one: Option<Spent>,
    /// On all threads; none if there is one only.
    pub(super) all: Option<Spent>,
    /// How many times faster all threads are, by medians of time that passes.
    pub(super) gain: Option<f64>,
    pub(super) agreement: Option<Agreement>,
}

#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Spent {
    pub(super) wall_ms: FrameTimes,
    /// Processor time of all threads; not of hardware, which has other processors.
    pub(super) core_ms: Option<FrameTimes>,
}

impl Spent {
    /// Processor time where there is one, else time that passes.
    pub(super) fn core(self) -> FrameTimes {
        self.core_ms.unwrap_or(self.wall_ms)
    }
}

impl FrameTiming {
    pub(super) fn is_good(&self) -> bool {
        self.agreement.is_none_or(|agreement| agreement.is_good())
    }
}

/// One thread, and all of them if there are more.
pub(super) struct Pools {
    one: ThreadPool,
    all: Option<ThreadPool>,
}

impl Pools {
    pub(super) fn new(threads: usize) -> anyhow::Result<Self> {
        let pool = |n| rayon::ThreadPoolBuilder::new().num_threads(n).build();
        Ok(Self { one: pool(1)?, all: (threads > 1).then(|| pool(threads)).transpose()? })
    }

    /// The one that is fastest.
    pub(super) fn most(&self) -> &ThreadPool {
        self.all.as_ref().unwrap_or(&self.one)
    }
}

/// A field with all that draws it, and what its frames take.
pub(super) struct Turns<'d> {
    pub(super) subject: QuantityRenderer<'d>,
    /// The rasters that are coloured, where nothing else is drawn.
    pub(super) rasters: Option<(Raster<f64>, Raster<f32>)>,
    one: [Times; 4],
    all: [Times; 4],
}

impl<'d> Turns<'d> {
    pub(super) fn new(subject: QuantityRenderer<'d>) -> Self {
        Self { subject, rasters: None, one: Default::default(), all: Default::default() }
    }

    /// Draws a view by each way, on one thread and on all.
    pub(super) fn draw_all(
        &mut self,
        view: &View,
        pools: &Pools,
        mut cards: Option<&mut BenchDevice>,
        counts: bool,
    ) -> anyhow::Result<()> {
        let Self { subject, rasters, one, all } = self;
        for (k, way) in WAYS.into_iter().enumerate() {
            if !way.is_on_cpu() {
                all[k].take(counts, || subject.draw(way, view, cards.as_deref_mut()))?;
                continue;
            }
            let mut draw = || on_cpu(subject, rasters.as_ref(), way, view);
            one[k].take(counts, || pools.one.install(&mut draw))?;
            if let Some(pool) = &pools.all {
                all[k].take(counts, || pool.install(&mut draw))?;
            }
        }
        Ok(())
    }

    /// Returns the times of each way; `has_core` if the processor time of devices counts.
    pub(super) fn timed(
        &self,
        has_core: bool,
        agreements: &[Option<Agreement>; 4],
    ) -> Vec<FrameTiming> {
        let timed = |k: usize| {
            let has_core = WAYS[k].is_on_cpu() || has_core;
            let spent = |times: &Times| {
                let core_ms = || has_core.then(|| times.core());
                (!times.is_empty()).then(|| Spent { wall_ms: times.wall(), core_ms: core_ms() })
            };
            let (one, all) = (spent(&self.one[k]), spent(&self.all[k]));
            let gain = one.zip(all).map(|(one, all)| one.wall_ms.median / all.wall_ms.median);
            one.or(all)?;
            Some(FrameTiming { method: WAYS[k].name(), one, all, gain, agreement: agreements[k] })
        };
        (0..WAYS.len()).filter_map(timed).collect()
    }
}

/// Draws, or colours alone.
fn on_cpu(
    subject: &mut QuantityRenderer<'_>,
    rasters: Option<&(Raster<f64>, Raster<f32>)>,
    way: DrawingDevice,
    view: &View,
) -> anyhow::Result<bool> {
    match rasters {
        None => return subject.draw(way, view, None),
        Some((wide, _)) if way == DrawingDevice::CpuF64 => subject.color(wide, view)?,
        Some((_, narrow)) => subject.color(narrow, view)?,
    }
    Ok(true)
}
