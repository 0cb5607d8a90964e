use std::sync::atomic::{AtomicUsize, Ordering};

use ppum::crack::{Crack, CrackEnd, End, TipId};
use ppum::dataset::{Dataset, Equation, FieldData, Material, Step, StressState};
use ppum::domain::{Domain, Hole};
use ppum::function::{Frame, FunctionKind};
use ppum::jet::Jet;
use ppum::progress::{Progress, Verdict, unwatched};
use ppum::quantity::Quantity;
use ppum::vec2::{Rect, vec2};
use ppum::weight::WeightFunction;
use ppum_raster::reference::reference;
use ppum_testkit::exact::{CrackInPlane, ExactField};
use ppum_testkit::random::Random;
use ppum_testkit::synthetic::{Coefficients, Recipe};

use super::map::DeformationChart as _;
use super::*;

const MATERIAL: Material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };

/// One patch over [−2, 2]² on which both components are formulas: in the frame of the crack's last
/// tip if there is one.
fn by_formulas(texts: [&str; 2], crack: Option<[Vec2; 2]>) -> Dataset {
    let bounds = Rect::new(vec2(-2.0, -2.0), vec2(2.0, 2.0));
    let cover = ppum::cover::Cover::uniform(bounds, 0).unwrap();
    let partition = cover.partition(1.5, WeightFunction::Linear).unwrap();
    let mut field = FieldData::new("displacement", &["ux", "uy"]);
    for patch in 0..partition.len() {
        field.push_patch(&[(0, 0), (1, 0)]);
        field.coefficients[0][2 * patch] = 1.0;
        field.coefficients[1][2 * patch + 1] = 1.0;
    }
    let mut step = Step::new(partition);
    if let Some(ends) = crack {
        step = step.with_crack(Crack::polyline(ends.to_vec(), [CrackEnd::Tip; 2]));
    }
    let tip = Frame::Tip(TipId { crack: 0, end: End::Last });
    let frame = if crack.is_some() { tip } else { Frame::World };
    for (name, text) in ["a", "b"].into_iter().zip(texts) {
        step = step.with_function(name, FunctionKind::formula(text, frame));
    }
    Dataset::new(bounds, Equation::elasticity(MATERIAL)).with_step(step.with_field(field))
}

/// The crack of half length 0.8 about a point under all-round tension, where faces move along their
/// normals: opened it is an ellipse.
struct OpenCrackField {
    exact: CrackInPlane,
    center: Vec2,
    direction: Vec2,
}

impl OpenCrackField {
    const HALF: f64 = 0.8;

    fn new(center: Vec2, direction: Vec2) -> Self {
        Self {
            exact: CrackInPlane::biaxial(MATERIAL, center, direction, Self::HALF, 0.1),
            center,
            direction,
        }
    }

    fn dataset(&self) -> Dataset {
        let ends = [-Self::HALF, Self::HALF].map(|t| self.center + self.direction * t);
        let (a, n, kappa, scale) = (Self::HALF, 0.05, MATERIAL.kolosov(), 0.5 / MATERIAL.mu());
        // in the frame of the tip, R = √ζ √(ζ + 2a) = p + iq and z/R = zr + i zi;
        // see `CrackInPlane`
        let bind = format!(
            "let rho = sqrt(r*hypot(x + {d:?}, y)); let phi = (theta + atan2(y, x + {d:?}))/2; \
             let p = rho*cos(phi); let q = rho*sin(phi); let square = max(rho^2, 1e-300); \
             let zr = ((x + {a:?})*p + y*q)/square; let zi = (y*p - (x + {a:?})*q)/square; \
             let u = {f:?}*(({less:?})*p - 2*y*zi); let v = {f:?}*({more:?}*q - 2*y*zr); ",
            d = 2.0 * a,
            f = n * scale,
            less = kappa - 1.0,
            more = kappa + 1.0,
        );
        let Vec2 { x: c, y: s } = self.direction;
        let texts =
            [format!("{bind}({c:?})*u - ({s:?})*v"), format!("{bind}({s:?})*u + ({c:?})*v")];
        by_formulas([&texts[0], &texts[1]], Some(ends))
    }

    /// Half the opening per half length: 2μ u_n = ½ σ (κ + 1) √(a² − t²).
    fn slope() -> f64 {
        0.1 * (MATERIAL.kolosov() + 1.0) / (4.0 * MATERIAL.mu())
    }

    /// (t/a)² + (n/b)² − 1 of a place: negative inside the ellipse; and its distance to it, about.
    fn level(&self, factor: f64, place: Vec2) -> [f64; 2] {
        let d = place - self.center;
        let half = [Self::HALF, factor.abs() * Self::slope() * Self::HALF];
        let [t, n] = [self.direction.dot(d) / half[0], self.direction.cross(d) / half[1]];
        let gradient = vec2(t / half[0], n / half[1]).length() * 2.0;
        let level = t * t + n * n - 1.0;
        [level, level.abs() / gradient]
    }
}

/// Distance of the image of a found point from the pixel's centre, in pixels, by the field itself.
fn miss(view: &DeformedView<'_>, [i, j]: [u32; 2], offset: Vec2) -> f64 {
    let mut jets = [Jet::constant(0.0); 2];
    let mut local = view.field().at(view.anchor);
    assert!(local.evaluate::<0>(offset, Side::Above, &mut jets), "{offset:?}");
    let u = vec2(jets[0].v - view.reference[0], jets[1].v - view.reference[1]);
    let image = view.shift + offset + u * view.factor();
    (image - view.view.offset(i, j)).length() / view.view.pixel_size()
}

/// All points of a view move to their pixels.
fn check(points: &DeformedPoints<'_>) {
    for (i, j) in pixels(&points.view) {
        for point in points.at(i, j) {
            let miss = miss(&points.view, [i, j], point.offset);
            assert!(miss < 0.01, "{i} {j}: {miss}");
        }
    }
}

fn pixels(view: &DeformedView<'_>) -> impl Iterator<Item = (u32, u32)> + use<> {
    let [columns, rows] = view.view.pixels;
    (0..rows).flat_map(move |j| (0..columns).map(move |i| (i, j)))
}

fn deformed<'f>(field: &'f Field<'f>, factor: f64, view: &View) -> DeformedPoints<'f> {
    let points = Deformation::new(field, factor).unwrap().seen(view).points(unwatched()).unwrap();
    check(&points);
    points
}

/// Each pixel has the value of the cell in which its point lies; undeformed that is the picture of
/// the cells.
#[test]
fn cells_are_carried_along() {
    let (coefficients, degrees) = (Coefficients::Taylor, vec![2]);
    let dataset = Recipe { points: 30, coefficients, degrees, ..Recipe::random(5) }.dataset();
    let field = Field::new(&dataset, 0).unwrap();
    let cells = &field.step.partition.boxes().cell;
    let numbers: Vec<f64> = (0..cells.len()).map(|k| k as f64).collect();
    let of = |factor: f64, view: &View| {
        let deformation = Deformation::new(&field, factor).unwrap();
        deformation.seen(view).points(unwatched()).unwrap()
    };
    for view in [
        View::fit(field.domain.bounds, [60, 60]).unwrap(),
        View::new(cells[9].max, 1e-12, [9, 9]).unwrap(),
    ] {
        let same = of(0.0, &view).cells(&numbers);
        let expected = crate::cells::raster(&field, &numbers, &view);
        let pairs = same.values.values.iter().zip(&expected.values);
        assert!(pairs.clone().all(|(a, b)| a == b || a.is_nan() && b.is_nan()));
        assert!(pairs.filter(|(a, _)| a.is_finite()).count() > 40);
    }
    let view = View::fit(field.domain.bounds, [60, 60]).unwrap();
    let points = of(0.1, &view);
    let found = points.cells(&numbers);
    for (i, j) in pixels(&points.view) {
        let Some(point) = points.at(i, j).first() else {
            assert!(found.values.value(i, j).is_nan());
            continue;
        };
        let place = points.view.anchor + point.offset;
        let cell = cells[found.values.value(i, j) as usize];
        let reach = vec2(1e-12, 1e-12);
        assert!(Rect::new(cell.min - reach, cell.max + reach).contains(place), "{i} {j}");
        assert_eq!(found.overlap[(60 * j + i) as usize], points.at(i, j).len() > 1);
    }
}

/// u = G X + t in closed form: the plate is a parallelogram, its holes ellipses.
#[test]
fn affine_fields_are_inverted_exactly() {
    let mut random = Random(3);
    for case in 0..6 {
        let g: [f64; 6] = std::array::from_fn(|_| random.between(-0.4, 0.4));
        let line = |a, b, c| format!("({a:?})*x + ({b:?})*y + ({c:?})");
        let texts = [line(g[0], g[1], g[2]), line(g[3], g[4], g[5])];
        let mut dataset = by_formulas([&texts[0], &texts[1]], None);
        if case % 2 == 1 {
            let round = Hole::Circle { center: vec2(0.3, -0.4), radius: 0.7 };
            let corners = vec![vec2(-1.5, 1.0), vec2(-0.5, 0.9), vec2(-1.1, 1.6)];
            let holes = vec![round, Hole::polygon(corners)];
            dataset.domain = Domain { bounds: dataset.domain.bounds, holes };
        }
        let field = Field::new(&dataset, 0).unwrap();
        let factor = random.pick(&[1.0, -0.7, 1.5]);
        let view =
            View::new(random.point(&Rect::new(vec2(-0.5, -0.5), vec2(0.5, 0.5))), 7.0, [90, 70])
                .unwrap();
        let points = deformed(&field, factor, &view);
        let (f, d) = (
            [1.0 + factor * g[0], factor * g[1], factor * g[3], 1.0 + factor * g[4]],
            vec2(g[2], g[5]) * factor,
        );
        let determinant = f[0] * f[3] - f[1] * f[2];
        for (i, j) in pixels(&points.view) {
            let y = view.center + view.offset(i, j) - d;
            let x = vec2(f[3] * y.x - f[1] * y.y, f[0] * y.y - f[2] * y.x) / determinant;
            let found = points.at(i, j);
            let border = field.domain.bounds.distance(x).max(inner(&field.domain.bounds, x));
            let rims = field.domain.holes.iter().map(|hole| hole.rim_distance(x));
            // 0.02 pixels of the plate; strains are below 2
            if rims.fold(border, f64::min) < 0.02 * view.pixel_size() {
                continue;
            }
            assert_eq!(found.len(), usize::from(field.domain.contains(x)), "{case} {x:?}");
            if let [point] = found {
                let apart = (points.view.anchor + point.offset - x).length();
                // up to a thousandth of a pixel beside the border of a piece
                assert!(apart < 3e-3 * view.pixel_size(), "{case} {x:?} {apart}");
                assert_eq!(point.folded, determinant < 0.0);
            }
        }
    }
}

/// Distance of a point of a box to its border.
fn inner(bounds: &Rect, p: Vec2) -> f64 {
    [p.x - bounds.min.x, bounds.max.x - p.x, p.y - bounds.min.y, bounds.max.y - p.y]
        .into_iter()
        .fold(f64::INFINITY, f64::min)
}

/// A bent plate against the polygon of its border, moved point by point: what lies inside has
/// a point, also beside a crack that has not opened, a segment or arcs.
#[test]
fn a_bent_plate_fills_the_polygon_of_its_moved_border() {
    for bulge in [0.0, 0.02, 0.6, -3.0] {
        let mut dataset =
            by_formulas(["0.1*x*y - 0.15*sin(y)", "0.12*x^2 - 0.05*y*x + 0.1*cos(2*x)"], None);
        let (points, bulges) = (vec![vec2(-0.7, -0.3), vec2(0.4, 0.5)], vec![bulge]);
        dataset.steps[0].cracks.push(Crack { points, bulges, ends: [CrackEnd::Tip; 2] });
        fills_the_polygon_of_its_moved_border(&dataset);
    }
}

fn fills_the_polygon_of_its_moved_border(dataset: &Dataset) {
    let field = Field::new(dataset, 0).unwrap();
    let deformation = Deformation::new(&field, 1.3).unwrap();
    let view = View::new(vec2(0.1, 0.4), 6.5, [120, 100]).unwrap();
    let points = deformed(&field, 1.3, &view);
    let corners = [vec2(-2.0, -2.0), vec2(2.0, -2.0), vec2(2.0, 2.0), vec2(-2.0, 2.0)];
    // chords are within 10⁻³ of a pixel of the border
    let border: Vec<Vec2> = (0..4 * 500)
        .map(|k| {
            let (side, t) = (k / 500, f64::from(k % 500) / 500.0);
            let p = corners[side as usize] * (1.0 - t) + corners[(side as usize + 1) % 4] * t;
            deformation.place(p)
        })
        .collect();
    let polygon = Hole::polygon(border);
    let mut inside = 0;
    for (i, j) in pixels(&points.view) {
        let place = view.center + view.offset(i, j);
        if polygon.rim_distance(place) > 0.01 * view.pixel_size() {
            assert_eq!(points.at(i, j).len(), usize::from(polygon.contains(place)), "{place:?}");
            inside += points.at(i, j).len();
        }
    }
    assert!((3000..9000).contains(&inside), "{inside}");
}

/// The opened crack is an ellipse, whichever way it lies: empty inside, one point outside.
#[test]
fn an_opened_crack_is_an_empty_ellipse() {
    let mut random = Random(11);
    for case in 0..5 {
        let direction = if case == 0 { vec2(1.0, 0.0) } else { random.direction() };
        let center = if case == 0 {
            Vec2::ZERO
        } else {
            random.point(&Rect::new(vec2(-0.3, -0.3), vec2(0.3, 0.3)))
        };
        let opened = OpenCrackField::new(center, direction);
        let dataset = opened.dataset();
        let field = Field::new(&dataset, 0).unwrap();
        let factor = random.between(1.0, 5.0);
        let width = random.pick(&[2.0, 0.7]);
        let view =
            View::new(center + direction * random.between(-0.8, 0.8), width, [128, 96]).unwrap();
        let points = deformed(&field, factor, &view);
        let mut empty = 0;
        for (i, j) in pixels(&points.view) {
            let [level, distance] = opened.level(factor, view.center + view.offset(i, j));
            if distance < 0.03 * view.pixel_size() {
                continue;
            }
            let expected = usize::from(level > 0.0);
            assert_eq!(points.at(i, j).len(), expected, "case {case}: {i} {j}, {level} {distance}");
            empty += 1 - expected;
        }
        assert!(empty > 500, "{case}: {empty}");
    }
}

/// At 10⁻⁹ and 10⁻¹² of the plate from the moved tip, the plate that is seen lies within the square
/// of that from the tip; the opened crack's end is a straight line across its direction.
#[test]
fn the_rounded_end_of_an_opened_crack_at_any_zoom() {
    for direction in [vec2(1.0, 0.0), vec2(0.6, 0.8)] {
        let opened = OpenCrackField::new(vec2(0.1, -0.2), direction);
        let dataset = opened.dataset();
        let field = Field::new(&dataset, 0).unwrap();
        let tip = field.step.cracks[0].points[1];
        let factor = 3.0;
        for width in [1e-2, 1e-5, 1e-9, 1e-12] {
            let view =
                Deformation::new(&field, factor).unwrap().around(tip, width, [64, 64]).unwrap();
            let points = view.points(unwatched()).unwrap();
            check(&points);
            for (i, j) in pixels(&view) {
                let place = view.view.offset(i, j);
                let (ahead, beside) = (direction.dot(place), direction.cross(place));
                // ellipse about the tip: ahead = −a (1 − √(1 − (n/b)²))
                let b = factor * OpenCrackField::slope() * OpenCrackField::HALF;
                let end = -OpenCrackField::HALF * (beside / b).powi(2)
                    / (1.0 + (1.0 - (beside / b).powi(2)).sqrt());
                // displacements near the tip in f64: 10⁻¹⁶ of the plate's
                let margin = 0.03 * view.view.pixel_size() + 4e-16;
                if (ahead - end).abs() > margin {
                    let found = points.at(i, j);
                    assert_eq!(found.len(), usize::from(ahead > end), "{width:e}: {i} {j}");
                    assert!(
                        width > 1e-6
                            || found.iter().all(|p| p.offset.length() < 1e3 * width * width)
                    );
                }
            }
        }
    }
}

/// Closed beyond touching, the faces lie over each other exactly inside the same ellipse.
#[test]
fn closed_faces_overlap_in_the_ellipse() {
    let opened = OpenCrackField::new(vec2(0.05, 0.1), vec2(0.8, -0.6));
    let dataset = opened.dataset();
    let field = Field::new(&dataset, 0).unwrap();
    let view = View::new(opened.center, 1.5, [120, 120]).unwrap();
    let points = deformed(&field, -1.0, &view);
    let raster = points.raster(&Quantity::parse("uy", &field).unwrap(), unwatched()).unwrap();
    let (mut overlaps, mut single) = (0, 0);
    for (i, j) in pixels(&points.view) {
        let place = view.center + view.offset(i, j);
        let [level, distance] = opened.level(-1.0, place);
        let along = opened.direction.dot(place - opened.center).abs();
        // near the tips the plate folds ahead of the crack too
        if distance < 0.1 * view.pixel_size() || along > 0.75 * OpenCrackField::HALF {
            continue;
        }
        let found = points.at(i, j);
        assert_eq!(found.len(), if level < 0.0 { 2 } else { 1 }, "{i} {j} {level}");
        assert_eq!(raster.overlap[(j * 120 + i) as usize], level < 0.0);
        if let [a, b] = found {
            let side = |p: &MaterialPoint| {
                opened.direction.cross(points.view.anchor + p.offset - opened.center)
            };
            assert!(side(a) * side(b) < 0.0, "one of each face");
            overlaps += 1;
        } else {
            single += 1;
        }
    }
    assert!(overlaps > 300 && single > 3000, "{overlaps} {single}");
}

/// Ahead of a tip that closes the plate folds: for the map of one axis, x = X + s u(X) with u = c
/// √(X² − a²), the places that three points of the axis move to are known.
#[test]
fn a_fold_is_found() {
    let dataset = by_formulas(["0.3*sin(3*x)", "0"], None);
    let field = Field::new(&dataset, 0).unwrap();
    let view = View::new(Vec2::ZERO, 3.0, [150, 3]).unwrap();
    let points = deformed(&field, 2.0, &view);
    let value = |x: f64| x + 0.6 * (3.0 * x).sin();
    let mut folded = 0;
    for i in 0..150 {
        let place = view.offset(i, 1).x;
        // changes of sign on a fine lattice; steps of 10⁻⁴ part all roots but those next to a fold
        let lattice = |k: i32| value(f64::from(k) * 1e-4) - place;
        let roots = (-20_000..20_000).filter(|&k| lattice(k) * lattice(k + 1) < 0.0).count();
        let is_fold = |x: f64| (value(x) - place).abs() < 0.02 * view.pixel_size();
        // 1 + 1.8 cos 3x = 0
        let turn = (-1.0f64 / 1.8).acos() / 3.0;
        let turns = [turn, turn + std::f64::consts::TAU / 3.0, std::f64::consts::TAU / 3.0 - turn];
        if turns.into_iter().flat_map(|t| [t, -t]).any(is_fold) {
            continue;
        }
        assert_eq!(points.at(i, 1).len(), roots, "{place}");
        let up = points.at(i, 1).iter().filter(|point| !point.folded).count();
        assert_eq!(up, roots / 2 + 1);
        folded += usize::from(roots > 1);
    }
    assert!(folded > 25, "{folded}");
}

#[test]
fn without_displacement_nothing_changes() {
    let dataset = Recipe::default().dataset();
    let field = Field::new(&dataset, 0).unwrap();
    for view in [
        View::fit(dataset.domain.bounds, [60, 50]).unwrap(),
        View::new(vec2(0.8642, 0.2817), 1e-9, [30, 30]).unwrap(),
    ] {
        let points = deformed(&field, 0.0, &view);
        for name in ["uy", "von-mises", "weight-sum"] {
            let quantity = Quantity::parse(name, &field).unwrap();
            let same = reference(&field, &view, &quantity, unwatched()).unwrap();
            let found = points.raster(&quantity, unwatched()).unwrap();
            assert!(found.overlap.iter().all(|overlap| !overlap));
            for (a, b) in same.values.iter().zip(&found.values.values) {
                // evaluated on lanes, and from another anchor
                assert!(
                    (a - b).abs() <= 1e-12 * (1.0 + a.abs()) || a.is_nan() && b.is_nan(),
                    "{name} {a} {b}"
                );
            }
        }
    }
}

/// Every point of the plate is found again at the place it moves to, in a picture of one pixel
/// there: near kinks, faces and tips too.
#[test]
fn no_point_of_the_plate_is_lost() {
    let mut random = Random(8);
    for seed in 0..3 {
        let recipe = if seed == 0 {
            Recipe::default()
        } else {
            Recipe { coefficients: Coefficients::Taylor, degrees: vec![2], ..Recipe::random(seed) }
        };
        let dataset = recipe.dataset();
        let field = Field::new(&dataset, 0).unwrap();
        let factor = [0.4, -0.25, 0.15][seed as usize];
        let deformation = Deformation::new(&field, factor).unwrap();
        let tip = field.step.cracks[0].points[0];
        for case in 0..36 {
            let (point, pixel) = match case % 3 {
                0 => (random.point(&dataset.domain.bounds), 1e-3),
                1 => (tip + random.direction() * 10f64.powf(random.between(-8.0, -2.0)), 1e-6),
                _ => (beside_crack(&field.step.cracks[0], &mut random), 1e-5),
            };
            if !field.domain.contains(point) {
                continue;
            }
            let view = deformation.around(point, pixel, [1, 1]).unwrap();
            let points = view.points(unwatched()).unwrap();
            check(&points);
            let mut map = DeformationMap::new(&field, view.anchor);
            let image = map.image(&view, Vec2::ZERO).unwrap();
            let is_it = |found: &MaterialPoint| {
                image.carried(found.offset).length() < 0.1 * pixel
                    || found.offset.length() < 0.1 * pixel
            };
            assert!(
                points.at(0, 0).iter().any(is_it),
                "seed {seed}, case {case}: {point:?} {:?}",
                points.at(0, 0)
            );
        }
    }
}

/// A point as near as 10⁻⁹ to a crack.
fn beside_crack(crack: &Crack, random: &mut Random) -> Vec2 {
    let [a, b] = [crack.points[0], crack.points[1]];
    let height = random.pick(&[1.0, -1.0]) * 10f64.powf(random.between(-9.0, -3.0));
    a + (b - a) * random.between(0.05, 0.95) + (b - a).left() * height
}

#[test]
fn values_are_those_of_the_points() {
    let dataset = Recipe::default().dataset();
    let field = Field::new(&dataset, 0).unwrap();
    let points = deformed(&field, 0.3, &View::fit(dataset.domain.bounds, [80, 60]).unwrap());
    for name in ["ux", "von-mises"] {
        let quantity = Quantity::parse(name, &field).unwrap();
        let raster = points.raster(&quantity, unwatched()).unwrap();
        let mut local = field.at(points.view.anchor);
        for (i, j) in pixels(&points.view) {
            let found = raster.values.value(i, j);
            match points.at(i, j).first() {
                Some(point) => {
                    let exact = quantity.at(&mut local, point.offset, Side::Above);
                    assert!(
                        (found - exact).abs() < 1e-10 * (1.0 + exact.abs()),
                        "{name} {found} {exact}"
                    );
                }
                None => assert!(found.is_nan()),
            }
        }
    }
}

/// Results do not depend on threads.
#[test]
fn any_number_of_threads_finds_the_same() {
    let dataset = Recipe::default().dataset();
    let field = Field::new(&dataset, 0).unwrap();
    let find = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let view = View::fit(dataset.domain.bounds, [70, 300]).unwrap();
        let points = pool.install(|| deformed(&field, 0.5, &view));
        (points.starts, points.points)
    };
    assert_eq!(find(1), find(4));
}

#[test]
fn factors_and_fields_that_do_not_deform() {
    let dataset = Recipe::default().dataset();
    let field = Field::new(&dataset, 0).unwrap();
    assert!(matches!(Deformation::new(&field, f64::NAN), Err(DeformError::Factor(_))));
    let scalar = Recipe { components: 1, ..Recipe::default() }.dataset();
    let potential = Field::new(&scalar, 0).unwrap();
    assert!(matches!(Deformation::new(&potential, 1.0), Err(DeformError::NoDisplacement(_))));
    let automatic = automatic_factor(&[&field, &potential], &dataset.domain.bounds);
    assert!(matches!(automatic, Err(DeformError::NoDisplacement(_))));
    let view = View::fit(dataset.domain.bounds, [40, 40]).unwrap();
    let deformation = Deformation::new(&field, 1.0).unwrap();
    let stopped = deformation.seen(&view).points(&|_: Progress| Verdict::Stop);
    assert!(matches!(stopped, Err(DeformError::Cancelled(_))));
    // also in the midst of many squares of one size: few are looked at any more
    let heard = AtomicUsize::new(0);
    let impatient = |_: Progress| Verdict::go_on_unless(heard.fetch_add(1, Ordering::Relaxed) >= 9);
    let fine = View::fit(dataset.domain.bounds, [400, 400]).unwrap();
    let stopped = deformation.seen(&fine).points(&impatient);
    assert!(matches!(stopped, Err(DeformError::Cancelled(_))));
    let threads = rayon::current_num_threads();
    assert!((10..=10 + threads).contains(&heard.into_inner()));
    // a factor that throws the plate out of the picture leaves it empty
    let far = Deformation::new(&field, 1e9).unwrap().seen(&view);
    assert!(far.points(unwatched()).is_ok_and(|points| points.points.len() < 1600));
}

/// The largest displacement of the picture becomes 5 % of the plate or less, down to 2 %.
#[test]
fn automatic_factors_are_round_and_seen() {
    for scale in [1.0, 3e-7, 4e5] {
        let dataset = by_formulas([&format!("{scale:?}*x/2"), "0"], None);
        let field = Field::new(&dataset, 0).unwrap();
        let factor = automatic_factor(&[&field], &field.domain.bounds).unwrap();
        let seen = factor * scale / 4.0;
        assert!((0.4 * 0.05..=0.0500001).contains(&seen), "{factor} {seen}");
        let digit = format!("{factor:e}");
        assert!(["1e", "2e", "5e"].iter().any(|d| digit.starts_with(d)), "{digit}");
    }
    let still = by_formulas(["0", "0"], None);
    let field = Field::new(&still, 0).unwrap();
    assert_eq!(automatic_factor(&[&field], &field.domain.bounds), Ok(1.0));
    assert_eq!(automatic_factor(&[], &field.domain.bounds), Ok(1.0));
}

/// The field that the pictures of opened cracks are made of is that of the closed form.
#[test]
fn the_crack_is_that_in_the_plane() {
    let opened = OpenCrackField::new(vec2(0.1, -0.2), vec2(0.6, 0.8));
    let dataset = opened.dataset();
    let field = Field::new(&dataset, 0).unwrap();
    let mut random = Random(4);
    for _ in 0..200 {
        let p = random.point(&field.domain.bounds);
        let mut jets = [Jet::constant(0.0); 2];
        assert!(field.at(p).evaluate::<1>(Vec2::ZERO, Side::Above, &mut jets));
        for (jet, exact) in jets.iter().zip(opened.exact.evaluate(p)) {
            let apart = [jet.v - exact.value, jet.x - exact.gradient.x, jet.y - exact.gradient.y];
            assert!(
                apart.iter().all(|d| d.abs() < 1e-11 * (1.0 + exact.gradient.length())),
                "{p:?} {apart:?}"
            );
        }
    }
}

/// Faces are the halves of the ellipse, to a tenth of a pixel, without gaps.
#[test]
fn faces_are_drawn_as_the_ellipse() {
    let opened = OpenCrackField::new(vec2(-0.1, 0.2), vec2(0.6, 0.8));
    let dataset = opened.dataset();
    let field = Field::new(&dataset, 0).unwrap();
    let view = View::new(opened.center, 2.0, [400, 400]).unwrap();
    let seen = Deformation::new(&field, 2.5).unwrap().seen(&view);
    for (paths, sign) in seen.faces()[0].iter().zip([1.0, -1.0]) {
        let [path] = &paths[..] else { panic!("{} paths", paths.len()) };
        assert!((path.len() > 16) && (path.len() < 500), "{}", path.len());
        for pair in path.windows(2) {
            for t in [0.0, 0.25, 0.5, 0.75] {
                let place = view.center + pair[0] * (1.0 - t) + pair[1] * t;
                let [_, distance] = opened.level(2.5, place);
                let side = opened.direction.cross(place - opened.center) * sign;
                // next to the tips the distance is not that of the level's slope
                let along = opened.direction.dot(place - opened.center).abs();
                if along < 0.999 * OpenCrackField::HALF {
                    assert!(distance < 0.1 * view.pixel_size(), "{place:?} {distance}");
                    assert!(side > 0.0);
                }
            }
        }
        let ends = [path[0], path[path.len() - 1]]
            .map(|p| opened.direction.dot(view.center + p - opened.center));
        assert!(
            (ends[0] + OpenCrackField::HALF).abs() < 0.1 * view.pixel_size()
                && (ends[1] - OpenCrackField::HALF).abs() < 0.1 * view.pixel_size()
        );
    }
}

/// A line across an opened crack comes apart there; the border goes once around.
#[test]
fn paths_end_where_the_plate_has_come_apart() {
    let opened = OpenCrackField::new(Vec2::ZERO, vec2(1.0, 0.0));
    let mut dataset = opened.dataset();
    dataset.domain.holes.push(Hole::Circle { center: vec2(0.0, 1.5), radius: 0.3 });
    dataset.domain.holes.push(Hole::Circle { center: vec2(2.0, -2.0), radius: 0.5 });
    let field = Field::new(&dataset, 0).unwrap();
    let view = View::new(Vec2::ZERO, 5.0, [500, 500]).unwrap();
    let seen = Deformation::new(&field, 2.0).unwrap().seen(&view);
    let from = |x: f64, y: f64| vec2(x, y) - seen.anchor;
    let across = seen.paths(&[[from(0.1, -1.9), from(0.1, 0.9)]]);
    assert_eq!(across.len(), 2);
    let gap = (across[1][0] - across[0][across[0].len() - 1]).length();
    let opening = 2.0 * 2.0 * OpenCrackField::slope() * (0.8f64.powi(2) - 0.01).sqrt();
    assert!((gap / opening - 1.0).abs() < 0.01, "{gap} {opening}");
    assert_eq!(seen.paths(&[[from(0.9, -1.9), from(0.9, 0.9)]]).len(), 1);
    // through the hole
    assert_eq!(seen.paths(&[[from(0.0, 1.0), from(0.0, 1.9)]]).len(), 2);
    let outline = seen.outline([None; 2]);
    let length = |path: &Vec<Vec2>| path.windows(2).map(|p| (p[1] - p[0]).length()).sum::<f64>();
    // the box without a corner, the round hole, a quarter of the other one
    assert!((3..=5).contains(&outline.len()), "{}", outline.len());
    let plain = Deformation::new(&field, 0.0).unwrap().seen(&view).outline([None; 2]);
    let total: f64 = plain.iter().map(length).sum();
    let exact = 16.0 - 1.0 + std::f64::consts::TAU * 0.3 + std::f64::consts::FRAC_PI_2 * 0.5;
    // chords of a tenth of a pixel
    assert!((total - exact).abs() < 0.01, "{total} {exact}");
}

/// Displacements are known to 2⁻⁵² of their size alone, as are places then: pixels of deep views
/// are found for all that, and finer views refused.
#[test]
fn what_rounding_blurs_is_found() {
    let texts = ["1.3 + sqrt(r)*cos(theta/2)", "0.7 + sqrt(r)*sin(theta/2)"];
    let tip = vec2(0.5, 0.25);
    let dataset = by_formulas(texts, Some([vec2(-0.5, 0.25), tip]));
    let field = Field::new(&dataset, 0).unwrap();
    let deformation = Deformation::new(&field, 0.02).unwrap();
    for width in [1e-10, 3e-12, 3e-13] {
        let view = deformation.around(tip, width, [300, 200]).unwrap();
        let points = view.points(unwatched()).unwrap();
        let is_empty = |i: u32, j: u32| points.at(i, j).is_empty();
        let is_lost = |&(i, j): &(u32, u32)| {
            let inner = (1..299).contains(&i) && (1..199).contains(&j);
            let around = [(i + 1, j), (i.wrapping_sub(1), j), (i, j + 1), (i, j.wrapping_sub(1))];
            inner && is_empty(i, j) && around.iter().all(|&(i, j)| !is_empty(i, j))
        };
        assert_eq!(pixels(&view).filter(is_lost).count(), 0, "{width}");
        let seen = pixels(&view).filter(|&(i, j)| !is_empty(i, j)).count();
        assert!((20_000..60_000).contains(&seen), "{width}: {seen}");
    }
    let finer = deformation.around(tip, 1e-15, [300, 200]).unwrap().points(unwatched());
    assert!(matches!(finer, Err(DeformError::TooFine(_))), "{finer:?}");
    let beside = View::new(tip, 1e-14, [300, 200]).unwrap();
    let beside = deformation.seen(&beside).points(unwatched());
    assert!(matches!(beside, Err(DeformError::TooFine(_))), "{beside:?}");
}
