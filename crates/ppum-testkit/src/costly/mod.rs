//! Small files that ask for much: for every loop over what a file says there is one whose
//! sizes multiply.
//!
//! All of them are datasets as a writer could make them, most of equal numbers, so that hundreds of
//! thousands of patches, blocks or cracks are some ten kilobytes of a file. Each is there to be
//! read within the bounds of docs/cli.md, or to be refused with its reason; [`Costly::refused`]
//! says which.

mod formulas;
mod many;
mod stored;

use ppum::cover::Cover;
use ppum::crack::{Crack, CrackEnd};
use ppum::dataset::{
    BoxPartition, Dataset, Equation, FieldData, Material, Record, Step, StressState,
};
use ppum::function::{Function, FunctionKind};
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;

/// A dataset that is costly to somebody who reads it carelessly.
#[derive(Clone, Debug)]
pub struct Costly {
    /// The thing there is much of, as the name of a file.
    pub name: &'static str,
    /// The dataset.
    pub dataset: Dataset,
    /// Words of the error, where a reader has to refuse it.
    pub refused: Option<&'static str>,
}

/// All of them.
#[must_use]
pub fn all() -> Vec<Costly> {
    chosen(|_, _| true)
}

/// Those that are chosen by their name and by the words of the error.
#[must_use]
pub fn chosen(is_chosen: impl Fn(&str, Option<&str>) -> bool) -> Vec<Costly> {
    let makers: [&[CostlyCase]; 3] = [many::ALL, formulas::ALL, stored::ALL];
    let chosen = makers.into_iter().flatten().filter(|maker| is_chosen(maker.0, maker.1));
    chosen.map(|&(name, refused, make)| Costly { name, dataset: make(), refused }).collect()
}

/// The dataset of this name.
///
/// # Panics
/// If there is none.
#[must_use]
pub fn named(name: &str) -> Dataset {
    let makers: [&[CostlyCase]; 3] = [many::ALL, formulas::ALL, stored::ALL];
    let maker = makers.into_iter().flatten().find(|maker| maker.0 == name);
    (maker.unwrap_or_else(|| panic!("there is no costly dataset `{name}`")).2)()
}

/// Name, words of the error if it is refused, and what makes it.
type CostlyCase = (&'static str, Option<&'static str>, fn() -> Dataset);

/// The plate all of them are made from: [0, 1]², cells × cells patches of the order, with cracks.
fn plate(cells: u32, order: u8, cracks: Vec<Crack>) -> Dataset {
    let domain = Rect::new(vec2(0.0, 0.0), vec2(1.0, 1.0));
    let cover = Cover::grid(domain, [cells, cells]).expect("a cover");
    let partition = cover.partition(1.3, WeightFunction::Linear).expect("a partition");
    let blocks = vec![vec![(0, order)]; partition.len()];
    let one = FunctionKind::One;
    let mut step = Step::new(partition).with_function("one", one).with_field(displacement(&blocks));
    step.cracks = cracks;
    step.history = vec![Record { name: "energy".into(), value: 1.0, unit: String::new() }];
    let material = Material { young: 1.0, poisson: 0.3, state: StressState::PlaneStrain };
    let mut dataset = Dataset::new(domain, Equation::elasticity(material)).with_step(step);
    (dataset.title, dataset.program) = ("costly".into(), "ppum".into());
    dataset
}

/// A displacement whose patches have blocks of these functions and degrees, all coefficients alike.
fn displacement(patches: &[Vec<(u32, u8)>]) -> FieldData {
    let mut data = FieldData::new("displacement", &["ux", "uy"]);
    patches.iter().for_each(|blocks| data.push_patch(blocks));
    data.coefficients.iter_mut().for_each(|component| component.fill(0.5));
    data
}

/// A partition of patches that all lie over the whole plate, their cells strips of it.
fn piled(patches: usize) -> BoxPartition {
    let (center, half) = (vec2(0.5, 0.5), vec2(1.0, 1.0));
    let at = |k: usize| k as f64 / patches as f64;
    let strip = |k: usize| Rect::new(vec2(0.0, at(k)), vec2(1.0, at(k + 1)));
    BoxPartition {
        weight: WeightFunction::Linear,
        center: vec![center; patches],
        half: vec![half; patches],
        origin: vec![center; patches],
        scale: vec![half; patches],
        cell: (0..patches).map(strip).collect(),
        level: vec![0; patches],
        point: vec![None; patches],
        points: Vec::new(),
    }
}

/// A crack from the left to the right with two tips.
fn straight(left: Vec2, length: f64) -> Crack {
    Crack { points: vec![left, left + vec2(length, 0.0)], ends: [CrackEnd::Tip; 2] }
}

/// One crack in the middle.
fn middle() -> Vec<Crack> {
    vec![straight(vec2(0.25, 0.4375), 0.5)]
}

/// The plate with blocks of the functions, which every patch has.
fn with_functions(mut dataset: Dataset, functions: Vec<Function>) -> Dataset {
    let step = &mut dataset.steps[0];
    let blocks: Vec<_> = (0..functions.len() as u32).map(|function| (function, 1)).collect();
    step.fields = vec![displacement(&vec![blocks; step.partition.len()])];
    step.functions = functions;
    dataset
}
