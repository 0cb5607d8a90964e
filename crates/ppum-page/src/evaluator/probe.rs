//! Values at a point: those of `ppum probe`, with the gradient, on both sides of a crack.

use ppum_scene::material::DeformedWhole;
use ppum_scene::probe::{PointReader, Probed, Sided};
use ppum_scene::shot::FieldSource;
use ppum_scene::spot::{Places, Spot, number};

use super::{Evaluator, Subject, prepared};
use crate::error::PageError;
use crate::messages::{self, PointQuestion, Reading};

/// Digits of values.
const DIGITS: usize = 7;

impl Evaluator<'_> {
    /// The values at a point of an image, or at the tip or the point of a crack within its reach.
    ///
    /// # Errors
    /// What the dataset does not have.
    pub fn probe(&mut self, question: &PointQuestion) -> Result<Reading, PageError> {
        let (dataset, frame) = (self.dataset, &question.frame);
        let view = frame.view.checked().map_err(PageError::shot)?;
        let subject = prepared(&mut self.subject, dataset, &frame.scene)?;
        let (Subject { field, asked, reader, .. }, scene) = (&mut *subject, &frame.scene);
        let field = &*field;
        let lines = FieldSource::of(dataset, field).lines(scene).map_err(PageError::shot)?;
        let factor = scene.deformed.map(|factor| factor.number(&[field])).transpose();
        let factor = factor.map_err(PageError::shot)?.filter(|factor| *factor != 0.0);
        let whole = factor.map(|factor| DeformedWhole { field, factor, lines });
        let offset = view.offset_at(question.pixel.into());
        let there = Spot::new(view.center, offset);
        let seen = whole.map_or(Some(there), |whole| whole.spot(&view, offset));
        let cracks = &field.step.cracks;
        let spot = seen.unwrap_or(there).snapped(cracks, question.reach * view.pixel_size());
        let size = dataset.domain.bounds.size();
        let places = Places { view: &view, size: size.x.max(size.y), cracks };
        let offset = whole.filter(|_| seen.is_some()).map(|whole| whole.offset(&view, &spot));
        let pixel = view.pixel_of_offset(offset.unwrap_or(spot.from(view.center)));
        let reader = reader.get_or_insert_with(|| PointReader::new(field, &asked.shown, &lines));
        let read = reader.read(field, &spot);
        let place = places.show(&spot);
        let is_inside = seen.is_some() && !read.is_outside();
        Ok(Reading { pixel: pixel.into(), place, is_inside, ..subject.reading(&read) })
    }
}

impl Subject<'_> {
    /// What was read in words, but for the place.
    fn reading(&self, read: &Probed) -> Reading {
        let sides: Vec<_> = read.sides.iter().map(side).collect();
        let text = self.text(&read.spot, &sides);
        let jump = read.jump().map(|jump| number(jump, DIGITS));
        let Spot { anchor, offset, .. } = read.spot;
        let (pixel, place, tip) = ([0.0; 2], String::new(), read.tip);
        Reading { anchor, offset, pixel, place, is_inside: true, tip, sides, jump, text }
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

fn side(sided: &Sided) -> messages::Side {
    let Sided { side, value, .. } = *sided;
    messages::Side {
        name: side.map(|side| side.name().to_owned()),
        value: number(value, DIGITS),
        exact: format!("{value:?}"),
        gradient: sided.slope(),
    }
}
