//! Values of the whole: those of the body, and those of reflected views where it is not.

use ppum::field::Field;
use ppum::quantity::{Reflection, ValueChange};
use ppum_render::RasterError;
use ppum_render::raster::{Raster, RasterValue};

use crate::image::body::{BodyPart, BodyView};
use crate::image::quantity::DisplayedQuantity;
use crate::image::values::{PixelValues, RasterValues, with_raster};

/// Draws the parts of the whole at the centres of pixels; `draw_part` draws the body itself in the
/// view of a part. Where parts of a deformed body lie over each other the body itself is seen.
pub(crate) fn draw<E: From<RasterError>>(
    field: &Field<'_>,
    body: &BodyView<'_>,
    shown: &DisplayedQuantity,
    draw_part: &mut dyn FnMut(&BodyPart<'_>, &DisplayedQuantity) -> Result<PixelValues, E>,
) -> Result<PixelValues, E> {
    let mut whole = draw_part(&body.own, shown)?;
    for image in &body.images {
        let (shown, change) = reflected(shown, &image.reflection, field)?;
        let part = draw_part(image, &shown)?.flipped(image.flips(), change);
        if image.points.is_some() {
            let columns = whole.view.pixels[0];
            let both = whole.pixels_with(&part).filter(|&[i, j]| !body.is_on_line(i, j));
            let overlap: Vec<u32> = both.map(|[i, j]| j * columns + i).collect();
            whole.overlap.extend(overlap);
        }
        whole.fill(part);
    }
    whole.overlap.sort_unstable();
    whole.overlap.dedup();
    Ok(whole)
}

/// Returns the quantity that gives the values in a mirrored part, and the change that they need.
pub(crate) fn reflected(
    shown: &DisplayedQuantity,
    reflection: &Reflection,
    field: &Field<'_>,
) -> Result<(DisplayedQuantity, ValueChange), RasterError> {
    Ok(match shown {
        DisplayedQuantity::Quantity(quantity) => {
            let found = quantity.reflected(reflection, field)?;
            (DisplayedQuantity::Quantity(found.quantity), found.change)
        }
        cells @ DisplayedQuantity::Cells(..) => (cells.clone(), ValueChange::Same),
    })
}

impl PixelValues {
    /// The image of what is drawn in the reflected view.
    fn flipped(mut self, flips: [bool; 2], change: ValueChange) -> Self {
        self.values = with_raster!(&self.values, raster => flipped(raster, flips, change).into());
        let size = self.view.pixels;
        for pixel in self.without.iter_mut().chain(&mut self.overlap) {
            let [i, j] = flip([*pixel % size[0], *pixel / size[0]], size, flips);
            *pixel = j * size[0] + i;
        }
        self
    }

    /// The columns and rows at which both have values.
    fn pixels_with<'a>(&'a self, other: &'a Self) -> impl Iterator<Item = [u32; 2]> + 'a {
        let [columns, rows] = self.view.pixels;
        let all = (0..rows).flat_map(move |j| (0..columns).map(move |i| [i, j]));
        all.filter(move |[i, j]| {
            let pixel = (j * columns + i) as usize;
            !self.values.is_undefined(pixel) && !other.values.is_undefined(pixel)
        })
    }

    /// Takes the values of an image where there are none.
    fn fill(&mut self, part: Self) {
        use RasterValues::{Double, Single};
        match (&mut self.values, &part.values) {
            (Double(own), Double(other)) => fill(own, other),
            (Single(own), Single(other)) => fill(own, other),
            (own, other) => {
                let mut both = own.widened();
                fill(&mut both, &other.widened());
                *own = Double(both);
            }
        }
        self.overlap.extend(part.overlap);
        self.without.extend(part.without);
        let values = &self.values;
        self.without.retain(|pixel| values.is_undefined(*pixel as usize));
        self.without.sort_unstable();
        self.without.dedup();
    }
}

impl RasterValues {
    /// Restricts values of the whole to a part, as the body has them at the pixels of the reflected
    /// view; none outside of the body's box.
    pub(super) fn restricted(
        &self,
        part: &BodyPart<'_>,
        change: ValueChange,
        field: &Field<'_>,
    ) -> Self {
        with_raster!(self, raster => restricted(raster, part, change, field).into())
    }

    fn widened(&self) -> Raster<f64> {
        match self {
            Self::Double(raster) => raster.clone(),
            Self::Single(raster) => {
                let values = raster.values.iter().map(|value| f64::from(*value)).collect();
                Raster::new(raster.size, values)
            }
        }
    }

    fn is_undefined(&self, pixel: usize) -> bool {
        with_raster!(self, raster => raster.values[pixel].is_nan())
    }
}

fn flip([i, j]: [u32; 2], [columns, rows]: [u32; 2], [across, down]: [bool; 2]) -> [u32; 2] {
    [if across { columns - 1 - i } else { i }, if down { rows - 1 - j } else { j }]
}

fn flipped<T: RasterValue>(raster: &Raster<T>, flips: [bool; 2], change: ValueChange) -> Raster<T> {
    Raster::from_fn(raster.size, |i, j| {
        let [i, j] = flip([i, j], raster.size, flips);
        T::from_f64(change.apply(raster.value(i, j).into()))
    })
}

fn fill<T: RasterValue>(own: &mut Raster<T>, other: &Raster<T>) {
    for (value, other) in own.values.iter_mut().zip(&other.values) {
        if (*value).into().is_nan() {
            *value = *other;
        }
    }
}

fn restricted<T: RasterValue>(
    whole: &Raster<T>,
    part: &BodyPart<'_>,
    change: ValueChange,
    field: &Field<'_>,
) -> Raster<T> {
    let mut values = flipped(whole, part.flips(), change);
    let [columns, rows] = part.view.inside(&field.domain.body_bounds());
    let width = values.size[0] as usize;
    for (k, value) in values.values.iter_mut().enumerate() {
        if !columns.contains(&(k % width)) || !rows.contains(&(k / width)) {
            *value = T::from_f64(f64::NAN);
        }
    }
    values
}
