//! Values and the operations on them.

use std::fmt::Debug;

use naga::{
    BinaryOperator, Handle, Literal, LocalVariable, MathFunction, ScalarKind, UnaryOperator,
};

/// The value of an expression.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum WgslValue {
    F32(f32),
    I32(i32),
    U32(u32),
    Bool(bool),
    /// An array, a vector or a structure.
    List(Vec<WgslValue>),
    /// A variable, or what is reached in it by these indices.
    Pointer(Handle<LocalVariable>, Vec<usize>),
}

use WgslValue::{Bool, F32, I32, List, Pointer, U32};

/// That a construct is not known here.
pub(super) fn unknown<T>(what: impl Debug) -> Result<T, String> {
    Err(format!("the interpreter does not know {what:?}"))
}

impl WgslValue {
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

    /// The zero of a scalar type.
    pub(super) fn zero(kind: ScalarKind) -> Result<Self, String> {
        Ok(match kind {
            ScalarKind::Float => F32(0.0),
            ScalarKind::Uint => U32(0),
            ScalarKind::Sint => I32(0),
            ScalarKind::Bool => Bool(false),
            other => return unknown(other),
        })
    }

    /// The elements of a vector, or a scalar by itself.
    pub(super) fn elements(self) -> Vec<Self> {
        match self {
            List(values) => values,
            scalar => vec![scalar],
        }
    }

    /// The part that some indices reach.
    pub(super) fn part(&mut self, path: &[usize]) -> Result<&mut Self, String> {
        let Some((&index, rest)) = path.split_first() else { return Ok(self) };
        let List(values) = self else { return unknown(("a part of", self)) };
        let count = values.len();
        let found = values.get_mut(index);
        found.ok_or_else(|| format!("index {index} of {count} elements"))?.part(rest)
    }

    /// `accept` where this condition holds, else `reject`.
    pub(super) fn select(&self, accept: &Self, reject: &Self) -> Result<Self, String> {
        if let List(conditions) = self {
            let lanes = conditions.iter().enumerate();
            let lane = |(k, c): (usize, &Self)| c.select(&accept.element(k)?, &reject.element(k)?);
            return lanes.map(lane).collect::<Result<_, _>>().map(List);
        }
        Ok(if self.holds()? { accept.clone() } else { reject.clone() })
    }

    pub(super) fn element(&self, index: usize) -> Result<Self, String> {
        if let Pointer(variable, path) = self {
            return Ok(Pointer(*variable, [&path[..], &[index]].concat()));
        }
        let List(values) = self else { return unknown(("an element of", self)) };
        let found = values.get(index).cloned();
        found.ok_or_else(|| format!("index {index} of {} elements", values.len()))
    }

    /// `convert` is the width of a conversion; without it the bits stay.
    pub(super) fn cast(&self, kind: ScalarKind, convert: Option<u8>) -> Result<Self, String> {
        Ok(match (self, kind, convert) {
            (List(values), ..) => {
                List(values.iter().map(|v| v.cast(kind, convert)).collect::<Result<_, _>>()?)
            }
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

pub(super) fn unary(op: UnaryOperator, a: &WgslValue) -> Result<WgslValue, String> {
    match (op, a) {
        (UnaryOperator::Negate, F32(a)) => Ok(F32(-a)),
        (UnaryOperator::Negate, I32(a)) => Ok(I32(a.wrapping_neg())),
        (UnaryOperator::LogicalNot, Bool(a)) => Ok(Bool(!a)),
        (UnaryOperator::BitwiseNot, U32(a)) => Ok(U32(!a)),
        (_, List(values)) => {
            values.iter().map(|a| unary(op, a)).collect::<Result<_, _>>().map(List)
        }
        other => unknown(other),
    }
}

pub(super) fn binary(
    op: BinaryOperator,
    a: &WgslValue,
    b: &WgslValue,
) -> Result<WgslValue, String> {
    let result = match (a, b) {
        (List(_), _) | (_, List(_)) => return by_element(&[a, b], |ab| binary(op, &ab[0], &ab[1])),
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

fn compare<T: PartialOrd>(op: BinaryOperator, a: &T, b: &T) -> Option<WgslValue> {
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

/// A function of scalars for each element of vectors; scalars among them stand for all elements.
fn by_element(
    arguments: &[&WgslValue],
    of: impl Fn(&[WgslValue]) -> Result<WgslValue, String>,
) -> Result<WgslValue, String> {
    let count = |argument: &&WgslValue| match argument {
        List(values) => values.len(),
        _ => 1,
    };
    let lane = |k: usize| {
        let at = |argument: &&WgslValue| match argument {
            List(_) => argument.element(k),
            scalar => Ok((*scalar).clone()),
        };
        of(&arguments.iter().map(at).collect::<Result<Vec<_>, _>>()?)
    };
    let lanes = arguments.iter().map(count).max().unwrap_or(0);
    (0..lanes).map(lane).collect::<Result<_, _>>().map(List)
}

/// a·b
fn dot(a: &[WgslValue], b: &[WgslValue]) -> Result<WgslValue, String> {
    a.iter().zip(b).try_fold(F32(0.0), |sum, (a, b)| {
        binary(BinaryOperator::Add, &sum, &binary(BinaryOperator::Multiply, a, b)?)
    })
}

pub(super) fn math(function: MathFunction, arguments: &[WgslValue]) -> Result<WgslValue, String> {
    match (function, arguments) {
        (MathFunction::Dot, [List(a), List(b)]) => return dot(a, b),
        (MathFunction::Length, [List(a)]) => {
            return math(MathFunction::Sqrt, &[dot(a, a)?]);
        }
        (_, [List(_), ..]) => {
            let arguments: Vec<&WgslValue> = arguments.iter().collect();
            return by_element(&arguments, |lane| math(function, lane));
        }
        _ => {}
    }
    let result = match *arguments {
        [F32(a)] => exact(function, a).or_else(|| rounded(function, f64::from(a))),
        [F32(a), F32(b)] => of_two(function, a, b),
        [F32(a), F32(b), F32(c)] => of_three(function, a, b, c),
        [U32(a), U32(b)] => return of_integers(function, a, b),
        [U32(a), U32(b), U32(c)] if function == MathFunction::Clamp => {
            return Ok(U32(a.max(b).min(c)));
        }
        _ => None,
    };
    result.map_or_else(|| unknown((function, arguments)), |result| Ok(F32(result)))
}

/// Functions that IEEE 754 rounds correctly.
fn exact(function: MathFunction, a: f32) -> Option<f32> {
    Some(match function {
        MathFunction::Abs => a.abs(),
        MathFunction::Floor => a.floor(),
        MathFunction::Sign if a == 0.0 => 0.0,
        MathFunction::Sign => a.signum(),
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

fn of_three(function: MathFunction, a: f32, b: f32, c: f32) -> Option<f32> {
    Some(match function {
        MathFunction::Clamp if a.is_nan() || b > c => f32::NAN,
        MathFunction::Clamp => a.max(b).min(c),
        // fused or not, as the device likes: here not
        MathFunction::Fma => a * b + c,
        MathFunction::Mix => a * (1.0 - c) + b * c,
        _ => return None,
    })
}

fn of_integers(function: MathFunction, a: u32, b: u32) -> Result<WgslValue, String> {
    match function {
        MathFunction::Min => Ok(U32(a.min(b))),
        MathFunction::Max => Ok(U32(a.max(b))),
        other => unknown(other),
    }
}
