//! Clearance of crack tips: the largest disc around a tip in which nothing disturbs its field.

use ppum::border::touch;
use ppum::crack::{Crack, End, TipId};
use ppum::dataset::{Dataset, Step};
use ppum::domain::{Domain, Hole};
use ppum::edge::Edge;
use ppum::function::{Frame, Function, FunctionKind, Role};
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

/// Turn of a crack at its kinks from its last edge on, in radians, up to which it counts as smooth
/// for the cells at its tip: K of a crack with a kink of 0.1 at 1/50 of its length from the tip is
/// off by 6e-6, with one of 0.2 by 5e-5.
const GENTLE: f64 = 0.1;

/// The largest disc around a tip on an arc, in radii of the arc: at its centre the fields that
/// leave the arc free grow like one over the square of the distance, and their series ends.
const BEFORE_CENTER: f64 = 0.75;

/// Most of its sweep that a part of an arc has which leads away from a tip or does not, as a whole.
const PART: f64 = 0.2;

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
    /// The centre of the arc that its own crack is there.
    Center,
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
            Self::Center => "the centre of its crack's arc".into(),
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
                let sides = hole.edges().map(|side| side.distance(p));
                sides.filter(|distance| *distance > touch).fold(f64::INFINITY, f64::min)
            }
            distance => distance,
        };
        let rims = holes.map(|(k, hole)| Self {
            radius: distance(hole),
            end: if hole.is_outside() { TipObstacle::Border } else { TipObstacle::Hole(k) },
        });
        let others = cracks
            .filter(|(k, _)| *k != tip.crack as usize)
            .map(|(k, c)| Self { radius: c.distance(p), end: TipObstacle::Crack(k) });
        let own_disc = Self { radius: of_own, end: TipObstacle::Own };
        let radius = BEFORE_CENTER / own.edge_to(tip.end).curvature().abs();
        let before_center = Self { radius, end: TipObstacle::Center };
        border.with(rims).with(others.chain([own_disc, before_center]))
    }

    /// The smallest of several.
    fn with(self, others: impl Iterator<Item = Self>) -> Self {
        others.fold(self, |a, b| if b.radius < a.radius { b } else { a })
    }
}

/// Distance of a tip to what of its crack goes on beyond a kink.
fn behind(own: &Crack, end: End) -> f64 {
    let (tip, other) = (own.end_point(end), own.end_point(end.opposite()));
    least_distance(&bent_part(own, end), tip).min((other - tip).length())
}

/// The least distance of edges from a point; ∞ of none.
fn least_distance(edges: &[Edge], p: Vec2) -> f64 {
    edges.iter().map(|edge| edge.distance(p)).fold(f64::INFINITY, f64::min)
}

/// The edges of a crack from an end on, from that one on before which it has turned by more than
/// `GENTLE` at kinks; none if there is none. Joints with equal tangents are no kinks.
pub fn bent_part(own: &Crack, end: End) -> Vec<Edge> {
    let edges: Vec<Edge> = from_tip(own, end).collect();
    let turn = |pair: &[Edge]| {
        let (before, on) = (pair[0].end_tangents()[1], pair[1].end_tangents()[0]);
        before.cross(on).atan2(before.dot(on))
    };
    let turns = edges.windows(2).scan(0.0, |sum, pair| {
        *sum += turn(pair);
        Some(*sum)
    });
    let smooth = turns.take_while(|turn| turn.abs() <= GENTLE).count();
    edges.get(smooth + 1..).unwrap_or_default().to_vec()
}

/// The edges of a crack from an end on, in the direction that leads away from it.
pub fn from_tip(own: &Crack, end: End) -> impl Iterator<Item = Edge> {
    let n = own.points.len().saturating_sub(1);
    (0..n).map(move |k| match end {
        End::Start => own.edge(k),
        End::Last => own.edge(n - 1 - k).reversed(),
    })
}

/// Distance of a tip to the part of its crack that does not lead away from it: the other end
/// at least.
fn comes_back(own: &Crack, end: End) -> f64 {
    let ([_, rest], tip) = (led_away(own, end), own.end_point(end));
    least_distance(&rest, tip).min((own.end_point(end.opposite()) - tip).length())
}

/// The edges of the part of a crack that leads away from a tip, and of the rest, in the direction
/// from the tip. Arcs are divided.
pub(super) fn led_away(own: &Crack, end: End) -> [Vec<Edge>; 2] {
    let edges: Vec<Edge> = from_tip(own, end).flat_map(|edge| edge.divided(PART)).collect();
    let (tip, axis) = (own.end_point(end), own.growth_direction(end));
    // a right angle leads neither away nor back, whatever its rounding
    let is_acute = |u: Vec2, v: Vec2| u.dot(v) > AS_LONG * u.length() * v.length();
    let leads_away = |edge: &Edge| {
        let [start, last] = edge.end_tangents();
        let goes_off = edge.from == tip || is_acute(start, edge.from - tip);
        goes_off && (!edge.is_arc() || is_acute(last, edge.to - tip))
    };
    let is_behind = |p: Vec2| is_acute(tip - p, axis);
    let away = edges.iter().take_while(|edge| leads_away(edge) && is_behind(edge.to)).count();
    [edges[..away].to_vec(), edges[away..].to_vec()]
}

/// Distance from a tip up to which θ surely jumps on its crack alone. For a hook, whose extensions
/// meet it or each other, that is the distance at which the other end's extension, or a part of the
/// crack that returns, may be nearer than the tip's own part.
fn led_astray(own: &Crack, end: End, bounds: &Rect) -> f64 {
    let reach = bounds.size().length();
    if extensions(own, reach, 0.0).is_some() {
        return f64::INFINITY;
    }
    let tip = own.end_point(end);
    let beyond = extension(own, end.opposite(), reach).distance(tip);
    0.5 * beyond.min(comes_back(own, end))
}

/// Distance from a vertex of a crack up to which the crack's side changes nowhere but on the two
/// edges there. For a hook, whose side is not that of the whole plane, it ends half way to the
/// next part or extension: there that is as near.
pub fn sure_side(crack: &Crack, at: Vec2, bounds: &Rect, touch: f64) -> f64 {
    let reach = bounds.size().length();
    if extensions(crack, reach, 0.0).is_some() {
        return f64::INFINITY;
    }
    let rays = [End::Start, End::Last].map(|end| extension(crack, end, reach));
    let all = crack.edges().flat_map(|edge| edge.divided(PART)).chain(rays);
    let others = all.map(|edge| edge.distance(at)).filter(|distance| *distance > touch);
    0.5 * others.fold(f64::INFINITY, f64::min)
}

/// The straight extension of a crack at an end, along its tangent there.
pub(super) fn extension(crack: &Crack, end: End, length: f64) -> Edge {
    let tip = crack.end_point(end);
    Edge::segment([tip, tip + crack.growth_direction(end) * length])
}

/// The straight extensions of a crack, of a length; none if one of them comes near to the crack or
/// the other one: between the two its side is not that of the nearest edge.
pub(super) fn extensions(crack: &Crack, reach: f64, touch: f64) -> Option<[Edge; 2]> {
    let rays = [End::Start, End::Last].map(|end| extension(crack, end, reach));
    let last = crack.points.len() - 2;
    let meets = |(k, edge): (usize, Edge)| {
        (k != 0 && rays[0].gap(&edge) <= touch) || (k != last && rays[1].gap(&edge) <= touch)
    };
    (rays[0].gap(&rays[1]) > touch && !crack.edges().enumerate().any(meets)).then_some(rays)
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
        Crack::polyline(points, [CrackEnd::Tip; 2])
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

    /// All of an arc that leads away from its tip, by polylines and as one arc or ten.
    #[test]
    fn arcs_have_room() {
        let at = |part: f64| 1.5 * (part - 0.5);
        let point = |part: f64| vec2(0.4 * at(part).sin(), 0.4 * at(part).cos() - 0.4);
        let chord = 0.8 * 0.75f64.sin();
        for n in [1, 8, 10, 64, 1024] {
            let points: Vec<Vec2> = (0..=n).map(|k| point(f64::from(k) / f64::from(n))).collect();
            let bulge = (-1.5 / f64::from(4 * n)).tan();
            let arc = Crack { bulges: vec![bulge; n as usize], points, ..Crack::default() };
            let line = Crack::from(arc.points.clone());
            for crack in [line, arc] {
                let found = comes_back(&crack, End::Last);
                assert!((found - chord).abs() < 1e-15, "{n}: {found}");
                let (room, end) = clearance(std::slice::from_ref(&crack), 0, End::Last);
                // discs around tips on arcs end before the centre
                let expected = if crack.is_curved() {
                    (BEFORE_CENTER * 0.4, TipObstacle::Center)
                } else {
                    (found, TipObstacle::Own)
                };
                assert!((room - expected.0).abs() < 1e-12 && end == expected.1, "{n}: {room}");
                // joints of arcs are no kinks
                assert!(!crack.is_curved() || bent_part(&crack, End::Last).is_empty());
            }
        }
    }

    /// A crack along most of a circle leads away from its tip up to the opposite point; θ jumps on
    /// it alone half as far as the extension of its other end is away, where the extensions meet.
    #[test]
    fn long_arcs_come_back() {
        let arc = |sweep: f64| {
            let edge = Edge::around(Vec2::ZERO, 0.2, [0.0, sweep]);
            let points = vec![edge.from, edge.to];
            Crack { points, bulges: vec![edge.bulge], ..Crack::default() }
        };
        let bounds = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
        let radius = |sweep: f64| {
            let arc = arc(sweep);
            comes_back(&arc, End::Last).min(led_astray(&arc, End::Last, &bounds))
        };
        assert!((radius(2.5) - 0.4 * 1.25f64.sin()).abs() < 1e-15);
        for sweep in [3.5_f64, 4.5] {
            assert!((radius(sweep) - 0.1 * (1.0 - sweep.cos())).abs() < 1e-15, "{sweep}");
        }
    }
}
