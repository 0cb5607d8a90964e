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

/// Most things that are named.
const MOST_NOTICES: usize = 50;

/// A curve of a drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedCurve {
    /// Its points.
    pub curve: PlaneCurve,
    /// The layer, group or label.
    pub name: Option<String>,
    /// Where it was read.
    pub source: SourceLine,
    /// True for a crack, whatever its name.
    pub is_crack: bool,
}

impl NamedCurve {
    pub(crate) fn new(curve: PlaneCurve, name: Option<String>, source: SourceLine) -> Self {
        Self { curve, name, source, is_crack: false }
    }
}

/// The curves of a file, as they were read.
#[derive(Debug, Default)]
pub(crate) struct Sketch {
    pub(crate) curves: Vec<NamedCurve>,
    /// Curves that become splines once the size of the drawing is known.
    splines: Vec<(BSpline, Option<String>, SourceLine)>,
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
    pub(crate) fn add(&mut self, named: NamedCurve) -> Result<(), ImportError> {
        let (source, is_finite) = (named.source, named.curve.is_finite());
        match &named.curve {
            PlaneCurve::Arc(arc) if is_finite && arc.is_empty() => {
                self.leave("arc without extent", source);
            }
            _ => self.curves.push(named),
        }
        self.check(source, is_finite)
    }

    /// Adds a curve that becomes a spline.
    pub(crate) fn add_spline(
        &mut self,
        spline: BSpline,
        name: Option<String>,
        source: SourceLine,
    ) -> Result<(), ImportError> {
        let is_finite = PlaneCurve::Polyline(spline.points().to_vec()).is_finite();
        self.splines.push((spline, name, source));
        self.check(source, is_finite)
    }

    fn check(&self, source: SourceLine, is_finite: bool) -> Result<(), ImportError> {
        if !is_finite {
            return Err(ImportError::syntax(
                source,
                "has numbers that are not finite, or too large",
            ));
        }
        if self.curves.len() + self.splines.len() > MOST_CURVES {
            return Err(ImportError::TooMany { what: "curves", most: MOST_CURVES });
        }
        Ok(())
    }

    /// Leaves curves of these names only; none of them stand for all.
    pub(crate) fn keep(&mut self, layers: &[String]) -> Result<(), ImportError> {
        let names = self.names();
        let is_kept = |name: &Option<String>| {
            layers.is_empty() || name.as_ref().is_some_and(|name| layers.contains(name))
        };
        self.curves.retain(|named| is_kept(&named.name));
        self.splines.retain(|(_, name, _)| is_kept(name));
        if self.curves.is_empty() && self.splines.is_empty() {
            return Err(ImportError::Empty { layers: names, notices: self.notices() });
        }
        // the layer of what has none
        let is_layer = |name: &String| !(self.is_layered && name == "0");
        self.curves.iter_mut().for_each(|named| named.name = named.name.take().filter(is_layer));
        self.splines.iter_mut().for_each(|(_, name, _)| *name = name.take().filter(is_layer));
        Ok(())
    }

    /// The names of all curves.
    fn names(&self) -> Vec<String> {
        let curves = self.curves.iter().filter_map(|named| named.name.clone());
        let all: BTreeSet<_> =
            curves.chain(self.splines.iter().filter_map(|s| s.1.clone())).collect();
        all.into_iter().collect()
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
        let ends = self.curves.iter().flat_map(|named| match &named.curve {
            PlaneCurve::Polyline(points) | PlaneCurve::Spline(points) => points.clone(),
            PlaneCurve::Arc(arc) => named
                .curve
                .ends()
                .into_iter()
                .chain(arc.halves().map(|half| half.point(half.range[1])))
                .collect(),
        });
        let inner = self.splines.iter().flat_map(|(spline, ..)| spline.points().to_vec());
        let corners: Option<[Vec2; 2]> = ends.chain(inner).fold(None, |corners, p| match corners {
            Some([low, high]) => Some([low.min(p), high.max(p)]),
            None => Some([p, p]),
        });
        corners.map_or(0.0, |[low, high]| (high - low).x.max((high - low).y))
    }

    /// Replaces B-splines by curves of the problem file.
    pub(crate) fn fit(&mut self, tolerance: f64) {
        let mut largest = 0.0_f64;
        for (spline, name, source) in std::mem::take(&mut self.splines) {
            let (curves, distance) = spline.fitted(tolerance);
            let named = |curve| NamedCurve::new(curve, name.clone(), source);
            self.curves.extend(curves.into_iter().map(named));
            if distance > tolerance {
                self.remark("the curve has a cusp and became a polyline", source);
            }
            largest = largest.max(distance);
        }
        self.fit = (largest > 0.0).then(|| {
            format!("Bézier curves and B-splines became splines, {largest:.1e} from them at most")
        });
    }

    /// Maps all curves, as the y axis of SVG, which points down.
    pub(crate) fn map(&mut self, map: &PlaneMap) {
        for named in &mut self.curves {
            named.curve = named.curve.mapped(map);
        }
        let splines = std::mem::take(&mut self.splines);
        self.splines =
            splines.into_iter().map(|(s, name, source)| (s.mapped(map), name, source)).collect();
    }
}
