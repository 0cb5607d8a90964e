//! Lengths of figures, in pixels of one of 1024 × 768; others are scaled.

pub(super) const TICK: f64 = 5.0;
/// Between a tick and its label.
pub(super) const GAP: f64 = 5.0;
/// Between tick labels and the label of the axis.
pub(super) const LABEL_GAP: f64 = 10.0;
/// Between a plot and the lines above it.
pub(super) const TITLE_GAP: f64 = 14.0;
/// Between labels of an axis that is short, beside each other and above each other.
pub(super) const BETWEEN: f64 = 8.0;
pub(super) const BETWEEN_ROWS: f64 = 4.0;
pub(super) const BAR_GAP: f64 = 24.0;
/// Right of an image without a bar, and with one.
pub(super) const RIGHT: f64 = 36.0;
pub(super) const RIGHT_BAR: f64 = 150.0;
/// Around everything.
pub(super) const MARGIN: f64 = 12.0;
/// Most of a bar's room for its labels that a word takes; it has fewer digits before it takes more.
pub(super) const WORD: f64 = 62.0;
