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

/// The actions whose names, or other words for them, have all words of a text. First are names that
/// begin with the text, then those with words that do, with the text in them, and other words.
fn matching_actions(text: &str) -> Vec<&'static ActionEntry> {
    let text = text.trim().to_lowercase();
    let begins = |words: &str| words.split(' ').any(|word| word.starts_with(&text));
    let has_all = |words: &str| text.split_whitespace().all(|word| words.contains(word));
    let rank = |entry: &&'static ActionEntry| match entry.name.to_lowercase() {
        name if name.starts_with(&text) => Some(0),
        name if begins(&name) => Some(1),
        name if has_all(&name) => Some(2),
        _ if begins(entry.synonyms) => Some(3),
        name => has_all(&format!("{name} {}", entry.synonyms)).then_some(4),
    };
    let mut found: Vec<_> = all().filter_map(|entry| Some((rank(&entry)?, entry))).collect();
    found.sort_by_key(|(rank, _)| *rank);
    found.into_iter().map(|(_, entry)| entry).collect()
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
        for (words, action) in [
            ("fly", Action::NextTip),
            ("open", Action::Open),
            ("new", Action::NewProblem),
            ("dxf", Action::Import),
            ("link", Action::Link),
            ("contact", Action::Drawer(DrawerPage::Solver)),
            ("mesh", Action::Overlays),
            ("solve", Action::Solve),
            ("save", Action::Save(ExportChoice::Image)),
        ] {
            assert_eq!(matching_actions(words)[0].action, action, "{words}");
        }
    }
}
