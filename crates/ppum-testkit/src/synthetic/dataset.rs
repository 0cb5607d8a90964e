//! The datasets of recipes.

use super::coefficients::{self, indicators};
use super::recipe::Recipe;
use ppum::dataset::{BoxPartition, Dataset, Equation, FieldData, Material, Step, StressState};
use ppum::function::{Frame, Function, FunctionKind};

impl Recipe {
    /// The dataset, of one step with one field.
    #[must_use]
    pub fn dataset(&self) -> Dataset {
        let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
        let equation = match self.components {
            1 => Equation::poisson(1.0),
            _ => Equation::elasticity(material),
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
    use ppum::vec2::Vec2;

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
