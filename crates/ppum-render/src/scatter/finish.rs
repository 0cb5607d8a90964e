//! From the field's components at a column of vectors to the values of a quantity.

use ppum::equation::Moduli;
use ppum::jet::Jet;
use ppum::quantity::{Quantity, QuantityBlock, Sample, Source};
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
        let Scratch { sums, shift, formulas, .. } = scratch;
        let mut pending = match quantity {
            Quantity::Formula(formula) => Some(Pending::new(formula.block(formulas), &moduli)),
            _ => None,
        };
        let rows = out.len() / width;
        for row in 0..rows {
            let cell = &sums[start + row * stride..][..stride];
            if source == Source::Exact {
                exact.resize(components, zero);
                let pixel = [column, first_row + row];
                self.scene.load_exact(pixel, shift, &mut exact, zero);
            }
            load::<R, D>(cell, jets, zero);
            if matches!(source, Source::Values | Source::Partition) || pending.is_some() {
                for (jet, &shift) in jets.iter_mut().zip(&*shift) {
                    jet.v = jet.v + zero.lit(shift);
                }
            }
            let value = match source {
                Source::Partition if components == 0 => zero.load(cell),
                Source::Partition => jets[0].v,
                _ => {
                    let offset = self.offset(vector, row, zero);
                    let moduli = if UNIFORM { moduli } else { equation.moduli(anchor, offset) };
                    let sample = Sample { anchor, offset, moduli, jets, exact: &exact };
                    if let Some(pending) = &mut pending {
                        pending.add(&sample, UNIFORM);
                        if pending.is_full::<R>() || row + 1 == rows {
                            let lines = &mut out[(row + 1 - pending.count) * width..];
                            pending.write(lines, (width, column), zero);
                        }
                        continue;
                    }
                    quantity.of_field(&sample)
                }
            };
            value.store_some(&mut out[row * width..][..width][column..]);
        }
    }
}

/// Rows of a column of vectors whose values a formula will give, a block at a time.
struct Pending<'a, T> {
    block: QuantityBlock<'a, T>,
    count: usize,
}

impl<'a, T: Scalar> Pending<'a, T> {
    /// None yet; the equation's constants may be the same everywhere.
    #[inline(always)]
    fn new<R: Real<Scalar = T>>(mut block: QuantityBlock<'a, T>, moduli: &Moduli<R>) -> Self {
        for vector in 0..QuantityBlock::<T>::vectors::<R>() {
            block.set_moduli(vector, moduli);
        }
        Self { block, count: 0 }
    }

    /// Takes the field at the next row.
    #[inline(always)]
    fn add<R: Real<Scalar = T>>(&mut self, at: &Sample<'_, R>, is_uniform: bool) {
        self.block.set(self.count, at);
        if !is_uniform {
            self.block.set_moduli(self.count, &at.moduli);
        }
        self.count += 1;
    }

    #[inline(always)]
    fn is_full<R: Real<Scalar = T>>(&self) -> bool {
        self.count == QuantityBlock::<T>::vectors::<R>()
    }

    /// Writes the rows to the first lines, from a column on.
    #[inline(always)]
    fn write<R: Real<Scalar = T>>(
        &mut self,
        lines: &mut [T],
        (width, column): (usize, usize),
        like: R,
    ) {
        self.block.run();
        for (row, line) in lines.chunks_exact_mut(width).enumerate().take(self.count) {
            self.block.value(row, like).store_some(&mut line[column..]);
        }
        self.count = 0;
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
