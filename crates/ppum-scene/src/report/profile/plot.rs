//! Plots of values along curves.

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_figure::plot::{CurveStyle, PlotAxis, PlotCurve, slope, with_slope};

use crate::report::table::NumberTable;

/// Columns of tables that are no quantities.
const PLACES: [&str; 6] = ["s", "r", "theta", "x", "y", "side"];

/// The axis of a variable.
#[must_use]
pub fn axis(variable: Variable) -> PlotAxis {
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

/// The curves of a table of quantities: of a crack with `jumps` opening and sliding, or the jump;
/// else all quantities.
#[must_use]
pub fn columns(
    table: &NumberTable,
    variable: Variable,
    jumps: bool,
    quantities: &NamedQuantities,
) -> Vec<(String, Vec<[f64; 2]>)> {
    let Some(first) = table.column(variable.name()) else { return Vec::new() };
    let names: Vec<&str> = table.names().collect();
    let is_jump = |name: &str| name == "opening" || name == "sliding" || name.starts_with("jump_");
    let is_elastic = names.contains(&"opening");
    let is_asked = |name: &str| quantities.iter().any(|(asked, _)| asked == name);
    let is_wanted = |name: &&&str| match jumps {
        true if is_elastic => **name == "opening" || **name == "sliding",
        true => is_jump(name),
        false => !PLACES.contains(*name) && (!is_jump(name) || is_asked(name)),
    };
    let sides = table.column("side").filter(|_| variable != Variable::Distance);
    let points = |name: &&str| {
        let column = table.column(name)?;
        let points: Vec<_> = first.iter().zip(column).map(|(&x, y)| [x, y]).collect();
        let points = match &sides {
            Some(sides) => broken(&points, sides),
            None if jumps => broken_at_vertices(points),
            None => points,
        };
        Some(((*name).to_owned(), points))
    };
    names.iter().filter(is_wanted).filter_map(points).collect()
}

/// The points of a curve with a gap between the two sides of a crack: where it passes through one,
/// and where it runs along one, then one side after the other.
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

/// Distance of points from a crack's vertices, in parts of its length.
pub(super) const BESIDE: f64 = 1e-9;

/// The points of a crack with a gap at each vertex, before and behind which there is one.
fn broken_at_vertices(points: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    let least = 3.0 * BESIDE * points.last().map_or(0.0, |last| last[0]);
    let is_apart = |a: &[f64; 2], b: &[f64; 2]| b[0] - a[0] > least;
    let pieces: Vec<&[[f64; 2]]> = points.chunk_by(is_apart).collect();
    pieces.join(&[[f64::NAN; 2]][..])
}

/// The part of a ray, one in so many of its points, that is near enough to the tip for the
/// exponent there.
const NEAR: usize = 3;

/// A curve; away from a tip with the exponent of its power law near it, and by its magnitude: on
/// logarithmic axes a negative quantity has no other place.
#[must_use]
pub fn curve(name: String, points: Vec<[f64; 2]>, variable: Variable) -> PlotCurve {
    if variable != Variable::Distance {
        return PlotCurve::new(name, points);
    }
    let is_negative = points.iter().any(|p| p[1] < 0.0);
    let points: Vec<_> = points.into_iter().map(|[r, v]| [r, v.abs()]).collect();
    let shown = if is_negative { format!("|{name}|") } else { name };
    let text = match slope(&points[..points.len() / NEAR]) {
        Some(slope) => with_slope(&shown, slope, 3),
        None => shown,
    };
    PlotCurve::new(text, points).with_look(CurveStyle::Line)
}

/// The symbol of a quantity that stands alone; several have their names in the legend.
#[must_use]
pub fn value_label(quantities: &NamedQuantities, field: &Field<'_>) -> String {
    match quantities {
        [(_, only)] => only.symbol(&field.data.components),
        _ => "value".into(),
    }
}

/// The unit that all quantities have.
#[must_use]
pub fn unit(quantities: &NamedQuantities, field: &Field<'_>) -> String {
    let mut units = quantities.iter().map(|(_, quantity)| quantity.unit(field));
    let first = units.next().unwrap_or(&field.data.unit);
    if units.all(|unit| unit == first) { first.to_owned() } else { String::new() }
}

/// Quantities under their names.
pub type NamedQuantities = [(String, Quantity)];

/// The variable that values along a curve belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    /// Arc length.
    Length,
    /// Angle, degrees.
    Angle,
    /// Distance from a tip, in steps of its logarithm.
    Distance,
}

impl Variable {
    /// Name of its column.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Length => "s",
            Self::Angle => "theta",
            Self::Distance => "r",
        }
    }

    pub(super) fn unit(self) -> &'static str {
        if self == Self::Angle { "deg" } else { "" }
    }
}

#[cfg(test)]
mod tests {
    use ppum::progress::unwatched;
    use ppum_testkit::synthetic::{Recipe, kinked};

    use super::*;
    use crate::report::profile::ProfileCurve;

    /// Opening and sliding are resolved along the crack's normal, which turns at a kink: the curves
    /// break there, at the kink alone, and each piece ends with the values of its own side.
    #[test]
    fn opening_breaks_at_kinks() {
        let crack = kinked();
        let (first, second) = (crack.edge(0), crack.edge(1));
        let recipe = Recipe { components: 2, cracks: vec![crack], ..Recipe::random(4) };
        let dataset = recipe.dataset();
        let field = Field::new(&dataset, 0).unwrap();
        let profile = ProfileCurve::Crack { index: 0 };
        let table = profile.drawn(&field, &[], 61, unwatched()).unwrap().table;
        let curves = columns(&table, Variable::Length, true, &[]);
        let at = first.length();
        for (name, points) in &curves {
            let pieces: Vec<_> = points.split(|p| p[1].is_nan()).collect();
            assert_eq!(pieces.len(), 2, "{name}");
            let [before, behind] = [pieces[0][pieces[0].len() - 1], pieces[1][0]];
            assert!(before[0] < at && at < behind[0] && behind[0] - before[0] < 1e-8, "{name}");
        }
        // the jump of the displacement is one, and its parts along both normals are given
        let turn = |k: usize| {
            let points = &curves[k].1;
            let gap = points.iter().position(|p| p[1].is_nan()).unwrap();
            [points[gap - 1][1], points[gap + 1][1]]
        };
        let ([o, p], [s, t]) = (turn(0), turn(1));
        assert!((o.hypot(s) / p.hypot(t) - 1.0).abs() < 1e-6);
        let [a, b] = [first, second].map(|edge| edge.to - edge.from);
        let angle = (a.x * b.y - a.y * b.x).atan2(a.dot(b));
        let rotated = (o * t - s * p).atan2(o * p + s * t);
        assert!((rotated.abs() - angle.abs()).abs() < 1e-6, "{rotated} {angle}");
    }
}
