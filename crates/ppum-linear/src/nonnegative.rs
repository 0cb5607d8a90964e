//! Least squares with factors that are not negative.

use super::conjugate::{dot, norm};
use faer::Mat;
use faer::linalg::solvers::SolveLstsq;

/// Part of a column and of what is left of the target by which their product is rounding.
const ROUNDING: f64 = 1e-12;

/// Returns the residual of a target, b − A x, where x ≥ 0 makes it least: the columns that x takes
/// are orthogonal to it, and no other points in its direction (Lawson & Hanson 1974).
pub fn nonnegative_residual(columns: &Mat<f64>, target: &[f64]) -> Vec<f64> {
    let (rows, n) = (target.len(), columns.ncols());
    let column = |k: usize| columns.col_as_slice(k);
    let (mut factors, mut taken, mut left) = (vec![0.0; n], Vec::new(), target.to_vec());
    let least = |k: usize| ROUNDING * norm(column(k)) * norm(target);
    // each round makes the residual smaller, up to rounding
    for _ in 0..4 * n {
        let others = (0..n).filter(|k| !taken.contains(k)).map(|k| (k, dot(column(k), &left)));
        let Some((next, _)) =
            others.filter(|(k, slope)| *slope > least(*k)).max_by(|a, b| a.1.total_cmp(&b.1))
        else {
            break;
        };
        if taken.len() == rows {
            break;
        }
        taken.push(next);
        while let Some(part) = improve(columns, target, &taken, &mut factors) {
            taken.retain(|&k| factors[k] > part);
        }
        left = (0..rows)
            .map(|row| {
                target[row] - taken.iter().map(|&k| columns[(row, k)] * factors[k]).sum::<f64>()
            })
            .collect();
    }
    left
}

/// Goes to the best factors of some columns, or as far towards them as none is negative: then the
/// largest factor that is zero except for rounding is what is returned.
fn improve(
    columns: &Mat<f64>,
    target: &[f64],
    taken: &[usize],
    factors: &mut [f64],
) -> Option<f64> {
    let own = Mat::from_fn(target.len(), taken.len(), |row, k| columns[(row, taken[k])]);
    let right = Mat::from_fn(target.len(), 1, |row, _| target[row]);
    let best = own.qr().solve_lstsq(right);
    let steps = taken.iter().enumerate().filter(|(j, _)| best[(*j, 0)] <= 0.0);
    let steps = steps.map(|(j, &k)| factors[k] / (factors[k] - best[(j, 0)]));
    let step = steps.fold(1.0, f64::min);
    for (j, &k) in taken.iter().enumerate() {
        factors[k] += step * (best[(j, 0)] - factors[k]);
    }
    let largest = taken.iter().map(|&k| factors[k]).fold(0.0, f64::max);
    (step < 1.0).then_some(ROUNDING * largest)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Columns (1, 0) and (1, 1) reach what lies between them, and leave the rest of others.
    #[test]
    fn cones_hold_what_lies_between_their_columns() {
        let columns = Mat::from_fn(2, 2, |row, k| if row == 0 || k == 1 { 1.0 } else { 0.0 });
        for (target, expected) in [
            ([3.0, 1.0], [0.0, 0.0]),
            ([0.0, 2.0], [-1.0, 1.0]),
            ([2.0, -1.0], [0.0, -1.0]),
            ([-1.0, -0.5], [-1.0, -0.5]),
        ] {
            let left = nonnegative_residual(&columns, &target);
            assert!(left.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-14), "{left:?}");
        }
    }
}
