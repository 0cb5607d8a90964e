//! A centre crack that nobody had to solve: Westergaard's solution (1939), expanded about each patch.
//!
//! ```text
//! 2μ u_x = (κ − 1)/2 Re f − y Im f'      2μ u_y = (κ + 1)/2 Im f − y Re f'      f = √(z² − a²)
//! ```
//!
//! is the displacement of an infinite plate under unit tension from all sides. Patches on a quarter of the area,
//! those nearest to the tips, have the four tip functions, with the amplitudes of the expansion at the tip. What is
//! left is smooth but for a jump across the crack, and is expanded by Taylor's formula to order 2: about the centre,
//! or on both sides of a crack that crosses the patch. At a tip nothing is left to order r.

use std::f64::consts::FRAC_1_SQRT_2;

use num_complex::Complex64;
use ppum::cover::Cover;
use ppum::crack::{Crack, CrackEnd, End, Side, TipId};
use ppum::dataset::{Dataset, Equation, FieldData, Material, Partition, Step, StressState};
use ppum::function::{Frame, Function, FunctionKind, FunctionTable, Slot, WESTERGAARD};
use ppum::jet::Jet;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;

/// The plate: not centred at the crack, so that this lies on no border of cells.
pub(super) const DOMAIN: Rect =
    Rect { min: vec2(-0.6535, -0.4823), max: vec2(-0.6535 + 4.0 / 3.0, 0.5177) };

/// Half the crack's length.
const HALF: f64 = 0.2;
const TIPS: [Vec2; 2] = [vec2(-HALF, 0.0), vec2(HALF, 0.0)];

/// Young's modulus is 1.
const POISSON: f64 = 0.3;
const TWICE_MU: f64 = 1.0 / (1.0 + POISSON);
/// Kolosov's constant in plane strain.
const KAPPA: f64 = 3.0 - 4.0 * POISSON;

/// Functions of the table: one, the crack's side, then four of each tip.
const SIDE: u32 = 1;
const FIRST_TIP: u32 = 2;

/// A cover of 4^level cells, refined to `tip_level` at the tips.
pub(super) fn dataset(level: u8, tip_level: u8) -> anyhow::Result<Dataset> {
    let mut cover = Cover::uniform(DOMAIN, level)?;
    let near = |cell: Rect| TIPS.iter().any(|&tip| cell.contains(tip));
    while cover.refine(|cell, level| level < tip_level && near(cell))? > 0 {}
    let partition = cover.partition(1.3, WeightFunction::Linear)?;
    let crack = Crack { points: TIPS.to_vec(), ends: [CrackEnd::Tip; 2] };
    let functions = functions();
    let table = FunctionTable::new(&functions, 1, &[])?;
    let mut maker = Maker {
        cracks: [crack],
        table,
        partition,
        data: FieldData::new("displacement", &["ux", "uy"]),
    };
    maker.fill();
    let Maker { cracks, partition, data, .. } = maker;
    let mut step = Step::new(partition).with_field(data);
    (step.cracks, step.functions) = (cracks.into(), functions);
    Ok(wrap(step))
}

fn wrap(step: Step) -> Dataset {
    let material = Material { young: 1.0, poisson: POISSON, state: StressState::PlaneStrain };
    let mut dataset = Dataset::new(DOMAIN, Equation::elasticity(material)).with_step(step);
    dataset.title = "Centre crack in an infinite plate".to_owned();
    dataset.program = concat!("ppum ", env!("CARGO_PKG_VERSION")).to_owned();
    dataset
}

fn functions() -> Vec<Function> {
    let plain = |name: &str, kind| Function { name: name.to_owned(), kind };
    let mut all =
        vec![plain("one", FunctionKind::One), plain("side", FunctionKind::Side { crack: 0 })];
    for end in [End::Start, End::Last] {
        let frame = Frame::Tip(TipId { crack: 0, end });
        all.extend(WESTERGAARD.map(|text| plain(text, FunctionKind::formula(text, frame))));
    }
    all
}

/// Displacement with derivatives. On the crack the sign of a zero y tells the side.
fn displacement(p: Vec2) -> [Jet<f64>; 2] {
    let z = Complex64::new(p.x, p.y);
    let f = (z - HALF).sqrt() * (z + HALF).sqrt();
    let [f1, f2] = [z / f, -HALF * HALF / f.powi(3)];
    let f3 = 3.0 * HALF * HALF * z / f.powi(5);
    let y = Jet { y: 1.0, ..Jet::constant(p.y) };
    let i = Complex64::I;
    let [re, im] = [real([f, f1, f2]), real([-i * f, -i * f1, -i * f2])];
    let [re1, im1] = [real([f1, f2, f3]), real([-i * f1, -i * f2, -i * f3])];
    let of = |a: Jet<f64>, factor: f64, b: Jet<f64>| {
        a.scaled::<2>(factor).minus::<2>(y.times::<2>(b)).scaled::<2>(1.0 / TWICE_MU)
    };
    [of(re, (KAPPA - 1.0) / 2.0, im1), of(im, (KAPPA + 1.0) / 2.0, re1)]
}

/// The real part of an analytic function, from its value and two derivatives.
fn real([f, f1, f2]: [Complex64; 3]) -> Jet<f64> {
    Jet { v: f.re, x: f1.re, y: -f1.im, xx: f2.re, xy: -f2.im, yy: -f2.re }
}

/// Amplitudes of the tip functions at a tip, for u_x and u_y: √(a/2)/2μ times those of mode I.
fn amplitudes(tip: usize) -> [[f64; 4]; 2] {
    let size = HALF.sqrt() * FRAC_1_SQRT_2 / TWICE_MU;
    // the other tip is the same, turned by half a circle
    let k = if tip == 0 { -size } else { size };
    [[k * (KAPPA - 1.0), 0.0, k, 0.0], [0.0, k * (KAPPA + 1.0), 0.0, -k]]
}

fn nearest_tip(p: Vec2) -> usize {
    usize::from(p.x > 0.0)
}

struct Maker {
    cracks: [Crack; 1],
    table: FunctionTable,
    partition: Partition,
    data: FieldData,
}

impl Maker {
    fn fill(&mut self) {
        let enriched = self.enriched();
        for (patch, is_enriched) in enriched.into_iter().enumerate() {
            let tip = is_enriched.then(|| nearest_tip(self.partition.center[patch]));
            self.add_rest(patch, tip);
            if let Some(tip) = tip {
                self.add_tip(tip);
            }
            self.data.patch_blocks.push(self.data.block_function.len() as u32);
        }
    }

    /// The patches nearest to the tips whose cells make up a quarter of the area.
    fn enriched(&self) -> Vec<bool> {
        let Partition { center, cell, .. } = &self.partition;
        let distance = |patch: usize| (center[patch] - TIPS[nearest_tip(center[patch])]).length();
        let mut order: Vec<_> = (0..center.len()).map(|patch| (distance(patch), patch)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let area = |rect: &Rect| rect.size().x * rect.size().y;
        let mut left = 0.2499 * area(&DOMAIN);
        let mut enriched = vec![false; center.len()];
        for (_, patch) in order {
            enriched[patch] = left > 0.0;
            left -= area(&cell[patch]);
        }
        enriched
    }

    fn add_tip(&mut self, tip: usize) {
        for k in 0..4 {
            self.begin_block(FIRST_TIP + (4 * tip + k) as u32, 0);
            for (coefficients, amplitudes) in self.data.coefficients.iter_mut().zip(amplitudes(tip))
            {
                coefficients.push(amplitudes[k]);
            }
        }
    }

    /// The field without the tip functions.
    fn add_rest(&mut self, patch: usize, tip: Option<usize>) {
        let (center, support) = (self.partition.center[patch], self.partition.support(patch));
        if TIPS.iter().any(|&tip| support.contains(tip)) {
            self.add_taylor(patch, 0, center, [Jet::constant(0.0); 2]);
        } else if support.overlaps(&Rect::new(TIPS[0], TIPS[1])) {
            let at = vec2(center.x.clamp(-HALF, HALF), 0.0);
            let sides = [(0.0, Side::Above), (-0.0, Side::Below)];
            let [above, below] = sides.map(|(y, side)| self.rest(vec2(at.x, y), side, tip));
            let half = |share: f64| {
                [0, 1].map(|c| above[c].scaled::<2>(0.5).plus::<2>(below[c].scaled::<2>(share)))
            };
            self.add_taylor(patch, 0, at, half(0.5));
            self.add_taylor(patch, SIDE, at, half(-0.5));
        } else {
            self.add_taylor(patch, 0, center, self.rest(center, Side::Above, tip));
        }
    }

    /// The displacement without the functions of a tip.
    fn rest(&self, at: Vec2, side: Side, tip: Option<usize>) -> [Jet<f64>; 2] {
        let mut rest = displacement(at);
        let Some(tip) = tip else { return rest };
        let Slot::Jet { group, .. } = self.table.of(FIRST_TIP + 4 * tip as u32) else {
            return rest;
        };
        let mut functions = [Jet::constant(0.0); 4];
        let table = self.table.at(&self.cracks, at);
        table.evaluate::<f64, 2>(group as usize, [0.0; 2], side, &mut functions);
        for (rest, amplitudes) in rest.iter_mut().zip(amplitudes(tip)) {
            for (f, amplitude) in functions.iter().zip(amplitudes) {
                *rest = rest.minus::<2>(f.scaled::<2>(amplitude));
            }
        }
        rest
    }

    fn begin_block(&mut self, function: u32, degree: u8) {
        self.data.block_function.push(function);
        self.data.block_degree.push(degree);
        self.data.block_offset.push(self.data.coefficients[0].len() as u64);
    }

    /// A block of degree 2 with these values and derivatives at a point.
    fn add_taylor(&mut self, patch: usize, function: u32, at: Vec2, jets: [Jet<f64>; 2]) {
        self.begin_block(function, 2);
        let (d, s) = (self.partition.origin[patch] - at, self.partition.scale[patch]);
        for (coefficients, jet) in self.data.coefficients.iter_mut().zip(jets) {
            let x = jet.x + jet.xx * d.x + jet.xy * d.y;
            let y = jet.y + jet.xy * d.x + jet.yy * d.y;
            coefficients.extend([
                jet.v + 0.5 * ((jet.x + x) * d.x + (jet.y + y) * d.y),
                x * s.x,
                y * s.y,
                0.5 * jet.xx * s.x * s.x,
                jet.xy * s.x * s.y,
                0.5 * jet.yy * s.y * s.y,
            ]);
        }
    }
}

#[cfg(test)]
mod tests {
    use ppum::field::Field;

    use super::*;

    /// Local values u_y of all patches at a place.
    fn values(level: u8, p: Vec2) -> Vec<f64> {
        let dataset = dataset(level, level).unwrap();
        let field = Field::new(&dataset, 0).unwrap();
        let partition = &field.step.partition;
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

    /// Patches of half the size differ by an eighth where they meet, and all from the solution: far from the
    /// tips, with tip functions, and on both faces of the crack, here with tip functions, there without.
    #[test]
    fn patches_agree_to_third_order() {
        let corner = |i: u32, j: u32| DOMAIN.min + vec2(f64::from(i) / 12.0, f64::from(j) / 16.0);
        for p in [
            corner(2, 3),
            corner(9, 11),
            corner(11, 7),
            vec2(corner(7, 0).x, 1e-3),
            vec2(corner(9, 0).x, -1e-3),
        ] {
            let exact = displacement(p)[1].v;
            let [coarse, fine] = [5, 6].map(|level| values(level, p));
            assert!(coarse.len() >= 2 && fine.len() >= 2, "a border of patches");
            let ratio = span(&coarse) / span(&fine);
            assert!(ratio > 5.0, "{p:?}: {ratio}, in the limit 8");
            let error = fine.iter().map(|v| (v - exact).abs()).fold(0.0, f64::max);
            assert!(error < 3.0 * span(&fine), "{p:?}: {error}");
        }
    }

    /// A quarter of the area is enriched, and every patch that holds a tip is.
    #[test]
    fn a_quarter_is_enriched() {
        for (level, tip_level) in [(2, 2), (4, 4), (5, 5), (3, 9)] {
            let dataset = dataset(level, tip_level).unwrap();
            let Step { partition, fields, .. } = &dataset.steps[0];
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
}
