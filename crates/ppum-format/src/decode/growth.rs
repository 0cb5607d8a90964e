//! `steps/…/growth`: what the tips of a step do next.

use ppum::crack::{End, TipId};
use ppum::dataset::{Advance, Fate, Growth};

use super::group::GroupReader;
use crate::content::ObjectKind;
use crate::names::{ENDS, FATES, GROWTH_NUMBERS, MEETS_CRACK, MEETS_HOLE, STOPS};

pub(super) fn growth(group: &GroupReader) -> Growth {
    let mut growth = Growth::default();
    growth.cycles = group.holds("cycles", ObjectKind::Attribute).then(|| group.attribute("cycles"));
    if group.holds("stop", ObjectKind::Attribute) {
        growth.stop = group.attribute_word(STOPS, "stop");
    }
    let n = group.rows_of(&["crack", "end", "fate", "other"]);
    let fates = group.column::<String>("fate", n).into_iter().zip(group.column("other", n));
    let fates: Vec<Fate> = fates.map(|(word, other)| fate(group, &word, other)).collect();
    let tips = tip_ids(group, n).into_iter().zip(fates);
    growth.tips = tips.map(|(tip, fate)| Advance::staying(tip, fate)).collect();
    let paths = group.parts("path_offsets", n, ("path", &group.points("path")));
    growth.tips.iter_mut().zip(paths).for_each(|(tip, path)| tip.path = path);
    for (name, value) in GROWTH_NUMBERS {
        let values = group.column::<f64>(name, n);
        growth.tips.iter_mut().zip(values).for_each(|(tip, v)| *value(tip) = v);
    }
    growth
}

/// A fate from its word, and the index of what is met, −1 for none.
fn fate(group: &GroupReader, word: &str, other: i64) -> Fate {
    let index = || {
        let index = u32::try_from(other);
        index.unwrap_or_else(|_| {
            group.error("other", format!("{other} is no index of what `{word}`"));
            0
        })
    };
    match word {
        MEETS_HOLE => Fate::MeetsHole(index()),
        MEETS_CRACK => Fate::MeetsCrack(index()),
        _ => {
            if other != -1 && !group.is_wrong("fate") {
                group.error("other", format!("is {other} of `{word}`, must be -1"));
            }
            group.word(FATES, word, "fate").unwrap_or(Fate::Unknown)
        }
    }
}

/// The tips that the rows of a table are about.
pub(super) fn tip_ids(group: &GroupReader, n: usize) -> Vec<TipId> {
    let (cracks, ends) = (group.column::<u32>("crack", n), group.column::<String>("end", n));
    let end = |word: &str| group.word(ENDS, word, "end").unwrap_or(End::Start);
    cracks.into_iter().zip(ends).map(|(crack, word)| TipId { crack, end: end(&word) }).collect()
}
