//! Values at a point: those of `ppum probe`, with the gradient, on both sides of a crack.

use ppum::crack::{SegmentId, Side};
use ppum::field::LocalField;
use ppum::quantity::QuantityGradient;
use ppum::sides::Segments;
use ppum::vec2::{Vec2, vec2};
use ppum_render::cells;
use ppum_render::view::View;
use ppum_scene::drawing::Shown;
use ppum_scene::spot::{Places, Spot, number};

use super::{Evaluator, Subject, prepared};
use crate::error::PageError;
use crate::messages::{self, PointQuestion, Reading};

/// Digits of values, and of gradients.
const DIGITS: usize = 7;
const FEWER: usize = 5;
/// Width of the pixel that a cell is found by, in parts of the domain's.
const TINY: f64 = 1e-9;
const NOWHERE: Vec2 = vec2(f64::NAN, f64::NAN);

impl Evaluator<'_> {
    /// The values at a point of an image, or at the tip or the point of a crack within its reach.
    ///
    /// # Errors
    /// What the dataset does not have.
    pub fn probe(&mut self, question: &PointQuestion) -> Result<Reading, PageError> {
        let (dataset, view) =
            (self.dataset, question.frame.view.checked().map_err(PageError::shot)?);
        let subject = prepared(&mut self.subject, dataset, &question.frame.scene)?;
        subject.prepare_gradient();
        let cracks = &subject.field.step.cracks;
        let spot = Spot::new(view.center, view.offset_at(question.pixel.into()));
        let spot = spot.snapped(cracks, question.reach * view.pixel_size());
        let size = dataset.domain.bounds.size();
        let places = Places { view: &view, size: size.x.max(size.y), cracks };
        let place = places.show(&spot);
        let pixel = view.pixel_of_offset(spot.from(view.center));
        Ok(Reading { pixel: pixel.into(), place, ..subject.read(&spot) })
    }
}

/// Value and gradient on one side.
type Slope = (f64, Vec2);

impl Subject<'_> {
    fn prepare_gradient(&mut self) {
        let (field, shown) = (&self.field, &self.asked.shown);
        self.gradient.get_or_insert_with(|| QuantityGradient::new(shown.quantity()?, field).ok());
    }

    /// Reads everything but the words for the place.
    fn read(&self, spot: &Spot) -> Reading {
        let cracks = &self.field.step.cracks;
        let tip = spot.tip(cracks);
        let on = match (tip, spot.on) {
            (Some(_), _) => None,
            (None, Some([crack, segment])) => Some(SegmentId { crack, segment }),
            (None, None) => Segments::new(cracks).at(spot.anchor(), spot.offset()),
        };
        let mut local = match on {
            Some(segment) => self.field.on(segment, spot.anchor()),
            None => self.field.at(spot.anchor()),
        };
        let is_inside = local.contains(spot.offset());
        let sides: &[_] = if on.is_some() { &[Side::Above, Side::Below] } else { &[Side::Above] };
        let slopes: Vec<Slope> =
            sides.iter().map(|&side| self.slope(&mut local, spot, side)).collect();
        let jump = match slopes[..] {
            [above, below] => Some(number(above.0 - below.0, DIGITS)),
            _ => None,
        };
        let name = |k: usize| on.map(|_| sides[k].name().to_owned());
        let sides: Vec<_> = slopes.iter().enumerate().map(|(k, s)| side(name(k), *s)).collect();
        let text = self.text(spot, &sides);
        let (anchor, offset, pixel) = (spot.anchor, spot.offset, [0.0; 2]);
        Reading { anchor, offset, pixel, place: String::new(), is_inside, tip, sides, jump, text }
    }

    fn slope(&self, local: &mut LocalField<'_>, spot: &Spot, side: Side) -> Slope {
        let (offset, point) = (spot.offset(), spot.point());
        match (&self.asked.shown, self.gradient.as_ref().and_then(Option::as_ref)) {
            (Shown::Quantity(quantity), None) => (quantity.at(local, offset, side), NOWHERE),
            (Shown::Quantity(_), Some(gradient)) => {
                let slope = gradient.at(local, offset, side);
                (slope.value, slope.gradient)
            }
            (Shown::Cells(_, values), _) => (self.of_cell(values, point), NOWHERE),
        }
    }

    /// The value of the cell that a point lies in: that of the pixel around it.
    fn of_cell(&self, values: &[f64], point: Vec2) -> f64 {
        let width = TINY * self.field.domain.bounds.size().x;
        let view = View::new(point, width, [1, 1]);
        view.map_or(f64::NAN, |view| cells::raster(&self.field, values, &view).value(0, 0))
    }

    /// The point and its values with all digits.
    fn text(&self, spot: &Spot, sides: &[messages::Side]) -> String {
        let [x, y] = spot.texts();
        let mut lines = vec![format!("({x}, {y})")];
        for messages::Side { name, exact, .. } in sides {
            let side = name.as_ref().map_or(String::new(), |name| format!(" {name} the crack"));
            lines.push(format!("  {} = {exact}{side}", self.asked.name));
        }
        lines.join("\n")
    }
}

fn side(name: Option<String>, (value, gradient): Slope) -> messages::Side {
    let size = gradient.length();
    let angle = number(gradient.y.atan2(gradient.x).to_degrees().round(), 3);
    let gradient = match size {
        _ if gradient.x.is_nan() => None,
        0.0 => Some("0".to_owned()),
        _ if size.is_finite() => Some(format!("{} at {angle}°", number(size, FEWER))),
        _ => Some("∞".to_owned()),
    };
    messages::Side { name, value: number(value, DIGITS), exact: format!("{value:?}"), gradient }
}
