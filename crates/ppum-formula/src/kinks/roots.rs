//! Zeros of formulas of one variable.

use crate::formula::Formula;

/// Intervals among which zeros are searched.
const INTERVALS: u32 = 4096;

/// Most steps of a `floor` that are searched in an interval.
const MAX_STEPS: f64 = 4096.0;

/// Places after which a search ends: no quadrature can honour that many.
const MAX_PLACES: usize = 4096;

/// Rounding of a value that should be zero, in units of the largest value, as of some tens of
/// operations.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A search for the places where a formula of one variable is zero, or, with `steps`, a whole
/// number.
pub(crate) struct Scan<'f> {
    pub(crate) formula: &'f Formula,
    /// The interval to search.
    pub(crate) range: [f64; 2],
    pub(crate) steps: bool,
}

impl Scan<'_> {
    /// The places if the formula is slope · t + constant.
    pub(crate) fn of_line(&self, slope: f64, constant: f64) -> Vec<f64> {
        let [lo, hi] = self.range;
        let levels = self.levels(slope * lo + constant, slope * hi + constant);
        let places = levels.map(|level| (level - constant) / slope);
        // rounding must not lose a place at an end
        places.map(|place| place.clamp(lo, hi)).collect()
    }

    /// The places where it crosses or touches a level, as far as 4096 intervals show them.
    pub(crate) fn of_curve(&self) -> Vec<f64> {
        let mut scratch = Vec::new();
        let mut value = |t: f64| self.formula.evaluate_with(&[t], &mut scratch);
        let grid = self.grid();
        let values: Vec<f64> = grid.iter().map(|&t| value(t)).collect();
        let mut places = Vec::new();
        for (t, u) in grid.windows(2).zip(values.windows(2)) {
            if places.len() >= MAX_PLACES {
                return places;
            }
            for level in self.levels(u[0], u[1]) {
                places.push(bisect(|t| value(t) - level, t[0], t[1]));
            }
        }
        places.extend(self.touches(&grid, &values));
        places
    }

    /// The places where it touches a level without crossing it.
    fn touches(&self, grid: &[f64], values: &[f64]) -> Vec<f64> {
        let variable = &self.formula.scope().independent()[0];
        let Ok(slope) = self.formula.derivative(variable) else { return Vec::new() };
        let mut scratch = Vec::new();
        let mut slope_at = |t: f64| slope.evaluate_with(&[t], &mut scratch);
        let slopes: Vec<f64> = grid.iter().map(|&t| slope_at(t)).collect();
        let size =
            values.iter().copied().filter(|v| v.is_finite()).fold(0.0, |a: f64, v| a.max(v.abs()));
        let turns = grid.windows(2).zip(slopes.windows(2)).filter(|(_, s)| s[0] * s[1] <= 0.0);
        let mut places = Vec::new();
        for (t, _) in turns {
            let place = bisect(&mut slope_at, t[0], t[1]);
            let u = self.formula.evaluate(&[place]);
            let level = if self.steps { u.round() } else { 0.0 };
            if (u - level).abs() <= ROUNDING * size {
                places.push(place);
            }
        }
        places
    }

    /// The ends of the intervals.
    fn grid(&self) -> Vec<f64> {
        let [lo, hi] = self.range;
        let n = f64::from(INTERVALS);
        let between = (1..INTERVALS).map(|k| lo + (hi - lo) * (f64::from(k) / n));
        std::iter::once(lo).chain(between).chain([hi]).collect()
    }

    /// The levels between two values, both included; none next to NaN, and if they are too many.
    fn levels(&self, a: f64, b: f64) -> impl Iterator<Item = f64> + use<> {
        let (low, high) = if a <= b { (a, b) } else { (b, a) };
        let (first, last) = match self.steps {
            true => (low.ceil(), high.floor()),
            false if low <= 0.0 && 0.0 <= high => (0.0, 0.0),
            false => (1.0, 0.0),
        };
        let n = if last - first <= MAX_STEPS { last - first + 1.0 } else { 0.0 };
        // a negative number or NaN of levels is none
        (0..n as u32).map(move |k| first + f64::from(k))
    }
}

/// The change of sign of `f` between `a` and `b`, to the last bit: a zero if one is met, else the
/// end of the last interval where |f| is smaller.
fn bisect(mut f: impl FnMut(f64) -> f64, mut a: f64, mut b: f64) -> f64 {
    let (mut fa, mut fb) = (f(a), f(b));
    loop {
        let middle = a + (b - a) / 2.0;
        if fa == 0.0 || fb == 0.0 || !(a < middle && middle < b) {
            return if fa.abs() < fb.abs() { a } else { b };
        }
        let value = f(middle);
        if (value < 0.0) == (fa < 0.0) {
            (a, fa) = (middle, value);
        } else {
            (b, fb) = (middle, value);
        }
    }
}
