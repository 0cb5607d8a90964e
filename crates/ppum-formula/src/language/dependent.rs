//! Inputs that are functions of others, whose derivatives are formulas: polar coordinates, sides of
//! cracks, and those of callers.

use std::sync::{Arc, LazyLock};

use crate::error::FormulaError;
use crate::language::ast::Ast;
use crate::language::lower::checked;
use crate::language::scope::{COS_HALF, DefinedFunction, Dependent, SIN_HALF, Scope, ScopeError};

/// cos θ and sin θ of the polar angle: name, definition, derivatives. The direction of the origin
/// itself is +x, so that √r sin θ has the value 0 there; NaN stays NaN.
const WHOLE_ANGLE: [(&str, &str, [&str; 2]); 2] = [
    ("cos(theta)", "if(r == 0, 1, x/r)", ["sin(theta)*sin(theta)/r", "-(sin(theta)*cos(theta)/r)"]),
    ("sin(theta)", "if(r == 0, 0, y/r)", ["-(sin(theta)*cos(theta)/r)", "cos(theta)*cos(theta)/r"]),
];

/// The inputs of polar coordinates and their derivatives.
const POLAR: [(&str, [&str; 2]); 4] = [
    ("r", ["cos(theta)", "sin(theta)"]),
    ("theta", ["-(sin(theta)/r)", "cos(theta)/r"]),
    (COS_HALF, ["sin(theta/2)*sin(theta)/(2*r)", "-(sin(theta/2)*cos(theta)/(2*r))"]),
    (SIN_HALF, ["-(cos(theta/2)*sin(theta)/(2*r))", "cos(theta/2)*cos(theta)/(2*r)"]),
];

impl Scope {
    /// Inputs x, y, r, theta, `cos(theta/2)`, `sin(theta/2)`, where r = √(x² + y²) and θ is the
    /// polar angle on the branch that the caller chooses, with the half angles on the same branch:
    /// ∂r = (x, y)/r, ∂θ = (−y, x)/r², ∂ cos(θ/2) = sin(θ/2) (y, −x)/(2r²), ∂ sin(θ/2) = cos(θ/2)
    /// (−y, x)/(2r²).
    ///
    /// The names of the last two are their texts. Sines, cosines and tangents of multiples kθ/2,
    /// 0 < |k| ≤ 64, are products of x/r, y/r and these two; θ itself is not used for them. At r =
    /// 0 cos θ is 1 and sin θ is 0, their derivatives are NaN.
    #[must_use]
    pub fn polar() -> Self {
        static SCOPE: LazyLock<Scope> = LazyLock::new(Scope::new_polar);
        SCOPE.clone()
    }

    fn new_polar() -> Self {
        let mut scope = Self::cartesian();
        scope.dependent.extend(POLAR.map(|(name, _)| Dependent::without_rules(name)));
        // the rules use the definitions
        scope.defined = scope.whole_angle(|_| Arc::default());
        let parsed = |texts: &[&str; 2]| texts.map(|text| scope.built_in(text)).into();
        let (defined, rules) = (scope.whole_angle(parsed), POLAR.map(|(_, texts)| parsed(&texts)));
        scope.defined = defined;
        for (dependent, rules) in scope.dependent.iter_mut().zip(rules) {
            dependent.rules = rules;
        }
        scope
    }

    fn whole_angle(&self, rules: impl Fn(&[&str; 2]) -> Arc<[Ast]>) -> Arc<[DefinedFunction]> {
        let define = |(name, text, texts): &(&'static str, &str, [&str; 2])| DefinedFunction {
            name,
            definition: self.built_in(text),
            rules: rules(texts),
        };
        WHOLE_ANGLE.iter().map(define).collect()
    }

    fn built_in(&self, text: &str) -> Ast {
        checked(text, self).expect("definitions and rules are formulas")
    }

    /// Adds an input that is a function of the independent variables. `rules` are its derivatives
    /// with respect to each of them, in their order, as formulas of this scope and of itself.
    ///
    /// # Errors
    /// When the name is not one or is taken, or a rule is missing or is no formula.
    pub fn with_dependent(mut self, name: &str, rules: &[&str]) -> Result<Self, ScopeError> {
        self.check_name(name)?;
        let (expected, given) = (self.independent.len(), rules.len());
        if given != expected {
            return Err(ScopeError::RuleCount { name: name.to_owned(), expected, given });
        }
        let own = self.dependent.len();
        self.dependent.push(Dependent::without_rules(name));
        let parsed: Result<_, FormulaError> =
            rules.iter().map(|rule| checked(rule, &self)).collect();
        self.dependent[own].rules =
            parsed.map_err(|error| ScopeError::Rule { name: name.to_owned(), error })?;
        Ok(self)
    }

    /// Adds the sides of cracks as inputs called `side(0)` to `side(n - 1)`: +1 on the left of
    /// crack k, −1 on its right, with derivatives 0. Formulas write them so.
    ///
    /// # Panics
    /// When inputs were added after sides.
    #[must_use]
    pub fn with_sides(mut self, n: usize) -> Self {
        let (first, end) = (self.n_sides(), self.dependent.len());
        assert!(first == 0 || self.sides.end == end, "sides of cracks follow each other");
        let rules: Arc<[Ast]> = vec![self.built_in("0"); self.independent.len()].into();
        let side = |k| Dependent { name: format!("side({k})"), rules: rules.clone() };
        self.dependent.extend((first..first + n).map(side));
        self.sides = end - first..end + n;
        self
    }
}
