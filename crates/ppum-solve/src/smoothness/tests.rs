use super::pieces::{SmoothPieces, rays};
use super::traits::{TraitContext, Traits, traits_of_coefficient};
use crate::quadrature::{KinkLine, SingularGrowth, Singularity};
use ppum::crack::{Crack, CrackEnd, End, TipId};
use ppum::formula::{Formula, Scope, Table};
use ppum::function::{Frame, Function, FunctionKind, NonsmoothPoints, Role, WESTERGAARD};
use ppum::vec2::{Rect, Vec2, vec2};
use std::f64::consts::PI;
use std::sync::Arc;

#[test]
fn degrees_of_piecewise_polynomials() {
    let degree = |text: &str| {
        SmoothPieces::new(&Formula::parse(text, &Scope::polar()).expect("a formula")).degree
    };
    for (text, expected) in [
        ("7", Some(0)),
        ("if(y > 0, 10, 1)", Some(0)),
        ("sign(x - y)", Some(0)),
        ("abs(y)", Some(1)),
        ("max(x, 2*y - 1)", Some(1)),
        ("x*y + 1", Some(2)),
        ("abs(x)*abs(y)*x", Some(3)),
        ("x^4", None),
        ("1/(1 + x^2)", None),
        ("r^2", None),
        ("exp(-y)", None),
    ] {
        assert_eq!(degree(text), expected, "{text}");
    }
}

/// A spline is a cubic between its knots.
#[test]
fn knots_of_splines() {
    let table = |n: usize| {
        let knots: Vec<f64> = (0..n).map(|k| k as f64).collect();
        let values = knots.iter().map(|x| x.sin()).collect();
        Arc::new(Table::curve("k", knots, values).expect("a table"))
    };
    let pieces = |n: usize| {
        let scope = Scope::cartesian().with_table(table(n)).expect("a name");
        SmoothPieces::new(&Formula::parse("table(k, 2*x)", &scope).expect("a formula"))
    };
    let few = pieces(5);
    assert_eq!(few.degree, Some(3));
    let mut at: Vec<_> = few.sets.iter().filter_map(|set| set.line()).collect();
    at.sort_by(|a, b| (-a[2] / a[0]).total_cmp(&(-b[2] / b[0])));
    assert_eq!(at.iter().map(|l| -l[2] / l[0]).collect::<Vec<_>>(), [0.0, 0.5, 1.0, 1.5, 2.0]);
    let many = pieces(200);
    assert_eq!((many.degree, many.sets.len()), (None, 2));
}

/// A crack, patches of half-size 0.1.
fn surroundings() -> TraitContext<'static> {
    let kinked = Crack::polyline(
        vec![vec2(-1.0, 0.0), vec2(0.0, 0.0), vec2(1.0, 1.0)],
        [CrackEnd::Mouth, CrackEnd::Tip],
    );
    TraitContext {
        cracks: vec![kinked].into(),
        tables: &[],
        domain: Rect::new(vec2(-2.0, -2.0), vec2(2.0, 2.0)),
        reach: 10.0,
        scale: 0.1,
    }
}

fn traits(text: &str, frame: Frame) -> Traits {
    let function = Function { name: text.into(), kind: FunctionKind::formula(text, frame) };
    surroundings().traits(&function).expect("a function")
}

/// Distance of a point to the line of a kink.
fn off(kink: &KinkLine, p: Vec2) -> f64 {
    let (KinkLine::Line([a, b]) | KinkLine::Segment([a, b])) = kink else {
        panic!("a line: {kink:?}")
    };
    ((*b - *a).cross(p - *a) / (*b - *a).length()).abs()
}

const TIP: TipId = TipId { crack: 0, end: End::Last };

#[test]
fn kinks_are_seen_in_the_world() {
    let (origin, angle) = (vec2(0.3, -0.2), 0.7f64);
    let x = vec2(angle.cos(), angle.sin());
    let found = traits("abs(y - 0.5)", Frame::Fixed { origin, angle });
    assert_eq!((found.kinks.len(), found.degree, found.singular.len()), (1, 1, 0));
    assert!(found.probe.is_none());
    for s in [-3.0, 0.0, 2.0] {
        assert!(off(&found.kinks[0], origin + x * s + x.left() * 0.5) < 1e-14);
    }
    // in the frame of the tip at (1, 1), x along the diagonal
    let found = traits("max(x - 2*y, 0)", Frame::Tip(TIP));
    let diagonal = vec2(1.0, 1.0).unit();
    let p = vec2(1.0, 1.0) + diagonal * 2.0 + diagonal.left();
    assert!(off(&found.kinks[0], p) < 1e-14 && off(&found.kinks[0], vec2(1.0, 1.0)) < 1e-14);
    let found = traits("if(x^2 + y^2 < 1, x, y)", Frame::Fixed { origin, angle });
    let [KinkLine::Curve(level)] = found.kinks.as_slice() else { panic!("{:?}", found.kinks) };
    assert!(level(origin + x.left() * 0.99) * level(origin + x.left() * 1.01) < 0.0);
    assert!(level(origin + x).abs() < 1e-14);
}

/// θ jumps on the negative x axis of a fixed frame, on the crack in the frame of a tip.
#[test]
fn the_cut_of_the_polar_angle_is_a_kink() {
    let frame = Frame::Fixed { origin: vec2(0.5, 0.0), angle: std::f64::consts::FRAC_PI_2 };
    let found = traits("r^0.6*sin(0.6*theta)", frame);
    let [KinkLine::Segment([a, b])] = found.kinks.as_slice() else { panic!("{:?}", found.kinks) };
    assert_eq!(*a, vec2(0.5, 0.0));
    assert!((b.x - 0.5).abs() < 1e-14 && b.y < -10.0, "{b:?}");
    let [Singularity { point, growth: SingularGrowth::Powers { least }, .. }] = found.singular[..]
    else {
        panic!("{:?}", found.singular)
    };
    assert!(point == vec2(0.5, 0.0) && (least - 0.6).abs() < 1e-6 && found.probe.is_some());
    assert!(traits("r^2*cos(2*theta)", frame).kinks.is_empty());
}

#[test]
fn kinks_at_angles_are_rays() {
    let rays = |text: &str| rays(&Formula::parse(text, &Scope::polar()).expect("a formula"));
    for (text, expected) in [
        ("theta - 0.6", Some(vec![0.6])),
        ("theta", Some(vec![0.0])),
        ("2*theta^2 - 8", Some(vec![-2.0, 2.0])),
        ("sin(theta/2) - 1/2", Some(vec![PI / 3.0])),
        ("theta - 4", Some(vec![])),
        ("theta - r", None),
        ("sin(theta)", None),
    ] {
        let found = rays(text);
        let near = match (&found, &expected) {
            (Some(found), Some(expected)) => {
                let mut pairs = found.iter().zip(expected);
                found.len() == expected.len() && pairs.all(|(a, b)| (a - b).abs() < 1e-14)
            }
            (found, expected) => found == expected,
        };
        assert!(near, "{text}: {found:?}");
    }
    let frame = Frame::Fixed { origin: vec2(1.0, 0.0), angle: PI / 2.0 };
    let found = traits("r*abs(theta - 0.6)", frame);
    let ray = vec2((0.6 + PI / 2.0).cos(), (0.6 + PI / 2.0).sin());
    let on_ray = |kink: &KinkLine| {
        matches!(kink, KinkLine::Segment([a, b]) if *a == vec2(1.0, 0.0)
            && (*b - *a).cross(ray).abs() < 1e-13 && (*b - *a).dot(ray) > 10.0)
    };
    assert!(found.kinks.iter().any(on_ray), "{:?}", found.kinks);
}

#[test]
fn functions_at_tips() {
    for text in WESTERGAARD {
        let found = traits(text, Frame::Tip(TIP));
        assert_eq!(found.singular, [Singularity::tip(vec2(1.0, 1.0))]);
        assert!(found.kinks.is_empty() && found.probe.is_none() && found.degree == 0);
    }
    let found = traits("r^(3/2)*cos(3*theta/2)", Frame::Tip(TIP));
    assert_eq!(found.singular, [Singularity::tip(vec2(1.0, 1.0))]);
    assert!(found.kinks.is_empty() && found.probe.is_some());
    assert_eq!(traits("log(r)", Frame::Tip(TIP)).divergent, Some(vec2(1.0, 1.0)));
}

#[test]
fn declared_places() {
    let declared = NonsmoothPoints {
        kinks: vec![[vec2(0.0, 0.0), vec2(0.0, 2.0)]],
        singular: vec![vec2(0.0, 1.0)],
    };
    let kind = FunctionKind::Formula {
        text: "hypot(x, y - 1)^0.3".into(),
        frame: Frame::Fixed { origin: vec2(1.0, 0.0), angle: std::f64::consts::FRAC_PI_2 },
        parameters: Vec::new(),
        declared,
        role: Role::User,
    };
    let function = Function { name: "declared".into(), kind };
    let found = surroundings().traits(&function).expect("a function");
    let [Singularity { point, growth: SingularGrowth::HalfPowers, .. }] = found.singular[..] else {
        panic!("{:?}", found.singular)
    };
    assert!((point - vec2(0.0, 0.0)).length() < 1e-15);
    let Some(KinkLine::Segment([a, b])) = found.kinks.last() else { panic!("{:?}", found.kinks) };
    assert!((*a - vec2(1.0, 0.0)).length() < 1e-15 && (*b - vec2(-1.0, 0.0)).length() < 1e-15);
}

#[test]
fn coefficients() {
    let of = |text: &str| traits_of_coefficient(&text.parse().expect("an expression"));
    let steps = of("if(y > 0.3*x + 0.1, 10, 1)");
    assert!(steps.probe.is_none() && steps.degree == 0);
    assert!(off(&steps.kinks[0], vec2(1.0, 0.4)) < 1e-15);
    assert!(of("3").kinks.is_empty());
    let [KinkLine::Curve(level)] = &of("if(x^2 + y^2 < 0.25, 10, 1)").kinks[..] else {
        panic!("a circle")
    };
    assert!(level(vec2(0.4, 0.0)) * level(vec2(0.6, 0.0)) < 0.0);
    let graded = of("exp(3*x)").probe.expect("a probe");
    let [v, x, y] = graded.jet(vec2(0.5, 0.0), vec2(0.1, 7.0));
    assert!((v - 1.8f64.exp()).abs() < 1e-14 && (x - 3.0 * v).abs() < 1e-13 && y == 0.0);
}
