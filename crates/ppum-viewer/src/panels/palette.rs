//! Actions found by their names.

use egui::{Align2, Button, Ui, Window};

use crate::actions::{Action, ActionEntry, all, spelled};
use crate::widgets::chooser::{Chooser, ChooserItem};

/// The list of the actions that fit a text.
#[derive(Clone, Debug)]
pub struct CommandPalette(Chooser);

impl Default for CommandPalette {
    fn default() -> Self {
        let mut list = Chooser::default();
        list.open_alone();
        Self(list)
    }
}

impl CommandPalette {
    /// Shows it, with the actions that are possible; true once it is done, with the action that was
    /// chosen, if any.
    pub fn show(
        &mut self,
        ui: &Ui,
        is_possible: impl Fn(Action) -> bool,
    ) -> (bool, Option<Action>) {
        let found = matching_actions(self.0.text());
        let item = |entry: &&ActionEntry| ChooserItem {
            value: entry.name.to_owned(),
            about: entry.shortcut().map(|key| spelled(ui.ctx(), &key)).unwrap_or_default(),
            group: "",
        };
        let possible = found.iter().filter(|entry| is_possible(entry.action));
        let items: Vec<ChooserItem> = possible.map(item).collect();
        let items: Vec<&ChooserItem> = items.iter().collect();
        let row = |ui: &mut Ui, item: &ChooserItem, is_at: bool| {
            ui.add(Button::selectable(is_at, &item.value).shortcut_text(&item.about))
        };
        let words = [TITLE, "Nothing of this name can be done now."];
        let window = Window::new(TITLE).anchor(Align2::CENTER_TOP, [0.0, 60.0]);
        let shown = window.collapsible(false).resizable(false).show(ui.ctx(), |ui| {
            ui.set_width(360.0);
            self.0.show_found(ui, words, "", &items, row)
        });
        let chosen = shown.and_then(|shown| shown.inner?);
        let entry = chosen.and_then(|name| all().find(|entry| entry.name == name));
        (!self.0.is_open(), entry.map(|entry| entry.action))
    }
}

const TITLE: &str = "Find an action";

/// The actions whose names, or other words for them, have all words of a text; those of that
/// name first.
fn matching_actions(text: &str) -> Vec<&'static ActionEntry> {
    let text = text.to_lowercase();
    let has_all = |words: &str| text.split_whitespace().all(|word| words.contains(word));
    let is_named = |entry: &&ActionEntry| has_all(&entry.name.to_lowercase());
    let is_meant = |entry: &&ActionEntry| {
        has_all(&format!("{} {}", entry.name.to_lowercase(), entry.synonyms))
    };
    let (mut all, others): (Vec<_>, Vec<_>) = all().filter(is_meant).partition(is_named);
    all.extend(others);
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::export::ExportChoice;
    use crate::session::DrawerPage;

    /// Words that newcomers type lead to the actions that they want.
    #[test]
    fn people_find_what_they_call_otherwise() {
        for (words, action) in [
            ("SIF", Action::CircleForK),
            ("stress intensity", Action::Drawer(DrawerPage::Tips)),
            ("K1", Action::Drawer(DrawerPage::Tips)),
            ("pdf", Action::Save(ExportChoice::Figure)),
            ("export", Action::Save(ExportChoice::Image)),
            ("gif", Action::Save(ExportChoice::Steps)),
            ("film", Action::Save(ExportChoice::Deformation)),
            ("opening", Action::Drawer(DrawerPage::Plot)),
            ("profile", Action::Drawer(DrawerPage::Plot)),
            ("open", Action::Drawer(DrawerPage::Plot)),
            ("jump", Action::Drawer(DrawerPage::Plot)),
            ("quit", Action::Quit),
            ("html", Action::ExportPage),
            ("export page", Action::ExportPage),
            ("font", Action::Interface(1)),
            ("mesh", Action::Overlays),
            ("error", Action::Drawer(DrawerPage::Solver)),
            ("theme", Action::Theme),
            ("font", Action::Help),
            ("contour", Action::Isolines),
        ] {
            assert!(matching_actions(words).iter().any(|entry| entry.action == action), "{words}");
        }
        assert!(matching_actions("gibberish").is_empty());
        // what has the name itself is first
        assert_eq!(matching_actions("tip")[0].action, Action::NextTip);
    }
}
