//! All pairs of features: those that are excluded are refused with place and remedy, the others go
//! together, and with one of them made small the other is left alone.

use crate::studies::support::{checked, parsed};
use Feature as F;
use ppum::progress::unwatched;
use ppum_fracture::solve::solve;
use ppum_problem::{Feature, Problem, ProblemLocation};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The features of plates here; of oblique sides see `sides`.
const ALL: [Feature; 28] = [
    F::Potential,
    F::VaryingMaterial,
    F::Anisotropic,
    F::Axisymmetric,
    F::GivenStrains,
    F::GivenShear,
    F::SolvedTemperature,
    F::ExactSolution,
    F::Contact,
    F::Forces,
    F::PartialModel,
    F::SlidingPart,
    F::UserFunctions,
    F::OtherTipFunctions,
    F::NoJumps,
    F::NoZones,
    F::TipTerms,
    F::EnrichmentRadius,
    F::Accuracy,
    F::KeptSteps,
    F::Multilevel,
    F::Growth,
    F::CriticalLoad,
    F::NoToughness,
    F::GrowthLaw,
    F::ToughnessRate,
    F::OpeningRate,
    F::NoClosure,
];

/// What a feature cannot be without.
fn implied(feature: Feature) -> &'static [Feature] {
    match feature {
        F::GivenShear | F::SolvedTemperature => &[F::GivenStrains],
        F::SlidingPart => &[F::PartialModel],
        F::NoJumps => &[F::OtherTipFunctions, F::NoZones],
        F::NoZones => &[F::OtherTipFunctions],
        F::CriticalLoad | F::NoToughness | F::GrowthLaw | F::NoClosure => &[F::Growth],
        F::ToughnessRate | F::OpeningRate => &[F::Growth, F::GrowthLaw],
        _ => &[],
    }
}

/// The radius at which a body of revolution begins: large, and the body nearly plane, if the
/// feature is small.
fn inner_radius(features: &BTreeMap<Feature, f64>) -> f64 {
    features.get(&F::Axisymmetric).map_or(0.0, |size| (0.1 / size).min(1e4))
}

/// A cracked plate under tension with some features; the size of those that have one is given.
fn plate(features: &BTreeMap<Feature, f64>) -> String {
    let has = |feature| features.contains_key(&feature);
    let size = |feature| features.get(&feature).copied().unwrap_or(0.0);
    let (part, slides) = (has(F::PartialModel) || has(F::SlidingPart), has(F::SlidingPart));
    let low = if part { 0.0 } else { -1.0 };
    let left = inner_radius(features);
    let body = format!("domain = {{ min = [{left}, {low}], max = [{}, 1] }}\n", left + 1.0);
    let crack = format!("points = [[{left}, 0], [{}, 0]]", left + 0.5);
    let (state, round) = match has(F::Axisymmetric) {
        true => ("axisymmetric", ", axisymmetric = true"),
        false => ("plane-strain", ""),
    };
    let touches = if has(F::Contact) { ", contact = true" } else { "" };
    let mut all = body.clone() + &format!("crack = [{{ {crack}{touches} }}]\n");
    let on = |edge: &str, what: &str| format!("[[boundary]]\non = \"{edge}\"\n{what}\n");
    let mut rest = match (has(F::Potential), part, slides) {
        (true, ..) => on("top", "value = 1") + &on("bottom", "value = 0"),
        (_, false, _) => on("top", "traction = [0, 1]") + &on("bottom", "traction = [0, -1]"),
        (.., false) => on("top", "traction = [0, 1]") + &on("bottom", "symmetry = true"),
        (.., true) => {
            let sheared = [("top", "[1, 0]"), ("right", "[0, 1]"), ("left", "[0, -1]")];
            let load = |(edge, t): (&str, &str)| on(edge, &format!("traction = {t}"));
            sheared.map(load).concat() + &on("bottom", "antisymmetry = true")
        }
    };
    let expansion = match has(F::SolvedTemperature) {
        true => format!(", expansion = {}", size(F::SolvedTemperature)),
        false => String::new(),
    };
    let modulus = |factor: f64| match has(F::VaryingMaterial) {
        true => format!("\"{factor:?}*(1 + {}*(x - {left}))\"", size(F::VaryingMaterial)),
        false => format!("{factor:?}"),
    };
    let young = modulus(1.0);
    all += &match has(F::Potential) {
        false if has(F::Anisotropic) => format!(
            "material = {{ young = [{young}, {}, {young}], poisson = [0.3, 0.3, 0.3], shear = {}, \
             state = \"{state}\"{expansion} }}\n",
            modulus(1.0 + size(F::Anisotropic)),
            modulus(1.0 / 2.6)
        ),
        true => format!("equation = {{ kind = \"poisson\"{round} }}\n"),
        false => format!(
            "material = {{ young = {young}, poisson = 0.3, state = \"{state}\"{expansion} }}\n"
        ),
    };
    if has(F::GivenStrains) || has(F::GivenShear) {
        let [a, b] = [size(F::GivenStrains), size(F::GivenShear)];
        let shear =
            if has(F::GivenShear) { format!("xy = \"{b}*(x - {left})\"\n") } else { String::new() };
        rest += &format!("[strain]\nxx = \"{a}*(x - {left})^2 + {a}\"\n{shear}");
    }
    if has(F::SolvedTemperature) {
        rest += &format!(
            "[temperature]\nproblem = '''\n{body}equation = {{ kind = \"poisson\"{round} }}\n\
             crack = [{{ {crack} }}]\n{}{}'''\n",
            on("top", "value = 1"),
            on("bottom", "value = 0") + "[discretization]\nlevel = 3\n"
        );
    }
    if has(F::ExactSolution) {
        rest += if has(F::Potential) {
            "[exact]\nvalue = 0\n"
        } else {
            "[exact]\ndisplacement = [0, 0]\n"
        };
    }
    if has(F::Forces) {
        let force =
            |x: f64, f: f64| format!("[[force]]\nat = [{}, 0.6]\nvalue = [{f}, 0]\n", left + x);
        rest += &(force(0.3, size(F::Forces)) + &force(0.7, -size(F::Forces)));
    }
    if has(F::UserFunctions) {
        rest += &format!(
            "[[enrichment]]\nfunction = \"exp(x - {left})\"\nat = [{}, 0.6]\nradius = 0.2\n",
            left + 0.5
        );
    }
    all + &rest + &settings(features, part)
}

/// The tables of discretisation, adaptation, solver and growth.
fn settings(features: &BTreeMap<Feature, f64>, part: bool) -> String {
    let has = |feature| features.contains_key(&feature);
    let mut rest = String::new();
    let mut set = vec![format!("cells = [6, {}]", if part { 6 } else { 12 })];
    set.extend(match () {
        () if has(F::NoJumps) => Some("enrichment = \"none\"".to_owned()),
        () if has(F::NoZones) => Some("enrichment = \"jumps\"".to_owned()),
        () if has(F::OtherTipFunctions) => Some("enrichment = \"zone\"".to_owned()),
        () => None,
    });
    set.extend(has(F::TipTerms).then(|| "tip_terms = 3".to_owned()));
    set.extend(has(F::EnrichmentRadius).then(|| "enrichment_radius = 0.2".to_owned()));
    set.extend(has(F::Accuracy).then(|| "accuracy = 0.05".to_owned()));
    rest += &format!("[discretization]\n{}\n", set.join("\n"));
    if has(F::KeptSteps) {
        rest += "[adaptivity]\nsteps = 1\nkeep = \"all\"\n";
    }
    if has(F::Multilevel) {
        rest += "[solver]\nkind = \"multilevel\"\n";
    }
    if features
        .keys()
        .any(|feature| *feature == F::Growth || implied(*feature).contains(&F::Growth))
    {
        let toughness = if has(F::NoToughness) { "" } else { "toughness = 10\n" };
        let critical = if has(F::CriticalLoad) { "load = \"critical\"\n" } else { "" };
        let law = match (has(F::ToughnessRate), has(F::OpeningRate)) {
            (false, false) if has(F::GrowthLaw) => "paris = { c = 1, m = 2 }\n",
            (false, false) => "",
            (true, false) => "forman = { c = 1, m = 2 }\n",
            (false, true) => "rate = \"opening*dk\"\n",
            (true, true) => "nasgro = { c = 1, m = 2 }\n",
        };
        let is_known = has(F::OpeningRate) && !has(F::NoClosure);
        let closure = if is_known { "closure = { alpha = 2, stress = 0.3 }\n" } else { "" };
        rest +=
            &format!("[growth]\nsteps = 1\nincrement = 0.1\n{toughness}{critical}{law}{closure}");
    }
    rest
}

/// All features of a plate with some.
fn closure(features: &[Feature]) -> BTreeSet<Feature> {
    features.iter().flat_map(|f| implied(*f).iter().copied().chain([*f])).collect()
}

fn pairs() -> impl Iterator<Item = [Feature; 2]> {
    (0..ALL.len()).flat_map(|k| (0..k).map(move |l| [ALL[l], ALL[k]]))
}

/// True if a plate with some features may be.
fn is_allowed(features: &[Feature]) -> bool {
    let all = closure(features);
    // the only crack has one face where it lies on the border
    if [F::Contact, F::PartialModel].iter().all(|feature| all.contains(feature)) {
        return false;
    }
    !all.iter().any(|a| all.iter().any(|b| a.excludes(*b)))
}

/// Pairs of which the second is about something that a potential has not.
fn has_meaning(pair: &[Feature; 2]) -> bool {
    let elastic = [
        F::VaryingMaterial,
        F::Anisotropic,
        F::GivenStrains,
        F::GivenShear,
        F::SolvedTemperature,
        F::PartialModel,
        F::SlidingPart,
    ];
    pair[0] != F::Potential || !elastic.contains(&pair[1])
}

#[test]
fn excluded_pairs_are_refused() {
    let mut refused = 0;
    for pair in pairs().filter(has_meaning) {
        let text = plate(&pair.into_iter().map(|feature| (feature, 0.1)).collect());
        match Problem::parse(&text, "plate.toml", Path::new("")) {
            Ok(problem) => {
                assert!(is_allowed(&pair), "{pair:?} is not refused\n{text}");
                let found: BTreeSet<Feature> = problem.features().into_iter().collect();
                assert!(closure(&pair).is_subset(&found), "{pair:?}: {found:?}\n{text}");
            }
            Err(error) => {
                assert!(!is_allowed(&pair), "{pair:?} is refused: {error}\n{text}");
                for mistake in error.mistakes() {
                    assert!(
                        matches!(mistake.location, ProblemLocation::Text { .. }),
                        "{mistake:?}"
                    );
                    assert!(mistake.message.contains("; "), "{mistake:?}");
                }
                refused += 1;
            }
        }
    }
    assert!(refused > 30, "{refused} pairs are refused");
}

/// How far the factors may move if a feature is made small: none of the plate's own, what the next
/// larger discretisation changes, or nothing for what is small itself.
fn tolerance(feature: Feature) -> f64 {
    match feature {
        F::GivenStrains | F::GivenShear | F::SolvedTemperature => 1e-8,
        F::Forces | F::Multilevel => 1e-6,
        F::Axisymmetric => 1e-4,
        // faces of tips without series overlap by what their cells leave
        F::Contact => 1e-4,
        F::Growth | F::CriticalLoad | F::NoToughness | F::ExactSolution => 1e-12,
        F::GrowthLaw | F::ToughnessRate | F::OpeningRate | F::NoClosure => 1e-12,
        // other functions of the space: where the material varies, tips have no series
        _ => 5e-3,
    }
}

/// (K_I, K_II) of the tip.
fn factors(features: &BTreeMap<Feature, f64>) -> [f64; 2] {
    let text = plate(features);
    let dataset = solve(&checked(&parsed(&text)), unwatched());
    let dataset = dataset.unwrap_or_else(|error| panic!("{features:?}: {error}\n{text}"));
    let step = dataset.steps.last().expect("a step");
    let [tip] = step.intensities.as_slice() else { panic!("{features:?}: one tip\n{text}") };
    [tip.k1, tip.k2]
}

#[test]
#[ignore = "slow: solves two hundred plates"]
fn allowed_pairs_have_their_limits() {
    const SMALL: f64 = 1e-9;
    // these leave no field with factors, or another one
    let has_factors =
        |f: &Feature| ![F::Potential, F::NoJumps, F::NoZones, F::SlidingPart].contains(f);
    let (mut compared, mut alone) = (0, BTreeMap::new());
    for pair in pairs().filter(|pair| is_allowed(pair) && pair.iter().all(has_factors)) {
        for [small, other] in [pair, [pair[1], pair[0]]] {
            let both = factors(&[(small, SMALL), (other, 0.1)].into());
            let own = *alone.entry(other).or_insert_with(|| factors(&[(other, 0.1)].into()));
            let size = own[0].hypot(own[1]);
            let apart = (both[0] - own[0]).hypot(both[1] - own[1]) / size;
            println!("{small:?}, {other:?}: {apart:.1e}");
            assert!(apart <= tolerance(small), "{small:?} beside {other:?}: {both:?} {own:?}");
            compared += 1;
        }
    }
    assert!(compared > 150, "{compared} limits");
}
