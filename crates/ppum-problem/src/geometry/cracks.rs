//! Cracks as a problem gives them: what their ends are, and where they may lie.

use ppum::border::{BorderLine, touch};
use ppum::crack::{Crack, CrackEnd};
use ppum::domain::{Domain, Hole};
use ppum::segment::{self, Segment, distance};
use ppum::vec2::{Rect, Vec2, vec2};

use super::box_list::{BoxList, wider};
use super::nearby::{Nearby, TooDense};
use super::straight::straightened;
use crate::data::DomainEdge;

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
pub(crate) fn settled(cracks: Vec<Crack>, domain: &Domain) -> Vec<Crack> {
    let lines = cracks.into_iter().map(|crack| crack.points);
    let is_mouth = |p| edges_at(p, &domain.bounds, 0.0).next().is_some();
    let straight = straightened(lines, is_mouth, touch(&domain.bounds));
    with_ends(straight.into_iter().map(|points| with_body_on_left(points, domain)), domain)
}

/// Cracks along polylines as they are, except for ends on edges, and whole cracks, which they are
/// moved to.
pub(crate) fn with_ends(lines: impl IntoIterator<Item = Vec<Vec2>>, domain: &Domain) -> Vec<Crack> {
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
pub(crate) type Holes<'h> = BoxList<(usize, &'h Hole)>;

pub(crate) fn holes_of(domain: &Domain, touch: f64) -> Holes<'_> {
    let holes = domain.holes.iter().enumerate();
    let place = |hole: &Hole| hole.bounds().intersection(&domain.bounds);
    BoxList::new(holes.map(|hole| (wider(&place(hole.1), 2.0 * touch), hole)))
}

/// The holes that may reach a point.
pub(crate) fn holes_at<'a, 'h>(
    holes: &'a Holes<'h>,
    p: Vec2,
) -> impl Iterator<Item = &'a (usize, &'h Hole)> {
    holes.near(&Rect::new(p, p))
}

/// True if a point lies in a hole or on its rim.
pub(crate) fn reaches(hole: &Hole, p: Vec2, touch: f64) -> bool {
    hole.contains(p) || hole.rim_distance(p) <= touch
}

/// The point on the edges that it misses by no more than `touch`.
fn onto_edges(p: Vec2, bounds: &Rect, touch: f64) -> Vec2 {
    let onto = |x: f64, edge: f64| if (x - edge).abs() <= touch { edge } else { x };
    let (x, y) = (onto(p.x, bounds.min.x), onto(p.y, bounds.min.y));
    vec2(onto(x, bounds.max.x), onto(y, bounds.max.y))
}

/// The edges no farther from `p` than `tolerance`.
pub(crate) fn edges_at(p: Vec2, domain: &Rect, tolerance: f64) -> impl Iterator<Item = DomainEdge> {
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

/// Ends that lie on other cracks, up to the distance `touch`, are no tips but junctions. Where
/// cracks lie too close together to look at all of them, which is an error, they stay tips.
fn find_junctions(cracks: &mut [Crack], touch: f64) {
    let of_crack = |(k, crack): (usize, &Crack)| {
        crack.points.windows(2).map(|s| (k, [s[0], s[1]])).collect::<Vec<_>>()
    };
    let pieces: Vec<(usize, Segment)> = cracks.iter().enumerate().flat_map(of_crack).collect();
    let segments: Vec<_> = pieces.iter().map(|&(_, segment)| segment).collect();
    let nearby = Nearby::new(&segments, touch);
    let lies_on = |own: usize, p: Vec2| {
        let near = nearby.of([p, p])?;
        let mut others = near.into_iter().map(|at| pieces[at]).filter(|(k, _)| *k != own);
        Ok::<_, TooDense>(others.any(|(_, s)| segment::distance(s, p) <= touch))
    };
    for (k, crack) in cracks.iter_mut().enumerate().filter(|(_, crack)| crack.points.len() > 1) {
        let ends = [crack.points[0], crack.points[crack.points.len() - 1]];
        for (kind, p) in crack.ends.iter_mut().zip(ends) {
            match lies_on(k, p) {
                Ok(true) if *kind == CrackEnd::Tip => *kind = CrackEnd::Junction,
                Ok(_) => {}
                Err(TooDense) => return,
            }
        }
    }
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
    fn ends_on_other_cracks_are_junctions() {
        let crack = |points: &[(f64, f64)]| Crack {
            points: points.iter().map(|&(x, y)| vec2(x, y)).collect(),
            ends: [CrackEnd::Tip; 2],
        };
        let mut cracks = [
            crack(&[(0.0, 0.0), (3.0, 1.0)]),
            crack(&[(1.5, 0.5), (1.0, 2.0)]),
            crack(&[(1.5, 0.5 + 1e-6), (2.0, 2.0)]),
            crack(&[(3.0, 1.0), (4.0, 0.0)]),
            crack(&[(1.0, -1.0), (1.0, 1.0)]),
        ];
        find_junctions(&mut cracks, 1e-9);
        use CrackEnd::{Junction, Tip};
        let expected = [[Tip, Junction], [Junction, Tip], [Tip, Tip], [Junction, Tip], [Tip, Tip]];
        assert_eq!(cracks.map(|crack| crack.ends), expected);
    }
}
