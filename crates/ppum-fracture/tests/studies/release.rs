//! The energy that a growing crack releases, against its stress intensity factors.

use super::plates::pulled;
use super::support::{solved, strain_energy};
use ppum::dataset::Dataset;
use ppum::equation::Elasticity;
use ppum::vec2::{Rect, Vec2, vec2};

/// A crack from the left edge with two kinks, in a square plate under tension.
const KINKED: [Vec2; 4] = [vec2(-1.0, 0.1), vec2(-0.6, 0.0), vec2(-0.3, 0.15), vec2(0.1, 0.05)];

/// Half of the growth over which energies are compared.
const GROWTH: f64 = 0.005;

/// The two sides of Irwin's relation at the tip of the kinked crack.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Release {
    /// K_I and K_II by the interaction integral.
    pub(crate) intensities: [f64; 2],
    /// E′
    young: f64,
    /// −dΠ/da by a central difference. Under given tractions Π = −U.
    pub(crate) by_energy: f64,
}

impl Release {
    /// (K_I² + K_II²)/E′
    pub(crate) fn by_intensities(&self) -> f64 {
        self.intensities.iter().map(|k| k * k / self.young).sum()
    }
}

/// Both sides, on n × n cells.
pub(crate) fn kinked_crack(n: u32) -> Release {
    let plate = kinked(n, 0.0);
    let tip = &plate.steps[0].intensities[0];
    let [shorter, longer] = [-GROWTH, GROWTH].map(|growth| strain_energy(&kinked(n, growth)));
    Release {
        intensities: [tip.k1, tip.k2],
        young: plate
            .equation
            .elastic()
            .and_then(Elasticity::uniform)
            .expect("elasticity")
            .effective_young(),
        by_energy: (longer - shorter) / (2.0 * GROWTH),
    }
}

/// The solution for the crack whose last segment has grown.
fn kinked(n: u32, growth: f64) -> Dataset {
    let [.., before, tip] = KINKED;
    let mut points = KINKED.map(<[f64; 2]>::from);
    points[3] = (tip + (tip - before).unit() * growth).into();
    let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
    solved(&pulled(domain, [n, n], &[&points]))
}
