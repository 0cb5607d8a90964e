//! Rules for the values of a problem, whether it was read from a file or built in code.

use std::collections::BTreeMap;

use ppum::cover::OVERLAP;
use ppum::crack::{Crack, CrackEnd, Side};
use ppum::dataset::{Equation, MAX_DEGREE};
use ppum::domain::Domain;
use ppum::vec2::Rect;

use super::cracks::{check_cracks, points_of, touch};
use super::enrichment::check_enrichments;
use super::growth::check_growth;
use super::holes::check_holes;
use super::key::Key;
use super::quantities::check_quantities;
use super::refinement::check_refinements;
use super::scopes;
use super::{
    Adaptivity, BorderPart, BoundaryCondition, Cells, Discretization, Edge, Enrichment,
    LocalEnrichment, MOST_TERMS, Order, Problem, Solver,
};
use crate::geometry::Jumps;

/// Highest level of a uniform cover: 4^10 ≈ 10⁶ cells, beyond what a direct solver holds.
pub(super) const MAX_LEVEL: u32 = 10;

/// Most cells of a base cover.
const MAX_CELLS: u64 = 1 << (2 * MAX_LEVEL);

/// Places along each axis at which a formula of the order is tried before anything is computed.
const ORDER_SAMPLES: u32 = 16;

/// A rule that is broken.
pub(super) struct MistakeAt {
    pub(super) key: Key,
    pub(super) message: String,
    /// The other of two values that contradict each other.
    pub(super) other: Option<Key>,
}

impl MistakeAt {
    pub(super) fn new(key: Key, message: impl Into<String>) -> Self {
        Self { key, message: message.into(), other: None }
    }

    pub(super) fn with_other(self, other: Key) -> Self {
        Self { other: Some(other), ..self }
    }
}

/// All rules broken by a problem. The later ones are judged only in a domain that is one.
pub(super) fn mistakes(problem: &Problem) -> Vec<MistakeAt> {
    let mut found = check_equation(&problem.equation, &problem.domain);
    found.extend(check_components(problem));
    found.extend(check_discretization(problem));
    found.extend(problem.adaptivity.iter().flat_map(check_adaptivity));
    found.extend(check_goal(problem));
    found.extend(check_growth(problem));
    found.extend(check_solver(&problem.solver));
    found.extend(check_tables(problem));
    found.extend(check_quantities(problem));
    let bounds = &problem.domain.bounds;
    let domain = check_domain(&problem.domain);
    if domain.is_empty() {
        found.extend(check_points(&problem.discretization.cells, bounds));
        found.extend(check_order(&problem.discretization.order, bounds));
        found.extend(check_cracks(&problem.cracks, &problem.domain));
        found.extend(check_refinements(problem));
        found.extend(check_additive(problem));
        found.extend(check_zone(problem));
        found.extend(check_enrichments(problem));
        found.extend(check_boundary(problem));
    }
    found.extend(domain);
    found
}

/// The least tolerance of iteration: rounding leaves about a thousandth of it.
const LEAST_TOLERANCE: f64 = 1e-14;

/// Iteration comes to tolerances between rounding and all of the solution.
fn check_solver(solver: &Solver) -> Option<MistakeAt> {
    let tolerance = solver.tolerance;
    let message = format!(
        "`tolerance` is {tolerance}, but must be at least {LEAST_TOLERANCE} and below 1, a part of the solution"
    );
    let key = Key::new("solver").name("tolerance");
    let fits = (LEAST_TOLERANCE..1.0).contains(&tolerance);
    (!fits).then(|| MistakeAt::new(key, message))
}

/// Functions of tips alone let no crack jump that meets another one, or that comes back to itself.
fn check_additive(problem: &Problem) -> Option<MistakeAt> {
    let Problem { cracks, domain, discretization, .. } = problem;
    if discretization.enrichment != Enrichment::AdditiveOnly {
        return None;
    }
    let jumps = Jumps::new(cracks, domain, touch(&domain.bounds));
    let message = "the crack meets another one or comes back to itself, which `enrichment = \"additive-only\"` \
                   cannot show; take another enrichment, or move the cracks apart";
    jumps.first_meeting().map(|crack| MistakeAt::new(points_of(crack as usize), message))
}

/// No zone of the built-in functions of tips may reach too far.
fn check_zone(problem: &Problem) -> Option<MistakeAt> {
    let radius = problem.discretization.enrichment_radius?;
    let message = too_wide(problem, radius)?;
    let key = Key::new("discretization").name("enrichment_radius");
    Some(MistakeAt::new(key, format!("`enrichment_radius` {message}")))
}

/// The mistake of the radius of a zone around all tips, if it is too large: the functions of a tip
/// jump on the whole straight extension of its segment, also beyond the other end of the crack.
pub(super) fn too_wide(problem: &Problem, radius: f64) -> Option<String> {
    // from the border on there is nothing to jump
    let goes_on = |crack: &&Crack| {
        crack.ends.contains(&CrackEnd::Tip) && !crack.ends.contains(&CrackEnd::Mouth)
    };
    let apart = problem
        .cracks
        .iter()
        .filter(goes_on)
        .filter_map(|c| Some((*c.points.last()? - *c.points.first()?).length()));
    let nearest = apart.fold(f64::INFINITY, f64::min);
    (radius >= nearest).then(|| {
        format!(
            "is {radius}, but the ends of a crack are only {nearest} apart; give less than half of \
             that"
        )
    })
}

/// Sizes of a domain whose squares and their sums neither underflow nor overflow in the solver.
const SIZES: std::ops::RangeInclusive<f64> = 1e-30..=1e30;

fn check_domain(domain: &Domain) -> Vec<MistakeAt> {
    let size = domain.bounds.size();
    let axes = [("x", size.x), ("y", size.y)];
    let wrong = axes.into_iter().filter(|(_, size)| !SIZES.contains(size));
    let message = |(axis, size): (&str, f64)| {
        let message = if size > 0.0 {
            format!(
                "the domain is {size:e} long in {axis}, but lengths must lie between {:e} and {:e}; \
                 choose another unit of length",
                SIZES.start(),
                SIZES.end()
            )
        } else {
            format!("`max` must exceed `min` in {axis}; give two opposite corners of a box")
        };
        MistakeAt::new(Key::new("domain").name("max"), message)
    };
    let box_is_wrong: Vec<_> = wrong.map(message).collect();
    if box_is_wrong.is_empty() { check_holes(domain) } else { box_is_wrong }
}

/// Names that all formulas may use; files cannot break this, code can.
fn check_tables(problem: &Problem) -> Option<MistakeAt> {
    let broken =
        |count: &usize| scopes::check(&problem.tables[..*count], &problem.equation).is_err();
    let count = (1..=problem.tables.len()).find(broken)?;
    let error = scopes::check(&problem.tables[..count], &problem.equation).err()?;
    Some(MistakeAt::new(Key::new("table").index(count - 1).name("name"), error.to_string()))
}

fn check_equation(equation: &Equation, domain: &Domain) -> Vec<MistakeAt> {
    let mistake = equation.mistake(domain).map(|(name, message)| {
        MistakeAt::new(Key::new("material").name(name), format!("`{name}` {message}"))
    });
    mistake.into_iter().collect()
}

/// One value per component everywhere; files cannot break this, code can.
fn check_components(problem: &Problem) -> Vec<MistakeAt> {
    let expected = problem.components();
    let boundary = (0..)
        .zip(&problem.boundary)
        .map(|(index, condition)| (Key::new("boundary").index(index), condition.components.len()));
    let exact = (!problem.exact.is_empty()).then_some((Key::new("exact"), problem.exact.len()));
    let lists = boundary.chain(exact).chain([(Key::new("source"), problem.source.len())]);
    let wrong = lists.filter(|(_, given)| *given != expected);
    wrong
        .map(|(key, given)| {
            MistakeAt::new(
                key,
                format!("there are {given} components, but the field has {expected}"),
            )
        })
        .collect()
}

fn check_discretization(problem: &Problem) -> Vec<MistakeAt> {
    let discretization = &problem.discretization;
    let Discretization { overlap, enrichment, enrichment_radius, tip_degree, tip_terms, .. } =
        *discretization;
    let mut found: Vec<_> = check_cells(&discretization.cells).into_iter().collect();
    let mut rule = |holds: bool, name, message: String| {
        if !holds {
            found.push(MistakeAt::new(Key::new("discretization").name(name), message));
        }
    };
    rule(
        OVERLAP.contains(&overlap),
        "overlap",
        format!(
            "`overlap` is {overlap}, but must be {} to {}; 1.3 to 1.5 is the useful range",
            OVERLAP.start(),
            OVERLAP.end()
        ),
    );
    rule(
        tip_degree <= MAX_DEGREE,
        "tip_degree",
        format!("`tip_degree` is {tip_degree}, but must be 0 to {MAX_DEGREE}; 1 is the default"),
    );
    if let Some(terms) = tip_terms {
        rule(
            (1..=MOST_TERMS).contains(&terms),
            "tip_terms",
            format!("`tip_terms` is {terms}, but must be 1 to {MOST_TERMS}"),
        );
        rule(
            enrichment == Enrichment::Williams,
            "tip_terms",
            format!(
                "`tip_terms` has no meaning with enrichment = \"{}\"; remove it, or write \
                 enrichment = \"williams\"",
                enrichment.name()
            ),
        );
    }
    if let Some(radius) = enrichment_radius {
        rule(
            radius > 0.0 && radius.is_finite(),
            "enrichment_radius",
            format!("`enrichment_radius` is {radius}, but must be positive and finite"),
        );
        rule(
            enrichment.has_zones()
                || problem.enrichments.iter().any(LocalEnrichment::has_default_zone),
            "enrichment_radius",
            format!(
                "`enrichment_radius` has no meaning with enrichment = \"{}\"; remove it, or write \
                 enrichment = \"williams\"",
                enrichment.name()
            ),
        );
    }
    found
}

/// Most steps of an adaptation: each at least adds a cell to the one before, and most half as
/// many again.
const MAX_STEPS: usize = 100;

/// Accuracies that one may ask for: double precision ends below.
const ACCURACY: std::ops::RangeInclusive<f64> = 1e-9..=0.5;

fn check_adaptivity(set: &Adaptivity) -> Vec<MistakeAt> {
    let Adaptivity { steps, fraction, max_unknowns, tolerance, accuracy, .. } = *set;
    let of_accuracy = accuracy.filter(|accuracy| !ACCURACY.contains(accuracy)).map(|value| {
        let key = Key::new("discretization").name("accuracy");
        MistakeAt::new(key, format!("`accuracy` is {value:?}, but must be 1e-9 to 0.5"))
    });
    let tolerance = tolerance.filter(|tolerance| !(*tolerance > 0.0 && *tolerance < 1.0));
    let message = |value: f64| {
        format!("`tolerance` is {value}, but must be above 0 and below 1, a part of the solution")
    };
    let rules = [
        ((1..=MAX_STEPS).contains(&steps), "steps", {
            format!("`steps` is {steps}, but must be 1 to {MAX_STEPS}; 10 is the default")
        }),
        (fraction > 0.0 && fraction <= 1.0, "fraction", {
            format!(
                "`fraction` is {fraction}, but must be above 0 and at most 1; 0.6 is the default"
            )
        }),
        (max_unknowns > 0, "max_unknowns", "`max_unknowns` must be at least 1".to_owned()),
        (tolerance.is_none(), "tolerance", tolerance.map_or(String::new(), message)),
    ];
    let broken = rules.into_iter().filter(|(holds, ..)| !holds);
    broken
        .map(|(_, name, message)| MistakeAt::new(Key::new("adaptivity").name(name), message))
        .chain(of_accuracy)
        .collect()
}

/// Cells as small as there may be do not stand for functions of cracks.
fn check_goal(problem: &Problem) -> Option<MistakeAt> {
    problem.adaptivity.as_ref()?.accuracy?;
    let name = match problem.discretization.enrichment {
        Enrichment::None => "none",
        Enrichment::AdditiveOnly => "additive-only",
        _ => return None,
    };
    let message = format!(
        "no accuracy can be had with `enrichment = \"{name}\"`, which leaves out how fields jump across cracks; \
         leave `enrichment` or `accuracy` out"
    );
    let key = Key::new("discretization").name("accuracy");
    (!problem.cracks.is_empty()).then(|| MistakeAt::new(key, message))
}

fn check_cells(cells: &Cells) -> Option<MistakeAt> {
    let key = Key::new("discretization");
    match *cells {
        Cells::Level(level) if level > MAX_LEVEL => {
            let message = format!("`level` is {level}, but must be 0 to {MAX_LEVEL}");
            Some(MistakeAt::new(key.name("level"), message))
        }
        Cells::Grid([nx, ny]) if nx == 0 || ny == 0 => {
            let message = "`cells` must be at least 1 in each direction";
            Some(MistakeAt::new(key.name("cells"), message))
        }
        Cells::Grid([nx, ny]) if u64::from(nx) * u64::from(ny) > MAX_CELLS => {
            let message = format!("`cells` are {nx} × {ny}, but at most {MAX_CELLS} in all");
            Some(MistakeAt::new(key.name("cells"), message))
        }
        _ => None,
    }
}

fn check_points(cells: &Cells, domain: &Rect) -> Option<MistakeAt> {
    let Cells::Points(points) = cells else { return None };
    let key = Key::new("discretization").name("points");
    if points.is_empty() {
        return Some(MistakeAt::new(key, "there are no points; at least one is needed"));
    }
    let outside: Vec<_> = points.iter().filter(|p| !domain.contains(**p)).collect();
    let first = outside.first()?;
    let message = format!(
        "{} of {} points lie outside the domain, the first at [{}, {}]; remove or move them",
        outside.len(),
        points.len(),
        first.x,
        first.y
    );
    Some(MistakeAt::new(key, message))
}

fn check_order(order: &Order, domain: &Rect) -> Option<MistakeAt> {
    let key = Key::new("discretization").name("order");
    let steps = f64::from(ORDER_SAMPLES);
    let samples = (0..ORDER_SAMPLES * ORDER_SAMPLES).map(|k| {
        let [i, j] = [k % ORDER_SAMPLES, k / ORDER_SAMPLES].map(|i| (f64::from(i) + 0.5) / steps);
        let size = domain.size();
        domain.min + ppum::vec2::vec2(size.x * i, size.y * j)
    });
    let mut wrong = samples.filter_map(|p| order.at(p).err());
    wrong.next().map(|error| MistakeAt::new(key, error.to_string()))
}

fn check_boundary(problem: &Problem) -> Vec<MistakeAt> {
    let parts = problem.boundary.iter().enumerate();
    let mut found: Vec<_> = parts.filter_map(|(k, part)| check_part(k, part, problem)).collect();
    found.extend(check_contradictions(&problem.boundary));
    found
}

/// A component of which a condition says something, on a stretch of a part of the border.
struct Claim {
    /// Kind and number of the part, face, component.
    place: (u8, usize, u8, usize),
    stretch: [f64; 2],
    condition: usize,
}

fn claims(index: usize, condition: &BoundaryCondition) -> Vec<Claim> {
    let [both, above, below] = [vec![0, 1], vec![0], vec![1]];
    let (kind, number, faces, stretch) = match condition.on {
        BorderPart::Edge { edge, from, to } => (0, edge as usize, above, [from, to]),
        BorderPart::Hole(hole) => (1, hole, above, [0.0, 1.0]),
        BorderPart::Crack { crack, face } => {
            let faces = face.map_or(both, |side| if side == Side::Above { above } else { below });
            (2, crack, faces, [0.0, 1.0])
        }
    };
    let components = (0..condition.components.len()).filter(|&k| condition.says(k));
    let claim = |(component, face)| Claim {
        place: (kind, number, face, component),
        stretch,
        condition: index,
    };
    components.flat_map(|k| faces.iter().map(move |&face| (k, face))).map(claim).collect()
}

/// No component is given twice at a place. Of the conditions that an earlier one contradicts each
/// is told once.
fn check_contradictions(boundary: &[BoundaryCondition]) -> Vec<MistakeAt> {
    let mut all: Vec<_> =
        boundary.iter().enumerate().flat_map(|(k, part)| claims(k, part)).collect();
    all.sort_by(|a, b| a.place.cmp(&b.place).then(a.stretch[0].total_cmp(&b.stretch[0])));
    let mut pairs = BTreeMap::new();
    let mut claims = all.iter();
    let Some(mut farthest) = claims.next() else { return Vec::new() };
    for claim in claims {
        let meets = claim.place == farthest.place && claim.stretch[0] < farthest.stretch[1];
        if meets && claim.condition != farthest.condition {
            let (a, b) = (claim.condition, farthest.condition);
            pairs.entry(a.max(b)).or_insert(a.min(b));
        }
        if !meets || claim.stretch[1] > farthest.stretch[1] {
            farthest = claim;
        }
    }
    let mistake = |(later, earlier): (usize, usize)| {
        let message = contradiction(&boundary[earlier], &boundary[later])?;
        Some(MistakeAt::new(on(later), message).with_other(on(earlier)))
    };
    pairs.into_iter().filter_map(mistake).collect()
}

fn on(index: usize) -> Key {
    Key::new("boundary").index(index).name("on")
}

fn check_part(index: usize, condition: &BoundaryCondition, problem: &Problem) -> Option<MistakeAt> {
    let (holes, cracks) = (problem.domain.holes.len(), problem.cracks.len());
    let message = match condition.on {
        BorderPart::Edge { edge, from, to } => bad_range(edge, [from, to], &problem.domain.bounds)?,
        BorderPart::Hole(hole) if hole >= holes => {
            format!("there is no hole {hole}; {}", numbered(holes, "[[hole]]"))
        }
        BorderPart::Crack { crack, .. } if crack >= cracks => {
            format!("there is no crack {crack}; {}", numbered(cracks, "[[crack]]"))
        }
        BorderPart::Crack { .. } if condition.held().contains(&true) => {
            "the faces of a crack cannot be held; give them a traction or a pressure".to_owned()
        }
        _ => return None,
    };
    Some(MistakeAt::new(on(index), message))
}

/// A number of things in words.
pub(super) fn numbered(count: usize, table: &str) -> String {
    match count {
        0 => format!("the problem has no {table}"),
        1 => format!("the only {table} has the number 0"),
        n => format!("the {table} are numbered from 0 to {}", n - 1),
    }
}

fn bad_range(edge: Edge, [from, to]: [f64; 2], domain: &Rect) -> Option<String> {
    let [first, last] = edge.range(domain);
    if from >= to {
        return Some(format!("`from` is {from} and `to` is {to}, but `to` must exceed `from`"));
    }
    let edge = edge.name();
    (from < first || to > last).then(|| {
        format!(
            "from {from} to {to} leaves the {edge} edge, which runs from {first} to {last}; stay inside"
        )
    })
}

/// Two conditions that speak of the same component at the same place.
fn contradiction(a: &BoundaryCondition, b: &BoundaryCondition) -> Option<String> {
    let place = a.on.common(&b.on)?;
    let count = a.components.len().min(b.components.len());
    let component = (0..count).find(|&k| a.says(k) && b.says(k))?;
    let what = match count {
        1 => "the value or flux".to_owned(),
        _ => format!("the {} component", ["x", "y"][component]),
    };
    let remedy = match place {
        BorderPart::Edge { .. } => "divide the edge by `from` and `to`, or leave",
        _ => "leave",
    };
    Some(format!(
        "{what} on {place} is given twice; give each component once at each place: {remedy} a \
         component \"free\""
    ))
}
