//! Errors of formulas: where, what, what was expected instead.

use std::ops::Range;

use crate::limits::{MAX_DEPTH, MAX_LENGTH};
use crate::printable::is_printable;

/// An error in the text of a formula.
///
/// Displayed as place and error, then the source line with the place marked:
///
/// ```text
/// line 1, column 13: unknown name `thet`; did you mean `theta`?
///   sqrt(r)*cos(thet/2)
///               ^^^^
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("line {line}, column {column}: {}\n{excerpt}", .mistake.message(.found))]
pub struct FormulaError {
    /// The error.
    pub mistake: ErrorKind,
    /// Line of the offending text, from 1.
    pub line: usize,
    /// Column of its first character, from 1, counted in characters.
    pub column: usize,
    /// The offending text, shortened if long; empty at the end of the formula.
    pub found: String,
    /// The source line with the place marked.
    pub excerpt: Box<str>,
}

/// The kinds of errors in a formula.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum ErrorKind {
    /// The grammar wants something else here.
    Unexpected {
        /// The expectation.
        expected: &'static str,
    },
    /// No variable, parameter, constant or `let` has this name.
    UnknownName {
        /// The nearest known name, if one is near.
        suggestion: Option<String>,
    },
    /// No function has this name.
    UnknownFunction {
        /// The nearest known function, if one is near.
        suggestion: Option<String>,
    },
    /// A variable is called like a function.
    NotAFunction,
    /// A function is used without its arguments.
    MissingArguments,
    /// A function has too few or too many arguments.
    ArgumentCount {
        /// Number of arguments it takes.
        expected: usize,
        /// Number of arguments it was given.
        given: usize,
        /// The function of a similar name that takes so many.
        suggestion: Option<&'static str>,
    },
    /// A name is defined without `let`.
    MissingLet,
    /// A `let` would give a second meaning to a name.
    NameTaken,
    /// A `let` uses the name it defines.
    SelfReference,
    /// A name with a module before it, as in `np.sqrt`.
    Module {
        /// The name in formulas.
        instead: String,
    },
    /// Digits that are no number, or a number too large for double precision.
    InvalidNumber,
    /// `a < b < c`.
    ChainedComparison,
    /// A condition stands where a number is needed.
    ConditionForNumber,
    /// A number stands where a condition is needed.
    NumberForCondition,
    /// Parentheses, calls, signs or powers are nested deeper than [`MAX_DEPTH`].
    TooDeep,
    /// The text is longer than [`MAX_LENGTH`].
    TooLong,
    /// `table(…)` where no tables are known.
    NoTables,
    /// No table has this name.
    UnknownTable {
        /// The nearest table, if one is near.
        suggestion: Option<Box<str>>,
        /// All tables.
        known: Box<str>,
    },
    /// The name of a table stands for a value.
    TableForNumber,
    /// A table has too few or too many arguments.
    TableArguments {
        /// The right form.
        form: Box<str>,
        /// Number of arguments, the table's name included.
        given: usize,
    },
    /// `side(…)` where there are no cracks.
    NoCracks,
    /// The argument of `side` is not the number of a crack.
    UnknownCrack {
        /// Number of cracks.
        cracks: usize,
    },
    /// The order of a table's derivative is not a whole number written out.
    InvalidOrder,
}

impl ErrorKind {
    /// The message without the place; `found` is the offending text.
    fn message(&self, found: &str) -> String {
        let quoted = if found.is_empty() { "the end".to_owned() } else { format!("`{found}`") };
        match self {
            Self::Unexpected { expected } if found.is_empty() => {
                format!("the formula ends here; expected {expected}")
            }
            Self::Unexpected { expected } => format!("unexpected {quoted}; expected {expected}"),
            Self::UnknownName { suggestion } => {
                format!("unknown name {quoted}{}", did_you_mean(suggestion.as_deref()))
            }
            Self::UnknownFunction { suggestion } => {
                format!("unknown function {quoted}{}", did_you_mean(suggestion.as_deref()))
            }
            Self::NotAFunction => format!("{quoted} is not a function; a product needs `*`"),
            Self::MissingArguments => format!("{quoted} is a function; write `{found}(…)`"),
            Self::ArgumentCount { expected, given, suggestion } => {
                let plural = if *expected == 1 { "" } else { "s" };
                let instead = did_you_mean(*suggestion);
                format!("{quoted} takes {expected} argument{plural}, not {given}{instead}")
            }
            Self::MissingLet => format!("to define {quoted}, write `let {found} = …;`"),
            Self::NameTaken => format!("{quoted} already has a meaning; choose another name"),
            Self::SelfReference => {
                format!(
                    "{quoted} is used in its own definition; choose another name for the new value"
                )
            }
            Self::Module { instead } => {
                format!("{quoted}: names have no module before them; write `{instead}`")
            }
            Self::InvalidNumber => format!("{quoted} is not a number of double precision"),
            Self::ChainedComparison => {
                "comparisons do not chain; write `a < b and b < c`".to_owned()
            }
            Self::ConditionForNumber => format!(
                "expected a number, found the condition {quoted}; `if(c, 1, 0)` makes a number of one"
            ),
            Self::NumberForCondition => format!(
                "expected a condition, found the number {quoted}; compare it, as in `… != 0`"
            ),
            Self::TooDeep => {
                format!("nested deeper than {MAX_DEPTH} levels; name parts with `let`")
            }
            Self::TooLong => format!("longer than {MAX_LENGTH} bytes; formulas are short texts"),
            Self::NoTables => "there are no tables here; use a closed expression".to_owned(),
            Self::UnknownTable { suggestion, known } => match suggestion {
                Some(name) => format!("no table {quoted}; did you mean `{name}`?"),
                None => format!("no table {quoted}; tables are {known}"),
            },
            Self::TableForNumber => format!("{quoted} is a table; write `table({found}, …)`"),
            Self::TableArguments { form, given } => {
                format!("wrong number of arguments, {given}; write `{form}`")
            }
            Self::NoCracks => format!("{quoted} needs a crack, but there is none here"),
            Self::UnknownCrack { cracks: 1 } => {
                format!("{quoted} is no crack; there is one, write `side(0)`")
            }
            Self::UnknownCrack { cracks } => format!(
                "{quoted} is no crack; there are {cracks}, from `side(0)` to `side({})`",
                cracks - 1
            ),
            Self::InvalidOrder => format!(
                "{quoted} is not the order of a derivative; write 0, 1, 2 or 3, as in `dtable(name, 1, x)`"
            ),
        }
    }
}

fn did_you_mean(suggestion: Option<&str>) -> String {
    suggestion.map_or(String::new(), |name| format!("; did you mean `{name}`?"))
}

/// A place in the text, as a range of bytes on character borders.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TextSpan {
    /// First byte.
    pub(crate) start: usize,
    /// One past the last byte.
    pub(crate) end: usize,
}

impl TextSpan {
    /// The smallest place that covers both.
    pub(crate) fn to(self, other: Self) -> Self {
        Self { start: self.start.min(other.start), end: self.end.max(other.end) }
    }

    /// The bytes, to slice the text with.
    pub(crate) fn range(self) -> Range<usize> {
        self.start..self.end
    }
}

impl FormulaError {
    /// The error in words, without its place.
    #[must_use]
    pub fn message(&self) -> String {
        self.mistake.message(&self.found)
    }

    /// The bytes of the offending text in the formula, to mark them; of a long one the first part.
    /// Empty at the end of the formula.
    #[must_use]
    pub fn place(&self, formula: &str) -> Range<usize> {
        let start = formula.split_inclusive('\n').take(self.line - 1).map(str::len).sum::<usize>();
        let rest = formula.get(start..).unwrap_or_default();
        let bytes = |text: &str, chars: usize| text.chars().take(chars).map(char::len_utf8).sum();
        let before: usize = bytes(rest, self.column - 1);
        let length: usize = bytes(&rest[before..], self.found.chars().count());
        start + before..start + before + length
    }

    /// The error at a place of `source`.
    pub(crate) fn new(source: &str, span: TextSpan, mistake: ErrorKind) -> Self {
        let before = &source[..span.start];
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        let rest = &source[line_start..];
        let line = rest.split('\n').next().unwrap_or(rest);
        let column = source[line_start..span.start].chars().count();
        let found = &source[span.range()];
        Self {
            mistake,
            line: before.matches('\n').count() + 1,
            column: column + 1,
            found: shorten(found),
            excerpt: excerpt(line, column, found.chars().count()).into(),
        }
    }
}

/// Longest offending text shown in a message, in characters.
const MAX_FOUND: usize = 40;

/// One character for each, so that carets stay below what they point at: a blank for white space,
/// and a replacement character for what is not printable.
fn visible(c: char) -> char {
    match c {
        c if c.is_whitespace() => ' ',
        c if is_printable(c) => c,
        _ => char::REPLACEMENT_CHARACTER,
    }
}

/// One line of at most [`MAX_FOUND`] characters.
fn shorten(found: &str) -> String {
    let line: String = found.chars().map(visible).collect();
    if line.chars().count() <= MAX_FOUND {
        return line;
    }
    line.chars().take(MAX_FOUND - 1).chain(['…']).collect()
}

/// Width of the part of a long source line that an error shows, in characters.
const EXCERPT_WIDTH: usize = 72;

/// The part of `line` around a column (from 0), and carets under `length` characters of it.
fn excerpt(line: &str, column: usize, length: usize) -> String {
    let length_of_line = line.chars().count();
    let first =
        if length_of_line <= EXCERPT_WIDTH { 0 } else { column.saturating_sub(EXCERPT_WIDTH / 2) };
    let shown: String = line.chars().skip(first).take(EXCERPT_WIDTH).map(visible).collect();
    let lead = if first > 0 { "…" } else { "" };
    let tail = if first + EXCERPT_WIDTH < length_of_line { "…" } else { "" };
    let indent = " ".repeat(lead.chars().count() + column - first);
    let room = (first + EXCERPT_WIDTH).min(length_of_line).saturating_sub(column);
    let carets = "^".repeat(length.min(room).max(1));
    format!("  {lead}{}{tail}\n  {indent}{carets}", shown.trim_end())
}

/// The known name that was meant, see [`nearest`](crate::spelling::nearest).
pub(crate) fn nearest<'a>(name: &str, known: impl Iterator<Item = &'a str>) -> Option<String> {
    crate::spelling::nearest(name, known).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The text that an error names is the text at its place, whatever stands before it.
    #[test]
    fn places_are_those_of_the_offending_text() {
        for (formula, found) in [
            ("1 + thet", "thet"),
            ("# α β\nlet a = 1;\na*ber + 1", "ber"),
            ("(1 +\n 2", ""),
            ("", ""),
        ] {
            let scope = crate::Scope::cartesian();
            let error = crate::Formula::parse(formula, &scope).expect_err("it is wrong");
            assert_eq!((&formula[error.place(formula)], error.found.as_str()), (found, found));
            assert!(error.to_string().contains(&error.message()));
        }
    }

    #[test]
    fn excerpt_of_a_long_line_stays_short() {
        let line = format!("{}?{}", "a".repeat(500), "b".repeat(500));
        let shown = excerpt(&line, 500, 1);
        let lines: Vec<&str> = shown.lines().collect();
        let caret = lines[1].chars().position(|c| c == '^').expect("a caret");
        assert_eq!(lines[0].chars().nth(caret), Some('?'));
        assert!(lines[0].chars().count() < 80);
    }
}
