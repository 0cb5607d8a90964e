use super::*;
use ppum::domain::Hole;
use ppum_problem::crack;
use std::collections::BTreeSet;
use std::f64::consts::PI;

fn bounds() -> Rect {
    Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0))
}

fn domain(holes: &[Vec<Vec2>]) -> Domain {
    let holes = holes.iter().map(|points| Hole::polygon(points.clone())).collect();
    Domain { bounds: bounds(), holes }
}

fn mouths(domain: &Domain, cracks: &[&[[f64; 2]]]) -> BodyPieces {
    let along = |points: &&[[f64; 2]]| {
        Crack::polyline(points.iter().copied().map(Vec2::from).collect(), [CrackEnd::Mouth; 2])
    };
    BodyPieces::new(domain, &cracks.iter().map(along).collect::<Vec<_>>())
}

fn pieces(holes: &[Vec<Vec2>], cracks: &[&[[f64; 2]]]) -> BodyPieces {
    let along = |points: &&[[f64; 2]]| {
        crack(points.iter().copied().map(Vec2::from).collect::<Vec<_>>(), &bounds().into())
    };
    BodyPieces::new(&domain(holes), &cracks.iter().map(along).collect::<Vec<_>>())
}

fn square(center: Vec2, half: f64) -> Vec<Vec2> {
    let at = |x: f64, y: f64| center + vec2(x, y) * half;
    vec![at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)]
}

#[test]
fn tips_cut_nothing() {
    let found = pieces(&[], &[&[[-1.0, 0.0], [0.5, 0.0]], &[[0.0, 0.5], [0.3, 0.7]]]);
    assert_eq!(found.all(), [BodyPiece { area: 4.0, centroid: Vec2::ZERO, inside: Vec2::ZERO }]);
    assert_eq!(found.of(vec2(0.3, 0.3)), 0);
}

/// Three strips between kinked cracks from boundary to boundary; their areas and centroids are
/// known.
#[test]
fn cracks_from_border_to_border() {
    let found =
        pieces(&[], &[&[[-1.0, 0.25], [0.0, 0.75], [1.0, 0.25]], &[[-1.0, -0.5], [1.0, -0.5]]]);
    let above = found.of(vec2(0.0, 0.9));
    let middle = found.of(vec2(0.0, 0.6));
    let below = found.of(vec2(0.9, -0.9));
    let mut all = [above, middle, below];
    let area = |k: usize| found.all()[k].area;
    assert!((area(above) - 1.0).abs() < 1e-14 && (area(below) - 1.0).abs() < 1e-14);
    assert!((area(middle) - 2.0).abs() < 1e-14);
    assert!((found.all()[below].centroid - vec2(0.0, -0.75)).length() < 1e-14);
    all.sort_unstable();
    assert_eq!(all, [0, 1, 2]);
    // the boundary of each, seen from outside, down to the corner between crack and boundary
    assert_eq!(found.behind(vec2(-1.0, 0.25 + 1e-7), vec2(-1.0, 0.0)), above);
    assert_eq!(found.behind(vec2(-1.0, 0.25 - 1e-7), vec2(-1.0, 0.0)), middle);
    // the faces of a crack
    assert_eq!(found.behind(vec2(0.3, -0.5), vec2(0.0, -1.0)), middle);
    assert_eq!(found.behind(vec2(0.3, -0.5), vec2(0.0, 1.0)), below);
}

/// Cracks at many slopes and places: one that ends on the boundary cuts it whatever its numbers
/// are.
#[test]
fn any_slope_cuts() {
    let mut random = ppum_testkit::random::Random(3);
    for _ in 0..300 {
        let [from, kink_x, kink_y, to] = std::array::from_fn(|_| random.between(-1.0, 1.0) * 0.999);
        let found = pieces(&[], &[&[[-1.0, from], [kink_x, kink_y], [1.0, to]]]);
        assert_eq!(found.all().len(), 2, "{from} {kink_x} {kink_y} {to}");
        let total: f64 = found.all().iter().map(|piece| piece.area).sum();
        assert!((total - 4.0).abs() < 1e-12);
        assert_ne!(found.of(vec2(kink_x, kink_y + 1e-6)), found.of(vec2(kink_x, kink_y - 1e-6)));
    }
}

/// A hole and cracks from it to the boundaries cut; one crack alone does not.
#[test]
fn holes_and_cracks() {
    let hole = square(vec2(0.1, 0.0), 0.25);
    let left: &[[f64; 2]] = &[[-1.0, 0.1], [-0.1, 0.1]];
    let right: &[[f64; 2]] = &[[0.3, -0.2], [1.0, 0.7]];
    let mouths = |cracks: &[&[[f64; 2]]]| mouths(&domain(std::slice::from_ref(&hole)), cracks);
    assert_eq!(mouths(&[left]).all().len(), 1);
    let found = mouths(&[left, right]);
    let total: f64 = found.all().iter().map(|piece| piece.area).sum();
    assert_eq!(found.all().len(), 2);
    assert!((total - 3.75).abs() < 1e-12, "{total}");
    assert_ne!(found.of(vec2(-0.5, 0.5)), found.of(vec2(-0.5, -0.5)));
    assert_eq!(found.of(vec2(-0.5, 0.5)), found.of(vec2(0.1, 0.3)));
}

/// A bar of holes from boundary to boundary cuts without any crack; holes that reach over the
/// boundary are notches.
#[test]
fn holes_alone() {
    let bar = vec![vec2(-2.0, -0.1), vec2(2.0, -0.1), vec2(2.0, 0.1), vec2(-2.0, 0.1)];
    let found = pieces(std::slice::from_ref(&bar), &[]);
    let areas: Vec<_> = found.all().iter().map(|piece| piece.area).collect();
    assert!(areas.len() == 2 && areas.iter().all(|a| (a - 1.8).abs() < 1e-12), "{areas:?}");
    let notch = pieces(&[square(vec2(-1.0, 0.0), 0.5)], &[]);
    assert_eq!(notch.all().len(), 1);
    assert!((notch.all()[0].area - 3.5).abs() < 1e-12);
}

/// A chain of round holes cuts if they overlap, by however little. The first one reaches
/// the boundary.
#[test]
fn chains_of_holes() {
    let hole = |x: f64, radius| Hole::Circle { center: vec2(x, 0.1), radius };
    let chain = |radius| Domain {
        bounds: bounds(),
        holes: vec![hole(-0.8, radius), hole(-0.4, radius), hole(0.0, radius), hole(0.4, radius)],
    };
    let right: &[[f64; 2]] = &[[0.55, 0.1], [1.0, 0.3]];
    assert_eq!(mouths(&chain(0.2 + 1e-9), &[right]).all().len(), 2);
    assert_eq!(mouths(&chain(0.2 - 1e-9), &[right]).all().len(), 1);
}

/// Two cracks from a round hole to opposite sides, at any angle and place.
#[test]
fn cracks_from_a_round_hole() {
    let mut random = ppum_testkit::random::Random(11);
    for _ in 0..300 {
        let center = vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0)) * 0.3;
        let radius = 0.1 + 0.2 * random.between(0.0, 1.0);
        let around = Domain { bounds: bounds(), holes: vec![Hole::Circle { center, radius }] };
        let rim = |to: Vec2| center + (to - center).unit() * radius;
        let [left, right] =
            [vec2(-1.0, random.between(-1.0, 1.0)), vec2(1.0, random.between(-1.0, 1.0))];
        let cracks = [[left.into(), rim(left).into()], [rim(right).into(), right.into()]];
        let found = mouths(&around, &[&cracks[0], &cracks[1]]);
        assert_eq!(found.all().len(), 2, "{center:?} {radius} {left:?} {right:?}");
        assert_eq!(mouths(&around, &[&cracks[0]]).all().len(), 1);
        // in the middle of the crack, on both sides of it
        let middle = (left + rim(left)) * 0.5;
        let normal = (left - center).unit().left();
        assert_ne!(found.behind(middle, normal), found.behind(middle, -normal));
    }
}

/// Cracks that cross, branch and end on each other cut out what lies between them, whatever their
/// numbers are.
#[test]
fn cracks_that_meet() {
    let mut random = ppum_testkit::random::Random(16);
    for round in 0..200 {
        let mut point = || [random.between(-0.9, 0.9), random.between(-0.9, 0.9)];
        let corners = [point(), point(), point()];
        let [a, b, c] = corners.map(Vec2::from);
        let area = 0.5 * (b - a).cross(c - a).abs();
        if area < 1e-3 {
            continue;
        }
        let toward = |from: Vec2, to: Vec2, part: f64| <[f64; 2]>::from(from + (to - from) * part);
        let beyond =
            [[a, b], [b, c], [c, a]].map(|[p, q]| [toward(q, p, 1.001), toward(p, q, 1.001)]);
        let lines = match round % 3 {
            0 => beyond.map(|side| side.to_vec()).to_vec(),
            1 => vec![vec![corners[0], corners[1]], vec![corners[1], corners[2], corners[0]]],
            _ => {
                let middle = toward(a, b, 0.37);
                vec![
                    vec![corners[0], corners[1]],
                    vec![middle, corners[2]],
                    vec![corners[2], corners[1]],
                ]
            }
        };
        let cracks = ppum_problem::cracks(
            lines.into_iter().map(|line| line.into_iter().map(Vec2::from).collect::<Vec<_>>()),
            &bounds().into(),
        );
        let found = BodyPieces::new(&domain(&[]), &cracks);
        let cut_out = if round % 3 == 2 { 0.63 * area } else { area };
        let areas: Vec<f64> = found.all().iter().map(|piece| piece.area).collect();
        assert_eq!(areas.len(), 2, "round {round}: {corners:?} {areas:?}");
        let least = areas[0].min(areas[1]);
        assert!((least - cut_out).abs() < 1e-8, "round {round}: {least} {cut_out}");
        let inside =
            if round % 3 == 2 { a + (b - a) * 0.7 + (c - b) * 0.1 } else { (a + b + c) / 3.0 };
        assert!((found.all()[found.of(inside)].area - cut_out).abs() < 1e-8);
    }
}

/// The components of a patch agree with the pieces of a body that is the patch.
#[test]
fn pieces_of_a_box_are_its_components() {
    use ppum::function::{Function, FunctionTable, GROUP};
    let (mut random, bounds) = (ppum_testkit::random::Random(17), bounds());
    for round in 0..100 {
        let mut point = || vec2(random.between(-1.5, 1.5), random.between(-1.5, 1.5));
        let lines: Vec<Vec<Vec2>> =
            (0..2 + round % 5).map(|k| (0..2 + k % 3).map(|_| point()).collect()).collect();
        let around = Rect::around(Vec2::ZERO, vec2(9.0, 9.0)).into();
        let whole = ppum_problem::cracks(lines.iter().cloned(), &around);
        let pieces = BodyPieces::new(&domain(&[]), &whole);
        let kinds = ppum_problem::geometry::Jumps::new(&whole, &bounds.into(), 1e-9).of(&bounds);
        let functions: Vec<_> =
            kinds.into_iter().map(|kind| Function { name: "any".into(), kind }).collect();
        let table = FunctionTable::new(&functions, whole.len(), &[]).expect("jumps");
        let mut known: std::collections::BTreeMap<Vec<i64>, usize> =
            std::collections::BTreeMap::new();
        let mut numbers = std::collections::BTreeSet::new();
        for _ in 0..400 {
            let p = vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0));
            let local = table.at(&whole, p);
            let mut jets = [ppum::jet::Jet::constant(0.0); GROUP];
            let values: Vec<i64> = (0..table.groups())
                .map(|group| {
                    local.evaluate::<f64, 1>(group, [0.0; 2], Side::Above, &mut jets);
                    jets[0].v as i64
                })
                .collect();
            let piece = pieces.of(p);
            assert_eq!(*known.entry(values).or_insert(piece), piece, "round {round}: {p:?}");
            numbers.insert(piece);
        }
        assert_eq!(known.len(), numbers.len(), "round {round}: {known:?} {lines:?}");
    }
}

/// A circle of `count` arcs from an angle on, as cracks of two halves that meet each other.
fn circle(center: Vec2, radius: f64, from: f64, count: usize) -> Vec<Crack> {
    let half = |k: usize| {
        let start = from + PI * k as f64;
        let arc = Edge::around(center, radius, [start, start + PI]);
        let at = |k: usize| k as f64 / count as f64;
        let parts: Vec<Edge> = (0..count).map(|k| arc.part([at(k), at(k + 1)])).collect();
        Crack { ends: [CrackEnd::Junction; 2], ..Crack::along(&parts) }
    };
    vec![half(0), half(1)]
}

/// A closed circle cuts a disc out: points beside it, between arcs and chords, belong to the piece
/// that they lie in, whatever its arcs are and however near another circle or a round hole is.
#[test]
fn discs_are_cut_out() {
    let mut random = ppum_testkit::random::Random(18);
    for round in 0..40 {
        let center = vec2(random.between(-0.3, 0.3), random.between(-0.3, 0.3));
        let (radius, from) = (random.between(0.1, 0.4), random.between(0.0, 6.0));
        let gap = 10f64.powf(random.between(-5.0, -1.0));
        let mut cracks = circle(center, radius, from, 1 + round % 7);
        cracks.extend(circle(center, radius + gap, from + 1.0, 1 + round % 3));
        let hole = Hole::Circle { center, radius: radius - gap.min(0.5 * radius) };
        let around = Domain { bounds: bounds(), holes: Vec::new() };
        let found = BodyPieces::new(&around, &cracks);
        assert_eq!(found.all().len(), 3, "{round} {gap:e}");
        let area = found.all()[found.of(center)].area;
        assert!((area / (PI * radius * radius) - 1.0).abs() < 0.03, "{area}");
        let holed = BodyPieces::new(&Domain { bounds: bounds(), holes: vec![hole] }, &cracks);
        assert_eq!(holed.all().len(), 3, "{round} {gap:e}");
        for _ in 0..100 {
            let way = random.direction();
            let at = |r: f64| found.of(center + way * r);
            let near = 0.01 * gap;
            let rings = [radius - near, radius + near, radius + gap - near, radius + gap + near];
            let [inner, ring, same, outer] = rings.map(at);
            assert!(inner == found.of(center) && ring == same, "{round} {gap:e} {way:?}");
            assert!(outer == found.of(vec2(0.99, 0.99)) && outer != ring && ring != inner);
            let face = |k: usize| {
                let (crack, p) = (&cracks[k], center + way * radius);
                let edge = (0..crack.points.len() - 1).find(|e| crack.edge(*e).distance(p) < 1e-9);
                edge.map(|segment| SegmentId { crack: k as u32, segment: segment as u32 })
            };
            let segment = face(0).or(face(1)).expect("a face");
            let beside = |side| found.beside(CrackFace { segment, side }, center + way * radius);
            assert_eq!([Side::Above, Side::Below].map(beside), [inner, ring]);
        }
    }
}

/// Arcs cut as polylines of many of their chords do.
#[test]
fn random_arcs_cut_as_their_chords_do() {
    let mut random = ppum_testkit::random::Random(19);
    let mut several = 0;
    for round in 0..60 {
        let mut point = || vec2(random.between(-0.9, 0.9), random.between(-0.9, 0.9));
        let ends: Vec<[Vec2; 2]> = (0..4).map(|_| [point(), point()]).collect();
        let edge = |[from, to]: [Vec2; 2]| {
            let bulge = (0.25 * random.between(-4.0, 4.0)).tan();
            Edge { from, to, bulge }
        };
        let edges: Vec<Edge> = ends.into_iter().map(edge).collect();
        let crack = |edge: &Edge| Crack::along(&[*edge]);
        let chords = |edge: &Edge| Crack::polyline(edge.flattened(1e-5), [CrackEnd::Tip; 2]);
        let pieces = |cracks: Vec<Crack>| BodyPieces::new(&domain(&[]), &cracks);
        let arcs = pieces(edges.iter().map(crack).collect());
        let lines = pieces(edges.iter().map(chords).collect());
        // of the large pieces of one the places lie in different pieces of the other
        let missed = |one: &BodyPieces, other: &BodyPieces| {
            let large: Vec<_> = one.all().iter().filter(|piece| piece.area > 1e-3).collect();
            let of: BTreeSet<_> = large.iter().map(|piece| other.of(piece.inside)).collect();
            large.len() - of.len()
        };
        assert_eq!([missed(&arcs, &lines), missed(&lines, &arcs)], [0; 2], "{round} {edges:?}");
        several += usize::from(arcs.all().len() > 1);
        for _ in 0..100 {
            let pair = [(); 2].map(|()| vec2(random.between(-1.0, 1.0), random.between(-1.0, 1.0)));
            let near = |p: &Vec2| edges.iter().any(|edge| edge.distance(*p) < 1e-4);
            let same = |found: &BodyPieces| found.of(pair[0]) == found.of(pair[1]);
            assert!(pair.iter().any(near) || same(&arcs) == same(&lines), "{round} {pair:?}");
        }
    }
    assert!(several > 10, "{several}");
}
