//! Rules for user-defined enrichments, and for zones around tips.

use ppum::crack::{Crack, CrackEnd, tips};
use ppum::edge::Edge;
use ppum::formula::{Formula, FormulaJets};
use ppum::function::{NonsmoothPoints, function_scope};
use ppum::vec2::{Rect, Vec2};

use crate::data::{EnrichmentRegion, LocalEnrichment, ProblemData, Site, expression};
use crate::file::{Key, KeyError};
use crate::geometry::meets;

/// All rules broken by the enrichments.
pub(super) fn check_enrichments(problem: &ProblemData) -> Vec<KeyError> {
    let check = |(index, new): (usize, &LocalEnrichment)| {
        let found = [
            bad_functions(new, problem),
            bad_site(new, problem),
            bad_region(new, problem),
            bad_declaration(new),
        ];
        let key = Key::new("enrichment").index(index);
        found
            .into_iter()
            .flatten()
            .map(move |(name, message)| key.clone().name(name).error(message))
    };
    problem.enrichments.iter().enumerate().flat_map(check).collect()
}

/// A key and what is wrong with its value.
type NamedError = (&'static str, String);

fn bad_functions(new: &LocalEnrichment, problem: &ProblemData) -> Option<NamedError> {
    if new.functions.is_empty() {
        return Some(("functions", "there is no function; give at least one".to_owned()));
    }
    let scope = match function_scope(&new.parameters, problem.cracks().len(), &problem.tables) {
        Ok(scope) => scope,
        Err(error) => return Some(("parameters", error.to_string())),
    };
    new.functions.iter().find_map(|text| {
        let message = match Formula::parse(text, &scope) {
            Err(error) => expression::message(&error),
            Ok(formula) => FormulaJets::new(&[&formula], 2).err()?.to_string(),
        };
        Some(("functions", format!("`{text}`: {message}")))
    })
}

fn bad_site(new: &LocalEnrichment, problem: &ProblemData) -> Option<NamedError> {
    let domain = &problem.domain().bounds;
    let message = |text: &str| text.to_owned();
    match new.site {
        Site::World => None,
        Site::Tips => tips(problem.cracks()).next().is_none().then(|| {
            ("at", message("there is no tip; add a [[crack]] that ends inside, or give a point"))
        }),
        Site::Point { at, angle } if !(at.is_finite() && angle.is_finite()) => {
            Some(("at", message("the point and its angle must be finite")))
        }
        Site::Point { at, .. } => (!domain.contains(at))
            .then(|| ("at", format!("[{}, {}] lies outside the domain; move it in", at.x, at.y))),
        Site::Along([a, b]) => bad_segment([a, b], domain).map(|m| ("along", message(m))),
    }
}

fn bad_segment([a, b]: [Vec2; 2], domain: &Rect) -> Option<&'static str> {
    if !(a.is_finite() && b.is_finite()) {
        Some("the points must be finite")
    } else if (b - a).length() <= f64::EPSILON * (a.length() + b.length()) {
        Some("the two points are equal; give two different ones")
    } else if !meets(Edge::segment([a, b]), domain) {
        Some("the segment does not meet the domain; move it in")
    } else {
        None
    }
}

fn bad_region(new: &LocalEnrichment, problem: &ProblemData) -> Option<NamedError> {
    match (&new.region, new.site) {
        (EnrichmentRegion::Near(_), Site::World) => {
            let message = "`radius` has no meaning without `at` or `along`; add one of them, or write \
                           `where`";
            Some(("radius", message.to_owned()))
        }
        (EnrichmentRegion::Near(radius), Site::Tips) if *radius >= 0.0 => {
            Some(("radius", format!("`radius` {}", too_wide(problem, *radius)?)))
        }
        (EnrichmentRegion::Where(_), Site::Tips) => {
            let message = "`where` cannot choose patches of all tips at once; write `radius`";
            Some(("where", message.to_owned()))
        }
        _ => None,
    }
}

fn bad_declaration(new: &LocalEnrichment) -> Option<NamedError> {
    let NonsmoothPoints { kinks, singular } = &new.declared;
    let message =
        |key: &str| format!("`{key}` has a point that is not finite, or a segment without length");
    if kinks.iter().any(|[a, b]| !((*b - *a).length() > 0.0 && a.is_finite() && b.is_finite())) {
        return Some(("kinks", message("kinks")));
    }
    let wrong = singular.iter().any(|p| !p.is_finite());
    wrong.then(|| ("singular", message("singular")))
}

/// The error of the radius of a zone around all tips, if it is too large: the functions of a tip
/// jump on the whole straight extension of its segment, also beyond the other end of the crack.
pub(super) fn too_wide(problem: &ProblemData, radius: f64) -> Option<String> {
    // from the boundary on there is nothing to jump
    let goes_on = |crack: &&Crack| {
        crack.ends.contains(&CrackEnd::Tip) && !crack.ends.contains(&CrackEnd::Mouth)
    };
    let apart = problem
        .cracks()
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
