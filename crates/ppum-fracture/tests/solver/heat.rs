//! Temperatures that another problem gives: beside formulas, closed forms, and what must hold for
//! any of them.

use super::eigenstrain::{
    Body, EDGES, STATES, WAVES, check, difference, factors, size, temperature,
};
use crate::studies::support::{checked, parsed, quantity, record, solved};
use ppum::dataset::{Dataset, TipIntensity, Warning, WarningKind};
use ppum::progress::unwatched;
use ppum::vec2::{Vec2, vec2};
use ppum_fracture::diagnostics::recompute;
use ppum_fracture::growth::series;
use ppum_fracture::intensity::on_circle;
use ppum_fracture::solve::Plan;
use ppum_problem::{Problem, ProblemData};
use ppum_testkit::random::Random;
use std::f64::consts::PI;
use std::path::Path;

/// The problem of a temperature in a body, with its conditions.
fn heat_text(body: &Body, conditions: &str) -> String {
    let Body { crack: [a, b], scale, .. } = body;
    let [a, b] = [*a * *scale, *b * *scale];
    format!(
        "[equation]\nkind = \"poisson\"\n[domain]\nmin = [-{scale}, -{scale}]\nmax = [{scale}, {scale}]\n[[crack]]\n\
         points = [[{}, {}], [{}, {}]]\n[discretization]\nlevel = 1\n{conditions}",
        a.x, a.y, b.x, b.y
    )
}

/// The section that takes its temperature from there.
pub(super) fn heated(body: &Body, conditions: &str) -> String {
    format!("[temperature]\nproblem = '''\n{}'''\n", heat_text(body, conditions))
}

/// Temperatures on all edges.
pub(super) fn on_edges(value: &str) -> String {
    let edge = |on| format!("[[boundary]]\non = \"{on}\"\nvalue = \"{value}\"\n");
    EDGES.map(edge).concat()
}

/// A polynomial of the second degree with a source, which is harmonic without, the conditions under
/// which it is the temperature of a cracked body, and its value at a point.
fn quadratic(
    body: &Body,
    random: &mut Random,
    source: f64,
) -> (String, String, impl Fn(Vec2) -> f64 + use<>) {
    let [a, b, c, d, e] = [(); 5].map(|()| random.between(-1.0, 1.0));
    let f = source / -4.0;
    let text =
        format!("{a} + ({b})*x + ({c})*y + ({d})*(x^2 - y^2) + ({e})*x*y + ({f})*(x^2 + y^2)");
    let n = (body.crack[1] - body.crack[0]).unit().left();
    let slope = format!(
        "({})*(({b}) + 2*({d} + {f})*x + ({e})*y) + ({})*(({c}) - 2*({d} - {f})*y + ({e})*x)",
        n.x, n.y
    );
    // the normal that leaves the body at the upper face is −n
    let face = |name: &str, sign: &str| {
        format!(
            "[[boundary]]\non = {{ crack = 0, face = \"{name}\" }}\nflux = \"{sign}({slope})\"\n"
        )
    };
    let source = format!("[source]\nvalue = {source}\n");
    let conditions = on_edges(&text) + &face("above", "-") + &face("below", "") + &source;
    let value = move |p: Vec2| {
        let (xx, yy) = (p.x * p.x, p.y * p.y);
        a + b * p.x + c * p.y + d * (xx - yy) + e * p.x * p.y + f * (xx + yy)
    };
    (text, conditions, value)
}

/// A temperature that the local spaces have is that of its formula, and so are its consequences.
#[test]
fn polynomials_are_their_formulas() {
    let mut random = Random(171);
    for state in STATES {
        let body = Body::random(&mut random, state);
        let (text, conditions, value) = quadratic(&body, &mut random, 3.0);
        let dataset = body.solved(&heated(&body, &conditions));
        let given = body.solved(&temperature(&text));
        let (found, expected) = (factors(&dataset, &body), factors(&given, &body));
        let [k, t, root] = difference(&found, &expected).map(|d| d / size(&expected));
        // what quadrature leaves in the heat problem itself, seen in its mean
        check(state, &[k, t, root], &[1e-8, 1e-8, 1e-8]);
        let [energy, exact] = [&dataset, &given].map(|data| record(&data.steps[0], "energy"));
        assert!((energy / exact - 1.0).abs() < 1e-9, "{energy} {exact}");
        // point by point 3e-7 in a heat problem alone, and E α/(1 − 2 ν) times that in stresses
        for _ in 0..20 {
            let p = vec2(random.between(-0.99, 0.99), random.between(-0.99, 0.99));
            let found = quantity(&dataset, "temperature", p);
            assert!((found - value(p)).abs() < 1e-6, "{found} {}", value(p));
            for name in ["sxx", "syy", "sxy", "szz", "von-mises", "energy", "eigenstrain_xx"] {
                let [found, expected] = [&dataset, &given].map(|data| quantity(data, name, p));
                assert!(
                    (found - expected).abs() < 1e-5 * (1.0 + expected.abs()),
                    "{name} {found} {expected}"
                );
            }
        }
    }
}

/// A body that is nowhere held takes a harmonic temperature without stress in the plane, if that is
/// single-valued and smooth; J and the energy are squares of what is left of zero.
#[test]
fn harmonic_temperatures_make_no_stress() {
    let mut random = Random(172);
    let body = Body::random(&mut random, STATES[0]);
    let (_, conditions, _) = quadratic(&body, &mut random, 0.0);
    let dataset = body.solved(&heated(&body, &conditions));
    let [k, t, root] = difference(&factors(&dataset, &body), &[[0.0; 4]; 2]);
    check("harmonic", &[k, t, root], &[1e-8, 1e-8, 1e-5]);
    let energy = record(&dataset.steps[0], "energy");
    println!("energy {energy:e}");
    assert!(energy < 1e-14, "{energy}");
}

/// An insulated crack in a steady flux of heat (Florence & Goodier 1960), the temperature once by
/// its formula, and once from the conditions that it satisfies.
#[test]
fn insulated_cracks() {
    for (state, part) in [(STATES[0], 1.0), (STATES[1], 0.7)] {
        let (a, h) = (0.05, 2.0);
        let crack = [vec2(-a, 0.0), vec2(a, 0.0)];
        let body =
            Body { young: 3.0, poisson: 0.3, alpha: 0.5, state, crack, scale: 1.0, order: 3 };
        let text = format!(
            "{h}*sqrt(hypot(x - {a}, y)*hypot(x + {a}, y))*sin((atan2(y, x - {a}) + atan2(y, x + {a}))/2)"
        );
        let expected = body.young * body.alpha * h * PI.sqrt() * a.powf(1.5) / 4.0 / part;
        let given = factors(&body.solved(&temperature(&text)), &body);
        let solved = body.solved(&heated(&body, &on_edges(&text)));
        for ([k1, k2, _, j], [_, formula, ..]) in factors(&solved, &body).into_iter().zip(given) {
            let found = [
                k1.abs() / expected,
                (k2.abs() / expected - 1.0).abs(),
                (j / expected - 1.0).abs(),
                (k2 / formula - 1.0).abs(),
            ];
            println!("K_II of the formula {:e}", (formula.abs() / expected - 1.0).abs());
            check(state, &found, &[1e-6, 1e-2, 1e-2, 1e-2]);
        }
    }
}

/// A crack in a temperature of waves on the edges and a source, insulated.
fn waves(text: &str) -> String {
    format!("{}[source]\nvalue = \"{text}\"\n", on_edges(text))
}

/// Loads and temperatures add up; a body n times as large has √n times K; that of a crack whose
/// points are listed backwards is the same, and so is that of a body turned by a right angle. J is
/// that of K.
#[test]
fn symmetries_of_the_equations() {
    let mut random = Random(174);
    for state in STATES {
        let body = Body::random(&mut random, state);
        let load = random.between(0.5, 1.0);
        let edge = |on, sign: f64| {
            format!("[[boundary]]\non = \"{on}\"\ntraction = [0, {}]\n", sign * load)
        };
        let top = edge("top", 1.0) + &edge("bottom", -1.0);
        let of = |body: &Body, text: &str, rest: &str| {
            factors(&body.solved(&(heated(body, &waves(text)) + rest)), body)
        };
        let heated = of(&body, WAVES, "");
        let loaded = factors(&body.solved(&top), &body);
        let k = size(&heated);
        let compare = |what: &str, found: &[[f64; 4]], expected: &[[f64; 4]]| {
            check(what, &difference(found, expected).map(|d| d / k), &[1e-8, 1e-7, 1e-7]);
        };
        let mut sum = of(&body, WAVES, &top);
        let mut expected = heated.clone();
        for (tip, (sum, loaded)) in expected.iter_mut().zip(sum.iter_mut().zip(&loaded)) {
            (0..3).for_each(|k| tip[k] += loaded[k]);
            let found = sum[0].hypot(sum[1]);
            println!("√(J E′)/|K| − 1 = {:e}", sum[3] / found - 1.0);
            assert!((sum[3] / found - 1.0).abs() < 2e-2, "{sum:?}");
            (tip[3], sum[3]) = (0.0, 0.0);
        }
        compare("sum", &sum, &expected);

        let large = Body { scale: 4.0, ..body.clone() };
        let wide = WAVES.replace('x', "(x/4)").replace('y', "(y/4)");
        let conditions = on_edges(&wide) + &format!("[source]\nvalue = \"({wide})/16\"\n");
        let dataset = large.solved(&self::heated(&large, &conditions));
        let found = factors(&dataset, &large).into_iter();
        let found: Vec<_> = found.map(|[a, b, t, j]| [a / 2.0, b / 2.0, t, j / 2.0]).collect();
        compare("scale", &found, &heated);

        let [a, b] = body.crack;
        let mut found = of(&Body { crack: [b, a], ..body.clone() }, WAVES, "");
        found.reverse();
        compare("reversed", &found, &heated);

        let turned = Body { crack: [a.left(), b.left()], ..body.clone() };
        let text = WAVES.replace('x', "X").replace('y', "(-x)").replace('X', "y");
        compare("turned", &of(&turned, &text, ""), &heated);
    }
}

/// The temperature of the dataset is the solution of its problem, on the same cells, and stresses
/// are those of ε − α T.
#[test]
fn fields_of_the_dataset() {
    let mut random = Random(175);
    for state in STATES {
        let body = Body::random(&mut random, state);
        let dataset = body.solved(&heated(&body, &waves(WAVES)));
        dataset.check().expect("a dataset");
        assert_eq!(dataset.steps[0].fields[0].components, ["ux", "uy", "temperature"]);
        let text = heat_text(&body, &waves(WAVES));
        let heat = solved(&parsed(&text.replace("level = 1", "cells = [6, 6]\norder = 3")));
        let [p_wave, lambda, beta] = body.moduli();
        for _ in 0..40 {
            let p = random.point(&dataset.domain.bounds);
            let at = |name: &str| quantity(&dataset, name, p);
            let [t, alone] = [at("temperature"), quantity(&heat, "u", p)];
            assert!((t - alone).abs() < 1e-12 * (1.0 + t.abs()), "{t} {alone}");
            let [exx, eyy] = ["exx", "eyy"].map(at);
            let expected = p_wave * exx + lambda * eyy - beta * t;
            assert!((at("sxx") - expected).abs() < 1e-11 * (1.0 + expected.abs()));
            assert!((at("sxx + 0*x") - expected).abs() < 1e-11 * (1.0 + expected.abs()));
            let size = at("ux").hypot(at("uy"));
            assert!((at("magnitude") - size).abs() < 1e-14 * (1.0 + size));
        }
    }
}

/// Factors and warnings of the dataset are found again, by its own problem, and on a circle.
#[test]
fn datasets_are_complete() {
    let body = Body::random(&mut Random(176), STATES[1]);
    let problem = body.problem(&heated(&body, &waves(WAVES)));
    let dataset = solved(&problem);
    let again = Problem::of_step(&dataset, 0).expect("a problem").expect("a text");
    assert_eq!(again.temperature, problem.temperature);
    let (tips, warnings) = recompute(&dataset, 0, Some(&again), unwatched()).expect("a step");
    for (known, again) in dataset.steps[0].intensities.iter().zip(&tips) {
        let again = again.factors.clone().expect("factors");
        assert_eq!(TipIntensity { error: None, ..known.clone() }, again);
        let radius = again.rings[2].r2;
        let circle = on_circle(
            &dataset,
            0,
            known.tip,
            radius,
            Some(&checked(&again_problem(&dataset))),
            unwatched(),
        );
        let circle = circle.expect("factors");
        assert!((circle.k1 - again.k1).abs() + (circle.k2 - again.k2).abs() < 1e-12);
    }
    let kinds = |dataset: &Dataset| {
        dataset.steps[0].warnings.iter().map(|w| w.kind.clone()).collect::<Vec<_>>()
    };
    assert_eq!(warnings.iter().map(|w| w.kind.clone()).collect::<Vec<_>>(), kinds(&dataset));
}

/// Warnings of the temperature's own problem are among those of the body, marked, and found again.
#[test]
fn warnings_of_the_temperature() {
    let body = Body { order: 2, ..Body::random(&mut Random(179), STATES[0]) };
    let jump = on_edges("0").replacen("\"0\"", "1", 1);
    let spike = "[source]\nvalue = \"hypot(x - 0.51, y + 0.52)^(-1.5)\"\n";
    let alone = heat_text(&body, &(jump.clone() + spike));
    let alone = solved(&parsed(&alone.replace("level = 1", "cells = [6, 6]\norder = 2")));
    let problem = body.problem(&heated(&body, &(jump + spike)));
    let dataset = solved(&problem);
    let of_heat = |warnings: &[Warning]| -> Vec<Warning> {
        let marked = warnings.iter().filter(|w| matches!(w.kind, WarningKind::OfTemperature(_)));
        marked.cloned().collect()
    };
    let found = of_heat(&dataset.steps[0].warnings);
    let expected: Vec<_> =
        alone.steps[0].warnings.iter().map(|w| (&w.kind, w.at, w.value)).collect();
    assert_eq!(found.len(), expected.len(), "{found:?} {expected:?}");
    for kind in [WarningKind::SingularPoint, WarningKind::Load] {
        assert!(expected.iter().any(|(known, ..)| **known == kind), "{kind}: {expected:?}");
    }
    for (found, (kind, at, value)) in found.iter().zip(expected) {
        println!("{}", found.message);
        assert_eq!(
            (&found.kind, found.at),
            (&WarningKind::OfTemperature(Box::new(kind.clone())), at)
        );
        assert!((found.value / value - 1.0).abs() < 1e-9, "{} {value}", found.value);
        assert!(found.message.starts_with("the temperature: "), "{}", found.message);
    }
    let (_, again) = recompute(&dataset, 0, Some(&checked(&problem)), unwatched()).expect("a step");
    // a dataset does not hold what quadrature left open
    let load = WarningKind::OfTemperature(Box::new(WarningKind::Load));
    let expected: Vec<_> = found.iter().filter(|w| w.kind != load).collect();
    assert_eq!(of_heat(&again).iter().collect::<Vec<_>>(), expected);
}

/// A good problem of a temperature has no warnings, whatever digits its gradient has.
#[test]
fn good_temperatures_are_silent() {
    let body = Body { order: 2, ..Body::random(&mut Random(180), STATES[1]) };
    for text in ["2", "1 + x"] {
        let dataset = body.solved(&heated(&body, &on_edges(text)));
        let warnings = &dataset.steps[0].warnings;
        assert!(
            warnings.iter().all(|w| !matches!(w.kind, WarningKind::OfTemperature(_))),
            "{warnings:?}"
        );
    }
}

/// Files that the file of a temperature names need not be there once the body is solved, and its
/// text is in the dataset as it is written.
#[test]
fn datasets_need_no_files() {
    let body = Body { order: 1, ..Body::random(&mut Random(181), STATES[0]) };
    let folder = tempfile::tempdir().expect("a folder");
    let heat = heat_text(&body, &on_edges("x")).replace("level = 1", "points = \"p.csv\"");
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text);
    write("heat.toml", &heat).and(write("p.csv", "0.1,0.2\n-0.5,0.3\n")).expect("written");
    let text = body.text("[temperature]\nproblem = \"heat.toml\"\n");
    let problem = Problem::parse(&text, "body.toml", folder.path()).expect("a problem");
    assert_eq!(problem.files.len(), 2, "{:?}", problem.files);
    let dataset = solved(&problem);
    drop(folder);
    assert!(dataset.problem.as_ref().expect("a text").contains("value = \"x\"\n"));
    let again = again_problem(&dataset);
    let (tips, _) = recompute(&dataset, 0, Some(&checked(&again)), unwatched()).expect("a step");
    let again: Vec<_> = tips.into_iter().filter_map(|tip| tip.factors).collect();
    assert_eq!(again.len(), 2);
    for (known, again) in dataset.steps[0].intensities.iter().zip(again) {
        assert_eq!(TipIntensity { error: None, ..known.clone() }, again);
    }
}

/// Mistakes have the places at which whoever wrote the file finds them.
#[test]
fn places_of_mistakes() {
    let body = Body::random(&mut Random(182), STATES[0]);
    let mistake = "value = \"x +\"\n";
    let wrong = on_edges("x").replacen("value = \"x\"\n", mistake, 2);
    let quotes = [("'''", "'''"), ("'''\n", "'''"), ("\"\"\"\n", "\"\"\"")];
    for (open, close) in quotes {
        let heat = heat_text(&body, &wrong);
        let heat = if close == "'''" { heat } else { heat.replace('"', "\\\"") };
        let text = body.text(&format!("[temperature]\nproblem = {open}{heat}{close}\n"));
        let error = Problem::parse(&text, "body.toml", Path::new("")).expect_err("a mistake");
        let places: Vec<_> = error.mistakes().iter().map(|m| m.location.to_string()).collect();
        let lines = text.lines().enumerate().filter(|(_, line)| line.contains("x +"));
        let expected: Vec<_> = lines.map(|(n, _)| format!("body.toml:{}:13", n + 1)).collect();
        assert_eq!(expected.len(), 2);
        assert_eq!(places, expected, "{error}");
    }
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("heat.toml");
    std::fs::write(&file, heat_text(&body, &wrong)).expect("written");
    let text = body.text("[temperature]\nproblem = \"heat.toml\"\n");
    let error = Problem::parse(&text, "body.toml", folder.path()).expect_err("a mistake");
    let lines = heat_text(&body, &wrong);
    let lines = lines.lines().enumerate().filter(|(_, line)| line.contains("x +"));
    let expected = lines.map(|(n, _)| format!("{}:{}:13", file.display(), n + 1));
    let places = error.mistakes().iter().map(|m| m.location.to_string());
    assert_eq!(places.collect::<Vec<_>>(), expected.collect::<Vec<_>>(), "{error}");
}

/// The memory that is estimated has that of the temperature in it.
#[test]
fn estimates_include_the_temperature() {
    let body = Body::random(&mut Random(183), STATES[0]);
    let estimate = |problem: &ProblemData| {
        *Plan::new(&checked(problem), None, unwatched()).expect("a plan").estimate()
    };
    // a temperature of many more functions than the displacement has
    let function =
        |k| format!("[[enrichment]]\nfunction = \"sin({k}*x)\"\nwhere = \"x < 9\"\ndegree = 3\n");
    let functions: String = (1..12).map(function).collect();
    for (extra, is_larger) in [("", false), (functions.as_str(), true)] {
        let conditions = waves(WAVES) + extra;
        let both = estimate(&body.problem(&heated(&body, &conditions)));
        let plain = estimate(&body.problem(&temperature(WAVES)));
        let heat = heat_text(&body, &conditions).replace("level = 1", "cells = [6, 6]\norder = 3");
        let heat = estimate(&parsed(&heat));
        assert_eq!(both.unknowns, plain.unknowns);
        assert_eq!(heat.memory > plain.memory, is_larger, "{heat} {plain}");
        assert!(both.memory >= heat.memory && both.memory > plain.memory, "{both}");
        assert!(both.memory < heat.memory + plain.memory, "{both}");
    }
}

fn again_problem(dataset: &Dataset) -> ProblemData {
    Problem::of_dataset(dataset).expect("a problem").expect("a text").into_data()
}

/// In each step of growth the temperature is that of the cracks as they are then.
#[test]
fn cracks_grow_in_their_own_temperature() {
    let body = Body { order: 2, ..Body::random(&mut Random(177), STATES[0]) };
    let pulled = |on, t| format!("[[boundary]]\non = \"{on}\"\ntraction = [0, {t}]\n");
    let rest = heated(&body, &waves(WAVES)) + &pulled("top", 5.0) + &pulled("bottom", -5.0);
    let growth = "[growth]\nsteps = 2\nincrement = 0.1\n";
    let all = series(&checked(&body.problem(&(rest.clone() + growth))), None, unwatched());
    let all = all.expect("a series");
    assert_eq!(all.steps.len(), 3);
    for step in &all.steps[1..] {
        let points: Vec<_> =
            step.cracks[0].points.iter().map(|p| format!("[{}, {}]", p.x, p.y)).collect();
        let bulges = &step.cracks[0].bulges;
        let crack = format!("points = [{}]\nbulges = {bulges:?}", points.join(", "));
        let [a, b] = body.crack;
        let old = format!("points = [[{}, {}], [{}, {}]]", a.x, a.y, b.x, b.y);
        let text = body.problem(&rest).text.expect("a text").replace(&old, &crack);
        let alone = solved(&parsed(&text));
        let (found, expected) = (&step.intensities, &alone.steps[0].intensities);
        assert_eq!(found.len(), 2);
        for (found, expected) in found.iter().zip(expected) {
            let off = (found.k1 - expected.k1).hypot(found.k2 - expected.k2);
            assert!(off < 1e-9 * expected.k1.hypot(expected.k2), "{off}");
        }
    }
}

/// Where α jumps, kinks, cells and quadrature are those of a temperature by formula.
#[test]
fn expansion_that_jumps_is_resolved() {
    let body = Body::random(&mut Random(31), STATES[1]);
    let jump = format!("expansion = \"if(y > 0.13 + 0.1*x, {}, 0.5)\"", body.alpha);
    let of = |rest: &str| {
        let text = body.text(rest).replace(&format!("expansion = {}", body.alpha), &jump);
        solved(&parsed(&text))
    };
    let [given, found] = [temperature("2"), heated(&body, &on_edges("2"))].map(|rest| of(&rest));
    let steps = [&given, &found].map(|dataset| &dataset.steps[0]);
    let [kinks, cells] = [
        steps.map(|step| step.functions.iter().filter(|f| f.name.starts_with("kink at")).count()),
        steps.map(|step| step.partition.len()),
    ];
    assert!(kinks[0] > 0 && kinks[0] == kinks[1] && cells[0] == cells[1], "{kinks:?} {cells:?}");
    let [a, b] = steps.map(|step| &step.intensities);
    let size = a.iter().map(|tip| tip.k1.hypot(tip.k2)).fold(0.0, f64::max);
    for (a, b) in a.iter().zip(b) {
        let apart = (a.k1 - b.k1).hypot(a.k2 - b.k2);
        assert!(apart < 1e-7 * size, "{apart:.1e} of {size}");
    }
}

/// The problem of a temperature has the body and the cells of its own where it says nothing of
/// them: without these tables the solution has the same bits, and its dataset can be read again.
#[test]
fn temperatures_need_not_repeat_the_body() {
    let mut random = Random(77);
    for state in STATES {
        let body = Body { order: 2, ..Body::random(&mut random, state) };
        let whole = heat_text(&body, &on_edges("x + y"));
        let is_body = |table: &&str| {
            ["domain]", "[crack]]", "discretization]"].iter().any(|t| table.starts_with(t))
        };
        let rest: Vec<_> = whole.split("\n[").filter(|table| !is_body(table)).collect();
        assert_eq!(whole.split("\n[").count(), rest.len() + 3, "{whole}");
        let short = format!("[temperature]\nproblem = '''\n{}'''\n", rest.join("\n["));
        let held = "[[boundary]]\non = \"top\"\ndisplacement = [0, 0]\n";
        let [expected, found] = [heated(&body, &on_edges("x + y")), short]
            .map(|heat| solved(&parsed(&body.text(&(heat + held)))));
        assert_eq!(expected.steps[0].fields, found.steps[0].fields);
        assert_eq!(expected.steps[0].intensities, found.steps[0].intensities);
        let again = again_problem(&found);
        assert_eq!(again.temperature, parsed(found.problem.as_ref().expect("a text")).temperature);
        assert_eq!(again.body, again.temperature.as_ref().expect("heat").problem.body);
    }
}

/// What has no meaning is refused, with its place.
#[test]
fn refused_temperatures() {
    let body = Body::random(&mut Random(178), STATES[0]);
    let wrong = |section: &str, rest: &str, needed: &str| {
        let held = "[[boundary]]\non = \"top\"\ndisplacement = [0, 0]\n";
        let text = body.problem(held).text.expect("a text") + section + rest;
        let error = Problem::parse(&text, "body.toml", Path::new("")).expect_err("a mistake");
        assert!(error.to_string().contains(needed), "{error}");
    };
    let good = heated(&body, &on_edges("x"));
    wrong(&good.replace("\"poisson\"", "\"elasticity\""), "", "material");
    wrong(&good.replace("[-1, -1]", "[-2, -1]"), "", "another body");
    let [a, b] = body.crack;
    let longer = Body { crack: [a, b + (b - a) * 0.01], ..body.clone() };
    wrong(&heated(&longer, &on_edges("x")), "", "other cracks");
    wrong(
        &good.replace("[temperature]\n", "[temperature]\nvalue = 1\n"),
        "",
        "contradicts `problem`",
    );
    wrong("[temperature]\nproblem = \"no.toml\"\n", "", "cannot be read");
    let critical = "[growth]\nsteps = 2\nload = \"critical\"\ntoughness = 1\n";
    wrong(&good, critical, "temperatures");
    wrong(&good, "[exact]\ndisplacement = [0, 0]\n", "exact");
    let held = "[[boundary]]\non = \"top\"\ndisplacement = [0, 0]\n";
    let alpha = format!("expansion = {}", body.alpha);
    for section in [good, temperature("x")] {
        let text = body.text(&(section + held)).replace(&alpha, "expansion = \"1e-3*foo\"");
        let error = Problem::parse(&text, "body.toml", Path::new("")).expect_err("a mistake");
        assert!(error.mistakes().len() == 1 && error.to_string().contains("foo"), "{error}");
    }
}
