//! Files of scattered points.

use std::path::Path;

use ppum::vec2::Vec2;

use super::csv::{self, CsvLine, LineErrors};
use crate::data::Diagnostic;

/// Reads a file of points: `x,y` a line, empty lines and what follows `#` left out.
///
/// # Errors
/// One error per line that is not a finite `x,y`, or equals an earlier one; or one for the file.
pub(crate) fn read(path: &Path) -> Result<Vec<Vec2>, Vec<Diagnostic>> {
    let text = csv::read(path, "points")?;
    let points = parse(&text, &path.display().to_string())?;
    if points.is_empty() {
        let message = "there are no points; write one `x,y` per line".to_owned();
        return Err(vec![csv::of_file(path, message)]);
    }
    Ok(points)
}

fn parse(text: &str, file: &str) -> Result<Vec<Vec2>, Vec<Diagnostic>> {
    let (mut points, mut errors) = (Vec::new(), LineErrors::new(file));
    let mut lines = csv::lines(text);
    while let Some(line) = lines.next().filter(|_| !errors.is_full()) {
        points.extend(point(&line, &mut errors).map(|point| (line.number, point)));
    }
    for (second, first) in duplicates(&points).into_iter().take(csv::MOST_ERRORS) {
        let message = format!("the same point as on line {first}; remove one of them");
        errors.at(second, 1, message);
    }
    errors.or(points.into_iter().map(|(_, p)| p).collect())
}

fn point(line: &CsvLine<'_>, errors: &mut LineErrors<'_>) -> Option<Vec2> {
    // −0 becomes 0: equal points sort next to each other
    let number = |place| Some(errors.number(line, place, "; write `x,y`")? + 0.0);
    let values = (0..line.words.len()).map(number).collect::<Option<Vec<_>>>()?;
    if let [x, y] = values[..] {
        return Some(Vec2 { x, y });
    }
    errors.at(line.number, 1, format!("expected two numbers `x,y`, found {}", values.len()));
    None
}

/// The lines of points that equal an earlier one, and the lines of those: no cell can hold at most
/// one of them.
fn duplicates(points: &[(usize, Vec2)]) -> Vec<(usize, usize)> {
    let mut sorted: Vec<_> = points.iter().collect();
    sorted.sort_by(|(m, a), (n, b)| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(m.cmp(n)));
    let equal = sorted.windows(2).filter(|pair| pair[0].1 == pair[1].1);
    let mut lines: Vec<_> = equal.map(|pair| (pair[1].0, pair[0].0)).collect();
    lines.sort_unstable();
    lines
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
        assert_eq!(wrong(&"word\n".repeat(100_000)).len(), csv::MOST_ERRORS);
        assert_eq!(wrong(&"1,2\n".repeat(100_000)).len(), csv::MOST_ERRORS);
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
