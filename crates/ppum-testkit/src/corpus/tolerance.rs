//! The distance that back ends may have from the corpus, decided in this place alone.

use super::cases::Bound;

/// The errors that an evaluator may make: with the unit roundoff u
///
/// ```text
/// |found − exact| ≤ u (c · arithmetic + f · functions + inputs)
/// ```
///
/// over the parts of a [`Bound`].
#[derive(Clone, Copy, Debug)]
pub struct Tolerance {
    /// The unit roundoff u.
    pub unit: f64,
    /// c: how many times the bound another order of the operations may need.
    pub arithmetic: f64,
    /// f: the error of a function in unit roundoffs of its result.
    pub functions: f64,
    /// True if inputs and literals are rounded to this precision.
    pub rounds_inputs: bool,
}

/// One point in double precision.
///
/// c = 2: the bound is that of the chain rule of second order, while programs are differentiated
/// twice, so that some terms stand twice. f = 2: elementary functions are wrong by less than one
/// unit in the last place, which is two roundoffs; √(x² + y²), by up to 1.16, has the rounding of
/// the result besides.
pub const SCALAR: Tolerance =
    Tolerance { unit: f64::EPSILON / 2.0, arithmetic: 2.0, functions: 2.0, rounds_inputs: false };

/// Blocks of points in double precision: the same operations in the same order as [`SCALAR`].
pub const LANES: Tolerance = SCALAR;

/// Blocks of points in single precision. c = 2 as in [`SCALAR`]. f = 2: functions are found in
/// double precision and rounded, or wrong by less than one unit in the last place.
pub const LANES_SINGLE: Tolerance = Tolerance {
    unit: f32::EPSILON as f64 / 2.0,
    arithmetic: 2.0,
    functions: 2.0,
    rounds_inputs: true,
};

/// One point in single precision by the texts of WGSL, interpreted or on a driver.
///
/// c = 2 as in [`SCALAR`]. f = 4: the functions of the texts are right to two units of the last
/// place, which are four roundoffs. √, logarithm and powers are the device's, to which WGSL
/// allows more.
pub const SHADER: Tolerance = Tolerance {
    unit: f32::EPSILON as f64 / 2.0,
    arithmetic: 2.0,
    functions: 4.0,
    rounds_inputs: true,
};

impl Tolerance {
    /// The largest allowed difference from `expected`, the corpus' number as a double.
    #[must_use]
    pub fn limit(&self, bound: &Bound, expected: f64) -> f64 {
        let inputs = if self.rounds_inputs { bound.inputs } else { 0.0 };
        let rounding =
            self.arithmetic * bound.arithmetic + self.functions * bound.functions + inputs;
        // the corpus' number itself is rounded, and so may be the result; the smallest numbers
        // are sparse
        self.unit * (rounding + 2.0 * expected.abs()) + f64::from_bits(1)
    }
}
