//! Enrichments of one's own.

use ppum::expression::Expression;
use ppum::function::NonsmoothPoints;
use ppum::vec2::Vec2;

use super::word_table;

/// Functions that the local spaces of some patches hold beside polynomials, each times all
/// polynomials up to a degree: `[[enrichment]]` in problem files.
///
/// The built-in enrichment of tips is one of them: the Westergaard functions, with everything at
/// its default.
///
/// ```
/// use ppum::dataset::Equation;
/// use ppum::vec2::{Rect, vec2};
/// use ppum_problem::{
///     BaseCells, Discretization, LocalEnrichment, Problem, ProblemData, Site,
/// };
///
/// let domain = Rect::new(vec2(-1.0, -1.0), vec2(1.0, 1.0));
/// let mut problem = ProblemData::poisson(domain, 1.0, Discretization::new(BaseCells::Level(3)));
/// let interface = Site::Along([vec2(-1.0, 0.1), vec2(1.0, 0.3)]);
/// problem.enrichments.push(LocalEnrichment::new(&["abs(y)"], interface));
/// assert!(Problem::new(problem).is_ok());
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
    pub region: EnrichmentRegion,
    /// Degree of the polynomials that multiply the functions. `None` is 0, but at tips
    /// [`Discretization::tip_degree`](super::Discretization::tip_degree) on patches that hold the
    /// tip.
    pub degree: Option<usize>,
    /// Places at which the functions are not smooth, beside what their formulas show; in
    /// their frame.
    pub declared: NonsmoothPoints,
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

// points and segments are arrays, not words
word_table!(Site: Tips "tips");

/// The patches that have an enrichment.
#[derive(Clone, Debug, PartialEq)]
pub enum EnrichmentRegion {
    /// The region that suits the site. World: all patches; a point or a segment: as `Near(0.0)`;
    /// tips: `Near` with the [enrichment radius](super::ProblemData::enrichment_radius).
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
            region: EnrichmentRegion::Default,
            degree: None,
            declared: NonsmoothPoints::default(),
        }
    }

    /// True if the zone around each tip has the problem's radius.
    pub(crate) fn has_default_zone(&self) -> bool {
        self.site == Site::Tips && self.region == EnrichmentRegion::Default
    }
}
