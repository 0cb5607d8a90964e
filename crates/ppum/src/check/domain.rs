//! The rules for a dataset's domain.

use super::edges::check_edges;
use super::errors::{CheckResult, Errors, check_box, check_number, check_points, require};
use crate::domain::{Domain, Hole};

/// Most circles and corners of polygons that holes may have together: whether a point lies in a
/// hole asks all of them.
const MAX_RIMS: usize = 1 << 14;

pub(super) fn check(domain: &Domain, errors: &mut Errors) {
    errors.add(check_box("", &domain.bounds));
    let rims = domain.holes.iter().map(|hole| match hole {
        Hole::Circle { .. } => 1,
        Hole::Polygon { points, .. } => points.len(),
    });
    let count: usize = rims.sum();
    errors.add(require(count <= MAX_RIMS, "holes", || {
        format!("{count} circles and corners of polygons are more than {MAX_RIMS}")
    }));
    errors.each("holes", &domain.holes, |_, hole| check_hole(hole));
}

fn check_hole(hole: &Hole) -> CheckResult {
    match hole {
        Hole::Circle { center, radius } => {
            check_points("center", &[*center])?;
            check_number("radius", *radius)?;
            require(*radius > 0.0, "radius", || format!("{radius} is not positive"))
        }
        Hole::Polygon { points, bulges, .. } => {
            let least = if bulges.iter().any(|bulge| *bulge != 0.0) { 2 } else { 3 };
            require(points.len() >= least, "", || {
                format!(
                    "has {} points, a polygon needs three or more, or two between arcs",
                    points.len()
                )
            })?;
            check_edges(points, bulges, true)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::tests::place_after;
    use super::*;
    use crate::vec2::vec2;

    #[test]
    fn holes() {
        let circle = |x, radius| Hole::Circle { center: vec2(x, 0.5), radius };
        let polygon =
            |points: &[[f64; 2]]| Hole::polygon(points.iter().copied().map(Into::into).collect());
        for (hole, place) in [
            (circle(0.5, 0.0), "domain.holes[1].radius"),
            (circle(0.5, f64::INFINITY), "domain.holes[1].radius"),
            (circle(f64::NAN, 0.1), "domain.holes[1].center[0]"),
            (polygon(&[[0.0, 0.0], [1.0, 0.0]]), "domain.holes[1]"),
            (polygon(&[[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]]), "domain.holes[1].segment[2]"),
            (polygon(&[[0.0, 0.0], [1.0, f64::NAN], [0.0, 1.0]]), "domain.holes[1].points[1]"),
            (polygon(&vec![[0.0, 0.0]; MAX_RIMS]), "domain.holes"),
        ] {
            assert_eq!(place_after(|d| d.domain.holes = vec![circle(0.5, 0.25), hole]), place);
        }
    }

    /// A polygon of two points has arcs, whose bulges are one for each point.
    #[test]
    fn holes_with_arcs() {
        let hole = |points: &[[f64; 2]], bulges: &[f64]| {
            let points = points.iter().copied().map(Into::into).collect();
            Hole::with_arcs(points, bulges.to_vec(), crate::domain::PolygonSide::Inside)
        };
        let (lens, triangle) = ([[0.2, 0.5], [0.4, 0.5]], [[0.2, 0.2], [0.4, 0.2], [0.3, 0.4]]);
        let mut good = super::super::tests::dataset();
        let fine =
            [(&lens[..], &[1.0, 1.0][..]), (&lens, &[0.5, 0.0]), (&triangle, &[0.0, 9.0, -0.1])];
        good.domain.holes = fine.map(|(points, bulges)| hole(points, bulges)).to_vec();
        assert_eq!(good.check(), Ok(()));
        for (points, bulges, place) in [
            (&lens[..], &[0.0, 0.0][..], ""),
            (&lens, &[0.5], ".bulges"),
            (&lens, &[0.5, f64::NAN], ".bulges[1]"),
            (&triangle, &[0.5, 0.0, -65.0], ".bulges[2]"),
            (&[[0.2, 0.5]; 2], &[0.5, 0.5], ".segment[0]"),
            // the same arc, there and back
            (&lens, &[0.5, -0.5], ".segment[0]"),
        ] {
            let found = place_after(|d| d.domain.holes = vec![hole(points, bulges)]);
            assert_eq!(found, format!("domain.holes[0]{place}"));
        }
    }
}
