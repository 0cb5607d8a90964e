//! Borders of cells and patches, and kinks of weights, belong to the right and upper side.

use crate::support::{assert_close, compiled, entries, evaluate};
use ppum::crack::Side;
use ppum::dataset::Dataset;
use ppum::field::LocalField;
use ppum::jet::Jet;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Coefficients, Recipe};

/// A graded cover whose borders are exact in f64: dyadic cells, α = 3/2.
fn dataset(weight: WeightFunction) -> Dataset {
    let recipe = Recipe {
        domain: Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0)),
        cells: [1, 1],
        random_rounds: 2,
        overlap: 1.5,
        weight,
        cracks: Vec::new(),
        coefficients: Coefficients::Random,
        ..Recipe::default()
    };
    recipe.dataset()
}

/// Distance over which the field is followed from a border, in half-extents of a patch.
const STEP: f64 = 1e-8;

fn jets(local: &mut LocalField<'_>, p: Vec2) -> Option<Vec<Jet<f64>>> {
    evaluate::<2>(local, p, Side::Above)
}

/// Borders and centre lines (kinks of linear weights) of every patch, at random heights; corners.
fn places(dataset: &Dataset) -> Vec<(Vec2, Vec2)> {
    let (partition, mut random) = (dataset.steps[0].partition.boxes(), Random(1));
    let mut all = Vec::new();
    for i in 0..partition.len() {
        let (support, half) = (partition.support(i), partition.half[i]);
        let step = half * STEP;
        for x in [support.min.x, support.center().x, support.max.x] {
            all.push((vec2(x, random.point(&support).y), vec2(step.x, 0.0)));
        }
        for y in [support.min.y, support.center().y, support.max.y] {
            all.push((vec2(random.point(&support).x, y), vec2(0.0, step.y)));
        }
        for corner in [support.min, support.max, partition.cell[i].min, partition.cell[i].max] {
            all.push((corner, step));
        }
    }
    all.retain(|(p, step)| {
        dataset.domain.contains(*p + *step) && dataset.domain.contains(*p - *step)
    });
    all
}

#[test]
fn the_limit_from_the_right_and_from_above() {
    for weight in WeightFunction::ALL {
        let dataset = dataset(weight.clone());
        let field = compiled(&dataset);
        let mut local = field.at(Vec2::ZERO);
        let (places, mut differ) = (places(&dataset), 0);
        for &(p, step) in &places {
            let at = jets(&mut local, p).unwrap();
            let right = jets(&mut local, p + step).unwrap();
            let left = jets(&mut local, p - step).unwrap();
            let size = step.x.max(step.y) / STEP;
            for (at, right) in at.iter().zip(&right) {
                assert_close(at, right, 1e-4, 1.0, size);
            }
            // the derivative that jumps: 1 for linear, 2 for quadratic, none up to 2 for
            // cubic weights
            let jump = |order: std::ops::Range<usize>, scale: f64| {
                let apart = at.iter().zip(&left).flat_map(|(at, left)| {
                    let (a, b) = (entries(at), entries(left));
                    order.clone().map(move |k| (a[k] - b[k]).abs())
                });
                apart.fold(0.0, f64::max) > 1e-3 * scale
            };
            assert!(!jump(0..1, 1.0), "the value is continuous");
            differ += usize::from(match weight {
                WeightFunction::Linear => jump(1..3, 1.0 / size),
                WeightFunction::Quadratic => jump(3..6, 1.0 / (size * size)),
                _ => jump(1..6, 1.0 / (size * size)),
            });
        }
        // Where only the centre line of the patch alone is crossed, and for quadratic weights on
        // every centre line, nothing jumps.
        let share = differ as f64 / places.len() as f64;
        match weight {
            WeightFunction::Linear => assert!(share > 0.5, "{share}"),
            WeightFunction::Quadratic => assert!(share > 0.3, "{share}"),
            _ => assert_eq!(differ, 0),
        }
    }
}

/// An anchor on the border and one far away tell the same.
#[test]
fn borders_seen_from_anchors() {
    let dataset = dataset(WeightFunction::Linear);
    let field = compiled(&dataset);
    let mut absolute = field.at(Vec2::ZERO);
    for (p, _) in places(&dataset) {
        let expected = jets(&mut absolute, p).unwrap();
        let mut on_border = field.at(p);
        for (a, b) in jets(&mut on_border, Vec2::ZERO).unwrap().iter().zip(&expected) {
            assert_close(a, b, 1e-12, 1.0, 0.05);
        }
    }
}
