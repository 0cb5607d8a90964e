//! How far an image is from another: norms over the pixels of a view.

use ppum_raster::raster::Raster;

/// Norms of a difference d over the n pixels where both images have a value, as means, so that
/// they do not depend on the size of the view: Σ|d|/n, √(Σd²/n), max |d|.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DifferenceNorms {
    /// L1, L2 and L∞ of the difference, over the pixels where both values are finite; L∞ is
    /// infinite if one value is and the other is not.
    pub absolute: [f64; 3],
    /// The norms of the field itself over the same pixels; L∞ of its finite values.
    pub field: [f64; 3],
    /// Pixels where both have a finite value.
    pub compared: usize,
    /// Pixels where one value at least is infinite, and the two are not the same.
    pub infinite: usize,
    /// Pixels with a value of the field and none of the other.
    pub lost: usize,
    /// Pixels with a value of the other where the field has none: outside the body, or in a hole.
    pub invented: usize,
}

/// The names of the three norms.
pub const NAMES: [&str; 3] = ["L1", "L2", "L∞"];

impl DifferenceNorms {
    /// L1, L2 and L∞ in parts of those of the field; of a field that is zero, zero or infinite.
    #[must_use]
    pub fn relative(&self) -> [f64; 3] {
        std::array::from_fn(|k| match (self.absolute[k], self.field[k]) {
            (0.0, _) => 0.0,
            (error, size) => error / size,
        })
    }
}

/// The norms of `other` − `field`, summed pixel by pixel in order.
///
/// # Panics
/// If the images differ in size.
#[must_use]
pub fn norms(field: &Raster, other: &Raster) -> DifferenceNorms {
    assert_eq!(field.size, other.size, "pictures of the same pixels are compared");
    of_values(&field.values, &other.values)
}

/// The norms of the differences of pairs of values.
pub(super) fn of_values(field: &[f64], other: &[f64]) -> DifferenceNorms {
    let (mut found, mut sums) = (DifferenceNorms::default(), [[0.0; 2]; 2]);
    for (&u, &v) in field.iter().zip(other) {
        match (u.is_nan(), v.is_nan()) {
            (true, true) => {}
            (false, true) => found.lost += 1,
            (true, false) => found.invented += 1,
            _ if u == v && u.is_infinite() => {}
            _ if u.is_infinite() || v.is_infinite() => found.infinite += 1,
            _ => {
                found.compared += 1;
                for (k, size) in [(v - u).abs(), u.abs()].into_iter().enumerate() {
                    sums[k][0] += size;
                    sums[k][1] += size * size;
                    let norms = if k == 0 { &mut found.absolute } else { &mut found.field };
                    norms[2] = norms[2].max(size);
                }
            }
        }
    }
    let count = found.compared.max(1) as f64;
    for (norms, [sum, square]) in [&mut found.absolute, &mut found.field].into_iter().zip(sums) {
        (norms[0], norms[1]) = (sum / count, (square / count).sqrt());
    }
    if found.infinite > 0 {
        found.absolute[2] = f64::INFINITY;
    }
    found
}

/// The difference `other` − `field`; NaN where one of them has no value, and where both are
/// infinite alike.
///
/// # Panics
/// If the images differ in size.
#[must_use]
pub fn difference(field: &Raster, other: &Raster) -> Raster {
    assert_eq!(field.size, other.size, "pictures of the same pixels are compared");
    let pairs = field.values.iter().zip(&other.values);
    Raster::new(field.size, pairs.map(|(u, v)| v - u).collect())
}
