//! Pairs of near edges among many.

use std::cell::Cell;

use ppum::box_tree::BoxTree;
use ppum::crack::Crack;
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2, vec2};

use super::wider;

/// Most pairs of near edges that are looked at: a second or two. Cracks and rims that a cover
/// can resolve have a few pairs a segment.
const MOST: usize = 50_000_000;

/// Edges that are found by their places.
pub(crate) struct Nearby {
    tree: BoxTree,
    touch: f64,
    left: Cell<usize>,
}

/// Too many edges lie near each other to look at all pairs.
#[derive(Debug, PartialEq)]
pub(crate) struct TooDense;

impl TooDense {
    /// The message about the objects `what` whose edges these are.
    pub(crate) fn message(what: &str) -> String {
        format!(
            "{what} lie too close together: more than {MOST} pairs of their edges are near each other; \
             leave points out, or move them apart"
        )
    }
}

/// An edge of a crack, by the numbers of the crack and of the edge.
pub(crate) type CrackEdge = (usize, usize, Edge);

impl Nearby {
    /// All edges of some cracks, which are near where they come as close as `touch`.
    pub(crate) fn of_cracks<'c>(
        cracks: impl Iterator<Item = (usize, &'c Crack)>,
        touch: f64,
    ) -> (Vec<CrackEdge>, Self) {
        let of_crack = |(number, crack): (usize, &'c Crack)| {
            crack.edges().enumerate().map(move |(k, edge)| (number, k, edge))
        };
        let all: Vec<CrackEdge> = cracks.flat_map(of_crack).collect();
        let nearby = Self::new(&all.iter().map(|&(.., edge)| edge).collect::<Vec<_>>(), touch);
        (all, nearby)
    }

    /// Edges that are near where they come as close as `touch`.
    pub(crate) fn new(edges: &[Edge], touch: f64) -> Self {
        let boxes: Vec<_> = edges.iter().map(|edge| wider(&edge.bounds(), touch)).collect();
        Self { tree: BoxTree::new(&boxes), touch, left: Cell::new(MOST) }
    }

    /// The edges that may touch this one, ascending.
    ///
    /// # Errors
    /// The edges lie too close together.
    pub(crate) fn of(&self, edge: Edge) -> Result<Vec<usize>, TooDense> {
        self.within(edge.bounds())
    }

    /// The edges that may touch a point, ascending.
    ///
    /// # Errors
    /// The edges lie too close together.
    pub(crate) fn at(&self, p: Vec2) -> Result<Vec<usize>, TooDense> {
        self.within(Rect::around(p, vec2(0.0, 0.0)))
    }

    fn within(&self, bounds: Rect) -> Result<Vec<usize>, TooDense> {
        let mut found = Vec::new();
        self.tree.query_box(&wider(&bounds, self.touch), &mut found);
        let left = self.left.get().checked_sub(found.len()).ok_or(TooDense)?;
        self.left.set(left);
        Ok(found.into_iter().map(|index| index as usize).collect())
    }
}

/// The first pair i < j of edges, by j and then by i, that `meet` and may touch.
///
/// # Errors
/// The edges lie too close together.
pub(crate) fn first_pair(
    edges: &[Edge],
    touch: f64,
    meet: impl Fn(usize, usize) -> bool,
) -> Result<Option<(usize, usize)>, TooDense> {
    let nearby = Nearby::new(edges, touch);
    for (j, &edge) in edges.iter().enumerate() {
        let before = nearby.of(edge)?.into_iter().take_while(|&i| i < j);
        if let Some(i) = before.into_iter().find(|&i| meet(i, j)) {
            return Ok(Some((i, j)));
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    fn random_segments(n: usize, random: &mut Random) -> Vec<Edge> {
        let mut point = || vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        (0..n)
            .map(|_| {
                let a = point();
                let bulge = if a.x > 0.0 { 2.0 * a.y } else { 0.0 };
                Edge { from: a, to: a + point() * 0.2, bulge }
            })
            .collect()
    }

    /// All that the tree leaves out is farther away.
    #[test]
    fn all_that_is_near_is_found() {
        let mut random = Random(7);
        for touch in [1e-9, 1e-3] {
            let segments = random_segments(60, &mut random);
            let nearby = Nearby::new(&segments, touch);
            for &segment in &segments {
                let found = nearby.of(segment).expect("few");
                let near = |other: Edge| segment.gap(&other) <= touch;
                let missed = (0..60).filter(|i| !found.contains(i)).find(|&i| near(segments[i]));
                assert_eq!(missed, None);
            }
        }
    }

    #[test]
    fn the_first_pair_is_that_of_a_search_through_all() {
        let mut random = Random(8);
        for n in [0, 1, 2, 9, 40] {
            let segments = random_segments(n, &mut random);
            let meet = |i: usize, j: usize| segments[i].gap(&segments[j]) <= 1e-9;
            let all = (0..n).flat_map(|j| (0..j).map(move |i| (i, j))).find(|&(i, j)| meet(i, j));
            assert_eq!(first_pair(&segments, 1e-9, meet), Ok(all), "{n}");
        }
    }

    /// Parallel diagonals: all boxes overlap, no two segments touch.
    #[test]
    fn segments_without_end_are_refused_soon() {
        let diagonal = |k: u32| {
            let shift = vec2(f64::from(k) * 1e-6, 0.0);
            Edge::segment([vec2(-1.0, -1.0) + shift, vec2(1.0, 1.0) + shift])
        };
        let segments: Vec<_> = (0..20_000).map(diagonal).collect();
        assert_eq!(first_pair(&segments, 1e-9, |_, _| false), Err(TooDense));
    }
}
