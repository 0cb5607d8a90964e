//! Closed curves that cross or touch themselves or each other.

use ppum::line::Line;
use ppum::vec2::Vec2;

use crate::error::ImportError;
use crate::source::SourceLine;

/// Most pairs of segments that are compared; those of an unusual drawing beyond are left to the
/// solver's own check.
const MOST_PAIRS: usize = 200_000_000;

/// A segment of a closed polyline.
struct BorderSegment {
    ends: [Vec2; 2],
    polyline: usize,
    number: usize,
}

impl BorderSegment {
    fn low(&self) -> Vec2 {
        self.ends[0].min(self.ends[1])
    }

    fn high(&self) -> Vec2 {
        self.ends[0].max(self.ends[1])
    }
}

/// Refuses closed polylines, given with their first points once more, that are not apart.
pub(crate) fn check(closed: &[(&[Vec2], SourceLine)]) -> Result<(), ImportError> {
    let segments = |(polyline, (points, _)): (usize, &(&[Vec2], SourceLine))| {
        let pairs = points.windows(2).enumerate();
        let segment = move |(number, p): (usize, &[Vec2])| BorderSegment {
            ends: [p[0], p[1]],
            polyline,
            number,
        };
        pairs.map(segment).collect::<Vec<_>>()
    };
    let mut all: Vec<_> = closed.iter().enumerate().flat_map(segments).collect();
    all.sort_by(|a, b| a.low().x.total_cmp(&b.low().x));
    let mut pairs = 0;
    for (k, a) in all.iter().enumerate() {
        let near = all[k + 1..].iter().take_while(|b| b.low().x <= a.high().x);
        for b in near {
            pairs += 1;
            let count = closed[a.polyline].0.len() - 1;
            if !are_neighbours(a, b, count) && meet(a, b) {
                let at = meeting_point(a, b);
                let (first, second) = (closed[a.polyline].1, closed[b.polyline].1);
                return Err(ImportError::Crossing { at, first, second });
            }
        }
        if pairs > MOST_PAIRS {
            break;
        }
    }
    Ok(())
}

/// True for segments that follow each other on one polyline of `count` segments.
fn are_neighbours(a: &BorderSegment, b: &BorderSegment, count: usize) -> bool {
    let apart = a.number.abs_diff(b.number);
    a.polyline == b.polyline && (apart <= 1 || apart + 1 == count)
}

/// True for segments with a common point.
fn meet(a: &BorderSegment, b: &BorderSegment) -> bool {
    let is_apart = b.low().y > a.high().y || a.low().y > b.high().y;
    let splits = |a: &BorderSegment, b: &BorderSegment| {
        let [p, q] = b.ends.map(|end| (a.ends[1] - a.ends[0]).cross(end - a.ends[0]));
        p.min(q) <= 0.0 && p.max(q) >= 0.0
    };
    !is_apart && splits(a, b) && splits(b, a)
}

/// The common point of the lines, or an end of parallel ones.
fn meeting_point(a: &BorderSegment, b: &BorderSegment) -> Vec2 {
    let [line, other] = [a, b].map(|segment| Line::through(segment.ends));
    line.meets(&other).map_or(other.from, |[t, _]| line.at(t))
}
