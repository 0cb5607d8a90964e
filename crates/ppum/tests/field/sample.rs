//! Sampled values are those of the field, point by point.

use std::sync::atomic::{AtomicUsize, Ordering};

use crate::support::compiled;
use ppum::crack::{CrackEnd, Side};
use ppum::field::Field;
use ppum::progress::{Cancelled, Phase, Progress, Verdict, unwatched};
use ppum::quantity::Quantity;
use ppum::sample::{
    SamplePoints, SidedPoint, batches, crowded, evaluate, evaluate_batch, evenly, grid, line,
    points,
};
use ppum::vec2::{Vec2, vec2};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Recipe, crack};

fn quantities(field: &Field<'_>) -> Vec<Quantity> {
    let parse = |name| Quantity::parse(name, field).expect("a quantity of elasticity");
    ["ux", "uy", "von-mises"].map(parse).to_vec()
}

/// Compares with the scalar evaluation: rounding, with the anchors of blocks at most a plate away.
fn assert_exact(field: &Field<'_>, places: &[SidedPoint]) {
    let quantities = quantities(field);
    let rows = evaluate(field, &quantities, places, unwatched()).expect("nobody stops it");
    assert_eq!(rows.len(), places.len() * quantities.len());
    for (place, row) in places.iter().zip(rows.chunks(quantities.len())) {
        let mut local = place.seen(field);
        for (quantity, &found) in quantities.iter().zip(row) {
            let exact = quantity.at(&mut local, place.offset, place.side);
            let is_near = (found - exact).abs() <= 1e-10 * exact.abs().max(1.0);
            let is_same = found == exact || found.is_nan() && exact.is_nan();
            assert!(is_near || is_same, "{place:?}: {found} {exact}");
        }
    }
}

#[test]
fn lines_grids_and_cracks() {
    let dataset = Recipe::default().dataset();
    let field = compiled(&dataset);
    let (cracks, bounds) = (&field.step.cracks, field.domain.bounds);
    assert_exact(&field, &line(cracks, [bounds.min, bounds.max], &evenly(401)));
    assert_exact(&field, &grid(cracks, bounds, [41, 31]));
    let along = SamplePoints::along(cracks, 0, &evenly(101)).expect("a crack").places();
    assert_exact(&field, &along);
    let outside = points(cracks, &[bounds.max + vec2(1.0, 0.0)]);
    let rows = evaluate(&field, &quantities(&field), &outside, unwatched());
    assert!(rows.expect("nobody stops it").iter().all(|value| value.is_nan()));
    assert!(SamplePoints::along(cracks, cracks.len() as u32, &evenly(9)).is_none());
}

/// In whatever order the batches are taken.
#[test]
fn batches_are_all_places() {
    let dataset = Recipe::default().dataset();
    let (field, bounds) = (compiled(&dataset), dataset.domain.bounds);
    let places = line(&field.step.cracks, [bounds.min, bounds.max], &evenly(3000));
    let (quantities, parts) = (quantities(&field), batches(&places).collect::<Vec<_>>());
    assert!(parts.len() > 2 && parts.iter().all(|part| !part.is_empty()));
    assert_eq!(parts.concat(), places);
    let mut rows: Vec<_> =
        parts.iter().rev().map(|part| evaluate_batch(&field, &quantities, part)).collect();
    rows.reverse();
    let bits = |rows: &[f64]| rows.iter().map(|value| value.to_bits()).collect::<Vec<_>>();
    let at_once = evaluate(&field, &quantities, &places, unwatched()).expect("nobody stops it");
    assert_eq!(bits(&rows.concat()), bits(&at_once));
}

#[test]
fn points_on_cracks_have_two_sides() {
    let cracks = [crack(&[[0.0, 0.0], [1.0, 1.0]], [CrackEnd::Tip; 2])];
    let places = points(&cracks, &[vec2(0.5, 0.5), vec2(0.5, 0.6), vec2(1.0, 1.0)]);
    let told: Vec<_> = places.iter().map(|place| (place.point.y, place.mark())).collect();
    assert_eq!(told, [(0.5, 1.0), (0.5, -1.0), (0.6, 0.0), (1.0, 0.0)]);
}

/// Arc lengths, points and directions of a crack of two segments, 3 and 4 long.
#[test]
fn stations_of_a_bent_crack() {
    let cracks = [crack(&[[0.0, 0.0], [3.0, 0.0], [3.0, 4.0]], [CrackEnd::Tip; 2])];
    let stations = SamplePoints::along(&cracks, 0, &evenly(8)).expect("a crack");
    for (k, station) in (0..).map(f64::from).zip(stations.all()) {
        let point = if k < 3.0 { vec2(k, 0.0) } else { vec2(3.0, k - 3.0) };
        let tangent = if k < 3.0 { vec2(1.0, 0.0) } else { vec2(0.0, 1.0) };
        assert_eq!((station.s, station.point(), station.tangent), (k, point, tangent));
        // what opens a crack points to its left, that is above
        assert_eq!(station.opening(tangent.left() * 2.0 + tangent), [2.0, 1.0]);
    }
    let sides: Vec<_> = stations.places().iter().map(|place| place.side).collect();
    assert_eq!(sides, [[Side::Above; 8], [Side::Below; 8]].concat());
    let at = |k: usize| stations.places()[k];
    assert_eq!((at(7).anchor, at(7).offset), (vec2(3.0, 4.0), Vec2::ZERO));
}

/// Between points that crowd at tips the square root of the distance to the nearest tip changes as
/// little as it does in between: by some 1/n, not by 1/√n.
#[test]
fn points_crowd_at_tips() {
    let mut random = Random(8);
    for _ in 0..200 {
        let mut tips: Vec<f64> = (0..random.below(4)).map(|_| random.unit()).collect();
        tips.extend([0.0, 1.0].into_iter().filter(|_| random.unit() < 0.5));
        tips.sort_by(f64::total_cmp);
        let count = 50 + random.below(300);
        let parts = crowded(count, &tips);
        assert_eq!((parts.len(), parts[0], parts[count - 1]), (count, 0.0, 1.0), "{tips:?}");
        assert!(parts.windows(2).all(|two| two[0] < two[1]), "{tips:?}");
        if tips.is_empty() {
            assert_eq!(parts, evenly(count));
        }
        let root = |part: f64| tips.iter().map(|tip| (part - tip).abs()).fold(1.0, f64::min).sqrt();
        let ends = [0.0].iter().chain(&tips).zip(tips.iter().chain(&[1.0]));
        let pieces = ends.map(|(a, b)| b - a).filter(|piece| *piece > 0.0);
        let shortest = pieces.fold(1.0, f64::min);
        // 3 t² of a piece near its end, t in steps of 1/(n · piece)
        let most = 2.0 * (3.0 / shortest).sqrt() / (count - 1) as f64;
        for two in parts.windows(2) {
            assert!((root(two[1]) - root(two[0])).abs() <= most, "{two:?} {tips:?}");
        }
    }
}

#[test]
fn a_watcher_follows_and_stops() {
    let dataset = Recipe::default().dataset();
    let (field, bounds) = (compiled(&dataset), dataset.domain.bounds);
    let (places, heard) = (line(&[], [bounds.min, bounds.max], &evenly(3000)), AtomicUsize::new(0));
    let stop_at_third = |progress: Progress| {
        assert_eq!((progress.phase, progress.total), (Phase::Evaluation, 3000));
        Verdict::go_on_unless(heard.fetch_add(1, Ordering::Relaxed) == 2)
    };
    let stopped = evaluate(&field, &quantities(&field), &places, &stop_at_third);
    assert_eq!((stopped, heard.into_inner()), (Err(Cancelled), 3));
}
