//! A dataset that is open: where it came from, and whether a file has it.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use ppum::dataset::Dataset;

use crate::files::{examples, name};
use crate::session::ProblemDraft;
use crate::solving::ComputationRecord;

/// A dataset that is open.
#[derive(Clone, Debug)]
pub struct OpenDataset {
    /// Its file, if it came from one or was saved.
    pub path: Option<PathBuf>,
    /// The dataset.
    pub dataset: Arc<Dataset>,
    /// How it was computed, if that was done in this window.
    pub solution: Option<Arc<ComputationRecord>>,
}

impl OpenDataset {
    /// A dataset that was not computed in this window.
    #[must_use]
    pub fn new(path: Option<PathBuf>, dataset: Arc<Dataset>) -> Self {
        Self { path, dataset, solution: None }
    }

    /// True if no file has it, and it is none of the examples either, which can be had again
    /// at once unless they are solved in many steps.
    pub(crate) fn is_unsaved(&self) -> bool {
        self.path.is_none() && (self.dataset.steps.len() > 1 || self.example().is_none())
    }

    /// Its file or its title, in quotation marks.
    #[must_use]
    pub fn name(&self) -> String {
        let title = self.dataset.title.split_whitespace().collect::<Vec<_>>().join(" ");
        match &self.path {
            Some(path) => name(path),
            None if title.is_empty() => "without a title".into(),
            None => format!("“{title}”"),
        }
    }

    /// The problem that it solves, if its text is known.
    #[must_use]
    pub fn problem(&self) -> Option<ProblemDraft> {
        let solved = self.solution.as_ref().map(|solution| solution.problem.clone());
        solved.or_else(|| self.dataset.problem.clone().map(ProblemDraft::unchanged))
    }

    /// The problem is saved as a file: the solution is named after it if it is of this text, or of
    /// one that had no file.
    pub fn note_problem_file(&mut self, saved: &ProblemDraft, path: &Path) {
        let Some(solution) = &mut self.solution else { return };
        let is_first = solution.problem.path.is_none() && solution.problem.is_same_problem(saved);
        if is_first || solution.problem.text == saved.text {
            Arc::make_mut(solution).problem.path = Some(path.to_owned());
        }
    }

    /// The name of the file that it may be saved as: its own, that of its problem beside it, that
    /// of an example, or its title.
    #[must_use]
    pub fn proposed_name(&self, folder: &Path) -> Option<PathBuf> {
        let solution = self.solution.as_ref();
        let file = || solution.and_then(|solution| solution.problem.path.clone());
        let example = || self.example().map(PathBuf::from);
        let title = || plain_name(&self.dataset.title).map(PathBuf::from);
        let named = || file().or_else(example).or_else(title);
        let proposed = || Some(folder.join(named()?).with_extension("h5"));
        self.path.clone().or_else(proposed)
    }

    /// The name of the example whose problem it solves.
    fn example(&self) -> Option<&'static str> {
        let text = self.dataset.problem.as_deref()?;
        examples::ALL.iter().find(|example| example.text == text).map(|example| example.name)
    }
}

/// A name for a file: the letters and digits of a title.
fn plain_name(title: &str) -> Option<String> {
    let words = title.split(|c: char| !c.is_alphanumeric()).filter(|word| !word.is_empty());
    let name: String = words.collect::<Vec<_>>().join("-").chars().take(60).collect();
    (!name.is_empty()).then_some(name)
}
