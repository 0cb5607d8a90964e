//! The context that panels work on.

use crate::actions::{Action, Need, all};
use crate::player::Player;
use crate::session::{Pane, Session};
use crate::viewport::ViewState;

/// The session that is changed, and the viewports that show what has become of it.
pub struct PanelContext<'a> {
    /// The session.
    pub session: &'a mut Session,
    /// The viewports, one for each pane.
    pub viewports: &'a mut [ViewState],
    /// The player of the steps of a series.
    pub player: &'a mut Player,
    /// Files that are open, read and written.
    pub files: &'a mut crate::files::WindowFiles,
    /// The problem that is written and solved.
    pub solving: &'a mut crate::solving::SolverState,
    /// The actions to run when all panels were shown.
    pub actions: &'a mut Vec<Action>,
}

impl PanelContext<'_> {
    /// True if an action would do something to what is open.
    pub fn is_possible(&self, action: Action) -> bool {
        let viewport = &self.viewports[self.session.active];
        let steps = viewport.opened.as_ref().map_or(0, |opened| opened.dataset.steps.len());
        let need = all().find(|entry| entry.action == action).map_or(Need::Nothing, |e| e.need);
        match need {
            Need::Nothing => true,
            Need::Dataset => steps > 0,
            Need::Tips => {
                let number = if let Action::Tip(number) = action { number } else { 0 };
                number < viewport.tips(self.session.pane())
            }
            Need::Series => steps > 1,
            Need::Displacements => steps > 0 && !viewport.is_rigid(),
            Need::FreeViews => self.session.panes.len() > 1 && !self.session.minus.is_shown,
            Need::Text => self.session.draft.is_some(),
            Need::Solution => self.solving.running().is_some(),
        }
    }

    /// The active pane and its viewport.
    pub fn active(&mut self) -> (&mut Pane, &mut ViewState) {
        let active = self.session.active;
        (&mut self.session.panes[active], &mut self.viewports[active])
    }
}
