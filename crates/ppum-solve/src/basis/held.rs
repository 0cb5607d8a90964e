//! The basis of a patch in which a component of the field vanishes on lines.
//!
//! The unknowns are fields v of both components: polynomials, jumps times polynomials, and the
//! fields of series, which have the symmetry of the line. In a component that is zero on the line
//! d(x) = 0 polynomials are those times d:
//!
//! ```text
//! P_p → d P_(p−1)      G = Σ_i F_i M F_iᵀ      C_i = R F_i,   R G Rᵀ = I
//! ```
//!
//! with the coefficients F_i of the fields in component i, the Gram matrix M of the functions, and
//! R as for functions ([`Transform`]). Series are not made of stable functions first: where they
//! are nearly polynomials, what is cut off of their functions would break their symmetry.

use super::tie::VectorField;
use super::transform::{CUT_OFF, Transform};
use crate::space::{HeldLine, Space};
use faer::Mat;
use ppum::dataset::monomials;
use ppum::function::FunctionKind;
use ppum::polynomial::exponents;
use ppum_linear::EigenError;

/// The fields of a patch by the coefficients F of their components in its functions, and what makes
/// stable ones of them.
pub(super) struct HeldFields {
    pub(super) parts: [Mat<f64>; 2],
    /// R
    pub(super) transform: Transform,
}

/// The fields of a patch that sees held lines, those of its series among them. `weighted` is the
/// Gram matrix of its functions, `squares` what their squares without φ are.
///
/// # Errors
/// Functions that are not finite.
pub(super) fn held_fields(
    space: &Space<'_>,
    patch: usize,
    (weighted, squares): (&Mat<f64>, &[f64]),
    series: Vec<VectorField>,
) -> Result<HeldFields, EigenError> {
    let blocks = plain_fields(space, patch);
    let [polynomials, jumps] =
        [blocks.first().map_or(0, Vec::len), blocks.iter().map(Vec::len).sum()];
    let all: Vec<VectorField> = blocks.into_iter().flatten().chain(series).collect();
    let parts = [0, 1].map(|i| Mat::from_fn(all.len(), squares.len(), |k, j| all[k][i][j]));
    let of_part = |part: &Mat<f64>| part * weighted * part.transpose();
    let of_fields = of_part(&parts[0]) + of_part(&parts[1]);
    let square = |field: &VectorField| {
        let of_part =
            |part: &Vec<f64>| part.iter().zip(squares).map(|(c, n2)| c * c * n2).sum::<f64>();
        field.iter().map(of_part).sum()
    };
    let plain: Vec<f64> = all.iter().map(square).collect();
    let transform = Transform::new(of_fields.as_ref(), &plain, [polynomials, jumps], CUT_OFF)?;
    Ok(HeldFields { parts, transform })
}

/// The fields of each block of polynomials or jumps, which come before all series.
fn plain_fields(space: &Space<'_>, patch: usize) -> Vec<Vec<VectorField>> {
    let (data, mut first, n) = (space.data(), 0, space.evaluated(patch));
    let is_plain = |block: &usize| {
        let function = data.block_function[*block] as usize;
        !matches!(space.step().functions[function].kind, FunctionKind::Formula { .. })
    };
    let of_block = |block: usize| {
        let degree = usize::from(data.block_degree[block]);
        let start = first;
        first += monomials(degree);
        let field = |component: usize, polynomial: Vec<f64>| {
            let mut field = [vec![0.0; n], vec![0.0; n]];
            field[component][start..start + polynomial.len()].copy_from_slice(&polynomial);
            field
        };
        let of_component = |component: usize| {
            let all = polynomials(space, patch, component, degree).into_iter();
            all.map(move |polynomial| field(component, polynomial))
        };
        [0, 1].into_iter().flat_map(of_component).collect()
    };
    data.blocks(patch).take_while(is_plain).map(of_block).collect()
}

/// A basis of the polynomials up to a degree that a component may have, in monomials of this
/// degree.
fn polynomials(space: &Space<'_>, patch: usize, component: usize, degree: usize) -> Vec<Vec<f64>> {
    let partition = space.partition();
    let [origin, scale]: [[f64; 2]; 2] =
        [partition.origin[patch].into(), partition.scale[patch].into()];
    let lines = space.held_lines(patch).iter().filter(|line| line.component == component);
    let lines: Vec<_> = lines
        .map(|line: &HeldLine| (line.across, (line.at - origin[line.across]) / scale[line.across]))
        .collect();
    let Some(first) = degree.checked_sub(lines.len()) else { return Vec::new() };
    let unit = |k: usize| (0..monomials(degree)).map(|j| f64::from(j == k)).collect::<Vec<_>>();
    let through = |polynomial, &(axis, at): &(usize, f64)| times_distance(polynomial, axis, at);
    (0..monomials(first)).map(|k| lines.iter().fold(unit(k), through)).collect()
}

/// A polynomial times ξ − at or η − at; its highest powers are zero.
fn times_distance(polynomial: Vec<f64>, axis: usize, at: f64) -> Vec<f64> {
    let mut product: Vec<f64> = polynomial.iter().map(|c| -at * c).collect();
    // ten monomials of degree 3 are followed by those of degree 4
    for ((a, b), c) in exponents(polynomial.len()).zip(&polynomial).filter(|(_, c)| **c != 0.0) {
        let (total, b) = ((a + b + 1) as usize, b as usize + axis);
        product[total * (total + 1) / 2 + b] += c;
    }
    product
}
