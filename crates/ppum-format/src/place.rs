//! The places of a dataset's errors, in the file: a path through the data model becomes that of an
//! HDF5 object.

use crate::content::{ArrayValues, ObjectKind, ObjectTree, join, key};
use crate::member::{GroupShape, MemberNames, names_of};
use crate::schema::{HEAD, STEPS};

/// The member of a name in the data model, where a segment and a centre are points.
fn member(group: &[MemberNames], name: &str) -> Option<MemberNames> {
    let last = |field: &'static str| field.rsplit('.').next().map(str::trim);
    let named = |name: &str| group.iter().copied().find(|member| last(member.field) == Some(name));
    let alias = || if ["segment", "center"].contains(&name) { named("points") } else { None };
    named(name).or_else(alias)
}

/// The object that a place such as `steps[0].functions[2].cuts[1].left` is about, with the indices
/// in its array. Text between back ticks is a name.
pub(crate) fn in_file(place: &str, content: &ObjectTree) -> String {
    let (path, name) = place.split_at(place.find(" `").unwrap_or(place.len()));
    let mut group = [names_of(HEAD), vec![STEPS.names]].concat();
    let mut found = String::new();
    let mut row = None;
    let mut indices = Vec::new();
    for part in path.split('.') {
        let (name, numbers) = part.split_at(part.find('[').unwrap_or(part.len()));
        let numbers = numbers.split(['[', ']']).filter_map(|number| number.parse().ok());
        let numbers: Vec<usize> = numbers.collect();
        match (member(&group, name), row, column_of_cut(name)) {
            _ if matches!(name, "" | "frame" | "declared") => {}
            (.., Some(column)) if found.ends_with("/cuts") => indices.push(column),
            (Some(MemberNames { kind: ObjectKind::Group, stored, shape, members, .. }), ..) => {
                found = if stored.is_empty() { found } else { join(&found, stored) };
                match (shape, numbers.first()) {
                    (GroupShape::Numbered, Some(k)) => found = join(&found, &format!("{k:04}")),
                    (GroupShape::Table, first) => row = first.copied(),
                    _ => {}
                }
                group = members();
            }
            (Some(MemberNames { stored, offsets: Some(offsets), .. }), Some(k), _) => {
                let first = entry(content, &key(&found, offsets, ObjectKind::Dataset), k);
                // kinks are counted by their ends
                let within =
                    numbers.first().map_or(0, |n| if stored == "kinks" { n / 2 } else { *n });
                found = join(&found, stored);
                (row, indices) = (None, vec![first + within]);
            }
            (member, ..) => {
                found = match member {
                    Some(member) => key(&found, member.stored, member.kind),
                    None => join(&found, name),
                };
                // a point of a row is all of it
                indices = row.take().map_or(numbers, |k| vec![k]);
            }
        }
    }
    let indices = row.into_iter().chain(indices).map(|k| format!("[{k}]"));
    found + &indices.collect::<String>() + name
}

fn column_of_cut(name: &str) -> Option<usize> {
    ["crack", "segment", "left", "right"].iter().position(|column| *column == name)
}

/// An entry of an array of offsets, 0 if there is none.
fn entry(content: &ObjectTree, name: &str, k: usize) -> usize {
    match content.get(name).map(|array| &array.values) {
        Some(ArrayValues::U64(values)) => values.get(k).map_or(0, |v| *v as usize),
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::content::Array;

    #[test]
    fn places_are_those_of_the_file() {
        let mut content = ObjectTree::new();
        let mut offsets = |name: &str| {
            content.insert(format!("steps/0002/{name}"), Array::vector([0_u64, 4, 10]));
        };
        ["cracks/offsets", "functions/cut_offsets", "functions/kink_offsets"]
            .into_iter()
            .for_each(&mut offsets);
        for (place, expected) in [
            ("domain", "domain"),
            ("domain.holes[1].radius", "domain/holes/radius[1]"),
            ("equation.young", "equation@young"),
            ("quantities `a.b`", "quantities `a.b`"),
            ("steps", "steps"),
            ("steps[0].load", "steps/0000@load"),
            ("steps[10].fields[1].coefficients[0][3]", "steps/0010/fields/0001/coefficients[0][3]"),
            ("steps[0].partition.half[7]", "steps/0000/partition/half[7]"),
            ("steps[0].partition.weight", "steps/0000/partition@weight_formula"),
            ("steps[0].attributes `order`", "steps/0000/attributes `order`"),
            ("steps[2].cracks[1].segment[3]", "steps/0002/cracks/points[7]"),
            ("steps[2].cracks[1]", "steps/0002/cracks[1]"),
            ("steps[2].functions[1].cuts[2].left", "steps/0002/functions/cuts[6][2]"),
            ("steps[2].functions[1].declared.kinks[3]", "steps/0002/functions/kinks[5]"),
            ("steps[2].functions[1].frame.crack", "steps/0002/functions/crack[1]"),
            ("steps[2].functions[1].frame.origin[0]", "steps/0002/functions/frame_origin[1]"),
            ("steps[2].functions[1].crack", "steps/0002/functions/crack[1]"),
            ("steps[0].growth.tips[3].length", "steps/0000/growth/length[3]"),
            ("steps[0].growth.cycles", "steps/0000/growth@cycles"),
            ("steps[0].warnings[1].at[0]", "steps/0000/warnings/at[1]"),
        ] {
            assert_eq!(in_file(place, &content), expected);
        }
    }
}
