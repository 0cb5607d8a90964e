//! Uniform covers: patches of one size on a lattice, found without a search.
//!
//! A bin between four centres is met by their patches only, as long as they reach less than two
//! cells far (α < 2), and where a pixel lies in it says which of them cover it.

use ppum::dataset::BoxPartition;
use ppum::vec2::{Rect, Vec2, vec2};

use super::bins::Bins;

/// In place of the address of a patch that there is not: outside the domain, in a hole.
pub(crate) const NO_PATCH: u32 = u32::MAX;

/// Part of a cell by which centres may miss the lattice: f64 makes them from borders of cells.
const ROUNDING: f64 = 1e-9;

/// The lattice of a uniform cover.
#[derive(Clone, Debug)]
pub(crate) struct CoverLattice {
    /// The centre of column 0 and row 0.
    origin: Vec2,
    /// From centre to centre.
    pitch: Vec2,
    /// Half-extent of all patches.
    pub(crate) half: Vec2,
    /// Columns and rows.
    size: [u32; 2],
    /// The patch of each place, row by row.
    patches: Vec<u32>,
}

impl CoverLattice {
    /// The lattice of a partition; none if patches differ in size, cells do not lie in columns and
    /// rows, or polynomials have frames of their own.
    pub(crate) fn from_partition(partition: &BoxPartition) -> Option<Self> {
        let (pitch, half) = (partition.cell.first()?.size(), *partition.half.first()?);
        let alike = |&other: &Vec2| near(other.x, half.x) && near(other.y, half.y);
        let reaches_far = half.x >= pitch.x || half.y >= pitch.y;
        if reaches_far || !partition.half.iter().all(alike) {
            return None;
        }
        let corner = partition.center.iter().copied().reduce(Vec2::min)?;
        let opposite = partition.center.iter().copied().reduce(Vec2::max)?;
        let place = |center: Vec2| {
            let (x, y) = ((center.x - corner.x) / pitch.x, (center.y - corner.y) / pitch.y);
            let on = (x - x.round()).abs() < ROUNDING && (y - y.round()).abs() < ROUNDING;
            on.then_some([x.round() as usize, y.round() as usize])
        };
        let [columns, rows] = place(opposite)?.map(|last| last + 1);
        // a few cells far apart are no lattice worth its table
        if columns.saturating_mul(rows) > 4 * partition.len() + 64 {
            return None;
        }
        let mut patches = vec![NO_PATCH; columns * rows];
        for (index, &center) in (0..).zip(&partition.center) {
            let [column, row] = place(center)?;
            let patch = &mut patches[row * columns + column];
            if *patch != NO_PATCH {
                return None;
            }
            *patch = index;
        }
        let size = [columns as u32, rows as u32];
        Some(Self { origin: corner, pitch, half, size, patches })
    }

    /// The bins over a region, each between four centres.
    pub(crate) fn bins(&self, bounds: Rect, anchor: Vec2) -> Bins {
        let origin = self.origin - anchor;
        let first = |low: f64, origin: f64, pitch: f64| ((low - origin) / pitch).floor();
        let (i, j) = (
            first(bounds.min.x, origin.x, self.pitch.x),
            first(bounds.min.y, origin.y, self.pitch.y),
        );
        let count = |high: f64, origin: f64, pitch: f64, first: f64| {
            ((high - origin) / pitch - first).floor().max(0.0) as u32 + 1
        };
        let size = [
            count(bounds.max.x, origin.x, self.pitch.x, i),
            count(bounds.max.y, origin.y, self.pitch.y, j),
        ];
        let origin = vec2(origin.x + i * self.pitch.x, origin.y + j * self.pitch.y);
        Bins { origin, pitch: self.pitch, size, ..Bins::default() }
    }

    /// The nodes of bins: the addresses of four patches each.
    pub(crate) fn nodes(&self, bins: &Bins, anchor: Vec2, bodies: &[u32]) -> Vec<u32> {
        let shift = bins.origin - (self.origin - anchor);
        let first = [shift.x / self.pitch.x, shift.y / self.pitch.y].map(|at| at.round() as i64);
        let [columns, rows] = bins.size.map(i64::from);
        let at = |i: i64, j: i64| {
            let [nx, ny] = self.size.map(i64::from);
            if !(0..nx).contains(&i) || !(0..ny).contains(&j) {
                return NO_PATCH;
            }
            let patch = self.patches[(j * nx + i) as usize];
            bodies.get(patch as usize).copied().unwrap_or(NO_PATCH)
        };
        let corners = |i: i64, j: i64| [at(i, j), at(i + 1, j), at(i, j + 1), at(i + 1, j + 1)];
        let all = (0..rows).flat_map(|j| (0..columns).map(move |i| (first[0] + i, first[1] + j)));
        all.flat_map(|(i, j)| corners(i, j)).collect()
    }
}

/// Equal except for rounding.
fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= ROUNDING * b.abs()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::cover::Cover;
    use ppum::weight::WeightFunction;
    use ppum_testkit::random::Random;

    const DOMAIN: Rect = Rect::new(vec2(-0.3, 0.1), vec2(1.1, 1.3));

    fn partition(cover: &Cover) -> BoxPartition {
        cover.partition(1.3, WeightFunction::Linear).expect("an overlap")
    }

    #[test]
    fn uniform_covers_are_lattices_and_others_are_not() {
        let mut cover = Cover::grid(DOMAIN, [7, 6]).expect("a grid");
        assert_eq!(CoverLattice::from_partition(&partition(&cover)).map(|l| l.size), Some([7, 6]));
        cover.refine_leaves(&[3]).expect("a cover");
        assert!(CoverLattice::from_partition(&partition(&cover)).is_none());
    }

    /// The four patches of a bin are all that cover a point of it.
    #[test]
    fn bins_hold_all_that_cover() {
        let partition = partition(&Cover::uniform(DOMAIN, 3).expect("a cover"));
        let lattice = CoverLattice::from_partition(&partition).expect("a lattice");
        let bodies: Vec<u32> = (0..partition.len() as u32).map(|k| 10 * k).collect();
        let anchor = vec2(0.4, 0.7);
        let small = Rect::around(vec2(0.05, -0.11), vec2(0.2, 0.01));
        for bounds in [Rect::new(DOMAIN.min - anchor, DOMAIN.max - anchor), small] {
            let bins = lattice.bins(bounds, anchor);
            let nodes = lattice.nodes(&bins, anchor, &bodies);
            let mut random = Random(4);
            for _ in 0..2000 {
                let p = random.point(&bounds);
                let d = p - bins.origin;
                let (i, j) = ((d.x / bins.pitch.x) as usize, (d.y / bins.pitch.y) as usize);
                let node = &nodes[4 * (j * bins.size[0] as usize + i)..][..4];
                for patch in
                    (0..partition.len()).filter(|&k| partition.support(k).contains(p + anchor))
                {
                    assert!(node.contains(&(10 * patch as u32)), "patch {patch} at {p:?}");
                }
            }
        }
    }
}
