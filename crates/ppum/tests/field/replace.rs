//! A function replaced is the function a dataset would have had from the start.

use crate::support::{compiled, evaluate};
use ppum::crack::Side;
use ppum::dataset::Dataset;
use ppum::decompose::{FieldPart, PartError};
use ppum::function::{Frame, FunctionKind};
use ppum::replace::{ReplaceError, Replacements, ReplacementsError};
use ppum::weight::WeightFunction;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::Recipe;

/// The same at random points of the domain, to the last bit.
fn assert_same(a: &Dataset, b: &Dataset) {
    assert_eq!(a.check(), Ok(()));
    let (mut random, domain) = (Random(11), a.domain.bounds);
    let (a, b) = (compiled(a), compiled(b));
    for _ in 0..50 {
        let at = random.point(&domain);
        let [u, v] =
            [&a, &b].map(|f| evaluate::<1>(&mut f.at(at), Default::default(), Side::Above));
        assert_eq!(u, v, "{at:?}");
    }
}

fn recipe(functions: [&str; 4]) -> Recipe {
    Recipe { tip_functions: functions.map(str::to_owned), ..Recipe::random(4) }
}

#[test]
fn functions_at_all_their_places() {
    let mut dataset = recipe(["r", "x", "y", "x*y"]).dataset();
    let step = &mut dataset.steps[0];
    let called = step.functions_called("x");
    assert!(called.len() > 1, "{called:?}");
    assert_eq!(step.replace_function("x", "sqrt(r)*cos(theta/2)", &[]), Ok(called));
    let wanted = recipe(["r", "sqrt(r)*cos(theta/2)", "y", "x*y"]).dataset();
    assert_same(&dataset, &wanted);
}

#[test]
fn one_function_by_its_number_or_whole_name() {
    let original = recipe(["r", "x", "y", "x*y"]).dataset();
    let index = original.steps[0].functions_called("y")[0];
    let name = original.steps[0].functions[index].name.clone();
    let replaced = |which: &str| {
        let mut dataset = original.clone();
        assert_eq!(dataset.steps[0].replace_function(which, "2*y", &[]), Ok(vec![index]));
        dataset
    };
    let mut wanted = original.clone();
    let kind = &mut wanted.steps[0].functions[index].kind;
    let FunctionKind::Formula { text, .. } = kind else { panic!("a formula") };
    *text = "2*y".into();
    assert_same(&replaced(&name), &wanted);
    assert_same(&replaced(&index.to_string()), &wanted);
}

/// Function 0 is 1; as a formula it is still 1.
#[test]
fn functions_that_were_no_formulas() {
    let original = recipe(["r", "x", "y", "x*y"]).dataset();
    let mut dataset = original.clone();
    assert_eq!(dataset.steps[0].replace_function("one", "x/x", &[]), Ok(vec![0]));
    assert_same(&dataset, &original);
}

/// The functions of all patches' components have one name, and each has its own; a formula in their
/// place is one of the world.
#[test]
fn functions_of_components() {
    let original = Recipe::meeting().dataset();
    let functions = &original.steps[0].functions;
    let of = |name: &str| original.steps[0].functions_called(name);
    let is_first = |k: &usize| functions[*k].name.starts_with("component 1 of patch ");
    let all: Vec<_> = (0..functions.len()).filter(is_first).collect();
    assert!(all.len() > 15 && of("component 1") == all, "{} patches", all.len());
    assert_eq!(of(&functions[all[3]].name), [all[3]]);
    let mut dataset = original.clone();
    assert_eq!(dataset.steps[0].replace_function("component 1", "x*y", &[]), Ok(all.clone()));
    let mut wanted = original.clone();
    all.iter().for_each(|&k| {
        wanted.steps[0].functions[k].kind = FunctionKind::formula("x*y", Frame::World);
    });
    assert_same(&dataset, &wanted);
}

#[test]
fn weights() {
    let linear = Recipe { weight: WeightFunction::Linear, ..Recipe::random(4) };
    let with = |text: &str| {
        let mut dataset = linear.dataset();
        dataset.steps[0].replace_weight(text, &[]).expect("a weight");
        dataset
    };
    let cubic = Recipe { weight: WeightFunction::Cubic, ..linear.clone() }.dataset();
    assert_same(&with("cubic"), &cubic);
    assert_eq!(with(" 1 - t^2 ").steps[0].partition.boxes().weight.name(), "formula");
    let mut dataset = linear.dataset();
    let error = dataset.steps[0].replace_weight("2 - t", &[]).expect_err("1 at t = 1");
    assert!(matches!(error, ReplaceError::Weight(_)), "{error}");
    assert_eq!(dataset, linear.dataset());
}

#[test]
fn what_is_wrong_changes_nothing() {
    let original = recipe(["r", "x", "y", "x*y"]).dataset();
    let mut dataset = original.clone();
    let step = &mut dataset.steps[0];
    let n = step.functions.len().to_string();
    for which in ["z", "", "-1", n.as_str()] {
        let error = step.replace_function(which, "x", &[]).expect_err("no such function");
        assert!(error.to_string().contains("`x*y`"), "{error}");
    }
    let error = step.replace_function("x", "x + thet", &[]).expect_err("an unknown name");
    assert!(error.to_string().contains("^^^^"), "{error}");
    assert_eq!(dataset, original);
}

/// Parts are told apart by the functions of the dataset: a jump stays one whatever takes its place.
#[test]
fn all_changes_at_once() {
    let original = recipe(["r", "x", "y", "x*y"]).dataset();
    let replacements = Replacements {
        part: Some(FieldPart::Tip),
        functions: vec![("x".into(), "r^2".into()), ("y".into(), "r^3".into())],
        weight: Some("bump".into()),
    };
    let (mut all, mut one_by_one) = (original.clone(), original.clone());
    assert_eq!(replacements.apply(&mut all, 0), Ok(()));
    let step = &mut one_by_one.steps[0];
    step.fields[0] = step.fields[0].part(FieldPart::Tip, &step.functions).expect("it has tips");
    assert!(step.replace_function("x", "r^2", &[]).is_ok());
    assert!(step.replace_function("y", "r^3", &[]).is_ok());
    assert_eq!(step.replace_weight("bump", &[]), Ok(()));
    assert_same(&all, &one_by_one);
    let mut untouched = original.clone();
    assert_eq!(replacements.apply(&mut untouched, 1), Ok(()), "no such step");
    assert_same(&untouched, &original);
}

#[test]
fn errors_say_which_change() {
    let mut dataset = recipe(["r", "x", "y", "x*y"]).dataset();
    let mut failing = |replacements: &Replacements| {
        replacements.apply(&mut dataset, 0).expect_err("it cannot be made")
    };
    let part = Replacements { part: Some(FieldPart::Patch(9999)), ..Replacements::default() };
    let error = failing(&part);
    assert!(matches!(error, ReplacementsError::Part(PartError::NoPatch { .. })), "{error}");
    let functions = vec![("x".into(), "r".into()), ("no".into(), "r".into())];
    let error = failing(&Replacements { functions, ..Replacements::default() });
    let ReplacementsError::Function { index: 1, which, .. } = &error else { panic!("{error}") };
    assert_eq!(which, "no");
    let error = failing(&Replacements { weight: Some("x +".into()), ..Replacements::default() });
    assert!(matches!(error, ReplacementsError::Weight(_)), "{error}");
}
