//! Rules for loads and given values that the rules of the system do not resolve.
//!
//! A formula may jump, be bent, have layers and spikes where the functions of the space know
//! nothing of it. Only integrals with the formula itself pay for that: cell by cell its moments by
//! the rule of the system are compared with those by a rule that goes up to its kinks and is
//! divided until it resolves the formula. Where they agree the rule of the system stays, else the
//! other one takes its place for this load.

use crate::law::Law;
use crate::quadrature::{
    CellRule, CoveredCell, CrackFace, EdgeRule, KinkLine, Quadrature, QuadratureErrorEstimate,
};
use crate::smoothness::{Smoothness, box_of};
use crate::space::TrialSpace;
use crate::watched::{Halt, WorkPhase, in_batches};
use ppum::crack::Side;
use ppum::edge::Edge;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum_problem::{BoundaryCondition, BoundaryPart, Expression, Problem};

/// Difference of moments up to which the rule of the system stays, as a part of the mean load: of
/// formulas with kinks, layers or spikes somewhere, and of smooth ones, which the polynomials of
/// the space resolve no better.
const SAME: f64 = 1e-9;
const SAME_OF_SMOOTH: f64 = 1e-6;

/// Gauss points more of the rule that smooth loads are compared with.
const EXTRA: usize = 2;

/// The mean load found must lie between these parts of the mean that was allowed for, or rules are
/// made again: where points hit or miss a spike, the first mean is a guess.
const MEAN_FOUND: [f64; 2] = [0.5, 10.0];

/// Most times rules are made.
const ROUNDS: usize = 4;

/// Divisions that one load may cost in all cells together, and in each at least: a load that
/// oscillates without end is not to take minutes.
const DIVISIONS: usize = 50_000;
const LEAST_DIVISIONS: usize = 100;

/// Polynomials of a cell whose products with a load are compared.
const MOMENTS: usize = 6;

/// Sides of a crack: functions jump across it, and what presses its faces apart has no sum
/// over both.
const SIDES: usize = 2;

/// A rule with its points.
pub(crate) trait RulePoints: Clone + Send + Sync {
    /// Calls `visit` with places, normals (zero inside the body) and weights.
    fn visit(&self, visit: &mut dyn FnMut(Vec2, Vec2, f64));

    fn doubt(&self) -> &QuadratureErrorEstimate;

    /// The side of the crack whose face the points lie on; above if they lie on none.
    fn side(&self) -> Side {
        Side::Above
    }
}

impl RulePoints for CellRule {
    fn visit(&self, visit: &mut dyn FnMut(Vec2, Vec2, f64)) {
        self.points().for_each(|(x, w)| visit(x, Vec2::ZERO, w));
    }

    fn doubt(&self) -> &QuadratureErrorEstimate {
        &self.doubt
    }
}

impl RulePoints for EdgeRule {
    fn visit(&self, visit: &mut dyn FnMut(Vec2, Vec2, f64)) {
        self.points().for_each(|(x, normal, w)| visit(x, normal, w));
    }

    fn doubt(&self) -> &QuadratureErrorEstimate {
        &self.doubt
    }

    fn side(&self) -> Side {
        self.face.map_or(Side::Above, |face| face.side)
    }
}

/// The rules of one load that take the place of the system's, and what they do not resolve.
#[derive(Clone, Debug)]
pub(crate) struct LoadRules<R> {
    /// The rules of each cell.
    own: Vec<Option<Vec<R>>>,
    /// Estimated error of ∫|f|, and where.
    doubt: QuadratureErrorEstimate,
    /// ∫|f|
    magnitude: f64,
}

/// A load that the rules of the system resolve.
impl<R> Default for LoadRules<R> {
    fn default() -> Self {
        Self { own: Vec::new(), doubt: QuadratureErrorEstimate::default(), magnitude: 0.0 }
    }
}

impl<R: RulePoints> LoadRules<R> {
    /// The rules of a cell, if they are not those of the system.
    pub(crate) fn of(&self, cell: usize) -> Option<&[R]> {
        self.own.get(cell)?.as_deref()
    }

    /// Estimated error of the load's resultant as a part of its magnitude, and the place of its
    /// largest part; none if the load is resolved.
    pub(crate) fn doubt(&self) -> Option<(f64, Vec2)> {
        let error = self.doubt.load;
        (error > 0.0).then(|| (error / self.magnitude.max(f64::MIN_POSITIVE), self.doubt.at))
    }
}

/// Divisions that a load may cost in a cell.
fn divisions(space: &TrialSpace<'_>) -> usize {
    (DIVISIONS / space.partition().len()).max(LEAST_DIVISIONS)
}

/// A load: its formulas, its values at places with their normals, and the rules that a quadrature
/// has for the part of a cell that it acts on.
struct LoadIntegrals<'l, R> {
    formulas: Vec<&'l Expression>,
    values: &'l (dyn Fn(Vec2, Vec2) -> [f64; 2] + Sync),
    rules: &'l (dyn Fn(&Quadrature<'_>, usize) -> Vec<R> + Sync),
}

/// The rules of the source.
pub(super) fn of_source(
    problem: &Problem,
    space: &TrialSpace<'_>,
    stage: &WorkPhase<'_>,
) -> Result<LoadRules<CellRule>, Halt> {
    let load = LoadIntegrals {
        formulas: problem.source.iter().collect(),
        values: &|x, _| problem.source_at(x),
        rules: &|quadrature, cell| quadrature.cell(space.cell(cell)),
    };
    load.rules_on(space, stage)
}

/// Returns, for each given strain that no rule resolves, the estimated error of its integral
/// relative to its magnitude, and the place. The system keeps its own rules.
pub(super) fn unresolved_strains(
    problem: &Problem,
    space: &TrialSpace<'_>,
    stage: &WorkPhase<'_>,
) -> Result<Vec<(f64, Vec2)>, Halt> {
    let strains = Law::new(&problem.equation).strain_formulas();
    let doubt = |&strain: &&Expression| {
        let rules = LoadIntegrals {
            formulas: vec![strain],
            values: &|x, _| [strain.value(x), 0.0],
            rules: &|quadrature, cell| quadrature.cell(space.cell(cell)),
        };
        Ok(rules.rules_on(space, stage)?.doubt())
    };
    strains.iter().filter_map(|strain| doubt(strain).transpose()).collect()
}

/// The rules of the data of a condition.
pub(super) fn of_condition(
    problem: &Problem,
    space: &TrialSpace<'_>,
    condition: &BoundaryCondition,
    stage: &WorkPhase<'_>,
) -> Result<LoadRules<EdgeRule>, Halt> {
    // of an exchange both h g and h are integrated
    let values = |x, normal| match (condition.values(x, normal), condition.exchange_at(x)) {
        (values, 0.0) => values,
        ([value, _], h) => [h * value, h],
    };
    let load = LoadIntegrals {
        formulas: condition.formulas().collect(),
        values: &values,
        rules: &|quadrature, cell| {
            boundary_rules(problem, condition.on, quadrature, space.cell(cell))
        },
    };
    load.rules_on(space, stage)
}

/// The findings of a round.
struct LoadRound<R> {
    rules: LoadRules<R>,
    measure: f64,
}

impl<R: RulePoints> LoadIntegrals<'_, R> {
    fn rules_on(
        &self,
        space: &TrialSpace<'_>,
        stage: &WorkPhase<'_>,
    ) -> Result<LoadRules<R>, Halt> {
        let mut mean = 0.0;
        if self.extended(space, mean).is_none() {
            return Ok(LoadRules::default());
        }
        for round in 1..=ROUNDS {
            let Some((smoothness, places)) = self.extended(space, mean) else {
                return Ok(LoadRules::default());
            };
            let found = self.round(space, (&smoothness, &places), mean, stage)?;
            let found_mean = found.rules.magnitude / found.measure.max(f64::MIN_POSITIVE);
            let [least, most] = MEAN_FOUND.map(|part| part * mean);
            // the first round has no mean to go by
            let is_right = mean > 0.0 && (least..=most).contains(&found_mean);
            if is_right || round == ROUNDS || !found_mean.is_finite() || found.measure == 0.0 {
                return Ok(found.rules);
            }
            mean = found_mean.max(f64::MIN_POSITIVE);
        }
        Ok(LoadRules::default())
    }

    fn extended(&self, space: &TrialSpace<'_>, mean: f64) -> Option<(Smoothness, Vec<KinkLine>)> {
        let data: Vec<_> = self.formulas.iter().map(|&formula| (formula, mean)).collect();
        space.smoothness().with_data(&box_of(space.partition()), &data)
    }

    /// The rules that resolve the load up to parts of a mean; with a mean of zero those of the
    /// system, to find one.
    fn round(
        &self,
        space: &TrialSpace<'_>,
        (smoothness, places): (&Smoothness, &[KinkLine]),
        mean: f64,
        stage: &WorkPhase<'_>,
    ) -> Result<LoadRound<R>, Halt> {
        let [plain, finer] = [0, EXTRA].map(|extra| space.quadrature(extra));
        let own = space.quadrature_of(smoothness, 0).with_divisions(divisions(space));
        let same = mean * if places.is_empty() { SAME_OF_SMOOTH } else { SAME };
        let mut round = LoadRound { rules: LoadRules::default(), measure: 0.0 };
        in_batches(
            stage,
            space.partition().len(),
            || (),
            |(), cell| {
                let rect = &space.partition().cell[cell];
                let moments = |rules: &[R]| self.moments(rect, rules);
                let plain = (self.rules)(&plain, cell);
                let known = moments(&plain);
                let meets = places.iter().any(|place| place.may_meet(rect));
                if plain.is_empty() || mean == 0.0 {
                    return Ok((known, None));
                }
                if !meets && known.is_near(&moments(&(self.rules)(&finer, cell)), same) {
                    return Ok((known, None));
                }
                let own = (self.rules)(&own, cell);
                let better = moments(&own);
                let is_same = known.is_near(&better, same);
                Ok((better, (!is_same).then_some(own)))
            },
            |_, (moments, own)| {
                let doubts = own.iter().flatten().map(RulePoints::doubt);
                doubts.for_each(|doubt| round.rules.doubt.add(doubt));
                round.measure += moments.measure;
                round.rules.magnitude += moments.magnitude;
                round.rules.own.push(own);
            },
        )?;
        Ok(round)
    }

    fn moments(&self, cell: &Rect, rules: &[R]) -> Moments {
        let (center, half) = (cell.center(), cell.size() * 0.5);
        let mut moments = Moments::default();
        for rule in rules {
            rule.visit(&mut |x, normal, weight| {
                let way = x - center;
                let values = (self.values)(x, normal);
                moments.add(rule.side(), vec2(way.x / half.x, way.y / half.y), values, weight);
            });
        }
        moments
    }
}

/// Integrals of a load times polynomials of a cell.
#[derive(Default)]
struct Moments {
    /// The moments for each side of a crack and each component.
    sums: [[[f64; MOMENTS]; 2]; SIDES],
    magnitude: f64,
    measure: f64,
}

impl Moments {
    fn add(&mut self, side: Side, Vec2 { x, y }: Vec2, values: [f64; 2], weight: f64) {
        let polynomials = [1.0, x, y, x * x, x * y, y * y];
        for (sums, value) in self.sums[usize::from(side == Side::Below)].iter_mut().zip(values) {
            sums.iter_mut().zip(polynomials).for_each(|(sum, p)| *sum += weight * value * p);
        }
        self.magnitude += weight * values.iter().map(|v| v.abs()).sum::<f64>();
        self.measure += weight;
    }

    /// True if the integrals differ by no more than a load of this size.
    fn is_near(&self, other: &Self, load: f64) -> bool {
        let allowed = load * self.measure;
        let [own, other] = [self, other].map(|moments| moments.sums.as_flattened().as_flattened());
        own.iter().zip(other).all(|(a, b)| (a - b).abs() <= allowed)
    }
}

/// The rules on a part of the boundary in one cell.
pub(crate) fn boundary_rules(
    problem: &Problem,
    on: BoundaryPart,
    quadrature: &Quadrature<'_>,
    cell: CoveredCell<'_>,
) -> Vec<EdgeRule> {
    match on {
        BoundaryPart::Edge { edge, from, to } => {
            let ends = [from, to].map(|s| edge.point(&problem.domain().bounds, s));
            let part = Edge::segment(ends);
            quadrature.edge(cell, part, part.chord().left().dot(edge.normal()).signum())
        }
        BoundaryPart::Hole(hole) => quadrature.rim(cell, hole, |_| true),
        BoundaryPart::Sides(run) => {
            let is_wanted = |side| run.holds(run.hole, side);
            quadrature.rim(cell, run.hole, is_wanted)
        }
        BoundaryPart::Piece(piece) => {
            let runs = problem.pieces()[piece].runs.iter().map(|run| BoundaryPart::Sides(*run));
            runs.flat_map(|run| boundary_rules(problem, run, quadrature, cell)).collect()
        }
        BoundaryPart::Crack { crack, face } => {
            let both = [Side::Above, Side::Below];
            let sides = both.into_iter().filter(|side| face.is_none_or(|face| face == *side));
            let faces = sides.flat_map(|side| CrackFace::of(&problem.cracks()[crack], crack, side));
            faces.flat_map(|face| quadrature.face(cell, face)).collect()
        }
    }
}
