//! From a file to the first image.

use std::time::Instant;

use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_format::Series;
use ppum_render::view::View;
use serde::Serialize;

use crate::cards::BenchDevice;
use crate::frames::{DrawingDevice, QuantityRenderer, moved, style};
use crate::synthetic::{CrackRecipe, DOMAIN};

/// Times each is opened, of which the fastest counts; the file is in the system's memory.
const REPETITIONS: u32 = 3;

/// The time to open a dataset, in milliseconds.
#[derive(Debug, Serialize)]
pub(super) struct OpeningTime {
    pub(super) patches: usize,
    pub(super) bytes: u64,
    /// Reading and checking.
    pub(super) open_ms: f64,
    /// From opening to the first image by the CPU in f32.
    pub(super) first_ms: f64,
    /// Putting it on a graphics device.
    pub(super) upload_ms: Option<f64>,
}

impl OpeningTime {
    /// Measures the datasets of a small and a large cover.
    pub(super) fn all(
        quick: bool,
        pixels: [u32; 2],
        mut cards: Option<&mut BenchDevice>,
    ) -> anyhow::Result<Vec<Self>> {
        let levels: &[u8] = if quick { &[3, 4] } else { &[7, 10] };
        let one = |&level| {
            Self::new(&CrackRecipe::new(level, level).dataset()?, pixels, cards.as_deref_mut())
        };
        levels.iter().map(one).collect()
    }

    fn new(
        dataset: &Dataset,
        pixels: [u32; 2],
        mut cards: Option<&mut BenchDevice>,
    ) -> anyhow::Result<Self> {
        let folder = tempfile::tempdir()?;
        let path = folder.path().join("plate.h5");
        ppum_format::write(dataset, &path)?;
        let bytes = std::fs::metadata(&path)?.len();
        let patches = dataset.steps[0].partition.len();
        let (mut open_ms, mut first_ms, mut upload_ms) = (f64::INFINITY, f64::INFINITY, None);
        for frame in 0..REPETITIONS {
            let start = Instant::now();
            let since = || 1e3 * start.elapsed().as_secs_f64();
            let read = Series::open(&path)?.into_dataset(0)?;
            open_ms = since().min(open_ms);
            let field = Field::new(&read, 0)?;
            let quantity = Quantity::VonMises;
            let view = moved(View::fit(DOMAIN, pixels)?, frame)?;
            QuantityRenderer::new(&field, (quantity, style(1.0)), None, false)?.draw(
                DrawingDevice::CpuF32,
                &view,
                None,
            )?;
            first_ms = since().min(first_ms);
            if let Some(cards) = cards.as_deref_mut() {
                let start = Instant::now();
                cards.upload(&field)?;
                let ms = 1e3 * start.elapsed().as_secs_f64();
                upload_ms = Some(upload_ms.map_or(ms, |least: f64| least.min(ms)));
            }
        }
        Ok(Self { patches, bytes, open_ms, first_ms, upload_ms })
    }
}
