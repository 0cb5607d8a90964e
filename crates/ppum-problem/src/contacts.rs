//! Cracks that meet: ends on other cracks, and cracks that run along each other.

use std::collections::BTreeMap;

use ppum::crack::{Crack, CrackEnd};
use ppum::segment::{self, Segment, gap};
use ppum::vec2::Vec2;

use super::key::{InvalidValue, Key};
use super::nearby::{Nearby, TooDense};

/// Most contacts that are told.
const MOST_TOLD: usize = 100;

/// Most pairs of segments that meet: for each the pieces are found into which they cut the body.
const MOST_MEETINGS: usize = 100_000;

/// Ends that lie on other cracks, up to the distance `touch`, are no tips but junctions. Where
/// cracks lie too close together to look at all of them, which is an error, they stay tips.
pub(super) fn find_junctions(cracks: &mut [Crack], touch: f64) {
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

/// No two of the cracks run along each other, and not too many meet. They may cross and end on
/// each other.
pub(super) fn check_contacts(
    cracks: &[Crack],
    in_order: &[usize],
    touch: f64,
) -> Vec<InvalidValue> {
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
            return vec![Key::new("crack").mistake(TooDense::message("the cracks"))];
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
        Key::new("crack").mistake(message)
    });
    along.into_iter().take(MOST_TOLD).map(overlap).chain(too_many).collect()
}

/// The error of a crack that runs along another one at its segment `k`.
fn overlap(((crack, other), k): ((usize, usize), usize)) -> InvalidValue {
    let message = "the crack runs along another one; leave out the part that they have in common, or \
                   move them apart";
    Key::points(crack).index(k).mistake(message).with_other(Key::points(other))
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
