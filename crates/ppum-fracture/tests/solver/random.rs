//! Random problems with default settings against an independent reference solver: 40 of the 200 of
//! `tests/random`, spread over its kinds. Wrong numbers without a warning are failures.

use std::path::{Path, PathBuf};

use ppum::dataset::{Dataset, Step, TipIntensity, Warning, WarningKind};
use ppum::segment;
use ppum::vec2::Vec2;
use ppum_problem::{Problem, ProblemData};
use serde_json::Value;

use crate::studies::support::solved;

/// Errors that default settings promise to stay below. The reference knows K to 5e-4 and energies
/// to 1e-4, mostly far better.
const K: f64 = 5e-3;
const ENERGY: f64 = 1e-3;

/// Smaller K than this part of the problem's scale of K, the strongest tip's or σ √(πa), are
/// measured against it.
const WEAK: f64 = 0.2;

/// An estimate of an error is of the right size within this factor, either way.
const FACTOR: f64 = 10.0;

/// A warning's place is where something is within this part of the plate's longer side, about two
/// of its cells.
const NEAR: f64 = 0.15;

/// Warnings whose numbers are no errors, but lengths, ratios and differences.
const NO_ESTIMATES: [WarningKind; 12] = [
    WarningKind::FacesOverlap,
    WarningKind::NegativeK1,
    WarningKind::NoRoom,
    WarningKind::LittleRoom,
    WarningKind::Spread,
    WarningKind::TipNearBorder,
    WarningKind::Coarse,
    WarningKind::Imbalance,
    WarningKind::Residual,
    WarningKind::CutOff,
    WarningKind::Nitsche,
    WarningKind::CrossedTwice,
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../tests/random")
}

/// The reference's values, by the number of the problem.
fn values() -> Value {
    let text = std::fs::read_to_string(folder().join("values.json")).expect("the values");
    let mut all: Value = serde_json::from_str(&text).expect("JSON");
    all["problems"].take()
}

/// The files kept, in order.
fn files() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder()).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    let mut files: Vec<_> = paths.filter(|p| p.extension().is_some_and(|e| e == "toml")).collect();
    files.sort();
    files
}

/// The number of the problem of a file.
fn number_of(file: &Path) -> String {
    file.file_stem().expect("a name").to_string_lossy().into_owned()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or(f64::NAN)
}

/// An error, infinite if it is not a number.
fn known_error(error: f64) -> f64 {
    if error.is_nan() { f64::INFINITY } else { error }
}

/// |ΔK| / |K| with K = (K_I, K_II); weak tips are measured against a part of the problem's scale of
/// K, that of its strongest tip or σ √(πa). Infinite for a tip without factors.
fn error_of_k(tips: &[TipIntensity], known: &Value, scale: f64) -> f64 {
    let is_it =
        |t: &&TipIntensity| known["crack"] == t.tip.crack && known["end"] == t.tip.end.name();
    let [k1, k2] = ["k1", "k2"].map(|name| number(&known[name]));
    let size = k1.hypot(k2).max(WEAK * scale);
    let error = |t: &TipIntensity| (t.k1 - k1).hypot(t.k2 - k2) / size;
    tips.iter().find(is_it).map_or(f64::INFINITY, |tip| known_error(error(tip)))
}

/// The errors of K at the worst tip and of the energy.
fn errors(step: &Step, known: &Value) -> [f64; 2] {
    let scale = known["k_scale"].as_f64().unwrap_or(0.0);
    let tips = known["tips"].as_array().expect("tips");
    let k = tips.iter().map(|tip| error_of_k(&step.intensities, tip, scale)).fold(0.0, f64::max);
    let energy = step.history.iter().find(|r| r.name == "energy").expect("an energy").value;
    [k, known_error((energy / number(&known["energy"]) - 1.0).abs())]
}

/// Distance of a point to the nearest crack, rim or edge.
fn distance_to_anything(problem: &ProblemData, p: Vec2) -> f64 {
    let bounds = problem.domain().bounds;
    let edges = [p - bounds.min, bounds.max - p].into_iter().flat_map(|d| [d.x.abs(), d.y.abs()]);
    let rims = problem.domain().holes.iter().map(|hole| hole.rim_distance(p));
    let parts = problem.cracks().iter().flat_map(|crack| crack.points.windows(2));
    let cracks = parts.map(|ends| segment::distance([ends[0], ends[1]], p));
    edges.chain(rims).chain(cracks).fold(f64::INFINITY, f64::min)
}

/// Whether a warning is about an error, and where something is; an interface of materials may
/// be anywhere.
fn names_a_place(problem: &ProblemData, warning: &Warning) -> bool {
    let Some(at) = warning.at else { return false };
    let size = problem.domain().bounds.max - problem.domain().bounds.min;
    let two_materials = problem.text.as_deref().is_some_and(|text| text.contains("if("));
    !NO_ESTIMATES.contains(&warning.kind)
        && (two_materials || distance_to_anything(problem, at) < NEAR * size.x.max(size.y))
}

/// The silent errors of a solution, in words.
fn complaint(problem: &ProblemData, dataset: &Dataset, known: &Value) -> Option<String> {
    let step = &dataset.steps[0];
    let [k, energy] = errors(step, known);
    let worst = [(k, K), (energy, ENERGY)].into_iter().filter(|(error, limit)| error > limit);
    let worst = worst.map(|(error, _)| error).fold(0.0, f64::max);
    let fits = |w: &Warning| w.value >= worst / FACTOR && w.value <= worst * FACTOR;
    let warned = step.warnings.iter().any(|w| names_a_place(problem, w) && fits(w));
    let kinds: Vec<_> = step.warnings.iter().map(|w| (&w.kind, w.value)).collect();
    let words = format!("{}: K off by {k:.1e}, energy by {energy:.1e}, {kinds:?}", problem.title);
    println!("{words}");
    (worst > 0.0 && !warned).then_some(words)
}

/// Asserts that the problems whose numbers pass a filter have K within 0.5 %, energies within 0.1
/// %, or a warning with a place and an error of the right size.
fn assert_right_or_warned(is_wanted: impl Fn(&str) -> bool) {
    let values = values();
    let silent: Vec<String> = files()
        .iter()
        .filter_map(|file| {
            let name = number_of(file);
            let problem = is_wanted(&name).then(|| Problem::read(file).expect("in order"))?;
            complaint(&problem, &solved(&problem), &values[&name])
        })
        .collect();
    assert!(silent.is_empty(), "{} problems:\n{}", silent.len(), silent.join("\n"));
}

/// Problems of different kinds that are solved quickly: a kinked edge crack, a potential, held
/// pieces, a potential around a hole, pressure and traction on faces.
const QUICK: [&str; 6] = ["032", "052", "127", "134", "151", "152"];

/// Second problems of a kind that take long.
const SECOND: [&str; 7] = ["076", "083", "088", "143", "150", "153", "175"];

#[test]
fn right_or_said_to_be_wrong() {
    assert_right_or_warned(|name| QUICK.contains(&name));
}

#[test]
#[ignore = "slow: 27 plates with holes, gradings and sharp kinks"]
fn all_kinds_are_right_or_said_to_be_wrong() {
    assert_right_or_warned(|name| !QUICK.contains(&name) && !SECOND.contains(&name));
}

#[test]
#[ignore = "slow: seven more of these plates, run by hand"]
fn by_hand_second_problems_of_a_kind_are_right_or_said_to_be_wrong() {
    assert_right_or_warned(|name| SECOND.contains(&name));
}

/// Forty files, all with values, and values for two hundred problems.
#[test]
fn all_are_there() {
    let (files, values) = (files(), values());
    let has_value = |file: &PathBuf| number(&values[&number_of(file)]["energy"]) > 0.0;
    assert_eq!(files.len(), 40);
    assert!(files.iter().all(has_value));
    assert_eq!(values.as_object().map(serde_json::Map::len), Some(200));
}
