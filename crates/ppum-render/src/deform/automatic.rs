//! A factor that shows the deformation.

use ppum::crack::Side;
use ppum::field::Field;
use ppum::vec2::{Rect, Vec2, vec2};

use super::map::{DeformationMap, followed};
use super::{DeformError, check};

/// Largest displacement that is seen, in parts of the smaller side of what is shown.
const SEEN: f64 = 0.05;
/// Columns and rows of points at which displacements are looked at.
const POINTS: u32 = 65;

/// The factor with which the largest displacement that is seen in a window of the undeformed body
/// is 5 % of the smaller side of the domain, rounded down to 1, 2 or 5 times a power of ten; of
/// several fields the same for all, as for the images of a series. 1 if nothing moves.
/// Displacements are looked at in 65 × 65 points and along cracks.
///
/// # Errors
/// A field of an equation without displacements.
pub fn automatic_factor(fields: &[&Field<'_>], window: &Rect) -> Result<f64, DeformError> {
    let mut found = AutomaticFactor::default();
    fields.iter().try_for_each(|field| found.add(field, window))?;
    Ok(found.factor())
}

/// The search for [`automatic_factor`] of fields that are not there at the same time.
#[derive(Clone, Copy, Debug)]
pub struct AutomaticFactor {
    largest: f64,
    side: f64,
}

impl Default for AutomaticFactor {
    fn default() -> Self {
        Self { largest: 0.0, side: f64::INFINITY }
    }
}

impl AutomaticFactor {
    /// Takes a field into account.
    ///
    /// # Errors
    /// A field of an equation without displacements.
    pub fn add(&mut self, field: &Field<'_>, window: &Rect) -> Result<(), DeformError> {
        check(field)?;
        let size = field.domain.bounds.size();
        self.largest = self.largest.max(largest(field, window));
        self.side = self.side.min(size.x).min(size.y);
        Ok(())
    }

    /// The factor for all of them.
    #[must_use]
    pub fn factor(&self) -> f64 {
        let factor = SEEN * self.side / self.largest;
        if factor.is_normal() { round_down(factor) } else { 1.0 }
    }
}

/// Largest |u| of a field in a window.
fn largest(field: &Field<'_>, window: &Rect) -> f64 {
    let shown = window.intersection(&field.domain.bounds);
    let size = shown.size() / f64::from(POINTS - 1);
    let lattice = (0..POINTS * POINTS)
        .map(|k| shown.min + vec2(size.x * f64::from(k % POINTS), size.y * f64::from(k / POINTS)))
        .filter(|p| field.domain.contains(*p));
    let vertices = field.step.cracks.iter().flat_map(followed);
    let mut map = DeformationMap::new(field, shown.center());
    let mut length = |p: Vec2| {
        let u = map.displacement(p - shown.center(), Side::Above).unwrap_or([0.0; 2]);
        Vec2::from(u).length()
    };
    let points = lattice.chain(vertices.filter(|p| shown.contains(*p)));
    points.map(&mut length).filter(|u| u.is_finite()).fold(0.0, f64::max)
}

/// 1, 2 or 5 times a power of ten, no larger than a positive number.
fn round_down(value: f64) -> f64 {
    let exponent = value.log10().floor() as i32;
    let candidates = [(5.0, 0), (2.0, 0), (1.0, 0), (5.0, -1)];
    // read from its digits: 0.2 and not 0.2000…01
    let rounded =
        |(digit, shift): (f64, i32)| format!("{digit}e{}", exponent + shift).parse().unwrap_or(1.0);
    candidates.into_iter().map(rounded).find(|c| *c <= value * (1.0 + 1e-12)).unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_numbers() {
        for (value, rounded) in [
            (1.0, 1.0),
            (1.99, 1.0),
            (2.0, 2.0),
            (4.9, 2.0),
            (5.0, 5.0),
            (999.0, 500.0),
            (0.3, 0.2),
            (1e-300, 1e-300),
            (0.099, 0.05),
        ] {
            assert_eq!(round_down(value), rounded, "{value}");
        }
    }
}
