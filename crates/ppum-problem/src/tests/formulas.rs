//! Tables, weights, enrichments, quantities and materials given by formulas.

use std::sync::Arc;

use ppum::dataset::NamedQuantity;
use ppum::formula::Table;
use ppum::function::{NonsmoothPoints, WESTERGAARD};
use ppum::library;

use super::*;

/// A plate with one of everything. Line numbers: 1 domain, 4 material, 8 crack, 10 and 13 boundary,
/// 16 and 20 table, 25, 32, 38 and 42 enrichment, 45 quantity, 49 discretization.
pub(super) const FORMULAS: &str = include_str!("../../tests/bad_files/formulas.toml");

#[test]
fn everything_given_by_formulas() {
    let problem = good(FORMULAS);
    let p = vec2(1.0, 0.0);
    let elastic = problem.equation.elastic().expect("elasticity");
    // the parabola through (−2, 3), (0, 1), (2, 3)
    assert_eq!((elastic.young.value(p), elastic.young.value(vec2(1.0, 0.6))), (1.5, 10.0));
    let Condition::Neumann(top) = &problem.boundary[0].components[1] else { panic!("a load") };
    assert_eq!(top.value(vec2(0.5, -1.0)), 1.5);
    let names: Vec<_> = problem.tables.iter().map(|table| table.name()).collect();
    assert_eq!(names, ["k", "g"]);
    assert_eq!(problem.discretization.enrichment, Enrichment::Jumps);
    assert!(matches!(problem.discretization.weight, WeightFunction::Formula(_)));
    let text = "sqrt(ux^2 + uy^2)*table(k, x)".to_owned();
    let quantity = NamedQuantity { name: "slip-rate".to_owned(), text, unit: "mm".to_owned() };
    assert_eq!(problem.quantities, [quantity]);
    assert_eq!(problem.check(), Ok(()));
}

#[test]
fn enrichments() {
    let problem = good(FORMULAS);
    let [corner, kink, tips, layer] = problem.enrichments.as_slice() else { panic!("four") };
    let angle = std::f64::consts::FRAC_PI_2;
    let expected = LocalEnrichment {
        name: "corner of mine".to_owned(),
        parameters: vec![("lambda".to_owned(), 0.6), ("m".to_owned(), 0.5 * angle)],
        region: EnrichmentRegion::Near(0.3),
        ..LocalEnrichment::new(
            &["r^lambda*cos(m*theta)", "table(k, y)"],
            Site::Point { at: vec2(0.5, 0.25), angle },
        )
    };
    assert_eq!(*corner, expected);
    let expected = LocalEnrichment {
        name: "kink".to_owned(),
        degree: Some(2),
        declared: NonsmoothPoints {
            kinks: vec![[vec2(0.0, 0.0), vec2(1.0, 0.0)]],
            singular: vec![vec2(0.5, 0.0)],
        },
        ..LocalEnrichment::new(&["abs(y)"], Site::Along([vec2(-1.0, 0.5), vec2(1.0, 0.5)]))
    };
    assert_eq!(*kink, expected);
    let expected = LocalEnrichment {
        name: "westergaard".to_owned(),
        region: EnrichmentRegion::Near(0.0),
        ..LocalEnrichment::new(&WESTERGAARD, Site::Tips)
    };
    assert_eq!(*tips, expected);
    assert_eq!((layer.site, layer.name.as_str()), (Site::World, ""));
    let EnrichmentRegion::Where(holds) = &layer.region else { panic!("a condition") };
    assert_eq!([-0.6, -0.4].map(|x| holds.value(vec2(x, 0.0))), [1.0, 0.0]);
}

#[test]
fn defaults_and_parameters_of_the_library() {
    let corner = |parameters: &str| {
        let text = edited(
            FORMULAS,
            "\"westergaard\"\nat = \"tips\"\nradius = 0",
            &format!("\"corner\"\nat = [0, 0]{parameters}"),
        );
        good(&text).enrichments.remove(2)
    };
    let new = corner("");
    let Some(entry) = library::enrichment("corner") else { panic!("an entry") };
    assert_eq!(new.functions, entry.texts);
    assert_eq!(new.parameters, [("lambda".to_owned(), entry.parameters[0].1)]);
    assert_eq!((new.region, new.degree), (EnrichmentRegion::Default, None));
    let new = corner("\nparameters = { lambda = \"1/4\" }");
    assert_eq!(new.parameters, [("lambda".to_owned(), 0.25)]);
}

#[test]
fn weights() {
    let weight = |text: &str| {
        let text = edited(FORMULAS, "exp(1 - 1/(1 - t^2))", text);
        good(&text).discretization.weight
    };
    assert_eq!(weight("quadratic"), WeightFunction::Quadratic);
    let bump = library::weight("bump").expect("an entry").texts[0];
    assert_eq!(weight("bump"), weight(bump));
    assert!(matches!(weight("(1 - t)*table(k, t)"), WeightFunction::Formula(_)));
}

#[test]
fn good_variants() {
    for (old, new) in [
        ("along = [[-1.0, 0.5], [1.0, 0.5]]", "along = [[-3, 0.5], [3, 0.6]]\nradius = 0.25"),
        ("at = [0.5, 0.25]", "at = [-1, 1]"),
        ("angle = \"pi/2\"", "angle = -1"),
        ("angle = \"pi/2\"\n", ""),
        ("radius = 0\n", "radius = 5\n"),
        ("radius = 0\n", ""),
        ("where = \"x < -0.5 and table(k, x) > 1\"", "degree = 1"),
        ("function = \"exp(-x/0.01)\"", "functions = [\"boundary-layer\", \"r + theta\", \"1\"]"),
        ("enrichment = \"jumps\"", "enrichment = \"none\""),
        ("unit = \"mm\"", "[[quantity]]\nname = \"more\"\nformula = \"2*slip_rate + young\""),
    ] {
        good(&edited(FORMULAS, old, new));
    }
}

#[test]
fn the_radius_of_the_zone_serves_own_functions() {
    let text = edited(FORMULAS, "radius = 0\n", "");
    good(&edited(&text, "\"jumps\"", "\"jumps\"\nenrichment_radius = 0.3"));
    let text = edited(FORMULAS, "\"jumps\"", "\"jumps\"\nenrichment_radius = 0.3");
    let found = mistakes(&text);
    assert!(found.len() == 1 && found[0].contains("has no meaning with enrichment = \"jumps\""));
}

#[test]
fn tips_that_are_missing_or_too_near() {
    let text = edited(FORMULAS, "radius = 0\n", "radius = 0.5\n");
    let text = edited(&text, "[[-1.0, 0.0], [0.0, 0.0]]", "[[-0.2, 0.0], [0.2, 0.0]]");
    assert_eq!(
        mistakes(&text),
        [
            "dir/plate.toml:41:10: `radius` is 0.5, but the ends of a crack are only 0.4 apart; give less \
          than half of that"
        ]
    );
    let text = edited(FORMULAS, "[[crack]]\npoints = [[-1.0, 0.0], [0.0, 0.0]]\n", "");
    let found = mistakes(&text);
    assert!(
        found.len() == 1 && found[0].contains("38:6: there is no tip; add a [[crack]]"),
        "{found:?}"
    );
}

/// Lines of a file of a table are named.
#[test]
fn files_of_tables() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("plate.toml");
    let text =
        edited(FORMULAS, "x = [-2.0, 0.0, 2.0]\nvalues = [3.0, 1.0, 3.0]", "file = \"k.csv\"");
    std::fs::write(&file, text).expect("written");
    let read = || Problem::read(&file).map_err(|error| error.to_string());
    let wrong = |part: &str| {
        let error = read().expect_err("the table is wrong");
        assert!(error.contains(part), "{error}");
    };
    let data = |text: &str| std::fs::write(folder.path().join("k.csv"), text).expect("written");
    wrong("k.csv: cannot read the table: ");
    data("# x, value\n-2, 3\n0, 1\n2, 3\n");
    let expected = Table::curve("k", vec![-2.0, 0.0, 2.0], vec![3.0, 1.0, 3.0]).expect("a table");
    assert_eq!(read().map(|problem| Arc::clone(&problem.tables[0])), Ok(Arc::new(expected)));
    data("-2, 3\n0, one\n");
    wrong("k.csv:2:4: `one` is not a finite number");
    data("1, 3\n");
    wrong("plate.toml:18:8: table `k` has 1 knots in x; at least two are needed");
    data("");
    wrong("k.csv: there are no values");
}

#[test]
fn enrichments_built_in_code_are_checked_alike() {
    let mut problem = good(FORMULAS);
    problem.enrichments[0].functions[1] = "table(k, z)".to_owned();
    problem.enrichments[1].parameters = vec![("x".to_owned(), 1.0)];
    problem.quantities[0].text = "young*z".to_owned();
    problem.tables.push(Arc::clone(&problem.tables[1]));
    let error = problem.check().expect_err("much is wrong");
    let keys: Vec<_> = error.mistakes().iter().map(|mistake| mistake.to_string()).collect();
    for (key, part) in [
        ("table[2].name: ", "the name `g` already has a meaning"),
        ("quantity[0].formula: ", ""),
        ("enrichment[0].", ""),
        ("enrichment[1].parameters: ", ""),
    ] {
        assert!(keys.iter().any(|k| k.starts_with(key) && k.contains(part)), "{key} {keys:?}");
    }
}
