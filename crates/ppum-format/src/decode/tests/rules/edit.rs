//! Edits of contents.

use crate::content::{Array, ElementType, ObjectTree};

/// Changes the values of an array; a vector becomes as long as they are then.
pub(super) fn edit<T: ElementType>(
    content: &mut ObjectTree,
    name: &str,
    change: impl FnOnce(&mut Vec<T>),
) {
    let array = content.get_mut(name).unwrap_or_else(|| panic!("{name} is there"));
    let Some(values) = T::of(&array.values) else { panic!("{name} is of another type") };
    let mut values = values.to_vec();
    change(&mut values);
    if let [length] = array.shape.as_mut_slice() {
        *length = values.len() as u64;
    }
    array.values = T::wrap(values);
}

pub(super) fn set<T: ElementType>(content: &mut ObjectTree, name: &str, at: usize, value: T) {
    edit(content, name, |values: &mut Vec<T>| values[at] = value);
}

pub(super) fn put(content: &mut ObjectTree, name: &str, array: Array) {
    content.insert(name.into(), array);
}

pub(super) fn text(text: &str) -> Array {
    Array::scalar(text.to_owned())
}

pub(super) fn texts(texts: &[&str]) -> Array {
    Array::vector(texts.iter().map(|&text| text.to_owned()))
}

/// Removes an object with all that is in it.
pub(super) fn remove(content: &mut ObjectTree, path: &str) {
    let is_inside = |name: &str| {
        name.strip_prefix(path).is_some_and(|rest| rest.is_empty() || rest.starts_with(['/', '@']))
    };
    let mut kept = ObjectTree::new();
    content.groups().filter(|group| !is_inside(group)).for_each(|group| kept.insert_group(group));
    for (name, array) in content.iter().filter(|(name, _)| !is_inside(name)) {
        kept.insert(name.clone(), array.clone());
    }
    *content = kept;
}

/// Gives a group another path.
pub(super) fn rename(content: &mut ObjectTree, from: &str, to: &str) {
    let moved: Vec<_> = content
        .iter()
        .filter_map(|(name, array)| {
            Some((format!("{to}{}", name.strip_prefix(from)?), array.clone()))
        })
        .collect();
    remove(content, from);
    moved.into_iter().for_each(|(name, array)| put(content, &name, array));
}
