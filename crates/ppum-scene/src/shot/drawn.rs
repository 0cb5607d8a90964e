//! An image that was drawn, its page and the texts of its file.

use ppum::crack::Crack;
use ppum::formula::one_line;
use ppum::quantity::Quantity;
use ppum_figure::canvas::Canvas;
use ppum_figure::figure::{FigureError, FigureStyle, Labels, Panel};
use ppum_figure::figure::{bare, figure, lacks_legend, plot_area};
use ppum_figure::overlay::LegendEntry;
use ppum_render::picture::ColoredRaster;
use ppum_render::png::TextChunk;

use crate::drawing::DisplayedQuantity;
use crate::engine::Engine;
use crate::layers::Layers;
use crate::notice::Notice;

/// An image with what lies over it.
#[derive(Debug)]
pub struct RenderedImage {
    /// The displayed quantity.
    pub shown: DisplayedQuantity,
    /// Its name.
    pub name: String,
    /// The colours.
    pub picture: ColoredRaster,
    /// The layers over them.
    pub layers: Layers,
    /// The cracks where they are seen.
    pub cracks: Vec<Crack>,
    /// The device that computed the values.
    pub by: String,
    /// The number of pixels where the deformed body lies over itself.
    pub overlaps: usize,
    /// The edges at which the body is mirrored, if it is.
    pub mirrored: Option<String>,
    /// How many times its displacement the body is drawn with, if it is deformed.
    pub factor: Option<f64>,
    /// The title of the dataset, and of a series the number of the step and its load.
    pub(super) dataset: (String, Option<(usize, f64)>),
}

impl RenderedImage {
    /// The panel of a figure with it.
    #[must_use]
    pub fn panel(&self, labels: Labels) -> Panel<'_> {
        let (layers, legend) = (self.layers.items.clone(), self.layers.legend.clone());
        let (picture, cracks) = (&self.picture, &self.cracks);
        Panel { picture, layers, legend, labels, cracks, bar_of: None }
    }

    /// Its page: a figure of a design, or bare without one.
    ///
    /// # Errors
    /// A design without room.
    pub fn page(
        &self,
        labels: Labels,
        design: Option<&FigureStyle>,
        engine: &Engine<'_>,
    ) -> Result<Canvas, FigureError> {
        let panel = self.panel(labels);
        let Some(design) = design else {
            tell_legend(&panel.legend, engine);
            return Ok(bare(panel.picture, panel.layers));
        };
        if lacks_legend(&panel, plot_area(&panel.labels.title, design)?, design) {
            tell_legend(&panel.legend, engine);
        }
        figure(panel, design)
    }

    /// The texts of a file with it, which shows something of some name.
    pub(crate) fn description(&self, file: &str, name: &str) -> Vec<TextChunk> {
        let mut texts = self.picture.description(&self.dataset.0, file, name);
        texts.push(("ppum:backend".to_owned(), self.by.clone()));
        texts
    }

    /// The texts of its file: what it shows, of which dataset, and what drew it.
    #[must_use]
    pub fn texts(&self, file: &str) -> Vec<TextChunk> {
        let mut texts = self.description(file, &self.name);
        if let DisplayedQuantity::Quantity(Quantity::Formula(formula)) = &self.shown {
            texts.push(("ppum:formula".to_owned(), one_line(formula.formula().text())));
        }
        texts
    }

    /// Returns the factor of deformation and the step of a series as further texts of the file.
    #[must_use]
    pub fn notes(&self) -> Vec<TextChunk> {
        let factor = self.factor.map(|factor| ("ppum:deformed".to_owned(), format!("{factor:?}")));
        let step = self.dataset.1.map(|(step, load)| {
            [
                ("ppum:step".to_owned(), step.to_string()),
                ("ppum:load".to_owned(), format!("{load:?}")),
            ]
        });
        let mirrored = self.mirrored.clone().map(|edges| ("ppum:mirror".to_owned(), edges));
        factor.into_iter().chain(mirrored).chain(step.into_iter().flatten()).collect()
    }
}

/// Tells what a legend says that is nowhere drawn.
pub fn tell_legend(legend: &[LegendEntry], engine: &Engine<'_>) {
    if !legend.is_empty() {
        let entries = legend.iter().map(|entry| entry.label.clone()).collect();
        engine.tell(Notice::NoLegend(entries));
    }
}
