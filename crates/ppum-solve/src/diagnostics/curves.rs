//! T of cracks that are curves to their user, and polylines here.
//!
//! K of a polyline along a curve is that of the curve but for squares of its turns, T is not: a
//! kink of angle α at the distance s from a tip changes T there by −c α K_II / √s, to first order,
//! and a curve is the sum of its kinks. What a polyline lacks of it,
//!
//! ```text
//! T_curve − T = −c K_II ( Σ α_k / √s_k − ∫ κ / √s ds )
//! ```
//!
//! falls like the root of the segments' length. The curve goes on as at the last of the vertices
//! that are looked at, where the formula of Euler and Maclaurin ends the sum.

use super::{kind, short, warning};
use crate::intensity::TipOutcome;
use ppum::crack::{Crack, End};
use ppum::dataset::{TipIntensity, Warning};
use ppum::vec2::Vec2;

/// c, measured on arcs of 16 to 256 segments, some along their tangents and some inscribed, to 2 %.
const PER_KINK: f64 = 0.66;

/// Vertices behind a tip that are looked at.
const VERTICES: usize = 4;

/// Largest turn at a vertex of what may be a curve, and most that turns there differ, as a factor.
const LARGE_TURN: f64 = 0.25;
const ALIKE: f64 = 4.0;

/// Part of |K| / √(length of the crack) that T may be off by.
pub(super) const LARGE_T: f64 = 0.01;

/// The warning about T of a tip, if its crack may be meant as a curve.
pub(super) fn of_curve(
    outcome: &TipOutcome,
    factors: &TipIntensity,
    crack: &Crack,
    at: &str,
) -> Option<Warning> {
    let t = factors.t_stress?;
    let lacking = -PER_KINK * factors.k2 * unevenness(crack, outcome.tip.end)?;
    let part = lacking.abs() * crack.length().sqrt() / factors.k1.hypot(factors.k2);
    let message = format!(
        "tip {at}: if the crack is meant as a curve there, its T is about {}; the one told, {}, is that of the straight segments, \
         which K_II bends about their vertices; use shorter segments near the tip",
        short(t + lacking),
        short(t)
    );
    (part > LARGE_T).then(|| warning(kind::CURVE, Some(outcome.at), [part, LARGE_T], message))
}

/// Σ α_k / √s_k − ∫ κ / √s ds from a tip on, if its crack turns evenly there.
fn unevenness(crack: &Crack, end: End) -> Option<f64> {
    let mut points = crack.points.clone();
    if end == End::Start {
        points.reverse();
    }
    let points = points.last_chunk::<{ VERTICES + 2 }>()?;
    let sides: Vec<Vec2> = points.windows(2).map(|p| p[1] - p[0]).collect();
    let turn = |k: usize| {
        let [before, after] = [sides[k], sides[k + 1]];
        before.cross(after).atan2(before.dot(after))
    };
    // from the tip backwards
    let turns: Vec<f64> = (0..VERTICES).rev().map(turn).collect();
    let distances: Vec<f64> = (0..VERTICES).rev().map(|k| length(&sides[k + 1..])).collect();
    let last = VERTICES - 1;
    let is_even = |t: &f64| t / turns[last] > 1.0 / ALIKE && t / turns[last] < ALIKE;
    if !turns.iter().all(|t| is_even(t) && t.abs() < LARGE_TURN) {
        return None;
    }
    let near = turns.iter().zip(&distances).take(last).map(|(t, s)| t / s.sqrt());
    let (far, width) = (distances[last].sqrt(), sides[1].length());
    let curvature = turns[last] / width;
    let tail = turns[last] / (2.0 * far) * (1.0 + width / (12.0 * far * far));
    Some(near.sum::<f64>() + tail - 2.0 * curvature * far)
}

fn length(sides: &[Vec2]) -> f64 {
    sides.iter().map(|side| side.length()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Problem;
    use crate::solve::solve;
    use ppum::progress::unwatched;
    use std::fmt::Write;

    /// T of the first tip of an arc of ±0.9 in equal tension, given by a line of the problem, and
    /// what a curve has more.
    fn t_of(crack: &str) -> [f64; 2] {
        let mut text = format!(
            "[domain]\nmin = [-12, -12]\nmax = [12, 12]\n[material]\nyoung = 1\npoisson = 0.3\nstate = \"plane-strain\"\n\
             [[crack]]\n{crack}\n[discretization]\nlevel = 4\n"
        );
        for (side, load) in
            [("top", "[0, 1]"), ("bottom", "[0, -1]"), ("left", "[-1, 0]"), ("right", "[1, 0]")]
        {
            writeln!(text, "[[boundary]]\non = \"{side}\"\ntraction = {load}").expect("text");
        }
        let problem = Problem::parse(&text, "arc", std::path::Path::new(".")).expect("a problem");
        let dataset = solve(&problem, unwatched()).expect("a solution");
        let step = &dataset.steps[0];
        let factors = &step.intensities[0];
        let lacking = unevenness(&step.cracks[0], factors.tip.end).expect("a curve");
        [factors.t_stress.expect("T"), -PER_KINK * factors.k2 * lacking]
    }

    /// Polylines along tangents and inscribed ones, coarse and fine: their T differ by 40 %, those
    /// of their curve by 2 %.
    #[test]
    fn t_is_that_of_the_curve() {
        let arc = "arc = { center = [0, 0], radius = 1, from = \"90 + 0.9*180/pi\", to = \"90 - 0.9*180/pi\" }";
        let inscribed = |n: usize| {
            let angle = |k: usize| -0.9 + 1.8 * k as f64 / n as f64;
            let points: Vec<_> = (0..=n).map(|k| [angle(k).sin(), angle(k).cos()]).collect();
            format!("points = {points:?}")
        };
        let cracks =
            [format!("{arc}\nsegments = 16"), arc.to_owned(), inscribed(24), inscribed(60)];
        let all = cracks.map(|crack| t_of(&crack));
        let spread = |t: [f64; 4]| {
            let [least, most] =
                [f64::min, f64::max].map(|f| t.into_iter().reduce(f).expect("four"));
            (most - least) / most
        };
        let (told, of_curve) = (all.map(|[t, _]| t), all.map(|[t, lacking]| t + lacking));
        assert!(spread(told) > 0.3, "{told:?}");
        assert!(spread(of_curve) < 0.02, "{of_curve:?}");
    }

    /// Kinks are no curve, nor is what is straight.
    #[test]
    fn kinks_are_no_curves() {
        let crack = |y: [f64; 6]| {
            let points = (0..6).map(|k| ppum::vec2::vec2(k as f64, y[k])).collect();
            Crack { points, ends: [ppum::crack::CrackEnd::Tip; 2] }
        };
        for y in [[0.0; 6], [0.0, 0.0, 0.0, 0.0, 0.0, 0.2], [0.0, 0.1, 0.0, 0.1, 0.0, 0.1]] {
            assert_eq!(unevenness(&crack(y), End::Last), None, "{y:?}");
        }
        assert!(unevenness(&crack([0.0, 0.01, 0.04, 0.09, 0.16, 0.25]), End::Last).is_some());
    }
}
