//! The cells of a partition tile the box of the domain; where holes are, cells may be missing.
//!
//! A line sweeps over the box from left to right. At any place it crosses a list of intervals in y,
//! each of a cell or of a gap, and the list changes only where a cell begins or ends: linear in n
//! cells, except for the sorting of the different edge coordinates.

use super::errors::{CheckError, CheckResult, fail};
use super::marks::Marks;
use super::ranks::{Ranks, in_order};
use crate::dataset::BoxPartition;
use crate::domain::{Domain, Hole};
use crate::vec2::{Rect, Vec2, vec2};

/// Edges of cells nearer to each other than this part of the box count as one: rounding. The
/// smallest cells of a cover are 2⁻³⁰ of its largest.
const ROUNDING: f64 = 1e-12;

/// Most circles and sides of holes that are looked at for the gaps of a partition, the largest
/// gaps first.
const LOOKS: usize = 1 << 26;

/// Places of a gap that are looked at in each direction, as parts of its size.
const PLACES: [f64; 3] = [1.0 / 16.0, 0.5, 15.0 / 16.0];

/// Farthest a place of a gap may lie beside a hole, as part of the gap's size: rims belong to
/// the domain.
const BESIDE: f64 = 1e-9;

/// Checks that cells, which are boxes, lie in the domain's box, do not overlap, and leave no gap
/// beside holes.
pub(super) fn check(partition: &BoxPartition, domain: &Domain) -> CheckResult {
    let layout = CellBorders::new(&partition.cell, &domain.bounds)?;
    if layout.covers_once() {
        return Ok(());
    }
    match layout.gaps() {
        Ok(gaps) => {
            check_gaps(gaps.into_iter().map(|gap| layout.rect(gap)).collect(), &domain.holes)
        }
        Err(k) => wrong(k, &partition.cell[k], "overlaps another cell"),
    }
}

/// The rectangles of the domain's box that no cell of a tiling covers.
pub(super) fn gaps(partition: &BoxPartition, domain: &Domain) -> Vec<Rect> {
    let layout = CellBorders::new(&partition.cell, &domain.bounds).ok();
    let found = layout.filter(|layout| !layout.covers_once());
    let rects = found.and_then(|layout| {
        let gaps = layout.gaps().ok()?;
        Some(gaps.into_iter().map(|gap| layout.rect(gap)).collect())
    });
    rects.unwrap_or_default()
}

/// Cells by the numbers of their boundaries.
struct CellBorders {
    x: Borders,
    y: Borders,
    extents: Vec<CellExtent>,
}

/// The numbers of a cell's first and last boundary in each direction.
struct CellExtent {
    columns: [u32; 2],
    rows: [u32; 2],
}

/// Most intervals between boundaries, as multiples of the number of cells, that are marked one by
/// one.
const MARKED: u64 = 64;

impl CellBorders {
    fn new(cells: &[Rect], bounds: &Rect) -> Result<Self, CheckError> {
        let x = Borders::new(cells, bounds, |p| p.x);
        let y = Borders::new(cells, bounds, |p| p.y);
        let mut extents = Vec::with_capacity(cells.len());
        for (k, cell) in cells.iter().enumerate() {
            let extent = CellExtent { columns: x.ends(cell), rows: y.ends(cell) };
            if [extent.columns, extent.rows].iter().any(|[from, to]| from == to) {
                wrong(k, cell, "is thinner than the rounding of its corners")?;
            }
            if !(x.hold(extent.columns) && y.hold(extent.rows)) {
                wrong(k, cell, "reaches out of the domain's box")?;
            }
            extents.push(extent);
        }
        Ok(Self { x, y, extents })
    }

    fn rect(&self, [x0, y0, x1, y1]: [u32; 4]) -> Rect {
        Rect::new(vec2(self.x.at(x0), self.y.at(y0)), vec2(self.x.at(x1), self.y.at(y1)))
    }

    /// True if each interval between two edge coordinates in both directions is covered once.
    /// False, untested, for covers with many different ones.
    fn covers_once(&self) -> bool {
        let [width, height] = [&self.x, &self.y].map(Borders::intervals);
        let all = width * height;
        let covered = self.extents.iter().map(CellExtent::intervals).fold(0, u64::saturating_add);
        if covered != all || all > MARKED * self.extents.len() as u64 {
            return false;
        }
        let mut marks = vec![false; all as usize];
        self.extents.iter().all(|extent| self.mark(extent, &mut marks, width as usize))
    }

    /// Marks what a cell covers; false if some of it is marked already.
    fn mark(&self, extent: &CellExtent, marks: &mut [bool], width: usize) -> bool {
        let [left, right] = extent.columns.map(|column| (column - self.x.bounds[0]) as usize);
        let [below, above] = extent.rows.map(|row| (row - self.y.bounds[0]) as usize);
        marks.chunks_exact_mut(width).take(above).skip(below).all(|row| {
            let is_free = !row[left..right].contains(&true);
            row[left..right].fill(true);
            is_free
        })
    }

    /// Returns the boxes that no cell covers, or a cell that overlaps another as an error.
    fn gaps(&self) -> Result<Vec<[u32; 4]>, usize> {
        let Self { x, y, extents } = self;
        // of those at one coordinate cells that end come first
        let keys = extents.iter().flat_map(|extent| {
            let [begin, end] = extent.columns;
            [2 * begin + 1, 2 * end]
        });
        let mut sweep = Sweep::new(x.bounds[0], y.bounds, y.ranks.len());
        for event in in_order(keys, 2 * x.ranks.len()) {
            let CellExtent { columns, rows } = &extents[event as usize / 2];
            if event % 2 == 1 {
                sweep.end(columns[1], *rows);
            } else if !sweep.begin(columns[0], *rows) {
                return Err(event as usize / 2);
            }
        }
        Ok(sweep.gaps(x.bounds[1]))
    }
}

impl CellExtent {
    fn intervals(&self) -> u64 {
        let [width, height] = [self.columns, self.rows].map(|[from, to]| u64::from(to - from));
        width * height
    }
}

fn wrong(index: usize, cell: &Rect, message: &str) -> CheckResult {
    fail(&format!("cell[{index}]"), format!("{} {message}", corners(cell)))
}

fn corners(b: &Rect) -> String {
    format!("({}, {}) to ({}, {})", b.min.x, b.min.y, b.max.x, b.max.y)
}

/// The boundaries of cells and of the box in one direction, increasing; those that rounding parts
/// are one.
struct Borders {
    ranks: Ranks,
    /// Those of the box.
    bounds: [u32; 2],
    along: fn(Vec2) -> f64,
}

impl Borders {
    fn new(cells: &[Rect], bounds: &Rect, along: fn(Vec2) -> f64) -> Self {
        let corners = cells.iter().chain([bounds]).flat_map(|b| [b.min, b.max]);
        let (from, to) = (along(bounds.min), along(bounds.max));
        let near = ROUNDING * (to - from) + f64::EPSILON * from.abs().max(to.abs());
        let mut borders =
            Self { ranks: Ranks::new(corners.map(along), near), bounds: [0; 2], along };
        borders.bounds = borders.ends(bounds);
        borders
    }

    fn at(&self, index: u32) -> f64 {
        self.ranks.at(index)
    }

    /// Intervals between the boundaries in the box.
    fn intervals(&self) -> u64 {
        u64::from(self.bounds[1] - self.bounds[0])
    }

    /// The last boundaries at the ends of a cell or before them.
    fn ends(&self, b: &Rect) -> [u32; 2] {
        [b.min, b.max].map(|p| self.ranks.up_to((self.along)(p)).saturating_sub(1))
    }

    fn hold(&self, [from, to]: [u32; 2]) -> bool {
        self.bounds[0] <= from && to <= self.bounds[1]
    }
}

/// The cells and gaps that a line parallel to the y axis crosses, as it moves to the right.
struct Sweep {
    /// Intervals that follow each other, each at its lower end, and marks where one begins.
    line: Vec<BorderInterval>,
    starts: Marks,
    /// Rectangles that no cell covers.
    gaps: Vec<[u32; 4]>,
}

#[derive(Clone, Copy)]
struct BorderInterval {
    end: u32,
    /// The beginning of the gap; none of a cell.
    gap: Option<u32>,
}

impl Sweep {
    fn new(at: u32, [from, to]: [u32; 2], borders: usize) -> Self {
        let line = vec![BorderInterval { end: to, gap: Some(at) }; borders];
        let mut starts = Marks::new(borders);
        starts.set(from);
        Self { line, starts, gaps: Vec::new() }
    }

    fn put(&mut self, start: u32, interval: BorderInterval) {
        self.line[start as usize] = interval;
        self.starts.set(start);
    }

    /// A cell ends: a gap begins, if only of no width.
    fn end(&mut self, at: u32, [from, to]: [u32; 2]) {
        self.put(from, BorderInterval { end: to, gap: Some(at) });
    }

    /// A cell begins: the gaps before it end. False if there is a cell.
    fn begin(&mut self, at: u32, [from, to]: [u32; 2]) -> bool {
        let mut extent = from;
        while extent < to {
            let Some(start) = self.starts.last_up_to(extent) else { return false };
            let BorderInterval { end, gap: Some(since) } = self.line[start as usize] else {
                return false;
            };
            self.starts.clear(start);
            let gap = Some(since);
            if start < extent {
                self.put(start, BorderInterval { end: extent, gap });
            }
            if to < end {
                self.put(to, BorderInterval { end, gap });
            }
            let until = end.min(to);
            self.leave([since, extent, at, until]);
            extent = until;
        }
        self.put(from, BorderInterval { end: to, gap: None });
        true
    }

    fn leave(&mut self, gap: [u32; 4]) {
        if gap[0] < gap[2] {
            self.gaps.push(gap);
        }
    }

    /// All gaps, up to where the box ends, where no cell is left.
    fn gaps(mut self, at: u32) -> Vec<[u32; 4]> {
        for from in 0..self.line.len() as u32 {
            if self.starts.last_up_to(from) == Some(from) {
                let BorderInterval { end, gap } = self.line[from as usize];
                self.leave([gap.unwrap_or(at), from, at, end]);
            }
        }
        self.gaps
    }
}

/// Most gaps that are looked at.
pub(super) fn most_gaps(holes: &[Hole]) -> usize {
    let rims = holes.iter().map(|hole| hole.sides().count().max(1)).sum::<usize>();
    LOOKS / (rims * PLACES.len() * PLACES.len()).max(1)
}

fn check_gaps(mut gaps: Vec<Rect>, holes: &[Hole]) -> CheckResult {
    let area = |gap: &Rect| gap.size().x * gap.size().y;
    gaps.sort_by(|a, b| area(b).total_cmp(&area(a)));
    for gap in gaps.iter().take(most_gaps(holes)) {
        if let Some(p) = place_beside(gap, holes) {
            let message = format!(
                "none covers {}, where ({}, {}) is in no hole; cells tile the domain's box, but for \
                 those in holes",
                corners(gap),
                p.x,
                p.y
            );
            return fail("cell", message);
        }
    }
    Ok(())
}

/// A place of a gap that lies in no hole and on no rim.
pub(super) fn place_beside(gap: &Rect, holes: &[Hole]) -> Option<Vec2> {
    let (corner, size) = (gap.min, gap.size());
    let near = BESIDE * size.x.max(size.y);
    let extents = PLACES.iter().flat_map(|j| PLACES.map(|i| corner + vec2(i * size.x, j * size.y)));
    let is_in = |hole: &Hole, p: Vec2| hole.contains(p) || hole.rim_distance(p) <= near;
    extents.into_iter().find(|&p| !holes.iter().any(|hole| is_in(hole, p)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cover::Cover;
    use crate::weight::WeightFunction;
    use ppum_testkit::random::Random;

    const BOX: Rect = Rect::new(vec2(-1.0, 0.1), vec2(2.0, 1.6));

    /// A random graded cover of the box.
    fn cover(seed: u64) -> BoxPartition {
        let mut random = Random(seed);
        let mut cover = Cover::grid(BOX, [3, 2]).expect("a grid");
        for _ in 0..4 {
            cover.refine(|_, _| random.unit() < 0.3).expect("a cover");
        }
        cover.partition(1.3, WeightFunction::Linear).expect("an overlap")
    }

    fn message(partition: &BoxPartition, holes: Vec<Hole>) -> Option<String> {
        check(partition, &Domain { bounds: BOX, holes }).err().map(|error| error.to_string())
    }

    fn without(mut partition: BoxPartition, cell: usize) -> BoxPartition {
        partition.cell.remove(cell);
        partition
    }

    #[test]
    fn covers_tile() {
        for seed in 0..50 {
            let mut partition = cover(seed);
            assert_eq!(message(&partition, vec![]), None, "seed {seed}");
            let layout = CellBorders::new(&partition.cell, &BOX).expect("cells of the box");
            assert!(layout.covers_once() && layout.gaps() == Ok(vec![]), "seed {seed}");
            partition.cell.reverse();
            let ulp = |x: f64| x + f64::EPSILON * x;
            for cell in partition.cell.iter_mut().step_by(2) {
                *cell = Rect::new(cell.min, vec2(ulp(cell.max.x), ulp(cell.max.y)));
            }
            assert_eq!(message(&partition, vec![]), None, "rounded, seed {seed}");
        }
    }

    #[test]
    fn what_is_not_covered_once_is_named() {
        let mut random = Random(7);
        for seed in 0..50 {
            let good = cover(seed);
            let k = (random.unit() * good.cell.len() as f64) as usize;
            let (cell, quarter) = (good.cell[k], good.cell[k].size() * 0.25);
            let changed = |change: fn(&mut Rect, Vec2)| {
                let mut partition = good.clone();
                change(&mut partition.cell[k], quarter);
                message(&partition, vec![]).expect("found")
            };
            let gone = message(&without(good.clone(), k), vec![]).expect("found");
            let numbers = gone.split(['(', ',', ')']).filter_map(|part| part.trim().parse().ok());
            let found: Vec<f64> = numbers.collect();
            // the gap, or a part of it beside a smaller neighbour, and a place in it
            let extents: Vec<Vec2> = found.as_chunks::<2>().0.iter().map(|&p| p.into()).collect();
            let inside = extents.iter().all(|&p| cell.distance(p) < 1e-9);
            assert!(
                gone.starts_with("cell: none covers") && extents.len() == 3 && inside,
                "{gone}"
            );
            for (message, text) in [
                (changed(|c, q| c.max.x -= q.x), "none covers"),
                (changed(|c, q| c.min.y += q.y), "none covers"),
                (changed(|c, _| *c = Rect::new(c.min + BOX.size(), c.max + BOX.size())), "out of"),
                (changed(|c, _| c.max.x = c.min.x + 1e-14), "thinner"),
            ] {
                assert!(message.contains(text), "{message}");
            }
            let larger = changed(|c, q| c.max.y += q.y);
            assert!(larger.contains("overlaps") || larger.contains("out of"), "{larger}");
            let mut twice = good.clone();
            twice.cell.push(cell);
            assert!(message(&twice, vec![]).expect("found").contains("overlaps"));
        }
    }

    /// A cell may be missing where a hole swallows it, and nowhere else.
    #[test]
    fn gaps_are_where_holes_are() {
        for seed in 0..20 {
            let good = cover(seed);
            for k in 0..good.cell.len() {
                let cell = good.cell[k];
                let (center, half) = (cell.center(), cell.size() * 0.5);
                let partition = without(good.clone(), k);
                let round = |radius| vec![Hole::Circle { center, radius }];
                assert_eq!(message(&partition, round(half.length())), None);
                assert!(message(&partition, round(0.8 * half.x.min(half.y))).is_some());
                let [left, right] = [-1.0, 1.0].map(|side| {
                    let corners = [[0.0, -1.0], [side, -1.0], [side, 1.0], [0.0, 1.0]];
                    let points = corners.map(|[x, y]| center + vec2(x * half.x, y * half.y));
                    Hole::polygon(points.to_vec())
                });
                assert_eq!(message(&partition, vec![left.clone(), right]), None, "two halves");
                assert!(message(&partition, vec![left]).is_some(), "one half");
            }
        }
    }
}
