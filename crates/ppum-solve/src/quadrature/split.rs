//! Rectangles on which the partition functions are smooth.

use ppum::dataset::BoxPartition;
use ppum::vec2::{Rect, Vec2};

/// Lengths below this part of a cell are rounding.
pub(super) const TOLERANCE: f64 = 1e-12;

/// Splits a cell into rectangles with a constant set of covering patches and no kink of their
/// partition functions, each of these where several patches meet into `parts` in every direction in
/// which the functions vary, and hands each rectangle with its patches to `visit`.
pub(super) fn rectangles(
    partition: &BoxPartition,
    parts: usize,
    cell: &Rect,
    covering_patches: &[u32],
    visit: &mut dyn FnMut(&Rect, &[u32]),
) {
    let size = cell.size();
    let splitter = Splitter { partition, parts, tolerance: TOLERANCE * size.x.min(size.y) };
    splitter.constant_sets(cell, covering_patches, visit);
}

struct Splitter<'a> {
    partition: &'a BoxPartition,
    parts: usize,
    tolerance: f64,
}

/// A line x = at (axis 0) or y = at (axis 1).
struct SplitLine {
    axis: usize,
    at: f64,
    /// Part of the rectangle's extent over which it is a boundary of a patch.
    share: f64,
}

impl Splitter<'_> {
    fn constant_sets(&self, rect: &Rect, patches: &[u32], visit: &mut dyn FnMut(&Rect, &[u32])) {
        let inside = |r: &Rect| -> Vec<u32> {
            let meets = |&i: &u32| self.partition.support(i as usize).overlaps(r);
            patches.iter().copied().filter(meets).collect()
        };
        if let Some(line) = self.main_boundary(rect, patches) {
            for half in cut_at(rect, line.axis, line.at) {
                self.constant_sets(&half, &inside(&half), visit);
            }
        } else {
            let center = rect.center();
            self.kinks(rect, &inside(&Rect::new(center, center)), visit);
        }
    }

    /// The patch boundary that runs through the largest part of the rectangle: cutting along it
    /// first leaves the fewest rectangles.
    fn main_boundary(&self, rect: &Rect, patches: &[u32]) -> Option<SplitLine> {
        let mut lines = self.boundaries(rect, patches);
        lines.sort_by(|a, b| a.axis.cmp(&b.axis).then(a.at.total_cmp(&b.at)));
        lines.dedup_by(|next, kept| {
            let same = next.axis == kept.axis && next.at - kept.at <= self.tolerance;
            if same {
                kept.share += next.share;
            }
            same
        });
        lines.into_iter().reduce(|best, line| if line.share > best.share { line } else { best })
    }

    fn boundaries(&self, rect: &Rect, patches: &[u32]) -> Vec<SplitLine> {
        let size = rect.size();
        let mut lines = Vec::new();
        for &patch in patches {
            let support = self.partition.support(patch as usize);
            let common = support.intersection(rect).size();
            for axis in 0..2 {
                let share = component(common, 1 - axis) / component(size, 1 - axis);
                for at in [component(support.min, axis), component(support.max, axis)] {
                    if self.crosses(rect, axis, at) {
                        lines.push(SplitLine { axis, at, share });
                    }
                }
            }
        }
        lines
    }

    fn crosses(&self, rect: &Rect, axis: usize, at: f64) -> bool {
        at - component(rect.min, axis) > self.tolerance
            && component(rect.max, axis) - at > self.tolerance
    }

    fn kinks(&self, rect: &Rect, patches: &[u32], visit: &mut dyn FnMut(&Rect, &[u32])) {
        let [xs, ys] = [0, 1].map(|axis| {
            let kinks = kinks(self.partition, patches, axis);
            let ends = (component(rect.min, axis), component(rect.max, axis));
            let breaks = breaks(ends.0, ends.1, kinks, self.tolerance);
            let varies = varies(self.partition, patches, axis);
            if varies { divided(breaks, self.parts) } else { breaks }
        });
        for y in ys.windows(2) {
            for x in xs.windows(2) {
                let part = Rect::new(Vec2 { x: x[0], y: y[0] }, Vec2 { x: x[1], y: y[1] });
                visit(&part, patches);
            }
        }
    }
}

/// The parts of a rectangle below and above a coordinate along an axis.
pub(super) fn cut_at(rect: &Rect, axis: usize, at: f64) -> [Rect; 2] {
    let (mut low, mut high) = (*rect, *rect);
    match axis {
        0 => (low.max.x, high.min.x) = (at, at),
        _ => (low.max.y, high.min.y) = (at, at),
    }
    [low, high]
}

/// x for axis 0, y for axis 1.
pub(super) fn component(v: Vec2, axis: usize) -> f64 {
    if axis == 0 { v.x } else { v.y }
}

/// Centre and half-extent of a patch along an axis.
fn frame(partition: &BoxPartition, patch: u32, axis: usize) -> (f64, f64) {
    let i = patch as usize;
    (component(partition.center[i], axis), component(partition.half[i], axis))
}

/// False if the patches agree in centre and half-extent along the axis (a single patch does): the
/// factors w then cancel in W_i / Σ W_l, kinks and all.
pub(super) fn varies(partition: &BoxPartition, patches: &[u32], axis: usize) -> bool {
    let same =
        |a: (f64, f64), b: (f64, f64)| (a.0 - b.0).abs().max((a.1 - b.1).abs()) <= TOLERANCE * a.1;
    let frame = |patch| frame(partition, patch, axis);
    patches.windows(2).any(|pair| !same(frame(pair[0]), frame(pair[1])))
}

/// Coordinates along an axis at which the partition functions of these patches have kinks inside
/// their supports; none if they do not vary along it.
pub(super) fn kinks(partition: &BoxPartition, patches: &[u32], axis: usize) -> Vec<f64> {
    if !varies(partition, patches, axis) {
        return Vec::new();
    }
    let at = partition.weight.breakpoints();
    let both = |(c, h)| at.iter().flat_map(move |t| [c - t * h, c + t * h]);
    patches.iter().flat_map(|&patch| both(frame(partition, patch, axis))).collect()
}

/// Each interval between ascending `breaks` divided into equal parts.
pub(super) fn divided(breaks: Vec<f64>, parts: usize) -> Vec<f64> {
    let part = |k: usize, ends: &[f64]| ends[0] + (ends[1] - ends[0]) * (k as f64 / parts as f64);
    let inner = breaks.windows(2).flat_map(|ends| (0..parts).map(move |k| part(k, ends)));
    let last = breaks.last().copied();
    inner.chain(last).collect()
}

/// `lo`, the sorted distinct `points` between, and `hi`.
pub(super) fn breaks(lo: f64, hi: f64, mut points: Vec<f64>, tolerance: f64) -> Vec<f64> {
    points.retain(|&x| x - lo > tolerance && hi - x > tolerance);
    points.extend([lo, hi]);
    points.sort_by(f64::total_cmp);
    points.dedup_by(|next, kept| *next != hi && *next - *kept <= tolerance);
    points
}
