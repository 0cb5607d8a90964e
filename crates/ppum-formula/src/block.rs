//! Blocks: evaluation of [`FormulaJets`] at many points at once, on lanes.

use crate::jets::FormulaJets;
use crate::lanes::{Tape, VECTORS, interpret};
use crate::real::LaneNumber;

/// Memory for [`Block`]s, best kept from block to block.
#[derive(Clone, Debug, Default)]
pub struct BlockScratch<T> {
    memory: Vec<T>,
}

impl<T: LaneNumber> BlockScratch<T> {
    /// Memory for `n` numbers.
    fn numbers(&mut self, n: usize) -> &mut [T] {
        let whole = n + T::VECTOR;
        if self.memory.len() < whole {
            self.memory.resize(whole, T::default());
        }
        // Vectors that begin with a cache line are loaded in half the time. Any other place
        // is right.
        let skip = self.memory.as_ptr().align_offset(T::VECTOR * size_of::<T>()).min(T::VECTOR);
        &mut self.memory[skip..skip + n]
    }
}

/// A block of [`Block::POINTS`] points at which formulas are evaluated together.
///
/// Write the inputs, run, read the outputs. Inputs stay what they are until they are written again:
/// one that is the same at all points is written once. Where there are fewer points than the block
/// has, leave the rest as it is and do not read the outputs there.
///
/// ```
/// use ppum_formula::{BlockScratch, Formula, FormulaJets, Scope};
///
/// let f = Formula::parse("x^2*y", &Scope::cartesian())?;
/// let jets = FormulaJets::new(&[&f], 1)?;
/// let mut scratch = BlockScratch::<f32>::default();
/// let mut block = jets.block(&mut scratch);
/// block.input(0)[..3].copy_from_slice(&[1.0, 2.0, 3.0]);
/// block.input(1).fill(0.5);
/// block.run();
/// assert_eq!(block.output(0)[..3], [0.5, 2.0, 4.5]); // value
/// assert_eq!(block.output(1)[..3], [1.0, 2.0, 3.0]); // ∂/∂x
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Block<'a, T> {
    tape: &'a Tape,
    registers: &'a mut [T],
}

impl FormulaJets {
    /// A block for these formulas. Its inputs are whatever the memory holds.
    pub fn block<'a, T: LaneNumber>(&'a self, scratch: &'a mut BlockScratch<T>) -> Block<'a, T> {
        let tape = self.tape();
        Block { tape, registers: scratch.numbers(tape.n_registers() * Block::<T>::POINTS) }
    }
}

impl<T: LaneNumber> Block<'_, T> {
    /// Points of a block: 64 in double, 128 in single precision.
    pub const POINTS: usize = VECTORS * T::VECTOR;

    /// The input of an index among [`Scope::inputs`](crate::Scope::inputs), at each point. Those
    /// that the formulas do not [use](FormulaJets::uses) need not be written.
    ///
    /// # Panics
    /// When there is no such input.
    #[inline]
    pub fn input(&mut self, index: usize) -> &mut [T] {
        assert!(index < self.tape.n_inputs, "there are {} inputs", self.tape.n_inputs);
        let start = (self.tape.n_outputs + index) * Self::POINTS;
        &mut self.registers[start..start + Self::POINTS]
    }

    /// Computes the outputs from the inputs, with the widest vectors of this processor.
    pub fn run(&mut self) {
        interpret(self.tape, T::numbers(self.registers));
    }

    /// The output of an index below [`FormulaJets::n_outputs`], at each point.
    ///
    /// # Panics
    /// When there is no such output.
    #[inline]
    #[must_use]
    pub fn output(&self, index: usize) -> &[T] {
        assert!(index < self.tape.n_outputs, "there are {} outputs", self.tape.n_outputs);
        let start = index * Self::POINTS;
        &self.registers[start..start + Self::POINTS]
    }
}
