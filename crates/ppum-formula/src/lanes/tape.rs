//! Tapes: programs for the lane interpreter, with their results in few registers.
//!
//! A register holds one number for each point of a block. Outputs and inputs have one each; the
//! others are *slots*, used again when their number has had its last use. Constants need none.
//! Products that are used once, by a sum, a difference, a product or a quotient, become one step
//! with it: that saves the way through memory, and rounds as before.

use std::sync::Arc;

use super::interpret::{Instruction, Tape, TapeAction};
use crate::graph::{NodeId, Op};
use crate::operation::{Binary, Comparison, Unary};
use crate::program::FormulaProgram;

impl Tape {
    /// The tape of a program with a number of inputs.
    pub(crate) fn new(program: &FormulaProgram, n_inputs: usize) -> Self {
        let lowered = lowered(program);
        let mut writer = TapeWriter::new(program, &lowered, n_inputs);
        for (id, form) in (0..).map(NodeId).zip(&lowered) {
            if let Some(form) = form {
                writer.instruction(id, form);
            }
        }
        writer.copy_outputs(program);
        Self {
            instructions: writer.instructions,
            constants: writer.constants,
            tables: Arc::clone(program.tables()),
            n_outputs: program.outputs().len(),
            n_inputs,
            n_slots: writer.n_slots as usize,
        }
    }

    /// Number of registers.
    pub(crate) fn n_registers(&self) -> usize {
        self.n_outputs + self.n_inputs + self.n_slots
    }
}

/// The action that computes an operation, and its operands.
#[derive(Clone, Debug)]
struct LoweredOperation {
    action: TapeAction,
    operands: Vec<NodeId>,
}

/// The forms of the operations; none for constants, inputs, and products that are part of
/// the form of their only user.
fn lowered(program: &FormulaProgram) -> Vec<Option<LoweredOperation>> {
    let mut lowered = vec![None; program.ops().len()];
    let mut products = FusedProducts::new(program);
    for id in (0..program.ops().len()).rev() {
        if !products.is_absorbed[id] {
            lowered[id] = form(program.ops()[id], &mut products);
        }
    }
    lowered
}

/// The products that can be computed by their only user.
struct FusedProducts<'a> {
    ops: &'a [Op],
    /// Number of times each operation is an operand; outputs count as many.
    uses: Vec<u32>,
    is_absorbed: Vec<bool>,
}

impl<'a> FusedProducts<'a> {
    fn new(program: &'a FormulaProgram) -> Self {
        let ops = program.ops();
        let mut uses = vec![0; ops.len()];
        for operand in ops.iter().copied().flat_map(Op::operands) {
            uses[operand.index()] += 1;
        }
        for output in program.outputs() {
            uses[output.index()] += 2;
        }
        Self { ops, uses, is_absorbed: vec![false; ops.len()] }
    }

    /// The factors of a node if it is such a product, a constant one last.
    fn factors(&self, node: NodeId) -> Option<[NodeId; 2]> {
        if self.uses[node.index()] != 1 {
            return None;
        }
        match self.ops[node.index()] {
            Op::Binary(Binary::Mul, a, b) if self.is_constant(a) => Some([b, a]),
            Op::Binary(Binary::Mul, a, b) => Some([a, b]),
            Op::Power(a, 2) => Some([a, a]),
            _ => None,
        }
    }

    fn is_constant(&self, node: NodeId) -> bool {
        matches!(self.ops[node.index()], Op::Constant(_) | Op::Truth(_))
    }

    /// A step that computes the product `p` and another operation.
    fn three(&mut self, op: TapeAction, p: NodeId, other: NodeId) -> Option<LoweredOperation> {
        let [a, b] = self.factors(p)?;
        self.is_absorbed[p.index()] = true;
        Some(LoweredOperation { action: op, operands: vec![a, b, other] })
    }

    /// A step that computes the products `p` and `q` and their sum or difference.
    fn four(&mut self, op: TapeAction, p: NodeId, q: NodeId) -> Option<LoweredOperation> {
        let [[a, b], [c, d]] = [self.factors(p)?, self.factors(q)?];
        if self.is_constant(b) || self.is_constant(d) {
            return None;
        }
        self.is_absorbed[p.index()] = true;
        self.is_absorbed[q.index()] = true;
        Some(LoweredOperation { action: op, operands: vec![a, b, c, d] })
    }
}

fn form(op: Op, products: &mut FusedProducts<'_>) -> Option<LoweredOperation> {
    let joined = match op {
        Op::Binary(Binary::Add, a, b) => products
            .four(TapeAction::MulAddMul, a, b)
            .or_else(|| products.three(TapeAction::MulAdd, a, b))
            .or_else(|| products.three(TapeAction::MulAdd, b, a)),
        Op::Binary(Binary::Sub, a, b) => products
            .four(TapeAction::MulSubMul, a, b)
            .or_else(|| products.three(TapeAction::MulSub, a, b))
            .or_else(|| products.three(TapeAction::SubMul, b, a)),
        Op::Binary(Binary::Mul, a, b) => products
            .three(TapeAction::MulMul, a, b)
            .or_else(|| products.three(TapeAction::MulMul, b, a)),
        Op::Binary(Binary::Div, a, b) => products.three(TapeAction::MulDiv, a, b),
        _ => None,
    };
    joined.or_else(|| {
        let action = action(op)?;
        Some(LoweredOperation { action, operands: op.operands().collect() })
    })
}

/// The action of an operation by itself; none for constants and inputs.
fn action(op: Op) -> Option<TapeAction> {
    Some(match op {
        Op::Constant(_) | Op::Input(_) | Op::Truth(_) => return None,
        Op::Unary(op, _) => op.into(),
        Op::Power(_, 2) => TapeAction::Square,
        Op::Power(_, n) => TapeAction::Power(n),
        Op::Binary(op, ..) => op.into(),
        Op::Table { table, orders, .. } => TapeAction::Table { table, orders },
        Op::Select(..) => TapeAction::Select,
        Op::Compare(Comparison::Less, ..) => TapeAction::Less,
        Op::Compare(Comparison::LessEqual, ..) => TapeAction::LessEqual,
        Op::Compare(Comparison::Equal, ..) => TapeAction::Equal,
        // of the numbers 1 and 0
        Op::Not(_) => TapeAction::Not,
        Op::And(..) => TapeAction::Mul,
        Op::Or(..) => TapeAction::Max,
    })
}

/// The actions of operations, which have their names.
macro_rules! actions_of {
    ($type:ident: $($name:ident)+) => {
        impl From<$type> for TapeAction {
            fn from(op: $type) -> Self {
                match op { $($type::$name => Self::$name,)+ }
            }
        }
    };
}

actions_of!(Unary: Neg Sqrt Cbrt Exp Log Log10 Sin Cos Tan Asin Acos Atan Sinh Cosh Tanh Abs Sign Floor);
actions_of!(Binary: Add Sub Mul Div Pow Atan2 Min Max Hypot);

/// The register or constant that holds the result of an operation.
#[derive(Clone, Copy, Debug, PartialEq)]
enum ResultLocation {
    Register(u32),
    Constant(u32),
    Nowhere,
}

/// Assigns registers while it writes the steps in order.
struct TapeWriter {
    instructions: Vec<Instruction>,
    constants: Vec<f64>,
    /// The place of each operation so far.
    locations: Vec<ResultLocation>,
    /// The last operation whose form has each as an operand.
    last_use: Vec<u32>,
    /// The output register of the operations that are outputs.
    output: Vec<Option<u32>>,
    /// Slots whose numbers are used up.
    free: Vec<u32>,
    first_slot: u32,
    n_slots: u32,
}

impl TapeWriter {
    fn new(
        program: &FormulaProgram,
        lowered: &[Option<LoweredOperation>],
        n_inputs: usize,
    ) -> Self {
        let mut last_use = vec![0; lowered.len()];
        for (user, form) in (0..).zip(lowered) {
            for operand in form.iter().flat_map(|form| &form.operands) {
                last_use[operand.index()] = user;
            }
        }
        let mut output = vec![None; lowered.len()];
        for (register, node) in (0..).zip(program.outputs()) {
            output[node.index()].get_or_insert(register);
        }
        let n_outputs = program.outputs().len() as u32;
        let mut constants = Vec::new();
        let mut constant = |value| {
            constants.push(value);
            ResultLocation::Constant(constants.len() as u32 - 1)
        };
        let location = |&op: &Op| match op {
            Op::Constant(bits) => constant(f64::from_bits(bits)),
            Op::Truth(holds) => constant(f64::from(u8::from(holds))),
            Op::Input(index) => ResultLocation::Register(n_outputs + index),
            _ => ResultLocation::Nowhere,
        };
        Self {
            instructions: Vec::new(),
            locations: program.ops().iter().map(location).collect(),
            constants,
            last_use,
            output,
            free: Vec::new(),
            first_slot: n_outputs + n_inputs as u32,
            n_slots: 0,
        }
    }

    fn instruction(&mut self, id: NodeId, form: &LoweredOperation) {
        let (mut operands, mut mask) = ([0; 4], 0);
        for (k, operand) in form.operands.iter().enumerate() {
            operands[k] = match self.locations[operand.index()] {
                ResultLocation::Register(register) => register,
                ResultLocation::Constant(constant) => {
                    mask |= 1 << k;
                    constant
                }
                ResultLocation::Nowhere => unreachable!("operands come before what uses them"),
            };
        }
        for operand in &form.operands {
            self.free_after(*operand, id);
        }
        let to = self.output[id.index()].unwrap_or_else(|| self.slot());
        self.instructions.push(Instruction { action: form.action, operands, constants: mask, to });
        self.locations[id.index()] = ResultLocation::Register(to);
    }

    /// A slot that is free.
    fn slot(&mut self) -> u32 {
        self.free.pop().unwrap_or_else(|| {
            self.n_slots += 1;
            self.first_slot + self.n_slots - 1
        })
    }

    /// Frees the slot of an operand if this was its last use.
    fn free_after(&mut self, operand: NodeId, user: NodeId) {
        if let ResultLocation::Register(register) = self.locations[operand.index()]
            && register >= self.first_slot
            && self.last_use[operand.index()] == user.0
        {
            self.locations[operand.index()] = ResultLocation::Nowhere;
            self.free.push(register);
        }
    }

    /// Fills the outputs that are constants, inputs, or equal to earlier outputs.
    fn copy_outputs(&mut self, program: &FormulaProgram) {
        for (to, node) in (0..).zip(program.outputs()) {
            let (action, operand) = match self.locations[node.index()] {
                ResultLocation::Register(register) if register == to => continue,
                ResultLocation::Register(register) => (TapeAction::Copy, register),
                ResultLocation::Constant(constant) => (TapeAction::Fill, constant),
                ResultLocation::Nowhere => unreachable!("outputs are no slots"),
            };
            self.instructions.push(Instruction {
                action,
                operands: [operand, 0, 0, 0],
                constants: 0,
                to,
            });
        }
    }
}
