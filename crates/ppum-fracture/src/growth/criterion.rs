//! Where a tip goes, and the factor that is compared with the toughness.
//!
//! A crack that kinks at its tip by the angle θ has after a first, vanishing increment the factors
//!
//! ```text
//! k_I = F_11(θ) K_I + F_12(θ) K_II      k_II = F_21(θ) K_I + F_22(θ) K_II
//! ```
//!
//! with functions that are the same in every body (Amestoy & Leblond 1992, Int. J. Solids Struct.
//! 29, 465). One of the criteria demands k_II = 0, one the largest k_I² + k_II², and one looks at
//! the stress before the kink only. They agree where K_II = 0, and so on the smooth part of every
//! path.
//!
//! An increment of the length a adds G_I(θ) T √a and G_II(θ) T √a to the factors. With
//! G_II ≈ −√(8/π) θ this is Cotterell & Rice's (1980, Int. J. Fract. 16, 155) result for small
//! turns: where T < 0 an increment that turns by θ = −2 K_II / K_I ends with
//! K_II = −½ c θ K_I, c = 2 √(8a/π) |T| / K_I. The next one would turn back by −c θ, so that paths
//! swing, with growing angles if c > 1.32: the history of turns, whose memory is
//! √(n + 1) − √n, stands in their recursion. [`Drive::next_turn`] turns by θ / (1 + c) instead, for
//! which K_II at the end of the increment vanishes.

use ppum::anisotropy::{TipLaw, weakest_direction};
use ppum::dataset::TipIntensity;
use ppum::vec2::Vec2;
use ppum_problem::Criterion;
use std::f64::consts::{FRAC_2_PI, PI};

/// The direction of growth and the factor that drives it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KinkPrediction {
    /// θ, from the direction of the crack to the left, in radians.
    pub angle: f64,
    /// K_I of a straight crack that would be driven as much.
    pub k_eq: f64,
}

/// Angles of kinks are below it: 70.5°, 77.4° and 75.8° are the largest of the criteria, at
/// K_I = 0.
const WIDEST: f64 = 1.4;

/// The kink of a tip; none where K_I is negative, so that the faces overlap, or where nothing
/// drives it.
///
/// Angles are those of the criterion's closed form to the last digits; the functions of kinks that
/// two of the criteria rest on are right to 1e-5 up to 80°.
pub fn kink(criterion: Criterion, factors: &TipIntensity) -> Option<KinkPrediction> {
    Drive::new(criterion, factors).map(|drive| drive.kink)
}

/// The driving force of a tip, and its direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drive {
    criterion: Criterion,
    /// K_I, which is not negative, and K_II.
    k: [f64; 2],
    /// T where it is negative, so that it turns the crack back; else zero.
    t_stress: f64,
    /// The kink of a vanishing increment.
    pub(super) kink: KinkPrediction,
    /// True if increments are straight in its direction.
    pub(super) is_straight: bool,
}

/// The turn of an increment: at its start, and then evenly along its arc.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct IncrementTurn {
    pub(super) at_start: f64,
    pub(super) along: f64,
}

impl Drive {
    /// Returns the driving force of a tip with these factors, if there is one.
    pub(super) fn new(criterion: Criterion, factors: &TipIntensity) -> Option<Self> {
        let hoop = factors.growth_angle()?;
        let k = [factors.k1.max(0.0), factors.k2];
        let angle = match criterion {
            _ if k[1] == 0.0 => 0.0,
            Criterion::Hoop => hoop,
            _ => root(-WIDEST * k[1].signum(), |angle| sliding(criterion, angle, k)),
        };
        let strength = match criterion {
            Criterion::Hoop => hoop_strength(angle, k),
            Criterion::LocalSymmetry => after(angle, k)[0],
            Criterion::Energy => after(angle, k)[0].hypot(after(angle, k)[1]),
        };
        let t_stress = factors.t_stress.unwrap_or(0.0).min(0.0);
        let kink = KinkPrediction { angle, k_eq: strength };
        Some(Self { criterion, k, t_stress, kink, is_straight: false })
    }

    /// Returns the driving force of a tip in the direction in which the hoop stress, by the law at
    /// the tip, is largest relative to a strength: of an anisotropic body, or of one whose
    /// toughness depends on the direction. Increments are straight, as T's part in them is that of
    /// isotropic bodies.
    pub(super) fn by_direction(
        factors: &TipIntensity,
        law: Option<&TipLaw>,
        strength: impl Fn(f64) -> f64,
    ) -> Option<Self> {
        let opens = match law {
            Some(law) => law.opens([factors.k1, factors.k2], factors.tolerance()),
            None => factors.growth_angle().is_some(),
        };
        if !opens {
            return None;
        }
        let k = [factors.k1, factors.k2];
        let hoop = |angle: f64| match law {
            Some(law) => law.hoop_stress(k, angle),
            None => hoop_strength(angle, k),
        };
        let angle = weakest_direction(hoop, strength);
        let kink = KinkPrediction { angle, k_eq: hoop(angle) };
        Some(Self { criterion: Criterion::Hoop, k, t_stress: 0.0, kink, is_straight: true })
    }

    /// True if T turns the crack back.
    pub(super) fn turns_back(&self) -> bool {
        self.t_stress < 0.0
    }

    /// The turn of a first increment at whose end the criterion goes straight on: along an arc
    /// behind the kink if it need not turn by more than `most`, and by a smaller kink beyond that.
    /// Where T is not negative it is the kink alone.
    pub(super) fn first_turn(&self, path: &[Vec2], length: f64, most: f64) -> IncrementTurn {
        let angle = self.kink.angle;
        let arc = IncrementTurn { at_start: angle, along: self.bend(path, length, angle) };
        if arc.along.abs() <= most {
            return arc;
        }
        let along = most.copysign(arc.along);
        let bent = along * self.stiffness(length) + self.memory(path, length);
        IncrementTurn { at_start: self.root(length, bent), along }
    }

    /// The turn of a later increment at whose end the criterion goes straight on: what K_II there
    /// is now is answered at the start, so that errors fade, what is to come along the arc.
    pub(super) fn next_turn(&self, path: &[Vec2], length: f64) -> IncrementTurn {
        IncrementTurn { at_start: self.root(length, 0.0), along: self.bend(path, length, 0.0) }
    }

    /// The turn of an arc behind a kink that answers how T changes K_II along it.
    pub(super) fn bend(&self, path: &[Vec2], length: f64, kink: f64) -> f64 {
        if !self.turns_back() {
            return 0.0;
        }
        let change = self.memory(path, length) + turned_back(kink) * self.t_stress * length.sqrt();
        -change / self.stiffness(length)
    }

    /// K_II at the end of an arc, by its turn: of a curvature κ it is
    /// ½ κ a K_I − √(2/π) T ∫ κ s / √(a − s) ds.
    fn stiffness(&self, length: f64) -> f64 {
        0.5 * self.kink.k_eq - 4.0 / 3.0 * FRAC_2_PI.sqrt() * self.t_stress * length.sqrt()
    }

    /// The kink behind which the criterion goes straight on at the end of an increment that adds
    /// some K_II beside.
    fn root(&self, length: f64, beside: f64) -> f64 {
        let stress = self.t_stress * length.sqrt();
        let angle = self.kink.angle;
        if angle == 0.0 || (stress == 0.0 && beside == 0.0) {
            return angle;
        }
        let at_end = |angle| sliding(self.criterion, angle, self.k) + turned_back(angle) * stress;
        root(angle, |angle| at_end(angle) + beside)
    }

    /// How much K_II changes along a straight increment because the crack behind it, given from
    /// its tip on, is not straight: a piece at the distance x with the angle φ to the tip's
    /// direction adds −√(2/π) T φ (1/√(x + a) − 1/√x) dx, with ½ sin 2φ where turns are large.
    fn memory(&self, path: &[Vec2], length: f64) -> f64 {
        let Some(direction) = path.get(1).map(|next| (path[0] - *next).unit()) else { return 0.0 };
        let kernel = |x: f64| 2.0 * ((x + length).sqrt() - x.sqrt());
        let mut near = 0.0;
        let pieces = path.windows(2).map(|ends| {
            let piece = ends[0] - ends[1];
            let far = near + piece.length();
            let shear = direction.dot(piece) * direction.cross(piece) / piece.dot(piece);
            let change = shear * (kernel(far) - kernel(near));
            near = far;
            change
        });
        -FRAC_2_PI.sqrt() * self.t_stress * pieces.sum::<f64>()
    }
}

/// Returns the quantity that a criterion makes vanish, in units of K_II, which it is without a
/// kink.
fn sliding(criterion: Criterion, angle: f64, k: [f64; 2]) -> f64 {
    match criterion {
        Criterion::Hoop => hoop_sliding(angle, k),
        Criterion::LocalSymmetry => after(angle, k)[1],
        Criterion::Energy => {
            let [k1, k2] = after(angle, k);
            -slope_of_release(angle, k) / k1.hypot(k2)
        }
    }
}

/// √(2πr) σ_rθ at an angle, which vanishes where the hoop stress is largest.
fn hoop_sliding(angle: f64, [k1, k2]: [f64; 2]) -> f64 {
    0.5 * (0.5 * angle).cos() * (k1 * angle.sin() + k2 * (3.0 * angle.cos() - 1.0))
}

/// √(2πr) σ_θθ at an angle.
fn hoop_strength(angle: f64, [k1, k2]: [f64; 2]) -> f64 {
    let (sin, cos) = (0.5 * angle).sin_cos();
    cos * (k1 * cos * cos - 3.0 * k2 * sin * cos)
}

/// The factors behind a kink.
fn after(angle: f64, [k1, k2]: [f64; 2]) -> [f64; 2] {
    let [[f11, f12], [f21, f22]] = kinked(angle).map(|row| row.map(|[value, _]| value));
    [f11 * k1 + f12 * k2, f21 * k1 + f22 * k2]
}

/// Half the derivative of k_I² + k_II² by the angle.
fn slope_of_release(angle: f64, [k1, k2]: [f64; 2]) -> f64 {
    let each = kinked(angle).map(|[[f, df], [g, dg]]| (f * k1 + g * k2) * (df * k1 + dg * k2));
    each[0] + each[1]
}

/// The one zero of a function between the direction of the crack and an angle: bisection to the
/// last digit.
fn root(mut far: f64, value: impl Fn(f64) -> f64) -> f64 {
    let mut near = 0.0;
    // at the direction of the crack the function may vanish, too
    let sign = -value(far).signum();
    loop {
        let middle = 0.5 * (near + far);
        if middle == near || middle == far {
            return middle;
        }
        let half = if value(middle).signum() == sign { &mut near } else { &mut far };
        *half = middle;
    }
}

/// Coefficients of F_11, F_12, F_21 and F_22 that Amestoy & Leblond have computed, behind those
/// that are known exactly.
const F11: [f64; 7] = [5.077_90, -2.883_12, -0.092_5, 2.996, -4.059, 1.63, 4.1];
const F12: [f64; 7] = [12.313_906, -7.324_33, 1.579_3, 4.021_6, -6.915, 4.21, 4.56];
const F21: [f64; 7] = [-6.176_023, 4.441_12, -1.534_0, -2.070_0, 4.684, -3.95, -1.32];
const F22: [f64; 7] = [10.582_54, -4.785_11, -1.880_4, 7.280, -7.591, 0.25, 12.5];

/// Those of G_II.
const G2: [f64; 8] = [-59.565_733, 61.174_444, -39.902_49, 15.622_2, 3.034_3, -12.781, 9.69, 6.62];

/// The powers m, m³, …, m¹⁹ of F_12 and F_21 with m = θ/π, and 1, m², …, m²⁰ of F_11 and F_22.
fn kinked(angle: f64) -> [[[f64; 2]; 2]; 2] {
    let (p2, p3, p4, p5, p6) = (PI.powi(2), PI.powi(3), PI.powi(4), PI.powi(5), PI.powi(6));
    let f11 = [
        1.0,
        -3.0 * p2 / 8.0,
        p2 - 5.0 * p4 / 128.0,
        p2 / 9.0 - 11.0 * p4 / 72.0 + 119.0 * p6 / 15_360.0,
    ];
    let f12 = [
        -1.5 * PI,
        10.0 * PI / 3.0 + p3 / 16.0,
        -2.0 * PI - 133.0 * p3 / 180.0 + 59.0 * p5 / 1280.0,
    ];
    let f21 = [
        0.5 * PI,
        -4.0 * PI / 3.0 - p3 / 48.0,
        -2.0 * PI / 3.0 + 13.0 * p3 / 30.0 - 59.0 * p5 / 3840.0,
    ];
    let f22 = [
        1.0,
        -4.0 - 3.0 * p2 / 8.0,
        8.0 / 3.0 + 29.0 * p2 / 18.0 - 5.0 * p4 / 128.0,
        -32.0 / 15.0 - 4.0 * p2 / 9.0 - 1159.0 * p4 / 7200.0 + 119.0 * p6 / 15_360.0,
    ];
    let m = angle / PI;
    [[even(&f11, &F11, m), odd(&f12, &F12, m)], [odd(&f21, &F21, m), even(&f22, &F22, m)]]
}

/// G_II: K_II that a straight increment of unit length under T = 1 gets beside that of its kink.
fn turned_back(angle: f64) -> f64 {
    let root = (2.0 * PI).sqrt();
    odd(&[-2.0 * root, 12.0 * root], &G2, angle / PI)[0]
}

/// Σ c_k m^2k, and its derivative by the angle, of coefficients in two parts.
fn even(first: &[f64], others: &[f64], m: f64) -> [f64; 2] {
    let (square, mut value, mut slope) = (m * m, 0.0, 0.0);
    for c in first.iter().chain(others).rev() {
        // d/dm = 2m d/dm²
        slope = slope * square + value;
        value = value * square + c;
    }
    [value, 2.0 * m * slope / PI]
}

/// Σ c_k m^(2k + 1), and its derivative by the angle.
fn odd(first: &[f64], others: &[f64], m: f64) -> [f64; 2] {
    let [value, slope] = even(first, others, m);
    [m * value, m * slope + value / PI]
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::crack::{End, TipId};
    use ppum_testkit::random::Random;

    const ALL: [Criterion; 3] = [Criterion::Hoop, Criterion::LocalSymmetry, Criterion::Energy];

    fn of(criterion: Criterion, k1: f64, k2: f64) -> Option<KinkPrediction> {
        let tip = TipId { crack: 0, end: End::Last };
        kink(criterion, &TipIntensity::new(tip, k1, k2))
    }

    fn degrees(criterion: Criterion, k1: f64, k2: f64) -> f64 {
        of(criterion, k1, k2).expect("an open crack").angle.to_degrees()
    }

    /// The closed form of Erdogan & Sih.
    #[test]
    fn hoop_stress() {
        let known = [(0.0, 0.0), (0.1, -11.202_877_7), (0.5, -40.207_818_7), (1.0, -53.130_102_4)];
        for (ratio, angle) in known {
            assert!((degrees(Criterion::Hoop, 2.0, 2.0 * ratio) - angle).abs() < 1e-6);
        }
        assert!((degrees(Criterion::Hoop, 0.0, 1.0) + 70.528_779_4).abs() < 1e-6);
    }

    /// Angles found by looking at thousands of kinks: those of k_II = 0 and of the largest k_I² +
    /// k_II², to 1e-6°.
    #[test]
    fn angles_are_those_of_the_criteria() {
        let mut random = Random(3);
        for _ in 0..40 {
            let k = [random.between(0.0, 1.0), random.between(-1.0, 1.0)];
            let side = -k[1].signum();
            let at = |degrees: f64| after(side * degrees.to_radians(), k);
            let least = |value: &dyn Fn(f64) -> f64| {
                let (mut from, mut to) = (0.0, 80.0);
                for _ in 0..40 {
                    let step = (to - from) / 100.0;
                    let all = (0..=100).map(|i| from + step * f64::from(i));
                    let best = all.min_by(|a, b| value(*a).total_cmp(&value(*b))).expect("some");
                    (from, to) = (best - step, best + step);
                }
                0.5 * (from + to)
            };
            let symmetric = least(&|angle| at(angle)[1].abs());
            let found = degrees(Criterion::LocalSymmetry, k[0], k[1]);
            assert!((found - side * symmetric).abs() < 1e-6, "{k:?}: {found} {symmetric}");
            let released = least(&|angle| -at(angle)[0].hypot(at(angle)[1]));
            let found = degrees(Criterion::Energy, k[0], k[1]);
            // a maximum shows half of the digits
            assert!((found - side * released).abs() < 1e-5, "{k:?}: {found} {released}");
            assert!(slope_of_release(found.to_radians(), k).abs() < 1e-12);
        }
    }

    /// Compares with published angles for pure sliding: 77.3° (Amestoy & Leblond 1992), and 75.6°
    /// to 75.8° with √1.517 times the factor.
    #[test]
    fn pure_sliding() {
        assert!((degrees(Criterion::LocalSymmetry, 0.0, 1.0) + 77.33).abs() < 0.01);
        let released = of(Criterion::Energy, 0.0, 1.0).expect("open");
        assert!((released.angle.to_degrees() + 75.7).abs() < 0.1);
        assert!((released.k_eq.powi(2) - 1.517).abs() < 1e-3);
    }

    /// Straight cracks under opening go straight on, with K_I; sliding one way mirrors the other;
    /// factors scale; criteria differ in second order only: by 3.7° at most up to K_II = K_I / 2.
    #[test]
    fn properties() {
        let mut random = Random(4);
        for criterion in ALL {
            assert_eq!(of(criterion, 3.0, 0.0), Some(KinkPrediction { angle: 0.0, k_eq: 3.0 }));
            assert_eq!(of(criterion, -1.0, 0.5), None);
            for _ in 0..100 {
                let (k1, k2) = (random.between(0.1, 1.0), random.between(-1.0, 1.0));
                let found = of(criterion, k1, k2).expect("open");
                let mirrored = of(criterion, k1, -k2).expect("open");
                assert!((found.angle + mirrored.angle).abs() < 1e-14);
                assert!((found.k_eq - mirrored.k_eq).abs() < 1e-14);
                let larger = of(criterion, 8.0 * k1, 8.0 * k2).expect("open");
                assert!((larger.angle - found.angle).abs() < 1e-14);
                assert!((larger.k_eq - 8.0 * found.k_eq).abs() < 1e-13);
                assert!(found.angle * k2 <= 0.0 && found.k_eq >= k1 * (1.0 - 1e-12));
                if k2.abs() <= 0.5 * k1 {
                    let hoop = of(Criterion::Hoop, k1, k2).expect("open");
                    assert!((found.angle - hoop.angle).abs() < 3.7_f64.to_radians());
                }
            }
        }
    }

    /// Slopes of the functions of kinks against differences.
    #[test]
    fn slopes() {
        for angle in [-1.2, -0.4, 0.1, 0.9] {
            let step = 1e-5;
            let (less, here, more) = (kinked(angle - step), kinked(angle), kinked(angle + step));
            for (i, j) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                let difference = (more[i][j][0] - less[i][j][0]) / (2.0 * step);
                assert!((here[i][j][1] - difference).abs() < 1e-8, "{i}{j}");
            }
        }
    }
}
