//! Functions of patches whose coefficients are known: the fields of forces at points.

use super::williams::SeriesFunctions;
use crate::terms::known_fields;
use ppum::dataset::{Step, monomials};
use ppum_problem::Problem;
use ppum_problem::geometry::is_known;
use std::collections::BTreeMap;

/// A function of a patch whose coefficients are known.
#[derive(Clone, Copy, Debug)]
pub struct KnownFunction {
    /// Its number among the patch's functions as they are stored.
    pub stored: usize,
    /// Its number among those that the solver evaluates.
    pub evaluated: usize,
    /// The coefficient in each component.
    pub coefficients: [f64; 2],
}

/// By the number of a patch.
pub(crate) type KnownFunctions = BTreeMap<u32, Vec<KnownFunction>>;

/// The functions of each patch whose coefficients are known.
pub(crate) fn known_functions(
    problem: &Problem,
    step: &Step,
    series: &[Vec<SeriesFunctions>],
) -> KnownFunctions {
    // in the table they have the order of the fields
    let known = (0..).zip(&step.functions).filter(|(_, function)| is_known(function));
    let numbers = known.map(|(number, _)| number);
    let known = known_fields(problem).into_iter().flat_map(|field| field.coefficients);
    let coefficients: BTreeMap<u32, [f64; 2]> = numbers.zip(known).collect();
    let mut all = BTreeMap::new();
    if coefficients.is_empty() {
        return all;
    }
    for patch in 0..step.partition.len() {
        let own =
            of_patch(step, patch, &coefficients, series.get(patch).map_or(&[], Vec::as_slice));
        if !own.is_empty() {
            all.insert(patch as u32, own);
        }
    }
    all
}

fn of_patch(
    step: &Step,
    patch: usize,
    coefficients: &BTreeMap<u32, [f64; 2]>,
    series: &[SeriesFunctions],
) -> Vec<KnownFunction> {
    let (data, mut stored, mut found) = (&step.fields[0], 0, Vec::new());
    for block in data.blocks(patch) {
        if let Some(&coefficients) = coefficients.get(&data.block_function[block]) {
            let before = series.iter().filter(|series| series.functions.end <= stored);
            let fewer = before.map(|series| series.functions.len() - series.evaluated());
            let evaluated = stored - fewer.sum::<usize>();
            found.push(KnownFunction { stored, evaluated, coefficients });
        }
        stored += monomials(data.block_degree[block].into());
    }
    found
}
