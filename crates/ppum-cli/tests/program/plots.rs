//! Plots, and the tables behind them.

use crate::{CRACKED, LINEAR, Lab, Png};

fn read(lab: &Lab, name: &str) -> String {
    String::from_utf8_lossy(&std::fs::read(lab.path(name)).unwrap()).into_owned()
}

/// Rows of numbers of a table, without its names.
fn rows(table: &str) -> Vec<Vec<f64>> {
    let numbers = |line: &str| line.split(',').map(|n| n.parse().unwrap()).collect();
    table.lines().skip(1).map(numbers).collect()
}

#[test]
fn circles_and_tips_are_sampled() {
    let lab = Lab::solved(LINEAR);
    let table = lab.run("sample plate.h5 --circle 1,0.5,0.25 --count 5 -q u");
    assert!(table.starts_with("theta [deg],x,y,side,u\n"), "{table}");
    let found = rows(&table);
    assert_eq!(
        found.iter().map(|row| row[0]).collect::<Vec<_>>(),
        [-180.0, -90.0, 0.0, 90.0, 180.0]
    );
    for row in found {
        assert!((row[1] + 2.0 * row[2] - row[4]).abs() < 1e-9, "{row:?}");
        let from_center = (row[1] - 1.0).hypot(row[2] - 0.5);
        assert!((from_center - 0.25).abs() < 1e-12);
    }
    for wrong in
        ["--circle 1,0.5", "--circle 1,0.5,0", "--tip 0", "--angle 3", "--circle 0,0,1 --radius 2"]
    {
        lab.fail(&format!("sample plate.h5 {wrong}"));
    }
}

/// Faces are free of traction, and σ_rr r^(1/2) tends to a constant.
#[test]
fn values_around_a_tip() {
    let lab = Lab::solved(CRACKED);
    let around = rows(&lab.run("sample plate.h5 --tip 0 --radius 1e-9 --count 181 -q syy,sxx"));
    let (first, last) = (&around[0], &around[180]);
    assert_eq!((first[0], last[0]), (-180.0, 180.0));
    let largest = around.iter().map(|row| row[4].abs()).fold(0.0, f64::max);
    assert!(
        first[4].abs() < 0.02 * largest && last[4].abs() < 0.02 * largest,
        "{first:?} {last:?} {largest}"
    );
    assert_eq!(first[3] * last[3], -1.0, "the two faces");
    let away = rows(&lab.run("sample plate.h5 --tip 0 --angle 0 --radius 1e-3 --count 7 -q syy"));
    let scaled: Vec<f64> = away.iter().map(|row| row[4] * row[0].sqrt()).collect();
    assert!((away[0][0] / 1e-9 - 1.0).abs() < 1e-12 && (away[6][0] / 1e-3 - 1.0).abs() < 1e-12);
    assert!((scaled[0] / scaled[1] - 1.0).abs() < 1e-3, "{scaled:?}");
}

#[test]
fn plots_are_drawn() {
    let lab = Lab::solved(CRACKED);
    let told = lab.run("plot plate.h5 --tip 0 --angle 0 -q syy -o a.svg");
    let slope: f64 =
        told.split("slope −").nth(1).unwrap().split_whitespace().next().unwrap().parse().unwrap();
    assert!((slope - 0.5).abs() < 2e-3, "{told}");
    let svg = read(&lab, "a.svg");
    assert!(svg.contains("<title>Small plate</title>") && svg.contains(">r</text>"));
    let told = lab.run("plot plate.h5 --crack 0 -o b.pdf");
    assert!(told.contains("b.pdf: opening, sliding"), "{told}");
    assert!(read(&lab, "b.pdf").starts_with("%PDF-"));
    lab.run("plot plate.h5 --line 0.1,0.1,0.9,0.3 -q von-mises --log y --size 400x300 -o c.png");
    assert_eq!(Png::read(&lab.path("c.png")).size, [400, 300]);
    let told = lab.run("plot plate.h5 --history -o d.png");
    assert!(told.contains("plate"), "{told}");
    std::fs::copy(lab.path("plate.h5"), lab.path("other.h5")).unwrap();
    let told = lab.run("plot plate.h5 other.h5 --line 0.1,0.1,0.9,0.3 -q sxx -o e.svg");
    assert!(told.contains("plate: sxx, other: sxx"), "{told}");
}

/// The residuals of the iteration, the levels and the bytes of a solution, and what has none.
#[test]
fn the_solver_is_drawn() {
    let lab = Lab::new();
    let large = CRACKED.replace("level = 3", "level = 4").replace("order = 1", "order = 2");
    lab.write("plate.toml", &format!("{large}\n[solver]\nkind = \"multilevel\"\n"));
    lab.run("solve plate.toml");
    let told = lab.run("plot plate.h5 --history=residuals -o a.svg");
    let expected = "residual, on level 0, the finest, on level 1, the coarsest";
    assert!(told.contains(expected), "{told}");
    let svg = read(&lab, "a.svg");
    assert!(svg.contains(">iteration<") && svg.contains(">relative residual<"), "{svg}");
    assert!(svg.contains("10⁻"), "a logarithmic axis: {svg}");
    let told = lab.run("plot plate.h5 --history=levels -o b.svg");
    assert!(told.contains("values of the matrix, unknowns, patches"), "{told}");
    let told = lab.run("plot plate.h5 --history=bytes -o c.svg");
    let svg = read(&lab, "c.svg");
    assert!(told.contains("plate") && svg.contains("memory [MB]"), "{svg}");
    assert!(["basis", "assembly", "solution"].iter().all(|phase| svg.contains(phase)), "{svg}");
    std::fs::copy(lab.path("plate.h5"), lab.path("other.h5")).unwrap();
    let told = lab.run("plot plate.h5 other.h5 --history=residuals -o d.svg");
    assert!(told.contains("plate: residual, other: residual"), "{told}");
    let direct = Lab::solved(CRACKED);
    for what in ["residuals", "levels"] {
        let complaint = direct.fail(&format!("plot plate.h5 --history={what} -o a.svg"));
        assert!(complaint.contains("[solver]"), "{complaint}");
    }
    assert!(direct.fail("plot plate.h5 --history=levels --step 3 -o a.svg").contains("step 3"));
}

#[test]
fn plots_that_cannot_be_are_refused() {
    let lab = Lab::solved(CRACKED);
    for (options, part) in [
        ("--crack 7", "numbered from 0"),
        ("--tip 7", "numbered from 0"),
        ("--line 0,0,0,0", "its two points are equal"),
        ("--line 0,0,1,1 --count 1", "two points or more"),
        ("--convergence", "three datasets or more"),
        ("plate.h5 plate.h5 --convergence", "three different numbers of unknowns"),
        ("--line 50,50,60,60", "would show nothing"),
        ("--line 0.1,0.1,0.9,0.3 -q 1/0", "all values are infinite"),
        ("--line 0.1,0.1,0.9,0.3 -q=-1 --log y", "no value is positive"),
        ("--crack 0 --size 239x500", "give at least 240x180"),
        ("--line 0,0,1,1 -q nonsense", "nonsense"),
        ("", "required"),
        ("--line 0,0,1,1 --crack 0", "cannot be used with"),
        ("--history -q sxx", "cannot be used with"),
        ("--tip 0 --angle 181", "from -180 to 180"),
        ("--crack 0 --size 100000x100000", "at most 67108864 pixels"),
    ] {
        let complaint = lab.fail(&format!("plot plate.h5 {options} -o a.png"));
        assert!(complaint.contains(part), "{options}: {complaint}");
        assert!(!lab.path("a.png").exists());
    }
    assert!(lab.fail("plot plate.h5 --crack 0 -o a.csv").contains("PNG, SVG or PDF"));
}

/// Of quadratic local spaces the energy norm of the error falls like h², the L² norm like h³;
/// unknowns grow like h⁻².
#[test]
fn convergence_has_its_rates() {
    let lab = Lab::new();
    let problem = include_str!("../../../../examples/smooth-field.toml");
    let line = problem.lines().find(|line| line.starts_with("level = ")).unwrap();
    for level in [2, 3, 4] {
        lab.write(&format!("{level}.toml"), &problem.replace(line, &format!("level = {level}")));
        lab.run(&format!("solve {level}.toml -o {level}.h5"));
    }
    let told = lab.run("plot 2.h5 4.h5 3.h5 --convergence -o rates.svg");
    let slope = |name: &str| -> f64 {
        let (_, rest) =
            told.split_once(&format!("{name}, slope −")).unwrap_or_else(|| panic!("{told}"));
        rest.split([',', '\n']).next().unwrap().trim().parse().unwrap()
    };
    assert!((slope("energy norm") - 1.0).abs() < 0.12, "{told}");
    assert!((slope("L² norm") - 1.5).abs() < 0.2, "{told}");
}

/// Datasets of different equations are not of one problem.
#[test]
fn convergence_is_of_one_problem() {
    let lab = Lab::solved(CRACKED);
    std::fs::copy(lab.path("plate.h5"), lab.path("cracked.h5")).unwrap();
    lab.write("linear.toml", LINEAR);
    lab.run("solve linear.toml -o linear.h5");
    let told = lab.fail("plot cracked.h5 cracked.h5 linear.h5 --convergence -o a.png");
    assert!(told.contains("cracked and linear are of two: the equation"), "{told}");
}

/// The subpaths of the curves of a plot.
fn strokes(svg: &str) -> usize {
    let paths = svg.split("<path").filter(|path| path.contains("#0072b2") && !path.contains(" Z"));
    paths.map(|path| path.split('/').next().unwrap().matches('M').count()).max().unwrap_or(0)
}

/// A line through a crack is two strokes, with both faces where it passes.
#[test]
fn lines_break_at_cracks() {
    let lab = Lab::solved(CRACKED);
    for (way, expected) in [
        ("--line 0.1,-0.43,0.2,0.57", 2),
        ("--line 0.1,-0.4,0.1,0.4", 2),
        ("--line 0.1,-0.43,0.2,-0.01", 1),
        ("--line 0.6,-0.43,0.6,0.57", 1),
        ("--circle 0.5,0.1,0.3", 2),
        // the halves below and above the crack
        ("--circle 0,0,0.4", 2),
    ] {
        lab.run(&format!("plot plate.h5 {way} -q uy -o curve.svg"));
        assert_eq!(strokes(&read(&lab, "curve.svg")), expected, "{way}");
    }
}

/// What has no place on a logarithmic axis is told of.
#[test]
fn values_without_a_logarithm_are_told() {
    let lab = Lab::solved(CRACKED);
    let (_, told) = lab.warned("plot plate.h5 --line 0.1,0.1,0.9,0.1 -q x-0.5 --log y -o a.svg");
    assert!(told.contains("is not positive at"), "{told}");
}
