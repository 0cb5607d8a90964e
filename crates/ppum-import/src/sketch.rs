//! The data that readers make from a file: curves with names and places, and notices of what they
//! left.

use std::collections::{BTreeMap, BTreeSet};

use ppum::vec2::Vec2;

use crate::affine::PlaneMap;
use crate::bspline::BSpline;
use crate::curve::PlaneCurve;
use crate::error::ImportError;
use crate::source::SourceLine;

/// Most curves that are read: a problem file holds fewer.
const MOST_CURVES: usize = 1 << 20;

/// Distance of arcs from the Bézier curve or B-spline for which they are taken, in parts of the
/// tolerance: 10⁻⁸ of the drawing, for which a quarter of a circle's size takes some 50.
const FIT: f64 = 1e-2;

/// The begin of the message about a drawing without curves.
pub(crate) const NO_CURVES: &str = "the file has no curves that can be read";

/// Most things that are named.
const MOST_NOTICES: usize = 50;

/// A curve of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedCurve<C = PlaneCurve> {
    /// Its points.
    pub curve: C,
    /// The layer, group or label.
    pub name: Option<String>,
    /// Where it was read.
    pub source: SourceLine,
    /// True for a crack, whatever its name.
    pub is_crack: bool,
}

impl<C> NamedCurve<C> {
    pub(crate) fn new(curve: C, name: Option<String>, source: SourceLine) -> Self {
        Self { curve, name, source, is_crack: false }
    }
}

/// A curve as a file draws it.
#[derive(Clone, Debug)]
pub(crate) enum DrawnCurve {
    /// One that the problem file knows.
    Plane(PlaneCurve),
    /// One that becomes arcs once the size of the drawing is known.
    BSpline(BSpline),
}

impl From<PlaneCurve> for DrawnCurve {
    fn from(curve: PlaneCurve) -> Self {
        Self::Plane(curve)
    }
}

impl From<BSpline> for DrawnCurve {
    fn from(spline: BSpline) -> Self {
        Self::BSpline(spline)
    }
}

impl DrawnCurve {
    /// Straight segments through points.
    pub(crate) fn polyline(points: Vec<Vec2>) -> Self {
        PlaneCurve::Polyline(points).into()
    }

    pub(crate) fn mapped(&self, map: &PlaneMap) -> Self {
        match self {
            Self::Plane(curve) => curve.mapped(map).into(),
            Self::BSpline(spline) => spline.clone().mapped(map).into(),
        }
    }

    fn is_finite(&self) -> bool {
        match self {
            Self::Plane(curve) => curve.is_finite(),
            Self::BSpline(spline) => PlaneCurve::Polyline(spline.points().to_vec()).is_finite(),
        }
    }

    /// Points around which the curve lies, about.
    fn extent(&self) -> Vec<Vec2> {
        match self {
            Self::Plane(PlaneCurve::Polyline(points) | PlaneCurve::Spline(points)) => {
                points.clone()
            }
            Self::Plane(PlaneCurve::Arc(arc)) => {
                arc.halves().iter().flat_map(|half| half.range.map(|t| half.point(t))).collect()
            }
            Self::Plane(PlaneCurve::Edges(edges)) => edges.iter().map(|edge| edge.from).collect(),
            Self::BSpline(spline) => spline.points().to_vec(),
        }
    }
}

/// The curves of a file, as they were read.
#[derive(Debug, Default)]
pub(crate) struct Sketch {
    pub(crate) curves: Vec<NamedCurve<DrawnCurve>>,
    /// A sentence on units and version.
    pub(crate) about: Option<String>,
    /// True if names are layers, which need not tell the sides of a body apart.
    pub(crate) is_layered: bool,
    /// True for a mesh that has lines alone.
    pub(crate) is_mesh_without_faces: bool,
    /// How far curves of the problem file are from those of the drawing.
    fit: Option<String>,
    /// Remarks about lines: how often, and the first one.
    remarks: BTreeMap<String, (usize, SourceLine)>,
}

impl Sketch {
    /// A sketch of a file with layers and groups.
    pub(crate) fn layered() -> Self {
        Self { is_layered: true, ..Self::default() }
    }

    /// Adds a curve, if its numbers are usable; an arc without extent is left.
    pub(crate) fn add(
        &mut self,
        curve: impl Into<DrawnCurve>,
        name: Option<String>,
        source: SourceLine,
    ) -> Result<(), ImportError> {
        let curve = curve.into();
        if !curve.is_finite() {
            return Err(source.error("has numbers that are not finite, or too large"));
        }
        match &curve {
            DrawnCurve::Plane(PlaneCurve::Arc(arc)) if arc.is_empty() => {
                self.leave("arc without extent", source);
            }
            _ => self.curves.push(NamedCurve::new(curve, name, source)),
        }
        if self.curves.len() > MOST_CURVES {
            return Err(ImportError::too_many("curves", MOST_CURVES));
        }
        Ok(())
    }

    /// Leaves curves of these names only; none of them stand for all.
    pub(crate) fn keep(&mut self, layers: &[String]) -> Result<(), ImportError> {
        let names: BTreeSet<_> =
            self.curves.iter().filter_map(|named| named.name.clone()).collect();
        self.curves.retain(|named| {
            layers.is_empty() || named.name.as_ref().is_some_and(|name| layers.contains(name))
        });
        if self.curves.is_empty() {
            let names: Vec<_> = names.into_iter().collect();
            let names = match &names[..] {
                [] => String::new(),
                names => format!(" of these names; it has {}", names.join(", ")),
            };
            let notices = self.notices().into_iter().map(|notice| format!("; {notice}"));
            let notices: String = notices.collect();
            return Err(ImportError(format!("{NO_CURVES}{names}{notices}")));
        }
        // the layer of what has none
        let is_layer = |name: &String| !(self.is_layered && name == "0");
        self.curves.iter_mut().for_each(|named| named.name = named.name.take().filter(is_layer));
        Ok(())
    }

    /// Remembers something that is not read.
    pub(crate) fn leave(&mut self, what: impl std::fmt::Display, source: SourceLine) {
        self.remark(format!("not read: {what}"), source);
    }

    /// Remembers something to be said of a line, and how often it was.
    pub(crate) fn remark(&mut self, what: impl Into<String>, source: SourceLine) {
        self.remarks.entry(what.into()).or_insert((0, source)).0 += 1;
    }

    /// The notices, in the order of the file.
    pub(crate) fn notices(&self) -> Vec<String> {
        let mut remarks: Vec<_> = self.remarks.iter().collect();
        remarks.sort_by_key(|(_, (_, first))| first.line);
        let shown = remarks.iter().take(MOST_NOTICES).map(|(what, (count, first))| match count {
            1 => format!("{first}: {what}"),
            _ => format!("{first}: {what}, and {} more", count - 1),
        });
        let rest = remarks.len().saturating_sub(MOST_NOTICES);
        let rest = (rest > 0).then(|| format!("{rest} other kinds of things were not read"));
        self.fit.iter().cloned().chain(shown).chain(rest).collect()
    }

    /// The longer side of the box around all curves.
    pub(crate) fn size(&self) -> f64 {
        let points = || self.curves.iter().flat_map(|named| named.curve.extent());
        let (low, high) = (points().reduce(Vec2::min), points().reduce(Vec2::max));
        low.zip(high).map_or(0.0, |(low, high)| (high - low).x.max((high - low).y))
    }

    /// The curves of the problem file that stand for those of the drawing, those for B-splines
    /// last.
    pub(crate) fn fitted(&mut self, tolerance: f64) -> Vec<NamedCurve> {
        let (mut is_fitted, mut known, mut fitted) = (false, Vec::new(), Vec::new());
        for NamedCurve { curve, name, source, is_crack } in std::mem::take(&mut self.curves) {
            let spline = match curve {
                DrawnCurve::Plane(curve) => {
                    known.push(NamedCurve { curve, name, source, is_crack });
                    continue;
                }
                DrawnCurve::BSpline(spline) => spline,
            };
            let (curves, has_cusp) = spline.fitted(FIT * tolerance);
            is_fitted |= curves.iter().any(|curve| matches!(curve, PlaneCurve::Edges(_)));
            fitted.extend(
                curves.into_iter().map(|curve| NamedCurve::new(curve, name.clone(), source)),
            );
            if has_cusp {
                self.remark("the curve has a cusp and became a polyline", source);
            }
        }
        self.fit = is_fitted.then(|| {
            let distance = FIT * tolerance;
            format!("Bézier curves and B-splines became arcs, {distance:.1e} from them at most")
        });
        known.extend(fitted);
        known
    }

    /// Maps all curves, as the y axis of SVG, which points down.
    pub(crate) fn map(&mut self, map: &PlaneMap) {
        self.curves.iter_mut().for_each(|named| named.curve = named.curve.mapped(map));
    }
}
