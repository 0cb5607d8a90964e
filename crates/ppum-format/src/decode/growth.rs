//! `steps/…/growth`: what the tips of a step do next.

use ppum::crack::{End, TipId};
use ppum::dataset::{Advance, Fate, Growth};

use super::Read;
use super::group::Group;
use crate::content::Form;
use crate::names::{ENDS, FATES, GROWTH_NUMBERS, MEETS_CRACK, MEETS_HOLE, STOPS};

pub(super) fn growth(group: &Group) -> Read<Growth> {
    let mut growth = Growth::default();
    if group.holds("cycles", Form::Attribute)? {
        growth.cycles = Some(group.attribute("cycles")?);
    }
    if group.holds("stop", Form::Attribute)? {
        let word: String = group.attribute("stop")?;
        growth.stop = Some(group.word(STOPS, &word, "@stop")?);
    }
    growth.tips = tips(group)?;
    let points = group.points("path")?;
    let paths = group.offsets("path_offsets", growth.tips.len(), points.len())?;
    growth.tips.iter_mut().zip(paths).for_each(|(tip, part)| tip.path = points[part].to_vec());
    for (name, value) in GROWTH_NUMBERS {
        let values = group.column::<f64>(name, growth.tips.len())?;
        growth.tips.iter_mut().zip(values).for_each(|(tip, v)| *value(tip) = v);
    }
    Ok(growth)
}

/// The tips with their fates, and no numbers yet.
fn tips(group: &Group) -> Read<Vec<Advance>> {
    let cracks = group.vector::<u32>("crack")?;
    let n = cracks.len();
    let ends = group.column::<String>("end", n)?;
    let fates = group.column::<String>("fate", n)?;
    let others = group.column::<i64>("other", n)?;
    let all = cracks.into_iter().zip(ends).zip(fates.into_iter().zip(others));
    all.map(|((crack, end), (word, other))| {
        let end: End = group.word(ENDS, &end, "end")?;
        Ok(Advance::staying(TipId { crack, end }, fate(group, &word, other)?))
    })
    .collect()
}

/// A fate from its word, and the index of what is met, −1 for none.
fn fate(group: &Group, word: &str, other: i64) -> Read<Fate> {
    let index = || {
        let no_index = || group.error("other", format!("{other} is no index of what `{word}`"));
        u32::try_from(other).map_err(|_| no_index())
    };
    match word {
        MEETS_HOLE => index().map(Fate::MeetsHole),
        MEETS_CRACK => index().map(Fate::MeetsCrack),
        _ if other != -1 => {
            Err(group.error("other", format!("is {other} of `{word}`, must be -1")))
        }
        _ => group.word(FATES, word, "fate"),
    }
}
