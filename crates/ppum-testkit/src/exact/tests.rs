//! The exact fields against tabulated values, equilibrium, free faces and their own texts.

use super::field::{ElasticField, ExactField, stress};
use super::{CrackInPlane, RoundHole, Slit, Smooth, Williams};
use num_complex::Complex64;
use ppum::dataset::{Material, StressState};
use ppum::vec2::{Vec2, vec2};
use std::f64::consts::{FRAC_PI_4, PI};

const STRAIN: Material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
const STRESS: Material = Material { state: StressState::PlaneStress, ..STRAIN };
const X_AXIS: Vec2 = vec2(1.0, 0.0);

fn near_tip(material: Material, k1: f64, k2: f64) -> Williams {
    Williams::new(material, Vec2::ZERO, X_AXIS).with_intensities(k1, k2)
}

/// Both modes up to order 6, at a tip in general position.
fn many_terms(material: Material) -> Williams {
    let field = Williams::new(material, vec2(0.03, 0.041), vec2(2.0, 0.4))
        .with_intensities(1.0, 0.5)
        .with_t_stress(0.3);
    (3..=6).fold(field, |field, order| field.with_term(order, 0.2, -0.1 * f64::from(order)))
}

fn oblique_crack(material: Material) -> CrackInPlane {
    let (s, c) = 35f64.to_radians().sin_cos();
    CrackInPlane::biaxial(material, vec2(0.02, -0.03), vec2(c, s), 0.4, 1.0)
        .with_remote([0.7, 1.0, 0.6])
}

fn round_hole(material: Material) -> RoundHole {
    let hole = RoundHole::new(material, vec2(0.02, -0.04), 0.05);
    hole.with_remote([0.7, 1.0, 0.6]).with_pressure(0.4)
}

/// The rim carries the pressure and nothing else, and the hoop stress is Kirsch's.
#[test]
fn rim_of_a_round_hole() {
    for k in 0..24 {
        let angle = f64::from(k) * PI / 12.0 + 0.1;
        let n = vec2(angle.cos(), angle.sin());
        let [xx, yy, xy] = round_hole(STRAIN).stress(vec2(0.02, -0.04) + n * 0.05);
        let traction = vec2(xx * n.x + xy * n.y, xy * n.x + yy * n.y);
        assert!((traction + n * 0.4).length() < 1e-14);
        let plain = RoundHole::new(STRESS, Vec2::ZERO, 2.0).with_remote([0.0, 1.0, 0.0]);
        let [xx, yy, xy] = plain.stress(n * 2.0);
        let t = n.left();
        let hoop = xx * t.x * t.x + 2.0 * xy * t.x * t.y + yy * t.y * t.y;
        assert!((hoop - 1.0 - 2.0 * (2.0 * angle).cos()).abs() < 1e-14);
    }
}

fn elastic_fields() -> Vec<Box<dyn ElasticField>> {
    [STRAIN, STRESS]
        .into_iter()
        .flat_map(|material| -> [Box<dyn ElasticField>; 4] {
            [
                Box::new(many_terms(material)),
                Box::new(oblique_crack(material)),
                Box::new(round_hole(material)),
                Box::new(Smooth { material }),
            ]
        })
        .collect()
}

/// Points around the cracks of [`elastic_fields`], none within 0.05 of one.
fn points() -> Vec<Vec2> {
    let ring = |r: f64| {
        (0..12).map(move |k| {
            let angle = 0.35 + f64::from(k) * PI / 6.0;
            vec2(r * angle.cos(), r * angle.sin())
        })
    };
    ring(0.25).chain(ring(0.8)).chain(ring(1.4)).filter(|&p| far_from_cracks(p)).collect()
}

fn far_from_cracks(p: Vec2) -> bool {
    let distance = |from: Vec2, to: Vec2| {
        let along = to - from;
        let t = ((p - from).dot(along) / along.dot(along)).clamp(0.0, 1.0);
        (p - from - along * t).length()
    };
    let tip = vec2(0.03, 0.041);
    let (s, c) = 35f64.to_radians().sin_cos();
    let center = vec2(0.02, -0.03);
    distance(tip, tip - vec2(2.0, 0.4)) > 0.05
        && distance(center - vec2(c, s) * 0.4, center + vec2(c, s) * 0.4) > 0.05
}

/// Central difference of fourth order.
fn difference(f: impl Fn(Vec2) -> f64, p: Vec2, direction: Vec2) -> f64 {
    const STEP: f64 = 1e-3;
    let at = |k: f64| f(p + direction * (k * STEP));
    (8.0 * (at(1.0) - at(-1.0)) - (at(2.0) - at(-2.0))) / (12.0 * STEP)
}

fn gradient(f: impl Fn(Vec2) -> f64, p: Vec2) -> Vec2 {
    vec2(difference(&f, p, X_AXIS), difference(&f, p, X_AXIS.left()))
}

fn assert_close(actual: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((actual - expected).abs() <= tolerance, "{what}: {actual} instead of {expected}");
}

/// (x, y), mode II?, displacements in plane strain and in plane stress, stresses.
type TabulatedValues = ([f64; 2], bool, [f64; 2], [f64; 2], [f64; 3]);

/// E = 1, ν = 0.3, K = 1; evaluated from Irwin's formulas by independent code, ten digits.
const TABLE: [TabulatedValues; 5] = [
    (
        [0.5, 0.0],
        false,
        [0.2933785834, 0.0],
        [0.3949327085, 0.0],
        [0.5641895835, 0.5641895835, 0.0],
    ),
    (
        [0.3, 0.4],
        false,
        [0.3936086734, 0.1968043367],
        [0.4844414442, 0.2422207221],
        [0.2825908425, 0.7266621663, 0.0403701204],
    ),
    (
        [0.3, 0.4],
        true,
        [0.7216159013, -0.1312028911],
        [0.7670322867, -0.2220356619],
        [-0.5449966248, 0.0403701204, 0.2825908425],
    ),
    (
        [-0.3, 0.4],
        false,
        [0.3936086734, 0.7872173469],
        [0.4390250588, 0.8780501177],
        [0.2926833726, 0.2119431318, -0.2220356619],
    ),
    (
        [-0.3, -0.4],
        false,
        [0.3936086734, -0.7872173469],
        [0.4390250588, -0.8780501177],
        [0.2926833726, 0.2119431318, 0.2220356619],
    ),
];

#[test]
fn near_tip_field_has_the_tabulated_values() {
    for (p, second, strain, plane_stress, sigma) in TABLE {
        let [k1, k2] = if second { [0.0, 1.0] } else { [1.0, 0.0] };
        for (material, expected) in [(STRAIN, strain), (STRESS, plane_stress)] {
            let field = near_tip(material, k1, k2);
            let u = field.evaluate(p.into());
            for k in 0..2 {
                assert_close(u[k].value, expected[k], 6e-11, "displacement");
            }
            for (actual, expected) in field.stress(p.into()).into_iter().zip(sigma) {
                assert_close(actual, expected, 6e-11, "stress");
            }
        }
    }
}

/// ∫ f(θ) dθ over (−π, π), smooth between multiples of 45°: composite three-point Gauss rule.
fn around(f: impl Fn(f64) -> f64) -> f64 {
    const PANELS: u32 = 400;
    let half = PI / f64::from(PANELS);
    let node = 0.6f64.sqrt() * half;
    (0..PANELS)
        .map(|k| -PI + half * f64::from(2 * k + 1))
        .map(|mid| half / 9.0 * (5.0 * f(mid - node) + 8.0 * f(mid) + 5.0 * f(mid + node)))
        .sum()
}

/// Distance from the origin to the border of [−1, 1]² at angle θ.
fn border(theta: f64) -> f64 {
    let folded = (theta.abs() + FRAC_PI_4).rem_euclid(2.0 * FRAC_PI_4) - FRAC_PI_4;
    1.0 / folded.cos()
}

#[test]
fn energies_on_the_square_are_the_reference_values() {
    // ½ σ:ε falls like 1/r, so the integral over r is elementary.
    let energy = |material: Material, k1, k2| {
        let field = near_tip(material, k1, k2);
        around(|theta| {
            let [u, v] = field.at_polar(1.0, theta);
            let [xx, yy, xy] = stress(&material, &[u, v]);
            let shear = u.gradient.y + v.gradient.x;
            0.5 * (xx * u.gradient.x + yy * v.gradient.y + xy * shear) * border(theta)
        })
    };
    assert_close(energy(STRAIN, 1.0, 0.0), 0.474129375227, 1e-11, "strain, I");
    assert_close(energy(STRAIN, 0.0, 1.0), 1.203559183268, 1e-11, "strain, II");
    assert_close(energy(STRESS, 1.0, 0.0), 0.575127348648, 1e-11, "stress, I");
    assert_close(energy(STRESS, 0.0, 1.0), 1.304557156689, 1e-11, "stress, II");
}

#[test]
fn slit_has_the_reference_norms() {
    let at = |theta: f64| Slit.evaluate(vec2(theta.cos(), theta.sin()))[0];
    let gradient_norm = around(|t| at(t).gradient.dot(at(t).gradient) * border(t));
    let norm = around(|t| at(t).value.powi(2) * border(t).powi(3) / 3.0);
    assert_close(gradient_norm, 1.762747174039, 1e-11, "energy");
    assert_close(norm, 1.530391432928, 1e-11, "norm");
    for p in [vec2(0.3, 0.4), vec2(-0.3, -0.4)] {
        let difference = gradient(|q| Slit.evaluate(q)[0].value, p);
        assert!((difference - Slit.evaluate(p)[0].gradient).length() < 1e-9);
    }
}

#[test]
fn values_are_finite_at_the_tips() {
    let tip = vec2(0.03, 0.041);
    assert!(many_terms(STRAIN).evaluate(tip).iter().all(|u| u.value == 0.0));
    let crack = CrackInPlane::biaxial(STRAIN, Vec2::ZERO, X_AXIS, 0.5, 1.0);
    for x in [-0.5, 0.5] {
        assert!(crack.evaluate(vec2(x, 0.0)).iter().all(|u| u.value.is_finite()));
    }
}

#[test]
fn gradients_are_those_of_the_values() {
    for field in elastic_fields() {
        for p in points() {
            let u = field.evaluate(p);
            for (k, component) in u.iter().enumerate() {
                let difference = gradient(|q| field.evaluate(q)[k].value, p);
                assert!((difference - component.gradient).length() < 1e-6, "{p:?}");
            }
        }
    }
}

#[test]
fn stresses_are_in_equilibrium() {
    for (i, field) in elastic_fields().iter().enumerate() {
        let smooth = Smooth { material: field.material() };
        for p in points() {
            let [xx, yy, xy] = [0, 1, 2].map(|k| gradient(|q| field.stress(q)[k], p));
            let force = if i % 4 == 3 { smooth.body_force(p) } else { Vec2::ZERO };
            assert!((vec2(xx.x + xy.y, xy.x + yy.y) + force).length() < 1e-4, "field {i} {p:?}");
        }
    }
}

#[test]
fn faces_of_the_tip_are_free_in_every_order() {
    for material in [STRAIN, STRESS] {
        for order in 1..=8 {
            for (a, b) in [(1.0, 0.0), (0.0, 1.0)] {
                let field = Williams::new(material, Vec2::ZERO, X_AXIS).with_term(order, a, b);
                for (r, theta) in [(0.3, PI), (0.3, -PI), (1.0, PI), (1.0, -PI)] {
                    let [_, yy, xy] = stress(&material, &field.at_polar(r, theta));
                    assert!(yy.abs().max(xy.abs()) < 1e-13, "order {order}: {yy} {xy}");
                }
            }
        }
    }
}

#[test]
fn order_two_is_t_stress_and_a_rotation() {
    let t = Williams::new(STRAIN, Vec2::ZERO, X_AXIS).with_t_stress(0.3);
    let turn = Williams::new(STRAIN, Vec2::ZERO, X_AXIS).with_term(2, 0.0, 1.0);
    for p in points() {
        let [xx, yy, xy] = t.stress(p);
        assert!((xx - 0.3).abs().max(yy.abs()).max(xy.abs()) < 1e-15);
        assert!(turn.stress(p).iter().all(|s| s.abs() < 1e-15));
    }
}

#[test]
fn turning_the_crack_turns_the_field() {
    // A tip that grows to the left is the image of one that grows to the right under x → −x:
    // mode I is symmetric.
    let left = Williams::new(STRAIN, vec2(-0.5, 0.0), vec2(-3.0, 0.0)).with_intensities(1.0, 0.0);
    let right = Williams::new(STRAIN, vec2(0.5, 0.0), X_AXIS).with_intensities(1.0, 0.0);
    for p in points() {
        let [u, v] = right.evaluate(p);
        let [mu, mv] = left.evaluate(vec2(-p.x, p.y));
        assert_close(mu.value, -u.value, 1e-14, "u");
        assert_close(mv.value, v.value, 1e-14, "v");
        assert_close(mu.gradient.x, u.gradient.x, 1e-14, "∂u/∂x");
        assert_close(mv.gradient.x, -v.gradient.x, 1e-14, "∂v/∂x");
    }
}

#[test]
fn crack_in_the_plane_opens_and_is_free() {
    let a = 0.4;
    let field = CrackInPlane::biaxial(STRAIN, Vec2::ZERO, X_AXIS, a, 2.0);
    let sheared = field.clone().with_remote([0.7, 1.0, 0.6]);
    for x in [-0.39, -0.2, 0.0, 0.1, 0.399] {
        let [above, below] = [1e-18, -1e-18].map(|y| field.evaluate(vec2(x, y))[1].value);
        let opening = (STRAIN.kolosov() + 1.0) * 2.0 * (a * a - x * x).sqrt() / (4.0 * STRAIN.mu());
        assert_close(above, opening, 1e-14, "opening");
        assert_close(below, -opening, 1e-14, "opening");
        for y in [1e-18, -1e-18] {
            let [_, yy, xy] = sheared.stress(vec2(x, y));
            assert!(yy.abs().max(xy.abs()) < 1e-13, "{yy} {xy}");
        }
    }
    let far = sheared.stress(vec2(3e4, -5e4));
    for (actual, expected) in far.into_iter().zip([0.7, 1.0, 0.6]) {
        assert_close(actual, expected, 1e-9, "remote stress");
    }
}

#[test]
fn crack_in_the_plane_is_westergaards() {
    // σ_xx + σ_yy = 4 Re Φ and σ_yy − iσ_xy = Φ(z) + Φ(z̄) + (z − z̄) conj(Φ′(z)), Φ = σ z/(2R).
    let (a, sigma) = (0.4, 1.5);
    let field = CrackInPlane::biaxial(STRESS, Vec2::ZERO, X_AXIS, a, sigma);
    for p in points() {
        let z = Complex64::new(p.x, p.y);
        // A root with its cut between the tips, for points off the axis x = 0.
        let root = z * (1.0 - a * a / (z * z)).sqrt();
        let phi = 0.5 * sigma * z / root;
        let slope = -0.5 * sigma * a * a / (root * root * root);
        let combined = phi + phi.conj() + Complex64::new(0.0, 2.0 * p.y) * slope.conj();
        let [xx, yy, xy] = field.stress(p);
        assert_close(xx + yy, 4.0 * phi.re, 1e-13, "sum");
        assert_close(yy, combined.re, 1e-13, "σ_yy");
        assert_close(xy, -combined.im, 1e-13, "σ_xy");
    }
}

#[test]
fn crack_in_the_plane_has_its_intensities_at_both_tips() {
    let field = oblique_crack(STRAIN);
    let [k1, k2] = field.intensities();
    let (s, c) = 35f64.to_radians().sin_cos();
    for side in [1.0, -1.0] {
        let direction = vec2(c, s) * side;
        let tip = vec2(0.02, -0.03) + direction * 0.4;
        let singular = Williams::new(STRAIN, tip, direction).with_intensities(k1, k2);
        let r = 1e-10;
        for angle in [-2.5, -1.0, 0.0, 0.7, 2.0] {
            let (s, c) = f64::sin_cos(angle);
            let p = tip + (direction * c + direction.left() * s) * r;
            for (full, part) in field.stress(p).into_iter().zip(singular.stress(p)) {
                // The next term is smaller by √r, the tip itself rounded to 1e-17.
                assert_close(full, part, 3e-5 / r.sqrt(), "stress");
            }
        }
    }
}
