//! Gradients of quantities against differences and closed forms.

use crate::derivatives::smooth_place;
use crate::support::{compiled, patch_size};
use ppum::cover::Cover;
use ppum::crack::{Crack, CrackEnd, End, Side, TipId};
use ppum::dataset::{Dataset, FieldData, Step};
use ppum::equation::{Elasticity, Equation, Material, StressState};
use ppum::field::{Field, LocalField};
use ppum::function::{Frame, FunctionKind, WESTERGAARD};
use ppum::quantity::{Quantity, QuantityGradient, ValueWithGradient, names};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Coefficients, Recipe};

const FORMULAS: [&str; 5] = [
    "sxx*x - y^2*ux",
    "log(1 + energy)*young",
    "sqrt(ux^2 + duy_dx^2 + 1)",
    "exp(-magnitude)*poisson + lambda/mu",
    "out_of_plane*(sxx + syy)/(1 + von_mises)",
];

/// Derivative along `direction`: central differences with steps h, h/2, h/4, extrapolated twice;
/// and how far the last extrapolation went.
fn difference(
    quantity: &Quantity,
    local: &mut LocalField<'_>,
    offset: Vec2,
    direction: Vec2,
    h: f64,
) -> [f64; 2] {
    let mut at = |t: f64| quantity.at(local, offset + direction * t, Side::Above);
    let mut central = |h: f64| (at(h) - at(-h)) / (2.0 * h);
    let [a, b, c] = [central(h), central(h / 2.0), central(h / 4.0)];
    let (coarse, fine) = ((4.0 * b - a) / 3.0, (4.0 * c - b) / 3.0);
    [(16.0 * fine - coarse) / 15.0, (fine - coarse).abs()]
}

/// Every quantity of a field with its name: all that have one, one φ and some formulas.
fn quantities(field: &Field<'_>) -> Vec<(String, Quantity)> {
    let named = names(field.equation, &field.data.components).into_iter().map(|(name, _)| name);
    let formulas = FORMULAS.iter().filter(|_| field.components() == 2).map(|&t| t.to_owned());
    let all = named.chain(["phi:3".to_owned()]).chain(formulas);
    let parsed = all.filter_map(|name| Some((Quantity::parse(&name, field).ok()?, name)));
    parsed.filter(|(q, _)| q.check(field).is_ok()).map(|(q, name)| (name, q)).collect()
}

fn heterogeneous(state: StressState) -> Equation {
    let [young, poisson] = ["2 + sin(3*x)*cos(2*y)", "0.25 + 0.1*x*y/(1 + x^2)"];
    let parse = |text: &str| text.parse().expect("a formula");
    Equation::Elasticity(Elasticity {
        young: parse(young),
        poisson: parse(poisson),
        state,
        eigenstrain: None,
        anisotropy: None,
    })
}

/// Coefficients as a solver finds them, so that scales are known: u, its derivatives and the
/// stresses are about one.
fn datasets() -> Vec<Dataset> {
    let mut all = Vec::new();
    for (seed, weight) in (0..3).flat_map(|s| WeightFunction::ALL.map(|w| (s, w))) {
        let recipe = Recipe { weight, coefficients: Coefficients::Taylor, ..Recipe::random(seed) };
        let mut dataset = recipe.dataset();
        match seed {
            0 => dataset.equation = heterogeneous(StressState::PlaneStrain),
            1 => dataset.equation = heterogeneous(StressState::PlaneStress),
            _ => {}
        }
        dataset.steps[0].fields[0].exact = vec!["sin(x)*y".to_owned(), "x^2/(1 + y^2)".to_owned()];
        all.push(dataset);
    }
    let mut potential = Recipe { components: 1, ..Recipe::default() }.dataset();
    potential.equation = Equation::Poisson {
        conductivity: "1 + x^2*y".parse().expect("a formula"),
        axisymmetric: false,
    };
    all.push(potential);
    all.push(Recipe { components: 4, ..Recipe::default() }.dataset());
    all
}

#[test]
fn every_quantity_against_differences() {
    let (mut looked, mut sharp) = (0, 0);
    for dataset in datasets() {
        let field = compiled(&dataset);
        let mut random = Random(7);
        for (name, quantity) in quantities(&field) {
            let slope = QuantityGradient::new(&quantity, &field).expect("a gradient");
            for _ in 0..12 {
                let (p, h) = smooth_place(&field, &mut random);
                let (mut local, size) = (field.at(p), patch_size(field.step, p));
                let found = slope.at(&mut local, Vec2::ZERO, Side::Above);
                assert_eq!(found.value, quantity.at(&mut local, Vec2::ZERO, Side::Above));
                let mut along = |d| difference(&quantity, &mut local, Vec2::ZERO, d, h);
                let [[x, error_x], [y, error_y]] = [along(vec2(1.0, 0.0)), along(vec2(0.0, 1.0))];
                let expected = vec2(x, y);
                // of the size of the second derivatives of φ, which are sums of such terms
                let scale = (100.0 / (size * size)).max(found.gradient.length());
                let error = (found.gradient - expected).length() / scale;
                // principal stresses bend sharply where they are nearly equal: differences see
                // less there
                let blur = error_x.max(error_y) / scale;
                sharp += usize::from(blur > 1e-7);
                assert!(error < blur.max(1e-7), "{name} at {p:?}: {found:?}, {expected:?}");
                looked += 1;
            }
        }
    }
    assert!(looked > 3000 && sharp < looked / 100, "{looked} {sharp}");
}

/// Many points at once are the same up to rounding, and what lies outside is not there.
#[test]
fn many_points() {
    for dataset in datasets() {
        let field = compiled(&dataset);
        let (mut local, mut random) = (field.at(field.domain.bounds.center()), Random(3));
        let half = field.domain.bounds.size() * 0.6;
        let offsets: Vec<Vec2> =
            (0..100).map(|_| random.point(&Rect::around(Vec2::ZERO, half))).collect();
        for (name, quantity) in quantities(&field) {
            let slope = QuantityGradient::new(&quantity, &field).expect("a gradient");
            let many = slope.at_many(&mut local, &offsets, Side::Above);
            for (&offset, many) in offsets.iter().zip(many) {
                let one = slope.at(&mut local, offset, Side::Above);
                assert_eq!(one.value.is_nan(), !local.contains(offset));
                let size = patch_size(field.step, local.anchor + offset).min(1.0);
                let scale = (1.0 / (size * size)).max(one.gradient.length());
                let same = |a: f64, b: f64| {
                    a == b || a.is_nan() && b.is_nan() || (a - b).abs() <= 1e-11 * scale
                };
                assert!(same(one.gradient.x, many.gradient.x), "{name}: {one:?} {many:?}");
                assert!(same(one.gradient.y, many.gradient.y), "{name}: {one:?} {many:?}");
            }
        }
    }
}

/// u = e √r sin(θ/2) of a crack along the direction d to the tip at `tip`, with the unit vector e ⊥
/// d.
fn opening(tip: Vec2, d: Vec2) -> Dataset {
    let domain = Rect::around(tip, vec2(1.0, 1.0));
    let partition = Cover::uniform(domain, 3).expect("a cover");
    let partition = partition.partition(1.3, WeightFunction::Quadratic).expect("a partition");
    let crack = Crack::polyline(vec![tip - d * 0.7, tip], [CrackEnd::Tip; 2]);
    let frame = Frame::Tip(TipId { crack: 0, end: End::Last });
    let mut displacement = FieldData::new("displacement", &["ux", "uy"]);
    (0..64).for_each(|_| displacement.push_patch(&[(0, 0)]));
    let e = d.left();
    displacement.coefficients[0].fill(e.x);
    displacement.coefficients[1].fill(e.y);
    let step = Step::new(partition).with_crack(crack);
    let step = step.with_function("opening", FunctionKind::formula(WESTERGAARD[1], frame));
    let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
    Dataset::new(domain, Equation::elasticity(material)).with_step(step.with_field(displacement))
}

/// s · z^p of z = r e^{iθ}, as its two parts.
fn power(s: f64, r: f64, theta: f64, p: f64) -> [f64; 2] {
    let (sin, cos) = (p * theta).sin_cos();
    [s * r.powf(p) * cos, s * r.powf(p) * sin]
}

/// σ_yy = (2μ + λ) Re w and von Mises' stress of the opening, with w = 1/(2√z): in the frame of
/// the tip.
fn closed_form(r: f64, theta: f64) -> [ValueWithGradient; 2] {
    let (mu, lambda) = (0.5 / 1.3, 0.3 / (1.3 * 0.4));
    // ε_yy = Re w, 2 ε_xy = Im w
    let ([e, g], [re, im]) = (power(0.5, r, theta, -0.5), power(-0.25, r, theta, -1.5));
    let (de, dg) = (vec2(re, -im), vec2(im, re));
    let syy =
        ValueWithGradient { value: (2.0 * mu + lambda) * e, gradient: de * (2.0 * mu + lambda) };
    let spread = (lambda + mu) * (1.0 - 0.6);
    let square = 3.0 * mu * mu * (e * e + g * g) + spread * spread * e * e;
    let change = (de * e + dg * g) * (3.0 * mu * mu) + de * (spread * spread * e);
    [syy, ValueWithGradient { value: square.sqrt(), gradient: change / square.sqrt() }]
}

/// Around the tip, down to 10⁻¹² of the domain; turned, the gradients of invariants turn along.
#[test]
fn at_a_tip_in_closed_form_and_turned() {
    let tip = vec2(0.3, -0.7);
    for angle in [0.0f64, 0.6, 2.5] {
        let d = vec2(angle.cos(), angle.sin());
        let dataset = opening(tip, d);
        let field = compiled(&dataset);
        let mut local = field.at(tip);
        for (text, index, turned) in [("syy", 0, angle == 0.0), ("von-mises", 1, true)] {
            let quantity = Quantity::parse(text, &field).expect("a quantity");
            let slope = QuantityGradient::new(&quantity, &field).expect("a gradient");
            for (r, theta) in
                [1e-12, 1e-9, 1e-3].into_iter().flat_map(|r| [-3.0, -1.3, 0.2, 2.9].map(|t| (r, t)))
            {
                let (sin, cos) = f64::sin_cos(theta);
                let offset = (d * cos + d.left() * sin) * r;
                let found = slope.at(&mut local, offset, Side::Above);
                let expected = closed_form(r, theta)[index];
                let gradient = d * expected.gradient.x + d.left() * expected.gradient.y;
                let error = (found.gradient - gradient).length() / gradient.length();
                assert!(!turned || error < 1e-11, "{text} {r} {theta}: {found:?} {error:.1e}");
                let value = (found.value / expected.value - 1.0).abs();
                assert!(!turned || value < 1e-12, "{text} {r} {theta}: {found:?} {expected:?}");
            }
        }
    }
}

/// Where the anchor lies does not matter.
#[test]
fn anchors_do_not_matter() {
    for dataset in datasets().into_iter().take(6) {
        let field = compiled(&dataset);
        let quantity = Quantity::parse("von-mises", &field).expect("a quantity");
        let slope = QuantityGradient::new(&quantity, &field).expect("a gradient");
        let (mut random, mut far) = (Random(5), field.at(field.domain.bounds.center()));
        for _ in 0..50 {
            let (p, _) = smooth_place(&field, &mut random);
            let near = slope.at(&mut field.at(p), Vec2::ZERO, Side::Above);
            let other = slope.at(&mut far, p - field.domain.bounds.center(), Side::Above);
            let scale = near.gradient.length().max(patch_size(field.step, p).powi(-2));
            assert!((near.gradient - other.gradient).length() < 1e-9 * scale, "{near:?} {other:?}");
        }
    }
}
