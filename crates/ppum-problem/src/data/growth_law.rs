//! How fast tips grow under loads that repeat or stand: a formula, and the loads that it sees.

use std::f64::consts::PI;
use std::sync::Arc;

use ppum::formula::{Formula, FormulaError, Scope, ScopeError, Table};
use ppum::vec2::Vec2;

/// The names that a rate may use: ΔK and the largest K of a cycle; K_I, K_II and T at its largest
/// load; the ratio of its loads; growth so far; cycles or time so far; the place; K_c there;
/// Newman's opening ratio.
pub const RATE_INPUTS: [&str; 12] = [
    "dk",
    "kmax",
    "k1",
    "k2",
    "t_stress",
    "ratio",
    "extension",
    "n",
    "x",
    "y",
    "toughness",
    "opening",
];

/// A law with a name: its parameters, with defaults of those that may be left out, and the
/// logarithm of its rate, since powers of K may be out of all range.
#[derive(Debug)]
pub struct NamedLaw {
    /// Its key.
    pub name: &'static str,
    /// Its parameters.
    pub parameters: &'static [(&'static str, Option<f64>)],
    /// The formula of ln da/dN.
    pub text: &'static str,
}

/// Paris & Erdogan 1963; Walker 1970, whose γ is 0 for negative ratios (Dowling); Forman et al.
/// 1967; NASGRO (Forman & Mettu 1992).
pub const NAMED_LAWS: [NamedLaw; 4] = [
    NamedLaw {
        name: "paris",
        parameters: &[("c", None), ("m", None), ("threshold", Some(0.0))],
        text: "if(dk > threshold, log(c) + m*log(dk), -1/0)",
    },
    NamedLaw {
        name: "walker",
        parameters: &[("c", None), ("m", None), ("gamma", Some(0.5)), ("threshold", Some(0.0))],
        text: "if(dk > threshold, log(c) + m*if(ratio < 0, log(kmax), log(dk) + (gamma - 1)*log(1 - ratio)), -1/0)",
    },
    NamedLaw {
        name: "forman",
        parameters: &[("c", None), ("m", None), ("threshold", Some(0.0))],
        text: "if(dk > threshold, log(c) + m*log(dk) - log((1 - ratio)*(toughness - kmax)), -1/0)",
    },
    NamedLaw {
        name: "nasgro",
        parameters: &[
            ("c", None),
            ("m", None),
            ("p", Some(0.5)),
            ("q", Some(0.5)),
            ("threshold", Some(0.0)),
        ],
        text: "if(dk > threshold, log(c) + m*log((1 - opening)/(1 - ratio)*dk) + p*log(1 - threshold/dk) \
               - q*log(1 - kmax/toughness), -1/0)",
    },
];

/// Newman's ratio of the load that opens a crack to the largest one (1984).
const OPENING: &str = "let a0 = (0.825 - 0.34*alpha + 0.05*alpha^2)*cos(pi*stress/2)^(1/alpha); \
    let a1 = (0.415 - 0.071*alpha)*stress; let a3 = 2*a0 + a1 - 1; let a2 = 1 - a0 - a1 - a3; \
    if(ratio < 0, a0 + a1*max(ratio, -2), max(ratio, a0 + ratio*(a1 + ratio*(a2 + ratio*a3))))";

/// Growth of a tip per cycle, or per unit of time, and the loads that make it grow.
#[derive(Clone, Debug)]
pub struct GrowthLaw {
    rate: Formula,
    /// The name of the law and its parameters; a formula of users has none.
    named: Option<(&'static str, Vec<f64>)>,
    opening: Option<Formula>,
    /// The closure that `opening` is of.
    pub closure: Option<Closure>,
    /// The loads, which repeat.
    pub blocks: Vec<LoadBlock>,
    /// Retardation behind overloads.
    pub wheeler: Option<Wheeler>,
}

/// Cycles of one kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadBlock {
    /// How many they are; infinite if there are no others.
    pub cycles: f64,
    /// Largest and smallest load, in parts of the loads of the problem.
    pub max: f64,
    /// The smallest.
    pub min: f64,
}

/// Parameters of Newman's opening ratio.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Closure {
    /// 1 in plane stress to 3 in plane strain.
    pub alpha: f64,
    /// Largest stress of a cycle in parts of the flow stress.
    pub stress: f64,
}

/// Wheeler's retardation (1972): rates are multiplied by (r / (reach − a))^exponent while the
/// plastic zone of a cycle, r = (K_max / yield)² / (π constraint), stays inside that of an
/// earlier one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wheeler {
    /// The yield stress.
    pub yield_stress: f64,
    /// The exponent.
    pub exponent: f64,
    /// 1 in plane stress, 3 in plane strain.
    pub constraint: f64,
}

/// A tip as a law sees it, under the loads of the problem.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TipState {
    /// Its place.
    pub at: Vec2,
    /// K of a straight crack that is driven as much; NaN if nothing drives the tip.
    pub strength: f64,
    /// K_I, K_II and T; NaN if unknown.
    pub factors: [f64; 3],
    /// Growth so far.
    pub extension: f64,
    /// K_c of its place; infinite if none is given.
    pub toughness: f64,
}

/// A rate that is none: negative, or no number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WrongRate {
    /// The tip.
    pub at: Vec2,
    /// ΔK.
    pub range: f64,
    /// The rate.
    pub rate: f64,
}

impl PartialEq for GrowthLaw {
    fn eq(&self, other: &Self) -> bool {
        let own = (self.rate.text(), &self.named, self.closure, &self.blocks, self.wheeler);
        own == (other.rate.text(), &other.named, other.closure, &other.blocks, other.wheeler)
            && self.rate.scope() == other.rate.scope()
    }
}

impl GrowthLaw {
    /// The law of a rate's text, which may read tables, for loads that fall to zero in each cycle.
    ///
    /// # Errors
    /// The text is no formula of [`RATE_INPUTS`]; a table has the name of one.
    pub fn formula(
        text: &str,
        tables: &[Arc<Table>],
    ) -> Result<Result<Self, FormulaError>, ScopeError> {
        let scope = Scope::new(&RATE_INPUTS)?.with_tables(tables)?;
        Ok(Formula::parse(text, &scope).map(|rate| Self::of(rate, None)))
    }

    /// A law of [`NAMED_LAWS`] with the values of its parameters.
    ///
    /// # Panics
    /// Too few values.
    #[must_use]
    pub fn named(law: &'static NamedLaw, values: Vec<f64>) -> Self {
        assert_eq!(law.parameters.len(), values.len(), "a value for each parameter");
        let names = law.parameters.iter().map(|(name, _)| *name).zip(values.iter().copied());
        let rate = library_formula(law.text, &RATE_INPUTS, names);
        Self::of(rate, Some((law.name, values)))
    }

    /// Paris' law da/dN = c ΔK^m without a threshold.
    #[must_use]
    pub fn paris(c: f64, m: f64) -> Self {
        Self::named(&NAMED_LAWS[0], vec![c, m, 0.0])
    }

    fn of(rate: Formula, named: Option<(&'static str, Vec<f64>)>) -> Self {
        let blocks = vec![LoadBlock::constant(0.0)];
        Self { rate, named, opening: None, closure: None, blocks, wheeler: None }
    }

    /// The law with Newman's opening ratio.
    #[must_use]
    pub fn with_closure(self, closure: Option<Closure>) -> Self {
        let formula = |Closure { alpha, stress }| {
            let values = [("alpha", alpha), ("stress", stress)];
            library_formula(OPENING, &["ratio"], values.into_iter())
        };
        Self { opening: closure.map(formula), closure, ..self }
    }

    /// The parameters of a named law, with its key.
    pub fn parameters(&self) -> impl Iterator<Item = (&'static str, &'static str, f64)> {
        let law = |name| NAMED_LAWS.iter().find(|law| law.name == name);
        let rows = self.named.iter().filter_map(move |(name, values)| Some((law(*name)?, values)));
        rows.flat_map(|(law, values)| {
            law.parameters.iter().zip(values).map(|((key, _), value)| (law.name, *key, *value))
        })
    }

    /// The key that gives the rate.
    #[must_use]
    pub fn key(&self) -> &'static str {
        self.named.as_ref().map_or("rate", |(name, _)| name)
    }

    /// True if the rate depends on one of its inputs.
    #[must_use]
    pub fn uses(&self, input: &str) -> bool {
        self.rate.uses(input)
    }

    /// The largest load of all cycles.
    #[must_use]
    pub fn largest_load(&self) -> f64 {
        self.blocks.iter().map(|block| block.max).fold(0.0, f64::max)
    }

    /// ln da/dN of a tip in cycles of a block after so many; −∞ where it does not grow, +∞ where
    /// the law knows no rate because K has reached the toughness.
    ///
    /// # Errors
    /// The rate is negative, or not finite.
    pub fn ln_rate(
        &self,
        block: &LoadBlock,
        tip: &TipState,
        cycles: f64,
    ) -> Result<f64, WrongRate> {
        let kmax = block.max * tip.strength;
        if kmax.is_nan() || kmax <= 0.0 {
            return Ok(f64::NEG_INFINITY);
        }
        let ratio = block.min / block.max;
        let range = (1.0 - ratio) * kmax;
        let [k1, k2, t_stress] = tip.factors.map(|factor| block.max * factor);
        let opening = self.opening.as_ref().map_or(f64::NAN, |opening| opening.evaluate(&[ratio]));
        let value = self.rate.evaluate(&[
            range,
            kmax,
            k1,
            k2,
            t_stress,
            ratio,
            tip.extension,
            cycles,
            tip.at.x,
            tip.at.y,
            tip.toughness,
            opening,
        ]);
        let is_logarithm = self.named.is_some();
        let found = if is_logarithm { value } else { value.ln() };
        match found {
            found if found < f64::INFINITY => Ok(found),
            _ if kmax >= tip.toughness => Ok(f64::INFINITY),
            _ => Err(WrongRate { at: tip.at, range, rate: value }),
        }
    }
}

impl LoadBlock {
    /// Cycles without end, with a ratio of the smallest to the largest load.
    #[must_use]
    pub fn constant(ratio: f64) -> Self {
        Self { cycles: f64::INFINITY, max: 1.0, min: ratio }
    }
}

impl Wheeler {
    /// The size of the plastic zone under a factor K.
    #[must_use]
    pub fn zone(&self, k: f64) -> f64 {
        (k / self.yield_stress).powi(2) / (PI * self.constraint)
    }
}

/// A formula of this file, whose names are known.
fn library_formula<'a>(
    text: &str,
    inputs: &[&str],
    parameters: impl Iterator<Item = (&'a str, f64)>,
) -> Formula {
    let scope = Scope::new(inputs).expect("names of inputs");
    let add = |scope: Scope, (name, value)| scope.with_parameter(name, value).expect("a new name");
    Formula::parse(text, &parameters.fold(scope, add)).expect("a formula of the library")
}

#[cfg(test)]
mod tests {
    use super::*;
    use ppum::vec2::vec2;

    fn tip(strength: f64) -> TipState {
        let factors = [strength, 0.0, 0.0];
        TipState { at: vec2(0.5, 0.25), strength, factors, extension: 0.1, toughness: 10.0 }
    }

    fn rate(law: &GrowthLaw, ratio: f64, strength: f64) -> f64 {
        let block = LoadBlock::constant(ratio);
        law.ln_rate(&block, &tip(strength), 7.0).expect("a rate").exp()
    }

    fn named(name: &str, values: &[f64]) -> GrowthLaw {
        let law = NAMED_LAWS.iter().find(|law| law.name == name).expect("a law");
        GrowthLaw::named(law, values.to_vec())
    }

    fn formula(text: &str) -> GrowthLaw {
        GrowthLaw::formula(text, &[]).expect("a scope").expect("a formula")
    }

    /// Newman's ratios at R = 0, and his cubic and line evaluated independently.
    #[test]
    fn opening_ratios() {
        let opening = |alpha: f64, stress: f64, ratio: f64| {
            let closure = Some(Closure { alpha, stress });
            rate(&formula("opening").with_closure(closure), ratio, 2.0)
        };
        let known = [0.476_688_490_4, 0.325_656_339_6, 0.245_376_975_2];
        for (alpha, wanted) in [1.0, 2.0, 3.0].into_iter().zip(known) {
            assert!((opening(alpha, 0.3, 0.0) - wanted).abs() < 1e-10);
        }
        // evaluated in Python, α = 2, S = 0.4
        let others = [(0.5, 0.543_805_766_7), (0.9, 0.900_671_522_9), (-1.0, 0.201_111_533_4)];
        for (ratio, wanted) in others {
            let found = opening(2.0, 0.4, ratio);
            println!("{ratio}: {found:.9} {wanted}");
            assert!((found - wanted).abs() < 1e-8);
        }
        assert_eq!(opening(2.0, 0.4, -2.0), opening(2.0, 0.4, -5.0));
    }

    /// Laws with names are the formulas of textbooks.
    #[test]
    fn named_laws_are_their_formulas() {
        let (c, m, k) = (1e-3, 2.7, 4.0_f64);
        for ratio in [-0.5, 0.0, 0.4_f64] {
            let range = (1.0 - ratio) * k;
            let paris = named("paris", &[c, m, 0.0]);
            let walker = named("walker", &[c, m, 0.6, 0.0]);
            let forman = named("forman", &[c, m, 0.0]);
            let closure = Some(Closure { alpha: 2.0, stress: 0.3 });
            let nasgro = named("nasgro", &[c, m, 0.4, 0.3, 1.0]).with_closure(closure);
            let opening = rate(&formula("opening").with_closure(closure), ratio, k);
            let effective = if ratio < 0.0 { k } else { range / (1.0 - ratio).powf(0.4) };
            let both = (1.0 - 1.0 / range).powf(0.4) / (1.0 - k / 10.0_f64).powf(0.3);
            for (law, wanted) in [
                (paris, c * range.powf(m)),
                (walker, c * effective.powf(m)),
                (forman, c * range.powf(m) / ((1.0 - ratio) * 10.0 - range)),
                (nasgro, c * ((1.0 - opening) / (1.0 - ratio) * range).powf(m) * both),
            ] {
                assert!((rate(&law, ratio, k) / wanted - 1.0).abs() < 1e-13, "{law:?}");
            }
        }
    }

    /// Nothing grows up to the threshold; what is no rate is told with its place; at the toughness
    /// the rest is one motion.
    #[test]
    fn rates_that_are_none() {
        let block = LoadBlock::constant(0.0);
        for law in ["paris", "walker", "forman"] {
            let values = if law == "walker" { &[1.0, 2.0, 0.5, 3.0][..] } else { &[1.0, 2.0, 3.0] };
            let law = named(law, values);
            assert_eq!(law.ln_rate(&block, &tip(3.0), 0.0), Ok(f64::NEG_INFINITY));
            assert!(law.ln_rate(&block, &tip(3.1), 0.0).expect("a rate").is_finite());
        }
        for (text, wanted) in [("-dk", -3.0), ("1/(x - x)", f64::INFINITY)] {
            let wrong = formula(text).ln_rate(&block, &tip(3.0), 0.0).expect_err("no rate");
            assert_eq!((wrong.at, wrong.rate, wrong.range), (vec2(0.5, 0.25), wanted, 3.0));
        }
        assert_eq!(formula("-dk").ln_rate(&block, &tip(10.0), 0.0), Ok(f64::INFINITY));
        assert_eq!(formula("dk").ln_rate(&block, &tip(-1.0), 0.0), Ok(f64::NEG_INFINITY));
        let sum = rate(&formula("k1 + k2 + 10*ratio + n + x + y + extension"), 0.5, 2.0);
        assert!((sum - 14.85).abs() < 1e-13);
    }
}
