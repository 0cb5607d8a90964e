use ppum::crack::{Crack, CrackEnd, SegmentId, Side};
use ppum::domain::{Domain, Hole};
use ppum::edge::Edge;
use ppum::function::{Function, FunctionKind, FunctionTable, GROUP};
use ppum::jet::Jet;
use ppum::segment;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_testkit::random::Random;

use super::Components;
use crate::geometry::Jumps;

const UNIT: Rect = Rect { min: vec2(0.0, 0.0), max: vec2(1.0, 1.0) };

const GAP: f64 = 1e-9;

fn cracks(lines: &[&[[f64; 2]]]) -> Vec<Crack> {
    let crack = |line: &&[[f64; 2]]| {
        let points = line.iter().copied().map(Vec2::from).collect();
        Crack::polyline(points, [CrackEnd::Tip; 2])
    };
    lines.iter().map(crack).collect()
}

fn components(cracks: &[Crack], holes: &[&Hole]) -> Components {
    let of_crack = |(crack, c): (u32, &Crack)| {
        let edges: Vec<_> = c.edges().collect();
        (0..).zip(edges).map(move |(segment, edge)| (SegmentId { crack, segment }, edge))
    };
    Components::new(&UNIT, (0..).zip(cracks).flat_map(of_crack), holes, GAP)
}

fn count(lines: &[&[[f64; 2]]]) -> usize {
    components(&cracks(lines), &[]).count()
}

/// The number of the component at a point: that of its indicator, or the number of indicators.
struct ComponentMap<'c> {
    cracks: &'c [Crack],
    table: FunctionTable,
}

impl<'c> ComponentMap<'c> {
    fn new(cracks: &'c [Crack], components: &Components) -> Self {
        let function =
            |cuts| Function { name: "any".into(), kind: FunctionKind::Component { cuts } };
        let functions: Vec<_> = components.indicators().into_iter().map(function).collect();
        let table = FunctionTable::new(&functions, cracks.len(), &[]).expect("components");
        Self { cracks, table }
    }

    fn at(&self, p: Vec2) -> usize {
        let local = self.table.at(self.cracks, p);
        let mut jets = [Jet::constant(0.0); GROUP];
        let inside: Vec<_> = (0..self.table.groups())
            .filter(|&group| {
                local.evaluate::<f64, 1>(group, [0.0; 2], Side::Above, &mut jets);
                jets[0].v == 1.0
            })
            .collect();
        assert!(inside.len() <= 1, "{p:?} lies in {inside:?}");
        inside.first().copied().unwrap_or(self.table.groups())
    }
}

#[test]
fn what_cracks_cut_a_box_into() {
    assert_eq!(count(&[]), 1);
    assert_eq!(count(&[&[[-1.0, 0.4], [2.0, 0.6]]]), 2, "through");
    assert_eq!(count(&[&[[-1.0, 0.4], [0.5, 0.6]]]), 1, "a tip");
    assert_eq!(count(&[&[[-1.0, 0.4], [0.5, 0.6]], &[[0.5, 0.6], [2.0, 0.4]]]), 2, "end to end");
    let cross: [&[[f64; 2]]; 2] = [&[[-1.0, 0.4], [2.0, 0.6]], &[[0.3, -1.0], [0.4, 2.0]]];
    assert_eq!(count(&cross), 4);
    assert_eq!(count(&[cross[0], &[[0.3, -1.0], [0.4, 0.9]]]), 3, "a dead end behind a crossing");
    assert_eq!(count(&[&[[-1.0, 0.5], [2.0, 0.5]], &[[0.3, 0.5], [0.4, 2.0]]]), 3, "T");
    assert_eq!(count(&[&[[-1.0, 0.5], [2.0, 0.5]], &[[0.3, 0.51], [0.4, 2.0]]]), 2, "not quite");
    let star = |angle: f64| vec![[0.5, 0.5], [0.5 + angle.cos(), 0.5 + angle.sin()]];
    let arms: Vec<_> = (0..5).map(|k| star(0.3 + 1.2 * f64::from(k))).collect();
    assert_eq!(count(&arms.iter().map(Vec::as_slice).collect::<Vec<_>>()), 5, "a star");
    let z: &[[f64; 2]] = &[[-1.0, 0.2], [0.9, 0.2], [0.1, 0.8], [2.0, 0.8]];
    assert_eq!(count(&[z]), 2, "a Z");
    assert_eq!(count(&[&[[-1.0, 0.2], [0.5, 0.2], [0.5, 0.8], [-1.0, 0.8]]]), 2, "a U");
    assert_eq!(count(&[&[[-1.0, 0.2], [2.0, 0.2], [2.0, 0.8], [-1.0, 0.8]]]), 3, "two runs");
    assert_eq!(count(&[&[[-1.0, 0.5], [0.7, 0.5], [-1.0, 0.6]]]), 2, "a sharp fold");
    assert_eq!(count(&[&[[0.2, 0.2], [0.8, 0.2], [0.5, 0.7], [0.2, 0.2]]]), 2, "a closed loop");
    assert_eq!(count(&[&[[0.0, -1.0], [0.0, 2.0]]]), 1, "along the border");
    assert_eq!(count(&[&[[-1.0, 0.5], [0.3, 0.5], [0.6, 0.5], [2.0, 0.5]]]), 2, "collinear");
}

#[test]
fn ends_that_miss_by_rounding_meet() {
    for miss in [1e-17, -1e-17, 1e-14, -1e-14, 1e-11, -1e-11, 5e-10, -5e-10] {
        for slope in [0.0, 0.3, -0.7] {
            let on = |x: f64| 0.5 + slope * (x - 0.4);
            let through = [[-1.0, on(-1.0)], [2.0, on(2.0)]];
            let branch = [[0.4, on(0.4) + miss], [0.7, 3.0]];
            assert_eq!(count(&[&through, &branch]), 3, "{miss} {slope}");
            let other = [[0.4, on(0.4) - miss], [0.2, -3.0]];
            assert_eq!(count(&[&through, &branch, &other]), 4, "{miss} {slope}");
        }
    }
}

/// Cracks that go on from each other at angles down to what counts as none: no way leads through
/// where they meet, also on the last one that is cut by.
#[test]
fn joints_of_small_angles_are_closed() {
    let mut random = Random(19);
    for _ in 0..2000 {
        let joint = random.point(&UNIT) * 0.6 + vec2(0.2, 0.2);
        let along = random.direction();
        let apex = joint + along.left() * 10f64.powf(-random.between(2.0, 8.0));
        let [left, right] = [-3.0, 3.0].map(|s| (joint + along * s).into());
        let (apex, end) = (apex.into(), (joint + along.left() * 3.0).into());
        assert_eq!(count(&[&[left, apex], &[apex, right]]), 2, "{left:?} {apex:?} {right:?}");
        assert_eq!(count(&[&[left, apex, right]]), 2, "{left:?} {apex:?} {right:?}");
        assert_eq!(count(&[&[apex, end], &[left, apex, right]]), 3, "{left:?} {apex:?} {right:?}");
    }
}

#[test]
fn cracks_that_end_on_holes() {
    let circle = Hole::Circle { center: vec2(0.5, 0.5), radius: 0.2 };
    let left: &[[f64; 2]] = &[[-1.0, 0.5], [0.3, 0.5]];
    let right: &[[f64; 2]] = &[[0.7, 0.5], [2.0, 0.5]];
    let on = |lines: &[&[[f64; 2]]], hole: &Hole| components(&cracks(lines), &[hole]).count();
    assert_eq!(on(&[left], &circle), 1, "round the hole");
    assert_eq!(on(&[left, right], &circle), 2);
    assert_eq!(on(&[&[[-1.0, 0.5], [2.0, 0.5]]], &circle), 2, "through it");
    let wall = [[0.4, -0.5], [3.0, -0.5], [3.0, 3.0], [0.4, 3.0]];
    let wall = Hole::polygon(wall.map(Vec2::from).to_vec());
    assert_eq!(on(&[&[[-1.0, 0.5], [0.45, 0.5]]], &wall), 2, "up to a wall");
    assert_eq!(on(&[&[[-1.0, 0.5], [0.35, 0.5]]], &wall), 1, "not quite");
}

/// A random network on the unit box: a way that meets no crack does not leave its component. The
/// ways lead along the edges of a fine grid. That components are not larger is held by
/// `equilibrium::pieces`, which finds them otherwise.
#[test]
fn components_are_what_ways_lead_to() {
    const N: usize = 96;
    let mut random = Random(16);
    for round in 0..30 {
        let n = 1 + random.below(5);
        let mut point = || [random.between(-0.3, 1.3), random.between(-0.3, 1.3)];
        let lines: Vec<Vec<[f64; 2]>> =
            (0..n).map(|k| (0..2 + k % 3).map(|_| point()).collect()).collect();
        let cracks = cracks(&lines.iter().map(Vec::as_slice).collect::<Vec<_>>());
        let components = components(&cracks, &[]);
        let map = ComponentMap::new(&cracks, &components);
        let place = |k: usize| {
            let at = |k: usize| (k as f64 + 0.4871) / N as f64;
            vec2(at(k % N), at(k / N))
        };
        let is_free = |p: Vec2, q: Vec2| {
            let all = cracks.iter().flat_map(|c| c.points.windows(2));
            all.into_iter().all(|s| !crosses([s[0], s[1]], [p, q]))
        };
        let of: Vec<_> = (0..N * N).map(|k| map.at(place(k))).collect();
        let mut seen = vec![false; N * N];
        for start in 0..N * N {
            if seen[start] {
                continue;
            }
            let mut open = vec![start];
            seen[start] = true;
            while let Some(k) = open.pop() {
                assert_eq!(of[k], of[start], "round {round}: {:?} {:?}", place(k), place(start));
                let beside = [
                    (k % N > 0).then(|| k - 1),
                    (k % N + 1 < N).then(|| k + 1),
                    k.checked_sub(N),
                    Some(k + N).filter(|&k| k < N * N),
                ];
                for next in beside.into_iter().flatten() {
                    if !seen[next] && is_free(place(k), place(next)) {
                        seen[next] = true;
                        open.push(next);
                    }
                }
            }
        }
    }
}

fn crosses([a, b]: [Vec2; 2], [p, q]: [Vec2; 2]) -> bool {
    let side = |a: Vec2, b: Vec2, p: Vec2| (b - a).cross(p - a) > 0.0;
    side(a, b, p) != side(a, b, q) && side(p, q, a) != side(p, q, b)
}

/// Random networks of arcs and segments cut a box like polylines that follow them; where the side
/// of an arc does not tell two parts beyond it apart they may be one.
#[test]
fn arcs_cut_like_polylines() {
    let mut random = Random(18);
    let (mut merged, mut cut) = (0, 0);
    for round in 0..200 {
        let n = 1 + random.below(4);
        let mut curved = |k: usize| {
            let mut point = || vec2(random.between(-0.3, 1.3), random.between(-0.3, 1.3));
            let points: Vec<Vec2> = (0..2 + k % 2).map(|_| point()).collect();
            let bulges =
                points[1..].iter().map(|p| if p.x > 1.0 { 0.0 } else { 0.25 * (p.y - 0.3) });
            Crack { bulges: bulges.collect(), points, ..Crack::default() }
        };
        let arcs: Vec<Crack> = (0..n).map(&mut curved).collect();
        let flat = |crack: &Crack| {
            let points = crack.edges().flat_map(|edge| edge.flattened(2e-5)).collect::<Vec<_>>();
            let mut points = points;
            points.dedup();
            Crack::from(points)
        };
        let lines: Vec<Crack> = arcs.iter().map(flat).collect();
        let [arcs_cut, lines_cut] = [&arcs, &lines].map(|cracks| components(cracks, &[]));
        let maps = (ComponentMap::new(&arcs, &arcs_cut), ComponentMap::new(&lines, &lines_cut));
        let mut pairs = std::collections::BTreeSet::new();
        for _ in 0..400 {
            let p = random.point(&UNIT);
            if arcs.iter().all(|crack| crack.distance(p) > 1e-3) {
                pairs.insert((maps.0.at(p), maps.1.at(p)));
            }
        }
        let is_finer = pairs.iter().any(|a| pairs.iter().any(|b| a.1 == b.1 && a.0 != b.0));
        assert!(!is_finer, "round {round}: {arcs:?} {pairs:?}");
        cut += usize::from(lines_cut.count() > 1);
        merged += usize::from(arcs_cut.count() != lines_cut.count());
    }
    assert!(cut > 80 && merged < cut / 5, "{merged} of {cut}");
}

/// Arcs that end on others, up to rounding, and whole circles leave no way.
#[test]
fn arcs_that_meet() {
    let mut random = Random(20);
    for _ in 0..500 {
        let through = [vec2(-1.0, random.between(0.2, 0.8)), vec2(2.0, random.between(0.2, 0.8))];
        let crack =
            |points: Vec<Vec2>, bulges: Vec<f64>| Crack { points, bulges, ..Crack::default() };
        let [bulge, other] = [(); 2].map(|()| random.between(-0.1, 0.1));
        let arc = Edge { from: through[0], to: through[1], bulge };
        let at = arc.at(random.between(0.4, 0.6));
        let miss = vec2(0.0, random.pick(&[0.0, 1e-17, -1e-14, 1e-11, 4e-10]));
        let up = crack(vec![at + miss, vec2(at.x + 0.1, 3.0)], vec![other]);
        let down = crack(vec![vec2(at.x - 0.1, -3.0), at - miss], vec![other]);
        let cracks = [crack(through.to_vec(), vec![bulge]), up, down];
        assert_eq!(components(&cracks[..1], &[]).count(), 2, "{cracks:?}");
        assert_eq!(components(&cracks[..2], &[]).count(), 3, "{cracks:?}");
        assert_eq!(components(&cracks, &[]).count(), 4, "{cracks:?}");
        let reversed = cracks.map(|crack| crack.reversed());
        assert_eq!(components(&reversed, &[]).count(), 4, "{reversed:?}");
        let [a, b] = [vec2(0.5, 0.4), vec2(0.5, random.between(0.6, 0.8))];
        let circle = [crack(vec![a, b, a], vec![1.0, 1.0])];
        assert_eq!(components(&circle, &[]).count(), 2);
        let lens = [crack(vec![a, b], vec![1.0]), crack(vec![a, b], vec![-0.4])];
        assert_eq!(components(&lens, &[]).count(), 2);
        let hole = Hole::Circle { center: vec2(0.5, 0.5), radius: 0.15 };
        // bent to one side: a part that only a hole divides, between two lines or circles, is one
        let way = random.pick(&[-1.0, 1.0]);
        let arms = [[-1.0, 0.36], [0.64, 2.0]].map(|[from, to]| {
            crack(vec![vec2(from, 0.5), vec2(to, 0.5)], vec![way * random.between(0.0, 0.02)])
        });
        assert_eq!(components(&arms[..1], &[&hole]).count(), 1);
        assert_eq!(components(&arms, &[&hole]).count(), 2);
    }
}

/// A crack whose segment goes on smoothly in an arc up to a hole has its side there.
#[test]
fn smooth_joints_have_sides() {
    let bounds = Rect::new(vec2(-2.0, -2.0), vec2(2.0, 2.0));
    let hole = Hole::Circle { center: vec2(0.8, 0.95), radius: 0.16 };
    let domain = Domain { bounds, holes: vec![hole] };
    let of = |points: Vec<Vec2>, bulges: Vec<f64>| {
        let cracks = crate::cracks([Crack { points, bulges, ..Crack::default() }], &domain);
        assert_eq!(cracks[0].ends, [CrackEnd::Tip, CrackEnd::Mouth]);
        Jumps::new(&cracks, &domain, GAP).of(&UNIT)
    };
    let (at, end, bulge) = (vec2(0.5, 0.5), vec2(0.8, 0.8), (std::f64::consts::PI / 8.0).tan());
    let smooth = of(vec![vec2(-1.0, 0.5), at, end], vec![0.0, bulge]);
    assert_eq!(smooth, [FunctionKind::Side { crack: 0 }]);
}

/// Beside the faces, from 1e-3 to 1e-15 away: the component jumps where two components meet and
/// nowhere else; on a face that is known the side decides.
#[test]
fn at_the_faces_of_a_star() {
    let mut random = Random(17);
    for _ in 0..40 {
        let centre = vec2(random.between(0.2, 0.8), random.between(0.2, 0.8));
        let first = random.between(0.0, 6.0);
        let arms: Vec<[[f64; 2]; 2]> = (0..3)
            .map(|k| {
                let angle = first + 2.0 * f64::from(k);
                let end = centre + vec2(angle.cos(), angle.sin()) * 2.0;
                if random.below(2) == 0 {
                    [centre.into(), end.into()]
                } else {
                    [end.into(), centre.into()]
                }
            })
            .collect();
        let cracks = cracks(&arms.iter().map(|a| a.as_slice()).collect::<Vec<_>>());
        let components = components(&cracks, &[]);
        assert_eq!(components.count(), 3);
        let map = ComponentMap::new(&cracks, &components);
        for (crack, [a, b]) in (0..).zip(&arms) {
            let [a, b] = [*a, *b].map(Vec2::from);
            let outward =
                if (a - centre).length() < 1e-9 { (b - a).unit() } else { (a - b).unit() };
            let p = centre + outward * 10f64.powf(random.between(-6.0, -0.8));
            let normal = (b - a).unit().left();
            let [above, below] = [1e-9, -1e-9].map(|d| map.at(p + normal * d));
            assert_ne!(above, below);
            let on = map.table.on(&cracks, SegmentId { crack, segment: 0 }, p);
            let mut jets = [Jet::constant(0.0); GROUP];
            for (side, expected) in [(Side::Above, above), (Side::Below, below)] {
                let noise = normal * random.between(-1e-16, 1e-16);
                let is_in = (0..2).find(|&group| {
                    on.evaluate::<f64, 1>(group, noise.into(), side, &mut jets);
                    jets[0].v == 1.0
                });
                assert_eq!(is_in.unwrap_or(2), expected);
            }
            assert!(segment::distance([a, b], p) < 1e-15);
        }
    }
}
