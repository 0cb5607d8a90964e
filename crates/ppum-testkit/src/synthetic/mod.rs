//! Datasets with all the parts of a solution, made without solving.
//!
//! A [`Recipe`] says what a dataset looks like: its cover, cracks, functions and coefficients. The
//! blocks are those of a solver: every patch has a smooth block; a patch that a crack cuts through
//! has its side function, one in which cracks meet functions of the components that they leave of
//! it; a patch near a tip has the tip's Westergaard functions. So every recipe jumps on its cracks
//! and nowhere else.

mod coefficients;
mod components;
mod meeting;
mod series;

use crate::random::Random;
use ppum::cover::Cover;
use ppum::crack::{Crack, CrackEnd, TipId, tips};
use ppum::dataset::{
    BoxPartition, Dataset, Equation, FieldData, MAX_DEGREE, Material, Step, StressState,
};
use ppum::function::{Declared, Frame, Function, FunctionKind, WESTERGAARD};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;

pub use coefficients::{Coefficients, amplitude, cut_off, level, smooth};
pub use components::Components;
pub use series::{growing, series};

/// The features of a synthetic dataset.
#[derive(Clone, Debug)]
pub struct Recipe {
    /// Domain.
    pub domain: Rect,
    /// Root cells.
    pub cells: [u32; 2],
    /// Number of random points that make the cover; 0 for none.
    pub points: usize,
    /// Levels of halving everywhere; not used if there are points.
    pub level: u8,
    /// Rounds in which one cell in four, at random, is halved.
    pub random_rounds: u32,
    /// Level of the cells that hold a tip or a junction.
    pub tip_level: u8,
    /// Overlap α.
    pub overlap: f64,
    /// Weight function.
    pub weight: WeightFunction,
    /// True if the frames of polynomials differ from the supports.
    pub own_frames: bool,
    /// Cracks.
    pub cracks: Vec<Crack>,
    /// Degrees of smooth and side blocks, taken in turn by the patches.
    pub degrees: Vec<u8>,
    /// Degree of the blocks of tip functions.
    pub tip_degree: u8,
    /// Patches whose centre is closer than this to a tip have its functions.
    pub zone: f64,
    /// Patches that a crack cuts through have its side function.
    pub jumps: bool,
    /// Places where cracks meet. Where there are any, patches that cracks cut into more than two
    /// components have functions of these in place of sides.
    pub junctions: Vec<Junction>,
    /// Texts that stand for the four Westergaard functions in the tips' frames.
    pub tip_functions: [String; 4],
    /// More functions; every third patch has one of them, in turn, with a linear polynomial.
    pub extra: Vec<FunctionKind>,
    /// Number of components: 1 makes a potential, 2 a displacement, at most 6.
    pub components: usize,
    /// Coefficients.
    pub coefficients: Coefficients,
    /// Seed of all that is random.
    pub seed: u64,
}

/// A place where cracks meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Junction {
    /// Where they meet.
    pub center: Vec2,
    /// Within this distance the field of [`Coefficients::Taylor`] jumps from component to component
    /// of what the cracks leave of the box around it; no tip lies in it.
    pub radius: f64,
}

impl Default for Recipe {
    fn default() -> Self {
        let domain = Rect::new(vec2(0.2, -0.3), vec2(0.2 + 4.0 / 3.0, 0.7));
        Self {
            domain,
            cells: [4, 3],
            points: 0,
            level: 2,
            random_rounds: 0,
            tip_level: 5,
            overlap: 1.3,
            weight: WeightFunction::Linear,
            own_frames: false,
            cracks: vec![kinked()],
            degrees: vec![2],
            tip_degree: 0,
            zone: 0.2,
            jumps: true,
            junctions: Vec::new(),
            tip_functions: WESTERGAARD.map(str::to_owned),
            extra: Vec::new(),
            components: 2,
            coefficients: Coefficients::Taylor,
            seed: 1,
        }
    }
}

/// A crack with one kink and two tips in the default domain, along no axis.
#[must_use]
pub fn kinked() -> Crack {
    crack(&[[0.5713, 0.0931], [0.8642, 0.2817], [1.1831, 0.1973]], [CrackEnd::Tip; 2])
}

/// A crack through points.
#[must_use]
pub fn crack(points: &[[f64; 2]], ends: [CrackEnd; 2]) -> Crack {
    Crack { points: points.iter().map(|&p| p.into()).collect(), ends }
}

impl Recipe {
    /// A recipe in which everything is random and present: a graded cover, the default domain with
    /// a kinked, a straight and an edge crack, degrees 0 to 8, polynomial frames of their own,
    /// formulas, random coefficients.
    #[must_use]
    pub fn random(seed: u64) -> Self {
        let mut random = Random(seed);
        let text = |text: &str, frame| FunctionKind::Formula {
            text: text.to_owned(),
            frame,
            parameters: vec![("a".to_owned(), 1.5)],
            declared: Declared::default(),
        };
        let frame = Frame::Fixed { origin: vec2(0.9, 0.1), angle: random.between(-3.0, 3.0) };
        Self {
            points: 20 * random.below(2),
            level: 1,
            random_rounds: 1 + random.below(3) as u32,
            tip_level: 4 + random.below(2) as u8,
            overlap: random.between(1.05, 1.7),
            weight: WeightFunction::ALL[random.below(3)].clone(),
            own_frames: random.below(2) == 0,
            cracks: random_cracks(&mut random),
            degrees: (0..=MAX_DEGREE as u8).collect(),
            tip_degree: random.below(2) as u8,
            extra: vec![
                text("exp(-a*x)*cos(y^2) - r^3/(1 + x^2)", frame),
                text("x*y^2", Frame::World),
            ],
            coefficients: Coefficients::Random,
            seed,
            ..Self::default()
        }
    }

    /// Cracks that cross, branch and end on each other, with patches of several sizes around where
    /// they do.
    #[must_use]
    pub fn meeting() -> Self {
        let (cracks, junctions) = meeting::cracks();
        Self { cracks, junctions, zone: meeting::ZONE, ..Self::default() }
    }

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

    /// The partition of unity.
    ///
    /// # Panics
    /// If the recipe allows no cover.
    #[must_use]
    pub fn partition(&self) -> BoxPartition {
        let mut random = Random(self.seed);
        let mut cover = self.cover(&mut random);
        for _ in 0..self.random_rounds {
            cover.refine(|_, _| random.below(4) == 0).expect("a cover");
        }
        let tips: Vec<Vec2> = self.tips().map(|tip| self.position(tip)).collect();
        let fine = || tips.iter().copied().chain(self.junctions.iter().map(|j| j.center));
        let near = |cell: Rect| fine().any(|place| cell.contains(place));
        while cover.refine(|cell, level| level < self.tip_level && near(cell)).expect("a cover") > 0
        {
        }
        let mut partition = cover.partition(self.overlap, self.weight.clone()).expect("an overlap");
        if self.own_frames {
            for (k, origin) in partition.origin.iter_mut().enumerate() {
                let half = partition.half[k];
                *origin = *origin + vec2(0.2 * half.x, -0.1 * half.y);
                partition.scale[k] = vec2(half.x * 0.7, half.y * 1.2);
            }
        }
        partition
    }

    fn cover(&self, random: &mut Random) -> Cover {
        if self.points > 0 {
            let points = (0..self.points).map(|_| random.point(&self.domain)).collect();
            return Cover::scattered(self.domain, self.cells, points).expect("a cover");
        }
        let mut cover = Cover::grid(self.domain, self.cells).expect("a grid");
        while cover.refine(|_, level| level < self.level).expect("a cover") > 0 {}
        cover
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
            all.extend(coefficients::indicators(self, &self.partition()));
        }
        all
    }

    /// A field over a partition with the functions of [`functions`](Self::functions).
    #[must_use]
    pub fn field(&self, partition: &BoxPartition, functions: &[Function]) -> FieldData {
        coefficients::field(self, partition, functions)
    }

    /// The tips, in the order of their functions.
    pub fn tips(&self) -> impl Iterator<Item = TipId> + '_ {
        tips(&self.cracks)
    }

    /// The position of a tip.
    #[must_use]
    pub fn position(&self, tip: TipId) -> Vec2 {
        self.cracks[tip.crack as usize].end_point(tip.end)
    }
}

/// A kinked crack with two tips, an oblique straight one, and a kinked one from the left edge.
fn random_cracks(random: &mut Random) -> Vec<Crack> {
    let mut near =
        |x: f64, y: f64| [x + random.between(-0.04, 0.04), y + random.between(-0.04, 0.04)];
    let inner = [near(0.6, 0.4), near(0.8, 0.28), near(1.0, 0.42), near(1.25, 0.36)];
    let straight = [near(0.75, -0.15), near(1.2, 0.05)];
    let edge = [[0.2, near(0.0, 0.1)[1]], near(0.35, 0.12), near(0.45, -0.02)];
    vec![
        crack(&inner, [CrackEnd::Tip; 2]),
        crack(&straight, [CrackEnd::Tip; 2]),
        crack(&edge, [CrackEnd::Mouth, CrackEnd::Tip]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
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
        let around = recipe.junctions.iter().zip(coefficients::around(recipe)).enumerate();
        for (k, (place, components)) in around {
            let share = cut_off(p - place.center, 0.5 * place.radius).v;
            sum += level(k, components.of(p), 0) * share;
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
