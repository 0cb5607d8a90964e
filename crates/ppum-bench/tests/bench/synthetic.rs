//! The crack that nobody had to solve: patches agree with its solution.

use num_complex::Complex64;
use ppum::crack::Side;
use ppum::dataset::Step;
use ppum::field::Field;
use ppum::jet::Jet;
use ppum::vec2::{Vec2, vec2};
use ppum_bench::synthetic::{CrackRecipe, DOMAIN, FIRST_TIP, HALF, KAPPA, TIPS, TWICE_MU};

/// u_y in closed form.
fn exact(p: Vec2) -> f64 {
    let z = Complex64::new(p.x, p.y);
    let f = (z - HALF).sqrt() * (z + HALF).sqrt();
    ((KAPPA + 1.0) / 2.0 * f.im - p.y * (z / f).re) / TWICE_MU
}

/// Local values u_y of all patches at a place.
fn values(recipe: CrackRecipe, p: Vec2) -> Vec<f64> {
    let dataset = recipe.dataset().unwrap();
    let field = Field::new(&dataset, 0).unwrap();
    let partition = field.step.partition.boxes();
    let here = (0..partition.len()).filter(|&k| partition.support(k).contains(p));
    let local = field.at(p);
    let mut u = [Jet::constant(0.0); 2];
    here.map(|k| {
        local.over_patches::<f64, 0>([0.0; 2], Side::Above, &[k as u32], &mut u);
        u[1].v
    })
    .collect()
}

fn span(values: &[f64]) -> f64 {
    let max = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    max - values.iter().copied().fold(f64::INFINITY, f64::min)
}

/// Patches of half the size differ by 2^−(order + 1) where they meet, and all from the solution:
/// far from the tips, with tip functions, and on both faces of the crack, here with tip functions,
/// there without.
#[test]
fn patches_agree_to_their_order() {
    let corner = |i: u32, j: u32| DOMAIN.min + vec2(f64::from(i) / 12.0, f64::from(j) / 16.0);
    let places = [
        corner(2, 3),
        corner(9, 11),
        corner(11, 7),
        vec2(corner(7, 0).x, 1e-3),
        vec2(corner(9, 0).x, -1e-3),
    ];
    for (order, enriched) in [(1, 0.25), (2, 0.25), (2, 1.0), (4, 0.25), (5, 1.0)] {
        for p in places {
            let of = |level| CrackRecipe { order, enriched, ..CrackRecipe::new(level, level) };
            let [coarse, fine] = [5, 6].map(|level| values(of(level), p));
            assert!(coarse.len() >= 2 && fine.len() >= 2, "a border of patches");
            let (ratio, limit) = (span(&coarse) / span(&fine), f64::from(2 << order));
            assert!(ratio > 0.6 * limit, "{order} {p:?}: {ratio}, in the limit {limit}");
            // neighbours may err by the same, so errors are held to their rate, not to the span
            let error = |of: &[f64]| of.iter().map(|v| (v - exact(p)).abs()).fold(0.0, f64::max);
            let ratio = error(&coarse) / error(&fine);
            assert!(ratio > 0.6 * limit, "{order} {p:?}: {ratio}, in the limit {limit}");
        }
    }
}

/// With all of the area enriched every patch has functions of one tip.
#[test]
fn all_is_enriched() {
    let dataset = CrackRecipe { enriched: 1.0, ..CrackRecipe::new(5, 9) }.dataset().unwrap();
    let data = &dataset.steps[0].fields[0];
    for patch in 0..dataset.steps[0].partition.len() {
        let blocks = data.blocks(patch).filter(|&b| data.block_function[b] >= FIRST_TIP);
        assert_eq!(blocks.count(), 4);
    }
}

/// A quarter of the area is enriched, and every patch that holds a tip is.
#[test]
fn a_quarter_is_enriched() {
    for (level, tip_level) in [(2, 2), (4, 4), (5, 5), (3, 9)] {
        let dataset = CrackRecipe::new(level, tip_level).dataset().unwrap();
        let Step { partition, fields, .. } = &dataset.steps[0];
        let partition = partition.boxes();
        let has_tip = |k: usize| {
            fields[0].blocks(k).any(|block| fields[0].block_function[block] >= FIRST_TIP)
        };
        let mut area = 0.0;
        for k in 0..partition.len() {
            if has_tip(k) {
                area += partition.cell[k].size().x * partition.cell[k].size().y;
            } else {
                let support = partition.support(k);
                assert!(TIPS.iter().all(|&tip| !support.contains(tip)), "level {level}");
            }
        }
        // one cell of the coarse ones may be too much
        let excess = area / (4.0 / 3.0) - 0.25;
        let cell = 0.25f64.powi(level.into());
        let most = if level == tip_level { 1e-12 } else { cell };
        assert!((-1e-12..most).contains(&excess), "level {level}: {excess}");
    }
}
