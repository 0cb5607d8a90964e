//! From the sums of a tile to the values of a quantity.

use ppum::jet::Jet;
use ppum::quantity::{Quantity, Sample, Source};
use ppum::real::{Real, Scalar};

use super::collapse::{ANY, ROWS, known, splat};
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
        let uniform = self.scene.field.equation.is_uniform();
        match (self.scene.quantity, scratch.shift.len()) {
            (Quantity::VonMises, 2) if uniform => {
                self.finish_as::<R, 2, true>(&Quantity::VonMises, scratch, out, zero);
            }
            (quantity, 2) if uniform => {
                self.finish_as::<R, 2, true>(quantity, scratch, out, zero);
            }
            (quantity, _) => self.finish_as::<R, ANY, false>(quantity, scratch, out, zero),
        }
    }

    /// [`finish`](Self::finish) for `C` components, and constants of the equation that are the same
    /// everywhere if `UNIFORM`.
    #[inline(always)]
    fn finish_as<R: Real<Scalar = T>, const C: usize, const UNIFORM: bool>(
        &self,
        quantity: &Quantity,
        scratch: &mut Scratch<T>,
        out: &mut [T],
        zero: R,
    ) {
        let components = known(C, scratch.shift.len());
        // Two stay in registers.
        let mut pair = [Jet::constant(zero); 2];
        let mut many = Vec::new();
        let jets = if C == 2 {
            pair.as_mut_slice()
        } else {
            many.resize(components, Jet::constant(zero));
            many.as_mut_slice()
        };
        let mut exact = Vec::new();
        let (equation, anchor) = (self.scene.field.equation, self.scene.view.center);
        let moduli = equation.moduli(anchor, [zero; 2]);
        let source = quantity.source();
        let stride = size::<R, D>() * (1 + components);
        let width = self.scene.view.pixels[0] as usize;
        let [mut column, first_row] = self.corner();
        let end = width.min(column + COLUMNS);
        let mut start = 0;
        while column < end {
            for (row, line) in out.chunks_exact_mut(width).enumerate() {
                let cell = &mut scratch.sums[start + row * stride..][..stride];
                if source == Source::Exact {
                    exact.resize(components, zero);
                    let pixel = [column, first_row + row];
                    self.scene.load_exact(pixel, &scratch.shift, &mut exact, zero);
                }
                let weight = divide::<R, D>(cell, jets, zero);
                if matches!(source, Source::Values | Source::Partition)
                    || matches!(quantity, Quantity::Formula(_))
                {
                    for (jet, &shift) in jets.iter_mut().zip(&scratch.shift) {
                        jet.v = jet.v + zero.lit(shift);
                    }
                }
                let value = match source {
                    Source::Partition if components == 0 => weight,
                    Source::Partition => jets[0].v,
                    _ => {
                        let x = zero.load(&self.scene.xs[column..]);
                        let offset = [x, splat(zero, self.scene.ys[first_row + row])];
                        let moduli = if UNIFORM { moduli } else { equation.moduli(anchor, offset) };
                        quantity.of_field(&Sample { anchor, offset, moduli, jets, exact: &exact })
                    }
                };
                clear(cell, zero);
                value.store_some(&mut line[column..]);
            }
            column += R::LANES;
            start += ROWS * stride;
        }
    }
}

/// The quotients of the sums, and the sum of the weights.
#[inline(always)]
fn divide<R: Real, const D: usize>(cell: &[R::Scalar], jets: &mut [Jet<R>], zero: R) -> R {
    let size = size::<R, D>();
    let weight = load_jet::<R, D>(cell, zero);
    let mut component = 0;
    while component < jets.len() {
        let sum = load_jet::<R, D>(&cell[(component + 1) * size..], zero);
        jets[component] = sum.over::<D>(weight);
        component += 1;
    }
    weight.v
}

#[inline(always)]
fn clear<R: Real>(cell: &mut [R::Scalar], like: R) {
    let zero = like.lit(0.0);
    for lanes in cell.chunks_exact_mut(R::LANES) {
        zero.store(lanes);
    }
}
