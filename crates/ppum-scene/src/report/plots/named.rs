//! Datasets by name, and the labels of their curves.

use ppum::dataset::Dataset;

/// A dataset with the name that curves and messages have for it where there are several.
#[derive(Clone, Copy, Debug)]
pub struct NamedDataset<'d> {
    /// The name, say that of its file.
    pub name: &'d str,
    /// The dataset.
    pub dataset: &'d Dataset,
}

/// A label of a plot as it is told in messages: `K_I` for `K_{I}`.
#[must_use]
pub fn plain(label: &str) -> String {
    let mut parts = label.split("_{");
    let mut text = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (subscript, rest) = part.split_once('}').unwrap_or((part, ""));
        text.extend(["_", subscript, rest]);
    }
    text
}

/// The title that all datasets have; none if they have several.
pub(super) fn title<'d>(mut titles: impl Iterator<Item = &'d str>) -> String {
    let first = titles.next().unwrap_or_default();
    if titles.all(|title| title == first) { first.to_owned() } else { String::new() }
}

/// A label of several curves: with the dataset's name where there are several datasets.
pub(super) fn label(several: bool, dataset: &str, name: &str) -> String {
    if several { format!("{dataset}: {name}") } else { name.to_owned() }
}
