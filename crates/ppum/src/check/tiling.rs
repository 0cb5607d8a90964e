//! The cells of a partition tile the box of the domain; where holes are, cells may be missing.
//!
//! A line sweeps over the box from left to right. What it crosses is a list of intervals in y, each of a cell or
//! of a gap, and it changes only where a cell begins or ends: O(n log n) for n cells.

use std::collections::BTreeMap;

use super::{Checked, fail};
use crate::dataset::Partition;
use crate::domain::{Domain, Hole};
use crate::vec2::{Rect, Vec2, vec2};

/// Borders nearer to each other than this part of the box are one: rounding. The smallest cells of a cover are
/// 2⁻³⁰ of its largest.
const ROUNDING: f64 = 1e-12;

/// Most circles and sides of holes that are looked at for the gaps of a partition, the largest gaps first.
const LOOKS: usize = 1 << 26;

/// Places of a gap that are looked at in each direction, as parts of its size.
const PLACES: [f64; 3] = [1.0 / 16.0, 0.5, 15.0 / 16.0];

/// Farthest a place of a gap may lie beside a hole, as part of the gap's size: rims belong to the domain.
const BESIDE: f64 = 1e-9;

/// Checks that cells, which are boxes, lie in the domain's box, do not overlap, and leave no gap beside holes.
pub(super) fn check(partition: &Partition, domain: &Domain) -> Checked {
    let (cells, bounds) = (&partition.cell, &domain.bounds);
    let x = Borders::new(cells, bounds, |p| p.x);
    let y = Borders::new(cells, bounds, |p| p.y);
    let mut sweep =
        Sweep::new(x.index(bounds.min.x), [y.index(bounds.min.y), y.index(bounds.max.y)]);
    let mut rows = Vec::with_capacity(cells.len());
    let mut events = Vec::with_capacity(2 * cells.len());
    for (k, cell) in cells.iter().enumerate() {
        let [columns, these] = [x.ends(cell), y.ends(cell)];
        if columns[0] == columns[1] || these[0] == these[1] {
            return wrong(k, cell, "is thinner than the rounding of its corners");
        }
        if !(x.hold(columns, bounds) && y.hold(these, bounds)) {
            return wrong(k, cell, "reaches out of the domain's box");
        }
        rows.push(these);
        events.extend([(columns[0], true, k as u32), (columns[1], false, k as u32)]);
    }
    // of those at one place cells that end come first
    events.sort_unstable();
    for (at, begins, k) in events {
        if !begins {
            sweep.end(at, rows[k as usize]);
        } else if !sweep.begin(at, rows[k as usize]) {
            return wrong(k as usize, &cells[k as usize], "overlaps another cell");
        }
    }
    let gaps = sweep.gaps(x.index(bounds.max.x)).into_iter();
    let rect =
        |[x0, y0, x1, y1]: [u32; 4]| Rect::new(vec2(x.at(x0), y.at(y0)), vec2(x.at(x1), y.at(y1)));
    check_gaps(gaps.map(rect).collect(), &domain.holes)
}

fn wrong(index: usize, cell: &Rect, mistake: &str) -> Checked {
    fail(&format!("cell[{index}]"), format!("{} {mistake}", corners(cell)))
}

fn corners(b: &Rect) -> String {
    format!("({}, {}) to ({}, {})", b.min.x, b.min.y, b.max.x, b.max.y)
}

/// The borders of cells and of the box in one direction, increasing; those that rounding parts are one.
struct Borders {
    places: Vec<f64>,
    along: fn(Vec2) -> f64,
}

impl Borders {
    fn new(cells: &[Rect], bounds: &Rect, along: fn(Vec2) -> f64) -> Self {
        let corners = cells.iter().chain([bounds]).flat_map(|b| [b.min, b.max]);
        let mut places: Vec<f64> = corners.map(along).collect();
        let (from, to) = (along(bounds.min), along(bounds.max));
        let near = ROUNDING * (to - from) + f64::EPSILON * from.abs().max(to.abs());
        places.sort_unstable_by(f64::total_cmp);
        places.dedup_by(|next, kept| *next - *kept <= near);
        Self { places, along }
    }

    /// The last border at a place or before it.
    fn index(&self, place: f64) -> u32 {
        self.places.partition_point(|&p| p <= place).saturating_sub(1) as u32
    }

    fn at(&self, index: u32) -> f64 {
        self.places[index as usize]
    }

    fn ends(&self, b: &Rect) -> [u32; 2] {
        [b.min, b.max].map(|p| self.index((self.along)(p)))
    }

    fn hold(&self, [from, to]: [u32; 2], bounds: &Rect) -> bool {
        let [first, last] = self.ends(bounds);
        first <= from && to <= last
    }
}

/// The cells and gaps that a line parallel to the y axis crosses, as it moves to the right.
struct Sweep {
    /// Intervals that follow each other, by their lower ends.
    line: BTreeMap<u32, Interval>,
    /// Rectangles that no cell covers.
    gaps: Vec<[u32; 4]>,
}

#[derive(Clone, Copy)]
struct Interval {
    end: u32,
    /// The beginning of the gap; none of a cell.
    gap: Option<u32>,
}

impl Sweep {
    fn new(at: u32, [from, to]: [u32; 2]) -> Self {
        let line = BTreeMap::from([(from, Interval { end: to, gap: Some(at) })]);
        Self { line, gaps: Vec::new() }
    }

    /// A cell ends: a gap begins, if only of no width.
    fn end(&mut self, at: u32, [from, to]: [u32; 2]) {
        self.line.insert(from, Interval { end: to, gap: Some(at) });
    }

    /// A cell begins: the gaps before it end. False if there is a cell.
    fn begin(&mut self, at: u32, [from, to]: [u32; 2]) -> bool {
        let mut place = from;
        while place < to {
            let found = self.line.range(..=place).next_back();
            let Some((&start, &Interval { end, gap: Some(since) })) = found else { return false };
            self.line.remove(&start);
            let gap = Some(since);
            if start < place {
                self.line.insert(start, Interval { end: place, gap });
            }
            if to < end {
                self.line.insert(to, Interval { end, gap });
            }
            let until = end.min(to);
            self.leave([since, place, at, until]);
            place = until;
        }
        self.line.insert(from, Interval { end: to, gap: None });
        true
    }

    fn leave(&mut self, gap: [u32; 4]) {
        if gap[0] < gap[2] {
            self.gaps.push(gap);
        }
    }

    /// All gaps, up to where the box ends.
    fn gaps(mut self, at: u32) -> Vec<[u32; 4]> {
        for (from, interval) in std::mem::take(&mut self.line) {
            self.leave([interval.gap.unwrap_or(at), from, at, interval.end]);
        }
        self.gaps
    }
}

fn check_gaps(mut gaps: Vec<Rect>, holes: &[Hole]) -> Checked {
    let area = |gap: &Rect| gap.size().x * gap.size().y;
    gaps.sort_by(|a, b| area(b).total_cmp(&area(a)));
    let rims = holes.iter().map(|hole| hole.sides().count().max(1)).sum::<usize>();
    let looks = rims * PLACES.len() * PLACES.len();
    for gap in gaps.iter().take(LOOKS / looks.max(1)) {
        if let Some(p) = place_beside(gap, holes) {
            let mistake = format!(
                "none covers {}, where ({}, {}) is in no hole; cells tile the domain's box, but for \
                 those in holes",
                corners(gap),
                p.x,
                p.y
            );
            return fail("cell", mistake);
        }
    }
    Ok(())
}

/// A place of a gap that lies in no hole and on no rim.
fn place_beside(gap: &Rect, holes: &[Hole]) -> Option<Vec2> {
    let (corner, size) = (gap.min, gap.size());
    let near = BESIDE * size.x.max(size.y);
    let places = PLACES.iter().flat_map(|j| PLACES.map(|i| corner + vec2(i * size.x, j * size.y)));
    let is_in = |hole: &Hole, p: Vec2| hole.contains(p) || hole.rim_distance(p) <= near;
    places.into_iter().find(|&p| !holes.iter().any(|hole| is_in(hole, p)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cover::Cover;
    use crate::weight::WeightFunction;
    use ppum_testkit::random::Random;

    const BOX: Rect = Rect::new(vec2(-1.0, 0.1), vec2(2.0, 1.6));

    /// A random graded cover of the box.
    fn cover(seed: u64) -> Partition {
        let mut random = Random(seed);
        let mut cover = Cover::grid(BOX, [3, 2]).expect("a grid");
        for _ in 0..4 {
            cover.refine(|_, _| random.unit() < 0.3).expect("a cover");
        }
        cover.partition(1.3, WeightFunction::Linear).expect("an overlap")
    }

    fn mistake(partition: &Partition, holes: Vec<Hole>) -> Option<String> {
        check(partition, &Domain { bounds: BOX, holes }).err().map(|error| error.to_string())
    }

    fn without(mut partition: Partition, cell: usize) -> Partition {
        partition.cell.remove(cell);
        partition
    }

    #[test]
    fn covers_tile() {
        for seed in 0..50 {
            let mut partition = cover(seed);
            assert_eq!(mistake(&partition, vec![]), None, "seed {seed}");
            partition.cell.reverse();
            let ulp = |x: f64| x + f64::EPSILON * x;
            for cell in partition.cell.iter_mut().step_by(2) {
                *cell = Rect::new(cell.min, vec2(ulp(cell.max.x), ulp(cell.max.y)));
            }
            assert_eq!(mistake(&partition, vec![]), None, "rounded, seed {seed}");
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
                mistake(&partition, vec![]).expect("found")
            };
            let gone = mistake(&without(good.clone(), k), vec![]).expect("found");
            let numbers = gone.split(['(', ',', ')']).filter_map(|part| part.trim().parse().ok());
            let found: Vec<f64> = numbers.collect();
            // the gap, or a part of it beside a smaller neighbour, and a place in it
            let places: Vec<Vec2> = found.as_chunks::<2>().0.iter().map(|&p| p.into()).collect();
            let inside = places.iter().all(|&p| cell.distance(p) < 1e-9);
            assert!(gone.starts_with("cell: none covers") && places.len() == 3 && inside, "{gone}");
            for (mistake, text) in [
                (changed(|c, q| c.max.x -= q.x), "none covers"),
                (changed(|c, q| c.min.y += q.y), "none covers"),
                (changed(|c, _| *c = Rect::new(c.min + BOX.size(), c.max + BOX.size())), "out of"),
                (changed(|c, _| c.max.x = c.min.x + 1e-14), "thinner"),
            ] {
                assert!(mistake.contains(text), "{mistake}");
            }
            let larger = changed(|c, q| c.max.y += q.y);
            assert!(larger.contains("overlaps") || larger.contains("out of"), "{larger}");
            let mut twice = good.clone();
            twice.cell.push(cell);
            assert!(mistake(&twice, vec![]).expect("found").contains("overlaps"));
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
                assert_eq!(mistake(&partition, round(half.length())), None);
                assert!(mistake(&partition, round(0.8 * half.x.min(half.y))).is_some());
                let [left, right] = [-1.0, 1.0].map(|side| {
                    let corners = [[0.0, -1.0], [side, -1.0], [side, 1.0], [0.0, 1.0]];
                    let points = corners.map(|[x, y]| center + vec2(x * half.x, y * half.y));
                    Hole::Polygon { points: points.to_vec() }
                });
                assert_eq!(mistake(&partition, vec![left.clone(), right]), None, "two halves");
                assert!(mistake(&partition, vec![left]).is_some(), "one half");
            }
        }
    }
}
