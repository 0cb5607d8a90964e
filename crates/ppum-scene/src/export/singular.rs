//! Points at which quantities are infinite, and how much is allowed near them.

use ppum::crack::{Side, tips};
use ppum::field::Field;
use ppum::function::{Frame, FunctionKind};
use ppum::vec2::Vec2;

use super::arrays::Columns;

/// Part of the radius below which nothing is asked for.
const INNERMOST: f64 = 0.01;

/// Points at which some quantities are infinite.
#[derive(Clone, Debug)]
pub(super) struct Singular {
    pub(super) points: Vec<Vec2>,
    /// Nothing is claimed nearer to them.
    pub(super) radius: f64,
    /// For each column whether it is infinite at one of them.
    pub(super) columns: Vec<bool>,
}

impl Singular {
    /// Tips and origins of functions at which a quantity is not finite.
    pub(super) fn new(field: &Field<'_>, columns: &Columns, radius: f64) -> Self {
        let mut found = Self { points: Vec::new(), radius, columns: vec![false; columns.len()] };
        for point in candidates(field) {
            let mut local = field.at(point);
            let mut is_infinite = |quantity: &ppum::quantity::Quantity| {
                let value = quantity.at(&mut local, Vec2::ZERO, Side::Above);
                // outside of the domain and without a value it is NaN
                value.is_infinite()
            };
            let infinite: Vec<bool> = columns.quantities.iter().map(&mut is_infinite).collect();
            if infinite.contains(&true) && !found.points.contains(&point) {
                found.points.push(point);
                found.columns.iter_mut().zip(infinite).for_each(|(known, new)| *known |= new);
            }
        }
        found
    }

    /// How many times the tolerance is allowed at a point for singular quantities: 1 outside of
    /// the radius R, R/r within, infinitely many next to a point.
    pub(super) fn loosened(&self, at: Vec2) -> f64 {
        let away = |p: &Vec2| (at - *p).length();
        let part = self.points.iter().map(away).fold(f64::INFINITY, f64::min) / self.radius;
        if part < INNERMOST { f64::INFINITY } else { (1.0 / part).max(1.0) }
    }
}

fn candidates(field: &Field<'_>) -> Vec<Vec2> {
    let cracks = &field.step.cracks;
    let tips = tips(cracks).map(|tip| cracks[tip.crack as usize].end_point(tip.end));
    let origin = |kind: &FunctionKind| match kind {
        FunctionKind::Formula { frame: Frame::Fixed { origin, .. }, .. } => Some(*origin),
        _ => None,
    };
    tips.chain(field.step.functions.iter().filter_map(|f| origin(&f.kind))).collect()
}
