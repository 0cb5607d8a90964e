//! The curves that an element draws.

use ppum::vec2::Vec2;

use crate::bspline::BSpline;
use crate::curve::PlaneCurve;

/// A curve of an element.
pub(super) enum SvgCurve {
    Curve(PlaneCurve),
    Spline(BSpline),
}

impl SvgCurve {
    pub(super) fn polyline(points: Vec<Vec2>) -> Self {
        Self::Curve(PlaneCurve::Polyline(points))
    }
}
