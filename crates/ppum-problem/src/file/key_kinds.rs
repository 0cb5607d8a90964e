//! A key of a problem file: its values, their range, its meaning.

use ppum::text::exact as digits;

use crate::data::EquationKind;

use Kind::{
    Array, Components, Constant, Either, Flag, List, Number, Table, Tables, Text, Value, Whole,
    Word,
};

/// A table of keys.
#[derive(Debug)]
pub struct KeyTable {
    /// As messages call it.
    pub name: &'static str,
    /// One that is written inline.
    pub example: &'static str,
    /// Its keys.
    pub keys: &'static [KeyRow],
}

/// A key of a table.
#[derive(Clone, Copy, Debug)]
pub struct KeyRow {
    /// Its name.
    pub name: &'static str,
    /// The values that it takes.
    pub kind: Kind,
    /// The range of its numbers.
    pub range: NumberRange,
    /// The value where the key is left out, in TOML or in words; `None` if there is none.
    pub default: Option<fn() -> String>,
    /// True if the key may not be left out, with the equation that it belongs to.
    pub is_required: bool,
    /// A value, for messages.
    pub example: &'static str,
    /// The equation that it belongs to, and the keys that do for the other one what it does.
    pub equation: Option<(EquationKind, &'static [&'static str])>,
    /// The end of messages about the range, with the default in place of `{}`.
    pub remedy: &'static str,
    /// Its meaning, for people.
    pub doc: &'static str,
}

/// The values that a key takes.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// A text in quotes, of the kind that the words say.
    Text(&'static str),
    /// `true` or `false`.
    Flag,
    /// A number.
    Number,
    /// A number, or a formula of numbers in quotes.
    Constant,
    /// A whole number that is not negative.
    Whole,
    /// A number, or a formula of x and y in quotes.
    Value,
    /// One of some words.
    Word(fn() -> Vec<&'static str>),
    /// So many values: their name in the plural, the form of the array, and what each is.
    Array(usize, &'static str, &'static str, &'static Kind),
    /// Any number of values: what they are called, and what each is.
    List(&'static str, &'static Kind),
    /// A value or one of some words for each component of a vector.
    Components(&'static str, &'static [&'static str]),
    /// A table.
    Table(&'static KeyTable),
    /// Tables that are written one after the other.
    Tables(&'static KeyTable),
    /// One of several.
    Either(&'static [Kind]),
}

/// A range of numbers, whose ends may be open.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NumberRange {
    /// The ends.
    pub ends: [f64; 2],
    /// Whether each end is outside.
    pub open: [bool; 2],
}

pub(crate) const fn within(from: f64, to: f64) -> NumberRange {
    NumberRange { ends: [from, to], open: [false; 2] }
}

impl NumberRange {
    pub(crate) const fn with_open(self, open: [bool; 2]) -> Self {
        Self { open, ..self }
    }

    /// True of finite numbers in the range.
    pub(crate) fn contains(self, value: f64) -> bool {
        let Self { ends: [from, to], open } = self;
        value.is_finite()
            && (value > from || !open[0] && value == from)
            && (value < to || !open[1] && value == to)
    }

    /// The range as it follows "must be"; empty if it has no ends.
    pub(crate) fn words(self) -> String {
        let ends = self.ends.map(digits);
        match (self.ends.map(f64::is_finite), self.open) {
            ([false, false], _) => String::new(),
            ([true, true], [false, false]) => format!("{} to {}", ends[0], ends[1]),
            ([true, true], open) => {
                let from = if open[0] { "above" } else { "at least" };
                let to = if open[1] { "below" } else { "at most" };
                format!("{from} {} and {to} {}", ends[0], ends[1])
            }
            _ if self == POSITIVE => "positive and finite".to_owned(),
            _ if self == NOT_NEGATIVE => "finite and not negative".to_owned(),
            _ => format!("at least {}", ends[0]),
        }
    }
}

pub(crate) const ALL: NumberRange = within(f64::NEG_INFINITY, f64::INFINITY);
pub(crate) const NOT_NEGATIVE: NumberRange = within(0.0, f64::INFINITY);
pub(crate) const POSITIVE: NumberRange = NOT_NEGATIVE.with_open([true, false]);

pub(crate) const fn key(name: &'static str, kind: Kind) -> KeyRow {
    KeyRow {
        name,
        kind,
        range: ALL,
        default: None,
        is_required: false,
        example: "",
        equation: None,
        remedy: "",
        doc: "",
    }
}

/// Functions that set a field.
macro_rules! setters {
    ($($field:ident: $type:ty),+) => {
        $(pub(crate) const fn $field(self, $field: $type) -> Self {
            Self { $field, ..self }
        })+
    };
}

impl KeyRow {
    setters!(range: NumberRange, example: &'static str, doc: &'static str, remedy: &'static str);

    pub(crate) const fn default(self, default: fn() -> String) -> Self {
        Self { default: Some(default), ..self }
    }

    pub(crate) const fn required(self, example: &'static str) -> Self {
        Self { is_required: true, example, ..self }
    }

    pub(crate) const fn only(self, equation: EquationKind, other: &'static [&'static str]) -> Self {
        Self { equation: Some((equation, other)), ..self }
    }

    /// The error of a number that is out of range.
    pub(crate) fn range_error(&self, value: f64) -> Option<String> {
        let default = self.default.map_or(String::new(), |default| default());
        let remedy = self.remedy.replace("{}", &default);
        let words = self.range.words();
        let message = || format!("is {}, but must be {words}{remedy}", digits(value));
        (!self.range.contains(value)).then(message)
    }

    /// True if a problem of this equation may have the key.
    pub(crate) fn fits(&self, equation: Option<EquationKind>) -> bool {
        self.equation.is_none_or(|(own, _)| equation.is_none_or(|equation| own == equation))
    }
}

impl Kind {
    /// The table that values are, if they may be one.
    pub(crate) fn table(self) -> Option<&'static KeyTable> {
        match self {
            Table(table) | Tables(table) => Some(table),
            Either(kinds) => kinds.iter().find_map(|kind| kind.table()),
            _ => None,
        }
    }

    /// The words that it may be, in quotes.
    pub(crate) fn all_words(self) -> Vec<String> {
        match self {
            Word(words) => words().iter().map(|word| format!("\"{word}\"")).collect(),
            Either(kinds) => kinds.iter().flat_map(|kind| kind.all_words()).collect(),
            _ => Vec::new(),
        }
    }

    /// A value of the kind as it follows "must be".
    pub(crate) fn words(self) -> String {
        match self {
            Text(_) => "a text in quotes".to_owned(),
            Flag => "true or false".to_owned(),
            Number | Constant => "a number".to_owned(),
            Whole => "a whole number".to_owned(),
            Value => "a number or a formula in quotes".to_owned(),
            Word(_) => self.all_words().join(", "),
            Array(count, items, form, _) => {
                let count = ["two", "three", "four"][count.clamp(2, 4) - 2];
                format!("{count} {items} {form}")
            }
            List(items, _) => format!("a list of {items}"),
            Components(..) => "an array of two, one per component".to_owned(),
            Table(table) | Tables(table) => format!("a table such as {}", table.example),
            Either(kinds) => kinds.iter().map(|kind| kind.words()).collect::<Vec<_>>().join(" or "),
        }
    }
}

impl KeyTable {
    /// The row of a key.
    pub(crate) fn row(&self, name: &str) -> Option<&'static KeyRow> {
        self.keys.iter().find(|row| row.name == name)
    }
}
