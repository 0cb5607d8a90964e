//! Options that change a dataset before anything is evaluated: a part chosen, functions replaced.

use std::path::Path;

use anyhow::Context as _;
use ppum::dataset::Dataset;
use ppum::decompose::Part;
use ppum::replace::{self, ReplacementsError};

use crate::arguments::assignment;
use crate::given::{Given, file};

/// The part that is taken, and what takes the place of what.
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
    /// Changes a step of the dataset, by default the last one. No such step is told where the field is made.
    pub(crate) fn apply(&self, dataset: &mut Dataset, step: Option<usize>) -> anyhow::Result<()> {
        let texts = self.function.iter().map(|(_, text)| Given::read(text));
        let functions = texts.collect::<anyhow::Result<Vec<_>>>()?;
        let weight = self.weight.as_deref().map(Given::read).transpose()?;
        let names = self.function.iter().map(|(which, _)| which.clone());
        let replacements = replace::Replacements {
            part: self.part,
            functions: names.zip(functions.iter().map(|given| given.text.clone())).collect(),
            weight: weight.as_ref().map(|given| given.text.clone()),
        };
        let step = step.unwrap_or(dataset.steps.len().saturating_sub(1));
        let Err(error) = replacements.apply(dataset, step) else { return Ok(()) };
        match (error, &weight) {
            (ReplacementsError::Part(error), _) => Err(error).context("--part"),
            (ReplacementsError::Function { index, which, error }, _) => {
                functions[index].explain(Err(*error)).with_context(|| format!("--function {which}"))
            }
            (ReplacementsError::Weight(error), Some(given)) => {
                given.explain(Err(error)).context("--weight")
            }
            (error, _) => Err(error.into()),
        }
    }

    /// The files that formulas are read from.
    pub(crate) fn files(&self) -> impl Iterator<Item = &Path> {
        let functions = self.function.iter().map(|(_, given)| given);
        functions.chain(&self.weight).filter_map(|given| file(given))
    }

    /// A title that tells the part.
    pub(crate) fn title(&self, title: &str) -> String {
        match self.part {
            Some(part) => format!("{title} ({part} only)"),
            None => title.to_owned(),
        }
    }

    /// The choices and replacements, as notes in a picture.
    pub(crate) fn notes(&self) -> impl Iterator<Item = (String, String)> {
        let functions = self.function.iter().map(|(which, text)| format!("{which} = {text}"));
        let weight = self.weight.iter().map(|text| format!("weight = {text}"));
        let replaced = functions.chain(weight).map(|note| ("ppum:replaced".to_owned(), note));
        self.part.map(|part| ("ppum:part".to_owned(), part.to_string())).into_iter().chain(replaced)
    }
}
