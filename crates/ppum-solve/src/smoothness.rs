//! Where the functions of a step and the coefficients of its equation are not smooth, for quadrature.
//!
//! Formulas show where they have kinks; the singular points of a function are the origin of its frame,
//! if it uses polar coordinates, and those it declares. How fast it grows there is measured. The
//! Westergaard functions of a tip are known: half powers of r times smooth functions of θ.
//!
//! Body forces and data on the border need nothing: the method is not better than the quadrature of
//! its own functions, which is used for them as well.

mod growth;
mod probe;
#[cfg(test)]
mod tests;

use crate::quadrature::{Geometry, Growth, Kink, Singular};
use growth::{Behaviour, growth};
use ppum::crack::Crack;
use ppum::dataset::{Equation, FieldData, Partition, Step};
use ppum::expression::Expression;
use ppum::formula::{self, Formula, Table};
use ppum::function::{
    CompileError, Declared, Frame, Function, FunctionError, FunctionKind, WESTERGAARD,
    function_scope,
};
use ppum::vec2::{Rect, Vec2, vec2};
use probe::{Probe, ProbeList};
use std::sync::Arc;

/// Highest degree of a piecewise polynomial that is seen to be one.
const POLYNOMIAL: usize = 3;

/// Most lines and curves between which a function is taken for a polynomial on every piece; one with
/// more, a spline of many knots, is probed.
const MOST_SETS: usize = 64;

/// What a function whose energy is infinite is graded for.
const DIVERGENT: Growth = Growth::Powers { least: 0.04 };

/// Where a step is not smooth; owns what a [`Geometry`] borrows.
#[derive(Debug, Default)]
pub(crate) struct Smoothness {
    singular: Vec<Singular>,
    patch_singular: Vec<Vec<u32>>,
    kinks: Vec<Kink>,
    patch_kinks: Vec<Vec<u32>>,
    common_kinks: Vec<u32>,
    probes: ProbeList,
    patch_probes: Vec<Vec<u32>>,
    common_probes: Vec<u32>,
    /// Largest degree of a product of a block's polynomial with its function, where that is a piecewise
    /// polynomial, and with the coefficients, as far as they are.
    degree: usize,
}

/// What quadrature has to know of one function or coefficient.
#[derive(Default)]
struct Traits {
    singular: Vec<Singular>,
    kinks: Vec<Kink>,
    probe: Option<Probe>,
    /// Degree, where it is a piecewise polynomial.
    degree: usize,
    /// A point around which the energy is infinite.
    divergent: Option<Vec2>,
}

/// Places of the traits of one function in the lists of all.
#[derive(Default)]
struct Indices {
    singular: Vec<u32>,
    kinks: Vec<u32>,
    probes: Vec<u32>,
}

impl Smoothness {
    /// What quadrature has to know of a step.
    ///
    /// # Errors
    /// A function that does not compile.
    pub(crate) fn new(
        step: &Step,
        data: &FieldData,
        equation: &Equation,
        tables: &[Arc<Table>],
    ) -> Result<Self, FunctionError> {
        let surroundings = Surroundings::new(step, tables);
        let mut all = Self::default();
        let mut of_functions = Vec::with_capacity(step.functions.len());
        let mut degrees = Vec::with_capacity(step.functions.len());
        for (index, function) in step.functions.iter().enumerate() {
            let traits = surroundings.traits(function).map_err(|e| FunctionError { index, ..e })?;
            degrees.push(traits.degree);
            of_functions.push(all.add(traits));
        }
        let blocks = data.block_function.iter().zip(&data.block_degree);
        let degree = blocks.map(|(&function, &d)| usize::from(d) + degrees[function as usize]);
        all.degree = degree.max().unwrap_or(0);
        all.add_coefficients(equation);
        for patch in 0..step.partition.len() {
            let functions = data.blocks(patch).map(|b| data.block_function[b] as usize);
            let of_patch: Vec<_> = functions.map(|function| &of_functions[function]).collect();
            let union = |list: fn(&Indices) -> &Vec<u32>| {
                let mut found: Vec<_> = of_patch.iter().flat_map(|i| list(i)).copied().collect();
                found.sort_unstable();
                found.dedup();
                found
            };
            all.patch_singular.push(union(|indices| &indices.singular));
            all.patch_kinks.push(union(|indices| &indices.kinks));
            all.patch_probes.push(union(|indices| &indices.probes));
        }
        Ok(all)
    }

    /// Where the space over a partition is not smooth.
    pub(crate) fn geometry<'a>(
        &'a self,
        partition: &'a Partition,
        cracks: &'a [Crack],
    ) -> Geometry<'a> {
        Geometry {
            singular: &self.singular,
            patch_singular: &self.patch_singular,
            kinks: &self.kinks,
            patch_kinks: &self.patch_kinks,
            common_kinks: &self.common_kinks,
            probes: &self.probes,
            patch_probes: &self.patch_probes,
            common_probes: &self.common_probes,
            ..Geometry::new(partition, cracks)
        }
    }

    /// Degree that quadrature has to be for.
    pub(crate) fn degree(&self) -> usize {
        self.degree
    }

    /// Lines across which coefficients of the equation may jump.
    pub(crate) fn interfaces(&self) -> impl Iterator<Item = &Kink> {
        self.common_kinks.iter().map(|&kink| &self.kinks[kink as usize])
    }

    fn add(&mut self, traits: Traits) -> Indices {
        let singular = traits.singular.into_iter().map(|new| {
            let known = self.singular.iter().position(|known| *known == new);
            let index = known.unwrap_or(self.singular.len());
            if known.is_none() {
                self.singular.push(new);
            }
            index as u32
        });
        let singular = singular.collect();
        let first = self.kinks.len() as u32;
        self.kinks.extend(traits.kinks);
        let kinks = (first..self.kinks.len() as u32).collect();
        let first = self.probes.0.len() as u32;
        self.probes.0.extend(traits.probe);
        let probes = (first..self.probes.0.len() as u32).collect();
        Indices { singular, kinks, probes }
    }

    fn add_coefficients(&mut self, equation: &Equation) {
        for (_, coefficient) in equation.constants() {
            let traits = traits_of_coefficient(coefficient);
            self.degree += traits.degree.div_ceil(2);
            let Indices { kinks, probes, .. } = self.add(traits);
            self.common_kinks.extend(kinks);
            self.common_probes.extend(probes);
        }
    }
}

/// A point around which a function has infinite energy.
pub(crate) fn divergence(
    function: &Function,
    step: &Step,
    tables: &[Arc<Table>],
) -> Result<Option<Vec2>, FunctionError> {
    Surroundings::new(step, tables).traits(function).map(|traits| traits.divergent)
}

/// What the traits of a function depend on.
struct Surroundings<'s> {
    cracks: Arc<[Crack]>,
    tables: &'s [Arc<Table>],
    /// A length longer than the domain.
    reach: f64,
    /// Half the width of the smallest patch.
    scale: f64,
}

impl<'s> Surroundings<'s> {
    fn new(step: &Step, tables: &'s [Arc<Table>]) -> Self {
        let partition = &step.partition;
        let first = partition.cell.first().copied().unwrap_or(Rect::new(Vec2::ZERO, Vec2::ZERO));
        let domain = partition.cell.iter().fold(first, |all, cell| all.union(cell));
        let halves = partition.half.iter().map(|half| half.x.min(half.y));
        Self {
            cracks: step.cracks.as_slice().into(),
            tables,
            reach: 2.0 * domain.size().length(),
            scale: halves.fold(f64::INFINITY, f64::min),
        }
    }

    fn traits(&self, function: &Function) -> Result<Traits, FunctionError> {
        match &function.kind {
            FunctionKind::Formula { text, frame: frame @ Frame::Tip(_), .. }
                if WESTERGAARD.contains(&text.as_str()) =>
            {
                let singular = vec![Singular::tip(self.axes(*frame).origin)];
                Ok(Traits { singular, ..Traits::default() })
            }
            FunctionKind::Formula { text, frame, parameters, declared } => {
                let error = |source: CompileError| FunctionError {
                    index: 0,
                    name: function.name.clone(),
                    source: Box::new(source),
                };
                let scope = function_scope(parameters, self.cracks.len(), self.tables);
                let scope = scope.map_err(|e| error(e.into()))?;
                let formula = Formula::parse(text, &scope).map_err(|e| error(e.into()))?;
                self.of_formula(function, &formula, &self.axes(*frame), declared)
            }
            _ => Ok(Traits::default()),
        }
    }

    fn of_formula(
        &self,
        function: &Function,
        formula: &Formula,
        axes: &Axes,
        declared: &Declared,
    ) -> Result<Traits, FunctionError> {
        let probe = Probe::function(function, &self.cracks, self.tables)?;
        let Pieces { sets, degree } = Pieces::new(formula);
        let mut traits = Traits { degree: degree.unwrap_or(0), ..Traits::default() };
        for set in sets {
            traits.kinks.push(match set.line() {
                Some(line) => Kink::Line(axes.line(line)),
                None => {
                    let text = set.value.text();
                    let part = Probe::part_of(function, text, &self.cracks, self.tables)?;
                    Kink::Curve(Arc::new(move |p| part.jet(p, Vec2::ZERO)[0]))
                }
            });
        }
        if formula.uses_branch() && !axes.is_tip {
            let end = axes.to_world(vec2(-self.reach - axes.origin.length(), 0.0));
            traits.kinks.push(Kink::Segment([axes.origin, end]));
        }
        let segments = declared.kinks.iter();
        traits.kinks.extend(segments.map(|s| Kink::Segment(s.map(|p| axes.to_world(p)))));
        let origin = formula.singular_at_origin().then_some(axes.origin);
        for point in origin.into_iter().chain(declared.singular.iter().map(|&p| axes.to_world(p))) {
            match growth(&|offset| probe.jet(point, offset), self.scale) {
                Behaviour::Constant => {}
                Behaviour::Grows(growth) => traits.singular.push(Singular { point, growth }),
                Behaviour::Diverges => {
                    traits.singular.push(Singular { point, growth: DIVERGENT });
                    traits.divergent = Some(point);
                }
            }
        }
        traits.probe = degree.is_none().then_some(probe);
        Ok(traits)
    }

    fn axes(&self, frame: Frame) -> Axes {
        let (origin, x, is_tip) = match frame {
            Frame::Fixed { origin, angle } => (origin, vec2(angle.cos(), angle.sin()), false),
            Frame::Tip(tip) => {
                let crack = &self.cracks[tip.crack as usize];
                (crack.end_point(tip.end), crack.growth_direction(tip.end), true)
            }
            _ => (Vec2::ZERO, vec2(1.0, 0.0), false),
        };
        Axes { origin, x, is_tip }
    }
}

fn traits_of_coefficient(coefficient: &Expression) -> Traits {
    if coefficient.constant().is_some() {
        return Traits::default();
    }
    let formula = coefficient.formula();
    let world = Axes { origin: Vec2::ZERO, x: vec2(1.0, 0.0), is_tip: false };
    let kink = |set: formula::Kink| match set.line() {
        Some(line) => Kink::Line(world.line(line)),
        None => Kink::Curve(Arc::new(move |p: Vec2| set.value.evaluate(&[p.x, p.y]))),
    };
    let Pieces { sets, degree } = Pieces::new(formula);
    let probe = degree.is_none().then(|| Probe::coefficient(formula).ok()).flatten();
    let kinks = sets.into_iter().map(kink).collect();
    Traits { kinks, probe, degree: degree.unwrap_or(0), ..Traits::default() }
}

/// A formula as quadrature sees it.
struct Pieces {
    /// Lines and curves between which it is smooth.
    sets: Vec<formula::Kink>,
    /// Its degree, if it is a polynomial of x and y on every piece between them.
    degree: Option<usize>,
}

impl Pieces {
    fn new(formula: &Formula) -> Self {
        // The origin of a polar frame is no curve.
        let singular = formula.singularities().into_iter().filter(|set| set.value.text() != "r");
        let mut sets: Vec<_> = formula.kinks().into_iter().chain(singular).collect();
        let Some(polynomial) = Polynomial::new(formula) else { return Self { sets, degree: None } };
        // Of a spline the value is smooth at the knots, but no polynomial across them.
        for derivative in &polynomial.derivatives {
            for set in derivative.kinks() {
                if sets.iter().all(|known| known.value.text() != set.value.text()) {
                    sets.push(set);
                }
            }
        }
        let few = sets.len() <= MOST_SETS;
        if !few {
            sets.truncate(formula.kinks().len());
        }
        Self { sets, degree: few.then_some(polynomial.degree) }
    }
}

/// A formula that is a polynomial of x and y on every piece between some lines and curves.
struct Polynomial {
    degree: usize,
    /// All its derivatives of this order, which are constants on every piece.
    derivatives: Vec<Formula>,
}

impl Polynomial {
    fn new(formula: &Formula) -> Option<Self> {
        let mut derivatives = vec![formula.clone()];
        for degree in 0..=POLYNOMIAL {
            let along_x = derivatives.iter().map(|f| f.derivative("x"));
            let along_y = derivatives.last().map(|f| f.derivative("y"));
            let next: Vec<_> = along_x.chain(along_y).collect::<Result<_, _>>().ok()?;
            if next.iter().all(|f| f.constant() == Some(0.0)) {
                return Some(Self { degree, derivatives });
            }
            derivatives = next;
        }
        None
    }
}

/// A frame's axes in the world.
struct Axes {
    origin: Vec2,
    x: Vec2,
    is_tip: bool,
}

impl Axes {
    fn to_world(&self, p: Vec2) -> Vec2 {
        self.origin + self.x * p.x + self.x.left() * p.y
    }

    /// Two points of the line a x + b y + c = 0.
    fn line(&self, [a, b, c]: [f64; 3]) -> [Vec2; 2] {
        let normal = vec2(a, b);
        let foot = normal * (-c / normal.dot(normal));
        [foot, foot + normal.unit().left()].map(|p| self.to_world(p))
    }
}
