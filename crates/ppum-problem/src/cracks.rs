//! Cracks as a problem gives them: what their ends are, and where they may lie.

use ppum::border::BorderLine;
use ppum::border::touch;
use ppum::crack::{Crack, CrackEnd};
use ppum::domain::{Domain, Hole};
use ppum::line::Line;
use ppum::segment::{Segment, distance, gap};
use ppum::text::{exact, trimmed};
use ppum::vec2::{Rect, Vec2, vec2};

use super::boundary::DomainEdge;
use super::contacts::{check_contacts, find_junctions};
use super::key::{InvalidValue, Key};
use super::nearby::{TooDense, first_pair};
use super::straight::straightened;
use crate::geometry::{BoxList, length_inside, wider};

/// A crack along a polyline: ends on the boundary of the box, to which they are moved, and on the
/// rim or inside of a hole (up to 10⁻⁹ of the domain's size) are mouths, all others tips. A crack
/// that lies on a straight line of the boundary has tips where it ends between two corners, and the
/// body on its left. For cracks that meet, see [`cracks`].
#[must_use]
pub fn crack(points: Vec<Vec2>, domain: &Domain) -> Crack {
    let lines = [points];
    cracks(lines, domain).pop().unwrap_or(Crack { points: Vec::new(), ends: [CrackEnd::Tip; 2] })
}

/// Cracks along polylines, with their ends as [`crack`] has them, except for ends on other cracks
/// (up to the same distance), which are junctions.
///
/// Cracks that meet or are straight up to that distance are made to do so exactly: the points are
/// those of the lines except for vertices that are not needed, and for junctions, which are moved
/// onto each other and onto lines.
#[must_use]
pub fn cracks(lines: impl IntoIterator<Item = Vec<Vec2>>, domain: &Domain) -> Vec<Crack> {
    settled(with_ends(lines, domain), domain)
}

/// Straightens cracks whose ends are known.
pub(super) fn settled(cracks: Vec<Crack>, domain: &Domain) -> Vec<Crack> {
    let lines = cracks.into_iter().map(|crack| crack.points);
    let is_mouth = |p| edges_at(p, &domain.bounds, 0.0).next().is_some();
    let straight = straightened(lines, is_mouth, touch(&domain.bounds));
    with_ends(straight.into_iter().map(|points| with_body_on_left(points, domain)), domain)
}

/// Cracks along polylines as they are, except for ends on edges, and whole cracks, which they are
/// moved to.
pub(super) fn with_ends(lines: impl IntoIterator<Item = Vec<Vec2>>, domain: &Domain) -> Vec<Crack> {
    let touch = touch(&domain.bounds);
    let holes = holes_of(domain, touch);
    let end = |point: Option<&mut Vec2>, before: Option<Vec2>, line: Option<BorderLine>| {
        let Some(p) = point else { return CrackEnd::Tip };
        *p = onto_edges(*p, &domain.bounds, touch);
        let before = before.filter(|_| line.is_none());
        let onward = before.and_then(|before| beyond_rim(*p, (*p - before).unit(), domain));
        *p = *p + onward.unwrap_or(Vec2::ZERO);
        // along a line of the boundary a crack ends at corners: there it goes on in the mirrored
        // half
        let is_on_edge = line.is_some_and(|line| line.hole.is_none());
        let is_at_corner = line.is_some_and(|line| line.ends.contains(&*p));
        let is_mouth = edges_at(*p, &domain.bounds, 0.0).count() > usize::from(is_on_edge);
        let rim = line.and_then(|line| line.hole);
        let mut near = holes_at(&holes, *p).filter(|(k, _)| Some(*k) != rim);
        if is_mouth || is_at_corner || near.any(|(_, hole)| reaches(hole, *p, touch)) {
            CrackEnd::Mouth
        } else {
            CrackEnd::Tip
        }
    };
    let crack = |mut points: Vec<Vec2>| {
        let line = domain.line_along(&points);
        if let Some(line) = line {
            points.iter_mut().for_each(|p| *p = inside(line.foot(*p, touch), &line, domain));
        }
        let [second, last_but_one] =
            [points.get(1), points.iter().rev().nth(1)].map(|p| p.copied());
        let ends =
            [end(points.first_mut(), second, line), end(points.last_mut(), last_but_one, line)];
        Crack { points, ends }
    };
    let mut cracks: Vec<_> = lines.into_iter().map(crack).collect();
    find_junctions(&mut cracks, touch);
    cracks
}

/// A point of a line of the boundary, moved by a few roundings where these have put it outside: so
/// the field has values at tips on oblique sides.
fn inside(p: Vec2, line: &BorderLine, domain: &Domain) -> Vec2 {
    let size = p.x.abs().max(p.y.abs()).max(line.length());
    let step = line.outward() * (-f64::EPSILON * size);
    let is_end = line.ends.contains(&p);
    let mut moved = (0..8).map(|k| p + step * f64::from(k)).filter(|_| !is_end);
    moved.find(|q| domain.contains(*q)).unwrap_or(p)
}

/// Turn of a rim from side to side up to which it follows a curve, and reach of ends on the curve,
/// in parts of the distance between the curve and its sides.
const FOLLOWS: f64 = 0.2;
const ON_CURVE: f64 = 2.0;

/// The way on, along a crack, from an end that lies on the curve that a rim follows, but in the
/// body, to beyond the rim; none for other ends.
fn beyond_rim(p: Vec2, way: Vec2, domain: &Domain) -> Option<Vec2> {
    let on = |hole: &Hole| {
        let sides: Vec<_> = hole.sides().collect();
        let n = sides.len();
        let gap = |k: usize| {
            let [before, own, after] =
                [sides[(k + n - 1) % n], sides[k], sides[(k + 1) % n]].map(|[a, b]| (b - a).unit());
            let turn = before.cross(own).abs().max(own.cross(after).abs());
            let [a, b] = sides[k];
            let gap = ON_CURVE * (b - a).length() * turn / 8.0;
            let is_on = turn < FOLLOWS && distance(sides[k], p) <= gap;
            let meets = own.cross(way).abs();
            (is_on && meets > FOLLOWS).then(|| way * (2.0 * gap / meets))
        };
        (0..n).find_map(gap).filter(|way| hole.contains(p + *way) && !hole.contains(p))
    };
    domain.holes.iter().find_map(on)
}

/// Holes with their numbers.
type Holes<'h> = BoxList<(usize, &'h Hole)>;

fn holes_of(domain: &Domain, touch: f64) -> Holes<'_> {
    let holes = domain.holes.iter().enumerate();
    let place = |hole: &Hole| hole.bounds().intersection(&domain.bounds);
    BoxList::new(holes.map(|hole| (wider(&place(hole.1), 2.0 * touch), hole)))
}

/// The holes that may reach a point.
fn holes_at<'a, 'h>(holes: &'a Holes<'h>, p: Vec2) -> impl Iterator<Item = &'a (usize, &'h Hole)> {
    holes.near(&Rect::new(p, p))
}

/// True if a point lies in a hole or on its rim.
fn reaches(hole: &Hole, p: Vec2, touch: f64) -> bool {
    hole.contains(p) || hole.rim_distance(p) <= touch
}

/// The point on the edges that it misses by no more than `touch`.
fn onto_edges(p: Vec2, bounds: &Rect, touch: f64) -> Vec2 {
    let onto = |x: f64, edge: f64| if (x - edge).abs() <= touch { edge } else { x };
    let (x, y) = (onto(p.x, bounds.min.x), onto(p.y, bounds.min.y));
    vec2(onto(x, bounds.max.x), onto(y, bounds.max.y))
}

/// The edges no farther from `p` than `tolerance`.
fn edges_at(p: Vec2, domain: &Rect, tolerance: f64) -> impl Iterator<Item = DomainEdge> {
    let depths = DomainEdge::ALL.map(|edge| (edge, edge.depth(domain, p)));
    depths.into_iter().filter(move |(_, depth)| depth.abs() <= tolerance).map(|(edge, _)| edge)
}

/// The line of a crack on the boundary in the direction that has the body on its left, so that the
/// face in the body is the one above; other lines as they are.
fn with_body_on_left(mut points: Vec<Vec2>, domain: &Domain) -> Vec<Vec2> {
    if let Some(line) = domain.line_along(&points)
        && line.direction().dot(points[points.len() - 1] - points[0]) < 0.0
    {
        points.reverse();
    }
    points
}

/// All rules broken by the cracks. Each crack must be in order before two are compared.
pub(super) fn check_cracks(cracks: &[Crack], domain: &Domain) -> Vec<InvalidValue> {
    let touch = touch(&domain.bounds);
    let (holes, lines) = (holes_of(domain, touch), domain.border_lines().collect::<Vec<_>>());
    let mut found = Vec::new();
    let mut in_order = Vec::new();
    for (index, crack) in cracks.iter().enumerate() {
        let broken = check_crack(crack, (domain, &holes, &lines), touch, &Key::points(index));
        in_order.extend(broken.is_empty().then_some(index));
        found.extend(broken);
    }
    found.extend(check_contacts(cracks, &in_order, touch));
    found
}

/// Some of the crack lies in the material, and no tip too near to a rim to be meant.
fn check_at_holes(crack: &Crack, holes: &Holes<'_>, touch: f64, key: &Key) -> Option<InvalidValue> {
    let lost = |hole: &Hole| crack.points.iter().all(|p| reaches(hole, *p, touch));
    let convex = |hole: &Hole| matches!(hole, Hole::Circle { .. });
    let first = *crack.points.first()?;
    let hole = holes_at(holes, first).find(|(_, hole)| convex(hole) && lost(hole))?.0;
    let message = format!("the crack lies in hole {hole}; move it out, or leave it out");
    Some(key.clone().mistake(message))
}

/// No segment of a crack that leaves the boundary runs along one of its lines.
fn check_along_border(
    crack: &Crack,
    lines: &[BorderLine],
    touch: f64,
    key: &Key,
) -> Option<InvalidValue> {
    let runs_along = |s: &[Vec2], line: &BorderLine| {
        let [from, to] = [s[0], s[1]].map(|p| line.coordinate(p));
        let common = from.max(to).min(line.length()) - from.min(to).max(0.0);
        s.iter().all(|p| line.depth(*p).abs() <= touch) && common > touch
    };
    let along = |s: &[Vec2]| lines.iter().find(|line| runs_along(s, line));
    let mut segments = crack.points.windows(2).enumerate();
    let (index, line) = segments.find_map(|(k, s)| Some((k, along(s)?)))?;
    let message = format!(
        "the crack runs along the {}, and leaves it; move it into the body, or let all of it lie on one straight \
         side, as in half of a symmetric body",
        line_words(line)
    );
    Some(key.clone().index(index).mistake(message))
}

/// An edge, or a side of a polygon, in words.
pub(super) fn line_words(line: &BorderLine) -> String {
    match DomainEdge::of_line(line) {
        Some(edge) => format!("{} edge", edge.name()),
        None => format!("straight side from {} to {}", shown(line.ends[0]), shown(line.ends[1])),
    }
}

/// Some of the crack lies in the outline of the body.
fn check_in_outline(crack: &Crack, domain: &Domain, touch: f64, key: &Key) -> Option<InvalidValue> {
    let outline = std::slice::from_ref(&domain.holes[domain.outline()?]);
    // a crack may lie on an edge of the box
    let inside = length_inside(crack, &wider(&domain.bounds, domain.bounds.size().x), outline);
    let message = "the crack lies outside of the outline; move it in, or leave it out";
    (inside <= touch).then(|| key.clone().mistake(message))
}

fn check_crack(
    crack: &Crack,
    (domain, holes, lines): (&Domain, &Holes<'_>, &[BorderLine]),
    touch: f64,
    key: &Key,
) -> Vec<InvalidValue> {
    let (points, bounds) = (&crack.points, &domain.bounds);
    if points.len() < 2 {
        let message = "a crack needs at least two points; add `[x, y]`";
        return vec![key.clone().mistake(message)];
    }
    let line = domain.line_along(points);
    // what else is told of a crack that leaves the boundary follows from it
    if line.is_none()
        && points.iter().all(|p| bounds.contains(*p))
        && let Some(along) = check_along_border(crack, lines, touch, key)
    {
        return vec![along];
    }
    let places = check_places(points, (bounds, line.is_some()), touch, key);
    let mut found: Vec<InvalidValue> = places.into_iter().collect();
    found.extend(check_segments(points, touch, key));
    if found.is_empty() {
        found.extend(check_whole(points, touch, key));
    }
    found.extend(check_at_holes(crack, holes, touch, key));
    if line.is_none_or(|line| line.hole.is_none()) {
        found.extend(check_in_outline(crack, domain, touch, key));
    }
    found
}

/// Each point inside the closed box; on its boundary only the ends, and then exactly, or all on one
/// edge. The first that is not is told: a curve has many.
fn check_places(
    points: &[Vec2],
    (domain, is_along): (&Rect, bool),
    touch: f64,
    key: &Key,
) -> Option<InvalidValue> {
    let place = |(index, p): (usize, &Vec2)| {
        let is_end = index == 0 || index + 1 == points.len();
        let near = edges_at(*p, domain, touch).next();
        let message = match near {
            _ if !p.is_finite() => "the point is not finite".to_owned(),
            Some(edge) if is_end && edges_at(*p, domain, 0.0).next().is_none() => format!(
                "the point misses the {} edge by {:e}; put it on the edge exactly, or farther away",
                edge.name(),
                edge.depth(domain, *p).abs()
            ),
            _ if !domain.contains(*p) => {
                let depths = DomainEdge::ALL.map(|edge| (edge.depth(domain, *p), edge));
                let farther =
                    |a: (f64, DomainEdge), b: (f64, DomainEdge)| if b.0 < a.0 { b } else { a };
                let (depth, edge) = depths.into_iter().fold((0.0, DomainEdge::Left), farther);
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
        Some(key.clone().index(index).mistake(message))
    };
    points.iter().enumerate().find_map(place)
}

/// Where two segments meet: where they cross, else the end of one that is the nearest to the other.
pub(super) fn place(s: Segment, t: Segment) -> Vec2 {
    let line = Line::through(s);
    let crossing = line.meets(&Line::through(t)).map(|[at, _]| line.at(at));
    let ends = s.map(|p| (distance(t, p), p)).into_iter().chain(t.map(|p| (distance(s, p), p)));
    let crosses = crossing.map(|p| (distance(s, p).max(distance(t, p)), p));
    let all = ends.chain(crosses);
    all.min_by(|a, b| a.0.total_cmp(&b.0)).map_or(s[0], |(_, p)| p)
}

/// `[0.5, -0.25]`
pub(super) fn shown(p: Vec2) -> String {
    format!("[{}, {}]", trimmed(p.x), trimmed(p.y))
}

/// Each segment of positive length.
fn check_segments(points: &[Vec2], touch: f64, key: &Key) -> Vec<InvalidValue> {
    let segments = points.windows(2).zip(1..).filter(|(s, _)| (s[1] - s[0]).length() <= touch);
    let mistake = |(s, at): (&[Vec2], usize)| {
        let message = format!(
            "the point equals the one before it, {}, up to rounding; remove it, or make the crack larger",
            shown(s[0])
        );
        key.clone().index(at).mistake(message)
    };
    segments.map(mistake).collect()
}

/// No crossing with itself.
fn check_whole(points: &[Vec2], touch: f64, key: &Key) -> Option<InvalidValue> {
    let Ok(touching) = self_touch(points, touch) else {
        return Some(key.clone().mistake(TooDense::message("parts of the crack")));
    };
    touching.map(|(first, second)| {
        let message = format!(
            "the crack crosses, touches or folds back on itself around {}: its segments {} and {} meet; \
             separate them, or give the second one as a crack of its own: cracks may meet others",
            shown(place([points[first], points[first + 1]], [points[second], points[second + 1]])),
            first + 1,
            second + 1
        );
        key.clone().index(second).mistake(message)
    })
}

/// Two sides of a closed polygon that touch where they should not.
///
/// # Errors
/// The sides lie too close together to look at all pairs.
pub(super) fn crosses_itself(
    sides: &[Segment],
    touch: f64,
) -> Result<Option<(usize, usize)>, TooDense> {
    let n = sides.len();
    first_pair(sides, touch, |i, j| match (j - i, n - (j - i)) {
        (1, _) => folds_back(sides[i], sides[j], touch),
        (_, 1) => folds_back(sides[j], sides[i], touch),
        _ => gap(sides[i], sides[j]) <= touch,
    })
}

/// The first two segments of one crack that touch where they should not.
///
/// # Errors
/// The segments lie too close together to look at all pairs.
fn self_touch(points: &[Vec2], touch: f64) -> Result<Option<(usize, usize)>, TooDense> {
    let segments: Vec<Segment> = points.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    first_pair(&segments, touch, |i, j| match j - i {
        1 => folds_back(segments[i], segments[j], touch),
        _ => gap(segments[i], segments[j]) <= touch,
    })
}

/// True if the second segment runs back along the first one, with which it shares a vertex.
fn folds_back([a, b]: [Vec2; 2], [_, c]: [Vec2; 2], touch: f64) -> bool {
    let (back, on) = (a - b, c - b);
    let reach = back.length().min(on.length());
    back.dot(on) > 0.0 && back.unit().cross(on.unit()).abs() * reach <= touch
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_on_the_border_are_mouths() {
        let domain = Rect::new(vec2(0.0, 0.0), vec2(2.0, 1.0));
        let ends = |a: [f64; 2], b: [f64; 2]| crack(vec![a.into(), b.into()], &domain.into()).ends;
        assert_eq!(ends([0.5, 0.5], [1.0, 0.5]), [CrackEnd::Tip, CrackEnd::Tip]);
        assert_eq!(ends([0.0, 0.5], [1.0, 0.5]), [CrackEnd::Mouth, CrackEnd::Tip]);
        assert_eq!(ends([0.5, 0.5], [2.0, 1.0]), [CrackEnd::Tip, CrackEnd::Mouth]);
    }

    #[test]
    fn sharp_kinks_are_no_folds() {
        let kinked = |x, y| [vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(x, y)];
        assert_eq!(self_touch(&kinked(0.5, 1e-6), 1e-9), Ok(None));
        assert_eq!(self_touch(&kinked(0.5, 0.0), 1e-9), Ok(Some((0, 1))));
        assert_eq!(self_touch(&kinked(2.0, 0.0), 1e-9), Ok(None));
    }
}
