//! The constitutive law as one tensor: elasticity and Poisson share every line of the assembly.

use ppum::dataset::{Equation, Material};
use ppum::vec2::Vec2;

/// The flux of ∇u: σ_ik = Σ_jl C\[i\]\[k\]\[j\]\[l\] ∂u_j/∂x_l.
///
/// Elasticity: C = λ δ_ik δ_jl + μ (δ_ij δ_kl + δ_il δ_jk) with the plane λ; Poisson: κ δ_kl.
#[derive(Clone, Copy, Debug)]
pub struct Law {
    /// Components of u.
    pub components: usize,
    tensor: [[[[f64; 2]; 2]; 2]; 2],
}

impl Law {
    /// The law of an equation.
    #[must_use]
    pub fn new(equation: &Equation) -> Self {
        let entry = |i: usize, k: usize, j: usize, l: usize| match equation {
            Equation::Elasticity(material) => elastic(material, i, k, j, l),
            Equation::Poisson { conductivity } => {
                if i == 0 && j == 0 && k == l {
                    *conductivity
                } else {
                    0.0
                }
            }
        };
        let tensor = std::array::from_fn(|i| {
            std::array::from_fn(|k| {
                std::array::from_fn(|j| std::array::from_fn(|l| entry(i, k, j, l)))
            })
        });
        Self { components: equation.components(), tensor }
    }

    /// Σ_kl C\[i\]\[k\]\[j\]\[l\] parts\[k\]\[l\].
    #[must_use]
    pub fn contract(&self, i: usize, j: usize, parts: &[[f64; 2]; 2]) -> f64 {
        let entry = |k: usize, l: usize| self.tensor[i][k][j][l] * parts[k][l];
        entry(0, 0) + entry(0, 1) + entry(1, 0) + entry(1, 1)
    }

    /// Component i of the traction σ n of the function N e_j with gradient `d`.
    #[must_use]
    pub fn traction(&self, i: usize, j: usize, d: Vec2, n: Vec2) -> f64 {
        let row = |k: usize| self.tensor[i][k][j][0] * d.x + self.tensor[i][k][j][1] * d.y;
        row(0) * n.x + row(1) * n.y
    }

    /// The flux σ of a gradient, `g[j] = ∇u_j`; rows beyond the components are zero.
    #[must_use]
    pub fn flux(&self, g: &[Vec2; 2]) -> [[f64; 2]; 2] {
        let entry = |i: usize, k: usize| {
            (0..self.components)
                .map(|j| self.tensor[i][k][j][0] * g[j].x + self.tensor[i][k][j][1] * g[j].y)
                .sum()
        };
        std::array::from_fn(|i| std::array::from_fn(|k| entry(i, k)))
    }
}

fn elastic(material: &Material, i: usize, k: usize, j: usize, l: usize) -> f64 {
    let delta = |a: usize, b: usize| f64::from(u8::from(a == b));
    material.lambda() * delta(i, k) * delta(j, l)
        + material.mu() * (delta(i, j) * delta(k, l) + delta(i, l) * delta(j, k))
}
