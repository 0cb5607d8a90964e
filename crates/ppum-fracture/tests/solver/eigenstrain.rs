//! Temperatures and other given strains: closed forms, and what must hold for any of them.

use crate::studies::support::{parsed, quantity, record, solved};
use ppum::dataset::{Dataset, TipIntensity, WarningKind};
use ppum::decompose::KINDS;
use ppum::progress::unwatched;
use ppum::replace::Replacements;
use ppum::vec2::{Vec2, vec2};
use ppum_fracture::diagnostics::recompute;
use ppum_problem::{Problem, ProblemData};
use ppum_testkit::random::Random;
use std::f64::consts::PI;
use std::path::Path;

pub(super) const STATES: [&str; 2] = ["plane-stress", "plane-strain"];

/// A body [−1, 1]² with a crack, its material, and the rest of a problem.
#[derive(Clone)]
pub(super) struct Body {
    pub(super) young: f64,
    pub(super) poisson: f64,
    pub(super) alpha: f64,
    pub(super) state: &'static str,
    pub(super) crack: [Vec2; 2],
    /// Lengths are this many times as long.
    pub(super) scale: f64,
    pub(super) order: usize,
}

impl Body {
    pub(super) fn random(random: &mut Random, state: &'static str) -> Self {
        let angle = random.between(-1.0, 1.0);
        let (middle, way) = (vec2(random.between(-0.2, 0.2), 0.1), vec2(angle.cos(), angle.sin()));
        let half = random.between(0.25, 0.4);
        Self {
            young: random.between(1.0, 3.0),
            poisson: random.between(0.1, 0.4),
            alpha: random.between(0.5, 2.0),
            state,
            crack: [middle - way * half, middle + way * half],
            scale: 1.0,
            order: 3,
        }
    }

    /// λ + 2μ, λ, and what a temperature of one takes away from σ_xx and σ_yy.
    pub(super) fn moduli(&self) -> [f64; 3] {
        let (e, nu) = (self.young, self.poisson);
        let mu = e / (2.0 * (1.0 + nu));
        let is_stress = self.state == "plane-stress";
        let lambda =
            if is_stress { e * nu / (1.0 - nu * nu) } else { 2.0 * mu * nu / (1.0 - 2.0 * nu) };
        let alpha = if is_stress { self.alpha } else { (1.0 + nu) * self.alpha };
        [lambda + 2.0 * mu, lambda, 2.0 * (lambda + mu) * alpha]
    }

    pub(super) fn problem(&self, rest: &str) -> ProblemData {
        parsed(&self.text(rest))
    }

    pub(super) fn text(&self, rest: &str) -> String {
        let Self { young, poisson, alpha, state, crack: [a, b], scale, order } = self;
        let [a, b] = [*a * *scale, *b * *scale];
        format!(
            "[domain]\nmin = [-{scale}, -{scale}]\nmax = [{scale}, {scale}]\n[material]\nyoung = {young}\n\
             poisson = {poisson}\nstate = \"{state}\"\nexpansion = {alpha}\n[[crack]]\npoints = [[{}, {}], [{}, {}]]\n\
             [discretization]\ncells = [6, 6]\norder = {order}\n{rest}",
            a.x, a.y, b.x, b.y
        )
    }

    pub(super) fn solved(&self, rest: &str) -> Dataset {
        solved(&self.problem(rest))
    }
}

pub(super) fn temperature(text: &str) -> String {
    format!("[temperature]\nvalue = \"{text}\"\n")
}

pub(super) const EDGES: [&str; 4] = ["left", "right", "bottom", "top"];

/// All edges held where a formula says.
fn held(ux: &str) -> String {
    let edge = |on| format!("[[boundary]]\non = \"{on}\"\ndisplacement = [\"{ux}\", 0]\n");
    EDGES.map(edge).concat()
}

/// K_I, K_II, T and √(J E′) of the tips.
pub(super) fn factors(dataset: &Dataset, body: &Body) -> Vec<[f64; 4]> {
    let nu = body.poisson;
    let modulus = body.young / if body.state == "plane-stress" { 1.0 } else { 1.0 - nu * nu };
    let of_tip = |tip: &TipIntensity| {
        let (t, j) = (tip.t_stress.expect("T"), tip.j.expect("J"));
        [tip.k1, tip.k2, t, (modulus * j).max(0.0).sqrt()]
    };
    let all: Vec<_> = dataset.steps[0].intensities.iter().map(of_tip).collect();
    assert_eq!(all.len(), 2);
    all
}

/// The largest differences of K, of T and of √J.
pub(super) fn difference(a: &[[f64; 4]], b: &[[f64; 4]]) -> [f64; 3] {
    let largest = |from: usize, to: usize| {
        let pairs = a.iter().zip(b).flat_map(|(a, b)| a[from..to].iter().zip(&b[from..to]));
        pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    };
    [largest(0, 2), largest(2, 3), largest(3, 4)]
}

pub(super) fn size(factors: &[[f64; 4]]) -> f64 {
    factors.iter().map(|[k1, k2, ..]| k1.hypot(*k2)).fold(0.0, f64::max)
}

pub(super) fn check(what: &str, found: &[f64], bounds: &[f64]) {
    println!("{what}: {found:?}, below {bounds:?}");
    assert!(found.iter().zip(bounds).all(|(found, bound)| found < bound), "{what}: {found:?}");
}

/// Temperatures and other strains that are linear in x and y make no stress in the plane of a free
/// body, cracked or not, and σ_zz = −E ε⁰_zz in plane strain.
#[test]
fn linear_strains_make_no_stress() {
    let mut random = Random(71);
    for state in STATES {
        let body = Body { order: 2, ..Body::random(&mut random, state) };
        let mut linear = || {
            let [a, b, c] = [(); 3].map(|()| random.between(-1.0, 1.0));
            (format!("{a} + ({b})*x + ({c})*y"), move |p: Vec2| a + b * p.x + c * p.y)
        };
        let ((t, at), (xx, _), (xy, _), (zz, at_zz)) = (linear(), linear(), linear(), linear());
        let strain = format!("[strain]\nxx = \"{xx}\"\nxy = \"{xy}\"\nzz = \"{zz}\"\n");
        let dataset = body.solved(&(temperature(&t) + &strain));
        let all = factors(&dataset, &body);
        // J is a square
        let [k, t, root] = difference(&all, &[[0.0; 4]; 2]);
        check(state, &[k, t, root], &[1e-9, 1e-9, 1e-6]);
        let energy = record(&dataset.steps[0], "energy");
        assert!(if state == "plane-stress" { energy < 1e-16 } else { energy > 1e-3 }, "{energy}");
        for _ in 0..20 {
            let p = vec2(random.between(-0.99, 0.99), random.between(-0.99, 0.99));
            for name in ["sxx", "syy", "sxy"] {
                let found = quantity(&dataset, name, p);
                assert!(found.abs() < 1e-9, "{name} {found}");
            }
            let through = if state == "plane-stress" { 0.0 } else { body.alpha * at(p) + at_zz(p) };
            let found = quantity(&dataset, "szz", p);
            assert!((found + body.young * through).abs() < 1e-9, "σ_zz {found}");
            let energy = quantity(&dataset, "energy", p);
            assert!(
                (energy - 0.5 * body.young * through * through).abs() < 1e-9,
                "energy {energy}"
            );
        }
    }
}

/// −E α ΔT/(1 − ν) in plane stress, /(1 − 2ν) in plane strain; the supports press as much.
#[test]
fn held_bodies() {
    let mut random = Random(72);
    for state in STATES {
        let body = Body { order: 2, ..Body::random(&mut random, state) };
        let t = random.between(-2.0, 2.0);
        let rest = format!("{}{}", temperature(&t.to_string()), held("0"));
        let uncracked = body.problem(&rest).with_lines([]);
        let dataset = solved(&uncracked);
        let nu = body.poisson;
        let part = if state == "plane-stress" { 1.0 - nu } else { 1.0 - 2.0 * nu };
        let expected = -body.young * body.alpha * t / part;
        let p = random.point(&dataset.domain.bounds);
        let szz = if state == "plane-stress" { 0.0 } else { expected };
        for (name, value) in [("sxx", expected), ("syy", expected), ("sxy", 0.0), ("szz", szz)] {
            assert!((quantity(&dataset, name, p) - value).abs() < 1e-9, "{name}");
        }
        let reactions = &dataset.steps[0].reactions;
        for (reaction, force) in
            reactions.iter().zip([[-1.0, 0.0], [1.0, 0.0], [0.0, -1.0], [0.0, 1.0]])
        {
            for (found, direction) in reaction.force.iter().zip(force) {
                assert!(
                    (found - 2.0 * expected * direction).abs() < 1e-8,
                    "{reaction:?} {expected}"
                );
            }
        }
        // ½ σ:(ε − ε⁰) times the area, 4
        let alpha_t = body.alpha * t;
        let energy = -0.5 * 4.0 * alpha_t * (2.0 * expected + szz);
        assert!((record(&dataset.steps[0], "energy") / energy - 1.0).abs() < 1e-9);
    }
}

/// T = s x² in a body that is held where an uncracked one would be with u_x = k x³/3, k = β s/(λ +
/// 2μ): there σ_xx = 0 and σ_yy = (λ k − β s) x². K and J are those of faces loaded with that
/// stress, T is less by σ along the crack.
#[test]
fn superposition_of_the_uncracked_body() {
    let mut random = Random(73);
    for state in STATES {
        let body = Body::random(&mut random, state);
        let ([p_wave, lambda, beta], s) = (body.moduli(), random.between(0.5, 1.5));
        let k = beta * s / p_wave;
        let syy = lambda * k - beta * s;
        let heated =
            body.solved(&(temperature(&format!("{s}*x^2")) + &held(&format!("{}*x^3", k / 3.0))));
        let [a, b] = body.crack;
        let left = (b - a).unit().left();
        let face = |name: &str, sign: f64| {
            let load = sign * syy * left.y;
            format!(
                "[[boundary]]\non = {{ crack = 0, face = \"{name}\" }}\ntraction = [0, \"{load}*x^2\"]\n"
            )
        };
        let loaded = body.solved(&(held("0") + &face("above", 1.0) + &face("below", -1.0)));
        let (heated_factors, mut expected) = (factors(&heated, &body), factors(&loaded, &body));
        for (tip, factors) in heated.steps[0].intensities.iter().zip(&mut expected) {
            let at = heated.steps[0].cracks[0].end_point(tip.tip.end);
            factors[2] += syy * at.x * at.x * left.x * left.x;
        }
        let k = size(&expected);
        let found = difference(&heated_factors, &expected).map(|d| d / k);
        check(state, &found, &[1e-6, 1e-5, 1e-4]);
        let (tips, _) = recompute(&heated, 0, None, unwatched()).expect("a step");
        let again: Vec<_> = tips.into_iter().filter_map(|tip| tip.factors).collect();
        assert_eq!(again.len(), 2);
        for (known, again) in heated.steps[0].intensities.iter().zip(again) {
            assert_eq!(TipIntensity { error: None, ..known.clone() }, again);
        }
    }
}

/// A cracked body under a temperature that no closed form is known of, and under a load.
pub(super) const WAVES: &str = "sin(2*x + y) + 0.5*cos(3*y - x)";

/// Loads and temperatures add up; a body n times as large has √n times K; that of a crack whose
/// points are listed backwards is the same, and so is that of a body turned by a right angle.
#[test]
fn symmetries_of_the_equations() {
    let mut random = Random(74);
    let body = Body::random(&mut random, STATES[1]);
    let top = |load: f64| {
        let edge = |on, sign: f64| {
            format!("[[boundary]]\non = \"{on}\"\ntraction = [0, {}]\n", sign * load)
        };
        edge("top", 1.0) + &edge("bottom", -1.0)
    };
    let of = |body: &Body, rest: &str| factors(&body.solved(rest), body);
    let (heated, loaded) = (of(&body, &temperature(WAVES)), of(&body, &top(0.7)));
    let k = size(&heated);
    let compare = |what: &str, found: &[[f64; 4]], expected: &[[f64; 4]]| {
        check(what, &difference(found, expected).map(|d| d / k), &[1e-8, 1e-7, 1e-7]);
    };
    let mut sum = of(&body, &(temperature(WAVES) + &top(0.7)));
    let mut expected = heated.clone();
    for (tip, (sum, loaded)) in expected.iter_mut().zip(sum.iter_mut().zip(&loaded)) {
        (0..3).for_each(|k| tip[k] += loaded[k]);
        // J is that of K
        let found = sum[0].hypot(sum[1]);
        assert!((sum[3] / found - 1.0).abs() < 1e-4, "{sum:?}");
        (tip[3], sum[3]) = (0.0, 0.0);
    }
    compare("sum", &sum, &expected);

    let large = Body { scale: 4.0, ..body.clone() };
    let wide = WAVES.replace('x', "(x/4)").replace('y', "(y/4)");
    let found = of(&large, &temperature(&wide)).into_iter();
    let found: Vec<_> = found.map(|[a, b, t, j]| [a / 2.0, b / 2.0, t, j / 2.0]).collect();
    compare("scale", &found, &heated);

    let [a, b] = body.crack;
    let mut found = of(&Body { crack: [b, a], ..body.clone() }, &temperature(WAVES));
    found.reverse();
    compare("reversed", &found, &heated);

    let turned = Body { crack: [a.left(), b.left()], ..body.clone() };
    let text = WAVES.replace('x', "X").replace('y', "(-x)").replace('X', "y");
    compare("turned", &of(&turned, &temperature(&text)), &heated);
}

/// An insulated crack in a steady flux of heat: |K_II| = E α h √π a^(3/2)/4, and /(1 − ν) in plane
/// strain (Florence & Goodier 1960). The temperature jumps across the crack.
#[test]
fn insulated_cracks() {
    for (state, part) in [(STATES[0], 1.0), (STATES[1], 0.7)] {
        let (a, h) = (0.05, 2.0);
        let crack = [vec2(-a, 0.0), vec2(a, 0.0)];
        let body =
            Body { young: 3.0, poisson: 0.3, alpha: 0.5, state, crack, scale: 1.0, order: 3 };
        let flux = format!(
            "{h}*sqrt(hypot(x - {a}, y)*hypot(x + {a}, y))*sin((atan2(y, x - {a}) + atan2(y, x + {a}))/2)"
        );
        let expected = body.young * body.alpha * h * PI.sqrt() * a.powf(1.5) / 4.0 / part;
        for [k1, k2, _, j] in factors(&body.solved(&temperature(&flux)), &body) {
            let found = [
                k1.abs() / expected,
                (k2.abs() / expected - 1.0).abs(),
                (j / expected - 1.0).abs(),
            ];
            check(state, &found, &[1e-6, 1e-2, 1e-2]);
        }
    }
}

/// A line across which α jumps crosses a crack: K of orders 4 and 6 agree, and the estimate of
/// order 4 tells by how much.
#[test]
fn strains_that_jump_across_a_crack() {
    let found = [4, 6].map(|order| {
        let crack = [vec2(-0.4, 0.05), vec2(0.3, -0.1)];
        let (young, poisson, scale, state) = (1.0, 0.3, 1.0, STATES[0]);
        let body = Body { young, poisson, alpha: 1.5, state, crack, scale, order };
        let text = body.text(&temperature("1"));
        let jump = "expansion = \"if(x + 0.3*y > -0.06, 1.5, 0.5)\"";
        solved(&parsed(&text.replace("expansion = 1.5", jump)))
    });
    let [coarse, fine] = found.each_ref().map(|dataset| &dataset.steps[0].intensities);
    let size = fine.iter().map(|tip| tip.k1.hypot(tip.k2)).fold(0.0, f64::max);
    for (a, b) in coarse.iter().zip(fine) {
        let (off, told) = ((a.k1 - b.k1).hypot(a.k2 - b.k2), a.error.expect("an estimate"));
        println!("{size} {off:.1e} {told:.1e}");
        assert!(off < 3.0 * told && told < 0.02 * size, "{off} {told}");
    }
}

/// Strains that cannot be integrated are told with their place, and those that can are not.
#[test]
fn strains_with_poles() {
    let body = Body { order: 2, ..Body::random(&mut Random(76), STATES[1]) };
    let of = |text: &str| {
        let dataset = body.solved(&temperature(text));
        let all = dataset.steps[0].warnings.iter();
        all.filter(|w| w.kind == WarningKind::Load).cloned().collect::<Vec<_>>()
    };
    let at = vec2(0.51, -0.62);
    let r = format!("hypot(x - {}, y + {})", at.x, -at.y);
    for exponent in [1.5, 1.9] {
        let text = format!("{r}^(-{exponent})");
        let found = of(&text);
        assert_eq!(found.len(), 1, "{text}: {found:?}");
        println!("{}", found[0].message);
        let place = found[0].at.expect("a place");
        assert!((place - at).length() < 0.05, "{place:?}");
        assert!(found[0].message.starts_with("a given strain "), "{}", found[0].message);
    }
    for text in [WAVES.to_owned(), format!("if({r} < 0.2, 1, 2)"), format!("sqrt({r})")] {
        assert!(of(&text).is_empty(), "{text}: {:?}", of(&text));
    }
}

/// Stresses of the parts of a field add up to those of the whole: the given strains belong to the
/// smooth part. A temperature that is solved for has parts itself.
#[test]
fn stresses_of_parts() {
    let mut random = Random(77);
    let body = Body { order: 2, ..Body::random(&mut random, STATES[1]) };
    let given = "[strain]\nxy = \"0.3*y\"\nzz = 0.4\n";
    let heat = super::heat::heated(&body, &super::heat::on_edges("1 + x*y"));
    for rest in [temperature(WAVES) + given, heat + given] {
        let whole = body.solved(&rest);
        let parts = KINDS.map(|part| {
            let mut dataset = whole.clone();
            let part = Some(part);
            let taken = Replacements { part, ..Replacements::default() }.apply(&mut dataset, 0);
            taken.ok().map(|()| dataset)
        });
        let parts: Vec<Dataset> = parts.into_iter().flatten().collect();
        assert!(parts.len() >= 3, "{}", parts.len());
        for _ in 0..20 {
            let p = random.point(&whole.domain.bounds);
            for name in ["sxx", "syy", "sxy", "szz", "eigenstrain_xx"] {
                let values = parts.iter().map(|part| quantity(part, name, p));
                let (sum, size) =
                    values.fold((0.0, 0.0), |(sum, size), v| (sum + v, size + f64::abs(v)));
                let expected = quantity(&whole, name, p);
                // some hundred operations with terms of the sizes of the parts
                assert!((sum - expected).abs() <= 1e-11 * size, "{name} {sum} {expected}");
            }
        }
    }
}

/// What has no meaning is refused, with its place.
#[test]
fn refused_strains() {
    let body = Body::random(&mut Random(75), STATES[0]);
    let wrong = |rest: &str, expansion: &str, needed: &str| {
        let text = body.problem(&temperature("x")).text.expect("a text");
        let text = text.replace("[temperature]\nvalue = \"x\"\n", rest);
        let alpha = format!("expansion = {}\n", body.alpha);
        let text = text.replace(&alpha, expansion);
        let error = Problem::parse(&text, "body.toml", Path::new("")).expect_err("a mistake");
        assert!(error.to_string().contains(needed), "{error}");
    };
    let some = "expansion = 1\n";
    wrong(&temperature("1/(x - x)"), some, "must be finite");
    wrong(&temperature("x"), "", "`expansion` is missing");
    wrong("[temperature]\n", some, "`value` is missing");
    wrong("[strain]\nxx = \"log(x - 2)\"\n", some, "must be finite");
    let critical = "[growth]\nsteps = 2\nload = \"critical\"\ntoughness = 1\n";
    wrong(&(temperature("x") + critical), some, "temperatures");
}
