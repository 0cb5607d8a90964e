//! What a solution leaves for the next one of a series: integrals over cells on which nothing
//! has changed.

use crate::assembly::{FreeModes, Gauge, Given, System};
use crate::basis::StableBasis;
use crate::space::{Prints, Space, Unchanged};
use std::sync::{Mutex, PoisonError};

/// The place where a series keeps what its last solution has integrated.
///
/// Solutions have the same bits with and without it.
#[derive(Default)]
pub(crate) struct Shelf(Mutex<Option<CachedSystem>>);

/// Basis and system of a space.
pub(super) struct CachedSystem {
    prints: Prints,
    basis: StableBasis,
    /// The system with its moments, and with the penalties of the gauge if the solver has
    /// needed them.
    system: System,
    gauge: Gauge,
}

/// What is kept of an earlier space, as this one sees it.
pub(super) struct Reused {
    prints: Prints,
    before: Option<(Unchanged, CachedSystem)>,
}

impl Shelf {
    /// What there is for a space. It is taken away, so that its memory is free as soon as there is
    /// a new system.
    pub(super) fn take(&self, space: &Space<'_>) -> Reused {
        let before = self.0.lock().unwrap_or_else(PoisonError::into_inner).take();
        let prints = Prints::new(space);
        let before = before.map(|kept| (prints.unchanged(&kept.prints), kept));
        Reused { prints, before }
    }

    /// Keeps the basis and the system of a space.
    pub(super) fn put(
        &self,
        prints: Prints,
        basis: StableBasis,
        mut system: System,
        mut gauge: Gauge,
    ) {
        (system.moments, system.duals) = (gauge.take_moments(), Vec::new());
        let kept = CachedSystem { prints, basis, system, gauge };
        *self.0.lock().unwrap_or_else(PoisonError::into_inner) = Some(kept);
    }
}

impl Reused {
    /// The prints of the space, all that is still needed when its system is known.
    pub(super) fn into_prints(self) -> Prints {
        self.prints
    }

    /// The earlier basis.
    pub(super) fn basis(&self) -> Option<(&Unchanged, &StableBasis)> {
        self.before.as_ref().map(|(unchanged, kept)| (unchanged, &kept.basis))
    }

    /// What is as it was of the system, too: of patches with the same basis and without penalties,
    /// if data and free modes are the same. In each of their cells all functions are the same,
    /// since how a border is held depends on all of them, and rounding in products of matrices on
    /// their number.
    pub(super) fn system(
        &self,
        space: &Space<'_>,
        basis: &StableBasis,
        given: &Given<'_>,
        free: &FreeModes<'_>,
    ) -> Option<(Unchanged, &System)> {
        let (unchanged, kept) = self.before.as_ref()?;
        if given.has_own_rules() || !free.are_those_of(&kept.gauge) {
            return None;
        }
        let holds = |patch: usize, was: usize| {
            basis.is_same(patch, &kept.basis, was) && !kept.gauge.penalised().contains(&was)
        };
        Some((unchanged.clone().filter(&space.coverers, holds), &kept.system))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::Problem;
    use crate::solve::Plan;
    use ppum::dataset::Dataset;
    use ppum::progress::unwatched;
    use ppum_testkit::random::Random;
    use std::path::Path;

    /// A plate with an edge crack that has random bends, and a second crack that grows at
    /// its start.
    fn plate(random: &mut Random, level: u32, more: &str) -> [Problem; 3] {
        let mut edge = vec![[-1.0, random.between(-0.4, 0.4)]];
        for _ in 0..5 {
            let [x, y] = edge[edge.len() - 1];
            edge.push([x + random.between(0.12, 0.2), y + random.between(-0.08, 0.08)]);
        }
        let inner = [[0.33, 0.6], [0.4, 0.62], [0.5, 0.7], [0.75, 0.8]];
        [4, 5, 6].map(|n| {
            let (edge, inner) = (&edge[..n], &inner[6 - n..]);
            let text = format!(
                r#"
                domain = {{ min = [-1, -1], max = [1, 1] }}
                material = {{ young = 1, poisson = 0.3, state = "plane-strain" }}
                crack = [{{ points = {edge:?} }}, {{ points = {inner:?} }}]
                discretization = {{ level = {level}, order = 1 }}
                {more}
                "#
            );
            Problem::parse(&text, "plate.toml", Path::new(".")).expect("a problem in order")
        })
    }

    const PULLED: &str = r#"
        boundary = [{ on = "bottom", traction = [0, -1] }, { on = "top", traction = [0, 1] }]
    "#;

    const HELD: &str = r#"
        boundary = [
            { on = "bottom", displacement = [0, 0] },
            { on = "top", traction = [0, "1 + x"] },
            { on = { crack = 0 }, pressure = 0.5 },
        ]
        body_force = { value = [0, "-x*y"] }
        hole = [{ center = [0.1, -0.6], radius = 0.15 }]
        enrichment = [{ functions = ["sqrt(r)"], at = [-0.5, -0.7], radius = 0.2 }]
    "#;

    /// All of a dataset but the seconds, in words: NaN is equal to itself there.
    fn timeless(mut dataset: Dataset) -> String {
        crate::report::forget_times(&mut dataset.steps[0]);
        format!("{dataset:?}")
    }

    /// Solutions one after the other, with a shelf or without.
    fn solved(problems: &[Problem], shelf: Option<&Shelf>) -> Vec<String> {
        let solve = |problem| {
            let plan = Plan::new(problem, None, unwatched()).expect("a plan");
            let plan = match shelf {
                Some(shelf) => plan.with_shelf(shelf),
                None => plan,
            };
            timeless(plan.solve(unwatched()).expect("a solution"))
        };
        problems.iter().map(solve).collect()
    }

    /// What is taken from a shelf is what would have been integrated, to the last bit.
    #[test]
    fn bits_are_the_same_with_a_shelf() {
        let mut random = Random(17);
        for more in [PULLED, HELD] {
            let problems = plate(&mut random, 1, more);
            let shelf = Shelf::default();
            assert!(solved(&problems, None) == solved(&problems, Some(&shelf)), "{more}");
        }
    }

    /// Most of the plate is taken over where cracks grow, and nothing where all patches are others
    /// or the law is one.
    #[test]
    fn what_is_taken_over() {
        let [first, second, _] = plate(&mut Random(3), 5, PULLED);
        let part = |before: &Problem, after: &Problem| {
            let shelf = Shelf::default();
            solved(std::slice::from_ref(before), Some(&shelf));
            let plan = Plan::new(after, None, unwatched()).expect("a plan");
            let n = plan.space.partition().len();
            let reused = shelf.take(&plan.space);
            let (unchanged, _) = reused.basis().expect("something on the shelf");
            (0..n).filter(|&patch| unchanged.patch(patch).is_some()).count() as f64 / n as f64
        };
        assert_eq!(part(&first, &first), 1.0);
        let (there, back) = (part(&first, &second), part(&second, &first));
        assert!(there > 0.25 && there < 0.9, "{there}");
        assert!(back > 0.25 && back < 0.9, "{back}");
        let mut other = second.clone();
        other.discretization.overlap = 1.4;
        assert_eq!(part(&second, &other), 0.0);
        let mut other = second.clone();
        other.discretization.order = crate::problem::Order::Uniform(2);
        assert_eq!(part(&second, &other), 0.0);
    }
}
