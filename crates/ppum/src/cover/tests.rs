//! Tiling, balance and order are checked on the finished cells, by comparing all of them.

use super::*;
use crate::box_tree::BoxTree;
use crate::vec2::vec2;
use ppum_testkit::random::Random;

const SQUARE: Rect = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
/// No coordinate of it, or of its cells, is a binary fraction.
const ODD: Rect = Rect::new(vec2(0.1, -0.3), vec2(0.7, 1.1));

fn random_points(n: usize, domain: Rect, random: &mut Random) -> Vec<Vec2> {
    let size = domain.size();
    (0..n)
        .map(|k| {
            // Half of them crowd towards the lower left corner.
            let p = vec2(random.unit(), random.unit());
            let s = if k % 2 == 0 { 1.0 } else { 0.01 };
            domain.min + vec2(p.x * size.x, p.y * size.y) * s
        })
        .collect()
}

/// Covers of all kinds, refined at random.
fn covers() -> Vec<Cover> {
    let mut random = Random(3);
    let points = random_points(300, ODD, &mut random);
    let mut covers = vec![
        Cover::uniform(ODD, 3).unwrap(),
        Cover::grid(ODD, [3, 7]).unwrap(),
        Cover::scattered(ODD, [1, 1], points.clone()).unwrap(),
        Cover::scattered(ODD, [5, 2], points).unwrap(),
    ];
    for cover in &mut covers[1..] {
        for _ in 0..3 {
            cover.refine(|_, _| random.unit() < 0.1).unwrap();
        }
    }
    let near = vec2(0.3, 0.4);
    let mut deep = Cover::grid(ODD, [2, 3]).unwrap();
    while deep.refine(|cell, level| level < MAX_LEVEL && cell.contains(near)).unwrap() > 0 {}
    covers.push(deep);
    covers
}

fn assert_tiles(domain: Rect, cells: &[Rect]) {
    let tree = BoxTree::new(cells);
    let mut found = Vec::new();
    let mut area = 0.0;
    for (i, cell) in (0u32..).zip(cells) {
        found.clear();
        tree.query_box(cell, &mut found);
        assert_eq!(found, [i], "cells overlap");
        area += cell.size().x * cell.size().y;
        let right = vec2(cell.max.x, cell.center().y);
        let above = vec2(cell.center().x, cell.max.y);
        for (p, last, line) in [
            (right, cell.max.x == domain.max.x, (|r| r.min.x) as fn(Rect) -> f64),
            (above, cell.max.y == domain.max.y, |r| r.min.y),
        ] {
            found.clear();
            tree.query_point(p, &mut found);
            if last {
                assert!(found.is_empty(), "a cell beyond the domain");
            } else {
                assert_eq!(found.len(), 1, "a gap");
                let expected = if p == right { cell.max.x } else { cell.max.y };
                assert_eq!(line(cells[found[0] as usize]), expected);
            }
        }
    }
    let size = domain.size();
    assert!((area / (size.x * size.y) - 1.0).abs() < 1e-13);
    let all = cells.iter().fold(cells[0], |bound, cell| bound.union(cell));
    assert_eq!(all, domain);
}

#[test]
fn cells_tile_the_domain() {
    for cover in covers() {
        let cells: Vec<_> = cover.cells().iter().map(|c| c.0).collect();
        assert_eq!(cells.len(), cover.n_cells());
        assert_tiles(ODD, &cells);
    }
}

fn touch(a: &Rect, b: &Rect) -> bool {
    a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y
}

#[test]
fn touching_leaves_differ_by_at_most_one_level() {
    for cover in covers() {
        let cells = cover.cells();
        for (i, (a, level)) in cells.iter().enumerate() {
            for (b, other) in &cells[..i] {
                assert!(!touch(a, b) || level.abs_diff(*other) <= 1);
            }
        }
    }
}

#[test]
fn balance_splits_no_more_than_it_must() {
    // The cell next to the centre is split twice. Its diagonal and its side neighbours touch cells
    // two levels finer and are split once: 3 + 4 leaves in its quadrant, 4 in each other one.
    let next_to_centre = |c: Rect| c.max == Vec2::ZERO;
    let mut tree = Cover::uniform(SQUARE, 1).unwrap();
    let mut grid = Cover::grid(SQUARE, [2, 2]).unwrap();
    for cover in [&mut tree, &mut grid] {
        assert_eq!(cover.refine(|c, _| next_to_centre(c)).unwrap(), 1);
        assert_eq!(cover.n_cells(), 7);
        assert_eq!(cover.refine(|c, _| next_to_centre(c)).unwrap(), 1);
        assert_eq!(cover.n_cells(), 19);
    }
    let deeper = |cells: Vec<(Rect, u8)>| cells.into_iter().map(|(c, l)| (c, l + 1)).collect();
    let expected: Vec<_> = deeper(grid.cells());
    assert_eq!(tree.cells(), expected);
}

#[test]
fn leaves_are_in_morton_order() {
    for cover in covers() {
        let leaves = cover.leaves();
        for pair in leaves.windows(2) {
            let [a, b] = [pair[0].cell, pair[1].cell].map(|c| {
                let down = MAX_LEVEL - c.level;
                (c.x << down, c.y << down)
            });
            // The highest differing bit decides; y counts more than x in the same place.
            let (dx, dy) = (a.0 ^ b.0, a.1 ^ b.1);
            let y_decides = dy != 0 && dy.ilog2() >= dx.checked_ilog2().unwrap_or(0);
            assert!(if y_decides { a.1 < b.1 } else { a.0 < b.0 });
        }
    }
}

#[test]
fn each_point_has_a_cell_of_its_own() {
    let mut random = Random(4);
    let mut points = random_points(500, ODD, &mut random);
    points.extend([ODD.min, ODD.max, vec2(ODD.min.x, ODD.max.y), ODD.center()]);
    let mut cover = Cover::scattered(ODD, [1, 1], points.clone()).unwrap();
    for _ in 0..2 {
        let partition = cover.partition(1.3, WeightFunction::Linear).unwrap();
        let mut owner = vec![None; points.len()];
        for (i, point) in partition.point.iter().enumerate() {
            if let Some(k) = *point {
                assert_eq!(owner[k as usize].replace(i), None);
                assert!(partition.cell[i].contains(points[k as usize]));
            }
        }
        assert!(owner.iter().all(Option::is_some));
        assert_eq!(partition.points, points);
        cover.refine(|_, _| random.unit() < 0.3).unwrap();
    }
    // Without the points in one cell, that cell would not have been split: four points, four cells.
    let corners = vec![ODD.min, vec2(0.69, -0.29), vec2(0.11, 1.09), ODD.center()];
    assert_eq!(Cover::scattered(ODD, [1, 1], corners).unwrap().n_cells(), 4);
    assert_eq!(Cover::scattered(ODD, [1, 1], Vec::new()).unwrap().n_cells(), 1);
}

#[test]
fn cells_do_not_depend_on_the_order_of_points() {
    let mut points = random_points(400, ODD, &mut Random(5));
    let first = Cover::scattered(ODD, [2, 1], points.clone()).unwrap().cells();
    points.reverse();
    assert_eq!(Cover::scattered(ODD, [2, 1], points).unwrap().cells(), first);
}

#[test]
fn uniform_covers_and_grids() {
    let uniform = Cover::uniform(SQUARE, 4).unwrap().cells();
    assert_eq!(uniform.len(), 256);
    assert!(uniform.iter().all(|(c, level)| c.size() == vec2(0.125, 0.125) && *level == 4));
    // 7 × 16 cells of a plate 7 × 16: all borders are whole numbers, exactly.
    let plate = Rect::new(Vec2::ZERO, vec2(7.0, 16.0));
    for (cell, level) in Cover::grid(plate, [7, 16]).unwrap().cells() {
        assert_eq!(level, 0);
        assert_eq!(cell.min, vec2(cell.min.x.round(), cell.min.y.round()));
        assert_eq!(cell.size(), vec2(1.0, 1.0));
    }
    // A domain that is its own mirror image has cells that are.
    let cells = Cover::grid(SQUARE, [7, 7]).unwrap().cells();
    for (cell, _) in &cells {
        let image = Rect::new(-cell.max, -cell.min);
        assert!(cells.iter().any(|(c, _)| *c == image));
    }
}

#[test]
fn patches_are_stretched_cells() {
    let mut cover = Cover::grid(ODD, [3, 7]).unwrap();
    cover.refine_leaves(&[0, 5, 5]).unwrap();
    let partition = cover.partition(1.5, WeightFunction::Cubic).unwrap();
    assert_eq!(partition.len(), 21 + 2 * 3);
    assert_eq!(partition.weight, WeightFunction::Cubic);
    assert_eq!((&partition.origin, &partition.scale), (&partition.center, &partition.half));
    for i in 0..partition.len() {
        let (cell, support) = (partition.cell[i], partition.support(i));
        assert_eq!(partition.center[i], cell.center());
        assert!((support.size() - cell.size() * 1.5).length() < 1e-15);
    }
    assert_eq!(partition.level[..5], [1, 1, 1, 1, 0]);
}

/// True if some part of each cell is covered by its own patch alone.
fn has_flat_tops(partition: &BoxPartition) -> bool {
    let supports: Vec<_> = (0..partition.len()).map(|i| partition.support(i)).collect();
    let tree = BoxTree::new(&supports);
    let mut covering_patches = Vec::new();
    let mut found = Vec::new();
    (0u32..).zip(&partition.cell).all(|(i, cell)| {
        covering_patches.clear();
        tree.query_box(cell, &mut covering_patches);
        let cuts = |lo: f64, hi: f64, ends: fn(&Rect) -> [f64; 2]| {
            let borders = covering_patches.iter().flat_map(|&k| ends(&supports[k as usize]));
            let mut cuts: Vec<_> = borders.filter(|v| lo < *v && *v < hi).collect();
            cuts.extend([lo, hi]);
            cuts.sort_by(f64::total_cmp);
            cuts
        };
        let xs = cuts(cell.min.x, cell.max.x, |r| [r.min.x, r.max.x]);
        let ys = cuts(cell.min.y, cell.max.y, |r| [r.min.y, r.max.y]);
        let middles = |v: &[f64]| v.windows(2).map(|w| 0.5 * (w[0] + w[1])).collect::<Vec<_>>();
        let ys = middles(&ys);
        middles(&xs).iter().any(|&x| {
            ys.iter().any(|&y| {
                found.clear();
                tree.query_point(vec2(x, y), &mut found);
                found == [i]
            })
        })
    })
}

#[test]
fn flat_tops_exist_below_five_thirds() {
    // numerics: on level jumps of 1 a flat top exists if (α − 1)(2 + 1) < 2.
    for cover in covers() {
        let partition = |alpha| cover.partition(alpha, WeightFunction::Linear).unwrap();
        assert!(has_flat_tops(&partition(1.3)));
        assert!(has_flat_tops(&partition(1.66)));
    }
    let mut corner = Cover::grid(SQUARE, [2, 2]).unwrap();
    corner.refine_leaves(&[0]).unwrap();
    assert!(has_flat_tops(&corner.partition(1.66, WeightFunction::Linear).unwrap()));
    assert!(!has_flat_tops(&corner.partition(1.67, WeightFunction::Linear).unwrap()));
}

#[test]
fn what_cannot_be_is_said() {
    let cover = Cover::uniform(SQUARE, 1).unwrap();
    for alpha in [1.0, 1.0 + 1e-12, 1.0099, 1.9901, 2.0, 0.0, f64::NAN] {
        let error = cover.partition(alpha, WeightFunction::Linear).unwrap_err();
        assert!(matches!(error, CoverError::Overlap(_)));
    }
    let flat = Rect::new(vec2(0.0, 1.0), vec2(1.0, 1.0));
    assert_eq!(Cover::uniform(flat, 1).unwrap_err(), CoverError::Domain(flat));
    assert_eq!(Cover::grid(SQUARE, [3, 0]).unwrap_err(), CoverError::NoCells([3, 0]));
    assert_eq!(Cover::grid(SQUARE, [1 << 13, 1 << 12]).unwrap_err(), CoverError::TooManyCells);
    assert_eq!(Cover::uniform(SQUARE, 13).unwrap_err(), CoverError::TooManyCells);
    let outside = Cover::scattered(SQUARE, [1, 1], vec![Vec2::ZERO, vec2(0.0, 2.0)]).unwrap_err();
    assert_eq!(outside, CoverError::PointOutside { index: 1, at: vec2(0.0, 2.0) });
    assert!(Cover::scattered(SQUARE, [1, 1], vec![vec2(f64::NAN, 0.0)]).is_err());
    let missing = cover.clone().refine_leaves(&[4]).unwrap_err();
    assert_eq!(missing, CoverError::NoSuchLeaf { leaf: 4, count: 4 });
}

#[test]
fn coincident_points_are_named() {
    let p = vec2(0.3, 0.4);
    let points = vec![vec2(0.9, 0.9), p, vec2(-0.5, 0.1), p];
    let error = Cover::scattered(SQUARE, [1, 1], points).unwrap_err();
    let expected = CoverError::CoincidentPoints { first: 1, second: 3, at: p, distance: 0.0 };
    assert_eq!(error, expected);
    assert_eq!(
        error.to_string(),
        "points 1 and 3 at (0.3, 0.4), 0 apart, cannot be put into different cells: \
         drop one of them"
    );
    let close = vec![p, p + vec2(1e-12, 0.0)];
    let error = Cover::scattered(SQUARE, [1, 1], close).unwrap_err();
    assert!(matches!(error, CoverError::CoincidentPoints { distance, .. } if distance > 0.0));
    let apart = vec![p, p + vec2(1e-7, 0.0)];
    assert!(Cover::scattered(SQUARE, [1, 1], apart).is_ok());
}

#[test]
fn refinement_ends_where_cells_cannot_be_halved() {
    let deepest = |domain, p: Vec2| {
        let mut cover = Cover::grid(domain, [1, 1]).unwrap();
        loop {
            if let Err(error) = cover.refine(|cell, _| cell.contains(p)) {
                return error;
            }
        }
    };
    let error = deepest(SQUARE, vec2(0.1, 0.2));
    assert!(matches!(error, CoverError::TooSmall { level: MAX_LEVEL, .. }));
    // A small domain far from the origin runs out of digits first.
    let far = Rect::new(vec2(1e9, 0.0), vec2(1e9 + 1.0, 1.0));
    let error = deepest(far, vec2(1e9 + 0.4, 0.4));
    assert!(
        matches!(error, CoverError::TooSmall { level, .. } if (20..MAX_LEVEL).contains(&level))
    );
}
