//! What supports exert on the plate, for people and as JSON.

use ppum::dataset::{Dataset, Reaction, Step};
use serde::Serialize;

use crate::number::{Number, point, short};

#[derive(Debug, Serialize)]
pub(super) struct ReactionRow {
    on: String,
    /// Components that are held.
    held: Vec<String>,
    /// One a component; of a potential the flow into the plate.
    force: Vec<Number>,
    /// None of a potential.
    moment: Option<Number>,
    /// Point the moment is about.
    about: Option<[f64; 2]>,
}

/// The reactions of a step.
pub(super) fn rows(dataset: &Dataset, step: &Step) -> Vec<ReactionRow> {
    let names = step.fields.first().map_or(&[][..], |field| &field.components);
    let about = dataset.domain.bounds.center();
    let row = |reaction: &Reaction| {
        let Reaction { on, held, force, moment } = reaction;
        let held = names.iter().zip(held).filter(|(_, held)| **held);
        let turns = force.len() > 1;
        ReactionRow {
            on: on.clone(),
            held: held.map(|(name, _)| name.clone()).collect(),
            force: force.iter().copied().map(Number).collect(),
            moment: turns.then_some(Number(*moment)),
            about: turns.then_some(about.into()),
        }
    };
    step.reactions.iter().map(row).collect()
}

impl ReactionRow {
    /// `bottom (ux, uy): force (0, -2), moment 3 about (0, 0)`
    pub(super) fn line(&self) -> String {
        let place = format!("{} ({})", self.on, self.held.join(", "));
        let force = self.force.iter().map(|f| short(f.0)).collect::<Vec<_>>().join(", ");
        match (self.moment, self.about) {
            (Some(moment), Some(about)) => {
                let moment = short(moment.0);
                format!("{place}: force ({force}), moment {moment} about {}", point(about))
            }
            _ => format!("{place}: flow {force}"),
        }
    }
}
