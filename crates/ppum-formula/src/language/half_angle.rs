//! Sine, cosine and tangent of multiples of half the polar angle, as products.
//!
//! With c + is = e^{iθ} from x/r and y/r, and C + iS = e^{iθ/2} from the inputs `cos(theta/2)` and
//! `sin(theta/2)`,
//!
//! ```text
//! e^{ikθ/2} = (c + is)^m           for k = 2m
//!           = (C + iS) (c + is)^m  for k = 2m + 1
//! ```
//!
//! by repeated squaring. There is no arc tangent, which would lose the digits of a small cos(θ/2)
//! near θ = ±π to the rounding of θ; there each product adds terms of equal sign.

use crate::graph::{Graph, NodeId};
use crate::language::ast::{ExprId, ExprKind, Infix, Prefix};
use crate::language::scope::Scope;
use crate::operation::{Binary, Unary};

/// Largest multiple of θ/2 that becomes products; their error grows with it.
const MAX_MULTIPLE: f64 = 64.0;

/// Knowledge of an expression as a multiple of θ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Multiple {
    /// A number, constant after folding.
    Constant(f64),
    /// A constant times θ.
    Of(f64),
    /// Anything else.
    Unknown,
}

/// An expression as a multiple of θ, from its operands.
pub(crate) fn multiple(
    kind: &ExprKind,
    theta: Option<u32>,
    operand: impl Fn(ExprId) -> Multiple,
) -> Multiple {
    use Multiple::{Constant, Of, Unknown};
    match *kind {
        ExprKind::Input(input) if Some(input) == theta => Of(1.0),
        ExprKind::Prefix(Prefix::Plus, a) => operand(a),
        ExprKind::Prefix(Prefix::Minus, a) => match operand(a) {
            Of(k) => Of(-k),
            _ => Unknown,
        },
        ExprKind::Infix(Infix::Arithmetic(op), a, b) => match (op, operand(a), operand(b)) {
            (Binary::Add, Of(j), Of(k)) => Of(j + k),
            (Binary::Sub, Of(j), Of(k)) => Of(j - k),
            (Binary::Mul, Constant(c), Of(k)) | (Binary::Mul, Of(k), Constant(c)) => Of(c * k),
            (Binary::Div, Of(k), Constant(c)) => Of(k / c),
            _ => Unknown,
        },
        _ => Unknown,
    }
}

/// `op` of a multiple of θ as products, if it is a sine, cosine or tangent of kθ/2 with whole k,
/// 0 < |k| ≤ 64.
pub(crate) fn expand(
    op: Unary,
    angle: Multiple,
    scope: &Scope,
    graph: &mut Graph,
) -> Option<NodeId> {
    let Multiple::Of(factor) = angle else { return None };
    let halves = 2.0 * factor;
    let fits = halves.fract() == 0.0 && halves != 0.0 && halves.abs() <= MAX_MULTIPLE;
    if !fits || !matches!(op, Unary::Sin | Unary::Cos | Unary::Tan) {
        return None;
    }
    let turn = UnitRotation::of_halves(halves.abs() as u32, scope, graph)?;
    let sin = if halves < 0.0 { graph.neg(turn.sin) } else { turn.sin };
    Some(match op {
        Unary::Sin => sin,
        Unary::Cos => turn.cos,
        _ => graph.binary(Binary::Div, sin, turn.cos),
    })
}

/// e^{iφ} of some angle φ.
#[derive(Clone, Copy)]
struct UnitRotation {
    cos: NodeId,
    sin: NodeId,
}

impl UnitRotation {
    /// e^{ikθ/2}, k > 0.
    fn of_halves(halves: u32, scope: &Scope, graph: &mut Graph) -> Option<Self> {
        let [cos, sin] = scope.half_angles()?;
        let half = Self { cos: graph.input(cos), sin: graph.input(sin) };
        let mut product = (halves % 2 == 1).then_some(half);
        let mut rest = halves / 2;
        if rest > 0 {
            let mut square = Self::whole(scope, graph);
            loop {
                if rest % 2 == 1 {
                    product = Some(product.map_or(square, |p| p.times(square, graph)));
                }
                rest /= 2;
                if rest == 0 {
                    break;
                }
                square = square.squared(graph);
            }
        }
        product
    }

    /// e^{iθ}.
    fn whole(scope: &Scope, graph: &mut Graph) -> Self {
        let [cos, sin] = scope.definitions(graph)[..] else {
            unreachable!("scopes with half angles define cos θ and sin θ")
        };
        Self { cos, sin }
    }

    fn times(self, other: Self, graph: &mut Graph) -> Self {
        let mut join = |a, b, op, c, d| {
            let left = graph.binary(Binary::Mul, a, b);
            let right = graph.binary(Binary::Mul, c, d);
            graph.binary(op, left, right)
        };
        Self {
            cos: join(self.cos, other.cos, Binary::Sub, self.sin, other.sin),
            sin: join(self.sin, other.cos, Binary::Add, self.cos, other.sin),
        }
    }

    fn squared(self, graph: &mut Graph) -> Self {
        let two = graph.constant(2.0);
        let product = graph.binary(Binary::Mul, self.cos, self.sin);
        let squares = [self.cos, self.sin].map(|part| graph.power(part, 2));
        Self {
            cos: graph.binary(Binary::Sub, squares[0], squares[1]),
            sin: graph.binary(Binary::Mul, two, product),
        }
    }
}
