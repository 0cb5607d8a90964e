//! Actions found by their names.

use egui::{Align2, Key, ScrollArea, TextEdit, Ui, Window};

use crate::actions::{ALL, Action, Entry, spelled};

/// What is looked for.
#[derive(Clone, Debug, Default)]
pub struct Palette {
    text: String,
    chosen: usize,
}

impl Palette {
    /// Shows it; true once it is done, with the action that was chosen, if any.
    pub fn show(&mut self, ui: &Ui) -> (bool, Option<Action>) {
        let found = found(&self.text);
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

/// The actions whose names have all words of a text.
fn found(text: &str) -> Vec<&'static Entry> {
    let text = text.to_lowercase();
    let fits = |entry: &&Entry| {
        let name = entry.name.to_lowercase();
        text.split_whitespace().all(|word| name.contains(word))
    };
    ALL.iter().filter(fits).collect()
}
