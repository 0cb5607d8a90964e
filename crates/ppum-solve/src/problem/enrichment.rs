//! Enrichments of one's own.

use ppum::crack::tips;
use ppum::dataset::MAX_DEGREE;
use ppum::expression::Expression;
use ppum::formula::{Formula, FormulaJets};
use ppum::function::{Declared, function_scope};
use ppum::vec2::{Rect, Vec2};

use super::check::{MistakeAt, too_wide};
use super::key::Key;
use super::{Problem, expression};
use crate::geometry::meets;

/// Functions that the local spaces of some patches hold beside polynomials, each times all
/// polynomials up to a degree: `[[enrichment]]` in problem files.
///
/// The built-in enrichment of tips is one of them: the Westergaard functions, with everything at
/// its default.
///
/// ```
/// use ppum::dataset::Equation;
/// use ppum::vec2::{Rect, vec2};
/// use ppum_solve::problem::{Cells, Discretization, LocalEnrichment, Problem, Site};
///
/// let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
/// let mut problem = Problem::poisson(domain, 1.0, Discretization::new(Cells::Level(3)));
/// let interface = Site::Along([vec2(-1.0, 0.1), vec2(1.0, 0.3)]);
/// problem.enrichments.push(LocalEnrichment::new(&["abs(y)"], interface));
/// assert_eq!(problem.check(), Ok(()));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct LocalEnrichment {
    /// Name of the functions in reports; if empty, their texts.
    pub name: String,
    /// Formulas of x, y, r, theta of the frame that `site` gives.
    pub functions: Vec<String>,
    /// Constants of the formulas.
    pub parameters: Vec<(String, f64)>,
    /// The frame in which x, y, r and theta are measured.
    pub site: Site,
    /// The patches that have the functions.
    pub region: Region,
    /// Degree of the polynomials that multiply the functions. `None` is 0, but at tips
    /// [`Discretization::tip_degree`](super::Discretization::tip_degree) on patches that hold the
    /// tip.
    pub degree: Option<usize>,
    /// Places at which the functions are not smooth, beside what their formulas show; in
    /// their frame.
    pub declared: Declared,
}

/// The frame of an enrichment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Site {
    /// World coordinates.
    World,
    /// Origin at a point.
    Point {
        /// The origin.
        at: Vec2,
        /// Angle of the x axis, radians.
        angle: f64,
    },
    /// One frame at every tip: x along the growth direction, θ jumps on the crack.
    Tips,
    /// Origin at the first point, x toward the second: y is the signed distance to their line,
    /// positive on the left.
    Along([Vec2; 2]),
}

/// The patches that have an enrichment.
#[derive(Clone, Debug, PartialEq)]
pub enum Region {
    /// The region that suits the site. World: all patches; a point or a segment: as `Near(0.0)`;
    /// tips: `Near` with the [enrichment radius](super::Problem::enrichment_radius).
    Default,
    /// Patches that hold the point or tip inside or are cut by the segment, and those whose support
    /// is nearer to it than this length.
    Near(f64),
    /// Patches on whose support, as far as it lies in the domain, this expression of world
    /// coordinates is positive at the centre, at a corner, or in the middle of an edge.
    Where(Expression),
}

impl LocalEnrichment {
    /// Functions at a site, with everything else at its default.
    #[must_use]
    pub fn new(functions: &[&str], site: Site) -> Self {
        Self {
            name: String::new(),
            functions: functions.iter().map(|&text| text.to_owned()).collect(),
            parameters: Vec::new(),
            site,
            region: Region::Default,
            degree: None,
            declared: Declared::default(),
        }
    }
}

impl LocalEnrichment {
    /// True if the zone around each tip has the problem's radius.
    pub(super) fn has_default_zone(&self) -> bool {
        self.site == Site::Tips && self.region == Region::Default
    }
}

/// All rules broken by the enrichments.
pub(super) fn check_enrichments(problem: &Problem) -> Vec<MistakeAt> {
    let check = |(index, new): (usize, &LocalEnrichment)| {
        let found = [
            bad_functions(new, problem),
            bad_site(new, problem),
            bad_region(new, problem),
            bad_degree(new),
            bad_declaration(new),
        ];
        let at = move |(name, message)| {
            MistakeAt::new(Key::new("enrichment").index(index).name(name), message)
        };
        found.into_iter().flatten().map(at)
    };
    problem.enrichments.iter().enumerate().flat_map(check).collect()
}

/// A key and what is wrong with its value.
type Broken = (&'static str, String);

fn bad_functions(new: &LocalEnrichment, problem: &Problem) -> Option<Broken> {
    if new.functions.is_empty() {
        return Some(("functions", "there is no function; give at least one".to_owned()));
    }
    let scope = match function_scope(&new.parameters, problem.cracks.len(), &problem.tables) {
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

fn bad_site(new: &LocalEnrichment, problem: &Problem) -> Option<Broken> {
    let domain = &problem.domain.bounds;
    let message = |text: &str| text.to_owned();
    match new.site {
        Site::World => None,
        Site::Tips => tips(&problem.cracks).next().is_none().then(|| {
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
    } else if !meets([a, b], domain) {
        Some("the segment does not meet the domain; move it in")
    } else {
        None
    }
}

fn bad_region(new: &LocalEnrichment, problem: &Problem) -> Option<Broken> {
    match (&new.region, new.site) {
        (Region::Near(_), Site::World) => {
            let message = "`radius` has no meaning without `at` or `along`; add one of them, or write \
                           `where`";
            Some(("radius", message.to_owned()))
        }
        (Region::Near(radius), _) if !(*radius >= 0.0 && radius.is_finite()) => {
            Some(("radius", format!("`radius` is {radius}, but must be finite and not negative")))
        }
        (Region::Near(radius), Site::Tips) => {
            Some(("radius", format!("`radius` {}", too_wide(problem, *radius)?)))
        }
        (Region::Where(_), Site::Tips) => {
            let message = "`where` cannot choose patches of all tips at once; write `radius`";
            Some(("where", message.to_owned()))
        }
        _ => None,
    }
}

fn bad_degree(new: &LocalEnrichment) -> Option<Broken> {
    let degree = new.degree.filter(|degree| *degree > MAX_DEGREE)?;
    Some(("degree", format!("`degree` is {degree}, but must be 0 to {MAX_DEGREE}")))
}

fn bad_declaration(new: &LocalEnrichment) -> Option<Broken> {
    let Declared { kinks, singular } = &new.declared;
    let message =
        |key: &str| format!("`{key}` has a point that is not finite, or a segment without length");
    if kinks.iter().any(|[a, b]| !((*b - *a).length() > 0.0 && a.is_finite() && b.is_finite())) {
        return Some(("kinks", message("kinks")));
    }
    let wrong = singular.iter().any(|p| !p.is_finite());
    wrong.then(|| ("singular", message("singular")))
}
