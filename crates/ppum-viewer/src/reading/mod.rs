//! Reading values: at points, along curves, on circles around tips.
//!
//! What is chosen (probes, a curve) stands in the [`Pane`]. What has become of it is here: values
//! at the pointer and at the probes, evaluated exactly and at once, and what is found in the
//! background along curves.

pub mod integral;
pub mod output;
pub mod plotted;
pub mod probe;
pub mod question;
pub mod tool;
pub mod words;

use std::sync::Arc;

use crate::frames::Frame;
use crate::session::Pane;
use output::Output;
use plotted::{Asked, CurveValues, Plotted};
use ppum_scene::profile::Along;
use ppum_scene::spot::Spot;
use probe::{Probed, Reader};
use question::Question;
use tool::{Grip, Tool};

/// What is read of one view.
#[derive(Default)]
pub struct Reading {
    /// What is read at the pointer; nothing where that is not over the plate.
    pub hover: Option<Probed>,
    /// What is read at the probes, in their order.
    pub probes: Vec<Probed>,
    /// The probe that was clicked last.
    pub selected: Option<usize>,
    /// The point of the curve that belongs to the place of the pointer in the plot.
    pub marked: Option<Spot>,
    /// What the next drag over the plate draws, or clicks do.
    pub tool: Option<Tool>,
    /// The handle that is dragged.
    pub(crate) grip: Option<Grip>,
    /// True from the beginning of a new curve to its end.
    pub(crate) is_new: bool,
    /// True once a curve was drawn that is to be plotted.
    pub(crate) wants_plot: bool,
    /// Why the numbers of a curve were refused.
    pub refused: Option<String>,
    /// Values along the curve.
    pub plot: Question<Asked, CurveValues>,
    /// The last values along a curve that could be found.
    pub good: Option<(Along, Arc<Plotted>)>,
    /// K on the circle.
    pub integral: integral::Integral,
    /// Where files go.
    pub output: Output,
    reader: Option<Reader>,
    read: Option<(Arc<Frame>, Vec<Spot>)>,
}

impl Reading {
    /// What reads the values of a picture.
    pub fn reader(&mut self, frame: &Frame) -> &Reader {
        if self.reader.as_ref().is_none_or(|reader| !reader.is_of(frame)) {
            self.reader = None;
        }
        self.reader.get_or_insert_with(|| Reader::new(frame))
    }

    /// Forgets what was read: there is no picture of what is open.
    pub fn forget(&mut self) {
        (self.hover, self.read) = (None, None);
        self.probes.clear();
    }

    /// Reads all probes anew if they or the picture have changed.
    pub fn refresh(&mut self, frame: &Arc<Frame>, pane: &Pane) {
        let is_known = self
            .read
            .as_ref()
            .is_some_and(|(known, spots)| Arc::ptr_eq(known, frame) && *spots == pane.probes);
        if is_known {
            return;
        }
        let reader = self.reader(frame);
        self.probes = pane.probes.iter().map(|spot| reader.read(spot)).collect();
        self.read = Some((Arc::clone(frame), pane.probes.clone()));
        self.selected = self.selected.filter(|k| *k < pane.probes.len());
    }

    /// True while something is on its way.
    #[must_use]
    pub fn is_working(&self) -> bool {
        self.integral.is_working() || self.plot.is_working()
    }
}
