//! Stress intensity factors on the circle that a pane shows.

use std::sync::Arc;

use ppum::crack::{TipId, tips};
use ppum::dataset::{Dataset, TipIntensity};
use ppum::progress::Watcher;
use ppum::vec2::Vec2;
use ppum_fracture::intensity::{CircleError, clearance, on_circle};
use ppum_problem::Problem;
use ppum_scene::facts::{HEADS, Tip};
use ppum_scene::profile::ProfileCurve;

use crate::query::BackgroundQuery;
use crate::same_arc::SameArc;

/// The request.
#[derive(Clone, Debug, PartialEq)]
pub struct IntegralRequest {
    dataset: SameArc<Dataset>,
    step: usize,
    tip: TipId,
    radius: f64,
}

/// The factors on a circle, found in the background.
#[derive(Default)]
pub struct CircleIntegral {
    question: BackgroundQuery<IntegralRequest, TipIntensity>,
    asked: Option<Result<IntegralRequest, String>>,
}

impl CircleIntegral {
    /// Asks for the factors on a circle of a step; of another curve there are none.
    pub fn ask(
        &mut self,
        along: Option<ProfileCurve>,
        dataset: &Arc<Dataset>,
        step: usize,
        wake: &egui::Context,
    ) {
        self.asked = along.and_then(|along| asked(along, dataset, step));
        if let Some(Ok(asked)) = &self.asked {
            let theirs = asked.clone();
            self.question.ask(asked, true, wake, move |watcher| theirs.find(watcher));
        }
    }

    /// The factors of the circle that is shown, or the reason why there are none; `None` while
    /// it is on its way.
    pub fn newest_factors(&mut self) -> Option<Result<Arc<TipIntensity>, String>> {
        let asked = match self.asked.as_ref()? {
            Err(reason) => return Some(Err(reason.clone())),
            Ok(asked) => asked.clone(),
        };
        let (key, answer) = self.question.newest()?;
        (*key == asked).then(|| answer.as_ref().clone().map(Arc::new))
    }

    /// The factors of the circle in words, and as rows of a table: what, on the circle, and as
    /// stored, if they are. They belong to the dataset and the step of the request, also if another
    /// one is shown since. The reason alone if there are none.
    pub(crate) fn table(&mut self) -> (String, Vec<[String; 3]>) {
        let found = self.newest_factors();
        match (found, &self.asked) {
            (Some(Ok(factors)), Some(Ok(asked))) => {
                let rows = rows(&asked.dataset, asked.step, &factors);
                (text(&rows), rows)
            }
            (Some(Err(reason)), _) => (reason, Vec::new()),
            _ => ("K …".into(), Vec::new()),
        }
    }

    /// True while it is on its way.
    #[must_use]
    pub fn is_working(&self) -> bool {
        self.question.is_working()
    }

    /// True if the curve that is shown is a circle.
    pub(crate) fn is_asked(&self) -> bool {
        self.asked.is_some()
    }
}

impl IntegralRequest {
    fn find(&self, watcher: &dyn Watcher) -> Option<Result<TipIntensity, String>> {
        // without the loads near the tip the factors would be others
        let Ok(problem) = Problem::of_step(&self.dataset, self.step) else {
            return Some(Err(UNKNOWN.into()));
        };
        match on_circle(&self.dataset, self.step, self.tip, self.radius, problem.as_ref(), watcher)
        {
            Err(CircleError::Cancelled(_)) => None,
            Err(error) => Some(Err(error.to_string())),
            Ok(factors) => Some(Ok(factors)),
        }
    }
}

const UNKNOWN: &str =
    "the stored problem cannot be read, so the loads near the tip are not known; solve it again";

/// Returns the request for a curve; `None` unless it is a circle, the reason as an error if the
/// circle is not around a tip.
fn asked(
    along: ProfileCurve,
    dataset: &Arc<Dataset>,
    step: usize,
) -> Option<Result<IntegralRequest, String>> {
    dataset.equation.elastic()?;
    let cracks = &dataset.steps.get(step)?.cracks;
    match along {
        ProfileCurve::Around { tip: number, radius } => {
            let Some(tip) = tips(cracks).nth(number) else {
                return Some(Err(format!("the step has no tip {number}")));
            };
            let usual = 0.01 * cracks[tip.crack as usize].length();
            let radius = radius.unwrap_or(usual);
            Some(Ok(IntegralRequest { dataset: dataset.into(), step, tip, radius }))
        }
        ProfileCurve::Circle { center, radius } => {
            let from = |tip: TipId| cracks[tip.crack as usize].end_point(tip.end);
            let is_inside = |tip: &TipId| (from(*tip) - Vec2::from(center)).length() < radius;
            let inside: Vec<_> = tips(cracks).enumerate().filter(|(_, t)| is_inside(t)).collect();
            Some(Err(match inside[..] {
                [] => "the circle holds no tip, so there is no K on it".into(),
                [(number, _)] => format!(
                    "K is found on circles around a tip: drag the circle's centre to tip {number}"
                ),
                _ => format!("the circle holds {} tips; K belongs to one", inside.len()),
            }))
        }
        _ => None,
    }
}

/// The radius of the circle around a tip on which the solver finds factors, if nothing disturbs the
/// tip's field there.
pub(crate) fn usual_radius(dataset: &Dataset, step: usize, tip: TipId) -> Option<f64> {
    let clear = clearance(dataset, step, tip)?.radius;
    (clear > 0.0).then_some(PREFERRED * clear)
}

/// Part of a tip's clearance that the solver's preferred ring has.
const PREFERRED: f64 = 0.9;

/// Rows of the factors on the circle, and of those that the solver stored for the tip, with their
/// estimated error. The field of the circle has that error too.
fn rows(dataset: &Dataset, index: usize, factors: &TipIntensity) -> Vec<[String; 3]> {
    let words = |factors: &TipIntensity| {
        Tip::new(dataset, index, factors).words().map(|word| word.replace('-', "−"))
    };
    let stored = dataset.steps.get(index).into_iter().flat_map(|step| &step.intensities);
    let stored = stored.filter(|known| known.tip == factors.tip).map(words).next();
    let (own, mut rows) = (words(factors), Vec::new());
    for (k, head) in HEADS.iter().enumerate().take(6) {
        let stored = stored.as_ref().map_or(String::new(), |stored| stored[k].clone());
        if own[k] != "–" || !matches!(&*stored, "" | "–") {
            rows.push([(*head).to_owned(), own[k].clone(), stored]);
        }
    }
    rows
}

/// `K_I = 1.23, K_II = 0, …`, and below it the stored factors.
fn text(rows: &[[String; 3]]) -> String {
    let line = |column: usize| {
        let known = rows.iter().filter(|row| !matches!(&*row[column], "" | "–"));
        known.map(|row| format!("{} = {}", row[0], row[column])).collect::<Vec<_>>().join(", ")
    };
    match line(2) {
        stored if stored.is_empty() => line(1),
        stored => format!("{}\nstored: {stored}", line(1)),
    }
}
