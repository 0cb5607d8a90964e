//! Integrands that are singular at tips.

use super::*;
use std::f64::consts::PI;

/// Complex numbers as (re, im), as far as the closed forms need them.
#[derive(Clone, Copy)]
pub(super) struct Complex(pub(super) f64, pub(super) f64);

impl std::ops::Mul for Complex {
    type Output = Self;
    fn mul(self, b: Self) -> Self {
        Self(self.0 * b.0 - self.1 * b.1, self.0 * b.1 + self.1 * b.0)
    }
}

impl std::ops::Sub for Complex {
    type Output = Self;
    fn sub(self, b: Self) -> Self {
        Self(self.0 - b.0, self.1 - b.1)
    }
}

impl std::ops::Add for Complex {
    type Output = Self;
    fn add(self, b: Self) -> Self {
        Self(self.0 + b.0, self.1 + b.1)
    }
}

impl Complex {
    fn scaled(self, s: f64) -> Self {
        Self(self.0 * s, self.1 * s)
    }

    fn conj(self) -> Self {
        Self(self.0, -self.1)
    }

    /// z^q with θ ∈ \[0, π\] for `upper`, else θ ∈ \[−π, 0\].
    fn power(self, q: f64, upper: bool) -> Self {
        let r = self.0.hypot(self.1);
        if r == 0.0 {
            return Self(0.0, 0.0);
        }
        let theta = self.1.abs().atan2(self.0) * if upper { 1.0 } else { -1.0 };
        Self(r.powf(q) * (q * theta).cos(), r.powf(q) * (q * theta).sin())
    }
}

/// ∫ z^q dA over a convex polygon on one side of the real axis, q > −2 and no whole number: by
/// Green's theorem it is (1/2i) ∮ z^q z̄ dz, and z̄ = α + β z along an edge.
pub(super) fn power_integral(polygon: &[Vec2], q: f64, upper: bool) -> Complex {
    let mut sum = Complex(0.0, 0.0);
    for (k, a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        let (a, b) = (Complex(a.x, a.y), Complex(b.x, b.y));
        let d = b - a;
        let square = d.0 * d.0 + d.1 * d.1;
        if square == 0.0 {
            continue;
        }
        let beta = (d.conj() * d.conj()).scaled(1.0 / square);
        let alpha = a.conj() - beta * a;
        let first = b.power(q + 1.0, upper) - a.power(q + 1.0, upper);
        let second = b.power(q + 2.0, upper) - a.power(q + 2.0, upper);
        let term =
            (alpha * first).scaled(1.0 / (q + 1.0)) + (beta * second).scaled(1.0 / (q + 2.0));
        sum = sum + term;
    }
    Complex(0.5 * sum.1, -0.5 * sum.0)
}

/// A convex polygon's part with sign · y ≥ 0 (Sutherland and Hodgman's step).
pub(super) fn half_plane(polygon: &[Vec2], sign: f64) -> Vec<Vec2> {
    let mut part = Vec::new();
    for (k, &a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        if sign * a.y >= 0.0 {
            part.push(a);
        }
        if (a.y > 0.0 && b.y < 0.0) || (a.y < 0.0 && b.y > 0.0) {
            part.push(vec2(a.x + (b.x - a.x) * a.y / (a.y - b.y), 0.0));
        }
    }
    part
}

/// Cells and tips: inside, on edges and outside but near.
pub(super) fn tip_positions(random: &mut Random) -> Vec<(Rect, Vec2, f64)> {
    let mut cases = Vec::new();
    for _ in 0..12 {
        let min = point(random, 1.0);
        let (w, h) = (random.between(0.1, 0.4), random.between(0.1, 0.4));
        let cell = Rect::new(min, min + vec2(w, h));
        let (s, t) = (random.between(0.0, 1.0), random.between(0.0, 1.0));
        let outside = 1.0 + 0.3 * random.between(0.0, 1.0);
        for (s, t) in [(s, t), (0.0, t), (s, 1.0), (1.0, 0.0), (outside, t), (-1e-3, t), (s, 1e-6)]
        {
            cases.push((cell, min + vec2(s * w, t * h), random.between(-PI, PI)));
        }
    }
    cases
}

/// Largest error of ∫ Re z^q and ∫ Im z^q over random cells, relative to ∫ |z|^q.
fn half_integer_error(n: usize, q: f64) -> f64 {
    let mut worst: f64 = 0.0;
    for (cell, tip, angle) in tip_positions(&mut Random(5)) {
        let axis = vec2(angle.cos(), angle.sin());
        let to_frame = |p: Vec2| vec2(p.dot(axis), axis.cross(p));
        let case = alone(cell, vec![crack(&[tip - axis * 9.0, tip])], vec![tip]);
        let rules = case.rules(Orders::uniform(n));
        let corners: Vec<Vec2> = cell.corners().iter().map(|&p| to_frame(p - tip)).collect();
        let exact =
            [1.0, -1.0].map(|sign| power_integral(&half_plane(&corners, sign), q, sign > 0.0));
        let exact = exact[0] + exact[1];
        let polar = |a: Vec2, x: Vec2| {
            let p = to_frame(if a == tip { x } else { a + x - tip });
            (p.length(), p.y.atan2(p.x))
        };
        let integral = |f: &dyn Fn(f64) -> f64| {
            integrate(&rules, |a, x| {
                let (r, theta) = polar(a, x);
                r.powf(q) * f(theta)
            })
        };
        let size = integral(&|_| 1.0);
        let re = integral(&|theta| (q * theta).cos()) - exact.0;
        let im = integral(&|theta| (q * theta).sin()) - exact.1;
        worst = worst.max(re.abs().max(im.abs()) / size);
    }
    worst
}

#[test]
fn half_integer_powers_match_closed_forms() {
    for q in [-0.5, 0.5, 1.5] {
        for (n, tolerance) in [(8, 1e-12), (10, 1e-13)] {
            let error = half_integer_error(n, q);
            assert!(error < tolerance, "q = {q}, n = {n}: {error:e}");
        }
        assert!(half_integer_error(2, q) > 1e-6);
    }
}

/// ∫ 1/r, ∫ cos θ / r and ∫ sin θ / r over a polygon around, beside or touching the origin: signed
/// triangles with their apex there, d the distance of their far edge.
fn inverse_distance(polygon: &[Vec2]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for (k, &a) in polygon.iter().enumerate() {
        let b = polygon[(k + 1) % polygon.len()];
        let e = (b - a).unit();
        let d = a.cross(e);
        if d.abs() < 1e-15 {
            continue;
        }
        let normal = -e.left();
        let (from, to) = (e.dot(a) / d.abs(), e.dot(b) / d.abs());
        let along = d.abs() * ((1.0 + to * to).ln() - (1.0 + from * from).ln()) / 2.0 * d.signum();
        let across = d.abs() * (to.atan() - from.atan());
        sum[0] += d * (to.asinh() - from.asinh());
        sum[1] += normal.x * across + e.x * along;
        sum[2] += normal.y * across + e.y * along;
    }
    sum
}

#[test]
fn stress_like_products_match_closed_forms() {
    for (n, tolerance) in [(8, 5e-12), (10, 1e-13)] {
        for (cell, tip, angle) in tip_positions(&mut Random(9)) {
            let axis = vec2(angle.cos(), angle.sin());
            let case = alone(cell, vec![crack(&[tip - axis * 9.0, tip])], vec![tip]);
            let rules = case.rules(Orders::uniform(n));
            let relative = |a: Vec2, x: Vec2| if a == tip { x } else { a + x - tip };
            let exact = inverse_distance(&cell.corners().map(|p| p - tip));
            let value = [
                integrate(&rules, |a, x| 1.0 / relative(a, x).length()),
                integrate(&rules, |a, x| relative(a, x).x / relative(a, x).dot(relative(a, x))),
                integrate(&rules, |a, x| relative(a, x).y / relative(a, x).dot(relative(a, x))),
            ];
            for k in 0..3 {
                assert_near(
                    value[k],
                    exact[k],
                    tolerance * exact[0],
                    &format!("{k}, n = {n}, tip {tip:?}"),
                );
            }
        }
    }
}

#[test]
fn far_rectangles_need_no_singular_order() {
    let tip = vec2(0.0131, -0.0217);
    let case = GeometryCase::new(uniform(5), Vec::new(), vec![tip]);
    for (p, tolerance) in [(1, 1e-11), (2, 1e-12)] {
        let orders = Orders { singular: 12, ..Orders::for_degree(p) };
        let sum = integrate(&case.rules(orders), |a, x| 1.0 / (a + x - tip).length());
        let exact = inverse_distance(&DOMAIN.corners().map(|c| c - tip))[0];
        assert_near(sum, exact, tolerance * exact, &format!("p = {p}"));
    }
}

#[test]
fn two_tips_in_a_cell_are_separated() {
    for gap in [0.1, 1e-3, 1e-7] {
        let tips = vec![vec2(0.21, 0.33), vec2(0.21 + gap, 0.33 - gap / 3.0)];
        let cell = Rect::new(vec2(0.1, 0.2), vec2(0.4, 0.5));
        let case = alone(cell, Vec::new(), tips.clone());
        let rules = case.rules(Orders::uniform(10));
        let exact: f64 =
            tips.iter().map(|&t| inverse_distance(&cell.corners().map(|p| p - t))[0]).sum();
        let sum =
            integrate(&rules, |a, x| tips.iter().map(|&t| 1.0 / (x + (a - t)).length()).sum());
        assert_near(sum, exact, 1e-12 * exact, &format!("gap {gap:e}"));
    }
}

/// σ_xx, σ_yy, σ_xy at a tip with K = 1 (Williams 1957).
fn tip_stress(mode: usize, x: Vec2) -> [f64; 3] {
    let (r, theta) = (x.length(), x.y.atan2(x.x));
    let (s, c) = (theta / 2.0).sin_cos();
    let (s3, c3) = (1.5 * theta).sin_cos();
    let scale = 1.0 / (2.0 * PI * r).sqrt();
    match mode {
        1 => [c * (1.0 - s * s3), c * (1.0 + s * s3), c * s * c3],
        _ => [-s * (2.0 + c * c3), s * c * c3, c * (1.0 - s * s3)],
    }
    .map(|v| v * scale)
}

#[test]
fn strain_energy_of_both_modes() {
    let (young, nu) = (1.0, 0.3);
    let density = |mode: usize, x: Vec2| {
        let [sx, sy, t] = tip_stress(mode, x);
        let direct = (1.0 - nu * nu) * (sx * sx + sy * sy) - 2.0 * nu * (1.0 + nu) * sx * sy;
        (direct + 2.0 * (1.0 + nu) * t * t) / (2.0 * young)
    };
    let ahead = |x: f64| crack(&[vec2(-1.0, 0.0), vec2(x, 0.0)]);
    let random = graded(&mut Random(21), WeightFunction::Linear);
    for cover in [uniform(0), uniform(2), uniform(4), random] {
        let case = GeometryCase::new(cover, vec![ahead(0.0)], vec![Vec2::ZERO]);
        let rules = case.rules(Orders::for_degree(2));
        for (mode, exact) in [(1, 0.474_129_375_227), (2, 1.203_559_183_268)] {
            let energy = integrate(&rules, |a, x| density(mode, a + x));
            assert_near(energy, exact, 1e-10, &format!("mode {mode}"));
        }
    }
}

#[test]
fn energy_in_a_disc_with_a_smooth_cut_off() {
    let tip = vec2(0.1, -0.05);
    let radius = 0.7;
    let mut case = GeometryCase::new(uniform(3), vec![crack(&[vec2(-1.0, -0.05), tip])], vec![tip]);
    case.patch_singular = vec![Vec::new(); case.partition.len()];
    let quadrature = case.quadrature(Orders::for_degree(1));
    let rules: Vec<CellRule> = case
        .partition
        .cell
        .iter()
        .flat_map(|c| {
            quadrature.disc(
                covered(c, &covering_patches(&case.partition, c)),
                Disc::even(tip, radius, 14),
            )
        })
        .collect();
    assert!(rules.iter().all(|r| r.anchor == tip));
    let sum = integrate(&rules, |_, x| {
        let r = x.length();
        (1.0 - (r / radius).powi(2)).max(0.0).powi(8) * (1.0 + x.x / r) / r
    });
    let beta: f64 = (1..=8).map(|k| 2.0 * f64::from(k) / (2.0 * f64::from(k) + 1.0)).product();
    assert_near(sum, 2.0 * PI * radius * beta, 1e-9, "∫ (1 − (r/R)²)⁸ / r");
}
