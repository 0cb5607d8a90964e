//! Typed access to one value.

use std::ops::Range;
use std::path::{Path, PathBuf};

use ppum::formula::{Formula, FormulaError, Scope};
use ppum::vec2::{Vec2, vec2};
use toml::Spanned;
use toml::de::{DeArray, DeInteger, DeValue};

use super::super::error::Mistake;
use super::super::expression;
use super::{Report, Section, nearest};
use ppum::expression::Expression;

/// A value of the document. The readers of its type report and return `None` where it has another.
#[derive(Clone)]
pub(in super::super) struct Value<'a> {
    pub(super) report: &'a Report<'a>,
    /// As messages call it, e.g. `` `young` in [material] ``.
    pub(super) name: String,
    pub(super) item: &'a Spanned<DeValue<'a>>,
}

impl<'a> Value<'a> {
    /// Reports that something is wrong with the value; its name opens the message.
    pub(in super::super) fn error<T>(&self, message: &str) -> Option<T> {
        self.report.at(self.offset(), format!("{} {message}", self.name));
        None
    }

    /// Reports a message as it is.
    pub(in super::super) fn report(&self, message: &str) {
        self.report.at(self.offset(), message);
    }

    /// Reports a mistake in a file that the value names.
    pub(in super::super) fn add(&self, mistake: Mistake) {
        self.report.add(self.offset(), mistake);
    }

    fn offset(&self) -> usize {
        self.item.span().start
    }

    fn expected<T>(&self, what: &str) -> Option<T> {
        self.error(&format!("must be {what}, found {}", kind(self.item.get_ref())))
    }

    /// The text, if the value is one.
    pub(in super::super) fn as_text(&self) -> Option<&'a str> {
        self.item.get_ref().as_str()
    }

    /// A text in quotes.
    pub(in super::super) fn text(&self) -> Option<&'a str> {
        self.as_text().or_else(|| self.expected("a text in quotes"))
    }

    /// The file of that name, which the report remembers; paths are relative to `folder`.
    pub(in super::super) fn file(&self, folder: &Path) -> Option<PathBuf> {
        let path = folder.join(self.text()?);
        self.report.files.borrow_mut().push(path.clone());
        Some(path)
    }

    /// `true` or `false`.
    pub(in super::super) fn boolean(&self) -> Option<bool> {
        self.item.get_ref().as_bool().or_else(|| self.expected("true or false"))
    }

    /// A finite number.
    pub(in super::super) fn number(&self) -> Option<f64> {
        match self.any_number() {
            Some(number) if number.is_finite() => Some(number),
            Some(_) => self.error("must be finite; write a number that f64 can hold"),
            None if self.as_text().is_some_and(|text| text.trim().parse::<f64>().is_ok()) => {
                self.error("must be a number, found a text; remove the quotes")
            }
            None => self.expected("a number"),
        }
    }

    fn any_number(&self) -> Option<f64> {
        match self.item.get_ref() {
            DeValue::Integer(integer) => to_i64(integer).map(|value| value as f64),
            DeValue::Float(float) => float.as_str().parse().ok(),
            _ => None,
        }
    }

    /// A whole number, not negative.
    pub(in super::super) fn whole(&self) -> Option<u32> {
        let integer = self.item.get_ref().as_integer();
        let value = integer.and_then(to_i64).and_then(|value| u32::try_from(value).ok());
        let wrong = || match self.item.get_ref() {
            DeValue::Integer(_) => self.error("is out of range; write a small whole number ≥ 0"),
            _ => self.expected("a whole number"),
        };
        value.or_else(wrong)
    }

    /// A point `[x, y]`; each a number, or a formula of numbers in quotes.
    pub(in super::super) fn point(&self) -> Option<Vec2> {
        let [x, y] = self.pair("two numbers [x, y]")?;
        let (x, y) = (x.constant(), y.constant());
        Some(vec2(x?, y?))
    }

    /// An array of two values; `what` it should be, for the message.
    pub(in super::super) fn pair(&self, what: &str) -> Option<[Value<'a>; 2]> {
        self.array(what)
    }

    /// An array of so many values; `what` it should be, for the message.
    pub(in super::super) fn array<const N: usize>(&self, what: &str) -> Option<[Value<'a>; N]> {
        let items = self.item.get_ref().as_array().map(|array| self.elements(array));
        let all = items.and_then(|items| <[Value<'a>; N]>::try_from(items).ok());
        all.or_else(|| self.expected(what))
    }

    /// An array of any length; `what` it should be, for the message.
    pub(in super::super) fn list(&self, what: &str) -> Option<Vec<Value<'a>>> {
        let array = self.item.get_ref().as_array().or_else(|| self.expected(what))?;
        Some(self.elements(array))
    }

    /// One element of an array.
    pub(in super::super) fn element(&self, index: usize) -> Option<Value<'a>> {
        let item = self.item.get_ref().as_array()?.get(index)?;
        Some(Value { report: self.report, name: self.name.clone(), item })
    }

    fn elements(&self, array: &'a DeArray<'a>) -> Vec<Value<'a>> {
        let element = |item| Value { report: self.report, name: self.name.clone(), item };
        array.iter().map(element).collect()
    }

    /// The value as a table, if it is one; called `name` in messages.
    pub(in super::super) fn as_section(&self, name: &str) -> Option<Section<'a>> {
        let table = self.item.get_ref().as_table()?;
        let offset = self.offset();
        Some(Section {
            report: self.report,
            name: name.to_owned(),
            table,
            offset,
            meant: Vec::new(),
        })
    }

    /// The value as a table, called `name` in messages; `example` shows one.
    pub(in super::super) fn table(&self, name: &str, example: &str) -> Option<Section<'a>> {
        let section = self.as_section(name);
        section.or_else(|| self.expected(&format!("a table such as {example}")))
    }

    /// One of several words, each standing for something.
    pub(in super::super) fn choice<T: Clone>(&self, choices: &[(&str, T)]) -> Option<T> {
        let words: Vec<_> = choices.iter().map(|(word, _)| *word).collect();
        let text = match self.as_text() {
            Some(text) => text,
            None => return self.expected(&alternatives(&words)),
        };
        let chosen =
            choices.iter().find(|(word, _)| *word == text).map(|(_, choice)| choice.clone());
        chosen.or_else(|| {
            let hint = nearest(text, words.iter().copied())
                .map_or(String::new(), |word| format!("; did you mean \"{word}\"?"));
            let message = format!("cannot be \"{text}\", only {}{hint}", alternatives(&words));
            self.error(&message)
        })
    }

    /// A number, or a formula of the scope in quotes.
    pub(in super::super) fn expression(&self, scope: &Scope) -> Option<Expression> {
        match self.item.get_ref() {
            DeValue::String(text) => {
                let expression = self.inside(text, Expression::parse_in(text, scope))?;
                let value = expression.constant().unwrap_or(0.0);
                if value.is_finite() { Some(expression) } else { self.not_finite(value) }
            }
            DeValue::Integer(_) | DeValue::Float(_) => self.number().map(Expression::number),
            _ => self.expected("a number or a formula in quotes"),
        }
    }

    /// A number, or a formula of numbers in quotes.
    pub(in super::super) fn constant(&self) -> Option<f64> {
        let Some(text) = self.as_text() else { return self.number() };
        let scope = Scope::new(&[]).expect("a scope without names");
        let value = self.inside(text, Formula::parse(text, &scope))?.evaluate(&[]);
        if value.is_finite() { Some(value) } else { self.not_finite(value) }
    }

    fn not_finite<T>(&self, value: f64) -> Option<T> {
        self.error(&format!("is {value}, but must be finite"))
    }

    /// The result of parsing the value's text, or a report of a mistake at its place inside
    /// the text.
    pub(in super::super) fn inside<T>(
        &self,
        text: &str,
        result: Result<T, FormulaError>,
    ) -> Option<T> {
        let report = |error: FormulaError| {
            let offset = self.offset_in_text(text, error.line, error.column);
            self.report.at(offset, format!("{}: {}", self.name, expression::message(&error)));
        };
        result.map_err(report).ok()
    }

    /// The byte of a place in the value's text. Texts with escapes differ from what the file holds:
    /// for them where the value begins.
    fn offset_in_text(&self, text: &str, line: usize, column: usize) -> usize {
        let Range { start, end } = self.item.span();
        let raw = self.report.text.get(start..end).unwrap_or_default();
        let Some(quotes) =
            quotes(raw).filter(|&quotes| raw.get(quotes..quotes + text.len()) == Some(text))
        else {
            return start;
        };
        let before: usize = text.split_inclusive('\n').take(line - 1).map(str::len).sum();
        let rest = &text[before..];
        let inside = rest.char_indices().nth(column - 1).map_or(rest.len(), |(byte, _)| byte);
        start + quotes + before + inside
    }
}

/// Length of what opens a text: quotes, and the line break that follows three of them.
fn quotes(raw: &str) -> Option<usize> {
    if let Some(rest) = raw.strip_prefix("\"\"\"").or_else(|| raw.strip_prefix("'''")) {
        let breaks = ["\r\n", "\n"].iter().find(|text| rest.starts_with(**text));
        return Some(3 + breaks.map_or(0, |text| text.len()));
    }
    raw.starts_with(['"', '\'']).then_some(1)
}

fn to_i64(integer: &DeInteger<'_>) -> Option<i64> {
    i64::from_str_radix(integer.as_str(), integer.radix()).ok()
}

fn kind(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(_) => "a text".to_owned(),
        DeValue::Integer(_) | DeValue::Float(_) => "a number".to_owned(),
        DeValue::Boolean(_) => "true or false".to_owned(),
        DeValue::Datetime(_) => "a date".to_owned(),
        DeValue::Array(array) => format!("an array of {}", array.len()),
        DeValue::Table(_) => "a table".to_owned(),
    }
}

fn alternatives(words: &[&str]) -> String {
    words.iter().map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ")
}
