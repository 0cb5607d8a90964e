//! Cracks without what rounding adds to them.
//!
//! Vertices are left out that a crack does not need: it keeps to its course without them up to the
//! length that counts as zero. Where ends of cracks meet, or lie on other cracks, they become one
//! point, on the line of those that go on straight there. So two segments that meet have one line
//! or differ by more than rounding, and the side of a line that something lies on is not decided
//! by it.

use std::collections::BTreeMap;

use ppum::crack::{Crack, CrackEnd};
use ppum::edge::Edge;
use ppum::line::Line;
use ppum::vec2::Vec2;

use super::{Nearby, TooDense};

/// Times that joints are looked for: those of the first time move the ends of lines that others
/// are on.
const ROUNDS: usize = 2;

/// Distance of ends that count as one place, in lengths that count as zero: each may be as far from
/// a vertex that is left out.
const MEETS: f64 = 2.0;

/// Sine of the angle between lines from which on their crossing is where they meet.
const APART: f64 = 1e-3;

/// Height of an arc above its chord that is rounding, in lengths that count as zero.
const FLAT: f64 = 1e-7;

/// An end of a line, by the line's number; true of the last vertex.
type LineEnd = (usize, bool);

/// Lines without vertices that they do not need, their ends that meet in one point. Ends that are
/// `held` stay.
pub(crate) fn straightened(
    lines: impl IntoIterator<Item = Crack>,
    is_held: impl Fn(Vec2) -> bool,
    touch: f64,
) -> Vec<Crack> {
    let mut lines: Vec<_> = lines.into_iter().map(|line| needed(&line, touch)).collect();
    for _ in 0..ROUNDS {
        let Ok(joints) = joints(&lines, MEETS * touch) else { break };
        for (ends, at) in joints {
            for (line, is_last) in ends {
                let points = &mut lines[line].points;
                let k = if is_last { points.len() - 1 } else { 0 };
                points[k] = if is_held(points[k]) { points[k] } else { at };
            }
        }
    }
    lines
}

/// A line without the vertices between segments that it does not need to keep within `touch` of its
/// course; arcs whose height is rounding are segments.
pub(crate) fn needed(line: &Crack, touch: f64) -> Crack {
    let height = |edge: Edge| 0.5 * edge.bulge.abs() * edge.chord().length();
    let bulge = |edge: Edge| if height(edge) <= FLAT * touch { 0.0 } else { edge.bulge };
    let bulges: Vec<f64> = line.edges().map(bulge).collect();
    let (mut points, mut kept) = (Vec::new(), Vec::new());
    for run in runs(&bulges) {
        let (from, is_arc) = (run.start, bulges[run.start] != 0.0);
        let own = &line.points[from..=run.end];
        let own = if is_arc { own.to_vec() } else { needed_points(own, touch) };
        kept.extend((1..own.len()).map(|_| bulges[from]));
        points.extend(&own[usize::from(from > 0)..]);
    }
    let points = if bulges.is_empty() { line.points.clone() } else { points };
    Crack { points, bulges: kept, ends: [CrackEnd::Tip; 2] }.plain()
}

/// The ranges of successive segments, and of single arcs.
fn runs(bulges: &[f64]) -> Vec<std::ops::Range<usize>> {
    let mut all: Vec<std::ops::Range<usize>> = Vec::new();
    for (k, bulge) in bulges.iter().enumerate() {
        match all.last_mut() {
            Some(run) if *bulge == 0.0 && bulges[k - 1] == 0.0 => run.end = k + 1,
            _ => all.push(k..k + 1),
        }
    }
    all
}

/// The vertices of a polyline that keep it within `touch` of its course. Vertices that are no
/// farther apart all stay: they are reported as errors.
fn needed_points(points: &[Vec2], touch: f64) -> Vec<Vec2> {
    let mut kept: Vec<Vec2> = points.first().copied().into_iter().collect();
    let mut range: Option<DirectionRange> = None;
    for pair in points.windows(2) {
        let from = kept[kept.len() - 1];
        let is_apart = (pair[1] - pair[0]).length() > touch;
        range = match range.filter(|range| is_apart && range.holds(pair[1] - from)) {
            Some(range) => Some(range.narrowed(pair[1] - from, touch)),
            None => {
                kept.extend((pair[0] != from).then_some(pair[0]));
                is_apart.then(|| DirectionRange::new(pair[1] - pair[0], touch))
            }
        };
    }
    kept.extend(points.get(1..).and_then(<[Vec2]>::last));
    kept
}

/// The directions, as angles from a first one, of the lines from a vertex that pass what
/// follows it.
#[derive(Clone, Copy)]
struct DirectionRange {
    first: Vec2,
    angles: [f64; 2],
    /// Distance of what it has come to.
    reach: f64,
}

impl DirectionRange {
    fn new(way: Vec2, touch: f64) -> Self {
        let whole = Self { first: way, angles: [f64::NEG_INFINITY, f64::INFINITY], reach: 0.0 };
        whole.narrowed(way, touch)
    }

    fn angle(&self, way: Vec2) -> f64 {
        self.first.cross(way).atan2(self.first.dot(way))
    }

    /// True if the line goes on to there without passing what it has come to.
    fn holds(&self, way: Vec2) -> bool {
        let angle = self.angle(way);
        way.length() > self.reach && self.angles[0] <= angle && angle <= self.angles[1]
    }

    fn narrowed(self, way: Vec2, touch: f64) -> Self {
        let (angle, reach) = (self.angle(way), way.length());
        let slack = (touch / reach).min(1.0).asin();
        let [low, high] = self.angles;
        Self { angles: [low.max(angle - slack), high.min(angle + slack)], reach, ..self }
    }
}

/// Ends that meet.
#[derive(Default)]
struct Joint {
    ends: Vec<LineEnd>,
    /// The edges that pass through.
    through: Vec<Edge>,
    /// A vertex of another line.
    corner: Option<Vec2>,
}

/// The ends that meet each other or lie on other lines, and their place.
///
/// # Errors
/// The lines lie too close together.
fn joints(lines: &[Crack], touch: f64) -> Result<Vec<(Vec<LineEnd>, Vec2)>, TooDense> {
    let (pieces, nearby) = Nearby::of_cracks(lines.iter().enumerate(), touch);
    let end = |(line, is_last): LineEnd| {
        let points = &lines[line].points;
        points[if is_last { points.len() - 1 } else { 0 }]
    };
    let mut meeting: BTreeMap<LineEnd, Joint> = BTreeMap::new();
    let all = (0..lines.len()).filter(|&line| lines[line].points.len() > 1);
    for own in all.flat_map(|line| [(line, false), (line, true)]) {
        let p = end(own);
        let is_at = |q: Vec2| (q - p).length() <= touch;
        let (mut first, mut through, mut corner) = (own, Vec::new(), None);
        let mut is_alone = true;
        for at in nearby.at(p)? {
            let (line, k, edge @ Edge { from: a, to: b, .. }) = pieces[at];
            if line == own.0 || edge.distance(p) > touch {
                continue;
            }
            is_alone = false;
            let ends = [(is_at(a), k == 0), (is_at(b), k + 2 == lines[line].points.len())];
            match ends {
                [(true, true), _] => first = first.min((line, false)),
                [_, (true, true)] => first = first.min((line, true)),
                [(true, false), _] => corner = Some(a),
                [_, (true, false)] => corner = Some(b),
                _ => through.push(edge),
            }
        }
        if !is_alone {
            let joint = meeting.entry(first).or_default();
            joint.ends.push(own);
            joint.through.extend(through);
            joint.corner = joint.corner.or(corner);
        }
    }
    // the vertex beside an end that a segment leads to
    let beside = |(line, is_last): LineEnd| {
        let crack = &lines[line];
        let edge = crack.edge(if is_last { crack.points.len() - 2 } else { 0 });
        (!edge.is_arc()).then_some(if is_last { edge.from } else { edge.to })
    };
    let joint = |(first, Joint { ends, mut through, corner }): (LineEnd, Joint)| {
        let p = end(first);
        let chords = ends.iter().enumerate().flat_map(|(k, &one)| {
            let chord = move |&other| Some(Edge::segment([beside(one)?, beside(other)?]));
            ends[..k].iter().filter_map(chord)
        });
        let is_straight = |s: &Edge| {
            s.distance(p) <= touch && [s.from, s.to].iter().all(|q| (*q - p).length() > touch)
        };
        through.extend(chords.filter(is_straight));
        let at = corner.unwrap_or_else(|| place(p, &through));
        (ends, at)
    };
    Ok(meeting.into_iter().map(joint).collect())
}

/// The point near `p` on one of some edges, or where two of them cross.
fn place(p: Vec2, edges: &[Edge]) -> Vec2 {
    let Some((first, others)) = edges.split_first() else { return p };
    if edges.iter().any(Edge::is_arc) {
        let foot = first.closest_point(p);
        let crossing = others.iter().find_map(|other| curved_crossing(p, first, other));
        return crossing.unwrap_or(foot);
    }
    let lines = |edge: &Edge| Line::through([edge.from, edge.to]);
    let line = lines(first);
    let crossing = others.iter().map(lines).find_map(|other| {
        let sine = line.unit().along.cross(other.unit().along);
        line.meets(&other).filter(|_| sine.abs() > APART).map(|[t, _]| line.at(t))
    });
    crossing.unwrap_or_else(|| line.at(line.foot(p)))
}

/// The crossing of two edges that is nearest to a point, if they cross at an angle.
fn curved_crossing(p: Vec2, first: &Edge, other: &Edge) -> Option<Vec2> {
    let points = first.meets_curve(other).into_iter().map(|part| first.at(part));
    let nearest = points.min_by(|a, b| (*a - p).length().total_cmp(&(*b - p).length()))?;
    let sine = first.tangent_towards(nearest).cross(other.tangent_towards(nearest));
    (sine.abs() > APART).then_some(nearest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cracks;
    use crate::geometry::Jumps;
    use ppum::border::touch;
    use ppum::domain::Domain;
    use ppum::vec2::{Rect, vec2};
    use ppum_testkit::random::Random;

    /// The parts that lines leave of the unit square.
    fn parts(lines: &[&[Vec2]], shift: Vec2) -> usize {
        let moved = |points: &&[Vec2]| points.iter().map(|p| *p + shift).collect();
        let around = Rect::new(vec2(-4.0, -4.0) + shift, vec2(5.0, 5.0) + shift);
        let domain = Domain::from(around);
        let cracks = cracks(lines.iter().map(moved).collect::<Vec<Vec<Vec2>>>(), &domain);
        let unit = Rect::new(shift, vec2(1.0, 1.0) + shift);
        Jumps::new(&cracks, &domain, touch(&around)).of(&unit).len() + 1
    }

    /// Two cracks that go on from each other on a line, or off it by rounding or more, with
    /// vertices beside their joint, a branch there, in any order, also where coordinates have few
    /// digits: no way leads through.
    #[test]
    fn joints_beside_a_line_are_closed() {
        let mut random = Random(19);
        for _ in 0..1000 {
            let joint = vec2(random.between(0.2, 0.8), random.between(0.2, 0.8));
            let along = random.direction();
            let [visible, rounding] = [random.between(2.0, 7.5), random.between(9.0, 17.0)];
            let off = along.left() * 10f64.powf(-random.pick(&[visible, rounding]));
            let at = |s: f64| joint + along * s;
            let near = [-1.0, 1.0].map(|sign| at(sign * 10f64.powf(random.between(-4.0, 0.0))));
            let apex = joint + off;
            let [left, right] = [[at(-3.0), near[0], apex], [apex, near[1], at(3.0)]];
            let whole = [&left[..], &right[1..]].concat();
            let branch = [apex, apex + off.unit() * 3.0];
            let shift = random.pick(&[Vec2::ZERO, vec2(1000.0, -5000.0)]);
            for (lines, expected) in [
                (&[&left[..], &right][..], 2),
                (&[&whole], 2),
                (&[&left, &right, &branch], 3),
                (&[&branch, &whole], 3),
                (&[&[at(-3.0), apex], &branch, &[apex, at(3.0)]], 3),
            ] {
                assert_eq!(parts(lines, shift), expected, "{lines:?}");
            }
        }
    }

    /// Vertices on a line are left out, whatever their rounding; others stay, and a second time
    /// changes nothing.
    #[test]
    fn vertices_that_are_not_needed() {
        let mut random = Random(20);
        for round in 0..300 {
            let touch = 1e-9;
            let [from, along] = [vec2(random.unit(), random.unit()), random.direction()];
            let mut places: Vec<f64> = (0..2 + random.below(9)).map(|_| random.unit()).collect();
            places.sort_by(f64::total_cmp);
            places.dedup_by(|b, a| *b - *a < 1e-6);
            let off = |random: &mut Random| along.left() * (random.between(-0.5, 0.5) * touch);
            let points: Vec<Vec2> =
                places.iter().map(|s| from + along * *s + off(&mut random)).collect();
            let ends = [points[0], points[points.len() - 1]];
            assert_eq!(
                needed_points(&points, touch),
                ends[..ends.len().min(points.len())],
                "{round}"
            );
            let bend = random.between(0.2, 0.8);
            let at = |k: u32| {
                vec2((bend * f64::from(k) / 200.0).sin(), (bend * f64::from(k) / 200.0).cos())
            };
            let arc: Vec<Vec2> = (0..=200).map(at).collect();
            let kept = needed_points(&arc, 1e-5);
            assert!(kept.len() < 150, "{}", kept.len());
            let missed = |p: &&Vec2| ppum::segment::polyline_distance(&kept, **p) > 1.1e-5;
            assert_eq!(arc.iter().find(missed), None);
        }
        let square = [vec2(0.0, 0.0), vec2(1.0, 0.0), vec2(1.0, 1e-8), vec2(0.0, 1e-8)];
        assert_eq!(needed_points(&square, 1e-9), square);
        let twice = [vec2(0.0, 0.0), vec2(0.5, 0.0), vec2(0.5, 1e-10), vec2(1.0, 0.0)];
        assert_eq!(needed_points(&twice, 1e-9), twice);
    }
}
