//! Cracks as a problem gives them: what their ends are, and where they may lie.

use ppum::border::{BorderLine, touch};
use ppum::crack::{Crack, CrackEnd};
use ppum::domain::{Domain, Hole};
use ppum::vec2::{Rect, Vec2, vec2};

use super::box_list::{BoxList, wider};
use super::nearby::{Nearby, TooDense};
use super::straight::straightened;
use crate::data::DomainEdge;

/// A crack along a polyline or a chain of edges: ends on the boundary of the box, to which they are
/// moved, and on the rim or inside of a hole (up to 10⁻⁹ of the domain's size) are mouths, all
/// others tips. A crack that lies on a straight line of the boundary has tips where it ends between
/// two corners, and the body on its left. For cracks that meet, see [`cracks`].
#[must_use]
pub fn crack(course: impl Into<Crack>, domain: &Domain) -> Crack {
    cracks([course], domain).pop().unwrap_or_default()
}

/// Cracks along polylines or chains of edges, with their ends as [`crack`] has them, except for
/// ends on other cracks (up to the same distance), which are junctions.
///
/// Cracks that meet or are straight up to that distance are made to do so exactly: the points are
/// those of the lines except for vertices between segments that are not needed, and for junctions,
/// which are moved onto each other and onto edges.
#[must_use]
pub fn cracks(courses: impl IntoIterator<Item = impl Into<Crack>>, domain: &Domain) -> Vec<Crack> {
    settled(with_ends(courses, domain), domain)
}

/// Straightens cracks whose ends are known.
pub(crate) fn settled(cracks: Vec<Crack>, domain: &Domain) -> Vec<Crack> {
    let is_mouth = |p| edges_at(p, &domain.bounds, 0.0).next().is_some();
    let straight = straightened(cracks, is_mouth, touch(&domain.bounds));
    with_ends(straight.into_iter().map(|crack| with_body_on_left(crack, domain)), domain)
}

/// Cracks along lines as they are, except for ends on edges, and whole cracks, which they are moved
/// to.
pub(crate) fn with_ends(
    courses: impl IntoIterator<Item = impl Into<Crack>>,
    domain: &Domain,
) -> Vec<Crack> {
    let touch = touch(&domain.bounds);
    let holes = holes_of(domain, touch);
    let end = |point: Option<&mut Vec2>, line: Option<BorderLine>| {
        let Some(p) = point else { return CrackEnd::Tip };
        *p = onto_edges(*p, &domain.bounds, touch);
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
    let crack = |mut crack: Crack| {
        let line = domain.line_along(&crack);
        let points = &mut crack.points;
        if let Some(line) = line {
            points.iter_mut().for_each(|p| *p = inside(line.foot(*p, touch), &line, domain));
        }
        crack.ends = [end(points.first_mut(), line), end(points.last_mut(), line)];
        crack
    };
    let mut cracks: Vec<_> = courses.into_iter().map(|course| crack(course.into())).collect();
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

/// A crack on a line of the boundary in the direction that has the body on its left, so that the
/// face in the body is the one above; other cracks as they are.
fn with_body_on_left(crack: Crack, domain: &Domain) -> Crack {
    let way = |crack: &Crack| crack.points[crack.points.len() - 1] - crack.points[0];
    match domain.line_along(&crack) {
        Some(line) if line.direction().dot(way(&crack)) < 0.0 => crack.reversed(),
        _ => crack,
    }
}

/// Ends that lie on other cracks, up to the distance `touch`, are no tips but junctions. Where
/// cracks lie too close together to look at all of them, which is an error, they stay tips.
fn find_junctions(cracks: &mut [Crack], touch: f64) {
    let (pieces, nearby) = Nearby::of_cracks(cracks.iter().enumerate(), touch);
    let lies_on = |own: usize, p: Vec2| {
        let near = nearby.at(p)?;
        let mut others = near.into_iter().map(|at| pieces[at]).filter(|(k, ..)| *k != own);
        Ok::<_, TooDense>(others.any(|(.., edge)| edge.distance(p) <= touch))
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
        let ends =
            |a: [f64; 2], b: [f64; 2]| crack(vec![Vec2::from(a), b.into()], &domain.into()).ends;
        assert_eq!(ends([0.5, 0.5], [1.0, 0.5]), [CrackEnd::Tip, CrackEnd::Tip]);
        assert_eq!(ends([0.0, 0.5], [1.0, 0.5]), [CrackEnd::Mouth, CrackEnd::Tip]);
        assert_eq!(ends([0.5, 0.5], [2.0, 1.0]), [CrackEnd::Tip, CrackEnd::Mouth]);
    }

    #[test]
    fn ends_on_other_cracks_are_junctions() {
        let crack = |points: &[(f64, f64)]| {
            Crack::polyline(points.iter().map(|&(x, y)| vec2(x, y)).collect(), [CrackEnd::Tip; 2])
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
