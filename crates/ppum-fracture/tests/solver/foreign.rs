//! Factors of fields that no solver of ours made: on covers without cells, and on meshes.

use crate::studies::plates::pulled;
use crate::studies::support::solved;
use faer::Mat;
use faer::linalg::solvers::Solve as _;
use ppum::crack::{Crack, CrackEnd, End, TipId};
use ppum::dataset::{
    BoxPartition, Dataset, Equation, FieldData, Material, Step, StressState, TipIntensity, Warning,
    WarningKind,
};
use ppum::domain::Domain;
use ppum::function::{Frame, FunctionKind, Role};
use ppum::polynomial::PolynomialSpace::Total;
use ppum::progress::unwatched;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;
use ppum_fracture::diagnostics::recompute;
use ppum_fracture::intensity::{TipObstacle, clearance, on_circle};
use ppum_testkit::exact::Williams;
use ppum_testkit::meshes::{BivariatePolynomial, MeshBuilder};
use ppum_testkit::random::Random;
use std::f64::consts::{PI, TAU};

const MATERIAL: Material = Material { young: 2.0, poisson: 0.3, state: StressState::PlaneStrain };
const K: [f64; 2] = [1.3, -0.7];
const T: f64 = 0.4;
const TIP: TipId = TipId { crack: 0, end: End::Last };

/// The functions √r cos θ/2, √r sin θ/2, √r sin θ sin θ/2, √r sin θ cos θ/2 of the tip.
const TEXTS: [&str; 4] = [
    "sqrt(r)*cos(theta/2)",
    "sqrt(r)*sin(theta/2)",
    "sqrt(r)*sin(theta)*sin(theta/2)",
    "sqrt(r)*sin(theta)*cos(theta/2)",
];

/// A straight crack from a mouth to its tip.
fn crack(from: Vec2, tip: Vec2) -> Crack {
    Crack::polyline(vec![from, tip], [CrackEnd::Mouth, CrackEnd::Tip])
}

/// A vector of a frame with this x axis in the world.
fn world(axis: Vec2, [x, y]: [f64; 2]) -> [f64; 2] {
    (axis * x + axis.left() * y).into()
}

/// What Williams' singular field is of the functions, in the world.
fn singular(axis: Vec2) -> [[f64; 2]; 4] {
    let kappa = MATERIAL.kolosov();
    let unit = 1.0 / (2.0 * MATERIAL.mu() * TAU.sqrt());
    let [a, b] = K.map(|k| k * unit);
    let all = [
        [a * (kappa - 1.0), -b * (kappa - 1.0)],
        [b * (kappa + 1.0), a * (kappa + 1.0)],
        [a, b],
        [b, -a],
    ];
    all.map(|pair| world(axis, pair))
}

/// The displacement of the stress T along an axis.
fn linear(axis: Vec2, from: Vec2) -> [f64; 2] {
    let strain = T / MATERIAL.effective_young();
    let across = -MATERIAL.poisson / (1.0 - MATERIAL.poisson) * strain;
    world(axis, [strain * axis.dot(from), across * axis.cross(from)])
}

/// A step without patches with the functions of the tip.
fn step(mut step: Step, crack: Crack) -> Step {
    step = step.with_function("one", FunctionKind::One);
    for text in TEXTS {
        let (frame, declared) = (Frame::Tip(TIP), Default::default());
        let (parameters, role) = (Vec::new(), Role::Tip);
        let kind = FunctionKind::Formula { text: text.into(), frame, parameters, declared, role };
        step = step.with_function(text, kind);
    }
    step.cracks.push(crack);
    step
}

fn displacement() -> FieldData {
    FieldData::new("displacement", &["ux", "uy"])
}

/// The factors of the only tip, and the warnings.
fn factors(dataset: &Dataset) -> (TipIntensity, Vec<Warning>) {
    let (tips, warnings) = recompute(dataset, 0, None, unwatched()).expect("factors");
    let [tip] = &tips[..] else { panic!("{tips:?}") };
    (tip.factors.clone().expect("room"), warnings)
}

fn assert_exact(name: &str, dataset: &Dataset, tolerance: f64) {
    let (found, warnings) = factors(dataset);
    // the field is that of the tip, so that few elements in a disc cost no digits
    let of_size = [WarningKind::Coarse, WarningKind::LittleRoom];
    let told: Vec<_> = warnings.iter().filter(|one| !of_size.contains(&one.kind)).collect();
    assert!(told.is_empty(), "{name}: {told:?}");
    let size = K[0].hypot(K[1]);
    let error = (found.k1 - K[0]).hypot(found.k2 - K[1]) / size;
    let t = found.t_stress.expect("T");
    let released = size * size / MATERIAL.effective_young();
    let j = found.j.expect("J") / released - 1.0;
    println!("{name}: K {error:.1e}, T {:.1e}, J {j:.1e}, {:?}", t - T, found.rings);
    assert!(error < tolerance && (t - T).abs() < 10.0 * tolerance, "{name}: {error:e} {t}");
    assert!(j.abs() < 10.0 * tolerance, "{name}: {j:e}");
    for ring in &found.rings {
        assert!((ring.k1 - K[0]).hypot(ring.k2 - K[1]) < tolerance * size, "{name}: {ring:?}");
    }
}

/// Boxes of all sizes anywhere that cover [−1, 1]², with a field of the tip in each.
fn boxes(random: &mut Random, angle: f64) -> Dataset {
    let axis = vec2(angle.cos(), angle.sin());
    let tip = vec2(random.between(-0.2, 0.2), random.between(-0.2, 0.2));
    let mut partition = BoxPartition { weight: WeightFunction::Quadratic, ..BoxPartition::EMPTY };
    for (i, j) in (0..9).flat_map(|j| (0..9).map(move |i| (i, j))) {
        let mut around = |k: i32| 0.25 * f64::from(k - 4) + random.between(-0.08, 0.08);
        partition.center.push(vec2(around(i), around(j)));
        let half = vec2(random.between(0.23, 0.45), random.between(0.23, 0.45));
        partition.half.push(half);
        partition.origin.push(random.point(&Rect::around(Vec2::ZERO, vec2(1.0, 1.0))));
        partition.scale.push(half * random.between(0.5, 2.0));
        partition.point.push(None);
    }
    let (n, mut field) = (partition.len(), displacement());
    for patch in 0..n {
        field.push_patch(&[(0, 1), (1, 0), (2, 0), (3, 0), (4, 0)]);
        let (origin, scale) = (partition.origin[patch], partition.scale[patch]);
        let along = [vec2(scale.x, 0.0), vec2(0.0, scale.y)].map(|way| linear(axis, way));
        let constant = linear(axis, origin - tip);
        for (k, out) in field.coefficients_mut(patch).enumerate() {
            let own = [constant[k], along[0][k], along[1][k]];
            let all = own.into_iter().chain(singular(axis).map(|pair| pair[k]));
            out.iter_mut().zip(all).for_each(|(out, c)| *out = c);
        }
    }
    let step = step(Step::new(partition), crack(tip - axis * 3.0, tip)).with_field(field);
    let bounds = Rect::around(Vec2::ZERO, vec2(1.0, 1.0));
    let domain = Domain { bounds, holes: Vec::new() };
    Dataset::new(domain, Equation::elasticity(MATERIAL)).with_step(step)
}

#[test]
fn tips_on_boxes_without_cells() {
    let mut random = Random(21);
    for angle in [0.0, 0.7, -2.1] {
        let dataset = boxes(&mut random, angle);
        assert_exact(&format!("boxes, {angle}"), &dataset, 1e-10);
    }
}

/// What is integrated does not depend on the cells: a solution has the same factors without its
/// own.
#[test]
fn solutions_without_their_cells() {
    let square = Rect::around(Vec2::ZERO, vec2(1.0, 1.0));
    let crack: &[[f64; 2]] = &[[-0.4, -0.15], [0.35, 0.2]];
    let mut dataset = solved(&pulled(square, [14, 14], &[crack]));
    let (known, _) = recompute(&dataset, 0, None, unwatched()).expect("factors");
    let boxes = dataset.steps[0].partition.boxes_mut().expect("boxes");
    (boxes.cell, boxes.level) = (Vec::new(), Vec::new());
    let (found, _) = recompute(&dataset, 0, None, unwatched()).expect("factors");
    assert_eq!(known.len(), found.len());
    for (known, found) in known.iter().zip(&found) {
        let [a, b] = [known, found].map(|tip| tip.factors.as_ref().expect("factors"));
        let size = a.k1.hypot(a.k2);
        println!("{:.1e} {:.1e}", a.k1 / b.k1 - 1.0, (a.k2 - b.k2) / size);
        assert!((a.k1 - b.k1).hypot(a.k2 - b.k2) < 1e-8 * size, "{a:?} {b:?}");
        let radius = 0.5 * found.clearance.radius;
        let on = on_circle(&dataset, 0, found.tip, radius, None, unwatched()).expect("a circle");
        assert!((on.k1 - a.k1).abs() < 1e-2 * size);
    }
}

/// A mesh of [−1, 1]² under a map of the plane, with a crack from beyond the left to the middle.
struct Plate {
    elements: MeshBuilder,
    axis: Vec2,
    tip: Vec2,
    from: Vec2,
}

impl Plate {
    /// The plate turned by an angle, after (x, y) ↦ (x + bend y², y + bend x y), in n × n squares,
    /// some or all of which are cut into triangles.
    fn new(n: i32, angle: f64, bend: f64, is_cut: impl Fn(i32, i32) -> bool) -> Self {
        let (x, y) = (
            BivariatePolynomial::linear(-1.0, 2.0, 0.0),
            BivariatePolynomial::linear(-1.0, 0.0, 2.0),
        );
        let bent = BivariatePolynomial::linear(bend, 0.0, 0.0);
        let moved = [x.plus(&bent.times(&y.times(&y))), y.plus(&bent.times(&x.times(&y)))];
        let (axis, tip) = (vec2(angle.cos(), angle.sin()), vec2(0.3, -0.2));
        let plane = [[axis.x, -axis.y, tip.x], [axis.y, axis.x, tip.y]].map(|[a, b, c]| {
            let [a, b] = [a, b].map(|factor| BivariatePolynomial::linear(factor, 0.0, 0.0));
            a.times(&moved[0])
                .plus(&b.times(&moved[1]))
                .plus(&BivariatePolynomial::linear(c, 0.0, 0.0))
        });
        let degree = if bend == 0.0 { 1 } else { 2 };
        let elements = MeshBuilder::tiles([n, n], degree, &plane, is_cut);
        Self { elements, axis, tip, from: tip - axis * 2.0 }
    }

    fn dataset(&self, field: FieldData) -> Dataset {
        let step = step(Step::new(self.elements.mesh.clone()), crack(self.from, self.tip));
        // more than the mesh, so that its border is where the mesh ends
        let bounds = Rect::around(self.tip, vec2(3.0, 3.0));
        let domain = Domain { bounds, holes: Vec::new() };
        Dataset::new(domain, Equation::elasticity(MATERIAL)).with_step(step.with_field(field))
    }

    /// The field itself, with the functions of the tip in each element.
    fn enriched(&self) -> Dataset {
        let mut field = displacement();
        for patch in 0..self.elements.mesh.len() {
            let degree = self.elements.mesh.map_degree[patch];
            let space = self.elements.mesh.map_space[patch];
            field.push_patch(&[(0, degree), (1, 0), (2, 0), (3, 0), (4, 0)]);
            field.block_space.extend([space, Total, Total, Total, Total]);
        }
        let mut rows = [Vec::new(), Vec::new()];
        field.block_offset.clear();
        for (patch, map) in self.elements.maps.iter().enumerate() {
            let (degree, space) =
                (self.elements.mesh.map_degree[patch], self.elements.mesh.map_space[patch]);
            let [x, y] = map.each_ref().map(|p| p.coefficients(space, degree.into()));
            field.block_offset.push(rows[0].len() as u64);
            for (k, (x, y)) in x.iter().zip(&y).enumerate() {
                let from = vec2(*x, *y) - if k == 0 { self.tip } else { Vec2::ZERO };
                let u = linear(self.axis, from);
                rows.iter_mut().zip(u).for_each(|(row, u)| row.push(u));
            }
            for pair in singular(self.axis) {
                field.block_offset.push(rows[0].len() as u64);
                rows.iter_mut().zip(pair).for_each(|(row, c)| row.push(c));
            }
        }
        field.coefficients = rows.to_vec();
        self.dataset(field)
    }

    /// Polynomials of an order through the field, on triangles.
    fn interpolated(&self, order: u8) -> Dataset {
        let exact = Williams::new(MATERIAL, self.tip, self.axis)
            .with_intensities(K[0], K[1])
            .with_t_stress(T);
        let mut field = displacement();
        for patch in 0..self.elements.mesh.len() {
            field.push_patch(&[(0, order)]);
            let shape = self.elements.mesh.shape[patch];
            let places: Vec<_> = shape.samples(order).skip(1).collect();
            let n = places.len();
            let powers: Vec<_> =
                (0..=order).flat_map(|d| (0..=d).map(move |b| (d - b, b))).collect();
            let power = |x: f64, n: u8| x.powi(i32::from(n));
            let matrix = Mat::from_fn(n, n, |row, k| {
                power(places[row][0], powers[k].0) * power(places[row][1], powers[k].1)
            });
            let offset = |at: [f64; 2]| self.elements.mesh.image(patch, at).0 - self.tip;
            let is_above = self.axis.cross(offset([0.0; 2])) > 0.0;
            let values: Vec<[f64; 2]> = places
                .iter()
                .map(|&at| {
                    let d = offset(at);
                    let theta = self.axis.cross(d).atan2(self.axis.dot(d)).abs();
                    let theta = if is_above { theta } else { -theta };
                    let u = exact.at_polar(d.length(), theta.clamp(-PI, PI));
                    world(self.axis, u.map(|component| component.value))
                })
                .collect();
            let right = Mat::from_fn(n, 2, |row, k| values[row][k]);
            let solution = matrix.partial_piv_lu().solve(right);
            for (k, out) in field.coefficients_mut(patch).enumerate() {
                out.iter_mut().enumerate().for_each(|(row, out)| *out = solution[(row, k)]);
            }
        }
        self.dataset(field)
    }
}

/// Squares and triangles, straight and bent, whose edges the crack runs along, or which it cuts.
#[test]
fn tips_on_meshes() {
    for (n, angle, bend) in [(6, 0.0, 0.0), (7, 0.4, 0.0), (6, -1.1, 0.08), (10, 2.5, 0.0)] {
        let plate = Plate::new(n, angle, bend, |i, j| (i + j) % 2 != 0);
        let dataset = plate.enriched();
        dataset.check().expect("a dataset");
        let clear = clearance(&dataset, 0, TIP).expect("a tip");
        assert_eq!(clear.end, TipObstacle::Border);
        assert!((clear.radius - 1.0).abs() < 0.1, "{clear:?}");
        assert_exact(&format!("mesh of {n}, {angle}, {bend}"), &dataset, 1e-9);
    }
}

/// Polynomials that follow the field have its factors up to their own error, at all radii.
#[test]
fn tips_on_meshes_of_polynomials() {
    let error = |n: i32, order: u8| {
        let dataset = Plate::new(n, 0.6, 0.0, |_, _| true).interpolated(order);
        dataset.check().expect("a dataset");
        let (found, _) = factors(&dataset);
        let at = |ring: &ppum::dataset::Ring| (ring.k1 - K[0]).hypot(ring.k2 - K[1]);
        let worst = found.rings.iter().map(at).fold(0.0, f64::max) / K[0].hypot(K[1]);
        println!("{n}, {order}: {worst:.1e}");
        worst
    };
    let [coarse, fine] = [error(8, 4), error(24, 4)];
    assert!(coarse < 0.02 && fine < 0.5 * coarse, "{coarse:e} {fine:e}");
    assert!(error(16, 2) < 0.02);
}
