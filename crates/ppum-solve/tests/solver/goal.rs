//! Estimated errors of stress intensity factors against the errors, and accuracies that are asked for.

use crate::studies::factors::{errors_of_factors, plates};
use crate::studies::plates::{centre_cracks, end_shear, slanted_cracks};
use crate::studies::support::solved;
use ppum_solve::problem::{Adaptivity, Cells, Order};

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
