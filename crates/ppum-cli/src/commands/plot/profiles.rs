//! Quantities along lines, cracks and circles.

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_figure::plot::{Curve, Look, Plot, PlotAxis, slope, with_slope};

use super::{Named, label};
use crate::dataset::{field, quantities};
use crate::profile::{Profile, Table, Variable};

/// Columns of tables that are no quantities.
const PLACES: [&str; 6] = ["s", "r", "theta", "x", "y", "side"];

/// A curve for each quantity of each dataset.
pub(super) fn plot(
    datasets: &[Named],
    profile: &Profile,
    wanted: &[String],
    step: Option<usize>,
) -> anyhow::Result<Plot> {
    let variable = profile.variable();
    let mut plot = Plot { x: axis(variable), ..Plot::default() };
    for named in datasets {
        let field = field(&named.dataset, step)?;
        let quantities = asked(&field, wanted, profile)?;
        let table = profile.drawn(&field, &quantities)?;
        for (name, points) in columns(&table, variable, wanted.is_empty() && profile.is_crack()) {
            let name = label(datasets, named, &name);
            plot.curves.push(curve(name, points, variable));
        }
        plot.title.clone_from(&named.dataset.title);
        plot.y = PlotAxis::new(value_label(&quantities, &field), unit(&quantities, &field));
    }
    if profile.is_crack() && wanted.is_empty() {
        plot.y.label = "displacement jump".into();
    }
    if datasets.len() > 1 && datasets.iter().any(|named| named.dataset.title != plot.title) {
        plot.title.clear();
    }
    if variable == Variable::Distance {
        plot.y = plot.y.logarithmic();
    }
    Ok(plot)
}

fn axis(variable: Variable) -> PlotAxis {
    match variable {
        Variable::Length => PlotAxis::new("s", ""),
        Variable::Angle => PlotAxis {
            range: Some([-180.0, 180.0]),
            marks: vec![-180.0, -90.0, 0.0, 90.0, 180.0],
            ..PlotAxis::new("θ", "°")
        },
        Variable::Distance => PlotAxis::new("r", "").logarithmic(),
    }
}

/// The quantities that were asked for; along a crack none are needed, elsewhere one that every field has.
fn asked(
    field: &Field<'_>,
    wanted: &[String],
    profile: &Profile,
) -> anyhow::Result<Vec<(String, Quantity)>> {
    if !wanted.is_empty() || profile.is_crack() {
        return quantities(field, wanted);
    }
    let usual = if field.equation.elastic().is_some() { "von-mises" } else { "gradient" };
    quantities(field, &[usual.to_owned()])
}

/// The curves of a table: of a crack without quantities opening and sliding, or the jump; else all quantities.
fn columns(table: &Table, variable: Variable, jumps: bool) -> Vec<(String, Vec<[f64; 2]>)> {
    let Some(first) = table.column(variable.name()) else { return Vec::new() };
    let names: Vec<&str> = table.names().collect();
    let is_jump = |name: &str| name == "opening" || name == "sliding" || name.starts_with("jump_");
    let is_elastic = names.contains(&"opening");
    let is_wanted = |name: &&&str| match jumps {
        true if is_elastic => **name == "opening" || **name == "sliding",
        true => is_jump(name),
        false => !PLACES.contains(*name) && !is_jump(name),
    };
    let sides = table.column("side").filter(|_| variable != Variable::Distance);
    let points = |name: &&str| {
        let column = table.column(name)?;
        let points: Vec<_> = first.iter().zip(column).map(|(&x, y)| [x, y]).collect();
        let points = match &sides {
            Some(sides) => broken(&points, sides),
            None => points,
        };
        Some(((*name).to_owned(), points))
    };
    names.iter().filter(is_wanted).filter_map(points).collect()
}

/// The points of a curve with a gap between the two sides of a crack: where it passes through one, and where it runs
/// along one, then one side after the other.
fn broken(points: &[[f64; 2]], sides: &[f64]) -> Vec<[f64; 2]> {
    let mut all = Vec::with_capacity(points.len());
    let mut start = 0;
    for run in sides.chunk_by(|a, b| (*a == 0.0) == (*b == 0.0)) {
        let points = &points[start..start + run.len()];
        start += run.len();
        let is_first = |k: &usize| run[*k] == run[0];
        all.extend((0..run.len()).filter(is_first).map(|k| points[k]));
        if run.iter().any(|side| *side != run[0]) {
            all.push([f64::NAN; 2]);
            all.extend((0..run.len()).filter(|k| !is_first(k)).map(|k| points[k]));
        }
    }
    all
}

/// The part of a ray, one in so many of its points, that is near enough to the tip for the exponent there.
const NEAR: usize = 3;

/// A curve; away from a tip with the exponent of its power law near it, and by its magnitude: on logarithmic axes a
/// negative quantity has no other place.
fn curve(name: String, points: Vec<[f64; 2]>, variable: Variable) -> Curve {
    if variable != Variable::Distance {
        return Curve::new(name, points);
    }
    let is_negative = points.iter().any(|p| p[1] < 0.0);
    let points: Vec<_> = points.into_iter().map(|[r, v]| [r, v.abs()]).collect();
    let shown = if is_negative { format!("|{name}|") } else { name };
    let text = match slope(&points[..points.len() / NEAR]) {
        Some(slope) => with_slope(&shown, slope, 3),
        None => shown,
    };
    Curve::new(text, points).with_look(Look::Line)
}

/// The symbol of a quantity that stands alone; several have their names in the legend.
fn value_label(quantities: &[(String, Quantity)], field: &Field<'_>) -> String {
    match quantities {
        [(_, only)] => only.symbol(&field.data.components),
        _ => "value".into(),
    }
}

/// The unit that all quantities have.
fn unit(quantities: &[(String, Quantity)], field: &Field<'_>) -> String {
    let mut units = quantities.iter().map(|(_, quantity)| quantity.unit(field));
    let first = units.next().unwrap_or(&field.data.unit);
    if units.all(|unit| unit == first) { first.to_owned() } else { String::new() }
}
