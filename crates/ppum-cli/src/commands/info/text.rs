//! The report for people.

use std::io::{self, Write};

use ppum::formula::one_line;
use ppum::text::trimmed;
use ppum_scene::facts::{GrowthFacts, SolverFacts, reaction_lines};

use super::formulas::{QuantityRow, TableRow};
use super::report::{FieldRow, InfoReport, MeshRow, StepReport};
use super::series::table as table_of_steps;
use crate::families::Family;
use crate::number::{NamedLines, count};
use crate::tips::table;

pub(super) fn write(out: &mut dyn Write, report: &InfoReport) -> io::Result<()> {
    let places = &report.places;
    let mut page = NamedLines(out);
    for (name, text) in report.about.lines(places) {
        page.line(name, &text)?;
    }
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

impl NamedLines<'_> {
    fn step(&mut self, step: &StepReport, report: &InfoReport) -> io::Result<()> {
        let (places, results) = (&report.places, &step.results);
        if report.count > 1 {
            writeln!(self.0)?;
            self.line("step", &format!("{}, load {}", step.step, trimmed(step.load)))?;
        }
        self.line("patches", &cover(step))?;
        self.lines("weight", weight(step))?;
        let levels = step.levels.iter().map(|l| format!("level {}: {}", l.level, l.cells));
        if step.cells > 0 {
            self.line("cells", &format!("{} ({})", step.cells, joined(levels)))?;
        }
        let orders = step.orders.iter().map(|o| format!("order {}: {}", o.order, o.patches));
        self.line("orders", &joined(orders))?;
        self.lines("cracks", step.cracks.iter().map(|crack| crack.line(places)))?;
        self.lines("functions", functions(&step.families))?;
        self.lines("fields", step.fields.iter().map(field))?;
        self.line("unknowns", &results.unknowns.to_string())?;
        self.lines("solver", results.solver.iter().map(SolverFacts::line))?;
        self.lines("history", step.other_history.iter().cloned())?;
        self.lines("growth", results.growth.iter().flat_map(GrowthFacts::lines))?;
        self.lines("quantities", wrapped(&step.quantities))?;
        self.lines("of faces", wrapped(&step.face_quantities))?;
        let owners = if step.cells > 0 { "of cells" } else { "of patches" };
        self.lines(owners, wrapped(&step.cell_values))?;
        if let Some(solver) = &results.solver {
            solver.write(self.0)?;
        }
        if !results.intensities.is_empty() {
            writeln!(self.0, "\nstress intensity factors")?;
            table(self.0, &results.tips, places)?;
        }
        if !results.reactions.is_empty() {
            writeln!(self.0, "\nreactions of the supports on the plate")?;
        }
        for line in reaction_lines(&results.reactions, places, report.arm) {
            writeln!(self.0, "{line}")?;
        }
        if !results.warnings.is_empty() {
            writeln!(self.0, "\nwarnings")?;
        }
        for warning in &results.warnings {
            writeln!(self.0, "{}", warning.message)?;
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
fn wrapped(names: &[impl AsRef<str>]) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for name in names.iter().map(AsRef::as_ref) {
        if lines.last().is_none_or(|line| line.len() + name.len() > 78 - NamedLines::NAME) {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            line.push_str(if line.is_empty() { "" } else { " " });
            line.push_str(name);
        }
    }
    lines
}

fn cover(step: &StepReport) -> String {
    if let Some(mesh) = &step.mesh {
        return elements(step.patches, mesh);
    }
    let points = match step.points {
        0 => String::new(),
        n => format!(", from {}", count(n, "point", "points")),
    };
    format!("{}, {} weight{points}", step.patches, step.weight)
}

/// The patches of a mesh: their shapes, the degrees of their maps, how many are cut.
fn elements(patches: usize, mesh: &MeshRow) -> String {
    let shapes = [(mesh.triangles, "triangle", "triangles"), (mesh.squares, "square", "squares")];
    let shapes =
        shapes.into_iter().filter(|(n, ..)| *n > 0).map(|(n, one, all)| count(n, one, all));
    let elements = count(mesh.elements, "element", "elements");
    let degrees = match mesh.map_degrees {
        [low, high] if low == high => format!("degree {low}"),
        [low, high] => format!("degrees {low} to {high}"),
    };
    let cut = if mesh.clipped > 0 { format!(", {} clipped", mesh.clipped) } else { String::new() };
    format!("{patches}, {} of {elements}, maps of {degrees}{cut}", joined(shapes))
}

fn field(field: &FieldRow) -> String {
    let unit = if field.unit.is_empty() { String::new() } else { format!(" [{}]", field.unit) };
    let exact = if field.exact.is_empty() { "" } else { ", exact solution known" };
    format!("{}{unit}: {}{exact}", field.name, field.components.join(", "))
}
