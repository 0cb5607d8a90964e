//! The context that panels work on.

use crate::actions::Action;
use crate::player::Player;
use crate::session::{Pane, Session};
use crate::stage::ViewPane;

/// The session that is changed, and the stages that show what has become of it.
pub struct PanelContext<'a> {
    /// The session.
    pub session: &'a mut Session,
    /// The stages, one for each pane.
    pub stages: &'a mut [ViewPane],
    /// The player of the steps of a series.
    pub player: &'a mut Player,
    /// Files that are open, read and written.
    pub files: &'a mut crate::files::WindowFiles,
    /// The problem that is written and solved.
    pub solving: &'a mut crate::solving::SolverPane,
    /// The actions to run when all panels were shown.
    pub actions: &'a mut Vec<Action>,
}

impl PanelContext<'_> {
    /// The active pane and its stage.
    pub fn active(&mut self) -> (&mut Pane, &mut ViewPane) {
        let active = self.session.active;
        (&mut self.session.panes[active], &mut self.stages[active])
    }
}
