//! Closed curves: the outline of the body, and the tables `[[hole]]`.

use ppum::border::touch;
use ppum::crack::Crack;
use ppum::domain::{Domain, Hole, PolygonSide};
use ppum::edge::Edge;
use ppum::smooth_curve::SmoothCurve;
use ppum::spline::Spline;
use ppum::vec2::{Rect, Vec2};

use crate::data::{Body, BoundaryPiece, BoundaryRange, Discretization};
use crate::file::{DocumentValue, FromValue as _, Section, all};
use crate::geometry::{needed, shown};
use crate::read::curve::{bulges, edges, ellipse, joined, knots, no_bulges, note_segments};

/// A closed curve in words of the problem file.
pub(super) struct Rim {
    hole: Hole,
    /// The sides that have names.
    names: Vec<(String, [usize; 2])>,
}

/// The box, the holes, and what is outside of the outline as the last of them; and their pieces
/// with names.
pub(super) struct BodyShape {
    pub(super) bounds: Option<Rect>,
    pub(super) holes: Option<Vec<Hole>>,
    pub(super) pieces: Vec<BoundaryPiece>,
}

/// Room between the outline and the box around it, in parts of its size, where cells are not known
/// or as large as the body.
const ROOM: f64 = 1.0 / 16.0;

/// The body of a problem; cells decide how much room its box has.
pub(super) fn body(root: &Section<'_>, cells: Option<&Discretization>) -> BodyShape {
    let domain = root.required_section("domain");
    let outline = domain.as_ref().map_or(Some(None), outline);
    let bounds = domain.and_then(|domain| bounds(&domain, outline.as_ref()?.as_ref(), cells));
    let rims = all(root.sections("hole").iter().map(hole));
    let rims = rims.zip(outline).map(|(holes, outline)| holes.into_iter().chain(outline));
    let (mut holes, mut pieces) = (Vec::new(), Vec::new());
    let is_whole = rims.is_some();
    for rim in rims.into_iter().flatten() {
        rim.names.into_iter().for_each(|name| add_piece(&mut pieces, name, holes.len()));
        holes.push(rim.hole);
    }
    BodyShape { bounds, holes: is_whole.then_some(holes), pieces }
}

fn add_piece(
    pieces: &mut Vec<BoundaryPiece>,
    (name, [from, to]): (String, [usize; 2]),
    hole: usize,
) {
    let run = BoundaryRange { hole, from, to };
    match pieces.iter_mut().find(|piece| piece.name == name) {
        Some(piece) => piece.runs.push(run),
        None => pieces.push(BoundaryPiece { name, runs: vec![run] }),
    }
}

impl BodyShape {
    /// The shape of a body.
    pub(super) fn of(body: &Body) -> Self {
        let Domain { bounds, holes } = body.domain().clone();
        Self { bounds: Some(bounds), holes: Some(holes), pieces: body.pieces().to_vec() }
    }

    /// The body of this shape; none if a part of it could not be read.
    pub(super) fn body(self) -> Option<Body> {
        Some(Body::new(Domain { bounds: self.bounds?, holes: self.holes? }, self.pieces))
    }

    /// The part of a piece between two lengths along it from its beginning, as a piece of its own.
    /// Sides are divided at its ends.
    ///
    /// # Errors
    /// Lengths that do not fit the piece.
    pub(super) fn part_of(
        &mut self,
        piece: usize,
        [from, to]: [Option<f64>; 2],
    ) -> Result<usize, String> {
        let BoundaryPiece { name, runs } = self.pieces[piece].clone();
        let Some(holes) = &self.holes else { return Ok(piece) };
        let [run] = runs[..] else {
            return Err(
                "is for a piece in one part; give the parts of this one names of their own".into(),
            );
        };
        let hole = &holes[run.hole];
        let (touch, length) =
            (touch(&hole.rim_bounds()), run.edges(hole).map(|edge| edge.length()).sum());
        let ends = [from.unwrap_or(0.0), to.unwrap_or(length)];
        if ends[0] >= ends[1] {
            return Err(format!(
                "is {} and `to` is {}, but `to` must exceed `from`",
                ends[0], ends[1]
            ));
        }
        if ends[0] < -touch || ends[1] > length + touch {
            return Err(format!(
                "{} to {} leaves the piece, which is {length} long; stay inside",
                ends[0], ends[1]
            ));
        }
        // the second one first: the number of the side at the first one stays
        let last = self.vertex_at(piece, ends[1], touch);
        let count = self.pieces[piece].runs[0].to;
        let first = self.vertex_at(piece, ends[0], touch);
        let to = last + self.pieces[piece].runs[0].to - count;
        let runs = vec![BoundaryRange { hole: run.hole, from: first, to }];
        self.pieces
            .push(BoundaryPiece { name: format!("{name} from {} to {}", ends[0], ends[1]), runs });
        Ok(self.pieces.len() - 1)
    }

    /// The number of the side of a piece that begins at a length along it, or of the one after the
    /// piece; a side that goes on there is divided.
    fn vertex_at(&mut self, piece: usize, length: f64, touch: f64) -> usize {
        let run = self.pieces[piece].runs[0];
        let Some(hole) = self.holes.as_mut().map(|holes| &mut holes[run.hole]) else {
            return run.from;
        };
        let edges: Vec<Edge> = run.edges(hole).collect();
        let mut left = length;
        for (side, edge) in (run.from..).zip(edges) {
            let own = edge.length();
            if left <= touch {
                return side;
            }
            if left < own - touch {
                divide(hole, side, left / own);
                let runs = self.pieces.iter_mut().flat_map(|piece| &mut piece.runs);
                for other in runs.filter(|other| other.hole == run.hole) {
                    other.from += usize::from(other.from > side);
                    other.to += usize::from(other.to > side);
                }
                return side + 1;
            }
            left -= own;
        }
        run.to
    }
}

/// Divides a side of a polygon at a part of its length.
fn divide(hole: &mut Hole, side: usize, part: f64) {
    let Some(edge) = hole.edges().nth(side) else { return };
    let Hole::Polygon { points, bulges, .. } = hole else { return };
    points.insert(side + 1, edge.at(part));
    if edge.is_arc() {
        bulges[side] = edge.part([0.0, part]).bulge;
    }
    if !bulges.is_empty() {
        bulges.insert(side + 1, edge.part([part, 1.0]).bulge);
    }
}

/// The box: the one given, or one around the outline. There the outline runs through the middle of
/// the outer cells: it is on no line of cells except for rounding.
fn bounds(
    domain: &Section<'_>,
    outline: Option<&Rim>,
    discretization: Option<&Discretization>,
) -> Option<Rect> {
    let Some(outline) = outline.filter(|_| !domain.mentions_any(&["min", "max"])) else {
        let (min, max) = (domain.require("min"), domain.require("max"));
        return Some(Rect::new(min?, max?));
    };
    let tight = outline.hole.rim_bounds();
    let roots = discretization.and_then(|d| d.cells.roots(&tight));
    let room = |axis: usize| match roots {
        Some((roots, halvings)) if roots[axis] << halvings > 1 => {
            0.5 / (f64::from(roots[axis] << halvings) - 1.0)
        }
        _ => ROOM,
    };
    let size = tight.size();
    let room = Vec2 { x: room(0) * size.x, y: room(1) * size.y };
    Some(Rect::new(tight.min - room, tight.max + room))
}

/// The outline of the body, if there is one; none if it cannot be read.
fn outline(domain: &Section<'_>) -> Option<Option<Rim>> {
    if !domain.mentions("outline") {
        return Some(None);
    }
    let section = domain.section("outline")?;
    let mut rim = closed(&section, &CURVES)?;
    if let Hole::Polygon { side, .. } = &mut rim.hole {
        *side = PolygonSide::Outside;
    }
    Some(Some(rim))
}

/// Keys of closed curves.
const CURVES: [&str; 4] = ["points", "ellipse", "spline", "path"];

/// The hole of a `[[hole]]`.
fn hole(section: &Section<'_>) -> Option<Rim> {
    if section.given(&CURVES).is_empty() && !section.mentions_any(&CURVES) {
        no_bulges(section)?;
        let (center, radius) = (section.require("center"), section.require("radius"));
        let hole = Hole::Circle { center: center?, radius: radius? };
        return Some(Rim { hole, names: Vec::new() });
    }
    closed(section, &["points", "ellipse", "spline", "path", "center", "radius"])
}

/// The inside of a closed curve, which one of some keys gives.
fn closed(section: &Section<'_>, keys: &[&'static str]) -> Option<Rim> {
    let given = section.given(keys);
    let [(key, value)] = &given[..] else {
        return match given.get(1) {
            Some((key, second)) => second.error(match *key {
                "center" | "radius" => {
                    "makes a circle, and the others another curve; leave one out"
                }
                _ => "gives the curve once more; leave one out",
            }),
            None if section.mentions_any(keys) => None,
            None => section.require::<Vec<Vec2>>("points").and(None),
        };
    };
    note_segments(section)?;
    let closed = |edges: Vec<Edge>| Rim { hole: Hole::enclosed(&edges), names: Vec::new() };
    if *key != "points" {
        no_bulges(section)?;
    }
    match *key {
        "points" => {
            let points: Vec<Vec2> = Vec::read(value)?;
            let bulges = bulges(section, points.len())?;
            let hole = Hole::with_arcs(points, bulges, PolygonSide::Inside);
            let edges: Vec<Edge> = hole.edges().collect();
            let is_outline = keys == CURVES;
            Some(closed(if is_outline { needed_of(&edges, &[0]).0 } else { edges }))
        }
        "path" => path(value),
        "ellipse" => edges(&ellipse(value, false)?, value).map(closed),
        _ => {
            let curve = SmoothCurve::Spline(Spline::closed(&knots(value, true)?));
            edges(&curve, value).map(closed)
        }
    }
}

/// Pieces one after the other, the last of which ends where the first begins.
fn path(value: &DocumentValue<'_>) -> Option<Rim> {
    let (mut edges, starts) = joined(value)?;
    let end = edges.len() - 1;
    let (first, last) = (edges[0].from, edges[end].to);
    let size = edges.iter().map(|edge| (edge.from - first).length()).fold(0.0, f64::max);
    if (last - first).length() > super::curve::JOINT * size {
        return value.error(&format!(
            "is open: it begins at {} and ends at {}; end it where it begins",
            shown(first),
            shown(last)
        ));
    }
    edges[end].to = first;
    let (edges, runs) = needed_of(&edges, &starts);
    let name = |(value, run): (&DocumentValue<'_>, [usize; 2])| {
        let section = value.table()?;
        let Some(name) = section.value("name") else { return Some(None) };
        match String::read(&name)? {
            empty if empty.is_empty() => name.error("is empty; leave it out, or give a name"),
            text => Some(Some((text, run))),
        }
    };
    let names = all(value.list()?.iter().zip(runs).map(name))?;
    Some(Rim { hole: Hole::enclosed(&edges), names: names.into_iter().flatten().collect() })
}

/// The edges of a rim without vertices that it does not need, and the ranges of those of its
/// pieces, which begin at some of the edges.
fn needed_of(edges: &[Edge], starts: &[usize]) -> (Vec<Edge>, Vec<[usize; 2]>) {
    let touch = touch(&Hole::enclosed(edges).rim_bounds());
    let ends = starts.iter().skip(1).copied().chain([edges.len()]);
    let (mut all, mut runs): (Vec<Edge>, _) = (Vec::new(), Vec::new());
    for (from, to) in starts.iter().copied().zip(ends) {
        let from_side = all.len();
        all.extend(needed(&Crack::along(&edges[from..to]), touch).edges());
        runs.push([from_side, all.len()]);
    }
    (all, runs)
}
