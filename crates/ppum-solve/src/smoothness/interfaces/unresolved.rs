//! Places at which interfaces ask for more than a kink across a patch.

use super::interface::Interfaces;
use super::point::InterfacePoint;
use ppum::crack::{Crack, End};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::geometry::inside;

/// Most interfaces that a patch resolves.
const MOST: usize = 4;

/// Least cosine of the angle by which an interface may turn within a patch.
const TURN: f64 = 0.5;

/// Least sine of the angle between two lines that meet.
const ASLANT: f64 = 0.1;

/// Distance that counts as touching, in parts of a patch: more than a step between places.
const TOUCH: f64 = 0.1;

/// Contrast below which singular points of interfaces are not seen in the solution.
const LEAST_CONTRAST: f64 = 0.2;

/// The reason why a kink does not resolve an interface.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnresolvedCause {
    /// More interfaces than a patch takes.
    Many,
    /// A corner of an interface, or a curve that is too round.
    Turn,
    /// Two interfaces that meet.
    Corner,
    /// The boundary, or a rim.
    Border,
    /// A crack that crosses or touches, or a tip nearby.
    Crack,
}

/// A location at which kinks do not resolve the interfaces.
#[derive(Clone, Copy, Debug)]
pub struct UnresolvedInterface {
    /// The reason.
    pub cause: UnresolvedCause,
    /// The place.
    pub at: Vec2,
    /// The largest contrast nearby.
    pub contrast: f64,
}

impl UnresolvedCause {
    /// In words.
    pub fn name(self) -> &'static str {
        match self {
            Self::Many => "too many interfaces lie in one cell",
            Self::Turn => {
                "an interface of two materials has a corner, or turns too much in one cell"
            }
            Self::Corner => "interfaces of materials meet",
            Self::Border => "an interface of two materials meets the border",
            Self::Crack => "a crack meets an interface of two materials, or ends close to one",
        }
    }
}

/// The places of one interface.
type InterfaceRun = (usize, Vec<InterfacePoint>);

impl Interfaces<'_> {
    /// The reason why kinks do not resolve the interfaces in an open box inside the domain, if they
    /// do not.
    pub fn unresolved(&self, rect: &Rect) -> Option<UnresolvedInterface> {
        let runs: Vec<InterfaceRun> = (0..self.all.len())
            .map(|index| (index, self.places(&self.all[index], rect)))
            .filter(|(_, places)| !places.is_empty())
            .collect();
        let all = || runs.iter().flat_map(|(_, places)| places);
        let contrast = all().fold(0.0f64, |most, point| most.max(point.contrast));
        if contrast < LEAST_CONTRAST {
            return None;
        }
        let touch = TOUCH * rect.size().length();
        let many = (runs.len() > MOST).then(|| (UnresolvedCause::Many, rect.center()));
        let at_boundary = || all().find(|point| self.at_boundary(point, touch)).map(|p| p.at);
        let at_crack = || self.cracks.iter().find_map(|crack| at_crack(crack, all(), rect, touch));
        let (cause, at) = many
            .or_else(|| runs.iter().find_map(turn).map(|at| (UnresolvedCause::Turn, at)))
            .or_else(|| self.corner(&runs, touch).map(|at| (UnresolvedCause::Corner, at)))
            .or_else(|| at_crack().map(|at| (UnresolvedCause::Crack, at)))
            .or_else(|| at_boundary().map(|at| (UnresolvedCause::Border, at)))?;
        Some(UnresolvedInterface { cause, at, contrast })
    }

    /// The place at which two interfaces meet.
    fn corner(&self, runs: &[InterfaceRun], touch: f64) -> Option<Vec2> {
        let near = |index: usize, point: &InterfacePoint| {
            let interface = &self.all[index];
            let slope = interface.gradient(point.at);
            interface.value(point.at).abs() <= touch * slope.length()
                && slope.unit().cross(point.normal).abs() > ASLANT
        };
        runs.iter().enumerate().find_map(|(k, (i, own))| {
            runs[k + 1..].iter().find_map(|(j, others)| {
                let point = own.iter().find(|point| near(*j, point))?;
                others.iter().any(|other| near(*i, other)).then_some(point.at)
            })
        })
    }

    /// True if the interface runs into the boundary or a rim at a place.
    fn at_boundary(&self, point: &InterfacePoint, touch: f64) -> bool {
        let (near, far) = (point.at - self.domain.bounds.min, self.domain.bounds.max - point.at);
        let aslant = |normal: Vec2| normal.cross(point.normal).abs() > ASLANT;
        (near.x.min(far.x) < touch && aslant(vec2(1.0, 0.0)))
            || (near.y.min(far.y) < touch && aslant(vec2(0.0, 1.0)))
            || self.domain.holes.iter().any(|hole| hole.rim_distance(point.at) < touch)
    }
}

/// A place at which an interface is turned away from where it was.
fn turn((_, places): &InterfaceRun) -> Option<Vec2> {
    let away =
        |point: &&InterfacePoint| places.iter().any(|other| other.normal.dot(point.normal) < TURN);
    places.iter().find(away).map(|point| point.at)
}

/// The place at which a crack runs into an interface, or a tip of it in the box.
fn at_crack<'p>(
    crack: &Crack,
    mut places: impl Iterator<Item = &'p InterfacePoint>,
    rect: &Rect,
    touch: f64,
) -> Option<Vec2> {
    let ends: Vec<End> = crack.tips().collect();
    if let Some(end) = ends.into_iter().find(|&end| inside(rect, crack.end_point(end))) {
        return Some(crack.end_point(end));
    }
    let meets = |point: &&InterfacePoint| {
        crack.edges().any(|edge| {
            edge.distance(point.at) < touch
                && edge.tangent_towards(point.at).dot(point.normal).abs() > ASLANT
        })
    };
    places.find(meets).map(|point| point.at)
}
