//! Values at the pixel centres of a view.

use ppum::domain::Domain;
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum::real::Scalar;
use rayon::prelude::*;

use crate::error::RenderError;
use crate::image::Rgba;
use crate::shades::Shades;
use crate::view::View;

/// The number types of a raster: f64 and f32.
pub trait Sample: Scalar + Into<f64> {
    /// Relative difference up to which values count as one: some roundings, and of f64 the rounding of a linear
    /// system too, since a field that is constant but for that should look so.
    const SAME: f64;

    /// [`render`](crate::scatter::render) for this type. Implemented for each, so that the renderer's
    /// kernels are compiled once, here, and not in every crate that draws.
    ///
    /// # Errors
    /// See there.
    fn render(
        field: &Field<'_>,
        view: &View,
        quantity: &Quantity,
        watcher: &dyn Watcher,
    ) -> Result<Raster<Self>, RenderError>;

    /// Colours a row of values, and tells whether one of them lay below, and above, the range.
    fn paint(shades: &Shades, values: &[Self], pixels: &mut [Rgba]) -> [bool; 2];

    /// [`render_strips`](crate::scatter::render_strips) for this type.
    ///
    /// # Errors
    /// See there.
    fn render_strips(
        field: &Field<'_>,
        view: &View,
        quantity: &Quantity,
        rows: u32,
        watcher: &dyn Watcher,
        take: &mut dyn FnMut(Vec<Self>),
    ) -> Result<(), RenderError>;
}

/// One value per pixel, row by row from the top; NaN where nothing is defined (outside the domain).
#[derive(Clone, Debug, PartialEq)]
pub struct Raster<T = f64> {
    /// Columns and rows.
    pub size: [u32; 2],
    /// Values, `size[0] * size[1]` of them.
    pub values: Vec<T>,
}

/// Whole numbers up to here differ from their neighbours' middles in single precision too.
const LARGEST_WHOLE: f64 = (1 << 22) as f64;

/// Values that are cleared at a time.
const BLOCK: usize = 1024;

/// So many zeros, by all threads of the pool: memory is as slow as a tenth of a picture.
pub(crate) fn zeros<T: Copy + Default + Send>(count: usize) -> Vec<T> {
    let blocks = (0..count.div_ceil(BLOCK)).into_par_iter().map(|_| [T::default(); BLOCK]);
    let mut all = blocks.collect::<Vec<_>>().into_flattened();
    all.truncate(count);
    all
}

/// Statistics of a raster. Minimum, maximum and mean are those of the finite values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Statistics {
    /// Number of finite values.
    pub finite: usize,
    /// Number of NaN.
    pub undefined: usize,
    /// Number of infinite values.
    pub infinite: usize,
    /// Smallest finite value, +∞ if there is none.
    pub min: f64,
    /// Largest finite value, −∞ if there is none.
    pub max: f64,
    /// Mean of the finite values, NaN if there is none.
    pub mean: f64,
}

impl<T: Sample> Raster<T> {
    /// A raster from its values.
    ///
    /// # Panics
    /// If the number of values is not columns × rows.
    #[must_use]
    pub fn new(size: [u32; 2], values: Vec<T>) -> Self {
        let pixels = size[0] as usize * size[1] as usize;
        assert_eq!(values.len(), pixels, "a raster needs one value per pixel");
        Self { size, values }
    }

    /// The value `f(column, row)` at every pixel, rows in parallel.
    #[must_use]
    pub fn from_fn(size: [u32; 2], f: impl Fn(u32, u32) -> T + Sync) -> Self {
        let row = |j| (0..size[0]).map(|i| f(i, j)).collect::<Vec<_>>();
        Self::new(size, (0..size[1]).into_par_iter().flat_map_iter(row).collect())
    }

    /// The value of a pixel.
    #[must_use]
    pub fn value(&self, column: u32, row: u32) -> T {
        self.values[row as usize * self.size[0] as usize + column as usize]
    }

    /// The values of a row.
    #[must_use]
    pub fn row(&self, row: u32) -> &[T] {
        let columns = self.size[0] as usize;
        &self.values[row as usize * columns..][..columns]
    }

    /// The value that all pixels of a value have, but for rounding; none if they differ or are infinite.
    #[must_use]
    pub fn one_value(&self) -> Option<f64> {
        let (mut min, mut max) = (f64::INFINITY, f64::NEG_INFINITY);
        for value in self.values.iter().map(|&v| v.into()).filter(|v: &f64| !v.is_nan()) {
            (min, max) = (min.min(value), max.max(value));
            // two that differ are enough: others only widen what lies between
            if value.is_infinite() || max - min > T::SAME * min.abs().max(max.abs()) {
                return None;
            }
        }
        (min <= max).then_some(0.5 * min + 0.5 * max)
    }

    /// The different values, rising, if they are at most `most` whole numbers; none otherwise. NaN does not count.
    #[must_use]
    pub fn whole_numbers(&self, most: usize) -> Option<Vec<f64>> {
        let mut found: Vec<f64> = Vec::new();
        for value in self.values.iter().map(|&v| v.into()).filter(|v: &f64| !v.is_nan()) {
            // −0 is 0
            let value = value + 0.0;
            let Err(place) = found.binary_search_by(|known| known.total_cmp(&value)) else {
                continue;
            };
            if found.len() == most || value.fract() != 0.0 || value.abs() > LARGEST_WHOLE {
                return None;
            }
            found.insert(place, value);
        }
        (!found.is_empty()).then_some(found)
    }

    /// The pixels of the plate without a value, by their place row by row: what is undefined there, as a
    /// formula may be, and not outside.
    ///
    /// # Panics
    /// If the raster does not have the view's size.
    #[must_use]
    pub fn undefined(&self, domain: &Domain, view: &View) -> Vec<u32> {
        assert_eq!(self.size, view.pixels, "a raster belongs to a view of its size");
        let (local, columns) = (domain.at(view.center), self.size[0]);
        let in_row = |row: u32| {
            let values = self.row(row).iter().map(|&v| v.into());
            let without = (0..).zip(values).filter(|(_, value): &(u32, f64)| value.is_nan());
            let undefined = without.filter(|(column, _)| local.contains(view.offset(*column, row)));
            undefined.map(|(column, _)| row * columns + column).collect::<Vec<_>>()
        };
        (0..self.size[1]).into_par_iter().flat_map_iter(in_row).collect()
    }

    /// Counts, extremes and mean.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        let (mut min, mut max, mut sum) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
        let (mut finite, mut undefined) = (0, 0);
        for value in self.values.iter().map(|&v| v.into()) {
            undefined += usize::from(value.is_nan());
            if value.is_finite() {
                finite += 1;
                sum += value;
                min = min.min(value);
                max = max.max(value);
            }
        }
        let infinite = self.values.len() - finite - undefined;
        Statistics { finite, undefined, infinite, min, max, mean: sum / finite as f64 }
    }
}

#[cfg(test)]
mod tests {
    use ppum::domain::Hole;
    use ppum::vec2::{Rect, Vec2, vec2};

    use super::*;

    #[test]
    fn zeros_are_as_many_as_wanted() {
        for count in [0, 1, BLOCK - 1, BLOCK, 3 * BLOCK + 7] {
            assert_eq!(zeros::<f32>(count), vec![0.0; count]);
        }
    }

    #[test]
    fn undefined_is_not_outside() {
        let hole = Hole::Circle { center: vec2(0.5, 0.5), radius: 0.3 };
        let bounds = Rect::around(Vec2::ZERO, vec2(1.0, 1.0));
        let domain = Domain { bounds, holes: vec![hole] };
        let view = View::new(vec2(0.1, 0.2), 3.0, [60, 40]).unwrap();
        let raster = Raster::from_fn(view.pixels, |i, _| if i < 30 { f64::NAN } else { 1.0 });
        let found = raster.undefined(&domain, &view);
        let expected: Vec<u32> = (0..2400)
            .filter(|k| {
                let p = view.center + view.offset(k % 60, k / 60);
                let in_plate = p.x.abs() < 1.0 && p.y.abs() < 1.0;
                k % 60 < 30 && in_plate && (p - vec2(0.5, 0.5)).length() > 0.3
            })
            .collect();
        assert!(found == expected && !found.is_empty());
    }

    #[test]
    fn one_value_is_that_of_all_pixels_that_have_one() {
        let of =
            |values: &[f64]| Raster::new([values.len() as u32, 1], values.to_vec()).one_value();
        let (nan, inf) = (f64::NAN, f64::INFINITY);
        assert_eq!(of(&[nan, 3.0, 3.0 + 1e-12, nan]), Some(3.0 + 0.5e-12));
        assert_eq!(of(&[0.0, -0.0]), Some(0.0));
        assert_eq!(of(&[f64::MAX, f64::MAX]), Some(f64::MAX));
        for values in [&[3.0, 3.0 + 1e-11][..], &[1.0, -1.0], &[2.0, inf], &[-inf], &[nan], &[]] {
            assert_eq!(of(values), None, "{values:?}");
        }
    }

    #[test]
    fn statistics_count_what_is_not_finite_apart() {
        let values = vec![1.0, f64::NAN, 3.0, f64::INFINITY, f64::NEG_INFINITY, 2.0];
        let found = Raster::new([3, 2], values).statistics();
        assert_eq!((found.finite, found.undefined, found.infinite), (3, 1, 2));
        assert_eq!((found.min, found.max, found.mean), (1.0, 3.0, 2.0));
    }

    #[test]
    fn statistics_of_nothing() {
        let found = Raster::new([2, 1], vec![f32::NAN; 2]).statistics();
        assert_eq!((found.finite, found.undefined), (0, 2));
        assert!(found.min > found.max && found.mean.is_nan());
    }

    #[test]
    fn one_value_but_for_rounding() {
        let of = |values: Vec<f64>| Raster::new([values.len() as u32, 1], values).one_value();
        assert_eq!(of(vec![3.0, 3.0, f64::NAN]), Some(3.0));
        assert_eq!(of(vec![0.0, -0.0]), Some(0.0));
        assert_eq!(of(vec![-1e-20; 2]), Some(-1e-20));
        assert!(of(vec![1.0, 1.0 + 1e-13]).is_some() && of(vec![1.0, 1.0 + 1e-11]).is_none());
        for other in [vec![f64::NAN], vec![], vec![1.0, f64::INFINITY], vec![-1e-20, 1e-20]] {
            assert_eq!(of(other.clone()), None, "{other:?}");
        }
        let narrow = |apart: f32| Raster::new([2, 1], vec![1.0, 1.0 + apart]).one_value();
        assert!(narrow(4e-7).is_some() && narrow(1e-5).is_none());
    }

    #[test]
    fn whole_numbers_are_told_from_others() {
        let of = |values: &[f64]| {
            Raster::new([values.len() as u32, 1], values.to_vec()).whole_numbers(3)
        };
        assert_eq!(of(&[3.0, -1.0, 3.0, f64::NAN, 0.0, -0.0]), Some(vec![-1.0, 0.0, 3.0]));
        for other in
            [&[0.0, 1.0, 2.0, 3.0][..], &[0.5], &[f64::NAN], &[], &[1.0, f64::INFINITY], &[1e9]]
        {
            assert_eq!(of(other), None, "{other:?}");
        }
    }

    #[test]
    fn rows_run_from_left_to_right() {
        let raster = Raster::from_fn([3, 2], |i, j| f64::from(10 * j + i));
        assert_eq!(raster.values, [0.0, 1.0, 2.0, 10.0, 11.0, 12.0]);
        assert_eq!(raster.value(2, 1), 12.0);
        assert_eq!(raster.row(1), [10.0, 11.0, 12.0]);
    }
}
