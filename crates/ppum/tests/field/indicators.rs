//! Indicators of components where rounding would decide: against trees walked with 31 digits, and
//! on the segments themselves.

use ppum::crack::{Crack, CrackEnd, SegmentId, Side};
use ppum::function::{Cut, CutBranch, Function, FunctionKind, FunctionTable};
use ppum::jet::Jet;
use ppum::vec2::{Vec2, vec2};
use ppum_testkit::extended::{indicator, point};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::crack;

/// A table of one component.
fn table(cuts: &[Cut], cracks: &[Crack]) -> FunctionTable {
    let kind = FunctionKind::Component { cuts: cuts.to_vec() };
    let function = Function { name: "component".into(), kind };
    FunctionTable::new(&[function], cracks.len(), &[]).expect("a function")
}

/// The value on a side; a component has no derivatives.
fn value(table: &FunctionTable, cracks: &[Crack], anchor: Vec2, offset: Vec2) -> f64 {
    let mut jets = [Jet::constant(7.0)];
    table.at(cracks, anchor).evaluate::<f64, 2>(0, offset.into(), Side::Above, &mut jets);
    let [Jet { v, x, y, xx, xy, yy }] = jets;
    assert_eq!([x, y, xx, xy, yy], [0.0; 5]);
    v
}

/// Straight arms from a point in random directions, each a crack; some begin there and some end.
fn star(random: &mut Random, center: Vec2) -> Vec<Crack> {
    let mut arm = |_| {
        let end = center + random.direction() * random.between(0.3, 0.9);
        let points = if random.below(2) == 0 { [center, end] } else { [end, center] };
        crack(&points.map(<[f64; 2]>::from), [CrackEnd::Tip; 2])
    };
    (0..5).map(&mut arm).collect()
}

/// A random tree of cuts by the segments of cracks.
fn tree(random: &mut Random, cracks: &[Crack]) -> Vec<Cut> {
    let count = 1 + random.below(9);
    let mut part = |k: usize| {
        let next = k + 1 + random.below(3);
        let ends = [CutBranch::Inside, CutBranch::Outside][random.below(2)];
        if next < count { CutBranch::Cut(next as u32) } else { ends }
    };
    let parts: Vec<_> = (0..count).map(|k| [part(k), part(k)]).collect();
    let mut cut = |[left, right]: [CutBranch; 2]| {
        let crack = random.below(cracks.len());
        let segment = random.below(cracks[crack].points.len() - 1);
        let segment = SegmentId { crack: crack as u32, segment: segment as u32 };
        Cut { segment, left, right }
    };
    parts.into_iter().map(&mut cut).collect()
}

/// Compares, unless the point lies on a line up to a `margin`. Returns whether it did.
fn compare(cuts: &[Cut], cracks: &[Crack], anchor: Vec2, offset: Vec2, margin: f64) -> bool {
    let at = |d: Vec2| indicator(cuts, cracks, point(anchor, offset + d));
    let around = [vec2(1.0, 0.7), vec2(-0.7, 1.0), vec2(-1.0, -0.7), vec2(0.7, -1.0)];
    let exact = at(Vec2::ZERO);
    let sure = around.iter().all(|&d| at(d * margin) == exact);
    if sure {
        let found = value(&table(cuts, cracks), cracks, anchor, offset);
        assert_eq!(found, exact, "{offset:?} from {anchor:?}, {cuts:?} by {cracks:?}");
    }
    sure
}

/// Points from 1e-26 to 1e-13 beside a face of an arm; the anchor itself is not on it but some
/// 1e-17 off.
#[test]
fn beside_the_faces() {
    let (mut random, mut sure) = (Random(1), 0);
    for _ in 0..1500 {
        let center = random.direction() * random.between(0.0, 2.0);
        let cracks = star(&mut random, center);
        let cuts = tree(&mut random, &cracks);
        let [a, b] = [0, 1].map(|k| cracks[random.below(5)].points[k]);
        let anchor = a + (b - a) * random.between(0.1, 0.9);
        let tangent = (b - a).unit();
        let beside = tangent.left() * 10f64.powf(random.between(-26.0, -13.0));
        let offset = tangent * random.between(-1e-13, 1e-13) + beside;
        sure += usize::from(compare(&cuts, &cracks, anchor, offset, 1e-27));
        sure += usize::from(compare(&cuts, &cracks, anchor, -offset, 1e-27));
    }
    assert!(sure > 2800, "{sure}");
}

/// All round junctions: from 1e-26 to 1e-13 seen from the junction itself, from 1e-16 to 1e-9 seen
/// from 1e-9 beside. Half of the stars have an arm more that ends on the middle of another one,
/// where rounding has put it beside.
#[test]
fn around_junctions() {
    let (mut random, mut sure) = (Random(2), 0);
    for round in 0..4000 {
        let center = random.direction() * 0.7;
        let mut cracks = star(&mut random, center);
        let mut place = center;
        if round % 2 == 0 {
            let [a, b] = [0, 1].map(|k| cracks[0].points[k]);
            place = a + (b - a) * random.between(0.2, 0.8);
            let end = place + random.direction() * 0.3;
            cracks.push(crack(&[place.into(), end.into()], [CrackEnd::Junction, CrackEnd::Tip]));
        }
        let cuts = tree(&mut random, &cracks);
        let r = 10f64.powf(random.between(-26.0, -13.0));
        let offset = random.direction() * r;
        sure += usize::from(compare(&cuts, &cracks, place, offset, 1e-5 * r));
        let anchor = place + random.direction() * 1e-9;
        let r = 10f64.powf(random.between(-16.0, -9.0));
        let offset = (place - anchor) + random.direction() * r;
        sure += usize::from(compare(&cuts, &cracks, anchor, offset, 1e-5 * r));
    }
    assert!(sure > 7800, "{sure}");
}

/// Two cracks on one line, the second one against the first or along it, farther on; a third
/// across both.
fn collinear(random: &mut Random, opposite: bool) -> Vec<Crack> {
    let (a, along) = (random.direction() * 3.0, random.direction());
    let at = |t: f64| <[f64; 2]>::from(a + along * t);
    let second = if opposite { [at(1.7), at(1.0)] } else { [at(1.0), at(1.7)] };
    let across = a + along * 0.9 + random.direction() * 0.4;
    vec![
        crack(&[at(0.0), at(0.8)], [CrackEnd::Tip; 2]),
        crack(&second, [CrackEnd::Tip; 2]),
        crack(&[at(0.9), across.into()], [CrackEnd::Tip; 2]),
    ]
}

/// Points on a segment that rounding has put on it or on either side of it: functions seen on the
/// segment have the limits from the side that is asked for, whatever segments on the same line cut
/// the tree, and which way they run.
#[test]
fn told_where_points_lie() {
    let (mut random, mut both) = (Random(3), 0);
    for round in 0..2000 {
        let cracks = collinear(&mut random, round % 2 == 0);
        let cuts = tree(&mut random, &cracks);
        let table = table(&cuts, &cracks);
        let segment = SegmentId { crack: random.below(2) as u32, segment: 0 };
        let [a, b] = [0, 1].map(|k| cracks[segment.crack as usize].points[k]);
        let (place, normal) = (a + (b - a) * random.between(0.1, 0.9), (b - a).unit().left());
        let anchor = place + random.direction() * random.between(0.0, 0.1);
        let offset = (place - anchor) + normal * random.between(-1e-14, 1e-14);
        let on = [Side::Above, Side::Below].map(|side| {
            let mut jets = [Jet::constant(7.0)];
            let seen = table.on(&cracks, segment, anchor);
            seen.evaluate::<f64, 0>(0, offset.into(), side, &mut jets);
            jets[0].v
        });
        let limits =
            [1e-8, -1e-8].map(|step| value(&table, &cracks, anchor, offset + normal * step));
        assert_eq!(on, limits, "{segment:?}, {cuts:?} by {cracks:?}");
        both += usize::from(on[0] != on[1]);
    }
    assert!(both > 300, "{both} of the trees jump there");
}

/// Where a coordinate is exact, the side that is asked for decides without further ado: above a
/// segment that runs the other way is its right.
#[test]
fn the_caller_chooses_the_side_on_a_line() {
    let cracks = vec![
        crack(&[[-1.0, 0.0], [1.0, 0.0]], [CrackEnd::Tip; 2]),
        crack(&[[0.0, 0.0], [0.0, 1.0]], [CrackEnd::Junction, CrackEnd::Tip]),
    ];
    let id = |crack| SegmentId { crack, segment: 0 };
    // the example of FORMAT.md: x ≤ 0, y ≥ 0
    let cuts = [
        Cut { segment: id(0), left: CutBranch::Cut(1), right: CutBranch::Outside },
        Cut { segment: id(1), left: CutBranch::Inside, right: CutBranch::Outside },
    ];
    let table = table(&cuts, &cracks);
    let at = |x: f64, y: f64, side| {
        let mut jets = [Jet::constant(7.0)];
        table.at(&cracks, Vec2::ZERO).evaluate::<f64, 0>(0, [x, y], side, &mut jets);
        jets[0].v
    };
    for (x, y, above, below) in [
        (-0.5, 0.5, 1.0, 1.0),
        (0.5, 0.5, 0.0, 0.0),
        (-0.5, -0.5, 0.0, 0.0),
        (-0.5, 0.0, 1.0, 0.0),
        (0.0, 0.5, 1.0, 0.0),
        (0.0, 0.0, 1.0, 0.0),
        (-0.0, -0.0, 1.0, 0.0),
    ] {
        assert_eq!([at(x, y, Side::Above), at(x, y, Side::Below)], [above, below], "{x} {y}");
    }
}
