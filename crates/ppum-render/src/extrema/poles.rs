//! Poles: places where a quantity is infinite though no function of the field is, as 1/x is.

use ppum::crack::Side;
use ppum::vec2::{Vec2, vec2};

use super::region::smallest_patch;
use super::{Extremum, ExtremumSearch};

/// Radii of circles around a place, in parts of a pixel or of the smallest patch there.
const RADII: [f64; 5] = [1e-1, 1e-2, 1e-3, 1e-4, 1e-5];

/// Growth from each of the circles to the next one, at least: r^(−0.05) grows as much.
const GROWTH: f64 = 1.1;

/// Directions in which it is looked at.
const DIRECTIONS: u32 = 8;

impl ExtremumSearch<'_, '_> {
    /// True if values grow ever on towards an extremum. It is the value in the middle of each
    /// circle that has to: not even the half of a peak that a border or a crack leaves grows below
    /// the peak's width, and of a line of poles two points of a circle lie on the line.
    pub(super) fn is_pole(&self, extremum: &Extremum) -> bool {
        let scale =
            self.pixel.min(smallest_patch(self.field, self.region.anchor + extremum.offset));
        let sizes = RADII.map(|radius| self.middle_size(extremum.offset, radius * scale));
        sizes.windows(2).all(|pair| pair[1] > GROWTH * pair[0])
            && extremum.value.abs() >= sizes[sizes.len() - 1]
    }

    /// The median of the sizes of values on a circle; NaN if there are none.
    fn middle_size(&self, center: Vec2, radius: f64) -> f64 {
        let mut local = self.field.at(self.region.anchor);
        let size = |k: u32| {
            let (sin, cos) = (f64::from(k) * std::f64::consts::FRAC_PI_4).sin_cos();
            let at = center + vec2(cos, sin) * radius;
            self.slope.quantity().at(&mut local, at, Side::Above).abs()
        };
        let mut sizes: Vec<f64> = (0..DIRECTIONS).map(size).filter(|size| !size.is_nan()).collect();
        sizes.sort_by(f64::total_cmp);
        sizes.get(sizes.len() / 2).copied().unwrap_or(f64::NAN)
    }
}
