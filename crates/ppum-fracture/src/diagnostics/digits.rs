//! Digits that the coefficients of a dataset bear.
//!
//! Coefficients that are large and cancel cost evaluation digits. Their number is found without
//! knowing why: the field whose coefficients are δ_k c_k, |δ_k| ≤ 1 without pattern, is what
//! rounding of the c_k to a part ε adds, divided by ε. Its gradient over that of the field, times
//! some ε, is the relative rounding error of stresses.

use super::{Cutters, above, short};
use ppum::crack::Side;
use ppum::dataset::{Dataset, Step, Warning, WarningKind};
use ppum::field::{Field, FieldError};
use ppum::jet::Jet;
use ppum::text::LocationText;
use ppum::vec2::{Rect, Vec2};
use rayon::prelude::*;

/// Relative rounding error of stresses above which fewer than eight digits remain.
pub const FEW_DIGITS: f64 = 1e-8;

/// Roundings of a term on its way into the sum, one as good as another.
const ROUNDINGS: f64 = 8.0;

/// Part of the mean |∇u| below which a gradient counts as zero.
const NOTHING: f64 = 0.1;

/// Places in a cell, from its centre in units of its size.
const PLACES: [[f64; 2]; 5] =
    [[0.0, 0.0], [-0.26, -0.23], [0.24, -0.27], [-0.22, 0.25], [0.28, 0.21]];

/// Mean of the rounding errors over that of the gradients from which on a field is nothing but
/// rounding: a body that moves as a rigid body.
const ALL: f64 = 1e-3;

/// Relative rounding errors of the gradient of a field.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct GradientRounding {
    /// The largest one.
    pub largest: f64,
    /// The centre of its cell.
    pub at: Vec2,
    /// The mean error over the mean gradient.
    pub mean: f64,
}

impl GradientRounding {
    /// True if the gradient is nothing but rounding everywhere.
    pub(super) fn is_all(&self) -> bool {
        self.mean > ALL
    }
}

/// Relative rounding errors of the gradient of the first field of a step, evaluated in double
/// precision; single precision has 2²⁹ times that.
///
/// # Errors
/// Functions that do not compile.
pub fn rounding(field: &Field<'_>) -> Result<GradientRounding, FieldError> {
    let mut noise = Dataset::new(field.domain.clone(), field.equation.clone());
    noise.tables = field.tables.to_vec();
    noise.steps = vec![with_noise(field.step)];
    let noise = Field::new(&noise, 0)?;
    let cells = &field.step.partition.cells();
    let gradients: Vec<[f64; 2]> =
        cells.par_iter().map(|cell| [field, &noise].map(|f| gradient(f, cell))).collect();
    let [mean, of_noise] =
        [0, 1].map(|k| gradients.iter().map(|g| g[k]).sum::<f64>() / gradients.len() as f64);
    let relative =
        |&[own, noise]: &[f64; 2]| ROUNDINGS * f64::EPSILON * noise / own.max(NOTHING * mean);
    let errors =
        gradients.iter().map(relative).zip(cells.iter()).filter(|(error, _)| error.is_finite());
    let largest = errors.reduce(|a, b| if b.0 > a.0 { b } else { a });
    let (largest, at) = largest.map_or((0.0, Vec2::ZERO), |(e, cell)| (e, cell.center()));
    let all = if mean > 0.0 { ROUNDINGS * f64::EPSILON * of_noise / mean } else { 0.0 };
    Ok(GradientRounding { largest, at, mean: all })
}

/// The warning about a field that few digits are left of, by its rounding error and where that is.
pub(super) fn of_digits(
    GradientRounding { largest: error, at, mean }: GradientRounding,
    cutters: Cutters,
    places: &LocationText,
) -> Option<Warning> {
    let cause = match cutters {
        Cutters::Nothing => "functions of a patch nearly depend on each other".into(),
        cutters => format!("{} leaves next to nothing of a patch", cutters.name()),
    };
    if mean > ALL {
        let message = "the field is constant but for rounding, or the plate moves as a rigid body: stresses, gradients and \
                       factors are zero, and their digits rounding";
        return Some(Warning::new(WarningKind::Digits, None, [mean, ALL], message.into()));
    }
    let message = format!(
        "near {} coefficients cancel, and stresses are good to {} there in double, not at all in single \
         precision: {cause}; use linear weights, or other cells",
        places.show(at),
        short(error)
    );
    above(WarningKind::Digits, Some(at), [error, FEW_DIGITS], message)
}

/// The step with coefficients δ_k c_k, δ_k = 2 {k g} − 1 with the golden ratio g.
fn with_noise(step: &Step) -> Step {
    let mut step = step.clone();
    let golden = 0.5 * (5.0_f64.sqrt() - 1.0);
    for component in &mut step.fields[0].coefficients {
        for (k, c) in component.iter_mut().enumerate() {
            *c *= 2.0 * (k as f64 * golden).fract() - 1.0;
        }
    }
    step
}

/// Largest |∇u| at the places of a cell; zero where all of them lie in holes.
fn gradient(field: &Field<'_>, cell: &Rect) -> f64 {
    let (mut local, size) = (field.inside(cell), cell.size());
    let mut u = vec![Jet::constant(0.0); field.components()];
    let mut at = |[x, y]: [f64; 2]| {
        let offset = ppum::vec2::vec2(x * size.x, y * size.y);
        let inside = local.evaluate::<1>(offset, Side::Above, &mut u);
        let square = u.iter().map(|u| u.x * u.x + u.y * u.y).sum::<f64>();
        if inside && square.is_finite() { square.sqrt() } else { 0.0 }
    };
    PLACES.into_iter().map(&mut at).fold(0.0, f64::max)
}
