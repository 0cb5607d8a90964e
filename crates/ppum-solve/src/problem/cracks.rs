//! Cracks as a problem gives them: what their ends are, and where they may lie.

use ppum::crack::{Crack, CrackEnd};
use ppum::domain::{Domain, Hole};
use ppum::vec2::{Rect, Vec2};

use super::boundary::Edge;
use super::check::Violation;
use super::key::Key;

/// Lengths below this part of the domain's longer side count as zero: nearer things are meant to
/// touch, and no cover resolves them.
pub(super) const TOUCH: f64 = 1e-9;

/// A crack along a polyline: ends on the border of the box, and on the rim or inside of a hole (up to
/// 10⁻⁹ of the domain's size), are mouths, all others tips.
#[must_use]
pub fn crack(points: Vec<Vec2>, domain: &Domain) -> Crack {
    let touch = touch(&domain.bounds);
    let end = |point: Option<&Vec2>| match point {
        Some(p) if edges_at(*p, &domain.bounds, 0.0).next().is_some() => CrackEnd::Mouth,
        Some(p) if domain.holes.iter().any(|hole| reaches(hole, *p, touch)) => CrackEnd::Mouth,
        _ => CrackEnd::Tip,
    };
    let ends = [end(points.first()), end(points.last())];
    Crack { points, ends }
}

/// The length below which things touch.
fn touch(bounds: &Rect) -> f64 {
    let size = bounds.size();
    TOUCH * size.x.max(size.y)
}

/// True if a point lies in a hole or on its rim.
fn reaches(hole: &Hole, p: Vec2, touch: f64) -> bool {
    hole.contains(p) || hole.rim_distance(p) <= touch
}

/// The edges no farther from `p` than `tolerance`.
fn edges_at(p: Vec2, domain: &Rect, tolerance: f64) -> impl Iterator<Item = Edge> {
    let depths = Edge::ALL.map(|edge| (edge, edge.depth(domain, p)));
    depths.into_iter().filter(move |(_, depth)| depth.abs() <= tolerance).map(|(edge, _)| edge)
}

/// All rules broken by the cracks. Each crack must be in order before two are compared.
pub(super) fn check_cracks(cracks: &[Crack], domain: &Domain) -> Vec<Violation> {
    let touch = touch(&domain.bounds);
    let mut found = Vec::new();
    for (index, crack) in cracks.iter().enumerate() {
        let points = Key::new("crack").index(index).name("points");
        let mut broken = check_crack(&crack.points, &domain.bounds, touch, &points);
        broken.extend(check_at_holes(crack, &domain.holes, touch, &points));
        let in_order = broken.is_empty();
        found.extend(broken);
        if in_order {
            let earlier = cracks[..index].iter().enumerate();
            found.extend(earlier.filter_map(|(other, earlier)| {
                let segment = first_touch(&crack.points, &earlier.points, touch)?;
                let message = "the crack crosses or touches another one, which is not supported yet in \
                               this version; move them apart";
                let other = Key::new("crack").index(other).name("points");
                Some(Violation::new(points.clone().index(segment), message).with_other(other))
            }));
        }
    }
    found
}

/// Some of the crack lies in the material, and no tip too near to a rim to be meant.
fn check_at_holes(crack: &Crack, holes: &[Hole], touch: f64, key: &Key) -> Option<Violation> {
    let lost = |hole: &Hole| crack.points.iter().all(|p| reaches(hole, *p, touch));
    let convex = |hole: &Hole| matches!(hole, Hole::Circle { .. });
    let hole = holes.iter().position(|hole| convex(hole) && lost(hole))?;
    let message = format!("the crack lies in hole {hole}; move it out, or leave it out");
    Some(Violation::new(key.clone(), message))
}

fn check_crack(points: &[Vec2], domain: &Rect, touch: f64, key: &Key) -> Vec<Violation> {
    if points.len() < 2 {
        let message = "a crack needs at least two points; add `[x, y]`";
        return vec![Violation::new(key.clone(), message)];
    }
    let mut found = check_places(points, domain, touch, key);
    found.extend(check_segments(points, domain, touch, key));
    if found.is_empty() {
        found.extend(check_whole(points, domain, touch, key));
    }
    found
}

/// Each point inside the closed box; on its border only the ends, and then exactly.
fn check_places(points: &[Vec2], domain: &Rect, touch: f64, key: &Key) -> Vec<Violation> {
    let place = |(index, p): (usize, &Vec2)| {
        let is_end = index == 0 || index + 1 == points.len();
        let near = edges_at(*p, domain, touch).next();
        let message = match near {
            _ if !p.is_finite() => "the point is not finite".to_owned(),
            Some(edge) if edges_at(*p, domain, 0.0).next().is_none() => format!(
                "the point misses the {} edge by {:e}; put it on the edge exactly, or farther away",
                edge.name(),
                edge.depth(domain, *p).abs()
            ),
            _ if !domain.contains(*p) => {
                "the point lies outside the domain; move it in, or enlarge the domain".to_owned()
            }
            Some(edge) if !is_end => format!(
                "the crack touches the {} edge between its ends; only an end may lie on the border",
                edge.name()
            ),
            _ => return None,
        };
        Some(Violation::new(key.clone().index(index), message))
    };
    points.iter().enumerate().filter_map(place).collect()
}

/// Each segment of positive length, and not along the border.
fn check_segments(points: &[Vec2], domain: &Rect, touch: f64, key: &Key) -> Vec<Violation> {
    let segment = |(index, pair): (usize, &[Vec2])| {
        let [a, b] = [pair[0], pair[1]];
        let along = edges_at(a, domain, touch)
            .find(|edge| edges_at(b, domain, touch).any(|other| other == *edge));
        let (at, message) = match along {
            _ if (b - a).length() <= touch => {
                (index + 1, "the point equals the one before it; remove it".to_owned())
            }
            Some(edge) => (
                index,
                format!("the crack runs along the {} edge; move it into the plate", edge.name()),
            ),
            None => return None,
        };
        Some(Violation::new(key.clone().index(at), message))
    };
    points.windows(2).enumerate().filter_map(segment).collect()
}

/// No crossing with itself, and no hook.
fn check_whole(points: &[Vec2], domain: &Rect, touch: f64, key: &Key) -> Option<Violation> {
    if let Some((first, second)) = self_touch(points, touch) {
        let message = format!(
            "the crack crosses, touches or folds back on itself: its segments {} and {} meet; \
             separate them",
            first + 1,
            second + 1
        );
        return Some(Violation::new(key.clone().index(second), message));
    }
    hook(points, domain, touch).map(|segment| {
        let message = "the straight extension of an end of the crack meets the crack itself, and such \
                       hooks are not supported yet in this version: the side of the crack would be \
                       wrong beyond the end; straighten it";
        Violation::new(key.clone().index(segment), message)
    })
}

/// The segment that the straight extension of an end, as far as the domain reaches, runs into.
fn hook(points: &[Vec2], domain: &Rect, touch: f64) -> Option<usize> {
    let last = points.len() - 1;
    let reach = domain.size().length();
    let ends = [(points[0], points[1], 0), (points[last], points[last - 1], last - 1)];
    ends.into_iter().find_map(|(end, before, own)| {
        let ray = [end, end + (end - before).unit() * reach];
        let meets = |k: &usize| *k != own && distance(ray, [points[*k], points[*k + 1]]) <= touch;
        (0..last).find(meets)
    })
}

/// Two sides of a closed polygon that touch where they should not.
pub(super) fn crosses_itself(sides: &[[Vec2; 2]], touch: f64) -> Option<(usize, usize)> {
    let n = sides.len();
    let meet = |i: usize, j: usize| match (j - i, n - (j - i)) {
        (1, _) => folds_back(sides[i], sides[j], touch),
        (_, 1) => folds_back(sides[j], sides[i], touch),
        _ => distance(sides[i], sides[j]) <= touch,
    };
    let pairs = (1..n).flat_map(|j| (0..j).map(move |i| (i, j)));
    pairs.into_iter().find(|&(i, j)| meet(i, j))
}

/// The first two segments of one crack that touch where they should not.
fn self_touch(points: &[Vec2], touch: f64) -> Option<(usize, usize)> {
    let segments: Vec<_> = points.windows(2).map(|pair| [pair[0], pair[1]]).collect();
    let meet = |i: usize, j: usize| match j - i {
        1 => folds_back(segments[i], segments[j], touch),
        _ => distance(segments[i], segments[j]) <= touch,
    };
    let pairs = (1..segments.len()).flat_map(|j| (0..j).map(move |i| (i, j)));
    pairs.into_iter().find(|&(i, j)| meet(i, j))
}

/// True if the second segment runs back along the first one, with which it shares a vertex.
fn folds_back([a, b]: [Vec2; 2], [_, c]: [Vec2; 2], touch: f64) -> bool {
    let (back, on) = (a - b, c - b);
    let reach = back.length().min(on.length());
    back.dot(on) > 0.0 && back.unit().cross(on.unit()).abs() * reach <= touch
}

/// The first segment of crack `a` that touches crack `b`.
fn first_touch(a: &[Vec2], b: &[Vec2], touch: f64) -> Option<usize> {
    let near = |s: &[Vec2]| b.windows(2).any(|t| distance([s[0], s[1]], [t[0], t[1]]) <= touch);
    a.windows(2).position(near)
}

/// Distance of two segments, zero if they cross.
fn distance(s: [Vec2; 2], t: [Vec2; 2]) -> f64 {
    if splits(s, t) && splits(t, s) {
        return 0.0;
    }
    let ends = [(s[0], t), (s[1], t), (t[0], s), (t[1], s)];
    ends.into_iter().map(|(p, segment)| distance_to(p, segment)).fold(f64::INFINITY, f64::min)
}

/// True if the line of `s` has the ends of `t` on different sides.
fn splits([a, b]: [Vec2; 2], t: [Vec2; 2]) -> bool {
    let [c, d] = t.map(|p| (b - a).cross(p - a));
    (c < 0.0) != (d < 0.0)
}

/// Distance of a point to a segment of positive length.
fn distance_to(p: Vec2, [a, b]: [Vec2; 2]) -> f64 {
    let along = b - a;
    let s = ((p - a).dot(along) / along.dot(along)).clamp(0.0, 1.0);
    (p - a - along * s).length()
}

#[cfg(test)]
mod tests {
    use ppum::vec2::vec2;

    use super::*;

    fn segment(a: [f64; 2], b: [f64; 2]) -> [Vec2; 2] {
        [a.into(), b.into()]
    }

    #[test]
    fn distances_of_segments() {
        let s = segment([0.0, 0.0], [2.0, 0.0]);
        for (t, expected) in [
            (segment([1.0, -1.0], [1.0, 1.0]), 0.0),
            (segment([1.0, 0.5], [1.0, 1.0]), 0.5),
            (segment([5.0, 4.0], [6.0, 4.0]), 5.0),
            (segment([3.0, 0.0], [4.0, 0.0]), 1.0),
            (segment([1.0, 0.0], [4.0, 0.0]), 0.0),
            (segment([0.0, 1.0], [2.0, 3.0]), 1.0),
        ] {
            assert_eq!(distance(s, t), expected, "{t:?}");
            assert_eq!(distance(t, s), expected, "{t:?}");
        }
    }

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
        assert_eq!(self_touch(&kinked(0.5, 1e-6), 1e-9), None);
        assert_eq!(self_touch(&kinked(0.5, 0.0), 1e-9), Some((0, 1)));
        assert_eq!(self_touch(&kinked(2.0, 0.0), 1e-9), None);
    }
}
