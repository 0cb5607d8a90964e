//! Errors that rules leave.

use ppum::vec2::Vec2;

/// The rest of the errors that rules are divided for, where division was ended: by its bounds, or
/// because it did not help.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct QuadratureErrorEstimate {
    /// Estimated error of the integral of |f| of the loads, the larger of two rules' difference and
    /// what a further division changes; zero where it is within what is allowed.
    pub load: f64,
    /// The error of functions and coefficients, relative to the integrals over their pieces.
    pub functions: f64,
    /// The place of its largest part.
    pub at: Vec2,
    /// That part.
    worst: f64,
}

impl QuadratureErrorEstimate {
    /// The error estimate of loads at a place.
    pub(super) fn of_load(load: f64, at: Vec2) -> Self {
        Self { load, functions: 0.0, at, worst: load }
    }

    /// The error estimate of functions at a place.
    pub fn of_functions(functions: f64, at: Vec2) -> Self {
        Self { load: 0.0, functions, at, worst: functions }
    }

    /// Adds the error estimate of another part: errors of loads add up, of relative ones the larger
    /// stays.
    pub fn add(&mut self, part: &Self) {
        self.load += part.load;
        self.functions = self.functions.max(part.functions);
        if part.worst > self.worst {
            (self.at, self.worst) = (part.at, part.worst);
        }
    }

    /// True if everything is resolved.
    #[must_use]
    pub fn is_none(&self) -> bool {
        self.load == 0.0 && self.functions == 0.0
    }
}
