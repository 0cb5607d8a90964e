//! Reactions of supports.

use ppum::dataset::{self, Dataset, Step};
use ppum::text::{LocationText, beside, short};
use ppum::vec2::Vec2;
use ppum_problem::{Problem, restraint_center};
use serde::Serialize;

use super::JsonNumber;

/// The reaction of a support on the body.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct ReactionFacts {
    on: String,
    /// Components that are held.
    held: Vec<String>,
    /// One a component; of a potential the flow into the body.
    force: Vec<JsonNumber>,
    /// None of a potential.
    moment: Option<JsonNumber>,
    /// Point the moment is about.
    about: Option<[f64; 2]>,
    /// Middle of the support, if its place is known.
    center: Option<[f64; 2]>,
    /// Moment about that.
    moment_about_center: Option<JsonNumber>,
}

/// The reactions of a step.
#[must_use]
pub fn reactions(dataset: &Dataset, step: &Step) -> Vec<ReactionFacts> {
    let names = step.fields.first().map_or(&[][..], |field| &field.components);
    let about = dataset.domain.bounds.center();
    let names_piece = step.reactions.iter().any(|reaction| reaction.on.starts_with("piece "));
    let problem = names_piece.then(|| Problem::of_dataset(dataset).ok().flatten()).flatten();
    let pieces = problem.as_ref().map_or(&[][..], |problem| problem.pieces());
    let domain = problem.as_ref().map_or(&dataset.domain, |problem| problem.domain());
    let row = |reaction: &dataset::Reaction| {
        let dataset::Reaction { on, held, force, moment } = reaction;
        let held = names.iter().zip(held).filter(|(_, held)| **held);
        let turns = force.len() > 1;
        // a temperature, the third component, has no force
        let force = &force[..force.len().min(2)];
        let center = restraint_center(on, domain, pieces).filter(|_| turns);
        let moved = |center: Vec2| {
            let arm = about - center;
            JsonNumber(moment + arm.x * force[1] - arm.y * force[0])
        };
        ReactionFacts {
            on: on.clone(),
            held: held.map(|(name, _)| name.clone()).collect(),
            force: force.iter().copied().map(JsonNumber).collect(),
            moment: turns.then_some(JsonNumber(*moment)),
            about: turns.then_some(about.into()),
            center: center.map(Vec2::into),
            moment_about_center: center.map(moved),
        }
    };
    step.reactions.iter().map(row).collect()
}

impl ReactionFacts {
    /// `bottom (ux, uy): force (0, -2), moment 3 about (0, 0), 1 about its middle (0, -1)`; zero
    /// what is rounding beside a force and a moment of these sizes.
    fn line(&self, places: &LocationText, [force_size, moment_size]: [f64; 2]) -> String {
        let place = format!("{} ({})", self.on, self.held.join(", "));
        let force = self
            .force
            .iter()
            .map(|f| short(beside(f.0, force_size)))
            .collect::<Vec<_>>()
            .join(", ");
        let turning = |moment: JsonNumber, about: [f64; 2]| {
            let moment = short(beside(moment.0, moment_size));
            format!("{moment} about {}", places.show(about.into()))
        };
        match (self.moment, self.about) {
            (Some(moment), Some(about)) => {
                let own = self
                    .moment_about_center
                    .zip(self.center)
                    .filter(|(_, c)| *c != about)
                    .map(|(m, c)| turning(m, c).replacen("about", "about its middle", 1));
                let own = own.map_or(String::new(), |own| format!(", {own}"));
                format!("{place}: force ({force}), moment {}{own}", turning(moment, about))
            }
            _ => format!("{place}: flow {force}"),
        }
    }
}

/// A line for each reaction. A force is zero where it is rounding beside the largest one, a moment
/// beside that at an arm of this length.
#[must_use]
pub fn reaction_lines(reactions: &[ReactionFacts], places: &LocationText, arm: f64) -> Vec<String> {
    let forces = reactions.iter().flat_map(|reaction| &reaction.force);
    let force = forces.fold(0.0, |largest, f| f64::max(largest, f.0.abs()));
    reactions.iter().map(|reaction| reaction.line(places, [force, force * arm])).collect()
}
