//! K and T of cracks that are curves to their user, and polylines here.
//!
//! K of a polyline with turns α is off by a part of up to 7e-3 α^(3/2), which is added to its
//! estimated error. T is off by more: a kink of angle α at the distance s from a tip changes T
//! there by −c α K_II / √s, to first order, and a curve is the sum of its kinks. The difference
//! between the curve and its polyline,
//!
//! ```text
//! T_curve − T = −c K_II ( Σ α_k / √s_k − ∫ κ / √s ds )
//! ```
//!
//! falls like the root of the segments' length. The curve goes on as at the last of the vertices
//! that are looked at, where the formula of Euler and Maclaurin ends the sum.

use super::{above, short};
use crate::intensity::TipResult;
use ppum::crack::{Crack, End};
use ppum::dataset::{TipIntensity, Warning, WarningKind};
use ppum::vec2::Vec2;

/// c, measured on arcs of 16 to 256 segments, some along their tangents and some inscribed, to 2 %.
const PER_KINK: f64 = 0.66;

/// Error of K over |K| α^(3/2), see docs/decisions/0018.
const PER_TURN: f64 = 7e-3;

/// Vertices behind a tip that are looked at.
const VERTICES: usize = 4;

/// Largest turn at a vertex of what may be a curve, and most that turns there differ, as a factor.
const LARGE_TURN: f64 = 0.25;
const ALIKE: f64 = 4.0;

/// Part of |K| / √(length of the crack) that T may be off by.
pub(super) const LARGE_T: f64 = 0.01;

/// The warning about T of a tip, if its crack may be meant as a curve.
pub(super) fn of_curve(
    outcome: &TipResult,
    factors: &TipIntensity,
    crack: &Crack,
    at: &str,
) -> Option<Warning> {
    let t = factors.t_stress?;
    let lacking = -PER_KINK * factors.k2 * TipTurns::new(crack, outcome.tip.end)?.unevenness();
    let part = lacking.abs() * crack.length().sqrt() / factors.k1.hypot(factors.k2);
    let message = format!(
        "tip {at}: if the crack is meant as a curve there, its T is about {}; the one told, {}, is that of the straight segments, \
         which K_II bends about their vertices; use shorter segments near the tip",
        short(t + lacking),
        short(t)
    );
    above(WarningKind::Curve, Some(outcome.at), [part, LARGE_T], message)
}

/// The part of |K| that K of a tip may be off by, if its crack may be meant as a curve.
pub(crate) fn error_of_segments(crack: &Crack, end: End) -> f64 {
    TipTurns::new(crack, end).map_or(0.0, |turns| PER_TURN * turns.largest().powf(1.5))
}

/// The turns at the vertices behind a tip of a crack that turns evenly there, and their distances
/// from it along the crack; the nearest first.
struct TipTurns {
    turns: [f64; VERTICES],
    distances: [f64; VERTICES],
    /// Length of the segment before the last vertex.
    width: f64,
}

impl TipTurns {
    /// None of a crack that does not turn evenly.
    fn new(crack: &Crack, end: End) -> Option<Self> {
        let mut points = crack.points.clone();
        if end == End::Start {
            points.reverse();
        }
        let points = points.last_chunk::<{ VERTICES + 2 }>()?;
        let sides: Vec<Vec2> = points.windows(2).map(|p| p[1] - p[0]).collect();
        // from the tip backwards
        let turn = |k: usize| {
            let [before, after] = [VERTICES - 1 - k, VERTICES - k].map(|side| sides[side]);
            before.cross(after).atan2(before.dot(after))
        };
        let turns: [f64; VERTICES] = std::array::from_fn(turn);
        let distances = std::array::from_fn(|k| length(&sides[VERTICES - k..]));
        let part = |t: &f64| t / turns[VERTICES - 1];
        let is_even = |t: &f64| part(t) > 1.0 / ALIKE && part(t) < ALIKE && t.abs() < LARGE_TURN;
        turns.iter().all(is_even).then_some(Self { turns, distances, width: sides[1].length() })
    }

    fn largest(&self) -> f64 {
        self.turns.iter().fold(0.0, |most, turn| turn.abs().max(most))
    }

    /// Σ α_k / √s_k − ∫ κ / √s ds from the tip on.
    fn unevenness(&self) -> f64 {
        let Self { turns, distances, width } = self;
        let last = VERTICES - 1;
        let near = turns.iter().zip(distances).take(last).map(|(t, s)| t / s.sqrt());
        let (far, curvature) = (distances[last].sqrt(), turns[last] / width);
        let tail = turns[last] / (2.0 * far) * (1.0 + width / (12.0 * far * far));
        near.sum::<f64>() + tail - 2.0 * curvature * far
    }
}

fn length(sides: &[Vec2]) -> f64 {
    sides.iter().map(|side| side.length()).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::solve::solve;
    use ppum::progress::unwatched;
    use ppum_problem::Problem;
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
        let turns = TipTurns::new(&step.cracks[0], factors.tip.end).expect("a curve");
        [factors.t_stress.expect("T"), -PER_KINK * factors.k2 * turns.unevenness()]
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
            assert!(TipTurns::new(&crack(y), End::Last).is_none(), "{y:?}");
        }
        assert!(error_of_segments(&crack([0.0, 0.01, 0.04, 0.09, 0.16, 0.25]), End::Last) > 0.0);
    }
}
