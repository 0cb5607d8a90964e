//! What stands beside the stress intensity factors at a tip: T and J.

use crate::studies::exact_fields::{MATERIAL, OBLIQUE, SQUARE, discretization, held};
use crate::studies::support::solved;
use crate::support::stressed;
use ppum::crack::{End, TipId};
use ppum::dataset::{Dataset, TipIntensity};
use ppum::progress::unwatched;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_fracture::intensity::on_circle;
use ppum_problem::{BaseCells, BoundaryPart, Condition, DomainEdge, Expression, ProblemData};
use ppum_testkit::exact::{CrackInPlane, ExactField as _};
use ppum_testkit::random::Random;

fn stored(dataset: &Dataset) -> &[TipIntensity] {
    &dataset.steps[0].intensities
}

fn t_stress(tip: &TipIntensity) -> f64 {
    tip.t_stress.expect("a value")
}

/// J / G − 1
fn check(tip: &TipIntensity) -> f64 {
    tip.j.expect("a value") / tip.energy_release(&MATERIAL) - 1.0
}

/// The field of given K and T is in the space: only rounding and quadrature are left, in discs of
/// any size.
#[test]
fn given_terms_are_found() {
    for (k1, k2, t) in [(1.0, 0.5, 0.3), (0.0, 1.0, -2.0)] {
        let field = OBLIQUE.field().with_intensities(k1, k2).with_t_stress(t);
        let mut set = discretization(BaseCells::Level(2), 2);
        set.enrichment_radius = Some(10.0);
        let dataset = solved(&OBLIQUE.problem(&field, set));
        let tip = TipId { crack: 0, end: End::Last };
        for radius in [0.2, 0.5, 0.9] {
            let found = on_circle(&dataset, 0, tip, radius, None, unwatched()).expect("room");
            let error = (t_stress(&found) - t).abs();
            println!("T {t}, R {radius}: {error:.1e}, J/G − 1 {:.1e}", check(&found));
            assert!(error < 1e-7 && check(&found).abs() < 1e-7, "{found:?}");
        }
    }
}

/// A crack of half length 0.4 in the infinite plane under the stresses N_x, N_y, τ in its frame
/// (Muskhelishvili 1953, §120), cut out by its exact displacements.
fn in_plane(remote: [f64; 3], angle: f64) -> (ProblemData, CrackInPlane) {
    let (center, along) = (vec2(0.03, 0.02), vec2(angle.cos(), angle.sin()));
    let field = CrackInPlane::biaxial(MATERIAL, center, along, 0.4, 1.0).with_remote(remote);
    let ends = [center - along * 0.4, center + along * 0.4];
    let plate = ProblemData::elasticity(SQUARE, MATERIAL, discretization(BaseCells::Level(4), 3))
        .with_crack(&ends.map(Into::into));
    (plate, field)
}

/// T = N_x − N_y at both tips, of any crack in the plane.
#[test]
fn t_in_the_infinite_plane() {
    for (remote, angle) in [([0.0, 1.0, 0.0], 0.3), ([0.5, 0.2, 0.7], -0.8)] {
        let (plate, field) = in_plane(remote, angle);
        let dataset = solved(&held(plate, field.formulas()));
        for tip in stored(&dataset) {
            let error = t_stress(tip) - (remote[0] - remote[1]);
            println!("{remote:?}: T off by {error:.1e}, J/G − 1 {:.1e}", check(tip));
            // what the cells leave, as of K: with the rate 3 eight times the 1e-5 and 2e-6 of cells
            // half as large
            assert!(error.abs() < 8e-5 && check(tip).abs() < 1.6e-5, "{tip:?}");
        }
    }
}

/// Pressure 1 on the faces is all-round tension less a uniform stress: σ_11 = σ_22 = −1 beside the
/// terms of K, and T = −1.
#[test]
fn t_and_j_under_pressure() {
    let (plate, field) = in_plane([1.0, 1.0, 0.0], 0.3);
    let strain = 1.3 * 0.4;
    let [ux, uy] = field.formulas();
    let less = |text: String, x: &str| {
        let (bindings, value) = text.rsplit_once("; ").expect("bindings");
        format!("{bindings}; ({value}) - {strain}*{x}")
    };
    let plate = plate.with_pressure(BoundaryPart::Crack { crack: 0, face: None }, 1.0);
    let dataset = solved(&held(plate, [less(ux, "x"), less(uy, "y")]));
    for tip in stored(&dataset) {
        println!("T off by {:.1e}, J/G − 1 {:.1e}", t_stress(tip) + 1.0, check(tip));
        // what the cells leave, as above
        assert!((t_stress(tip) + 1.0).abs() < 8e-5 && check(tip).abs() < 1.6e-5, "{tip:?}");
    }
}

/// A pressure that jumps along both faces: J and K agree, wherever the jump is.
#[test]
fn j_under_loads_that_jump() {
    let mut random = Random(3);
    for _ in 0..2 {
        let at = random.between(-0.1, 0.3);
        let pressure = Expression::parse(&format!("if(x > {at}, 1, 0.3)")).expect("a formula");
        let mut plate =
            ProblemData::elasticity(SQUARE, MATERIAL, discretization(BaseCells::Level(4), 3))
                .with_crack(&[[-0.4, -0.05], [0.1, 0.0], [0.4, -0.1]])
                .with_pressure(BoundaryPart::Crack { crack: 0, face: None }, 1.0);
        plate.boundary[0].pressure = Some(pressure);
        let dataset = solved(&plate);
        for tip in stored(&dataset) {
            println!("jump at {at}: J/G − 1 {:.1e}", check(tip));
            assert!(check(tip).abs() < 1e-3, "{tip:?}");
        }
    }
}

/// A load that pulls both faces the same way has no T: the stress along the crack grows like log r.
#[test]
fn loads_with_a_resultant_at_the_tip_have_no_t() {
    let faces = BoundaryPart::Crack { crack: 0, face: None };
    let load = |x: f64, y: f64| vec![Condition::Neumann(x.into()), Condition::Neumann(y.into())];
    let plate = ProblemData::elasticity(SQUARE, MATERIAL, discretization(BaseCells::Level(4), 2))
        .with_crack(&[[-0.4, 0.0], [0.4, 0.0]])
        .with_boundary(DomainEdge::Bottom, vec![Condition::Dirichlet(0.0.into()); 2])
        .with_boundary(DomainEdge::Top, load(0.0, 1.0));
    assert!(stored(&solved(&plate)).iter().all(|tip| tip.t_stress.is_some()));
    let mut dragged = plate;
    dragged
        .boundary
        .push(ppum_problem::BoundaryCondition { on: faces, ..dragged.boundary[1].clone() });
    let dataset = solved(&dragged);
    for tip in stored(&dataset) {
        println!("J/G − 1 {:.1e}", check(tip));
        assert!(tip.t_stress.is_none() && check(tip).abs() < 1e-2, "{tip:?}");
    }
}

/// Loads of an invariance: σ_xx, σ_yy, σ_xy on all edges.
fn plate(domain: Rect, points: &[Vec2], stress: [f64; 3], grid: [u32; 2]) -> Dataset {
    let points: Vec<[f64; 2]> = points.iter().map(|&p| p.into()).collect();
    let plate = ProblemData::elasticity(domain, MATERIAL, discretization(BaseCells::Grid(grid), 2));
    solved(&stressed(plate.with_crack(&points), stress, &DomainEdge::ALL))
}

/// [K_I, K_II, T] and J of both tips.
fn terms(dataset: &Dataset) -> Vec<([f64; 3], f64)> {
    let terms = |tip: &TipIntensity| ([tip.k1, tip.k2, t_stress(tip)], tip.j.expect("a value"));
    stored(dataset).iter().map(terms).collect()
}

fn near(a: &[f64; 3], b: &[f64; 3]) -> bool {
    // rounding of systems whose condition is 1e4 to 1e5
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-9)
}

/// Quadrature divides cells segment by segment: in another order, or with other rounding, its error
/// is another one.
fn near_on_other_pieces(a: &[f64; 3], b: &[f64; 3]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() < 1e-8)
}

/// K and T are linear in the loads and J is a quadratic form; none depends on the direction of the
/// crack, on the directions of the axes, or but for their units on lengths and stresses.
#[test]
fn superposition_and_invariance() {
    let mut random = Random(8);
    let domain = Rect::new(vec2(-1.0, -1.2), vec2(1.1, 1.0));
    let mut point =
        |x: f64, y: f64| vec2(x + random.between(-0.05, 0.05), y + random.between(-0.05, 0.05));
    let points = [point(-0.5, 0.1), point(-0.1, -0.1), point(0.2, 0.0), point(0.5, 0.2)];
    let loads = [[1.0, 0.2, -0.3], [random.between(-1.0, 1.0), 0.9, random.between(-1.0, 1.0)]];
    let grid = [11, 12];
    let [a, b] = loads.map(|load| terms(&plate(domain, &points, load, grid)));
    let combined = |s: f64| {
        let load = std::array::from_fn(|k| loads[0][k] + s * loads[1][k]);
        terms(&plate(domain, &points, load, grid))
    };
    let (sum, less) = (combined(1.0), combined(-1.0));
    for k in 0..2 {
        let expected = std::array::from_fn(|i| a[k].0[i] + b[k].0[i]);
        assert!(near(&sum[k].0, &expected), "{:?} {expected:?}", sum[k]);
        // the law of the parallelogram
        let energies = sum[k].1 + less[k].1 - 2.0 * (a[k].1 + b[k].1);
        assert!(energies.abs() < 1e-9, "{energies:.1e}");
    }
    let reversed: Vec<Vec2> = points.iter().rev().copied().collect();
    let back = terms(&plate(domain, &reversed, loads[0], grid));
    let turn = |p: Vec2| vec2(-p.y, p.x);
    let turned_domain = Rect::new(vec2(-1.0, -1.0), vec2(1.2, 1.1));
    let [xx, yy, xy] = loads[0];
    let turned = terms(&plate(turned_domain, &points.map(turn), [yy, xx, -xy], [12, 11]));
    let (length, stress) = (7.0, 0.2);
    let larger = Rect::new(domain.min * length, domain.max * length);
    let scaled = plate(larger, &points.map(|p| p * length), loads[0].map(|s| s * stress), grid);
    let scaled = terms(&scaled);
    for k in 0..2 {
        assert!(near_on_other_pieces(&back[1 - k].0, &a[k].0), "{back:?} {a:?}");
        assert!(near_on_other_pieces(&turned[k].0, &a[k].0), "{turned:?} {a:?}");
        let units = [stress * length.sqrt(), stress * length.sqrt(), stress];
        let unscaled = std::array::from_fn(|i| scaled[k].0[i] / units[i]);
        assert!(near_on_other_pieces(&unscaled, &a[k].0), "{unscaled:?} {a:?}");
        let j = scaled[k].1 / (stress * stress * length);
        let apart = [j - a[k].1, turned[k].1 - j, back[1 - k].1 - j];
        // of strains, in which rounding decides over functions that are nearly dependent
        assert!(apart.iter().all(|d| d.abs() < 1e-8), "{apart:?}");
    }
}
