//! Quantities along lines, cracks and circles.

use ppum::field::Field;
use ppum_figure::plot::{Plot, PlotAxis};

use super::{NamedDataset, label, title};
use crate::report::profile::{self, Variable, axis, columns, curve, unit, value_label};
use crate::report::table::NumberTable;

/// A plot of tables along one curve, dataset by dataset, a curve for each quantity of each.
#[derive(Debug)]
pub struct Profiles<'d> {
    variable: Variable,
    /// True if the curve is a crack and no quantities were asked for: opening and sliding, or the
    /// jump, are drawn.
    jumps: bool,
    several: bool,
    titles: Vec<&'d str>,
    plot: Plot,
}

/// The quantity that is drawn where none is asked for: one that every field has.
#[must_use]
pub fn usual(field: &Field<'_>) -> &'static str {
    if field.equation.elastic().is_some() { "von-mises" } else { "gradient" }
}

impl<'d> Profiles<'d> {
    /// No curves yet; `several` datasets have their names in the legend.
    #[must_use]
    pub fn new(variable: Variable, jumps: bool, several: bool) -> Self {
        let plot = Plot { x: axis(variable), ..Plot::default() };
        Self { variable, jumps, several, titles: Vec::new(), plot }
    }

    /// Adds the table of a dataset's field.
    pub fn add(
        &mut self,
        named: NamedDataset<'d>,
        field: &Field<'_>,
        quantities: &profile::NamedQuantities,
        table: &NumberTable,
    ) {
        for (name, points) in columns(table, self.variable, self.jumps, quantities) {
            let name = label(self.several, named.name, &name);
            self.plot.curves.push(curve(name, points, self.variable));
        }
        self.titles.push(&named.dataset.title);
        self.plot.y = PlotAxis::new(value_label(quantities, field), unit(quantities, field));
    }

    /// The plot of what was added.
    #[must_use]
    pub fn plot(self) -> Plot {
        let mut plot = self.plot;
        plot.title = title(self.titles.into_iter());
        if self.jumps {
            plot.y.label = "displacement jump".into();
        }
        if self.variable == Variable::Distance {
            plot.y = plot.y.logarithmic();
        }
        plot
    }
}
