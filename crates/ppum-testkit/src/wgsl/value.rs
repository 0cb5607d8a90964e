//! Values and the operations on them.

use std::fmt::Debug;

use naga::{
    BinaryOperator, Handle, Literal, LocalVariable, MathFunction, ScalarKind, UnaryOperator,
};

/// What an expression gives.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    F32(f32),
    I32(i32),
    U32(u32),
    Bool(bool),
    /// An array or a vector.
    List(Vec<Value>),
    /// Where a variable is.
    Pointer(Handle<LocalVariable>),
}

use Value::{Bool, F32, I32, List, U32};

/// That a construct is not known here.
pub(super) fn unknown<T>(what: impl Debug) -> Result<T, String> {
    Err(format!("the interpreter does not know {what:?}"))
}

impl Value {
    pub(super) fn literal(literal: Literal) -> Result<Self, String> {
        match literal {
            Literal::F32(v) => Ok(F32(v)),
            Literal::I32(v) => Ok(I32(v)),
            Literal::U32(v) => Ok(U32(v)),
            Literal::Bool(v) => Ok(Bool(v)),
            other => unknown(other),
        }
    }

    /// The number, or those of an array.
    pub(super) fn numbers(self) -> Result<Vec<f32>, String> {
        match self {
            F32(v) => Ok(vec![v]),
            List(values) => {
                Ok(values.into_iter().map(Self::numbers).collect::<Result<Vec<_>, _>>()?.concat())
            }
            other => unknown(other),
        }
    }

    pub(super) fn holds(&self) -> Result<bool, String> {
        match self {
            Bool(holds) => Ok(*holds),
            other => unknown(("a condition", other)),
        }
    }

    pub(super) fn index(&self) -> Result<usize, String> {
        match self {
            U32(i) => Ok(*i as usize),
            I32(i) => usize::try_from(*i).map_err(|_| format!("index {i}")),
            other => unknown(("an index", other)),
        }
    }

    pub(super) fn element(&self, index: usize) -> Result<Self, String> {
        let List(values) = self else { return unknown(("an element of", self)) };
        let found = values.get(index).cloned();
        found.ok_or_else(|| format!("index {index} of {} elements", values.len()))
    }

    /// `convert` is the width of a conversion; without it the bits stay.
    pub(super) fn cast(&self, kind: ScalarKind, convert: Option<u8>) -> Result<Self, String> {
        Ok(match (self, kind, convert) {
            (F32(v), ScalarKind::Float, _) => F32(*v),
            (U32(v), ScalarKind::Uint, _) => U32(*v),
            (I32(v), ScalarKind::Sint, _) => I32(*v),
            (F32(v), ScalarKind::Uint, None) => U32(v.to_bits()),
            (U32(v), ScalarKind::Float, None) => F32(f32::from_bits(*v)),
            (U32(v), ScalarKind::Float, Some(4)) => F32(*v as f32),
            (I32(v), ScalarKind::Float, Some(4)) => F32(*v as f32),
            (F32(v), ScalarKind::Uint, Some(4)) => U32(*v as u32),
            (F32(v), ScalarKind::Sint, Some(4)) => I32(*v as i32),
            other => return unknown(other),
        })
    }
}

pub(super) fn unary(op: UnaryOperator, a: &Value) -> Result<Value, String> {
    match (op, a) {
        (UnaryOperator::Negate, F32(a)) => Ok(F32(-a)),
        (UnaryOperator::Negate, I32(a)) => Ok(I32(a.wrapping_neg())),
        (UnaryOperator::LogicalNot, Bool(a)) => Ok(Bool(!a)),
        (UnaryOperator::BitwiseNot, U32(a)) => Ok(U32(!a)),
        other => unknown(other),
    }
}

pub(super) fn binary(op: BinaryOperator, a: &Value, b: &Value) -> Result<Value, String> {
    let result = match (a, b) {
        (F32(a), F32(b)) => arithmetic(op, *a, *b).map(F32).or_else(|| compare(op, a, b)),
        (U32(a), U32(b)) => integer(op, *a, *b).map(U32).or_else(|| compare(op, a, b)),
        (I32(a), I32(b)) => compare(op, a, b),
        (Bool(a), Bool(b)) => logic(op, *a, *b).map(Bool),
        _ => None,
    };
    result.map_or_else(|| unknown((op, a, b)), Ok)
}

fn arithmetic(op: BinaryOperator, a: f32, b: f32) -> Option<f32> {
    Some(match op {
        BinaryOperator::Add => a + b,
        BinaryOperator::Subtract => a - b,
        BinaryOperator::Multiply => a * b,
        BinaryOperator::Divide => a / b,
        _ => return None,
    })
}

fn integer(op: BinaryOperator, a: u32, b: u32) -> Option<u32> {
    Some(match op {
        BinaryOperator::Add => a.wrapping_add(b),
        BinaryOperator::Subtract => a.wrapping_sub(b),
        BinaryOperator::Multiply => a.wrapping_mul(b),
        BinaryOperator::Divide => a.checked_div(b)?,
        BinaryOperator::Modulo => a.checked_rem(b)?,
        BinaryOperator::And => a & b,
        BinaryOperator::InclusiveOr => a | b,
        BinaryOperator::ExclusiveOr => a ^ b,
        BinaryOperator::ShiftLeft => a.checked_shl(b)?,
        BinaryOperator::ShiftRight => a.checked_shr(b)?,
        _ => return None,
    })
}

fn compare<T: PartialOrd>(op: BinaryOperator, a: &T, b: &T) -> Option<Value> {
    Some(Bool(match op {
        BinaryOperator::Equal => a == b,
        BinaryOperator::NotEqual => a != b,
        BinaryOperator::Less => a < b,
        BinaryOperator::LessEqual => a <= b,
        BinaryOperator::Greater => a > b,
        BinaryOperator::GreaterEqual => a >= b,
        _ => return None,
    }))
}

fn logic(op: BinaryOperator, a: bool, b: bool) -> Option<bool> {
    Some(match op {
        BinaryOperator::LogicalAnd | BinaryOperator::And => a && b,
        BinaryOperator::LogicalOr | BinaryOperator::InclusiveOr => a || b,
        BinaryOperator::Equal => a == b,
        BinaryOperator::NotEqual => a != b,
        _ => return None,
    })
}

pub(super) fn math(function: MathFunction, arguments: &[Value]) -> Result<Value, String> {
    let result = match *arguments {
        [F32(a)] => exact(function, a).or_else(|| rounded(function, f64::from(a))),
        [F32(a), F32(b)] => of_two(function, a, b),
        _ => None,
    };
    result.map_or_else(|| unknown((function, arguments)), |result| Ok(F32(result)))
}

/// Functions that IEEE 754 rounds correctly.
fn exact(function: MathFunction, a: f32) -> Option<f32> {
    Some(match function {
        MathFunction::Abs => a.abs(),
        MathFunction::Floor => a.floor(),
        MathFunction::Sqrt => a.sqrt(),
        _ => return None,
    })
}

fn rounded(function: MathFunction, a: f64) -> Option<f32> {
    let result = match function {
        MathFunction::Exp => a.exp(),
        MathFunction::Exp2 => a.exp2(),
        MathFunction::Log => a.ln(),
        MathFunction::Log2 => a.log2(),
        MathFunction::Sin => a.sin(),
        MathFunction::Cos => a.cos(),
        MathFunction::Tan => a.tan(),
        MathFunction::Asin => a.asin(),
        MathFunction::Acos => a.acos(),
        MathFunction::Atan => a.atan(),
        MathFunction::Sinh => a.sinh(),
        MathFunction::Cosh => a.cosh(),
        MathFunction::Tanh => a.tanh(),
        _ => return None,
    };
    Some(result as f32)
}

fn of_two(function: MathFunction, a: f32, b: f32) -> Option<f32> {
    let open = match function {
        MathFunction::Min | MathFunction::Max => a.is_nan() || b.is_nan(),
        MathFunction::Atan2 => a == 0.0,
        MathFunction::Pow => a < 0.0,
        _ => return None,
    };
    Some(match function {
        _ if open => f32::NAN,
        MathFunction::Min => a.min(b),
        MathFunction::Max => a.max(b),
        MathFunction::Atan2 => f64::from(a).atan2(f64::from(b)) as f32,
        // as WGSL defines it
        _ => (f64::from(b) * f64::from(a).log2()).exp2() as f32,
    })
}
