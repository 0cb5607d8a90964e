//! Sides of cracks where rounding would decide: against rays counted with 31 digits.

use ppum::crack::{Crack, CrackEnd, End, LocalCrack, LocalTip, SegmentId, Side, TipId};
use ppum::function::{
    Frame, Function, FunctionKind, FunctionTable, GROUP, LocalFunctions, WESTERGAARD,
};
use ppum::jet::Jet;
use ppum::real::LaneNumber;
use ppum::vec2::{Vec2, vec2};
use ppum_testkit::extended::{point, side};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::crack;

/// Compares, unless the point lies on the crack up to a `margin`. Returns whether it did.
fn compare<T: LaneNumber>(crack: &Crack, anchor: Vec2, offset: Vec2, margin: f64) -> bool {
    let at = |d: Vec2| side(crack, point(anchor, offset + d));
    let around = [vec2(1.0, 0.7), vec2(-0.7, 1.0), vec2(-1.0, -0.7), vec2(0.7, -1.0)];
    let exact = at(Vec2::ZERO);
    let sure = around.iter().all(|&d| at(d * margin) == exact);
    if sure {
        let offset = [offset.x, offset.y].map(T::from_f64);
        let found = LocalCrack::new(crack, anchor).side(offset, Side::Above);
        assert_eq!(
            found,
            T::from_f64(exact),
            "{offset:?} from {anchor:?}, crack {:?}",
            crack.points
        );
    }
    sure
}

/// Points from 1e-26 to 1e-13 beside the middle of oblique cracks; the anchor itself is not on the
/// crack but some 1e-17 off, and only exact arithmetic tells on which side.
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
        sure += usize::from(compare::<f64>(&crack, anchor, offset, 1e-27));
        sure += usize::from(compare::<f64>(&crack, anchor, -offset, 1e-27));
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
        sure += usize::from(compare::<f64>(&crack, anchor, offset, 1e-5 * r));
    }
    assert!(sure > 4900, "{sure}");
}

/// All round blunt and sharp kinks, in single precision: right but for the roundings of
/// coordinates, however far the anchor is, as it is in a picture.
#[test]
fn around_kinks_in_single_precision() {
    let (mut random, mut sure) = (Random(4), 0);
    for _ in 0..5000 {
        let (kink, arm) = (random.direction() * 0.7, random.direction());
        let (turn, sign) = (random.between(0.1, 3.0), [-1.0, 1.0][random.below(2)]);
        let other = arm * turn.cos() + arm.left() * (sign * turn.sin());
        let points = [kink + arm * 0.4, kink, kink + other * 0.3];
        let crack = crack(&points.map(<[f64; 2]>::from), [CrackEnd::Tip; 2]);
        let anchor = kink + random.direction() * random.between(0.0, 1.0);
        let place = kink + random.direction() * 10f64.powf(random.between(-3.0, 0.0));
        sure += usize::from(compare::<f32>(&crack, anchor, place - anchor, 2e-6));
    }
    assert!(sure > 4900, "{sure}");
}

/// Sides, tip functions of both ends by kernel and by formula, and formulas of sides, for
/// two cracks.
fn functions(tips: &[TipId]) -> Vec<Function> {
    let side = (0..2).map(|crack| FunctionKind::Side { crack });
    let sides = ["x*side(0) + side(1)", "side(0)*side(1)"];
    let formulas = WESTERGAARD.into_iter().chain(["theta", "sqrt(r)*sin(theta/2)*side(0)"]);
    let at_tip =
        |tip| formulas.clone().map(move |text| FunctionKind::formula(text, Frame::Tip(tip)));
    let at_tips = tips.iter().copied().flat_map(at_tip);
    let named = |kind| Function { name: "any".into(), kind };
    let world = sides.map(|text| FunctionKind::formula(text, Frame::World));
    side.chain(at_tips).chain(world).map(named).collect()
}

fn all(local: &LocalFunctions<'_>, offset: Vec2, side: Side) -> Vec<Jet<f64>> {
    let mut jets = [Jet::constant(0.0); GROUP];
    let mut groups = |group| {
        local.evaluate::<f64, 1>(group, offset.into(), side, &mut jets);
        jets[..local.table().group_len(group)].to_vec()
    };
    (0..local.table().groups()).flat_map(&mut groups).collect()
}

/// Points on a segment that rounding has put on it or on either side of it: functions seen on the
/// segment have the limits from the side that is asked for, and θ behind a tip is ±π to the
/// last bit.
#[test]
fn told_where_points_lie() {
    let mut random = Random(3);
    for round in 0..400 {
        let far = random.direction() * [0.0, 1.0, 1e3, 1e6][round % 4];
        let turn = if round % 3 == 0 { 0.0 } else { random.between(-1.2, 1.2) };
        let (arm, kink) = (random.direction(), far + random.direction() * 0.2);
        let other = arm * turn.cos() + arm.left() * turn.sin();
        let points = [kink - arm * random.between(0.5, 1.0), kink, kink + other * 0.7];
        let away = kink + arm.left() * 3.0;
        let cracks = [
            crack(&points.map(<[f64; 2]>::from), [CrackEnd::Tip; 2]),
            crack(&[away.into(), (away + other).into()], [CrackEnd::Tip; 2]),
        ];
        let tips = [End::Start, End::Last].map(|end| TipId { crack: 0, end });
        let table = FunctionTable::new(&functions(&tips), 2, &[]).expect("functions");
        let k = random.below(2);
        let segment = SegmentId { crack: 0, segment: k as u32 };
        let [a, b] = [points[k], points[k + 1]];
        let (place, normal) = (a + (b - a) * random.between(0.1, 0.9), (b - a).unit().left());
        let anchor = place + random.direction() * random.between(0.0, 0.1);
        let noise = 4.0 * f64::EPSILON * (1.0 + far.length());
        let offset = (place - anchor) + normal * random.between(-noise, noise);
        for (side, sign) in [(Side::Above, 1.0), (Side::Below, -1.0)] {
            let on = all(&table.on(&cracks, segment, anchor), offset, side);
            let beside = offset + normal * (sign * 1e-8);
            let limit = all(&table.at(&cracks, anchor), beside, side);
            for (index, (on, limit)) in on.iter().zip(&limit).enumerate() {
                // what the functions and their slopes change by on the way, at most 30 of 1/r²
                for (found, expected) in [(on.v, limit.v), (on.x, limit.x), (on.y, limit.y)] {
                    let scale = 1.0 + far.length() * f64::from(u8::from(index > 13));
                    let apart = (found - expected).abs();
                    assert!(apart < 1e-5 * scale, "round {round}, {index}: {found} {expected}");
                }
            }
            let own = [End::Start, End::Last][k];
            let tip = LocalTip::on(&cracks[0], segment.segment, own, anchor);
            let left = if own == End::Last { sign } else { -sign };
            let (_, theta) = tip.point(offset.into(), side).polar();
            assert_eq!(theta, left * std::f64::consts::PI, "round {round}");
        }
    }
}
