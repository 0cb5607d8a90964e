//! Points at which quantities are infinite, and how much is allowed near them.

use ppum::crack::{Side, tips};
use ppum::field::Field;
use ppum::function::{Frame, FunctionKind};
use ppum::quantity::Quantity;
use ppum::segment;
use ppum::vec2::Vec2;

use super::arrays::ArrayColumns;
use super::borders::{SAME, longest};

/// The default radius about a singular point in parts of the length on which the field varies
/// there: the values at the radius make the range, which grows as R^−½ and loosens the tolerance
/// elsewhere.
const RADIUS: f64 = 0.02;

/// Part of the radius below which nothing is asked for.
const INNERMOST: f64 = 0.01;

/// Points at which some quantities are infinite.
#[derive(Clone, Debug)]
pub(super) struct SingularPoints {
    pub(super) points: Vec<Vec2>,
    /// For each point the radius within which the tolerance is loosened.
    pub(super) radii: Vec<f64>,
    /// For each column whether it is infinite at one of them.
    pub(super) columns: Vec<bool>,
}

impl SingularPoints {
    /// Tips and origins of functions at which a quantity is not finite, with one radius or that
    /// which suits each point.
    pub(super) fn new(field: &Field<'_>, columns: &ArrayColumns, radius: Option<f64>) -> Self {
        let width = columns.len();
        let mut found = Self { points: Vec::new(), radii: Vec::new(), columns: vec![false; width] };
        for point in candidates(field) {
            let mut local = field.at(point);
            let value = |q: &Quantity| q.at(&mut local, Vec2::ZERO, Side::Above);
            let values: Vec<f64> = columns.quantities.iter().map(value).collect();
            found.add(field, point, &values, radius);
        }
        found
    }

    /// Adds a point if one of the values there is infinite; outside of the domain and where there
    /// is no value it is NaN.
    pub(super) fn add(
        &mut self,
        field: &Field<'_>,
        point: Vec2,
        values: &[f64],
        radius: Option<f64>,
    ) {
        if !values.iter().any(|value| value.is_infinite()) || self.points.contains(&point) {
            return;
        }
        self.points.push(point);
        self.radii.push(radius.unwrap_or_else(|| RADIUS * extent(field, point)));
        self.columns.iter_mut().zip(values).for_each(|(known, new)| *known |= new.is_infinite());
    }

    /// How many times the tolerance is allowed at a point for singular quantities: 1 outside of
    /// the radius R, R/r within, infinitely many next to a point.
    pub(super) fn loosened(&self, at: Vec2) -> f64 {
        let part = |(p, radius): (&Vec2, &f64)| (at - *p).length() / radius;
        let part = self.points.iter().zip(&self.radii).map(part).fold(f64::INFINITY, f64::min);
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

/// The length on which the field varies near a point: that of the crack that it lies on, half of it
/// if both ends are tips, the size of the hole, or the distance from any other border or crack,
/// whichever is smallest.
fn extent(field: &Field<'_>, p: Vec2) -> f64 {
    let bounds = &field.domain.bounds;
    let sides = bounds.sides().map(|side| (segment::distance(side, p), f64::INFINITY));
    let holes = field.domain.holes.iter();
    let holes = holes.map(|hole| (hole.rim_distance(p), longest(&hole.rim_bounds())));
    let cracks = field.step.cracks.iter().map(|crack| {
        let tips = crack.tips().count().max(1);
        let away = crack.distance(p);
        (away, crack.length() / tips as f64)
    });
    let near = SAME * longest(bounds);
    let lengths = sides.into_iter().chain(holes).chain(cracks);
    lengths.map(|(away, own)| if away > near { away } else { own }).fold(longest(bounds), f64::min)
}
