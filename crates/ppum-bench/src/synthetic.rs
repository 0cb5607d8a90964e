//! A centre crack that nobody had to solve: Westergaard's solution (1939), expanded about
//! each patch.
//!
//! ```text
//! 2μ u_x = (κ − 1)/2 Re f − y Im f'      2μ u_y = (κ + 1)/2 Im f − y Re f'      f = √(z² − a²)
//! ```
//!
//! is the displacement of an infinite plate under unit tension from all sides. The patches nearest
//! to the tips, on a part of the area, have the four tip functions, with the amplitudes of the
//! expansion at the tip: these are the displacement that √(2a(z − a)) has in place of f. The
//! remainder of f is expanded into a power series, about the patch's centre, or on both sides of a
//! crack that crosses the patch. At a tip nothing is left to order r.

use std::f64::consts::FRAC_1_SQRT_2;

use num_complex::Complex64;
use ppum::cover::Cover;
use ppum::crack::{Crack, CrackEnd, End, TipId};
use ppum::dataset::{BoxPartition, Dataset, Equation, FieldData, Material, Step, StressState};
use ppum::formula::Scope;
use ppum::function::{Frame, Function, FunctionKind, WESTERGAARD};
use ppum::polynomial::exponents;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;

/// The plate: not centred at the crack, so that this lies on no border of cells.
pub const DOMAIN: Rect =
    Rect { min: vec2(-0.6535, -0.4823), max: vec2(-0.6535 + 4.0 / 3.0, 0.5177) };

/// Half the crack's length.
pub const HALF: f64 = 0.2;
/// Both tips.
pub const TIPS: [Vec2; 2] = [vec2(-HALF, 0.0), vec2(HALF, 0.0)];

/// Young's modulus is 1.
const POISSON: f64 = 0.3;
/// 2μ.
pub const TWICE_MU: f64 = 1.0 / (1.0 + POISSON);
/// Kolosov's constant in plane strain.
pub const KAPPA: f64 = 3.0 - 4.0 * POISSON;

/// Functions of the table: one, the crack's side, then four of each tip.
const SIDE: u32 = 1;
/// The first of the tip functions in the table.
pub const FIRST_TIP: u32 = 2;

/// A dataset of the crack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CrackRecipe {
    /// The cover has 4^level cells, refined to `tip_level` at the tips.
    pub level: u8,
    /// Level of the cells at the tips.
    pub tip_level: u8,
    /// Order of the polynomials.
    pub order: u8,
    /// The part of the area that has tip functions.
    pub enriched: f64,
    /// The weight's formula of t; linear if there is none.
    pub weight: Option<&'static str>,
}

impl CrackRecipe {
    /// The solution of the paper: order 2, a quarter enriched, linear weights.
    pub const fn new(level: u8, tip_level: u8) -> Self {
        Self { level, tip_level, order: 2, enriched: 0.25, weight: None }
    }

    /// The dataset.
    ///
    /// # Errors
    /// A cover that there cannot be, or a weight that is no formula.
    pub fn dataset(&self) -> anyhow::Result<Dataset> {
        let partition = self.cover()?.partition(1.3, self.weight()?)?;
        let data = FieldData::new("displacement", &["ux", "uy"]);
        let mut maker = FieldMaker { order: self.order, partition, data };
        maker.fill(self.enriched);
        let FieldMaker { partition, data, .. } = maker;
        let mut step = Step::new(partition).with_field(data);
        step.cracks = vec![Crack::polyline(TIPS.to_vec(), [CrackEnd::Tip; 2])];
        step.functions = functions();
        Ok(wrap(step))
    }

    fn cover(&self) -> anyhow::Result<Cover> {
        let mut cover = Cover::uniform(DOMAIN, self.level)?;
        let near = |cell: Rect| TIPS.iter().any(|&tip| cell.contains(tip));
        while cover.refine(|cell, level| level < self.tip_level && near(cell))? > 0 {}
        Ok(cover)
    }

    /// The weight function.
    fn weight(&self) -> anyhow::Result<WeightFunction> {
        let Some(text) = self.weight else { return Ok(WeightFunction::Linear) };
        Ok(WeightFunction::formula(text, &Scope::new(&["t"])?)?)
    }
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

/// An analytic function about a place: coefficients of the powers of ζ = z − place.
type AnalyticSeries = Vec<Complex64>;

/// The root of a polynomial of degree 2 in ζ, whose value at ζ = 0 is `value`.
fn root(square: [Complex64; 3], value: Complex64, terms: usize) -> AnalyticSeries {
    let mut series = vec![value];
    for n in 1..terms {
        let products: Complex64 = (1..n).map(|k| series[k] * series[n - k]).sum();
        let wanted = square.get(n).copied().unwrap_or_default();
        series.push((wanted - products) / (2.0 * value));
    }
    series
}

/// f about a place, less that of a tip. On the crack the sign of a zero y tells the side.
fn rest(at: Complex64, tip: Option<usize>, terms: usize) -> AnalyticSeries {
    let (left, right) = (at + HALF, at - HALF);
    let value = right.sqrt() * left.sqrt();
    let mut series = root([right * left, 2.0 * at, 1.0.into()], value, terms);
    let Some(tip) = tip else { return series };
    // the other tip is the same, turned by half a circle
    let (sign, from_tip) = if tip == 0 { (-1.0, -left) } else { (1.0, right) };
    let square = [2.0 * HALF * from_tip, (sign * 2.0 * HALF).into(), 0.0.into()];
    let of_tip = root(square, sign * (2.0 * HALF).sqrt() * from_tip.sqrt(), terms);
    series.iter_mut().zip(of_tip).for_each(|(f, t)| *f -= t);
    series
}

/// Returns the polynomial about a place that lies elsewhere by `by`.
fn shifted(mut series: AnalyticSeries, by: Complex64) -> AnalyticSeries {
    for first in 0..series.len() {
        for k in (first..series.len() - 1).rev() {
            let next = series[k + 1];
            series[k] += by * next;
        }
    }
    series
}

/// The coefficient of x^a y^b in a series of ζ = x + iy; zero where there is none.
fn monomial(series: &[Complex64], a: i32, b: i32) -> Complex64 {
    let Some(c) = (b >= 0).then(|| series.get((a + b) as usize)).flatten() else {
        return Complex64::ZERO;
    };
    let choose = (1..=b).fold(1.0, |product, k| product * f64::from(a + k) / f64::from(k));
    choose * c * Complex64::I.powi(b)
}

/// Displacement about a place at height y, as polynomials of so many an order.
fn displacement(f: &[Complex64], y: f64, order: u8) -> [Vec<f64>; 2] {
    let slope: AnalyticSeries = f.iter().zip(0..).skip(1).map(|(c, n)| c * f64::from(n)).collect();
    let mut all = [Vec::new(), Vec::new()];
    for (a, b) in exponents(order.into()) {
        let here = monomial(f, a, b);
        let arm = y * monomial(&slope, a, b) + monomial(&slope, a, b - 1);
        all[0].push(((KAPPA - 1.0) / 2.0 * here.re - arm.im) / TWICE_MU);
        all[1].push(((KAPPA + 1.0) / 2.0 * here.im - arm.re) / TWICE_MU);
    }
    all
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

struct FieldMaker {
    order: u8,
    partition: BoxPartition,
    data: FieldData,
}

impl FieldMaker {
    fn fill(&mut self, share: f64) {
        let enriched = self.enriched(share);
        for (patch, is_enriched) in enriched.into_iter().enumerate() {
            let tip = is_enriched.then(|| nearest_tip(self.partition.center[patch]));
            self.add_rest(patch, tip);
            if let Some(tip) = tip {
                self.add_tip(tip);
            }
            self.data.patch_blocks.push(self.data.block_function.len() as u32);
        }
    }

    /// The patches nearest to the tips whose cells make up a share of the area.
    fn enriched(&self, share: f64) -> Vec<bool> {
        let BoxPartition { center, cell, .. } = &self.partition;
        let distance = |patch: usize| (center[patch] - TIPS[nearest_tip(center[patch])]).length();
        let mut order: Vec<_> = (0..center.len()).map(|patch| (distance(patch), patch)).collect();
        order.sort_by(|a, b| a.0.total_cmp(&b.0));
        let area = |rect: &Rect| rect.size().x * rect.size().y;
        // less than the smallest cell is what sums of areas are off by rounding
        let mut left = (share - 1e-9) * area(&DOMAIN);
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
        let terms = usize::from(self.order) + 1;
        if TIPS.iter().any(|&tip| support.contains(tip)) {
            self.add_polynomial(patch, 0, &vec![Complex64::ZERO; terms]);
        } else if support.overlaps(&Rect::new(TIPS[0], TIPS[1])) {
            let x = center.x.clamp(-HALF, HALF);
            let about = |y| shifted(rest(Complex64::new(x, y), tip, terms), complex(center) - x);
            let (above, below) = (about(0.0), about(-0.0));
            let half = |share: f64| -> AnalyticSeries {
                above.iter().zip(&below).map(|(a, b)| 0.5 * a + share * b).collect()
            };
            self.add_polynomial(patch, 0, &half(0.5));
            self.add_polynomial(patch, SIDE, &half(-0.5));
        } else {
            // one more for the slope of f, which y multiplies
            self.add_polynomial(patch, 0, &rest(complex(center), tip, terms + 1));
        }
    }

    fn begin_block(&mut self, function: u32, degree: u8) {
        self.data.block_function.push(function);
        self.data.block_degree.push(degree);
        self.data.block_offset.push(self.data.coefficients[0].len() as u64);
    }

    /// A block with the displacement of a series about the patch's centre.
    fn add_polynomial(&mut self, patch: usize, function: u32, series: &[Complex64]) {
        self.begin_block(function, self.order);
        let (y, s) = (self.partition.center[patch].y, self.partition.scale[patch]);
        let all = displacement(series, y, self.order);
        for (coefficients, polynomial) in self.data.coefficients.iter_mut().zip(all) {
            let scaled = exponents(self.order.into()).zip(polynomial);
            coefficients.extend(scaled.map(|((a, b), c)| c * s.x.powi(a) * s.y.powi(b)));
        }
    }
}

fn complex(p: Vec2) -> Complex64 {
    Complex64::new(p.x, p.y)
}
