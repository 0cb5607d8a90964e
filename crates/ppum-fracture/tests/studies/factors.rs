//! Errors of stress intensity factors, and what is estimated of them.

use super::plates::{Plate, centre_cracks, edge_cracks, end_shear, slanted_cracks};
use ppum::dataset::{Dataset, TipIntensity};

/// Of each tip with known factors, the lengths of (K_I, K_II), of its error and of the estimated
/// error; a factor that is not known vanishes.
pub(crate) fn errors_of_factors(plate: &Plate, dataset: &Dataset) -> Vec<[f64; 3]> {
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

/// The finite plates with known factors.
pub(crate) fn plates() -> Vec<Plate> {
    let mut all = centre_cracks();
    all.extend(edge_cracks());
    all.extend(slanted_cracks());
    all.push(end_shear());
    all
}
