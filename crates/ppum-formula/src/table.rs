//! Tables: handbook or measured data as smooth functions.

use crate::real::{Double, Lanes};

/// A function of one or two numbers given by its values at knots, as formulas use it in
/// `table(name, x)` and `table(name, x, y)`.
///
/// Between the knots it is the cubic spline through the values, twice continuously differentiable,
/// the third derivative continuous at the first and last inner knot as well (*not-a-knot*: no
/// slopes need to be known at the ends; de Boor 1978, chapter IV). So a cubic is reproduced
/// exactly. Three knots give the parabola, two the line. With two arguments it is the tensor
/// product of such splines: bicubic on each cell, reproducing x³y³.
///
/// Outside the knots the value is that of the nearest point of the border, the derivatives in that
/// direction are 0, as of `numpy.interp`. On the ends of the range the derivatives are those of
/// the inside. NaN gives NaN.
///
/// An evaluation costs a binary search in each direction and at most 15 multiplications and
/// additions; the spline's coefficients are stored, 4 per cell with one argument, 16 with two.
///
/// ```
/// use ppum_formula::Table;
///
/// let stiffness = Table::curve("k", vec![0.0, 1.0, 2.0, 4.0], vec![0.0, 1.0, 8.0, 64.0])?;
/// assert!((stiffness.value(3.0, 0.0) - 27.0).abs() < 1e-13);
/// assert_eq!(stiffness.value(-7.0, 0.0), 0.0);
/// # Ok::<(), ppum_formula::TableError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Table {
    name: String,
    x: Vec<f64>,
    /// Empty if the table has one argument.
    y: Vec<f64>,
    values: Vec<f64>,
    /// For each cell, row-major \[cell in y\]\[cell in x\], its coefficients \[power of y\]\[power
    /// of x\] in powers of the distances from the cell's lower left knot.
    coefficients: Vec<f64>,
}

/// Equal names, knots and values. Scopes share their tables and are compared often: one table with
/// itself costs nothing.
impl PartialEq for Table {
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self, other)
            || self.name == other.name
                && self.x == other.x
                && self.y == other.y
                && self.values == other.values
    }
}

/// Why data make no table: a sentence with the remedy.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("table `{table}`{message}")]
pub struct TableError {
    table: String,
    message: String,
    /// The list that is wrong: `x`, `y` or `values`.
    pub list: &'static str,
    /// The number in the list that is wrong, from 0, if it is one.
    pub index: Option<usize>,
}

/// Coefficients of a cubic polynomial, constant first.
type Cubic<R = f64> = [R; 4];

impl Table {
    /// A function of one number: `values[i]` at `x[i]`. The name is checked by
    /// [`Scope::with_table`](crate::Scope::with_table).
    ///
    /// # Errors
    /// When there are fewer than two knots, they do not increase strictly, a number is not finite,
    /// or there is not one value for each knot.
    pub fn curve(name: &str, x: Vec<f64>, values: Vec<f64>) -> Result<Self, TableError> {
        check_knots(name, "x", &x)?;
        check_values(name, x.len(), &values)?;
        let coefficients = spline(&x, &values).concat();
        Self { name: name.to_owned(), x, y: Vec::new(), values, coefficients }.check_steepness()
    }

    /// A function of two numbers: `values[j * x.len() + i]` at (`x[i]`, `y[j]`), that is row-major
    /// \[y\]\[x\], a row being the values of one y.
    ///
    /// # Errors
    /// As [`Table::curve`], for both directions.
    pub fn surface(
        name: &str,
        x: Vec<f64>,
        y: Vec<f64>,
        values: Vec<f64>,
    ) -> Result<Self, TableError> {
        check_knots(name, "x", &x)?;
        check_knots(name, "y", &y)?;
        check_values(name, x.len() * y.len(), &values)?;
        let coefficients = tensor_spline(&x, &y, &values);
        Self { name: name.to_owned(), x, y, values, coefficients }.check_steepness()
    }

    fn check_steepness(self) -> Result<Self, TableError> {
        if self.coefficients.iter().all(|c| c.is_finite()) {
            return Ok(self);
        }
        let message = " is too steep for double precision; scale its knots or its values".into();
        Err(TableError { table: self.name, message, list: "values", index: None })
    }

    /// Its name in formulas.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Number of arguments, 1 or 2.
    pub(crate) fn n_arguments(&self) -> usize {
        if self.y.is_empty() { 1 } else { 2 }
    }

    /// Knots of the first argument, increasing.
    #[must_use]
    pub fn x(&self) -> &[f64] {
        &self.x
    }

    /// Knots of the second argument, increasing; empty if there is one argument.
    #[must_use]
    pub fn y(&self) -> &[f64] {
        &self.y
    }

    /// The values at the knots, row-major \[y\]\[x\].
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The spline's polynomials. For each cell between knots, row-major \[cell in y\]\[cell in x\],
    /// the coefficients \[power of y\]\[power of x\] in powers of the distances from the cell's
    /// lower left knot: 16 numbers, or 4 with one argument.
    #[must_use]
    pub fn coefficients(&self) -> &[f64] {
        &self.coefficients
    }

    /// The value at (x, y); `y` is ignored if there is one argument.
    #[must_use]
    pub fn value(&self, x: f64, y: f64) -> f64 {
        self.derivative([0, 0], x, y)
    }

    /// ∂^(m+n) / ∂x^m ∂y^n of the table at (x, y), with `orders` = \[m, n\]; `y` is ignored if
    /// there is one argument. The third derivatives are piecewise constant in their direction,
    /// higher ones 0.
    #[must_use]
    pub fn derivative(&self, orders: [u8; 2], x: f64, y: f64) -> f64 {
        self.derivatives(orders, x, y)
    }

    /// [`Table::derivative`] at a vector of points.
    #[inline(always)]
    pub(crate) fn derivatives<R: Double>(&self, [m, n]: [u8; 2], x: R, y: R) -> R {
        let zero = x.broadcast(0.0);
        if m > 3 || n > 3 || n > 0 && self.y.is_empty() {
            return zero;
        }
        let column = KnotSpan::new(&self.x, x);
        if self.y.is_empty() {
            let cubic = self.cubic(column.cells.map(|cell| 4.0 * cell), x);
            return column.unless_flat(m, polynomial(cubic, m, column.distance));
        }
        let row = KnotSpan::new(&self.y, y);
        let columns = (self.x.len() - 1) as f64;
        let (mut in_y, mut k) = ([zero; 4], 0);
        while k < 4 {
            let at = |lane: usize| row.cells[lane] * columns + column.cells[lane];
            let starts = std::array::from_fn(|lane| 16.0 * at(lane) + 4.0 * k as f64);
            in_y[k] = polynomial(self.cubic(starts, x), m, column.distance);
            k += 1;
        }
        row.unless_flat(n, column.unless_flat(m, polynomial(in_y, n, row.distance)))
    }

    /// Four coefficients from a start in each lane.
    #[inline(always)]
    fn cubic<R: Double>(&self, starts: Lanes, like: R) -> [R; 4] {
        let (mut cubic, mut power) = ([like; 4], 0);
        while power < 4 {
            cubic[power] = like.with_lanes(|lane| self.coefficients[starts[lane] as usize + power]);
            power += 1;
        }
        cubic
    }
}

/// The intervals of knots that arguments lie in, and the arguments relative to their starts.
struct KnotSpan<R: Double> {
    /// Whole numbers.
    cells: Lanes,
    /// From the cell's first knot; of the nearest end of the range if the argument is outside.
    distance: R,
    /// 1 inside, 0 outside.
    inside: R,
}

/// Most knots that are all looked at, on vectors; among more each lane searches for itself.
const FEW: usize = 24;

impl<R: Double> KnotSpan<R> {
    #[inline(always)]
    fn new(knots: &[f64], x: R) -> Self {
        let (first, last) = (x.broadcast(knots[0]), x.broadcast(knots[knots.len() - 1]));
        let (zero, one) = (x.broadcast(0.0), x.broadcast(1.0));
        let near = last.min(first.max(x));
        let cells = cells(&knots[1..knots.len() - 1], near);
        let distance = near - x.with_lanes(|lane| knots[cells[lane] as usize]);
        let inside = R::select(first.gt(x), zero, R::select(x.gt(last), zero, one));
        Self { cells, distance, inside }
    }

    /// The derivative of an order if it is not 0, whatever the polynomial.
    #[inline(always)]
    fn unless_flat(&self, order: u8, value: R) -> R {
        let zero = value.broadcast(0.0);
        if order == 0 { value } else { R::select(self.inside.gt(zero), value, zero) }
    }
}

/// How many of the inner knots are not above each argument.
#[inline(always)]
fn cells<R: Double>(knots: &[f64], x: R) -> Lanes {
    let (zero, one) = (x.broadcast(0.0), x.broadcast(1.0));
    if R::LANES == 1 || knots.len() > FEW {
        let mut cells = x.lanes();
        for x in &mut cells[..R::LANES] {
            *x = knots.partition_point(|knot| knot <= x) as f64;
        }
        return cells;
    }
    let (mut count, mut k) = (zero, 0);
    while k < knots.len() {
        count = count + R::select(x.ge(x.broadcast(knots[k])), one, zero);
        k += 1;
    }
    count.lanes()
}

/// The derivative of an order up to 3 of the polynomial with some coefficients, constant first,
/// at `t`.
#[inline(always)]
fn polynomial<R: Double>(c: Cubic<R>, order: u8, t: R) -> R {
    let (two, three, six) = (t.broadcast(2.0), t.broadcast(3.0), t.broadcast(6.0));
    match order {
        0 => ((c[3] * t + c[2]) * t + c[1]) * t + c[0],
        1 => (three * c[3] * t + two * c[2]) * t + c[1],
        2 => six * c[3] * t + two * c[2],
        _ => six * c[3],
    }
}

fn check_knots(name: &str, list: &'static str, knots: &[f64]) -> Result<(), TableError> {
    let error = |index, message| Err(TableError { table: name.to_owned(), message, list, index });
    if knots.len() < 2 {
        let given = knots.len();
        return error(None, format!(" has {given} knots in {list}; at least two are needed"));
    }
    let infinite = knots.iter().position(|knot| !knot.is_finite());
    let falling = (1..knots.len()).find(|&k| knots[k] <= knots[k - 1]);
    let Some(k) = infinite.or(falling) else { return Ok(()) };
    let wrong = match infinite {
        Some(_) => "; it must be finite".to_owned(),
        None => format!(" after {}; sort the knots and give each one once", knots[k - 1]),
    };
    error(Some(k), format!(": knot {k} in {list}, counted from 0, is {}{wrong}", knots[k]))
}

fn check_values(name: &str, expected: usize, values: &[f64]) -> Result<(), TableError> {
    let (table, given, list) = (name.to_owned(), values.len(), "values");
    if given != expected {
        let message = format!(
            " has {given} values, but {expected} are needed: one for each knot, in rows of constant y"
        );
        return Err(TableError { table, message, list, index: None });
    }
    let Some(k) = values.iter().position(|value| !value.is_finite()) else { return Ok(()) };
    let message = format!(": value {k}, counted from 0, is {}; it must be finite", values[k]);
    Err(TableError { table, message, list, index: Some(k) })
}

/// The cubics of the not-a-knot spline between the knots.
fn spline(knots: &[f64], values: &[f64]) -> Vec<Cubic> {
    let steps: Vec<f64> = knots.windows(2).map(|k| k[1] - k[0]).collect();
    let chords: Vec<f64> =
        values.windows(2).zip(&steps).map(|(v, step)| (v[1] - v[0]) / step).collect();
    let slopes = slopes(&steps, &chords);
    (0..steps.len())
        .map(|i| {
            let (h, chord) = (steps[i], chords[i]);
            // the cubic with the values and slopes at both ends (Hermite)
            let excess = (slopes[i] - chord + (slopes[i + 1] - chord)) / h;
            [values[i], slopes[i], (chord - slopes[i]) / h - excess, excess / h]
        })
        .collect()
}

/// Slopes of the spline at the knots, from the steps between knots and the slopes of the chords.
fn slopes(h: &[f64], chords: &[f64]) -> Vec<f64> {
    match *chords {
        [chord] => vec![chord; 2],
        [left, right] => {
            let bend = (right - left) / (h[0] + h[1]);
            vec![left - bend * h[0], left + bend * h[0], right + bend * h[1]]
        }
        _ => not_a_knot_slopes(h, chords),
    }
}

/// The second derivative is continuous at inner knots, the third at the first and last of them
/// (de Boor 1978, chapter IV). The tridiagonal system is eliminated without exchanging rows: all
/// pivots are positive.
fn not_a_knot_slopes(h: &[f64], chords: &[f64]) -> Vec<f64> {
    let n = h.len() + 1;
    let end = |h0: f64, h1: f64, c0: f64, c1: f64| {
        let both = h0 + h1;
        ((h0 + 2.0 * both) * h1 * c0 + h0 * h0 * c1) / both
    };
    let mut slopes = vec![end(h[0], h[1], chords[0], chords[1])];
    let (mut above, mut pivots) = (vec![h[0] + h[1]], vec![h[1]]);
    for i in 1..n {
        let last = i == n - 1;
        let (below, diagonal, right) = if last {
            (h[n - 3] + h[n - 2], h[n - 3], end(h[n - 2], h[n - 3], chords[n - 2], chords[n - 3]))
        } else {
            let right = 3.0 * (h[i] * chords[i - 1] + h[i - 1] * chords[i]);
            (h[i], 2.0 * (h[i - 1] + h[i]), right)
        };
        let factor = below / pivots[i - 1];
        pivots.push(diagonal - factor * above[i - 1]);
        slopes.push(right - factor * slopes[i - 1]);
        above.push(h[i - 1]);
    }
    slopes[n - 1] /= pivots[n - 1];
    for i in (0..n - 1).rev() {
        slopes[i] = (slopes[i] - above[i] * slopes[i + 1]) / pivots[i];
    }
    slopes
}

/// The bicubics of the tensor product spline: splines in x of each row, then splines in y of their
/// coefficients.
fn tensor_spline(x: &[f64], y: &[f64], values: &[f64]) -> Vec<f64> {
    let rows: Vec<Vec<Cubic>> = values.chunks(x.len()).map(|row| spline(x, row)).collect();
    let (columns, lines) = (x.len() - 1, y.len() - 1);
    let mut coefficients = vec![0.0; 16 * columns * lines];
    for column in 0..columns {
        for power in 0..4 {
            let along: Vec<f64> = rows.iter().map(|row| row[column][power]).collect();
            for (line, cubic) in spline(y, &along).into_iter().enumerate() {
                let cell = 16 * (line * columns + column);
                for (k, c) in cubic.into_iter().enumerate() {
                    coefficients[cell + 4 * k + power] = c;
                }
            }
        }
    }
    coefficients
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn data_are_checked() {
        let curve = |x: &[f64], v: &[f64]| Table::curve("t", x.to_vec(), v.to_vec());
        let message = |r: Result<Table, TableError>| r.expect_err("faulty").to_string();
        for (result, part) in [
            (curve(&[1.0], &[1.0]), "has 1 knots in x"),
            (curve(&[1.0, f64::NAN], &[1.0, 2.0]), "knot 1 in x, counted from 0, is NaN"),
            (curve(&[1.0, 2.0, 2.0], &[1.0; 3]), "knot 2 in x, counted from 0, is 2 after 2"),
            (curve(&[1.0, 2.0], &[1.0; 3]), "3 values, but 2 are needed"),
            (curve(&[1.0, 2.0], &[1.0, f64::INFINITY]), "value 1, counted from 0, is inf"),
            (curve(&[0.0, 1e-300], &[0.0, 1e300]), "too steep"),
            (
                Table::surface("t", vec![0.0, 1.0], vec![1.0, 0.0], vec![0.0; 4]),
                "knot 1 in y, counted from 0, is 0 after 1",
            ),
            (Table::surface("t", vec![0.0, 1.0], vec![0.0, 1.0], vec![0.0; 3]), "but 4 are needed"),
        ] {
            assert!(message(result.clone()).contains(part), "{result:?}");
        }
    }

    const KNOTS: [f64; 6] = [-2.0, -1.5, -0.2, 0.1, 2.0, 3.0];

    /// Polynomials the spline must reproduce, of a degree that depends on the number of knots.
    #[test]
    fn polynomials_are_reproduced() {
        let p = |degree: i32, x: f64| x.powi(degree) - 2.0 * x + 1.0;
        for (n, degree) in [(2, 1), (3, 2), (4, 3), (5, 3), (6, 3)] {
            let knots = &KNOTS[..n];
            let values = knots.iter().map(|&x| p(degree, x)).collect();
            let table = Table::curve("t", knots.to_vec(), values).expect("valid");
            for k in 0..=20 {
                let t = f64::from(k) / 20.0;
                let x = knots[0] * (1.0 - t) + knots[n - 1] * t;
                let expected = [
                    p(degree, x),
                    f64::from(degree) * x.powi(degree - 1) - 2.0,
                    f64::from(degree * (degree - 1)) * x.powi((degree - 2).max(0)),
                ];
                for (order, expected) in (0u8..).zip(expected) {
                    let found = table.derivative([order, 0], x, f64::NAN);
                    assert!((found - expected).abs() < 1e-12, "{n} knots, order {order} at {x}");
                }
            }
        }
    }

    #[test]
    fn bicubics_are_reproduced() {
        let (p, dp) = (|x: f64| x * x * x - x, |x: f64| 3.0 * x * x - 1.0);
        let (q, dq) = (|y: f64| 2.0 - y * y * y, |y: f64| -3.0 * y * y);
        let ys = [0.0, 0.5, 0.7, 2.0, 3.5];
        let values = ys.iter().flat_map(|&y| KNOTS.map(|x| p(x) * q(y))).collect();
        let table = Table::surface("t", KNOTS.to_vec(), ys.to_vec(), values).expect("valid");
        for (x, y) in [(-2.0, 0.0), (-1.7, 0.6), (0.0, 1.0), (0.1, 2.0), (2.9, 3.4), (3.0, 3.5)] {
            for (orders, expected) in [
                ([0, 0], p(x) * q(y)),
                ([1, 0], dp(x) * q(y)),
                ([0, 1], p(x) * dq(y)),
                ([2, 0], 6.0 * x * q(y)),
                ([1, 1], dp(x) * dq(y)),
                ([0, 2], p(x) * -6.0 * y),
                ([3, 3], -36.0),
                ([4, 0], 0.0),
            ] {
                let found = table.derivative(orders, x, y);
                // rounding of the largest value, 24 · 40, divided by the smallest step, 1/5, once
                // an order
                let tolerance = 1e-12 * 5f64.powi(i32::from(orders[0] + orders[1]));
                assert!((found - expected).abs() < tolerance, "{orders:?} at {x}, {y}: {found}");
            }
        }
    }

    /// Values, slopes and curvatures are continuous at inner knots, the third derivative at the
    /// first and last of them: the defining conditions of the spline, with data that are
    /// no polynomial.
    #[test]
    fn defining_conditions() {
        let values = [1.0, -2.0, 0.5, 0.25, 3.0, -1.0];
        let table = Table::curve("t", KNOTS.to_vec(), values.to_vec()).expect("valid");
        let piece = |cell: usize, order: u8, x: f64| {
            let cubic = std::array::from_fn(|k| table.coefficients()[4 * cell + k]);
            polynomial(cubic, order, x - KNOTS[cell])
        };
        for i in 0..5 {
            assert_eq!(table.value(KNOTS[i], 0.0), values[i]);
            assert!((piece(i, 0, KNOTS[i + 1]) - values[i + 1]).abs() < 1e-13);
        }
        for (i, &knot) in KNOTS.iter().enumerate().take(5).skip(1) {
            let orders = if i == 1 || i == 4 { 0..4 } else { 0..3 };
            for order in orders {
                let jump = piece(i, order, knot) - piece(i - 1, order, knot);
                assert!(jump.abs() < 1e-11, "order {order} at knot {i}: {jump}");
            }
        }
    }

    /// The spline through n + 1 values of sin converges as h⁴, its slope as h³.
    #[test]
    fn rates() {
        let errors = |n: u32| {
            let knots: Vec<f64> = (0..=n).map(|i| 3.0 * f64::from(i) / f64::from(n)).collect();
            let values = knots.iter().map(|x| x.sin()).collect();
            let table = Table::curve("t", knots, values).expect("valid");
            (0..=1000).map(|k| 3.0 * f64::from(k) / 1000.0).fold([0.0f64; 2], |[v, d], x| {
                let slope = table.derivative([1, 0], x, 0.0) - x.cos();
                [v.max((table.value(x, 0.0) - x.sin()).abs()), d.max(slope.abs())]
            })
        };
        let ([v, d], [v2, d2]) = (errors(20), errors(40));
        // the asymptotic ratios are 16 and 8; near the ends convergence sets in late
        assert!(v / v2 > 13.0 && d / d2 > 6.5, "{} {}", v / v2, d / d2);
    }

    #[test]
    fn outside_the_value_is_that_of_the_border() {
        let table = Table::surface("t", vec![0.0, 1.0], vec![0.0, 2.0], vec![1.0, 2.0, 3.0, 7.0])
            .expect("valid");
        assert_eq!(table.value(-5.0, 1.0), table.value(0.0, 1.0));
        assert_eq!(table.value(f64::INFINITY, 9.0), 7.0);
        assert_eq!(table.derivative([1, 0], -5.0, 1.0), 0.0);
        assert_eq!(table.derivative([0, 1], -5.0, 1.0), 1.0);
        assert_eq!(table.derivative([0, 1], 1.0, 2.0), 2.5);
        assert_eq!(table.derivative([0, 1], 1.0, 2.1), 0.0);
        assert!(table.value(f64::NAN, 1.0).is_nan() && table.value(0.5, f64::NAN).is_nan());
    }
}
