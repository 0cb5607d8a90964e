//! The report for people.

use std::io::{self, Write};

use ppum::formula::one_line;
use ppum::text::trimmed;

use crate::number::NamedLines;

use super::report::{Derivative, FormulaFacts, FormulaReport, ZeroSet};

/// Longest line of a formula, and most lines.
const WIDTH: usize = 88;
const LINES: usize = 12;

pub(super) fn write(out: &mut dyn Write, report: &FormulaReport) -> io::Result<()> {
    for (k, row) in report.formulas.iter().enumerate() {
        if k > 0 {
            writeln!(out)?;
        }
        NamedLines(out).formula(row)?;
    }
    Ok(())
}

/// A module of WGSL: the functions, each with its formula above, and what they call.
pub(super) fn write_wgsl(out: &mut dyn Write, report: &FormulaReport) -> io::Result<()> {
    write!(out, "{}", report.wgsl_prelude.unwrap_or_default())?;
    for row in &report.formulas {
        let by: Vec<_> = row.derivatives.iter().map(symbol).collect();
        writeln!(out, "\n// {}: {}", one_line(&row.text), by.join(", "))?;
        write!(out, "{}", row.wgsl.as_deref().unwrap_or_default())?;
    }
    Ok(())
}

impl NamedLines<'_> {
    fn formula(&mut self, row: &FormulaFacts) -> io::Result<()> {
        if let Some(name) = &row.name {
            self.line("name", name)?;
        }
        self.lines("formula", shown(&row.text))?;
        self.line("of", kind(&row.of))?;
        let uses = if row.uses.is_empty() { "no variable".into() } else { row.uses.join(", ") };
        self.line("uses", &uses)?;
        let parameters =
            row.parameters.iter().map(|p| format!("{} = {}", p.name, trimmed(p.value.0)));
        self.lines("parameters", parameters)?;
        for derivative in &row.derivatives {
            self.lines(&symbol(derivative), shown(&derivative.text))?;
        }
        self.smoothness(row)?;
        self.line("operations", &operations(&row.operations))?;
        self.values(row)
    }

    fn smoothness(&mut self, row: &FormulaFacts) -> io::Result<()> {
        self.lines("kinks", sets(&row.kinks))?;
        self.lines("singular", singular(row))?;
        if row.kinks.is_empty() && singular(row).is_empty() {
            self.line("smooth", "no kinks, no singular points")?;
        }
        if row.jumps_with_theta {
            self.line("jumps", "where theta does: on the crack, or behind the origin")?;
        }
        let Some(breakpoints) = &row.breakpoints else { return Ok(()) };
        let places = breakpoints.iter().map(|&t| trimmed(t)).collect::<Vec<_>>().join(", ");
        self.line("breakpoints", if places.is_empty() { "none in [0, 1]" } else { &places })?;
        let verdict = row.not_a_weight.as_deref().map_or("can be one", |reason| reason);
        self.lines("weight", shown(verdict))
    }

    fn values(&mut self, row: &FormulaFacts) -> io::Result<()> {
        let Some(at) = &row.at else { return Ok(()) };
        let point = at.shown.iter().map(|(name, value)| format!("{name} = {value:?}"));
        self.line("at", &point.collect::<Vec<_>>().join(", "))?;
        for derivative in &row.derivatives {
            let Some(value) = derivative.value else { continue };
            let sign = if value.0.is_sign_negative() { "" } else { " " };
            self.line(&format!("  {}", symbol(derivative)), &format!("{sign}{:?}", value.0))?;
        }
        Ok(())
    }
}

fn kind(of: &str) -> &str {
    match of {
        "plane" => "the plane: x, y, r, theta",
        "weight" => "weights: t = |ξ|, 0 ≤ t < 1",
        "elasticity" => "quantities of elasticity",
        "poisson" => "quantities of Poisson problems",
        file => file,
    }
}

/// `value`, `∂/∂x`, `∂²/∂x∂y`, `∂²/∂x²`.
fn symbol(derivative: &Derivative) -> String {
    match derivative.by.as_slice() {
        [] => "value".into(),
        [x] => format!("∂/∂{x}"),
        [x, y] if x == y => format!("∂²/∂{x}²"),
        by => format!("∂²/∂{}", by.join("∂")),
    }
}

fn singular(row: &FormulaFacts) -> Vec<String> {
    let is_told = row.singularities.iter().any(|set| set.zeros_of == "r");
    let origin = (row.singular_at_origin && !is_told).then(|| "the origin, maybe".to_owned());
    origin.into_iter().chain(sets(&row.singularities)).collect()
}

fn sets(sets: &[ZeroSet]) -> Vec<String> {
    let equation = |set: &ZeroSet| format!("{} = 0", set.zeros_of.replace('\n', " "));
    let (shown, rest) = sets.split_at(sets.len().min(LINES));
    let rest = (!rest.is_empty()).then(|| format!("… {} more", rest.len()));
    shown.iter().map(|set| shortened(&equation(set))).chain(rest).collect()
}

fn shortened(line: &str) -> String {
    if line.chars().count() <= WIDTH {
        return line.to_owned();
    }
    line.chars().take(WIDTH - 1).chain(['…']).collect()
}

fn operations(counts: &[usize]) -> String {
    let what = ["the value", "with first derivatives", "with second derivatives"];
    let part = |(count, what): (&usize, &str)| format!("{count} {what}");
    counts.iter().zip(what).map(part).collect::<Vec<_>>().join(", ")
}

/// The lines of a formula as they fit the screen, and a word about those that do not.
fn shown(text: &str) -> Vec<String> {
    let mut lines: Vec<_> = text.lines().flat_map(wrapped).collect();
    if lines.len() > LINES + 1 {
        let (more, length) = (lines.len() - LINES, text.chars().count());
        lines.truncate(LINES);
        lines.push(format!("… {more} more lines, {length} characters in all; --json has them"));
    }
    lines
}

/// A line broken at blanks; what follows is indented.
fn wrapped(line: &str) -> Vec<String> {
    let mut lines = vec![String::new()];
    for word in line.split(' ') {
        let last = lines.last_mut().expect("there is one line at least");
        if !last.trim().is_empty() && last.chars().count() + 1 + word.chars().count() > WIDTH {
            lines.push(format!("  {word}"));
        } else {
            if !last.is_empty() {
                last.push(' ');
            }
            last.push_str(word);
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_are_broken_and_long_texts_cut() {
        assert_eq!(shown("x + y"), ["x + y"]);
        let lines = shown(&"abcdefghi ".repeat(20));
        assert_eq!(lines.len(), 3);
        assert!(lines.iter().all(|line| line.chars().count() <= WIDTH), "{lines:?}");
        assert!(lines[1].starts_with("  abc"));
        let lines = shown(&"x\n".repeat(20));
        assert_eq!(lines.len(), LINES + 1);
        let rest = format!("… {} more lines, 40 characters", 20 - LINES);
        assert!(lines[LINES].starts_with(&rest), "{lines:?}");
    }
}
