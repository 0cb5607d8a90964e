//! Isolines against exact curves.

use super::*;
use ppum::crack::{End, LocalCrack, Side, TipId};
use ppum::dataset::{Dataset, FieldData};
use ppum::domain::Hole;
use ppum::equation::{Elasticity, Equation, StressState};
use ppum::function::{Frame, FunctionKind};
use ppum::progress::unwatched;
use ppum::segment;
use ppum::vec2::{Rect, vec2};
use ppum::weight::WeightFunction;
use ppum_raster::reference::reference;
use ppum_raster::scatter::render;
use ppum_testkit::synthetic::{Coefficients, Recipe, opening};

/// Distance from the exact curve that every point has to keep, pixels.
const DISTANCE: f64 = 0.1;

/// The lines in a view, by the raster of the reference in f64; f32 gives the same.
fn lines(field: &Field<'_>, view: &View, text: &str, levels: &[f64]) -> Vec<Isoline> {
    let quantity = Quantity::parse(text, field).expect("a quantity");
    let raster = reference(field, view, &quantity, unwatched()).expect("a raster");
    let found = isolines(field, view, &quantity, levels, &raster, unwatched()).expect("lines");
    let narrow = render::<f32>(field, view, &quantity, unwatched()).expect("a raster");
    let same = isolines(field, view, &quantity, levels, &narrow, unwatched()).expect("lines");
    assert_eq!(found, same, "the raster's precision");
    found
}

/// The points of a line and the middles between them.
fn points(line: &Isoline) -> Vec<Vec2> {
    let next = line.points.iter().skip(1);
    let middles = line.points.iter().zip(next).map(|(a, b)| (*a + *b) * 0.5);
    line.points.iter().copied().chain(middles).collect()
}

/// Polynomials of x and y from the centre of the default domain, one for each component.
fn polynomials(all: [&[f64]; 2]) -> Dataset {
    let coefficients = Coefficients::Polynomial(all.map(<[f64]>::to_vec).to_vec());
    Recipe { cracks: vec![], degrees: vec![3], coefficients, ..Recipe::default() }.dataset()
}

#[test]
fn circles_and_hyperbolas() {
    // u_x = x² + y², u_y = x y
    let dataset = polynomials([&[0.0, 0.0, 0.0, 1.0, 0.0, 1.0], &[0.0, 0.0, 0.0, 0.0, 1.0]]);
    let field = Field::new(&dataset, 0).expect("a field");
    let (domain, shift) = (dataset.domain.bounds, vec2(0.013, -0.007));
    let view = View::new(domain.center() + shift, 1.6, [161, 97]).expect("a view");
    let radii = [0.02, 0.1, 0.3, 0.45, 0.7];
    let found = lines(&field, &view, "ux", &radii.map(|r| r * r));
    for line in &found {
        for p in points(line) {
            let off = ((p + shift).length() - line.level.sqrt()).abs() / view.pixel_size();
            assert!(off < DISTANCE, "{off} {}", line.level);
        }
    }
    // four whole circles; the last is cut off by the border on four sides
    let closed: Vec<bool> = found.iter().map(|line| line.closed).collect();
    assert_eq!(closed.iter().filter(|&&closed| closed).count(), 4);
    let length = |line: &Isoline| -> f64 {
        let next = line.points.iter().cycle().skip(1);
        line.points.iter().zip(next).map(|(a, b)| (*a - *b).length()).sum()
    };
    for (line, r) in found.iter().zip(radii).take(4) {
        assert!((length(line) / (std::f64::consts::TAU * r) - 1.0).abs() < 2e-3, "{r}");
        // larger values, outside, are on the left: clockwise
        let next = line.points.iter().cycle().skip(1);
        assert!(
            line.points.iter().zip(next).map(|(a, b)| (*a + shift).cross(*b + shift)).sum::<f64>()
                < 0.0
        );
    }
    for (level, count) in [(0.02, 2), (-0.001, 2)] {
        let found = lines(&field, &view, "uy", &[level]);
        assert_eq!(found.len(), count);
        for p in found.iter().flat_map(points).map(|p| p + shift) {
            let off = (p.x * p.y - level).abs() / p.length() / view.pixel_size();
            assert!(off < DISTANCE, "{off} {p:?}");
        }
    }
}

/// Radius of the line σ_vM = `level` in the direction θ from the crack: σ_vM = √(3μ² + (λ + μ)²(1 −
/// 2ν)² cos²(θ/2)) / (2√r).
fn lobe(theta: f64, level: f64) -> f64 {
    let (mu, spread) = (0.5 / 1.3, 0.4 * (0.3 / (1.3 * 0.4) + 0.5 / 1.3));
    let square = 3.0 * mu * mu + (spread * (0.5 * theta).cos()).powi(2);
    0.25 * square / (level * level)
}

/// Lobes about a tip, down to 10⁻⁹ and 10⁻¹² of the domain, however the crack lies: one line around
/// the tip that ends on both faces.
#[test]
fn lobes_at_a_tip() {
    let tip = vec2(0.3, -0.7);
    for (width, angle) in
        [1.0, 1e-9, 1e-12].into_iter().flat_map(|w| [0.0f64, 0.6, 2.5].map(|a| (w, a)))
    {
        let d = vec2(angle.cos(), angle.sin());
        let dataset = opening(tip, d);
        let field = Field::new(&dataset, 0).expect("a field");
        let center = tip + vec2(0.03, 0.02) * width;
        let view = View::new(center, width, [81, 71]).expect("a view");
        let levels = [0.05, 0.2, 0.35].map(|r: f64| 0.42 / (r * width).sqrt());
        let found = lines(&field, &view, "von-mises", &levels);
        assert_eq!(found.len(), 3, "{width} {angle}");
        for line in &found {
            assert!(!line.closed);
            let from_tip = |p: Vec2| {
                let q = p + (center - tip);
                (q.length(), d.cross(q).atan2(d.dot(q)))
            };
            for p in points(line) {
                let (r, theta) = from_tip(p);
                let off = (r - lobe(theta, line.level)).abs() / view.pixel_size();
                assert!(off < DISTANCE, "{width} {angle} {off}");
            }
            for end in [line.points[0], line.points[line.points.len() - 1]] {
                let (r, theta) = from_tip(end);
                let off = r * theta.sin().abs() / view.pixel_size();
                assert!(off < 1e-6 && theta.abs() > 3.1, "{width} {angle} {theta}");
            }
        }
    }
}

/// Westergaard's field of mode I with K_I = 2μ √(2π): u = √r (κ − cos θ) (cos(θ/2), sin(θ/2)) along
/// and across the crack.
fn mode_one(tip: Vec2, d: Vec2) -> Dataset {
    let mut dataset = opening(tip, d);
    let step = &mut dataset.steps[0];
    let frame = Frame::Tip(TipId { crack: 0, end: End::Last });
    let mut displacement = FieldData::new("displacement", &["ux", "uy"]);
    (0..64).for_each(|_| displacement.push_patch(&[(0, 0), (1, 0)]));
    let axes = [[d.x, d.left().x], [d.y, d.left().y]];
    for (coefficients, axis) in displacement.coefficients.iter_mut().zip(axes) {
        coefficients.iter_mut().zip(axis.iter().cycle()).for_each(|(c, &part)| *c = part);
    }
    step.functions.clear();
    step.fields = vec![displacement];
    let along = FunctionKind::formula("sqrt(r)*cos(theta/2)*(1.8 - cos(theta))", frame);
    let across = FunctionKind::formula("sqrt(r)*sin(theta/2)*(1.8 - cos(theta))", frame);
    let named = step.clone().with_function("along", along).with_function("across", across);
    *step = named;
    dataset
}

/// Radius of the line σ_nn = `level`, n across the crack: σ_nn = 2μ/√r cos(θ/2) (1 + sin(θ/2)
/// sin(3θ/2)).
fn stress_lobe(theta: f64, level: f64) -> f64 {
    let shape = (0.5 * theta).cos() * (1.0 + (0.5 * theta).sin() * (1.5 * theta).sin());
    (shape / (1.3 * level)).powi(2)
}

/// Westergaard's lobes of the stress across the crack: they begin and end at the tip, tangent to
/// the faces.
#[test]
fn stress_lobes_of_mode_one() {
    let tip = vec2(-0.4, 0.2);
    for (width, angle) in [(1.0, 0.0), (1.0, 0.6), (1e-9, -2.1), (1e-12, 0.0), (1e-12, 0.6f64)] {
        let (sin, cos) = angle.sin_cos();
        let d = vec2(cos, sin);
        let dataset = mode_one(tip, d);
        let field = Field::new(&dataset, 0).expect("a field");
        let center = tip + vec2(0.03, -0.02) * width;
        let view = View::new(center, width, [121, 101]).expect("a view");
        let across =
            format!("{:?}*sxx + {:?}*syy - {:?}*sxy", sin * sin, cos * cos, 2.0 * sin * cos);
        for radius in [0.05, 0.12, 0.25] {
            let level = 1.0 / (1.3 * (radius * width).sqrt());
            let mut farthest: f64 = 0.0;
            for p in lines(&field, &view, &across, &[level]).iter().flat_map(points) {
                let q = p + (center - tip);
                let (r, theta) = (q.length(), d.cross(q).atan2(d.dot(q)));
                let exact = |theta: f64| stress_lobe(theta, level);
                let slope = (exact(theta + 1e-5) - exact(theta - 1e-5)) / 2e-5;
                let off = (r - exact(theta)).abs() / (slope / r).hypot(1.0) / view.pixel_size();
                assert!(off < DISTANCE, "{width} {angle} {theta} {off}");
                farthest = farthest.max(r);
            }
            let most =
                (0..1000).map(|k| stress_lobe(0.003 * f64::from(k), level)).fold(0.0, f64::max);
            let missed = (most - farthest) / view.pixel_size();
            assert!(missed.abs() < 0.5, "{width} {angle}: {missed}");
        }
    }
}

/// A plate with three cracks, two of them kinked, and holes. Its weights are smooth, or else
/// stresses jump on all borders of patches, as they do with linear ones, and degrees differ.
fn plate(is_smooth: bool) -> Dataset {
    let mut recipe = Recipe::random(2);
    (recipe.coefficients, recipe.extra, recipe.level) = (Coefficients::Taylor, vec![], 2);
    if is_smooth {
        (recipe.weight, recipe.degrees) = (WeightFunction::Cubic, vec![3, 2]);
    }
    let mut dataset = recipe.dataset();
    dataset.domain.holes = vec![
        Hole::Circle { center: vec2(0.5, 0.6), radius: 0.06 },
        Hole::polygon(vec![vec2(1.3, 0.1), vec2(1.4, 0.05), vec2(1.35, 0.2)]),
    ];
    dataset
}

/// How far the exact curve is from a point, by its value and gradient; beside a crack on the
/// point's side.
fn off(slope: &QuantityGradient, field: &Field<'_>, view: &View, level: f64, p: Vec2) -> f64 {
    let at = slope.at(&mut field.at(view.center), p, Side::Above);
    (at.value - level).abs() / at.gradient.length() / view.pixel_size()
}

/// Cracks that cross, branch and end on each other.
fn meeting() -> Dataset {
    let (weight, degrees) = (WeightFunction::Cubic, vec![3, 2]);
    Recipe { weight, degrees, ..Recipe::meeting() }.dataset()
}

/// Everywhere on lines the value is the level; no line crosses a crack or ends but where something
/// ends; one of each side of a lattice's edges has a line through it if it passes the level.
#[test]
fn lines_in_a_plate() {
    for (is_smooth, dataset) in [(true, plate(true)), (false, plate(false)), (true, meeting())] {
        let field = Field::new(&dataset, 0).expect("a field");
        let view = View::hug(dataset.domain.bounds, [110, 100]).expect("a view");
        let of_ux = [-0.4, 0.1, 0.5, 0.9];
        let of_stress = [0.3, 0.6, 1.0, 2.0];
        for (text, levels) in
            [("ux", of_ux), ("uy", of_ux), ("von-mises", of_stress), ("s1", of_stress)]
        {
            let quantity = Quantity::parse(text, &field).expect("a quantity");
            let slope = QuantityGradient::new(&quantity, &field).expect("a gradient");
            let found = lines(&field, &view, text, &levels);
            assert!(found.len() > 3, "{text} {}", found.len());
            for line in &found {
                let inner = line.points.iter().filter(|p| ends_beside(&field, &view, **p) > 0.01);
                let away =
                    inner.map(|p| off(&slope, &field, &view, line.level, *p)).fold(0.0, f64::max);
                assert!(away < DISTANCE || !is_smooth, "{text} {}: {away}", line.level);
                no_crack_is_crossed(&field, &view, line);
                if !line.closed {
                    for end in [line.points[0], line.points[line.points.len() - 1]] {
                        let beside = ends_beside(&field, &view, end);
                        assert!(beside < 0.03, "{text} {} ends {beside} pixels away", line.level);
                    }
                }
            }
            every_edge_is_met(&quantity, &field, &view, &levels, &found);
        }
    }
}

/// Distance to the nearest face, rim or border, pixels.
fn ends_beside(field: &Field<'_>, view: &View, offset: Vec2) -> f64 {
    let p = view.center + offset;
    let cracks = field.step.cracks.iter().map(|crack| segment::polyline_distance(&crack.points, p));
    let rims = field.domain.holes.iter().map(|hole| hole.rim_distance(p));
    let border = |b: &Rect| {
        (p.x - b.min.x)
            .abs()
            .min((b.max.x - p.x).abs())
            .min((p.y - b.min.y).abs())
            .min((b.max.y - p.y).abs())
    };
    let borders = [border(&field.domain.bounds), border(&view.rect())];
    cracks.chain(rims).chain(borders).fold(f64::INFINITY, f64::min) / view.pixel_size()
}

fn no_crack_is_crossed(field: &Field<'_>, view: &View, line: &Isoline) {
    for (crack, ends) in
        field.step.cracks.iter().map(|c| (LocalCrack::new(c, view.center), &c.points))
    {
        let segments = crack.segments();
        for (way, (segment, ends)) in line
            .points
            .windows(2)
            .flat_map(|way| segments.iter().zip(ends.windows(2)).map(move |s| (way, s)))
        {
            let [a, b] = [way[0], way[1]].map(|p| segment.distance + segment.tangent.cross(p));
            let along = segment.tangent.dot(way[0] + (way[1] - way[0]) * (a / (a - b)));
            let [lo, hi] = [ends[0], ends[1]].map(|end| segment.tangent.dot(end - view.center));
            // ends of lines lie on faces
            let apart = a.abs().min(b.abs()) > 1e-3 * view.pixel_size();
            assert!(!(apart && a * b < 0.0 && lo < along && along < hi), "{way:?}");
        }
    }
}

/// Between neighbours of the pixel lattice with values on two sides of a level, nothing between
/// them, there is a line.
fn every_edge_is_met(
    quantity: &Quantity,
    field: &Field<'_>,
    view: &View,
    levels: &[f64],
    found: &[Isoline],
) {
    let raster = reference(field, view, quantity, unwatched()).expect("a raster");
    let pieces = Pieces::new(field, view.center);
    let mut looked = 0;
    for (j, i) in (0..view.pixels[1]).flat_map(|j| (1..view.pixels[0]).map(move |i| (j, i))) {
        let [a, b] = [raster.value(i - 1, j), raster.value(i, j)];
        let [p, q] = [view.offset(i - 1, j), view.offset(i, j)];
        if pieces.may_cut(&Rect::new(p, q)) {
            continue;
        }
        for &level in levels.iter().filter(|&&l| (a > l) != (b > l)) {
            looked += 1;
            let lines = found.iter().filter(|line| line.level == level);
            let met = lines
                .flat_map(|line| &line.points)
                .any(|x| (x.y - p.y).abs() < 1e-9 * view.pixel_size() && x.x >= p.x && x.x <= q.x);
            assert!(met, "{quantity:?} {level} {p:?} {q:?}");
        }
    }
    assert!(looked > 200, "{looked}");
}

/// A row of pixels on each side of a crack: the line u_x = c of a displacement that jumps ends on
/// both faces at the places where the faces have that value.
#[test]
fn faces_have_their_own_ends() {
    let (tip, d) = (vec2(0.0, 0.0), vec2(0.8, 0.6));
    let dataset = opening(tip, d);
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::new(tip - d * 0.2, 0.3, [60, 60]).expect("a view");
    // u · e = ±√r on the faces
    let text = format!("ux*{} + uy*{}", d.left().x, d.left().y);
    for level in [0.3f64, -0.4, 0.5] {
        let found = lines(&field, &view, &text, &[level]);
        let ends =
            found.iter().flat_map(|line| [line.points[0], line.points[line.points.len() - 1]]);
        let at_face: Vec<Vec2> = ends
            .filter(|&p| d.cross(p + (view.center - tip)).abs() < 1e-6 * view.pixel_size())
            .collect();
        assert_eq!(at_face.len(), 1, "{level}");
        let r = (at_face[0] + (view.center - tip)).length();
        assert!((r - level * level).abs() < 1e-3 * view.pixel_size(), "{r} {level}");
    }
}

/// σ_xx = 3 E x² of u_x = x³ at ν = 0 jumps where E does; each side has its own line, ending at
/// the interface.
#[test]
fn interfaces_cut_lines() {
    // x³ is the seventh monomial; σ_xx = E (3x² + y) with u_x = x³ + x y
    let mut dataset = polynomials([&[0.0, 0.0, 0.0, 0.0, 1.0, 0.0, 1.0], &[]]);
    let center = dataset.domain.bounds.center();
    let young = format!("if(hypot(x - {}, y - {}) < 0.2, 1, 2)", center.x, center.y);
    dataset.equation = Equation::Elasticity(Elasticity {
        young: young.parse().expect("a formula"),
        poisson: 0.0.into(),
        state: StressState::PlaneStrain,
        eigenstrain: None,
        anisotropy: None,
    });
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::new(center, 0.6, [90, 80]).expect("a view");
    let found = lines(&field, &view, "sxx", &[0.1]);
    let (mut inside, mut outside, mut ends) = (0, 0, 0);
    for line in &found {
        let count = line.points.len();
        for (k, p) in line.points.iter().enumerate() {
            let end = !line.closed && (k == 0 || k == count - 1);
            let r = p.length();
            if end && (r - 0.2).abs() < 0.02 * view.pixel_size() {
                ends += 1;
                continue;
            }
            let young = if r < 0.2 { 1.0 } else { 2.0 };
            (inside, outside) = (inside + usize::from(r < 0.2), outside + usize::from(r >= 0.2));
            let gradient = vec2(6.0 * p.x, 1.0).length() * young;
            let off = (young * (3.0 * p.x * p.x + p.y) - 0.1).abs() / gradient / view.pixel_size();
            assert!(off < DISTANCE, "{p:?} {off}");
        }
    }
    // inside y = 0.1 − 3x², outside 0.05 − 3x²: each has two ends there
    assert_eq!(ends, 4, "{found:?}");
    assert!(inside > 20 && outside > 20);
}

#[test]
fn nothing_and_angles() {
    let dataset = polynomials([&[0.0, 1.0, 0.0, 1.0], &[0.0, 0.0, 1.0, 0.0, 1.0]]);
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::hug(dataset.domain.bounds, [60, 50]).expect("a view");
    assert_eq!(lines(&field, &view, "ux", &[]), []);
    assert_eq!(lines(&field, &view, "ux", &[9.0, f64::NAN, f64::INFINITY]), []);
    // overlap jumps only
    assert_eq!(lines(&field, &view, "overlap", &[1.5, 2.0]), []);
    let outside = View::new(vec2(9.0, 9.0), 1.0, [20, 20]).expect("a view");
    assert_eq!(lines(&field, &outside, "ux", &[0.1]), []);
    let one = View::new(dataset.domain.bounds.center(), 0.5, [1, 1]).expect("a view");
    assert_eq!(lines(&field, &one, "ux", &[0.1]).len(), 1);
}

/// One thread or three: the same lines.
#[test]
fn threads_do_not_matter() {
    let dataset = plate(true);
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::hug(dataset.domain.bounds, [90, 70]).expect("a view");
    let of = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| lines(&field, &view, "syy", &[-0.5, 0.2, 1.0]))
    };
    assert_eq!(of(1), of(3));
}

/// A view that shows mostly nothing looks at little more than the domain.
#[test]
fn the_outside_costs_nothing() {
    let dataset = plate(true);
    let field = Field::new(&dataset, 0).expect("a field");
    let center = dataset.domain.bounds.center();
    let view = View::new(center, 40.0, [500, 400]).expect("a view");
    let quantity = Quantity::parse("ux", &field).expect("a quantity");
    let raster = reference(&field, &view, &quantity, unwatched()).expect("a raster");
    let pieces = Pieces::new(&field, center);
    let looked = SampleLattice::new(&view).candidates(&raster, &[0.1, 0.5], &pieces);
    // the picture's border, and the domain with what is beside it
    let domain = (4.0 / 3.0 / 0.08 + 3.0) * (1.0 / 0.08 + 3.0);
    assert!(looked.len() < 2 * 901 + domain as usize, "{}", looked.len());
}

#[test]
fn it_can_be_stopped() {
    let dataset = plate(true);
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::hug(dataset.domain.bounds, [60, 50]).expect("a view");
    let quantity = Quantity::parse("ux", &field).expect("a quantity");
    let raster = reference(&field, &view, &quantity, unwatched()).expect("a raster");
    let stop = |_: ppum::progress::Progress| ppum::progress::Verdict::Stop;
    let found = isolines(&field, &view, &quantity, &[0.1], &raster, &stop);
    assert!(matches!(found, Err(RasterError::Cancelled(_))));
}

/// A quantity that passes thousands of levels in each pixel is refused before its lines take memory
/// without end.
#[test]
fn too_many_lines_are_refused() {
    let plain = Recipe { cracks: vec![], cells: [1, 1], level: 0, ..Recipe::default() };
    let dataset = plain.dataset();
    let field = Field::new(&dataset, 0).expect("a field");
    let view = View::hug(dataset.domain.bounds, [12, 9]).expect("a view");
    let quantity = Quantity::parse("x + 0.3*y", &field).expect("a quantity");
    let raster = render::<f64>(&field, &view, &quantity, unwatched()).expect("a raster");
    let levels: Vec<f64> = (0..100_000).map(|k| f64::from(k) * 1.8e-5).collect();
    let found = isolines(&field, &view, &quantity, &levels, &raster, unwatched());
    assert!(
        matches!(found, Err(RasterError::TooManyLines(MOST_POINTS))),
        "{:?}",
        found.map(|l| l.len())
    );
}
