//! Closed curves that cross or touch themselves or each other.

use ppum::box_tree::BoxTree;
use ppum::edge::Edge;
use ppum::vec2::{Rect, vec2};

use crate::error::{ImportError, shown};
use crate::source::SourceLine;

/// Most pairs of near edges that are compared; those of an unusual drawing beyond are left to the
/// solver's own check.
const MOST_PAIRS: usize = 200_000_000;

/// Distance at which edges touch, in parts of the coordinates.
const MARGIN: f64 = 1e-12;

/// An edge of a closed curve.
struct CurveEdge {
    edge: Edge,
    curve: usize,
    number: usize,
}

/// Refuses closed curves, given by their edges, that are not apart.
pub(crate) fn check(closed: &[(&[Edge], SourceLine)]) -> Result<(), ImportError> {
    let of_curve = |(curve, (edges, _)): (usize, &(&[Edge], SourceLine))| {
        let edges = edges.iter().enumerate();
        edges.map(|(number, edge)| CurveEdge { edge: *edge, curve, number }).collect::<Vec<_>>()
    };
    let all: Vec<_> = closed.iter().enumerate().flat_map(of_curve).collect();
    let boxes: Vec<Rect> = all.iter().map(|own| own.edge.bounds()).collect();
    let size = boxes.iter().map(Rect::max_norm);
    let margin = MARGIN * size.fold(f64::MIN_POSITIVE / MARGIN, f64::max);
    let (tree, mut near, mut pairs) = (BoxTree::new(&boxes), Vec::new(), 0);
    for (k, a) in all.iter().enumerate() {
        near.clear();
        let Rect { min, max } = boxes[k];
        let reach = vec2(margin, margin);
        tree.query_box(&Rect::new(min - reach, max + reach), &mut near);
        pairs += near.len();
        let later = near.iter().filter(|j| **j as usize > k).map(|j| &all[*j as usize]);
        let meets = |b: &&CurveEdge| {
            let count = closed[a.curve].0.len();
            !are_neighbours(a, b, count) && a.edge.gap(&b.edge) <= margin
        };
        if let Some(b) = later.into_iter().find(meets) {
            let (at, [first, second]) =
                (shown(a.edge.meeting_point(&b.edge)), [a, b].map(|own| closed[own.curve].1));
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

/// True for edges that follow each other on one curve of `count` edges.
fn are_neighbours(a: &CurveEdge, b: &CurveEdge, count: usize) -> bool {
    let apart = a.number.abs_diff(b.number);
    a.curve == b.curve && (apart <= 1 || apart + 1 == count)
}
