//! The content of a dataset at a step: looked up once, not in every frame.

use std::collections::BTreeMap;
use std::sync::Arc;

use ppum::dataset::{Dataset, FieldData, Step};
use ppum::decompose::{FieldPart, KINDS};
use ppum::function::{Function, FunctionKind};
use ppum::text::LocationText;
use ppum::weight::WeightFunction;
use ppum_scene::facts::{Tip, all_tips};
use ppum_scene::overlays::Overlay;
use ppum_scene::range::places;

use crate::same_arc::SameArc;

/// The content of a dataset at a step.
#[derive(Default)]
pub struct Facts {
    of: Option<(SameArc<Dataset>, usize)>,
    /// The kinds of blocks.
    pub parts: Vec<FieldPart>,
    /// The functions, each once for all its places.
    pub functions: Vec<Stem>,
    /// Quantities that it names: names and formulas.
    pub quantities: Vec<(String, String)>,
    /// The weight as it may be written.
    pub weight: String,
    /// Number of patches.
    pub patches: usize,
    /// Overlays that it has nothing for, and why.
    pub without: Vec<(Overlay, &'static str)>,
    /// The crack tips with their factors.
    pub tips: Vec<Tip>,
    /// How places of the dataset are written.
    pub places: Option<LocationText>,
    /// True for bodies that have stresses and displacements.
    pub is_elastic: bool,
}

/// A function at all its places.
#[derive(Clone, Debug, PartialEq)]
pub struct Stem {
    /// The name without the place.
    pub name: String,
    /// The formula, or words for what is none.
    pub text: String,
    /// Names of its parameters.
    pub parameters: Vec<String>,
    /// The number of patches that have it.
    pub patches: usize,
    /// The number of its places.
    pub places: usize,
}

impl Facts {
    /// Looks up what is not known yet.
    pub fn look_up(&mut self, dataset: &Arc<Dataset>, step: usize) {
        let key = Some((dataset.into(), step));
        if self.of == key {
            return;
        }
        *self = Self { of: key, ..Self::default() };
        self.places = Some(places(dataset));
        let index = step;
        let Some(step) = dataset.steps.get(index) else { return };
        self.is_elastic = dataset.equation.elastic().is_some();
        self.tips = all_tips(dataset, index);
        self.patches = step.partition.len();
        self.weight = weight(&step.partition.boxes().weight);
        self.without = without(dataset, step);
        let named = dataset.quantities.iter();
        self.quantities = named.map(|named| (named.name.clone(), named.text.clone())).collect();
        if let Some(field) = step.fields.first() {
            let counts = counts(field, step.functions.len());
            let used = |part: &FieldPart| {
                let mut all = step.functions.iter().zip(&counts);
                all.any(|(function, &count)| count > 0 && FieldPart::of(&function.kind) == *part)
            };
            self.parts = KINDS.into_iter().filter(used).collect();
            self.functions = stems(&step.functions, &counts);
        }
    }
}

/// The number of patches that have each function.
fn counts(field: &FieldData, functions: usize) -> Vec<usize> {
    let mut counts = vec![0; functions];
    let mut last = vec![usize::MAX; functions];
    for patch in 0..field.patch_blocks.len().saturating_sub(1) {
        for block in field.blocks(patch) {
            let function = field.block_function[block] as usize;
            if last[function] != patch {
                last[function] = patch;
                counts[function] += 1;
            }
        }
    }
    counts
}

fn stems(functions: &[Function], counts: &[usize]) -> Vec<Stem> {
    let mut stems: Vec<Stem> = Vec::new();
    let mut known = BTreeMap::new();
    for (function, &patches) in functions.iter().zip(counts) {
        let number = *known.entry(function.stem()).or_insert(stems.len());
        match stems.get_mut(number) {
            Some(stem) => {
                stem.patches += patches;
                stem.places += 1;
            }
            None => stems.push(stem(function, patches)),
        }
    }
    stems
}

fn stem(function: &Function, patches: usize) -> Stem {
    let (text, parameters) = match &function.kind {
        FunctionKind::One => ("1".to_owned(), Vec::new()),
        FunctionKind::Side { crack } => (format!("side({crack})"), Vec::new()),
        FunctionKind::Component { .. } => {
            ("1 on a component of the patch, 0 on the others".to_owned(), Vec::new())
        }
        FunctionKind::Level { field } => (format!("the sign of field {field}"), Vec::new()),
        FunctionKind::Formula { text, parameters, .. } => {
            (text.clone(), parameters.iter().map(|(name, _)| name.clone()).collect())
        }
        _ => (String::new(), Vec::new()),
    };
    Stem { name: function.stem().to_owned(), text, parameters, patches, places: 1 }
}

/// The weight as it may be written: its name in the library, or its formula.
fn weight(weight: &WeightFunction) -> String {
    match weight {
        WeightFunction::Formula(formula) => {
            let text = formula.text().trim().to_owned();
            let same = |entry: &&ppum::library::Entry| entry.texts[0] == text;
            let known = ppum::library::WEIGHTS.iter().find(same);
            known.map_or(text, |entry| entry.name.to_owned())
        }
        named => named.name().to_owned(),
    }
}

fn without(dataset: &Dataset, step: &Step) -> Vec<(Overlay, &'static str)> {
    let has_problem = dataset.problem.is_some();
    let absent = [
        (
            Overlay::Points,
            step.partition.boxes().points.is_empty(),
            "The cover was made without points",
        ),
        (Overlay::Rings, step.intensities.is_empty(), "The file has no stress intensity factors"),
        (
            Overlay::Cracks,
            step.cracks.is_empty()
                && dataset.domain.holes.is_empty()
                && step.level_fields().is_empty(),
            "The plate has neither cracks nor holes",
        ),
        (Overlay::Supports, !has_problem, "The file holds no problem with supports"),
        (Overlay::Loads, !has_problem, "The file holds no problem with loads"),
    ];
    let missing = |&(overlay, is_absent, why): &(Overlay, bool, &'static str)| {
        is_absent.then_some((overlay, why))
    };
    absent.iter().filter_map(missing).collect()
}
