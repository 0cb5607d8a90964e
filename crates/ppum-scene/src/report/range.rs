//! The range of an image's colours: found with the true extrema of the view, and told.

use ppum::crack::{Crack, TipId, tips};
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::text::{LocationText, apart, beside, trimmed};
use ppum::vec2::{Vec2, vec2};
use ppum_render::extrema::{Extrema, Extremum, ExtremumSite, SingularKind};
use ppum_render::picture::ColoredRaster;
use ppum_render::range::Basis;
use ppum_render::scale::Scale;

use super::location::{is_deep, tip_near};

/// Writes places of a dataset, whichever step they are of.
#[must_use]
pub fn places(dataset: &Dataset) -> LocationText {
    let cracks: Vec<_> = dataset.steps.iter().flat_map(|step| &step.cracks).cloned().collect();
    LocationText::new(&dataset.domain.bounds, &cracks)
}

/// The data of a field that messages about ranges and locations need.
pub struct RangeLocations<'a> {
    places: LocationText,
    cracks: &'a [Crack],
    /// Size of the body.
    size: f64,
    /// The hole that is its outline, if it has one.
    outline: Option<usize>,
}

/// Why an image has one colour on a logarithmic scale.
const NOT_POSITIVE: &str =
    "; no value is positive, and a logarithmic scale has one colour for them: symlog has more";

impl<'a> RangeLocations<'a> {
    /// Collects the data of a field.
    #[must_use]
    pub fn new(dataset: &Dataset, field: &'a Field<'_>) -> Self {
        Self::with(places(dataset), field)
    }

    /// Collects the data with a known format of locations, which takes long to find where there are
    /// many cracks.
    #[must_use]
    pub fn with(places: LocationText, field: &'a Field<'_>) -> Self {
        let (size, outline) = (field.domain.bounds.size(), field.domain.outline());
        Self { places, cracks: &field.step.cracks, size: size.x.max(size.y), outline }
    }

    /// Writes the meaning of the colours, and the bounds of all other values:
    /// `colours from 0 to 2.7 (robust); values from 0.1 at (0.2, 0.3) to ∞ at tip 0 (0.5, 0)`.
    pub fn colors(&self, picture: &ColoredRaster) -> String {
        let (norm, span) = (&picture.normalization, &picture.span);
        let colors = match picture.one_value {
            _ if !picture.has_values => {
                let ends = match [picture.has_below, picture.has_above] {
                    [true, true] => ": −∞ and ∞ alone",
                    [true, false] => ": −∞ everywhere",
                    [false, true] => ": ∞ everywhere",
                    [false, false] => "",
                };
                return format!("no finite values{ends}");
            }
            Some(value) => return format!("one value, {}", trimmed(value)),
            None if !picture.colormap.classes().is_empty() => {
                let values = picture.colormap.classes().iter().map(|value| trimmed(*value));
                return format!("a colour each for {}", values.collect::<Vec<_>>().join(", "));
            }
            None => {
                let [from, to] = apart(norm.min(), norm.max());
                format!("colours from {from} to {to}{}", basis(span.basis))
            }
        };
        let Some(values) = &span.values else { return colors };
        let is_below = norm.scale() == Scale::Log && values.max.value <= 0.0;
        let why = if is_below { NOT_POSITIVE } else { "" };
        format!("{colors}; {}{why}", self.values(values, picture.view.width))
    }

    fn values(&self, values: &Extrema, width: f64) -> String {
        let [min, max] = self.extrema(values, width);
        let whose = if values.is_of_pixels() { "values of pixels" } else { "values" };
        format!("{whose} from {min} to {max}")
    }

    /// The smallest and the largest value with their places: `0.1 at (0.2, 0.3)`,
    /// `∞ at tip 0 (0.5, 0)`; with the digits that are of interest in a view of some width.
    #[must_use]
    pub fn extrema(&self, values: &Extrema, width: f64) -> [String; 2] {
        let both = [&values.min, &values.max];
        let finite = both.map(|extremum| extremum.value).into_iter().filter(|v| v.is_finite());
        let size = finite.map(f64::abs).fold(0.0, f64::max);
        let all_finite = both.iter().all(|extremum| extremum.value.is_finite());
        let shown = match all_finite {
            true => apart(beside(values.min.value, size), beside(values.max.value, size)),
            false => both.map(|extremum| value(extremum.value, size)),
        };
        let place =
            |k: usize| format!("{} at {}", shown[k], self.place(both[k], values.center, width));
        [place(0), place(1)]
    }

    /// Where an extremum lies.
    fn place(&self, extremum: &Extremum, center: Vec2, width: f64) -> String {
        let at = match extremum.on {
            // known exactly, and told by its number
            ExtremumSite::Singular(_) => self.places.show(center + extremum.offset),
            _ if is_deep(width, self.size) => {
                let tip = tip_near(self.cracks, center, width);
                let (origin, name) = match tip {
                    Some((number, tip)) => (tip, format!("tip {number}")),
                    None => (center, self.places.show(center)),
                };
                let offset = (center - origin) + extremum.offset;
                let [dx, dy] = [offset.x, offset.y].map(|v| trimmed(rounded(v, width)));
                format!("{name} + ({dx}, {dy})")
            }
            _ => {
                let at = center + extremum.offset;
                self.places.show(vec2(rounded(at.x, width), rounded(at.y, width)))
            }
        };
        match extremum.on {
            ExtremumSite::Singular(kind) => format!("{} {at}", self.kind(kind)),
            on => [at].into_iter().chain(words(on)).collect::<Vec<_>>().join(" "),
        }
    }

    fn kind(&self, kind: SingularKind) -> String {
        match kind {
            SingularKind::Tip(tip) => format!("tip {}", self.number(tip)),
            SingularKind::Kink(crack) => format!("a kink of crack {crack}"),
            SingularKind::Corner(hole) if Some(hole) == self.outline => {
                "a corner of the outline".into()
            }
            SingularKind::Corner(hole) => format!("a corner of hole {hole}"),
            SingularKind::Origin => "the origin of a function".into(),
        }
    }

    /// The number of a tip, as in `ppum sif`.
    fn number(&self, tip: TipId) -> usize {
        tips(self.cracks).position(|known| known == tip).unwrap_or_default()
    }
}

fn basis(basis: Basis) -> String {
    match basis {
        Basis::Given | Basis::All => String::new(),
        Basis::Pixels => " (finite pixels)".into(),
        Basis::Robust => " (robust)".into(),
        Basis::Percentiles(p, q) => {
            format!(" ({} % to {} % of the pixels)", trimmed(p), trimmed(q))
        }
    }
}

/// A value beside others of some size.
pub fn value(value: f64, size: f64) -> String {
    match value {
        f64::INFINITY => "∞".into(),
        f64::NEG_INFINITY => "−∞".into(),
        value => trimmed(beside(value, size)),
    }
}

/// Names the feature that a place lies on, if there is one.
pub fn words(on: ExtremumSite) -> Option<String> {
    match on {
        ExtremumSite::Face(segment, side) => {
            Some(format!("{} crack {}", side.name(), segment.crack))
        }
        ExtremumSite::Rim(hole) => Some(format!("on the rim of hole {hole}")),
        ExtremumSite::Border => Some("on the border".into()),
        ExtremumSite::Interface => Some("on an interface".into()),
        ExtremumSite::Everywhere => Some("as everywhere, but for rounding".into()),
        ExtremumSite::Inside | ExtremumSite::Pixel | ExtremumSite::Singular(_) => None,
    }
}

/// A coordinate with the digits that it is known to in a view of some width: an extremum's place is
/// that of a flat top.
fn rounded(x: f64, width: f64) -> f64 {
    let step = 10f64.powi((KNOWN * width).log10().floor() as i32);
    let rounded = (x / step).round() * step;
    if rounded.is_finite() { rounded } else { x }
}

/// Part of a view that the place of an extremum is told to.
const KNOWN: f64 = 1e-5;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::image::body::BodyView;
    use crate::image::coloring::value_span;
    use crate::image::mirror_lines::MirrorLines;
    use crate::image::values::PixelValues;
    use ppum::progress::unwatched;
    use ppum::quantity::Quantity;
    use ppum_render::picture::Style;
    use ppum_render::range::RangeChoice;
    use ppum_render::scatter::render;
    use ppum_render::view::View;
    use ppum_testkit::random::Random;
    use ppum_testkit::synthetic::{Coefficients, Recipe};

    /// While one moves, an image of another view has the range, and the extrema, of the view
    /// before: their places stay where they are.
    #[test]
    fn places_stay_when_the_view_moves() {
        let mut random = Random(9);
        for seed in 0..6 {
            let recipe = Recipe { components: 2, ..Recipe::random(seed) };
            let dataset = Recipe { coefficients: Coefficients::Taylor, ..recipe }.dataset();
            let field = Field::new(&dataset, 0).unwrap();
            let quantity = Quantity::parse("uy", &field).unwrap();
            let view = View::fit(dataset.domain.bounds, [90, 70]).unwrap();
            let draw = |view: &View| {
                let raster = render::<f64>(&field, view, &quantity, unwatched()).unwrap();
                PixelValues::new(raster, &field, view, "test")
            };
            let (drawn, style) =
                (draw(&view), Style { range: RangeChoice::Auto, ..Style::default() });
            let seen = BodyView::new(&field, view, MirrorLines::default());
            let span = value_span(&field, &seen, &quantity, &drawn, &style, unwatched()).unwrap();
            let by = vec2(random.between(-0.2, 0.2), random.between(-0.2, 0.2)) * view.width;
            let moved = draw(&View { center: view.center + by, ..view });
            let telling = RangeLocations::new(&dataset, &field);
            let told =
                |drawn: &PixelValues| telling.colors(&drawn.picture(&style, span.clone()).unwrap());
            assert!(told(&drawn).contains("values from"));
            assert_eq!(told(&drawn), told(&moved));
        }
    }
}
