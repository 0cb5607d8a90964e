//! Problem files: good ones mean what they say, bad ones are reported where they are wrong.

mod anisotropy;
mod bad_files;
mod formulas;
mod holes;
mod keys;
mod large_files;
mod mistakes;
mod outlines;

use std::path::Path;

use ppum::crack::{CrackEnd, End, TipId};
use ppum::dataset::{Equation, Material, StressState};
use ppum::vec2::{Rect, vec2};
use ppum::weight::WeightFunction;

use super::*;

/// A good file; the tests replace parts of it. Line numbers: 1 title, 2 domain, 5 material, 9
/// crack, 11 and 14 boundary, 17 discretization.
const PLATE: &str = include_str!("../../tests/bad_files/centre_crack.toml");

/// The same for Poisson. Line numbers: 1 domain, 4 equation, 6 material, 8 and 11 boundary,
/// 14 source, 16 exact, 18 discretization.
const MEMBRANE: &str = include_str!("../../tests/bad_files/membrane.toml");

fn parse(text: &str) -> Result<Problem, ProblemError> {
    Problem::parse(text, "dir/plate.toml", Path::new("no/such/folder"))
}

fn edited(text: &str, old: &str, new: &str) -> String {
    assert_eq!(text.matches(old).count(), 1, "`{old}` must stand once in the file");
    text.replace(old, new)
}

fn good(text: &str) -> ProblemData {
    parse(text).unwrap_or_else(|error| panic!("{error}\n{text}")).into_data()
}

fn mistakes(text: &str) -> Vec<String> {
    match parse(text) {
        Ok(_) => panic!("nothing was found wrong:\n{text}"),
        Err(error) => error.mistakes().iter().map(Diagnostic::to_string).collect(),
    }
}

#[test]
fn plate() {
    let problem = good(PLATE);
    let material = Material { young: 2.5, poisson: 0.3, state: StressState::PlaneStrain };
    let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
    let neumann = "1 + x^2".parse().map(Condition::Neumann).expect("a formula");
    let dirichlet = Condition::Dirichlet(0.0.into());
    let expected = ProblemData {
        title: "Centre crack".to_owned(),
        text: Some(PLATE.to_owned()),
        ..ProblemData::elasticity(domain, material, Discretization::new(BaseCells::Level(4)))
            .with_crack(&[[-0.5, 0.0], [0.5, 0.0]])
            .with_boundary(DomainEdge::Bottom, vec![dirichlet, Condition::Free])
            .with_boundary(DomainEdge::Top, vec![Condition::Neumann(0.0.into()), neumann])
    };
    assert_eq!(problem, expected);
    assert_eq!(expected.check(), Ok(()));
}

#[test]
fn membrane() {
    let problem = good(MEMBRANE);
    assert_eq!(problem.title, "plate", "the title is the file's name if none is given");
    assert_eq!(problem.equation, Equation::poisson(2.0));
    assert_eq!(problem.source[0].value(vec2(3.0, 4.0)), 12.0);
    assert_eq!(problem.exact[0].text(), "x + y");
    assert_eq!(problem.discretization.cells, BaseCells::Grid([8, 4]));
    let [left, top] = problem.boundary.as_slice() else { panic!("two conditions") };
    assert_eq!(left.on, BoundaryPart::Edge { edge: DomainEdge::Left, from: 0.0, to: 1.0 });
    assert_eq!(left.components, [Condition::Dirichlet(problem.exact[0].clone())]);
    assert_eq!(top.on, BoundaryPart::Edge { edge: DomainEdge::Top, from: 0.5, to: 2.0 });
    assert!(matches!(top.components.as_slice(), [Condition::Neumann(_)]));
}

#[test]
fn everything_said() {
    let text = edited(
        &edited(PLATE, "title = \"Centre crack\"\n", "[solver]\nkind = \"direct\"\n"),
        "level = 4",
        "cells = [3, 5]\nrefine = false\norder = \"if(x > 0, 2.4, 1.5)\"\noverlap = 1.5\nweight = \"cubic\"\n\
         enrichment = \"additive-only\"\nenrichment_radius = 0.2\ntip_degree = 0\ninterfaces = false",
    );
    let problem = good(&text);
    let discretization = &problem.discretization;
    assert_eq!(
        problem.solver,
        SolverSettings { kind: SolverKind::Direct, ..SolverSettings::default() }
    );
    assert_eq!(discretization.order.at(vec2(0.5, 0.0)), Ok(2));
    assert_eq!(discretization.order.at(vec2(-0.5, 0.0)), Ok(2));
    let expected = Discretization {
        cells: BaseCells::Grid([3, 5]),
        refine: false,
        order: discretization.order.clone(),
        overlap: 1.5,
        weight: WeightFunction::Cubic,
        enrichment: Enrichment::AdditiveOnly,
        interfaces: false,
        enrichment_radius: Some(0.2),
        tip_degree: 0,
        tip_terms: None,
    };
    assert_eq!(*discretization, expected);
}

#[test]
fn good_variants_of_the_plate() {
    for (old, new) in [
        ("young = 2.5", "young = 210_000"),
        ("\"plane-strain\"", "\"plane-stress\""),
        ("poisson = 0.3", "poisson = -0.5"),
        ("[[-0.5, 0.0], [0.5, 0.0]]", "[[-1.0, 0.0], [0.0, 0.1], [0.5, 0.0]]"),
        ("[[-0.5, 0.0], [0.5, 0.0]]", "[[0.5, 0.0], [1, 1]]"),
        ("[0.0, \"free\"]", "[\"free\", \"free\"]"),
        ("[0.0, \"1 + x^2\"]", "[\"free\", 1]\ndisplacement = [\"x\", \"free\"]"),
        ("on = \"top\"\ntraction = [0.0,", "on = \"bottom\"\ntraction = [\"free\","),
        ("level = 4", "level = 0\n[equation]\nkind = \"elasticity\""),
        ("level = 4", "level = 10\norder = 8\n[solver]"),
        ("level = 4", "level = 4\n[body_force]\nvalue = [0, \"-x\"]"),
        ("title = \"Centre crack\"", ""),
    ] {
        good(&edited(PLATE, old, new));
    }
}

#[test]
fn ends_of_cracks() {
    let text = edited(PLATE, "[[-0.5, 0.0], [0.5, 0.0]]", "[[-1.0, 0.0], [0.0, 0.1], [0.5, 0.0]]");
    assert_eq!(good(&text).cracks()[0].ends, [CrackEnd::Mouth, CrackEnd::Tip]);
    assert_eq!(good(PLATE).cracks()[0].ends, [CrackEnd::Tip, CrackEnd::Tip]);
}

#[test]
fn exact_data() {
    let text = edited(PLATE, "[0.0, \"free\"]", "\"exact\"")
        + "[exact]\ndisplacement = [\"x*y\", \"2*x\"]\n";
    let problem = good(&text);
    let exact: Vec<_> = problem.exact.iter().cloned().map(Condition::Dirichlet).collect();
    assert_eq!(problem.boundary[0].components, exact);
    let one = edited(&text, "\"exact\"", "[\"free\", \"exact\"]");
    assert_eq!(good(&one).boundary[0].components, [Condition::Free, exact[1].clone()]);
}

#[test]
fn files_and_their_points() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("plate.toml");
    let text = edited(PLATE, "level = 4", "points = \"cloud.csv\"");
    std::fs::write(&file, text).expect("written");
    let read = || Problem::read(&file).map_err(|error| error.to_string());
    let wrong = |part: &str| {
        let error = read().expect_err("the points are wrong");
        assert!(error.contains(part), "{error}");
    };
    wrong("cloud.csv: cannot read the points: ");
    let cloud =
        |text: &str| std::fs::write(folder.path().join("cloud.csv"), text).expect("written");
    cloud("0.5, 0.25 # first\n-1,1\n");
    let points = vec![vec2(0.5, 0.25), vec2(-1.0, 1.0)];
    assert_eq!(
        read().map(|problem| problem.into_data().discretization.cells),
        Ok(BaseCells::Points(points))
    );
    cloud("0.5, 0.25\n1,y\n");
    wrong("cloud.csv:2:3: `y` is not a finite number");
    cloud("# none\n");
    wrong("cloud.csv: there are no points");
    cloud("0,0\n0,2\n");
    wrong("plate.toml:18:10: 1 of 2 points lie outside the domain, the first at [0, 2]");
}

/// Whoever writes a file can see that it is none of them.
#[test]
fn files_that_a_problem_names() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    std::fs::create_dir(at("data")).expect("a folder");
    std::fs::write(at("data/p.csv"), "0.5,0.25\n-0.5,-0.25\n").expect("written");
    std::fs::write(at("t.csv"), "-1,1\n1,2\n").expect("written");
    let table = "[[table]]\nname = \"k\"\nfile = \"./t.csv\"\n";
    let text = edited(PLATE, "level = 4", "points = \"data/p.csv\"") + table;
    let problem = Problem::parse(&text, "plate.toml", folder.path()).expect("it is right");
    assert_eq!(problem.files, [at("./t.csv"), at("data/p.csv")]);
    assert!(good(PLATE).files.is_empty());
}

/// No kind of file is read without an end, or from what is no file.
#[cfg(unix)]
#[test]
fn endless_files() {
    let folder = tempfile::tempdir().expect("a folder");
    let [zero, long] = ["zero", "long"].map(|name| folder.path().join(name));
    std::os::unix::fs::symlink("/dev/zero", &zero).expect("a link");
    std::fs::File::create(&long).and_then(|file| file.set_len(1 << 40)).expect("a hole");
    let points = edited(PLATE, "level = 4", "points = \"FILE\"");
    let table = PLATE.to_owned() + "[[table]]\nname = \"k\"\nfile = \"FILE\"\n";
    let error = |result: Result<Problem, ProblemError>| result.expect_err("endless").to_string();
    for (file, limits, reason) in [
        (zero, ["", "", ""], "it is a device, not a regular file"),
        (long, ["16 MiB", "64 MiB", "64 MiB"], "it has more than"),
    ] {
        let name = file.file_name().and_then(|name| name.to_str()).expect("text");
        let parse = |text: &str| Problem::parse(&text.replace("FILE", name), "p", folder.path());
        let found = [Problem::read(&file), parse(&points), parse(&table)].map(error);
        for (found, limit) in found.iter().zip(limits) {
            assert!(found.contains(reason) && found.contains(limit), "{found}");
        }
    }
}

#[test]
fn a_file_that_cannot_be_read() {
    let error = Problem::read(Path::new("no/such/file.toml")).expect_err("there is none");
    assert!(error.to_string().starts_with("no/such/file.toml: cannot read the problem file: "));
}

#[test]
fn problems_built_in_code_are_checked_alike() {
    let domain = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
    let problem = ProblemData::poisson(domain, 0.0, Discretization::new(BaseCells::Level(12)))
        .with_crack(&[[0.5, 0.5], [2.0, 0.5]])
        .with_boundary(DomainEdge::Top, vec![Condition::Free; 2]);
    let error = problem.check().expect_err("much is wrong");
    let keys: Vec<_> =
        error.mistakes().iter().map(|mistake| mistake.location.to_string()).collect();
    let expected =
        ["material.conductivity", "boundary[0]", "discretization.level", "crack[0].points[1]"];
    assert_eq!(keys, expected);
}

#[test]
fn default_enrichment_radius() {
    let tip = |crack, end| TipId { crack, end };
    let problem = good(PLATE);
    assert_eq!(problem.enrichment_radius(tip(0, End::Start)), 0.25);
    let near = problem.clone().with_crack(&[[1.0, 0.3], [0.5, 0.4]]);
    assert!((near.enrichment_radius(tip(0, End::Last)) - 0.1).abs() < 1e-15);
    assert!((near.enrichment_radius(tip(1, End::Last)) - 0.1).abs() < 1e-15);
    assert_eq!(near.enrichment_radius(tip(0, End::Start)), 0.25);
    let mut given = problem;
    given.discretization.enrichment_radius = Some(0.7);
    assert_eq!(given.enrichment_radius(tip(0, End::Last)), 0.7);
}

#[test]
fn the_example_of_the_documentation() {
    let page = include_str!("../../../../docs/problem-file.md");
    let mut blocks = page.split("```");
    let example = blocks.nth(1).and_then(|block| block.strip_prefix("toml\n"));
    let problem = good(example.expect("the page's first block is the example"));
    assert_eq!(problem.discretization, Discretization::new(BaseCells::Level(4)));
    assert_eq!(problem.boundary.len(), 2);
}

/// Every line left out, cut short, or given another value: what is refused is refused with a
/// reason, and what is accepted passes the checks.
#[test]
fn nothing_is_refused_without_a_reason() {
    const VALUES: &str = r#"1 -1 1e300 nan true "x" "" "free" "exact" [] [1] [1,2] [[1,2]] [[1,2],[3,4]]
        {} {a=1} 1979-05-27"#;
    let check = |lines: &[&str]| match parse(&lines.join("\n")) {
        Ok(problem) => assert_eq!(problem.check(), Ok(()), "{}", lines.join("\n")),
        Err(error) => assert!(!error.mistakes().is_empty(), "{}", lines.join("\n")),
    };
    for (text, is_cut) in [(PLATE, true), (MEMBRANE, true), (formulas::FORMULAS, false)] {
        let lines: Vec<_> = text.lines().collect();
        for (place, line) in lines.iter().enumerate() {
            let with = |new: &str| check(&[&lines[..place], &[new], &lines[place + 1..]].concat());
            with("");
            (0..line.len()).filter(|_| is_cut).for_each(|length| with(&line[..length]));
            let Some((key, _)) = line.split_once(" = ") else { continue };
            VALUES.split_whitespace().for_each(|value| with(&format!("{key} = {value}")));
        }
    }
}

#[test]
fn the_mistakes_of_the_documentation() {
    let page = include_str!("../../../../docs/problem-file.md");
    let blocks: Vec<_> = page.split("```").collect();
    let text = edited(blocks[1].trim_start_matches("toml\n"), "young", "yong");
    let text = edited(&text, "[0.5, 0.0]", "[5.0, 0.0]");
    let text = edited(&text, "[0.0, 1.0]", "[0.0, \"1 + z\"]");
    let error = Problem::parse(&text, "plate.toml", Path::new("")).expect_err("three mistakes");
    assert_eq!(blocks[3].trim_start_matches("text\n").trim_end(), error.to_string());
}
