//! Datasets of several steps.

use ppum::crack::CrackEnd;
use ppum::dataset::Dataset;

use super::recipe::{Recipe, crack};

/// A step for each load: that of its recipe, with coefficients times the load. Domain and
/// components of all recipes are those of the first.
///
/// # Panics
/// Without loads.
#[must_use]
pub fn series(loads: &[f64], recipe: impl Fn(usize) -> Recipe) -> Dataset {
    let mut dataset = recipe(0).dataset();
    dataset.steps.clear();
    for (k, &load) in loads.iter().enumerate() {
        let mut step = recipe(k).step();
        step.load = load;
        let coefficients = step.fields.iter_mut().flat_map(|field| &mut field.coefficients);
        coefficients.flatten().for_each(|c| *c *= load);
        dataset.steps.push(step);
    }
    assert!(!dataset.steps.is_empty(), "a dataset has a step");
    dataset
}

/// A crack that grows from the left edge, step by step, under a load that rises from 0 to 1; each
/// step has cells that are small at its own tip.
///
/// # Panics
/// If there are not two steps at least.
#[must_use]
pub fn growing(count: usize) -> Dataset {
    assert!(count > 1, "nothing grows in one step");
    let part = |k: usize| k as f64 / (count - 1) as f64;
    let loads: Vec<f64> = (0..count).map(part).collect();
    let recipe = |k: usize| {
        let tip = [0.45 + 0.8 * part(k), 0.17 + 0.1 * part(k)];
        let ends = [CrackEnd::Mouth, CrackEnd::Tip];
        let cracks = vec![crack(&[[0.2, 0.13], [0.4, 0.16], tip], ends)];
        Recipe { cracks, ..Recipe::default() }
    };
    let mut dataset = series(&loads, recipe);
    dataset.title = "Growing crack".into();
    dataset
}

#[cfg(test)]
mod tests {
    use ppum::crack::Side;
    use ppum::field::Field;
    use ppum::quantity::Quantity;
    use ppum::vec2::{Vec2, vec2};

    use super::*;

    #[test]
    fn steps_differ_in_all_their_parts() {
        let dataset = growing(4);
        dataset.check().expect("a dataset");
        let tip = |k: usize| dataset.steps[k].cracks[0].points[2];
        assert!((0..3).all(|k| tip(k).x < tip(k + 1).x));
        assert!((0..3).all(|k| dataset.steps[k].partition != dataset.steps[k + 1].partition));
        let at = |k: usize| {
            let field = Field::new(&dataset, k).expect("a field");
            let ux = Quantity::parse("ux", &field).expect("a quantity");
            ux.at(&mut field.at(vec2(1.3, -0.2)), Vec2::ZERO, Side::Above)
        };
        // far from the crack the field is a smooth one, times the load
        assert!(at(0) == 0.0 && (at(1) / at(3) - 1.0 / 3.0).abs() < 1e-3, "{} {}", at(1), at(3));
    }
}
