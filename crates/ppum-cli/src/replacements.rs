//! What is done to a dataset before anything is evaluated: a part chosen, functions replaced.

use std::path::Path;

use anyhow::Context as _;
use ppum::dataset::{Dataset, Step};
use ppum::decompose::Part;

use crate::arguments::assignment;
use crate::given::{Given, file};

/// Which part is taken, and what takes the place of what.
#[derive(Debug, clap::Args)]
pub(crate) struct Replacements {
    /// Only a part of the field: smooth, jump, tip, other (enrichments of one's own), or patch:N
    #[arg(long, value_name = "PART")]
    part: Option<Part>,
    /// Replace a function, by its number or name in `ppum info`; may be given more than once
    #[arg(long, value_name = "WHICH=FORMULA", value_parser = assignment)]
    function: Vec<(String, String)>,
    /// Replace the weight function: by one of the library or a formula of t
    #[arg(long, value_name = "FORMULA", allow_hyphen_values = true)]
    weight: Option<String>,
}

impl Replacements {
    /// Changes a step of the dataset, by default the last one. Coefficients stay as they are. Parts
    /// are told apart by the functions of the file, not by those that replace them.
    pub(crate) fn apply(&self, dataset: &mut Dataset, step: Option<usize>) -> anyhow::Result<()> {
        let Dataset { steps, tables, .. } = dataset;
        let index = step.unwrap_or(steps.len().saturating_sub(1));
        // which steps there are is told where the field is made
        let Some(step) = steps.get_mut(index) else { return Ok(()) };
        self.choose_part(step).context("--part")?;
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

    /// The files that formulas are read from.
    pub(crate) fn files(&self) -> impl Iterator<Item = &Path> {
        let functions = self.function.iter().map(|(_, given)| given);
        functions.chain(&self.weight).filter_map(|given| file(given))
    }

    /// Puts a part of the first field in its place.
    fn choose_part(&self, step: &mut Step) -> anyhow::Result<()> {
        let Step { fields, functions, .. } = step;
        if let (Some(part), Some(field)) = (self.part, fields.first_mut()) {
            *field = field.part(part, functions)?;
        }
        Ok(())
    }

    /// A title that tells the part.
    pub(crate) fn title(&self, title: &str) -> String {
        match self.part {
            Some(part) => format!("{title} ({part} only)"),
            None => title.to_owned(),
        }
    }

    /// What was chosen and replaced, as notes in a picture.
    pub(crate) fn notes(&self) -> impl Iterator<Item = (String, String)> {
        let functions = self.function.iter().map(|(which, text)| format!("{which} = {text}"));
        let weight = self.weight.iter().map(|text| format!("weight = {text}"));
        let replaced = functions.chain(weight).map(|note| ("ppum:replaced".to_owned(), note));
        self.part.map(|part| ("ppum:part".to_owned(), part.to_string())).into_iter().chain(replaced)
    }
}
