//! Cracks, and the bulges of their edges and of those of rims.

use ppum::crack::{Crack, CrackEnd};
use ppum::dataset::Step;
use ppum::vec2::Vec2;

use crate::member::{GroupShape, Member, TableMembers, members, names_of};
use crate::reader::GroupReader;
use crate::stored::StoredEnd;

pub(super) const CRACKS: Member<Step> = Member::<Step>::group(
    "cracks",
    (GroupShape::Table, || names_of(CRACK)),
    |step, group, name| {
        let rows: Vec<_> = step.cracks.iter().map(StoredCrack::of).collect();
        group.group(name).put(CRACK, &rows)
    },
    |step, group, name, _| {
        let group = group.group(name);
        let rows = group.table(CRACK).into_iter().enumerate();
        step.cracks = rows.map(|(k, row)| row.crack(&group, k)).collect();
    },
);

/// A crack as a row of its group: of one without arcs the bulges are 0.
#[derive(Clone, Default)]
struct StoredCrack {
    ends: [StoredEnd; 2],
    points: Vec<Vec2>,
    bulges: Vec<f64>,
}

const CRACK: &TableMembers<StoredCrack> = members!(StoredCrack:
    cell("ends", ends), list("points", "offsets", points), bulges("ends"));

impl StoredCrack {
    fn of(crack: &Crack) -> Self {
        let is_curved = crack.is_curved();
        let ends = crack.ends.map(|kind| StoredEnd { kind, is_curved });
        let bulges = padded(&crack.bulges, crack.points.len());
        Self { ends, points: crack.points.clone(), bulges }
    }

    fn is_curved(&self) -> bool {
        self.ends.iter().any(|end| end.is_curved)
    }

    /// The crack of row k.
    fn crack(self, group: &GroupReader, k: usize) -> Crack {
        let ends: [CrackEnd; 2] = self.ends.map(|end| end.kind);
        let says = self.ends.map(|end| end.is_curved);
        let mut bulges = arcs(group, ("ends", &says), &format!("crack {k}"), self.bulges);
        if bulges.pop().is_some_and(|last| last != 0.0) {
            group.error("bulges", format!("crack {k} has one behind its last point: expected 0"));
        }
        Crack { points: self.points, bulges, ends }
    }
}

/// The bulges of so many points, 0 behind those that have none.
pub(super) fn padded(bulges: &[f64], points: usize) -> Vec<f64> {
    let mut all = bulges.to_vec();
    all.resize(points.max(bulges.len()), 0.0);
    all
}

/// The bulges of a row if some are not 0, else none. Words of the row must say whether it has arcs,
/// by which readers of files before 1.8 know that they cannot read it.
pub(super) fn arcs(
    group: &GroupReader,
    (words, says): (&str, &[bool]),
    row: &str,
    bulges: Vec<f64>,
) -> Vec<f64> {
    let has_arcs = bulges.iter().any(|bulge| *bulge != 0.0);
    let is_known = !["bulges", "offsets", words].iter().any(|name| group.is_wrong(name));
    if is_known && says.iter().any(|is_curved| *is_curved != has_arcs) {
        let message = if has_arcs {
            format!("{row} has arcs, so its words here must begin with `curved-`")
        } else {
            format!("{row} has no arcs by `bulges`, so leave out `curved-` here")
        };
        group.error(words, message);
    }
    if has_arcs { bulges } else { Vec::new() }
}
