//! From the field's components at a column of vectors to the values of a quantity.

use ppum::jet::Jet;
use ppum::quantity::{Quantity, Sample, Source};
use ppum::real::{Real, Scalar};

use super::collapse::{ANY, known};
use super::sums::size;
use super::tile::{Scratch, Tile, load_jet};

impl<T: Scalar, const D: usize> Tile<'_, '_, T, D> {
    /// Makes the quantity of what begins at `start` and writes it to the raster. The quantity most
    /// often drawn is compiled as a constant: the choice between thirty costs more than it.
    #[inline(always)]
    pub(super) fn finish<R: Real<Scalar = T>>(
        &self,
        vector: usize,
        start: usize,
        scratch: &mut Scratch<T>,
        out: &mut [T],
        zero: R,
    ) {
        let uniform = self.scene.field.equation.is_uniform();
        match (self.scene.quantity, scratch.shift.len()) {
            (Quantity::VonMises, 2) if uniform => {
                self.finish_as::<R, 2, true>(
                    &Quantity::VonMises,
                    (vector, start),
                    scratch,
                    out,
                    zero,
                );
            }
            (quantity, 2) if uniform => {
                self.finish_as::<R, 2, true>(quantity, (vector, start), scratch, out, zero);
            }
            (quantity, _) => {
                self.finish_as::<R, ANY, false>(quantity, (vector, start), scratch, out, zero)
            }
        }
    }

    /// [`finish`](Self::finish) for `C` components, and constants of the equation that are the same
    /// everywhere if `UNIFORM`.
    #[inline(always)]
    fn finish_as<R: Real<Scalar = T>, const C: usize, const UNIFORM: bool>(
        &self,
        quantity: &Quantity,
        (vector, start): (usize, usize),
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
        let stride = self.stride::<R>();
        let width = self.scene.view.pixels[0] as usize;
        let [column, first_row] = self.corner();
        let column = column + vector * R::LANES;
        for (row, line) in out.chunks_exact_mut(width).enumerate() {
            let cell = &scratch.sums[start + row * stride..][..stride];
            if source == Source::Exact {
                exact.resize(components, zero);
                let pixel = [column, first_row + row];
                self.scene.load_exact(pixel, &scratch.shift, &mut exact, zero);
            }
            load::<R, D>(cell, jets, zero);
            if matches!(source, Source::Values | Source::Partition)
                || matches!(quantity, Quantity::Formula(_))
            {
                for (jet, &shift) in jets.iter_mut().zip(&scratch.shift) {
                    jet.v = jet.v + zero.lit(shift);
                }
            }
            let value = match source {
                Source::Partition if components == 0 => zero.load(cell),
                Source::Partition => jets[0].v,
                _ => {
                    let offset = self.offset(vector, row, zero);
                    let moduli = if UNIFORM { moduli } else { equation.moduli(anchor, offset) };
                    quantity.of_field(&Sample { anchor, offset, moduli, jets, exact: &exact })
                }
            };
            value.store_some(&mut line[column..]);
        }
    }
}

/// The components, behind the weight.
#[inline(always)]
fn load<R: Real, const D: usize>(cell: &[R::Scalar], jets: &mut [Jet<R>], zero: R) {
    let size = size::<R, D>();
    let mut component = 0;
    while component < jets.len() {
        jets[component] = load_jet::<R, D>(&cell[(component + 1) * size..], zero);
        component += 1;
    }
}
