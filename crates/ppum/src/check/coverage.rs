//! The supports of a partition cover its cells, and not just by their rims.
//!
//! Functions of the partition of unity are quotients of weights, φ = W / Σ W. Where all weights are
//! near zero, as in a thin strip that two supports share, gradients grow like 1/thickness and lose
//! digits twice; where all are zero there is no value. So each point of a cell has |s| ≤ [`CORE`]
//! for some patch, s the position in its support in units of half extents. Cells with their own
//! supports, 1.01 times as large or more, obey at once. For others a line sweeps over the plane.

use super::errors::{CheckResult, fail};
use super::line::IntervalSums;
use super::ranks::{Ranks, in_order};
use super::tiling;
use crate::dataset::BoxPartition;
use crate::domain::{Domain, Hole};
use crate::vec2::{Rect, Vec2, vec2};

/// The part of a support, in each direction, that counts as covered by it. Just more than 1/1.01,
/// the cell of the least [`OVERLAP`](crate::cover::OVERLAP) of covers.
const CORE: f64 = 0.991;

/// Checks that supports cover cells that tile the domain, or without cells the domain itself.
pub(super) fn check(partition: &BoxPartition, domain: &Domain) -> CheckResult {
    let patches = 0..partition.len();
    let core = |patch| Rect::around(partition.center[patch], partition.half[patch] * CORE);
    let holds = |(patch, cell): (usize, &Rect)| core(patch).intersection(cell) == *cell;
    if partition.has_cells() && patches.clone().zip(&partition.cell).all(holds) {
        return Ok(());
    }
    let (gaps, holes) = match partition.has_cells() {
        true => (tiling::gaps(partition, domain), &[][..]),
        false => (Vec::new(), &domain.holes[..]),
    };
    let boxes = patches.map(core).chain(gaps);
    let Some(p) = uncovered(boxes, &domain.bounds, holes) else { return Ok(()) };
    let message = format!(
        "no support holds ({}, {}) well inside, at most {CORE} of its half-extents from its centre: the \
         patches there do not overlap, or by a thin strip alone; make them larger",
        p.x, p.y
    );
    fail("half", message)
}

/// A point of the bounds that none of the closed boxes covers and no hole holds. O(n log n), and
/// O(log n) for each gap in holes.
fn uncovered(boxes: impl Iterator<Item = Rect>, bounds: &Rect, holes: &[Hole]) -> Option<Vec2> {
    let clipped = boxes.filter(|b| b.overlaps(bounds)).map(|b| b.intersection(bounds));
    let boxes: Vec<Rect> = clipped.chain([Rect::new(bounds.max, bounds.max)]).collect();
    let corners = || boxes.iter().chain([bounds]).flat_map(|b| [b.min, b.max]);
    let x = Ranks::new(corners().map(|p| p.x), 0.0);
    let y = Ranks::new(corners().map(|p| p.y), 0.0);
    let column = |at: f64| x.up_to(at) - 1;
    let row = |at: f64| y.up_to(at) as usize - 1;
    // minus the number of boxes that cover an interval between two edge coordinates; intervals
    // beyond the last do not matter
    let mut line = IntervalSums::new(y.len());
    line.add(row(bounds.max.y), y.len().next_power_of_two(), -1);
    let (mut at, mut looks) = (0, tiling::most_gaps(holes));
    for event in in_order(boxes.iter().flat_map(|b| [column(b.min.x), column(b.max.x)]), x.len()) {
        let b = &boxes[event as usize / 2];
        let [place, work] = if event % 2 == 0 { [b.min.x, -1.0] } else { [b.max.x, 1.0] };
        let next = column(place);
        let mut in_holes = Vec::new();
        while next > at && line.most() == 0 && looks > 0 {
            let below = line.place();
            let corner = |column, row: usize| vec2(x.at(column), y.at(row as u32));
            let gap = Rect::new(corner(at, below), corner(next, below + 1));
            if let Some(p) = tiling::place_beside(&gap, holes) {
                return Some(p);
            }
            line.add(below, below + 1, -1);
            in_holes.push(below);
            looks -= 1;
        }
        in_holes.into_iter().for_each(|below| line.add(below, below + 1, 1));
        at = next;
        line.add(row(b.min.y), row(b.max.y), work as i64);
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    const BOX: Rect = Rect::new(vec2(-1.0, 0.1), vec2(2.0, 1.6));

    /// Boxes of random sizes on a lattice, so that boundaries coincide, against the middles of the
    /// lattice's cells.
    #[test]
    fn what_is_uncovered_is_found() {
        let (mut random, mut covered) = (Random(3), 0);
        let bounds = Rect::new(vec2(1.0, 1.0), vec2(5.0, 4.0));
        for n in [1, 4, 10, 20, 40] {
            for _ in 0..60 {
                let mut whole = |most: f64| (random.unit() * most).floor();
                let boxes: Vec<Rect> = (0..n)
                    .map(|_| {
                        let corner = vec2(whole(6.0), whole(6.0));
                        Rect::new(corner, corner + vec2(1.0 + whole(3.0), 1.0 + whole(3.0)))
                    })
                    .collect();
                let is_covered = |p: Vec2| boxes.iter().any(|b| b.contains(p));
                let middles = (0..12).map(|k| vec2(1.5 + f64::from(k % 4), 1.5 + f64::from(k / 4)));
                let expected = middles.into_iter().all(is_covered);
                let found = uncovered(boxes.iter().copied(), &bounds, &[]);
                assert_eq!(found.is_none(), expected, "{boxes:?}");
                assert!(
                    found.is_none_or(|p| bounds.contains(p) && !is_covered(p)),
                    "{boxes:?} {found:?}"
                );
                covered += usize::from(expected);
            }
        }
        assert!((60..240).contains(&covered), "{covered}");
    }

    /// Without cells, uncovered parts may lie in holes and nowhere else.
    #[test]
    fn holes_need_no_cover() {
        let mut random = Random(5);
        for _ in 0..40 {
            let (center, half) = (vec2(0.2 + 0.6 * random.unit(), 0.8), 0.2 + 0.15 * random.unit());
            // a grid of squares without those whose centres lie near the hole's
            let place = |k: u32| BOX.min + vec2(f64::from(k % 31), f64::from(k / 31)) * 0.1;
            let is_far = |p: &Vec2| (p.x - center.x).abs().max((p.y - center.y).abs()) > half;
            let centers: Vec<Vec2> = (0..31 * 16).map(place).filter(is_far).collect();
            let mut partition = boxes(centers, 0.08);
            let check_with = |partition: &BoxPartition, radius: f64| {
                let holes = vec![Hole::Circle { center, radius }];
                check(partition, &Domain { bounds: BOX, holes })
            };
            // what is uncovered ends at most 0.1 − 0.99 · 0.08 beyond the square
            let whole = 1.42 * (half + 0.021);
            assert_eq!(check_with(&partition, whole), Ok(()), "{center:?} {half}");
            let error = check_with(&partition, 0.4 * half).expect_err("a gap beside the hole");
            assert!(error.message.contains("no support holds"), "{error}");
            partition.half.fill(vec2(0.03, 0.03));
            assert!(check_with(&partition, whole).is_err(), "gaps everywhere");
        }
    }

    /// Squares without cells.
    fn boxes(center: Vec<Vec2>, half: f64) -> BoxPartition {
        let (half, n) = (vec![vec2(half, half); center.len()], center.len());
        BoxPartition {
            origin: center.clone(),
            scale: half.clone(),
            center,
            half,
            point: vec![None; n],
            ..BoxPartition::EMPTY
        }
    }

    /// Squares around random centres, and cells by halving these: no tree has made the cover.
    fn scattered(random: &mut Random, n: usize, half: f64) -> BoxPartition {
        let size = BOX.size();
        let mut point = || BOX.min + vec2(random.unit() * size.x, random.unit() * size.y);
        let center: Vec<Vec2> = (0..n).map(|_| point()).collect();
        let mut cell = vec![BOX; n];
        let mut parts = vec![((0..n).collect::<Vec<_>>(), BOX)];
        while let Some((mut part, area)) = parts.pop() {
            if let [one] = part[..] {
                cell[one] = area;
                continue;
            }
            let is_wide = area.size().x > area.size().y;
            let along = |k: usize| if is_wide { center[k].x } else { center[k].y };
            part.sort_by(|a, b| along(*a).total_cmp(&along(*b)));
            let right = part.split_off(part.len() / 2);
            let at = 0.5 * (along(part[part.len() - 1]) + along(right[0]));
            let (mut low, mut high) = (area, area);
            if is_wide {
                (low.max.x, high.min.x) = (at, at);
            } else {
                (low.max.y, high.min.y) = (at, at);
            }
            parts.extend([(part, low), (right, high)]);
        }
        BoxPartition { cell, level: vec![0; n], ..boxes(center, half) }
    }

    /// Covers without a tree pass if at each place some weight is not small, and only then.
    #[test]
    fn the_largest_weight_decides() {
        let (mut random, mut passed) = (Random(17), 0);
        for k in 0..60 {
            let partition = scattered(&mut random, 40, 0.4 + 0.02 * f64::from(k % 20));
            let domain = Domain { bounds: BOX, holes: Vec::new() };
            assert_eq!(tiling::check(&partition, &domain), Ok(()));
            let reach = |p: Vec2| {
                let s =
                    |c: &Vec2, h: &Vec2| ((p.x - c.x) / h.x).abs().max(((p.y - c.y) / h.y).abs());
                let all = partition.center.iter().zip(&partition.half).map(|(c, h)| s(c, h));
                all.fold(f64::INFINITY, f64::min)
            };
            let size = BOX.size();
            let worst = (0..4000)
                .map(|_| reach(BOX.min + vec2(random.unit() * size.x, random.unit() * size.y)))
                .fold(0.0, f64::max);
            let without = BoxPartition { cell: vec![], level: vec![], ..partition.clone() };
            assert_eq!(check(&without, &domain).is_ok(), check(&partition, &domain).is_ok());
            match check(&partition, &domain) {
                Ok(()) => {
                    passed += 1;
                    assert!(worst <= CORE);
                }
                Err(error) => {
                    let numbers = error.message.split(['(', ',', ')']).skip(1).take(2);
                    let p: Vec<f64> =
                        numbers.map(|v| v.trim().parse().expect("a number")).collect();
                    assert!(reach(vec2(p[0], p[1])) > CORE, "{error}");
                }
            }
        }
        assert!((10..50).contains(&passed), "{passed}");
    }
}
