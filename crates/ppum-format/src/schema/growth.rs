//! How the cracks of a step grow on from it.

use ppum::dataset::{Growth, Step, TipIncrement, TipStatus};

use crate::member::{GroupShape, Member, TableMembers, members, names_of};
use crate::reader::GroupReader;
use crate::stored::StoredWord as _;

pub(super) const GROWTH: Member<Step> = Member::<Step>::group(
    "growth",
    (GroupShape::Single, || names_of(MEMBERS)),
    |step, group, name| {
        step.growth.iter().try_for_each(|growth| group.group(name).put(MEMBERS, growth))
    },
    |step, group, name, _| step.growth = Some(group.group(name).taken(MEMBERS, Growth::default())),
)
.optional();

const MEMBERS: &[Member<Growth>] = members!(Growth:
    some_attribute("cycles", cycles), some_attribute("stop", stop), custom(TIPS));

/// The rows of the group itself.
const TIPS: Member<Growth> = Member::<Growth>::group(
    "",
    (GroupShape::Table, || names_of(TIP)),
    |growth, group, _| group.put(TIP, &growth.tips),
    |growth, group, _, _| growth.tips = group.table(TIP),
)
.of_field("tips");

const TIP: &TableMembers<TipIncrement> = members!(TipIncrement:
    cell("crack", tip.crack), cell("end", tip.end), cell("fate", fate), custom(OTHER),
    list("path", "path_offsets", path), cell("strength", k_eq), cell("direction", direction),
    cell("curvature", curvature), cell("length", length), cell("due", due),
    cell("extension", extension),
);

const OTHER: Member<[TipIncrement]> = Member {
    counts: true,
    ..Member::<[TipIncrement]>::array(
        "other",
        |tips, group, name| group.values(name, &tips.iter().map(other).collect::<Vec<_>>()),
        |tips, group, name, n| {
            let others = tips.iter_mut().zip(group.rows(name, n));
            others.for_each(|(tip, other)| set_other(group, tip, other));
        },
    )
};

/// The index of what a tip meets, −1 for none.
fn other(tip: &TipIncrement) -> i64 {
    match tip.fate {
        TipStatus::MeetsHole(k) | TipStatus::MeetsCrack(k) => k.into(),
        _ => -1,
    }
}

fn set_other(group: &GroupReader, tip: &mut TipIncrement, other: i64) {
    let word = tip.fate.word().unwrap_or_default();
    match &mut tip.fate {
        TipStatus::MeetsHole(k) | TipStatus::MeetsCrack(k) => match u32::try_from(other) {
            Ok(index) => *k = index,
            Err(_) => group.error("other", format!("{other} is no index of what `{word}`")),
        },
        _ if other != -1 && !group.is_wrong("fate") => {
            group.error("other", format!("is {other} of `{word}`, must be -1"));
        }
        _ => {}
    }
}
