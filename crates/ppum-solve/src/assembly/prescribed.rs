//! The data of a problem, its source and its boundary conditions, cell by cell: with rules of their
//! own where those of the system do not resolve it.

use super::boundary::CellBoundary;
use super::cell::SourceTerm;
use super::loads::{LoadRules, boundary_rules, of_condition, of_source, unresolved_strains};
use super::point::point_rule;
use super::reaction::modes;
use crate::equilibrium::{Balance, BodyPieces};
use crate::quadrature::{CellRule, CrackFace, EdgeRule, Quadrature};
use crate::report::UnresolvedIntegrand;
use crate::space::TrialSpace;
use crate::terms::{is_held_exactly, known_fields};
use crate::watched::{Halt, WorkPhase, in_batches};
use ppum::vec2::Vec2;
use ppum_problem::{BoundaryCondition, Problem, held_directions};

/// A source as a function of position.
type SourceFunction<'p> = Box<dyn Fn(Vec2) -> [f64; 2] + Sync + Send + 'p>;

/// The source and the boundary conditions of a problem.
pub struct PrescribedData<'p> {
    problem: &'p Problem,
    /// The source; none where it is zero.
    source: Option<SourceFunction<'p>>,
    source_rules: LoadRules<CellRule>,
    conditions: Vec<PrescribedCondition<'p>>,
    /// The errors of given strains that are not resolved, with their places.
    strains: Vec<(f64, Vec2)>,
}

/// A boundary condition with its data along its axes as a function of position and normal.
struct PrescribedCondition<'p> {
    number: usize,
    condition: &'p BoundaryCondition,
    values: Box<dyn Fn(Vec2, Vec2) -> [f64; 2] + Sync + Send + 'p>,
    /// Rules for the data where those of the system do not resolve them.
    own: LoadRules<EdgeRule>,
    /// True if all fields have these values.
    is_exact: bool,
}

impl<'p> PrescribedData<'p> {
    /// All that is given, and rules that resolve it.
    ///
    /// # Errors
    /// Cancelled.
    pub fn new(
        problem: &'p Problem,
        space: &TrialSpace<'_>,
        stage: &WorkPhase<'_>,
    ) -> Result<Self, Halt> {
        let has_source = problem.source.iter().any(|e| e.formula().constant() != Some(0.0));
        let source = move |x: Vec2| problem.source_at(x);
        let conditions = problem.boundary.iter().enumerate();
        let given = |(number, condition)| {
            let own = of_condition(problem, space, condition, stage)?;
            Ok(PrescribedCondition::new(problem, (number, condition), own))
        };
        Ok(Self {
            problem,
            source: has_source.then(|| Box::new(source) as SourceFunction<'p>),
            source_rules: of_source(problem, space, stage)?,
            conditions: conditions.map(given).collect::<Result<_, Halt>>()?,
            strains: unresolved_strains(problem, space, stage)?,
        })
    }

    /// The conditions that give values, with the rules of the system.
    pub(crate) fn restraints(problem: &'p Problem) -> Self {
        let conditions = problem.boundary.iter().enumerate();
        let holding = conditions.filter(|(_, condition)| condition.fixed().contains(&true));
        Self {
            problem,
            source: None,
            source_rules: LoadRules::default(),
            conditions: holding
                .map(|given| PrescribedCondition::new(problem, given, LoadRules::default()))
                .collect(),
            strains: Vec::new(),
        }
    }

    /// True if nothing is given.
    pub(crate) fn is_empty(&self) -> bool {
        self.source.is_none() && self.conditions.is_empty()
    }

    /// The source, with the rules that it has in a cell for its own.
    pub(crate) fn source(&self, cell: usize) -> Option<SourceTerm<'_>> {
        let values = self.source.as_deref()?;
        Some(SourceTerm { values, rules: self.source_rules.of(cell) })
    }

    /// The pieces of a cell's boundary on which something is given.
    pub(crate) fn boundary(
        &self,
        space: &TrialSpace<'_>,
        quadrature: &Quadrature<'_>,
        cell: usize,
    ) -> Vec<CellBoundary<'_>> {
        let piece = |given: &'_ PrescribedCondition<'p>| {
            boundary_rules(self.problem, given.condition.on, quadrature, space.cell(cell))
        };
        let all = self.conditions.iter().map(|given| (given, piece(given)));
        let some = all.filter(|(_, rules)| !rules.is_empty());
        some.map(|(given, rules)| given.piece(self.problem, cell, rules)).collect()
    }

    /// Restraints and loads of the pieces of the body.
    ///
    /// # Errors
    /// Data that are not finite, with their place; cancelled.
    pub fn balance(
        &self,
        space: &TrialSpace<'_>,
        pieces: &BodyPieces,
        stage: &WorkPhase<'_>,
    ) -> Result<Vec<Balance>, Halt> {
        let (components, equation) = (self.problem.components(), &self.problem.equation);
        let quadrature = space.quadrature(0);
        let mut sum = Balance::of(pieces, equation);
        in_batches(
            stage,
            if self.is_empty() { 0 } else { space.partition().len() },
            || (),
            |(), cell| {
                let mut part = Balance::of(pieces, equation);
                if let Some(source) = self.source(cell) {
                    let shared = || space.rules(&quadrature, cell);
                    match source.rules {
                        Some(rules) => add_source(&mut part, &source, rules, pieces, components),
                        None => add_source(&mut part, &source, &shared(), pieces, components),
                    }
                }
                let boundary = self.boundary(space, &quadrature, cell);
                boundary
                    .iter()
                    .for_each(|piece| add_boundary(&mut part, piece, pieces, components));
                let is_finite =
                    boundary.iter().all(is_finite) && part.iter().all(Balance::is_finite);
                is_finite.then_some(part).ok_or(Halt::at(space.partition().cell[cell]))
            },
            |_, part| sum.iter_mut().zip(&part).for_each(|(sum, part)| sum.add(part)),
        )?;
        for field in known_fields(self.problem) {
            let (_, rule) = point_rule(space, (field.at, field.face.map(CrackFace::from)));
            sum[pieces.of_boundary(&rule, 0)].add_load(
                field.at,
                &<[f64; 2]>::from(field.load),
                1.0,
            );
        }
        Ok(sum)
    }

    /// The loads, given strains and data that no rules resolve.
    pub(crate) fn unresolved(&self) -> Vec<UnresolvedIntegrand> {
        let unresolved =
            |what: String, (error, at)| UnresolvedIntegrand { load: Some(what), error, at };
        let name = if self.problem.components() == 1 { "the source" } else { "the body force" };
        let inside = self.source_rules.doubt().map(|doubt| unresolved(name.into(), doubt));
        let of_given = |given: &PrescribedCondition<'p>| {
            let what = format!("what is given on {}", self.problem.words_of(given.condition.on));
            given.own.doubt().map(|doubt| unresolved(what, doubt))
        };
        let of_strain = |doubt: &_| unresolved("a given strain".into(), *doubt);
        let inside = inside.into_iter().chain(self.strains.iter().map(of_strain));
        inside.chain(self.conditions.iter().filter_map(of_given)).collect()
    }
}

impl<'p> PrescribedCondition<'p> {
    fn new(
        problem: &Problem,
        (number, condition): (usize, &'p BoundaryCondition),
        own: LoadRules<EdgeRule>,
    ) -> Self {
        let values = Box::new(|x, normal| condition.values(x, normal));
        let is_exact = is_held_exactly(problem, condition);
        Self { number, condition, values, own, is_exact }
    }

    fn piece(&self, problem: &Problem, cell: usize, rules: Vec<EdgeRule>) -> CellBoundary<'_> {
        CellBoundary {
            rules,
            own: self.own.of(cell),
            held: self.condition.held(),
            axes: self.condition.axes(),
            exchange: self.condition.exchange.as_ref(),
            is_exact: self.is_exact,
            values: &*self.values,
            condition: self.number,
            modes: modes(problem),
        }
    }
}

fn add_source(
    sum: &mut [Balance],
    source: &SourceTerm<'_>,
    rules: &[CellRule],
    pieces: &BodyPieces,
    components: usize,
) {
    for rule in rules {
        for (x, weight) in rule.points() {
            sum[pieces.of(x)].add_load(x, &(source.values)(x)[..components], weight);
        }
    }
}

fn add_boundary(
    sum: &mut [Balance],
    piece: &CellBoundary<'_>,
    pieces: &BodyPieces,
    components: usize,
) {
    let points = |rules: &[EdgeRule], visit: &mut dyn FnMut(usize, Vec2, Vec2, f64)| {
        for rule in rules {
            for (q, (x, normal, weight)) in rule.points().enumerate() {
                visit(pieces.of_boundary(rule, q), x, normal, weight);
            }
        }
    };
    points(&piece.rules, &mut |at, x, _, weight| {
        sum[at].add_held(x, held_directions(piece.held, piece.axes), weight);
    });
    points(piece.own.unwrap_or(&piece.rules), &mut |at, x, normal, weight| {
        sum[at].add_load(x, &piece.loads(x, normal)[..components], weight);
    });
}

/// True if all that is given on a piece of the boundary is finite, values that hold it among them,
/// and no coefficient of an exchange negative.
fn is_finite(piece: &CellBoundary<'_>) -> bool {
    piece.own.unwrap_or(&piece.rules).iter().all(|rule| {
        rule.points().all(|(x, normal, _)| {
            let exchange = piece.exchange.map_or(0.0, |exchange| exchange.value(x));
            let values = (piece.values)(x, normal);
            exchange >= 0.0 && values.iter().chain([&exchange]).all(|value| value.is_finite())
        })
    })
}
