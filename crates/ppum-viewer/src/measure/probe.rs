//! Exact values at a point of what an image shows, or of its difference from another one.

use std::sync::Arc;

use ppum::crack::SegmentId;
use ppum::vec2::Vec2;
use ppum_scene::location::Location;
use ppum_scene::mirror_lines::MirrorLines;
use ppum_scene::probe::{PointReader, segment_of};
pub use ppum_scene::probe::{ProbeReading, SideValue};
use ppum_scene::quantity::{DisplayedQuantity, default_quantity};

use crate::field::OwnedField;
use crate::frames::RenderedFrame;

/// The reader of a quantity of a field, or of its difference from another one.
pub struct QuantityReader {
    field: Arc<OwnedField>,
    points: PointReader,
    lines: MirrorLines,
    /// The text that the quantity was chosen by.
    text: String,
    /// The reader of the values that are subtracted.
    left: Option<Box<QuantityReader>>,
    /// The quantity's name.
    pub name: String,
    /// Its unit; may be empty.
    pub unit: String,
}

impl QuantityReader {
    /// Makes the reader of the values that an image shows.
    #[must_use]
    pub fn new(frame: &RenderedFrame) -> Self {
        let own = Self::of(&frame.field, &frame.shown, own_text(frame), frame.lines);
        let left = frame.left.as_ref().map(|left| {
            let text = left_text(frame).unwrap_or_default();
            Box::new(Self::of(&left.field, &left.shown, text, MirrorLines::default()))
        });
        match (frame.minus(), left) {
            (Some(minus), Some(left)) => {
                let name = short(&own.text, &left.text);
                let [_, unit] = minus.words();
                Self { name, unit, left: Some(left), ..own }
            }
            _ => own,
        }
    }

    fn of(
        owned: &Arc<OwnedField>,
        shown: &DisplayedQuantity,
        text: &str,
        lines: MirrorLines,
    ) -> Self {
        let (field, quantity) = (owned.field(), shown.quantity());
        Self {
            field: Arc::clone(owned),
            points: PointReader::new(field, shown, &lines),
            lines,
            text: text.to_owned(),
            left: None,
            name: text.to_owned(),
            unit: quantity.map_or("", |quantity| quantity.unit(field)).to_owned(),
        }
    }

    /// True if it reads what an image shows.
    pub(crate) fn is_of(&self, frame: &RenderedFrame) -> bool {
        let is_same_left = match (&self.left, &frame.left) {
            (None, None) => true,
            (Some(reader), Some(left)) => {
                Arc::ptr_eq(&reader.field, &left.field)
                    && left_text(frame) == Some(reader.text.as_str())
            }
            _ => false,
        };
        let is_same_field = Arc::ptr_eq(&self.field, &frame.field) && self.lines == frame.lines;
        is_same_field && self.text == own_text(frame) && is_same_left
    }

    /// The values at a point.
    #[must_use]
    pub fn read(&self, spot: &Location) -> ProbeReading {
        let Some(left) = &self.left else { return self.points.read(self.field.field(), spot) };
        let [own, other] = [self, left].map(|reader| reader.own(spot));
        let mut read = left.points.read_own(left.field.field(), &other);
        if let [Some(a), Some(b)] = [self.along(&own), left.along(&other)]
            && a.dot(b) < 0.0
        {
            // the crack was drawn from its other end
            read.sides.reverse();
        }
        ProbeReading { spot: *spot, ..self.points.read_own(self.field.field(), &own).minus(&read) }
    }

    /// A spot of another body: on a crack of this one if that is the same.
    fn own(&self, spot: &Location) -> Location {
        let on = spot.on.filter(|_| segment_of(self.field.field(), spot).is_some());
        Location { on, ..*spot }
    }

    /// The direction of the crack that a spot lies on.
    fn along(&self, spot: &Location) -> Option<Vec2> {
        let SegmentId { crack, segment } = segment_of(self.field.field(), spot)?;
        let edge = self.field.field().step.cracks[crack as usize].edge(segment as usize);
        Some(edge.tangent_towards(spot.point()))
    }

    /// The spot itself, or the tip or the point of a crack that lies within reach of it.
    pub(crate) fn snapped(&self, spot: Location, reach: f64) -> Location {
        let own = self.snapped_own(spot, reach);
        match &self.left {
            Some(left) if own == spot => left.snapped_own(spot, reach),
            _ => own,
        }
    }

    fn snapped_own(&self, spot: Location, reach: f64) -> Location {
        spot.snapped(&self.field.field().step.cracks, reach)
    }
}

/// The name of a difference: `Δ uy`, `ux − (sxx - syy)`.
fn short(right: &str, left: &str) -> String {
    let part = |text: &str| match text.contains(' ') {
        true => format!("({text})"),
        false => text.to_owned(),
    };
    match right == left {
        true => format!("Δ {}", part(right)),
        false => format!("{} − {}", part(right), part(left)),
    }
}

/// The text by which a quantity was chosen.
fn own_text(frame: &RenderedFrame) -> &str {
    text_of(frame.request.scene.quantity.as_deref(), &frame.field)
}

/// Returns the text of the subtrahend.
fn left_text(frame: &RenderedFrame) -> Option<&str> {
    let (wanted, left) = (frame.request.minus.as_ref()?, frame.left.as_ref()?);
    Some(text_of(wanted.quantity.as_deref(), &left.field))
}

fn text_of<'a>(given: Option<&'a str>, field: &'a OwnedField) -> &'a str {
    given.map_or_else(|| default_quantity(field.field()), str::trim)
}
