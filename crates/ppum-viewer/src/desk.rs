//! What panels work on.

use crate::actions::Action;
use crate::player::Player;
use crate::session::{Pane, Session};
use crate::stage::Stage;

/// The session that is changed, and the stages that show what has become of it.
pub struct Desk<'a> {
    /// What is chosen.
    pub session: &'a mut Session,
    /// The stages, one for each pane.
    pub stages: &'a mut [Stage],
    /// What plays the steps of a series.
    pub player: &'a mut Player,
    /// Files that are open, read and written.
    pub files: &'a mut crate::files::Files,
    /// The problem that is written and solved.
    pub solving: &'a mut crate::solving::Solving,
    /// What is to be done when all panels were shown.
    pub actions: &'a mut Vec<Action>,
}

impl Desk<'_> {
    /// The active pane and its stage.
    pub fn active(&mut self) -> (&mut Pane, &mut Stage) {
        let active = self.session.active;
        (&mut self.session.panes[active], &mut self.stages[active])
    }
}
