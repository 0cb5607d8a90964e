//! Values along the curve of a pane, found in the background.

use std::sync::Arc;

use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::{Quantity, QuantityError};
use ppum_figure::plot::{Plot, PlotAxis, PlotCurve, slope, with_slope};
use ppum_render::scale::Scale;
use ppum_scene::list::parts;
use ppum_scene::profile::{
    Profile, ProfileCurve, ProfileError, Variable, axis, columns, curve, unit, value_label,
};
use ppum_scene::quantity::default_quantity;
use ppum_scene::table::NumberTable;

use crate::field::OwnedField;
use crate::same_arc::SameArc;
use crate::session::Pane;
use ppum_scene::location::Location;

/// The request.
#[derive(Clone, Debug, PartialEq)]
pub struct PlotRequest {
    /// The field.
    pub field: SameArc<OwnedField>,
    /// The curve.
    pub along: ProfileCurve,
    /// Quantities or formulas in a list; those that suit if it is empty.
    pub quantities: String,
    /// Number of points.
    pub count: usize,
}

/// The result.
pub type PlotResult = Result<CurveValues, String>;

/// Values along a curve.
#[derive(Debug)]
pub struct CurveValues {
    /// A row for each point, as `ppum sample` writes it.
    pub table: NumberTable,
    /// The curve as it is drawn, both sides where it passes through a crack.
    pub drawn: Profile,
    variable: Variable,
    /// The curves with their names.
    curves: Vec<(String, Vec<[f64; 2]>)>,
    label: String,
    unit: String,
}

impl PlotRequest {
    /// Returns the request of a pane; nothing without a curve. The quantity is that of the image
    /// where none is given: along a crack its opening.
    pub(crate) fn of(pane: &Pane, field: &Arc<OwnedField>) -> Option<Self> {
        let along = pane.curve?;
        let given = pane.plot.quantities.as_deref().map(str::trim).filter(|text| !text.is_empty());
        let shown = || {
            let shown = pane.scene.quantity.as_deref().map(str::trim);
            shown.unwrap_or_else(|| default_quantity(field.field())).to_owned()
        };
        let quantities = match given {
            Some(text) => text.to_owned(),
            None if along.is_crack() => String::new(),
            None => shown(),
        };
        let count = pane.plot.count.clamp(2, MOST);
        Some(Self { field: field.into(), along, quantities, count })
    }

    /// Finds it; nothing if it was stopped.
    #[must_use]
    pub fn find(&self, watcher: &dyn Watcher) -> Option<PlotResult> {
        match self.values(watcher) {
            Err(PlotFault::Profile(ProfileError::Cancelled(_))) => None,
            Err(fault) => Some(Err(fault.to_string())),
            Ok(values) => Some(Ok(values)),
        }
    }

    fn values(&self, watcher: &dyn Watcher) -> Result<CurveValues, PlotFault> {
        let field = self.field.field();
        let named = named(field, &self.quantities)?;
        let table = self.along.table(field, &named, self.count, watcher)?.table;
        let drawn = self.along.drawn(field, &named, self.count.min(DRAWN), watcher)?;
        let (variable, jumps) = (self.along.variable(), self.quantities.is_empty());
        let curves = columns(&drawn.table, variable, jumps, &named);
        let label = if jumps { "displacement jump".into() } else { value_label(&named, field) };
        let unit = unit(&named, field);
        Ok(CurveValues { table, drawn, variable, curves, label, unit })
    }
}

/// Points of a curve that are drawn at most; no window has more pixels side by side.
const DRAWN: usize = 4000;
/// Most points along a curve of the window.
const MOST: usize = 100_000;

#[derive(Debug, thiserror::Error)]
enum PlotFault {
    #[error("`{0}`: {1}")]
    Quantity(String, Box<QuantityError>),
    #[error(transparent)]
    Profile(#[from] ProfileError),
}

/// The quantities of a list under the names that they were given.
fn named(field: &Field<'_>, list: &str) -> Result<Vec<(String, Quantity)>, PlotFault> {
    let parsed = |text: &str| {
        let quantity = Quantity::parse(text, field)
            .and_then(|quantity| quantity.check_at_points(field).map(|()| quantity))
            .map_err(|error| PlotFault::Quantity(text.to_owned(), Box::new(error)))?;
        Ok((text.to_owned(), quantity))
    };
    let texts = parts(list).into_iter().filter(|text| !text.is_empty());
    texts.map(parsed).collect()
}

impl CurveValues {
    /// The plot, its axes logarithmic or not; where both are, each curve with the exponent of its
    /// power law.
    #[must_use]
    pub fn plot(&self, log: [bool; 2]) -> Plot {
        let scale = |axis: PlotAxis, is_log: bool| {
            let scale = if is_log { Scale::Log } else { Scale::Linear };
            PlotAxis { scale, ..axis }
        };
        // an angle has a place on no logarithmic axis
        let mut x = scale(axis(self.variable), log[0]);
        if log[0] {
            (x.range, x.marks) = (None, Vec::new());
        }
        let y = scale(PlotAxis::new(&*self.label, &*self.unit), log[1]);
        let drawn = |(name, points): &(String, Vec<[f64; 2]>)| match (self.variable, log) {
            (Variable::Distance, [true, true]) => {
                curve(name.clone(), points.clone(), self.variable)
            }
            (_, [true, true]) => {
                let label = slope(points).map(|slope| with_slope(name, slope, 3));
                PlotCurve::new(label.unwrap_or_else(|| name.clone()), points.clone())
            }
            _ => PlotCurve::new(name.clone(), points.clone()),
        };
        Plot { x, y, curves: self.curves.iter().map(drawn).collect(), ..Plot::default() }
    }

    /// The row whose variable is nearest to a value, and how the body's point of it is found.
    pub(crate) fn nearest(&self, variable: f64, is_log: bool) -> Option<(usize, Location)> {
        let column = self.drawn.table.column(self.variable.name())?;
        let measure = |v: f64| if is_log { v.ln() } else { v };
        let distance = |v: f64| (measure(v) - measure(variable)).abs();
        let all = column.iter().map(|&v| distance(v)).enumerate().filter(|(_, d)| d.is_finite());
        let (row, _) = all.min_by(|a, b| a.1.total_cmp(&b.1))?;
        let place = self.drawn.places.get(row)?;
        let spot = Location::new(place.anchor, place.offset);
        Some((row, place.on.map_or(spot, |segment| spot.on(segment))))
    }

    /// The points of the curves that belong to a row.
    #[must_use]
    pub fn points(&self, row: usize) -> Vec<[f64; 2]> {
        let Some(first) = self.drawn.table.column(self.variable.name()) else { return Vec::new() };
        let Some(&at) = first.get(row) else { return Vec::new() };
        let here = |points: &Vec<[f64; 2]>| points.iter().find(|p| p[0] == at).copied();
        self.curves.iter().filter_map(|(_, points)| here(points)).collect()
    }

    /// A row in words: `s = 0.5, syy = 1.2`.
    #[must_use]
    pub fn words(&self, row: usize) -> String {
        let Some(values) = self.drawn.table.rows().nth(row) else { return String::new() };
        let is_told = |name: &str| !["x", "y", "side"].contains(&name);
        let names = self.drawn.table.columns().iter().zip(values);
        let words = names.filter(|(column, _)| is_told(&column.name)).map(|(column, v)| {
            let unit = if column.unit == "deg" { "°" } else { &*column.unit };
            format!("{} = {}", column.name, super::words::value(*v, unit))
        });
        words.collect::<Vec<_>>().join("   ")
    }
}
