//! The choices that a page offers of a dataset.

use ppum::crack::tips;
use ppum::field::Field;
use ppum::quantity::available;
use ppum::vec2::Rect;
use ppum_render::cells;
use ppum_render::colormap::NAMES;
use ppum_scene::error::ImageError;
use ppum_scene::quantity::{DisplayedQuantity, OF_PATCHES, default_quantity};

use super::Evaluator;
use crate::messages::{Description, PageChoice};

/// The name in lists that stands for the partition functions of all patches.
const ANY_PATCH: &str = "phi:N";

impl Evaluator<'_> {
    /// Describes the dataset, and one of its steps.
    ///
    /// # Errors
    /// No such step.
    pub fn describe(&self, step: usize) -> Result<Description, ImageError> {
        let dataset = self.dataset;
        let field = Field::new(dataset, step)?;
        let Rect { min, max } = dataset.domain.bounds;
        let cracks = &field.step.cracks;
        let end = |tip: ppum::crack::TipId| cracks[tip.crack as usize].end_point(tip.end).into();
        Ok(Description {
            title: dataset.title.clone(),
            bounds: [min.into(), max.into()],
            loads: dataset.steps.iter().map(|step| step.load).collect(),
            patches: field.step.partition.len(),
            quantities: quantities(&field),
            cells: cells_of(&field),
            quantity: default_quantity(&field).to_owned(),
            colormaps: NAMES.map(str::to_owned).to_vec(),
            tips: tips(cracks).map(end).collect(),
        })
    }
}

fn quantities(field: &Field<'_>) -> Vec<PageChoice> {
    let names = available(field).into_iter().filter(|name| name != ANY_PATCH);
    names
        .filter_map(|text| {
            let [label, unit] = DisplayedQuantity::parse(&text, field).ok()?.words(field);
            let label = if unit.is_empty() { label } else { format!("{label} [{unit}]") };
            Some(PageChoice { text, label })
        })
        .collect()
}

fn cells_of(field: &Field<'_>) -> Vec<PageChoice> {
    let choice = |name: String| PageChoice {
        label: cells::label(&name).to_owned(),
        text: format!("{OF_PATCHES}{name}"),
    };
    cells::names(field).into_iter().map(choice).collect()
}
