//! Files of scattered points.

use std::path::Path;

use ppum::vec2::Vec2;

use super::csv::{self, CsvLine, mistake};
use super::error::Diagnostic;

/// Reads a file of points: `x,y` a line, empty lines and what follows `#` left out.
///
/// # Errors
/// One error per line that is not a finite `x,y`, or equals an earlier one; or one for the file.
pub(super) fn read(path: &Path) -> Result<Vec<Vec2>, Vec<Diagnostic>> {
    let text = csv::read(path, "points").map_err(|mistake| vec![mistake])?;
    let points = parse(&text, &path.display().to_string())?;
    if points.is_empty() {
        let message = "there are no points; write one `x,y` per line".to_owned();
        return Err(vec![csv::of_file(path, message)]);
    }
    Ok(points)
}

fn parse(text: &str, file: &str) -> Result<Vec<Vec2>, Vec<Diagnostic>> {
    let (mut points, mut mistakes) = (Vec::new(), Vec::new());
    for line in csv::lines(text) {
        match point(&line) {
            Ok(point) => points.push((line.number, point)),
            Err((column, message)) => mistakes.push(mistake(file, line.number, column, message)),
        }
        if csv::is_enough(&mistakes) {
            return Err(mistakes);
        }
    }
    mistakes.extend(duplicates(&points, file));
    if mistakes.is_empty() {
        Ok(points.into_iter().map(|(_, p)| p).collect())
    } else {
        Err(mistakes)
    }
}

/// The point of a line, or the column and the message of what is wrong.
fn point(line: &CsvLine<'_>) -> Result<Vec2, (usize, String)> {
    let mut values = Vec::new();
    for word in &line.words {
        let message = || format!("`{}` is not a finite number; write `x,y`", word.text);
        // −0 becomes 0: equal points sort next to each other
        values.push(word.number().ok_or_else(|| (word.column, message()))? + 0.0);
    }
    let count = values.len();
    let two = <[f64; 2]>::try_from(values);
    two.map(Vec2::from).map_err(|_| (1, format!("expected two numbers `x,y`, found {count}")))
}

/// Points that equal an earlier one: no cell can hold at most one of them.
fn duplicates(points: &[(usize, Vec2)], file: &str) -> Vec<Diagnostic> {
    let mut sorted: Vec<_> = points.iter().collect();
    sorted.sort_by(|(m, a), (n, b)| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(m.cmp(n)));
    let equal = sorted.windows(2).filter(|pair| pair[0].1 == pair[1].1);
    let mut lines: Vec<_> = equal.map(|pair| (pair[1].0, pair[0].0)).collect();
    lines.sort_unstable();
    let message = |first| format!("the same point as on line {first}; remove one of them");
    lines.truncate(csv::MOST_FINDINGS);
    lines.into_iter().map(|(second, first)| mistake(file, second, 1, message(first))).collect()
}

#[cfg(test)]
mod tests {
    use ppum::vec2::vec2;

    use super::*;

    fn wrong(text: &str) -> Vec<String> {
        let mistakes = parse(text, "p.csv").expect_err("should be wrong");
        mistakes.iter().map(Diagnostic::to_string).collect()
    }

    #[test]
    fn comments_spaces_and_empty_lines() {
        let points = parse("\u{feff}# x,y\n\n 0.5 , -1e-1 # first\r\n1,2\n", "p.csv");
        assert_eq!(points, Ok(vec![vec2(0.5, -0.1), vec2(1.0, 2.0)]));
    }

    #[test]
    fn every_wrong_line_is_named() {
        let found = wrong("x,y\n1,nan\n1\n1,2,3\n0,0\n1, 2a\n");
        assert_eq!(
            found,
            [
                "p.csv:1:1: `x` is not a finite number; write `x,y`",
                "p.csv:2:3: `nan` is not a finite number; write `x,y`",
                "p.csv:3:1: expected two numbers `x,y`, found 1",
                "p.csv:4:1: expected two numbers `x,y`, found 3",
                "p.csv:6:4: `2a` is not a finite number; write `x,y`",
            ]
        );
    }

    #[test]
    fn a_file_of_another_kind_is_not_told_line_by_line() {
        assert_eq!(wrong(&"word\n".repeat(100_000)).len(), csv::MOST_FINDINGS);
        assert_eq!(wrong(&"1,2\n".repeat(100_000)).len(), csv::MOST_FINDINGS);
    }

    #[test]
    fn equal_points() {
        let found = wrong("1,2\n3,4\n1.0,2.0\n-0.0,1\n0,1\n1,2\n");
        assert_eq!(found.len(), 3);
        assert_eq!(found[0], "p.csv:3:1: the same point as on line 1; remove one of them");
        assert_eq!(found[1], "p.csv:5:1: the same point as on line 4; remove one of them");
        assert_eq!(found[2], "p.csv:6:1: the same point as on line 3; remove one of them");
    }
}
