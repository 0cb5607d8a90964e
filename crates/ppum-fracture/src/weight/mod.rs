//! Weight functions: K of any load on a body by an integral (Bueckner 1970, Rice 1972).
//!
//! The factors of a tip are K = m(u) − E′/2 (∫ t·𝓛uᵃ q ds + ∫ b·𝓛uᵃ q dA), m linear in ∇u
//! (`intensity`). With the dual solution z of m, a(u, z) = m(u), and a(u, z) =
//! ∫ t·z ds + ∫ b·z dA + ∫ σ(z):ε⁰ dA for all u that loads and given strains ε⁰ make,
//!
//! ```text
//! K = ∫ t·w ds + ∫ b·w dA + ∫ σ(w):ε⁰ dA + Σ F·w(x₀) − ∫ (σ(w) n)·g ds      w = z − E′/2 q 𝓛uᵃ
//! ```
//!
//! of tractions t, also on faces up to the tip, body forces b, given strains ε⁰, forces F at points
//! and given displacements g. The term with ε⁰ follows from P_j,j = σᵃ:𝓛ε⁰ by parts: at the rim of
//! the tip is nothing, as r^½. w is in equilibrium without loads, of infinite energy, and singular
//! like r^(−½) at the tip; 1 − q keeps as r^(7/2) of that in z. A dataset holds w: the blocks of z,
//! and on each patch that meets the disc one of degree 0 for −q 𝓛uᵃ (`intensity::singular`), since
//! Σφ_i = 1.
//!
//! If the crack grows straight on by da, ∂u/∂a = 2/E′ (K_I w^I + K_II w^II) (Rice 1972).

mod derivative;
mod error;
mod factor;

use error::material;

pub use derivative::derivative;
pub use error::{FIELDS, WeightError};
pub use factor::{factor, influence, lengths, mode, polynomials, rate, tip_of};
pub use ppum_solve::assembly::Influence;

use crate::intensity::{TipDisc, singular_functions};
use crate::solve::{DualSolutions, SolveError};
use ppum::crack::{TipId, tips};
use ppum::dataset::{Dataset, FieldData, Partition, Step};
use ppum::expression::Expression;
use ppum::progress::Watcher;
use ppum::vec2::Vec2;
use ppum_problem::{Condition, Feature, Problem, ProblemData};
use ppum_solve::assembly::FACTORS;

/// The weight functions of one tip, by its number, or of all tips: a dataset with a step for each
/// tip and mode. Those of modes that vanish by symmetry are left out.
///
/// # Errors
/// See [`WeightError`].
pub fn weight_functions(
    problem: &Problem,
    tip: Option<usize>,
    memory: Option<u64>,
    watcher: &dyn Watcher,
) -> Result<Dataset, WeightError> {
    let unloaded = unloaded(problem)?;
    let all: Vec<(usize, TipId)> = tips(problem.cracks()).enumerate().collect();
    let count = all.len();
    let wanted: Vec<_> = match tip {
        None => all,
        Some(number) => vec![*all.get(number).ok_or(WeightError::NoTip { number, count })?],
    };
    if wanted.is_empty() {
        return Err(WeightError::NoTip { number: 0, count });
    }
    let of_tips: Vec<TipId> = wanted.iter().map(|(_, tip)| *tip).collect();
    let duals = DualSolutions::new((problem, &unloaded), &of_tips, memory, watcher)?;
    let DualSolutions { mut dataset, discs, coefficients } = duals;
    dataset.problem.clone_from(&problem.text);
    let step = std::mem::take(&mut dataset.steps).remove(0);
    let mut all = coefficients.chunks_exact(FACTORS);
    for (number, tip) in wanted {
        let center = step.cracks[tip.crack as usize].end_point(tip.end);
        let disc = discs.iter().find(|disc| disc.tip == center);
        let (Some(disc), Some(coefficients)) = (disc, disc.and_then(|_| all.next())) else {
            return Err(WeightError::NoRoom { number });
        };
        let elastic = unloaded.equation.elastic().ok_or(WeightError::NotElastic)?;
        let edge = step.cracks[tip.crack as usize].edge_to(tip.end);
        let singular = singular_functions(tip, &elastic.at(center), edge.curvature(), disc.radius);
        let axis = step.cracks[tip.crack as usize].growth_direction(tip.end);
        let mut base = step.clone();
        base.functions.extend(singular.into_iter().flatten());
        for mode in (0..FACTORS).filter(|&mode| disc.scale[mode] != 0.0) {
            let name = format!("{} of tip {number}", FIELDS[mode]);
            let dual = DualField { disc, axis, mode, coefficients: &coefficients[mode] };
            let field = dual.field(name, &base);
            let mut step = base.clone();
            step.fields = vec![field];
            dataset.steps.push(step);
        }
    }
    dataset.check().map_err(SolveError::from)?;
    Ok(dataset)
}

/// A dual solution and what makes a weight function of it.
struct DualField<'d> {
    disc: &'d TipDisc,
    /// The direction of growth.
    axis: Vec2,
    mode: usize,
    coefficients: &'d [f64],
}

/// Number of singular functions of a tip.
const SINGULAR: usize = 2 * FACTORS;

impl DualField<'_> {
    /// The weight function, on the patches and blocks of the field of a step, whose last functions
    /// are the singular ones of both modes: so weight functions of one tip have the same blocks.
    fn field(&self, name: String, step: &Step) -> FieldData {
        let (old, mut rest) = (&step.fields[0], self.coefficients);
        let first = (step.functions.len() - SINGULAR) as u32;
        let mut data = FieldData::new(&name, &["ux", "uy"]);
        for patch in 0..step.partition.len() {
            let own = old.blocks(patch);
            let mut blocks: Vec<_> =
                own.map(|b| (old.block_function[b], old.block_degree[b])).collect();
            let singular = if self.meets(&step.partition, patch) { SINGULAR } else { 0 };
            blocks.extend((first..).take(singular).map(|function| (function, 0)));
            data.push_patch(&blocks);
            for (i, component) in data.coefficients_mut(patch).enumerate() {
                let (of_dual, of_tip) = component.split_at_mut(component.len() - singular);
                let (part, tail) = rest.split_at(of_dual.len());
                of_dual.copy_from_slice(part);
                rest = tail;
                let own = of_tip.iter_mut().skip(2 * self.mode);
                for (coefficient, axis) in own.zip([self.axis, self.axis.left()]) {
                    *coefficient = self.disc.scale[self.mode] * <[f64; 2]>::from(axis)[i];
                }
            }
        }
        data
    }

    /// True if a patch meets the disc.
    fn meets(&self, partition: &Partition, patch: usize) -> bool {
        partition.boxes().support(patch).distance(self.disc.tip) < self.disc.radius
    }
}

/// The problem with all that is given set to zero, on the same cells.
fn unloaded(problem: &Problem) -> Result<Problem, WeightError> {
    let features = problem.features();
    if features.contains(&Feature::Contact) {
        return Err(WeightError::Contact);
    }
    if features.contains(&Feature::Anisotropic) || features.contains(&Feature::Axisymmetric) {
        return Err(WeightError::OtherLaw);
    }
    let enrichment = problem.discretization.enrichment;
    if !(enrichment.has_zones() && enrichment.has_jumps()) {
        return Err(WeightError::NoTipFunctions);
    }
    let zero = || Expression::number(0.0);
    let (mut boundary, mut supports) = (problem.boundary.clone(), problem.supports.clone());
    for condition in &mut boundary {
        if condition.pressure.is_some() {
            condition.pressure = Some(zero());
        }
        for component in &mut condition.components {
            if let Condition::Dirichlet(given) | Condition::Neumann(given) = component {
                *given = zero();
            }
        }
    }
    let given = supports.iter_mut().flat_map(|support| &mut support.displacement);
    given.flatten().for_each(|value| *value = 0.0);
    let data = ProblemData {
        equation: material(problem).ok_or(WeightError::NotElastic)?,
        boundary,
        supports,
        temperature: None,
        forces: Vec::new(),
        source: vec![zero(); 2],
        exact: Vec::new(),
        quantities: Vec::new(),
        adaptivity: None,
        growth: None,
        ..problem.clone().into_data()
    };
    Ok(Problem::new(data)?)
}
