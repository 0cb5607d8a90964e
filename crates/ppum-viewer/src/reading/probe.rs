//! Exact values at a point: of the quantity and its gradient, on both sides of a crack, with cell
//! and patches.

use std::sync::Arc;

use ppum::crack::{SegmentId, Side};
use ppum::field::LocalField;
use ppum::quantity::{QuantityGradient, Reflection, ValueChange};
use ppum::sides::Segments;
use ppum::vec2::{Vec2, vec2};
use ppum_scene::drawing::Shown;
use ppum_scene::mirror::{MirrorLines, slope_sign};
use ppum_scene::scene::default_quantity;

use super::owner::Owner;
use crate::field::OwnedField;
use crate::frames::Frame;
use ppum_scene::spot::Spot;

/// What is read at a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Probed {
    /// The point.
    pub spot: Spot,
    /// The number of the tip that it is, if it is one.
    pub tip: Option<usize>,
    /// The crack that it lies on, if it lies on one.
    pub crack: Option<u32>,
    /// The values: one, or above and below a crack.
    pub sides: Vec<Sided>,
    /// The patch that it belongs to; none outside the plate.
    pub owner: Option<Owner>,
    /// The patches of a cover that cover it, with their φ.
    pub patches: Vec<(u32, f64)>,
    /// True in an image of a plate that is mirrored: patch and tip are those at the point whose
    /// image it is.
    pub is_mirrored: bool,
}

/// Value and gradient, on one side of a crack.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sided {
    /// The side of the crack, if the point lies on one.
    pub side: Option<Side>,
    /// The value; NaN where there is none.
    pub value: f64,
    /// Its gradient; NaN where there is none.
    pub gradient: Vec2,
    /// The values on the right and on the left whose difference it is, if it is one.
    pub terms: Option<[f64; 2]>,
}

impl Sided {
    /// The difference from what is read on the left.
    fn minus(self, left: &Self) -> Self {
        Self {
            side: self.side.or(left.side),
            value: self.value - left.value,
            gradient: self.gradient - left.gradient,
            terms: Some([self.value, left.value]),
        }
    }
}

impl Probed {
    /// True outside the plate.
    #[must_use]
    pub fn is_outside(&self) -> bool {
        self.owner.is_none()
    }

    /// The difference from what is read on the left. Where a crack runs on one side alone, the
    /// other has one value for both of its faces.
    fn minus(self, left: &Self) -> Self {
        let count = self.sides.len().max(left.sides.len());
        let of = |sides: &[Sided], k: usize| sides[k.min(sides.len() - 1)];
        let sides = (0..count).map(|k| of(&self.sides, k).minus(&of(&left.sides, k))).collect();
        Self { sides, crack: self.crack.or(left.crack), ..self }
    }

    /// The value above a crack minus that below.
    #[must_use]
    pub fn jump(&self) -> Option<f64> {
        match self.sides[..] {
            [above, below] => Some(above.value - below.value),
            _ => None,
        }
    }
}

/// What reads a quantity of a field, or its difference from another one.
pub struct Reader {
    field: Arc<OwnedField>,
    shown: Shown,
    gradient: Option<QuantityGradient>,
    /// The text that the quantity was chosen by.
    text: String,
    /// What reads the values that are subtracted.
    left: Option<Box<Reader>>,
    /// Of a plate that is mirrored, what reads the values in its images.
    images: Vec<ImageReader>,
    lines: MirrorLines,
    /// The quantity's name.
    pub name: String,
    /// Its unit; may be empty.
    pub unit: String,
}

/// What reads the values in an image of a plate that is mirrored.
struct ImageReader {
    reflection: Reflection,
    /// What reads the values of the plate, and their change in the image.
    reader: Reader,
    change: ValueChange,
}

impl ImageReader {
    fn new(reflection: Reflection, own: &Reader) -> Option<Self> {
        let (shown, change) = match &own.shown {
            Shown::Quantity(quantity) => {
                let found = quantity.reflected(&reflection, own.field.field()).ok()?;
                (Shown::Quantity(found.quantity), found.change)
            }
            cells @ Shown::Cells(..) => (cells.clone(), ValueChange::Same),
        };
        let reader = Reader::of(&own.field, &shown, &own.text);
        Some(Self { reflection, reader, change })
    }

    /// The values at a point of the image; none outside of it.
    fn read(&self, spot: &Spot) -> Option<Probed> {
        let Self { reflection, reader, change } = self;
        let there = reflection.point(spot.anchor());
        let there = Spot::new(there, reflection.vector(spot.offset()));
        let read = reader.read_own(&there);
        let side = |sided: &Sided| Sided {
            value: change.apply(sided.value),
            gradient: reflection.vector(sided.gradient) * slope_sign(*change),
            ..*sided
        };
        let sides = read.sides.iter().map(side).collect();
        (!read.is_outside()).then_some(Probed { spot: *spot, sides, is_mirrored: true, ..read })
    }
}

/// Most segments of cracks that are looked through for one that a point lies on.
const MOST_SEGMENTS: usize = 10_000;

impl Reader {
    /// What reads the values that a picture shows.
    #[must_use]
    pub fn new(frame: &Frame) -> Self {
        let mut own = Self::of(&frame.field, &frame.shown, own_text(frame));
        let images = frame.lines.reflections().filter_map(|one| ImageReader::new(one, &own));
        own.images = images.collect();
        own.lines = frame.lines;
        let left = frame.subtracted.as_ref().map(|left| {
            let text = left_text(frame).unwrap_or_default();
            Box::new(Self::of(&left.field, &left.shown, text))
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

    fn of(owned: &Arc<OwnedField>, shown: &Shown, text: &str) -> Self {
        let (field, quantity) = (owned.field(), shown.quantity());
        Self {
            field: Arc::clone(owned),
            shown: shown.clone(),
            gradient: quantity.and_then(|quantity| QuantityGradient::new(quantity, field).ok()),
            text: text.to_owned(),
            left: None,
            images: Vec::new(),
            lines: MirrorLines::default(),
            name: text.to_owned(),
            unit: quantity.map_or("", |quantity| quantity.unit(field)).to_owned(),
        }
    }

    /// True if it reads what a picture shows.
    #[must_use]
    pub fn is_of(&self, frame: &Frame) -> bool {
        let is_same_left = match (&self.left, &frame.subtracted) {
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
    pub fn read(&self, spot: &Spot) -> Probed {
        let Some(left) = &self.left else {
            let own = self.read_own(spot);
            let is_outside = own.is_outside();
            let mut images = self.images.iter().filter(|_| is_outside);
            return images.find_map(|image| image.read(spot)).unwrap_or(own);
        };
        let [own, other] = [self, left].map(|reader| reader.own(spot));
        let mut read = left.read_own(&other);
        if let [Some(a), Some(b)] = [self.along(&own), left.along(&other)]
            && a.dot(b) < 0.0
        {
            // the crack was drawn from its other end
            read.sides.reverse();
        }
        Probed { spot: *spot, ..self.read_own(&own).minus(&read) }
    }

    /// A spot of another plate: on a crack of this one if that is the same.
    fn own(&self, spot: &Spot) -> Spot {
        let on = spot.on.filter(|_| self.segment_of(spot).is_some());
        Spot { on, ..*spot }
    }

    /// The direction of the crack that a spot lies on.
    fn along(&self, spot: &Spot) -> Option<Vec2> {
        let SegmentId { crack, segment } = self.segment_of(spot)?;
        let points = &self.field.field().step.cracks[crack as usize].points;
        Some(points[segment as usize + 1] - points[segment as usize])
    }

    fn read_own(&self, spot: &Spot) -> Probed {
        let field = self.field.field();
        let tip = spot.tip(&field.step.cracks);
        let on = if tip.is_some() { None } else { self.segment_of(spot) };
        let mut local = match on {
            Some(segment) => field.on(segment, spot.anchor()),
            None => field.at(spot.anchor()),
        };
        let mut patches = Vec::new();
        if local.contains(spot.offset()) {
            field.tree.query_point(spot.point(), &mut patches);
            patches.sort_unstable();
        }
        let owner = Owner::of(field, &mut local, spot.offset(), &patches);
        let sides: &[Option<Side>] = match on {
            Some(_) => &[Some(Side::Above), Some(Side::Below)],
            None => &[None],
        };
        let sides = sides.iter().map(|&side| {
            let at = (spot.offset(), side.unwrap_or_default());
            let (value, gradient) = self.value(&mut local, at, owner);
            Sided { side, value, gradient, terms: None }
        });
        let sides = sides.collect();
        let phi = |patch: &u32| {
            let phi = local.partition_function::<0>(*patch as usize, spot.offset());
            (*patch, phi.map_or(f64::NAN, |jet| jet.v))
        };
        let is_cover = field.step.partition.mesh().is_none();
        let patches = patches.iter().filter(|_| is_cover).map(phi).collect();
        let (spot, crack) = (*spot, on.map(|segment| segment.crack));
        Probed { spot, tip, crack, sides, owner, patches, is_mirrored: false }
    }

    /// Value and gradient on a side; of a value of cells that of the point's own.
    fn value(
        &self,
        local: &mut LocalField<'_>,
        (offset, side): (Vec2, Side),
        owner: Option<Owner>,
    ) -> (f64, Vec2) {
        match (&self.shown, &self.gradient) {
            (Shown::Quantity(_), Some(both)) => {
                let slope = both.at(local, offset, side);
                (slope.value, slope.gradient)
            }
            (Shown::Quantity(quantity), None) => (quantity.at(local, offset, side), NOWHERE),
            (Shown::Cells(_, values), _) => {
                let of_cell = owner.and_then(|owner| values.get(owner.patch() as usize));
                (of_cell.copied().unwrap_or(f64::NAN), NOWHERE)
            }
        }
    }

    /// The spot itself, or the tip or the point of a crack that lies within reach of it.
    #[must_use]
    pub fn snapped(&self, spot: Spot, reach: f64) -> Spot {
        let own = self.snapped_own(spot, reach);
        match &self.left {
            Some(left) if own == spot => left.snapped_own(spot, reach),
            _ => own,
        }
    }

    fn snapped_own(&self, spot: Spot, reach: f64) -> Spot {
        spot.snapped(&self.field.field().step.cracks, reach)
    }

    /// The segment that a point lies on: the one that it was put on if the step still has it, or
    /// one that it lies on but for rounding.
    fn segment_of(&self, spot: &Spot) -> Option<SegmentId> {
        let cracks = &self.field.field().step.cracks;
        if let Some([crack, segment]) = spot.on {
            let points = cracks.get(crack as usize).map(|c| &c.points[..]).unwrap_or_default();
            let ends = points.get(segment as usize..segment as usize + 2).unwrap_or_default();
            if let [a, b] = *ends {
                let (distance, _) = spot.projected([a, b]);
                let is_on = distance <= 1e-14 * (b - a).length().max(a.length());
                return is_on.then_some(SegmentId { crack, segment });
            }
            return None;
        }
        let segments: usize = cracks.iter().map(|crack| crack.points.len()).sum();
        if segments > MOST_SEGMENTS {
            return None;
        }
        Segments::new(cracks).at(spot.anchor(), spot.offset())
    }
}

const NOWHERE: Vec2 = vec2(f64::NAN, f64::NAN);

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
fn own_text(frame: &Frame) -> &str {
    text_of(frame.wanted.scene.quantity.as_deref(), &frame.field)
}

/// The same of what is subtracted.
fn left_text(frame: &Frame) -> Option<&str> {
    let (wanted, left) = (frame.wanted.minus.as_ref()?, frame.subtracted.as_ref()?);
    Some(text_of(wanted.quantity.as_deref(), &left.field))
}

fn text_of<'a>(given: Option<&'a str>, field: &'a OwnedField) -> &'a str {
    given.map_or_else(|| default_quantity(field.field()), str::trim)
}
