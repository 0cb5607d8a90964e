//! Sides of cracks where rounding would decide: against rays counted with 31 digits.

use ppum::crack::{Crack, CrackEnd, LocalCrack, Side};
use ppum::vec2::{Vec2, vec2};
use ppum_testkit::extended::{point, side};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::crack;

/// Compares, unless the point lies on the crack up to a `margin`. Returns whether it did.
fn compare(crack: &Crack, anchor: Vec2, offset: Vec2, margin: f64) -> bool {
    let at = |d: Vec2| side(crack, point(anchor, offset + d));
    let around = [vec2(1.0, 0.7), vec2(-0.7, 1.0), vec2(-1.0, -0.7), vec2(0.7, -1.0)];
    let exact = at(Vec2::ZERO);
    let sure = around.iter().all(|&d| at(d * margin) == exact);
    if sure {
        let found = LocalCrack::new(crack, anchor).side(offset.into(), Side::Above);
        assert_eq!(found, exact, "{offset:?} from {anchor:?}, crack {:?}", crack.points);
    }
    sure
}

/// Points from 1e-26 to 1e-13 beside the middle of oblique cracks; the anchor itself is not on the crack
/// but some 1e-17 off, and only exact arithmetic tells on which side.
#[test]
fn beside_the_faces() {
    let (mut random, mut sure) = (Random(1), 0);
    for _ in 0..2000 {
        let (a, b) = (random.direction() * 3.0, random.direction());
        let crack = crack(&[a.into(), b.into()], [CrackEnd::Tip; 2]);
        let anchor = a + (b - a) * random.between(0.1, 0.9);
        let tangent = (b - a).unit();
        let beside = tangent.left() * 10f64.powf(random.between(-26.0, -13.0));
        let offset = tangent * random.between(-1e-13, 1e-13) + beside;
        sure += usize::from(compare(&crack, anchor, offset, 1e-27));
        sure += usize::from(compare(&crack, anchor, -offset, 1e-27));
    }
    assert!(sure > 3500, "{sure}");
}

/// All round blunt and sharp kinks, from 1e-16 to 1e-9 away, seen from an anchor 1e-9 beside them.
#[test]
fn around_kinks() {
    let (mut random, mut sure) = (Random(2), 0);
    for _ in 0..5000 {
        let kink = random.direction() * 0.7;
        let arm = random.direction();
        let turn = random.between(0.3, 2.8) * if random.below(2) == 0 { 1.0 } else { -1.0 };
        let other = arm * turn.cos() + arm.left() * turn.sin();
        let points = [kink + arm * 0.4, kink, kink + other * 0.3];
        let crack = crack(&points.map(<[f64; 2]>::from), [CrackEnd::Tip; 2]);
        let anchor = kink + random.direction() * 1e-9;
        let r = 10f64.powf(random.between(-16.0, -9.0));
        let offset = (kink - anchor) + random.direction() * r;
        sure += usize::from(compare(&crack, anchor, offset, 1e-5 * r));
    }
    assert!(sure > 4900, "{sure}");
}
