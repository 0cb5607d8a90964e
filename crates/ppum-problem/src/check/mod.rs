//! Rules for the values of a problem, whether it was read from a file or built in code.

mod axis;
mod boundary;
mod contact;
mod cracks;
mod enrichment;
pub(super) mod features;
mod holes;
mod quantities;
mod refinement;
mod support;
mod symmetry;

use ppum::anisotropy::STIFFNESS;
use ppum::border::touch;
use ppum::dataset::{EIGENSTRAINS, EXPANSION, Equation};
use ppum::domain::{Domain, Hole};
use ppum::expression::Expression;
use ppum::text::trimmed;
use ppum::vec2::Rect;

use crate::data::{
    BaseCells, Diagnostic, Enrichment, EnrichmentRegion, LoadBlock, MAX_LEVEL, PolynomialOrder,
    ProblemData, ProblemError, ProblemLocation, RefinementRegion, scopes,
};
use crate::file::{Key, KeyError};
use crate::geometry::Jumps;
use axis::check_axis;
use boundary::check_boundary;
use contact::check_contact;
use cracks::check_cracks;
use enrichment::{check_enrichments, too_wide};
use features::check_features;
use holes::check_holes;
use quantities::check_quantities;
use refinement::{check_refinements, samples};
use support::{check_forces, check_supports};
use symmetry::check_symmetry;

/// Most cells of a base cover.
const MAX_CELLS: u64 = 1 << (2 * MAX_LEVEL);

impl ProblemData {
    /// Applies the rules that hold for problem files to a problem built in code.
    ///
    /// # Errors
    /// Everything that is wrong, each named by its key.
    pub fn check(&self) -> Result<(), ProblemError> {
        let errors = errors(self);
        if errors.is_empty() {
            return Ok(());
        }
        let diagnostic = |error: KeyError| {
            let other = error.other.map_or(String::new(), |key| format!(" (see {key})"));
            let location = ProblemLocation::Key(error.key.to_string());
            Diagnostic { location, message: error.message + &other }
        };
        Err(ProblemError::new(errors.into_iter().map(diagnostic).collect()))
    }
}

/// All rules broken by a problem. The later ones are judged only in a domain that is one.
pub(super) fn errors(problem: &ProblemData) -> Vec<KeyError> {
    let mut found: Vec<_> =
        check_equation(&problem.dataset_equation(), problem.domain()).into_iter().collect();
    found.extend(check_components(problem));
    found.extend(numbers(problem).into_iter().filter_map(|(key, value)| key.out_of_range(value)));
    found.extend(check_cells(&problem.discretization.cells));
    found.extend(check_increment(problem));
    found.extend(check_blocks(problem));
    found.extend(check_tables(problem));
    found.extend(check_quantities(problem));
    let bounds = &problem.domain().bounds;
    let domain = check_domain(problem.domain());
    if domain.is_empty() {
        found.extend(check_points(&problem.discretization.cells, bounds));
        found.extend(check_order(&problem.discretization.order, bounds));
        found.extend(check_cracks(problem.cracks(), problem.domain()));
        found.extend(check_features(problem));
        found.extend(check_refinements(problem));
        found.extend(check_additive(problem));
        found.extend(check_zone(problem));
        found.extend(check_enrichments(problem));
        found.extend(check_axis(problem));
        found.extend(check_boundary(problem));
        found.extend(check_symmetry(problem));
        found.extend(check_forces(problem));
        found.extend(check_supports(problem));
        found.extend(check_contact(problem));
    }
    found.extend(domain);
    found
}

/// The numbers that are given, with their keys, whose rows say in which range they must be.
fn numbers(problem: &ProblemData) -> Vec<(Key, f64)> {
    let (set, rule) = (&problem.discretization, problem.growth.as_ref());
    let (steps, law) = (problem.adaptivity.as_ref(), rule.and_then(|rule| rule.law.as_ref()));
    let level = if let BaseCells::Level(level) = set.cells { Some(level.into()) } else { None };
    let toughness = rule.and_then(|rule| rule.toughness.as_ref());
    let single = [
        ("discretization.level", level),
        ("discretization.overlap", Some(set.overlap)),
        ("discretization.tip_degree", Some(set.tip_degree as f64)),
        ("discretization.tip_terms", set.tip_terms.map(|terms| terms as f64)),
        ("discretization.enrichment_radius", set.enrichment_radius),
        ("solver.tolerance", Some(problem.solver.tolerance)),
        ("discretization.accuracy", steps.and_then(|set| set.accuracy)),
        ("adaptivity.steps", steps.map(|set| set.steps as f64)),
        ("adaptivity.fraction", steps.map(|set| set.fraction)),
        ("adaptivity.max_unknowns", steps.map(|set| set.max_unknowns as f64)),
        ("adaptivity.tolerance", steps.and_then(|set| set.tolerance)),
        ("growth.steps", rule.map(|rule| rule.steps as f64)),
        ("growth.increment", rule.and_then(|rule| rule.increment)),
        ("growth.toughness", toughness.and_then(Expression::constant)),
        ("growth.closure.alpha", law.and_then(|law| Some(law.closure?.alpha))),
        ("growth.closure.stress", law.and_then(|law| Some(law.closure?.stress))),
        ("growth.wheeler.yield", law.and_then(|law| Some(law.wheeler?.yield_stress))),
        ("growth.wheeler.exponent", law.and_then(|law| Some(law.wheeler?.exponent))),
        ("growth.wheeler.constraint", law.and_then(|law| Some(law.wheeler?.constraint))),
    ];
    let given = single.into_iter().filter_map(|(path, value)| Some((Key::new(path), value?)));
    let mut all: Vec<_> = given.collect();
    let named = law.into_iter().flat_map(|law| law.parameters());
    all.extend(named.map(|(law, name, value)| (Key::new("growth").name(law).name(name), value)));
    for (index, new) in problem.enrichments.iter().enumerate() {
        let key = Key::new("enrichment").index(index);
        let radius =
            if let EnrichmentRegion::Near(radius) = new.region { Some(radius) } else { None };
        all.extend(radius.map(|radius| (key.clone().name("radius"), radius)));
        all.extend(new.degree.map(|degree| (key.name("degree"), degree as f64)));
    }
    for (index, new) in problem.refinements.iter().enumerate() {
        let key = Key::new("refine").index(index);
        all.push((key.clone().name("distance"), new.distance));
        if let RefinementRegion::Disc { radius, .. } = new.place {
            all.push((key.name("radius"), radius));
        }
    }
    all
}

/// Least increment in units of the length below which things touch.
const LEAST_INCREMENT: f64 = 100.0;

fn check_increment(problem: &ProblemData) -> Option<KeyError> {
    let least = LEAST_INCREMENT * touch(&problem.domain().bounds);
    let increment = problem.growth.as_ref()?.increment.filter(|da| *da > 0.0 && *da < least)?;
    let message = format!(
        "`increment` is {}, but points of a crack in this plate must be {} apart: make it longer",
        trimmed(increment),
        trimmed(least)
    );
    Some(Key::new("growth.increment").error(message))
}

/// Most blocks of loads.
const MOST_BLOCKS: usize = 10_000;

/// Blocks of loads have cycles, and one at least opens the cracks.
fn check_blocks(problem: &ProblemData) -> Option<KeyError> {
    let blocks = &problem.growth.as_ref()?.law.as_ref()?.blocks;
    let is_wrong = |block: &LoadBlock| {
        let is_ratio = block.max <= 0.0 || block.min / block.max >= -1e3;
        !(block.cycles > 0.0 && block.max.is_finite() && block.min < block.max && is_ratio)
    };
    let key = Key::new("growth.cycles");
    if let Some(wrong) = blocks.iter().position(is_wrong) {
        let message = "a block is `[n, max, min]` with n > 0 cycles and `max` above `min`, which is at least −1000 `max`";
        return Some(key.index(wrong).error(message));
    }
    if blocks.len() > MOST_BLOCKS {
        return Some(
            key.error(format!(
                "there are more than {MOST_BLOCKS} blocks; write fewer, longer ones"
            )),
        );
    }
    let opens = blocks.iter().any(|block| block.max > 0.0);
    (!opens).then(|| key.error("no block opens the cracks; give one with `max` above 0"))
}

/// Functions of tips alone let no crack jump that meets another one, or that comes back to itself.
fn check_additive(problem: &ProblemData) -> Option<KeyError> {
    let domain = problem.domain();
    if problem.discretization.enrichment != Enrichment::AdditiveOnly {
        return None;
    }
    let jumps = Jumps::new(problem.cracks(), domain, touch(&domain.bounds));
    let message = "the crack meets another one or comes back to itself, which `enrichment = \"additive-only\"` \
                   cannot show; take another enrichment, or move the cracks apart";
    jumps.first_meeting().map(|crack| Key::points(crack as usize).error(message))
}

/// No zone of the built-in functions of tips may reach too far.
fn check_zone(problem: &ProblemData) -> Option<KeyError> {
    let radius = problem.discretization.enrichment_radius?;
    let message = too_wide(problem, radius)?;
    let key = Key::new("discretization.enrichment_radius");
    Some(key.error(format!("`enrichment_radius` {message}")))
}

/// Sizes of a domain whose squares and their sums neither underflow nor overflow in the solver.
const SIZES: std::ops::RangeInclusive<f64> = 1e-30..=1e30;

fn check_domain(domain: &Domain) -> Vec<KeyError> {
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
        Key::new("domain.max").error(message)
    };
    let box_is_wrong: Vec<_> = wrong.map(message).collect();
    if !box_is_wrong.is_empty() && domain.outline().is_some_and(|k| is_flat(&domain.holes[k])) {
        let message = "the outline encloses nothing; give three corners or more, not all on a line";
        return vec![Key::new("domain.outline").error(message)];
    }
    if box_is_wrong.is_empty() { check_holes(domain) } else { box_is_wrong }
}

/// True if the corners of an outline lie on an upright or a level line.
fn is_flat(outline: &Hole) -> bool {
    let size = outline.rim_bounds().size();
    !(size.x > 0.0 && size.y > 0.0)
}

/// Names that all formulas may use; files cannot break this, code can.
fn check_tables(problem: &ProblemData) -> Option<KeyError> {
    let broken =
        |count: &usize| scopes::check(&problem.tables[..*count], &problem.equation).is_err();
    let count = (1..=problem.tables.len()).find(broken)?;
    let error = scopes::check(&problem.tables[..count], &problem.equation).err()?;
    Some(Key::new("table").index(count - 1).name("name").error(error.to_string()))
}

fn check_equation(equation: &Equation, domain: &Domain) -> Option<KeyError> {
    let (name, message) = equation.invalid_constant(domain)?;
    if EIGENSTRAINS.contains(&name) || name == EXPANSION {
        let message = format!("`{name}` {message}; correct [temperature] or [strain]");
        return Some(Key::new("material.expansion").error(message));
    }
    if STIFFNESS.contains(&name) {
        // the constants follow from keys of other names
        let message = format!("`{name}` {message}; correct the moduli in [material]");
        return Some(Key::new("material").error(message));
    }
    Some(Key::new("material").name(name).error(format!("`{name}` {message}")))
}

/// One value per component everywhere; files cannot break this, code can.
fn check_components(problem: &ProblemData) -> Vec<KeyError> {
    let expected = problem.components();
    let boundary = (0..)
        .zip(&problem.boundary)
        .map(|(index, condition)| (Key::new("boundary").index(index), condition.components.len()));
    let exact = (!problem.exact.is_empty()).then_some((Key::new("exact"), problem.exact.len()));
    let lists = boundary.chain(exact).chain([(Key::new("source"), problem.source.len())]);
    let wrong = lists.filter(|(_, given)| *given != expected);
    let message = |given| format!("there are {given} components, but the field has {expected}");
    wrong.map(|(key, given)| key.error(message(given))).collect()
}

fn check_cells(cells: &BaseCells) -> Option<KeyError> {
    let BaseCells::Grid([nx, ny]) = *cells else { return None };
    let message = if nx == 0 || ny == 0 {
        "`cells` must be at least 1 in each direction".to_owned()
    } else if u64::from(nx) * u64::from(ny) > MAX_CELLS {
        format!("`cells` are {nx} × {ny}, but at most {MAX_CELLS} in all")
    } else {
        return None;
    };
    Some(Key::new("discretization.cells").error(message))
}

fn check_points(cells: &BaseCells, domain: &Rect) -> Option<KeyError> {
    let BaseCells::Points(points) = cells else { return None };
    let key = Key::new("discretization.points");
    if points.is_empty() {
        return Some(key.error("there are no points; at least one is needed"));
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
    Some(key.error(message))
}

fn check_order(order: &PolynomialOrder, domain: &Rect) -> Option<KeyError> {
    let key = Key::new("discretization.order");
    let mut wrong = samples(domain).filter_map(|p| order.at(p).err());
    wrong.next().map(|error| key.error(error.to_string()))
}
