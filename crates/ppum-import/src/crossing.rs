//! Closed curves that cross or touch themselves or each other.

use ppum::box_tree::BoxTree;
use ppum::line::Line;
use ppum::vec2::{Rect, Vec2, vec2};

use crate::error::{ImportError, shown};
use crate::source::SourceLine;

/// Most pairs of near segments that are compared; those of an unusual drawing beyond are left to
/// the solver's own check.
const MOST_PAIRS: usize = 200_000_000;

/// Margin of the boxes around segments, in parts of the coordinates: those that touch are near.
const MARGIN: f64 = 1e-12;

/// A segment of a closed polyline.
struct PolylineSegment {
    ends: [Vec2; 2],
    polyline: usize,
    number: usize,
}

impl PolylineSegment {
    fn bounds(&self) -> Rect {
        let [a, b] = self.ends;
        Rect::new(a.min(b), a.max(b))
    }
}

/// Refuses closed polylines, given with their first points once more, that are not apart.
pub(crate) fn check(closed: &[(&[Vec2], SourceLine)]) -> Result<(), ImportError> {
    let segments = |(polyline, (points, _)): (usize, &(&[Vec2], SourceLine))| {
        let pairs = points.windows(2).enumerate();
        let segment = |(number, p): (usize, &[Vec2])| PolylineSegment {
            ends: [p[0], p[1]],
            polyline,
            number,
        };
        pairs.map(segment).collect::<Vec<_>>()
    };
    let mut all: Vec<_> = closed.iter().enumerate().flat_map(segments).collect();
    all.sort_by(|a, b| a.bounds().min.x.total_cmp(&b.bounds().min.x));
    let boxes: Vec<Rect> = all.iter().map(PolylineSegment::bounds).collect();
    let size = boxes.iter().flat_map(|b| [b.min, b.max]).map(|p| p.x.abs().max(p.y.abs()));
    let margin = MARGIN * size.fold(f64::MIN_POSITIVE / MARGIN, f64::max);
    let (tree, mut near, mut pairs) = (BoxTree::new(&boxes), Vec::new(), 0);
    for (k, a) in all.iter().enumerate() {
        near.clear();
        let Rect { min, max } = boxes[k];
        tree.query_box(
            &Rect::new(min - vec2(margin, margin), max + vec2(margin, margin)),
            &mut near,
        );
        pairs += near.len();
        let count = closed[a.polyline].0.len() - 1;
        let later =
            near.iter().map(|j| &all[*j as usize]).skip_while(|b| !std::ptr::eq(*b, a)).skip(1);
        if let Some(b) = later.into_iter().find(|b| !are_neighbours(a, b, count) && meet(a, b)) {
            let (at, [first, second]) =
                (shown(meeting_point(a, b)), [a, b].map(|s| closed[s.polyline].1));
            return Err(ImportError(format!(
                "curves cross or touch at {at} ({first} and {second}); move them apart, or join them to one"
            )));
        }
        if pairs > MOST_PAIRS {
            break;
        }
    }
    Ok(())
}

/// True for segments that follow each other on one polyline of `count` segments.
fn are_neighbours(a: &PolylineSegment, b: &PolylineSegment, count: usize) -> bool {
    let apart = a.number.abs_diff(b.number);
    a.polyline == b.polyline && (apart <= 1 || apart + 1 == count)
}

/// True for segments with a common point.
fn meet(a: &PolylineSegment, b: &PolylineSegment) -> bool {
    let (s, t) = (a.bounds(), b.bounds());
    let is_apart = t.min.x > s.max.x || s.min.x > t.max.x || t.min.y > s.max.y || s.min.y > t.max.y;
    let splits = |a: &PolylineSegment, b: &PolylineSegment| {
        let [p, q] = b.ends.map(|end| (a.ends[1] - a.ends[0]).cross(end - a.ends[0]));
        p.min(q) <= 0.0 && p.max(q) >= 0.0
    };
    !is_apart && splits(a, b) && splits(b, a)
}

/// The common point of the lines, or an end of parallel ones.
fn meeting_point(a: &PolylineSegment, b: &PolylineSegment) -> Vec2 {
    let [line, other] = [a, b].map(|segment| Line::through(segment.ends));
    line.meets(&other).map_or(other.from, |[t, _]| line.at(t))
}
