//! Pairs of lines, and the entities that they make.

use ppum::vec2::{Vec2, vec2};

use crate::error::ImportError;
use crate::source::SourceLine;

/// Most pairs of one entity: a polyline of some hundred thousand vertices.
const MOST_PAIRS: usize = 1 << 20;

/// A group code and its value.
#[derive(Clone, Copy)]
pub(super) struct CodedValue<'a> {
    pub(super) code: i32,
    pub(super) value: &'a str,
    line: usize,
}

/// Everything from a pair of code 0 to the next one.
pub(super) struct Entity<'a> {
    pub(super) kind: &'a str,
    pub(super) pairs: Vec<CodedValue<'a>>,
    line: usize,
}

/// The entities of a text.
pub(super) struct Entities<'a> {
    lines: std::str::Lines<'a>,
    /// The number of lines that were read.
    pub(super) line: usize,
    /// The pair that the next entity begins with, if it was read.
    head: Option<CodedValue<'a>>,
}

impl<'a> Entities<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self { lines: text.trim_start_matches('\u{feff}').lines(), line: 0, head: None }
    }

    fn next_line(&mut self) -> Option<&'a str> {
        self.line += 1;
        self.lines.next().map(str::trim)
    }

    fn pair(&mut self) -> Result<Option<CodedValue<'a>>, ImportError> {
        let Some(code) = self.next_line() else { return Ok(None) };
        let source = SourceLine::new(self.line);
        let code = code.parse().map_err(|_| {
            let start: String = code.chars().take(20).collect();
            source.error(format!("`{start}` is no group code; is this a DXF file?"))
        })?;
        let value = self
            .next_line()
            .ok_or_else(|| source.error("the file ends amid a pair; save or copy it once more"))?;
        Ok(Some(CodedValue { code, value, line: self.line }))
    }

    /// The next entity; nothing at the end.
    pub(super) fn entity(&mut self) -> Result<Option<Entity<'a>>, ImportError> {
        let mut head = self.head.take();
        while head.is_none() {
            // comments (999) may stand before the first entity
            let Some(pair) = self.pair()? else { return Ok(None) };
            head = (pair.code == 0).then_some(pair);
        }
        let Some(CodedValue { value: kind, line, .. }) = head else { return Ok(None) };
        let mut entity = Entity { kind, pairs: Vec::new(), line };
        while kind != "EOF"
            && let Some(pair) = self.pair()?
        {
            if pair.code == 0 {
                self.head = Some(pair);
                break;
            }
            entity.pairs.push(pair);
            if entity.pairs.len() > MOST_PAIRS {
                return Err(ImportError::too_many("pairs in an entity", MOST_PAIRS));
            }
        }
        Ok(Some(entity))
    }
}

impl<'a> Entity<'a> {
    pub(super) fn source(&self) -> SourceLine {
        let handle = self.text(5).and_then(|text| u64::from_str_radix(text, 16).ok());
        SourceLine { line: self.line, handle: handle.unwrap_or(0) }
    }

    fn pair(&self, code: i32) -> Option<&CodedValue<'a>> {
        self.pairs.iter().find(|pair| pair.code == code)
    }

    /// The value of a code.
    pub(super) fn text(&self, code: i32) -> Option<&'a str> {
        self.pair(code).map(|pair| pair.value)
    }

    fn parsed<T: std::str::FromStr>(&self, pair: &CodedValue<'_>) -> Result<T, ImportError> {
        pair.value.parse().map_err(|_| {
            let source = SourceLine { line: pair.line, ..self.source() };
            let start: String = pair.value.chars().take(20).collect();
            let kind = self.kind;
            source.error(format!("`{start}` is no number, as group {} of {kind} has", pair.code))
        })
    }

    /// All values of a code, which are numbers.
    pub(super) fn numbers(&self, code: i32) -> Result<Vec<f64>, ImportError> {
        self.pairs.iter().filter(|pair| pair.code == code).map(|pair| self.parsed(pair)).collect()
    }

    pub(super) fn number(&self, code: i32, default: f64) -> Result<f64, ImportError> {
        self.pair(code).map_or(Ok(default), |pair| self.parsed(pair))
    }

    pub(super) fn whole(&self, code: i32) -> Result<Option<i64>, ImportError> {
        self.pair(code).map(|pair| self.parsed(pair)).transpose()
    }

    /// True if a bit is set in a value.
    pub(super) fn flag(&self, code: i32, bit: i64) -> Result<bool, ImportError> {
        Ok(self.whole(code)?.unwrap_or(0) & bit != 0)
    }

    /// The point of a code and the one ten higher, the origin if they are missing.
    pub(super) fn point(&self, code: i32) -> Result<Vec2, ImportError> {
        Ok(vec2(self.number(code, 0.0)?, self.number(code + 10, 0.0)?))
    }

    /// All points of a code.
    pub(super) fn points(&self, code: i32) -> Result<Vec<Vec2>, ImportError> {
        let (x, y) = (self.numbers(code)?, self.numbers(code + 10)?);
        if x.len() != y.len() {
            let (kind, x, y) = (self.kind, x.len(), y.len());
            let message = format!("{kind} has {x} x but {y} y of points; repair the file");
            return Err(self.source().error(message));
        }
        Ok(x.into_iter().zip(y).map(|(x, y)| vec2(x, y)).collect())
    }
}
