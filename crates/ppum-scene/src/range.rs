//! The range of a picture's colours: found with the true extrema of the view, and told.

use ppum::crack::{Crack, TipId, tips};
use ppum::dataset::Dataset;
use ppum::field::Field;
use ppum::progress::Watcher;
use ppum::quantity::Quantity;
use ppum::text::{Places, apart, beside, trimmed};
use ppum::vec2::{Vec2, vec2};
use ppum_render::RenderError;
use ppum_render::extrema::{Extrema, Extremum, On, SingularKind};
use ppum_render::picture::{Picture, Style};
use ppum_render::range::{Basis, ValueSpan};
use ppum_render::scale::Scale;

use crate::body::BodyView;
use crate::drawing::Drawn;
use crate::whole;

/// The range of what was drawn; one that has to be found with the extrema of what is seen of the
/// body. These are the same whether it is deformed or not, and their places are those of the
/// undeformed body.
///
/// # Errors
/// A quantity that the field does not have, a watcher that stops the search.
pub fn value_span(
    field: &Field<'_>,
    seen: &BodyView<'_>,
    quantity: &Quantity,
    drawn: &Drawn,
    style: &Style,
    watcher: &dyn Watcher,
) -> Result<ValueSpan, RenderError> {
    if !style.range.is_found() {
        return Ok(drawn.span(style, None));
    }
    // a deformed body that is drawn has displacements
    let regions = seen.regions(field).unwrap_or_default();
    let parts = (regions.as_slice(), &seen.lines);
    Ok(drawn.span(style, whole::extrema(field, parts, quantity, watcher)?))
}

/// Writes places of a dataset, whichever step they are of.
#[must_use]
pub fn places(dataset: &Dataset) -> Places {
    let cracks: Vec<_> = dataset.steps.iter().flat_map(|step| &step.cracks).cloned().collect();
    Places::new(&dataset.domain.bounds, &cracks)
}

/// What is known of places.
pub struct Telling<'a> {
    places: Places,
    cracks: &'a [Crack],
    /// Size of the plate.
    size: f64,
    /// The hole that is its outline, if it has one.
    outline: Option<usize>,
}

/// Why a picture has one colour on a logarithmic scale.
const NOT_POSITIVE: &str =
    "; no value is positive, and a logarithmic scale has one colour for them: symlog has more";

/// Views narrower than this part of the plate have their places told from their centre.
const DEEP: f64 = 1e-3;

impl<'a> Telling<'a> {
    /// What is known of the places of a field.
    #[must_use]
    pub fn new(dataset: &Dataset, field: &'a Field<'_>) -> Self {
        Self::with(places(dataset), field)
    }

    /// The same with what is known of how places of the dataset are written, which takes long where
    /// there are many cracks.
    #[must_use]
    pub fn with(places: Places, field: &'a Field<'_>) -> Self {
        let (size, outline) = (field.domain.bounds.size(), field.domain.outline());
        Self { places, cracks: &field.step.cracks, size: size.x.max(size.y), outline }
    }

    /// What colours mean, and between which values all others lie: `colours from 0 to 2.7 (robust);
    /// values from 0.1 at (0.2, 0.3) to ∞ at tip 0 (0.5, 0)`.
    pub fn colors(&self, picture: &Picture) -> String {
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
            On::Singular(_) => self.places.show(center + extremum.offset),
            _ if width < DEEP * self.size => {
                let offset = [extremum.offset.x, extremum.offset.y];
                let [dx, dy] = offset.map(|v| trimmed(rounded(v, width)));
                format!("{} + ({dx}, {dy})", self.places.show(center))
            }
            _ => {
                let at = center + extremum.offset;
                self.places.show(vec2(rounded(at.x, width), rounded(at.y, width)))
            }
        };
        match extremum.on {
            On::Singular(kind) => format!("{} {at}", self.kind(kind)),
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

/// What a place lies on, if that is anything.
pub fn words(on: On) -> Option<String> {
    match on {
        On::Face(segment, side) => Some(format!("{} crack {}", side.name(), segment.crack)),
        On::Rim(hole) => Some(format!("on the rim of hole {hole}")),
        On::Border => Some("on the border".into()),
        On::Interface => Some("on an interface".into()),
        On::Everywhere => Some("as everywhere, but for rounding".into()),
        On::Inside | On::Pixel | On::Singular(_) => None,
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
    use crate::mirror::MirrorLines;
    use ppum::progress::unwatched;
    use ppum_render::range::Range;
    use ppum_render::scatter::render;
    use ppum_render::view::View;
    use ppum_testkit::random::Random;
    use ppum_testkit::synthetic::{Coefficients, Recipe};

    /// While one moves, a picture of another view has the range, and the extrema, of the view
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
                Drawn::new(raster, &field, view, "test")
            };
            let (drawn, style) = (draw(&view), Style { range: Range::Auto, ..Style::default() });
            let seen = BodyView::new(&field, view, MirrorLines::default());
            let span = value_span(&field, &seen, &quantity, &drawn, &style, unwatched()).unwrap();
            let by = vec2(random.between(-0.2, 0.2), random.between(-0.2, 0.2)) * view.width;
            let moved = draw(&View { center: view.center + by, ..view });
            let telling = Telling::new(&dataset, &field);
            let told =
                |drawn: &Drawn| telling.colors(&drawn.picture(&style, span.clone()).unwrap());
            assert!(told(&drawn).contains("values from"));
            assert_eq!(told(&drawn), told(&moved));
        }
    }
}
