//! The content of a plot.

use ppum_render::scale::Scale;

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
}

/// An axis of a plot.
#[derive(Clone, Debug, PartialEq)]
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

impl Default for PlotAxis {
    fn default() -> Self {
        let (label, unit, names) = (String::new(), String::new(), Vec::new());
        Self { label, unit, scale: Scale::Linear, range: None, names, marks: Vec::new() }
    }
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
