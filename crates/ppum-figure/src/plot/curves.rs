//! The content of a plot.

use ppum_render::scale::{Normalization, Scale};

/// Room between the outermost values and the frame, in parts of the axis.
const MARGIN: f64 = 0.04;

/// Curves over axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plot {
    /// Line above the plot; may be empty.
    pub title: String,
    /// The horizontal axis.
    pub x: PlotAxis,
    /// The vertical axis.
    pub y: PlotAxis,
    /// The curves, the lowest first.
    pub curves: Vec<PlotCurve>,
    /// True if the names of lines stand in a row above the frame, where they cover no curve.
    pub has_names_above: bool,
}

/// An axis of a plot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlotAxis {
    /// The quantity.
    pub label: String,
    /// The unit; may be empty.
    pub unit: String,
    /// Linear, or logarithmic: then only positive values are seen.
    pub scale: Scale,
    /// The values from its start to its end; found from the curves if there are none.
    pub range: Option<[f64; 2]>,
    /// Names of the values 0, 1, 2, … in place of numbers; none of an axis of numbers.
    pub names: Vec<String>,
    /// The values with a label, rising; found if there are none.
    pub marks: Vec<f64>,
}

impl PlotAxis {
    /// A linear axis.
    #[must_use]
    pub fn new(label: impl Into<String>, unit: impl Into<String>) -> Self {
        Self { label: label.into(), unit: unit.into(), ..Self::default() }
    }

    /// The axis with a logarithmic scale.
    #[must_use]
    pub fn logarithmic(self) -> Self {
        Self { scale: Scale::Log, ..self }
    }
}

/// A curve of a plot.
#[derive(Clone, Debug, PartialEq)]
pub struct PlotCurve {
    /// Its name in the legend; none if empty.
    pub label: String,
    /// Its points; it breaks where one has a coordinate that is no number or is infinite.
    pub points: Vec<[f64; 2]>,
    /// The way it is drawn.
    pub look: CurveStyle,
}

/// The way a curve is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CurveStyle {
    /// A line.
    #[default]
    Line,
    /// A dashed line, for what is compared with.
    Dashed,
    /// A line with a dot at each point.
    Dotted,
    /// Bars from zero, those of several curves side by side.
    Bars,
}

impl PlotCurve {
    /// A line.
    #[must_use]
    pub fn new(label: impl Into<String>, points: Vec<[f64; 2]>) -> Self {
        Self { label: label.into(), points, look: CurveStyle::Line }
    }

    /// The curve drawn in another way.
    #[must_use]
    pub fn with_look(self, look: CurveStyle) -> Self {
        Self { look, ..self }
    }
}

/// True if an axis of this scale has a place for a value.
pub(super) fn has_place(scale: Scale, value: f64) -> bool {
    value.is_finite() && (scale != Scale::Log || value > 0.0)
}

/// The scale of an axis: its range, or that of the curves' values with some room.
pub(super) fn scale_of(plot: &Plot, k: usize) -> Normalization {
    let (axes, curves) = ([&plot.x, &plot.y], &plot.curves);
    let axis = axes[k];
    let is_log = axis.scale == Scale::Log;
    let fits = |(axis, v): (&PlotAxis, &f64)| has_place(axis.scale, *v);
    let is_seen = |p: &&[f64; 2]| axes.into_iter().zip(*p).all(fits);
    let points = curves.iter().flat_map(|curve| &curve.points).filter(is_seen);
    let have_bars = !is_log && curves.iter().any(|curve| curve.look == CurveStyle::Bars);
    let [min, max] = axis.range.unwrap_or_else(|| {
        if !axis.names.is_empty() {
            return [-0.6, axis.names.len() as f64 - 0.4];
        }
        let zero = (have_bars && k == 1).then_some(0.0);
        let values = points.map(|p| p[k]).chain(zero);
        let start = [f64::INFINITY, f64::NEG_INFINITY];
        roomy(values.fold(start, |[a, b], v| [a.min(v), b.max(v)]), is_log)
    });
    let usable = min < max && (max - min).is_normal() && (!is_log || min > 0.0);
    let [min, max] = if usable { [min, max] } else { [0.1, 1.0] };
    Normalization::new(axis.scale, min, max)
}

/// A range with some room at its ends; around a single value, or where there is none, some range.
fn roomy([min, max]: [f64; 2], is_log: bool) -> [f64; 2] {
    if min > max {
        return if is_log { [0.1, 1.0] } else { [0.0, 1.0] };
    }
    if is_log {
        let factor = (max / min).powf(MARGIN).max(if max / min < 1.01 { 2.0 } else { 1.0 });
        return [min / factor, max * factor];
    }
    let size = min.abs().max(max.abs());
    let room = match max - min {
        span if span > 1e-12 * size && span > 0.0 => MARGIN * span,
        _ if size > 0.0 => 0.5 * size,
        _ => 0.5,
    };
    [min - room, max + room]
}
