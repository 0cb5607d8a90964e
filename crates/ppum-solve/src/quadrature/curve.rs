//! Cutting windows of charts along curves.
//!
//! A curve ψ = 0 that runs across a window as a graph over one of its axes divides it into strips
//! whose boundaries are the curve itself, found by a root on each line of Gauss points: no chord,
//! no order of the geometry, the rule is as good as the functions are smooth along the curve (after
//! Saye, "High-order quadrature methods for implicitly defined surfaces and volumes in
//! hyperrectangles", SIAM J. Sci. Comput. 37 (2015)). Windows in which no axis will do are divided
//! into four.
//!
//! The curve is known by samples only. A feature smaller than a sixteenth of a piece is missed if
//! it shows neither in the values of the level function nor in their differences and extrema.

use super::chart::{CellChart, CurveStrip, LevelOn, UNIT, range};
use super::geometry::LevelFunction;
use super::local_curve::LocalCurve;
use super::roots::{ZERO, sign_changes};
use super::split::{TOLERANCE, breaks, cut_at};
use ppum::vec2::{Rect, Vec2, vec2};
use std::rc::Rc;

/// Steps of the grid in each direction that tells whether a curve may be near at all.
const COARSE: usize = 2;

/// Steps of the grid that shows the curve's course.
const FINE: usize = 8;

/// Least ratio of two differences of a level function along a line for it to count as monotone:
/// an extremum hides between samples only if differences change as much.
const EVEN: f64 = 0.25;

/// Differences below this part of a level function's size are rounding.
const FLAT: f64 = 1e-11;

/// Distances to a curve below this part of the coordinates are rounding: of two level functions
/// with the same zero set one has such values where the other is zero, and must not cut slivers
/// off there.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Differences of values below this many times what counts as zero are rounding.
const ROUNDED: f64 = 4.0;

/// Neighbours in a grid that are nearer to each other than this part of the largest distance of two
/// do not say how steep a level function is.
const PINCHED: f64 = 1e-3;

/// Most divisions in four, one inside the other: where curves cross or have a corner, the part of a
/// piece that is left undivided is 4⁻¹⁶ ≈ 2e-10.
const DEPTH: usize = 32;

/// Most windows looked at for one piece and one curve. A circle takes about ten; a function that
/// touches zero along a line without a change of its sign takes all.
const LOOKS: usize = 1000;

/// A rectangle in the coordinates of a chart.
#[derive(Clone)]
pub(super) struct ChartWindow<'c> {
    pub(super) chart: Rc<CellChart<'c>>,
    pub(super) range: Rect,
}

impl<'c> ChartWindow<'c> {
    pub(super) fn whole(chart: CellChart<'c>) -> Self {
        Self { chart: Rc::new(chart), range: UNIT }
    }

    fn part(&self, range: Rect) -> Self {
        Self { chart: Rc::clone(&self.chart), range }
    }

    fn level(&self, curve: &LocalCurve<'c>) -> LevelOn<'c> {
        LevelOn { chart: Rc::clone(&self.chart), curve: curve.clone() }
    }

    /// The coordinate that divides an axis in a ratio.
    pub(super) fn between(&self, axis: usize, part: f64) -> f64 {
        self.chart.between(axis, range(&self.range, axis), part)
    }

    /// The halves below and above the middle of an axis.
    pub(super) fn halves(&self, axis: usize) -> [Self; 2] {
        cut_at(&self.range, axis, self.between(axis, 0.5)).map(|range| self.part(range))
    }
}

/// The windows cut along curves, and whether any of them was.
pub(super) fn cut_all<'c>(
    mut windows: Vec<ChartWindow<'c>>,
    curves: &[LocalCurve<'c>],
) -> (Vec<ChartWindow<'c>>, bool) {
    // Slivers between curves that coincide do not say how steep a level function is; whole
    // pieces do.
    let rounding = |curve: &LocalCurve<'c>| {
        let of_window = |window: &ChartWindow<'c>| {
            LevelGrid::new(&window.level(curve), window, COARSE, 0.0).rounding
        };
        windows.iter().map(of_window).fold(0.0, f64::max)
    };
    let zeros: Vec<f64> = curves.iter().map(rounding).collect();
    let mut any = false;
    for (curve, zero) in curves.iter().zip(zeros) {
        let mut parts = Vec::new();
        for window in windows {
            let mut looks = LOOKS;
            match cut(&window, (curve, zero), &mut looks, DEPTH) {
                Some(cut) => {
                    any = true;
                    parts.extend(cut);
                }
                None => parts.push(window),
            }
        }
        windows = parts;
    }
    (windows, any)
}

/// False if samples say that the curve stays well away from a rectangle.
pub(crate) fn may_meet(level: &LevelFunction, rect: &Rect) -> bool {
    let corners = [rect.min, vec2(rect.max.x, rect.min.y), rect.max, vec2(rect.min.x, rect.max.y)];
    let chart = Rc::new(CellChart::Quadrilateral(corners.map(|p| p - rect.min)));
    let window = ChartWindow { chart, range: UNIT };
    let level = window.level(&LocalCurve::Level(level, rect.min));
    !LevelGrid::new(&level, &window, COARSE, 0.0).is_clear()
}

/// The parts of a window on both sides of a curve, values of which up to `zero` are rounding; none
/// if the curve does not run through it.
fn cut<'c>(
    window: &ChartWindow<'c>,
    (curve, zero): (&LocalCurve<'c>, f64),
    looks: &mut usize,
    depth: usize,
) -> Option<Vec<ChartWindow<'c>>> {
    if *looks == 0 || depth == 0 {
        return None;
    }
    *looks -= 1;
    let level_on = window.level(curve);
    if LevelGrid::new(&level_on, window, COARSE, zero).is_clear() {
        return None;
    }
    let grid = LevelGrid::new(&level_on, window, FINE, zero);
    if grid.is_clear() {
        return None;
    }
    if let Some(height) = grid.height() {
        return strips(window, &level_on, height, grid.zero);
    }
    let mut any = false;
    let mut parts = Vec::new();
    for half in window.halves(grid.uneven()) {
        let found = cut(&half, (curve, zero), looks, depth - 1);
        any |= found.is_some();
        parts.extend(found.unwrap_or_else(|| vec![half]));
    }
    any.then_some(parts)
}

/// The parts of a window through which a curve runs as a graph over the axis that is not `height`.
fn strips<'c>(
    window: &ChartWindow<'c>,
    level: &LevelOn<'c>,
    height: usize,
    zero: f64,
) -> Option<Vec<ChartWindow<'c>>> {
    let base = 1 - height;
    let ((bottom, top), (lo, hi)) = (range(&window.range, height), range(&window.range, base));
    let value = |h: f64, b: f64| {
        let value = level.at(if height == 0 { [h, b] } else { [b, h] });
        if value.abs() <= zero { 0.0 } else { value }
    };
    let along = |part: f64| window.between(base, part);
    let leaves = |h: f64| sign_changes(&|part| value(h, along(part)), 0.0, 1.0);
    let ends = [bottom, top].into_iter().flat_map(leaves).map(along).collect();
    let (mut parts, mut any) = (Vec::new(), false);
    for interval in breaks(lo, hi, ends, TOLERANCE * (hi - lo)).windows(2) {
        let mut part = window.part(window.range);
        match base {
            0 => (part.range.min.x, part.range.max.x) = (interval[0], interval[1]),
            _ => (part.range.min.y, part.range.max.y) = (interval[0], interval[1]),
        }
        let middle = part.between(base, 0.5);
        if value(bottom, middle) * value(top, middle) < 0.0 {
            any = true;
            parts.extend([false, true].map(|above| {
                let (level, window) = (level.clone(), part.range);
                ChartWindow::whole(CellChart::Strip(CurveStrip { level, window, height, above }))
            }));
        } else {
            parts.push(part);
        }
    }
    any.then_some(parts)
}

/// Values of a level function on a grid over a closed window.
struct LevelGrid {
    steps: usize,
    values: Vec<f64>,
    /// Largest absolute value.
    size: f64,
    /// Values up to this are zero.
    zero: f64,
    /// Error of values that rounding of the coordinates makes.
    rounding: f64,
}

impl LevelGrid {
    /// Samples a level function whose values up to `zero` are rounding.
    fn new(level: &LevelOn<'_>, window: &ChartWindow<'_>, steps: usize, zero: f64) -> Self {
        let part = |axis: usize, k: usize| window.between(axis, k as f64 / steps as f64);
        let (points, mut values): (Vec<Vec2>, Vec<f64>) = (0..=steps)
            .flat_map(|j| (0..=steps).map(move |i| (i, j)))
            .map(|(i, j)| level.sample([part(0, i), part(1, j)]))
            .unzip();
        let size = values.iter().fold(0.0, |size: f64, v| size.max(v.abs()));
        let far = points.iter().fold(0.0, |far: f64, p| far.max(p.x.abs()).max(p.y.abs()));
        let rounding = ROUNDING * far * slope(&points, &values, steps + 1);
        let zero = zero.max(ZERO * size);
        values.iter_mut().filter(|v| v.abs() <= zero).for_each(|v| *v = 0.0);
        Self { steps, values, size, zero, rounding }
    }

    /// Differences between neighbours along the k-th line of an axis.
    fn differences(&self, axis: usize, k: usize) -> impl Iterator<Item = f64> + '_ {
        let n = self.steps + 1;
        let at = move |i: usize| if axis == 0 { k * n + i } else { i * n + k };
        (0..self.steps).map(move |i| self.values[at(i + 1)] - self.values[at(i)])
    }

    /// True if all values are of one sign and farther from zero than they change from one sample to
    /// the next.
    fn is_clear(&self) -> bool {
        let lines = (0..2).flat_map(|axis| (0..=self.steps).map(move |k| (axis, k)));
        let change = lines
            .flat_map(|(axis, k)| self.differences(axis, k))
            .fold(0.0, |most: f64, d| most.max(d.abs()));
        let safety = if self.steps == COARSE { 2.0 } else { 1.0 };
        let positive = self.values[0] > 0.0;
        self.values.iter().all(|&v| (v > 0.0) == positive && v.abs() > safety * change)
    }

    /// The axis along whose lines the function is monotone; the one along which it changes more if
    /// both are.
    fn height(&self) -> Option<usize> {
        let change = |axis: usize| -> f64 {
            (0..=self.steps).flat_map(|k| self.differences(axis, k)).map(f64::abs).sum()
        };
        let best = usize::from(change(1) > change(0));
        [best, 1 - best].into_iter().find(|&axis| self.is_monotone(axis))
    }

    /// The axis along which slopes change more.
    fn uneven(&self) -> usize {
        let change = |axis: usize| -> f64 {
            let of_line = |k: usize| {
                let d: Vec<f64> = self.differences(axis, k).collect();
                d.windows(2).map(|d| (d[1] - d[0]).abs()).sum::<f64>()
            };
            (0..=self.steps).map(of_line).sum()
        };
        usize::from(change(1) > change(0))
    }

    /// True if along all lines of an axis the function rises, or along all falls, and evenly.
    fn is_monotone(&self, axis: usize) -> bool {
        let mut sign = 0.0;
        (0..=self.steps).all(|k| {
            let lines = self.differences(axis, k);
            let (least, most) =
                lines.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), d| (a.min(d), b.max(d)));
            let size = least.abs().max(most.abs());
            if size <= FLAT * self.size + ROUNDED * self.zero {
                return true;
            }
            let first = sign == 0.0;
            if first {
                sign = most.signum();
            }
            let (near, far) = if sign > 0.0 { (least, most) } else { (-most, -least) };
            near >= EVEN * far && far > 0.0
        })
    }
}

/// The steepest slope between neighbours in a grid with `n` points per row.
fn slope(points: &[Vec2], values: &[f64], n: usize) -> f64 {
    let beside = (0..points.len()).filter(|k| k % n > 0).map(|k| (k - 1, k));
    let above = (n..points.len()).map(|k| (k - n, k));
    let step =
        |(a, b): (usize, usize)| ((points[b] - points[a]).length(), (values[b] - values[a]).abs());
    let steps: Vec<(f64, f64)> = beside.chain(above).map(step).collect();
    let longest = steps.iter().fold(0.0, |most: f64, step| most.max(step.0));
    let wide = steps.iter().filter(|step| step.0 > PINCHED * longest);
    wide.fold(0.0, |most: f64, (way, change)| most.max(change / way))
}
