//! Outline, holes and cracks from curves: chains that close, and how they lie in each other.

use ppum::segment;
use ppum::vec2::Vec2;

use crate::chain::{CurveChain, Joints, Network};
use crate::crossing;
use crate::curve::PlaneCurve;
use crate::error::{ImportError, shown};
use crate::sketch::{NO_CURVES, NamedCurve, Sketch};

/// Most closed curves, and most open ones.
const MOST_CHAINS: usize = 10_000;

/// How far cracks may end beyond the outline, in parts of the size: flattened arcs are so exact.
const BEYOND: f64 = 1e-3;

/// The boundary and the cracks of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct BodyDrawing {
    /// The closed curve around everything, counter-clockwise.
    pub outline: CurveChain,
    /// The closed curves in it.
    pub holes: Vec<CurveChain>,
    /// The open curves in it.
    pub cracks: Vec<CurveChain>,
    /// The longer side of the box around the drawing.
    pub size: f64,
    /// The distance within which ends were joined.
    pub tolerance: f64,
    /// The units and version that the file states.
    pub about: Option<String>,
    /// Sentences on what was not read or was changed, with its place.
    pub notices: Vec<String>,
    /// True if names of curves are layers.
    pub(crate) is_layered: bool,
}

/// A closed curve with its points.
struct ClosedCurve {
    chain: CurveChain,
    points: Vec<Vec2>,
    area: f64,
}

impl ClosedCurve {
    fn new(chain: CurveChain) -> Self {
        let points = chain.flattened();
        let area = segment::signed_area(&points);
        if area < 0.0 {
            return Self::new(chain.reversed());
        }
        Self { chain, points, area }
    }
}

/// The drawing of a body.
pub(crate) fn assemble(mut sketch: Sketch, tolerance: f64) -> Result<BodyDrawing, ImportError> {
    let size = sketch.size();
    let tolerance = tolerance * size;
    let curves = sketch.fitted(tolerance);
    let curves = without_copies(curves, tolerance, &mut sketch);
    let (cracks, curves): (Vec<_>, Vec<_>) =
        curves.into_iter().partition(NamedCurve::is_named_crack);
    let mut network = Network::new(curves, &mut Joints::new(tolerance));
    let open = Network::new(network.without_open(), &mut Joints::new(tolerance)).chains();
    network.check_branches()?;
    let closed: Vec<_> = network.chains().into_iter().map(ClosedCurve::new).collect();
    let cracks = Network::new(cracks, &mut Joints::new(tolerance)).chains();
    let [outline, holes @ ..] = &mut nested(closed, &open)?[..] else {
        return Err(no_outline(&open));
    };
    let cracks: Vec<_> = open.into_iter().chain(cracks).collect();
    check_cracks(&cracks, outline, size)?;
    let borders = straight_segments([&*outline].into_iter().chain(&*holes));
    let cracks = cracks.into_iter().map(|crack| snapped(crack, &borders, tolerance)).collect();
    let holes = holes.iter_mut().map(|hole| hole.chain.clone()).collect();
    Ok(BodyDrawing {
        outline: outline.chain.clone(),
        holes,
        cracks,
        size,
        tolerance,
        about: sketch.about.clone(),
        is_layered: sketch.is_layered,
        notices: sketch.notices(),
    })
}

impl NamedCurve {
    /// True for curves that are cracks by their name.
    fn is_named_crack(&self) -> bool {
        let named =
            |name: &String| name.get(..5).is_some_and(|start| start.eq_ignore_ascii_case("crack"));
        self.is_crack || self.name.as_ref().is_some_and(named)
    }
}

/// The curves without those of no length, and without equal ones, of which one is kept.
fn without_copies(curves: Vec<NamedCurve>, tolerance: f64, sketch: &mut Sketch) -> Vec<NamedCurve> {
    let mut joints = Joints::new(tolerance);
    let mut seen = std::collections::HashSet::new();
    let mut is_kept = |named: &NamedCurve| {
        let points = named.curve.flattened();
        let length: f64 = points.windows(2).map(|p| (p[1] - p[0]).length()).sum();
        if length <= tolerance {
            sketch.leave("curve shorter than the tolerance", named.source);
            return false;
        }
        let mut key = named.curve.ends().map(|p| joints.number(p));
        key.sort_unstable();
        let is_new = seen.insert((key, joints.number(centroid(&points, length))));
        if !is_new {
            sketch.leave("copy of another curve", named.source);
        }
        is_new
    };
    curves.into_iter().filter(|named| is_kept(named)).collect()
}

/// The centre of a polyline's length, the same whichever way it runs.
fn centroid(points: &[Vec2], length: f64) -> Vec2 {
    let part = |p: &[Vec2]| (p[0] + p[1]) * (0.5 * (p[1] - p[0]).length() / length);
    points.windows(2).map(part).fold(Vec2::ZERO, |sum, part| sum + part)
}

/// The closed curves, the outline first; the others lie in it and not in each other.
fn nested(
    mut closed: Vec<ClosedCurve>,
    open: &[CurveChain],
) -> Result<Vec<ClosedCurve>, ImportError> {
    if closed.len().max(open.len()) > MOST_CHAINS {
        return Err(ImportError::too_many("separate curves", MOST_CHAINS));
    }
    closed.sort_by(|a, b| b.area.total_cmp(&a.area));
    let source = |c: &ClosedCurve| c.chain.curves[0].source;
    crossing::check(&closed.iter().map(|c| (&c.points[..], source(c))).collect::<Vec<_>>())?;
    let Some((outline, holes)) = closed.split_first() else { return Ok(closed) };
    if let Some(beside) = holes.iter().find(|hole| !contains(&outline.points, hole.points[0])) {
        let [first, second] =
            [outline, beside].map(|c| format!("{} ({})", shown(c.points[0]), source(c)));
        return Err(ImportError(format!(
            "the closed curves at {first} and at {second} lie beside each other: there is more than one body; keep \
             one of them"
        )));
    }
    for (k, hole) in holes.iter().enumerate() {
        let at = hole.points[0];
        if let Some(around) = holes[..k].iter().find(|around| contains(&around.points, at)) {
            return Err(ImportError(format!(
                "the closed curve at {} ({}) lies in the hole of {}: it would be another body; remove it",
                shown(at),
                source(hole),
                source(around)
            )));
        }
    }
    Ok(closed)
}

/// True for points in a closed polyline, by the number of its segments to the right.
pub(crate) fn contains(points: &[Vec2], p: Vec2) -> bool {
    let is_right = |s: &&[Vec2]| {
        (s[0].y > p.y) != (s[1].y > p.y)
            && p.x < s[0].x + (s[1].x - s[0].x) * ((p.y - s[0].y) / (s[1].y - s[0].y))
    };
    points.windows(2).filter(is_right).count() % 2 == 1
}

/// The error of a drawing without a closed curve.
fn no_outline(open: &[CurveChain]) -> ImportError {
    let spread = |chain: &&CurveChain| {
        let points = chain.flattened();
        let corner = points.iter().fold(points[0], |a, b| a.min(*b));
        points.iter().map(|p| (*p - corner).length()).fold(0.0, f64::max)
    };
    let largest = open.iter().max_by(|a, b| spread(a).total_cmp(&spread(b)));
    let Some([first, .., last] | [first @ last]) = largest.map(|chain| &chain.curves[..]) else {
        return ImportError(NO_CURVES.to_owned());
    };
    let ([from, _], [_, to]) = (first.curve.ends(), last.curve.ends());
    ImportError(format!(
        "no curve closes: the outline is open from {} ({}) to {} ({}), a gap of {}; close it",
        shown(from),
        first.source,
        shown(to),
        last.source,
        (to - from).length()
    ))
}

/// Refuses cracks that close, or lie outside.
fn check_cracks(
    cracks: &[CurveChain],
    outline: &ClosedCurve,
    size: f64,
) -> Result<(), ImportError> {
    for crack in cracks {
        let (points, curve) = (crack.flattened(), crack.curves[0].source);
        if crack.is_closed {
            return Err(ImportError(format!(
                "the crack at {} ({curve}) closes, and would cut the body; open it, or give it another name",
                shown(points[0])
            )));
        }
        let distance = |p: &Vec2| segment::polyline_distance(&outline.points, *p);
        let is_outside = |p: &&Vec2| !contains(&outline.points, **p) && distance(p) > BEYOND * size;
        if let Some(at) = points.iter().find(is_outside) {
            return Err(ImportError(format!(
                "the open curve of {curve}, a crack, leaves the body at {}; shorten it, or leave it out",
                shown(*at)
            )));
        }
    }
    Ok(())
}

/// The segments of the straight parts of boundaries.
fn straight_segments<'a>(borders: impl Iterator<Item = &'a ClosedCurve>) -> Vec<[Vec2; 2]> {
    let curves = borders.flat_map(|border| &border.chain.curves);
    let polylines = curves.filter_map(|named| match &named.curve {
        PlaneCurve::Polyline(points) => Some(points),
        _ => None,
    });
    polylines.flat_map(|points| points.windows(2).map(|p| [p[0], p[1]])).collect()
}

/// The crack with ends on the boundary, where they miss a straight part of it by the tolerance.
fn snapped(crack: CurveChain, borders: &[[Vec2; 2]], tolerance: f64) -> CurveChain {
    let ([first, .., last] | [first @ last]) = &crack.curves[..] else { return crack };
    let ends = [first.curve.ends()[0], last.curve.ends()[1]];
    let on_border = ends.map(|end| {
        let points = borders.iter().map(|segment| segment::closest_point(*segment, end));
        let nearest = points.min_by(|a, b| (*a - end).length().total_cmp(&(*b - end).length()));
        nearest.filter(|point| (*point - end).length() <= tolerance).unwrap_or(end)
    });
    crack.with_ends(on_border)
}

/// A whole ellipse, if a chain is one.
pub(crate) fn whole_ellipse(chain: &CurveChain) -> Option<&crate::curve::EllipseArc> {
    match &chain.curves[..] {
        [NamedCurve { curve: PlaneCurve::Arc(arc), .. }] if arc.is_closed() => Some(arc),
        _ => None,
    }
}
