//! From the field's components at a column of vectors to the values of a quantity, row by row, or,
//! by a formula, some rows at a time.

use ppum::jet::Jet;
use ppum::quantity::{Quantity, QuantityBlock, QuantityFormula, QuantityInput, Sample, Source};
use ppum::real::{LaneNumber, Real};

use super::collapse::{ANY, Slopes, constant_or};
use super::layout::{load_slopes, size};
use super::tile::{Tile, TileScratch};

impl<T: LaneNumber, const D: usize> Tile<'_, '_, T, D> {
    /// Makes the quantity of what begins at `start` and writes it to the raster. The quantity most
    /// often drawn is compiled as a constant: the choice between thirty costs more than it.
    #[inline(always)]
    pub(super) fn finish<R: Real<Scalar = T>>(
        &self,
        vector: usize,
        start: usize,
        scratch: &mut TileScratch<T>,
        out: &mut [T],
        zero: R,
    ) {
        let uniform = self.scene.field.equation.is_uniform();
        match (self.scene.quantity, scratch.shift.len()) {
            (Quantity::Formula(formula), _) => {
                self.finish_formula(formula, (vector, start), scratch, out, zero);
            }
            (Quantity::VonMises, 2) if const { D >= 1 && R::LANES > 1 } && uniform => {
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
        scratch: &mut TileScratch<T>,
        out: &mut [T],
        zero: R,
    ) {
        let components = constant_or(C, scratch.shift.len());
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
        let TileScratch { sums, shift, .. } = scratch;
        let rows = out.len() / width;
        for row in 0..rows {
            let cell = &sums[start + row * stride..][..stride];
            if source == Source::Exact {
                exact.resize(components, zero);
                let pixel = [column, first_row + row];
                self.scene.load_exact(pixel, shift, &mut exact, zero);
            }
            load::<R, D>(cell, jets, zero);
            // a temperature, and u_x of the hoop strain, are values among derivatives
            let has_values = C != 2 && components > 2 || moduli.axisymmetric;
            let has_values = has_values && source == Source::Gradient;
            if has_values || matches!(source, Source::Values | Source::Partition) {
                for (jet, &shift) in jets.iter_mut().zip(&*shift) {
                    jet.v = jet.v + zero.broadcast(shift);
                }
            }
            let value = match source {
                Source::Partition if components == 0 => zero.load(cell),
                Source::Partition => jets[0].v,
                _ => {
                    let offset = self.offset(vector, row, zero);
                    let moduli = if UNIFORM { moduli } else { equation.moduli(anchor, offset) };
                    let sample = Sample { anchor, offset, moduli, jets, exact: &exact };
                    quantity.of_field(&sample)
                }
            };
            value.store_some(&mut out[row * width..][..width][column..]);
        }
    }

    /// [`finish`](Self::finish) for a formula, which is run at some rows at a time.
    #[inline(always)]
    fn finish_formula<R: Real<Scalar = T>>(
        &self,
        formula: &QuantityFormula,
        (vector, start): (usize, usize),
        scratch: &mut TileScratch<T>,
        out: &mut [T],
        zero: R,
    ) {
        let TileScratch { sums, shift, formulas, .. } = scratch;
        let mut block = formula.block(formulas);
        let some = QuantityBlock::<T>::vectors::<R>();
        let width = self.scene.view.pixels[0] as usize;
        let column = self.corner()[0] + vector * R::LANES;
        let rows = out.len() / width;
        let mut row = 0;
        while row < rows {
            let count = some.min(rows - row);
            let cells = &sums[start + row * self.stride::<R>()..];
            self.set_moduli(&mut block, row == 0, [vector, row, count], zero);
            for &(index, input) in block.field_inputs() {
                let numbers = &mut block.input_mut(index)[..count * R::LANES];
                self.fill_input(input, (cells, shift), [vector, row], numbers, zero);
            }
            block.run();
            for (k, line) in out[row * width..].chunks_exact_mut(width).take(count).enumerate() {
                block.value(k, zero).store_some(&mut line[column..]);
            }
            row += count;
        }
    }

    /// The equation's constants at some rows, once if they are the same everywhere.
    #[inline(always)]
    fn set_moduli<R: Real<Scalar = T>>(
        &self,
        block: &mut QuantityBlock<'_, T>,
        is_first: bool,
        [vector, row, count]: [usize; 3],
        zero: R,
    ) {
        let (equation, anchor) = (self.scene.field.equation, self.scene.view.center);
        if equation.is_uniform() && is_first {
            let moduli = equation.moduli(anchor, [zero; 2]);
            for k in 0..QuantityBlock::<T>::vectors::<R>() {
                block.set_moduli(k, &moduli);
            }
        }
        if !equation.is_uniform() {
            for k in 0..count {
                block.set_moduli(k, &equation.moduli(anchor, self.offset(vector, row + k, zero)));
            }
        }
    }

    /// The numbers of an input at the rows from `row` on, whose components are in the cells. Which
    /// one it is, is asked once for all of them.
    #[inline(always)]
    fn fill_input<R: Real<Scalar = T>>(
        &self,
        input: QuantityInput,
        (cells, shift): (&[T], &[f64]),
        [vector, row]: [usize; 2],
        numbers: &mut [T],
        zero: R,
    ) {
        let anchor = self.scene.view.center;
        let stride = self.stride::<R>();
        let (axis, component, part, add) = match input {
            QuantityInput::X => (Some(0), 0, 0, anchor.x),
            QuantityInput::Y => (Some(1), 0, 0, anchor.y),
            QuantityInput::Value(c) => (None, c, 0, shift[c]),
            QuantityInput::SlopeX(c) => (None, c, 1, 0.0),
            QuantityInput::SlopeY(c) => (None, c, 2, 0.0),
            _ => return,
        };
        let at = (1 + component) * size::<R, D>() + part * R::LANES;
        for (k, numbers) in numbers.chunks_exact_mut(R::LANES).enumerate() {
            let number = match axis {
                Some(axis) => self.offset(vector, row + k, zero)[axis],
                None => zero.load(&cells[k * stride + at..]),
            };
            (number + zero.broadcast(add)).store(numbers);
        }
    }
}

/// The components, behind the weight.
#[inline(always)]
fn load<R: Real, const D: usize>(cell: &[R::Scalar], jets: &mut [Jet<R>], zero: R) {
    let size = size::<R, D>();
    let mut component = 0;
    while component < jets.len() {
        let Slopes { v, x, y } = load_slopes::<R, D>(&cell[(component + 1) * size..], zero);
        jets[component] = Jet { v, x, y, ..Jet::constant(v) };
        component += 1;
    }
}
