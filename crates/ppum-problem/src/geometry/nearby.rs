//! Pairs of near segments among many.

use std::cell::Cell;

use ppum::box_tree::BoxTree;
use ppum::segment::Segment;
use ppum::vec2::Rect;

use super::{around, wider};

/// Most pairs of near segments that are looked at: a second or two. Cracks and rims that a cover
/// can resolve have a few pairs a segment.
const MOST: usize = 50_000_000;

/// Segments that are found by their places.
pub(crate) struct Nearby {
    tree: BoxTree,
    touch: f64,
    left: Cell<usize>,
}

/// Too many segments lie near each other to look at all pairs.
#[derive(Debug, PartialEq)]
pub(crate) struct TooDense;

impl TooDense {
    /// The message about the objects `what` whose segments these are.
    pub(crate) fn message(what: &str) -> String {
        format!(
            "{what} lie too close together: more than {MOST} pairs of their segments are near each other; \
             leave points out, or move them apart"
        )
    }
}

impl Nearby {
    /// Segments that are near where they come as close as `touch`.
    pub(crate) fn new(segments: &[Segment], touch: f64) -> Self {
        let boxes: Vec<_> = segments.iter().map(|&segment| touching(segment, touch)).collect();
        Self { tree: BoxTree::new(&boxes), touch, left: Cell::new(MOST) }
    }

    /// The segments that may touch this one, ascending.
    ///
    /// # Errors
    /// The segments lie too close together.
    pub(crate) fn of(&self, segment: Segment) -> Result<Vec<usize>, TooDense> {
        let mut found = Vec::new();
        self.tree.query_box(&touching(segment, self.touch), &mut found);
        let left = self.left.get().checked_sub(found.len()).ok_or(TooDense)?;
        self.left.set(left);
        Ok(found.into_iter().map(|index| index as usize).collect())
    }
}

fn touching(segment: Segment, margin: f64) -> Rect {
    wider(&around(&segment), margin)
}

/// The first pair i < j of segments, by j and then by i, that `meet` and may touch.
///
/// # Errors
/// The segments lie too close together.
pub(crate) fn first_pair(
    segments: &[Segment],
    touch: f64,
    meet: impl Fn(usize, usize) -> bool,
) -> Result<Option<(usize, usize)>, TooDense> {
    let nearby = Nearby::new(segments, touch);
    for (j, &segment) in segments.iter().enumerate() {
        let before = nearby.of(segment)?.into_iter().take_while(|&i| i < j);
        if let Some(i) = before.into_iter().find(|&i| meet(i, j)) {
            return Ok(Some((i, j)));
        }
    }
    Ok(None)
}

#[cfg(test)]
mod tests {
    use ppum::vec2::vec2;

    use super::*;
    use ppum_testkit::random::Random;

    fn random_segments(n: usize, random: &mut Random) -> Vec<Segment> {
        let mut point = || vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
        (0..n)
            .map(|_| {
                let a = point();
                [a, a + point() * 0.2]
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
                let near = |other: Segment| ppum::segment::gap(segment, other) <= touch;
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
            let meet = |i: usize, j: usize| ppum::segment::gap(segments[i], segments[j]) <= 1e-9;
            let all = (0..n).flat_map(|j| (0..j).map(move |i| (i, j))).find(|&(i, j)| meet(i, j));
            assert_eq!(first_pair(&segments, 1e-9, meet), Ok(all), "{n}");
        }
    }

    /// Parallel diagonals: all boxes overlap, no two segments touch.
    #[test]
    fn segments_without_end_are_refused_soon() {
        let diagonal = |k: u32| {
            let shift = vec2(f64::from(k) * 1e-6, 0.0);
            [vec2(-1.0, -1.0) + shift, vec2(1.0, 1.0) + shift]
        };
        let segments: Vec<_> = (0..20_000).map(diagonal).collect();
        assert_eq!(first_pair(&segments, 1e-9, |_, _| false), Err(TooDense));
    }
}
