//! Singular points that are no tips, round rims and ligaments, with default settings.
//!
//! The values are those of an independent solver: finite elements of order 10 on meshes refined
//! geometrically towards every singular point (NGSolve 6.2.2608), right to 1e-7. Cells that are not
//! refined towards these points had errors of 0.1 to 3.7 % in the energy and up to 5.6 % in K.

use crate::SQUARE_BODY;
use crate::studies::support::{checked, parsed};
use crate::support::{TENSION, apart, energy, factors_of};
use ppum::crack::End;
use ppum::dataset::{Dataset, WarningKind};
use ppum::progress::unwatched;
use ppum::vec2::vec2;
use ppum_fracture::solve::{Plan, solve};
use ppum_problem::ProblemData;
use ppum_solve::space::discretise;

const CLAMPED: &str = r#"
[[boundary]]
on = "bottom"
displacement = [0.0, 0.0]
[[boundary]]
on = "top"
traction = [0.3, 1.0]
"#;

/// The plate [-1, 1]² of E = 1, ν = 0.3 in plane strain with more tables and the keys
/// of `[discretization]`.
fn plate(tables: &str, keys: &str) -> ProblemData {
    let text = format!("{SQUARE_BODY}{tables}\n[discretization]\n{keys}\n");
    parsed(&text)
}

fn solved_with(tables: &str, keys: &str) -> Dataset {
    solve(&checked(&plate(tables, keys)), unwatched()).expect("a solution")
}

fn solved(tables: &str) -> Dataset {
    solved_with(tables, "level = 3")
}

/// Asserts the energy to 0.1 %, and K of tips to 0.2 % of |K|.
fn assert_near(dataset: &Dataset, exact: f64, tips: &[(End, f64, f64)]) {
    let found = energy(dataset);
    assert!((found / exact - 1.0).abs() < 1e-3, "energy {found} instead of {exact}");
    for &(end, k1, k2) in tips {
        let all = &dataset.steps[0].intensities;
        let tip = all.iter().find(|tip| tip.tip.end == end).expect("the tip");
        let error = apart(factors_of(tip), [k1, k2]);
        assert!(error < 2e-3, "{end:?}: {} {} instead of {k1} {k2}", tip.k1, tip.k2);
    }
    let singular =
        dataset.steps[0].warnings.iter().filter(|w| w.kind == WarningKind::SingularPoint);
    assert_eq!(singular.count(), 0);
}

/// Two arms: 0.5 long, and 0.4 long at an angle to the x axis.
fn kinked(degrees: f64) -> String {
    let (sin, cos) = degrees.to_radians().sin_cos();
    let end = [0.05 + 0.4 * cos, -0.13 + 0.4 * sin];
    format!("{TENSION}[[crack]]\npoints = [[-0.45, -0.1], [0.05, -0.13], {end:?}]\n")
}

/// A plate with corners that turn inwards between free sides, and what is known of it.
struct Cornered {
    tables: String,
    energy: f64,
    tips: [(End, f64, f64); 2],
}

impl Cornered {
    fn kinked(degrees: f64, energy: f64, start: [f64; 2], last: [f64; 2]) -> Self {
        Self::new(kinked(degrees), energy, start, last)
    }

    fn new(tables: String, energy: f64, start: [f64; 2], last: [f64; 2]) -> Self {
        let tips = [(End::Start, start), (End::Last, last)].map(|(end, [k1, k2])| (end, k1, k2));
        Self { tables, energy, tips }
    }

    fn right_angle() -> Self {
        Self::kinked(90.0, 2.09772948, [1.0845755, 0.0044035757], [-0.15368053, 0.48556563])
    }

    fn sharp() -> Self {
        Self::kinked(120.0, 2.0449301, [1.0352864, 0.07704593], [-0.1698618, 0.024559574])
    }

    fn square() -> Self {
        let tables = format!(
            "{TENSION}[[hole]]\npoints = [[-0.3, -0.25], [0.3, -0.25], [0.3, 0.25], [-0.3, 0.25]]\n\
             [[crack]]\npoints = [[-0.75, 0.55], [-0.35, 0.6]]\n"
        );
        Self::new(tables, 2.64736017, [1.1099473, 0.22943451], [1.0848125, 0.33963564])
    }

    fn triangle() -> Self {
        let tables = format!(
            "{TENSION}[[hole]]\npoints = [[-0.3, -0.3], [0.35, -0.2], [-0.1, 0.3]]\n\
             [[crack]]\npoints = [[0.4, 0.1], [0.8, 0.3]]\n"
        );
        Self::new(tables, 2.50174376, [1.0771817, 0.52795673], [0.92661204, 0.53215622])
    }

    /// Asserts what [`assert_near`] does, and the errors of the energy and of the first tip's
    /// factors, which fall with the order.
    fn assert_errors(&self, order: usize) {
        let (level, of_energy, of_factors) = match order {
            2 => (4, 1e-4, 5e-4),
            3 => (4, 6e-6, 1.5e-5),
            _ => (3, 2e-6, 2e-6),
        };
        let dataset = solved_with(&self.tables, &format!("level = {level}\norder = {order}"));
        assert_near(&dataset, self.energy, &self.tips);
        let error = 1.0 - energy(&dataset) / self.energy;
        let (tip, (_, k1, k2)) = (&dataset.steps[0].intensities[0], self.tips[0]);
        let apart = apart(factors_of(tip), [k1, k2]);
        println!("order {order}: energy off by {error:.1e}, factors by {apart:.1e}");
        assert!(error.abs() < of_energy && apart < of_factors, "{order}: {error} {apart}");
    }
}

/// Corners that turn inwards between free sides have functions r^λ.
#[test]
fn sharp_kinks_are_resolved() {
    Cornered::right_angle().assert_errors(3);
}

#[test]
fn corners_of_holes_are_resolved() {
    Cornered::triangle().assert_errors(2);
}

#[test]
#[ignore = "slow: six plates at the orders 2 and 3"]
fn low_orders_resolve_free_corners() {
    let order_two = [Cornered::right_angle(), Cornered::sharp(), Cornered::square()];
    order_two.iter().for_each(|plate| plate.assert_errors(2));
    let order_three = [Cornered::sharp(), Cornered::square(), Cornered::triangle()];
    order_three.iter().for_each(|plate| plate.assert_errors(3));
}

#[test]
#[ignore = "slow: order 4"]
fn order_four_resolves_free_corners() {
    // the kink and the hole that have the larger errors
    [Cornered::sharp(), Cornered::triangle()].iter().for_each(|plate| plate.assert_errors(4));
}

/// Functions r^λ at corners take fewer unknowns than cells that shrink towards the corners.
#[test]
fn functions_of_corners_save_unknowns() {
    for Cornered { tables, .. } in [Cornered::right_angle(), Cornered::square()] {
        let unknowns = |keys: &str| {
            let problem = plate(&tables, &format!("level = 4\norder = 1\n{keys}"));
            Plan::new(&checked(&problem), None, unwatched()).expect("a plan").estimate().unknowns
        };
        let [with, without] = ["", "enrichment = \"zone\""].map(unknowns);
        assert!(with < 0.8 * without, "{with} {without}");
    }
}

#[test]
fn clamped_corners_and_mouths_at_held_edges_are_resolved() {
    assert_near(&solved(CLAMPED), 2.96615408, &[]);
    let mouth = format!("{CLAMPED}[[crack]]\npoints = [[0.25, -1.0], [0.3, 0.0]]\n");
    assert_near(&solved(&mouth), 3.03885561, &[(End::Last, 0.033240238, -0.4585911)]);
}

const PIECE: &str = r#"
[[boundary]]
on = { edge = "bottom", from = -0.5, to = 0.3 }
displacement = [0.0, 0.0]
[[boundary]]
on = "top"
traction = [0.3, 1.0]
"#;

#[test]
fn ends_of_supports_and_loads_are_resolved() {
    assert_near(&solved(PIECE), 6.16062039, &[]);
    let rollers = r#"
[[boundary]]
on = { edge = "bottom", from = -0.5, to = 0.3 }
displacement = ["free", 0.0]
[[boundary]]
on = "left"
displacement = [0.0, "free"]
[[boundary]]
on = "top"
traction = [0.0, 1.0]
"#;
    assert_near(&solved(rollers), 2.53321988, &[]);
    let load = r#"
[[boundary]]
on = "bottom"
displacement = [0.0, 0.0]
[[boundary]]
on = { edge = "top", from = -0.3, to = 0.4 }
traction = [0.5, 1.0]
"#;
    assert_near(&solved(load), 0.719209593, &[]);
}

#[test]
#[ignore = "slow: small cells at a rim"]
fn round_holes_are_resolved() {
    let hole = "[[hole]]\ncenter = [0.1, 0.05]\nradius = 0.3\n";
    assert_near(&solved(&format!("{TENSION}{hole}")), 2.32757856, &[]);
}

#[test]
fn ligaments_beside_round_holes_are_resolved() {
    // 0.15 left on one side, 0.19 on another: 0.6 and 0.76 of a cell of the base cover
    let ligaments = "[[hole]]\ncenter = [-0.4, 0.36]\nradius = 0.45\n";
    assert_near(&solved(&format!("{TENSION}{ligaments}")), 4.33068214, &[]);
}

/// Where loads begin and end on arcs, on the sides of polygons and on faces, by pieces or by a
/// formula, cells are as small as at the ends of loads on edges, and nothing is warned of.
#[test]
fn ends_of_loads_are_refined_on_rims() {
    let material = "[material]\nyoung = 1\npoisson = 0.25\nstate = \"plane-stress\"\n";
    let arc = |from: i32, to: i32, name: &str| {
        format!("{{ arc = {{ center = [0, 0], radius = 1, from = {from}, to = {to} }}{name} }}")
    };
    let head = ", name = \"head\"";
    let pieces = [arc(87, 93, head), arc(93, 267, ""), arc(267, 273, head), arc(-87, 87, "")];
    let disc = format!("[domain.outline]\npath = [{}]\n{material}", pieces.join(", "));
    let square = format!("[domain]\nmin = [-1, -1]\nmax = [1, 1]\n{material}");
    let hole = format!(
        "{square}[[hole]]\npoints = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]\n"
    );
    let circle = format!("{square}[[hole]]\ncenter = [0, 0]\nradius = 0.5\n");
    let crack = format!("{square}[[crack]]\npoints = [[-0.6, 0], [0.6, 0]]\n");
    let (sin, cos) = f64::to_radians(87.0).sin_cos();
    let at_0_1 = "pressure = \"if(abs(x) < 0.1, 1, 0)\"";
    for (body, on, given, place) in [
        (&disc, "{ piece = \"head\" }", "pressure = 1", vec2(cos, sin)),
        (&hole, "{ hole = 0 }", at_0_1, vec2(0.1, 0.5)),
        (&circle, "{ hole = 0 }", at_0_1, vec2(-0.1, 0.24f64.sqrt())),
        (&crack, "{ crack = 0 }", at_0_1, vec2(0.1, 0.0)),
    ] {
        let text = format!("{body}[[boundary]]\non = {on}\n{given}\n[discretization]\nlevel = 3\n");
        let dataset = crate::studies::support::solved(&parsed(&text));
        let cells = &dataset.steps[0].partition.boxes().cell;
        let there = cells.iter().filter(|cell| cell.distance(place) < 1e-6);
        let size = there.map(|cell| cell.size().x).fold(0.0, f64::max);
        assert!(size > 0.0 && size < 0.02, "{on}: {size}");
        let told = dataset.steps[0].warnings.iter().find(|w| w.kind == WarningKind::SingularPoint);
        assert!(told.is_none(), "{on}: {told:?}");
    }
}

/// A warning tells what cells that may not be refined miss, and where: within a factor of four.
#[test]
fn what_coarse_cells_miss_is_told() {
    for (tables, exact, places) in [
        (PIECE.to_owned(), 6.16062039, 2),
        (CLAMPED.to_owned(), 2.96615408, 1),
        (kinked(90.0), 2.09772948, 1),
    ] {
        let dataset = solved_with(&tables, "level = 4\nrefine = false\nenrichment = \"zone\"");
        let missed = 1.0 - energy(&dataset) / exact;
        let all = dataset.steps[0].warnings.iter().filter(|w| w.kind == WarningKind::SingularPoint);
        let all: Vec<_> = all.collect();
        let told: f64 = all.iter().map(|warning| warning.value).sum();
        assert!(all.len() >= places && all.iter().all(|w| w.at.is_some()), "{all:?}");
        assert!(told > 0.25 * missed && told < 4.0 * missed, "{told} for {missed}");
    }
}

/// Where they are given room, cells need not shrink at all.
#[test]
fn functions_of_corners_need_no_small_cells() {
    let dataset = solved_with(&kinked(90.0), "level = 4\nrefine = false");
    assert!(dataset.steps[0].warnings.iter().all(|w| w.kind != WarningKind::SingularPoint));
    let error = 1.0 - energy(&dataset) / 2.09772948;
    assert!(error < 2e-4, "{error}");
}

/// Asserts that the side of a kink that turns inwards is found whichever way the crack runs, and in
/// the mirror.
fn assert_kink_has_no_direction(keys: &str) {
    let crack = |points: [[f64; 2]; 3]| {
        solved_with(&format!("{TENSION}[[crack]]\npoints = {points:?}\n"), keys)
    };
    let points = [[-0.45, -0.1], [0.05, -0.13], [0.03, 0.29]];
    let [a, b, c] = points;
    let [plain, reversed, mirrored] = [points, [c, b, a], points.map(|[x, y]| [-x, y])].map(crack);
    for other in [&reversed, &mirrored] {
        let apart = energy(other) / energy(&plain) - 1.0;
        assert!(apart.abs() < 1e-9, "{apart}");
    }
    let factors = |dataset: &Dataset, end: End| {
        let mut all = dataset.steps[0].intensities.iter();
        let tip = all.find(|tip| tip.tip.end == end).expect("the tip");
        [tip.k1, tip.k2]
    };
    let ([k1, k2], turned, seen) =
        (factors(&plain, End::Last), factors(&reversed, End::Start), factors(&mirrored, End::Last));
    assert!((k1 - turned[0]).abs() < 1e-8 && (k2 - turned[1]).abs() < 1e-8, "{turned:?}");
    assert!((k1 - seen[0]).abs() < 1e-8 && (k2 + seen[1]).abs() < 1e-8, "{seen:?}");
}

/// In cells that are divided and in others.
#[test]
fn kinks_from_both_ends_and_in_the_mirror() {
    for keys in ["level = 3\norder = 1\nrefine = false", "level = 2\norder = 1"] {
        assert_kink_has_no_direction(keys);
    }
}

/// A kink and a hole of four corners, both under pressure, oblique, reversed, far from the origin
/// and small; the values are those of the same solver.
#[test]
fn loaded_corners_anywhere() {
    let solution = |scale: f64, shift: [f64; 2], is_reversed: bool, keys: &str| {
        let place = |p: &[f64; 2]| [0, 1].map(|i| shift[i] + scale * p[i]);
        let mut crack = vec![[0.429901, 0.132984], [0.0, 0.0], [0.099783, 0.438798]];
        let mut hole = vec![[-0.6, -0.6], [-0.2, -0.55], [-0.25, -0.2], [-0.65, -0.25]];
        if is_reversed {
            crack.reverse();
            hole.reverse();
        }
        let [crack, hole] = [crack, hole].map(|all| all.iter().map(place).collect::<Vec<_>>());
        let [min, max] = [[-1.0; 2], [1.0; 2]].map(|p| place(&p));
        let text = format!(
            "[domain]\nmin = {min:?}\nmax = {max:?}\n[material]\nyoung = 1.0\npoisson = 0.3\n\
             state = \"plane-strain\"\n{TENSION}[[crack]]\npoints = {crack:?}\n[[hole]]\npoints = {hole:?}\n\
             [[boundary]]\non = {{ crack = 0 }}\npressure = 1.0\n[[boundary]]\non = {{ hole = 0 }}\npressure = 0.5\n\
             [discretization]\n{keys}\n"
        );
        let problem = parsed(&text);
        let dataset = solve(&checked(&problem), unwatched()).expect("a solution");
        let tip = |end: End| {
            let mut all = dataset.steps[0].intensities.iter();
            let tip = all.find(|tip| tip.tip.end == end).expect("the tip");
            [tip.k1, tip.k2].map(|k| k / scale.sqrt())
        };
        let tips = if is_reversed { [End::Last, End::Start] } else { [End::Start, End::Last] };
        (energy(&dataset) / (scale * scale), tips.map(tip))
    };
    let apart = |a: [[f64; 2]; 2], b: [[f64; 2]; 2]| {
        (0..4).fold(0.0f64, |m, k| m.max((a[k / 2][k % 2] - b[k / 2][k % 2]).abs()))
    };
    let (e, tips) = solution(1.0, [0.0; 2], false, "level = 2\norder = 3");
    println!("{e} {tips:?}");
    assert!((1.0 - e / 3.183605075).abs() < 1e-5, "{e}");
    let known = [[1.871555454, 0.416979824], [0.550392276, -0.444274214]];
    assert!(apart(tips, known) < 1e-5, "{tips:?}");
    let coarse = |scale: f64, shift: [f64; 2], is_reversed: bool| {
        // fine enough for the kink to have its functions
        solution(scale, shift, is_reversed, "level = 4\norder = 1\nrefine = false")
    };
    let (e, tips) = coarse(1.0, [0.0; 2], false);
    for (scale, shift, is_reversed) in
        [(1.0, [0.0; 2], true), (1.0, [1024.0, -512.0], false), (0.5f64.powi(20), [0.0; 2], false)]
    {
        let (other, same) = coarse(scale, shift, is_reversed);
        assert!((other / e - 1.0).abs() < 1e-9 && apart(tips, same) < 1e-8, "{other} {same:?}");
    }
}

/// Holes in a plate with a potential, and its energy.
const TRIANGLE: (&str, f64) = (
    "[[hole]]\npoints = [[-0.178964, -0.347091], [0.446308, -0.028445], [-0.136296, 0.322371]]\n",
    2.290_883_648,
);
const ELL: (&str, f64) = (
    "[[hole]]\npoints = [[-0.036187, -0.422718], [0.422718, -0.036187], [0.229453, 0.193265], \
     [0.0, 0.0], [-0.193265, 0.229453], [-0.422718, 0.036187]]\n",
    2.433_536_912,
);

fn assert_potential((hole, exact): (&str, f64), level: u32, order: usize, tolerance: f64) {
    let text = format!(
        "[domain]\nmin = [-1.0, -1.0]\nmax = [1.0, 1.0]\n[equation]\nkind = \"poisson\"\n[[boundary]]\n\
         on = \"bottom\"\nflux = -1.0\n[[boundary]]\non = \"top\"\nflux = 1.0\n{hole}[discretization]\n\
         level = {level}\norder = {order}\n"
    );
    let problem = parsed(&text);
    let dataset = solve(&checked(&problem), unwatched()).expect("a solution");
    let error = 1.0 - energy(&dataset) / exact;
    assert!((-1e-7..tolerance).contains(&error), "{order}: {error}");
    let functions = dataset.steps[0].functions.iter();
    assert!(functions.filter(|f| f.name.starts_with("r^")).count() >= 6);
}

/// Poisson's equation has other exponents; the values are those of the same solver.
#[test]
fn corners_of_potentials() {
    assert_potential(TRIANGLE, 3, 2, 1e-4);
    assert_potential(ELL, 3, 3, 1e-5);
}

#[test]
#[ignore = "slow: two more potentials at level 4"]
fn corners_of_potentials_at_other_orders() {
    assert_potential(TRIANGLE, 4, 3, 1e-5);
    assert_potential(ELL, 4, 2, 1e-4);
}

/// Where the material varies exponents are others, and of very many corners functions would cost
/// more than cells.
#[test]
fn corners_without_functions() {
    let square = |x: f64, y: f64, size: f64| {
        let [a, b, c, d] = [x, y, x + size, y + size];
        format!("[[hole]]\npoints = [[{a}, {b}], [{c}, {b}], [{c}, {d}], [{a}, {d}]]\n")
    };
    let has_functions = |tables: &str, keys: &str| {
        let plate = plate(&format!("{TENSION}{tables}"), &format!("level = 4\norder = 1\n{keys}"));
        let functions = discretise(&checked(&plate), unwatched()).expect("a space").functions;
        functions.iter().any(|f| f.name.starts_with("r^"))
    };
    let one = square(-0.3, -0.3, 0.6);
    assert!(has_functions(&one, ""));
    assert!(!has_functions(&one, "enrichment = \"zone\""));
    let many: String = (0..25)
        .map(|k| square(0.36 * f64::from(k % 5) - 0.9, 0.36 * f64::from(k / 5) - 0.9, 0.2))
        .collect();
    assert!(!has_functions(&many, ""));
}

/// A displacement that jumps along an edge has infinite energy: that is told, with the place, and
/// nothing is told of one that bends.
#[test]
fn given_values_that_jump_are_told() {
    let held = |value: &str| {
        let tables = format!("[[boundary]]\non = \"bottom\"\ndisplacement = [\"{value}\", 0.0]\n");
        let dataset = solved(&tables);
        let all = dataset.steps[0].warnings.iter().filter(|w| w.kind == WarningKind::SingularPoint);
        all.filter(|w| w.message.contains("infinite energy")).map(|w| w.at).collect::<Vec<_>>()
    };
    let [Some(at)] = held("if(x > 0.1, 0.3, 0)")[..] else { panic!("one place") };
    assert!((at.x - 0.1).abs() < 1e-9 && at.y == -1.0, "{at:?}");
    assert_eq!(held("max(x - 0.1, 0)"), []);
}

/// A quarter turn of everything turns cells and solution.
#[test]
fn a_quarter_turn_changes_nothing() {
    let turned = r#"
[[boundary]]
on = { edge = "right", from = -0.5, to = 0.3 }
displacement = [0.0, 0.0]
[[boundary]]
on = "left"
traction = [-1.0, 0.3]
"#;
    let [one, other] =
        [PIECE, turned].map(|tables| energy(&solved_with(tables, "level = 3\norder = 1")));
    assert!((one / other - 1.0).abs() < 1e-9, "{one} {other}");
}
