//! Frames of a dataset's last step.

use std::path::Path;

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_format::Series;
use ppum_render::view::View;
use serde::Serialize;

use super::report::pixels_of;
use super::tables::methods;
use super::turns::{FrameTiming, Pools, Turns};
use crate::Report;
use crate::cards::BenchDevice;
use crate::frames::{QuantityRenderer, moved, style};
use crate::machine::Machine;
use crate::table::ReportTable;

/// The report of `ppum-bench frames`.
#[derive(Debug, Serialize)]
pub struct Single {
    machine: Machine,
    pixels: [u32; 2],
    frames: u32,
    patches: usize,
    methods: Vec<FrameTiming>,
}

impl Single {
    /// Measures von Mises' stress or the first component; `quick` takes small images.
    ///
    /// # Errors
    /// A file that cannot be read, or a field that cannot be drawn.
    pub fn new(path: &Path, quick: bool, frames: u32) -> anyhow::Result<Self> {
        let (threads, pixels) = (rayon::current_num_threads(), pixels_of(quick));
        let mut cards = BenchDevice::open();
        let machine = Machine::new(threads, cards.as_ref());
        let mut cards = cards.as_mut().ok();
        let series = Series::open(path)?;
        let last = series.len() - 1;
        let dataset = series.into_dataset(last)?;
        let field = Field::new(&dataset, last)?;
        let is_elastic = field.equation.elastic().is_some();
        let name = if is_elastic { "von-mises" } else { field.data.components[0].as_str() };
        let look = (Quantity::parse(name, &field)?, style(1.0));
        let subject = QuantityRenderer::new(&field, look, cards.as_deref_mut(), true)?;
        let (mut turns, pools) = (Turns::new(subject), Pools::new(threads)?);
        for frame in 0..=frames {
            let view = moved(View::fit(field.domain.bounds, pixels)?, frame)?;
            turns.draw_all(&view, &pools, cards.as_deref_mut(), frame > 0)?;
        }
        let has_core = cards.is_none_or(|cards| cards.is_software());
        let methods = turns.timed(has_core, &[None; 4]);
        Ok(Self { machine, pixels, frames, patches: field.step.partition.len(), methods })
    }
}

impl Report for Single {
    fn words(&self) -> String {
        let Self { machine, pixels: [columns, rows], frames, patches, .. } = self;
        let machine = machine.words();
        format!(
            "{machine}\nimages of {columns}x{rows} pixels, {patches} patches\n\
             milliseconds a frame, least / median of {frames} frames\n"
        )
    }

    fn tables(&self) -> Vec<ReportTable> {
        vec![methods(&self.methods)]
    }
}
