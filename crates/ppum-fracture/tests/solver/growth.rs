//! Cracks that grow: kinks, paths, what they meet, loads and cycles, and series that
//! are interrupted.

use crate::studies::support::{checked, parsed};
use ppum::crack::{CrackEnd, End, TipId};
use ppum::dataset::{Dataset, GrowthStop, Step, TipIncrement, TipIntensity, TipStatus};
use ppum::progress::{Progress, Verdict, unwatched};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_fracture::diagnostics::recompute;
use ppum_fracture::growth::{GrowthError, KinkPrediction, ResumePoint, grow, kink, series};
use ppum_fracture::solve::SolveError;
use ppum_problem::{Criterion, Problem};
use ppum_solve::report::strip_timings;

fn grown(text: &str) -> Vec<Step> {
    series(&checked(&parsed(text)), None, unwatched()).expect("a series").steps
}

/// The row of a tip in the growth of a step.
fn row(step: &Step, crack: u32, end: End) -> &TipIncrement {
    let rows = &step.growth.as_ref().expect("a step of a series").tips;
    rows.iter().find(|row| row.tip == TipId { crack, end }).expect("a tip")
}

fn stop(steps: &[Step]) -> Option<GrowthStop> {
    steps.last().and_then(|step| step.growth.as_ref()).and_then(|growth| growth.stop)
}

/// An edge crack of half the width in a plate that is sheared at its top: K_I = 34.04, K_II = 4.54.
fn sheared(growth: &str) -> String {
    format!(
        r#"
        domain = {{ min = [0, 0], max = [7, 16] }}
        material = {{ young = 3e7, poisson = 0.25, state = "plane-strain" }}
        crack = [{{ points = [[0, 8], [3.5, 8]] }}]
        boundary = [
            {{ on = "bottom", displacement = [0, 0] }},
            {{ on = "top", traction = [1, 0] }},
        ]
        discretization = {{ cells = [7, 16], order = 2 }}
        growth = {{ {growth} }}
        "#
    )
}

/// A square plate under tension with a crack and whatever else is given, in coarse cells: what
/// becomes of paths is decided by signs and sizes of factors, not by their digits.
fn pulled(crack: &str, more: &str, growth: &str) -> String {
    pulled_in(3, crack, more, growth)
}

/// The plate in cells of a level.
fn pulled_in(level: u32, crack: &str, more: &str, growth: &str) -> String {
    format!(
        r#"
        domain = {{ min = [-1, -1], max = [1, 1] }}
        material = {{ young = 1, poisson = 0.3, state = "plane-strain" }}
        boundary = [
            {{ on = "bottom", traction = [0, -1] }},
            {{ on = "top", traction = [0, 1] }},
        ]
        discretization = {{ level = {level}, order = 1, refine = false }}
        growth = {{ {growth} }}
        {more}
        [[crack]]
        points = {crack}
        "#
    )
}

/// The field r^½ of K_I and K_II ahead of a long crack, given on the border; the crack has a short
/// kink. What the kink's tip has tends to F_11 K_I + F_12 K_II, F_21 K_I + F_22 K_II: the way of
/// the tip of a growing crack says so by its direction and strength. A kink of the length ℓ is off
/// by a first power of ℓ, which two lengths extrapolate.
#[test]
fn kinks_of_local_symmetry() {
    let (mu, kappa) = (1.0 / 2.6, 1.8);
    let exact = |[k1, k2]: [f64; 2]| {
        let scale = format!("sqrt(hypot(x, y)/(2*pi))/{}", 2.0 * mu);
        let (c, s) = ("cos(atan2(y, x)/2)", "sin(atan2(y, x)/2)");
        let cos = "cos(atan2(y, x))";
        let ux = format!("{scale}*({k1}*{c}*({kappa} - {cos}) + {k2}*{s}*({kappa} + 2 + {cos}))");
        let uy = format!("{scale}*({k1}*{s}*({kappa} - {cos}) - {k2}*{c}*({kappa} - 2 + {cos}))");
        format!(r#"["{ux}", "{uy}"]"#)
    };
    let kinked = |k: [f64; 2], angle: f64, length: f64| {
        let tip = [length * angle.cos(), length * angle.sin()];
        let field = exact(k);
        let text = format!(
            r#"
            domain = {{ min = [-1, -1], max = [1, 1] }}
            material = {{ young = 1, poisson = 0.3, state = "plane-strain" }}
            crack = [{{ points = [[-1, 0], [0, 0], {tip:?}] }}]
            boundary = [
                {{ on = "left", displacement = {field} }},
                {{ on = "right", displacement = {field} }},
                {{ on = "top", displacement = {field} }},
                {{ on = "bottom", displacement = {field} }},
            ]
            discretization = {{ level = 3, order = 2 }}
            "#
        );
        let dataset =
            ppum_fracture::solve::solve(&checked(&parsed(&text)), unwatched()).expect("a solution");
        let tip = &dataset.steps[0].intensities[0];
        [tip.k1, tip.k2]
    };
    let ratio = 2.0;
    let k = [1.0, ratio];
    let factors = TipIntensity::new(TipId { crack: 0, end: End::Last }, k[0], k[1]);
    let found = kink(Criterion::LocalSymmetry, &factors).expect("an open crack");
    let KinkPrediction { angle, k_eq: strength } = found;
    let [long, short] = [0.04, 0.02].map(|length| kinked(k, angle, length));
    let limit = [0, 1].map(|i| 2.0 * short[i] - long[i]);
    println!(
        "K_II = {ratio} K_I: {:.4}°, {strength:.5}: {long:?} {short:?} {limit:?}",
        angle.to_degrees()
    );
    assert!((limit[0] / strength - 1.0).abs() < 2e-3, "{limit:?}, {strength}");
    assert!(limit[1].abs() < 2e-3 * strength, "{limit:?}");
}

/// Asserts that behind the first kink K_II is next to nothing: below a part of K_I by hoop stress
/// and by energy, 0.1 % by local symmetry.
fn assert_sliding_ends(increments: usize, part: f64) {
    for (criterion, bound) in [("hoop", part), ("energy", part), ("local-symmetry", 1e-3)] {
        let rule = format!(r#"criterion = "{criterion}", increment = 0.5, steps = {increments}"#);
        let steps = grown(&sheared(&rule));
        assert_eq!(steps.len(), increments + 1);
        let ratio = |step: &Step| step.intensities[0].k2 / step.intensities[0].k1;
        assert!((ratio(&steps[0]) - 4.5369 / 34.0425).abs() < 1e-4);
        for step in &steps[1..] {
            println!("{criterion}: {:.5}", ratio(step));
            assert!(ratio(step).abs() < bound, "{criterion}: {}", ratio(step));
        }
    }
}

#[test]
fn sliding_ends_with_the_first_kink() {
    assert_sliding_ends(1, 0.01);
}

#[test]
#[ignore = "slow: three increments by three criteria"]
fn sliding_does_not_come_back() {
    assert_sliding_ends(3, 0.03);
}

/// Asserts that the place of the tip after a given length of growth converges as increments are
/// halved, with an order between 1 and 2: the path begins like x^3/2 behind a kink.
/// docs/validation.md has more increments.
fn assert_path_converges(criterion: &str, length: f64, parts: [usize; 3]) {
    let [a, b, c] = parts.map(|n| {
        let increment = length / n as f64;
        let rule = format!(r#"criterion = "{criterion}", increment = {increment}, steps = {n}"#);
        let steps = grown(&sheared(&rule).replace("[7, 16], order", "[4, 9], order"));
        steps[n].cracks[0].end_point(End::Last)
    });
    let order = ((b - a).length() / (c - b).length()).log2();
    println!("{criterion}: {a:?} {b:?} {c:?}: order {order:.2}");
    assert!(order > 1.3, "{criterion}: {order}");
}

#[test]
fn paths_converge() {
    assert_path_converges("local-symmetry", 1.0, [1, 2, 4]);
}

#[test]
#[ignore = "slow: 28 increments"]
fn paths_by_hoop_stress_converge() {
    assert_path_converges("hoop", 2.0, [4, 8, 16]);
}

/// docs/validation.md has paths of more increments: that by hoop stress with eight of them is 4e-3
/// off at its end, that by local symmetry with four 5e-3.
#[test]
#[ignore = "slow: twelve increments, a third of them bent"]
fn criteria_lead_to_one_place() {
    let end = |criterion: &str, n: usize| {
        let increment = 2.0 / n as f64;
        let rule = format!(r#"criterion = "{criterion}", increment = {increment}, steps = {n}"#);
        grown(&sheared(&rule))[n].cracks[0].end_point(End::Last)
    };
    let apart = (end("hoop", 8) - end("local-symmetry", 4)).length();
    println!("{apart:.1e}");
    assert!(apart < 1e-2, "{apart}");
}

/// A map of the plane, and what it does to the plate's sides.
struct Image {
    map: fn(Vec2) -> Vec2,
    /// The loaded sides with their tractions.
    loads: [(&'static str, [f64; 2]); 2],
}

/// Paths turn, mirror, move and grow with the plate, and do not know in which direction a crack is
/// listed, or the size of the load.
#[test]
fn paths_do_not_depend_on_the_frame() {
    let plate = |image: &Image, reversed: bool, load: f64| {
        let corners = [vec2(-1.0, -1.0), vec2(1.0, 1.0)].map(image.map);
        let [min, max] = [corners[0].min(corners[1]), corners[0].max(corners[1])];
        let mut points = [vec2(-0.31, -0.13), vec2(0.17, 0.2)].map(image.map);
        if reversed {
            points.reverse();
        }
        let side = |(on, [x, y]): (&str, [f64; 2])| {
            format!(r#"{{ on = "{on}", traction = [{}, {}] }}"#, load * x, load * y)
        };
        let size = max.x - min.x;
        let text = format!(
            r#"
            domain = {{ min = [{}, {}], max = [{}, {}] }}
            material = {{ young = 1, poisson = 0.3, state = "plane-strain" }}
            crack = [{{ points = [[{}, {}], [{}, {}]] }}]
            boundary = [{}, {}]
            discretization = {{ level = 2, order = 1, refine = false }}
            growth = {{ increment = {}, steps = 2 }}
            "#,
            min.x,
            min.y,
            max.x,
            max.y,
            points[0].x,
            points[0].y,
            points[1].x,
            points[1].y,
            side(image.loads[0]),
            side(image.loads[1]),
            0.04 * size,
        );
        let steps = grown(&text);
        let mut path = steps[2].cracks[0].points.clone();
        if reversed {
            path.reverse();
        }
        path
    };
    let down_up = [("bottom", [0.0, -1.0]), ("top", [0.0, 1.0])];
    let plain = Image { map: |p| p, loads: down_up };
    let path = plate(&plain, false, 1.0);
    assert!(path.len() > 4);
    let images = [
        Image { map: |p| vec2(-p.x, p.y), loads: down_up },
        Image { map: |p| -p, loads: down_up },
        Image { map: Vec2::left, loads: [("left", [-1.0, 0.0]), ("right", [1.0, 0.0])] },
        Image { map: |p| p * 1024.0 + vec2(4096.0, -2048.0), loads: down_up },
    ];
    for (k, image) in images.iter().enumerate() {
        let size = (image.map)(vec2(1.0, 0.0)) - (image.map)(vec2(0.0, 0.0));
        let found = plate(image, k % 2 == 0, [1.0, 1e6][k / 2]);
        let apart = found.iter().zip(&path).map(|(p, q)| (*p - (image.map)(*q)).length());
        let apart = apart.fold(0.0, f64::max) / size.length();
        println!("image {k}: {apart:.1e}");
        assert!(found.len() == path.len() && apart < 1e-8, "image {k}: {found:?} {path:?}");
    }
}

/// Two cracks beside two holes in a plate that turns into itself by 180°: so do the paths.
#[test]
fn symmetric_paths() {
    let steps = grown(
        r#"
        domain = { min = [-10, -5], max = [10, 5] }
        material = { young = 1, poisson = 0.3, state = "plane-strain" }
        hole = [{ center = [-7, 2], radius = 2 }, { center = [7, -2], radius = 2 }]
        crack = [
            { points = [[-10, -2.15], [-9, -2.15]] },
            { points = [[10, 2.15], [9, 2.15]] },
        ]
        boundary = [
            { on = "bottom", traction = [0, -1] },
            { on = "top", traction = [0, 1] },
        ]
        discretization = { cells = [16, 8], order = 1, refine = false }
        refine = [{ size = 0.625 }, { hole = 0, size = 0.32 }, { hole = 1, size = 0.32 }]
        growth = { increment = 0.5, steps = 2 }
        "#,
    );
    let [one, other] = [0, 1].map(|k| steps[2].cracks[k].points.clone());
    assert_eq!(one.len(), other.len());
    let apart = one.iter().zip(&other).map(|(p, q)| (*p + *q).length()).fold(0.0, f64::max);
    println!("{apart:.1e}");
    assert!(one.len() == 4 && apart < 1e-6, "{apart}");
}

/// Cracks run into the border, a hole, another crack and a tip, and end there.
#[test]
fn ends_of_paths() {
    let hole = "hole = [{ center = [0.6, 0], radius = 0.2 }]";
    let wall = "[[crack]]\npoints = [[0.3, -0.4], [0.3, 0.4]]";
    // it is passed at a tenth of an increment
    let beside = "[[crack]]\npoints = [[0.15, 0.03], [0.75, 0.03]]";
    let crack = "[[-1, 0], [0, 0]]";
    // a wall is the first crack, the one that grows the last
    for (more, own, fate, end) in [
        (hole, 0, TipStatus::MeetsHole(0), CrackEnd::Mouth),
        (wall, 1, TipStatus::MeetsCrack(0), CrackEnd::Junction),
        (beside, 1, TipStatus::MeetsCrack(0), CrackEnd::Junction),
    ] {
        let held =
            r#"increment = 0.3, steps = 2, toughness = "if(y > 0.02 or y < -0.2, 100, 0.1)""#;
        let steps = grown(&pulled(crack, more, held));
        let met = steps.iter().position(|step| {
            let rows = &step.growth.as_ref().expect("growth").tips;
            rows.iter().any(|row| row.tip.crack == own && row.fate == fate)
        });
        let met = met.unwrap_or_else(|| panic!("{fate:?} is not met"));
        let grown = &steps[met + 1].cracks[own as usize];
        assert_eq!(grown.ends[1], end);
        let last = *row(&steps[met], own, End::Last).path.last().expect("a path");
        // it has been moved onto what it meets
        assert!((grown.end_point(End::Last) - last).length() < 1e-15);
    }
}

/// Two tips that come to each other in one step: one goes on to the other, which is a tip no more
/// and stays, and the cracks are one. Which of them goes is a matter of their order.
#[test]
fn tips_that_meet() {
    let cracks = ["[[-1, 0], [0, 0]]", "[[0.15, 0.03], [0.35, 0.03]]"];
    for [first, other] in [[0, 1], [1, 0]].map(|order| order.map(|k: usize| cracks[k])) {
        let first = format!("[[crack]]\npoints = {first}");
        let steps = grown(&pulled(other, &first, "increment = 0.3, steps = 1"));
        let rows = &steps[0].growth.as_ref().expect("growth").tips;
        let of = |crack: u32, fate: TipStatus| {
            rows.iter().find(|row| row.tip.crack == crack && row.fate == fate).expect("a fate")
        };
        let (goes, stays) = (of(0, TipStatus::MeetsCrack(1)), of(1, TipStatus::Joined));
        assert!(goes.length > 0.1 && stays.length == 0.0 && stays.path.is_empty());
        let [one, two] = [goes, stays].map(|row| {
            let crack = &steps[1].cracks[row.tip.crack as usize];
            assert_eq!(crack.ends[usize::from(row.tip.end == End::Last)], CrackEnd::Junction);
            crack.end_point(row.tip.end)
        });
        assert_eq!(one, two);
        // of a crack through more than half of the plate
        assert!(steps[1].intensities.len() == 1 && steps[1].intensities[0].k1 > 5.0);
    }
}

/// A plate that tears apart: the crack reaches the other side, and both halves are free of each
/// other, with loads that do not balance.
#[test]
fn pieces_come_off() {
    let text = pulled("[[-1, 0], [0.5, 0]]", "", "increment = 0.2, steps = 9");
    let steps = grown(&text.replace(", refine = false", ""));
    assert_eq!(stop(&steps), Some(GrowthStop::PieceComesOff));
    let last = steps.last().expect("steps");
    assert_eq!(row(last, 0, End::Last).fate, TipStatus::LeavesBody);
    let words = &last.warnings.last().expect("a warning").message;
    assert!(words.contains("a piece comes off") && words.contains("do not balance"), "{words}");
    assert!(steps.len() == 3 || steps.len() == 4, "{}", steps.len());
}

/// Tips stay where K_I is negative or their strength below the toughness, and so does a series that
/// has no tips or none that grows.
#[test]
fn tips_that_stay() {
    let steps = grown(&pulled_in(2, "[[-0.3, 0], [0.3, 0]]", "", "steps = 5, toughness = 10"));
    assert_eq!((steps.len(), stop(&steps)), (1, Some(GrowthStop::AllHeld)));
    assert_eq!(row(&steps[0], 0, End::Start).fate, TipStatus::Held);
    let closed =
        pulled_in(2, "[[-0.3, 0], [0.3, 0]]", "", "steps = 5").replace("[0, 1]", "[0, -1]");
    let steps = grown(&closed.replace(
        "[0, -1] },\n            { on = \"top\"",
        "[0, 1] },\n            { on = \"top\"",
    ));
    assert_eq!((steps.len(), stop(&steps)), (1, Some(GrowthStop::AllHeld)));
    assert_eq!(row(&steps[0], 0, End::Last).fate, TipStatus::Closed);
    // a toughness that differs from place to place holds one end
    let steps = grown(&pulled_in(
        2,
        "[[-0.3, 0], [0.3, 0]]",
        "",
        r#"steps = 2, increment = 0.05, toughness = "if(x > 0, 10, 0.1)""#,
    ));
    assert_eq!(row(&steps[0], 0, End::Last).fate, TipStatus::Held);
    assert_eq!(steps[2].cracks[0].end_point(End::Last), vec2(0.3, 0.0));
    assert!((steps[2].cracks[0].end_point(End::Start) - vec2(-0.4, 0.0)).length() < 1e-3);
    // a corner of the left edge that is cut out, and that nothing acts on
    let steps = grown(&pulled_in(2, "[[-1, -0.3], [-0.6, 0], [-1, 0.3]]", "", "steps = 5"));
    assert_eq!(steps.len(), 1);
    assert_eq!(stop(&steps), Some(GrowthStop::NoTips));
}

/// Under the critical load the strength of a tip is its toughness and no other is larger; twice the
/// load has half the factor, and all of the step is under it.
#[test]
fn critical_loads() {
    let plate = |load: f64| {
        let text = pulled(
            "[[-1, 0.1], [-0.2, 0.1]]",
            "",
            r#"steps = 2, increment = 0.1, toughness = 2.5, load = "critical""#,
        );
        let text = text
            .replace("[0, -1]", &format!("[0, {}]", -load))
            .replace("[0, 1]", &format!("[0, {load}]"));
        series(&checked(&parsed(&text)), None, unwatched()).expect("a series")
    };
    let (once, twice) = (plate(1.0), plate(2.0));
    for (a, b) in once.steps.iter().zip(&twice.steps) {
        assert!((a.load / b.load - 2.0).abs() < 1e-9);
        let [k1, k2] = [a.intensities[0].k1, a.intensities[0].k2];
        let strength = a.load * row(a, 0, End::Last).k_eq;
        assert!(
            (strength - 2.5).abs() < 1e-12 && (k1 / 2.5 - 1.0).abs() < 1e-2,
            "{strength} {k1} {k2}"
        );
        // the field, what is extracted from it, and energies: all of them are under the load
        let mut alone = once.clone();
        alone.steps = vec![a.clone()];
        let again = factors(&alone);
        assert!((again / k1 - 1.0).abs() < 1e-9, "{again} {k1}");
        let [e, f] = [a, b].map(|step| step.record("energy").expect("an energy"));
        assert!((e / f - 1.0).abs() < 1e-9);
        assert!((a.intensities[0].j.expect("J") / (k1 * k1 + k2 * k2) / 0.91 - 1.0).abs() < 1e-2);
    }
    let loads: Vec<f64> = once.steps.iter().map(|step| step.load).collect();
    assert!(loads.windows(2).all(|l| l[1] < l[0]), "longer cracks bear less: {loads:?}");
}

/// K_I of the only tip of a dataset, from its field.
fn factors(dataset: &Dataset) -> f64 {
    let (found, _) =
        ppum_fracture::diagnostics::recompute(dataset, 0, None, unwatched()).expect("factors");
    found[0].factors.as_ref().expect("factors").k1
}

/// Cycles of an edge crack against the integral of Paris' law over K of the same plate, F(a/W) by
/// Tada: good to 0.5 %.
#[test]
fn cycles() {
    let text = r#"
        domain = { min = [0, -2], max = [1, 2] }
        material = { young = 1, poisson = 0.3, state = "plane-strain" }
        crack = [{ points = [[0, 0], [0.2, 0]] }]
        boundary = [
            { on = "bottom", traction = [0, -1] },
            { on = "top", traction = [0, 1] },
        ]
        discretization = { cells = [8, 32], order = 2, refine = false }
        growth = { steps = 3, increment = 0.05, paris = { c = 1e-3, m = 3, ratio = 0.5 } }
    "#;
    let steps = grown(text);
    let factor = |a: f64| {
        let t = (0.5 * std::f64::consts::PI * a).tan();
        let c = (0.5 * std::f64::consts::PI * a).cos();
        let s = (0.5 * std::f64::consts::PI * a).sin();
        (t / (0.5 * std::f64::consts::PI * a)).sqrt()
            * (0.752 + 2.02 * a + 0.37 * (1.0 - s).powi(3))
            / c
    };
    let rate = |a: f64| 1e-3 * (0.5 * factor(a) * (std::f64::consts::PI * a).sqrt()).powi(3);
    let n = 10_000;
    let cycles = |to: f64| {
        let at = |k: usize| 0.2 + (to - 0.2) * (k as f64 + 0.5) / n as f64;
        (0..n).map(|k| (to - 0.2) / n as f64 / rate(at(k))).sum::<f64>()
    };
    for (k, step) in steps.iter().enumerate() {
        let tip = step.cracks[0].end_point(End::Last).x;
        let found = step.growth.as_ref().and_then(|growth| growth.cycles).expect("cycles");
        println!("{k}: a = {tip:.4}: {found:.1} {:.1}", cycles(tip));
        assert!(k == 0 && found == 0.0 || (found / cycles(tip) - 1.0).abs() < 0.015);
    }
}

/// Powers of ΔK that no number holds leave the shares of tips and the cycles as they are: with c in
/// units in which K is a billion times larger both are the same.
#[test]
fn powers_out_of_range() {
    let cracks = "[[crack]]\npoints = [[-1, -0.5], [-0.5, -0.5]]";
    let law = |c: &str| format!("steps = 2, increment = 0.05, paris = {{ c = {c}, m = 40 }}");
    let loads = |scale: &str| {
        let text = pulled_in(2, "[[-1, 0.5], [-0.45, 0.5]]", cracks, &law(scale));
        text.replace("[0, 1]", "[0, 1e9]").replace("[0, -1]", "[0, -1e9]")
    };
    let steps = [
        grown(&pulled_in(2, "[[-1, 0.5], [-0.45, 0.5]]", cracks, &law("1e10"))),
        grown(&loads("1e-300")),
    ];
    for (one, other) in steps[0].iter().zip(&steps[1]) {
        let [one, other] = [one, other].map(|step| step.growth.as_ref().expect("growth"));
        for (a, b) in one.tips.iter().zip(&other.tips) {
            assert_eq!((a.tip, a.fate), (b.tip, b.fate));
            assert!((a.due - b.due).abs() + (a.length - b.length).abs() < 1e-9);
        }
        // (1e9)^40 times 1e-310 fewer
        let [a, b] = [one, other].map(|growth| growth.cycles.expect("cycles"));
        assert!((a - b * 1e50).abs() <= 1e-6 * a, "{a} {b}");
    }
}

/// A toughness that is none at a tip, a load beyond all bounds, cycles without number: an error in
/// the first step, and later the end of the series, with the reason.
#[test]
fn what_cannot_be_decided() {
    let first = |growth: &str| {
        let text = pulled_in(2, "[[-0.3, 0], [0.3, 0]]", "", growth);
        series(&checked(&parsed(&text)), None, unwatched()).expect_err("no decision").to_string()
    };
    for (toughness, more) in [
        ("sqrt(-1 - x^2)", ""),
        ("1/(x - x)", ", load = 'critical'"),
        ("-1 - x^2", ", paris = { c = 1e-3, m = 3 }"),
        ("-1 - x^2", ""),
    ] {
        let told = first(&format!("steps = 2, toughness = '{toughness}'{more}"));
        assert!(told.contains("`toughness` is") && told.contains("(-0.3, 0)"), "{told}");
    }
    let told = first("steps = 1, toughness = 1e200, load = 'critical'");
    assert!(told.contains("K reaches the toughness at"), "{told}");
    let later = [
        (
            "increment = 0.1, steps = 3, toughness = 'if(abs(x) > 0.35, -1, 1e-3)'",
            "`toughness` is -1",
        ),
        (
            "increment = 0.1, steps = 3, paris = { c = 1e-300, m = 90, ratio = 0.999 }",
            "took inf cycles",
        ),
    ];
    for (growth, reason) in later {
        let steps = grown(&pulled_in(2, "[[-0.3, 0], [0.3, 0]]", "", growth));
        assert_eq!((steps.len(), stop(&steps)), (2, Some(GrowthStop::Unsolvable)));
        let told = &steps[1].warnings.last().expect("a warning").message;
        assert!(told.contains(reason), "{told}");
    }
}

/// Asserts that K_II vanishes at the ends of arcs, or that a warning says how far it does not, and
/// returns in how many steps there is one.
fn unsettled_steps(increments: usize) -> usize {
    let rule = format!("steps = {increments}, increment = 0.2, criterion = 'local-symmetry'");
    let beside = "[[crack]]\npoints = [[0.1, -0.3], [0.5, -0.15]]";
    let steps = grown(&pulled_in(2, "[[-1, 0.1], [-0.4, 0.05]]", beside, &rule));
    assert_eq!(steps.len(), increments + 1);
    let is_unsettled = |step: &&Step| {
        let ratio = step.intensities.iter().map(|tip| (tip.k2 / tip.k1).abs()).fold(0.0, f64::max);
        let warning = step.warnings.iter().find(|w| w.message.contains("could not be bent"));
        println!("{ratio:.1e} {:?}", warning.map(|warning| warning.value));
        assert!(warning.map_or(ratio < 6e-5, |warning| warning.value <= ratio && ratio > 4e-5));
        warning.is_some()
    };
    steps[1..].iter().filter(is_unsettled).count()
}

#[test]
fn arcs_are_settled_or_a_warning_says_so() {
    unsettled_steps(1);
}

/// Arcs that turn too much for their length are not bent until K_II vanishes, and a warning
/// says so.
#[test]
#[ignore = "slow: arcs are bent many times"]
fn unsettled_arcs() {
    assert!(unsettled_steps(2) > 0);
}

/// The slower of two cracks has grown what the law says of its strength in the same cycles, by the
/// means of its share at the ends of increments; it may lag by half an increment.
#[test]
fn slow_tips() {
    let more = "[[crack]]\npoints = [[1, 0.5], [0.8, 0.5]]";
    let growth = "increment = 0.05, steps = 4, paris = { c = 1, m = 2 }";
    let steps = grown(&pulled("[[-1, -0.3], [-0.6, -0.3]]", more, growth));
    let share = |step: &Step| {
        let (slow, fast) = (row(step, 0, End::Last), row(step, 1, End::Last));
        assert!(slow.k_eq < fast.k_eq);
        (slow.k_eq / fast.k_eq).powi(2)
    };
    let shares: Vec<_> = steps.iter().map(share).collect();
    let wanted: f64 = shares.windows(2).map(|ends| 0.025 * (ends[0] + ends[1])).sum();
    let last = row(&steps[4], 0, End::Last);
    let due = row(&steps[3], 0, End::Last).due;
    println!("{wanted} {} {due}", last.extension);
    // the last share is that of the last two steps, continued
    assert!((last.extension + due - wanted).abs() < 2e-3 * wanted && due < 0.5 * 0.05);
}

/// The end that comes out of a crack that is fractured by cyclic loads.
#[test]
fn fracture_ends_fatigue() {
    let growth = "increment = 0.1, steps = 9, toughness = 2.6, paris = { c = 1, m = 2 }";
    let steps = grown(&pulled("[[-1, 0], [-0.4, 0]]", "", growth));
    assert_eq!(stop(&steps), Some(GrowthStop::Fracture));
    let strengths: Vec<f64> = steps.iter().map(|step| row(step, 0, End::Last).k_eq).collect();
    let (last, others) = strengths.split_last().expect("steps");
    assert!(*last >= 2.6 && others.iter().all(|strength| *strength < 2.6), "{strengths:?}");
}

/// A series that goes on from one of its steps has the same bits as one that was not interrupted,
/// by all criteria: what is decided is stored, and nothing else is taken over from a step.
#[test]
fn series_go_on_from_their_steps() {
    let edge = "[[-1, 0.1], [-0.2, 0.15]]";
    let beside = "[[crack]]\npoints = [[0.4, 0.1], [0.7, -0.1]]";
    let held = r#"steps = 2, criterion = "hoop", increment = 0.1"#;
    let cycled = "steps = 3, increment = 0.05, paris = { c = 1e-3, m = 3 }, cycles = [[9, 1, 0], [1, 1.5, 0.2]], \
                  wheeler = { yield = 20, exponent = 1 }";
    let bent = r#"steps = 2, criterion = "local-symmetry", increment = 0.05"#;
    for (more, rule, number) in [(beside, held, 1), ("", bent, 0), (beside, cycled, 2)] {
        let text = pulled_in(2, edge, more, rule);
        let (problem, whole) = (parsed(&text), grown(&text));
        let mut rest = Vec::new();
        let last = ResumePoint { number, step: &whole[number], earlier: &whole[..number] };
        grow(&checked(&problem), Some(last), None, unwatched(), |mut step| {
            rest.append(&mut step.steps);
            Ok::<_, ()>(())
        })
        .expect("the rest");
        assert_eq!(rest.len(), whole.len() - number - 1);
        for (a, b) in whole[number + 1..].iter().zip(&rest) {
            let (a, b) = (timeless(a), timeless(b));
            if let Some(at) = a.bytes().zip(b.bytes()).position(|(a, b)| a != b) {
                let part = |text: &str| text[at.saturating_sub(60)..].chars().take(120).collect();
                let parts: [String; 2] = [part(&a), part(&b)];
                panic!("{rule} from {number}: {parts:#?}");
            }
            assert_eq!(a.len(), b.len());
        }
    }
}

/// The problem of a step has its cracks and the loads on their faces, new ones too: K is found
/// again as it was stored. Cracks that do not begin as those of the problem are refused.
#[test]
fn a_step_has_a_problem_of_its_own() {
    let beside = "[[crack]]\npoints = [[0.4, 0.1], [0.7, -0.1]]";
    let pressed = "boundary = [{ on = { crack = 1 }, pressure = 0.5 },";
    let text = pulled("[[-0.4, 0.1], [-0.2, 0.15]]", beside, "steps = 2, increment = 0.05");
    let text = text.replacen("boundary = [", pressed, 1);
    let mut all = series(&checked(&parsed(&text)), None, unwatched()).expect("a series");
    assert!(all.steps[2].cracks[1].length() > all.steps[0].cracks[1].length());
    for step in 0..all.steps.len() {
        let problem = Problem::of_step(&all, step).expect("a problem");
        let (found, _) = recompute(&all, step, problem.as_ref(), unwatched()).expect("a field");
        for (tip, stored) in found.iter().zip(&all.steps[step].intensities) {
            let factors = tip.factors.as_ref().expect("factors");
            let miss = (factors.k1 - stored.k1).abs().max((factors.k2 - stored.k2).abs());
            assert!(miss <= 1e-12 * stored.k1.hypot(stored.k2), "{step}: {factors:?} {stored:?}");
        }
    }
    let cracks = all.steps[2].cracks.clone();
    all.steps[2].cracks.reverse();
    assert!(Problem::of_step(&all, 2).is_err());
    all.steps[2].cracks = cracks[..1].to_vec();
    assert!(Problem::of_step(&all, 2).is_err() && Problem::of_step(&all, 7).is_err());
}

/// A step without the seconds that it took, in words: NaN is equal to itself there.
fn timeless(step: &Step) -> String {
    let mut step = step.clone();
    strip_timings(&mut step);
    format!("{step:?}")
}

/// Whoever cancels a series has all steps that are complete; a place that takes no more steps
/// ends it.
#[test]
fn series_are_cancelled() {
    let problem = parsed(&pulled_in(2, "[[-0.3, 0], [0.3, 0]]", "", "steps = 5, increment = 0.05"));
    let until = |progress: Progress| Verdict::go_on_unless(progress.step == 3);
    let mut kept = 0;
    let ended = grow(&checked(&problem), None, None, &until, |_| {
        kept += 1;
        Ok::<_, ()>(())
    });
    assert!(matches!(ended, Err(GrowthError::Solve(SolveError::Cancelled(_)))));
    assert_eq!(kept, 3);
    let full = grow(&checked(&problem), None, None, unwatched(), |_| Err("full"));
    assert!(matches!(full, Err(GrowthError::Kept("full"))));
}

/// Chosen increments grow with the plate and shrink where a path turns.
#[test]
fn chosen_increments() {
    let steps = grown(&sheared("steps = 2"));
    let lengths: Vec<f64> = steps.iter().map(|step| row(step, 0, End::Last).length).collect();
    assert!(lengths[0] > 0.05 && lengths[0] <= 0.14 + 1e-12, "{lengths:?}");
    let bounds = Rect::new(vec2(0.0, 0.0), vec2(7.0, 16.0));
    assert!(steps[2].cracks[0].points.iter().all(|p| bounds.contains(*p)));
}
