//! Lists of points.

use std::path::Path;

use anyhow::{Context as _, bail, ensure};
use ppum::vec2::{Vec2, vec2};

use crate::standard::{self, is_standard};
use ppum_scene::profile::MOST;

/// Longest file of points, in bytes: those of [`MOST`] points in all digits.
const LONGEST: u64 = 1 << 30;

/// The points of a text file: lines with x and y apart by commas, semicolons or blanks; more
/// columns are ignored, and so are a first line of names, empty lines and what follows `#`.
pub(super) fn read(path: &Path) -> anyhow::Result<Vec<Vec2>> {
    let context = || format!("cannot read {}", path.display());
    let text = match is_standard(path) {
        true => standard::text("the list of points")?,
        false => ppum_file::text(path, LONGEST).with_context(context)?,
    };
    let name = standard::name(path);
    let mut points = Vec::new();
    let mut is_head = true;
    for (k, line) in (1..).zip(text.lines()) {
        let line = line.split('#').next().unwrap_or_default().trim();
        if line.is_empty() {
            continue;
        }
        match point(line) {
            Some(point) => points.push(point),
            None if is_head
                && !line.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)) => {}
            None => bail!("{name}:{k}: expected two finite numbers: x,y"),
        }
        is_head = false;
        ensure!(points.len() <= MOST, "{name}:{k}: more than {MOST} points");
    }
    ensure!(!points.is_empty(), "{name}: has no points");
    Ok(points)
}

fn point(line: &str) -> Option<Vec2> {
    let parts = line.split([',', ';', ' ', '\t']).filter(|part| !part.is_empty());
    let numbers: Vec<f64> = parts.take(2).map_while(|part| part.parse().ok()).collect();
    match numbers[..] {
        [x, y] if x.is_finite() && y.is_finite() => Some(vec2(x, y)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_of_a_file() {
        let file = tempfile::NamedTempFile::new().expect("a file");
        let with = |text: &str| {
            std::fs::write(file.path(), text).expect("written");
            read(file.path()).map_err(|e| e.to_string())
        };
        let two = Ok(vec![vec2(1.0, -2.5), vec2(0.0, 1e-3)]);
        assert_eq!(with("x,y\n1,-2.5\n\n0,1e-3 # tip\n"), two);
        assert_eq!(with("1; -2.5; 7\n  0\t1e-3"), two);
        for (text, hint) in [
            ("", "no points"),
            ("x,y\n", "no points"),
            ("1,2\nx,y", ":2: "),
            ("1,inf", ":1: "),
            ("1", ":1: "),
        ] {
            let error = with(text).expect_err(text);
            assert!(error.contains(hint), "{text}: {error}");
        }
    }
}
