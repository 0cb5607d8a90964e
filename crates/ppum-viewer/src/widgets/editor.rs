//! Formulas that are written: checked at every letter, errors marked at their place, names
//! completed.

use std::ops::Range;
use std::sync::Arc;

use egui::text::{CCursor, CharIndex, LayoutJob, TextFormat};
use egui::{
    CompletionPopup, FontId, Galley, Key, KeyboardShortcut, Modifiers, RectAlign, RichText, Stroke,
    Suggestion, TextBuffer, TextEdit, Ui,
};
use ppum::formula::FormulaError;
use ppum::quantity::{QuantityError, QuantityFormulaError};
use ppum::replace::ReplaceError;
use ppum::weight::WeightError;
use ppum_scene::quantity::DisplayError;

use super::wrong;

/// A text that is edited. A valid text enters the session at once; an invalid one stays here until
/// it is corrected, and the image stays as it is.
#[derive(Clone, Debug, Default)]
pub struct Editor {
    draft: String,
    /// The text that the draft began with.
    base: Option<String>,
    checked: Option<EditorCheck>,
}

#[derive(Clone, Debug)]
struct EditorCheck {
    text: String,
    version: usize,
    mistake: Option<TextDiagnostic>,
}

/// An error in a text, with its position.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TextDiagnostic {
    /// The reason, with the remedy.
    pub message: String,
    /// The bytes that it lies at, if it lies somewhere; of a text that ends too early none after
    /// the last.
    pub place: Option<Range<usize>>,
}

/// The text of an editor, with its accessible name and completions.
pub struct EditedText<'a> {
    /// The name for those who do not see it.
    pub name: &'a str,
    /// The text in the session.
    pub current: &'a str,
    /// Names that may be completed.
    pub names: &'a [String],
    /// Another number whenever the same text may have another meaning.
    pub version: usize,
}

/// Suggestions at once.
const MOST: usize = 12;

impl Editor {
    /// Shows it; returns a text that is new and right.
    pub fn show(
        &mut self,
        ui: &mut Ui,
        subject: &EditedText<'_>,
        check: impl FnOnce(&str) -> Result<(), TextDiagnostic>,
    ) -> Option<String> {
        let new = self.show_text(ui, subject, check);
        if let Some(error) = self.error() {
            ui.label(RichText::new(error).color(wrong(ui)));
        }
        new
    }

    /// Returns the error in what is written.
    pub(crate) fn error(&self) -> Option<&str> {
        self.mistake().map(|mistake| mistake.message.as_str())
    }

    /// Shows it without the message of its error; returns a text that is new and right.
    pub(crate) fn show_text(
        &mut self,
        ui: &mut Ui,
        subject: &EditedText<'_>,
        check: impl FnOnce(&str) -> Result<(), TextDiagnostic>,
    ) -> Option<String> {
        if self.base.as_deref() != Some(subject.current) {
            self.base = Some(subject.current.to_owned());
            self.draft = subject.current.to_owned();
        }
        let mark = self.mistake().and_then(|mistake| mistake.place.clone());
        let is_changed = self.edit(ui, subject, mark);
        let is_wrong = self.check(subject.version, check).is_some();
        if is_wrong || !is_changed || self.draft == subject.current {
            return None;
        }
        self.base = Some(self.draft.clone());
        Some(self.draft.clone())
    }

    /// Shows nothing where the session has a text of its own for that, until something is written.
    pub fn stay_empty(&mut self, own: &str) {
        self.base = Some(own.to_owned());
    }

    /// Forgets what is written: the session's text is shown again.
    pub fn forget(&mut self) {
        *self = Self::default();
    }

    fn mistake(&self) -> Option<&TextDiagnostic> {
        let checked = self.checked.as_ref()?;
        checked.mistake.as_ref().filter(|_| checked.text == self.draft)
    }

    /// The text itself; true if it was changed.
    fn edit(&mut self, ui: &mut Ui, subject: &EditedText<'_>, mark: Option<Range<usize>>) -> bool {
        let before = self.draft.clone();
        let mut layouter = |ui: &Ui, text: &dyn TextBuffer, width: f32| {
            laid_out(ui, text.as_str(), mark.clone(), width)
        };
        let rows = self.draft.lines().count().clamp(1, 6);
        let edit = TextEdit::multiline(&mut self.draft)
            .desired_rows(rows)
            .desired_width(f32::INFINITY)
            .return_key(KeyboardShortcut::new(Modifiers::SHIFT, Key::Enter))
            .hint_text(subject.current)
            .layouter(&mut layouter);
        let popup = CompletionPopup::new(ui.make_persistent_id(("editor", subject.name)))
            .word_boundary(|c| !is_of_names(c))
            .align(RectAlign::BOTTOM_START)
            .accept_keys([Key::Tab]);
        let output = popup.show(ui, edit, |query| suggestions(query.word, subject.names));
        let text = &output.text_edit;
        if let Some(place) = mark.filter(|place| place.is_empty()) {
            let at =
                CCursor::new(CharIndex(before[..place.start.min(before.len())].chars().count()));
            let end = text.galley.pos_from_cursor(at).translate(text.galley_pos.to_vec2());
            let stroke = Stroke::new(2.0, wrong(ui));
            ui.painter().hline(end.left()..=end.left() + 8.0, end.bottom(), stroke);
        }
        text.response.response.clone().accessible_name(subject.name);
        // Enter ends a formula, Shift+Enter its line
        if ui.input(|input| input.key_pressed(Key::Enter) && !input.modifiers.shift) {
            text.response.response.surrender_focus();
        }
        self.draft != before
    }

    fn check(
        &mut self,
        version: usize,
        check: impl FnOnce(&str) -> Result<(), TextDiagnostic>,
    ) -> Option<&TextDiagnostic> {
        let is_checked =
            |checked: &EditorCheck| checked.text == self.draft && checked.version == version;
        if !self.checked.as_ref().is_some_and(is_checked) {
            let mistake = check(&self.draft).err();
            self.checked = Some(EditorCheck { text: self.draft.clone(), version, mistake });
        }
        self.checked.as_ref().and_then(|checked| checked.mistake.as_ref())
    }
}

fn is_of_names(c: char) -> bool {
    c.is_alphanumeric() || "_-:".contains(c)
}

/// Names that begin like a word, then those that hold it; none for a word that is a name.
fn suggestions(word: &str, names: &[String]) -> Vec<Suggestion> {
    let is_number = word.starts_with(|c: char| c.is_ascii_digit());
    if word.is_empty() || is_number || names.iter().any(|name| name == word) {
        return Vec::new();
    }
    let begin = names.iter().filter(|name| name.starts_with(word));
    let hold = names.iter().filter(|name| !name.starts_with(word) && name.contains(word));
    begin.chain(hold).take(MOST).map(Suggestion::new).collect()
}

/// The text in letters of one width, its error underlined.
fn laid_out(ui: &Ui, text: &str, mark: Option<Range<usize>>, width: f32) -> Arc<Galley> {
    let mut job = LayoutJob::default();
    job.wrap.max_width = width;
    let plain = TextFormat::simple(FontId::monospace(13.0), ui.visuals().text_color());
    let wrong = wrong(ui);
    let marked = TextFormat { underline: Stroke::new(1.5, wrong), color: wrong, ..plain.clone() };
    let at = |byte: usize| text.floor_char_boundary(byte);
    let mark = mark.map_or(0..0, |mark| at(mark.start)..at(mark.end));
    job.append(&text[..mark.start], 0.0, plain.clone());
    job.append(&text[mark.clone()], 0.0, marked);
    job.append(&text[mark.end..], 0.0, plain);
    ui.fonts_mut(|fonts| fonts.layout_job(job))
}

impl TextDiagnostic {
    fn of_formula(error: &FormulaError, text: &str) -> Self {
        Self { message: error.message(), place: Some(error.place(text)) }
    }

    fn of_all(error: &dyn std::error::Error, text: &str) -> Self {
        Self { message: error.to_string(), place: Some(0..text.len()) }
    }

    /// Explains why a text is no quantity.
    pub(crate) fn of_quantity(error: &DisplayError, text: &str) -> Self {
        match error {
            DisplayError::Quantity(QuantityError::Formula(QuantityFormulaError::Formula(
                error,
            ))) => {
                // the text was trimmed before it was read
                let before = text.len() - text.trim_start().len();
                let mistake = Self::of_formula(error, text.trim());
                let shifted = |place: Range<usize>| place.start + before..place.end + before;
                Self { place: mistake.place.map(shifted), ..mistake }
            }
            // the names that there are stand in the list
            DisplayError::Quantity(error) => Self::of_name(error, text),
            DisplayError::Unknown { error, .. } => Self::of_name(error, text),
            other => Self::of_all(other, text),
        }
    }

    fn of_name(error: &QuantityError, text: &str) -> Self {
        match error {
            QuantityError::Unknown { name, hint, .. } => {
                let message = format!("there is no quantity `{name}`{hint}");
                Self { message, place: Some(0..text.len()) }
            }
            other => Self::of_all(other, text),
        }
    }

    /// Explains why a text is no formula of a named quantity.
    pub(crate) fn of_definition(error: &QuantityFormulaError, text: &str) -> Self {
        match error {
            QuantityFormulaError::Formula(error) => Self::of_formula(error, text),
            other => Self::of_all(other, text),
        }
    }

    /// Explains why a text cannot replace a function or the weight.
    pub(crate) fn of_replacement(error: &ReplaceError, text: &str) -> Self {
        match error {
            ReplaceError::Formula(error) | ReplaceError::Weight(WeightError::Formula(error)) => {
                Self::of_formula(error, text)
            }
            other => Self::of_all(other, text),
        }
    }
}
