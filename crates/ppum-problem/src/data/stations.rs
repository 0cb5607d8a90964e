//! Points along the boundary with what the conditions say there, for drawings of supports and
//! loads.

use std::f64::consts::TAU;

use ppum::border::touch;
use ppum::crack::Side;
use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::vec2::{Vec2, vec2};

use super::{BoundaryCondition, BoundaryPart, ForcePlace, ProblemData};

/// A point of the boundary with what a condition says there.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct BoundaryStation {
    /// The point.
    pub at: Vec2,
    /// Unit normal out of the material.
    pub outward: Vec2,
    /// Whether the value of each component, x and y, is given, or only that along `axis`.
    pub held: [bool; 2],
    /// The direction that alone is held, where it is neither that of x nor of y.
    pub axis: Option<Vec2>,
    /// True for a potential that yields to the value of its surroundings, an exchange.
    pub exchanges: bool,
    /// Traction on the body, zero in components that are held: force per area.
    pub traction: Vec2,
}

impl ProblemData {
    /// Points along the parts of the boundary that have conditions, about `spacing` apart, each in
    /// the middle of its piece of the boundary, those in holes left out, then the points of forces
    /// and supports; of a potential the parts with an exchange alone. The largest force counts as
    /// the largest traction.
    #[must_use]
    pub fn stations(&self, spacing: f64) -> Vec<BoundaryStation> {
        let of = |condition: &BoundaryCondition| {
            let points = self.points_of(condition.on, spacing).into_iter();
            let station = |(at, outward)| BoundaryStation {
                at,
                outward,
                held: condition.coordinates_of(condition.fixed()),
                axis: condition.oblique_axis(),
                exchanges: condition.exchange.is_some(),
                traction: condition.loads(at, outward).into(),
            };
            points.map(station).collect::<Vec<_>>()
        };
        let is_elastic = self.equation.elastic().is_some();
        let shown = self.boundary.iter().filter(|one| is_elastic || one.exchange.is_some());
        let mut all: Vec<_> = shown.flat_map(of).collect();
        let largest = all.iter().map(|station| station.traction.length()).fold(0.0, f64::max);
        all.extend(self.stations_of_forces(largest));
        all.extend(self.supports.iter().map(|support| BoundaryStation {
            at: support.at,
            outward: vec2(0.0, -1.0),
            held: support.displacement.map(|value| value.is_some()),
            ..BoundaryStation::default()
        }));
        all
    }

    /// The points of forces, with arrows that end there except for those that pull at a boundary;
    /// the largest is as large as a traction.
    fn stations_of_forces(&self, traction: f64) -> impl Iterator<Item = BoundaryStation> {
        let largest = self.forces.iter().map(|force| force.value.length()).fold(0.0, f64::max);
        let unit = if traction > 0.0 { traction / largest } else { 1.0 };
        self.forces.iter().map(move |force| BoundaryStation {
            at: force.at,
            outward: match self.place_of(force) {
                Ok(ForcePlace::Border { inward, .. }) => -inward,
                _ => -force.value.unit(),
            },
            traction: force.value * unit,
            ..BoundaryStation::default()
        })
    }

    /// Points of a part of the boundary with their normals out of the material.
    fn points_of(&self, part: BoundaryPart, spacing: f64) -> Vec<(Vec2, Vec2)> {
        let bounds = &self.domain().bounds;
        let faces: Vec<_> = self.border_cracks().map(|(k, _)| &self.cracks()[k]).collect();
        let is_on_face = |p: Vec2| faces.iter().any(|face| face.distance(p) <= touch(bounds));
        match part {
            BoundaryPart::Edge { edge, from, to } => {
                let piece = [Edge::segment([from, to].map(|s| edge.point(bounds, s)))];
                let points = along(&piece, spacing).map(|(p, _)| (p, edge.normal()));
                points.filter(|&(p, _)| self.domain().contains(p) && !is_on_face(p)).collect()
            }
            BoundaryPart::Hole(_) | BoundaryPart::Sides(_) | BoundaryPart::Piece(_) => {
                let holes = self.domain().holes.iter().enumerate();
                let rims = holes.flat_map(|(index, hole)| {
                    around(hole, |side| self.is_on(part, index, side), spacing)
                });
                rims.filter(|&(p, _)| bounds.contains(p) && !is_on_face(p)).collect()
            }
            BoundaryPart::Crack { crack, face } => {
                let crack = &self.cracks()[crack];
                let sides = [Side::Above, Side::Below].into_iter();
                let sides = sides.filter(|side| face.is_none_or(|face| face == *side));
                let faces = sides.flat_map(|side| {
                    let is_in_body =
                        move |edge: &Edge| self.domain().outer_side(*edge) != Some(side);
                    let edges: Vec<Edge> = crack.edges().filter(is_in_body).collect();
                    let sign = if side == Side::Above { -1.0 } else { 1.0 };
                    let points: Vec<_> = match crack.is_curved() {
                        true => along(&edges, spacing).collect(),
                        false => edges.chunks(1).flat_map(|edge| along(edge, spacing)).collect(),
                    };
                    points.into_iter().map(move |(p, way)| (p, way.left() * sign))
                });
                faces.collect()
            }
        }
    }
}

/// Points of the sides of a rim that are wanted, with the normals out of the material, into the
/// hole.
fn around(hole: &Hole, is_wanted: impl Fn(usize) -> bool, spacing: f64) -> Vec<(Vec2, Vec2)> {
    match hole {
        Hole::Circle { .. } if !is_wanted(0) => Vec::new(),
        Hole::Circle { center, radius } => {
            let count = parts(TAU * radius, spacing).max(4);
            let direction = |k: u32| {
                let (sin, cos) = (TAU * f64::from(k) / f64::from(count)).sin_cos();
                vec2(cos, sin)
            };
            (0..count).map(direction).map(|d| (*center + d * *radius, -d)).collect()
        }
        Hole::Polygon { .. } => {
            let wanted = hole.edges().enumerate().filter(|(k, _)| is_wanted(*k));
            along(&wanted.map(|(_, side)| side).collect::<Vec<_>>(), spacing)
                .map(|(p, way)| (p, way.left() * hole.orientation()))
                .collect()
        }
    }
}

/// Points of edges one after the other, also of short ones: the middles of equal parts of their
/// whole length, each about as long as the spacing, with the directions there.
fn along(sides: &[Edge], spacing: f64) -> impl Iterator<Item = (Vec2, Vec2)> {
    let lengths = sides.iter().scan(0.0, |sum, side| {
        *sum += side.length();
        Some(*sum)
    });
    let ends: Vec<f64> = lengths.collect();
    let whole = ends.last().copied().unwrap_or(0.0);
    let count = if sides.is_empty() { 0 } else { parts(whole, spacing) };
    (0..count).map(move |k| {
        let s = whole * ((f64::from(k) + 0.5) / f64::from(count));
        let index = ends.partition_point(|end| *end < s).min(sides.len() - 1);
        let (side, rest) = (sides[index], ends[index] - s);
        let part = (1.0 - rest / side.length()).clamp(0.0, 1.0);
        let way = side.tangent(part);
        (if side.is_arc() { side.at(part) } else { side.to - way * rest }, way)
    })
}

/// Number of parts of a length, each about as long as the spacing.
fn parts(length: f64, spacing: f64) -> u32 {
    (length / spacing).round().clamp(1.0, 1000.0) as u32
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::Problem;

    fn stations(border: &str, spacing: f64) -> Vec<BoundaryStation> {
        let text = format!(
            "[domain]\nmin = [-1.0, -1.0]\nmax = [1.0, 1.0]\n[material]\nyoung = 1.0\npoisson = 0.3\n\
             state = \"plane-strain\"\n[[hole]]\ncenter = [0.5, 0.5]\nradius = 0.2\n[[hole]]\n\
             points = [[-0.8, -0.8], [-0.4, -0.8], [-0.4, -0.4]]\n[[crack]]\n\
             points = [[-0.5, 0.0], [0.1, 0.0]]\n[discretization]\nlevel = 3\n[[boundary]]\n{border}\n"
        );
        let problem = Problem::parse(&text, "test", Path::new("")).expect("a problem");
        problem.stations(spacing)
    }

    #[test]
    fn edges_are_divided_evenly() {
        let found = stations("on = \"top\"\ntraction = [\"x\", 2.0]", 0.5);
        let xs: Vec<_> = found.iter().map(|s| s.at.x).collect();
        assert_eq!(xs, [-0.75, -0.25, 0.25, 0.75]);
        for station in &found {
            assert_eq!((station.at.y, station.outward), (1.0, vec2(0.0, 1.0)));
            assert_eq!((station.held, station.traction), ([false; 2], vec2(station.at.x, 2.0)));
        }
        let held = stations("on = \"left\"\ndisplacement = [0.0, \"free\"]", 10.0);
        assert_eq!((held.len(), held[0].at, held[0].held), (1, vec2(-1.0, 0.0), [true, false]));
        assert_eq!(held[0].traction, Vec2::ZERO);
    }

    /// For a potential, the parts that exchange are shown, and neither given values nor fluxes.
    #[test]
    fn exchanges_of_a_potential_are_shown() {
        let text = "[equation]\nkind = \"poisson\"\n[domain]\nmin = [0.0, 0.0]\nmax = [2.0, 1.0]\n[discretization]\n\
                    level = 2\n[[boundary]]\non = \"top\"\nvalue = 2.0\nexchange = 3.0\n[[boundary]]\n\
                    on = \"left\"\nvalue = 1.0\n[[boundary]]\non = \"right\"\nflux = 1.0\n";
        let problem = Problem::parse(text, "test", Path::new("")).expect("a problem");
        let found = problem.stations(0.5);
        assert_eq!(found.iter().map(|s| s.at.x).collect::<Vec<_>>(), [0.25, 0.75, 1.25, 1.75]);
        for station in found {
            assert!(station.exchanges && station.held == [false; 2]);
            assert_eq!((station.outward, station.traction), (vec2(0.0, 1.0), Vec2::ZERO));
        }
    }

    /// Normals point out of the material and tractions of a pressure into it, on rims and faces
    /// alike: a step along the normal leaves the body.
    #[test]
    fn pressure_presses_on_the_material() {
        for (border, count) in [
            ("on = { hole = 0 }\npressure = 3.0", 6),
            ("on = { hole = 1 }\npressure = 3.0", 7),
            ("on = { crack = 0 }\npressure = 3.0", 6),
            ("on = { crack = 0, face = \"below\" }\npressure = 3.0", 3),
        ] {
            let found = stations(border, 0.2);
            assert_eq!(found.len(), count, "{border}");
            for s in found {
                assert!((s.traction + s.outward * 3.0).length() < 1e-12, "{border}");
                let inside_hole =
                    |p: Vec2| (p - vec2(0.5, 0.5)).length() < 0.2 || (p.x < -0.4 && p.y < p.x);
                let step = s.at + s.outward * 1e-3;
                assert!(border.contains("crack") || inside_hole(step), "{border} {s:?}");
            }
        }
    }
}
