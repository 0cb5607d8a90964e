//! A list that one chooses from: closed it is a button; open, a text above it says what is
//! looked for.

use egui::{Button, Key, Modifiers, Response, RichText, ScrollArea, TextEdit, Ui};

use super::note;

/// Something that can be chosen.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ChooserItem {
    /// The chosen value, as it is written.
    pub value: String,
    /// The meaning of it.
    pub about: String,
    /// The heading that it stands below; all of one heading stand together.
    pub group: &'static str,
}

/// The list while it is shown.
#[derive(Clone, Debug, Default)]
pub struct Chooser {
    is_open: bool,
    /// True until the text has been given the keys.
    is_new: bool,
    /// True while the text has them.
    has_keys: bool,
    /// True if the text takes them back whenever it has lost them.
    keeps_keys: bool,
    text: String,
    at: usize,
}

/// Rows below each other, one of which the keys are at.
pub(crate) struct RowList<'a> {
    /// The name among all widgets.
    pub(crate) name: &'a str,
    /// The largest height \[points\].
    pub(crate) height: f32,
    /// The row that the keys are at.
    pub(crate) at: Option<usize>,
    /// True if that row is scrolled to.
    pub(crate) is_followed: bool,
}

impl RowList<'_> {
    /// Shows the rows; returns the one that is clicked.
    pub(crate) fn show<T: Copy>(
        &self,
        ui: &mut Ui,
        rows: impl Iterator<Item = T>,
        mut row: impl FnMut(&mut Ui, T, bool) -> Response,
    ) -> Option<T> {
        let mut clicked = None;
        let area = ScrollArea::vertical().max_height(self.height).auto_shrink([false, true]);
        area.id_salt(self.name).show(ui, |ui| {
            for (number, one) in rows.enumerate() {
                let is_at = self.at == Some(number);
                let response = row(ui, one, is_at);
                if is_at && self.is_followed {
                    response.scroll_to_me(None);
                }
                if response.clicked() {
                    clicked = Some(one);
                }
            }
        });
        clicked
    }
}

/// Words for quantities that are not of the whole body.
const FACES: [&str; 6] =
    ["normal-traction", "shear-traction", "contact pressure", "opening", "sliding", "closed gap"];

/// Rows that are shown; who looks for others writes more of the name.
const MOST: usize = 200;
/// Height of the open list \[points\].
const HEIGHT: f32 = 260.0;

impl Chooser {
    /// Opens the list, ready to be written in.
    pub fn open(&mut self) {
        *self = Self { is_open: true, is_new: true, ..Self::default() };
    }

    /// Opens the list, which keeps the keys until it is closed.
    pub(crate) fn open_alone(&mut self) {
        self.open();
        self.keeps_keys = true;
    }

    /// True if the list is open.
    pub(crate) fn is_open(&self) -> bool {
        self.is_open
    }

    /// Opens or closes it.
    pub fn toggle(&mut self) {
        if self.is_open {
            *self = Self::default();
        } else {
            self.open();
        }
    }

    /// The text that is looked for.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Shows the list of the choices that fit the text, if it is open; returns what is chosen.
    /// `row` shows a choice, true if the keys are at it.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        name: &str,
        current: &str,
        choices: &[ChooserItem],
        row: impl Fn(&mut Ui, &ChooserItem, bool) -> Response,
    ) -> Option<String> {
        let found = matching_choices(&self.text, choices);
        let text = self.text.to_lowercase();
        let empty = match FACES.iter().any(|word| word.contains(text.trim())) {
            true => "on the faces of cracks: page Plot, a crack, Faces",
            false => "nothing has this name; formulas are written below",
        };
        self.show_found(ui, [name, empty], current, &found, row)
    }

    /// Shows a list that was found by the text, with a note in place of an empty one.
    pub(crate) fn show_found(
        &mut self,
        ui: &mut Ui,
        [name, empty]: [&str; 2],
        current: &str,
        found: &[&ChooserItem],
        row: impl Fn(&mut Ui, &ChooserItem, bool) -> Response,
    ) -> Option<String> {
        if !self.is_open {
            return None;
        }
        if self.is_new {
            self.at = found.iter().position(|choice| choice.value == current).unwrap_or(0);
        }
        let (enter, is_followed) = self.keys(ui, found.len());
        self.field(ui, name);
        let entered = found.get(self.at).filter(|_| enter).copied();
        let list = RowList { name, height: HEIGHT, at: Some(self.at), is_followed };
        let mut group = "";
        let rows = found.iter().copied().take(MOST.max(self.at + 1));
        let clicked = list.show(ui, rows, |ui, choice, is_at| {
            if choice.group != group {
                group = choice.group;
                ui.label(note(ui, group));
            }
            row(ui, choice, is_at)
        });
        if found.len() > MOST {
            let more = format!("and {} more: write more of the name", found.len() - MOST);
            ui.label(note(ui, more));
        }
        if found.is_empty() {
            ui.weak(empty);
        }
        let value = clicked.or(entered).map(|choice| choice.value.clone());
        if value.is_some() {
            *self = Self::default();
        }
        value
    }

    /// The field of the text.
    fn field(&mut self, ui: &mut Ui, name: &str) {
        let edit = TextEdit::singleline(&mut self.text).hint_text("type to search");
        let edit = ui.add(edit.desired_width(f32::INFINITY)).accessible_name(name);
        if self.is_new || self.keeps_keys {
            edit.request_focus();
            self.is_new = false;
        }
        self.has_keys = edit.has_focus();
        if edit.changed() {
            self.at = 0;
        }
    }

    /// Takes the keys of the list; true if something is chosen, and true if the place has changed.
    fn keys(&mut self, ui: &Ui, count: usize) -> (bool, bool) {
        if !self.has_keys {
            return (false, self.is_new);
        }
        let keys = [Key::Escape, Key::Enter, Key::ArrowDown, Key::ArrowUp];
        let [escape, enter, down, up] =
            ui.input_mut(|input| keys.map(|key| input.consume_key(Modifiers::NONE, key)));
        let last = count.saturating_sub(1);
        self.at = (self.at + usize::from(down)).min(last).saturating_sub(usize::from(up));
        if escape {
            *self = Self::default();
        }
        (enter && self.is_open, down || up || self.is_new)
    }
}

/// The choices that have all words of a text; those whose own name begins with it come first in
/// their group.
fn matching_choices<'a>(text: &str, choices: &'a [ChooserItem]) -> Vec<&'a ChooserItem> {
    let text = text.to_lowercase();
    let fits = |choice: &&ChooserItem| {
        let all = format!("{} {} {}", choice.value, choice.about, choice.group).to_lowercase();
        text.split_whitespace().all(|word| all.contains(word))
    };
    let mut found: Vec<&ChooserItem> = choices.iter().filter(fits).collect();
    if let Some(best) =
        found.iter().position(|choice| !text.is_empty() && choice.value.starts_with(text.trim()))
    {
        found[..=best].rotate_right(1);
    }
    found
}

/// A row with a name and its meaning.
pub fn named(ui: &mut Ui, choice: &ChooserItem, is_at: bool) -> Response {
    let about = note(ui, &choice.about);
    let name = RichText::new(&choice.value).monospace();
    let button = Button::selectable(is_at, name).right_text(about).truncate();
    let response = ui.add_sized([ui.available_width(), 20.0], button).on_hover_text(&choice.about);
    response.accessible_name(&choice.value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn choice(value: &str, about: &str) -> ChooserItem {
        ChooserItem { value: value.into(), about: about.into(), group: "all" }
    }

    #[test]
    fn all_words_are_looked_for_and_names_come_first() {
        let all =
            [choice("sxx", "σxx, stress"), choice("tresca", "Tresca stress"), choice("s1", "")];
        let values = |text: &str| -> Vec<String> {
            matching_choices(text, &all).iter().map(|choice| choice.value.clone()).collect()
        };
        assert_eq!(values(""), ["sxx", "tresca", "s1"]);
        assert_eq!(values("stress"), ["sxx", "tresca"]);
        assert_eq!(values("STRESS resca"), ["tresca"]);
        assert_eq!(values("s1"), ["s1"]);
        assert_eq!(values("t"), ["tresca", "sxx"]);
        assert!(values("nothing").is_empty());
    }
}
