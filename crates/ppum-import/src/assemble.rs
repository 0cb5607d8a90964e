//! Outline, holes and cracks from curves: chains that close, and how they lie in each other.

use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2};

use crate::chain::{CurveChain, Joints, Network};
use crate::crossing;
use crate::curve::PlaneCurve;
use crate::error::{ImportError, shown};
use crate::sketch::{NO_CURVES, NamedCurve, Sketch};

/// Most closed curves, and most open ones.
const MOST_CHAINS: usize = 10_000;

/// How far cracks may end beyond the outline, in parts of the size.
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

/// A closed curve with its edges, counter-clockwise.
struct ClosedCurve {
    chain: CurveChain,
    edges: Vec<Edge>,
    /// Its inside.
    inside: Hole,
    area: f64,
}

impl ClosedCurve {
    fn new(chain: CurveChain) -> Self {
        let edges = chain.edges();
        let origin = edges[0].from;
        let area: f64 = edges.iter().map(|edge| edge.area_from(origin)).sum();
        if area < 0.0 {
            return Self::new(chain.reversed());
        }
        let inside = Hole::enclosed(&edges);
        Self { chain, edges, inside, area }
    }

    fn start(&self) -> Vec2 {
        self.edges[0].from
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
    let borders: Vec<Edge> =
        [&*outline].into_iter().chain(&*holes).flat_map(|border| border.edges.clone()).collect();
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
        let edges = named.curve.edges();
        let length: f64 = edges.iter().map(Edge::length).sum();
        if length <= tolerance {
            sketch.leave("curve shorter than the tolerance", named.source);
            return false;
        }
        let mut key = named.curve.ends().map(|p| joints.number(p));
        key.sort_unstable();
        let is_new = seen.insert((key, joints.number(centroid(&edges, length))));
        if !is_new {
            sketch.leave("copy of another curve", named.source);
        }
        is_new
    };
    curves.into_iter().filter(|named| is_kept(named)).collect()
}

/// The centre of the edges' length, the same whichever way they run.
fn centroid(edges: &[Edge], length: f64) -> Vec2 {
    let part = |edge: &Edge| edge.centroid() * (edge.length() / length);
    edges.iter().map(part).fold(Vec2::ZERO, |sum, part| sum + part)
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
    crossing::check(&closed.iter().map(|c| (&c.edges[..], source(c))).collect::<Vec<_>>())?;
    let Some((outline, holes)) = closed.split_first() else { return Ok(closed) };
    if let Some(beside) = holes.iter().find(|hole| !outline.inside.contains(hole.start())) {
        let [first, second] =
            [outline, beside].map(|c| format!("{} ({})", shown(c.start()), source(c)));
        return Err(ImportError(format!(
            "the closed curves at {first} and at {second} lie beside each other: there is more than one body; keep \
             one of them"
        )));
    }
    for (k, hole) in holes.iter().enumerate() {
        let at = hole.start();
        if let Some(around) = holes[..k].iter().find(|around| around.inside.contains(at)) {
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

/// The error of a drawing without a closed curve.
fn no_outline(open: &[CurveChain]) -> ImportError {
    let spread = |chain: &&CurveChain| {
        let edges = chain.edges().into_iter();
        edges.fold(Rect::EMPTY, |all, edge| all.union(&edge.bounds())).size().length()
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
        let (edges, curve) = (crack.edges(), crack.curves[0].source);
        if crack.is_closed {
            return Err(ImportError(format!(
                "the crack at {} ({curve}) closes, and would cut the body; open it, or give it another name",
                shown(edges[0].from)
            )));
        }
        let is_outside = |p: &Vec2| {
            !outline.inside.contains(*p) && outline.inside.rim_distance(*p) > BEYOND * size
        };
        let parts = edges.iter().flat_map(|edge| [0.0, 0.5, 1.0].map(|part| edge.at(part)));
        if let Some(at) = parts.into_iter().find(is_outside) {
            return Err(ImportError(format!(
                "the open curve of {curve}, a crack, leaves the body at {}; shorten it, or leave it out",
                shown(at)
            )));
        }
    }
    Ok(())
}

/// The crack with ends on the boundary, where they miss it by the tolerance.
fn snapped(crack: CurveChain, borders: &[Edge], tolerance: f64) -> CurveChain {
    let ([first, .., last] | [first @ last]) = &crack.curves[..] else { return crack };
    let ends = [first.curve.ends()[0], last.curve.ends()[1]];
    let on_border = ends.map(|end| {
        let points = borders.iter().map(|edge| edge.closest_point(end));
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
