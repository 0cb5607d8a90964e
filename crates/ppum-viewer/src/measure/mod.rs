//! Reading values: at points, along curves, on circles around tips.
//!
//! The user's choices (probes, a curve) are in the [`Pane`]. The results are here: values at the
//! pointer and at the probes, evaluated exactly and at once, and what is found in the background
//! along curves.

pub mod integral;
pub mod plot_request;
pub mod probe;
pub mod tool;
pub mod words;

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::frames::RenderedFrame;
use crate::query::BackgroundQuery;
use crate::same_arc::SameArc;
use crate::save_target::SaveTarget;
use crate::session::Pane;
use plot_request::{CurveValues, PlotRequest, PlotResult};
use ppum_scene::location::Location;
use ppum_scene::profile::ProfileCurve;
use probe::{ProbeReading, QuantityReader};
use tool::{CurveHandle, Tool};

/// The readings of one view.
#[derive(Default)]
pub struct MeasuringTools {
    /// The reading at the pointer; nothing where that is not over the body.
    pub hover: Option<ProbeReading>,
    /// The readings at the probes, in their order.
    pub probes: Vec<ProbeReading>,
    /// The probe that was clicked last.
    pub selected: Option<usize>,
    /// The point of the curve that belongs to the place of the pointer in the plot.
    pub marked: Option<Location>,
    /// The effect of the next drag over the view, or of clicks.
    pub tool: Option<Tool>,
    /// The handle that is dragged.
    pub(crate) grip: Option<CurveHandle>,
    /// True from the beginning of a new curve to its end.
    pub(crate) is_new: bool,
    /// True once a curve was drawn that is to be plotted.
    pub(crate) wants_plot: bool,
    /// Why the numbers of a curve were refused.
    pub refused: Option<String>,
    /// Values along the curve.
    pub plot: BackgroundQuery<PlotRequest, CurveValues>,
    /// The last values along a curve that could be found.
    pub good: Option<(ProfileCurve, Arc<PlotResult>)>,
    /// K on the circle.
    pub integral: integral::CircleIntegral,
    /// The files of tables and plots, by what they hold.
    pub targets: BTreeMap<&'static str, SaveTarget>,
    reader: Option<QuantityReader>,
    read: Option<(SameArc<RenderedFrame>, Vec<Location>)>,
}

impl MeasuringTools {
    /// Returns the reader of the values of an image.
    pub fn reader(&mut self, frame: &RenderedFrame) -> &QuantityReader {
        if self.reader.as_ref().is_none_or(|reader| !reader.is_of(frame)) {
            self.reader = None;
        }
        self.reader.get_or_insert_with(|| QuantityReader::new(frame))
    }

    /// Forgets what was read: there is no image of what is open.
    pub fn forget(&mut self) {
        (self.hover, self.read) = (None, None);
        self.probes.clear();
    }

    /// Reads all probes again if they or the image have changed.
    pub fn refresh(&mut self, frame: &Arc<RenderedFrame>, pane: &Pane) {
        let key = (SameArc::from(frame), pane.probes.clone());
        if self.read.as_ref() == Some(&key) {
            return;
        }
        let reader = self.reader(frame);
        self.probes = pane.probes.iter().map(|spot| reader.read(spot)).collect();
        self.read = Some(key);
        self.selected = self.selected.filter(|k| *k < pane.probes.len());
    }

    /// True while something is on its way.
    #[must_use]
    pub fn is_working(&self) -> bool {
        self.integral.is_working() || self.plot.is_working()
    }
}
