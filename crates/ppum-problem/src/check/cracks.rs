//! Rules for the courses of cracks, and for cracks that meet.

use std::collections::BTreeMap;

use ppum::border::{BorderLine, touch};
use ppum::crack::Crack;
use ppum::domain::{Domain, Hole};
use ppum::line::Line;
use ppum::segment::{self, Segment, distance, gap};
use ppum::text::{exact, trimmed};
use ppum::vec2::Vec2;

use crate::data::DomainEdge;
use crate::file::{Key, KeyError};
use crate::geometry::{
    Holes, Nearby, TooDense, edges_at, first_pair, holes_at, holes_of, length_inside, reaches,
    shown, wider,
};

/// Most contacts that are told.
const MOST_TOLD: usize = 100;

/// Most pairs of segments that meet: for each the pieces are found into which they cut the body.
const MOST_MEETINGS: usize = 100_000;

/// All rules broken by the cracks. Each crack must be in order before two are compared.
pub(crate) fn check_cracks(cracks: &[Crack], domain: &Domain) -> Vec<KeyError> {
    let touch = touch(&domain.bounds);
    let (holes, lines) = (holes_of(domain, touch), domain.border_lines().collect::<Vec<_>>());
    let mut found = Vec::new();
    let mut in_order = Vec::new();
    for (index, crack) in cracks.iter().enumerate() {
        let course = Course { points: &crack.points, crack: index, domain, touch };
        let broken = course.errors(crack, &holes, &lines);
        in_order.extend(broken.is_empty().then_some(index));
        found.extend(broken);
    }
    found.extend(check_contacts(cracks, &in_order, touch));
    found
}

/// The course of a crack in a domain.
struct Course<'a> {
    points: &'a [Vec2],
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
    fn errors(&self, crack: &Crack, holes: &Holes<'_>, lines: &[BorderLine]) -> Vec<KeyError> {
        if self.points.len() < 2 {
            return vec![self.error("a crack needs at least two points; add `[x, y]`")];
        }
        let line = self.domain.line_along(self.points);
        // what else is told of a crack that leaves the boundary follows from it
        if line.is_none()
            && self.points.iter().all(|p| self.domain.bounds.contains(*p))
            && let Some(along) = self.along_boundary(lines)
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
            found.extend(self.outside(crack));
        }
        found
    }

    /// Some of the crack lies in the material, and no tip too near to a rim to be meant.
    fn at_holes(&self, holes: &Holes<'_>) -> Option<KeyError> {
        let lost = |hole: &Hole| self.points.iter().all(|p| reaches(hole, *p, self.touch));
        let convex = |hole: &Hole| matches!(hole, Hole::Circle { .. });
        let mut near = holes_at(holes, self.points[0]);
        let hole = near.find(|(_, hole)| convex(hole) && lost(hole))?.0;
        Some(self.error(format!("the crack lies in hole {hole}; move it out, or leave it out")))
    }

    /// No segment of a crack that leaves the boundary runs along one of its lines.
    fn along_boundary(&self, lines: &[BorderLine]) -> Option<KeyError> {
        let runs_along = |s: &[Vec2], line: &BorderLine| {
            let [from, to] = [s[0], s[1]].map(|p| line.coordinate(p));
            let common = from.max(to).min(line.length()) - from.min(to).max(0.0);
            s.iter().all(|p| line.depth(*p).abs() <= self.touch) && common > self.touch
        };
        let along = |s: &[Vec2]| lines.iter().find(|line| runs_along(s, line));
        let mut segments = self.points.windows(2).enumerate();
        let (index, line) = segments.find_map(|(k, s)| Some((k, along(s)?)))?;
        let message = format!(
            "the crack runs along the {}, and leaves it; move it into the body, or let all of it lie on one \
             straight side, as in half of a symmetric body",
            line_words(line)
        );
        Some(self.error_at(index, message))
    }

    /// Some of the crack lies in the outline of the body.
    fn outside(&self, crack: &Crack) -> Option<KeyError> {
        let Domain { bounds, holes } = self.domain;
        let outline = std::slice::from_ref(&holes[self.domain.outline()?]);
        // a crack may lie on an edge of the box
        let inside = length_inside(crack, &wider(bounds, bounds.size().x), outline);
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
        self.points.iter().enumerate().find_map(place)
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
        let segments: Vec<Segment> = self.points.windows(2).map(|s| [s[0], s[1]]).collect();
        let Ok(touching) = self_touch(&segments, false, self.touch) else {
            return Some(self.error(TooDense::message("parts of the crack")));
        };
        touching.map(|(first, second)| {
            let message = format!(
                "the crack crosses, touches or folds back on itself around {}: its segments {} and {} meet; \
                 separate them, or give the second one as a crack of its own: cracks may meet others",
                shown(place(segments[first], segments[second])),
                first + 1,
                second + 1
            );
            self.error_at(second, message)
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

/// Where two segments meet: where they cross, else the end of one that is the nearest to the other.
pub(crate) fn place(s: Segment, t: Segment) -> Vec2 {
    let line = Line::through(s);
    let crossing = line.meets(&Line::through(t)).map(|[at, _]| line.at(at));
    let ends = s.map(|p| (distance(t, p), p)).into_iter().chain(t.map(|p| (distance(s, p), p)));
    let crosses = crossing.map(|p| (distance(s, p).max(distance(t, p)), p));
    let all = ends.chain(crosses);
    all.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(s[0], |(_, p)| p)
}

/// The first two segments of a crack, or of a closed polygon, that touch where they should not.
///
/// # Errors
/// The segments lie too close together to look at all pairs.
pub(crate) fn self_touch(
    segments: &[Segment],
    is_closed: bool,
    touch: f64,
) -> Result<Option<(usize, usize)>, TooDense> {
    first_pair(segments, touch, |i, j| match j - i {
        1 => folds_back(segments[i], segments[j], touch),
        apart if is_closed && apart + 1 == segments.len() => {
            folds_back(segments[j], segments[i], touch)
        }
        _ => gap(segments[i], segments[j]) <= touch,
    })
}

/// True if the second segment runs back along the first one, with which it shares a vertex.
fn folds_back([a, b]: [Vec2; 2], [_, c]: [Vec2; 2], touch: f64) -> bool {
    let (back, on) = (a - b, c - b);
    let reach = back.length().min(on.length());
    back.dot(on) > 0.0 && back.unit().cross(on.unit()).abs() * reach <= touch
}

/// No two of the cracks run along each other, and not too many meet. They may cross and end on
/// each other.
pub(crate) fn check_contacts(cracks: &[Crack], in_order: &[usize], touch: f64) -> Vec<KeyError> {
    let of_crack = |&crack: &usize| {
        let segments = cracks[crack].points.windows(2).enumerate();
        segments.map(move |(k, pair)| (crack, k, [pair[0], pair[1]]))
    };
    let pieces: Vec<(usize, usize, Segment)> = in_order.iter().flat_map(of_crack).collect();
    let segments: Vec<_> = pieces.iter().map(|&(.., segment)| segment).collect();
    let nearby = Nearby::new(&segments, touch);
    let (mut along, mut meetings) = (BTreeMap::new(), 0);
    for &(crack, k, segment) in &pieces {
        let Ok(near) = nearby.of(segment) else {
            return vec![Key::new("crack").error(TooDense::message("the cracks"))];
        };
        let earlier = near.into_iter().take_while(|&other| pieces[other].0 < crack);
        for other in earlier.filter(|&other| gap(segment, segments[other]) <= touch) {
            meetings += 1;
            if run_along(segment, segments[other], touch) {
                along.entry((crack, pieces[other].0)).or_insert(k);
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

/// The error of a crack that runs along another one at its segment `k`.
fn overlap(((crack, other), k): ((usize, usize), usize)) -> KeyError {
    let message = "the crack runs along another one; leave out the part that they have in common, or \
                   move them apart";
    Key::points(crack).index(k).error(message).with_other(Key::points(other))
}

/// True if two segments have more than a point in common: both ends of what one covers of the other
/// lie on it.
fn run_along([a, b]: Segment, other: Segment, touch: f64) -> bool {
    let (along, length) = ((b - a).unit(), (b - a).length());
    let [p, q] = other.map(|end| along.dot(end - a).clamp(0.0, length));
    let on = |place: f64| segment::distance(other, a + along * place) <= touch;
    (p - q).abs() > 4.0 * touch && on(p) && on(q)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;

    #[test]
    fn sharp_kinks_are_no_folds() {
        let (a, b) = (vec2(0.0, 0.0), vec2(1.0, 0.0));
        let kinked = |x, y| [[a, b], [b, vec2(x, y)]];
        assert_eq!(self_touch(&kinked(0.5, 1e-6), false, 1e-9), Ok(None));
        assert_eq!(self_touch(&kinked(0.5, 0.0), false, 1e-9), Ok(Some((0, 1))));
        assert_eq!(self_touch(&kinked(2.0, 0.0), false, 1e-9), Ok(None));
    }

    #[test]
    fn segments_that_share_more_than_a_point() {
        let s = [vec2(0.0, 0.0), vec2(2.0, 0.0)];
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
            let t = [vec2(a.0, a.1), vec2(b.0, b.1)];
            assert_eq!(run_along(s, t, 1e-9), expected, "{t:?}");
            assert_eq!(run_along(t, s, 1e-9), expected, "{t:?} first");
        }
    }
}
