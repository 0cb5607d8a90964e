//! Quantities along lines, cracks and circles.

use ppum::field::Field;
use ppum::quantity::Quantity;
use ppum_figure::plot::{Plot, PlotAxis};
use ppum_scene::profile::{Variable, axis, columns, curve, unit, value_label};

use super::{Named, label};
use crate::dataset::{field, quantities};
use crate::profile::Profile;

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
