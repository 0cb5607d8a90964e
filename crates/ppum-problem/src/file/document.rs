//! A TOML text with places: typed access to its values, as the rows of keys say what they are, that
//! reports every error and goes on.

use std::cell::{Cell, OnceCell, RefCell};
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use ppum::dataset::Dataset;
use ppum::expression::Expression;
use ppum::formula::{Formula, FormulaError, Scope, Table};
use ppum::text::nearest;
use ppum::vec2::Vec2;
use toml::Spanned;
use toml::de::{DeInteger, DeTable, DeValue};

use super::diagnostics::{DiagnosticList, quotes};
use super::keys::{BOUNDARY, CRACK, KeyTable, Kind};
use crate::data::{Diagnostic, EquationKind, HeatedBody, Keyword, expression, scopes, words};

/// Longest problem file, in bytes: a hundred thousand cracks take some.
pub const MAX_LENGTH: u64 = 16 << 20;

/// A text that is read, and what was found in it that decides how the rest is read.
pub(crate) struct ProblemDocument<'a> {
    pub(crate) report: DiagnosticList<'a>,
    pub(crate) source: FileSource<'a>,
    /// The problem of the body, if this one is that of its temperature.
    pub(crate) heated: Option<&'a HeatedBody<'a>>,
    /// None if the file does not say it as it should.
    pub(crate) equation: Cell<Option<EquationKind>>,
    /// Tables of its formulas.
    pub(crate) tables: OnceCell<Vec<Arc<Table>>>,
    scope: OnceCell<Option<Scope>>,
    /// Keys of the file that are meant by others: what is said under those has no place by key.
    pub(crate) misnamed: RefCell<Vec<&'static str>>,
    /// Files that the text names, as far as they were asked for.
    pub(crate) files: RefCell<Vec<PathBuf>>,
}

/// Where the files are that a text names.
#[derive(Clone, Copy)]
pub(crate) enum FileSource<'a> {
    /// In a folder.
    Folder(&'a Path),
    /// Nowhere any more: the text is that of a dataset, which holds what was in them.
    Stored(&'a Dataset),
}

impl<'a> ProblemDocument<'a> {
    pub(crate) fn new(file: &'a str, text: &'a str, source: FileSource<'a>) -> Self {
        Self {
            report: DiagnosticList::new(file, text),
            source,
            heated: None,
            equation: Cell::new(None),
            tables: OnceCell::new(),
            scope: OnceCell::new(),
            misnamed: RefCell::default(),
            files: RefCell::default(),
        }
    }

    /// The tables that formulas may read.
    pub(crate) fn tables(&self) -> &[Arc<Table>] {
        self.tables.get().map_or(&[], Vec::as_slice)
    }

    /// The names of formulas of position; none if the tables cannot all be among them.
    pub(crate) fn scope(&self) -> Option<&Scope> {
        self.scope.get_or_init(|| scopes::position(self.tables()).ok()).as_ref()
    }
}

/// A table of the document.
pub(crate) struct Section<'a> {
    pub(crate) document: &'a ProblemDocument<'a>,
    keys: &'static KeyTable,
    table: &'a DeTable<'a>,
    /// Place at which something is said to be missing.
    offset: usize,
    /// Keys that were meant by those of the other equation.
    meant: Vec<&'static str>,
    /// Keys that were meant by those that are not known, and what these say: it is read as if their
    /// names were right, so that no other error seems to follow.
    misnamed: Vec<(&'static str, &'a Spanned<DeValue<'a>>)>,
}

impl<'a> Section<'a> {
    /// A table whose keys have not been looked at.
    pub(crate) fn unchecked(
        document: &'a ProblemDocument<'a>,
        keys: &'static KeyTable,
        table: &'a DeTable<'a>,
        offset: usize,
    ) -> Self {
        Self { document, keys, table, offset, meant: Vec::new(), misnamed: Vec::new() }
    }

    /// Reports every key that is not known, or of another equation.
    pub(crate) fn checked(mut self) -> Self {
        let equation = self.document.equation.get();
        for (key, item) in self.table.iter() {
            let name = key.get_ref().as_ref();
            let row = self.keys.row(name);
            if self.keys.keys.is_empty() || row.is_some_and(|row| row.fits(equation)) {
                continue;
            }
            let message = match row.and_then(|row| row.equation) {
                Some((_, instead)) => {
                    self.meant.extend(instead);
                    misplaced(instead)
                }
                None => {
                    let (message, meant) = self.unknown(name);
                    self.misnamed.extend(meant.map(|key| (key, item)));
                    message
                }
            };
            let section = self.keys.name;
            let what = if row.is_some() { "" } else { "unknown key " };
            self.document
                .report
                .at(key.span().start, format!("{what}`{name}` in {section}{message}"));
        }
        self
    }

    /// Returns the end of the message about an unknown key, and the key that was probably meant.
    fn unknown(&self, name: &str) -> (String, Option<&'static str>) {
        let equation = self.document.equation.get();
        let rows = self.keys.keys.iter().filter(|row| row.fits(equation));
        let known: Vec<_> = rows.map(|row| row.name).collect();
        let loads_faces = self.keys.name == CRACK.name && BOUNDARY.row(name).is_some();
        match nearest(name, known.iter().copied()) {
            Some(near) => (format!("; did you mean `{near}`?"), Some(near)),
            None if loads_faces => {
                ("; faces are loaded by a [[boundary]] with `on = { crack = 0 }`".into(), None)
            }
            None => (format!("; known are {}", known.join(", ")), None),
        }
    }

    /// Reports that something is missing in or wrong with the section as a whole.
    pub(crate) fn error<T>(&self, message: impl Into<String>) -> Option<T> {
        self.document.report.at(self.offset, message);
        None
    }

    /// Line and column of the table in the file, from 1.
    pub(crate) fn position(&self) -> [usize; 2] {
        self.document.report.position(self.offset).into()
    }

    /// True if the key is there, or meant by one that is.
    pub(crate) fn mentions(&self, key: &str) -> bool {
        self.table.contains_key(key)
            || self.meant.contains(&key)
            || self.misnamed(key).next().is_some()
    }

    /// True if one of the keys is mentioned.
    pub(crate) fn mentions_any(&self, keys: &[&str]) -> bool {
        keys.iter().any(|key| self.mentions(key))
    }

    /// The keys of a list that are there, with their values.
    pub(crate) fn given(&self, keys: &[&'static str]) -> Vec<(&'static str, DocumentValue<'a>)> {
        keys.iter().filter_map(|key| Some((*key, self.value(key)?))).collect()
    }

    /// The value of a key that may be absent.
    pub(crate) fn value(&self, key: &str) -> Option<DocumentValue<'a>> {
        let item = self.table.get(key).or_else(|| self.misnamed(key).next())?;
        Some(self.named(key, item))
    }

    /// Returns the values of unknown keys that probably stand for this one.
    fn misnamed(&self, key: &str) -> impl Iterator<Item = &'a Spanned<DeValue<'a>>> {
        let meant = self.misnamed.iter().filter(move |(meant, _)| *meant == key);
        meant.map(|(_, item)| *item)
    }

    /// The keys that are meant by others.
    pub(crate) fn misnamed_keys(&self) -> Vec<&'static str> {
        self.misnamed.iter().map(|(key, _)| *key).collect()
    }

    fn named(&self, key: &str, item: &'a Spanned<DeValue<'a>>) -> DocumentValue<'a> {
        let kind = self.keys.row(key).map_or(Kind::Constant, |row| row.kind);
        let name = format!("`{key}` in {}", self.keys.name);
        DocumentValue { document: self.document, name, kind, item }
    }

    /// All keys with their values.
    pub(crate) fn entries(&self) -> impl Iterator<Item = (&'a str, DocumentValue<'a>)> {
        self.table.iter().map(|(key, item)| {
            let key = key.get_ref().as_ref();
            (key, self.named(key, item))
        })
    }

    /// The value of a key that must be there.
    pub(crate) fn required(&self, key: &str) -> Option<DocumentValue<'a>> {
        if !self.mentions(key) {
            let example = self.keys.row(key).map_or("", |row| row.example);
            let message =
                format!("`{key}` is missing in {}; add e.g. `{key} = {example}`", self.keys.name);
            return self.error(message);
        }
        self.value(key)
    }

    /// Reads the value of the key, if it is present and valid.
    pub(crate) fn get<T: FromValue>(&self, key: &str) -> Option<T> {
        T::read(&self.value(key)?)
    }

    /// Reads the value of the key, which must be present.
    pub(crate) fn require<T: FromValue>(&self, key: &str) -> Option<T> {
        T::read(&self.required(key)?)
    }

    /// Reads the value of the key, or the default if it is absent.
    pub(crate) fn or<T: FromValue>(&self, key: &str, default: T) -> Option<T> {
        self.value(key).map_or(Some(default), |value| T::read(&value))
    }

    /// Reads the value of the key, or `Some(None)` if it is absent.
    pub(crate) fn optional<T: FromValue>(&self, key: &str) -> Option<Option<T>> {
        self.value(key).map_or(Some(None), |value| T::read(&value).map(Some))
    }

    /// Reads the value of the key, in the range of the key.
    pub(crate) fn within(&self, key: &str) -> Option<f64> {
        self.required(key)?.within(key, self)
    }

    /// A table that may be absent.
    pub(crate) fn section(&self, key: &str) -> Option<Section<'a>> {
        let value = self.value(key)?;
        value.as_section().or_else(|| {
            value.report(&format!("`{key}` must be one table; write [{key}] once"));
            None
        })
    }

    /// A table that must be there.
    pub(crate) fn required_section(&self, key: &str) -> Option<Section<'a>> {
        if !self.mentions(key) {
            let row = self.keys.row(key)?;
            let equation = self.document.equation.get();
            let rows = row.kind.table()?.keys.iter();
            let keys = rows.filter(|row| row.is_required && row.fits(equation));
            let keys: Vec<_> = keys.map(|row| format!("`{}`", row.name)).collect();
            let remedy = match row.example {
                "" => format!("its keys {}", keys.join(", ")),
                example => format!("e.g. `{example}`"),
            };
            return self.error(format!("the table [{key}] is missing; add it with {remedy}"));
        }
        self.section(key)
    }

    /// The tables `[[key]]`; none, and an error, if there are more than a dataset can hold.
    pub(crate) fn sections_at_most(&self, most: usize, key: &str) -> Vec<Section<'a>> {
        let sections = self.sections(key);
        let Some(first) = sections.get(most) else { return sections };
        let count = sections.len();
        first.error::<()>(format!("there are {count} [[{key}]], but at most {most} may be"));
        Vec::new()
    }

    /// The tables `[[key]]`; none if absent.
    pub(crate) fn sections(&self, key: &str) -> Vec<Section<'a>> {
        let all = self.table.get(key).into_iter().chain(self.misnamed(key));
        all.flat_map(|item| self.sections_of(key, item)).collect()
    }

    fn sections_of(&self, key: &str, item: &'a Spanned<DeValue<'a>>) -> Vec<Section<'a>> {
        let value = self.named(key, item);
        let items = value.item.get_ref().as_array().map(|_| value.elements());
        let tables = items.filter(|items| items.iter().all(|item| item.item.get_ref().is_table()));
        if tables.is_none() {
            value.report(&format!("`{key}` must be a list of tables; write [[{key}]] for each"));
        }
        tables.iter().flatten().filter_map(DocumentValue::as_section).collect()
    }

    /// Reads all tables `[[key]]`; none at all if one of them cannot be read, as the checks count
    /// them.
    pub(crate) fn each<T>(&self, key: &str, read: impl FnMut(Section<'a>) -> Option<T>) -> Vec<T> {
        all(self.sections(key).into_iter().map(read)).unwrap_or_default()
    }
}

/// Everything, or nothing if one is missing; unlike `collect` it asks all of them, so that each can
/// report.
pub(crate) fn all<T>(items: impl Iterator<Item = Option<T>>) -> Option<Vec<T>> {
    let items: Vec<_> = items.collect();
    items.into_iter().collect()
}

fn misplaced(instead: &[&str]) -> String {
    let keys: Vec<_> = instead.iter().map(|key| format!("`{key}`")).collect();
    match keys[..] {
        [] => " does not fit the equation; remove it".to_owned(),
        _ => format!(" does not fit the equation; write {} instead", keys.join(", ")),
    }
}

/// A value of the document. The readers of its type report and return `None` where it has another.
#[derive(Clone)]
pub(crate) struct DocumentValue<'a> {
    pub(crate) document: &'a ProblemDocument<'a>,
    /// As messages call it, e.g. `` `young` in [material] ``.
    name: String,
    kind: Kind,
    item: &'a Spanned<DeValue<'a>>,
}

/// The types that values can be read as.
pub(crate) trait FromValue: Sized {
    /// Reads a value; reports and returns `None` if it is something else.
    fn read(value: &DocumentValue<'_>) -> Option<Self>;
}

impl<'a> DocumentValue<'a> {
    /// The value as it is written.
    pub(crate) fn source(&self) -> &'a str {
        self.document.report.text.get(self.item.span()).unwrap_or_default()
    }

    /// Reports that something is wrong with the value; its name opens the message.
    pub(crate) fn error<T>(&self, message: &str) -> Option<T> {
        self.report(&format!("{} {message}", self.name));
        None
    }

    /// Remarks something that is no error.
    pub(crate) fn note(&self, message: &str) {
        self.document.report.note(self.offset(), format!("{} {message}", self.name));
    }

    /// Reports a message as it is.
    pub(crate) fn report(&self, message: &str) {
        self.document.report.at(self.offset(), message);
    }

    /// Reports errors in a file that the value names.
    pub(crate) fn add(&self, errors: Vec<Diagnostic>) {
        errors.into_iter().for_each(|new| self.document.report.add(self.offset(), new));
    }

    fn offset(&self) -> usize {
        self.item.span().start
    }

    /// The file, the line and the column at which the value's text begins.
    pub(crate) fn start_of_text(&self) -> (&'a str, usize, usize) {
        let report = &self.document.report;
        let raw = report.text.get(self.item.span()).unwrap_or_default();
        let (line, column) = report.position(self.offset() + quotes(raw).unwrap_or(0));
        (report.file, line, column)
    }

    fn expected<T>(&self, what: &str) -> Option<T> {
        self.error(&format!("must be {what}, found {}", kind(self.item.get_ref())))
    }

    /// The text, if the value is one.
    pub(crate) fn as_text(&self) -> Option<&'a str> {
        self.item.get_ref().as_str()
    }

    /// A text in quotes.
    pub(crate) fn text(&self) -> Option<&'a str> {
        self.as_text().or_else(|| self.expected(&Kind::Text("").words()))
    }

    /// The file of that name, which the document remembers; paths are relative to `folder`.
    pub(crate) fn file(&self, folder: &Path) -> Option<PathBuf> {
        let path = folder.join(self.text()?);
        self.document.files.borrow_mut().push(path.clone());
        Some(path)
    }

    /// A finite number.
    fn number(&self) -> Option<f64> {
        let number = match self.item.get_ref() {
            DeValue::Integer(integer) => to_i64(integer).map(|value| value as f64),
            DeValue::Float(float) => float.as_str().parse().ok(),
            _ => None,
        };
        match number {
            Some(number) if number.is_finite() => Some(number),
            Some(_) => self.error("must be finite; write a number that f64 can hold"),
            None if self.as_text().is_some_and(|text| text.trim().parse::<f64>().is_ok()) => {
                self.error("must be a number, found a text; remove the quotes")
            }
            None => self.expected(&Kind::Number.words()),
        }
    }

    /// A number, or a formula of numbers in quotes.
    fn constant(&self) -> Option<f64> {
        let Some(text) = self.as_text() else { return self.number() };
        let scope = Scope::new(&[]).expect("a scope without names");
        let value = self.inside(text, Formula::parse(text, &scope))?.evaluate(&[]);
        if value.is_finite() { Some(value) } else { self.not_finite(value) }
    }

    /// A number, or a formula of the scope in quotes.
    pub(crate) fn expression(&self, scope: &Scope) -> Option<Expression> {
        match self.item.get_ref() {
            DeValue::String(text) => {
                let expression = self.inside(text, Expression::parse_in(text, scope))?;
                let value = expression.constant().unwrap_or(0.0);
                if value.is_finite() { Some(expression) } else { self.not_finite(value) }
            }
            DeValue::Integer(_) | DeValue::Float(_) => self.number().map(Expression::number),
            _ => self.expected(&Kind::Value.words()),
        }
    }

    /// A number in the range of a key.
    pub(crate) fn within(&self, key: &str, section: &Section<'_>) -> Option<f64> {
        let (number, row) = (f64::read(self)?, section.keys.row(key)?);
        match row.range_error(number) {
            Some(message) => self.error(&message),
            None => Some(number),
        }
    }

    fn not_finite<T>(&self, value: f64) -> Option<T> {
        self.error(&format!("is {value}, but must be finite"))
    }

    /// The values of an array; none, without a word, of anything else.
    fn elements(&self) -> Vec<DocumentValue<'a>> {
        let kind = match self.kind {
            Kind::Array(_, _, _, kind) | Kind::List(_, kind) => *kind,
            Kind::Components(..) => Kind::Value,
            other => other,
        };
        let element = |item| DocumentValue { kind, item, ..self.clone() };
        self.item.get_ref().as_array().into_iter().flatten().map(element).collect()
    }

    /// True of an array.
    pub(crate) fn is_list(&self) -> bool {
        self.item.get_ref().is_array()
    }

    /// The values of an array of any length.
    pub(crate) fn list(&self) -> Option<Vec<DocumentValue<'a>>> {
        if !self.item.get_ref().is_array() {
            return self.expected(&self.kind.words());
        }
        Some(self.elements())
    }

    /// The values of an array of so many.
    pub(crate) fn array<const N: usize>(&self) -> Option<[DocumentValue<'a>; N]> {
        let kind = match self.kind {
            // what is no word is the other that it may be
            Kind::Either([kind, ..]) => *kind,
            kind => kind,
        };
        let items = DocumentValue { kind, ..self.clone() }.elements();
        <[DocumentValue<'a>; N]>::try_from(items).ok().or_else(|| self.expected(&kind.words()))
    }

    /// One value per component: those of an array, or the value itself if there is but one.
    pub(crate) fn components(&self) -> Option<Vec<DocumentValue<'a>>> {
        match self.document.equation.get() {
            Some(EquationKind::Poisson) => Some(vec![self.clone()]),
            _ => self.array::<2>().map(Vec::from),
        }
    }

    /// One element of an array.
    pub(crate) fn element(&self, index: usize) -> Option<DocumentValue<'a>> {
        self.elements().into_iter().nth(index)
    }

    /// The value as a table, if it is one.
    pub(crate) fn as_section(&self) -> Option<Section<'a>> {
        let table = self.item.get_ref().as_table()?;
        let keys = self.kind.table()?;
        Some(Section::unchecked(self.document, keys, table, self.offset()).checked())
    }

    /// The value as a table.
    pub(crate) fn table(&self) -> Option<Section<'a>> {
        self.as_section().or_else(|| self.expected(&self.kind.words()))
    }

    /// One of several words, each standing for something.
    pub(crate) fn choice<T: Keyword>(&self) -> Option<T> {
        let all = words::<T>();
        let alternatives = Kind::Word(words::<T>).words();
        let Some(text) = self.as_text() else { return self.expected(&alternatives) };
        let chosen = T::WORDS.iter().find(|(word, _)| *word == text).map(|(_, value)| *value);
        chosen.or_else(|| {
            let hint = nearest(text, all.iter().copied());
            let hint = hint.map_or(String::new(), |word| format!("; did you mean \"{word}\"?"));
            self.error(&format!("cannot be \"{text}\", only {alternatives}{hint}"))
        })
    }

    /// The result of parsing the value's text, or a report of an error at its place inside the
    /// text.
    pub(crate) fn inside<T>(&self, text: &str, result: Result<T, FormulaError>) -> Option<T> {
        let report = |error: FormulaError| {
            let offset = self.offset_in_text(text, error.line, error.column);
            let message = format!("{}: {}", self.name, expression::message(&error));
            self.document.report.at(offset, message);
        };
        result.map_err(report).ok()
    }

    /// The byte of a place in the value's text. Texts with escapes differ from what the file holds:
    /// for them where the value begins.
    fn offset_in_text(&self, text: &str, line: usize, column: usize) -> usize {
        let Range { start, end } = self.item.span();
        let raw = self.document.report.text.get(start..end).unwrap_or_default();
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

impl FromValue for f64 {
    fn read(value: &DocumentValue<'_>) -> Option<Self> {
        if matches!(value.kind, Kind::Number) { value.number() } else { value.constant() }
    }
}

impl FromValue for u32 {
    fn read(value: &DocumentValue<'_>) -> Option<Self> {
        let integer = value.item.get_ref().as_integer();
        let wrong = || match integer {
            Some(_) => value.error("is out of range; write a small whole number ≥ 0"),
            None => value.expected(&Kind::Whole.words()),
        };
        integer.and_then(to_i64).and_then(|n| Self::try_from(n).ok()).or_else(wrong)
    }
}

impl FromValue for usize {
    fn read(value: &DocumentValue<'_>) -> Option<Self> {
        u32::read(value).map(|number| number as Self)
    }
}

impl FromValue for bool {
    fn read(value: &DocumentValue<'_>) -> Option<Self> {
        value.item.get_ref().as_bool().or_else(|| value.expected(&Kind::Flag.words()))
    }
}

impl FromValue for String {
    fn read(value: &DocumentValue<'_>) -> Option<Self> {
        value.text().map(str::to_owned)
    }
}

/// A point `[x, y]`; each a number, or a formula of numbers in quotes.
impl FromValue for Vec2 {
    fn read(value: &DocumentValue<'_>) -> Option<Self> {
        <[f64; 2]>::read(value).map(Self::from)
    }
}

impl FromValue for Expression {
    fn read(value: &DocumentValue<'_>) -> Option<Self> {
        value.expression(value.document.scope()?)
    }
}

impl<T: Keyword> FromValue for T {
    fn read(value: &DocumentValue<'_>) -> Option<Self> {
        value.choice()
    }
}

impl<T: FromValue, const N: usize> FromValue for [T; N] {
    fn read(value: &DocumentValue<'_>) -> Option<Self> {
        all(value.array::<N>()?.iter().map(T::read))?.try_into().ok()
    }
}

impl<T: FromValue> FromValue for Vec<T> {
    fn read(value: &DocumentValue<'_>) -> Option<Self> {
        all(value.list()?.iter().map(T::read))
    }
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
