//! The state of the panels of one view while it is open, as far as it is not part of the session:
//! texts that are being written, lists that are open, work in the background, a factor that swings.

pub mod choices;
pub mod deformation_animation;
pub mod facts;
pub mod range;
pub mod step_range;
pub mod whole;

use std::collections::BTreeMap;
use std::sync::Weak;

use ppum::dataset::Dataset;
use ppum_figure::plot::Plot;
use ppum_render::range::RangeChoice;
use ppum_scene::magnification::Magnification;
use ppum_scene::overlays::{IsolineLevels, Overlay, Overlays};
use ppum_scene::scene::SceneRequest;

use crate::frames::{PaneFrames, RenderedFrame};
use crate::memo::Memo;
use crate::same_arc::SameArc;
use crate::session::Pane;
use crate::widgets::chooser::Chooser;
use crate::widgets::editor::Editor;
use choices::FieldChoices;
use deformation_animation::DeformationAnimation;
use facts::Facts;
use step_range::StepRange;
use whole::{RangeSearch, Whole};

/// Plots over the steps, with their names.
type StepPlots = Vec<(&'static str, Plot)>;

/// The state of the panels of one view.
#[derive(Default)]
pub struct Controls {
    /// The list of quantities.
    pub quantities: Chooser,
    /// The list of colour maps.
    pub maps: Chooser,
    /// Texts that are written, by what they are of.
    pub editors: BTreeMap<String, Editor>,
    /// The content of the dataset.
    pub facts: Facts,
    /// The quantities of its field.
    pub known: FieldChoices,
    /// The range of the whole body, while it is looked for.
    pub whole: Option<Whole>,
    /// The range of all steps, while one looks through a series.
    pub step_range: StepRange,
    /// The reason why a range was refused.
    pub refused: Option<String>,
    /// Levels of isolines that are written.
    pub levels: LevelsDraft,
    /// The factor of the deformation, while it swings.
    pub swing: Option<DeformationAnimation>,
    /// The overlays that were there before all were hidden.
    pub hidden: Option<Overlays>,
    /// True while the next click on the view chooses a patch.
    pub is_picking: bool,
    /// The panel that is to be opened.
    pub panel_to_open: Option<&'static str>,
    /// The description of the colours of an image.
    pub color_note: Option<(Weak<RenderedFrame>, String)>,
    /// Values over the steps of a dataset, with the names of their plots.
    pub histories: Memo<SameArc<Dataset>, StepPlots>,
    /// True if the page *Series* shows a table, not curves.
    pub has_step_table: bool,
    /// The automatic factor of the deformation, once it is known.
    pub factor: Option<f64>,
}

/// Levels of isolines while they are written, and perhaps not yet understood.
#[derive(Clone, Debug, Default)]
pub struct LevelsDraft {
    pub(crate) text: String,
    pub(crate) base: Option<IsolineLevels>,
    pub(crate) mistake: Option<String>,
}

impl Controls {
    /// Goes on with all that goes on by itself: what is known, the range of the body, the factor
    /// that swings.
    pub fn advance(&mut self, ctx: &egui::Context, pane: &mut Pane, frames: &PaneFrames) {
        if let Some(frame) = frames.newest() {
            self.known.look_up(&frame.field);
            if frame.request.scene.deformed == Some(Magnification::Auto) {
                self.factor = frame.factor;
            }
        }
        match self.whole.as_mut().map(Whole::advance) {
            None | Some(RangeSearch::Working) => {}
            Some(RangeSearch::Found(range)) => {
                (pane.scene.colors.range, self.whole) = (range, None)
            }
            Some(RangeSearch::Failed(reason)) => (self.refused, self.whole) = (Some(reason), None),
        }
        // the next factor is for when this one has been seen
        let wanted = self.drawn(&pane.scene).deformed;
        let is_seen = frames.newest().is_some_and(|frame| frame.request.scene.deformed == wanted);
        if let Some(swing) = self.swing.as_mut().filter(|_| is_seen) {
            swing.go_on(ctx.input(|input| input.time));
            ctx.request_repaint();
        }
    }

    /// Returns the scene that is drawn: with its factor during an animation, and the overlays that
    /// exist then.
    #[must_use]
    pub fn drawn(&self, scene: &SceneRequest) -> SceneRequest {
        let mut scene = self.ranged(scene);
        if let (Some(swing), Some(factor)) = (&self.swing, &mut scene.deformed) {
            let whole = match *factor {
                Magnification::Given(whole) => Some(whole),
                Magnification::Auto => self.factor,
            };
            *factor = whole.map_or(*factor, |whole| swing.of(whole));
        }
        scene
    }

    /// Returns the scene at rest: of a series with the range of all its steps, if that is found.
    #[must_use]
    pub fn ranged(&self, scene: &SceneRequest) -> SceneRequest {
        let mut scene = scene.drawn();
        let range = &mut scene.colors.range;
        *range = self.step_range.range().filter(|_| *range == RangeChoice::Auto).unwrap_or(*range);
        scene
    }

    /// Hides all overlays, or shows those that were there before.
    pub fn toggle_overlays(&mut self, overlays: &mut Overlays) {
        if *overlays == Overlays::default() {
            let has_cracks = self.facts.without.iter().all(|(other, _)| *other != Overlay::Cracks);
            let first = if has_cracks { Overlay::Cracks } else { Overlay::Cells };
            let usual = || Overlays { shown: vec![first], ..Overlays::default() };
            *overlays = self.hidden.take().unwrap_or_else(usual);
        } else {
            self.hidden = Some(std::mem::take(overlays));
        }
    }

    /// The text that is written of something.
    pub fn editor(&mut self, of: &str) -> &mut Editor {
        self.editors.entry(of.to_owned()).or_default()
    }
}
