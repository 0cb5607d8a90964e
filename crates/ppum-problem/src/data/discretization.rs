//! The discretisation of a problem.

use ppum::dataset::MAX_DEGREE;
use ppum::expression::Expression;
use ppum::vec2::{Rect, Vec2, vec2};
use ppum::weight::WeightFunction;

use super::{Keyword, word_table};

/// Highest level of a uniform cover: 4^10 ≈ 10⁶ cells, beyond what a direct solver holds.
pub(crate) const MAX_LEVEL: u32 = 10;

/// Cover, local spaces and enrichment.
#[derive(Clone, Debug, PartialEq)]
pub struct Discretization {
    /// The base cover.
    pub cells: BaseCells,
    /// Refine where cracks need it; false keeps the base cover.
    pub refine: bool,
    /// Degree of the local polynomials. Problem files that give none get 2, and 4 where the body is
    /// nearly incompressible.
    pub order: PolynomialOrder,
    /// α: a patch is its cell enlarged by this factor, in [`OVERLAP`](ppum::cover::OVERLAP).
    pub overlap: f64,
    /// The weight function.
    pub weight: WeightFunction,
    /// The patches whose local spaces are enriched.
    pub enrichment: Enrichment,
    /// Resolve jumps of the material: kinks of the solution on patches that an interface cuts.
    pub interfaces: bool,
    /// Radius of the zone around each tip; `None` for
    /// [the default](super::ProblemData::enrichment_radius).
    pub enrichment_radius: Option<f64>,
    /// Degree of the polynomial that multiplies the tip functions on patches that contain a tip.
    pub tip_degree: usize,
    /// Number of terms of Williams' series, r^½ to r^(N − ½), with [`Enrichment::Williams`]; `None`
    /// for as many as the order of a patch asks for: the order itself, from 3 to 6, and on arcs
    /// one more, from 3 to 7.
    pub tip_terms: Option<usize>,
}

/// Largest number of terms of Williams' series: their degrees are those of polynomials.
pub const MOST_TERMS: usize = MAX_DEGREE + 1;

/// The base cover's cells.
#[derive(Clone, Debug, PartialEq)]
pub enum BaseCells {
    /// 4^level equal cells, as near to squares as halving allows.
    Level(u32),
    /// Equal cells, this many along x and y.
    Grid([u32; 2]),
    /// A quadtree split until a cell holds at most one of these points.
    Points(Vec<Vec2>),
}

impl BaseCells {
    /// The cells of the base cover as a grid of roots, each halved so often along both sides;
    /// nothing for points.
    ///
    /// A level makes 4^level equal cells, none more than twice as long as wide unless the domain is
    /// longer than that allows: 4^k root cells along a long domain, each halved level − k times.
    pub fn roots(&self, domain: &Rect) -> Option<([u32; 2], u32)> {
        let level = match *self {
            Self::Level(level) => level,
            Self::Grid(cells) => return Some((cells, 0)),
            Self::Points(_) => return None,
        };
        let size = domain.size();
        let halvings = (0.5 * (size.x / size.y).log2().abs() - 0.5).ceil().max(0.0);
        let k = (halvings as u32).min(level);
        let roots = 1 << (2 * k);
        Some((if size.x > size.y { [roots, 1] } else { [1, roots] }, level - k))
    }

    /// Width and height of the base cover's cells, which those around points do not share.
    pub(crate) fn size(&self, domain: &Rect) -> Option<Vec2> {
        let ([nx, ny], halvings) = self.roots(domain)?;
        let part = 0.5f64.powi(halvings as i32);
        Some(vec2(domain.size().x / f64::from(nx), domain.size().y / f64::from(ny)) * part)
    }
}

/// Degree of the local polynomials, 0 to [`MAX_DEGREE`].
#[derive(Clone, Debug, PartialEq)]
pub enum PolynomialOrder {
    /// One order for all patches.
    Uniform(usize),
    /// A formula of x and y, taken at the patch's centre and rounded; see [`PolynomialOrder::at`].
    Formula(Expression),
}

/// The functions that local spaces hold beside polynomials.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Enrichment {
    /// None: neither cracks nor interfaces are seen.
    None,
    /// Jumps on patches cut through, nothing at tips: leaves them to
    /// [`LocalEnrichment`](super::LocalEnrichment).
    Jumps,
    /// Jumps on patches cut through, tip functions on patches that contain a tip.
    TipPatch,
    /// Jumps on patches cut through, tip functions on all patches that meet the disc of the
    /// enrichment radius around a tip.
    Zone,
    /// As `Zone`, with Williams' series in place of its first term times polynomials: of each power
    /// r^(n − ½) the two displacement fields that leave the faces free, an unknown each.
    #[default]
    Williams,
    /// As `Zone` but without jumps: figure 5 of Üffinger et al. 2011.
    AdditiveOnly,
}

word_table!(
    Enrichment: None "none", Jumps "jumps", TipPatch "tip-patch", Zone "zone", Williams "williams",
    AdditiveOnly "additive-only"
);

impl Discretization {
    /// Defaults on the given cells: order 2, α = 1.3, linear weights, Williams' series in zones
    /// around tips, refined at tips.
    #[must_use]
    pub fn new(cells: BaseCells) -> Self {
        Self {
            cells,
            refine: true,
            order: PolynomialOrder::Uniform(2),
            overlap: 1.3,
            weight: WeightFunction::default(),
            enrichment: Enrichment::default(),
            interfaces: true,
            enrichment_radius: None,
            tip_degree: 1,
            tip_terms: None,
        }
    }
}

/// A formula of the order that gives no order.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "the order is {value} at [{}, {}], but must be 0 to {MAX_DEGREE} after rounding",
    .point.x,
    .point.y
)]
pub struct OrderError {
    /// Value of the formula.
    pub value: f64,
    /// The place.
    pub point: Vec2,
}

impl PolynomialOrder {
    /// The order of a patch with centre `point`: the formula's value, rounded to the nearest whole
    /// number, halves away from zero.
    ///
    /// # Errors
    /// The value is not finite, negative or above [`MAX_DEGREE`].
    pub fn at(&self, point: Vec2) -> Result<usize, OrderError> {
        let value = match self {
            Self::Uniform(order) => *order as f64,
            Self::Formula(formula) => formula.value(point),
        };
        let possible = (0..=MAX_DEGREE).find(|order| value.round() == *order as f64);
        possible.ok_or(OrderError { value, point })
    }
}

impl Enrichment {
    /// All choices.
    pub const ALL: [Self; 6] =
        [Self::None, Self::Jumps, Self::TipPatch, Self::Zone, Self::Williams, Self::AdditiveOnly];

    /// Name in problem files.
    #[must_use]
    pub fn name(self) -> &'static str {
        self.word()
    }

    /// True if all patches in a zone around each tip hold its functions.
    #[must_use]
    pub fn has_zones(self) -> bool {
        matches!(self, Self::Zone | Self::Williams | Self::AdditiveOnly)
    }

    /// True if patches that a crack cuts through hold its side.
    #[must_use]
    pub fn has_jumps(self) -> bool {
        matches!(self, Self::Jumps | Self::TipPatch | Self::Zone | Self::Williams)
    }
}
