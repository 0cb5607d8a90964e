//! Singular points that are no tips: where the boundary of the body turns inwards or its
//! conditions change.
//!
//! Around such a point the solution is a sum of r^λ times functions of the angle, with exponents λ
//! that the openings of the material, the conditions on their two rays and Poisson's ratio decide
//! (Williams 1952). If the smallest Re λ is below one, stresses are infinite, and polynomials see
//! the field badly: kinks of cracks, corners of holes, the ends of held pieces of edges, clamped
//! corners, mouths of cracks at held edges. They are found from the geometry and the
//! conditions alone.
//!
//! Angles between arcs are those of their tangents. The fields of a wedge leave tractions of the
//! order κ r on sides of curvature κ: they are the leading part of the field there, and what the
//! curvature adds is smoother by one power of r, which polynomials see. In anisotropic bodies cells
//! are divided by the exponents of an isotropic one, and no fields are taken.

mod exponent;
mod sectors;
mod wedge;

use crate::edges::{is_smooth, kinks};
use crate::quadrature::{clamp_non_finite, sign_changes};
use crate::smoothness::levels_of_data;
use exponent::{Constants, smallest};
use ppum::border::touch;
use ppum::crack::{Crack, LocalCrack, Side, tips};
use ppum::domain::Hole;
use ppum::edge::Edge;
use ppum::formula::Formula;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::geometry::{rim_crossings, sure_side};
use ppum_problem::{BoundaryCondition, BoundaryPart, Problem};
use sectors::{CornerSurroundings, LOOK, Sector};
use std::f64::consts::TAU;
pub(crate) use wedge::WedgeTerm;

/// Rounding of angles.
const SAME_ANGLE: f64 = 1e-6;

/// Stand-in for 1 − λ where loads jump.
const LOGARITHM: f64 = 0.3;

/// Exponent, that of a turn of 24°, from which on a kink or a corner of a hole has no functions:
/// cells see its field well.
const MILD: f64 = 0.8;

/// Most corners with functions: each has up to eight, which drawing compiles.
const MOST: usize = 64;

/// A singular point.
#[derive(Clone, Debug, PartialEq)]
pub struct SingularCorner {
    /// Its place.
    pub at: Vec2,
    /// The smallest Re λ > 0 of u ~ r^λ there; below one, except for the ends of loads; zero where
    /// values jump.
    pub exponent: f64,
    /// Distance to the nearest other feature: a corner of the boundary, a tip, a rim, a crack.
    pub(crate) room: f64,
    /// Its nature.
    pub nature: SingularCause,
    /// Its fields, where they are known in all of the room.
    pub wedge: Option<Wedge>,
}

/// The material around a corner that turns inwards, with free sides.
#[derive(Clone, Debug, PartialEq)]
pub struct Wedge {
    /// Angle of its bisector from the body's x axis.
    pub(crate) bisector: f64,
    /// Radius of the disc in which it is all there is.
    room: f64,
    /// The side of the crack that it lies on, if what is beside it is material, too.
    pub(crate) side: Option<(u32, Side)>,
    /// Its fields that polynomials see badly.
    pub(crate) terms: Vec<WedgeTerm>,
}

impl SingularCorner {
    /// True for a kink that the field along a free crack hardly sees.
    pub(crate) fn is_gentle(&self) -> bool {
        matches!(self.nature, SingularCause::Kink(_)) && self.is_mild()
    }

    fn is_mild(&self) -> bool {
        self.exponent > MILD
    }

    /// True if a box lies in the disc around the corner in which its wedge is all there is.
    pub fn has_room_for(&self, part: &Rect) -> bool {
        let room = self.wedge.as_ref().map_or(self.room, |wedge| wedge.room);
        part.corners().iter().all(|p| (*p - self.at).length() < room)
    }

    /// The part of the field around the point that is not smooth: 1 − λ, and a constant where
    /// loads jump.
    pub fn weakness(&self) -> f64 {
        match self.nature {
            SingularCause::Load => LOGARITHM,
            _ => 1.0 - self.exponent,
        }
    }
}

/// The cause of a singular point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SingularCause {
    /// A kink of the crack with this index.
    Kink(usize),
    /// A corner of the body, at its boundary or at holes, free or held alike on its two sides.
    Corner,
    /// The end of what is held.
    Support,
    /// Loads that no uniform stress has: a loaded piece of an edge ends, or a sheared side meets a
    /// free one. u ~ r ln r, or r times a function of the angle.
    Load,
    /// A jump of given values, whose field has infinite energy.
    Jump,
}

impl SingularCause {
    /// In words.
    pub fn name(self) -> String {
        match self {
            Self::Kink(crack) => format!("the kink of crack {crack}"),
            Self::Corner => "the corner".into(),
            Self::Support => "the end of the support".into(),
            Self::Load => "the jump of the load".into(),
            Self::Jump => "the jump of the given values".into(),
        }
    }
}

/// The singular points of a problem, in the order: box, edges, holes, cracks. Its cost is quadratic
/// in their number.
pub fn corners(problem: &Problem) -> Vec<SingularCorner> {
    let touch = touch(&problem.domain().bounds);
    let tips: Vec<_> = tips(problem.cracks())
        .map(|tip| problem.cracks()[tip.crack as usize].end_point(tip.end))
        .collect();
    let mut places = distinct(places(problem), touch);
    // symmetries end at tips on edges
    places.retain(|at| tips.iter().all(|tip| (*tip - *at).length() > touch));
    let around = CornerSurroundings { problem, touch };
    let scale = scale_of_values(problem);
    let corner = |&at: &Vec2| {
        let apart = |others: &[Vec2]| {
            let lengths = others.iter().map(|p| (*p - at).length());
            lengths.filter(|length| *length > touch).fold(f64::INFINITY, f64::min)
        };
        let room = around.distance(at).min(apart(&places)).min(apart(&tips));
        let sectors = around.sectors(at, room);
        let with = |exponent, nature| SingularCorner { at, exponent, room, nature, wedge: None };
        if sectors.iter().any(|sector| values_jump(sector, scale)) {
            return Some(with(0.0, SingularCause::Jump));
        }
        let constants = Constants::at(&problem.equation, at);
        let exponents = sectors.iter().map(|sector| (smallest(sector, constants), sector));
        let (exponent, sector) = exponents.min_by(|a, b| a.0.total_cmp(&b.0))?;
        if exponent < 1.0 {
            let nature = nature(problem, sector, at, touch);
            let wedge = is_free(sector)
                .then(|| wedge(problem, (at, room, nature), sector, &sectors, constants))
                .flatten();
            return Some(SingularCorner { wedge, ..with(exponent, nature) });
        }
        let unfit = sectors.iter().any(|sector| is_unfit(sector, problem.components()));
        unfit.then_some(with(exponent, SingularCause::Load))
    };
    with_functions(problem, places.iter().filter_map(corner).collect())
}

/// The corners, with wedges only where and as long as there are functions for them.
fn with_functions(problem: &Problem, mut corners: Vec<SingularCorner>) -> Vec<SingularCorner> {
    corners.iter_mut().filter(|corner| corner.is_mild()).for_each(|corner| corner.wedge = None);
    let count = corners.iter().filter(|corner| corner.wedge.is_some()).count();
    let is_anisotropic = problem.equation.anisotropy().is_some();
    if count > MOST || !problem.has_series() || is_anisotropic {
        corners.iter_mut().for_each(|corner| corner.wedge = None);
    }
    corners
}

/// Part of the loads at a point by which they may differ from those of a uniform stress: more than
/// smooth loads change on the short way on which they are looked at.
const UNFIT: f64 = 1e-4;

/// Turn, its sine, up to which a vertex of a rim follows a curve.
const BEND: f64 = 0.3;

/// True if no uniform stress (gradient) has the loads of a sector's two rays: t₁ = σ n₁ and t₂ = σ
/// n₂ need n₂·t₁ = n₁·t₂, on a straight boundary t₁ = t₂. Any two fluxes fit but on a straight
/// boundary.
fn is_unfit(sector: &Sector, components: usize) -> bool {
    let [n1, n2] = sector.normals();
    let [t1, t2] = sector.load.map(Vec2::from);
    let size = t1.length() + t2.length();
    let turn = if n1.dot(n2) > 0.0 { n1.cross(n2).abs() } else { 1.0 };
    let apart = match components {
        _ if turn < UNFIT => (t1 - t2).length(),
        // a vertex of a rim that follows a curve: loads may be smooth or turn with the normal
        2 if turn < BEND => (t1 - t2).length().min((n2.dot(t1) - n1.dot(t2)).abs()),
        1 => 0.0,
        _ => (n2.dot(t1) - n1.dot(t2)).abs(),
    };
    is_free(sector) && apart > UNFIT * size
}

fn is_free(sector: &Sector) -> bool {
    sector.held == [[false; 2]; 2]
}

/// The wedge of a free sector: if nothing else around the point is material, or both sides belong
/// to a crack that turns there. Its fields jump on the ray opposite of the bisector, which lies in
/// a hole, or on the other side of the crack.
fn wedge(
    problem: &Problem,
    (at, room, nature): (Vec2, f64, SingularCause),
    sector: &Sector,
    sectors: &[Sector],
    constants: Constants,
) -> Option<Wedge> {
    let bisector = sector.from + 0.5 * sector.opening;
    let fills = sectors.iter().map(|s| s.opening).sum::<f64>() > TAU - SAME_ANGLE;
    let (side, room) = match (nature, sectors.len()) {
        (_, 1) => (None, room),
        (SingularCause::Kink(crack), 2) if fills => {
            let inside = at + vec2(bisector.cos(), bisector.sin()) * (LOOK * room);
            let (own, bounds) = (&problem.cracks()[crack], &problem.domain().bounds);
            let seen = LocalCrack::new(own, inside);
            let side =
                if seen.side([0.0, 0.0], Side::Above) > 0.0 { Side::Above } else { Side::Below };
            (Some((crack as u32, side)), room.min(sure_side(own, at, bounds, touch(bounds))))
        }
        _ => return None,
    };
    Some(Wedge { bisector, room, side, terms: wedge::terms(sector.opening, constants) })
}

/// True if the given values of a component jump from ray to ray, measured by the size of all
/// of them.
fn values_jump(sector: &Sector, scale: f64) -> bool {
    let jumps = |i: usize| {
        let is_held = sector.held[0][i] && sector.held[1][i];
        is_held && (sector.value[0][i] - sector.value[1][i]).abs() > UNFIT * scale
    };
    jumps(0) || jumps(1)
}

/// The size of the values given on edges, at their ends and quarters, and at corners of rims.
fn scale_of_values(problem: &Problem) -> f64 {
    let sizes = problem.boundary.iter().flat_map(|condition| {
        let bounds = &problem.domain().bounds;
        let all: Vec<Vec2> = match condition.on {
            BoundaryPart::Edge { edge, from, to } => (0..=4)
                .map(|k| edge.point(bounds, from + (to - from) * f64::from(k) / 4.0))
                .collect(),
            part => problem.edges_of(part).flat_map(|e| [e.from, e.middle(), e.to]).collect(),
        };
        let held = condition.fixed();
        // values, unlike pressures, do not depend on the normal
        let values = all.into_iter().map(|p| condition.values(p, Vec2::ZERO));
        let size = |v: [f64; 2]| [0, 1].map(|i| if held[i] { v[i].abs() } else { 0.0 });
        values.flat_map(size).collect::<Vec<_>>()
    });
    sizes.fold(0.0, f64::max)
}

fn nature(problem: &Problem, sector: &Sector, at: Vec2, touch: f64) -> SingularCause {
    let inner = |crack: &Crack| kinks(crack).any(|p| (p - at).length() <= touch);
    match problem.cracks().iter().position(inner) {
        Some(crack) => SingularCause::Kink(crack),
        None if (sector.held[0], sector.axes[0]) == (sector.held[1], sector.axes[1]) => {
            SingularCause::Corner
        }
        None => SingularCause::Support,
    }
}

/// Points at which the boundary turns or its conditions may change: not all of them do, some twice.
fn places(problem: &Problem) -> Vec<Vec2> {
    let bounds = &problem.domain().bounds;
    let mut all = bounds.corners().to_vec();
    for condition in &problem.boundary {
        if let BoundaryPart::Edge { edge, from, to } = condition.on {
            all.extend([from, to].map(|s| edge.point(bounds, s)));
        }
        all.extend(jumps(condition, problem));
    }
    let holes = &problem.domain().holes;
    all.extend((0..holes.len()).flat_map(|hole| corners_of_rim(problem, hole)));
    let cracks = problem.cracks().iter().flat_map(|crack| crack.edges());
    let edges = cracks.chain(bounds.sides().map(Edge::segment));
    all.extend(edges.flat_map(|edge| holes.iter().flat_map(move |hole| crossing(edge, hole))));
    for (k, hole) in holes.iter().enumerate() {
        all.extend(holes[..k].iter().flat_map(|other| rims_crossing(hole, other)));
    }
    all.extend(problem.cracks().iter().flat_map(vertices));
    all
}

/// The vertices of a rim at which it has a corner, or its conditions change.
fn corners_of_rim(problem: &Problem, hole: usize) -> Vec<Vec2> {
    let sides: Vec<Edge> = problem.domain().holes[hole].edges().collect();
    let before = |k: usize| (k + sides.len() - 1) % sides.len();
    let goes_on = |k: usize| {
        let is_on = |condition: &BoundaryCondition, k| problem.is_on(condition.on, hole, k);
        let same = |condition| is_on(condition, before(k)) == is_on(condition, k);
        is_smooth(&sides[before(k)], &sides[k]) && problem.boundary.iter().all(same)
    };
    (0..sides.len()).filter(|k| !goes_on(*k)).map(|k| sides[k].from).collect()
}

/// A part of the boundary that is smooth: its points by a coordinate, and the ends of that.
type SmoothBoundary<'p> = (Box<dyn Fn(f64) -> Vec2 + 'p>, [f64; 2]);

fn smooth_boundary<'p>(edge: Edge) -> SmoothBoundary<'p> {
    (Box::new(move |s| edge.at(s)), [0.0, 1.0])
}

/// Places at which the data of a condition may jump.
fn jumps(condition: &BoundaryCondition, problem: &Problem) -> Vec<Vec2> {
    let levels: Vec<_> = condition.formulas().flat_map(levels_of_data).collect();
    if levels.is_empty() {
        return Vec::new();
    }
    let on_curve = |(at, [from, to]): SmoothBoundary<'_>| {
        let of_level = |level: &Formula| {
            let value = |s: f64| clamp_non_finite(level.evaluate(&<[f64; 2]>::from(at(s))));
            sign_changes(&value, from, to)
        };
        levels.iter().flat_map(of_level).map(&at).collect::<Vec<_>>()
    };
    curves(condition.on, problem).into_iter().flat_map(on_curve).collect()
}

/// The edges and circles that a part of the boundary consists of.
fn curves(part: BoundaryPart, problem: &Problem) -> Vec<SmoothBoundary<'_>> {
    match part {
        BoundaryPart::Edge { edge, from, to } => {
            let bounds = &problem.domain().bounds;
            vec![(Box::new(move |s| edge.point(bounds, s)), [from, to])]
        }
        BoundaryPart::Hole(hole)
            if let Hole::Circle { center, radius } = problem.domain().holes[hole] =>
        {
            let at = move |angle: f64| center + vec2(angle.cos(), angle.sin()) * radius;
            vec![(Box::new(at), [0.0, TAU])]
        }
        BoundaryPart::Crack { crack, .. } => {
            problem.cracks()[crack].edges().map(smooth_boundary).collect()
        }
        _ => problem.edges_of(part).map(smooth_boundary).collect(),
    }
}

/// The kinks and the ends of a crack that are no tips.
fn vertices(crack: &Crack) -> impl Iterator<Item = Vec2> + '_ {
    let is_tip = |p: &Vec2| crack.tips().any(|end| crack.end_point(end) == *p);
    let last = crack.points.len() - 1;
    let all = [crack.points[0]].into_iter().chain(kinks(crack)).chain([crack.points[last]]);
    all.filter(move |p| !is_tip(p))
}

/// The points that an edge shares with a rim.
fn crossing(edge: Edge, hole: &Hole) -> Vec<Vec2> {
    let on_edge = rim_crossings(edge, hole).into_iter().filter(|t| (0.0..=1.0).contains(t));
    on_edge.map(|t| edge.at(t)).collect()
}

/// The points that two rims share.
fn rims_crossing(hole: &Hole, other: &Hole) -> Vec<Vec2> {
    let (of, with) = if hole.sides().next().is_some() { (hole, other) } else { (other, hole) };
    of.rim_edges().into_iter().flat_map(|edge| crossing(edge, with)).collect()
}

/// Points without those that are the same as one before them.
fn distinct(points: Vec<Vec2>, touch: f64) -> Vec<Vec2> {
    let mut kept: Vec<Vec2> = Vec::with_capacity(points.len());
    for p in points {
        if kept.iter().all(|q| (*q - p).length() > touch) {
            kept.push(p);
        }
    }
    kept
}

#[cfg(test)]
mod tests;
