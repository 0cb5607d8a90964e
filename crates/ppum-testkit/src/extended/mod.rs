//! Evaluation of datasets in double-double arithmetic (some 31 digits), for comparison.
//!
//! Written from the definition of the field, in other terms than the evaluator of `ppum`: absolute
//! coordinates of 106 bits, derivatives by dual numbers, φ_i one by one, powers of ξ, sides of
//! cracks by counting how often a ray crosses them, components by walking down their trees. Slow:
//! every patch is looked at.

mod double;
pub mod elementary;

pub use double::DoubleDouble;
use double::operators;
use ppum::crack::{Crack, End, TipId};
use ppum::dataset::{Dataset, FieldData, Material, Step, StressState};
use ppum::edge::Edge;
use ppum::function::{Cut, CutBranch, Frame, FunctionKind, WESTERGAARD};
use ppum::polynomial::exponents;
use ppum::vec2::Vec2;
use ppum::weight::WeightFunction;
use std::ops::{Add, Div, Mul, Neg, Sub};

/// A point of 2 × 106 bits.
pub type ExtendedPoint = [DoubleDouble; 2];

/// The exact sum of an anchor and an offset.
#[must_use]
pub fn point(anchor: Vec2, offset: Vec2) -> ExtendedPoint {
    [DoubleDouble::sum(anchor.x, offset.x), DoubleDouble::sum(anchor.y, offset.y)]
}

/// A value and its gradient.
#[derive(Clone, Copy, Debug)]
pub struct Dual {
    /// f
    pub v: DoubleDouble,
    /// ∂f/∂x
    pub x: DoubleDouble,
    /// ∂f/∂y
    pub y: DoubleDouble,
}

impl Dual {
    /// A constant.
    #[must_use]
    pub fn constant(v: impl Into<DoubleDouble>) -> Self {
        Self { v: v.into(), x: 0.0.into(), y: 0.0.into() }
    }

    /// g(f) where g has value `v` and derivative `slope` at f.
    fn chain(self, v: DoubleDouble, slope: DoubleDouble) -> Self {
        Self { v, x: slope * self.x, y: slope * self.y }
    }

    /// A function of a and b with value `v` and derivatives `p` by a and `q` by b.
    fn chain_of_two(
        v: DoubleDouble,
        (a, p): (Self, DoubleDouble),
        (b, q): (Self, DoubleDouble),
    ) -> Self {
        Self { v, x: p * a.x + q * b.x, y: p * a.y + q * b.y }
    }

    fn sqrt(self) -> Self {
        let v = self.v.sqrt();
        self.chain(v, DoubleDouble::from(0.5) / v)
    }

    fn powi(self, n: i32) -> Self {
        (0..n).fold(Self::constant(1.0), |product, _| product * self)
    }
}

operators! {
    Dual:
    Add add |a, b: Dual| Self { v: a.v + b.v, x: a.x + b.x, y: a.y + b.y };
    Sub sub |a, b: Dual| Self { v: a.v - b.v, x: a.x - b.x, y: a.y - b.y };
    Neg neg |a| Self { v: -a.v, x: -a.x, y: -a.y };
    Mul mul |a, b: Dual| Self::chain_of_two(a.v * b.v, (a, b.v), (b, a.v));
    Mul mul |a, b: f64| Self { v: a.v * b, x: a.x * b, y: a.y * b };
    Div div |a, b: Dual| {
        let v = a.v / b.v;
        Self::chain_of_two(v, (a, DoubleDouble::from(1.0) / b.v), (b, -(v / b.v)))
    };
}

/// The first field of a step of a dataset.
#[derive(Clone, Copy, Debug)]
pub struct ExtendedField<'d> {
    step: &'d Step,
    data: &'d FieldData,
}

impl<'d> ExtendedField<'d> {
    /// The first field of a step.
    #[must_use]
    pub fn new(dataset: &'d Dataset, step: usize) -> Self {
        let step = &dataset.steps[step];
        Self { step, data: &step.fields[0] }
    }

    /// The components of the field at a point of the domain that is on no crack.
    ///
    /// # Panics
    /// If a patch there has a formula that is no Westergaard function.
    #[must_use]
    pub fn evaluate(&self, p: ExtendedPoint) -> Vec<Dual> {
        let weights: Vec<_> = (0..self.step.partition.len())
            .filter_map(|patch| Some((patch, self.weight(patch, p)?)))
            .collect();
        let sum = weights.iter().fold(Dual::constant(0.0), |sum, &(_, w)| sum + w);
        let mut u = vec![Dual::constant(0.0); self.data.coefficients.len()];
        for (patch, weight) in weights {
            let phi = weight / sum;
            for (component, u) in u.iter_mut().enumerate() {
                *u = *u + phi * self.local_field(patch, component, p);
            }
        }
        u
    }

    /// W_i, if the patch covers the point.
    fn weight(&self, patch: usize, p: ExtendedPoint) -> Option<Dual> {
        let partition = self.step.partition.boxes();
        let s = scaled(p, partition.center[patch], partition.half[patch]);
        let covers = s.iter().all(|s| s.v >= -1.0 && s.v < 1.0);
        covers.then(|| spline(&partition.weight, s[0]) * spline(&partition.weight, s[1]))
    }

    fn local_field(&self, patch: usize, component: usize, p: ExtendedPoint) -> Dual {
        let partition = self.step.partition.boxes();
        let [xi, eta] = scaled(p, partition.origin[patch], partition.scale[patch]);
        let mut v = Dual::constant(0.0);
        for block in self.data.blocks(patch) {
            let coefficients = self.data.block_coefficients(block, component);
            let degree = self.data.block_degree[block].into();
            let terms = exponents(degree).zip(coefficients);
            let polynomial = terms
                .fold(Dual::constant(0.0), |sum, ((a, b), &c)| sum + xi.powi(a) * eta.powi(b) * c);
            v = v + self.function(self.data.block_function[block], p) * polynomial;
        }
        v
    }

    fn function(&self, index: u32, p: ExtendedPoint) -> Dual {
        match &self.step.functions[index as usize].kind {
            FunctionKind::One => Dual::constant(1.0),
            FunctionKind::Side { crack } => {
                Dual::constant(side(&self.step.cracks[*crack as usize], p))
            }
            FunctionKind::Component { cuts } => {
                Dual::constant(indicator(cuts, &self.step.cracks, p))
            }
            FunctionKind::Formula { text, frame: Frame::Tip(tip), .. } => {
                let k = WESTERGAARD.iter().position(|known| known == text);
                self.westergaard(*tip, k.expect("a Westergaard function"), p)
            }
            other => panic!("no extended evaluation of {other:?}"),
        }
    }

    /// Real or imaginary part of √z, z = x + iy in the tip's frame, or that times sin θ = y / |z|.
    fn westergaard(&self, tip: TipId, k: usize, p: ExtendedPoint) -> Dual {
        let crack = &self.step.cracks[tip.crack as usize];
        let ahead = axis(crack, tip.end);
        let [dx, dy] = minus(p, crack.end_point(tip.end));
        let x = Dual { v: ahead[0] * dx + ahead[1] * dy, x: ahead[0], y: ahead[1] };
        let y = Dual { v: ahead[0] * dy - ahead[1] * dx, x: -ahead[1], y: ahead[0] };
        // Behind the tip the crack's left is the frame's left at the last vertex, its right at
        // the first.
        let left = if y.v >= 0.0 { 1.0 } else { -1.0 };
        let line = if tip.end == End::Last { left } else { -left };
        let [real, imaginary] = root(x, y);
        let part = if k == 0 || k == 3 { real } else { imaginary } * (line * side(crack, p));
        let sine = y / (x * x + y * y).sqrt();
        if k < 2 { part } else { part * sine }
    }
}

/// (p − origin) / scale
fn scaled(p: ExtendedPoint, origin: Vec2, scale: Vec2) -> [Dual; 2] {
    let [dx, dy] = minus(p, origin);
    let one = DoubleDouble::from(1.0);
    let (ix, iy) = (one / scale.x, one / scale.y);
    let zero = DoubleDouble::from(0.0);
    [Dual { v: dx * ix, x: ix, y: zero }, Dual { v: dy * iy, x: zero, y: iy }]
}

fn minus(p: ExtendedPoint, q: Vec2) -> ExtendedPoint {
    [p[0] - q.x, p[1] - q.y]
}

/// w(|s|); the derivative of |s| at 0 is +1. A weight by formula has the digits of f64: it
/// multiplies sums, and cancels nowhere.
fn spline(weight: &WeightFunction, s: Dual) -> Dual {
    let t = if s.v >= 0.0 { s } else { -s };
    let one = Dual::constant(1.0);
    let rest = one - t;
    match weight {
        WeightFunction::Linear => rest,
        WeightFunction::Quadratic if t.v * 3.0 <= 1.0 => one - t * t * 3.0,
        WeightFunction::Quadratic => rest * rest * 1.5,
        WeightFunction::Cubic if t.v <= 0.5 => one - t * t * 6.0 + t * t * t * 6.0,
        WeightFunction::Cubic => rest * rest * rest * 2.0,
        formula => {
            let [value, slope, _] = formula.spline(t.v.to_f64());
            t.chain(value.into(), slope.into())
        }
    }
}

/// Unit direction out of the crack at an end: the chord of its edge, turned by half of what that
/// turns.
fn axis(crack: &Crack, end: End) -> ExtendedPoint {
    let edge = match end {
        End::Start => crack.edge(0).reversed(),
        End::Last => crack.edge(crack.points.len() - 2),
    };
    let [x, y] = minus(point(edge.to, Vec2::ZERO), edge.from);
    let (bulge, length) = (DoubleDouble::from(edge.bulge), (x * x + y * y).sqrt());
    let one = DoubleDouble::from(1.0);
    let weight = (one + bulge * bulge) * length;
    let (cos, sin) = ((one - bulge * bulge) / weight, bulge * 2.0 / weight);
    [cos * x - sin * y, cos * y + sin * x]
}

/// Real and imaginary part of the principal square root of z = x + iy: Re √z = √((|z| + x)/2) and
/// Im √z = y / (2 Re √z) in the right half-plane, √z = ±i √−z in the left one.
fn root(x: Dual, y: Dual) -> [Dual; 2] {
    if x.v < 0.0 {
        let [real, imaginary] = root(-x, -y);
        return if y.v >= 0.0 { [-imaginary, real] } else { [imaginary, -real] };
    }
    let real = (((x * x + y * y).sqrt() + x) * 0.5).sqrt();
    [real, y / (real * 2.0)]
}

/// +1 left of a crack, −1 right of it. The crack and the tangents beyond its ends part the plane in
/// two; a ray from the point changes sides whenever it crosses. It crosses an arc as often as the
/// chord, and once more from between both.
#[must_use]
pub fn side(crack: &Crack, p: ExtendedPoint) -> f64 {
    let ray = [DoubleDouble::from(0.602_214_076), DoubleDouble::from(0.798_357_313)];
    let crosses = |from: Vec2, way: ExtendedPoint, is_endless: bool| {
        let to_start = minus(p, from).map(|c| -c);
        let denominator = cross(ray, way);
        let (along_ray, along) =
            (cross(to_start, way) / denominator, cross(to_start, ray) / denominator);
        along_ray > 0.0 && along >= 0.0 && (along < 1.0 || is_endless)
    };
    let of_edge = |edge: Edge| {
        let chord = minus(point(edge.to, Vec2::ZERO), edge.from);
        usize::from(crosses(edge.from, chord, false)) + usize::from(is_beside_chord(&edge, p))
    };
    let axes = [End::Start, End::Last].map(|end| (crack.end_point(end), axis(crack, end)));
    let rays = axes.map(|(end, axis)| usize::from(crosses(end, axis, true)));
    let crossings = crack.edges().map(of_edge).chain(rays).sum::<usize>();
    let far = far_side(axes[0].1, axes[1].1, ray);
    if crossings.is_multiple_of(2) { far } else { -far }
}

/// True between an arc and its chord: in the circle, and on the arc's side of the chord.
fn is_beside_chord(edge: &Edge, p: ExtendedPoint) -> bool {
    if !edge.is_arc() {
        return false;
    }
    let [dx, dy] = minus(point(edge.to, Vec2::ZERO), edge.from);
    let (bulge, one) = (DoubleDouble::from(edge.bulge), DoubleDouble::from(1.0));
    // from the first end to the centre
    let height = (one - bulge * bulge) / (bulge * 4.0);
    let center = [dx * 0.5 - dy * height, dy * 0.5 + dx * height];
    let from_start = minus(p, edge.from);
    let [x, y] = [from_start[0] - center[0], from_start[1] - center[1]];
    let is_inside = x * x + y * y < center[0] * center[0] + center[1] * center[1];
    is_inside && (cross([dx, dy], from_start) < 0.0) == (edge.bulge > 0.0)
}

/// 1 in the component of a tree of cuts, 0 outside: the areas of triangles of segments and the
/// point tell the way, of arcs the angle at the point, whose sine and cosine are in proportion.
///
/// # Panics
/// If a cut or a segment is not there.
#[must_use]
pub fn indicator(cuts: &[Cut], cracks: &[Crack], p: ExtendedPoint) -> f64 {
    let mut part = CutBranch::Cut(0);
    loop {
        let CutBranch::Cut(k) = part else {
            return if part == CutBranch::Inside { 1.0 } else { 0.0 };
        };
        let Cut { segment, left, right } = cuts[k as usize];
        let Edge { from, to, bulge } =
            cracks[segment.crack as usize].edge(segment.segment as usize);
        let (chord, from, to) = (minus(point(to, Vec2::ZERO), from), minus(p, from), minus(p, to));
        let (bulge, one) = (DoubleDouble::from(bulge), DoubleDouble::from(1.0));
        let angle = (one - bulge * bulge) * cross(chord, from)
            - bulge * 2.0 * (from[0] * to[0] + from[1] * to[1]);
        part = if angle >= 0.0 { left } else { right };
    }
}

/// The side far out in a direction: left is what lies anticlockwise between the crack's end
/// and start.
fn far_side(start: ExtendedPoint, end: ExtendedPoint, direction: ExtendedPoint) -> f64 {
    let (turn, to_start) = (angle(end, direction), angle(end, start));
    if turn < to_start { 1.0 } else { -1.0 }
}

/// Angle from a to b, anticlockwise, in [0, 2π).
fn angle(a: ExtendedPoint, b: ExtendedPoint) -> f64 {
    let (c, s) = ((a[0] * b[0] + a[1] * b[1]).to_f64(), cross(a, b).to_f64());
    s.atan2(c).rem_euclid(std::f64::consts::TAU)
}

fn cross(a: ExtendedPoint, b: ExtendedPoint) -> DoubleDouble {
    a[0] * b[1] - a[1] * b[0]
}

/// von Mises' stress √(3/2 s:s) of a displacement.
#[must_use]
pub fn von_mises(material: &Material, u: &[Dual]) -> DoubleDouble {
    let (e, nu) = (DoubleDouble::from(material.young), DoubleDouble::from(material.poisson));
    let one = DoubleDouble::from(1.0);
    let mu = e / ((one + nu) * 2.0);
    let (lambda, out) = match material.state {
        StressState::PlaneStrain | StressState::Axisymmetric => {
            (e * nu / ((one + nu) * (one - nu * 2.0)), nu)
        }
        StressState::PlaneStress => (e * nu / (one - nu * nu), DoubleDouble::from(0.0)),
    };
    let trace = u[0].x + u[1].y;
    let xx = mu * u[0].x * 2.0 + lambda * trace;
    let yy = mu * u[1].y * 2.0 + lambda * trace;
    let xy = mu * (u[0].y + u[1].x);
    let zz = out * (xx + yy);
    let mean = (xx + yy + zz) / 3.0;
    let (sx, sy, sz) = (xx - mean, yy - mean, zz - mean);
    ((sx * sx + sy * sy + sz * sz + xy * xy * 2.0) * 1.5).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::crack::CrackEnd;
    use ppum::vec2::vec2;

    /// (√z)² = z with its gradient, all round.
    #[test]
    fn roots() {
        for k in 0..48 {
            let (s, c) = (f64::from(k) / 48.0 * 6.2).sin_cos();
            let zero = DoubleDouble::from(0.0);
            let x = Dual { v: c.into(), x: 1.0.into(), y: zero };
            let y = Dual { v: s.into(), x: zero, y: 1.0.into() };
            let [re, im] = root(x, y);
            for rest in [re * re - im * im - x, re * im * 2.0 - y] {
                for rest in [rest.v, rest.x, rest.y] {
                    assert!(rest.to_f64().abs() < 1e-30);
                }
            }
        }
    }

    #[test]
    fn sides_by_crossings() {
        let points = [[-1.0, 1.0], [0.0, 0.0], [1.0, 1.0]].map(Vec2::from).to_vec();
        let mut v = Crack::polyline(points, [CrackEnd::Tip; 2]);
        for (p, expected) in
            [((0.0, 0.5), 1.0), ((0.0, -0.5), -1.0), ((-3.0, 0.0), -1.0), ((3.0, 4.0), 1.0)]
        {
            let p = point(vec2(p.0, p.1), Vec2::ZERO);
            v.points.sort_by(|a, b| a.x.total_cmp(&b.x));
            assert_eq!(side(&v, p), expected);
            v.points.reverse();
            assert_eq!(side(&v, p), -expected);
        }
    }

    /// Beside arcs of up to half a turn, at both ends and in the middle: tangents at the ends of
    /// longer ones meet, and what lies behind them has no side by crossings.
    #[test]
    fn sides_of_arcs_by_crossings() {
        for bulge in [-1.0, -0.3, -1e-9, 1e-9, 0.3, 1.0] {
            let points = [[-0.3, 0.1], [0.4, 0.2], [0.5, 0.9]].map(Vec2::from).to_vec();
            let crack = Crack { points, bulges: vec![bulge, 0.1], ends: [CrackEnd::Tip; 2] };
            for (edge, part) in crack.edges().flat_map(|edge| [0.1, 0.5, 0.97].map(|t| (edge, t))) {
                let normal = edge.tangent(part).left();
                for (step, expected) in [(1e-9, 1.0), (-1e-9, -1.0)] {
                    let p = point(edge.at(part), normal * step);
                    assert_eq!(side(&crack, p), expected, "{bulge} {part}");
                }
            }
        }
    }
}
