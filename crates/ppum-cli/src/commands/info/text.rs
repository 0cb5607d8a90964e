//! The report for people.

use std::io::{self, Write};

use ppum::formula::one_line;
use ppum::text::{Places, trimmed};
use ppum_solve::report::word;

use super::formulas::{QuantityRow, TableRow};
use super::growth::GrowthRow;
use super::reactions::largest_force;
use super::report::{CrackRow, EquationRow, FieldRow, HistoryRow, HoleRow, Report, StepReport};
use super::series::table as table_of_steps;
use super::solver::SolverRow;
use crate::families::Family;
use crate::number::count;
use crate::tips::table;

/// Width of the column of names.
const NAME: usize = 12;

pub(super) fn write(out: &mut dyn Write, report: &Report) -> io::Result<()> {
    let places = &report.places;
    let point = |p: [f64; 2]| places.show(p.into());
    let mut page = Page(out);
    page.line("title", &report.title)?;
    page.line("program", &report.program)?;
    page.line("equation", &equation(&report.equation))?;
    let [min, max] = [report.domain.min, report.domain.max].map(point);
    page.line("domain", &format!("{min} to {max}"))?;
    page.lines("holes", report.domain.holes.iter().map(|row| hole(row, places)))?;
    page.lines("tables", report.tables.iter().map(table_row))?;
    page.lines("defined", report.quantities.iter().map(quantity))?;
    if report.count > 1 {
        page.line("steps", &format!("{}, numbered from 0", report.count))?;
    }
    if let Some(rows) = &report.series {
        writeln!(page.0)?;
        return table_of_steps(page.0, rows);
    }
    report.steps.iter().try_for_each(|step| page.step(step, report))
}

struct Page<'a>(&'a mut dyn Write);

impl Page<'_> {
    fn line(&mut self, name: &str, text: &str) -> io::Result<()> {
        writeln!(self.0, "{name:NAME$} {text}")
    }

    /// The first line carries the name; nothing is written without lines.
    fn lines(&mut self, name: &str, lines: impl Iterator<Item = String>) -> io::Result<()> {
        for (k, text) in lines.enumerate() {
            self.line(if k == 0 { name } else { "" }, &text)?;
        }
        Ok(())
    }

    fn step(&mut self, step: &StepReport, report: &Report) -> io::Result<()> {
        let Report { places, domain, .. } = report;
        if report.count > 1 {
            writeln!(self.0)?;
            self.line("step", &format!("{}, load {}", step.step, trimmed(step.load)))?;
        }
        self.line("patches", &cover(step))?;
        self.lines("weight", weight(step).into_iter())?;
        let levels = step.levels.iter().map(|l| format!("level {}: {}", l.level, l.cells));
        self.line("cells", &format!("{} ({})", step.cells, joined(levels)))?;
        let orders = step.orders.iter().map(|o| format!("order {}: {}", o.order, o.patches));
        self.line("orders", &joined(orders))?;
        self.lines("cracks", step.cracks.iter().map(|row| crack(row, places)))?;
        self.lines("functions", functions(&step.families).into_iter())?;
        self.lines("fields", step.fields.iter().map(field))?;
        self.line("unknowns", &step.unknowns.to_string())?;
        self.lines("solver", step.solver.iter().map(SolverRow::line))?;
        self.lines("history", step.other_history.iter().map(history))?;
        self.lines("growth", step.growth.iter().flat_map(GrowthRow::lines))?;
        self.lines("quantities", wrapped(&step.quantities).into_iter())?;
        self.lines("of cells", wrapped(&step.cell_values).into_iter())?;
        if let Some(solver) = &step.solver {
            solver.write(self.0)?;
        }
        if !step.intensities.is_empty() {
            writeln!(self.0, "\nstress intensity factors")?;
            table(self.0, &step.all_tips, places)?;
        }
        if !step.reactions.is_empty() {
            writeln!(self.0, "\nreactions of the supports on the plate")?;
        }
        let force = largest_force(&step.reactions);
        let arm = (domain.max[0] - domain.min[0]).max(domain.max[1] - domain.min[1]);
        for reaction in &step.reactions {
            writeln!(self.0, "{}", reaction.line(places, [force, force * arm]))?;
        }
        if !step.warnings.is_empty() {
            writeln!(self.0, "\nwarnings")?;
        }
        for warning in &step.warnings {
            writeln!(self.0, "{}", warning.message())?;
        }
        Ok(())
    }
}

/// The functions in families, with their numbers in front.
fn functions(families: &[Family]) -> Vec<String> {
    let numbers: Vec<_> = families.iter().map(Family::numbers).collect();
    let width = numbers.iter().map(|text| text.chars().count()).max().unwrap_or(0);
    let lines = families.iter().zip(numbers).flat_map(|(family, numbers)| {
        let blocks = count(family.blocks, "block", "blocks");
        let title = format!("{numbers:width$}  {} in {blocks}", family.title());
        let formula = |text: &String| format!("{:width$}    {}", "", one_line(text));
        [title].into_iter().chain(family.formulas.iter().map(formula)).collect::<Vec<_>>()
    });
    lines.collect()
}

fn quantity(row: &QuantityRow) -> String {
    let unit = if row.unit.is_empty() { String::new() } else { format!(" [{}]", row.unit) };
    format!("{}{unit} = {}", row.name, one_line(&row.formula))
}

fn hole(row: &HoleRow, places: &Places) -> String {
    let point = |p: [f64; 2]| places.show(p.into());
    match row {
        HoleRow::Circle { center, radius } => {
            format!("circle around {}, radius {}", point(*center), trimmed(*radius))
        }
        HoleRow::Polygon { points } => {
            let points: Vec<_> = points.iter().copied().map(point).collect();
            format!("polygon {}", points.join(" – "))
        }
    }
}

fn table_row(row: &TableRow) -> String {
    let range = |knots: &[f64]| {
        let [first, last] = [knots[0], knots[knots.len() - 1]].map(trimmed);
        format!("{} from {first} to {last}", count(knots.len(), "knot", "knots"))
    };
    match row.y.as_slice() {
        [] => format!("{}(x): {}", row.name, range(&row.x)),
        y => format!("{}(x, y): {}, {}", row.name, range(&row.x), range(y)),
    }
}

fn weight(step: &StepReport) -> Option<String> {
    let places = joined(step.weight_breakpoints.iter().map(|&t| trimmed(t)));
    let at = if places.is_empty() { String::new() } else { format!(", breakpoints {places}") };
    (step.weight == "formula").then(|| format!("{}{at}", one_line(&step.weight_formula)))
}

fn joined(parts: impl Iterator<Item = String>) -> String {
    parts.collect::<Vec<_>>().join(", ")
}

/// Lines of names, as long as they fit the screen.
fn wrapped(names: &[String]) -> Vec<String> {
    let mut lines = vec![String::new()];
    for name in names {
        if lines.last().is_some_and(|line| line.len() + name.len() > 78 - NAME) {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            line.push_str(if line.is_empty() { "" } else { " " });
            line.push_str(name);
        }
    }
    lines
}

fn equation(equation: &EquationRow) -> String {
    match equation {
        EquationRow::Elasticity { young, poisson, state } => {
            format!("elasticity, E {young}, ν {poisson}, {state}")
        }
        EquationRow::Poisson { conductivity } => format!("Poisson, κ {conductivity}"),
    }
}

fn cover(step: &StepReport) -> String {
    let points = match step.points {
        0 => String::new(),
        n => format!(", from {}", count(n, "point", "points")),
    };
    format!("{}, {} weight{points}", step.patches, step.weight)
}

fn crack(crack: &CrackRow, places: &Places) -> String {
    let point = |p: [f64; 2]| places.show(p.into());
    let points: Vec<_> = crack.points.iter().copied().map(point).collect();
    let [start, end] = crack.ends;
    format!("{start} {} {end}", points.join(" – "))
}

fn field(field: &FieldRow) -> String {
    let unit = if field.unit.is_empty() { String::new() } else { format!(" [{}]", field.unit) };
    let exact = if field.exact.is_empty() { "" } else { ", exact solution known" };
    format!("{}{unit}: {}{exact}", field.name, field.components.join(", "))
}

fn history(row: &HistoryRow) -> String {
    let value = row.value.0;
    let shown = word(&row.name, value).map_or_else(|| trimmed(value), str::to_owned);
    format!("{} {shown} {}", row.name, row.unit).trim_end().to_owned()
}
