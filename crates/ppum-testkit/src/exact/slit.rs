//! The scalar field at the end of a slit.

use super::field::{Component, ExactField};
use num_complex::Complex64;
use ppum::vec2::{Vec2, vec2};

/// u = √r sin(θ/2) = Im √z: harmonic, without flux through the slit y = 0, x < 0.
#[derive(Clone, Copy, Debug)]
pub struct Slit;

impl ExactField<1> for Slit {
    fn evaluate(&self, p: Vec2) -> [Component; 1] {
        let root = Complex64::new(p.x, p.y).sqrt();
        let slope = 0.5 / root;
        [Component { value: root.im, gradient: vec2(slope.im, slope.re) }]
    }

    fn formulas(&self) -> [String; 1] {
        ["sqrt(hypot(x, y))*sin(atan2(y, x)/2)".to_owned()]
    }
}
