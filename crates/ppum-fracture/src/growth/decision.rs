//! Decides the next increments of the tips of a solved step: who grows, how far, and where to.

use super::criterion::Drive;
use super::life::{Life, LifeError, LifeStep, growth_ratio};
use super::path::go;
use crate::solve::SolveError;
use ppum::crack::{Crack, End, TipId, tips};
use ppum::dataset::{Growth, GrowthStop, TipIncrement, TipIntensity, TipStatus};
use ppum::edge::Edge;
use ppum::text::{short, trimmed};
use ppum::vec2::Vec2;
use ppum_problem::geometry::from_tip;
use ppum_problem::{GrowthLaw, GrowthRule, LoadControl, Problem, TipState};
use ppum_solve::terms::face_law;
use std::collections::BTreeMap;

/// Loads at which tips reach their toughness that count as one, relative: those of a symmetric
/// body differ by the errors of their factors.
const TOGETHER: f64 = 1e-2;

/// Turn in radians from which on a change of direction is a kink, and not a part of a smooth path.
pub(super) const SHARP: f64 = 0.1;

/// Largest turn of an arc: paths that turn faster are not resolved by their increments.
const LARGEST_TURN: f64 = 0.35;

/// Turn of a chosen increment.
const CHOSEN_TURN: f64 = 0.1;

/// A chosen increment in parts of the length of the shortest crack with a tip, and of the body's
/// shorter side; and how much less it is where a path turns.
const CHOSEN: f64 = 0.25;
const OF_PLATE: f64 = 0.02;
const LEAST_CHOSEN: f64 = 0.125;

/// Halvings of a chosen first increment, down to the least.
const HALVINGS: usize = 3;

/// Distance of the polyline to its arc, in lengths of the arc, in which T is known to act on faces:
/// its pieces turn by half a degree.
const FLAT: f64 = 1e-4;

/// Part of a length that is rounding.
const ROUNDING: f64 = 1e-9;

/// Part of an increment from which on growth that is due is made.
const DUE: f64 = 0.5;

/// A tip with what drives it.
struct DrivenTip<'a> {
    tip: TipId,
    at: Vec2,
    /// The angle of the crack's direction to the x axis.
    axis: f64,
    /// The crack from its tip on, as far as T is known to act on its faces.
    path: Vec<Vec2>,
    drive: Option<Drive>,
    fate: TipStatus,
    /// None if none is given: it grows however small K is.
    toughness: Option<f64>,
    /// The increment of the previous step.
    before: Option<&'a TipIncrement>,
    /// Growth in parts of that of the tip that grows most.
    share: f64,
}

/// Numbers of a rule that nothing can be decided with.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum GrowthDataError {
    /// A toughness that is none.
    #[error(
        "`toughness` is {toughness} at the tip ({x}, {y}), but must be positive and finite there: mend its formula",
        toughness = short(*toughness), x = trimmed(at.x), y = trimmed(at.y)
    )]
    Toughness {
        /// The tip.
        at: Vec2,
        /// Its value.
        toughness: f64,
    },
    /// A load that is too far from the one that was given.
    #[error(
        "K reaches the toughness at {} times the loads, which is too far away to compute with: look at their \
         units, and at that of `toughness`",
        short(*.0)
    )]
    Load(f64),
    /// Cycles without number.
    #[error(
        "the last increment took {} cycles: look at the units of the law of growth, whose rate is the length a cycle, \
         as c ΔK^m is with the `c` of `paris`",
        short(*.0)
    )]
    Cycles(f64),
    /// A law of growth that gives no life.
    #[error(transparent)]
    Life(#[from] LifeError),
}

/// Largest factor of a load, and one over the smallest: squares of it are far from the ends of f64.
const FARTHEST: f64 = 1e60;

/// Decides what the tips do, from their factors under the loads of the problem and from what was
/// decided in the step before; with it the factor of the loads.
///
/// # Errors
/// A toughness, a load or a number of cycles that is none.
pub(super) fn decide(
    problem: &Problem,
    rule: &GrowthRule,
    factors: &[TipIntensity],
    before: Option<&Growth>,
    life: &mut Life,
) -> Result<(Growth, f64), GrowthDataError> {
    let mut driven: Vec<_> = tips(problem.cracks())
        .map(|tip| DrivenTip::new(problem, rule, tip, factors, before))
        .collect();
    driven.iter().filter(|tip| tip.fate == TipStatus::Grows).try_for_each(DrivenTip::check)?;
    let load = load(rule, &driven)?;
    let mut growth = Growth::default();
    growth.cycles = add_to_life(life, problem, rule, factors, &driven, before)?;
    share(rule, &mut driven, load, life)?;
    let increment = increment(problem, rule, &driven);
    share_cycles(rule, &mut driven, increment, life);
    let mut so_far = problem.cracks().to_vec();
    for tip in &driven {
        let made = tip.before.map_or(0.0, |row| row.extension + row.length);
        let due = rule.law.as_ref().map_or(0.0, |_| life.growth(tip.tip) - made);
        let row = tip.advance(problem, &so_far, increment, due);
        extend(&mut so_far[tip.tip.crack as usize], &row);
        growth.tips.push(row);
    }
    growth.stop = stop(rule, &driven, &growth);
    Ok((growth, load))
}

/// The problem with the cracks that follow from what was decided.
///
/// # Errors
/// The rules that these cracks break.
pub(super) fn grow_cracks(problem: &Problem, growth: &Growth) -> Result<Problem, SolveError> {
    let mut cracks = problem.cracks().to_vec();
    growth.tips.iter().for_each(|row| extend(&mut cracks[row.tip.crack as usize], row));
    problem.grown(cracks).map_err(SolveError::Problem)
}

/// Adds the way of a tip to its crack.
fn extend(crack: &mut Crack, row: &TipIncrement) {
    let (own, new) = (crack.edges(), row.edges(crack.end_point(row.tip.end)));
    let edges: Vec<Edge> = match row.tip.end {
        End::Last => own.chain(new).collect(),
        End::Start => new.iter().rev().map(Edge::reversed).chain(own).collect(),
    };
    *crack = Crack { ends: crack.ends, ..Crack::along(&edges) };
}

/// The factors of a crack whose faces may touch, which has no negative K_I; none if nothing but
/// their error is left, as where the faces stick. Where they are closed T does not act on free
/// faces: under pressure from all sides it turns nothing.
fn closed_factors(factors: &TipIntensity) -> Option<TipIntensity> {
    let error = factors.error.unwrap_or(0.0);
    let t_stress = factors.t_stress.filter(|_| factors.k1 > error);
    let open = TipIntensity { k1: factors.k1.max(0.0), t_stress, ..factors.clone() };
    (open.k1.hypot(open.k2) > error).then_some(open)
}

impl<'a> DrivenTip<'a> {
    fn new(
        problem: &Problem,
        rule: &GrowthRule,
        tip: TipId,
        factors: &[TipIntensity],
        before: Option<&'a Growth>,
    ) -> Self {
        let crack = &problem.cracks()[tip.crack as usize];
        let (at, along) = (crack.end_point(tip.end), crack.growth_direction(tip.end));
        let factors = factors.iter().find(|found| found.tip == tip);
        let axis = along.y.atan2(along.x);
        let law = problem.equation.anisotropy().map(|law| law.at_tip(at, along));
        let strength = |angle: f64| rule.toughness_at(at, axis + angle).unwrap_or(1.0);
        let new = |factors: &TipIntensity| match law.is_some() || rule.is_directed() {
            true => Drive::by_direction(factors, law.as_ref(), strength),
            false => Drive::new(rule.criterion, factors),
        };
        let drive = factors.and_then(|factors| match face_law(problem, tip.crack) {
            Some(_) => new(&closed_factors(factors)?),
            None => new(factors),
        });
        let fate = match (factors, drive) {
            (None, _) => TipStatus::Unknown,
            (_, None) => TipStatus::Closed,
            _ => TipStatus::Grows,
        };
        let angle = drive.map_or(0.0, |drive| drive.kink.angle);
        let toughness = rule.toughness_at(at, axis + angle);
        let before = before.and_then(|growth| growth.tips.iter().find(|row| row.tip == tip));
        let path = match tip.end {
            // what is closed has no free faces, which T would act on
            _ if face_law(problem, tip.crack).is_some() => Vec::new(),
            end => polyline_from(crack, end),
        };
        Self { tip, at, axis, path, drive, fate, toughness, before, share: 0.0 }
    }

    /// Asks whether the toughness at the tip is one, if there is any.
    fn check(&self) -> Result<(), GrowthDataError> {
        let bad = self.toughness.filter(|k| !(*k > 0.0 && k.is_finite()));
        bad.map_or(Ok(()), |toughness| Err(GrowthDataError::Toughness { at: self.at, toughness }))
    }

    fn k_eq(&self) -> f64 {
        self.drive.map_or(f64::NAN, |drive| drive.kink.k_eq)
    }

    /// The turn that the criterion asks for without looking ahead.
    fn angle(&self) -> f64 {
        self.drive.map_or(0.0, |drive| drive.kink.angle)
    }

    /// Returns the increment of the previous step, if the tip grew in it.
    fn last(&self) -> Option<&'a TipIncrement> {
        self.before.filter(|row| row.length > 0.0)
    }

    /// Direction and curvature of the next increment.
    fn heading(&self, length: f64) -> (f64, f64) {
        let Some(drive) = &self.drive else { return (self.axis, 0.0) };
        if drive.is_straight {
            return (turn_between(0.0, self.axis + drive.kink.angle), 0.0);
        }
        let is_first = self.before.is_none_or(|row| row.extension + row.length == 0.0);
        let turn = if is_first {
            drive.first_turn(&self.path, length, LARGEST_TURN)
        } else {
            drive.next_turn(&self.path, length)
        };
        let direction = turn_between(0.0, self.axis + turn.at_start);
        let curvature = turn.along / length + self.drift(drive, direction);
        let bound = LARGEST_TURN / length;
        (direction, curvature.clamp(-bound, bound))
    }

    /// The curvature of the path beside what T explains: half of it how the direction has changed
    /// along the last increment, half what it was taken for there. The change alone would answer
    /// errors of the last direction with larger ones of the next, and paths would swing. Behind a
    /// kink nothing is known of it yet.
    fn drift(&self, drive: &Drive, direction: f64) -> f64 {
        let is_smooth = self.angle().abs() < SHARP;
        self.last().filter(|_| is_smooth).map_or(0.0, |row| {
            let found = turn_between(row.direction, direction) / row.length;
            let explained = if row.extension == 0.0 && drive.turns_back() {
                row.curvature
            } else {
                drive.bend(&path_behind(&self.path, row.length), row.length, 0.0) / row.length
            };
            0.5 * (found + row.curvature) - explained
        })
    }

    /// How much the path turns in an increment beyond its first kink.
    fn turn(&self, length: f64) -> f64 {
        let at_start = self.last().map_or(0.0, |_| self.angle().abs());
        at_start + length * self.heading(length).1.abs()
    }

    /// Returns the increment of the tip when the tip that grows most advances by `increment`, with
    /// the growth that is due before; less than nothing if more was made than the law says.
    fn advance(
        &self,
        problem: &Problem,
        cracks: &[Crack],
        increment: f64,
        due: f64,
    ) -> TipIncrement {
        let due = if due.abs() < ROUNDING * increment { 0.0 } else { due };
        let mut row = TipIncrement {
            k_eq: self.k_eq(),
            direction: self.axis,
            due: due.max(0.0),
            extension: self.before.map_or(0.0, |row| row.extension + row.length),
            ..TipIncrement::staying(self.tip, self.fate)
        };
        if self.fate != TipStatus::Grows {
            return row;
        }
        if is_joined(problem, cracks, self.tip) {
            row.fate = TipStatus::Joined;
            return row;
        }
        row.due = (due + self.share * increment).max(0.0);
        if row.due < DUE * increment {
            row.fate = TipStatus::Waits;
            return row;
        }
        (row.direction, row.curvature) = self.heading(row.due);
        let length = std::mem::replace(&mut row.due, 0.0);
        go(problem, cracks, length, &mut row);
        row
    }
}

/// The vertices of a polyline along a crack from an end on.
fn polyline_from(crack: &Crack, end: End) -> Vec<Vec2> {
    let pieces = |edge: Edge| edge.flattened(FLAT * edge.length()).into_iter().skip(1);
    std::iter::once(crack.end_point(end)).chain(from_tip(crack, end).flat_map(pieces)).collect()
}

/// A path without its first piece of a given length.
fn path_behind(path: &[Vec2], length: f64) -> Vec<Vec2> {
    let mut left = length;
    for (k, ends) in path.windows(2).enumerate() {
        let piece = ends[1] - ends[0];
        // vertices on straight pieces of a crack are removed
        if left < (1.0 - ROUNDING) * piece.length() {
            let at = ends[0] + piece * (left / piece.length()).max(0.0);
            return std::iter::once(at).chain(path[k + 1..].iter().copied()).collect();
        }
        left -= piece.length();
    }
    Vec::new()
}

/// Returns the growth of a step with other curvatures of some arcs, which are given with their
/// tips.
pub(super) fn with_curvatures(
    problem: &Problem,
    growth: &Growth,
    curvatures: &[(TipId, f64)],
) -> Growth {
    let mut so_far = problem.cracks().to_vec();
    let mut bent = growth.clone();
    for row in &mut bent.tips {
        if let Some((_, curvature)) = curvatures.iter().find(|(tip, _)| *tip == row.tip) {
            let bound = LARGEST_TURN / row.length;
            row.curvature = curvature.clamp(-bound, bound);
            go(problem, &so_far, row.length, row);
        }
        extend(&mut so_far[row.tip.crack as usize], row);
    }
    bent
}

/// True if another crack has come to a tip in this step: both end there then, whichever of them
/// would have gone on.
fn is_joined(problem: &Problem, cracks: &[Crack], tip: TipId) -> bool {
    let at = problem.cracks()[tip.crack as usize].end_point(tip.end);
    let others = (0u32..).zip(cracks).filter(|(k, _)| *k != tip.crack);
    others
        .flat_map(|(_, crack)| [End::Start, End::Last].map(|end| crack.end_point(end)))
        .any(|end| end == at)
}

/// The turn from one direction to another, between −π and π.
fn turn_between(from: f64, to: f64) -> f64 {
    let turn = to - from;
    turn - std::f64::consts::TAU * (turn / std::f64::consts::TAU).round()
}

/// The factor of the load: the least at which a tip reaches its toughness, if that is asked for.
fn load(rule: &GrowthRule, driven: &[DrivenTip<'_>]) -> Result<f64, GrowthDataError> {
    if rule.load == LoadControl::Constant {
        return Ok(1.0);
    }
    let growing = driven.iter().filter(|tip| tip.fate == TipStatus::Grows && tip.k_eq() > 0.0);
    let factors = growing.filter_map(|tip| Some(tip.toughness? / tip.k_eq()));
    match factors.reduce(f64::min) {
        None => Ok(1.0),
        Some(least) if (1.0 / FARTHEST..=FARTHEST).contains(&least) => Ok(least),
        Some(least) => Err(GrowthDataError::Load(least)),
    }
}

/// Finds which tips grow, and how much in parts of what the fastest grows, by their rates now.
fn share(
    rule: &GrowthRule,
    driven: &mut [DrivenTip<'_>],
    load: f64,
    life: &Life,
) -> Result<(), GrowthDataError> {
    let enough = if rule.load == LoadControl::Critical { 1.0 - TOGETHER } else { 1.0 };
    let rates = rule.law.as_ref().map(|law| life.ln_rates(law)).transpose()?;
    let rate = |tip: &DrivenTip<'_>| Some(*rates.as_ref()?.get(&tip.tip)?);
    let most = driven.iter().filter_map(rate).fold(f64::NEG_INFINITY, f64::max);
    for tip in driven.iter_mut().filter(|tip| tip.fate == TipStatus::Grows) {
        let strength = load * tip.k_eq();
        let is_enough = || tip.toughness.is_none_or(|toughness| strength >= enough * toughness);
        let grows = rate(tip).map_or_else(is_enough, |rate| rate > f64::NEG_INFINITY);
        // the parts of rates alone, which may be out of all range
        let part = rate(tip).map_or(1.0, |rate| growth_ratio(rate, most));
        tip.share = if grows { part } else { 0.0 };
        if !grows {
            tip.fate = TipStatus::Held;
        }
    }
    Ok(())
}

/// Corrects the parts by how the tips' rates change in the cycles of the increment.
fn share_cycles(rule: &GrowthRule, driven: &mut [DrivenTip<'_>], increment: f64, life: &Life) {
    let growing = driven.iter().filter(|tip| tip.share > 0.0);
    let first: BTreeMap<_, _> = growing.map(|tip| (tip.tip, tip.share * increment)).collect();
    if first.len() < 2 {
        return;
    }
    // what cannot be told beforehand is told when the increment is made
    let law = rule.law.as_ref();
    let Some(Ok(growth)) = law.map(|law| life.forecast(law, first)) else { return };
    for tip in driven.iter_mut().filter(|tip| tip.share > 0.0 && tip.share < 1.0) {
        let part = growth.get(&tip.tip).map_or(tip.share, |growth| growth / increment);
        tip.share = part.min(1.0);
    }
}

/// The length of the largest increment: the one given, or one that the cracks and the body allow
/// and the paths do not turn much on. It follows the turns of the last one by a factor of at most
/// two, since what a path has turned before acts on it as far as it was long.
fn increment(problem: &Problem, rule: &GrowthRule, driven: &[DrivenTip<'_>]) -> f64 {
    if let Some(increment) = rule.increment {
        return increment;
    }
    let size = problem.domain().bounds.size();
    let with_tips = problem.cracks().iter().filter(|crack| crack.tips().next().is_some());
    let shortest = with_tips.map(Crack::length).fold(f64::INFINITY, f64::min);
    let largest = (CHOSEN * shortest).min(OF_PLATE * size.x.min(size.y));
    let growing = || driven.iter().filter(|tip| tip.share > 0.0);
    let turn = |length: f64| growing().map(|tip| tip.turn(length)).fold(0.0, f64::max);
    let halve = |length, _| if turn(length) > CHOSEN_TURN { 0.5 * length } else { length };
    let last = growing().filter_map(DrivenTip::last).map(|row| row.length).reduce(f64::max);
    let chosen = match last {
        Some(last) => last * (CHOSEN_TURN / turn(last)).clamp(0.5, 2.0),
        None => (0..HALVINGS).fold(largest, halve),
    };
    chosen.max(LEAST_CHOSEN * largest).min(largest)
}

/// Adds this step to the life of the cracks, and returns the cycles up to it.
fn add_to_life(
    life: &mut Life,
    problem: &Problem,
    rule: &GrowthRule,
    factors: &[TipIntensity],
    driven: &[DrivenTip<'_>],
    before: Option<&Growth>,
) -> Result<Option<f64>, GrowthDataError> {
    let Some(law) = &rule.law else { return Ok(None) };
    let strengths = driven.iter().map(|tip| (tip.tip, tip.k_eq()));
    let step = life_step(rule, problem.cracks(), factors, strengths);
    life.add(law, step, before.map(increments).unwrap_or_default())?;
    let cycles = life.cycles();
    let has_grown = before.is_some_and(|growth| growth.tips.iter().any(|row| row.length > 0.0));
    let is_wrong = !cycles.is_finite() || has_grown && cycles == 0.0;
    if is_wrong { Err(GrowthDataError::Cycles(cycles)) } else { Ok(Some(cycles)) }
}

/// The state of a step that a law of growth depends on.
pub(super) fn life_step(
    rule: &GrowthRule,
    cracks: &[Crack],
    factors: &[TipIntensity],
    strengths: impl Iterator<Item = (TipId, f64)>,
) -> LifeStep {
    let state = |(tip, strength): (TipId, f64)| {
        let crack = &cracks[tip.crack as usize];
        let (at, axis) = (crack.end_point(tip.end), crack.growth_direction(tip.end));
        let found = factors.iter().find(|found| found.tip == tip);
        let found = found.map(|k| [k.k1, k.k2, k.t_stress.unwrap_or(f64::NAN)]);
        let toughness = rule.toughness_at(at, axis.y.atan2(axis.x)).unwrap_or(f64::INFINITY);
        let factors = found.unwrap_or([f64::NAN; 3]);
        (tip, TipState { at, strength, factors, extension: 0.0, toughness })
    };
    let lengths = cracks.iter().map(Crack::length).collect();
    LifeStep { lengths, tips: strengths.map(state).collect(), increments: BTreeMap::new() }
}

/// The lengths by which tips grow from a step on.
pub(super) fn increments(growth: &Growth) -> BTreeMap<TipId, f64> {
    growth.tips.iter().map(|row| (row.tip, row.length)).collect()
}

/// Returns the reason why the series ends here.
fn stop(rule: &GrowthRule, driven: &[DrivenTip<'_>], growth: &Growth) -> Option<GrowthStop> {
    let load = rule.law.as_ref().map_or(0.0, GrowthLaw::largest_load);
    let breaks =
        |tip: &DrivenTip<'_>| tip.toughness.is_some_and(|toughness| load * tip.k_eq() >= toughness);
    if driven.is_empty() {
        return Some(GrowthStop::NoTips);
    }
    if driven.iter().any(breaks) {
        return Some(GrowthStop::Fracture);
    }
    let moves = |row: &TipIncrement| row.fate.goes_on() || row.fate == TipStatus::Waits;
    (!growth.tips.iter().any(moves)).then_some(GrowthStop::AllHeld)
}
