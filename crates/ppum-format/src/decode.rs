//! Content → dataset, every name and shape checked.

use std::sync::Arc;

use ppum::dataset::{BoxPartition, Dataset, Equation, Step};
use ppum::formula::Table;
use ppum::vec2::{Rect, Vec2};

use crate::content::{ArrayValues, ObjectTree, step_path};
use crate::error::ReadError;
use crate::limits::FORMAT_VERSION;
pub(crate) use crate::reader::missing;
use crate::reader::{GroupReader, attempt, numbered, read};
use crate::schema::{HEAD, STEP};
use crate::scopes::Scopes;
use crate::stored::{DomainKind, PartitionKind, StoredWord as _};

type DecodeResult<T> = Result<T, ReadError>;

/// The minor version, if this is a dataset and of a major version that can be read here.
pub(crate) fn check_version(content: &ObjectTree) -> DecodeResult<u32> {
    let name = ArrayValues::Text(vec!["ppum".to_owned()]);
    if content.get("@format").is_none_or(|array| array.values != name) {
        return Err(ReadError::NotADataset);
    }
    let [major, minor] = read(content, |group| group.attribute::<[u32; 2]>("format_version"))?;
    match major {
        0 => Err(ReadError::object("@format_version", "the major version is at least 1")),
        major if major > FORMAT_VERSION.0 => {
            Err(ReadError::TooNew { major: major.into(), minor: minor.into() })
        }
        _ => Ok(minor),
    }
}

/// The dataset in a content. Shapes and words are right afterwards, meaning is not yet checked.
pub(crate) fn dataset(content: &ObjectTree) -> DecodeResult<Dataset> {
    read(content, whole)
}

/// Reads as much of a dataset as possible, and lists all errors in the objects of its content,
/// about which the dataset says nothing.
pub(crate) fn diagnose(content: &ObjectTree) -> (Dataset, Vec<ReadError>) {
    attempt(content, whole)
}

fn whole(root: &GroupReader) -> Dataset {
    let (mut dataset, scopes) = head_of(root);
    dataset.steps = numbered(&root.within(scopes.as_ref()), "steps", step);
    if root.is_fine() {
        let domain: DomainKind = root.group("domain").attribute("kind");
        dataset.steps.iter().enumerate().for_each(|(k, step)| one_kind(root, domain, k, step));
    }
    dataset
}

/// A mesh is its own domain: domain and partition are both of the kind, or none of them.
fn one_kind(root: &GroupReader, domain: DomainKind, number: usize, step: &Step) {
    let is_mesh = step.partition.mesh().is_some();
    let own = if is_mesh { PartitionKind::Mesh } else { PartitionKind::Boxes };
    if is_mesh != (domain == DomainKind::Mesh) {
        let [own, domain] = [own.word(), domain.word()].map(Option::unwrap_or_default);
        let message = format!(
            "`{own}` does not belong to a domain of the kind `{domain}`: both or none must be `mesh`"
        );
        root.group(&step_path(number)).group("partition").error("@kind", message);
    }
}

/// The dataset without its steps.
pub(crate) fn head(content: &ObjectTree) -> DecodeResult<Dataset> {
    read(content, |root| head_of(root).0)
}

/// The dataset without its steps, and the scopes of its formulas if nothing is wrong with the
/// tables.
fn head_of(root: &GroupReader) -> (Dataset, Option<Scopes>) {
    let (tables, rest) = HEAD.split_at(1);
    let domain = Rect::new(Vec2::ZERO, Vec2::ZERO);
    let mut dataset = root.taken(tables, Dataset::new(domain, Equation::None));
    let scopes = if root.is_fine() { scopes(root, &dataset.tables) } else { None };
    root.within(scopes.as_ref()).take(rest, &mut dataset);
    (dataset, scopes)
}

/// Scopes of formulas with these tables, if their names do not clash.
fn scopes(root: &GroupReader, tables: &[Arc<Table>]) -> Option<Scopes> {
    root.or_report(Scopes::new(tables))
}

fn step(group: &GroupReader) -> Step {
    group.taken(STEP, Step::new(BoxPartition::EMPTY))
}

/// The step of the dataset with these tables, in a content that holds nothing else.
pub(crate) fn one_step(
    content: &ObjectTree,
    path: &str,
    tables: &[Arc<Table>],
) -> DecodeResult<Step> {
    read(content, |root| step(&root.within(scopes(root, tables).as_ref()).group(path)))
}

/// The load of a step and these of its members, in a content that holds them alone. The step has
/// no patches.
pub(crate) fn part_of_step(
    content: &ObjectTree,
    path: &str,
    members: &[&str],
) -> DecodeResult<Step> {
    read(content, |root| {
        let (group, mut step) = (root.group(path), Step::new(BoxPartition::EMPTY));
        let is_read = |name: &str| name == "load" || members.contains(&name);
        let read = STEP.iter().filter(|member| is_read(member.names.stored));
        read.for_each(|member| group.take_one(member, 0, &mut step));
        step
    })
}

#[cfg(test)]
mod tests;
