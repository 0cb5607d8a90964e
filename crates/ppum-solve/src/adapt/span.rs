//! The part of values at points that polynomials do not reach.

use ppum::polynomial::exponents;
use ppum::vec2::Vec2;

/// Polynomials of which the others leave less than this part are taken for combinations of them.
const DEPENDENT: f64 = 1e-6;

/// Removes from columns of values at some places, times the roots of their weights, what
/// polynomials of the degree below `order` have of them; the square of what is left. Places are in
/// units of half a cell.
pub(super) fn unseen(places: &[(Vec2, f64)], order: usize, rest: &mut [Vec<f64>]) -> f64 {
    let mut known: Vec<Vec<f64>> = Vec::new();
    for (a, b) in order.checked_sub(1).into_iter().flat_map(exponents) {
        let monomial = |&(x, root): &(Vec2, f64)| root * x.x.powi(a) * x.y.powi(b);
        let mut column: Vec<f64> = places.iter().map(monomial).collect();
        let before = dot(&column, &column);
        // twice is enough
        for _ in 0..2 {
            known.iter().for_each(|other| remove(other, &mut column));
        }
        let square = dot(&column, &column);
        if square > DEPENDENT * DEPENDENT * before {
            column.iter_mut().for_each(|value| *value /= square.sqrt());
            rest.iter_mut().for_each(|rest| remove(&column, rest));
            known.push(column);
        }
    }
    rest.iter().map(|rest| dot(rest, rest)).sum()
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Makes a column orthogonal to a unit one.
fn remove(unit: &[f64], column: &mut [f64]) {
    let part = dot(unit, column);
    column.iter_mut().zip(unit).for_each(|(value, unit)| *value -= part * unit);
}
