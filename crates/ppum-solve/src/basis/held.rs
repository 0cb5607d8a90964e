//! The basis of a patch in which a component of the field vanishes on lines.
//!
//! The unknowns are fields v of both components: polynomials, jumps times polynomials, and the
//! fields of series, which have the symmetry of the line. In a component that is zero on the line
//! d(x) = 0 polynomials are those times d; of two components that are held on different lines each
//! is a coefficient of the direction across the other one:
//!
//! ```text
//! P_p → d P_(p−1)      G = Σ_i F_i M F_iᵀ      C_i = R F_i,   R G Rᵀ = I
//! ```
//!
//! with the coefficients F_i of the fields in component i, the Gram matrix M of the functions, and
//! R as for functions ([`Transform`]). Series are not made of stable functions first: where they
//! are nearly polynomials, what is cut off of their functions would break their symmetry. Functions
//! that are of no series count as jumps do, but those of a tip that are odd about its line vanish
//! there of themselves.

use super::tie::VectorField;
use super::transform::{CUT_OFF, Transform};
use crate::space::TrialSpace;
use crate::terms::HeldLine;
use faer::Mat;
use ppum::dataset::monomials;
use ppum::function::{Frame, FunctionKind, Role, WESTERGAARD};
use ppum::polynomial::exponents;
use ppum::vec2::{Vec2, vec2};
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
    space: &TrialSpace<'_>,
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

/// The fields of each block that is of no series: of polynomials, jumps and formulas.
fn plain_fields(space: &TrialSpace<'_>, patch: usize) -> Vec<Vec<VectorField>> {
    let (data, mut first, n) = (space.data(), 0, space.evaluated(patch));
    let parts = directions(space.held_lines(patch));
    let of_block = |block: usize| {
        if let Some(series) = space.series(patch).iter().find(|s| s.blocks.contains(&block)) {
            first += if block == series.blocks.start { series.evaluated() } else { 0 };
            return None;
        }
        let degree = usize::from(data.block_degree[block]);
        let start = first;
        first += monomials(degree);
        let kind = &space.step().functions[data.block_function[block] as usize].kind;
        let field = |direction: Vec2, polynomial: &[f64]| {
            <[f64; 2]>::from(direction).map(|part| {
                let mut own = vec![0.0; n];
                let all = own[start..].iter_mut().zip(polynomial);
                all.for_each(|(c, p)| *c = part * p);
                own
            })
        };
        let of_direction = |(direction, lines): &(Vec2, Vec<HeldLine>)| {
            let others: Vec<_> =
                lines.iter().filter(|line| !vanishes_on(space, kind, line)).copied().collect();
            let all = polynomials(space, patch, &others, degree).into_iter();
            all.map(|polynomial| field(*direction, &polynomial)).collect::<Vec<_>>()
        };
        Some(parts.iter().flat_map(of_direction).collect())
    };
    data.blocks(patch).filter_map(of_block).collect()
}

/// True for the functions of a tip on a line that are odd about its axis.
fn vanishes_on(space: &TrialSpace<'_>, kind: &FunctionKind, line: &HeldLine) -> bool {
    let FunctionKind::Formula { text, frame: Frame::Tip(tip), role: Role::Tip, .. } = kind else {
        return false;
    };
    let crack = &space.step().cracks[tip.crack as usize];
    let at = crack.end_point(tip.end);
    let is_odd = WESTERGAARD.iter().skip(1).step_by(2).any(|odd| odd == text);
    let is_along = line.normal.dot(crack.growth_direction(tip.end)).abs() < SAME;
    let size =
        space.partition().half.iter().map(|half| half.x.min(half.y)).fold(f64::MAX, f64::min);
    is_odd && is_along && (line.normal.dot(at) - line.at).abs() < SAME * size
}

/// Sine of the angle up to which directions are the same.
const SAME: f64 = 1e-9;

/// Two directions, and for each the lines on which its coefficient vanishes.
///
/// With the held components d₁ and d₂ these are the directions e₁ across d₂ and e₂ across d₁: the
/// component d₁ of a e₁ + b e₂ is a e₁·d₁. If more than two are held in a patch, both vanish on all
/// lines.
fn directions(lines: &[HeldLine]) -> [(Vec2, Vec<HeldLine>); 2] {
    let first = lines.first().map_or(vec2(1.0, 0.0), |line| line.direction);
    let is_same = |a: Vec2, b: Vec2| a.cross(b).abs() < SAME;
    let (own, others): (Vec<_>, Vec<_>) =
        lines.iter().copied().partition(|line| is_same(line.direction, first));
    let second = others.first().map_or(first.left(), |line| line.direction);
    match others.iter().all(|line| is_same(line.direction, second)) {
        true if others.is_empty() => [(first, own), (second, others)],
        true => [(second.left(), own), (first.left(), others)],
        false => [(first, lines.to_vec()), (first.left(), lines.to_vec())],
    }
}

/// A basis of the polynomials up to a degree that vanish on lines, in monomials of this degree.
fn polynomials(
    space: &TrialSpace<'_>,
    patch: usize,
    lines: &[HeldLine],
    degree: usize,
) -> Vec<Vec<f64>> {
    let partition = space.partition();
    let (origin, scale) = (partition.origin[patch], partition.scale[patch]);
    // n · x − at in the patch's coordinates, the larger coefficient 1
    let level = |line: &HeldLine| {
        let across = [line.normal.x * scale.x, line.normal.y * scale.y];
        let largest = across[0].abs().max(across[1].abs());
        [across[0], across[1], line.normal.dot(origin) - line.at].map(|c| c / largest)
    };
    let Some(first) = degree.checked_sub(lines.len()) else { return Vec::new() };
    let unit = |k: usize| (0..monomials(degree)).map(|j| f64::from(j == k)).collect::<Vec<_>>();
    let through = |polynomial: Vec<f64>, level: [f64; 3]| times_level(&polynomial, level);
    (0..monomials(first)).map(|k| lines.iter().map(level).fold(unit(k), through)).collect()
}

/// A polynomial times α ξ + β η + γ; its highest powers are zero.
fn times_level(polynomial: &[f64], [alpha, beta, gamma]: [f64; 3]) -> Vec<f64> {
    let mut product: Vec<f64> = polynomial.iter().map(|c| gamma * c).collect();
    // ten monomials of degree 3 are followed by those of degree 4
    for ((a, b), c) in exponents(polynomial.len()).zip(polynomial).filter(|(_, c)| **c != 0.0) {
        let (total, b) = ((a + b + 1) as usize, b as usize);
        let next = total * (total + 1) / 2 + b;
        product[next] += alpha * c;
        product[next + 1] += beta * c;
    }
    product
}
