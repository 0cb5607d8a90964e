//! Options that change a dataset before anything is evaluated: a part chosen, functions replaced.

use std::fmt;
use std::path::Path;
use std::str::FromStr;

use anyhow::{Context as _, ensure};
use ppum::dataset::Dataset;
use ppum::decompose::FieldPart;
use ppum::replace::ReplacementsError;
use ppum_scene::arguments::assignment;
use ppum_scene::panels::{WHOLE, caption};
use ppum_scene::scene::{Subject, SubjectError};

use crate::formula_text::{FormulaText, file};

/// The part that is taken, and what takes the place of what.
#[derive(Debug, clap::Args)]
pub(crate) struct ReplacementArgs {
    /// Evaluate only one contribution to the field: smooth, jump, tip, other (corner and
    /// user-defined functions), or patch:N; `render` draws several, separated by commas, in
    /// panels, with `all` for the whole field
    #[arg(long, value_name = "PART", value_delimiter = ',')]
    part: Vec<PartChoice>,
    /// Replace a function, by its number or name in `ppum info`; may be given more than once
    #[arg(long, value_name = "WHICH=FORMULA", value_parser = assignment)]
    function: Vec<(String, String)>,
    /// Replace the weight function: by one of the library or a formula of t
    #[arg(long, value_name = "FORMULA", allow_hyphen_values = true)]
    weight: Option<String>,
    /// Replace the formula of a quantity that the dataset names; may be given more than once
    #[arg(long, value_name = "NAME=FORMULA", value_parser = assignment)]
    define: Vec<(String, String)>,
}

/// A part of the field, or all of it.
#[derive(Clone, Copy, Debug, PartialEq)]
struct PartChoice(Option<FieldPart>);

impl FromStr for PartChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.trim() {
            WHOLE => Ok(Self(None)),
            part => {
                Ok(Self(Some(part.parse().map_err(|error| format!("{error}; all is the whole"))?)))
            }
        }
    }
}

impl fmt::Display for PartChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            Some(part) => part.fmt(f),
            None => f.write_str(WHOLE),
        }
    }
}

impl ReplacementArgs {
    /// Changes a step of the dataset, by default the last one. No such step is told where the field
    /// is made.
    pub(crate) fn apply(&self, dataset: &mut Dataset, step: Option<usize>) -> anyhow::Result<()> {
        ensure!(self.part.len() <= 1, "--part: give one part; several are panels of `ppum render`");
        self.apply_part(dataset, step, self.part.first().and_then(|choice| choice.0))
    }

    /// The dataset changed for each part.
    pub(crate) fn each(
        &self,
        dataset: Dataset,
        step: Option<usize>,
    ) -> anyhow::Result<Vec<Dataset>> {
        let parts = if self.part.is_empty() { &[PartChoice(None)][..] } else { &self.part };
        let copies = std::iter::repeat_n(dataset, parts.len());
        let changed = copies.zip(parts).map(|(mut dataset, choice)| {
            self.apply_part(&mut dataset, step, choice.0)?;
            Ok(dataset)
        });
        changed.collect()
    }

    fn apply_part(
        &self,
        dataset: &mut Dataset,
        step: Option<usize>,
        part: Option<FieldPart>,
    ) -> anyhow::Result<()> {
        let read = |texts: &[(String, String)]| -> anyhow::Result<Vec<FormulaText>> {
            texts.iter().map(|(_, text)| FormulaText::read(text)).collect()
        };
        let (functions, quantities) = (read(&self.function)?, read(&self.define)?);
        let weight = self.weight.as_deref().map(FormulaText::read).transpose()?;
        let named = |names: &[(String, String)], texts: &[FormulaText]| {
            let names = names.iter().map(|(name, _)| name.clone());
            names.zip(texts.iter().map(|given| given.text.clone())).collect()
        };
        let subject = Subject {
            step,
            part: part.map(|part| part.to_string()),
            functions: named(&self.function, &functions),
            weight: weight.as_ref().map(|given| given.text.clone()),
            quantities: named(&self.define, &quantities),
        };
        let defined = |name: &str| self.define.iter().position(|(known, _)| known == name);
        match (subject.apply(dataset), &weight) {
            (Err(SubjectError::Replacements(error)), weight) => match (error, weight) {
                (ReplacementsError::Part(error), _) => Err(error).context("--part"),
                (ReplacementsError::Function { index, which, error }, _) => functions[index]
                    .explain(Err(*error))
                    .with_context(|| format!("--function {which}")),
                (ReplacementsError::Weight(error), Some(given)) => {
                    given.explain(Err(error)).context("--weight")
                }
                (error, _) => Err(error.into()),
            },
            (Err(SubjectError::Quantity { name, error }), _) => {
                let given = &quantities[defined(&name).unwrap_or_default()];
                given.explain(Err(*error)).with_context(|| format!("--define {name}"))
            }
            (Err(error @ SubjectError::Unnamed { .. }), _) => {
                let SubjectError::Unnamed { name, .. } = &error else { unreachable!() };
                let context = format!("--define {name}");
                Err(error).context(context)
            }
            (result, _) => Ok(result?),
        }
    }

    /// The files that formulas are read from.
    pub(crate) fn files(&self) -> impl Iterator<Item = &Path> {
        let functions = self.function.iter().chain(&self.define).map(|(_, given)| given);
        functions.chain(&self.weight).filter_map(|given| file(given))
    }

    /// A title that tells the part.
    pub(crate) fn title(&self, title: &str) -> String {
        match self.part[..] {
            [PartChoice(Some(part))] => format!("{title} ({part} only)"),
            _ => title.to_owned(),
        }
    }

    /// Returns the chosen subject of a dataset; formulas are as they were given.
    pub(crate) fn subject(&self, step: Option<usize>) -> Subject {
        let part = match self.part[..] {
            [PartChoice(Some(part))] => Some(part.to_string()),
            _ => None,
        };
        let (functions, quantities) = (self.function.clone(), self.define.clone());
        Subject { step, part, functions, weight: self.weight.clone(), quantities }
    }

    /// The parts, where there are several.
    pub(crate) fn parts(&self) -> Vec<String> {
        let parts = self.part.iter().map(PartChoice::to_string);
        if self.part.len() > 1 { parts.collect() } else { Vec::new() }
    }

    /// The parts in words, where there are several: `smooth part`.
    pub(crate) fn captions(&self) -> Vec<String> {
        self.parts().iter().map(|part| caption(part)).collect()
    }

    /// The choices and replacements, as notes in an image.
    pub(crate) fn notes(&self) -> impl Iterator<Item = (String, String)> {
        let functions = self.function.iter().map(|(which, text)| format!("{which} = {text}"));
        let weight = self.weight.iter().map(|text| format!("weight = {text}"));
        let defined = self.define.iter().map(|(name, text)| format!("{name} = {text}"));
        let replaced =
            functions.chain(weight).chain(defined).map(|note| ("ppum:replaced".to_owned(), note));
        let parts: Vec<String> = self.part.iter().map(PartChoice::to_string).collect();
        let part = (!parts.is_empty()).then(|| ("ppum:part".to_owned(), parts.join(", ")));
        part.into_iter().chain(replaced)
    }
}
