//! The auxiliary fields: Williams fields of unit intensity in a uniform body of the tip's material.

use ppum::crack::TipPoint;
use ppum::dataset::Material;
use ppum::function::westergaard;
use ppum::jet::Jet;
use ppum::vec2::{Vec2, vec2};

/// Of each component its gradient, in the tip's frame.
pub(super) type Gradients = [Vec2; 2];

/// The field of one mode as the interaction integral takes it, at a point in the tip's frame.
pub(super) struct Auxiliary {
    /// ∇uᵃ_i
    pub(super) gradient: Gradients,
    /// ∇uᵃ_i,1, like r^(−3/2) at the tip. Zero unless it was asked for.
    pub(super) along: Gradients,
}

/// The fields with K_I = 1 and with K_II = 1, with derivatives up to `D`: 1 for the gradient alone, 2 for
/// its derivative along the crack.
pub(super) fn auxiliary<const D: usize>(
    material: &Material,
    point: &TipPoint<f64>,
) -> [Auxiliary; 2] {
    let functions = westergaard::<f64, D>(point);
    let gradient = modes(material, functions.map(|jet: Jet<f64>| vec2(jet.x, jet.y)));
    let along = modes(material, functions.map(|jet| vec2(jet.xx, jet.xy)));
    let [one, two] = gradient;
    let [along_one, along_two] = along;
    [(one, along_one), (two, along_two)].map(|(gradient, along)| Auxiliary { gradient, along })
}

/// Both modes from a derivative of the Westergaard functions F₁…F₄: with κ of Kolosov, 2μ√(2π) u is
/// ((κ−1)F₁ + F₃, (κ+1)F₂ − F₄) and ((κ+1)F₂ + F₄, −(κ−1)F₁ + F₃).
fn modes(material: &Material, functions: [Vec2; 4]) -> [Gradients; 2] {
    let kappa = material.kolosov();
    let scale = 1.0 / (2.0 * material.mu() * std::f64::consts::TAU.sqrt());
    let [f1, f2, f3, f4] = functions.map(|f| f * scale);
    let (less, more) = (kappa - 1.0, kappa + 1.0);
    [[f1 * less + f3, f2 * more - f4], [f2 * more + f4, f3 - f1 * less]]
}
