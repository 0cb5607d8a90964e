//! Blocks of points on lanes against one point at a time.

use super::random::{point, sample, scope};
use super::{Formula, FormulaJets, Scope, WESTERGAARD, polar, same};
use crate::graph::Op;
use crate::lanes::{GREATEST_SQUARE, LEAST_SQUARE};
use crate::operation::Binary;
use crate::real::{LaneNumber, narrowed};
use crate::{Block, BlockScratch, Table};
use ppum_testkit::random::Random;

/// Numbers that meet every corner of the operations.
const SPICY: [f64; 21] = [
    0.0,
    -0.0,
    1.0,
    -1.0,
    0.5,
    2.0,
    3.0,
    -2.5,
    0.3,
    -7.0,
    1e-3,
    1e-8,
    1e-160,
    1e-320,
    1e160,
    -1e300,
    f64::MAX,
    f64::INFINITY,
    f64::NEG_INFINITY,
    f64::NAN,
    std::f64::consts::PI,
];

/// Every pair of them.
fn spicy() -> Vec<[f64; 2]> {
    SPICY.iter().flat_map(|&x| SPICY.map(|y| [x, y])).collect()
}

fn compile(formulas: &[Formula], order: usize) -> FormulaJets {
    FormulaJets::new(&formulas.iter().collect::<Vec<_>>(), order).expect("small")
}

fn parse(texts: &[&str], scope: &Scope) -> Vec<Formula> {
    texts.iter().map(|text| Formula::parse(text, scope).expect("valid")).collect()
}

/// The outputs at each point, which are the same on processors without vectors, to the last bit.
fn on_lanes<T: LaneNumber, const N: usize>(jets: &FormulaJets, points: &[[f64; N]]) -> Vec<Vec<T>> {
    let results: Vec<Vec<T>> = by_blocks(jets, points);
    let narrow = narrowed(|| by_blocks::<T, N>(jets, points));
    for (a, b) in results.iter().flatten().zip(narrow.iter().flatten()) {
        assert!(same(a.to_f64(), b.to_f64()), "{a:?} on vectors, {b:?} without");
    }
    results
}

/// The outputs at each point, by blocks.
fn by_blocks<T: LaneNumber, const N: usize>(
    jets: &FormulaJets,
    points: &[[f64; N]],
) -> Vec<Vec<T>> {
    let mut scratch = BlockScratch::default();
    let mut block = jets.block(&mut scratch);
    let mut results = Vec::new();
    for points in points.chunks(Block::<T>::POINTS) {
        for input in 0..N {
            for (to, point) in block.input(input).iter_mut().zip(points) {
                *to = T::from_f64(point[input]);
            }
        }
        block.run();
        let at = |k| (0..jets.n_outputs()).map(|output| block.output(output)[k]).collect();
        results.extend((0..points.len()).map(at));
    }
    results
}

/// Asserts that double precision on lanes is the scalar back end, to the last bit.
#[track_caller]
fn assert_same<const N: usize>(jets: &FormulaJets, points: &[[f64; N]], what: &str) {
    let mut expected = vec![0.0; jets.n_outputs()];
    for (point, found) in points.iter().zip(on_lanes::<f64, N>(jets, points)) {
        jets.evaluate(point, &mut Vec::new(), &mut expected);
        for (k, (found, expected)) in found.into_iter().zip(&expected).enumerate() {
            let agree = same(found, *expected);
            assert!(agree, "{what}, output {k} at {point:?}: {found:e}, not {expected:e}");
        }
    }
}

/// Each operation with numbers and constants in each place.
const OPERATIONS: [&str; 61] = [
    "-x",
    "sqrt(x)",
    "cbrt(x)",
    "exp(x)",
    "log(x)",
    "log10(x)",
    "sin(x)",
    "cos(x)",
    "tan(x)",
    "asin(x)",
    "acos(x)",
    "atan(x)",
    "sinh(x)",
    "cosh(x)",
    "tanh(x)",
    "abs(x)",
    "sign(x)",
    "floor(x)",
    "x + y",
    "x + 0.1",
    "x - y",
    "x - 0.1",
    "0.1 - x",
    "x*y",
    "x*0.1",
    "x/y",
    "x/0.1",
    "0.1/x",
    "x^y",
    "x^0.3",
    "0.3^x",
    "atan2(x, y)",
    "atan2(x, -1)",
    "atan2(0, x)",
    "min(x, y)",
    "min(x, 1)",
    "max(x, y)",
    "max(1, x)",
    "hypot(x, y)",
    "hypot(x, 3)",
    "clamp(x, -1, y)",
    "x*y + x",
    "x*y + 3",
    "x*3 + y",
    "x*3 + 2",
    "x*y - x",
    "x - x*y",
    "2 - x*0.1",
    "x*y*x",
    "x*y/x",
    "x*0.1/3",
    "x*y + x^2",
    "x*y - y^2",
    "2*x + 3*y",
    "if(x < y, x, y)",
    "if(x <= 1, 2, y)",
    "if(1 == x, x, 3)",
    "if(x != y, 1, -1)",
    "if(not (x == y) and not (x < 0), x*y, y)",
    "if(x < y or y > 2, x, y + 1)",
    "if(x < y and (x > 1 or not (y < 0)), x, y)",
];

#[test]
fn operations() {
    let points = spicy();
    for text in OPERATIONS {
        let formula = parse(&[text], &Scope::cartesian());
        for order in 0..=2 {
            assert_same(&compile(&formula, order), &points, &format!("{text}, order {order}"));
        }
    }
    // and all together, where slots are shared
    let all = compile(&parse(&OPERATIONS, &Scope::cartesian()), 1);
    assert_same(&all, &points, "all together");
}

#[test]
fn integer_powers() {
    let texts: Vec<String> = (-17..=17).map(|n| format!("x^({n})")).collect();
    let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
    let points: Vec<[f64; 2]> = spicy();
    assert_same(&compile(&parse(&texts, &Scope::cartesian()), 1), &points, "powers");
}

#[test]
fn tables() {
    let curve = Table::curve("k", vec![-1.0, 0.0, 0.5, 2.0], vec![1.0, 2.0, 0.0, 3.0]);
    let surface = Table::surface("g", vec![0.0, 1.0], vec![0.0, 2.0], vec![1.0, 2.0, 3.0, 7.0]);
    let scope = [curve, surface].into_iter().fold(Scope::cartesian(), |scope, table| {
        scope.with_table(table.expect("valid").into()).expect("a new name")
    });
    let texts = ["table(k, x)", "table(g, x, y)", "table(g, 0.5, x*y)", "table(g, x, 1)*y"];
    assert_same(&compile(&parse(&texts, &scope), 2), &spicy(), "tables");
}

#[test]
fn random_formulas() {
    let mut random = Random(0x853C_49E6_748F_EA9B);
    let points: Vec<[f64; 6]> = (0..70)
        .map(|_| polar(random.between(-2.0, 2.0), random.between(-2.0, 2.0)))
        .chain([polar(0.0, 0.0), polar(-1.0, 0.0), polar(-1.0, -0.0), polar(1e-200, 1e200)])
        .collect();
    for _ in 0..300 {
        let texts: Vec<String> =
            (0..3).map(|_| sample(&mut random, &point(0.3, 0.4), 5).text).collect();
        let texts: Vec<&str> = texts.iter().map(String::as_str).collect();
        let jets = compile(&parse(&texts, &scope()), random.below(3));
        assert_same(&jets, &points, &texts.join("\n"));
    }
}

/// The program with every result rounded to single precision: what single precision on lanes must
/// give to the last bit, since rounding a sum, product, quotient or root of two such numbers twice
/// is rounding it once (Figueroa 1995).
fn rounded(jets: &FormulaJets, inputs: &[f64]) -> Vec<f32> {
    let program = jets.program();
    let mut values: Vec<f64> = Vec::new();
    for &op in program.ops() {
        let value = match op {
            Op::Power(a, n) => rounded_power(values[a.index()] as f32, n).into(),
            Op::Binary(Binary::Hypot, a, b) => {
                rounded_hypot(values[a.index()] as f32, values[b.index()] as f32).into()
            }
            _ => program.execute(op, inputs, &values),
        };
        values.push(f64::from(value as f32));
    }
    program.outputs().iter().map(|output| values[output.index()] as f32).collect()
}

fn rounded_hypot(a: f32, b: f32) -> f32 {
    let sum = a * a + b * b;
    let is_usual = f64::from(sum) > LEAST_SQUARE && f64::from(sum) < GREATEST_SQUARE;
    if is_usual { sum.sqrt() } else { f64::from(a).hypot(b.into()) as f32 }
}

fn rounded_power(a: f32, n: i32) -> f32 {
    let (mut square, mut rest, mut product) = (a, n.unsigned_abs(), 1.0);
    while rest > 0 {
        if rest & 1 == 1 {
            product *= square;
        }
        square *= square;
        rest >>= 1;
    }
    if n < 0 { 1.0 / product } else { product }
}

#[test]
fn single_precision() {
    let check = |jets: &FormulaJets, points: &[[f64; 6]], what: &str| {
        for (inputs, found) in points.iter().zip(on_lanes::<f32, 6>(jets, points)) {
            for (found, expected) in found.into_iter().zip(rounded(jets, inputs)) {
                let agree = same(found.into(), expected.into());
                assert!(agree, "{what} at {inputs:?}: {found:e}, not {expected:e}");
            }
        }
    };
    let single = |inputs: [f64; 6]| inputs.map(|v| f64::from(v as f32));
    let spicy: Vec<[f64; 6]> = spicy().into_iter().map(|[x, y]| single(polar(x, y))).collect();
    check(&compile(&parse(&OPERATIONS, &Scope::polar()), 1), &spicy, "operations");
    let mut random = Random(0x9FB2_1C65_1E98_DF25);
    for _ in 0..500 {
        let text = sample(&mut random, &point(0.3, 0.4), 5).text;
        let [x, y] = [(); 2].map(|()| random.between(-2.0, 2.0));
        let jets = compile(&parse(&[&text], &scope()), random.below(3));
        check(&jets, &[single(polar(x, y))], &text);
    }
}

#[test]
fn westergaard() {
    let formulas = parse(&WESTERGAARD, &Scope::polar());
    let mut points: Vec<[f64; 6]> = (0..200)
        .map(|k| {
            let angle = f64::from(k) * 0.07;
            polar(angle.cos() * 0.1f64.powi(k % 9), angle.sin() * 0.1f64.powi(k % 9))
        })
        .collect();
    points.extend([polar(0.0, 0.0), polar(-1.0, 0.0), polar(-1.0, -0.0)]);
    for order in 0..=2 {
        assert_same(&compile(&formulas, order), &points, "Westergaard");
    }
}

/// Outputs that are inputs, constants, or each other; inputs that stay.
#[test]
fn plain_outputs_and_inputs_that_stay() {
    let jets = compile(&parse(&["y", "2.5", "x + y", "y + x", "y"], &Scope::cartesian()), 0);
    let mut scratch = BlockScratch::<f32>::default();
    let mut block = jets.block(&mut scratch);
    block.input(1).fill(3.0);
    for x in [1.0, 2.0] {
        block.input(0).fill(x);
        block.run();
        for (output, value) in [3.0, 2.5, x + 3.0, x + 3.0, 3.0].into_iter().enumerate() {
            assert_eq!(block.output(output), [value; Block::<f32>::POINTS]);
        }
    }
}

/// One memory serves formulas of any size.
#[test]
fn memory_is_reused() {
    let mut scratch = BlockScratch::<f64>::default();
    for texts in [&["x"][..], &OPERATIONS, &["x*y"]] {
        let jets = compile(&parse(texts, &Scope::cartesian()), 0);
        let mut block = jets.block(&mut scratch);
        block.input(0).fill(3.0);
        block.input(1).fill(0.5);
        block.run();
        let mut expected = vec![0.0; jets.n_outputs()];
        jets.evaluate(&[3.0, 0.5], &mut Vec::new(), &mut expected);
        assert!((0..texts.len()).all(|k| same(block.output(k)[63], expected[k])));
    }
}
