//! Files of tables.
//!
//! A curve has a line `x,value` for each knot. A surface is a grid: its first line holds the knots
//! in x after an empty place, `,x1,x2,…`; each further line holds a knot in y and the values there,
//! `y,v1,v2,…`.

use std::path::Path;

use ppum::formula::{Table, TableError};

use super::csv::{self, CsvLine, LineErrors};
use crate::data::{Diagnostic, ProblemError};

/// Knots and values; `y` is empty in a curve. The values of a surface stand in rows of constant y.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TableData {
    pub(crate) x: Vec<f64>,
    pub(crate) y: Vec<f64>,
    pub(crate) values: Vec<f64>,
}

/// Reads a file.
///
/// # Errors
/// One error per line that has the wrong number of entries, an entry that is not a finite number,
/// or a knot that does not exceed the one before; or one for the file.
pub(crate) fn read(path: &Path) -> Result<TableData, Vec<Diagnostic>> {
    let text = csv::read(path, "table")?;
    let data = parse(&text, &path.display().to_string())?;
    if data.values.is_empty() {
        let message = "there are no values; write one `x,value` per line".to_owned();
        return Err(vec![csv::of_file(path, message)]);
    }
    Ok(data)
}

/// Reads a table from a file, as `file` of `[[table]]` in problem files: a line `x,value` for each
/// knot, or a grid with the knots in x after an empty place on the first line, `,x1,x2,…`, and
/// lines `y,v1,v2,…`.
///
/// # Errors
/// Every line that is wrong; or data that make no table.
pub fn read_table(name: &str, path: &Path) -> Result<Table, ProblemError> {
    let data = read(path).map_err(ProblemError::new)?;
    data.table(name).map_err(|error| csv::of_file(path, error.to_string()).into())
}

impl TableData {
    /// The table of the data.
    pub(crate) fn table(self, name: &str) -> Result<Table, TableError> {
        let Self { x, y, values } = self;
        match y.as_slice() {
            [] => Table::curve(name, x, values),
            _ => Table::surface(name, x, y, values),
        }
    }
}

fn parse(text: &str, file: &str) -> Result<TableData, Vec<Diagnostic>> {
    let mut lines = csv::lines(text).peekable();
    let mut errors = LineErrors::new(file);
    let first = lines.next_if(|first| first.words[0].text.is_empty());
    let x = first.as_ref().map(|first| knots(first, &mut errors));
    let count = first.map_or(2, |first| first.words.len());
    let (mut rows, mut values) = (Vec::new(), Vec::new());
    while let Some(line) = lines.next().filter(|_| !errors.is_full()) {
        if let Some([knot, of_knot @ ..]) = numbers(&line, count, &mut errors).as_deref() {
            push(&mut rows, *knot, (line.number, line.words[0].column), &mut errors);
            values.extend(of_knot);
        }
    }
    let (x, y) = match x {
        Some(x) => (x, rows),
        None => (rows, Vec::new()),
    };
    errors.or(TableData { x, y, values })
}

/// The knots after the empty place of a line.
fn knots(line: &CsvLine<'_>, errors: &mut LineErrors<'_>) -> Vec<f64> {
    let mut knots = Vec::new();
    for place in 1..line.words.len() {
        // a line of another kind may have a million words
        if errors.is_full() {
            break;
        }
        if let Some(knot) = errors.number(line, place, "") {
            push(&mut knots, knot, (line.number, line.words[place].column), errors);
        }
    }
    knots
}

/// The numbers of a line that must have so many.
fn numbers(line: &CsvLine<'_>, count: usize, errors: &mut LineErrors<'_>) -> Option<Vec<f64>> {
    let found = line.words.len();
    if found != count {
        let message = match count {
            2 => format!("expected two numbers `x,value`, found {found}"),
            _ => format!("expected {count} numbers as on the first line, found {found}"),
        };
        errors.at(line.number, 1, message);
        return None;
    }
    (0..count).map(|place| errors.number(line, place, "")).collect()
}

/// Adds a knot, which must exceed the one before.
fn push(
    knots: &mut Vec<f64>,
    knot: f64,
    (line, column): (usize, usize),
    errors: &mut LineErrors<'_>,
) {
    if let Some(before) = knots.last().filter(|before| knot <= **before) {
        let message = format!("{knot} follows {before}, but knots must increase; sort them");
        errors.at(line, column, message);
    }
    knots.push(knot);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wrong(text: &str) -> Vec<String> {
        let mistakes = parse(text, "t.csv").expect_err("should be wrong");
        mistakes.iter().map(Diagnostic::to_string).collect()
    }

    #[test]
    fn curves_and_grids() {
        let curve = parse("# x, value\n 0, 1\n\n0.5,4 # middle\n1,9\n", "t.csv");
        let (x, values) = (vec![0.0, 0.5, 1.0], vec![1.0, 4.0, 9.0]);
        assert_eq!(curve, Ok(TableData { x, y: vec![], values }));
        let grid = parse(", 1, 2, 4\n-1, 10, 20, 40\n3, 11, 21, 41\n", "t.csv");
        let (x, y) = (vec![1.0, 2.0, 4.0], vec![-1.0, 3.0]);
        assert_eq!(grid, Ok(TableData { x, y, values: vec![10.0, 20.0, 40.0, 11.0, 21.0, 41.0] }));
    }

    #[test]
    fn a_file_of_another_kind_is_not_told_line_by_line() {
        for text in [
            "word\n".repeat(100_000),
            ",1\n".to_owned() + &"2\n".repeat(100_000),
            ",x".repeat(100_000),
        ] {
            assert_eq!(wrong(&text).len(), csv::MOST_ERRORS);
        }
    }

    #[test]
    fn every_mistake_has_its_line() {
        assert_eq!(
            wrong("x,value\n0,1\n0,2\n1\n2,nan\n"),
            [
                "t.csv:1:1: `x` is not a finite number",
                "t.csv:3:1: 0 follows 0, but knots must increase; sort them",
                "t.csv:4:1: expected two numbers `x,value`, found 1",
                "t.csv:5:3: `nan` is not a finite number",
            ]
        );
        assert_eq!(
            wrong(",1,0\n0,1,2\n-1,1,2\n1,3\n"),
            [
                "t.csv:1:4: 0 follows 1, but knots must increase; sort them",
                "t.csv:3:1: -1 follows 0, but knots must increase; sort them",
                "t.csv:4:1: expected 3 numbers as on the first line, found 2",
            ]
        );
    }
}
