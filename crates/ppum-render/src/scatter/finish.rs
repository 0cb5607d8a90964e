//! From the sums of a tile to the values of a quantity.

use ppum::jet::Jet;
use ppum::quantity::{Quantity, Source};
use ppum::real::{Real, Scalar};

use super::collapse::{ANY, height, known};
use super::plan::COLUMNS;
use super::spread::size;
use super::tile::{Scratch, Tile, load_jet};

impl<T: Scalar, const D: usize> Tile<'_, '_, T, D> {
    /// Divides, makes the quantity, writes it to the raster and clears the sums. The quantity most
    /// often drawn is compiled as a constant: the choice between thirty costs more than it.
    #[inline(always)]
    pub(super) fn finish<R: Real<Scalar = T>>(
        &self,
        scratch: &mut Scratch<T>,
        out: &mut [T],
        zero: R,
    ) {
        match (self.scene.quantity, scratch.shift.len()) {
            (Quantity::VonMises, 2) => {
                self.finish_as::<R, 2>(Quantity::VonMises, scratch, out, zero);
            }
            (quantity, _) => self.finish_as::<R, ANY>(quantity, scratch, out, zero),
        }
    }

    /// [`finish`](Self::finish) for `C` components.
    #[inline(always)]
    fn finish_as<R: Real<Scalar = T>, const C: usize>(
        &self,
        quantity: Quantity,
        scratch: &mut Scratch<T>,
        out: &mut [T],
        zero: R,
    ) {
        let components = known(C, scratch.shift.len());
        let mut pair = [Jet::constant(zero); 2];
        let mut many = Vec::new();
        let jets = if C == 2 {
            pair.as_mut_slice()
        } else {
            many.resize(components, Jet::constant(zero));
            many.as_mut_slice()
        };
        let mut exact = Vec::new();
        let stride = size::<R, D>() * (1 + components);
        let width = self.scene.view.pixels[0] as usize;
        let [mut column, first_row] = self.corner();
        let end = width.min(column + COLUMNS);
        for cells in scratch.sums.chunks_exact_mut(height::<T>() * stride) {
            if column >= end {
                break;
            }
            let lines = out.chunks_exact_mut(width).zip(cells.chunks_exact_mut(stride));
            for (row, (line, cell)) in lines.enumerate() {
                if quantity.source() == Source::Exact {
                    exact.resize(components, zero);
                    let pixel = [column, first_row + row];
                    self.scene.load_exact(pixel, &scratch.shift, &mut exact, zero);
                }
                let value = self.value(quantity, cell, &scratch.shift, jets, &exact, zero);
                clear(cell, zero);
                store(value, &mut line[column..]);
            }
            column += R::LANES;
        }
    }

    /// The quantity at a vector of points.
    #[inline(always)]
    fn value<R: Real<Scalar = T>>(
        &self,
        quantity: Quantity,
        cell: &[T],
        shift: &[f64],
        jets: &mut [Jet<R>],
        exact: &[R],
        zero: R,
    ) -> R {
        let size = size::<R, D>();
        let weight = load_jet::<R, D>(cell, zero);
        let mut component = 0;
        while component < jets.len() {
            let sum = load_jet::<R, D>(&cell[(component + 1) * size..], zero);
            jets[component] = sum.over::<D>(weight);
            component += 1;
        }
        match quantity.source() {
            Source::Partition if jets.is_empty() => return weight.v,
            Source::Partition => return jets[0].v + zero.lit(shift[0]),
            Source::Values => {
                for (jet, &shift) in jets.iter_mut().zip(shift) {
                    jet.v = jet.v + zero.lit(shift);
                }
            }
            Source::Gradient | Source::Exact => {}
        }
        quantity.of_field(&self.scene.equation, jets, exact)
    }
}

#[inline(always)]
fn clear<R: Real>(cell: &mut [R::Scalar], zero: R) {
    for lanes in cell.chunks_exact_mut(R::LANES) {
        zero.store(lanes);
    }
}

/// Stores the lanes, or as many as there is room for.
#[inline(always)]
fn store<R: Real>(value: R, to: &mut [R::Scalar]) {
    if to.len() >= R::LANES {
        value.store(to);
    } else {
        // 16 lanes are the widest vector there is.
        let mut lanes = [R::Scalar::default(); 16];
        value.store(&mut lanes);
        to.copy_from_slice(&lanes[..to.len()]);
    }
}
