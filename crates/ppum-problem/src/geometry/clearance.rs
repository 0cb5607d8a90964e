//! Clearance of crack tips: the largest disc around a tip in which nothing disturbs its field.

use ppum::border::touch;
use ppum::crack::{Crack, End, TipId};
use ppum::dataset::{Dataset, Step};
use ppum::domain::{Domain, Hole};
use ppum::function::{Frame, Function, FunctionKind, Role};
use ppum::segment::{self, Segment, gap};
use ppum::vec2::{Rect, Vec2};

use super::material::jumps;

/// Distance from a tip, in cells, at which the material is compared with the tip's: more than
/// rounding of the coordinates, and nothing against the lengths over which a material
/// varies smoothly.
const BESIDE: f64 = 1e-9;

/// Radius of the clearance, in cells at the tip, from which on stress intensity factors are off by
/// less than 0.2 % with tips beside another tip and beside the boundary (order 2; 0.05 % at order
/// 3; docs/decisions/0004).
pub const AMPLE_CLEARANCE: f64 = 2.0;

/// Turn of a crack from its last segment on, in radians, up to which it counts as straight for the
/// cells at its tip: K of a crack with a kink of 0.1 at 1/50 of its length from the tip is off by
/// 6e-6, with one of 0.2 by 5e-5. On an arc turns up to 0.6 change nothing.
const GENTLE: f64 = 0.1;

/// Part of a length by which another may exceed it and still be as long, and cosine of angles that
/// are right ones: lengths of cracks are often whole cells, and their rounding must not decide
/// which cells are divided.
const AS_LONG: f64 = 1e-6;

/// The largest disc around a tip that holds no boundary, no hole, no other crack, and of its own
/// crack no more than the part that leads away from the tip. This part may have kinks. The material
/// may vary and jump in the disc; a tip at which it jumps has none.
///
/// The crack leads away from its tip as long as the distance to the tip grows along it, and as long
/// as it is behind the tip, where x < 0 in the tip's frame. So every circle in the disc meets it
/// once, and none of it lies ahead of the tip: with its last segment extended out of the disc it
/// divides the plane in two, and fields that jump on it are fields of one angle θ. A crack that
/// comes back, a hook, would need a sheet of its own for each arm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipClearance {
    /// Its radius.
    pub radius: f64,
    /// The obstacle that ends it.
    pub end: TipObstacle,
}

/// The end of the [`TipClearance`] of a tip.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TipObstacle {
    /// The boundary of the body.
    Border,
    /// The rim of a hole, by its index.
    Hole(usize),
    /// Its own crack, where that ends or comes back.
    Own,
    /// Another crack, by its index.
    Crack(usize),
    /// An interface of two materials, on which the tip itself lies.
    Interface,
    /// A force at a point.
    Force,
}

impl TipObstacle {
    /// In words, e.g. `crack 3`.
    #[must_use]
    pub fn name(self) -> String {
        match self {
            Self::Border => "the border".into(),
            Self::Hole(k) => format!("the rim of hole {k}"),
            Self::Own => "the other end of its crack or a part that turns back".into(),
            Self::Crack(k) => format!("crack {k}"),
            Self::Interface => "an interface of two materials".into(),
            Self::Force => "a force at a point".into(),
        }
    }
}

/// True if the coefficients of a function are known.
pub fn is_known(function: &Function) -> bool {
    function.kind.role() == Some(Role::Force)
}

/// The singular points of known fields whose functions are among those of a step.
pub fn known_points(functions: &[Function]) -> impl Iterator<Item = Vec2> {
    functions.iter().filter(|f| is_known(f)).filter_map(|function| match function.kind {
        FunctionKind::Formula { frame: Frame::Fixed { origin, .. }, .. } => Some(origin),
        _ => None,
    })
}

impl TipClearance {
    /// That of a tip on the boundary.
    pub const NONE: Self = Self { radius: 0.0, end: TipObstacle::Border };

    /// The clearance of a tip of a step of a dataset, in cells of the size `cell`.
    pub fn new(dataset: &Dataset, step: &Step, tip: TipId, cell: f64) -> Self {
        let cracks = &step.cracks;
        let p = cracks[tip.crack as usize].end_point(tip.end);
        let elastic = dataset.equation.elastic();
        let on_interface = elastic.is_some_and(|body| jumps(body, p, BESIDE * cell));
        let end = on_interface.then_some(Self { radius: 0.0, end: TipObstacle::Interface });
        let forces = known_points(&step.functions)
            .map(|at| Self { radius: (at - p).length(), end: TipObstacle::Force });
        Self::among_cracks(cracks, &dataset.domain, tip).with(end.into_iter().chain(forces))
    }

    /// The clearance without regard of materials.
    pub fn among_cracks(cracks: &[Crack], domain: &Domain, tip: TipId) -> Self {
        let own = &cracks[tip.crack as usize];
        let room = comes_back(own, tip.end).min(led_astray(own, tip.end, &domain.bounds));
        Self::nearest(cracks.iter().enumerate(), domain, (own, tip), room)
    }

    /// The disc in which also the own crack is nothing but its last segment, among some of the
    /// cracks, with their numbers, of which the tip's own one is left out: what cells at the tip
    /// have to resolve.
    pub fn among<'c>(
        cracks: impl Iterator<Item = (usize, &'c Crack)>,
        domain: &Domain,
        (own, tip): (&Crack, TipId),
    ) -> Self {
        Self::nearest(cracks, domain, (own, tip), behind(own, tip.end))
    }

    /// The nearest of boundary, rims, other cracks, and what is at the distance `of_own` of the own
    /// one.
    fn nearest<'c>(
        cracks: impl Iterator<Item = (usize, &'c Crack)>,
        domain: &Domain,
        (own, tip): (&Crack, TipId),
        of_own: f64,
    ) -> Self {
        let p = own.end_point(tip.end);
        let [low, high] = [p - domain.bounds.min, domain.bounds.max - p];
        // a tip on a line of the boundary has one half of its field in the body
        let touch = touch(&domain.bounds);
        let depths = [low.x, low.y, high.x, high.y].into_iter().filter(|depth| *depth != 0.0);
        let border =
            Self { radius: depths.fold(f64::INFINITY, f64::min), end: TipObstacle::Border };
        let holes = domain.holes.iter().enumerate();
        let distance = |hole: &Hole| match hole.rim_distance(p) {
            on if on <= touch => {
                let sides = hole.sides().map(|side| segment::distance(side, p));
                sides.filter(|distance| *distance > touch).fold(f64::INFINITY, f64::min)
            }
            distance => distance,
        };
        let rims = holes.map(|(k, hole)| Self {
            radius: distance(hole),
            end: if hole.is_outside() { TipObstacle::Border } else { TipObstacle::Hole(k) },
        });
        let others = cracks.filter(|(k, _)| *k != tip.crack as usize).map(|(k, c)| Self {
            radius: segment::polyline_distance(&c.points, p),
            end: TipObstacle::Crack(k),
        });
        border.with(rims).with(others.chain([Self { radius: of_own, end: TipObstacle::Own }]))
    }

    /// The smallest of several.
    fn with(self, others: impl Iterator<Item = Self>) -> Self {
        others.fold(self, |a, b| if b.radius < a.radius { b } else { a })
    }
}

/// Distance of a tip to what of its crack is not nearly straight on.
fn behind(own: &Crack, end: End) -> f64 {
    let (bent, tip) = (bent_part(own, end), own.end_point(end));
    let vertices = bent.iter().map(|&v| (v - tip).length()).fold(f64::INFINITY, f64::min);
    vertices.min(segment::polyline_distance(&bent, tip))
}

/// The vertices of a crack from an end on, from that one beyond which it has turned by more than
/// `GENTLE` up to its other end, which is always among them.
pub fn bent_part(own: &Crack, end: End) -> Vec<Vec2> {
    let points: Vec<Vec2> = from_tip(own, end).collect();
    let first = points[1] - points[0];
    let is_bent = |s: &[Vec2]| {
        let on = s[1] - s[0];
        first.cross(on).atan2(first.dot(on)).abs() > GENTLE
    };
    let straight = points.windows(2).position(is_bent).unwrap_or(points.len() - 1);
    points[straight..].to_vec()
}

/// The vertices of a crack from an end on.
pub fn from_tip(own: &Crack, end: End) -> impl Iterator<Item = Vec2> {
    let n = own.points.len();
    (0..n).map(move |k| match end {
        End::Start => own.points[k],
        End::Last => own.points[n - 1 - k],
    })
}

/// Distance of a tip to the part of its crack that does not lead away from it: the other end
/// at least.
fn comes_back(own: &Crack, end: End) -> f64 {
    let ([_, rest], tip) = (led_away(own, end), own.end_point(end));
    let end = rest.iter().map(|&p| (p - tip).length()).fold(f64::INFINITY, f64::min);
    end.min(segment::polyline_distance(&rest, tip))
}

/// The vertices of the part of a crack that leads away from a tip, and of the rest, which begins
/// where the other ends.
pub(super) fn led_away(own: &Crack, end: End) -> [Vec<Vec2>; 2] {
    let points: Vec<Vec2> = from_tip(own, end).collect();
    let (tip, axis) = (points[0], own.growth_direction(end));
    // a right angle leads neither away nor back, whatever its rounding
    let is_acute = |u: Vec2, v: Vec2| u.dot(v) > AS_LONG * u.length() * v.length();
    let leads_away = |s: &[Vec2]| is_acute(s[1] - s[0], s[0] - tip);
    let is_behind = |p: Vec2| is_acute(tip - p, axis);
    let first = |s: &&[Vec2]| s[0] == tip;
    let goes_on = |s: &&[Vec2]| (first(s) || leads_away(s)) && is_behind(s[1]);
    let away = points.windows(2).take_while(goes_on).count();
    [points[..=away].to_vec(), points[away..].to_vec()]
}

/// Distance from a tip up to which θ surely jumps on its crack alone. For a hook, whose extensions
/// meet it or each other, that is the distance at which the other end's extension, or a part of the
/// crack that returns, may be nearer than the tip's own part.
fn led_astray(own: &Crack, end: End, bounds: &Rect) -> f64 {
    let reach = bounds.size().length();
    if extensions(own, reach, 0.0).is_some() {
        return f64::INFINITY;
    }
    let (tip, other) = (own.end_point(end), if end == End::Start { End::Last } else { End::Start });
    let beyond = segment::distance(extension(own, other, reach), tip);
    0.5 * beyond.min(comes_back(own, end))
}

/// Distance from a vertex of a crack up to which the crack's side changes nowhere but on the two
/// segments there. For a hook, whose side is not that of the whole plane, it ends half way to the
/// next part or extension: there that is as near.
pub fn sure_side(crack: &Crack, at: Vec2, bounds: &Rect, touch: f64) -> f64 {
    let reach = bounds.size().length();
    if extensions(crack, reach, 0.0).is_some() {
        return f64::INFINITY;
    }
    let rays = [End::Start, End::Last].map(|end| extension(crack, end, reach));
    let all = crack.points.windows(2).map(|s| [s[0], s[1]]).chain(rays);
    let others = all.map(|s| segment::distance(s, at)).filter(|distance| *distance > touch);
    0.5 * others.fold(f64::INFINITY, f64::min)
}

/// The straight extension of a crack at an end.
pub(super) fn extension(crack: &Crack, end: End, length: f64) -> Segment {
    let tip = crack.end_point(end);
    [tip, tip + crack.growth_direction(end) * length]
}

/// The straight extensions of a crack, of a length; none if one of them comes near to the crack or
/// the other one: between the two its side is not that of the nearest segment.
pub(super) fn extensions(crack: &Crack, reach: f64, touch: f64) -> Option<[Segment; 2]> {
    let points = &crack.points;
    let rays = [End::Start, End::Last].map(|end| extension(crack, end, reach));
    let last = points.len() - 2;
    let own = points.windows(2).map(|s| [s[0], s[1]]).enumerate();
    let meets = |(k, s): (usize, Segment)| {
        (k != 0 && gap(rays[0], s) <= touch) || (k != last && gap(rays[1], s) <= touch)
    };
    (gap(rays[0], rays[1]) > touch && !own.into_iter().any(meets)).then_some(rays)
}

/// True if a length is larger than another by more than rounding of either.
pub fn exceeds(length: f64, other: f64) -> bool {
    length > other * (1.0 + AS_LONG)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::crack::CrackEnd;
    use ppum::domain::Hole;
    use ppum::vec2::vec2;

    fn clearance(cracks: &[Crack], crack: u32, end: End) -> (f64, TipObstacle) {
        let bounds = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
        let holes = vec![Hole::Circle { center: vec2(0.0, 0.75), radius: 0.125 }];
        let domain = Domain { bounds, holes };
        let clearance = TipClearance::among_cracks(cracks, &domain, TipId { crack, end });
        (clearance.radius, clearance.end)
    }

    fn crack(points: &[[f64; 2]]) -> Crack {
        let points = points.iter().copied().map(Vec2::from).collect();
        Crack { points, ends: [CrackEnd::Tip; 2] }
    }

    #[test]
    fn the_nearest_thing_ends_the_room() {
        let alone = [crack(&[[-0.125, 0.0], [0.5, 0.0]])];
        assert_eq!(clearance(&alone, 0, End::Last), (0.5, TipObstacle::Border));
        assert_eq!(clearance(&alone, 0, End::Start), (0.625, TipObstacle::Own));
        let two = [crack(&[[-0.5, 0.0], [0.0, 0.0]]), crack(&[[0.125, -0.5], [0.125, 0.5]])];
        assert_eq!(clearance(&two, 0, End::Last), (0.125, TipObstacle::Crack(1)));
        let up = [crack(&[[0.0, -0.5], [0.0, 0.5]])];
        assert_eq!(clearance(&up, 0, End::Last), (0.125, TipObstacle::Hole(0)));
    }

    /// Kinks lie in the disc as long as the crack goes on away from the tip.
    #[test]
    fn cracks_that_come_back_end_the_room() {
        let room = |points: &[[f64; 2]], end| clearance(&[crack(points)], 0, end);
        let gentle = [[-0.25, 0.0], [0.0, 0.0], [0.25, 0.0625]];
        let length = vec2(0.5, 0.0625).length();
        assert_eq!(room(&gentle, End::Last), (length, TipObstacle::Own));
        assert_eq!(room(&gentle, End::Start), (length, TipObstacle::Own));
        // square kinks go neither away nor back; after sharper ones the crack comes nearer
        let square = [[-0.25, 0.0], [0.25, 0.0], [0.25, 0.125]];
        assert_eq!(room(&square, End::Last), (0.125, TipObstacle::Own));
        assert_eq!(room(&square, End::Start), (0.5, TipObstacle::Own));
        let sharp = [[0.0, 0.0], [0.5, 0.0], [0.0, 0.25]];
        let (found, end) = room(&sharp, End::Start);
        assert!((found - 0.5 * 0.2f64.sqrt()).abs() < 1e-15 && end == TipObstacle::Own, "{found}");
        // back beside the tip without a vertex near it
        let hooked = [[0.0, 0.0], [0.5, 0.0], [0.5, 0.25], [-0.5, 0.25]];
        assert_eq!(room(&hooked, End::Start), (0.25, TipObstacle::Own));
        // round the tip, always farther away from it, and ahead of it at last
        let round = [[0.0, 0.0], [-0.25, 0.0], [-0.26, 0.25], [-0.1, 0.45], [0.3, 0.6]];
        let (found, end) = room(&round, End::Start);
        assert!((found - 0.2125f64.sqrt()).abs() < 1e-15 && end == TipObstacle::Own, "{found}");
    }

    /// The extension of the end of a hook runs into the hook, and past its other tip.
    #[test]
    fn hooks_lead_astray() {
        let hook = [[-0.5, -0.25], [0.5, -0.25], [0.5, 0.25], [0.0, 0.25], [0.0, 0.125]];
        let found = clearance(&[crack(&hook)], 0, End::Start);
        assert_eq!(found, (0.25, TipObstacle::Own));
        assert_eq!(clearance(&[crack(&hook[..4])], 0, End::Start).0, 0.5);
    }

    /// All of an arc that leads away from its tip, however finely it is divided.
    #[test]
    fn arcs_have_room() {
        for n in [8, 64, 1024] {
            let at = |k: u32| 1.5 * (f64::from(k) / f64::from(n) - 0.5);
            let points: Vec<_> =
                (0..=n).map(|k| [0.4 * at(k).sin(), 0.4 * at(k).cos() - 0.4]).collect();
            let (found, end) = clearance(&[crack(&points)], 0, End::Last);
            let chord = 0.8 * 0.75f64.sin();
            assert!((found - chord).abs() < 1e-15 && end == TipObstacle::Own, "{n}: {found}");
        }
    }
}
