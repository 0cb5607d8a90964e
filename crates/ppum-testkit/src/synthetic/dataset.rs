//! The datasets of recipes.

use super::coefficients::{self, indicators};
use super::recipe::{Coefficients, Recipe};
use ppum::cover::Cover;
use ppum::crack::{Crack, CrackEnd, End, TipId};
use ppum::dataset::{BoxPartition, Dataset, Equation, FieldData, Material, Step, StressState};
use ppum::function::{Frame, Function, FunctionKind, WESTERGAARD};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;

const MATERIAL: Material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };

/// u_x as a polynomial of degree 2 of the way from the middle of the default domain, without
/// cracks; the coefficients in the order of [`Coefficients::Polynomial`].
#[must_use]
pub fn polynomial(ux: &[f64]) -> Dataset {
    let coefficients = Coefficients::Polynomial(vec![ux.to_vec(), vec![]]);
    Recipe { cracks: vec![], degrees: vec![2], coefficients, ..Recipe::default() }.dataset()
}

/// u = d⊥ √r sin(θ/2) about the last tip of a crack along the unit vector d, in a square of width 2
/// about the tip.
///
/// # Panics
/// If the square is none of finite numbers.
#[must_use]
pub fn opening(tip: Vec2, d: Vec2) -> Dataset {
    let domain = Rect::around(tip, vec2(1.0, 1.0));
    let cover = Cover::uniform(domain, 3).expect("a cover");
    let partition = cover.partition(1.3, WeightFunction::Quadratic).expect("a partition");
    let crack = Crack::polyline(vec![tip - d * 0.7, tip], [CrackEnd::Tip; 2]);
    let frame = Frame::Tip(TipId { crack: 0, end: End::Last });
    let mut displacement = FieldData::new("displacement", &["ux", "uy"]);
    (0..64).for_each(|_| displacement.push_patch(&[(0, 0)]));
    displacement.coefficients[0].fill(d.left().x);
    displacement.coefficients[1].fill(d.left().y);
    let step = Step::new(partition).with_crack(crack);
    let step = step.with_function("opening", FunctionKind::formula(WESTERGAARD[1], frame));
    Dataset::new(domain, Equation::elasticity(MATERIAL)).with_step(step.with_field(displacement))
}

impl Recipe {
    /// The dataset, of one step with one field.
    #[must_use]
    pub fn dataset(&self) -> Dataset {
        let equation = match self.components {
            1 => Equation::poisson(1.0),
            _ => Equation::elasticity(MATERIAL),
        };
        let mut dataset = Dataset::new(self.domain, equation).with_step(self.step());
        dataset.title = "synthetic".into();
        dataset.program = "ppum-testkit".into();
        dataset
    }

    /// One step with one field.
    #[must_use]
    pub fn step(&self) -> Step {
        let (partition, functions) = (self.partition(), self.functions());
        let fields = vec![self.field(&partition, &functions)];
        let mut step = Step::new(partition);
        step.cracks.clone_from(&self.cracks);
        (step.functions, step.fields) = (functions, fields);
        step
    }

    /// The table of functions: one, the side of each crack, four functions of each tip, the extra
    /// ones, those of components in the order of their patches.
    #[must_use]
    pub fn functions(&self) -> Vec<Function> {
        let mut all = vec![Function { name: "one".into(), kind: FunctionKind::One }];
        for crack in 0..self.cracks.len() as u32 {
            all.push(Function {
                name: format!("side {crack}"),
                kind: FunctionKind::Side { crack },
            });
        }
        for tip in self.tips() {
            for text in &self.tip_functions {
                let (text, frame) = (text.clone(), Frame::Tip(tip));
                let name = format!("{text} of crack {} {}", tip.crack, tip.end.name());
                let kind = FunctionKind::formula(&text, frame);
                all.push(Function { name, kind });
            }
        }
        let named = |kind: &FunctionKind| Function { name: "extra".into(), kind: kind.clone() };
        all.extend(self.extra.iter().map(named));
        if !self.junctions.is_empty() {
            all.extend(indicators(self, &self.partition()));
        }
        all
    }

    /// A field over a partition with the functions of [`functions`](Self::functions).
    #[must_use]
    pub fn field(&self, partition: &BoxPartition, functions: &[Function]) -> FieldData {
        coefficients::field(self, partition, functions)
    }
}

#[cfg(test)]
mod tests {
    use super::super::coefficients::{amplitude, around, cut_off, level, smooth};
    use super::*;
    use crate::random::Random;
    use ppum::crack::Side;
    use ppum::field::Field;
    use ppum::function::FunctionTable;
    use ppum::jet::Jet;

    /// The field that [`Coefficients::Taylor`] expands, as the sum of its parts.
    fn target(recipe: &Recipe, table: &FunctionTable, p: Vec2) -> f64 {
        let functions = table.at(&recipe.cracks, p);
        let mut sum = smooth(0, p).v;
        // the sides of the cracks are the first groups, then come the tips
        for (tip, id) in recipe.tips().enumerate() {
            let mut f = [Jet::constant(0.0); 4];
            let group = recipe.cracks.len() + tip;
            functions.evaluate::<f64, 0>(group, [0.0; 2], Side::Above, &mut f);
            let parts = f.iter().enumerate().map(|(k, f)| amplitude(tip, k, 0) * f.v);
            sum += parts.sum::<f64>() * cut_off(p - recipe.position(id), recipe.zone).v;
        }
        let around = recipe.junctions.iter().zip(around(recipe)).enumerate();
        for (k, (place, components)) in around {
            let share = cut_off(p - place.center, 0.5 * place.radius).v;
            sum += level(k, components.containing(p), 0) * share;
        }
        sum
    }

    /// Largest error at random points, the neighbourhood of the tips included.
    fn error(recipe: &Recipe, level: u8) -> f64 {
        let recipe = Recipe { level, tip_level: level + 2, ..recipe.clone() };
        let dataset = recipe.dataset();
        let field = Field::new(&dataset, 0).expect("a field");
        let table =
            FunctionTable::new(&recipe.functions(), recipe.cracks.len(), &[]).expect("functions");
        let (mut local, mut random) = (field.at(Vec2::ZERO), Random(1));
        let apart = |_| {
            let p = random.point(&recipe.domain);
            let mut u = [Jet::constant(0.0); 2];
            assert!(local.evaluate::<0>(p, Side::Above, &mut u));
            (u[0].v - target(&recipe, &table, p)).abs()
        };
        (0..5000).map(apart).fold(0.0, f64::max)
    }

    #[test]
    fn taylor_coefficients_converge_to_the_field_they_expand() {
        let recipe = Recipe { zone: 0.15, ..Recipe::default() };
        let (coarse, fine) = (error(&recipe, 2), error(&recipe, 3));
        assert!(fine < 1e-2 && coarse / fine > 5.0, "{coarse} {fine}");
    }

    /// Where cracks meet, too, of which each patch knows its own components.
    #[test]
    fn so_do_those_where_cracks_meet() {
        let (coarse, fine) = (error(&Recipe::meeting(), 4), error(&Recipe::meeting(), 5));
        assert!(fine < 2e-2 && coarse / fine > 5.0, "{coarse} {fine}");
    }

    #[test]
    fn a_recipe_always_gives_the_same() {
        assert_eq!(Recipe::random(5).dataset(), Recipe::random(5).dataset());
        assert_ne!(Recipe::random(5).dataset(), Recipe::random(6).dataset());
    }
}
