//! Datasets with the parts of a solution, made without solving: a smooth field plus the fields of
//! crack tips, expanded by Taylor's formula about each patch so that neighbours agree as those of a
//! solution do.

use ppum::cover::Cover;
use ppum::crack::{Crack, CrackEnd, End, Side, TipId};
use ppum::dataset::{
    Dataset, Equation, FieldData, Material, Partition, Step, StressState, monomials,
};
use ppum::function::{Frame, Function, FunctionKind, FunctionTable, Slot, WESTERGAARD};
use ppum::jet::Jet;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;

/// What a synthetic dataset looks like.
#[derive(Clone, Debug)]
pub(crate) struct Recipe {
    /// Root cells.
    pub(crate) cells: [u32; 2],
    /// Levels of halving everywhere.
    pub(crate) level: u8,
    /// Level of the cells that hold a tip.
    pub(crate) tip_level: u8,
    /// Polynomial degrees, taken in turn by the patches.
    pub(crate) degrees: &'static [u8],
    /// Degree of the polynomials of tip functions.
    pub(crate) tip_degree: u8,
    /// Patches closer than this to a tip have its functions.
    pub(crate) zone: f64,
    /// Vertices of the crack.
    pub(crate) crack: &'static [Vec2],
    /// Patches that the crack cuts have jumps.
    pub(crate) jumps: bool,
    /// Tip functions are formulas without a kernel of their own.
    pub(crate) formulas: bool,
    /// Components.
    pub(crate) components: usize,
    /// Weight function.
    pub(crate) weight: WeightFunction,
    /// Frames of polynomials differ from the supports.
    pub(crate) own_frames: bool,
}

impl Default for Recipe {
    fn default() -> Self {
        Self {
            cells: [4, 3],
            level: 2,
            tip_level: 5,
            degrees: &[2],
            tip_degree: 0,
            zone: 0.2,
            crack: &KINKED,
            jumps: true,
            formulas: false,
            components: 2,
            weight: WeightFunction::Linear,
            own_frames: false,
        }
    }
}

/// The domain of all synthetic datasets, off the origin.
pub(crate) fn domain() -> Rect {
    Rect::new(vec2(0.2, -0.3), vec2(0.2 + 4.0 / 3.0, 0.7))
}

/// A crack with a kink, in the middle of the domain, along no axis.
pub(crate) const KINKED: [Vec2; 3] =
    [vec2(0.5713, 0.0931), vec2(0.8642, 0.2817), vec2(1.1831, 0.1973)];

const TIPS: [TipId; 2] = [TipId { crack: 0, end: End::Start }, TipId { crack: 0, end: End::Last }];

/// Index of the first tip function; the side comes before.
const FIRST_TIP: u32 = 2;

/// The function table; `wrap` puts the tip functions into parentheses, which hides what they are.
fn functions(wrap: bool) -> Vec<Function> {
    let mut all = vec![
        Function { name: "one".into(), kind: FunctionKind::One },
        Function { name: "side".into(), kind: FunctionKind::Side { crack: 0 } },
    ];
    for tip in TIPS {
        all.extend(WESTERGAARD.map(|text| Function {
            name: text.into(),
            kind: FunctionKind::formula(
                &if wrap { format!("({text})") } else { text.into() },
                Frame::Tip(tip),
            ),
        }));
    }
    all
}

/// Amplitude of Westergaard function `k` of a tip.
fn amplitude(tip: usize, k: usize, component: usize) -> f64 {
    0.3 * (1.7 * (tip + 1) as f64 + 2.3 * k as f64 + 1.1 * component as f64).sin()
}

/// The smooth part of a component with value, gradient and Hessian.
pub(crate) fn smooth(component: usize, p: Vec2) -> Jet<f64> {
    let (a, b) = (1.3 + 0.4 * component as f64, 0.9 - 0.5 * component as f64);
    let (s, c) = (a * p.x + b * p.y + component as f64).sin_cos();
    Jet { v: s, x: a * c, y: b * c, xx: -a * a * s, xy: -a * b * s, yy: -b * b * s }
}

/// The smooth part as a formula.
fn smooth_text(component: usize) -> String {
    let c = component as f64;
    format!("sin({} * x + {} * y + {c})", 1.3 + 0.4 * c, 0.9 - 0.5 * c)
}

struct Maker<'a> {
    recipe: &'a Recipe,
    cracks: Vec<Crack>,
    table: FunctionTable,
    partition: Partition,
    data: FieldData,
}

/// A dataset after a recipe.
pub(crate) fn dataset(recipe: &Recipe) -> Dataset {
    let crack = Crack { points: recipe.crack.to_vec(), ends: [CrackEnd::Tip; 2] };
    let (cracks, functions) = (vec![crack], functions(recipe.formulas));
    let table = FunctionTable::new(&self::functions(false), 1, &[]).expect("built-in functions");
    let partition = partition(recipe);
    let mut maker = Maker { recipe, cracks, table, partition, data: empty(recipe.components) };
    for patch in 0..maker.partition.len() {
        maker.add_patch(patch);
    }
    let Maker { cracks, partition, data, .. } = maker;
    let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
    let equation = match recipe.components {
        1 => Equation::poisson(1.0),
        _ => Equation::elasticity(material),
    };
    Dataset {
        title: "synthetic".into(),
        program: "test".into(),
        problem: None,
        domain: domain().into(),
        equation,
        quantities: Vec::new(),
        tables: Vec::new(),
        steps: vec![Step {
            load: 1.0,
            partition,
            cracks,
            functions,
            fields: vec![data],
            attributes: Vec::new(),
            intensities: Vec::new(),
            history: Vec::new(),
            warnings: Vec::new(),
            reactions: Vec::new(),
        }],
    }
}

fn empty(components: usize) -> FieldData {
    FieldData {
        name: "displacement".into(),
        unit: String::new(),
        components: ["ux", "uy", "uz", "uw"][..components].iter().map(|&s| s.into()).collect(),
        patch_blocks: vec![0],
        block_function: Vec::new(),
        block_degree: Vec::new(),
        block_offset: Vec::new(),
        coefficients: vec![Vec::new(); components],
        exact: (0..components).map(smooth_text).collect(),
    }
}

fn partition(recipe: &Recipe) -> Partition {
    let mut cover = Cover::grid(domain(), recipe.cells).expect("a grid");
    while cover.refine(|_, level| level < recipe.level).expect("a level") > 0 {}
    let tips = [recipe.crack[0], recipe.crack[recipe.crack.len() - 1]];
    let near = |cell: Rect| tips.iter().any(|&tip| cell.contains(tip));
    while cover.refine(|cell, level| level < recipe.tip_level && near(cell)).expect("a level") > 0 {
    }
    let mut partition = cover.partition(1.3, recipe.weight.clone()).expect("a cover");
    if recipe.own_frames {
        for (k, origin) in partition.origin.iter_mut().enumerate() {
            let half = partition.half[k];
            *origin = *origin + vec2(0.2 * half.x, -0.1 * half.y);
            partition.scale[k] = vec2(half.x * 0.7, half.y * 1.2);
        }
    }
    partition
}

impl Maker<'_> {
    fn add_patch(&mut self, patch: usize) {
        let degree = self.recipe.degrees[patch % self.recipe.degrees.len()];
        let center = self.partition.center[patch];
        let zone = TIPS.iter().position(|tip| {
            (self.cracks[0].end_point(tip.end) - center).length() < self.recipe.zone
        });
        match self.nearest_on_crack(patch).filter(|_| self.recipe.jumps) {
            Some((at, normal)) => {
                let step = normal * 1e-9;
                let above = self.remainder(at + step, zone);
                let below = self.remainder(at - step, zone);
                let mean = mixed(&above, &below, 0.5);
                let half_jump = mixed(&above, &below, -0.5);
                self.add_taylor(patch, 0, degree, at, &mean);
                self.add_taylor(patch, 1, degree, at, &half_jump);
            }
            None => {
                let jets = self.remainder(center, zone);
                self.add_taylor(patch, 0, degree, center, &jets);
            }
        }
        if let Some(tip) = zone {
            self.add_tip(patch, tip);
        }
        self.data.patch_blocks.push(self.data.block_function.len() as u32);
    }

    fn add_tip(&mut self, patch: usize, tip: usize) {
        let degree = self.recipe.tip_degree;
        for k in 0..4 {
            self.begin_block(FIRST_TIP + (4 * tip + k) as u32, degree);
            for (component, coefficients) in self.data.coefficients.iter_mut().enumerate() {
                coefficients.push(amplitude(tip, k, component));
                coefficients
                    .extend((1..monomials(degree.into())).map(|m| ripple(patch, k + m) * 0.01));
            }
        }
    }

    fn begin_block(&mut self, function: u32, degree: u8) {
        self.data.block_function.push(function);
        self.data.block_degree.push(degree);
        self.data.block_offset.push(self.data.coefficients[0].len() as u64);
    }

    /// A block whose polynomial has given jets at a point, and small coefficients beyond degree 2.
    fn add_taylor(&mut self, patch: usize, function: u32, degree: u8, at: Vec2, jets: &[Jet<f64>]) {
        self.begin_block(function, degree);
        let (d, s) = (self.partition.origin[patch] - at, self.partition.scale[patch]);
        let count = monomials(degree.into());
        for (jet, coefficients) in jets.iter().zip(&mut self.data.coefficients) {
            let x = jet.x + jet.xx * d.x + jet.xy * d.y;
            let y = jet.y + jet.xy * d.x + jet.yy * d.y;
            let v = jet.v + 0.5 * ((jet.x + x) * d.x + (jet.y + y) * d.y);
            let taylor = [
                v,
                x * s.x,
                y * s.y,
                0.5 * jet.xx * s.x * s.x,
                jet.xy * s.x * s.y,
                0.5 * jet.yy * s.y * s.y,
            ];
            let size = s.x * s.y * s.x.max(s.y);
            let tail = (6..count).map(|k| ripple(patch, k) * size);
            coefficients.extend(taylor.into_iter().chain(tail).take(count));
        }
    }

    /// The whole field, or what is left of it without one tip's functions, at a point.
    fn remainder(&self, at: Vec2, without: Option<usize>) -> Vec<Jet<f64>> {
        let mut jets: Vec<_> = (0..self.recipe.components).map(|c| smooth(c, at)).collect();
        let functions = self.table.at(&self.cracks, at);
        for tip in (0..TIPS.len()).filter(|&tip| without != Some(tip)) {
            let Slot::Jet { group, .. } = self.table.of(FIRST_TIP + 4 * tip as u32) else {
                panic!("tip functions are no constants")
            };
            let mut f = [Jet::constant(0.0); 4];
            functions.evaluate::<f64, 2>(group as usize, [0.0; 2], Side::Above, &mut f);
            for (component, jet) in jets.iter_mut().enumerate() {
                for (k, f) in f.iter().enumerate() {
                    *jet = jet.plus::<2>(f.scaled::<2>(amplitude(tip, k, component)));
                }
            }
        }
        jets
    }

    /// The point of the crack, continued straight beyond its ends, nearest to a patch's centre, and
    /// the normal there, if the crack may cut the patch.
    fn nearest_on_crack(&self, patch: usize) -> Option<(Vec2, Vec2)> {
        let (center, half) = (self.partition.center[patch], self.partition.half[patch]);
        let points = &self.cracks[0].points;
        let last = points.len() - 2;
        let near = points.windows(2).enumerate().map(|(k, ends)| {
            let (tangent, length) = ((ends[1] - ends[0]).unit(), (ends[1] - ends[0]).length());
            let lo = if k == 0 { f64::NEG_INFINITY } else { 0.0 };
            let hi = if k == last { f64::INFINITY } else { length };
            let at = ends[0] + tangent * tangent.dot(center - ends[0]).clamp(lo, hi);
            ((at - center).length(), at, tangent.left())
        });
        let (distance, at, normal) = near.min_by(|a, b| a.0.total_cmp(&b.0))?;
        (distance < half.length()).then_some((at, normal))
    }
}

fn mixed(a: &[Jet<f64>], b: &[Jet<f64>], share: f64) -> Vec<Jet<f64>> {
    a.iter().zip(b).map(|(a, b)| a.scaled::<2>(0.5).plus::<2>(b.scaled::<2>(share))).collect()
}

/// Numbers of size one without a pattern.
fn ripple(patch: usize, k: usize) -> f64 {
    (12.9898 * patch as f64 + 78.233 * k as f64).sin()
}
