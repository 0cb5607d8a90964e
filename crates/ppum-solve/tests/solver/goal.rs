//! Estimated errors of stress intensity factors against the errors, and accuracies that are asked for.

use crate::studies::plates::{Plate, centre_cracks, edge_cracks, end_shear, slanted_cracks};
use crate::studies::support::solved;
use ppum::dataset::{Dataset, TipIntensity};
use ppum_solve::problem::{Adaptivity, Cells, Order};

/// Of each tip with known factors, the lengths of (K_I, K_II), of its error and of the estimated error; a factor that is not known
/// vanishes.
fn errors_of_factors(plate: &Plate, dataset: &Dataset) -> Vec<[f64; 3]> {
    let of_tip = |(k, found): (usize, &TipIntensity)| {
        let mut exact = [0.0; 2];
        let known = plate.known.iter().filter(|known| known.tip == k);
        known.for_each(|known| exact[known.mode] = known.value * plate.scale);
        let error = (found.k1 - exact[0]).hypot(found.k2 - exact[1]);
        let size = exact[0].hypot(exact[1]);
        (size > 0.0).then(|| [size, error, found.error.expect("an estimate")])
    };
    dataset.steps[0].intensities.iter().enumerate().filter_map(of_tip).collect()
}

fn plates() -> Vec<Plate> {
    let mut all = centre_cracks();
    all.extend(edge_cracks());
    all.extend(slanted_cracks());
    all.push(end_shear());
    all
}

/// Limits of the effectivity, the estimated error over the error. Where K is nearly right by chance it is larger.
const EFFECTIVE: std::ops::Range<f64> = 0.8..20.0;

/// The estimate is no bound, but has never been much less than the error.
#[test]
fn errors_of_factors_are_known() {
    let mut all = Vec::new();
    for plate in plates() {
        for order in 1..=3 {
            let mut problem = plate.problem.clone();
            problem.discretization.order = Order::Uniform(order);
            for [size, error, estimated] in errors_of_factors(&plate, &solved(&problem)) {
                let (name, effectivity) = (&plate.name, estimated / error);
                println!("{name}, order {order}: {:.1e}, × {effectivity:.2}", error / size);
                // what is known of the plate has six digits
                if error > 3e-6 * size {
                    assert!(EFFECTIVE.contains(&effectivity), "{name}, {order}: {effectivity}");
                    all.push(effectivity);
                }
            }
        }
    }
    all.sort_by(f64::total_cmp);
    println!("median × {:.2} of {}", all[all.len() / 2], all.len());
    assert!((1.0..5.0).contains(&all[all.len() / 2]));
}

/// An accuracy that is asked for is reached, and the estimate says so.
#[test]
fn accuracies_are_reached() {
    let plates = [&centre_cracks()[1], &slanted_cracks()[1], &end_shear()];
    for (plate, accuracy) in plates.into_iter().zip([1e-5, 1e-4, 1e-3]) {
        let mut problem = plate.problem.clone().with_adaptivity(Adaptivity::to(accuracy));
        problem.discretization.cells = Cells::Level(2);
        let dataset = solved(&problem);
        let (name, unknowns) = (&plate.name, dataset.steps[0].unknowns());
        assert!(dataset.steps[0].warnings.is_empty(), "{name}: {:?}", dataset.steps[0].warnings);
        for [size, error, estimated] in errors_of_factors(plate, &dataset) {
            let [error, estimated] = [error, estimated].map(|error| error / size);
            println!("{name}: {unknowns} unknowns, {error:.1e}, estimated {estimated:.1e}");
            assert!(
                error < accuracy && estimated < 1.001 * accuracy,
                "{name}: {error} {estimated}"
            );
        }
    }
}
