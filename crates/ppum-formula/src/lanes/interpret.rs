//! The lane interpreter: runs a [`Tape`] on a block of points, with SIMD chosen at run time.
//!
//! A step works on all eight vectors of a block before the next step begins, and without a loop: so
//! the processor foresees the jumps from step to step, finding out what a step does costs little,
//! and all registers of a formula stay in the cache next to it. Arithmetic, roots, comparisons and
//! selections are done on lanes, and so are [elementary functions](crate::elementary) and tables,
//! these in double precision. Nothing is fused: in double precision each result is that of the
//! scalar back end to the last bit.

use std::sync::Arc;

use crate::elementary;
use crate::real::{Double, DoubleFunction, LaneJob, LaneNumber, NumberKind, Real};
use crate::table::Table;

/// Vectors of a block: enough that a step's work outweighs its start.
pub(crate) const VECTORS: usize = 8;

/// A program for blocks of points.
#[derive(Clone, Debug)]
pub(crate) struct Tape {
    pub(crate) instructions: Vec<Instruction>,
    pub(crate) constants: Vec<f64>,
    pub(crate) tables: Arc<[Arc<Table>]>,
    /// Registers 0 .. `n_outputs` are the outputs, `n_inputs` more the inputs, then `n_slots`
    /// slots.
    pub(crate) n_outputs: usize,
    pub(crate) n_inputs: usize,
    pub(crate) n_slots: usize,
}

/// One operation on all points of a block.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Instruction {
    pub(crate) action: TapeAction,
    /// Registers, or indices of constants.
    pub(crate) operands: [u32; 4],
    /// The operands that are constants: bit k stands for operand k.
    pub(crate) constants: u8,
    /// The register it writes; it may be that of an operand.
    pub(crate) to: u32,
}

/// Runs a tape; `registers` are its registers one after the other. It is not generic, so that the
/// interpreter is compiled here and not in every crate that uses it.
pub(crate) fn interpret(tape: &Tape, registers: NumberKind<'_>) {
    match registers {
        NumberKind::Double(registers) => f64::dispatch(TapeRun { tape, registers }),
        NumberKind::Single(registers) => f32::dispatch(TapeRun { tape, registers }),
    }
}

struct TapeRun<'r, T> {
    tape: &'r Tape,
    registers: &'r mut [T],
}

impl<T: LaneNumber> LaneJob<T> for TapeRun<'_, T> {
    type Output = ();

    #[inline(always)]
    fn run<R: Real<Scalar = T>>(self, zero: R) {
        let (registers, _) = R::arrays_mut(self.registers).as_chunks_mut();
        let mut part = 0;
        while part < TapeMachine::<R>::PARTS {
            let registers = &mut registers[part..];
            let mut machine = TapeMachine { tape: self.tape, registers, zero };
            for op in &self.tape.instructions {
                machine.run(op);
            }
            part += 1;
        }
    }
}

/// The numbers of a register, or of a part of it.
type Register<R> = [<R as Real>::Array; VECTORS];

/// A tape with its registers, from the first of their parts on that it computes.
struct TapeMachine<'r, R: Real> {
    tape: &'r Tape,
    registers: &'r mut [Register<R>],
    zero: R,
}

impl<R: Real> TapeMachine<'_, R> {
    /// Parts of a register that are computed one after the other: without vectors a block has more
    /// points than [`VECTORS`].
    const PARTS: usize = R::Scalar::VECTOR / R::LANES;
}

/// A function of `N` numbers on lanes.
trait LaneFunction<const N: usize>: Copy {
    fn apply<R: Real>(self, operands: [R; N]) -> R;
}

/// A step's operand on lanes.
trait Operand<R: Real>: Copy {
    /// Its vector `k`.
    fn at(self, registers: &[Register<R>], k: usize) -> R;
}

/// The numbers of a register.
#[derive(Clone, Copy)]
struct RegisterNumbers<R> {
    register: usize,
    zero: R,
}

impl<R: Real> Operand<R> for RegisterNumbers<R> {
    #[inline(always)]
    fn at(self, registers: &[Register<R>], k: usize) -> R {
        self.zero.load_array(&registers[self.register * TapeMachine::<R>::PARTS][k])
    }
}

/// A number that is the same at all points.
#[derive(Clone, Copy)]
struct UniformNumber<R>(R);

impl<R: Real> Operand<R> for UniformNumber<R> {
    #[inline(always)]
    fn at(self, _: &[Register<R>], _: usize) -> R {
        self.0
    }
}

/// The function `value` of some numbers.
macro_rules! function {
    ([$($a:ident),+] $value:expr) => {{
        #[derive(Clone, Copy)]
        struct ScalarFunction;
        impl LaneFunction<{ [$(stringify!($a)),+].len() }> for ScalarFunction {
            #[inline(always)]
            fn apply<R: Real>(self, [$($a),+]: [R; [$(stringify!($a)),+].len()]) -> R {
                $value
            }
        }
        ScalarFunction
    }};
}

/// Actions on lanes: name, function of the machine for as many operands, meaning.
macro_rules! actions {
    ($($name:ident = $run:ident [$($a:ident),+] $value:expr;)+) => {
        /// The action of a step. Conditions are the numbers 1 and 0.
        #[derive(Clone, Copy, Debug, PartialEq)]
        pub(crate) enum TapeAction {
            $($name,)+
            /// An integer power.
            Power(i32),
            /// A constant at all points.
            Fill,
            /// A derivative of a table.
            Table { table: u32, orders: [u8; 2] },
        }

        impl<R: Real> TapeMachine<'_, R> {
            #[inline(always)]
            fn run(&mut self, op: &Instruction) {
                match op.action {
                    $(TapeAction::$name => self.$run(function!([$($a),+] $value), op),)+
                    TapeAction::Power(n) => self.one(Power(n), op),
                    TapeAction::Fill => self.each1(function!([a] a), self.same(op, 0), op),
                    TapeAction::Table { table, orders } => {
                        let tape = self.tape;
                        self.long(TableLookUp { table: &tape.tables[table as usize], orders }, op);
                    }
                }
            }
        }
    };
}

actions! {
    Copy = one [a] a;
    Neg = one [a] -a;
    Sqrt = one [a] a.sqrt();
    Abs = one [a] a.abs();
    Floor = one [a] a.floor();
    Sign = one [a] sign(a);
    Square = one [a] a * a;
    Not = one [a] a.broadcast(1.0) - a;
    Add = two [a, b] a + b;
    Sub = two [a, b] a - b;
    Mul = two [a, b] a * b;
    Div = two [a, b] a / b;
    // NaN is not ≥ itself
    Min = two [a, b] R::select(a.ge(a), R::select(b.gt(a), a, b), a);
    Max = two [a, b] R::select(a.ge(a), R::select(a.gt(b), a, b), a);
    Less = two [a, b] R::select(b.gt(a), a.broadcast(1.0), a.broadcast(0.0));
    LessEqual = two [a, b] R::select(b.ge(a), a.broadcast(1.0), a.broadcast(0.0));
    Equal = two [a, b] R::select(b.ge(a), R::select(a.ge(b), a.broadcast(1.0), a.broadcast(0.0)), a.broadcast(0.0));
    MulAdd = three [a, b, c] a * b + c;
    MulSub = three [a, b, c] a * b - c;
    SubMul = three [a, b, c] c - a * b;
    MulMul = three [a, b, c] a * b * c;
    MulDiv = three [a, b, c] a * b / c;
    Select = three [c, a, b] R::select(c.gt(c.broadcast(0.0)), a, b);
    MulAddMul = four [a, b, c, d] a * b + c * d;
    MulSubMul = four [a, b, c, d] a * b - c * d;
    Cbrt = long [a] R::via_f64([a], elementary::Cbrt);
    Exp = long [a] R::via_f64([a], elementary::Exp);
    Log = long [a] R::via_f64([a], elementary::Log);
    Log10 = long [a] R::via_f64([a], elementary::Log10);
    Sin = long [a] R::via_f64([a], elementary::Sin);
    Cos = long [a] R::via_f64([a], elementary::Cos);
    Tan = long [a] R::via_f64([a], elementary::Tan);
    Asin = long [a] R::via_f64([a], elementary::Asin);
    Acos = long [a] R::via_f64([a], elementary::Acos);
    Atan = long [a] R::via_f64([a], elementary::Atan);
    Sinh = long [a] R::via_f64([a], elementary::Sinh);
    Cosh = long [a] R::via_f64([a], elementary::Cosh);
    Tanh = long [a] R::via_f64([a], elementary::Tanh);
    Pow = long [a, b] R::via_f64([a, b], elementary::Pow);
    Atan2 = long [a, b] R::via_f64([a, b], elementary::Atan2);
    Hypot = long [a, b] hypot(a, b);
}

/// −1, 0 or +1; NaN of NaN.
#[inline(always)]
fn sign<R: Real>(a: R) -> R {
    let (zero, one) = (a.broadcast(0.0), a.broadcast(1.0));
    R::select(a.gt(zero), one, R::select(zero.gt(a), -one, a))
}

/// √(a² + b²) as written where the sum is far from the bounds of single precision, as it mostly is;
/// elsewhere in double precision, scaled. Which of the two a lane gets depends on its
/// numbers alone.
#[inline(always)]
fn hypot<R: Real>(a: R, b: R) -> R {
    let (least, greatest) = (a.broadcast(LEAST_SQUARE), a.broadcast(GREATEST_SQUARE));
    let sum = a * a + b * b;
    let usual = R::select(greatest.gt(sum), sum, a.broadcast(0.0));
    let root = sum.sqrt();
    if R::any(least.ge(usual)) {
        return R::select(usual.gt(least), root, R::via_f64([a, b], elementary::Hypot));
    }
    root
}

/// Bounds between which the sum of two squares is as exact as its summands, in single
/// precision too.
pub(crate) const LEAST_SQUARE: f64 = 1e-30;
pub(crate) const GREATEST_SQUARE: f64 = 1e30;

/// An integer power, by the products of [`power`](crate::operation::power).
#[derive(Clone, Copy)]
struct Power(i32);

impl LaneFunction<1> for Power {
    #[inline(always)]
    fn apply<R: Real>(self, [a]: [R; 1]) -> R {
        let one = a.broadcast(1.0);
        let (mut square, mut rest, mut product) = (a, self.0.unsigned_abs(), one);
        while rest > 0 {
            if rest & 1 == 1 {
                product = product * square;
            }
            square = square * square;
            rest >>= 1;
        }
        if self.0 < 0 { one / product } else { product }
    }
}

/// A derivative of a table.
#[derive(Clone, Copy)]
struct TableLookUp<'t> {
    table: &'t Table,
    orders: [u8; 2],
}

impl LaneFunction<2> for TableLookUp<'_> {
    #[inline(always)]
    fn apply<R: Real>(self, operands: [R; 2]) -> R {
        R::via_f64(operands, self)
    }
}

impl DoubleFunction<2> for TableLookUp<'_> {
    #[inline(always)]
    fn apply<R: Double>(self, [x, y]: [R; 2]) -> R {
        self.table.derivatives(self.orders, x, y)
    }
}

/// The loops over the vectors of a block, for each pattern of constants that a tape may have.
impl<R: Real> TapeMachine<'_, R> {
    #[inline(always)]
    fn each(&self, op: &Instruction, operand: usize) -> RegisterNumbers<R> {
        RegisterNumbers { register: op.operands[operand] as usize, zero: self.zero }
    }

    #[inline(always)]
    fn same(&self, op: &Instruction, operand: usize) -> UniformNumber<R> {
        UniformNumber(self.zero.broadcast(self.tape.constants[op.operands[operand] as usize]))
    }

    #[inline(always)]
    fn one(&mut self, f: impl LaneFunction<1>, op: &Instruction) {
        self.each1(f, self.each(op, 0), op);
    }

    #[inline(always)]
    fn two(&mut self, f: impl LaneFunction<2>, op: &Instruction) {
        match op.constants {
            0b00 => self.each2(f, self.each(op, 0), self.each(op, 1), op),
            0b01 => self.each2(f, self.same(op, 0), self.each(op, 1), op),
            _ => self.each2(f, self.each(op, 0), self.same(op, 1), op),
        }
    }

    #[inline(always)]
    fn three(&mut self, f: impl LaneFunction<3>, op: &Instruction) {
        let a = self.each(op, 0);
        match op.constants {
            0b000 => self.each3(f, a, self.each(op, 1), self.each(op, 2), op),
            0b010 => self.each3(f, a, self.same(op, 1), self.each(op, 2), op),
            0b100 => self.each3(f, a, self.each(op, 1), self.same(op, 2), op),
            _ => self.each3(f, a, self.same(op, 1), self.same(op, 2), op),
        }
    }

    #[inline(always)]
    fn four(&mut self, f: impl LaneFunction<4>, op: &Instruction) {
        let (a, b) = (self.each(op, 0), self.each(op, 1));
        let (c, d) = (self.each(op, 2), self.each(op, 3));
        let mut k = 0;
        while k < VECTORS {
            let r = &*self.registers;
            let value = f.apply([a.at(r, k), b.at(r, k), c.at(r, k), d.at(r, k)]);
            self.store(value, op, k);
            k += 1;
        }
    }

    /// A function of many operations, any of its operands a constant: a loop, not eight times
    /// its text.
    #[inline(always)]
    fn long<const N: usize>(&mut self, f: impl LaneFunction<N>, op: &Instruction) {
        let mut k = 0;
        while k < VECTORS {
            let (mut operands, mut i) = ([self.zero; N], 0);
            while i < N {
                operands[i] = if op.constants >> i & 1 == 1 {
                    self.same(op, i).0
                } else {
                    self.each(op, i).at(self.registers, k)
                };
                i += 1;
            }
            self.store(f.apply(operands), op, k);
            k += 1;
        }
    }

    #[inline(always)]
    fn each1(&mut self, f: impl LaneFunction<1>, a: impl Operand<R>, op: &Instruction) {
        let mut k = 0;
        while k < VECTORS {
            self.store(f.apply([a.at(self.registers, k)]), op, k);
            k += 1;
        }
    }

    #[inline(always)]
    fn each2(
        &mut self,
        f: impl LaneFunction<2>,
        a: impl Operand<R>,
        b: impl Operand<R>,
        op: &Instruction,
    ) {
        let mut k = 0;
        while k < VECTORS {
            let r = &*self.registers;
            self.store(f.apply([a.at(r, k), b.at(r, k)]), op, k);
            k += 1;
        }
    }

    #[inline(always)]
    fn each3(
        &mut self,
        f: impl LaneFunction<3>,
        a: impl Operand<R>,
        b: impl Operand<R>,
        c: impl Operand<R>,
        op: &Instruction,
    ) {
        let mut k = 0;
        while k < VECTORS {
            let r = &*self.registers;
            self.store(f.apply([a.at(r, k), b.at(r, k), c.at(r, k)]), op, k);
            k += 1;
        }
    }

    #[inline(always)]
    fn store(&mut self, value: R, op: &Instruction, k: usize) {
        value.store_array(&mut self.registers[op.to as usize * Self::PARTS][k]);
    }
}
