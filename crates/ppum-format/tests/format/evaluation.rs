//! Evaluation as FORMAT.md describes it where several readings are possible: its examples.

use std::f64::consts::PI;

use ppum::cover::Cover;
use ppum::crack::{Crack, CrackEnd, End, LocalCrack, Side, TipId};
use ppum::dataset::{Dataset, Equation, FieldData, Step};
use ppum::field::Field;
use ppum::function::{Frame, FunctionKind};
use ppum::jet::Jet;
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;

fn crack(points: &[[f64; 2]]) -> Crack {
    Crack::polyline(points.iter().map(|&p| p.into()).collect(), [CrackEnd::Tip; 2])
}

/// A potential on the box (−2, −2) to (2, 2) that is the sum of some functions with factors.
fn sum(functions: &[(f64, &str, Frame)], cracks: Vec<Crack>) -> Dataset {
    let domain = Rect::new(vec2(-2.0, -2.0), vec2(2.0, 2.0));
    let cover = Cover::grid(domain, [3, 3]).expect("a cover");
    let partition = cover.partition(1.5, WeightFunction::Linear).expect("a partition");
    let mut field = FieldData::new("potential", &["u"]);
    let blocks: Vec<_> = (0..functions.len() as u32).map(|function| (function, 0)).collect();
    for patch in 0..partition.len() {
        field.push_patch(&blocks);
        let values = field.coefficients_mut(patch).flatten();
        values.zip(functions).for_each(|(value, function)| *value = function.0);
    }
    let mut step = Step::new(partition).with_field(field);
    step.cracks = cracks;
    for (_, text, frame) in functions {
        step = step.with_function("", FunctionKind::formula(text, *frame));
    }
    let mut data = Dataset::new(domain, Equation::poisson(1.0)).with_step(step);
    data.program = "test".into();
    // as from a file
    let bytes = ppum_format::to_bytes(&data).expect("a dataset");
    ppum_format::from_bytes(bytes).expect("a file")
}

/// A quantity of one function at a point.
fn quantity(
    text: &str,
    frame: Frame,
    cracks: Vec<Crack>,
    name: &str,
    p: [f64; 2],
    side: Side,
) -> f64 {
    let data = sum(&[(1.0, text, frame)], cracks);
    let field = Field::new(&data, 0).expect("a field");
    let quantity = Quantity::parse(name, &field).expect("a quantity");
    quantity.at(&mut field.at(p.into()), Vec2::ZERO, side)
}

fn straight() -> Vec<Crack> {
    vec![crack(&[[-0.5, 0.25], [0.5, 0.25]])]
}

const LAST: Frame = Frame::Tip(TipId { crack: 0, end: End::Last });
const START: Frame = Frame::Tip(TipId { crack: 0, end: End::Start });

/// At the origin of a frame theta is 0, whichever side is asked for and whatever signs the
/// zeros have.
#[test]
fn the_angle_at_the_origin_is_zero() {
    let turned = |angle| Frame::Fixed { origin: vec2(0.5, 0.25), angle };
    for (frame, p) in [
        (LAST, [0.5, 0.25]),
        (START, [-0.5, 0.25]),
        (Frame::World, [0.0, 0.0]),
        (Frame::World, [-0.0, -0.0]),
        (turned(3.0), [0.5, 0.25]),
        (turned(-2.0), [0.5, 0.25]),
    ] {
        for side in [Side::Above, Side::Below] {
            for (text, value) in
                [("theta", 0.0), ("cos(theta/2)", 1.0), ("sin(theta/2)", 0.0), ("cos(theta)", 1.0)]
            {
                let found = quantity(text, frame, straight(), "u", p, side);
                assert_eq!(found, value, "{text} in {frame:?}, {side:?}");
            }
        }
    }
}

/// On the negative x axis of `world` and `fixed` theta is π for both zeros of y and for both sides.
#[test]
fn zeros_have_no_sign_in_frames() {
    for p in [[-1.0, 0.0], [-1.0, -0.0]] {
        for side in [Side::Above, Side::Below] {
            let theta = quantity("theta", Frame::World, vec![], "u", p, side);
            assert!((theta - PI).abs() < 1e-15, "{theta}");
        }
    }
    // the sign of a coordinate that is zero depends on how it was formed: both values are right
    for p in [[0.0, 1.0], [-0.0, 1.0]] {
        let found = quantity("1/x", Frame::World, vec![], "u", p, Side::Above);
        assert!(found.is_infinite(), "{found}");
    }
}

/// A quantity that names a derivative is +∞ where one of the field is infinite or does not exist:
/// at a tip with functions of its own, and where other functions have no gradient.
#[test]
fn quantities_where_there_is_no_gradient() {
    let inf = f64::INFINITY;
    let (tip, names) =
        ([0.5, 0.25], ["u", "du_dx", "-du_dx", "gradient", "energy", "if(x > 9, du_dy, 7)"]);
    let turned = Frame::Fixed { origin: vec2(0.0, 0.0), angle: 0.5 };
    for (text, frame, p, values) in [
        ("sqrt(r)*sin(theta/2)", LAST, tip, [0.0, inf, inf, inf, inf, inf]),
        // a tip without tip functions is a point like any other
        ("3*x", Frame::World, tip, [1.5, 3.0, -3.0, 3.0, 4.5, 7.0]),
        ("r^0.3", Frame::World, [0.0, 0.0], [0.0, inf, inf, inf, inf, inf]),
        ("sqrt(abs(x))", Frame::World, [0.0, 1.0], [0.0, inf, inf, inf, inf, inf]),
        ("sqrt(abs(x))", turned, [0.0, 0.0], [0.0, inf, inf, inf, inf, inf]),
        ("abs(x)", Frame::World, [0.0, 1.0], [0.0, 1.0, -1.0, 1.0, 0.5, 7.0]),
    ] {
        for (name, value) in names.into_iter().zip(values) {
            let found = quantity(text, frame, straight(), name, p, Side::Above);
            let near = found == value || (found - value).abs() < 1e-14;
            assert!(near, "{name} of {text}: {found}, not {value}");
        }
    }
}

/// Of segments that are equally near the one with the largest |dist| decides.
#[test]
fn the_side_behind_a_sharp_kink() {
    let fold = crack(&[[-1.0, 0.2], [0.0, 0.0], [-1.0, -0.2]]);
    let kink = crack(&[[-1.0, 1.0], [0.0, 0.0], [1.0, 1.0]]);
    for (crack, p, side) in [
        // nearest to both at the vertex; dist is 0.245 and -0.049, then -0.049 and 0.245
        (&fold, [0.5, 0.15], 1.0),
        (&fold, [0.5, -0.15], 1.0),
        (&fold, [-0.5, 0.0], -1.0),
        // as large: on the bisector, where the lines agree
        (&kink, [0.0, -1.0], -1.0),
        (&kink, [0.0, 1.0], 1.0),
        (&kink, [-0.5, -1.0], -1.0),
    ] {
        let found = LocalCrack::new(crack, p.into()).side([0.0, 0.0], Side::Above);
        assert_eq!(found, side, "{:?} {p:?}", crack.points);
    }
}

/// Coordinates are taken as they are: points that were rounded onto an oblique crack lie beside it.
#[test]
fn points_on_a_crack_up_to_rounding() {
    let oblique = crack(&[[0.0, 0.0], [1.0, 3.0]]);
    for (p, sides) in [
        ([0.5, 1.5], [1.0, -1.0]),
        // 3·0.1 is larger than 0.3, and 3·0.7 less than 2.1, for the doubles of these names
        ([0.1, 0.3], [-1.0, -1.0]),
        ([0.7, 2.1], [1.0, 1.0]),
    ] {
        let local = LocalCrack::new(&oblique, p.into());
        let found = [Side::Above, Side::Below].map(|side| local.side([0.0, 0.0], side));
        assert_eq!(found, sides, "{p:?}");
    }
}

/// If the argument of a decision is nearer to the place of the decision than its rounding, both
/// are right.
#[test]
fn decisions_within_rounding() {
    let text = "if(1 + x > 1, 1, 2)";
    let at = |x: f64| quantity(text, Frame::World, vec![], "u", [x, 0.0], Side::Above);
    assert_eq!([at(-1e-3), at(0.0), at(1e-3)], [2.0, 2.0, 1.0]);
    // exact arithmetic says 1
    assert!(at(1e-17) == 1.0 || at(1e-17) == 2.0);
}

/// The error is relative to the sum of the parts' magnitudes: 1e16 - 1e16 cos(x) = 2e16 sin²(x/2).
#[test]
fn parts_that_cancel() {
    let data = sum(&[(1e16, "1 + 0*x", Frame::World), (-1e16, "cos(x)", Frame::World)], vec![]);
    let field = Field::new(&data, 0).unwrap();
    for x in [1e-3, 1e-2, 0.3, 1.7] {
        let mut u = [Jet::constant(0.0)];
        assert!(field.at(vec2(x, 0.4)).evaluate::<0>(Vec2::ZERO, Side::Above, &mut u));
        let (exact, parts) = (2e16 * (x / 2.0).sin().powi(2), 1e16 * (1.0 + x.cos().abs()));
        let error = (u[0].v - exact).abs();
        assert!(error <= 16.0 * f64::EPSILON * parts, "{x}: {error:e}");
    }
}
