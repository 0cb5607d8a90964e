//! Values at a point: those of `ppum probe`, with the gradient, on both sides of a crack.

use ppum_scene::error::ImageError;
use ppum_scene::location::{Location, LocationFormat, number};
use ppum_scene::material::DeformedWhole;
use ppum_scene::mirror_lines::MirrorLines;
use ppum_scene::probe::{PointReader, ProbeReading, SideValue};

use super::{Evaluator, PageSubject, prepared};
use crate::messages::{self, PointQuestion, PointReading};

/// Digits of values.
const DIGITS: usize = 7;

impl Evaluator<'_> {
    /// The values at a point of an image, or at the tip or the point of a crack within its reach.
    ///
    /// # Errors
    /// A quantity that the dataset does not have.
    pub fn probe(&mut self, question: &PointQuestion) -> Result<PointReading, ImageError> {
        let (dataset, frame) = (self.dataset, &question.frame);
        let view = frame.view.checked()?;
        let subject = prepared(&mut self.subject, dataset, &frame.scene)?;
        let (PageSubject { field, shown, reader, .. }, scene) = (&mut *subject, &frame.scene);
        let field = &*field;
        let lines = MirrorLines::of(scene.mirror.as_ref(), dataset)?;
        let factor = scene.deformed.map(|factor| factor.number(&[field])).transpose();
        let factor = factor?.filter(|factor| *factor != 0.0);
        let whole = factor.map(|factor| DeformedWhole { field, factor, lines });
        let offset = view.offset_at(question.pixel.into());
        let there = Location::new(view.center, offset);
        let seen = whole.map_or(Some(there), |whole| whole.spot(&view, offset));
        let cracks = &field.step.cracks;
        let spot = seen.unwrap_or(there).snapped(cracks, question.reach * view.pixel_size());
        let size = dataset.domain.bounds.size();
        let places = LocationFormat { view: &view, size: size.x.max(size.y), cracks };
        let offset = whole.filter(|_| seen.is_some()).map(|whole| whole.offset(&view, &spot));
        let pixel = view.pixel_of_offset(offset.unwrap_or(spot.from(view.center)));
        let reader = reader.get_or_insert_with(|| PointReader::new(field, shown, &lines));
        let read = reader.read(field, &spot);
        let place = places.show(&spot);
        let is_inside = seen.is_some() && !read.is_outside();
        Ok(PointReading { pixel: pixel.into(), place, is_inside, ..subject.reading(&read) })
    }
}

impl PageSubject<'_> {
    /// The reading in words, except for the place.
    fn reading(&self, read: &ProbeReading) -> PointReading {
        let sides: Vec<_> = read.sides.iter().map(side).collect();
        let text = self.text(&read.spot, &sides);
        let jump = read.jump().map(|jump| number(jump, DIGITS));
        let Location { anchor, offset, .. } = read.spot;
        let (pixel, place, tip) = ([0.0; 2], String::new(), read.tip);
        PointReading { anchor, offset, pixel, place, is_inside: true, tip, sides, jump, text }
    }

    /// The point and its values with all digits.
    fn text(&self, spot: &Location, sides: &[messages::SideReading]) -> String {
        let [x, y] = spot.texts();
        let mut lines = vec![format!("({x}, {y})")];
        for messages::SideReading { name, exact, .. } in sides {
            let side = name.as_ref().map_or(String::new(), |name| format!(" {name} the crack"));
            lines.push(format!("  {} = {exact}{side}", self.name));
        }
        lines.join("\n")
    }
}

fn side(sided: &SideValue) -> messages::SideReading {
    let SideValue { side, value, .. } = *sided;
    messages::SideReading {
        name: side.map(|side| side.name().to_owned()),
        value: number(value, DIGITS),
        exact: format!("{value:?}"),
        gradient: sided.slope(),
    }
}
