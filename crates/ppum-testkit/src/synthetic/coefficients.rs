//! Blocks and coefficients of synthetic fields.

use super::components::SyntheticComponents;
use super::recipe::{Coefficients, Junction, Recipe};
use crate::random::Random;
use ppum::crack::{Crack, End, LocalCrack, Side};
use ppum::dataset::{BoxPartition, FieldData, monomials};
use ppum::edge::Edge;
use ppum::function::{Function, FunctionKind, FunctionTable, GROUP, Slot};
use ppum::jet::Jet;
use ppum::polynomial::exponents;
use ppum::vec2::{Rect, Vec2, vec2};

/// Factor of tip function `k` of a tip in [`Coefficients::Taylor`].
#[must_use]
pub fn amplitude(tip: usize, k: usize, component: usize) -> f64 {
    0.3 * (1.7 * (tip + 1) as f64 + 2.3 * k as f64 + 1.1 * component as f64).sin()
}

/// Size of component `k` at a junction in [`Coefficients::Taylor`]: a tenth of the field, as cracks
/// open under strains of size one.
#[must_use]
pub fn level(junction: usize, k: usize, component: usize) -> f64 {
    0.1 * (0.7 + 1.3 * junction as f64 + 1.9 * k as f64 + 0.6 * component as f64).sin()
}

/// The smooth part of a component in [`Coefficients::Taylor`]: sin(a x + b y + c).
#[must_use]
pub fn smooth(component: usize, p: Vec2) -> Jet<f64> {
    let (a, b) = (1.3 + 0.4 * component as f64, 0.9 - 0.5 * component as f64);
    let (s, c) = (a * p.x + b * p.y + component as f64).sin_cos();
    Jet { v: s, x: a * c, y: b * c, xx: -a * a * s, xy: -a * b * s, yy: -b * b * s }
}

/// 1 within `zone` of a tip, falling smoothly to 0 at twice that: beyond the other end of the crack
/// a tip's functions would go on jumping. `d` is the point minus the tip.
#[must_use]
pub fn cut_off(d: Vec2, zone: f64) -> Jet<f64> {
    let scale = 1.0 / (3.0 * zone * zone);
    let q = (d.dot(d) - zone * zone) * scale;
    if !(0.0..1.0).contains(&q) {
        return Jet::constant(if q < 0.0 { 1.0 } else { 0.0 });
    }
    let (x, y, second) = (2.0 * d.x * scale, 2.0 * d.y * scale, 2.0 * scale);
    let q = Jet { v: q, x, y, xx: second, xy: 0.0, yy: second };
    let square = q.times::<2>(q);
    let factor =
        square.scaled::<2>(6.0).minus::<2>(q.scaled::<2>(15.0)).plus::<2>(Jet::constant(10.0));
    Jet::constant(1.0).minus::<2>(square.times::<2>(q).times::<2>(factor))
}

pub(super) fn field(
    recipe: &Recipe,
    partition: &BoxPartition,
    functions: &[Function],
) -> FieldData {
    let all = ["ux", "uy", "uz", "uw", "up", "uq"];
    let names = if recipe.components == 1 { &["u"][..] } else { &all };
    let name = if recipe.components == 1 { "potential" } else { "displacement" };
    let data = FieldData::new(name, &names[..recipe.components]);
    let table =
        FunctionTable::new(functions, recipe.cracks.len(), &[]).expect("functions of a recipe");
    let random = Random(recipe.seed ^ 0xc0ef);
    let around = around(recipe);
    let next = first_indicator(recipe);
    let mut maker = CoefficientMaker { recipe, partition, table, data, random, around, next };
    for patch in 0..partition.len() {
        maker.add_patch(patch);
        maker.data.patch_blocks.push(maker.data.block_function.len() as u32);
    }
    maker.data
}

struct CoefficientMaker<'a> {
    recipe: &'a Recipe,
    partition: &'a BoxPartition,
    table: FunctionTable,
    data: FieldData,
    random: Random,
    /// The components of the boxes around junctions.
    around: Vec<SyntheticComponents>,
    /// The function of the next patch's first component.
    next: u32,
}

/// The components of the boxes around junctions.
pub(super) fn around(recipe: &Recipe) -> Vec<SyntheticComponents> {
    let components = |place: &Junction| {
        let bounds = Rect::around(place.center, vec2(place.radius, place.radius));
        SyntheticComponents::new(&recipe.cracks, &cutting(recipe, &bounds), &bounds)
    };
    recipe.junctions.iter().map(components).collect()
}

/// The number of the first function of a component.
fn first_indicator(recipe: &Recipe) -> u32 {
    (1 + recipe.cracks.len() + 4 * recipe.tips().count() + recipe.extra.len()) as u32
}

/// The cracks that cut a box through: none of their tips lies in it.
fn cutting(recipe: &Recipe, bounds: &Rect) -> Vec<u32> {
    let bounds = bounds.intersection(&recipe.domain);
    let cracks = (0..).zip(&recipe.cracks);
    cracks.filter(|(_, crack)| cuts_through(crack, &bounds)).map(|(k, _)| k).collect()
}

/// The components of a patch that has functions of them: its cracks leave more than the two that a
/// side tells apart, or two cracks leave two.
fn components(
    recipe: &Recipe,
    partition: &BoxPartition,
    patch: usize,
) -> Option<SyntheticComponents> {
    if recipe.junctions.is_empty() || !recipe.jumps {
        return None;
    }
    let support = partition.support(patch).intersection(&recipe.domain);
    let cracks = cutting(recipe, &support);
    let components = SyntheticComponents::new(&recipe.cracks, &cracks, &support);
    let count = components.count();
    (count > 2 || count == 2 && cracks.len() > 1).then_some(components)
}

/// The functions of the components of all patches but the first of each.
pub(super) fn indicators(recipe: &Recipe, partition: &BoxPartition) -> Vec<Function> {
    let mut all = Vec::new();
    for patch in 0..partition.len() {
        let Some(components) = components(recipe, partition, patch) else { continue };
        all.extend((1..components.count()).map(|k| Function {
            name: format!("component {k} of patch {patch}"),
            kind: FunctionKind::Component { cuts: components.indicator(k) },
        }));
    }
    all
}

/// A crack that cuts a patch through, and half the jump of the field there, expanded about `at`.
struct PatchCut {
    crack: u32,
    at: Vec2,
    half_jump: Vec<Jet<f64>>,
}

impl CoefficientMaker<'_> {
    fn add_patch(&mut self, patch: usize) {
        let degree = self.recipe.degrees[patch % self.recipe.degrees.len()];
        let center = self.partition.center[patch];
        let near: Vec<bool> = (self.recipe.tips())
            .map(|tip| (self.recipe.position(tip) - center).length() < self.recipe.zone)
            .collect();
        match components(self.recipe, self.partition, patch) {
            Some(components) => self.add_components(patch, degree, &components, &near),
            None => self.add_sides(patch, degree, &near),
        }
        self.add_tips(patch, &near);
        self.add_extra(patch);
    }

    /// The smooth block is the field on the first component; those of the others are what the field
    /// differs by there.
    fn add_components(
        &mut self,
        patch: usize,
        degree: u8,
        components: &SyntheticComponents,
        near: &[bool],
    ) {
        let center = self.partition.center[patch];
        let on = |k: usize| {
            let at = components.middle(k);
            let jets = self.remainder(at, Vec2::ZERO, near);
            jets.iter().map(|jet| moved(jet, center - at)).collect::<Vec<_>>()
        };
        let all: Vec<_> = (0..components.count()).map(on).collect();
        self.add_polynomial(patch, 0, degree, center, &all[0]);
        for of in &all[1..] {
            let less = |(a, b): (&Jet<f64>, &Jet<f64>)| a.minus::<2>(*b);
            let jump: Vec<_> = of.iter().zip(&all[0]).map(less).collect();
            self.add_polynomial(patch, self.next, degree, center, &jump);
            self.next += 1;
        }
    }

    fn add_sides(&mut self, patch: usize, degree: u8, near: &[bool]) {
        let center = self.partition.center[patch];
        let cuts = self.cuts(patch, near);
        let mut rest = self.remainder(center, Vec2::ZERO, near);
        for cut in &cuts {
            let crack = &self.recipe.cracks[cut.crack as usize];
            let side = LocalCrack::new(crack, center).side([0.0; 2], Side::Above);
            for (rest, jump) in rest.iter_mut().zip(&cut.half_jump) {
                *rest = rest.minus::<2>(moved(jump, center - cut.at).scaled::<2>(side));
            }
        }
        self.add_polynomial(patch, 0, degree, center, &rest);
        for cut in &cuts {
            self.add_polynomial(patch, 1 + cut.crack, degree, cut.at, &cut.half_jump);
        }
    }

    fn add_tips(&mut self, patch: usize, near: &[bool]) {
        let (first, degree) = (1 + self.recipe.cracks.len(), self.recipe.tip_degree);
        for (tip, k) in (0..4 * near.len()).map(|f| (f / 4, f % 4)).filter(|&(tip, _)| near[tip]) {
            self.begin_block((first + 4 * tip + k) as u32, degree);
            for component in 0..self.recipe.components {
                for m in 0..monomials(degree.into()) {
                    let value = match (&self.recipe.coefficients, m) {
                        (Coefficients::Random, _) => self.random.between(-1.0, 1.0),
                        (Coefficients::Taylor, 0) => amplitude(tip, k, component),
                        (Coefficients::Taylor, _) => 0.01 * ripple(patch, k + m),
                        (Coefficients::Polynomial(_), _) => 0.0,
                    };
                    self.data.coefficients[component].push(value);
                }
            }
        }
    }

    fn add_extra(&mut self, patch: usize) {
        let count = self.recipe.extra.len();
        if count == 0 || !patch.is_multiple_of(3) {
            return;
        }
        let first = 1 + self.recipe.cracks.len() + 4 * self.recipe.tips().count();
        self.begin_block((first + patch / 3 % count) as u32, 1);
        let size = match self.recipe.coefficients {
            Coefficients::Random => 1.0,
            Coefficients::Taylor => 0.01,
            Coefficients::Polynomial(_) => 0.0,
        };
        for coefficients in &mut self.data.coefficients {
            coefficients.extend((0..3).map(|_| size * self.random.between(-1.0, 1.0)));
        }
    }

    fn begin_block(&mut self, function: u32, degree: u8) {
        self.data.block_function.push(function);
        self.data.block_degree.push(degree);
        self.data.block_offset.push(self.data.coefficients[0].len() as u64);
    }

    /// A block whose polynomial has given jets at a point, unless the recipe wants
    /// other coefficients.
    fn add_polynomial(
        &mut self,
        patch: usize,
        function: u32,
        degree: u8,
        at: Vec2,
        jets: &[Jet<f64>],
    ) {
        self.begin_block(function, degree);
        let count = monomials(degree.into());
        let (origin, scale) = (self.partition.origin[patch], self.partition.scale[patch]);
        for (component, coefficients) in self.data.coefficients.iter_mut().enumerate() {
            match &self.recipe.coefficients {
                Coefficients::Random => {
                    coefficients.extend((0..count).map(|_| self.random.between(-1.0, 1.0)));
                }
                Coefficients::Taylor => {
                    let head = taylor(&moved(&jets[component], origin - at), scale);
                    let size = scale.x * scale.y * scale.x.max(scale.y);
                    let tail = (head.len()..count).map(|k| size * ripple(patch, k));
                    coefficients.extend(head.into_iter().chain(tail).take(count));
                }
                Coefficients::Polynomial(all) => {
                    let global: &[f64] = if function == 0 { &all[component] } else { &[] };
                    let from = origin - self.recipe.domain.center();
                    coefficients.extend(expanded(global, degree.into(), from, scale));
                }
            }
        }
    }

    /// The cracks that cut a patch through: none of their tips lies in its open box.
    fn cuts(&self, patch: usize, near: &[bool]) -> Vec<PatchCut> {
        if !self.recipe.jumps {
            return Vec::new();
        }
        let support = self.partition.support(patch).intersection(&self.recipe.domain);
        let cut = |index: u32| {
            let crack = &self.recipe.cracks[index as usize];
            let (at, normal) = nearest(crack, self.partition.center[patch]);
            let step = normal * (1e-9 * support.size().x);
            let (above, below) = (self.remainder(at, step, near), self.remainder(at, -step, near));
            let half = |(a, b): (&Jet<f64>, &Jet<f64>)| a.minus::<2>(*b).scaled::<2>(0.5);
            PatchCut { crack: index, at, half_jump: above.iter().zip(&below).map(half).collect() }
        };
        cutting(self.recipe, &support).into_iter().map(cut).collect()
    }

    /// The field without the functions of the tips that are near, at a point a small step away.
    fn remainder(&self, at: Vec2, step: Vec2, near: &[bool]) -> Vec<Jet<f64>> {
        let mut jets: Vec<_> = (0..self.recipe.components).map(|c| smooth(c, at)).collect();
        if !matches!(self.recipe.coefficients, Coefficients::Taylor) {
            return jets;
        }
        self.add_levels(at + step, &mut jets);
        if near.iter().all(|&n| n) {
            return jets;
        }
        let functions = self.table.at(&self.recipe.cracks, at);
        let first = 1 + self.recipe.cracks.len();
        let zone = self.recipe.zone;
        let share = |id| cut_off(at + step - self.recipe.position(id), zone);
        let shares: Vec<_> = self.recipe.tips().map(share).collect();
        for (tip, k) in (0..4 * near.len()).map(|f| (f / 4, f % 4)).filter(|&(tip, _)| !near[tip]) {
            let Slot::Jet { group, entry } = self.table.of((first + 4 * tip + k) as u32) else {
                continue;
            };
            let mut f = [Jet::constant(0.0); GROUP];
            functions.evaluate::<f64, 2>(group as usize, step.into(), Side::Above, &mut f);
            let f = f[entry as usize].times::<2>(shares[tip]);
            for (component, jet) in jets.iter_mut().enumerate() {
                *jet = jet.plus::<2>(f.scaled::<2>(amplitude(tip, k, component)));
            }
        }
        jets
    }

    /// Adds what the field has on the components at junctions.
    fn add_levels(&self, p: Vec2, jets: &mut [Jet<f64>]) {
        for (junction, (place, components)) in
            self.recipe.junctions.iter().zip(&self.around).enumerate()
        {
            let (share, k) =
                (cut_off(p - place.center, 0.5 * place.radius), components.containing(p));
            for (component, jet) in jets.iter_mut().enumerate() {
                *jet = jet.plus::<2>(share.scaled::<2>(level(junction, k, component)));
            }
        }
    }
}

/// A quadratic polynomial, given by its jet at a point, at another point.
fn moved(jet: &Jet<f64>, d: Vec2) -> Jet<f64> {
    let x = jet.x + jet.xx * d.x + jet.xy * d.y;
    let y = jet.y + jet.xy * d.x + jet.yy * d.y;
    let v = jet.v + 0.5 * ((jet.x + x) * d.x + (jet.y + y) * d.y);
    Jet { v, x, y, ..*jet }
}

/// Coefficients of ξ = (x − origin) / scale of a quadratic polynomial with a given jet at
/// the origin.
fn taylor(jet: &Jet<f64>, s: Vec2) -> [f64; 6] {
    let (xx, yy) = (0.5 * jet.xx * s.x * s.x, 0.5 * jet.yy * s.y * s.y);
    [jet.v, jet.x * s.x, jet.y * s.y, xx, jet.xy * s.x * s.y, yy]
}

/// Coefficients of Σ c x^a y^b in ξ where (x, y) = from + scale ξ, by the binomial theorem.
fn expanded(global: &[f64], degree: usize, from: Vec2, scale: Vec2) -> Vec<f64> {
    let mut local = vec![0.0; monomials(degree)];
    for ((a, b), c) in exponents(degree).zip(global) {
        for (i, j) in (0..=a).flat_map(|i| (0..=b).map(move |j| (i, j))) {
            let x = binomial(a, i) * from.x.powi(a - i) * scale.x.powi(i);
            let y = binomial(b, j) * from.y.powi(b - j) * scale.y.powi(j);
            local[monomials((i + j) as usize) - 1 - i as usize] += c * x * y;
        }
    }
    local
}

fn binomial(n: i32, k: i32) -> f64 {
    (0..k).map(|i| f64::from(n - i) / f64::from(i + 1)).product()
}

/// Numbers of size one without a pattern.
fn ripple(patch: usize, k: usize) -> f64 {
    (12.9898 * patch as f64 + 78.233 * k as f64).sin()
}

fn cuts_through(crack: &Crack, support: &Rect) -> bool {
    let inside = |p: Vec2| {
        p.x > support.min.x && p.x < support.max.x && p.y > support.min.y && p.y < support.max.y
    };
    let tip_inside = crack.tips().any(|end: End| inside(crack.end_point(end)));
    !tip_inside && crack.edges().any(|edge| !edge.within(support).is_empty())
}

/// The point of a crack nearest to `p`, and the left normal there.
fn nearest(crack: &Crack, p: Vec2) -> (Vec2, Vec2) {
    let on_edge = |edge: Edge| {
        let part = edge.closest_part(p);
        (edge.at(part), edge.tangent(part).left())
    };
    let closer =
        |a: &(Vec2, Vec2), b: &(Vec2, Vec2)| (a.0 - p).length().total_cmp(&(b.0 - p).length());
    crack.edges().map(on_edge).min_by(closer).expect("a crack has an edge")
}
