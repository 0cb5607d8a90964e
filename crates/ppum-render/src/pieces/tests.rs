//! Pieces of random squares: they fill them, and nothing runs through them.

use super::*;
use crate::anchored_edge::AnchoredEdge;
use ppum::crack::{Crack, CrackEnd, Side};
use ppum::dataset::Dataset;
use ppum::domain::PolygonSide;
use ppum::equation::{Elasticity, StressState};
use ppum::function::{FunctionKind, GROUP, Slot};
use ppum::jet::Jet;
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::Recipe;

/// Cracks with kinks, tips and a mouth, or ones that meet, round holes of many sizes, polygons,
/// over each other and the border.
fn dataset(seed: u64) -> Dataset {
    let recipe = if seed < 4 { Recipe::random(seed) } else { Recipe::meeting() };
    let mut dataset = recipe.dataset();
    let circle = |x, y, radius| Hole::Circle { center: vec2(x, y), radius };
    let polygon = |points: &[[f64; 2]]| Hole::polygon(points.iter().map(|&p| p.into()).collect());
    dataset.domain.holes = vec![
        circle(0.5, 0.6, 0.08),
        circle(0.2, -0.3, 0.1),
        circle(1.3, 0.1, 0.003),
        polygon(&[[0.6, 0.55], [0.8, 0.5], [0.7, 0.6], [0.75, 0.68]]),
        polygon(&[[0.54, 0.5], [0.5, 0.62], [0.6, 0.58]]),
    ];
    dataset
}

/// Squares of many sizes about places where something happens, as seen from there.
fn places(dataset: &Dataset, random: &mut Random) -> Vec<(Vec2, Rect)> {
    let cracks = dataset.steps[0].cracks.iter().flat_map(|crack| crack.points.windows(2));
    let mut points: Vec<Vec2> =
        cracks.flat_map(|s| [s[0], s[1], s[0] + (s[1] - s[0]) * 0.37]).collect();
    for hole in &dataset.domain.holes {
        match hole {
            Hole::Circle { center, radius } => points.push(*center + vec2(0.6, 0.8) * *radius),
            Hole::Polygon { points: corners, .. } => {
                points.extend(corners.iter().copied().chain([(corners[0] + corners[1]) * 0.5]));
            }
        }
    }
    points.extend((0..40).map(|_| random.point(&dataset.domain.bounds)));
    let mut all = Vec::new();
    for (point, size) in
        points.into_iter().flat_map(|p| [0.1, 0.01, 1e-3, 1e-6, 1e-12].map(|s| (p, s)))
    {
        let shift = random.point(&Rect::around(Vec2::ZERO, vec2(0.45, 0.45))) * size;
        all.push((point, Rect::around(shift, vec2(0.5, 0.5) * size)));
        // and squares whose sides run through the point
        all.push((point, Rect::new(Vec2::ZERO, vec2(size, size))));
    }
    all
}

fn random_point(piece: &ConvexPiece, random: &mut Random) -> Vec2 {
    let weights: Vec<f64> = piece.corners.iter().map(|_| random.unit()).collect();
    let sum: f64 = weights.iter().sum();
    let origin = piece.corners[0];
    let parts = piece.corners.iter().zip(&weights).map(|(&c, w)| (c - origin) * (w / sum));
    origin + parts.fold(Vec2::ZERO, |a, b| a + b)
}

/// The area of a piece.
fn area(piece: &ConvexPiece) -> f64 {
    let next = piece.corners.iter().cycle().skip(1);
    let origin = piece.corners[0];
    let twice = piece.corners.iter().zip(next).map(|(a, b)| (*a - origin).cross(*b - origin));
    0.5 * twice.sum::<f64>()
}

/// True if the way between two points crosses the crack.
fn crosses(crack: &Crack, anchor: Vec2, [p, q]: [Vec2; 2]) -> bool {
    crack.edges().any(|edge| {
        let (local, way) = (AnchoredEdge::new(edge, anchor), Edge::segment([p, q]));
        let near = local.near(2.0 * p.length().max(q.length()));
        near.into_iter().any(|part| !way.meets(&local.part(part)).is_empty())
    })
}

#[test]
fn pieces_are_convex_inside_and_on_one_side() {
    let mut looked = 0;
    for seed in 0..5 {
        let dataset = dataset(seed);
        let field = Field::new(&dataset, 0).expect("a field");
        let mut random = Random(seed);
        for (anchor, square) in places(&dataset, &mut random) {
            let domain = dataset.domain.at(anchor);
            let pieces = Pieces::new(&field, anchor).of(&square);
            for piece in &pieces {
                looked += 1;
                assert_eq!(piece.corners.len(), piece.faces.len());
                assert!(area(piece) > 0.0);
                let center = piece.center();
                let seen: Vec<Vec2> =
                    piece.corners.iter().map(|&c| piece.seen_from_inside(c)).collect();
                let inner: Vec<Vec2> = (0..5).map(|_| random_point(piece, &mut random)).collect();
                for &p in seen.iter().chain(&inner) {
                    assert!(domain.contains(p), "{anchor:?} {square:?} {piece:?} {p:?}");
                    for crack in field.step.cracks.iter() {
                        let message = || format!("{anchor:?} {square:?} {piece:?} {p:?}");
                        assert!(!crosses(crack, anchor, [center, p]), "{}", message());
                    }
                }
            }
        }
    }
    assert!(looked > 3000, "{looked}");
}

/// At junctions as near as one likes: every function of a component has one value on a piece.
#[test]
fn components_do_not_jump_in_pieces() {
    let recipe = Recipe::meeting();
    let dataset = recipe.dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    let (mut random, mut pieces_of_several) = (Random(7), 0);
    for (center, size) in recipe
        .junctions
        .iter()
        .flat_map(|place| [1e-3, 1e-6, 1e-9, 1e-12].map(|size| (place.center, size)))
    {
        let functions = field.functions.at(&field.step.cracks, center);
        let mut patches = Vec::new();
        field.tree.query_point(center, &mut patches);
        let blocks = patches.iter().flat_map(|&patch| field.data.blocks(patch as usize));
        let groups: Vec<usize> = blocks
            .map(|block| field.data.block_function[block])
            .filter(|&f| {
                matches!(field.step.functions[f as usize].kind, FunctionKind::Component { .. })
            })
            .filter_map(|f| match field.functions.of(f) {
                Slot::Jet { group, .. } => Some(group as usize),
                Slot::One => None,
            })
            .collect();
        let value = |p: Vec2| -> Vec<f64> {
            let mut jets = [Jet::constant(0.0); GROUP];
            let mut of = |group: usize| {
                functions.evaluate::<f64, 0>(group, p.into(), Side::Above, &mut jets);
                jets[0].v
            };
            groups.iter().map(|&group| of(group)).collect()
        };
        let shift = random.point(&Rect::around(Vec2::ZERO, vec2(0.4, 0.4))) * size;
        let pieces = Pieces::new(&field, center).of(&Rect::around(shift, vec2(0.5, 0.5) * size));
        pieces_of_several += usize::from(pieces.len() > 2 && !groups.is_empty());
        for piece in &pieces {
            let inside = value(piece.center());
            let corners = piece.corners.iter().map(|&corner| piece.seen_from_inside(corner));
            for p in corners.collect::<Vec<_>>() {
                assert_eq!(value(p), inside, "{center:?} {size} {piece:?}");
            }
        }
    }
    assert_eq!(pieces_of_several, 16);
}

/// Points in no piece are outside the domain, or beside a round rim.
#[test]
fn pieces_fill_the_square_but_for_holes() {
    for seed in 0..5 {
        let dataset = dataset(seed);
        let field = Field::new(&dataset, 0).expect("a field");
        let mut random = Random(seed);
        for (anchor, square) in places(&dataset, &mut random) {
            let domain = dataset.domain.at(anchor);
            let pieces = Pieces::new(&field, anchor).of(&square);
            let size = square.size().x;
            let holds = |piece: &ConvexPiece, p: Vec2| {
                let next = piece.corners.iter().cycle().skip(1);
                piece
                    .corners
                    .iter()
                    .zip(next)
                    .all(|(a, b)| (*b - *a).unit().cross(p - *a) >= -2e-5 * size)
            };
            for _ in 0..20 {
                let p = random.point(&square);
                let covered = pieces.iter().filter(|piece| holds(piece, p)).count();
                // moved out of the hole, as far as tangents are from rims
                let around = [[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
                let well_inside =
                    around.iter().all(|&d| domain.contains(p + Vec2::from(d) * (0.05 * size)));
                let outside =
                    around.iter().all(|&d| !domain.contains(p + Vec2::from(d) * (1e-4 * size)));
                assert!(!well_inside || covered > 0, "{anchor:?} {square:?} {p:?} {pieces:?}");
                assert!(!outside || covered == 0, "{anchor:?} {square:?} {p:?} {pieces:?}");
            }
        }
    }
}

/// A crack of arcs and a segment, one of 340°, a small one, and holes with round sides.
fn curved_dataset() -> Dataset {
    let crack = |points: &[[f64; 2]], bulges: &[f64], ends| Crack {
        points: points.iter().map(|&p| p.into()).collect(),
        bulges: bulges.to_vec(),
        ends,
    };
    let cracks = vec![
        crack(
            &[[0.5713, 0.0931], [0.8642, 0.2817], [1.0, 0.2], [1.1831, 0.1973]],
            &[0.31, 0.0, -0.8],
            [CrackEnd::Tip; 2],
        ),
        crack(&[[1.3, 0.5], [1.32, 0.49]], &[85f64.to_radians().tan()], [CrackEnd::Tip; 2]),
        crack(&[[0.3, 0.4], [0.304, 0.402]], &[0.7], [CrackEnd::Tip; 2]),
    ];
    let mut dataset = Recipe { cracks, ..Recipe::default() }.dataset();
    let round = |points: &[[f64; 2]], bulges: &[f64]| {
        let points = points.iter().map(|&p| p.into()).collect();
        Hole::with_arcs(points, bulges.to_vec(), PolygonSide::Inside)
    };
    dataset.domain.holes = vec![
        // a stadium, a lens in clockwise order, and one with a bite
        round(&[[0.5, 0.5], [0.8, 0.5], [0.8, 0.6], [0.5, 0.6]], &[0.0, 1.0, 0.0, 1.0]),
        round(&[[0.3, -0.1], [0.45, -0.05]], &[-0.4, -0.3]),
        round(&[[1.0, -0.2], [1.2, -0.2], [1.1, 0.05]], &[0.0, 0.2, -0.5]),
    ];
    dataset
}

/// Squares of many sizes at ends, joints and inside of all arcs.
fn places_on_arcs(dataset: &Dataset, random: &mut Random) -> Vec<(Vec2, Rect)> {
    let cracks = dataset.steps[0].cracks.iter().flat_map(Crack::edges);
    let edges = cracks.chain(dataset.domain.holes.iter().flat_map(Hole::edges));
    let points = edges.flat_map(|edge| [0.0, 0.37, 0.9, 1.0].map(|t| edge.at(t)));
    let sized = |p: Vec2| [0.7, 0.1, 0.01, 1e-3, 1e-6, 1e-12].map(|size| (p, size));
    let places = points.flat_map(sized).collect::<Vec<_>>().into_iter();
    let square = |(point, size): (Vec2, f64)| {
        let shift = random.point(&Rect::around(Vec2::ZERO, vec2(0.45, 0.45))) * size;
        (point, Rect::around(shift, vec2(0.5, 0.5) * size))
    };
    places.map(square).collect()
}

/// As they are seen from inside, pieces beside arcs lie on one side of them and in the body, and
/// they leave out no more of it than lines are from arcs.
#[test]
fn pieces_lie_beside_arcs() {
    let dataset = curved_dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    let (mut random, mut looked) = (Random(3), 0);
    for (anchor, square) in places_on_arcs(&dataset, &mut random) {
        let (domain, size) = (dataset.domain.at(anchor), square.size().x);
        let pieces = Pieces::new(&field, anchor).of(&square);
        for piece in &pieces {
            looked += 1;
            assert!(area(piece) > 0.0);
            let inner: Vec<Vec2> = (0..5).map(|_| random_point(piece, &mut random)).collect();
            for &p in piece.corners.iter().chain(&inner) {
                let p = piece.seen_from_inside(p);
                let message = || format!("{anchor:?} {square:?} {piece:?} {p:?}");
                assert!(domain.contains(p), "{}", message());
                for crack in &field.step.cracks {
                    assert!(!crosses(crack, anchor, [piece.center(), p]), "{}", message());
                }
            }
        }
        for _ in 0..20 {
            let p = random.point(&square);
            let is_held = pieces.iter().any(|piece| {
                let corners = &piece.corners;
                let next = corners.iter().cycle().skip(1);
                let mut sides = corners.iter().zip(next);
                sides.all(|(a, b)| (*b - *a).unit().cross(p - *a) >= -2e-5 * size)
            });
            let around = [[0.0, 0.0], [1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]];
            let is_inside =
                around.iter().all(|&d| domain.contains(p + Vec2::from(d) * (0.05 * size)));
            // slivers beside arcs are left out
            let edges = field.step.cracks.iter().flat_map(Crack::edges);
            let mut locals = edges.map(|edge| AnchoredEdge::new(edge, anchor));
            let is_apart = locals.all(|e| (e.frame.at(e.closest(p)) - p).length() > 0.02 * size);
            let message = || format!("{anchor:?} {square:?} {p:?} {pieces:?}");
            assert!(!is_inside || !is_apart || is_held, "{}", message());
        }
    }
    assert!(looked > 500, "{looked}");
}

/// A square without anything is itself; one on a crack has faces along it, and a corner at the tip.
#[test]
fn faces_end_at_a_tip() {
    let recipe = Recipe::default();
    let dataset = recipe.dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    let crack = &recipe.cracks[0];
    let tip = crack.points[2];
    for size in [1e-3, 1e-9, 1e-13] {
        let pieces = Pieces::new(&field, tip).of(&Rect::around(Vec2::ZERO, vec2(size, size)));
        assert_eq!(pieces.len(), 2);
        for piece in &pieces {
            let at_tip = piece.corners.iter().filter(|c| c.length() < 1e-15 * size).count();
            let faces = piece.faces.iter().filter(|&&face| face).count();
            assert_eq!((at_tip, faces), (1, 1), "{piece:?}");
        }
        let beside = Rect::around(vec2(3.0, 3.0) * size, vec2(size, size));
        let whole = Pieces::new(&field, tip);
        assert!(!whole.may_cut(&beside));
        assert!(
            matches!(&whole.of(&beside)[..], [one] if one.corners.len() == 4 && !one.faces.contains(&true))
        );
    }
}

fn two_materials(young: &str, strain: &str) -> Dataset {
    let mut dataset = Recipe { cracks: vec![], ..Recipe::default() }.dataset();
    let (young, poisson) = (expression(young), 0.3.into());
    let given = || [strain, strain, "0", strain].map(expression);
    dataset.equation = Equation::Elasticity(Elasticity {
        young,
        poisson,
        state: StressState::PlaneStrain,
        eigenstrain: (strain != "0").then(|| Box::new(given().into())),
        anisotropy: None,
    });
    dataset
}

/// Pieces lie on one side of interfaces, straight and round, as their values are taken; where
/// nothing jumps there is no face.
#[test]
fn interfaces() {
    for (young, strain, level, jumps) in [
        ("if(2*x - y < 1.3, 1, 5)", "0", "2*x - y - 1.3", true),
        ("if(hypot(x - 0.8, y - 0.2) < 0.21, 1, 5)", "0", "hypot(x - 0.8, y - 0.2) - 0.21", true),
        ("1 + abs(x - 0.8)", "0", "x - 0.8", false),
        ("1", "if(2*x - y < 1.3, 0, 0.1)", "2*x - y - 1.3", true),
        ("1", "1 + abs(x - 0.8)", "x - 0.8", false),
    ] {
        let dataset = two_materials(young, strain);
        let field = Field::new(&dataset, 0).expect("a field");
        let level = expression(level);
        let (mut random, mut faces) = (Random(3), 0);
        let pieces = Pieces::new(&field, vec2(0.7, 0.3));
        for _ in 0..2000 {
            let inner = Rect::new(vec2(0.25, -0.25), vec2(1.5, 0.65));
            let center = random.point(&inner) - vec2(0.7, 0.3);
            let square = Rect::around(center, vec2(0.01, 0.01));
            for piece in pieces.of(&square) {
                let sign = |p: Vec2| level.value(vec2(0.7, 0.3) + p) > 0.0;
                let inside = sign(piece.center());
                let seen = |k: usize| {
                    let (a, b) = (piece.corners[k], piece.corners[(k + 1) % piece.corners.len()]);
                    [a, a * 0.7 + b * 0.3, (a + b) * 0.5].map(|p| piece.seen_from_inside(p))
                };
                for p in (0..piece.corners.len()).flat_map(seen) {
                    assert_eq!(sign(p), inside, "{young} {piece:?} {p:?}");
                }
                faces += piece.faces.iter().filter(|&&face| face).count();
            }
            assert!(Pieces::of_values(&field, vec2(0.7, 0.3)).of(&square).len() <= 1);
        }
        assert_eq!(faces > 60, jumps, "{young} {strain} {faces}");
    }
}

fn expression(text: &str) -> ppum::expression::Expression {
    text.parse().expect("a formula")
}

/// Two hundred sides in one square.
#[test]
fn many_sides() {
    let mut dataset = Recipe { cracks: vec![], ..Recipe::default() }.dataset();
    let star = |k: usize| {
        let (r, t) = (0.004 + 0.003 * (k % 2) as f64, std::f64::consts::TAU * k as f64 / 200.0);
        vec2(0.7 + r * t.cos(), 0.2 + r * t.sin())
    };
    dataset.domain.holes = vec![Hole::polygon((0..200).map(star).collect())];
    let field = Field::new(&dataset, 0).expect("a field");
    let square = Rect::around(vec2(0.001, 0.0), vec2(0.01, 0.01));
    let pieces = Pieces::new(&field, vec2(0.7, 0.2)).of(&square);
    let area: f64 = pieces.iter().map(area).sum();
    let hole = 100.0 * 0.004 * 0.007 * (std::f64::consts::TAU / 200.0).sin();
    assert!((area - (4e-4 - hole)).abs() < 1e-3 * hole, "{area:e}");
    assert!(pieces.len() < 20000, "{}", pieces.len());
}
