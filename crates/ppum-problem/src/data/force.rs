//! The surroundings of forces at points.

use ppum::border::touch;
use ppum::crack::{Crack, SegmentId, Side};
use ppum::domain::{Domain, Hole};
use ppum::edge::Edge;
use ppum::line::Line;
use ppum::vec2::Vec2;

use super::{BoundaryPart, DomainEdge, Force, ProblemData};

/// The surroundings of a force.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ForcePlace {
    /// The body lies all around.
    Inside,
    /// A straight boundary.
    Border {
        /// Its unit normal into the body.
        inward: Vec2,
        /// The face of a crack that it is, if it is one.
        face: Option<(SegmentId, Side)>,
    },
}

impl ForcePlace {
    /// The face that the force acts on.
    pub fn face(self) -> Option<(SegmentId, Side)> {
        if let Self::Border { face, .. } = self { face } else { None }
    }
}

/// Cosine of angles that are rounding.
const PARALLEL: f64 = 1.0 - 1e-12;

/// Part of the size of the domain by which the material beside a rim is looked for.
const BESIDE: f64 = 1e-7;

impl ProblemData {
    /// The surroundings of a force, or in words why there cannot be one.
    pub fn place_of(&self, force: &Force) -> Result<ForcePlace, String> {
        let Force { at: p, face: side, .. } = *force;
        let touch = touch(&self.domain().bounds);
        if self.domain().holes.iter().any(|hole| is_on_curve(hole, p, touch)) {
            return Err("lies on a curved part of the border; move it onto a straight one".into());
        }
        if is_outside(self.domain(), p, touch) {
            return Err(
                "lies outside of the body; move it into the body, or onto its border".into()
            );
        }
        if let Some(crack) = self.crack_at(p, touch) {
            let Some(side) = side else {
                return Err(format!(
                    "lies on crack {crack}, which has two faces; add `face = \"above\"` or \"below\""
                ));
            };
            return self.face_at(crack, side, p, touch);
        }
        if side.is_some() {
            return Err("lies on no crack, so that `face` has no meaning; leave it out".into());
        }
        let mut normals: Vec<Vec2> = Vec::new();
        let lines = self.domain().border_lines().filter(|line| line.holds(p, touch));
        for normal in lines.map(|line| -line.outward()) {
            if !normals.iter().any(|known| known.dot(normal) > PARALLEL) {
                normals.push(normal);
            }
        }
        match normals[..] {
            [] => Ok(ForcePlace::Inside),
            [inward] => Ok(ForcePlace::Border { inward, face: None }),
            _ => {
                Err("lies in a corner, where fields of forces are others; move it along a side"
                    .into())
            }
        }
    }

    fn crack_at(&self, p: Vec2, touch: f64) -> Option<usize> {
        self.cracks().iter().position(|crack| crack.distance(p) <= touch)
    }

    fn face_at(&self, crack: usize, side: Side, p: Vec2, touch: f64) -> Result<ForcePlace, String> {
        let points = &self.cracks()[crack].points;
        let others = self.cracks().iter().enumerate().filter(|(k, _)| *k != crack);
        let mut others = others.map(|(_, other)| other.distance(p));
        if points.iter().any(|q| (*q - p).length() <= touch) || others.any(|d| d <= touch) {
            return Err(format!(
                "lies at an end, a kink or a crossing of crack {crack}; move it along the face"
            ));
        }
        if self.body.line_of(crack).is_some() {
            return Err("lies on the border of a half model; model the whole body".into());
        }
        let (number, inward) = self.face_near(crack, side, p);
        if self.cracks()[crack].edge(number).is_arc() {
            return Err(format!(
                "lies on a curved part of crack {crack}; move it onto a straight one"
            ));
        }
        let segment = SegmentId { crack: crack as u32, segment: number as u32 };
        Ok(ForcePlace::Border { inward, face: Some((segment, side)) })
    }

    /// Distance from a force within which its field alone is not smooth: up to tips and kinks of
    /// the crack that it acts on, to parts of the boundary where values are given, and to material
    /// behind the boundary.
    pub fn room_of(&self, force: &Force, place: ForcePlace) -> f64 {
        let p = force.at;
        let held = self.boundary.iter().filter(|condition| condition.held().contains(&true));
        let mut room = held.map(|c| self.distance_to(c.on, p)).fold(f64::INFINITY, f64::min);
        if let Some((segment, _)) = place.face() {
            let ends = self.cracks()[segment.crack as usize].points.iter();
            room = ends.map(|q| (*q - p).length()).fold(room, f64::min);
        } else if let ForcePlace::Border { inward, .. } = place {
            let reach = self.domain().bounds.size().length();
            let rims = self.domain().holes.iter().flat_map(Hole::edges);
            room = rims.filter_map(|side| along(p, -inward, side, reach)).fold(room, f64::min);
        }
        room
    }

    /// Distance from a force to the nearest boundary or crack that it does not act on: the rest of
    /// the field varies as fast there.
    pub fn next_to(&self, force: &Force) -> f64 {
        let (p, domain) = (force.at, self.domain());
        let edges = DomainEdge::ALL.into_iter().map(|edge| edge.depth(&domain.bounds, p));
        let sides = domain.holes.iter().flat_map(Hole::edges);
        let circles = domain.holes.iter().filter(|hole| hole.sides().next().is_none());
        let circles = circles.map(|hole| hole.rim_distance(p));
        let lines = sides.chain(self.cracks().iter().flat_map(Crack::edges));
        let all = edges.chain(circles).chain(lines.map(|edge| edge.distance(p)));
        all.filter(|distance| *distance > touch(&domain.bounds)).fold(f64::INFINITY, f64::min)
    }

    fn distance_to(&self, on: BoundaryPart, p: Vec2) -> f64 {
        let round = match on {
            BoundaryPart::Hole(hole) => self.domain().holes[hole].rim_distance(p),
            _ => f64::INFINITY,
        };
        let sides = self.edges_of(on).map(|edge| edge.distance(p));
        sides.fold(round, f64::min)
    }
}

/// True if a point lies outside of the body by more than rounding.
pub(crate) fn is_outside(domain: &Domain, p: Vec2, touch: f64) -> bool {
    let is_inside = |hole: &Hole| hole.contains(p) && hole.rim_distance(p) > touch;
    !domain.bounds.contains(p) || domain.holes.iter().any(is_inside)
}

/// True if a point lies on a circle or on an arc of a rim.
fn is_on_curve(hole: &Hole, p: Vec2, touch: f64) -> bool {
    hole.rim_edges().iter().any(|edge| edge.is_arc() && edge.distance(p) <= touch)
}

/// Distance, less than `reach`, from a point in a direction to an edge that does not begin there.
fn along(p: Vec2, way: Vec2, edge: Edge, reach: f64) -> Option<f64> {
    let beside = BESIDE * (edge.chord().length() + (edge.from - p).length());
    if edge.is_arc() {
        let met = Edge::segment([p, p + way * reach]).meets(&edge).into_iter();
        return met.map(|[part, _]| part * reach).find(|distance| *distance > beside);
    }
    let side = Line::through([edge.from, edge.to]);
    let [distance, part] = Line { from: p, along: way }.meets(&side)?;
    (distance > beside && (0.0..=1.0).contains(&part)).then_some(distance)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;

    #[test]
    fn rays_meet_segments_ahead() {
        let side = Edge::segment([vec2(1.0, -1.0), vec2(1.0, 2.0)]);
        let along = |p, way, side| along(p, way, side, 9.0);
        assert_eq!(along(Vec2::ZERO, vec2(1.0, 0.0), side), Some(1.0));
        assert_eq!(along(Vec2::ZERO, vec2(-1.0, 0.0), side), None);
        assert_eq!(along(vec2(0.0, 3.0), vec2(1.0, 0.0), side), None);
        assert_eq!(along(vec2(1.0, 0.0), vec2(0.0, 1.0), side), None);
    }
}
