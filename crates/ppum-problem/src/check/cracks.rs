//! Rules for the courses of cracks, and for cracks that meet.

use std::collections::BTreeMap;

use ppum::border::{BorderLine, touch};
use ppum::crack::Crack;
use ppum::domain::{Domain, Hole};
use ppum::edge::Edge;
use ppum::text::{exact, trimmed};
use ppum::vec2::{Rect, Vec2};

use crate::data::DomainEdge;
use crate::file::{Key, KeyError};
use crate::geometry::{
    Holes, Nearby, TooDense, edges_at, first_pair, holes_at, holes_of, length_inside, lies_along,
    reaches, shown, wider,
};

/// Most contacts that are told.
const MOST_TOLD: usize = 100;

/// Most pairs of edges that meet: for each the pieces are found into which they cut the body.
const MOST_MEETINGS: usize = 100_000;

/// Largest bulge: that of an arc of 270 degrees.
const MOST_BULGE: f64 = 2.415;

/// All rules broken by the cracks. Each crack must be in order before two are compared.
pub(crate) fn check_cracks(cracks: &[Crack], domain: &Domain) -> Vec<KeyError> {
    let touch = touch(&domain.bounds);
    let (holes, lines) = (holes_of(domain, touch), domain.border_lines().collect::<Vec<_>>());
    let mut found = Vec::new();
    let mut in_order = Vec::new();
    for (index, crack) in cracks.iter().enumerate() {
        let course = Course { points: &crack.points, course: crack, crack: index, domain, touch };
        let broken = course.errors(&holes, &lines);
        in_order.extend(broken.is_empty().then_some(index));
        found.extend(broken);
    }
    found.extend(check_contacts(cracks, &in_order, touch));
    found
}

/// The course of a crack in a domain.
struct Course<'a> {
    points: &'a [Vec2],
    course: &'a Crack,
    crack: usize,
    domain: &'a Domain,
    touch: f64,
}

impl Course<'_> {
    fn error(&self, message: impl Into<String>) -> KeyError {
        Key::points(self.crack).error(message)
    }

    fn error_at(&self, point: usize, message: String) -> KeyError {
        Key::points(self.crack).index(point).error(message)
    }

    /// All rules that the course breaks.
    fn errors(&self, holes: &Holes<'_>, lines: &[BorderLine]) -> Vec<KeyError> {
        if self.points.len() < 2 {
            return vec![self.error("a crack needs at least two points; add `[x, y]`")];
        }
        if let Some((name, message)) = bad_bulges(&self.course.bulges, self.points.len() - 1) {
            let key = Key::new("crack").index(self.crack);
            return vec![key.name(&name).error(message)];
        }
        let line = self.domain.line_along(self.course);
        // what else is told of a crack that leaves the boundary follows from it
        if line.is_none()
            && self.points.iter().all(|p| self.domain.bounds.contains(*p))
            && let Some(along) = self.along_boundary(lines).or_else(|| self.along_rim(holes))
        {
            return vec![along];
        }
        let mut found: Vec<_> = self.bad_place(line.is_some()).into_iter().collect();
        found.extend(self.short_segments());
        if found.is_empty() {
            found.extend(self.meets_itself());
        }
        found.extend(self.at_holes(holes));
        if line.is_none_or(|line| line.hole.is_none()) {
            found.extend(self.outside());
        }
        found
    }

    /// No arc runs along a rim.
    fn along_rim(&self, holes: &Holes<'_>) -> Option<KeyError> {
        let along = |(index, edge): (usize, Edge)| {
            let mut near = holes.near(&edge.bounds());
            let (hole, _) = near.find(|(_, hole)| lies_along(edge, hole, self.touch))?;
            let message = format!(
                "the crack runs along the rim of hole {hole} around {}; move it into the body, or leave that part out: \
                 rims are free",
                shown(edge.middle())
            );
            Some(self.error_at(index, message))
        };
        self.course.edges().enumerate().filter(|(_, edge)| edge.is_arc()).find_map(along)
    }

    /// Some of the crack lies in the material, and no tip too near to a rim to be meant.
    fn at_holes(&self, holes: &Holes<'_>) -> Option<KeyError> {
        let lost = |hole: &Hole| {
            let is_in = |p: Vec2| reaches(hole, p, self.touch);
            let mut arcs = self.course.edges().filter(Edge::is_arc);
            self.points.iter().all(|p| is_in(*p)) && arcs.all(|arc| is_in(arc.middle()))
        };
        let convex = |hole: &Hole| matches!(hole, Hole::Circle { .. });
        let mut near = holes_at(holes, self.points[0]);
        let hole = near.find(|(_, hole)| convex(hole) && lost(hole))?.0;
        Some(self.error(format!("the crack lies in hole {hole}; move it out, or leave it out")))
    }

    /// No segment of a crack that leaves the boundary runs along one of its lines.
    fn along_boundary(&self, lines: &[BorderLine]) -> Option<KeyError> {
        let runs_along = |edge: Edge, line: &BorderLine| {
            let ends = [edge.from, edge.to];
            let [from, to] = ends.map(|p| line.coordinate(p));
            let common = from.max(to).min(line.length()) - from.min(to).max(0.0);
            ends.iter().all(|p| line.depth(*p).abs() <= self.touch) && common > self.touch
        };
        let along = |edge: Edge| lines.iter().find(|line| runs_along(edge, line));
        let mut segments = self.course.edges().enumerate().filter(|(_, edge)| !edge.is_arc());
        let (index, line) = segments.find_map(|(k, edge)| Some((k, along(edge)?)))?;
        let message = format!(
            "the crack runs along the {}, and leaves it; move it into the body, or let all of it lie on one \
             straight side, as in half of a symmetric body",
            line_words(line)
        );
        Some(self.error_at(index, message))
    }

    /// Some of the crack lies in the outline of the body.
    fn outside(&self) -> Option<KeyError> {
        let Domain { bounds, holes } = self.domain;
        let outline = std::slice::from_ref(&holes[self.domain.outline()?]);
        // a crack may lie on an edge of the box
        let inside = length_inside(self.course, &wider(bounds, bounds.size().x), outline);
        let message = "the crack lies outside of the outline; move it in, or leave it out";
        (inside <= self.touch).then(|| self.error(message))
    }

    /// Each point inside the closed box; on its boundary only the ends, and then exactly, or all on
    /// one edge. The first that is not is told: a curve has many.
    fn bad_place(&self, is_along: bool) -> Option<KeyError> {
        let domain = &self.domain.bounds;
        let place = |(index, p): (usize, &Vec2)| {
            let is_end = index == 0 || index + 1 == self.points.len();
            let near = edges_at(*p, domain, self.touch).next();
            let message = match near {
                _ if !p.is_finite() => "the point is not finite".to_owned(),
                Some(edge) if is_end && edges_at(*p, domain, 0.0).next().is_none() => format!(
                    "the point misses the {} edge by {:e}; put it on the edge exactly, or farther away",
                    edge.name(),
                    edge.depth(domain, *p).abs()
                ),
                _ if !domain.contains(*p) => {
                    let depths = DomainEdge::ALL.map(|edge| (edge.depth(domain, *p), edge));
                    let least = depths.into_iter().reduce(|a, b| if b.0 < a.0 { b } else { a });
                    let (depth, edge) = least.unwrap_or((0.0, DomainEdge::Left));
                    format!(
                        "[{}, {}] lies outside the domain, {} beyond the {} edge; {}move it in, or enlarge the domain",
                        exact(p.x),
                        exact(p.y),
                        trimmed(-depth),
                        edge.name(),
                        if is_end { "put it on the edge, " } else { "" }
                    )
                }
                Some(edge) if !is_end && !is_along => format!(
                    "the crack touches the {} edge between its ends, at {}; only an end may lie on the border",
                    edge.name(),
                    shown(*p)
                ),
                _ => return None,
            };
            Some(self.error_at(index, message))
        };
        self.points.iter().enumerate().find_map(place).or_else(|| self.bulges_out())
    }

    /// No arc reaches the boundary of the box between its ends.
    fn bulges_out(&self) -> Option<KeyError> {
        let domain = &self.domain.bounds;
        let reaches = |arc: Edge, edge: DomainEdge| {
            let depth = |p: Vec2| edge.depth(domain, p);
            let Rect { min, max } = arc.bounds();
            let least = depth(min).min(depth(max));
            least <= self.touch && least < depth(arc.from).min(depth(arc.to)) - self.touch
        };
        let arcs = self.course.edges().enumerate().filter(|(_, edge)| edge.is_arc());
        let (index, arc, edge) = arcs.into_iter().find_map(|(index, arc)| {
            let edge = DomainEdge::ALL.into_iter().find(|edge| reaches(arc, *edge))?;
            Some((index, arc, edge))
        })?;
        let message = format!(
            "the arc from {} to {} reaches the {} edge between its ends; only an end of the crack may lie on the border",
            shown(arc.from),
            shown(arc.to),
            edge.name()
        );
        Some(self.error_at(index, message))
    }

    /// Each segment of positive length.
    fn short_segments(&self) -> impl Iterator<Item = KeyError> {
        let segments = self.points.windows(2).zip(1..);
        segments.filter(|(s, _)| (s[1] - s[0]).length() <= self.touch).map(|(s, at)| {
            let message = format!(
                "the point equals the one before it, {}, up to rounding; remove it, or make the crack larger",
                shown(s[0])
            );
            self.error_at(at, message)
        })
    }

    /// No crossing with itself.
    fn meets_itself(&self) -> Option<KeyError> {
        let (edges, last) = (self.course.edges().collect::<Vec<_>>(), self.points.len() - 1);
        let Ok(touching) = self_touch(&edges, false, self.touch) else {
            return Some(self.error(TooDense::message("parts of the crack")));
        };
        if let Some((first, second)) = touching {
            let message = format!(
                "the crack crosses, touches or folds back on itself around {}: its edges {} and {} meet; \
                 separate them, or give the second one as a crack of its own: cracks may meet others",
                shown(edges[first].meeting_point(&edges[second])),
                first + 1,
                second + 1
            );
            return Some(self.error_at(second, message));
        }
        // two arcs between the same points meet at both of them
        let is_closed = last > 1 && (self.points[last] - self.points[0]).length() <= self.touch;
        is_closed.then(|| {
            let message = format!(
                "the crack is closed: both of its ends are at {}; give it as two cracks whose ends meet",
                shown(self.points[0])
            );
            self.error_at(last, message)
        })
    }
}

/// An edge, or a side of a polygon, in words.
pub(crate) fn line_words(line: &BorderLine) -> String {
    match DomainEdge::of_line(line) {
        Some(edge) => format!("{} edge", edge.name()),
        None => format!("straight side from {} to {}", shown(line.ends[0]), shown(line.ends[1])),
    }
}

/// The name of the key and the message of bulges that are none, or of too few or too many.
pub(crate) fn bad_bulges(bulges: &[f64], edges: usize) -> Option<(String, String)> {
    if !bulges.is_empty() && bulges.len() != edges {
        let message = format!("there are {} bulges, but {edges} edges", bulges.len());
        return Some(("bulges".into(), message));
    }
    let index = bulges.iter().position(|bulge| bulge.is_nan() || bulge.abs() > MOST_BULGE)?;
    let message = format!(
        "the bulge {} is that of an arc of more than 270 degrees; divide the arc by a point",
        bulges[index]
    );
    Some((format!("bulges[{index}]"), message))
}

/// The first two edges of a crack, or of a closed rim, that touch where they should not.
///
/// # Errors
/// The edges lie too close together to look at all pairs.
pub(crate) fn self_touch(
    edges: &[Edge],
    is_closed: bool,
    touch: f64,
) -> Result<Option<(usize, usize)>, TooDense> {
    first_pair(edges, touch, |i, j| {
        let (first, second) = (edges[i], edges[j]);
        let joins = [
            (j - i == 1).then_some((first, second)),
            (is_closed && j + 1 - i == edges.len()).then_some((second, first)),
        ];
        match joins {
            [None, None] => first.gap(&second) <= touch,
            _ => {
                let mut joins = joins.into_iter().flatten();
                joins.clone().any(|(before, on)| folds_back(before, on, touch))
                    || crosses_beside(first, second, joins.next().map(|(edge, _)| edge.to), touch)
            }
        }
    })
}

/// True if the second edge runs back along the first one, with which it shares a vertex: if their
/// tangents there are opposite.
fn folds_back(first: Edge, second: Edge, touch: f64) -> bool {
    let (back, on) = (first.reversed(), second);
    let reach = back.chord().length().min(on.chord().length());
    let [u, v] = [back, on].map(|edge| edge.end_tangents()[0]);
    u.dot(v) > 0.0 && u.cross(v).abs() * reach <= touch
}

/// True if edges that share a vertex, one of them an arc, meet at another point, which is no vertex
/// of both.
fn crosses_beside(first: Edge, second: Edge, vertex: Option<Vec2>, touch: f64) -> bool {
    let is_arc = first.is_arc() || second.is_arc();
    let shared = |p: Vec2| {
        let near = |q: Vec2| (p - q).length() <= touch;
        let is_end = |edge: Edge| near(edge.from) || near(edge.to);
        vertex.is_some_and(near) || (is_end(first) && is_end(second))
    };
    is_arc && first.meets(&second).into_iter().any(|[part, _]| !shared(first.at(part)))
}

/// No two of the cracks run along each other, and not too many meet. They may cross and end on
/// each other.
pub(crate) fn check_contacts(cracks: &[Crack], in_order: &[usize], touch: f64) -> Vec<KeyError> {
    let numbered = in_order.iter().map(|&crack| (crack, &cracks[crack]));
    let (pieces, nearby) = Nearby::of_cracks(numbered, touch);
    let (mut along, mut meetings) = (BTreeMap::new(), 0);
    for &(crack, k, edge) in &pieces {
        let Ok(near) = nearby.of(edge) else {
            return vec![Key::new("crack").error(TooDense::message("the cracks"))];
        };
        let earlier = near.into_iter().take_while(|&other| pieces[other].0 < crack);
        let earlier = earlier.map(|other| pieces[other]);
        for (other, _, met) in earlier.filter(|(.., other)| edge.gap(other) <= touch) {
            meetings += 1;
            if run_along(edge, met, touch) {
                along.entry((crack, other)).or_insert(k);
            }
        }
        if along.len() >= MOST_TOLD || meetings > MOST_MEETINGS {
            break;
        }
    }
    let too_many = (meetings > MOST_MEETINGS).then(|| {
        let message =
            format!("the cracks meet at more than {MOST_MEETINGS} places; leave some out");
        Key::new("crack").error(message)
    });
    along.into_iter().take(MOST_TOLD).map(overlap).chain(too_many).collect()
}

/// The error of a crack that runs along another one at its edge `k`.
fn overlap(((crack, other), k): ((usize, usize), usize)) -> KeyError {
    let message = "the crack runs along another one; leave out the part that they have in common, or \
                   move them apart";
    Key::points(crack).index(k).error(message).with_other(Key::points(other))
}

/// True if two edges have more than a point in common: both ends of what one covers of the other,
/// and its middle, lie on it.
fn run_along(edge: Edge, other: Edge, touch: f64) -> bool {
    let [p, q] = [other.from, other.to].map(|end| edge.closest_part(end));
    let on = |part: f64| other.distance(edge.at(part)) <= touch;
    let is_long = (p - q).abs() * edge.length() > 4.0 * touch;
    is_long && on(p) && on(q) && (!edge.is_arc() || on(0.5 * (p + q)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;
    use ppum_testkit::random::Random;
    use std::f64::consts::PI;

    #[test]
    fn sharp_kinks_are_no_folds() {
        let (a, b) = (vec2(0.0, 0.0), vec2(1.0, 0.0));
        let kinked = |x, y| [Edge::segment([a, b]), Edge::segment([b, vec2(x, y)])];
        assert_eq!(self_touch(&kinked(0.5, 1e-6), false, 1e-9), Ok(None));
        assert_eq!(self_touch(&kinked(0.5, 0.0), false, 1e-9), Ok(Some((0, 1))));
        assert_eq!(self_touch(&kinked(2.0, 0.0), false, 1e-9), Ok(None));
    }

    #[test]
    fn segments_that_share_more_than_a_point() {
        let s = Edge::segment([vec2(0.0, 0.0), vec2(2.0, 0.0)]);
        for (a, b, expected) in [
            ((1.0, 0.0), (3.0, 0.0), true),
            ((3.0, 0.0), (1.0, 0.0), true),
            ((-1.0, 1e-12), (3.0, 0.0), true),
            ((0.5, 0.0), (0.6, 1e-10), true),
            ((2.0, 0.0), (3.0, 0.0), false),
            ((1.0, 0.0), (3.0, 1e-3), false),
            ((0.0, 0.0), (2.0, 1e-6), false),
            ((1.0, -1.0), (1.0, 1.0), false),
        ] {
            let t = Edge::segment([vec2(a.0, a.1), vec2(b.0, b.1)]);
            assert_eq!(run_along(s, t, 1e-9), expected, "{t:?}");
            assert_eq!(run_along(t, s, 1e-9), expected, "{t:?} first");
        }
    }

    const DOMAIN: Rect = Rect::new(vec2(-3.0, -3.0), vec2(3.0, 3.0));

    /// Vertices and bulges of a crack.
    type CrackShape<'a> = (&'a [[f64; 2]], &'a [f64]);

    /// The messages of what is wrong with cracks, turned and shifted.
    fn errors(cracks: &[CrackShape<'_>], angle: f64, shift: f64) -> Vec<String> {
        let along = vec2(angle.cos(), angle.sin());
        let turned = |p: &[f64; 2]| along * p[0] + along.left() * p[1] + vec2(shift, -shift);
        let crack = |(points, bulges): &CrackShape<'_>| Crack {
            points: points.iter().map(turned).collect(),
            bulges: bulges.to_vec(),
            ..Crack::default()
        };
        let cracks: Vec<Crack> = cracks.iter().map(crack).collect();
        check_cracks(&cracks, &DOMAIN.into()).into_iter().map(|error| error.message).collect()
    }

    /// Arcs that are in order, and such as are not, however they are turned and rounded.
    #[test]
    fn arcs_in_order_and_not() {
        const QUARTER: f64 = 0.414_213_562_373_095_03;
        let mut random = Random(31);
        let (a, b, c, d) = ([1.0, 0.0], [0.0, 1.0], [-1.0, 0.0], [0.0, -1.0]);
        let half = [[1.0, 0.0], [-1.0, 0.0]];
        let upper = [[(PI / 3.0).cos(), (PI / 3.0).sin()], c];
        let cases: [(&[CrackShape<'_>], &str); 12] = [
            (&[(&[a, b, c, d], &[QUARTER; 3])], ""),
            (&[(&[a, b, c], &[QUARTER, -QUARTER])], ""),
            (&[(&[[-2.0, 1.0], b, a, [1.0, -1.0]], &[0.0, -QUARTER, 0.0])], ""),
            (&[(&half, &[1.0]), (&[[0.0, 2.0], [0.0, 0.5]], &[])], ""),
            (&[(&half, &[1.0]), (&half, &[0.5])], ""),
            (&[(&[a, b, c, d, a], &[QUARTER; 4])], "its edges 1 and 4 meet"),
            (&[(&[a, b, [2.0, 1.0]], &[QUARTER, 0.0])], "folds back on itself around"),
            (&[(&[a, b, a], &[QUARTER, -QUARTER])], "folds back on itself around"),
            (&[(&[a, c, [0.5, 0.1]], &[1.0, 0.2])], ""),
            (&[(&[a, c, [0.5, 1.1]], &[1.0, 0.0])], "its edges 1 and 2 meet"),
            (&[(&half, &[1.0]), (&upper, &[(PI / 6.0).tan()])], "runs along another one"),
            (&[(&half, &[2.5])], "of more than 270 degrees"),
        ];
        for round in 0..60 {
            let (angle, shift) = (random.between(0.0, 7.0), random.between(-1e-13, 1e-13));
            let shift = if round % 3 == 0 { 0.0 } else { shift };
            for (k, (cracks, message)) in cases.iter().enumerate() {
                let found = errors(cracks, angle, shift);
                let is_found = found.iter().any(|found| found.contains(message));
                assert!(found.is_empty() == message.is_empty(), "{k}: {found:?}");
                assert!(message.is_empty() || is_found, "{k}: {found:?}");
            }
        }
    }

    /// Random chains of arcs are in order or not whichever way they run, however their arcs are
    /// divided, and moved by rounding.
    #[test]
    fn chains_of_arcs_do_not_hang_on_rounding() {
        let mut random = Random(32);
        let mut wrong = 0;
        for _ in 0..300 {
            let n = 2 + random.below(4);
            let mut point = || vec2(random.between(-2.0, 2.0), random.between(-2.0, 2.0));
            let points: Vec<Vec2> = (0..=n).map(|_| point()).collect();
            let bulges: Vec<f64> = (0..n).map(|_| random.between(-0.7, 0.7)).collect();
            let crack = Crack { points, bulges, ..Crack::default() };
            let is_wrong = |crack: Crack| !check_cracks(&[crack], &DOMAIN.into()).is_empty();
            let divided = |edge: Edge| {
                let part = |k: u32| f64::from(k) / 10.0;
                (0..10).map(move |k| edge.part([part(k), part(k + 1)])).collect::<Vec<_>>()
            };
            let mut moved = crack.clone();
            moved.points.iter_mut().for_each(|p| *p = *p + vec2(1e-13, -0.7e-13));
            let tenfold: Vec<Edge> = crack.edges().flat_map(divided).collect();
            let others = [crack.reversed(), moved, Crack::along(&tenfold)].map(is_wrong);
            assert_eq!(others, [is_wrong(crack.clone()); 3], "{crack:?}");
            wrong += usize::from(others[0]);
        }
        assert!((60..240).contains(&wrong), "{wrong}");
    }
}
