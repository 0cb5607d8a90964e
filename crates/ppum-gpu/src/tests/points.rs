//! Functions of shaders against the functions of `ppum` they are twins of, in double precision at
//! the same rounded inputs.
//!
//! Tolerances count unit roundoffs u = 2⁻²⁴ of the size of the terms that are added. WGSL allows 5
//! u for a division and 9 u for a root; sums and products have 1 u.

use ppum::cover::Cover;
use ppum::crack::{
    Crack, CrackEnd, End, LocalCrack, LocalSegment, LocalTip, SegmentId, Side, TipId, TipPoint,
};
use ppum::dataset::{Step, monomials};
use ppum::domain::{Domain, Hole, PolygonSide};
use ppum::edge::Edge;
use ppum::function::{Cut, CutBranch, Function, FunctionKind, FunctionTable, westergaard};
use ppum::jet::Jet;
use ppum::polynomial::polynomial;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_testkit::random::Random;
use ppum_testkit::wgsl::Module;

use super::compute::{around, point_functions, run};
use super::gpu_or_skip;
use crate::frame::geometry::PairGeometry;
use crate::scene::groups::GroupFrame;

/// Unit roundoff of single precision.
const U: f64 = f32::EPSILON as f64 / 2.0;

/// A weight for the texts that test none.
const WEIGHT: &str = "fn weight(xi: f32) -> vec2<f32> { return weight_cubic(xi); }\n";

/// Place of the cracks in the view's data of one group of functions.
const CRACKS: u32 = 4;

/// The expected result: a number and the size of what it is a sum of.
type ExpectedValue = Vec<(f64, f64)>;

/// Rows that differ from what is expected by more than `units` roundoffs.
fn wrong<const N: usize>(
    rows: &[[f32; N]],
    found: &[Vec<f32>],
    units: f64,
    expected: impl Fn(&[f32; N]) -> ExpectedValue,
) -> Vec<String> {
    assert_eq!(rows.len(), found.len());
    let mut failures = Vec::new();
    for (row, found) in rows.iter().zip(found) {
        let expected = expected(row);
        assert_eq!(expected.len(), found.len());
        for (k, (&found, (exact, size))) in found.iter().zip(expected).enumerate() {
            let error = (f64::from(found) - exact).abs();
            let same = found.is_nan() && exact.is_nan();
            if !(same || error <= units * U * size) {
                let error = error / (U * size);
                failures.push(format!("{k} at {row:?}: {found:e}, not {exact:e}: {error:.1} u"));
            }
        }
    }
    failures
}

/// Runs rows and asserts that all are right.
#[track_caller]
fn agrees<const N: usize>(
    text: &str,
    pairs: &[[f32; 2]],
    rows: &[[f32; N]],
    units: f64,
    expected: impl Fn(&[f32; N]) -> ExpectedValue,
) {
    let Some(gpu) = gpu_or_skip() else { return };
    let text = format!("{}{WEIGHT}{text}", point_functions(1, CRACKS));
    let outputs = expected(&rows[0]).len();
    let found = run(&gpu, &text, pairs, rows, outputs).unwrap_or_else(|error| panic!("{error}"));
    let failures = wrong(rows, &found, units, expected);
    let first = failures.iter().take(8).cloned().collect::<Vec<_>>().join("\n");
    assert!(failures.is_empty(), "{} wrong numbers:\n{first}", failures.len());
}

#[test]
fn texts_are_valid_for_every_order() {
    for order in 0..=1 {
        let text = format!("{}{WEIGHT}fn row(k: u32) {{}}", point_functions(order, CRACKS));
        Module::new(&around(&text, 1, 1, 1)).unwrap_or_else(|error| panic!("{error}"));
    }
}

fn numbers(jet: Jet<f64>) -> [f64; 3] {
    [jet.v, jet.x, jet.y]
}

fn jet(n: &[f32]) -> Jet<f64> {
    let n: Vec<f64> = n.iter().map(|&n| f64::from(n)).collect();
    Jet { x: n[1], y: n[2], ..Jet::constant(n[0]) }
}

fn sizes(jet: Jet<f64>) -> Jet<f64> {
    let [v, x, y] = numbers(jet).map(f64::abs);
    Jet { x, y, ..Jet::constant(v) }
}

fn random_rows<const N: usize>(n: usize, seed: u64) -> Vec<[f32; N]> {
    let mut random = Random(seed);
    (0..n).map(|_| std::array::from_fn(|_| random.between(-2.0, 2.0) as f32)).collect()
}

const PUT_JETS: &str = "
    fn put_jets(k: u32, lane: u32, j: Jets) {
        put(k, 3u * lane, j.v[lane]);
        put(k, 3u * lane + 1u, j.x[lane]);
        put(k, 3u * lane + 2u, j.y[lane]);
    }
    fn input_jet(k: u32, i: u32) -> Jet {
        return Jet(input(k, i), input(k, i + 1u), input(k, i + 2u));
    }
    fn lanes(j: Jet) -> Jets {
        return Jets(Lanes(j.v), Lanes(j.x), Lanes(j.y));
    }\n";

/// At most 5 roundings a term.
#[test]
fn products_of_jets() {
    let text = format!(
        "{PUT_JETS}fn row(k: u32) {{
            put_jets(k, 0u, jets_times(input_jet(k, 0u), lanes(input_jet(k, 3u))));
        }}"
    );
    agrees(&text, &[], &random_rows::<6>(300, 1), 5.0, |row| {
        let (a, b) = (jet(&row[..3]), jet(&row[3..]));
        let size = sizes(a).times::<1>(sizes(b));
        numbers(a.times::<1>(b)).into_iter().zip(numbers(size)).collect()
    });
}

/// A division (5 u), whose error each of three levels passes on: 40 u of the quotient of the sizes.
#[test]
fn quotients_of_jets() {
    let text = format!(
        "{PUT_JETS}fn row(k: u32) {{
            put_jets(k, 0u, jets_over(lanes(input_jet(k, 0u)), input_jet(k, 3u)));
        }}"
    );
    let mut rows = random_rows::<6>(300, 2);
    rows.iter_mut().for_each(|row| row[3] = 0.5 + row[3].abs());
    agrees(&text, &[], &rows, 40.0, |row| {
        let (a, b) = (jet(&row[..3]), jet(&row[3..]));
        // the quotient rule with all terms added up
        let minus = sizes(b).scaled::<1>(-1.0);
        let size = sizes(a).over::<1>(Jet { v: b.v, ..minus });
        numbers(a.over::<1>(b)).into_iter().zip(numbers(size)).collect()
    });
}

/// Places where weights begin, end and have knots, on both sides of each, and between. Knots ±1/3
/// are no numbers of single precision: there the neighbours decide. Cards take subnormal numbers
/// for 0.
fn places() -> Vec<f32> {
    let knots = [-1.0f32, -0.5, 0.0, 0.5, 1.0];
    let mut places: Vec<f32> = (-60..=60).map(|k| k as f32 * 0.021).collect();
    for knot in knots {
        places.extend([knot, knot.next_up(), knot.next_down(), knot + 1e-15]);
    }
    let third = 1.0f32 / 3.0;
    for t in [third.next_up(), third.next_down()] {
        places.extend([t, -t]);
    }
    places.retain(|place| *place == 0.0 || place.is_normal());
    places.extend([f32::MIN_POSITIVE, -f32::MIN_POSITIVE]);
    places
}

/// Up to 4 roundings of terms of size 1 and 12.
#[test]
fn weights() {
    let text = "fn row(k: u32) {
        let xi = input(k, 0u);
        var w = array<vec2<f32>, 3>(weight_linear(xi), weight_quadratic(xi), weight_cubic(xi));
        for (var i = 0u; i < 6u; i++) { put(k, i, w[i / 2u][i % 2u]); }
    }";
    let rows: Vec<[f32; 1]> = places().into_iter().map(|xi| [xi]).collect();
    agrees(text, &[], &rows, 4.0, |&[xi]| {
        let of = |w: &WeightFunction| w.spline(f64::from(xi)).into_iter().zip([1.0, 12.0]);
        WeightFunction::ALL.iter().flat_map(of).collect()
    });
}

/// The roundings of both factors and up to 4 products.
#[test]
fn tensor_weights() {
    let text = format!(
        "{PUT_JETS}fn row(k: u32) {{
            let xi = vec2<f32>(input(k, 0u), input(k, 1u));
            put_jets(k, 0u, lanes(weight_tensor(xi, vec2<f32>(input(k, 2u), input(k, 3u)))));
        }}"
    );
    let rows: Vec<[f32; 4]> = random_rows::<4>(400, 3);
    agrees(&text, &[], &rows, 12.0, |row| {
        let [x, y, ix, iy] = row.map(f64::from);
        let w = WeightFunction::Cubic.tensor::<f64, 1>([x, y], [ix, iy]);
        let size = [1.0, 12.0 * ix, 12.0 * iy];
        numbers(w).into_iter().zip(size.map(f64::abs)).collect()
    });
}

/// Of degree d a coefficient meets 2 d products and sums, more in derivatives: 4 (d + 2) u of the
/// polynomial of the sizes.
#[test]
fn polynomials() {
    let text = format!(
        "{PUT_JETS}fn row(k: u32) {{
            let xi = vec2<f32>(input(k, 2u), input(k, 3u));
            let inverse = vec2<f32>(input(k, 4u), input(k, 5u));
            let p = polynomial(u32(input(k, 0u)), u32(input(k, 1u)), xi, inverse);
            put_jets(k, 0u, p);
            put_jets(k, 1u, p);
        }}"
    );
    let mut random = Random(4);
    for degree in 0..=8usize {
        let n = monomials(degree);
        let mut lane = || -> Vec<f64> {
            (0..n).map(|_| f64::from(random.between(-1.0, 1.0) as f32)).collect()
        };
        let (a, b) = (lane(), lane());
        // coefficients begin at pair 1
        let mut pairs = vec![[7.0, 7.0]];
        for power in (0..=degree).rev() {
            for x in (0..=degree - power).rev() {
                let index = monomials(x + power) - 1 - x;
                pairs.push([a[index] as f32, b[index] as f32]);
            }
        }
        let mut rows = random_rows::<6>(60, 5);
        rows.iter_mut().for_each(|row| (row[0], row[1]) = (1.0, degree as f32));
        agrees(&text, &pairs, &rows, 4.0 * (degree as f64 + 2.0), |row| {
            let [.., x, y, ix, iy] = row.map(f64::from);
            let world = |c: &[f64], x: f64, y: f64, [ix, iy]: [f64; 2]| {
                let p = polynomial::<f64, 1>(c, degree, [x, y]);
                let [v, px, py] = numbers(p);
                [v, px * ix, py * iy]
            };
            let lane = |c: &[f64]| {
                let size: Vec<f64> = c.iter().map(|c| c.abs()).collect();
                let size = world(&size, x.abs(), y.abs(), [ix.abs(), iy.abs()]);
                world(c, x, y, [ix, iy]).into_iter().zip(size).collect::<ExpectedValue>()
            };
            [lane(&a), lane(&b)].concat()
        });
    }
}

/// Points round a tip at many distances: in all directions, on the faces and a hair off them.
fn round_the_tip(from: i32, to: i32) -> Vec<[f32; 4]> {
    let mut rows = Vec::new();
    for power in from..=to {
        let r = 1.37 * 10f64.powi(power);
        for k in 0..24 {
            let angle = f64::from(k) * 0.2618 - std::f64::consts::PI;
            let (x, y) = ((r * angle.cos()) as f32, (r * angle.sin()) as f32);
            rows.push([x, y, if y < 0.0 { -1.0 } else { 1.0 }, 1.0]);
        }
        let r = r as f32;
        for (y, sign) in [(0.0, 1.0), (0.0, -1.0), (r * 1e-7, 1.0), (-r * 1e-7, -1.0)] {
            rows.extend([[-r, y, sign, 1.0], [r, y, sign, 1.0], [-r, y, sign, -1.0]]);
        }
    }
    // devices may take subnormal numbers for zero
    rows.retain(|row| !row[1].is_subnormal());
    rows
}

fn tip_point(row: &[f32; 4]) -> TipPoint<f64> {
    let [x, y, sign, branch] = row.map(f64::from);
    TipPoint { x, y, sign, branch }
}

const PUT_FUNCTIONS: &str = "fn row(k: u32) {
    let p = TipPoint(input(k, 0u), input(k, 1u), input(k, 2u), input(k, 3u));
    let f = westergaard(p);
    for (var i = 0u; i < 4u; i++) {
        let j = functions_entry(f, i);
        put(k, 3u * i, j.v);
        put(k, 3u * i + 1u, j.x);
        put(k, 3u * i + 2u, j.y);
    }
}";

/// Two roots, three divisions and up to 20 other operations: 60 u of r^½ and r^-½ times the
/// largest factor of the formulas; of C and S themselves of their own size, which vanishes on
/// a face.
fn westergaard_expected(row: &[f32; 4]) -> ExpectedValue {
    let p = tip_point(row);
    let r = p.x.hypot(p.y);
    let jets = westergaard::<f64, 1>(&p);
    let sizes = [r.sqrt(), 1.0 / r.sqrt(), 1.0 / r.sqrt()];
    let of = |jet: Jet<f64>| numbers(jet).into_iter().zip(sizes).collect::<ExpectedValue>();
    let mut expected: Vec<ExpectedValue> = jets.into_iter().map(of).collect();
    expected[..2].iter_mut().for_each(|jet| jet[0].1 = jet[0].0.abs());
    expected.concat()
}

#[test]
fn westergaard_functions() {
    let mut rows = round_the_tip(-24, 15);
    rows.push([0.0, 0.0, 1.0, 1.0]);
    agrees(PUT_FUNCTIONS, &[], &rows, 60.0, |row| {
        let mut expected = westergaard_expected(row);
        if row[0] == 0.0 && row[1] == 0.0 {
            expected.iter_mut().for_each(|(v, _)| *v = if *v == 0.0 { 0.0 } else { f64::NAN });
        }
        expected
    });
}

#[test]
fn a_wrong_derivative_is_found() {
    let Some(gpu) = gpu_or_skip() else { return };
    let rows = round_the_tip(-3, 3);
    let right = format!("{}{WEIGHT}{PUT_FUNCTIONS}", point_functions(1, CRACKS));
    let found = |text: &str| run(&gpu, text, &[], &rows, 12).expect("a valid text");
    assert!(wrong(&rows, &found(&right), 60.0, westergaard_expected).is_empty());
    for (good, bad) in [
        ("sine * (ct * ct)", "sine * (1.00001 * ct * ct)"),
        ("vec4<f32>(s, c, c, s)", "vec4<f32>(s, -c, c, s)"),
        ("small, large), vec2<f32>(large", "large, small), vec2<f32>(large"),
    ] {
        let text = right.replace(good, bad);
        assert_ne!(text, right);
        let failures = wrong(&rows, &found(&text), 60.0, westergaard_expected);
        assert!(failures.len() > rows.len() / 4, "{bad}: {}", failures.len());
    }
}

/// Two roots (18 u) and three divisions (15 u) with the operations between, of the
/// numbers themselves.
#[test]
fn polar_coordinates() {
    let text = "fn row(k: u32) {
        let p = TipPoint(input(k, 0u), input(k, 1u), input(k, 2u), input(k, 3u));
        let r = tip_radius(p);
        let root = tip_half_root(p, r);
        let half = tip_half_angle(p, r);
        put(k, 0u, r);
        put(k, 1u, root.x);
        put(k, 2u, root.y);
        put(k, 3u, half.x);
        put(k, 4u, half.y);
        put(k, 5u, tip_theta(half));
    }";
    let mut rows = round_the_tip(-30, 15);
    rows.push([0.0, 0.0, 1.0, 1.0]);
    agrees(text, &[], &rows, 40.0, |row| {
        let p = tip_point(row);
        let r = p.radius();
        let half = p.half_angle(r);
        let mut expected: ExpectedValue =
            [r].into_iter().chain(p.half_root(r)).chain(half).map(|v| (v, v.abs())).collect();
        let theta = TipPoint::theta(half);
        expected.push((theta, theta.abs()));
        expected
    });
}

fn crack(points: &[[f64; 2]]) -> Crack {
    Crack::polyline(points.iter().map(|&p| Vec2::from(p)).collect(), [CrackEnd::Tip; 2])
}

/// A chain of edges with these bulges.
fn curved(points: &[[f64; 2]], bulges: &[f64]) -> Crack {
    Crack { bulges: bulges.to_vec(), ..crack(points) }
}

/// Straight, kinked at a sharp and a blunt angle, a zigzag, and one in an odd place; an arc of a
/// quarter and one of three quarters of a turn, arcs and a segment with common tangents, and arcs
/// with kinks between them and a segment at the start; and a wave of more arcs than a group has.
fn cracks() -> Vec<Crack> {
    let quarter = std::f64::consts::FRAC_PI_8.tan();
    vec![
        crack(&[[-1.0, 0.0], [0.5, 0.0]]),
        crack(&[[-1.0, 1.0], [0.0, 0.0], [1.0, 1.0]]),
        crack(&[[-1.0, 0.6], [-0.4, 0.3], [0.0, 0.0]]),
        crack(&[[-1.0, 0.0], [-0.3, 0.4], [0.1, -0.2], [0.4, 0.1], [0.9, -0.1]]),
        crack(&[[3.1, 7.3], [5.7, 8.9]]),
        curved(&[[-0.5, 0.25], [0.25, -0.5]], &[quarter]),
        curved(&[[0.1, 0.2], [0.45, 0.3]], &[-2.414]),
        curved(&[[-0.5, 0.0], [0.0, 0.5], [0.5, 0.0], [0.5, -0.5]], &[-quarter, -quarter, 0.0]),
        curved(&[[-0.9, 0.1], [-0.5, 0.3], [-0.1, -0.2], [0.4, 0.3]], &[0.0, 0.7, -1.2]),
        wave(36),
    ]
}

/// Arcs of some 45°, to the left and to the right, along two turns of a spiral.
fn wave(count: u32) -> Crack {
    let point = |k: u32| {
        let turn = f64::from(k) / f64::from(count);
        let (sin, cos) = (4.0 * std::f64::consts::PI * turn).sin_cos();
        [(0.3 + 0.5 * turn) * cos, (0.3 + 0.5 * turn) * sin]
    };
    let bulges: Vec<f64> = (0..count).map(|k| if k % 2 == 0 { 0.2 } else { -0.2 }).collect();
    curved(&(0..=count).map(point).collect::<Vec<_>>(), &bulges)
}

fn step(cracks: Vec<Crack>) -> Step {
    let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
    let cover = Cover::uniform(domain, 0).expect("one cell");
    let partition = cover.partition(1.25, WeightFunction::Linear).expect("one patch");
    let mut step = Step::new(partition);
    step.cracks = cracks;
    step
}

/// Offsets from the size of a plate down to 10⁻¹⁵, with the centre itself and points on axes.
fn offsets(seed: u64) -> Vec<[f32; 2]> {
    let mut random = Random(seed);
    let mut rows = vec![[0.0; 2]];
    for size in [1.0, 0.1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15] {
        let near: [f64; 4] = [size, -size, 0.5 * size, -0.5 * size];
        rows.extend(near.iter().flat_map(|&a| [[a as f32, 0.0], [0.0, a as f32]]));
        rows.extend((0..48).map(|_| [0; 2].map(|_| random.between(-size, size) as f32)));
    }
    rows
}

/// The size of what distances from edges are made of, at a point: of arcs the square of the
/// distance from the tangent's point over the radius, too.
fn reach(crack: &LocalCrack, at: Vec2) -> f64 {
    let of = |s: &LocalSegment| {
        let d = s.distance.abs();
        d + s.curvature.abs() * (d + at.length()) * (d + at.length())
    };
    crack.segments().iter().map(of).fold(0.0, f64::max)
}

/// True if a point is farther than the roundings of its coordinates and of the view's data from
/// where `decide` changes: 16 u of the sizes of both.
fn decided(at: Vec2, distance: f64, decide: impl Fn(Vec2) -> bool) -> bool {
    let band = 16.0 * U * (at.length() + distance);
    let round = (0..16).map(|k| std::f64::consts::TAU * f64::from(k) / 16.0);
    let mut near = round.map(|angle| decide(at + vec2(angle.cos(), angle.sin()) * band));
    let here = decide(at);
    near.all(|there| there == here)
}

/// Centres of views: vertices, tips, points of edges, 10⁻¹² beside all of these, and far from them.
fn centers(crack: &Crack) -> Vec<Vec2> {
    let on_edges = crack.edges().flat_map(|edge| [0.3, 0.5].map(|part| edge.at(part)));
    let on = crack.points.iter().copied().chain(on_edges);
    let both = on.flat_map(|p| [p, p + vec2(0.6e-12, -0.8e-12)]);
    both.chain([vec2(0.31, -0.17), vec2(4.0, 8.0)]).collect()
}

#[test]
fn sides_of_cracks() {
    let domain = Domain::from(Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0)));
    let (mut compared, mut all) = (0, 0);
    for (index, crack) in (0..).zip(cracks()) {
        let text = format!(
            "fn row(k: u32) {{
                let offset = vec2<f32>(input(k, 0u), input(k, 1u));
                put(k, 0u, crack_side(crack_of(0u), offset));
                put(k, 1u, crack_side(crack_at({index}u), offset));
            }}"
        );
        for center in centers(&crack) {
            let step = step(cracks());
            let geometry = PairGeometry::new(&step, &domain, &[GroupFrame::Side(index)], center);
            let local = LocalCrack::new(&crack, center);
            let side = |p: Vec2| local.side([p.x, p.y], Side::Above);
            let mut rows = offsets(6);
            all += rows.len();
            // on an axis-parallel crack through the centre nothing is rounded
            rows.retain(|&[x, y]| {
                let p = vec2(x.into(), y.into());
                index == 0 && center.y == 0.0 && y == 0.0
                    || decided(p, reach(&local, p), |p| side(p) > 0.0)
            });
            compared += rows.len();
            assert_eq!(geometry.cracks, CRACKS);
            agrees(&text, &geometry.pairs, &rows, 0.0, |&[x, y]| {
                vec![(side(vec2(x.into(), y.into())), 1.0); 2]
            });
        }
    }
    assert!(compared > all / 2, "{compared} of {all}");
}

/// Arms of a star, one of them an arc, a crack that ends on another and one that crosses it, with
/// an arc; and random trees of cuts by their edges.
fn trees(random: &mut Random) -> (Vec<Crack>, Vec<Function>) {
    let mut cracks: Vec<Crack> = (0..5)
        .map(|_| crack(&[[0.25, 0.5], (vec2(0.25, 0.5) + random.direction()).into()]))
        .collect();
    let [a, b] = [0, 1].map(|k| cracks[0].points[k]);
    let foot = a + (b - a) * 0.37;
    cracks.push(crack(&[foot.into(), (foot + random.direction()).into()]));
    cracks.push(curved(&[[-0.3, 0.1], [0.4, 0.45], [1.0, 0.3]], &[0.0, -0.4]));
    cracks[1].bulges = vec![0.6];
    let mut tree = || {
        let count = 1 + random.below(12);
        let mut part = |k: usize| match k + 1 + random.below(3) {
            next if next < count => CutBranch::Cut(next as u32),
            _ => [CutBranch::Inside, CutBranch::Outside][random.below(2)],
        };
        let parts: Vec<_> = (0..count).map(|k| [part(k), part(k)]).collect();
        let mut cut = |[left, right]: [CutBranch; 2]| {
            let at = random.below(8) as u32;
            let segment = SegmentId { crack: at.min(6), segment: at / 7 };
            Cut { segment, left, right }
        };
        let cuts = parts.into_iter().map(&mut cut).collect();
        Function { name: "component".into(), kind: FunctionKind::Component { cuts } }
    };
    let functions = (0..12).map(|_| tree()).collect();
    (cracks, functions)
}

#[test]
fn indicators_of_components() {
    let domain = Domain::from(Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0)));
    let text = "fn row(k: u32) {
        put(k, 0u, indicator_value(indicator_of(0u), vec2<f32>(input(k, 0u), input(k, 1u))));
    }";
    let (cracks, functions) = trees(&mut Random(10));
    let (mut compared, mut all, mut inside) = (0, 0, 0);
    for (index, function) in (0..).zip(&functions) {
        let mut step = step(cracks.clone());
        step.functions.clone_from(&functions);
        let table = FunctionTable::new(std::slice::from_ref(function), cracks.len(), &[]);
        let table = table.expect("a function");
        let centers = [cracks[0].points[0], cracks[5].points[0], cracks[6].points[1]];
        for center in centers.into_iter().chain([vec2(0.31, -0.17)]) {
            let geometry =
                PairGeometry::new(&step, &domain, &[GroupFrame::Indicator(index)], center);
            let local = table.at(&cracks, center);
            let value = |p: Vec2| {
                let mut jets = [Jet::constant(0.0)];
                local.evaluate::<f64, 0>(0, p.into(), Side::Above, &mut jets);
                jets[0].v
            };
            let lines: Vec<_> = cracks.iter().map(|crack| LocalCrack::new(crack, center)).collect();
            // distances of lines through the centre are nothing but rounding: those of the others
            // count where they decide
            let far: Vec<f64> = lines
                .iter()
                .flat_map(|c| c.segments().into_owned().into_iter().map(|s| s.distance.abs()))
                .filter(|&d| d > 1e-15)
                .collect();
            let round = lines.iter().filter(|line| !line.vertices().is_empty());
            let round: Vec<_> = round.collect();
            let mut rows = offsets(11);
            all += rows.len();
            rows.retain(|&[x, y]| {
                let p = vec2(x.into(), y.into());
                let near =
                    far.iter().filter(|&&d| d < 2.0 * p.length()).fold(0.0, |a, &d| d.max(a));
                let near = round.iter().map(|crack| reach(crack, p)).fold(near, f64::max);
                decided(p, near, |p| value(p) > 0.0)
            });
            compared += rows.len();
            inside += rows.iter().filter(|&&[x, y]| value(vec2(x.into(), y.into())) > 0.0).count();
            agrees(text, &geometry.pairs, &rows, 0.0, |&[x, y]| {
                vec![(value(vec2(x.into(), y.into())), 1.0)]
            });
        }
    }
    assert!(compared > all / 2 && inside > compared / 8, "{compared} of {all}, {inside} inside");
}

/// The point of a frame: a product and a sum for each coordinate of rounded data, 8 u of what is
/// added. Signs and branches where they are decided.
#[test]
fn points_of_tips() {
    let text = "fn row(k: u32) {
        let p = tip_point(tip_at(0u), vec2<f32>(input(k, 0u), input(k, 1u)));
        put(k, 0u, p.x);
        put(k, 1u, p.y);
        put(k, 2u, p.sign);
        put(k, 3u, p.branch);
    }";
    let domain = Domain::from(Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0)));
    for (index, crack) in (0..).zip(cracks()) {
        for (end, center) in [End::Start, End::Last]
            .into_iter()
            .flat_map(|end| centers(&crack).into_iter().map(move |center| (end, center)))
        {
            let frames = [GroupFrame::Tip(TipId { crack: index, end })];
            let geometry = PairGeometry::new(&step(cracks()), &domain, &frames, center);
            let tip = LocalTip::new(&crack, end, center);
            let (far, local) = (tip.from_tip.length(), LocalCrack::new(&crack, center));
            let point = |p: Vec2| tip.point([p.x, p.y], Side::Above);
            let mut rows = offsets(7);
            rows.retain(|&[x, y]| {
                let p = vec2(x.into(), y.into());
                let far = (8.0 * far).max(reach(&local, p));
                decided(p, far, |p| point(p).sign > 0.0)
                    && decided(p, far, |p| point(p).branch > 0.0)
            });
            agrees(text, &geometry.pairs, &rows, 8.0, |&[x, y]| {
                let (p, size) = (point(vec2(x.into(), y.into())), f64::from(x.hypot(y)) + far);
                vec![(p.x, size), (p.y, size), (p.sign, 0.0), (p.branch, 0.0)]
            });
        }
    }
}

/// Functions of a fixed frame turned into the world.
#[test]
fn fixed_frames_and_turned_functions() {
    let text = format!(
        "{PUT_JETS}fn row(k: u32) {{
            let frame = fixed_at(0u);
            let p = fixed_point(frame, vec2<f32>(input(k, 0u), input(k, 1u)));
            let j = functions_entry(functions_turned(westergaard(p), frame.axis), 2u);
            put_jets(k, 0u, lanes(j));
            put(k, 3u, p.x);
            put(k, 4u, p.y);
        }}"
    );
    let (origin, angle) = (vec2(0.25, -0.75), 0.7);
    let center = vec2(0.3, -0.7);
    let frames = [GroupFrame::Fixed { origin, angle }];
    let domain = Domain::from(Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0)));
    let geometry = PairGeometry::new(&step(Vec::new()), &domain, &frames, center);
    let mut rows = random_rows::<2>(300, 8);
    rows.iter_mut().flatten().for_each(|v| *v *= 0.5);
    let axis = vec2(f64::cos(angle), f64::sin(angle));
    let place = |x: f32, y: f32| {
        let d = vec2(x.into(), y.into()) + (center - origin);
        (axis.dot(d), axis.cross(d))
    };
    // away from the singular point and the jump, where the rounded place decides
    rows.retain(|&[x, y]| {
        let (px, py) = place(x, y);
        px.hypot(py) > 0.05 && (px > 0.0 || py.abs() > 1e-3)
    });
    agrees(&text, geometry.pairs.as_slice(), &rows, 150.0, |&[x, y]| {
        let (px, py) = place(x, y);
        let sign = if py < 0.0 { -1.0 } else { 1.0 };
        let p = TipPoint { x: px, y: py, sign, branch: 1.0 };
        let turned = westergaard::<f64, 1>(&p)[2].turned::<1>(axis.x, axis.y);
        let r = px.hypot(py);
        // the rounding of the place, of size 1, is magnified by 1 / r
        let sizes = [0.5, 1.5, 1.5].map(|power: f64| r.powf(-power));
        let mut expected: ExpectedValue = numbers(turned).into_iter().zip(sizes).collect();
        expected.extend([(px, 1.0), (py, 1.0)]);
        expected
    });
}

#[test]
fn insides_of_holes() {
    let text = "fn row(k: u32) {
        let inside = holes_contain(u32(input(k, 2u)), u32(input(k, 3u)), vec2<f32>(input(k, 0u), input(k, 1u)));
        put(k, 0u, select(0.0, 1.0, inside));
    }";
    let polygon =
        |points: &[[f64; 2]]| Hole::polygon(points.iter().copied().map(Vec2::from).collect());
    let with_arcs = |points: &[[f64; 2]], bulges: &[f64], side| {
        let points = points.iter().copied().map(Vec2::from).collect();
        Hole::with_arcs(points, bulges.to_vec(), side)
    };
    let (keyhole, outline) = (
        [[1.0, -1.0], [1.25, -1.0], [1.25, -0.5], [1.0, -0.5]],
        [[-1.75, 0.0], [0.25, -1.75], [1.875, 0.5]],
    );
    let holes = vec![
        Hole::Circle { center: vec2(0.5, 0.25), radius: 0.625 },
        // a disc of two arcs, a slot with a round end, a keyhole and an outline
        with_arcs(&[[-0.75, -1.25], [-0.25, -1.25]], &[1.0, 1.0], PolygonSide::Inside),
        with_arcs(&keyhole, &[0.0, 1.0, 0.0, -0.3], PolygonSide::Inside),
        with_arcs(
            &[[-1.5, 1.25], [-1.25, 1.25], [-1.25, 1.0]],
            &[0.0, 0.0, -3.0],
            PolygonSide::Inside,
        ),
        with_arcs(&outline, &[0.5, 0.25, 0.5], PolygonSide::Outside),
        polygon(&[[-1.0, -0.5], [-0.5, -0.5], [-0.5, 0.0], [-1.0, 0.0]]),
        polygon(&[[0.0, 0.0], [-1.0, 1.0], [0.75, 1.0], [0.1, 0.6]]),
    ];
    let domain = Domain { bounds: Rect::new(vec2(-2.0, -2.0), vec2(2.0, 2.0)), holes };
    let on_arc = |edge: Edge| {
        let at = edge.at(0.37);
        [at, edge.to, at + edge.tangent(0.37).left() * 1e-12]
    };
    let arcs = domain.holes.iter().flat_map(Hole::edges).filter(Edge::is_arc).flat_map(on_arc);
    let arcs: Vec<Vec2> = arcs.collect();
    let (mut compared, mut all, mut inside) = (0, 0, 0);
    for center in
        [[0.875, 0.75], [-0.75, 0.0], [-0.5, -0.25], [0.375, 0.5], [0.1, 0.6], [-1.5, 0.3]]
            .map(Vec2::from)
            .into_iter()
            .chain(arcs)
    {
        let geometry = PairGeometry::new(&step(cracks()), &domain, &[GroupFrame::One], center);
        let local: Vec<_> = domain.holes.iter().map(|hole| hole.at(center)).collect();
        let contains = |p: Vec2| local.iter().any(|hole| hole.contains(p));
        let mut rows: Vec<[f32; 4]> = offsets(9)
            .into_iter()
            .map(|[x, y]| [x, y, geometry.holes as f32, geometry.n_holes as f32])
            .collect();
        all += rows.len();
        let place = |row: &[f32; 4]| vec2(row[0].into(), row[1].into());
        // a rim's distance from the centre is rounded: nothing where the centre lies on it
        let rim = |hole: &Hole| hole.rim_distance(center);
        let near = domain.holes.iter().map(rim).fold(f64::INFINITY, f64::min);
        // the square of a distance over the radius is rounded, too
        let curvature = |edge: Edge| edge.curvature().abs();
        let most = domain.holes.iter().flat_map(Hole::edges).map(curvature).fold(0.0, f64::max);
        let size = |p: Vec2| near + most * p.length() * (p.length() + 4.0);
        rows.retain(|row| decided(place(row), size(place(row)), contains));
        compared += rows.len();
        inside += rows.iter().filter(|row| contains(place(row))).count();
        agrees(text, &geometry.pairs, &rows, 0.0, |row| {
            vec![(f64::from(u8::from(contains(place(row)))), 1.0)]
        });
    }
    assert!(compared > all / 2 && inside > compared / 8, "{compared} of {all}, {inside} inside");
}
