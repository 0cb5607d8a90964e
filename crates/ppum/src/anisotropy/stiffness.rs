//! Stiffnesses of the plane as matrices.

/// Constants of the plane.
pub(super) const PLANE: usize = 6;

/// c₁₁, c₁₂, c₁₆, c₂₂, c₂₆, c₆₆.
pub type PlaneStiffness<R = f64> = [R; PLANE];

/// The constants in axes that those given are turned from by an angle with this cosine and sine,
/// as the angle of the given first axis from the new one.
#[must_use]
pub fn turned([c11, c12, c16, c22, c26, c66]: PlaneStiffness, [c, s]: [f64; 2]) -> PlaneStiffness {
    let (cc, ss, sc) = (c * c, s * s, s * c);
    let (sum, difference) = (c12 + 2.0 * c66, cc - ss);
    [
        c11 * cc * cc + 2.0 * sum * cc * ss + c22 * ss * ss - 4.0 * sc * (c16 * cc + c26 * ss),
        c12 + (c11 + c22 - 2.0 * sum) * cc * ss + 2.0 * (c16 - c26) * sc * difference,
        sc * (c11 * cc - c22 * ss - sum * difference)
            + c16 * cc * (cc - 3.0 * ss)
            + c26 * ss * (3.0 * cc - ss),
        c11 * ss * ss + 2.0 * sum * cc * ss + c22 * cc * cc + 4.0 * sc * (c16 * ss + c26 * cc),
        sc * (c11 * ss - c22 * cc + sum * difference)
            + c16 * ss * (3.0 * cc - ss)
            + c26 * cc * (cc - 3.0 * ss),
        c66 + (c11 + c22 - 2.0 * sum) * cc * ss + 2.0 * (c16 - c26) * sc * difference,
    ]
}

/// The compliance a₁₁, a₁₂, a₁₆, a₂₂, a₂₆, a₆₆.
pub(super) fn inverse([c11, c12, c16, c22, c26, c66]: &PlaneStiffness) -> PlaneStiffness {
    let minors = [
        c22 * c66 - c26 * c26,
        c16 * c26 - c12 * c66,
        c12 * c26 - c16 * c22,
        c11 * c66 - c16 * c16,
        c12 * c16 - c11 * c26,
        c11 * c22 - c12 * c12,
    ];
    let determinant = c11 * minors[0] + c12 * minors[1] + c16 * minors[2];
    minors.map(|minor| minor / determinant)
}

/// A symmetric matrix times a vector.
pub(super) fn times([a, b, c, d, e, f]: &PlaneStiffness, [x, y, z]: [f64; 3]) -> [f64; 3] {
    [a * x + b * y + c * z, b * x + d * y + e * z, c * x + e * y + f * z]
}

/// c₁₃, c₂₃ and c₃₆ in axes that the first axis has an angle with this cosine and sine from.
pub(super) fn turned_through([c13, c23, c36]: [f64; 3], [c, s]: [f64; 2]) -> [f64; 3] {
    let shear = 2.0 * c36 * s * c;
    [
        c13 * c * c + c23 * s * s - shear,
        c13 * s * s + c23 * c * c + shear,
        (c13 - c23) * s * c + c36 * (c * c - s * s),
    ]
}

/// The least eigenvalue of a symmetric matrix by Jacobi's rotations.
pub(super) fn least_eigenvalue(matrix: &[f64], n: usize) -> f64 {
    let mut a = matrix.to_vec();
    for _ in 0..30 {
        for i in 0..n {
            for j in 0..i {
                let theta = 0.5 * (2.0 * a[i * n + j]).atan2(a[j * n + j] - a[i * n + i]);
                let (s, c) = theta.sin_cos();
                for k in 0..n {
                    let (x, y) = (a[i * n + k], a[j * n + k]);
                    (a[i * n + k], a[j * n + k]) = (c * x - s * y, s * x + c * y);
                }
                for k in 0..n {
                    let (x, y) = (a[k * n + i], a[k * n + j]);
                    (a[k * n + i], a[k * n + j]) = (c * x - s * y, s * x + c * y);
                }
            }
        }
    }
    (0..n).map(|k| a[k * n + k]).fold(f64::INFINITY, f64::min)
}
