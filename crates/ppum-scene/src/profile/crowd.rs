//! Points of curves that crowd at crack tips, where displacements go like the root of the distance:
//! between points at equal distances a root is a polygon.

use std::f64::consts::PI;

use ppum::crack::{Crack, End, tips};
use ppum::quantity::Quantity;
use ppum::vec2::Vec2;

/// True for quantities that tips leave finite. Those that are infinite there have no points that
/// crowd: the nearer a point is, the larger would be the range of the plot.
pub(super) fn is_finite_at_tips(quantities: &[(String, Quantity)]) -> bool {
    let is_finite =
        |quantity: &Quantity| matches!(quantity, Quantity::Component(_) | Quantity::Magnitude);
    quantities.iter().all(|(_, quantity)| is_finite(quantity))
}

/// The ends of a crack that are tips, as parts of its length.
pub(super) fn on_crack(cracks: &[Crack], index: usize) -> Vec<f64> {
    let own = tips(cracks).filter(|tip| tip.crack as usize == index);
    own.map(|tip| if tip.end == End::Start { 0.0 } else { 1.0 }).collect()
}

/// The tips that lie on the line from `anchor + a` to `anchor + b`, as parts of its length.
pub(super) fn on_line(cracks: &[Crack], [anchor, a, b]: [Vec2; 3]) -> Vec<f64> {
    let way = b - a;
    let place = |tip: Vec2| {
        let from = (tip - anchor) - a;
        let is_on = from.cross(way).abs() <= NEAR * way.dot(way);
        Some(from.dot(way) / way.dot(way)).filter(|t| is_on && (0.0..=1.0).contains(t))
    };
    tips(cracks).filter_map(|tip| place(cracks[tip.crack as usize].end_point(tip.end))).collect()
}

/// Distance from a line up to which a tip lies on it, in parts of the line's length.
const NEAR: f64 = 1e-9;

/// Rising positions from 0 to 1, so many and the tips, which they crowd at:
/// t = a + (b − a) sin²(π w/2) between two tips a and b, with w² in place of sin² beside one.
pub(super) fn crowded(tips: &[f64], count: usize) -> Vec<f64> {
    let mut breaks: Vec<f64> = [0.0, 1.0].into_iter().chain(tips.iter().copied()).collect();
    breaks.sort_by(f64::total_cmp);
    breaks.dedup();
    let is_tip = |t: f64| tips.contains(&t);
    let position = |u: f64| {
        let next = breaks.partition_point(|b| *b <= u).clamp(1, breaks.len() - 1);
        let [a, b] = [breaks[next - 1], breaks[next]];
        let w = (u - a) / (b - a);
        a + (b - a)
            * match (is_tip(a), is_tip(b)) {
                (true, true) => (0.5 * PI * w).sin().powi(2),
                (true, false) => w * w,
                (false, true) => w * (2.0 - w),
                (false, false) => w,
            }
    };
    let even = (0..count).map(|k| k as f64 / count.saturating_sub(1).max(1) as f64);
    let mut all: Vec<f64> = even.map(position).chain(breaks.iter().copied()).collect();
    all.sort_by(f64::total_cmp);
    all.dedup_by(|a, b| *a - *b < SAME);
    if let Some(last) = all.last_mut() {
        *last = 1.0;
    }
    all
}

/// Positions that are the same but for rounding.
const SAME: f64 = 1e-14;

#[cfg(test)]
mod tests {
    use super::*;
    use ppum_testkit::random::Random;

    /// The lines between the points are as near to the root of the distance from each tip as the
    /// largest step in w says: √(b − a) π/8 Δw. Points at equal distances are a quarter of √Δt off.
    #[test]
    fn roots_are_smooth() {
        let mut random = Random(7);
        for _ in 0..200 {
            let count = 20 + random.below(200);
            let tips: Vec<f64> = (0..=random.below(3)).map(|_| random.between(0.0, 1.0)).collect();
            let all = crowded(&tips, count);
            assert!(all.windows(2).all(|pair| pair[0] < pair[1]), "{all:?}");
            assert!(all[0] == 0.0 && all[all.len() - 1] == 1.0);
            for tip in &tips {
                assert!(all.iter().any(|t| (t - tip).abs() < SAME));
            }
            let mut ends = tips.clone();
            ends.extend([0.0, 1.0]);
            ends.sort_by(f64::total_cmp);
            let gaps = ends.windows(2).map(|pair| pair[1] - pair[0]).filter(|gap| *gap > SAME);
            let least = gaps.fold(1.0, f64::min);
            let bound = 0.125 * PI / (count as f64 - 1.0) / least.sqrt();
            for pair in all.windows(2) {
                for tip in &tips {
                    let root = |t: f64| (t - tip).abs().sqrt();
                    let far = |part: f64| {
                        let line = (1.0 - part) * root(pair[0]) + part * root(pair[1]);
                        root((1.0 - part) * pair[0] + part * pair[1]) - line
                    };
                    let most = [0.1, 0.25, 0.5, 0.75].map(far).into_iter().fold(0.0, f64::max);
                    assert!(most <= bound + 1e-12, "{tips:?}, {count}: {most} at {pair:?}");
                }
            }
        }
        assert_eq!(crowded(&[], 5), [0.0, 0.25, 0.5, 0.75, 1.0]);
    }
}
