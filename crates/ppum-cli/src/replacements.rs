//! Functions of a dataset replaced before anything is evaluated.

use anyhow::Context as _;
use ppum::dataset::Dataset;

use crate::arguments::assignment;
use crate::given::Given;

/// What takes the place of what.
#[derive(Debug, clap::Args)]
pub(crate) struct Replacements {
    /// Replace a function, by its number or name in `ppum info`; may be given more than once
    #[arg(long, value_name = "WHICH=FORMULA", value_parser = assignment)]
    function: Vec<(String, String)>,
    /// Replace the weight function: by one of the library or a formula of t
    #[arg(long, value_name = "FORMULA", allow_hyphen_values = true)]
    weight: Option<String>,
}

impl Replacements {
    /// Changes a step of the dataset, by default the last one. Coefficients stay as they are.
    pub(crate) fn apply(&self, dataset: &mut Dataset, step: Option<usize>) -> anyhow::Result<()> {
        let Dataset { steps, tables, .. } = dataset;
        let index = step.unwrap_or(steps.len().saturating_sub(1));
        // which steps there are is told where the field is made
        let Some(step) = steps.get_mut(index) else { return Ok(()) };
        for (which, given) in &self.function {
            let given = Given::read(given)?;
            let replaced = step.replace_function(which, &given.text, tables);
            given.explain(replaced).with_context(|| format!("--function {which}"))?;
        }
        if let Some(given) = &self.weight {
            let given = Given::read(given)?;
            let replaced = step.replace_weight(&given.text, tables);
            given.explain(replaced).context("--weight")?;
        }
        Ok(())
    }

    /// What was replaced, as notes in a picture.
    pub(crate) fn notes(&self) -> impl Iterator<Item = (String, String)> {
        let functions = self.function.iter().map(|(which, text)| format!("{which} = {text}"));
        let weight = self.weight.iter().map(|text| format!("weight = {text}"));
        functions.chain(weight).map(|note| ("ppum:replaced".to_owned(), note))
    }
}
