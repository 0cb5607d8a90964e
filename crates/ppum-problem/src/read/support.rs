//! The tables `[[force]]` and `[[support]]`.

use crate::data::{Force, Support};
use crate::file::{DocumentValue, FromValue as _, Section, all};

/// The forces; none at all if one of them cannot be read, as the checks count them.
pub(super) fn forces(root: &Section<'_>) -> Vec<Force> {
    root.each("force", |section| {
        let (at, value) = (section.require("at"), section.require("value"));
        let face = section.optional("face");
        Some(Force { at: at?, value: value?, face: face? })
    })
}

/// The supports; none at all if one of them cannot be read, as the checks count them.
pub(super) fn supports(root: &Section<'_>) -> Vec<Support> {
    root.each("support", |section| {
        let (at, given) = (section.require("at"), section.value("displacement"));
        let displacement = given.map_or(Some([Some(0.0); 2]), |value| displacement(&value));
        Some(Support { at: at?, displacement: displacement? })
    })
}

fn displacement(value: &DocumentValue<'_>) -> Option<[Option<f64>; 2]> {
    let component = |value: &DocumentValue<'_>| match value.as_text() {
        Some("free") => Some(None),
        _ => f64::read(value).map(Some),
    };
    all(value.array::<2>()?.iter().map(component))?.try_into().ok()
}
