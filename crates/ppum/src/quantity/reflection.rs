//! Reflections at lines of symmetry, and what they make of values.

use std::f64::consts::{FRAC_PI_2, PI};

use crate::crack::Crack;
use crate::vec2::{Vec2, vec2};

/// Reflections at lines parallel to the axes, and the sign with which they repeat a field.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reflection {
    /// The lines x = a and y = b, where there is a reflection at one.
    pub lines: [Option<f64>; 2],
    /// True for −S u(Sx), an antisymmetric field.
    pub is_odd: bool,
}

/// The change that turns the values of a quantity of a field into those of another quantity of the
/// reflected field. It is its own inverse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ValueChange {
    /// Nothing.
    Same,
    /// −v; +∞, the value where there is no gradient, stays.
    Negated,
    /// An angle of a direction, in (−π/2, π/2], reflected, turned by π/2, or both.
    Turned {
        /// True for −v.
        is_reversed: bool,
        /// True for v + π/2.
        is_quarter: bool,
    },
}

impl ValueChange {
    pub(super) fn signed(sign: f64) -> Self {
        if sign < 0.0 { Self::Negated } else { Self::Same }
    }

    /// The value of the reflected field.
    #[must_use]
    pub fn apply(self, value: f64) -> f64 {
        match self {
            Self::Same => value,
            Self::Negated if value == f64::INFINITY => value,
            Self::Negated => -value,
            Self::Turned { .. } if !value.is_finite() => value,
            Self::Turned { is_reversed, is_quarter } => {
                let reflected = if is_reversed { -value } else { value };
                let turned = if is_quarter { reflected + FRAC_PI_2 } else { reflected };
                match turned {
                    angle if angle > FRAC_PI_2 => angle - PI,
                    angle if angle <= -FRAC_PI_2 => angle + PI,
                    angle => angle,
                }
            }
        }
    }
}

impl Reflection {
    /// No reflection.
    pub const NONE: Self = Self { lines: [None; 2], is_odd: false };

    /// The point Sx.
    #[must_use]
    pub fn point(&self, p: Vec2) -> Vec2 {
        let beyond = |line: Option<f64>, at: f64| line.map_or(at, |line| 2.0 * line - at);
        vec2(beyond(self.lines[0], p.x), beyond(self.lines[1], p.y))
    }

    /// The image of a crack, with its direction; one reflection turns arcs the other way.
    #[must_use]
    pub fn crack(&self, crack: &Crack) -> Crack {
        let sign: f64 = self.axes().into_iter().product();
        Crack {
            points: crack.points.iter().map(|p| self.point(*p)).collect(),
            bulges: crack.bulges.iter().map(|bulge| sign * bulge).collect(),
            ends: crack.ends,
        }
    }

    /// The vector S v.
    #[must_use]
    pub fn vector(&self, v: Vec2) -> Vec2 {
        let [x, y] = self.axes();
        vec2(x * v.x, y * v.y)
    }

    /// The sign of the field.
    #[must_use]
    pub fn sign(&self) -> f64 {
        if self.is_odd { -1.0 } else { 1.0 }
    }

    /// s of both coordinates.
    pub(super) fn axes(&self) -> [f64; 2] {
        self.lines.map(|line| if line.is_some() { -1.0 } else { 1.0 })
    }

    /// The change of angles of a stress's direction: that of σ₁ of −σ is that of σ₂.
    #[must_use]
    pub fn direction(&self) -> ValueChange {
        let [x, y] = self.axes();
        match (x * y < 0.0, self.is_odd) {
            (false, false) => ValueChange::Same,
            (is_reversed, is_quarter) => ValueChange::Turned { is_reversed, is_quarter },
        }
    }

    /// The sign of a component of a field whose first so many, two or none, are a vector; the
    /// others are potentials.
    pub(super) fn of_component(&self, component: usize, vector: usize) -> f64 {
        let axis = if component < vector { self.axes()[component] } else { 1.0 };
        self.sign() * axis
    }
}
