//! Actions found by their names.

use egui::{Align2, Key, ScrollArea, TextEdit, Ui, Window};

use crate::actions::{ALL, Action, ActionEntry, spelled, synonyms};

/// The search text.
#[derive(Clone, Debug, Default)]
pub struct CommandPalette {
    text: String,
    chosen: usize,
}

impl CommandPalette {
    /// Shows it, with the actions that are possible; true once it is done, with the action that was
    /// chosen, if any.
    pub fn show(
        &mut self,
        ui: &Ui,
        is_possible: impl Fn(Action) -> bool,
    ) -> (bool, Option<Action>) {
        let mut found = matching_actions(&self.text);
        found.retain(|entry| is_possible(entry.action));
        let keys = [Key::Escape, Key::Enter, Key::ArrowDown, Key::ArrowUp];
        let [escape, enter, down, up] =
            ui.input_mut(|input| keys.map(|key| input.consume_key(egui::Modifiers::NONE, key)));
        let last = found.len().saturating_sub(1);
        self.chosen = (self.chosen + usize::from(down)).min(last).saturating_sub(usize::from(up));
        let mut action = found.get(self.chosen).filter(|_| enter).map(|entry| entry.action);
        let window = Window::new("Find an action").anchor(Align2::CENTER_TOP, [0.0, 60.0]);
        window.collapsible(false).resizable(false).show(ui.ctx(), |ui| {
            let edit = ui.add(TextEdit::singleline(&mut self.text).desired_width(360.0));
            edit.request_focus();
            if edit.changed() {
                self.chosen = 0;
            }
            if found.is_empty() {
                ui.weak("Nothing of this name can be done now.");
            }
            ScrollArea::vertical().max_height(280.0).show(ui, |ui| {
                for (number, entry) in found.iter().enumerate() {
                    let is_chosen = number == self.chosen;
                    let key = entry.key.map(|key| spelled(ui.ctx(), &key)).unwrap_or_default();
                    let button = egui::Button::selectable(is_chosen, entry.name).shortcut_text(key);
                    if ui.add(button).clicked() {
                        action = Some(entry.action);
                    }
                }
            });
        });
        (escape || enter || action.is_some(), action)
    }
}

/// The actions whose names, or other words for them, have all words of a text; those of that
/// name first.
fn matching_actions(text: &str) -> Vec<&'static ActionEntry> {
    let text = text.to_lowercase();
    let has_all = |words: &str| text.split_whitespace().all(|word| words.contains(word));
    let is_named = |entry: &&ActionEntry| has_all(&entry.name.to_lowercase());
    let is_meant = |entry: &&ActionEntry| {
        has_all(&format!("{} {}", entry.name.to_lowercase(), synonyms(entry.action)))
    };
    let (mut all, others): (Vec<_>, Vec<_>) = ALL.iter().filter(is_meant).partition(is_named);
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
            ("export", Action::Save(ExportChoice::Picture)),
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
