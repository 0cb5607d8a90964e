//! The solution that another one has replaced: undo shows it again, redo the other one.

use std::sync::Arc;

use ppum::dataset::Dataset;

use crate::app::Viewer;
use crate::player;
use crate::session::Session;
use crate::viewport::OpenDataset;

/// Two solutions of which a view shows one.
#[derive(Debug)]
pub(super) struct ReplacedSolution {
    pane: usize,
    hidden: OpenDataset,
    shown: Arc<Dataset>,
    /// The settings when they were exchanged: later changes are undone first.
    settings: Session,
    /// True once undo has shown the older one again.
    is_undone: bool,
}

impl Viewer {
    /// Shows a new solution in a view. One that no file has is kept if it goes for that.
    pub(super) fn replace_solution(&mut self, pane: usize, new: OpenDataset) {
        let is_lost = self.is_unsaved(pane) && !self.is_twice(pane);
        let shown = Arc::clone(&new.dataset);
        if let Some(hidden) = self.put(pane, new).filter(|_| is_lost) {
            let settings = self.session.settings();
            let one = ReplacedSolution { pane, hidden, shown, settings, is_undone: false };
            self.replaced_solution = Some(one);
        }
    }

    /// Shows a dataset in a view; returns the one before. The place is kept if both bodies have it.
    fn put(&mut self, number: usize, opened: OpenDataset) -> Option<OpenDataset> {
        let (pane, viewport) = (&mut self.session.panes[number], &mut self.viewports[number]);
        let before = viewport.opened.clone();
        pane.file.clone_from(&opened.path);
        // what was a series may be one step now
        let _ = player::mend(pane, &opened.dataset);
        viewport.take(pane, opened);
        before
    }

    /// Exchanges two solutions if that is the last change; true if it was.
    pub(super) fn exchange_solutions(&mut self, back: bool) -> bool {
        let settings = self.session.settings();
        let is_last =
            |one: &mut ReplacedSolution| one.is_undone != back && one.settings == settings;
        let Some(one) = self.replaced_solution.take_if(is_last) else { return false };
        let ReplacedSolution { pane, hidden, shown, .. } = one;
        let is_shown = |opened: &OpenDataset| Arc::ptr_eq(&opened.dataset, &shown);
        if !self.opened(pane).is_some_and(is_shown) {
            return false;
        }
        let shown = Arc::clone(&hidden.dataset);
        let Some(hidden) = self.put(pane, hidden) else { return false };
        let settings = self.session.settings();
        let one = ReplacedSolution { pane, hidden, shown, settings, is_undone: back };
        self.replaced_solution = Some(one);
        self.viewports[pane].tell(if back { UNDONE } else { REDONE });
        true
    }

    /// The newer solution while the older one is shown again.
    pub(super) fn undone_solution(&self) -> Option<&OpenDataset> {
        let one = self.replaced_solution.as_ref().filter(|one| one.is_undone);
        one.map(|one| &one.hidden)
    }

    /// The hidden solution, to be told its file.
    pub(super) fn hidden_solution(&mut self) -> Option<&mut OpenDataset> {
        self.replaced_solution.as_mut().map(|one| &mut one.hidden)
    }
}

const UNDONE: &str = "The solution before is shown again; redo shows the newer one";
const REDONE: &str = "The newer solution is shown again";
