//! Weight functions w(t), t = |ξ| ∈ \[0, 1\]: the generators of the partition of unity.

/// A one-dimensional even B-spline on \[−1, 1\], scaled to w(0) = 1 where that is exact.
/// The scale is irrelevant: φ_i = W_i / Σ W does not see it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum WeightFunction {
    /// Degree 1: w = 1 − t.
    #[default]
    Linear,
    /// Degree 2, knots at ±1/3 and ±1.
    Quadratic,
    /// Degree 3, knots at 0, ±1/2 and ±1.
    Cubic,
}
